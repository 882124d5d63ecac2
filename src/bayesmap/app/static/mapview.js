// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function to(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function oi(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Ut(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function To(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function ri(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Po=t=>ri(t,new DecompressionStream("deflate-raw")),si=t=>ri(t,new CompressionStream("deflate-r\
aw"));async function ii(t){let e=await si(new TextEncoder().encode(JSON.stringify(t)));return"#m="+To(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function yc(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Po(Ut(e[1]))))}var Eo="The link's map cannot be read: copy the link again, who\
le";async function Ao(){let t=await yc(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var Se=(t,e,n)=>Math.min(n,Math.max(e,t)),Cn=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,no=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Fr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function oo(t,e){let{x:n,y:o}=no(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Co=(t,e)=>Fr({x:t.x+.5,y:t.y+.5},e);
function li(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let r=0;r<=o;r++){let s=o?r/o:0;n.push({x:Math.round(t.x+s*(e.x-t.x)),y:Math.round(
t.y+s*(e.y-t.y))})}return n}function ai(t,[e,n]){let o=new Path2D,r=(s,i)=>s>=0&&s<e&&i>=0&&i<n?t[s*n+i]:0;for(let s=0;s<=e;s++)for(let i=0,a=-1;i<=n;i++){let u=i<
n&&r(s-1,i)!==r(s,i);u&&a<0&&(a=i),!u&&a>=0&&(o.moveTo(s,a),o.lineTo(s,i),a=-1)}for(let s=0;s<=n;s++)for(let i=0,a=-1;i<=e;i++){let u=i<e&&r(i,s-1)!==r(i,s);u&&
a<0&&(a=i),!u&&a>=0&&(o.moveTo(a,s),o.lineTo(i,s),a=-1)}return o}var _o=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function ci(t,e,n){let o=pi(t).map(({x:s,y:i})=>s*t.grid.shape[1]+i),r=(s,i)=>-((s-n.x)**2+(i-n.y)**2);return di(t,(s,i,a)=>e[a]||o.includes(a)?-1/0:r(s,i))}function ui(t,e){
let n=bc(e,t.grid.shape),o=pi(t);return di(t,(r,s,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let u of o)a=Math.min(a,Math.hypot(r-u.x,s-u.y));return a>0?a:-1/0})}
var pi=({sensors:t,grid:e})=>t.map(n=>oo(n,e));function di(t,e){let[n,o]=t.grid.shape,r=null,s=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let u=e(i,a,i*o+a);
u>s&&([r,s]=[{x:i,y:a},u])}return r&&Co(r,t.grid)}function bc(t,[e,n]){let o=new Uint16Array(e*n),r=(s,i)=>s<0||i<0||s>=e||i>=n?0:o[s*n+i];for(let s=0;s<e;s++)for(let i=0;i<
n;i++)o[s*n+i]=t[s*n+i]?0:1+Math.min(r(s-1,i-1),r(s-1,i),r(s-1,i+1),r(s,i-1));for(let s=e-1;s>=0;s--)for(let i=n-1;i>=0;i--){let a=1+Math.min(r(s+1,i+1),r(s+1,i),
r(s+1,i-1),r(s,i+1));o[s*n+i]=Math.min(o[s*n+i],a)}return o}var _e={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],fov_deg:[5,360],sweeps:[1,1e5],seed:[0,2147483647]};var Lo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Cn(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,r){
let{document:s,shape:i}=this.session;if(!s)return;let a=n?s.sensors.map(p=>oo(p,s.grid)):[],u=new Map;for(let p of e)!Cn(p,i)||this.isWall(p)===n||a.some(m=>m.x===
p.x&&m.y===p.y)||u.set(p.x*i[1]+p.y,[p.x,p.y]);u.size&&this.session.act({type:"walls",cells:[...u.values()],wall:n,stroke:o},r)}moveSensor(e,n,o,r){let{x:s,y:i,
yaw:a}={...e,...n};this.refuses({x:s,y:i})||this.session.act({type:"sensor",op:"move",id:e.id,x:s,y:i,yaw:a,drag:o},r)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let r=e==="where there is room"?ui(o,n.walls):"world"in e?e.world:ci(o,n.walls,e.near);r?o.sensors.length>=_e.sensors?n.say(`There can be ${_e.sensors}\
 sensors at most.`,"warning"):this.refuses(r)||(n.act({type:"sensor",op:"add",x:r.x,y:r.y,yaw:0}),this.hand.selected=Math.max(0,...o.sensors.map(s=>s.id))+1):n.
say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sensor",op:"remove",id:e.id})}refuses(e){
let{session:n}=this;if(!n.document)return!0;let o=oo(e,n.document.grid),r=this.isWall(o);return!r&&Cn(o,n.shape)?(n.status.text.startsWith("A sensor cannot")&&n.
say("Ready"),!1):(n.say(r?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var wc=120,Do=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.floor(Math.
random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??e[0]??
null}choose(e){this.tool=e,this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&Cn(e,this.session.shape)?e:null;n?.x===this.
hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){
clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(
e))},wc))}};var je={left:36,right:12,top:34,bottom:26},xc=60,vc=160,_n=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-je.left-je.right,y:this.height-je.
top-je.bottom},r=Math.max(.05,Math.min(o.x/e,o.y/n));r*this.ratio>4&&(r=Math.floor(r*this.ratio)/this.ratio),this.transform.scale=r,this.corner={x:je.left+(o.x-
r*e)/2,y:je.top+(o.y-r*n)/2},this.fitted=!0,this.settle([e,n])}zoom(e,n,o){let{scale:r}=this.transform,{x:s,y:i}=this.corner,a=Se(r*e,Math.min(this.width,this.height)/
Math.max(...o)/3,vc),u=a/r;this.transform.scale=a,this.corner={x:n.x-u*(n.x-s),y:n.y-u*(n.y-i)},this.fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.
y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:r,y:s}=this.transform;return{x:(e.x-r)/o,y:n-(e.y-s)/o}}fromGrid(e,n){let{scale:o,x:r,y:s}=this.transform;
return{x:r+e.x*o,y:s+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,r=xc;this.corner.x=Se(this.corner.x,r-e*o,this.width-r),this.corner.y=Se(this.corner.y,
r-n*o,this.height-r),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var yi=[["D, E, S, P","draw, erase, sensor, pan"],["arrows","move the cursor, the sensor or the view; with Shift by five cells"],["Space","draw or erase at the \
cursor; next sensor"],["[ and ]","turn the sensor"],["A, Delete","add, remove a sensor"],["R, Escape","run, cancel"],["M, N, H","show the mean, a draw, the entr\
opy"],["Ctrl+Z, Ctrl+Y","undo, redo"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],Sc={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[
0,-1]},fi=Math.PI/12,Ro=class{constructor(e,n,o,r,s){this.canvas=e;this.session=n;this.view=o;this.hand=r;this.editor=s;e.addEventListener("keydown",i=>{delete e.
dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,r.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{
session:n,hand:o,editor:r}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let s=Sc[e.key],i=e.shiftKey?5:1;if(s)this.arrow(s[0]*i,s[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?fi:-fi;n.editable&&o.sensor&&r.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.
key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)r.removeSensor();else if(e.key==="Escape"&&o.cursor)
o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is \
room")}arrow(e,n){let{session:o,view:r,hand:s}=this,[i,a]=o.shape;if(s.tool==="sensor"&&s.sensor&&o.document&&o.editable){let{resolution:u}=o.document.grid;s.selected=
s.sensor.id,this.editor.moveSensor(s.sensor,{x:s.sensor.x+e*u,y:s.sensor.y+n*u})}else if(s.tool==="pan"&&o.editable)r.pan(-40*e,40*n,o.shape),o.changed();else{let u=s.
cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},p={x:Se(u.x+e,0,i-1),y:Se(u.y+n,0,a-1)};s.setCursor(p);let m=r.fromGrid({x:p.x+.5,y:p.y+.5},a),h=(x,b,M)=>x-Se(x,b,
M),g={x:h(m.x,je.left+10,r.width-20),y:h(m.y,20,r.height-je.bottom-10)};(g.x||g.y)&&r.pan(-g.x,-g.y,o.shape)}}space(e){let{session:n,hand:o,editor:r}=this;if(n.
editable){if(o.tool==="sensor"){let s=n.document?.sensors??[],i=s.findIndex(a=>a.id===o.sensor?.id);o.select(s[(i+1)%Math.max(1,s.length)]?.id??null),o.selected!==
null&&o.announce(`Sensor ${o.selected}`)}else if(o.tool!=="pan"){o.cursor||this.arrow(0,0);let s=o.cursor,i=o.tool==="draw"&&!r.isWall(s);r.setWalls([s],i,o.nextGesture(),
e),o.announce(i?"wall":"free")}}}},hi={d:"draw",e:"erase",s:"sensor",p:"pan"},mi={m:"mean",n:"draw",h:"entropy"},gi={"+":"in","=":"in","-":"out",0:"fit","?":"he\
lp"};function bi(t,e,n){let o=t.composedPath()[0],r=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.type),s=t.key.toLowerCase();
if((t.ctrlKey||t.metaKey)&&!t.altKey){if(r||s!=="z"&&s!=="y"||e.recorded)return;t.preventDefault(),e.act({type:s==="y"||t.shiftKey?"redo":"undo"});return}if(!(r||
t.altKey)){if(hi[s]&&e.editable)n.tool(hi[s]);else if(mi[s])n.layer(mi[s]);else if(gi[t.key])n.command(gi[t.key]);else if(s==="r"&&!e.recorded)e.act({type:"run"});else if(t.
key==="Escape"&&(e.running||e.sampling))e.act({type:"cancel"});else return;t.preventDefault()}}var Ur='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Ln(t,e,n,o,r,s,i=!1){t.font=Ur,t.textAlign=s,t.textBaseline=
"middle",i&&(t.strokeStyle=r.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=r.axis,t.fillText(e,n,o)}function Ir({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,r)=>r).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function No(t,e,n){let o=n.fromGrid(no(t,e),e.shape[1]),r=Se(n.transform.scale*.42,7,13),s=r*2.6,i={x:o.x+s*Math.cos(t.yaw),
y:o.y-s*Math.sin(t.yaw)};return{point:o,size:r,handle:i}}function wi(t,{session:e,view:n,look:o}){let r=e.document;if(!r)return;let{theme:s}=o,i=Ir(e);t.lineJoin=
"round";for(let a of i){let u=No(a,r.grid,n),{point:p,size:m}=u;a.id===o.selected&&kc(t,u,o);let[h,g]=[Math.cos(a.yaw),-Math.sin(a.yaw)],x=(b,M)=>[p.x+m*(b*h-M*
g),p.y+m*(b*g+M*h)];t.beginPath(),t.moveTo(...x(1.25,0)),t.lineTo(...x(-.9,.8)),t.lineTo(...x(-.45,0)),t.lineTo(...x(-.9,-.8)),t.closePath(),t.strokeStyle=s.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=s.sensor,t.fill(),i.length>1&&i.length<100&&Ln(t,String(a.id),p.x,p.y+m*2+4,s,"center",!0)}}function kc(t,{point:e,size:n,handle:o},{
theme:r}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),t.strokeStyle=r.halo,t.lineWidth=4,t.stroke(),t.strokeStyle=r.sensor,t.lineWidth=1.5,t.stroke(),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=
r.halo,t.fill()}var xi={touch:24,other:11},Mc=90,Oo=class{constructor(e,n,o,r,s,i){this.canvas=e;this.session=n;this.view=o;this.hand=r;this.editor=s;this.embedded=i;let a=(u,p)=>e.
addEventListener(u,p,{passive:!1});a("pointerdown",u=>this.down(u)),a("pointermove",u=>this.move(u)),a("pointerup",u=>this.up(u)),a("pointercancel",u=>this.up(u)),
a("pointerleave",()=>r.point(null)),a("wheel",u=>this.wheel(u)),a("contextmenu",u=>u.preventDefault())}fingers=new Map;gesture=null;at(e){let n=this.canvas.getBoundingClientRect();
return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){
return Fr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,{document:r}=n;if(!r)return;e.preventDefault(),
this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(e.pointerId);let s=this.at(e);if(this.fingers.
set(e.pointerId,s),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;if(e.button===1||o.tool==="pan"||!n.editable)
return this.begin({kind:"pan",last:s});let i=this.gripAt(s,e,r);if(i)this.begin(i),i.kind==="sensor"&&o.select(i.id);else if(o.tool==="sensor")e.shiftKey?this.editor.
addSensor({world:this.metres(s,r)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),grip:{x:0,y:0}}),this.dragSensor(
e));else{let a=o.tool==="draw"!==(e.button===2||e.shiftKey),u=this.cellAt(s),p=a&&this.editor.isWall(u);this.begin({kind:"stroke",id:o.nextGesture(),wall:a,last:u,
held:e,onWall:p}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Mc)}}gripAt(e,n,o){let{hand:r,view:s}=this,i=n.pointerType==="touch"?xi.touch:
xi.other,a=g=>Math.hypot(e.x-g.x,e.y-g.y),u=r.tool==="sensor"&&r.sensor?No(r.sensor,o.grid,s):null;if(u&&r.sensor&&a(u.handle)<Math.min(i,a(u.point)))return{kind:"\
turn",id:r.sensor.id,drag:r.nextGesture()};if(n.button!==0||r.tool==="erase")return null;let p=o.sensors.map(g=>({id:g.id,...No(g,o.grid,s)}));p.sort((g,x)=>a(g.
point)-a(x.point));let m=p.find(({point:g,size:x})=>a(g)<Math.max(i,x));if(!m)return null;let h={x:m.point.x-e.x,y:m.point.y-e.y};return{kind:"sensor",id:m.id,drag:r.
nextGesture(),grip:h}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.gesture.
last],e)}move(e){let{gesture:n,session:o,view:r,hand:s}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)s.point(this.cellAt(
i));else if(n.kind==="stroke"){this.release();let a=[],u=e.getCoalescedEvents?.()??[];for(let p of u.length?u:[e]){let m=this.cellAt(this.at(p));(m.x!==n.last.x||
m.y!==n.last.y)&&(n.onWall=!1),a.push(...li(n.last,m)),n.last=m}this.stroke(a,e),s.point(n.last)}else if(n.kind==="sensor")this.dragSensor(e);else if(n.kind==="\
turn"){let a=o.document?.sensors.find(p=>p.id===n.id);if(!a||!o.document)return;let u=this.metres(i,o.document);this.editor.moveSensor(a,{yaw:Math.atan2(u.y-a.y,
u.x-a.x)},n.drag,e)}else if(n.kind==="pan")r.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.size===2){let{middle:a,spread:u}=this.
spread();r.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),r.zoom(u/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:u}),o.changed()}}up(e){e.type==="pointerup"&&
this.release(),e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),this.fingers.
delete(e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1),e.pointerType==="touch"&&this.hand.point(this.cellAt(this.at(e)))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:o,gesture:r}=this;r?.kind==="stroke"&&(this.editor.setWalls(e,r.wall,r.id,n),o.status.level==="error"&&o.say("Ready"))}dragSensor(e){
let{gesture:n,session:o}=this,{document:r}=o;if(n?.kind!=="sensor"||!r)return;this.hand.point(null);let s=r.sensors.find(u=>u.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},r);s&&this.editor.moveSensor(s,a,n.drag,e)}};var Tc=5,Fo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:r}){
let{theme:s}=r;e.beginPath(),e.rect(je.left,0,o.width,o.height-je.bottom),e.clip(),r.hover&&vi(e,r.hover,n.shape[1],o,s,s.axis,1.5),r.cursor&&vi(e,r.cursor,n.shape[1],
o,s,s.ray,2.5)}};function vi(t,e,n,o,r,s,i){let{scale:a}=o.transform,u=o.fromGrid({x:e.x,y:e.y+1},n),p=Math.max(a,Tc),[m,h]=[u.x-(p-a)/2,u.y-(p-a)/2];t.lineWidth=
i+2,t.strokeStyle=r.halo,t.strokeRect(m,h,p,p),t.lineWidth=i,t.strokeStyle=s,t.strokeRect(m,h,p,p)}var Pc={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Ec={paper:[17,0,-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"\
#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a\
3abb8",ground:"#12151a"},Io={light:Pc,dark:Ec},Si="00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Ac([
t,e,n]){let o=(t+16)/116,r=[.95047,1,1.08883],[s,i,a]=[o+e/500,o,o-n/200].map((u,p)=>(u>.20689655172413793?u**3:.12841854934601665*(u-.13793103448275862))*r[p]);
return[3.2404542*s-1.5371385*i-.4985314*a,-.969266*s+1.8760108*i+.041556*a,.0556434*s-.2040259*i+1.0572252*a].map(u=>{let p=Se(u,0,1);return Math.round(255*(p<=
.0031308?12.92*p:1.055*p**(1/2.4)-.055))})}var Uo=(t,e=1)=>[0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),zr=(t,e,n)=>t.map((o,r)=>o+n*(e[r]-o)),Hr=(t,e)=>Ac(zr(
t.paper,t.ink,e));function Vr(t){let e=Math.min(15,Math.floor(t*16));return zr(Uo(Si,6*e),Uo(Si,6*e+6),t*16-e)}function ki(t,e){let n=new Uint8ClampedArray(2048).
fill(255),[o,r]=[Uo(t.unobserved),Uo(t.unobservedWall)];for(let s=0;s<256;s++)n.set(e?Vr(_o(s/255)):Hr(t,s/255),4*s),n.set(zr(o,r,e?0:s/255),4*(s+256));return new Uint32Array(
n.buffer)}var Mi=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var zo=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,r)=>({layer:o,canvas:n[r],context:n[r].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:r,transform:s}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*r)),height:Math.max(1,Math.ceil(o*r))},
a=[e.look.theme,n,o,r,s.scale,s.x,s.y];for(let u of this.sheets){let{canvas:p,context:m,layer:h}=u,g=[...a,...h.depends(e)];g.length===u.before.length&&g.every(
(x,b)=>Object.is(x,u.before[b]))||(u.before=g,(p.width!==i.width||p.height!==i.height)&&(Object.assign(p,i),p.style.width=`${i.width/r}px`,p.style.height=`${i.height/
r}px`),m.setTransform(1,0,0,1,0,0),m.clearRect(0,0,p.width,p.height),m.setTransform(r,0,0,r,0,0),m.save(),h.paint(m,e),m.restore(),this.paints[h.name]++)}}};function Dn(t,{
session:e,view:n}){let[o,r]=e.shape,{scale:s,x:i,y:a}=n.transform;t.beginPath(),t.rect(i,a,o*s,r*s),t.clip()}var Cc=10,_c=7,Ho=()=>document.createElement("canvas").getContext("2d"),Rn=class{name="field";cells=Ho();mask=Ho();hatch=Ho();palettes=new Map;image=new ImageData(
1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.shown,e.view.layer==="entropy",...e.shape,e.document===null]}paint(e,n){let{
session:o,view:r,look:s}=n;if(!o.document)return;let[i,a]=o.shape,{scale:u,x:p,y:m}=r.transform;Dn(e,n);let h=o.shown;if(!h||h.p.length!==i*a){e.fillStyle=s.theme.
unobserved,e.fillRect(p,m,i*u,a*u);return}this.fill(h,i,a,s.theme,o.view.layer==="entropy"&&h.layer!=="draw"),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.
canvas,p,m,i*u,a*u),this.fillHatch(n),e.drawImage(this.hatch.canvas,0,0,this.hatch.canvas.width/r.ratio,this.hatch.canvas.height/r.ratio),u>=Cc&&this.lines(e,n)}fill(e,n,o,r,s){
let{cells:i,mask:a,drawn:u}=this,p=`${r.ground} ${s}`;if(u.field===e&&u.palette===p)return;let m=this.palettes.get(p)??ki(r,s);if(this.palettes.set(p,m),this.image.
width!==n||this.image.height!==o){this.image=new ImageData(n,o);for(let{canvas:g}of[i,a])Object.assign(g,{width:n,height:o});u.bits=null}let h=new Uint32Array(this.
image.data.buffer);for(let g=0,x=0;g<o;g++)for(let b=o-1-g;b<n*o;b+=o)h[x++]=m[e.p[b]+(e.observed[b]?0:256)];if(i.putImageData(this.image,0,0),u.bits!==e.bits){
for(let g=0,x=0;g<o;g++)for(let b=o-1-g;b<n*o;b+=o)h[x++]=e.observed[b]?0:4278190080;a.putImageData(this.image,0,0),u.hatch=""}Object.assign(u,{field:e,bits:e.bits,
palette:p})}fillHatch({session:e,view:n,look:o}){let{hatch:r,mask:s,drawn:i}=this,{ratio:a,width:u,height:p}=n,{scale:m,x:h,y:g}=n.transform,[x,b]=e.shape,M=[o.
theme.ground,m,h,g,u,p,a].join(" ");if(i.hatch===M)return;i.hatch=M;let A=Ho(),L=A.canvas.width=A.canvas.height=Math.round(_c*a);A.strokeStyle=o.theme.hatch,A.lineWidth=
a,A.beginPath();for(let _ of[-L,0,L])A.moveTo(_-1,L+1),A.lineTo(_+L+1,-1);A.stroke(),Object.assign(r.canvas,{width:Math.ceil(u*a),height:Math.ceil(p*a)}),r.setTransform(
a,0,0,a,0,0),r.imageSmoothingEnabled=!1,r.drawImage(s.canvas,h,g,x*m,b*m),r.globalCompositeOperation="source-in",r.setTransform(1,0,0,1,0,0);let k=r.createPattern(
A.canvas,"repeat");k.setTransform(new DOMMatrix().translate(Math.round(h*a),Math.round(g*a))),r.fillStyle=k,r.fillRect(0,0,r.canvas.width,r.canvas.height)}lines(e,{
session:n,view:o,look:r}){let[s,i]=n.shape,{scale:a,x:u,y:p}=o.transform;e.beginPath();for(let m=1;m<s;m++)e.moveTo(u+m*a,p),e.lineTo(u+m*a,p+i*a);for(let m=1;m<
i;m++)e.moveTo(u,p+m*a),e.lineTo(u+s*a,p+m*a);e.strokeStyle=r.theme.lines,e.lineWidth=1,e.stroke()}};var Lc=46;function Dc(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function Ti(t,{session:e,view:n,look:o}){if(!e.document)return;
let{theme:r}=o,{width:s,height:i}=n,{origin:a,resolution:u,shape:p}=e.document.grid,{scale:m,x:h,y:g}=n.transform,x=Dc(Lc/m*u),b=Math.min(g+p[1]*m,i-je.bottom)+
.5,M=Math.max(h,je.left)-.5;t.fillStyle=r.ground,h<M&&t.fillRect(0,0,M,i+1),g+p[1]*m>b&&t.fillRect(0,b,s+1,i+1-b);let A=Math.max(0,-Math.floor(Math.log10(x)+1e-9));
t.strokeStyle=r.frame,t.lineWidth=1,t.beginPath();let L=_=>Math.ceil(a[_]/x-1e-9)*x,k=_=>a[_]+p[_]*u+1e-9;for(let _=L(0);_<=k(0);_+=x){let T=h+(_-a[0])/u*m;T<M||
T>s-4||(t.moveTo(T,b),t.lineTo(T,b+4),Ln(t,_.toFixed(A),T,b+12,r,"center"))}for(let _=L(1);_<=k(1);_+=x){let T=g+(p[1]-(_-a[1])/u)*m;T>b||T<4||(t.moveTo(M,T),t.
lineTo(M-4,T),Ln(t,_.toFixed(A),M-7,T,r,"right"))}t.stroke(),Ln(t,"m",M-7,b+12,r,"right")}var Nn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=Ir(e).flatMap(({id:i,x:a,y:u,yaw:p})=>[i,a,u,p]),{grid:r}=e.document??{},
s=Pi(e)&&n.truth&&e.wallsVersion;return[r&&[...r.shape,...r.origin,r.resolution].join(),s,n.selected,...o]}paint(e,n){let{session:o,view:r,look:s}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:u,x:p,y:m}=r.transform;s.truth&&Pi(o)&&this.truth(e,n),e.strokeStyle=s.theme.frame,e.lineWidth=1,e.strokeRect(p-.5,m-.5,i*u+1,a*u+
1),wi(e,n),Ti(e,n)}truth(e,n){let{session:o,view:r,look:s}=n,{scale:i,x:a,y:u}=r.transform;this.edgesOf!==o.wallsVersion&&(this.edges=ai(o.walls,o.shape),this.edgesOf=
o.wallsVersion),e.save(),Dn(e,n),e.transform(i,0,0,-i,a,u+o.shape[1]*i),e.lineCap="square",e.strokeStyle=s.theme.truth,e.lineWidth=Se(i*.09,1,2.5)/i,e.stroke(this.
edges),e.restore()}},Pi=({document:t})=>t?.source.kind==="simulation";var Rc=600,On=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings]}paint(e,n){let{session:o,view:r,look:s}=n,{scan:i,
document:a}=o;if(!i||!a||!(s.rays||s.readings))return;Dn(e,n);let{scale:u}=r.transform,p=1/a.grid.resolution,m=a.grid.shape[1],h=i.angles.length,g=i.pose.length/
3,[x,b,M]=[new Path2D,new Path2D,new Path2D],A=Se(u*.1,1.3,4);for(let L=0;L<g;L++){let[k,_,T]=i.pose.subarray(3*L,3*L+3),j=r.fromGrid(no({x:k,y:_},a.grid),m);for(let D=0;D<
h;D++){let Z=i.ranges[L*h+D],G=i.hit[L*h+D]===1,R=(G?Z:a.max_range)*p*u,z=i.angles[D]+T,E={x:j.x+R*Math.cos(z),y:j.y-R*Math.sin(z)},Y=G?x:b;Y.moveTo(j.x,j.y),Y.
lineTo(E.x,E.y),G&&(h*g>Rc?M.rect(E.x-.9*A,E.y-.9*A,1.8*A,1.8*A):(M.moveTo(E.x+A,E.y),M.arc(E.x,E.y,A,0,2*Math.PI)))}}s.rays&&(e.lineWidth=1,e.globalAlpha=Se(28/
Math.sqrt(h*g)/5,.07,.45),e.strokeStyle=s.theme.ray,e.stroke(x),e.strokeStyle=s.theme.noReturn,e.stroke(b),e.globalAlpha=1),s.readings&&(e.fillStyle=s.theme.ray,
e.fill(M))}};var Ei=900,ro=2;function Ai({session:t,look:e}){let[n,o]=t.shape,r=new _n;r.resize(Ei,Math.round(Se(Ei*o/n,300,1800)),ro),r.fit(t.shape);let s=document.createElement(
"canvas");Object.assign(s,{width:r.width*ro,height:r.height*ro});let i=s.getContext("2d");i.scale(ro,ro),i.fillStyle=e.theme.ground,i.fillRect(0,0,r.width,r.height);
let a=[new Rn,new On,new Nn];for(let u of a)i.save(),u.paint(i,{session:t,view:r,look:{...e,hover:null,cursor:null,selected:null}}),i.restore();return new Promise(
u=>s.toBlob(u))}function S(t,e={},...n){let o=document.createElement(t);for(let[r,s]of Object.entries(e))r.startsWith("on")?o.addEventListener(r.slice(2),s):r.includes("-")||r===
"role"||r==="for"?o.setAttribute(r,s):o[r]=s;for(let r of n)r!==null&&o.append(r);return o}function V(t,e,n){t[e]!==n&&(t[e]=n)}function kt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var so=t=>t.getRootNode().activeElement===t,io=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function Wr(t,e){let n=URL.
createObjectURL(e);S("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Nc=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"]];function Ci(t){let{hand:e,session:n}=t,o=t.segmented(
"Tool",Nc,()=>n.editable||!n.document?e.tool:"pan",r=>e.choose(r),r=>n.editable||r==="pan");return t.visible(o,()=>!n.document||n.editable),S("div",{className:"\
bar"},o,S("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),{
title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Oc="uplot",Fc="u-hz",Uc="u-vt",Ic="u-title",zc="u-wrap",Hc="u-under",Vc="u-over",Wc="u-axis",ln="u-off",Gc="u-select",Bc="u-cursor-x",$c="u-cursor-y",jc="u-\
cursor-pt",Kc="u-legend",Yc="u-live",qc="u-inline",Jc="u-series",Zc="u-marker",_i="u-label",Qc="u-value",ao="width",co="height";var Li="bottom",Fn="left",Gr="right",is="#000",Di=is+"0",Br="mousemove",Ri="mousedown",$r="mouseup",Ni="mouseenter",Oi="mouseleave",Fi="dblclick",Xc="resize",eu="\
scroll",Ui="change",$o="dppxchange",ls="--",Gn=typeof window<"u",Jr=Gn?document:null,In=Gn?window:null,tu=Gn?navigator:null,pe,Vo;function Zr(){let t=devicePixelRatio;
pe!=t&&(pe=t,Vo&&Xr(Ui,Vo,Zr),Vo=matchMedia(`(min-resolution: ${pe-.001}dppx) and (max-resolution: ${pe+.001}dppx)`),an(Ui,Vo,Zr),In.dispatchEvent(new CustomEvent(
$o)))}function at(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function Qr(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function ke(t,e,n){
t.style[e]=n+"px"}function Mt(t,e,n,o){let r=Jr.createElement(t);return e!=null&&at(r,e),n?.insertBefore(r,o),r}function yt(t,e){return Mt("div",t,e)}var Ii=new WeakMap;
function Rt(t,e,n,o,r){let s="translate("+e+"px,"+n+"px)",i=Ii.get(t);s!=i&&(t.style.transform=s,Ii.set(t,s),e<0||n<0||e>o||n>r?at(t,ln):Qr(t,ln))}var zi=new WeakMap;
function Hi(t,e,n){let o=e+n,r=zi.get(t);o!=r&&(zi.set(t,o),t.style.background=e,t.style.borderColor=n)}var Vi=new WeakMap;function Wi(t,e,n,o){let r=e+""+n,s=Vi.
get(t);r!=s&&(Vi.set(t,r),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var as={passive:!0},nu={...as,
capture:!0};function an(t,e,n,o){e.addEventListener(t,n,o?nu:as)}function Xr(t,e,n,o){e.removeEventListener(t,n,as)}Gn&&Zr();function Tt(t,e,n,o){let r;n=n||0,o=
o||e.length-1;let s=o<=2147483647;for(;o-n>1;)r=s?n+o>>1:ct((n+o)/2),e[r]<t?n=r:o=r;return t-e[n]<=e[o]-t?n:o}function gl(t){return(n,o,r)=>{let s=-1,i=-1;for(let a=o;a<=
r;a++)if(t(n[a])){s=a;break}for(let a=r;a>=o;a--)if(t(n[a])){i=a;break}return[s,i]}}var yl=t=>t!=null,bl=t=>t!=null&&t>0,Yo=gl(yl),ou=gl(bl);function ru(t,e,n,o=0,r=!1){
let s=r?ou:Yo,i=r?bl:yl;[e,n]=s(t,e,n);let a=t[e],u=t[e];if(e>-1)if(o==1)a=t[e],u=t[n];else if(o==-1)a=t[n],u=t[e];else for(let p=e;p<=n;p++){let m=t[p];i(m)&&(m<
a?a=m:m>u&&(u=m))}return[a??ge,u??-ge]}function qo(t,e,n,o){let r=$i(t),s=$i(e);t==e&&(r==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?It:wl,a=r==1?ct:bt,u=s==1?bt:ct,
p=a(i(Oe(t))),m=u(i(Oe(e))),h=zn(n,p),g=zn(n,m);return n==10&&(p<0&&(h=ye(h,-p)),m<0&&(g=ye(g,-m))),o||n==2?(t=h*r,e=g*s):(t=kl(t,h),e=Jo(e,g)),[t,e]}function cs(t,e,n,o){
let r=qo(t,e,n,o);return t==0&&(r[0]=0),e==0&&(r[1]=0),r}var us=.1,Gi={mode:3,pad:us},po={pad:0,soft:null,mode:0},su={min:po,max:po};function jo(t,e,n,o){return Zo(
n)?Bi(t,e,n):(po.pad=n,po.soft=o?0:null,po.mode=o?3:0,Bi(t,e,su))}function ae(t,e){return t??e}function iu(t,e,n){for(e=ae(e,0),n=ae(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Bi(t,e,n){let o=n.min,r=n.max,s=ae(o.pad,0),i=ae(r.pad,0),a=ae(o.hard,-ge),u=ae(r.hard,ge),p=ae(o.soft,ge),m=ae(r.soft,-ge),
h=ae(o.mode,0),g=ae(r.mode,0),x=e-t,b=It(x),M=Xe(Oe(t),Oe(e)),A=It(M),L=Oe(A-b);(x<1e-24||L>10)&&(x=0,(t==0||e==0)&&(x=1e-24,h==2&&p!=ge&&(s=0),g==2&&m!=-ge&&(i=
0)));let k=x||M||1e3,_=It(k),T=zn(10,ct(_)),j=k*(x==0?t==0?.1:1:s),D=ye(kl(t-j,T/10),24),Z=t>=p&&(h==1||h==3&&D<=p||h==2&&D>=p)?p:ge,G=Xe(a,D<Z&&t>=Z?Z:Pt(Z,D)),
R=k*(x==0?e==0?.1:1:i),z=ye(Jo(e+R,T/10),24),E=e<=m&&(g==1||g==3&&z>=m||g==2&&z<=m)?m:-ge,Y=Pt(u,z>E&&e<=E?E:Xe(E,z));return G==Y&&G==0&&(Y=100),[G,Y]}var lu=new Intl.
NumberFormat(Gn?tu.language:"en-US"),ps=t=>lu.format(t),ut=Math,Bo=ut.PI,Oe=ut.abs,ct=ut.floor,Ne=ut.round,bt=ut.ceil,Pt=ut.min,Xe=ut.max,zn=ut.pow,$i=ut.sign,It=ut.
log10,wl=ut.log2,au=(t,e=1)=>ut.sinh(t)*e,jr=(t,e=1)=>ut.asinh(t/e),ge=1/0;function ji(t){return(It((t^t>>31)-(t>>31))|0)+1}function es(t,e,n){return Pt(Xe(t,e),
n)}function xl(t){return typeof t=="function"}function se(t){return xl(t)?t:()=>t}var cu=()=>{},vl=t=>t,Sl=(t,e)=>e,uu=t=>null,Ki=t=>!0,Yi=(t,e)=>t==e,pu=/\.\d*?(?=9{6,}|0{6,})/gm,
cn=t=>{if(Tl(t)||jt.has(t))return t;let e=`${t}`,n=e.match(pu);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[r,s]=e.split("e");return+`${cn(
r)}e${s}`}return ye(t,o)};function rn(t,e){return cn(ye(cn(t/e))*e)}function Jo(t,e){return cn(bt(cn(t/e))*e)}function kl(t,e){return cn(ct(cn(t/e))*e)}function ye(t,e=0){
if(Tl(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Ne(o)/n}var jt=new Map;function Ml(t){return((""+t).split(".")[1]||"").length}function ho(t,e,n,o){
let r=[],s=o.map(Ml);for(let i=e;i<n;i++){let a=Oe(i),u=ye(zn(t,i),a);for(let p=0;p<o.length;p++){let m=t==10?+`${o[p]}e${i}`:o[p]*u,h=(i>=0?0:a)+(i>=s[p]?0:s[p]),
g=t==10?m:ye(m,h);r.push(g),jt.set(g,h)}}return r}var fo={},ds=[],Hn=[null,null],$t=Array.isArray,Tl=Number.isInteger,du=t=>t===void 0;function qi(t){return typeof t==
"string"}function Zo(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function fu(t){return t!=null&&typeof t=="object"}var hu=Object.getPrototypeOf(
Uint8Array),Pl="__proto__";function Vn(t,e=Zo){let n;if($t(t)){let o=t.find(r=>r!=null);if($t(o)||e(o)){n=Array(t.length);for(let r=0;r<t.length;r++)n[r]=Vn(t[r],
e)}else n=t.slice()}else if(t instanceof hu)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Pl&&(n[o]=Vn(t[o],e))}else n=t;return n}function Le(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let r in o)r!=Pl&&(Zo(t[r])?Le(t[r],Vn(o[r])):t[r]=Vn(o[r]))}return t}var mu=0,gu=1,yu=2;function bu(t,e,n){for(let o=0,
r,s=-1;o<e.length;o++){let i=e[o];if(i>s){for(r=i-1;r>=0&&t[r]==null;)t[r--]=null;for(r=i+1;r<n&&t[r]==null;)t[s=r++]=null}}}function wu(t,e){if(Su(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return ku(i[0])||(i=vu(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let u=t[i][0],p=u.length;for(let m=0;m<
p;m++)n.add(u[m])}let o=[Array.from(n).sort((i,a)=>i-a)],r=o[0].length,s=new Map;for(let i=0;i<r;i++)s.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],u=a[0];
for(let p=1;p<a.length;p++){let m=a[p],h=Array(r).fill(void 0),g=e?e[i][p]:gu,x=[];for(let b=0;b<m.length;b++){let M=m[b],A=s.get(u[b]);M===null?g!=mu&&(h[A]=M,
g==yu&&x.push(A)):h[A]=M}bu(h,x,r),o.push(h)}}return o}var xu=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function vu(t){let e=t[0],n=e.
length,o=Array(n);for(let s=0;s<o.length;s++)o[s]=s;o.sort((s,i)=>e[s]-e[i]);let r=[];for(let s=0;s<t.length;s++){let i=t[s],a=Array(n);for(let u=0;u<n;u++)a[u]=
i[o[u]];r.push(a)}return r}function Su(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let r=t[o][0];if(r.length!=n)return!1;if(r!=e){for(let s=0;s<n;s++)
if(r[s]!=e[s])return!1}}return!0}function ku(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,r=n-1;for(;o<=r&&t[o]==null;)o++;for(;r>=o&&t[r]==null;)r--;if(r<=
o)return!0;let s=Xe(1,ct((r-o+1)/e));for(let i=t[o],a=o+s;a<=r;a+=s){let u=t[a];if(u!=null){if(u<=i)return!1;i=u}}return!0}var El=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Al=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Cl(t){
return t.slice(0,3)}var Mu=Al.map(Cl),Tu=El.map(Cl),Pu={MMMM:El,MMM:Tu,WWWW:Al,WWW:Mu};function lo(t){return(t<10?"0":"")+t}function Eu(t){return(t<10?"00":t<100?
"0":"")+t}var Au={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>lo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>lo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>lo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>lo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>lo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Eu(t.getMilliseconds())};function fs(t,e){e=e||Pu;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
r;for(;r=o.exec(t);)n.push(r[0][0]=="{"?Au[r[1]]:r[0]);return s=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](s,e);return i}}var Cu=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function _u(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Cu?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var _l=t=>t%1==0,Ko=[1,2,2.5,5],Lu=ho(10,-32,0,Ko),Ll=ho(10,0,32,Ko),Du=Ll.filter(
_l),sn=Lu.concat(Ll),hs=`
`,Dl="{YYYY}",Ji=hs+Dl,Rl="{M}/{D}",uo=hs+Rl,Wo=uo+"/{YY}",Nl="{aa}",Ru="{h}:{mm}",Un=Ru+Nl,Zi=hs+Un,Qi=":{ss}",de=null;function Ol(t){let e=t*1e3,n=e*60,o=n*60,
r=o*24,s=r*30,i=r*365,u=(t==1?ho(10,0,3,Ko).filter(_l):ho(10,-3,0,Ko)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,r,r*2,r*3,r*
4,r*5,r*6,r*7,r*8,r*9,r*10,r*15,s,s*2,s*3,s*4,s*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),p=[[i,Dl,de,de,de,de,de,de,1],[r*28,"{MMM}",Ji,de,de,de,de,de,1],[r,Rl,Ji,de,
de,de,de,de,1],[o,"{h}"+Nl,Wo,de,uo,de,de,de,1],[n,Un,Wo,de,uo,de,de,de,1],[e,Qi,Wo+" "+Un,de,uo+" "+Un,de,Zi,de,1],[t,Qi+".{fff}",Wo+" "+Un,de,uo+" "+Un,de,Zi,
de,1]];function m(h){return(g,x,b,M,A,L)=>{let k=[],_=A>=i,T=A>=s&&A<i,j=h(b),D=ye(j*t,3),Z=Kr(j.getFullYear(),_?0:j.getMonth(),T||_?1:j.getDate()),G=ye(Z*t,3);
if(T||_){let R=T?A/s:0,z=_?A/i:0,E=D==G?D:ye(Kr(Z.getFullYear()+z,Z.getMonth()+R,1)*t,3),Y=new Date(Ne(E/t)),I=Y.getFullYear(),K=Y.getMonth();for(let W=0;E<=M;W++){
let ne=Kr(I+z*W,K+R*W,1),B=ne-h(ye(ne*t,3));E=ye((+ne+B)*t,3),E<=M&&k.push(E)}}else{let R=A>=r?r:A,z=ct(b)-ct(D),E=G+z+Jo(D-G,R);k.push(E);let Y=h(E),I=Y.getHours()+
Y.getMinutes()/n+Y.getSeconds()/o,K=A/o,W=g.axes[x]._space,ne=L/W;for(;E=ye(E+A,t==1?0:3),!(E>M);)if(K>1){let B=ct(ye(I+K,6))%24,re=h(E).getHours()-B;re>1&&(re=
-1),E-=re*o,I=(I+K)%24;let ce=k[k.length-1];ye((E-ce)/A,3)*ne>=.7&&k.push(E)}else k.push(E)}return k}}return[u,p,m]}var[Nu,Ou,Fu]=Ol(1),[Uu,Iu,zu]=Ol(.001);ho(2,
-53,53,[1]);function Xi(t,e){return t.map(n=>n.map((o,r)=>r==0||r==8||o==null?o:e(r==1||n[8]==0?o:n[1]+o)))}function el(t,e){return(n,o,r,s,i)=>{let a=e.find(b=>i>=
b[0])||e[e.length-1],u,p,m,h,g,x;return o.map(b=>{let M=t(b),A=M.getFullYear(),L=M.getMonth(),k=M.getDate(),_=M.getHours(),T=M.getMinutes(),j=M.getSeconds(),D=A!=
u&&a[2]||L!=p&&a[3]||k!=m&&a[4]||_!=h&&a[5]||T!=g&&a[6]||j!=x&&a[7]||a[1];return u=A,p=L,m=k,h=_,g=T,x=j,D(M)})}}function Hu(t,e){let n=fs(e);return(o,r,s,i,a)=>r.
map(u=>n(t(u)))}function Kr(t,e,n){return new Date(t,e,n)}function tl(t,e){return e(t)}var Vu="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function nl(t,e){return(n,o,r,s)=>s==
null?ls:e(t(o))}function Wu(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Gu(t,e){return t.series[e].fill(
t,e)}var Bu={show:!0,live:!0,isolate:!1,mount:cu,markers:{show:!0,width:2,stroke:Wu,fill:Gu,dash:"solid"},idx:null,idxs:null,values:[]};function $u(t,e){let n=t.
cursor.points,o=yt(),r=n.size(t,e);ke(o,ao,r),ke(o,co,r);let s=r/-2;ke(o,"marginLeft",s),ke(o,"marginTop",s);let i=n.width(t,e,r);return i&&ke(o,"borderWidth",i),
o}function ju(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Ku(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Yu(t,e){return t.
series[e].points.size}var Yr=[0,0];function qu(t,e,n){return Yr[0]=e,Yr[1]=n,Yr}function Go(t,e,n,o=!0){return r=>{r.button==0&&(!o||r.target==e)&&n(r)}}function qr(t,e,n,o=!0){
return r=>{(!o||r.target==e)&&n(r)}}var Ju={show:!0,x:!0,y:!0,lock:!1,move:qu,points:{one:!1,show:$u,size:Yu,width:0,stroke:Ku,fill:ju},bind:{mousedown:Go,mouseup:Go,
click:Go,dblclick:Go,mousemove:qr,mouseleave:qr,mouseenter:qr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,r)=>o-r,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Fl={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},ms=Le({},Fl,{filter:Sl}),Ul=Le({},ms,{size:10}),Il=Le({},Fl,{show:!1}),gs='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',zl="bold "+gs,Hl=1.5,ol={
show:!0,scale:"x",stroke:is,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:zl,side:2,grid:ms,ticks:Ul,border:Il,font:gs,lineGap:Hl,rotate:0},
Zu="Value",Qu="Time",rl={show:!0,scale:"x",auto:!1,sorted:1,min:ge,max:-ge,idxs:[]};function Xu(t,e,n,o,r){return e.map(s=>s==null?"":ps(s))}function ep(t,e,n,o,r,s,i){
let a=[],u=jt.get(r)||0;n=i?n:ye(Jo(n,r),u);for(let p=n;p<=o;p=ye(p+r,u))a.push(Object.is(p,-0)?0:p);return a}function ts(t,e,n,o,r,s,i){let a=[],u=t.scales[t.axes[e].
scale].log,p=u==10?It:wl,m=ct(p(n));r=zn(u,m),u==10&&(r=sn[Tt(r,sn)]);let h=n,g=r*u;u==10&&(g=sn[Tt(g,sn)]);do a.push(h),h=h+r,u==10&&!jt.has(h)&&(h=ye(h,jt.get(
r))),h>=g&&(r=h,g=r*u,u==10&&(g=sn[Tt(g,sn)]));while(h<=o);return a}function tp(t,e,n,o,r,s,i){let u=t.scales[t.axes[e].scale].asinh,p=o>u?ts(t,e,Xe(u,n),o,r):[
u],m=o>=0&&n<=0?[0]:[];return(n<-u?ts(t,e,Xe(u,-o),-n,r):[u]).reverse().map(g=>-g).concat(m,p)}var Vl=/./,np=/[12357]/,op=/[125]/,sl=/1/,ns=(t,e,n,o)=>t.map((r,s)=>e==
4&&r==0||s%o==0&&n.test(r.toExponential()[r<0?1:0])?r:null);function rp(t,e,n,o,r){let s=t.axes[n],i=s.scale,a=t.scales[i],u=t.valToPos,p=s._space,m=u(10,i),h=u(
9,i)-m>=p?Vl:u(7,i)-m>=p?np:u(5,i)-m>=p?op:sl;if(h==sl){let g=Oe(u(1,i)-m);if(g<p)return ns(e.slice().reverse(),a.distr,h,bt(p/g)).reverse()}return ns(e,a.distr,
h,1)}function sp(t,e,n,o,r){let s=t.axes[n],i=s.scale,a=s._space,u=t.valToPos,p=Oe(u(1,i)-u(2,i));return p<a?ns(e.slice().reverse(),3,Vl,bt(a/p)).reverse():e}function ip(t,e,n,o){
return o==null?ls:e==null?"":ps(e)}var il={show:!0,scale:"y",stroke:is,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:zl,side:3,grid:ms,ticks:Ul,
border:Il,font:gs,lineGap:Hl,rotate:0};function lp(t,e){let n=3+(t||1)*2;return ye(n*e,3)}function ap(t,e){let{scale:n,idxs:o}=t.series[0],r=t._data[0],s=t.valToPos(
r[o[0]],n,!0),i=t.valToPos(r[o[1]],n,!0),a=Oe(i-s),u=t.series[e],p=a/(u.points.space*pe);return o[1]-o[0]<=p}var ll={scale:null,auto:!0,sorted:0,min:ge,max:-ge},
Wl=(t,e,n,o,r)=>r,al={show:!0,auto:!0,sorted:0,gaps:Wl,alpha:1,facets:[Le({},ll,{scale:"x"}),Le({},ll,{scale:"y"})]},cl={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Wl,alpha:1,points:{show:ap,filter:null},values:null,min:ge,max:-ge,idxs:[],path:null,clip:null};function cp(t,e,n,o,r){return n/10}var Gl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},up=Le({},Gl,{time:!1,ori:1}),ul={};function Bl(t,e){let n=ul[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(r=>r!=o)},pub(o,r,s,i,a,u,p){for(let m=0;m<n.plots.length;m++)n.plots[m]!=r&&n.plots[m].pub(o,r,s,i,a,u,p)}},t!=null&&(ul[t]=
n)),n}var Wn=1,os=2;function un(t,e,n){let o=t.mode,r=t.series[e],s=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,u=s[0],p=o==2?s[1]:s[e],m=o==2?i[r.facets[0].scale]:
i[t.series[0].scale],h=o==2?i[r.facets[1].scale]:i[r.scale],g=a.left,x=a.top,b=a.width,M=a.height,A=t.valToPosH,L=t.valToPosV;return m.ori==0?n(r,u,p,m,h,A,L,g,
x,b,M,Xo,Bn,tr,jl,Yl):n(r,u,p,m,h,L,A,x,g,M,b,er,$n,ws,Kl,ql)}function ys(t,e){let n=0,o=0,r=ae(t.bands,ds);for(let s=0;s<r.length;s++){let i=r[s];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function pp(t,e,n,o,r){let s=t.mode,i=t.series[e],a=s==2?i.facets[1].scale:i.scale,
u=t.scales[a];return r==-1?u.min:r==1?u.max:u.distr==3?u.dir==1?u.min:u.max:0}function zt(t,e,n,o,r,s){return un(t,e,(i,a,u,p,m,h,g,x,b,M,A)=>{let L=i.pxRound,k=p.
dir*(p.ori==0?1:-1),_=p.ori==0?Bn:$n,T,j;k==1?(T=n,j=o):(T=o,j=n);let D=L(h(a[T],p,M,x)),Z=L(g(u[T],m,A,b)),G=L(h(a[j],p,M,x)),R=L(g(s==1?m.max:m.min,m,A,b)),z=new Path2D(
r);return _(z,G,R),_(z,D,R),_(z,D,Z),z})}function Qo(t,e,n,o,r,s){let i=null;if(t.length>0){i=new Path2D;let a=e==0?tr:ws,u=n;for(let h=0;h<t.length;h++){let g=t[h];
if(g[1]>g[0]){let x=g[0]-u;x>0&&a(i,u,o,x,o+s),u=g[1]}}let p=n+r-u,m=10;p>0&&a(i,u,o-m/2,p,o+s+m)}return i}function dp(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function bs(t,e,n,o,r,s,i){let a=[],u=t.length;for(let p=r==1?n:o;p>=n&&p<=o;p+=r)if(e[p]===null){let h=p,g=p;if(r==1)for(;++p<=o&&e[p]===null;)
g=p;else for(;--p>=n&&e[p]===null;)g=p;let x=s(t[h]),b=g==h?x:s(t[g]),M=h-r;x=i<=0&&M>=0&&M<u?s(t[M]):x;let L=g+r;b=i>=0&&L>=0&&L<u?s(t[L]):b,b>=x&&a.push([x,b])}
return a}function pl(t){return t==0?vl:t==1?Ne:e=>rn(e,t)}function $l(t){let e=t==0?Xo:er,n=t==0?(r,s,i,a,u,p)=>{r.arcTo(s,i,a,u,p)}:(r,s,i,a,u,p)=>{r.arcTo(i,s,
u,a,p)},o=t==0?(r,s,i,a,u)=>{r.rect(s,i,a,u)}:(r,s,i,a,u)=>{r.rect(i,s,u,a)};return(r,s,i,a,u,p=0,m=0)=>{p==0&&m==0?o(r,s,i,a,u):(p=Pt(p,a/2,u/2),m=Pt(m,a/2,u/2),
e(r,s+p,i),n(r,s+a,i,s+a,i+u,p),n(r,s+a,i+u,s,i+u,m),n(r,s,i+u,s,i,m),n(r,s,i,s+a,i,p),r.closePath())}}var Xo=(t,e,n)=>{t.moveTo(e,n)},er=(t,e,n)=>{t.moveTo(n,e)},
Bn=(t,e,n)=>{t.lineTo(e,n)},$n=(t,e,n)=>{t.lineTo(n,e)},tr=$l(0),ws=$l(1),jl=(t,e,n,o,r,s)=>{t.arc(e,n,o,r,s)},Kl=(t,e,n,o,r,s)=>{t.arc(n,e,o,r,s)},Yl=(t,e,n,o,r,s,i)=>{
t.bezierCurveTo(e,n,o,r,s,i)},ql=(t,e,n,o,r,s,i)=>{t.bezierCurveTo(n,e,r,o,i,s)};function Jl(t){return(e,n,o,r,s)=>un(e,n,(i,a,u,p,m,h,g,x,b,M,A)=>{let{pxRound:L,
points:k}=i,_,T;p.ori==0?(_=Xo,T=jl):(_=er,T=Kl);let j=ye(k.width*pe,3),D=(k.size-k.width)/2*pe,Z=ye(D*2,3),G=new Path2D,R=new Path2D,{left:z,top:E,width:Y,height:I}=e.
bbox;tr(R,z-Z,E-Z,Y+Z*2,I+Z*2);let K=W=>{if(u[W]!=null){let ne=L(h(a[W],p,M,x)),B=L(g(u[W],m,A,b));_(G,ne+D,B),T(G,ne,B,D,0,Bo*2)}};if(s)s.forEach(K);else for(let W=o;W<=
r;W++)K(W);return{stroke:j>0?G:null,fill:G,clip:R,flags:Wn|os}})}function Zl(t){return(e,n,o,r,s,i)=>{o!=r&&(s!=o&&i!=o&&t(e,n,o),s!=r&&i!=r&&t(e,n,r),t(e,n,i))}}
var fp=Zl(Bn),hp=Zl($n);function Ql(t){let e=ae(t?.alignGaps,0);return(n,o,r,s)=>un(n,o,(i,a,u,p,m,h,g,x,b,M,A)=>{[r,s]=Yo(u,r,s);let L=i.pxRound,k=I=>L(h(I,p,M,
x)),_=I=>L(g(I,m,A,b)),T,j;p.ori==0?(T=Bn,j=fp):(T=$n,j=hp);let D=p.dir*(p.ori==0?1:-1),Z={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Wn},G=Z.
stroke,R=!1;if(s-r>=M*4){let I=H=>n.posToVal(H,p.key,!0),K=null,W=null,ne,B,Ke,he=k(a[D==1?r:s]),re=k(a[r]),ce=k(a[s]),X=I(D==1?re+1:ce-1);for(let H=D==1?r:s;H>=
r&&H<=s;H+=D){let Pe=a[H],me=(D==1?Pe<X:Pe>X)?he:k(Pe),ie=u[H];me==he?ie!=null?(B=ie,K==null?(T(G,me,_(B)),ne=K=W=B):B<K?K=B:B>W&&(W=B)):ie===null&&(R=!0):(K!=null&&
j(G,he,_(K),_(W),_(ne),_(B)),ie!=null?(B=ie,T(G,me,_(B)),K=W=ne=B):(K=W=null,ie===null&&(R=!0)),he=me,X=I(he+D))}K!=null&&K!=W&&Ke!=he&&j(G,he,_(K),_(W),_(ne),_(
B))}else for(let I=D==1?r:s;I>=r&&I<=s;I+=D){let K=u[I];K===null?R=!0:K!=null&&T(G,k(a[I]),_(K))}let[E,Y]=ys(n,o);if(i.fill!=null||E!=0){let I=Z.fill=new Path2D(
G),K=i.fillTo(n,o,i.min,i.max,E),W=_(K),ne=k(a[r]),B=k(a[s]);D==-1&&([B,ne]=[ne,B]),T(I,B,W),T(I,ne,W)}if(!i.spanGaps){let I=[];R&&I.push(...bs(a,u,r,s,D,k,e)),
Z.gaps=I=i.gaps(n,o,r,s,I),Z.clip=Qo(I,p.ori,x,b,M,A)}return Y!=0&&(Z.band=Y==2?[zt(n,o,r,s,G,-1),zt(n,o,r,s,G,1)]:zt(n,o,r,s,G,Y)),Z})}function mp(t){let e=ae(
t.align,1),n=ae(t.ascDesc,!1),o=ae(t.alignGaps,0),r=ae(t.extend,!1);return(s,i,a,u)=>un(s,i,(p,m,h,g,x,b,M,A,L,k,_)=>{[a,u]=Yo(h,a,u);let T=p.pxRound,{left:j,width:D}=s.
bbox,Z=re=>T(b(re,g,k,A)),G=re=>T(M(re,x,_,L)),R=g.ori==0?Bn:$n,z={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Wn},E=z.stroke,Y=g.dir*(g.ori==
0?1:-1),I=G(h[Y==1?a:u]),K=Z(m[Y==1?a:u]),W=K,ne=K;r&&e==-1&&(ne=j,R(E,ne,I)),R(E,K,I);for(let re=Y==1?a:u;re>=a&&re<=u;re+=Y){let ce=h[re];if(ce==null)continue;
let X=Z(m[re]),H=G(ce);e==1?R(E,X,I):R(E,W,H),R(E,X,H),I=H,W=X}let B=W;r&&e==1&&(B=j+D,R(E,B,I));let[Ke,he]=ys(s,i);if(p.fill!=null||Ke!=0){let re=z.fill=new Path2D(
E),ce=p.fillTo(s,i,p.min,p.max,Ke),X=G(ce);R(re,B,X),R(re,ne,X)}if(!p.spanGaps){let re=[];re.push(...bs(m,h,a,u,Y,Z,o));let ce=p.width*pe/2,X=n||e==1?ce:-ce,H=n||
e==-1?-ce:ce;re.forEach(Pe=>{Pe[0]+=X,Pe[1]+=H}),z.gaps=re=p.gaps(s,i,a,u,re),z.clip=Qo(re,g.ori,A,L,k,_)}return he!=0&&(z.band=he==2?[zt(s,i,a,u,E,-1),zt(s,i,a,
u,E,1)]:zt(s,i,a,u,E,he)),z})}function dl(t,e,n,o,r,s,i=ge){if(t.length>1){let a=null;for(let u=0,p=1/0;u<t.length;u++)if(e[u]!==void 0){if(a!=null){let m=Oe(t[u]-
t[a]);m<p&&(p=m,i=Oe(n(t[u],o,r,s)-n(t[a],o,r,s)))}a=u}}return i}function gp(t){t=t||fo;let e=ae(t.size,[.6,ge,1]),n=t.align||0,o=t.gap||0,r=t.radius;r=r==null?
[0,0]:typeof r=="number"?[r,0]:r;let s=se(r),i=1-e[0],a=ae(e[1],ge),u=ae(e[2],1),p=ae(t.disp,fo),m=ae(t.each,x=>{}),{fill:h,stroke:g}=p;return(x,b,M,A)=>un(x,b,
(L,k,_,T,j,D,Z,G,R,z,E)=>{let Y=L.pxRound,I=n,K=o*pe,W=a*pe,ne=u*pe,B,Ke;T.ori==0?[B,Ke]=s(x,b):[Ke,B]=s(x,b);let he=T.dir*(T.ori==0?1:-1),re=T.ori==0?tr:ws,ce=T.
ori==0?m:(F,be,Re,fn,Jt,Et,Zt)=>{m(F,be,Re,Jt,fn,Zt,Et)},X=ae(x.bands,ds).find(F=>F.series[0]==b),H=X!=null?X.dir:0,Pe=L.fillTo(x,b,L.min,L.max,H),Ue=Y(Z(Pe,j,E,
R)),me,ie,pt,et=z,Me=Y(L.width*pe),ot=!1,q=null,te=null,De=null,Nt=null;h!=null&&(Me==0||g!=null)&&(ot=!0,q=h.values(x,b,M,A),te=new Map,new Set(q).forEach(F=>{
F!=null&&te.set(F,new Path2D)}),Me>0&&(De=g.values(x,b,M,A),Nt=new Map,new Set(De).forEach(F=>{F!=null&&Nt.set(F,new Path2D)})));let{x0:pn,size:Kn}=p;if(pn!=null&&
Kn!=null){I=1,k=pn.values(x,b,M,A),pn.unit==2&&(k=k.map(Re=>x.posToVal(G+Re*z,T.key,!0)));let F=Kn.values(x,b,M,A);Kn.unit==2?ie=F[0]*z:ie=D(F[0],T,z,G)-D(0,T,z,
G),et=dl(k,_,D,T,z,G,et),pt=et-ie+K}else et=dl(k,_,D,T,z,G,et),pt=et*i+K,ie=et-pt;pt<1&&(pt=0),Me>=ie/2&&(Me=0),pt<5&&(Y=vl);let mo=pt>0,Yt=et-pt-(mo?Me:0);ie=Y(
es(Yt,ne,W)),me=(I==0?ie/2:I==he?0:ie)-I*he*((I==0?K/2:0)+(mo?Me/2:0));let qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},dn=ot?null:new Path2D,
Ot=null;if(X!=null)Ot=x.data[X.series[1]];else{let{y0:F,y1:be}=p;F!=null&&be!=null&&(_=be.values(x,b,M,A),Ot=F.values(x,b,M,A))}let qt=B*ie,ee=Ke*ie;for(let F=he==
1?M:A;F>=M&&F<=A;F+=he){let be=_[F];if(be==null)continue;if(Ot!=null){let tt=Ot[F]??0;if(be-tt==0)continue;Ue=Z(tt,j,E,R)}let Re=T.distr!=2||p!=null?k[F]:F,fn=D(
Re,T,z,G),Jt=Z(ae(be,Pe),j,E,R),Et=Y(fn-me),Zt=Y(Xe(Jt,Ue)),rt=Y(Pt(Jt,Ue)),dt=Zt-rt;if(be!=null){let tt=be<0?ee:qt,wt=be<0?qt:ee;ot?(Me>0&&De[F]!=null&&re(Nt.get(
De[F]),Et,rt+ct(Me/2),ie,Xe(0,dt-Me),tt,wt),q[F]!=null&&re(te.get(q[F]),Et,rt+ct(Me/2),ie,Xe(0,dt-Me),tt,wt)):re(dn,Et,rt+ct(Me/2),ie,Xe(0,dt-Me),tt,wt),ce(x,b,
F,Et-Me/2,rt,ie+Me,dt)}}return Me>0?qe.stroke=ot?Nt:dn:ot||(qe._fill=L.width==0?L._fill:L._stroke??L._fill,qe.width=0),qe.fill=ot?te:dn,qe})}function yp(t,e){let n=ae(
e?.alignGaps,0);return(o,r,s,i)=>un(o,r,(a,u,p,m,h,g,x,b,M,A,L)=>{[s,i]=Yo(p,s,i);let k=a.pxRound,_=B=>k(g(B,m,A,b)),T=B=>k(x(B,h,L,M)),j,D,Z;m.ori==0?(j=Xo,Z=Bn,
D=Yl):(j=er,Z=$n,D=ql);let G=m.dir*(m.ori==0?1:-1),R=_(u[G==1?s:i]),z=R,E=[],Y=[];for(let B=G==1?s:i;B>=s&&B<=i;B+=G)if(p[B]!=null){let he=u[B],re=_(he);E.push(
z=re),Y.push(T(p[B]))}let I={stroke:t(E,Y,j,Z,D,k),fill:null,clip:null,band:null,gaps:null,flags:Wn},K=I.stroke,[W,ne]=ys(o,r);if(a.fill!=null||W!=0){let B=I.fill=
new Path2D(K),Ke=a.fillTo(o,r,a.min,a.max,W),he=T(Ke);Z(B,z,he),Z(B,R,he)}if(!a.spanGaps){let B=[];B.push(...bs(u,p,s,i,G,_,n)),I.gaps=B=a.gaps(o,r,s,i,B),I.clip=
Qo(B,m.ori,b,M,A,L)}return ne!=0&&(I.band=ne==2?[zt(o,r,s,i,K,-1),zt(o,r,s,i,K,1)]:zt(o,r,s,i,K,ne)),I})}function bp(t){return yp(wp,t)}function wp(t,e,n,o,r,s){
let i=t.length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let u=Array(i),p=Array(i-1),m=Array(i-1),h=Array(i-1);for(let g=0;g<
i-1;g++)m[g]=e[g+1]-e[g],h[g]=t[g+1]-t[g],p[g]=m[g]/h[g];u[0]=p[0];for(let g=1;g<i-1;g++)p[g]===0||p[g-1]===0||p[g-1]>0!=p[g]>0?u[g]=0:(u[g]=3*(h[g-1]+h[g])/((2*
h[g]+h[g-1])/p[g-1]+(h[g]+2*h[g-1])/p[g]),isFinite(u[g])||(u[g]=0));u[i-1]=p[i-2];for(let g=0;g<i-1;g++)r(a,t[g]+h[g]/3,e[g]+u[g]*h[g]/3,t[g+1]-h[g]/3,e[g+1]-u[g+
1]*h[g]/3,t[g+1],e[g+1])}return a}var rs=new Set;function fl(){for(let t of rs)t.syncRect(!0)}Gn&&(an(Xc,In,fl),an(eu,In,fl,!0),an($o,In,()=>{Fe.pxRatio=pe}));var xp=Ql(),
vp=Jl();function hl(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((s,i)=>ss(s,i,e,n))}function Sp(t,e){return t.map((n,o)=>o==
0?{}:Le({},e,n))}function ss(t,e,n,o){return Le({},e==0?n:o,t)}function Xl(t,e,n){return e==null?Hn:[e,n]}var kp=Xl;function Mp(t,e,n){return e==null?Hn:jo(e,n,
us,!0)}function ea(t,e,n,o){return e==null?Hn:qo(e,n,t.scales[o].log,!1)}var Tp=ea;function ta(t,e,n,o){return e==null?Hn:cs(e,n,t.scales[o].log,!1)}var Pp=ta;function Ep(t,e,n,o,r){
let s=Xe(ji(t),ji(e)),i=e-t,a=Tt(r/o*i,n);do{let u=n[a],p=o*u/i;if(p>=r&&s+(u<5?jt.get(u):0)<=17)return[u,p]}while(++a<n.length);return[0,0]}function ml(t){let e,
n;return t=t.replace(/(\d+)px/,(o,r)=>(e=Ne((n=+r)*pe))+"px"),[t,e,n]}function Ap(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=ye(e[2]*pe,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Fe(t,e,n){let o={mode:ae(t.mode,1)},r=o.mode;function s(l,c,d,f){let y=c.valToPct(l);return f+d*(c.dir==-1?1-y:y)}function i(l,c,d,f){
let y=c.valToPct(l);return f+d*(c.dir==-1?y:1-y)}function a(l,c,d,f){return c.ori==0?s(l,c,d,f):i(l,c,d,f)}o.valToPosH=s,o.valToPosV=i;let u=!1;o.status=0;let p=o.
root=yt(Oc);if(t.id!=null&&(p.id=t.id),at(p,t.class),t.title){let l=yt(Ic,p);l.textContent=t.title}let m=Mt("canvas"),h=o.ctx=m.getContext("2d"),g=yt(zc,p);an("\
click",g,l=>{l.target===b&&(we!=Mn||Te!=Tn)&&$e.click(o,l)},!0);let x=o.under=yt(Hc,g);g.appendChild(m);let b=o.over=yt(Vc,g);t=Vn(t);let M=+ae(t.pxAlign,1),A=pl(
M);(t.plugins||[]).forEach(l=>{l.opts&&(t=l.opts(o,t)||t)});let L=t.ms||.001,k=o.series=r==1?hl(t.series||[],rl,cl,!1):Sp(t.series||[null],al),_=o.axes=hl(t.axes||
[],ol,il,!0),T=o.scales={},j=o.bands=t.bands||[];j.forEach(l=>{l.fill=se(l.fill||null),l.dir=ae(l.dir,-1)});let D=r==2?k[1].facets[0].scale:k[0].scale,Z={axes:nc,
series:Za},G=(t.drawOrder||["axes","series"]).map(l=>Z[l]);function R(l){let c=l.distr==3?d=>It(d>0?d:l.clamp(o,d,l.min,l.max,l.key)):l.distr==4?d=>jr(d,l.asinh):
l.distr==100?d=>l.fwd(d):d=>d;return d=>{let f=c(d),{_min:y,_max:w}=l,v=w-y;return(f-y)/v}}function z(l){let c=T[l];if(c==null){let d=(t.scales||fo)[l]||fo;if(d.
from!=null){z(d.from);let f=Le({},T[d.from],d,{key:l});f.valToPct=R(f),T[l]=f}else{c=T[l]=Le({},l==D?Gl:up,d),c.key=l;let f=c.time,y=c.range,w=$t(y);if((l!=D||r==
2&&!f)&&(w&&(y[0]==null||y[1]==null)&&(y={min:y[0]==null?Gi:{mode:1,hard:y[0],soft:y[0]},max:y[1]==null?Gi:{mode:1,hard:y[1],soft:y[1]}},w=!1),!w&&Zo(y))){let v=y;
y=(P,C,N)=>C==null?Hn:jo(C,N,v)}c.range=se(y||(f?kp:l==D?c.distr==3?Tp:c.distr==4?Pp:Xl:c.distr==3?ea:c.distr==4?ta:Mp)),c.auto=se(w?!1:c.auto),c.clamp=se(c.clamp||
cp),c._min=c._max=null,c.valToPct=R(c)}}}z("x"),z("y"),r==1&&k.forEach(l=>{z(l.scale)}),_.forEach(l=>{z(l.scale)});for(let l in t.scales)z(l);let E=T[D],Y=E.distr,
I,K;E.ori==0?(at(p,Fc),I=s,K=i):(at(p,Uc),I=i,K=s);let W={};for(let l in T){let c=T[l];(c.min!=null||c.max!=null)&&(W[l]={min:c.min,max:c.max},c.min=c.max=null)}
let ne=t.tzDate||(l=>new Date(Ne(l/L))),B=t.fmtDate||fs,Ke=L==1?Fu(ne):zu(ne),he=el(ne,Xi(L==1?Ou:Iu,B)),re=nl(ne,tl(Vu,B)),ce=[],X=o.legend=Le({},Bu,t.legend),
H=o.cursor=Le({},Ju,{drag:{y:r==2}},t.cursor),Pe=X.show,Ue=H.show,me=X.markers;X.idxs=ce,me.width=se(me.width),me.dash=se(me.dash),me.stroke=se(me.stroke),me.fill=
se(me.fill);let ie,pt,et,Me=[],ot=[],q,te=!1,De={};if(X.live){let l=k[1]?k[1].values:null;te=l!=null,q=te?l(o,1,0):{_:0};for(let c in q)De[c]=ls}if(Pe)if(ie=Mt(
"table",Kc,p),et=Mt("tbody",null,ie),X.mount(o,ie),te){pt=Mt("thead",null,ie,et);let l=Mt("tr",null,pt);Mt("th",null,l);for(var Nt in q)Mt("th",_i,l).textContent=
Nt}else at(ie,qc),X.live&&at(ie,Yc);let pn={show:!0},Kn={show:!1};function mo(l,c){if(c==0&&(te||!X.live||r==2))return Hn;let d=[],f=Mt("tr",Jc,et,et.childNodes[c]);
at(f,l.class),l.show||at(f,ln);let y=Mt("th",null,f);if(me.show){let P=yt(Zc,y);if(c>0){let C=me.width(o,c);C&&(P.style.border=C+"px "+me.dash(o,c)+" "+me.stroke(
o,c)),P.style.background=me.fill(o,c)}}let w=yt(_i,y);l.label instanceof HTMLElement?w.appendChild(l.label):w.textContent=l.label,c>0&&(me.show||(w.style.color=
l.width>0?me.stroke(o,c):me.fill(o,c)),qe("click",y,P=>{if(H._lock)return;Xt(P);let C=k.indexOf(l);if((P.ctrlKey||P.metaKey)!=X.isolate){let N=k.some((O,U)=>U>0&&
U!=C&&O.show);k.forEach((O,U)=>{U>0&&Ct(U,N?U==C?pn:Kn:pn,!0,Ce.setSeries)})}else Ct(C,{show:!l.show},!0,Ce.setSeries)},!1),mn&&qe(Ni,y,P=>{H._lock||(Xt(P),Ct(k.
indexOf(l),En,!0,Ce.setSeries))},!1));for(var v in q){let P=Mt("td",Qc,f);P.textContent="--",d.push(P)}return[f,d]}let Yt=new Map;function qe(l,c,d,f=!0){let y=Yt.
get(c)||{},w=H.bind[l](o,c,d,f);w&&(an(l,c,y[l]=w),Yt.set(c,y))}function dn(l,c,d){let f=Yt.get(c)||{};for(let y in f)(l==null||y==l)&&(Xr(y,c,f[y]),delete f[y]);
l==null&&Yt.delete(c)}let Ot=0,qt=0,ee=0,F=0,be=0,Re=0,fn=be,Jt=Re,Et=ee,Zt=F,rt=0,dt=0,tt=0,wt=0;o.bbox={};let fr=!1,go=!1,hn=!1,Qt=!1,yo=!1,ft=!1;function hr(l,c,d){
(d||l!=o.width||c!=o.height)&&Es(l,c),xn(!1),hn=!0,go=!0,vn()}function Es(l,c){o.width=Ot=ee=l,o.height=qt=F=c,be=Re=0,Ba(),$a();let d=o.bbox;rt=d.left=rn(be*pe,
.5),dt=d.top=rn(Re*pe,.5),tt=d.width=rn(ee*pe,.5),wt=d.height=rn(F*pe,.5)}let Va=3;function Wa(){let l=!1,c=0;for(;!l;){c++;let d=ec(c),f=tc(c);l=c==Va||d&&f,l||
(Es(o.width,o.height),go=!0)}}function Ga({width:l,height:c}){hr(l,c)}o.setSize=Ga;function Ba(){let l=!1,c=!1,d=!1,f=!1;_.forEach((y,w)=>{if(y.show&&y._show){let{
side:v,_size:P}=y,C=v%2,N=y.label!=null?y.labelSize:0,O=P+N;O>0&&(C?(ee-=O,v==3?(be+=O,f=!0):d=!0):(F-=O,v==0?(Re+=O,l=!0):c=!0))}}),en[0]=l,en[1]=d,en[2]=c,en[3]=
f,ee-=Ht[1]+Ht[3],be+=Ht[3],F-=Ht[2]+Ht[0],Re+=Ht[0]}function $a(){let l=be+ee,c=Re+F,d=be,f=Re;function y(w,v){switch(w){case 1:return l+=v,l-v;case 2:return c+=
v,c-v;case 3:return d-=v,d+v;case 0:return f-=v,f+v}}_.forEach((w,v)=>{if(w.show&&w._show){let P=w.side;w._pos=y(P,w._size),w.label!=null&&(w._lpos=y(P,w.labelSize))}})}
if(H.dataIdx==null){let l=H.hover,c=l.skip=new Set(l.skip??[]);c.add(void 0);let d=l.prox=se(l.prox),f=l.bias??=0;H.dataIdx=(y,w,v,P)=>{if(w==0)return v;let C=v,
N=d(y,w,v,P)??ge,O=N>=0&&N<ge,U=E.ori==0?ee:F,Q=H.left,ue=e[0],le=e[w];if(c.has(le[v])){C=null;let oe=null,J=null,$;if(f==0||f==-1)for($=v;oe==null&&$-- >0;)c.has(
le[$])||(oe=$);if(f==0||f==1)for($=v;J==null&&$++<le.length;)c.has(le[$])||(J=$);if(oe!=null||J!=null)if(O){let ve=oe==null?-1/0:I(ue[oe],E,U,0),Ee=J==null?1/0:
I(ue[J],E,U,0),Ge=Q-ve,fe=Ee-Q;Ge<=fe?Ge<=N&&(C=oe):fe<=N&&(C=J)}else C=J==null?oe:oe==null?J:v-oe<=J-v?oe:J}else O&&Oe(Q-I(ue[v],E,U,0))>N&&(C=null);return C}}
let Xt=l=>{H.event=l};H.idxs=ce,H._lock=!1;let Ye=H.points;Ye.show=se(Ye.show),Ye.size=se(Ye.size),Ye.stroke=se(Ye.stroke),Ye.width=se(Ye.width),Ye.fill=se(Ye.fill);
let At=o.focus=Le({},t.focus||{alpha:.3},H.focus),mn=At.prox>=0,gn=mn&&Ye.one,ht=[],yn=[],bn=[];function As(l,c){let d=Ye.show(o,c);if(d instanceof HTMLElement)
return at(d,jc),at(d,l.class),Rt(d,-10,-10,ee,F),b.insertBefore(d,ht[c]),d}function Cs(l,c){if(r==1||c>0){let d=r==1&&T[l.scale].time,f=l.value;l.value=d?qi(f)?
nl(ne,tl(f,B)):f||re:f||ip,l.label=l.label||(d?Qu:Zu)}if(gn||c>0){l.width=l.width==null?1:l.width,l.paths=l.paths||xp||uu,l.fillTo=se(l.fillTo||pp),l.pxAlign=+ae(
l.pxAlign,M),l.pxRound=pl(l.pxAlign),l.stroke=se(l.stroke||null),l.fill=se(l.fill||null),l._stroke=l._fill=l._paths=l._focus=null;let d=lp(Xe(1,l.width),1),f=l.
points=Le({},{size:d,width:Xe(1,d*.2),stroke:l.stroke,space:d*2,paths:vp,_stroke:null,_fill:null},l.points);f.show=se(f.show),f.filter=se(f.filter),f.fill=se(f.
fill),f.stroke=se(f.stroke),f.paths=se(f.paths),f.pxAlign=l.pxAlign}if(Pe){let d=mo(l,c);Me.splice(c,0,d[0]),ot.splice(c,0,d[1]),X.values.push(null)}if(Ue){ce.splice(
c,0,null);let d=null;gn?c==0&&(d=As(l,c)):c>0&&(d=As(l,c)),ht.splice(c,0,d),yn.splice(c,0,0),bn.splice(c,0,0)}We("addSeries",c)}function ja(l,c){c=c??k.length,l=
r==1?ss(l,c,rl,cl):ss(l,c,{},al),k.splice(c,0,l),Cs(k[c],c)}o.addSeries=ja;function Ka(l){if(k.splice(l,1),Pe){X.values.splice(l,1),ot.splice(l,1);let c=Me.splice(
l,1)[0];dn(null,c.firstChild),c.remove()}Ue&&(ce.splice(l,1),ht.splice(l,1)[0].remove(),yn.splice(l,1),bn.splice(l,1)),We("delSeries",l)}o.delSeries=Ka;let en=[
!1,!1,!1,!1];function Ya(l,c){if(l._show=l.show,l.show){let d=l.side%2,f=T[l.scale];f==null&&(l.scale=d?k[1].scale:D,f=T[l.scale]);let y=f.time;l.size=se(l.size),
l.space=se(l.space),l.rotate=se(l.rotate),$t(l.incrs)&&l.incrs.forEach(v=>{!jt.has(v)&&jt.set(v,Ml(v))}),l.incrs=se(l.incrs||(f.distr==2?Du:y?L==1?Nu:Uu:sn)),l.
splits=se(l.splits||(y&&f.distr==1?Ke:f.distr==3?ts:f.distr==4?tp:ep)),l.stroke=se(l.stroke),l.grid.stroke=se(l.grid.stroke),l.ticks.stroke=se(l.ticks.stroke),l.
border.stroke=se(l.border.stroke);let w=l.values;l.values=$t(w)&&!$t(w[0])?se(w):y?$t(w)?el(ne,Xi(w,B)):qi(w)?Hu(ne,w):w||he:w||Xu,l.filter=se(l.filter||(f.distr>=
3&&f.log==10?rp:f.distr==3&&f.log==2?sp:Sl)),l.font=ml(l.font),l.labelFont=ml(l.labelFont),l._size=l.size(o,null,c,0),l._space=l._rotate=l._incrs=l._found=l._splits=
l._values=null,l._size>0&&(en[c]=!0,l._el=yt(Wc,g))}}function Yn(l,c,d,f){let[y,w,v,P]=d,C=c%2,N=0;return C==0&&(P||w)&&(N=c==0&&!y||c==2&&!v?Ne(ol.size/3):0),C==
1&&(y||v)&&(N=c==1&&!w||c==3&&!P?Ne(il.size/2):0),N}let _s=o.padding=(t.padding||[Yn,Yn,Yn,Yn]).map(l=>se(ae(l,Yn))),Ht=o._padding=_s.map((l,c)=>l(o,c,en,0)),Be,
Ie=null,ze=null,bo=r==1?k[0].idxs:null,xt=null,qn=!1;function Ls(l,c){if(e=l??[],o.data=o._data=e,r==2){Be=0;for(let d=1;d<k.length;d++)Be+=e[d][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),xt=e[0],Be=xt.length;let d=e;if(Y==2){d=e.slice();let f=d[0]=Array(Be);for(let y=0;y<Be;y++)f[y]=y}o._data=e=d}if(xn(!0),We(
"setData"),Y==2&&(hn=!0),c!==!1){let d=E;d.auto(o,qn)?mr():Wt(D,d.min,d.max),Qt=Qt||H.left>=0,ft=!0,vn()}}o.setData=Ls;function mr(){qn=!0;let l,c;r==1&&(Be>0?(Ie=
bo[0]=0,ze=bo[1]=Be-1,l=e[0][Ie],c=e[0][ze],Y==2?(l=Ie,c=ze):l==c&&(Y==3?[l,c]=qo(l,l,E.log,!1):Y==4?[l,c]=cs(l,l,E.log,!1):E.time?c=l+Ne(86400/L):[l,c]=jo(l,c,
us,!0))):(Ie=bo[0]=l=null,ze=bo[1]=c=null)),Wt(D,l,c)}let wo,wn,gr,yr,br,wr,xr,vr,Sr,nt;function Ds(l,c,d,f,y,w){l??=Di,d??=ds,f??="butt",y??=Di,w??="round",l!=
wo&&(h.strokeStyle=wo=l),y!=wn&&(h.fillStyle=wn=y),c!=gr&&(h.lineWidth=gr=c),w!=br&&(h.lineJoin=br=w),f!=wr&&(h.lineCap=wr=f),d!=yr&&h.setLineDash(yr=d)}function Rs(l,c,d,f){
c!=wn&&(h.fillStyle=wn=c),l!=xr&&(h.font=xr=l),d!=vr&&(h.textAlign=vr=d),f!=Sr&&(h.textBaseline=Sr=f)}function kr(l,c,d,f,y=0){if(f.length>0&&l.auto(o,qn)&&(c==
null||c.min==null)){let w=ae(Ie,0),v=ae(ze,f.length-1),P=d.min==null?ru(f,w,v,y,l.distr==3):[d.min,d.max];l.min=Pt(l.min,d.min=P[0]),l.max=Xe(l.max,d.max=P[1])}}
let Ns={min:null,max:null};function qa(){for(let f in T){let y=T[f];W[f]==null&&(y.min==null||W[D]!=null&&y.auto(o,qn))&&(W[f]=Ns)}for(let f in T){let y=T[f];W[f]==
null&&y.from!=null&&W[y.from]!=null&&(W[f]=Ns)}W[D]!=null&&xn(!0);let l={};for(let f in W){let y=W[f];if(y!=null){let w=l[f]=Vn(T[f],fu);if(y.min!=null)Le(w,y);else if(f!=
D||r==2)if(Be==0&&w.from==null){let v=w.range(o,null,null,f);w.min=v[0],w.max=v[1]}else w.min=ge,w.max=-ge}}if(Be>0){k.forEach((f,y)=>{if(r==1){let w=f.scale,v=W[w];
if(v==null)return;let P=l[w];if(y==0){let C=P.range(o,P.min,P.max,w);P.min=C[0],P.max=C[1],Ie=Tt(P.min,e[0]),ze=Tt(P.max,e[0]),ze-Ie>1&&(e[0][Ie]<P.min&&Ie++,e[0][ze]>
P.max&&ze--),f.min=xt[Ie],f.max=xt[ze]}else f.show&&f.auto&&kr(P,v,f,e[y],f.sorted);f.idxs[0]=Ie,f.idxs[1]=ze}else if(y>0&&f.show&&f.auto){let[w,v]=f.facets,P=w.
scale,C=v.scale,[N,O]=e[y],U=l[P],Q=l[C];U!=null&&kr(U,W[P],w,N,w.sorted),Q!=null&&kr(Q,W[C],v,O,v.sorted),f.min=v.min,f.max=v.max}});for(let f in l){let y=l[f],
w=W[f];if(y.from==null&&(w==null||w.min==null)){let v=y.range(o,y.min==ge?null:y.min,y.max==-ge?null:y.max,f);y.min=v[0],y.max=v[1]}}}for(let f in l){let y=l[f];
if(y.from!=null){let w=l[y.from];if(w.min==null)y.min=y.max=null;else{let v=y.range(o,w.min,w.max,f);y.min=v[0],y.max=v[1]}}}let c={},d=!1;for(let f in l){let y=l[f],
w=T[f];if(w.min!=y.min||w.max!=y.max){w.min=y.min,w.max=y.max;let v=w.distr;w._min=v==3?It(w.min):v==4?jr(w.min,w.asinh):v==100?w.fwd(w.min):w.min,w._max=v==3?It(
w.max):v==4?jr(w.max,w.asinh):v==100?w.fwd(w.max):w.max,c[f]=d=!0}}if(d){k.forEach((f,y)=>{r==2?y>0&&c.y&&(f._paths=null):c[f.scale]&&(f._paths=null)});for(let f in c)
hn=!0,We("setScale",f);Ue&&H.left>=0&&(Qt=ft=!0)}for(let f in W)W[f]=null}function Ja(l){let c=es(Ie-1,0,Be-1),d=es(ze+1,0,Be-1);for(;l[c]==null&&c>0;)c--;for(;l[d]==
null&&d<Be-1;)d++;return[c,d]}function Za(){if(Be>0){let l=k.some(c=>c._focus)&&nt!=At.alpha;l&&(h.globalAlpha=nt=At.alpha),k.forEach((c,d)=>{if(d>0&&c.show&&(Os(
d,!1),Os(d,!0),c._paths==null)){let f=nt;nt!=c.alpha&&(h.globalAlpha=nt=c.alpha);let y=r==2?[0,e[d][0].length-1]:Ja(e[d]);c._paths=c.paths(o,d,y[0],y[1]),nt!=f&&
(h.globalAlpha=nt=f)}}),k.forEach((c,d)=>{if(d>0&&c.show){let f=nt;nt!=c.alpha&&(h.globalAlpha=nt=c.alpha),c._paths!=null&&Fs(d,!1);{let y=c._paths!=null?c._paths.
gaps:null,w=c.points.show(o,d,Ie,ze,y),v=c.points.filter(o,d,w,y);(w||v)&&(c.points._paths=c.points.paths(o,d,Ie,ze,v),Fs(d,!0))}nt!=f&&(h.globalAlpha=nt=f),We(
"drawSeries",d)}}),l&&(h.globalAlpha=nt=1)}}function Os(l,c){let d=c?k[l].points:k[l];d._stroke=d.stroke(o,l),d._fill=d.fill(o,l)}function Fs(l,c){let d=c?k[l].
points:k[l],{stroke:f,fill:y,clip:w,flags:v,_stroke:P=d._stroke,_fill:C=d._fill,_width:N=d.width}=d._paths;N=ye(N*pe,3);let O=null,U=N%2/2;c&&C==null&&(C=N>0?"#\
fff":P);let Q=d.pxAlign==1&&U>0;if(Q&&h.translate(U,U),!c){let ue=rt-N/2,le=dt-N/2,oe=tt+N,J=wt+N;O=new Path2D,O.rect(ue,le,oe,J)}c?Mr(P,N,d.dash,d.cap,C,f,y,v,
w):Qa(l,P,N,d.dash,d.cap,C,f,y,v,O,w),Q&&h.translate(-U,-U)}function Qa(l,c,d,f,y,w,v,P,C,N,O){let U=!1;C!=0&&j.forEach((Q,ue)=>{if(Q.series[0]==l){let le=k[Q.series[1]],
oe=e[Q.series[1]],J=(le._paths||fo).band;$t(J)&&(J=Q.dir==1?J[0]:J[1]);let $,ve=null;le.show&&J&&iu(oe,Ie,ze)?(ve=Q.fill(o,ue)||w,$=le._paths.clip):J=null,Mr(c,
d,f,y,ve,v,P,C,N,O,$,J),U=!0}}),U||Mr(c,d,f,y,w,v,P,C,N,O)}let Us=Wn|os;function Mr(l,c,d,f,y,w,v,P,C,N,O,U){Ds(l,c,d,f,y),(C||N||U)&&(h.save(),C&&h.clip(C),N&&
h.clip(N)),U?(P&Us)==Us?(h.clip(U),O&&h.clip(O),vo(y,v),xo(l,w,c)):P&os?(vo(y,v),h.clip(U),xo(l,w,c)):P&Wn&&(h.save(),h.clip(U),O&&h.clip(O),vo(y,v),h.restore(),
xo(l,w,c)):(vo(y,v),xo(l,w,c)),(C||N||U)&&h.restore()}function xo(l,c,d){d>0&&(c instanceof Map?c.forEach((f,y)=>{h.strokeStyle=wo=y,h.stroke(f)}):c!=null&&l&&h.
stroke(c))}function vo(l,c){c instanceof Map?c.forEach((d,f)=>{h.fillStyle=wn=f,h.fill(d)}):c!=null&&l&&h.fill(c)}function Xa(l,c,d,f){let y=_[l],w;if(f<=0)w=[0,
0];else{let v=y._space=y.space(o,l,c,d,f),P=y._incrs=y.incrs(o,l,c,d,f,v);w=Ep(c,d,P,f,v)}return y._found=w}function Tr(l,c,d,f,y,w,v,P,C,N){let O=v%2/2;M==1&&h.
translate(O,O),Ds(P,v,C,N,P),h.beginPath();let U,Q,ue,le,oe=y+(f==0||f==3?-w:w);d==0?(Q=y,le=oe):(U=y,ue=oe);for(let J=0;J<l.length;J++)c[J]!=null&&(d==0?U=ue=l[J]:
Q=le=l[J],h.moveTo(U,Q),h.lineTo(ue,le));h.stroke(),M==1&&h.translate(-O,-O)}function ec(l){let c=!0;return _.forEach((d,f)=>{if(!d.show)return;let y=T[d.scale];
if(y.min==null){d._show&&(c=!1,d._show=!1,xn(!1));return}else d._show||(c=!1,d._show=!0,xn(!1));let w=d.side,v=w%2,{min:P,max:C}=y,[N,O]=Xa(f,P,C,v==0?ee:F);if(O==
0)return;let U=y.distr==2,Q=d._splits=d.splits(o,f,P,C,N,O,U),ue=y.distr==2?Q.map($=>xt[$]):Q,le=y.distr==2?xt[Q[1]]-xt[Q[0]]:N,oe=d._values=d.values(o,d.filter(
o,ue,f,O,le),f,O,le);d._rotate=w==2?d.rotate(o,oe,f,O):0;let J=d._size;d._size=bt(d.size(o,oe,f,l)),J!=null&&d._size!=J&&(c=!1)}),c}function tc(l){let c=!0;return _s.
forEach((d,f)=>{let y=d(o,f,en,l);y!=Ht[f]&&(c=!1),Ht[f]=y}),c}function nc(){for(let l=0;l<_.length;l++){let c=_[l];if(!c.show||!c._show)continue;let d=c.side,f=d%
2,y,w,v=c.stroke(o,l),P=d==0||d==3?-1:1,[C,N]=c._found;if(c.label!=null){let Ze=c.labelGap*P,lt=Ne((c._lpos+Ze)*pe);Rs(c.labelFont[0],v,"center",d==2?"top":Li),
h.save(),f==1?(y=w=0,h.translate(lt,Ne(dt+wt/2)),h.rotate((d==3?-Bo:Bo)/2)):(y=Ne(rt+tt/2),w=lt);let on=xl(c.label)?c.label(o,l,C,N):c.label;h.fillText(on,y,w),
h.restore()}if(N==0)continue;let O=T[c.scale],U=f==0?tt:wt,Q=f==0?rt:dt,ue=c._splits,le=O.distr==2?ue.map(Ze=>xt[Ze]):ue,oe=O.distr==2?xt[ue[1]]-xt[ue[0]]:C,J=c.
ticks,$=c.border,ve=J.show?J.size:0,Ee=Ne(ve*pe),Ge=Ne((c.alignTo==2?c._size-ve-c.gap:c.gap)*pe),fe=c._rotate*-Bo/180,Ae=A(c._pos*pe),st=(Ee+Ge)*P,Je=Ae+st;w=f==
0?Je:0,y=f==1?Je:0;let mt=c.font[0],vt=c.align==1?Fn:c.align==2?Gr:fe>0?Fn:fe<0?Gr:f==0?"center":d==3?Gr:Fn,Lt=fe||f==1?"middle":d==2?"top":Li;Rs(mt,v,vt,Lt);let it=c.
font[1]*c.lineGap,gt=ue.map(Ze=>A(a(Ze,O,U,Q))),St=c._values;for(let Ze=0;Ze<St.length;Ze++){let lt=St[Ze];if(lt!=null){f==0?y=gt[Ze]:w=gt[Ze],lt=""+lt;let on=lt.
indexOf(`
`)==-1?[lt]:lt.split(/\n/gm);for(let Qe=0;Qe<on.length;Qe++){let ni=on[Qe];fe?(h.save(),h.translate(y,w+Qe*it),h.rotate(fe),h.fillText(ni,0,0),h.restore()):h.fillText(
ni,y,w+Qe*it)}}}J.show&&Tr(gt,J.filter(o,le,l,N,oe),f,d,Ae,Ee,ye(J.width*pe,3),J.stroke(o,l),J.dash,J.cap);let Dt=c.grid;Dt.show&&Tr(gt,Dt.filter(o,le,l,N,oe),f,
f==0?2:1,f==0?dt:rt,f==0?wt:tt,ye(Dt.width*pe,3),Dt.stroke(o,l),Dt.dash,Dt.cap),$.show&&Tr([Ae],[1],f==0?1:0,f==0?1:2,f==1?dt:rt,f==1?wt:tt,ye($.width*pe,3),$.stroke(
o,l),$.dash,$.cap)}We("drawAxes")}function xn(l){k.forEach((c,d)=>{d>0&&(c._paths=null,l&&(r==1?(c.min=null,c.max=null):c.facets.forEach(f=>{f.min=null,f.max=null})))})}
let So=!1,Pr=!1,Jn=[];function oc(){Pr=!1;for(let l=0;l<Jn.length;l++)We(...Jn[l]);Jn.length=0}function vn(){So||(xu(Is),So=!0)}function rc(l,c=!1){So=!0,Pr=c,l(
o),Is(),c&&Jn.length>0&&queueMicrotask(oc)}o.batch=rc;function Is(){if(fr&&(qa(),fr=!1),hn&&(Wa(),hn=!1),go){if(ke(x,Fn,be),ke(x,"top",Re),ke(x,ao,ee),ke(x,co,F),
ke(b,Fn,be),ke(b,"top",Re),ke(b,ao,ee),ke(b,co,F),ke(g,ao,Ot),ke(g,co,qt),m.width=Ne(Ot*pe),m.height=Ne(qt*pe),_.forEach(({_el:l,_show:c,_size:d,_pos:f,side:y})=>{
if(l!=null)if(c){let w=y===3||y===0?d:0,v=y%2==1;ke(l,v?"left":"top",f-w),ke(l,v?"width":"height",d),ke(l,v?"top":"left",v?Re:be),ke(l,v?"height":"width",v?F:ee),
Qr(l,ln)}else at(l,ln)}),wo=wn=gr=br=wr=xr=vr=Sr=yr=null,nt=1,Xn(!0),be!=fn||Re!=Jt||ee!=Et||F!=Zt){xn(!1);let l=ee/Et,c=F/Zt;if(Ue&&!Qt&&H.left>=0){H.left*=l,H.
top*=c,Sn&&Rt(Sn,Ne(H.left),0,ee,F),kn&&Rt(kn,0,Ne(H.top),ee,F);for(let d=0;d<ht.length;d++){let f=ht[d];f!=null&&(yn[d]*=l,bn[d]*=c,Rt(f,bt(yn[d]),bt(bn[d]),ee,
F))}}if(xe.show&&!yo&&xe.left>=0&&xe.width>0){xe.left*=l,xe.width*=l,xe.top*=c,xe.height*=c;for(let d in Dr)ke(Pn,d,xe[d])}fn=be,Jt=Re,Et=ee,Zt=F}We("setSize"),
go=!1}Ot>0&&qt>0&&(h.clearRect(0,0,m.width,m.height),We("drawClear"),G.forEach(l=>l()),We("draw")),xe.show&&yo&&(ko(xe),yo=!1),Ue&&Qt&&(nn(null,!0,!1),Qt=!1),X.
show&&X.live&&ft&&(_r(),ft=!1),u||(u=!0,o.status=1,We("ready")),qn=!1,So=!1}o.redraw=(l,c)=>{hn=c||!1,l!==!1?Wt(D,E.min,E.max):vn()};function Er(l,c){let d=T[l];
if(d.from==null){if(Be==0){let f=d.range(o,c.min,c.max,l);c.min=f[0],c.max=f[1]}if(c.min>c.max){let f=c.min;c.min=c.max,c.max=f}if(Be>1&&c.min!=null&&c.max!=null&&
c.max-c.min<1e-16)return;l==D&&d.distr==2&&Be>0&&(c.min=Tt(c.min,e[0]),c.max=Tt(c.max,e[0]),c.min==c.max&&c.max++),W[l]=c,fr=!0,vn()}}o.setScale=Er;let Ar,Cr,Sn,
kn,zs,Hs,Mn,Tn,Vs,Ws,we,Te,Vt=!1,$e=H.drag,He=$e.x,Ve=$e.y;Ue&&(H.x&&(Ar=yt(Bc,b)),H.y&&(Cr=yt($c,b)),E.ori==0?(Sn=Ar,kn=Cr):(Sn=Cr,kn=Ar),we=H.left,Te=H.top);let xe=o.
select=Le({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Pn=xe.show?yt(Gc,xe.over?b:x):null;function ko(l,c){if(xe.show){for(let d in l)xe[d]=l[d],d in
Dr&&ke(Pn,d,l[d]);c!==!1&&We("setSelect")}}o.setSelect=ko;function sc(l){if(k[l].show)Pe&&Qr(Me[l],ln);else if(Pe&&at(Me[l],ln),Ue){let d=gn?ht[0]:ht[l];d!=null&&
Rt(d,-10,-10,ee,F)}}function Wt(l,c,d){Er(l,{min:c,max:d})}function Ct(l,c,d,f){c.focus!=null&&uc(l),c.show!=null&&k.forEach((y,w)=>{w>0&&(l==w||l==null)&&(y.show=
c.show,sc(w),r==2?(Wt(y.facets[0].scale,null,null),Wt(y.facets[1].scale,null,null)):Wt(y.scale,null,null),vn())}),d!==!1&&We("setSeries",l,c),f&&eo("setSeries",
o,l,c)}o.setSeries=Ct;function ic(l,c){Le(j[l],c)}function lc(l,c){l.fill=se(l.fill||null),l.dir=ae(l.dir,-1),c=c??j.length,j.splice(c,0,l)}function ac(l){l==null?
j.length=0:j.splice(l,1)}o.addBand=lc,o.setBand=ic,o.delBand=ac;function cc(l,c){k[l].alpha=c,Ue&&ht[l]!=null&&(ht[l].style.opacity=c),Pe&&Me[l]&&(Me[l].style.opacity=
c)}let Ft,Gt,tn,En={focus:!0};function uc(l){if(l!=tn){let c=l==null,d=At.alpha!=1;k.forEach((f,y)=>{if(r==1||y>0){let w=c||y==0||y==l;f._focus=c?null:w,d&&cc(y,
w?1:At.alpha)}}),tn=l,d&&vn()}}Pe&&mn&&qe(Oi,ie,l=>{H._lock||(Xt(l),tn!=null&&Ct(null,En,!0,Ce.setSeries))});function _t(l,c,d){let f=T[c];d&&(l=l/pe-(f.ori==1?
Re:be));let y=ee;f.ori==1&&(y=F,l=y-l),f.dir==-1&&(l=y-l);let w=f._min,v=f._max,P=l/y,C=w+(v-w)*P,N=f.distr;return N==3?zn(10,C):N==4?au(C,f.asinh):N==100?f.bwd(
C):C}function pc(l,c){let d=_t(l,D,c);return Tt(d,e[0],Ie,ze)}o.valToIdx=l=>Tt(l,e[0]),o.posToIdx=pc,o.posToVal=_t,o.valToPos=(l,c,d)=>T[c].ori==0?s(l,T[c],d?tt:
ee,d?rt:0):i(l,T[c],d?wt:F,d?dt:0),o.setCursor=(l,c,d)=>{we=l.left,Te=l.top,nn(null,c,d)};function Gs(l,c){ke(Pn,Fn,xe.left=l),ke(Pn,ao,xe.width=c)}function Bs(l,c){
ke(Pn,"top",xe.top=l),ke(Pn,co,xe.height=c)}let Zn=E.ori==0?Gs:Bs,Qn=E.ori==1?Gs:Bs;function dc(){if(Pe&&X.live)for(let l=r==2?1:0;l<k.length;l++){if(l==0&&te)continue;
let c=X.values[l],d=0;for(let f in c)ot[l][d++].firstChild.nodeValue=c[f]}}function _r(l,c){if(l!=null&&(l.idxs?l.idxs.forEach((d,f)=>{ce[f]=d}):du(l.idx)||ce.fill(
l.idx),X.idx=ce[0]),Pe&&X.live){for(let d=0;d<k.length;d++)(d>0||r==1&&!te)&&fc(d,ce[d]);dc()}ft=!1,c!==!1&&We("setLegend")}o.setLegend=_r;function fc(l,c){let d=k[l],
f=l==0&&Y==2?xt:e[l],y;te?y=d.values(o,l,c)??De:(y=d.value(o,c==null?null:f[c],l,c),y=y==null?De:{_:y}),X.values[l]=y}function nn(l,c,d){Vs=we,Ws=Te,[we,Te]=H.move(
o,we,Te),H.left=we,H.top=Te,Ue&&(Sn&&Rt(Sn,Ne(we),0,ee,F),kn&&Rt(kn,0,Ne(Te),ee,F));let f,y=Ie>ze;Ft=ge,Gt=null;let w=E.ori==0?ee:F,v=E.ori==1?ee:F;if(we<0||Be==
0||y){f=H.idx=null;for(let P=0;P<k.length;P++){let C=ht[P];C!=null&&Rt(C,-10,-10,ee,F)}mn&&Ct(null,En,!0,l==null&&Ce.setSeries),X.live&&(ce.fill(f),ft=!0)}else{
let P,C,N;r==1&&(P=E.ori==0?we:Te,C=_t(P,D),f=H.idx=Tt(C,e[0],Ie,ze),N=I(e[0][f],E,w,0));let O=-10,U=-10,Q=0,ue=0,le=!0,oe="",J="";for(let $=r==2?1:0;$<k.length;$++){
let ve=k[$],Ee=ce[$],Ge=Ee==null?null:r==1?e[$][Ee]:e[$][1][Ee],fe=H.dataIdx(o,$,f,C),Ae=fe==null?null:r==1?e[$][fe]:e[$][1][fe];if(ft=ft||Ae!=Ge||fe!=Ee,ce[$]=
fe,$>0&&ve.show){let st=fe==null?-10:fe==f?N:I(r==1?e[0][fe]:e[$][0][fe],E,w,0),Je=Ae==null?-10:K(Ae,r==1?T[ve.scale]:T[ve.facets[1].scale],v,0);if(mn&&Ae!=null){
let mt=E.ori==1?we:Te,vt=Oe(At.dist(o,$,fe,Je,mt));if(vt<Ft){let Lt=At.bias;if(Lt!=0){let it=_t(mt,ve.scale),gt=Ae>=0?1:-1,St=it>=0?1:-1;St==gt&&(St==1?Lt==1?Ae>=
it:Ae<=it:Lt==1?Ae<=it:Ae>=it)&&(Ft=vt,Gt=$)}else Ft=vt,Gt=$}}if(ft||gn){let mt,vt;E.ori==0?(mt=st,vt=Je):(mt=Je,vt=st);let Lt,it,gt,St,Dt,Ze,lt=!0,on=Ye.bbox;if(on!=
null){lt=!1;let Qe=on(o,$);gt=Qe.left,St=Qe.top,Lt=Qe.width,it=Qe.height}else gt=mt,St=vt,Lt=it=Ye.size(o,$);if(Ze=Ye.fill(o,$),Dt=Ye.stroke(o,$),gn)$==Gt&&Ft<=
At.prox&&(O=gt,U=St,Q=Lt,ue=it,le=lt,oe=Ze,J=Dt);else{let Qe=ht[$];Qe!=null&&(yn[$]=gt,bn[$]=St,Wi(Qe,Lt,it,lt),Hi(Qe,Ze,Dt),Rt(Qe,bt(gt),bt(St),ee,F))}}}}if(gn){
let $=At.prox,ve=tn==null?Ft<=$:Ft>$||Gt!=tn;if(ft||ve){let Ee=ht[0];Ee!=null&&(yn[0]=O,bn[0]=U,Wi(Ee,Q,ue,le),Hi(Ee,oe,J),Rt(Ee,bt(O),bt(U),ee,F))}}}if(xe.show&&
Vt)if(l!=null){let[P,C]=Ce.scales,[N,O]=Ce.match,[U,Q]=l.cursor.sync.scales,ue=l.cursor.drag;if(He=ue._x,Ve=ue._y,He||Ve){let{left:le,top:oe,width:J,height:$}=l.
select,ve=l.scales[U].ori,Ee=l.posToVal,Ge,fe,Ae,st,Je,mt=P!=null&&N(P,U),vt=C!=null&&O(C,Q);mt&&He?(ve==0?(Ge=le,fe=J):(Ge=oe,fe=$),Ae=T[P],st=I(Ee(Ge,U),Ae,w,
0),Je=I(Ee(Ge+fe,U),Ae,w,0),Zn(Pt(st,Je),Oe(Je-st))):Zn(0,w),vt&&Ve?(ve==1?(Ge=le,fe=J):(Ge=oe,fe=$),Ae=T[C],st=K(Ee(Ge,Q),Ae,v,0),Je=K(Ee(Ge+fe,Q),Ae,v,0),Qn(Pt(
st,Je),Oe(Je-st))):Qn(0,v)}else Rr()}else{let P=Oe(Vs-zs),C=Oe(Ws-Hs);if(E.ori==1){let Q=P;P=C,C=Q}He=$e.x&&P>=$e.dist,Ve=$e.y&&C>=$e.dist;let N=$e.uni;N!=null?
He&&Ve&&(He=P>=N,Ve=C>=N,!He&&!Ve&&(C>P?Ve=!0:He=!0)):$e.x&&$e.y&&(He||Ve)&&(He=Ve=!0);let O,U;He&&(E.ori==0?(O=Mn,U=we):(O=Tn,U=Te),Zn(Pt(O,U),Oe(U-O)),Ve||Qn(
0,v)),Ve&&(E.ori==1?(O=Mn,U=we):(O=Tn,U=Te),Qn(Pt(O,U),Oe(U-O)),He||Zn(0,w)),!He&&!Ve&&(Zn(0,0),Qn(0,0))}if($e._x=He,$e._y=Ve,l==null){if(d){if(ti!=null){let[P,
C]=Ce.scales;Ce.values[0]=P!=null?_t(E.ori==0?we:Te,P):null,Ce.values[1]=C!=null?_t(E.ori==1?we:Te,C):null}eo(Br,o,we,Te,ee,F,f)}if(mn){let P=d&&Ce.setSeries,C=At.
prox;tn==null?Ft<=C&&Ct(Gt,En,!0,P):Ft>C?Ct(null,En,!0,P):Gt!=tn&&Ct(Gt,En,!0,P)}}ft&&(X.idx=f,_r()),c!==!1&&We("setCursor")}let Bt=null;Object.defineProperty(o,
"rect",{get(){return Bt==null&&Xn(!1),Bt}});function Xn(l=!1){l?Bt=null:(Bt=b.getBoundingClientRect(),We("syncRect",Bt))}function $s(l,c,d,f,y,w,v){H._lock||Vt&&
l!=null&&l.movementX==0&&l.movementY==0||(Lr(l,c,d,f,y,w,v,!1,l!=null),l!=null?nn(null,!0,!0):nn(c,!0,!1))}function Lr(l,c,d,f,y,w,v,P,C){if(Bt==null&&Xn(!1),Xt(
l),l!=null)d=l.clientX-Bt.left,f=l.clientY-Bt.top;else{if(d<0||f<0){we=-10,Te=-10;return}let[N,O]=Ce.scales,U=c.cursor.sync,[Q,ue]=U.values,[le,oe]=U.scales,[J,
$]=Ce.match,ve=c.axes[0].side%2==1,Ee=E.ori==0?ee:F,Ge=E.ori==1?ee:F,fe=ve?w:y,Ae=ve?y:w,st=ve?f:d,Je=ve?d:f;if(le!=null?d=J(N,le)?a(Q,T[N],Ee,0):-10:d=Ee*(st/fe),
oe!=null?f=$(O,oe)?a(ue,T[O],Ge,0):-10:f=Ge*(Je/Ae),E.ori==1){let mt=d;d=f,f=mt}}C&&(c==null||c.cursor.event.type==Br)&&((d<=1||d>=ee-1)&&(d=rn(d,ee)),(f<=1||f>=
F-1)&&(f=rn(f,F))),P?(zs=d,Hs=f,[Mn,Tn]=H.move(o,d,f)):(we=d,Te=f)}let Dr={width:0,height:0,left:0,top:0};function Rr(){ko(Dr,!1)}let js,Ks,Ys,qs;function Js(l,c,d,f,y,w,v){
Vt=!0,He=Ve=$e._x=$e._y=!1,Lr(l,c,d,f,y,w,v,!0,!1),l!=null&&(qe($r,Jr,Zs,!1),eo(Ri,o,Mn,Tn,ee,F,null));let{left:P,top:C,width:N,height:O}=xe;js=P,Ks=C,Ys=N,qs=O}
function Zs(l,c,d,f,y,w,v){Vt=$e._x=$e._y=!1,Lr(l,c,d,f,y,w,v,!1,!0);let{left:P,top:C,width:N,height:O}=xe,U=N>0||O>0,Q=js!=P||Ks!=C||Ys!=N||qs!=O;if(U&&Q&&ko(xe),
$e.setScale&&U&&Q){let ue=P,le=N,oe=C,J=O;if(E.ori==1&&(ue=C,le=O,oe=P,J=N),He&&Wt(D,_t(ue,D),_t(ue+le,D)),Ve)for(let $ in T){let ve=T[$];$!=D&&ve.from==null&&ve.
min!=ge&&Wt($,_t(oe+J,$),_t(oe,$))}Rr()}else H.lock&&(H._lock=!H._lock,nn(c,!0,l!=null));l!=null&&(dn($r,Jr),eo($r,o,we,Te,ee,F,null))}function hc(l,c,d,f,y,w,v){
if(H._lock)return;Xt(l);let P=Vt;if(Vt){let C=!0,N=!0,O=10,U,Q;E.ori==0?(U=He,Q=Ve):(U=Ve,Q=He),U&&Q&&(C=we<=O||we>=ee-O,N=Te<=O||Te>=F-O),U&&C&&(we=we<Mn?0:ee),
Q&&N&&(Te=Te<Tn?0:F),nn(null,!0,!0),Vt=!1}we=-10,Te=-10,ce.fill(null),nn(null,!0,!0),P&&(Vt=P)}function Qs(l,c,d,f,y,w,v){H._lock||(Xt(l),mr(),Rr(),l!=null&&eo(
Fi,o,we,Te,ee,F,null))}function Xs(){_.forEach(Ap),hr(o.width,o.height,!0)}an($o,In,Xs);let An={};An.mousedown=Js,An.mousemove=$s,An.mouseup=Zs,An.dblclick=Qs,An.
setSeries=(l,c,d,f)=>{let y=Ce.match[2];d=y(o,c,d),d!=-1&&Ct(d,f,!0,!1)},Ue&&(qe(Ri,b,Js),qe(Br,b,$s),qe(Ni,b,l=>{Xt(l),Xn(!1)}),qe(Oi,b,hc),qe(Fi,b,Qs),rs.add(
o),o.syncRect=Xn);let Mo=o.hooks=t.hooks||{};function We(l,c,d){Pr?Jn.push([l,c,d]):l in Mo&&Mo[l].forEach(f=>{f.call(null,o,c,d)})}(t.plugins||[]).forEach(l=>{
for(let c in l.hooks)Mo[c]=(Mo[c]||[]).concat(l.hooks[c])});let ei=(l,c,d)=>d,Ce=Le({key:null,setSeries:!1,filters:{pub:Ki,sub:Ki},scales:[D,k[1]?k[1].scale:null],
match:[Yi,Yi,ei],values:[null,null]},H.sync);Ce.match.length==2&&Ce.match.push(ei),H.sync=Ce;let ti=Ce.key,Nr=Bl(ti);function eo(l,c,d,f,y,w,v){Ce.filters.pub(l,
c,d,f,y,w,v)&&Nr.pub(l,c,d,f,y,w,v)}Nr.sub(o);function mc(l,c,d,f,y,w,v){Ce.filters.sub(l,c,d,f,y,w,v)&&An[l](null,c,d,f,y,w,v)}o.pub=mc;function gc(){Nr.unsub(
o),rs.delete(o),Yt.clear(),Xr($o,In,Xs),p.remove(),ie?.remove(),We("destroy")}o.destroy=gc;function Or(){We("init",t,e),Ls(e||t.data,!1),W[D]?Er(D,W[D]):mr(),yo=
xe.show&&(xe.width>0||xe.height>0),Qt=ft=!0,hr(t.width,t.height)}return k.forEach(Cs),_.forEach(Ya),n?n instanceof HTMLElement?(n.appendChild(p),Or()):n(o,Or):Or(),
o}Fe.assign=Le;Fe.fmtNum=ps;Fe.rangeNum=jo;Fe.rangeLog=qo;Fe.rangeAsinh=cs;Fe.orient=un;Fe.pxRatio=pe;Fe.join=wu;Fe.fmtDate=fs,Fe.tzDate=_u;Fe.sync=Bl;{Fe.addGap=
dp,Fe.clipGaps=Qo;let t=Fe.paths={points:Jl};t.linear=Ql,t.stepped=mp,t.bars=gp,t.spline=bp}var nr=128,na=50,Cp=.25,_p=t=>[t.ray,t.truth,t.sensor,t.noReturn],or=(t,e)=>({font:Ur,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function oa(t,e,n){let o=null,r=null,s=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&s()>0&&o.setSize({width:s(),height:nr})).
observe(t),i=>s()<=0?null:((!o||i||r!==n())&&(o?.destroy(),o=e(),o.setSize({width:s(),height:nr}),r=n()),o)}function ra(t,e){let{session:n}=t,o=S("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),r="all",s=t.segmented("Trace",[["all","All sweeps"],["first",`First ${na}`]],()=>r,b=>{r=b,p=null,n.
changed()}),i=0,a=-1/0,u=-1,p=null,h=oa(o,()=>{let b=_p(e()),M=Array.from({length:i},(A,L)=>({label:`chain ${L+1}`,stroke:b[L%b.length],width:1,points:{show:!1}}));
return new Fe({width:100,height:nr,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(A,L,k)=>[L,Math.max(k,L+1)]},y:{
range:(A,L,k)=>Rp(Math.max(L,a),k)}},axes:[or(e,26),or(e,52)],series:[{label:"sweep"},...M],hooks:{draw:[A=>Np(A,u,e())]}},[[],...M.map(()=>[])],o)},e),g=S("spa\
n",{className:"caption",textContent:"log joint by sweep"}),x=S("div",{className:"charted"},S("div",{className:"buttons"},s,g),o);return t.each(()=>{let b=n.shown,
M=b?.traced?.length?b.trace.length/b.traced.length:0;if(V(x,"hidden",M===0),!b||!M)return;let A=b.layer==="draw"&&n.draws.count?(n.draw+1)*b.sweeps/n.draws.count:
-1,L=h(M!==i&&(i=M,!0));L&&(p===b&&u===A&&L.data[0].length||([p,u]=[b,A],a=r==="all"?Dp(b,M):-1/0,L.setData(Lp(b,M,r))))}),x}function Lp({trace:t,traced:e},n,o){
let r=o==="all"?e.length:e.filter(s=>s<=na).length;return[e.slice(0,r),...Array.from({length:n},(s,i)=>t.slice(i*e.length,i*e.length+r))]}function Dp({trace:t,traced:e},n){
let o=e.length,r=e.findIndex(s=>s>=Cp*e[o-1]);return Math.min(...Array.from({length:n},(s,i)=>Math.min(...t.slice(i*o+r,(i+1)*o))))}function Rp(t,e){let n=Math.
max(.06*(e-t),.5);return[t-n,e+n]}function Np(t,e,n){if(e<0)return;let{left:o,top:r,width:s,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+s||(t.ctx.save(),t.
ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,r,2,i),t.ctx.restore())}function sa(t,e){let{session:n}=t,o=S("div",{className:"chart",role:"img","aria-label":"Histogra\
m of the particles' weights"}),r=S("div",{className:"caption",textContent:"particles by weight, nats below the heaviest"}),s=S("div",{className:"charted"},r,o),
a=oa(o,()=>new Fe({width:100,height:nr,legend:{show:!1},cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(p,m,h)=>[m,h]},y:{distr:3,range:(p,m,h)=>[
.5,Math.max(10,2*h)]}},axes:[or(e,26),{...or(e,52),values:(p,m)=>m.map(h=>h>=1?String(h):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Fe.paths.bars?.({size:[
.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),u=null;return t.each(()=>{let p=n.shown;V(s,"hidden",!p?.weights);let m=p?.weights&&a(!1);if(!p?.weights||!m||
u===p&&m.data[0].length)return;u=p;let h=[...p.weights],g=-(p.lowest??-1)/h.length,x=[...h.map((b,M)=>(p.lowest??-1)+M*g),0];m.setData([x,[...h.map(b=>b||null),
null]])}),s}var Op=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Fp=["Draw walls, and drag the robot: a beam reads the first wall that it \
hits, with noise. Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (draw), and where doubt remains\
 (entropy). No beam has been where it is hatched.","While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact\
 in the long run."],Up="Mouse: the wheel zooms, the middle button pans, Shift or the right button erases, and so does a click on a wall. Touch: two fingers zoom\
 and pan.";function ia(t){let e=yi.map(([o,r])=>S("tr",{},S("th",{scope:"row"},S("kbd",{textContent:o})),S("td",{textContent:r}))),n=Fp.map(o=>S("p",{textContent:o}));
return t.dialog("Help",...n,S("table",{},S("tbody",{},...e)),S("p",{textContent:Up}))}function la(t){let e=()=>S("input",{type:"number",min:_e.cells[0],max:_e.cells[1],
step:1,required:!0,value:"21"}),[n,o]=[e(),e()],r=S("select",{});for(let[i,a]of Op)r.append(S("option",{value:i,textContent:a}));r.addEventListener("change",()=>{
r.value==="building"&&Number(n.value)<60&&([n.value,o.value]=["120","80"])});let s=S("form",{method:"dialog"},t.row("World",r),t.row("Width (cells)",n),t.row("H\
eight (cells)",o),S("div",{className:"buttons end"},S("button",{type:"submit",className:"primary",textContent:"Create"})));return s.addEventListener("submit",()=>{
t.session.act({type:"new",shape:[Number(n.value),Number(o.value)],world:r.value}),t.hand.selected=null}),t.dialog("New map",s)}function aa(t){let e=S("input",{type:"\
text",readOnly:!0,"aria-label":"Link"}),n=S("span",{role:"status",className:"copied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{
document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},r=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),i=t.
dialog("Share",S("p",{textContent:"The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server r\
uns; the part from # on can be put after the address of any bayesmap page."}),S("div",{className:"buttons"},e,r),n);return{dialog:i,show(a){e.value=a,i.showModal(),
e.select()}}}function ca(t){let{session:e}=t,n=S("span",{className:"what"});t.each(()=>{let{grid:p,source:m}=e.document??{};if(!p||!m)return;let h=`${p.shape[0]} × ${p.shape[1]}\
 cells of ${+p.resolution.toPrecision(3)} m`;V(n,"textContent",m.name?`${m.name}, ${h}`:h)});let o=()=>!e.recorded&&!!e.document,r=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),S("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let p of r)t.visible(p,()=>!e.recorded);let s=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=S("span",{className:"space"});return{element:S("header",{},S("h1",{textContent:"bayesmap"}),n,a,...r,zp(t),s,
i),nameTheme(p){let m=`Theme: ${p}`;kt(s,"aria-label",m),V(s,"title",m)}}}var Ip=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function zp(t){
let{session:e}=t,n=(a,u,p,m)=>{let h=t.button(null,a,()=>t.command(`export ${u}`),{text:a,when:m});return p&&t.visible(h,()=>!e.recorded),h},o=S("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>Ip(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),r=t.button("save","Export",()=>s(o.hidden),{text:"Export",when:()=>!!e.document}),s=a=>{o.hidden=!a,r.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};s(!1);let i=S("div",{className:"anchor"},r,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(s(!1),r.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||s(!1)}),o.addEventListener("click",()=>{s(!1),r.
focus()}),i}var Hp={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 \
9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M1\
5.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",
grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"\
M6 6l12 12M18 6L6 18"};function Kt(t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg",
"path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true"),n.setAttribute("d",Hp[t]),e.append(n),e}var Vp=[["truth","true wall"],["ray","ray"],["miss","no return"],["dot","reading"],["sensor","sensor"],["unobserved","unobserved"]];function ua(t,e){let{session:n}=t,
o=S("span",{className:"ramp"}),r=S("span"),s=Vp.map(([a,u])=>{let p=S("i",{className:a});return a==="sensor"&&p.append(Kt("sensor")),S("li",{},p,u)});t.visible(
s[0],()=>!n.document||n.document.source.kind==="simulation");let i="";return t.each(()=>{let a=n.view.layer==="entropy";V(r,"textContent",a?"entropy (bit)":"P(w\
all)");let u=`${a} ${e().ground}`;i!==u&&(i=u,o.style.background=Mi(a?Vr:p=>Hr(e(),p)))}),S("ul",{className:"legend","aria-label":"Legend"},S("li",{},r,"0",o,"1"),
...s)}var Wp="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.";function fa(t){
let{session:e}=t,n=S("span",{className:"chip"}),o=t.button(null,"Not converged",()=>pa(e)?.apply(),{text:"Not converged",className:"chip doubt"}),r=S("div",{className:"\
chips"},n,o);return t.each(()=>{let s=pa(e);V(o,"hidden",!s),s&&(V(o.firstElementChild,"textContent",`not converged: ${s.text}`),V(o,"title",`${e.shown?.verdict?.
why}. Click to ${s.text}.`),kt(o,"aria-label",`Not converged: ${s.text}`));let i=e.shown;if(!i||!e.document)return V(r,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",u=i.layer==="draw"?a:e.view.layer==="entropy"?"entropy":"mean",p={importance:"importance sampling",propagate:"belief propaga\
tion"}[i.method],m=i.approximate?"approximate, belief propagation":p??`${i.sweeps} sweeps`;V(r,"hidden",!1),V(n,"textContent",`${u} · ${m}`),V(n,"className",i.
approximate?"chip approximate":"chip")}),r}function pa(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n||t.recorded||n.source.kind==="run")return null;
let o=s=>()=>t.act({type:"set",patch:s});if(e.method==="gibbs"&&n.source.kind==="simulation")return{text:"try blocks",apply:o({method:"block"})};if(e.method==="\
importance")return{text:"try Gibbs",apply:o({method:"auto"})};if(t.sampling)return null;let r=Math.min(_e.sweeps[1],4*n.sweeps);return r>n.sweeps?{text:`try ${r}\
 sweeps`,apply:o({sweeps:r})}:null}function ha(t){let{session:e}=t,n=S("span"),o=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),
r=S("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let s=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.
retryIn_ms??0)/1e3));V(r,"hidden",!s&&e.worker!=="restarted"),V(r,"className",s?"banner":"banner mild"),V(o,"hidden",!s);let a=`Connection lost. Trying again in\
 ${i} s; the map is kept here.`,u=e.connection.refused?Wp:a;V(n,"textContent",s?u:"The worker stopped and is being started again. The map is kept.")}),r}function ma(t){
let{session:e,hand:n}=t,o=S("div",{className:"readout",id:`${t.prefix}-readout`}),r=S("span",{role:"status","aria-live":"polite"}),s=S("span",{className:"hidden",
"aria-live":"polite"});return n.announce=i=>V(s,"textContent",i),n.describe=i=>da(e,i),t.each(()=>{let i=n.cursor??n.hover,u=e.editable&&!matchMedia("(pointer: \
coarse)").matches?"Point at a cell, or press ? for the keys":"Point at a cell";V(o,"textContent",i?da(e,i):u);let p=e.status.text==="Ready"&&e.shown?.verdict?.level===
"bad";V(r,"textContent",p?"Ready, but the chains have not converged":e.status.text),V(r,"className",p?"warning":e.status.level)}),{element:S("footer",{},r,o,s),
readout:o}}function da(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:r,shape:s}=n.grid,i=e.x*s[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(r))+1),{
x:u,y:p}=Co(e,n.grid),m=[`Cell ${e.x}, ${e.y}`,`${u.toFixed(a)}, ${p.toFixed(a)} m`];if(o&&o.p.length===s[0]*s[1]){let h=o.p[i]/255;o.layer==="draw"?m.push(h>.5?
"wall in this draw":"free in this draw"):m.push(`P(wall) ${h.toFixed(2)}`,`entropy ${_o(h).toFixed(2)} bit`);let g=t.cell?.x===e.x&&t.cell.y===e.y?t.cell.beams:
null;o.observed[i]?g!==null&&m.push(g===1?"1 beam":`${g} beams`):m.push("unobserved")}return m.join(" · ")}var xs=t=>t.charAt(0).toUpperCase()+t.slice(1),rr=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=xs(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var Gp={importance:"particles",propagate:"rounds"};function ga(t,...e){let{session:n}=t,o=S("progress",{max:1,value:0,"aria-label":"Progress"}),r=S("div",{className:"\
doing"});return t.each(()=>{let s=n.shown,i=s&&s.total>0&&!s.approximate?s.sweeps/s.total:0;V(o,"value",i);let a=n.remaining_s(),u=Gp[s?.method??""]??"sweeps",p=s&&
!s.approximate&&s.total?`${s.sweeps} of ${s.total} ${u}`:"",m=a!==null?a<1?"less than 1 s left":`${Math.ceil(a)} s left`:n.running?"running":"";V(r,"textContent",
xs([p,m].filter(Boolean).join(", "))||"No chain yet")}),t.section("Posterior",Bp(t),o,r,$p(t),jp(t),...e)}function Bp(t){let{session:e}=t,n=t.button("play","Run",
()=>e.act({type:"run"}),{className:"primary",text:"Run",title:"Run (R)"}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (E\
scape)",when:()=>e.running||e.sampling}),r=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chain"),s=S("div",{
className:"buttons"},n,o,r);return t.visible(s,()=>!e.recorded&&e.document?.source.kind!=="run"),s}function $p(t){let{session:e}=t,n=S("dl"),o=(r,s,i,a=!1)=>{let u=S(
"dd",{textContent:"–"});n.append(S("div",{title:s},S("dt",{textContent:r}),u)),t.each(()=>{V(u,"textContent",e.shown?i(e.shown):"–"),a&&V(u,"className",e.shown?.
verdict?.level??"")})};return o("ESS","Effective sample size of the log joint",r=>io(r.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",
r=>io(r.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",r=>io(r.log_joint,1)),o("reply","From the hand's last move to its picture",()=>io(
e.latency.eventToPaint_ms.at(-1),0," ms")),n}function jp(t){let{session:e}=t,n=S("div",{className:"verdict"});return t.each(()=>{let o=e.shown?.verdict;if(V(n,"\
hidden",!o),!o)return;let r={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];V(n,"textContent",`${r}: ${o.why}`),V(n,"className",`verdict\
 ${o.level}`)}),n}var Kp={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Yp={
noisy:"with noise",exact:"exact"},qp={auto:"as is best",prior:"draws of the prior",empty:"the empty map"},Jp={raster:"raster",radial:"radial",random:"random"},sr=2*
Math.PI,Zp=t=>Math.round(t*1800/Math.PI)/10,Qp={importance:"Particles",propagate:"Rounds"};function ya(t){let{session:e,hand:n,editor:o}=t,r=S("select",{"aria-l\
abel":"Selected sensor"});r.addEventListener("change",()=>{n.selected=Number(r.value),n.choose("sensor")});let s="";t.each(()=>{let h=e.document?.sensors??[],g=h.
map(x=>x.id).join();g!==s&&r.replaceChildren(...h.map(({id:x})=>S("option",{value:String(x),textContent:`Sensor ${x}`}))),s=g,V(r,"value",String(n.sensor?.id??""))});
let i=(h,g)=>t.numberInput(h,()=>Number((n.sensor?.[g]??0).toFixed(2)),x=>n.sensor&&o.moveSensor(n.sensor,{[g]:x}),{step:"any"}),a=t.numberInput("heading (°)",
()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),h=>n.sensor&&o.moveSensor(n.sensor,{yaw:h%360*Math.PI/180}),{step:5}),u=t.button("plus","Add a sensor",()=>t.command(
"add"),{text:"Add"}),p=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.
document?.fov??sr)<sr);let m=S("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",S("div",{className:"buttons"},r,u,p),m)}function ba(t){
let{session:e}=t,[n,o]=_e.max_range,[r,s]=_e.fov_deg,i=t.numberInput("Longest range (m)",()=>e.document?.max_range??0,p=>t.set({max_range:p}),{min:n,max:o,step:"\
any"}),a=[t.slider("noise",()=>"Noise (m)",{low:_e.noise[0],high:_e.noise[1],step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{low:_e.angles[0],high:_e.angles[1],
step:1,log:!0}),i,t.numberInput("Field of view (°)",()=>Zp(e.document?.fov??sr),p=>t.set({fov:p>=s?sr:p*Math.PI/180}),{min:r,max:s,step:5}),t.select("Readings",
Yp,()=>e.document?.readings??"noisy",p=>t.set({readings:p}))];for(let p of a)t.visible(p,()=>e.editable);let u=t.slider("prior",()=>"Prior P(wall)",{low:_e.prior[0],
high:_e.prior[1],step:.01});return t.section("Model",u,...a)}function wa(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>/auto|gibbs|block/.test(n()),
[r,s]=_e.seed;return t.section("Inference",t.select("Method",Kp,n,i=>t.set({method:i})),t.select("Order",Jp,()=>e.document?.order??"radial",i=>t.set({order:i}),
()=>n()==="gibbs"||n()==="auto"),t.select("Start",qp,()=>e.document?.start??"auto",i=>t.set({start:i}),o),t.slider("sweeps",()=>Qp[n()]??"Sweeps",{low:_e.sweeps[0],
high:_e.sweeps[1],step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,i=>t.set({seed:Math.round(i)}),{min:r,max:s,step:1}))}function xa(t){let{session:e}=t,
n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),o=t.button(null,"Clear inference",()=>e.act({type:"\
clear",what:"inference"}),{text:"Clear inference"});return t.section("Clear",S("div",{className:"buttons"},n,o))}var Xp=0,ir=class{constructor(e,n,o,r,s,i){this.session=e;this.hand=n;this.editor=o;this.command=r;this.showLayer=s;this.embedded=i}prefix=`bayesmap${Xp++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}endDrag(){
this.drag++}visible(e,n){this.each(()=>V(e,"hidden",!n()))}button(e,n,o,{className:r="",text:s="",when:i,title:a}={}){let u=S("button",{type:"button",className:r,
title:a??n,onclick:o},e&&Kt(e));return s&&u.append(S("span",{textContent:s})),s!==n&&u.setAttribute("aria-label",n),i&&this.each(()=>V(u,"disabled",!i())),u}segmented(e,n,o,r,s){
let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=S("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[u,p,m]of n){let h=S("input",{type:"rad\
io",name:i,value:u,onchange:()=>r(u)});a.append(S("label",{title:p},h,m?Kt(m):null,S("span",{textContent:p}))),this.each(()=>{V(h,"checked",o()===u),s&&V(h,"dis\
abled",!s(u))})}return a}section(e,...n){let o=`${this.prefix}-${e}`;return S("section",{"aria-labelledby":o},S("h2",{id:o,textContent:e}),...n)}row(e,n){return n.
id=`${this.prefix}-${e.replace(/\W/g,"")}`,S("div",{className:"row"},S("label",{for:n.id,textContent:e}),n)}slider(e,n,{low:o,high:r,step:s,log:i=!1,unit:a=""}){
let u=`${this.prefix}-${e}`,p=b=>i?1e3*Math.log(b/o)/Math.log(r/o):b,m=b=>{if(!i)return b;let M=o*(r/o)**(b/1e3),A=M<100?1:10**(Math.floor(Math.log10(M))-1);return Se(
Math.round(M/A)*A,o,r)},h=S("label",{for:u}),g=S("input",{type:"range",id:u,...i?{min:0,max:1e3,step:1}:{min:o,max:r,step:s}}),x=S("input",{type:"number",min:String(
o),max:String(r),step:String(s)});return g.addEventListener("input",()=>this.set({[e]:m(Number(g.value))})),g.addEventListener("change",()=>this.endDrag()),x.addEventListener(
"change",()=>{let b=Number(x.value);x.value===""||!Number.isFinite(b)?x.value=String(this.session.document?.[e]):this.set({[e]:i?Math.round(Se(b,o,r)):Se(b,o,r)}),
this.endDrag()}),this.each(()=>{let b=this.session.document?.[e]??o;V(h,"textContent",n()),kt(x,"aria-label",`${n()}, number`),m(Number(g.value))!==b&&(g.value=
String(p(b))),kt(g,"aria-valuetext",`${b}${a}`);let M=100*(p(b)-Number(g.min))/(Number(g.max)-Number(g.min));g.style.setProperty("--fill",`${Se(M,0,100)}%`),so(
x)||V(x,"value",String(b))}),S("div",{className:"row slider"},h,g,x)}select(e,n,o,r,s){let i=S("select",{onchange:()=>r(i.value)});for(let[a,u]of Object.entries(
n))i.append(S("option",{value:a,textContent:u}));return this.each(()=>{V(i,"value",o()),s&&V(i,"disabled",!s())}),this.row(e,i)}numberInput(e,n,o,r={}){let s=S(
"input",{type:"number",...r}),{min:i=-1/0,max:a=1/0}=r;return s.addEventListener("change",()=>{s.value!==""&&Number.isFinite(Number(s.value))&&o(Se(Number(s.value),
i,a))}),this.each(()=>{so(s)||V(s,"value",String(n()))}),this.row(e,s)}checkbox(e,n,o,r=""){let s=S("input",{type:"checkbox",onchange:()=>o(s.checked)});return this.
each(()=>V(s,"checked",n())),S("label",{className:"check",title:r},s,S("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,
r=S("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},Kt("close")),s=S("div",{className:"title"},S("h2",{id:o,textContent:e}),
r),i=S("dialog",{"aria-labelledby":o},s,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),
i}};var ed=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"]],td={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},lr=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;showLayer(e){
if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.
view.chain){this.session.act({type:"view",layer:"draw",chain:n,draw:e})}play(e){if(this.playing=e,e){let{draw:n,draws:o}=this.session;this.showDraw(n>=o.count-1?
0:n)}this.session.changed()}playFromStart(){this.showDraw(0),this.playing=!0,this.session.changed()}step(){!this.playing||this.session.shown?.layer!=="draw"||setTimeout(
()=>{if(!this.playing)return;let{draw:e,draws:n}=this.session;e+1>=n.count?this.play(!1):this.showDraw(e+1)},1e3/this.drawsPerSecond)}};function va(t,e,n){let{session:o}=t,
r=t.segmented("Show",ed,()=>o.view.layer,u=>e.showLayer(u),u=>u!=="draw"||o.hasDraws),s=(u,p)=>t.checkbox(u,()=>n[p],m=>{n[p]=m,o.changed()}),i=s("True walls","\
truth");t.visible(i,()=>!o.document||o.document.source.kind==="simulation");let a=S("div",{className:"checks",role:"group","aria-label":"Marks"},i,s("Rays","ray\
s"),s("Readings","readings"));return t.section("View",r,nd(t,e),a)}function nd(t,e){let{session:n}=t,o=S("input",{type:"range",min:0,step:1,"aria-label":"Draw n\
umber"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let r=t.button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.
count>1}),s=S("output"),i=S("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:p,count:m}=n.
draws;V(o,"max",String(Math.max(0,m-1))),V(o,"disabled",m===0),V(o,"value",String(n.draw));let h=m?`${n.draw+1} of ${m}`:"none kept";kt(o,"aria-valuetext",h),o.
style.setProperty("--fill",`${m>1?100*n.draw/(m-1):0}%`),V(s,"textContent",h),i.length!==Math.max(1,p)&&i.replaceChildren(...Array.from({length:Math.max(1,p)},(x,b)=>S(
"option",{value:String(b),textContent:`chain ${b+1}`}))),V(i,"value",String(n.view.chain)),V(i,"disabled",p<2),m<2&&e.playing&&e.play(!1);let g=e.playing?"Pause\
 the draws":"Play the draws";r.getAttribute("aria-label")!==g&&(r.setAttribute("aria-label",g),r.replaceChildren(Kt(e.playing?"pause":"play")))});let a=S("selec\
t",{"aria-label":"Speed"});for(let[p,m]of Object.entries(td))a.append(S("option",{value:p,textContent:m}));a.value=String(e.drawsPerSecond),a.addEventListener("\
change",()=>e.drawsPerSecond=Number(a.value));let u=t.button(null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1});
return t.each(()=>V(a,"disabled",n.draws.count<2)),S("div",{className:"player"},r,o,s,S("div",{className:"buttons wide"},i,a,u))}function Sa(t){let{session:e}=t,
n=S("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=S("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let r=t.
section("Scan",S("div",{className:"player bare"},n,o));return t.each(()=>{let s=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;V(r,"hidden",
s<2),V(n,"max",String(Math.max(0,s-1))),so(n)||V(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,s-1)}%`),V(o,
"textContent",`${Number(n.value)+1} / ${s}`)}),r}function ka(t,e,n){let{shown:o,status:r}=t,s=o?.layer==="draw"?"draw":t.view.layer==="entropy"?"entropy":"mean";return{document:t.effectiveDocument(),generation:t.
generation,painted:o&&{generation:o.generation,layer:s,approximate:o.approximate,sweeps:o.sweeps,method:o.method,rhat:o.rhat,verdict:o.verdict,trace:o.trace,traced:o.
traced,weights:o.weights,ess:o.ess,chain:o.chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(0),walls:t.walls,sensors:t.
document?.sensors??[],scan:t.scan,status:{text:r.text,level:r.level},connected:t.connection.connected,worker:t.worker,running:t.running,draws:t.draws,view:t.view,
seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var Ma="bayesmap-token",vs="bayesmap-kept";function od(t){try{return localStorage.getItem(t)}catch{return null}}function Ss(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function ks(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Ss(vs,JSON.stringify(t))}function Ta(){
Ss(vs,null)}function Pa(){let t=od(vs);try{return t&&JSON.parse(t)}catch{return null}}function Ea(t){t&&Ss(Ma,t)}function Aa(t){let e=n=>{n.key===Ma&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var Ca=new Set(["walls","sensor","set","view","live"]);function _a(t,e){let{document:n,walls:o}=t,r=n.grid.shape[1];if(e.type==="walls")for(let[s,i]of e.cells)o[s*
r+i]=e.wall?1:0;else if(e.type==="set")Object.assign(n,e.patch);else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,
chain:e.chain??t.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let s=n.sensors.find(i=>i.id===e.id);s&&Object.assign(s,{x:e.x,y:e.y,yaw:e.
yaw})}}var ar=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let r of this.
waiting)r.seq<=n&&this.eventToPaint_ms.push(o-r.time);this.waiting=this.waiting.filter(r=>r.seq>n);for(let r of this.seqOfGeneration.keys())r<e&&this.seqOfGeneration.
delete(r)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var cr=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var ur=class{constructor(e,n,o=null,r=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=r;e.onmessage=(s,i)=>this.receive(s,i),e.onstatus=s=>this.onstatus(
s)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={layer:"mean",chain:0,draw:null};state=null;scan=null;shown=null;cell=null;worker="\
starting";recorded=!1;generation=-1;acted=0;status=new rr;progress=new cr;latency=new ar;counts={paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];confirmedWalls={
text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){
return!this.recorded&&this.document?.source.kind==="simulation"}get running(){return!!this.state?.running}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){
let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&(this.running||this.state?.live))}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(
e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.
method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;let o={...e,seq:++this.seq};e.type!==
"inspect"&&(this.acted=this.seq),Ca.has(e.type)&&(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.send(
o):this.everConnected&&ks(this.portableDocument()),this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){
return this.packed.version!==this.wallsVersion&&(this.packed={version:this.wallsVersion,text:To(oi(this.walls))}),this.document&&{...this.document,walls:this.packed.
text}}portableDocument(){let e=this.effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.
shown=this.next,this.next=null,!0)}painted(){this.counts.paints++,this.shown&&this.latency.painted(this.shown.generation)}remaining_s(){return this.shown&&this.
sampling?this.progress.remaining_s(this.shown):null}onstatus(e){if(this.connection=e,e.connected){let n=this.everConnected?this.portableDocument():this.adopt;this.
pending=[],this.latency.forget(),this.bring(n),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connec\
ted again"):this.notice&&this.say(this.notice.text,this.notice.level),this.everConnected=!0,Ta()}else this.everConnected&&(this.say("Connection lost","error"),ks(
this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"welcome":this.generation=-1,this.recorded=!!e.recorded,this.latency.forget(),this.next=
null;break;case"state":this.receiveState(e);break;case"scan":if(e.generation>=this.generation){let{pose:o,angles:r,ranges:s,exact:i,hit:a}=n;this.scan={ids:e.ids??
[],index:e.index??null,pose:o,angles:r,ranges:s,exact:i,hit:a}}break;case"field":this.receiveField(e,n);break;case"cell":this.cell={x:e.x,y:e.y,beams:e.beams};break;case"\
status":this.status.say(e.text,e.level??"info",this.acted);break;case"error":this.receiveError(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);
break;case"download":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveError(e){let n=e.refused?.
seq??null;n!==null&&n===this.broughtAt&&(this.broughtAt=null,this.act({type:"hello"})),this.status.say([e.text,e.remedy].filter(Boolean).join("; "),"error",this.
acted),this.pending=this.pending.filter(o=>o.seq!==n),n!==null&&this.latency.refused(n),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,
this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){
if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:r,traced:s,weights:i}=n,a=n.observed,u=this.next??this.
shown,m=u&&u.p.length===o.length&&u.bits.every((h,g)=>h===a[g])?{observed:u.observed,bits:u.bits}:{observed:to(a,o.length),bits:a};this.next={...e,p:o,trace:r,traced:s,
weights:i,...m},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,r=this.confirmedWalls;if((e.walls!==
r.text||r.walls.length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:to(Ut(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(s=>({...s}))},(this.confirmedWalls!==
r||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),this.state.view&&!this.pending.some(s=>s.type==="view")){
let{layer:s,chain:i,draw:a}=this.state.view;this.view={layer:s??"mean",chain:i??0,draw:a??null}}for(let s of this.pending)this.foresee(s)}foresee(e){!this.document||
!this.state||(_a(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var La='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
ca Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji";line-height: 1.5;width: min-content;}.u-t\
itle {text-align: center;font-size: 18px;font-weight: bold;}.u-wrap {position: relative;user-select: none;}.u-over, .u-under {position: absolute;}.u-under {over\
flow: hidden;}.uplot canvas {display: block;position: relative;width: 100%;height: 100%;}.u-axis {position: absolute;}.u-legend {font-size: 14px;margin: auto;te\
xt-align: center;}.u-inline {display: block;}.u-inline * {display: inline-block;}.u-inline tr {margin-right: 16px;}.u-legend th {font-weight: 600;}.u-legend th \
> * {vertical-align: middle;display: inline-block;}.u-legend .u-marker {width: 1em;height: 1em;margin-right: 4px;background-clip: padding-box !important;}.u-inl\
ine.u-live th::after {content: ":";vertical-align: middle;}.u-inline:not(.u-live) .u-value {display: none;}.u-series > * {padding: 4px;}.u-series th {cursor: po\
inter;}.u-legend .u-off > * {opacity: 0.3;}.u-select {background: rgba(0,0,0,0.07);position: absolute;pointer-events: none;}.u-cursor-x, .u-cursor-y {position: \
absolute;left: 0;top: 0;pointer-events: none;will-change: transform;}.u-hz .u-cursor-x, .u-vt .u-cursor-y {height: 100%;border-right: 1px dashed #607D8B;}.u-hz \
.u-cursor-y, .u-vt .u-cursor-x {width: 100%;border-bottom: 1px dashed #607D8B;}.u-cursor-pt {position: absolute;top: 0;left: 0;border-radius: 50%;border: 0 soli\
d;pointer-events: none;will-change: transform;/*this has to be !important since we set inline "background" shorthand */background-clip: padding-box !important;}\
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Da=`:host { display: block; height: 100dvh; container-type: size; }
:host([data-embedded]) { height: 720px; }
* { box-sizing: border-box; margin: 0; }
[hidden], .hidden { display: none !important; }
.hidden[aria-live] { display: block !important; position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.app { --ground: #f4f5f7; --card: #fff; --text: #1d2430; --soft: #565d68; --line: #d8dce2; --control: #848c98; --accent: #00639c;
  --on-accent: #fff; --tint: #e3eef6; --bad: #a43b00; --good: #00664a; --fair: #7a5a00; --warn: #fff4d6; --warn-text: #5c4300; color-scheme: light;
  display: grid; height: 100%; grid-template: "head head" auto "bar panel" auto "stage panel" minmax(0, 1fr) "legend panel" auto "foot foot" auto / minmax(0, 1f\
r) 328px;
  background: var(--ground); color: var(--text); font: 14px/1.4 -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif;
  font-variant-numeric: tabular-nums; -webkit-text-size-adjust: 100%; }
.app[data-theme=dark] { --ground: #12151a; --card: #1a1e25; --text: #e6e9ee; --soft: #a3abb8; --line: #2e3540; --control: #6d7786; --accent: #6cb8ec;
  --on-accent: #08131c; --tint: #1f3242; --bad: #ff9d66; --good: #45d6ab; --fair: #f0c75e; --warn: #3d3211; --warn-text: #ffe2a0; color-scheme: dark; }
header { grid-area: head; display: flex; align-items: center; gap: 4px; padding: 7px 12px; background: var(--card); border-bottom: 1px solid var(--line); }
h1 { font-size: 16px; font-weight: 650; letter-spacing: -.01em; }
h2 { font-size: 12px; font-weight: 650; color: var(--soft); letter-spacing: .02em; }
.what { margin-left: 10px; color: var(--soft); white-space: nowrap; overflow: hidden; text-overflow: ellipsis; min-width: 0; }
.space { flex: 1; }
.gap { width: 8px; }
button, select, input { font: inherit; color: inherit; }
button { display: inline-flex; align-items: center; justify-content: center; gap: 6px; height: 32px; padding: 0 10px; border: 1px solid transparent; border-radi\
us: 6px;
  background: none; cursor: pointer; white-space: nowrap; touch-action: manipulation; }
button:hover:not(:disabled) { background: var(--tint); }
button:disabled { color: var(--soft); opacity: .55; cursor: default; }
button svg, .segmented svg { width: 18px; height: 18px; flex: none; }
svg path { fill: none; stroke: currentColor; stroke-width: 1.7; stroke-linecap: round; stroke-linejoin: round; }
header button:not(:has(span)), .bar button { width: 34px; padding: 0; }
aside button, .anchor > button, dialog button { border-color: var(--line); background: var(--card); }
dialog button.plain, .menu button { border-color: transparent; }
dialog button.plain { width: 32px; padding: 0; }
button.primary { background: var(--accent); border-color: var(--accent); color: var(--on-accent); font-weight: 600; }
button.primary:hover:not(:disabled) { background: var(--accent); filter: brightness(1.08); }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
.anchor { position: relative; }
.menu { position: absolute; z-index: 5; top: 38px; right: 0; padding: 5px; display: grid; background: var(--card); border: 1px solid var(--line); border-radius:\
 8px; box-shadow: 0 8px 28px #0004; }
.menu button { justify-content: flex-start; }
.bar { grid-area: bar; display: flex; align-items: center; gap: 2px; padding: 10px 12px 0; }
.segmented { display: inline-flex; padding: 2px; border: 1px solid var(--line); border-radius: 8px; background: var(--card); }
.segmented label { position: relative; display: inline-flex; align-items: center; justify-content: center; gap: 6px; flex: 1; min-height: 30px; padding: 0 11px;\
 border-radius: 6px; cursor: pointer; white-space: nowrap; }
.segmented input { position: absolute; inset: 0; width: 100%; height: 100%; opacity: 0; cursor: pointer; }
.segmented label:has(:checked) { background: var(--accent); color: var(--on-accent); font-weight: 600; }
.segmented label:has(:disabled) { color: var(--soft); opacity: .55; }
.segmented label:has(:focus-visible) { outline: 2px solid var(--accent); outline-offset: 2px; }
.segmented label:hover:not(:has(:checked)):not(:has(:disabled)) { background: var(--tint); }
.stage { grid-area: stage; position: relative; min-height: 0; overflow: hidden; }
.stage canvas { position: absolute; left: 0; top: 0; pointer-events: none; }
.stage canvas[tabindex] { touch-action: none; cursor: crosshair; pointer-events: auto; }
.stage canvas[data-tool=pan] { cursor: grab; }
.stage canvas[data-tool=sensor] { cursor: default; }
canvas:focus-visible { outline-offset: -3px; }
canvas[data-pointed]:focus-visible { outline: none; }
.chips { position: absolute; left: 0; top: 0; display: flex; gap: 6px; pointer-events: none; }
.chip { white-space: nowrap; padding: 2px 8px; border-radius: 5px; background: var(--card); color: var(--text); border: 1px solid var(--line); font-size: 12px; \
pointer-events: none; }
button.chip.doubt { height: auto; background: var(--bad); color: var(--card); border-color: transparent; font-weight: 600; pointer-events: auto; }
button.chip.doubt:hover:not(:disabled) { background: var(--bad); filter: brightness(1.1); }
.chip.approximate { background: var(--warn); color: var(--warn-text); border-color: transparent; }
.banner { position: absolute; z-index: 4; left: 12px; right: 12px; top: 10px; display: flex; flex-wrap: wrap; align-items: center; gap: 6px 12px; padding: 8px 1\
2px; border-radius: 8px; background: var(--bad); color: var(--card); box-shadow: 0 4px 16px #0004; }
.banner.mild { background: var(--warn); color: var(--warn-text); }
.banner button { border-color: currentColor; }
.banner button:hover { background: #0002 !important; }
.legend { grid-area: legend; display: flex; flex-wrap: wrap; gap: 2px 16px; list-style: none; padding: 2px 12px 9px 46px; font-size: 12.5px; color: var(--soft);\
 }
.legend li { display: inline-flex; align-items: center; gap: 6px; white-space: nowrap; }
.legend li:first-child > span:first-child { min-width: 68px; }
.legend .ramp { width: 96px; height: 11px; border: 1px solid var(--line); border-radius: 2px; }
.legend i { width: 16px; height: 12px; flex: none; }
.legend .truth { border: 2px solid var(--truth); }
.legend .ray { height: 0; border-top: 2px solid var(--ray); opacity: .6; }
.legend .miss { height: 0; border-top: 2px solid var(--miss); }
.legend .dot { width: 8px; height: 8px; border-radius: 50%; background: var(--ray); }
.legend .sensor svg { display: block; width: 14px; height: 14px; transform: rotate(90deg); }
.legend .sensor path { fill: var(--sensor); stroke: none; }
.legend .unobserved { border: 1px solid var(--line); background: repeating-linear-gradient(135deg, var(--hatch) 0 1px, var(--unobserved) 1px 4px); }
aside { grid-area: panel; overflow-y: auto; overscroll-behavior: contain; background: var(--card); border-left: 1px solid var(--line); scrollbar-width: thin; }
section { display: grid; gap: 7px; padding: 10px 16px 12px; border-bottom: 1px solid var(--line); }
section:last-child { border-bottom: 0; }
.buttons { display: flex; align-items: center; gap: 8px; }
.buttons.end { justify-content: flex-end; margin-top: 6px; }
.buttons > select, .buttons > input { flex: 1; min-width: 0; }
.buttons > .check { margin-left: auto; }
.row { display: grid; grid-template-columns: 1fr 1.45fr; align-items: center; gap: 4px 10px; }
.row.slider { grid-template-columns: 92px 1fr 66px; }
.row.slider input[type=number] { appearance: textfield; text-align: right; }
.row.slider ::-webkit-inner-spin-button { display: none; }
.triple { display: grid; grid-template-columns: 1fr 1fr 1fr; gap: 8px; }
.triple .row { grid-template-columns: 1fr; gap: 2px; }
.triple label { font-size: 12.5px; color: var(--soft); }
select, input[type=number], input[type=text] { width: 100%; height: 30px; padding: 0 7px; border: 1px solid var(--control); border-radius: 6px; background: var(\
--card); }
select:disabled { opacity: .55; }
input[type=range] { appearance: none; width: 100%; height: 22px; margin: 0; background: none; cursor: pointer; touch-action: pan-y; }
input[type=range]::-webkit-slider-runnable-track { height: 4px; border-radius: 2px; background: linear-gradient(var(--accent) 0 0) 0 / var(--fill, 0%) 100% no-r\
epeat var(--line); }
input[type=range]::-webkit-slider-thumb { appearance: none; width: 16px; height: 16px; margin-top: -6px; border-radius: 50%; border: 2px solid var(--card); back\
ground: var(--accent); box-shadow: 0 0 0 1px var(--accent); }
input[type=range]::-moz-range-track { height: 4px; border-radius: 2px; background: linear-gradient(var(--accent) 0 0) 0 / var(--fill, 0%) 100% no-repeat var(--l\
ine); }
input[type=range]::-moz-range-thumb { width: 13px; height: 13px; border-radius: 50%; border: 2px solid var(--card); background: var(--accent); }
input[type=range]:disabled { opacity: .5; cursor: default; }
.check { display: inline-flex; align-items: center; gap: 6px; min-height: 24px; cursor: pointer; }
.check input { width: 16px; height: 16px; margin: 0; accent-color: var(--accent); }
.checks { display: flex; flex-wrap: wrap; gap: 2px 16px; }
progress { appearance: none; width: 100%; height: 6px; border: 0; border-radius: 3px; overflow: hidden; background: var(--line); }
progress::-webkit-progress-bar { background: var(--line); }
progress::-webkit-progress-value { background: var(--accent); }
progress::-moz-progress-bar { background: var(--accent); }
.doing { min-height: 1.4em; margin-top: -4px; font-size: 12.5px; color: var(--soft); }
dl { display: grid; grid-template-columns: repeat(4, 1fr); gap: 8px; }
dt { font-size: 12px; color: var(--soft); }
dd { font-weight: 600; white-space: nowrap; }
.charted { display: grid; gap: 4px; }
.chart { height: 128px; overflow: hidden; }
.charted .segmented { justify-self: start; }
.charted .segmented label { min-height: 24px; padding: 0 9px; font-size: 12px; }
.caption { font-size: 12px; color: var(--soft); }
dd.good { color: var(--good); }
dd.fair { color: var(--fair); }
dd.bad { color: var(--bad); }
.verdict { font-size: 12.5px; padding-left: 9px; border-left: 3px solid var(--good); color: var(--soft); }
.verdict.fair { border-color: var(--fair); }
.verdict.bad { border-color: var(--bad); color: var(--text); }
.player { display: grid; grid-template-columns: auto 1fr auto; align-items: center; gap: 6px 10px; }
.player .wide { grid-column: 1 / -1; }
.player .wide select { flex: 1 1 0; padding: 0 2px; }
section .player .wide button { width: auto; padding: 0 8px; }
.player.bare { grid-template-columns: 1fr auto; }
section .player button { width: 32px; padding: 0; }
output { min-width: 84px; text-align: right; font-size: 12.5px; color: var(--soft); }
footer { grid-area: foot; display: flex; gap: 6px 24px; justify-content: space-between; padding: 5px 16px 6px; border-top: 1px solid var(--line); background: va\
r(--card); font-size: 12.5px; min-height: 30px; }
footer [role=status]::before { content: ""; display: inline-block; width: 8px; height: 8px; margin-right: 8px; border-radius: 50%; background: var(--sensor); }
footer .warning::before { background: #e0a000; }
footer .error { color: var(--bad); }
footer .error::before { background: var(--bad); }
footer [role=status] { min-width: 0; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.readout { color: var(--soft); white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
dialog { margin: auto; width: min(540px, calc(100% - 32px)); max-height: calc(100% - 32px); padding: 16px 20px 20px; border: 1px solid var(--line); border-radiu\
s: 12px; background: var(--card); color: var(--text); box-shadow: 0 16px 60px #0006; }
dialog::backdrop { background: #0a0e1480; }
dialog .title { display: flex; align-items: center; justify-content: space-between; margin-bottom: 8px; }
dialog h2 { font-size: 16px; color: var(--text); }
dialog p { margin-bottom: 10px; }
dialog form { display: grid; gap: 10px; }
dialog table { border-collapse: collapse; margin-bottom: 10px; width: 100%; }
dialog th { text-align: left; font-weight: inherit; padding: 3px 14px 3px 0; white-space: nowrap; vertical-align: top; }
dialog td { padding: 3px 0; }
kbd { font: inherit; font-weight: 600; }
.copied { display: block; min-height: 1.4em; margin-top: 6px; color: var(--soft); }
@media (pointer: coarse) { button, select, input[type=number], input[type=text], .segmented label { min-height: 40px; } input[type=range] { height: 34px; } .che\
ck { min-height: 40px; } }
@container (max-width: 1000px) { header .what { display: none; } }
@container (max-width: 760px) {
  .app { grid-template: "head" auto "stage" minmax(260px, 46%) "bar" auto "legend" auto "panel" minmax(0, 1fr) "foot" auto / minmax(0, 1fr); }
  header { padding: 5px 8px; gap: 0; }
  header button span { display: none; }
  header button, header button:not(:has(span)) { width: 38px; padding: 0; }
  .anchor > button { border-color: transparent; background: none; }
  .menu button { width: auto; padding: 0 10px; }
  .menu button span { display: inline; }
  .gap { display: none; }
  .bar { padding: 4px 8px; }
  .bar .segmented label { padding: 0 8px; gap: 4px; }
  .bar .segmented svg { width: 16px; }
  .bar [aria-label^="Zoom"] { display: none; }
  .legend { padding: 3px 12px 5px; gap: 0 12px; font-size: 12px; }
  .legend .ramp { width: 60px; }
  aside { border-left: 0; border-top: 1px solid var(--line); }
  footer { flex-direction: column; padding: 4px 12px 5px; gap: 0; }
  footer > * { max-width: 100%; min-height: 1.4em; }
}
@container (max-width: 380px) {
  .bar .segmented span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); }
  .bar .segmented label { padding: 0 14px; }
  .bar .segmented svg { width: 18px; }
  .buttons { flex-wrap: wrap; }
}
@container (max-height: 520px) and (min-width: 560px) {
  .app { grid-template: "bar stage head" auto "bar stage panel" minmax(0, 1fr) "bar stage foot" auto / auto minmax(0, 1fr) 292px; }
  header { padding: 2px 4px; gap: 0; justify-content: space-between; border-left: 1px solid var(--line); }
  header h1, header .what, header .space, header .gap { display: none; }
  header button span { display: none; }
  header button, header button:not(:has(span)) { width: 38px; padding: 0; }
  .anchor > button { border-color: transparent; background: none; }
  .menu button { width: auto; padding: 0 10px; }
  .menu button span { display: inline; }
  .bar { flex-direction: column; padding: 6px 0 6px 6px; }
  .bar .segmented { flex-direction: column; }
  .bar .segmented label { padding: 0 11px; }
  .bar .segmented span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); }
  .legend { display: none; }
  footer { flex-direction: column; padding: 3px 12px 4px; gap: 0; border-left: 1px solid var(--line); }
  footer > * { max-width: 100%; }
}
@media (prefers-reduced-motion: no-preference) { button, .segmented label { transition: background-color .12s; } }
@media (forced-colors: active) { .segmented label:has(:checked) { outline: 2px solid Highlight; } }
`;var Na="bayesmap-theme",Ra={auto:"light",light:"dark",dark:"auto"},pr=class{constructor(e,n){this.app=e;this.dressed=n;let o=id();o&&o in Ra&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=Io.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?Io.dark:Io.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:r,noReturn:s,sensor:i,
hatch:a,unobserved:u}=n;for(let[p,m]of Object.entries({truth:o,ray:r,miss:s,sensor:i,hatch:a,unobserved:u}))this.app.style.setProperty(`--${p}`,m);this.dressed(
this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Ra[this.choice];try{localStorage.setItem(Na,this.choice)}catch{}this.dress()}destroy(){this.media.
removeEventListener("change",this.listen)}};function id(){try{return localStorage.getItem(Na)}catch{return null}}function dr(t,e,{embedded:n=!1,adopt:o=null,notice:r=null}={}){let s=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(La+Da),s.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,u=()=>{a||=requestAnimationFrame(Ue)},p=new ur(e,u,o,r),m=new _n,h=new Do(p),g=new Lo(p,h),x=new lr(p),b=new ir(
p,h,g,ie,q=>x.showLayer(q),n),M=[new Rn,new On,new Nn,new Fo],A=M.map(({name:q})=>S("canvas",{className:q})),L=A[A.length-1];Object.assign(L,{tabIndex:0,role:"a\
pplication"});let k=new zo(M,A);new Oo(L,p,m,h,g,n);let _=new Ro(L,p,m,h,g),T={truth:!0,rays:!0,readings:!0},j=ca(b),D=Ci(b),Z={chip:fa(b),banner:ha(b)},G=S("ma\
in",{className:"stage"},...A,Z.chip,Z.banner),R=()=>X.theme,z=ua(b,R),E=ma(b);L.setAttribute("aria-describedby",E.readout.id);let Y=aa(b),I={help:ia(b),new:la(b),
share:Y.dialog},[K,W,ne,B]=[ya(b),ba(b),wa(b),xa(b)],Ke=[ga(b,ra(b,R),sa(b,R)),va(b,x,T),Sa(b),K,W,ne,B],he=S("aside",{"aria-label":"Controls"},...Ke),re=()=>p.
recorded||p.document?.source.kind==="run";b.visible(K,()=>p.editable),b.visible(W,()=>!re()),b.visible(ne,()=>!re()),b.visible(B,()=>!re()),b.each(()=>{V(D,"ine\
rt",!p.document),V(he,"inert",!p.document)});let ce=S("div",{className:"app"},j.element,D,G,z,he,E.element,...Object.values(I));s.replaceChildren(ce);let X=new pr(
ce,q=>{j.nameTheme(q),u()}),H=()=>{let q=p.editable&&h.tool==="sensor"?h.sensor?.id??null:null;return{session:p,view:m,look:{theme:X.theme,...T,hover:h.hover,cursor:h.
cursor,selected:q}}},Pe="";function Ue(){a=0;let q=p.take();p.document&&String(p.shape)!==Pe&&(Pe=String(p.shape),m.fit(p.shape),h.cursor=h.hover=null,L.setAttribute(
"aria-label",`Map, ${p.shape[0]} by ${p.shape[1]} cells`)),k.paint(H()),q&&(p.painted(),x.step());let{x:te,y:De}=m.transform;Z.chip.style.transform=`translate(${Math.
max(te,je.left)}px, ${Math.max(De-28,6)}px)`,kt(L,"data-tool",p.editable?h.tool:"pan"),b.refresh()}let me=new ResizeObserver(()=>{let{width:q,height:te}=G.getBoundingClientRect();
!q||!te||(m.resize(q,te,devicePixelRatio||1),m.fitted&&m.fit(p.shape),cancelAnimationFrame(a),Ue())});me.observe(G);async function ie(q){if(q==="in"||q==="out")
m.zoom(q==="in"?1.4:1/1.4,m.middle,p.shape);else if(q==="fit")m.fit(p.shape);else if(q==="help")I.help.showModal();else if(q==="new")I.new.showModal();else if(q===
"theme")X.next();else if(q==="add")_.addSensor();else if(q==="share"){let te=p.portableDocument();te&&Y.show(location.origin+location.pathname+await ii(te))}else if(q===
"export png"){let te=await Ai(H());te&&Wr("bayesmap.png",te),p.say("Saved bayesmap.png")}else q.startsWith("export ")&&p.act({type:"export",what:q.slice(7)});u()}
p.ondownload=(q,te,De)=>Wr(q,new Blob([De],{type:te}));let ot=[[n?t:window,"keydown",q=>{q.defaultPrevented||!p.document||Object.values(I).some(te=>te.open)||bi(
q,p,{tool:te=>{h.choose(te),_.focus()},layer:te=>x.showLayer(te),command:ie})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{if(n)return;let{
document:q,damaged:te}=await Ao();q?p.bring(q):te&&p.say(Eo,"error")}]];for(let[q,te,De]of ot)q.addEventListener(te,De);return X.dress(),e.open(),{destroy(){me.
disconnect(),cancelAnimationFrame(a),X.destroy();for(let[q,te,De]of ot)q.removeEventListener(te,De);e.close(),s.replaceChildren()},snapshot:()=>ka(p,m,k),cellToClient(q,te){
let De=L.getBoundingClientRect(),Nt=m.fromGrid({x:q+.5,y:te+.5},p.shape[1]);return{x:De.left+Nt.x,y:De.top+Nt.y}}}}var Ms={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},Oa=8,jn=()=>({onmessage:()=>{},onstatus:()=>{}});function Fa(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},r=4+e;for(let{name:s,dtype:i,shape:a}of n.buffers){let u=a.reduce((p,m)=>p*m,1)*Ms[i].BYTES_PER_ELEMENT;
o[s]=new Ms[i](t.slice(r,r+u)),r+=Math.ceil(u/Oa)*Oa}return[n,o]}function Ua(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:r},s)=>{let{buffer:i,byteOffset:a,
byteLength:u}=e[s];n[o]=new Ms[r](i.slice(a,a+u))}),n}function Ia(t){let{document:e,scans:n,settings:o={},log_joint:r=[]}=t,s=e.grid.shape[0]*e.grid.shape[1],i=t.draws?.count??0,a=e.source.kind!=="simulation",u=Ut(
t.mean),p=Ut(t.observed),m=null,h=0,g={layer:"mean",chain:0,draw:null},x=R=>a?[R[h]]:R,b=R=>Float32Array.from(x(R).flat(),z=>z??1/0),M=n.angles.length,A=to(Ut(n.
hit),n.pose.length*M),L=()=>a?A.subarray(h*M,(h+1)*M):A,k=Float32Array.from(r.flat()),_=(o.sweeps??i)/Math.max(1,i),T=Float32Array.from(r[0]??[],(R,z)=>(z+1)*_),
j=R=>{let z={chains:t.draws?.chains??0,count:m?i:0},E={generation:1,can_undo:!1,can_redo:!1,live:!1,running:!1};G.onmessage({type:"state",document:e,seq:R,...E,
draws:z,view:g},{})},D=()=>{let R=Float64Array.from(x(n.pose).flat(),Number),z={type:"scan",generation:1,ids:a?[h]:n.ids,index:a?h:null},E=n.exact?.length?b(n.exact):
new Float32Array(0);G.onmessage(z,{pose:R,angles:Float32Array.from(n.angles),ranges:b(n.ranges),exact:E,hit:L()})},Z=()=>{let R=g.layer==="draw"&&m?ld(m,g.chain*
i+(g.draw??i-1),s):null,z=r[g.chain]?.[(g.layer==="draw"?g.draw:null)??i-1]??null,E=R?{...g,draw:g.draw??i-1}:{layer:g.layer==="draw"?"mean":g.layer},Y=o.sweeps??
i,I={sweeps:Y,total:Y,ess:o.ess,rhat:o.rhat,verdict:o.verdict,log_joint:z},K=o.method??e.method,W={p:R??u,observed:p,trace:k,traced:T};G.onmessage({type:"field",
generation:1,...E,method:K,approximate:!1,...I},W)},G={...jn(),open:()=>G.onstatus({connected:!0}),send:R=>{if(R.type==="hello"){if(G.onmessage({type:"welcome",
version:1,recorded:!0},{}),j(R.seq),D(),Z(),!i||!t.draws)return;Po(Ut(t.draws.data)).then(z=>{m=z,j(R.seq)})}else if(R.type==="view")g={layer:R.layer,chain:R.chain??
g.chain,draw:R.draw??null},j(R.seq),Z();else if(R.type==="scan")h=R.index,j(R.seq),D();else if(R.type==="inspect"){let z=ad(e,n.angles,x(n.pose),x(n.ranges),R.x,
R.y);G.onmessage({type:"cell",x:R.x,y:R.y,beams:z},{})}},close:()=>{}};return G}function ld(t,e,n){let o=e*n;return Uint8Array.from({length:n},(r,s)=>t[o+s>>3]>>
7-(o+s&7)&1?255:0)}function ad({grid:t},e,n,o,r,s){let{origin:i,resolution:a}=t,u=[i[0]+r*a,i[1]+s*a],p=0;return n.forEach((m,h)=>{let[g,x,b]=m.map(Number);e.forEach(
(M,A)=>{let[L,k]=[Math.cos(M+b),Math.sin(M+b)],_=[(u[0]-g)/L,(u[0]+a-g)/L,(u[1]-x)/k,(u[1]+a-x)/k],T=Math.max(0,Math.min(_[0],_[1]),Math.min(_[2],_[3])),j=Math.
min(o[h][A]??1/0,Math.max(_[0],_[1]),Math.max(_[2],_[3]));T<j&&p++})}),p}var Ts=250,cd=8e3;function za(t){let e=null,n=Ts,o=0,r=!1;function s(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let u=new WebSocket(a),p=!1;e=u,u.binaryType="arraybuffer",u.onopen=()=>{p=!0,n=Ts,i.onstatus({connected:!0})},u.onmessage=({data:m})=>{typeof m==
"string"?i.onmessage(JSON.parse(m),{}):i.onmessage(...Fa(m))},u.onclose=()=>{if(r||e!==u)return;o=window.setTimeout(s,n);let m={connected:!1,retryIn_ms:n};i.onstatus(
m),p||ud(t()).then(h=>h&&e===u&&i.onstatus({...m,refused:h})),n=Math.min(cd,2*n)}}let i={...jn(),open:s,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=Ts,e?.readyState!==WebSocket.OPEN&&s()},close:()=>{r=!0,clearTimeout(o),e?.close()}};return i}async function ud(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Ha(t){let e=(o,r=[])=>n.onmessage(o,Ua(o,r)),n={...jn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var pd="This is the map that was drawn here when the connection was lost; undo leads back",Ps=t=>Object.assign(window,{bayesmap:t}),Qh={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=dr(n,Ha(t),{embedded:!0});return Ps(o),()=>o.destroy()}};async function dd(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){Ps(dr(t,Ia(JSON.parse(n.textContent??""))));return}Ea(new URLSearchParams(location.search).get("token"));let{document:o,damaged:r}=await Ao(),
s=o?null:Pa(),i=za(()=>new URL(location.href));Aa(u=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(u)}${location.hash}`),i.retry?.()}),
Ps(dr(t,i,{adopt:o??s,notice:r?{text:Eo,level:"error"}:s?{text:pd,level:"info"}:null}))}dd();export{Qh as default,dr as mount,Ia as recordedTransport,za as webSocketTransport,Ha as widgetTransport};
