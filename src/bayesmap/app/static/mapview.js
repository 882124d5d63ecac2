// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function io(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function li(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Ut(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Co(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function ai(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var _o=t=>ai(t,new DecompressionStream("deflate-raw")),ci=t=>ai(t,new CompressionStream("deflate-r\
aw"));async function ui(t){let e=await ci(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Co(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function vc(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await _o(Ut(e[1]))))}var Lo="The link's map cannot be read: copy the link again, who\
le";async function Do(){let t=await vc(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var he=(t,e,n)=>Math.min(n,Math.max(e,t)),Rn=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,Kt=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Vs=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function lo(t,e){let{x:n,y:o}=Kt(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Nn=(t,e)=>Vs({x:t.x+.5,y:t.y+.5},e);
function pi(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function di(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let c=i<
n&&s(r-1,i)!==s(r,i);c&&a<0&&(a=i),!c&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let c=i<e&&s(i,r-1)!==s(i,r);c&&
a<0&&(a=i),!c&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var Ro=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function fi(t,e,n){let o=mi(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return gi(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function hi(t,e){
let n=kc(e,t.grid.shape),o=mi(t);return gi(t,(s,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let c of o)a=Math.min(a,Math.hypot(s-c.x,r-c.y));return a>0?a:-1/0})}
var mi=({sensors:t,grid:e})=>t.map(n=>lo(n,e));function gi(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let c=e(i,a,i*o+a);
c>r&&([s,r]=[{x:i,y:a},c])}return s&&Nn(s,t.grid)}function kc(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)o[r*n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),
s(r+1,i-1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var _e={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],fov_deg:[5,360],sweeps:[1,1e5],seed:[0,2147483647]};var No=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Rn(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(p=>lo(p,r.grid)):[],c=new Map;for(let p of e)!Rn(p,i)||this.isWall(p)===n||a.some(m=>m.x===
p.x&&m.y===p.y)||c.set(p.x*i[1]+p.y,[p.x,p.y]);c.size&&this.session.act({type:"walls",cells:[...c.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"sensor",op:"move",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?hi(o,n.walls):"world"in e?e.world:fi(o,n.walls,e.near);s?o.sensors.length>=_e.sensors?n.say(`There can be ${_e.sensors}\
 sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"sensor",op:"add",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=Math.
max(0,...o.sensors.map(r=>r.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sen\
sor",op:"remove",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=lo(e,n.document.grid),s=this.isWall(o);return!s&&Rn(o,n.shape)?(n.status.
text.startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var zt=new Set(["pan","path","look"]),Sc=120,Oo=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&
Rn(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.
cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspec\
t",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},Sc))}};var je={left:36,right:12,top:34,bottom:26},Mc=60,Tc=160,On=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-je.left-je.right,y:this.height-je.
top-je.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:je.left+(o.x-
s*e)/2,y:je.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n])}zoom(e,n,o){let{scale:s}=this.transform,{x:r,y:i}=this.corner,a=he(s*e,Math.min(this.width,this.height)/
Math.max(...o)/3,Tc),c=a/s;this.transform.scale=a,this.corner={x:n.x-c*(n.x-r),y:n.y-c*(n.y-i)},this.fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.
y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;
return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=Mc;this.corner.x=he(this.corner.x,s-e*o,this.width-s),this.corner.y=he(this.corner.y,
s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var xi=[["D, E, S, P","draw, erase, sensor, pan"],["G, L","path, look next"],["arrows","move the cursor, the sensor or the view; with Shift by five cells"],["Sp\
ace","draw or erase at the cursor; next sensor; start or goal of a path"],["[ and ]","turn the sensor"],["A, Delete","add, remove a sensor"],["R, Escape","run, \
cancel"],["M, N, H","show the mean, a draw, the entropy"],["Ctrl+Z, Ctrl+Y","undo, redo"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],Pc={ArrowLeft:[
-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},yi=Math.PI/12,Fo=class{constructor(e,n,o,s,r){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=
r;e.addEventListener("keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,s.setCursor(null)})}focus(){this.
canvas.focus({preventScroll:!0})}key(e){let{session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=Pc[e.key],i=e.shiftKey?5:
1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?yi:-yi;n.editable&&o.sensor&&s.moveSensor(
o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)
s.removeSensor();else if(e.key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.
hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="sensor"&&r.sensor&&o.document&&
o.editable){let{resolution:c}=o.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*c,y:r.sensor.y+n*c})}else if(r.tool==="pan"&&
o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let c=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},p={x:he(c.x+e,0,i-1),y:he(c.y+n,0,a-1)};r.setCursor(
p);let m=s.fromGrid({x:p.x+.5,y:p.y+.5},a),h=(x,b,M)=>x-he(x,b,M),g={x:h(m.x,je.left+10,s.width-20),y:h(m.y,20,s.height-je.bottom-10)};(g.x||g.y)&&s.pan(-g.x,-g.
y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if(o.tool==="path"&&n.document){o.cursor?n.decisions.point(Nn(o.cursor,n.document.grid)):this.arrow(0,0);
return}if(n.editable){if(o.tool==="sensor"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,r.length)]?.id??null),
o.selected!==null&&o.announce(`Sensor ${o.selected}`)}else if(o.tool!=="pan"){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&!s.isWall(r);s.setWalls(
[r],i,o.nextGesture(),e),o.announce(i?"wall":"free")}}}},Hs={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look"},bi={m:"mean",n:"draw",h:"entropy"},wi={"+":"\
in","=":"in","-":"out",0:"fit","?":"help"};function vi(t,e,n){let o=t.composedPath()[0],s=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.
test(o.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?
"redo":"undo"});return}if(!(s||t.altKey)){if(Hs[r]&&(e.editable||zt.has(Hs[r])&&!e.recorded))n.tool(Hs[r]);else if(bi[r])n.layer(bi[r]);else if(wi[t.key])n.command(
wi[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&(e.running||e.sampling))e.act({type:"cancel"});else return;t.preventDefault()}}var Ws='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Fn(t,e,n,o,s,r,i=!1){t.font=Ws,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}function Gs({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Io(t,e,n){let o=n.fromGrid(Kt(t,e),e.shape[1]),s=he(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function ki(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=Gs(e);t.lineJoin=
"round";for(let a of i){let c=Io(a,s.grid,n),{point:p,size:m}=c;a.id===o.selected&&Ec(t,c,o);let[h,g]=[Math.cos(a.yaw),-Math.sin(a.yaw)],x=(b,M)=>[p.x+m*(b*h-M*
g),p.y+m*(b*g+M*h)];t.beginPath(),t.moveTo(...x(1.25,0)),t.lineTo(...x(-.9,.8)),t.lineTo(...x(-.45,0)),t.lineTo(...x(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Fn(t,String(a.id),p.x,p.y+m*2+4,r,"center",!0)}}function Ec(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),t.strokeStyle=s.halo,t.lineWidth=4,t.stroke(),t.strokeStyle=s.sensor,t.lineWidth=1.5,t.stroke(),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=
s.halo,t.fill()}var Si={touch:24,other:11},Ac=5,Cc=90,Uo=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(c,p)=>e.
addEventListener(c,p,{passive:!1});a("pointerdown",c=>this.down(c)),a("pointermove",c=>this.move(c)),a("pointerup",c=>this.up(c)),a("pointercancel",c=>this.up(c)),
a("pointerleave",()=>s.point(null)),a("wheel",c=>this.wheel(c)),a("contextmenu",c=>c.preventDefault())}fingers=new Map;gesture=null;at(e){let n=this.canvas.getBoundingClientRect();
return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){
return Vs(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,{document:s}=n;if(!s)return;e.preventDefault(),
this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(e.pointerId);let r=this.at(e);if(this.fingers.
set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;if(e.button===0&&(o.tool==="path"||o.tool==="\
look"))return this.begin({kind:"pick",first:r});if(e.button===1||zt.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let i=this.gripAt(r,e,s);if(i)
this.begin(i),i.kind==="sensor"&&o.select(i.id);else if(o.tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.
id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),grip:{x:0,y:0}}),this.dragSensor(e));else{let a=o.tool==="draw"!==(e.button===2||e.shiftKey),c=this.
cellAt(r),p=a&&this.editor.isWall(c);this.begin({kind:"stroke",id:o.nextGesture(),wall:a,last:c,held:e,onWall:p}),e.pointerType!=="touch"?this.release():setTimeout(
()=>this.release(),Cc)}}gripAt(e,n,o){let{hand:s,view:r}=this,i=n.pointerType==="touch"?Si.touch:Si.other,a=g=>Math.hypot(e.x-g.x,e.y-g.y),c=s.tool==="sensor"&&
s.sensor?Io(s.sensor,o.grid,r):null;if(c&&s.sensor&&a(c.handle)<Math.min(i,a(c.point)))return{kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||
s.tool==="erase")return null;let p=o.sensors.map(g=>({id:g.id,...Io(g,o.grid,r)}));p.sort((g,x)=>a(g.point)-a(x.point));let m=p.find(({point:g,size:x})=>a(g)<Math.
max(i,x));if(!m)return null;let h={x:m.point.x-e.x,y:m.point.y-e.y};return{kind:"sensor",id:m.id,drag:s.nextGesture(),grip:h}}release(){if(this.gesture?.kind!==
"stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,
i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.cellAt(i));else if(n.kind==="stroke"){this.release();let a=[],c=e.
getCoalescedEvents?.()??[];for(let p of c.length?c:[e]){let m=this.cellAt(this.at(p));(m.x!==n.last.x||m.y!==n.last.y)&&(n.onWall=!1),a.push(...pi(n.last,m)),n.
last=m}this.stroke(a,e),r.point(n.last)}else if(n.kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(p=>p.id===n.id);if(!a||
!o.document)return;let c=this.metres(i,o.document);this.editor.moveSensor(a,{yaw:Math.atan2(c.y-a.y,c.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.
first.x,i.y-n.first.y)>Ac&&this.begin({kind:"pan",last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.
size===2){let{middle:a,spread:c}=this.spread();s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(c/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:c}),o.
changed()}}up(e){e.type==="pointerup"&&this.release(),e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.
last],!1,this.gesture.id,e),e.type==="pointerup"&&this.gesture?.kind==="pick"&&this.pick(this.gesture.first),this.fingers.delete(e.pointerId),this.fingers.size===
0&&(this.gesture=null,this.hand.busy=!1),e.pointerType==="touch"&&this.hand.point(this.cellAt(this.at(e)))}pick(e){let{session:n,hand:o,editor:s}=this;if(!n.document)
return;let r=this.metres(e,n.document);if(o.tool==="path")return n.decisions.point(r);let i=n.decisions.nearest(r),{views:a}=n.decisions;if(i===null||!a)return;
let[c,p,m]=a.pose.subarray(3*i,3*i+3),h=`${a.nats[i].toFixed(1)} nats`;n.editable?s.addSensor({world:{x:c,y:p},yaw:m}):n.say(`A scan from ${c.toFixed(2)}, ${p.toFixed(
2)} m would tell ${h}`)}spread(){let[e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){
if(!this.session.document)return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.
deltaMode===1?16:1;e.shiftKey?this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),
this.session.shape),this.session.changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level===
"error"&&o.say("Ready"))}dragSensor(e){let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(
c=>c.id===n.id),i=this.at(e),a=this.metres({x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var _c=5,zo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(je.left,0,o.width,o.height-je.bottom),e.clip(),s.hover&&Mi(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&Mi(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function Mi(t,e,n,o,s,r,i){let{scale:a}=o.transform,c=o.fromGrid({x:e.x,y:e.y+1},n),p=Math.max(a,_c),[m,h]=[c.x-(p-a)/2,c.y-(p-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(m,h,p,p),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(m,h,p,p)}var Lc={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Dc={paper:[17,0,-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"\
#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a\
3abb8",ground:"#12151a"},Ho={light:Lc,dark:Dc},Ti="00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Rc([
t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,a]=[o+e/500,o,o-n/200].map((c,p)=>(c>.20689655172413793?c**3:.12841854934601665*(c-.13793103448275862))*s[p]);
return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(c=>{let p=he(c,0,1);return Math.round(255*(p<=
.0031308?12.92*p:1.055*p**(1/2.4)-.055))})}var Vo=(t,e=1)=>[0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),$s=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),Bs=(t,e)=>Rc($s(
t.paper,t.ink,e));function ao(t){let e=Math.min(15,Math.floor(t*16));return $s(Vo(Ti,6*e),Vo(Ti,6*e+6),t*16-e)}function Pi(t,e){let n=new Uint8ClampedArray(2048).
fill(255),[o,s]=[Vo(t.unobserved),Vo(t.unobservedWall)];for(let r=0;r<256;r++)n.set(e?ao(Ro(r/255)):Bs(t,r/255),4*r),n.set($s(o,s,e?0:r/255),4*(r+256));return new Uint32Array(
n.buffer)}var Ei=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var Wo=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let c of this.sheets){let{canvas:p,context:m,layer:h}=c,g=[...a,...h.depends(e)];g.length===c.before.length&&g.every(
(x,b)=>Object.is(x,c.before[b]))||(c.before=g,(p.width!==i.width||p.height!==i.height)&&(Object.assign(p,i),p.style.width=`${i.width/s}px`,p.style.height=`${i.height/
s}px`),m.setTransform(1,0,0,1,0,0),m.clearRect(0,0,p.width,p.height),m.setTransform(s,0,0,s,0,0),m.save(),h.paint(m,e),m.restore(),this.paints[h.name]++)}}};function qt(t,{
session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(i,a,o*r,s*r),t.clip()}var Nc=9,Oc=2.5,In=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}paint(e,n){let{session:o}=n;o.document&&(qt(
e,n),o.decisions.looking&&this.views(e,n),this.path(e,n))}views(e,{session:n,view:o,look:s}){let{views:r}=n.decisions,i=n.document?.grid;if(!r?.nats.length||!i)
return;let[a,c]=[Math.min(...r.nats),Math.max(...r.nats)],p=he(.38*r.spacing*o.transform.scale/i.resolution,Oc,Nc),m=r.nats.indexOf(c);for(let h=0;h<r.nats.length;h++){
let g=o.fromGrid(Kt({x:r.pose[3*h],y:r.pose[3*h+1]},i),i.shape[1]);e.beginPath(),e.arc(g.x,g.y,p,0,2*Math.PI),e.fillStyle=`rgb(${ao(he((r.nats[h]-a)/Math.max(c-
a,1e-9),0,1)).map(Math.round)})`,e.fill(),h===m&&(e.lineWidth=2.5,e.strokeStyle=s.theme.truth,e.stroke())}}path(e,{session:n,view:o,look:s}){let{start:r,goal:i,
path:a,radius:c}=n.decisions,p=n.document?.grid;if(!p||!r)return;let m=h=>o.fromGrid(Kt(h,p),p.shape[1]);if(a){e.beginPath();for(let[h,g]of a.path){let x=m({x:h,
y:g});e.lineTo(x.x,x.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=a.within_risk?s.theme.sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*c*o.transform.scale/
p.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let h of i?[r,i]:[r]){let{x:g,y:x}=m(h);e.beginPath(),e.arc(g,x,5,0,2*Math.PI),e.fillStyle=
h===r?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}}};var Fc=10,Ic=7,Go=()=>document.createElement("canvas").getContext("2d"),Un=class{name="field";cells=Go();mask=Go();hatch=Go();palettes=new Map;image=new ImageData(
1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.shown,e.view.layer==="entropy",...e.shape,e.document===null]}paint(e,n){let{
session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:c,x:p,y:m}=s.transform;qt(e,n);let h=o.shown;if(!h||h.p.length!==i*a){e.fillStyle=r.theme.
unobserved,e.fillRect(p,m,i*c,a*c);return}this.fill(h,i,a,r.theme,o.view.layer==="entropy"&&h.layer!=="draw"),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.
canvas,p,m,i*c,a*c),this.fillHatch(n),e.drawImage(this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),c>=Fc&&this.lines(e,n)}fill(e,n,o,s,r){
let{cells:i,mask:a,drawn:c}=this,p=`${s.ground} ${r}`;if(c.field===e&&c.palette===p)return;let m=this.palettes.get(p)??Pi(s,r);if(this.palettes.set(p,m),this.image.
width!==n||this.image.height!==o){this.image=new ImageData(n,o);for(let{canvas:g}of[i,a])Object.assign(g,{width:n,height:o});c.bits=null}let h=new Uint32Array(this.
image.data.buffer);for(let g=0,x=0;g<o;g++)for(let b=o-1-g;b<n*o;b+=o)h[x++]=m[e.p[b]+(e.observed[b]?0:256)];if(i.putImageData(this.image,0,0),c.bits!==e.bits){
for(let g=0,x=0;g<o;g++)for(let b=o-1-g;b<n*o;b+=o)h[x++]=e.observed[b]?0:4278190080;a.putImageData(this.image,0,0),c.hatch=""}Object.assign(c,{field:e,bits:e.bits,
palette:p})}fillHatch({session:e,view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:c,height:p}=n,{scale:m,x:h,y:g}=n.transform,[x,b]=e.shape,M=[o.
theme.ground,m,h,g,c,p,a].join(" ");if(i.hatch===M)return;i.hatch=M;let A=Go(),L=A.canvas.width=A.canvas.height=Math.round(Ic*a);A.strokeStyle=o.theme.hatch,A.lineWidth=
a,A.beginPath();for(let _ of[-L,0,L])A.moveTo(_-1,L+1),A.lineTo(_+L+1,-1);A.stroke(),Object.assign(s.canvas,{width:Math.ceil(c*a),height:Math.ceil(p*a)}),s.setTransform(
a,0,0,a,0,0),s.imageSmoothingEnabled=!1,s.drawImage(r.canvas,h,g,x*m,b*m),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let S=s.createPattern(
A.canvas,"repeat");S.setTransform(new DOMMatrix().translate(Math.round(h*a),Math.round(g*a))),s.fillStyle=S,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{
session:n,view:o,look:s}){let[r,i]=n.shape,{scale:a,x:c,y:p}=o.transform;e.beginPath();for(let m=1;m<r;m++)e.moveTo(c+m*a,p),e.lineTo(c+m*a,p+i*a);for(let m=1;m<
i;m++)e.moveTo(c,p+m*a),e.lineTo(c+r*a,p+m*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var Uc=46;function zc(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function Ai(t,{session:e,view:n,look:o}){if(!e.document)return;
let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:c,shape:p}=e.document.grid,{scale:m,x:h,y:g}=n.transform,x=zc(Uc/m*c),b=Math.min(g+p[1]*m,i-je.bottom)+
.5,M=Math.max(h,je.left)-.5;t.fillStyle=s.ground,h<M&&t.fillRect(0,0,M,i+1),g+p[1]*m>b&&t.fillRect(0,b,r+1,i+1-b);let A=Math.max(0,-Math.floor(Math.log10(x)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let L=_=>Math.ceil(a[_]/x-1e-9)*x,S=_=>a[_]+p[_]*c+1e-9;for(let _=L(0);_<=S(0);_+=x){let T=h+(_-a[0])/c*m;T<M||
T>r-4||(t.moveTo(T,b),t.lineTo(T,b+4),Fn(t,_.toFixed(A),T,b+12,s,"center"))}for(let _=L(1);_<=S(1);_+=x){let T=g+(p[1]-(_-a[1])/c)*m;T>b||T<4||(t.moveTo(M,T),t.
lineTo(M-4,T),Fn(t,_.toFixed(A),M-7,T,s,"right"))}t.stroke(),Fn(t,"m",M-7,b+12,s,"right")}var zn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=Gs(e).flatMap(({id:i,x:a,y:c,yaw:p})=>[i,a,c,p]),{grid:s}=e.document??{},
r=Ci(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:c,x:p,y:m}=s.transform;r.truth&&Ci(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,e.lineWidth=1,e.strokeRect(p-.5,m-.5,i*c+1,a*c+
1),ki(e,n),Ai(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:c}=s.transform;this.edgesOf!==o.wallsVersion&&(this.edges=di(o.walls,o.shape),this.edgesOf=
o.wallsVersion),e.save(),qt(e,n),e.transform(i,0,0,-i,a,c+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,e.lineWidth=he(i*.09,1,2.5)/i,e.stroke(this.
edges),e.restore()}},Ci=({document:t})=>t?.source.kind==="simulation";var Vc=600,Vn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings]}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,
document:a}=o;if(!i||!a||!(r.rays||r.readings))return;qt(e,n);let{scale:c}=s.transform,p=1/a.grid.resolution,m=a.grid.shape[1],h=i.angles.length,g=i.pose.length/
3,[x,b,M]=[new Path2D,new Path2D,new Path2D],A=he(c*.1,1.3,4);for(let L=0;L<g;L++){let[S,_,T]=i.pose.subarray(3*L,3*L+3),j=s.fromGrid(Kt({x:S,y:_},a.grid),m);for(let D=0;D<
h;D++){let Z=i.ranges[L*h+D],G=i.hit[L*h+D]===1,R=(G?Z:a.max_range)*p*c,V=i.angles[D]+T,E={x:j.x+R*Math.cos(V),y:j.y-R*Math.sin(V)},q=G?x:b;q.moveTo(j.x,j.y),q.
lineTo(E.x,E.y),G&&(h*g>Vc?M.rect(E.x-.9*A,E.y-.9*A,1.8*A,1.8*A):(M.moveTo(E.x+A,E.y),M.arc(E.x,E.y,A,0,2*Math.PI)))}}r.rays&&(e.lineWidth=1,e.globalAlpha=he(28/
Math.sqrt(h*g)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(x),e.strokeStyle=r.theme.noReturn,e.stroke(b),e.globalAlpha=1),r.readings&&(e.fillStyle=r.theme.ray,
e.fill(M))}};var _i=900,co=2;function Li({session:t,look:e}){let[n,o]=t.shape,s=new On;s.resize(_i,Math.round(he(_i*o/n,300,1800)),co),s.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:s.width*co,height:s.height*co});let i=r.getContext("2d");i.scale(co,co),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);
let a=[new Un,new Vn,new zn,new In];for(let c of a)i.save(),c.paint(i,{session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}}),i.restore();return new Promise(
c=>r.toBlob(c))}function k(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function z(t,e,n){t[e]!==n&&(t[e]=n)}function Mt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var uo=t=>t.getRootNode().activeElement===t,yt=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function js(t,e){let n=URL.
createObjectURL(e);k("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Hc=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["path","Path","path"],["look","Look next","look"]];function Di(t){
let{hand:e,session:n}=t,o=t.segmented("Tool",Hc,()=>n.editable||!n.document||zt.has(e.tool)?e.tool:"pan",s=>e.choose(s),s=>n.editable||zt.has(s)&&!n.recorded||s===
"pan");return t.visible(o,()=>!n.recorded),k("div",{className:"bar"},o,k("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zo\
om out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Wc="uplot",Gc="u-hz",$c="u-vt",Bc="u-title",jc="u-wrap",Kc="u-under",qc="u-over",Yc="u-axis",pn="u-off",Jc="u-select",Zc="u-cursor-x",Qc="u-cursor-y",Xc="u-\
cursor-pt",eu="u-legend",tu="u-live",nu="u-inline",ou="u-series",su="u-marker",Ri="u-label",ru="u-value",fo="width",ho="height";var Ni="bottom",Hn="left",Ks="right",ur="#000",Oi=ur+"0",qs="mousemove",Fi="mousedown",Ys="mouseup",Ii="mouseenter",Ui="mouseleave",zi="dblclick",iu="resize",lu="\
scroll",Vi="change",qo="dppxchange",pr="--",qn=typeof window<"u",er=qn?document:null,Gn=qn?window:null,au=qn?navigator:null,pe,$o;function tr(){let t=devicePixelRatio;
pe!=t&&(pe=t,$o&&or(Vi,$o,tr),$o=matchMedia(`(min-resolution: ${pe-.001}dppx) and (max-resolution: ${pe+.001}dppx)`),dn(Vi,$o,tr),Gn.dispatchEvent(new CustomEvent(
qo)))}function at(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function nr(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Se(t,e,n){
t.style[e]=n+"px"}function Tt(t,e,n,o){let s=er.createElement(t);return e!=null&&at(s,e),n?.insertBefore(s,o),s}function bt(t,e){return Tt("div",t,e)}var Hi=new WeakMap;
function Nt(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=Hi.get(t);r!=i&&(t.style.transform=r,Hi.set(t,r),e<0||n<0||e>o||n>s?at(t,pn):nr(t,pn))}var Wi=new WeakMap;
function Gi(t,e,n){let o=e+n,s=Wi.get(t);o!=s&&(Wi.set(t,o),t.style.background=e,t.style.borderColor=n)}var $i=new WeakMap;function Bi(t,e,n,o){let s=e+""+n,r=$i.
get(t);s!=r&&($i.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var dr={passive:!0},cu={...dr,
capture:!0};function dn(t,e,n,o){e.addEventListener(t,n,o?cu:dr)}function or(t,e,n,o){e.removeEventListener(t,n,dr)}qn&&tr();function Pt(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:ct((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function wl(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var xl=t=>t!=null,vl=t=>t!=null&&t>0,Zo=wl(xl),uu=wl(vl);function pu(t,e,n,o=0,s=!1){
let r=s?uu:Zo,i=s?vl:xl;[e,n]=r(t,e,n);let a=t[e],c=t[e];if(e>-1)if(o==1)a=t[e],c=t[n];else if(o==-1)a=t[n],c=t[e];else for(let p=e;p<=n;p++){let m=t[p];i(m)&&(m<
a?a=m:m>c&&(c=m))}return[a??ye,c??-ye]}function Qo(t,e,n,o){let s=qi(t),r=qi(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Vt:kl,a=s==1?ct:wt,c=r==1?wt:ct,
p=a(i(Oe(t))),m=c(i(Oe(e))),h=$n(n,p),g=$n(n,m);return n==10&&(p<0&&(h=be(h,-p)),m<0&&(g=be(g,-m))),o||n==2?(t=h*s,e=g*r):(t=Pl(t,h),e=Xo(e,g)),[t,e]}function fr(t,e,n,o){
let s=Qo(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var hr=.1,ji={mode:3,pad:hr},go={pad:0,soft:null,mode:0},du={min:go,max:go};function Yo(t,e,n,o){return es(
n)?Ki(t,e,n):(go.pad=n,go.soft=o?0:null,go.mode=o?3:0,Ki(t,e,du))}function ae(t,e){return t??e}function fu(t,e,n){for(e=ae(e,0),n=ae(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Ki(t,e,n){let o=n.min,s=n.max,r=ae(o.pad,0),i=ae(s.pad,0),a=ae(o.hard,-ye),c=ae(s.hard,ye),p=ae(o.soft,ye),m=ae(s.soft,-ye),
h=ae(o.mode,0),g=ae(s.mode,0),x=e-t,b=Vt(x),M=Xe(Oe(t),Oe(e)),A=Vt(M),L=Oe(A-b);(x<1e-24||L>10)&&(x=0,(t==0||e==0)&&(x=1e-24,h==2&&p!=ye&&(r=0),g==2&&m!=-ye&&(i=
0)));let S=x||M||1e3,_=Vt(S),T=$n(10,ct(_)),j=S*(x==0?t==0?.1:1:r),D=be(Pl(t-j,T/10),24),Z=t>=p&&(h==1||h==3&&D<=p||h==2&&D>=p)?p:ye,G=Xe(a,D<Z&&t>=Z?Z:Et(Z,D)),
R=S*(x==0?e==0?.1:1:i),V=be(Xo(e+R,T/10),24),E=e<=m&&(g==1||g==3&&V>=m||g==2&&V<=m)?m:-ye,q=Et(c,V>E&&e<=E?E:Xe(E,V));return G==q&&G==0&&(q=100),[G,q]}var hu=new Intl.
NumberFormat(qn?au.language:"en-US"),mr=t=>hu.format(t),ut=Math,Ko=ut.PI,Oe=ut.abs,ct=ut.floor,Ne=ut.round,wt=ut.ceil,Et=ut.min,Xe=ut.max,$n=ut.pow,qi=ut.sign,Vt=ut.
log10,kl=ut.log2,mu=(t,e=1)=>ut.sinh(t)*e,Js=(t,e=1)=>ut.asinh(t/e),ye=1/0;function Yi(t){return(Vt((t^t>>31)-(t>>31))|0)+1}function sr(t,e,n){return Et(Xe(t,e),
n)}function Sl(t){return typeof t=="function"}function re(t){return Sl(t)?t:()=>t}var gu=()=>{},Ml=t=>t,Tl=(t,e)=>e,yu=t=>null,Ji=t=>!0,Zi=(t,e)=>t==e,bu=/\.\d*?(?=9{6,}|0{6,})/gm,
fn=t=>{if(Al(t)||Jt.has(t))return t;let e=`${t}`,n=e.match(bu);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${fn(
s)}e${r}`}return be(t,o)};function cn(t,e){return fn(be(fn(t/e))*e)}function Xo(t,e){return fn(wt(fn(t/e))*e)}function Pl(t,e){return fn(ct(fn(t/e))*e)}function be(t,e=0){
if(Al(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Ne(o)/n}var Jt=new Map;function El(t){return((""+t).split(".")[1]||"").length}function bo(t,e,n,o){
let s=[],r=o.map(El);for(let i=e;i<n;i++){let a=Oe(i),c=be($n(t,i),a);for(let p=0;p<o.length;p++){let m=t==10?+`${o[p]}e${i}`:o[p]*c,h=(i>=0?0:a)+(i>=r[p]?0:r[p]),
g=t==10?m:be(m,h);s.push(g),Jt.set(g,h)}}return s}var yo={},gr=[],Bn=[null,null],Yt=Array.isArray,Al=Number.isInteger,wu=t=>t===void 0;function Qi(t){return typeof t==
"string"}function es(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function xu(t){return t!=null&&typeof t=="object"}var vu=Object.getPrototypeOf(
Uint8Array),Cl="__proto__";function jn(t,e=es){let n;if(Yt(t)){let o=t.find(s=>s!=null);if(Yt(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=jn(t[s],
e)}else n=t.slice()}else if(t instanceof vu)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Cl&&(n[o]=jn(t[o],e))}else n=t;return n}function Le(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=Cl&&(es(t[s])?Le(t[s],jn(o[s])):t[s]=jn(o[s]))}return t}var ku=0,Su=1,Mu=2;function Tu(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function Pu(t,e){if(Cu(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return _u(i[0])||(i=Au(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let c=t[i][0],p=c.length;for(let m=0;m<
p;m++)n.add(c[m])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],c=a[0];
for(let p=1;p<a.length;p++){let m=a[p],h=Array(s).fill(void 0),g=e?e[i][p]:Su,x=[];for(let b=0;b<m.length;b++){let M=m[b],A=r.get(c[b]);M===null?g!=ku&&(h[A]=M,
g==Mu&&x.push(A)):h[A]=M}Tu(h,x,s),o.push(h)}}return o}var Eu=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Au(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let c=0;c<n;c++)a[c]=
i[o[c]];s.push(a)}return s}function Cu(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function _u(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=Xe(1,ct((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let c=t[a];if(c!=null){if(c<=i)return!1;i=c}}return!0}var _l=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Ll=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Dl(t){
return t.slice(0,3)}var Lu=Ll.map(Dl),Du=_l.map(Dl),Ru={MMMM:_l,MMM:Du,WWWW:Ll,WWW:Lu};function po(t){return(t<10?"0":"")+t}function Nu(t){return(t<10?"00":t<100?
"0":"")+t}var Ou={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>po(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>po(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>po(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>po(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>po(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Nu(t.getMilliseconds())};function yr(t,e){e=e||Ru;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?Ou[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var Fu=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function Iu(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Fu?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var Rl=t=>t%1==0,Jo=[1,2,2.5,5],Uu=bo(10,-32,0,Jo),Nl=bo(10,0,32,Jo),zu=Nl.filter(
Rl),un=Uu.concat(Nl),br=`
`,Ol="{YYYY}",Xi=br+Ol,Fl="{M}/{D}",mo=br+Fl,Bo=mo+"/{YY}",Il="{aa}",Vu="{h}:{mm}",Wn=Vu+Il,el=br+Wn,tl=":{ss}",de=null;function Ul(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,c=(t==1?bo(10,0,3,Jo).filter(Rl):bo(10,-3,0,Jo)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),p=[[i,Ol,de,de,de,de,de,de,1],[s*28,"{MMM}",Xi,de,de,de,de,de,1],[s,Fl,Xi,de,
de,de,de,de,1],[o,"{h}"+Il,Bo,de,mo,de,de,de,1],[n,Wn,Bo,de,mo,de,de,de,1],[e,tl,Bo+" "+Wn,de,mo+" "+Wn,de,el,de,1],[t,tl+".{fff}",Bo+" "+Wn,de,mo+" "+Wn,de,el,
de,1]];function m(h){return(g,x,b,M,A,L)=>{let S=[],_=A>=i,T=A>=r&&A<i,j=h(b),D=be(j*t,3),Z=Zs(j.getFullYear(),_?0:j.getMonth(),T||_?1:j.getDate()),G=be(Z*t,3);
if(T||_){let R=T?A/r:0,V=_?A/i:0,E=D==G?D:be(Zs(Z.getFullYear()+V,Z.getMonth()+R,1)*t,3),q=new Date(Ne(E/t)),U=q.getFullYear(),K=q.getMonth();for(let W=0;E<=M;W++){
let ne=Zs(U+V*W,K+R*W,1),$=ne-h(be(ne*t,3));E=be((+ne+$)*t,3),E<=M&&S.push(E)}}else{let R=A>=s?s:A,V=ct(b)-ct(D),E=G+V+Xo(D-G,R);S.push(E);let q=h(E),U=q.getHours()+
q.getMinutes()/n+q.getSeconds()/o,K=A/o,W=g.axes[x]._space,ne=L/W;for(;E=be(E+A,t==1?0:3),!(E>M);)if(K>1){let $=ct(be(U+K,6))%24,se=h(E).getHours()-$;se>1&&(se=
-1),E-=se*o,U=(U+K)%24;let ce=S[S.length-1];be((E-ce)/A,3)*ne>=.7&&S.push(E)}else S.push(E)}return S}}return[c,p,m]}var[Hu,Wu,Gu]=Ul(1),[$u,Bu,ju]=Ul(.001);bo(2,
-53,53,[1]);function nl(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function ol(t,e){return(n,o,s,r,i)=>{let a=e.find(b=>i>=
b[0])||e[e.length-1],c,p,m,h,g,x;return o.map(b=>{let M=t(b),A=M.getFullYear(),L=M.getMonth(),S=M.getDate(),_=M.getHours(),T=M.getMinutes(),j=M.getSeconds(),D=A!=
c&&a[2]||L!=p&&a[3]||S!=m&&a[4]||_!=h&&a[5]||T!=g&&a[6]||j!=x&&a[7]||a[1];return c=A,p=L,m=S,h=_,g=T,x=j,D(M)})}}function Ku(t,e){let n=yr(e);return(o,s,r,i,a)=>s.
map(c=>n(t(c)))}function Zs(t,e,n){return new Date(t,e,n)}function sl(t,e){return e(t)}var qu="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function rl(t,e){return(n,o,s,r)=>r==
null?pr:e(t(o))}function Yu(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Ju(t,e){return t.series[e].fill(
t,e)}var Zu={show:!0,live:!0,isolate:!1,mount:gu,markers:{show:!0,width:2,stroke:Yu,fill:Ju,dash:"solid"},idx:null,idxs:null,values:[]};function Qu(t,e){let n=t.
cursor.points,o=bt(),s=n.size(t,e);Se(o,fo,s),Se(o,ho,s);let r=s/-2;Se(o,"marginLeft",r),Se(o,"marginTop",r);let i=n.width(t,e,s);return i&&Se(o,"borderWidth",i),
o}function Xu(t,e){let n=t.series[e].points;return n._fill||n._stroke}function ep(t,e){let n=t.series[e].points;return n._stroke||n._fill}function tp(t,e){return t.
series[e].points.size}var Qs=[0,0];function np(t,e,n){return Qs[0]=e,Qs[1]=n,Qs}function jo(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function Xs(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var op={show:!0,x:!0,y:!0,lock:!1,move:np,points:{one:!1,show:Qu,size:tp,width:0,stroke:ep,fill:Xu},bind:{mousedown:jo,mouseup:jo,
click:jo,dblclick:jo,mousemove:Xs,mouseleave:Xs,mouseenter:Xs},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},zl={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},wr=Le({},zl,{filter:Tl}),Vl=Le({},wr,{size:10}),Hl=Le({},zl,{show:!1}),xr='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Wl="bold "+xr,Gl=1.5,il={
show:!0,scale:"x",stroke:ur,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Wl,side:2,grid:wr,ticks:Vl,border:Hl,font:xr,lineGap:Gl,rotate:0},
sp="Value",rp="Time",ll={show:!0,scale:"x",auto:!1,sorted:1,min:ye,max:-ye,idxs:[]};function ip(t,e,n,o,s){return e.map(r=>r==null?"":mr(r))}function lp(t,e,n,o,s,r,i){
let a=[],c=Jt.get(s)||0;n=i?n:be(Xo(n,s),c);for(let p=n;p<=o;p=be(p+s,c))a.push(Object.is(p,-0)?0:p);return a}function rr(t,e,n,o,s,r,i){let a=[],c=t.scales[t.axes[e].
scale].log,p=c==10?Vt:kl,m=ct(p(n));s=$n(c,m),c==10&&(s=un[Pt(s,un)]);let h=n,g=s*c;c==10&&(g=un[Pt(g,un)]);do a.push(h),h=h+s,c==10&&!Jt.has(h)&&(h=be(h,Jt.get(
s))),h>=g&&(s=h,g=s*c,c==10&&(g=un[Pt(g,un)]));while(h<=o);return a}function ap(t,e,n,o,s,r,i){let c=t.scales[t.axes[e].scale].asinh,p=o>c?rr(t,e,Xe(c,n),o,s):[
c],m=o>=0&&n<=0?[0]:[];return(n<-c?rr(t,e,Xe(c,-o),-n,s):[c]).reverse().map(g=>-g).concat(m,p)}var $l=/./,cp=/[12357]/,up=/[125]/,al=/1/,ir=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function pp(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],c=t.valToPos,p=r._space,m=c(10,i),h=c(
9,i)-m>=p?$l:c(7,i)-m>=p?cp:c(5,i)-m>=p?up:al;if(h==al){let g=Oe(c(1,i)-m);if(g<p)return ir(e.slice().reverse(),a.distr,h,wt(p/g)).reverse()}return ir(e,a.distr,
h,1)}function dp(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,c=t.valToPos,p=Oe(c(1,i)-c(2,i));return p<a?ir(e.slice().reverse(),3,$l,wt(a/p)).reverse():e}function fp(t,e,n,o){
return o==null?pr:e==null?"":mr(e)}var cl={show:!0,scale:"y",stroke:ur,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Wl,side:3,grid:wr,ticks:Vl,
border:Hl,font:xr,lineGap:Gl,rotate:0};function hp(t,e){let n=3+(t||1)*2;return be(n*e,3)}function mp(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Oe(i-r),c=t.series[e],p=a/(c.points.space*pe);return o[1]-o[0]<=p}var ul={scale:null,auto:!0,sorted:0,min:ye,max:-ye},
Bl=(t,e,n,o,s)=>s,pl={show:!0,auto:!0,sorted:0,gaps:Bl,alpha:1,facets:[Le({},ul,{scale:"x"}),Le({},ul,{scale:"y"})]},dl={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Bl,alpha:1,points:{show:mp,filter:null},values:null,min:ye,max:-ye,idxs:[],path:null,clip:null};function gp(t,e,n,o,s){return n/10}var jl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},yp=Le({},jl,{time:!1,ori:1}),fl={};function Kl(t,e){let n=fl[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,c,p){for(let m=0;m<n.plots.length;m++)n.plots[m]!=s&&n.plots[m].pub(o,s,r,i,a,c,p)}},t!=null&&(fl[t]=
n)),n}var Kn=1,lr=2;function hn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,c=r[0],p=o==2?r[1]:r[e],m=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],h=o==2?i[s.facets[1].scale]:i[s.scale],g=a.left,x=a.top,b=a.width,M=a.height,A=t.valToPosH,L=t.valToPosV;return m.ori==0?n(s,c,p,m,h,A,L,g,
x,b,M,ns,Yn,ss,Yl,Zl):n(s,c,p,m,h,L,A,x,g,M,b,os,Jn,Sr,Jl,Ql)}function vr(t,e){let n=0,o=0,s=ae(t.bands,gr);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function bp(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
c=t.scales[a];return s==-1?c.min:s==1?c.max:c.distr==3?c.dir==1?c.min:c.max:0}function Ht(t,e,n,o,s,r){return hn(t,e,(i,a,c,p,m,h,g,x,b,M,A)=>{let L=i.pxRound,S=p.
dir*(p.ori==0?1:-1),_=p.ori==0?Yn:Jn,T,j;S==1?(T=n,j=o):(T=o,j=n);let D=L(h(a[T],p,M,x)),Z=L(g(c[T],m,A,b)),G=L(h(a[j],p,M,x)),R=L(g(r==1?m.max:m.min,m,A,b)),V=new Path2D(
s);return _(V,G,R),_(V,D,R),_(V,D,Z),V})}function ts(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?ss:Sr,c=n;for(let h=0;h<t.length;h++){let g=t[h];
if(g[1]>g[0]){let x=g[0]-c;x>0&&a(i,c,o,x,o+r),c=g[1]}}let p=n+s-c,m=10;p>0&&a(i,c,o-m/2,p,o+r+m)}return i}function wp(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function kr(t,e,n,o,s,r,i){let a=[],c=t.length;for(let p=s==1?n:o;p>=n&&p<=o;p+=s)if(e[p]===null){let h=p,g=p;if(s==1)for(;++p<=o&&e[p]===null;)
g=p;else for(;--p>=n&&e[p]===null;)g=p;let x=r(t[h]),b=g==h?x:r(t[g]),M=h-s;x=i<=0&&M>=0&&M<c?r(t[M]):x;let L=g+s;b=i>=0&&L>=0&&L<c?r(t[L]):b,b>=x&&a.push([x,b])}
return a}function hl(t){return t==0?Ml:t==1?Ne:e=>cn(e,t)}function ql(t){let e=t==0?ns:os,n=t==0?(s,r,i,a,c,p)=>{s.arcTo(r,i,a,c,p)}:(s,r,i,a,c,p)=>{s.arcTo(i,r,
c,a,p)},o=t==0?(s,r,i,a,c)=>{s.rect(r,i,a,c)}:(s,r,i,a,c)=>{s.rect(i,r,c,a)};return(s,r,i,a,c,p=0,m=0)=>{p==0&&m==0?o(s,r,i,a,c):(p=Et(p,a/2,c/2),m=Et(m,a/2,c/2),
e(s,r+p,i),n(s,r+a,i,r+a,i+c,p),n(s,r+a,i+c,r,i+c,m),n(s,r,i+c,r,i,m),n(s,r,i,r+a,i,p),s.closePath())}}var ns=(t,e,n)=>{t.moveTo(e,n)},os=(t,e,n)=>{t.moveTo(n,e)},
Yn=(t,e,n)=>{t.lineTo(e,n)},Jn=(t,e,n)=>{t.lineTo(n,e)},ss=ql(0),Sr=ql(1),Yl=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},Jl=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},Zl=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},Ql=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function Xl(t){return(e,n,o,s,r)=>hn(e,n,(i,a,c,p,m,h,g,x,b,M,A)=>{let{pxRound:L,
points:S}=i,_,T;p.ori==0?(_=ns,T=Yl):(_=os,T=Jl);let j=be(S.width*pe,3),D=(S.size-S.width)/2*pe,Z=be(D*2,3),G=new Path2D,R=new Path2D,{left:V,top:E,width:q,height:U}=e.
bbox;ss(R,V-Z,E-Z,q+Z*2,U+Z*2);let K=W=>{if(c[W]!=null){let ne=L(h(a[W],p,M,x)),$=L(g(c[W],m,A,b));_(G,ne+D,$),T(G,ne,$,D,0,Ko*2)}};if(r)r.forEach(K);else for(let W=o;W<=
s;W++)K(W);return{stroke:j>0?G:null,fill:G,clip:R,flags:Kn|lr}})}function ea(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var xp=ea(Yn),vp=ea(Jn);function ta(t){let e=ae(t?.alignGaps,0);return(n,o,s,r)=>hn(n,o,(i,a,c,p,m,h,g,x,b,M,A)=>{[s,r]=Zo(c,s,r);let L=i.pxRound,S=U=>L(h(U,p,M,
x)),_=U=>L(g(U,m,A,b)),T,j;p.ori==0?(T=Yn,j=xp):(T=Jn,j=vp);let D=p.dir*(p.ori==0?1:-1),Z={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Kn},G=Z.
stroke,R=!1;if(r-s>=M*4){let U=H=>n.posToVal(H,p.key,!0),K=null,W=null,ne,$,Ke,me=S(a[D==1?s:r]),se=S(a[s]),ce=S(a[r]),X=U(D==1?se+1:ce-1);for(let H=D==1?s:r;H>=
s&&H<=r;H+=D){let Pe=a[H],ge=(D==1?Pe<X:Pe>X)?me:S(Pe),ie=c[H];ge==me?ie!=null?($=ie,K==null?(T(G,ge,_($)),ne=K=W=$):$<K?K=$:$>W&&(W=$)):ie===null&&(R=!0):(K!=null&&
j(G,me,_(K),_(W),_(ne),_($)),ie!=null?($=ie,T(G,ge,_($)),K=W=ne=$):(K=W=null,ie===null&&(R=!0)),me=ge,X=U(me+D))}K!=null&&K!=W&&Ke!=me&&j(G,me,_(K),_(W),_(ne),_(
$))}else for(let U=D==1?s:r;U>=s&&U<=r;U+=D){let K=c[U];K===null?R=!0:K!=null&&T(G,S(a[U]),_(K))}let[E,q]=vr(n,o);if(i.fill!=null||E!=0){let U=Z.fill=new Path2D(
G),K=i.fillTo(n,o,i.min,i.max,E),W=_(K),ne=S(a[s]),$=S(a[r]);D==-1&&([$,ne]=[ne,$]),T(U,$,W),T(U,ne,W)}if(!i.spanGaps){let U=[];R&&U.push(...kr(a,c,s,r,D,S,e)),
Z.gaps=U=i.gaps(n,o,s,r,U),Z.clip=ts(U,p.ori,x,b,M,A)}return q!=0&&(Z.band=q==2?[Ht(n,o,s,r,G,-1),Ht(n,o,s,r,G,1)]:Ht(n,o,s,r,G,q)),Z})}function kp(t){let e=ae(
t.align,1),n=ae(t.ascDesc,!1),o=ae(t.alignGaps,0),s=ae(t.extend,!1);return(r,i,a,c)=>hn(r,i,(p,m,h,g,x,b,M,A,L,S,_)=>{[a,c]=Zo(h,a,c);let T=p.pxRound,{left:j,width:D}=r.
bbox,Z=se=>T(b(se,g,S,A)),G=se=>T(M(se,x,_,L)),R=g.ori==0?Yn:Jn,V={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Kn},E=V.stroke,q=g.dir*(g.ori==
0?1:-1),U=G(h[q==1?a:c]),K=Z(m[q==1?a:c]),W=K,ne=K;s&&e==-1&&(ne=j,R(E,ne,U)),R(E,K,U);for(let se=q==1?a:c;se>=a&&se<=c;se+=q){let ce=h[se];if(ce==null)continue;
let X=Z(m[se]),H=G(ce);e==1?R(E,X,U):R(E,W,H),R(E,X,H),U=H,W=X}let $=W;s&&e==1&&($=j+D,R(E,$,U));let[Ke,me]=vr(r,i);if(p.fill!=null||Ke!=0){let se=V.fill=new Path2D(
E),ce=p.fillTo(r,i,p.min,p.max,Ke),X=G(ce);R(se,$,X),R(se,ne,X)}if(!p.spanGaps){let se=[];se.push(...kr(m,h,a,c,q,Z,o));let ce=p.width*pe/2,X=n||e==1?ce:-ce,H=n||
e==-1?-ce:ce;se.forEach(Pe=>{Pe[0]+=X,Pe[1]+=H}),V.gaps=se=p.gaps(r,i,a,c,se),V.clip=ts(se,g.ori,A,L,S,_)}return me!=0&&(V.band=me==2?[Ht(r,i,a,c,E,-1),Ht(r,i,a,
c,E,1)]:Ht(r,i,a,c,E,me)),V})}function ml(t,e,n,o,s,r,i=ye){if(t.length>1){let a=null;for(let c=0,p=1/0;c<t.length;c++)if(e[c]!==void 0){if(a!=null){let m=Oe(t[c]-
t[a]);m<p&&(p=m,i=Oe(n(t[c],o,s,r)-n(t[a],o,s,r)))}a=c}}return i}function Sp(t){t=t||yo;let e=ae(t.size,[.6,ye,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==null?
[0,0]:typeof s=="number"?[s,0]:s;let r=re(s),i=1-e[0],a=ae(e[1],ye),c=ae(e[2],1),p=ae(t.disp,yo),m=ae(t.each,x=>{}),{fill:h,stroke:g}=p;return(x,b,M,A)=>hn(x,b,
(L,S,_,T,j,D,Z,G,R,V,E)=>{let q=L.pxRound,U=n,K=o*pe,W=a*pe,ne=c*pe,$,Ke;T.ori==0?[$,Ke]=r(x,b):[Ke,$]=r(x,b);let me=T.dir*(T.ori==0?1:-1),se=T.ori==0?ss:Sr,ce=T.
ori==0?m:(F,we,Re,yn,en,At,tn)=>{m(F,we,Re,en,yn,tn,At)},X=ae(x.bands,gr).find(F=>F.series[0]==b),H=X!=null?X.dir:0,Pe=L.fillTo(x,b,L.min,L.max,H),Ie=q(Z(Pe,j,E,
R)),ge,ie,pt,et=V,Me=q(L.width*pe),ot=!1,Y=null,te=null,De=null,Ot=null;h!=null&&(Me==0||g!=null)&&(ot=!0,Y=h.values(x,b,M,A),te=new Map,new Set(Y).forEach(F=>{
F!=null&&te.set(F,new Path2D)}),Me>0&&(De=g.values(x,b,M,A),Ot=new Map,new Set(De).forEach(F=>{F!=null&&Ot.set(F,new Path2D)})));let{x0:mn,size:Qn}=p;if(mn!=null&&
Qn!=null){U=1,S=mn.values(x,b,M,A),mn.unit==2&&(S=S.map(Re=>x.posToVal(G+Re*V,T.key,!0)));let F=Qn.values(x,b,M,A);Qn.unit==2?ie=F[0]*V:ie=D(F[0],T,V,G)-D(0,T,V,
G),et=ml(S,_,D,T,V,G,et),pt=et-ie+K}else et=ml(S,_,D,T,V,G,et),pt=et*i+K,ie=et-pt;pt<1&&(pt=0),Me>=ie/2&&(Me=0),pt<5&&(q=Ml);let wo=pt>0,Qt=et-pt-(wo?Me:0);ie=q(
sr(Qt,ne,W)),ge=(U==0?ie/2:U==me?0:ie)-U*me*((U==0?K/2:0)+(wo?Me/2:0));let Ye={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},gn=ot?null:new Path2D,
Ft=null;if(X!=null)Ft=x.data[X.series[1]];else{let{y0:F,y1:we}=p;F!=null&&we!=null&&(_=we.values(x,b,M,A),Ft=F.values(x,b,M,A))}let Xt=$*ie,ee=Ke*ie;for(let F=me==
1?M:A;F>=M&&F<=A;F+=me){let we=_[F];if(we==null)continue;if(Ft!=null){let tt=Ft[F]??0;if(we-tt==0)continue;Ie=Z(tt,j,E,R)}let Re=T.distr!=2||p!=null?S[F]:F,yn=D(
Re,T,V,G),en=Z(ae(we,Pe),j,E,R),At=q(yn-ge),tn=q(Xe(en,Ie)),st=q(Et(en,Ie)),dt=tn-st;if(we!=null){let tt=we<0?ee:Xt,xt=we<0?Xt:ee;ot?(Me>0&&De[F]!=null&&se(Ot.get(
De[F]),At,st+ct(Me/2),ie,Xe(0,dt-Me),tt,xt),Y[F]!=null&&se(te.get(Y[F]),At,st+ct(Me/2),ie,Xe(0,dt-Me),tt,xt)):se(gn,At,st+ct(Me/2),ie,Xe(0,dt-Me),tt,xt),ce(x,b,
F,At-Me/2,st,ie+Me,dt)}}return Me>0?Ye.stroke=ot?Ot:gn:ot||(Ye._fill=L.width==0?L._fill:L._stroke??L._fill,Ye.width=0),Ye.fill=ot?te:gn,Ye})}function Mp(t,e){let n=ae(
e?.alignGaps,0);return(o,s,r,i)=>hn(o,s,(a,c,p,m,h,g,x,b,M,A,L)=>{[r,i]=Zo(p,r,i);let S=a.pxRound,_=$=>S(g($,m,A,b)),T=$=>S(x($,h,L,M)),j,D,Z;m.ori==0?(j=ns,Z=Yn,
D=Zl):(j=os,Z=Jn,D=Ql);let G=m.dir*(m.ori==0?1:-1),R=_(c[G==1?r:i]),V=R,E=[],q=[];for(let $=G==1?r:i;$>=r&&$<=i;$+=G)if(p[$]!=null){let me=c[$],se=_(me);E.push(
V=se),q.push(T(p[$]))}let U={stroke:t(E,q,j,Z,D,S),fill:null,clip:null,band:null,gaps:null,flags:Kn},K=U.stroke,[W,ne]=vr(o,s);if(a.fill!=null||W!=0){let $=U.fill=
new Path2D(K),Ke=a.fillTo(o,s,a.min,a.max,W),me=T(Ke);Z($,V,me),Z($,R,me)}if(!a.spanGaps){let $=[];$.push(...kr(c,p,r,i,G,_,n)),U.gaps=$=a.gaps(o,s,r,i,$),U.clip=
ts($,m.ori,b,M,A,L)}return ne!=0&&(U.band=ne==2?[Ht(o,s,r,i,K,-1),Ht(o,s,r,i,K,1)]:Ht(o,s,r,i,K,ne)),U})}function Tp(t){return Mp(Pp,t)}function Pp(t,e,n,o,s,r){
let i=t.length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let c=Array(i),p=Array(i-1),m=Array(i-1),h=Array(i-1);for(let g=0;g<
i-1;g++)m[g]=e[g+1]-e[g],h[g]=t[g+1]-t[g],p[g]=m[g]/h[g];c[0]=p[0];for(let g=1;g<i-1;g++)p[g]===0||p[g-1]===0||p[g-1]>0!=p[g]>0?c[g]=0:(c[g]=3*(h[g-1]+h[g])/((2*
h[g]+h[g-1])/p[g-1]+(h[g]+2*h[g-1])/p[g]),isFinite(c[g])||(c[g]=0));c[i-1]=p[i-2];for(let g=0;g<i-1;g++)s(a,t[g]+h[g]/3,e[g]+c[g]*h[g]/3,t[g+1]-h[g]/3,e[g+1]-c[g+
1]*h[g]/3,t[g+1],e[g+1])}return a}var ar=new Set;function gl(){for(let t of ar)t.syncRect(!0)}qn&&(dn(iu,Gn,gl),dn(lu,Gn,gl,!0),dn(qo,Gn,()=>{Fe.pxRatio=pe}));var Ep=ta(),
Ap=Xl();function yl(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>cr(r,i,e,n))}function Cp(t,e){return t.map((n,o)=>o==
0?{}:Le({},e,n))}function cr(t,e,n,o){return Le({},e==0?n:o,t)}function na(t,e,n){return e==null?Bn:[e,n]}var _p=na;function Lp(t,e,n){return e==null?Bn:Yo(e,n,
hr,!0)}function oa(t,e,n,o){return e==null?Bn:Qo(e,n,t.scales[o].log,!1)}var Dp=oa;function sa(t,e,n,o){return e==null?Bn:fr(e,n,t.scales[o].log,!1)}var Rp=sa;function Np(t,e,n,o,s){
let r=Xe(Yi(t),Yi(e)),i=e-t,a=Pt(s/o*i,n);do{let c=n[a],p=o*c/i;if(p>=s&&r+(c<5?Jt.get(c):0)<=17)return[c,p]}while(++a<n.length);return[0,0]}function bl(t){let e,
n;return t=t.replace(/(\d+)px/,(o,s)=>(e=Ne((n=+s)*pe))+"px"),[t,e,n]}function Op(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=be(e[2]*pe,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Fe(t,e,n){let o={mode:ae(t.mode,1)},s=o.mode;function r(l,u,d,f){let y=u.valToPct(l);return f+d*(u.dir==-1?1-y:y)}function i(l,u,d,f){
let y=u.valToPct(l);return f+d*(u.dir==-1?y:1-y)}function a(l,u,d,f){return u.ori==0?r(l,u,d,f):i(l,u,d,f)}o.valToPosH=r,o.valToPosV=i;let c=!1;o.status=0;let p=o.
root=bt(Wc);if(t.id!=null&&(p.id=t.id),at(p,t.class),t.title){let l=bt(Bc,p);l.textContent=t.title}let m=Tt("canvas"),h=o.ctx=m.getContext("2d"),g=bt(jc,p);dn("\
click",g,l=>{l.target===b&&(xe!=An||Te!=Cn)&&Be.click(o,l)},!0);let x=o.under=bt(Kc,g);g.appendChild(m);let b=o.over=bt(qc,g);t=jn(t);let M=+ae(t.pxAlign,1),A=hl(
M);(t.plugins||[]).forEach(l=>{l.opts&&(t=l.opts(o,t)||t)});let L=t.ms||.001,S=o.series=s==1?yl(t.series||[],ll,dl,!1):Cp(t.series||[null],pl),_=o.axes=yl(t.axes||
[],il,cl,!0),T=o.scales={},j=o.bands=t.bands||[];j.forEach(l=>{l.fill=re(l.fill||null),l.dir=ae(l.dir,-1)});let D=s==2?S[1].facets[0].scale:S[0].scale,Z={axes:ic,
series:tc},G=(t.drawOrder||["axes","series"]).map(l=>Z[l]);function R(l){let u=l.distr==3?d=>Vt(d>0?d:l.clamp(o,d,l.min,l.max,l.key)):l.distr==4?d=>Js(d,l.asinh):
l.distr==100?d=>l.fwd(d):d=>d;return d=>{let f=u(d),{_min:y,_max:w}=l,v=w-y;return(f-y)/v}}function V(l){let u=T[l];if(u==null){let d=(t.scales||yo)[l]||yo;if(d.
from!=null){V(d.from);let f=Le({},T[d.from],d,{key:l});f.valToPct=R(f),T[l]=f}else{u=T[l]=Le({},l==D?jl:yp,d),u.key=l;let f=u.time,y=u.range,w=Yt(y);if((l!=D||s==
2&&!f)&&(w&&(y[0]==null||y[1]==null)&&(y={min:y[0]==null?ji:{mode:1,hard:y[0],soft:y[0]},max:y[1]==null?ji:{mode:1,hard:y[1],soft:y[1]}},w=!1),!w&&es(y))){let v=y;
y=(P,C,N)=>C==null?Bn:Yo(C,N,v)}u.range=re(y||(f?_p:l==D?u.distr==3?Dp:u.distr==4?Rp:na:u.distr==3?oa:u.distr==4?sa:Lp)),u.auto=re(w?!1:u.auto),u.clamp=re(u.clamp||
gp),u._min=u._max=null,u.valToPct=R(u)}}}V("x"),V("y"),s==1&&S.forEach(l=>{V(l.scale)}),_.forEach(l=>{V(l.scale)});for(let l in t.scales)V(l);let E=T[D],q=E.distr,
U,K;E.ori==0?(at(p,Gc),U=r,K=i):(at(p,$c),U=i,K=r);let W={};for(let l in T){let u=T[l];(u.min!=null||u.max!=null)&&(W[l]={min:u.min,max:u.max},u.min=u.max=null)}
let ne=t.tzDate||(l=>new Date(Ne(l/L))),$=t.fmtDate||yr,Ke=L==1?Gu(ne):ju(ne),me=ol(ne,nl(L==1?Wu:Bu,$)),se=rl(ne,sl(qu,$)),ce=[],X=o.legend=Le({},Zu,t.legend),
H=o.cursor=Le({},op,{drag:{y:s==2}},t.cursor),Pe=X.show,Ie=H.show,ge=X.markers;X.idxs=ce,ge.width=re(ge.width),ge.dash=re(ge.dash),ge.stroke=re(ge.stroke),ge.fill=
re(ge.fill);let ie,pt,et,Me=[],ot=[],Y,te=!1,De={};if(X.live){let l=S[1]?S[1].values:null;te=l!=null,Y=te?l(o,1,0):{_:0};for(let u in Y)De[u]=pr}if(Pe)if(ie=Tt(
"table",eu,p),et=Tt("tbody",null,ie),X.mount(o,ie),te){pt=Tt("thead",null,ie,et);let l=Tt("tr",null,pt);Tt("th",null,l);for(var Ot in Y)Tt("th",Ri,l).textContent=
Ot}else at(ie,nu),X.live&&at(ie,tu);let mn={show:!0},Qn={show:!1};function wo(l,u){if(u==0&&(te||!X.live||s==2))return Bn;let d=[],f=Tt("tr",ou,et,et.childNodes[u]);
at(f,l.class),l.show||at(f,pn);let y=Tt("th",null,f);if(ge.show){let P=bt(su,y);if(u>0){let C=ge.width(o,u);C&&(P.style.border=C+"px "+ge.dash(o,u)+" "+ge.stroke(
o,u)),P.style.background=ge.fill(o,u)}}let w=bt(Ri,y);l.label instanceof HTMLElement?w.appendChild(l.label):w.textContent=l.label,u>0&&(ge.show||(w.style.color=
l.width>0?ge.stroke(o,u):ge.fill(o,u)),Ye("click",y,P=>{if(H._lock)return;on(P);let C=S.indexOf(l);if((P.ctrlKey||P.metaKey)!=X.isolate){let N=S.some((O,I)=>I>0&&
I!=C&&O.show);S.forEach((O,I)=>{I>0&&_t(I,N?I==C?mn:Qn:mn,!0,Ce.setSeries)})}else _t(C,{show:!l.show},!0,Ce.setSeries)},!1),wn&&Ye(Ii,y,P=>{H._lock||(on(P),_t(S.
indexOf(l),Ln,!0,Ce.setSeries))},!1));for(var v in Y){let P=Tt("td",ru,f);P.textContent="--",d.push(P)}return[f,d]}let Qt=new Map;function Ye(l,u,d,f=!0){let y=Qt.
get(u)||{},w=H.bind[l](o,u,d,f);w&&(dn(l,u,y[l]=w),Qt.set(u,y))}function gn(l,u,d){let f=Qt.get(u)||{};for(let y in f)(l==null||y==l)&&(or(y,u,f[y]),delete f[y]);
l==null&&Qt.delete(u)}let Ft=0,Xt=0,ee=0,F=0,we=0,Re=0,yn=we,en=Re,At=ee,tn=F,st=0,dt=0,tt=0,xt=0;o.bbox={};let ys=!1,xo=!1,bn=!1,nn=!1,vo=!1,ft=!1;function bs(l,u,d){
(d||l!=o.width||u!=o.height)&&Lr(l,u),Mn(!1),bn=!0,xo=!0,Tn()}function Lr(l,u){o.width=Ft=ee=l,o.height=Xt=F=u,we=Re=0,qa(),Ya();let d=o.bbox;st=d.left=cn(we*pe,
.5),dt=d.top=cn(Re*pe,.5),tt=d.width=cn(ee*pe,.5),xt=d.height=cn(F*pe,.5)}let Ba=3;function ja(){let l=!1,u=0;for(;!l;){u++;let d=sc(u),f=rc(u);l=u==Ba||d&&f,l||
(Lr(o.width,o.height),xo=!0)}}function Ka({width:l,height:u}){bs(l,u)}o.setSize=Ka;function qa(){let l=!1,u=!1,d=!1,f=!1;_.forEach((y,w)=>{if(y.show&&y._show){let{
side:v,_size:P}=y,C=v%2,N=y.label!=null?y.labelSize:0,O=P+N;O>0&&(C?(ee-=O,v==3?(we+=O,f=!0):d=!0):(F-=O,v==0?(Re+=O,l=!0):u=!0))}}),sn[0]=l,sn[1]=d,sn[2]=u,sn[3]=
f,ee-=Wt[1]+Wt[3],we+=Wt[3],F-=Wt[2]+Wt[0],Re+=Wt[0]}function Ya(){let l=we+ee,u=Re+F,d=we,f=Re;function y(w,v){switch(w){case 1:return l+=v,l-v;case 2:return u+=
v,u-v;case 3:return d-=v,d+v;case 0:return f-=v,f+v}}_.forEach((w,v)=>{if(w.show&&w._show){let P=w.side;w._pos=y(P,w._size),w.label!=null&&(w._lpos=y(P,w.labelSize))}})}
if(H.dataIdx==null){let l=H.hover,u=l.skip=new Set(l.skip??[]);u.add(void 0);let d=l.prox=re(l.prox),f=l.bias??=0;H.dataIdx=(y,w,v,P)=>{if(w==0)return v;let C=v,
N=d(y,w,v,P)??ye,O=N>=0&&N<ye,I=E.ori==0?ee:F,Q=H.left,ue=e[0],le=e[w];if(u.has(le[v])){C=null;let oe=null,J=null,B;if(f==0||f==-1)for(B=v;oe==null&&B-- >0;)u.has(
le[B])||(oe=B);if(f==0||f==1)for(B=v;J==null&&B++<le.length;)u.has(le[B])||(J=B);if(oe!=null||J!=null)if(O){let ke=oe==null?-1/0:U(ue[oe],E,I,0),Ee=J==null?1/0:
U(ue[J],E,I,0),Ge=Q-ke,fe=Ee-Q;Ge<=fe?Ge<=N&&(C=oe):fe<=N&&(C=J)}else C=J==null?oe:oe==null?J:v-oe<=J-v?oe:J}else O&&Oe(Q-U(ue[v],E,I,0))>N&&(C=null);return C}}
let on=l=>{H.event=l};H.idxs=ce,H._lock=!1;let qe=H.points;qe.show=re(qe.show),qe.size=re(qe.size),qe.stroke=re(qe.stroke),qe.width=re(qe.width),qe.fill=re(qe.fill);
let Ct=o.focus=Le({},t.focus||{alpha:.3},H.focus),wn=Ct.prox>=0,xn=wn&&qe.one,ht=[],vn=[],kn=[];function Dr(l,u){let d=qe.show(o,u);if(d instanceof HTMLElement)
return at(d,Xc),at(d,l.class),Nt(d,-10,-10,ee,F),b.insertBefore(d,ht[u]),d}function Rr(l,u){if(s==1||u>0){let d=s==1&&T[l.scale].time,f=l.value;l.value=d?Qi(f)?
rl(ne,sl(f,$)):f||se:f||fp,l.label=l.label||(d?rp:sp)}if(xn||u>0){l.width=l.width==null?1:l.width,l.paths=l.paths||Ep||yu,l.fillTo=re(l.fillTo||bp),l.pxAlign=+ae(
l.pxAlign,M),l.pxRound=hl(l.pxAlign),l.stroke=re(l.stroke||null),l.fill=re(l.fill||null),l._stroke=l._fill=l._paths=l._focus=null;let d=hp(Xe(1,l.width),1),f=l.
points=Le({},{size:d,width:Xe(1,d*.2),stroke:l.stroke,space:d*2,paths:Ap,_stroke:null,_fill:null},l.points);f.show=re(f.show),f.filter=re(f.filter),f.fill=re(f.
fill),f.stroke=re(f.stroke),f.paths=re(f.paths),f.pxAlign=l.pxAlign}if(Pe){let d=wo(l,u);Me.splice(u,0,d[0]),ot.splice(u,0,d[1]),X.values.push(null)}if(Ie){ce.splice(
u,0,null);let d=null;xn?u==0&&(d=Dr(l,u)):u>0&&(d=Dr(l,u)),ht.splice(u,0,d),vn.splice(u,0,0),kn.splice(u,0,0)}We("addSeries",u)}function Ja(l,u){u=u??S.length,l=
s==1?cr(l,u,ll,dl):cr(l,u,{},pl),S.splice(u,0,l),Rr(S[u],u)}o.addSeries=Ja;function Za(l){if(S.splice(l,1),Pe){X.values.splice(l,1),ot.splice(l,1);let u=Me.splice(
l,1)[0];gn(null,u.firstChild),u.remove()}Ie&&(ce.splice(l,1),ht.splice(l,1)[0].remove(),vn.splice(l,1),kn.splice(l,1)),We("delSeries",l)}o.delSeries=Za;let sn=[
!1,!1,!1,!1];function Qa(l,u){if(l._show=l.show,l.show){let d=l.side%2,f=T[l.scale];f==null&&(l.scale=d?S[1].scale:D,f=T[l.scale]);let y=f.time;l.size=re(l.size),
l.space=re(l.space),l.rotate=re(l.rotate),Yt(l.incrs)&&l.incrs.forEach(v=>{!Jt.has(v)&&Jt.set(v,El(v))}),l.incrs=re(l.incrs||(f.distr==2?zu:y?L==1?Hu:$u:un)),l.
splits=re(l.splits||(y&&f.distr==1?Ke:f.distr==3?rr:f.distr==4?ap:lp)),l.stroke=re(l.stroke),l.grid.stroke=re(l.grid.stroke),l.ticks.stroke=re(l.ticks.stroke),l.
border.stroke=re(l.border.stroke);let w=l.values;l.values=Yt(w)&&!Yt(w[0])?re(w):y?Yt(w)?ol(ne,nl(w,$)):Qi(w)?Ku(ne,w):w||me:w||ip,l.filter=re(l.filter||(f.distr>=
3&&f.log==10?pp:f.distr==3&&f.log==2?dp:Tl)),l.font=bl(l.font),l.labelFont=bl(l.labelFont),l._size=l.size(o,null,u,0),l._space=l._rotate=l._incrs=l._found=l._splits=
l._values=null,l._size>0&&(sn[u]=!0,l._el=bt(Yc,g))}}function Xn(l,u,d,f){let[y,w,v,P]=d,C=u%2,N=0;return C==0&&(P||w)&&(N=u==0&&!y||u==2&&!v?Ne(il.size/3):0),C==
1&&(y||v)&&(N=u==1&&!w||u==3&&!P?Ne(cl.size/2):0),N}let Nr=o.padding=(t.padding||[Xn,Xn,Xn,Xn]).map(l=>re(ae(l,Xn))),Wt=o._padding=Nr.map((l,u)=>l(o,u,sn,0)),$e,
Ue=null,ze=null,ko=s==1?S[0].idxs:null,vt=null,eo=!1;function Or(l,u){if(e=l??[],o.data=o._data=e,s==2){$e=0;for(let d=1;d<S.length;d++)$e+=e[d][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),vt=e[0],$e=vt.length;let d=e;if(q==2){d=e.slice();let f=d[0]=Array($e);for(let y=0;y<$e;y++)f[y]=y}o._data=e=d}if(Mn(!0),We(
"setData"),q==2&&(bn=!0),u!==!1){let d=E;d.auto(o,eo)?ws():$t(D,d.min,d.max),nn=nn||H.left>=0,ft=!0,Tn()}}o.setData=Or;function ws(){eo=!0;let l,u;s==1&&($e>0?(Ue=
ko[0]=0,ze=ko[1]=$e-1,l=e[0][Ue],u=e[0][ze],q==2?(l=Ue,u=ze):l==u&&(q==3?[l,u]=Qo(l,l,E.log,!1):q==4?[l,u]=fr(l,l,E.log,!1):E.time?u=l+Ne(86400/L):[l,u]=Yo(l,u,
hr,!0))):(Ue=ko[0]=l=null,ze=ko[1]=u=null)),$t(D,l,u)}let So,Sn,xs,vs,ks,Ss,Ms,Ts,Ps,nt;function Fr(l,u,d,f,y,w){l??=Oi,d??=gr,f??="butt",y??=Oi,w??="round",l!=
So&&(h.strokeStyle=So=l),y!=Sn&&(h.fillStyle=Sn=y),u!=xs&&(h.lineWidth=xs=u),w!=ks&&(h.lineJoin=ks=w),f!=Ss&&(h.lineCap=Ss=f),d!=vs&&h.setLineDash(vs=d)}function Ir(l,u,d,f){
u!=Sn&&(h.fillStyle=Sn=u),l!=Ms&&(h.font=Ms=l),d!=Ts&&(h.textAlign=Ts=d),f!=Ps&&(h.textBaseline=Ps=f)}function Es(l,u,d,f,y=0){if(f.length>0&&l.auto(o,eo)&&(u==
null||u.min==null)){let w=ae(Ue,0),v=ae(ze,f.length-1),P=d.min==null?pu(f,w,v,y,l.distr==3):[d.min,d.max];l.min=Et(l.min,d.min=P[0]),l.max=Xe(l.max,d.max=P[1])}}
let Ur={min:null,max:null};function Xa(){for(let f in T){let y=T[f];W[f]==null&&(y.min==null||W[D]!=null&&y.auto(o,eo))&&(W[f]=Ur)}for(let f in T){let y=T[f];W[f]==
null&&y.from!=null&&W[y.from]!=null&&(W[f]=Ur)}W[D]!=null&&Mn(!0);let l={};for(let f in W){let y=W[f];if(y!=null){let w=l[f]=jn(T[f],xu);if(y.min!=null)Le(w,y);else if(f!=
D||s==2)if($e==0&&w.from==null){let v=w.range(o,null,null,f);w.min=v[0],w.max=v[1]}else w.min=ye,w.max=-ye}}if($e>0){S.forEach((f,y)=>{if(s==1){let w=f.scale,v=W[w];
if(v==null)return;let P=l[w];if(y==0){let C=P.range(o,P.min,P.max,w);P.min=C[0],P.max=C[1],Ue=Pt(P.min,e[0]),ze=Pt(P.max,e[0]),ze-Ue>1&&(e[0][Ue]<P.min&&Ue++,e[0][ze]>
P.max&&ze--),f.min=vt[Ue],f.max=vt[ze]}else f.show&&f.auto&&Es(P,v,f,e[y],f.sorted);f.idxs[0]=Ue,f.idxs[1]=ze}else if(y>0&&f.show&&f.auto){let[w,v]=f.facets,P=w.
scale,C=v.scale,[N,O]=e[y],I=l[P],Q=l[C];I!=null&&Es(I,W[P],w,N,w.sorted),Q!=null&&Es(Q,W[C],v,O,v.sorted),f.min=v.min,f.max=v.max}});for(let f in l){let y=l[f],
w=W[f];if(y.from==null&&(w==null||w.min==null)){let v=y.range(o,y.min==ye?null:y.min,y.max==-ye?null:y.max,f);y.min=v[0],y.max=v[1]}}}for(let f in l){let y=l[f];
if(y.from!=null){let w=l[y.from];if(w.min==null)y.min=y.max=null;else{let v=y.range(o,w.min,w.max,f);y.min=v[0],y.max=v[1]}}}let u={},d=!1;for(let f in l){let y=l[f],
w=T[f];if(w.min!=y.min||w.max!=y.max){w.min=y.min,w.max=y.max;let v=w.distr;w._min=v==3?Vt(w.min):v==4?Js(w.min,w.asinh):v==100?w.fwd(w.min):w.min,w._max=v==3?Vt(
w.max):v==4?Js(w.max,w.asinh):v==100?w.fwd(w.max):w.max,u[f]=d=!0}}if(d){S.forEach((f,y)=>{s==2?y>0&&u.y&&(f._paths=null):u[f.scale]&&(f._paths=null)});for(let f in u)
bn=!0,We("setScale",f);Ie&&H.left>=0&&(nn=ft=!0)}for(let f in W)W[f]=null}function ec(l){let u=sr(Ue-1,0,$e-1),d=sr(ze+1,0,$e-1);for(;l[u]==null&&u>0;)u--;for(;l[d]==
null&&d<$e-1;)d++;return[u,d]}function tc(){if($e>0){let l=S.some(u=>u._focus)&&nt!=Ct.alpha;l&&(h.globalAlpha=nt=Ct.alpha),S.forEach((u,d)=>{if(d>0&&u.show&&(zr(
d,!1),zr(d,!0),u._paths==null)){let f=nt;nt!=u.alpha&&(h.globalAlpha=nt=u.alpha);let y=s==2?[0,e[d][0].length-1]:ec(e[d]);u._paths=u.paths(o,d,y[0],y[1]),nt!=f&&
(h.globalAlpha=nt=f)}}),S.forEach((u,d)=>{if(d>0&&u.show){let f=nt;nt!=u.alpha&&(h.globalAlpha=nt=u.alpha),u._paths!=null&&Vr(d,!1);{let y=u._paths!=null?u._paths.
gaps:null,w=u.points.show(o,d,Ue,ze,y),v=u.points.filter(o,d,w,y);(w||v)&&(u.points._paths=u.points.paths(o,d,Ue,ze,v),Vr(d,!0))}nt!=f&&(h.globalAlpha=nt=f),We(
"drawSeries",d)}}),l&&(h.globalAlpha=nt=1)}}function zr(l,u){let d=u?S[l].points:S[l];d._stroke=d.stroke(o,l),d._fill=d.fill(o,l)}function Vr(l,u){let d=u?S[l].
points:S[l],{stroke:f,fill:y,clip:w,flags:v,_stroke:P=d._stroke,_fill:C=d._fill,_width:N=d.width}=d._paths;N=be(N*pe,3);let O=null,I=N%2/2;u&&C==null&&(C=N>0?"#\
fff":P);let Q=d.pxAlign==1&&I>0;if(Q&&h.translate(I,I),!u){let ue=st-N/2,le=dt-N/2,oe=tt+N,J=xt+N;O=new Path2D,O.rect(ue,le,oe,J)}u?As(P,N,d.dash,d.cap,C,f,y,v,
w):nc(l,P,N,d.dash,d.cap,C,f,y,v,O,w),Q&&h.translate(-I,-I)}function nc(l,u,d,f,y,w,v,P,C,N,O){let I=!1;C!=0&&j.forEach((Q,ue)=>{if(Q.series[0]==l){let le=S[Q.series[1]],
oe=e[Q.series[1]],J=(le._paths||yo).band;Yt(J)&&(J=Q.dir==1?J[0]:J[1]);let B,ke=null;le.show&&J&&fu(oe,Ue,ze)?(ke=Q.fill(o,ue)||w,B=le._paths.clip):J=null,As(u,
d,f,y,ke,v,P,C,N,O,B,J),I=!0}}),I||As(u,d,f,y,w,v,P,C,N,O)}let Hr=Kn|lr;function As(l,u,d,f,y,w,v,P,C,N,O,I){Fr(l,u,d,f,y),(C||N||I)&&(h.save(),C&&h.clip(C),N&&
h.clip(N)),I?(P&Hr)==Hr?(h.clip(I),O&&h.clip(O),To(y,v),Mo(l,w,u)):P&lr?(To(y,v),h.clip(I),Mo(l,w,u)):P&Kn&&(h.save(),h.clip(I),O&&h.clip(O),To(y,v),h.restore(),
Mo(l,w,u)):(To(y,v),Mo(l,w,u)),(C||N||I)&&h.restore()}function Mo(l,u,d){d>0&&(u instanceof Map?u.forEach((f,y)=>{h.strokeStyle=So=y,h.stroke(f)}):u!=null&&l&&h.
stroke(u))}function To(l,u){u instanceof Map?u.forEach((d,f)=>{h.fillStyle=Sn=f,h.fill(d)}):u!=null&&l&&h.fill(u)}function oc(l,u,d,f){let y=_[l],w;if(f<=0)w=[0,
0];else{let v=y._space=y.space(o,l,u,d,f),P=y._incrs=y.incrs(o,l,u,d,f,v);w=Np(u,d,P,f,v)}return y._found=w}function Cs(l,u,d,f,y,w,v,P,C,N){let O=v%2/2;M==1&&h.
translate(O,O),Fr(P,v,C,N,P),h.beginPath();let I,Q,ue,le,oe=y+(f==0||f==3?-w:w);d==0?(Q=y,le=oe):(I=y,ue=oe);for(let J=0;J<l.length;J++)u[J]!=null&&(d==0?I=ue=l[J]:
Q=le=l[J],h.moveTo(I,Q),h.lineTo(ue,le));h.stroke(),M==1&&h.translate(-O,-O)}function sc(l){let u=!0;return _.forEach((d,f)=>{if(!d.show)return;let y=T[d.scale];
if(y.min==null){d._show&&(u=!1,d._show=!1,Mn(!1));return}else d._show||(u=!1,d._show=!0,Mn(!1));let w=d.side,v=w%2,{min:P,max:C}=y,[N,O]=oc(f,P,C,v==0?ee:F);if(O==
0)return;let I=y.distr==2,Q=d._splits=d.splits(o,f,P,C,N,O,I),ue=y.distr==2?Q.map(B=>vt[B]):Q,le=y.distr==2?vt[Q[1]]-vt[Q[0]]:N,oe=d._values=d.values(o,d.filter(
o,ue,f,O,le),f,O,le);d._rotate=w==2?d.rotate(o,oe,f,O):0;let J=d._size;d._size=wt(d.size(o,oe,f,l)),J!=null&&d._size!=J&&(u=!1)}),u}function rc(l){let u=!0;return Nr.
forEach((d,f)=>{let y=d(o,f,sn,l);y!=Wt[f]&&(u=!1),Wt[f]=y}),u}function ic(){for(let l=0;l<_.length;l++){let u=_[l];if(!u.show||!u._show)continue;let d=u.side,f=d%
2,y,w,v=u.stroke(o,l),P=d==0||d==3?-1:1,[C,N]=u._found;if(u.label!=null){let Ze=u.labelGap*P,lt=Ne((u._lpos+Ze)*pe);Ir(u.labelFont[0],v,"center",d==2?"top":Ni),
h.save(),f==1?(y=w=0,h.translate(lt,Ne(dt+xt/2)),h.rotate((d==3?-Ko:Ko)/2)):(y=Ne(st+tt/2),w=lt);let an=Sl(u.label)?u.label(o,l,C,N):u.label;h.fillText(an,y,w),
h.restore()}if(N==0)continue;let O=T[u.scale],I=f==0?tt:xt,Q=f==0?st:dt,ue=u._splits,le=O.distr==2?ue.map(Ze=>vt[Ze]):ue,oe=O.distr==2?vt[ue[1]]-vt[ue[0]]:C,J=u.
ticks,B=u.border,ke=J.show?J.size:0,Ee=Ne(ke*pe),Ge=Ne((u.alignTo==2?u._size-ke-u.gap:u.gap)*pe),fe=u._rotate*-Ko/180,Ae=A(u._pos*pe),rt=(Ee+Ge)*P,Je=Ae+rt;w=f==
0?Je:0,y=f==1?Je:0;let mt=u.font[0],kt=u.align==1?Hn:u.align==2?Ks:fe>0?Hn:fe<0?Ks:f==0?"center":d==3?Ks:Hn,Dt=fe||f==1?"middle":d==2?"top":Ni;Ir(mt,v,kt,Dt);let it=u.
font[1]*u.lineGap,gt=ue.map(Ze=>A(a(Ze,O,I,Q))),St=u._values;for(let Ze=0;Ze<St.length;Ze++){let lt=St[Ze];if(lt!=null){f==0?y=gt[Ze]:w=gt[Ze],lt=""+lt;let an=lt.
indexOf(`
`)==-1?[lt]:lt.split(/\n/gm);for(let Qe=0;Qe<an.length;Qe++){let ii=an[Qe];fe?(h.save(),h.translate(y,w+Qe*it),h.rotate(fe),h.fillText(ii,0,0),h.restore()):h.fillText(
ii,y,w+Qe*it)}}}J.show&&Cs(gt,J.filter(o,le,l,N,oe),f,d,Ae,Ee,be(J.width*pe,3),J.stroke(o,l),J.dash,J.cap);let Rt=u.grid;Rt.show&&Cs(gt,Rt.filter(o,le,l,N,oe),f,
f==0?2:1,f==0?dt:st,f==0?xt:tt,be(Rt.width*pe,3),Rt.stroke(o,l),Rt.dash,Rt.cap),B.show&&Cs([Ae],[1],f==0?1:0,f==0?1:2,f==1?dt:st,f==1?xt:tt,be(B.width*pe,3),B.stroke(
o,l),B.dash,B.cap)}We("drawAxes")}function Mn(l){S.forEach((u,d)=>{d>0&&(u._paths=null,l&&(s==1?(u.min=null,u.max=null):u.facets.forEach(f=>{f.min=null,f.max=null})))})}
let Po=!1,_s=!1,to=[];function lc(){_s=!1;for(let l=0;l<to.length;l++)We(...to[l]);to.length=0}function Tn(){Po||(Eu(Wr),Po=!0)}function ac(l,u=!1){Po=!0,_s=u,l(
o),Wr(),u&&to.length>0&&queueMicrotask(lc)}o.batch=ac;function Wr(){if(ys&&(Xa(),ys=!1),bn&&(ja(),bn=!1),xo){if(Se(x,Hn,we),Se(x,"top",Re),Se(x,fo,ee),Se(x,ho,F),
Se(b,Hn,we),Se(b,"top",Re),Se(b,fo,ee),Se(b,ho,F),Se(g,fo,Ft),Se(g,ho,Xt),m.width=Ne(Ft*pe),m.height=Ne(Xt*pe),_.forEach(({_el:l,_show:u,_size:d,_pos:f,side:y})=>{
if(l!=null)if(u){let w=y===3||y===0?d:0,v=y%2==1;Se(l,v?"left":"top",f-w),Se(l,v?"width":"height",d),Se(l,v?"top":"left",v?Re:we),Se(l,v?"height":"width",v?F:ee),
nr(l,pn)}else at(l,pn)}),So=Sn=xs=ks=Ss=Ms=Ts=Ps=vs=null,nt=1,so(!0),we!=yn||Re!=en||ee!=At||F!=tn){Mn(!1);let l=ee/At,u=F/tn;if(Ie&&!nn&&H.left>=0){H.left*=l,H.
top*=u,Pn&&Nt(Pn,Ne(H.left),0,ee,F),En&&Nt(En,0,Ne(H.top),ee,F);for(let d=0;d<ht.length;d++){let f=ht[d];f!=null&&(vn[d]*=l,kn[d]*=u,Nt(f,wt(vn[d]),wt(kn[d]),ee,
F))}}if(ve.show&&!vo&&ve.left>=0&&ve.width>0){ve.left*=l,ve.width*=l,ve.top*=u,ve.height*=u;for(let d in Fs)Se(_n,d,ve[d])}yn=we,en=Re,At=ee,tn=F}We("setSize"),
xo=!1}Ft>0&&Xt>0&&(h.clearRect(0,0,m.width,m.height),We("drawClear"),G.forEach(l=>l()),We("draw")),ve.show&&vo&&(Eo(ve),vo=!1),Ie&&nn&&(ln(null,!0,!1),nn=!1),X.
show&&X.live&&ft&&(Ns(),ft=!1),c||(c=!0,o.status=1,We("ready")),eo=!1,Po=!1}o.redraw=(l,u)=>{bn=u||!1,l!==!1?$t(D,E.min,E.max):Tn()};function Ls(l,u){let d=T[l];
if(d.from==null){if($e==0){let f=d.range(o,u.min,u.max,l);u.min=f[0],u.max=f[1]}if(u.min>u.max){let f=u.min;u.min=u.max,u.max=f}if($e>1&&u.min!=null&&u.max!=null&&
u.max-u.min<1e-16)return;l==D&&d.distr==2&&$e>0&&(u.min=Pt(u.min,e[0]),u.max=Pt(u.max,e[0]),u.min==u.max&&u.max++),W[l]=u,ys=!0,Tn()}}o.setScale=Ls;let Ds,Rs,Pn,
En,Gr,$r,An,Cn,Br,jr,xe,Te,Gt=!1,Be=H.drag,Ve=Be.x,He=Be.y;Ie&&(H.x&&(Ds=bt(Zc,b)),H.y&&(Rs=bt(Qc,b)),E.ori==0?(Pn=Ds,En=Rs):(Pn=Rs,En=Ds),xe=H.left,Te=H.top);let ve=o.
select=Le({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),_n=ve.show?bt(Jc,ve.over?b:x):null;function Eo(l,u){if(ve.show){for(let d in l)ve[d]=l[d],d in
Fs&&Se(_n,d,l[d]);u!==!1&&We("setSelect")}}o.setSelect=Eo;function cc(l){if(S[l].show)Pe&&nr(Me[l],pn);else if(Pe&&at(Me[l],pn),Ie){let d=xn?ht[0]:ht[l];d!=null&&
Nt(d,-10,-10,ee,F)}}function $t(l,u,d){Ls(l,{min:u,max:d})}function _t(l,u,d,f){u.focus!=null&&hc(l),u.show!=null&&S.forEach((y,w)=>{w>0&&(l==w||l==null)&&(y.show=
u.show,cc(w),s==2?($t(y.facets[0].scale,null,null),$t(y.facets[1].scale,null,null)):$t(y.scale,null,null),Tn())}),d!==!1&&We("setSeries",l,u),f&&ro("setSeries",
o,l,u)}o.setSeries=_t;function uc(l,u){Le(j[l],u)}function pc(l,u){l.fill=re(l.fill||null),l.dir=ae(l.dir,-1),u=u??j.length,j.splice(u,0,l)}function dc(l){l==null?
j.length=0:j.splice(l,1)}o.addBand=pc,o.setBand=uc,o.delBand=dc;function fc(l,u){S[l].alpha=u,Ie&&ht[l]!=null&&(ht[l].style.opacity=u),Pe&&Me[l]&&(Me[l].style.opacity=
u)}let It,Bt,rn,Ln={focus:!0};function hc(l){if(l!=rn){let u=l==null,d=Ct.alpha!=1;S.forEach((f,y)=>{if(s==1||y>0){let w=u||y==0||y==l;f._focus=u?null:w,d&&fc(y,
w?1:Ct.alpha)}}),rn=l,d&&Tn()}}Pe&&wn&&Ye(Ui,ie,l=>{H._lock||(on(l),rn!=null&&_t(null,Ln,!0,Ce.setSeries))});function Lt(l,u,d){let f=T[u];d&&(l=l/pe-(f.ori==1?
Re:we));let y=ee;f.ori==1&&(y=F,l=y-l),f.dir==-1&&(l=y-l);let w=f._min,v=f._max,P=l/y,C=w+(v-w)*P,N=f.distr;return N==3?$n(10,C):N==4?mu(C,f.asinh):N==100?f.bwd(
C):C}function mc(l,u){let d=Lt(l,D,u);return Pt(d,e[0],Ue,ze)}o.valToIdx=l=>Pt(l,e[0]),o.posToIdx=mc,o.posToVal=Lt,o.valToPos=(l,u,d)=>T[u].ori==0?r(l,T[u],d?tt:
ee,d?st:0):i(l,T[u],d?xt:F,d?dt:0),o.setCursor=(l,u,d)=>{xe=l.left,Te=l.top,ln(null,u,d)};function Kr(l,u){Se(_n,Hn,ve.left=l),Se(_n,fo,ve.width=u)}function qr(l,u){
Se(_n,"top",ve.top=l),Se(_n,ho,ve.height=u)}let no=E.ori==0?Kr:qr,oo=E.ori==1?Kr:qr;function gc(){if(Pe&&X.live)for(let l=s==2?1:0;l<S.length;l++){if(l==0&&te)continue;
let u=X.values[l],d=0;for(let f in u)ot[l][d++].firstChild.nodeValue=u[f]}}function Ns(l,u){if(l!=null&&(l.idxs?l.idxs.forEach((d,f)=>{ce[f]=d}):wu(l.idx)||ce.fill(
l.idx),X.idx=ce[0]),Pe&&X.live){for(let d=0;d<S.length;d++)(d>0||s==1&&!te)&&yc(d,ce[d]);gc()}ft=!1,u!==!1&&We("setLegend")}o.setLegend=Ns;function yc(l,u){let d=S[l],
f=l==0&&q==2?vt:e[l],y;te?y=d.values(o,l,u)??De:(y=d.value(o,u==null?null:f[u],l,u),y=y==null?De:{_:y}),X.values[l]=y}function ln(l,u,d){Br=xe,jr=Te,[xe,Te]=H.move(
o,xe,Te),H.left=xe,H.top=Te,Ie&&(Pn&&Nt(Pn,Ne(xe),0,ee,F),En&&Nt(En,0,Ne(Te),ee,F));let f,y=Ue>ze;It=ye,Bt=null;let w=E.ori==0?ee:F,v=E.ori==1?ee:F;if(xe<0||$e==
0||y){f=H.idx=null;for(let P=0;P<S.length;P++){let C=ht[P];C!=null&&Nt(C,-10,-10,ee,F)}wn&&_t(null,Ln,!0,l==null&&Ce.setSeries),X.live&&(ce.fill(f),ft=!0)}else{
let P,C,N;s==1&&(P=E.ori==0?xe:Te,C=Lt(P,D),f=H.idx=Pt(C,e[0],Ue,ze),N=U(e[0][f],E,w,0));let O=-10,I=-10,Q=0,ue=0,le=!0,oe="",J="";for(let B=s==2?1:0;B<S.length;B++){
let ke=S[B],Ee=ce[B],Ge=Ee==null?null:s==1?e[B][Ee]:e[B][1][Ee],fe=H.dataIdx(o,B,f,C),Ae=fe==null?null:s==1?e[B][fe]:e[B][1][fe];if(ft=ft||Ae!=Ge||fe!=Ee,ce[B]=
fe,B>0&&ke.show){let rt=fe==null?-10:fe==f?N:U(s==1?e[0][fe]:e[B][0][fe],E,w,0),Je=Ae==null?-10:K(Ae,s==1?T[ke.scale]:T[ke.facets[1].scale],v,0);if(wn&&Ae!=null){
let mt=E.ori==1?xe:Te,kt=Oe(Ct.dist(o,B,fe,Je,mt));if(kt<It){let Dt=Ct.bias;if(Dt!=0){let it=Lt(mt,ke.scale),gt=Ae>=0?1:-1,St=it>=0?1:-1;St==gt&&(St==1?Dt==1?Ae>=
it:Ae<=it:Dt==1?Ae<=it:Ae>=it)&&(It=kt,Bt=B)}else It=kt,Bt=B}}if(ft||xn){let mt,kt;E.ori==0?(mt=rt,kt=Je):(mt=Je,kt=rt);let Dt,it,gt,St,Rt,Ze,lt=!0,an=qe.bbox;if(an!=
null){lt=!1;let Qe=an(o,B);gt=Qe.left,St=Qe.top,Dt=Qe.width,it=Qe.height}else gt=mt,St=kt,Dt=it=qe.size(o,B);if(Ze=qe.fill(o,B),Rt=qe.stroke(o,B),xn)B==Bt&&It<=
Ct.prox&&(O=gt,I=St,Q=Dt,ue=it,le=lt,oe=Ze,J=Rt);else{let Qe=ht[B];Qe!=null&&(vn[B]=gt,kn[B]=St,Bi(Qe,Dt,it,lt),Gi(Qe,Ze,Rt),Nt(Qe,wt(gt),wt(St),ee,F))}}}}if(xn){
let B=Ct.prox,ke=rn==null?It<=B:It>B||Bt!=rn;if(ft||ke){let Ee=ht[0];Ee!=null&&(vn[0]=O,kn[0]=I,Bi(Ee,Q,ue,le),Gi(Ee,oe,J),Nt(Ee,wt(O),wt(I),ee,F))}}}if(ve.show&&
Gt)if(l!=null){let[P,C]=Ce.scales,[N,O]=Ce.match,[I,Q]=l.cursor.sync.scales,ue=l.cursor.drag;if(Ve=ue._x,He=ue._y,Ve||He){let{left:le,top:oe,width:J,height:B}=l.
select,ke=l.scales[I].ori,Ee=l.posToVal,Ge,fe,Ae,rt,Je,mt=P!=null&&N(P,I),kt=C!=null&&O(C,Q);mt&&Ve?(ke==0?(Ge=le,fe=J):(Ge=oe,fe=B),Ae=T[P],rt=U(Ee(Ge,I),Ae,w,
0),Je=U(Ee(Ge+fe,I),Ae,w,0),no(Et(rt,Je),Oe(Je-rt))):no(0,w),kt&&He?(ke==1?(Ge=le,fe=J):(Ge=oe,fe=B),Ae=T[C],rt=K(Ee(Ge,Q),Ae,v,0),Je=K(Ee(Ge+fe,Q),Ae,v,0),oo(Et(
rt,Je),Oe(Je-rt))):oo(0,v)}else Is()}else{let P=Oe(Br-Gr),C=Oe(jr-$r);if(E.ori==1){let Q=P;P=C,C=Q}Ve=Be.x&&P>=Be.dist,He=Be.y&&C>=Be.dist;let N=Be.uni;N!=null?
Ve&&He&&(Ve=P>=N,He=C>=N,!Ve&&!He&&(C>P?He=!0:Ve=!0)):Be.x&&Be.y&&(Ve||He)&&(Ve=He=!0);let O,I;Ve&&(E.ori==0?(O=An,I=xe):(O=Cn,I=Te),no(Et(O,I),Oe(I-O)),He||oo(
0,v)),He&&(E.ori==1?(O=An,I=xe):(O=Cn,I=Te),oo(Et(O,I),Oe(I-O)),Ve||no(0,w)),!Ve&&!He&&(no(0,0),oo(0,0))}if(Be._x=Ve,Be._y=He,l==null){if(d){if(ri!=null){let[P,
C]=Ce.scales;Ce.values[0]=P!=null?Lt(E.ori==0?xe:Te,P):null,Ce.values[1]=C!=null?Lt(E.ori==1?xe:Te,C):null}ro(qs,o,xe,Te,ee,F,f)}if(wn){let P=d&&Ce.setSeries,C=Ct.
prox;rn==null?It<=C&&_t(Bt,Ln,!0,P):It>C?_t(null,Ln,!0,P):Bt!=rn&&_t(Bt,Ln,!0,P)}}ft&&(X.idx=f,Ns()),u!==!1&&We("setCursor")}let jt=null;Object.defineProperty(o,
"rect",{get(){return jt==null&&so(!1),jt}});function so(l=!1){l?jt=null:(jt=b.getBoundingClientRect(),We("syncRect",jt))}function Yr(l,u,d,f,y,w,v){H._lock||Gt&&
l!=null&&l.movementX==0&&l.movementY==0||(Os(l,u,d,f,y,w,v,!1,l!=null),l!=null?ln(null,!0,!0):ln(u,!0,!1))}function Os(l,u,d,f,y,w,v,P,C){if(jt==null&&so(!1),on(
l),l!=null)d=l.clientX-jt.left,f=l.clientY-jt.top;else{if(d<0||f<0){xe=-10,Te=-10;return}let[N,O]=Ce.scales,I=u.cursor.sync,[Q,ue]=I.values,[le,oe]=I.scales,[J,
B]=Ce.match,ke=u.axes[0].side%2==1,Ee=E.ori==0?ee:F,Ge=E.ori==1?ee:F,fe=ke?w:y,Ae=ke?y:w,rt=ke?f:d,Je=ke?d:f;if(le!=null?d=J(N,le)?a(Q,T[N],Ee,0):-10:d=Ee*(rt/fe),
oe!=null?f=B(O,oe)?a(ue,T[O],Ge,0):-10:f=Ge*(Je/Ae),E.ori==1){let mt=d;d=f,f=mt}}C&&(u==null||u.cursor.event.type==qs)&&((d<=1||d>=ee-1)&&(d=cn(d,ee)),(f<=1||f>=
F-1)&&(f=cn(f,F))),P?(Gr=d,$r=f,[An,Cn]=H.move(o,d,f)):(xe=d,Te=f)}let Fs={width:0,height:0,left:0,top:0};function Is(){Eo(Fs,!1)}let Jr,Zr,Qr,Xr;function ei(l,u,d,f,y,w,v){
Gt=!0,Ve=He=Be._x=Be._y=!1,Os(l,u,d,f,y,w,v,!0,!1),l!=null&&(Ye(Ys,er,ti,!1),ro(Fi,o,An,Cn,ee,F,null));let{left:P,top:C,width:N,height:O}=ve;Jr=P,Zr=C,Qr=N,Xr=O}
function ti(l,u,d,f,y,w,v){Gt=Be._x=Be._y=!1,Os(l,u,d,f,y,w,v,!1,!0);let{left:P,top:C,width:N,height:O}=ve,I=N>0||O>0,Q=Jr!=P||Zr!=C||Qr!=N||Xr!=O;if(I&&Q&&Eo(ve),
Be.setScale&&I&&Q){let ue=P,le=N,oe=C,J=O;if(E.ori==1&&(ue=C,le=O,oe=P,J=N),Ve&&$t(D,Lt(ue,D),Lt(ue+le,D)),He)for(let B in T){let ke=T[B];B!=D&&ke.from==null&&ke.
min!=ye&&$t(B,Lt(oe+J,B),Lt(oe,B))}Is()}else H.lock&&(H._lock=!H._lock,ln(u,!0,l!=null));l!=null&&(gn(Ys,er),ro(Ys,o,xe,Te,ee,F,null))}function bc(l,u,d,f,y,w,v){
if(H._lock)return;on(l);let P=Gt;if(Gt){let C=!0,N=!0,O=10,I,Q;E.ori==0?(I=Ve,Q=He):(I=He,Q=Ve),I&&Q&&(C=xe<=O||xe>=ee-O,N=Te<=O||Te>=F-O),I&&C&&(xe=xe<An?0:ee),
Q&&N&&(Te=Te<Cn?0:F),ln(null,!0,!0),Gt=!1}xe=-10,Te=-10,ce.fill(null),ln(null,!0,!0),P&&(Gt=P)}function ni(l,u,d,f,y,w,v){H._lock||(on(l),ws(),Is(),l!=null&&ro(
zi,o,xe,Te,ee,F,null))}function oi(){_.forEach(Op),bs(o.width,o.height,!0)}dn(qo,Gn,oi);let Dn={};Dn.mousedown=ei,Dn.mousemove=Yr,Dn.mouseup=ti,Dn.dblclick=ni,Dn.
setSeries=(l,u,d,f)=>{let y=Ce.match[2];d=y(o,u,d),d!=-1&&_t(d,f,!0,!1)},Ie&&(Ye(Fi,b,ei),Ye(qs,b,Yr),Ye(Ii,b,l=>{on(l),so(!1)}),Ye(Ui,b,bc),Ye(zi,b,ni),ar.add(
o),o.syncRect=so);let Ao=o.hooks=t.hooks||{};function We(l,u,d){_s?to.push([l,u,d]):l in Ao&&Ao[l].forEach(f=>{f.call(null,o,u,d)})}(t.plugins||[]).forEach(l=>{
for(let u in l.hooks)Ao[u]=(Ao[u]||[]).concat(l.hooks[u])});let si=(l,u,d)=>d,Ce=Le({key:null,setSeries:!1,filters:{pub:Ji,sub:Ji},scales:[D,S[1]?S[1].scale:null],
match:[Zi,Zi,si],values:[null,null]},H.sync);Ce.match.length==2&&Ce.match.push(si),H.sync=Ce;let ri=Ce.key,Us=Kl(ri);function ro(l,u,d,f,y,w,v){Ce.filters.pub(l,
u,d,f,y,w,v)&&Us.pub(l,u,d,f,y,w,v)}Us.sub(o);function wc(l,u,d,f,y,w,v){Ce.filters.sub(l,u,d,f,y,w,v)&&Dn[l](null,u,d,f,y,w,v)}o.pub=wc;function xc(){Us.unsub(
o),ar.delete(o),Qt.clear(),or(qo,Gn,oi),p.remove(),ie?.remove(),We("destroy")}o.destroy=xc;function zs(){We("init",t,e),Or(e||t.data,!1),W[D]?Ls(D,W[D]):ws(),vo=
ve.show&&(ve.width>0||ve.height>0),nn=ft=!0,bs(t.width,t.height)}return S.forEach(Rr),_.forEach(Qa),n?n instanceof HTMLElement?(n.appendChild(p),zs()):n(o,zs):zs(),
o}Fe.assign=Le;Fe.fmtNum=mr;Fe.rangeNum=Yo;Fe.rangeLog=Qo;Fe.rangeAsinh=fr;Fe.orient=hn;Fe.pxRatio=pe;Fe.join=Pu;Fe.fmtDate=yr,Fe.tzDate=Iu;Fe.sync=Kl;{Fe.addGap=
wp,Fe.clipGaps=ts;let t=Fe.paths={points:Xl};t.linear=ta,t.stepped=kp,t.bars=Sp,t.spline=Tp}var rs=128,ra=50,Fp=.25,Ip=t=>[t.ray,t.truth,t.sensor,t.noReturn],is=(t,e)=>({font:Ws,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function ia(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:rs})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:rs}),s=n()),o)}function la(t,e){let{session:n}=t,o=k("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All sweeps"],["first",`First ${ra}`]],()=>s,b=>{s=b,p=null,n.
changed()}),i=0,a=-1/0,c=-1,p=null,h=ia(o,()=>{let b=Ip(e()),M=Array.from({length:i},(A,L)=>({label:`chain ${L+1}`,stroke:b[L%b.length],width:1,points:{show:!1}}));
return new Fe({width:100,height:rs,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(A,L,S)=>[L,Math.max(S,L+1)]},y:{
range:(A,L,S)=>Vp(Math.max(L,a),S)}},axes:[is(e,26),is(e,52)],series:[{label:"sweep"},...M],hooks:{draw:[A=>Hp(A,c,e())]}},[[],...M.map(()=>[])],o)},e),g=k("spa\
n",{className:"caption",textContent:"log joint by sweep"}),x=k("div",{className:"charted"},k("div",{className:"buttons"},r,g),o);return t.each(()=>{let b=n.shown,
M=b?.traced?.length?b.trace.length/b.traced.length:0;if(z(x,"hidden",M===0),!b||!M)return;let A=b.layer==="draw"&&n.draws.count?(n.draw+1)*b.sweeps/n.draws.count:
-1,L=h(M!==i&&(i=M,!0));L&&(p===b&&c===A&&L.data[0].length||([p,c]=[b,A],a=s==="all"?zp(b,M):-1/0,L.setData(Up(b,M,s))))}),x}function Up({trace:t,traced:e},n,o){
let s=o==="all"?e.length:e.filter(r=>r<=ra).length;return[e.slice(0,s),...Array.from({length:n},(r,i)=>t.slice(i*e.length,i*e.length+s))]}function zp({trace:t,traced:e},n){
let o=e.length,s=e.findIndex(r=>r>=Fp*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.min(...t.slice(i*o+s,(i+1)*o))))}function Vp(t,e){let n=Math.
max(.06*(e-t),.5);return[t-n,e+n]}function Hp(t,e,n){if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.save(),t.
ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.restore())}function aa(t,e){let{session:n}=t,o=k("div",{className:"chart",role:"img","aria-label":"Histogra\
m of the particles' weights"}),s=k("div",{className:"caption",textContent:"particles by weight, nats below the heaviest"}),r=k("div",{className:"charted"},s,o),
a=ia(o,()=>new Fe({width:100,height:rs,legend:{show:!1},cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(p,m,h)=>[m,h]},y:{distr:3,range:(p,m,h)=>[
.5,Math.max(10,2*h)]}},axes:[is(e,26),{...is(e,52),values:(p,m)=>m.map(h=>h>=1?String(h):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Fe.paths.bars?.({size:[
.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),c=null;return t.each(()=>{let p=n.shown;z(r,"hidden",!p?.weights);let m=p?.weights&&a(!1);if(!p?.weights||!m||
c===p&&m.data[0].length)return;c=p;let h=[...p.weights],g=-(p.lowest??-1)/h.length,x=[...h.map((b,M)=>(p.lowest??-1)+M*g),0];m.setData([x,[...h.map(b=>b||null),
null]])}),r}function ca(t){let{session:e,hand:n}=t,{decisions:o}=e,s=k("p",{className:"said",role:"status"}),r=k("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,p=>o.set({radius:p}),{min:.01,max:100,step:"any"}),t.numberInput("Highest risk",()=>o.risk,p=>o.set({risk:p}),{min:1e-4,max:.99,step:"any"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),c=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{z(c,"textContent",i()),z(s,"textContent",n.tool==="path"?Wp(t):Gp(t))}),a}function Wp({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${yt(
o.length_m,2)} m, free with probability ${yt(o.probability,3)} ± ${yt(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${yt(o.independent,
3)}.${r}`}function Gp({session:t}){let{views:e,trouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.nats),
s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${yt(Math.min(...e.nats),1)} to ${yt(o,1)} nats, cells taken for independent; \
the best place has a ring.${s}`}var $p=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Bp=["Draw walls, and drag the robot: a beam reads the first wall that it \
hits, with noise. Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (draw), and where doubt remains\
 (entropy). No beam has been where it is hatched.","While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact\
 in the long run."],jp="Mouse: the wheel zooms, the middle button pans, Shift or the right button erases, and so does a click on a wall. Touch: two fingers zoom\
 and pan.";function ua(t){let e=xi.map(([o,s])=>k("tr",{},k("th",{scope:"row"},k("kbd",{textContent:o})),k("td",{textContent:s}))),n=Bp.map(o=>k("p",{textContent:o}));
return t.dialog("Help",...n,k("table",{},k("tbody",{},...e)),k("p",{textContent:jp}))}function pa(t){let e=()=>k("input",{type:"number",min:_e.cells[0],max:_e.cells[1],
step:1,required:!0,value:"21"}),[n,o]=[e(),e()],s=k("select",{});for(let[i,a]of $p)s.append(k("option",{value:i,textContent:a}));s.addEventListener("change",()=>{
s.value==="building"&&Number(n.value)<60&&([n.value,o.value]=["120","80"])});let r=k("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("H\
eight (cells)",o),k("div",{className:"buttons end"},k("button",{type:"submit",className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{
t.session.act({type:"new",shape:[Number(n.value),Number(o.value)],world:s.value}),t.hand.selected=null}),t.dialog("New map",r)}function da(t){let e=k("input",{type:"\
text",readOnly:!0,"aria-label":"Link"}),n=k("span",{role:"status",className:"copied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{
document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},s=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),i=t.
dialog("Share",k("p",{textContent:"The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server r\
uns; the part from # on can be put after the address of any bayesmap page."}),k("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),
e.select()}}}function fa(t){let{session:e}=t,n=k("span",{className:"what"});t.each(()=>{let{grid:p,source:m}=e.document??{};if(!p||!m)return;let h=`${p.shape[0]} × ${p.shape[1]}\
 cells of ${+p.resolution.toPrecision(3)} m`;z(n,"textContent",m.name?`${m.name}, ${h}`:h)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),k("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let p of s)t.visible(p,()=>!e.recorded);let r=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=k("span",{className:"space"});return{element:k("header",{},k("h1",{textContent:"bayesmap"}),n,a,...s,qp(t),r,
i),nameTheme(p){let m=`Theme: ${p}`;Mt(r,"aria-label",m),z(r,"title",m)}}}var Kp=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function qp(t){
let{session:e}=t,n=(a,c,p,m)=>{let h=t.button(null,a,()=>t.command(`export ${c}`),{text:a,when:m});return p&&t.visible(h,()=>!e.recorded),h},o=k("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>Kp(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),s=t.button("save","Export",()=>r(o.hidden),{text:"Export",when:()=>!!e.document}),r=a=>{o.hidden=!a,s.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};r(!1);let i=k("div",{className:"anchor"},s,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(r(!1),s.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||r(!1)}),o.addEventListener("click",()=>{r(!1),s.
focus()}),i}var Yp={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M\
20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v1\
4M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20\
h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v\
.5",close:"M6 6l12 12M18 6L6 18"};function Zt(t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.or\
g/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true"),n.setAttribute("d",Yp[t]),e.append(n),e}var Jp=[["truth","true wall"],["ray","ray"],["miss","no return"],["dot","reading"],["sensor","sensor"],["unobserved","unobserved"]];function ha(t,e){let{session:n}=t,
o=k("span",{className:"ramp"}),s=k("span"),r=Jp.map(([a,c])=>{let p=k("i",{className:a});return a==="sensor"&&p.append(Zt("sensor")),k("li",{},p,c)});t.visible(
r[0],()=>!n.document||n.document.source.kind==="simulation");let i="";return t.each(()=>{let a=n.view.layer==="entropy";z(s,"textContent",a?"entropy (bit)":"P(w\
all)");let c=`${a} ${e().ground}`;i!==c&&(i=c,o.style.background=Ei(a?ao:p=>Bs(e(),p)))}),k("ul",{className:"legend","aria-label":"Legend"},k("li",{},s,"0",o,"1"),
...r)}var Zp="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.";function ya(t){
let{session:e}=t,n=k("span",{className:"chip"}),o=t.button(null,"Not converged",()=>ma(e)?.apply(),{text:"Not converged",className:"chip doubt"}),s=k("div",{className:"\
chips"},n,o);return t.each(()=>{let r=ma(e);z(o,"hidden",!r),r&&(z(o.firstElementChild,"textContent",`not converged: ${r.text}`),z(o,"title",`${e.shown?.verdict?.
why}. Click to ${r.text}.`),Mt(o,"aria-label",`Not converged: ${r.text}`));let i=e.shown;if(!i||!e.document)return z(s,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",c=i.layer==="draw"?a:e.view.layer==="entropy"?"entropy":"mean",p={importance:"importance sampling",propagate:"belief propaga\
tion"}[i.method],m=i.approximate?"approximate, belief propagation":p??`${i.sweeps} sweeps`;z(s,"hidden",!1),z(n,"textContent",`${c} · ${m}`),z(n,"className",i.
approximate?"chip approximate":"chip")}),s}function ma(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n||t.recorded||n.source.kind==="run")return null;
let o=r=>()=>t.act({type:"set",patch:r});if(e.method==="gibbs"&&n.source.kind==="simulation")return{text:"try blocks",apply:o({method:"block"})};if(e.method==="\
importance")return{text:"try Gibbs",apply:o({method:"auto"})};if(t.sampling)return null;let s=Math.min(_e.sweeps[1],4*n.sweeps);return s>n.sweeps?{text:`try ${s}\
 sweeps`,apply:o({sweeps:s})}:null}function ba(t){let{session:e}=t,n=k("span"),o=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),
s=k("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.
retryIn_ms??0)/1e3));z(s,"hidden",!r&&e.worker!=="restarted"),z(s,"className",r?"banner":"banner mild"),z(o,"hidden",!r);let a=`Connection lost. Trying again in\
 ${i} s; the map is kept here.`,c=e.connection.refused?Zp:a;z(n,"textContent",r?c:"The worker stopped and is being started again. The map is kept.")}),s}function wa(t){
let{session:e,hand:n}=t,o=k("div",{className:"readout",id:`${t.prefix}-readout`}),s=k("span",{role:"status","aria-live":"polite"}),r=k("span",{className:"hidden",
"aria-live":"polite"});return n.announce=i=>z(r,"textContent",i),n.describe=i=>ga(e,i),t.each(()=>{let i=n.cursor??n.hover,c=e.editable&&!matchMedia("(pointer: \
coarse)").matches?"Point at a cell, or press ? for the keys":"Point at a cell";z(o,"textContent",i?ga(e,i):c);let p=e.status.text==="Ready"&&e.shown?.verdict?.level===
"bad";z(s,"textContent",p?"Ready, but the chains have not converged":e.status.text),z(s,"className",p?"warning":e.status.level)}),{element:k("footer",{},s,o,r),
readout:o}}function ga(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+1),{
x:c,y:p}=Nn(e,n.grid),m=[`Cell ${e.x}, ${e.y}`,`${c.toFixed(a)}, ${p.toFixed(a)} m`];if(o&&o.p.length===r[0]*r[1]){let h=o.p[i]/255;o.layer==="draw"?m.push(h>.5?
"wall in this draw":"free in this draw"):m.push(`P(wall) ${h.toFixed(2)}`,`entropy ${Ro(h).toFixed(2)} bit`);let g=t.cell?.x===e.x&&t.cell.y===e.y?t.cell.beams:
null;o.observed[i]?g!==null&&m.push(g===1?"1 beam":`${g} beams`):m.push("unobserved")}return m.join(" · ")}var Mr=t=>t.charAt(0).toUpperCase()+t.slice(1),ls=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=Mr(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var Qp={importance:"particles",propagate:"rounds"};function xa(t,...e){let{session:n}=t,o=k("progress",{max:1,value:0,"aria-label":"Progress"}),s=k("div",{className:"\
doing"});return t.each(()=>{let r=n.shown,i=r&&r.total>0&&!r.approximate?r.sweeps/r.total:0;z(o,"value",i);let a=n.remaining_s(),c=Qp[r?.method??""]??"sweeps",p=r&&
!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${c}`:"",m=a!==null?a<1?"less than 1 s left":`${Math.ceil(a)} s left`:n.running?"running":"";z(s,"textContent",
Mr([p,m].filter(Boolean).join(", "))||"No chain yet")}),t.section("Posterior",Xp(t),o,s,ed(t),td(t),...e)}function Xp(t){let{session:e}=t,n=t.button("play","Run",
()=>e.act({type:"run"}),{className:"primary",text:"Run",title:"Run (R)"}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (E\
scape)",when:()=>e.running||e.sampling}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chain"),r=k("div",{
className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function ed(t){let{session:e}=t,n=k("dl"),o=(s,r,i,a=!1)=>{let c=k(
"dd",{textContent:"–"});n.append(k("div",{title:r},k("dt",{textContent:s}),c)),t.each(()=>{z(c,"textContent",e.shown?i(e.shown):"–"),a&&z(c,"className",e.shown?.
verdict?.level??"")})};return o("ESS","Effective sample size of the log joint",s=>yt(s.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",
s=>yt(s.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",s=>yt(s.log_joint,1)),o("reply","From the hand's last move to its picture",()=>yt(
e.latency.eventToPaint_ms.at(-1),0," ms")),n}function td(t){let{session:e}=t,n=k("div",{className:"verdict"});return t.each(()=>{let o=e.shown?.verdict;if(z(n,"\
hidden",!o),!o)return;let s={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];z(n,"textContent",`${s}: ${o.why}`),z(n,"className",`verdict\
 ${o.level}`)}),n}var nd={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},od={
noisy:"with noise",exact:"exact"},sd={auto:"as is best",prior:"draws of the prior",empty:"the empty map"},rd={raster:"raster",radial:"radial",random:"random"},as=2*
Math.PI,id=t=>Math.round(t*1800/Math.PI)/10,ld={importance:"Particles",propagate:"Rounds"};function va(t){let{session:e,hand:n,editor:o}=t,s=k("select",{"aria-l\
abel":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.choose("sensor")});let r="";t.each(()=>{let h=e.document?.sensors??[],g=h.
map(x=>x.id).join();g!==r&&s.replaceChildren(...h.map(({id:x})=>k("option",{value:String(x),textContent:`Sensor ${x}`}))),r=g,z(s,"value",String(n.sensor?.id??""))});
let i=(h,g)=>t.numberInput(h,()=>Number((n.sensor?.[g]??0).toFixed(2)),x=>n.sensor&&o.moveSensor(n.sensor,{[g]:x}),{step:"any"}),a=t.numberInput("heading (°)",
()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),h=>n.sensor&&o.moveSensor(n.sensor,{yaw:h%360*Math.PI/180}),{step:5}),c=t.button("plus","Add a sensor",()=>t.command(
"add"),{text:"Add"}),p=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.
document?.fov??as)<as);let m=k("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",k("div",{className:"buttons"},s,c,p),m)}function ka(t){
let{session:e}=t,[n,o]=_e.max_range,[s,r]=_e.fov_deg,i=t.numberInput("Longest range (m)",()=>e.document?.max_range??0,p=>t.set({max_range:p}),{min:n,max:o,step:"\
any"}),a=[t.slider("noise",()=>"Noise (m)",{low:_e.noise[0],high:_e.noise[1],step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{low:_e.angles[0],high:_e.angles[1],
step:1,log:!0}),i,t.numberInput("Field of view (°)",()=>id(e.document?.fov??as),p=>t.set({fov:p>=r?as:p*Math.PI/180}),{min:s,max:r,step:5}),t.select("Readings",
od,()=>e.document?.readings??"noisy",p=>t.set({readings:p}))];for(let p of a)t.visible(p,()=>e.editable);let c=t.slider("prior",()=>"Prior P(wall)",{low:_e.prior[0],
high:_e.prior[1],step:.01});return t.section("Model",c,...a)}function Sa(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>/auto|gibbs|block/.test(n()),
[s,r]=_e.seed;return t.section("Inference",t.select("Method",nd,n,i=>t.set({method:i})),t.select("Order",rd,()=>e.document?.order??"radial",i=>t.set({order:i}),
()=>n()==="gibbs"||n()==="auto"),t.select("Start",sd,()=>e.document?.start??"auto",i=>t.set({start:i}),o),t.slider("sweeps",()=>ld[n()]??"Sweeps",{low:_e.sweeps[0],
high:_e.sweeps[1],step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,i=>t.set({seed:Math.round(i)}),{min:s,max:r,step:1}))}function Ma(t){let{session:e}=t,
n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),o=t.button(null,"Clear inference",()=>e.act({type:"\
clear",what:"inference"}),{text:"Clear inference"});return t.section("Clear",k("div",{className:"buttons"},n,o))}var ad=0,cs=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${ad++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}endDrag(){
this.drag++}visible(e,n){this.each(()=>z(e,"hidden",!n()))}button(e,n,o,{className:s="",text:r="",when:i,title:a}={}){let c=k("button",{type:"button",className:s,
title:a??n,onclick:o},e&&Zt(e));return r&&c.append(k("span",{textContent:r})),r!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>z(c,"disabled",!i())),c}segmented(e,n,o,s,r){
let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=k("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[c,p,m]of n){let h=k("input",{type:"rad\
io",name:i,value:c,onchange:()=>s(c)});a.append(k("label",{title:p},h,m?Zt(m):null,k("span",{textContent:p}))),this.each(()=>{z(h,"checked",o()===c),r&&z(h,"dis\
abled",!r(c))})}return a}section(e,...n){let o=`${this.prefix}-${e}`;return k("section",{"aria-labelledby":o},k("h2",{id:o,textContent:e}),...n)}row(e,n){return n.
id=`${this.prefix}-${e.replace(/\W/g,"")}`,k("div",{className:"row"},k("label",{for:n.id,textContent:e}),n)}slider(e,n,{low:o,high:s,step:r,log:i=!1,unit:a=""}){
let c=`${this.prefix}-${e}`,p=b=>i?1e3*Math.log(b/o)/Math.log(s/o):b,m=b=>{if(!i)return b;let M=o*(s/o)**(b/1e3),A=M<100?1:10**(Math.floor(Math.log10(M))-1);return he(
Math.round(M/A)*A,o,s)},h=k("label",{for:c}),g=k("input",{type:"range",id:c,...i?{min:0,max:1e3,step:1}:{min:o,max:s,step:r}}),x=k("input",{type:"number",min:String(
o),max:String(s),step:String(r)});return g.addEventListener("input",()=>this.set({[e]:m(Number(g.value))})),g.addEventListener("change",()=>this.endDrag()),x.addEventListener(
"change",()=>{let b=Number(x.value);x.value===""||!Number.isFinite(b)?x.value=String(this.session.document?.[e]):this.set({[e]:i?Math.round(he(b,o,s)):he(b,o,s)}),
this.endDrag()}),this.each(()=>{let b=this.session.document?.[e]??o;z(h,"textContent",n()),Mt(x,"aria-label",`${n()}, number`),m(Number(g.value))!==b&&(g.value=
String(p(b))),Mt(g,"aria-valuetext",`${b}${a}`);let M=100*(p(b)-Number(g.min))/(Number(g.max)-Number(g.min));g.style.setProperty("--fill",`${he(M,0,100)}%`),uo(
x)||z(x,"value",String(b))}),k("div",{className:"row slider"},h,g,x)}select(e,n,o,s,r){let i=k("select",{onchange:()=>s(i.value)});for(let[a,c]of Object.entries(
n))i.append(k("option",{value:a,textContent:c}));return this.each(()=>{z(i,"value",o()),r&&z(i,"disabled",!r())}),this.row(e,i)}numberInput(e,n,o,s={}){let r=k(
"input",{type:"number",...s}),{min:i=-1/0,max:a=1/0}=s;return r.addEventListener("change",()=>{r.value!==""&&Number.isFinite(Number(r.value))&&o(he(Number(r.value),
i,a))}),this.each(()=>{uo(r)||z(r,"value",String(n()))}),this.row(e,r)}checkbox(e,n,o,s=""){let r=k("input",{type:"checkbox",onchange:()=>o(r.checked)});return this.
each(()=>z(r,"checked",n())),k("label",{className:"check",title:s},r,k("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,
s=k("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},Zt("close")),r=k("div",{className:"title"},k("h2",{id:o,textContent:e}),
s),i=k("dialog",{"aria-labelledby":o},r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),
i}};var cd=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"]],ud={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},us=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;showLayer(e){
if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.
view.chain){this.session.act({type:"view",layer:"draw",chain:n,draw:e})}play(e){if(this.playing=e,e){let{draw:n,draws:o}=this.session;this.showDraw(n>=o.count-1?
0:n)}this.session.changed()}playFromStart(){this.showDraw(0),this.playing=!0,this.session.changed()}step(){!this.playing||this.session.shown?.layer!=="draw"||setTimeout(
()=>{if(!this.playing)return;let{draw:e,draws:n}=this.session;e+1>=n.count?this.play(!1):this.showDraw(e+1)},1e3/this.drawsPerSecond)}};function Ta(t,e,n){let{session:o}=t,
s=t.segmented("Show",cd,()=>o.view.layer,c=>e.showLayer(c),c=>c!=="draw"||o.hasDraws),r=(c,p)=>t.checkbox(c,()=>n[p],m=>{n[p]=m,o.changed()}),i=r("True walls","\
truth");t.visible(i,()=>!o.document||o.document.source.kind==="simulation");let a=k("div",{className:"checks",role:"group","aria-label":"Marks"},i,r("Rays","ray\
s"),r("Readings","readings"));return t.section("View",s,pd(t,e),a)}function pd(t,e){let{session:n}=t,o=k("input",{type:"range",min:0,step:1,"aria-label":"Draw n\
umber"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.
count>1}),r=k("output"),i=k("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:p,count:m}=n.
draws;z(o,"max",String(Math.max(0,m-1))),z(o,"disabled",m===0),z(o,"value",String(n.draw));let h=m?`${n.draw+1} of ${m}`:"none kept";Mt(o,"aria-valuetext",h),o.
style.setProperty("--fill",`${m>1?100*n.draw/(m-1):0}%`),z(r,"textContent",h),i.length!==Math.max(1,p)&&i.replaceChildren(...Array.from({length:Math.max(1,p)},(x,b)=>k(
"option",{value:String(b),textContent:`chain ${b+1}`}))),z(i,"value",String(n.view.chain)),z(i,"disabled",p<2),m<2&&e.playing&&e.play(!1);let g=e.playing?"Pause\
 the draws":"Play the draws";s.getAttribute("aria-label")!==g&&(s.setAttribute("aria-label",g),s.replaceChildren(Zt(e.playing?"pause":"play")))});let a=k("selec\
t",{"aria-label":"Speed"});for(let[p,m]of Object.entries(ud))a.append(k("option",{value:p,textContent:m}));a.value=String(e.drawsPerSecond),a.addEventListener("\
change",()=>e.drawsPerSecond=Number(a.value));let c=t.button(null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1});
return t.each(()=>z(a,"disabled",n.draws.count<2)),k("div",{className:"player"},s,o,r,k("div",{className:"buttons wide"},i,a,c))}function Pa(t){let{session:e}=t,
n=k("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=k("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.
section("Scan",k("div",{className:"player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;z(s,"hidden",
r<2),z(n,"max",String(Math.max(0,r-1))),uo(n)||z(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),z(o,
"textContent",`${Number(n.value)+1} / ${r}`)}),s}function Ea(t,e,n){let{shown:o,status:s}=t,r=o?.layer==="draw"?"draw":t.view.layer==="entropy"?"entropy":"mean";return{document:t.effectiveDocument(),generation:t.
generation,painted:o&&{generation:o.generation,layer:r,approximate:o.approximate,sweeps:o.sweeps,method:o.method,rhat:o.rhat,verdict:o.verdict,trace:o.trace,traced:o.
traced,weights:o.weights,ess:o.ess,chain:o.chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(0),walls:t.walls,sensors:t.
document?.sensors??[],scan:t.scan,status:{text:s.text,level:s.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.
decisions.trouble},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.
latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var Aa="bayesmap-token",Tr="bayesmap-kept";function dd(t){try{return localStorage.getItem(t)}catch{return null}}function Pr(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function Er(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Pr(Tr,JSON.stringify(t))}function Ca(){
Pr(Tr,null)}function _a(){let t=dd(Tr);try{return t&&JSON.parse(t)}catch{return null}}function La(t){t&&Pr(Aa,t)}function Da(t){let e=n=>{n.key===Aa&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var Ra=new Set(["walls","sensor","set","view","live"]);function Na(t,e){let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*
s+i]=e.wall?1:0;else if(e.type==="set")Object.assign(n,e.patch);else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,
chain:e.chain??t.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let r=n.sensors.find(i=>i.id===e.id);r&&Object.assign(r,{x:e.x,y:e.y,yaw:e.
yaw})}}var ps=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.trouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.session.
changed())}forget(){this.start=this.goal=this.path=this.views=null,this.askedPath=this.askedViews="",this.version++}ask(){let{session:e,start:n,goal:o,radius:s,
risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;let a=`${i.generation} ${e.sampling}`,c=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&
!i.approximate&&c!==this.askedPath&&(this.askedPath=c,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.
method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){this.trouble=e.type==="undecided"?e.text:"",e.type==="path"&&
(this.path=e),e.type==="views"&&this.looking&&(this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}),e.type==="undecided"&&(this.path=null),this.version++}nearest(e){
let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<n.nats.length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,
s]=[r,i])}return o}};var ds=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var fs=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var fd=new Set(["inspect","path","views"]),hs=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=s;e.onmessage=(r,i)=>this.
receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={layer:"mean",chain:0,
draw:null};state=null;scan=null;shown=null;cell=null;worker="starting";recorded=!1;generation=-1;acted=0;decisions=new ps(this);status=new ls;progress=new fs;latency=new ds;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,text:""};get shape(){
return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get running(){return!!this.state?.
running}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&(this.running||this.
state?.live))}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){
return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){
if(!this.document&&e.type!=="hello")return;let o={...e,seq:++this.seq};fd.has(e.type)||(this.acted=this.seq),Ra.has(e.type)&&(this.pending.push(o),this.foresee(
o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&Er(this.portableDocument()),this.changed()}bring(e){this.
act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.wallsVersion&&(this.packed=
{version:this.wallsVersion,text:Co(li(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.effectiveDocument();
return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,!0)}painted(){this.counts.
paints++,this.shown&&this.latency.painted(this.shown.generation),this.decisions.ask()}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.
shown):null}onstatus(e){if(this.connection=e,e.connected){let n=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.
bring(n),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.
notice.text,this.notice.level),this.everConnected=!0,Ca()}else this.everConnected&&(this.say("Connection lost","error"),Er(this.portableDocument()));this.changed()}receive(e,n){
switch(e.type){case"welcome":this.generation=-1,this.recorded=!!e.recorded,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"\
scan":if(e.generation>=this.generation){let{pose:o,angles:s,ranges:r,exact:i,hit:a}=n;this.scan={ids:e.ids??[],index:e.index??null,pose:o,angles:s,ranges:r,exact:i,
hit:a}}break;case"field":this.receiveField(e,n);break;case"cell":this.cell={x:e.x,y:e.y,beams:e.beams};break;case"path":case"views":case"undecided":this.decisions.
receive(e,n);break;case"status":this.status.say(e.text,e.level??"info",this.acted);break;case"error":this.receiveError(e);break;case"worker":this.worker=e.state,
this.status.worker(e.state);break;case"download":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveError(e){
let n=e.refused?.seq??null;n!==null&&n===this.broughtAt&&(this.broughtAt=null,this.act({type:"hello"})),this.status.say([e.text,e.remedy].filter(Boolean).join("\
; "),"error",this.acted),this.pending=this.pending.filter(o=>o.seq!==n),n!==null&&this.latency.refused(n),this.rebuild()}receiveState(e){this.status.confirmed(e.
seq),this.state=e,this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.
seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,
a=n.observed,c=this.next??this.shown,m=c&&c.p.length===o.length&&c.bits.every((h,g)=>h===a[g])?{observed:c.observed,bits:c.bits}:{observed:io(a,o.length),bits:a};
this.next={...e,p:o,trace:s,traced:r,weights:i,...m},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,
s=this.confirmedWalls;if((e.walls!==s.text||s.walls.length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:io(Ut(e.walls),n*o)}),this.document={...e,sensors:e.
sensors.map(r=>({...r}))},(this.confirmedWalls!==s||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),this.
state.view&&!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r??"mean",chain:i??0,draw:a??null}}for(let r of this.
pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Na(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Oa='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Fa=`:host { display: block; height: 100dvh; container-type: size; }
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
`;var Ua="bayesmap-theme",Ia={auto:"light",light:"dark",dark:"auto"},ms=class{constructor(e,n){this.app=e;this.dressed=n;let o=gd();o&&o in Ia&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=Ho.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?Ho.dark:Ho.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:c}=n;for(let[p,m]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:c}))this.app.style.setProperty(`--${p}`,m);this.dressed(
this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Ia[this.choice];try{localStorage.setItem(Ua,this.choice)}catch{}this.dress()}destroy(){this.media.
removeEventListener("change",this.listen)}};function gd(){try{return localStorage.getItem(Ua)}catch{return null}}function gs(t,e,{embedded:n=!1,adopt:o=null,notice:s=null}={}){let r=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(Oa+Fa),r.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,c=()=>{a||=requestAnimationFrame(Ie)},p=new hs(e,c,o,s),m=new On,h=new Oo(p),g=new No(p,h),x=new us(p),b=new cs(
p,h,g,ie,Y=>x.showLayer(Y),n),M=[new Un,new Vn,new zn,new In,new zo],A=M.map(({name:Y})=>k("canvas",{className:Y})),L=A[A.length-1];Object.assign(L,{tabIndex:0,
role:"application"});let S=new Wo(M,A);new Uo(L,p,m,h,g,n);let _=new Fo(L,p,m,h,g),T={truth:!0,rays:!0,readings:!0},j=fa(b),D=Di(b),Z={chip:ya(b),banner:ba(b)},
G=k("main",{className:"stage"},...A,Z.chip,Z.banner),R=()=>X.theme,V=ha(b,R),E=wa(b);L.setAttribute("aria-describedby",E.readout.id);let q=da(b),U={help:ua(b),new:pa(
b),share:q.dialog},[K,W,ne,$]=[va(b),ka(b),Sa(b),Ma(b)],Ke=[ca(b),xa(b,la(b,R),aa(b,R)),Ta(b,x,T),Pa(b),K,W,ne,$],me=k("aside",{"aria-label":"Controls"},...Ke),
se=()=>p.recorded||p.document?.source.kind==="run";b.visible(K,()=>p.editable),b.visible(W,()=>!se()),b.visible(ne,()=>!se()),b.visible($,()=>!se()),b.each(()=>{
z(D,"inert",!p.document),z(me,"inert",!p.document)});let ce=k("div",{className:"app"},j.element,D,G,V,me,E.element,...Object.values(U));r.replaceChildren(ce);let X=new ms(
ce,Y=>{j.nameTheme(Y),c()}),H=()=>{let Y=p.editable&&h.tool==="sensor"?h.sensor?.id??null:null;return{session:p,view:m,look:{theme:X.theme,...T,hover:h.hover,cursor:h.
cursor,selected:Y}}},Pe="";function Ie(){a=0;let Y=p.take();p.document&&String(p.shape)!==Pe&&(Pe=String(p.shape),m.fit(p.shape),h.cursor=h.hover=null,p.decisions.
forget(),L.setAttribute("aria-label",`Map, ${p.shape[0]} by ${p.shape[1]} cells`)),S.paint(H()),Y&&(p.painted(),x.step());let{x:te,y:De}=m.transform;Z.chip.style.
transform=`translate(${Math.max(te,je.left)}px, ${Math.max(De-28,6)}px)`,Mt(L,"data-tool",p.editable||zt.has(h.tool)?h.tool:"pan"),b.refresh()}let ge=new ResizeObserver(
()=>{let{width:Y,height:te}=G.getBoundingClientRect();!Y||!te||(m.resize(Y,te,devicePixelRatio||1),m.fitted&&m.fit(p.shape),cancelAnimationFrame(a),Ie())});ge.observe(
G);async function ie(Y){if(Y==="in"||Y==="out")m.zoom(Y==="in"?1.4:1/1.4,m.middle,p.shape);else if(Y==="fit")m.fit(p.shape);else if(Y==="help")U.help.showModal();else if(Y===
"new")U.new.showModal();else if(Y==="theme")X.next();else if(Y==="add")_.addSensor();else if(Y==="share"){let te=p.portableDocument();te&&q.show(location.origin+
location.pathname+await ui(te))}else if(Y==="export png"){let te=await Li(H());te&&js("bayesmap.png",te),p.say("Saved bayesmap.png")}else Y.startsWith("export ")&&
p.act({type:"export",what:Y.slice(7)});c()}p.ondownload=(Y,te,De)=>js(Y,new Blob([De],{type:te}));let ot=[[n?t:window,"keydown",Y=>{Y.defaultPrevented||!p.document||
Object.values(U).some(te=>te.open)||vi(Y,p,{tool:te=>{h.choose(te),_.focus()},layer:te=>x.showLayer(te),command:ie})}],[window,"online",()=>e.retry?.()],[window,
"hashchange",async()=>{if(n)return;let{document:Y,damaged:te}=await Do();Y?p.bring(Y):te&&p.say(Lo,"error")}]];for(let[Y,te,De]of ot)Y.addEventListener(te,De);return X.
dress(),e.open(),{destroy(){ge.disconnect(),cancelAnimationFrame(a),X.destroy();for(let[Y,te,De]of ot)Y.removeEventListener(te,De);e.close(),r.replaceChildren()},
snapshot:()=>Ea(p,m,S),cellToClient(Y,te){let De=L.getBoundingClientRect(),Ot=m.fromGrid({x:Y+.5,y:te+.5},p.shape[1]);return{x:De.left+Ot.x,y:De.top+Ot.y}}}}var Ar={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},za=8,Zn=()=>({onmessage:()=>{},onstatus:()=>{}});function Va(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers){let c=a.reduce((p,m)=>p*m,1)*Ar[i].BYTES_PER_ELEMENT;
o[r]=new Ar[i](t.slice(s,s+c)),s+=Math.ceil(c/za)*za}return[n,o]}function Ha(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{let{buffer:i,byteOffset:a,
byteLength:c}=e[r];n[o]=new Ar[s](i.slice(a,a+c))}),n}function Wa(t){let{document:e,scans:n,settings:o={},log_joint:s=[]}=t,r=e.grid.shape[0]*e.grid.shape[1],i=t.draws?.count??0,a=e.source.kind!=="simulation",c=Ut(
t.mean),p=Ut(t.observed),m=null,h=0,g={layer:"mean",chain:0,draw:null},x=R=>a?[R[h]]:R,b=R=>Float32Array.from(x(R).flat(),V=>V??1/0),M=n.angles.length,A=io(Ut(n.
hit),n.pose.length*M),L=()=>a?A.subarray(h*M,(h+1)*M):A,S=Float32Array.from(s.flat()),_=(o.sweeps??i)/Math.max(1,i),T=Float32Array.from(s[0]??[],(R,V)=>(V+1)*_),
j=R=>{let V={chains:t.draws?.chains??0,count:m?i:0},E={generation:1,can_undo:!1,can_redo:!1,live:!1,running:!1};G.onmessage({type:"state",document:e,seq:R,...E,
draws:V,view:g},{})},D=()=>{let R=Float64Array.from(x(n.pose).flat(),Number),V={type:"scan",generation:1,ids:a?[h]:n.ids,index:a?h:null},E=n.exact?.length?b(n.exact):
new Float32Array(0);G.onmessage(V,{pose:R,angles:Float32Array.from(n.angles),ranges:b(n.ranges),exact:E,hit:L()})},Z=()=>{let R=g.layer==="draw"&&m?yd(m,g.chain*
i+(g.draw??i-1),r):null,V=s[g.chain]?.[(g.layer==="draw"?g.draw:null)??i-1]??null,E=R?{...g,draw:g.draw??i-1}:{layer:g.layer==="draw"?"mean":g.layer},q=o.sweeps??
i,U={sweeps:q,total:q,ess:o.ess,rhat:o.rhat,verdict:o.verdict,log_joint:V},K=o.method??e.method,W={p:R??c,observed:p,trace:S,traced:T};G.onmessage({type:"field",
generation:1,...E,method:K,approximate:!1,...U},W)},G={...Zn(),open:()=>G.onstatus({connected:!0}),send:R=>{if(R.type==="hello"){if(G.onmessage({type:"welcome",
version:1,recorded:!0},{}),j(R.seq),D(),Z(),!i||!t.draws)return;_o(Ut(t.draws.data)).then(V=>{m=V,j(R.seq)})}else if(R.type==="view")g={layer:R.layer,chain:R.chain??
g.chain,draw:R.draw??null},j(R.seq),Z();else if(R.type==="scan")h=R.index,j(R.seq),D();else if(R.type==="inspect"){let V=bd(e,n.angles,x(n.pose),x(n.ranges),R.x,
R.y);G.onmessage({type:"cell",x:R.x,y:R.y,beams:V},{})}},close:()=>{}};return G}function yd(t,e,n){let o=e*n;return Uint8Array.from({length:n},(s,r)=>t[o+r>>3]>>
7-(o+r&7)&1?255:0)}function bd({grid:t},e,n,o,s,r){let{origin:i,resolution:a}=t,c=[i[0]+s*a,i[1]+r*a],p=0;return n.forEach((m,h)=>{let[g,x,b]=m.map(Number);e.forEach(
(M,A)=>{let[L,S]=[Math.cos(M+b),Math.sin(M+b)],_=[(c[0]-g)/L,(c[0]+a-g)/L,(c[1]-x)/S,(c[1]+a-x)/S],T=Math.max(0,Math.min(_[0],_[1]),Math.min(_[2],_[3])),j=Math.
min(o[h][A]??1/0,Math.max(_[0],_[1]),Math.max(_[2],_[3]));T<j&&p++})}),p}var Cr=250,wd=8e3;function Ga(t){let e=null,n=Cr,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let c=new WebSocket(a),p=!1;e=c,c.binaryType="arraybuffer",c.onopen=()=>{p=!0,n=Cr,i.onstatus({connected:!0})},c.onmessage=({data:m})=>{typeof m==
"string"?i.onmessage(JSON.parse(m),{}):i.onmessage(...Va(m))},c.onclose=()=>{if(s||e!==c)return;o=window.setTimeout(r,n);let m={connected:!1,retryIn_ms:n};i.onstatus(
m),p||xd(t()).then(h=>h&&e===c&&i.onstatus({...m,refused:h})),n=Math.min(wd,2*n)}}let i={...Zn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=Cr,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};return i}async function xd(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function $a(t){let e=(o,s=[])=>n.onmessage(o,Ha(o,s)),n={...Zn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var vd="This is the map that was drawn here when the connection was lost; undo leads back",_r=t=>Object.assign(window,{bayesmap:t}),km={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=gs(n,$a(t),{embedded:!0});return _r(o),()=>o.destroy()}};async function kd(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){_r(gs(t,Wa(JSON.parse(n.textContent??""))));return}La(new URLSearchParams(location.search).get("token"));let{document:o,damaged:s}=await Do(),
r=o?null:_a(),i=Ga(()=>new URL(location.href));Da(c=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(c)}${location.hash}`),i.retry?.()}),
_r(gs(t,i,{adopt:o??r,notice:s?{text:Lo,level:"error"}:r?{text:vd,level:"info"}:null}))}kd();export{km as default,gs as mount,Wa as recordedTransport,Ga as webSocketTransport,$a as widgetTransport};
