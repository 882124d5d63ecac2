// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function Se(r,e){let t=new Uint8Array(e);for(let n=0;n<e;n++)t[n]=r[n>>3]>>7-(n&7)&1;return t}function Ke(r){let e=new Uint8Array(r.length+7>>3);for(let t=0;t<r.
length;t++)r[t]&&(e[t>>3]|=128>>(t&7));return e}function U(r){let e=atob(r.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,t=>t.charCodeAt(0))}function te(r){
let e="";for(let t=0;t<r.length;t+=8192)e+=String.fromCharCode(...r.subarray(t,t+8192));return btoa(e)}async function qe(r,e){let t=new Blob([r]).stream().pipeThrough(
e);return new Uint8Array(await new Response(t).arrayBuffer())}var ne=r=>qe(r,new DecompressionStream("deflate-raw")),Ye=r=>qe(r,new CompressionStream("deflate-r\
aw"));async function Xe(r){let e=await Ye(new TextEncoder().encode(JSON.stringify(r)));return"#m="+te(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Yt(r){
let e=/^#m=([\w-]+)$/.exec(r);return e&&JSON.parse(new TextDecoder().decode(await ne(U(e[1]))))}async function re(){let r=await Yt(location.hash).catch(()=>null);
return r&&history.replaceState(null,"",location.pathname+location.search),r}var k=(r,e,t)=>Math.min(t,Math.max(e,r)),_=({x:r,y:e},[t,n])=>r>=0&&e>=0&&r<t&&e<n,X=(r,{resolution:e,origin:t})=>({x:(r.x-t[0])/e,y:(r.y-t[1])/e}),Te=(r,{resolution:e,
origin:t})=>({x:t[0]+r.x*e,y:t[1]+r.y*e});function J(r,e){let{x:t,y:n}=X(r,e);return{x:Math.floor(t),y:Math.floor(n)}}var oe=(r,e)=>Te({x:r.x+.5,y:r.y+.5},e);function Je(r,e){
let t=[],n=Math.max(Math.abs(e.x-r.x),Math.abs(e.y-r.y));for(let o=0;o<=n;o++){let s=n?o/n:0;t.push({x:Math.round(r.x+s*(e.x-r.x)),y:Math.round(r.y+s*(e.y-r.y))})}
return t}function Ze(r,[e,t]){let n=new Path2D,o=(s,a)=>s>=0&&s<e&&a>=0&&a<t?r[s*t+a]:0;for(let s=0;s<=e;s++)for(let a=0,i=-1;a<=t;a++){let l=a<t&&o(s-1,a)!==o(
s,a);l&&i<0&&(i=a),!l&&i>=0&&(n.moveTo(s,i),n.lineTo(s,a),i=-1)}for(let s=0;s<=t;s++)for(let a=0,i=-1;a<=e;a++){let l=a<e&&o(a,s-1)!==o(a,s);l&&i<0&&(i=a),!l&&i>=
0&&(n.moveTo(i,s),n.lineTo(a,s),i=-1)}return n}var se=r=>r<=0||r>=1?0:-(r*Math.log2(r)+(1-r)*Math.log2(1-r));function Qe(r,e,t){let n=tt(r).map(({x:s,y:a})=>s*r.grid.shape[1]+a),o=(s,a)=>-((s-t.x)**2+(a-t.y)**2);return nt(r,(s,a,i)=>e[i]||n.includes(i)?-1/0:o(s,a))}function et(r,e){
let t=Xt(e,r.grid.shape),n=tt(r);return nt(r,(o,s,a)=>{if(e[a])return-1/0;let i=2*t[a];for(let l of n)i=Math.min(i,Math.hypot(o-l.x,s-l.y));return i>0?i:-1/0})}
var tt=({sensors:r,grid:e})=>r.map(t=>J(t,e));function nt(r,e){let[t,n]=r.grid.shape,o=null,s=-1/0;for(let a=0;a<t;a++)for(let i=0;i<n;i++){let l=e(a,i,a*n+i);l>
s&&([o,s]=[{x:a,y:i},l])}return o&&oe(o,r.grid)}function Xt(r,[e,t]){let n=new Uint16Array(e*t),o=(s,a)=>s<0||a<0||s>=e||a>=t?0:n[s*t+a];for(let s=0;s<e;s++)for(let a=0;a<
t;a++)n[s*t+a]=r[s*t+a]?0:1+Math.min(o(s-1,a-1),o(s-1,a),o(s-1,a+1),o(s,a-1));for(let s=e-1;s>=0;s--)for(let a=t-1;a>=0;a--){let i=1+Math.min(o(s+1,a+1),o(s+1,a),
o(s+1,a-1),o(s,a+1));n[s*t+a]=Math.min(n[s*t+a],i)}return n}var P={cells:[2,500],sensors:32,prior:[0,1],noise:[0,5],angles:[10,1e3],max_range:[.1,1e4],sweeps:[1,1e5],seed:[0,2147483647]};var ae=class{constructor(e,t){this.session=e;this.hand=t}isWall(e){return _(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,t,n,o){
let{document:s,shape:a}=this.session;if(!s)return;let i=t?s.sensors.map(c=>J(c,s.grid)):[],l=new Map;for(let c of e)!_(c,a)||this.isWall(c)===t||i.some(p=>p.x===
c.x&&p.y===c.y)||l.set(c.x*a[1]+c.y,[c.x,c.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:t,stroke:n},o)}moveSensor(e,t,n,o){let{x:s,y:a,
yaw:i}={...e,...t};this.refuses({x:s,y:a})||this.session.act({type:"sensor",op:"move",id:e.id,x:s,y:a,yaw:i,drag:n},o)}addSensor(e){let{session:t}=this,{document:n}=t;
if(!n)return;let o=e==="where there is room"?et(n,t.walls):"world"in e?e.world:Qe(n,t.walls,e.near);o?n.sensors.length>=P.sensors?t.say(`There can be ${P.sensors}\
 sensors at most.`,"warning"):this.refuses(o)||(t.act({type:"sensor",op:"add",x:o.x,y:o.y,yaw:0}),this.hand.selected=Math.max(0,...n.sensors.map(s=>s.id))+1):t.
say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"sensor",op:"remove",id:e.id})}refuses(e){
let{session:t}=this;if(!t.document)return!0;let n=J(e,t.document.grid),o=this.isWall(n);return!o&&_(n,t.shape)?(t.status.text.startsWith("A sensor cannot")&&t.say(
"Ready"),!1):(t.say(o?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Jt=120,ie=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.floor(Math.
random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(t=>t.id===this.selected)??e[0]??
null}choose(e){this.tool=e,this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let t=e&&_(e,this.session.shape)?e:null;t?.x===this.
hover?.x&&t?.y===this.hover?.y||(this.hover=t,this.ask(t),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){
clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(
e))},Jt))}};var C={left:36,right:12,top:34,bottom:26},Zt=60,Qt=160,F=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,t,n){[this.
width,this.height,this.ratio]=[e,t,n]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,t]){let n={x:this.width-C.left-C.right,y:this.height-C.top-C.bottom},
o=Math.max(.05,Math.min(n.x/e,n.y/t));o*this.ratio>4&&(o=Math.floor(o*this.ratio)/this.ratio),this.transform.scale=o,this.corner={x:C.left+(n.x-o*e)/2,y:C.top+(n.
y-o*t)/2},this.fitted=!0,this.settle([e,t])}zoom(e,t,n){let{scale:o}=this.transform,{x:s,y:a}=this.corner,i=k(o*e,Math.min(this.width,this.height)/Math.max(...n)/
3,Qt),l=i/o;this.transform.scale=i,this.corner={x:t.x-l*(t.x-s),y:t.y-l*(t.y-a)},this.fitted=!1,this.settle(n)}pan(e,t,n){this.corner.x+=e,this.corner.y+=t,this.
fitted=!1,this.settle(n)}toGrid(e,t){let{scale:n,x:o,y:s}=this.transform;return{x:(e.x-o)/n,y:t-(e.y-s)/n}}fromGrid(e,t){let{scale:n,x:o,y:s}=this.transform;return{
x:o+e.x*n,y:s+(t-e.y)*n}}settle([e,t]){let{scale:n}=this.transform,o=Zt;this.corner.x=k(this.corner.x,o-e*n,this.width-o),this.corner.y=k(this.corner.y,o-t*n,this.
height-o),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var it=[["D, E, S, P","draw, erase, sensor, pan"],["arrows","move the cursor, the sensor or the view; with Shift by five cells"],["Space","draw or erase at the \
cursor; next sensor"],["[ and ]","turn the sensor"],["A, Delete","add, remove a sensor"],["R, Escape","run, cancel"],["M, N, H","show the mean, a draw, the entr\
opy"],["Ctrl+Z, Ctrl+Y","undo, redo"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],en={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[
0,-1]},rt=Math.PI/12,le=class{constructor(e,t,n,o,s){this.canvas=e;this.session=t;this.view=n;this.hand=o;this.editor=s;e.addEventListener("keydown",a=>this.key(
a)),e.addEventListener("blur",()=>o.setCursor(null))}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{session:t,hand:n,editor:o}=this;if(!t.document||e.
ctrlKey||e.metaKey||e.altKey)return;let s=en[e.key],a=e.shiftKey?5:1;if(s)this.arrow(s[0]*a,s[1]*a);else if(e.key===" ")this.space(e);else if(e.key==="["||e.key===
"]"){let i=e.key==="["?rt:-rt;t.editable&&n.sensor&&o.moveSensor(n.sensor,{yaw:n.sensor.yaw+i},void 0,e)}else if(e.key.toLowerCase()==="a"&&t.editable)this.addSensor();else if((e.
key==="Delete"||e.key==="Backspace")&&t.editable)o.removeSensor();else if(e.key==="Escape"&&n.cursor)n.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){
this.editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,t){let{session:n,view:o,hand:s}=this,[a,i]=n.shape;if(s.tool==="se\
nsor"&&s.sensor&&n.document&&n.editable){let{resolution:l}=n.document.grid;s.selected=s.sensor.id,this.editor.moveSensor(s.sensor,{x:s.sensor.x+e*l,y:s.sensor.y+
t*l})}else if(s.tool==="pan"&&n.editable)o.pan(-40*e,40*t,n.shape),n.changed();else{let l=s.cursor??{x:Math.floor(a/2),y:Math.floor(i/2)},c={x:k(l.x+e,0,a-1),y:k(
l.y+t,0,i-1)};s.setCursor(c);let p=o.fromGrid({x:c.x+.5,y:c.y+.5},i),u=(m,g,b)=>m-k(m,g,b),h={x:u(p.x,C.left+10,o.width-20),y:u(p.y,20,o.height-C.bottom-10)};(h.
x||h.y)&&o.pan(-h.x,-h.y,n.shape)}}space(e){let{session:t,hand:n,editor:o}=this;if(t.editable){if(n.tool==="sensor"){let s=t.document?.sensors??[],a=s.findIndex(
i=>i.id===n.sensor?.id);n.select(s[(a+1)%Math.max(1,s.length)]?.id??null),n.selected!==null&&n.announce(`Sensor ${n.selected}`)}else if(n.tool!=="pan"){n.cursor||
this.arrow(0,0);let s=n.cursor,a=n.tool==="draw"&&!o.isWall(s);o.setWalls([s],a,n.nextGesture(),e),n.announce(a?"wall":"free")}}}},ot={d:"draw",e:"erase",s:"sen\
sor",p:"pan"},st={m:"mean",n:"draw",h:"entropy"},at={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function lt(r,e,t){let n=r.composedPath()[0],o=n instanceof
HTMLSelectElement||n instanceof HTMLInputElement&&/number|text/.test(n.type),s=r.key.toLowerCase();if((r.ctrlKey||r.metaKey)&&!r.altKey){if(o||s!=="z"&&s!=="y"||
e.recorded)return;r.preventDefault(),e.act({type:s==="y"||r.shiftKey?"redo":"undo"});return}if(!(o||r.altKey)){if(ot[s]&&e.editable)t.tool(ot[s]);else if(st[s])
t.layer(st[s]);else if(at[r.key])t.command(at[r.key]);else if(s==="r"&&!e.recorded)e.act({type:"run"});else if(r.key==="Escape"&&(e.running||e.sampling))e.act({
type:"cancel"});else return;r.preventDefault()}}var tn='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function B(r,e,t,n,o,s,a=!1){r.font=tn,r.textAlign=s,r.textBaseline=
"middle",a&&(r.strokeStyle=o.halo,r.lineWidth=3,r.strokeText(e,t,n)),r.fillStyle=o.axis,r.fillText(e,t,n)}function Pe({document:r,scan:e}){return r?r.source.kind==="simulation"||!e?r.sensors:Array.from({length:e.pose.length/3},(n,o)=>o).map(n=>({id:n,x:e.pose[3*n],y:e.
pose[3*n+1],yaw:e.pose[3*n+2]})):[]}function ce(r,e,t){let n=t.fromGrid(X(r,e),e.shape[1]),o=k(t.transform.scale*.42,7,13),s=o*2.6,a={x:n.x+s*Math.cos(r.yaw),y:n.
y-s*Math.sin(r.yaw)};return{point:n,size:o,handle:a}}function ct(r,{session:e,view:t,look:n}){let o=e.document;if(!o)return;let{theme:s}=n,a=Pe(e);r.lineJoin="r\
ound";for(let i of a){let l=ce(i,o.grid,t),{point:c,size:p}=l;i.id===n.selected&&nn(r,l,n);let[u,h]=[Math.cos(i.yaw),-Math.sin(i.yaw)],m=(g,b)=>[c.x+p*(g*u-b*h),
c.y+p*(g*h+b*u)];r.beginPath(),r.moveTo(...m(1.25,0)),r.lineTo(...m(-.9,.8)),r.lineTo(...m(-.45,0)),r.lineTo(...m(-.9,-.8)),r.closePath(),r.strokeStyle=s.halo,r.
lineWidth=3,r.stroke(),r.fillStyle=s.sensor,r.fill(),a.length>1&&a.length<100&&B(r,String(i.id),c.x,c.y+p*2+4,s,"center",!0)}}function nn(r,{point:e,size:t,handle:n},{
theme:o}){r.beginPath(),r.moveTo(e.x,e.y),r.lineTo(n.x,n.y),r.moveTo(n.x+4.5,n.y),r.arc(n.x,n.y,4.5,0,2*Math.PI),r.moveTo(e.x+t*1.7,e.y),r.arc(e.x,e.y,t*1.7,0,2*
Math.PI),r.strokeStyle=o.halo,r.lineWidth=4,r.stroke(),r.strokeStyle=o.sensor,r.lineWidth=1.5,r.stroke(),r.beginPath(),r.arc(n.x,n.y,4,0,2*Math.PI),r.fillStyle=
o.halo,r.fill()}var pt={touch:24,other:11},rn=90,pe=class{constructor(e,t,n,o,s,a){this.canvas=e;this.session=t;this.view=n;this.hand=o;this.editor=s;this.embedded=a;let i=(l,c)=>e.
addEventListener(l,c,{passive:!1});i("pointerdown",l=>this.down(l)),i("pointermove",l=>this.move(l)),i("pointerup",l=>this.up(l)),i("pointercancel",l=>this.up(l)),
i("pointerleave",()=>o.point(null)),i("wheel",l=>this.wheel(l)),i("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;at(e){let t=this.canvas.getBoundingClientRect();
return{x:e.clientX-t.left,y:e.clientY-t.top}}cellAt(e){let t=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(t.x),y:Math.floor(t.y)}}metres(e,{grid:t}){
return Te(this.view.toGrid(e,t.shape[1]),t)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:t,hand:n}=this,{document:o}=t;if(!o)return;e.preventDefault(),
this.canvas.focus({preventScroll:!0}),n.setCursor(null),this.canvas.setPointerCapture(e.pointerId);let s=this.at(e);if(this.fingers.set(e.pointerId,s),this.fingers.
size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;if(e.button===1||n.tool==="pan"||!t.editable)return this.begin({kind:"pan",last:s});
let a=this.gripAt(s,e,o);if(a)this.begin(a),a.kind==="sensor"&&n.select(a.id);else if(n.tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(s,o)}):
n.sensor&&(n.selected=n.sensor.id,this.begin({kind:"sensor",id:n.sensor.id,drag:n.nextGesture(),grip:{x:0,y:0}}),this.dragSensor(e));else{let i=n.tool==="draw"!==
(e.button===2||e.shiftKey);this.begin({kind:"stroke",id:n.nextGesture(),wall:i,last:this.cellAt(s),held:e}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.
release(),rn)}}gripAt(e,t,n){let{hand:o,view:s}=this,a=t.pointerType==="touch"?pt.touch:pt.other,i=h=>Math.hypot(e.x-h.x,e.y-h.y),l=o.tool==="sensor"&&o.sensor?
ce(o.sensor,n.grid,s):null;if(l&&o.sensor&&i(l.handle)<Math.min(a,i(l.point)))return{kind:"turn",id:o.sensor.id,drag:o.nextGesture()};if(t.button!==0||o.tool===
"erase")return null;let c=n.sensors.map(h=>({id:h.id,...ce(h,n.grid,s)}));c.sort((h,m)=>i(h.point)-i(m.point));let p=c.find(({point:h,size:m})=>i(h)<Math.max(a,
m));if(!p)return null;let u={x:p.point.x-e.x,y:p.point.y-e.y};return{kind:"sensor",id:p.id,drag:o.nextGesture(),grip:u}}release(){if(this.gesture?.kind!=="strok\
e"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.gesture.last],e)}move(e){let{gesture:t,session:n,view:o,hand:s}=this,
a=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,a),!t)s.point(this.cellAt(a));else if(t.kind==="stroke"){this.release();let i=[],l=e.
getCoalescedEvents?.()??[];for(let c of l.length?l:[e]){let p=this.cellAt(this.at(c));i.push(...Je(t.last,p)),t.last=p}this.stroke(i,e),s.point(t.last)}else if(t.
kind==="sensor")this.dragSensor(e);else if(t.kind==="turn"){let i=n.document?.sensors.find(c=>c.id===t.id);if(!i||!n.document)return;let l=this.metres(a,n.document);
this.editor.moveSensor(i,{yaw:Math.atan2(l.y-i.y,l.x-i.x)},t.drag,e)}else if(t.kind==="pan")o.pan(a.x-t.last.x,a.y-t.last.y,n.shape),t.last=a,n.changed();else if(this.
fingers.size===2){let{middle:i,spread:l}=this.spread();o.pan(i.x-t.middle.x,i.y-t.middle.y,n.shape),o.zoom(l/t.spread,i,n.shape),Object.assign(t,{middle:i,spread:l}),
n.changed()}}up(e){e.type==="pointerup"&&this.release(),this.fingers.delete(e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1),e.pointerType===
"touch"&&this.hand.point(this.cellAt(this.at(e)))}spread(){let[e,t]=[...this.fingers.values()];return{middle:{x:(e.x+t.x)/2,y:(e.y+t.y)/2},spread:Math.max(10,Math.
hypot(e.x-t.x,e.y-t.y))}}wheel(e){if(!this.session.document)return;let t=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!t)
return;e.preventDefault();let n=e.deltaMode===1?16:1;e.shiftKey?this.view.pan(-n*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-n*e.deltaY*
(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.changed()}stroke(e,t){let{session:n,gesture:o}=this;o?.kind==="stroke"&&(this.editor.setWalls(
e,o.wall,o.id,t),n.status.level==="error"&&n.say("Ready"))}dragSensor(e){let{gesture:t,session:n}=this,{document:o}=n;if(t?.kind!=="sensor"||!o)return;this.hand.
point(null);let s=o.sensors.find(l=>l.id===t.id),a=this.at(e),i=this.metres({x:a.x+t.grip.x,y:a.y+t.grip.y},o);s&&this.editor.moveSensor(s,i,t.drag,e)}};var on=5,de=class{name="cursor";depends({session:e,look:t}){return[t.hover?.x,t.hover?.y,t.cursor?.x,t.cursor?.y,e.shape[1]]}paint(e,{session:t,view:n,look:o}){
let{theme:s}=o;e.beginPath(),e.rect(C.left,0,n.width,n.height-C.bottom),e.clip(),o.hover&&dt(e,o.hover,t.shape[1],n,s,s.axis,1.5),o.cursor&&dt(e,o.cursor,t.shape[1],
n,s,s.ray,2.5)}};function dt(r,e,t,n,o,s,a){let{scale:i}=n.transform,l=n.fromGrid({x:e.x,y:e.y+1},t),c=Math.max(i,on),[p,u]=[l.x-(c-i)/2,l.y-(c-i)/2];r.lineWidth=
a+2,r.strokeStyle=o.halo,r.strokeRect(p,u,c,c),r.lineWidth=a,r.strokeStyle=s,r.strokeRect(p,u,c,c)}var sn={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},an={paper:[17,0,-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"\
#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a\
3abb8",ground:"#12151a"},me={light:sn,dark:an},ht="00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function ln([
r,e,t]){let n=(r+16)/116,o=[.95047,1,1.08883],[s,a,i]=[n+e/500,n,n-t/200].map((l,c)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*o[c]);
return[3.2404542*s-1.5371385*a-.4985314*i,-.969266*s+1.8760108*a+.041556*i,.0556434*s-.2040259*a+1.0572252*i].map(l=>{let c=k(l,0,1);return Math.round(255*(c<=.0031308?
12.92*c:1.055*c**(1/2.4)-.055))})}var he=(r,e=1)=>[0,2,4].map(t=>parseInt(r.slice(e+t,e+t+2),16)),Ce=(r,e,t)=>r.map((n,o)=>n+t*(e[o]-n)),Ee=(r,e)=>ln(Ce(r.paper,
r.ink,e));function Ae(r){let e=Math.min(15,Math.floor(r*16));return Ce(he(ht,6*e),he(ht,6*e+6),r*16-e)}function mt(r,e){let t=new Uint8ClampedArray(2048).fill(255),
[n,o]=[he(r.unobserved),he(r.unobservedWall)];for(let s=0;s<256;s++)t.set(e?Ae(se(s/255)):Ee(r,s/255),4*s),t.set(Ce(n,o,e?0:s/255),4*(s+256));return new Uint32Array(
t.buffer)}var ut=r=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${r(e).map(Math.round)})`)})`;var ue=class{paints={};sheets;constructor(e,t){this.sheets=e.map((n,o)=>({layer:n,canvas:t[o],context:t[o].getContext("2d"),before:[]}));for(let{name:n}of e)this.
paints[n]=0}paint(e){let{width:t,height:n,ratio:o,transform:s}=e.view;if(!t||!n)return;let a={width:Math.max(1,Math.ceil(t*o)),height:Math.max(1,Math.ceil(n*o))},
i=[e.look.theme,t,n,o,s.scale,s.x,s.y];for(let l of this.sheets){let{canvas:c,context:p,layer:u}=l,h=[...i,...u.depends(e)];h.length===l.before.length&&h.every(
(m,g)=>Object.is(m,l.before[g]))||(l.before=h,(c.width!==a.width||c.height!==a.height)&&(Object.assign(c,a),c.style.width=`${a.width/o}px`,c.style.height=`${a.height/
o}px`),p.setTransform(1,0,0,1,0,0),p.clearRect(0,0,c.width,c.height),p.setTransform(o,0,0,o,0,0),p.save(),u.paint(p,e),p.restore(),this.paints[u.name]++)}}};function H(r,{
session:e,view:t}){let[n,o]=e.shape,{scale:s,x:a,y:i}=t.transform;r.beginPath(),r.rect(a,i,n*s,o*s),r.clip()}var cn=10,pn=7,fe=()=>document.createElement("canvas").getContext("2d"),G=class{name="field";cells=fe();mask=fe();hatch=fe();palettes=new Map;image=new ImageData(
1,1);drawn={field:null,bits:null,palette:"",hatch:""};depends({session:e}){return[e.shown,e.view.layer==="entropy",...e.shape,e.document===null]}paint(e,t){let{
session:n,view:o,look:s}=t;if(!n.document)return;let[a,i]=n.shape,{scale:l,x:c,y:p}=o.transform;H(e,t);let u=n.shown;if(!u||u.p.length!==a*i){e.fillStyle=s.theme.
unobserved,e.fillRect(c,p,a*l,i*l);return}this.fill(u,a,i,s.theme,n.view.layer==="entropy"&&u.layer!=="draw"),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.
canvas,c,p,a*l,i*l),this.fillHatch(t),e.drawImage(this.hatch.canvas,0,0,this.hatch.canvas.width/o.ratio,this.hatch.canvas.height/o.ratio),l>=cn&&this.lines(e,t)}fill(e,t,n,o,s){
let{cells:a,mask:i,drawn:l}=this,c=`${o.ground} ${s}`;if(l.field===e&&l.palette===c)return;let p=this.palettes.get(c)??mt(o,s);if(this.palettes.set(c,p),this.image.
width!==t||this.image.height!==n){this.image=new ImageData(t,n);for(let{canvas:h}of[a,i])Object.assign(h,{width:t,height:n});l.bits=null}let u=new Uint32Array(this.
image.data.buffer);for(let h=0,m=0;h<n;h++)for(let g=n-1-h;g<t*n;g+=n)u[m++]=p[e.p[g]+(e.observed[g]?0:256)];if(a.putImageData(this.image,0,0),l.bits!==e.bits){
for(let h=0,m=0;h<n;h++)for(let g=n-1-h;g<t*n;g+=n)u[m++]=e.observed[g]?0:4278190080;i.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,bits:e.bits,
palette:c})}fillHatch({session:e,view:t,look:n}){let{hatch:o,mask:s,drawn:a}=this,{ratio:i,width:l,height:c}=t,{scale:p,x:u,y:h}=t.transform,[m,g]=e.shape,b=[n.
theme.ground,p,u,h,l,c,i].join(" ");if(a.hatch===b)return;a.hatch=b;let w=fe(),S=w.canvas.width=w.canvas.height=Math.round(pn*i);w.strokeStyle=n.theme.hatch,w.lineWidth=
i,w.beginPath();for(let f of[-S,0,S])w.moveTo(f-1,S+1),w.lineTo(f+S+1,-1);w.stroke(),Object.assign(o.canvas,{width:Math.ceil(l*i),height:Math.ceil(c*i)}),o.setTransform(
i,0,0,i,0,0),o.imageSmoothingEnabled=!1,o.drawImage(s.canvas,u,h,m*p,g*p),o.globalCompositeOperation="source-in",o.setTransform(1,0,0,1,0,0);let T=o.createPattern(
w.canvas,"repeat");T.setTransform(new DOMMatrix().translate(Math.round(u*i),Math.round(h*i))),o.fillStyle=T,o.fillRect(0,0,o.canvas.width,o.canvas.height)}lines(e,{
session:t,view:n,look:o}){let[s,a]=t.shape,{scale:i,x:l,y:c}=n.transform;e.beginPath();for(let p=1;p<s;p++)e.moveTo(l+p*i,c),e.lineTo(l+p*i,c+a*i);for(let p=1;p<
a;p++)e.moveTo(l,c+p*i),e.lineTo(l+s*i,c+p*i);e.strokeStyle=o.theme.lines,e.lineWidth=1,e.stroke()}};var dn=46;function hn(r){let e=10**Math.floor(Math.log10(r));return e*([1,2,5].find(t=>t*e>=r)??10)}function ft(r,{session:e,view:t,look:n}){if(!e.document)return;
let{theme:o}=n,{width:s,height:a}=t,{origin:i,resolution:l,shape:c}=e.document.grid,{scale:p,x:u,y:h}=t.transform,m=hn(dn/p*l),g=Math.min(h+c[1]*p,a-C.bottom)+.5,
b=Math.max(u,C.left)-.5;r.fillStyle=o.ground,u<b&&r.fillRect(0,0,b,a+1),h+c[1]*p>g&&r.fillRect(0,g,s+1,a+1-g);let w=Math.max(0,-Math.floor(Math.log10(m)+1e-9));
r.strokeStyle=o.frame,r.lineWidth=1,r.beginPath();let S=f=>Math.ceil(i[f]/m-1e-9)*m,T=f=>i[f]+c[f]*l+1e-9;for(let f=S(0);f<=T(0);f+=m){let v=u+(f-i[0])/l*p;v<b||
v>s-4||(r.moveTo(v,g),r.lineTo(v,g+4),B(r,f.toFixed(w),v,g+12,o,"center"))}for(let f=S(1);f<=T(1);f+=m){let v=h+(c[1]-(f-i[1])/l)*p;v>g||v<4||(r.moveTo(b,v),r.lineTo(
b-4,v),B(r,f.toFixed(w),b-7,v,o,"right"))}r.stroke(),B(r,"m",b-7,g+12,o,"right")}var j=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:t}){let n=Pe(e).flatMap(({id:a,x:i,y:l,yaw:c})=>[a,i,l,c]),{grid:o}=e.document??{},
s=gt(e)&&t.truth&&e.wallsVersion;return[o&&[...o.shape,...o.origin,o.resolution].join(),s,t.selected,...n]}paint(e,t){let{session:n,view:o,look:s}=t;if(!n.document)
return;let[a,i]=n.shape,{scale:l,x:c,y:p}=o.transform;s.truth&&gt(n)&&this.truth(e,t),e.strokeStyle=s.theme.frame,e.lineWidth=1,e.strokeRect(c-.5,p-.5,a*l+1,i*l+
1),ct(e,t),ft(e,t)}truth(e,t){let{session:n,view:o,look:s}=t,{scale:a,x:i,y:l}=o.transform;this.edgesOf!==n.wallsVersion&&(this.edges=Ze(n.walls,n.shape),this.edgesOf=
n.wallsVersion),e.save(),H(e,t),e.transform(a,0,0,-a,i,l+n.shape[1]*a),e.lineCap="square",e.strokeStyle=s.theme.truth,e.lineWidth=k(a*.09,1,2.5)/a,e.stroke(this.
edges),e.restore()}},gt=({document:r})=>r?.source.kind==="simulation";var mn=600,z=class{name="rays";depends({session:e,look:t}){return[e.scan,e.document?.max_range,t.rays,t.readings]}paint(e,t){let{session:n,view:o,look:s}=t,{scan:a,
document:i}=n;if(!a||!i||!(s.rays||s.readings))return;H(e,t);let{scale:l}=o.transform,c=1/i.grid.resolution,p=i.grid.shape[1],u=a.angles.length,h=a.pose.length/
3,[m,g,b]=[new Path2D,new Path2D,new Path2D],w=k(l*.1,1.3,4);for(let S=0;S<h;S++){let[T,f,v]=a.pose.subarray(3*S,3*S+3),E=o.fromGrid(X({x:T,y:f},i.grid),p);for(let A=0;A<
u;A++){let R=a.ranges[S*u+A],V=a.exact.length?a.exact[S*u+A]:R,$=Number.isFinite(R)&&V<i.max_range,K=($?R:i.max_range)*c*l,I=a.angles[A]+v,L={x:E.x+K*Math.cos(I),
y:E.y-K*Math.sin(I)},q=$?m:g;q.moveTo(E.x,E.y),q.lineTo(L.x,L.y),$&&(u*h>mn?b.rect(L.x-.9*w,L.y-.9*w,1.8*w,1.8*w):(b.moveTo(L.x+w,L.y),b.arc(L.x,L.y,w,0,2*Math.
PI)))}}s.rays&&(e.lineWidth=1,e.globalAlpha=k(28/Math.sqrt(u*h)/5,.07,.45),e.strokeStyle=s.theme.ray,e.stroke(m),e.strokeStyle=s.theme.noReturn,e.stroke(g),e.globalAlpha=
1),s.readings&&(e.fillStyle=s.theme.ray,e.fill(b))}};var yt=900,Z=2;function bt({session:r,look:e}){let[t,n]=r.shape,o=new F;o.resize(yt,Math.round(k(yt*n/t,300,1800)),Z),o.fit(r.shape);let s=document.createElement(
"canvas");Object.assign(s,{width:o.width*Z,height:o.height*Z});let a=s.getContext("2d");a.scale(Z,Z),a.fillStyle=e.theme.ground,a.fillRect(0,0,o.width,o.height);
let i=[new G,new z,new j];for(let l of i)a.save(),l.paint(a,{session:r,view:o,look:{...e,hover:null,cursor:null,selected:null}}),a.restore();return new Promise(
l=>s.toBlob(l))}function d(r,e={},...t){let n=document.createElement(r);for(let[o,s]of Object.entries(e))o.startsWith("on")?n.addEventListener(o.slice(2),s):o.includes("-")||o===
"role"||o==="for"?n.setAttribute(o,s):n[o]=s;for(let o of t)o!==null&&n.append(o);return n}function y(r,e,t){r[e]!==t&&(r[e]=t)}function D(r,e,t){r.getAttribute(
e)!==t&&r.setAttribute(e,t)}var Q=r=>r.getRootNode().activeElement===r,ee=(r,e,t="")=>r==null||!Number.isFinite(r)?"–":r.toFixed(e)+t;function Le(r,e){let t=URL.
createObjectURL(e);d("a",{href:t,download:r}).click(),setTimeout(()=>URL.revokeObjectURL(t),1e4)}var un=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"]];function wt(r){let{hand:e,session:t}=r,n=r.segmented(
"Tool",un,()=>t.editable||!t.document?e.tool:"pan",o=>e.choose(o),o=>t.editable||o==="pan");return r.visible(n,()=>!t.document||t.editable),d("div",{className:"\
bar"},n,d("span",{className:"space"}),r.button("minus","Zoom out",()=>r.command("out"),{title:"Zoom out (−)"}),r.button("plus","Zoom in",()=>r.command("in"),{
title:"Zoom in (+)"}),r.button("fit","Whole map",()=>r.command("fit"),{title:"Whole map (0)"}))}var fn=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],gn=["Draw walls, and drag the robot: a beam reads the first wall that it \
hits, with noise. Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (draw), and where doubt remains\
 (entropy). No beam has been where it is hatched.","While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact\
 in the long run."],yn="Mouse: the wheel zooms, the middle button pans, Shift or the right button erases. Touch: two fingers zoom and pan.";function xt(r){let e=it.
map(([n,o])=>d("tr",{},d("th",{scope:"row"},d("kbd",{textContent:n})),d("td",{textContent:o}))),t=gn.map(n=>d("p",{textContent:n}));return r.dialog("Help",...t,
d("table",{},d("tbody",{},...e)),d("p",{textContent:yn}))}function vt(r){let e=()=>d("input",{type:"number",min:P.cells[0],max:P.cells[1],step:1,required:!0,value:"\
21"}),[t,n]=[e(),e()],o=d("select",{});for(let[a,i]of fn)o.append(d("option",{value:a,textContent:i}));o.addEventListener("change",()=>{o.value==="building"&&Number(
t.value)<60&&([t.value,n.value]=["120","80"])});let s=d("form",{method:"dialog"},r.row("World",o),r.row("Width (cells)",t),r.row("Height (cells)",n),d("div",{className:"\
buttons end"},d("button",{type:"submit",className:"primary",textContent:"Create"})));return s.addEventListener("submit",()=>{r.session.act({type:"new",shape:[Number(
t.value),Number(n.value)],world:o.value}),r.hand.selected=null}),r.dialog("New map",s)}function kt(r){let e=d("input",{type:"text",readOnly:!0,"aria-label":"Lin\
k"}),t=d("span",{role:"status",className:"copied"}),n=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{document.execCommand("copy")}t.
textContent="Copied",setTimeout(()=>t.textContent="",2e3)},o=r.button(null,"Copy the link",n,{className:"primary",text:"Copy"}),a=r.dialog("Share",d("p",{textContent:"\
The link holds the walls, the sensors and all settings after its #. It opens on this server while it runs; the part from # on can be put after the address of an\
y bayesmap page."}),d("div",{className:"buttons"},e,o),t);return{dialog:a,show(i){e.value=i,a.showModal(),e.select()}}}function Mt(r){let{session:e}=r,t=d("span",{className:"what"});r.each(()=>{let{grid:c,source:p}=e.document??{};if(!c||!p)return;let u=`${c.shape[0]} × ${c.shape[1]}\
 cells of ${+c.resolution.toPrecision(3)} m`;y(t,"textContent",p.name?`${p.name}, ${u}`:u)});let n=()=>!e.recorded&&!!e.document,o=[r.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo}),r.button("redo","Redo",()=>e.act({type:"redo"}),{title:"Redo (Ctrl+Y)",when:()=>!!e.state?.
can_redo}),d("span",{className:"gap"}),r.button("grid","New map",()=>r.command("new"),{text:"New map",when:n}),...r.embedded?[]:[r.button("link","Share",()=>r.command(
"share"),{text:"Share",when:n})]];for(let c of o)r.visible(c,()=>!e.recorded);let s=r.button("theme","Theme: automatic",()=>r.command("theme")),a=r.button("help",
"Help",()=>r.command("help"),{title:"Help (?)"}),i=d("span",{className:"space"});return{element:d("header",{},d("h1",{textContent:"bayesmap"}),t,i,...o,bn(r),s,
a),nameTheme(c){let p=`Theme: ${c}`;D(s,"aria-label",p),y(s,"title",p)}}}function bn(r){let{session:e}=r,t=(i,l,c)=>{let p=r.button(null,i,()=>r.command(`export\
 ${l}`),{text:i});return c&&r.visible(p,()=>!e.recorded),p},n=d("div",{className:"menu",hidden:!0},t("Picture (PNG)","png",!1),t("Saved run (netCDF)","run",!0),
t("Map for robots (YAML and PGM)","map",!0),t("Page with its draws (HTML)","html",!0),t("Document (JSON)","document",!0)),o=r.button("save","Export",()=>s(n.hidden),
{text:"Export",when:()=>!!e.document}),s=i=>{n.hidden=!i,o.setAttribute("aria-expanded",String(i)),i&&n.firstElementChild.focus()};s(!1);let a=d("div",{className:"\
anchor"},o,n);return a.addEventListener("keydown",i=>{i.key!=="Escape"||n.hidden||(s(!1),o.focus(),i.stopPropagation())}),a.addEventListener("focusout",i=>{a.contains(
i.relatedTarget)||s(!1)}),n.addEventListener("click",()=>{s(!1),o.focus()}),a}var wn={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 \
9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M1\
5.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",
grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"\
M6 6l12 12M18 6L6 18"};function O(r){let e=document.createElementNS("http://www.w3.org/2000/svg","svg"),t=document.createElementNS("http://www.w3.org/2000/svg",
"path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true"),t.setAttribute("d",wn[r]),e.append(t),e}var xn=[["truth","true wall"],["ray","ray"],["miss","no return"],["dot","reading"],["sensor","sensor"],["unobserved","unobserved"]];function St(r,e){let{session:t}=r,
n=d("span",{className:"ramp"}),o=d("span"),s=xn.map(([i,l])=>{let c=d("i",{className:i});return i==="sensor"&&c.append(O("sensor")),d("li",{},c,l)});r.visible(s[0],
()=>!t.document||t.document.source.kind==="simulation");let a="";return r.each(()=>{let i=t.view.layer==="entropy";y(o,"textContent",i?"entropy (bit)":"P(wall)");
let l=`${i} ${e().ground}`;a!==l&&(a=l,n.style.background=ut(i?Ae:c=>Ee(e(),c)))}),d("ul",{className:"legend","aria-label":"Legend"},d("li",{},o,"0",n,"1"),...s)}function Pt(r){let{session:e}=r,t=d("div",{className:"chip"});return r.each(()=>{let n=e.shown;if(!n||!e.document)return y(t,"hidden",!0);let o=e.draws.count?`d\
raw ${e.draw+1} of ${e.draws.count}`:"draw",s=n.layer==="draw"?o:e.view.layer==="entropy"?"entropy":"mean",a={importance:"importance sampling",propagate:"belief\
 propagation"}[n.method],i=n.approximate?"approximate, belief propagation":a??`${n.sweeps} sweeps`;y(t,"hidden",!1),y(t,"textContent",`${s} · ${i}`),y(t,"class\
Name",n.approximate?"chip approximate":"chip")}),t}function Ct(r){let{session:e}=r,t=d("span"),n=r.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"\
Reconnect now"}),o=d("div",{className:"banner",role:"alert",hidden:!0},t,n);return r.each(()=>{let s=e.everConnected&&!e.connection.connected,a=Math.max(1,Math.
round((e.connection.retryIn_ms??0)/1e3));y(o,"hidden",!s&&e.worker!=="restarted"),y(o,"className",s?"banner":"banner mild"),y(n,"hidden",!s);let i=`Connection l\
ost. Trying again in ${a} s; the map is kept here.`;y(t,"textContent",s?i:"The worker stopped and is being started again. The map is kept.")}),o}function Et(r){
let{session:e,hand:t}=r,n=d("div",{className:"readout",id:`${r.prefix}-readout`}),o=d("span",{role:"status","aria-live":"polite"}),s=d("span",{className:"hidden",
"aria-live":"polite"});return t.announce=a=>y(s,"textContent",a),t.describe=a=>Tt(e,a),r.each(()=>{let a=t.cursor??t.hover,l=e.editable&&!matchMedia("(pointer: \
coarse)").matches?"Point at a cell, or press ? for the keys":"Point at a cell";y(n,"textContent",a?Tt(e,a):l),y(o,"textContent",e.status.text),y(o,"className",e.
status.level)}),{element:d("footer",{},o,n,s),readout:n}}function Tt(r,e){let{document:t,shown:n}=r;if(!t)return"";let{resolution:o,shape:s}=t.grid,a=e.x*s[1]+e.
y,i=Math.max(1,Math.ceil(-Math.log10(o))+1),{x:l,y:c}=oe(e,t.grid),p=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(i)}, ${c.toFixed(i)} m`];if(n&&n.p.length===s[0]*s[1]){
let u=n.p[a]/255;n.layer==="draw"?p.push(u>.5?"wall in this draw":"free in this draw"):p.push(`P(wall) ${u.toFixed(2)}`,`entropy ${se(u).toFixed(2)} bit`);let h=r.
cell?.x===e.x&&r.cell.y===e.y?r.cell.beams:null;n.observed[a]?h!==null&&p.push(h===1?"1 beam":`${h} beams`):p.push("unobserved")}return p.join(" · ")}var Ne=r=>r.charAt(0).toUpperCase()+r.slice(1),ge=class{text="Connecting";level="info";until=0;say(e,t,n){this.text=Ne(e),this.level=t,this.until=n}confirmed(e){
let t=this.level!=="info"&&e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||t)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say(
"The worker stopped and is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):
e==="ready"&&/worker/.test(this.text)&&this.say("The worker runs again","info",this.until)}};var vn={importance:"particles",propagate:"rounds"};function At(r){let{session:e}=r,t=d("progress",{max:1,value:0,"aria-label":"Progress"}),n=d("div",{className:"\
doing"});return r.each(()=>{let o=e.shown,s=o&&o.total>0&&!o.approximate?o.sweeps/o.total:0;y(t,"value",s);let a=e.remaining_s(),i=vn[o?.method??""]??"sweeps",l=o&&
!o.approximate&&o.total?`${o.sweeps} of ${o.total} ${i}`:"",c=a!==null?a<1?"less than 1 s left":`${Math.ceil(a)} s left`:e.running?"running":"";y(n,"textContent",
Ne([l,c].filter(Boolean).join(", "))||"No chain yet")}),r.section("Posterior",kn(r),t,n,Mn(r),Sn(r))}function kn(r){let{session:e}=r,t=r.button("play","Run",()=>e.
act({type:"run"}),{className:"primary",text:"Run",title:"Run (R)"}),n=r.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",
when:()=>e.running||e.sampling}),o=r.checkbox("Live",()=>!!(e.state?.live??!0),a=>e.act({type:"live",on:a}),"Every edit restarts the chain"),s=d("div",{className:"\
buttons"},t,n,o);return r.visible(s,()=>!e.recorded&&e.document?.source.kind!=="run"),s}function Mn(r){let{session:e}=r,t=d("dl"),n=(o,s,a)=>{let i=d("dd",{textContent:"\
–"});t.append(d("div",{title:s},d("dt",{textContent:o}),i)),r.each(()=>y(i,"textContent",e.shown?a(e.shown):"–"))};return n("ESS","Effective sample size of \
the log joint",o=>ee(o.ess,0)),n("R-hat","Agreement of the chains on the log joint; 1 is full",o=>ee(o.rhat,3)),n("log joint","Log of prior times likelihood at \
the last sweep",o=>ee(o.log_joint,1)),n("reply","From the hand's last move to its picture",()=>ee(e.latency.eventToPaint_ms.at(-1),0," ms")),t}function Sn(r){let{
progress:e}=r.session,t=document.createElementNS("http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","polyline"),o={viewBox:"\
0 0 100 30",preserveAspectRatio:"none",class:"trace",role:"img","aria-label":"Log joint by sweep"};for(let[a,i]of Object.entries(o))t.setAttribute(a,i);t.append(
n);let s=-1;return r.each(()=>{let{joint:a}=e;if(a.length===s)return;s=a.length;let i=a.filter((b,w)=>w%Math.ceil(a.length/200)===0||w===a.length-1),l=i.map(b=>b[1]),
[c,p]=[Math.min(...l),Math.max(...l)],[u,h]=[i[0]?.[0]??0,i.at(-1)?.[0]??1],m=b=>(100*(b-u)/(h-u||1)).toFixed(1),g=b=>(28-26*(b-c)/(p-c||1)).toFixed(1);n.setAttribute(
"points",i.length>1?i.map(([b,w])=>`${m(b)},${g(w)}`).join(" "):"")}),t}var Tn={gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Pn={raster:"raster",radial:"ra\
dial",random:"random"},Cn={importance:"Particles",propagate:"Rounds"};function Lt(r){let{session:e,hand:t,editor:n}=r,o=d("select",{"aria-label":"Selected senso\
r"});o.addEventListener("change",()=>{t.selected=Number(o.value),t.choose("sensor")});let s="";r.each(()=>{let u=e.document?.sensors??[],h=u.map(m=>m.id).join();
h!==s&&o.replaceChildren(...u.map(({id:m})=>d("option",{value:String(m),textContent:`Sensor ${m}`}))),s=h,y(o,"value",String(t.sensor?.id??""))});let a=(u,h)=>r.
numberInput(u,()=>Number((t.sensor?.[h]??0).toFixed(2)),m=>t.sensor&&n.moveSensor(t.sensor,{[h]:m}),{step:"any"}),i=r.numberInput("heading (°)",()=>Math.round(
(t.sensor?.yaw??0)*180/Math.PI),u=>t.sensor&&n.moveSensor(t.sensor,{yaw:u%360*Math.PI/180}),{step:5}),l=r.button("plus","Add a sensor",()=>r.command("add"),{text:"\
Add"}),c=r.button("minus","Remove the sensor",()=>n.removeSensor(),{text:"Remove",when:()=>(e.document?.sensors.length??0)>1}),p=d("div",{className:"triple"},a(
"x (m)","x"),a("y (m)","y"),i);return r.section("Sensors",d("div",{className:"buttons"},o,l,c),p)}function Nt(r){let{session:e}=r,[t,n]=P.max_range,o=r.numberInput(
"Longest range (m)",()=>e.document?.max_range??0,i=>r.set({max_range:i}),{min:t,max:n,step:"any"}),s=[r.slider("noise",()=>"Noise (m)",{low:P.noise[0],high:P.noise[1],
step:.01,unit:" m"}),r.slider("angles",()=>"Angles",{low:P.angles[0],high:P.angles[1],step:1,log:!0}),o];for(let i of s)r.visible(i,()=>e.editable);let a=r.slider(
"prior",()=>"Prior P(wall)",{low:P.prior[0],high:P.prior[1],step:.01});return r.section("Model",a,...s)}function Rt(r){let{session:e}=r,t=()=>e.document?.method??
"gibbs",[n,o]=P.seed;return r.section("Inference",r.select("Method",Tn,t,s=>r.set({method:s})),r.select("Order",Pn,()=>e.document?.order??"radial",s=>r.set({order:s}),
()=>t()==="gibbs"),r.slider("sweeps",()=>Cn[t()]??"Sweeps",{low:P.sweeps[0],high:P.sweeps[1],step:1,log:!0}),r.numberInput("Seed",()=>e.document?.seed??0,s=>r.set(
{seed:Math.round(s)}),{min:n,max:o,step:1}))}function Dt(r){let{session:e}=r,t=r.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear w\
alls",when:()=>e.editable}),n=r.button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return r.section("Clear",d("d\
iv",{className:"buttons"},t,n))}var En=0,ye=class{constructor(e,t,n,o,s,a){this.session=e;this.hand=t;this.editor=n;this.command=o;this.showLayer=s;this.embedded=a}prefix=`bayesmap${En++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}endDrag(){
this.drag++}visible(e,t){this.each(()=>y(e,"hidden",!t()))}button(e,t,n,{className:o="",text:s="",when:a,title:i}={}){let l=d("button",{type:"button",className:o,
title:i??t,onclick:n},e&&O(e));return s&&l.append(d("span",{textContent:s})),s!==t&&l.setAttribute("aria-label",t),a&&this.each(()=>y(l,"disabled",!a())),l}segmented(e,t,n,o,s){
let a=`${this.prefix}-${e.replace(/\W/g,"")}`,i=d("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[l,c,p]of t){let u=d("input",{type:"rad\
io",name:a,value:l,onchange:()=>o(l)});i.append(d("label",{title:c},u,p?O(p):null,d("span",{textContent:c}))),this.each(()=>{y(u,"checked",n()===l),s&&y(u,"disa\
bled",!s(l))})}return i}section(e,...t){let n=`${this.prefix}-${e}`;return d("section",{"aria-labelledby":n},d("h2",{id:n,textContent:e}),...t)}row(e,t){return t.
id=`${this.prefix}-${e.replace(/\W/g,"")}`,d("div",{className:"row"},d("label",{for:t.id,textContent:e}),t)}slider(e,t,{low:n,high:o,step:s,log:a=!1,unit:i=""}){
let l=`${this.prefix}-${e}`,c=g=>a?1e3*Math.log(g/n)/Math.log(o/n):g,p=g=>{if(!a)return g;let b=n*(o/n)**(g/1e3),w=b<100?1:10**(Math.floor(Math.log10(b))-1);return k(
Math.round(b/w)*w,n,o)},u=d("label",{for:l}),h=d("input",{type:"range",id:l,...a?{min:0,max:1e3,step:1}:{min:n,max:o,step:s}}),m=d("input",{type:"number",min:String(
n),max:String(o),step:String(s)});return h.addEventListener("input",()=>this.set({[e]:p(Number(h.value))})),h.addEventListener("change",()=>this.endDrag()),m.addEventListener(
"change",()=>{let g=Number(m.value);m.value===""||!Number.isFinite(g)?m.value=String(this.session.document?.[e]):this.set({[e]:a?Math.round(k(g,n,o)):k(g,n,o)}),
this.endDrag()}),this.each(()=>{let g=this.session.document?.[e]??n;y(u,"textContent",t()),D(m,"aria-label",`${t()}, number`),p(Number(h.value))!==g&&(h.value=String(
c(g))),D(h,"aria-valuetext",`${g}${i}`);let b=100*(c(g)-Number(h.min))/(Number(h.max)-Number(h.min));h.style.setProperty("--fill",`${k(b,0,100)}%`),Q(m)||y(m,"v\
alue",String(g))}),d("div",{className:"row slider"},u,h,m)}select(e,t,n,o,s){let a=d("select",{onchange:()=>o(a.value)});for(let[i,l]of Object.entries(t))a.append(
d("option",{value:i,textContent:l}));return this.each(()=>{y(a,"value",n()),s&&y(a,"disabled",!s())}),this.row(e,a)}numberInput(e,t,n,o={}){let s=d("input",{type:"\
number",...o}),{min:a=-1/0,max:i=1/0}=o;return s.addEventListener("change",()=>{s.value!==""&&Number.isFinite(Number(s.value))&&n(k(Number(s.value),a,i))}),this.
each(()=>{Q(s)||y(s,"value",String(t()))}),this.row(e,s)}checkbox(e,t,n,o=""){let s=d("input",{type:"checkbox",onchange:()=>n(s.checked)});return this.each(()=>y(
s,"checked",t())),d("label",{className:"check",title:o},s,d("span",{textContent:e}))}dialog(e,...t){let n=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,o=d("bu\
tton",{type:"button",className:"plain","aria-label":"Close",onclick:()=>a.close()},O("close")),s=d("div",{className:"title"},d("h2",{id:n,textContent:e}),o),a=d(
"dialog",{"aria-labelledby":n},s,...t);return a.addEventListener("click",i=>{i.target===a&&a.close()}),a.addEventListener("keydown",i=>i.stopPropagation()),a}};var An=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"]],Ln=90,be=class{constructor(e){this.session=e}playing=!1;showLayer(e){if(e!=="draw")this.play(
!1);else if(!this.session.hasDraws)return;this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,t=this.session.view.chain){this.session.
act({type:"view",layer:"draw",chain:t,draw:e})}play(e){if(this.playing=e,e){let{draw:t,draws:n}=this.session;this.showDraw(t>=n.count-1?0:t)}this.session.changed()}step(){
!this.playing||this.session.shown?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:e,draws:t}=this.session;e+1>=t.count?this.play(!1):this.showDraw(
e+1)},Ln)}};function Ut(r,e,t){let{session:n}=r,o=r.segmented("Show",An,()=>n.view.layer,l=>e.showLayer(l),l=>l!=="draw"||n.hasDraws),s=(l,c)=>r.checkbox(l,()=>t[c],
p=>{t[c]=p,n.changed()}),a=s("True walls","truth");r.visible(a,()=>!n.document||n.document.source.kind==="simulation");let i=d("div",{className:"checks",role:"g\
roup","aria-label":"Marks"},a,s("Rays","rays"),s("Readings","readings"));return r.section("View",o,Nn(r,e),i)}function Nn(r,e){let{session:t}=r,n=d("input",{type:"\
range",min:0,step:1,"aria-label":"Draw number"});n.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(n.value))});let o=r.button("play","Play the draws",
()=>e.play(!e.playing),{when:()=>t.draws.count>1}),s=d("output"),a=d("select",{"aria-label":"Chain"});return a.addEventListener("change",()=>e.showDraw(t.draw,Number(
a.value))),r.each(()=>{let{chains:i,count:l}=t.draws;y(n,"max",String(Math.max(0,l-1))),y(n,"disabled",l===0),y(n,"value",String(t.draw));let c=l?`${t.draw+1} o\
f ${l}`:"none kept";D(n,"aria-valuetext",c),n.style.setProperty("--fill",`${l>1?100*t.draw/(l-1):0}%`),y(s,"textContent",c),a.length!==Math.max(1,i)&&a.replaceChildren(
...Array.from({length:Math.max(1,i)},(u,h)=>d("option",{value:String(h),textContent:`chain ${h+1}`}))),y(a,"value",String(t.view.chain)),y(a,"disabled",i<2),l<2&&
e.playing&&e.play(!1);let p=e.playing?"Pause the draws":"Play the draws";o.getAttribute("aria-label")!==p&&(o.setAttribute("aria-label",p),o.replaceChildren(O(e.
playing?"pause":"play")))}),d("div",{className:"player"},o,n,s,a)}function Ot(r){let{session:e}=r,t=d("input",{type:"range",min:0,step:1,"aria-label":"Scan numb\
er"}),n=d("output");t.addEventListener("input",()=>e.act({type:"scan",index:Number(t.value)}));let o=r.section("Scan",d("div",{className:"player bare"},t,n));return r.
each(()=>{let s=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;y(o,"hidden",s<2),y(t,"max",String(Math.max(0,s-1))),Q(t)||y(t,"value",String(
e.scan?.index??0)),t.style.setProperty("--fill",`${100*Number(t.value)/Math.max(1,s-1)}%`),y(n,"textContent",`${Number(t.value)+1} / ${s}`)}),o}function It(r,e,t){let{shown:n,status:o}=r,s=n?.layer==="draw"?"draw":r.view.layer==="entropy"?"entropy":"mean";return{document:r.effectiveDocument(),generation:r.
generation,painted:n&&{generation:n.generation,layer:s,approximate:n.approximate,sweeps:n.sweeps,method:n.method,rhat:n.rhat,ess:n.ess,chain:n.chain,draw:n.draw},
probability:n?.p??new Uint8Array(0),observed:n?.observed??new Uint8Array(0),walls:r.walls,sensors:r.document?.sensors??[],scan:r.scan,status:{text:o.text,level:o.
level},connected:r.connection.connected,worker:r.worker,running:r.running,draws:r.draws,view:r.view,seq:{sent:r.acted,confirmed:r.state?.seq??0},events:{...r.counts,
eventToPaint_ms:r.latency.eventToPaint_ms},layers:{...t.paints},transform:{...e.transform}}}var $t=new Set(["walls","sensor","set","view","live"]);function _t(r,e){let{document:t,walls:n}=r,o=t.grid.shape[1];if(e.type==="walls")for(let[s,a]of e.cells)n[s*
o+a]=e.wall?1:0;else if(e.type==="set")Object.assign(t,e.patch);else if(e.type==="live")r.state={...r.state,live:e.on};else if(e.type==="view")r.view={layer:e.layer,
chain:e.chain??r.view.chain,draw:e.draw??null};else if(e.type==="sensor"&&e.op==="move"){let s=t.sensors.find(a=>a.id===e.id);s&&Object.assign(s,{x:e.x,y:e.y,yaw:e.
yaw})}}var we=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,t){this.waiting.push({seq:e,time:t.timeStamp})}refused(e){this.waiting=this.waiting.filter(
t=>t.seq!==e)}confirmed(e,t){this.seqOfGeneration.set(e,t)}painted(e){let t=this.seqOfGeneration.get(e);if(t===void 0)return;let n=performance.now();for(let o of this.
waiting)o.seq<=t&&this.eventToPaint_ms.push(n-o.time);this.waiting=this.waiting.filter(o=>o.seq>t);for(let o of this.seqOfGeneration.keys())o<e&&this.seqOfGeneration.
delete(o)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var xe=class{joint=[];generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.
generation=e.generation,this.from={sweeps:e.sweeps,time:performance.now()},this.joint=[]),this.last=e.sweeps,e.log_joint!=null&&this.joint.at(-1)?.[0]!==e.sweeps&&
this.joint.push([e.sweeps,e.log_joint]))}remaining_s(e){let t=e.sweeps-this.from.sweeps;return t>0?(e.total-e.sweeps)*(performance.now()-this.from.time)/t/1e3:null}};var ve=class{constructor(e,t,n=null){this.transport=e;this.changed=t;this.adopt=n;e.onmessage=(o,s)=>this.receive(o,s),e.onstatus=o=>this.onstatus(o)}connection={
connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={layer:"mean",chain:0,draw:null};state=null;scan=null;shown=null;cell=null;worker="\
starting";recorded=!1;generation=-1;acted=0;status=new ge;progress=new xe;latency=new we;counts={paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];confirmedWalls={
text:"",walls:this.walls};wallsAhead=!1;packed={version:-1,text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&
this.document?.source.kind==="simulation"}get running(){return!!this.state?.running}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.
shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&(this.running||this.state?.live))}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.
draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/gibbs|block/.test(this.document?.method??"")}say(e,t="\
info"){this.status.say(e,t,this.acted),this.changed()}act(e,t){if(!this.document&&e.type!=="hello")return;let n={...e,seq:++this.seq};e.type!=="inspect"&&(this.
acted=this.seq),$t.has(e.type)&&(this.pending.push(n),this.foresee(n)),t&&this.latency.sent(n.seq,t),this.connection.connected&&this.transport.send(n),this.changed()}effectiveDocument(){
return this.packed.version!==this.wallsVersion&&(this.packed={version:this.wallsVersion,text:te(Ke(this.walls))}),this.document&&{...this.document,walls:this.packed.
text}}take(){return this.next?(this.shown=this.next,this.next=null,!0):!1}painted(){this.counts.paints++,this.shown&&this.latency.painted(this.shown.generation)}remaining_s(){
return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){if(this.connection=e,e.connected){let t=this.everConnected?this.effectiveDocument():
this.adopt;this.pending=[],this.latency.forget(),this.act(t?{type:"hello",document:t}:{type:"hello"}),this.everConnected&&this.say("Connected again"),this.everConnected=
!0}else this.everConnected&&this.say("Connection lost","error");this.changed()}receive(e,t){switch(e.type){case"welcome":this.generation=-1,this.recorded=!!e.recorded,
this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":if(e.generation>=this.generation){let{pose:n,angles:o,ranges:s,exact:a}=t;
this.scan={ids:e.ids??[],index:e.index??null,pose:n,angles:o,ranges:s,exact:a}}break;case"field":this.receiveField(e,t);break;case"cell":this.cell={x:e.x,y:e.y,
beams:e.beams};break;case"status":this.status.say(e.text,e.level??"info",this.acted);break;case"error":this.status.say([e.text,e.remedy].filter(Boolean).join(";\
 "),"error",this.acted),this.pending=this.pending.filter(n=>n.seq!==e.seq),this.latency.refused(e.seq),this.rebuild();break;case"worker":this.worker=e.state,this.
status.worker(e.state);break;case"download":this.ondownload(e.name,e.mime,t.data),this.status.say(`Saved ${e.name}`,"info",this.acted);break}this.changed()}receiveState(e){
this.status.confirmed(e.seq),this.state=e,this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.
filter(t=>t.seq>e.seq),this.rebuild()}receiveField(e,t){if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let n=t.p,o=t.observed,
s=this.next??this.shown,i=s&&s.p.length===n.length&&s.bits.every((l,c)=>l===o[c])?{observed:s.observed,bits:s.bits}:{observed:Se(o,n.length),bits:o};this.next={
...e,p:n,...i},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[t,n]=e.grid.shape,o=this.confirmedWalls;if((e.walls!==o.
text||o.walls.length!==t*n)&&(this.confirmedWalls={text:e.walls,walls:Se(U(e.walls),t*n)}),this.document={...e,sensors:e.sensors.map(s=>({...s}))},(this.confirmedWalls!==
o||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),this.state.view&&!this.pending.some(s=>s.type==="view")){
let{layer:s,chain:a,draw:i}=this.state.view;this.view={layer:s??"mean",chain:a??0,draw:i??null}}for(let s of this.pending)this.foresee(s)}foresee(e){!this.document||
!this.state||(_t(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Ft=`:host { display: block; height: 100dvh; container-type: inline-size; }
:host([data-embedded]) { height: 720px; }
* { box-sizing: border-box; margin: 0; }
[hidden], .hidden { display: none !important; }
.hidden[aria-live] { display: block !important; position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.app { --ground: #f4f5f7; --card: #fff; --text: #1d2430; --soft: #565d68; --line: #d8dce2; --control: #848c98; --accent: #00639c;
  --on-accent: #fff; --tint: #e3eef6; --bad: #a43b00; --warn: #fff4d6; --warn-text: #5c4300; color-scheme: light;
  display: grid; height: 100%; grid-template: "head head" auto "bar panel" auto "stage panel" minmax(0, 1fr) "legend panel" auto "foot foot" auto / minmax(0, 1f\
r) 328px;
  background: var(--ground); color: var(--text); font: 14px/1.4 -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif;
  font-variant-numeric: tabular-nums; -webkit-text-size-adjust: 100%; }
.app[data-theme=dark] { --ground: #12151a; --card: #1a1e25; --text: #e6e9ee; --soft: #a3abb8; --line: #2e3540; --control: #6d7786; --accent: #6cb8ec;
  --on-accent: #08131c; --tint: #1f3242; --bad: #ff9d66; --warn: #3d3211; --warn-text: #ffe2a0; color-scheme: dark; }
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
.chip { position: absolute; left: 0; top: 0; white-space: nowrap; padding: 2px 8px; border-radius: 5px; background: var(--card); color: var(--text); border: 1px\
 solid var(--line); font-size: 12px; pointer-events: none; }
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
.trace { width: 100%; height: 34px; border-bottom: 1px solid var(--line); }
.trace polyline { fill: none; stroke: var(--accent); stroke-width: 1.5; vector-effect: non-scaling-stroke; }
.player { display: grid; grid-template-columns: auto 1fr auto; align-items: center; gap: 6px 10px; }
.player select { grid-column: 2 / -1; }
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
@media (prefers-reduced-motion: no-preference) { button, .segmented label { transition: background-color .12s; } }
@media (forced-colors: active) { .segmented label:has(:checked) { outline: 2px solid Highlight; } }
`;var Ht="bayesmap-theme",Bt={auto:"light",light:"dark",dark:"auto"},ke=class{constructor(e,t){this.app=e;this.dressed=t;let n=Dn();n&&n in Bt&&(this.choice=n),this.
media.addEventListener("change",this.listen)}theme=me.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,t=this.theme=e?me.dark:me.light;this.app.dataset.theme=e?"dark":"light";let{truth:n,ray:o,noReturn:s,sensor:a,
hatch:i,unobserved:l}=t;for(let[c,p]of Object.entries({truth:n,ray:o,miss:s,sensor:a,hatch:i,unobserved:l}))this.app.style.setProperty(`--${c}`,p);this.dressed(
this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Bt[this.choice];try{localStorage.setItem(Ht,this.choice)}catch{}this.dress()}destroy(){this.media.
removeEventListener("change",this.listen)}};function Dn(){try{return localStorage.getItem(Ht)}catch{return null}}function Me(r,e,{embedded:t=!1,adopt:n=null}={}){let o=r.shadowRoot??r.attachShadow({mode:"open"}),s=new CSSStyleSheet;s.replaceSync(Ft),o.adoptedStyleSheets=[s],
r.toggleAttribute("data-embedded",t);let a=0,i=()=>{a||=requestAnimationFrame(Ge)},l=new ve(e,i,n),c=new F,p=new ie(l),u=new ae(l,p),h=new be(l),m=new ye(l,p,u,
ze,x=>h.showLayer(x),t),g=[new G,new z,new j,new de],b=g.map(({name:x})=>d("canvas",{className:x})),w=b[b.length-1];Object.assign(w,{tabIndex:0,role:"applicatio\
n"});let S=new ue(g,b);new pe(w,l,c,p,u,t);let T=new le(w,l,c,p,u),f={truth:!0,rays:!0,readings:!0},v=Mt(m),E=wt(m),A={chip:Pt(m),banner:Ct(m)},R=d("main",{className:"\
stage"},...b,A.chip,A.banner),V=St(m,()=>Y.theme),$=Et(m);w.setAttribute("aria-describedby",$.readout.id);let K=kt(m),I={help:xt(m),new:vt(m),share:K.dialog},[L,
q,Oe,Ie]=[Lt(m),Nt(m),Rt(m),Dt(m)],qt=[At(m),Ut(m,h,f),Ot(m),L,q,Oe,Ie],$e=d("aside",{"aria-label":"Controls"},...qt),_e=()=>l.recorded||l.document?.source.kind===
"run";m.visible(L,()=>l.editable),m.visible(q,()=>!_e()),m.visible(Oe,()=>!_e()),m.visible(Ie,()=>!l.recorded),m.each(()=>{y(E,"inert",!l.document),y($e,"inert",
!l.document)});let Fe=d("div",{className:"app"},v.element,E,R,V,$e,$.element,...Object.values(I));o.replaceChildren(Fe);let Y=new ke(Fe,x=>{v.nameTheme(x),i()}),
Be=()=>{let x=l.editable&&p.tool==="sensor"?p.sensor?.id??null:null;return{session:l,view:c,look:{theme:Y.theme,...f,hover:p.hover,cursor:p.cursor,selected:x}}},
He="";function Ge(){a=0;let x=l.take();l.document&&String(l.shape)!==He&&(He=String(l.shape),c.fit(l.shape),p.cursor=p.hover=null,w.setAttribute("aria-label",`M\
ap, ${l.shape[0]} by ${l.shape[1]} cells`)),S.paint(Be()),x&&(l.painted(),h.step());let{x:M,y:N}=c.transform;A.chip.style.transform=`translate(${Math.max(M,C.left)}\
px, ${Math.max(N-28,6)}px)`,D(w,"data-tool",l.editable?p.tool:"pan"),m.refresh()}let je=new ResizeObserver(()=>{let{width:x,height:M}=R.getBoundingClientRect();
!x||!M||(c.resize(x,M,devicePixelRatio||1),c.fitted&&c.fit(l.shape),cancelAnimationFrame(a),Ge())});je.observe(R);async function ze(x){if(x==="in"||x==="out")c.
zoom(x==="in"?1.4:1/1.4,c.middle,l.shape);else if(x==="fit")c.fit(l.shape);else if(x==="help")I.help.showModal();else if(x==="new")I.new.showModal();else if(x===
"theme")Y.next();else if(x==="add")T.addSensor();else if(x==="share"){let M=l.effectiveDocument();M&&K.show(location.href.replace(/#.*/,"")+await Xe(M))}else if(x===
"export png"){let M=await bt(Be());M&&Le("bayesmap.png",M),l.say("Saved bayesmap.png")}else x.startsWith("export ")&&l.act({type:"export",what:x.slice(7)});i()}
l.ondownload=(x,M,N)=>Le(x,new Blob([N],{type:M}));let We=[[t?r:window,"keydown",x=>{x.defaultPrevented||!l.document||Object.values(I).some(M=>M.open)||lt(x,l,{
tool:M=>{p.choose(M),T.focus()},layer:M=>h.showLayer(M),command:ze})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{let x=t?null:await re();
x&&l.act({type:"hello",document:x})}]];for(let[x,M,N]of We)x.addEventListener(M,N);return Y.dress(),e.open(),{destroy(){je.disconnect(),cancelAnimationFrame(a),
Y.destroy();for(let[x,M,N]of We)x.removeEventListener(M,N);e.close(),o.replaceChildren()},snapshot:()=>It(l,c,S),cellToClient(x,M){let N=w.getBoundingClientRect(),
Ve=c.fromGrid({x:x+.5,y:M+.5},l.shape[1]);return{x:N.left+Ve.x,y:N.top+Ve.y}}}}var Re={uint8:Uint8Array,float32:Float32Array,float64:Float64Array},Gt=8,W=()=>({onmessage:()=>{},onstatus:()=>{}});function jt(r){let e=new DataView(r).getUint32(
0,!0),t=JSON.parse(new TextDecoder().decode(new Uint8Array(r,4,e))),n={},o=4+e;for(let{name:s,dtype:a,shape:i}of t.buffers){let l=i.reduce((c,p)=>c*p,1)*Re[a].BYTES_PER_ELEMENT;
n[s]=new Re[a](r.slice(o,o+l)),o+=Math.ceil(l/Gt)*Gt}return[t,n]}function zt(r,e){let t={};return(r.buffers??[]).forEach(({name:n,dtype:o},s)=>{let{buffer:a,byteOffset:i,
byteLength:l}=e[s];t[n]=new Re[o](a.slice(i,i+l))}),t}function Wt(r){let{document:e,scans:t,settings:n={},log_joint:o=[]}=r,s=e.grid.shape[0]*e.grid.shape[1],a=r.draws?.count??0,i=e.source.kind!=="simulation",l=U(r.
mean),c=U(r.observed),p=null,u=0,h={layer:"mean",chain:0,draw:null},m=f=>i?[f[u]]:f,g=f=>Float32Array.from(m(f).flat(),v=>v??1/0),b=f=>{let v={chains:r.draws?.chains??
0,count:p?a:0},E={generation:1,can_undo:!1,can_redo:!1,live:!1,running:!1};T.onmessage({type:"state",document:e,seq:f,...E,draws:v,view:h},{})},w=()=>{let f=Float64Array.
from(m(t.pose).flat(),Number),v={type:"scan",generation:1,ids:i?[u]:t.ids,index:i?u:null},E=t.exact?.length?g(t.exact):new Float32Array(0);T.onmessage(v,{pose:f,
angles:Float32Array.from(t.angles),ranges:g(t.ranges),exact:E})},S=()=>{let f=h.layer==="draw"&&p?Un(p,h.chain*a+(h.draw??a-1),s):null,v=o[h.chain]?.[(h.layer===
"draw"?h.draw:null)??a-1]??null,E=f?{...h,draw:h.draw??a-1}:{layer:h.layer==="draw"?"mean":h.layer},A=n.sweeps??a,R={sweeps:A,total:A,ess:n.ess,rhat:n.rhat,log_joint:v},
V=n.method??e.method;T.onmessage({type:"field",generation:1,...E,method:V,approximate:!1,...R},{p:f??l,observed:c})},T={...W(),open:()=>T.onstatus({connected:!0}),
send:f=>{if(f.type==="hello"){if(T.onmessage({type:"welcome",version:1,recorded:!0},{}),b(f.seq),w(),S(),!a||!r.draws)return;ne(U(r.draws.data)).then(v=>{p=v,b(
f.seq)})}else if(f.type==="view")h={layer:f.layer,chain:f.chain??h.chain,draw:f.draw??null},b(f.seq),S();else if(f.type==="scan")u=f.index,b(f.seq),w();else if(f.
type==="inspect"){let v=On(e,t.angles,m(t.pose),m(t.ranges),f.x,f.y);T.onmessage({type:"cell",x:f.x,y:f.y,beams:v},{})}},close:()=>{}};return T}function Un(r,e,t){
let n=e*t;return Uint8Array.from({length:t},(o,s)=>r[n+s>>3]>>7-(n+s&7)&1?255:0)}function On({grid:r},e,t,n,o,s){let{origin:a,resolution:i}=r,l=[a[0]+o*i,a[1]+s*
i],c=0;return t.forEach((p,u)=>{let[h,m,g]=p.map(Number);e.forEach((b,w)=>{let[S,T]=[Math.cos(b+g),Math.sin(b+g)],f=[(l[0]-h)/S,(l[0]+i-h)/S,(l[1]-m)/T,(l[1]+i-
m)/T],v=Math.max(0,Math.min(f[0],f[1]),Math.min(f[2],f[3])),E=Math.min(n[u][w]??1/0,Math.max(f[0],f[1]),Math.max(f[2],f[3]));v<E&&c++})}),c}var De=250,In=8e3;function Vt(r){let e=null,t=De,n=0,o=!1;function s(){clearTimeout(n);let i=new WebSocket(r);e=i,i.binaryType="arraybuffer",i.onopen=()=>{t=De,
a.onstatus({connected:!0})},i.onmessage=({data:l})=>{typeof l=="string"?a.onmessage(JSON.parse(l),{}):a.onmessage(...jt(l))},i.onclose=()=>{o||e!==i||(n=window.
setTimeout(s,t),a.onstatus({connected:!1,retryIn_ms:t}),t=Math.min(In,2*t))}}let a={...W(),open:s,send:i=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
i))},retry:()=>{t=De,e?.readyState!==WebSocket.OPEN&&s()},close:()=>{o=!0,clearTimeout(n),e?.close()}};return a}function Kt(r){let e=(n,o=[])=>t.onmessage(n,zt(n,o)),t={...W(),open:()=>{r.on("msg:custom",e),t.onstatus({connected:!0})},send:n=>r.send(n),close:()=>r.off("ms\
g:custom",e)};return t}var Ue=r=>Object.assign(window,{bayesmap:r}),us={render({model:r,el:e}){let t=document.createElement("div");e.append(t);let n=Me(t,Kt(r),{embedded:!0});return Ue(
n),()=>n.destroy()}};async function $n(){let r=document.querySelector("[data-bayesmap]");if(!r||r.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("body \
{ margin: 0; }"),document.adoptedStyleSheets.push(e);let t=document.querySelector("script[data-recording]");if(t){Ue(Me(r,Wt(JSON.parse(t.textContent??""))));return}
let n=new URL("socket"+location.search,location.href);n.protocol=n.protocol.replace("http","ws"),n.hash="",Ue(Me(r,Vt(n.href),{adopt:await re()}))}$n();export{us as default,Me as mount,Wt as recordedTransport,Vt as webSocketTransport,Kt as widgetTransport};
