// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function fo(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Mi(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Wt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function $o(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Ti(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Io=t=>Ti(t,new DecompressionStream("deflate-raw")),Pi=t=>Ti(t,new CompressionStream("deflate-r\
aw"));async function Ei(t){let e=await Pi(new TextEncoder().encode(JSON.stringify(t)));return"#m="+$o(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Zc(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Io(Wt(e[1]))))}var Oo="The link's map cannot be read: copy the link again, who\
le";async function Uo(){let t=await Zc(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var se=(t,e,n)=>Math.min(n,Math.max(e,t)),Yt=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,De=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Xs=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function dn(t,e){let{x:n,y:o}=De(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var On=(t,e)=>Xs({x:t.x+.5,y:t.y+.5},e);
function _i(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Ai(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let c=i<
n&&s(r-1,i)!==s(r,i);c&&a<0&&(a=i),!c&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let c=i<e&&s(i,r-1)!==s(i,r);c&&
a<0&&(a=i),!c&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var mo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Ci(t,e,n){let o=Di(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Ri(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Li(t,e){
let n=Qc(e,t.grid.shape),o=Di(t);return Ri(t,(s,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let c of o)a=Math.min(a,Math.hypot(s-c.x,r-c.y));return a>0?a:-1/0})}
var Di=({sensors:t,grid:e})=>t.map(n=>dn(n,e));function Ri(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let c=e(i,a,i*o+a);
c>r&&([s,r]=[{x:i,y:a},c])}return s&&On(s,t.grid)}function Qc(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)o[r*n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),
s(r+1,i-1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var Se={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],fov_deg:[5,360],pose_sigma:[0,2],heading_sigma_deg:[0,30],sweeps:[1,
1e5],seed:[0,2147483647],side_of_log:1e3};var Go=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Yt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(u=>dn(u,r.grid)):[],c=new Map;for(let u of e)!Yt(u,i)||this.isWall(u)===n||a.some(h=>h.x===
u.x&&h.y===u.y)||c.set(u.x*i[1]+u.y,[u.x,u.y]);c.size&&this.session.act({type:"walls",cells:[...c.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"sensor",op:"move",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?Li(o,n.walls):"world"in e?e.world:Ci(o,n.walls,e.near);s?o.sensors.length>=Se.sensors?n.say(`There can be ${Se.sensors}\
 sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"sensor",op:"add",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=Math.
max(0,...o.sensors.map(r=>r.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sen\
sor",op:"remove",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=dn(e,n.document.grid),s=this.isWall(o);return!s&&Yt(o,n.shape)?(n.status.
text.startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var $t=new Set(["pan","path","look","where","ghost"]),Xc=120,Wo=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.ghost.hold(e==="ghost"),this.session.changed()}select(e){this.selected=e,this.
session.changed()}point(e){let n=e&&Yt(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){
!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.
act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},Xc))}};var Ye={left:36,right:12,top:34,bottom:26},eu=60,tu=160,Un=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-Ye.left-Ye.right,y:this.height-Ye.
top-Ye.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:Ye.left+(o.x-
s*e)/2,y:Ye.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n])}zoom(e,n,o){let{scale:s}=this.transform,{x:r,y:i}=this.corner,a=se(s*e,Math.min(this.width,this.height)/
Math.max(...o)/3,tu),c=a/s;this.transform.scale=a,this.corner={x:n.x-c*(n.x-r),y:n.y-c*(n.y-i)},this.fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.
y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;
return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=eu;this.corner.x=se(this.corner.x,s-e*o,this.width-s),this.corner.y=se(this.corner.y,
s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var Ii=[["D, E, S, P","draw, erase, sensor, pan"],["G, L","path, look next"],["W, O","where am I, ghost"],["arrows","move the cursor, the sensor or the view; wi\
th Shift by five cells"],["Space","draw or erase at the cursor; next sensor; start or goal of a path"],["[ and ]","turn the sensor"],["A, Delete","add, remove a\
 sensor"],["R, Escape","run, cancel"],["M, N, H","show the mean, a draw, the entropy"],["Ctrl+Z, Ctrl+Y","undo, redo"],["+, −, 0","zoom in, out, whole map"],[
"?","this help"]],nu={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},Ni=Math.PI/12,zo=class{constructor(e,n,o,s,r){this.canvas=e;this.session=
n;this.view=o;this.hand=s;this.editor=r;e.addEventListener("keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.
pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)
return;let r=nu[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?Ni:
-Ni;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.
toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key==="Backspace")&&n.editable)s.removeSensor();else if(e.key==="Escape"&&o.cursor)
o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is \
room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&o.ghost.pose&&o.document){let{resolution:c}=o.document.grid,{x:u,y:h}=o.ghost.
pose;o.ghost.move({x:u+e*c,y:h+n*c})}else if((r.tool==="sensor"||r.tool==="where")&&r.sensor&&o.document&&o.editable){let{resolution:c}=o.document.grid;r.selected=
r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*c,y:r.sensor.y+n*c})}else if(r.tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let c=r.
cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},u={x:se(c.x+e,0,i-1),y:se(c.y+n,0,a-1)};r.setCursor(u);let h=s.fromGrid({x:u.x+.5,y:u.y+.5},a),d=(w,y,S)=>w-se(w,y,
S),m={x:d(h.x,Ye.left+10,s.width-20),y:d(h.y,20,s.height-Ye.bottom-10)};(m.x||m.y)&&s.pan(-m.x,-m.y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if(o.
tool==="path"&&n.document){o.cursor?n.decisions.point(On(o.cursor,n.document.grid)):this.arrow(0,0);return}if(n.editable){if(o.tool==="sensor"){let r=n.document?.
sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,r.length)]?.id??null),o.selected!==null&&o.announce(`Sensor ${o.selected}`)}else if(o.
tool!=="pan"){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.announce(i?"wall":"free")}}}},er={d:"\
draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost"},Fi={m:"mean",n:"draw",h:"entropy"},$i={"+":"in","=":"in","-":"out",0:"fit","?":"help"};
function Oi(t,e,n){let o=t.composedPath()[0],s=o instanceof HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.type),r=t.key.toLowerCase();if((t.
ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}if(!(s||t.altKey)){
if(er[r]&&(e.editable||$t.has(er[r])&&!e.recorded))n.tool(er[r]);else if(Fi[r])n.layer(Fi[r]);else if($i[t.key])n.command($i[t.key]);else if(r==="r"&&!e.recorded)
e.act({type:"run"});else if(t.key==="Escape"&&(e.running||e.sampling))e.act({type:"cancel"});else return;t.preventDefault()}}var Ho=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let c of this.sheets){let{canvas:u,context:h,layer:d}=c,m=d.shows?.(e)??!0,w=[m,...m?[...a,...d.depends(e)]:[]];w.length===
c.before.length&&w.every((y,S)=>Object.is(y,c.before[S]))||(c.before=w,u.style.visibility=m?"":"hidden",m&&((u.width!==i.width||u.height!==i.height)&&(Object.assign(
u,i),u.style.width=`${i.width/s}px`,u.style.height=`${i.height/s}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,u.width,u.height),h.setTransform(s,0,0,s,0,0),
h.save(),d.paint(h,e),h.restore(),this.paints[d.name]++))}}};function je(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,o*r,s*r),t.clip()}function go(t,{halo:e},n,o){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}var tr='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Jt(t,e,n,o,s,r,i=!1){t.font=tr,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}function nr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Zt(t,e,n){let o=n.fromGrid(De(t,e),e.shape[1]),s=se(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function Ui(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=nr(e);t.lineJoin=
"round";for(let a of i){let c=Zt(a,s.grid,n),{point:u,size:h}=c;a.id===o.selected&&ou(t,c,o);let[d,m]=[Math.cos(a.yaw),-Math.sin(a.yaw)],w=(y,S)=>[u.x+h*(y*d-S*
m),u.y+h*(y*m+S*d)];t.beginPath(),t.moveTo(...w(1.25,0)),t.lineTo(...w(-.9,.8)),t.lineTo(...w(-.45,0)),t.lineTo(...w(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Jt(t,String(a.id),u.x,u.y+h*2+4,r,"center",!0)}}function ou(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),go(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function Gi(t,e,n,o,s){let r=c=>Math.hypot(e.x-c.x,e.y-c.y),i=t.pose&&Zt({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Wi(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var zi={touch:24,other:11},su=5,ru=90,Vo=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(c,u)=>e.
addEventListener(c,u,{passive:!1});a("pointerdown",c=>this.down(c)),a("pointermove",c=>this.move(c)),a("pointerup",c=>this.up(c)),a("pointercancel",c=>this.up(c)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",c=>this.wheel(c)),a("contextmenu",c=>c.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return Xs(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(Gi(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&(o.tool==="path"||o.tool===
"look"))return this.begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(
i.id),this.begin(i);if(e.button===1||$t.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="se\
nsor"&&o.select(a.id);else if(o.tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"s\
ensor",id:o.sensor.id,drag:o.nextGesture(),grip:{x:0,y:0}}),this.dragSensor(e));else{let c=o.tool==="draw"!==(e.button===2||e.shiftKey),u=this.cellAt(r),h=c&&this.
editor.isWall(u);this.begin({kind:"stroke",id:o.nextGesture(),wall:c,last:u,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),
ru)}}gripAt(e,n,o){let{hand:s,view:r}=this,i=this.reach(n),a=m=>Math.hypot(e.x-m.x,e.y-m.y),c=s.tool==="sensor"&&s.sensor?Zt(s.sensor,o.grid,r):null;if(c&&s.sensor&&
a(c.handle)<Math.min(i,a(c.point)))return{kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let u=o.sensors.map(m=>({
id:m.id,...Zt(m,o.grid,r)}));u.sort((m,w)=>a(m.point)-a(w.point));let h=u.find(({point:m,size:w})=>a(m)<Math.max(i,w));if(!h)return null;let d={x:h.point.x-e.x,
y:h.point.y-e.y};return{kind:"sensor",id:h.id,drag:s.nextGesture(),grip:d}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.
held;this.gesture.held=null,this.stroke([this.gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&
this.fingers.set(e.pointerId,i),!n)r.point(this.cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();
let a=[],c=e.getCoalescedEvents?.()??[];for(let u of c.length?c:[e]){let h=this.cellAt(this.at(u));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(..._i(
n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(u=>u.id===
n.id);if(!a||!o.document)return;let c=this.metres(i,o.document);this.editor.moveSensor(a,{yaw:Math.atan2(c.y-a.y,c.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.
hypot(i.x-n.first.x,i.y-n.first.y)>su&&this.begin({kind:"pan",last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.
fingers.size===2){let{middle:a,spread:c}=this.spread();s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(c/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:c}),
o.changed()}}up(e){e.type==="pointerup"&&this.release(),e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.
last],!1,this.gesture.id,e),e.type==="pointerup"&&this.gesture?.kind==="pick"&&this.pick(this.gesture.first),this.fingers.delete(e.pointerId),this.fingers.size===
0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.point(this.cellAt(this.at(e))),
this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?zi.touch:zi.other}pointAtReading(e){let{document:n,reading:o,ghost:s}=this.session;if(!n||s.held)
return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:o}=this;if(n?.kind!==
"ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);Wi(o.ghost,n,this.metres({x:s.x+n.grip.x,y:s.y+n.grip.y},o.document))}pick(e){let{session:n,hand:o,
editor:s}=this;if(!n.document)return;let r=this.metres(e,n.document);if(o.tool==="path")return n.decisions.point(r);let i=n.decisions.nearest(r),{views:a}=n.decisions;
if(i===null||!a)return;let[c,u,h]=a.pose.subarray(3*i,3*i+3),d=`${a.nats[i].toFixed(1)} nats`;n.editable?s.addSensor({world:{x:c,y:u},yaw:h}):n.say(`A scan from\
 ${c.toFixed(2)}, ${u.toFixed(2)} m would tell ${d}`)}spread(){let[e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,
Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&
!n)return;e.preventDefault();let o=e.deltaMode===1?16:1;e.shiftKey?this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*
(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(
e,s.wall,s.id,n),o.status.level==="error"&&o.say("Ready"))}dragSensor(e){let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.
point(null);let r=s.sensors.find(c=>c.id===n.id),i=this.at(e),a=this.metres({x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var iu=5,Bo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(Ye.left,0,o.width,o.height-Ye.bottom),e.clip(),s.hover&&Hi(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&Hi(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function Hi(t,e,n,o,s,r,i){let{scale:a}=o.transform,c=o.fromGrid({x:e.x,y:e.y+1},n),u=Math.max(a,iu),[h,d]=[c.x-(u-a)/2,c.y-(u-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(h,d,u,u),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,d,u,u)}var au={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},lu={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},qo={light:au,dark:lu},Vi="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function cu([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((c,u)=>(c>.20689655172413793?c**3:.12841854934601665*(c-.13793103448275862))*s[u]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(c=>{let u=se(c,0,1);return Math.round(255*(u<=.0031308?12.92*u:1.055*u**(1/2.4)-.055))})}var jo=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),or=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),sr=(t,e)=>cu(or(t.paper,t.ink,e));function yo(t){let e=Math.min(15,Math.floor(
t*16));return or(jo(Vi,6*e),jo(Vi,6*e+6),t*16-e)}function Bi(t,e){let n=new Uint8ClampedArray(2048).fill(255),[o,s]=[jo(t.unobserved),jo(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?mo(r/255):r/255;n.set(e==="value"?sr(t,r/255):yo(i),4*r),n.set(or(o,s,e==="value"?r/255:0),4*(r+256))}return new Uint32Array(n.buffer)}
var ji=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var uu=9,pu=2.5,Gn=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start||e.looking&&e.views))}paint(e,n){let{session:o}=n;o.document&&(je(e,n),o.decisions.looking&&this.views(e,n),this.path(e,n))}views(e,{session:n,
view:o,look:s}){let{views:r}=n.decisions,i=n.document?.grid;if(!r?.nats.length||!i)return;let[a,c]=[Math.min(...r.nats),Math.max(...r.nats)],u=se(.38*r.spacing*
o.transform.scale/i.resolution,pu,uu),h=r.nats.indexOf(c);for(let d=0;d<r.nats.length;d++){let m=o.fromGrid(De({x:r.pose[3*d],y:r.pose[3*d+1]},i),i.shape[1]);e.
beginPath(),e.arc(m.x,m.y,u,0,2*Math.PI),e.fillStyle=`rgb(${yo(se((r.nats[d]-a)/Math.max(c-a,1e-9),0,1)).map(Math.round)})`,e.fill(),d===h&&(e.lineWidth=2.5,e.strokeStyle=
s.theme.truth,e.stroke())}}path(e,{session:n,view:o,look:s}){let{start:r,goal:i,path:a,radius:c}=n.decisions,u=n.document?.grid;if(!u||!r)return;let h=d=>o.fromGrid(
De(d,u),u.shape[1]);if(a){e.beginPath();for(let[d,m]of a.path){let w=h({x:d,y:m});e.lineTo(w.x,w.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=a.within_risk?s.theme.
sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*c*o.transform.scale/u.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let d of i?[r,i]:[r]){
let{x:m,y:w}=h(d);e.beginPath(),e.arc(m,w,5,0,2*Math.PI),e.fillStyle=d===r?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}}};var du=10,hu=7,fu=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Ko=()=>document.createElement("canvas").getContext("2d"),Wn=class{name="\
field";cells=Ko();mask=Ko();hatch=Ko();palettes=new Map;image=new ImageData(1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.
flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:c,x:u,y:h}=s.transform;je(e,n);let d=o.flicker.under??o.shown;if(!d||d.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
u,h,i*c,a*c);return}this.fill(d,i,a,r.theme,fu(d,o.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,u,h,i*c,a*c),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),c>=du&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:c}=this,
u=`${s.ground} ${r}`;if(c.field===e&&c.palette===u)return;let h=this.palettes.get(u)??Bi(s,r);if(this.palettes.set(u,h),this.image.width!==n||this.image.height!==
o){this.image=new ImageData(n,o);for(let{canvas:m}of[i,a])Object.assign(m,{width:n,height:o});c.bits=null}let d=new Uint32Array(this.image.data.buffer);for(let m=0,
w=0;m<o;m++)for(let y=o-1-m;y<n*o;y+=o)d[w++]=h[e.p[y]+(e.observed[y]?0:256)];if(i.putImageData(this.image,0,0),c.bits!==e.bits){for(let m=0,w=0;m<o;m++)for(let y=o-
1-m;y<n*o;y+=o)d[w++]=e.observed[y]?0:4278190080;a.putImageData(this.image,0,0),c.hatch=""}Object.assign(c,{field:e,bits:e.bits,palette:u})}fillHatch({session:e,
view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:c,height:u}=n,{scale:h,x:d,y:m}=n.transform,[w,y]=e.shape,S=[o.theme.ground,h,d,m,c,u,a].join(" ");
if(i.hatch===S)return;i.hatch=S;let k=Ko(),P=k.canvas.width=k.canvas.height=Math.round(hu*a);k.strokeStyle=o.theme.hatch,k.lineWidth=a,k.beginPath();for(let _ of[
-P,0,P])k.moveTo(_-1,P+1),k.lineTo(_+P+1,-1);k.stroke(),Object.assign(s.canvas,{width:Math.ceil(c*a),height:Math.ceil(u*a)}),s.setTransform(a,0,0,a,0,0),s.imageSmoothingEnabled=
!1,s.drawImage(r.canvas,d,m,w*h,y*h),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let M=s.createPattern(k.canvas,"repeat");M.setTransform(
new DOMMatrix().translate(Math.round(d*a),Math.round(m*a))),s.fillStyle=M,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,view:o,look:s}){let[
r,i]=n.shape,{scale:a,x:c,y:u}=o.transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(c+h*a,u),e.lineTo(c+h*a,u+i*a);for(let h=1;h<i;h++)e.moveTo(c,u+h*a),e.lineTo(
c+r*a,u+h*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var mu=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],zn=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(je(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(c,u)=>{let h=se(r[u],0,a),d=o.yaw+c,m={x:o.x+h*Math.cos(d),y:o.y+h*Math.sin(d)};return n.fromGrid(De(m,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(y=>this.ends(n,o,o.angles,y)),{grid:c}=n.session.document,u=n.view.fromGrid(De(o,c),c.shape[1]),h=new Path2D;
h.moveTo(u.x,u.y);for(let{x:y,y:S}of r)h.lineTo(y,S);h.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(h);let d=new Path2D,m=new Path2D,w=se(n.view.transform.
scale*.12,1.2,3);for(let y=0;y<r.length;y++)d.moveTo(r[y].x,r[y].y),d.lineTo(a[y].x,a[y].y),Number.isFinite(o.median[y])&&m.rect(i[y].x-w,i[y].y-w,2*w,2*w);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=se(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(d),e.globalAlpha=1,m}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,c=se(n.view.transform.scale*.14,1.5,4),u=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),h=new Path2D;u.forEach(({x:d,y:m},w)=>{i[w]&&
(h.moveTo(d+c,m),h.arc(d,m,c,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:c,handle:u}=Zt({id:0,...r},i,o),[h,d]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(u.x,u.y),go(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[m,w]of mu)e.lineTo(a.x+c*(m*h-w*d),a.y+c*(m*d+w*h));e.closePath(),e.lineJoin="round",go(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(u.x,u.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var Hn=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:o,view:s,look:r}=n,i=o.flicker.under&&o.shown;if(!i)return;let[a,c]=o.shape,
{scale:u,x:h,y:d}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,c,r.theme.draw),je(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,d,a*u,c*u)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(u=>parseInt(s.slice(u,u+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let c=new ImageData(
n,o);for(let u=0,h=0;u<o;u++)for(let d=o-1-u;d<n*o;d+=o,h+=4)c.data.set([r,i,a,e.observed[d]?e.p[d]:0],h);this.cells.putImageData(c,0,0),this.drawn={field:e,colour:s}}};var gu=46;function yu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function qi(t,{session:e,view:n,look:o}){if(!e.document)return;
let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:c,shape:u}=e.document.grid,{scale:h,x:d,y:m}=n.transform,w=yu(gu/h*c),y=Math.min(m+u[1]*h,i-Ye.bottom)+
.5,S=Math.max(d,Ye.left)-.5;t.fillStyle=s.ground,d<S&&t.fillRect(0,0,S,i+1),m+u[1]*h>y&&t.fillRect(0,y,r+1,i+1-y);let k=Math.max(0,-Math.floor(Math.log10(w)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let P=_=>Math.ceil(a[_]/w-1e-9)*w,M=_=>a[_]+u[_]*c+1e-9;for(let _=P(0);_<=M(0);_+=w){let E=d+(_-a[0])/c*h;E<S||
E>r-4||(t.moveTo(E,y),t.lineTo(E,y+4),Jt(t,_.toFixed(k),E,y+12,s,"center"))}for(let _=P(1);_<=M(1);_+=w){let E=m+(u[1]-(_-a[1])/c)*h;E>y||E<4||(t.moveTo(S,E),t.
lineTo(S-4,E),Jt(t,_.toFixed(k),S-7,E,s,"right"))}t.stroke(),Jt(t,"m",S-7,y+12,s,"right")}var Vn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=nr(e).flatMap(({id:i,x:a,y:c,yaw:u})=>[i,a,c,u]),{grid:s}=e.document??{},
r=Ki(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:c,x:u,y:h}=s.transform;r.truth&&Ki(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(u-.5,h-.5,i*c+1,a*c+1),Ui(e,n),qi(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:c}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=Ai(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),je(e,n),e.transform(i,0,0,-i,a,c+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=se(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},Ki=({document:t})=>t?.source.kind==="simulation";var bu=600,wu=1500,vu=65536,rr=.3,Bn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;if(!i||!a)return;
je(e,n);let{scale:c}=s.transform,u=1/a.grid.resolution,h=a.grid.shape[1],d=i.angles.length,m=i.pose.length/3,w=Math.ceil(d*m/wu),[y,S,k]=[new Path2D,new Path2D,
new Path2D],P=d*m>bu,M=new Map,_=se(c*.1,1.3,4),E=a.scans_used??1/0,q=(i.index??0)<E?1:rr;for(let D=0;D<m;D++){let[K,V,N]=i.pose.subarray(3*D,3*D+3),G=s.fromGrid(
De({x:K,y:V},a.grid),h);for(let C=0;C<d;C++){let Z=i.ranges[D*d+C],I=i.hit[D*d+C]===1,j=(I?Z:a.max_range)*u*c,W=i.angles[C]+N,Q={x:G.x+j*Math.cos(W),y:G.y-j*Math.
sin(W)},z=I?y:S;(D*d+C)%w===0&&(z.moveTo(G.x,G.y),z.lineTo(Q.x,Q.y)),I&&(P?M.set(Math.round(Q.x)*vu+Math.round(Q.y),Q):(k.moveTo(Q.x+_,Q.y),k.arc(Q.x,Q.y,_,0,2*
Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=q*se(28/Math.sqrt(d*m/w)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(y),e.strokeStyle=r.theme.noReturn,e.stroke(
S),e.globalAlpha=1),r.readings){e.globalAlpha=q,e.fillStyle=r.theme.ray,e.fill(k);let D=1.8*_;for(let{x:K,y:V}of M.values())e.fillRect(K-D/2,V-D/2,D,D);e.globalAlpha=
1}}};var xu=2.5,jn=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(je(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&n.view.transform.scale>=xu&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,c=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[u,h,d]of[[0,c,.6],
[Math.max(0,c-1),a,.6*rr]]){e.beginPath();for(let m=u;m<h;m++){let w=o.fromGrid(De({x:r[2*m],y:r[2*m+1]},i),i.shape[1]);e.lineTo(w.x,w.y)}e.globalAlpha=d,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[c,u,h,d]=r.subarray(a,a+4),[m,
w]=[o.fromGrid(De({x:c,y:u},i),i.shape[1]),o.fromGrid(De({x:h,y:d},i),i.shape[1])];e.moveTo(m.x,m.y),e.lineTo(w.x,w.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=se(o.transform.scale/5,.8,2.5),e.stroke()}}};var ku=2.2,Yo=7,[Su,Mu]=[.03,.75],Tu=2.4477,Yi=9,qn=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!(!s||!r)){je(e,n),this.
cloud(e,n,r);for(let i of s.modes)this.place(e,n,r,i,s.modes.length>1)}}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,c=a[a.length-1]||
1;e.strokeStyle=e.fillStyle=s.theme.belief,e.lineWidth=1.2;for(let u=0;u<a.length;u++){if(a[u]<Su**2*c)continue;let[h,d,m]=i.subarray(3*u,3*u+3),w=o.fromGrid(De(
{x:h,y:d},r),r.shape[1]);e.globalAlpha=Mu*Math.sqrt(a[u]/c),e.beginPath(),e.arc(w.x,w.y,ku,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(w.x,w.y),e.lineTo(w.x+Yo*
Math.cos(m),w.y-Yo*Math.sin(m)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:o},s,r,i){let[a,c,u]=r.mean,h=n.fromGrid(De({x:a,y:c},s),s.shape[1]),d=Tu*n.transform.
scale/s.resolution,[[m,w],[,y]]=r.covariance,[S,k]=[(m+y)/2,Math.hypot((m-y)/2,w)],[P,M]=[S+k,S-k].map(E=>Math.max(Yi,d*Math.sqrt(Math.max(E,0))));e.beginPath(),
e.ellipse(h.x,h.y,P,M,-Math.atan2(2*w,m-y)/2,0,2*Math.PI);let _=Yi+1;e.moveTo(h.x+_*Math.cos(u),h.y-_*Math.sin(u)),e.lineTo(h.x+(_+Yo)*Math.cos(u),h.y-(_+Yo)*Math.
sin(u)),e.strokeStyle=o.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i&&Jt(e,ir(r.probability),h.x,h.y-M-9,o.theme,
"center",!0)}},ir=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var Ji=900,bo=2;function Zi({session:t,look:e}){let[n,o]=t.shape,s=new Un;s.resize(Ji,Math.round(se(Ji*o/n,300,1800)),bo),s.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:s.width*bo,height:s.height*bo});let i=r.getContext("2d");i.scale(bo,bo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);
let a=[new Wn,new Hn,new jn,new Bn,new Vn,new Gn,new qn,new zn];for(let c of a)i.save(),c.paint(i,{session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}}),
i.restore();return new Promise(c=>r.toBlob(c))}var Jo=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o}}){return!!(e.
picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:c,document:u}=o;if(!i||!u||c?.index!==i.scan)return;
je(e,n);let{grid:h,max_range:d}=u,m=k=>{let P={x:i.from.x+k*Math.cos(i.angle),y:i.from.y+k*Math.sin(i.angle)};return s.fromGrid(De(P,h),h.shape[1])},w=(k,P,M,_)=>{
e.beginPath(),e.moveTo(k.x,k.y),e.lineTo(P.x,P.y),e.lineWidth=M,e.strokeStyle=_,e.stroke()},y=c.hit[i.beam]===1,S=m(y?c.ranges[i.beam]:d);if(w(m(0),S,3,r.theme.
halo),w(m(0),S,1.5,y?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let k=(P,M)=>se(P??M,0,d);if(w(m(k(a.low,0)),m(k(a.high,d)),6,r.theme.ghost),a.median!==null){
let P=m(a.median),M={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};w({x:P.x-M.x,y:P.y-M.y},{x:P.x+M.x,y:P.y+M.y},2.5,r.theme.ghost)}}y&&(e.beginPath(),e.arc(S.x,
S.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};function x(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function R(t,e,n){t[e]!==n&&(t[e]=n)}function pt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var hn=t=>t.getRootNode().activeElement===t,Ce=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function ar(t,e){let n=URL.
createObjectURL(e);x("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Qi=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["path","Path","path"],["look","Look next","look"],["w\
here","Where am I?","where"],["ghost","Ghost","ghost"]];function Xi(t){let{hand:e,session:n}=t,o=t.segmented("Tool",Qi,()=>n.editable||!n.document||$t.has(e.tool)?
e.tool:"pan",s=>e.choose(s),s=>n.editable||$t.has(s)&&!n.recorded||s==="pan");return t.visible(o,()=>!n.recorded),Qi.forEach(([s],r)=>{$t.has(s)||t.visible(o.children[r],
()=>!n.document||n.editable)}),x("div",{className:"bar"},o,x("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),
t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Pu="uplot",Eu="u-hz",_u="u-vt",Au="u-title",Cu="u-wrap",Lu="u-under",Du="u-over",Ru="u-axis",gn="u-off",Nu="u-select",Fu="u-cursor-x",$u="u-cursor-y",Iu="u-\
cursor-pt",Ou="u-legend",Uu="u-live",Gu="u-inline",Wu="u-series",zu="u-marker",ea="u-label",Hu="u-value",vo="width",xo="height";var ta="bottom",Kn="left",lr="right",Tr="#000",na=Tr+"0",cr="mousemove",oa="mousedown",ur="mouseup",sa="mouseenter",ra="mouseleave",ia="dblclick",Vu="resize",Bu="\
scroll",aa="change",ts="dppxchange",Pr="--",to=typeof window<"u",mr=to?document:null,Jn=to?window:null,ju=to?navigator:null,de,Zo;function gr(){let t=devicePixelRatio;
de!=t&&(de=t,Zo&&br(aa,Zo,gr),Zo=matchMedia(`(min-resolution: ${de-.001}dppx) and (max-resolution: ${de+.001}dppx)`),yn(aa,Zo,gr),Jn.dispatchEvent(new CustomEvent(
ts)))}function dt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function yr(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Me(t,e,n){
t.style[e]=n+"px"}function Et(t,e,n,o){let s=mr.createElement(t);return e!=null&&dt(s,e),n?.insertBefore(s,o),s}function xt(t,e){return Et("div",t,e)}var la=new WeakMap;
function It(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=la.get(t);r!=i&&(t.style.transform=r,la.set(t,r),e<0||n<0||e>o||n>s?dt(t,gn):yr(t,gn))}var ca=new WeakMap;
function ua(t,e,n){let o=e+n,s=ca.get(t);o!=s&&(ca.set(t,o),t.style.background=e,t.style.borderColor=n)}var pa=new WeakMap;function da(t,e,n,o){let s=e+""+n,r=pa.
get(t);s!=r&&(pa.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Er={passive:!0},qu={...Er,
capture:!0};function yn(t,e,n,o){e.addEventListener(t,n,o?qu:Er)}function br(t,e,n,o){e.removeEventListener(t,n,Er)}to&&gr();function _t(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:ht((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function Ga(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var Wa=t=>t!=null,za=t=>t!=null&&t>0,ss=Ga(Wa),Ku=Ga(za);function Yu(t,e,n,o=0,s=!1){
let r=s?Ku:ss,i=s?za:Wa;[e,n]=r(t,e,n);let a=t[e],c=t[e];if(e>-1)if(o==1)a=t[e],c=t[n];else if(o==-1)a=t[n],c=t[e];else for(let u=e;u<=n;u++){let h=t[u];i(h)&&(h<
a?a=h:h>c&&(c=h))}return[a??ye,c??-ye]}function rs(t,e,n,o){let s=ma(t),r=ma(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?zt:Ha,a=s==1?ht:kt,c=r==1?kt:ht,
u=a(i(Ie(t))),h=c(i(Ie(e))),d=Zn(n,u),m=Zn(n,h);return n==10&&(u<0&&(d=be(d,-u)),h<0&&(m=be(m,-h))),o||n==2?(t=d*s,e=m*r):(t=qa(t,d),e=is(e,m)),[t,e]}function _r(t,e,n,o){
let s=rs(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ar=.1,ha={mode:3,pad:Ar},So={pad:0,soft:null,mode:0},Ju={min:So,max:So};function ns(t,e,n,o){return as(
n)?fa(t,e,n):(So.pad=n,So.soft=o?0:null,So.mode=o?3:0,fa(t,e,Ju))}function ce(t,e){return t??e}function Zu(t,e,n){for(e=ce(e,0),n=ce(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function fa(t,e,n){let o=n.min,s=n.max,r=ce(o.pad,0),i=ce(s.pad,0),a=ce(o.hard,-ye),c=ce(s.hard,ye),u=ce(o.soft,ye),h=ce(s.soft,-ye),
d=ce(o.mode,0),m=ce(s.mode,0),w=e-t,y=zt(w),S=nt(Ie(t),Ie(e)),k=zt(S),P=Ie(k-y);(w<1e-24||P>10)&&(w=0,(t==0||e==0)&&(w=1e-24,d==2&&u!=ye&&(r=0),m==2&&h!=-ye&&(i=
0)));let M=w||S||1e3,_=zt(M),E=Zn(10,ht(_)),q=M*(w==0?t==0?.1:1:r),D=be(qa(t-q,E/10),24),K=t>=u&&(d==1||d==3&&D<=u||d==2&&D>=u)?u:ye,V=nt(a,D<K&&t>=K?K:At(K,D)),
N=M*(w==0?e==0?.1:1:i),G=be(is(e+N,E/10),24),C=e<=h&&(m==1||m==3&&G>=h||m==2&&G<=h)?h:-ye,Z=At(c,G>C&&e<=C?C:nt(C,G));return V==Z&&V==0&&(Z=100),[V,Z]}var Qu=new Intl.
NumberFormat(to?ju.language:"en-US"),Cr=t=>Qu.format(t),ft=Math,es=ft.PI,Ie=ft.abs,ht=ft.floor,$e=ft.round,kt=ft.ceil,At=ft.min,nt=ft.max,Zn=ft.pow,ma=ft.sign,zt=ft.
log10,Ha=ft.log2,Xu=(t,e=1)=>ft.sinh(t)*e,pr=(t,e=1)=>ft.asinh(t/e),ye=1/0;function ga(t){return(zt((t^t>>31)-(t>>31))|0)+1}function wr(t,e,n){return At(nt(t,e),
n)}function Va(t){return typeof t=="function"}function ie(t){return Va(t)?t:()=>t}var ep=()=>{},Ba=t=>t,ja=(t,e)=>e,tp=t=>null,ya=t=>!0,ba=(t,e)=>t==e,np=/\.\d*?(?=9{6,}|0{6,})/gm,
bn=t=>{if(Ya(t)||Xt.has(t))return t;let e=`${t}`,n=e.match(np);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${bn(
s)}e${r}`}return be(t,o)};function fn(t,e){return bn(be(bn(t/e))*e)}function is(t,e){return bn(kt(bn(t/e))*e)}function qa(t,e){return bn(ht(bn(t/e))*e)}function be(t,e=0){
if(Ya(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return $e(o)/n}var Xt=new Map;function Ka(t){return((""+t).split(".")[1]||"").length}function To(t,e,n,o){
let s=[],r=o.map(Ka);for(let i=e;i<n;i++){let a=Ie(i),c=be(Zn(t,i),a);for(let u=0;u<o.length;u++){let h=t==10?+`${o[u]}e${i}`:o[u]*c,d=(i>=0?0:a)+(i>=r[u]?0:r[u]),
m=t==10?h:be(h,d);s.push(m),Xt.set(m,d)}}return s}var Mo={},Lr=[],Qn=[null,null],Qt=Array.isArray,Ya=Number.isInteger,op=t=>t===void 0;function wa(t){return typeof t==
"string"}function as(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function sp(t){return t!=null&&typeof t=="object"}var rp=Object.getPrototypeOf(
Uint8Array),Ja="__proto__";function Xn(t,e=as){let n;if(Qt(t)){let o=t.find(s=>s!=null);if(Qt(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=Xn(t[s],
e)}else n=t.slice()}else if(t instanceof rp)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Ja&&(n[o]=Xn(t[o],e))}else n=t;return n}function Re(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=Ja&&(as(t[s])?Re(t[s],Xn(o[s])):t[s]=Xn(o[s]))}return t}var ip=0,ap=1,lp=2;function cp(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function up(t,e){if(hp(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return fp(i[0])||(i=dp(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let c=t[i][0],u=c.length;for(let h=0;h<
u;h++)n.add(c[h])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],c=a[0];
for(let u=1;u<a.length;u++){let h=a[u],d=Array(s).fill(void 0),m=e?e[i][u]:ap,w=[];for(let y=0;y<h.length;y++){let S=h[y],k=r.get(c[y]);S===null?m!=ip&&(d[k]=S,
m==lp&&w.push(k)):d[k]=S}cp(d,w,s),o.push(d)}}return o}var pp=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function dp(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let c=0;c<n;c++)a[c]=
i[o[c]];s.push(a)}return s}function hp(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function fp(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=nt(1,ht((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let c=t[a];if(c!=null){if(c<=i)return!1;i=c}}return!0}var Za=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Qa=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Xa(t){
return t.slice(0,3)}var mp=Qa.map(Xa),gp=Za.map(Xa),yp={MMMM:Za,MMM:gp,WWWW:Qa,WWW:mp};function wo(t){return(t<10?"0":"")+t}function bp(t){return(t<10?"00":t<100?
"0":"")+t}var wp={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>wo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>wo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>wo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>wo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>wo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>bp(t.getMilliseconds())};function Dr(t,e){e=e||yp;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?wp[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var vp=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function xp(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==vp?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var el=t=>t%1==0,os=[1,2,2.5,5],kp=To(10,-32,0,os),tl=To(10,0,32,os),Sp=tl.filter(
el),mn=kp.concat(tl),Rr=`
`,nl="{YYYY}",va=Rr+nl,ol="{M}/{D}",ko=Rr+ol,Qo=ko+"/{YY}",sl="{aa}",Mp="{h}:{mm}",Yn=Mp+sl,xa=Rr+Yn,ka=":{ss}",he=null;function rl(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,c=(t==1?To(10,0,3,os).filter(el):To(10,-3,0,os)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),u=[[i,nl,he,he,he,he,he,he,1],[s*28,"{MMM}",va,he,he,he,he,he,1],[s,ol,va,he,
he,he,he,he,1],[o,"{h}"+sl,Qo,he,ko,he,he,he,1],[n,Yn,Qo,he,ko,he,he,he,1],[e,ka,Qo+" "+Yn,he,ko+" "+Yn,he,xa,he,1],[t,ka+".{fff}",Qo+" "+Yn,he,ko+" "+Yn,he,xa,
he,1]];function h(d){return(m,w,y,S,k,P)=>{let M=[],_=k>=i,E=k>=r&&k<i,q=d(y),D=be(q*t,3),K=dr(q.getFullYear(),_?0:q.getMonth(),E||_?1:q.getDate()),V=be(K*t,3);
if(E||_){let N=E?k/r:0,G=_?k/i:0,C=D==V?D:be(dr(K.getFullYear()+G,K.getMonth()+N,1)*t,3),Z=new Date($e(C/t)),I=Z.getFullYear(),j=Z.getMonth();for(let W=0;C<=S;W++){
let Q=dr(I+G*W,j+N*W,1),z=Q-d(be(Q*t,3));C=be((+Q+z)*t,3),C<=S&&M.push(C)}}else{let N=k>=s?s:k,G=ht(y)-ht(D),C=V+G+is(D-V,N);M.push(C);let Z=d(C),I=Z.getHours()+
Z.getMinutes()/n+Z.getSeconds()/o,j=k/o,W=m.axes[w]._space,Q=P/W;for(;C=be(C+k,t==1?0:3),!(C>S);)if(j>1){let z=ht(be(I+j,6))%24,re=d(C).getHours()-z;re>1&&(re=-1),
C-=re*o,I=(I+j)%24;let ue=M[M.length-1];be((C-ue)/k,3)*Q>=.7&&M.push(C)}else M.push(C)}return M}}return[c,u,h]}var[Tp,Pp,Ep]=rl(1),[_p,Ap,Cp]=rl(.001);To(2,-53,
53,[1]);function Sa(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function Ma(t,e){return(n,o,s,r,i)=>{let a=e.find(y=>i>=
y[0])||e[e.length-1],c,u,h,d,m,w;return o.map(y=>{let S=t(y),k=S.getFullYear(),P=S.getMonth(),M=S.getDate(),_=S.getHours(),E=S.getMinutes(),q=S.getSeconds(),D=k!=
c&&a[2]||P!=u&&a[3]||M!=h&&a[4]||_!=d&&a[5]||E!=m&&a[6]||q!=w&&a[7]||a[1];return c=k,u=P,h=M,d=_,m=E,w=q,D(S)})}}function Lp(t,e){let n=Dr(e);return(o,s,r,i,a)=>s.
map(c=>n(t(c)))}function dr(t,e,n){return new Date(t,e,n)}function Ta(t,e){return e(t)}var Dp="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Pa(t,e){return(n,o,s,r)=>r==
null?Pr:e(t(o))}function Rp(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Np(t,e){return t.series[e].fill(
t,e)}var Fp={show:!0,live:!0,isolate:!1,mount:ep,markers:{show:!0,width:2,stroke:Rp,fill:Np,dash:"solid"},idx:null,idxs:null,values:[]};function $p(t,e){let n=t.
cursor.points,o=xt(),s=n.size(t,e);Me(o,vo,s),Me(o,xo,s);let r=s/-2;Me(o,"marginLeft",r),Me(o,"marginTop",r);let i=n.width(t,e,s);return i&&Me(o,"borderWidth",i),
o}function Ip(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Op(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Up(t,e){return t.
series[e].points.size}var hr=[0,0];function Gp(t,e,n){return hr[0]=e,hr[1]=n,hr}function Xo(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function fr(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var Wp={show:!0,x:!0,y:!0,lock:!1,move:Gp,points:{one:!1,show:$p,size:Up,width:0,stroke:Op,fill:Ip},bind:{mousedown:Xo,mouseup:Xo,
click:Xo,dblclick:Xo,mousemove:fr,mouseleave:fr,mouseenter:fr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},il={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Nr=Re({},il,{filter:ja}),al=Re({},Nr,{size:10}),ll=Re({},il,{show:!1}),Fr='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',cl="bold "+Fr,ul=1.5,Ea={
show:!0,scale:"x",stroke:Tr,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:cl,side:2,grid:Nr,ticks:al,border:ll,font:Fr,lineGap:ul,rotate:0},
zp="Value",Hp="Time",_a={show:!0,scale:"x",auto:!1,sorted:1,min:ye,max:-ye,idxs:[]};function Vp(t,e,n,o,s){return e.map(r=>r==null?"":Cr(r))}function Bp(t,e,n,o,s,r,i){
let a=[],c=Xt.get(s)||0;n=i?n:be(is(n,s),c);for(let u=n;u<=o;u=be(u+s,c))a.push(Object.is(u,-0)?0:u);return a}function vr(t,e,n,o,s,r,i){let a=[],c=t.scales[t.axes[e].
scale].log,u=c==10?zt:Ha,h=ht(u(n));s=Zn(c,h),c==10&&(s=mn[_t(s,mn)]);let d=n,m=s*c;c==10&&(m=mn[_t(m,mn)]);do a.push(d),d=d+s,c==10&&!Xt.has(d)&&(d=be(d,Xt.get(
s))),d>=m&&(s=d,m=s*c,c==10&&(m=mn[_t(m,mn)]));while(d<=o);return a}function jp(t,e,n,o,s,r,i){let c=t.scales[t.axes[e].scale].asinh,u=o>c?vr(t,e,nt(c,n),o,s):[
c],h=o>=0&&n<=0?[0]:[];return(n<-c?vr(t,e,nt(c,-o),-n,s):[c]).reverse().map(m=>-m).concat(h,u)}var pl=/./,qp=/[12357]/,Kp=/[125]/,Aa=/1/,xr=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function Yp(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],c=t.valToPos,u=r._space,h=c(10,i),d=c(
9,i)-h>=u?pl:c(7,i)-h>=u?qp:c(5,i)-h>=u?Kp:Aa;if(d==Aa){let m=Ie(c(1,i)-h);if(m<u)return xr(e.slice().reverse(),a.distr,d,kt(u/m)).reverse()}return xr(e,a.distr,
d,1)}function Jp(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,c=t.valToPos,u=Ie(c(1,i)-c(2,i));return u<a?xr(e.slice().reverse(),3,pl,kt(a/u)).reverse():e}function Zp(t,e,n,o){
return o==null?Pr:e==null?"":Cr(e)}var Ca={show:!0,scale:"y",stroke:Tr,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:cl,side:3,grid:Nr,ticks:al,
border:ll,font:Fr,lineGap:ul,rotate:0};function Qp(t,e){let n=3+(t||1)*2;return be(n*e,3)}function Xp(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Ie(i-r),c=t.series[e],u=a/(c.points.space*de);return o[1]-o[0]<=u}var La={scale:null,auto:!0,sorted:0,min:ye,max:-ye},
dl=(t,e,n,o,s)=>s,Da={show:!0,auto:!0,sorted:0,gaps:dl,alpha:1,facets:[Re({},La,{scale:"x"}),Re({},La,{scale:"y"})]},Ra={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:dl,alpha:1,points:{show:Xp,filter:null},values:null,min:ye,max:-ye,idxs:[],path:null,clip:null};function ed(t,e,n,o,s){return n/10}var hl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},td=Re({},hl,{time:!1,ori:1}),Na={};function fl(t,e){let n=Na[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,c,u){for(let h=0;h<n.plots.length;h++)n.plots[h]!=s&&n.plots[h].pub(o,s,r,i,a,c,u)}},t!=null&&(Na[t]=
n)),n}var eo=1,kr=2;function wn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,c=r[0],u=o==2?r[1]:r[e],h=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],d=o==2?i[s.facets[1].scale]:i[s.scale],m=a.left,w=a.top,y=a.width,S=a.height,k=t.valToPosH,P=t.valToPosV;return h.ori==0?n(s,c,u,h,d,k,P,m,
w,y,S,cs,no,ps,gl,bl):n(s,c,u,h,d,P,k,w,m,S,y,us,oo,Or,yl,wl)}function $r(t,e){let n=0,o=0,s=ce(t.bands,Lr);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function nd(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
c=t.scales[a];return s==-1?c.min:s==1?c.max:c.distr==3?c.dir==1?c.min:c.max:0}function Ht(t,e,n,o,s,r){return wn(t,e,(i,a,c,u,h,d,m,w,y,S,k)=>{let P=i.pxRound,M=u.
dir*(u.ori==0?1:-1),_=u.ori==0?no:oo,E,q;M==1?(E=n,q=o):(E=o,q=n);let D=P(d(a[E],u,S,w)),K=P(m(c[E],h,k,y)),V=P(d(a[q],u,S,w)),N=P(m(r==1?h.max:h.min,h,k,y)),G=new Path2D(
s);return _(G,V,N),_(G,D,N),_(G,D,K),G})}function ls(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?ps:Or,c=n;for(let d=0;d<t.length;d++){let m=t[d];
if(m[1]>m[0]){let w=m[0]-c;w>0&&a(i,c,o,w,o+r),c=m[1]}}let u=n+s-c,h=10;u>0&&a(i,c,o-h/2,u,o+r+h)}return i}function od(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Ir(t,e,n,o,s,r,i){let a=[],c=t.length;for(let u=s==1?n:o;u>=n&&u<=o;u+=s)if(e[u]===null){let d=u,m=u;if(s==1)for(;++u<=o&&e[u]===null;)
m=u;else for(;--u>=n&&e[u]===null;)m=u;let w=r(t[d]),y=m==d?w:r(t[m]),S=d-s;w=i<=0&&S>=0&&S<c?r(t[S]):w;let P=m+s;y=i>=0&&P>=0&&P<c?r(t[P]):y,y>=w&&a.push([w,y])}
return a}function Fa(t){return t==0?Ba:t==1?$e:e=>fn(e,t)}function ml(t){let e=t==0?cs:us,n=t==0?(s,r,i,a,c,u)=>{s.arcTo(r,i,a,c,u)}:(s,r,i,a,c,u)=>{s.arcTo(i,r,
c,a,u)},o=t==0?(s,r,i,a,c)=>{s.rect(r,i,a,c)}:(s,r,i,a,c)=>{s.rect(i,r,c,a)};return(s,r,i,a,c,u=0,h=0)=>{u==0&&h==0?o(s,r,i,a,c):(u=At(u,a/2,c/2),h=At(h,a/2,c/2),
e(s,r+u,i),n(s,r+a,i,r+a,i+c,u),n(s,r+a,i+c,r,i+c,h),n(s,r,i+c,r,i,h),n(s,r,i,r+a,i,u),s.closePath())}}var cs=(t,e,n)=>{t.moveTo(e,n)},us=(t,e,n)=>{t.moveTo(n,e)},
no=(t,e,n)=>{t.lineTo(e,n)},oo=(t,e,n)=>{t.lineTo(n,e)},ps=ml(0),Or=ml(1),gl=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},yl=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},bl=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},wl=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function vl(t){return(e,n,o,s,r)=>wn(e,n,(i,a,c,u,h,d,m,w,y,S,k)=>{let{pxRound:P,
points:M}=i,_,E;u.ori==0?(_=cs,E=gl):(_=us,E=yl);let q=be(M.width*de,3),D=(M.size-M.width)/2*de,K=be(D*2,3),V=new Path2D,N=new Path2D,{left:G,top:C,width:Z,height:I}=e.
bbox;ps(N,G-K,C-K,Z+K*2,I+K*2);let j=W=>{if(c[W]!=null){let Q=P(d(a[W],u,S,w)),z=P(m(c[W],h,k,y));_(V,Q+D,z),E(V,Q,z,D,0,es*2)}};if(r)r.forEach(j);else for(let W=o;W<=
s;W++)j(W);return{stroke:q>0?V:null,fill:V,clip:N,flags:eo|kr}})}function xl(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var sd=xl(no),rd=xl(oo);function kl(t){let e=ce(t?.alignGaps,0);return(n,o,s,r)=>wn(n,o,(i,a,c,u,h,d,m,w,y,S,k)=>{[s,r]=ss(c,s,r);let P=i.pxRound,M=I=>P(d(I,u,S,
w)),_=I=>P(m(I,h,k,y)),E,q;u.ori==0?(E=no,q=sd):(E=oo,q=rd);let D=u.dir*(u.ori==0?1:-1),K={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:eo},V=K.
stroke,N=!1;if(r-s>=S*4){let I=H=>n.posToVal(H,u.key,!0),j=null,W=null,Q,z,Je,me=M(a[D==1?s:r]),re=M(a[s]),ue=M(a[r]),ee=I(D==1?re+1:ue-1);for(let H=D==1?s:r;H>=
s&&H<=r;H+=D){let Ee=a[H],ge=(D==1?Ee<ee:Ee>ee)?me:M(Ee),ae=c[H];ge==me?ae!=null?(z=ae,j==null?(E(V,ge,_(z)),Q=j=W=z):z<j?j=z:z>W&&(W=z)):ae===null&&(N=!0):(j!=
null&&q(V,me,_(j),_(W),_(Q),_(z)),ae!=null?(z=ae,E(V,ge,_(z)),j=W=Q=z):(j=W=null,ae===null&&(N=!0)),me=ge,ee=I(me+D))}j!=null&&j!=W&&Je!=me&&q(V,me,_(j),_(W),_(
Q),_(z))}else for(let I=D==1?s:r;I>=s&&I<=r;I+=D){let j=c[I];j===null?N=!0:j!=null&&E(V,M(a[I]),_(j))}let[C,Z]=$r(n,o);if(i.fill!=null||C!=0){let I=K.fill=new Path2D(
V),j=i.fillTo(n,o,i.min,i.max,C),W=_(j),Q=M(a[s]),z=M(a[r]);D==-1&&([z,Q]=[Q,z]),E(I,z,W),E(I,Q,W)}if(!i.spanGaps){let I=[];N&&I.push(...Ir(a,c,s,r,D,M,e)),K.gaps=
I=i.gaps(n,o,s,r,I),K.clip=ls(I,u.ori,w,y,S,k)}return Z!=0&&(K.band=Z==2?[Ht(n,o,s,r,V,-1),Ht(n,o,s,r,V,1)]:Ht(n,o,s,r,V,Z)),K})}function id(t){let e=ce(t.align,
1),n=ce(t.ascDesc,!1),o=ce(t.alignGaps,0),s=ce(t.extend,!1);return(r,i,a,c)=>wn(r,i,(u,h,d,m,w,y,S,k,P,M,_)=>{[a,c]=ss(d,a,c);let E=u.pxRound,{left:q,width:D}=r.
bbox,K=re=>E(y(re,m,M,k)),V=re=>E(S(re,w,_,P)),N=m.ori==0?no:oo,G={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:eo},C=G.stroke,Z=m.dir*(m.ori==
0?1:-1),I=V(d[Z==1?a:c]),j=K(h[Z==1?a:c]),W=j,Q=j;s&&e==-1&&(Q=q,N(C,Q,I)),N(C,j,I);for(let re=Z==1?a:c;re>=a&&re<=c;re+=Z){let ue=d[re];if(ue==null)continue;let ee=K(
h[re]),H=V(ue);e==1?N(C,ee,I):N(C,W,H),N(C,ee,H),I=H,W=ee}let z=W;s&&e==1&&(z=q+D,N(C,z,I));let[Je,me]=$r(r,i);if(u.fill!=null||Je!=0){let re=G.fill=new Path2D(
C),ue=u.fillTo(r,i,u.min,u.max,Je),ee=V(ue);N(re,z,ee),N(re,Q,ee)}if(!u.spanGaps){let re=[];re.push(...Ir(h,d,a,c,Z,K,o));let ue=u.width*de/2,ee=n||e==1?ue:-ue,
H=n||e==-1?-ue:ue;re.forEach(Ee=>{Ee[0]+=ee,Ee[1]+=H}),G.gaps=re=u.gaps(r,i,a,c,re),G.clip=ls(re,m.ori,k,P,M,_)}return me!=0&&(G.band=me==2?[Ht(r,i,a,c,C,-1),Ht(
r,i,a,c,C,1)]:Ht(r,i,a,c,C,me)),G})}function $a(t,e,n,o,s,r,i=ye){if(t.length>1){let a=null;for(let c=0,u=1/0;c<t.length;c++)if(e[c]!==void 0){if(a!=null){let h=Ie(
t[c]-t[a]);h<u&&(u=h,i=Ie(n(t[c],o,s,r)-n(t[a],o,s,r)))}a=c}}return i}function ad(t){t=t||Mo;let e=ce(t.size,[.6,ye,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==
null?[0,0]:typeof s=="number"?[s,0]:s;let r=ie(s),i=1-e[0],a=ce(e[1],ye),c=ce(e[2],1),u=ce(t.disp,Mo),h=ce(t.each,w=>{}),{fill:d,stroke:m}=u;return(w,y,S,k)=>wn(
w,y,(P,M,_,E,q,D,K,V,N,G,C)=>{let Z=P.pxRound,I=n,j=o*de,W=a*de,Q=c*de,z,Je;E.ori==0?[z,Je]=r(w,y):[Je,z]=r(w,y);let me=E.dir*(E.ori==0?1:-1),re=E.ori==0?ps:Or,
ue=E.ori==0?h:(O,we,Fe,kn,on,Ct,sn)=>{h(O,we,Fe,on,kn,sn,Ct)},ee=ce(w.bands,Lr).find(O=>O.series[0]==y),H=ee!=null?ee.dir:0,Ee=P.fillTo(w,y,P.min,P.max,H),Ue=Z(
K(Ee,q,C,N)),ge,ae,mt,ot=G,Te=Z(P.width*de),it=!1,Y=null,ne=null,Ne=null,Ot=null;d!=null&&(Te==0||m!=null)&&(it=!0,Y=d.values(w,y,S,k),ne=new Map,new Set(Y).forEach(
O=>{O!=null&&ne.set(O,new Path2D)}),Te>0&&(Ne=m.values(w,y,S,k),Ot=new Map,new Set(Ne).forEach(O=>{O!=null&&Ot.set(O,new Path2D)})));let{x0:vn,size:ro}=u;if(vn!=
null&&ro!=null){I=1,M=vn.values(w,y,S,k),vn.unit==2&&(M=M.map(Fe=>w.posToVal(V+Fe*G,E.key,!0)));let O=ro.values(w,y,S,k);ro.unit==2?ae=O[0]*G:ae=D(O[0],E,G,V)-D(
0,E,G,V),ot=$a(M,_,D,E,G,V,ot),mt=ot-ae+j}else ot=$a(M,_,D,E,G,V,ot),mt=ot*i+j,ae=ot-mt;mt<1&&(mt=0),Te>=ae/2&&(Te=0),mt<5&&(Z=Ba);let Po=mt>0,tn=ot-mt-(Po?Te:0);
ae=Z(wr(tn,Q,W)),ge=(I==0?ae/2:I==me?0:ae)-I*me*((I==0?j/2:0)+(Po?Te/2:0));let Qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},xn=it?null:new Path2D,
Ut=null;if(ee!=null)Ut=w.data[ee.series[1]];else{let{y0:O,y1:we}=u;O!=null&&we!=null&&(_=we.values(w,y,S,k),Ut=O.values(w,y,S,k))}let nn=z*ae,te=Je*ae;for(let O=me==
1?S:k;O>=S&&O<=k;O+=me){let we=_[O];if(we==null)continue;if(Ut!=null){let st=Ut[O]??0;if(we-st==0)continue;Ue=K(st,q,C,N)}let Fe=E.distr!=2||u!=null?M[O]:O,kn=D(
Fe,E,G,V),on=K(ce(we,Ee),q,C,N),Ct=Z(kn-ge),sn=Z(nt(on,Ue)),at=Z(At(on,Ue)),gt=sn-at;if(we!=null){let st=we<0?te:nn,St=we<0?nn:te;it?(Te>0&&Ne[O]!=null&&re(Ot.get(
Ne[O]),Ct,at+ht(Te/2),ae,nt(0,gt-Te),st,St),Y[O]!=null&&re(ne.get(Y[O]),Ct,at+ht(Te/2),ae,nt(0,gt-Te),st,St)):re(xn,Ct,at+ht(Te/2),ae,nt(0,gt-Te),st,St),ue(w,y,
O,Ct-Te/2,at,ae+Te,gt)}}return Te>0?Qe.stroke=it?Ot:xn:it||(Qe._fill=P.width==0?P._fill:P._stroke??P._fill,Qe.width=0),Qe.fill=it?ne:xn,Qe})}function ld(t,e){let n=ce(
e?.alignGaps,0);return(o,s,r,i)=>wn(o,s,(a,c,u,h,d,m,w,y,S,k,P)=>{[r,i]=ss(u,r,i);let M=a.pxRound,_=z=>M(m(z,h,k,y)),E=z=>M(w(z,d,P,S)),q,D,K;h.ori==0?(q=cs,K=no,
D=bl):(q=us,K=oo,D=wl);let V=h.dir*(h.ori==0?1:-1),N=_(c[V==1?r:i]),G=N,C=[],Z=[];for(let z=V==1?r:i;z>=r&&z<=i;z+=V)if(u[z]!=null){let me=c[z],re=_(me);C.push(
G=re),Z.push(E(u[z]))}let I={stroke:t(C,Z,q,K,D,M),fill:null,clip:null,band:null,gaps:null,flags:eo},j=I.stroke,[W,Q]=$r(o,s);if(a.fill!=null||W!=0){let z=I.fill=
new Path2D(j),Je=a.fillTo(o,s,a.min,a.max,W),me=E(Je);K(z,G,me),K(z,N,me)}if(!a.spanGaps){let z=[];z.push(...Ir(c,u,r,i,V,_,n)),I.gaps=z=a.gaps(o,s,r,i,z),I.clip=
ls(z,h.ori,y,S,k,P)}return Q!=0&&(I.band=Q==2?[Ht(o,s,r,i,j,-1),Ht(o,s,r,i,j,1)]:Ht(o,s,r,i,j,Q)),I})}function cd(t){return ld(ud,t)}function ud(t,e,n,o,s,r){let i=t.
length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let c=Array(i),u=Array(i-1),h=Array(i-1),d=Array(i-1);for(let m=0;m<i-1;m++)
h[m]=e[m+1]-e[m],d[m]=t[m+1]-t[m],u[m]=h[m]/d[m];c[0]=u[0];for(let m=1;m<i-1;m++)u[m]===0||u[m-1]===0||u[m-1]>0!=u[m]>0?c[m]=0:(c[m]=3*(d[m-1]+d[m])/((2*d[m]+d[m-
1])/u[m-1]+(d[m]+2*d[m-1])/u[m]),isFinite(c[m])||(c[m]=0));c[i-1]=u[i-2];for(let m=0;m<i-1;m++)s(a,t[m]+d[m]/3,e[m]+c[m]*d[m]/3,t[m+1]-d[m]/3,e[m+1]-c[m+1]*d[m]/
3,t[m+1],e[m+1])}return a}var Sr=new Set;function Ia(){for(let t of Sr)t.syncRect(!0)}to&&(yn(Vu,Jn,Ia),yn(Bu,Jn,Ia,!0),yn(ts,Jn,()=>{Oe.pxRatio=de}));var pd=kl(),
dd=vl();function Oa(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Mr(r,i,e,n))}function hd(t,e){return t.map((n,o)=>o==
0?{}:Re({},e,n))}function Mr(t,e,n,o){return Re({},e==0?n:o,t)}function Sl(t,e,n){return e==null?Qn:[e,n]}var fd=Sl;function md(t,e,n){return e==null?Qn:ns(e,n,
Ar,!0)}function Ml(t,e,n,o){return e==null?Qn:rs(e,n,t.scales[o].log,!1)}var gd=Ml;function Tl(t,e,n,o){return e==null?Qn:_r(e,n,t.scales[o].log,!1)}var yd=Tl;function bd(t,e,n,o,s){
let r=nt(ga(t),ga(e)),i=e-t,a=_t(s/o*i,n);do{let c=n[a],u=o*c/i;if(u>=s&&r+(c<5?Xt.get(c):0)<=17)return[c,u]}while(++a<n.length);return[0,0]}function Ua(t){let e,
n;return t=t.replace(/(\d+)px/,(o,s)=>(e=$e((n=+s)*de))+"px"),[t,e,n]}function wd(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=be(e[2]*de,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Oe(t,e,n){let o={mode:ce(t.mode,1)},s=o.mode;function r(l,p,f,g){let b=p.valToPct(l);return g+f*(p.dir==-1?1-b:b)}function i(l,p,f,g){
let b=p.valToPct(l);return g+f*(p.dir==-1?b:1-b)}function a(l,p,f,g){return p.ori==0?r(l,p,f,g):i(l,p,f,g)}o.valToPosH=r,o.valToPosV=i;let c=!1;o.status=0;let u=o.
root=xt(Pu);if(t.id!=null&&(u.id=t.id),dt(u,t.class),t.title){let l=xt(Au,u);l.textContent=t.title}let h=Et("canvas"),d=o.ctx=h.getContext("2d"),m=xt(Cu,u);yn("\
click",m,l=>{l.target===y&&(ve!=Rn||Pe!=Nn)&&Ke.click(o,l)},!0);let w=o.under=xt(Lu,m);m.appendChild(h);let y=o.over=xt(Du,m);t=Xn(t);let S=+ce(t.pxAlign,1),k=Fa(
S);(t.plugins||[]).forEach(l=>{l.opts&&(t=l.opts(o,t)||t)});let P=t.ms||.001,M=o.series=s==1?Oa(t.series||[],_a,Ra,!1):hd(t.series||[null],Da),_=o.axes=Oa(t.axes||
[],Ea,Ca,!0),E=o.scales={},q=o.bands=t.bands||[];q.forEach(l=>{l.fill=ie(l.fill||null),l.dir=ce(l.dir,-1)});let D=s==2?M[1].facets[0].scale:M[0].scale,K={axes:$c,
series:Lc},V=(t.drawOrder||["axes","series"]).map(l=>K[l]);function N(l){let p=l.distr==3?f=>zt(f>0?f:l.clamp(o,f,l.min,l.max,l.key)):l.distr==4?f=>pr(f,l.asinh):
l.distr==100?f=>l.fwd(f):f=>f;return f=>{let g=p(f),{_min:b,_max:v}=l,T=v-b;return(g-b)/T}}function G(l){let p=E[l];if(p==null){let f=(t.scales||Mo)[l]||Mo;if(f.
from!=null){G(f.from);let g=Re({},E[f.from],f,{key:l});g.valToPct=N(g),E[l]=g}else{p=E[l]=Re({},l==D?hl:td,f),p.key=l;let g=p.time,b=p.range,v=Qt(b);if((l!=D||s==
2&&!g)&&(v&&(b[0]==null||b[1]==null)&&(b={min:b[0]==null?ha:{mode:1,hard:b[0],soft:b[0]},max:b[1]==null?ha:{mode:1,hard:b[1],soft:b[1]}},v=!1),!v&&as(b))){let T=b;
b=(A,L,F)=>L==null?Qn:ns(L,F,T)}p.range=ie(b||(g?fd:l==D?p.distr==3?gd:p.distr==4?yd:Sl:p.distr==3?Ml:p.distr==4?Tl:md)),p.auto=ie(v?!1:p.auto),p.clamp=ie(p.clamp||
ed),p._min=p._max=null,p.valToPct=N(p)}}}G("x"),G("y"),s==1&&M.forEach(l=>{G(l.scale)}),_.forEach(l=>{G(l.scale)});for(let l in t.scales)G(l);let C=E[D],Z=C.distr,
I,j;C.ori==0?(dt(u,Eu),I=r,j=i):(dt(u,_u),I=i,j=r);let W={};for(let l in E){let p=E[l];(p.min!=null||p.max!=null)&&(W[l]={min:p.min,max:p.max},p.min=p.max=null)}
let Q=t.tzDate||(l=>new Date($e(l/P))),z=t.fmtDate||Dr,Je=P==1?Ep(Q):Cp(Q),me=Ma(Q,Sa(P==1?Pp:Ap,z)),re=Pa(Q,Ta(Dp,z)),ue=[],ee=o.legend=Re({},Fp,t.legend),H=o.
cursor=Re({},Wp,{drag:{y:s==2}},t.cursor),Ee=ee.show,Ue=H.show,ge=ee.markers;ee.idxs=ue,ge.width=ie(ge.width),ge.dash=ie(ge.dash),ge.stroke=ie(ge.stroke),ge.fill=
ie(ge.fill);let ae,mt,ot,Te=[],it=[],Y,ne=!1,Ne={};if(ee.live){let l=M[1]?M[1].values:null;ne=l!=null,Y=ne?l(o,1,0):{_:0};for(let p in Y)Ne[p]=Pr}if(Ee)if(ae=Et(
"table",Ou,u),ot=Et("tbody",null,ae),ee.mount(o,ae),ne){mt=Et("thead",null,ae,ot);let l=Et("tr",null,mt);Et("th",null,l);for(var Ot in Y)Et("th",ea,l).textContent=
Ot}else dt(ae,Gu),ee.live&&dt(ae,Uu);let vn={show:!0},ro={show:!1};function Po(l,p){if(p==0&&(ne||!ee.live||s==2))return Qn;let f=[],g=Et("tr",Wu,ot,ot.childNodes[p]);
dt(g,l.class),l.show||dt(g,gn);let b=Et("th",null,g);if(ge.show){let A=xt(zu,b);if(p>0){let L=ge.width(o,p);L&&(A.style.border=L+"px "+ge.dash(o,p)+" "+ge.stroke(
o,p)),A.style.background=ge.fill(o,p)}}let v=xt(ea,b);l.label instanceof HTMLElement?v.appendChild(l.label):v.textContent=l.label,p>0&&(ge.show||(v.style.color=
l.width>0?ge.stroke(o,p):ge.fill(o,p)),Qe("click",b,A=>{if(H._lock)return;an(A);let L=M.indexOf(l);if((A.ctrlKey||A.metaKey)!=ee.isolate){let F=M.some(($,U)=>U>
0&&U!=L&&$.show);M.forEach(($,U)=>{U>0&&Dt(U,F?U==L?vn:ro:vn,!0,Le.setSeries)})}else Dt(L,{show:!l.show},!0,Le.setSeries)},!1),Mn&&Qe(sa,b,A=>{H._lock||(an(A),Dt(
M.indexOf(l),$n,!0,Le.setSeries))},!1));for(var T in Y){let A=Et("td",Hu,g);A.textContent="--",f.push(A)}return[g,f]}let tn=new Map;function Qe(l,p,f,g=!0){let b=tn.
get(p)||{},v=H.bind[l](o,p,f,g);v&&(yn(l,p,b[l]=v),tn.set(p,b))}function xn(l,p,f){let g=tn.get(p)||{};for(let b in g)(l==null||b==l)&&(br(b,p,g[b]),delete g[b]);
l==null&&tn.delete(p)}let Ut=0,nn=0,te=0,O=0,we=0,Fe=0,kn=we,on=Fe,Ct=te,sn=O,at=0,gt=0,st=0,St=0;o.bbox={};let Cs=!1,Eo=!1,Sn=!1,rn=!1,_o=!1,yt=!1;function Ls(l,p,f){
(f||l!=o.width||p!=o.height)&&Kr(l,p),An(!1),Sn=!0,Eo=!0,Cn()}function Kr(l,p){o.width=Ut=te=l,o.height=nn=O=p,we=Fe=0,Mc(),Tc();let f=o.bbox;at=f.left=fn(we*de,
.5),gt=f.top=fn(Fe*de,.5),st=f.width=fn(te*de,.5),St=f.height=fn(O*de,.5)}let xc=3;function kc(){let l=!1,p=0;for(;!l;){p++;let f=Nc(p),g=Fc(p);l=p==xc||f&&g,l||
(Kr(o.width,o.height),Eo=!0)}}function Sc({width:l,height:p}){Ls(l,p)}o.setSize=Sc;function Mc(){let l=!1,p=!1,f=!1,g=!1;_.forEach((b,v)=>{if(b.show&&b._show){let{
side:T,_size:A}=b,L=T%2,F=b.label!=null?b.labelSize:0,$=A+F;$>0&&(L?(te-=$,T==3?(we+=$,g=!0):f=!0):(O-=$,T==0?(Fe+=$,l=!0):p=!0))}}),ln[0]=l,ln[1]=f,ln[2]=p,ln[3]=
g,te-=Vt[1]+Vt[3],we+=Vt[3],O-=Vt[2]+Vt[0],Fe+=Vt[0]}function Tc(){let l=we+te,p=Fe+O,f=we,g=Fe;function b(v,T){switch(v){case 1:return l+=T,l-T;case 2:return p+=
T,p-T;case 3:return f-=T,f+T;case 0:return g-=T,g+T}}_.forEach((v,T)=>{if(v.show&&v._show){let A=v.side;v._pos=b(A,v._size),v.label!=null&&(v._lpos=b(A,v.labelSize))}})}
if(H.dataIdx==null){let l=H.hover,p=l.skip=new Set(l.skip??[]);p.add(void 0);let f=l.prox=ie(l.prox),g=l.bias??=0;H.dataIdx=(b,v,T,A)=>{if(v==0)return T;let L=T,
F=f(b,v,T,A)??ye,$=F>=0&&F<ye,U=C.ori==0?te:O,X=H.left,pe=e[0],le=e[v];if(p.has(le[T])){L=null;let oe=null,J=null,B;if(g==0||g==-1)for(B=T;oe==null&&B-- >0;)p.has(
le[B])||(oe=B);if(g==0||g==1)for(B=T;J==null&&B++<le.length;)p.has(le[B])||(J=B);if(oe!=null||J!=null)if($){let ke=oe==null?-1/0:I(pe[oe],C,U,0),_e=J==null?1/0:
I(pe[J],C,U,0),Be=X-ke,fe=_e-X;Be<=fe?Be<=F&&(L=oe):fe<=F&&(L=J)}else L=J==null?oe:oe==null?J:T-oe<=J-T?oe:J}else $&&Ie(X-I(pe[T],C,U,0))>F&&(L=null);return L}}
let an=l=>{H.event=l};H.idxs=ue,H._lock=!1;let Ze=H.points;Ze.show=ie(Ze.show),Ze.size=ie(Ze.size),Ze.stroke=ie(Ze.stroke),Ze.width=ie(Ze.width),Ze.fill=ie(Ze.fill);
let Lt=o.focus=Re({},t.focus||{alpha:.3},H.focus),Mn=Lt.prox>=0,Tn=Mn&&Ze.one,bt=[],Pn=[],En=[];function Yr(l,p){let f=Ze.show(o,p);if(f instanceof HTMLElement)
return dt(f,Iu),dt(f,l.class),It(f,-10,-10,te,O),y.insertBefore(f,bt[p]),f}function Jr(l,p){if(s==1||p>0){let f=s==1&&E[l.scale].time,g=l.value;l.value=f?wa(g)?
Pa(Q,Ta(g,z)):g||re:g||Zp,l.label=l.label||(f?Hp:zp)}if(Tn||p>0){l.width=l.width==null?1:l.width,l.paths=l.paths||pd||tp,l.fillTo=ie(l.fillTo||nd),l.pxAlign=+ce(
l.pxAlign,S),l.pxRound=Fa(l.pxAlign),l.stroke=ie(l.stroke||null),l.fill=ie(l.fill||null),l._stroke=l._fill=l._paths=l._focus=null;let f=Qp(nt(1,l.width),1),g=l.
points=Re({},{size:f,width:nt(1,f*.2),stroke:l.stroke,space:f*2,paths:dd,_stroke:null,_fill:null},l.points);g.show=ie(g.show),g.filter=ie(g.filter),g.fill=ie(g.
fill),g.stroke=ie(g.stroke),g.paths=ie(g.paths),g.pxAlign=l.pxAlign}if(Ee){let f=Po(l,p);Te.splice(p,0,f[0]),it.splice(p,0,f[1]),ee.values.push(null)}if(Ue){ue.
splice(p,0,null);let f=null;Tn?p==0&&(f=Yr(l,p)):p>0&&(f=Yr(l,p)),bt.splice(p,0,f),Pn.splice(p,0,0),En.splice(p,0,0)}Ve("addSeries",p)}function Pc(l,p){p=p??M.length,
l=s==1?Mr(l,p,_a,Ra):Mr(l,p,{},Da),M.splice(p,0,l),Jr(M[p],p)}o.addSeries=Pc;function Ec(l){if(M.splice(l,1),Ee){ee.values.splice(l,1),it.splice(l,1);let p=Te.splice(
l,1)[0];xn(null,p.firstChild),p.remove()}Ue&&(ue.splice(l,1),bt.splice(l,1)[0].remove(),Pn.splice(l,1),En.splice(l,1)),Ve("delSeries",l)}o.delSeries=Ec;let ln=[
!1,!1,!1,!1];function _c(l,p){if(l._show=l.show,l.show){let f=l.side%2,g=E[l.scale];g==null&&(l.scale=f?M[1].scale:D,g=E[l.scale]);let b=g.time;l.size=ie(l.size),
l.space=ie(l.space),l.rotate=ie(l.rotate),Qt(l.incrs)&&l.incrs.forEach(T=>{!Xt.has(T)&&Xt.set(T,Ka(T))}),l.incrs=ie(l.incrs||(g.distr==2?Sp:b?P==1?Tp:_p:mn)),l.
splits=ie(l.splits||(b&&g.distr==1?Je:g.distr==3?vr:g.distr==4?jp:Bp)),l.stroke=ie(l.stroke),l.grid.stroke=ie(l.grid.stroke),l.ticks.stroke=ie(l.ticks.stroke),l.
border.stroke=ie(l.border.stroke);let v=l.values;l.values=Qt(v)&&!Qt(v[0])?ie(v):b?Qt(v)?Ma(Q,Sa(v,z)):wa(v)?Lp(Q,v):v||me:v||Vp,l.filter=ie(l.filter||(g.distr>=
3&&g.log==10?Yp:g.distr==3&&g.log==2?Jp:ja)),l.font=Ua(l.font),l.labelFont=Ua(l.labelFont),l._size=l.size(o,null,p,0),l._space=l._rotate=l._incrs=l._found=l._splits=
l._values=null,l._size>0&&(ln[p]=!0,l._el=xt(Ru,m))}}function io(l,p,f,g){let[b,v,T,A]=f,L=p%2,F=0;return L==0&&(A||v)&&(F=p==0&&!b||p==2&&!T?$e(Ea.size/3):0),L==
1&&(b||T)&&(F=p==1&&!v||p==3&&!A?$e(Ca.size/2):0),F}let Zr=o.padding=(t.padding||[io,io,io,io]).map(l=>ie(ce(l,io))),Vt=o._padding=Zr.map((l,p)=>l(o,p,ln,0)),qe,
Ge=null,We=null,Ao=s==1?M[0].idxs:null,Mt=null,ao=!1;function Qr(l,p){if(e=l??[],o.data=o._data=e,s==2){qe=0;for(let f=1;f<M.length;f++)qe+=e[f][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),Mt=e[0],qe=Mt.length;let f=e;if(Z==2){f=e.slice();let g=f[0]=Array(qe);for(let b=0;b<qe;b++)g[b]=b}o._data=e=f}if(An(!0),Ve(
"setData"),Z==2&&(Sn=!0),p!==!1){let f=C;f.auto(o,ao)?Ds():jt(D,f.min,f.max),rn=rn||H.left>=0,yt=!0,Cn()}}o.setData=Qr;function Ds(){ao=!0;let l,p;s==1&&(qe>0?(Ge=
Ao[0]=0,We=Ao[1]=qe-1,l=e[0][Ge],p=e[0][We],Z==2?(l=Ge,p=We):l==p&&(Z==3?[l,p]=rs(l,l,C.log,!1):Z==4?[l,p]=_r(l,l,C.log,!1):C.time?p=l+$e(86400/P):[l,p]=ns(l,p,
Ar,!0))):(Ge=Ao[0]=l=null,We=Ao[1]=p=null)),jt(D,l,p)}let Co,_n,Rs,Ns,Fs,$s,Is,Os,Us,rt;function Xr(l,p,f,g,b,v){l??=na,f??=Lr,g??="butt",b??=na,v??="round",l!=
Co&&(d.strokeStyle=Co=l),b!=_n&&(d.fillStyle=_n=b),p!=Rs&&(d.lineWidth=Rs=p),v!=Fs&&(d.lineJoin=Fs=v),g!=$s&&(d.lineCap=$s=g),f!=Ns&&d.setLineDash(Ns=f)}function ei(l,p,f,g){
p!=_n&&(d.fillStyle=_n=p),l!=Is&&(d.font=Is=l),f!=Os&&(d.textAlign=Os=f),g!=Us&&(d.textBaseline=Us=g)}function Gs(l,p,f,g,b=0){if(g.length>0&&l.auto(o,ao)&&(p==
null||p.min==null)){let v=ce(Ge,0),T=ce(We,g.length-1),A=f.min==null?Yu(g,v,T,b,l.distr==3):[f.min,f.max];l.min=At(l.min,f.min=A[0]),l.max=nt(l.max,f.max=A[1])}}
let ti={min:null,max:null};function Ac(){for(let g in E){let b=E[g];W[g]==null&&(b.min==null||W[D]!=null&&b.auto(o,ao))&&(W[g]=ti)}for(let g in E){let b=E[g];W[g]==
null&&b.from!=null&&W[b.from]!=null&&(W[g]=ti)}W[D]!=null&&An(!0);let l={};for(let g in W){let b=W[g];if(b!=null){let v=l[g]=Xn(E[g],sp);if(b.min!=null)Re(v,b);else if(g!=
D||s==2)if(qe==0&&v.from==null){let T=v.range(o,null,null,g);v.min=T[0],v.max=T[1]}else v.min=ye,v.max=-ye}}if(qe>0){M.forEach((g,b)=>{if(s==1){let v=g.scale,T=W[v];
if(T==null)return;let A=l[v];if(b==0){let L=A.range(o,A.min,A.max,v);A.min=L[0],A.max=L[1],Ge=_t(A.min,e[0]),We=_t(A.max,e[0]),We-Ge>1&&(e[0][Ge]<A.min&&Ge++,e[0][We]>
A.max&&We--),g.min=Mt[Ge],g.max=Mt[We]}else g.show&&g.auto&&Gs(A,T,g,e[b],g.sorted);g.idxs[0]=Ge,g.idxs[1]=We}else if(b>0&&g.show&&g.auto){let[v,T]=g.facets,A=v.
scale,L=T.scale,[F,$]=e[b],U=l[A],X=l[L];U!=null&&Gs(U,W[A],v,F,v.sorted),X!=null&&Gs(X,W[L],T,$,T.sorted),g.min=T.min,g.max=T.max}});for(let g in l){let b=l[g],
v=W[g];if(b.from==null&&(v==null||v.min==null)){let T=b.range(o,b.min==ye?null:b.min,b.max==-ye?null:b.max,g);b.min=T[0],b.max=T[1]}}}for(let g in l){let b=l[g];
if(b.from!=null){let v=l[b.from];if(v.min==null)b.min=b.max=null;else{let T=b.range(o,v.min,v.max,g);b.min=T[0],b.max=T[1]}}}let p={},f=!1;for(let g in l){let b=l[g],
v=E[g];if(v.min!=b.min||v.max!=b.max){v.min=b.min,v.max=b.max;let T=v.distr;v._min=T==3?zt(v.min):T==4?pr(v.min,v.asinh):T==100?v.fwd(v.min):v.min,v._max=T==3?zt(
v.max):T==4?pr(v.max,v.asinh):T==100?v.fwd(v.max):v.max,p[g]=f=!0}}if(f){M.forEach((g,b)=>{s==2?b>0&&p.y&&(g._paths=null):p[g.scale]&&(g._paths=null)});for(let g in p)
Sn=!0,Ve("setScale",g);Ue&&H.left>=0&&(rn=yt=!0)}for(let g in W)W[g]=null}function Cc(l){let p=wr(Ge-1,0,qe-1),f=wr(We+1,0,qe-1);for(;l[p]==null&&p>0;)p--;for(;l[f]==
null&&f<qe-1;)f++;return[p,f]}function Lc(){if(qe>0){let l=M.some(p=>p._focus)&&rt!=Lt.alpha;l&&(d.globalAlpha=rt=Lt.alpha),M.forEach((p,f)=>{if(f>0&&p.show&&(ni(
f,!1),ni(f,!0),p._paths==null)){let g=rt;rt!=p.alpha&&(d.globalAlpha=rt=p.alpha);let b=s==2?[0,e[f][0].length-1]:Cc(e[f]);p._paths=p.paths(o,f,b[0],b[1]),rt!=g&&
(d.globalAlpha=rt=g)}}),M.forEach((p,f)=>{if(f>0&&p.show){let g=rt;rt!=p.alpha&&(d.globalAlpha=rt=p.alpha),p._paths!=null&&oi(f,!1);{let b=p._paths!=null?p._paths.
gaps:null,v=p.points.show(o,f,Ge,We,b),T=p.points.filter(o,f,v,b);(v||T)&&(p.points._paths=p.points.paths(o,f,Ge,We,T),oi(f,!0))}rt!=g&&(d.globalAlpha=rt=g),Ve(
"drawSeries",f)}}),l&&(d.globalAlpha=rt=1)}}function ni(l,p){let f=p?M[l].points:M[l];f._stroke=f.stroke(o,l),f._fill=f.fill(o,l)}function oi(l,p){let f=p?M[l].
points:M[l],{stroke:g,fill:b,clip:v,flags:T,_stroke:A=f._stroke,_fill:L=f._fill,_width:F=f.width}=f._paths;F=be(F*de,3);let $=null,U=F%2/2;p&&L==null&&(L=F>0?"#\
fff":A);let X=f.pxAlign==1&&U>0;if(X&&d.translate(U,U),!p){let pe=at-F/2,le=gt-F/2,oe=st+F,J=St+F;$=new Path2D,$.rect(pe,le,oe,J)}p?Ws(A,F,f.dash,f.cap,L,g,b,T,
v):Dc(l,A,F,f.dash,f.cap,L,g,b,T,$,v),X&&d.translate(-U,-U)}function Dc(l,p,f,g,b,v,T,A,L,F,$){let U=!1;L!=0&&q.forEach((X,pe)=>{if(X.series[0]==l){let le=M[X.series[1]],
oe=e[X.series[1]],J=(le._paths||Mo).band;Qt(J)&&(J=X.dir==1?J[0]:J[1]);let B,ke=null;le.show&&J&&Zu(oe,Ge,We)?(ke=X.fill(o,pe)||v,B=le._paths.clip):J=null,Ws(p,
f,g,b,ke,T,A,L,F,$,B,J),U=!0}}),U||Ws(p,f,g,b,v,T,A,L,F,$)}let si=eo|kr;function Ws(l,p,f,g,b,v,T,A,L,F,$,U){Xr(l,p,f,g,b),(L||F||U)&&(d.save(),L&&d.clip(L),F&&
d.clip(F)),U?(A&si)==si?(d.clip(U),$&&d.clip($),Do(b,T),Lo(l,v,p)):A&kr?(Do(b,T),d.clip(U),Lo(l,v,p)):A&eo&&(d.save(),d.clip(U),$&&d.clip($),Do(b,T),d.restore(),
Lo(l,v,p)):(Do(b,T),Lo(l,v,p)),(L||F||U)&&d.restore()}function Lo(l,p,f){f>0&&(p instanceof Map?p.forEach((g,b)=>{d.strokeStyle=Co=b,d.stroke(g)}):p!=null&&l&&d.
stroke(p))}function Do(l,p){p instanceof Map?p.forEach((f,g)=>{d.fillStyle=_n=g,d.fill(f)}):p!=null&&l&&d.fill(p)}function Rc(l,p,f,g){let b=_[l],v;if(g<=0)v=[0,
0];else{let T=b._space=b.space(o,l,p,f,g),A=b._incrs=b.incrs(o,l,p,f,g,T);v=bd(p,f,A,g,T)}return b._found=v}function zs(l,p,f,g,b,v,T,A,L,F){let $=T%2/2;S==1&&d.
translate($,$),Xr(A,T,L,F,A),d.beginPath();let U,X,pe,le,oe=b+(g==0||g==3?-v:v);f==0?(X=b,le=oe):(U=b,pe=oe);for(let J=0;J<l.length;J++)p[J]!=null&&(f==0?U=pe=l[J]:
X=le=l[J],d.moveTo(U,X),d.lineTo(pe,le));d.stroke(),S==1&&d.translate(-$,-$)}function Nc(l){let p=!0;return _.forEach((f,g)=>{if(!f.show)return;let b=E[f.scale];
if(b.min==null){f._show&&(p=!1,f._show=!1,An(!1));return}else f._show||(p=!1,f._show=!0,An(!1));let v=f.side,T=v%2,{min:A,max:L}=b,[F,$]=Rc(g,A,L,T==0?te:O);if($==
0)return;let U=b.distr==2,X=f._splits=f.splits(o,g,A,L,F,$,U),pe=b.distr==2?X.map(B=>Mt[B]):X,le=b.distr==2?Mt[X[1]]-Mt[X[0]]:F,oe=f._values=f.values(o,f.filter(
o,pe,g,$,le),g,$,le);f._rotate=v==2?f.rotate(o,oe,g,$):0;let J=f._size;f._size=kt(f.size(o,oe,g,l)),J!=null&&f._size!=J&&(p=!1)}),p}function Fc(l){let p=!0;return Zr.
forEach((f,g)=>{let b=f(o,g,ln,l);b!=Vt[g]&&(p=!1),Vt[g]=b}),p}function $c(){for(let l=0;l<_.length;l++){let p=_[l];if(!p.show||!p._show)continue;let f=p.side,g=f%
2,b,v,T=p.stroke(o,l),A=f==0||f==3?-1:1,[L,F]=p._found;if(p.label!=null){let et=p.labelGap*A,ut=$e((p._lpos+et)*de);ei(p.labelFont[0],T,"center",f==2?"top":ta),
d.save(),g==1?(b=v=0,d.translate(ut,$e(gt+St/2)),d.rotate((f==3?-es:es)/2)):(b=$e(at+st/2),v=ut);let pn=Va(p.label)?p.label(o,l,L,F):p.label;d.fillText(pn,b,v),
d.restore()}if(F==0)continue;let $=E[p.scale],U=g==0?st:St,X=g==0?at:gt,pe=p._splits,le=$.distr==2?pe.map(et=>Mt[et]):pe,oe=$.distr==2?Mt[pe[1]]-Mt[pe[0]]:L,J=p.
ticks,B=p.border,ke=J.show?J.size:0,_e=$e(ke*de),Be=$e((p.alignTo==2?p._size-ke-p.gap:p.gap)*de),fe=p._rotate*-es/180,Ae=k(p._pos*de),lt=(_e+Be)*A,Xe=Ae+lt;v=g==
0?Xe:0,b=g==1?Xe:0;let wt=p.font[0],Tt=p.align==1?Kn:p.align==2?lr:fe>0?Kn:fe<0?lr:g==0?"center":f==3?lr:Kn,Nt=fe||g==1?"middle":f==2?"top":ta;ei(wt,T,Tt,Nt);let ct=p.
font[1]*p.lineGap,vt=pe.map(et=>k(a(et,$,U,X))),Pt=p._values;for(let et=0;et<Pt.length;et++){let ut=Pt[et];if(ut!=null){g==0?b=vt[et]:v=vt[et],ut=""+ut;let pn=ut.
indexOf(`
`)==-1?[ut]:ut.split(/\n/gm);for(let tt=0;tt<pn.length;tt++){let Si=pn[tt];fe?(d.save(),d.translate(b,v+tt*ct),d.rotate(fe),d.fillText(Si,0,0),d.restore()):d.fillText(
Si,b,v+tt*ct)}}}J.show&&zs(vt,J.filter(o,le,l,F,oe),g,f,Ae,_e,be(J.width*de,3),J.stroke(o,l),J.dash,J.cap);let Ft=p.grid;Ft.show&&zs(vt,Ft.filter(o,le,l,F,oe),g,
g==0?2:1,g==0?gt:at,g==0?St:st,be(Ft.width*de,3),Ft.stroke(o,l),Ft.dash,Ft.cap),B.show&&zs([Ae],[1],g==0?1:0,g==0?1:2,g==1?gt:at,g==1?St:st,be(B.width*de,3),B.stroke(
o,l),B.dash,B.cap)}Ve("drawAxes")}function An(l){M.forEach((p,f)=>{f>0&&(p._paths=null,l&&(s==1?(p.min=null,p.max=null):p.facets.forEach(g=>{g.min=null,g.max=null})))})}
let Ro=!1,Hs=!1,lo=[];function Ic(){Hs=!1;for(let l=0;l<lo.length;l++)Ve(...lo[l]);lo.length=0}function Cn(){Ro||(pp(ri),Ro=!0)}function Oc(l,p=!1){Ro=!0,Hs=p,l(
o),ri(),p&&lo.length>0&&queueMicrotask(Ic)}o.batch=Oc;function ri(){if(Cs&&(Ac(),Cs=!1),Sn&&(kc(),Sn=!1),Eo){if(Me(w,Kn,we),Me(w,"top",Fe),Me(w,vo,te),Me(w,xo,O),
Me(y,Kn,we),Me(y,"top",Fe),Me(y,vo,te),Me(y,xo,O),Me(m,vo,Ut),Me(m,xo,nn),h.width=$e(Ut*de),h.height=$e(nn*de),_.forEach(({_el:l,_show:p,_size:f,_pos:g,side:b})=>{
if(l!=null)if(p){let v=b===3||b===0?f:0,T=b%2==1;Me(l,T?"left":"top",g-v),Me(l,T?"width":"height",f),Me(l,T?"top":"left",T?Fe:we),Me(l,T?"height":"width",T?O:te),
yr(l,gn)}else dt(l,gn)}),Co=_n=Rs=Fs=$s=Is=Os=Us=Ns=null,rt=1,po(!0),we!=kn||Fe!=on||te!=Ct||O!=sn){An(!1);let l=te/Ct,p=O/sn;if(Ue&&!rn&&H.left>=0){H.left*=l,H.
top*=p,Ln&&It(Ln,$e(H.left),0,te,O),Dn&&It(Dn,0,$e(H.top),te,O);for(let f=0;f<bt.length;f++){let g=bt[f];g!=null&&(Pn[f]*=l,En[f]*=p,It(g,kt(Pn[f]),kt(En[f]),te,
O))}}if(xe.show&&!_o&&xe.left>=0&&xe.width>0){xe.left*=l,xe.width*=l,xe.top*=p,xe.height*=p;for(let f in Ys)Me(Fn,f,xe[f])}kn=we,on=Fe,Ct=te,sn=O}Ve("setSize"),
Eo=!1}Ut>0&&nn>0&&(d.clearRect(0,0,h.width,h.height),Ve("drawClear"),V.forEach(l=>l()),Ve("draw")),xe.show&&_o&&(No(xe),_o=!1),Ue&&rn&&(un(null,!0,!1),rn=!1),ee.
show&&ee.live&&yt&&(qs(),yt=!1),c||(c=!0,o.status=1,Ve("ready")),ao=!1,Ro=!1}o.redraw=(l,p)=>{Sn=p||!1,l!==!1?jt(D,C.min,C.max):Cn()};function Vs(l,p){let f=E[l];
if(f.from==null){if(qe==0){let g=f.range(o,p.min,p.max,l);p.min=g[0],p.max=g[1]}if(p.min>p.max){let g=p.min;p.min=p.max,p.max=g}if(qe>1&&p.min!=null&&p.max!=null&&
p.max-p.min<1e-16)return;l==D&&f.distr==2&&qe>0&&(p.min=_t(p.min,e[0]),p.max=_t(p.max,e[0]),p.min==p.max&&p.max++),W[l]=p,Cs=!0,Cn()}}o.setScale=Vs;let Bs,js,Ln,
Dn,ii,ai,Rn,Nn,li,ci,ve,Pe,Bt=!1,Ke=H.drag,ze=Ke.x,He=Ke.y;Ue&&(H.x&&(Bs=xt(Fu,y)),H.y&&(js=xt($u,y)),C.ori==0?(Ln=Bs,Dn=js):(Ln=js,Dn=Bs),ve=H.left,Pe=H.top);let xe=o.
select=Re({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Fn=xe.show?xt(Nu,xe.over?y:w):null;function No(l,p){if(xe.show){for(let f in l)xe[f]=l[f],f in
Ys&&Me(Fn,f,l[f]);p!==!1&&Ve("setSelect")}}o.setSelect=No;function Uc(l){if(M[l].show)Ee&&yr(Te[l],gn);else if(Ee&&dt(Te[l],gn),Ue){let f=Tn?bt[0]:bt[l];f!=null&&
It(f,-10,-10,te,O)}}function jt(l,p,f){Vs(l,{min:p,max:f})}function Dt(l,p,f,g){p.focus!=null&&Vc(l),p.show!=null&&M.forEach((b,v)=>{v>0&&(l==v||l==null)&&(b.show=
p.show,Uc(v),s==2?(jt(b.facets[0].scale,null,null),jt(b.facets[1].scale,null,null)):jt(b.scale,null,null),Cn())}),f!==!1&&Ve("setSeries",l,p),g&&ho("setSeries",
o,l,p)}o.setSeries=Dt;function Gc(l,p){Re(q[l],p)}function Wc(l,p){l.fill=ie(l.fill||null),l.dir=ce(l.dir,-1),p=p??q.length,q.splice(p,0,l)}function zc(l){l==null?
q.length=0:q.splice(l,1)}o.addBand=Wc,o.setBand=Gc,o.delBand=zc;function Hc(l,p){M[l].alpha=p,Ue&&bt[l]!=null&&(bt[l].style.opacity=p),Ee&&Te[l]&&(Te[l].style.opacity=
p)}let Gt,qt,cn,$n={focus:!0};function Vc(l){if(l!=cn){let p=l==null,f=Lt.alpha!=1;M.forEach((g,b)=>{if(s==1||b>0){let v=p||b==0||b==l;g._focus=p?null:v,f&&Hc(b,
v?1:Lt.alpha)}}),cn=l,f&&Cn()}}Ee&&Mn&&Qe(ra,ae,l=>{H._lock||(an(l),cn!=null&&Dt(null,$n,!0,Le.setSeries))});function Rt(l,p,f){let g=E[p];f&&(l=l/de-(g.ori==1?
Fe:we));let b=te;g.ori==1&&(b=O,l=b-l),g.dir==-1&&(l=b-l);let v=g._min,T=g._max,A=l/b,L=v+(T-v)*A,F=g.distr;return F==3?Zn(10,L):F==4?Xu(L,g.asinh):F==100?g.bwd(
L):L}function Bc(l,p){let f=Rt(l,D,p);return _t(f,e[0],Ge,We)}o.valToIdx=l=>_t(l,e[0]),o.posToIdx=Bc,o.posToVal=Rt,o.valToPos=(l,p,f)=>E[p].ori==0?r(l,E[p],f?st:
te,f?at:0):i(l,E[p],f?St:O,f?gt:0),o.setCursor=(l,p,f)=>{ve=l.left,Pe=l.top,un(null,p,f)};function ui(l,p){Me(Fn,Kn,xe.left=l),Me(Fn,vo,xe.width=p)}function pi(l,p){
Me(Fn,"top",xe.top=l),Me(Fn,xo,xe.height=p)}let co=C.ori==0?ui:pi,uo=C.ori==1?ui:pi;function jc(){if(Ee&&ee.live)for(let l=s==2?1:0;l<M.length;l++){if(l==0&&ne)
continue;let p=ee.values[l],f=0;for(let g in p)it[l][f++].firstChild.nodeValue=p[g]}}function qs(l,p){if(l!=null&&(l.idxs?l.idxs.forEach((f,g)=>{ue[g]=f}):op(l.
idx)||ue.fill(l.idx),ee.idx=ue[0]),Ee&&ee.live){for(let f=0;f<M.length;f++)(f>0||s==1&&!ne)&&qc(f,ue[f]);jc()}yt=!1,p!==!1&&Ve("setLegend")}o.setLegend=qs;function qc(l,p){
let f=M[l],g=l==0&&Z==2?Mt:e[l],b;ne?b=f.values(o,l,p)??Ne:(b=f.value(o,p==null?null:g[p],l,p),b=b==null?Ne:{_:b}),ee.values[l]=b}function un(l,p,f){li=ve,ci=Pe,
[ve,Pe]=H.move(o,ve,Pe),H.left=ve,H.top=Pe,Ue&&(Ln&&It(Ln,$e(ve),0,te,O),Dn&&It(Dn,0,$e(Pe),te,O));let g,b=Ge>We;Gt=ye,qt=null;let v=C.ori==0?te:O,T=C.ori==1?te:
O;if(ve<0||qe==0||b){g=H.idx=null;for(let A=0;A<M.length;A++){let L=bt[A];L!=null&&It(L,-10,-10,te,O)}Mn&&Dt(null,$n,!0,l==null&&Le.setSeries),ee.live&&(ue.fill(
g),yt=!0)}else{let A,L,F;s==1&&(A=C.ori==0?ve:Pe,L=Rt(A,D),g=H.idx=_t(L,e[0],Ge,We),F=I(e[0][g],C,v,0));let $=-10,U=-10,X=0,pe=0,le=!0,oe="",J="";for(let B=s==2?
1:0;B<M.length;B++){let ke=M[B],_e=ue[B],Be=_e==null?null:s==1?e[B][_e]:e[B][1][_e],fe=H.dataIdx(o,B,g,L),Ae=fe==null?null:s==1?e[B][fe]:e[B][1][fe];if(yt=yt||Ae!=
Be||fe!=_e,ue[B]=fe,B>0&&ke.show){let lt=fe==null?-10:fe==g?F:I(s==1?e[0][fe]:e[B][0][fe],C,v,0),Xe=Ae==null?-10:j(Ae,s==1?E[ke.scale]:E[ke.facets[1].scale],T,0);
if(Mn&&Ae!=null){let wt=C.ori==1?ve:Pe,Tt=Ie(Lt.dist(o,B,fe,Xe,wt));if(Tt<Gt){let Nt=Lt.bias;if(Nt!=0){let ct=Rt(wt,ke.scale),vt=Ae>=0?1:-1,Pt=ct>=0?1:-1;Pt==vt&&
(Pt==1?Nt==1?Ae>=ct:Ae<=ct:Nt==1?Ae<=ct:Ae>=ct)&&(Gt=Tt,qt=B)}else Gt=Tt,qt=B}}if(yt||Tn){let wt,Tt;C.ori==0?(wt=lt,Tt=Xe):(wt=Xe,Tt=lt);let Nt,ct,vt,Pt,Ft,et,ut=!0,
pn=Ze.bbox;if(pn!=null){ut=!1;let tt=pn(o,B);vt=tt.left,Pt=tt.top,Nt=tt.width,ct=tt.height}else vt=wt,Pt=Tt,Nt=ct=Ze.size(o,B);if(et=Ze.fill(o,B),Ft=Ze.stroke(o,
B),Tn)B==qt&&Gt<=Lt.prox&&($=vt,U=Pt,X=Nt,pe=ct,le=ut,oe=et,J=Ft);else{let tt=bt[B];tt!=null&&(Pn[B]=vt,En[B]=Pt,da(tt,Nt,ct,ut),ua(tt,et,Ft),It(tt,kt(vt),kt(Pt),
te,O))}}}}if(Tn){let B=Lt.prox,ke=cn==null?Gt<=B:Gt>B||qt!=cn;if(yt||ke){let _e=bt[0];_e!=null&&(Pn[0]=$,En[0]=U,da(_e,X,pe,le),ua(_e,oe,J),It(_e,kt($),kt(U),te,
O))}}}if(xe.show&&Bt)if(l!=null){let[A,L]=Le.scales,[F,$]=Le.match,[U,X]=l.cursor.sync.scales,pe=l.cursor.drag;if(ze=pe._x,He=pe._y,ze||He){let{left:le,top:oe,width:J,
height:B}=l.select,ke=l.scales[U].ori,_e=l.posToVal,Be,fe,Ae,lt,Xe,wt=A!=null&&F(A,U),Tt=L!=null&&$(L,X);wt&&ze?(ke==0?(Be=le,fe=J):(Be=oe,fe=B),Ae=E[A],lt=I(_e(
Be,U),Ae,v,0),Xe=I(_e(Be+fe,U),Ae,v,0),co(At(lt,Xe),Ie(Xe-lt))):co(0,v),Tt&&He?(ke==1?(Be=le,fe=J):(Be=oe,fe=B),Ae=E[L],lt=j(_e(Be,X),Ae,T,0),Xe=j(_e(Be+fe,X),Ae,
T,0),uo(At(lt,Xe),Ie(Xe-lt))):uo(0,T)}else Js()}else{let A=Ie(li-ii),L=Ie(ci-ai);if(C.ori==1){let X=A;A=L,L=X}ze=Ke.x&&A>=Ke.dist,He=Ke.y&&L>=Ke.dist;let F=Ke.uni;
F!=null?ze&&He&&(ze=A>=F,He=L>=F,!ze&&!He&&(L>A?He=!0:ze=!0)):Ke.x&&Ke.y&&(ze||He)&&(ze=He=!0);let $,U;ze&&(C.ori==0?($=Rn,U=ve):($=Nn,U=Pe),co(At($,U),Ie(U-$)),
He||uo(0,T)),He&&(C.ori==1?($=Rn,U=ve):($=Nn,U=Pe),uo(At($,U),Ie(U-$)),ze||co(0,v)),!ze&&!He&&(co(0,0),uo(0,0))}if(Ke._x=ze,Ke._y=He,l==null){if(f){if(ki!=null){
let[A,L]=Le.scales;Le.values[0]=A!=null?Rt(C.ori==0?ve:Pe,A):null,Le.values[1]=L!=null?Rt(C.ori==1?ve:Pe,L):null}ho(cr,o,ve,Pe,te,O,g)}if(Mn){let A=f&&Le.setSeries,
L=Lt.prox;cn==null?Gt<=L&&Dt(qt,$n,!0,A):Gt>L?Dt(null,$n,!0,A):qt!=cn&&Dt(qt,$n,!0,A)}}yt&&(ee.idx=g,qs()),p!==!1&&Ve("setCursor")}let Kt=null;Object.defineProperty(
o,"rect",{get(){return Kt==null&&po(!1),Kt}});function po(l=!1){l?Kt=null:(Kt=y.getBoundingClientRect(),Ve("syncRect",Kt))}function di(l,p,f,g,b,v,T){H._lock||Bt&&
l!=null&&l.movementX==0&&l.movementY==0||(Ks(l,p,f,g,b,v,T,!1,l!=null),l!=null?un(null,!0,!0):un(p,!0,!1))}function Ks(l,p,f,g,b,v,T,A,L){if(Kt==null&&po(!1),an(
l),l!=null)f=l.clientX-Kt.left,g=l.clientY-Kt.top;else{if(f<0||g<0){ve=-10,Pe=-10;return}let[F,$]=Le.scales,U=p.cursor.sync,[X,pe]=U.values,[le,oe]=U.scales,[J,
B]=Le.match,ke=p.axes[0].side%2==1,_e=C.ori==0?te:O,Be=C.ori==1?te:O,fe=ke?v:b,Ae=ke?b:v,lt=ke?g:f,Xe=ke?f:g;if(le!=null?f=J(F,le)?a(X,E[F],_e,0):-10:f=_e*(lt/fe),
oe!=null?g=B($,oe)?a(pe,E[$],Be,0):-10:g=Be*(Xe/Ae),C.ori==1){let wt=f;f=g,g=wt}}L&&(p==null||p.cursor.event.type==cr)&&((f<=1||f>=te-1)&&(f=fn(f,te)),(g<=1||g>=
O-1)&&(g=fn(g,O))),A?(ii=f,ai=g,[Rn,Nn]=H.move(o,f,g)):(ve=f,Pe=g)}let Ys={width:0,height:0,left:0,top:0};function Js(){No(Ys,!1)}let hi,fi,mi,gi;function yi(l,p,f,g,b,v,T){
Bt=!0,ze=He=Ke._x=Ke._y=!1,Ks(l,p,f,g,b,v,T,!0,!1),l!=null&&(Qe(ur,mr,bi,!1),ho(oa,o,Rn,Nn,te,O,null));let{left:A,top:L,width:F,height:$}=xe;hi=A,fi=L,mi=F,gi=$}
function bi(l,p,f,g,b,v,T){Bt=Ke._x=Ke._y=!1,Ks(l,p,f,g,b,v,T,!1,!0);let{left:A,top:L,width:F,height:$}=xe,U=F>0||$>0,X=hi!=A||fi!=L||mi!=F||gi!=$;if(U&&X&&No(xe),
Ke.setScale&&U&&X){let pe=A,le=F,oe=L,J=$;if(C.ori==1&&(pe=L,le=$,oe=A,J=F),ze&&jt(D,Rt(pe,D),Rt(pe+le,D)),He)for(let B in E){let ke=E[B];B!=D&&ke.from==null&&ke.
min!=ye&&jt(B,Rt(oe+J,B),Rt(oe,B))}Js()}else H.lock&&(H._lock=!H._lock,un(p,!0,l!=null));l!=null&&(xn(ur,mr),ho(ur,o,ve,Pe,te,O,null))}function Kc(l,p,f,g,b,v,T){
if(H._lock)return;an(l);let A=Bt;if(Bt){let L=!0,F=!0,$=10,U,X;C.ori==0?(U=ze,X=He):(U=He,X=ze),U&&X&&(L=ve<=$||ve>=te-$,F=Pe<=$||Pe>=O-$),U&&L&&(ve=ve<Rn?0:te),
X&&F&&(Pe=Pe<Nn?0:O),un(null,!0,!0),Bt=!1}ve=-10,Pe=-10,ue.fill(null),un(null,!0,!0),A&&(Bt=A)}function wi(l,p,f,g,b,v,T){H._lock||(an(l),Ds(),Js(),l!=null&&ho(
ia,o,ve,Pe,te,O,null))}function vi(){_.forEach(wd),Ls(o.width,o.height,!0)}yn(ts,Jn,vi);let In={};In.mousedown=yi,In.mousemove=di,In.mouseup=bi,In.dblclick=wi,In.
setSeries=(l,p,f,g)=>{let b=Le.match[2];f=b(o,p,f),f!=-1&&Dt(f,g,!0,!1)},Ue&&(Qe(oa,y,yi),Qe(cr,y,di),Qe(sa,y,l=>{an(l),po(!1)}),Qe(ra,y,Kc),Qe(ia,y,wi),Sr.add(
o),o.syncRect=po);let Fo=o.hooks=t.hooks||{};function Ve(l,p,f){Hs?lo.push([l,p,f]):l in Fo&&Fo[l].forEach(g=>{g.call(null,o,p,f)})}(t.plugins||[]).forEach(l=>{
for(let p in l.hooks)Fo[p]=(Fo[p]||[]).concat(l.hooks[p])});let xi=(l,p,f)=>f,Le=Re({key:null,setSeries:!1,filters:{pub:ya,sub:ya},scales:[D,M[1]?M[1].scale:null],
match:[ba,ba,xi],values:[null,null]},H.sync);Le.match.length==2&&Le.match.push(xi),H.sync=Le;let ki=Le.key,Zs=fl(ki);function ho(l,p,f,g,b,v,T){Le.filters.pub(l,
p,f,g,b,v,T)&&Zs.pub(l,p,f,g,b,v,T)}Zs.sub(o);function Yc(l,p,f,g,b,v,T){Le.filters.sub(l,p,f,g,b,v,T)&&In[l](null,p,f,g,b,v,T)}o.pub=Yc;function Jc(){Zs.unsub(
o),Sr.delete(o),tn.clear(),br(ts,Jn,vi),u.remove(),ae?.remove(),Ve("destroy")}o.destroy=Jc;function Qs(){Ve("init",t,e),Qr(e||t.data,!1),W[D]?Vs(D,W[D]):Ds(),_o=
xe.show&&(xe.width>0||xe.height>0),rn=yt=!0,Ls(t.width,t.height)}return M.forEach(Jr),_.forEach(_c),n?n instanceof HTMLElement?(n.appendChild(u),Qs()):n(o,Qs):Qs(),
o}Oe.assign=Re;Oe.fmtNum=Cr;Oe.rangeNum=ns;Oe.rangeLog=rs;Oe.rangeAsinh=_r;Oe.orient=wn;Oe.pxRatio=de;Oe.join=up;Oe.fmtDate=Dr,Oe.tzDate=xp;Oe.sync=fl;{Oe.addGap=
od,Oe.clipGaps=ls;let t=Oe.paths={points:vl};t.linear=kl,t.stepped=id,t.bars=ad,t.spline=cd}var ds=128,Pl=50,vd=.25,xd=t=>[t.ray,t.truth,t.sensor,t.noReturn],kd=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),Sd=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),hs=(t,e)=>({font:tr,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function El(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:ds})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:ds}),s=n()),o)}function _l(t,e){let{session:n}=t,o=x("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All sweeps"],["first",`First ${Pl}`]],()=>s,y=>{s=y,u=null,n.
changed()}),i=0,a=-1/0,c=-1,u=null,d=El(o,()=>{let y=xd(e()),S=Array.from({length:i},(k,P)=>({label:`chain ${P+1}`,stroke:y[P%y.length],width:1,points:{show:!1}}));
return new Oe({width:100,height:ds,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,Sd,0,0],scales:{x:{time:!1,range:(k,P,M)=>[P,Math.max(M,P+1)]},y:{
range:(k,P,M)=>Pd(Math.max(P,a),M)}},axes:[hs(e,26),hs(e,kd)],series:[{label:"sweep"},...S],hooks:{draw:[k=>Ed(k,c,e())]}},[[],...S.map(()=>[])],o)},e),m=x("spa\
n",{className:"caption",textContent:"log joint by sweep"}),w=x("div",{className:"charted"},x("div",{className:"buttons"},r,m),o);return t.each(()=>{let y=n.shown,
S=y?.traced?.length?y.trace.length/y.traced.length:0;if(R(w,"hidden",S===0),!y||!S)return;let k=y.layer==="draw"&&n.draws.count?(n.draw+1)*y.sweeps/n.draws.count:
-1,P=d(S!==i&&(i=S,!0));P&&(u===y&&c===k&&P.data[0].length||([u,c]=[y,k],a=s==="all"?Td(y,S):-1/0,P.setData(Md(y,S,s))))}),w}function Md({trace:t,traced:e},n,o){
let s=o==="all"?e.length:e.filter(r=>r<=Pl).length;return[e.slice(0,s),...Array.from({length:n},(r,i)=>t.slice(i*e.length,i*e.length+s))]}function Td({trace:t,traced:e},n){
let o=e.length,s=e.findIndex(r=>r>=vd*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.min(...t.slice(i*o+s,(i+1)*o))))}function Pd(t,e){let n=Math.
max(.06*(e-t),.5);return[t-n,e+n]}function Ed(t,e,n){if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.save(),t.
ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.restore())}function Al(t,e){let{session:n}=t,o=x("div",{className:"chart",role:"img","aria-label":"Histogra\
m of the particles' weights"}),s=x("div",{className:"caption",textContent:"particles by weight, nats below the heaviest"}),r=x("div",{className:"charted"},s,o),
a=El(o,()=>new Oe({width:100,height:ds,legend:{show:!1},cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(u,h,d)=>[h,d]},y:{distr:3,range:(u,h,d)=>[
.5,Math.max(10,2*d)]}},axes:[hs(e,26),{...hs(e,52),values:(u,h)=>h.map(d=>d>=1?String(d):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Oe.paths.bars?.({size:[
.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),c=null;return t.each(()=>{let u=n.shown;R(r,"hidden",!u?.weights);let h=u?.weights&&a(!1);if(!u?.weights||!h||
c===u&&h.data[0].length)return;c=u;let d=[...u.weights],m=-(u.lowest??-1)/d.length,w=[...d.map((y,S)=>(u.lowest??-1)+S*m),0];h.setData([w,[...d.map(y=>y||null),
null]])}),r}function Cl(t){let{session:e,hand:n}=t,{decisions:o}=e,s=x("p",{className:"said",role:"status"}),r=x("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,u=>o.set({radius:u}),{min:.01,max:100,step:"any"}),t.numberInput("Highest risk",()=>o.risk,u=>o.set({risk:u}),{min:1e-4,max:.99,step:"any"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),c=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{R(c,"textContent",i()),R(s,"textContent",n.tool==="path"?_d(t):Ad(t))}),a}function _d({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${Ce(
o.length_m,2)} m, free with probability ${Ce(o.probability,3)} ± ${Ce(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${Ce(o.independent,
3)}.${r}`}function Ad({session:t}){let{views:e,trouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.nats),
s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${Ce(Math.min(...e.nats),1)} to ${Ce(o,1)} nats, cells taken for independent; \
the best place has a ring.${s}`}var Cd=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Ld=["Draw walls, and drag the robot: a beam reads the first wall that it \
hits, with noise. Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (draw), and where doubt remains\
 (entropy). No beam has been where it is hatched.","While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact\
 in the long run."],Dd="Mouse: the wheel zooms, the middle button pans, Shift or the right button erases, and so does a click on a wall. Touch: two fingers zoom\
 and pan.";function Ll(t){let e=Ii.map(([o,s])=>x("tr",{},x("th",{scope:"row"},x("kbd",{textContent:o})),x("td",{textContent:s}))),n=Ld.map(o=>x("p",{textContent:o}));
return t.dialog("Help",...n,x("table",{},x("tbody",{},...e)),x("p",{textContent:Dd}))}function Dl(t){let e=()=>x("input",{type:"number",min:Se.cells[0],max:Se.cells[1],
step:1,required:!0,value:"21"}),[n,o]=[e(),e()],s=x("select",{});for(let[i,a]of Cd)s.append(x("option",{value:i,textContent:a}));s.addEventListener("change",()=>{
s.value==="building"&&Number(n.value)<60&&([n.value,o.value]=["120","80"])});let r=x("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("H\
eight (cells)",o),x("div",{className:"buttons end"},x("button",{type:"submit",className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{
t.session.act({type:"new",shape:[Number(n.value),Number(o.value)],world:s.value}),t.hand.selected=null}),t.dialog("New map",r)}function Rl(t){let e=x("input",{type:"\
text",readOnly:!0,"aria-label":"Link"}),n=x("span",{role:"status",className:"copied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{
document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},s=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),i=t.
dialog("Share",x("p",{textContent:"The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server r\
uns; the part from # on can be put after the address of any bayesmap page."}),x("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),
e.select()}}}var Nl=t=>Math.round(t*180/Math.PI);function Fl(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(c,u)=>t.numberInput(c,()=>Number((o.pose?.[u]??0).toFixed(2)),h=>o.move(
{[u]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>Nl(o.pose?.yaw??0),c=>o.move({yaw:c*Math.PI/180}),{step:5}),i=x("p",{className:"words ghosted"}),a=t.
section("Ghost",x("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>R(i,"textContent",Rd(t))),
a}function Rd({session:t}){let{ghost:e}=t;if(e.trouble)return e.trouble;if(!e.fan)return"Drag the ghost to see what its laser would read.";let{draws:n,low:o,high:s,
near:r}=e.fan,i=Array.from(s,(h,d)=>h-o[d]).filter(Number.isFinite).sort((h,d)=>h-d),a=i.length?`${Ce(100*i[i.length>>1],0)} cm wide at the median beam`:"as wid\
e as the laser's range",c=n?`${n} draws of the map`:"the mean map, cells taken for independent",u=r?` Rings are the hits of scan ${r.index+1}, taken ${Ce(100*r.
away,0)} cm from here, turned by ${Nl(r.turn)}°.`:"";return`Dots are predictive medians, bars the central 80 % interval, ${a}, by ${c}.${u}`}function $l(t){let{session:e}=t,n=x("span",{className:"what"});t.each(()=>{let{grid:u,source:h}=e.document??{};if(!u||!h)return;let d=`${u.shape[0]} × ${u.shape[1]}\
 cells of ${+u.resolution.toPrecision(3)} m`;R(n,"textContent",h.name?`${h.name}, ${d}`:d)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),x("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),...t.embedded?[]:[t.button("link","Share",()=>t.command(
"share"),{text:"Share",when:o})]];for(let u of s)t.visible(u,()=>!e.recorded);let r=t.button("theme","Theme: automatic",()=>t.command("theme")),i=t.button("help",
"Help",()=>t.command("help"),{title:"Help (?)"}),a=x("span",{className:"space"});return{element:x("header",{},x("h1",{textContent:"bayesmap"}),n,a,...s,Fd(t),r,
i),nameTheme(u){let h=`Theme: ${u}`;pt(r,"aria-label",h),R(r,"title",h)}}}var Nd=({shown:t,draws:e})=>e.count>0||/importance|propagate/.test(t?.method??"");function Fd(t){
let{session:e}=t,n=(a,c,u,h)=>{let d=t.button(null,a,()=>t.command(`export ${c}`),{text:a,when:h});return u&&t.visible(d,()=>!e.recorded),d},o=x("div",{className:"\
menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>Nd(e)),n("Map for robots (YAML and PGM)","map",!0),n("Page with its draws (HTML\
)","html",!0),n("Document (JSON)","document",!0)),s=t.button("save","Export",()=>r(o.hidden),{text:"Export",when:()=>!!e.document}),r=a=>{o.hidden=!a,s.setAttribute(
"aria-expanded",String(a)),a&&o.firstElementChild.focus()};r(!1);let i=x("div",{className:"anchor"},s,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||
o.hidden||(r(!1),s.focus(),a.stopPropagation())}),i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||r(!1)}),o.addEventListener("click",()=>{r(!1),s.
focus()}),i}var $d={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 1\
1h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.\
5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7\
.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.\
5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function en(t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg"),n=document.createElementNS(
"http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true"),n.setAttribute("d",$d[t]),e.append(n),e}var fs=[["truth","true wall"],["ray","ray"],["miss","no return"],["dot","reading"],["sensor","sensor"],["stroke","surface"],["trajectory","trajectory"],["draw",
"this draw"],["ghost","predicted reading"],["unobserved","unobserved"]];function Il(t,e){let{session:n}=t,o=x("span",{className:"ramp"}),s=x("span"),r=fs.map(([
c,u])=>{let h=x("i",{className:c});return c==="sensor"&&h.append(en("sensor")),x("li",{},h,u)});t.visible(r[0],()=>!n.document||n.document.source.kind==="simula\
tion"),t.visible(r[fs.findIndex(([c])=>c==="stroke")],()=>!!n.overlay?.strokes.length),t.visible(r[fs.findIndex(([c])=>c==="trajectory")],()=>!!n.overlay?.trajectory.
length);let i=c=>r[fs.findIndex(([u])=>u===c)];t.visible(i("draw"),()=>!!n.flicker.under),t.visible(i("ghost"),()=>n.ghost.held||n.reading.picked!==null);let a="";
return t.each(()=>{let c=n.shown?.layer==="width"?"width":n.view.layer,{kind:u,mean:h,value:d}=n.quantity;R(s,"textContent",c==="entropy"?"entropy (bit)":c==="w\
idth"?"width of the 90 % interval":u==="binary"?"P(wall)":c==="draw"?d:h);let w=c==="entropy"||c==="width",y=`${w} ${e().ground}`;a!==y&&(a=y,o.style.background=
ji(w?yo:S=>sr(e(),S)))}),x("ul",{className:"legend","aria-label":"Legend"},x("li",{},s,"0",o,"1"),...r)}var Id=[.05,.1,.2,.4,.8],Od=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function Ol(t){let{session:e}=t,n=x("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,c]=i.bounds,u=Math.
max(c[0]-a[0],c[1]-a[1]),h=[...new Set([...Id,r.resolution])].sort((d,m)=>d-m);if(o!==h.join()){o=h.join();let d=m=>x("option",{value:String(m),textContent:Od(m),
disabled:u/m>Se.side_of_log-1});n.replaceChildren(...h.map(d))}R(n,"value",String(r.resolution))});let s=t.row("Cell size",n);return t.visible(s,()=>e.document?.
source.kind==="log"),s}function Ul(t){let{session:e}=t,n=x("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),o=x("output"),s=()=>e.document?.source.
scans??0,r=a=>{let c=Number(n.value);t.scrub(c>=s()?null:c,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});let i=t.
section("Log",x("div",{className:"player bare"},n,o));return t.visible(i,()=>e.document?.source.kind==="log"&&s()>1),t.each(()=>{let a=s(),c=e.document?.scans_used??
a;R(n,"max",String(Math.max(1,a))),(!hn(n)||Number(n.value)!==c)&&R(n,"value",String(c));let u=c===a?`all ${a} scans`:`after ${c} of ${a}`;n.style.setProperty("\
--fill",`${100*(c-1)/Math.max(1,a-1)}%`),pt(n,"aria-valuetext",u),R(o,"textContent",u)}),i}var Ud="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.";function zl(t){
let{session:e}=t,n=x("span",{className:"chip"}),o=t.button(null,"Not converged",()=>Gl(e)?.apply(),{text:"Not converged",className:"chip doubt"}),s=x("div",{className:"\
chips"},n,o);return t.each(()=>{let r=Gl(e);R(o,"hidden",!r),r&&(R(o.firstElementChild,"textContent",`not converged: ${r.text}`),R(o,"title",`${e.shown?.verdict?.
why}. Click to ${r.text}.`),pt(o,"aria-label",`Not converged: ${r.text}`));let i=e.shown;if(!i||!e.document)return R(s,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",c=i.layer==="draw"?a+(e.flicker.under?" over the mean":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="en\
tropy"?"entropy":"mean";if(i.method==="counts")return R(s,"hidden",!1),R(n,"textContent",`hits and passes · ${e.stage?e.stage.text.toLowerCase():"poses as far \
as they are known"}`),R(n,"className","chip approximate");let u={importance:"importance sampling",propagate:"belief propagation"}[i.method],h=i.approximate?`app\
roximate, ${Gd(i)}`:u??`${i.sweeps} sweeps`;R(s,"hidden",!1),R(n,"textContent",`${c} · ${h}`),R(n,"className",i.approximate?"chip approximate":"chip")}),s}function Gd({
method:t,sweeps:e,total:n,averaged:o}){return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${o} draws of one chain, sensor being fitted: sweep ${e}\
 of ${n}`}function Gl(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n||t.recorded||n.source.kind==="run")return null;let o=r=>()=>t.act({type:"set",
patch:r});if(e.method==="gibbs"&&n.source.kind==="simulation")return{text:"try blocks",apply:o({method:"block"})};if(e.method==="importance")return{text:"try Gi\
bbs",apply:o({method:"auto"})};if(t.sampling)return null;let s=Math.min(Se.sweeps[1],4*n.sweeps);return s>n.sweeps?{text:`try ${s} sweeps`,apply:o({sweeps:s})}:
null}function Hl(t){let{session:e}=t,n=x("span"),o=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),s=x("div",{className:"banner",
role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??0)/1e3));R(s,"h\
idden",!r&&e.worker!=="restarted"),R(s,"className",r?"banner":"banner mild"),R(o,"hidden",!r);let a=`Connection lost. Trying again in ${i} s; the map is kept he\
re.`,c=e.connection.refused?Ud:a;R(n,"textContent",r?c:"The worker stopped and is being started again. The map is kept.")}),s}function Vl(t){let{session:e,hand:n}=t,
o=x("div",{className:"readout",id:`${t.prefix}-readout`}),s=x("span",{role:"status","aria-live":"polite"}),r=x("span",{className:"hidden","aria-live":"polite"});
return n.announce=i=>R(r,"textContent",i),n.describe=i=>Wl(e,i),t.each(()=>{let i=n.cursor??n.hover,c=e.editable&&!matchMedia("(pointer: coarse)").matches?"Poin\
t at a cell, or press ? for the keys":"Point at a cell";R(o,"textContent",i?Wl(e,i):c);let u=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad";R(s,"textC\
ontent",u?"Ready, but the chains have not converged":e.status.text),R(s,"className",u?"warning":e.status.level)}),{element:x("footer",{},s,o,r),readout:o}}function Wl(t,e){
let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+1),{x:c,y:u}=On(e,n.grid),h=[`Ce\
ll ${e.x}, ${e.y}`,`${c.toFixed(a)}, ${u.toFixed(a)} m`];if(o&&o.p.length===r[0]*r[1]){let d=o.p[i]/255,{kind:m,mean:w,value:y,interval:S}=t.quantity;o.layer===
"width"?h.push(`90 % interval ${d.toFixed(2)} wide`):m!=="binary"&&o.layer==="draw"?h.push(`${y} ${d.toFixed(2)} in this draw`):m!=="binary"?h.push(`${w} ${d.toFixed(
2)}`,...S?[]:[`entropy ${mo(d).toFixed(2)} bit`]):o.layer==="draw"?h.push(d>.5?"wall in this draw":"free in this draw"):h.push(`P(wall) ${d.toFixed(2)}`,`entrop\
y ${mo(d).toFixed(2)} bit`);let k=t.cell?.x===e.x&&t.cell.y===e.y?t.cell:null,P=k?k.beams:null;o.observed[i]?P!==null&&h.push(P===1?"1 beam":`${P} beams`):h.push(
"unobserved"),k?.nats_for!==void 0&&k.nats_against!==void 0&&P&&h.push(`for a wall ${k.beams_for}, ${k.nats_for.toFixed(1)} nats`,`against ${k.beams_against}, ${k.
nats_against.toFixed(1)} nats`)}return h.join(" · ")}var Wd={logged:"as logged",odometry:"from raw odometry"},zd=180/Math.PI;function Bl(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
Wd,()=>e.document?.poses??"logged",d=>t.set({poses:d}));o.classList.add("wide"),t.visible(o,n);let[s,r]=Se.pose_sigma,[i,a]=Se.heading_sigma_deg,c=[t.slider("po\
se_sigma",()=>"Position ±",{low:s,high:r,step:.05,unit:" m"}),t.slider("heading_sigma",()=>"Yaw ±",{low:i,high:a,step:.5,unit:"°",scale:zd})];for(let d of c)
t.visible(d,()=>e.editable);let u=x("p",{className:"caption"});t.each(()=>{let{pose_sigma:d=0,heading_sigma:m=0,method:w="auto"}=e.document??{},y=n()&&e.document?.
poses==="odometry"&&e.shown?.method==="counts"&&!e.running,S=e.editable&&(d>0||m>0)&&!/auto|gibbs|block/.test(w);R(u,"hidden",!S&&!y),R(u,"textContent",y?"Run i\
nfers where the robot was.":"This method takes poses as known; Gibbs does not.")});let h=t.section("Where the robot was",o,...c,u);return t.visible(h,()=>e.editable||
n()&&!e.recorded),h}var Ur=t=>t.charAt(0).toUpperCase()+t.slice(1),ms=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=Ur(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var Hd=20,Vd={importance:"particles",propagate:"rounds"};function jl(t,...e){let{session:n}=t,o=x("progress",{max:1,value:0,"aria-label":"Progress"}),s=x("div",
{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=i?i.done/i.of:r&&r.total>0&&!r.approximate?r.sweeps/r.total:0;R(o,"value",a);let c=n.remaining_s(),
u=Vd[r?.method??""]??"sweeps",h=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${u}`:"",d=c!==null?c<1?"less than 1 s left":`${Math.ceil(c)} s left`:n.running?
"running":"";i?R(s,"textContent",`${i.text}: ${i.done} of ${i.of} ${i.of>Hd?"scans":"rounds"}`):R(s,"textContent",Ur([h,d].filter(Boolean).join(", "))||"No chai\
n yet")}),t.section("Posterior",Bd(t),o,s,jd(t),qd(t),...e)}function Bd(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"primary",
text:"Run",title:"Run (R)"}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||e.sampling}),s=t.
checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chain"),r=x("div",{className:"buttons"},n,o,s);return t.visible(
r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function jd(t){let{session:e}=t,n=x("dl"),o=(s,r,i,a=!1)=>{let c=x("dd",{textContent:"–"});n.append(x("d\
iv",{title:r},x("dt",{textContent:s}),c)),t.each(()=>{R(c,"textContent",e.shown?i(e.shown):"–"),a&&R(c,"className",e.shown?.verdict?.level??"")})};return o("E\
SS","Effective sample size of the log joint",s=>Ce(s.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",s=>Ce(s.rhat,3),!0),o("log joint",
"Log of prior times likelihood at the last sweep",s=>Ce(s.log_joint,Math.abs(s.log_joint??0)<1e5?1:0)),o("reply","From the hand's last move to its picture",()=>Ce(
e.latency.eventToPaint_ms.at(-1),0," ms")),n}function qd(t){let{session:e}=t,n=x("div",{className:"verdict"});return t.each(()=>{let o=e.shown?.verdict;if(R(n,"\
hidden",!o),!o)return;let s={good:"Converged",fair:"Nearly converged",bad:"Not converged"}[o.level];R(n,"textContent",`${s}: ${o.why}`),R(n,"className",`verdict\
 ${o.level}`)}),n}var gs=t=>Math.abs(t)<.995?`${Ce(100*Math.abs(t),1)} cm`:`${Ce(Math.abs(t),2)} m`,Kd="Point at a reading to compare it with what the posterior predicts of it.";
function ql(t){let{session:e}=t,n=x("p",{className:"words reading",role:"status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.
document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i}=e.reading,a=s?`Beam ${s.beam+1} of scan ${s.scan+1}.`:Kd;R(n,"textContent",i||
(r?Yd(r):a))}),o}function Yd({scan:t,beam:e,reading:n,range:o,low:s,median:r,high:i,residual:a,no_return:c,wall:u}){let h=`Beam ${e+1} of scan ${t+1}`,d=(P,M)=>P===
null?M:`${Ce(P,2)} m`,m=`median ${d(r,"no return")}, 80 % between ${d(s,"too close")} and ${d(i,"no return")}`;if(n==="none")return`${h} came back from nothing,\
 which was predicted with probability ${Ce(c??0,3)} (${m}).`;if(n!=="hit"||o===null)return`${h} read nothing that says how far (${m}).`;let w=a===null?"":`, ${gs(
a)} ${a<0?"shorter":"longer"} than the predicted median`,y=`${h} read ${Ce(o,2)} m${w} (${m}).`;if(!u)return y;let S=`${gs(u.across_m)} ${u.across_m<0?"behind":
"in front of"} the wall, which is ${gs(u.thickness_m)} thick`,k=`${gs(u.along_m)} to the ${u.along_m<0?"right":"left"} along it from the middle of its surface`;
return`${y} It ended ${S} (one standard deviation), and ${k}; the beam met it at ${Ce(u.incidence_rad*180/Math.PI,0)}° from its normal.`}var Jd={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Zd={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},Qd={noisy:"with noise",exact:"exact"},Xd={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},eh={raster:"raster",radial:"radial",random:"random"},ys=2*Math.PI,th=t=>Math.round(t*1800/Math.PI)/10,nh={importance:"Particles",propagate:"Round\
s"};function Kl(t){let{session:e,hand:n,editor:o}=t,s=x("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let d=e.document?.sensors??[],m=d.map(w=>w.id).join();m!==r&&s.replaceChildren(...d.map(({id:w})=>x("option",{value:String(
w),textContent:`Sensor ${w}`}))),r=m,R(s,"value",String(n.sensor?.id??""))});let i=(d,m)=>t.numberInput(d,()=>Number((n.sensor?.[m]??0).toFixed(2)),w=>n.sensor&&
o.moveSensor(n.sensor,{[m]:w}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),d=>n.sensor&&o.moveSensor(n.sensor,{yaw:d%
360*Math.PI/180}),{step:5}),c=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),u=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1});t.visible(a,()=>(e.document?.fov??ys)<ys);let h=x("div",{className:"triple"},i("x (m)","x"),i("y (m)","y"),
a);return t.section("Sensors",x("div",{className:"buttons"},s,c,u),h)}function Yl(t){let{session:e}=t,[n,o]=Se.max_range,[s,r]=Se.fov_deg,i=t.numberInput("Longe\
st range (m)",()=>e.document?.max_range??0,d=>t.set({max_range:d}),{min:n,max:o,step:"any"}),a=[t.slider("noise",()=>"Noise (m)",{low:Se.noise[0],high:Se.noise[1],
step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{low:Se.angles[0],high:Se.angles[1],step:1,log:!0}),i,t.numberInput("Field of view (°)",()=>th(e.document?.
fov??ys),d=>t.set({fov:d>=r?ys:d*Math.PI/180}),{min:s,max:r,step:5}),t.select("Readings",Qd,()=>e.document?.readings??"noisy",d=>t.set({readings:d}))];for(let d of a)
t.visible(d,()=>e.editable);let c=t.slider("prior",()=>"Prior P(wall)",{low:Se.prior[0],high:Se.prior[1],step:.01}),u=()=>(e.document?.cells??"binary")==="binar\
y";t.visible(c,u);let h=t.select("Cells",Zd,()=>e.document?.cells??"binary",d=>t.set({cells:d}));return t.visible(h,()=>e.document?.source.kind==="log"),t.section(
"Model",h,Ol(t),c,...a)}function Jl(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>(e.document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.
test(n()),[r,i]=Se.seed,a=[t.select("Method",Jd,n,c=>t.set({method:c})),t.select("Order",eh,()=>e.document?.order??"radial",c=>t.set({order:c}),()=>n()==="gibbs"||
n()==="auto"),t.select("Start",Xd,()=>e.document?.start??"auto",c=>t.set({start:c}),s)];for(let c of a)t.visible(c,o);return t.section("Inference",...a,t.slider(
"sweeps",()=>nh[n()]??"Sweeps",{low:Se.sweeps[0],high:Se.sweeps[1],step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,c=>t.set({seed:Math.round(c)}),{
min:r,max:i,step:1}))}function Zl(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),
o=t.button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.section("Clear",x("div",{className:"buttons"},n,
o))}var oh=0,bs=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${oh++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}visible(e,n){this.each(()=>R(e,"hidden",!n()))}button(e,n,o,{
className:s="",text:r="",when:i,title:a}={}){let c=x("button",{type:"button",className:s,title:a??n,onclick:o},e&&en(e));return r&&c.append(x("span",{textContent:r})),
r!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>R(c,"disabled",!i())),c}segmented(e,n,o,s,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=x("div",{className:"\
segmented",role:"radiogroup","aria-label":e});for(let[c,u,h]of n){let d=x("input",{type:"radio",name:i,value:c,onchange:()=>s(c)});a.append(x("label",{title:u},
d,h?en(h):null,x("span",{textContent:u}))),this.each(()=>{R(d,"checked",o()===c),r&&R(d,"disabled",!r(c))})}return a}section(e,...n){let o=`${this.prefix}-${e.replace(
/\W/g,"")}`;return x("section",{"aria-labelledby":o},x("h2",{id:o,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,x("div",{className:"\
row"},x("label",{for:n.id,textContent:e}),n)}slider(e,n,{low:o,high:s,step:r,log:i=!1,unit:a="",scale:c=1}){let u=`${this.prefix}-${e}`,h=k=>i?1e3*Math.log(k/o)/
Math.log(s/o):k,d=k=>{if(!i)return k;let P=o*(s/o)**(k/1e3),M=P<100?1:10**(Math.floor(Math.log10(P))-1);return se(Math.round(P/M)*M,o,s)},m=()=>c===1?this.session.
document?.[e]??o:Number(((this.session.document?.[e]??o/c)*c).toFixed(3)),w=x("label",{for:u}),y=x("input",{type:"range",id:u,...i?{min:0,max:1e3,step:1}:{min:o,
max:s,step:r}}),S=x("input",{type:"number",min:String(o),max:String(s),step:String(r)});return y.addEventListener("input",()=>this.set({[e]:d(Number(y.value))/c})),
y.addEventListener("change",()=>this.endDrag()),S.addEventListener("change",()=>{let k=Number(S.value);S.value===""||!Number.isFinite(k)?S.value=String(m()):this.
set({[e]:i?Math.round(se(k,o,s)):se(k,o,s)/c}),this.endDrag()}),this.each(()=>{let k=m();R(w,"textContent",n()),pt(S,"aria-label",`${n()}, number`),d(Number(y.value))!==
k&&(y.value=String(h(k))),pt(y,"aria-valuetext",`${k}${a}`);let P=100*(h(k)-Number(y.min))/(Number(y.max)-Number(y.min));y.style.setProperty("--fill",`${se(P,0,
100)}%`),hn(S)||R(S,"value",String(k))}),x("div",{className:"row slider"},w,y,S)}select(e,n,o,s,r){let i=x("select",{onchange:()=>s(i.value)});for(let[a,c]of Object.
entries(n))i.append(x("option",{value:a,textContent:c}));return this.each(()=>{R(i,"value",o()),r&&R(i,"disabled",!r())}),this.row(e,i)}numberInput(e,n,o,s={}){
let r=x("input",{type:"number",...s}),{min:i=-1/0,max:a=1/0}=s;return r.addEventListener("change",()=>{r.value!==""&&Number.isFinite(Number(r.value))&&o(se(Number(
r.value),i,a))}),this.each(()=>{hn(r)||R(r,"value",String(n()))}),this.row(e,r)}checkbox(e,n,o,s=""){let r=x("input",{type:"checkbox",onchange:()=>o(r.checked)});
return this.each(()=>R(r,"checked",n())),x("label",{className:"check",title:s},r,x("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(
/\W/g,"")}`,s=x("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},en("close")),r=x("div",{className:"title"},x("h2",{id:o,textContent:e}),
s),i=x("dialog",{"aria-labelledby":o},r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),
i}};var sh=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],rh={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},ws=class{constructor(e){
this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.session.act({type:"\
view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,
draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,e&&s.wantsMean?this.session.act({type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.
showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?0:n),this.session.changed()}over(e){let{flicker:n,view:o}=this.session;n.on=e,e&&!n.wantsMean&&o.
layer!=="draw"?this.showLayer("draw"):e&&n.wantsMean&&(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.chain})),this.session.changed()}playFromStart(){
this.showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.
wantsMean)return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:o,draws:s}=this.
session;o+1>=s.count&&n.on?this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function Ql(t,e,n){let{session:o}=t,s=t.segmented(
"Show",sh,()=>o.view.layer,m=>e.showLayer(m),m=>m!=="draw"||o.hasDraws),[,,r,i]=Array.from(s.children);R(i,"title","Width of each cell's 90 % interval"),t.visible(
r,()=>!o.quantity.interval),t.visible(i,()=>o.quantity.interval);let a=(m,w)=>t.checkbox(m,()=>n[w],y=>{n[w]=y,o.changed()}),c=a("True walls","truth");t.visible(
c,()=>!o.document||o.document.source.kind==="simulation");let[u,h]=[a("Surfaces","strokes"),a("Trajectory","trajectory")];t.visible(u,()=>!!o.overlay?.strokes.length),
t.visible(h,()=>!!o.overlay?.trajectory.length);let d=x("div",{className:"checks",role:"group","aria-label":"Marks"},c,a("Rays","rays"),a("Readings","readings"),
u,h);return t.section("View",s,ih(t,e),d)}function ih(t,e){let{session:n}=t,o=x("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener(
"input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1}),r=x("output"),i=x(
"select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:d,count:m}=n.draws;R(o,"max",String(
Math.max(0,m-1))),R(o,"disabled",m===0),R(o,"value",String(n.draw));let w=m?`${n.draw+1} of ${m}`:"none kept";pt(o,"aria-valuetext",w),o.style.setProperty("--fi\
ll",`${m>1?100*n.draw/(m-1):0}%`),R(r,"textContent",w),i.length!==Math.max(1,d)&&i.replaceChildren(...Array.from({length:Math.max(1,d)},(S,k)=>x("option",{value:String(
k),textContent:`chain ${k+1}`}))),R(i,"value",String(n.view.chain)),R(i,"disabled",d<2),m<2&&e.playing&&e.play(!1);let y=n.flicker.still?"Next draw":e.playing?"\
Pause the draws":"Play the draws";s.getAttribute("aria-label")!==y&&(s.setAttribute("aria-label",y),s.replaceChildren(en(e.playing?"pause":"play")))});let a=x("\
select",{"aria-label":"Speed"});for(let[d,m]of Object.entries(rh))a.append(x("option",{value:d,textContent:m}));a.value=String(e.drawsPerSecond),a.addEventListener(
"change",()=>e.drawsPerSecond=Number(a.value));let c=t.button(null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1});
t.each(()=>R(a,"disabled",n.draws.count<2||n.flicker.still));let u=t.checkbox("Draws over the mean",()=>n.flicker.on,d=>e.over(d),"Each draw in its own colour o\
ver the mean, as one of the maps that the scans leave possible");t.visible(u,()=>n.draws.count>1);let h=x("div",{className:"wide"},u);return x("div",{className:"\
player"},s,o,r,x("div",{className:"buttons wide"},i,a,c),h)}function Xl(t){let{session:e}=t,n=x("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),
o=x("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.section("Scan",x("div",{className:"player bare"},n,o));return t.
each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;R(s,"hidden",r<2),R(n,"max",String(Math.max(0,r-1))),hn(n)||R(n,"value",String(
e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),R(o,"textContent",`${Number(n.value)+1} / ${r}`)}),s}var tc=2,ec=6,ah=.5,lh=.005;function nc(t){let{session:e,hand:n}=t,o=x("p",{className:"whereabouts",role:"status"}),s=x("p",{className:"caption"}),r=t.section("\
Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),R(o,"textContent",ch(t)),R(s,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function ch({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>ah?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>lh?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${o}${uh(e.modes)}${ph(e,t.editable)}${s}`}function uh(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>tc,o=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${Gr(e.mean[2],0)}`,s=`known to ${Wr(e.sigma_m)} and ${Gr(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${Wr(e.sigma_m)} apart.`:`One place: ${o}, ${s}.`;let r=t.slice(0,ec).map(({probability:a})=>ir(a)),i=t.length>ec?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${o}, ${s}.`}function ph({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>tc)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the l\
ikeliest":`the ${dh(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${Wr(o[s])} and ${Gr(r,1)} from ${i}.`}var dh=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,Gr=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,Wr=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function oc(t,e,n){let{shown:o,status:s}=t,i=o?.layer==="draw"||o?.layer==="width"?o.layer:t.view.layer==="entropy"?"entropy":"mean";return{document:t.effectiveDocument(),
generation:t.generation,painted:o&&{generation:o.generation,layer:i,approximate:o.approximate,sweeps:o.sweeps,method:o.method,quantity:t.quantity,rhat:o.rhat,verdict:o.
verdict,trace:o.trace,traced:o.traced,weights:o.weights,ess:o.ess,chain:o.chain,draw:o.draw},probability:o?.p??new Uint8Array(0),observed:o?.observed??new Uint8Array(
0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{text:s.text,level:s.level},connected:t.connection.connected,decisions:{path:t.decisions.path,
views:t.decisions.views,trouble:t.decisions.trouble},where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:hh(t),reading:{picked:t.reading.picked,
found:t.reading.found,trouble:t.reading.trouble},over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.strokes.length/5,trajectory:t.overlay.trajectory.length/
2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},
layers:{...n.paints},transform:{...e.transform}}}function hh({ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,
fan:o&&{...o,near:o.near&&{...o.near}}}}var sc="bayesmap-token",zr="bayesmap-kept";function fh(t){try{return localStorage.getItem(t)}catch{return null}}function Hr(t,e){try{e===null?localStorage.removeItem(
t):localStorage.setItem(t,e)}catch{}}function Vr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Hr(zr,JSON.stringify(t))}function rc(){
Hr(zr,null)}function ic(){let t=fh(zr);try{return t&&JSON.parse(t)}catch{return null}}function ac(t){t&&Hr(sc,t)}function lc(t){let e=n=>{n.key===sc&&n.newValue&&
t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",e)}var cc=new Set(["walls","sensor","set","view","live"]);function uc(t,e){let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*
s+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type===
"view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let r=n.sensors.find(i=>i.id===e.id);r&&Object.
assign(r,{x:e.x,y:e.y,yaw:e.yaw})}}var vs=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.trouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.session.
changed())}forget(){this.start=this.goal=this.path=this.views=null,this.askedPath=this.askedViews="",this.version++}ask(){let{session:e,start:n,goal:o,radius:s,
risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;let a=`${i.generation} ${e.sampling}`,c=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&
!i.approximate&&c!==this.askedPath&&(this.askedPath=c,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.
method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){this.trouble=e.type==="undecided"?e.text:"",e.type==="path"&&
(this.path=e),e.type==="views"&&this.looking&&(this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}),e.type==="undecided"&&(this.path=null),this.version++}nearest(e){
let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<n.nats.length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,
s]=[r,i])}return o}};var mh="(prefers-reduced-motion: reduce)",xs=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(mh).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var gh=2e3,yh=3e3,bh=2,ks=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&dn(e,n.document.
grid);(!o||!Yt(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
e.recorded||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>gh&&(this.waiting=0),this.waiting>=bh)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>yh;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:c,
near_hit:u}=n,h=e.near&&{...e.near,pose:a,ranges:c,hit:u},{x:d,y:m,yaw:w,generation:y,draws:S,coarse:k,milliseconds:P}=e;this.fan={x:d,y:m,yaw:w,generation:y,draws:S,
coarse:k,milliseconds:P,angles:o,low:s,median:r,high:i,near:h},this.answers++}else this.fan=null;this.version++,this.ask()}};var Ss=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var Ms=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Ts=class{constructor(e){this.session=e}picked=null;found=null;trouble="";version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.kind!==
"simulation"&&!o.recorded,r=e&&s&&o.scan?wh(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=r,
this.found=null,this.trouble="",this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>o.act({type:"beam",scan:r.scan,beam:r.beam}),120)),
o.changed())}forget(){this.picked&&(clearTimeout(this.timer),this.picked=this.found=null,this.version++)}receive(e){let n=e;e.type==="undecided"?this.trouble=e.
text:n.beam===this.picked?.beam&&n.scan===this.picked.scan&&(this.found=n),this.version++}};function wh({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)
return null;let c={x:e[0],y:e[1]},[u,h]=[-1,1/0];for(let d=0;d<n.length;d++){let[m,w]=[Math.cos(e[2]+n[d]),Math.sin(e[2]+n[d])],[y,S]=[r.x-c.x,r.y-c.y],k=y*m+S*
w,P=s[d]?o[d]:a,M=s[d]?Math.hypot(y-P*m,S-P*w):1/0,_=k>0&&k<P?Math.abs(y*w-S*m):1/0,E=Math.min(M,i/2+2*_);E<h&&([u,h]=[d,E])}return h<i?{scan:t,beam:u,from:c,angle:e[2]+
n[u]}:null}var Ps=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble??"";let{pose:o,weight:s}=n,{modes:r=[]}=e,i=r.filter(({probability:a},c)=>c===0||a>=.005);this.found=this.trouble?null:
{...e,modes:i,cloud:o,weight:s},this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||e.recorded||e.worker!=="ready"||e.editable&&n.generation!==e.
generation)return;let s=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.
asked||this.waitingSince&&i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:
{type:"where"}))}};var vh=new Set(["inspect","path","views","where","ghost","beam"]),Es=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;cell=null;lastStage=null;worker="starting";recorded=!1;generation=-1;acted=0;decisions=new vs(
this);where=new Ps(this);ghost=new ks(this);reading=new Ts(this);flicker=new xs(this);status=new ms;progress=new Ms;latency=new Ss;counts={paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];confirmedWalls={
text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){
return!this.recorded&&this.document?.source.kind==="simulation"}get running(){return!!this.state?.running}get stage(){return this.running&&this.shown?.method===
"counts"?this.lastStage:null}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&
(this.running||this.state?.live))}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??
e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),
this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;let o={...e,seq:++this.seq};vh.has(e.type)||(this.acted=this.seq),cc.has(e.type)&&(this.pending.
push(o),this.foresee(o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&Vr(this.portableDocument()),this.changed()}bring(e){
this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.wallsVersion&&(this.packed=
{version:this.wallsVersion,text:$o(Mi(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.effectiveDocument();
return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.flicker.take(this.
shown),!0)}painted(){this.counts.paints++,this.shown&&this.latency.painted(this.shown.generation),this.decisions.ask(),this.ghost.ask()}get quantity(){return this.
shown?.quantity??{kind:"binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){
if(this.connection=e,e.connected){let n=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(n),this.view.layer!==
"mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.text,this.notice.level),
this.everConnected=!0,rc()}else this.everConnected&&(this.say("Connection lost","error"),Vr(this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"\
welcome":this.generation=-1,this.recorded=!!e.recorded,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":if(e.generation>=
this.generation){let{pose:o,angles:s,ranges:r,exact:i,hit:a}=n;this.scan?.index!==e.index&&this.reading.forget(),this.scan={ids:e.ids??[],index:e.index??null,pose:o,
angles:s,ranges:r,exact:i,hit:a}}break;case"overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":
this.where.receive(e,n);break;case"cell":this.cell=e;break;case"path":case"views":case"ghost":case"beam":case"undecided":this.receiveAnswer(e,n);break;case"stat\
us":this.status.say(e.text,e.level??"info",this.acted);break;case"error":this.receiveError(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);
break;case"download":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveAnswer(e,n){let o=e.
type==="undecided"?e.of:e.type;o==="ghost"?this.ghost.receive(e,n):o==="beam"?this.reading.receive(e):this.decisions.receive(e,n)}receiveError(e){let n=e.refused?.
seq??null;n!==null&&n===this.broughtAt&&(this.broughtAt=null,this.act({type:"hello"})),this.status.say([e.text,e.remedy].filter(Boolean).join("; "),"error",this.
acted),this.pending=this.pending.filter(o=>o.seq!==n),n!==null&&this.latency.refused(n),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,
this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){
if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,a=n.observed,c=this.next??this.
shown,h=c&&c.p.length===o.length&&c.bits.every((d,m)=>d===a[m])?{observed:c.observed,bits:c.bits}:{observed:fo(a,o.length),bits:a};this.next={...e,p:o,trace:s,traced:r,
weights:i,...h},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==
s.text||s.walls.length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:fo(Wt(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==
s||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),this.state.view&&!this.pending.some(r=>r.type==="view")){
let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r??"mean",chain:i??0,draw:a??null}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||
!this.state||(uc(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var pc='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var dc=`:host { display: block; height: 100dvh; container-type: size; }
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
  footer > * { max-width: 100%; }
}
@media (prefers-reduced-motion: no-preference) { button, .segmented label { transition: background-color .12s; } }
@media (forced-colors: active) { .segmented label:has(:checked) { outline: 2px solid Highlight; } }
`;var fc="bayesmap-theme",hc={auto:"light",light:"dark",dark:"auto"},_s=class{constructor(e,n){this.app=e;this.dressed=n;let o=Sh();o&&o in hc&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=qo.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?qo.dark:qo.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:c,draw:u,ghost:h}=n;for(let[d,m]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:c,draw:u,ghost:h}))this.app.style.setProperty(
`--${d}`,m);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=hc[this.choice];try{localStorage.setItem(fc,this.choice)}catch{}this.dress()}destroy(){
this.media.removeEventListener("change",this.listen)}};function Sh(){try{return localStorage.getItem(fc)}catch{return null}}function As(t,e,{embedded:n=!1,adopt:o=null,notice:s=null}={}){let r=t.shadowRoot??t.attachShadow({mode:"open"}),i=new CSSStyleSheet;i.replaceSync(pc+dc),r.adoptedStyleSheets=
[i],t.toggleAttribute("data-embedded",n);let a=0,c=()=>{a||=requestAnimationFrame(Ue)},u=new Es(e,c,o,s);e.open();let h=new Un,d=new Wo(u),m=new Go(u,d),w=new ws(
u),y=new bs(u,d,m,ae,Y=>w.showLayer(Y),n),S=[new Wn,new Hn,new jn,new Bn,new Jo,new Vn,new Gn,new qn,new zn,new Bo],k=S.map(({name:Y})=>x("canvas",{className:Y})),
P=k[k.length-1];Object.assign(P,{tabIndex:0,role:"application"});let M=new Ho(S,k);new Vo(P,u,h,d,m,n);let _=new zo(P,u,h,d,m),E={truth:!0,rays:!0,readings:!0,strokes:!0,
trajectory:!0},q=$l(y),D=Xi(y),K={chip:zl(y),banner:Hl(y)},V=x("main",{className:"stage"},...k,K.chip,K.banner),N=()=>ee.theme,G=Il(y,N),C=Vl(y);P.setAttribute(
"aria-describedby",C.readout.id);let Z=Rl(y),I={help:Ll(y),new:Dl(y),share:Z.dialog},[j,W,Q,z]=[Kl(y),Yl(y),Jl(y),Zl(y)],Je=[Cl(y),nc(y),Fl(y),Ul(y),jl(y,_l(y,N),
Al(y,N)),Xl(y),ql(y),Ql(y,w,E),j,W,Bl(y),Q,z],me=x("aside",{"aria-label":"Controls"},...Je),re=()=>u.recorded||u.document?.source.kind==="run";y.visible(j,()=>u.
editable),y.visible(W,()=>!re()),y.visible(Q,()=>!re()),y.visible(z,()=>!re()),y.each(()=>{R(D,"inert",!u.document),R(me,"inert",!u.document)});let ue=x("div",{
className:"app"},q.element,D,V,G,me,C.element,...Object.values(I));r.replaceChildren(ue);let ee=new _s(ue,Y=>{q.nameTheme(Y),c()}),H=()=>{let Y=u.editable&&d.tool===
"sensor"?d.sensor?.id??null:null;return{session:u,view:h,look:{theme:ee.theme,...E,hover:d.hover,cursor:d.cursor,selected:Y}}},Ee="";function Ue(){a=0;let Y=u.take();
u.document&&String(u.shape)!==Ee&&(Ee=String(u.shape),h.fit(u.shape),d.cursor=d.hover=null,u.decisions.forget(),u.ghost.refit(),P.setAttribute("aria-label",`Map\
, ${u.shape[0]} by ${u.shape[1]} cells`)),M.paint(H()),Y&&(u.painted(),w.step());let{x:ne,y:Ne}=h.transform;K.chip.style.transform=`translate(${Math.max(ne,Ye.left)}\
px, ${Math.max(Ne-28,6)}px)`,pt(P,"data-tool",u.editable||$t.has(d.tool)?d.tool:"pan"),y.refresh()}let ge=new ResizeObserver(()=>{let{width:Y,height:ne}=V.getBoundingClientRect();
!Y||!ne||(h.resize(Y,ne,devicePixelRatio||1),h.fitted&&h.fit(u.shape),cancelAnimationFrame(a),Ue())});ge.observe(V);async function ae(Y){if(Y==="in"||Y==="out")
h.zoom(Y==="in"?1.4:1/1.4,h.middle,u.shape);else if(Y==="fit")h.fit(u.shape);else if(Y==="help")I.help.showModal();else if(Y==="new")I.new.showModal();else if(Y===
"theme")ee.next();else if(Y==="add")_.addSensor();else if(Y==="share"){let ne=u.portableDocument();ne&&Z.show(location.origin+location.pathname+await Ei(ne))}else if(Y===
"export png"){let ne=await Zi(H());ne&&ar("bayesmap.png",ne),u.say("Saved bayesmap.png")}else Y.startsWith("export ")&&u.act({type:"export",what:Y.slice(7)});c()}
u.ondownload=(Y,ne,Ne)=>ar(Y,new Blob([Ne],{type:ne}));let it=[[n?t:window,"keydown",Y=>{Y.defaultPrevented||!u.document||Object.values(I).some(ne=>ne.open)||Oi(
Y,u,{tool:ne=>{d.choose(ne),_.focus()},layer:ne=>w.showLayer(ne),command:ae})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{if(n)return;let{
document:Y,damaged:ne}=await Uo();Y?u.bring(Y):ne&&u.say(Oo,"error")}]];for(let[Y,ne,Ne]of it)Y.addEventListener(ne,Ne);return ee.dress(),{destroy(){ge.disconnect(),
cancelAnimationFrame(a),ee.destroy();for(let[Y,ne,Ne]of it)Y.removeEventListener(ne,Ne);e.close(),r.replaceChildren()},snapshot:()=>oc(u,h,M),cellToClient(Y,ne){
let Ne=P.getBoundingClientRect(),Ot=h.fromGrid({x:Y+.5,y:ne+.5},u.shape[1]);return{x:Ne.left+Ot.x,y:Ne.top+Ot.y}}}}var Br={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},mc=8,so=()=>({onmessage:()=>{},onstatus:()=>{}});function gc(t){let e=new DataView(t).getUint32(
0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers){let c=a.reduce((u,h)=>u*h,1)*Br[i].BYTES_PER_ELEMENT;
o[r]=new Br[i](t.slice(s,s+c)),s+=Math.ceil(c/mc)*mc}return[n,o]}function yc(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{let{buffer:i,byteOffset:a,
byteLength:c}=e[r];n[o]=new Br[s](i.slice(a,a+c))}),n}function bc(t){let{document:e,scans:n,settings:o={},log_joint:s=[]}=t,r=e.grid.shape[0]*e.grid.shape[1],i=t.draws?.count??0,a=e.source.kind!=="simulation",c=Wt(
t.mean),u=Wt(t.observed),h=null,d=0,m={layer:"mean",chain:0,draw:null},w=N=>a?[N[d]]:N,y=N=>Float32Array.from(w(N).flat(),G=>G??1/0),S=n.angles.length,k=fo(Wt(n.
hit),n.pose.length*S),P=()=>a?k.subarray(d*S,(d+1)*S):k,M=Float32Array.from(s.flat()),_=(o.sweeps??i)/Math.max(1,i),E=Float32Array.from(s[0]??[],(N,G)=>(G+1)*_),
q=N=>{let G={chains:t.draws?.chains??0,count:h?i:0},C={generation:1,can_undo:!1,can_redo:!1,live:!1,running:!1};V.onmessage({type:"state",document:e,seq:N,...C,
draws:G,view:m},{})},D=()=>{let N=Float64Array.from(w(n.pose).flat(),Number),G={type:"scan",generation:1,ids:a?[d]:n.ids,index:a?d:null},C=n.exact?.length?y(n.exact):
new Float32Array(0);V.onmessage(G,{pose:N,angles:Float32Array.from(n.angles),ranges:y(n.ranges),exact:C,hit:P()})},K=()=>{let N=m.layer==="draw"&&h?Mh(h,m.chain*
i+(m.draw??i-1),r):null,G=s[m.chain]?.[(m.layer==="draw"?m.draw:null)??i-1]??null,C=N?{...m,draw:m.draw??i-1}:{layer:m.layer==="draw"?"mean":m.layer},Z=o.sweeps??
i,I={quantity:o.quantity,sweeps:Z,total:Z,ess:o.ess,rhat:o.rhat,verdict:o.verdict,log_joint:G},j=o.method??e.method,W={p:N??c,observed:u,trace:M,traced:E};V.onmessage(
{type:"field",generation:1,...C,method:j,approximate:!1,...I},W)},V={...so(),open:()=>V.onstatus({connected:!0}),send:N=>{if(N.type==="hello"){if(V.onmessage({type:"\
welcome",version:1,recorded:!0},{}),q(N.seq),D(),K(),!i||!t.draws)return;Io(Wt(t.draws.data)).then(G=>{h=G,q(N.seq)})}else if(N.type==="view")m={layer:N.layer,chain:N.
chain??m.chain,draw:N.draw??null},q(N.seq),K();else if(N.type==="scan")d=N.index,q(N.seq),D();else if(N.type==="inspect"){let G=Th(e,n.angles,w(n.pose),w(n.ranges),
N.x,N.y);V.onmessage({type:"cell",x:N.x,y:N.y,beams:G},{})}},close:()=>{}};return V}function Mh(t,e,n){let o=e*n;return Uint8Array.from({length:n},(s,r)=>t[o+r>>
3]>>7-(o+r&7)&1?255:0)}function Th({grid:t},e,n,o,s,r){let{origin:i,resolution:a}=t,c=[i[0]+s*a,i[1]+r*a],u=0;return n.forEach((h,d)=>{let[m,w,y]=h.map(Number);
e.forEach((S,k)=>{let[P,M]=[Math.cos(S+y),Math.sin(S+y)],_=[(c[0]-m)/P,(c[0]+a-m)/P,(c[1]-w)/M,(c[1]+a-w)/M],E=Math.max(0,Math.min(_[0],_[1]),Math.min(_[2],_[3])),
q=Math.min(o[d][k]??1/0,Math.max(_[0],_[1]),Math.max(_[2],_[3]));E<q&&u++})}),u}var jr=250,Ph=8e3;function wc(t){let e=null,n=jr,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let c=new WebSocket(a),u=!1;e=c,c.binaryType="arraybuffer",c.onopen=()=>{u=!0,n=jr,i.onstatus({connected:!0})},c.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...gc(h))},c.onclose=()=>{if(s||e!==c)return;o=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),u||Eh(t()).then(d=>d&&e===c&&i.onstatus({...h,refused:d})),n=Math.min(Ph,2*n)}}let i={...so(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=jr,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};return i}async function Eh(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function vc(t){let e=(o,s=[])=>n.onmessage(o,yc(o,s)),n={...so(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var _h="This is the map that was drawn here when the connection was lost; undo leads back",qr=t=>Object.assign(window,{bayesmap:t}),R0={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=As(n,vc(t),{embedded:!0});return qr(o),()=>o.destroy()}};async function Ah(){let t=document.querySelector("[data-bayesmap\
]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("sc\
ript[data-recording]");if(n){qr(As(t,bc(JSON.parse(n.textContent??""))));return}ac(new URLSearchParams(location.search).get("token"));let{document:o,damaged:s}=await Uo(),
r=o?null:ic(),i=wc(()=>new URL(location.href));lc(c=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(c)}${location.hash}`),i.retry?.()}),
qr(As(t,i,{adopt:o??r,notice:s?{text:Oo,level:"error"}:r?{text:_h,level:"info"}:null}))}Ah();export{R0 as default,As as mount,bc as recordedTransport,wc as webSocketTransport,vc as widgetTransport};
