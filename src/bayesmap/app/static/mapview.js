// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function go(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Pi(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Wt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Io(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Ei(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Oo=t=>Ei(t,new DecompressionStream("deflate-raw")),_i=t=>Ei(t,new CompressionStream("deflate-r\
aw"));async function Ci(t){let e=await _i(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Io(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Qc(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Oo(Wt(e[1]))))}var Uo="The link's map cannot be read: copy the link again, who\
le";async function Go(){let t=await Qc(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var se=(t,e,n)=>Math.min(n,Math.max(e,t)),Yt=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,De=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),tr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function pn(t,e){let{x:n,y:o}=De(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Un=(t,e)=>tr({x:t.x+.5,y:t.y+.5},e);
function Ai(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Li(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&s(r-1,i)!==s(r,i);l&&a<0&&(a=i),!l&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&s(i,r-1)!==s(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var yo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Di(t,e,n){let o=Ni(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Fi(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Ri(t,e){
let n=Xc(e,t.grid.shape),o=Ni(t);return Fi(t,(s,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let l of o)a=Math.min(a,Math.hypot(s-l.x,r-l.y));return a>0?a:-1/0})}
var Ni=({sensors:t,grid:e})=>t.map(n=>pn(n,e));function Fi(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let l=e(i,a,i*o+a);
l>r&&([s,r]=[{x:i,y:a},l])}return s&&Un(s,t.grid)}function Xc(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)o[r*n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),
s(r+1,i-1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var Se={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],fov_deg:[5,360],pose_sigma:[0,2],heading_sigma_deg:[0,30],sweeps:[1,
1e5],seed:[0,2147483647],side_of_log:1e3};var Wo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Yt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(u=>pn(u,r.grid)):[],l=new Map;for(let u of e)!Yt(u,i)||this.isWall(u)===n||a.some(h=>h.x===
u.x&&h.y===u.y)||l.set(u.x*i[1]+u.y,[u.x,u.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"sensor",op:"move",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?Ri(o,n.walls):"world"in e?e.world:Di(o,n.walls,e.near);s?o.sensors.length>=Se.sensors?n.say(`There can be ${Se.sensors}\
 sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"sensor",op:"add",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=Math.
max(0,...o.sensors.map(r=>r.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sen\
sor",op:"remove",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=pn(e,n.document.grid),s=this.isWall(o);return!s&&Yt(o,n.shape)?(n.status.
text.startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Et=new Set(["pan","path","look","where","ghost"]),eu=120,zo=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.ghost.hold(e==="ghost"),this.session.changed()}select(e){this.selected=e,this.
session.changed()}point(e){let n=e&&Yt(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){
!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.
act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},eu))}};var Ye={left:36,right:12,top:34,bottom:26},tu=60,nu=160,Gn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-Ye.left-Ye.right,y:this.height-Ye.
top-Ye.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:Ye.left+(o.x-
s*e)/2,y:Ye.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n])}zoom(e,n,o){let{scale:s}=this.transform,{x:r,y:i}=this.corner,a=se(s*e,Math.min(this.width,this.height)/
Math.max(...o)/3,nu),l=a/s;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.
y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;
return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=tu;this.corner.x=se(this.corner.x,s-e*o,this.width-s),this.corner.y=se(this.corner.y,
s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};function Ho(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,l]=r.pose.
subarray(3*s,3*s+3),u=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m would\
 tell ${u}`)}var Ui=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W, O","where am I, ghost","asked"],["arrows","move the cursor, th\
e sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["Space","at the cursor: start or goal \
of a path, or where to look from","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, Delete","add, remove a sensor","drawn"],["R, Escape","run, ca\
ncel","inferred"],["M, N, H","show the mean, a draw, the entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","asked"],["+, −, 0","zoom in, out, whole map"],
["?","this help"]],ou={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},$i=Math.PI/12,Vo=class{constructor(e,n,o,s,r){this.canvas=e;this.session=
n;this.view=o;this.hand=s;this.editor=r;e.addEventListener("keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.
pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)
return;let r=ou[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?$i:
-$i;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.
toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)s.removeSensor();else if(e.key==="Escape"&&o.cursor)
o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is \
room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&o.ghost.pose&&o.document){let{resolution:l}=o.document.grid,{x:u,y:h}=o.ghost.
pose;o.ghost.move({x:u+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&r.sensor&&o.document&&o.editable){let{resolution:l}=o.document.grid;r.selected=
r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let l=r.
cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},u={x:se(l.x+e,0,i-1),y:se(l.y+n,0,a-1)};r.setCursor(u);let h=s.fromGrid({x:u.x+.5,y:u.y+.5},a),p=(w,y,k)=>w-se(w,y,
k),f={x:p(h.x,Ye.left+10,s.width-20),y:p(h.y,20,s.height-Ye.bottom-10)};(f.x||f.y)&&s.pan(-f.x,-f.y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if((o.
tool==="path"||o.tool==="look")&&n.document){o.cursor?Ho(n,o,s,Un(o.cursor,n.document.grid)):this.arrow(0,0);return}if(n.editable){if(o.tool==="sensor"||o.tool===
"where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,r.length)]?.id??null),o.selected!==null&&o.announce(`Se\
nsor ${o.selected}`)}else if(!Et.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.announce(
i?"wall":"free")}}}},nr={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost"},Ii={m:"mean",n:"draw",h:"entropy"},Oi={"+":"in","=":"in","\
-":"out",0:"fit","?":"help"};function Gi(t,e,n){let o=t.composedPath()[0],s=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.
type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"\
redo":"undo"});return}if(!(s||t.altKey)){if(nr[r]&&(e.editable||Et.has(nr[r])&&!e.recorded))n.tool(nr[r]);else if(Ii[r])n.layer(r==="h"&&e.quantity.interval?"wi\
dth":Ii[r]);else if(Oi[t.key])n.command(Oi[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&(e.running||e.working))e.act({type:"\
cancel"});else return;t.preventDefault()}}var Bo=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:u,context:h,layer:p}=l,f=p.shows?.(e)??!0,w=[f,...f?[...a,...p.depends(e)]:[]];w.length===
l.before.length&&w.every((y,k)=>Object.is(y,l.before[k]))||(l.before=w,u.style.visibility=f?"":"hidden",f&&((u.width!==i.width||u.height!==i.height)&&(Object.assign(
u,i),u.style.width=`${i.width/s}px`,u.style.height=`${i.height/s}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,u.width,u.height),h.setTransform(s,0,0,s,0,0),
h.save(),p.paint(h,e),h.restore(),this.paints[p.name]++))}}};function je(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,o*r,s*r),t.clip()}function bo(t,{halo:e},n,o){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}var or='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Jt(t,e,n,o,s,r,i=!1){t.font=or,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}function sr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Zt(t,e,n){let o=n.fromGrid(De(t,e),e.shape[1]),s=se(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function Wi(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=sr(e);t.lineJoin=
"round";for(let a of i){let l=Zt(a,s.grid,n),{point:u,size:h}=l;a.id===o.selected&&su(t,l,o);let[p,f]=[Math.cos(a.yaw),-Math.sin(a.yaw)],w=(y,k)=>[u.x+h*(y*p-k*
f),u.y+h*(y*f+k*p)];t.beginPath(),t.moveTo(...w(1.25,0)),t.lineTo(...w(-.9,.8)),t.lineTo(...w(-.45,0)),t.lineTo(...w(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Jt(t,String(a.id),u.x,u.y+h*2+4,r,"center",!0)}}function su(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),bo(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function zi(t,e,n,o,s){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&Zt({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Hi(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var Vi={touch:24,other:11},ru=5,iu=90,jo=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(l,u)=>e.
addEventListener(l,u,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return tr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(zi(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&(o.tool==="path"||o.tool===
"look"))return this.begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(
i.id),this.begin(i);if(e.button===1||Et.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="se\
nsor"&&o.select(a.id);else if(o.tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"s\
ensor",id:o.sensor.id,drag:o.nextGesture(),grip:{x:0,y:0}}),this.dragSensor(e));else{let l=o.tool==="draw"!==(e.button===2||e.shiftKey),u=this.cellAt(r),h=l&&this.
editor.isWall(u);this.begin({kind:"stroke",id:o.nextGesture(),wall:l,last:u,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),
iu)}}gripAt(e,n,o){let{hand:s,view:r}=this,i=this.reach(n),a=f=>Math.hypot(e.x-f.x,e.y-f.y),l=s.tool==="sensor"&&s.sensor?Zt(s.sensor,o.grid,r):null;if(l&&s.sensor&&
a(l.handle)<Math.min(i,a(l.point)))return{kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let u=o.sensors.map(f=>({
id:f.id,...Zt(f,o.grid,r)}));u.sort((f,w)=>a(f.point)-a(w.point));let h=u.find(({point:f,size:w})=>a(f)<Math.max(i,w));if(!h)return null;let p={x:h.point.x-e.x,
y:h.point.y-e.y};return{kind:"sensor",id:h.id,drag:s.nextGesture(),grip:p}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.
held;this.gesture.held=null,this.stroke([this.gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&
this.fingers.set(e.pointerId,i),!n)r.point(this.cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();
let a=[],l=e.getCoalescedEvents?.()??[];for(let u of l.length?l:[e]){let h=this.cellAt(this.at(u));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(...Ai(
n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(u=>u.id===
n.id);if(!a||!o.document)return;let l=this.metres(i,o.document);this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.
hypot(i.x-n.first.x,i.y-n.first.y)>ru&&this.begin({kind:"pan",last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.
fingers.size===2){let{middle:a,spread:l}=this.spread();s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(l/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:l}),
o.changed()}}up(e){e.type==="pointerup"&&this.release(),e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.
last],!1,this.gesture.id,e),e.type==="pointerup"&&this.gesture?.kind==="pick"&&this.session.document&&Ho(this.session,this.hand,this.editor,this.metres(this.gesture.
first,this.session.document)),this.fingers.delete(e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=
e.pointerType==="touch",this.touched&&(this.hand.point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?Vi.touch:Vi.other}pointAtReading(e){
let{document:n,reading:o,ghost:s}=this.session;if(!n||s.held)return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(
e)*r)}dragGhost(e){let{gesture:n,session:o}=this;if(n?.kind!=="ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);Hi(o.ghost,n,this.metres({x:s.x+
n.grip.x,y:s.y+n.grip.y},o.document))}spread(){let[e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-
n.x,e.y-n.y))}}wheel(e){if(!this.session.document)return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();
let o=e.deltaMode===1?16:1;e.shiftKey?this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.
at(e),this.session.shape),this.session.changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level===
"error"&&o.say("Ready"))}dragSensor(e){let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(
l=>l.id===n.id),i=this.at(e),a=this.metres({x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var au=5,Ko=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(Ye.left,0,o.width,o.height-Ye.bottom),e.clip(),s.hover&&Bi(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&Bi(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function Bi(t,e,n,o,s,r,i){let{scale:a}=o.transform,l=o.fromGrid({x:e.x,y:e.y+1},n),u=Math.max(a,au),[h,p]=[l.x-(u-a)/2,l.y-(u-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(h,p,u,u),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,p,u,u)}var lu={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},cu={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},Yo={light:lu,dark:cu},ji="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function uu([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((l,u)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*s[u]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let u=se(l,0,1);return Math.round(255*(u<=.0031308?12.92*u:1.055*u**(1/2.4)-.055))})}var qo=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),rr=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),ir=(t,e)=>uu(rr(t.paper,t.ink,e));function Wn(t){let e=Math.min(15,Math.floor(
t*16));return rr(qo(ji,6*e),qo(ji,6*e+6),t*16-e)}function Ki(t,e){let n=new Uint8ClampedArray(2048).fill(255),[o,s]=[qo(t.unobserved),qo(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?yo(r/255):r/255;n.set(e==="value"?ir(t,r/255):Wn(i),4*r),n.set(rr(o,s,e==="value"?r/255:0),4*(r+256))}return new Uint32Array(n.buffer)}
var ar=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var du=9,pu=2.5,zn=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start||e.looking&&e.views))}paint(e,n){let{session:o}=n;o.document&&(je(e,n),o.decisions.looking&&this.views(e,n),this.path(e,n))}views(e,{session:n,
view:o,look:s}){let{views:r}=n.decisions,i=n.document?.grid;if(!r?.nats.length||!i)return;let[a,l]=[Math.min(...r.nats),Math.max(...r.nats)],u=se(.38*r.spacing*
o.transform.scale/i.resolution,pu,du),h=r.nats.indexOf(l);for(let p=0;p<r.nats.length;p++){let f=o.fromGrid(De({x:r.pose[3*p],y:r.pose[3*p+1]},i),i.shape[1]);e.
beginPath(),e.arc(f.x,f.y,u,0,2*Math.PI),e.fillStyle=`rgb(${Wn(se((r.nats[p]-a)/Math.max(l-a,1e-9),0,1)).map(Math.round)})`,e.fill(),p===h&&(e.lineWidth=2.5,e.strokeStyle=
s.theme.truth,e.stroke())}}path(e,{session:n,view:o,look:s}){let{start:r,goal:i,path:a,radius:l}=n.decisions,u=n.document?.grid;if(!u||!r)return;let h=p=>o.fromGrid(
De(p,u),u.shape[1]);if(a){e.beginPath();for(let[p,f]of a.path){let w=h({x:p,y:f});e.lineTo(w.x,w.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=a.within_risk?s.theme.
sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*l*o.transform.scale/u.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let p of i?[r,i]:[r]){
let{x:f,y:w}=h(p);e.beginPath(),e.arc(f,w,5,0,2*Math.PI),e.fillStyle=p===r?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}}};var hu=10,fu=7,mu=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Jo=()=>document.createElement("canvas").getContext("2d"),Hn=class{name="\
field";cells=Jo();mask=Jo();hatch=Jo();palettes=new Map;image=new ImageData(1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.
flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:l,x:u,y:h}=s.transform;je(e,n);let p=o.flicker.under??o.shown;if(!p||p.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
u,h,i*l,a*l);return}this.fill(p,i,a,r.theme,mu(p,o.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,u,h,i*l,a*l),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),l>=hu&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:l}=this,
u=`${s.ground} ${r}`;if(l.field===e&&l.palette===u)return;let h=this.palettes.get(u)??Ki(s,r);if(this.palettes.set(u,h),this.image.width!==n||this.image.height!==
o){this.image=new ImageData(n,o);for(let{canvas:f}of[i,a])Object.assign(f,{width:n,height:o});l.bits=null}let p=new Uint32Array(this.image.data.buffer);for(let f=0,
w=0;f<o;f++)for(let y=o-1-f;y<n*o;y+=o)p[w++]=h[e.p[y]+(e.observed[y]?0:256)];if(i.putImageData(this.image,0,0),l.bits!==e.bits){for(let f=0,w=0;f<o;f++)for(let y=o-
1-f;y<n*o;y+=o)p[w++]=e.observed[y]?0:4278190080;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,bits:e.bits,palette:u})}fillHatch({session:e,
view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:l,height:u}=n,{scale:h,x:p,y:f}=n.transform,[w,y]=e.shape,k=[o.theme.ground,h,p,f,l,u,a].join(" ");
if(i.hatch===k)return;i.hatch=k;let S=Jo(),P=S.canvas.width=S.canvas.height=Math.round(fu*a);S.strokeStyle=o.theme.hatch,S.lineWidth=a,S.beginPath();for(let _ of[
-P,0,P])S.moveTo(_-1,P+1),S.lineTo(_+P+1,-1);S.stroke(),Object.assign(s.canvas,{width:Math.ceil(l*a),height:Math.ceil(u*a)}),s.setTransform(a,0,0,a,0,0),s.imageSmoothingEnabled=
!1,s.drawImage(r.canvas,p,f,w*h,y*h),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let M=s.createPattern(S.canvas,"repeat");M.setTransform(
new DOMMatrix().translate(Math.round(p*a),Math.round(f*a))),s.fillStyle=M,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,view:o,look:s}){let[
r,i]=n.shape,{scale:a,x:l,y:u}=o.transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,u),e.lineTo(l+h*a,u+i*a);for(let h=1;h<i;h++)e.moveTo(l,u+h*a),e.lineTo(
l+r*a,u+h*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var gu=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],Vn=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(je(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(l,u)=>{let h=se(r[u],0,a),p=o.yaw+l,f={x:o.x+h*Math.cos(p),y:o.y+h*Math.sin(p)};return n.fromGrid(De(f,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(y=>this.ends(n,o,o.angles,y)),{grid:l}=n.session.document,u=n.view.fromGrid(De(o,l),l.shape[1]),h=new Path2D;
h.moveTo(u.x,u.y);for(let{x:y,y:k}of r)h.lineTo(y,k);h.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(h);let p=new Path2D,f=new Path2D,w=se(n.view.transform.
scale*.12,1.2,3);for(let y=0;y<r.length;y++)p.moveTo(r[y].x,r[y].y),p.lineTo(a[y].x,a[y].y),Number.isFinite(o.median[y])&&f.rect(i[y].x-w,i[y].y-w,2*w,2*w);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=se(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(p),e.globalAlpha=1,f}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,l=se(n.view.transform.scale*.14,1.5,4),u=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),h=new Path2D;u.forEach(({x:p,y:f},w)=>{i[w]&&
(h.moveTo(p+l,f),h.arc(p,f,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:l,handle:u}=Zt({id:0,...r},i,o),[h,p]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(u.x,u.y),bo(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[f,w]of gu)e.lineTo(a.x+l*(f*h-w*p),a.y+l*(f*p+w*h));e.closePath(),e.lineJoin="round",bo(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(u.x,u.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var Bn=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:o,view:s,look:r}=n,i=o.flicker.under&&o.shown;if(!i)return;let[a,l]=o.shape,
{scale:u,x:h,y:p}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),je(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,p,a*u,l*u)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(u=>parseInt(s.slice(u,u+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let l=new ImageData(
n,o);for(let u=0,h=0;u<o;u++)for(let p=o-1-u;p<n*o;p+=o,h+=4)l.data.set([r,i,a,e.observed[p]?e.p[p]:0],h);this.cells.putImageData(l,0,0),this.drawn={field:e,colour:s}}};var yu=46;function bu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function qi(t,{session:e,view:n,look:o}){if(!e.document)return;
let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:l,shape:u}=e.document.grid,{scale:h,x:p,y:f}=n.transform,w=bu(yu/h*l),y=Math.min(f+u[1]*h,i-Ye.bottom)+
.5,k=Math.max(p,Ye.left)-.5;t.fillStyle=s.ground,p<k&&t.fillRect(0,0,k,i+1),f+u[1]*h>y&&t.fillRect(0,y,r+1,i+1-y);let S=Math.max(0,-Math.floor(Math.log10(w)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let P=_=>Math.ceil(a[_]/w-1e-9)*w,M=_=>a[_]+u[_]*l+1e-9;for(let _=P(0);_<=M(0);_+=w){let E=p+(_-a[0])/l*h;E<k||
E>r-4||(t.moveTo(E,y),t.lineTo(E,y+4),Jt(t,_.toFixed(S),E,y+12,s,"center"))}for(let _=P(1);_<=M(1);_+=w){let E=f+(u[1]-(_-a[1])/l)*h;E>y||E<4||(t.moveTo(k,E),t.
lineTo(k-4,E),Jt(t,_.toFixed(S),k-7,E,s,"right"))}t.stroke(),Jt(t,"m",k-7,y+12,s,"right")}var jn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=sr(e).flatMap(({id:i,x:a,y:l,yaw:u})=>[i,a,l,u]),{grid:s}=e.document??{},
r=Yi(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:u,y:h}=s.transform;r.truth&&Yi(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(u-.5,h-.5,i*l+1,a*l+1),Wi(e,n),qi(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:l}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=Li(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),je(e,n),e.transform(i,0,0,-i,a,l+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=se(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},Yi=({document:t})=>t?.source.kind==="simulation";var wu=600,vu=1500,xu=65536,lr=.3,Kn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;if(!i||!a)return;
je(e,n);let{scale:l}=s.transform,u=1/a.grid.resolution,h=a.grid.shape[1],p=i.angles.length,f=i.pose.length/3,w=Math.ceil(p*f/vu),[y,k,S]=[new Path2D,new Path2D,
new Path2D],P=p*f>wu,M=new Map,_=se(l*.1,1.3,4),E=a.scans_used??1/0,K=(i.index??0)<E?1:lr;for(let R=0;R<f;R++){let[q,V,N]=i.pose.subarray(3*R,3*R+3),G=s.fromGrid(
De({x:q,y:V},a.grid),h);for(let A=0;A<p;A++){let Z=i.ranges[R*p+A],I=i.hit[R*p+A]===1,j=(I?Z:a.max_range)*u*l,W=i.angles[A]+N,Q={x:G.x+j*Math.cos(W),y:G.y-j*Math.
sin(W)},z=I?y:k;(R*p+A)%w===0&&(z.moveTo(G.x,G.y),z.lineTo(Q.x,Q.y)),I&&(P?M.set(Math.round(Q.x)*xu+Math.round(Q.y),Q):(S.moveTo(Q.x+_,Q.y),S.arc(Q.x,Q.y,_,0,2*
Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=K*se(28/Math.sqrt(p*f/w)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(y),e.strokeStyle=r.theme.noReturn,e.stroke(
k),e.globalAlpha=1),r.readings){e.globalAlpha=K,e.fillStyle=r.theme.ray,e.fill(S);let R=1.8*_;for(let{x:q,y:V}of M.values())e.fillRect(q-R/2,V-R/2,R,R);e.globalAlpha=
1}}};var ku=2.5,qn=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(je(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&n.view.transform.scale>=ku&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[u,h,p]of[[0,l,.6],
[Math.max(0,l-1),a,.6*lr]]){e.beginPath();for(let f=u;f<h;f++){let w=o.fromGrid(De({x:r[2*f],y:r[2*f+1]},i),i.shape[1]);e.lineTo(w.x,w.y)}e.globalAlpha=p,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,u,h,p]=r.subarray(a,a+4),[f,
w]=[o.fromGrid(De({x:l,y:u},i),i.shape[1]),o.fromGrid(De({x:h,y:p},i),i.shape[1])];e.moveTo(f.x,f.y),e.lineTo(w.x,w.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=se(o.transform.scale/5,.8,2.5),e.stroke()}}};var Su=2.2,Zo=7,[Mu,Tu]=[.03,.75],Pu=2.4477,Ji=9,Yn=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!(!s||!r)){je(e,n),this.
cloud(e,n,r);for(let i of s.modes)this.place(e,n,r,i,s.modes.length>1)}}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||
1;e.strokeStyle=e.fillStyle=s.theme.belief,e.lineWidth=1.2;for(let u=0;u<a.length;u++){if(a[u]<Mu**2*l)continue;let[h,p,f]=i.subarray(3*u,3*u+3),w=o.fromGrid(De(
{x:h,y:p},r),r.shape[1]);e.globalAlpha=Tu*Math.sqrt(a[u]/l),e.beginPath(),e.arc(w.x,w.y,Su,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(w.x,w.y),e.lineTo(w.x+Zo*
Math.cos(f),w.y-Zo*Math.sin(f)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:o},s,r,i){let[a,l,u]=r.mean,h=n.fromGrid(De({x:a,y:l},s),s.shape[1]),p=Pu*n.transform.
scale/s.resolution,[[f,w],[,y]]=r.covariance,[k,S]=[(f+y)/2,Math.hypot((f-y)/2,w)],[P,M]=[k+S,k-S].map(E=>Math.max(Ji,p*Math.sqrt(Math.max(E,0))));e.beginPath(),
e.ellipse(h.x,h.y,P,M,-Math.atan2(2*w,f-y)/2,0,2*Math.PI);let _=Ji+1;e.moveTo(h.x+_*Math.cos(u),h.y-_*Math.sin(u)),e.lineTo(h.x+(_+Zo)*Math.cos(u),h.y-(_+Zo)*Math.
sin(u)),e.strokeStyle=o.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i&&Jt(e,cr(r.probability),h.x,h.y-M-9,o.theme,
"center",!0)}},cr=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var Zi=900,wo=2;function Qi({session:t,look:e}){let[n,o]=t.shape,s=new Gn;s.resize(Zi,Math.round(se(Zi*o/n,300,1800)),wo),s.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:s.width*wo,height:s.height*wo});let i=r.getContext("2d");i.scale(wo,wo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);
let a=[new Hn,new Bn,new qn,new Kn,new jn,new zn,new Yn,new Vn],l={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let u of a)(u.shows?.(
l)??!0)&&(i.save(),u.paint(i,l),i.restore());return new Promise(u=>r.toBlob(u))}var Qo=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:l,document:u}=o;if(!i||!u||l?.index!==
i.scan)return;je(e,n);let{grid:h,max_range:p}=u,f=S=>{let P={x:i.from.x+S*Math.cos(i.angle),y:i.from.y+S*Math.sin(i.angle)};return s.fromGrid(De(P,h),h.shape[1])},
w=(S,P,M,_)=>{e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(P.x,P.y),e.lineWidth=M,e.strokeStyle=_,e.stroke()},y=l.hit[i.beam]===1,k=f(y?l.ranges[i.beam]:p);if(w(f(0),
k,3,r.theme.halo),w(f(0),k,1.5,y?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let S=(P,M)=>se(P??M,0,p);if(w(f(S(a.low,0)),f(S(a.high,p)),6,r.theme.ghost),
a.median!==null){let P=f(a.median),M={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};w({x:P.x-M.x,y:P.y-M.y},{x:P.x+M.x,y:P.y+M.y},2.5,r.theme.ghost)}}y&&(e.beginPath(),
e.arc(k.x,k.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};function x(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function L(t,e,n){t[e]!==n&&(t[e]=n)}function dt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var hn=t=>t.getRootNode().activeElement===t,Me=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function ur(t,e){let n=URL.
createObjectURL(e);x("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Xi=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["path","Path","path"],["look","Look next","look"],["w\
here","Where am I?","where"],["ghost","Ghost","ghost"]];function ea(t){let{hand:e,session:n}=t,o=t.segmented("Tool",Xi,()=>n.editable||!n.document||Et.has(e.tool)?
e.tool:"pan",s=>e.choose(s),s=>n.editable||Et.has(s)&&!n.recorded||s==="pan");return t.visible(o,()=>!n.recorded),Xi.forEach(([s],r)=>{Et.has(s)||t.visible(o.children[r],
()=>!n.document||n.editable)}),x("div",{className:"bar"},o,x("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),
t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Eu="uplot",_u="u-hz",Cu="u-vt",Au="u-title",Lu="u-wrap",Du="u-under",Ru="u-over",Nu="u-axis",gn="u-off",Fu="u-select",$u="u-cursor-x",Iu="u-cursor-y",Ou="u-\
cursor-pt",Uu="u-legend",Gu="u-live",Wu="u-inline",zu="u-series",Hu="u-marker",ta="u-label",Vu="u-value",xo="width",ko="height";var na="bottom",Jn="left",dr="right",_r="#000",oa=_r+"0",pr="mousemove",sa="mousedown",hr="mouseup",ra="mouseenter",ia="mouseleave",aa="dblclick",Bu="resize",ju="\
scroll",la="change",os="dppxchange",Cr="--",oo=typeof window<"u",br=oo?document:null,Qn=oo?window:null,Ku=oo?navigator:null,pe,Xo;function wr(){let t=devicePixelRatio;
pe!=t&&(pe=t,Xo&&xr(la,Xo,wr),Xo=matchMedia(`(min-resolution: ${pe-.001}dppx) and (max-resolution: ${pe+.001}dppx)`),yn(la,Xo,wr),Qn.dispatchEvent(new CustomEvent(
os)))}function pt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function vr(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Te(t,e,n){
t.style[e]=n+"px"}function _t(t,e,n,o){let s=br.createElement(t);return e!=null&&pt(s,e),n?.insertBefore(s,o),s}function xt(t,e){return _t("div",t,e)}var ca=new WeakMap;
function It(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=ca.get(t);r!=i&&(t.style.transform=r,ca.set(t,r),e<0||n<0||e>o||n>s?pt(t,gn):vr(t,gn))}var ua=new WeakMap;
function da(t,e,n){let o=e+n,s=ua.get(t);o!=s&&(ua.set(t,o),t.style.background=e,t.style.borderColor=n)}var pa=new WeakMap;function ha(t,e,n,o){let s=e+""+n,r=pa.
get(t);s!=r&&(pa.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Ar={passive:!0},qu={...Ar,
capture:!0};function yn(t,e,n,o){e.addEventListener(t,n,o?qu:Ar)}function xr(t,e,n,o){e.removeEventListener(t,n,Ar)}oo&&wr();function Ct(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:ht((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function Wa(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var za=t=>t!=null,Ha=t=>t!=null&&t>0,is=Wa(za),Yu=Wa(Ha);function Ju(t,e,n,o=0,s=!1){
let r=s?Yu:is,i=s?Ha:za;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(o==1)a=t[e],l=t[n];else if(o==-1)a=t[n],l=t[e];else for(let u=e;u<=n;u++){let h=t[u];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??ye,l??-ye]}function as(t,e,n,o){let s=ga(t),r=ga(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?zt:Va,a=s==1?ht:kt,l=r==1?kt:ht,
u=a(i(Ie(t))),h=l(i(Ie(e))),p=Xn(n,u),f=Xn(n,h);return n==10&&(u<0&&(p=be(p,-u)),h<0&&(f=be(f,-h))),o||n==2?(t=p*s,e=f*r):(t=qa(t,p),e=ls(e,f)),[t,e]}function Lr(t,e,n,o){
let s=as(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Dr=.1,fa={mode:3,pad:Dr},Mo={pad:0,soft:null,mode:0},Zu={min:Mo,max:Mo};function ss(t,e,n,o){return cs(
n)?ma(t,e,n):(Mo.pad=n,Mo.soft=o?0:null,Mo.mode=o?3:0,ma(t,e,Zu))}function ce(t,e){return t??e}function Qu(t,e,n){for(e=ce(e,0),n=ce(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function ma(t,e,n){let o=n.min,s=n.max,r=ce(o.pad,0),i=ce(s.pad,0),a=ce(o.hard,-ye),l=ce(s.hard,ye),u=ce(o.soft,ye),h=ce(s.soft,-ye),
p=ce(o.mode,0),f=ce(s.mode,0),w=e-t,y=zt(w),k=nt(Ie(t),Ie(e)),S=zt(k),P=Ie(S-y);(w<1e-24||P>10)&&(w=0,(t==0||e==0)&&(w=1e-24,p==2&&u!=ye&&(r=0),f==2&&h!=-ye&&(i=
0)));let M=w||k||1e3,_=zt(M),E=Xn(10,ht(_)),K=M*(w==0?t==0?.1:1:r),R=be(qa(t-K,E/10),24),q=t>=u&&(p==1||p==3&&R<=u||p==2&&R>=u)?u:ye,V=nt(a,R<q&&t>=q?q:At(q,R)),
N=M*(w==0?e==0?.1:1:i),G=be(ls(e+N,E/10),24),A=e<=h&&(f==1||f==3&&G>=h||f==2&&G<=h)?h:-ye,Z=At(l,G>A&&e<=A?A:nt(A,G));return V==Z&&V==0&&(Z=100),[V,Z]}var Xu=new Intl.
NumberFormat(oo?Ku.language:"en-US"),Rr=t=>Xu.format(t),ft=Math,ns=ft.PI,Ie=ft.abs,ht=ft.floor,$e=ft.round,kt=ft.ceil,At=ft.min,nt=ft.max,Xn=ft.pow,ga=ft.sign,zt=ft.
log10,Va=ft.log2,ed=(t,e=1)=>ft.sinh(t)*e,fr=(t,e=1)=>ft.asinh(t/e),ye=1/0;function ya(t){return(zt((t^t>>31)-(t>>31))|0)+1}function kr(t,e,n){return At(nt(t,e),
n)}function Ba(t){return typeof t=="function"}function ie(t){return Ba(t)?t:()=>t}var td=()=>{},ja=t=>t,Ka=(t,e)=>e,nd=t=>null,ba=t=>!0,wa=(t,e)=>t==e,od=/\.\d*?(?=9{6,}|0{6,})/gm,
bn=t=>{if(Ja(t)||Xt.has(t))return t;let e=`${t}`,n=e.match(od);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${bn(
s)}e${r}`}return be(t,o)};function fn(t,e){return bn(be(bn(t/e))*e)}function ls(t,e){return bn(kt(bn(t/e))*e)}function qa(t,e){return bn(ht(bn(t/e))*e)}function be(t,e=0){
if(Ja(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return $e(o)/n}var Xt=new Map;function Ya(t){return((""+t).split(".")[1]||"").length}function Po(t,e,n,o){
let s=[],r=o.map(Ya);for(let i=e;i<n;i++){let a=Ie(i),l=be(Xn(t,i),a);for(let u=0;u<o.length;u++){let h=t==10?+`${o[u]}e${i}`:o[u]*l,p=(i>=0?0:a)+(i>=r[u]?0:r[u]),
f=t==10?h:be(h,p);s.push(f),Xt.set(f,p)}}return s}var To={},Nr=[],eo=[null,null],Qt=Array.isArray,Ja=Number.isInteger,sd=t=>t===void 0;function va(t){return typeof t==
"string"}function cs(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function rd(t){return t!=null&&typeof t=="object"}var id=Object.getPrototypeOf(
Uint8Array),Za="__proto__";function to(t,e=cs){let n;if(Qt(t)){let o=t.find(s=>s!=null);if(Qt(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=to(t[s],
e)}else n=t.slice()}else if(t instanceof id)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Za&&(n[o]=to(t[o],e))}else n=t;return n}function Re(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=Za&&(cs(t[s])?Re(t[s],to(o[s])):t[s]=to(o[s]))}return t}var ad=0,ld=1,cd=2;function ud(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function dd(t,e){if(fd(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return md(i[0])||(i=hd(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],u=l.length;for(let h=0;h<
u;h++)n.add(l[h])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let u=1;u<a.length;u++){let h=a[u],p=Array(s).fill(void 0),f=e?e[i][u]:ld,w=[];for(let y=0;y<h.length;y++){let k=h[y],S=r.get(l[y]);k===null?f!=ad&&(p[S]=k,
f==cd&&w.push(S)):p[S]=k}ud(p,w,s),o.push(p)}}return o}var pd=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function hd(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[o[l]];s.push(a)}return s}function fd(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function md(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=nt(1,ht((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var Qa=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Xa=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function el(t){
return t.slice(0,3)}var gd=Xa.map(el),yd=Qa.map(el),bd={MMMM:Qa,MMM:yd,WWWW:Xa,WWW:gd};function vo(t){return(t<10?"0":"")+t}function wd(t){return(t<10?"00":t<100?
"0":"")+t}var vd={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>vo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>vo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>vo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>vo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>vo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>wd(t.getMilliseconds())};function Fr(t,e){e=e||bd;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?vd[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var xd=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function kd(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==xd?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var tl=t=>t%1==0,rs=[1,2,2.5,5],Sd=Po(10,-32,0,rs),nl=Po(10,0,32,rs),Md=nl.filter(
tl),mn=Sd.concat(nl),$r=`
`,ol="{YYYY}",xa=$r+ol,sl="{M}/{D}",So=$r+sl,es=So+"/{YY}",rl="{aa}",Td="{h}:{mm}",Zn=Td+rl,ka=$r+Zn,Sa=":{ss}",he=null;function il(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,l=(t==1?Po(10,0,3,rs).filter(tl):Po(10,-3,0,rs)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),u=[[i,ol,he,he,he,he,he,he,1],[s*28,"{MMM}",xa,he,he,he,he,he,1],[s,sl,xa,he,
he,he,he,he,1],[o,"{h}"+rl,es,he,So,he,he,he,1],[n,Zn,es,he,So,he,he,he,1],[e,Sa,es+" "+Zn,he,So+" "+Zn,he,ka,he,1],[t,Sa+".{fff}",es+" "+Zn,he,So+" "+Zn,he,ka,
he,1]];function h(p){return(f,w,y,k,S,P)=>{let M=[],_=S>=i,E=S>=r&&S<i,K=p(y),R=be(K*t,3),q=mr(K.getFullYear(),_?0:K.getMonth(),E||_?1:K.getDate()),V=be(q*t,3);
if(E||_){let N=E?S/r:0,G=_?S/i:0,A=R==V?R:be(mr(q.getFullYear()+G,q.getMonth()+N,1)*t,3),Z=new Date($e(A/t)),I=Z.getFullYear(),j=Z.getMonth();for(let W=0;A<=k;W++){
let Q=mr(I+G*W,j+N*W,1),z=Q-p(be(Q*t,3));A=be((+Q+z)*t,3),A<=k&&M.push(A)}}else{let N=S>=s?s:S,G=ht(y)-ht(R),A=V+G+ls(R-V,N);M.push(A);let Z=p(A),I=Z.getHours()+
Z.getMinutes()/n+Z.getSeconds()/o,j=S/o,W=f.axes[w]._space,Q=P/W;for(;A=be(A+S,t==1?0:3),!(A>k);)if(j>1){let z=ht(be(I+j,6))%24,re=p(A).getHours()-z;re>1&&(re=-1),
A-=re*o,I=(I+j)%24;let ue=M[M.length-1];be((A-ue)/S,3)*Q>=.7&&M.push(A)}else M.push(A)}return M}}return[l,u,h]}var[Pd,Ed,_d]=il(1),[Cd,Ad,Ld]=il(.001);Po(2,-53,
53,[1]);function Ma(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function Ta(t,e){return(n,o,s,r,i)=>{let a=e.find(y=>i>=
y[0])||e[e.length-1],l,u,h,p,f,w;return o.map(y=>{let k=t(y),S=k.getFullYear(),P=k.getMonth(),M=k.getDate(),_=k.getHours(),E=k.getMinutes(),K=k.getSeconds(),R=S!=
l&&a[2]||P!=u&&a[3]||M!=h&&a[4]||_!=p&&a[5]||E!=f&&a[6]||K!=w&&a[7]||a[1];return l=S,u=P,h=M,p=_,f=E,w=K,R(k)})}}function Dd(t,e){let n=Fr(e);return(o,s,r,i,a)=>s.
map(l=>n(t(l)))}function mr(t,e,n){return new Date(t,e,n)}function Pa(t,e){return e(t)}var Rd="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Ea(t,e){return(n,o,s,r)=>r==
null?Cr:e(t(o))}function Nd(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Fd(t,e){return t.series[e].fill(
t,e)}var $d={show:!0,live:!0,isolate:!1,mount:td,markers:{show:!0,width:2,stroke:Nd,fill:Fd,dash:"solid"},idx:null,idxs:null,values:[]};function Id(t,e){let n=t.
cursor.points,o=xt(),s=n.size(t,e);Te(o,xo,s),Te(o,ko,s);let r=s/-2;Te(o,"marginLeft",r),Te(o,"marginTop",r);let i=n.width(t,e,s);return i&&Te(o,"borderWidth",i),
o}function Od(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Ud(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Gd(t,e){return t.
series[e].points.size}var gr=[0,0];function Wd(t,e,n){return gr[0]=e,gr[1]=n,gr}function ts(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function yr(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var zd={show:!0,x:!0,y:!0,lock:!1,move:Wd,points:{one:!1,show:Id,size:Gd,width:0,stroke:Ud,fill:Od},bind:{mousedown:ts,mouseup:ts,
click:ts,dblclick:ts,mousemove:yr,mouseleave:yr,mouseenter:yr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},al={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Ir=Re({},al,{filter:Ka}),ll=Re({},Ir,{size:10}),cl=Re({},al,{show:!1}),Or='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',ul="bold "+Or,dl=1.5,_a={
show:!0,scale:"x",stroke:_r,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:ul,side:2,grid:Ir,ticks:ll,border:cl,font:Or,lineGap:dl,rotate:0},
Hd="Value",Vd="Time",Ca={show:!0,scale:"x",auto:!1,sorted:1,min:ye,max:-ye,idxs:[]};function Bd(t,e,n,o,s){return e.map(r=>r==null?"":Rr(r))}function jd(t,e,n,o,s,r,i){
let a=[],l=Xt.get(s)||0;n=i?n:be(ls(n,s),l);for(let u=n;u<=o;u=be(u+s,l))a.push(Object.is(u,-0)?0:u);return a}function Sr(t,e,n,o,s,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,u=l==10?zt:Va,h=ht(u(n));s=Xn(l,h),l==10&&(s=mn[Ct(s,mn)]);let p=n,f=s*l;l==10&&(f=mn[Ct(f,mn)]);do a.push(p),p=p+s,l==10&&!Xt.has(p)&&(p=be(p,Xt.get(
s))),p>=f&&(s=p,f=s*l,l==10&&(f=mn[Ct(f,mn)]));while(p<=o);return a}function Kd(t,e,n,o,s,r,i){let l=t.scales[t.axes[e].scale].asinh,u=o>l?Sr(t,e,nt(l,n),o,s):[
l],h=o>=0&&n<=0?[0]:[];return(n<-l?Sr(t,e,nt(l,-o),-n,s):[l]).reverse().map(f=>-f).concat(h,u)}var pl=/./,qd=/[12357]/,Yd=/[125]/,Aa=/1/,Mr=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function Jd(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,u=r._space,h=l(10,i),p=l(
9,i)-h>=u?pl:l(7,i)-h>=u?qd:l(5,i)-h>=u?Yd:Aa;if(p==Aa){let f=Ie(l(1,i)-h);if(f<u)return Mr(e.slice().reverse(),a.distr,p,kt(u/f)).reverse()}return Mr(e,a.distr,
p,1)}function Zd(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,u=Ie(l(1,i)-l(2,i));return u<a?Mr(e.slice().reverse(),3,pl,kt(a/u)).reverse():e}function Qd(t,e,n,o){
return o==null?Cr:e==null?"":Rr(e)}var La={show:!0,scale:"y",stroke:_r,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:ul,side:3,grid:Ir,ticks:ll,
border:cl,font:Or,lineGap:dl,rotate:0};function Xd(t,e){let n=3+(t||1)*2;return be(n*e,3)}function ep(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Ie(i-r),l=t.series[e],u=a/(l.points.space*pe);return o[1]-o[0]<=u}var Da={scale:null,auto:!0,sorted:0,min:ye,max:-ye},
hl=(t,e,n,o,s)=>s,Ra={show:!0,auto:!0,sorted:0,gaps:hl,alpha:1,facets:[Re({},Da,{scale:"x"}),Re({},Da,{scale:"y"})]},Na={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:hl,alpha:1,points:{show:ep,filter:null},values:null,min:ye,max:-ye,idxs:[],path:null,clip:null};function tp(t,e,n,o,s){return n/10}var fl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},np=Re({},fl,{time:!1,ori:1}),Fa={};function ml(t,e){let n=Fa[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,l,u){for(let h=0;h<n.plots.length;h++)n.plots[h]!=s&&n.plots[h].pub(o,s,r,i,a,l,u)}},t!=null&&(Fa[t]=
n)),n}var no=1,Tr=2;function wn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],u=o==2?r[1]:r[e],h=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],p=o==2?i[s.facets[1].scale]:i[s.scale],f=a.left,w=a.top,y=a.width,k=a.height,S=t.valToPosH,P=t.valToPosV;return h.ori==0?n(s,l,u,h,p,S,P,f,
w,y,k,ds,so,hs,yl,wl):n(s,l,u,h,p,P,S,w,f,k,y,ps,ro,Wr,bl,vl)}function Ur(t,e){let n=0,o=0,s=ce(t.bands,Nr);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function op(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Ht(t,e,n,o,s,r){return wn(t,e,(i,a,l,u,h,p,f,w,y,k,S)=>{let P=i.pxRound,M=u.
dir*(u.ori==0?1:-1),_=u.ori==0?so:ro,E,K;M==1?(E=n,K=o):(E=o,K=n);let R=P(p(a[E],u,k,w)),q=P(f(l[E],h,S,y)),V=P(p(a[K],u,k,w)),N=P(f(r==1?h.max:h.min,h,S,y)),G=new Path2D(
s);return _(G,V,N),_(G,R,N),_(G,R,q),G})}function us(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?hs:Wr,l=n;for(let p=0;p<t.length;p++){let f=t[p];
if(f[1]>f[0]){let w=f[0]-l;w>0&&a(i,l,o,w,o+r),l=f[1]}}let u=n+s-l,h=10;u>0&&a(i,l,o-h/2,u,o+r+h)}return i}function sp(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Gr(t,e,n,o,s,r,i){let a=[],l=t.length;for(let u=s==1?n:o;u>=n&&u<=o;u+=s)if(e[u]===null){let p=u,f=u;if(s==1)for(;++u<=o&&e[u]===null;)
f=u;else for(;--u>=n&&e[u]===null;)f=u;let w=r(t[p]),y=f==p?w:r(t[f]),k=p-s;w=i<=0&&k>=0&&k<l?r(t[k]):w;let P=f+s;y=i>=0&&P>=0&&P<l?r(t[P]):y,y>=w&&a.push([w,y])}
return a}function $a(t){return t==0?ja:t==1?$e:e=>fn(e,t)}function gl(t){let e=t==0?ds:ps,n=t==0?(s,r,i,a,l,u)=>{s.arcTo(r,i,a,l,u)}:(s,r,i,a,l,u)=>{s.arcTo(i,r,
l,a,u)},o=t==0?(s,r,i,a,l)=>{s.rect(r,i,a,l)}:(s,r,i,a,l)=>{s.rect(i,r,l,a)};return(s,r,i,a,l,u=0,h=0)=>{u==0&&h==0?o(s,r,i,a,l):(u=At(u,a/2,l/2),h=At(h,a/2,l/2),
e(s,r+u,i),n(s,r+a,i,r+a,i+l,u),n(s,r+a,i+l,r,i+l,h),n(s,r,i+l,r,i,h),n(s,r,i,r+a,i,u),s.closePath())}}var ds=(t,e,n)=>{t.moveTo(e,n)},ps=(t,e,n)=>{t.moveTo(n,e)},
so=(t,e,n)=>{t.lineTo(e,n)},ro=(t,e,n)=>{t.lineTo(n,e)},hs=gl(0),Wr=gl(1),yl=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},bl=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},wl=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},vl=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function xl(t){return(e,n,o,s,r)=>wn(e,n,(i,a,l,u,h,p,f,w,y,k,S)=>{let{pxRound:P,
points:M}=i,_,E;u.ori==0?(_=ds,E=yl):(_=ps,E=bl);let K=be(M.width*pe,3),R=(M.size-M.width)/2*pe,q=be(R*2,3),V=new Path2D,N=new Path2D,{left:G,top:A,width:Z,height:I}=e.
bbox;hs(N,G-q,A-q,Z+q*2,I+q*2);let j=W=>{if(l[W]!=null){let Q=P(p(a[W],u,k,w)),z=P(f(l[W],h,S,y));_(V,Q+R,z),E(V,Q,z,R,0,ns*2)}};if(r)r.forEach(j);else for(let W=o;W<=
s;W++)j(W);return{stroke:K>0?V:null,fill:V,clip:N,flags:no|Tr}})}function kl(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var rp=kl(so),ip=kl(ro);function Sl(t){let e=ce(t?.alignGaps,0);return(n,o,s,r)=>wn(n,o,(i,a,l,u,h,p,f,w,y,k,S)=>{[s,r]=is(l,s,r);let P=i.pxRound,M=I=>P(p(I,u,k,
w)),_=I=>P(f(I,h,S,y)),E,K;u.ori==0?(E=so,K=rp):(E=ro,K=ip);let R=u.dir*(u.ori==0?1:-1),q={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:no},V=q.
stroke,N=!1;if(r-s>=k*4){let I=H=>n.posToVal(H,u.key,!0),j=null,W=null,Q,z,Je,me=M(a[R==1?s:r]),re=M(a[s]),ue=M(a[r]),ee=I(R==1?re+1:ue-1);for(let H=R==1?s:r;H>=
s&&H<=r;H+=R){let _e=a[H],ge=(R==1?_e<ee:_e>ee)?me:M(_e),ae=l[H];ge==me?ae!=null?(z=ae,j==null?(E(V,ge,_(z)),Q=j=W=z):z<j?j=z:z>W&&(W=z)):ae===null&&(N=!0):(j!=
null&&K(V,me,_(j),_(W),_(Q),_(z)),ae!=null?(z=ae,E(V,ge,_(z)),j=W=Q=z):(j=W=null,ae===null&&(N=!0)),me=ge,ee=I(me+R))}j!=null&&j!=W&&Je!=me&&K(V,me,_(j),_(W),_(
Q),_(z))}else for(let I=R==1?s:r;I>=s&&I<=r;I+=R){let j=l[I];j===null?N=!0:j!=null&&E(V,M(a[I]),_(j))}let[A,Z]=Ur(n,o);if(i.fill!=null||A!=0){let I=q.fill=new Path2D(
V),j=i.fillTo(n,o,i.min,i.max,A),W=_(j),Q=M(a[s]),z=M(a[r]);R==-1&&([z,Q]=[Q,z]),E(I,z,W),E(I,Q,W)}if(!i.spanGaps){let I=[];N&&I.push(...Gr(a,l,s,r,R,M,e)),q.gaps=
I=i.gaps(n,o,s,r,I),q.clip=us(I,u.ori,w,y,k,S)}return Z!=0&&(q.band=Z==2?[Ht(n,o,s,r,V,-1),Ht(n,o,s,r,V,1)]:Ht(n,o,s,r,V,Z)),q})}function ap(t){let e=ce(t.align,
1),n=ce(t.ascDesc,!1),o=ce(t.alignGaps,0),s=ce(t.extend,!1);return(r,i,a,l)=>wn(r,i,(u,h,p,f,w,y,k,S,P,M,_)=>{[a,l]=is(p,a,l);let E=u.pxRound,{left:K,width:R}=r.
bbox,q=re=>E(y(re,f,M,S)),V=re=>E(k(re,w,_,P)),N=f.ori==0?so:ro,G={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:no},A=G.stroke,Z=f.dir*(f.ori==
0?1:-1),I=V(p[Z==1?a:l]),j=q(h[Z==1?a:l]),W=j,Q=j;s&&e==-1&&(Q=K,N(A,Q,I)),N(A,j,I);for(let re=Z==1?a:l;re>=a&&re<=l;re+=Z){let ue=p[re];if(ue==null)continue;let ee=q(
h[re]),H=V(ue);e==1?N(A,ee,I):N(A,W,H),N(A,ee,H),I=H,W=ee}let z=W;s&&e==1&&(z=K+R,N(A,z,I));let[Je,me]=Ur(r,i);if(u.fill!=null||Je!=0){let re=G.fill=new Path2D(
A),ue=u.fillTo(r,i,u.min,u.max,Je),ee=V(ue);N(re,z,ee),N(re,Q,ee)}if(!u.spanGaps){let re=[];re.push(...Gr(h,p,a,l,Z,q,o));let ue=u.width*pe/2,ee=n||e==1?ue:-ue,
H=n||e==-1?-ue:ue;re.forEach(_e=>{_e[0]+=ee,_e[1]+=H}),G.gaps=re=u.gaps(r,i,a,l,re),G.clip=us(re,f.ori,S,P,M,_)}return me!=0&&(G.band=me==2?[Ht(r,i,a,l,A,-1),Ht(
r,i,a,l,A,1)]:Ht(r,i,a,l,A,me)),G})}function Ia(t,e,n,o,s,r,i=ye){if(t.length>1){let a=null;for(let l=0,u=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=Ie(
t[l]-t[a]);h<u&&(u=h,i=Ie(n(t[l],o,s,r)-n(t[a],o,s,r)))}a=l}}return i}function lp(t){t=t||To;let e=ce(t.size,[.6,ye,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==
null?[0,0]:typeof s=="number"?[s,0]:s;let r=ie(s),i=1-e[0],a=ce(e[1],ye),l=ce(e[2],1),u=ce(t.disp,To),h=ce(t.each,w=>{}),{fill:p,stroke:f}=u;return(w,y,k,S)=>wn(
w,y,(P,M,_,E,K,R,q,V,N,G,A)=>{let Z=P.pxRound,I=n,j=o*pe,W=a*pe,Q=l*pe,z,Je;E.ori==0?[z,Je]=r(w,y):[Je,z]=r(w,y);let me=E.dir*(E.ori==0?1:-1),re=E.ori==0?hs:Wr,
ue=E.ori==0?h:(O,we,Fe,Sn,on,Lt,sn)=>{h(O,we,Fe,on,Sn,sn,Lt)},ee=ce(w.bands,Nr).find(O=>O.series[0]==y),H=ee!=null?ee.dir:0,_e=P.fillTo(w,y,P.min,P.max,H),Ue=Z(
q(_e,K,A,N)),ge,ae,mt,ot=G,Pe=Z(P.width*pe),it=!1,Y=null,ne=null,Ne=null,Ot=null;p!=null&&(Pe==0||f!=null)&&(it=!0,Y=p.values(w,y,k,S),ne=new Map,new Set(Y).forEach(
O=>{O!=null&&ne.set(O,new Path2D)}),Pe>0&&(Ne=f.values(w,y,k,S),Ot=new Map,new Set(Ne).forEach(O=>{O!=null&&Ot.set(O,new Path2D)})));let{x0:xn,size:ao}=u;if(xn!=
null&&ao!=null){I=1,M=xn.values(w,y,k,S),xn.unit==2&&(M=M.map(Fe=>w.posToVal(V+Fe*G,E.key,!0)));let O=ao.values(w,y,k,S);ao.unit==2?ae=O[0]*G:ae=R(O[0],E,G,V)-R(
0,E,G,V),ot=Ia(M,_,R,E,G,V,ot),mt=ot-ae+j}else ot=Ia(M,_,R,E,G,V,ot),mt=ot*i+j,ae=ot-mt;mt<1&&(mt=0),Pe>=ae/2&&(Pe=0),mt<5&&(Z=ja);let Eo=mt>0,tn=ot-mt-(Eo?Pe:0);
ae=Z(kr(tn,Q,W)),ge=(I==0?ae/2:I==me?0:ae)-I*me*((I==0?j/2:0)+(Eo?Pe/2:0));let Qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},kn=it?null:new Path2D,
Ut=null;if(ee!=null)Ut=w.data[ee.series[1]];else{let{y0:O,y1:we}=u;O!=null&&we!=null&&(_=we.values(w,y,k,S),Ut=O.values(w,y,k,S))}let nn=z*ae,te=Je*ae;for(let O=me==
1?k:S;O>=k&&O<=S;O+=me){let we=_[O];if(we==null)continue;if(Ut!=null){let st=Ut[O]??0;if(we-st==0)continue;Ue=q(st,K,A,N)}let Fe=E.distr!=2||u!=null?M[O]:O,Sn=R(
Fe,E,G,V),on=q(ce(we,_e),K,A,N),Lt=Z(Sn-ge),sn=Z(nt(on,Ue)),at=Z(At(on,Ue)),gt=sn-at;if(we!=null){let st=we<0?te:nn,St=we<0?nn:te;it?(Pe>0&&Ne[O]!=null&&re(Ot.get(
Ne[O]),Lt,at+ht(Pe/2),ae,nt(0,gt-Pe),st,St),Y[O]!=null&&re(ne.get(Y[O]),Lt,at+ht(Pe/2),ae,nt(0,gt-Pe),st,St)):re(kn,Lt,at+ht(Pe/2),ae,nt(0,gt-Pe),st,St),ue(w,y,
O,Lt-Pe/2,at,ae+Pe,gt)}}return Pe>0?Qe.stroke=it?Ot:kn:it||(Qe._fill=P.width==0?P._fill:P._stroke??P._fill,Qe.width=0),Qe.fill=it?ne:kn,Qe})}function cp(t,e){let n=ce(
e?.alignGaps,0);return(o,s,r,i)=>wn(o,s,(a,l,u,h,p,f,w,y,k,S,P)=>{[r,i]=is(u,r,i);let M=a.pxRound,_=z=>M(f(z,h,S,y)),E=z=>M(w(z,p,P,k)),K,R,q;h.ori==0?(K=ds,q=so,
R=wl):(K=ps,q=ro,R=vl);let V=h.dir*(h.ori==0?1:-1),N=_(l[V==1?r:i]),G=N,A=[],Z=[];for(let z=V==1?r:i;z>=r&&z<=i;z+=V)if(u[z]!=null){let me=l[z],re=_(me);A.push(
G=re),Z.push(E(u[z]))}let I={stroke:t(A,Z,K,q,R,M),fill:null,clip:null,band:null,gaps:null,flags:no},j=I.stroke,[W,Q]=Ur(o,s);if(a.fill!=null||W!=0){let z=I.fill=
new Path2D(j),Je=a.fillTo(o,s,a.min,a.max,W),me=E(Je);q(z,G,me),q(z,N,me)}if(!a.spanGaps){let z=[];z.push(...Gr(l,u,r,i,V,_,n)),I.gaps=z=a.gaps(o,s,r,i,z),I.clip=
us(z,h.ori,y,k,S,P)}return Q!=0&&(I.band=Q==2?[Ht(o,s,r,i,j,-1),Ht(o,s,r,i,j,1)]:Ht(o,s,r,i,j,Q)),I})}function up(t){return cp(dp,t)}function dp(t,e,n,o,s,r){let i=t.
length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let l=Array(i),u=Array(i-1),h=Array(i-1),p=Array(i-1);for(let f=0;f<i-1;f++)
h[f]=e[f+1]-e[f],p[f]=t[f+1]-t[f],u[f]=h[f]/p[f];l[0]=u[0];for(let f=1;f<i-1;f++)u[f]===0||u[f-1]===0||u[f-1]>0!=u[f]>0?l[f]=0:(l[f]=3*(p[f-1]+p[f])/((2*p[f]+p[f-
1])/u[f-1]+(p[f]+2*p[f-1])/u[f]),isFinite(l[f])||(l[f]=0));l[i-1]=u[i-2];for(let f=0;f<i-1;f++)s(a,t[f]+p[f]/3,e[f]+l[f]*p[f]/3,t[f+1]-p[f]/3,e[f+1]-l[f+1]*p[f]/
3,t[f+1],e[f+1])}return a}var Pr=new Set;function Oa(){for(let t of Pr)t.syncRect(!0)}oo&&(yn(Bu,Qn,Oa),yn(ju,Qn,Oa,!0),yn(os,Qn,()=>{Oe.pxRatio=pe}));var pp=Sl(),
hp=xl();function Ua(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Er(r,i,e,n))}function fp(t,e){return t.map((n,o)=>o==
0?{}:Re({},e,n))}function Er(t,e,n,o){return Re({},e==0?n:o,t)}function Ml(t,e,n){return e==null?eo:[e,n]}var mp=Ml;function gp(t,e,n){return e==null?eo:ss(e,n,
Dr,!0)}function Tl(t,e,n,o){return e==null?eo:as(e,n,t.scales[o].log,!1)}var yp=Tl;function Pl(t,e,n,o){return e==null?eo:Lr(e,n,t.scales[o].log,!1)}var bp=Pl;function wp(t,e,n,o,s){
let r=nt(ya(t),ya(e)),i=e-t,a=Ct(s/o*i,n);do{let l=n[a],u=o*l/i;if(u>=s&&r+(l<5?Xt.get(l):0)<=17)return[l,u]}while(++a<n.length);return[0,0]}function Ga(t){let e,
n;return t=t.replace(/(\d+)px/,(o,s)=>(e=$e((n=+s)*pe))+"px"),[t,e,n]}function vp(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=be(e[2]*pe,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Oe(t,e,n){let o={mode:ce(t.mode,1)},s=o.mode;function r(c,d,m,g){let b=d.valToPct(c);return g+m*(d.dir==-1?1-b:b)}function i(c,d,m,g){
let b=d.valToPct(c);return g+m*(d.dir==-1?b:1-b)}function a(c,d,m,g){return d.ori==0?r(c,d,m,g):i(c,d,m,g)}o.valToPosH=r,o.valToPosV=i;let l=!1;o.status=0;let u=o.
root=xt(Eu);if(t.id!=null&&(u.id=t.id),pt(u,t.class),t.title){let c=xt(Au,u);c.textContent=t.title}let h=_t("canvas"),p=o.ctx=h.getContext("2d"),f=xt(Lu,u);yn("\
click",f,c=>{c.target===y&&(ve!=Nn||Ee!=Fn)&&qe.click(o,c)},!0);let w=o.under=xt(Du,f);f.appendChild(h);let y=o.over=xt(Ru,f);t=to(t);let k=+ce(t.pxAlign,1),S=$a(
k);(t.plugins||[]).forEach(c=>{c.opts&&(t=c.opts(o,t)||t)});let P=t.ms||.001,M=o.series=s==1?Ua(t.series||[],Ca,Na,!1):fp(t.series||[null],Ra),_=o.axes=Ua(t.axes||
[],_a,La,!0),E=o.scales={},K=o.bands=t.bands||[];K.forEach(c=>{c.fill=ie(c.fill||null),c.dir=ce(c.dir,-1)});let R=s==2?M[1].facets[0].scale:M[0].scale,q={axes:Ic,
series:Dc},V=(t.drawOrder||["axes","series"]).map(c=>q[c]);function N(c){let d=c.distr==3?m=>zt(m>0?m:c.clamp(o,m,c.min,c.max,c.key)):c.distr==4?m=>fr(m,c.asinh):
c.distr==100?m=>c.fwd(m):m=>m;return m=>{let g=d(m),{_min:b,_max:v}=c,T=v-b;return(g-b)/T}}function G(c){let d=E[c];if(d==null){let m=(t.scales||To)[c]||To;if(m.
from!=null){G(m.from);let g=Re({},E[m.from],m,{key:c});g.valToPct=N(g),E[c]=g}else{d=E[c]=Re({},c==R?fl:np,m),d.key=c;let g=d.time,b=d.range,v=Qt(b);if((c!=R||s==
2&&!g)&&(v&&(b[0]==null||b[1]==null)&&(b={min:b[0]==null?fa:{mode:1,hard:b[0],soft:b[0]},max:b[1]==null?fa:{mode:1,hard:b[1],soft:b[1]}},v=!1),!v&&cs(b))){let T=b;
b=(C,D,F)=>D==null?eo:ss(D,F,T)}d.range=ie(b||(g?mp:c==R?d.distr==3?yp:d.distr==4?bp:Ml:d.distr==3?Tl:d.distr==4?Pl:gp)),d.auto=ie(v?!1:d.auto),d.clamp=ie(d.clamp||
tp),d._min=d._max=null,d.valToPct=N(d)}}}G("x"),G("y"),s==1&&M.forEach(c=>{G(c.scale)}),_.forEach(c=>{G(c.scale)});for(let c in t.scales)G(c);let A=E[R],Z=A.distr,
I,j;A.ori==0?(pt(u,_u),I=r,j=i):(pt(u,Cu),I=i,j=r);let W={};for(let c in E){let d=E[c];(d.min!=null||d.max!=null)&&(W[c]={min:d.min,max:d.max},d.min=d.max=null)}
let Q=t.tzDate||(c=>new Date($e(c/P))),z=t.fmtDate||Fr,Je=P==1?_d(Q):Ld(Q),me=Ta(Q,Ma(P==1?Ed:Ad,z)),re=Ea(Q,Pa(Rd,z)),ue=[],ee=o.legend=Re({},$d,t.legend),H=o.
cursor=Re({},zd,{drag:{y:s==2}},t.cursor),_e=ee.show,Ue=H.show,ge=ee.markers;ee.idxs=ue,ge.width=ie(ge.width),ge.dash=ie(ge.dash),ge.stroke=ie(ge.stroke),ge.fill=
ie(ge.fill);let ae,mt,ot,Pe=[],it=[],Y,ne=!1,Ne={};if(ee.live){let c=M[1]?M[1].values:null;ne=c!=null,Y=ne?c(o,1,0):{_:0};for(let d in Y)Ne[d]=Cr}if(_e)if(ae=_t(
"table",Uu,u),ot=_t("tbody",null,ae),ee.mount(o,ae),ne){mt=_t("thead",null,ae,ot);let c=_t("tr",null,mt);_t("th",null,c);for(var Ot in Y)_t("th",ta,c).textContent=
Ot}else pt(ae,Wu),ee.live&&pt(ae,Gu);let xn={show:!0},ao={show:!1};function Eo(c,d){if(d==0&&(ne||!ee.live||s==2))return eo;let m=[],g=_t("tr",zu,ot,ot.childNodes[d]);
pt(g,c.class),c.show||pt(g,gn);let b=_t("th",null,g);if(ge.show){let C=xt(Hu,b);if(d>0){let D=ge.width(o,d);D&&(C.style.border=D+"px "+ge.dash(o,d)+" "+ge.stroke(
o,d)),C.style.background=ge.fill(o,d)}}let v=xt(ta,b);c.label instanceof HTMLElement?v.appendChild(c.label):v.textContent=c.label,d>0&&(ge.show||(v.style.color=
c.width>0?ge.stroke(o,d):ge.fill(o,d)),Qe("click",b,C=>{if(H._lock)return;an(C);let D=M.indexOf(c);if((C.ctrlKey||C.metaKey)!=ee.isolate){let F=M.some(($,U)=>U>
0&&U!=D&&$.show);M.forEach(($,U)=>{U>0&&Rt(U,F?U==D?xn:ao:xn,!0,Le.setSeries)})}else Rt(D,{show:!c.show},!0,Le.setSeries)},!1),Tn&&Qe(ra,b,C=>{H._lock||(an(C),Rt(
M.indexOf(c),In,!0,Le.setSeries))},!1));for(var T in Y){let C=_t("td",Vu,g);C.textContent="--",m.push(C)}return[g,m]}let tn=new Map;function Qe(c,d,m,g=!0){let b=tn.
get(d)||{},v=H.bind[c](o,d,m,g);v&&(yn(c,d,b[c]=v),tn.set(d,b))}function kn(c,d,m){let g=tn.get(d)||{};for(let b in g)(c==null||b==c)&&(xr(b,d,g[b]),delete g[b]);
c==null&&tn.delete(d)}let Ut=0,nn=0,te=0,O=0,we=0,Fe=0,Sn=we,on=Fe,Lt=te,sn=O,at=0,gt=0,st=0,St=0;o.bbox={};let Ds=!1,_o=!1,Mn=!1,rn=!1,Co=!1,yt=!1;function Rs(c,d,m){
(m||c!=o.width||d!=o.height)&&Jr(c,d),An(!1),Mn=!0,_o=!0,Ln()}function Jr(c,d){o.width=Ut=te=c,o.height=nn=O=d,we=Fe=0,Tc(),Pc();let m=o.bbox;at=m.left=fn(we*pe,
.5),gt=m.top=fn(Fe*pe,.5),st=m.width=fn(te*pe,.5),St=m.height=fn(O*pe,.5)}let kc=3;function Sc(){let c=!1,d=0;for(;!c;){d++;let m=Fc(d),g=$c(d);c=d==kc||m&&g,c||
(Jr(o.width,o.height),_o=!0)}}function Mc({width:c,height:d}){Rs(c,d)}o.setSize=Mc;function Tc(){let c=!1,d=!1,m=!1,g=!1;_.forEach((b,v)=>{if(b.show&&b._show){let{
side:T,_size:C}=b,D=T%2,F=b.label!=null?b.labelSize:0,$=C+F;$>0&&(D?(te-=$,T==3?(we+=$,g=!0):m=!0):(O-=$,T==0?(Fe+=$,c=!0):d=!0))}}),ln[0]=c,ln[1]=m,ln[2]=d,ln[3]=
g,te-=Vt[1]+Vt[3],we+=Vt[3],O-=Vt[2]+Vt[0],Fe+=Vt[0]}function Pc(){let c=we+te,d=Fe+O,m=we,g=Fe;function b(v,T){switch(v){case 1:return c+=T,c-T;case 2:return d+=
T,d-T;case 3:return m-=T,m+T;case 0:return g-=T,g+T}}_.forEach((v,T)=>{if(v.show&&v._show){let C=v.side;v._pos=b(C,v._size),v.label!=null&&(v._lpos=b(C,v.labelSize))}})}
if(H.dataIdx==null){let c=H.hover,d=c.skip=new Set(c.skip??[]);d.add(void 0);let m=c.prox=ie(c.prox),g=c.bias??=0;H.dataIdx=(b,v,T,C)=>{if(v==0)return T;let D=T,
F=m(b,v,T,C)??ye,$=F>=0&&F<ye,U=A.ori==0?te:O,X=H.left,de=e[0],le=e[v];if(d.has(le[T])){D=null;let oe=null,J=null,B;if(g==0||g==-1)for(B=T;oe==null&&B-- >0;)d.has(
le[B])||(oe=B);if(g==0||g==1)for(B=T;J==null&&B++<le.length;)d.has(le[B])||(J=B);if(oe!=null||J!=null)if($){let ke=oe==null?-1/0:I(de[oe],A,U,0),Ce=J==null?1/0:
I(de[J],A,U,0),Be=X-ke,fe=Ce-X;Be<=fe?Be<=F&&(D=oe):fe<=F&&(D=J)}else D=J==null?oe:oe==null?J:T-oe<=J-T?oe:J}else $&&Ie(X-I(de[T],A,U,0))>F&&(D=null);return D}}
let an=c=>{H.event=c};H.idxs=ue,H._lock=!1;let Ze=H.points;Ze.show=ie(Ze.show),Ze.size=ie(Ze.size),Ze.stroke=ie(Ze.stroke),Ze.width=ie(Ze.width),Ze.fill=ie(Ze.fill);
let Dt=o.focus=Re({},t.focus||{alpha:.3},H.focus),Tn=Dt.prox>=0,Pn=Tn&&Ze.one,bt=[],En=[],_n=[];function Zr(c,d){let m=Ze.show(o,d);if(m instanceof HTMLElement)
return pt(m,Ou),pt(m,c.class),It(m,-10,-10,te,O),y.insertBefore(m,bt[d]),m}function Qr(c,d){if(s==1||d>0){let m=s==1&&E[c.scale].time,g=c.value;c.value=m?va(g)?
Ea(Q,Pa(g,z)):g||re:g||Qd,c.label=c.label||(m?Vd:Hd)}if(Pn||d>0){c.width=c.width==null?1:c.width,c.paths=c.paths||pp||nd,c.fillTo=ie(c.fillTo||op),c.pxAlign=+ce(
c.pxAlign,k),c.pxRound=$a(c.pxAlign),c.stroke=ie(c.stroke||null),c.fill=ie(c.fill||null),c._stroke=c._fill=c._paths=c._focus=null;let m=Xd(nt(1,c.width),1),g=c.
points=Re({},{size:m,width:nt(1,m*.2),stroke:c.stroke,space:m*2,paths:hp,_stroke:null,_fill:null},c.points);g.show=ie(g.show),g.filter=ie(g.filter),g.fill=ie(g.
fill),g.stroke=ie(g.stroke),g.paths=ie(g.paths),g.pxAlign=c.pxAlign}if(_e){let m=Eo(c,d);Pe.splice(d,0,m[0]),it.splice(d,0,m[1]),ee.values.push(null)}if(Ue){ue.
splice(d,0,null);let m=null;Pn?d==0&&(m=Zr(c,d)):d>0&&(m=Zr(c,d)),bt.splice(d,0,m),En.splice(d,0,0),_n.splice(d,0,0)}Ve("addSeries",d)}function Ec(c,d){d=d??M.length,
c=s==1?Er(c,d,Ca,Na):Er(c,d,{},Ra),M.splice(d,0,c),Qr(M[d],d)}o.addSeries=Ec;function _c(c){if(M.splice(c,1),_e){ee.values.splice(c,1),it.splice(c,1);let d=Pe.splice(
c,1)[0];kn(null,d.firstChild),d.remove()}Ue&&(ue.splice(c,1),bt.splice(c,1)[0].remove(),En.splice(c,1),_n.splice(c,1)),Ve("delSeries",c)}o.delSeries=_c;let ln=[
!1,!1,!1,!1];function Cc(c,d){if(c._show=c.show,c.show){let m=c.side%2,g=E[c.scale];g==null&&(c.scale=m?M[1].scale:R,g=E[c.scale]);let b=g.time;c.size=ie(c.size),
c.space=ie(c.space),c.rotate=ie(c.rotate),Qt(c.incrs)&&c.incrs.forEach(T=>{!Xt.has(T)&&Xt.set(T,Ya(T))}),c.incrs=ie(c.incrs||(g.distr==2?Md:b?P==1?Pd:Cd:mn)),c.
splits=ie(c.splits||(b&&g.distr==1?Je:g.distr==3?Sr:g.distr==4?Kd:jd)),c.stroke=ie(c.stroke),c.grid.stroke=ie(c.grid.stroke),c.ticks.stroke=ie(c.ticks.stroke),c.
border.stroke=ie(c.border.stroke);let v=c.values;c.values=Qt(v)&&!Qt(v[0])?ie(v):b?Qt(v)?Ta(Q,Ma(v,z)):va(v)?Dd(Q,v):v||me:v||Bd,c.filter=ie(c.filter||(g.distr>=
3&&g.log==10?Jd:g.distr==3&&g.log==2?Zd:Ka)),c.font=Ga(c.font),c.labelFont=Ga(c.labelFont),c._size=c.size(o,null,d,0),c._space=c._rotate=c._incrs=c._found=c._splits=
c._values=null,c._size>0&&(ln[d]=!0,c._el=xt(Nu,f))}}function lo(c,d,m,g){let[b,v,T,C]=m,D=d%2,F=0;return D==0&&(C||v)&&(F=d==0&&!b||d==2&&!T?$e(_a.size/3):0),D==
1&&(b||T)&&(F=d==1&&!v||d==3&&!C?$e(La.size/2):0),F}let Xr=o.padding=(t.padding||[lo,lo,lo,lo]).map(c=>ie(ce(c,lo))),Vt=o._padding=Xr.map((c,d)=>c(o,d,ln,0)),Ke,
Ge=null,We=null,Ao=s==1?M[0].idxs:null,Mt=null,co=!1;function ei(c,d){if(e=c??[],o.data=o._data=e,s==2){Ke=0;for(let m=1;m<M.length;m++)Ke+=e[m][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),Mt=e[0],Ke=Mt.length;let m=e;if(Z==2){m=e.slice();let g=m[0]=Array(Ke);for(let b=0;b<Ke;b++)g[b]=b}o._data=e=m}if(An(!0),Ve(
"setData"),Z==2&&(Mn=!0),d!==!1){let m=A;m.auto(o,co)?Ns():jt(R,m.min,m.max),rn=rn||H.left>=0,yt=!0,Ln()}}o.setData=ei;function Ns(){co=!0;let c,d;s==1&&(Ke>0?(Ge=
Ao[0]=0,We=Ao[1]=Ke-1,c=e[0][Ge],d=e[0][We],Z==2?(c=Ge,d=We):c==d&&(Z==3?[c,d]=as(c,c,A.log,!1):Z==4?[c,d]=Lr(c,c,A.log,!1):A.time?d=c+$e(86400/P):[c,d]=ss(c,d,
Dr,!0))):(Ge=Ao[0]=c=null,We=Ao[1]=d=null)),jt(R,c,d)}let Lo,Cn,Fs,$s,Is,Os,Us,Gs,Ws,rt;function ti(c,d,m,g,b,v){c??=oa,m??=Nr,g??="butt",b??=oa,v??="round",c!=
Lo&&(p.strokeStyle=Lo=c),b!=Cn&&(p.fillStyle=Cn=b),d!=Fs&&(p.lineWidth=Fs=d),v!=Is&&(p.lineJoin=Is=v),g!=Os&&(p.lineCap=Os=g),m!=$s&&p.setLineDash($s=m)}function ni(c,d,m,g){
d!=Cn&&(p.fillStyle=Cn=d),c!=Us&&(p.font=Us=c),m!=Gs&&(p.textAlign=Gs=m),g!=Ws&&(p.textBaseline=Ws=g)}function zs(c,d,m,g,b=0){if(g.length>0&&c.auto(o,co)&&(d==
null||d.min==null)){let v=ce(Ge,0),T=ce(We,g.length-1),C=m.min==null?Ju(g,v,T,b,c.distr==3):[m.min,m.max];c.min=At(c.min,m.min=C[0]),c.max=nt(c.max,m.max=C[1])}}
let oi={min:null,max:null};function Ac(){for(let g in E){let b=E[g];W[g]==null&&(b.min==null||W[R]!=null&&b.auto(o,co))&&(W[g]=oi)}for(let g in E){let b=E[g];W[g]==
null&&b.from!=null&&W[b.from]!=null&&(W[g]=oi)}W[R]!=null&&An(!0);let c={};for(let g in W){let b=W[g];if(b!=null){let v=c[g]=to(E[g],rd);if(b.min!=null)Re(v,b);else if(g!=
R||s==2)if(Ke==0&&v.from==null){let T=v.range(o,null,null,g);v.min=T[0],v.max=T[1]}else v.min=ye,v.max=-ye}}if(Ke>0){M.forEach((g,b)=>{if(s==1){let v=g.scale,T=W[v];
if(T==null)return;let C=c[v];if(b==0){let D=C.range(o,C.min,C.max,v);C.min=D[0],C.max=D[1],Ge=Ct(C.min,e[0]),We=Ct(C.max,e[0]),We-Ge>1&&(e[0][Ge]<C.min&&Ge++,e[0][We]>
C.max&&We--),g.min=Mt[Ge],g.max=Mt[We]}else g.show&&g.auto&&zs(C,T,g,e[b],g.sorted);g.idxs[0]=Ge,g.idxs[1]=We}else if(b>0&&g.show&&g.auto){let[v,T]=g.facets,C=v.
scale,D=T.scale,[F,$]=e[b],U=c[C],X=c[D];U!=null&&zs(U,W[C],v,F,v.sorted),X!=null&&zs(X,W[D],T,$,T.sorted),g.min=T.min,g.max=T.max}});for(let g in c){let b=c[g],
v=W[g];if(b.from==null&&(v==null||v.min==null)){let T=b.range(o,b.min==ye?null:b.min,b.max==-ye?null:b.max,g);b.min=T[0],b.max=T[1]}}}for(let g in c){let b=c[g];
if(b.from!=null){let v=c[b.from];if(v.min==null)b.min=b.max=null;else{let T=b.range(o,v.min,v.max,g);b.min=T[0],b.max=T[1]}}}let d={},m=!1;for(let g in c){let b=c[g],
v=E[g];if(v.min!=b.min||v.max!=b.max){v.min=b.min,v.max=b.max;let T=v.distr;v._min=T==3?zt(v.min):T==4?fr(v.min,v.asinh):T==100?v.fwd(v.min):v.min,v._max=T==3?zt(
v.max):T==4?fr(v.max,v.asinh):T==100?v.fwd(v.max):v.max,d[g]=m=!0}}if(m){M.forEach((g,b)=>{s==2?b>0&&d.y&&(g._paths=null):d[g.scale]&&(g._paths=null)});for(let g in d)
Mn=!0,Ve("setScale",g);Ue&&H.left>=0&&(rn=yt=!0)}for(let g in W)W[g]=null}function Lc(c){let d=kr(Ge-1,0,Ke-1),m=kr(We+1,0,Ke-1);for(;c[d]==null&&d>0;)d--;for(;c[m]==
null&&m<Ke-1;)m++;return[d,m]}function Dc(){if(Ke>0){let c=M.some(d=>d._focus)&&rt!=Dt.alpha;c&&(p.globalAlpha=rt=Dt.alpha),M.forEach((d,m)=>{if(m>0&&d.show&&(si(
m,!1),si(m,!0),d._paths==null)){let g=rt;rt!=d.alpha&&(p.globalAlpha=rt=d.alpha);let b=s==2?[0,e[m][0].length-1]:Lc(e[m]);d._paths=d.paths(o,m,b[0],b[1]),rt!=g&&
(p.globalAlpha=rt=g)}}),M.forEach((d,m)=>{if(m>0&&d.show){let g=rt;rt!=d.alpha&&(p.globalAlpha=rt=d.alpha),d._paths!=null&&ri(m,!1);{let b=d._paths!=null?d._paths.
gaps:null,v=d.points.show(o,m,Ge,We,b),T=d.points.filter(o,m,v,b);(v||T)&&(d.points._paths=d.points.paths(o,m,Ge,We,T),ri(m,!0))}rt!=g&&(p.globalAlpha=rt=g),Ve(
"drawSeries",m)}}),c&&(p.globalAlpha=rt=1)}}function si(c,d){let m=d?M[c].points:M[c];m._stroke=m.stroke(o,c),m._fill=m.fill(o,c)}function ri(c,d){let m=d?M[c].
points:M[c],{stroke:g,fill:b,clip:v,flags:T,_stroke:C=m._stroke,_fill:D=m._fill,_width:F=m.width}=m._paths;F=be(F*pe,3);let $=null,U=F%2/2;d&&D==null&&(D=F>0?"#\
fff":C);let X=m.pxAlign==1&&U>0;if(X&&p.translate(U,U),!d){let de=at-F/2,le=gt-F/2,oe=st+F,J=St+F;$=new Path2D,$.rect(de,le,oe,J)}d?Hs(C,F,m.dash,m.cap,D,g,b,T,
v):Rc(c,C,F,m.dash,m.cap,D,g,b,T,$,v),X&&p.translate(-U,-U)}function Rc(c,d,m,g,b,v,T,C,D,F,$){let U=!1;D!=0&&K.forEach((X,de)=>{if(X.series[0]==c){let le=M[X.series[1]],
oe=e[X.series[1]],J=(le._paths||To).band;Qt(J)&&(J=X.dir==1?J[0]:J[1]);let B,ke=null;le.show&&J&&Qu(oe,Ge,We)?(ke=X.fill(o,de)||v,B=le._paths.clip):J=null,Hs(d,
m,g,b,ke,T,C,D,F,$,B,J),U=!0}}),U||Hs(d,m,g,b,v,T,C,D,F,$)}let ii=no|Tr;function Hs(c,d,m,g,b,v,T,C,D,F,$,U){ti(c,d,m,g,b),(D||F||U)&&(p.save(),D&&p.clip(D),F&&
p.clip(F)),U?(C&ii)==ii?(p.clip(U),$&&p.clip($),Ro(b,T),Do(c,v,d)):C&Tr?(Ro(b,T),p.clip(U),Do(c,v,d)):C&no&&(p.save(),p.clip(U),$&&p.clip($),Ro(b,T),p.restore(),
Do(c,v,d)):(Ro(b,T),Do(c,v,d)),(D||F||U)&&p.restore()}function Do(c,d,m){m>0&&(d instanceof Map?d.forEach((g,b)=>{p.strokeStyle=Lo=b,p.stroke(g)}):d!=null&&c&&p.
stroke(d))}function Ro(c,d){d instanceof Map?d.forEach((m,g)=>{p.fillStyle=Cn=g,p.fill(m)}):d!=null&&c&&p.fill(d)}function Nc(c,d,m,g){let b=_[c],v;if(g<=0)v=[0,
0];else{let T=b._space=b.space(o,c,d,m,g),C=b._incrs=b.incrs(o,c,d,m,g,T);v=wp(d,m,C,g,T)}return b._found=v}function Vs(c,d,m,g,b,v,T,C,D,F){let $=T%2/2;k==1&&p.
translate($,$),ti(C,T,D,F,C),p.beginPath();let U,X,de,le,oe=b+(g==0||g==3?-v:v);m==0?(X=b,le=oe):(U=b,de=oe);for(let J=0;J<c.length;J++)d[J]!=null&&(m==0?U=de=c[J]:
X=le=c[J],p.moveTo(U,X),p.lineTo(de,le));p.stroke(),k==1&&p.translate(-$,-$)}function Fc(c){let d=!0;return _.forEach((m,g)=>{if(!m.show)return;let b=E[m.scale];
if(b.min==null){m._show&&(d=!1,m._show=!1,An(!1));return}else m._show||(d=!1,m._show=!0,An(!1));let v=m.side,T=v%2,{min:C,max:D}=b,[F,$]=Nc(g,C,D,T==0?te:O);if($==
0)return;let U=b.distr==2,X=m._splits=m.splits(o,g,C,D,F,$,U),de=b.distr==2?X.map(B=>Mt[B]):X,le=b.distr==2?Mt[X[1]]-Mt[X[0]]:F,oe=m._values=m.values(o,m.filter(
o,de,g,$,le),g,$,le);m._rotate=v==2?m.rotate(o,oe,g,$):0;let J=m._size;m._size=kt(m.size(o,oe,g,c)),J!=null&&m._size!=J&&(d=!1)}),d}function $c(c){let d=!0;return Xr.
forEach((m,g)=>{let b=m(o,g,ln,c);b!=Vt[g]&&(d=!1),Vt[g]=b}),d}function Ic(){for(let c=0;c<_.length;c++){let d=_[c];if(!d.show||!d._show)continue;let m=d.side,g=m%
2,b,v,T=d.stroke(o,c),C=m==0||m==3?-1:1,[D,F]=d._found;if(d.label!=null){let et=d.labelGap*C,ut=$e((d._lpos+et)*pe);ni(d.labelFont[0],T,"center",m==2?"top":na),
p.save(),g==1?(b=v=0,p.translate(ut,$e(gt+St/2)),p.rotate((m==3?-ns:ns)/2)):(b=$e(at+st/2),v=ut);let dn=Ba(d.label)?d.label(o,c,D,F):d.label;p.fillText(dn,b,v),
p.restore()}if(F==0)continue;let $=E[d.scale],U=g==0?st:St,X=g==0?at:gt,de=d._splits,le=$.distr==2?de.map(et=>Mt[et]):de,oe=$.distr==2?Mt[de[1]]-Mt[de[0]]:D,J=d.
ticks,B=d.border,ke=J.show?J.size:0,Ce=$e(ke*pe),Be=$e((d.alignTo==2?d._size-ke-d.gap:d.gap)*pe),fe=d._rotate*-ns/180,Ae=S(d._pos*pe),lt=(Ce+Be)*C,Xe=Ae+lt;v=g==
0?Xe:0,b=g==1?Xe:0;let wt=d.font[0],Tt=d.align==1?Jn:d.align==2?dr:fe>0?Jn:fe<0?dr:g==0?"center":m==3?dr:Jn,Ft=fe||g==1?"middle":m==2?"top":na;ni(wt,T,Tt,Ft);let ct=d.
font[1]*d.lineGap,vt=de.map(et=>S(a(et,$,U,X))),Pt=d._values;for(let et=0;et<Pt.length;et++){let ut=Pt[et];if(ut!=null){g==0?b=vt[et]:v=vt[et],ut=""+ut;let dn=ut.
indexOf(`
`)==-1?[ut]:ut.split(/\n/gm);for(let tt=0;tt<dn.length;tt++){let Ti=dn[tt];fe?(p.save(),p.translate(b,v+tt*ct),p.rotate(fe),p.fillText(Ti,0,0),p.restore()):p.fillText(
Ti,b,v+tt*ct)}}}J.show&&Vs(vt,J.filter(o,le,c,F,oe),g,m,Ae,Ce,be(J.width*pe,3),J.stroke(o,c),J.dash,J.cap);let $t=d.grid;$t.show&&Vs(vt,$t.filter(o,le,c,F,oe),g,
g==0?2:1,g==0?gt:at,g==0?St:st,be($t.width*pe,3),$t.stroke(o,c),$t.dash,$t.cap),B.show&&Vs([Ae],[1],g==0?1:0,g==0?1:2,g==1?gt:at,g==1?St:st,be(B.width*pe,3),B.stroke(
o,c),B.dash,B.cap)}Ve("drawAxes")}function An(c){M.forEach((d,m)=>{m>0&&(d._paths=null,c&&(s==1?(d.min=null,d.max=null):d.facets.forEach(g=>{g.min=null,g.max=null})))})}
let No=!1,Bs=!1,uo=[];function Oc(){Bs=!1;for(let c=0;c<uo.length;c++)Ve(...uo[c]);uo.length=0}function Ln(){No||(pd(ai),No=!0)}function Uc(c,d=!1){No=!0,Bs=d,c(
o),ai(),d&&uo.length>0&&queueMicrotask(Oc)}o.batch=Uc;function ai(){if(Ds&&(Ac(),Ds=!1),Mn&&(Sc(),Mn=!1),_o){if(Te(w,Jn,we),Te(w,"top",Fe),Te(w,xo,te),Te(w,ko,O),
Te(y,Jn,we),Te(y,"top",Fe),Te(y,xo,te),Te(y,ko,O),Te(f,xo,Ut),Te(f,ko,nn),h.width=$e(Ut*pe),h.height=$e(nn*pe),_.forEach(({_el:c,_show:d,_size:m,_pos:g,side:b})=>{
if(c!=null)if(d){let v=b===3||b===0?m:0,T=b%2==1;Te(c,T?"left":"top",g-v),Te(c,T?"width":"height",m),Te(c,T?"top":"left",T?Fe:we),Te(c,T?"height":"width",T?O:te),
vr(c,gn)}else pt(c,gn)}),Lo=Cn=Fs=Is=Os=Us=Gs=Ws=$s=null,rt=1,fo(!0),we!=Sn||Fe!=on||te!=Lt||O!=sn){An(!1);let c=te/Lt,d=O/sn;if(Ue&&!rn&&H.left>=0){H.left*=c,H.
top*=d,Dn&&It(Dn,$e(H.left),0,te,O),Rn&&It(Rn,0,$e(H.top),te,O);for(let m=0;m<bt.length;m++){let g=bt[m];g!=null&&(En[m]*=c,_n[m]*=d,It(g,kt(En[m]),kt(_n[m]),te,
O))}}if(xe.show&&!Co&&xe.left>=0&&xe.width>0){xe.left*=c,xe.width*=c,xe.top*=d,xe.height*=d;for(let m in Zs)Te($n,m,xe[m])}Sn=we,on=Fe,Lt=te,sn=O}Ve("setSize"),
_o=!1}Ut>0&&nn>0&&(p.clearRect(0,0,h.width,h.height),Ve("drawClear"),V.forEach(c=>c()),Ve("draw")),xe.show&&Co&&(Fo(xe),Co=!1),Ue&&rn&&(un(null,!0,!1),rn=!1),ee.
show&&ee.live&&yt&&(Ys(),yt=!1),l||(l=!0,o.status=1,Ve("ready")),co=!1,No=!1}o.redraw=(c,d)=>{Mn=d||!1,c!==!1?jt(R,A.min,A.max):Ln()};function js(c,d){let m=E[c];
if(m.from==null){if(Ke==0){let g=m.range(o,d.min,d.max,c);d.min=g[0],d.max=g[1]}if(d.min>d.max){let g=d.min;d.min=d.max,d.max=g}if(Ke>1&&d.min!=null&&d.max!=null&&
d.max-d.min<1e-16)return;c==R&&m.distr==2&&Ke>0&&(d.min=Ct(d.min,e[0]),d.max=Ct(d.max,e[0]),d.min==d.max&&d.max++),W[c]=d,Ds=!0,Ln()}}o.setScale=js;let Ks,qs,Dn,
Rn,li,ci,Nn,Fn,ui,di,ve,Ee,Bt=!1,qe=H.drag,ze=qe.x,He=qe.y;Ue&&(H.x&&(Ks=xt($u,y)),H.y&&(qs=xt(Iu,y)),A.ori==0?(Dn=Ks,Rn=qs):(Dn=qs,Rn=Ks),ve=H.left,Ee=H.top);let xe=o.
select=Re({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),$n=xe.show?xt(Fu,xe.over?y:w):null;function Fo(c,d){if(xe.show){for(let m in c)xe[m]=c[m],m in
Zs&&Te($n,m,c[m]);d!==!1&&Ve("setSelect")}}o.setSelect=Fo;function Gc(c){if(M[c].show)_e&&vr(Pe[c],gn);else if(_e&&pt(Pe[c],gn),Ue){let m=Pn?bt[0]:bt[c];m!=null&&
It(m,-10,-10,te,O)}}function jt(c,d,m){js(c,{min:d,max:m})}function Rt(c,d,m,g){d.focus!=null&&Bc(c),d.show!=null&&M.forEach((b,v)=>{v>0&&(c==v||c==null)&&(b.show=
d.show,Gc(v),s==2?(jt(b.facets[0].scale,null,null),jt(b.facets[1].scale,null,null)):jt(b.scale,null,null),Ln())}),m!==!1&&Ve("setSeries",c,d),g&&mo("setSeries",
o,c,d)}o.setSeries=Rt;function Wc(c,d){Re(K[c],d)}function zc(c,d){c.fill=ie(c.fill||null),c.dir=ce(c.dir,-1),d=d??K.length,K.splice(d,0,c)}function Hc(c){c==null?
K.length=0:K.splice(c,1)}o.addBand=zc,o.setBand=Wc,o.delBand=Hc;function Vc(c,d){M[c].alpha=d,Ue&&bt[c]!=null&&(bt[c].style.opacity=d),_e&&Pe[c]&&(Pe[c].style.opacity=
d)}let Gt,Kt,cn,In={focus:!0};function Bc(c){if(c!=cn){let d=c==null,m=Dt.alpha!=1;M.forEach((g,b)=>{if(s==1||b>0){let v=d||b==0||b==c;g._focus=d?null:v,m&&Vc(b,
v?1:Dt.alpha)}}),cn=c,m&&Ln()}}_e&&Tn&&Qe(ia,ae,c=>{H._lock||(an(c),cn!=null&&Rt(null,In,!0,Le.setSeries))});function Nt(c,d,m){let g=E[d];m&&(c=c/pe-(g.ori==1?
Fe:we));let b=te;g.ori==1&&(b=O,c=b-c),g.dir==-1&&(c=b-c);let v=g._min,T=g._max,C=c/b,D=v+(T-v)*C,F=g.distr;return F==3?Xn(10,D):F==4?ed(D,g.asinh):F==100?g.bwd(
D):D}function jc(c,d){let m=Nt(c,R,d);return Ct(m,e[0],Ge,We)}o.valToIdx=c=>Ct(c,e[0]),o.posToIdx=jc,o.posToVal=Nt,o.valToPos=(c,d,m)=>E[d].ori==0?r(c,E[d],m?st:
te,m?at:0):i(c,E[d],m?St:O,m?gt:0),o.setCursor=(c,d,m)=>{ve=c.left,Ee=c.top,un(null,d,m)};function pi(c,d){Te($n,Jn,xe.left=c),Te($n,xo,xe.width=d)}function hi(c,d){
Te($n,"top",xe.top=c),Te($n,ko,xe.height=d)}let po=A.ori==0?pi:hi,ho=A.ori==1?pi:hi;function Kc(){if(_e&&ee.live)for(let c=s==2?1:0;c<M.length;c++){if(c==0&&ne)
continue;let d=ee.values[c],m=0;for(let g in d)it[c][m++].firstChild.nodeValue=d[g]}}function Ys(c,d){if(c!=null&&(c.idxs?c.idxs.forEach((m,g)=>{ue[g]=m}):sd(c.
idx)||ue.fill(c.idx),ee.idx=ue[0]),_e&&ee.live){for(let m=0;m<M.length;m++)(m>0||s==1&&!ne)&&qc(m,ue[m]);Kc()}yt=!1,d!==!1&&Ve("setLegend")}o.setLegend=Ys;function qc(c,d){
let m=M[c],g=c==0&&Z==2?Mt:e[c],b;ne?b=m.values(o,c,d)??Ne:(b=m.value(o,d==null?null:g[d],c,d),b=b==null?Ne:{_:b}),ee.values[c]=b}function un(c,d,m){ui=ve,di=Ee,
[ve,Ee]=H.move(o,ve,Ee),H.left=ve,H.top=Ee,Ue&&(Dn&&It(Dn,$e(ve),0,te,O),Rn&&It(Rn,0,$e(Ee),te,O));let g,b=Ge>We;Gt=ye,Kt=null;let v=A.ori==0?te:O,T=A.ori==1?te:
O;if(ve<0||Ke==0||b){g=H.idx=null;for(let C=0;C<M.length;C++){let D=bt[C];D!=null&&It(D,-10,-10,te,O)}Tn&&Rt(null,In,!0,c==null&&Le.setSeries),ee.live&&(ue.fill(
g),yt=!0)}else{let C,D,F;s==1&&(C=A.ori==0?ve:Ee,D=Nt(C,R),g=H.idx=Ct(D,e[0],Ge,We),F=I(e[0][g],A,v,0));let $=-10,U=-10,X=0,de=0,le=!0,oe="",J="";for(let B=s==2?
1:0;B<M.length;B++){let ke=M[B],Ce=ue[B],Be=Ce==null?null:s==1?e[B][Ce]:e[B][1][Ce],fe=H.dataIdx(o,B,g,D),Ae=fe==null?null:s==1?e[B][fe]:e[B][1][fe];if(yt=yt||Ae!=
Be||fe!=Ce,ue[B]=fe,B>0&&ke.show){let lt=fe==null?-10:fe==g?F:I(s==1?e[0][fe]:e[B][0][fe],A,v,0),Xe=Ae==null?-10:j(Ae,s==1?E[ke.scale]:E[ke.facets[1].scale],T,0);
if(Tn&&Ae!=null){let wt=A.ori==1?ve:Ee,Tt=Ie(Dt.dist(o,B,fe,Xe,wt));if(Tt<Gt){let Ft=Dt.bias;if(Ft!=0){let ct=Nt(wt,ke.scale),vt=Ae>=0?1:-1,Pt=ct>=0?1:-1;Pt==vt&&
(Pt==1?Ft==1?Ae>=ct:Ae<=ct:Ft==1?Ae<=ct:Ae>=ct)&&(Gt=Tt,Kt=B)}else Gt=Tt,Kt=B}}if(yt||Pn){let wt,Tt;A.ori==0?(wt=lt,Tt=Xe):(wt=Xe,Tt=lt);let Ft,ct,vt,Pt,$t,et,ut=!0,
dn=Ze.bbox;if(dn!=null){ut=!1;let tt=dn(o,B);vt=tt.left,Pt=tt.top,Ft=tt.width,ct=tt.height}else vt=wt,Pt=Tt,Ft=ct=Ze.size(o,B);if(et=Ze.fill(o,B),$t=Ze.stroke(o,
B),Pn)B==Kt&&Gt<=Dt.prox&&($=vt,U=Pt,X=Ft,de=ct,le=ut,oe=et,J=$t);else{let tt=bt[B];tt!=null&&(En[B]=vt,_n[B]=Pt,ha(tt,Ft,ct,ut),da(tt,et,$t),It(tt,kt(vt),kt(Pt),
te,O))}}}}if(Pn){let B=Dt.prox,ke=cn==null?Gt<=B:Gt>B||Kt!=cn;if(yt||ke){let Ce=bt[0];Ce!=null&&(En[0]=$,_n[0]=U,ha(Ce,X,de,le),da(Ce,oe,J),It(Ce,kt($),kt(U),te,
O))}}}if(xe.show&&Bt)if(c!=null){let[C,D]=Le.scales,[F,$]=Le.match,[U,X]=c.cursor.sync.scales,de=c.cursor.drag;if(ze=de._x,He=de._y,ze||He){let{left:le,top:oe,width:J,
height:B}=c.select,ke=c.scales[U].ori,Ce=c.posToVal,Be,fe,Ae,lt,Xe,wt=C!=null&&F(C,U),Tt=D!=null&&$(D,X);wt&&ze?(ke==0?(Be=le,fe=J):(Be=oe,fe=B),Ae=E[C],lt=I(Ce(
Be,U),Ae,v,0),Xe=I(Ce(Be+fe,U),Ae,v,0),po(At(lt,Xe),Ie(Xe-lt))):po(0,v),Tt&&He?(ke==1?(Be=le,fe=J):(Be=oe,fe=B),Ae=E[D],lt=j(Ce(Be,X),Ae,T,0),Xe=j(Ce(Be+fe,X),Ae,
T,0),ho(At(lt,Xe),Ie(Xe-lt))):ho(0,T)}else Qs()}else{let C=Ie(ui-li),D=Ie(di-ci);if(A.ori==1){let X=C;C=D,D=X}ze=qe.x&&C>=qe.dist,He=qe.y&&D>=qe.dist;let F=qe.uni;
F!=null?ze&&He&&(ze=C>=F,He=D>=F,!ze&&!He&&(D>C?He=!0:ze=!0)):qe.x&&qe.y&&(ze||He)&&(ze=He=!0);let $,U;ze&&(A.ori==0?($=Nn,U=ve):($=Fn,U=Ee),po(At($,U),Ie(U-$)),
He||ho(0,T)),He&&(A.ori==1?($=Nn,U=ve):($=Fn,U=Ee),ho(At($,U),Ie(U-$)),ze||po(0,v)),!ze&&!He&&(po(0,0),ho(0,0))}if(qe._x=ze,qe._y=He,c==null){if(m){if(Mi!=null){
let[C,D]=Le.scales;Le.values[0]=C!=null?Nt(A.ori==0?ve:Ee,C):null,Le.values[1]=D!=null?Nt(A.ori==1?ve:Ee,D):null}mo(pr,o,ve,Ee,te,O,g)}if(Tn){let C=m&&Le.setSeries,
D=Dt.prox;cn==null?Gt<=D&&Rt(Kt,In,!0,C):Gt>D?Rt(null,In,!0,C):Kt!=cn&&Rt(Kt,In,!0,C)}}yt&&(ee.idx=g,Ys()),d!==!1&&Ve("setCursor")}let qt=null;Object.defineProperty(
o,"rect",{get(){return qt==null&&fo(!1),qt}});function fo(c=!1){c?qt=null:(qt=y.getBoundingClientRect(),Ve("syncRect",qt))}function fi(c,d,m,g,b,v,T){H._lock||Bt&&
c!=null&&c.movementX==0&&c.movementY==0||(Js(c,d,m,g,b,v,T,!1,c!=null),c!=null?un(null,!0,!0):un(d,!0,!1))}function Js(c,d,m,g,b,v,T,C,D){if(qt==null&&fo(!1),an(
c),c!=null)m=c.clientX-qt.left,g=c.clientY-qt.top;else{if(m<0||g<0){ve=-10,Ee=-10;return}let[F,$]=Le.scales,U=d.cursor.sync,[X,de]=U.values,[le,oe]=U.scales,[J,
B]=Le.match,ke=d.axes[0].side%2==1,Ce=A.ori==0?te:O,Be=A.ori==1?te:O,fe=ke?v:b,Ae=ke?b:v,lt=ke?g:m,Xe=ke?m:g;if(le!=null?m=J(F,le)?a(X,E[F],Ce,0):-10:m=Ce*(lt/fe),
oe!=null?g=B($,oe)?a(de,E[$],Be,0):-10:g=Be*(Xe/Ae),A.ori==1){let wt=m;m=g,g=wt}}D&&(d==null||d.cursor.event.type==pr)&&((m<=1||m>=te-1)&&(m=fn(m,te)),(g<=1||g>=
O-1)&&(g=fn(g,O))),C?(li=m,ci=g,[Nn,Fn]=H.move(o,m,g)):(ve=m,Ee=g)}let Zs={width:0,height:0,left:0,top:0};function Qs(){Fo(Zs,!1)}let mi,gi,yi,bi;function wi(c,d,m,g,b,v,T){
Bt=!0,ze=He=qe._x=qe._y=!1,Js(c,d,m,g,b,v,T,!0,!1),c!=null&&(Qe(hr,br,vi,!1),mo(sa,o,Nn,Fn,te,O,null));let{left:C,top:D,width:F,height:$}=xe;mi=C,gi=D,yi=F,bi=$}
function vi(c,d,m,g,b,v,T){Bt=qe._x=qe._y=!1,Js(c,d,m,g,b,v,T,!1,!0);let{left:C,top:D,width:F,height:$}=xe,U=F>0||$>0,X=mi!=C||gi!=D||yi!=F||bi!=$;if(U&&X&&Fo(xe),
qe.setScale&&U&&X){let de=C,le=F,oe=D,J=$;if(A.ori==1&&(de=D,le=$,oe=C,J=F),ze&&jt(R,Nt(de,R),Nt(de+le,R)),He)for(let B in E){let ke=E[B];B!=R&&ke.from==null&&ke.
min!=ye&&jt(B,Nt(oe+J,B),Nt(oe,B))}Qs()}else H.lock&&(H._lock=!H._lock,un(d,!0,c!=null));c!=null&&(kn(hr,br),mo(hr,o,ve,Ee,te,O,null))}function Yc(c,d,m,g,b,v,T){
if(H._lock)return;an(c);let C=Bt;if(Bt){let D=!0,F=!0,$=10,U,X;A.ori==0?(U=ze,X=He):(U=He,X=ze),U&&X&&(D=ve<=$||ve>=te-$,F=Ee<=$||Ee>=O-$),U&&D&&(ve=ve<Nn?0:te),
X&&F&&(Ee=Ee<Fn?0:O),un(null,!0,!0),Bt=!1}ve=-10,Ee=-10,ue.fill(null),un(null,!0,!0),C&&(Bt=C)}function xi(c,d,m,g,b,v,T){H._lock||(an(c),Ns(),Qs(),c!=null&&mo(
aa,o,ve,Ee,te,O,null))}function ki(){_.forEach(vp),Rs(o.width,o.height,!0)}yn(os,Qn,ki);let On={};On.mousedown=wi,On.mousemove=fi,On.mouseup=vi,On.dblclick=xi,On.
setSeries=(c,d,m,g)=>{let b=Le.match[2];m=b(o,d,m),m!=-1&&Rt(m,g,!0,!1)},Ue&&(Qe(sa,y,wi),Qe(pr,y,fi),Qe(ra,y,c=>{an(c),fo(!1)}),Qe(ia,y,Yc),Qe(aa,y,xi),Pr.add(
o),o.syncRect=fo);let $o=o.hooks=t.hooks||{};function Ve(c,d,m){Bs?uo.push([c,d,m]):c in $o&&$o[c].forEach(g=>{g.call(null,o,d,m)})}(t.plugins||[]).forEach(c=>{
for(let d in c.hooks)$o[d]=($o[d]||[]).concat(c.hooks[d])});let Si=(c,d,m)=>m,Le=Re({key:null,setSeries:!1,filters:{pub:ba,sub:ba},scales:[R,M[1]?M[1].scale:null],
match:[wa,wa,Si],values:[null,null]},H.sync);Le.match.length==2&&Le.match.push(Si),H.sync=Le;let Mi=Le.key,Xs=ml(Mi);function mo(c,d,m,g,b,v,T){Le.filters.pub(c,
d,m,g,b,v,T)&&Xs.pub(c,d,m,g,b,v,T)}Xs.sub(o);function Jc(c,d,m,g,b,v,T){Le.filters.sub(c,d,m,g,b,v,T)&&On[c](null,d,m,g,b,v,T)}o.pub=Jc;function Zc(){Xs.unsub(
o),Pr.delete(o),tn.clear(),xr(os,Qn,ki),u.remove(),ae?.remove(),Ve("destroy")}o.destroy=Zc;function er(){Ve("init",t,e),ei(e||t.data,!1),W[R]?js(R,W[R]):Ns(),Co=
xe.show&&(xe.width>0||xe.height>0),rn=yt=!0,Rs(t.width,t.height)}return M.forEach(Qr),_.forEach(Cc),n?n instanceof HTMLElement?(n.appendChild(u),er()):n(o,er):er(),
o}Oe.assign=Re;Oe.fmtNum=Rr;Oe.rangeNum=ss;Oe.rangeLog=as;Oe.rangeAsinh=Lr;Oe.orient=wn;Oe.pxRatio=pe;Oe.join=dd;Oe.fmtDate=Fr,Oe.tzDate=kd;Oe.sync=ml;{Oe.addGap=
sp,Oe.clipGaps=us;let t=Oe.paths={points:xl};t.linear=Sl,t.stepped=ap,t.bars=lp,t.spline=up}var fs=128,El=50,xp=.25,kp=t=>[t.ray,t.truth,t.sensor,t.noReturn],Sp=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),Mp=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),ms=(t,e)=>({font:or,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function _l(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:fs})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:fs}),s=n()),o)}function Cl(t,e){let{session:n}=t,o=x("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${El}`]],()=>s,y=>{s=y,u=null,n.changed()}),
i=0,a=-1/0,l=-1,u=null,p=_l(o,()=>{let y=kp(e()),k=Array.from({length:i},(S,P)=>({label:`chain ${P+1}`,stroke:y[P%y.length],width:1,points:{show:!1}}));return new Oe(
{width:100,height:fs,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,Mp,0,0],scales:{x:{time:!1,range:(S,P,M)=>[P,Math.max(M,P+1)]},y:{range:(S,P,M)=>Ep(
Math.max(P,a),M)}},axes:[ms(e,26),ms(e,Sp)],series:[{label:"sweep"},...k],hooks:{draw:[S=>_p(S,l,e())]}},[[],...k.map(()=>[])],o)},e),f=x("span",{className:"cap\
tion",textContent:"log joint by sweep"}),w=x("div",{className:"charted"},x("div",{className:"buttons"},r,f),o);return t.each(()=>{let y=n.shown,k=y?.traced?.length?
y.trace.length/y.traced.length:0;if(L(w,"hidden",k===0),!y||!k)return;let S=n.document?.source.kind==="run"?"draw":"sweep";L(f,"textContent",`log joint by ${S}`);
let P=y.layer==="draw"&&n.draws.count?(n.draw+1)*y.traced[y.traced.length-1]/n.draws.count:-1,M=p(k!==i&&(i=k,!0));M&&(u===y&&l===P&&M.data[0].length||([u,l]=[y,
P],a=s==="all"?Pp(y,k):-1/0,M.setData(Tp(y,k,s))))}),w}function Tp({trace:t,traced:e},n,o){let s=o==="all"?e.length:e.filter(r=>r<=El).length;return[e.slice(0,s),
...Array.from({length:n},(r,i)=>t.slice(i*e.length,i*e.length+s))]}function Pp({trace:t,traced:e},n){let o=e.length,s=e.findIndex(r=>r>=xp*e[o-1]);return Math.min(
...Array.from({length:n},(r,i)=>Math.min(...t.slice(i*o+s,(i+1)*o))))}function Ep(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function _p(t,e,n){if(e<0)return;
let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.restore())}function Al(t,e){
let{session:n}=t,o=x("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),s=x("div",{className:"caption",textContent:"partic\
les by weight, nats below the heaviest"}),r=x("div",{className:"charted"},s,o),a=_l(o,()=>new Oe({width:100,height:fs,legend:{show:!1},cursor:{show:!1},padding:[
8,10,0,0],scales:{x:{time:!1,range:(u,h,p)=>[h,p]},y:{distr:3,range:(u,h,p)=>[.5,Math.max(10,2*p)]}},axes:[ms(e,26),{...ms(e,52),values:(u,h)=>h.map(p=>p>=1?String(
p):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Oe.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),l=null;return t.each(()=>{let u=n.
shown;L(r,"hidden",!u?.weights);let h=u?.weights&&a(!1);if(!u?.weights||!h||l===u&&h.data[0].length)return;l=u;let p=[...u.weights],f=-(u.lowest??-1)/p.length,w=[
...p.map((y,k)=>(u.lowest??-1)+k*f),0];h.setData([w,[...p.map(y=>y||null),null]])}),r}function Ll(t){let{session:e,hand:n}=t,{decisions:o}=e,s=x("p",{className:"said",role:"status"}),r=x("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,u=>o.set({radius:u}),{min:.01,max:100,step:"any"}),t.numberInput("Highest risk",()=>o.risk,u=>o.set({risk:u}),{min:1e-4,max:.99,step:"any"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{L(l,"textContent",i()),L(s,"textContent",n.tool==="path"?Cp(t):Ap(t))}),a}function Cp({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${Me(
o.length_m,2)} m, free with probability ${Me(o.probability,3)} ± ${Me(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${Me(o.independent,
3)}.${r}`}function Ap({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.
nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${Me(Math.min(...e.nats),1)} to ${Me(o,1)} nats, cells taken for indepen\
dent; the best place has a ring.${s}`}var Lp=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Dp="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",Rp="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). No beam has been where it is hatched.",Np="Shown is what the readings tell about how likely each cell is to stop a beam: what is expected (m\
ean), one whole map that explains them (one draw), and how wide the 90 % interval is (width). No beam has been where it is hatched.",Fp="While you edit, the ans\
wer is belief propagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",$p="The map is made from the scans of this log. Where it\
s poses are raw odometry, Run first infers where the robot was; then it samples maps, and keeps them as draws.",Ip="This is a saved run: its draws, and what the\
y say together.",Op="Mouse: the wheel zooms, the middle button pans.",Up="Shift or the right button erases, and so does a click on a wall.",Gp="Touch: two finge\
rs zoom and pan.";function Dl(t){let{session:e}=t,n=x("div"),o=Ui.map(([i,a,l])=>{let u=x("tr",{},x("th",{scope:"row"},x("kbd",{textContent:i})),x("td",{textContent:a}));
return t.visible(u,()=>Wp[l??"all"](e)),u}),s=x("p"),r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?Np:Rp,l=e.editable?[`${Dp} ${a}`,
Fp]:i==="log"?[a,$p]:i==="run"?[a,Ip]:[a];l.join()!==r&&n.replaceChildren(...l.map(u=>x("p",{textContent:u}))),r=l.join(),L(s,"textContent",[Op,...e.editable?[Up]:
[],Gp].join(" "))}),t.dialog("Help",n,s,x("table",{},x("tbody",{},...o)))}var Wp={all:()=>!0,drawn:t=>t.editable,asked:t=>!t.recorded,inferred:t=>!t.recorded&&t.
document?.source.kind!=="run"};function Rl(t){let e=()=>x("input",{type:"number",min:Se.cells[0],max:Se.cells[1],step:1,required:!0,value:"21"}),[n,o]=[e(),e()],
s=x("select",{});for(let[i,a]of Lp)s.append(x("option",{value:i,textContent:a}));s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<60&&([n.
value,o.value]=["120","80"])});let r=x("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),x("div",{className:"buttons \
end"},x("button",{type:"submit",className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),
Number(o.value)],world:s.value}),t.hand.selected=null}),t.dialog("New map",r)}var zp="The link holds the walls, the sensors and all settings after its #, and no\
 token. It opens in this browser while the server runs; the part from # on can be put after the address of any bayesmap page.",Hp="The link holds the file's nam\
e and all settings after its #, but no scans and no token. It opens in this browser while the server shows this file; the part from # on can be put after the ad\
dress of any bayesmap page that shows it.";function Nl(t){let e=x("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=x("span",{role:"status",className:"co\
pied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent=
"",2e3)},s=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),r=x("p");t.each(()=>L(r,"textContent",t.session.document?.source.kind==="simulatio\
n"?zp:Hp));let i=t.dialog("Share",r,x("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var vn=t=>t.charAt(0).toUpperCase()+t.slice(1),gs=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=vn(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var Fl=t=>Math.round(t*180/Math.PI);function $l(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(l,u)=>t.numberInput(l,()=>Number((o.pose?.[u]??0).toFixed(2)),h=>o.move(
{[u]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>Fl(o.pose?.yaw??0),l=>o.move({yaw:l*Math.PI/180}),{step:5}),i=x("p",{className:"words ghosted"}),a=t.
section("Ghost",x("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>L(i,"textContent",Vp(t))),
a}function Vp({session:t}){let{ghost:e}=t;if(e.trouble)return vn(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(h,p)=>h-o[p]).filter(Number.isFinite).sort((h,p)=>h-p),a=i.length?`${Me(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",u=r?` \
Rings are the hits of scan ${r.index+1}, taken ${Me(100*r.away,0)} cm from here, turned by ${Fl(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${u}`}function Il(t){let{session:e}=t,n=x("span",{className:"what"});t.each(()=>{let{grid:u,source:h}=e.document??{};if(!u||!h)return;let p=`${u.shape[0]} × ${u.shape[1]}\
 cells of ${+u.resolution.toPrecision(3)} m`;L(n,"textContent",h.name?`${h.name}, ${p}`:p)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),x("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let u of s)t.visible(u,()=>!e.recorded);let r=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=x("span",{className:"space"});return{element:x("header",{},x("h1",{textContent:"bayesmap"}),n,a,...s,jp(t),r,
i),nameTheme(u){let h=`Theme: ${u}`;dt(r,"aria-label",h),L(r,"title",h)}}}var Bp=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function jp(t){
let{session:e}=t,n=(a,l,u,h)=>{let p=t.button(null,a,()=>t.command(`export ${l}`),{text:a,when:h});return u&&t.visible(p,()=>!e.recorded),p},o=x("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>Bp(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),s=t.button("save","Export",()=>r(o.hidden),{text:"Export",when:()=>!!e.document}),r=a=>{o.hidden=!a,s.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};r(!1);let i=x("div",{className:"anchor"},s,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(r(!1),s.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||r(!1)}),o.addEventListener("click",()=>{r(!1),s.
focus()}),i}var Kp={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 1\
1h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.\
5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7\
.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.\
5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function en(t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg"),n=document.createElementNS(
"http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true"),n.setAttribute("d",Kp[t]),e.append(n),e}var ys=[["truth","true wall"],["ray","ray"],["miss","no return"],["dot","reading"],["sensor","sensor"],["stroke","surface"],["trajectory","trajectory"],["draw",
"this draw"],["ghost","predicted reading"],["belief","possible pose"],["place","95 % of a place"],["path","path, as wide as the robot"],["unobserved","unobserve\
d"]];function Ol(t,e){let{session:n}=t,o=x("span",{className:"ramp"}),s=x("span"),r=ys.map(([l,u])=>{let h=x("i",{className:l});return l==="sensor"&&h.append(en(
"sensor")),x("li",{},h,u)});t.visible(r[0],()=>!n.document||n.document.source.kind==="simulation"),t.visible(r[ys.findIndex(([l])=>l==="stroke")],()=>!!n.overlay?.
strokes.length),t.visible(r[ys.findIndex(([l])=>l==="trajectory")],()=>!!n.overlay?.trajectory.length);let i=l=>r[ys.findIndex(([u])=>u===l)];t.visible(i("draw"),
()=>!!n.flicker.under),t.visible(i("ghost"),()=>n.ghost.held||n.reading.picked!==null),t.visible(i("belief"),()=>!!n.where.found),t.visible(i("place"),()=>!!n.where.
found),t.visible(i("path"),()=>!!n.decisions.path),t.each(()=>i("path").firstElementChild?.classList.toggle("risky",n.decisions.path?.within_risk===!1));let a="";
return t.each(()=>{let{layer:l}=n,{kind:u,mean:h,value:p}=n.quantity;L(s,"textContent",l==="entropy"?"entropy (bit)":l==="width"?"width of the 90 % interval":u===
"binary"?"P(wall)":l==="draw"?p:h);let w=l==="entropy"||l==="width",y=`${w} ${e().ground}`;a!==y&&(a=y,o.style.background=ar(w?Wn:k=>ir(e(),k)))}),x("ul",{className:"\
legend","aria-label":"Legend"},x("li",{},s,"0",o,"1"),qp(t),...r)}function qp(t){let{decisions:e}=t.session,n=x("span",{className:"ramp"});n.style.background=ar(
Wn);let[o,s]=[x("span"),x("span")],r=x("li",{className:"views"},"one more scan tells",o,n,s);return t.visible(r,()=>e.looking&&!!e.views?.nats.length),t.each(()=>{
let i=e.views?.nats;i?.length&&(L(o,"textContent",Me(Math.min(...i),1)),L(s,"textContent",`${Me(Math.max(...i),1)} nats`))}),r}var Yp=[.05,.1,.2,.4,.8],Jp=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function Ul(t){let{session:e}=t,n=x("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,u=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...Yp,r.resolution])].sort((p,f)=>p-f);if(o!==h.join()){o=h.join();let p=f=>x("option",{value:String(f),textContent:Jp(f),
disabled:u/f>Se.side_of_log-1});n.replaceChildren(...h.map(p))}L(n,"value",String(r.resolution))});let s=t.row("Cell size",n);return t.visible(s,()=>e.document?.
source.kind==="log"),s}function Gl(t){let{session:e}=t,n=x("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),o=x("output"),s=()=>e.document?.source.
scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=s()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});let i=t.
section("Log",x("div",{className:"player bare"},n,o));return t.visible(i,()=>e.document?.source.kind==="log"&&s()>1),t.each(()=>{let a=s(),l=e.document?.scans_used??
a;L(n,"max",String(Math.max(1,a))),(!hn(n)||Number(n.value)!==l)&&L(n,"value",String(l));let u=l===a?`all ${a} scans`:`after ${l} of ${a}`;n.style.setProperty("\
--fill",`${100*(l-1)/Math.max(1,a-1)}%`),dt(n,"aria-valuetext",u),L(o,"textContent",u)}),i}var Zp="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.";function Hl(t){
let{session:e}=t,n=x("span",{className:"chip"}),o=t.button(null,"Not converged",()=>Wl(e)?.apply(),{text:"Not converged",className:"chip doubt"}),s=x("div",{className:"\
chips"},n,o);return t.each(()=>{let r=Wl(e);L(o,"hidden",!r),r&&(L(o.firstElementChild,"textContent",`not converged: ${r.text}`),L(o,"title",`${e.shown?.verdict?.
why}. Click to ${r.text}.`),dt(o,"aria-label",`Not converged: ${r.text}`));let i=e.shown;if(!i||!e.document)return L(s,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",l=i.layer==="draw"?a+(e.flicker.under?" over the mean":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="en\
tropy"?"entropy":"mean";if(i.method==="counts"){L(s,"hidden",!1);let p=e.halfway?"along poses found so far":"along raw odometry";return L(n,"textContent",`hits \
and passes · ${e.stage?e.stage.text.toLowerCase():p}`),L(n,"className","chip approximate")}let u={importance:"importance sampling",propagate:"belief propagatio\
n"}[i.method],h=i.approximate?`approximate, ${Qp(i,e.working)}`:u??`${i.sweeps} sweeps`;L(s,"hidden",!1),L(n,"textContent",`${l} · ${h}`),L(n,"className",i.approximate?
"chip approximate":"chip")}),s}function Qp({method:t,sweeps:e,total:n,averaged:o},s){return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${o===
1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} of ${n}`}function Wl(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="b\
ad"||!n||t.recorded||n.source.kind==="run")return null;let o=r=>()=>t.act({type:"set",patch:r});if(e.method==="gibbs"&&n.source.kind==="simulation")return{text:"\
try blocks",apply:o({method:"block"})};if(e.method==="importance")return{text:"try Gibbs",apply:o({method:"auto"})};if(t.sampling)return null;let s=Math.min(Se.
sweeps[1],4*n.sweeps);return s>n.sweeps?{text:`try ${s} sweeps`,apply:o({sweeps:s})}:null}function Vl(t){let{session:e}=t,n=x("span"),o=t.button(null,"Reconnect\
 now",()=>e.transport.retry?.(),{text:"Reconnect now"}),s=x("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.
connection.connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??0)/1e3));L(s,"hidden",!r&&e.worker!=="restarted"),L(s,"className",r?"banner":"banner mild"),
L(o,"hidden",!r);let a=`Connection lost. Trying again in ${i} s; the map is kept here.`,l=e.connection.refused?Zp:a;L(n,"textContent",r?l:"The worker stopped an\
d is being started again. The map is kept.")}),s}function Bl(t){let{session:e,hand:n}=t,o=x("div",{className:"readout",id:`${t.prefix}-readout`}),s=x("span",{role:"\
status","aria-live":"polite"}),r=x("span",{className:"hidden","aria-live":"polite"});return n.announce=i=>L(r,"textContent",i),n.describe=i=>zl(e,i),t.each(()=>{
let i=n.cursor??n.hover,l=matchMedia("(pointer: coarse)").matches?"Touch a cell":e.editable?"Point at a cell, or press ? for the keys":"Point at a cell";L(o,"te\
xtContent",i?zl(e,i):l);let u=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad";L(s,"textContent",u?"Ready, but the chains have not converged":e.status.text),
L(s,"className",u?"warning":e.status.level)}),{element:x("footer",{},s,o,r),readout:o}}function zl(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,
shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+1),{x:l,y:u}=Un(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${u.toFixed(a)} m`];if(o&&
o.p.length===r[0]*r[1]){let p=o.p[i]/255,{kind:f,mean:w,value:y,interval:k}=t.quantity;o.layer==="width"?h.push(`90 % interval ${p.toFixed(2)} wide`):f!=="binar\
y"&&o.layer==="draw"?h.push(`${y} ${p.toFixed(2)} in this draw`):f!=="binary"?h.push(`${w} ${p.toFixed(2)}`,...k?[]:[`entropy ${yo(p).toFixed(2)} bit`]):o.layer===
"draw"?h.push(p>.5?"wall in this draw":"free in this draw"):h.push(`P(wall) ${p.toFixed(2)}`,`entropy ${yo(p).toFixed(2)} bit`);let S=t.cell?.x===e.x&&t.cell.y===
e.y?t.cell:null,P=S?S.beams:null;o.observed[i]?P!==null&&h.push(P===1?"1 beam":`${P} beams`):h.push("unobserved"),o.observed[i]&&S?.nats_for!==void 0&&S.nats_against!==
void 0&&P&&h.push(`for a wall ${S.beams_for}, ${S.nats_for.toFixed(1)} nats`,`against ${S.beams_against}, ${S.nats_against.toFixed(1)} nats`)}return h.join(" · ")}var Xp={logged:"as logged",odometry:"from raw odometry"},eh=180/Math.PI;function jl(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
Xp,()=>e.document?.poses??"logged",p=>t.set({poses:p}));o.classList.add("wide"),t.visible(o,n);let[s,r]=Se.pose_sigma,[i,a]=Se.heading_sigma_deg,l=[t.slider("po\
se_sigma",()=>"Position ±",{low:s,high:r,step:.05,unit:" m"}),t.slider("heading_sigma",()=>"Yaw ±",{low:i,high:a,step:.5,unit:"°",scale:eh})];for(let p of l)
t.visible(p,()=>e.editable);let u=x("p",{className:"caption"});t.each(()=>{let{pose_sigma:p=0,heading_sigma:f=0,method:w="auto"}=e.document??{},y=n()&&e.document?.
poses==="odometry"&&e.shown?.method==="counts"&&!e.running,k=e.editable&&(p>0||f>0)&&!/auto|gibbs|block/.test(w);L(u,"hidden",!k&&!y),L(u,"textContent",y?"Run i\
nfers where the robot was.":"This method takes poses as known; Gibbs does not.")});let h=t.section("Where the robot was",o,...l,u);return t.visible(h,()=>e.editable||
n()&&!e.recorded),h}var th=20,nh={importance:"particles",propagate:"rounds"};function Kl(t,...e){let{session:n}=t,o=x("progress",{max:1,value:0,"aria-label":"Progress"}),s=x("div",
{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.source.kind==="log"),l=r?.method==="pi\
lot"&&n.working,u=i?i.done/i.of:r&&!a&&r.total>0&&(l||!r.approximate)?r.sweeps/r.total:0;L(o,"value",u);let h=n.remaining_s(),p=nh[r?.method??""]??"sweeps",f=r&&
!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${p}`:"",w=h!==null?h<1?"less than 1 s left":`${Math.ceil(h)} s left`:n.running?"running":"",y=n.sampling||n.
running||!r||r.sweeps>=r.total?"":"stopped";i?L(s,"textContent",`${i.text}: ${i.done} of ${i.of} ${i.of>th?"scans":"rounds"}`):a?L(s,"textContent","Computing"):
l?L(s,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):L(s,"textContent",vn([f,w,f&&y].filter(Boolean).join(", "))||oh(n))}),t.section("Post\
erior",sh(t),o,s,rh(t),ih(t),...e)}function oh({shown:t,working:e}){return t?.method==="counts"?"Run infers where the robot was":t?.method==="pilot"?"Stopped wh\
ile the sensor was fitted":e?"Computing":"No chain yet"}function sh(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"primary",text:"\
Run",title:"Run (R)",when:()=>e.connection.connected}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.
running||e.sampling||e.working&&e.shown?.method==="pilot"}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the \
chain"),r=x("div",{className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function rh(t){let{session:e}=t,n=x("dl"),
o=(s,r,i,a=!1)=>{let l=x("dd",{textContent:"–"});n.append(x("div",{title:r},x("dt",{textContent:s}),l)),t.each(()=>{L(l,"textContent",e.shown?i(e.shown):"–"),
a&&L(l,"className",e.shown?.verdict?.level??"")})};return o("ESS","Effective sample size of the log joint",s=>Me(s.ess,0),!0),o("R-hat","Agreement of the chains\
 on the log joint; 1 is full",s=>Me(s.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",s=>Me(s.log_joint,Math.abs(s.log_joint??0)<1e5?
1:0)),o("reply","From the hand's last move to its picture",()=>Me(e.latency.eventToPaint_ms.at(-1),0," ms")),n}function ih(t){let{session:e}=t,n=x("div",{className:"\
verdict"});return t.each(()=>{let o=e.shown?.verdict;if(L(n,"hidden",!o),!o)return;let s={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];
L(n,"textContent",`${s}: ${o.why}`),L(n,"className",`verdict ${o.level}`)}),n}var bs=t=>Math.abs(t)<.995?`${Me(100*Math.abs(t),1)} cm`:`${Me(Math.abs(t),2)} m`,ah="Point at a reading to compare it with what the posterior predicts of it.";
function ql(t){let{session:e}=t,n=x("p",{className:"words reading",role:"status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.
document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i}=e.reading,a=s?`Beam ${s.beam+1} of scan ${s.scan+1}.`:ah;L(n,"textContent",i||
(r?lh(r):a))}),o}function lh({scan:t,beam:e,reading:n,range:o,low:s,median:r,high:i,residual:a,no_return:l,wall:u}){let h=`Beam ${e+1} of scan ${t+1}`,p=(P,M)=>P===
null?M:`${Me(P,2)} m`,f=`median ${p(r,"no return")}, 80 % between ${p(s,"too close")} and ${p(i,"no return")}`;if(n==="none")return`${h} came back from nothing,\
 which was predicted with probability ${Me(l??0,3)} (${f}).`;if(n!=="hit"||o===null)return`${h} read nothing that says how far (${f}).`;let w=a===null?"":`, ${bs(
a)} ${a<0?"shorter":"longer"} than the predicted median`,y=`${h} read ${Me(o,2)} m${w} (${f}).`;if(!u)return y;let k=`${bs(u.across_m)} ${u.across_m<0?"behind":
"in front of"} the wall, which is ${bs(u.thickness_m)} thick`,S=`${bs(u.along_m)} to the ${u.along_m<0?"right":"left"} along it from the middle of its surface`;
return`${y} It ended ${k} (one standard deviation), and ${S}; the beam met it at ${Me(u.incidence_rad*180/Math.PI,0)}° from its normal.`}var ch={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},uh={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},dh={noisy:"with noise",exact:"exact"},ph={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},hh={raster:"raster",radial:"radial",random:"random"},ws=2*Math.PI,fh=t=>Math.round(t*1800/Math.PI)/10,mh={importance:"Particles",propagate:"Round\
s"};function Yl(t){let{session:e,hand:n,editor:o}=t,s=x("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let p=e.document?.sensors??[],f=p.map(w=>w.id).join();f!==r&&s.replaceChildren(...p.map(({id:w})=>x("option",{value:String(
w),textContent:`Sensor ${w}`}))),r=f,L(s,"value",String(n.sensor?.id??""))});let i=(p,f)=>t.numberInput(p,()=>Number((n.sensor?.[f]??0).toFixed(2)),w=>n.sensor&&
o.moveSensor(n.sensor,{[f]:w}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),p=>n.sensor&&o.moveSensor(n.sensor,{yaw:p%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),u=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.document?.fov??ws)<ws);let h=x("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),
a);return t.section("Sensors",x("div",{className:"buttons"},s,l,u),h)}function Jl(t){let{session:e}=t,[n,o]=Se.max_range,[s,r]=Se.fov_deg,i=t.numberInput("Longe\
st range (m)",()=>e.document?.max_range??0,p=>t.set({max_range:p}),{min:n,max:o,step:"any"}),a=[t.slider("noise",()=>"Noise (m)",{low:Se.noise[0],high:Se.noise[1],
step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{low:Se.angles[0],high:Se.angles[1],step:1,log:!0}),i,t.numberInput("Field of view (°)",()=>fh(e.document?.
fov??ws),p=>t.set({fov:p>=r?ws:p*Math.PI/180}),{min:s,max:r,step:5}),t.select("Readings",dh,()=>e.document?.readings??"noisy",p=>t.set({readings:p}))];for(let p of a)
t.visible(p,()=>e.editable);let l=t.slider("prior",()=>"Prior P(wall)",{low:Se.prior[0],high:Se.prior[1],step:.01}),u=()=>(e.document?.cells??"binary")==="binar\
y";t.visible(l,u);let h=t.select("Cells",uh,()=>e.document?.cells??"binary",p=>t.set({cells:p}));return t.visible(h,()=>e.document?.source.kind==="log"),t.section(
"Model",h,Ul(t),l,...a)}function Zl(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>(e.document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.
test(n()),[r,i]=Se.seed,a=[t.select("Method",ch,n,l=>t.set({method:l})),t.select("Order",hh,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||
n()==="auto"),t.select("Start",ph,()=>e.document?.start??"auto",l=>t.set({start:l}),s)];for(let l of a)t.visible(l,o);return t.section("Inference",...a,t.slider(
"sweeps",()=>mh[n()]??"Sweeps",{low:Se.sweeps[0],high:Se.sweeps[1],step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{
min:r,max:i,step:1}))}function Ql(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),
o=t.button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",x("d\
iv",{className:"buttons"},n,o))}var gh=0,vs=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${gh++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}visible(e,n){this.each(()=>L(e,"hidden",!n()))}button(e,n,o,{
className:s="",text:r="",when:i,title:a}={}){let l=x("button",{type:"button",className:s,title:a??n,onclick:o},e&&en(e));return r&&l.append(x("span",{textContent:r})),
r!==n&&l.setAttribute("aria-label",n),i&&this.each(()=>L(l,"disabled",!i())),l}segmented(e,n,o,s,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=x("div",{className:"\
segmented",role:"radiogroup","aria-label":e});for(let[l,u,h]of n){let p=x("input",{type:"radio",name:i,value:l,onchange:()=>s(l)});a.append(x("label",{title:u},
p,h?en(h):null,x("span",{textContent:u}))),this.each(()=>{L(p,"checked",o()===l),r&&L(p,"disabled",!r(l))})}return a}section(e,...n){let o=`${this.prefix}-${e.replace(
/\W/g,"")}`;return x("section",{"aria-labelledby":o},x("h2",{id:o,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,x("div",{className:"\
row"},x("label",{for:n.id,textContent:e}),n)}slider(e,n,{low:o,high:s,step:r,log:i=!1,unit:a="",scale:l=1}){let u=`${this.prefix}-${e}`,h=S=>i?1e3*Math.log(S/o)/
Math.log(s/o):S,p=S=>{if(!i)return S;let P=o*(s/o)**(S/1e3),M=P<100?1:10**(Math.floor(Math.log10(P))-1);return se(Math.round(P/M)*M,o,s)},f=()=>l===1?this.session.
document?.[e]??o:Number(((this.session.document?.[e]??o/l)*l).toFixed(3)),w=x("label",{for:u}),y=x("input",{type:"range",id:u,...i?{min:0,max:1e3,step:1}:{min:o,
max:s,step:r}}),k=x("input",{type:"number",min:String(o),max:String(s),step:String(r)});return y.addEventListener("input",()=>this.set({[e]:p(Number(y.value))/l})),
y.addEventListener("change",()=>this.endDrag()),k.addEventListener("change",()=>{let S=Number(k.value);k.value===""||!Number.isFinite(S)?k.value=String(f()):this.
set({[e]:i?Math.round(se(S,o,s)):se(S,o,s)/l}),this.endDrag()}),this.each(()=>{let S=f();L(w,"textContent",n()),dt(k,"aria-label",`${n()}, number`),p(Number(y.value))!==
S&&(y.value=String(h(S))),dt(y,"aria-valuetext",`${S}${a}`);let P=100*(h(S)-Number(y.min))/(Number(y.max)-Number(y.min));y.style.setProperty("--fill",`${se(P,0,
100)}%`),hn(k)||L(k,"value",String(S))}),x("div",{className:"row slider"},w,y,k)}select(e,n,o,s,r){let i=x("select",{onchange:()=>s(i.value)});for(let[a,l]of Object.
entries(n))i.append(x("option",{value:a,textContent:l}));return this.each(()=>{L(i,"value",o()),r&&L(i,"disabled",!r())}),this.row(e,i)}numberInput(e,n,o,s={}){
let r=x("input",{type:"number",...s}),{min:i=-1/0,max:a=1/0}=s;return r.addEventListener("change",()=>{r.value!==""&&Number.isFinite(Number(r.value))&&o(se(Number(
r.value),i,a))}),this.each(()=>{hn(r)||L(r,"value",String(n()))}),this.row(e,r)}checkbox(e,n,o,s=""){let r=x("input",{type:"checkbox",onchange:()=>o(r.checked)});
return this.each(()=>L(r,"checked",n())),x("label",{className:"check",title:s},r,x("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(
/\W/g,"")}`,s=x("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},en("close")),r=x("div",{className:"title"},x("h2",{id:o,textContent:e}),
s),i=x("dialog",{"aria-labelledby":o},r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),
i}};var yh=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],bh={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},xs=class{constructor(e){
this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.session.act({type:"\
view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,
draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,e&&s.wantsMean?this.session.act({type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.
showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?0:n),this.session.changed()}over(e){let{flicker:n,view:o}=this.session;n.on=e,e&&!n.wantsMean&&o.
layer!=="draw"?this.showLayer("draw"):e&&n.wantsMean&&(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.chain})),this.session.changed()}playFromStart(){
this.showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.
wantsMean)return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:o,draws:s}=this.
session;o+1>=s.count&&n.on?this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function Xl(t,e,n){let{session:o}=t,s=t.segmented(
"Show",yh,()=>o.view.layer,f=>e.showLayer(f),f=>f!=="draw"||o.hasDraws),[,,r,i]=Array.from(s.children);L(i,"title","Width of each cell's 90 % interval"),t.visible(
r,()=>!o.quantity.interval),t.visible(i,()=>o.quantity.interval);let a=(f,w)=>t.checkbox(f,()=>n[w],y=>{n[w]=y,o.changed()}),l=a("True walls","truth");t.visible(
l,()=>!o.document||o.document.source.kind==="simulation");let[u,h]=[a("Surfaces","strokes"),a("Trajectory","trajectory")];t.visible(u,()=>!!o.overlay?.strokes.length),
t.visible(h,()=>!!o.overlay?.trajectory.length);let p=x("div",{className:"checks",role:"group","aria-label":"Marks"},l,a("Rays","rays"),a("Readings","readings"),
u,h);return t.section("View",s,wh(t,e),p)}function wh(t,e){let{session:n}=t,o=x("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener(
"input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1}),r=x("output"),i=x(
"select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:p,count:f}=n.draws;L(o,"max",String(
Math.max(0,f-1))),L(o,"disabled",f===0),L(o,"value",String(n.draw));let w=f?`${n.draw+1} of ${f}`:"none kept";dt(o,"aria-valuetext",w),o.style.setProperty("--fi\
ll",`${f>1?100*n.draw/(f-1):0}%`),L(r,"textContent",w),i.length!==Math.max(1,p)&&i.replaceChildren(...Array.from({length:Math.max(1,p)},(k,S)=>x("option",{value:String(
S),textContent:`chain ${S+1}`}))),L(i,"value",String(n.view.chain)),L(i,"disabled",p<2),f<2&&e.playing&&e.play(!1);let y=n.flicker.still?"Next draw":e.playing?"\
Pause the draws":"Play the draws";s.getAttribute("aria-label")!==y&&(s.setAttribute("aria-label",y),s.replaceChildren(en(e.playing?"pause":"play")))});let a=x("\
select",{"aria-label":"Speed"});for(let[p,f]of Object.entries(bh))a.append(x("option",{value:p,textContent:f}));a.value=String(e.drawsPerSecond),a.addEventListener(
"change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1});
t.each(()=>L(a,"disabled",n.draws.count<2||n.flicker.still));let u=t.checkbox("Draws over the mean",()=>n.flicker.on,p=>e.over(p),"Each draw in its own colour o\
ver the mean, as one of the maps that the scans leave possible");t.visible(u,()=>n.draws.count>1);let h=x("div",{className:"wide"},u);return x("div",{className:"\
player"},s,o,r,x("div",{className:"buttons wide"},i,a,l),h)}function ec(t){let{session:e}=t,n=x("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),
o=x("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.section("Scan",x("div",{className:"player bare"},n,o));return t.
each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;L(s,"hidden",r<2),L(n,"max",String(Math.max(0,r-1))),hn(n)||L(n,"value",String(
e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),L(o,"textContent",`${Number(n.value)+1} / ${r}`)}),s}var nc=2,tc=6,vh=.5,xh=.005;function oc(t){let{session:e,hand:n}=t,o=x("p",{className:"whereabouts",role:"status"}),s=x("p",{className:"caption"}),r=t.section("\
Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),L(o,"textContent",kh(t)),L(s,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function kh({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>vh?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>xh?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${o}${Sh(e.modes)}${Mh(e,t.editable)}${s}`}function Sh(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>nc,o=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${zr(e.mean[2],0)}`,s=`known to ${Hr(e.sigma_m)} and ${zr(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${Hr(e.sigma_m)} apart.`:`One place: ${o}, ${s}.`;let r=t.slice(0,tc).map(({probability:a})=>cr(a)),i=t.length>tc?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${o}, ${s}.`}function Mh({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>nc)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the l\
ikeliest":`the ${Th(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${Hr(o[s])} and ${zr(r,1)} from ${i}.`}var Th=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,zr=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,Hr=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function sc(t,e,n){let{shown:o,status:s}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:o&&{generation:o.generation,layer:t.layer,approximate:o.
approximate,sweeps:o.sweeps,method:o.method,quantity:t.quantity,rhat:o.rhat,verdict:o.verdict,trace:o.trace,traced:o.traced,weights:o.weights,ess:o.ess,chain:o.
chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{
text:s.text,level:s.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:Ph(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.
draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.
transform}}}function Ph({ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.near&&{...o.near}}}}var rc="bayesmap-token",Vr="bayesmap-kept";function Eh(t){try{return localStorage.getItem(t)}catch{return null}}function Br(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function jr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Br(Vr,JSON.stringify(t))}function ic(){
Br(Vr,null)}function ac(){let t=Eh(Vr);try{return t&&JSON.parse(t)}catch{return null}}function lc(t){t&&Br(rc,t)}function cc(t){let e=n=>{n.key===rc&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var uc=new Set(["walls","sensor","set","view","live"]);function dc(t,e){let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*
s+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type===
"view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let r=n.sensors.find(i=>i.id===e.id);r&&Object.
assign(r,{x:e.x,y:e.y,yaw:e.yaw})}}var _h=t=>vn(`${t.replace(/^(plan|path|explore): /,"")}.`),ks=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.
session.changed())}forget(){this.start=this.goal=this.path=this.views=null,this.askedPath=this.askedViews="",this.version++}ask(){let{session:e,start:n,goal:o,radius:s,
risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&
!i.approximate&&l!==this.askedPath&&(this.askedPath=l,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.
method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let o=e.type==="undecided"?_h(e.text):"";e.of==="views"||e.type===
"views"?this.viewTrouble=o:this.trouble=o,e.type==="path"&&(this.path=e),e.type==="views"&&this.looking&&(this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}),
e.type==="undecided"&&e.of==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<
n.nats.length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,s]=[r,i])}return o}};var Ch="(prefers-reduced-motion: reduce)",Ss=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(Ch).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var Ah=2e3,Lh=3e3,Dh=2,Ms=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&pn(e,n.document.
grid);(!o||!Yt(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
e.recorded||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>Ah&&(this.waiting=0),this.waiting>=Dh)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Lh;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:u}=n,h=e.near&&{...e.near,pose:a,ranges:l,hit:u},{x:p,y:f,yaw:w,generation:y,draws:k,coarse:S,milliseconds:P}=e;this.fan={x:p,y:f,yaw:w,generation:y,draws:k,
coarse:S,milliseconds:P,angles:o,low:s,median:r,high:i,near:h},this.answers++}else this.fan=null;this.version++,this.ask()}};var Ts=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var Ps=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Es=class{constructor(e){this.session=e}picked=null;found=null;trouble="";version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.kind!==
"simulation"&&!o.recorded,r=e&&s&&o.scan?Rh(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=r,
this.found=null,this.trouble="",this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>o.act({type:"beam",scan:r.scan,beam:r.beam}),120)),
o.changed())}forget(){this.picked&&(clearTimeout(this.timer),this.picked=this.found=null,this.version++)}receive(e){let n=e;e.type==="undecided"?this.trouble=e.
text:n.beam===this.picked?.beam&&n.scan===this.picked.scan&&(this.found=n),this.version++}};function Rh({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)
return null;let l={x:e[0],y:e[1]},[u,h]=[-1,1/0];for(let p=0;p<n.length;p++){let[f,w]=[Math.cos(e[2]+n[p]),Math.sin(e[2]+n[p])],[y,k]=[r.x-l.x,r.y-l.y],S=y*f+k*
w,P=s[p]?o[p]:a,M=s[p]?Math.hypot(y-P*f,k-P*w):1/0,_=S>0&&S<P?Math.abs(y*w-k*f):1/0,E=Math.min(M,i/2+2*_);E<h&&([u,h]=[p,E])}return h<i?{scan:t,beam:u,from:l,angle:e[2]+
n[u]}:null}var _s=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble??"";let{pose:o,weight:s}=n,{modes:r=[]}=e,i=r.filter(({probability:a},l)=>l===0||a>=.005);this.found=this.trouble?null:
{...e,modes:i,cloud:o,weight:s},this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||e.recorded||e.worker!=="ready"||e.editable&&n.generation!==e.
generation)return;let s=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.
asked||this.waitingSince&&i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:
{type:"where"}))}};var Nh=new Set(["inspect","path","views","where","ghost","beam"]),Cs=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;cell=null;lastStage=null;worker="starting";recorded=!1;generation=-1;acted=0;decisions=new ks(
this);where=new _s(this);ghost=new Ms(this);reading=new Es(this);flicker=new Ss(this);status=new gs;progress=new Ps;latency=new Ts;counts={paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={
text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){
return!this.recorded&&this.document?.source.kind==="simulation"}get running(){return this.connection.connected&&!!this.state?.running}get working(){return this.
connection.connected&&!!this.state?.working}get layer(){let e=this.shown?.layer;return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entropy":"mean"}get stage(){
return this.running&&this.shown?.method==="counts"?this.lastStage:null}get halfway(){return this.lastStage?.generation===this.shown?.generation}get draws(){return this.
state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(0,this.draws.
count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.
test(this.document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;let o={...e,seq:++this.
seq};Nh.has(e.type)||(this.acted=this.seq),uc.has(e.type)&&(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.
send(o):this.everConnected&&jr(this.portableDocument()),this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){
return this.packed.version!==this.wallsVersion&&(this.packed={version:this.wallsVersion,text:Io(Pi(this.walls))}),this.document&&{...this.document,walls:this.packed.
text}}portableDocument(){let e=this.effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.
shown=this.next,this.next=null,this.flicker.take(this.shown),!0)}painted(){this.counts.paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.
reported&&!this.recorded&&this.transport.send({type:"painted",generation:e}),this.reported=e,this.decisions.ask(),this.ghost.ask()}get quantity(){return this.shown?.
quantity??{kind:"binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){
if(this.connection=e,e.connected){let n=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(n),this.view.layer!==
"mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.text,this.notice.level),
this.everConnected=!0}else this.everConnected&&(this.say("Connection lost","error"),jr(this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"\
welcome":this.generation=this.reported=-1,this.recorded=!!e.recorded,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":
if(e.generation>=this.generation){let{pose:o,angles:s,ranges:r,exact:i,hit:a}=n;this.scan?.index!==e.index&&this.reading.forget(),this.scan={ids:e.ids??[],index:e.
index??null,pose:o,angles:s,ranges:r,exact:i,hit:a}}break;case"overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=
e;break;case"where":this.where.receive(e,n);break;case"cell":this.cell=e;break;case"path":case"views":case"ghost":case"beam":case"undecided":this.receiveAnswer(
e,n);break;case"status":this.status.say(e.text,e.level??"info",this.acted);break;case"error":this.receiveError(e);break;case"worker":this.worker=e.state,this.status.
worker(e.state);break;case"download":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveAnswer(e,n){
let o=e.type==="undecided"?e.of:e.type;o==="ghost"?this.ghost.receive(e,n):o==="beam"?this.reading.receive(e):this.decisions.receive(e,n)}receiveError(e){let n=e.
refused?.seq??null,o=n!==null&&n===this.broughtAt;o&&(this.broughtAt=null,this.act({type:"hello"}));let s=[e.text,e.remedy].filter(Boolean).join("; ");this.status.
say(o?`The map that was brought along cannot be shown: ${s}`:s,"error",this.acted),this.pending=this.pending.filter(r=>r.seq!==n),n!==null&&this.latency.refused(
n),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.overlay=null,ic()),this.generation=Math.
max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.
generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,a=n.observed,l=this.next??this.shown,
h=l&&l.p.length===o.length&&l.bits.every((p,f)=>p===a[f])?{observed:l.observed,bits:l.bits}:{observed:go(a,o.length),bits:a};this.next={...e,p:o,trace:s,traced:r,
weights:i,...h},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==
s.text||s.walls.length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:go(Wt(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==
s||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),this.state.view&&!this.pending.some(r=>r.type==="view")){
let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r??"mean",chain:i??0,draw:a??null}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||
!this.state||(dc(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var pc='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var hc=`:host { display: block; height: 100dvh; container-type: size; }
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
.legend { grid-area: legend; display: flex; flex-wrap: wrap; gap: 2px 16px; list-style: none; padding: 2px 12px 9px 46px; font-size: 12.5px; color: var(--soft);\
 }
.legend li { display: inline-flex; align-items: center; gap: 6px; white-space: nowrap; }
.legend li:first-child > span:first-child { min-width: 68px; }
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
  .legend li:first-child { flex-wrap: wrap; white-space: normal; }
  .legend li:first-child > span:first-child { min-width: 0; }
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
  .bar .segmented label { min-height: 34px; padding: 0 11px; }
  .bar [aria-label^="Zoom"] { display: none; }
  .bar .segmented span { position: absolute; width: 1px; overflow: hidden; clip-path: inset(50%); }
  .legend { display: none; }
  footer { flex-direction: column; padding: 3px 12px 4px; gap: 0; border-left: 1px solid var(--line); }
  footer [role=status] { white-space: normal; }
  footer > * { max-width: 100%; }
}
@media (prefers-reduced-motion: no-preference) { button, .segmented label { transition: background-color .12s; } }
@media (forced-colors: active) { .segmented label:has(:checked) { outline: 2px solid Highlight; } }
`;var mc="bayesmap-theme",fc={auto:"light",light:"dark",dark:"auto"},As=class{constructor(e,n){this.app=e;this.dressed=n;let o=Ih();o&&o in fc&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=Yo.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?Yo.dark:Yo.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:u,ghost:h,belief:p}=n;for(let[f,w]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:l,draw:u,ghost:h,belief:p}))this.
app.style.setProperty(`--${f}`,w);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=fc[this.choice];try{localStorage.setItem(mc,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function Ih(){try{return localStorage.getItem(mc)}catch{return null}}function Ls(t,e,{embedded:n=!1,adopt:o=null,notice:s=null}={}){let r=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(pc+hc),r.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,l=()=>{a||=requestAnimationFrame(Ue)},u=new Cs(e,l,o,s);e.open();let h=new Gn,p=new zo(u),f=new Wo(u,p),w=new xs(
u),y=new vs(u,p,f,ae,Y=>w.showLayer(Y),n),k=[new Hn,new Bn,new qn,new Kn,new Qo,new jn,new zn,new Yn,new Vn,new Ko],S=k.map(({name:Y})=>x("canvas",{className:Y})),
P=S[S.length-1];Object.assign(P,{tabIndex:0,role:"application"});let M=new Bo(k,S);new jo(P,u,h,p,f,n);let _=new Vo(P,u,h,p,f),E={truth:!0,rays:!0,readings:!0,strokes:!0,
trajectory:!0},K=Il(y),R=ea(y),q={chip:Hl(y),banner:Vl(y)},V=x("main",{className:"stage"},...S,q.chip,q.banner),N=()=>ee.theme,G=Ol(y,N),A=Bl(y);P.setAttribute(
"aria-describedby",A.readout.id);let Z=Nl(y),I={help:Dl(y),new:Rl(y),share:Z.dialog},[j,W,Q,z]=[Yl(y),Jl(y),Zl(y),Ql(y)],Je=[Ll(y),oc(y),$l(y),Gl(y),Kl(y,Cl(y,N),
Al(y,N)),ec(y),ql(y),Xl(y,w,E),j,W,jl(y),Q,z],me=x("aside",{"aria-label":"Controls"},...Je),re=()=>u.recorded||u.document?.source.kind==="run";y.visible(j,()=>u.
editable),y.visible(W,()=>!re()),y.visible(Q,()=>!re()),y.visible(z,()=>!re()),y.each(()=>{L(R,"inert",!u.document),L(me,"inert",!u.document)});let ue=x("div",{
className:"app"},K.element,R,V,G,me,A.element,...Object.values(I));r.replaceChildren(ue);let ee=new As(ue,Y=>{K.nameTheme(Y),l()}),H=()=>{let Y=u.editable&&p.tool===
"sensor"?p.sensor?.id??null:null;return{session:u,view:h,look:{theme:ee.theme,...E,hover:p.hover,cursor:p.cursor,selected:Y}}},_e="";function Ue(){a=0;let Y=u.take();
u.document&&String(u.shape)!==_e&&(_e=String(u.shape),h.fit(u.shape),p.cursor=p.hover=null,u.decisions.forget(),u.ghost.refit(),P.setAttribute("aria-label",`Map\
, ${u.shape[0]} by ${u.shape[1]} cells`)),M.paint(H()),Y&&(u.painted(),w.step());let{x:ne,y:Ne}=h.transform;q.chip.style.transform=`translate(${Math.max(ne,Ye.left)}\
px, ${Math.max(Ne-28,6)}px)`,dt(P,"data-tool",u.editable||Et.has(p.tool)?p.tool:"pan"),y.refresh()}let ge=new ResizeObserver(()=>{let{width:Y,height:ne}=V.getBoundingClientRect();
!Y||!ne||(h.resize(Y,ne,devicePixelRatio||1),h.fitted&&h.fit(u.shape),cancelAnimationFrame(a),Ue())});ge.observe(V);async function ae(Y){if(Y==="in"||Y==="out")
h.zoom(Y==="in"?1.4:1/1.4,h.middle,u.shape);else if(Y==="fit")h.fit(u.shape);else if(Y==="help")I.help.showModal();else if(Y==="new")I.new.showModal();else if(Y===
"theme")ee.next();else if(Y==="add")_.addSensor();else if(Y==="share"){let ne=u.portableDocument();ne&&Z.show(location.origin+location.pathname+await Ci(ne))}else if(Y===
"export png"){let ne=await Qi(H());ne&&ur("bayesmap.png",ne),u.say("Saved bayesmap.png")}else Y.startsWith("export ")&&u.act({type:"export",what:Y.slice(7)});l()}
u.ondownload=(Y,ne,Ne)=>ur(Y,new Blob([Ne],{type:ne}));let it=[[n?t:window,"keydown",Y=>{Y.defaultPrevented||!u.document||Object.values(I).some(ne=>ne.open)||Gi(
Y,u,{tool:ne=>{p.choose(ne),_.focus()},layer:ne=>w.showLayer(ne),command:ae})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{if(n)return;let{
document:Y,damaged:ne}=await Go();Y?u.bring(Y):ne&&u.say(Uo,"error")}]];for(let[Y,ne,Ne]of it)Y.addEventListener(ne,Ne);return ee.dress(),{destroy(){ge.disconnect(),
cancelAnimationFrame(a),ee.destroy();for(let[Y,ne,Ne]of it)Y.removeEventListener(ne,Ne);e.close(),r.replaceChildren()},snapshot:()=>sc(u,h,M),cellToClient(Y,ne){
let Ne=P.getBoundingClientRect(),Ot=h.fromGrid({x:Y+.5,y:ne+.5},u.shape[1]);return{x:Ne.left+Ot.x,y:Ne.top+Ot.y}}}}var Kr={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},gc=8,io=()=>({onmessage:()=>{},onstatus:()=>{}});function yc(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers){let l=a.reduce((u,h)=>u*h,1)*Kr[i].BYTES_PER_ELEMENT;
o[r]=new Kr[i](t.slice(s,s+l)),s+=Math.ceil(l/gc)*gc}return[n,o]}function bc(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{let{buffer:i,byteOffset:a,
byteLength:l}=e[r];n[o]=new Kr[s](i.slice(a,a+l))}),n}function wc(t){let{document:e,scans:n,settings:o={},log_joint:s=[]}=t,r=e.grid.shape[0]*e.grid.shape[1],i=t.draws?.count??0,a=e.source.kind!=="simulation",l=Wt(
t.mean),u=Wt(t.observed),h=null,p=0,f={layer:"mean",chain:0,draw:null},w=N=>a?[N[p]]:N,y=N=>Float32Array.from(w(N).flat(),G=>G??1/0),k=n.angles.length,S=go(Wt(n.
hit),n.pose.length*k),P=()=>a?S.subarray(p*k,(p+1)*k):S,M=Float32Array.from(s.flat()),_=(o.sweeps??i)/Math.max(1,i),E=Float32Array.from(s[0]??[],(N,G)=>(G+1)*_),
K=N=>{let G={chains:t.draws?.chains??0,count:h?i:0},A={generation:1,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1};V.onmessage({type:"state",document:e,
seq:N,...A,draws:G,view:f},{})},R=()=>{let N=Float64Array.from(w(n.pose).flat(),Number),G={type:"scan",generation:1,ids:a?[p]:n.ids,index:a?p:null},A=n.exact?.length?
y(n.exact):new Float32Array(0);V.onmessage(G,{pose:N,angles:Float32Array.from(n.angles),ranges:y(n.ranges),exact:A,hit:P()})},q=()=>{let N=f.layer==="draw"&&h?Oh(
h,f.chain*i+(f.draw??i-1),r):null,G=s[f.chain]?.[(f.layer==="draw"?f.draw:null)??i-1]??null,A=N?{...f,draw:f.draw??i-1}:{layer:f.layer==="draw"?"mean":f.layer},
Z=o.sweeps??i,I={quantity:o.quantity,sweeps:Z,total:Z,ess:o.ess,rhat:o.rhat,verdict:o.verdict,log_joint:G},j=o.method??e.method,W={p:N??l,observed:u,trace:M,traced:E};
V.onmessage({type:"field",generation:1,...A,method:j,approximate:!1,...I},W)},V={...io(),open:()=>V.onstatus({connected:!0}),send:N=>{if(N.type==="hello"){if(V.
onmessage({type:"welcome",version:1,recorded:!0},{}),K(N.seq),R(),q(),!i||!t.draws)return;Oo(Wt(t.draws.data)).then(G=>{h=G,K(N.seq)})}else if(N.type==="view")f=
{layer:N.layer,chain:N.chain??f.chain,draw:N.draw??null},K(N.seq),q();else if(N.type==="scan")p=N.index,K(N.seq),R();else if(N.type==="inspect"){let G=Uh(e,n.angles,
w(n.pose),w(n.ranges),N.x,N.y);V.onmessage({type:"cell",x:N.x,y:N.y,beams:G},{})}},close:()=>{}};return V}function Oh(t,e,n){let o=e*n;return Uint8Array.from({length:n},
(s,r)=>t[o+r>>3]>>7-(o+r&7)&1?255:0)}function Uh({grid:t},e,n,o,s,r){let{origin:i,resolution:a}=t,l=[i[0]+s*a,i[1]+r*a],u=0;return n.forEach((h,p)=>{let[f,w,y]=h.
map(Number);e.forEach((k,S)=>{let[P,M]=[Math.cos(k+y),Math.sin(k+y)],_=[(l[0]-f)/P,(l[0]+a-f)/P,(l[1]-w)/M,(l[1]+a-w)/M],E=Math.max(0,Math.min(_[0],_[1]),Math.min(
_[2],_[3])),K=Math.min(o[p][S]??1/0,Math.max(_[0],_[1]),Math.max(_[2],_[3]));E<K&&u++})}),u}var qr=250,Gh=8e3;function vc(t){let e=null,n=qr,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),u=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{u=!0,n=qr,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...yc(h))},l.onclose=()=>{if(s||e!==l)return;o=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),u||Wh(t()).then(p=>p&&e===l&&i.onstatus({...h,refused:p})),n=Math.min(Gh,2*n)}}let i={...io(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=qr,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};return i}async function Wh(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function xc(t){let e=(o,s=[])=>n.onmessage(o,bc(o,s)),n={...io(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var zh="This is the map that was drawn here when the connection was lost; undo leads back",Yr=t=>Object.assign(window,{bayesmap:t}),Q0={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=Ls(n,xc(t),{embedded:!0});return Yr(o),()=>o.destroy()}};async function Hh(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){Yr(Ls(t,wc(JSON.parse(n.textContent??""))));return}lc(new URLSearchParams(location.search).get("token"));let{document:o,damaged:s}=await Go(),
r=o?null:ac(),i=vc(()=>new URL(location.href));cc(l=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(l)}${location.hash}`),i.retry?.()}),
Yr(Ls(t,i,{adopt:o??r,notice:s?{text:Uo,level:"error"}:r?{text:zh,level:"info"}:null}))}Hh();export{Q0 as default,Ls as mount,wc as recordedTransport,vc as webSocketTransport,xc as widgetTransport};
