// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function yo(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function $i(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Vt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Oo(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Fi(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Uo=t=>Fi(t,new DecompressionStream("deflate-raw")),Ii=t=>Fi(t,new CompressionStream("deflate-r\
aw"));async function Oi(t){let e=await Ii(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Oo(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function wu(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Uo(Vt(e[1]))))}var Go="The link's map cannot be read: copy the link again, who\
le";async function Wo(){let t=await wu(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var ne=(t,e,n)=>Math.min(n,Math.max(e,t)),Ot=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,Ae=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),ar=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function pn(t,e){let{x:n,y:o}=Ae(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Gn=(t,e)=>ar({x:t.x+.5,y:t.y+.5},e);
function Ui(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Gi(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&s(r-1,i)!==s(r,i);l&&a<0&&(a=i),!l&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&s(i,r-1)!==s(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var bo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Wi(t,e,n){let o=Hi(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Vi(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function zi(t,e){
let n=xu(e,t.grid.shape),o=Hi(t);return Vi(t,(s,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let l of o)a=Math.min(a,Math.hypot(s-l.x,r-l.y));return a>0?a:-1/0})}
var Hi=({sensors:t,grid:e})=>t.map(n=>pn(n,e));function Vi(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let l=e(i,a,i*o+a);
l>r&&([s,r]=[{x:i,y:a},l])}return s&&Gn(s,t.grid)}function xu(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)o[r*n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),
s(r+1,i-1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var Se={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],fov_deg:[5,360],pose_sigma:[0,2],heading_sigma_deg:[0,30],sweeps:[1,
1e5],seed:[0,2147483647],side_of_log:1e3};var zo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Ot(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(u=>pn(u,r.grid)):[],l=new Map;for(let u of e)!Ot(u,i)||this.isWall(u)===n||a.some(p=>p.x===
u.x&&p.y===u.y)||l.set(u.x*i[1]+u.y,[u.x,u.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"sensor",op:"move",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?zi(o,n.walls):"world"in e?e.world:Wi(o,n.walls,e.near);s?o.sensors.length>=Se.sensors?n.say(`There can be ${Se.sensors}\
 sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"sensor",op:"add",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=Math.
max(0,...o.sensors.map(r=>r.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sen\
sor",op:"remove",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=pn(e,n.document.grid),s=this.isWall(o);return!s&&Ot(o,n.shape)?(n.status.
text.startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var At=new Set(["pan","path","look","where","ghost","evidence"]),vu=120,Ho=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.ghost.hold(e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.
changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&Ot(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=
n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.
busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},vu))}};var Je={left:36,right:12,top:34,bottom:26},ku=60,Su=160,Wn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-Je.left-Je.right,y:this.height-Je.
top-Je.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:Je.left+(o.x-
s*e)/2,y:Je.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,o){let{scale:s}=this.transform,{x:r,
y:i}=this.corner,a=ne(s*e,Math.min(this.width,this.height)/Math.max(...o)/3,Su),l=a/s;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.
x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=ku;this.corner.
x=ne(this.corner.x,s-e*o,this.width-s),this.corner.y=ne(this.corner.y,s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var Vo=new Set(["path","look","evidence"]);function Bo(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);if(e.tool==="evidence"&&t.document){let{x:p,y:d}=Ae(
o,t.document.grid);return t.evidence.pin({x:Math.floor(p),y:Math.floor(d)})}let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,l]=r.
pose.subarray(3*s,3*s+3),u=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${u}`)}var qi=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W, O, V","where am I, ghost, evidence of beams","asked"],["arrows",
"move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["Space","at the cu\
rsor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, Delete","add, remo\
ve a sensor","drawn"],["R, Escape","run, cancel","inferred"],["M, N, H","show the mean, a draw, the entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","asked"],
["+, −, 0","zoom in, out, whole map"],["?","this help"]],Mu={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},Bi=Math.PI/12,jo=class{constructor(e,n,o,s,r){
this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;e.addEventListener("keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("b\
lur",()=>{delete e.dataset.pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{session:n,hand:o,editor:s}=this;if(!n.document||
e.ctrlKey||e.metaKey||e.altKey)return;let r=Mu[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key===
"]"){let a=e.key==="["?Bi:-Bi;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+
a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)s.removeSensor();else if(e.
key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.hand.cursor?{near:this.hand.
cursor}:"where there is room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&o.ghost.pose&&o.document){let{resolution:l}=o.document.
grid,{x:u,y:p}=o.ghost.pose;o.ghost.move({x:u+e*l,y:p+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&r.sensor&&o.document&&o.editable){let{resolution:l}=o.
document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.
shape),o.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},u={x:ne(l.x+e,0,i-1),y:ne(l.y+n,0,a-1)};r.setCursor(u);let p=s.fromGrid({x:u.x+.5,
y:u.y+.5},a),d=(w,y,k)=>w-ne(w,y,k),f={x:d(p.x,Je.left+10,s.width-20),y:d(p.y,20,s.height-Je.bottom-10)};(f.x||f.y)&&s.pan(-f.x,-f.y,o.shape)}}space(e){let{session:n,
hand:o,editor:s}=this;if(Vo.has(o.tool)&&n.document){o.cursor?Bo(n,o,s,Gn(o.cursor,n.document.grid)):this.arrow(0,0);return}if(n.editable){if(o.tool==="sensor"||
o.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,r.length)]?.id??null),o.selected!==null&&o.announce(
`Sensor ${o.selected}`)}else if(!At.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.
announce(i?"wall":"free")}}}},lr={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",v:"evidence"},ji={m:"mean",n:"draw",h:"entropy"},Ki={
"+":"in","=":"in","-":"out",0:"fit","?":"help"};function Yi(t,e,n){let o=t.composedPath()[0],s=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.
test(o.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?
"redo":"undo"});return}if(!(s||t.altKey)){if(lr[r]&&(e.editable||At.has(lr[r])&&!e.recorded))n.tool(lr[r]);else if(ji[r])n.layer(r==="h"&&e.quantity.interval?"w\
idth":ji[r]);else if(Ki[t.key])n.command(Ki[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&(e.running||e.working))e.act({type:"\
cancel"});else return;t.preventDefault()}}var Ko=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:u,context:p,layer:d}=l,f=d.shows?.(e)??!0,w=[f,...f?[...a,...d.depends(e)]:[]];w.length===
l.before.length&&w.every((y,k)=>Object.is(y,l.before[k]))||(l.before=w,u.style.visibility=f?"":"hidden",f&&((u.width!==i.width||u.height!==i.height)&&(Object.assign(
u,i),u.style.width=`${i.width/s}px`,u.style.height=`${i.height/s}px`),p.setTransform(1,0,0,1,0,0),p.clearRect(0,0,u.width,u.height),p.setTransform(s,0,0,s,0,0),
p.save(),d.paint(p,e),p.restore(),this.paints[d.name]++))}}};function Ne(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,o*r,s*r),t.clip()}function fn(t,{halo:e},n,o){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}var cr='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Ut(t,e,n,o,s,r,i=!1){t.font=cr,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}function ur({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Qt(t,e,n){let o=n.fromGrid(Ae(t,e),e.shape[1]),s=ne(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function Ji(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=ur(e);t.lineJoin=
"round";for(let a of i){let l=Qt(a,s.grid,n),{point:u,size:p}=l;a.id===o.selected&&Tu(t,l,o);let[d,f]=[Math.cos(a.yaw),-Math.sin(a.yaw)],w=(y,k)=>[u.x+p*(y*d-k*
f),u.y+p*(y*f+k*d)];t.beginPath(),t.moveTo(...w(1.25,0)),t.lineTo(...w(-.9,.8)),t.lineTo(...w(-.45,0)),t.lineTo(...w(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Ut(t,String(a.id),u.x,u.y+p*2+4,r,"center",!0)}}function Tu(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),fn(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function Zi(t,e,n,o,s){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&Qt({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Qi(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var Xi={touch:24,other:11},Pu=5,Eu=90,qo=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(l,u)=>e.
addEventListener(l,u,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return ar(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(Zi(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&Vo.has(o.tool))return this.
begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(i.id),this.begin(i);
if(e.button===1||At.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="sensor"&&o.select(a.id);else if(o.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let l=o.tool==="draw"!==(e.button===2||e.shiftKey),u=this.cellAt(r),p=l&&this.editor.isWall(u);this.begin({kind:"strok\
e",id:o.nextGesture(),wall:l,last:u,held:e,onWall:p}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Eu)}}gripAt(e,n,o){let{hand:s,view:r}=this,
i=this.reach(n),a=f=>Math.hypot(e.x-f.x,e.y-f.y),l=s.tool==="sensor"&&s.sensor?Qt(s.sensor,o.grid,r):null;if(l&&s.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let u=o.sensors.map(f=>({id:f.id,...Qt(f,o.grid,r)}));u.sort((f,w)=>a(
f.point)-a(w.point));let p=u.find(({point:f,size:w})=>a(f)<Math.max(i,w));if(!p)return null;let d={x:p.point.x-e.x,y:p.point.y-e.y};return{kind:"sensor",id:p.id,
drag:s.nextGesture(),grip:d}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let u of l.
length?l:[e]){let p=this.cellAt(this.at(u));(p.x!==n.last.x||p.y!==n.last.y)&&(n.onWall=!1),a.push(...Ui(n.last,p)),n.last=p}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(u=>u.id===n.id);if(!a||!o.document)return;let l=this.metres(i,o.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>Pu&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.size===2){let{middle:a,spread:l}=this.spread();
s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(l/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:l}),o.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&Bo(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?Xi.touch:Xi.other}pointAtReading(e){let{document:n,reading:o,ghost:s}=this.
session;if(!n||s.held)return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:o}=this;
if(n?.kind!=="ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);Qi(o.ghost,n,this.metres({x:s.x+n.grip.x,y:s.y+n.grip.y},o.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level==="error"&&o.say("Ready"))}dragSensor(e){
let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(l=>l.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var Au=5,Yo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(Je.left,0,o.width,o.height-Je.bottom),e.clip(),s.hover&&ea(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&ea(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function ea(t,e,n,o,s,r,i){let{scale:a}=o.transform,l=o.fromGrid({x:e.x,y:e.y+1},n),u=Math.max(a,Au),[p,d]=[l.x-(u-a)/2,l.y-(u-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(p,d,u,u),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(p,d,u,u)}var _u={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Cu={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},Zo={light:_u,dark:Cu},ta="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Lu([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((l,u)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*s[u]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let u=ne(l,0,1);return Math.round(255*(u<=.0031308?12.92*u:1.055*u**(1/2.4)-.055))})}var Jo=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),dr=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),hr=(t,e)=>Lu(dr(t.paper,t.ink,e));function zn(t){let e=Math.min(15,Math.floor(
t*16));return dr(Jo(ta,6*e),Jo(ta,6*e+6),t*16-e)}function na(t,e){let n=new Uint8ClampedArray(2048).fill(255),[o,s]=[Jo(t.unobserved),Jo(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?bo(r/255):r/255;n.set(e==="value"?hr(t,r/255):zn(i),4*r),n.set(dr(o,s,e==="value"?r/255:0),4*(r+256))}return new Uint32Array(n.buffer)}
var pr=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var Du=9,Nu=2.5,Hn=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start||e.looking&&e.views))}paint(e,n){let{session:o}=n;o.document&&(Ne(e,n),o.decisions.looking&&this.views(e,n),this.path(e,n))}views(e,{session:n,
view:o,look:s}){let{views:r}=n.decisions,i=n.document?.grid;if(!r?.nats.length||!i)return;let[a,l]=[Math.min(...r.nats),Math.max(...r.nats)],u=ne(.38*r.spacing*
o.transform.scale/i.resolution,Nu,Du),p=r.nats.indexOf(l);for(let d=0;d<r.nats.length;d++){let f=o.fromGrid(Ae({x:r.pose[3*d],y:r.pose[3*d+1]},i),i.shape[1]);e.
beginPath(),e.arc(f.x,f.y,u,0,2*Math.PI),e.fillStyle=`rgb(${zn(ne((r.nats[d]-a)/Math.max(l-a,1e-9),0,1)).map(Math.round)})`,e.fill(),d===p&&(e.lineWidth=2.5,e.strokeStyle=
s.theme.truth,e.stroke())}}path(e,{session:n,view:o,look:s}){let{start:r,goal:i,path:a,radius:l}=n.decisions,u=n.document?.grid;if(!u||!r)return;let p=d=>o.fromGrid(
Ae(d,u),u.shape[1]);if(a){e.beginPath();for(let[d,f]of a.path){let w=p({x:d,y:f});e.lineTo(w.x,w.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=a.within_risk?s.theme.
sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*l*o.transform.scale/u.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let d of i?[r,i]:[r]){
let{x:f,y:w}=p(d);e.beginPath(),e.arc(f,w,5,0,2*Math.PI),e.fillStyle=d===r?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}}};var Ru=5,[$u,oa]=[.8,5],Fu=6,Qo=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:o,view:s,look:r}=n,{cell:i,each:a}=o.evidence,l=o.document?.grid;if(!i||!l)return;
Ne(e,n);let u=(k,M)=>s.fromGrid(Ae({x:k,y:M},l),l.shape[1]),p=k=>[u(a.start[2*k],a.start[2*k+1]),u(a.end[2*k],a.end[2*k+1])],d=a?.nats.length??0;e.lineCap="roun\
d";for(let k=d-1;k>=0;k--){let[M,T]=p(k),S=a.nats[k];e.beginPath(),e.moveTo(M.x,M.y),e.lineTo(T.x,T.y),e.globalAlpha=ne(.25+Math.abs(S)/2,0,.9),e.lineWidth=ne(oa*
Math.sqrt(Math.abs(S)/Fu),$u,oa),e.strokeStyle=S>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:f}=s.transform,w=s.fromGrid({x:i.x,y:i.y+1},l.
shape[1]),y=Math.max(1,4-f/2);e.beginPath(),e.rect(w.x-y,w.y-y,f+2*y,f+2*y),fn(e,r.theme,r.theme.belief,2);for(let k=Math.min(Ru,d)-1;k>=0;k--){let[M,T]=p(k),S=.35+
.1*k,E={x:M.x+S*(T.x-M.x),y:M.y+S*(T.y-M.y)};Ut(e,fr(a.nats[k]),E.x,E.y,r.theme,"center",!0)}}},fr=t=>`${t<0?"−":"+"}${Math.abs(t).toFixed(1)}`;var Iu=10,Ou=7,Uu=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Xo=()=>document.createElement("canvas").getContext("2d"),Vn=class{name="\
field";cells=Xo();mask=Xo();hatch=Xo();palettes=new Map;image=new ImageData(1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.
flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:l,x:u,y:p}=s.transform;Ne(e,n);let d=o.flicker.under??o.shown;if(!d||d.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
u,p,i*l,a*l);return}this.fill(d,i,a,r.theme,Uu(d,o.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,u,p,i*l,a*l),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),l>=Iu&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:l}=this,
u=`${s.ground} ${r}`;if(l.field===e&&l.palette===u)return;let p=this.palettes.get(u)??na(s,r);if(this.palettes.set(u,p),this.image.width!==n||this.image.height!==
o){this.image=new ImageData(n,o);for(let{canvas:f}of[i,a])Object.assign(f,{width:n,height:o});l.bits=null}let d=new Uint32Array(this.image.data.buffer);for(let f=0,
w=0;f<o;f++)for(let y=o-1-f;y<n*o;y+=o)d[w++]=p[e.p[y]+(e.observed[y]?0:256)];if(i.putImageData(this.image,0,0),l.bits!==e.bits){for(let f=0,w=0;f<o;f++)for(let y=o-
1-f;y<n*o;y+=o)d[w++]=e.observed[y]?0:4278190080;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,bits:e.bits,palette:u})}fillHatch({session:e,
view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:l,height:u}=n,{scale:p,x:d,y:f}=n.transform,[w,y]=e.shape,k=[o.theme.ground,p,d,f,l,u,a].join(" ");
if(i.hatch===k)return;i.hatch=k;let M=Xo(),T=M.canvas.width=M.canvas.height=Math.round(Ou*a);M.strokeStyle=o.theme.hatch,M.lineWidth=a,M.beginPath();for(let E of[
-T,0,T])M.moveTo(E-1,T+1),M.lineTo(E+T+1,-1);M.stroke(),Object.assign(s.canvas,{width:Math.ceil(l*a),height:Math.ceil(u*a)}),s.setTransform(a,0,0,a,0,0),s.imageSmoothingEnabled=
!1,s.drawImage(r.canvas,d,f,w*p,y*p),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let S=s.createPattern(M.canvas,"repeat");S.setTransform(
new DOMMatrix().translate(Math.round(d*a),Math.round(f*a))),s.fillStyle=S,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,view:o,look:s}){let[
r,i]=n.shape,{scale:a,x:l,y:u}=o.transform;e.beginPath();for(let p=1;p<r;p++)e.moveTo(l+p*a,u),e.lineTo(l+p*a,u+i*a);for(let p=1;p<i;p++)e.moveTo(l,u+p*a),e.lineTo(
l+r*a,u+p*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var Gu=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],Bn=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(Ne(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(l,u)=>{let p=ne(r[u],0,a),d=o.yaw+l,f={x:o.x+p*Math.cos(d),y:o.y+p*Math.sin(d)};return n.fromGrid(Ae(f,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(y=>this.ends(n,o,o.angles,y)),{grid:l}=n.session.document,u=n.view.fromGrid(Ae(o,l),l.shape[1]),p=new Path2D;
p.moveTo(u.x,u.y);for(let{x:y,y:k}of r)p.lineTo(y,k);p.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(p);let d=new Path2D,f=new Path2D,w=ne(n.view.transform.
scale*.12,1.2,3);for(let y=0;y<r.length;y++)d.moveTo(r[y].x,r[y].y),d.lineTo(a[y].x,a[y].y),Number.isFinite(o.median[y])&&f.rect(i[y].x-w,i[y].y-w,2*w,2*w);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=ne(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(d),e.globalAlpha=1,f}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,l=ne(n.view.transform.scale*.14,1.5,4),u=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),p=new Path2D;u.forEach(({x:d,y:f},w)=>{i[w]&&
(p.moveTo(d+l,f),p.arc(d,f,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(p)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:l,handle:u}=Qt({id:0,...r},i,o),[p,d]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(u.x,u.y),fn(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[f,w]of Gu)e.lineTo(a.x+l*(f*p-w*d),a.y+l*(f*d+w*p));e.closePath(),e.lineJoin="round",fn(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(u.x,u.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var jn=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:o,view:s,look:r}=n,i=o.flicker.under&&o.shown;if(!i)return;let[a,l]=o.shape,
{scale:u,x:p,y:d}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Ne(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,p,d,a*u,l*u)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(u=>parseInt(s.slice(u,u+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let l=new ImageData(
n,o);for(let u=0,p=0;u<o;u++)for(let d=o-1-u;d<n*o;d+=o,p+=4)l.data.set([r,i,a,e.observed[d]?e.p[d]:0],p);this.cells.putImageData(l,0,0),this.drawn={field:e,colour:s}}};var Wu=46,zu=22;function Hu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function sa(t,{session:e,view:n,look:o}){if(!e.document)
return;let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:l,shape:u}=e.document.grid,{scale:p,x:d,y:f}=n.transform,w=Hu(Wu/p*l),y=Math.min(f+u[1]*p,i-Je.bottom)+
.5,k=Math.max(d,Je.left)-.5;t.fillStyle=s.ground,d<k&&t.fillRect(0,0,k,i+1),f+u[1]*p>y&&t.fillRect(0,y,r+1,i+1-y);let M=Math.max(0,-Math.floor(Math.log10(w)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let T=E=>Math.ceil(a[E]/w-1e-9)*w,S=E=>a[E]+u[E]*l+1e-9;for(let E=T(0);E<=S(0);E+=w){let A=d+(E-a[0])/l*p;A<k||
A>r-4||(t.moveTo(A,y),t.lineTo(A,y+4),Ut(t,E.toFixed(M),A,y+12,s,"center"))}for(let E=T(1);E<=S(1);E+=w){let A=f+(u[1]-(E-a[1])/l)*p;A>y||A<4||(t.moveTo(k,A),t.
lineTo(k-4,A),Ut(t,E.toFixed(M),k-7,A,s,"right"))}t.stroke(),Ut(t,"m",k-zu,y+12,s,"right")}var Kn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=ur(e).flatMap(({id:i,x:a,y:l,yaw:u})=>[i,a,l,u]),{grid:s}=e.document??{},
r=ra(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:u,y:p}=s.transform;r.truth&&ra(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(u-.5,p-.5,i*l+1,a*l+1),Ji(e,n),sa(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:l}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=Gi(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),Ne(e,n),e.transform(i,0,0,-i,a,l+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=ne(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},ra=({document:t})=>t?.source.kind==="simulation";var Vu=600,Bu=1500,ju=65536,mr=.3,qn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;
if(!i||!a)return;Ne(e,n);let{scale:l}=s.transform,u=1/a.grid.resolution,p=a.grid.shape[1],d=i.angles.length,f=i.pose.length/3,w=Math.ceil(d*f/Bu),[y,k,M]=[new Path2D,
new Path2D,new Path2D],T=d*f>Vu,S=new Map,E=ne(l*.1,1.3,4),A=a.scans_used??1/0,J=(i.index??0)<A?1:mr;for(let N=0;N<f;N++){let[Z,B,q]=i.pose.subarray(3*N,3*N+3),
R=s.fromGrid(Ae({x:Z,y:B},a.grid),p);for(let _=0;_<d;_++){let j=i.ranges[N*d+_],I=i.hit[N*d+_]===1,V=(I?j:a.max_range)*u*l,W=i.angles[_]+q,Y={x:R.x+V*Math.cos(W),
y:R.y-V*Math.sin(W)},z=I?y:k;(N*d+_)%w===0&&(z.moveTo(R.x,R.y),z.lineTo(Y.x,Y.y)),I&&(T?S.set(Math.round(Y.x)*ju+Math.round(Y.y),Y):(M.moveTo(Y.x+E,Y.y),M.arc(Y.
x,Y.y,E,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=J*ne(28/Math.sqrt(d*f/w)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(y),e.strokeStyle=r.theme.
noReturn,e.stroke(k),e.globalAlpha=1),r.readings){e.globalAlpha=J,e.fillStyle=r.theme.ray,e.fill(M);let N=1.8*E;for(let{x:Z,y:B}of S.values())e.fillRect(Z-N/2,B-
N/2,N,N);e.globalAlpha=1}}};var Ku=2.5,wo=t=>t>=Ku,Yn=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(Ne(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&wo(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[u,p,d]of[[0,l,.6],
[Math.max(0,l-1),a,.6*mr]]){e.beginPath();for(let f=u;f<p;f++){let w=o.fromGrid(Ae({x:r[2*f],y:r[2*f+1]},i),i.shape[1]);e.lineTo(w.x,w.y)}e.globalAlpha=d,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,u,p,d]=r.subarray(a,a+4),[f,
w]=[o.fromGrid(Ae({x:l,y:u},i),i.shape[1]),o.fromGrid(Ae({x:p,y:d},i),i.shape[1])];e.moveTo(f.x,f.y),e.lineTo(w.x,w.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=ne(o.transform.scale/5,.8,2.5),e.stroke()}}};var qu=2.2,es=7,[Yu,Ju]=[.03,.75],Zu=2.4477,ia=9,Jn=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!(!s||!r)){Ne(e,n),this.
cloud(e,n,r);for(let i of s.modes)this.place(e,n,r,i,s.modes.length>1)}}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||
1;e.strokeStyle=e.fillStyle=s.theme.belief,e.lineWidth=1.2;for(let u=0;u<a.length;u++){if(a[u]<Yu**2*l)continue;let[p,d,f]=i.subarray(3*u,3*u+3),w=o.fromGrid(Ae(
{x:p,y:d},r),r.shape[1]);e.globalAlpha=Ju*Math.sqrt(a[u]/l),e.beginPath(),e.arc(w.x,w.y,qu,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(w.x,w.y),e.lineTo(w.x+es*
Math.cos(f),w.y-es*Math.sin(f)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:o},s,r,i){let[a,l,u]=r.mean,p=n.fromGrid(Ae({x:a,y:l},s),s.shape[1]),d=Zu*n.transform.
scale/s.resolution,[[f,w],[,y]]=r.covariance,[k,M]=[(f+y)/2,Math.hypot((f-y)/2,w)],[T,S]=[k+M,k-M].map(A=>Math.max(ia,d*Math.sqrt(Math.max(A,0))));e.beginPath(),
e.ellipse(p.x,p.y,T,S,-Math.atan2(2*w,f-y)/2,0,2*Math.PI);let E=ia+1;e.moveTo(p.x+E*Math.cos(u),p.y-E*Math.sin(u)),e.lineTo(p.x+(E+es)*Math.cos(u),p.y-(E+es)*Math.
sin(u)),e.strokeStyle=o.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i&&Ut(e,gr(r.probability),p.x,p.y-S-9,o.theme,
"center",!0)}},gr=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var aa=900,xo=2;function la({session:t,look:e}){let[n,o]=t.shape,s=new Wn;s.resize(aa,Math.round(ne(aa*o/n,300,1800)),xo),s.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:s.width*xo,height:s.height*xo});let i=r.getContext("2d");i.scale(xo,xo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);
let a=[new Vn,new jn,new Yn,new qn,new Kn,new Hn,new Jn,new Bn],l={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let u of a)(u.shows?.(
l)??!0)&&(i.save(),u.paint(i,l),i.restore());return new Promise(u=>r.toBlob(u))}var ts=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:l,document:u}=o;if(!i||!u||l?.index!==
i.scan)return;Ne(e,n);let{grid:p,max_range:d}=u,f=M=>{let T={x:i.from.x+M*Math.cos(i.angle),y:i.from.y+M*Math.sin(i.angle)};return s.fromGrid(Ae(T,p),p.shape[1])},
w=(M,T,S,E)=>{e.beginPath(),e.moveTo(M.x,M.y),e.lineTo(T.x,T.y),e.lineWidth=S,e.strokeStyle=E,e.stroke()},y=l.hit[i.beam]===1,k=f(y?l.ranges[i.beam]:d);if(w(f(0),
k,3,r.theme.halo),w(f(0),k,1.5,y?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let M=(T,S)=>ne(T??S,0,d);if(w(f(M(a.low,0)),f(M(a.high,d)),6,r.theme.ghost),
a.median!==null){let T=f(a.median),S={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};w({x:T.x-S.x,y:T.y-S.y},{x:T.x+S.x,y:T.y+S.y},2.5,r.theme.ghost)}}y&&(e.beginPath(),
e.arc(k.x,k.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};function v(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function L(t,e,n){t[e]!==n&&(t[e]=n)}function dt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var mn=t=>t.getRootNode().activeElement===t,Me=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function yr(t,e){let n=URL.
createObjectURL(e);v("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var ca=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["path","Path","path"],["look","Look next","look"],["w\
here","Where am I?","where"],["ghost","Ghost","ghost"],["evidence","Evidence","evidence"]];function ua(t){let{hand:e,session:n}=t,o=t.segmented("Tool",ca,()=>n.
editable||!n.document||At.has(e.tool)?e.tool:"pan",s=>e.choose(s),s=>n.editable||At.has(s)&&!n.recorded||s==="pan");return t.visible(o,()=>!n.recorded),ca.forEach(
([s],r)=>{At.has(s)||t.visible(o.children[r],()=>!n.document||n.editable)}),v("div",{className:"bar"},o,v("span",{className:"space"}),t.button("minus","Zoom out",
()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fi\
t"),{title:"Whole map (0)"}))}var Qu="uplot",Xu="u-hz",ed="u-vt",td="u-title",nd="u-wrap",od="u-under",sd="u-over",rd="u-axis",bn="u-off",id="u-select",ad="u-cursor-x",ld="u-cursor-y",cd="u-\
cursor-pt",ud="u-legend",dd="u-live",hd="u-inline",pd="u-series",fd="u-marker",da="u-label",md="u-value",ko="width",So="height";var ha="bottom",Zn="left",br="right",$r="#000",pa=$r+"0",wr="mousemove",fa="mousedown",xr="mouseup",ma="mouseenter",ga="mouseleave",ya="dblclick",gd="resize",yd="\
scroll",ba="change",is="dppxchange",Fr="--",so=typeof window<"u",Tr=so?document:null,Xn=so?window:null,bd=so?navigator:null,he,ns;function Pr(){let t=devicePixelRatio;
he!=t&&(he=t,ns&&Ar(ba,ns,Pr),ns=matchMedia(`(min-resolution: ${he-.001}dppx) and (max-resolution: ${he+.001}dppx)`),wn(ba,ns,Pr),Xn.dispatchEvent(new CustomEvent(
is)))}function ht(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function Er(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Te(t,e,n){
t.style[e]=n+"px"}function _t(t,e,n,o){let s=Tr.createElement(t);return e!=null&&ht(s,e),n?.insertBefore(s,o),s}function vt(t,e){return _t("div",t,e)}var wa=new WeakMap;
function Gt(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=wa.get(t);r!=i&&(t.style.transform=r,wa.set(t,r),e<0||n<0||e>o||n>s?ht(t,bn):Er(t,bn))}var xa=new WeakMap;
function va(t,e,n){let o=e+n,s=xa.get(t);o!=s&&(xa.set(t,o),t.style.background=e,t.style.borderColor=n)}var ka=new WeakMap;function Sa(t,e,n,o){let s=e+""+n,r=ka.
get(t);s!=r&&(ka.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Ir={passive:!0},wd={...Ir,
capture:!0};function wn(t,e,n,o){e.addEventListener(t,n,o?wd:Ir)}function Ar(t,e,n,o){e.removeEventListener(t,n,Ir)}so&&Pr();function Ct(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:pt((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function Za(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var Qa=t=>t!=null,Xa=t=>t!=null&&t>0,cs=Za(Qa),xd=Za(Xa);function vd(t,e,n,o=0,s=!1){
let r=s?xd:cs,i=s?Xa:Qa;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(o==1)a=t[e],l=t[n];else if(o==-1)a=t[n],l=t[e];else for(let u=e;u<=n;u++){let p=t[u];i(p)&&(p<
a?a=p:p>l&&(l=p))}return[a??ge,l??-ge]}function us(t,e,n,o){let s=Pa(t),r=Pa(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Bt:el,a=s==1?pt:kt,l=r==1?kt:pt,
u=a(i(Ie(t))),p=l(i(Ie(e))),d=eo(n,u),f=eo(n,p);return n==10&&(u<0&&(d=ye(d,-u)),p<0&&(f=ye(f,-p))),o||n==2?(t=d*s,e=f*r):(t=sl(t,d),e=ds(e,f)),[t,e]}function Or(t,e,n,o){
let s=us(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ur=.1,Ma={mode:3,pad:Ur},To={pad:0,soft:null,mode:0},kd={min:To,max:To};function as(t,e,n,o){return hs(
n)?Ta(t,e,n):(To.pad=n,To.soft=o?0:null,To.mode=o?3:0,Ta(t,e,kd))}function ue(t,e){return t??e}function Sd(t,e,n){for(e=ue(e,0),n=ue(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Ta(t,e,n){let o=n.min,s=n.max,r=ue(o.pad,0),i=ue(s.pad,0),a=ue(o.hard,-ge),l=ue(s.hard,ge),u=ue(o.soft,ge),p=ue(s.soft,-ge),
d=ue(o.mode,0),f=ue(s.mode,0),w=e-t,y=Bt(w),k=nt(Ie(t),Ie(e)),M=Bt(k),T=Ie(M-y);(w<1e-24||T>10)&&(w=0,(t==0||e==0)&&(w=1e-24,d==2&&u!=ge&&(r=0),f==2&&p!=-ge&&(i=
0)));let S=w||k||1e3,E=Bt(S),A=eo(10,pt(E)),J=S*(w==0?t==0?.1:1:r),N=ye(sl(t-J,A/10),24),Z=t>=u&&(d==1||d==3&&N<=u||d==2&&N>=u)?u:ge,B=nt(a,N<Z&&t>=Z?Z:Lt(Z,N)),
q=S*(w==0?e==0?.1:1:i),R=ye(ds(e+q,A/10),24),_=e<=p&&(f==1||f==3&&R>=p||f==2&&R<=p)?p:-ge,j=Lt(l,R>_&&e<=_?_:nt(_,R));return B==j&&B==0&&(j=100),[B,j]}var Md=new Intl.
NumberFormat(so?bd.language:"en-US"),Gr=t=>Md.format(t),ft=Math,rs=ft.PI,Ie=ft.abs,pt=ft.floor,Fe=ft.round,kt=ft.ceil,Lt=ft.min,nt=ft.max,eo=ft.pow,Pa=ft.sign,Bt=ft.
log10,el=ft.log2,Td=(t,e=1)=>ft.sinh(t)*e,vr=(t,e=1)=>ft.asinh(t/e),ge=1/0;function Ea(t){return(Bt((t^t>>31)-(t>>31))|0)+1}function _r(t,e,n){return Lt(nt(t,e),
n)}function tl(t){return typeof t=="function"}function se(t){return tl(t)?t:()=>t}var Pd=()=>{},nl=t=>t,ol=(t,e)=>e,Ed=t=>null,Aa=t=>!0,_a=(t,e)=>t==e,Ad=/\.\d*?(?=9{6,}|0{6,})/gm,
xn=t=>{if(il(t)||en.has(t))return t;let e=`${t}`,n=e.match(Ad);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${xn(
s)}e${r}`}return ye(t,o)};function gn(t,e){return xn(ye(xn(t/e))*e)}function ds(t,e){return xn(kt(xn(t/e))*e)}function sl(t,e){return xn(pt(xn(t/e))*e)}function ye(t,e=0){
if(il(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Fe(o)/n}var en=new Map;function rl(t){return((""+t).split(".")[1]||"").length}function Eo(t,e,n,o){
let s=[],r=o.map(rl);for(let i=e;i<n;i++){let a=Ie(i),l=ye(eo(t,i),a);for(let u=0;u<o.length;u++){let p=t==10?+`${o[u]}e${i}`:o[u]*l,d=(i>=0?0:a)+(i>=r[u]?0:r[u]),
f=t==10?p:ye(p,d);s.push(f),en.set(f,d)}}return s}var Po={},Wr=[],to=[null,null],Xt=Array.isArray,il=Number.isInteger,_d=t=>t===void 0;function Ca(t){return typeof t==
"string"}function hs(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function Cd(t){return t!=null&&typeof t=="object"}var Ld=Object.getPrototypeOf(
Uint8Array),al="__proto__";function no(t,e=hs){let n;if(Xt(t)){let o=t.find(s=>s!=null);if(Xt(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=no(t[s],
e)}else n=t.slice()}else if(t instanceof Ld)n=t.slice();else if(e(t)){n={};for(let o in t)o!=al&&(n[o]=no(t[o],e))}else n=t;return n}function Re(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=al&&(hs(t[s])?Re(t[s],no(o[s])):t[s]=no(o[s]))}return t}var Dd=0,Nd=1,Rd=2;function $d(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function Fd(t,e){if(Ud(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return Gd(i[0])||(i=Od(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],u=l.length;for(let p=0;p<
u;p++)n.add(l[p])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let u=1;u<a.length;u++){let p=a[u],d=Array(s).fill(void 0),f=e?e[i][u]:Nd,w=[];for(let y=0;y<p.length;y++){let k=p[y],M=r.get(l[y]);k===null?f!=Dd&&(d[M]=k,
f==Rd&&w.push(M)):d[M]=k}$d(d,w,s),o.push(d)}}return o}var Id=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Od(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[o[l]];s.push(a)}return s}function Ud(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function Gd(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=nt(1,pt((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var ll=["January","February","March",
"April","May","June","July","August","September","October","November","December"],cl=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function ul(t){
return t.slice(0,3)}var Wd=cl.map(ul),zd=ll.map(ul),Hd={MMMM:ll,MMM:zd,WWWW:cl,WWW:Wd};function vo(t){return(t<10?"0":"")+t}function Vd(t){return(t<10?"00":t<100?
"0":"")+t}var Bd={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>vo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>vo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>vo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>vo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>vo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Vd(t.getMilliseconds())};function zr(t,e){e=e||Hd;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?Bd[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var jd=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function Kd(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==jd?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var dl=t=>t%1==0,ls=[1,2,2.5,5],qd=Eo(10,-32,0,ls),hl=Eo(10,0,32,ls),Yd=hl.filter(
dl),yn=qd.concat(hl),Hr=`
`,pl="{YYYY}",La=Hr+pl,fl="{M}/{D}",Mo=Hr+fl,os=Mo+"/{YY}",ml="{aa}",Jd="{h}:{mm}",Qn=Jd+ml,Da=Hr+Qn,Na=":{ss}",pe=null;function gl(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,l=(t==1?Eo(10,0,3,ls).filter(dl):Eo(10,-3,0,ls)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),u=[[i,pl,pe,pe,pe,pe,pe,pe,1],[s*28,"{MMM}",La,pe,pe,pe,pe,pe,1],[s,fl,La,pe,
pe,pe,pe,pe,1],[o,"{h}"+ml,os,pe,Mo,pe,pe,pe,1],[n,Qn,os,pe,Mo,pe,pe,pe,1],[e,Na,os+" "+Qn,pe,Mo+" "+Qn,pe,Da,pe,1],[t,Na+".{fff}",os+" "+Qn,pe,Mo+" "+Qn,pe,Da,
pe,1]];function p(d){return(f,w,y,k,M,T)=>{let S=[],E=M>=i,A=M>=r&&M<i,J=d(y),N=ye(J*t,3),Z=kr(J.getFullYear(),E?0:J.getMonth(),A||E?1:J.getDate()),B=ye(Z*t,3);
if(A||E){let q=A?M/r:0,R=E?M/i:0,_=N==B?N:ye(kr(Z.getFullYear()+R,Z.getMonth()+q,1)*t,3),j=new Date(Fe(_/t)),I=j.getFullYear(),V=j.getMonth();for(let W=0;_<=k;W++){
let Y=kr(I+R*W,V+q*W,1),z=Y-d(ye(Y*t,3));_=ye((+Y+z)*t,3),_<=k&&S.push(_)}}else{let q=M>=s?s:M,R=pt(y)-pt(N),_=B+R+ds(N-B,q);S.push(_);let j=d(_),I=j.getHours()+
j.getMinutes()/n+j.getSeconds()/o,V=M/o,W=f.axes[w]._space,Y=T/W;for(;_=ye(_+M,t==1?0:3),!(_>k);)if(V>1){let z=pt(ye(I+V,6))%24,re=d(_).getHours()-z;re>1&&(re=-1),
_-=re*o,I=(I+V)%24;let le=S[S.length-1];ye((_-le)/M,3)*Y>=.7&&S.push(_)}else S.push(_)}return S}}return[l,u,p]}var[Zd,Qd,Xd]=gl(1),[eh,th,nh]=gl(.001);Eo(2,-53,
53,[1]);function Ra(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function $a(t,e){return(n,o,s,r,i)=>{let a=e.find(y=>i>=
y[0])||e[e.length-1],l,u,p,d,f,w;return o.map(y=>{let k=t(y),M=k.getFullYear(),T=k.getMonth(),S=k.getDate(),E=k.getHours(),A=k.getMinutes(),J=k.getSeconds(),N=M!=
l&&a[2]||T!=u&&a[3]||S!=p&&a[4]||E!=d&&a[5]||A!=f&&a[6]||J!=w&&a[7]||a[1];return l=M,u=T,p=S,d=E,f=A,w=J,N(k)})}}function oh(t,e){let n=zr(e);return(o,s,r,i,a)=>s.
map(l=>n(t(l)))}function kr(t,e,n){return new Date(t,e,n)}function Fa(t,e){return e(t)}var sh="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Ia(t,e){return(n,o,s,r)=>r==
null?Fr:e(t(o))}function rh(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function ih(t,e){return t.series[e].fill(
t,e)}var ah={show:!0,live:!0,isolate:!1,mount:Pd,markers:{show:!0,width:2,stroke:rh,fill:ih,dash:"solid"},idx:null,idxs:null,values:[]};function lh(t,e){let n=t.
cursor.points,o=vt(),s=n.size(t,e);Te(o,ko,s),Te(o,So,s);let r=s/-2;Te(o,"marginLeft",r),Te(o,"marginTop",r);let i=n.width(t,e,s);return i&&Te(o,"borderWidth",i),
o}function ch(t,e){let n=t.series[e].points;return n._fill||n._stroke}function uh(t,e){let n=t.series[e].points;return n._stroke||n._fill}function dh(t,e){return t.
series[e].points.size}var Sr=[0,0];function hh(t,e,n){return Sr[0]=e,Sr[1]=n,Sr}function ss(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function Mr(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var ph={show:!0,x:!0,y:!0,lock:!1,move:hh,points:{one:!1,show:lh,size:dh,width:0,stroke:uh,fill:ch},bind:{mousedown:ss,mouseup:ss,
click:ss,dblclick:ss,mousemove:Mr,mouseleave:Mr,mouseenter:Mr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},yl={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Vr=Re({},yl,{filter:ol}),bl=Re({},Vr,{size:10}),wl=Re({},yl,{show:!1}),Br='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',xl="bold "+Br,vl=1.5,Oa={
show:!0,scale:"x",stroke:$r,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:xl,side:2,grid:Vr,ticks:bl,border:wl,font:Br,lineGap:vl,rotate:0},
fh="Value",mh="Time",Ua={show:!0,scale:"x",auto:!1,sorted:1,min:ge,max:-ge,idxs:[]};function gh(t,e,n,o,s){return e.map(r=>r==null?"":Gr(r))}function yh(t,e,n,o,s,r,i){
let a=[],l=en.get(s)||0;n=i?n:ye(ds(n,s),l);for(let u=n;u<=o;u=ye(u+s,l))a.push(Object.is(u,-0)?0:u);return a}function Cr(t,e,n,o,s,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,u=l==10?Bt:el,p=pt(u(n));s=eo(l,p),l==10&&(s=yn[Ct(s,yn)]);let d=n,f=s*l;l==10&&(f=yn[Ct(f,yn)]);do a.push(d),d=d+s,l==10&&!en.has(d)&&(d=ye(d,en.get(
s))),d>=f&&(s=d,f=s*l,l==10&&(f=yn[Ct(f,yn)]));while(d<=o);return a}function bh(t,e,n,o,s,r,i){let l=t.scales[t.axes[e].scale].asinh,u=o>l?Cr(t,e,nt(l,n),o,s):[
l],p=o>=0&&n<=0?[0]:[];return(n<-l?Cr(t,e,nt(l,-o),-n,s):[l]).reverse().map(f=>-f).concat(p,u)}var kl=/./,wh=/[12357]/,xh=/[125]/,Ga=/1/,Lr=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function vh(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,u=r._space,p=l(10,i),d=l(
9,i)-p>=u?kl:l(7,i)-p>=u?wh:l(5,i)-p>=u?xh:Ga;if(d==Ga){let f=Ie(l(1,i)-p);if(f<u)return Lr(e.slice().reverse(),a.distr,d,kt(u/f)).reverse()}return Lr(e,a.distr,
d,1)}function kh(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,u=Ie(l(1,i)-l(2,i));return u<a?Lr(e.slice().reverse(),3,kl,kt(a/u)).reverse():e}function Sh(t,e,n,o){
return o==null?Fr:e==null?"":Gr(e)}var Wa={show:!0,scale:"y",stroke:$r,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:xl,side:3,grid:Vr,ticks:bl,
border:wl,font:Br,lineGap:vl,rotate:0};function Mh(t,e){let n=3+(t||1)*2;return ye(n*e,3)}function Th(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Ie(i-r),l=t.series[e],u=a/(l.points.space*he);return o[1]-o[0]<=u}var za={scale:null,auto:!0,sorted:0,min:ge,max:-ge},
Sl=(t,e,n,o,s)=>s,Ha={show:!0,auto:!0,sorted:0,gaps:Sl,alpha:1,facets:[Re({},za,{scale:"x"}),Re({},za,{scale:"y"})]},Va={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Sl,alpha:1,points:{show:Th,filter:null},values:null,min:ge,max:-ge,idxs:[],path:null,clip:null};function Ph(t,e,n,o,s){return n/10}var Ml={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Eh=Re({},Ml,{time:!1,ori:1}),Ba={};function Tl(t,e){let n=Ba[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,l,u){for(let p=0;p<n.plots.length;p++)n.plots[p]!=s&&n.plots[p].pub(o,s,r,i,a,l,u)}},t!=null&&(Ba[t]=
n)),n}var oo=1,Dr=2;function vn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],u=o==2?r[1]:r[e],p=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],d=o==2?i[s.facets[1].scale]:i[s.scale],f=a.left,w=a.top,y=a.width,k=a.height,M=t.valToPosH,T=t.valToPosV;return p.ori==0?n(s,l,u,p,d,M,T,f,
w,y,k,fs,ro,gs,El,_l):n(s,l,u,p,d,T,M,w,f,k,y,ms,io,qr,Al,Cl)}function jr(t,e){let n=0,o=0,s=ue(t.bands,Wr);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function Ah(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function jt(t,e,n,o,s,r){return vn(t,e,(i,a,l,u,p,d,f,w,y,k,M)=>{let T=i.pxRound,S=u.
dir*(u.ori==0?1:-1),E=u.ori==0?ro:io,A,J;S==1?(A=n,J=o):(A=o,J=n);let N=T(d(a[A],u,k,w)),Z=T(f(l[A],p,M,y)),B=T(d(a[J],u,k,w)),q=T(f(r==1?p.max:p.min,p,M,y)),R=new Path2D(
s);return E(R,B,q),E(R,N,q),E(R,N,Z),R})}function ps(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?gs:qr,l=n;for(let d=0;d<t.length;d++){let f=t[d];
if(f[1]>f[0]){let w=f[0]-l;w>0&&a(i,l,o,w,o+r),l=f[1]}}let u=n+s-l,p=10;u>0&&a(i,l,o-p/2,u,o+r+p)}return i}function _h(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Kr(t,e,n,o,s,r,i){let a=[],l=t.length;for(let u=s==1?n:o;u>=n&&u<=o;u+=s)if(e[u]===null){let d=u,f=u;if(s==1)for(;++u<=o&&e[u]===null;)
f=u;else for(;--u>=n&&e[u]===null;)f=u;let w=r(t[d]),y=f==d?w:r(t[f]),k=d-s;w=i<=0&&k>=0&&k<l?r(t[k]):w;let T=f+s;y=i>=0&&T>=0&&T<l?r(t[T]):y,y>=w&&a.push([w,y])}
return a}function ja(t){return t==0?nl:t==1?Fe:e=>gn(e,t)}function Pl(t){let e=t==0?fs:ms,n=t==0?(s,r,i,a,l,u)=>{s.arcTo(r,i,a,l,u)}:(s,r,i,a,l,u)=>{s.arcTo(i,r,
l,a,u)},o=t==0?(s,r,i,a,l)=>{s.rect(r,i,a,l)}:(s,r,i,a,l)=>{s.rect(i,r,l,a)};return(s,r,i,a,l,u=0,p=0)=>{u==0&&p==0?o(s,r,i,a,l):(u=Lt(u,a/2,l/2),p=Lt(p,a/2,l/2),
e(s,r+u,i),n(s,r+a,i,r+a,i+l,u),n(s,r+a,i+l,r,i+l,p),n(s,r,i+l,r,i,p),n(s,r,i,r+a,i,u),s.closePath())}}var fs=(t,e,n)=>{t.moveTo(e,n)},ms=(t,e,n)=>{t.moveTo(n,e)},
ro=(t,e,n)=>{t.lineTo(e,n)},io=(t,e,n)=>{t.lineTo(n,e)},gs=Pl(0),qr=Pl(1),El=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},Al=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},_l=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},Cl=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function Ll(t){return(e,n,o,s,r)=>vn(e,n,(i,a,l,u,p,d,f,w,y,k,M)=>{let{pxRound:T,
points:S}=i,E,A;u.ori==0?(E=fs,A=El):(E=ms,A=Al);let J=ye(S.width*he,3),N=(S.size-S.width)/2*he,Z=ye(N*2,3),B=new Path2D,q=new Path2D,{left:R,top:_,width:j,height:I}=e.
bbox;gs(q,R-Z,_-Z,j+Z*2,I+Z*2);let V=W=>{if(l[W]!=null){let Y=T(d(a[W],u,k,w)),z=T(f(l[W],p,M,y));E(B,Y+N,z),A(B,Y,z,N,0,rs*2)}};if(r)r.forEach(V);else for(let W=o;W<=
s;W++)V(W);return{stroke:J>0?B:null,fill:B,clip:q,flags:oo|Dr}})}function Dl(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var Ch=Dl(ro),Lh=Dl(io);function Nl(t){let e=ue(t?.alignGaps,0);return(n,o,s,r)=>vn(n,o,(i,a,l,u,p,d,f,w,y,k,M)=>{[s,r]=cs(l,s,r);let T=i.pxRound,S=I=>T(d(I,u,k,
w)),E=I=>T(f(I,p,M,y)),A,J;u.ori==0?(A=ro,J=Ch):(A=io,J=Lh);let N=u.dir*(u.ori==0?1:-1),Z={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:oo},B=Z.
stroke,q=!1;if(r-s>=k*4){let I=G=>n.posToVal(G,u.key,!0),V=null,W=null,Y,z,je,be=S(a[N==1?s:r]),re=S(a[s]),le=S(a[r]),ee=I(N==1?re+1:le-1);for(let G=N==1?s:r;G>=
s&&G<=r;G+=N){let _e=a[G],me=(N==1?_e<ee:_e>ee)?be:S(_e),ae=l[G];me==be?ae!=null?(z=ae,V==null?(A(B,me,E(z)),Y=V=W=z):z<V?V=z:z>W&&(W=z)):ae===null&&(q=!0):(V!=
null&&J(B,be,E(V),E(W),E(Y),E(z)),ae!=null?(z=ae,A(B,me,E(z)),V=W=Y=z):(V=W=null,ae===null&&(q=!0)),be=me,ee=I(be+N))}V!=null&&V!=W&&je!=be&&J(B,be,E(V),E(W),E(
Y),E(z))}else for(let I=N==1?s:r;I>=s&&I<=r;I+=N){let V=l[I];V===null?q=!0:V!=null&&A(B,S(a[I]),E(V))}let[_,j]=jr(n,o);if(i.fill!=null||_!=0){let I=Z.fill=new Path2D(
B),V=i.fillTo(n,o,i.min,i.max,_),W=E(V),Y=S(a[s]),z=S(a[r]);N==-1&&([z,Y]=[Y,z]),A(I,z,W),A(I,Y,W)}if(!i.spanGaps){let I=[];q&&I.push(...Kr(a,l,s,r,N,S,e)),Z.gaps=
I=i.gaps(n,o,s,r,I),Z.clip=ps(I,u.ori,w,y,k,M)}return j!=0&&(Z.band=j==2?[jt(n,o,s,r,B,-1),jt(n,o,s,r,B,1)]:jt(n,o,s,r,B,j)),Z})}function Dh(t){let e=ue(t.align,
1),n=ue(t.ascDesc,!1),o=ue(t.alignGaps,0),s=ue(t.extend,!1);return(r,i,a,l)=>vn(r,i,(u,p,d,f,w,y,k,M,T,S,E)=>{[a,l]=cs(d,a,l);let A=u.pxRound,{left:J,width:N}=r.
bbox,Z=re=>A(y(re,f,S,M)),B=re=>A(k(re,w,E,T)),q=f.ori==0?ro:io,R={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:oo},_=R.stroke,j=f.dir*(f.ori==
0?1:-1),I=B(d[j==1?a:l]),V=Z(p[j==1?a:l]),W=V,Y=V;s&&e==-1&&(Y=J,q(_,Y,I)),q(_,V,I);for(let re=j==1?a:l;re>=a&&re<=l;re+=j){let le=d[re];if(le==null)continue;let ee=Z(
p[re]),G=B(le);e==1?q(_,ee,I):q(_,W,G),q(_,ee,G),I=G,W=ee}let z=W;s&&e==1&&(z=J+N,q(_,z,I));let[je,be]=jr(r,i);if(u.fill!=null||je!=0){let re=R.fill=new Path2D(
_),le=u.fillTo(r,i,u.min,u.max,je),ee=B(le);q(re,z,ee),q(re,Y,ee)}if(!u.spanGaps){let re=[];re.push(...Kr(p,d,a,l,j,Z,o));let le=u.width*he/2,ee=n||e==1?le:-le,
G=n||e==-1?-le:le;re.forEach(_e=>{_e[0]+=ee,_e[1]+=G}),R.gaps=re=u.gaps(r,i,a,l,re),R.clip=ps(re,f.ori,M,T,S,E)}return be!=0&&(R.band=be==2?[jt(r,i,a,l,_,-1),jt(
r,i,a,l,_,1)]:jt(r,i,a,l,_,be)),R})}function Ka(t,e,n,o,s,r,i=ge){if(t.length>1){let a=null;for(let l=0,u=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let p=Ie(
t[l]-t[a]);p<u&&(u=p,i=Ie(n(t[l],o,s,r)-n(t[a],o,s,r)))}a=l}}return i}function Nh(t){t=t||Po;let e=ue(t.size,[.6,ge,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==
null?[0,0]:typeof s=="number"?[s,0]:s;let r=se(s),i=1-e[0],a=ue(e[1],ge),l=ue(e[2],1),u=ue(t.disp,Po),p=ue(t.each,w=>{}),{fill:d,stroke:f}=u;return(w,y,k,M)=>vn(
w,y,(T,S,E,A,J,N,Z,B,q,R,_)=>{let j=T.pxRound,I=n,V=o*he,W=a*he,Y=l*he,z,je;A.ori==0?[z,je]=r(w,y):[je,z]=r(w,y);let be=A.dir*(A.ori==0?1:-1),re=A.ori==0?gs:qr,
le=A.ori==0?p:(O,we,$e,Mn,sn,Dt,rn)=>{p(O,we,$e,sn,Mn,rn,Dt)},ee=ue(w.bands,Wr).find(O=>O.series[0]==y),G=ee!=null?ee.dir:0,_e=T.fillTo(w,y,T.min,T.max,G),Ue=j(
Z(_e,J,_,q)),me,ae,ot,st=R,Pe=j(T.width*he),St=!1,mt=null,K=null,ie=null,Ke=null;d!=null&&(Pe==0||f!=null)&&(St=!0,mt=d.values(w,y,k,M),K=new Map,new Set(mt).forEach(
O=>{O!=null&&K.set(O,new Path2D)}),Pe>0&&(ie=f.values(w,y,k,M),Ke=new Map,new Set(ie).forEach(O=>{O!=null&&Ke.set(O,new Path2D)})));let{x0:Wt,size:lo}=u;if(Wt!=
null&&lo!=null){I=1,S=Wt.values(w,y,k,M),Wt.unit==2&&(S=S.map($e=>w.posToVal(B+$e*R,A.key,!0)));let O=lo.values(w,y,k,M);lo.unit==2?ae=O[0]*R:ae=N(O[0],A,R,B)-N(
0,A,R,B),st=Ka(S,E,N,A,R,B,st),ot=st-ae+V}else st=Ka(S,E,N,A,R,B,st),ot=st*i+V,ae=st-ot;ot<1&&(ot=0),Pe>=ae/2&&(Pe=0),ot<5&&(j=nl);let Ao=ot>0,nn=st-ot-(Ao?Pe:0);
ae=j(_r(nn,Y,W)),me=(I==0?ae/2:I==be?0:ae)-I*be*((I==0?V/2:0)+(Ao?Pe/2:0));let Qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Sn=St?null:new Path2D,
zt=null;if(ee!=null)zt=w.data[ee.series[1]];else{let{y0:O,y1:we}=u;O!=null&&we!=null&&(E=we.values(w,y,k,M),zt=O.values(w,y,k,M))}let on=z*ae,te=je*ae;for(let O=be==
1?k:M;O>=k&&O<=M;O+=be){let we=E[O];if(we==null)continue;if(zt!=null){let rt=zt[O]??0;if(we-rt==0)continue;Ue=Z(rt,J,_,q)}let $e=A.distr!=2||u!=null?S[O]:O,Mn=N(
$e,A,R,B),sn=Z(ue(we,_e),J,_,q),Dt=j(Mn-me),rn=j(nt(sn,Ue)),at=j(Lt(sn,Ue)),gt=rn-at;if(we!=null){let rt=we<0?te:on,Mt=we<0?on:te;St?(Pe>0&&ie[O]!=null&&re(Ke.get(
ie[O]),Dt,at+pt(Pe/2),ae,nt(0,gt-Pe),rt,Mt),mt[O]!=null&&re(K.get(mt[O]),Dt,at+pt(Pe/2),ae,nt(0,gt-Pe),rt,Mt)):re(Sn,Dt,at+pt(Pe/2),ae,nt(0,gt-Pe),rt,Mt),le(w,y,
O,Dt-Pe/2,at,ae+Pe,gt)}}return Pe>0?Qe.stroke=St?Ke:Sn:St||(Qe._fill=T.width==0?T._fill:T._stroke??T._fill,Qe.width=0),Qe.fill=St?K:Sn,Qe})}function Rh(t,e){let n=ue(
e?.alignGaps,0);return(o,s,r,i)=>vn(o,s,(a,l,u,p,d,f,w,y,k,M,T)=>{[r,i]=cs(u,r,i);let S=a.pxRound,E=z=>S(f(z,p,M,y)),A=z=>S(w(z,d,T,k)),J,N,Z;p.ori==0?(J=fs,Z=ro,
N=_l):(J=ms,Z=io,N=Cl);let B=p.dir*(p.ori==0?1:-1),q=E(l[B==1?r:i]),R=q,_=[],j=[];for(let z=B==1?r:i;z>=r&&z<=i;z+=B)if(u[z]!=null){let be=l[z],re=E(be);_.push(
R=re),j.push(A(u[z]))}let I={stroke:t(_,j,J,Z,N,S),fill:null,clip:null,band:null,gaps:null,flags:oo},V=I.stroke,[W,Y]=jr(o,s);if(a.fill!=null||W!=0){let z=I.fill=
new Path2D(V),je=a.fillTo(o,s,a.min,a.max,W),be=A(je);Z(z,R,be),Z(z,q,be)}if(!a.spanGaps){let z=[];z.push(...Kr(l,u,r,i,B,E,n)),I.gaps=z=a.gaps(o,s,r,i,z),I.clip=
ps(z,p.ori,y,k,M,T)}return Y!=0&&(I.band=Y==2?[jt(o,s,r,i,V,-1),jt(o,s,r,i,V,1)]:jt(o,s,r,i,V,Y)),I})}function $h(t){return Rh(Fh,t)}function Fh(t,e,n,o,s,r){let i=t.
length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let l=Array(i),u=Array(i-1),p=Array(i-1),d=Array(i-1);for(let f=0;f<i-1;f++)
p[f]=e[f+1]-e[f],d[f]=t[f+1]-t[f],u[f]=p[f]/d[f];l[0]=u[0];for(let f=1;f<i-1;f++)u[f]===0||u[f-1]===0||u[f-1]>0!=u[f]>0?l[f]=0:(l[f]=3*(d[f-1]+d[f])/((2*d[f]+d[f-
1])/u[f-1]+(d[f]+2*d[f-1])/u[f]),isFinite(l[f])||(l[f]=0));l[i-1]=u[i-2];for(let f=0;f<i-1;f++)s(a,t[f]+d[f]/3,e[f]+l[f]*d[f]/3,t[f+1]-d[f]/3,e[f+1]-l[f+1]*d[f]/
3,t[f+1],e[f+1])}return a}var Nr=new Set;function qa(){for(let t of Nr)t.syncRect(!0)}so&&(wn(gd,Xn,qa),wn(yd,Xn,qa,!0),wn(is,Xn,()=>{Oe.pxRatio=he}));var Ih=Nl(),
Oh=Ll();function Ya(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Rr(r,i,e,n))}function Uh(t,e){return t.map((n,o)=>o==
0?{}:Re({},e,n))}function Rr(t,e,n,o){return Re({},e==0?n:o,t)}function Rl(t,e,n){return e==null?to:[e,n]}var Gh=Rl;function Wh(t,e,n){return e==null?to:as(e,n,
Ur,!0)}function $l(t,e,n,o){return e==null?to:us(e,n,t.scales[o].log,!1)}var zh=$l;function Fl(t,e,n,o){return e==null?to:Or(e,n,t.scales[o].log,!1)}var Hh=Fl;function Vh(t,e,n,o,s){
let r=nt(Ea(t),Ea(e)),i=e-t,a=Ct(s/o*i,n);do{let l=n[a],u=o*l/i;if(u>=s&&r+(l<5?en.get(l):0)<=17)return[l,u]}while(++a<n.length);return[0,0]}function Ja(t){let e,
n;return t=t.replace(/(\d+)px/,(o,s)=>(e=Fe((n=+s)*he))+"px"),[t,e,n]}function Bh(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=ye(e[2]*he,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Oe(t,e,n){let o={mode:ue(t.mode,1)},s=o.mode;function r(c,h,m,g){let b=h.valToPct(c);return g+m*(h.dir==-1?1-b:b)}function i(c,h,m,g){
let b=h.valToPct(c);return g+m*(h.dir==-1?b:1-b)}function a(c,h,m,g){return h.ori==0?r(c,h,m,g):i(c,h,m,g)}o.valToPosH=r,o.valToPosV=i;let l=!1;o.status=0;let u=o.
root=vt(Qu);if(t.id!=null&&(u.id=t.id),ht(u,t.class),t.title){let c=vt(td,u);c.textContent=t.title}let p=_t("canvas"),d=o.ctx=p.getContext("2d"),f=vt(nd,u);wn("\
click",f,c=>{c.target===y&&(xe!=$n||Ee!=Fn)&&Ye.click(o,c)},!0);let w=o.under=vt(od,f);f.appendChild(p);let y=o.over=vt(sd,f);t=no(t);let k=+ue(t.pxAlign,1),M=ja(
k);(t.plugins||[]).forEach(c=>{c.opts&&(t=c.opts(o,t)||t)});let T=t.ms||.001,S=o.series=s==1?Ya(t.series||[],Ua,Va,!1):Uh(t.series||[null],Ha),E=o.axes=Ya(t.axes||
[],Oa,Wa,!0),A=o.scales={},J=o.bands=t.bands||[];J.forEach(c=>{c.fill=se(c.fill||null),c.dir=ue(c.dir,-1)});let N=s==2?S[1].facets[0].scale:S[0].scale,Z={axes:su,
series:Xc},B=(t.drawOrder||["axes","series"]).map(c=>Z[c]);function q(c){let h=c.distr==3?m=>Bt(m>0?m:c.clamp(o,m,c.min,c.max,c.key)):c.distr==4?m=>vr(m,c.asinh):
c.distr==100?m=>c.fwd(m):m=>m;return m=>{let g=h(m),{_min:b,_max:x}=c,P=x-b;return(g-b)/P}}function R(c){let h=A[c];if(h==null){let m=(t.scales||Po)[c]||Po;if(m.
from!=null){R(m.from);let g=Re({},A[m.from],m,{key:c});g.valToPct=q(g),A[c]=g}else{h=A[c]=Re({},c==N?Ml:Eh,m),h.key=c;let g=h.time,b=h.range,x=Xt(b);if((c!=N||s==
2&&!g)&&(x&&(b[0]==null||b[1]==null)&&(b={min:b[0]==null?Ma:{mode:1,hard:b[0],soft:b[0]},max:b[1]==null?Ma:{mode:1,hard:b[1],soft:b[1]}},x=!1),!x&&hs(b))){let P=b;
b=(C,D,$)=>D==null?to:as(D,$,P)}h.range=se(b||(g?Gh:c==N?h.distr==3?zh:h.distr==4?Hh:Rl:h.distr==3?$l:h.distr==4?Fl:Wh)),h.auto=se(x?!1:h.auto),h.clamp=se(h.clamp||
Ph),h._min=h._max=null,h.valToPct=q(h)}}}R("x"),R("y"),s==1&&S.forEach(c=>{R(c.scale)}),E.forEach(c=>{R(c.scale)});for(let c in t.scales)R(c);let _=A[N],j=_.distr,
I,V;_.ori==0?(ht(u,Xu),I=r,V=i):(ht(u,ed),I=i,V=r);let W={};for(let c in A){let h=A[c];(h.min!=null||h.max!=null)&&(W[c]={min:h.min,max:h.max},h.min=h.max=null)}
let Y=t.tzDate||(c=>new Date(Fe(c/T))),z=t.fmtDate||zr,je=T==1?Xd(Y):nh(Y),be=$a(Y,Ra(T==1?Qd:th,z)),re=Ia(Y,Fa(sh,z)),le=[],ee=o.legend=Re({},ah,t.legend),G=o.
cursor=Re({},ph,{drag:{y:s==2}},t.cursor),_e=ee.show,Ue=G.show,me=ee.markers;ee.idxs=le,me.width=se(me.width),me.dash=se(me.dash),me.stroke=se(me.stroke),me.fill=
se(me.fill);let ae,ot,st,Pe=[],St=[],mt,K=!1,ie={};if(ee.live){let c=S[1]?S[1].values:null;K=c!=null,mt=K?c(o,1,0):{_:0};for(let h in mt)ie[h]=Fr}if(_e)if(ae=_t(
"table",ud,u),st=_t("tbody",null,ae),ee.mount(o,ae),K){ot=_t("thead",null,ae,st);let c=_t("tr",null,ot);_t("th",null,c);for(var Ke in mt)_t("th",da,c).textContent=
Ke}else ht(ae,hd),ee.live&&ht(ae,dd);let Wt={show:!0},lo={show:!1};function Ao(c,h){if(h==0&&(K||!ee.live||s==2))return to;let m=[],g=_t("tr",pd,st,st.childNodes[h]);
ht(g,c.class),c.show||ht(g,bn);let b=_t("th",null,g);if(me.show){let C=vt(fd,b);if(h>0){let D=me.width(o,h);D&&(C.style.border=D+"px "+me.dash(o,h)+" "+me.stroke(
o,h)),C.style.background=me.fill(o,h)}}let x=vt(da,b);c.label instanceof HTMLElement?x.appendChild(c.label):x.textContent=c.label,h>0&&(me.show||(x.style.color=
c.width>0?me.stroke(o,h):me.fill(o,h)),Qe("click",b,C=>{if(G._lock)return;ln(C);let D=S.indexOf(c);if((C.ctrlKey||C.metaKey)!=ee.isolate){let $=S.some((F,U)=>U>
0&&U!=D&&F.show);S.forEach((F,U)=>{U>0&&Rt(U,$?U==D?Wt:lo:Wt,!0,De.setSeries)})}else Rt(D,{show:!c.show},!0,De.setSeries)},!1),Pn&&Qe(ma,b,C=>{G._lock||(ln(C),Rt(
S.indexOf(c),On,!0,De.setSeries))},!1));for(var P in mt){let C=_t("td",md,g);C.textContent="--",m.push(C)}return[g,m]}let nn=new Map;function Qe(c,h,m,g=!0){let b=nn.
get(h)||{},x=G.bind[c](o,h,m,g);x&&(wn(c,h,b[c]=x),nn.set(h,b))}function Sn(c,h,m){let g=nn.get(h)||{};for(let b in g)(c==null||b==c)&&(Ar(b,h,g[b]),delete g[b]);
c==null&&nn.delete(h)}let zt=0,on=0,te=0,O=0,we=0,$e=0,Mn=we,sn=$e,Dt=te,rn=O,at=0,gt=0,rt=0,Mt=0;o.bbox={};let Os=!1,_o=!1,Tn=!1,an=!1,Co=!1,yt=!1;function Us(c,h,m){
(m||c!=o.width||h!=o.height)&&ri(c,h),Ln(!1),Tn=!0,_o=!0,Dn()}function ri(c,h){o.width=zt=te=c,o.height=on=O=h,we=$e=0,jc(),Kc();let m=o.bbox;at=m.left=gn(we*he,
.5),gt=m.top=gn($e*he,.5),rt=m.width=gn(te*he,.5),Mt=m.height=gn(O*he,.5)}let Hc=3;function Vc(){let c=!1,h=0;for(;!c;){h++;let m=nu(h),g=ou(h);c=h==Hc||m&&g,c||
(ri(o.width,o.height),_o=!0)}}function Bc({width:c,height:h}){Us(c,h)}o.setSize=Bc;function jc(){let c=!1,h=!1,m=!1,g=!1;E.forEach((b,x)=>{if(b.show&&b._show){let{
side:P,_size:C}=b,D=P%2,$=b.label!=null?b.labelSize:0,F=C+$;F>0&&(D?(te-=F,P==3?(we+=F,g=!0):m=!0):(O-=F,P==0?($e+=F,c=!0):h=!0))}}),cn[0]=c,cn[1]=m,cn[2]=h,cn[3]=
g,te-=Kt[1]+Kt[3],we+=Kt[3],O-=Kt[2]+Kt[0],$e+=Kt[0]}function Kc(){let c=we+te,h=$e+O,m=we,g=$e;function b(x,P){switch(x){case 1:return c+=P,c-P;case 2:return h+=
P,h-P;case 3:return m-=P,m+P;case 0:return g-=P,g+P}}E.forEach((x,P)=>{if(x.show&&x._show){let C=x.side;x._pos=b(C,x._size),x.label!=null&&(x._lpos=b(C,x.labelSize))}})}
if(G.dataIdx==null){let c=G.hover,h=c.skip=new Set(c.skip??[]);h.add(void 0);let m=c.prox=se(c.prox),g=c.bias??=0;G.dataIdx=(b,x,P,C)=>{if(x==0)return P;let D=P,
$=m(b,x,P,C)??ge,F=$>=0&&$<ge,U=_.ori==0?te:O,X=G.left,de=e[0],ce=e[x];if(h.has(ce[P])){D=null;let oe=null,Q=null,H;if(g==0||g==-1)for(H=P;oe==null&&H-- >0;)h.has(
ce[H])||(oe=H);if(g==0||g==1)for(H=P;Q==null&&H++<ce.length;)h.has(ce[H])||(Q=H);if(oe!=null||Q!=null)if(F){let ke=oe==null?-1/0:I(de[oe],_,U,0),Ce=Q==null?1/0:
I(de[Q],_,U,0),Be=X-ke,fe=Ce-X;Be<=fe?Be<=$&&(D=oe):fe<=$&&(D=Q)}else D=Q==null?oe:oe==null?Q:P-oe<=Q-P?oe:Q}else F&&Ie(X-I(de[P],_,U,0))>$&&(D=null);return D}}
let ln=c=>{G.event=c};G.idxs=le,G._lock=!1;let Ze=G.points;Ze.show=se(Ze.show),Ze.size=se(Ze.size),Ze.stroke=se(Ze.stroke),Ze.width=se(Ze.width),Ze.fill=se(Ze.fill);
let Nt=o.focus=Re({},t.focus||{alpha:.3},G.focus),Pn=Nt.prox>=0,En=Pn&&Ze.one,bt=[],An=[],_n=[];function ii(c,h){let m=Ze.show(o,h);if(m instanceof HTMLElement)
return ht(m,cd),ht(m,c.class),Gt(m,-10,-10,te,O),y.insertBefore(m,bt[h]),m}function ai(c,h){if(s==1||h>0){let m=s==1&&A[c.scale].time,g=c.value;c.value=m?Ca(g)?
Ia(Y,Fa(g,z)):g||re:g||Sh,c.label=c.label||(m?mh:fh)}if(En||h>0){c.width=c.width==null?1:c.width,c.paths=c.paths||Ih||Ed,c.fillTo=se(c.fillTo||Ah),c.pxAlign=+ue(
c.pxAlign,k),c.pxRound=ja(c.pxAlign),c.stroke=se(c.stroke||null),c.fill=se(c.fill||null),c._stroke=c._fill=c._paths=c._focus=null;let m=Mh(nt(1,c.width),1),g=c.
points=Re({},{size:m,width:nt(1,m*.2),stroke:c.stroke,space:m*2,paths:Oh,_stroke:null,_fill:null},c.points);g.show=se(g.show),g.filter=se(g.filter),g.fill=se(g.
fill),g.stroke=se(g.stroke),g.paths=se(g.paths),g.pxAlign=c.pxAlign}if(_e){let m=Ao(c,h);Pe.splice(h,0,m[0]),St.splice(h,0,m[1]),ee.values.push(null)}if(Ue){le.
splice(h,0,null);let m=null;En?h==0&&(m=ii(c,h)):h>0&&(m=ii(c,h)),bt.splice(h,0,m),An.splice(h,0,0),_n.splice(h,0,0)}Ve("addSeries",h)}function qc(c,h){h=h??S.length,
c=s==1?Rr(c,h,Ua,Va):Rr(c,h,{},Ha),S.splice(h,0,c),ai(S[h],h)}o.addSeries=qc;function Yc(c){if(S.splice(c,1),_e){ee.values.splice(c,1),St.splice(c,1);let h=Pe.splice(
c,1)[0];Sn(null,h.firstChild),h.remove()}Ue&&(le.splice(c,1),bt.splice(c,1)[0].remove(),An.splice(c,1),_n.splice(c,1)),Ve("delSeries",c)}o.delSeries=Yc;let cn=[
!1,!1,!1,!1];function Jc(c,h){if(c._show=c.show,c.show){let m=c.side%2,g=A[c.scale];g==null&&(c.scale=m?S[1].scale:N,g=A[c.scale]);let b=g.time;c.size=se(c.size),
c.space=se(c.space),c.rotate=se(c.rotate),Xt(c.incrs)&&c.incrs.forEach(P=>{!en.has(P)&&en.set(P,rl(P))}),c.incrs=se(c.incrs||(g.distr==2?Yd:b?T==1?Zd:eh:yn)),c.
splits=se(c.splits||(b&&g.distr==1?je:g.distr==3?Cr:g.distr==4?bh:yh)),c.stroke=se(c.stroke),c.grid.stroke=se(c.grid.stroke),c.ticks.stroke=se(c.ticks.stroke),c.
border.stroke=se(c.border.stroke);let x=c.values;c.values=Xt(x)&&!Xt(x[0])?se(x):b?Xt(x)?$a(Y,Ra(x,z)):Ca(x)?oh(Y,x):x||be:x||gh,c.filter=se(c.filter||(g.distr>=
3&&g.log==10?vh:g.distr==3&&g.log==2?kh:ol)),c.font=Ja(c.font),c.labelFont=Ja(c.labelFont),c._size=c.size(o,null,h,0),c._space=c._rotate=c._incrs=c._found=c._splits=
c._values=null,c._size>0&&(cn[h]=!0,c._el=vt(rd,f))}}function co(c,h,m,g){let[b,x,P,C]=m,D=h%2,$=0;return D==0&&(C||x)&&($=h==0&&!b||h==2&&!P?Fe(Oa.size/3):0),D==
1&&(b||P)&&($=h==1&&!x||h==3&&!C?Fe(Wa.size/2):0),$}let li=o.padding=(t.padding||[co,co,co,co]).map(c=>se(ue(c,co))),Kt=o._padding=li.map((c,h)=>c(o,h,cn,0)),qe,
Ge=null,We=null,Lo=s==1?S[0].idxs:null,Tt=null,uo=!1;function ci(c,h){if(e=c??[],o.data=o._data=e,s==2){qe=0;for(let m=1;m<S.length;m++)qe+=e[m][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),Tt=e[0],qe=Tt.length;let m=e;if(j==2){m=e.slice();let g=m[0]=Array(qe);for(let b=0;b<qe;b++)g[b]=b}o._data=e=m}if(Ln(!0),Ve(
"setData"),j==2&&(Tn=!0),h!==!1){let m=_;m.auto(o,uo)?Gs():Yt(N,m.min,m.max),an=an||G.left>=0,yt=!0,Dn()}}o.setData=ci;function Gs(){uo=!0;let c,h;s==1&&(qe>0?(Ge=
Lo[0]=0,We=Lo[1]=qe-1,c=e[0][Ge],h=e[0][We],j==2?(c=Ge,h=We):c==h&&(j==3?[c,h]=us(c,c,_.log,!1):j==4?[c,h]=Or(c,c,_.log,!1):_.time?h=c+Fe(86400/T):[c,h]=as(c,h,
Ur,!0))):(Ge=Lo[0]=c=null,We=Lo[1]=h=null)),Yt(N,c,h)}let Do,Cn,Ws,zs,Hs,Vs,Bs,js,Ks,it;function ui(c,h,m,g,b,x){c??=pa,m??=Wr,g??="butt",b??=pa,x??="round",c!=
Do&&(d.strokeStyle=Do=c),b!=Cn&&(d.fillStyle=Cn=b),h!=Ws&&(d.lineWidth=Ws=h),x!=Hs&&(d.lineJoin=Hs=x),g!=Vs&&(d.lineCap=Vs=g),m!=zs&&d.setLineDash(zs=m)}function di(c,h,m,g){
h!=Cn&&(d.fillStyle=Cn=h),c!=Bs&&(d.font=Bs=c),m!=js&&(d.textAlign=js=m),g!=Ks&&(d.textBaseline=Ks=g)}function qs(c,h,m,g,b=0){if(g.length>0&&c.auto(o,uo)&&(h==
null||h.min==null)){let x=ue(Ge,0),P=ue(We,g.length-1),C=m.min==null?vd(g,x,P,b,c.distr==3):[m.min,m.max];c.min=Lt(c.min,m.min=C[0]),c.max=nt(c.max,m.max=C[1])}}
let hi={min:null,max:null};function Zc(){for(let g in A){let b=A[g];W[g]==null&&(b.min==null||W[N]!=null&&b.auto(o,uo))&&(W[g]=hi)}for(let g in A){let b=A[g];W[g]==
null&&b.from!=null&&W[b.from]!=null&&(W[g]=hi)}W[N]!=null&&Ln(!0);let c={};for(let g in W){let b=W[g];if(b!=null){let x=c[g]=no(A[g],Cd);if(b.min!=null)Re(x,b);else if(g!=
N||s==2)if(qe==0&&x.from==null){let P=x.range(o,null,null,g);x.min=P[0],x.max=P[1]}else x.min=ge,x.max=-ge}}if(qe>0){S.forEach((g,b)=>{if(s==1){let x=g.scale,P=W[x];
if(P==null)return;let C=c[x];if(b==0){let D=C.range(o,C.min,C.max,x);C.min=D[0],C.max=D[1],Ge=Ct(C.min,e[0]),We=Ct(C.max,e[0]),We-Ge>1&&(e[0][Ge]<C.min&&Ge++,e[0][We]>
C.max&&We--),g.min=Tt[Ge],g.max=Tt[We]}else g.show&&g.auto&&qs(C,P,g,e[b],g.sorted);g.idxs[0]=Ge,g.idxs[1]=We}else if(b>0&&g.show&&g.auto){let[x,P]=g.facets,C=x.
scale,D=P.scale,[$,F]=e[b],U=c[C],X=c[D];U!=null&&qs(U,W[C],x,$,x.sorted),X!=null&&qs(X,W[D],P,F,P.sorted),g.min=P.min,g.max=P.max}});for(let g in c){let b=c[g],
x=W[g];if(b.from==null&&(x==null||x.min==null)){let P=b.range(o,b.min==ge?null:b.min,b.max==-ge?null:b.max,g);b.min=P[0],b.max=P[1]}}}for(let g in c){let b=c[g];
if(b.from!=null){let x=c[b.from];if(x.min==null)b.min=b.max=null;else{let P=b.range(o,x.min,x.max,g);b.min=P[0],b.max=P[1]}}}let h={},m=!1;for(let g in c){let b=c[g],
x=A[g];if(x.min!=b.min||x.max!=b.max){x.min=b.min,x.max=b.max;let P=x.distr;x._min=P==3?Bt(x.min):P==4?vr(x.min,x.asinh):P==100?x.fwd(x.min):x.min,x._max=P==3?Bt(
x.max):P==4?vr(x.max,x.asinh):P==100?x.fwd(x.max):x.max,h[g]=m=!0}}if(m){S.forEach((g,b)=>{s==2?b>0&&h.y&&(g._paths=null):h[g.scale]&&(g._paths=null)});for(let g in h)
Tn=!0,Ve("setScale",g);Ue&&G.left>=0&&(an=yt=!0)}for(let g in W)W[g]=null}function Qc(c){let h=_r(Ge-1,0,qe-1),m=_r(We+1,0,qe-1);for(;c[h]==null&&h>0;)h--;for(;c[m]==
null&&m<qe-1;)m++;return[h,m]}function Xc(){if(qe>0){let c=S.some(h=>h._focus)&&it!=Nt.alpha;c&&(d.globalAlpha=it=Nt.alpha),S.forEach((h,m)=>{if(m>0&&h.show&&(pi(
m,!1),pi(m,!0),h._paths==null)){let g=it;it!=h.alpha&&(d.globalAlpha=it=h.alpha);let b=s==2?[0,e[m][0].length-1]:Qc(e[m]);h._paths=h.paths(o,m,b[0],b[1]),it!=g&&
(d.globalAlpha=it=g)}}),S.forEach((h,m)=>{if(m>0&&h.show){let g=it;it!=h.alpha&&(d.globalAlpha=it=h.alpha),h._paths!=null&&fi(m,!1);{let b=h._paths!=null?h._paths.
gaps:null,x=h.points.show(o,m,Ge,We,b),P=h.points.filter(o,m,x,b);(x||P)&&(h.points._paths=h.points.paths(o,m,Ge,We,P),fi(m,!0))}it!=g&&(d.globalAlpha=it=g),Ve(
"drawSeries",m)}}),c&&(d.globalAlpha=it=1)}}function pi(c,h){let m=h?S[c].points:S[c];m._stroke=m.stroke(o,c),m._fill=m.fill(o,c)}function fi(c,h){let m=h?S[c].
points:S[c],{stroke:g,fill:b,clip:x,flags:P,_stroke:C=m._stroke,_fill:D=m._fill,_width:$=m.width}=m._paths;$=ye($*he,3);let F=null,U=$%2/2;h&&D==null&&(D=$>0?"#\
fff":C);let X=m.pxAlign==1&&U>0;if(X&&d.translate(U,U),!h){let de=at-$/2,ce=gt-$/2,oe=rt+$,Q=Mt+$;F=new Path2D,F.rect(de,ce,oe,Q)}h?Ys(C,$,m.dash,m.cap,D,g,b,P,
x):eu(c,C,$,m.dash,m.cap,D,g,b,P,F,x),X&&d.translate(-U,-U)}function eu(c,h,m,g,b,x,P,C,D,$,F){let U=!1;D!=0&&J.forEach((X,de)=>{if(X.series[0]==c){let ce=S[X.series[1]],
oe=e[X.series[1]],Q=(ce._paths||Po).band;Xt(Q)&&(Q=X.dir==1?Q[0]:Q[1]);let H,ke=null;ce.show&&Q&&Sd(oe,Ge,We)?(ke=X.fill(o,de)||x,H=ce._paths.clip):Q=null,Ys(h,
m,g,b,ke,P,C,D,$,F,H,Q),U=!0}}),U||Ys(h,m,g,b,x,P,C,D,$,F)}let mi=oo|Dr;function Ys(c,h,m,g,b,x,P,C,D,$,F,U){ui(c,h,m,g,b),(D||$||U)&&(d.save(),D&&d.clip(D),$&&
d.clip($)),U?(C&mi)==mi?(d.clip(U),F&&d.clip(F),Ro(b,P),No(c,x,h)):C&Dr?(Ro(b,P),d.clip(U),No(c,x,h)):C&oo&&(d.save(),d.clip(U),F&&d.clip(F),Ro(b,P),d.restore(),
No(c,x,h)):(Ro(b,P),No(c,x,h)),(D||$||U)&&d.restore()}function No(c,h,m){m>0&&(h instanceof Map?h.forEach((g,b)=>{d.strokeStyle=Do=b,d.stroke(g)}):h!=null&&c&&d.
stroke(h))}function Ro(c,h){h instanceof Map?h.forEach((m,g)=>{d.fillStyle=Cn=g,d.fill(m)}):h!=null&&c&&d.fill(h)}function tu(c,h,m,g){let b=E[c],x;if(g<=0)x=[0,
0];else{let P=b._space=b.space(o,c,h,m,g),C=b._incrs=b.incrs(o,c,h,m,g,P);x=Vh(h,m,C,g,P)}return b._found=x}function Js(c,h,m,g,b,x,P,C,D,$){let F=P%2/2;k==1&&d.
translate(F,F),ui(C,P,D,$,C),d.beginPath();let U,X,de,ce,oe=b+(g==0||g==3?-x:x);m==0?(X=b,ce=oe):(U=b,de=oe);for(let Q=0;Q<c.length;Q++)h[Q]!=null&&(m==0?U=de=c[Q]:
X=ce=c[Q],d.moveTo(U,X),d.lineTo(de,ce));d.stroke(),k==1&&d.translate(-F,-F)}function nu(c){let h=!0;return E.forEach((m,g)=>{if(!m.show)return;let b=A[m.scale];
if(b.min==null){m._show&&(h=!1,m._show=!1,Ln(!1));return}else m._show||(h=!1,m._show=!0,Ln(!1));let x=m.side,P=x%2,{min:C,max:D}=b,[$,F]=tu(g,C,D,P==0?te:O);if(F==
0)return;let U=b.distr==2,X=m._splits=m.splits(o,g,C,D,$,F,U),de=b.distr==2?X.map(H=>Tt[H]):X,ce=b.distr==2?Tt[X[1]]-Tt[X[0]]:$,oe=m._values=m.values(o,m.filter(
o,de,g,F,ce),g,F,ce);m._rotate=x==2?m.rotate(o,oe,g,F):0;let Q=m._size;m._size=kt(m.size(o,oe,g,c)),Q!=null&&m._size!=Q&&(h=!1)}),h}function ou(c){let h=!0;return li.
forEach((m,g)=>{let b=m(o,g,cn,c);b!=Kt[g]&&(h=!1),Kt[g]=b}),h}function su(){for(let c=0;c<E.length;c++){let h=E[c];if(!h.show||!h._show)continue;let m=h.side,g=m%
2,b,x,P=h.stroke(o,c),C=m==0||m==3?-1:1,[D,$]=h._found;if(h.label!=null){let et=h.labelGap*C,ut=Fe((h._lpos+et)*he);di(h.labelFont[0],P,"center",m==2?"top":ha),
d.save(),g==1?(b=x=0,d.translate(ut,Fe(gt+Mt/2)),d.rotate((m==3?-rs:rs)/2)):(b=Fe(at+rt/2),x=ut);let hn=tl(h.label)?h.label(o,c,D,$):h.label;d.fillText(hn,b,x),
d.restore()}if($==0)continue;let F=A[h.scale],U=g==0?rt:Mt,X=g==0?at:gt,de=h._splits,ce=F.distr==2?de.map(et=>Tt[et]):de,oe=F.distr==2?Tt[de[1]]-Tt[de[0]]:D,Q=h.
ticks,H=h.border,ke=Q.show?Q.size:0,Ce=Fe(ke*he),Be=Fe((h.alignTo==2?h._size-ke-h.gap:h.gap)*he),fe=h._rotate*-rs/180,Le=M(h._pos*he),lt=(Ce+Be)*C,Xe=Le+lt;x=g==
0?Xe:0,b=g==1?Xe:0;let wt=h.font[0],Pt=h.align==1?Zn:h.align==2?br:fe>0?Zn:fe<0?br:g==0?"center":m==3?br:Zn,Ft=fe||g==1?"middle":m==2?"top":ha;di(wt,P,Pt,Ft);let ct=h.
font[1]*h.lineGap,xt=de.map(et=>M(a(et,F,U,X))),Et=h._values;for(let et=0;et<Et.length;et++){let ut=Et[et];if(ut!=null){g==0?b=xt[et]:x=xt[et],ut=""+ut;let hn=ut.
indexOf(`
`)==-1?[ut]:ut.split(/\n/gm);for(let tt=0;tt<hn.length;tt++){let Ri=hn[tt];fe?(d.save(),d.translate(b,x+tt*ct),d.rotate(fe),d.fillText(Ri,0,0),d.restore()):d.fillText(
Ri,b,x+tt*ct)}}}Q.show&&Js(xt,Q.filter(o,ce,c,$,oe),g,m,Le,Ce,ye(Q.width*he,3),Q.stroke(o,c),Q.dash,Q.cap);let It=h.grid;It.show&&Js(xt,It.filter(o,ce,c,$,oe),g,
g==0?2:1,g==0?gt:at,g==0?Mt:rt,ye(It.width*he,3),It.stroke(o,c),It.dash,It.cap),H.show&&Js([Le],[1],g==0?1:0,g==0?1:2,g==1?gt:at,g==1?Mt:rt,ye(H.width*he,3),H.stroke(
o,c),H.dash,H.cap)}Ve("drawAxes")}function Ln(c){S.forEach((h,m)=>{m>0&&(h._paths=null,c&&(s==1?(h.min=null,h.max=null):h.facets.forEach(g=>{g.min=null,g.max=null})))})}
let $o=!1,Zs=!1,ho=[];function ru(){Zs=!1;for(let c=0;c<ho.length;c++)Ve(...ho[c]);ho.length=0}function Dn(){$o||(Id(gi),$o=!0)}function iu(c,h=!1){$o=!0,Zs=h,c(
o),gi(),h&&ho.length>0&&queueMicrotask(ru)}o.batch=iu;function gi(){if(Os&&(Zc(),Os=!1),Tn&&(Vc(),Tn=!1),_o){if(Te(w,Zn,we),Te(w,"top",$e),Te(w,ko,te),Te(w,So,O),
Te(y,Zn,we),Te(y,"top",$e),Te(y,ko,te),Te(y,So,O),Te(f,ko,zt),Te(f,So,on),p.width=Fe(zt*he),p.height=Fe(on*he),E.forEach(({_el:c,_show:h,_size:m,_pos:g,side:b})=>{
if(c!=null)if(h){let x=b===3||b===0?m:0,P=b%2==1;Te(c,P?"left":"top",g-x),Te(c,P?"width":"height",m),Te(c,P?"top":"left",P?$e:we),Te(c,P?"height":"width",P?O:te),
Er(c,bn)}else ht(c,bn)}),Do=Cn=Ws=Hs=Vs=Bs=js=Ks=zs=null,it=1,mo(!0),we!=Mn||$e!=sn||te!=Dt||O!=rn){Ln(!1);let c=te/Dt,h=O/rn;if(Ue&&!an&&G.left>=0){G.left*=c,G.
top*=h,Nn&&Gt(Nn,Fe(G.left),0,te,O),Rn&&Gt(Rn,0,Fe(G.top),te,O);for(let m=0;m<bt.length;m++){let g=bt[m];g!=null&&(An[m]*=c,_n[m]*=h,Gt(g,kt(An[m]),kt(_n[m]),te,
O))}}if(ve.show&&!Co&&ve.left>=0&&ve.width>0){ve.left*=c,ve.width*=c,ve.top*=h,ve.height*=h;for(let m in or)Te(In,m,ve[m])}Mn=we,sn=$e,Dt=te,rn=O}Ve("setSize"),
_o=!1}zt>0&&on>0&&(d.clearRect(0,0,p.width,p.height),Ve("drawClear"),B.forEach(c=>c()),Ve("draw")),ve.show&&Co&&(Fo(ve),Co=!1),Ue&&an&&(dn(null,!0,!1),an=!1),ee.
show&&ee.live&&yt&&(tr(),yt=!1),l||(l=!0,o.status=1,Ve("ready")),uo=!1,$o=!1}o.redraw=(c,h)=>{Tn=h||!1,c!==!1?Yt(N,_.min,_.max):Dn()};function Qs(c,h){let m=A[c];
if(m.from==null){if(qe==0){let g=m.range(o,h.min,h.max,c);h.min=g[0],h.max=g[1]}if(h.min>h.max){let g=h.min;h.min=h.max,h.max=g}if(qe>1&&h.min!=null&&h.max!=null&&
h.max-h.min<1e-16)return;c==N&&m.distr==2&&qe>0&&(h.min=Ct(h.min,e[0]),h.max=Ct(h.max,e[0]),h.min==h.max&&h.max++),W[c]=h,Os=!0,Dn()}}o.setScale=Qs;let Xs,er,Nn,
Rn,yi,bi,$n,Fn,wi,xi,xe,Ee,qt=!1,Ye=G.drag,ze=Ye.x,He=Ye.y;Ue&&(G.x&&(Xs=vt(ad,y)),G.y&&(er=vt(ld,y)),_.ori==0?(Nn=Xs,Rn=er):(Nn=er,Rn=Xs),xe=G.left,Ee=G.top);let ve=o.
select=Re({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),In=ve.show?vt(id,ve.over?y:w):null;function Fo(c,h){if(ve.show){for(let m in c)ve[m]=c[m],m in
or&&Te(In,m,c[m]);h!==!1&&Ve("setSelect")}}o.setSelect=Fo;function au(c){if(S[c].show)_e&&Er(Pe[c],bn);else if(_e&&ht(Pe[c],bn),Ue){let m=En?bt[0]:bt[c];m!=null&&
Gt(m,-10,-10,te,O)}}function Yt(c,h,m){Qs(c,{min:h,max:m})}function Rt(c,h,m,g){h.focus!=null&&hu(c),h.show!=null&&S.forEach((b,x)=>{x>0&&(c==x||c==null)&&(b.show=
h.show,au(x),s==2?(Yt(b.facets[0].scale,null,null),Yt(b.facets[1].scale,null,null)):Yt(b.scale,null,null),Dn())}),m!==!1&&Ve("setSeries",c,h),g&&go("setSeries",
o,c,h)}o.setSeries=Rt;function lu(c,h){Re(J[c],h)}function cu(c,h){c.fill=se(c.fill||null),c.dir=ue(c.dir,-1),h=h??J.length,J.splice(h,0,c)}function uu(c){c==null?
J.length=0:J.splice(c,1)}o.addBand=cu,o.setBand=lu,o.delBand=uu;function du(c,h){S[c].alpha=h,Ue&&bt[c]!=null&&(bt[c].style.opacity=h),_e&&Pe[c]&&(Pe[c].style.opacity=
h)}let Ht,Jt,un,On={focus:!0};function hu(c){if(c!=un){let h=c==null,m=Nt.alpha!=1;S.forEach((g,b)=>{if(s==1||b>0){let x=h||b==0||b==c;g._focus=h?null:x,m&&du(b,
x?1:Nt.alpha)}}),un=c,m&&Dn()}}_e&&Pn&&Qe(ga,ae,c=>{G._lock||(ln(c),un!=null&&Rt(null,On,!0,De.setSeries))});function $t(c,h,m){let g=A[h];m&&(c=c/he-(g.ori==1?
$e:we));let b=te;g.ori==1&&(b=O,c=b-c),g.dir==-1&&(c=b-c);let x=g._min,P=g._max,C=c/b,D=x+(P-x)*C,$=g.distr;return $==3?eo(10,D):$==4?Td(D,g.asinh):$==100?g.bwd(
D):D}function pu(c,h){let m=$t(c,N,h);return Ct(m,e[0],Ge,We)}o.valToIdx=c=>Ct(c,e[0]),o.posToIdx=pu,o.posToVal=$t,o.valToPos=(c,h,m)=>A[h].ori==0?r(c,A[h],m?rt:
te,m?at:0):i(c,A[h],m?Mt:O,m?gt:0),o.setCursor=(c,h,m)=>{xe=c.left,Ee=c.top,dn(null,h,m)};function vi(c,h){Te(In,Zn,ve.left=c),Te(In,ko,ve.width=h)}function ki(c,h){
Te(In,"top",ve.top=c),Te(In,So,ve.height=h)}let po=_.ori==0?vi:ki,fo=_.ori==1?vi:ki;function fu(){if(_e&&ee.live)for(let c=s==2?1:0;c<S.length;c++){if(c==0&&K)continue;
let h=ee.values[c],m=0;for(let g in h)St[c][m++].firstChild.nodeValue=h[g]}}function tr(c,h){if(c!=null&&(c.idxs?c.idxs.forEach((m,g)=>{le[g]=m}):_d(c.idx)||le.
fill(c.idx),ee.idx=le[0]),_e&&ee.live){for(let m=0;m<S.length;m++)(m>0||s==1&&!K)&&mu(m,le[m]);fu()}yt=!1,h!==!1&&Ve("setLegend")}o.setLegend=tr;function mu(c,h){
let m=S[c],g=c==0&&j==2?Tt:e[c],b;K?b=m.values(o,c,h)??ie:(b=m.value(o,h==null?null:g[h],c,h),b=b==null?ie:{_:b}),ee.values[c]=b}function dn(c,h,m){wi=xe,xi=Ee,
[xe,Ee]=G.move(o,xe,Ee),G.left=xe,G.top=Ee,Ue&&(Nn&&Gt(Nn,Fe(xe),0,te,O),Rn&&Gt(Rn,0,Fe(Ee),te,O));let g,b=Ge>We;Ht=ge,Jt=null;let x=_.ori==0?te:O,P=_.ori==1?te:
O;if(xe<0||qe==0||b){g=G.idx=null;for(let C=0;C<S.length;C++){let D=bt[C];D!=null&&Gt(D,-10,-10,te,O)}Pn&&Rt(null,On,!0,c==null&&De.setSeries),ee.live&&(le.fill(
g),yt=!0)}else{let C,D,$;s==1&&(C=_.ori==0?xe:Ee,D=$t(C,N),g=G.idx=Ct(D,e[0],Ge,We),$=I(e[0][g],_,x,0));let F=-10,U=-10,X=0,de=0,ce=!0,oe="",Q="";for(let H=s==2?
1:0;H<S.length;H++){let ke=S[H],Ce=le[H],Be=Ce==null?null:s==1?e[H][Ce]:e[H][1][Ce],fe=G.dataIdx(o,H,g,D),Le=fe==null?null:s==1?e[H][fe]:e[H][1][fe];if(yt=yt||Le!=
Be||fe!=Ce,le[H]=fe,H>0&&ke.show){let lt=fe==null?-10:fe==g?$:I(s==1?e[0][fe]:e[H][0][fe],_,x,0),Xe=Le==null?-10:V(Le,s==1?A[ke.scale]:A[ke.facets[1].scale],P,0);
if(Pn&&Le!=null){let wt=_.ori==1?xe:Ee,Pt=Ie(Nt.dist(o,H,fe,Xe,wt));if(Pt<Ht){let Ft=Nt.bias;if(Ft!=0){let ct=$t(wt,ke.scale),xt=Le>=0?1:-1,Et=ct>=0?1:-1;Et==xt&&
(Et==1?Ft==1?Le>=ct:Le<=ct:Ft==1?Le<=ct:Le>=ct)&&(Ht=Pt,Jt=H)}else Ht=Pt,Jt=H}}if(yt||En){let wt,Pt;_.ori==0?(wt=lt,Pt=Xe):(wt=Xe,Pt=lt);let Ft,ct,xt,Et,It,et,ut=!0,
hn=Ze.bbox;if(hn!=null){ut=!1;let tt=hn(o,H);xt=tt.left,Et=tt.top,Ft=tt.width,ct=tt.height}else xt=wt,Et=Pt,Ft=ct=Ze.size(o,H);if(et=Ze.fill(o,H),It=Ze.stroke(o,
H),En)H==Jt&&Ht<=Nt.prox&&(F=xt,U=Et,X=Ft,de=ct,ce=ut,oe=et,Q=It);else{let tt=bt[H];tt!=null&&(An[H]=xt,_n[H]=Et,Sa(tt,Ft,ct,ut),va(tt,et,It),Gt(tt,kt(xt),kt(Et),
te,O))}}}}if(En){let H=Nt.prox,ke=un==null?Ht<=H:Ht>H||Jt!=un;if(yt||ke){let Ce=bt[0];Ce!=null&&(An[0]=F,_n[0]=U,Sa(Ce,X,de,ce),va(Ce,oe,Q),Gt(Ce,kt(F),kt(U),te,
O))}}}if(ve.show&&qt)if(c!=null){let[C,D]=De.scales,[$,F]=De.match,[U,X]=c.cursor.sync.scales,de=c.cursor.drag;if(ze=de._x,He=de._y,ze||He){let{left:ce,top:oe,width:Q,
height:H}=c.select,ke=c.scales[U].ori,Ce=c.posToVal,Be,fe,Le,lt,Xe,wt=C!=null&&$(C,U),Pt=D!=null&&F(D,X);wt&&ze?(ke==0?(Be=ce,fe=Q):(Be=oe,fe=H),Le=A[C],lt=I(Ce(
Be,U),Le,x,0),Xe=I(Ce(Be+fe,U),Le,x,0),po(Lt(lt,Xe),Ie(Xe-lt))):po(0,x),Pt&&He?(ke==1?(Be=ce,fe=Q):(Be=oe,fe=H),Le=A[D],lt=V(Ce(Be,X),Le,P,0),Xe=V(Ce(Be+fe,X),Le,
P,0),fo(Lt(lt,Xe),Ie(Xe-lt))):fo(0,P)}else sr()}else{let C=Ie(wi-yi),D=Ie(xi-bi);if(_.ori==1){let X=C;C=D,D=X}ze=Ye.x&&C>=Ye.dist,He=Ye.y&&D>=Ye.dist;let $=Ye.uni;
$!=null?ze&&He&&(ze=C>=$,He=D>=$,!ze&&!He&&(D>C?He=!0:ze=!0)):Ye.x&&Ye.y&&(ze||He)&&(ze=He=!0);let F,U;ze&&(_.ori==0?(F=$n,U=xe):(F=Fn,U=Ee),po(Lt(F,U),Ie(U-F)),
He||fo(0,P)),He&&(_.ori==1?(F=$n,U=xe):(F=Fn,U=Ee),fo(Lt(F,U),Ie(U-F)),ze||po(0,x)),!ze&&!He&&(po(0,0),fo(0,0))}if(Ye._x=ze,Ye._y=He,c==null){if(m){if(Ni!=null){
let[C,D]=De.scales;De.values[0]=C!=null?$t(_.ori==0?xe:Ee,C):null,De.values[1]=D!=null?$t(_.ori==1?xe:Ee,D):null}go(wr,o,xe,Ee,te,O,g)}if(Pn){let C=m&&De.setSeries,
D=Nt.prox;un==null?Ht<=D&&Rt(Jt,On,!0,C):Ht>D?Rt(null,On,!0,C):Jt!=un&&Rt(Jt,On,!0,C)}}yt&&(ee.idx=g,tr()),h!==!1&&Ve("setCursor")}let Zt=null;Object.defineProperty(
o,"rect",{get(){return Zt==null&&mo(!1),Zt}});function mo(c=!1){c?Zt=null:(Zt=y.getBoundingClientRect(),Ve("syncRect",Zt))}function Si(c,h,m,g,b,x,P){G._lock||qt&&
c!=null&&c.movementX==0&&c.movementY==0||(nr(c,h,m,g,b,x,P,!1,c!=null),c!=null?dn(null,!0,!0):dn(h,!0,!1))}function nr(c,h,m,g,b,x,P,C,D){if(Zt==null&&mo(!1),ln(
c),c!=null)m=c.clientX-Zt.left,g=c.clientY-Zt.top;else{if(m<0||g<0){xe=-10,Ee=-10;return}let[$,F]=De.scales,U=h.cursor.sync,[X,de]=U.values,[ce,oe]=U.scales,[Q,
H]=De.match,ke=h.axes[0].side%2==1,Ce=_.ori==0?te:O,Be=_.ori==1?te:O,fe=ke?x:b,Le=ke?b:x,lt=ke?g:m,Xe=ke?m:g;if(ce!=null?m=Q($,ce)?a(X,A[$],Ce,0):-10:m=Ce*(lt/fe),
oe!=null?g=H(F,oe)?a(de,A[F],Be,0):-10:g=Be*(Xe/Le),_.ori==1){let wt=m;m=g,g=wt}}D&&(h==null||h.cursor.event.type==wr)&&((m<=1||m>=te-1)&&(m=gn(m,te)),(g<=1||g>=
O-1)&&(g=gn(g,O))),C?(yi=m,bi=g,[$n,Fn]=G.move(o,m,g)):(xe=m,Ee=g)}let or={width:0,height:0,left:0,top:0};function sr(){Fo(or,!1)}let Mi,Ti,Pi,Ei;function Ai(c,h,m,g,b,x,P){
qt=!0,ze=He=Ye._x=Ye._y=!1,nr(c,h,m,g,b,x,P,!0,!1),c!=null&&(Qe(xr,Tr,_i,!1),go(fa,o,$n,Fn,te,O,null));let{left:C,top:D,width:$,height:F}=ve;Mi=C,Ti=D,Pi=$,Ei=F}
function _i(c,h,m,g,b,x,P){qt=Ye._x=Ye._y=!1,nr(c,h,m,g,b,x,P,!1,!0);let{left:C,top:D,width:$,height:F}=ve,U=$>0||F>0,X=Mi!=C||Ti!=D||Pi!=$||Ei!=F;if(U&&X&&Fo(ve),
Ye.setScale&&U&&X){let de=C,ce=$,oe=D,Q=F;if(_.ori==1&&(de=D,ce=F,oe=C,Q=$),ze&&Yt(N,$t(de,N),$t(de+ce,N)),He)for(let H in A){let ke=A[H];H!=N&&ke.from==null&&ke.
min!=ge&&Yt(H,$t(oe+Q,H),$t(oe,H))}sr()}else G.lock&&(G._lock=!G._lock,dn(h,!0,c!=null));c!=null&&(Sn(xr,Tr),go(xr,o,xe,Ee,te,O,null))}function gu(c,h,m,g,b,x,P){
if(G._lock)return;ln(c);let C=qt;if(qt){let D=!0,$=!0,F=10,U,X;_.ori==0?(U=ze,X=He):(U=He,X=ze),U&&X&&(D=xe<=F||xe>=te-F,$=Ee<=F||Ee>=O-F),U&&D&&(xe=xe<$n?0:te),
X&&$&&(Ee=Ee<Fn?0:O),dn(null,!0,!0),qt=!1}xe=-10,Ee=-10,le.fill(null),dn(null,!0,!0),C&&(qt=C)}function Ci(c,h,m,g,b,x,P){G._lock||(ln(c),Gs(),sr(),c!=null&&go(
ya,o,xe,Ee,te,O,null))}function Li(){E.forEach(Bh),Us(o.width,o.height,!0)}wn(is,Xn,Li);let Un={};Un.mousedown=Ai,Un.mousemove=Si,Un.mouseup=_i,Un.dblclick=Ci,Un.
setSeries=(c,h,m,g)=>{let b=De.match[2];m=b(o,h,m),m!=-1&&Rt(m,g,!0,!1)},Ue&&(Qe(fa,y,Ai),Qe(wr,y,Si),Qe(ma,y,c=>{ln(c),mo(!1)}),Qe(ga,y,gu),Qe(ya,y,Ci),Nr.add(
o),o.syncRect=mo);let Io=o.hooks=t.hooks||{};function Ve(c,h,m){Zs?ho.push([c,h,m]):c in Io&&Io[c].forEach(g=>{g.call(null,o,h,m)})}(t.plugins||[]).forEach(c=>{
for(let h in c.hooks)Io[h]=(Io[h]||[]).concat(c.hooks[h])});let Di=(c,h,m)=>m,De=Re({key:null,setSeries:!1,filters:{pub:Aa,sub:Aa},scales:[N,S[1]?S[1].scale:null],
match:[_a,_a,Di],values:[null,null]},G.sync);De.match.length==2&&De.match.push(Di),G.sync=De;let Ni=De.key,rr=Tl(Ni);function go(c,h,m,g,b,x,P){De.filters.pub(c,
h,m,g,b,x,P)&&rr.pub(c,h,m,g,b,x,P)}rr.sub(o);function yu(c,h,m,g,b,x,P){De.filters.sub(c,h,m,g,b,x,P)&&Un[c](null,h,m,g,b,x,P)}o.pub=yu;function bu(){rr.unsub(
o),Nr.delete(o),nn.clear(),Ar(is,Xn,Li),u.remove(),ae?.remove(),Ve("destroy")}o.destroy=bu;function ir(){Ve("init",t,e),ci(e||t.data,!1),W[N]?Qs(N,W[N]):Gs(),Co=
ve.show&&(ve.width>0||ve.height>0),an=yt=!0,Us(t.width,t.height)}return S.forEach(ai),E.forEach(Jc),n?n instanceof HTMLElement?(n.appendChild(u),ir()):n(o,ir):ir(),
o}Oe.assign=Re;Oe.fmtNum=Gr;Oe.rangeNum=as;Oe.rangeLog=us;Oe.rangeAsinh=Or;Oe.orient=vn;Oe.pxRatio=he;Oe.join=Fd;Oe.fmtDate=zr,Oe.tzDate=Kd;Oe.sync=Tl;{Oe.addGap=
_h,Oe.clipGaps=ps;let t=Oe.paths={points:Ll};t.linear=Nl,t.stepped=Dh,t.bars=Nh,t.spline=$h}var ys=128,Il=50,jh=.25,Kh=t=>[t.ray,t.truth,t.sensor,t.noReturn],qh=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),Yh=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),bs=(t,e)=>({font:cr,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function Ol(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:ys})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:ys}),s=n()),o)}function Ul(t,e){let{session:n}=t,o=v("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${Il}`]],()=>s,y=>{s=y,u=null,n.changed()}),
i=0,a=-1/0,l=-1,u=null,d=Ol(o,()=>{let y=Kh(e()),k=Array.from({length:i},(M,T)=>({label:`chain ${T+1}`,stroke:y[T%y.length],width:1,points:{show:!1}}));return new Oe(
{width:100,height:ys,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,Yh,0,0],scales:{x:{time:!1,range:(M,T,S)=>[T,Math.max(S,T+1)]},y:{range:(M,T,S)=>Xh(
Math.max(T,a),S)}},axes:[bs(e,26),bs(e,qh)],series:[{label:"sweep"},...k],hooks:{draw:[M=>ep(M,l,e())]}},[[],...k.map(()=>[])],o)},e),f=v("span",{className:"cap\
tion",textContent:"log joint by sweep"}),w=v("div",{className:"charted"},v("div",{className:"buttons"},r,f),o);return t.each(()=>{let y=n.shown,k=y?.traced?.length?
y.trace.length/y.traced.length:0;if(L(w,"hidden",k===0),!y||!k)return;let M=n.document?.source.kind==="run"?"draw":"sweep";L(f,"textContent",`log joint by ${M}`);
let T=y.layer==="draw"&&n.draws.count?(n.draw+1)*y.traced[y.traced.length-1]/n.draws.count:-1,S=d(k!==i&&(i=k,!0));if(!S||u===y&&l===T&&S.data[0].length)return;
[u,l]=[y,T],a=s==="all"?Qh(y,k):-1/0;let E=Jh(y,k,s);S.setData(E),o.setAttribute("data-sweeps",E[0].join())}),w}function Jh({trace:t,traced:e},n,o){let s=o==="a\
ll"?Zh(e):[...e.keys()].filter(i=>e[i]<=Il),r=i=>Float32Array.from(s,a=>i[a]);return[r(e),...Array.from({length:n},(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}
function Zh(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,o=-1/0;return[...t.keys()].filter(s=>t[s]<o&&s<e-1?!1:(o=t[s]+n,!0))}function Qh({trace:t,
traced:e},n){let o=e.length,s=e.findIndex(r=>r>=jh*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.min(...t.slice(i*o+s,(i+1)*o))))}function Xh(t,e){
let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function ep(t,e,n){if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.
save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.restore())}function Gl(t,e){let{session:n}=t,o=v("div",{className:"chart",role:"img","aria-label":"\
Histogram of the particles' weights"}),s=v("div",{className:"caption",textContent:"particles by weight, nats below the heaviest"}),r=v("div",{className:"charted"},
s,o),a=Ol(o,()=>new Oe({width:100,height:ys,legend:{show:!1},cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(u,p,d)=>[p,d]},y:{distr:3,range:(u,p,d)=>[
.5,Math.max(10,2*d)]}},axes:[bs(e,26),{...bs(e,52),values:(u,p)=>p.map(d=>d>=1?String(d):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Oe.paths.bars?.({size:[
.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),l=null;return t.each(()=>{let u=n.shown;L(r,"hidden",!u?.weights);let p=u?.weights&&a(!1);if(!u?.weights||!p||
l===u&&p.data[0].length)return;l=u;let d=[...u.weights],f=-(u.lowest??-1)/d.length,w=[...d.map((y,k)=>(u.lowest??-1)+k*f),0];p.setData([w,[...d.map(y=>y||null),
null]])}),r}function Wl(t){let{session:e,hand:n}=t,{decisions:o}=e,s=v("p",{className:"said",role:"status"}),r=v("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,u=>o.set({radius:u}),{min:.01,max:100,step:"any"}),t.numberInput("Highest risk",()=>o.risk,u=>o.set({risk:u}),{min:1e-4,max:.99,step:"any"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{L(l,"textContent",i()),L(s,"textContent",n.tool==="path"?tp(t):np(t))}),a}function tp({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${Me(
o.length_m,2)} m, free with probability ${Me(o.probability,3)} ± ${Me(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${Me(o.independent,
3)}.${r}`}function np({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.
nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${Me(Math.min(...e.nats),1)} to ${Me(o,1)} nats, cells taken for indepen\
dent; the best place has a ring.${s}`}var op=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],sp="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",rp="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). No beam has been where it is hatched.",ip="Shown is what the readings tell about how likely each cell is to stop a beam: what is expected (m\
ean), one whole map that explains them (one draw), and how wide the 90 % interval is (width). No beam has been where it is hatched.",ap="While you edit, the ans\
wer is belief propagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",lp="The map is made from the scans of this log. Where it\
s poses are raw odometry, Run first infers where the robot was; then it samples maps, and keeps them as draws.",cp="This is a saved run: its draws, and what the\
y say together.",up="Mouse: the wheel zooms, the middle button pans.",dp="Shift or the right button erases, and so does a click on a wall.",hp="Touch: two finge\
rs zoom and pan.";function zl(t){let{session:e}=t,n=v("div"),o=qi.map(([i,a,l])=>{let u=v("tr",{},v("th",{scope:"row"},v("kbd",{textContent:i})),v("td",{textContent:a}));
return t.visible(u,()=>pp[l??"all"](e)),u}),s=v("p"),r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?ip:rp,l=e.editable?[`${sp} ${a}`,
ap]:i==="log"?[a,lp]:i==="run"?[a,cp]:[a];l.join()!==r&&n.replaceChildren(...l.map(u=>v("p",{textContent:u}))),r=l.join(),L(s,"textContent",[up,...e.editable?[dp]:
[],hp].join(" "))}),t.dialog("Help",n,s,v("table",{},v("tbody",{},...o)))}var pp={all:()=>!0,drawn:t=>t.editable,asked:t=>!t.recorded,inferred:t=>!t.recorded&&t.
document?.source.kind!=="run"};function Hl(t){let e=()=>v("input",{type:"number",min:Se.cells[0],max:Se.cells[1],step:1,required:!0,value:"21"}),[n,o]=[e(),e()],
s=v("select",{});for(let[i,a]of op)s.append(v("option",{value:i,textContent:a}));s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<60&&([n.
value,o.value]=["120","80"])});let r=v("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),v("div",{className:"buttons \
end"},v("button",{type:"submit",className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),
Number(o.value)],world:s.value}),t.hand.selected=null}),t.dialog("New map",r)}var fp="The link holds the walls, the sensors and all settings after its #, and no\
 token. It opens in this browser while the server runs; the part from # on can be put after the address of any bayesmap page.",mp="The link holds the file's nam\
e and all settings after its #, but no scans and no token. It opens in this browser while the server shows this file; the part from # on can be put after the ad\
dress of any bayesmap page that shows it.";function Vl(t){let e=v("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=v("span",{role:"status",className:"co\
pied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent=
"",2e3)},s=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),r=v("p");t.each(()=>L(r,"textContent",t.session.document?.source.kind==="simulatio\
n"?fp:mp));let i=t.dialog("Share",r,v("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var gp=8;function Bl(t){let{session:e,hand:n}=t,o=v("p",{className:"words",role:"status"}),s=v("ol",{className:"spoken"}),r=t.section("Evidence of beams",o,s),i=-1;
return t.visible(r,()=>n.tool==="evidence"),t.each(()=>{let{evidence:a}=e;if(L(o,"textContent",bp(e)),i===a.version)return;i=a.version;let{nats:l,scan:u,beam:p}=a.
each??{nats:[],scan:[],beam:[]},d=Array.from(l.slice(0,gp),(f,w)=>v("li",{},`${fr(f)} nats: ${yp(e,u[w],p[w])}`));s.replaceChildren(...d)}),r}var yp=({document:t,
editable:e},n,o)=>`beam ${o+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function bp({evidence:t,quantity:e}){let{cell:n,together:o}=t;if(!n)return"\
Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";let s=`Cell ${n.x}, ${n.y}`;if(!o)return`${s}: aski\
ng its beams.`;if(!o.beams)return`${s}: no beam reaches it.`;let r=o.beams===1?"1 beam":`${o.beams} beams`;if(o.nats_for===void 0||o.nats_against===void 0)return`${s}\
: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"its surface"}[e.kind]??"what is there",a=o.beams_for||o.beams_against?"":" Non\
e of them says anything.";return`${s}: ${r}. For ${i} (blue) ${o.beams_for}, ${o.nats_for.toFixed(1)} nats; against (orange) ${o.beams_against}, ${o.nats_against.
toFixed(1)} nats.${a}`}var kn=t=>t.charAt(0).toUpperCase()+t.slice(1),ws=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=kn(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var jl=t=>Math.round(t*180/Math.PI);function Kl(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(l,u)=>t.numberInput(l,()=>Number((o.pose?.[u]??0).toFixed(2)),p=>o.move(
{[u]:p}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>jl(o.pose?.yaw??0),l=>o.move({yaw:l*Math.PI/180}),{step:5}),i=v("p",{className:"words ghosted"}),a=t.
section("Ghost",v("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>L(i,"textContent",wp(t))),
a}function wp({session:t}){let{ghost:e}=t;if(e.trouble)return kn(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(p,d)=>p-o[d]).filter(Number.isFinite).sort((p,d)=>p-d),a=i.length?`${Me(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",u=r?` \
Rings are the hits of scan ${r.index+1}, taken ${Me(100*r.away,0)} cm from here, turned by ${jl(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${u}`}function ql(t){let{session:e}=t,n=v("span",{className:"what"});t.each(()=>{let{grid:u,source:p}=e.document??{};if(!u||!p)return;let d=`${u.shape[0]} × ${u.shape[1]}\
 cells of ${+u.resolution.toPrecision(3)} m`;L(n,"textContent",p.name?`${p.name}, ${d}`:d)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),v("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let u of s)t.visible(u,()=>!e.recorded);let r=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=v("span",{className:"space"});return{element:v("header",{},v("h1",{textContent:"bayesmap"}),n,a,...s,vp(t),r,
i),nameTheme(u){let p=`Theme: ${u}`;dt(r,"aria-label",p),L(r,"title",p)}}}var xp=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function vp(t){
let{session:e}=t,n=(a,l,u,p)=>{let d=t.button(null,a,()=>t.command(`export ${l}`),{text:a,when:p});return u&&t.visible(d,()=>!e.recorded),d},o=v("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>xp(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),s=t.button("save","Export",()=>r(o.hidden),{text:"Export",when:()=>!!e.document}),r=a=>{o.hidden=!a,s.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};r(!1);let i=v("div",{className:"anchor"},s,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(r(!1),s.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||r(!1)}),o.addEventListener("click",()=>{r(!1),s.
focus()}),i}var kp={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function tn(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",kp[t]),e.append(n),e}var xs=({document:t})=>!t||t.source.kind==="simulation",Yr=({recorded:t})=>!t,Yl="surface (zoom in)",Jl=[{mark:"truth",text:"true wall",when:xs,may:xs},{mark:"r\
ay",text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.
strokes.length,may:t=>!xs(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!xs(t)},{mark:"unobserved",text:"unobserved"},
{mark:"draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Yr},
{mark:"path",text:"path, as wide as the robot",when:({decisions:t})=>!!t.path,may:Yr}],Zl=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 % of a pl\
ace"}],Ql=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function Xl(t,e,n){return v("div",{className:"legend"},Sp(t,e,n),Mp(t))}
function Sp(t,e,n){let{session:o}=t,s=v("span",{className:"ramp"}),r=v("span",{className:"name"}),i=Jl.map(p=>{let[d,f]=vs(p),{mark:w,when:y}=p;return y&&t.visible(
d,()=>y(o)),w==="stroke"&&t.each(()=>L(f,"textContent",wo(n())?p.text:Yl)),w==="path"&&t.each(()=>d.firstElementChild?.classList.toggle("risky",o.decisions.path?.
within_risk===!1)),d}),[a,l]=[Zl,Ql].map(p=>p.map(d=>vs(d)[0]));for(let p of a)t.visible(p,()=>!!o.where.found);for(let p of l)t.visible(p,()=>!!o.evidence.cellShown);
let u="";return t.each(()=>{let{layer:p}=o;L(r,"textContent",ec(o,p));let d=p==="entropy"||p==="width",f=`${d} ${e().ground}`;u!==f&&(u=f,s.style.background=pr(
d?zn:w=>hr(e(),w)))}),v("ul",{"aria-label":"Legend"},v("li",{},r,v("span",{className:"scale"},"0",s,"1")),...i,Tp(t),...a,...l)}function Mp(t){let{session:e}=t,
n=["mean","draw","entropy","width"].map(u=>{let p=v("span");return t.each(()=>L(p,"textContent",ec(e,u))),u==="width"&&t.visible(p,()=>e.quantity.interval),p}),
o=Jl.map(u=>{let[p,d]=vs(u);u.mark==="stroke"&&(d.textContent=Yl);let{may:f}=u;return f&&t.visible(p,()=>f(e)),p}),s=v("span",{className:"scale"},"00.0",v("span",
{className:"ramp"}),"000.0 nats"),r=[Zl,Ql].map(u=>v("ul",{},...u.map(p=>vs(p)[0]))),i=[v("ul",{},v("li",{},"one more scan tells",s)),...r],a=v("li",{className:"\
either"},...i);t.visible(a,()=>Yr(e));let l=v("span",{className:"scale"},"0",v("span",{className:"ramp"}),"1");return v("ul",{className:"room","aria-hidden":"tr\
ue"},v("li",{},v("span",{className:"name either"},...n),l),...o,a)}function vs({mark:t,text:e}){let n=v("i",{className:t});t==="sensor"&&n.append(tn("sensor"));
let o=v("span",{textContent:e});return[v("li",{},n,o),o]}function ec({quantity:t},e){let{kind:n,mean:o,value:s}=t;return e==="entropy"?"entropy (bit)":e==="widt\
h"?"width of the 90 % interval":n==="binary"?"P(wall)":e==="draw"?s:o}function Tp(t){let{decisions:e}=t.session,n=v("span",{className:"ramp"});n.style.background=
pr(zn);let[o,s]=[v("span"),v("span")],r=v("li",{className:"views"},"one more scan tells",v("span",{className:"scale"},o,n,s));return t.visible(r,()=>e.looking&&
!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(L(o,"textContent",Me(Math.min(...i),1)),L(s,"textContent",`${Me(Math.max(...i),1)} nats`))}),
r}var Pp=[.05,.1,.2,.4,.8],Ep=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function tc(t){let{session:e}=t,n=v("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,u=Math.
max(l[0]-a[0],l[1]-a[1]),p=[...new Set([...Pp,r.resolution])].sort((d,f)=>d-f);if(o!==p.join()){o=p.join();let d=f=>v("option",{value:String(f),textContent:Ep(f),
disabled:u/f>Se.side_of_log-1});n.replaceChildren(...p.map(d))}L(n,"value",String(r.resolution))});let s=t.row("Cell size",n);return t.visible(s,()=>e.document?.
source.kind==="log"),s}function nc(t){let{session:e}=t,n=v("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),o=v("output"),s=()=>e.document?.source.
scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=s()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});let i=t.
section("Log",v("div",{className:"player bare"},n,o));return t.visible(i,()=>e.document?.source.kind==="log"&&s()>1),t.each(()=>{let a=s(),l=e.document?.scans_used??
a;L(n,"max",String(Math.max(1,a))),(!mn(n)||Number(n.value)!==l)&&L(n,"value",String(l));let u=l===a?`all ${a} scans`:`after ${l} of ${a}`;n.style.setProperty("\
--fill",`${100*(l-1)/Math.max(1,a-1)}%`),dt(n,"aria-valuetext",u),L(o,"textContent",u)}),i}var Ap=20,_p={importance:"particles",propagate:"rounds"},ks=({working:t,shown:e})=>t&&e?.method==="pilot";function oc(t,...e){let{session:n}=t,o=v("progress",{max:1,
value:0,"aria-label":"Progress"}),s=v("div",{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.
source.kind==="log"),l=ks(n),u=i?i.done/i.of:r&&!a&&r.total>0&&(l||!r.approximate)?r.sweeps/r.total:0;L(o,"value",u);let p=n.remaining_s(),d=_p[r?.method??""]??
"sweeps",f=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${d}`:"",w=p!==null?p<1?"less than 1 s left":`${Math.ceil(p)} s left`:n.running?"running":"",y=n.
sampling||n.running||!r||r.sweeps>=r.total?"":"stopped";i?L(s,"textContent",`${i.text}: ${i.done} of ${i.of} ${i.of>Ap?"scans":"rounds"}`):a?L(s,"textContent","\
Computing"):r&&l?L(s,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):L(s,"textContent",kn([f,w,f&&y].filter(Boolean).join(", "))||Cp(n))}),
t.section("Posterior",Lp(t),o,s,Dp(t),Np(t),...e)}function Cp({shown:t,working:e}){return t?.method==="counts"?"Run infers where the robot was":t?.method==="pil\
ot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function Lp(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"\
primary",text:"Run",title:"Run (R)",when:()=>e.connection.connected}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escap\
e)",when:()=>e.running||e.sampling||ks(e)}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chain"),r=v("div",
{className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function Dp(t){let{session:e}=t,n=v("dl"),o=(s,r,i,a=!1)=>{let l=v(
"dd",{textContent:"–"});n.append(v("div",{title:r},v("dt",{textContent:s}),l)),t.each(()=>{L(l,"textContent",e.shown?i(e.shown):"–"),a&&L(l,"className",e.shown?.
verdict?.level??"")})};return o("ESS","Effective sample size of the log joint",s=>Me(s.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",
s=>Me(s.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",s=>Me(s.log_joint,Math.abs(s.log_joint??0)<1e5?1:0)),o("reply","From the han\
d's last move to its picture",()=>Me(e.latency.eventToPaint_ms.at(-1),0," ms")),n}function Np(t){let{session:e}=t,n=v("div",{className:"verdict"});return t.each(
()=>{let o=e.shown?.verdict;if(L(n,"hidden",!o),!o)return;let s={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];L(n,"textContent",`${s}:\
 ${o.why}`),L(n,"className",`verdict ${o.level}`)}),n}var Rp="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",sc=200,
$p="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",rc="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",Fp="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function lc(t){let{session:e}=t,n=v("span",{className:"chip"}),o=t.button(null,"Not converged",()=>ic(
e)?.apply(),{text:"Not converged",className:"chip doubt"}),s=v("div",{className:"chips"},n,o);return t.each(()=>{let r=ic(e);L(o,"hidden",!r),r&&(L(o.firstElementChild,
"textContent",`not converged: ${r.text}`),L(o,"title",`${e.shown?.verdict?.why}. Click to ${r.text}.`),dt(o,"aria-label",`Not converged: ${r.text}`));let i=e.shown;
if(!i||!e.document)return L(s,"hidden",!0);let a=e.draws.count?`draw ${e.draw+1} of ${e.draws.count}`:"draw",l=i.layer==="draw"?a+(e.flicker.under?" over the me\
an":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="entropy"?"entropy":"mean";if(i.method==="counts"){L(s,"hidden",!1);let d=e.halfway?"along\
 poses found so far":"along raw odometry";return L(n,"textContent",`hits and passes · ${e.stage?e.stage.text.toLowerCase():d}`),L(n,"className","chip approxima\
te")}let u={importance:"importance sampling",propagate:"belief propagation"}[i.method],p=i.approximate?`approximate, ${Ip(i,e.working)}`:u??`${i.sweeps} sweeps`;
L(s,"hidden",!1),L(n,"textContent",`${l} · ${p}`),L(n,"className",i.approximate?"chip approximate":"chip")}),s}function Ip({method:t,sweeps:e,total:n,averaged:o},s){
return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${o===1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} \
of ${n}`}function ic(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n||t.recorded||n.source.kind==="run")return null;let o=i=>()=>t.act({type:"set",
patch:i}),s=e.sweeps<sc;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!s)return{text:"try blocks",apply:o({method:"block"})};if(e.method==="importance")return{
text:"try Gibbs",apply:o({method:"auto"})};if(e.sweeps<e.total)return null;let r=Math.min(Se.sweeps[1],Math.max(sc,4*n.sweeps));return r>n.sweeps?{text:`try ${r}\
 sweeps`,apply:o({sweeps:r})}:null}function cc(t){let{session:e}=t,n=v("span"),o=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),
s=v("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.
retryIn_ms??0)/1e3));L(s,"hidden",!r&&e.worker!=="restarted"),L(s,"className",r?"banner":"banner mild"),L(o,"hidden",!r);let a=`Connection lost. Trying again in\
 ${i} s; the map is kept here.`,l=e.connection.refused?Rp:a;L(n,"textContent",r?l:"The worker stopped and is being started again. The map is kept.")}),s}function uc(t){
let{session:e,hand:n}=t,o=v("div",{className:"readout",id:`${t.prefix}-readout`}),s=v("span",{role:"status","aria-live":"polite"}),r=v("span",{className:"hidden",
"aria-live":"polite"});return n.announce=i=>L(r,"textContent",i),n.describe=i=>ac(e,i),t.each(()=>{let{kind:i}=e.quantity;L(o,"title",i==="binary"?$p:i==="surfa\
ce"?`${rc}. ${Fp}`:rc);let a=n.cursor??n.hover,u=matchMedia("(pointer: coarse)").matches?"Touch a cell":e.editable?"Point at a cell, or press ? for the keys":"P\
oint at a cell";L(o,"textContent",a?ac(e,a):u);let p=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad",d=e.status.text==="Ready"&&ks(e);L(s,"textContent",
p?"Ready, but the chains have not converged":d?"Fitting the sensor":e.status.text),L(s,"className",p?"warning":d?"busy":e.status.level)}),{element:v("footer",{},
s,o,r),readout:o}}function ac(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+
1),{x:l,y:u}=Gn(e,n.grid),p=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${u.toFixed(a)} m`];if(o&&o.p.length===r[0]*r[1]){let d=o.p[i]/255,{kind:f,mean:w,value:y,interval:k}=t.
quantity;o.layer==="width"?p.push(`90 % interval ${d.toFixed(2)} wide`):f!=="binary"&&o.layer==="draw"?p.push(`${y} ${d.toFixed(2)} in this draw`):f!=="binary"?
p.push(`${w} ${d.toFixed(2)}`,...k?[]:[`entropy ${bo(d).toFixed(2)} bit`]):o.layer==="draw"?p.push(d>.5?"wall in this draw":"free in this draw"):p.push(`P(wall)\
 ${d.toFixed(2)}`,`entropy ${bo(d).toFixed(2)} bit`);let M=t.evidence.facts,T=M?.x===e.x&&M.y===e.y?M:null,S=T?T.beams:null;if(o.observed[i]?S!==null&&p.push(S===
1?"1 beam":`${S} beams`):p.push("unobserved"),o.observed[i]&&T?.nats_for!==void 0&&T.nats_against!==void 0&&S){let E={binary:"a wall",surface:"its surface"}[t.quantity.
kind]??"what is there";p.push(`for ${E} ${T.beams_for}, ${T.nats_for.toFixed(1)} nats`,`against ${T.beams_against}, ${T.nats_against.toFixed(1)} nats`)}}return p.
join(" · ")}var Op={logged:"as logged",odometry:"from raw odometry"},Up=180/Math.PI;function dc(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
Op,()=>e.document?.poses??"logged",d=>t.set({poses:d}));o.classList.add("wide"),t.visible(o,n);let[s,r]=Se.pose_sigma,[i,a]=Se.heading_sigma_deg,l=[t.slider("po\
se_sigma",()=>"Position ±",{low:s,high:r,step:.05,unit:" m"}),t.slider("heading_sigma",()=>"Yaw ±",{low:i,high:a,step:.5,unit:"°",scale:Up})];for(let d of l)
t.visible(d,()=>e.editable);let u=v("p",{className:"caption"});t.each(()=>{let{pose_sigma:d=0,heading_sigma:f=0,method:w="auto"}=e.document??{},y=n()&&e.document?.
poses==="odometry"&&e.shown?.method==="counts"&&!e.running,k=e.editable&&(d>0||f>0)&&!/auto|gibbs|block/.test(w);L(u,"hidden",!k&&!y),L(u,"textContent",y?"Run i\
nfers where the robot was.":"This method takes poses as known; Gibbs does not.")});let p=t.section("Where the robot was",o,...l,u);return t.visible(p,()=>e.editable||
n()&&!e.recorded),p}var Ss=t=>Math.abs(t)<.995?`${Me(100*Math.abs(t),1)} cm`:`${Me(Math.abs(t),2)} m`,Gp="Point at a reading to compare it with what the posterior predicts of it.",
Wp=": preparing the comparison. The first one after an installation takes some seconds.";function hc(t){let{session:e}=t,n=v("p",{className:"words reading",role:"\
status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i,
slow:a}=e.reading,l=s?`Beam ${s.beam+1} of scan ${s.scan+1}${a?Wp:"."}`:Gp;L(n,"textContent",i||(r?zp(r):l))}),o}function zp({scan:t,beam:e,reading:n,range:o,low:s,
median:r,high:i,residual:a,no_return:l,wall:u}){let p=`Beam ${e+1} of scan ${t+1}`,d=(T,S)=>T===null?S:`${Me(T,2)} m`,f=`median ${d(r,"no return")}, 80 % betwee\
n ${d(s,"too close")} and ${d(i,"no return")}`;if(n==="none")return`${p} came back from nothing, which was predicted with probability ${Me(l??0,3)} (${f}).`;if(n!==
"hit"||o===null)return`${p} read nothing that says how far (${f}).`;let w=a===null?"":`, ${Ss(a)} ${a<0?"shorter":"longer"} than the predicted median`,y=`${p} r\
ead ${Me(o,2)} m${w} (${f}).`;if(!u)return y;let k=`${Ss(u.across_m)} ${u.across_m<0?"behind":"in front of"} the wall, which is ${Ss(u.thickness_m)} thick`,M=`${Ss(
u.along_m)} to the ${u.along_m<0?"right":"left"} along it from the middle of its surface`;return`${y} It ended ${k} (one standard deviation), and ${M}; the beam\
 met it at ${Me(u.incidence_rad*180/Math.PI,0)}° from its normal.`}var Hp={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Vp={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},Bp={noisy:"with noise",exact:"exact"},jp={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},Kp={raster:"raster",radial:"radial",random:"random"},Ms=2*Math.PI,qp=t=>Math.round(t*1800/Math.PI)/10,Yp={importance:"Particles",propagate:"Round\
s"};function pc(t){let{session:e,hand:n,editor:o}=t,s=v("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let d=e.document?.sensors??[],f=d.map(w=>w.id).join();f!==r&&s.replaceChildren(...d.map(({id:w})=>v("option",{value:String(
w),textContent:`Sensor ${w}`}))),r=f,L(s,"value",String(n.sensor?.id??""))});let i=(d,f)=>t.numberInput(d,()=>Number((n.sensor?.[f]??0).toFixed(2)),w=>n.sensor&&
o.moveSensor(n.sensor,{[f]:w}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),d=>n.sensor&&o.moveSensor(n.sensor,{yaw:d%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),u=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.document?.fov??Ms)<Ms);let p=v("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),
a);return t.section("Sensors",v("div",{className:"buttons"},s,l,u),p)}function fc(t){let{session:e}=t,[n,o]=Se.max_range,[s,r]=Se.fov_deg,i=t.numberInput("Longe\
st range (m)",()=>e.document?.max_range??0,d=>t.set({max_range:d}),{min:n,max:o,step:"any"}),a=[t.slider("noise",()=>"Noise (m)",{low:Se.noise[0],high:Se.noise[1],
step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{low:Se.angles[0],high:Se.angles[1],step:1,log:!0}),i,t.numberInput("Field of view (°)",()=>qp(e.document?.
fov??Ms),d=>t.set({fov:d>=r?Ms:d*Math.PI/180}),{min:s,max:r,step:5}),t.select("Readings",Bp,()=>e.document?.readings??"noisy",d=>t.set({readings:d}))];for(let d of a)
t.visible(d,()=>e.editable);let l=t.slider("prior",()=>"Prior P(wall)",{low:Se.prior[0],high:Se.prior[1],step:.01}),u=()=>(e.document?.cells??"binary")==="binar\
y";t.visible(l,u);let p=t.select("Cells",Vp,()=>e.document?.cells??"binary",d=>t.set({cells:d}));return t.visible(p,()=>e.document?.source.kind==="log"),t.section(
"Model",p,tc(t),l,...a)}function mc(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>(e.document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.
test(n()),[r,i]=Se.seed,a=[t.select("Method",Hp,n,l=>t.set({method:l})),t.select("Order",Kp,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||
n()==="auto"),t.select("Start",jp,()=>e.document?.start??"auto",l=>t.set({start:l}),s)];for(let l of a)t.visible(l,o);return t.section("Inference",...a,t.slider(
"sweeps",()=>Yp[n()]??"Sweeps",{low:Se.sweeps[0],high:Se.sweeps[1],step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{
min:r,max:i,step:1}))}function gc(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),
o=t.button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",v("d\
iv",{className:"buttons"},n,o))}var Jp=0,Ts=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${Jp++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}visible(e,n){this.each(()=>L(e,"hidden",!n()))}button(e,n,o,{
className:s="",text:r="",when:i,title:a}={}){let l=v("button",{type:"button",className:s,title:a??n,onclick:o},e&&tn(e));return r&&l.append(v("span",{textContent:r})),
r!==n&&l.setAttribute("aria-label",n),i&&this.each(()=>L(l,"disabled",!i())),l}segmented(e,n,o,s,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=v("div",{className:"\
segmented",role:"radiogroup","aria-label":e});for(let[l,u,p]of n){let d=v("input",{type:"radio",name:i,value:l,onchange:()=>s(l)});a.append(v("label",{title:u},
d,p?tn(p):null,v("span",{textContent:u}))),this.each(()=>{L(d,"checked",o()===l),r&&L(d,"disabled",!r(l))})}return a}section(e,...n){let o=`${this.prefix}-${e.replace(
/\W/g,"")}`;return v("section",{"aria-labelledby":o},v("h2",{id:o,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,v("div",{className:"\
row"},v("label",{for:n.id,textContent:e}),n)}slider(e,n,{low:o,high:s,step:r,log:i=!1,unit:a="",scale:l=1}){let u=`${this.prefix}-${e}`,p=M=>i?1e3*Math.log(M/o)/
Math.log(s/o):M,d=M=>{if(!i)return M;let T=o*(s/o)**(M/1e3),S=T<100?1:10**(Math.floor(Math.log10(T))-1);return ne(Math.round(T/S)*S,o,s)},f=()=>l===1?this.session.
document?.[e]??o:Number(((this.session.document?.[e]??o/l)*l).toFixed(3)),w=v("label",{for:u}),y=v("input",{type:"range",id:u,...i?{min:0,max:1e3,step:1}:{min:o,
max:s,step:r}}),k=v("input",{type:"number",min:String(o),max:String(s),step:String(r)});return y.addEventListener("input",()=>this.set({[e]:d(Number(y.value))/l})),
y.addEventListener("change",()=>this.endDrag()),k.addEventListener("change",()=>{this.typed(k,n(),[o,s],f,M=>this.set({[e]:i?Math.round(M):M/l})),this.endDrag()}),
this.each(()=>{let M=f();L(w,"textContent",n()),dt(k,"aria-label",`${n()}, number`),d(Number(y.value))!==M&&(y.value=String(p(M))),dt(y,"aria-valuetext",`${M}${a}`);
let T=100*(p(M)-Number(y.min))/(Number(y.max)-Number(y.min));y.style.setProperty("--fill",`${ne(T,0,100)}%`),mn(k)||L(k,"value",String(M))}),v("div",{className:"\
row slider"},w,y,k)}select(e,n,o,s,r){let i=v("select",{onchange:()=>s(i.value)});for(let[a,l]of Object.entries(n))i.append(v("option",{value:a,textContent:l}));
return this.each(()=>{L(i,"value",o()),r&&L(i,"disabled",!r())}),this.row(e,i)}typed(e,n,[o,s],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(
ne(a,o,s)),e.value=String(r()),a<o?this.session.say(`${n} is at least ${o}`,"warning"):a>s&&this.session.say(`${n} is at most ${s}`,"warning")}numberInput(e,n,o,s={}){
let r=v("input",{type:"number",...s}),{min:i=-1/0,max:a=1/0}=s;return r.addEventListener("change",()=>this.typed(r,e,[i,a],n,o)),this.each(()=>{mn(r)||L(r,"valu\
e",String(n()))}),this.row(e,r)}checkbox(e,n,o,s=""){let r=v("input",{type:"checkbox",onchange:()=>o(r.checked)});return this.each(()=>L(r,"checked",n())),v("la\
bel",{className:"check",title:s},r,v("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,s=v("button",{type:"button",className:"\
plain","aria-label":"Close",onclick:()=>i.close()},tn("close")),r=v("div",{className:"title"},v("h2",{id:o,textContent:e}),s),i=v("dialog",{"aria-labelledby":o},
r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),i}};var Zp=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Qp={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},Ps=class{constructor(e){
this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.before=
null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,
draw:e})}play(e){let{draw:n,draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,e&&s.wantsMean?this.session.act({type:"view",layer:"mean",chain:this.
session.view.chain}):e&&this.showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?0:n),this.session.changed()}over(e){let{flicker:n,view:o}=this.session;
n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.chain})):o.layer!=="draw"&&this.showLayer("draw"):(this.afterMean=!1,
this.before&&this.before!==o.layer&&this.showLayer(this.before)),this.before=e?o.layer:null,this.session.changed()}playFromStart(){this.showDraw(0),this.playing=
!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)return this.afterMean=
!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:o,draws:s}=this.session;o+1>=s.count&&n.on?
this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function yc(t,e,n,o){let{session:s}=t,r=t.segmented("Show",Zp,()=>s.view.
layer,w=>e.showLayer(w),w=>w!=="draw"||s.hasDraws),[,,i,a]=Array.from(r.children);L(a,"title","Width of each cell's 90 % interval"),t.visible(i,()=>!s.quantity.
interval),t.visible(a,()=>s.quantity.interval);let l=(w,y)=>t.checkbox(w,()=>n[y],k=>{n[y]=k,s.changed()}),u=l("True walls","truth");t.visible(u,()=>!s.document||
s.document.source.kind==="simulation");let[p,d]=[l("Surfaces","strokes"),l("Trajectory","trajectory")];t.visible(p,()=>!!s.overlay?.strokes.length),t.each(()=>L(
p.lastElementChild,"textContent",wo(o())?"Surfaces":"Surfaces (zoom in)")),t.visible(d,()=>!!s.overlay?.trajectory.length);let f=v("div",{className:"checks",role:"\
group","aria-label":"Marks"},u,l("Rays","rays"),l("Readings","readings"),p,d);return t.section("View",r,Xp(t,e),f)}function Xp(t,e){let{session:n}=t,o=v("input",
{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the\
 draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1}),r=v("output"),i=v("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,
Number(i.value))),t.each(()=>{let{chains:d,count:f}=n.draws;L(o,"max",String(Math.max(0,f-1))),L(o,"disabled",f===0),L(o,"value",String(n.draw));let w=f?`${n.draw+
1} of ${f}`:"none kept";dt(o,"aria-valuetext",w),o.style.setProperty("--fill",`${f>1?100*n.draw/(f-1):0}%`),L(r,"textContent",w),i.length!==Math.max(1,d)&&i.replaceChildren(
...Array.from({length:Math.max(1,d)},(k,M)=>v("option",{value:String(M),textContent:`chain ${M+1}`}))),L(i,"value",String(n.view.chain)),L(i,"disabled",d<2),f<2&&
e.playing&&e.play(!1);let y=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";s.getAttribute("aria-label")!==y&&(s.setAttribute("aria-lab\
el",y),s.replaceChildren(tn(e.playing?"pause":"play")))});let a=v("select",{"aria-label":"Speed"});for(let[d,f]of Object.entries(Qp))a.append(v("option",{value:d,
textContent:f}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(null,"From the first sweep",()=>e.
playFromStart(),{text:"From the first",when:()=>n.draws.count>1});t.each(()=>L(a,"disabled",n.draws.count<2||n.flicker.still));let u=t.checkbox("Draws over the \
mean",()=>n.flicker.on,d=>e.over(d),"Each draw in its own colour over the mean, as one of the maps that the scans leave possible");t.visible(u,()=>n.draws.count>
1);let p=v("div",{className:"wide"},u);return v("div",{className:"player"},s,o,r,v("div",{className:"buttons wide"},i,a,l),p)}function bc(t){let{session:e}=t,n=v(
"input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=v("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.
section("Scan",v("div",{className:"player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;L(s,"hidden",
r<2),L(n,"max",String(Math.max(0,r-1))),mn(n)||L(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),L(o,
"textContent",`${Number(n.value)+1} / ${r}`)}),s}var xc=2,wc=6,ef=.5,tf=.005;function vc(t){let{session:e,hand:n}=t,o=v("p",{className:"whereabouts",role:"status"}),s=v("p",{className:"caption"}),r=t.section("\
Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),L(o,"textContent",nf(t)),L(s,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function nf({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>ef?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>tf?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${o}${of(e.modes)}${sf(e,t.editable)}${s}`}function of(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>xc,o=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${Jr(e.mean[2],0)}`,s=`known to ${Zr(e.sigma_m)} and ${Jr(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${Zr(e.sigma_m)} apart.`:`One place: ${o}, ${s}.`;let r=t.slice(0,wc).map(({probability:a})=>gr(a)),i=t.length>wc?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${o}, ${s}.`}function sf({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>xc)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the l\
ikeliest":`the ${rf(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${Zr(o[s])} and ${Jr(r,1)} from ${i}.`}var rf=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,Jr=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,Zr=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function kc(t,e,n){let{shown:o,status:s}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:o&&{generation:o.generation,layer:t.layer,approximate:o.
approximate,sweeps:o.sweeps,method:o.method,quantity:t.quantity,rhat:o.rhat,verdict:o.verdict,trace:o.trace,traced:o.traced,weights:o.weights,ess:o.ess,chain:o.
chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{
text:s.text,level:s.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:lf(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&af(t.evidence.each)},over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.
strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??
0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var af=t=>Object.fromEntries(Object.entries(t).
map(([e,n])=>[e,Array.from(n)]));function lf({ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.
near&&{...o.near}}}}var Sc="bayesmap-token",Qr="bayesmap-kept";function cf(t){try{return localStorage.getItem(t)}catch{return null}}function Xr(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function ei(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Xr(Qr,JSON.stringify(t))}function Mc(){
Xr(Qr,null)}function Tc(){let t=cf(Qr);try{return t&&JSON.parse(t)}catch{return null}}function Pc(t){t&&Xr(Sc,t)}function Ec(t){let e=n=>{n.key===Sc&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var ti=new Set(["walls","sensor","set","view","live"]),Ac=({type:t,op:e})=>t==="sensor"?e!=="move":!ti.has(t),_c="Not while the connection is lost: this needs t\
he server";function Cc(t,e){let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*s+i]=e.wall?1:0;else if(e.type==="set"){let{
resolution:r,...i}=e.patch;Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??
t.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let r=n.sensors.find(i=>i.id===e.id);r&&Object.assign(r,{x:e.x,y:e.y,yaw:e.yaw})}}var uf=t=>kn(`${t.replace(/^(plan|path|explore): /,"")}.`),Es=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.
session.changed())}forget(){this.start=this.goal=this.path=this.views=null,this.askedPath=this.askedViews="",this.version++}ask(){let{session:e,start:n,goal:o,radius:s,
risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&
!i.approximate&&l!==this.askedPath&&(this.askedPath=l,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.
method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let o=e.type==="undecided"?uf(e.text):"";e.of==="views"||e.type===
"views"?this.viewTrouble=o:this.trouble=o,e.type==="path"&&(this.path=e),e.type==="views"&&this.looking&&(this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}),
e.type==="undecided"&&e.of==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<
n.nats.length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,s]=[r,i])}return o}};var As=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=Ot(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:o}=e;
if(!this.held||!n||!o||o.generation!==e.generation||e.recorded)return;let s=`${o.generation} ${e.sampling} ${o.approximate} ${n.x} ${n.y}`;s!==this.asked&&(this.
asked=s,e.act({type:"inspect",x:n.x,y:n.y,each:!0}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.
each=n.nats?n:null,this.version++)}};var df="(prefers-reduced-motion: reduce)",_s=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(df).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var hf=2e3,pf=3e3,ff=2,Cs=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&pn(e,n.document.
grid);(!o||!Ot(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
e.recorded||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>hf&&(this.waiting=0),this.waiting>=ff)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>pf;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:u}=n,p=e.near&&{...e.near,pose:a,ranges:l,hit:u},{x:d,y:f,yaw:w,generation:y,draws:k,coarse:M,milliseconds:T}=e;this.fan={x:d,y:f,yaw:w,generation:y,draws:k,
coarse:M,milliseconds:T,angles:o,low:s,median:r,high:i,near:p},this.answers++}else this.fan=null;this.version++,this.ask()}};var Ls=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var Ds=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Ns=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.
kind!=="simulation"&&!o.recorded,r=e&&s&&o.scan?mf(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),o.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){let n=e;e.type==="undecided"?this.trouble=e.text:n.beam===this.picked?.
beam&&n.scan===this.picked.scan&&(this.found=n),this.version++}};function mf({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)return null;let l={x:e[0],
y:e[1]},[u,p]=[-1,1/0];for(let d=0;d<n.length;d++){let[f,w]=[Math.cos(e[2]+n[d]),Math.sin(e[2]+n[d])],[y,k]=[r.x-l.x,r.y-l.y],M=y*f+k*w,T=s[d]?o[d]:a,S=s[d]?Math.
hypot(y-T*f,k-T*w):1/0,E=M>0&&M<T?Math.abs(y*w-k*f):1/0,A=Math.min(S,i/2+2*E);A<p&&([u,p]=[d,A])}return p<i?{scan:t,beam:u,from:l,angle:e[2]+n[u]}:null}var Rs=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble??"";let{pose:o,weight:s}=n,{modes:r=[]}=e,i=r.filter(({probability:a},l)=>l===0||a>=.005);this.found=this.trouble?null:
{...e,modes:i,cloud:o,weight:s},this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||e.recorded||e.worker!=="ready"||e.editable&&n.generation!==e.
generation)return;let s=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.
asked||this.waitingSince&&i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:
{type:"where"}))}};var Lc=new Set(["inspect","path","views","where","ghost","beam"]),$s=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";recorded=!1;generation=-1;acted=0;decisions=new Es(
this);evidence=new As(this);where=new Rs(this);ghost=new Cs(this);reading=new Ns(this);flicker=new _s(this);status=new ws;progress=new Ds;latency=new Ls;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,
text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get running(){
return this.connection.connected&&!!this.state?.running}get working(){return this.connection.connected&&!!this.state?.working}get layer(){let e=this.shown?.layer;
return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entropy":"mean"}get stage(){return this.running&&this.shown?.method==="counts"?this.lastStage:null}get halfway(){
return this.lastStage?.generation===this.shown?.generation}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&
!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.
shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,
n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&this.everConnected&&!Lc.has(e.type)&&Ac(e))return this.
say(_c,"warning");let o={...e,seq:++this.seq};Lc.has(e.type)||(this.acted=this.seq),ti.has(e.type)&&(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(
o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&ei(this.portableDocument()),this.changed()}bring(e){this.act(e?{type:"hello",document:e}:
{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.wallsVersion&&(this.packed={version:this.wallsVersion,text:Oo(
$i(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.effectiveDocument();return e&&(e.source.kind==="simulat\
ion"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.flicker.take(this.shown),!0)}painted(){this.counts.
paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.send({type:"painted",generation:e}),this.reported=
e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.quantity??{kind:"binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){
return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){if(this.connection=e,e.connected){let n=this.everConnected?this.portableDocument():
this.adopt;this.pending=[],this.latency.forget(),this.bring(n),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?
this.say("Connected again"):this.notice&&this.say(this.notice.text,this.notice.level),this.everConnected=!0}else this.everConnected&&(this.say("Connection lost",
"error"),ei(this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"welcome":this.generation=this.reported=-1,this.recorded=!!e.recorded,this.
latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":if(e.generation>=this.generation){let{pose:o,angles:s,ranges:r,exact:i,hit:a}=n;
this.scan?.index!==e.index&&this.reading.forget(),this.scan={ids:e.ids??[],index:e.index??null,pose:o,angles:s,ranges:r,exact:i,hit:a}}break;case"overlay":this.
overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(e,n);break;case"cell":this.evidence.receive(
e,n);break;case"path":case"views":case"ghost":case"beam":case"undecided":this.receiveAnswer(e,n);break;case"status":this.status.say(e.text,e.level??"info",this.
acted);break;case"error":this.receiveError(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"download":this.ondownload(e.name,e.mime,
n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveAnswer(e,n){let o=e.type==="undecided"?e.of:e.type;o==="ghost"?this.ghost.
receive(e,n):o==="beam"?this.reading.receive(e):this.decisions.receive(e,n)}receiveError(e){let n=e.refused?.seq??null,o=n!==null&&n===this.broughtAt;o&&(this.broughtAt=
null,this.act({type:"hello"}));let s=[e.text,e.remedy].filter(Boolean).join("; ");this.status.say(o?`The map that was brought along cannot be shown: ${s}`:s,"er\
ror",this.acted),this.pending=this.pending.filter(r=>r.seq!==n),n!==null&&this.latency.refused(n),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.
state=e,e.document.source.kind==="simulation"&&(this.overlay=null,Mc()),this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,
e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.counts.stale++;return}this.generation=
e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,a=n.observed,l=this.next??this.shown,p=l&&l.p.length===o.length&&l.bits.every((d,f)=>d===a[f])?{observed:l.
observed,bits:l.bits}:{observed:yo(a,o.length),bits:a};this.next={...e,p:o,trace:s,traced:r,weights:i,...p},this.progress.hear(this.next)}rebuild(){if(!this.state)
return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==s.text||s.walls.length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:yo(
Vt(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==s||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),
this.wallsVersion++,this.wallsAhead=!1),this.state.view&&!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r??
"mean",chain:i??0,draw:a??null}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Cc(this,e),e.type==="walls"&&(this.wallsVersion++,
this.wallsAhead=!0))}};var Dc='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Nc=`:host { display: block; height: 100dvh; container-type: size; }
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
.legend .for { height: 0; border-top: 3px solid var(--ray); }
.legend .against { height: 0; border-top: 3px solid var(--truth); }
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
.spoken { margin: 4px 0 0; padding-left: 22px; font-size: 13px; line-height: 1.5; font-variant-numeric: tabular-nums; }
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
@container (max-width: 1360px) { .bar .segmented label { padding: 0 8px; gap: 4px; } .bar .segmented svg { width: 16px; } }
@container (max-width: 1260px) { .bar .segmented label:not(:has(:checked)) span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); } }
@container (max-width: 900px) {
  .bar .segmented label span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); }
  .bar .segmented label { padding: 0 7px; }
}
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
@container (max-width: 450px) { .bar .segmented label { padding: 0 9px; } }
@container (max-width: 380px) and (max-height: 700px) { .legend li:not(:first-child) { display: none; } }
@container (max-width: 380px) { .bar .segmented label { padding: 0 5px; } .buttons { flex-wrap: wrap; } }
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
`;var $c="bayesmap-theme",Rc={auto:"light",light:"dark",dark:"auto"},Fs=class{constructor(e,n){this.app=e;this.dressed=n;let o=bf();o&&o in Rc&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=Zo.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?Zo.dark:Zo.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:u,ghost:p,belief:d}=n;for(let[f,w]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:l,draw:u,ghost:p,belief:d}))this.
app.style.setProperty(`--${f}`,w);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Rc[this.choice];try{localStorage.setItem($c,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function bf(){try{return localStorage.getItem($c)}catch{return null}}function Is(t,e,{embedded:n=!1,adopt:o=null,notice:s=null}={}){let r=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(Dc+Nc),r.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,l=()=>{a||=requestAnimationFrame(me)},u=new $s(e,l,o,s);e.open();let p=new Wn,d=new Ho(u),f=new zo(u,d),w=new Ps(
u),y=new Ts(u,d,f,ot,K=>w.showLayer(K),n),k=[new Vn,new jn,new Yn,new qn,new ts,new Qo,new Kn,new Hn,new Jn,new Bn,new Yo],M=k.map(({name:K})=>v("canvas",{className:K})),
T=M[M.length-1];Object.assign(T,{tabIndex:0,role:"application"});let S=new Ko(k,M);new qo(T,u,p,d,f,n);let E=new jo(T,u,p,d,f),A={truth:!0,rays:!0,readings:!0,strokes:!0,
trajectory:!0},J=ql(y),N=ua(y),Z={chip:lc(y),banner:cc(y)},B=v("main",{className:"stage"},...M,Z.chip,Z.banner),q=()=>G.theme,R=()=>p.transform.scale,_=Xl(y,q,R),
j=uc(y);T.setAttribute("aria-describedby",j.readout.id);let I=Vl(y),V={help:zl(y),new:Hl(y),share:I.dialog},[W,Y,z,je]=[pc(y),fc(y),mc(y),gc(y)],be=[Wl(y),vc(y),
Kl(y),Bl(y),nc(y),oc(y,Ul(y,q),Gl(y,q)),bc(y),hc(y),yc(y,w,A,R),W,Y,dc(y),z,je],re=v("aside",{"aria-label":"Controls"},...be),le=()=>u.recorded||u.document?.source.
kind==="run";y.visible(W,()=>u.editable),y.visible(Y,()=>!le()),y.visible(z,()=>!le()),y.visible(je,()=>!le()),y.each(()=>{L(N,"inert",!u.document),L(re,"inert",
!u.document)});let ee=v("div",{className:"app"},J.element,N,B,_,re,j.element,...Object.values(V));r.replaceChildren(ee);let G=new Fs(ee,K=>{J.nameTheme(K),l()}),
_e=()=>{let K=u.editable&&d.tool==="sensor"?d.sensor?.id??null:null;return{session:u,view:p,look:{theme:G.theme,...A,hover:d.hover,cursor:d.cursor,selected:K}}},
Ue="";function me(){a=0;let K=u.take();u.document&&String(u.shape)!==Ue&&(Ue=String(u.shape),p.fit(u.shape),d.cursor=d.hover=null,u.decisions.forget(),u.evidence.
forget(),u.ghost.refit(),T.setAttribute("aria-label",`Map, ${u.shape[0]} by ${u.shape[1]} cells`)),S.paint(_e()),K&&(u.painted(),w.step());let{x:ie,y:Ke}=p.transform;
Z.chip.style.transform=`translate(${Math.max(ie,Je.left)}px, ${Math.max(Ke-28,6)}px)`,dt(T,"data-tool",u.editable||At.has(d.tool)?d.tool:"pan"),y.refresh()}let ae=new ResizeObserver(
()=>{let{width:K,height:ie}=B.getBoundingClientRect();!K||!ie||(p.resize(K,ie,devicePixelRatio||1),p.fitted&&p.fit(u.shape),cancelAnimationFrame(a),me())});ae.observe(
B);async function ot(K){if(K==="in"||K==="out")p.zoom(K==="in"?1.4:1/1.4,p.middle,u.shape);else if(K==="fit")p.fit(u.shape);else if(K==="help")V.help.showModal();else if(K===
"new")V.new.showModal();else if(K==="theme")G.next();else if(K==="add")E.addSensor();else if(K==="share"){let ie=u.portableDocument();ie&&I.show(location.origin+
location.pathname+await Oi(ie))}else if(K==="export png"){let ie=await la(_e());ie&&yr("bayesmap.png",ie),u.say("Saved bayesmap.png")}else K.startsWith("export ")&&
u.act({type:"export",what:K.slice(7)});l()}u.ondownload=(K,ie,Ke)=>yr(K,new Blob([Ke],{type:ie}));let mt=[[n?t:window,"keydown",K=>{K.defaultPrevented||!u.document||
Object.values(V).some(ie=>ie.open)||Yi(K,u,{tool:ie=>{d.choose(ie),E.focus()},layer:ie=>w.showLayer(ie),command:ot})}],[window,"online",()=>e.retry?.()],[window,
"hashchange",async()=>{if(n)return;let{document:K,damaged:ie}=await Wo();K?u.bring(K):ie&&u.say(Go,"error")}]];for(let[K,ie,Ke]of mt)K.addEventListener(ie,Ke);return G.
dress(),{destroy(){ae.disconnect(),cancelAnimationFrame(a),G.destroy();for(let[K,ie,Ke]of mt)K.removeEventListener(ie,Ke);e.close(),r.replaceChildren()},snapshot:()=>kc(
u,p,S),cellToClient(K,ie){let Ke=T.getBoundingClientRect(),Wt=p.fromGrid({x:K+.5,y:ie+.5},u.shape[1]);return{x:Ke.left+Wt.x,y:Ke.top+Wt.y}}}}var ni={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},Fc=8,ao=()=>({onmessage:()=>{},onstatus:()=>{}});function Ic(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers){let l=a.reduce((u,p)=>u*p,1)*ni[i].BYTES_PER_ELEMENT;
o[r]=new ni[i](t.slice(s,s+l)),s+=Math.ceil(l/Fc)*Fc}return[n,o]}function Oc(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{let{buffer:i,byteOffset:a,
byteLength:l}=e[r];n[o]=new ni[s](i.slice(a,a+l))}),n}function Uc(t){let{document:e,scans:n,settings:o={},log_joint:s=[]}=t,r=e.grid.shape[0]*e.grid.shape[1],i=t.draws?.count??0,a=e.source.kind!=="simulation",l=Vt(
t.mean),u=Vt(t.observed),p=null,d=0,f={layer:"mean",chain:0,draw:null},w=R=>a?[R[d]]:R,y=R=>Float32Array.from(w(R).flat(),Gc),k=R=>Array.isArray(n.angles[R])?n.
angles[R]:n.angles,M=[0];n.pose.forEach((R,_)=>M.push(M[_]+k(_).length));let T=yo(Vt(n.hit),M[n.pose.length]),S=()=>a?T.subarray(M[d],M[d+1]):T,E=Float32Array.from(
s.flat()),A=(o.sweeps??i)/Math.max(1,i),J=Float32Array.from(s[0]??[],(R,_)=>(_+1)*A),N=R=>{let _={chains:t.draws?.chains??0,count:p?i:0},j={generation:1,can_undo:!1,
can_redo:!1,live:!1,running:!1,working:!1};q.onmessage({type:"state",document:e,seq:R,...j,draws:_,view:f},{})},Z=()=>{let R=Float64Array.from(w(n.pose).flat(),
Number),_={type:"scan",generation:1,ids:a?[d]:n.ids,index:a?d:null},j=n.exact?.length?y(n.exact):new Float32Array(0);q.onmessage(_,{pose:R,angles:Float32Array.from(
k(d)),ranges:y(n.ranges),exact:j,hit:S()})},B=()=>{let R=f.layer==="draw"&&p?wf(p,f.chain*i+(f.draw??i-1),r):null,_=s[f.chain]?.[(f.layer==="draw"?f.draw:null)??
i-1]??null,j=R?{...f,draw:f.draw??i-1}:{layer:f.layer==="draw"?"mean":f.layer},I=o.sweeps??i,V={quantity:o.quantity,sweeps:I,total:I,ess:o.ess,rhat:o.rhat,verdict:o.
verdict,log_joint:_},W=o.method??e.method,Y={p:R??l,observed:u,trace:E,traced:J};q.onmessage({type:"field",generation:1,...j,method:W,approximate:!1,...V},Y)},q={
...ao(),open:()=>q.onstatus({connected:!0}),send:R=>{if(R.type==="hello"){if(q.onmessage({type:"welcome",version:1,recorded:!0},{}),N(R.seq),Z(),B(),!i||!t.draws)
return;Uo(Vt(t.draws.data)).then(_=>{p=_,N(R.seq)})}else if(R.type==="view")f={layer:R.layer,chain:R.chain??f.chain,draw:R.draw??null},N(R.seq),B();else if(R.type===
"scan")d=R.index,N(R.seq),Z();else if(R.type==="inspect"){let _=xf(e,w(n.pose).map((j,I)=>k(a?d:I)),w(n.pose),w(n.ranges),R.x,R.y);q.onmessage({type:"cell",x:R.
x,y:R.y,beams:_},{})}},close:()=>{}};return q}var Gc=t=>t===null?1/0:Number(t);function wf(t,e,n){let o=e*n;return Uint8Array.from({length:n},(s,r)=>t[o+r>>3]>>
7-(o+r&7)&1?255:0)}function xf({grid:t},e,n,o,s,r){let{origin:i,resolution:a}=t,l=[i[0]+s*a,i[1]+r*a],u=0;return n.forEach((p,d)=>{let[f,w,y]=p.map(Number);e[d].
forEach((k,M)=>{let[T,S]=[Math.cos(k+y),Math.sin(k+y)],E=[(l[0]-f)/T,(l[0]+a-f)/T,(l[1]-w)/S,(l[1]+a-w)/S],A=Math.max(0,Math.min(E[0],E[1]),Math.min(E[2],E[3])),
J=Math.min(Gc(o[d][M]),Math.max(E[0],E[1]),Math.max(E[2],E[3]));A<J&&u++})}),u}var oi=250,vf=8e3;function Wc(t){let e=null,n=oi,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),u=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{u=!0,n=oi,i.onstatus({connected:!0})},l.onmessage=({data:p})=>{typeof p==
"string"?i.onmessage(JSON.parse(p),{}):i.onmessage(...Ic(p))},l.onclose=()=>{if(s||e!==l)return;o=window.setTimeout(r,n);let p={connected:!1,retryIn_ms:n};i.onstatus(
p),u||kf(t()).then(d=>d&&e===l&&i.onstatus({...p,refused:d})),n=Math.min(vf,2*n)}}let i={...ao(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=oi,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};return i}async function kf(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function zc(t){let e=(o,s=[])=>n.onmessage(o,Oc(o,s)),n={...ao(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var Sf="This is the map that was drawn here when the connection was lost; undo leads back",si=t=>Object.assign(window,{bayesmap:t}),q0={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=Is(n,zc(t),{embedded:!0});return si(o),()=>o.destroy()}};async function Mf(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){si(Is(t,Uc(JSON.parse(n.textContent??""))));return}Pc(new URLSearchParams(location.search).get("token"));let{document:o,damaged:s}=await Wo(),
r=o?null:Tc(),i=Wc(()=>new URL(location.href));Ec(l=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(l)}${location.hash}`),i.retry?.()}),
si(Is(t,i,{adopt:o??r,notice:s?{text:Go,level:"error"}:r?{text:Sf,level:"info"}:null}))}Mf();export{q0 as default,Is as mount,Uc as recordedTransport,Wc as webSocketTransport,zc as widgetTransport};
