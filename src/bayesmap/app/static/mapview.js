// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function lo(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function ci(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Wt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Lo(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function ui(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Do=t=>ui(t,new DecompressionStream("deflate-raw")),pi=t=>ui(t,new CompressionStream("deflate-r\
aw"));async function di(t){let e=await pi(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Lo(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Mc(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Do(Wt(e[1]))))}var Ro="The link's map cannot be read: copy the link again, who\
le";async function No(){let t=await Mc(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var de=(t,e,n)=>Math.min(n,Math.max(e,t)),Rn=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,yt=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Wr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function ao(t,e){let{x:n,y:o}=yt(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Nn=(t,e)=>Wr({x:t.x+.5,y:t.y+.5},e);
function fi(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let r=0;r<=o;r++){let s=o?r/o:0;n.push({x:Math.round(t.x+s*(e.x-t.x)),y:Math.round(
t.y+s*(e.y-t.y))})}return n}function hi(t,[e,n]){let o=new Path2D,r=(s,i)=>s>=0&&s<e&&i>=0&&i<n?t[s*n+i]:0;for(let s=0;s<=e;s++)for(let i=0,a=-1;i<=n;i++){let c=i<
n&&r(s-1,i)!==r(s,i);c&&a<0&&(a=i),!c&&a>=0&&(o.moveTo(s,a),o.lineTo(s,i),a=-1)}for(let s=0;s<=n;s++)for(let i=0,a=-1;i<=e;i++){let c=i<e&&r(i,s-1)!==r(i,s);c&&
a<0&&(a=i),!c&&a>=0&&(o.moveTo(a,s),o.lineTo(i,s),a=-1)}return o}var co=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function mi(t,e,n){let o=yi(t).map(({x:s,y:i})=>s*t.grid.shape[1]+i),r=(s,i)=>-((s-n.x)**2+(i-n.y)**2);return bi(t,(s,i,a)=>e[a]||o.includes(a)?-1/0:r(s,i))}function gi(t,e){
let n=Tc(e,t.grid.shape),o=yi(t);return bi(t,(r,s,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let c of o)a=Math.min(a,Math.hypot(r-c.x,s-c.y));return a>0?a:-1/0})}
var yi=({sensors:t,grid:e})=>t.map(n=>ao(n,e));function bi(t,e){let[n,o]=t.grid.shape,r=null,s=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let c=e(i,a,i*o+a);
c>s&&([r,s]=[{x:i,y:a},c])}return r&&Nn(r,t.grid)}function Tc(t,[e,n]){let o=new Uint16Array(e*n),r=(s,i)=>s<0||i<0||s>=e||i>=n?0:o[s*n+i];for(let s=0;s<e;s++)for(let i=0;i<
n;i++)o[s*n+i]=t[s*n+i]?0:1+Math.min(r(s-1,i-1),r(s-1,i),r(s-1,i+1),r(s,i-1));for(let s=e-1;s>=0;s--)for(let i=n-1;i>=0;i--){let a=1+Math.min(r(s+1,i+1),r(s+1,i),
r(s+1,i-1),r(s,i+1));o[s*n+i]=Math.min(o[s*n+i],a)}return o}var _e={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],fov_deg:[5,360],sweeps:[1,1e5],seed:[0,2147483647]};var Fo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Rn(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,r){
let{document:s,shape:i}=this.session;if(!s)return;let a=n?s.sensors.map(p=>ao(p,s.grid)):[],c=new Map;for(let p of e)!Rn(p,i)||this.isWall(p)===n||a.some(m=>m.x===
p.x&&m.y===p.y)||c.set(p.x*i[1]+p.y,[p.x,p.y]);c.size&&this.session.act({type:"walls",cells:[...c.values()],wall:n,stroke:o},r)}moveSensor(e,n,o,r){let{x:s,y:i,
yaw:a}={...e,...n};this.refuses({x:s,y:i})||this.session.act({type:"sensor",op:"move",id:e.id,x:s,y:i,yaw:a,drag:o},r)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let r=e==="where there is room"?gi(o,n.walls):"world"in e?e.world:mi(o,n.walls,e.near);r?o.sensors.length>=_e.sensors?n.say(`There can be ${_e.sensors}\
 sensors at most.`,"warning"):this.refuses(r)||(n.act({type:"sensor",op:"add",x:r.x,y:r.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=Math.
max(0,...o.sensors.map(s=>s.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sen\
sor",op:"remove",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=ao(e,n.document.grid),r=this.isWall(o);return!r&&Rn(o,n.shape)?(n.status.
text.startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(r?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Ft=new Set(["pan","path","look"]),Pc=120,Oo=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&
Rn(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.
cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspec\
t",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},Pc))}};var je={left:36,right:12,top:34,bottom:26},Ec=60,Ac=160,Fn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-je.left-je.right,y:this.height-je.
top-je.bottom},r=Math.max(.05,Math.min(o.x/e,o.y/n));r*this.ratio>4&&(r=Math.floor(r*this.ratio)/this.ratio),this.transform.scale=r,this.corner={x:je.left+(o.x-
r*e)/2,y:je.top+(o.y-r*n)/2},this.fitted=!0,this.settle([e,n])}zoom(e,n,o){let{scale:r}=this.transform,{x:s,y:i}=this.corner,a=de(r*e,Math.min(this.width,this.height)/
Math.max(...o)/3,Ac),c=a/r;this.transform.scale=a,this.corner={x:n.x-c*(n.x-s),y:n.y-c*(n.y-i)},this.fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.
y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:r,y:s}=this.transform;return{x:(e.x-r)/o,y:n-(e.y-s)/o}}fromGrid(e,n){let{scale:o,x:r,y:s}=this.transform;
return{x:r+e.x*o,y:s+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,r=Ec;this.corner.x=de(this.corner.x,r-e*o,this.width-r),this.corner.y=de(this.corner.y,
r-n*o,this.height-r),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var ki=[["D, E, S, P","draw, erase, sensor, pan"],["G, L","path, look next"],["arrows","move the cursor, the sensor or the view; with Shift by five cells"],["Sp\
ace","draw or erase at the cursor; next sensor; start or goal of a path"],["[ and ]","turn the sensor"],["A, Delete","add, remove a sensor"],["R, Escape","run, \
cancel"],["M, N, H","show the mean, a draw, the entropy"],["Ctrl+Z, Ctrl+Y","undo, redo"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],Cc={ArrowLeft:[
-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},wi=Math.PI/12,Io=class{constructor(e,n,o,r,s){this.canvas=e;this.session=n;this.view=o;this.hand=r;this.editor=
s;e.addEventListener("keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,r.setCursor(null)})}focus(){this.
canvas.focus({preventScroll:!0})}key(e){let{session:n,hand:o,editor:r}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let s=Cc[e.key],i=e.shiftKey?5:
1;if(s)this.arrow(s[0]*i,s[1]*i);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?wi:-wi;n.editable&&o.sensor&&r.moveSensor(
o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)
r.removeSensor();else if(e.key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.
hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:o,view:r,hand:s}=this,[i,a]=o.shape;if(s.tool==="sensor"&&s.sensor&&o.document&&
o.editable){let{resolution:c}=o.document.grid;s.selected=s.sensor.id,this.editor.moveSensor(s.sensor,{x:s.sensor.x+e*c,y:s.sensor.y+n*c})}else if(s.tool==="pan"&&
o.editable)r.pan(-40*e,40*n,o.shape),o.changed();else{let c=s.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},p={x:de(c.x+e,0,i-1),y:de(c.y+n,0,a-1)};s.setCursor(
p);let m=r.fromGrid({x:p.x+.5,y:p.y+.5},a),f=(x,b,M)=>x-de(x,b,M),g={x:f(m.x,je.left+10,r.width-20),y:f(m.y,20,r.height-je.bottom-10)};(g.x||g.y)&&r.pan(-g.x,-g.
y,o.shape)}}space(e){let{session:n,hand:o,editor:r}=this;if(o.tool==="path"&&n.document){o.cursor?n.decisions.point(Nn(o.cursor,n.document.grid)):this.arrow(0,0);
return}if(n.editable){if(o.tool==="sensor"){let s=n.document?.sensors??[],i=s.findIndex(a=>a.id===o.sensor?.id);o.select(s[(i+1)%Math.max(1,s.length)]?.id??null),
o.selected!==null&&o.announce(`Sensor ${o.selected}`)}else if(o.tool!=="pan"){o.cursor||this.arrow(0,0);let s=o.cursor,i=o.tool==="draw"&&!r.isWall(s);r.setWalls(
[s],i,o.nextGesture(),e),o.announce(i?"wall":"free")}}}},Hr={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look"},xi={m:"mean",n:"draw",h:"entropy"},vi={"+":"\
in","=":"in","-":"out",0:"fit","?":"help"};function Si(t,e,n){let o=t.composedPath()[0],r=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.
test(o.type),s=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(r||s!=="z"&&s!=="y"||e.recorded)return;t.preventDefault(),e.act({type:s==="y"||t.shiftKey?
"redo":"undo"});return}if(!(r||t.altKey)){if(Hr[s]&&(e.editable||Ft.has(Hr[s])&&!e.recorded))n.tool(Hr[s]);else if(xi[s])n.layer(xi[s]);else if(vi[t.key])n.command(
vi[t.key]);else if(s==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&(e.running||e.sampling))e.act({type:"cancel"});else return;t.preventDefault()}}var $r='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function On(t,e,n,o,r,s,i=!1){t.font=$r,t.textAlign=s,t.textBaseline=
"middle",i&&(t.strokeStyle=r.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=r.axis,t.fillText(e,n,o)}function Gr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,r)=>r).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Uo(t,e,n){let o=n.fromGrid(yt(t,e),e.shape[1]),r=de(n.transform.scale*.42,7,13),s=r*2.6,i={x:o.x+s*Math.cos(t.yaw),
y:o.y-s*Math.sin(t.yaw)};return{point:o,size:r,handle:i}}function Mi(t,{session:e,view:n,look:o}){let r=e.document;if(!r)return;let{theme:s}=o,i=Gr(e);t.lineJoin=
"round";for(let a of i){let c=Uo(a,r.grid,n),{point:p,size:m}=c;a.id===o.selected&&_c(t,c,o);let[f,g]=[Math.cos(a.yaw),-Math.sin(a.yaw)],x=(b,M)=>[p.x+m*(b*f-M*
g),p.y+m*(b*g+M*f)];t.beginPath(),t.moveTo(...x(1.25,0)),t.lineTo(...x(-.9,.8)),t.lineTo(...x(-.45,0)),t.lineTo(...x(-.9,-.8)),t.closePath(),t.strokeStyle=s.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=s.sensor,t.fill(),i.length>1&&i.length<100&&On(t,String(a.id),p.x,p.y+m*2+4,s,"center",!0)}}function _c(t,{point:e,size:n,handle:o},{
theme:r}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),t.strokeStyle=r.halo,t.lineWidth=4,t.stroke(),t.strokeStyle=r.sensor,t.lineWidth=1.5,t.stroke(),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=
r.halo,t.fill()}var Ti={touch:24,other:11},Lc=5,Dc=90,zo=class{constructor(e,n,o,r,s,i){this.canvas=e;this.session=n;this.view=o;this.hand=r;this.editor=s;this.embedded=i;let a=(c,p)=>e.
addEventListener(c,p,{passive:!1});a("pointerdown",c=>this.down(c)),a("pointermove",c=>this.move(c)),a("pointerup",c=>this.up(c)),a("pointercancel",c=>this.up(c)),
a("pointerleave",()=>r.point(null)),a("wheel",c=>this.wheel(c)),a("contextmenu",c=>c.preventDefault())}fingers=new Map;gesture=null;at(e){let n=this.canvas.getBoundingClientRect();
return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){
return Wr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,{document:r}=n;if(!r)return;e.preventDefault(),
this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(e.pointerId);let s=this.at(e);if(this.fingers.
set(e.pointerId,s),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;if(e.button===0&&(o.tool==="path"||o.tool==="\
look"))return this.begin({kind:"pick",first:s});if(e.button===1||Ft.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:s});let i=this.gripAt(s,e,r);if(i)
this.begin(i),i.kind==="sensor"&&o.select(i.id);else if(o.tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(s,r)}):o.sensor&&(o.selected=o.sensor.
id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),grip:{x:0,y:0}}),this.dragSensor(e));else{let a=o.tool==="draw"!==(e.button===2||e.shiftKey),c=this.
cellAt(s),p=a&&this.editor.isWall(c);this.begin({kind:"stroke",id:o.nextGesture(),wall:a,last:c,held:e,onWall:p}),e.pointerType!=="touch"?this.release():setTimeout(
()=>this.release(),Dc)}}gripAt(e,n,o){let{hand:r,view:s}=this,i=n.pointerType==="touch"?Ti.touch:Ti.other,a=g=>Math.hypot(e.x-g.x,e.y-g.y),c=r.tool==="sensor"&&
r.sensor?Uo(r.sensor,o.grid,s):null;if(c&&r.sensor&&a(c.handle)<Math.min(i,a(c.point)))return{kind:"turn",id:r.sensor.id,drag:r.nextGesture()};if(n.button!==0||
r.tool==="erase")return null;let p=o.sensors.map(g=>({id:g.id,...Uo(g,o.grid,s)}));p.sort((g,x)=>a(g.point)-a(x.point));let m=p.find(({point:g,size:x})=>a(g)<Math.
max(i,x));if(!m)return null;let f={x:m.point.x-e.x,y:m.point.y-e.y};return{kind:"sensor",id:m.id,drag:r.nextGesture(),grip:f}}release(){if(this.gesture?.kind!==
"stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.gesture.last],e)}move(e){let{gesture:n,session:o,view:r,hand:s}=this,
i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)s.point(this.cellAt(i));else if(n.kind==="stroke"){this.release();let a=[],c=e.
getCoalescedEvents?.()??[];for(let p of c.length?c:[e]){let m=this.cellAt(this.at(p));(m.x!==n.last.x||m.y!==n.last.y)&&(n.onWall=!1),a.push(...fi(n.last,m)),n.
last=m}this.stroke(a,e),s.point(n.last)}else if(n.kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(p=>p.id===n.id);if(!a||
!o.document)return;let c=this.metres(i,o.document);this.editor.moveSensor(a,{yaw:Math.atan2(c.y-a.y,c.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.
first.x,i.y-n.first.y)>Lc&&this.begin({kind:"pan",last:i});else if(n.kind==="pan")r.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.
size===2){let{middle:a,spread:c}=this.spread();r.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),r.zoom(c/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:c}),o.
changed()}}up(e){e.type==="pointerup"&&this.release(),e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.
last],!1,this.gesture.id,e),e.type==="pointerup"&&this.gesture?.kind==="pick"&&this.pick(this.gesture.first),this.fingers.delete(e.pointerId),this.fingers.size===
0&&(this.gesture=null,this.hand.busy=!1),e.pointerType==="touch"&&this.hand.point(this.cellAt(this.at(e)))}pick(e){let{session:n,hand:o,editor:r}=this;if(!n.document)
return;let s=this.metres(e,n.document);if(o.tool==="path")return n.decisions.point(s);let i=n.decisions.nearest(s),{views:a}=n.decisions;if(i===null||!a)return;
let[c,p,m]=a.pose.subarray(3*i,3*i+3),f=`${a.nats[i].toFixed(1)} nats`;n.editable?r.addSensor({world:{x:c,y:p},yaw:m}):n.say(`A scan from ${c.toFixed(2)}, ${p.toFixed(
2)} m would tell ${f}`)}spread(){let[e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){
if(!this.session.document)return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.
deltaMode===1?16:1;e.shiftKey?this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),
this.session.shape),this.session.changed()}stroke(e,n){let{session:o,gesture:r}=this;r?.kind==="stroke"&&(this.editor.setWalls(e,r.wall,r.id,n),o.status.level===
"error"&&o.say("Ready"))}dragSensor(e){let{gesture:n,session:o}=this,{document:r}=o;if(n?.kind!=="sensor"||!r)return;this.hand.point(null);let s=r.sensors.find(
c=>c.id===n.id),i=this.at(e),a=this.metres({x:i.x+n.grip.x,y:i.y+n.grip.y},r);s&&this.editor.moveSensor(s,a,n.drag,e)}};var Rc=5,Vo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:r}){
let{theme:s}=r;e.beginPath(),e.rect(je.left,0,o.width,o.height-je.bottom),e.clip(),r.hover&&Pi(e,r.hover,n.shape[1],o,s,s.axis,1.5),r.cursor&&Pi(e,r.cursor,n.shape[1],
o,s,s.ray,2.5)}};function Pi(t,e,n,o,r,s,i){let{scale:a}=o.transform,c=o.fromGrid({x:e.x,y:e.y+1},n),p=Math.max(a,Rc),[m,f]=[c.x-(p-a)/2,c.y-(p-a)/2];t.lineWidth=
i+2,t.strokeStyle=r.halo,t.strokeRect(m,f,p,p),t.lineWidth=i,t.strokeStyle=s,t.strokeRect(m,f,p,p)}var Nc={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Fc={paper:[17,0,-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"\
#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a\
3abb8",ground:"#12151a"},Ho={light:Nc,dark:Fc},Ei="00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Oc([
t,e,n]){let o=(t+16)/116,r=[.95047,1,1.08883],[s,i,a]=[o+e/500,o,o-n/200].map((c,p)=>(c>.20689655172413793?c**3:.12841854934601665*(c-.13793103448275862))*r[p]);
return[3.2404542*s-1.5371385*i-.4985314*a,-.969266*s+1.8760108*i+.041556*a,.0556434*s-.2040259*i+1.0572252*a].map(c=>{let p=de(c,0,1);return Math.round(255*(p<=
.0031308?12.92*p:1.055*p**(1/2.4)-.055))})}var Wo=(t,e=1)=>[0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),Br=(t,e,n)=>t.map((o,r)=>o+n*(e[r]-o)),jr=(t,e)=>Oc(Br(
t.paper,t.ink,e));function uo(t){let e=Math.min(15,Math.floor(t*16));return Br(Wo(Ei,6*e),Wo(Ei,6*e+6),t*16-e)}function Ai(t,e){let n=new Uint8ClampedArray(2048).
fill(255),[o,r]=[Wo(t.unobserved),Wo(t.unobservedWall)];for(let s=0;s<256;s++){let i=e==="entropy"?co(s/255):s/255;n.set(e==="value"?jr(t,s/255):uo(i),4*s),n.set(
Br(o,r,e==="value"?s/255:0),4*(s+256))}return new Uint32Array(n.buffer)}var Ci=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(
e).map(Math.round)})`)})`;var $o=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,r)=>({layer:o,canvas:n[r],context:n[r].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:r,transform:s}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*r)),height:Math.max(1,Math.ceil(o*r))},
a=[e.look.theme,n,o,r,s.scale,s.x,s.y];for(let c of this.sheets){let{canvas:p,context:m,layer:f}=c,g=[...a,...f.depends(e)];g.length===c.before.length&&g.every(
(x,b)=>Object.is(x,c.before[b]))||(c.before=g,(p.width!==i.width||p.height!==i.height)&&(Object.assign(p,i),p.style.width=`${i.width/r}px`,p.style.height=`${i.height/
r}px`),m.setTransform(1,0,0,1,0,0),m.clearRect(0,0,p.width,p.height),m.setTransform(r,0,0,r,0,0),m.save(),f.paint(m,e),m.restore(),this.paints[f.name]++)}}};function Ot(t,{
session:e,view:n}){let[o,r]=e.shape,{scale:s,x:i,y:a}=n.transform;t.beginPath(),t.rect(i,a,o*s,r*s),t.clip()}var Ic=9,Uc=2.5,In=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}paint(e,n){let{session:o}=n;o.document&&(Ot(
e,n),o.decisions.looking&&this.views(e,n),this.path(e,n))}views(e,{session:n,view:o,look:r}){let{views:s}=n.decisions,i=n.document?.grid;if(!s?.nats.length||!i)
return;let[a,c]=[Math.min(...s.nats),Math.max(...s.nats)],p=de(.38*s.spacing*o.transform.scale/i.resolution,Uc,Ic),m=s.nats.indexOf(c);for(let f=0;f<s.nats.length;f++){
let g=o.fromGrid(yt({x:s.pose[3*f],y:s.pose[3*f+1]},i),i.shape[1]);e.beginPath(),e.arc(g.x,g.y,p,0,2*Math.PI),e.fillStyle=`rgb(${uo(de((s.nats[f]-a)/Math.max(c-
a,1e-9),0,1)).map(Math.round)})`,e.fill(),f===m&&(e.lineWidth=2.5,e.strokeStyle=r.theme.truth,e.stroke())}}path(e,{session:n,view:o,look:r}){let{start:s,goal:i,
path:a,radius:c}=n.decisions,p=n.document?.grid;if(!p||!s)return;let m=f=>o.fromGrid(yt(f,p),p.shape[1]);if(a){e.beginPath();for(let[f,g]of a.path){let x=m({x:f,
y:g});e.lineTo(x.x,x.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=a.within_risk?r.theme.sensor:r.theme.truth,e.globalAlpha=.3,e.lineWidth=2*c*o.transform.scale/
p.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let f of i?[s,i]:[s]){let{x:g,y:x}=m(f);e.beginPath(),e.arc(g,x,5,0,2*Math.PI),e.fillStyle=
f===s?r.theme.sensor:r.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke()}}};var zc=10,Vc=7,Wc=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Go=()=>document.createElement("canvas").getContext("2d"),Un=class{name="\
field";cells=Go();mask=Go();hatch=Go();palettes=new Map;image=new ImageData(1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.
shown,e.view.layer==="entropy",...e.shape,e.document===null]}paint(e,n){let{session:o,view:r,look:s}=n;if(!o.document)return;let[i,a]=o.shape,{scale:c,x:p,y:m}=r.
transform;Ot(e,n);let f=o.shown;if(!f||f.p.length!==i*a){e.fillStyle=s.theme.unobserved,e.fillRect(p,m,i*c,a*c);return}this.fill(f,i,a,s.theme,Wc(f,o.view.layer)),
e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,p,m,i*c,a*c),this.fillHatch(n),e.drawImage(this.hatch.canvas,0,0,this.hatch.canvas.width/r.ratio,this.hatch.
canvas.height/r.ratio),c>=zc&&this.lines(e,n)}fill(e,n,o,r,s){let{cells:i,mask:a,drawn:c}=this,p=`${r.ground} ${s}`;if(c.field===e&&c.palette===p)return;let m=this.
palettes.get(p)??Ai(r,s);if(this.palettes.set(p,m),this.image.width!==n||this.image.height!==o){this.image=new ImageData(n,o);for(let{canvas:g}of[i,a])Object.assign(
g,{width:n,height:o});c.bits=null}let f=new Uint32Array(this.image.data.buffer);for(let g=0,x=0;g<o;g++)for(let b=o-1-g;b<n*o;b+=o)f[x++]=m[e.p[b]+(e.observed[b]?
0:256)];if(i.putImageData(this.image,0,0),c.bits!==e.bits){for(let g=0,x=0;g<o;g++)for(let b=o-1-g;b<n*o;b+=o)f[x++]=e.observed[b]?0:4278190080;a.putImageData(this.
image,0,0),c.hatch=""}Object.assign(c,{field:e,bits:e.bits,palette:p})}fillHatch({session:e,view:n,look:o}){let{hatch:r,mask:s,drawn:i}=this,{ratio:a,width:c,height:p}=n,
{scale:m,x:f,y:g}=n.transform,[x,b]=e.shape,M=[o.theme.ground,m,f,g,c,p,a].join(" ");if(i.hatch===M)return;i.hatch=M;let T=Go(),C=T.canvas.width=T.canvas.height=
Math.round(Vc*a);T.strokeStyle=o.theme.hatch,T.lineWidth=a,T.beginPath();for(let L of[-C,0,C])T.moveTo(L-1,C+1),T.lineTo(L+C+1,-1);T.stroke(),Object.assign(r.canvas,
{width:Math.ceil(c*a),height:Math.ceil(p*a)}),r.setTransform(a,0,0,a,0,0),r.imageSmoothingEnabled=!1,r.drawImage(s.canvas,f,g,x*m,b*m),r.globalCompositeOperation=
"source-in",r.setTransform(1,0,0,1,0,0);let S=r.createPattern(T.canvas,"repeat");S.setTransform(new DOMMatrix().translate(Math.round(f*a),Math.round(g*a))),r.fillStyle=
S,r.fillRect(0,0,r.canvas.width,r.canvas.height)}lines(e,{session:n,view:o,look:r}){let[s,i]=n.shape,{scale:a,x:c,y:p}=o.transform;e.beginPath();for(let m=1;m<s;m++)
e.moveTo(c+m*a,p),e.lineTo(c+m*a,p+i*a);for(let m=1;m<i;m++)e.moveTo(c,p+m*a),e.lineTo(c+s*a,p+m*a);e.strokeStyle=r.theme.lines,e.lineWidth=1,e.stroke()}};var Hc=46;function $c(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function _i(t,{session:e,view:n,look:o}){if(!e.document)return;
let{theme:r}=o,{width:s,height:i}=n,{origin:a,resolution:c,shape:p}=e.document.grid,{scale:m,x:f,y:g}=n.transform,x=$c(Hc/m*c),b=Math.min(g+p[1]*m,i-je.bottom)+
.5,M=Math.max(f,je.left)-.5;t.fillStyle=r.ground,f<M&&t.fillRect(0,0,M,i+1),g+p[1]*m>b&&t.fillRect(0,b,s+1,i+1-b);let T=Math.max(0,-Math.floor(Math.log10(x)+1e-9));
t.strokeStyle=r.frame,t.lineWidth=1,t.beginPath();let C=L=>Math.ceil(a[L]/x-1e-9)*x,S=L=>a[L]+p[L]*c+1e-9;for(let L=C(0);L<=S(0);L+=x){let P=f+(L-a[0])/c*m;P<M||
P>s-4||(t.moveTo(P,b),t.lineTo(P,b+4),On(t,L.toFixed(T),P,b+12,r,"center"))}for(let L=C(1);L<=S(1);L+=x){let P=g+(p[1]-(L-a[1])/c)*m;P>b||P<4||(t.moveTo(M,P),t.
lineTo(M-4,P),On(t,L.toFixed(T),M-7,P,r,"right"))}t.stroke(),On(t,"m",M-7,b+12,r,"right")}var zn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=Gr(e).flatMap(({id:i,x:a,y:c,yaw:p})=>[i,a,c,p]),{grid:r}=e.document??{},
s=Li(e)&&n.truth&&e.wallsVersion;return[r&&[...r.shape,...r.origin,r.resolution].join(),s,n.selected,...o]}paint(e,n){let{session:o,view:r,look:s}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:c,x:p,y:m}=r.transform;s.truth&&Li(o)&&this.truth(e,n),e.strokeStyle=s.theme.frame,e.lineWidth=1,e.strokeRect(p-.5,m-.5,i*c+1,a*c+
1),Mi(e,n),_i(e,n)}truth(e,n){let{session:o,view:r,look:s}=n,{scale:i,x:a,y:c}=r.transform;this.edgesOf!==o.wallsVersion&&(this.edges=hi(o.walls,o.shape),this.edgesOf=
o.wallsVersion),e.save(),Ot(e,n),e.transform(i,0,0,-i,a,c+o.shape[1]*i),e.lineCap="square",e.strokeStyle=s.theme.truth,e.lineWidth=de(i*.09,1,2.5)/i,e.stroke(this.
edges),e.restore()}},Li=({document:t})=>t?.source.kind==="simulation";var Gc=2.5,Vn=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution]}paint(e,n){let{session:o,look:r}=n,
{overlay:s,document:i}=o;!s||!i||(Ot(e,n),r.trajectory&&this.trajectory(e,n,s.trajectory),r.strokes&&n.view.transform.scale>=Gc&&this.strokes(e,n,s.strokes))}trajectory(e,{
session:n,view:o,look:r},s){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<s.length;a+=2){let c=o.fromGrid(yt({x:s[a],y:s[a+1]},i),i.shape[1]);e.lineTo(
c.x,c.y)}e.strokeStyle=r.theme.sensor,e.globalAlpha=.6,e.lineWidth=1,e.lineJoin="round",e.stroke(),e.globalAlpha=1}}strokes(e,{session:n,view:o,look:r},s){let i=n.
document?.grid;if(i){e.beginPath();for(let a=0;a<s.length;a+=5){let[c,p,m,f]=s.subarray(a,a+4),[g,x]=[o.fromGrid(yt({x:c,y:p},i),i.shape[1]),o.fromGrid(yt({x:m,
y:f},i),i.shape[1])];e.moveTo(g.x,g.y),e.lineTo(x.x,x.y)}e.strokeStyle=r.theme.ray,e.lineCap="round",e.lineWidth=de(o.transform.scale/5,.8,2.5),e.stroke()}}};var Bc=600,Wn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings]}paint(e,n){let{session:o,view:r,look:s}=n,{scan:i,
document:a}=o;if(!i||!a||!(s.rays||s.readings))return;Ot(e,n);let{scale:c}=r.transform,p=1/a.grid.resolution,m=a.grid.shape[1],f=i.angles.length,g=i.pose.length/
3,[x,b,M]=[new Path2D,new Path2D,new Path2D],T=de(c*.1,1.3,4);for(let C=0;C<g;C++){let[S,L,P]=i.pose.subarray(3*C,3*C+3),j=r.fromGrid(yt({x:S,y:L},a.grid),m);for(let D=0;D<
f;D++){let Z=i.ranges[C*f+D],$=i.hit[C*f+D]===1,R=($?Z:a.max_range)*p*c,V=i.angles[D]+P,A={x:j.x+R*Math.cos(V),y:j.y-R*Math.sin(V)},q=$?x:b;q.moveTo(j.x,j.y),q.
lineTo(A.x,A.y),$&&(f*g>Bc?M.rect(A.x-.9*T,A.y-.9*T,1.8*T,1.8*T):(M.moveTo(A.x+T,A.y),M.arc(A.x,A.y,T,0,2*Math.PI)))}}s.rays&&(e.lineWidth=1,e.globalAlpha=de(28/
Math.sqrt(f*g)/5,.07,.45),e.strokeStyle=s.theme.ray,e.stroke(x),e.strokeStyle=s.theme.noReturn,e.stroke(b),e.globalAlpha=1),s.readings&&(e.fillStyle=s.theme.ray,
e.fill(M))}};var Di=900,po=2;function Ri({session:t,look:e}){let[n,o]=t.shape,r=new Fn;r.resize(Di,Math.round(de(Di*o/n,300,1800)),po),r.fit(t.shape);let s=document.createElement(
"canvas");Object.assign(s,{width:r.width*po,height:r.height*po});let i=s.getContext("2d");i.scale(po,po),i.fillStyle=e.theme.ground,i.fillRect(0,0,r.width,r.height);
let a=[new Un,new Vn,new Wn,new zn,new In];for(let c of a)i.save(),c.paint(i,{session:t,view:r,look:{...e,hover:null,cursor:null,selected:null}}),i.restore();return new Promise(
c=>s.toBlob(c))}function k(t,e={},...n){let o=document.createElement(t);for(let[r,s]of Object.entries(e))r.startsWith("on")?o.addEventListener(r.slice(2),s):r.includes("-")||r===
"role"||r==="for"?o.setAttribute(r,s):o[r]=s;for(let r of n)r!==null&&o.append(r);return o}function z(t,e,n){t[e]!==n&&(t[e]=n)}function Tt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var fo=t=>t.getRootNode().activeElement===t,bt=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function Kr(t,e){let n=URL.
createObjectURL(e);k("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Ni=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["path","Path","path"],["look","Look next","look"]];function Fi(t){
let{hand:e,session:n}=t,o=t.segmented("Tool",Ni,()=>n.editable||!n.document||Ft.has(e.tool)?e.tool:"pan",r=>e.choose(r),r=>n.editable||Ft.has(r)&&!n.recorded||r===
"pan");return t.visible(o,()=>!n.recorded),Ni.forEach(([r],s)=>{Ft.has(r)||t.visible(o.children[s],()=>!n.document||n.editable)}),k("div",{className:"bar"},o,k(
"span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoo\
m in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var jc="uplot",Kc="u-hz",qc="u-vt",Yc="u-title",Jc="u-wrap",Zc="u-under",Qc="u-over",Xc="u-axis",pn="u-off",eu="u-select",tu="u-cursor-x",nu="u-cursor-y",ou="u-\
cursor-pt",ru="u-legend",su="u-live",iu="u-inline",lu="u-series",au="u-marker",Oi="u-label",cu="u-value",mo="width",go="height";var Ii="bottom",Hn="left",qr="right",ps="#000",Ui=ps+"0",Yr="mousemove",zi="mousedown",Jr="mouseup",Vi="mouseenter",Wi="mouseleave",Hi="dblclick",uu="resize",pu="\
scroll",$i="change",Yo="dppxchange",ds="--",Yn=typeof window<"u",ts=Yn?document:null,Gn=Yn?window:null,du=Yn?navigator:null,pe,Bo;function ns(){let t=devicePixelRatio;
pe!=t&&(pe=t,Bo&&rs($i,Bo,ns),Bo=matchMedia(`(min-resolution: ${pe-.001}dppx) and (max-resolution: ${pe+.001}dppx)`),dn($i,Bo,ns),Gn.dispatchEvent(new CustomEvent(
Yo)))}function at(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function os(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Se(t,e,n){
t.style[e]=n+"px"}function Pt(t,e,n,o){let r=ts.createElement(t);return e!=null&&at(r,e),n?.insertBefore(r,o),r}function wt(t,e){return Pt("div",t,e)}var Gi=new WeakMap;
function It(t,e,n,o,r){let s="translate("+e+"px,"+n+"px)",i=Gi.get(t);s!=i&&(t.style.transform=s,Gi.set(t,s),e<0||n<0||e>o||n>r?at(t,pn):os(t,pn))}var Bi=new WeakMap;
function ji(t,e,n){let o=e+n,r=Bi.get(t);o!=r&&(Bi.set(t,o),t.style.background=e,t.style.borderColor=n)}var Ki=new WeakMap;function qi(t,e,n,o){let r=e+""+n,s=Ki.
get(t);r!=s&&(Ki.set(t,r),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var fs={passive:!0},fu={...fs,
capture:!0};function dn(t,e,n,o){e.addEventListener(t,n,o?fu:fs)}function rs(t,e,n,o){e.removeEventListener(t,n,fs)}Yn&&ns();function Et(t,e,n,o){let r;n=n||0,o=
o||e.length-1;let s=o<=2147483647;for(;o-n>1;)r=s?n+o>>1:ct((n+o)/2),e[r]<t?n=r:o=r;return t-e[n]<=e[o]-t?n:o}function kl(t){return(n,o,r)=>{let s=-1,i=-1;for(let a=o;a<=
r;a++)if(t(n[a])){s=a;break}for(let a=r;a>=o;a--)if(t(n[a])){i=a;break}return[s,i]}}var Sl=t=>t!=null,Ml=t=>t!=null&&t>0,Qo=kl(Sl),hu=kl(Ml);function mu(t,e,n,o=0,r=!1){
let s=r?hu:Qo,i=r?Ml:Sl;[e,n]=s(t,e,n);let a=t[e],c=t[e];if(e>-1)if(o==1)a=t[e],c=t[n];else if(o==-1)a=t[n],c=t[e];else for(let p=e;p<=n;p++){let m=t[p];i(m)&&(m<
a?a=m:m>c&&(c=m))}return[a??ye,c??-ye]}function Xo(t,e,n,o){let r=Zi(t),s=Zi(e);t==e&&(r==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Ht:Tl,a=r==1?ct:xt,c=s==1?xt:ct,
p=a(i(Fe(t))),m=c(i(Fe(e))),f=Bn(n,p),g=Bn(n,m);return n==10&&(p<0&&(f=be(f,-p)),m<0&&(g=be(g,-m))),o||n==2?(t=f*r,e=g*s):(t=Cl(t,f),e=er(e,g)),[t,e]}function hs(t,e,n,o){
let r=Xo(t,e,n,o);return t==0&&(r[0]=0),e==0&&(r[1]=0),r}var ms=.1,Yi={mode:3,pad:ms},bo={pad:0,soft:null,mode:0},gu={min:bo,max:bo};function Jo(t,e,n,o){return tr(
n)?Ji(t,e,n):(bo.pad=n,bo.soft=o?0:null,bo.mode=o?3:0,Ji(t,e,gu))}function ae(t,e){return t??e}function yu(t,e,n){for(e=ae(e,0),n=ae(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Ji(t,e,n){let o=n.min,r=n.max,s=ae(o.pad,0),i=ae(r.pad,0),a=ae(o.hard,-ye),c=ae(r.hard,ye),p=ae(o.soft,ye),m=ae(r.soft,-ye),
f=ae(o.mode,0),g=ae(r.mode,0),x=e-t,b=Ht(x),M=Xe(Fe(t),Fe(e)),T=Ht(M),C=Fe(T-b);(x<1e-24||C>10)&&(x=0,(t==0||e==0)&&(x=1e-24,f==2&&p!=ye&&(s=0),g==2&&m!=-ye&&(i=
0)));let S=x||M||1e3,L=Ht(S),P=Bn(10,ct(L)),j=S*(x==0?t==0?.1:1:s),D=be(Cl(t-j,P/10),24),Z=t>=p&&(f==1||f==3&&D<=p||f==2&&D>=p)?p:ye,$=Xe(a,D<Z&&t>=Z?Z:At(Z,D)),
R=S*(x==0?e==0?.1:1:i),V=be(er(e+R,P/10),24),A=e<=m&&(g==1||g==3&&V>=m||g==2&&V<=m)?m:-ye,q=At(c,V>A&&e<=A?A:Xe(A,V));return $==q&&$==0&&(q=100),[$,q]}var bu=new Intl.
NumberFormat(Yn?du.language:"en-US"),gs=t=>bu.format(t),ut=Math,qo=ut.PI,Fe=ut.abs,ct=ut.floor,Ne=ut.round,xt=ut.ceil,At=ut.min,Xe=ut.max,Bn=ut.pow,Zi=ut.sign,Ht=ut.
log10,Tl=ut.log2,wu=(t,e=1)=>ut.sinh(t)*e,Zr=(t,e=1)=>ut.asinh(t/e),ye=1/0;function Qi(t){return(Ht((t^t>>31)-(t>>31))|0)+1}function ss(t,e,n){return At(Xe(t,e),
n)}function Pl(t){return typeof t=="function"}function se(t){return Pl(t)?t:()=>t}var xu=()=>{},El=t=>t,Al=(t,e)=>e,vu=t=>null,Xi=t=>!0,el=(t,e)=>t==e,ku=/\.\d*?(?=9{6,}|0{6,})/gm,
fn=t=>{if(Ll(t)||Jt.has(t))return t;let e=`${t}`,n=e.match(ku);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[r,s]=e.split("e");return+`${fn(
r)}e${s}`}return be(t,o)};function cn(t,e){return fn(be(fn(t/e))*e)}function er(t,e){return fn(xt(fn(t/e))*e)}function Cl(t,e){return fn(ct(fn(t/e))*e)}function be(t,e=0){
if(Ll(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Ne(o)/n}var Jt=new Map;function _l(t){return((""+t).split(".")[1]||"").length}function xo(t,e,n,o){
let r=[],s=o.map(_l);for(let i=e;i<n;i++){let a=Fe(i),c=be(Bn(t,i),a);for(let p=0;p<o.length;p++){let m=t==10?+`${o[p]}e${i}`:o[p]*c,f=(i>=0?0:a)+(i>=s[p]?0:s[p]),
g=t==10?m:be(m,f);r.push(g),Jt.set(g,f)}}return r}var wo={},ys=[],jn=[null,null],Yt=Array.isArray,Ll=Number.isInteger,Su=t=>t===void 0;function tl(t){return typeof t==
"string"}function tr(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function Mu(t){return t!=null&&typeof t=="object"}var Tu=Object.getPrototypeOf(
Uint8Array),Dl="__proto__";function Kn(t,e=tr){let n;if(Yt(t)){let o=t.find(r=>r!=null);if(Yt(o)||e(o)){n=Array(t.length);for(let r=0;r<t.length;r++)n[r]=Kn(t[r],
e)}else n=t.slice()}else if(t instanceof Tu)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Dl&&(n[o]=Kn(t[o],e))}else n=t;return n}function Le(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let r in o)r!=Dl&&(tr(t[r])?Le(t[r],Kn(o[r])):t[r]=Kn(o[r]))}return t}var Pu=0,Eu=1,Au=2;function Cu(t,e,n){for(let o=0,
r,s=-1;o<e.length;o++){let i=e[o];if(i>s){for(r=i-1;r>=0&&t[r]==null;)t[r--]=null;for(r=i+1;r<n&&t[r]==null;)t[s=r++]=null}}}function _u(t,e){if(Ru(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return Nu(i[0])||(i=Du(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let c=t[i][0],p=c.length;for(let m=0;m<
p;m++)n.add(c[m])}let o=[Array.from(n).sort((i,a)=>i-a)],r=o[0].length,s=new Map;for(let i=0;i<r;i++)s.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],c=a[0];
for(let p=1;p<a.length;p++){let m=a[p],f=Array(r).fill(void 0),g=e?e[i][p]:Eu,x=[];for(let b=0;b<m.length;b++){let M=m[b],T=s.get(c[b]);M===null?g!=Pu&&(f[T]=M,
g==Au&&x.push(T)):f[T]=M}Cu(f,x,r),o.push(f)}}return o}var Lu=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Du(t){let e=t[0],n=e.
length,o=Array(n);for(let s=0;s<o.length;s++)o[s]=s;o.sort((s,i)=>e[s]-e[i]);let r=[];for(let s=0;s<t.length;s++){let i=t[s],a=Array(n);for(let c=0;c<n;c++)a[c]=
i[o[c]];r.push(a)}return r}function Ru(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let r=t[o][0];if(r.length!=n)return!1;if(r!=e){for(let s=0;s<n;s++)
if(r[s]!=e[s])return!1}}return!0}function Nu(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,r=n-1;for(;o<=r&&t[o]==null;)o++;for(;r>=o&&t[r]==null;)r--;if(r<=
o)return!0;let s=Xe(1,ct((r-o+1)/e));for(let i=t[o],a=o+s;a<=r;a+=s){let c=t[a];if(c!=null){if(c<=i)return!1;i=c}}return!0}var Rl=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Nl=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Fl(t){
return t.slice(0,3)}var Fu=Nl.map(Fl),Ou=Rl.map(Fl),Iu={MMMM:Rl,MMM:Ou,WWWW:Nl,WWW:Fu};function ho(t){return(t<10?"0":"")+t}function Uu(t){return(t<10?"00":t<100?
"0":"")+t}var zu={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>ho(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>ho(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>ho(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>ho(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>ho(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Uu(t.getMilliseconds())};function bs(t,e){e=e||Iu;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
r;for(;r=o.exec(t);)n.push(r[0][0]=="{"?zu[r[1]]:r[0]);return s=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](s,e);return i}}var Vu=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function Wu(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Vu?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var Ol=t=>t%1==0,Zo=[1,2,2.5,5],Hu=xo(10,-32,0,Zo),Il=xo(10,0,32,Zo),$u=Il.filter(
Ol),un=Hu.concat(Il),ws=`
`,Ul="{YYYY}",nl=ws+Ul,zl="{M}/{D}",yo=ws+zl,jo=yo+"/{YY}",Vl="{aa}",Gu="{h}:{mm}",$n=Gu+Vl,ol=ws+$n,rl=":{ss}",fe=null;function Wl(t){let e=t*1e3,n=e*60,o=n*60,
r=o*24,s=r*30,i=r*365,c=(t==1?xo(10,0,3,Zo).filter(Ol):xo(10,-3,0,Zo)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,r,r*2,r*3,r*
4,r*5,r*6,r*7,r*8,r*9,r*10,r*15,s,s*2,s*3,s*4,s*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),p=[[i,Ul,fe,fe,fe,fe,fe,fe,1],[r*28,"{MMM}",nl,fe,fe,fe,fe,fe,1],[r,zl,nl,fe,
fe,fe,fe,fe,1],[o,"{h}"+Vl,jo,fe,yo,fe,fe,fe,1],[n,$n,jo,fe,yo,fe,fe,fe,1],[e,rl,jo+" "+$n,fe,yo+" "+$n,fe,ol,fe,1],[t,rl+".{fff}",jo+" "+$n,fe,yo+" "+$n,fe,ol,
fe,1]];function m(f){return(g,x,b,M,T,C)=>{let S=[],L=T>=i,P=T>=s&&T<i,j=f(b),D=be(j*t,3),Z=Qr(j.getFullYear(),L?0:j.getMonth(),P||L?1:j.getDate()),$=be(Z*t,3);
if(P||L){let R=P?T/s:0,V=L?T/i:0,A=D==$?D:be(Qr(Z.getFullYear()+V,Z.getMonth()+R,1)*t,3),q=new Date(Ne(A/t)),U=q.getFullYear(),K=q.getMonth();for(let H=0;A<=M;H++){
let ne=Qr(U+V*H,K+R*H,1),G=ne-f(be(ne*t,3));A=be((+ne+G)*t,3),A<=M&&S.push(A)}}else{let R=T>=r?r:T,V=ct(b)-ct(D),A=$+V+er(D-$,R);S.push(A);let q=f(A),U=q.getHours()+
q.getMinutes()/n+q.getSeconds()/o,K=T/o,H=g.axes[x]._space,ne=C/H;for(;A=be(A+T,t==1?0:3),!(A>M);)if(K>1){let G=ct(be(U+K,6))%24,re=f(A).getHours()-G;re>1&&(re=
-1),A-=re*o,U=(U+K)%24;let ce=S[S.length-1];be((A-ce)/T,3)*ne>=.7&&S.push(A)}else S.push(A)}return S}}return[c,p,m]}var[Bu,ju,Ku]=Wl(1),[qu,Yu,Ju]=Wl(.001);xo(2,
-53,53,[1]);function sl(t,e){return t.map(n=>n.map((o,r)=>r==0||r==8||o==null?o:e(r==1||n[8]==0?o:n[1]+o)))}function il(t,e){return(n,o,r,s,i)=>{let a=e.find(b=>i>=
b[0])||e[e.length-1],c,p,m,f,g,x;return o.map(b=>{let M=t(b),T=M.getFullYear(),C=M.getMonth(),S=M.getDate(),L=M.getHours(),P=M.getMinutes(),j=M.getSeconds(),D=T!=
c&&a[2]||C!=p&&a[3]||S!=m&&a[4]||L!=f&&a[5]||P!=g&&a[6]||j!=x&&a[7]||a[1];return c=T,p=C,m=S,f=L,g=P,x=j,D(M)})}}function Zu(t,e){let n=bs(e);return(o,r,s,i,a)=>r.
map(c=>n(t(c)))}function Qr(t,e,n){return new Date(t,e,n)}function ll(t,e){return e(t)}var Qu="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function al(t,e){return(n,o,r,s)=>s==
null?ds:e(t(o))}function Xu(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function ep(t,e){return t.series[e].fill(
t,e)}var tp={show:!0,live:!0,isolate:!1,mount:xu,markers:{show:!0,width:2,stroke:Xu,fill:ep,dash:"solid"},idx:null,idxs:null,values:[]};function np(t,e){let n=t.
cursor.points,o=wt(),r=n.size(t,e);Se(o,mo,r),Se(o,go,r);let s=r/-2;Se(o,"marginLeft",s),Se(o,"marginTop",s);let i=n.width(t,e,r);return i&&Se(o,"borderWidth",i),
o}function op(t,e){let n=t.series[e].points;return n._fill||n._stroke}function rp(t,e){let n=t.series[e].points;return n._stroke||n._fill}function sp(t,e){return t.
series[e].points.size}var Xr=[0,0];function ip(t,e,n){return Xr[0]=e,Xr[1]=n,Xr}function Ko(t,e,n,o=!0){return r=>{r.button==0&&(!o||r.target==e)&&n(r)}}function es(t,e,n,o=!0){
return r=>{(!o||r.target==e)&&n(r)}}var lp={show:!0,x:!0,y:!0,lock:!1,move:ip,points:{one:!1,show:np,size:sp,width:0,stroke:rp,fill:op},bind:{mousedown:Ko,mouseup:Ko,
click:Ko,dblclick:Ko,mousemove:es,mouseleave:es,mouseenter:es},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,r)=>o-r,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Hl={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},xs=Le({},Hl,{filter:Al}),$l=Le({},xs,{size:10}),Gl=Le({},Hl,{show:!1}),vs='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Bl="bold "+vs,jl=1.5,cl={
show:!0,scale:"x",stroke:ps,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Bl,side:2,grid:xs,ticks:$l,border:Gl,font:vs,lineGap:jl,rotate:0},
ap="Value",cp="Time",ul={show:!0,scale:"x",auto:!1,sorted:1,min:ye,max:-ye,idxs:[]};function up(t,e,n,o,r){return e.map(s=>s==null?"":gs(s))}function pp(t,e,n,o,r,s,i){
let a=[],c=Jt.get(r)||0;n=i?n:be(er(n,r),c);for(let p=n;p<=o;p=be(p+r,c))a.push(Object.is(p,-0)?0:p);return a}function is(t,e,n,o,r,s,i){let a=[],c=t.scales[t.axes[e].
scale].log,p=c==10?Ht:Tl,m=ct(p(n));r=Bn(c,m),c==10&&(r=un[Et(r,un)]);let f=n,g=r*c;c==10&&(g=un[Et(g,un)]);do a.push(f),f=f+r,c==10&&!Jt.has(f)&&(f=be(f,Jt.get(
r))),f>=g&&(r=f,g=r*c,c==10&&(g=un[Et(g,un)]));while(f<=o);return a}function dp(t,e,n,o,r,s,i){let c=t.scales[t.axes[e].scale].asinh,p=o>c?is(t,e,Xe(c,n),o,r):[
c],m=o>=0&&n<=0?[0]:[];return(n<-c?is(t,e,Xe(c,-o),-n,r):[c]).reverse().map(g=>-g).concat(m,p)}var Kl=/./,fp=/[12357]/,hp=/[125]/,pl=/1/,ls=(t,e,n,o)=>t.map((r,s)=>e==
4&&r==0||s%o==0&&n.test(r.toExponential()[r<0?1:0])?r:null);function mp(t,e,n,o,r){let s=t.axes[n],i=s.scale,a=t.scales[i],c=t.valToPos,p=s._space,m=c(10,i),f=c(
9,i)-m>=p?Kl:c(7,i)-m>=p?fp:c(5,i)-m>=p?hp:pl;if(f==pl){let g=Fe(c(1,i)-m);if(g<p)return ls(e.slice().reverse(),a.distr,f,xt(p/g)).reverse()}return ls(e,a.distr,
f,1)}function gp(t,e,n,o,r){let s=t.axes[n],i=s.scale,a=s._space,c=t.valToPos,p=Fe(c(1,i)-c(2,i));return p<a?ls(e.slice().reverse(),3,Kl,xt(a/p)).reverse():e}function yp(t,e,n,o){
return o==null?ds:e==null?"":gs(e)}var dl={show:!0,scale:"y",stroke:ps,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Bl,side:3,grid:xs,ticks:$l,
border:Gl,font:vs,lineGap:jl,rotate:0};function bp(t,e){let n=3+(t||1)*2;return be(n*e,3)}function wp(t,e){let{scale:n,idxs:o}=t.series[0],r=t._data[0],s=t.valToPos(
r[o[0]],n,!0),i=t.valToPos(r[o[1]],n,!0),a=Fe(i-s),c=t.series[e],p=a/(c.points.space*pe);return o[1]-o[0]<=p}var fl={scale:null,auto:!0,sorted:0,min:ye,max:-ye},
ql=(t,e,n,o,r)=>r,hl={show:!0,auto:!0,sorted:0,gaps:ql,alpha:1,facets:[Le({},fl,{scale:"x"}),Le({},fl,{scale:"y"})]},ml={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:ql,alpha:1,points:{show:wp,filter:null},values:null,min:ye,max:-ye,idxs:[],path:null,clip:null};function xp(t,e,n,o,r){return n/10}var Yl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},vp=Le({},Yl,{time:!1,ori:1}),gl={};function Jl(t,e){let n=gl[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(r=>r!=o)},pub(o,r,s,i,a,c,p){for(let m=0;m<n.plots.length;m++)n.plots[m]!=r&&n.plots[m].pub(o,r,s,i,a,c,p)}},t!=null&&(gl[t]=
n)),n}var qn=1,as=2;function hn(t,e,n){let o=t.mode,r=t.series[e],s=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,c=s[0],p=o==2?s[1]:s[e],m=o==2?i[r.facets[0].scale]:
i[t.series[0].scale],f=o==2?i[r.facets[1].scale]:i[r.scale],g=a.left,x=a.top,b=a.width,M=a.height,T=t.valToPosH,C=t.valToPosV;return m.ori==0?n(r,c,p,m,f,T,C,g,
x,b,M,or,Jn,sr,Ql,ea):n(r,c,p,m,f,C,T,x,g,M,b,rr,Zn,Ms,Xl,ta)}function ks(t,e){let n=0,o=0,r=ae(t.bands,ys);for(let s=0;s<r.length;s++){let i=r[s];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function kp(t,e,n,o,r){let s=t.mode,i=t.series[e],a=s==2?i.facets[1].scale:i.scale,
c=t.scales[a];return r==-1?c.min:r==1?c.max:c.distr==3?c.dir==1?c.min:c.max:0}function $t(t,e,n,o,r,s){return hn(t,e,(i,a,c,p,m,f,g,x,b,M,T)=>{let C=i.pxRound,S=p.
dir*(p.ori==0?1:-1),L=p.ori==0?Jn:Zn,P,j;S==1?(P=n,j=o):(P=o,j=n);let D=C(f(a[P],p,M,x)),Z=C(g(c[P],m,T,b)),$=C(f(a[j],p,M,x)),R=C(g(s==1?m.max:m.min,m,T,b)),V=new Path2D(
r);return L(V,$,R),L(V,D,R),L(V,D,Z),V})}function nr(t,e,n,o,r,s){let i=null;if(t.length>0){i=new Path2D;let a=e==0?sr:Ms,c=n;for(let f=0;f<t.length;f++){let g=t[f];
if(g[1]>g[0]){let x=g[0]-c;x>0&&a(i,c,o,x,o+s),c=g[1]}}let p=n+r-c,m=10;p>0&&a(i,c,o-m/2,p,o+s+m)}return i}function Sp(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Ss(t,e,n,o,r,s,i){let a=[],c=t.length;for(let p=r==1?n:o;p>=n&&p<=o;p+=r)if(e[p]===null){let f=p,g=p;if(r==1)for(;++p<=o&&e[p]===null;)
g=p;else for(;--p>=n&&e[p]===null;)g=p;let x=s(t[f]),b=g==f?x:s(t[g]),M=f-r;x=i<=0&&M>=0&&M<c?s(t[M]):x;let C=g+r;b=i>=0&&C>=0&&C<c?s(t[C]):b,b>=x&&a.push([x,b])}
return a}function yl(t){return t==0?El:t==1?Ne:e=>cn(e,t)}function Zl(t){let e=t==0?or:rr,n=t==0?(r,s,i,a,c,p)=>{r.arcTo(s,i,a,c,p)}:(r,s,i,a,c,p)=>{r.arcTo(i,s,
c,a,p)},o=t==0?(r,s,i,a,c)=>{r.rect(s,i,a,c)}:(r,s,i,a,c)=>{r.rect(i,s,c,a)};return(r,s,i,a,c,p=0,m=0)=>{p==0&&m==0?o(r,s,i,a,c):(p=At(p,a/2,c/2),m=At(m,a/2,c/2),
e(r,s+p,i),n(r,s+a,i,s+a,i+c,p),n(r,s+a,i+c,s,i+c,m),n(r,s,i+c,s,i,m),n(r,s,i,s+a,i,p),r.closePath())}}var or=(t,e,n)=>{t.moveTo(e,n)},rr=(t,e,n)=>{t.moveTo(n,e)},
Jn=(t,e,n)=>{t.lineTo(e,n)},Zn=(t,e,n)=>{t.lineTo(n,e)},sr=Zl(0),Ms=Zl(1),Ql=(t,e,n,o,r,s)=>{t.arc(e,n,o,r,s)},Xl=(t,e,n,o,r,s)=>{t.arc(n,e,o,r,s)},ea=(t,e,n,o,r,s,i)=>{
t.bezierCurveTo(e,n,o,r,s,i)},ta=(t,e,n,o,r,s,i)=>{t.bezierCurveTo(n,e,r,o,i,s)};function na(t){return(e,n,o,r,s)=>hn(e,n,(i,a,c,p,m,f,g,x,b,M,T)=>{let{pxRound:C,
points:S}=i,L,P;p.ori==0?(L=or,P=Ql):(L=rr,P=Xl);let j=be(S.width*pe,3),D=(S.size-S.width)/2*pe,Z=be(D*2,3),$=new Path2D,R=new Path2D,{left:V,top:A,width:q,height:U}=e.
bbox;sr(R,V-Z,A-Z,q+Z*2,U+Z*2);let K=H=>{if(c[H]!=null){let ne=C(f(a[H],p,M,x)),G=C(g(c[H],m,T,b));L($,ne+D,G),P($,ne,G,D,0,qo*2)}};if(s)s.forEach(K);else for(let H=o;H<=
r;H++)K(H);return{stroke:j>0?$:null,fill:$,clip:R,flags:qn|as}})}function oa(t){return(e,n,o,r,s,i)=>{o!=r&&(s!=o&&i!=o&&t(e,n,o),s!=r&&i!=r&&t(e,n,r),t(e,n,i))}}
var Mp=oa(Jn),Tp=oa(Zn);function ra(t){let e=ae(t?.alignGaps,0);return(n,o,r,s)=>hn(n,o,(i,a,c,p,m,f,g,x,b,M,T)=>{[r,s]=Qo(c,r,s);let C=i.pxRound,S=U=>C(f(U,p,M,
x)),L=U=>C(g(U,m,T,b)),P,j;p.ori==0?(P=Jn,j=Mp):(P=Zn,j=Tp);let D=p.dir*(p.ori==0?1:-1),Z={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:qn},$=Z.
stroke,R=!1;if(s-r>=M*4){let U=W=>n.posToVal(W,p.key,!0),K=null,H=null,ne,G,Ke,me=S(a[D==1?r:s]),re=S(a[r]),ce=S(a[s]),X=U(D==1?re+1:ce-1);for(let W=D==1?r:s;W>=
r&&W<=s;W+=D){let Pe=a[W],ge=(D==1?Pe<X:Pe>X)?me:S(Pe),ie=c[W];ge==me?ie!=null?(G=ie,K==null?(P($,ge,L(G)),ne=K=H=G):G<K?K=G:G>H&&(H=G)):ie===null&&(R=!0):(K!=null&&
j($,me,L(K),L(H),L(ne),L(G)),ie!=null?(G=ie,P($,ge,L(G)),K=H=ne=G):(K=H=null,ie===null&&(R=!0)),me=ge,X=U(me+D))}K!=null&&K!=H&&Ke!=me&&j($,me,L(K),L(H),L(ne),L(
G))}else for(let U=D==1?r:s;U>=r&&U<=s;U+=D){let K=c[U];K===null?R=!0:K!=null&&P($,S(a[U]),L(K))}let[A,q]=ks(n,o);if(i.fill!=null||A!=0){let U=Z.fill=new Path2D(
$),K=i.fillTo(n,o,i.min,i.max,A),H=L(K),ne=S(a[r]),G=S(a[s]);D==-1&&([G,ne]=[ne,G]),P(U,G,H),P(U,ne,H)}if(!i.spanGaps){let U=[];R&&U.push(...Ss(a,c,r,s,D,S,e)),
Z.gaps=U=i.gaps(n,o,r,s,U),Z.clip=nr(U,p.ori,x,b,M,T)}return q!=0&&(Z.band=q==2?[$t(n,o,r,s,$,-1),$t(n,o,r,s,$,1)]:$t(n,o,r,s,$,q)),Z})}function Pp(t){let e=ae(
t.align,1),n=ae(t.ascDesc,!1),o=ae(t.alignGaps,0),r=ae(t.extend,!1);return(s,i,a,c)=>hn(s,i,(p,m,f,g,x,b,M,T,C,S,L)=>{[a,c]=Qo(f,a,c);let P=p.pxRound,{left:j,width:D}=s.
bbox,Z=re=>P(b(re,g,S,T)),$=re=>P(M(re,x,L,C)),R=g.ori==0?Jn:Zn,V={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:qn},A=V.stroke,q=g.dir*(g.ori==
0?1:-1),U=$(f[q==1?a:c]),K=Z(m[q==1?a:c]),H=K,ne=K;r&&e==-1&&(ne=j,R(A,ne,U)),R(A,K,U);for(let re=q==1?a:c;re>=a&&re<=c;re+=q){let ce=f[re];if(ce==null)continue;
let X=Z(m[re]),W=$(ce);e==1?R(A,X,U):R(A,H,W),R(A,X,W),U=W,H=X}let G=H;r&&e==1&&(G=j+D,R(A,G,U));let[Ke,me]=ks(s,i);if(p.fill!=null||Ke!=0){let re=V.fill=new Path2D(
A),ce=p.fillTo(s,i,p.min,p.max,Ke),X=$(ce);R(re,G,X),R(re,ne,X)}if(!p.spanGaps){let re=[];re.push(...Ss(m,f,a,c,q,Z,o));let ce=p.width*pe/2,X=n||e==1?ce:-ce,W=n||
e==-1?-ce:ce;re.forEach(Pe=>{Pe[0]+=X,Pe[1]+=W}),V.gaps=re=p.gaps(s,i,a,c,re),V.clip=nr(re,g.ori,T,C,S,L)}return me!=0&&(V.band=me==2?[$t(s,i,a,c,A,-1),$t(s,i,a,
c,A,1)]:$t(s,i,a,c,A,me)),V})}function bl(t,e,n,o,r,s,i=ye){if(t.length>1){let a=null;for(let c=0,p=1/0;c<t.length;c++)if(e[c]!==void 0){if(a!=null){let m=Fe(t[c]-
t[a]);m<p&&(p=m,i=Fe(n(t[c],o,r,s)-n(t[a],o,r,s)))}a=c}}return i}function Ep(t){t=t||wo;let e=ae(t.size,[.6,ye,1]),n=t.align||0,o=t.gap||0,r=t.radius;r=r==null?
[0,0]:typeof r=="number"?[r,0]:r;let s=se(r),i=1-e[0],a=ae(e[1],ye),c=ae(e[2],1),p=ae(t.disp,wo),m=ae(t.each,x=>{}),{fill:f,stroke:g}=p;return(x,b,M,T)=>hn(x,b,
(C,S,L,P,j,D,Z,$,R,V,A)=>{let q=C.pxRound,U=n,K=o*pe,H=a*pe,ne=c*pe,G,Ke;P.ori==0?[G,Ke]=s(x,b):[Ke,G]=s(x,b);let me=P.dir*(P.ori==0?1:-1),re=P.ori==0?sr:Ms,ce=P.
ori==0?m:(O,we,Re,yn,en,Ct,tn)=>{m(O,we,Re,en,yn,tn,Ct)},X=ae(x.bands,ys).find(O=>O.series[0]==b),W=X!=null?X.dir:0,Pe=C.fillTo(x,b,C.min,C.max,W),Ie=q(Z(Pe,j,A,
R)),ge,ie,pt,et=V,Me=q(C.width*pe),ot=!1,Y=null,te=null,De=null,Ut=null;f!=null&&(Me==0||g!=null)&&(ot=!0,Y=f.values(x,b,M,T),te=new Map,new Set(Y).forEach(O=>{
O!=null&&te.set(O,new Path2D)}),Me>0&&(De=g.values(x,b,M,T),Ut=new Map,new Set(De).forEach(O=>{O!=null&&Ut.set(O,new Path2D)})));let{x0:mn,size:Xn}=p;if(mn!=null&&
Xn!=null){U=1,S=mn.values(x,b,M,T),mn.unit==2&&(S=S.map(Re=>x.posToVal($+Re*V,P.key,!0)));let O=Xn.values(x,b,M,T);Xn.unit==2?ie=O[0]*V:ie=D(O[0],P,V,$)-D(0,P,V,
$),et=bl(S,L,D,P,V,$,et),pt=et-ie+K}else et=bl(S,L,D,P,V,$,et),pt=et*i+K,ie=et-pt;pt<1&&(pt=0),Me>=ie/2&&(Me=0),pt<5&&(q=El);let vo=pt>0,Qt=et-pt-(vo?Me:0);ie=q(
ss(Qt,ne,H)),ge=(U==0?ie/2:U==me?0:ie)-U*me*((U==0?K/2:0)+(vo?Me/2:0));let Ye={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},gn=ot?null:new Path2D,
zt=null;if(X!=null)zt=x.data[X.series[1]];else{let{y0:O,y1:we}=p;O!=null&&we!=null&&(L=we.values(x,b,M,T),zt=O.values(x,b,M,T))}let Xt=G*ie,ee=Ke*ie;for(let O=me==
1?M:T;O>=M&&O<=T;O+=me){let we=L[O];if(we==null)continue;if(zt!=null){let tt=zt[O]??0;if(we-tt==0)continue;Ie=Z(tt,j,A,R)}let Re=P.distr!=2||p!=null?S[O]:O,yn=D(
Re,P,V,$),en=Z(ae(we,Pe),j,A,R),Ct=q(yn-ge),tn=q(Xe(en,Ie)),rt=q(At(en,Ie)),dt=tn-rt;if(we!=null){let tt=we<0?ee:Xt,vt=we<0?Xt:ee;ot?(Me>0&&De[O]!=null&&re(Ut.get(
De[O]),Ct,rt+ct(Me/2),ie,Xe(0,dt-Me),tt,vt),Y[O]!=null&&re(te.get(Y[O]),Ct,rt+ct(Me/2),ie,Xe(0,dt-Me),tt,vt)):re(gn,Ct,rt+ct(Me/2),ie,Xe(0,dt-Me),tt,vt),ce(x,b,
O,Ct-Me/2,rt,ie+Me,dt)}}return Me>0?Ye.stroke=ot?Ut:gn:ot||(Ye._fill=C.width==0?C._fill:C._stroke??C._fill,Ye.width=0),Ye.fill=ot?te:gn,Ye})}function Ap(t,e){let n=ae(
e?.alignGaps,0);return(o,r,s,i)=>hn(o,r,(a,c,p,m,f,g,x,b,M,T,C)=>{[s,i]=Qo(p,s,i);let S=a.pxRound,L=G=>S(g(G,m,T,b)),P=G=>S(x(G,f,C,M)),j,D,Z;m.ori==0?(j=or,Z=Jn,
D=ea):(j=rr,Z=Zn,D=ta);let $=m.dir*(m.ori==0?1:-1),R=L(c[$==1?s:i]),V=R,A=[],q=[];for(let G=$==1?s:i;G>=s&&G<=i;G+=$)if(p[G]!=null){let me=c[G],re=L(me);A.push(
V=re),q.push(P(p[G]))}let U={stroke:t(A,q,j,Z,D,S),fill:null,clip:null,band:null,gaps:null,flags:qn},K=U.stroke,[H,ne]=ks(o,r);if(a.fill!=null||H!=0){let G=U.fill=
new Path2D(K),Ke=a.fillTo(o,r,a.min,a.max,H),me=P(Ke);Z(G,V,me),Z(G,R,me)}if(!a.spanGaps){let G=[];G.push(...Ss(c,p,s,i,$,L,n)),U.gaps=G=a.gaps(o,r,s,i,G),U.clip=
nr(G,m.ori,b,M,T,C)}return ne!=0&&(U.band=ne==2?[$t(o,r,s,i,K,-1),$t(o,r,s,i,K,1)]:$t(o,r,s,i,K,ne)),U})}function Cp(t){return Ap(_p,t)}function _p(t,e,n,o,r,s){
let i=t.length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let c=Array(i),p=Array(i-1),m=Array(i-1),f=Array(i-1);for(let g=0;g<
i-1;g++)m[g]=e[g+1]-e[g],f[g]=t[g+1]-t[g],p[g]=m[g]/f[g];c[0]=p[0];for(let g=1;g<i-1;g++)p[g]===0||p[g-1]===0||p[g-1]>0!=p[g]>0?c[g]=0:(c[g]=3*(f[g-1]+f[g])/((2*
f[g]+f[g-1])/p[g-1]+(f[g]+2*f[g-1])/p[g]),isFinite(c[g])||(c[g]=0));c[i-1]=p[i-2];for(let g=0;g<i-1;g++)r(a,t[g]+f[g]/3,e[g]+c[g]*f[g]/3,t[g+1]-f[g]/3,e[g+1]-c[g+
1]*f[g]/3,t[g+1],e[g+1])}return a}var cs=new Set;function wl(){for(let t of cs)t.syncRect(!0)}Yn&&(dn(uu,Gn,wl),dn(pu,Gn,wl,!0),dn(Yo,Gn,()=>{Oe.pxRatio=pe}));var Lp=ra(),
Dp=na();function xl(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((s,i)=>us(s,i,e,n))}function Rp(t,e){return t.map((n,o)=>o==
0?{}:Le({},e,n))}function us(t,e,n,o){return Le({},e==0?n:o,t)}function sa(t,e,n){return e==null?jn:[e,n]}var Np=sa;function Fp(t,e,n){return e==null?jn:Jo(e,n,
ms,!0)}function ia(t,e,n,o){return e==null?jn:Xo(e,n,t.scales[o].log,!1)}var Op=ia;function la(t,e,n,o){return e==null?jn:hs(e,n,t.scales[o].log,!1)}var Ip=la;function Up(t,e,n,o,r){
let s=Xe(Qi(t),Qi(e)),i=e-t,a=Et(r/o*i,n);do{let c=n[a],p=o*c/i;if(p>=r&&s+(c<5?Jt.get(c):0)<=17)return[c,p]}while(++a<n.length);return[0,0]}function vl(t){let e,
n;return t=t.replace(/(\d+)px/,(o,r)=>(e=Ne((n=+r)*pe))+"px"),[t,e,n]}function zp(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=be(e[2]*pe,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Oe(t,e,n){let o={mode:ae(t.mode,1)},r=o.mode;function s(l,u,d,h){let y=u.valToPct(l);return h+d*(u.dir==-1?1-y:y)}function i(l,u,d,h){
let y=u.valToPct(l);return h+d*(u.dir==-1?y:1-y)}function a(l,u,d,h){return u.ori==0?s(l,u,d,h):i(l,u,d,h)}o.valToPosH=s,o.valToPosV=i;let c=!1;o.status=0;let p=o.
root=wt(jc);if(t.id!=null&&(p.id=t.id),at(p,t.class),t.title){let l=wt(Yc,p);l.textContent=t.title}let m=Pt("canvas"),f=o.ctx=m.getContext("2d"),g=wt(Jc,p);dn("\
click",g,l=>{l.target===b&&(xe!=An||Te!=Cn)&&Be.click(o,l)},!0);let x=o.under=wt(Zc,g);g.appendChild(m);let b=o.over=wt(Qc,g);t=Kn(t);let M=+ae(t.pxAlign,1),T=yl(
M);(t.plugins||[]).forEach(l=>{l.opts&&(t=l.opts(o,t)||t)});let C=t.ms||.001,S=o.series=r==1?xl(t.series||[],ul,ml,!1):Rp(t.series||[null],hl),L=o.axes=xl(t.axes||
[],cl,dl,!0),P=o.scales={},j=o.bands=t.bands||[];j.forEach(l=>{l.fill=se(l.fill||null),l.dir=ae(l.dir,-1)});let D=r==2?S[1].facets[0].scale:S[0].scale,Z={axes:cc,
series:rc},$=(t.drawOrder||["axes","series"]).map(l=>Z[l]);function R(l){let u=l.distr==3?d=>Ht(d>0?d:l.clamp(o,d,l.min,l.max,l.key)):l.distr==4?d=>Zr(d,l.asinh):
l.distr==100?d=>l.fwd(d):d=>d;return d=>{let h=u(d),{_min:y,_max:w}=l,v=w-y;return(h-y)/v}}function V(l){let u=P[l];if(u==null){let d=(t.scales||wo)[l]||wo;if(d.
from!=null){V(d.from);let h=Le({},P[d.from],d,{key:l});h.valToPct=R(h),P[l]=h}else{u=P[l]=Le({},l==D?Yl:vp,d),u.key=l;let h=u.time,y=u.range,w=Yt(y);if((l!=D||r==
2&&!h)&&(w&&(y[0]==null||y[1]==null)&&(y={min:y[0]==null?Yi:{mode:1,hard:y[0],soft:y[0]},max:y[1]==null?Yi:{mode:1,hard:y[1],soft:y[1]}},w=!1),!w&&tr(y))){let v=y;
y=(E,_,N)=>_==null?jn:Jo(_,N,v)}u.range=se(y||(h?Np:l==D?u.distr==3?Op:u.distr==4?Ip:sa:u.distr==3?ia:u.distr==4?la:Fp)),u.auto=se(w?!1:u.auto),u.clamp=se(u.clamp||
xp),u._min=u._max=null,u.valToPct=R(u)}}}V("x"),V("y"),r==1&&S.forEach(l=>{V(l.scale)}),L.forEach(l=>{V(l.scale)});for(let l in t.scales)V(l);let A=P[D],q=A.distr,
U,K;A.ori==0?(at(p,Kc),U=s,K=i):(at(p,qc),U=i,K=s);let H={};for(let l in P){let u=P[l];(u.min!=null||u.max!=null)&&(H[l]={min:u.min,max:u.max},u.min=u.max=null)}
let ne=t.tzDate||(l=>new Date(Ne(l/C))),G=t.fmtDate||bs,Ke=C==1?Ku(ne):Ju(ne),me=il(ne,sl(C==1?ju:Yu,G)),re=al(ne,ll(Qu,G)),ce=[],X=o.legend=Le({},tp,t.legend),
W=o.cursor=Le({},lp,{drag:{y:r==2}},t.cursor),Pe=X.show,Ie=W.show,ge=X.markers;X.idxs=ce,ge.width=se(ge.width),ge.dash=se(ge.dash),ge.stroke=se(ge.stroke),ge.fill=
se(ge.fill);let ie,pt,et,Me=[],ot=[],Y,te=!1,De={};if(X.live){let l=S[1]?S[1].values:null;te=l!=null,Y=te?l(o,1,0):{_:0};for(let u in Y)De[u]=ds}if(Pe)if(ie=Pt(
"table",ru,p),et=Pt("tbody",null,ie),X.mount(o,ie),te){pt=Pt("thead",null,ie,et);let l=Pt("tr",null,pt);Pt("th",null,l);for(var Ut in Y)Pt("th",Oi,l).textContent=
Ut}else at(ie,iu),X.live&&at(ie,su);let mn={show:!0},Xn={show:!1};function vo(l,u){if(u==0&&(te||!X.live||r==2))return jn;let d=[],h=Pt("tr",lu,et,et.childNodes[u]);
at(h,l.class),l.show||at(h,pn);let y=Pt("th",null,h);if(ge.show){let E=wt(au,y);if(u>0){let _=ge.width(o,u);_&&(E.style.border=_+"px "+ge.dash(o,u)+" "+ge.stroke(
o,u)),E.style.background=ge.fill(o,u)}}let w=wt(Oi,y);l.label instanceof HTMLElement?w.appendChild(l.label):w.textContent=l.label,u>0&&(ge.show||(w.style.color=
l.width>0?ge.stroke(o,u):ge.fill(o,u)),Ye("click",y,E=>{if(W._lock)return;on(E);let _=S.indexOf(l);if((E.ctrlKey||E.metaKey)!=X.isolate){let N=S.some((F,I)=>I>0&&
I!=_&&F.show);S.forEach((F,I)=>{I>0&&Lt(I,N?I==_?mn:Xn:mn,!0,Ce.setSeries)})}else Lt(_,{show:!l.show},!0,Ce.setSeries)},!1),wn&&Ye(Vi,y,E=>{W._lock||(on(E),Lt(S.
indexOf(l),Ln,!0,Ce.setSeries))},!1));for(var v in Y){let E=Pt("td",cu,h);E.textContent="--",d.push(E)}return[h,d]}let Qt=new Map;function Ye(l,u,d,h=!0){let y=Qt.
get(u)||{},w=W.bind[l](o,u,d,h);w&&(dn(l,u,y[l]=w),Qt.set(u,y))}function gn(l,u,d){let h=Qt.get(u)||{};for(let y in h)(l==null||y==l)&&(rs(y,u,h[y]),delete h[y]);
l==null&&Qt.delete(u)}let zt=0,Xt=0,ee=0,O=0,we=0,Re=0,yn=we,en=Re,Ct=ee,tn=O,rt=0,dt=0,tt=0,vt=0;o.bbox={};let br=!1,ko=!1,bn=!1,nn=!1,So=!1,ft=!1;function wr(l,u,d){
(d||l!=o.width||u!=o.height)&&Rs(l,u),Mn(!1),bn=!0,ko=!0,Tn()}function Rs(l,u){o.width=zt=ee=l,o.height=Xt=O=u,we=Re=0,Za(),Qa();let d=o.bbox;rt=d.left=cn(we*pe,
.5),dt=d.top=cn(Re*pe,.5),tt=d.width=cn(ee*pe,.5),vt=d.height=cn(O*pe,.5)}let qa=3;function Ya(){let l=!1,u=0;for(;!l;){u++;let d=lc(u),h=ac(u);l=u==qa||d&&h,l||
(Rs(o.width,o.height),ko=!0)}}function Ja({width:l,height:u}){wr(l,u)}o.setSize=Ja;function Za(){let l=!1,u=!1,d=!1,h=!1;L.forEach((y,w)=>{if(y.show&&y._show){let{
side:v,_size:E}=y,_=v%2,N=y.label!=null?y.labelSize:0,F=E+N;F>0&&(_?(ee-=F,v==3?(we+=F,h=!0):d=!0):(O-=F,v==0?(Re+=F,l=!0):u=!0))}}),rn[0]=l,rn[1]=d,rn[2]=u,rn[3]=
h,ee-=Gt[1]+Gt[3],we+=Gt[3],O-=Gt[2]+Gt[0],Re+=Gt[0]}function Qa(){let l=we+ee,u=Re+O,d=we,h=Re;function y(w,v){switch(w){case 1:return l+=v,l-v;case 2:return u+=
v,u-v;case 3:return d-=v,d+v;case 0:return h-=v,h+v}}L.forEach((w,v)=>{if(w.show&&w._show){let E=w.side;w._pos=y(E,w._size),w.label!=null&&(w._lpos=y(E,w.labelSize))}})}
if(W.dataIdx==null){let l=W.hover,u=l.skip=new Set(l.skip??[]);u.add(void 0);let d=l.prox=se(l.prox),h=l.bias??=0;W.dataIdx=(y,w,v,E)=>{if(w==0)return v;let _=v,
N=d(y,w,v,E)??ye,F=N>=0&&N<ye,I=A.ori==0?ee:O,Q=W.left,ue=e[0],le=e[w];if(u.has(le[v])){_=null;let oe=null,J=null,B;if(h==0||h==-1)for(B=v;oe==null&&B-- >0;)u.has(
le[B])||(oe=B);if(h==0||h==1)for(B=v;J==null&&B++<le.length;)u.has(le[B])||(J=B);if(oe!=null||J!=null)if(F){let ke=oe==null?-1/0:U(ue[oe],A,I,0),Ee=J==null?1/0:
U(ue[J],A,I,0),$e=Q-ke,he=Ee-Q;$e<=he?$e<=N&&(_=oe):he<=N&&(_=J)}else _=J==null?oe:oe==null?J:v-oe<=J-v?oe:J}else F&&Fe(Q-U(ue[v],A,I,0))>N&&(_=null);return _}}
let on=l=>{W.event=l};W.idxs=ce,W._lock=!1;let qe=W.points;qe.show=se(qe.show),qe.size=se(qe.size),qe.stroke=se(qe.stroke),qe.width=se(qe.width),qe.fill=se(qe.fill);
let _t=o.focus=Le({},t.focus||{alpha:.3},W.focus),wn=_t.prox>=0,xn=wn&&qe.one,ht=[],vn=[],kn=[];function Ns(l,u){let d=qe.show(o,u);if(d instanceof HTMLElement)
return at(d,ou),at(d,l.class),It(d,-10,-10,ee,O),b.insertBefore(d,ht[u]),d}function Fs(l,u){if(r==1||u>0){let d=r==1&&P[l.scale].time,h=l.value;l.value=d?tl(h)?
al(ne,ll(h,G)):h||re:h||yp,l.label=l.label||(d?cp:ap)}if(xn||u>0){l.width=l.width==null?1:l.width,l.paths=l.paths||Lp||vu,l.fillTo=se(l.fillTo||kp),l.pxAlign=+ae(
l.pxAlign,M),l.pxRound=yl(l.pxAlign),l.stroke=se(l.stroke||null),l.fill=se(l.fill||null),l._stroke=l._fill=l._paths=l._focus=null;let d=bp(Xe(1,l.width),1),h=l.
points=Le({},{size:d,width:Xe(1,d*.2),stroke:l.stroke,space:d*2,paths:Dp,_stroke:null,_fill:null},l.points);h.show=se(h.show),h.filter=se(h.filter),h.fill=se(h.
fill),h.stroke=se(h.stroke),h.paths=se(h.paths),h.pxAlign=l.pxAlign}if(Pe){let d=vo(l,u);Me.splice(u,0,d[0]),ot.splice(u,0,d[1]),X.values.push(null)}if(Ie){ce.splice(
u,0,null);let d=null;xn?u==0&&(d=Ns(l,u)):u>0&&(d=Ns(l,u)),ht.splice(u,0,d),vn.splice(u,0,0),kn.splice(u,0,0)}He("addSeries",u)}function Xa(l,u){u=u??S.length,l=
r==1?us(l,u,ul,ml):us(l,u,{},hl),S.splice(u,0,l),Fs(S[u],u)}o.addSeries=Xa;function ec(l){if(S.splice(l,1),Pe){X.values.splice(l,1),ot.splice(l,1);let u=Me.splice(
l,1)[0];gn(null,u.firstChild),u.remove()}Ie&&(ce.splice(l,1),ht.splice(l,1)[0].remove(),vn.splice(l,1),kn.splice(l,1)),He("delSeries",l)}o.delSeries=ec;let rn=[
!1,!1,!1,!1];function tc(l,u){if(l._show=l.show,l.show){let d=l.side%2,h=P[l.scale];h==null&&(l.scale=d?S[1].scale:D,h=P[l.scale]);let y=h.time;l.size=se(l.size),
l.space=se(l.space),l.rotate=se(l.rotate),Yt(l.incrs)&&l.incrs.forEach(v=>{!Jt.has(v)&&Jt.set(v,_l(v))}),l.incrs=se(l.incrs||(h.distr==2?$u:y?C==1?Bu:qu:un)),l.
splits=se(l.splits||(y&&h.distr==1?Ke:h.distr==3?is:h.distr==4?dp:pp)),l.stroke=se(l.stroke),l.grid.stroke=se(l.grid.stroke),l.ticks.stroke=se(l.ticks.stroke),l.
border.stroke=se(l.border.stroke);let w=l.values;l.values=Yt(w)&&!Yt(w[0])?se(w):y?Yt(w)?il(ne,sl(w,G)):tl(w)?Zu(ne,w):w||me:w||up,l.filter=se(l.filter||(h.distr>=
3&&h.log==10?mp:h.distr==3&&h.log==2?gp:Al)),l.font=vl(l.font),l.labelFont=vl(l.labelFont),l._size=l.size(o,null,u,0),l._space=l._rotate=l._incrs=l._found=l._splits=
l._values=null,l._size>0&&(rn[u]=!0,l._el=wt(Xc,g))}}function eo(l,u,d,h){let[y,w,v,E]=d,_=u%2,N=0;return _==0&&(E||w)&&(N=u==0&&!y||u==2&&!v?Ne(cl.size/3):0),_==
1&&(y||v)&&(N=u==1&&!w||u==3&&!E?Ne(dl.size/2):0),N}let Os=o.padding=(t.padding||[eo,eo,eo,eo]).map(l=>se(ae(l,eo))),Gt=o._padding=Os.map((l,u)=>l(o,u,rn,0)),Ge,
Ue=null,ze=null,Mo=r==1?S[0].idxs:null,kt=null,to=!1;function Is(l,u){if(e=l??[],o.data=o._data=e,r==2){Ge=0;for(let d=1;d<S.length;d++)Ge+=e[d][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),kt=e[0],Ge=kt.length;let d=e;if(q==2){d=e.slice();let h=d[0]=Array(Ge);for(let y=0;y<Ge;y++)h[y]=y}o._data=e=d}if(Mn(!0),He(
"setData"),q==2&&(bn=!0),u!==!1){let d=A;d.auto(o,to)?xr():jt(D,d.min,d.max),nn=nn||W.left>=0,ft=!0,Tn()}}o.setData=Is;function xr(){to=!0;let l,u;r==1&&(Ge>0?(Ue=
Mo[0]=0,ze=Mo[1]=Ge-1,l=e[0][Ue],u=e[0][ze],q==2?(l=Ue,u=ze):l==u&&(q==3?[l,u]=Xo(l,l,A.log,!1):q==4?[l,u]=hs(l,l,A.log,!1):A.time?u=l+Ne(86400/C):[l,u]=Jo(l,u,
ms,!0))):(Ue=Mo[0]=l=null,ze=Mo[1]=u=null)),jt(D,l,u)}let To,Sn,vr,kr,Sr,Mr,Tr,Pr,Er,nt;function Us(l,u,d,h,y,w){l??=Ui,d??=ys,h??="butt",y??=Ui,w??="round",l!=
To&&(f.strokeStyle=To=l),y!=Sn&&(f.fillStyle=Sn=y),u!=vr&&(f.lineWidth=vr=u),w!=Sr&&(f.lineJoin=Sr=w),h!=Mr&&(f.lineCap=Mr=h),d!=kr&&f.setLineDash(kr=d)}function zs(l,u,d,h){
u!=Sn&&(f.fillStyle=Sn=u),l!=Tr&&(f.font=Tr=l),d!=Pr&&(f.textAlign=Pr=d),h!=Er&&(f.textBaseline=Er=h)}function Ar(l,u,d,h,y=0){if(h.length>0&&l.auto(o,to)&&(u==
null||u.min==null)){let w=ae(Ue,0),v=ae(ze,h.length-1),E=d.min==null?mu(h,w,v,y,l.distr==3):[d.min,d.max];l.min=At(l.min,d.min=E[0]),l.max=Xe(l.max,d.max=E[1])}}
let Vs={min:null,max:null};function nc(){for(let h in P){let y=P[h];H[h]==null&&(y.min==null||H[D]!=null&&y.auto(o,to))&&(H[h]=Vs)}for(let h in P){let y=P[h];H[h]==
null&&y.from!=null&&H[y.from]!=null&&(H[h]=Vs)}H[D]!=null&&Mn(!0);let l={};for(let h in H){let y=H[h];if(y!=null){let w=l[h]=Kn(P[h],Mu);if(y.min!=null)Le(w,y);else if(h!=
D||r==2)if(Ge==0&&w.from==null){let v=w.range(o,null,null,h);w.min=v[0],w.max=v[1]}else w.min=ye,w.max=-ye}}if(Ge>0){S.forEach((h,y)=>{if(r==1){let w=h.scale,v=H[w];
if(v==null)return;let E=l[w];if(y==0){let _=E.range(o,E.min,E.max,w);E.min=_[0],E.max=_[1],Ue=Et(E.min,e[0]),ze=Et(E.max,e[0]),ze-Ue>1&&(e[0][Ue]<E.min&&Ue++,e[0][ze]>
E.max&&ze--),h.min=kt[Ue],h.max=kt[ze]}else h.show&&h.auto&&Ar(E,v,h,e[y],h.sorted);h.idxs[0]=Ue,h.idxs[1]=ze}else if(y>0&&h.show&&h.auto){let[w,v]=h.facets,E=w.
scale,_=v.scale,[N,F]=e[y],I=l[E],Q=l[_];I!=null&&Ar(I,H[E],w,N,w.sorted),Q!=null&&Ar(Q,H[_],v,F,v.sorted),h.min=v.min,h.max=v.max}});for(let h in l){let y=l[h],
w=H[h];if(y.from==null&&(w==null||w.min==null)){let v=y.range(o,y.min==ye?null:y.min,y.max==-ye?null:y.max,h);y.min=v[0],y.max=v[1]}}}for(let h in l){let y=l[h];
if(y.from!=null){let w=l[y.from];if(w.min==null)y.min=y.max=null;else{let v=y.range(o,w.min,w.max,h);y.min=v[0],y.max=v[1]}}}let u={},d=!1;for(let h in l){let y=l[h],
w=P[h];if(w.min!=y.min||w.max!=y.max){w.min=y.min,w.max=y.max;let v=w.distr;w._min=v==3?Ht(w.min):v==4?Zr(w.min,w.asinh):v==100?w.fwd(w.min):w.min,w._max=v==3?Ht(
w.max):v==4?Zr(w.max,w.asinh):v==100?w.fwd(w.max):w.max,u[h]=d=!0}}if(d){S.forEach((h,y)=>{r==2?y>0&&u.y&&(h._paths=null):u[h.scale]&&(h._paths=null)});for(let h in u)
bn=!0,He("setScale",h);Ie&&W.left>=0&&(nn=ft=!0)}for(let h in H)H[h]=null}function oc(l){let u=ss(Ue-1,0,Ge-1),d=ss(ze+1,0,Ge-1);for(;l[u]==null&&u>0;)u--;for(;l[d]==
null&&d<Ge-1;)d++;return[u,d]}function rc(){if(Ge>0){let l=S.some(u=>u._focus)&&nt!=_t.alpha;l&&(f.globalAlpha=nt=_t.alpha),S.forEach((u,d)=>{if(d>0&&u.show&&(Ws(
d,!1),Ws(d,!0),u._paths==null)){let h=nt;nt!=u.alpha&&(f.globalAlpha=nt=u.alpha);let y=r==2?[0,e[d][0].length-1]:oc(e[d]);u._paths=u.paths(o,d,y[0],y[1]),nt!=h&&
(f.globalAlpha=nt=h)}}),S.forEach((u,d)=>{if(d>0&&u.show){let h=nt;nt!=u.alpha&&(f.globalAlpha=nt=u.alpha),u._paths!=null&&Hs(d,!1);{let y=u._paths!=null?u._paths.
gaps:null,w=u.points.show(o,d,Ue,ze,y),v=u.points.filter(o,d,w,y);(w||v)&&(u.points._paths=u.points.paths(o,d,Ue,ze,v),Hs(d,!0))}nt!=h&&(f.globalAlpha=nt=h),He(
"drawSeries",d)}}),l&&(f.globalAlpha=nt=1)}}function Ws(l,u){let d=u?S[l].points:S[l];d._stroke=d.stroke(o,l),d._fill=d.fill(o,l)}function Hs(l,u){let d=u?S[l].
points:S[l],{stroke:h,fill:y,clip:w,flags:v,_stroke:E=d._stroke,_fill:_=d._fill,_width:N=d.width}=d._paths;N=be(N*pe,3);let F=null,I=N%2/2;u&&_==null&&(_=N>0?"#\
fff":E);let Q=d.pxAlign==1&&I>0;if(Q&&f.translate(I,I),!u){let ue=rt-N/2,le=dt-N/2,oe=tt+N,J=vt+N;F=new Path2D,F.rect(ue,le,oe,J)}u?Cr(E,N,d.dash,d.cap,_,h,y,v,
w):sc(l,E,N,d.dash,d.cap,_,h,y,v,F,w),Q&&f.translate(-I,-I)}function sc(l,u,d,h,y,w,v,E,_,N,F){let I=!1;_!=0&&j.forEach((Q,ue)=>{if(Q.series[0]==l){let le=S[Q.series[1]],
oe=e[Q.series[1]],J=(le._paths||wo).band;Yt(J)&&(J=Q.dir==1?J[0]:J[1]);let B,ke=null;le.show&&J&&yu(oe,Ue,ze)?(ke=Q.fill(o,ue)||w,B=le._paths.clip):J=null,Cr(u,
d,h,y,ke,v,E,_,N,F,B,J),I=!0}}),I||Cr(u,d,h,y,w,v,E,_,N,F)}let $s=qn|as;function Cr(l,u,d,h,y,w,v,E,_,N,F,I){Us(l,u,d,h,y),(_||N||I)&&(f.save(),_&&f.clip(_),N&&
f.clip(N)),I?(E&$s)==$s?(f.clip(I),F&&f.clip(F),Eo(y,v),Po(l,w,u)):E&as?(Eo(y,v),f.clip(I),Po(l,w,u)):E&qn&&(f.save(),f.clip(I),F&&f.clip(F),Eo(y,v),f.restore(),
Po(l,w,u)):(Eo(y,v),Po(l,w,u)),(_||N||I)&&f.restore()}function Po(l,u,d){d>0&&(u instanceof Map?u.forEach((h,y)=>{f.strokeStyle=To=y,f.stroke(h)}):u!=null&&l&&f.
stroke(u))}function Eo(l,u){u instanceof Map?u.forEach((d,h)=>{f.fillStyle=Sn=h,f.fill(d)}):u!=null&&l&&f.fill(u)}function ic(l,u,d,h){let y=L[l],w;if(h<=0)w=[0,
0];else{let v=y._space=y.space(o,l,u,d,h),E=y._incrs=y.incrs(o,l,u,d,h,v);w=Up(u,d,E,h,v)}return y._found=w}function _r(l,u,d,h,y,w,v,E,_,N){let F=v%2/2;M==1&&f.
translate(F,F),Us(E,v,_,N,E),f.beginPath();let I,Q,ue,le,oe=y+(h==0||h==3?-w:w);d==0?(Q=y,le=oe):(I=y,ue=oe);for(let J=0;J<l.length;J++)u[J]!=null&&(d==0?I=ue=l[J]:
Q=le=l[J],f.moveTo(I,Q),f.lineTo(ue,le));f.stroke(),M==1&&f.translate(-F,-F)}function lc(l){let u=!0;return L.forEach((d,h)=>{if(!d.show)return;let y=P[d.scale];
if(y.min==null){d._show&&(u=!1,d._show=!1,Mn(!1));return}else d._show||(u=!1,d._show=!0,Mn(!1));let w=d.side,v=w%2,{min:E,max:_}=y,[N,F]=ic(h,E,_,v==0?ee:O);if(F==
0)return;let I=y.distr==2,Q=d._splits=d.splits(o,h,E,_,N,F,I),ue=y.distr==2?Q.map(B=>kt[B]):Q,le=y.distr==2?kt[Q[1]]-kt[Q[0]]:N,oe=d._values=d.values(o,d.filter(
o,ue,h,F,le),h,F,le);d._rotate=w==2?d.rotate(o,oe,h,F):0;let J=d._size;d._size=xt(d.size(o,oe,h,l)),J!=null&&d._size!=J&&(u=!1)}),u}function ac(l){let u=!0;return Os.
forEach((d,h)=>{let y=d(o,h,rn,l);y!=Gt[h]&&(u=!1),Gt[h]=y}),u}function cc(){for(let l=0;l<L.length;l++){let u=L[l];if(!u.show||!u._show)continue;let d=u.side,h=d%
2,y,w,v=u.stroke(o,l),E=d==0||d==3?-1:1,[_,N]=u._found;if(u.label!=null){let Ze=u.labelGap*E,lt=Ne((u._lpos+Ze)*pe);zs(u.labelFont[0],v,"center",d==2?"top":Ii),
f.save(),h==1?(y=w=0,f.translate(lt,Ne(dt+vt/2)),f.rotate((d==3?-qo:qo)/2)):(y=Ne(rt+tt/2),w=lt);let an=Pl(u.label)?u.label(o,l,_,N):u.label;f.fillText(an,y,w),
f.restore()}if(N==0)continue;let F=P[u.scale],I=h==0?tt:vt,Q=h==0?rt:dt,ue=u._splits,le=F.distr==2?ue.map(Ze=>kt[Ze]):ue,oe=F.distr==2?kt[ue[1]]-kt[ue[0]]:_,J=u.
ticks,B=u.border,ke=J.show?J.size:0,Ee=Ne(ke*pe),$e=Ne((u.alignTo==2?u._size-ke-u.gap:u.gap)*pe),he=u._rotate*-qo/180,Ae=T(u._pos*pe),st=(Ee+$e)*E,Je=Ae+st;w=h==
0?Je:0,y=h==1?Je:0;let mt=u.font[0],St=u.align==1?Hn:u.align==2?qr:he>0?Hn:he<0?qr:h==0?"center":d==3?qr:Hn,Rt=he||h==1?"middle":d==2?"top":Ii;zs(mt,v,St,Rt);let it=u.
font[1]*u.lineGap,gt=ue.map(Ze=>T(a(Ze,F,I,Q))),Mt=u._values;for(let Ze=0;Ze<Mt.length;Ze++){let lt=Mt[Ze];if(lt!=null){h==0?y=gt[Ze]:w=gt[Ze],lt=""+lt;let an=lt.
indexOf(`
`)==-1?[lt]:lt.split(/\n/gm);for(let Qe=0;Qe<an.length;Qe++){let ai=an[Qe];he?(f.save(),f.translate(y,w+Qe*it),f.rotate(he),f.fillText(ai,0,0),f.restore()):f.fillText(
ai,y,w+Qe*it)}}}J.show&&_r(gt,J.filter(o,le,l,N,oe),h,d,Ae,Ee,be(J.width*pe,3),J.stroke(o,l),J.dash,J.cap);let Nt=u.grid;Nt.show&&_r(gt,Nt.filter(o,le,l,N,oe),h,
h==0?2:1,h==0?dt:rt,h==0?vt:tt,be(Nt.width*pe,3),Nt.stroke(o,l),Nt.dash,Nt.cap),B.show&&_r([Ae],[1],h==0?1:0,h==0?1:2,h==1?dt:rt,h==1?vt:tt,be(B.width*pe,3),B.stroke(
o,l),B.dash,B.cap)}He("drawAxes")}function Mn(l){S.forEach((u,d)=>{d>0&&(u._paths=null,l&&(r==1?(u.min=null,u.max=null):u.facets.forEach(h=>{h.min=null,h.max=null})))})}
let Ao=!1,Lr=!1,no=[];function uc(){Lr=!1;for(let l=0;l<no.length;l++)He(...no[l]);no.length=0}function Tn(){Ao||(Lu(Gs),Ao=!0)}function pc(l,u=!1){Ao=!0,Lr=u,l(
o),Gs(),u&&no.length>0&&queueMicrotask(uc)}o.batch=pc;function Gs(){if(br&&(nc(),br=!1),bn&&(Ya(),bn=!1),ko){if(Se(x,Hn,we),Se(x,"top",Re),Se(x,mo,ee),Se(x,go,O),
Se(b,Hn,we),Se(b,"top",Re),Se(b,mo,ee),Se(b,go,O),Se(g,mo,zt),Se(g,go,Xt),m.width=Ne(zt*pe),m.height=Ne(Xt*pe),L.forEach(({_el:l,_show:u,_size:d,_pos:h,side:y})=>{
if(l!=null)if(u){let w=y===3||y===0?d:0,v=y%2==1;Se(l,v?"left":"top",h-w),Se(l,v?"width":"height",d),Se(l,v?"top":"left",v?Re:we),Se(l,v?"height":"width",v?O:ee),
os(l,pn)}else at(l,pn)}),To=Sn=vr=Sr=Mr=Tr=Pr=Er=kr=null,nt=1,so(!0),we!=yn||Re!=en||ee!=Ct||O!=tn){Mn(!1);let l=ee/Ct,u=O/tn;if(Ie&&!nn&&W.left>=0){W.left*=l,W.
top*=u,Pn&&It(Pn,Ne(W.left),0,ee,O),En&&It(En,0,Ne(W.top),ee,O);for(let d=0;d<ht.length;d++){let h=ht[d];h!=null&&(vn[d]*=l,kn[d]*=u,It(h,xt(vn[d]),xt(kn[d]),ee,
O))}}if(ve.show&&!So&&ve.left>=0&&ve.width>0){ve.left*=l,ve.width*=l,ve.top*=u,ve.height*=u;for(let d in Ir)Se(_n,d,ve[d])}yn=we,en=Re,Ct=ee,tn=O}He("setSize"),
ko=!1}zt>0&&Xt>0&&(f.clearRect(0,0,m.width,m.height),He("drawClear"),$.forEach(l=>l()),He("draw")),ve.show&&So&&(Co(ve),So=!1),Ie&&nn&&(ln(null,!0,!1),nn=!1),X.
show&&X.live&&ft&&(Fr(),ft=!1),c||(c=!0,o.status=1,He("ready")),to=!1,Ao=!1}o.redraw=(l,u)=>{bn=u||!1,l!==!1?jt(D,A.min,A.max):Tn()};function Dr(l,u){let d=P[l];
if(d.from==null){if(Ge==0){let h=d.range(o,u.min,u.max,l);u.min=h[0],u.max=h[1]}if(u.min>u.max){let h=u.min;u.min=u.max,u.max=h}if(Ge>1&&u.min!=null&&u.max!=null&&
u.max-u.min<1e-16)return;l==D&&d.distr==2&&Ge>0&&(u.min=Et(u.min,e[0]),u.max=Et(u.max,e[0]),u.min==u.max&&u.max++),H[l]=u,br=!0,Tn()}}o.setScale=Dr;let Rr,Nr,Pn,
En,Bs,js,An,Cn,Ks,qs,xe,Te,Bt=!1,Be=W.drag,Ve=Be.x,We=Be.y;Ie&&(W.x&&(Rr=wt(tu,b)),W.y&&(Nr=wt(nu,b)),A.ori==0?(Pn=Rr,En=Nr):(Pn=Nr,En=Rr),xe=W.left,Te=W.top);let ve=o.
select=Le({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),_n=ve.show?wt(eu,ve.over?b:x):null;function Co(l,u){if(ve.show){for(let d in l)ve[d]=l[d],d in
Ir&&Se(_n,d,l[d]);u!==!1&&He("setSelect")}}o.setSelect=Co;function dc(l){if(S[l].show)Pe&&os(Me[l],pn);else if(Pe&&at(Me[l],pn),Ie){let d=xn?ht[0]:ht[l];d!=null&&
It(d,-10,-10,ee,O)}}function jt(l,u,d){Dr(l,{min:u,max:d})}function Lt(l,u,d,h){u.focus!=null&&yc(l),u.show!=null&&S.forEach((y,w)=>{w>0&&(l==w||l==null)&&(y.show=
u.show,dc(w),r==2?(jt(y.facets[0].scale,null,null),jt(y.facets[1].scale,null,null)):jt(y.scale,null,null),Tn())}),d!==!1&&He("setSeries",l,u),h&&io("setSeries",
o,l,u)}o.setSeries=Lt;function fc(l,u){Le(j[l],u)}function hc(l,u){l.fill=se(l.fill||null),l.dir=ae(l.dir,-1),u=u??j.length,j.splice(u,0,l)}function mc(l){l==null?
j.length=0:j.splice(l,1)}o.addBand=hc,o.setBand=fc,o.delBand=mc;function gc(l,u){S[l].alpha=u,Ie&&ht[l]!=null&&(ht[l].style.opacity=u),Pe&&Me[l]&&(Me[l].style.opacity=
u)}let Vt,Kt,sn,Ln={focus:!0};function yc(l){if(l!=sn){let u=l==null,d=_t.alpha!=1;S.forEach((h,y)=>{if(r==1||y>0){let w=u||y==0||y==l;h._focus=u?null:w,d&&gc(y,
w?1:_t.alpha)}}),sn=l,d&&Tn()}}Pe&&wn&&Ye(Wi,ie,l=>{W._lock||(on(l),sn!=null&&Lt(null,Ln,!0,Ce.setSeries))});function Dt(l,u,d){let h=P[u];d&&(l=l/pe-(h.ori==1?
Re:we));let y=ee;h.ori==1&&(y=O,l=y-l),h.dir==-1&&(l=y-l);let w=h._min,v=h._max,E=l/y,_=w+(v-w)*E,N=h.distr;return N==3?Bn(10,_):N==4?wu(_,h.asinh):N==100?h.bwd(
_):_}function bc(l,u){let d=Dt(l,D,u);return Et(d,e[0],Ue,ze)}o.valToIdx=l=>Et(l,e[0]),o.posToIdx=bc,o.posToVal=Dt,o.valToPos=(l,u,d)=>P[u].ori==0?s(l,P[u],d?tt:
ee,d?rt:0):i(l,P[u],d?vt:O,d?dt:0),o.setCursor=(l,u,d)=>{xe=l.left,Te=l.top,ln(null,u,d)};function Ys(l,u){Se(_n,Hn,ve.left=l),Se(_n,mo,ve.width=u)}function Js(l,u){
Se(_n,"top",ve.top=l),Se(_n,go,ve.height=u)}let oo=A.ori==0?Ys:Js,ro=A.ori==1?Ys:Js;function wc(){if(Pe&&X.live)for(let l=r==2?1:0;l<S.length;l++){if(l==0&&te)continue;
let u=X.values[l],d=0;for(let h in u)ot[l][d++].firstChild.nodeValue=u[h]}}function Fr(l,u){if(l!=null&&(l.idxs?l.idxs.forEach((d,h)=>{ce[h]=d}):Su(l.idx)||ce.fill(
l.idx),X.idx=ce[0]),Pe&&X.live){for(let d=0;d<S.length;d++)(d>0||r==1&&!te)&&xc(d,ce[d]);wc()}ft=!1,u!==!1&&He("setLegend")}o.setLegend=Fr;function xc(l,u){let d=S[l],
h=l==0&&q==2?kt:e[l],y;te?y=d.values(o,l,u)??De:(y=d.value(o,u==null?null:h[u],l,u),y=y==null?De:{_:y}),X.values[l]=y}function ln(l,u,d){Ks=xe,qs=Te,[xe,Te]=W.move(
o,xe,Te),W.left=xe,W.top=Te,Ie&&(Pn&&It(Pn,Ne(xe),0,ee,O),En&&It(En,0,Ne(Te),ee,O));let h,y=Ue>ze;Vt=ye,Kt=null;let w=A.ori==0?ee:O,v=A.ori==1?ee:O;if(xe<0||Ge==
0||y){h=W.idx=null;for(let E=0;E<S.length;E++){let _=ht[E];_!=null&&It(_,-10,-10,ee,O)}wn&&Lt(null,Ln,!0,l==null&&Ce.setSeries),X.live&&(ce.fill(h),ft=!0)}else{
let E,_,N;r==1&&(E=A.ori==0?xe:Te,_=Dt(E,D),h=W.idx=Et(_,e[0],Ue,ze),N=U(e[0][h],A,w,0));let F=-10,I=-10,Q=0,ue=0,le=!0,oe="",J="";for(let B=r==2?1:0;B<S.length;B++){
let ke=S[B],Ee=ce[B],$e=Ee==null?null:r==1?e[B][Ee]:e[B][1][Ee],he=W.dataIdx(o,B,h,_),Ae=he==null?null:r==1?e[B][he]:e[B][1][he];if(ft=ft||Ae!=$e||he!=Ee,ce[B]=
he,B>0&&ke.show){let st=he==null?-10:he==h?N:U(r==1?e[0][he]:e[B][0][he],A,w,0),Je=Ae==null?-10:K(Ae,r==1?P[ke.scale]:P[ke.facets[1].scale],v,0);if(wn&&Ae!=null){
let mt=A.ori==1?xe:Te,St=Fe(_t.dist(o,B,he,Je,mt));if(St<Vt){let Rt=_t.bias;if(Rt!=0){let it=Dt(mt,ke.scale),gt=Ae>=0?1:-1,Mt=it>=0?1:-1;Mt==gt&&(Mt==1?Rt==1?Ae>=
it:Ae<=it:Rt==1?Ae<=it:Ae>=it)&&(Vt=St,Kt=B)}else Vt=St,Kt=B}}if(ft||xn){let mt,St;A.ori==0?(mt=st,St=Je):(mt=Je,St=st);let Rt,it,gt,Mt,Nt,Ze,lt=!0,an=qe.bbox;if(an!=
null){lt=!1;let Qe=an(o,B);gt=Qe.left,Mt=Qe.top,Rt=Qe.width,it=Qe.height}else gt=mt,Mt=St,Rt=it=qe.size(o,B);if(Ze=qe.fill(o,B),Nt=qe.stroke(o,B),xn)B==Kt&&Vt<=
_t.prox&&(F=gt,I=Mt,Q=Rt,ue=it,le=lt,oe=Ze,J=Nt);else{let Qe=ht[B];Qe!=null&&(vn[B]=gt,kn[B]=Mt,qi(Qe,Rt,it,lt),ji(Qe,Ze,Nt),It(Qe,xt(gt),xt(Mt),ee,O))}}}}if(xn){
let B=_t.prox,ke=sn==null?Vt<=B:Vt>B||Kt!=sn;if(ft||ke){let Ee=ht[0];Ee!=null&&(vn[0]=F,kn[0]=I,qi(Ee,Q,ue,le),ji(Ee,oe,J),It(Ee,xt(F),xt(I),ee,O))}}}if(ve.show&&
Bt)if(l!=null){let[E,_]=Ce.scales,[N,F]=Ce.match,[I,Q]=l.cursor.sync.scales,ue=l.cursor.drag;if(Ve=ue._x,We=ue._y,Ve||We){let{left:le,top:oe,width:J,height:B}=l.
select,ke=l.scales[I].ori,Ee=l.posToVal,$e,he,Ae,st,Je,mt=E!=null&&N(E,I),St=_!=null&&F(_,Q);mt&&Ve?(ke==0?($e=le,he=J):($e=oe,he=B),Ae=P[E],st=U(Ee($e,I),Ae,w,
0),Je=U(Ee($e+he,I),Ae,w,0),oo(At(st,Je),Fe(Je-st))):oo(0,w),St&&We?(ke==1?($e=le,he=J):($e=oe,he=B),Ae=P[_],st=K(Ee($e,Q),Ae,v,0),Je=K(Ee($e+he,Q),Ae,v,0),ro(At(
st,Je),Fe(Je-st))):ro(0,v)}else Ur()}else{let E=Fe(Ks-Bs),_=Fe(qs-js);if(A.ori==1){let Q=E;E=_,_=Q}Ve=Be.x&&E>=Be.dist,We=Be.y&&_>=Be.dist;let N=Be.uni;N!=null?
Ve&&We&&(Ve=E>=N,We=_>=N,!Ve&&!We&&(_>E?We=!0:Ve=!0)):Be.x&&Be.y&&(Ve||We)&&(Ve=We=!0);let F,I;Ve&&(A.ori==0?(F=An,I=xe):(F=Cn,I=Te),oo(At(F,I),Fe(I-F)),We||ro(
0,v)),We&&(A.ori==1?(F=An,I=xe):(F=Cn,I=Te),ro(At(F,I),Fe(I-F)),Ve||oo(0,w)),!Ve&&!We&&(oo(0,0),ro(0,0))}if(Be._x=Ve,Be._y=We,l==null){if(d){if(li!=null){let[E,
_]=Ce.scales;Ce.values[0]=E!=null?Dt(A.ori==0?xe:Te,E):null,Ce.values[1]=_!=null?Dt(A.ori==1?xe:Te,_):null}io(Yr,o,xe,Te,ee,O,h)}if(wn){let E=d&&Ce.setSeries,_=_t.
prox;sn==null?Vt<=_&&Lt(Kt,Ln,!0,E):Vt>_?Lt(null,Ln,!0,E):Kt!=sn&&Lt(Kt,Ln,!0,E)}}ft&&(X.idx=h,Fr()),u!==!1&&He("setCursor")}let qt=null;Object.defineProperty(o,
"rect",{get(){return qt==null&&so(!1),qt}});function so(l=!1){l?qt=null:(qt=b.getBoundingClientRect(),He("syncRect",qt))}function Zs(l,u,d,h,y,w,v){W._lock||Bt&&
l!=null&&l.movementX==0&&l.movementY==0||(Or(l,u,d,h,y,w,v,!1,l!=null),l!=null?ln(null,!0,!0):ln(u,!0,!1))}function Or(l,u,d,h,y,w,v,E,_){if(qt==null&&so(!1),on(
l),l!=null)d=l.clientX-qt.left,h=l.clientY-qt.top;else{if(d<0||h<0){xe=-10,Te=-10;return}let[N,F]=Ce.scales,I=u.cursor.sync,[Q,ue]=I.values,[le,oe]=I.scales,[J,
B]=Ce.match,ke=u.axes[0].side%2==1,Ee=A.ori==0?ee:O,$e=A.ori==1?ee:O,he=ke?w:y,Ae=ke?y:w,st=ke?h:d,Je=ke?d:h;if(le!=null?d=J(N,le)?a(Q,P[N],Ee,0):-10:d=Ee*(st/he),
oe!=null?h=B(F,oe)?a(ue,P[F],$e,0):-10:h=$e*(Je/Ae),A.ori==1){let mt=d;d=h,h=mt}}_&&(u==null||u.cursor.event.type==Yr)&&((d<=1||d>=ee-1)&&(d=cn(d,ee)),(h<=1||h>=
O-1)&&(h=cn(h,O))),E?(Bs=d,js=h,[An,Cn]=W.move(o,d,h)):(xe=d,Te=h)}let Ir={width:0,height:0,left:0,top:0};function Ur(){Co(Ir,!1)}let Qs,Xs,ei,ti;function ni(l,u,d,h,y,w,v){
Bt=!0,Ve=We=Be._x=Be._y=!1,Or(l,u,d,h,y,w,v,!0,!1),l!=null&&(Ye(Jr,ts,oi,!1),io(zi,o,An,Cn,ee,O,null));let{left:E,top:_,width:N,height:F}=ve;Qs=E,Xs=_,ei=N,ti=F}
function oi(l,u,d,h,y,w,v){Bt=Be._x=Be._y=!1,Or(l,u,d,h,y,w,v,!1,!0);let{left:E,top:_,width:N,height:F}=ve,I=N>0||F>0,Q=Qs!=E||Xs!=_||ei!=N||ti!=F;if(I&&Q&&Co(ve),
Be.setScale&&I&&Q){let ue=E,le=N,oe=_,J=F;if(A.ori==1&&(ue=_,le=F,oe=E,J=N),Ve&&jt(D,Dt(ue,D),Dt(ue+le,D)),We)for(let B in P){let ke=P[B];B!=D&&ke.from==null&&ke.
min!=ye&&jt(B,Dt(oe+J,B),Dt(oe,B))}Ur()}else W.lock&&(W._lock=!W._lock,ln(u,!0,l!=null));l!=null&&(gn(Jr,ts),io(Jr,o,xe,Te,ee,O,null))}function vc(l,u,d,h,y,w,v){
if(W._lock)return;on(l);let E=Bt;if(Bt){let _=!0,N=!0,F=10,I,Q;A.ori==0?(I=Ve,Q=We):(I=We,Q=Ve),I&&Q&&(_=xe<=F||xe>=ee-F,N=Te<=F||Te>=O-F),I&&_&&(xe=xe<An?0:ee),
Q&&N&&(Te=Te<Cn?0:O),ln(null,!0,!0),Bt=!1}xe=-10,Te=-10,ce.fill(null),ln(null,!0,!0),E&&(Bt=E)}function ri(l,u,d,h,y,w,v){W._lock||(on(l),xr(),Ur(),l!=null&&io(
Hi,o,xe,Te,ee,O,null))}function si(){L.forEach(zp),wr(o.width,o.height,!0)}dn(Yo,Gn,si);let Dn={};Dn.mousedown=ni,Dn.mousemove=Zs,Dn.mouseup=oi,Dn.dblclick=ri,Dn.
setSeries=(l,u,d,h)=>{let y=Ce.match[2];d=y(o,u,d),d!=-1&&Lt(d,h,!0,!1)},Ie&&(Ye(zi,b,ni),Ye(Yr,b,Zs),Ye(Vi,b,l=>{on(l),so(!1)}),Ye(Wi,b,vc),Ye(Hi,b,ri),cs.add(
o),o.syncRect=so);let _o=o.hooks=t.hooks||{};function He(l,u,d){Lr?no.push([l,u,d]):l in _o&&_o[l].forEach(h=>{h.call(null,o,u,d)})}(t.plugins||[]).forEach(l=>{
for(let u in l.hooks)_o[u]=(_o[u]||[]).concat(l.hooks[u])});let ii=(l,u,d)=>d,Ce=Le({key:null,setSeries:!1,filters:{pub:Xi,sub:Xi},scales:[D,S[1]?S[1].scale:null],
match:[el,el,ii],values:[null,null]},W.sync);Ce.match.length==2&&Ce.match.push(ii),W.sync=Ce;let li=Ce.key,zr=Jl(li);function io(l,u,d,h,y,w,v){Ce.filters.pub(l,
u,d,h,y,w,v)&&zr.pub(l,u,d,h,y,w,v)}zr.sub(o);function kc(l,u,d,h,y,w,v){Ce.filters.sub(l,u,d,h,y,w,v)&&Dn[l](null,u,d,h,y,w,v)}o.pub=kc;function Sc(){zr.unsub(
o),cs.delete(o),Qt.clear(),rs(Yo,Gn,si),p.remove(),ie?.remove(),He("destroy")}o.destroy=Sc;function Vr(){He("init",t,e),Is(e||t.data,!1),H[D]?Dr(D,H[D]):xr(),So=
ve.show&&(ve.width>0||ve.height>0),nn=ft=!0,wr(t.width,t.height)}return S.forEach(Fs),L.forEach(tc),n?n instanceof HTMLElement?(n.appendChild(p),Vr()):n(o,Vr):Vr(),
o}Oe.assign=Le;Oe.fmtNum=gs;Oe.rangeNum=Jo;Oe.rangeLog=Xo;Oe.rangeAsinh=hs;Oe.orient=hn;Oe.pxRatio=pe;Oe.join=_u;Oe.fmtDate=bs,Oe.tzDate=Wu;Oe.sync=Jl;{Oe.addGap=
Sp,Oe.clipGaps=nr;let t=Oe.paths={points:na};t.linear=ra,t.stepped=Pp,t.bars=Ep,t.spline=Cp}var ir=128,aa=50,Vp=.25,Wp=t=>[t.ray,t.truth,t.sensor,t.noReturn],lr=(t,e)=>({font:$r,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function ca(t,e,n){let o=null,r=null,s=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&s()>0&&o.setSize({width:s(),height:ir})).
observe(t),i=>s()<=0?null:((!o||i||r!==n())&&(o?.destroy(),o=e(),o.setSize({width:s(),height:ir}),r=n()),o)}function ua(t,e){let{session:n}=t,o=k("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),r="all",s=t.segmented("Trace",[["all","All sweeps"],["first",`First ${aa}`]],()=>r,b=>{r=b,p=null,n.
changed()}),i=0,a=-1/0,c=-1,p=null,f=ca(o,()=>{let b=Wp(e()),M=Array.from({length:i},(T,C)=>({label:`chain ${C+1}`,stroke:b[C%b.length],width:1,points:{show:!1}}));
return new Oe({width:100,height:ir,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(T,C,S)=>[C,Math.max(S,C+1)]},y:{
range:(T,C,S)=>Gp(Math.max(C,a),S)}},axes:[lr(e,26),lr(e,52)],series:[{label:"sweep"},...M],hooks:{draw:[T=>Bp(T,c,e())]}},[[],...M.map(()=>[])],o)},e),g=k("spa\
n",{className:"caption",textContent:"log joint by sweep"}),x=k("div",{className:"charted"},k("div",{className:"buttons"},s,g),o);return t.each(()=>{let b=n.shown,
M=b?.traced?.length?b.trace.length/b.traced.length:0;if(z(x,"hidden",M===0),!b||!M)return;let T=b.layer==="draw"&&n.draws.count?(n.draw+1)*b.sweeps/n.draws.count:
-1,C=f(M!==i&&(i=M,!0));C&&(p===b&&c===T&&C.data[0].length||([p,c]=[b,T],a=r==="all"?$p(b,M):-1/0,C.setData(Hp(b,M,r))))}),x}function Hp({trace:t,traced:e},n,o){
let r=o==="all"?e.length:e.filter(s=>s<=aa).length;return[e.slice(0,r),...Array.from({length:n},(s,i)=>t.slice(i*e.length,i*e.length+r))]}function $p({trace:t,traced:e},n){
let o=e.length,r=e.findIndex(s=>s>=Vp*e[o-1]);return Math.min(...Array.from({length:n},(s,i)=>Math.min(...t.slice(i*o+r,(i+1)*o))))}function Gp(t,e){let n=Math.
max(.06*(e-t),.5);return[t-n,e+n]}function Bp(t,e,n){if(e<0)return;let{left:o,top:r,width:s,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+s||(t.ctx.save(),t.
ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,r,2,i),t.ctx.restore())}function pa(t,e){let{session:n}=t,o=k("div",{className:"chart",role:"img","aria-label":"Histogra\
m of the particles' weights"}),r=k("div",{className:"caption",textContent:"particles by weight, nats below the heaviest"}),s=k("div",{className:"charted"},r,o),
a=ca(o,()=>new Oe({width:100,height:ir,legend:{show:!1},cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(p,m,f)=>[m,f]},y:{distr:3,range:(p,m,f)=>[
.5,Math.max(10,2*f)]}},axes:[lr(e,26),{...lr(e,52),values:(p,m)=>m.map(f=>f>=1?String(f):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Oe.paths.bars?.({size:[
.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),c=null;return t.each(()=>{let p=n.shown;z(s,"hidden",!p?.weights);let m=p?.weights&&a(!1);if(!p?.weights||!m||
c===p&&m.data[0].length)return;c=p;let f=[...p.weights],g=-(p.lowest??-1)/f.length,x=[...f.map((b,M)=>(p.lowest??-1)+M*g),0];m.setData([x,[...f.map(b=>b||null),
null]])}),s}function da(t){let{session:e,hand:n}=t,{decisions:o}=e,r=k("p",{className:"said",role:"status"}),s=k("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,p=>o.set({radius:p}),{min:.01,max:100,step:"any"}),t.numberInput("Highest risk",()=>o.risk,p=>o.set({risk:p}),{min:1e-4,max:.99,step:"any"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",s,r),c=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
s,()=>n.tool==="path"),t.each(()=>{z(c,"textContent",i()),z(r,"textContent",n.tool==="path"?jp(t):Kp(t))}),a}function jp({session:t}){let{start:e,goal:n,path:o,
trouble:r}=t.decisions;if(r)return r;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let s=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${bt(
o.length_m,2)} m, free with probability ${bt(o.probability,3)} ± ${bt(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${bt(o.independent,
3)}.${s}`}function Kp({session:t}){let{views:e,trouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.nats),
r=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${bt(Math.min(...e.nats),1)} to ${bt(o,1)} nats, cells taken for independent; \
the best place has a ring.${r}`}var qp=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Yp=["Draw walls, and drag the robot: a beam reads the first wall that it \
hits, with noise. Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (draw), and where doubt remains\
 (entropy). No beam has been where it is hatched.","While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact\
 in the long run."],Jp="Mouse: the wheel zooms, the middle button pans, Shift or the right button erases, and so does a click on a wall. Touch: two fingers zoom\
 and pan.";function fa(t){let e=ki.map(([o,r])=>k("tr",{},k("th",{scope:"row"},k("kbd",{textContent:o})),k("td",{textContent:r}))),n=Yp.map(o=>k("p",{textContent:o}));
return t.dialog("Help",...n,k("table",{},k("tbody",{},...e)),k("p",{textContent:Jp}))}function ha(t){let e=()=>k("input",{type:"number",min:_e.cells[0],max:_e.cells[1],
step:1,required:!0,value:"21"}),[n,o]=[e(),e()],r=k("select",{});for(let[i,a]of qp)r.append(k("option",{value:i,textContent:a}));r.addEventListener("change",()=>{
r.value==="building"&&Number(n.value)<60&&([n.value,o.value]=["120","80"])});let s=k("form",{method:"dialog"},t.row("World",r),t.row("Width (cells)",n),t.row("H\
eight (cells)",o),k("div",{className:"buttons end"},k("button",{type:"submit",className:"primary",textContent:"Create"})));return s.addEventListener("submit",()=>{
t.session.act({type:"new",shape:[Number(n.value),Number(o.value)],world:r.value}),t.hand.selected=null}),t.dialog("New map",s)}function ma(t){let e=k("input",{type:"\
text",readOnly:!0,"aria-label":"Link"}),n=k("span",{role:"status",className:"copied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{
document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},r=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),i=t.
dialog("Share",k("p",{textContent:"The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server r\
uns; the part from # on can be put after the address of any bayesmap page."}),k("div",{className:"buttons"},e,r),n);return{dialog:i,show(a){e.value=a,i.showModal(),
e.select()}}}function ga(t){let{session:e}=t,n=k("span",{className:"what"});t.each(()=>{let{grid:p,source:m}=e.document??{};if(!p||!m)return;let f=`${p.shape[0]} × ${p.shape[1]}\
 cells of ${+p.resolution.toPrecision(3)} m`;z(n,"textContent",m.name?`${m.name}, ${f}`:f)});let o=()=>!e.recorded&&!!e.document,r=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),k("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let p of r)t.visible(p,()=>!e.recorded);let s=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=k("span",{className:"space"});return{element:k("header",{},k("h1",{textContent:"bayesmap"}),n,a,...r,Qp(t),s,
i),nameTheme(p){let m=`Theme: ${p}`;Tt(s,"aria-label",m),z(s,"title",m)}}}var Zp=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function Qp(t){
let{session:e}=t,n=(a,c,p,m)=>{let f=t.button(null,a,()=>t.command(`export ${c}`),{text:a,when:m});return p&&t.visible(f,()=>!e.recorded),f},o=k("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>Zp(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),r=t.button("save","Export",()=>s(o.hidden),{text:"Export",when:()=>!!e.document}),s=a=>{o.hidden=!a,r.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};s(!1);let i=k("div",{className:"anchor"},r,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(s(!1),r.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||s(!1)}),o.addEventListener("click",()=>{s(!1),r.
focus()}),i}var Xp={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M\
20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v1\
4M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20\
h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v\
.5",close:"M6 6l12 12M18 6L6 18"};function Zt(t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.or\
g/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true"),n.setAttribute("d",Xp[t]),e.append(n),e}var Ts=[["truth","true wall"],["ray","ray"],["miss","no return"],["dot","reading"],["sensor","sensor"],["stroke","surface"],["trajectory","trajectory"],["unobse\
rved","unobserved"]];function ya(t,e){let{session:n}=t,o=k("span",{className:"ramp"}),r=k("span"),s=Ts.map(([a,c])=>{let p=k("i",{className:a});return a==="sens\
or"&&p.append(Zt("sensor")),k("li",{},p,c)});t.visible(s[0],()=>!n.document||n.document.source.kind==="simulation"),t.visible(s[Ts.findIndex(([a])=>a==="stroke")],
()=>!!n.overlay?.strokes.length),t.visible(s[Ts.findIndex(([a])=>a==="trajectory")],()=>!!n.overlay?.trajectory.length);let i="";return t.each(()=>{let a=n.shown?.
layer==="width"?"width":n.view.layer,{kind:c,mean:p,value:m}=n.quantity;z(r,"textContent",a==="entropy"?"entropy (bit)":a==="width"?"width of the 90 % interval":
c==="binary"?"P(wall)":a==="draw"?m:p);let g=a==="entropy"||a==="width",x=`${g} ${e().ground}`;i!==x&&(i=x,o.style.background=Ci(g?uo:b=>jr(e(),b)))}),k("ul",{className:"\
legend","aria-label":"Legend"},k("li",{},r,"0",o,"1"),...s)}var ed="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.";function xa(t){
let{session:e}=t,n=k("span",{className:"chip"}),o=t.button(null,"Not converged",()=>ba(e)?.apply(),{text:"Not converged",className:"chip doubt"}),r=k("div",{className:"\
chips"},n,o);return t.each(()=>{let s=ba(e);z(o,"hidden",!s),s&&(z(o.firstElementChild,"textContent",`not converged: ${s.text}`),z(o,"title",`${e.shown?.verdict?.
why}. Click to ${s.text}.`),Tt(o,"aria-label",`Not converged: ${s.text}`));let i=e.shown;if(!i||!e.document)return z(r,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",c=i.layer==="draw"?a:i.layer==="width"?"width of the 90 % interval":e.view.layer==="entropy"?"entropy":"mean",p={importance:"\
importance sampling",propagate:"belief propagation"}[i.method],m=i.approximate?"approximate, belief propagation":p??`${i.sweeps} sweeps`;z(r,"hidden",!1),z(n,"t\
extContent",`${c} · ${m}`),z(n,"className",i.approximate?"chip approximate":"chip")}),r}function ba(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||
!n||t.recorded||n.source.kind==="run")return null;let o=s=>()=>t.act({type:"set",patch:s});if(e.method==="gibbs"&&n.source.kind==="simulation")return{text:"try \
blocks",apply:o({method:"block"})};if(e.method==="importance")return{text:"try Gibbs",apply:o({method:"auto"})};if(t.sampling)return null;let r=Math.min(_e.sweeps[1],
4*n.sweeps);return r>n.sweeps?{text:`try ${r} sweeps`,apply:o({sweeps:r})}:null}function va(t){let{session:e}=t,n=k("span"),o=t.button(null,"Reconnect now",()=>e.
transport.retry?.(),{text:"Reconnect now"}),r=k("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let s=e.everConnected&&!e.connection.connected,
i=Math.max(1,Math.round((e.connection.retryIn_ms??0)/1e3));z(r,"hidden",!s&&e.worker!=="restarted"),z(r,"className",s?"banner":"banner mild"),z(o,"hidden",!s);let a=`\
Connection lost. Trying again in ${i} s; the map is kept here.`,c=e.connection.refused?ed:a;z(n,"textContent",s?c:"The worker stopped and is being started again\
. The map is kept.")}),r}function ka(t){let{session:e,hand:n}=t,o=k("div",{className:"readout",id:`${t.prefix}-readout`}),r=k("span",{role:"status","aria-live":"\
polite"}),s=k("span",{className:"hidden","aria-live":"polite"});return n.announce=i=>z(s,"textContent",i),n.describe=i=>wa(e,i),t.each(()=>{let i=n.cursor??n.hover,
c=e.editable&&!matchMedia("(pointer: coarse)").matches?"Point at a cell, or press ? for the keys":"Point at a cell";z(o,"textContent",i?wa(e,i):c);let p=e.status.
text==="Ready"&&e.shown?.verdict?.level==="bad";z(r,"textContent",p?"Ready, but the chains have not converged":e.status.text),z(r,"className",p?"warning":e.status.
level)}),{element:k("footer",{},r,o,s),readout:o}}function wa(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:r,shape:s}=n.grid,i=e.x*s[1]+e.y,a=Math.
max(1,Math.ceil(-Math.log10(r))+1),{x:c,y:p}=Nn(e,n.grid),m=[`Cell ${e.x}, ${e.y}`,`${c.toFixed(a)}, ${p.toFixed(a)} m`];if(o&&o.p.length===s[0]*s[1]){let f=o.p[i]/
255,{kind:g,mean:x,value:b,interval:M}=t.quantity;o.layer==="width"?m.push(`90 % interval ${f.toFixed(2)} wide`):g!=="binary"&&o.layer==="draw"?m.push(`${b} ${f.
toFixed(2)} in this draw`):g!=="binary"?m.push(`${x} ${f.toFixed(2)}`,...M?[]:[`entropy ${co(f).toFixed(2)} bit`]):o.layer==="draw"?m.push(f>.5?"wall in this dr\
aw":"free in this draw"):m.push(`P(wall) ${f.toFixed(2)}`,`entropy ${co(f).toFixed(2)} bit`);let T=t.cell?.x===e.x&&t.cell.y===e.y?t.cell:null,C=T?T.beams:null;
o.observed[i]?C!==null&&m.push(C===1?"1 beam":`${C} beams`):m.push("unobserved"),T?.nats_for!==void 0&&T.nats_against!==void 0&&C&&m.push(`for a wall ${T.beams_for}\
, ${T.nats_for.toFixed(1)} nats`,`against ${T.beams_against}, ${T.nats_against.toFixed(1)} nats`)}return m.join(" · ")}var Ps=t=>t.charAt(0).toUpperCase()+t.slice(1),ar=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=Ps(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var td={importance:"particles",propagate:"rounds"};function Sa(t,...e){let{session:n}=t,o=k("progress",{max:1,value:0,"aria-label":"Progress"}),r=k("div",{className:"\
doing"});return t.each(()=>{let s=n.shown,i=s&&s.total>0&&!s.approximate?s.sweeps/s.total:0;z(o,"value",i);let a=n.remaining_s(),c=td[s?.method??""]??"sweeps",p=s&&
!s.approximate&&s.total?`${s.sweeps} of ${s.total} ${c}`:"",m=a!==null?a<1?"less than 1 s left":`${Math.ceil(a)} s left`:n.running?"running":"";z(r,"textContent",
Ps([p,m].filter(Boolean).join(", "))||"No chain yet")}),t.section("Posterior",nd(t),o,r,od(t),rd(t),...e)}function nd(t){let{session:e}=t,n=t.button("play","Run",
()=>e.act({type:"run"}),{className:"primary",text:"Run",title:"Run (R)"}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (E\
scape)",when:()=>e.running||e.sampling}),r=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chain"),s=k("div",{
className:"buttons"},n,o,r);return t.visible(s,()=>!e.recorded&&e.document?.source.kind!=="run"),s}function od(t){let{session:e}=t,n=k("dl"),o=(r,s,i,a=!1)=>{let c=k(
"dd",{textContent:"–"});n.append(k("div",{title:s},k("dt",{textContent:r}),c)),t.each(()=>{z(c,"textContent",e.shown?i(e.shown):"–"),a&&z(c,"className",e.shown?.
verdict?.level??"")})};return o("ESS","Effective sample size of the log joint",r=>bt(r.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",
r=>bt(r.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",r=>bt(r.log_joint,1)),o("reply","From the hand's last move to its picture",()=>bt(
e.latency.eventToPaint_ms.at(-1),0," ms")),n}function rd(t){let{session:e}=t,n=k("div",{className:"verdict"});return t.each(()=>{let o=e.shown?.verdict;if(z(n,"\
hidden",!o),!o)return;let r={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];z(n,"textContent",`${r}: ${o.why}`),z(n,"className",`verdict\
 ${o.level}`)}),n}var sd={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},id={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},ld={noisy:"with noise",exact:"exact"},ad={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},cd={raster:"raster",radial:"radial",random:"random"},cr=2*Math.PI,ud=t=>Math.round(t*1800/Math.PI)/10,pd={importance:"Particles",propagate:"Round\
s"};function Ma(t){let{session:e,hand:n,editor:o}=t,r=k("select",{"aria-label":"Selected sensor"});r.addEventListener("change",()=>{n.selected=Number(r.value),n.
choose("sensor")});let s="";t.each(()=>{let f=e.document?.sensors??[],g=f.map(x=>x.id).join();g!==s&&r.replaceChildren(...f.map(({id:x})=>k("option",{value:String(
x),textContent:`Sensor ${x}`}))),s=g,z(r,"value",String(n.sensor?.id??""))});let i=(f,g)=>t.numberInput(f,()=>Number((n.sensor?.[g]??0).toFixed(2)),x=>n.sensor&&
o.moveSensor(n.sensor,{[g]:x}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),f=>n.sensor&&o.moveSensor(n.sensor,{yaw:f%
360*Math.PI/180}),{step:5}),c=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),p=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.document?.fov??cr)<cr);let m=k("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),
a);return t.section("Sensors",k("div",{className:"buttons"},r,c,p),m)}function Ta(t){let{session:e}=t,[n,o]=_e.max_range,[r,s]=_e.fov_deg,i=t.numberInput("Longe\
st range (m)",()=>e.document?.max_range??0,f=>t.set({max_range:f}),{min:n,max:o,step:"any"}),a=[t.slider("noise",()=>"Noise (m)",{low:_e.noise[0],high:_e.noise[1],
step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{low:_e.angles[0],high:_e.angles[1],step:1,log:!0}),i,t.numberInput("Field of view (°)",()=>ud(e.document?.
fov??cr),f=>t.set({fov:f>=s?cr:f*Math.PI/180}),{min:r,max:s,step:5}),t.select("Readings",ld,()=>e.document?.readings??"noisy",f=>t.set({readings:f}))];for(let f of a)
t.visible(f,()=>e.editable);let c=t.slider("prior",()=>"Prior P(wall)",{low:_e.prior[0],high:_e.prior[1],step:.01}),p=()=>(e.document?.cells??"binary")==="binar\
y";t.visible(c,p);let m=t.select("Cells",id,()=>e.document?.cells??"binary",f=>t.set({cells:f}));return t.visible(m,()=>e.document?.source.kind==="log"),t.section(
"Model",m,c,...a)}function Pa(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>(e.document?.cells??"binary")==="binary",r=()=>/auto|gibbs|block/.test(
n()),[s,i]=_e.seed,a=[t.select("Method",sd,n,c=>t.set({method:c})),t.select("Order",cd,()=>e.document?.order??"radial",c=>t.set({order:c}),()=>n()==="gibbs"||n()===
"auto"),t.select("Start",ad,()=>e.document?.start??"auto",c=>t.set({start:c}),r)];for(let c of a)t.visible(c,o);return t.section("Inference",...a,t.slider("swee\
ps",()=>pd[n()]??"Sweeps",{low:_e.sweeps[0],high:_e.sweeps[1],step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,c=>t.set({seed:Math.round(c)}),{min:s,
max:i,step:1}))}function Ea(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),o=t.
button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.section("Clear",k("div",{className:"buttons"},n,o))}var dd=0,ur=class{constructor(e,n,o,r,s,i){this.session=e;this.hand=n;this.editor=o;this.command=r;this.showLayer=s;this.embedded=i}prefix=`bayesmap${dd++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}endDrag(){
this.drag++}visible(e,n){this.each(()=>z(e,"hidden",!n()))}button(e,n,o,{className:r="",text:s="",when:i,title:a}={}){let c=k("button",{type:"button",className:r,
title:a??n,onclick:o},e&&Zt(e));return s&&c.append(k("span",{textContent:s})),s!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>z(c,"disabled",!i())),c}segmented(e,n,o,r,s){
let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=k("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[c,p,m]of n){let f=k("input",{type:"rad\
io",name:i,value:c,onchange:()=>r(c)});a.append(k("label",{title:p},f,m?Zt(m):null,k("span",{textContent:p}))),this.each(()=>{z(f,"checked",o()===c),s&&z(f,"dis\
abled",!s(c))})}return a}section(e,...n){let o=`${this.prefix}-${e}`;return k("section",{"aria-labelledby":o},k("h2",{id:o,textContent:e}),...n)}row(e,n){return n.
id=`${this.prefix}-${e.replace(/\W/g,"")}`,k("div",{className:"row"},k("label",{for:n.id,textContent:e}),n)}slider(e,n,{low:o,high:r,step:s,log:i=!1,unit:a=""}){
let c=`${this.prefix}-${e}`,p=b=>i?1e3*Math.log(b/o)/Math.log(r/o):b,m=b=>{if(!i)return b;let M=o*(r/o)**(b/1e3),T=M<100?1:10**(Math.floor(Math.log10(M))-1);return de(
Math.round(M/T)*T,o,r)},f=k("label",{for:c}),g=k("input",{type:"range",id:c,...i?{min:0,max:1e3,step:1}:{min:o,max:r,step:s}}),x=k("input",{type:"number",min:String(
o),max:String(r),step:String(s)});return g.addEventListener("input",()=>this.set({[e]:m(Number(g.value))})),g.addEventListener("change",()=>this.endDrag()),x.addEventListener(
"change",()=>{let b=Number(x.value);x.value===""||!Number.isFinite(b)?x.value=String(this.session.document?.[e]):this.set({[e]:i?Math.round(de(b,o,r)):de(b,o,r)}),
this.endDrag()}),this.each(()=>{let b=this.session.document?.[e]??o;z(f,"textContent",n()),Tt(x,"aria-label",`${n()}, number`),m(Number(g.value))!==b&&(g.value=
String(p(b))),Tt(g,"aria-valuetext",`${b}${a}`);let M=100*(p(b)-Number(g.min))/(Number(g.max)-Number(g.min));g.style.setProperty("--fill",`${de(M,0,100)}%`),fo(
x)||z(x,"value",String(b))}),k("div",{className:"row slider"},f,g,x)}select(e,n,o,r,s){let i=k("select",{onchange:()=>r(i.value)});for(let[a,c]of Object.entries(
n))i.append(k("option",{value:a,textContent:c}));return this.each(()=>{z(i,"value",o()),s&&z(i,"disabled",!s())}),this.row(e,i)}numberInput(e,n,o,r={}){let s=k(
"input",{type:"number",...r}),{min:i=-1/0,max:a=1/0}=r;return s.addEventListener("change",()=>{s.value!==""&&Number.isFinite(Number(s.value))&&o(de(Number(s.value),
i,a))}),this.each(()=>{fo(s)||z(s,"value",String(n()))}),this.row(e,s)}checkbox(e,n,o,r=""){let s=k("input",{type:"checkbox",onchange:()=>o(s.checked)});return this.
each(()=>z(s,"checked",n())),k("label",{className:"check",title:r},s,k("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,
r=k("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},Zt("close")),s=k("div",{className:"title"},k("h2",{id:o,textContent:e}),
r),i=k("dialog",{"aria-labelledby":o},s,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),
i}};var fd=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],hd={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},pr=class{constructor(e){
this.session=e}playing=!1;drawsPerSecond=10;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.session.act({type:"view",layer:e,
chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,draw:e})}play(e){if(this.playing=e,e){let{
draw:n,draws:o}=this.session;this.showDraw(n>=o.count-1?0:n)}this.session.changed()}playFromStart(){this.showDraw(0),this.playing=!0,this.session.changed()}step(){
!this.playing||this.session.shown?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:e,draws:n}=this.session;e+1>=n.count?this.play(!1):this.showDraw(
e+1)},1e3/this.drawsPerSecond)}};function Aa(t,e,n){let{session:o}=t,r=t.segmented("Show",fd,()=>o.view.layer,g=>e.showLayer(g),g=>g!=="draw"||o.hasDraws),[,,s,
i]=Array.from(r.children);z(i,"title","Width of each cell's 90 % interval"),t.visible(s,()=>!o.quantity.interval),t.visible(i,()=>o.quantity.interval);let a=(g,x)=>t.
checkbox(g,()=>n[x],b=>{n[x]=b,o.changed()}),c=a("True walls","truth");t.visible(c,()=>!o.document||o.document.source.kind==="simulation");let[p,m]=[a("Surfaces",
"strokes"),a("Trajectory","trajectory")];t.visible(p,()=>!!o.overlay?.strokes.length),t.visible(m,()=>!!o.overlay?.trajectory.length);let f=k("div",{className:"\
checks",role:"group","aria-label":"Marks"},c,a("Rays","rays"),a("Readings","readings"),p,m);return t.section("View",r,md(t,e),f)}function md(t,e){let{session:n}=t,
o=k("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let r=t.button("pla\
y","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1}),s=k("output"),i=k("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(
n.draw,Number(i.value))),t.each(()=>{let{chains:p,count:m}=n.draws;z(o,"max",String(Math.max(0,m-1))),z(o,"disabled",m===0),z(o,"value",String(n.draw));let f=m?
`${n.draw+1} of ${m}`:"none kept";Tt(o,"aria-valuetext",f),o.style.setProperty("--fill",`${m>1?100*n.draw/(m-1):0}%`),z(s,"textContent",f),i.length!==Math.max(1,
p)&&i.replaceChildren(...Array.from({length:Math.max(1,p)},(x,b)=>k("option",{value:String(b),textContent:`chain ${b+1}`}))),z(i,"value",String(n.view.chain)),z(
i,"disabled",p<2),m<2&&e.playing&&e.play(!1);let g=e.playing?"Pause the draws":"Play the draws";r.getAttribute("aria-label")!==g&&(r.setAttribute("aria-label",g),
r.replaceChildren(Zt(e.playing?"pause":"play")))});let a=k("select",{"aria-label":"Speed"});for(let[p,m]of Object.entries(hd))a.append(k("option",{value:p,textContent:m}));
a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let c=t.button(null,"From the first sweep",()=>e.playFromStart(),
{text:"From the first",when:()=>n.draws.count>1});return t.each(()=>z(a,"disabled",n.draws.count<2)),k("div",{className:"player"},r,o,s,k("div",{className:"butt\
ons wide"},i,a,c))}function Ca(t){let{session:e}=t,n=k("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=k("output");n.addEventListener("input",
()=>e.act({type:"scan",index:Number(n.value)}));let r=t.section("Scan",k("div",{className:"player bare"},n,o));return t.each(()=>{let s=e.document?.source.kind===
"simulation"?0:e.document?.source.scans??0;z(r,"hidden",s<2),z(n,"max",String(Math.max(0,s-1))),fo(n)||z(n,"value",String(e.scan?.index??0)),n.style.setProperty(
"--fill",`${100*Number(n.value)/Math.max(1,s-1)}%`),z(o,"textContent",`${Number(n.value)+1} / ${s}`)}),r}function _a(t,e,n){let{shown:o,status:r}=t,i=o?.layer==="draw"||o?.layer==="width"?o.layer:t.view.layer==="entropy"?"entropy":"mean";return{document:t.effectiveDocument(),
generation:t.generation,painted:o&&{generation:o.generation,layer:i,approximate:o.approximate,sweeps:o.sweeps,method:o.method,quantity:t.quantity,rhat:o.rhat,verdict:o.
verdict,trace:o.trace,traced:o.traced,weights:o.weights,ess:o.ess,chain:o.chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(
0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{text:r.text,level:r.level},connected:t.connection.connected,decisions:{path:t.decisions.path,
views:t.decisions.views,trouble:t.decisions.trouble},overlay:t.overlay&&{strokes:t.overlay.strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,
running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{
...n.paints},transform:{...e.transform}}}var La="bayesmap-token",Es="bayesmap-kept";function gd(t){try{return localStorage.getItem(t)}catch{return null}}function As(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function Cs(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&As(Es,JSON.stringify(t))}function Da(){
As(Es,null)}function Ra(){let t=gd(Es);try{return t&&JSON.parse(t)}catch{return null}}function Na(t){t&&As(La,t)}function Fa(t){let e=n=>{n.key===La&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var Oa=new Set(["walls","sensor","set","view","live"]);function Ia(t,e){let{document:n,walls:o}=t,r=n.grid.shape[1];if(e.type==="walls")for(let[s,i]of e.cells)o[s*
r+i]=e.wall?1:0;else if(e.type==="set")Object.assign(n,e.patch);else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,
chain:e.chain??t.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let s=n.sensors.find(i=>i.id===e.id);s&&Object.assign(s,{x:e.x,y:e.y,yaw:e.
yaw})}}var dr=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.trouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.session.
changed())}forget(){this.start=this.goal=this.path=this.views=null,this.askedPath=this.askedViews="",this.version++}ask(){let{session:e,start:n,goal:o,radius:r,
risk:s}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;let a=`${i.generation} ${e.sampling}`,c=`${a} ${JSON.stringify([n,o,r,s])}`;n&&o&&
!i.approximate&&c!==this.askedPath&&(this.askedPath=c,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:r,risk:s})),this.looking&&(!i.approximate||e.document?.
method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){this.trouble=e.type==="undecided"?e.text:"",e.type==="path"&&
(this.path=e),e.type==="views"&&this.looking&&(this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}),e.type==="undecided"&&(this.path=null),this.version++}nearest(e){
let{views:n}=this;if(!n?.nats.length)return null;let[o,r]=[0,1/0];for(let s=0;s<n.nats.length;s++){let i=Math.hypot(n.pose[3*s]-e.x,n.pose[3*s+1]-e.y);i<r&&([o,
r]=[s,i])}return o}};var fr=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let r of this.
waiting)r.seq<=n&&this.eventToPaint_ms.push(o-r.time);this.waiting=this.waiting.filter(r=>r.seq>n);for(let r of this.seqOfGeneration.keys())r<e&&this.seqOfGeneration.
delete(r)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var hr=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var yd=new Set(["inspect","path","views"]),mr=class{constructor(e,n,o=null,r=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=r;e.onmessage=(s,i)=>this.
receive(s,i),e.onstatus=s=>this.onstatus(s)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={layer:"mean",chain:0,
draw:null};state=null;scan=null;overlay=null;shown=null;cell=null;worker="starting";recorded=!1;generation=-1;acted=0;decisions=new dr(this);status=new ar;progress=new hr;latency=new fr;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,text:""};get shape(){
return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get running(){return!!this.state?.
running}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&(this.running||this.
state?.live))}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){
return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){
if(!this.document&&e.type!=="hello")return;let o={...e,seq:++this.seq};yd.has(e.type)||(this.acted=this.seq),Oa.has(e.type)&&(this.pending.push(o),this.foresee(
o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&Cs(this.portableDocument()),this.changed()}bring(e){this.
act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.wallsVersion&&(this.packed=
{version:this.wallsVersion,text:Lo(ci(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.effectiveDocument();
return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,!0)}painted(){this.counts.
paints++,this.shown&&this.latency.painted(this.shown.generation),this.decisions.ask()}get quantity(){return this.shown?.quantity??{kind:"binary",mean:"P(wall)",
value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){if(this.connection=e,e.connected){
let n=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(n),this.view.layer!=="mean"&&this.document&&this.act(
{type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.text,this.notice.level),this.everConnected=!0,Da()}else
this.everConnected&&(this.say("Connection lost","error"),Cs(this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"welcome":this.generation=-1,
this.recorded=!!e.recorded,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":if(e.generation>=this.generation){let{pose:o,
angles:r,ranges:s,exact:i,hit:a}=n;this.scan={ids:e.ids??[],index:e.index??null,pose:o,angles:r,ranges:s,exact:i,hit:a}}break;case"overlay":this.overlay=n;break;case"\
field":this.receiveField(e,n);break;case"cell":this.cell=e;break;case"path":case"views":case"undecided":this.decisions.receive(e,n);break;case"status":this.status.
say(e.text,e.level??"info",this.acted);break;case"error":this.receiveError(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"down\
load":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveError(e){let n=e.refused?.seq??null;
n!==null&&n===this.broughtAt&&(this.broughtAt=null,this.act({type:"hello"})),this.status.say([e.text,e.remedy].filter(Boolean).join("; "),"error",this.acted),this.
pending=this.pending.filter(o=>o.seq!==n),n!==null&&this.latency.refused(n),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,this.generation=
Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){
if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:r,traced:s,weights:i}=n,a=n.observed,c=this.next??this.
shown,m=c&&c.p.length===o.length&&c.bits.every((f,g)=>f===a[g])?{observed:c.observed,bits:c.bits}:{observed:lo(a,o.length),bits:a};this.next={...e,p:o,trace:r,traced:s,
weights:i,...m},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,r=this.confirmedWalls;if((e.walls!==
r.text||r.walls.length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:lo(Wt(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(s=>({...s}))},(this.confirmedWalls!==
r||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),this.state.view&&!this.pending.some(s=>s.type==="view")){
let{layer:s,chain:i,draw:a}=this.state.view;this.view={layer:s??"mean",chain:i??0,draw:a??null}}for(let s of this.pending)this.foresee(s)}foresee(e){!this.document||
!this.state||(Ia(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Ua='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var za=`:host { display: block; height: 100dvh; container-type: size; }
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
.double { display: grid; grid-template-columns: 1fr 1fr; gap: 8px; }
.double .row { grid-template-columns: 1fr; gap: 2px; }
.double label { font-size: 12.5px; color: var(--soft); }
.said { margin: 6px 0 0; font-size: 13px; line-height: 1.45; }
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
@container (max-width: 640px) {
  .bar .segmented span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); }
  .bar .segmented label { padding: 0 12px; }
  .bar .segmented svg { width: 18px; }
}
@container (max-width: 380px) { .bar .segmented label { padding: 0 9px; } .buttons { flex-wrap: wrap; } }
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
`;var Wa="bayesmap-theme",Va={auto:"light",light:"dark",dark:"auto"},gr=class{constructor(e,n){this.app=e;this.dressed=n;let o=xd();o&&o in Va&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=Ho.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?Ho.dark:Ho.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:r,noReturn:s,sensor:i,
hatch:a,unobserved:c}=n;for(let[p,m]of Object.entries({truth:o,ray:r,miss:s,sensor:i,hatch:a,unobserved:c}))this.app.style.setProperty(`--${p}`,m);this.dressed(
this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Va[this.choice];try{localStorage.setItem(Wa,this.choice)}catch{}this.dress()}destroy(){this.media.
removeEventListener("change",this.listen)}};function xd(){try{return localStorage.getItem(Wa)}catch{return null}}function yr(t,e,{embedded:n=!1,adopt:o=null,notice:r=null}={}){let s=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(Ua+za),s.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,c=()=>{a||=requestAnimationFrame(Ie)},p=new mr(e,c,o,r),m=new Fn,f=new Oo(p),g=new Fo(p,f),x=new pr(p),b=new ur(
p,f,g,ie,Y=>x.showLayer(Y),n),M=[new Un,new Vn,new Wn,new zn,new In,new Vo],T=M.map(({name:Y})=>k("canvas",{className:Y})),C=T[T.length-1];Object.assign(C,{tabIndex:0,
role:"application"});let S=new $o(M,T);new zo(C,p,m,f,g,n);let L=new Io(C,p,m,f,g),P={truth:!0,rays:!0,readings:!0,strokes:!0,trajectory:!0},j=ga(b),D=Fi(b),Z={
chip:xa(b),banner:va(b)},$=k("main",{className:"stage"},...T,Z.chip,Z.banner),R=()=>X.theme,V=ya(b,R),A=ka(b);C.setAttribute("aria-describedby",A.readout.id);let q=ma(
b),U={help:fa(b),new:ha(b),share:q.dialog},[K,H,ne,G]=[Ma(b),Ta(b),Pa(b),Ea(b)],Ke=[da(b),Sa(b,ua(b,R),pa(b,R)),Aa(b,x,P),Ca(b),K,H,ne,G],me=k("aside",{"aria-la\
bel":"Controls"},...Ke),re=()=>p.recorded||p.document?.source.kind==="run";b.visible(K,()=>p.editable),b.visible(H,()=>!re()),b.visible(ne,()=>!re()),b.visible(
G,()=>!re()),b.each(()=>{z(D,"inert",!p.document),z(me,"inert",!p.document)});let ce=k("div",{className:"app"},j.element,D,$,V,me,A.element,...Object.values(U));
s.replaceChildren(ce);let X=new gr(ce,Y=>{j.nameTheme(Y),c()}),W=()=>{let Y=p.editable&&f.tool==="sensor"?f.sensor?.id??null:null;return{session:p,view:m,look:{
theme:X.theme,...P,hover:f.hover,cursor:f.cursor,selected:Y}}},Pe="";function Ie(){a=0;let Y=p.take();p.document&&String(p.shape)!==Pe&&(Pe=String(p.shape),m.fit(
p.shape),f.cursor=f.hover=null,p.decisions.forget(),C.setAttribute("aria-label",`Map, ${p.shape[0]} by ${p.shape[1]} cells`)),S.paint(W()),Y&&(p.painted(),x.step());
let{x:te,y:De}=m.transform;Z.chip.style.transform=`translate(${Math.max(te,je.left)}px, ${Math.max(De-28,6)}px)`,Tt(C,"data-tool",p.editable||Ft.has(f.tool)?f.tool:
"pan"),b.refresh()}let ge=new ResizeObserver(()=>{let{width:Y,height:te}=$.getBoundingClientRect();!Y||!te||(m.resize(Y,te,devicePixelRatio||1),m.fitted&&m.fit(
p.shape),cancelAnimationFrame(a),Ie())});ge.observe($);async function ie(Y){if(Y==="in"||Y==="out")m.zoom(Y==="in"?1.4:1/1.4,m.middle,p.shape);else if(Y==="fit")
m.fit(p.shape);else if(Y==="help")U.help.showModal();else if(Y==="new")U.new.showModal();else if(Y==="theme")X.next();else if(Y==="add")L.addSensor();else if(Y===
"share"){let te=p.portableDocument();te&&q.show(location.origin+location.pathname+await di(te))}else if(Y==="export png"){let te=await Ri(W());te&&Kr("bayesmap.\
png",te),p.say("Saved bayesmap.png")}else Y.startsWith("export ")&&p.act({type:"export",what:Y.slice(7)});c()}p.ondownload=(Y,te,De)=>Kr(Y,new Blob([De],{type:te}));
let ot=[[n?t:window,"keydown",Y=>{Y.defaultPrevented||!p.document||Object.values(U).some(te=>te.open)||Si(Y,p,{tool:te=>{f.choose(te),L.focus()},layer:te=>x.showLayer(
te),command:ie})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{if(n)return;let{document:Y,damaged:te}=await No();Y?p.bring(Y):te&&p.say(Ro,
"error")}]];for(let[Y,te,De]of ot)Y.addEventListener(te,De);return X.dress(),e.open(),{destroy(){ge.disconnect(),cancelAnimationFrame(a),X.destroy();for(let[Y,te,
De]of ot)Y.removeEventListener(te,De);e.close(),s.replaceChildren()},snapshot:()=>_a(p,m,S),cellToClient(Y,te){let De=C.getBoundingClientRect(),Ut=m.fromGrid({x:Y+
.5,y:te+.5},p.shape[1]);return{x:De.left+Ut.x,y:De.top+Ut.y}}}}var _s={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},Ha=8,Qn=()=>({onmessage:()=>{},onstatus:()=>{}});function $a(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},r=4+e;for(let{name:s,dtype:i,shape:a}of n.buffers){let c=a.reduce((p,m)=>p*m,1)*_s[i].BYTES_PER_ELEMENT;
o[s]=new _s[i](t.slice(r,r+c)),r+=Math.ceil(c/Ha)*Ha}return[n,o]}function Ga(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:r},s)=>{let{buffer:i,byteOffset:a,
byteLength:c}=e[s];n[o]=new _s[r](i.slice(a,a+c))}),n}function Ba(t){let{document:e,scans:n,settings:o={},log_joint:r=[]}=t,s=e.grid.shape[0]*e.grid.shape[1],i=t.draws?.count??0,a=e.source.kind!=="simulation",c=Wt(
t.mean),p=Wt(t.observed),m=null,f=0,g={layer:"mean",chain:0,draw:null},x=R=>a?[R[f]]:R,b=R=>Float32Array.from(x(R).flat(),V=>V??1/0),M=n.angles.length,T=lo(Wt(n.
hit),n.pose.length*M),C=()=>a?T.subarray(f*M,(f+1)*M):T,S=Float32Array.from(r.flat()),L=(o.sweeps??i)/Math.max(1,i),P=Float32Array.from(r[0]??[],(R,V)=>(V+1)*L),
j=R=>{let V={chains:t.draws?.chains??0,count:m?i:0},A={generation:1,can_undo:!1,can_redo:!1,live:!1,running:!1};$.onmessage({type:"state",document:e,seq:R,...A,
draws:V,view:g},{})},D=()=>{let R=Float64Array.from(x(n.pose).flat(),Number),V={type:"scan",generation:1,ids:a?[f]:n.ids,index:a?f:null},A=n.exact?.length?b(n.exact):
new Float32Array(0);$.onmessage(V,{pose:R,angles:Float32Array.from(n.angles),ranges:b(n.ranges),exact:A,hit:C()})},Z=()=>{let R=g.layer==="draw"&&m?vd(m,g.chain*
i+(g.draw??i-1),s):null,V=r[g.chain]?.[(g.layer==="draw"?g.draw:null)??i-1]??null,A=R?{...g,draw:g.draw??i-1}:{layer:g.layer==="draw"?"mean":g.layer},q=o.sweeps??
i,U={quantity:o.quantity,sweeps:q,total:q,ess:o.ess,rhat:o.rhat,verdict:o.verdict,log_joint:V},K=o.method??e.method,H={p:R??c,observed:p,trace:S,traced:P};$.onmessage(
{type:"field",generation:1,...A,method:K,approximate:!1,...U},H)},$={...Qn(),open:()=>$.onstatus({connected:!0}),send:R=>{if(R.type==="hello"){if($.onmessage({type:"\
welcome",version:1,recorded:!0},{}),j(R.seq),D(),Z(),!i||!t.draws)return;Do(Wt(t.draws.data)).then(V=>{m=V,j(R.seq)})}else if(R.type==="view")g={layer:R.layer,chain:R.
chain??g.chain,draw:R.draw??null},j(R.seq),Z();else if(R.type==="scan")f=R.index,j(R.seq),D();else if(R.type==="inspect"){let V=kd(e,n.angles,x(n.pose),x(n.ranges),
R.x,R.y);$.onmessage({type:"cell",x:R.x,y:R.y,beams:V},{})}},close:()=>{}};return $}function vd(t,e,n){let o=e*n;return Uint8Array.from({length:n},(r,s)=>t[o+s>>
3]>>7-(o+s&7)&1?255:0)}function kd({grid:t},e,n,o,r,s){let{origin:i,resolution:a}=t,c=[i[0]+r*a,i[1]+s*a],p=0;return n.forEach((m,f)=>{let[g,x,b]=m.map(Number);
e.forEach((M,T)=>{let[C,S]=[Math.cos(M+b),Math.sin(M+b)],L=[(c[0]-g)/C,(c[0]+a-g)/C,(c[1]-x)/S,(c[1]+a-x)/S],P=Math.max(0,Math.min(L[0],L[1]),Math.min(L[2],L[3])),
j=Math.min(o[f][T]??1/0,Math.max(L[0],L[1]),Math.max(L[2],L[3]));P<j&&p++})}),p}var Ls=250,Sd=8e3;function ja(t){let e=null,n=Ls,o=0,r=!1;function s(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let c=new WebSocket(a),p=!1;e=c,c.binaryType="arraybuffer",c.onopen=()=>{p=!0,n=Ls,i.onstatus({connected:!0})},c.onmessage=({data:m})=>{typeof m==
"string"?i.onmessage(JSON.parse(m),{}):i.onmessage(...$a(m))},c.onclose=()=>{if(r||e!==c)return;o=window.setTimeout(s,n);let m={connected:!1,retryIn_ms:n};i.onstatus(
m),p||Md(t()).then(f=>f&&e===c&&i.onstatus({...m,refused:f})),n=Math.min(Sd,2*n)}}let i={...Qn(),open:s,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=Ls,e?.readyState!==WebSocket.OPEN&&s()},close:()=>{r=!0,clearTimeout(o),e?.close()}};return i}async function Md(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Ka(t){let e=(o,r=[])=>n.onmessage(o,Ga(o,r)),n={...Qn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var Td="This is the map that was drawn here when the connection was lost; undo leads back",Ds=t=>Object.assign(window,{bayesmap:t}),Lm={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=yr(n,Ka(t),{embedded:!0});return Ds(o),()=>o.destroy()}};async function Pd(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){Ds(yr(t,Ba(JSON.parse(n.textContent??""))));return}Na(new URLSearchParams(location.search).get("token"));let{document:o,damaged:r}=await No(),
s=o?null:Ra(),i=ja(()=>new URL(location.href));Fa(c=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(c)}${location.hash}`),i.retry?.()}),
Ds(yr(t,i,{adopt:o??s,notice:r?{text:Ro,level:"error"}:s?{text:Td,level:"info"}:null}))}Pd();export{Lm as default,yr as mount,Ba as recordedTransport,ja as webSocketTransport,Ka as widgetTransport};
