// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function go(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Ri(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Ht(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Oo(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function $i(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Io=t=>$i(t,new DecompressionStream("deflate-raw")),Fi=t=>$i(t,new CompressionStream("deflate-r\
aw"));async function Oi(t){let e=await Fi(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Oo(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function wh(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Io(Ht(e[1]))))}var Uo="The link's map cannot be read: copy the link again, who\
le";async function Wo(){let t=await wh(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var ne=(t,e,n)=>Math.min(n,Math.max(e,t)),Ot=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,Ae=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),ir=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function pn(t,e){let{x:n,y:o}=Ae(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Un=(t,e)=>ir({x:t.x+.5,y:t.y+.5},e);
function Ii(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Ui(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let c=i<
n&&s(r-1,i)!==s(r,i);c&&a<0&&(a=i),!c&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let c=i<e&&s(i,r-1)!==s(i,r);c&&
a<0&&(a=i),!c&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var yo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Wi(t,e,n){let o=zi(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Hi(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Gi(t,e){
let n=bh(e,t.grid.shape),o=zi(t);return Hi(t,(s,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let c of o)a=Math.min(a,Math.hypot(s-c.x,r-c.y));return a>0?a:-1/0})}
var zi=({sensors:t,grid:e})=>t.map(n=>pn(n,e));function Hi(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let c=e(i,a,i*o+a);
c>r&&([s,r]=[{x:i,y:a},c])}return s&&Un(s,t.grid)}function bh(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)o[r*n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),
s(r+1,i-1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var Go=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Ot(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(h=>pn(h,r.grid)):[],c=new Map;for(let h of e)!Ot(h,i)||this.isWall(h)===n||a.some(u=>u.x===
h.x&&u.y===h.y)||c.set(h.x*i[1]+h.y,[h.x,h.y]);c.size&&this.session.act({type:"walls",cells:[...c.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?Gi(o,n.walls):"world"in e?e.world:Wi(o,n.walls,e.near),r=n.limits?.sensors[1]??1/0;s?o.sensors.length>=r?n.say(`The\
re can be ${r} sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"add_sensor",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=
Math.max(0,...o.sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"\
remove_sensor",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=pn(e,n.document.grid),s=this.isWall(o);return!s&&Ot(o,n.shape)?(n.status.text.
startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Et=new Set(["pan","path","look","where","ghost","evidence"]),vh=120,zo=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.ghost.hold(e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.
changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&Ot(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=
n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.
busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},vh))}};var Ye={left:36,right:12,top:34,bottom:26},xh=60,kh=160,Wn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-Ye.left-Ye.right,y:this.height-Ye.
top-Ye.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:Ye.left+(o.x-
s*e)/2,y:Ye.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,o){let{scale:s}=this.transform,{x:r,
y:i}=this.corner,a=ne(s*e,Math.min(this.width,this.height)/Math.max(...o)/3,kh),c=a/s;this.transform.scale=a,this.corner={x:n.x-c*(n.x-r),y:n.y-c*(n.y-i)},this.
fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.
x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=xh;this.corner.
x=ne(this.corner.x,s-e*o,this.width-s),this.corner.y=ne(this.corner.y,s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var Ho=new Set(["path","look","evidence"]);function Bo(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);if(e.tool==="evidence"&&t.document){let{x:u,y:p}=Ae(
o,t.document.grid);return t.evidence.pin({x:Math.floor(u),y:Math.floor(p)})}let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,c]=r.
pose.subarray(3*s,3*s+3),h=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:c}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${h}`)}var Ki=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W, O, V","where am I, ghost, evidence of beams","asked"],["arrows",
"move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["Space","at the cu\
rsor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, Delete","add, remo\
ve a sensor","drawn"],["R, Escape","run, cancel","inferred"],["M, N, H","show the mean, a draw, the entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","asked"],
["+, −, 0","zoom in, out, whole map"],["?","this help"]],Sh={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},Bi=Math.PI/12,Vo=class{constructor(e,n,o,s,r){
this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;e.addEventListener("keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("b\
lur",()=>{delete e.dataset.pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{session:n,hand:o,editor:s}=this;if(!n.document||
e.ctrlKey||e.metaKey||e.altKey)return;let r=Sh[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key===
"]"){let a=e.key==="["?Bi:-Bi;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+
a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)s.removeSensor();else if(e.
key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.hand.cursor?{near:this.hand.
cursor}:"where there is room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&o.ghost.pose&&o.document){let{resolution:c}=o.document.
grid,{x:h,y:u}=o.ghost.pose;o.ghost.move({x:h+e*c,y:u+n*c})}else if((r.tool==="sensor"||r.tool==="where")&&r.sensor&&o.document&&o.editable){let{resolution:c}=o.
document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*c,y:r.sensor.y+n*c})}else if(r.tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.
shape),o.changed();else{let c=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},h={x:ne(c.x+e,0,i-1),y:ne(c.y+n,0,a-1)};r.setCursor(h);let u=s.fromGrid({x:h.x+.5,
y:h.y+.5},a),p=(y,w,k)=>y-ne(y,w,k),f={x:p(u.x,Ye.left+10,s.width-20),y:p(u.y,20,s.height-Ye.bottom-10)};(f.x||f.y)&&s.pan(-f.x,-f.y,o.shape)}}space(e){let{session:n,
hand:o,editor:s}=this;if(Ho.has(o.tool)&&n.document){o.cursor?Bo(n,o,s,Un(o.cursor,n.document.grid)):this.arrow(0,0);return}if(n.editable){if(o.tool==="sensor"||
o.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,r.length)]?.id??null),o.selected!==null&&o.announce(
`Sensor ${o.selected}`)}else if(!Et.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.
announce(i?"wall":"free")}}}},ar={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",v:"evidence"},Vi={m:"mean",n:"draw",h:"entropy"},ji={
"+":"in","=":"in","-":"out",0:"fit","?":"help"};function qi(t,e,n){let o=t.composedPath()[0],s=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.
test(o.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?
"redo":"undo"});return}if(!(s||t.altKey)){if(ar[r]&&(e.editable||Et.has(ar[r])&&!e.recorded))n.tool(ar[r]);else if(Vi[r])n.layer(r==="h"&&e.quantity.interval?"w\
idth":Vi[r]);else if(ji[t.key])n.command(ji[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&(e.running||e.working))e.act({type:"\
cancel"});else return;t.preventDefault()}}var jo=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let c of this.sheets){let{canvas:h,context:u,layer:p}=c,f=p.shows?.(e)??!0,y=[f,...f?[...a,...p.depends(e)]:[]];y.length===
c.before.length&&y.every((w,k)=>Object.is(w,c.before[k]))||(c.before=y,h.style.visibility=f?"":"hidden",f&&((h.width!==i.width||h.height!==i.height)&&(Object.assign(
h,i),h.style.width=`${i.width/s}px`,h.style.height=`${i.height/s}px`),u.setTransform(1,0,0,1,0,0),u.clearRect(0,0,h.width,h.height),u.setTransform(s,0,0,s,0,0),
u.save(),p.paint(u,e),u.restore(),this.paints[p.name]++))}}};function Ne(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,o*r,s*r),t.clip()}function un(t,{halo:e},n,o){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}var lr='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function It(t,e,n,o,s,r,i=!1){t.font=lr,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}function cr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Zt(t,e,n){let o=n.fromGrid(Ae(t,e),e.shape[1]),s=ne(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function Yi(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=cr(e);t.lineJoin=
"round";for(let a of i){let c=Zt(a,s.grid,n),{point:h,size:u}=c;a.id===o.selected&&Mh(t,c,o);let[p,f]=[Math.cos(a.yaw),-Math.sin(a.yaw)],y=(w,k)=>[h.x+u*(w*p-k*
f),h.y+u*(w*f+k*p)];t.beginPath(),t.moveTo(...y(1.25,0)),t.lineTo(...y(-.9,.8)),t.lineTo(...y(-.45,0)),t.lineTo(...y(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&It(t,String(a.id),h.x,h.y+u*2+4,r,"center",!0)}}function Mh(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),un(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function Ji(t,e,n,o,s){let r=c=>Math.hypot(e.x-c.x,e.y-c.y),i=t.pose&&Zt({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Zi(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var Qi={touch:24,other:11},Th=5,Ph=90,Ko=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(c,h)=>e.
addEventListener(c,h,{passive:!1});a("pointerdown",c=>this.down(c)),a("pointermove",c=>this.move(c)),a("pointerup",c=>this.up(c)),a("pointercancel",c=>this.up(c)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",c=>this.wheel(c)),a("contextmenu",c=>c.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return ir(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(Ji(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&Ho.has(o.tool))return this.
begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(i.id),this.begin(i);
if(e.button===1||Et.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="sensor"&&o.select(a.id);else if(o.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let c=o.tool==="draw"!==(e.button===2||e.shiftKey),h=this.cellAt(r),u=c&&this.editor.isWall(h);this.begin({kind:"strok\
e",id:o.nextGesture(),wall:c,last:h,held:e,onWall:u}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Ph)}}gripAt(e,n,o){let{hand:s,view:r}=this,
i=this.reach(n),a=f=>Math.hypot(e.x-f.x,e.y-f.y),c=s.tool==="sensor"&&s.sensor?Zt(s.sensor,o.grid,r):null;if(c&&s.sensor&&a(c.handle)<Math.min(i,a(c.point)))return{
kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let h=o.sensors.map(f=>({id:f.id,...Zt(f,o.grid,r)}));h.sort((f,y)=>a(
f.point)-a(y.point));let u=h.find(({point:f,size:y})=>a(f)<Math.max(i,y));if(!u)return null;let p={x:u.point.x-e.x,y:u.point.y-e.y};return{kind:"sensor",id:u.id,
drag:s.nextGesture(),grip:p}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],c=e.getCoalescedEvents?.()??[];for(let h of c.
length?c:[e]){let u=this.cellAt(this.at(h));(u.x!==n.last.x||u.y!==n.last.y)&&(n.onWall=!1),a.push(...Ii(n.last,u)),n.last=u}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(h=>h.id===n.id);if(!a||!o.document)return;let c=this.metres(i,o.document);
this.editor.moveSensor(a,{yaw:Math.atan2(c.y-a.y,c.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>Th&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.size===2){let{middle:a,spread:c}=this.spread();
s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(c/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:c}),o.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&Bo(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?Qi.touch:Qi.other}pointAtReading(e){let{document:n,reading:o,ghost:s}=this.
session;if(!n||s.held)return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:o}=this;
if(n?.kind!=="ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);Zi(o.ghost,n,this.metres({x:s.x+n.grip.x,y:s.y+n.grip.y},o.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level==="error"&&o.say("Ready"))}dragSensor(e){
let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(c=>c.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var Eh=5,qo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(Ye.left,0,o.width,o.height-Ye.bottom),e.clip(),s.hover&&Xi(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&Xi(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function Xi(t,e,n,o,s,r,i){let{scale:a}=o.transform,c=o.fromGrid({x:e.x,y:e.y+1},n),h=Math.max(a,Eh),[u,p]=[c.x-(h-a)/2,c.y-(h-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(u,p,h,h),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(u,p,h,h)}var Ah={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Ch={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},Jo={light:Ah,dark:Ch},ea="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function _h([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((c,h)=>(c>.20689655172413793?c**3:.12841854934601665*(c-.13793103448275862))*s[h]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(c=>{let h=ne(c,0,1);return Math.round(255*(h<=.0031308?12.92*h:1.055*h**(1/2.4)-.055))})}var Yo=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),hr=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),dr=(t,e)=>_h(hr(t.paper,t.ink,e));function Gn(t){let e=Math.min(15,Math.floor(
t*16));return hr(Yo(ea,6*e),Yo(ea,6*e+6),t*16-e)}function ta(t,e){let n=new Uint8ClampedArray(2048).fill(255),[o,s]=[Yo(t.unobserved),Yo(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?yo(r/255):r/255;n.set(e==="value"?dr(t,r/255):Gn(i),4*r),n.set(hr(o,s,e==="value"?r/255:0),4*(r+256))}return new Uint32Array(n.buffer)}
var pr=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var Lh=9,Dh=2.5,zn=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start||e.looking&&e.views))}paint(e,n){let{session:o}=n;o.document&&(Ne(e,n),o.decisions.looking&&this.views(e,n),this.path(e,n))}views(e,{session:n,
view:o,look:s}){let{views:r}=n.decisions,i=n.document?.grid;if(!r?.nats.length||!i)return;let[a,c]=[Math.min(...r.nats),Math.max(...r.nats)],h=ne(.38*r.spacing*
o.transform.scale/i.resolution,Dh,Lh),u=r.nats.indexOf(c);for(let p=0;p<r.nats.length;p++){let f=o.fromGrid(Ae({x:r.pose[3*p],y:r.pose[3*p+1]},i),i.shape[1]);e.
beginPath(),e.arc(f.x,f.y,h,0,2*Math.PI),e.fillStyle=`rgb(${Gn(ne((r.nats[p]-a)/Math.max(c-a,1e-9),0,1)).map(Math.round)})`,e.fill(),p===u&&(e.lineWidth=2.5,e.strokeStyle=
s.theme.truth,e.stroke())}}path(e,{session:n,view:o,look:s}){let{start:r,goal:i,path:a,radius:c}=n.decisions,h=n.document?.grid;if(!h||!r)return;let u=p=>o.fromGrid(
Ae(p,h),h.shape[1]);if(a){e.beginPath();for(let[p,f]of a.path){let y=u({x:p,y:f});e.lineTo(y.x,y.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=a.within_risk?s.theme.
sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*c*o.transform.scale/h.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let p of i?[r,i]:[r]){
let{x:f,y}=u(p);e.beginPath(),e.arc(f,y,5,0,2*Math.PI),e.fillStyle=p===r?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}}};var Nh=5,[Rh,na]=[.8,5],$h=6,Zo=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:o,view:s,look:r}=n,{cell:i,each:a}=o.evidence,c=o.document?.grid;if(!i||!c)return;
Ne(e,n);let h=(k,M)=>s.fromGrid(Ae({x:k,y:M},c),c.shape[1]),u=k=>[h(a.start[2*k],a.start[2*k+1]),h(a.end[2*k],a.end[2*k+1])],p=a?.nats.length??0;e.lineCap="roun\
d";for(let k=p-1;k>=0;k--){let[M,T]=u(k),S=a.nats[k];e.beginPath(),e.moveTo(M.x,M.y),e.lineTo(T.x,T.y),e.globalAlpha=ne(.25+Math.abs(S)/2,0,.9),e.lineWidth=ne(na*
Math.sqrt(Math.abs(S)/$h),Rh,na),e.strokeStyle=S>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:f}=s.transform,y=s.fromGrid({x:i.x,y:i.y+1},c.
shape[1]),w=Math.max(1,4-f/2);e.beginPath(),e.rect(y.x-w,y.y-w,f+2*w,f+2*w),un(e,r.theme,r.theme.belief,2);for(let k=Math.min(Nh,p)-1;k>=0;k--){let[M,T]=u(k),S=.35+
.1*k,E={x:M.x+S*(T.x-M.x),y:M.y+S*(T.y-M.y)};It(e,ur(a.nats[k]),E.x,E.y,r.theme,"center",!0)}}},ur=t=>`${t<0?"−":"+"}${Math.abs(t).toFixed(1)}`;var Fh=10,Oh=7,Ih=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Qo=()=>document.createElement("canvas").getContext("2d"),Hn=class{name="\
field";cells=Qo();mask=Qo();hatch=Qo();palettes=new Map;image=new ImageData(1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.
flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:c,x:h,y:u}=s.transform;Ne(e,n);let p=o.flicker.under??o.shown;if(!p||p.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
h,u,i*c,a*c);return}this.fill(p,i,a,r.theme,Ih(p,o.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,h,u,i*c,a*c),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),c>=Fh&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:c}=this,
h=`${s.ground} ${r}`;if(c.field===e&&c.palette===h)return;let u=this.palettes.get(h)??ta(s,r);if(this.palettes.set(h,u),this.image.width!==n||this.image.height!==
o){this.image=new ImageData(n,o);for(let{canvas:f}of[i,a])Object.assign(f,{width:n,height:o});c.bits=null}let p=new Uint32Array(this.image.data.buffer);for(let f=0,
y=0;f<o;f++)for(let w=o-1-f;w<n*o;w+=o)p[y++]=u[e.p[w]+(e.observed[w]?0:256)];if(i.putImageData(this.image,0,0),c.bits!==e.bits){for(let f=0,y=0;f<o;f++)for(let w=o-
1-f;w<n*o;w+=o)p[y++]=e.observed[w]?0:4278190080;a.putImageData(this.image,0,0),c.hatch=""}Object.assign(c,{field:e,bits:e.bits,palette:h})}fillHatch({session:e,
view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:c,height:h}=n,{scale:u,x:p,y:f}=n.transform,[y,w]=e.shape,k=[o.theme.ground,u,p,f,c,h,a].join(" ");
if(i.hatch===k)return;i.hatch=k;let M=Qo(),T=M.canvas.width=M.canvas.height=Math.round(Oh*a);M.strokeStyle=o.theme.hatch,M.lineWidth=a,M.beginPath();for(let E of[
-T,0,T])M.moveTo(E-1,T+1),M.lineTo(E+T+1,-1);M.stroke(),Object.assign(s.canvas,{width:Math.ceil(c*a),height:Math.ceil(h*a)}),s.setTransform(a,0,0,a,0,0),s.imageSmoothingEnabled=
!1,s.drawImage(r.canvas,p,f,y*u,w*u),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let S=s.createPattern(M.canvas,"repeat");S.setTransform(
new DOMMatrix().translate(Math.round(p*a),Math.round(f*a))),s.fillStyle=S,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,view:o,look:s}){let[
r,i]=n.shape,{scale:a,x:c,y:h}=o.transform;e.beginPath();for(let u=1;u<r;u++)e.moveTo(c+u*a,h),e.lineTo(c+u*a,h+i*a);for(let u=1;u<i;u++)e.moveTo(c,h+u*a),e.lineTo(
c+r*a,h+u*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var Uh=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],Bn=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(Ne(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(c,h)=>{let u=ne(r[h],0,a),p=o.yaw+c,f={x:o.x+u*Math.cos(p),y:o.y+u*Math.sin(p)};return n.fromGrid(Ae(f,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(w=>this.ends(n,o,o.angles,w)),{grid:c}=n.session.document,h=n.view.fromGrid(Ae(o,c),c.shape[1]),u=new Path2D;
u.moveTo(h.x,h.y);for(let{x:w,y:k}of r)u.lineTo(w,k);u.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(u);let p=new Path2D,f=new Path2D,y=ne(n.view.transform.
scale*.12,1.2,3);for(let w=0;w<r.length;w++)p.moveTo(r[w].x,r[w].y),p.lineTo(a[w].x,a[w].y),Number.isFinite(o.median[w])&&f.rect(i[w].x-y,i[w].y-y,2*y,2*y);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=ne(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(p),e.globalAlpha=1,f}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,c=ne(n.view.transform.scale*.14,1.5,4),h=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),u=new Path2D;h.forEach(({x:p,y:f},y)=>{i[y]&&
(u.moveTo(p+c,f),u.arc(p,f,c,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(u)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:c,handle:h}=Zt({id:0,...r},i,o),[u,p]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(h.x,h.y),un(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[f,y]of Uh)e.lineTo(a.x+c*(f*u-y*p),a.y+c*(f*p+y*u));e.closePath(),e.lineJoin="round",un(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(h.x,h.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var Vn=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:o,view:s,look:r}=n,i=o.flicker.under&&o.shown;if(!i)return;let[a,c]=o.shape,
{scale:h,x:u,y:p}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,c,r.theme.draw),Ne(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,u,p,a*h,c*h)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(h=>parseInt(s.slice(h,h+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let c=new ImageData(
n,o);for(let h=0,u=0;h<o;h++)for(let p=o-1-h;p<n*o;p+=o,u+=4)c.data.set([r,i,a,e.observed[p]?e.p[p]:0],u);this.cells.putImageData(c,0,0),this.drawn={field:e,colour:s}}};var Wh=46,Gh=22;function zh(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function oa(t,{session:e,view:n,look:o}){if(!e.document)
return;let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:c,shape:h}=e.document.grid,{scale:u,x:p,y:f}=n.transform,y=zh(Wh/u*c),w=Math.min(f+h[1]*u,i-Ye.bottom)+
.5,k=Math.max(p,Ye.left)-.5;t.fillStyle=s.ground,p<k&&t.fillRect(0,0,k,i+1),f+h[1]*u>w&&t.fillRect(0,w,r+1,i+1-w);let M=Math.max(0,-Math.floor(Math.log10(y)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let T=E=>Math.ceil(a[E]/y-1e-9)*y,S=E=>a[E]+h[E]*c+1e-9;for(let E=T(0);E<=S(0);E+=y){let A=p+(E-a[0])/c*u;A<k||
A>r-4||(t.moveTo(A,w),t.lineTo(A,w+4),It(t,E.toFixed(M),A,w+12,s,"center"))}for(let E=T(1);E<=S(1);E+=y){let A=f+(h[1]-(E-a[1])/c)*u;A>w||A<4||(t.moveTo(k,A),t.
lineTo(k-4,A),It(t,E.toFixed(M),k-7,A,s,"right"))}t.stroke(),It(t,"m",k-Gh,w+12,s,"right")}var jn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=cr(e).flatMap(({id:i,x:a,y:c,yaw:h})=>[i,a,c,h]),{grid:s}=e.document??{},
r=sa(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:c,x:h,y:u}=s.transform;r.truth&&sa(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(h-.5,u-.5,i*c+1,a*c+1),Yi(e,n),oa(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:c}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=Ui(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),Ne(e,n),e.transform(i,0,0,-i,a,c+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=ne(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},sa=({document:t})=>t?.source.kind==="simulation";var Hh=600,Bh=1500,Vh=65536,fr=.3,Kn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;
if(!i||!a)return;Ne(e,n);let{scale:c}=s.transform,h=1/a.grid.resolution,u=a.grid.shape[1],p=i.angles.length,f=i.pose.length/3,y=Math.ceil(p*f/Bh),[w,k,M]=[new Path2D,
new Path2D,new Path2D],T=p*f>Hh,S=new Map,E=ne(c*.1,1.3,4),A=a.scans_used??1/0,J=(i.index??0)<A?1:fr;for(let R=0;R<f;R++){let[Y,V,Q]=i.pose.subarray(3*R,3*R+3),
B=s.fromGrid(Ae({x:Y,y:V},a.grid),u);for(let D=0;D<p;D++){let j=i.ranges[R*p+D],L=i.hit[R*p+D]===1,F=(L?j:a.max_range)*h*c,I=i.angles[D]+Q,K={x:B.x+F*Math.cos(I),
y:B.y-F*Math.sin(I)},G=L?w:k;(R*p+D)%y===0&&(G.moveTo(B.x,B.y),G.lineTo(K.x,K.y)),L&&(T?S.set(Math.round(K.x)*Vh+Math.round(K.y),K):(M.moveTo(K.x+E,K.y),M.arc(K.
x,K.y,E,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=J*ne(28/Math.sqrt(p*f/y)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(w),e.strokeStyle=r.theme.
noReturn,e.stroke(k),e.globalAlpha=1),r.readings){e.globalAlpha=J,e.fillStyle=r.theme.ray,e.fill(M);let R=1.8*E;for(let{x:Y,y:V}of S.values())e.fillRect(Y-R/2,V-
R/2,R,R);e.globalAlpha=1}}};var jh=2.5,wo=t=>t>=jh,qn=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(Ne(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&wo(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,c=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[h,u,p]of[[0,c,.6],
[Math.max(0,c-1),a,.6*fr]]){e.beginPath();for(let f=h;f<u;f++){let y=o.fromGrid(Ae({x:r[2*f],y:r[2*f+1]},i),i.shape[1]);e.lineTo(y.x,y.y)}e.globalAlpha=p,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[c,h,u,p]=r.subarray(a,a+4),[f,
y]=[o.fromGrid(Ae({x:c,y:h},i),i.shape[1]),o.fromGrid(Ae({x:u,y:p},i),i.shape[1])];e.moveTo(f.x,f.y),e.lineTo(y.x,y.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=ne(o.transform.scale/5,.8,2.5),e.stroke()}}};var Kh=2.2,Xo=7,[qh,Yh]=[.03,.75],Jh=2.4477,ra=9,Yn=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!(!s||!r)){Ne(e,n),this.
cloud(e,n,r);for(let i of s.modes)this.place(e,n,r,i,s.modes.length>1)}}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,c=a[a.length-1]||
1;e.strokeStyle=e.fillStyle=s.theme.belief,e.lineWidth=1.2;for(let h=0;h<a.length;h++){if(a[h]<qh**2*c)continue;let[u,p,f]=i.subarray(3*h,3*h+3),y=o.fromGrid(Ae(
{x:u,y:p},r),r.shape[1]);e.globalAlpha=Yh*Math.sqrt(a[h]/c),e.beginPath(),e.arc(y.x,y.y,Kh,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(y.x,y.y),e.lineTo(y.x+Xo*
Math.cos(f),y.y-Xo*Math.sin(f)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:o},s,r,i){let[a,c,h]=r.mean,u=n.fromGrid(Ae({x:a,y:c},s),s.shape[1]),p=Jh*n.transform.
scale/s.resolution,[[f,y],[,w]]=r.covariance,[k,M]=[(f+w)/2,Math.hypot((f-w)/2,y)],[T,S]=[k+M,k-M].map(A=>Math.max(ra,p*Math.sqrt(Math.max(A,0))));e.beginPath(),
e.ellipse(u.x,u.y,T,S,-Math.atan2(2*y,f-w)/2,0,2*Math.PI);let E=ra+1;e.moveTo(u.x+E*Math.cos(h),u.y-E*Math.sin(h)),e.lineTo(u.x+(E+Xo)*Math.cos(h),u.y-(E+Xo)*Math.
sin(h)),e.strokeStyle=o.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i&&It(e,mr(r.probability),u.x,u.y-S-9,o.theme,
"center",!0)}},mr=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var ia=900,bo=2;function aa({session:t,look:e}){let[n,o]=t.shape,s=new Wn;s.resize(ia,Math.round(ne(ia*o/n,300,1800)),bo),s.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:s.width*bo,height:s.height*bo});let i=r.getContext("2d");i.scale(bo,bo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);
let a=[new Hn,new Vn,new qn,new Kn,new jn,new zn,new Yn,new Bn],c={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let h of a)(h.shows?.(
c)??!0)&&(i.save(),h.paint(i,c),i.restore());return new Promise(h=>r.toBlob(h))}var es=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:c,document:h}=o;if(!i||!h||c?.index!==
i.scan)return;Ne(e,n);let{grid:u,max_range:p}=h,f=M=>{let T={x:i.from.x+M*Math.cos(i.angle),y:i.from.y+M*Math.sin(i.angle)};return s.fromGrid(Ae(T,u),u.shape[1])},
y=(M,T,S,E)=>{e.beginPath(),e.moveTo(M.x,M.y),e.lineTo(T.x,T.y),e.lineWidth=S,e.strokeStyle=E,e.stroke()},w=c.hit[i.beam]===1,k=f(w?c.ranges[i.beam]:p);if(y(f(0),
k,3,r.theme.halo),y(f(0),k,1.5,w?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let M=(T,S)=>ne(T??S,0,p);if(y(f(M(a.low,0)),f(M(a.high,p)),6,r.theme.ghost),
a.median!==null){let T=f(a.median),S={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};y({x:T.x-S.x,y:T.y-S.y},{x:T.x+S.x,y:T.y+S.y},2.5,r.theme.ghost)}}w&&(e.beginPath(),
e.arc(k.x,k.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};function x(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function C(t,e,n){t[e]!==n&&(t[e]=n)}function ht(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var fn=t=>t.getRootNode().activeElement===t,Se=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function gr(t,e){let n=URL.
createObjectURL(e);x("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var la=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["path","Path","path"],["look","Look next","look"],["w\
here","Where am I?","where"],["ghost","Ghost","ghost"],["evidence","Evidence","evidence"]];function ca(t){let{hand:e,session:n}=t,o=t.segmented("Tool",la,()=>n.
editable||!n.document||Et.has(e.tool)?e.tool:"pan",s=>e.choose(s),s=>n.editable||Et.has(s)&&!n.recorded||s==="pan");return t.visible(o,()=>!n.recorded),la.forEach(
([s],r)=>{Et.has(s)||t.visible(o.children[r],()=>!n.document||n.editable)}),x("div",{className:"bar"},o,x("span",{className:"space"}),t.button("minus","Zoom out",
()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fi\
t"),{title:"Whole map (0)"}))}var Zh="uplot",Qh="u-hz",Xh="u-vt",ed="u-title",td="u-wrap",nd="u-under",od="u-over",sd="u-axis",yn="u-off",rd="u-select",id="u-cursor-x",ad="u-cursor-y",ld="u-\
cursor-pt",cd="u-legend",hd="u-live",dd="u-inline",pd="u-series",ud="u-marker",ha="u-label",fd="u-value",xo="width",ko="height";var da="bottom",Jn="left",yr="right",Rr="#000",pa=Rr+"0",wr="mousemove",ua="mousedown",br="mouseup",fa="mouseenter",ma="mouseleave",ga="dblclick",md="resize",gd="\
scroll",ya="change",rs="dppxchange",$r="--",oo=typeof window<"u",Mr=oo?document:null,Qn=oo?window:null,yd=oo?navigator:null,pe,ts;function Tr(){let t=devicePixelRatio;
pe!=t&&(pe=t,ts&&Er(ya,ts,Tr),ts=matchMedia(`(min-resolution: ${pe-.001}dppx) and (max-resolution: ${pe+.001}dppx)`),wn(ya,ts,Tr),Qn.dispatchEvent(new CustomEvent(
rs)))}function dt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function Pr(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Me(t,e,n){
t.style[e]=n+"px"}function At(t,e,n,o){let s=Mr.createElement(t);return e!=null&&dt(s,e),n?.insertBefore(s,o),s}function vt(t,e){return At("div",t,e)}var wa=new WeakMap;
function Ut(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=wa.get(t);r!=i&&(t.style.transform=r,wa.set(t,r),e<0||n<0||e>o||n>s?dt(t,yn):Pr(t,yn))}var ba=new WeakMap;
function va(t,e,n){let o=e+n,s=ba.get(t);o!=s&&(ba.set(t,o),t.style.background=e,t.style.borderColor=n)}var xa=new WeakMap;function ka(t,e,n,o){let s=e+""+n,r=xa.
get(t);s!=r&&(xa.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Fr={passive:!0},wd={...Fr,
capture:!0};function wn(t,e,n,o){e.addEventListener(t,n,o?wd:Fr)}function Er(t,e,n,o){e.removeEventListener(t,n,Fr)}oo&&Tr();function Ct(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:pt((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function Ja(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var Za=t=>t!=null,Qa=t=>t!=null&&t>0,ls=Ja(Za),bd=Ja(Qa);function vd(t,e,n,o=0,s=!1){
let r=s?bd:ls,i=s?Qa:Za;[e,n]=r(t,e,n);let a=t[e],c=t[e];if(e>-1)if(o==1)a=t[e],c=t[n];else if(o==-1)a=t[n],c=t[e];else for(let h=e;h<=n;h++){let u=t[h];i(u)&&(u<
a?a=u:u>c&&(c=u))}return[a??ye,c??-ye]}function cs(t,e,n,o){let s=Ta(t),r=Ta(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Bt:Xa,a=s==1?pt:xt,c=r==1?xt:pt,
h=a(i(Oe(t))),u=c(i(Oe(e))),p=Xn(n,h),f=Xn(n,u);return n==10&&(h<0&&(p=we(p,-h)),u<0&&(f=we(f,-u))),o||n==2?(t=p*s,e=f*r):(t=ol(t,p),e=hs(e,f)),[t,e]}function Or(t,e,n,o){
let s=cs(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ir=.1,Sa={mode:3,pad:Ir},Mo={pad:0,soft:null,mode:0},xd={min:Mo,max:Mo};function is(t,e,n,o){return ds(
n)?Ma(t,e,n):(Mo.pad=n,Mo.soft=o?0:null,Mo.mode=o?3:0,Ma(t,e,xd))}function he(t,e){return t??e}function kd(t,e,n){for(e=he(e,0),n=he(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Ma(t,e,n){let o=n.min,s=n.max,r=he(o.pad,0),i=he(s.pad,0),a=he(o.hard,-ye),c=he(s.hard,ye),h=he(o.soft,ye),u=he(s.soft,-ye),
p=he(o.mode,0),f=he(s.mode,0),y=e-t,w=Bt(y),k=tt(Oe(t),Oe(e)),M=Bt(k),T=Oe(M-w);(y<1e-24||T>10)&&(y=0,(t==0||e==0)&&(y=1e-24,p==2&&h!=ye&&(r=0),f==2&&u!=-ye&&(i=
0)));let S=y||k||1e3,E=Bt(S),A=Xn(10,pt(E)),J=S*(y==0?t==0?.1:1:r),R=we(ol(t-J,A/10),24),Y=t>=h&&(p==1||p==3&&R<=h||p==2&&R>=h)?h:ye,V=tt(a,R<Y&&t>=Y?Y:_t(Y,R)),
Q=S*(y==0?e==0?.1:1:i),B=we(hs(e+Q,A/10),24),D=e<=u&&(f==1||f==3&&B>=u||f==2&&B<=u)?u:-ye,j=_t(c,B>D&&e<=D?D:tt(D,B));return V==j&&V==0&&(j=100),[V,j]}var Sd=new Intl.
NumberFormat(oo?yd.language:"en-US"),Ur=t=>Sd.format(t),ut=Math,ss=ut.PI,Oe=ut.abs,pt=ut.floor,Fe=ut.round,xt=ut.ceil,_t=ut.min,tt=ut.max,Xn=ut.pow,Ta=ut.sign,Bt=ut.
log10,Xa=ut.log2,Md=(t,e=1)=>ut.sinh(t)*e,vr=(t,e=1)=>ut.asinh(t/e),ye=1/0;function Pa(t){return(Bt((t^t>>31)-(t>>31))|0)+1}function Ar(t,e,n){return _t(tt(t,e),
n)}function el(t){return typeof t=="function"}function re(t){return el(t)?t:()=>t}var Td=()=>{},tl=t=>t,nl=(t,e)=>e,Pd=t=>null,Ea=t=>!0,Aa=(t,e)=>t==e,Ed=/\.\d*?(?=9{6,}|0{6,})/gm,
bn=t=>{if(rl(t)||Xt.has(t))return t;let e=`${t}`,n=e.match(Ed);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${bn(
s)}e${r}`}return we(t,o)};function mn(t,e){return bn(we(bn(t/e))*e)}function hs(t,e){return bn(xt(bn(t/e))*e)}function ol(t,e){return bn(pt(bn(t/e))*e)}function we(t,e=0){
if(rl(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Fe(o)/n}var Xt=new Map;function sl(t){return((""+t).split(".")[1]||"").length}function Po(t,e,n,o){
let s=[],r=o.map(sl);for(let i=e;i<n;i++){let a=Oe(i),c=we(Xn(t,i),a);for(let h=0;h<o.length;h++){let u=t==10?+`${o[h]}e${i}`:o[h]*c,p=(i>=0?0:a)+(i>=r[h]?0:r[h]),
f=t==10?u:we(u,p);s.push(f),Xt.set(f,p)}}return s}var To={},Wr=[],eo=[null,null],Qt=Array.isArray,rl=Number.isInteger,Ad=t=>t===void 0;function Ca(t){return typeof t==
"string"}function ds(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function Cd(t){return t!=null&&typeof t=="object"}var _d=Object.getPrototypeOf(
Uint8Array),il="__proto__";function to(t,e=ds){let n;if(Qt(t)){let o=t.find(s=>s!=null);if(Qt(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=to(t[s],
e)}else n=t.slice()}else if(t instanceof _d)n=t.slice();else if(e(t)){n={};for(let o in t)o!=il&&(n[o]=to(t[o],e))}else n=t;return n}function Re(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=il&&(ds(t[s])?Re(t[s],to(o[s])):t[s]=to(o[s]))}return t}var Ld=0,Dd=1,Nd=2;function Rd(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function $d(t,e){if(Id(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return Ud(i[0])||(i=Od(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let c=t[i][0],h=c.length;for(let u=0;u<
h;u++)n.add(c[u])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],c=a[0];
for(let h=1;h<a.length;h++){let u=a[h],p=Array(s).fill(void 0),f=e?e[i][h]:Dd,y=[];for(let w=0;w<u.length;w++){let k=u[w],M=r.get(c[w]);k===null?f!=Ld&&(p[M]=k,
f==Nd&&y.push(M)):p[M]=k}Rd(p,y,s),o.push(p)}}return o}var Fd=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Od(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let c=0;c<n;c++)a[c]=
i[o[c]];s.push(a)}return s}function Id(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function Ud(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=tt(1,pt((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let c=t[a];if(c!=null){if(c<=i)return!1;i=c}}return!0}var al=["January","February","March",
"April","May","June","July","August","September","October","November","December"],ll=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function cl(t){
return t.slice(0,3)}var Wd=ll.map(cl),Gd=al.map(cl),zd={MMMM:al,MMM:Gd,WWWW:ll,WWW:Wd};function vo(t){return(t<10?"0":"")+t}function Hd(t){return(t<10?"00":t<100?
"0":"")+t}var Bd={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>vo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>vo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>vo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>vo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>vo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Hd(t.getMilliseconds())};function Gr(t,e){e=e||zd;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?Bd[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var Vd=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function jd(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Vd?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var hl=t=>t%1==0,as=[1,2,2.5,5],Kd=Po(10,-32,0,as),dl=Po(10,0,32,as),qd=dl.filter(
hl),gn=Kd.concat(dl),zr=`
`,pl="{YYYY}",_a=zr+pl,ul="{M}/{D}",So=zr+ul,ns=So+"/{YY}",fl="{aa}",Yd="{h}:{mm}",Zn=Yd+fl,La=zr+Zn,Da=":{ss}",fe=null;function ml(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,c=(t==1?Po(10,0,3,as).filter(hl):Po(10,-3,0,as)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),h=[[i,pl,fe,fe,fe,fe,fe,fe,1],[s*28,"{MMM}",_a,fe,fe,fe,fe,fe,1],[s,ul,_a,fe,
fe,fe,fe,fe,1],[o,"{h}"+fl,ns,fe,So,fe,fe,fe,1],[n,Zn,ns,fe,So,fe,fe,fe,1],[e,Da,ns+" "+Zn,fe,So+" "+Zn,fe,La,fe,1],[t,Da+".{fff}",ns+" "+Zn,fe,So+" "+Zn,fe,La,
fe,1]];function u(p){return(f,y,w,k,M,T)=>{let S=[],E=M>=i,A=M>=r&&M<i,J=p(w),R=we(J*t,3),Y=xr(J.getFullYear(),E?0:J.getMonth(),A||E?1:J.getDate()),V=we(Y*t,3);
if(A||E){let Q=A?M/r:0,B=E?M/i:0,D=R==V?R:we(xr(Y.getFullYear()+B,Y.getMonth()+Q,1)*t,3),j=new Date(Fe(D/t)),L=j.getFullYear(),F=j.getMonth();for(let I=0;D<=k;I++){
let K=xr(L+B*I,F+Q*I,1),G=K-p(we(K*t,3));D=we((+K+G)*t,3),D<=k&&S.push(D)}}else{let Q=M>=s?s:M,B=pt(w)-pt(R),D=V+B+hs(R-V,Q);S.push(D);let j=p(D),L=j.getHours()+
j.getMinutes()/n+j.getSeconds()/o,F=M/o,I=f.axes[y]._space,K=T/I;for(;D=we(D+M,t==1?0:3),!(D>k);)if(F>1){let G=pt(we(L+F,6))%24,oe=p(D).getHours()-G;oe>1&&(oe=-1),
D-=oe*o,L=(L+F)%24;let ae=S[S.length-1];we((D-ae)/M,3)*K>=.7&&S.push(D)}else S.push(D)}return S}}return[c,h,u]}var[Jd,Zd,Qd]=ml(1),[Xd,ep,tp]=ml(.001);Po(2,-53,
53,[1]);function Na(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function Ra(t,e){return(n,o,s,r,i)=>{let a=e.find(w=>i>=
w[0])||e[e.length-1],c,h,u,p,f,y;return o.map(w=>{let k=t(w),M=k.getFullYear(),T=k.getMonth(),S=k.getDate(),E=k.getHours(),A=k.getMinutes(),J=k.getSeconds(),R=M!=
c&&a[2]||T!=h&&a[3]||S!=u&&a[4]||E!=p&&a[5]||A!=f&&a[6]||J!=y&&a[7]||a[1];return c=M,h=T,u=S,p=E,f=A,y=J,R(k)})}}function np(t,e){let n=Gr(e);return(o,s,r,i,a)=>s.
map(c=>n(t(c)))}function xr(t,e,n){return new Date(t,e,n)}function $a(t,e){return e(t)}var op="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Fa(t,e){return(n,o,s,r)=>r==
null?$r:e(t(o))}function sp(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function rp(t,e){return t.series[e].fill(
t,e)}var ip={show:!0,live:!0,isolate:!1,mount:Td,markers:{show:!0,width:2,stroke:sp,fill:rp,dash:"solid"},idx:null,idxs:null,values:[]};function ap(t,e){let n=t.
cursor.points,o=vt(),s=n.size(t,e);Me(o,xo,s),Me(o,ko,s);let r=s/-2;Me(o,"marginLeft",r),Me(o,"marginTop",r);let i=n.width(t,e,s);return i&&Me(o,"borderWidth",i),
o}function lp(t,e){let n=t.series[e].points;return n._fill||n._stroke}function cp(t,e){let n=t.series[e].points;return n._stroke||n._fill}function hp(t,e){return t.
series[e].points.size}var kr=[0,0];function dp(t,e,n){return kr[0]=e,kr[1]=n,kr}function os(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function Sr(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var pp={show:!0,x:!0,y:!0,lock:!1,move:dp,points:{one:!1,show:ap,size:hp,width:0,stroke:cp,fill:lp},bind:{mousedown:os,mouseup:os,
click:os,dblclick:os,mousemove:Sr,mouseleave:Sr,mouseenter:Sr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},gl={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Hr=Re({},gl,{filter:nl}),yl=Re({},Hr,{size:10}),wl=Re({},gl,{show:!1}),Br='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',bl="bold "+Br,vl=1.5,Oa={
show:!0,scale:"x",stroke:Rr,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:bl,side:2,grid:Hr,ticks:yl,border:wl,font:Br,lineGap:vl,rotate:0},
up="Value",fp="Time",Ia={show:!0,scale:"x",auto:!1,sorted:1,min:ye,max:-ye,idxs:[]};function mp(t,e,n,o,s){return e.map(r=>r==null?"":Ur(r))}function gp(t,e,n,o,s,r,i){
let a=[],c=Xt.get(s)||0;n=i?n:we(hs(n,s),c);for(let h=n;h<=o;h=we(h+s,c))a.push(Object.is(h,-0)?0:h);return a}function Cr(t,e,n,o,s,r,i){let a=[],c=t.scales[t.axes[e].
scale].log,h=c==10?Bt:Xa,u=pt(h(n));s=Xn(c,u),c==10&&(s=gn[Ct(s,gn)]);let p=n,f=s*c;c==10&&(f=gn[Ct(f,gn)]);do a.push(p),p=p+s,c==10&&!Xt.has(p)&&(p=we(p,Xt.get(
s))),p>=f&&(s=p,f=s*c,c==10&&(f=gn[Ct(f,gn)]));while(p<=o);return a}function yp(t,e,n,o,s,r,i){let c=t.scales[t.axes[e].scale].asinh,h=o>c?Cr(t,e,tt(c,n),o,s):[
c],u=o>=0&&n<=0?[0]:[];return(n<-c?Cr(t,e,tt(c,-o),-n,s):[c]).reverse().map(f=>-f).concat(u,h)}var xl=/./,wp=/[12357]/,bp=/[125]/,Ua=/1/,_r=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function vp(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],c=t.valToPos,h=r._space,u=c(10,i),p=c(
9,i)-u>=h?xl:c(7,i)-u>=h?wp:c(5,i)-u>=h?bp:Ua;if(p==Ua){let f=Oe(c(1,i)-u);if(f<h)return _r(e.slice().reverse(),a.distr,p,xt(h/f)).reverse()}return _r(e,a.distr,
p,1)}function xp(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,c=t.valToPos,h=Oe(c(1,i)-c(2,i));return h<a?_r(e.slice().reverse(),3,xl,xt(a/h)).reverse():e}function kp(t,e,n,o){
return o==null?$r:e==null?"":Ur(e)}var Wa={show:!0,scale:"y",stroke:Rr,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:bl,side:3,grid:Hr,ticks:yl,
border:wl,font:Br,lineGap:vl,rotate:0};function Sp(t,e){let n=3+(t||1)*2;return we(n*e,3)}function Mp(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Oe(i-r),c=t.series[e],h=a/(c.points.space*pe);return o[1]-o[0]<=h}var Ga={scale:null,auto:!0,sorted:0,min:ye,max:-ye},
kl=(t,e,n,o,s)=>s,za={show:!0,auto:!0,sorted:0,gaps:kl,alpha:1,facets:[Re({},Ga,{scale:"x"}),Re({},Ga,{scale:"y"})]},Ha={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:kl,alpha:1,points:{show:Mp,filter:null},values:null,min:ye,max:-ye,idxs:[],path:null,clip:null};function Tp(t,e,n,o,s){return n/10}var Sl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Pp=Re({},Sl,{time:!1,ori:1}),Ba={};function Ml(t,e){let n=Ba[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,c,h){for(let u=0;u<n.plots.length;u++)n.plots[u]!=s&&n.plots[u].pub(o,s,r,i,a,c,h)}},t!=null&&(Ba[t]=
n)),n}var no=1,Lr=2;function vn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,c=r[0],h=o==2?r[1]:r[e],u=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],p=o==2?i[s.facets[1].scale]:i[s.scale],f=a.left,y=a.top,w=a.width,k=a.height,M=t.valToPosH,T=t.valToPosV;return u.ori==0?n(s,c,h,u,p,M,T,f,
y,w,k,us,so,ms,Pl,Al):n(s,c,h,u,p,T,M,y,f,k,w,fs,ro,Kr,El,Cl)}function Vr(t,e){let n=0,o=0,s=he(t.bands,Wr);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function Ep(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
c=t.scales[a];return s==-1?c.min:s==1?c.max:c.distr==3?c.dir==1?c.min:c.max:0}function Vt(t,e,n,o,s,r){return vn(t,e,(i,a,c,h,u,p,f,y,w,k,M)=>{let T=i.pxRound,S=h.
dir*(h.ori==0?1:-1),E=h.ori==0?so:ro,A,J;S==1?(A=n,J=o):(A=o,J=n);let R=T(p(a[A],h,k,y)),Y=T(f(c[A],u,M,w)),V=T(p(a[J],h,k,y)),Q=T(f(r==1?u.max:u.min,u,M,w)),B=new Path2D(
s);return E(B,V,Q),E(B,R,Q),E(B,R,Y),B})}function ps(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?ms:Kr,c=n;for(let p=0;p<t.length;p++){let f=t[p];
if(f[1]>f[0]){let y=f[0]-c;y>0&&a(i,c,o,y,o+r),c=f[1]}}let h=n+s-c,u=10;h>0&&a(i,c,o-u/2,h,o+r+u)}return i}function Ap(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function jr(t,e,n,o,s,r,i){let a=[],c=t.length;for(let h=s==1?n:o;h>=n&&h<=o;h+=s)if(e[h]===null){let p=h,f=h;if(s==1)for(;++h<=o&&e[h]===null;)
f=h;else for(;--h>=n&&e[h]===null;)f=h;let y=r(t[p]),w=f==p?y:r(t[f]),k=p-s;y=i<=0&&k>=0&&k<c?r(t[k]):y;let T=f+s;w=i>=0&&T>=0&&T<c?r(t[T]):w,w>=y&&a.push([y,w])}
return a}function Va(t){return t==0?tl:t==1?Fe:e=>mn(e,t)}function Tl(t){let e=t==0?us:fs,n=t==0?(s,r,i,a,c,h)=>{s.arcTo(r,i,a,c,h)}:(s,r,i,a,c,h)=>{s.arcTo(i,r,
c,a,h)},o=t==0?(s,r,i,a,c)=>{s.rect(r,i,a,c)}:(s,r,i,a,c)=>{s.rect(i,r,c,a)};return(s,r,i,a,c,h=0,u=0)=>{h==0&&u==0?o(s,r,i,a,c):(h=_t(h,a/2,c/2),u=_t(u,a/2,c/2),
e(s,r+h,i),n(s,r+a,i,r+a,i+c,h),n(s,r+a,i+c,r,i+c,u),n(s,r,i+c,r,i,u),n(s,r,i,r+a,i,h),s.closePath())}}var us=(t,e,n)=>{t.moveTo(e,n)},fs=(t,e,n)=>{t.moveTo(n,e)},
so=(t,e,n)=>{t.lineTo(e,n)},ro=(t,e,n)=>{t.lineTo(n,e)},ms=Tl(0),Kr=Tl(1),Pl=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},El=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},Al=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},Cl=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function _l(t){return(e,n,o,s,r)=>vn(e,n,(i,a,c,h,u,p,f,y,w,k,M)=>{let{pxRound:T,
points:S}=i,E,A;h.ori==0?(E=us,A=Pl):(E=fs,A=El);let J=we(S.width*pe,3),R=(S.size-S.width)/2*pe,Y=we(R*2,3),V=new Path2D,Q=new Path2D,{left:B,top:D,width:j,height:L}=e.
bbox;ms(Q,B-Y,D-Y,j+Y*2,L+Y*2);let F=I=>{if(c[I]!=null){let K=T(p(a[I],h,k,y)),G=T(f(c[I],u,M,w));E(V,K+R,G),A(V,K,G,R,0,ss*2)}};if(r)r.forEach(F);else for(let I=o;I<=
s;I++)F(I);return{stroke:J>0?V:null,fill:V,clip:Q,flags:no|Lr}})}function Ll(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var Cp=Ll(so),_p=Ll(ro);function Dl(t){let e=he(t?.alignGaps,0);return(n,o,s,r)=>vn(n,o,(i,a,c,h,u,p,f,y,w,k,M)=>{[s,r]=ls(c,s,r);let T=i.pxRound,S=L=>T(p(L,h,k,
y)),E=L=>T(f(L,u,M,w)),A,J;h.ori==0?(A=so,J=Cp):(A=ro,J=_p);let R=h.dir*(h.ori==0?1:-1),Y={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:no},V=Y.
stroke,Q=!1;if(r-s>=k*4){let L=z=>n.posToVal(z,h.key,!0),F=null,I=null,K,G,Le,ue=S(a[R==1?s:r]),oe=S(a[s]),ae=S(a[r]),ee=L(R==1?oe+1:ae-1);for(let z=R==1?s:r;z>=
s&&z<=r;z+=R){let Te=a[z],ge=(R==1?Te<ee:Te>ee)?ue:S(Te),le=c[z];ge==ue?le!=null?(G=le,F==null?(A(V,ge,E(G)),K=F=I=G):G<F?F=G:G>I&&(I=G)):le===null&&(Q=!0):(F!=
null&&J(V,ue,E(F),E(I),E(K),E(G)),le!=null?(G=le,A(V,ge,E(G)),F=I=K=G):(F=I=null,le===null&&(Q=!0)),ue=ge,ee=L(ue+R))}F!=null&&F!=I&&Le!=ue&&J(V,ue,E(F),E(I),E(
K),E(G))}else for(let L=R==1?s:r;L>=s&&L<=r;L+=R){let F=c[L];F===null?Q=!0:F!=null&&A(V,S(a[L]),E(F))}let[D,j]=Vr(n,o);if(i.fill!=null||D!=0){let L=Y.fill=new Path2D(
V),F=i.fillTo(n,o,i.min,i.max,D),I=E(F),K=S(a[s]),G=S(a[r]);R==-1&&([G,K]=[K,G]),A(L,G,I),A(L,K,I)}if(!i.spanGaps){let L=[];Q&&L.push(...jr(a,c,s,r,R,S,e)),Y.gaps=
L=i.gaps(n,o,s,r,L),Y.clip=ps(L,h.ori,y,w,k,M)}return j!=0&&(Y.band=j==2?[Vt(n,o,s,r,V,-1),Vt(n,o,s,r,V,1)]:Vt(n,o,s,r,V,j)),Y})}function Lp(t){let e=he(t.align,
1),n=he(t.ascDesc,!1),o=he(t.alignGaps,0),s=he(t.extend,!1);return(r,i,a,c)=>vn(r,i,(h,u,p,f,y,w,k,M,T,S,E)=>{[a,c]=ls(p,a,c);let A=h.pxRound,{left:J,width:R}=r.
bbox,Y=oe=>A(w(oe,f,S,M)),V=oe=>A(k(oe,y,E,T)),Q=f.ori==0?so:ro,B={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:no},D=B.stroke,j=f.dir*(f.ori==
0?1:-1),L=V(p[j==1?a:c]),F=Y(u[j==1?a:c]),I=F,K=F;s&&e==-1&&(K=J,Q(D,K,L)),Q(D,F,L);for(let oe=j==1?a:c;oe>=a&&oe<=c;oe+=j){let ae=p[oe];if(ae==null)continue;let ee=Y(
u[oe]),z=V(ae);e==1?Q(D,ee,L):Q(D,I,z),Q(D,ee,z),L=z,I=ee}let G=I;s&&e==1&&(G=J+R,Q(D,G,L));let[Le,ue]=Vr(r,i);if(h.fill!=null||Le!=0){let oe=B.fill=new Path2D(
D),ae=h.fillTo(r,i,h.min,h.max,Le),ee=V(ae);Q(oe,G,ee),Q(oe,K,ee)}if(!h.spanGaps){let oe=[];oe.push(...jr(u,p,a,c,j,Y,o));let ae=h.width*pe/2,ee=n||e==1?ae:-ae,
z=n||e==-1?-ae:ae;oe.forEach(Te=>{Te[0]+=ee,Te[1]+=z}),B.gaps=oe=h.gaps(r,i,a,c,oe),B.clip=ps(oe,f.ori,M,T,S,E)}return ue!=0&&(B.band=ue==2?[Vt(r,i,a,c,D,-1),Vt(
r,i,a,c,D,1)]:Vt(r,i,a,c,D,ue)),B})}function ja(t,e,n,o,s,r,i=ye){if(t.length>1){let a=null;for(let c=0,h=1/0;c<t.length;c++)if(e[c]!==void 0){if(a!=null){let u=Oe(
t[c]-t[a]);u<h&&(h=u,i=Oe(n(t[c],o,s,r)-n(t[a],o,s,r)))}a=c}}return i}function Dp(t){t=t||To;let e=he(t.size,[.6,ye,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==
null?[0,0]:typeof s=="number"?[s,0]:s;let r=re(s),i=1-e[0],a=he(e[1],ye),c=he(e[2],1),h=he(t.disp,To),u=he(t.each,y=>{}),{fill:p,stroke:f}=h;return(y,w,k,M)=>vn(
y,w,(T,S,E,A,J,R,Y,V,Q,B,D)=>{let j=T.pxRound,L=n,F=o*pe,I=a*pe,K=c*pe,G,Le;A.ori==0?[G,Le]=r(y,w):[Le,G]=r(y,w);let ue=A.dir*(A.ori==0?1:-1),oe=A.ori==0?ms:Kr,
ae=A.ori==0?u:(U,be,$e,Sn,on,Lt,sn)=>{u(U,be,$e,on,Sn,sn,Lt)},ee=he(y.bands,Wr).find(U=>U.series[0]==w),z=ee!=null?ee.dir:0,Te=T.fillTo(y,w,T.min,T.max,z),Ue=j(
Y(Te,J,D,Q)),ge,le,nt,ot=B,Pe=j(T.width*pe),kt=!1,ft=null,q=null,ie=null,je=null;p!=null&&(Pe==0||f!=null)&&(kt=!0,ft=p.values(y,w,k,M),q=new Map,new Set(ft).forEach(
U=>{U!=null&&q.set(U,new Path2D)}),Pe>0&&(ie=f.values(y,w,k,M),je=new Map,new Set(ie).forEach(U=>{U!=null&&je.set(U,new Path2D)})));let{x0:Wt,size:ao}=h;if(Wt!=
null&&ao!=null){L=1,S=Wt.values(y,w,k,M),Wt.unit==2&&(S=S.map($e=>y.posToVal(V+$e*B,A.key,!0)));let U=ao.values(y,w,k,M);ao.unit==2?le=U[0]*B:le=R(U[0],A,B,V)-R(
0,A,B,V),ot=ja(S,E,R,A,B,V,ot),nt=ot-le+F}else ot=ja(S,E,R,A,B,V,ot),nt=ot*i+F,le=ot-nt;nt<1&&(nt=0),Pe>=le/2&&(Pe=0),nt<5&&(j=tl);let Eo=nt>0,tn=ot-nt-(Eo?Pe:0);
le=j(Ar(tn,K,I)),ge=(L==0?le/2:L==ue?0:le)-L*ue*((L==0?F/2:0)+(Eo?Pe/2:0));let Ze={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},kn=kt?null:new Path2D,
Gt=null;if(ee!=null)Gt=y.data[ee.series[1]];else{let{y0:U,y1:be}=h;U!=null&&be!=null&&(E=be.values(y,w,k,M),Gt=U.values(y,w,k,M))}let nn=G*le,te=Le*le;for(let U=ue==
1?k:M;U>=k&&U<=M;U+=ue){let be=E[U];if(be==null)continue;if(Gt!=null){let st=Gt[U]??0;if(be-st==0)continue;Ue=Y(st,J,D,Q)}let $e=A.distr!=2||h!=null?S[U]:U,Sn=R(
$e,A,B,V),on=Y(he(be,Te),J,D,Q),Lt=j(Sn-ge),sn=j(tt(on,Ue)),it=j(_t(on,Ue)),mt=sn-it;if(be!=null){let st=be<0?te:nn,St=be<0?nn:te;kt?(Pe>0&&ie[U]!=null&&oe(je.get(
ie[U]),Lt,it+pt(Pe/2),le,tt(0,mt-Pe),st,St),ft[U]!=null&&oe(q.get(ft[U]),Lt,it+pt(Pe/2),le,tt(0,mt-Pe),st,St)):oe(kn,Lt,it+pt(Pe/2),le,tt(0,mt-Pe),st,St),ae(y,w,
U,Lt-Pe/2,it,le+Pe,mt)}}return Pe>0?Ze.stroke=kt?je:kn:kt||(Ze._fill=T.width==0?T._fill:T._stroke??T._fill,Ze.width=0),Ze.fill=kt?q:kn,Ze})}function Np(t,e){let n=he(
e?.alignGaps,0);return(o,s,r,i)=>vn(o,s,(a,c,h,u,p,f,y,w,k,M,T)=>{[r,i]=ls(h,r,i);let S=a.pxRound,E=G=>S(f(G,u,M,w)),A=G=>S(y(G,p,T,k)),J,R,Y;u.ori==0?(J=us,Y=so,
R=Al):(J=fs,Y=ro,R=Cl);let V=u.dir*(u.ori==0?1:-1),Q=E(c[V==1?r:i]),B=Q,D=[],j=[];for(let G=V==1?r:i;G>=r&&G<=i;G+=V)if(h[G]!=null){let ue=c[G],oe=E(ue);D.push(
B=oe),j.push(A(h[G]))}let L={stroke:t(D,j,J,Y,R,S),fill:null,clip:null,band:null,gaps:null,flags:no},F=L.stroke,[I,K]=Vr(o,s);if(a.fill!=null||I!=0){let G=L.fill=
new Path2D(F),Le=a.fillTo(o,s,a.min,a.max,I),ue=A(Le);Y(G,B,ue),Y(G,Q,ue)}if(!a.spanGaps){let G=[];G.push(...jr(c,h,r,i,V,E,n)),L.gaps=G=a.gaps(o,s,r,i,G),L.clip=
ps(G,u.ori,w,k,M,T)}return K!=0&&(L.band=K==2?[Vt(o,s,r,i,F,-1),Vt(o,s,r,i,F,1)]:Vt(o,s,r,i,F,K)),L})}function Rp(t){return Np($p,t)}function $p(t,e,n,o,s,r){let i=t.
length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let c=Array(i),h=Array(i-1),u=Array(i-1),p=Array(i-1);for(let f=0;f<i-1;f++)
u[f]=e[f+1]-e[f],p[f]=t[f+1]-t[f],h[f]=u[f]/p[f];c[0]=h[0];for(let f=1;f<i-1;f++)h[f]===0||h[f-1]===0||h[f-1]>0!=h[f]>0?c[f]=0:(c[f]=3*(p[f-1]+p[f])/((2*p[f]+p[f-
1])/h[f-1]+(p[f]+2*p[f-1])/h[f]),isFinite(c[f])||(c[f]=0));c[i-1]=h[i-2];for(let f=0;f<i-1;f++)s(a,t[f]+p[f]/3,e[f]+c[f]*p[f]/3,t[f+1]-p[f]/3,e[f+1]-c[f+1]*p[f]/
3,t[f+1],e[f+1])}return a}var Dr=new Set;function Ka(){for(let t of Dr)t.syncRect(!0)}oo&&(wn(md,Qn,Ka),wn(gd,Qn,Ka,!0),wn(rs,Qn,()=>{Ie.pxRatio=pe}));var Fp=Dl(),
Op=_l();function qa(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Nr(r,i,e,n))}function Ip(t,e){return t.map((n,o)=>o==
0?{}:Re({},e,n))}function Nr(t,e,n,o){return Re({},e==0?n:o,t)}function Nl(t,e,n){return e==null?eo:[e,n]}var Up=Nl;function Wp(t,e,n){return e==null?eo:is(e,n,
Ir,!0)}function Rl(t,e,n,o){return e==null?eo:cs(e,n,t.scales[o].log,!1)}var Gp=Rl;function $l(t,e,n,o){return e==null?eo:Or(e,n,t.scales[o].log,!1)}var zp=$l;function Hp(t,e,n,o,s){
let r=tt(Pa(t),Pa(e)),i=e-t,a=Ct(s/o*i,n);do{let c=n[a],h=o*c/i;if(h>=s&&r+(c<5?Xt.get(c):0)<=17)return[c,h]}while(++a<n.length);return[0,0]}function Ya(t){let e,
n;return t=t.replace(/(\d+)px/,(o,s)=>(e=Fe((n=+s)*pe))+"px"),[t,e,n]}function Bp(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=we(e[2]*pe,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Ie(t,e,n){let o={mode:he(t.mode,1)},s=o.mode;function r(l,d,m,g){let b=d.valToPct(l);return g+m*(d.dir==-1?1-b:b)}function i(l,d,m,g){
let b=d.valToPct(l);return g+m*(d.dir==-1?b:1-b)}function a(l,d,m,g){return d.ori==0?r(l,d,m,g):i(l,d,m,g)}o.valToPosH=r,o.valToPosV=i;let c=!1;o.status=0;let h=o.
root=vt(Zh);if(t.id!=null&&(h.id=t.id),dt(h,t.class),t.title){let l=vt(ed,h);l.textContent=t.title}let u=At("canvas"),p=o.ctx=u.getContext("2d"),f=vt(td,h);wn("\
click",f,l=>{l.target===w&&(ve!=Rn||Ee!=$n)&&qe.click(o,l)},!0);let y=o.under=vt(nd,f);f.appendChild(u);let w=o.over=vt(od,f);t=to(t);let k=+he(t.pxAlign,1),M=Va(
k);(t.plugins||[]).forEach(l=>{l.opts&&(t=l.opts(o,t)||t)});let T=t.ms||.001,S=o.series=s==1?qa(t.series||[],Ia,Ha,!1):Ip(t.series||[null],za),E=o.axes=qa(t.axes||
[],Oa,Wa,!0),A=o.scales={},J=o.bands=t.bands||[];J.forEach(l=>{l.fill=re(l.fill||null),l.dir=he(l.dir,-1)});let R=s==2?S[1].facets[0].scale:S[0].scale,Y={axes:oh,
series:Qc},V=(t.drawOrder||["axes","series"]).map(l=>Y[l]);function Q(l){let d=l.distr==3?m=>Bt(m>0?m:l.clamp(o,m,l.min,l.max,l.key)):l.distr==4?m=>vr(m,l.asinh):
l.distr==100?m=>l.fwd(m):m=>m;return m=>{let g=d(m),{_min:b,_max:v}=l,P=v-b;return(g-b)/P}}function B(l){let d=A[l];if(d==null){let m=(t.scales||To)[l]||To;if(m.
from!=null){B(m.from);let g=Re({},A[m.from],m,{key:l});g.valToPct=Q(g),A[l]=g}else{d=A[l]=Re({},l==R?Sl:Pp,m),d.key=l;let g=d.time,b=d.range,v=Qt(b);if((l!=R||s==
2&&!g)&&(v&&(b[0]==null||b[1]==null)&&(b={min:b[0]==null?Sa:{mode:1,hard:b[0],soft:b[0]},max:b[1]==null?Sa:{mode:1,hard:b[1],soft:b[1]}},v=!1),!v&&ds(b))){let P=b;
b=(_,N,$)=>N==null?eo:is(N,$,P)}d.range=re(b||(g?Up:l==R?d.distr==3?Gp:d.distr==4?zp:Nl:d.distr==3?Rl:d.distr==4?$l:Wp)),d.auto=re(v?!1:d.auto),d.clamp=re(d.clamp||
Tp),d._min=d._max=null,d.valToPct=Q(d)}}}B("x"),B("y"),s==1&&S.forEach(l=>{B(l.scale)}),E.forEach(l=>{B(l.scale)});for(let l in t.scales)B(l);let D=A[R],j=D.distr,
L,F;D.ori==0?(dt(h,Qh),L=r,F=i):(dt(h,Xh),L=i,F=r);let I={};for(let l in A){let d=A[l];(d.min!=null||d.max!=null)&&(I[l]={min:d.min,max:d.max},d.min=d.max=null)}
let K=t.tzDate||(l=>new Date(Fe(l/T))),G=t.fmtDate||Gr,Le=T==1?Qd(K):tp(K),ue=Ra(K,Na(T==1?Zd:ep,G)),oe=Fa(K,$a(op,G)),ae=[],ee=o.legend=Re({},ip,t.legend),z=o.
cursor=Re({},pp,{drag:{y:s==2}},t.cursor),Te=ee.show,Ue=z.show,ge=ee.markers;ee.idxs=ae,ge.width=re(ge.width),ge.dash=re(ge.dash),ge.stroke=re(ge.stroke),ge.fill=
re(ge.fill);let le,nt,ot,Pe=[],kt=[],ft,q=!1,ie={};if(ee.live){let l=S[1]?S[1].values:null;q=l!=null,ft=q?l(o,1,0):{_:0};for(let d in ft)ie[d]=$r}if(Te)if(le=At(
"table",cd,h),ot=At("tbody",null,le),ee.mount(o,le),q){nt=At("thead",null,le,ot);let l=At("tr",null,nt);At("th",null,l);for(var je in ft)At("th",ha,l).textContent=
je}else dt(le,dd),ee.live&&dt(le,hd);let Wt={show:!0},ao={show:!1};function Eo(l,d){if(d==0&&(q||!ee.live||s==2))return eo;let m=[],g=At("tr",pd,ot,ot.childNodes[d]);
dt(g,l.class),l.show||dt(g,yn);let b=At("th",null,g);if(ge.show){let _=vt(ud,b);if(d>0){let N=ge.width(o,d);N&&(_.style.border=N+"px "+ge.dash(o,d)+" "+ge.stroke(
o,d)),_.style.background=ge.fill(o,d)}}let v=vt(ha,b);l.label instanceof HTMLElement?v.appendChild(l.label):v.textContent=l.label,d>0&&(ge.show||(v.style.color=
l.width>0?ge.stroke(o,d):ge.fill(o,d)),Ze("click",b,_=>{if(z._lock)return;an(_);let N=S.indexOf(l);if((_.ctrlKey||_.metaKey)!=ee.isolate){let $=S.some((O,W)=>W>
0&&W!=N&&O.show);S.forEach((O,W)=>{W>0&&Nt(W,$?W==N?Wt:ao:Wt,!0,De.setSeries)})}else Nt(N,{show:!l.show},!0,De.setSeries)},!1),Tn&&Ze(fa,b,_=>{z._lock||(an(_),Nt(
S.indexOf(l),On,!0,De.setSeries))},!1));for(var P in ft){let _=At("td",fd,g);_.textContent="--",m.push(_)}return[g,m]}let tn=new Map;function Ze(l,d,m,g=!0){let b=tn.
get(d)||{},v=z.bind[l](o,d,m,g);v&&(wn(l,d,b[l]=v),tn.set(d,b))}function kn(l,d,m){let g=tn.get(d)||{};for(let b in g)(l==null||b==l)&&(Er(b,d,g[b]),delete g[b]);
l==null&&tn.delete(d)}let Gt=0,nn=0,te=0,U=0,be=0,$e=0,Sn=be,on=$e,Lt=te,sn=U,it=0,mt=0,st=0,St=0;o.bbox={};let Os=!1,Ao=!1,Mn=!1,rn=!1,Co=!1,gt=!1;function Is(l,d,m){
(m||l!=o.width||d!=o.height)&&si(l,d),_n(!1),Mn=!0,Ao=!0,Ln()}function si(l,d){o.width=Gt=te=l,o.height=nn=U=d,be=$e=0,Vc(),jc();let m=o.bbox;it=m.left=mn(be*pe,
.5),mt=m.top=mn($e*pe,.5),st=m.width=mn(te*pe,.5),St=m.height=mn(U*pe,.5)}let zc=3;function Hc(){let l=!1,d=0;for(;!l;){d++;let m=th(d),g=nh(d);l=d==zc||m&&g,l||
(si(o.width,o.height),Ao=!0)}}function Bc({width:l,height:d}){Is(l,d)}o.setSize=Bc;function Vc(){let l=!1,d=!1,m=!1,g=!1;E.forEach((b,v)=>{if(b.show&&b._show){let{
side:P,_size:_}=b,N=P%2,$=b.label!=null?b.labelSize:0,O=_+$;O>0&&(N?(te-=O,P==3?(be+=O,g=!0):m=!0):(U-=O,P==0?($e+=O,l=!0):d=!0))}}),ln[0]=l,ln[1]=m,ln[2]=d,ln[3]=
g,te-=jt[1]+jt[3],be+=jt[3],U-=jt[2]+jt[0],$e+=jt[0]}function jc(){let l=be+te,d=$e+U,m=be,g=$e;function b(v,P){switch(v){case 1:return l+=P,l-P;case 2:return d+=
P,d-P;case 3:return m-=P,m+P;case 0:return g-=P,g+P}}E.forEach((v,P)=>{if(v.show&&v._show){let _=v.side;v._pos=b(_,v._size),v.label!=null&&(v._lpos=b(_,v.labelSize))}})}
if(z.dataIdx==null){let l=z.hover,d=l.skip=new Set(l.skip??[]);d.add(void 0);let m=l.prox=re(l.prox),g=l.bias??=0;z.dataIdx=(b,v,P,_)=>{if(v==0)return P;let N=P,
$=m(b,v,P,_)??ye,O=$>=0&&$<ye,W=D.ori==0?te:U,X=z.left,de=e[0],ce=e[v];if(d.has(ce[P])){N=null;let se=null,Z=null,H;if(g==0||g==-1)for(H=P;se==null&&H-- >0;)d.has(
ce[H])||(se=H);if(g==0||g==1)for(H=P;Z==null&&H++<ce.length;)d.has(ce[H])||(Z=H);if(se!=null||Z!=null)if(O){let ke=se==null?-1/0:L(de[se],D,W,0),Ce=Z==null?1/0:
L(de[Z],D,W,0),Ve=X-ke,me=Ce-X;Ve<=me?Ve<=$&&(N=se):me<=$&&(N=Z)}else N=Z==null?se:se==null?Z:P-se<=Z-P?se:Z}else O&&Oe(X-L(de[P],D,W,0))>$&&(N=null);return N}}
let an=l=>{z.event=l};z.idxs=ae,z._lock=!1;let Je=z.points;Je.show=re(Je.show),Je.size=re(Je.size),Je.stroke=re(Je.stroke),Je.width=re(Je.width),Je.fill=re(Je.fill);
let Dt=o.focus=Re({},t.focus||{alpha:.3},z.focus),Tn=Dt.prox>=0,Pn=Tn&&Je.one,yt=[],En=[],An=[];function ri(l,d){let m=Je.show(o,d);if(m instanceof HTMLElement)
return dt(m,ld),dt(m,l.class),Ut(m,-10,-10,te,U),w.insertBefore(m,yt[d]),m}function ii(l,d){if(s==1||d>0){let m=s==1&&A[l.scale].time,g=l.value;l.value=m?Ca(g)?
Fa(K,$a(g,G)):g||oe:g||kp,l.label=l.label||(m?fp:up)}if(Pn||d>0){l.width=l.width==null?1:l.width,l.paths=l.paths||Fp||Pd,l.fillTo=re(l.fillTo||Ep),l.pxAlign=+he(
l.pxAlign,k),l.pxRound=Va(l.pxAlign),l.stroke=re(l.stroke||null),l.fill=re(l.fill||null),l._stroke=l._fill=l._paths=l._focus=null;let m=Sp(tt(1,l.width),1),g=l.
points=Re({},{size:m,width:tt(1,m*.2),stroke:l.stroke,space:m*2,paths:Op,_stroke:null,_fill:null},l.points);g.show=re(g.show),g.filter=re(g.filter),g.fill=re(g.
fill),g.stroke=re(g.stroke),g.paths=re(g.paths),g.pxAlign=l.pxAlign}if(Te){let m=Eo(l,d);Pe.splice(d,0,m[0]),kt.splice(d,0,m[1]),ee.values.push(null)}if(Ue){ae.
splice(d,0,null);let m=null;Pn?d==0&&(m=ri(l,d)):d>0&&(m=ri(l,d)),yt.splice(d,0,m),En.splice(d,0,0),An.splice(d,0,0)}Be("addSeries",d)}function Kc(l,d){d=d??S.length,
l=s==1?Nr(l,d,Ia,Ha):Nr(l,d,{},za),S.splice(d,0,l),ii(S[d],d)}o.addSeries=Kc;function qc(l){if(S.splice(l,1),Te){ee.values.splice(l,1),kt.splice(l,1);let d=Pe.splice(
l,1)[0];kn(null,d.firstChild),d.remove()}Ue&&(ae.splice(l,1),yt.splice(l,1)[0].remove(),En.splice(l,1),An.splice(l,1)),Be("delSeries",l)}o.delSeries=qc;let ln=[
!1,!1,!1,!1];function Yc(l,d){if(l._show=l.show,l.show){let m=l.side%2,g=A[l.scale];g==null&&(l.scale=m?S[1].scale:R,g=A[l.scale]);let b=g.time;l.size=re(l.size),
l.space=re(l.space),l.rotate=re(l.rotate),Qt(l.incrs)&&l.incrs.forEach(P=>{!Xt.has(P)&&Xt.set(P,sl(P))}),l.incrs=re(l.incrs||(g.distr==2?qd:b?T==1?Jd:Xd:gn)),l.
splits=re(l.splits||(b&&g.distr==1?Le:g.distr==3?Cr:g.distr==4?yp:gp)),l.stroke=re(l.stroke),l.grid.stroke=re(l.grid.stroke),l.ticks.stroke=re(l.ticks.stroke),l.
border.stroke=re(l.border.stroke);let v=l.values;l.values=Qt(v)&&!Qt(v[0])?re(v):b?Qt(v)?Ra(K,Na(v,G)):Ca(v)?np(K,v):v||ue:v||mp,l.filter=re(l.filter||(g.distr>=
3&&g.log==10?vp:g.distr==3&&g.log==2?xp:nl)),l.font=Ya(l.font),l.labelFont=Ya(l.labelFont),l._size=l.size(o,null,d,0),l._space=l._rotate=l._incrs=l._found=l._splits=
l._values=null,l._size>0&&(ln[d]=!0,l._el=vt(sd,f))}}function lo(l,d,m,g){let[b,v,P,_]=m,N=d%2,$=0;return N==0&&(_||v)&&($=d==0&&!b||d==2&&!P?Fe(Oa.size/3):0),N==
1&&(b||P)&&($=d==1&&!v||d==3&&!_?Fe(Wa.size/2):0),$}let ai=o.padding=(t.padding||[lo,lo,lo,lo]).map(l=>re(he(l,lo))),jt=o._padding=ai.map((l,d)=>l(o,d,ln,0)),Ke,
We=null,Ge=null,_o=s==1?S[0].idxs:null,Mt=null,co=!1;function li(l,d){if(e=l??[],o.data=o._data=e,s==2){Ke=0;for(let m=1;m<S.length;m++)Ke+=e[m][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),Mt=e[0],Ke=Mt.length;let m=e;if(j==2){m=e.slice();let g=m[0]=Array(Ke);for(let b=0;b<Ke;b++)g[b]=b}o._data=e=m}if(_n(!0),Be(
"setData"),j==2&&(Mn=!0),d!==!1){let m=D;m.auto(o,co)?Us():qt(R,m.min,m.max),rn=rn||z.left>=0,gt=!0,Ln()}}o.setData=li;function Us(){co=!0;let l,d;s==1&&(Ke>0?(We=
_o[0]=0,Ge=_o[1]=Ke-1,l=e[0][We],d=e[0][Ge],j==2?(l=We,d=Ge):l==d&&(j==3?[l,d]=cs(l,l,D.log,!1):j==4?[l,d]=Or(l,l,D.log,!1):D.time?d=l+Fe(86400/T):[l,d]=is(l,d,
Ir,!0))):(We=_o[0]=l=null,Ge=_o[1]=d=null)),qt(R,l,d)}let Lo,Cn,Ws,Gs,zs,Hs,Bs,Vs,js,rt;function ci(l,d,m,g,b,v){l??=pa,m??=Wr,g??="butt",b??=pa,v??="round",l!=
Lo&&(p.strokeStyle=Lo=l),b!=Cn&&(p.fillStyle=Cn=b),d!=Ws&&(p.lineWidth=Ws=d),v!=zs&&(p.lineJoin=zs=v),g!=Hs&&(p.lineCap=Hs=g),m!=Gs&&p.setLineDash(Gs=m)}function hi(l,d,m,g){
d!=Cn&&(p.fillStyle=Cn=d),l!=Bs&&(p.font=Bs=l),m!=Vs&&(p.textAlign=Vs=m),g!=js&&(p.textBaseline=js=g)}function Ks(l,d,m,g,b=0){if(g.length>0&&l.auto(o,co)&&(d==
null||d.min==null)){let v=he(We,0),P=he(Ge,g.length-1),_=m.min==null?vd(g,v,P,b,l.distr==3):[m.min,m.max];l.min=_t(l.min,m.min=_[0]),l.max=tt(l.max,m.max=_[1])}}
let di={min:null,max:null};function Jc(){for(let g in A){let b=A[g];I[g]==null&&(b.min==null||I[R]!=null&&b.auto(o,co))&&(I[g]=di)}for(let g in A){let b=A[g];I[g]==
null&&b.from!=null&&I[b.from]!=null&&(I[g]=di)}I[R]!=null&&_n(!0);let l={};for(let g in I){let b=I[g];if(b!=null){let v=l[g]=to(A[g],Cd);if(b.min!=null)Re(v,b);else if(g!=
R||s==2)if(Ke==0&&v.from==null){let P=v.range(o,null,null,g);v.min=P[0],v.max=P[1]}else v.min=ye,v.max=-ye}}if(Ke>0){S.forEach((g,b)=>{if(s==1){let v=g.scale,P=I[v];
if(P==null)return;let _=l[v];if(b==0){let N=_.range(o,_.min,_.max,v);_.min=N[0],_.max=N[1],We=Ct(_.min,e[0]),Ge=Ct(_.max,e[0]),Ge-We>1&&(e[0][We]<_.min&&We++,e[0][Ge]>
_.max&&Ge--),g.min=Mt[We],g.max=Mt[Ge]}else g.show&&g.auto&&Ks(_,P,g,e[b],g.sorted);g.idxs[0]=We,g.idxs[1]=Ge}else if(b>0&&g.show&&g.auto){let[v,P]=g.facets,_=v.
scale,N=P.scale,[$,O]=e[b],W=l[_],X=l[N];W!=null&&Ks(W,I[_],v,$,v.sorted),X!=null&&Ks(X,I[N],P,O,P.sorted),g.min=P.min,g.max=P.max}});for(let g in l){let b=l[g],
v=I[g];if(b.from==null&&(v==null||v.min==null)){let P=b.range(o,b.min==ye?null:b.min,b.max==-ye?null:b.max,g);b.min=P[0],b.max=P[1]}}}for(let g in l){let b=l[g];
if(b.from!=null){let v=l[b.from];if(v.min==null)b.min=b.max=null;else{let P=b.range(o,v.min,v.max,g);b.min=P[0],b.max=P[1]}}}let d={},m=!1;for(let g in l){let b=l[g],
v=A[g];if(v.min!=b.min||v.max!=b.max){v.min=b.min,v.max=b.max;let P=v.distr;v._min=P==3?Bt(v.min):P==4?vr(v.min,v.asinh):P==100?v.fwd(v.min):v.min,v._max=P==3?Bt(
v.max):P==4?vr(v.max,v.asinh):P==100?v.fwd(v.max):v.max,d[g]=m=!0}}if(m){S.forEach((g,b)=>{s==2?b>0&&d.y&&(g._paths=null):d[g.scale]&&(g._paths=null)});for(let g in d)
Mn=!0,Be("setScale",g);Ue&&z.left>=0&&(rn=gt=!0)}for(let g in I)I[g]=null}function Zc(l){let d=Ar(We-1,0,Ke-1),m=Ar(Ge+1,0,Ke-1);for(;l[d]==null&&d>0;)d--;for(;l[m]==
null&&m<Ke-1;)m++;return[d,m]}function Qc(){if(Ke>0){let l=S.some(d=>d._focus)&&rt!=Dt.alpha;l&&(p.globalAlpha=rt=Dt.alpha),S.forEach((d,m)=>{if(m>0&&d.show&&(pi(
m,!1),pi(m,!0),d._paths==null)){let g=rt;rt!=d.alpha&&(p.globalAlpha=rt=d.alpha);let b=s==2?[0,e[m][0].length-1]:Zc(e[m]);d._paths=d.paths(o,m,b[0],b[1]),rt!=g&&
(p.globalAlpha=rt=g)}}),S.forEach((d,m)=>{if(m>0&&d.show){let g=rt;rt!=d.alpha&&(p.globalAlpha=rt=d.alpha),d._paths!=null&&ui(m,!1);{let b=d._paths!=null?d._paths.
gaps:null,v=d.points.show(o,m,We,Ge,b),P=d.points.filter(o,m,v,b);(v||P)&&(d.points._paths=d.points.paths(o,m,We,Ge,P),ui(m,!0))}rt!=g&&(p.globalAlpha=rt=g),Be(
"drawSeries",m)}}),l&&(p.globalAlpha=rt=1)}}function pi(l,d){let m=d?S[l].points:S[l];m._stroke=m.stroke(o,l),m._fill=m.fill(o,l)}function ui(l,d){let m=d?S[l].
points:S[l],{stroke:g,fill:b,clip:v,flags:P,_stroke:_=m._stroke,_fill:N=m._fill,_width:$=m.width}=m._paths;$=we($*pe,3);let O=null,W=$%2/2;d&&N==null&&(N=$>0?"#\
fff":_);let X=m.pxAlign==1&&W>0;if(X&&p.translate(W,W),!d){let de=it-$/2,ce=mt-$/2,se=st+$,Z=St+$;O=new Path2D,O.rect(de,ce,se,Z)}d?qs(_,$,m.dash,m.cap,N,g,b,P,
v):Xc(l,_,$,m.dash,m.cap,N,g,b,P,O,v),X&&p.translate(-W,-W)}function Xc(l,d,m,g,b,v,P,_,N,$,O){let W=!1;N!=0&&J.forEach((X,de)=>{if(X.series[0]==l){let ce=S[X.series[1]],
se=e[X.series[1]],Z=(ce._paths||To).band;Qt(Z)&&(Z=X.dir==1?Z[0]:Z[1]);let H,ke=null;ce.show&&Z&&kd(se,We,Ge)?(ke=X.fill(o,de)||v,H=ce._paths.clip):Z=null,qs(d,
m,g,b,ke,P,_,N,$,O,H,Z),W=!0}}),W||qs(d,m,g,b,v,P,_,N,$,O)}let fi=no|Lr;function qs(l,d,m,g,b,v,P,_,N,$,O,W){ci(l,d,m,g,b),(N||$||W)&&(p.save(),N&&p.clip(N),$&&
p.clip($)),W?(_&fi)==fi?(p.clip(W),O&&p.clip(O),No(b,P),Do(l,v,d)):_&Lr?(No(b,P),p.clip(W),Do(l,v,d)):_&no&&(p.save(),p.clip(W),O&&p.clip(O),No(b,P),p.restore(),
Do(l,v,d)):(No(b,P),Do(l,v,d)),(N||$||W)&&p.restore()}function Do(l,d,m){m>0&&(d instanceof Map?d.forEach((g,b)=>{p.strokeStyle=Lo=b,p.stroke(g)}):d!=null&&l&&p.
stroke(d))}function No(l,d){d instanceof Map?d.forEach((m,g)=>{p.fillStyle=Cn=g,p.fill(m)}):d!=null&&l&&p.fill(d)}function eh(l,d,m,g){let b=E[l],v;if(g<=0)v=[0,
0];else{let P=b._space=b.space(o,l,d,m,g),_=b._incrs=b.incrs(o,l,d,m,g,P);v=Hp(d,m,_,g,P)}return b._found=v}function Ys(l,d,m,g,b,v,P,_,N,$){let O=P%2/2;k==1&&p.
translate(O,O),ci(_,P,N,$,_),p.beginPath();let W,X,de,ce,se=b+(g==0||g==3?-v:v);m==0?(X=b,ce=se):(W=b,de=se);for(let Z=0;Z<l.length;Z++)d[Z]!=null&&(m==0?W=de=l[Z]:
X=ce=l[Z],p.moveTo(W,X),p.lineTo(de,ce));p.stroke(),k==1&&p.translate(-O,-O)}function th(l){let d=!0;return E.forEach((m,g)=>{if(!m.show)return;let b=A[m.scale];
if(b.min==null){m._show&&(d=!1,m._show=!1,_n(!1));return}else m._show||(d=!1,m._show=!0,_n(!1));let v=m.side,P=v%2,{min:_,max:N}=b,[$,O]=eh(g,_,N,P==0?te:U);if(O==
0)return;let W=b.distr==2,X=m._splits=m.splits(o,g,_,N,$,O,W),de=b.distr==2?X.map(H=>Mt[H]):X,ce=b.distr==2?Mt[X[1]]-Mt[X[0]]:$,se=m._values=m.values(o,m.filter(
o,de,g,O,ce),g,O,ce);m._rotate=v==2?m.rotate(o,se,g,O):0;let Z=m._size;m._size=xt(m.size(o,se,g,l)),Z!=null&&m._size!=Z&&(d=!1)}),d}function nh(l){let d=!0;return ai.
forEach((m,g)=>{let b=m(o,g,ln,l);b!=jt[g]&&(d=!1),jt[g]=b}),d}function oh(){for(let l=0;l<E.length;l++){let d=E[l];if(!d.show||!d._show)continue;let m=d.side,g=m%
2,b,v,P=d.stroke(o,l),_=m==0||m==3?-1:1,[N,$]=d._found;if(d.label!=null){let Xe=d.labelGap*_,ct=Fe((d._lpos+Xe)*pe);hi(d.labelFont[0],P,"center",m==2?"top":da),
p.save(),g==1?(b=v=0,p.translate(ct,Fe(mt+St/2)),p.rotate((m==3?-ss:ss)/2)):(b=Fe(it+st/2),v=ct);let dn=el(d.label)?d.label(o,l,N,$):d.label;p.fillText(dn,b,v),
p.restore()}if($==0)continue;let O=A[d.scale],W=g==0?st:St,X=g==0?it:mt,de=d._splits,ce=O.distr==2?de.map(Xe=>Mt[Xe]):de,se=O.distr==2?Mt[de[1]]-Mt[de[0]]:N,Z=d.
ticks,H=d.border,ke=Z.show?Z.size:0,Ce=Fe(ke*pe),Ve=Fe((d.alignTo==2?d._size-ke-d.gap:d.gap)*pe),me=d._rotate*-ss/180,_e=M(d._pos*pe),at=(Ce+Ve)*_,Qe=_e+at;v=g==
0?Qe:0,b=g==1?Qe:0;let wt=d.font[0],Tt=d.align==1?Jn:d.align==2?yr:me>0?Jn:me<0?yr:g==0?"center":m==3?yr:Jn,$t=me||g==1?"middle":m==2?"top":da;hi(wt,P,Tt,$t);let lt=d.
font[1]*d.lineGap,bt=de.map(Xe=>M(a(Xe,O,W,X))),Pt=d._values;for(let Xe=0;Xe<Pt.length;Xe++){let ct=Pt[Xe];if(ct!=null){g==0?b=bt[Xe]:v=bt[Xe],ct=""+ct;let dn=ct.
indexOf(`
`)==-1?[ct]:ct.split(/\n/gm);for(let et=0;et<dn.length;et++){let Ni=dn[et];me?(p.save(),p.translate(b,v+et*lt),p.rotate(me),p.fillText(Ni,0,0),p.restore()):p.fillText(
Ni,b,v+et*lt)}}}Z.show&&Ys(bt,Z.filter(o,ce,l,$,se),g,m,_e,Ce,we(Z.width*pe,3),Z.stroke(o,l),Z.dash,Z.cap);let Ft=d.grid;Ft.show&&Ys(bt,Ft.filter(o,ce,l,$,se),g,
g==0?2:1,g==0?mt:it,g==0?St:st,we(Ft.width*pe,3),Ft.stroke(o,l),Ft.dash,Ft.cap),H.show&&Ys([_e],[1],g==0?1:0,g==0?1:2,g==1?mt:it,g==1?St:st,we(H.width*pe,3),H.stroke(
o,l),H.dash,H.cap)}Be("drawAxes")}function _n(l){S.forEach((d,m)=>{m>0&&(d._paths=null,l&&(s==1?(d.min=null,d.max=null):d.facets.forEach(g=>{g.min=null,g.max=null})))})}
let Ro=!1,Js=!1,ho=[];function sh(){Js=!1;for(let l=0;l<ho.length;l++)Be(...ho[l]);ho.length=0}function Ln(){Ro||(Fd(mi),Ro=!0)}function rh(l,d=!1){Ro=!0,Js=d,l(
o),mi(),d&&ho.length>0&&queueMicrotask(sh)}o.batch=rh;function mi(){if(Os&&(Jc(),Os=!1),Mn&&(Hc(),Mn=!1),Ao){if(Me(y,Jn,be),Me(y,"top",$e),Me(y,xo,te),Me(y,ko,U),
Me(w,Jn,be),Me(w,"top",$e),Me(w,xo,te),Me(w,ko,U),Me(f,xo,Gt),Me(f,ko,nn),u.width=Fe(Gt*pe),u.height=Fe(nn*pe),E.forEach(({_el:l,_show:d,_size:m,_pos:g,side:b})=>{
if(l!=null)if(d){let v=b===3||b===0?m:0,P=b%2==1;Me(l,P?"left":"top",g-v),Me(l,P?"width":"height",m),Me(l,P?"top":"left",P?$e:be),Me(l,P?"height":"width",P?U:te),
Pr(l,yn)}else dt(l,yn)}),Lo=Cn=Ws=zs=Hs=Bs=Vs=js=Gs=null,rt=1,fo(!0),be!=Sn||$e!=on||te!=Lt||U!=sn){_n(!1);let l=te/Lt,d=U/sn;if(Ue&&!rn&&z.left>=0){z.left*=l,z.
top*=d,Dn&&Ut(Dn,Fe(z.left),0,te,U),Nn&&Ut(Nn,0,Fe(z.top),te,U);for(let m=0;m<yt.length;m++){let g=yt[m];g!=null&&(En[m]*=l,An[m]*=d,Ut(g,xt(En[m]),xt(An[m]),te,
U))}}if(xe.show&&!Co&&xe.left>=0&&xe.width>0){xe.left*=l,xe.width*=l,xe.top*=d,xe.height*=d;for(let m in nr)Me(Fn,m,xe[m])}Sn=be,on=$e,Lt=te,sn=U}Be("setSize"),
Ao=!1}Gt>0&&nn>0&&(p.clearRect(0,0,u.width,u.height),Be("drawClear"),V.forEach(l=>l()),Be("draw")),xe.show&&Co&&($o(xe),Co=!1),Ue&&rn&&(hn(null,!0,!1),rn=!1),ee.
show&&ee.live&&gt&&(er(),gt=!1),c||(c=!0,o.status=1,Be("ready")),co=!1,Ro=!1}o.redraw=(l,d)=>{Mn=d||!1,l!==!1?qt(R,D.min,D.max):Ln()};function Zs(l,d){let m=A[l];
if(m.from==null){if(Ke==0){let g=m.range(o,d.min,d.max,l);d.min=g[0],d.max=g[1]}if(d.min>d.max){let g=d.min;d.min=d.max,d.max=g}if(Ke>1&&d.min!=null&&d.max!=null&&
d.max-d.min<1e-16)return;l==R&&m.distr==2&&Ke>0&&(d.min=Ct(d.min,e[0]),d.max=Ct(d.max,e[0]),d.min==d.max&&d.max++),I[l]=d,Os=!0,Ln()}}o.setScale=Zs;let Qs,Xs,Dn,
Nn,gi,yi,Rn,$n,wi,bi,ve,Ee,Kt=!1,qe=z.drag,ze=qe.x,He=qe.y;Ue&&(z.x&&(Qs=vt(id,w)),z.y&&(Xs=vt(ad,w)),D.ori==0?(Dn=Qs,Nn=Xs):(Dn=Xs,Nn=Qs),ve=z.left,Ee=z.top);let xe=o.
select=Re({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Fn=xe.show?vt(rd,xe.over?w:y):null;function $o(l,d){if(xe.show){for(let m in l)xe[m]=l[m],m in
nr&&Me(Fn,m,l[m]);d!==!1&&Be("setSelect")}}o.setSelect=$o;function ih(l){if(S[l].show)Te&&Pr(Pe[l],yn);else if(Te&&dt(Pe[l],yn),Ue){let m=Pn?yt[0]:yt[l];m!=null&&
Ut(m,-10,-10,te,U)}}function qt(l,d,m){Zs(l,{min:d,max:m})}function Nt(l,d,m,g){d.focus!=null&&dh(l),d.show!=null&&S.forEach((b,v)=>{v>0&&(l==v||l==null)&&(b.show=
d.show,ih(v),s==2?(qt(b.facets[0].scale,null,null),qt(b.facets[1].scale,null,null)):qt(b.scale,null,null),Ln())}),m!==!1&&Be("setSeries",l,d),g&&mo("setSeries",
o,l,d)}o.setSeries=Nt;function ah(l,d){Re(J[l],d)}function lh(l,d){l.fill=re(l.fill||null),l.dir=he(l.dir,-1),d=d??J.length,J.splice(d,0,l)}function ch(l){l==null?
J.length=0:J.splice(l,1)}o.addBand=lh,o.setBand=ah,o.delBand=ch;function hh(l,d){S[l].alpha=d,Ue&&yt[l]!=null&&(yt[l].style.opacity=d),Te&&Pe[l]&&(Pe[l].style.opacity=
d)}let zt,Yt,cn,On={focus:!0};function dh(l){if(l!=cn){let d=l==null,m=Dt.alpha!=1;S.forEach((g,b)=>{if(s==1||b>0){let v=d||b==0||b==l;g._focus=d?null:v,m&&hh(b,
v?1:Dt.alpha)}}),cn=l,m&&Ln()}}Te&&Tn&&Ze(ma,le,l=>{z._lock||(an(l),cn!=null&&Nt(null,On,!0,De.setSeries))});function Rt(l,d,m){let g=A[d];m&&(l=l/pe-(g.ori==1?
$e:be));let b=te;g.ori==1&&(b=U,l=b-l),g.dir==-1&&(l=b-l);let v=g._min,P=g._max,_=l/b,N=v+(P-v)*_,$=g.distr;return $==3?Xn(10,N):$==4?Md(N,g.asinh):$==100?g.bwd(
N):N}function ph(l,d){let m=Rt(l,R,d);return Ct(m,e[0],We,Ge)}o.valToIdx=l=>Ct(l,e[0]),o.posToIdx=ph,o.posToVal=Rt,o.valToPos=(l,d,m)=>A[d].ori==0?r(l,A[d],m?st:
te,m?it:0):i(l,A[d],m?St:U,m?mt:0),o.setCursor=(l,d,m)=>{ve=l.left,Ee=l.top,hn(null,d,m)};function vi(l,d){Me(Fn,Jn,xe.left=l),Me(Fn,xo,xe.width=d)}function xi(l,d){
Me(Fn,"top",xe.top=l),Me(Fn,ko,xe.height=d)}let po=D.ori==0?vi:xi,uo=D.ori==1?vi:xi;function uh(){if(Te&&ee.live)for(let l=s==2?1:0;l<S.length;l++){if(l==0&&q)continue;
let d=ee.values[l],m=0;for(let g in d)kt[l][m++].firstChild.nodeValue=d[g]}}function er(l,d){if(l!=null&&(l.idxs?l.idxs.forEach((m,g)=>{ae[g]=m}):Ad(l.idx)||ae.
fill(l.idx),ee.idx=ae[0]),Te&&ee.live){for(let m=0;m<S.length;m++)(m>0||s==1&&!q)&&fh(m,ae[m]);uh()}gt=!1,d!==!1&&Be("setLegend")}o.setLegend=er;function fh(l,d){
let m=S[l],g=l==0&&j==2?Mt:e[l],b;q?b=m.values(o,l,d)??ie:(b=m.value(o,d==null?null:g[d],l,d),b=b==null?ie:{_:b}),ee.values[l]=b}function hn(l,d,m){wi=ve,bi=Ee,
[ve,Ee]=z.move(o,ve,Ee),z.left=ve,z.top=Ee,Ue&&(Dn&&Ut(Dn,Fe(ve),0,te,U),Nn&&Ut(Nn,0,Fe(Ee),te,U));let g,b=We>Ge;zt=ye,Yt=null;let v=D.ori==0?te:U,P=D.ori==1?te:
U;if(ve<0||Ke==0||b){g=z.idx=null;for(let _=0;_<S.length;_++){let N=yt[_];N!=null&&Ut(N,-10,-10,te,U)}Tn&&Nt(null,On,!0,l==null&&De.setSeries),ee.live&&(ae.fill(
g),gt=!0)}else{let _,N,$;s==1&&(_=D.ori==0?ve:Ee,N=Rt(_,R),g=z.idx=Ct(N,e[0],We,Ge),$=L(e[0][g],D,v,0));let O=-10,W=-10,X=0,de=0,ce=!0,se="",Z="";for(let H=s==2?
1:0;H<S.length;H++){let ke=S[H],Ce=ae[H],Ve=Ce==null?null:s==1?e[H][Ce]:e[H][1][Ce],me=z.dataIdx(o,H,g,N),_e=me==null?null:s==1?e[H][me]:e[H][1][me];if(gt=gt||_e!=
Ve||me!=Ce,ae[H]=me,H>0&&ke.show){let at=me==null?-10:me==g?$:L(s==1?e[0][me]:e[H][0][me],D,v,0),Qe=_e==null?-10:F(_e,s==1?A[ke.scale]:A[ke.facets[1].scale],P,0);
if(Tn&&_e!=null){let wt=D.ori==1?ve:Ee,Tt=Oe(Dt.dist(o,H,me,Qe,wt));if(Tt<zt){let $t=Dt.bias;if($t!=0){let lt=Rt(wt,ke.scale),bt=_e>=0?1:-1,Pt=lt>=0?1:-1;Pt==bt&&
(Pt==1?$t==1?_e>=lt:_e<=lt:$t==1?_e<=lt:_e>=lt)&&(zt=Tt,Yt=H)}else zt=Tt,Yt=H}}if(gt||Pn){let wt,Tt;D.ori==0?(wt=at,Tt=Qe):(wt=Qe,Tt=at);let $t,lt,bt,Pt,Ft,Xe,ct=!0,
dn=Je.bbox;if(dn!=null){ct=!1;let et=dn(o,H);bt=et.left,Pt=et.top,$t=et.width,lt=et.height}else bt=wt,Pt=Tt,$t=lt=Je.size(o,H);if(Xe=Je.fill(o,H),Ft=Je.stroke(o,
H),Pn)H==Yt&&zt<=Dt.prox&&(O=bt,W=Pt,X=$t,de=lt,ce=ct,se=Xe,Z=Ft);else{let et=yt[H];et!=null&&(En[H]=bt,An[H]=Pt,ka(et,$t,lt,ct),va(et,Xe,Ft),Ut(et,xt(bt),xt(Pt),
te,U))}}}}if(Pn){let H=Dt.prox,ke=cn==null?zt<=H:zt>H||Yt!=cn;if(gt||ke){let Ce=yt[0];Ce!=null&&(En[0]=O,An[0]=W,ka(Ce,X,de,ce),va(Ce,se,Z),Ut(Ce,xt(O),xt(W),te,
U))}}}if(xe.show&&Kt)if(l!=null){let[_,N]=De.scales,[$,O]=De.match,[W,X]=l.cursor.sync.scales,de=l.cursor.drag;if(ze=de._x,He=de._y,ze||He){let{left:ce,top:se,width:Z,
height:H}=l.select,ke=l.scales[W].ori,Ce=l.posToVal,Ve,me,_e,at,Qe,wt=_!=null&&$(_,W),Tt=N!=null&&O(N,X);wt&&ze?(ke==0?(Ve=ce,me=Z):(Ve=se,me=H),_e=A[_],at=L(Ce(
Ve,W),_e,v,0),Qe=L(Ce(Ve+me,W),_e,v,0),po(_t(at,Qe),Oe(Qe-at))):po(0,v),Tt&&He?(ke==1?(Ve=ce,me=Z):(Ve=se,me=H),_e=A[N],at=F(Ce(Ve,X),_e,P,0),Qe=F(Ce(Ve+me,X),_e,
P,0),uo(_t(at,Qe),Oe(Qe-at))):uo(0,P)}else or()}else{let _=Oe(wi-gi),N=Oe(bi-yi);if(D.ori==1){let X=_;_=N,N=X}ze=qe.x&&_>=qe.dist,He=qe.y&&N>=qe.dist;let $=qe.uni;
$!=null?ze&&He&&(ze=_>=$,He=N>=$,!ze&&!He&&(N>_?He=!0:ze=!0)):qe.x&&qe.y&&(ze||He)&&(ze=He=!0);let O,W;ze&&(D.ori==0?(O=Rn,W=ve):(O=$n,W=Ee),po(_t(O,W),Oe(W-O)),
He||uo(0,P)),He&&(D.ori==1?(O=Rn,W=ve):(O=$n,W=Ee),uo(_t(O,W),Oe(W-O)),ze||po(0,v)),!ze&&!He&&(po(0,0),uo(0,0))}if(qe._x=ze,qe._y=He,l==null){if(m){if(Di!=null){
let[_,N]=De.scales;De.values[0]=_!=null?Rt(D.ori==0?ve:Ee,_):null,De.values[1]=N!=null?Rt(D.ori==1?ve:Ee,N):null}mo(wr,o,ve,Ee,te,U,g)}if(Tn){let _=m&&De.setSeries,
N=Dt.prox;cn==null?zt<=N&&Nt(Yt,On,!0,_):zt>N?Nt(null,On,!0,_):Yt!=cn&&Nt(Yt,On,!0,_)}}gt&&(ee.idx=g,er()),d!==!1&&Be("setCursor")}let Jt=null;Object.defineProperty(
o,"rect",{get(){return Jt==null&&fo(!1),Jt}});function fo(l=!1){l?Jt=null:(Jt=w.getBoundingClientRect(),Be("syncRect",Jt))}function ki(l,d,m,g,b,v,P){z._lock||Kt&&
l!=null&&l.movementX==0&&l.movementY==0||(tr(l,d,m,g,b,v,P,!1,l!=null),l!=null?hn(null,!0,!0):hn(d,!0,!1))}function tr(l,d,m,g,b,v,P,_,N){if(Jt==null&&fo(!1),an(
l),l!=null)m=l.clientX-Jt.left,g=l.clientY-Jt.top;else{if(m<0||g<0){ve=-10,Ee=-10;return}let[$,O]=De.scales,W=d.cursor.sync,[X,de]=W.values,[ce,se]=W.scales,[Z,
H]=De.match,ke=d.axes[0].side%2==1,Ce=D.ori==0?te:U,Ve=D.ori==1?te:U,me=ke?v:b,_e=ke?b:v,at=ke?g:m,Qe=ke?m:g;if(ce!=null?m=Z($,ce)?a(X,A[$],Ce,0):-10:m=Ce*(at/me),
se!=null?g=H(O,se)?a(de,A[O],Ve,0):-10:g=Ve*(Qe/_e),D.ori==1){let wt=m;m=g,g=wt}}N&&(d==null||d.cursor.event.type==wr)&&((m<=1||m>=te-1)&&(m=mn(m,te)),(g<=1||g>=
U-1)&&(g=mn(g,U))),_?(gi=m,yi=g,[Rn,$n]=z.move(o,m,g)):(ve=m,Ee=g)}let nr={width:0,height:0,left:0,top:0};function or(){$o(nr,!1)}let Si,Mi,Ti,Pi;function Ei(l,d,m,g,b,v,P){
Kt=!0,ze=He=qe._x=qe._y=!1,tr(l,d,m,g,b,v,P,!0,!1),l!=null&&(Ze(br,Mr,Ai,!1),mo(ua,o,Rn,$n,te,U,null));let{left:_,top:N,width:$,height:O}=xe;Si=_,Mi=N,Ti=$,Pi=O}
function Ai(l,d,m,g,b,v,P){Kt=qe._x=qe._y=!1,tr(l,d,m,g,b,v,P,!1,!0);let{left:_,top:N,width:$,height:O}=xe,W=$>0||O>0,X=Si!=_||Mi!=N||Ti!=$||Pi!=O;if(W&&X&&$o(xe),
qe.setScale&&W&&X){let de=_,ce=$,se=N,Z=O;if(D.ori==1&&(de=N,ce=O,se=_,Z=$),ze&&qt(R,Rt(de,R),Rt(de+ce,R)),He)for(let H in A){let ke=A[H];H!=R&&ke.from==null&&ke.
min!=ye&&qt(H,Rt(se+Z,H),Rt(se,H))}or()}else z.lock&&(z._lock=!z._lock,hn(d,!0,l!=null));l!=null&&(kn(br,Mr),mo(br,o,ve,Ee,te,U,null))}function mh(l,d,m,g,b,v,P){
if(z._lock)return;an(l);let _=Kt;if(Kt){let N=!0,$=!0,O=10,W,X;D.ori==0?(W=ze,X=He):(W=He,X=ze),W&&X&&(N=ve<=O||ve>=te-O,$=Ee<=O||Ee>=U-O),W&&N&&(ve=ve<Rn?0:te),
X&&$&&(Ee=Ee<$n?0:U),hn(null,!0,!0),Kt=!1}ve=-10,Ee=-10,ae.fill(null),hn(null,!0,!0),_&&(Kt=_)}function Ci(l,d,m,g,b,v,P){z._lock||(an(l),Us(),or(),l!=null&&mo(
ga,o,ve,Ee,te,U,null))}function _i(){E.forEach(Bp),Is(o.width,o.height,!0)}wn(rs,Qn,_i);let In={};In.mousedown=Ei,In.mousemove=ki,In.mouseup=Ai,In.dblclick=Ci,In.
setSeries=(l,d,m,g)=>{let b=De.match[2];m=b(o,d,m),m!=-1&&Nt(m,g,!0,!1)},Ue&&(Ze(ua,w,Ei),Ze(wr,w,ki),Ze(fa,w,l=>{an(l),fo(!1)}),Ze(ma,w,mh),Ze(ga,w,Ci),Dr.add(
o),o.syncRect=fo);let Fo=o.hooks=t.hooks||{};function Be(l,d,m){Js?ho.push([l,d,m]):l in Fo&&Fo[l].forEach(g=>{g.call(null,o,d,m)})}(t.plugins||[]).forEach(l=>{
for(let d in l.hooks)Fo[d]=(Fo[d]||[]).concat(l.hooks[d])});let Li=(l,d,m)=>m,De=Re({key:null,setSeries:!1,filters:{pub:Ea,sub:Ea},scales:[R,S[1]?S[1].scale:null],
match:[Aa,Aa,Li],values:[null,null]},z.sync);De.match.length==2&&De.match.push(Li),z.sync=De;let Di=De.key,sr=Ml(Di);function mo(l,d,m,g,b,v,P){De.filters.pub(l,
d,m,g,b,v,P)&&sr.pub(l,d,m,g,b,v,P)}sr.sub(o);function gh(l,d,m,g,b,v,P){De.filters.sub(l,d,m,g,b,v,P)&&In[l](null,d,m,g,b,v,P)}o.pub=gh;function yh(){sr.unsub(
o),Dr.delete(o),tn.clear(),Er(rs,Qn,_i),h.remove(),le?.remove(),Be("destroy")}o.destroy=yh;function rr(){Be("init",t,e),li(e||t.data,!1),I[R]?Zs(R,I[R]):Us(),Co=
xe.show&&(xe.width>0||xe.height>0),rn=gt=!0,Is(t.width,t.height)}return S.forEach(ii),E.forEach(Yc),n?n instanceof HTMLElement?(n.appendChild(h),rr()):n(o,rr):rr(),
o}Ie.assign=Re;Ie.fmtNum=Ur;Ie.rangeNum=is;Ie.rangeLog=cs;Ie.rangeAsinh=Or;Ie.orient=vn;Ie.pxRatio=pe;Ie.join=$d;Ie.fmtDate=Gr,Ie.tzDate=jd;Ie.sync=Ml;{Ie.addGap=
Ap,Ie.clipGaps=ps;let t=Ie.paths={points:_l};t.linear=Dl,t.stepped=Lp,t.bars=Dp,t.spline=Rp}var gs=128,Fl=50,Vp=.25,jp=t=>[t.ray,t.truth,t.sensor,t.noReturn],Kp=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),qp=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),ys=(t,e)=>({font:lr,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function Ol(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:gs})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:gs}),s=n()),o)}function Il(t,e){let{session:n}=t,o=x("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${Fl}`]],()=>s,w=>{s=w,h=null,n.changed()}),
i=0,a=-1/0,c=-1,h=null,p=Ol(o,()=>{let w=jp(e()),k=Array.from({length:i},(M,T)=>({label:`chain ${T+1}`,stroke:w[T%w.length],width:1,points:{show:!1}}));return new Ie(
{width:100,height:gs,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,qp,0,0],scales:{x:{time:!1,range:(M,T,S)=>[T,Math.max(S,T+1)]},y:{range:(M,T,S)=>Qp(
Math.max(T,a),S)}},axes:[ys(e,26),ys(e,Kp)],series:[{label:"sweep"},...k],hooks:{draw:[M=>Xp(M,c,e())]}},[[],...k.map(()=>[])],o)},e),f=x("span",{className:"cap\
tion",textContent:"log joint by sweep"}),y=x("div",{className:"charted"},x("div",{className:"buttons"},r,f),o);return t.each(()=>{let w=n.shown,k=w?.traced?.length?
w.trace.length/w.traced.length:0;if(C(y,"hidden",k===0),!w||!k)return;let M=n.document?.source.kind==="run"?"draw":"sweep";C(f,"textContent",`log joint by ${M}`);
let T=w.layer==="draw"&&n.draws.count?(n.draw+1)*w.traced[w.traced.length-1]/n.draws.count:-1,S=p(k!==i&&(i=k,!0));if(!S||h===w&&c===T&&S.data[0].length)return;
[h,c]=[w,T],a=s==="all"?Zp(w,k):-1/0;let E=Yp(w,k,s);S.setData(E),o.setAttribute("data-sweeps",E[0].join())}),y}function Yp({trace:t,traced:e},n,o){let s=o==="a\
ll"?Jp(e):[...e.keys()].filter(i=>e[i]<=Fl),r=i=>Float32Array.from(s,a=>i[a]);return[r(e),...Array.from({length:n},(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}
function Jp(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,o=-1/0;return[...t.keys()].filter(s=>t[s]<o&&s<e-1?!1:(o=t[s]+n,!0))}function Zp({trace:t,
traced:e},n){let o=e.length,s=e.findIndex(r=>r>=Vp*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.min(...t.slice(i*o+s,(i+1)*o))))}function Qp(t,e){
let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function Xp(t,e,n){if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.
save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.restore())}function Ul(t,e){let{session:n}=t,o=x("div",{className:"chart",role:"img","aria-label":"\
Histogram of the particles' weights"}),s=x("div",{className:"caption",textContent:"particles by weight, nats below the heaviest"}),r=x("div",{className:"charted"},
s,o),a=Ol(o,()=>new Ie({width:100,height:gs,legend:{show:!1},cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(h,u,p)=>[u,p]},y:{distr:3,range:(h,u,p)=>[
.5,Math.max(10,2*p)]}},axes:[ys(e,26),{...ys(e,52),values:(h,u)=>u.map(p=>p>=1?String(p):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Ie.paths.bars?.({size:[
.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),c=null;return t.each(()=>{let h=n.shown;C(r,"hidden",!h?.weights);let u=h?.weights&&a(!1);if(!h?.weights||!u||
c===h&&u.data[0].length)return;c=h;let p=[...h.weights],f=-(h.lowest??-1)/p.length,y=[...p.map((w,k)=>(h.lowest??-1)+k*f),0];u.setData([y,[...p.map(w=>w||null),
null]])}),r}function Wl(t){let{session:e,hand:n}=t,{decisions:o}=e,s=x("p",{className:"said",role:"status"}),r=x("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,h=>o.set({radius:h}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>o.risk,h=>o.set({risk:h}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),c=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{C(c,"textContent",i()),C(s,"textContent",n.tool==="path"?eu(t):tu(t))}),a}function eu({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${Se(
o.length_m,2)} m, free with probability ${Se(o.probability,3)} ± ${Se(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${Se(o.independent,
3)}.${r}`}function tu({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.
nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${Se(Math.min(...e.nats),1)} to ${Se(o,1)} nats, cells taken for indepen\
dent; the best place has a ring.${s}`}var nu=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],ou="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",su="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). No beam has been where it is hatched.",ru="Shown is what the readings tell about how likely each cell is to stop a beam: what is expected (m\
ean), one whole map that explains them (one draw), and how wide the 90 % interval is (width). No beam has been where it is hatched.",iu="While you edit, the ans\
wer is belief propagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",au="The map is made from the scans of this log. Where it\
s poses are raw odometry, Run first infers where the robot was; then it samples maps, and keeps them as draws.",lu="This is a saved run: its draws, and what the\
y say together.",cu="Mouse: the wheel zooms, the middle button pans.",hu="Shift or the right button erases, and so does a click on a wall.",du="Touch: two finge\
rs zoom and pan.";function Gl(t){let{session:e}=t,n=x("div"),o=Ki.map(([i,a,c])=>{let h=x("tr",{},x("th",{scope:"row"},x("kbd",{textContent:i})),x("td",{textContent:a}));
return t.visible(h,()=>pu[c??"all"](e)),h}),s=x("p"),r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?ru:su,c=e.editable?[`${ou} ${a}`,
iu]:i==="log"?[a,au]:i==="run"?[a,lu]:[a];c.join()!==r&&n.replaceChildren(...c.map(h=>x("p",{textContent:h}))),r=c.join(),C(s,"textContent",[cu,...e.editable?[hu]:
[],du].join(" "))}),t.dialog("Help",n,s,x("table",{},x("tbody",{},...o)))}var pu={all:()=>!0,drawn:t=>t.editable,asked:t=>!t.recorded,inferred:t=>!t.recorded&&t.
document?.source.kind!=="run"};function zl(t){let e=()=>x("input",{type:"number",step:1,required:!0,value:"21"}),[n,o]=[e(),e()];for(let i of[n,o])t.bounded(i,"\
side");let s=x("select",{});for(let[i,a]of nu)s.append(x("option",{value:i,textContent:a}));s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<
60&&([n.value,o.value]=["120","80"])});let r=x("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),x("div",{className:"\
buttons end"},x("button",{type:"submit",className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(
n.value),Number(o.value)],world:s.value}),t.hand.selected=null}),t.dialog("New map",r)}var uu="The link holds the walls, the sensors and all settings after its \
#, and no token. It opens in this browser while the server runs; the part from # on can be put after the address of any bayesmap page.",fu="The link holds the f\
ile's name and all settings after its #, but no scans and no token. It opens in this browser while the server shows this file; the part from # on can be put aft\
er the address of any bayesmap page that shows it.";function Hl(t){let e=x("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=x("span",{role:"status",className:"\
copied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent=
"",2e3)},s=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),r=x("p");t.each(()=>C(r,"textContent",t.session.document?.source.kind==="simulatio\
n"?uu:fu));let i=t.dialog("Share",r,x("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var mu=8;function Bl(t){let{session:e,hand:n}=t,o=x("p",{className:"words",role:"status"}),s=x("ol",{className:"spoken"}),r=t.section("Evidence of beams",o,s),i=-1;
return t.visible(r,()=>n.tool==="evidence"),t.each(()=>{let{evidence:a}=e;if(C(o,"textContent",yu(e)),i===a.version)return;i=a.version;let{nats:c,scan:h,beam:u}=a.
each??{nats:[],scan:[],beam:[]},p=Array.from(c.slice(0,mu),(f,y)=>x("li",{},`${ur(f)} nats: ${gu(e,h[y],u[y])}`));s.replaceChildren(...p)}),r}var gu=({document:t,
editable:e},n,o)=>`beam ${o+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function yu({evidence:t,quantity:e}){let{cell:n,together:o}=t;if(!n)return"\
Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";let s=`Cell ${n.x}, ${n.y}`;if(!o)return`${s}: aski\
ng its beams.`;if(!o.beams)return`${s}: no beam reaches it.`;let r=o.beams===1?"1 beam":`${o.beams} beams`;if(o.nats_for===null||o.nats_against===null)return`${s}\
: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"its surface"}[e.kind]??"what is there",a=o.beams_for||o.beams_against?"":" Non\
e of them says anything.";return`${s}: ${r}. For ${i} (blue) ${o.beams_for}, ${o.nats_for.toFixed(1)} nats; against (orange) ${o.beams_against}, ${o.nats_against.
toFixed(1)} nats.${a}`}var xn=t=>t.charAt(0).toUpperCase()+t.slice(1),ws=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=xn(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var Vl=t=>Math.round(t*180/Math.PI);function jl(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(c,h)=>t.numberInput(c,()=>Number((o.pose?.[h]??0).toFixed(2)),u=>o.move(
{[h]:u}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>Vl(o.pose?.yaw??0),c=>o.move({yaw:c*Math.PI/180}),{step:5}),i=x("p",{className:"words ghosted"}),a=t.
section("Ghost",x("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>C(i,"textContent",wu(t))),
a}function wu({session:t}){let{ghost:e}=t;if(e.trouble)return xn(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(u,p)=>u-o[p]).filter(Number.isFinite).sort((u,p)=>u-p),a=i.length?`${Se(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",c=n?`${n} draws of the map`:"the mean map, cells taken for independent",h=r?` \
Rings are the hits of scan ${r.index+1}, taken ${Se(100*r.away,0)} cm from here, turned by ${Vl(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${c}.${h}`}function Kl(t){let{session:e}=t,n=x("span",{className:"what"});t.each(()=>{let{grid:h,source:u}=e.document??{};if(!h||!u)return;let p=`${h.shape[0]} × ${h.shape[1]}\
 cells of ${+h.resolution.toPrecision(3)} m`;C(n,"textContent",u.name?`${u.name}, ${p}`:p)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),x("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let h of s)t.visible(h,()=>!e.recorded);let r=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=x("span",{className:"space"});return{element:x("header",{},x("h1",{textContent:"bayesmap"}),n,a,...s,vu(t),r,
i),nameTheme(h){let u=`Theme: ${h}`;ht(r,"aria-label",u),C(r,"title",u)}}}var bu=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function vu(t){
let{session:e}=t,n=(a,c,h,u)=>{let p=t.button(null,a,()=>t.command(`export ${c}`),{text:a,when:u});return h&&t.visible(p,()=>!e.recorded),p},o=x("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>bu(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),s=t.button("save","Export",()=>r(o.hidden),{text:"Export",when:()=>!!e.document}),r=a=>{o.hidden=!a,s.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};r(!1);let i=x("div",{className:"anchor"},s,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(r(!1),s.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||r(!1)}),o.addEventListener("click",()=>{r(!1),s.
focus()}),i}var xu={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function en(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",xu[t]),e.append(n),e}var bs=({document:t})=>!t||t.source.kind==="simulation",qr=({recorded:t})=>!t,ql="surface (zoom in)",Yl=[{mark:"truth",text:"true wall",when:bs,may:bs},{mark:"r\
ay",text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.
strokes.length,may:t=>!bs(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!bs(t)},{mark:"unobserved",text:"unobserved"},
{mark:"draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:qr},
{mark:"path",text:"path, as wide as the robot",when:({decisions:t})=>!!t.path,may:qr}],Jl=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 % of a pl\
ace"}],Zl=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function Ql(t,e,n){return x("div",{className:"legend"},ku(t,e,n),Su(t))}
function ku(t,e,n){let{session:o}=t,s=x("span",{className:"ramp"}),r=x("span",{className:"name"}),i=Yl.map(u=>{let[p,f]=vs(u),{mark:y,when:w}=u;return w&&t.visible(
p,()=>w(o)),y==="stroke"&&t.each(()=>C(f,"textContent",wo(n())?u.text:ql)),y==="path"&&t.each(()=>p.firstElementChild?.classList.toggle("risky",o.decisions.path?.
within_risk===!1)),p}),[a,c]=[Jl,Zl].map(u=>u.map(p=>vs(p)[0]));for(let u of a)t.visible(u,()=>!!o.where.found);for(let u of c)t.visible(u,()=>!!o.evidence.cellShown);
let h="";return t.each(()=>{let{layer:u}=o;C(r,"textContent",Xl(o,u));let p=u==="entropy"||u==="width",f=`${p} ${e().ground}`;h!==f&&(h=f,s.style.background=pr(
p?Gn:y=>dr(e(),y)))}),x("ul",{"aria-label":"Legend"},x("li",{},r,x("span",{className:"scale"},"0",s,"1")),...i,Mu(t),...a,...c)}function Su(t){let{session:e}=t,
n=["mean","draw","entropy","width"].map(h=>{let u=x("span");return t.each(()=>C(u,"textContent",Xl(e,h))),h==="width"&&t.visible(u,()=>e.quantity.interval),u}),
o=Yl.map(h=>{let[u,p]=vs(h);h.mark==="stroke"&&(p.textContent=ql);let{may:f}=h;return f&&t.visible(u,()=>f(e)),u}),s=x("span",{className:"scale"},"00.0",x("span",
{className:"ramp"}),"000.0 nats"),r=[Jl,Zl].map(h=>x("ul",{},...h.map(u=>vs(u)[0]))),i=[x("ul",{},x("li",{},"one more scan tells",s)),...r],a=x("li",{className:"\
either"},...i);t.visible(a,()=>qr(e));let c=x("span",{className:"scale"},"0",x("span",{className:"ramp"}),"1");return x("ul",{className:"room","aria-hidden":"tr\
ue"},x("li",{},x("span",{className:"name either"},...n),c),...o,a)}function vs({mark:t,text:e}){let n=x("i",{className:t});t==="sensor"&&n.append(en("sensor"));
let o=x("span",{textContent:e});return[x("li",{},n,o),o]}function Xl({quantity:t},e){let{kind:n,mean:o,value:s}=t;return e==="entropy"?"entropy (bit)":e==="widt\
h"?"width of the 90 % interval":n==="binary"?"P(wall)":e==="draw"?s:o}function Mu(t){let{decisions:e}=t.session,n=x("span",{className:"ramp"});n.style.background=
pr(Gn);let[o,s]=[x("span"),x("span")],r=x("li",{className:"views"},"one more scan tells",x("span",{className:"scale"},o,n,s));return t.visible(r,()=>e.looking&&
!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(C(o,"textContent",Se(Math.min(...i),1)),C(s,"textContent",`${Se(Math.max(...i),1)} nats`))}),
r}var Tu=[.05,.1,.2,.4,.8],Pu=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function ec(t){let{session:e}=t,n=x("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,c]=i.bounds,h=Math.
max(c[0]-a[0],c[1]-a[1]),u=[...new Set([...Tu,r.resolution])].sort((f,y)=>f-y),[,p]=t.limits("side_of_log");if(o!==`${u} ${p}`){o=`${u} ${p}`;let f=y=>x("option",
{value:String(y),textContent:Pu(y),disabled:h/y>p-1});n.replaceChildren(...u.map(f))}C(n,"value",String(r.resolution))});let s=t.row("Cell size",n);return t.visible(
s,()=>e.document?.source.kind==="log"),s}function tc(t){let{session:e}=t,n=x("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),o=x("output"),s=()=>e.
document?.source.scans??0,r=a=>{let c=Number(n.value);t.scrub(c>=s()?null:c,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});
let i=t.section("Log",x("div",{className:"player bare"},n,o));return t.visible(i,()=>e.document?.source.kind==="log"&&s()>1),t.each(()=>{let a=s(),c=e.document?.
scans_used??a;C(n,"max",String(Math.max(1,a))),(!fn(n)||Number(n.value)!==c)&&C(n,"value",String(c));let h=c===a?`all ${a} scans`:`after ${c} of ${a}`;n.style.setProperty(
"--fill",`${100*(c-1)/Math.max(1,a-1)}%`),ht(n,"aria-valuetext",h),C(o,"textContent",h)}),i}var Eu=20,Au={importance:"particles",propagate:"rounds"},xs=({working:t,shown:e})=>t&&e?.method==="pilot";function nc(t,...e){let{session:n}=t,o=x("progress",{max:1,
value:0,"aria-label":"Progress"}),s=x("div",{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.
source.kind==="log"),c=xs(n),h=i?i.done/i.total:r&&!a&&r.total>0&&(c||!r.approximate)?r.sweeps/r.total:0;C(o,"value",h);let u=n.remaining_s(),p=Au[r?.method??""]??
"sweeps",f=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${p}`:"",y=u!==null?u<1?"less than 1 s left":`${Math.ceil(u)} s left`:n.running?"running":"",w=n.
sampling||n.running||!r||r.sweeps>=r.total?"":"stopped";i?C(s,"textContent",`${i.text}: ${i.done} of ${i.total} ${i.total>Eu?"scans":"rounds"}`):a?C(s,"textCont\
ent","Computing"):r&&c?C(s,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):C(s,"textContent",xn([f,y,f&&w].filter(Boolean).join(", "))||Cu(
n))}),t.section("Posterior",_u(t),o,s,Lu(t),Du(t),...e)}function Cu({shown:t,working:e}){return t?.method==="counts"?"Run infers where the robot was":t?.method===
"pilot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function _u(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"\
primary",text:"Run",title:"Run (R)",when:()=>e.connection.connected}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escap\
e)",when:()=>e.running||e.sampling||xs(e)}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chain"),r=x("div",
{className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function Lu(t){let{session:e}=t,n=x("dl"),o=(s,r,i,a=!1)=>{let c=x(
"dd",{textContent:"–"});n.append(x("div",{title:r},x("dt",{textContent:s}),c)),t.each(()=>{C(c,"textContent",e.shown?i(e.shown):"–"),a&&C(c,"className",e.shown?.
verdict?.level??"")})};return o("ESS","Effective sample size of the log joint",s=>Se(s.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",
s=>Se(s.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",s=>Se(s.log_joint,Math.abs(s.log_joint??0)<1e5?1:0)),o("reply","From the han\
d's last move to its picture",()=>Se(e.latency.eventToPaint_ms.at(-1),0," ms")),n}function Du(t){let{session:e}=t,n=x("div",{className:"verdict"});return t.each(
()=>{let o=e.shown?.verdict;if(C(n,"hidden",!o),!o)return;let s={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];C(n,"textContent",`${s}:\
 ${o.why}`),C(n,"className",`verdict ${o.level}`)}),n}var Nu="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",oc=200,
Ru="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",sc="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",$u="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function ac(t){let{session:e}=t,n=x("span",{className:"chip"}),o=t.button(null,"Not converged",()=>rc(
e)?.apply(),{text:"Not converged",className:"chip doubt"}),s=x("div",{className:"chips"},n,o);return t.each(()=>{let r=rc(e);C(o,"hidden",!r),r&&(C(o.firstElementChild,
"textContent",`not converged: ${r.text}`),C(o,"title",`${e.shown?.verdict?.why}. Click to ${r.text}.`),ht(o,"aria-label",`Not converged: ${r.text}`));let i=e.shown;
if(!i||!e.document)return C(s,"hidden",!0);let a=e.draws.count?`draw ${e.draw+1} of ${e.draws.count}`:"draw",c=i.layer==="draw"?a+(e.flicker.under?" over the me\
an":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="entropy"?"entropy":"mean";if(i.method==="counts"){C(s,"hidden",!1);let p=e.halfway?"along\
 poses found so far":"along raw odometry";return C(n,"textContent",`hits and passes · ${e.stage?e.stage.text.toLowerCase():p}`),C(n,"className","chip approxima\
te")}let h={importance:"importance sampling",propagate:"belief propagation"}[i.method],u=i.approximate?`approximate, ${Fu(i,e.working)}`:h??`${i.sweeps} sweeps`;
C(s,"hidden",!1),C(n,"textContent",`${c} · ${u}`),C(n,"className",i.approximate?"chip approximate":"chip")}),s}function Fu({method:t,sweeps:e,total:n,averaged:o},s){
return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${o===1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} \
of ${n}`}function rc(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n||t.recorded||n.source.kind==="run")return null;let o=i=>()=>t.act({type:"set",
patch:i}),s=e.sweeps<oc;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!s)return{text:"try blocks",apply:o({method:"block"})};if(e.method==="importance")return{
text:"try Gibbs",apply:o({method:"auto"})};if(e.sweeps<e.total)return null;let r=Math.min(t.limits?.sweeps[1]??0,Math.max(oc,4*n.sweeps));return r>n.sweeps?{text:`\
try ${r} sweeps`,apply:o({sweeps:r})}:null}function lc(t){let{session:e}=t,n=x("span"),o=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnec\
t now"}),s=x("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.
connection.retryIn_ms??0)/1e3));C(s,"hidden",!r&&e.worker!=="restarted"),C(s,"className",r?"banner":"banner mild"),C(o,"hidden",!r);let a=`Connection lost. Tryi\
ng again in ${i} s; the map is kept here.`,c=e.connection.refused?Nu:a;C(n,"textContent",r?c:"The worker stopped and is being started again. The map is kept.")}),
s}function cc(t){let{session:e,hand:n}=t,o=x("div",{className:"readout",id:`${t.prefix}-readout`}),s=x("span",{role:"status","aria-live":"polite"}),r=x("span",{
className:"hidden","aria-live":"polite"});return n.announce=i=>C(r,"textContent",i),n.describe=i=>ic(e,i),t.each(()=>{let{kind:i}=e.quantity;C(o,"title",i==="bi\
nary"?Ru:i==="surface"?`${sc}. ${$u}`:sc);let a=n.cursor??n.hover,h=matchMedia("(pointer: coarse)").matches?"Touch a cell":e.editable?"Point at a cell, or press\
 ? for the keys":"Point at a cell";C(o,"textContent",a?ic(e,a):h);let u=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad",p=e.status.text==="Ready"&&xs(e);
C(s,"textContent",u?"Ready, but the chains have not converged":p?"Fitting the sensor":e.status.text),C(s,"className",u?"warning":p?"busy":e.status.level)}),{element:x(
"footer",{},s,o,r),readout:o}}function ic(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.
log10(s))+1),{x:c,y:h}=Un(e,n.grid),u=[`Cell ${e.x}, ${e.y}`,`${c.toFixed(a)}, ${h.toFixed(a)} m`];if(o&&o.p.length===r[0]*r[1]){let p=o.p[i]/255,{kind:f,mean:y,
value:w,interval:k}=t.quantity;o.layer==="width"?u.push(`90 % interval ${p.toFixed(2)} wide`):f!=="binary"&&o.layer==="draw"?u.push(`${w} ${p.toFixed(2)} in thi\
s draw`):f!=="binary"?u.push(`${y} ${p.toFixed(2)}`,...k?[]:[`entropy ${yo(p).toFixed(2)} bit`]):o.layer==="draw"?u.push(p>.5?"wall in this draw":"free in this \
draw"):u.push(`P(wall) ${p.toFixed(2)}`,`entropy ${yo(p).toFixed(2)} bit`);let M=t.evidence.facts,T=M?.x===e.x&&M.y===e.y?M:null,S=T?T.beams:null;if(o.observed[i]?
S!==null&&u.push(S===1?"1 beam":`${S} beams`):u.push("unobserved"),o.observed[i]&&T&&T.nats_for!==null&&T.nats_against!==null&&S){let E={binary:"a wall",surface:"\
its surface"}[t.quantity.kind]??"what is there";u.push(`for ${E} ${T.beams_for}, ${T.nats_for.toFixed(1)} nats`,`against ${T.beams_against}, ${T.nats_against.toFixed(
1)} nats`)}}return u.join(" · ")}var Ou={logged:"as logged",odometry:"from raw odometry"},Iu=180/Math.PI;function hc(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
Ou,()=>e.document?.poses??"logged",a=>t.set({poses:a}));o.classList.add("wide"),t.visible(o,n);let s=[t.slider("pose_sigma",()=>"Position ±",{step:.05,unit:" m"}),
t.slider("heading_sigma",()=>"Yaw ±",{step:.5,unit:"°",scale:Iu})];for(let a of s)t.visible(a,()=>e.editable);let r=x("p",{className:"caption"});t.each(()=>{let{
pose_sigma:a=0,heading_sigma:c=0,method:h="auto"}=e.document??{},u=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,p=e.editable&&(a>
0||c>0)&&!/auto|gibbs|block/.test(h);C(r,"hidden",!p&&!u),C(r,"textContent",u?"Run infers where the robot was.":"This method takes poses as known; Gibbs does no\
t.")});let i=t.section("Where the robot was",o,...s,r);return t.visible(i,()=>e.editable||n()&&!e.recorded),i}var ks=t=>Math.abs(t)<.995?`${Se(100*Math.abs(t),1)} cm`:`${Se(Math.abs(t),2)} m`,Uu="Point at a reading to compare it with what the posterior predicts of it.",
Wu=": preparing the comparison. The first one after an installation takes some seconds.";function dc(t){let{session:e}=t,n=x("p",{className:"words reading",role:"\
status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i,
slow:a}=e.reading,c=s?`Beam ${s.beam+1} of scan ${s.scan+1}${a?Wu:"."}`:Uu;C(n,"textContent",i||(r?Gu(r):c))}),o}function Gu({scan:t,beam:e,reading:n,range:o,low:s,
median:r,high:i,residual:a,no_return:c,wall:h}){let u=`Beam ${e+1} of scan ${t+1}`,p=(T,S)=>T===null?S:`${Se(T,2)} m`,f=`median ${p(r,"no return")}, 80 % betwee\
n ${p(s,"too close")} and ${p(i,"no return")}`;if(n==="none")return`${u} came back from nothing, which was predicted with probability ${Se(c??0,3)} (${f}).`;if(n!==
"hit"||o===null)return`${u} read nothing that says how far (${f}).`;let y=a===null?"":`, ${ks(a)} ${a<0?"shorter":"longer"} than the predicted median`,w=`${u} r\
ead ${Se(o,2)} m${y} (${f}).`;if(!h)return w;let k=`${ks(h.across_m)} ${h.across_m<0?"behind":"in front of"} the wall, which is ${ks(h.thickness_m)} thick`,M=`${ks(
h.along_m)} to the ${h.along_m<0?"right":"left"} along it from the middle of its surface`;return`${w} It ended ${k} (one standard deviation), and ${M}; the beam\
 met it at ${Se(h.incidence_rad*180/Math.PI,0)}° from its normal.`}var zu={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Hu={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},Bu={noisy:"with noise",exact:"exact"},Vu={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},ju={raster:"raster",radial:"radial",random:"random"},Ss=2*Math.PI,Ku=t=>Math.round(t*1800/Math.PI)/10,qu={importance:"Particles",propagate:"Round\
s"};function pc(t){let{session:e,hand:n,editor:o}=t,s=x("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let p=e.document?.sensors??[],f=p.map(y=>y.id).join();f!==r&&s.replaceChildren(...p.map(({id:y})=>x("option",{value:String(
y),textContent:`Sensor ${y}`}))),r=f,C(s,"value",String(n.sensor?.id??""))});let i=(p,f)=>t.numberInput(p,()=>Number((n.sensor?.[f]??0).toFixed(2)),y=>n.sensor&&
o.moveSensor(n.sensor,{[f]:y}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),p=>n.sensor&&o.moveSensor(n.sensor,{yaw:p%
360*Math.PI/180}),{step:5}),c=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),h=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.document?.fov??Ss)<Ss);let u=x("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),
a);return t.section("Sensors",x("div",{className:"buttons"},s,c,h),u)}function uc(t){let{session:e}=t,n=t.numberInput("Longest range (m)",()=>e.document?.max_range??
0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),o=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{step:1,log:!0}),
n,t.numberInput("Field of view (°)",()=>Ku(e.document?.fov??Ss),a=>t.set({fov:a>=360?Ss:a*Math.PI/180}),{step:5,limits:"fov",scale:180/Math.PI}),t.select("Read\
ings",Bu,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of o)t.visible(a,()=>e.editable);let s=t.slider("prior",()=>"Prior P(wall)",{step:.01}),
r=()=>(e.document?.cells??"binary")==="binary";t.visible(s,r);let i=t.select("Cells",Hu,()=>e.document?.cells??"binary",a=>t.set({cells:a}));return t.visible(i,
()=>e.document?.source.kind==="log"),t.section("Model",i,ec(t),s,...o)}function fc(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>(e.document?.cells??
"binary")==="binary",s=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",zu,n,i=>t.set({method:i})),t.select("Order",ju,()=>e.document?.order??"radial",i=>t.
set({order:i}),()=>n()==="gibbs"||n()==="auto"),t.select("Start",Vu,()=>e.document?.start??"auto",i=>t.set({start:i}),s)];for(let i of r)t.visible(i,o);return t.
section("Inference",...r,t.slider("sweeps",()=>qu[n()]??"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,i=>t.set({seed:Math.round(i)}),{step:1,
limits:"seed"}))}function mc(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),
o=t.button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",x("d\
iv",{className:"buttons"},n,o))}var Yu=0,Ms=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${Yu++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[o,s]=this.session.limits?.[e]??[1,
2];return n===1?[o,s]:[Math.ceil(10*o*n-1e-6)/10,Math.floor(10*s*n+1e-6)/10]}bounded(e,n,o=1){this.each(()=>{let[s,r]=this.limits(n,o);C(e,"min",String(s)),C(e,
"max",String(r))})}visible(e,n){this.each(()=>C(e,"hidden",!n()))}button(e,n,o,{className:s="",text:r="",when:i,title:a}={}){let c=x("button",{type:"button",className:s,
title:a??n,onclick:o},e&&en(e));return r&&c.append(x("span",{textContent:r})),r!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>C(c,"disabled",!i())),c}segmented(e,n,o,s,r){
let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=x("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[c,h,u]of n){let p=x("input",{type:"rad\
io",name:i,value:c,onchange:()=>s(c)});a.append(x("label",{title:h},p,u?en(u):null,x("span",{textContent:h}))),this.each(()=>{C(p,"checked",o()===c),r&&C(p,"dis\
abled",!r(c))})}return a}section(e,...n){let o=`${this.prefix}-${e.replace(/\W/g,"")}`;return x("section",{"aria-labelledby":o},x("h2",{id:o,textContent:e}),...n)}row(e,n){
return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,x("div",{className:"row"},x("label",{for:n.id,textContent:e}),n)}slider(e,n,{step:o,log:s=!1,unit:r="",scale:i=1}){
let a=`${this.prefix}-${e}`,c=()=>this.limits(e,i),h=k=>{let[M,T]=c();return s?1e3*Math.log(k/M)/Math.log(T/M):k},u=k=>{if(!s)return k;let[M,T]=c(),S=M*(T/M)**(k/
1e3),E=S<100?1:10**(Math.floor(Math.log10(S))-1);return ne(Math.round(S/E)*E,M,T)},p=()=>{let k=this.session.document?.[e];return k===void 0?c()[0]:i===1?k:Number(
(k*i).toFixed(3))},f=x("label",{for:a}),y=x("input",{type:"range",id:a,...s?{min:0,max:1e3,step:1}:{step:o}}),w=x("input",{type:"number",step:String(o)});return s||
this.bounded(y,e,i),this.bounded(w,e,i),y.addEventListener("input",()=>this.set({[e]:u(Number(y.value))/i})),y.addEventListener("change",()=>this.endDrag()),w.addEventListener(
"change",()=>{this.typed(w,n(),c(),p,k=>this.set({[e]:s?Math.round(k):k/i})),this.endDrag()}),this.each(()=>{let k=p();C(f,"textContent",n()),ht(w,"aria-label",
`${n()}, number`),u(Number(y.value))!==k&&(y.value=String(h(k))),ht(y,"aria-valuetext",`${k}${r}`);let M=100*(h(k)-Number(y.min))/(Number(y.max)-Number(y.min));
y.style.setProperty("--fill",`${ne(M,0,100)}%`),fn(w)||C(w,"value",String(k))}),x("div",{className:"row slider"},f,y,w)}select(e,n,o,s,r){let i=x("select",{onchange:()=>s(
i.value)});for(let[a,c]of Object.entries(n))i.append(x("option",{value:a,textContent:c}));return this.each(()=>{C(i,"value",o()),r&&C(i,"disabled",!r())}),this.
row(e,i)}typed(e,n,[o,s],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(ne(a,o,s)),e.value=String(r()),a<o?this.session.say(`${n} is at least\
 ${o}`,"warning"):a>s&&this.session.say(`${n} is at most ${s}`,"warning")}numberInput(e,n,o,{step:s,limits:r,scale:i}){let a=x("input",{type:"number",step:String(
s)}),c=()=>r?this.limits(r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,c(),n,o)),this.each(()=>{fn(a)||C(a,"value",
String(n()))}),this.row(e,a)}checkbox(e,n,o,s=""){let r=x("input",{type:"checkbox",onchange:()=>o(r.checked)});return this.each(()=>C(r,"checked",n())),x("label",
{className:"check",title:s},r,x("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,s=x("button",{type:"button",className:"\
plain","aria-label":"Close",onclick:()=>i.close()},en("close")),r=x("div",{className:"title"},x("h2",{id:o,textContent:e}),s),i=x("dialog",{"aria-labelledby":o},
r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),i}};var Ju=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Zu={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},Ts=class{constructor(e){
this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.before=
null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,
draw:e})}play(e){let{draw:n,draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,e&&s.wantsMean?this.session.act({type:"view",layer:"mean",chain:this.
session.view.chain}):e&&this.showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?0:n),this.session.changed()}over(e){let{flicker:n,view:o}=this.session;
n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.chain})):o.layer!=="draw"&&this.showLayer("draw"):(this.afterMean=!1,
this.before&&this.before!==o.layer&&this.showLayer(this.before)),this.before=e?o.layer:null,this.session.changed()}playFromStart(){this.showDraw(0),this.playing=
!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)return this.afterMean=
!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:o,draws:s}=this.session;o+1>=s.count&&n.on?
this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function gc(t,e,n,o){let{session:s}=t,r=t.segmented("Show",Ju,()=>s.view.
layer,y=>e.showLayer(y),y=>y!=="draw"||s.hasDraws),[,,i,a]=Array.from(r.children);C(a,"title","Width of each cell's 90 % interval"),t.visible(i,()=>!s.quantity.
interval),t.visible(a,()=>s.quantity.interval);let c=(y,w)=>t.checkbox(y,()=>n[w],k=>{n[w]=k,s.changed()}),h=c("True walls","truth");t.visible(h,()=>!s.document||
s.document.source.kind==="simulation");let[u,p]=[c("Surfaces","strokes"),c("Trajectory","trajectory")];t.visible(u,()=>!!s.overlay?.strokes.length),t.each(()=>C(
u.lastElementChild,"textContent",wo(o())?"Surfaces":"Surfaces (zoom in)")),t.visible(p,()=>!!s.overlay?.trajectory.length);let f=x("div",{className:"checks",role:"\
group","aria-label":"Marks"},h,c("Rays","rays"),c("Readings","readings"),u,p);return t.section("View",r,Qu(t,e),f)}function Qu(t,e){let{session:n}=t,o=x("input",
{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the\
 draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1}),r=x("output"),i=x("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,
Number(i.value))),t.each(()=>{let{chains:p,count:f}=n.draws;C(o,"max",String(Math.max(0,f-1))),C(o,"disabled",f===0),C(o,"value",String(n.draw));let y=f?`${n.draw+
1} of ${f}`:"none kept";ht(o,"aria-valuetext",y),o.style.setProperty("--fill",`${f>1?100*n.draw/(f-1):0}%`),C(r,"textContent",y),i.length!==Math.max(1,p)&&i.replaceChildren(
...Array.from({length:Math.max(1,p)},(k,M)=>x("option",{value:String(M),textContent:`chain ${M+1}`}))),C(i,"value",String(n.view.chain)),C(i,"disabled",p<2),f<2&&
e.playing&&e.play(!1);let w=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";s.getAttribute("aria-label")!==w&&(s.setAttribute("aria-lab\
el",w),s.replaceChildren(en(e.playing?"pause":"play")))});let a=x("select",{"aria-label":"Speed"});for(let[p,f]of Object.entries(Zu))a.append(x("option",{value:p,
textContent:f}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let c=t.button(null,"From the first sweep",()=>e.
playFromStart(),{text:"From the first",when:()=>n.draws.count>1});t.each(()=>C(a,"disabled",n.draws.count<2||n.flicker.still));let h=t.checkbox("Draws over the \
mean",()=>n.flicker.on,p=>e.over(p),"Each draw in its own colour over the mean, as one of the maps that the scans leave possible");t.visible(h,()=>n.draws.count>
1);let u=x("div",{className:"wide"},h);return x("div",{className:"player"},s,o,r,x("div",{className:"buttons wide"},i,a,c),u)}function yc(t){let{session:e}=t,n=x(
"input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=x("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.
section("Scan",x("div",{className:"player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;C(s,"hidden",
r<2),C(n,"max",String(Math.max(0,r-1))),fn(n)||C(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),C(o,
"textContent",`${Number(n.value)+1} / ${r}`)}),s}var bc=2,wc=6,Xu=.5,ef=.005;function vc(t){let{session:e,hand:n}=t,o=x("p",{className:"whereabouts",role:"status"}),s=x("p",{className:"caption"}),r=t.section("\
Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),C(o,"textContent",tf(t)),C(s,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function tf({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>Xu?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>ef?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${o}${nf(e.modes)}${of(e,t.editable)}${s}`}function nf(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>bc,o=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${Yr(e.mean[2],0)}`,s=`known to ${Jr(e.sigma_m)} and ${Yr(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${Jr(e.sigma_m)} apart.`:`One place: ${o}, ${s}.`;let r=t.slice(0,wc).map(({probability:a})=>mr(a)),i=t.length>wc?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${o}, ${s}.`}function of({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>bc)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the l\
ikeliest":`the ${sf(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${Jr(o[s])} and ${Yr(r,1)} from ${i}.`}var sf=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,Yr=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,Jr=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function xc(t,e,n){let{shown:o,status:s}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:o&&{generation:o.generation,layer:t.layer,approximate:o.
approximate,sweeps:o.sweeps,method:o.method,quantity:t.quantity,rhat:o.rhat,verdict:o.verdict,trace:o.trace,traced:o.traced,weights:o.weights,ess:o.ess,chain:o.
chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{
text:s.text,level:s.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:af(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&rf(t.evidence.each)},over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.
strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??
0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var rf=t=>Object.fromEntries(Object.entries(t).
map(([e,n])=>[e,Array.from(n)]));function af({ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.
near&&{...o.near}}}}var kc="bayesmap-token",Zr="bayesmap-kept";function lf(t){try{return localStorage.getItem(t)}catch{return null}}function Qr(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function Xr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Qr(Zr,JSON.stringify(t))}function Sc(){
Qr(Zr,null)}function Mc(){let t=lf(Zr);try{return t&&JSON.parse(t)}catch{return null}}function Tc(t){t&&Qr(kc,t)}function Pc(t){let e=n=>{n.key===kc&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var ei=new Set(["walls","move_sensor","set","view","live"]),Ec=({type:t})=>!ei.has(t),Ac="Not while the connection is lost: this needs the server";function Cc(t,e){
let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*s+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;
Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??
null};else if(e.type==="move_sensor"){let r=n.sensors.find(i=>i.id===e.id);if(r)for(let i of["x","y","yaw"])r[i]=e[i]??r[i]}}var cf=t=>xn(`${t.replace(/^(plan|path|explore): /,"")}.`),Ps=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.
session.changed())}forget(){this.start=this.goal=this.path=this.views=null,this.askedPath=this.askedViews="",this.version++}ask(){let{session:e,start:n,goal:o,radius:s,
risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;let a=`${i.generation} ${e.sampling}`,c=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&
!i.approximate&&c!==this.askedPath&&(this.askedPath=c,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.
method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let o=e.type==="undecided"?cf(e.text):"",s=e.type==="undecide\
d"?e.question:e.type;s==="views"?this.viewTrouble=o:this.trouble=o,e.type==="path"?this.path=e:e.type==="views"&&this.looking?this.views={pose:n.pose,nats:n.nats,
spacing:e.spacing}:s==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<n.nats.
length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,s]=[r,i])}return o}};var Es=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=Ot(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:o}=e;
if(!this.held||!n||!o||o.generation!==e.generation||e.recorded)return;let s=`${o.generation} ${e.sampling} ${o.approximate} ${n.x} ${n.y}`;s!==this.asked&&(this.
asked=s,e.act({type:"inspect",x:n.x,y:n.y,each:!0}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.
each=n.nats?n:null,this.version++)}};var hf="(prefers-reduced-motion: reduce)",As=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(hf).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var df=2e3,pf=3e3,uf=2,Cs=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&pn(e,n.document.
grid);(!o||!Ot(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
e.recorded||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>df&&(this.waiting=0),this.waiting>=uf)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>pf;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:c,
near_hit:h}=n,{x:u,y:p,yaw:f,generation:y,draws:w,coarse:k,milliseconds:M}=e,T=e.near&&{...e.near,pose:a,ranges:c,hit:h};this.fan={x:u,y:p,yaw:f,generation:y,draws:w,
coarse:k,milliseconds:M,angles:o,low:s,median:r,high:i,near:T},this.answers++}else this.fan=null;this.version++,this.ask()}};var _s=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var Ls=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Ds=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.
kind!=="simulation"&&!o.recorded,r=e&&s&&o.scan?ff(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),o.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){e.type==="undecided"?this.trouble=e.text:e.beam===this.picked?.beam&&
e.scan===this.picked.scan&&(this.found=e),this.version++}};function ff({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)return null;let c={x:e[0],y:e[1]},
[h,u]=[-1,1/0];for(let p=0;p<n.length;p++){let[f,y]=[Math.cos(e[2]+n[p]),Math.sin(e[2]+n[p])],[w,k]=[r.x-c.x,r.y-c.y],M=w*f+k*y,T=s[p]?o[p]:a,S=s[p]?Math.hypot(
w-T*f,k-T*y):1/0,E=M>0&&M<T?Math.abs(w*y-k*f):1/0,A=Math.min(S,i/2+2*E);A<u&&([h,u]=[p,A])}return u<i?{scan:t,beam:h,from:c,angle:e[2]+n[h]}:null}var Ns=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble;let{pose:o,weight:s}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,
cloud:o,weight:s},this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||e.recorded||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;
let s=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.asked||this.waitingSince&&
i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var _c=new Set(["inspect","path","views","where","ghost","beam"]),Rs=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";limits=null;recorded=!1;generation=-1;acted=0;decisions=new Ps(
this);evidence=new Es(this);where=new Ns(this);ghost=new Cs(this);reading=new Ds(this);flicker=new As(this);status=new ws;progress=new Ls;latency=new _s;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,
text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get running(){
return this.connection.connected&&!!this.state?.running}get working(){return this.connection.connected&&!!this.state?.working}get layer(){let e=this.shown?.layer;
return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entropy":"mean"}get stage(){return this.running&&this.shown?.method==="counts"?this.lastStage:null}get halfway(){
return this.lastStage?.generation===this.shown?.generation}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&
!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.
shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,
n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&this.everConnected&&!_c.has(e.type)&&Ec(e))return this.
say(Ac,"warning");let o={...e,seq:++this.seq};_c.has(e.type)||(this.acted=this.seq),ei.has(e.type)&&(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(
o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&Xr(this.portableDocument()),this.changed()}bring(e){this.act(e?{type:"hello",document:e}:
{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.wallsVersion&&(this.packed={version:this.wallsVersion,text:Oo(
Ri(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.effectiveDocument();return e&&(e.source.kind==="simulat\
ion"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.flicker.take(this.shown),!0)}painted(){this.counts.
paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.send({type:"painted",generation:e}),this.reported=
e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.quantity??{kind:"binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){
return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){if(this.connection=e,e.connected){let n=this.everConnected?this.portableDocument():
this.adopt;this.pending=[],this.latency.forget(),this.bring(n),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?
this.say("Connected again"):this.notice&&this.say(this.notice.text,this.notice.level),this.everConnected=!0}else this.everConnected&&(this.say("Connection lost",
"error"),Xr(this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"welcome":this.generation=this.reported=-1,this.limits=e.limits,this.recorded=
e.recorded,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":e.generation>=this.generation&&this.receiveScan(e,n);break;case"\
overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(e,n);break;case"cell":this.
evidence.receive(e,n);break;case"path":case"views":this.decisions.receive(e,n);break;case"ghost":this.ghost.receive(e,n);break;case"beam":this.reading.receive(e);
break;case"undecided":e.question==="ghost"?this.ghost.receive(e,n):e.question==="beam"?this.reading.receive(e):this.decisions.receive(e,n);break;case"status":this.
status.say(e.text,e.level,this.acted);break;case"error":this.receiveRefusal(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"dow\
nload":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveScan({ids:e,index:n},{pose:o,angles:s,
ranges:r,exact:i,hit:a}){this.scan?.index!==n&&this.reading.forget(),this.scan={ids:e,index:n,pose:o,angles:s,ranges:r,exact:i,hit:a}}receiveRefusal({seq:e,text:n,
remedy:o}){let s=e!==null&&e===this.broughtAt;s&&(this.broughtAt=null,this.act({type:"hello"}));let r=[n,o].filter(Boolean).join("; ");this.status.say(s?`The ma\
p that was brought along cannot be shown: ${r}`:r,"error",this.acted),this.pending=this.pending.filter(i=>i.seq!==e),e!==null&&this.latency.refused(e),this.rebuild()}receiveState(e){
this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.overlay=null,Sc()),this.generation=Math.max(this.generation,e.generation),
this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.
counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,a=n.observed,c=this.next??this.shown,u=c&&c.p.length===o.length&&c.bits.
every((p,f)=>p===a[f])?{observed:c.observed,bits:c.bits}:{observed:go(a,o.length),bits:a};this.next={...e,p:o,trace:s,traced:r,weights:i,...u},this.progress.hear(
this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==s.text||s.walls.length!==n*o)&&(this.
confirmedWalls={text:e.walls,walls:go(Ht(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==s||this.wallsAhead)&&(this.
walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.state.view;
this.view={layer:r,chain:i??0,draw:a}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Cc(this,e),e.type==="walls"&&(this.wallsVersion++,
this.wallsAhead=!0))}};var Lc='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Dc=`:host { display: block; height: 100dvh; container-type: size; }
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
`;var Rc="bayesmap-theme",Nc={auto:"light",light:"dark",dark:"auto"},$s=class{constructor(e,n){this.app=e;this.dressed=n;let o=yf();o&&o in Nc&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=Jo.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?Jo.dark:Jo.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:c,draw:h,ghost:u,belief:p}=n;for(let[f,y]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:c,draw:h,ghost:u,belief:p}))this.
app.style.setProperty(`--${f}`,y);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Nc[this.choice];try{localStorage.setItem(Rc,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function yf(){try{return localStorage.getItem(Rc)}catch{return null}}function Fs(t,e,{embedded:n=!1,adopt:o=null,notice:s=null}={}){let r=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(Lc+Dc),r.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,c=()=>{a||=requestAnimationFrame(ge)},h=new Rs(e,c,o,s);e.open();let u=new Wn,p=new zo(h),f=new Go(h,p),y=new Ts(
h),w=new Ms(h,p,f,nt,q=>y.showLayer(q),n),k=[new Hn,new Vn,new qn,new Kn,new es,new Zo,new jn,new zn,new Yn,new Bn,new qo],M=k.map(({name:q})=>x("canvas",{className:q})),
T=M[M.length-1];Object.assign(T,{tabIndex:0,role:"application"});let S=new jo(k,M);new Ko(T,h,u,p,f,n);let E=new Vo(T,h,u,p,f),A={truth:!0,rays:!0,readings:!0,strokes:!0,
trajectory:!0},J=Kl(w),R=ca(w),Y={chip:ac(w),banner:lc(w)},V=x("main",{className:"stage"},...M,Y.chip,Y.banner),Q=()=>z.theme,B=()=>u.transform.scale,D=Ql(w,Q,B),
j=cc(w);T.setAttribute("aria-describedby",j.readout.id);let L=Hl(w),F={help:Gl(w),new:zl(w),share:L.dialog},[I,K,G,Le]=[pc(w),uc(w),fc(w),mc(w)],ue=[Wl(w),vc(w),
jl(w),Bl(w),tc(w),nc(w,Il(w,Q),Ul(w,Q)),yc(w),dc(w),gc(w,y,A,B),I,K,hc(w),G,Le],oe=x("aside",{"aria-label":"Controls"},...ue),ae=()=>h.recorded||h.document?.source.
kind==="run";w.visible(I,()=>h.editable),w.visible(K,()=>!ae()),w.visible(G,()=>!ae()),w.visible(Le,()=>!ae()),w.each(()=>{C(R,"inert",!h.document),C(oe,"inert",
!h.document)});let ee=x("div",{className:"app"},J.element,R,V,D,oe,j.element,...Object.values(F));r.replaceChildren(ee);let z=new $s(ee,q=>{J.nameTheme(q),c()}),
Te=()=>{let q=h.editable&&p.tool==="sensor"?p.sensor?.id??null:null;return{session:h,view:u,look:{theme:z.theme,...A,hover:p.hover,cursor:p.cursor,selected:q}}},
Ue="";function ge(){a=0;let q=h.take();h.document&&String(h.shape)!==Ue&&(Ue=String(h.shape),u.fit(h.shape),p.cursor=p.hover=null,h.decisions.forget(),h.evidence.
forget(),h.ghost.refit(),T.setAttribute("aria-label",`Map, ${h.shape[0]} by ${h.shape[1]} cells`)),S.paint(Te()),q&&(h.painted(),y.step());let{x:ie,y:je}=u.transform;
Y.chip.style.transform=`translate(${Math.max(ie,Ye.left)}px, ${Math.max(je-28,6)}px)`,ht(T,"data-tool",h.editable||Et.has(p.tool)?p.tool:"pan"),w.refresh()}let le=new ResizeObserver(
()=>{let{width:q,height:ie}=V.getBoundingClientRect();!q||!ie||(u.resize(q,ie,devicePixelRatio||1),u.fitted&&u.fit(h.shape),cancelAnimationFrame(a),ge())});le.observe(
V);async function nt(q){if(q==="in"||q==="out")u.zoom(q==="in"?1.4:1/1.4,u.middle,h.shape);else if(q==="fit")u.fit(h.shape);else if(q==="help")F.help.showModal();else if(q===
"new")F.new.showModal();else if(q==="theme")z.next();else if(q==="add")E.addSensor();else if(q==="share"){let ie=h.portableDocument();ie&&L.show(location.origin+
location.pathname+await Oi(ie))}else if(q==="export png"){let ie=await aa(Te());ie&&gr("bayesmap.png",ie),h.say("Saved bayesmap.png")}else q.startsWith("export ")&&
h.act({type:"export",what:q.slice(7)});c()}h.ondownload=(q,ie,je)=>gr(q,new Blob([je],{type:ie}));let ft=[[n?t:window,"keydown",q=>{q.defaultPrevented||!h.document||
Object.values(F).some(ie=>ie.open)||qi(q,h,{tool:ie=>{p.choose(ie),E.focus()},layer:ie=>y.showLayer(ie),command:nt})}],[window,"online",()=>e.retry?.()],[window,
"hashchange",async()=>{if(n)return;let{document:q,damaged:ie}=await Wo();q?h.bring(q):ie&&h.say(Uo,"error")}]];for(let[q,ie,je]of ft)q.addEventListener(ie,je);return z.
dress(),{destroy(){le.disconnect(),cancelAnimationFrame(a),z.destroy();for(let[q,ie,je]of ft)q.removeEventListener(ie,je);e.close(),r.replaceChildren()},snapshot:()=>xc(
h,u,S),cellToClient(q,ie){let je=T.getBoundingClientRect(),Wt=u.fromGrid({x:q+.5,y:ie+.5},h.shape[1]);return{x:je.left+Wt.x,y:je.top+Wt.y}}}}var ti={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},$c=8,io=()=>({onmessage:()=>{},onstatus:()=>{}});function Fc(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let c=a.reduce((h,u)=>h*u,1)*ti[i].
BYTES_PER_ELEMENT;o[r]=new ti[i](t.slice(s,s+c)),s+=Math.ceil(c/$c)*$c}return[n,o]}function Oc(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{
let{buffer:i,byteOffset:a,byteLength:c}=e[r];n[o]=new ti[s](i.slice(a,a+c))}),n}function Ic(t){let{document:e,scans:n,settings:o,log_joint:s}=t,r=e.grid.shape[0]*e.grid.shape[1],{chains:i,count:a}=t.draws,c=e.source.kind!=="simulation",h=Ht(
t.mean),u=Ht(t.observed),p=null,f=0,y={layer:"mean",chain:0,draw:null},w=L=>c?[L[f]]:L,k=L=>Float32Array.from(w(L).flat(),Uc),M=L=>n.angles[L]??n.angles[0],T=[0];
n.pose.forEach((L,F)=>T.push(T[F]+M(F).length));let S=go(Ht(n.hit),T[n.pose.length]),E=()=>c?S.subarray(T[f],T[f+1]):S,A=Float32Array.from(s.flat(),Number),J=o.
sweeps/Math.max(1,a),R=Float32Array.from(s[0]??[],(L,F)=>(F+1)*J),Y=1,V=()=>({chains:i,count:p?a:0}),Q=(L=0)=>{let F={generation:Y,can_undo:!1,can_redo:!1,live:!1,
running:!1,working:!1,scan:f};j.onmessage({type:"state",document:e,seq:L,...F,draws:V(),view:y},{})},B=()=>{let L=Float64Array.from(w(n.pose).flat(),Number),F=n.
exact.length?k(n.exact):new Float32Array(0),I={pose:L,angles:Float32Array.from(M(f)),ranges:k(n.ranges),exact:F,hit:E()};j.onmessage({type:"scan",generation:Y,ids:c?
[f]:n.ids,index:c?f:null},I)},D=()=>{let L=y.layer==="draw",F=(L?y.draw:null)??a-1,I=L&&p?wf(p,y.chain*a+F,r):null,{method:K,quantity:G,sweeps:Le,ess:ue,rhat:oe,
verdict:ae}=o,ee={sweeps:Le,total:Le,ess:ue,rhat:oe,verdict:ae,log_joint:s[y.chain]?.[F]??null},z=I?{layer:y.layer,chain:y.chain,draw:F}:{layer:L?"mean":y.layer,
chain:null,draw:null},Te={generation:Y,approximate:!1,milliseconds:0,averaged:null,lowest:null};j.onmessage({type:"field",...Te,...z,method:K,quantity:G,...ee,draws:V()},
{p:I??h,observed:u,trace:A,traced:R})},j={...io(),open:()=>j.onstatus({connected:!0}),send:L=>{if(L.type==="hello"){if(j.onmessage({type:"welcome",version:1,limits:null,
recorded:!0},{}),Q(L.seq),B(),D(),!a)return;Io(Ht(t.draws.data)).then(F=>{p=F,Q(L.seq)})}else if(L.type==="view")y={layer:L.layer,chain:L.chain??y.chain,draw:L.
draw??null},Q(L.seq),D();else if(L.type==="scan")f=L.index,Q(L.seq),B();else if(L.type==="inspect"){let{x:F,y:I}=L,K=bf(e,w(n.pose).map((Le,ue)=>M(c?f:ue)),w(n.
pose),w(n.ranges),F,I),G={beams_for:null,nats_for:null,beams_against:null,nats_against:null};j.onmessage({type:"cell",x:F,y:I,each:!1,beams:K,...G},{})}},close:()=>{}};
return j}var Uc=t=>t===null?1/0:Number(t);function wf(t,e,n){let o=e*n;return Uint8Array.from({length:n},(s,r)=>t[o+r>>3]>>7-(o+r&7)&1?255:0)}function bf({grid:t},e,n,o,s,r){
let{origin:i,resolution:a}=t,c=[i[0]+s*a,i[1]+r*a],h=0;return n.forEach((u,p)=>{let[f,y,w]=u.map(Number);e[p].forEach((k,M)=>{let[T,S]=[Math.cos(k+w),Math.sin(k+
w)],E=[(c[0]-f)/T,(c[0]+a-f)/T,(c[1]-y)/S,(c[1]+a-y)/S],A=Math.max(0,Math.min(E[0],E[1]),Math.min(E[2],E[3])),J=Math.min(Uc(o[p][M]),Math.max(E[0],E[1]),Math.max(
E[2],E[3]));A<J&&h++})}),h}var ni=250,vf=8e3;function Wc(t){let e=null,n=ni,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let c=new WebSocket(a),h=!1;e=c,c.binaryType="arraybuffer",c.onopen=()=>{h=!0,n=ni,i.onstatus({connected:!0})},c.onmessage=({data:u})=>{typeof u==
"string"?i.onmessage(JSON.parse(u),{}):i.onmessage(...Fc(u))},c.onclose=()=>{if(s||e!==c)return;o=window.setTimeout(r,n);let u={connected:!1,retryIn_ms:n};i.onstatus(
u),h||xf(t()).then(p=>p&&e===c&&i.onstatus({...u,refused:p})),n=Math.min(vf,2*n)}}let i={...io(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=ni,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};return i}async function xf(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Gc(t){let e=(o,s=[])=>n.onmessage(o,Oc(o,s)),n={...io(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var kf="This is the map that was drawn here when the connection was lost; undo leads back",oi=t=>Object.assign(window,{bayesmap:t}),Wy={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=Fs(n,Gc(t),{embedded:!0});return oi(o),()=>o.destroy()}};async function Sf(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){oi(Fs(t,Ic(JSON.parse(n.textContent??""))));return}Tc(new URLSearchParams(location.search).get("token"));let{document:o,damaged:s}=await Wo(),
r=o?null:Mc(),i=Wc(()=>new URL(location.href));Pc(c=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(c)}${location.hash}`),i.retry?.()}),
oi(Fs(t,i,{adopt:o??r,notice:s?{text:Uo,level:"error"}:r?{text:kf,level:"info"}:null}))}Sf();export{Wy as default,Fs as mount,Ic as recordedTransport,Wc as webSocketTransport,Gc as widgetTransport};
