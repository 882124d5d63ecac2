// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function go(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Li(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function zt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Io(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Di(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Uo=t=>Di(t,new DecompressionStream("deflate-raw")),Ni=t=>Di(t,new CompressionStream("deflate-r\
aw"));async function Ri(t){let e=await Ni(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Io(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function pu(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Uo(zt(e[1]))))}var Wo="The link's map cannot be read: copy the link again, who\
le";async function Go(){let t=await pu(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var ie=(t,e,n)=>Math.min(n,Math.max(e,t)),Jt=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,De=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),sr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function hn(t,e){let{x:n,y:o}=De(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Un=(t,e)=>sr({x:t.x+.5,y:t.y+.5},e);
function Fi(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function $i(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&s(r-1,i)!==s(r,i);l&&a<0&&(a=i),!l&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&s(i,r-1)!==s(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var yo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Oi(t,e,n){let o=Ui(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Wi(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Ii(t,e){
let n=du(e,t.grid.shape),o=Ui(t);return Wi(t,(s,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let l of o)a=Math.min(a,Math.hypot(s-l.x,r-l.y));return a>0?a:-1/0})}
var Ui=({sensors:t,grid:e})=>t.map(n=>hn(n,e));function Wi(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let l=e(i,a,i*o+a);
l>r&&([s,r]=[{x:i,y:a},l])}return s&&Un(s,t.grid)}function du(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)o[r*n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),
s(r+1,i-1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var Se={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],fov_deg:[5,360],pose_sigma:[0,2],heading_sigma_deg:[0,30],sweeps:[1,
1e5],seed:[0,2147483647],side_of_log:1e3};var zo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Jt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(u=>hn(u,r.grid)):[],l=new Map;for(let u of e)!Jt(u,i)||this.isWall(u)===n||a.some(h=>h.x===
u.x&&h.y===u.y)||l.set(u.x*i[1]+u.y,[u.x,u.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"sensor",op:"move",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?Ii(o,n.walls):"world"in e?e.world:Oi(o,n.walls,e.near);s?o.sensors.length>=Se.sensors?n.say(`There can be ${Se.sensors}\
 sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"sensor",op:"add",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=Math.
max(0,...o.sensors.map(r=>r.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sen\
sor",op:"remove",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=hn(e,n.document.grid),s=this.isWall(o);return!s&&Jt(o,n.shape)?(n.status.
text.startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var _t=new Set(["pan","path","look","where","ghost"]),hu=120,Ho=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.ghost.hold(e==="ghost"),this.session.changed()}select(e){this.selected=e,this.
session.changed()}point(e){let n=e&&Jt(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){
!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.
act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},hu))}};var Je={left:36,right:12,top:34,bottom:26},fu=60,mu=160,Wn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-Je.left-Je.right,y:this.height-Je.
top-Je.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:Je.left+(o.x-
s*e)/2,y:Je.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,o){let{scale:s}=this.transform,{x:r,
y:i}=this.corner,a=ie(s*e,Math.min(this.width,this.height)/Math.max(...o)/3,mu),l=a/s;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.
x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=fu;this.corner.
x=ie(this.corner.x,s-e*o,this.width-s),this.corner.y=ie(this.corner.y,s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};function Vo(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,l]=r.pose.
subarray(3*s,3*s+3),u=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m would\
 tell ${u}`)}var Vi=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W, O","where am I, ghost","asked"],["arrows","move the cursor, th\
e sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["Space","at the cursor: start or goal \
of a path, or where to look from","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, Delete","add, remove a sensor","drawn"],["R, Escape","run, ca\
ncel","inferred"],["M, N, H","show the mean, a draw, the entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","asked"],["+, −, 0","zoom in, out, whole map"],
["?","this help"]],gu={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},Gi=Math.PI/12,Bo=class{constructor(e,n,o,s,r){this.canvas=e;this.session=
n;this.view=o;this.hand=s;this.editor=r;e.addEventListener("keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.
pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)
return;let r=gu[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?Gi:
-Gi;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.
toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)s.removeSensor();else if(e.key==="Escape"&&o.cursor)
o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is \
room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&o.ghost.pose&&o.document){let{resolution:l}=o.document.grid,{x:u,y:h}=o.ghost.
pose;o.ghost.move({x:u+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&r.sensor&&o.document&&o.editable){let{resolution:l}=o.document.grid;r.selected=
r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let l=r.
cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},u={x:ie(l.x+e,0,i-1),y:ie(l.y+n,0,a-1)};r.setCursor(u);let h=s.fromGrid({x:u.x+.5,y:u.y+.5},a),d=(b,y,M)=>b-ie(b,y,
M),f={x:d(h.x,Je.left+10,s.width-20),y:d(h.y,20,s.height-Je.bottom-10)};(f.x||f.y)&&s.pan(-f.x,-f.y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if((o.
tool==="path"||o.tool==="look")&&n.document){o.cursor?Vo(n,o,s,Un(o.cursor,n.document.grid)):this.arrow(0,0);return}if(n.editable){if(o.tool==="sensor"||o.tool===
"where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,r.length)]?.id??null),o.selected!==null&&o.announce(`Se\
nsor ${o.selected}`)}else if(!_t.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.announce(
i?"wall":"free")}}}},rr={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost"},zi={m:"mean",n:"draw",h:"entropy"},Hi={"+":"in","=":"in","\
-":"out",0:"fit","?":"help"};function Bi(t,e,n){let o=t.composedPath()[0],s=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.
type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"\
redo":"undo"});return}if(!(s||t.altKey)){if(rr[r]&&(e.editable||_t.has(rr[r])&&!e.recorded))n.tool(rr[r]);else if(zi[r])n.layer(r==="h"&&e.quantity.interval?"wi\
dth":zi[r]);else if(Hi[t.key])n.command(Hi[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&(e.running||e.working))e.act({type:"\
cancel"});else return;t.preventDefault()}}var jo=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:u,context:h,layer:d}=l,f=d.shows?.(e)??!0,b=[f,...f?[...a,...d.depends(e)]:[]];b.length===
l.before.length&&b.every((y,M)=>Object.is(y,l.before[M]))||(l.before=b,u.style.visibility=f?"":"hidden",f&&((u.width!==i.width||u.height!==i.height)&&(Object.assign(
u,i),u.style.width=`${i.width/s}px`,u.style.height=`${i.height/s}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,u.width,u.height),h.setTransform(s,0,0,s,0,0),
h.save(),d.paint(h,e),h.restore(),this.paints[d.name]++))}}};function Be(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,o*r,s*r),t.clip()}function wo(t,{halo:e},n,o){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}var ir='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Zt(t,e,n,o,s,r,i=!1){t.font=ir,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}function ar({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Qt(t,e,n){let o=n.fromGrid(De(t,e),e.shape[1]),s=ie(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function ji(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=ar(e);t.lineJoin=
"round";for(let a of i){let l=Qt(a,s.grid,n),{point:u,size:h}=l;a.id===o.selected&&yu(t,l,o);let[d,f]=[Math.cos(a.yaw),-Math.sin(a.yaw)],b=(y,M)=>[u.x+h*(y*d-M*
f),u.y+h*(y*f+M*d)];t.beginPath(),t.moveTo(...b(1.25,0)),t.lineTo(...b(-.9,.8)),t.lineTo(...b(-.45,0)),t.lineTo(...b(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Zt(t,String(a.id),u.x,u.y+h*2+4,r,"center",!0)}}function yu(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),wo(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function qi(t,e,n,o,s){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&Qt({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Ki(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var Yi={touch:24,other:11},wu=5,bu=90,qo=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(l,u)=>e.
addEventListener(l,u,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return sr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(qi(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&(o.tool==="path"||o.tool===
"look"))return this.begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(
i.id),this.begin(i);if(e.button===1||_t.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="se\
nsor"&&o.select(a.id);else if(o.tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"s\
ensor",id:o.sensor.id,drag:o.nextGesture(),grip:{x:0,y:0}}),this.dragSensor(e));else{let l=o.tool==="draw"!==(e.button===2||e.shiftKey),u=this.cellAt(r),h=l&&this.
editor.isWall(u);this.begin({kind:"stroke",id:o.nextGesture(),wall:l,last:u,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),
bu)}}gripAt(e,n,o){let{hand:s,view:r}=this,i=this.reach(n),a=f=>Math.hypot(e.x-f.x,e.y-f.y),l=s.tool==="sensor"&&s.sensor?Qt(s.sensor,o.grid,r):null;if(l&&s.sensor&&
a(l.handle)<Math.min(i,a(l.point)))return{kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let u=o.sensors.map(f=>({
id:f.id,...Qt(f,o.grid,r)}));u.sort((f,b)=>a(f.point)-a(b.point));let h=u.find(({point:f,size:b})=>a(f)<Math.max(i,b));if(!h)return null;let d={x:h.point.x-e.x,
y:h.point.y-e.y};return{kind:"sensor",id:h.id,drag:s.nextGesture(),grip:d}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.
held;this.gesture.held=null,this.stroke([this.gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&
this.fingers.set(e.pointerId,i),!n)r.point(this.cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();
let a=[],l=e.getCoalescedEvents?.()??[];for(let u of l.length?l:[e]){let h=this.cellAt(this.at(u));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(...Fi(
n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(u=>u.id===
n.id);if(!a||!o.document)return;let l=this.metres(i,o.document);this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.
hypot(i.x-n.first.x,i.y-n.first.y)>wu&&this.begin({kind:"pan",last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.
fingers.size===2){let{middle:a,spread:l}=this.spread();s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(l/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:l}),
o.changed()}}up(e){e.type==="pointerup"&&this.release(),e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.
last],!1,this.gesture.id,e),e.type==="pointerup"&&this.gesture?.kind==="pick"&&this.session.document&&Vo(this.session,this.hand,this.editor,this.metres(this.gesture.
first,this.session.document)),this.fingers.delete(e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=
e.pointerType==="touch",this.touched&&(this.hand.point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?Yi.touch:Yi.other}pointAtReading(e){
let{document:n,reading:o,ghost:s}=this.session;if(!n||s.held)return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(
e)*r)}dragGhost(e){let{gesture:n,session:o}=this;if(n?.kind!=="ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);Ki(o.ghost,n,this.metres({x:s.x+
n.grip.x,y:s.y+n.grip.y},o.document))}spread(){let[e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-
n.x,e.y-n.y))}}wheel(e){if(!this.session.document)return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();
let o=e.deltaMode===1?16:1;e.shiftKey?this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.
at(e),this.session.shape),this.session.changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level===
"error"&&o.say("Ready"))}dragSensor(e){let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(
l=>l.id===n.id),i=this.at(e),a=this.metres({x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var xu=5,Ko=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(Je.left,0,o.width,o.height-Je.bottom),e.clip(),s.hover&&Ji(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&Ji(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function Ji(t,e,n,o,s,r,i){let{scale:a}=o.transform,l=o.fromGrid({x:e.x,y:e.y+1},n),u=Math.max(a,xu),[h,d]=[l.x-(u-a)/2,l.y-(u-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(h,d,u,u),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,d,u,u)}var vu={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},ku={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},Jo={light:vu,dark:ku},Zi="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Su([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((l,u)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*s[u]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let u=ie(l,0,1);return Math.round(255*(u<=.0031308?12.92*u:1.055*u**(1/2.4)-.055))})}var Yo=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),lr=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),cr=(t,e)=>Su(lr(t.paper,t.ink,e));function Gn(t){let e=Math.min(15,Math.floor(
t*16));return lr(Yo(Zi,6*e),Yo(Zi,6*e+6),t*16-e)}function Qi(t,e){let n=new Uint8ClampedArray(2048).fill(255),[o,s]=[Yo(t.unobserved),Yo(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?yo(r/255):r/255;n.set(e==="value"?cr(t,r/255):Gn(i),4*r),n.set(lr(o,s,e==="value"?r/255:0),4*(r+256))}return new Uint32Array(n.buffer)}
var ur=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var Mu=9,Tu=2.5,zn=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start||e.looking&&e.views))}paint(e,n){let{session:o}=n;o.document&&(Be(e,n),o.decisions.looking&&this.views(e,n),this.path(e,n))}views(e,{session:n,
view:o,look:s}){let{views:r}=n.decisions,i=n.document?.grid;if(!r?.nats.length||!i)return;let[a,l]=[Math.min(...r.nats),Math.max(...r.nats)],u=ie(.38*r.spacing*
o.transform.scale/i.resolution,Tu,Mu),h=r.nats.indexOf(l);for(let d=0;d<r.nats.length;d++){let f=o.fromGrid(De({x:r.pose[3*d],y:r.pose[3*d+1]},i),i.shape[1]);e.
beginPath(),e.arc(f.x,f.y,u,0,2*Math.PI),e.fillStyle=`rgb(${Gn(ie((r.nats[d]-a)/Math.max(l-a,1e-9),0,1)).map(Math.round)})`,e.fill(),d===h&&(e.lineWidth=2.5,e.strokeStyle=
s.theme.truth,e.stroke())}}path(e,{session:n,view:o,look:s}){let{start:r,goal:i,path:a,radius:l}=n.decisions,u=n.document?.grid;if(!u||!r)return;let h=d=>o.fromGrid(
De(d,u),u.shape[1]);if(a){e.beginPath();for(let[d,f]of a.path){let b=h({x:d,y:f});e.lineTo(b.x,b.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=a.within_risk?s.theme.
sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*l*o.transform.scale/u.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let d of i?[r,i]:[r]){
let{x:f,y:b}=h(d);e.beginPath(),e.arc(f,b,5,0,2*Math.PI),e.fillStyle=d===r?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}}};var Pu=10,Eu=7,_u=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Zo=()=>document.createElement("canvas").getContext("2d"),Hn=class{name="\
field";cells=Zo();mask=Zo();hatch=Zo();palettes=new Map;image=new ImageData(1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.
flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:l,x:u,y:h}=s.transform;Be(e,n);let d=o.flicker.under??o.shown;if(!d||d.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
u,h,i*l,a*l);return}this.fill(d,i,a,r.theme,_u(d,o.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,u,h,i*l,a*l),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),l>=Pu&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:l}=this,
u=`${s.ground} ${r}`;if(l.field===e&&l.palette===u)return;let h=this.palettes.get(u)??Qi(s,r);if(this.palettes.set(u,h),this.image.width!==n||this.image.height!==
o){this.image=new ImageData(n,o);for(let{canvas:f}of[i,a])Object.assign(f,{width:n,height:o});l.bits=null}let d=new Uint32Array(this.image.data.buffer);for(let f=0,
b=0;f<o;f++)for(let y=o-1-f;y<n*o;y+=o)d[b++]=h[e.p[y]+(e.observed[y]?0:256)];if(i.putImageData(this.image,0,0),l.bits!==e.bits){for(let f=0,b=0;f<o;f++)for(let y=o-
1-f;y<n*o;y+=o)d[b++]=e.observed[y]?0:4278190080;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,bits:e.bits,palette:u})}fillHatch({session:e,
view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:l,height:u}=n,{scale:h,x:d,y:f}=n.transform,[b,y]=e.shape,M=[o.theme.ground,h,d,f,l,u,a].join(" ");
if(i.hatch===M)return;i.hatch=M;let S=Zo(),P=S.canvas.width=S.canvas.height=Math.round(Eu*a);S.strokeStyle=o.theme.hatch,S.lineWidth=a,S.beginPath();for(let _ of[
-P,0,P])S.moveTo(_-1,P+1),S.lineTo(_+P+1,-1);S.stroke(),Object.assign(s.canvas,{width:Math.ceil(l*a),height:Math.ceil(u*a)}),s.setTransform(a,0,0,a,0,0),s.imageSmoothingEnabled=
!1,s.drawImage(r.canvas,d,f,b*h,y*h),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let k=s.createPattern(S.canvas,"repeat");k.setTransform(
new DOMMatrix().translate(Math.round(d*a),Math.round(f*a))),s.fillStyle=k,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,view:o,look:s}){let[
r,i]=n.shape,{scale:a,x:l,y:u}=o.transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,u),e.lineTo(l+h*a,u+i*a);for(let h=1;h<i;h++)e.moveTo(l,u+h*a),e.lineTo(
l+r*a,u+h*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var Au=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],Vn=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(Be(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(l,u)=>{let h=ie(r[u],0,a),d=o.yaw+l,f={x:o.x+h*Math.cos(d),y:o.y+h*Math.sin(d)};return n.fromGrid(De(f,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(y=>this.ends(n,o,o.angles,y)),{grid:l}=n.session.document,u=n.view.fromGrid(De(o,l),l.shape[1]),h=new Path2D;
h.moveTo(u.x,u.y);for(let{x:y,y:M}of r)h.lineTo(y,M);h.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(h);let d=new Path2D,f=new Path2D,b=ie(n.view.transform.
scale*.12,1.2,3);for(let y=0;y<r.length;y++)d.moveTo(r[y].x,r[y].y),d.lineTo(a[y].x,a[y].y),Number.isFinite(o.median[y])&&f.rect(i[y].x-b,i[y].y-b,2*b,2*b);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=ie(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(d),e.globalAlpha=1,f}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,l=ie(n.view.transform.scale*.14,1.5,4),u=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),h=new Path2D;u.forEach(({x:d,y:f},b)=>{i[b]&&
(h.moveTo(d+l,f),h.arc(d,f,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:l,handle:u}=Qt({id:0,...r},i,o),[h,d]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(u.x,u.y),wo(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[f,b]of Au)e.lineTo(a.x+l*(f*h-b*d),a.y+l*(f*d+b*h));e.closePath(),e.lineJoin="round",wo(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(u.x,u.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var Bn=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:o,view:s,look:r}=n,i=o.flicker.under&&o.shown;if(!i)return;let[a,l]=o.shape,
{scale:u,x:h,y:d}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Be(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,d,a*u,l*u)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(u=>parseInt(s.slice(u,u+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let l=new ImageData(
n,o);for(let u=0,h=0;u<o;u++)for(let d=o-1-u;d<n*o;d+=o,h+=4)l.data.set([r,i,a,e.observed[d]?e.p[d]:0],h);this.cells.putImageData(l,0,0),this.drawn={field:e,colour:s}}};var Cu=46,Lu=22;function Du(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function Xi(t,{session:e,view:n,look:o}){if(!e.document)
return;let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:l,shape:u}=e.document.grid,{scale:h,x:d,y:f}=n.transform,b=Du(Cu/h*l),y=Math.min(f+u[1]*h,i-Je.bottom)+
.5,M=Math.max(d,Je.left)-.5;t.fillStyle=s.ground,d<M&&t.fillRect(0,0,M,i+1),f+u[1]*h>y&&t.fillRect(0,y,r+1,i+1-y);let S=Math.max(0,-Math.floor(Math.log10(b)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let P=_=>Math.ceil(a[_]/b-1e-9)*b,k=_=>a[_]+u[_]*l+1e-9;for(let _=P(0);_<=k(0);_+=b){let E=d+(_-a[0])/l*h;E<M||
E>r-4||(t.moveTo(E,y),t.lineTo(E,y+4),Zt(t,_.toFixed(S),E,y+12,s,"center"))}for(let _=P(1);_<=k(1);_+=b){let E=f+(u[1]-(_-a[1])/l)*h;E>y||E<4||(t.moveTo(M,E),t.
lineTo(M-4,E),Zt(t,_.toFixed(S),M-7,E,s,"right"))}t.stroke(),Zt(t,"m",M-Lu,y+12,s,"right")}var jn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=ar(e).flatMap(({id:i,x:a,y:l,yaw:u})=>[i,a,l,u]),{grid:s}=e.document??{},
r=ea(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:u,y:h}=s.transform;r.truth&&ea(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(u-.5,h-.5,i*l+1,a*l+1),ji(e,n),Xi(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:l}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=$i(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),Be(e,n),e.transform(i,0,0,-i,a,l+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=ie(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},ea=({document:t})=>t?.source.kind==="simulation";var Nu=600,Ru=1500,Fu=65536,pr=.3,qn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;if(!i||!a)return;
Be(e,n);let{scale:l}=s.transform,u=1/a.grid.resolution,h=a.grid.shape[1],d=i.angles.length,f=i.pose.length/3,b=Math.ceil(d*f/Ru),[y,M,S]=[new Path2D,new Path2D,
new Path2D],P=d*f>Nu,k=new Map,_=ie(l*.1,1.3,4),E=a.scans_used??1/0,q=(i.index??0)<E?1:pr;for(let N=0;N<f;N++){let[Y,V,R]=i.pose.subarray(3*N,3*N+3),W=s.fromGrid(
De({x:Y,y:V},a.grid),h);for(let L=0;L<d;L++){let Z=i.ranges[N*d+L],I=i.hit[N*d+L]===1,j=(I?Z:a.max_range)*u*l,z=i.angles[L]+R,Q={x:W.x+j*Math.cos(z),y:W.y-j*Math.
sin(z)},H=I?y:M;(N*d+L)%b===0&&(H.moveTo(W.x,W.y),H.lineTo(Q.x,Q.y)),I&&(P?k.set(Math.round(Q.x)*Fu+Math.round(Q.y),Q):(S.moveTo(Q.x+_,Q.y),S.arc(Q.x,Q.y,_,0,2*
Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=q*ie(28/Math.sqrt(d*f/b)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(y),e.strokeStyle=r.theme.noReturn,e.stroke(
M),e.globalAlpha=1),r.readings){e.globalAlpha=q,e.fillStyle=r.theme.ray,e.fill(S);let N=1.8*_;for(let{x:Y,y:V}of k.values())e.fillRect(Y-N/2,V-N/2,N,N);e.globalAlpha=
1}}};var $u=2.5,bo=t=>t>=$u,Kn=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(Be(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&bo(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[u,h,d]of[[0,l,.6],
[Math.max(0,l-1),a,.6*pr]]){e.beginPath();for(let f=u;f<h;f++){let b=o.fromGrid(De({x:r[2*f],y:r[2*f+1]},i),i.shape[1]);e.lineTo(b.x,b.y)}e.globalAlpha=d,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,u,h,d]=r.subarray(a,a+4),[f,
b]=[o.fromGrid(De({x:l,y:u},i),i.shape[1]),o.fromGrid(De({x:h,y:d},i),i.shape[1])];e.moveTo(f.x,f.y),e.lineTo(b.x,b.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=ie(o.transform.scale/5,.8,2.5),e.stroke()}}};var Ou=2.2,Qo=7,[Iu,Uu]=[.03,.75],Wu=2.4477,ta=9,Yn=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!(!s||!r)){Be(e,n),this.
cloud(e,n,r);for(let i of s.modes)this.place(e,n,r,i,s.modes.length>1)}}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||
1;e.strokeStyle=e.fillStyle=s.theme.belief,e.lineWidth=1.2;for(let u=0;u<a.length;u++){if(a[u]<Iu**2*l)continue;let[h,d,f]=i.subarray(3*u,3*u+3),b=o.fromGrid(De(
{x:h,y:d},r),r.shape[1]);e.globalAlpha=Uu*Math.sqrt(a[u]/l),e.beginPath(),e.arc(b.x,b.y,Ou,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(b.x,b.y),e.lineTo(b.x+Qo*
Math.cos(f),b.y-Qo*Math.sin(f)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:o},s,r,i){let[a,l,u]=r.mean,h=n.fromGrid(De({x:a,y:l},s),s.shape[1]),d=Wu*n.transform.
scale/s.resolution,[[f,b],[,y]]=r.covariance,[M,S]=[(f+y)/2,Math.hypot((f-y)/2,b)],[P,k]=[M+S,M-S].map(E=>Math.max(ta,d*Math.sqrt(Math.max(E,0))));e.beginPath(),
e.ellipse(h.x,h.y,P,k,-Math.atan2(2*b,f-y)/2,0,2*Math.PI);let _=ta+1;e.moveTo(h.x+_*Math.cos(u),h.y-_*Math.sin(u)),e.lineTo(h.x+(_+Qo)*Math.cos(u),h.y-(_+Qo)*Math.
sin(u)),e.strokeStyle=o.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i&&Zt(e,dr(r.probability),h.x,h.y-k-9,o.theme,
"center",!0)}},dr=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var na=900,xo=2;function oa({session:t,look:e}){let[n,o]=t.shape,s=new Wn;s.resize(na,Math.round(ie(na*o/n,300,1800)),xo),s.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:s.width*xo,height:s.height*xo});let i=r.getContext("2d");i.scale(xo,xo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);
let a=[new Hn,new Bn,new Kn,new qn,new jn,new zn,new Yn,new Vn],l={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let u of a)(u.shows?.(
l)??!0)&&(i.save(),u.paint(i,l),i.restore());return new Promise(u=>r.toBlob(u))}var Xo=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:l,document:u}=o;if(!i||!u||l?.index!==
i.scan)return;Be(e,n);let{grid:h,max_range:d}=u,f=S=>{let P={x:i.from.x+S*Math.cos(i.angle),y:i.from.y+S*Math.sin(i.angle)};return s.fromGrid(De(P,h),h.shape[1])},
b=(S,P,k,_)=>{e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(P.x,P.y),e.lineWidth=k,e.strokeStyle=_,e.stroke()},y=l.hit[i.beam]===1,M=f(y?l.ranges[i.beam]:d);if(b(f(0),
M,3,r.theme.halo),b(f(0),M,1.5,y?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let S=(P,k)=>ie(P??k,0,d);if(b(f(S(a.low,0)),f(S(a.high,d)),6,r.theme.ghost),
a.median!==null){let P=f(a.median),k={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};b({x:P.x-k.x,y:P.y-k.y},{x:P.x+k.x,y:P.y+k.y},2.5,r.theme.ghost)}}y&&(e.beginPath(),
e.arc(M.x,M.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};function v(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function C(t,e,n){t[e]!==n&&(t[e]=n)}function pt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var fn=t=>t.getRootNode().activeElement===t,Me=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function hr(t,e){let n=URL.
createObjectURL(e);v("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var sa=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["path","Path","path"],["look","Look next","look"],["w\
here","Where am I?","where"],["ghost","Ghost","ghost"]];function ra(t){let{hand:e,session:n}=t,o=t.segmented("Tool",sa,()=>n.editable||!n.document||_t.has(e.tool)?
e.tool:"pan",s=>e.choose(s),s=>n.editable||_t.has(s)&&!n.recorded||s==="pan");return t.visible(o,()=>!n.recorded),sa.forEach(([s],r)=>{_t.has(s)||t.visible(o.children[r],
()=>!n.document||n.editable)}),v("div",{className:"bar"},o,v("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),
t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Gu="uplot",zu="u-hz",Hu="u-vt",Vu="u-title",Bu="u-wrap",ju="u-under",qu="u-over",Ku="u-axis",yn="u-off",Yu="u-select",Ju="u-cursor-x",Zu="u-cursor-y",Qu="u-\
cursor-pt",Xu="u-legend",ep="u-live",tp="u-inline",np="u-series",op="u-marker",ia="u-label",sp="u-value",ko="width",So="height";var aa="bottom",Jn="left",fr="right",Lr="#000",la=Lr+"0",mr="mousemove",ca="mousedown",gr="mouseup",ua="mouseenter",pa="mouseleave",da="dblclick",rp="resize",ip="\
scroll",ha="change",ss="dppxchange",Dr="--",oo=typeof window<"u",vr=oo?document:null,Qn=oo?window:null,ap=oo?navigator:null,de,es;function kr(){let t=devicePixelRatio;
de!=t&&(de=t,es&&Mr(ha,es,kr),es=matchMedia(`(min-resolution: ${de-.001}dppx) and (max-resolution: ${de+.001}dppx)`),wn(ha,es,kr),Qn.dispatchEvent(new CustomEvent(
ss)))}function dt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function Sr(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Te(t,e,n){
t.style[e]=n+"px"}function At(t,e,n,o){let s=vr.createElement(t);return e!=null&&dt(s,e),n?.insertBefore(s,o),s}function vt(t,e){return At("div",t,e)}var fa=new WeakMap;
function It(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=fa.get(t);r!=i&&(t.style.transform=r,fa.set(t,r),e<0||n<0||e>o||n>s?dt(t,yn):Sr(t,yn))}var ma=new WeakMap;
function ga(t,e,n){let o=e+n,s=ma.get(t);o!=s&&(ma.set(t,o),t.style.background=e,t.style.borderColor=n)}var ya=new WeakMap;function wa(t,e,n,o){let s=e+""+n,r=ya.
get(t);s!=r&&(ya.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Nr={passive:!0},lp={...Nr,
capture:!0};function wn(t,e,n,o){e.addEventListener(t,n,o?lp:Nr)}function Mr(t,e,n,o){e.removeEventListener(t,n,Nr)}oo&&kr();function Ct(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:ht((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function ja(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var qa=t=>t!=null,Ka=t=>t!=null&&t>0,as=ja(qa),cp=ja(Ka);function up(t,e,n,o=0,s=!1){
let r=s?cp:as,i=s?Ka:qa;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(o==1)a=t[e],l=t[n];else if(o==-1)a=t[n],l=t[e];else for(let u=e;u<=n;u++){let h=t[u];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??ge,l??-ge]}function ls(t,e,n,o){let s=va(t),r=va(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Ht:Ya,a=s==1?ht:kt,l=r==1?kt:ht,
u=a(i($e(t))),h=l(i($e(e))),d=Xn(n,u),f=Xn(n,h);return n==10&&(u<0&&(d=ye(d,-u)),h<0&&(f=ye(f,-h))),o||n==2?(t=d*s,e=f*r):(t=Xa(t,d),e=cs(e,f)),[t,e]}function Rr(t,e,n,o){
let s=ls(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Fr=.1,ba={mode:3,pad:Fr},To={pad:0,soft:null,mode:0},pp={min:To,max:To};function rs(t,e,n,o){return us(
n)?xa(t,e,n):(To.pad=n,To.soft=o?0:null,To.mode=o?3:0,xa(t,e,pp))}function ue(t,e){return t??e}function dp(t,e,n){for(e=ue(e,0),n=ue(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function xa(t,e,n){let o=n.min,s=n.max,r=ue(o.pad,0),i=ue(s.pad,0),a=ue(o.hard,-ge),l=ue(s.hard,ge),u=ue(o.soft,ge),h=ue(s.soft,-ge),
d=ue(o.mode,0),f=ue(s.mode,0),b=e-t,y=Ht(b),M=nt($e(t),$e(e)),S=Ht(M),P=$e(S-y);(b<1e-24||P>10)&&(b=0,(t==0||e==0)&&(b=1e-24,d==2&&u!=ge&&(r=0),f==2&&h!=-ge&&(i=
0)));let k=b||M||1e3,_=Ht(k),E=Xn(10,ht(_)),q=k*(b==0?t==0?.1:1:r),N=ye(Xa(t-q,E/10),24),Y=t>=u&&(d==1||d==3&&N<=u||d==2&&N>=u)?u:ge,V=nt(a,N<Y&&t>=Y?Y:Lt(Y,N)),
R=k*(b==0?e==0?.1:1:i),W=ye(cs(e+R,E/10),24),L=e<=h&&(f==1||f==3&&W>=h||f==2&&W<=h)?h:-ge,Z=Lt(l,W>L&&e<=L?L:nt(L,W));return V==Z&&V==0&&(Z=100),[V,Z]}var hp=new Intl.
NumberFormat(oo?ap.language:"en-US"),$r=t=>hp.format(t),ft=Math,os=ft.PI,$e=ft.abs,ht=ft.floor,Fe=ft.round,kt=ft.ceil,Lt=ft.min,nt=ft.max,Xn=ft.pow,va=ft.sign,Ht=ft.
log10,Ya=ft.log2,fp=(t,e=1)=>ft.sinh(t)*e,yr=(t,e=1)=>ft.asinh(t/e),ge=1/0;function ka(t){return(Ht((t^t>>31)-(t>>31))|0)+1}function Tr(t,e,n){return Lt(nt(t,e),
n)}function Ja(t){return typeof t=="function"}function oe(t){return Ja(t)?t:()=>t}var mp=()=>{},Za=t=>t,Qa=(t,e)=>e,gp=t=>null,Sa=t=>!0,Ma=(t,e)=>t==e,yp=/\.\d*?(?=9{6,}|0{6,})/gm,
bn=t=>{if(tl(t)||en.has(t))return t;let e=`${t}`,n=e.match(yp);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${bn(
s)}e${r}`}return ye(t,o)};function mn(t,e){return bn(ye(bn(t/e))*e)}function cs(t,e){return bn(kt(bn(t/e))*e)}function Xa(t,e){return bn(ht(bn(t/e))*e)}function ye(t,e=0){
if(tl(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Fe(o)/n}var en=new Map;function el(t){return((""+t).split(".")[1]||"").length}function Eo(t,e,n,o){
let s=[],r=o.map(el);for(let i=e;i<n;i++){let a=$e(i),l=ye(Xn(t,i),a);for(let u=0;u<o.length;u++){let h=t==10?+`${o[u]}e${i}`:o[u]*l,d=(i>=0?0:a)+(i>=r[u]?0:r[u]),
f=t==10?h:ye(h,d);s.push(f),en.set(f,d)}}return s}var Po={},Or=[],eo=[null,null],Xt=Array.isArray,tl=Number.isInteger,wp=t=>t===void 0;function Ta(t){return typeof t==
"string"}function us(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function bp(t){return t!=null&&typeof t=="object"}var xp=Object.getPrototypeOf(
Uint8Array),nl="__proto__";function to(t,e=us){let n;if(Xt(t)){let o=t.find(s=>s!=null);if(Xt(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=to(t[s],
e)}else n=t.slice()}else if(t instanceof xp)n=t.slice();else if(e(t)){n={};for(let o in t)o!=nl&&(n[o]=to(t[o],e))}else n=t;return n}function Ne(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=nl&&(us(t[s])?Ne(t[s],to(o[s])):t[s]=to(o[s]))}return t}var vp=0,kp=1,Sp=2;function Mp(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function Tp(t,e){if(_p(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return Ap(i[0])||(i=Ep(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],u=l.length;for(let h=0;h<
u;h++)n.add(l[h])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let u=1;u<a.length;u++){let h=a[u],d=Array(s).fill(void 0),f=e?e[i][u]:kp,b=[];for(let y=0;y<h.length;y++){let M=h[y],S=r.get(l[y]);M===null?f!=vp&&(d[S]=M,
f==Sp&&b.push(S)):d[S]=M}Mp(d,b,s),o.push(d)}}return o}var Pp=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Ep(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[o[l]];s.push(a)}return s}function _p(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function Ap(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=nt(1,ht((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var ol=["January","February","March",
"April","May","June","July","August","September","October","November","December"],sl=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function rl(t){
return t.slice(0,3)}var Cp=sl.map(rl),Lp=ol.map(rl),Dp={MMMM:ol,MMM:Lp,WWWW:sl,WWW:Cp};function vo(t){return(t<10?"0":"")+t}function Np(t){return(t<10?"00":t<100?
"0":"")+t}var Rp={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>vo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>vo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>vo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>vo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>vo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Np(t.getMilliseconds())};function Ir(t,e){e=e||Dp;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?Rp[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var Fp=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function $p(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Fp?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var il=t=>t%1==0,is=[1,2,2.5,5],Op=Eo(10,-32,0,is),al=Eo(10,0,32,is),Ip=al.filter(
il),gn=Op.concat(al),Ur=`
`,ll="{YYYY}",Pa=Ur+ll,cl="{M}/{D}",Mo=Ur+cl,ts=Mo+"/{YY}",ul="{aa}",Up="{h}:{mm}",Zn=Up+ul,Ea=Ur+Zn,_a=":{ss}",he=null;function pl(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,l=(t==1?Eo(10,0,3,is).filter(il):Eo(10,-3,0,is)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),u=[[i,ll,he,he,he,he,he,he,1],[s*28,"{MMM}",Pa,he,he,he,he,he,1],[s,cl,Pa,he,
he,he,he,he,1],[o,"{h}"+ul,ts,he,Mo,he,he,he,1],[n,Zn,ts,he,Mo,he,he,he,1],[e,_a,ts+" "+Zn,he,Mo+" "+Zn,he,Ea,he,1],[t,_a+".{fff}",ts+" "+Zn,he,Mo+" "+Zn,he,Ea,
he,1]];function h(d){return(f,b,y,M,S,P)=>{let k=[],_=S>=i,E=S>=r&&S<i,q=d(y),N=ye(q*t,3),Y=wr(q.getFullYear(),_?0:q.getMonth(),E||_?1:q.getDate()),V=ye(Y*t,3);
if(E||_){let R=E?S/r:0,W=_?S/i:0,L=N==V?N:ye(wr(Y.getFullYear()+W,Y.getMonth()+R,1)*t,3),Z=new Date(Fe(L/t)),I=Z.getFullYear(),j=Z.getMonth();for(let z=0;L<=M;z++){
let Q=wr(I+W*z,j+R*z,1),H=Q-d(ye(Q*t,3));L=ye((+Q+H)*t,3),L<=M&&k.push(L)}}else{let R=S>=s?s:S,W=ht(y)-ht(N),L=V+W+cs(N-V,R);k.push(L);let Z=d(L),I=Z.getHours()+
Z.getMinutes()/n+Z.getSeconds()/o,j=S/o,z=f.axes[b]._space,Q=P/z;for(;L=ye(L+S,t==1?0:3),!(L>M);)if(j>1){let H=ht(ye(I+j,6))%24,se=d(L).getHours()-H;se>1&&(se=-1),
L-=se*o,I=(I+j)%24;let le=k[k.length-1];ye((L-le)/S,3)*Q>=.7&&k.push(L)}else k.push(L)}return k}}return[l,u,h]}var[Wp,Gp,zp]=pl(1),[Hp,Vp,Bp]=pl(.001);Eo(2,-53,
53,[1]);function Aa(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function Ca(t,e){return(n,o,s,r,i)=>{let a=e.find(y=>i>=
y[0])||e[e.length-1],l,u,h,d,f,b;return o.map(y=>{let M=t(y),S=M.getFullYear(),P=M.getMonth(),k=M.getDate(),_=M.getHours(),E=M.getMinutes(),q=M.getSeconds(),N=S!=
l&&a[2]||P!=u&&a[3]||k!=h&&a[4]||_!=d&&a[5]||E!=f&&a[6]||q!=b&&a[7]||a[1];return l=S,u=P,h=k,d=_,f=E,b=q,N(M)})}}function jp(t,e){let n=Ir(e);return(o,s,r,i,a)=>s.
map(l=>n(t(l)))}function wr(t,e,n){return new Date(t,e,n)}function La(t,e){return e(t)}var qp="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Da(t,e){return(n,o,s,r)=>r==
null?Dr:e(t(o))}function Kp(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Yp(t,e){return t.series[e].fill(
t,e)}var Jp={show:!0,live:!0,isolate:!1,mount:mp,markers:{show:!0,width:2,stroke:Kp,fill:Yp,dash:"solid"},idx:null,idxs:null,values:[]};function Zp(t,e){let n=t.
cursor.points,o=vt(),s=n.size(t,e);Te(o,ko,s),Te(o,So,s);let r=s/-2;Te(o,"marginLeft",r),Te(o,"marginTop",r);let i=n.width(t,e,s);return i&&Te(o,"borderWidth",i),
o}function Qp(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Xp(t,e){let n=t.series[e].points;return n._stroke||n._fill}function ed(t,e){return t.
series[e].points.size}var br=[0,0];function td(t,e,n){return br[0]=e,br[1]=n,br}function ns(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function xr(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var nd={show:!0,x:!0,y:!0,lock:!1,move:td,points:{one:!1,show:Zp,size:ed,width:0,stroke:Xp,fill:Qp},bind:{mousedown:ns,mouseup:ns,
click:ns,dblclick:ns,mousemove:xr,mouseleave:xr,mouseenter:xr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},dl={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Wr=Ne({},dl,{filter:Qa}),hl=Ne({},Wr,{size:10}),fl=Ne({},dl,{show:!1}),Gr='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',ml="bold "+Gr,gl=1.5,Na={
show:!0,scale:"x",stroke:Lr,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:ml,side:2,grid:Wr,ticks:hl,border:fl,font:Gr,lineGap:gl,rotate:0},
od="Value",sd="Time",Ra={show:!0,scale:"x",auto:!1,sorted:1,min:ge,max:-ge,idxs:[]};function rd(t,e,n,o,s){return e.map(r=>r==null?"":$r(r))}function id(t,e,n,o,s,r,i){
let a=[],l=en.get(s)||0;n=i?n:ye(cs(n,s),l);for(let u=n;u<=o;u=ye(u+s,l))a.push(Object.is(u,-0)?0:u);return a}function Pr(t,e,n,o,s,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,u=l==10?Ht:Ya,h=ht(u(n));s=Xn(l,h),l==10&&(s=gn[Ct(s,gn)]);let d=n,f=s*l;l==10&&(f=gn[Ct(f,gn)]);do a.push(d),d=d+s,l==10&&!en.has(d)&&(d=ye(d,en.get(
s))),d>=f&&(s=d,f=s*l,l==10&&(f=gn[Ct(f,gn)]));while(d<=o);return a}function ad(t,e,n,o,s,r,i){let l=t.scales[t.axes[e].scale].asinh,u=o>l?Pr(t,e,nt(l,n),o,s):[
l],h=o>=0&&n<=0?[0]:[];return(n<-l?Pr(t,e,nt(l,-o),-n,s):[l]).reverse().map(f=>-f).concat(h,u)}var yl=/./,ld=/[12357]/,cd=/[125]/,Fa=/1/,Er=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function ud(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,u=r._space,h=l(10,i),d=l(
9,i)-h>=u?yl:l(7,i)-h>=u?ld:l(5,i)-h>=u?cd:Fa;if(d==Fa){let f=$e(l(1,i)-h);if(f<u)return Er(e.slice().reverse(),a.distr,d,kt(u/f)).reverse()}return Er(e,a.distr,
d,1)}function pd(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,u=$e(l(1,i)-l(2,i));return u<a?Er(e.slice().reverse(),3,yl,kt(a/u)).reverse():e}function dd(t,e,n,o){
return o==null?Dr:e==null?"":$r(e)}var $a={show:!0,scale:"y",stroke:Lr,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:ml,side:3,grid:Wr,ticks:hl,
border:fl,font:Gr,lineGap:gl,rotate:0};function hd(t,e){let n=3+(t||1)*2;return ye(n*e,3)}function fd(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=$e(i-r),l=t.series[e],u=a/(l.points.space*de);return o[1]-o[0]<=u}var Oa={scale:null,auto:!0,sorted:0,min:ge,max:-ge},
wl=(t,e,n,o,s)=>s,Ia={show:!0,auto:!0,sorted:0,gaps:wl,alpha:1,facets:[Ne({},Oa,{scale:"x"}),Ne({},Oa,{scale:"y"})]},Ua={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:wl,alpha:1,points:{show:fd,filter:null},values:null,min:ge,max:-ge,idxs:[],path:null,clip:null};function md(t,e,n,o,s){return n/10}var bl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},gd=Ne({},bl,{time:!1,ori:1}),Wa={};function xl(t,e){let n=Wa[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,l,u){for(let h=0;h<n.plots.length;h++)n.plots[h]!=s&&n.plots[h].pub(o,s,r,i,a,l,u)}},t!=null&&(Wa[t]=
n)),n}var no=1,_r=2;function xn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],u=o==2?r[1]:r[e],h=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],d=o==2?i[s.facets[1].scale]:i[s.scale],f=a.left,b=a.top,y=a.width,M=a.height,S=t.valToPosH,P=t.valToPosV;return h.ori==0?n(s,l,u,h,d,S,P,f,
b,y,M,ds,so,fs,kl,Ml):n(s,l,u,h,d,P,S,b,f,M,y,hs,ro,Vr,Sl,Tl)}function zr(t,e){let n=0,o=0,s=ue(t.bands,Or);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function yd(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Vt(t,e,n,o,s,r){return xn(t,e,(i,a,l,u,h,d,f,b,y,M,S)=>{let P=i.pxRound,k=u.
dir*(u.ori==0?1:-1),_=u.ori==0?so:ro,E,q;k==1?(E=n,q=o):(E=o,q=n);let N=P(d(a[E],u,M,b)),Y=P(f(l[E],h,S,y)),V=P(d(a[q],u,M,b)),R=P(f(r==1?h.max:h.min,h,S,y)),W=new Path2D(
s);return _(W,V,R),_(W,N,R),_(W,N,Y),W})}function ps(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?fs:Vr,l=n;for(let d=0;d<t.length;d++){let f=t[d];
if(f[1]>f[0]){let b=f[0]-l;b>0&&a(i,l,o,b,o+r),l=f[1]}}let u=n+s-l,h=10;u>0&&a(i,l,o-h/2,u,o+r+h)}return i}function wd(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Hr(t,e,n,o,s,r,i){let a=[],l=t.length;for(let u=s==1?n:o;u>=n&&u<=o;u+=s)if(e[u]===null){let d=u,f=u;if(s==1)for(;++u<=o&&e[u]===null;)
f=u;else for(;--u>=n&&e[u]===null;)f=u;let b=r(t[d]),y=f==d?b:r(t[f]),M=d-s;b=i<=0&&M>=0&&M<l?r(t[M]):b;let P=f+s;y=i>=0&&P>=0&&P<l?r(t[P]):y,y>=b&&a.push([b,y])}
return a}function Ga(t){return t==0?Za:t==1?Fe:e=>mn(e,t)}function vl(t){let e=t==0?ds:hs,n=t==0?(s,r,i,a,l,u)=>{s.arcTo(r,i,a,l,u)}:(s,r,i,a,l,u)=>{s.arcTo(i,r,
l,a,u)},o=t==0?(s,r,i,a,l)=>{s.rect(r,i,a,l)}:(s,r,i,a,l)=>{s.rect(i,r,l,a)};return(s,r,i,a,l,u=0,h=0)=>{u==0&&h==0?o(s,r,i,a,l):(u=Lt(u,a/2,l/2),h=Lt(h,a/2,l/2),
e(s,r+u,i),n(s,r+a,i,r+a,i+l,u),n(s,r+a,i+l,r,i+l,h),n(s,r,i+l,r,i,h),n(s,r,i,r+a,i,u),s.closePath())}}var ds=(t,e,n)=>{t.moveTo(e,n)},hs=(t,e,n)=>{t.moveTo(n,e)},
so=(t,e,n)=>{t.lineTo(e,n)},ro=(t,e,n)=>{t.lineTo(n,e)},fs=vl(0),Vr=vl(1),kl=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},Sl=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},Ml=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},Tl=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function Pl(t){return(e,n,o,s,r)=>xn(e,n,(i,a,l,u,h,d,f,b,y,M,S)=>{let{pxRound:P,
points:k}=i,_,E;u.ori==0?(_=ds,E=kl):(_=hs,E=Sl);let q=ye(k.width*de,3),N=(k.size-k.width)/2*de,Y=ye(N*2,3),V=new Path2D,R=new Path2D,{left:W,top:L,width:Z,height:I}=e.
bbox;fs(R,W-Y,L-Y,Z+Y*2,I+Y*2);let j=z=>{if(l[z]!=null){let Q=P(d(a[z],u,M,b)),H=P(f(l[z],h,S,y));_(V,Q+N,H),E(V,Q,H,N,0,os*2)}};if(r)r.forEach(j);else for(let z=o;z<=
s;z++)j(z);return{stroke:q>0?V:null,fill:V,clip:R,flags:no|_r}})}function El(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var bd=El(so),xd=El(ro);function _l(t){let e=ue(t?.alignGaps,0);return(n,o,s,r)=>xn(n,o,(i,a,l,u,h,d,f,b,y,M,S)=>{[s,r]=as(l,s,r);let P=i.pxRound,k=I=>P(d(I,u,M,
b)),_=I=>P(f(I,h,S,y)),E,q;u.ori==0?(E=so,q=bd):(E=ro,q=xd);let N=u.dir*(u.ori==0?1:-1),Y={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:no},V=Y.
stroke,R=!1;if(r-s>=M*4){let I=G=>n.posToVal(G,u.key,!0),j=null,z=null,Q,H,je,we=k(a[N==1?s:r]),se=k(a[s]),le=k(a[r]),ee=I(N==1?se+1:le-1);for(let G=N==1?s:r;G>=
s&&G<=r;G+=N){let _e=a[G],me=(N==1?_e<ee:_e>ee)?we:k(_e),ae=l[G];me==we?ae!=null?(H=ae,j==null?(E(V,me,_(H)),Q=j=z=H):H<j?j=H:H>z&&(z=H)):ae===null&&(R=!0):(j!=
null&&q(V,we,_(j),_(z),_(Q),_(H)),ae!=null?(H=ae,E(V,me,_(H)),j=z=Q=H):(j=z=null,ae===null&&(R=!0)),we=me,ee=I(we+N))}j!=null&&j!=z&&je!=we&&q(V,we,_(j),_(z),_(
Q),_(H))}else for(let I=N==1?s:r;I>=s&&I<=r;I+=N){let j=l[I];j===null?R=!0:j!=null&&E(V,k(a[I]),_(j))}let[L,Z]=zr(n,o);if(i.fill!=null||L!=0){let I=Y.fill=new Path2D(
V),j=i.fillTo(n,o,i.min,i.max,L),z=_(j),Q=k(a[s]),H=k(a[r]);N==-1&&([H,Q]=[Q,H]),E(I,H,z),E(I,Q,z)}if(!i.spanGaps){let I=[];R&&I.push(...Hr(a,l,s,r,N,k,e)),Y.gaps=
I=i.gaps(n,o,s,r,I),Y.clip=ps(I,u.ori,b,y,M,S)}return Z!=0&&(Y.band=Z==2?[Vt(n,o,s,r,V,-1),Vt(n,o,s,r,V,1)]:Vt(n,o,s,r,V,Z)),Y})}function vd(t){let e=ue(t.align,
1),n=ue(t.ascDesc,!1),o=ue(t.alignGaps,0),s=ue(t.extend,!1);return(r,i,a,l)=>xn(r,i,(u,h,d,f,b,y,M,S,P,k,_)=>{[a,l]=as(d,a,l);let E=u.pxRound,{left:q,width:N}=r.
bbox,Y=se=>E(y(se,f,k,S)),V=se=>E(M(se,b,_,P)),R=f.ori==0?so:ro,W={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:no},L=W.stroke,Z=f.dir*(f.ori==
0?1:-1),I=V(d[Z==1?a:l]),j=Y(h[Z==1?a:l]),z=j,Q=j;s&&e==-1&&(Q=q,R(L,Q,I)),R(L,j,I);for(let se=Z==1?a:l;se>=a&&se<=l;se+=Z){let le=d[se];if(le==null)continue;let ee=Y(
h[se]),G=V(le);e==1?R(L,ee,I):R(L,z,G),R(L,ee,G),I=G,z=ee}let H=z;s&&e==1&&(H=q+N,R(L,H,I));let[je,we]=zr(r,i);if(u.fill!=null||je!=0){let se=W.fill=new Path2D(
L),le=u.fillTo(r,i,u.min,u.max,je),ee=V(le);R(se,H,ee),R(se,Q,ee)}if(!u.spanGaps){let se=[];se.push(...Hr(h,d,a,l,Z,Y,o));let le=u.width*de/2,ee=n||e==1?le:-le,
G=n||e==-1?-le:le;se.forEach(_e=>{_e[0]+=ee,_e[1]+=G}),W.gaps=se=u.gaps(r,i,a,l,se),W.clip=ps(se,f.ori,S,P,k,_)}return we!=0&&(W.band=we==2?[Vt(r,i,a,l,L,-1),Vt(
r,i,a,l,L,1)]:Vt(r,i,a,l,L,we)),W})}function za(t,e,n,o,s,r,i=ge){if(t.length>1){let a=null;for(let l=0,u=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=$e(
t[l]-t[a]);h<u&&(u=h,i=$e(n(t[l],o,s,r)-n(t[a],o,s,r)))}a=l}}return i}function kd(t){t=t||Po;let e=ue(t.size,[.6,ge,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==
null?[0,0]:typeof s=="number"?[s,0]:s;let r=oe(s),i=1-e[0],a=ue(e[1],ge),l=ue(e[2],1),u=ue(t.disp,Po),h=ue(t.each,b=>{}),{fill:d,stroke:f}=u;return(b,y,M,S)=>xn(
b,y,(P,k,_,E,q,N,Y,V,R,W,L)=>{let Z=P.pxRound,I=n,j=o*de,z=a*de,Q=l*de,H,je;E.ori==0?[H,je]=r(b,y):[je,H]=r(b,y);let we=E.dir*(E.ori==0?1:-1),se=E.ori==0?fs:Vr,
le=E.ori==0?h:(O,be,Re,Sn,sn,Dt,rn)=>{h(O,be,Re,sn,Sn,rn,Dt)},ee=ue(b.bands,Or).find(O=>O.series[0]==y),G=ee!=null?ee.dir:0,_e=P.fillTo(b,y,P.min,P.max,G),Ie=Z(
Y(_e,q,L,R)),me,ae,ot,st=W,Pe=Z(P.width*de),St=!1,mt=null,K=null,re=null,qe=null;d!=null&&(Pe==0||f!=null)&&(St=!0,mt=d.values(b,y,M,S),K=new Map,new Set(mt).forEach(
O=>{O!=null&&K.set(O,new Path2D)}),Pe>0&&(re=f.values(b,y,M,S),qe=new Map,new Set(re).forEach(O=>{O!=null&&qe.set(O,new Path2D)})));let{x0:Ut,size:ao}=u;if(Ut!=
null&&ao!=null){I=1,k=Ut.values(b,y,M,S),Ut.unit==2&&(k=k.map(Re=>b.posToVal(V+Re*W,E.key,!0)));let O=ao.values(b,y,M,S);ao.unit==2?ae=O[0]*W:ae=N(O[0],E,W,V)-N(
0,E,W,V),st=za(k,_,N,E,W,V,st),ot=st-ae+j}else st=za(k,_,N,E,W,V,st),ot=st*i+j,ae=st-ot;ot<1&&(ot=0),Pe>=ae/2&&(Pe=0),ot<5&&(Z=Za);let _o=ot>0,nn=st-ot-(_o?Pe:0);
ae=Z(Tr(nn,Q,z)),me=(I==0?ae/2:I==we?0:ae)-I*we*((I==0?j/2:0)+(_o?Pe/2:0));let Qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},kn=St?null:new Path2D,
Wt=null;if(ee!=null)Wt=b.data[ee.series[1]];else{let{y0:O,y1:be}=u;O!=null&&be!=null&&(_=be.values(b,y,M,S),Wt=O.values(b,y,M,S))}let on=H*ae,te=je*ae;for(let O=we==
1?M:S;O>=M&&O<=S;O+=we){let be=_[O];if(be==null)continue;if(Wt!=null){let rt=Wt[O]??0;if(be-rt==0)continue;Ie=Y(rt,q,L,R)}let Re=E.distr!=2||u!=null?k[O]:O,Sn=N(
Re,E,W,V),sn=Y(ue(be,_e),q,L,R),Dt=Z(Sn-me),rn=Z(nt(sn,Ie)),at=Z(Lt(sn,Ie)),gt=rn-at;if(be!=null){let rt=be<0?te:on,Mt=be<0?on:te;St?(Pe>0&&re[O]!=null&&se(qe.get(
re[O]),Dt,at+ht(Pe/2),ae,nt(0,gt-Pe),rt,Mt),mt[O]!=null&&se(K.get(mt[O]),Dt,at+ht(Pe/2),ae,nt(0,gt-Pe),rt,Mt)):se(kn,Dt,at+ht(Pe/2),ae,nt(0,gt-Pe),rt,Mt),le(b,y,
O,Dt-Pe/2,at,ae+Pe,gt)}}return Pe>0?Qe.stroke=St?qe:kn:St||(Qe._fill=P.width==0?P._fill:P._stroke??P._fill,Qe.width=0),Qe.fill=St?K:kn,Qe})}function Sd(t,e){let n=ue(
e?.alignGaps,0);return(o,s,r,i)=>xn(o,s,(a,l,u,h,d,f,b,y,M,S,P)=>{[r,i]=as(u,r,i);let k=a.pxRound,_=H=>k(f(H,h,S,y)),E=H=>k(b(H,d,P,M)),q,N,Y;h.ori==0?(q=ds,Y=so,
N=Ml):(q=hs,Y=ro,N=Tl);let V=h.dir*(h.ori==0?1:-1),R=_(l[V==1?r:i]),W=R,L=[],Z=[];for(let H=V==1?r:i;H>=r&&H<=i;H+=V)if(u[H]!=null){let we=l[H],se=_(we);L.push(
W=se),Z.push(E(u[H]))}let I={stroke:t(L,Z,q,Y,N,k),fill:null,clip:null,band:null,gaps:null,flags:no},j=I.stroke,[z,Q]=zr(o,s);if(a.fill!=null||z!=0){let H=I.fill=
new Path2D(j),je=a.fillTo(o,s,a.min,a.max,z),we=E(je);Y(H,W,we),Y(H,R,we)}if(!a.spanGaps){let H=[];H.push(...Hr(l,u,r,i,V,_,n)),I.gaps=H=a.gaps(o,s,r,i,H),I.clip=
ps(H,h.ori,y,M,S,P)}return Q!=0&&(I.band=Q==2?[Vt(o,s,r,i,j,-1),Vt(o,s,r,i,j,1)]:Vt(o,s,r,i,j,Q)),I})}function Md(t){return Sd(Td,t)}function Td(t,e,n,o,s,r){let i=t.
length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let l=Array(i),u=Array(i-1),h=Array(i-1),d=Array(i-1);for(let f=0;f<i-1;f++)
h[f]=e[f+1]-e[f],d[f]=t[f+1]-t[f],u[f]=h[f]/d[f];l[0]=u[0];for(let f=1;f<i-1;f++)u[f]===0||u[f-1]===0||u[f-1]>0!=u[f]>0?l[f]=0:(l[f]=3*(d[f-1]+d[f])/((2*d[f]+d[f-
1])/u[f-1]+(d[f]+2*d[f-1])/u[f]),isFinite(l[f])||(l[f]=0));l[i-1]=u[i-2];for(let f=0;f<i-1;f++)s(a,t[f]+d[f]/3,e[f]+l[f]*d[f]/3,t[f+1]-d[f]/3,e[f+1]-l[f+1]*d[f]/
3,t[f+1],e[f+1])}return a}var Ar=new Set;function Ha(){for(let t of Ar)t.syncRect(!0)}oo&&(wn(rp,Qn,Ha),wn(ip,Qn,Ha,!0),wn(ss,Qn,()=>{Oe.pxRatio=de}));var Pd=_l(),
Ed=Pl();function Va(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Cr(r,i,e,n))}function _d(t,e){return t.map((n,o)=>o==
0?{}:Ne({},e,n))}function Cr(t,e,n,o){return Ne({},e==0?n:o,t)}function Al(t,e,n){return e==null?eo:[e,n]}var Ad=Al;function Cd(t,e,n){return e==null?eo:rs(e,n,
Fr,!0)}function Cl(t,e,n,o){return e==null?eo:ls(e,n,t.scales[o].log,!1)}var Ld=Cl;function Ll(t,e,n,o){return e==null?eo:Rr(e,n,t.scales[o].log,!1)}var Dd=Ll;function Nd(t,e,n,o,s){
let r=nt(ka(t),ka(e)),i=e-t,a=Ct(s/o*i,n);do{let l=n[a],u=o*l/i;if(u>=s&&r+(l<5?en.get(l):0)<=17)return[l,u]}while(++a<n.length);return[0,0]}function Ba(t){let e,
n;return t=t.replace(/(\d+)px/,(o,s)=>(e=Fe((n=+s)*de))+"px"),[t,e,n]}function Rd(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=ye(e[2]*de,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Oe(t,e,n){let o={mode:ue(t.mode,1)},s=o.mode;function r(c,p,m,g){let w=p.valToPct(c);return g+m*(p.dir==-1?1-w:w)}function i(c,p,m,g){
let w=p.valToPct(c);return g+m*(p.dir==-1?w:1-w)}function a(c,p,m,g){return p.ori==0?r(c,p,m,g):i(c,p,m,g)}o.valToPosH=r,o.valToPosV=i;let l=!1;o.status=0;let u=o.
root=vt(Gu);if(t.id!=null&&(u.id=t.id),dt(u,t.class),t.title){let c=vt(Vu,u);c.textContent=t.title}let h=At("canvas"),d=o.ctx=h.getContext("2d"),f=vt(Bu,u);wn("\
click",f,c=>{c.target===y&&(xe!=Rn||Ee!=Fn)&&Ye.click(o,c)},!0);let b=o.under=vt(ju,f);f.appendChild(h);let y=o.over=vt(qu,f);t=to(t);let M=+ue(t.pxAlign,1),S=Ga(
M);(t.plugins||[]).forEach(c=>{c.opts&&(t=c.opts(o,t)||t)});let P=t.ms||.001,k=o.series=s==1?Va(t.series||[],Ra,Ua,!1):_d(t.series||[null],Ia),_=o.axes=Va(t.axes||
[],Na,$a,!0),E=o.scales={},q=o.bands=t.bands||[];q.forEach(c=>{c.fill=oe(c.fill||null),c.dir=ue(c.dir,-1)});let N=s==2?k[1].facets[0].scale:k[0].scale,Y={axes:Jc,
series:Bc},V=(t.drawOrder||["axes","series"]).map(c=>Y[c]);function R(c){let p=c.distr==3?m=>Ht(m>0?m:c.clamp(o,m,c.min,c.max,c.key)):c.distr==4?m=>yr(m,c.asinh):
c.distr==100?m=>c.fwd(m):m=>m;return m=>{let g=p(m),{_min:w,_max:x}=c,T=x-w;return(g-w)/T}}function W(c){let p=E[c];if(p==null){let m=(t.scales||Po)[c]||Po;if(m.
from!=null){W(m.from);let g=Ne({},E[m.from],m,{key:c});g.valToPct=R(g),E[c]=g}else{p=E[c]=Ne({},c==N?bl:gd,m),p.key=c;let g=p.time,w=p.range,x=Xt(w);if((c!=N||s==
2&&!g)&&(x&&(w[0]==null||w[1]==null)&&(w={min:w[0]==null?ba:{mode:1,hard:w[0],soft:w[0]},max:w[1]==null?ba:{mode:1,hard:w[1],soft:w[1]}},x=!1),!x&&us(w))){let T=w;
w=(A,D,F)=>D==null?eo:rs(D,F,T)}p.range=oe(w||(g?Ad:c==N?p.distr==3?Ld:p.distr==4?Dd:Al:p.distr==3?Cl:p.distr==4?Ll:Cd)),p.auto=oe(x?!1:p.auto),p.clamp=oe(p.clamp||
md),p._min=p._max=null,p.valToPct=R(p)}}}W("x"),W("y"),s==1&&k.forEach(c=>{W(c.scale)}),_.forEach(c=>{W(c.scale)});for(let c in t.scales)W(c);let L=E[N],Z=L.distr,
I,j;L.ori==0?(dt(u,zu),I=r,j=i):(dt(u,Hu),I=i,j=r);let z={};for(let c in E){let p=E[c];(p.min!=null||p.max!=null)&&(z[c]={min:p.min,max:p.max},p.min=p.max=null)}
let Q=t.tzDate||(c=>new Date(Fe(c/P))),H=t.fmtDate||Ir,je=P==1?zp(Q):Bp(Q),we=Ca(Q,Aa(P==1?Gp:Vp,H)),se=Da(Q,La(qp,H)),le=[],ee=o.legend=Ne({},Jp,t.legend),G=o.
cursor=Ne({},nd,{drag:{y:s==2}},t.cursor),_e=ee.show,Ie=G.show,me=ee.markers;ee.idxs=le,me.width=oe(me.width),me.dash=oe(me.dash),me.stroke=oe(me.stroke),me.fill=
oe(me.fill);let ae,ot,st,Pe=[],St=[],mt,K=!1,re={};if(ee.live){let c=k[1]?k[1].values:null;K=c!=null,mt=K?c(o,1,0):{_:0};for(let p in mt)re[p]=Dr}if(_e)if(ae=At(
"table",Xu,u),st=At("tbody",null,ae),ee.mount(o,ae),K){ot=At("thead",null,ae,st);let c=At("tr",null,ot);At("th",null,c);for(var qe in mt)At("th",ia,c).textContent=
qe}else dt(ae,tp),ee.live&&dt(ae,ep);let Ut={show:!0},ao={show:!1};function _o(c,p){if(p==0&&(K||!ee.live||s==2))return eo;let m=[],g=At("tr",np,st,st.childNodes[p]);
dt(g,c.class),c.show||dt(g,yn);let w=At("th",null,g);if(me.show){let A=vt(op,w);if(p>0){let D=me.width(o,p);D&&(A.style.border=D+"px "+me.dash(o,p)+" "+me.stroke(
o,p)),A.style.background=me.fill(o,p)}}let x=vt(ia,w);c.label instanceof HTMLElement?x.appendChild(c.label):x.textContent=c.label,p>0&&(me.show||(x.style.color=
c.width>0?me.stroke(o,p):me.fill(o,p)),Qe("click",w,A=>{if(G._lock)return;ln(A);let D=k.indexOf(c);if((A.ctrlKey||A.metaKey)!=ee.isolate){let F=k.some(($,U)=>U>
0&&U!=D&&$.show);k.forEach(($,U)=>{U>0&&Rt(U,F?U==D?Ut:ao:Ut,!0,Le.setSeries)})}else Rt(D,{show:!c.show},!0,Le.setSeries)},!1),Tn&&Qe(ua,w,A=>{G._lock||(ln(A),Rt(
k.indexOf(c),On,!0,Le.setSeries))},!1));for(var T in mt){let A=At("td",sp,g);A.textContent="--",m.push(A)}return[g,m]}let nn=new Map;function Qe(c,p,m,g=!0){let w=nn.
get(p)||{},x=G.bind[c](o,p,m,g);x&&(wn(c,p,w[c]=x),nn.set(p,w))}function kn(c,p,m){let g=nn.get(p)||{};for(let w in g)(c==null||w==c)&&(Mr(w,p,g[w]),delete g[w]);
c==null&&nn.delete(p)}let Wt=0,on=0,te=0,O=0,be=0,Re=0,Sn=be,sn=Re,Dt=te,rn=O,at=0,gt=0,rt=0,Mt=0;o.bbox={};let Fs=!1,Ao=!1,Mn=!1,an=!1,Co=!1,yt=!1;function $s(c,p,m){
(m||c!=o.width||p!=o.height)&&ti(c,p),Cn(!1),Mn=!0,Ao=!0,Ln()}function ti(c,p){o.width=Wt=te=c,o.height=on=O=p,be=Re=0,Ic(),Uc();let m=o.bbox;at=m.left=mn(be*de,
.5),gt=m.top=mn(Re*de,.5),rt=m.width=mn(te*de,.5),Mt=m.height=mn(O*de,.5)}let Fc=3;function $c(){let c=!1,p=0;for(;!c;){p++;let m=Kc(p),g=Yc(p);c=p==Fc||m&&g,c||
(ti(o.width,o.height),Ao=!0)}}function Oc({width:c,height:p}){$s(c,p)}o.setSize=Oc;function Ic(){let c=!1,p=!1,m=!1,g=!1;_.forEach((w,x)=>{if(w.show&&w._show){let{
side:T,_size:A}=w,D=T%2,F=w.label!=null?w.labelSize:0,$=A+F;$>0&&(D?(te-=$,T==3?(be+=$,g=!0):m=!0):(O-=$,T==0?(Re+=$,c=!0):p=!0))}}),cn[0]=c,cn[1]=m,cn[2]=p,cn[3]=
g,te-=Bt[1]+Bt[3],be+=Bt[3],O-=Bt[2]+Bt[0],Re+=Bt[0]}function Uc(){let c=be+te,p=Re+O,m=be,g=Re;function w(x,T){switch(x){case 1:return c+=T,c-T;case 2:return p+=
T,p-T;case 3:return m-=T,m+T;case 0:return g-=T,g+T}}_.forEach((x,T)=>{if(x.show&&x._show){let A=x.side;x._pos=w(A,x._size),x.label!=null&&(x._lpos=w(A,x.labelSize))}})}
if(G.dataIdx==null){let c=G.hover,p=c.skip=new Set(c.skip??[]);p.add(void 0);let m=c.prox=oe(c.prox),g=c.bias??=0;G.dataIdx=(w,x,T,A)=>{if(x==0)return T;let D=T,
F=m(w,x,T,A)??ge,$=F>=0&&F<ge,U=L.ori==0?te:O,X=G.left,pe=e[0],ce=e[x];if(p.has(ce[T])){D=null;let ne=null,J=null,B;if(g==0||g==-1)for(B=T;ne==null&&B-- >0;)p.has(
ce[B])||(ne=B);if(g==0||g==1)for(B=T;J==null&&B++<ce.length;)p.has(ce[B])||(J=B);if(ne!=null||J!=null)if($){let ke=ne==null?-1/0:I(pe[ne],L,U,0),Ae=J==null?1/0:
I(pe[J],L,U,0),Ve=X-ke,fe=Ae-X;Ve<=fe?Ve<=F&&(D=ne):fe<=F&&(D=J)}else D=J==null?ne:ne==null?J:T-ne<=J-T?ne:J}else $&&$e(X-I(pe[T],L,U,0))>F&&(D=null);return D}}
let ln=c=>{G.event=c};G.idxs=le,G._lock=!1;let Ze=G.points;Ze.show=oe(Ze.show),Ze.size=oe(Ze.size),Ze.stroke=oe(Ze.stroke),Ze.width=oe(Ze.width),Ze.fill=oe(Ze.fill);
let Nt=o.focus=Ne({},t.focus||{alpha:.3},G.focus),Tn=Nt.prox>=0,Pn=Tn&&Ze.one,wt=[],En=[],_n=[];function ni(c,p){let m=Ze.show(o,p);if(m instanceof HTMLElement)
return dt(m,Qu),dt(m,c.class),It(m,-10,-10,te,O),y.insertBefore(m,wt[p]),m}function oi(c,p){if(s==1||p>0){let m=s==1&&E[c.scale].time,g=c.value;c.value=m?Ta(g)?
Da(Q,La(g,H)):g||se:g||dd,c.label=c.label||(m?sd:od)}if(Pn||p>0){c.width=c.width==null?1:c.width,c.paths=c.paths||Pd||gp,c.fillTo=oe(c.fillTo||yd),c.pxAlign=+ue(
c.pxAlign,M),c.pxRound=Ga(c.pxAlign),c.stroke=oe(c.stroke||null),c.fill=oe(c.fill||null),c._stroke=c._fill=c._paths=c._focus=null;let m=hd(nt(1,c.width),1),g=c.
points=Ne({},{size:m,width:nt(1,m*.2),stroke:c.stroke,space:m*2,paths:Ed,_stroke:null,_fill:null},c.points);g.show=oe(g.show),g.filter=oe(g.filter),g.fill=oe(g.
fill),g.stroke=oe(g.stroke),g.paths=oe(g.paths),g.pxAlign=c.pxAlign}if(_e){let m=_o(c,p);Pe.splice(p,0,m[0]),St.splice(p,0,m[1]),ee.values.push(null)}if(Ie){le.
splice(p,0,null);let m=null;Pn?p==0&&(m=ni(c,p)):p>0&&(m=ni(c,p)),wt.splice(p,0,m),En.splice(p,0,0),_n.splice(p,0,0)}He("addSeries",p)}function Wc(c,p){p=p??k.length,
c=s==1?Cr(c,p,Ra,Ua):Cr(c,p,{},Ia),k.splice(p,0,c),oi(k[p],p)}o.addSeries=Wc;function Gc(c){if(k.splice(c,1),_e){ee.values.splice(c,1),St.splice(c,1);let p=Pe.splice(
c,1)[0];kn(null,p.firstChild),p.remove()}Ie&&(le.splice(c,1),wt.splice(c,1)[0].remove(),En.splice(c,1),_n.splice(c,1)),He("delSeries",c)}o.delSeries=Gc;let cn=[
!1,!1,!1,!1];function zc(c,p){if(c._show=c.show,c.show){let m=c.side%2,g=E[c.scale];g==null&&(c.scale=m?k[1].scale:N,g=E[c.scale]);let w=g.time;c.size=oe(c.size),
c.space=oe(c.space),c.rotate=oe(c.rotate),Xt(c.incrs)&&c.incrs.forEach(T=>{!en.has(T)&&en.set(T,el(T))}),c.incrs=oe(c.incrs||(g.distr==2?Ip:w?P==1?Wp:Hp:gn)),c.
splits=oe(c.splits||(w&&g.distr==1?je:g.distr==3?Pr:g.distr==4?ad:id)),c.stroke=oe(c.stroke),c.grid.stroke=oe(c.grid.stroke),c.ticks.stroke=oe(c.ticks.stroke),c.
border.stroke=oe(c.border.stroke);let x=c.values;c.values=Xt(x)&&!Xt(x[0])?oe(x):w?Xt(x)?Ca(Q,Aa(x,H)):Ta(x)?jp(Q,x):x||we:x||rd,c.filter=oe(c.filter||(g.distr>=
3&&g.log==10?ud:g.distr==3&&g.log==2?pd:Qa)),c.font=Ba(c.font),c.labelFont=Ba(c.labelFont),c._size=c.size(o,null,p,0),c._space=c._rotate=c._incrs=c._found=c._splits=
c._values=null,c._size>0&&(cn[p]=!0,c._el=vt(Ku,f))}}function lo(c,p,m,g){let[w,x,T,A]=m,D=p%2,F=0;return D==0&&(A||x)&&(F=p==0&&!w||p==2&&!T?Fe(Na.size/3):0),D==
1&&(w||T)&&(F=p==1&&!x||p==3&&!A?Fe($a.size/2):0),F}let si=o.padding=(t.padding||[lo,lo,lo,lo]).map(c=>oe(ue(c,lo))),Bt=o._padding=si.map((c,p)=>c(o,p,cn,0)),Ke,
Ue=null,We=null,Lo=s==1?k[0].idxs:null,Tt=null,co=!1;function ri(c,p){if(e=c??[],o.data=o._data=e,s==2){Ke=0;for(let m=1;m<k.length;m++)Ke+=e[m][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),Tt=e[0],Ke=Tt.length;let m=e;if(Z==2){m=e.slice();let g=m[0]=Array(Ke);for(let w=0;w<Ke;w++)g[w]=w}o._data=e=m}if(Cn(!0),He(
"setData"),Z==2&&(Mn=!0),p!==!1){let m=L;m.auto(o,co)?Os():qt(N,m.min,m.max),an=an||G.left>=0,yt=!0,Ln()}}o.setData=ri;function Os(){co=!0;let c,p;s==1&&(Ke>0?(Ue=
Lo[0]=0,We=Lo[1]=Ke-1,c=e[0][Ue],p=e[0][We],Z==2?(c=Ue,p=We):c==p&&(Z==3?[c,p]=ls(c,c,L.log,!1):Z==4?[c,p]=Rr(c,c,L.log,!1):L.time?p=c+Fe(86400/P):[c,p]=rs(c,p,
Fr,!0))):(Ue=Lo[0]=c=null,We=Lo[1]=p=null)),qt(N,c,p)}let Do,An,Is,Us,Ws,Gs,zs,Hs,Vs,it;function ii(c,p,m,g,w,x){c??=la,m??=Or,g??="butt",w??=la,x??="round",c!=
Do&&(d.strokeStyle=Do=c),w!=An&&(d.fillStyle=An=w),p!=Is&&(d.lineWidth=Is=p),x!=Ws&&(d.lineJoin=Ws=x),g!=Gs&&(d.lineCap=Gs=g),m!=Us&&d.setLineDash(Us=m)}function ai(c,p,m,g){
p!=An&&(d.fillStyle=An=p),c!=zs&&(d.font=zs=c),m!=Hs&&(d.textAlign=Hs=m),g!=Vs&&(d.textBaseline=Vs=g)}function Bs(c,p,m,g,w=0){if(g.length>0&&c.auto(o,co)&&(p==
null||p.min==null)){let x=ue(Ue,0),T=ue(We,g.length-1),A=m.min==null?up(g,x,T,w,c.distr==3):[m.min,m.max];c.min=Lt(c.min,m.min=A[0]),c.max=nt(c.max,m.max=A[1])}}
let li={min:null,max:null};function Hc(){for(let g in E){let w=E[g];z[g]==null&&(w.min==null||z[N]!=null&&w.auto(o,co))&&(z[g]=li)}for(let g in E){let w=E[g];z[g]==
null&&w.from!=null&&z[w.from]!=null&&(z[g]=li)}z[N]!=null&&Cn(!0);let c={};for(let g in z){let w=z[g];if(w!=null){let x=c[g]=to(E[g],bp);if(w.min!=null)Ne(x,w);else if(g!=
N||s==2)if(Ke==0&&x.from==null){let T=x.range(o,null,null,g);x.min=T[0],x.max=T[1]}else x.min=ge,x.max=-ge}}if(Ke>0){k.forEach((g,w)=>{if(s==1){let x=g.scale,T=z[x];
if(T==null)return;let A=c[x];if(w==0){let D=A.range(o,A.min,A.max,x);A.min=D[0],A.max=D[1],Ue=Ct(A.min,e[0]),We=Ct(A.max,e[0]),We-Ue>1&&(e[0][Ue]<A.min&&Ue++,e[0][We]>
A.max&&We--),g.min=Tt[Ue],g.max=Tt[We]}else g.show&&g.auto&&Bs(A,T,g,e[w],g.sorted);g.idxs[0]=Ue,g.idxs[1]=We}else if(w>0&&g.show&&g.auto){let[x,T]=g.facets,A=x.
scale,D=T.scale,[F,$]=e[w],U=c[A],X=c[D];U!=null&&Bs(U,z[A],x,F,x.sorted),X!=null&&Bs(X,z[D],T,$,T.sorted),g.min=T.min,g.max=T.max}});for(let g in c){let w=c[g],
x=z[g];if(w.from==null&&(x==null||x.min==null)){let T=w.range(o,w.min==ge?null:w.min,w.max==-ge?null:w.max,g);w.min=T[0],w.max=T[1]}}}for(let g in c){let w=c[g];
if(w.from!=null){let x=c[w.from];if(x.min==null)w.min=w.max=null;else{let T=w.range(o,x.min,x.max,g);w.min=T[0],w.max=T[1]}}}let p={},m=!1;for(let g in c){let w=c[g],
x=E[g];if(x.min!=w.min||x.max!=w.max){x.min=w.min,x.max=w.max;let T=x.distr;x._min=T==3?Ht(x.min):T==4?yr(x.min,x.asinh):T==100?x.fwd(x.min):x.min,x._max=T==3?Ht(
x.max):T==4?yr(x.max,x.asinh):T==100?x.fwd(x.max):x.max,p[g]=m=!0}}if(m){k.forEach((g,w)=>{s==2?w>0&&p.y&&(g._paths=null):p[g.scale]&&(g._paths=null)});for(let g in p)
Mn=!0,He("setScale",g);Ie&&G.left>=0&&(an=yt=!0)}for(let g in z)z[g]=null}function Vc(c){let p=Tr(Ue-1,0,Ke-1),m=Tr(We+1,0,Ke-1);for(;c[p]==null&&p>0;)p--;for(;c[m]==
null&&m<Ke-1;)m++;return[p,m]}function Bc(){if(Ke>0){let c=k.some(p=>p._focus)&&it!=Nt.alpha;c&&(d.globalAlpha=it=Nt.alpha),k.forEach((p,m)=>{if(m>0&&p.show&&(ci(
m,!1),ci(m,!0),p._paths==null)){let g=it;it!=p.alpha&&(d.globalAlpha=it=p.alpha);let w=s==2?[0,e[m][0].length-1]:Vc(e[m]);p._paths=p.paths(o,m,w[0],w[1]),it!=g&&
(d.globalAlpha=it=g)}}),k.forEach((p,m)=>{if(m>0&&p.show){let g=it;it!=p.alpha&&(d.globalAlpha=it=p.alpha),p._paths!=null&&ui(m,!1);{let w=p._paths!=null?p._paths.
gaps:null,x=p.points.show(o,m,Ue,We,w),T=p.points.filter(o,m,x,w);(x||T)&&(p.points._paths=p.points.paths(o,m,Ue,We,T),ui(m,!0))}it!=g&&(d.globalAlpha=it=g),He(
"drawSeries",m)}}),c&&(d.globalAlpha=it=1)}}function ci(c,p){let m=p?k[c].points:k[c];m._stroke=m.stroke(o,c),m._fill=m.fill(o,c)}function ui(c,p){let m=p?k[c].
points:k[c],{stroke:g,fill:w,clip:x,flags:T,_stroke:A=m._stroke,_fill:D=m._fill,_width:F=m.width}=m._paths;F=ye(F*de,3);let $=null,U=F%2/2;p&&D==null&&(D=F>0?"#\
fff":A);let X=m.pxAlign==1&&U>0;if(X&&d.translate(U,U),!p){let pe=at-F/2,ce=gt-F/2,ne=rt+F,J=Mt+F;$=new Path2D,$.rect(pe,ce,ne,J)}p?js(A,F,m.dash,m.cap,D,g,w,T,
x):jc(c,A,F,m.dash,m.cap,D,g,w,T,$,x),X&&d.translate(-U,-U)}function jc(c,p,m,g,w,x,T,A,D,F,$){let U=!1;D!=0&&q.forEach((X,pe)=>{if(X.series[0]==c){let ce=k[X.series[1]],
ne=e[X.series[1]],J=(ce._paths||Po).band;Xt(J)&&(J=X.dir==1?J[0]:J[1]);let B,ke=null;ce.show&&J&&dp(ne,Ue,We)?(ke=X.fill(o,pe)||x,B=ce._paths.clip):J=null,js(p,
m,g,w,ke,T,A,D,F,$,B,J),U=!0}}),U||js(p,m,g,w,x,T,A,D,F,$)}let pi=no|_r;function js(c,p,m,g,w,x,T,A,D,F,$,U){ii(c,p,m,g,w),(D||F||U)&&(d.save(),D&&d.clip(D),F&&
d.clip(F)),U?(A&pi)==pi?(d.clip(U),$&&d.clip($),Ro(w,T),No(c,x,p)):A&_r?(Ro(w,T),d.clip(U),No(c,x,p)):A&no&&(d.save(),d.clip(U),$&&d.clip($),Ro(w,T),d.restore(),
No(c,x,p)):(Ro(w,T),No(c,x,p)),(D||F||U)&&d.restore()}function No(c,p,m){m>0&&(p instanceof Map?p.forEach((g,w)=>{d.strokeStyle=Do=w,d.stroke(g)}):p!=null&&c&&d.
stroke(p))}function Ro(c,p){p instanceof Map?p.forEach((m,g)=>{d.fillStyle=An=g,d.fill(m)}):p!=null&&c&&d.fill(p)}function qc(c,p,m,g){let w=_[c],x;if(g<=0)x=[0,
0];else{let T=w._space=w.space(o,c,p,m,g),A=w._incrs=w.incrs(o,c,p,m,g,T);x=Nd(p,m,A,g,T)}return w._found=x}function qs(c,p,m,g,w,x,T,A,D,F){let $=T%2/2;M==1&&d.
translate($,$),ii(A,T,D,F,A),d.beginPath();let U,X,pe,ce,ne=w+(g==0||g==3?-x:x);m==0?(X=w,ce=ne):(U=w,pe=ne);for(let J=0;J<c.length;J++)p[J]!=null&&(m==0?U=pe=c[J]:
X=ce=c[J],d.moveTo(U,X),d.lineTo(pe,ce));d.stroke(),M==1&&d.translate(-$,-$)}function Kc(c){let p=!0;return _.forEach((m,g)=>{if(!m.show)return;let w=E[m.scale];
if(w.min==null){m._show&&(p=!1,m._show=!1,Cn(!1));return}else m._show||(p=!1,m._show=!0,Cn(!1));let x=m.side,T=x%2,{min:A,max:D}=w,[F,$]=qc(g,A,D,T==0?te:O);if($==
0)return;let U=w.distr==2,X=m._splits=m.splits(o,g,A,D,F,$,U),pe=w.distr==2?X.map(B=>Tt[B]):X,ce=w.distr==2?Tt[X[1]]-Tt[X[0]]:F,ne=m._values=m.values(o,m.filter(
o,pe,g,$,ce),g,$,ce);m._rotate=x==2?m.rotate(o,ne,g,$):0;let J=m._size;m._size=kt(m.size(o,ne,g,c)),J!=null&&m._size!=J&&(p=!1)}),p}function Yc(c){let p=!0;return si.
forEach((m,g)=>{let w=m(o,g,cn,c);w!=Bt[g]&&(p=!1),Bt[g]=w}),p}function Jc(){for(let c=0;c<_.length;c++){let p=_[c];if(!p.show||!p._show)continue;let m=p.side,g=m%
2,w,x,T=p.stroke(o,c),A=m==0||m==3?-1:1,[D,F]=p._found;if(p.label!=null){let et=p.labelGap*A,ut=Fe((p._lpos+et)*de);ai(p.labelFont[0],T,"center",m==2?"top":aa),
d.save(),g==1?(w=x=0,d.translate(ut,Fe(gt+Mt/2)),d.rotate((m==3?-os:os)/2)):(w=Fe(at+rt/2),x=ut);let dn=Ja(p.label)?p.label(o,c,D,F):p.label;d.fillText(dn,w,x),
d.restore()}if(F==0)continue;let $=E[p.scale],U=g==0?rt:Mt,X=g==0?at:gt,pe=p._splits,ce=$.distr==2?pe.map(et=>Tt[et]):pe,ne=$.distr==2?Tt[pe[1]]-Tt[pe[0]]:D,J=p.
ticks,B=p.border,ke=J.show?J.size:0,Ae=Fe(ke*de),Ve=Fe((p.alignTo==2?p._size-ke-p.gap:p.gap)*de),fe=p._rotate*-os/180,Ce=S(p._pos*de),lt=(Ae+Ve)*A,Xe=Ce+lt;x=g==
0?Xe:0,w=g==1?Xe:0;let bt=p.font[0],Pt=p.align==1?Jn:p.align==2?fr:fe>0?Jn:fe<0?fr:g==0?"center":m==3?fr:Jn,$t=fe||g==1?"middle":m==2?"top":aa;ai(bt,T,Pt,$t);let ct=p.
font[1]*p.lineGap,xt=pe.map(et=>S(a(et,$,U,X))),Et=p._values;for(let et=0;et<Et.length;et++){let ut=Et[et];if(ut!=null){g==0?w=xt[et]:x=xt[et],ut=""+ut;let dn=ut.
indexOf(`
`)==-1?[ut]:ut.split(/\n/gm);for(let tt=0;tt<dn.length;tt++){let Ci=dn[tt];fe?(d.save(),d.translate(w,x+tt*ct),d.rotate(fe),d.fillText(Ci,0,0),d.restore()):d.fillText(
Ci,w,x+tt*ct)}}}J.show&&qs(xt,J.filter(o,ce,c,F,ne),g,m,Ce,Ae,ye(J.width*de,3),J.stroke(o,c),J.dash,J.cap);let Ot=p.grid;Ot.show&&qs(xt,Ot.filter(o,ce,c,F,ne),g,
g==0?2:1,g==0?gt:at,g==0?Mt:rt,ye(Ot.width*de,3),Ot.stroke(o,c),Ot.dash,Ot.cap),B.show&&qs([Ce],[1],g==0?1:0,g==0?1:2,g==1?gt:at,g==1?Mt:rt,ye(B.width*de,3),B.stroke(
o,c),B.dash,B.cap)}He("drawAxes")}function Cn(c){k.forEach((p,m)=>{m>0&&(p._paths=null,c&&(s==1?(p.min=null,p.max=null):p.facets.forEach(g=>{g.min=null,g.max=null})))})}
let Fo=!1,Ks=!1,uo=[];function Zc(){Ks=!1;for(let c=0;c<uo.length;c++)He(...uo[c]);uo.length=0}function Ln(){Fo||(Pp(di),Fo=!0)}function Qc(c,p=!1){Fo=!0,Ks=p,c(
o),di(),p&&uo.length>0&&queueMicrotask(Zc)}o.batch=Qc;function di(){if(Fs&&(Hc(),Fs=!1),Mn&&($c(),Mn=!1),Ao){if(Te(b,Jn,be),Te(b,"top",Re),Te(b,ko,te),Te(b,So,O),
Te(y,Jn,be),Te(y,"top",Re),Te(y,ko,te),Te(y,So,O),Te(f,ko,Wt),Te(f,So,on),h.width=Fe(Wt*de),h.height=Fe(on*de),_.forEach(({_el:c,_show:p,_size:m,_pos:g,side:w})=>{
if(c!=null)if(p){let x=w===3||w===0?m:0,T=w%2==1;Te(c,T?"left":"top",g-x),Te(c,T?"width":"height",m),Te(c,T?"top":"left",T?Re:be),Te(c,T?"height":"width",T?O:te),
Sr(c,yn)}else dt(c,yn)}),Do=An=Is=Ws=Gs=zs=Hs=Vs=Us=null,it=1,fo(!0),be!=Sn||Re!=sn||te!=Dt||O!=rn){Cn(!1);let c=te/Dt,p=O/rn;if(Ie&&!an&&G.left>=0){G.left*=c,G.
top*=p,Dn&&It(Dn,Fe(G.left),0,te,O),Nn&&It(Nn,0,Fe(G.top),te,O);for(let m=0;m<wt.length;m++){let g=wt[m];g!=null&&(En[m]*=c,_n[m]*=p,It(g,kt(En[m]),kt(_n[m]),te,
O))}}if(ve.show&&!Co&&ve.left>=0&&ve.width>0){ve.left*=c,ve.width*=c,ve.top*=p,ve.height*=p;for(let m in er)Te($n,m,ve[m])}Sn=be,sn=Re,Dt=te,rn=O}He("setSize"),
Ao=!1}Wt>0&&on>0&&(d.clearRect(0,0,h.width,h.height),He("drawClear"),V.forEach(c=>c()),He("draw")),ve.show&&Co&&($o(ve),Co=!1),Ie&&an&&(pn(null,!0,!1),an=!1),ee.
show&&ee.live&&yt&&(Qs(),yt=!1),l||(l=!0,o.status=1,He("ready")),co=!1,Fo=!1}o.redraw=(c,p)=>{Mn=p||!1,c!==!1?qt(N,L.min,L.max):Ln()};function Ys(c,p){let m=E[c];
if(m.from==null){if(Ke==0){let g=m.range(o,p.min,p.max,c);p.min=g[0],p.max=g[1]}if(p.min>p.max){let g=p.min;p.min=p.max,p.max=g}if(Ke>1&&p.min!=null&&p.max!=null&&
p.max-p.min<1e-16)return;c==N&&m.distr==2&&Ke>0&&(p.min=Ct(p.min,e[0]),p.max=Ct(p.max,e[0]),p.min==p.max&&p.max++),z[c]=p,Fs=!0,Ln()}}o.setScale=Ys;let Js,Zs,Dn,
Nn,hi,fi,Rn,Fn,mi,gi,xe,Ee,jt=!1,Ye=G.drag,Ge=Ye.x,ze=Ye.y;Ie&&(G.x&&(Js=vt(Ju,y)),G.y&&(Zs=vt(Zu,y)),L.ori==0?(Dn=Js,Nn=Zs):(Dn=Zs,Nn=Js),xe=G.left,Ee=G.top);let ve=o.
select=Ne({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),$n=ve.show?vt(Yu,ve.over?y:b):null;function $o(c,p){if(ve.show){for(let m in c)ve[m]=c[m],m in
er&&Te($n,m,c[m]);p!==!1&&He("setSelect")}}o.setSelect=$o;function Xc(c){if(k[c].show)_e&&Sr(Pe[c],yn);else if(_e&&dt(Pe[c],yn),Ie){let m=Pn?wt[0]:wt[c];m!=null&&
It(m,-10,-10,te,O)}}function qt(c,p,m){Ys(c,{min:p,max:m})}function Rt(c,p,m,g){p.focus!=null&&su(c),p.show!=null&&k.forEach((w,x)=>{x>0&&(c==x||c==null)&&(w.show=
p.show,Xc(x),s==2?(qt(w.facets[0].scale,null,null),qt(w.facets[1].scale,null,null)):qt(w.scale,null,null),Ln())}),m!==!1&&He("setSeries",c,p),g&&mo("setSeries",
o,c,p)}o.setSeries=Rt;function eu(c,p){Ne(q[c],p)}function tu(c,p){c.fill=oe(c.fill||null),c.dir=ue(c.dir,-1),p=p??q.length,q.splice(p,0,c)}function nu(c){c==null?
q.length=0:q.splice(c,1)}o.addBand=tu,o.setBand=eu,o.delBand=nu;function ou(c,p){k[c].alpha=p,Ie&&wt[c]!=null&&(wt[c].style.opacity=p),_e&&Pe[c]&&(Pe[c].style.opacity=
p)}let Gt,Kt,un,On={focus:!0};function su(c){if(c!=un){let p=c==null,m=Nt.alpha!=1;k.forEach((g,w)=>{if(s==1||w>0){let x=p||w==0||w==c;g._focus=p?null:x,m&&ou(w,
x?1:Nt.alpha)}}),un=c,m&&Ln()}}_e&&Tn&&Qe(pa,ae,c=>{G._lock||(ln(c),un!=null&&Rt(null,On,!0,Le.setSeries))});function Ft(c,p,m){let g=E[p];m&&(c=c/de-(g.ori==1?
Re:be));let w=te;g.ori==1&&(w=O,c=w-c),g.dir==-1&&(c=w-c);let x=g._min,T=g._max,A=c/w,D=x+(T-x)*A,F=g.distr;return F==3?Xn(10,D):F==4?fp(D,g.asinh):F==100?g.bwd(
D):D}function ru(c,p){let m=Ft(c,N,p);return Ct(m,e[0],Ue,We)}o.valToIdx=c=>Ct(c,e[0]),o.posToIdx=ru,o.posToVal=Ft,o.valToPos=(c,p,m)=>E[p].ori==0?r(c,E[p],m?rt:
te,m?at:0):i(c,E[p],m?Mt:O,m?gt:0),o.setCursor=(c,p,m)=>{xe=c.left,Ee=c.top,pn(null,p,m)};function yi(c,p){Te($n,Jn,ve.left=c),Te($n,ko,ve.width=p)}function wi(c,p){
Te($n,"top",ve.top=c),Te($n,So,ve.height=p)}let po=L.ori==0?yi:wi,ho=L.ori==1?yi:wi;function iu(){if(_e&&ee.live)for(let c=s==2?1:0;c<k.length;c++){if(c==0&&K)continue;
let p=ee.values[c],m=0;for(let g in p)St[c][m++].firstChild.nodeValue=p[g]}}function Qs(c,p){if(c!=null&&(c.idxs?c.idxs.forEach((m,g)=>{le[g]=m}):wp(c.idx)||le.
fill(c.idx),ee.idx=le[0]),_e&&ee.live){for(let m=0;m<k.length;m++)(m>0||s==1&&!K)&&au(m,le[m]);iu()}yt=!1,p!==!1&&He("setLegend")}o.setLegend=Qs;function au(c,p){
let m=k[c],g=c==0&&Z==2?Tt:e[c],w;K?w=m.values(o,c,p)??re:(w=m.value(o,p==null?null:g[p],c,p),w=w==null?re:{_:w}),ee.values[c]=w}function pn(c,p,m){mi=xe,gi=Ee,
[xe,Ee]=G.move(o,xe,Ee),G.left=xe,G.top=Ee,Ie&&(Dn&&It(Dn,Fe(xe),0,te,O),Nn&&It(Nn,0,Fe(Ee),te,O));let g,w=Ue>We;Gt=ge,Kt=null;let x=L.ori==0?te:O,T=L.ori==1?te:
O;if(xe<0||Ke==0||w){g=G.idx=null;for(let A=0;A<k.length;A++){let D=wt[A];D!=null&&It(D,-10,-10,te,O)}Tn&&Rt(null,On,!0,c==null&&Le.setSeries),ee.live&&(le.fill(
g),yt=!0)}else{let A,D,F;s==1&&(A=L.ori==0?xe:Ee,D=Ft(A,N),g=G.idx=Ct(D,e[0],Ue,We),F=I(e[0][g],L,x,0));let $=-10,U=-10,X=0,pe=0,ce=!0,ne="",J="";for(let B=s==2?
1:0;B<k.length;B++){let ke=k[B],Ae=le[B],Ve=Ae==null?null:s==1?e[B][Ae]:e[B][1][Ae],fe=G.dataIdx(o,B,g,D),Ce=fe==null?null:s==1?e[B][fe]:e[B][1][fe];if(yt=yt||Ce!=
Ve||fe!=Ae,le[B]=fe,B>0&&ke.show){let lt=fe==null?-10:fe==g?F:I(s==1?e[0][fe]:e[B][0][fe],L,x,0),Xe=Ce==null?-10:j(Ce,s==1?E[ke.scale]:E[ke.facets[1].scale],T,0);
if(Tn&&Ce!=null){let bt=L.ori==1?xe:Ee,Pt=$e(Nt.dist(o,B,fe,Xe,bt));if(Pt<Gt){let $t=Nt.bias;if($t!=0){let ct=Ft(bt,ke.scale),xt=Ce>=0?1:-1,Et=ct>=0?1:-1;Et==xt&&
(Et==1?$t==1?Ce>=ct:Ce<=ct:$t==1?Ce<=ct:Ce>=ct)&&(Gt=Pt,Kt=B)}else Gt=Pt,Kt=B}}if(yt||Pn){let bt,Pt;L.ori==0?(bt=lt,Pt=Xe):(bt=Xe,Pt=lt);let $t,ct,xt,Et,Ot,et,ut=!0,
dn=Ze.bbox;if(dn!=null){ut=!1;let tt=dn(o,B);xt=tt.left,Et=tt.top,$t=tt.width,ct=tt.height}else xt=bt,Et=Pt,$t=ct=Ze.size(o,B);if(et=Ze.fill(o,B),Ot=Ze.stroke(o,
B),Pn)B==Kt&&Gt<=Nt.prox&&($=xt,U=Et,X=$t,pe=ct,ce=ut,ne=et,J=Ot);else{let tt=wt[B];tt!=null&&(En[B]=xt,_n[B]=Et,wa(tt,$t,ct,ut),ga(tt,et,Ot),It(tt,kt(xt),kt(Et),
te,O))}}}}if(Pn){let B=Nt.prox,ke=un==null?Gt<=B:Gt>B||Kt!=un;if(yt||ke){let Ae=wt[0];Ae!=null&&(En[0]=$,_n[0]=U,wa(Ae,X,pe,ce),ga(Ae,ne,J),It(Ae,kt($),kt(U),te,
O))}}}if(ve.show&&jt)if(c!=null){let[A,D]=Le.scales,[F,$]=Le.match,[U,X]=c.cursor.sync.scales,pe=c.cursor.drag;if(Ge=pe._x,ze=pe._y,Ge||ze){let{left:ce,top:ne,width:J,
height:B}=c.select,ke=c.scales[U].ori,Ae=c.posToVal,Ve,fe,Ce,lt,Xe,bt=A!=null&&F(A,U),Pt=D!=null&&$(D,X);bt&&Ge?(ke==0?(Ve=ce,fe=J):(Ve=ne,fe=B),Ce=E[A],lt=I(Ae(
Ve,U),Ce,x,0),Xe=I(Ae(Ve+fe,U),Ce,x,0),po(Lt(lt,Xe),$e(Xe-lt))):po(0,x),Pt&&ze?(ke==1?(Ve=ce,fe=J):(Ve=ne,fe=B),Ce=E[D],lt=j(Ae(Ve,X),Ce,T,0),Xe=j(Ae(Ve+fe,X),Ce,
T,0),ho(Lt(lt,Xe),$e(Xe-lt))):ho(0,T)}else tr()}else{let A=$e(mi-hi),D=$e(gi-fi);if(L.ori==1){let X=A;A=D,D=X}Ge=Ye.x&&A>=Ye.dist,ze=Ye.y&&D>=Ye.dist;let F=Ye.uni;
F!=null?Ge&&ze&&(Ge=A>=F,ze=D>=F,!Ge&&!ze&&(D>A?ze=!0:Ge=!0)):Ye.x&&Ye.y&&(Ge||ze)&&(Ge=ze=!0);let $,U;Ge&&(L.ori==0?($=Rn,U=xe):($=Fn,U=Ee),po(Lt($,U),$e(U-$)),
ze||ho(0,T)),ze&&(L.ori==1?($=Rn,U=xe):($=Fn,U=Ee),ho(Lt($,U),$e(U-$)),Ge||po(0,x)),!Ge&&!ze&&(po(0,0),ho(0,0))}if(Ye._x=Ge,Ye._y=ze,c==null){if(m){if(Ai!=null){
let[A,D]=Le.scales;Le.values[0]=A!=null?Ft(L.ori==0?xe:Ee,A):null,Le.values[1]=D!=null?Ft(L.ori==1?xe:Ee,D):null}mo(mr,o,xe,Ee,te,O,g)}if(Tn){let A=m&&Le.setSeries,
D=Nt.prox;un==null?Gt<=D&&Rt(Kt,On,!0,A):Gt>D?Rt(null,On,!0,A):Kt!=un&&Rt(Kt,On,!0,A)}}yt&&(ee.idx=g,Qs()),p!==!1&&He("setCursor")}let Yt=null;Object.defineProperty(
o,"rect",{get(){return Yt==null&&fo(!1),Yt}});function fo(c=!1){c?Yt=null:(Yt=y.getBoundingClientRect(),He("syncRect",Yt))}function bi(c,p,m,g,w,x,T){G._lock||jt&&
c!=null&&c.movementX==0&&c.movementY==0||(Xs(c,p,m,g,w,x,T,!1,c!=null),c!=null?pn(null,!0,!0):pn(p,!0,!1))}function Xs(c,p,m,g,w,x,T,A,D){if(Yt==null&&fo(!1),ln(
c),c!=null)m=c.clientX-Yt.left,g=c.clientY-Yt.top;else{if(m<0||g<0){xe=-10,Ee=-10;return}let[F,$]=Le.scales,U=p.cursor.sync,[X,pe]=U.values,[ce,ne]=U.scales,[J,
B]=Le.match,ke=p.axes[0].side%2==1,Ae=L.ori==0?te:O,Ve=L.ori==1?te:O,fe=ke?x:w,Ce=ke?w:x,lt=ke?g:m,Xe=ke?m:g;if(ce!=null?m=J(F,ce)?a(X,E[F],Ae,0):-10:m=Ae*(lt/fe),
ne!=null?g=B($,ne)?a(pe,E[$],Ve,0):-10:g=Ve*(Xe/Ce),L.ori==1){let bt=m;m=g,g=bt}}D&&(p==null||p.cursor.event.type==mr)&&((m<=1||m>=te-1)&&(m=mn(m,te)),(g<=1||g>=
O-1)&&(g=mn(g,O))),A?(hi=m,fi=g,[Rn,Fn]=G.move(o,m,g)):(xe=m,Ee=g)}let er={width:0,height:0,left:0,top:0};function tr(){$o(er,!1)}let xi,vi,ki,Si;function Mi(c,p,m,g,w,x,T){
jt=!0,Ge=ze=Ye._x=Ye._y=!1,Xs(c,p,m,g,w,x,T,!0,!1),c!=null&&(Qe(gr,vr,Ti,!1),mo(ca,o,Rn,Fn,te,O,null));let{left:A,top:D,width:F,height:$}=ve;xi=A,vi=D,ki=F,Si=$}
function Ti(c,p,m,g,w,x,T){jt=Ye._x=Ye._y=!1,Xs(c,p,m,g,w,x,T,!1,!0);let{left:A,top:D,width:F,height:$}=ve,U=F>0||$>0,X=xi!=A||vi!=D||ki!=F||Si!=$;if(U&&X&&$o(ve),
Ye.setScale&&U&&X){let pe=A,ce=F,ne=D,J=$;if(L.ori==1&&(pe=D,ce=$,ne=A,J=F),Ge&&qt(N,Ft(pe,N),Ft(pe+ce,N)),ze)for(let B in E){let ke=E[B];B!=N&&ke.from==null&&ke.
min!=ge&&qt(B,Ft(ne+J,B),Ft(ne,B))}tr()}else G.lock&&(G._lock=!G._lock,pn(p,!0,c!=null));c!=null&&(kn(gr,vr),mo(gr,o,xe,Ee,te,O,null))}function lu(c,p,m,g,w,x,T){
if(G._lock)return;ln(c);let A=jt;if(jt){let D=!0,F=!0,$=10,U,X;L.ori==0?(U=Ge,X=ze):(U=ze,X=Ge),U&&X&&(D=xe<=$||xe>=te-$,F=Ee<=$||Ee>=O-$),U&&D&&(xe=xe<Rn?0:te),
X&&F&&(Ee=Ee<Fn?0:O),pn(null,!0,!0),jt=!1}xe=-10,Ee=-10,le.fill(null),pn(null,!0,!0),A&&(jt=A)}function Pi(c,p,m,g,w,x,T){G._lock||(ln(c),Os(),tr(),c!=null&&mo(
da,o,xe,Ee,te,O,null))}function Ei(){_.forEach(Rd),$s(o.width,o.height,!0)}wn(ss,Qn,Ei);let In={};In.mousedown=Mi,In.mousemove=bi,In.mouseup=Ti,In.dblclick=Pi,In.
setSeries=(c,p,m,g)=>{let w=Le.match[2];m=w(o,p,m),m!=-1&&Rt(m,g,!0,!1)},Ie&&(Qe(ca,y,Mi),Qe(mr,y,bi),Qe(ua,y,c=>{ln(c),fo(!1)}),Qe(pa,y,lu),Qe(da,y,Pi),Ar.add(
o),o.syncRect=fo);let Oo=o.hooks=t.hooks||{};function He(c,p,m){Ks?uo.push([c,p,m]):c in Oo&&Oo[c].forEach(g=>{g.call(null,o,p,m)})}(t.plugins||[]).forEach(c=>{
for(let p in c.hooks)Oo[p]=(Oo[p]||[]).concat(c.hooks[p])});let _i=(c,p,m)=>m,Le=Ne({key:null,setSeries:!1,filters:{pub:Sa,sub:Sa},scales:[N,k[1]?k[1].scale:null],
match:[Ma,Ma,_i],values:[null,null]},G.sync);Le.match.length==2&&Le.match.push(_i),G.sync=Le;let Ai=Le.key,nr=xl(Ai);function mo(c,p,m,g,w,x,T){Le.filters.pub(c,
p,m,g,w,x,T)&&nr.pub(c,p,m,g,w,x,T)}nr.sub(o);function cu(c,p,m,g,w,x,T){Le.filters.sub(c,p,m,g,w,x,T)&&In[c](null,p,m,g,w,x,T)}o.pub=cu;function uu(){nr.unsub(
o),Ar.delete(o),nn.clear(),Mr(ss,Qn,Ei),u.remove(),ae?.remove(),He("destroy")}o.destroy=uu;function or(){He("init",t,e),ri(e||t.data,!1),z[N]?Ys(N,z[N]):Os(),Co=
ve.show&&(ve.width>0||ve.height>0),an=yt=!0,$s(t.width,t.height)}return k.forEach(oi),_.forEach(zc),n?n instanceof HTMLElement?(n.appendChild(u),or()):n(o,or):or(),
o}Oe.assign=Ne;Oe.fmtNum=$r;Oe.rangeNum=rs;Oe.rangeLog=ls;Oe.rangeAsinh=Rr;Oe.orient=xn;Oe.pxRatio=de;Oe.join=Tp;Oe.fmtDate=Ir,Oe.tzDate=$p;Oe.sync=xl;{Oe.addGap=
wd,Oe.clipGaps=ps;let t=Oe.paths={points:Pl};t.linear=_l,t.stepped=vd,t.bars=kd,t.spline=Md}var ms=128,Dl=50,Fd=.25,$d=t=>[t.ray,t.truth,t.sensor,t.noReturn],Od=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),Id=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),gs=(t,e)=>({font:ir,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function Nl(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:ms})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:ms}),s=n()),o)}function Rl(t,e){let{session:n}=t,o=v("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${Dl}`]],()=>s,y=>{s=y,u=null,n.changed()}),
i=0,a=-1/0,l=-1,u=null,d=Nl(o,()=>{let y=$d(e()),M=Array.from({length:i},(S,P)=>({label:`chain ${P+1}`,stroke:y[P%y.length],width:1,points:{show:!1}}));return new Oe(
{width:100,height:ms,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,Id,0,0],scales:{x:{time:!1,range:(S,P,k)=>[P,Math.max(k,P+1)]},y:{range:(S,P,k)=>zd(
Math.max(P,a),k)}},axes:[gs(e,26),gs(e,Od)],series:[{label:"sweep"},...M],hooks:{draw:[S=>Hd(S,l,e())]}},[[],...M.map(()=>[])],o)},e),f=v("span",{className:"cap\
tion",textContent:"log joint by sweep"}),b=v("div",{className:"charted"},v("div",{className:"buttons"},r,f),o);return t.each(()=>{let y=n.shown,M=y?.traced?.length?
y.trace.length/y.traced.length:0;if(C(b,"hidden",M===0),!y||!M)return;let S=n.document?.source.kind==="run"?"draw":"sweep";C(f,"textContent",`log joint by ${S}`);
let P=y.layer==="draw"&&n.draws.count?(n.draw+1)*y.traced[y.traced.length-1]/n.draws.count:-1,k=d(M!==i&&(i=M,!0));if(!k||u===y&&l===P&&k.data[0].length)return;
[u,l]=[y,P],a=s==="all"?Gd(y,M):-1/0;let _=Ud(y,M,s);k.setData(_),o.setAttribute("data-sweeps",_[0].join())}),b}function Ud({trace:t,traced:e},n,o){let s=o==="a\
ll"?Wd(e):[...e.keys()].filter(i=>e[i]<=Dl),r=i=>Float32Array.from(s,a=>i[a]);return[r(e),...Array.from({length:n},(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}
function Wd(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,o=-1/0;return[...t.keys()].filter(s=>t[s]<o&&s<e-1?!1:(o=t[s]+n,!0))}function Gd({trace:t,
traced:e},n){let o=e.length,s=e.findIndex(r=>r>=Fd*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.min(...t.slice(i*o+s,(i+1)*o))))}function zd(t,e){
let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function Hd(t,e,n){if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.
save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.restore())}function Fl(t,e){let{session:n}=t,o=v("div",{className:"chart",role:"img","aria-label":"\
Histogram of the particles' weights"}),s=v("div",{className:"caption",textContent:"particles by weight, nats below the heaviest"}),r=v("div",{className:"charted"},
s,o),a=Nl(o,()=>new Oe({width:100,height:ms,legend:{show:!1},cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(u,h,d)=>[h,d]},y:{distr:3,range:(u,h,d)=>[
.5,Math.max(10,2*d)]}},axes:[gs(e,26),{...gs(e,52),values:(u,h)=>h.map(d=>d>=1?String(d):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Oe.paths.bars?.({size:[
.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),l=null;return t.each(()=>{let u=n.shown;C(r,"hidden",!u?.weights);let h=u?.weights&&a(!1);if(!u?.weights||!h||
l===u&&h.data[0].length)return;l=u;let d=[...u.weights],f=-(u.lowest??-1)/d.length,b=[...d.map((y,M)=>(u.lowest??-1)+M*f),0];h.setData([b,[...d.map(y=>y||null),
null]])}),r}function $l(t){let{session:e,hand:n}=t,{decisions:o}=e,s=v("p",{className:"said",role:"status"}),r=v("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,u=>o.set({radius:u}),{min:.01,max:100,step:"any"}),t.numberInput("Highest risk",()=>o.risk,u=>o.set({risk:u}),{min:1e-4,max:.99,step:"any"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{C(l,"textContent",i()),C(s,"textContent",n.tool==="path"?Vd(t):Bd(t))}),a}function Vd({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${Me(
o.length_m,2)} m, free with probability ${Me(o.probability,3)} ± ${Me(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${Me(o.independent,
3)}.${r}`}function Bd({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.
nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${Me(Math.min(...e.nats),1)} to ${Me(o,1)} nats, cells taken for indepen\
dent; the best place has a ring.${s}`}var jd=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],qd="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",Kd="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). No beam has been where it is hatched.",Yd="Shown is what the readings tell about how likely each cell is to stop a beam: what is expected (m\
ean), one whole map that explains them (one draw), and how wide the 90 % interval is (width). No beam has been where it is hatched.",Jd="While you edit, the ans\
wer is belief propagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",Zd="The map is made from the scans of this log. Where it\
s poses are raw odometry, Run first infers where the robot was; then it samples maps, and keeps them as draws.",Qd="This is a saved run: its draws, and what the\
y say together.",Xd="Mouse: the wheel zooms, the middle button pans.",eh="Shift or the right button erases, and so does a click on a wall.",th="Touch: two finge\
rs zoom and pan.";function Ol(t){let{session:e}=t,n=v("div"),o=Vi.map(([i,a,l])=>{let u=v("tr",{},v("th",{scope:"row"},v("kbd",{textContent:i})),v("td",{textContent:a}));
return t.visible(u,()=>nh[l??"all"](e)),u}),s=v("p"),r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?Yd:Kd,l=e.editable?[`${qd} ${a}`,
Jd]:i==="log"?[a,Zd]:i==="run"?[a,Qd]:[a];l.join()!==r&&n.replaceChildren(...l.map(u=>v("p",{textContent:u}))),r=l.join(),C(s,"textContent",[Xd,...e.editable?[eh]:
[],th].join(" "))}),t.dialog("Help",n,s,v("table",{},v("tbody",{},...o)))}var nh={all:()=>!0,drawn:t=>t.editable,asked:t=>!t.recorded,inferred:t=>!t.recorded&&t.
document?.source.kind!=="run"};function Il(t){let e=()=>v("input",{type:"number",min:Se.cells[0],max:Se.cells[1],step:1,required:!0,value:"21"}),[n,o]=[e(),e()],
s=v("select",{});for(let[i,a]of jd)s.append(v("option",{value:i,textContent:a}));s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<60&&([n.
value,o.value]=["120","80"])});let r=v("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),v("div",{className:"buttons \
end"},v("button",{type:"submit",className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),
Number(o.value)],world:s.value}),t.hand.selected=null}),t.dialog("New map",r)}var oh="The link holds the walls, the sensors and all settings after its #, and no\
 token. It opens in this browser while the server runs; the part from # on can be put after the address of any bayesmap page.",sh="The link holds the file's nam\
e and all settings after its #, but no scans and no token. It opens in this browser while the server shows this file; the part from # on can be put after the ad\
dress of any bayesmap page that shows it.";function Ul(t){let e=v("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=v("span",{role:"status",className:"co\
pied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent=
"",2e3)},s=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),r=v("p");t.each(()=>C(r,"textContent",t.session.document?.source.kind==="simulatio\
n"?oh:sh));let i=t.dialog("Share",r,v("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var vn=t=>t.charAt(0).toUpperCase()+t.slice(1),ys=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=vn(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var Wl=t=>Math.round(t*180/Math.PI);function Gl(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(l,u)=>t.numberInput(l,()=>Number((o.pose?.[u]??0).toFixed(2)),h=>o.move(
{[u]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>Wl(o.pose?.yaw??0),l=>o.move({yaw:l*Math.PI/180}),{step:5}),i=v("p",{className:"words ghosted"}),a=t.
section("Ghost",v("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>C(i,"textContent",rh(t))),
a}function rh({session:t}){let{ghost:e}=t;if(e.trouble)return vn(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(h,d)=>h-o[d]).filter(Number.isFinite).sort((h,d)=>h-d),a=i.length?`${Me(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",u=r?` \
Rings are the hits of scan ${r.index+1}, taken ${Me(100*r.away,0)} cm from here, turned by ${Wl(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${u}`}function zl(t){let{session:e}=t,n=v("span",{className:"what"});t.each(()=>{let{grid:u,source:h}=e.document??{};if(!u||!h)return;let d=`${u.shape[0]} × ${u.shape[1]}\
 cells of ${+u.resolution.toPrecision(3)} m`;C(n,"textContent",h.name?`${h.name}, ${d}`:d)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),v("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let u of s)t.visible(u,()=>!e.recorded);let r=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=v("span",{className:"space"});return{element:v("header",{},v("h1",{textContent:"bayesmap"}),n,a,...s,ah(t),r,
i),nameTheme(u){let h=`Theme: ${u}`;pt(r,"aria-label",h),C(r,"title",h)}}}var ih=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function ah(t){
let{session:e}=t,n=(a,l,u,h)=>{let d=t.button(null,a,()=>t.command(`export ${l}`),{text:a,when:h});return u&&t.visible(d,()=>!e.recorded),d},o=v("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>ih(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),s=t.button("save","Export",()=>r(o.hidden),{text:"Export",when:()=>!!e.document}),r=a=>{o.hidden=!a,s.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};r(!1);let i=v("div",{className:"anchor"},s,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(r(!1),s.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||r(!1)}),o.addEventListener("click",()=>{r(!1),s.
focus()}),i}var lh={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 1\
1h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.\
5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7\
.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.\
5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function tn(t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg"),n=document.createElementNS(
"http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true"),n.setAttribute("d",lh[t]),e.append(n),e}var ws=({document:t})=>!t||t.source.kind==="simulation",Br=({recorded:t})=>!t,Hl="surface (zoom in)",Vl=[{mark:"truth",text:"true wall",when:ws,may:ws},{mark:"r\
ay",text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.
strokes.length,may:t=>!ws(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!ws(t)},{mark:"unobserved",text:"unobserved"},
{mark:"draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Br},
{mark:"path",text:"path, as wide as the robot",when:({decisions:t})=>!!t.path,may:Br}],Bl=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 % of a pl\
ace"}];function jl(t,e,n){return v("div",{className:"legend"},ch(t,e,n),uh(t))}function ch(t,e,n){let{session:o}=t,s=v("span",{className:"ramp"}),r=v("span",{className:"\
name"}),i=Vl.map(u=>{let[h,d]=bs(u),{mark:f,when:b}=u;return b&&t.visible(h,()=>b(o)),f==="stroke"&&t.each(()=>C(d,"textContent",bo(n())?u.text:Hl)),f==="path"&&
t.each(()=>h.firstElementChild?.classList.toggle("risky",o.decisions.path?.within_risk===!1)),h}),a=Bl.map(u=>bs(u)[0]);for(let u of a)t.visible(u,()=>!!o.where.
found);let l="";return t.each(()=>{let{layer:u}=o;C(r,"textContent",ql(o,u));let h=u==="entropy"||u==="width",d=`${h} ${e().ground}`;l!==d&&(l=d,s.style.background=
ur(h?Gn:f=>cr(e(),f)))}),v("ul",{"aria-label":"Legend"},v("li",{},r,v("span",{className:"scale"},"0",s,"1")),...i,ph(t),...a)}function uh(t){let{session:e}=t,n=[
"mean","draw","entropy","width"].map(l=>{let u=v("span");return t.each(()=>C(u,"textContent",ql(e,l))),l==="width"&&t.visible(u,()=>e.quantity.interval),u}),o=Vl.
map(l=>{let[u,h]=bs(l);l.mark==="stroke"&&(h.textContent=Hl);let{may:d}=l;return d&&t.visible(u,()=>d(e)),u}),s=v("span",{className:"scale"},"00.0",v("span",{className:"\
ramp"}),"000.0 nats"),r=[v("ul",{},v("li",{},"one more scan tells",s)),v("ul",{},...Bl.map(l=>bs(l)[0]))],i=v("li",{className:"either"},...r);t.visible(i,()=>Br(
e));let a=v("span",{className:"scale"},"0",v("span",{className:"ramp"}),"1");return v("ul",{className:"room","aria-hidden":"true"},v("li",{},v("span",{className:"\
name either"},...n),a),...o,i)}function bs({mark:t,text:e}){let n=v("i",{className:t});t==="sensor"&&n.append(tn("sensor"));let o=v("span",{textContent:e});return[
v("li",{},n,o),o]}function ql({quantity:t},e){let{kind:n,mean:o,value:s}=t;return e==="entropy"?"entropy (bit)":e==="width"?"width of the 90 % interval":n==="bi\
nary"?"P(wall)":e==="draw"?s:o}function ph(t){let{decisions:e}=t.session,n=v("span",{className:"ramp"});n.style.background=ur(Gn);let[o,s]=[v("span"),v("span")],
r=v("li",{className:"views"},"one more scan tells",v("span",{className:"scale"},o,n,s));return t.visible(r,()=>e.looking&&!!e.views?.nats.length),t.each(()=>{let i=e.
views?.nats;i?.length&&(C(o,"textContent",Me(Math.min(...i),1)),C(s,"textContent",`${Me(Math.max(...i),1)} nats`))}),r}var dh=[.05,.1,.2,.4,.8],hh=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function Kl(t){let{session:e}=t,n=v("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,u=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...dh,r.resolution])].sort((d,f)=>d-f);if(o!==h.join()){o=h.join();let d=f=>v("option",{value:String(f),textContent:hh(f),
disabled:u/f>Se.side_of_log-1});n.replaceChildren(...h.map(d))}C(n,"value",String(r.resolution))});let s=t.row("Cell size",n);return t.visible(s,()=>e.document?.
source.kind==="log"),s}function Yl(t){let{session:e}=t,n=v("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),o=v("output"),s=()=>e.document?.source.
scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=s()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});let i=t.
section("Log",v("div",{className:"player bare"},n,o));return t.visible(i,()=>e.document?.source.kind==="log"&&s()>1),t.each(()=>{let a=s(),l=e.document?.scans_used??
a;C(n,"max",String(Math.max(1,a))),(!fn(n)||Number(n.value)!==l)&&C(n,"value",String(l));let u=l===a?`all ${a} scans`:`after ${l} of ${a}`;n.style.setProperty("\
--fill",`${100*(l-1)/Math.max(1,a-1)}%`),pt(n,"aria-valuetext",u),C(o,"textContent",u)}),i}var fh=20,mh={importance:"particles",propagate:"rounds"},xs=({working:t,shown:e})=>t&&e?.method==="pilot";function Jl(t,...e){let{session:n}=t,o=v("progress",{max:1,
value:0,"aria-label":"Progress"}),s=v("div",{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.
source.kind==="log"),l=xs(n),u=i?i.done/i.of:r&&!a&&r.total>0&&(l||!r.approximate)?r.sweeps/r.total:0;C(o,"value",u);let h=n.remaining_s(),d=mh[r?.method??""]??
"sweeps",f=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${d}`:"",b=h!==null?h<1?"less than 1 s left":`${Math.ceil(h)} s left`:n.running?"running":"",y=n.
sampling||n.running||!r||r.sweeps>=r.total?"":"stopped";i?C(s,"textContent",`${i.text}: ${i.done} of ${i.of} ${i.of>fh?"scans":"rounds"}`):a?C(s,"textContent","\
Computing"):r&&l?C(s,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):C(s,"textContent",vn([f,b,f&&y].filter(Boolean).join(", "))||gh(n))}),
t.section("Posterior",yh(t),o,s,wh(t),bh(t),...e)}function gh({shown:t,working:e}){return t?.method==="counts"?"Run infers where the robot was":t?.method==="pil\
ot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function yh(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"\
primary",text:"Run",title:"Run (R)",when:()=>e.connection.connected}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escap\
e)",when:()=>e.running||e.sampling||xs(e)}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chain"),r=v("div",
{className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function wh(t){let{session:e}=t,n=v("dl"),o=(s,r,i,a=!1)=>{let l=v(
"dd",{textContent:"–"});n.append(v("div",{title:r},v("dt",{textContent:s}),l)),t.each(()=>{C(l,"textContent",e.shown?i(e.shown):"–"),a&&C(l,"className",e.shown?.
verdict?.level??"")})};return o("ESS","Effective sample size of the log joint",s=>Me(s.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",
s=>Me(s.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",s=>Me(s.log_joint,Math.abs(s.log_joint??0)<1e5?1:0)),o("reply","From the han\
d's last move to its picture",()=>Me(e.latency.eventToPaint_ms.at(-1),0," ms")),n}function bh(t){let{session:e}=t,n=v("div",{className:"verdict"});return t.each(
()=>{let o=e.shown?.verdict;if(C(n,"hidden",!o),!o)return;let s={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];C(n,"textContent",`${s}:\
 ${o.why}`),C(n,"className",`verdict ${o.level}`)}),n}var xh="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",Zl=200,
vh="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",Ql="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",kh="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function tc(t){let{session:e}=t,n=v("span",{className:"chip"}),o=t.button(null,"Not converged",()=>Xl(
e)?.apply(),{text:"Not converged",className:"chip doubt"}),s=v("div",{className:"chips"},n,o);return t.each(()=>{let r=Xl(e);C(o,"hidden",!r),r&&(C(o.firstElementChild,
"textContent",`not converged: ${r.text}`),C(o,"title",`${e.shown?.verdict?.why}. Click to ${r.text}.`),pt(o,"aria-label",`Not converged: ${r.text}`));let i=e.shown;
if(!i||!e.document)return C(s,"hidden",!0);let a=e.draws.count?`draw ${e.draw+1} of ${e.draws.count}`:"draw",l=i.layer==="draw"?a+(e.flicker.under?" over the me\
an":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="entropy"?"entropy":"mean";if(i.method==="counts"){C(s,"hidden",!1);let d=e.halfway?"along\
 poses found so far":"along raw odometry";return C(n,"textContent",`hits and passes · ${e.stage?e.stage.text.toLowerCase():d}`),C(n,"className","chip approxima\
te")}let u={importance:"importance sampling",propagate:"belief propagation"}[i.method],h=i.approximate?`approximate, ${Sh(i,e.working)}`:u??`${i.sweeps} sweeps`;
C(s,"hidden",!1),C(n,"textContent",`${l} · ${h}`),C(n,"className",i.approximate?"chip approximate":"chip")}),s}function Sh({method:t,sweeps:e,total:n,averaged:o},s){
return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${o===1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} \
of ${n}`}function Xl(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n||t.recorded||n.source.kind==="run")return null;let o=i=>()=>t.act({type:"set",
patch:i}),s=e.sweeps<Zl;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!s)return{text:"try blocks",apply:o({method:"block"})};if(e.method==="importance")return{
text:"try Gibbs",apply:o({method:"auto"})};if(e.sweeps<e.total)return null;let r=Math.min(Se.sweeps[1],Math.max(Zl,4*n.sweeps));return r>n.sweeps?{text:`try ${r}\
 sweeps`,apply:o({sweeps:r})}:null}function nc(t){let{session:e}=t,n=v("span"),o=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),
s=v("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.
retryIn_ms??0)/1e3));C(s,"hidden",!r&&e.worker!=="restarted"),C(s,"className",r?"banner":"banner mild"),C(o,"hidden",!r);let a=`Connection lost. Trying again in\
 ${i} s; the map is kept here.`,l=e.connection.refused?xh:a;C(n,"textContent",r?l:"The worker stopped and is being started again. The map is kept.")}),s}function oc(t){
let{session:e,hand:n}=t,o=v("div",{className:"readout",id:`${t.prefix}-readout`}),s=v("span",{role:"status","aria-live":"polite"}),r=v("span",{className:"hidden",
"aria-live":"polite"});return n.announce=i=>C(r,"textContent",i),n.describe=i=>ec(e,i),t.each(()=>{let{kind:i}=e.quantity;C(o,"title",i==="binary"?vh:i==="surfa\
ce"?`${Ql}. ${kh}`:Ql);let a=n.cursor??n.hover,u=matchMedia("(pointer: coarse)").matches?"Touch a cell":e.editable?"Point at a cell, or press ? for the keys":"P\
oint at a cell";C(o,"textContent",a?ec(e,a):u);let h=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad",d=e.status.text==="Ready"&&xs(e);C(s,"textContent",
h?"Ready, but the chains have not converged":d?"Fitting the sensor":e.status.text),C(s,"className",h?"warning":d?"busy":e.status.level)}),{element:v("footer",{},
s,o,r),readout:o}}function ec(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+
1),{x:l,y:u}=Un(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${u.toFixed(a)} m`];if(o&&o.p.length===r[0]*r[1]){let d=o.p[i]/255,{kind:f,mean:b,value:y,interval:M}=t.
quantity;o.layer==="width"?h.push(`90 % interval ${d.toFixed(2)} wide`):f!=="binary"&&o.layer==="draw"?h.push(`${y} ${d.toFixed(2)} in this draw`):f!=="binary"?
h.push(`${b} ${d.toFixed(2)}`,...M?[]:[`entropy ${yo(d).toFixed(2)} bit`]):o.layer==="draw"?h.push(d>.5?"wall in this draw":"free in this draw"):h.push(`P(wall)\
 ${d.toFixed(2)}`,`entropy ${yo(d).toFixed(2)} bit`);let S=t.cell?.x===e.x&&t.cell.y===e.y?t.cell:null,P=S?S.beams:null;if(o.observed[i]?P!==null&&h.push(P===1?
"1 beam":`${P} beams`):h.push("unobserved"),o.observed[i]&&S?.nats_for!==void 0&&S.nats_against!==void 0&&P){let k={binary:"a wall",surface:"its surface"}[t.quantity.
kind]??"what is there";h.push(`for ${k} ${S.beams_for}, ${S.nats_for.toFixed(1)} nats`,`against ${S.beams_against}, ${S.nats_against.toFixed(1)} nats`)}}return h.
join(" · ")}var Mh={logged:"as logged",odometry:"from raw odometry"},Th=180/Math.PI;function sc(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
Mh,()=>e.document?.poses??"logged",d=>t.set({poses:d}));o.classList.add("wide"),t.visible(o,n);let[s,r]=Se.pose_sigma,[i,a]=Se.heading_sigma_deg,l=[t.slider("po\
se_sigma",()=>"Position ±",{low:s,high:r,step:.05,unit:" m"}),t.slider("heading_sigma",()=>"Yaw ±",{low:i,high:a,step:.5,unit:"°",scale:Th})];for(let d of l)
t.visible(d,()=>e.editable);let u=v("p",{className:"caption"});t.each(()=>{let{pose_sigma:d=0,heading_sigma:f=0,method:b="auto"}=e.document??{},y=n()&&e.document?.
poses==="odometry"&&e.shown?.method==="counts"&&!e.running,M=e.editable&&(d>0||f>0)&&!/auto|gibbs|block/.test(b);C(u,"hidden",!M&&!y),C(u,"textContent",y?"Run i\
nfers where the robot was.":"This method takes poses as known; Gibbs does not.")});let h=t.section("Where the robot was",o,...l,u);return t.visible(h,()=>e.editable||
n()&&!e.recorded),h}var vs=t=>Math.abs(t)<.995?`${Me(100*Math.abs(t),1)} cm`:`${Me(Math.abs(t),2)} m`,Ph="Point at a reading to compare it with what the posterior predicts of it.",
Eh=": preparing the comparison. The first one after an installation takes some seconds.";function rc(t){let{session:e}=t,n=v("p",{className:"words reading",role:"\
status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i,
slow:a}=e.reading,l=s?`Beam ${s.beam+1} of scan ${s.scan+1}${a?Eh:"."}`:Ph;C(n,"textContent",i||(r?_h(r):l))}),o}function _h({scan:t,beam:e,reading:n,range:o,low:s,
median:r,high:i,residual:a,no_return:l,wall:u}){let h=`Beam ${e+1} of scan ${t+1}`,d=(P,k)=>P===null?k:`${Me(P,2)} m`,f=`median ${d(r,"no return")}, 80 % betwee\
n ${d(s,"too close")} and ${d(i,"no return")}`;if(n==="none")return`${h} came back from nothing, which was predicted with probability ${Me(l??0,3)} (${f}).`;if(n!==
"hit"||o===null)return`${h} read nothing that says how far (${f}).`;let b=a===null?"":`, ${vs(a)} ${a<0?"shorter":"longer"} than the predicted median`,y=`${h} r\
ead ${Me(o,2)} m${b} (${f}).`;if(!u)return y;let M=`${vs(u.across_m)} ${u.across_m<0?"behind":"in front of"} the wall, which is ${vs(u.thickness_m)} thick`,S=`${vs(
u.along_m)} to the ${u.along_m<0?"right":"left"} along it from the middle of its surface`;return`${y} It ended ${M} (one standard deviation), and ${S}; the beam\
 met it at ${Me(u.incidence_rad*180/Math.PI,0)}° from its normal.`}var Ah={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Ch={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},Lh={noisy:"with noise",exact:"exact"},Dh={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},Nh={raster:"raster",radial:"radial",random:"random"},ks=2*Math.PI,Rh=t=>Math.round(t*1800/Math.PI)/10,Fh={importance:"Particles",propagate:"Round\
s"};function ic(t){let{session:e,hand:n,editor:o}=t,s=v("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let d=e.document?.sensors??[],f=d.map(b=>b.id).join();f!==r&&s.replaceChildren(...d.map(({id:b})=>v("option",{value:String(
b),textContent:`Sensor ${b}`}))),r=f,C(s,"value",String(n.sensor?.id??""))});let i=(d,f)=>t.numberInput(d,()=>Number((n.sensor?.[f]??0).toFixed(2)),b=>n.sensor&&
o.moveSensor(n.sensor,{[f]:b}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),d=>n.sensor&&o.moveSensor(n.sensor,{yaw:d%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),u=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.document?.fov??ks)<ks);let h=v("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),
a);return t.section("Sensors",v("div",{className:"buttons"},s,l,u),h)}function ac(t){let{session:e}=t,[n,o]=Se.max_range,[s,r]=Se.fov_deg,i=t.numberInput("Longe\
st range (m)",()=>e.document?.max_range??0,d=>t.set({max_range:d}),{min:n,max:o,step:"any"}),a=[t.slider("noise",()=>"Noise (m)",{low:Se.noise[0],high:Se.noise[1],
step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{low:Se.angles[0],high:Se.angles[1],step:1,log:!0}),i,t.numberInput("Field of view (°)",()=>Rh(e.document?.
fov??ks),d=>t.set({fov:d>=r?ks:d*Math.PI/180}),{min:s,max:r,step:5}),t.select("Readings",Lh,()=>e.document?.readings??"noisy",d=>t.set({readings:d}))];for(let d of a)
t.visible(d,()=>e.editable);let l=t.slider("prior",()=>"Prior P(wall)",{low:Se.prior[0],high:Se.prior[1],step:.01}),u=()=>(e.document?.cells??"binary")==="binar\
y";t.visible(l,u);let h=t.select("Cells",Ch,()=>e.document?.cells??"binary",d=>t.set({cells:d}));return t.visible(h,()=>e.document?.source.kind==="log"),t.section(
"Model",h,Kl(t),l,...a)}function lc(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>(e.document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.
test(n()),[r,i]=Se.seed,a=[t.select("Method",Ah,n,l=>t.set({method:l})),t.select("Order",Nh,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||
n()==="auto"),t.select("Start",Dh,()=>e.document?.start??"auto",l=>t.set({start:l}),s)];for(let l of a)t.visible(l,o);return t.section("Inference",...a,t.slider(
"sweeps",()=>Fh[n()]??"Sweeps",{low:Se.sweeps[0],high:Se.sweeps[1],step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{
min:r,max:i,step:1}))}function cc(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),
o=t.button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",v("d\
iv",{className:"buttons"},n,o))}var $h=0,Ss=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${$h++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}visible(e,n){this.each(()=>C(e,"hidden",!n()))}button(e,n,o,{
className:s="",text:r="",when:i,title:a}={}){let l=v("button",{type:"button",className:s,title:a??n,onclick:o},e&&tn(e));return r&&l.append(v("span",{textContent:r})),
r!==n&&l.setAttribute("aria-label",n),i&&this.each(()=>C(l,"disabled",!i())),l}segmented(e,n,o,s,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=v("div",{className:"\
segmented",role:"radiogroup","aria-label":e});for(let[l,u,h]of n){let d=v("input",{type:"radio",name:i,value:l,onchange:()=>s(l)});a.append(v("label",{title:u},
d,h?tn(h):null,v("span",{textContent:u}))),this.each(()=>{C(d,"checked",o()===l),r&&C(d,"disabled",!r(l))})}return a}section(e,...n){let o=`${this.prefix}-${e.replace(
/\W/g,"")}`;return v("section",{"aria-labelledby":o},v("h2",{id:o,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,v("div",{className:"\
row"},v("label",{for:n.id,textContent:e}),n)}slider(e,n,{low:o,high:s,step:r,log:i=!1,unit:a="",scale:l=1}){let u=`${this.prefix}-${e}`,h=S=>i?1e3*Math.log(S/o)/
Math.log(s/o):S,d=S=>{if(!i)return S;let P=o*(s/o)**(S/1e3),k=P<100?1:10**(Math.floor(Math.log10(P))-1);return ie(Math.round(P/k)*k,o,s)},f=()=>l===1?this.session.
document?.[e]??o:Number(((this.session.document?.[e]??o/l)*l).toFixed(3)),b=v("label",{for:u}),y=v("input",{type:"range",id:u,...i?{min:0,max:1e3,step:1}:{min:o,
max:s,step:r}}),M=v("input",{type:"number",min:String(o),max:String(s),step:String(r)});return y.addEventListener("input",()=>this.set({[e]:d(Number(y.value))/l})),
y.addEventListener("change",()=>this.endDrag()),M.addEventListener("change",()=>{this.typed(M,n(),[o,s],f,S=>this.set({[e]:i?Math.round(S):S/l})),this.endDrag()}),
this.each(()=>{let S=f();C(b,"textContent",n()),pt(M,"aria-label",`${n()}, number`),d(Number(y.value))!==S&&(y.value=String(h(S))),pt(y,"aria-valuetext",`${S}${a}`);
let P=100*(h(S)-Number(y.min))/(Number(y.max)-Number(y.min));y.style.setProperty("--fill",`${ie(P,0,100)}%`),fn(M)||C(M,"value",String(S))}),v("div",{className:"\
row slider"},b,y,M)}select(e,n,o,s,r){let i=v("select",{onchange:()=>s(i.value)});for(let[a,l]of Object.entries(n))i.append(v("option",{value:a,textContent:l}));
return this.each(()=>{C(i,"value",o()),r&&C(i,"disabled",!r())}),this.row(e,i)}typed(e,n,[o,s],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(
ie(a,o,s)),e.value=String(r()),a<o?this.session.say(`${n} is at least ${o}`,"warning"):a>s&&this.session.say(`${n} is at most ${s}`,"warning")}numberInput(e,n,o,s={}){
let r=v("input",{type:"number",...s}),{min:i=-1/0,max:a=1/0}=s;return r.addEventListener("change",()=>this.typed(r,e,[i,a],n,o)),this.each(()=>{fn(r)||C(r,"valu\
e",String(n()))}),this.row(e,r)}checkbox(e,n,o,s=""){let r=v("input",{type:"checkbox",onchange:()=>o(r.checked)});return this.each(()=>C(r,"checked",n())),v("la\
bel",{className:"check",title:s},r,v("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,s=v("button",{type:"button",className:"\
plain","aria-label":"Close",onclick:()=>i.close()},tn("close")),r=v("div",{className:"title"},v("h2",{id:o,textContent:e}),s),i=v("dialog",{"aria-labelledby":o},
r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),i}};var Oh=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Ih={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},Ms=class{constructor(e){
this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.before=
null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,
draw:e})}play(e){let{draw:n,draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,e&&s.wantsMean?this.session.act({type:"view",layer:"mean",chain:this.
session.view.chain}):e&&this.showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?0:n),this.session.changed()}over(e){let{flicker:n,view:o}=this.session;
n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.chain})):o.layer!=="draw"&&this.showLayer("draw"):(this.afterMean=!1,
this.before&&this.before!==o.layer&&this.showLayer(this.before)),this.before=e?o.layer:null,this.session.changed()}playFromStart(){this.showDraw(0),this.playing=
!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)return this.afterMean=
!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:o,draws:s}=this.session;o+1>=s.count&&n.on?
this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function uc(t,e,n,o){let{session:s}=t,r=t.segmented("Show",Oh,()=>s.view.
layer,b=>e.showLayer(b),b=>b!=="draw"||s.hasDraws),[,,i,a]=Array.from(r.children);C(a,"title","Width of each cell's 90 % interval"),t.visible(i,()=>!s.quantity.
interval),t.visible(a,()=>s.quantity.interval);let l=(b,y)=>t.checkbox(b,()=>n[y],M=>{n[y]=M,s.changed()}),u=l("True walls","truth");t.visible(u,()=>!s.document||
s.document.source.kind==="simulation");let[h,d]=[l("Surfaces","strokes"),l("Trajectory","trajectory")];t.visible(h,()=>!!s.overlay?.strokes.length),t.each(()=>C(
h.lastElementChild,"textContent",bo(o())?"Surfaces":"Surfaces (zoom in)")),t.visible(d,()=>!!s.overlay?.trajectory.length);let f=v("div",{className:"checks",role:"\
group","aria-label":"Marks"},u,l("Rays","rays"),l("Readings","readings"),h,d);return t.section("View",r,Uh(t,e),f)}function Uh(t,e){let{session:n}=t,o=v("input",
{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the\
 draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1}),r=v("output"),i=v("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,
Number(i.value))),t.each(()=>{let{chains:d,count:f}=n.draws;C(o,"max",String(Math.max(0,f-1))),C(o,"disabled",f===0),C(o,"value",String(n.draw));let b=f?`${n.draw+
1} of ${f}`:"none kept";pt(o,"aria-valuetext",b),o.style.setProperty("--fill",`${f>1?100*n.draw/(f-1):0}%`),C(r,"textContent",b),i.length!==Math.max(1,d)&&i.replaceChildren(
...Array.from({length:Math.max(1,d)},(M,S)=>v("option",{value:String(S),textContent:`chain ${S+1}`}))),C(i,"value",String(n.view.chain)),C(i,"disabled",d<2),f<2&&
e.playing&&e.play(!1);let y=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";s.getAttribute("aria-label")!==y&&(s.setAttribute("aria-lab\
el",y),s.replaceChildren(tn(e.playing?"pause":"play")))});let a=v("select",{"aria-label":"Speed"});for(let[d,f]of Object.entries(Ih))a.append(v("option",{value:d,
textContent:f}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(null,"From the first sweep",()=>e.
playFromStart(),{text:"From the first",when:()=>n.draws.count>1});t.each(()=>C(a,"disabled",n.draws.count<2||n.flicker.still));let u=t.checkbox("Draws over the \
mean",()=>n.flicker.on,d=>e.over(d),"Each draw in its own colour over the mean, as one of the maps that the scans leave possible");t.visible(u,()=>n.draws.count>
1);let h=v("div",{className:"wide"},u);return v("div",{className:"player"},s,o,r,v("div",{className:"buttons wide"},i,a,l),h)}function pc(t){let{session:e}=t,n=v(
"input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=v("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.
section("Scan",v("div",{className:"player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;C(s,"hidden",
r<2),C(n,"max",String(Math.max(0,r-1))),fn(n)||C(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),C(o,
"textContent",`${Number(n.value)+1} / ${r}`)}),s}var hc=2,dc=6,Wh=.5,Gh=.005;function fc(t){let{session:e,hand:n}=t,o=v("p",{className:"whereabouts",role:"status"}),s=v("p",{className:"caption"}),r=t.section("\
Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),C(o,"textContent",zh(t)),C(s,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function zh({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>Wh?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>Gh?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${o}${Hh(e.modes)}${Vh(e,t.editable)}${s}`}function Hh(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>hc,o=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${jr(e.mean[2],0)}`,s=`known to ${qr(e.sigma_m)} and ${jr(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${qr(e.sigma_m)} apart.`:`One place: ${o}, ${s}.`;let r=t.slice(0,dc).map(({probability:a})=>dr(a)),i=t.length>dc?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${o}, ${s}.`}function Vh({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>hc)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the l\
ikeliest":`the ${Bh(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${qr(o[s])} and ${jr(r,1)} from ${i}.`}var Bh=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,jr=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,qr=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function mc(t,e,n){let{shown:o,status:s}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:o&&{generation:o.generation,layer:t.layer,approximate:o.
approximate,sweeps:o.sweeps,method:o.method,quantity:t.quantity,rhat:o.rhat,verdict:o.verdict,trace:o.trace,traced:o.traced,weights:o.weights,ess:o.ess,chain:o.
chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{
text:s.text,level:s.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:jh(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.
draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.
transform}}}function jh({ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.near&&{...o.near}}}}var gc="bayesmap-token",Kr="bayesmap-kept";function qh(t){try{return localStorage.getItem(t)}catch{return null}}function Yr(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function Jr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Yr(Kr,JSON.stringify(t))}function yc(){
Yr(Kr,null)}function wc(){let t=qh(Kr);try{return t&&JSON.parse(t)}catch{return null}}function bc(t){t&&Yr(gc,t)}function xc(t){let e=n=>{n.key===gc&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var Zr=new Set(["walls","sensor","set","view","live"]),vc=({type:t,op:e})=>t==="sensor"?e!=="move":!Zr.has(t),kc="Not while the connection is lost: this needs t\
he server";function Sc(t,e){let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*s+i]=e.wall?1:0;else if(e.type==="set"){let{
resolution:r,...i}=e.patch;Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??
t.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let r=n.sensors.find(i=>i.id===e.id);r&&Object.assign(r,{x:e.x,y:e.y,yaw:e.yaw})}}var Kh=t=>vn(`${t.replace(/^(plan|path|explore): /,"")}.`),Ts=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.
session.changed())}forget(){this.start=this.goal=this.path=this.views=null,this.askedPath=this.askedViews="",this.version++}ask(){let{session:e,start:n,goal:o,radius:s,
risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&
!i.approximate&&l!==this.askedPath&&(this.askedPath=l,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.
method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let o=e.type==="undecided"?Kh(e.text):"";e.of==="views"||e.type===
"views"?this.viewTrouble=o:this.trouble=o,e.type==="path"&&(this.path=e),e.type==="views"&&this.looking&&(this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}),
e.type==="undecided"&&e.of==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<
n.nats.length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,s]=[r,i])}return o}};var Yh="(prefers-reduced-motion: reduce)",Ps=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(Yh).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var Jh=2e3,Zh=3e3,Qh=2,Es=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&hn(e,n.document.
grid);(!o||!Jt(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
e.recorded||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>Jh&&(this.waiting=0),this.waiting>=Qh)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Zh;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:u}=n,h=e.near&&{...e.near,pose:a,ranges:l,hit:u},{x:d,y:f,yaw:b,generation:y,draws:M,coarse:S,milliseconds:P}=e;this.fan={x:d,y:f,yaw:b,generation:y,draws:M,
coarse:S,milliseconds:P,angles:o,low:s,median:r,high:i,near:h},this.answers++}else this.fan=null;this.version++,this.ask()}};var _s=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var As=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Cs=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.
kind!=="simulation"&&!o.recorded,r=e&&s&&o.scan?Xh(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),o.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){let n=e;e.type==="undecided"?this.trouble=e.text:n.beam===this.picked?.
beam&&n.scan===this.picked.scan&&(this.found=n),this.version++}};function Xh({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)return null;let l={x:e[0],
y:e[1]},[u,h]=[-1,1/0];for(let d=0;d<n.length;d++){let[f,b]=[Math.cos(e[2]+n[d]),Math.sin(e[2]+n[d])],[y,M]=[r.x-l.x,r.y-l.y],S=y*f+M*b,P=s[d]?o[d]:a,k=s[d]?Math.
hypot(y-P*f,M-P*b):1/0,_=S>0&&S<P?Math.abs(y*b-M*f):1/0,E=Math.min(k,i/2+2*_);E<h&&([u,h]=[d,E])}return h<i?{scan:t,beam:u,from:l,angle:e[2]+n[u]}:null}var Ls=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble??"";let{pose:o,weight:s}=n,{modes:r=[]}=e,i=r.filter(({probability:a},l)=>l===0||a>=.005);this.found=this.trouble?null:
{...e,modes:i,cloud:o,weight:s},this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||e.recorded||e.worker!=="ready"||e.editable&&n.generation!==e.
generation)return;let s=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.
asked||this.waitingSince&&i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:
{type:"where"}))}};var Mc=new Set(["inspect","path","views","where","ghost","beam"]),Ds=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;cell=null;lastStage=null;worker="starting";recorded=!1;generation=-1;acted=0;decisions=new Ts(
this);where=new Ls(this);ghost=new Es(this);reading=new Cs(this);flicker=new Ps(this);status=new ys;progress=new As;latency=new _s;counts={paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={
text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){
return!this.recorded&&this.document?.source.kind==="simulation"}get running(){return this.connection.connected&&!!this.state?.running}get working(){return this.
connection.connected&&!!this.state?.working}get layer(){let e=this.shown?.layer;return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entropy":"mean"}get stage(){
return this.running&&this.shown?.method==="counts"?this.lastStage:null}get halfway(){return this.lastStage?.generation===this.shown?.generation}get draws(){return this.
state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(0,this.draws.
count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.
test(this.document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.
connected&&this.everConnected&&!Mc.has(e.type)&&vc(e))return this.say(kc,"warning");let o={...e,seq:++this.seq};Mc.has(e.type)||(this.acted=this.seq),Zr.has(e.type)&&
(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&Jr(this.portableDocument()),
this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.
wallsVersion&&(this.packed={version:this.wallsVersion,text:Io(Li(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.
effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.
flicker.take(this.shown),!0)}painted(){this.counts.paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.
send({type:"painted",generation:e}),this.reported=e,this.decisions.ask(),this.ghost.ask()}get quantity(){return this.shown?.quantity??{kind:"binary",mean:"P(wal\
l)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){if(this.connection=e,e.connected){
let n=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(n),this.view.layer!=="mean"&&this.document&&this.act(
{type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.text,this.notice.level),this.everConnected=!0}else this.
everConnected&&(this.say("Connection lost","error"),Jr(this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"welcome":this.generation=this.reported=
-1,this.recorded=!!e.recorded,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":if(e.generation>=this.generation){let{
pose:o,angles:s,ranges:r,exact:i,hit:a}=n;this.scan?.index!==e.index&&this.reading.forget(),this.scan={ids:e.ids??[],index:e.index??null,pose:o,angles:s,ranges:r,
exact:i,hit:a}}break;case"overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(
e,n);break;case"cell":this.cell=e;break;case"path":case"views":case"ghost":case"beam":case"undecided":this.receiveAnswer(e,n);break;case"status":this.status.say(
e.text,e.level??"info",this.acted);break;case"error":this.receiveError(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"download":
this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveAnswer(e,n){let o=e.type==="undecided"?e.
of:e.type;o==="ghost"?this.ghost.receive(e,n):o==="beam"?this.reading.receive(e):this.decisions.receive(e,n)}receiveError(e){let n=e.refused?.seq??null,o=n!==null&&
n===this.broughtAt;o&&(this.broughtAt=null,this.act({type:"hello"}));let s=[e.text,e.remedy].filter(Boolean).join("; ");this.status.say(o?`The map that was brou\
ght along cannot be shown: ${s}`:s,"error",this.acted),this.pending=this.pending.filter(r=>r.seq!==n),n!==null&&this.latency.refused(n),this.rebuild()}receiveState(e){
this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.overlay=null,yc()),this.generation=Math.max(this.generation,e.generation),
this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.
counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,a=n.observed,l=this.next??this.shown,h=l&&l.p.length===o.length&&l.bits.
every((d,f)=>d===a[f])?{observed:l.observed,bits:l.bits}:{observed:go(a,o.length),bits:a};this.next={...e,p:o,trace:s,traced:r,weights:i,...h},this.progress.hear(
this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==s.text||s.walls.length!==n*o)&&(this.
confirmedWalls={text:e.walls,walls:go(zt(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==s||this.wallsAhead)&&(this.
walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),this.state.view&&!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.
state.view;this.view={layer:r??"mean",chain:i??0,draw:a??null}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Sc(this,e),e.type===
"walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Tc='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Pc=`:host { display: block; height: 100dvh; container-type: size; }
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
.bar button { flex: none; }
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
.stage canvas[data-tool=sensor], .stage canvas[data-tool=where] { cursor: default; }
canvas:focus-visible { outline-offset: -3px; }
canvas[data-pointed]:focus-visible { outline: none; }
.chips { position: absolute; left: 0; top: 0; display: flex; align-items: start; gap: 6px; pointer-events: none; }
.chip { white-space: nowrap; padding: 2px 8px; border-radius: 5px; background: var(--card); color: var(--text); border: 1px solid var(--line); font-size: 12px; \
pointer-events: none; }
button.chip.doubt { height: auto; min-height: 26px; background: var(--bad); color: var(--card); border-color: transparent; font-weight: 600; pointer-events: aut\
o; }
button.chip.doubt:hover:not(:disabled) { background: var(--bad); filter: brightness(1.1); }
.chip.approximate { background: var(--warn); color: var(--warn-text); border-color: transparent; }
.banner { position: absolute; z-index: 4; left: 12px; right: 12px; top: 10px; display: flex; flex-wrap: wrap; align-items: center; gap: 6px 12px; padding: 8px 1\
2px; border-radius: 8px; background: var(--bad); color: var(--card); box-shadow: 0 4px 16px #0004; }
.banner.mild { background: var(--warn); color: var(--warn-text); }
.banner button { border-color: currentColor; }
.banner button:hover { background: #0002 !important; }
.legend { grid-area: legend; display: grid; padding: 2px 12px 9px 46px; font-size: 12.5px; color: var(--soft); }
.legend ul { grid-area: 1 / 1; display: flex; flex-wrap: wrap; align-content: start; gap: 2px 16px; list-style: none; padding: 0; }
.legend .room { visibility: hidden; }
.legend li, .legend .scale { display: inline-flex; align-items: center; gap: 6px; white-space: nowrap; }
.legend .name { min-width: 68px; }
.legend .room .either { display: inline-grid; }
.legend .room .either > * { grid-area: 1 / 1; flex-wrap: nowrap; }
.legend .ramp { width: 96px; height: 11px; border: 1px solid var(--line); border-radius: 2px; }
.legend i { width: 16px; height: 12px; flex: none; }
.legend .truth { border: 2px solid var(--truth); }
.legend .draw { background: var(--draw); }
.legend .ghost { height: 6px; background: var(--ghost); }
.legend .ray { height: 0; border-top: 2px solid var(--ray); opacity: .6; }
.legend .miss { height: 0; border-top: 2px solid var(--miss); }
.legend .trajectory { height: 0; border-top: 2px solid var(--sensor); opacity: .7; }
.legend .stroke { height: 0; border-top: 3px solid var(--ray); }
.legend .dot { width: 8px; height: 8px; border-radius: 50%; background: var(--ray); }
.legend .belief { width: 6px; height: 6px; border-radius: 50%; background: var(--belief); }
.legend .place { width: 14px; height: 14px; border-radius: 50%; border: 2px solid var(--belief); }
.legend .path { --path: var(--sensor); height: 8px; background: linear-gradient(var(--path) 0 0) center / 100% 2px no-repeat, color-mix(in srgb, var(--path) 30%\
, transparent); }
.legend .path.risky { --path: var(--truth); }
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
.row.wide { grid-template-columns: 72px 1fr; }
.row.slider { grid-template-columns: 92px 1fr 66px; }
.row.slider input[type=number] { appearance: textfield; text-align: right; }
.row.slider ::-webkit-inner-spin-button { display: none; }
.double { display: grid; grid-template-columns: 1fr 1fr; gap: 8px; }
.double .row { grid-template-columns: 1fr; gap: 2px; }
.double label { font-size: 12.5px; color: var(--soft); }
.said, .words, .whereabouts { margin: 6px 0 0; font-size: 13px; line-height: 1.45; }
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
footer .busy::before { background: var(--accent); }
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
  .legend { padding: 3px 12px 5px; font-size: 12px; }
  .legend ul { gap: 0 12px; }
  .legend .room { display: none; }
  .legend .ramp { width: 60px; }
  .legend li:first-child { flex-wrap: wrap; white-space: normal; gap: 0 6px; }
  .legend .name { min-width: 0; }
  .chips { flex-wrap: wrap; max-width: calc(100% - 12px); transform: translate(6px, 4px) !important; }
  aside { border-left: 0; border-top: 1px solid var(--line); }
  footer { flex-direction: column; padding: 4px 12px 5px; gap: 0; }
  footer [role=status] { white-space: normal; }
  footer > * { max-width: 100%; min-height: 1.4em; }
}
@container (max-width: 640px) {
  .bar .segmented span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); }
  .bar .segmented label { padding: 0 12px; }
  .bar .segmented svg { width: 18px; }
}
@container (max-width: 420px) { .bar .segmented label { padding: 0 10px; } }
@container (max-width: 380px) and (max-height: 700px) { .legend li:not(:first-child) { display: none; } }
@container (max-width: 380px) { .bar .segmented label { padding: 0 7px; } .buttons { flex-wrap: wrap; } }
@container (max-height: 520px) and (min-width: 560px) {
  .app { grid-template: "bar stage head" auto "bar stage panel" minmax(0, 1fr) "bar stage legend" auto "bar stage foot" auto / auto minmax(0, 1fr) 292px; }
  header { padding: 2px 4px; gap: 0; justify-content: space-between; border-left: 1px solid var(--line); }
  header h1, header .what, header .space, header .gap { display: none; }
  header button span { display: none; }
  header button, header button:not(:has(span)) { width: 38px; padding: 0; }
  .anchor > button { border-color: transparent; background: none; }
  .menu button { width: auto; padding: 0 10px; }
  .menu button span { display: inline; }
  .bar { flex-direction: column; padding: 6px 0 6px 6px; }
  .bar .segmented { flex-direction: column; }
  .bar .segmented label { min-height: 34px; padding: 0 11px; }
  .bar [aria-label^="Zoom"] { display: none; }
  .bar .segmented span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); }
  .legend { padding: 4px 12px; max-height: 25cqh; overflow-y: auto; font-size: 12px; background: var(--card); border: solid var(--line); border-width: 1px 0 0 1\
px; }
  .legend ul { gap: 0 10px; }
  .legend .room { display: none; }
  .legend .ramp { width: 48px; }
  .legend li:first-child { flex-wrap: wrap; white-space: normal; gap: 0 6px; }
  .legend .name { min-width: 0; }
  footer { flex-direction: column; padding: 3px 12px 4px; gap: 0; border-left: 1px solid var(--line); }
  footer [role=status] { white-space: normal; }
  footer > * { max-width: 100%; }
}
@media (prefers-reduced-motion: no-preference) { button, .segmented label { transition: background-color .12s; } }
@media (forced-colors: active) { .segmented label:has(:checked) { outline: 2px solid Highlight; } }
`;var _c="bayesmap-theme",Ec={auto:"light",light:"dark",dark:"auto"},Ns=class{constructor(e,n){this.app=e;this.dressed=n;let o=nf();o&&o in Ec&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=Jo.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?Jo.dark:Jo.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:u,ghost:h,belief:d}=n;for(let[f,b]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:l,draw:u,ghost:h,belief:d}))this.
app.style.setProperty(`--${f}`,b);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Ec[this.choice];try{localStorage.setItem(_c,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function nf(){try{return localStorage.getItem(_c)}catch{return null}}function Rs(t,e,{embedded:n=!1,adopt:o=null,notice:s=null}={}){let r=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(Tc+Pc),r.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,l=()=>{a||=requestAnimationFrame(me)},u=new Ds(e,l,o,s);e.open();let h=new Wn,d=new Ho(u),f=new zo(u,d),b=new Ms(
u),y=new Ss(u,d,f,ot,K=>b.showLayer(K),n),M=[new Hn,new Bn,new Kn,new qn,new Xo,new jn,new zn,new Yn,new Vn,new Ko],S=M.map(({name:K})=>v("canvas",{className:K})),
P=S[S.length-1];Object.assign(P,{tabIndex:0,role:"application"});let k=new jo(M,S);new qo(P,u,h,d,f,n);let _=new Bo(P,u,h,d,f),E={truth:!0,rays:!0,readings:!0,strokes:!0,
trajectory:!0},q=zl(y),N=ra(y),Y={chip:tc(y),banner:nc(y)},V=v("main",{className:"stage"},...S,Y.chip,Y.banner),R=()=>G.theme,W=()=>h.transform.scale,L=jl(y,R,W),
Z=oc(y);P.setAttribute("aria-describedby",Z.readout.id);let I=Ul(y),j={help:Ol(y),new:Il(y),share:I.dialog},[z,Q,H,je]=[ic(y),ac(y),lc(y),cc(y)],we=[$l(y),fc(y),
Gl(y),Yl(y),Jl(y,Rl(y,R),Fl(y,R)),pc(y),rc(y),uc(y,b,E,W),z,Q,sc(y),H,je],se=v("aside",{"aria-label":"Controls"},...we),le=()=>u.recorded||u.document?.source.kind===
"run";y.visible(z,()=>u.editable),y.visible(Q,()=>!le()),y.visible(H,()=>!le()),y.visible(je,()=>!le()),y.each(()=>{C(N,"inert",!u.document),C(se,"inert",!u.document)});
let ee=v("div",{className:"app"},q.element,N,V,L,se,Z.element,...Object.values(j));r.replaceChildren(ee);let G=new Ns(ee,K=>{q.nameTheme(K),l()}),_e=()=>{let K=u.
editable&&d.tool==="sensor"?d.sensor?.id??null:null;return{session:u,view:h,look:{theme:G.theme,...E,hover:d.hover,cursor:d.cursor,selected:K}}},Ie="";function me(){
a=0;let K=u.take();u.document&&String(u.shape)!==Ie&&(Ie=String(u.shape),h.fit(u.shape),d.cursor=d.hover=null,u.decisions.forget(),u.ghost.refit(),P.setAttribute(
"aria-label",`Map, ${u.shape[0]} by ${u.shape[1]} cells`)),k.paint(_e()),K&&(u.painted(),b.step());let{x:re,y:qe}=h.transform;Y.chip.style.transform=`translate(${Math.
max(re,Je.left)}px, ${Math.max(qe-28,6)}px)`,pt(P,"data-tool",u.editable||_t.has(d.tool)?d.tool:"pan"),y.refresh()}let ae=new ResizeObserver(()=>{let{width:K,height:re}=V.
getBoundingClientRect();!K||!re||(h.resize(K,re,devicePixelRatio||1),h.fitted&&h.fit(u.shape),cancelAnimationFrame(a),me())});ae.observe(V);async function ot(K){
if(K==="in"||K==="out")h.zoom(K==="in"?1.4:1/1.4,h.middle,u.shape);else if(K==="fit")h.fit(u.shape);else if(K==="help")j.help.showModal();else if(K==="new")j.new.
showModal();else if(K==="theme")G.next();else if(K==="add")_.addSensor();else if(K==="share"){let re=u.portableDocument();re&&I.show(location.origin+location.pathname+
await Ri(re))}else if(K==="export png"){let re=await oa(_e());re&&hr("bayesmap.png",re),u.say("Saved bayesmap.png")}else K.startsWith("export ")&&u.act({type:"e\
xport",what:K.slice(7)});l()}u.ondownload=(K,re,qe)=>hr(K,new Blob([qe],{type:re}));let mt=[[n?t:window,"keydown",K=>{K.defaultPrevented||!u.document||Object.values(
j).some(re=>re.open)||Bi(K,u,{tool:re=>{d.choose(re),_.focus()},layer:re=>b.showLayer(re),command:ot})}],[window,"online",()=>e.retry?.()],[window,"hashchange",
async()=>{if(n)return;let{document:K,damaged:re}=await Go();K?u.bring(K):re&&u.say(Wo,"error")}]];for(let[K,re,qe]of mt)K.addEventListener(re,qe);return G.dress(),
{destroy(){ae.disconnect(),cancelAnimationFrame(a),G.destroy();for(let[K,re,qe]of mt)K.removeEventListener(re,qe);e.close(),r.replaceChildren()},snapshot:()=>mc(
u,h,k),cellToClient(K,re){let qe=P.getBoundingClientRect(),Ut=h.fromGrid({x:K+.5,y:re+.5},u.shape[1]);return{x:qe.left+Ut.x,y:qe.top+Ut.y}}}}var Qr={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},Ac=8,io=()=>({onmessage:()=>{},onstatus:()=>{}});function Cc(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers){let l=a.reduce((u,h)=>u*h,1)*Qr[i].BYTES_PER_ELEMENT;
o[r]=new Qr[i](t.slice(s,s+l)),s+=Math.ceil(l/Ac)*Ac}return[n,o]}function Lc(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{let{buffer:i,byteOffset:a,
byteLength:l}=e[r];n[o]=new Qr[s](i.slice(a,a+l))}),n}function Dc(t){let{document:e,scans:n,settings:o={},log_joint:s=[]}=t,r=e.grid.shape[0]*e.grid.shape[1],i=t.draws?.count??0,a=e.source.kind!=="simulation",l=zt(
t.mean),u=zt(t.observed),h=null,d=0,f={layer:"mean",chain:0,draw:null},b=R=>a?[R[d]]:R,y=R=>Float32Array.from(b(R).flat(),W=>W??1/0),M=n.angles.length,S=go(zt(n.
hit),n.pose.length*M),P=()=>a?S.subarray(d*M,(d+1)*M):S,k=Float32Array.from(s.flat()),_=(o.sweeps??i)/Math.max(1,i),E=Float32Array.from(s[0]??[],(R,W)=>(W+1)*_),
q=R=>{let W={chains:t.draws?.chains??0,count:h?i:0},L={generation:1,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1};V.onmessage({type:"state",document:e,
seq:R,...L,draws:W,view:f},{})},N=()=>{let R=Float64Array.from(b(n.pose).flat(),Number),W={type:"scan",generation:1,ids:a?[d]:n.ids,index:a?d:null},L=n.exact?.length?
y(n.exact):new Float32Array(0);V.onmessage(W,{pose:R,angles:Float32Array.from(n.angles),ranges:y(n.ranges),exact:L,hit:P()})},Y=()=>{let R=f.layer==="draw"&&h?of(
h,f.chain*i+(f.draw??i-1),r):null,W=s[f.chain]?.[(f.layer==="draw"?f.draw:null)??i-1]??null,L=R?{...f,draw:f.draw??i-1}:{layer:f.layer==="draw"?"mean":f.layer},
Z=o.sweeps??i,I={quantity:o.quantity,sweeps:Z,total:Z,ess:o.ess,rhat:o.rhat,verdict:o.verdict,log_joint:W},j=o.method??e.method,z={p:R??l,observed:u,trace:k,traced:E};
V.onmessage({type:"field",generation:1,...L,method:j,approximate:!1,...I},z)},V={...io(),open:()=>V.onstatus({connected:!0}),send:R=>{if(R.type==="hello"){if(V.
onmessage({type:"welcome",version:1,recorded:!0},{}),q(R.seq),N(),Y(),!i||!t.draws)return;Uo(zt(t.draws.data)).then(W=>{h=W,q(R.seq)})}else if(R.type==="view")f=
{layer:R.layer,chain:R.chain??f.chain,draw:R.draw??null},q(R.seq),Y();else if(R.type==="scan")d=R.index,q(R.seq),N();else if(R.type==="inspect"){let W=sf(e,n.angles,
b(n.pose),b(n.ranges),R.x,R.y);V.onmessage({type:"cell",x:R.x,y:R.y,beams:W},{})}},close:()=>{}};return V}function of(t,e,n){let o=e*n;return Uint8Array.from({length:n},
(s,r)=>t[o+r>>3]>>7-(o+r&7)&1?255:0)}function sf({grid:t},e,n,o,s,r){let{origin:i,resolution:a}=t,l=[i[0]+s*a,i[1]+r*a],u=0;return n.forEach((h,d)=>{let[f,b,y]=h.
map(Number);e.forEach((M,S)=>{let[P,k]=[Math.cos(M+y),Math.sin(M+y)],_=[(l[0]-f)/P,(l[0]+a-f)/P,(l[1]-b)/k,(l[1]+a-b)/k],E=Math.max(0,Math.min(_[0],_[1]),Math.min(
_[2],_[3])),q=Math.min(o[d][S]??1/0,Math.max(_[0],_[1]),Math.max(_[2],_[3]));E<q&&u++})}),u}var Xr=250,rf=8e3;function Nc(t){let e=null,n=Xr,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),u=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{u=!0,n=Xr,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...Cc(h))},l.onclose=()=>{if(s||e!==l)return;o=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),u||af(t()).then(d=>d&&e===l&&i.onstatus({...h,refused:d})),n=Math.min(rf,2*n)}}let i={...io(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=Xr,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};return i}async function af(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Rc(t){let e=(o,s=[])=>n.onmessage(o,Lc(o,s)),n={...io(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var lf="This is the map that was drawn here when the connection was lost; undo leads back",ei=t=>Object.assign(window,{bayesmap:t}),x0={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=Rs(n,Rc(t),{embedded:!0});return ei(o),()=>o.destroy()}};async function cf(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){ei(Rs(t,Dc(JSON.parse(n.textContent??""))));return}bc(new URLSearchParams(location.search).get("token"));let{document:o,damaged:s}=await Go(),
r=o?null:wc(),i=Nc(()=>new URL(location.href));xc(l=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(l)}${location.hash}`),i.retry?.()}),
ei(Rs(t,i,{adopt:o??r,notice:s?{text:Wo,level:"error"}:r?{text:lf,level:"info"}:null}))}cf();export{x0 as default,Rs as mount,Dc as recordedTransport,Nc as webSocketTransport,Rc as widgetTransport};
