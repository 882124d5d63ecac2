// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function Ct(t,e){let n=new Uint8Array(e);for(let s=0;s<e;s++)n[s]=t[s>>3]>>7-(s&7)&1;return n}function qn(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function dt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function xn(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function ka(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Jn=t=>ka(t,new DecompressionStream("deflate-raw")),Sa=t=>ka(t,new CompressionStream("deflate-r\
aw"));async function Ma(t){let e=await Sa(new TextEncoder().encode(JSON.stringify(t)));return"#m="+xn(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Jp(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Jn(dt(e[1]))))}var _s="The link's map cannot be read: copy the link again, who\
le";async function Cs(){let t=await Jp(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var Nr={uint8:Uint8Array,uint32:Uint32Array,float32:Float32Array,float64:Float64Array},Ta=8,sn=()=>({onmessage:()=>{},onstatus:()=>{}});function Zs(t){let e=new DataView(
t).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),s={},o=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let l=a.reduce((c,h)=>c*
h,1)*Nr[i].BYTES_PER_ELEMENT;s[r]=new Nr[i](t.slice(o,o+l)),o+=Math.ceil(l/Ta)*Ta}return[n,s]}function Aa(t,e){let n={};return(t.buffers??[]).forEach(({name:s,dtype:o},r)=>{
let{buffer:i,byteOffset:a,byteLength:l}=e[r];n[s]=new Nr[o](i.slice(a,a+l))}),n}async function Qs(t){let e=await Jn(dt(t));return Zs(e.buffer)}function Ea([t,e]){let{document:n,ids:s,log_joint:o}=t,{chains:r,count:i,bits:a}=t.draws,l=n.grid.
shape[0]*n.grid.shape[1],c=n.source.kind!=="simulation",h=1,u={chains:r,count:i},d=0,m={layer:"mean",chain:0,draw:null},w=(C,_=C.length===0)=>{let I=C.length/s.
length;return c&&!_?C.slice(d*I,(d+1)*I):C},b=()=>s[d]-1,S=(C=0)=>{let _={generation:h,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1,scan:b()};E.onmessage(
{type:"state",document:n,seq:C,..._,draws:u,view:m},{})},T=()=>{let{pose:C,angles:_,ranges:I,exact:H,hit:Z}=e,j=_.length<I.length,D={pose:w(C),angles:w(_,j),ranges:w(
I),exact:w(H),hit:w(Z)};E.onmessage({type:"scan",generation:h,ids:c?[s[d]]:s,index:c?b():null},D)},v=C=>{let _=a?Math.ceil(l/8):l,I=e.draws.slice(C*_,(C+1)*_);return a?
Ct(I,l).map(H=>255*H):I},A=()=>{let{p:C,width:_,reached:I,trace:H,traced:Z,weights:j}=e,D=Math.min(i-1,m.draw??i-1),R=m.layer==="draw"&&!i||m.layer==="width"&&!_?
"mean":m.layer,F=R==="draw"?{chain:m.chain,draw:D,log_joint:o[m.chain][D]}:{},Y=R==="draw"?v(m.chain*i+D):R==="width"?_:C;E.onmessage({...t.field,layer:R,...F},
{p:Y,reached:I,trace:H,traced:Z,...j&&{weights:j}})},E={...sn(),open:()=>E.onstatus({connected:!0}),send:C=>{if(C.type==="hello"){let _=[...i?[]:["draw"],...e.width?
[]:["width"]];E.onmessage({type:"welcome",version:1,limits:null,recorded:!0,figure:!1,lacks:_},{}),S(C.seq),T(),e.trajectory&&E.onmessage({type:"overlay",generation:h},
{strokes:e.strokes,trajectory:e.trajectory}),A()}else if(C.type==="view")m={layer:C.layer,chain:C.chain??m.chain,draw:C.draw??null},S(C.seq),A();else if(C.type===
"scan"){let _=s.map(I=>Math.abs(I-1-C.index));d=_.indexOf(Math.min(..._)),S(C.seq),T()}else if(C.type==="inspect"){let{x:_,y:I}=C,H=e.beams[_*n.grid.shape[1]+I];
E.onmessage({type:"cell",x:_,y:I,each:!1,beams:H,beams_for:null,nats_for:null,beams_against:null,nats_against:null},{})}},close:()=>{}};return E}async function Xp(t,e){let n=new TextDecoder,s=t.stream().getReader(),[o,r]=["",0];for(let i=await s.read();!i.done;i=await s.read())o+=n.decode(i.value,{stream:!0}),
e((r+=i.value.length)/t.size);return o}async function Pa(t,e,n){let{name:s}=t;if(!/\.(html|json)$/.test(s))return e.say(`${s} is not read in the page: start bay\
esmap app with it`,"warning");try{let o=await Xp(t,i=>e.say(`Reading ${s}: ${Math.round(100*i)} %`)),r=/data-recording>(.*?)<\/script>/s.exec(o)?.[1];r&&n?n(await Qs(
r)):s.endsWith(".json")&&!e.recorded?e.bring(JSON.parse(o)):e.say(`${s} holds nothing that can be shown here`,"warning")}catch{e.say(`${s} cannot be read: expor\
t it again, whole`,"error")}}var se=(t,e,n)=>Math.min(n,Math.max(e,t)),zt=({x:t,y:e},[n,s])=>t>=0&&e>=0&&t<n&&e<s,Pe=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Rr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function vn(t,e){let{x:n,y:s}=Pe(t,e);return{x:Math.floor(n),y:Math.floor(s)}}var Xn=(t,e)=>Rr({x:t.x+.5,y:t.y+.5},e);
function _a(t,e){let n=[],s=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let o=0;o<=s;o++){let r=s?o/s:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Ca(t,[e,n]){let s=new Path2D,o=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&o(r-1,i)!==o(r,i);l&&a<0&&(a=i),!l&&a>=0&&(s.moveTo(r,a),s.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&o(i,r-1)!==o(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(s.moveTo(a,r),s.lineTo(i,r),a=-1)}return s}var Ls=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function La(t,e,n){let s=Na(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),o=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Ra(t,(r,i,a)=>e[a]||s.includes(a)?-1/0:o(r,i))}function Da(t,e){
let n=Zp(e,t.grid.shape),s=Na(t);return Ra(t,(o,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let l of s)a=Math.min(a,Math.hypot(o-l.x,r-l.y));return a>0?a:-1/0})}
var Na=({sensors:t,grid:e})=>t.map(n=>vn(n,e));function Ra(t,e){let[n,s]=t.grid.shape,o=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<s;a++){let l=e(i,a,i*s+a);
l>r&&([o,r]=[{x:i,y:a},l])}return o&&Xn(o,t.grid)}function Zp(t,[e,n]){let s=new Uint16Array(e*n),o=(r,i)=>r<0||i<0||r>=e||i>=n?0:s[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)s[r*n+i]=t[r*n+i]?0:1+Math.min(o(r-1,i-1),o(r-1,i),o(r-1,i+1),o(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(o(r+1,i+1),o(r+1,i),
o(r+1,i-1),o(r,i+1));s[r*n+i]=Math.min(s[r*n+i],a)}return s}var eo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return zt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,s,o){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(c=>vn(c,r.grid)):[],l=new Map;for(let c of e)!zt(c,i)||this.isWall(c)===n||a.some(h=>h.x===
c.x&&h.y===c.y)||l.set(c.x*i[1]+c.y,[c.x,c.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:s},o)}moveSensor(e,n,s,o){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:s},o)}addSensor(e){let{session:n}=this,{document:s}=n;
if(!s)return;let o=e==="where there is room"?Da(s,n.walls):"world"in e?e.world:La(s,n.walls,e.near),r=n.limits?.sensors[1]??1/0;o?s.sensors.length>=r?n.say(`The\
re can be ${r} sensors at most.`,"warning"):this.refuses(o)||(n.act({type:"add_sensor",x:o.x,y:o.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=
Math.max(0,...s.sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"\
remove_sensor",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let s=vn(e,n.document.grid),o=this.isWall(s);return!o&&zt(s,n.shape)?(n.status.text.
startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(o?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Lt=new Set(["pan","path","look","where","ghost","evidence"]),Qp=120,to=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.ghost.hold(e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.
changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&zt(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=
n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.
busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},Qp))}};var Je={left:36,right:12,top:34,bottom:26},eu=60,tu=160,Zn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,s){[
this.width,this.height,this.ratio]=[e,n,s]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let s={x:this.width-Je.left-Je.right,y:this.height-Je.
top-Je.bottom},o=Math.max(.05,Math.min(s.x/e,s.y/n));o*this.ratio>4&&(o=Math.floor(o*this.ratio)/this.ratio),this.transform.scale=o,this.corner={x:Je.left+(s.x-
o*e)/2,y:Je.top+(s.y-o*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,s){let{scale:o}=this.transform,{x:r,
y:i}=this.corner,a=se(o*e,Math.min(this.width,this.height)/Math.max(...s)/3,tu),l=a/o;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(s)}pan(e,n,s){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(s)}toGrid(e,n){let{scale:s,x:o,y:r}=this.transform;return{x:(e.
x-o)/s,y:n-(e.y-r)/s}}fromGrid(e,n){let{scale:s,x:o,y:r}=this.transform;return{x:o+e.x*s,y:r+(n-e.y)*s}}settle([e,n]){let{scale:s}=this.transform,o=eu;this.corner.
x=se(this.corner.x,o-e*s,this.width-o),this.corner.y=se(this.corner.y,o-n*s,this.height-o),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var no=new Set(["path","look","evidence"]);function so(t,e,n,s){if(e.tool==="path")return t.decisions.point(s);if(e.tool==="evidence"&&t.document){let{x:h,y:u}=Pe(
s,t.document.grid);return t.evidence.pin({x:Math.floor(h),y:Math.floor(u)})}let o=t.decisions.nearest(s),{views:r}=t.decisions;if(o===null||!r)return;let[i,a,l]=r.
pose.subarray(3*o,3*o+3),c=`${r.nats[o].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${c}`)}var Oa=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W, O, V","where am I, ghost, evidence of beams","asked"],["arrows",
"move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["Space","at the cu\
rsor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, Delete","add, remo\
ve a sensor","drawn"],["R, Escape","run, cancel","inferred"],["Escape","take a path off the map","asked"],["M, N, H","show the mean, a draw, the entropy or the \
width"],["Ctrl+Z, Ctrl+Y","undo, redo","edited"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],nu={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],
ArrowDown:[0,-1]},$a=Math.PI/12,ro=class{constructor(e,n,s,o,r){this.canvas=e;this.session=n;this.view=s;this.hand=o;this.editor=r;e.addEventListener("keydown",
i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,o.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){
let{session:n,hand:s,editor:o}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=nu[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?$a:-$a;s.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&
s.sensor&&o.moveSensor(s.sensor,{yaw:s.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key===
"Backspace")&&n.editable)o.removeSensor();else if(e.key==="Escape"&&s.cursor)s.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.
editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:s,view:o,hand:r}=this,[i,a]=s.shape;if(r.tool==="ghost"&&
s.ghost.pose&&s.document){let{resolution:l}=s.document.grid,{x:c,y:h}=s.ghost.pose;s.ghost.move({x:c+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&
r.sensor&&s.document&&s.editable){let{resolution:l}=s.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.
tool==="pan"&&s.editable)o.pan(-40*e,40*n,s.shape),s.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},c={x:se(l.x+e,0,i-1),y:se(l.y+n,0,a-1)};
r.setCursor(c);let h=o.fromGrid({x:c.x+.5,y:c.y+.5},a),u=(m,w,b)=>m-se(m,w,b),d={x:u(h.x,Je.left+10,o.width-20),y:u(h.y,20,o.height-Je.bottom-10)};(d.x||d.y)&&o.
pan(-d.x,-d.y,s.shape)}}space(e){let{session:n,hand:s,editor:o}=this;if(no.has(s.tool)&&n.document){s.cursor?so(n,s,o,Xn(s.cursor,n.document.grid)):this.arrow(0,
0);return}if(n.editable){if(s.tool==="sensor"||s.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===s.sensor?.id);s.select(r[(i+1)%Math.max(1,
r.length)]?.id??null),s.selected!==null&&s.announce(`Sensor ${s.selected}`)}else if(!Lt.has(s.tool)){s.cursor||this.arrow(0,0);let r=s.cursor,i=s.tool==="draw"&&
!o.isWall(r);o.setWalls([r],i,s.nextGesture(),e),s.announce(i?"wall":"free")}}}},oo={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",
v:"evidence"},Fa={m:"mean",n:"draw",h:"entropy"},Ia={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function Ua(t,e,n){let s=t.composedPath()[0],o=s instanceof
HTMLSelectElement||s instanceof HTMLInputElement&&/number|text/.test(s.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(o||r!=="z"&&r!=="y"||
e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}if(!(o||t.altKey)){if(oo[r]&&(Lt.has(oo[r])?e.answers||oo[r]==="pan"&&
e.editable:e.editable))n.tool(oo[r]);else if(Fa[r])n.layer(r==="h"&&e.quantity.interval?"width":Fa[r]);else if(Ia[t.key])n.command(Ia[t.key]);else if(r==="r"&&!e.
recorded)e.act({type:"run"});else if(t.key==="Escape"&&e.decisions.start)e.decisions.forgetPath();else if(t.key==="Escape"&&(e.running||e.working))e.act({type:"\
cancel"});else return;t.preventDefault()}}var io=class{paints={};sheets;constructor(e,n){this.sheets=e.map((s,o)=>({layer:s,canvas:n[o],context:n[o].getContext("2d"),before:[]}));for(let{name:s}of e)this.
paints[s]=0}paint(e){let{width:n,height:s,ratio:o,transform:r}=e.view;if(!n||!s)return;let i={width:Math.max(1,Math.ceil(n*o)),height:Math.max(1,Math.ceil(s*o))},
a=[e.look.theme,n,s,o,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:c,context:h,layer:u}=l,d=u.shows?.(e)??!0,m=[d,...d?[...a,...u.depends(e)]:[]];m.length===
l.before.length&&m.every((w,b)=>Object.is(w,l.before[b]))||(l.before=m,c.style.visibility=d?"":"hidden",d&&((c.width!==i.width||c.height!==i.height)&&(Object.assign(
c,i),c.style.width=`${i.width/o}px`,c.style.height=`${i.height/o}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,c.width,c.height),h.setTransform(o,0,0,o,0,0),
h.save(),u.paint(h,e),h.restore(),this.paints[u.name]++))}}};function Ne(t,{session:e,view:n}){let[s,o]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,s*r,o*r),t.clip()}function kn(t,{halo:e},n,s){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=s,t.strokeStyle=n,t.stroke()}var ao='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Kt(t,e,n,s,o,r,i=!1){t.font=ao,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=o.halo,t.lineWidth=3,t.strokeText(e,n,s)),t.fillStyle=o.axis,t.fillText(e,n,s)}var Qn=class{constructor(e,n,s){this.context=e;this.theme=
n;this.width=s}taken=[];write(e,n,s,o){this.context.font=ao;let r=this.context.measureText(e).width/2+2,i=Math.min(Math.max(n,r),this.width-r),l=[[i,s-o-9],[i,s+
o+9],[n+o+r+4,s],[n-o-r-4,s]].find(([c,h])=>!this.taken.some(([u,d,m,w])=>c+r>u&&c-r<m&&h+8>d&&h-8<w));return l?(this.taken.push([l[0]-r,l[1]-8,l[0]+r,l[1]+8]),
Kt(this.context,e,l[0],l[1],this.theme,"center",!0),!0):!1}};function $r({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(s,o)=>o).map(s=>({id:s,x:e.pose[3*s],y:e.
pose[3*s+1],yaw:e.pose[3*s+2]})):[]}function on(t,e,n){let s=n.fromGrid(Pe(t,e),e.shape[1]),o=se(n.transform.scale*.42,7,13),r=o*2.6,i={x:s.x+r*Math.cos(t.yaw),
y:s.y-r*Math.sin(t.yaw)};return{point:s,size:o,handle:i}}function Wa(t,{session:e,view:n,look:s}){let o=e.document;if(!o)return;let{theme:r}=s,i=$r(e);t.lineJoin=
"round";for(let a of i){let l=on(a,o.grid,n),{point:c,size:h}=l;a.id===s.selected&&su(t,l,s);let[u,d]=[Math.cos(a.yaw),-Math.sin(a.yaw)],m=(w,b)=>[c.x+h*(w*u-b*
d),c.y+h*(w*d+b*u)];t.beginPath(),t.moveTo(...m(1.25,0)),t.lineTo(...m(-.9,.8)),t.lineTo(...m(-.45,0)),t.lineTo(...m(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Kt(t,String(a.id),c.x,c.y+h*2+4,r,"center",!0)}}function su(t,{point:e,size:n,handle:s},{
theme:o}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(s.x,s.y),t.moveTo(s.x+4.5,s.y),t.arc(s.x,s.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),kn(t,o,o.sensor,1.5),t.beginPath(),t.arc(s.x,s.y,4,0,2*Math.PI),t.fillStyle=o.halo,t.fill()}function Ba(t,e,n,s,o){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&on({id:0,...t.pose},s,o);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Ga(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var Ha={touch:24,other:11},ou=5,ru=90,lo=class{constructor(e,n,s,o,r,i){this.canvas=e;this.session=n;this.view=s;this.hand=o;this.editor=r;this.embedded=i;let a=(l,c)=>e.
addEventListener(l,c,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{o.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return Rr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:s}=this,
{document:o}=n;if(!o)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",s.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&s.tool==="ghost")return this.begin(Ba(n.ghost,r,this.reach(e),o.grid,this.view)),this.dragGhost(e);if(e.button===0&&no.has(s.tool))return this.
begin({kind:"pick",first:r});let i=s.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,o):null;if(i?.kind==="sensor")return s.select(i.id),this.begin(i);
if(e.button===1||Lt.has(s.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,o);if(a)this.begin(a),a.kind==="sensor"&&s.select(a.id);else if(s.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,o)}):s.sensor&&(s.selected=s.sensor.id,this.begin({kind:"sensor",id:s.sensor.id,drag:s.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let l=s.tool==="draw"!==(e.button===2||e.shiftKey),c=this.cellAt(r),h=l&&this.editor.isWall(c);this.begin({kind:"strok\
e",id:s.nextGesture(),wall:l,last:c,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),ru)}}gripAt(e,n,s){let{hand:o,view:r}=this,
i=this.reach(n),a=d=>Math.hypot(e.x-d.x,e.y-d.y),l=o.tool==="sensor"&&o.sensor?on(o.sensor,s.grid,r):null;if(l&&o.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:o.sensor.id,drag:o.nextGesture()};if(n.button!==0||o.tool==="erase")return null;let c=s.sensors.map(d=>({id:d.id,...on(d,s.grid,r)}));c.sort((d,m)=>a(
d.point)-a(m.point));let h=c.find(({point:d,size:m})=>a(d)<Math.max(i,m));if(!h)return null;let u={x:h.point.x-e.x,y:h.point.y-e.y};return{kind:"sensor",id:h.id,
drag:o.nextGesture(),grip:u}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:s,view:o,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let c of l.
length?l:[e]){let h=this.cellAt(this.at(c));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(..._a(n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=s.document?.sensors.find(c=>c.id===n.id);if(!a||!s.document)return;let l=this.metres(i,s.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>ou&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")o.pan(i.x-n.last.x,i.y-n.last.y,s.shape),n.last=i,s.changed();else if(this.fingers.size===2){let{middle:a,spread:l}=this.spread();
o.pan(a.x-n.middle.x,a.y-n.middle.y,s.shape),o.zoom(l/n.spread,a,s.shape),Object.assign(n,{middle:a,spread:l}),s.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&so(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?Ha.touch:Ha.other}pointAtReading(e){let{document:n,reading:s,ghost:o}=this.
session;if(!n||o.held)return;let r=n.grid.resolution/this.view.transform.scale;s.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:s}=this;
if(n?.kind!=="ghost"||!s.document)return;this.hand.point(null);let o=this.at(e);Ga(s.ghost,n,this.metres({x:o.x+n.grip.x,y:o.y+n.grip.y},s.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let s=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-s*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-s*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:s,gesture:o}=this;o?.kind==="stroke"&&(this.editor.setWalls(e,o.wall,o.id,n),s.status.level==="error"&&s.say("Ready"))}dragSensor(e){
let{gesture:n,session:s}=this,{document:o}=s;if(n?.kind!=="sensor"||!o)return;this.hand.point(null);let r=o.sensors.find(l=>l.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},o);r&&this.editor.moveSensor(r,a,n.drag,e)}};var iu=5,co=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:s,look:o}){
let{theme:r}=o;e.beginPath(),e.rect(Je.left,0,s.width,s.height-Je.bottom),e.clip(),o.hover&&za(e,o.hover,n.shape[1],s,r,r.axis,1.5),o.cursor&&za(e,o.cursor,n.shape[1],
s,r,r.ray,2.5)}};function za(t,e,n,s,o,r,i){let{scale:a}=s.transform,l=s.fromGrid({x:e.x,y:e.y+1},n),c=Math.max(a,iu),[h,u]=[l.x-(c-a)/2,l.y-(c-a)/2];t.lineWidth=
i+2,t.strokeStyle=o.halo,t.strokeRect(h,u,c,c),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,u,c,c)}var au={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},lu={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},uo={light:au,dark:lu},Va="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function cu([t,e,n]){let s=(t+16)/116,o=[.95047,1,1.08883],[r,i,
a]=[s+e/500,s,s-n/200].map((l,c)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*o[c]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let c=se(l,0,1);return Math.round(255*(c<=.0031308?12.92*c:1.055*c**(1/2.4)-.055))})}var ho=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),po=(t,e,n)=>t.map((s,o)=>s+n*(e[o]-s)),Fr=(t,e)=>cu(po(t.paper,t.ink,e));function es(t){let e=Math.min(15,Math.floor(
t*16));return po(ho(Va,6*e),ho(Va,6*e+6),t*16-e)}function ja(t,e){let n=new Uint8ClampedArray(17408).fill(255),[s,o]=[ho(t.unobserved),ho(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?Ls(r/255):r/255,a=e==="value"?Fr(t,r/255):es(i),l=po(s,o,e==="value"?r/255:0);for(let c=0;c<=16;c++)n.set(po(l,a,c/16),4*(r+256*c))}
return new Uint32Array(n.buffer)}var Ir=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;function k(t,e={},...n){let s=document.createElement(t);for(let[o,r]of Object.entries(e))o.startsWith("on")?s.addEventListener(o.slice(2),r):o.includes("-")||o===
"role"||o==="for"?s.setAttribute(o,r):s[o]=r;for(let o of n)o!==null&&s.append(o);return s}function L(t,e,n){t[e]!==n&&(t[e]=n)}function st(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var Sn=t=>t.getRootNode().activeElement===t,fe=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function Or(t,e){let n=URL.
createObjectURL(e);k("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var hu=9,pu=2.5,ts=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start||e.looking&&e.views))}paint(e,n){let{session:s}=n;if(!s.document)return;Ne(e,n);let o=new Qn(e,n.look.theme,n.view.width);s.decisions.looking&&
this.views(e,n,o),this.path(e,n,o)}views(e,{session:n,view:s,look:o},r){let{views:i}=n.decisions,a=n.document?.grid;if(!i?.nats.length||!a)return;let[l,c]=[Math.
min(...i.nats),Math.max(...i.nats)],h=se(.38*i.spacing*s.transform.scale/a.resolution,pu,hu),u=i.nats.indexOf(c);for(let d=0;d<i.nats.length;d++){let m=s.fromGrid(
Pe({x:i.pose[3*d],y:i.pose[3*d+1]},a),a.shape[1]);e.beginPath(),e.arc(m.x,m.y,h,0,2*Math.PI),e.fillStyle=`rgb(${es(se((i.nats[d]-l)/Math.max(c-l,1e-9),0,1)).map(
Math.round)})`,e.fill(),d===u&&(e.lineWidth=2.5,e.strokeStyle=o.theme.truth,e.stroke(),r.write(`${fe(c,1)} nats`,m.x,m.y,h))}}path(e,{session:n,view:s,look:o},r){
let{start:i,goal:a,path:l,radius:c}=n.decisions,h=n.document?.grid;if(!h||!i)return;let u=d=>s.fromGrid(Pe(d,h),h.shape[1]);if(l){e.beginPath();for(let[d,m]of l.
path){let w=u({x:d,y:m});e.lineTo(w.x,w.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=l.within_risk?o.theme.sensor:o.theme.truth,e.globalAlpha=.3,e.lineWidth=2*
c*s.transform.scale/h.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let d of a?[i,a]:[i]){let{x:m,y:w}=u(d);e.beginPath(),e.arc(m,w,5,0,2*Math.
PI),e.fillStyle=d===i?o.theme.sensor:o.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=o.theme.halo,e.stroke()}if(l){let d=l.path.length,[[m,w],[b,S]]=[l.path[d-
1>>1],l.path[d>>1]],T=u({x:(m+b)/2,y:(w+S)/2});r.write(`${fe(l.length_m,1)} m, free with probability ${fe(l.probability,3)}`,T.x,T.y,4)}else a&&n.decisions.trouble&&
r.write("no path",u(a).x,u(a).y,7)}};var uu=5,[du,Ya]=[.8,5],fu=6,fo=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:s,view:o,look:r}=n,{cell:i,each:a}=s.evidence,l=s.document?.grid;if(!i||!l)return;
Ne(e,n);let c=(b,S)=>o.fromGrid(Pe({x:b,y:S},l),l.shape[1]),h=b=>[c(a.start[2*b],a.start[2*b+1]),c(a.end[2*b],a.end[2*b+1])],u=a?.nats.length??0;e.lineCap="roun\
d";for(let b=u-1;b>=0;b--){let[S,T]=h(b),v=a.nats[b];e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(T.x,T.y),e.globalAlpha=se(.25+Math.abs(v)/2,0,.9),e.lineWidth=se(Ya*
Math.sqrt(Math.abs(v)/fu),du,Ya),e.strokeStyle=v>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:d}=o.transform,m=o.fromGrid({x:i.x,y:i.y+1},l.
shape[1]),w=Math.max(1,4-d/2);e.beginPath(),e.rect(m.x-w,m.y-w,d+2*w,d+2*w),kn(e,r.theme,r.theme.belief,2);for(let b=Math.min(uu,u)-1;b>=0;b--){let[S,T]=h(b),v=.35+
.1*b,A={x:S.x+v*(T.x-S.x),y:S.y+v*(T.y-S.y)};Kt(e,Ur(a.nats[b]),A.x,A.y,r.theme,"center",!0)}}},Ur=t=>`${t<0?"−":"+"}${Math.abs(t).toFixed(1)}`;var mu=10,gu=7,yu=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",mo=()=>document.createElement("canvas").getContext("2d"),ns=class{name="\
field";cells=mo();mask=mo();hatch=mo();palettes=new Map;image=new ImageData(1,1);drawn={field:null,reached:null,palette:"",hatch:""};depends({session:e}){return[
e.flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:s,view:o,look:r}=n;if(!s.document)
return;let[i,a]=s.shape,{scale:l,x:c,y:h}=o.transform;Ne(e,n);let u=s.flicker.under??s.shown;if(!u||u.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
c,h,i*l,a*l);return}this.fill(u,i,a,r.theme,yu(u,s.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,c,h,i*l,a*l),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/o.ratio,this.hatch.canvas.height/o.ratio),l>=mu&&this.lines(e,n)}fill(e,n,s,o,r){let{cells:i,mask:a,drawn:l}=this,
c=`${o.ground} ${r}`;if(l.field===e&&l.palette===c)return;let h=this.palettes.get(c)??ja(o,r);if(this.palettes.set(c,h),this.image.width!==n||this.image.height!==
s){this.image=new ImageData(n,s);for(let{canvas:d}of[i,a])Object.assign(d,{width:n,height:s});l.reached=null}let u=new Uint32Array(this.image.data.buffer);for(let d=0,
m=0;d<s;d++)for(let w=s-1-d;w<n*s;w+=s)u[m++]=h[e.p[w]+256*(e.reached[w]+8>>4)];if(i.putImageData(this.image,0,0),l.reached!==e.reached){for(let d=0,m=0;d<s;d++)
for(let w=s-1-d;w<n*s;w+=s)u[m++]=255-e.reached[w]<<24;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,reached:e.reached,palette:c})}fillHatch({
session:e,view:n,look:s}){let{hatch:o,mask:r,drawn:i}=this,{ratio:a,width:l,height:c}=n,{scale:h,x:u,y:d}=n.transform,[m,w]=e.shape,b=[s.theme.ground,h,u,d,l,c,
a].join(" ");if(i.hatch===b)return;i.hatch=b;let S=mo(),T=S.canvas.width=S.canvas.height=Math.round(gu*a);S.strokeStyle=s.theme.hatch,S.lineWidth=a,S.beginPath();
for(let A of[-T,0,T])S.moveTo(A-1,T+1),S.lineTo(A+T+1,-1);S.stroke(),Object.assign(o.canvas,{width:Math.ceil(l*a),height:Math.ceil(c*a)}),o.setTransform(a,0,0,a,
0,0),o.imageSmoothingEnabled=!1,o.drawImage(r.canvas,u,d,m*h,w*h),o.globalCompositeOperation="source-in",o.setTransform(1,0,0,1,0,0);let v=o.createPattern(S.canvas,
"repeat");v.setTransform(new DOMMatrix().translate(Math.round(u*a),Math.round(d*a))),o.fillStyle=v,o.fillRect(0,0,o.canvas.width,o.canvas.height)}lines(e,{session:n,
view:s,look:o}){let[r,i]=n.shape,{scale:a,x:l,y:c}=s.transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,c),e.lineTo(l+h*a,c+i*a);for(let h=1;h<i;h++)e.moveTo(
l,c+h*a),e.lineTo(l+r*a,c+h*a);e.strokeStyle=o.theme.lines,e.lineWidth=1,e.stroke()}};var wu=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],ss=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:s}=n.session;if(!(!s.held||!s.pose||!n.session.document)){if(Ne(e,n),s.fan){let o=this.
fan(e,n,s.fan);s.fan.near&&this.near(e,n,s.fan,s.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(o)}this.robot(e,n,s.pose)}}ends({session:e,view:n},s,o,r){let{grid:i,
max_range:a}=e.document;return Array.from(o,(l,c)=>{let h=se(r[c],0,a),u=s.yaw+l,d={x:s.x+h*Math.cos(u),y:s.y+h*Math.sin(u)};return n.fromGrid(Pe(d,i),i.shape[1])})}fan(e,n,s){
let{theme:o}=n.look,[r,i,a]=[s.low,s.median,s.high].map(w=>this.ends(n,s,s.angles,w)),{grid:l}=n.session.document,c=n.view.fromGrid(Pe(s,l),l.shape[1]),h=new Path2D;
h.moveTo(c.x,c.y);for(let{x:w,y:b}of r)h.lineTo(w,b);h.closePath(),e.fillStyle=o.ghost,e.globalAlpha=.1,e.fill(h);let u=new Path2D,d=new Path2D,m=se(n.view.transform.
scale*.12,1.2,3);for(let w=0;w<r.length;w++)u.moveTo(r[w].x,r[w].y),u.lineTo(a[w].x,a[w].y),Number.isFinite(s.median[w])&&d.rect(i[w].x-m,i[w].y-m,2*m,2*m);return e.
strokeStyle=o.ghost,e.lineCap="round",e.lineWidth=se(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(u),e.globalAlpha=1,d}near(e,n,s,{pose:o,ranges:r,
hit:i}){let{theme:a}=n.look,l=se(n.view.transform.scale*.14,1.5,4),c=this.ends(n,{x:o[0],y:o[1],yaw:o[2]},s.angles,r),h=new Path2D;c.forEach(({x:u,y:d},m)=>{i[m]&&
(h.moveTo(u+l,d),h.arc(u,d,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:s,look:o},r){let{grid:i}=n.document,{point:a,
size:l,handle:c}=on({id:0,...r},i,s),[h,u]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(c.x,c.y),kn(e,o.theme,o.theme.ghost,1.5),
e.beginPath();for(let[d,m]of wu)e.lineTo(a.x+l*(d*h-m*u),a.y+l*(d*u+m*h));e.closePath(),e.lineJoin="round",kn(e,o.theme,o.theme.ghost,2),e.fillStyle=o.theme.halo,
e.fill(),e.beginPath(),e.arc(c.x,c.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var os=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:s,view:o,look:r}=n,i=s.flicker.under&&s.shown;if(!i)return;let[a,l]=s.shape,
{scale:c,x:h,y:u}=o.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Ne(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,u,a*c,l*c)}fill(e,n,s,o){let[r,i,a]=[1,3,5].map(c=>parseInt(o.slice(c,c+2),16));Object.assign(this.cells.canvas,{width:n,height:s});let l=new ImageData(
n,s);for(let c=0,h=0;c<s;c++)for(let u=s-1-c;u<n*s;u+=s,h+=4)l.data.set([r,i,a,Math.round(e.p[u]*e.reached[u]/255)],h);this.cells.putImageData(l,0,0),this.drawn=
{field:e,colour:o}}};var bu=46,xu=22;function vu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function Ka(t,{session:e,view:n,look:s}){if(!e.document)
return;let{theme:o}=s,{width:r,height:i}=n,{origin:a,resolution:l,shape:c}=e.document.grid,{scale:h,x:u,y:d}=n.transform,m=vu(bu/h*l),w=Math.min(d+c[1]*h,i-Je.bottom)+
.5,b=Math.max(u,Je.left)-.5;t.fillStyle=o.ground,u<b&&t.fillRect(0,0,b,i+1),d+c[1]*h>w&&t.fillRect(0,w,r+1,i+1-w);let S=Math.max(0,-Math.floor(Math.log10(m)+1e-9));
t.strokeStyle=o.frame,t.lineWidth=1,t.beginPath();let T=A=>Math.ceil(a[A]/m-1e-9)*m,v=A=>a[A]+c[A]*l+1e-9;for(let A=T(0);A<=v(0);A+=m){let E=u+(A-a[0])/l*h;E<b||
E>r-4||(t.moveTo(E,w),t.lineTo(E,w+4),Kt(t,A.toFixed(S),E,w+12,o,"center"))}for(let A=T(1);A<=v(1);A+=m){let E=d+(c[1]-(A-a[1])/l)*h;E>w||E<4||(t.moveTo(b,E),t.
lineTo(b-4,E),Kt(t,A.toFixed(S),b-7,E,o,"right"))}t.stroke(),Kt(t,"m",b-xu,w+12,o,"right")}var rs=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let s=$r(e).flatMap(({id:i,x:a,y:l,yaw:c})=>[i,a,l,c]),{grid:o}=e.document??{},
r=qa(e)&&n.truth&&e.wallsVersion;return[o&&[...o.shape,...o.origin,o.resolution].join(),r,n.selected,...s]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:s,view:o,look:r}=n;if(!s.document)return;let[i,a]=s.shape,{scale:l,x:c,y:h}=o.transform;r.truth&&qa(s)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(c-.5,h-.5,i*l+1,a*l+1),Wa(e,n),Ka(e,n)}truth(e,n){let{session:s,view:o,look:r}=n,{scale:i,x:a,y:l}=o.transform;this.edgesOf!==s.wallsVersion&&
(this.edges=Ca(s.walls,s.shape),this.edgesOf=s.wallsVersion),e.save(),Ne(e,n),e.transform(i,0,0,-i,a,l+s.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=se(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},qa=({document:t})=>t?.source.kind==="simulation";var ku=600,Su=1500,Mu=65536,Wr=.3,is=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:s,view:o,look:r}=n,{scan:i,document:a}=s;
if(!i||!a)return;Ne(e,n);let{scale:l}=o.transform,c=1/a.grid.resolution,h=a.grid.shape[1],u=i.angles.length,d=i.pose.length/3,m=Math.ceil(u*d/Su),[w,b,S]=[new Path2D,
new Path2D,new Path2D],T=u*d>ku,v=new Map,A=se(l*.1,1.3,4),E=a.scans_used??1/0,C=(i.index??0)<E?1:Wr;for(let _=0;_<d;_++){let[I,H,Z]=i.pose.subarray(3*_,3*_+3),
j=o.fromGrid(Pe({x:I,y:H},a.grid),h);for(let D=0;D<u;D++){let R=i.ranges[_*u+D],F=i.hit[_*u+D]===1,Y=(F?R:a.max_range)*c*l,W=i.angles[D]+Z,q={x:j.x+Y*Math.cos(W),
y:j.y-Y*Math.sin(W)},V=F?w:b;(_*u+D)%m===0&&(V.moveTo(j.x,j.y),V.lineTo(q.x,q.y)),F&&(T?v.set(Math.round(q.x)*Mu+Math.round(q.y),q):(S.moveTo(q.x+A,q.y),S.arc(q.
x,q.y,A,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=C*se(28/Math.sqrt(u*d/m)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(w),e.strokeStyle=r.theme.
noReturn,e.stroke(b),e.globalAlpha=1),r.readings){e.globalAlpha=C,e.fillStyle=r.theme.ray,e.fill(S);let _=1.8*A;for(let{x:I,y:H}of v.values())e.fillRect(I-_/2,H-
_/2,_,_);e.globalAlpha=1}}};var Tu=2.5,Ds=t=>t>=Tu,as=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:s,look:o}=n,{overlay:r,document:i}=s;!r||!i||(Ne(e,n),o.trajectory&&
this.trajectory(e,n,r.trajectory),o.strokes&&Ds(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:s,look:o},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=o.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[c,h,u]of[[0,l,.6],
[Math.max(0,l-1),a,.6*Wr]]){e.beginPath();for(let d=c;d<h;d++){let m=s.fromGrid(Pe({x:r[2*d],y:r[2*d+1]},i),i.shape[1]);e.lineTo(m.x,m.y)}e.globalAlpha=u,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:s,look:o},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,c,h,u]=r.subarray(a,a+4),[d,
m]=[s.fromGrid(Pe({x:l,y:c},i),i.shape[1]),s.fromGrid(Pe({x:h,y:u},i),i.shape[1])];e.moveTo(d.x,d.y),e.lineTo(m.x,m.y)}e.strokeStyle=o.theme.ray,e.lineCap="roun\
d",e.lineWidth=se(s.transform.scale/5,.8,2.5),e.stroke()}}};var Au=2.2,go=7,[Eu,Pu]=[.03,.75],_u=2.4477,Ja=9,ls=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:s}=n,{found:o}=s.where,r=s.document?.grid;if(!o||!r)return;Ne(e,n),
this.cloud(e,n,r);let i=new Qn(e,n.look.theme,n.view.width);for(let a of o.modes)this.place(e,n,r,a,i)}cloud(e,{session:n,view:s,look:o},r){let{cloud:i,weight:a}=n.
where.found,l=a[a.length-1]||1;e.strokeStyle=e.fillStyle=o.theme.belief,e.lineWidth=1.2;for(let c=0;c<a.length;c++){if(a[c]<Eu**2*l)continue;let[h,u,d]=i.subarray(
3*c,3*c+3),m=s.fromGrid(Pe({x:h,y:u},r),r.shape[1]);e.globalAlpha=Pu*Math.sqrt(a[c]/l),e.beginPath(),e.arc(m.x,m.y,Au,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(
m.x,m.y),e.lineTo(m.x+go*Math.cos(d),m.y-go*Math.sin(d)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:s},o,r,i){let[a,l,c]=r.mean,h=n.fromGrid(Pe({x:a,y:l},o),
o.shape[1]),u=_u*n.transform.scale/o.resolution,[[d,m],[,w]]=r.covariance,[b,S]=[(d+w)/2,Math.hypot((d-w)/2,m)],[T,v]=[b+S,b-S].map(E=>Math.max(Ja,u*Math.sqrt(Math.
max(E,0))));e.beginPath(),e.ellipse(h.x,h.y,T,v,-Math.atan2(2*m,d-w)/2,0,2*Math.PI);let A=Ja+1;e.moveTo(h.x+A*Math.cos(c),h.y-A*Math.sin(c)),e.lineTo(h.x+(A+go)*
Math.cos(c),h.y-(A+go)*Math.sin(c)),e.strokeStyle=s.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=s.theme.belief,e.lineWidth=2,e.stroke(),i.write(Br(r.probability),
h.x,h.y,v)}},Br=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var Xa=900,Ns=2;function Za({session:t,look:e}){let[n,s]=t.shape,o=new Zn;o.resize(Xa,Math.round(se(Xa*s/n,300,1800)),Ns),o.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:o.width*Ns,height:o.height*Ns});let i=r.getContext("2d");i.scale(Ns,Ns),i.fillStyle=e.theme.ground,i.fillRect(0,0,o.width,o.height);
let a=[new ns,new os,new as,new is,new rs,new ts,new ls,new ss],l={session:t,view:o,look:{...e,hover:null,cursor:null,selected:null}};for(let c of a)(c.shows?.(
l)??!0)&&(i.save(),c.paint(i,l),i.restore());return new Promise(c=>r.toBlob(c))}var yo=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:s,ghost:o}}){return!!(!o.
held&&e.picked&&n&&s?.index===e.picked.scan)}paint(e,n){let{session:s,view:o,look:r}=n,{picked:i,found:a}=s.reading,{scan:l,document:c}=s;if(!i||!c||l?.index!==
i.scan)return;Ne(e,n);let{grid:h,max_range:u}=c,d=S=>{let T={x:i.from.x+S*Math.cos(i.angle),y:i.from.y+S*Math.sin(i.angle)};return o.fromGrid(Pe(T,h),h.shape[1])},
m=(S,T,v,A)=>{e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(T.x,T.y),e.lineWidth=v,e.strokeStyle=A,e.stroke()},w=l.hit[i.beam]===1,b=d(w?l.ranges[i.beam]:u);if(m(d(0),
b,3,r.theme.halo),m(d(0),b,1.5,w?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let S=(T,v)=>se(T??v,0,u);if(m(d(S(a.low,0)),d(S(a.high,u)),6,r.theme.ghost),
a.median!==null){let T=d(a.median),v={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};m({x:T.x-v.x,y:T.y-v.y},{x:T.x+v.x,y:T.y+v.y},2.5,r.theme.ghost)}}w&&(e.beginPath(),
e.arc(b.x,b.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};var Qa="bayesmap-token",Gr="bayesmap-kept",el="bayesmap-tools";function tl(t){try{return localStorage.getItem(t)}catch{return null}}function wo(t,e){try{e===null?
localStorage.removeItem(t):localStorage.setItem(t,e)}catch{}}function Hr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&wo(Gr,JSON.stringify(
t))}function nl(){wo(Gr,null)}function sl(){let t=tl(Gr);try{return t&&JSON.parse(t)}catch{return null}}var ol=()=>tl(el)!==null,rl=t=>wo(el,t?"all":null);function il(t){
t&&wo(Qa,t)}function al(t){let e=n=>{n.key===Qa&&n.newValue&&t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",
e)}var zr=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["where","Where am I?","where"],["path","Path","path"],
["evidence","Evidence","evidence"],["look","Look next","look"],["ghost","Ghost","ghost"]],Cu=5;function ll(t){let{hand:e,session:n}=t,s=t.segmented("Tool",zr,()=>n.
editable||!n.document||Lt.has(e.tool)?e.tool:"pan",i=>e.choose(i),i=>(Lt.has(i)?n.answers:n.editable)||i==="pan");t.visible(s,()=>!n.recorded);let o=ol(),r=t.button(
null,"More tools",()=>{rl(o=!o),n.changed()},{text:"More"});return t.visible(r,()=>n.answers),t.each(()=>{let i=zr.filter(([l])=>Lt.has(l)?!n.figure||l==="pan":
!n.document||n.editable).map(([l])=>l),a=new Set(o?i:i.slice(0,Cu));zr.forEach(([l],c)=>L(s.children[c],"hidden",!a.has(l)&&!(l===e.tool&&i.includes(l)))),L(r.lastElementChild,
"textContent",o?"Fewer":"More"),st(r,"aria-label",o?"Fewer tools":"More tools"),L(r,"title",o?"Fewer tools":"More tools: paths, evidence, where to look next, th\
e ghost")}),k("div",{className:"bar"},s,r,k("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plu\
s","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Lu="uplot",Du="u-hz",Nu="u-vt",Ru="u-title",$u="u-wrap",Fu="u-under",Iu="u-over",Ou="u-axis",An="u-off",Uu="u-select",Wu="u-cursor-x",Bu="u-cursor-y",Gu="u-\
cursor-pt",Hu="u-legend",zu="u-live",Vu="u-inline",ju="u-series",Yu="u-marker",cl="u-label",Ku="u-value",$s="width",Fs="height";var hl="bottom",cs="left",Vr="right",li="#000",pl=li+"0",jr="mousemove",ul="mousedown",Yr="mouseup",dl="mouseenter",fl="mouseleave",ml="dblclick",qu="resize",Ju="\
scroll",gl="change",So="dppxchange",ci="--",gs=typeof window<"u",Zr=gs?document:null,ps=gs?window:null,Xu=gs?navigator:null,de,bo;function Qr(){let t=devicePixelRatio;
de!=t&&(de=t,bo&&ti(gl,bo,Qr),bo=matchMedia(`(min-resolution: ${de-.001}dppx) and (max-resolution: ${de+.001}dppx)`),En(gl,bo,Qr),ps.dispatchEvent(new CustomEvent(
So)))}function ft(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function ei(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Ae(t,e,n){
t.style[e]=n+"px"}function Dt(t,e,n,s){let o=Zr.createElement(t);return e!=null&&ft(o,e),n?.insertBefore(o,s),o}function kt(t,e){return Dt("div",t,e)}var yl=new WeakMap;
function Vt(t,e,n,s,o){let r="translate("+e+"px,"+n+"px)",i=yl.get(t);r!=i&&(t.style.transform=r,yl.set(t,r),e<0||n<0||e>s||n>o?ft(t,An):ei(t,An))}var wl=new WeakMap;
function bl(t,e,n){let s=e+n,o=wl.get(t);s!=o&&(wl.set(t,s),t.style.background=e,t.style.borderColor=n)}var xl=new WeakMap;function vl(t,e,n,s){let o=e+""+n,r=xl.
get(t);o!=r&&(xl.set(t,o),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=s?-e/2+"px":0,t.style.marginTop=s?-n/2+"px":0)}var hi={passive:!0},Zu={...hi,
capture:!0};function En(t,e,n,s){e.addEventListener(t,n,s?Zu:hi)}function ti(t,e,n,s){e.removeEventListener(t,n,hi)}gs&&Qr();function Nt(t,e,n,s){let o;n=n||0,s=
s||e.length-1;let r=s<=2147483647;for(;s-n>1;)o=r?n+s>>1:mt((n+s)/2),e[o]<t?n=o:s=o;return t-e[n]<=e[s]-t?n:s}function ql(t){return(n,s,o)=>{let r=-1,i=-1;for(let a=s;a<=
o;a++)if(t(n[a])){r=a;break}for(let a=o;a>=s;a--)if(t(n[a])){i=a;break}return[r,i]}}var Jl=t=>t!=null,Xl=t=>t!=null&&t>0,Ao=ql(Jl),Qu=ql(Xl);function ed(t,e,n,s=0,o=!1){
let r=o?Qu:Ao,i=o?Xl:Jl;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(s==1)a=t[e],l=t[n];else if(s==-1)a=t[n],l=t[e];else for(let c=e;c<=n;c++){let h=t[c];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??be,l??-be]}function Eo(t,e,n,s){let o=Ml(t),r=Ml(e);t==e&&(o==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?qt:Zl,a=o==1?mt:St,l=r==1?St:mt,
c=a(i(Ue(t))),h=l(i(Ue(e))),u=us(n,c),d=us(n,h);return n==10&&(c<0&&(u=xe(u,-c)),h<0&&(d=xe(d,-h))),s||n==2?(t=u*o,e=d*r):(t=nc(t,u),e=Po(e,d)),[t,e]}function pi(t,e,n,s){
let o=Eo(t,e,n,s);return t==0&&(o[0]=0),e==0&&(o[1]=0),o}var ui=.1,kl={mode:3,pad:ui},Os={pad:0,soft:null,mode:0},td={min:Os,max:Os};function Mo(t,e,n,s){return _o(
n)?Sl(t,e,n):(Os.pad=n,Os.soft=s?0:null,Os.mode=s?3:0,Sl(t,e,td))}function he(t,e){return t??e}function nd(t,e,n){for(e=he(e,0),n=he(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Sl(t,e,n){let s=n.min,o=n.max,r=he(s.pad,0),i=he(o.pad,0),a=he(s.hard,-be),l=he(o.hard,be),c=he(s.soft,be),h=he(o.soft,-be),
u=he(s.mode,0),d=he(o.mode,0),m=e-t,w=qt(m),b=ot(Ue(t),Ue(e)),S=qt(b),T=Ue(S-w);(m<1e-24||T>10)&&(m=0,(t==0||e==0)&&(m=1e-24,u==2&&c!=be&&(r=0),d==2&&h!=-be&&(i=
0)));let v=m||b||1e3,A=qt(v),E=us(10,mt(A)),C=v*(m==0?t==0?.1:1:r),_=xe(nc(t-C,E/10),24),I=t>=c&&(u==1||u==3&&_<=c||u==2&&_>=c)?c:be,H=ot(a,_<I&&t>=I?I:Rt(I,_)),
Z=v*(m==0?e==0?.1:1:i),j=xe(Po(e+Z,E/10),24),D=e<=h&&(d==1||d==3&&j>=h||d==2&&j<=h)?h:-be,R=Rt(l,j>D&&e<=D?D:ot(D,j));return H==R&&H==0&&(R=100),[H,R]}var sd=new Intl.
NumberFormat(gs?Xu.language:"en-US"),di=t=>sd.format(t),gt=Math,ko=gt.PI,Ue=gt.abs,mt=gt.floor,Oe=gt.round,St=gt.ceil,Rt=gt.min,ot=gt.max,us=gt.pow,Ml=gt.sign,qt=gt.
log10,Zl=gt.log2,od=(t,e=1)=>gt.sinh(t)*e,Kr=(t,e=1)=>gt.asinh(t/e),be=1/0;function Tl(t){return(qt((t^t>>31)-(t>>31))|0)+1}function ni(t,e,n){return Rt(ot(t,e),
n)}function Ql(t){return typeof t=="function"}function ie(t){return Ql(t)?t:()=>t}var rd=()=>{},ec=t=>t,tc=(t,e)=>e,id=t=>null,Al=t=>!0,El=(t,e)=>t==e,ad=/\.\d*?(?=9{6,}|0{6,})/gm,
Pn=t=>{if(oc(t)||an.has(t))return t;let e=`${t}`,n=e.match(ad);if(n==null)return t;let s=n[0].length-1;if(e.indexOf("e-")!=-1){let[o,r]=e.split("e");return+`${Pn(
o)}e${r}`}return xe(t,s)};function Mn(t,e){return Pn(xe(Pn(t/e))*e)}function Po(t,e){return Pn(St(Pn(t/e))*e)}function nc(t,e){return Pn(mt(Pn(t/e))*e)}function xe(t,e=0){
if(oc(t))return t;let n=10**e,s=t*n*(1+Number.EPSILON);return Oe(s)/n}var an=new Map;function sc(t){return((""+t).split(".")[1]||"").length}function Ws(t,e,n,s){
let o=[],r=s.map(sc);for(let i=e;i<n;i++){let a=Ue(i),l=xe(us(t,i),a);for(let c=0;c<s.length;c++){let h=t==10?+`${s[c]}e${i}`:s[c]*l,u=(i>=0?0:a)+(i>=r[c]?0:r[c]),
d=t==10?h:xe(h,u);o.push(d),an.set(d,u)}}return o}var Us={},fi=[],ds=[null,null],rn=Array.isArray,oc=Number.isInteger,ld=t=>t===void 0;function Pl(t){return typeof t==
"string"}function _o(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function cd(t){return t!=null&&typeof t=="object"}var hd=Object.getPrototypeOf(
Uint8Array),rc="__proto__";function fs(t,e=_o){let n;if(rn(t)){let s=t.find(o=>o!=null);if(rn(s)||e(s)){n=Array(t.length);for(let o=0;o<t.length;o++)n[o]=fs(t[o],
e)}else n=t.slice()}else if(t instanceof hd)n=t.slice();else if(e(t)){n={};for(let s in t)s!=rc&&(n[s]=fs(t[s],e))}else n=t;return n}function Re(t){let e=arguments;
for(let n=1;n<e.length;n++){let s=e[n];for(let o in s)o!=rc&&(_o(t[o])?Re(t[o],fs(s[o])):t[o]=fs(s[o]))}return t}var pd=0,ud=1,dd=2;function fd(t,e,n){for(let s=0,
o,r=-1;s<e.length;s++){let i=e[s];if(i>r){for(o=i-1;o>=0&&t[o]==null;)t[o--]=null;for(o=i+1;o<n&&t[o]==null;)t[r=o++]=null}}}function md(t,e){if(wd(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return bd(i[0])||(i=yd(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],c=l.length;for(let h=0;h<
c;h++)n.add(l[h])}let s=[Array.from(n).sort((i,a)=>i-a)],o=s[0].length,r=new Map;for(let i=0;i<o;i++)r.set(s[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let c=1;c<a.length;c++){let h=a[c],u=Array(o).fill(void 0),d=e?e[i][c]:ud,m=[];for(let w=0;w<h.length;w++){let b=h[w],S=r.get(l[w]);b===null?d!=pd&&(u[S]=b,
d==dd&&m.push(S)):u[S]=b}fd(u,m,o),s.push(u)}}return s}var gd=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function yd(t){let e=t[0],n=e.
length,s=Array(n);for(let r=0;r<s.length;r++)s[r]=r;s.sort((r,i)=>e[r]-e[i]);let o=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[s[l]];o.push(a)}return o}function wd(t){let e=t[0][0],n=e.length;for(let s=1;s<t.length;s++){let o=t[s][0];if(o.length!=n)return!1;if(o!=e){for(let r=0;r<n;r++)
if(o[r]!=e[r])return!1}}return!0}function bd(t,e=100){let n=t.length;if(n<=1)return!0;let s=0,o=n-1;for(;s<=o&&t[s]==null;)s++;for(;o>=s&&t[o]==null;)o--;if(o<=
s)return!0;let r=ot(1,mt((o-s+1)/e));for(let i=t[s],a=s+r;a<=o;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var ic=["January","February","March",
"April","May","June","July","August","September","October","November","December"],ac=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function lc(t){
return t.slice(0,3)}var xd=ac.map(lc),vd=ic.map(lc),kd={MMMM:ic,MMM:vd,WWWW:ac,WWW:xd};function Rs(t){return(t<10?"0":"")+t}function Sd(t){return(t<10?"00":t<100?
"0":"")+t}var Md={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>Rs(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>Rs(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>Rs(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>Rs(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>Rs(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Sd(t.getMilliseconds())};function mi(t,e){e=e||kd;let n=[],s=/\{([a-z]+)\}|[^{]+/gi,
o;for(;o=s.exec(t);)n.push(o[0][0]=="{"?Md[o[1]]:o[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var Td=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function Ad(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Td?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var cc=t=>t%1==0,To=[1,2,2.5,5],Ed=Ws(10,-32,0,To),hc=Ws(10,0,32,To),Pd=hc.filter(
cc),Tn=Ed.concat(hc),gi=`
`,pc="{YYYY}",_l=gi+pc,uc="{M}/{D}",Is=gi+uc,xo=Is+"/{YY}",dc="{aa}",_d="{h}:{mm}",hs=_d+dc,Cl=gi+hs,Ll=":{ss}",me=null;function fc(t){let e=t*1e3,n=e*60,s=n*60,
o=s*24,r=o*30,i=o*365,l=(t==1?Ws(10,0,3,To).filter(cc):Ws(10,-3,0,To)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,s,s*2,s*3,s*4,s*6,s*8,s*12,o,o*2,o*3,o*
4,o*5,o*6,o*7,o*8,o*9,o*10,o*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),c=[[i,pc,me,me,me,me,me,me,1],[o*28,"{MMM}",_l,me,me,me,me,me,1],[o,uc,_l,me,
me,me,me,me,1],[s,"{h}"+dc,xo,me,Is,me,me,me,1],[n,hs,xo,me,Is,me,me,me,1],[e,Ll,xo+" "+hs,me,Is+" "+hs,me,Cl,me,1],[t,Ll+".{fff}",xo+" "+hs,me,Is+" "+hs,me,Cl,
me,1]];function h(u){return(d,m,w,b,S,T)=>{let v=[],A=S>=i,E=S>=r&&S<i,C=u(w),_=xe(C*t,3),I=qr(C.getFullYear(),A?0:C.getMonth(),E||A?1:C.getDate()),H=xe(I*t,3);
if(E||A){let Z=E?S/r:0,j=A?S/i:0,D=_==H?_:xe(qr(I.getFullYear()+j,I.getMonth()+Z,1)*t,3),R=new Date(Oe(D/t)),F=R.getFullYear(),Y=R.getMonth();for(let W=0;D<=b;W++){
let q=qr(F+j*W,Y+Z*W,1),V=q-u(xe(q*t,3));D=xe((+q+V)*t,3),D<=b&&v.push(D)}}else{let Z=S>=o?o:S,j=mt(w)-mt(_),D=H+j+Po(_-H,Z);v.push(D);let R=u(D),F=R.getHours()+
R.getMinutes()/n+R.getSeconds()/s,Y=S/s,W=d.axes[m]._space,q=T/W;for(;D=xe(D+S,t==1?0:3),!(D>b);)if(Y>1){let V=mt(xe(F+Y,6))%24,re=u(D).getHours()-V;re>1&&(re=-1),
D-=re*s,F=(F+Y)%24;let ae=v[v.length-1];xe((D-ae)/S,3)*q>=.7&&v.push(D)}else v.push(D)}return v}}return[l,c,h]}var[Cd,Ld,Dd]=fc(1),[Nd,Rd,$d]=fc(.001);Ws(2,-53,
53,[1]);function Dl(t,e){return t.map(n=>n.map((s,o)=>o==0||o==8||s==null?s:e(o==1||n[8]==0?s:n[1]+s)))}function Nl(t,e){return(n,s,o,r,i)=>{let a=e.find(w=>i>=
w[0])||e[e.length-1],l,c,h,u,d,m;return s.map(w=>{let b=t(w),S=b.getFullYear(),T=b.getMonth(),v=b.getDate(),A=b.getHours(),E=b.getMinutes(),C=b.getSeconds(),_=S!=
l&&a[2]||T!=c&&a[3]||v!=h&&a[4]||A!=u&&a[5]||E!=d&&a[6]||C!=m&&a[7]||a[1];return l=S,c=T,h=v,u=A,d=E,m=C,_(b)})}}function Fd(t,e){let n=mi(e);return(s,o,r,i,a)=>o.
map(l=>n(t(l)))}function qr(t,e,n){return new Date(t,e,n)}function Rl(t,e){return e(t)}var Id="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function $l(t,e){return(n,s,o,r)=>r==
null?ci:e(t(s))}function Od(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Ud(t,e){return t.series[e].fill(
t,e)}var Wd={show:!0,live:!0,isolate:!1,mount:rd,markers:{show:!0,width:2,stroke:Od,fill:Ud,dash:"solid"},idx:null,idxs:null,values:[]};function Bd(t,e){let n=t.
cursor.points,s=kt(),o=n.size(t,e);Ae(s,$s,o),Ae(s,Fs,o);let r=o/-2;Ae(s,"marginLeft",r),Ae(s,"marginTop",r);let i=n.width(t,e,o);return i&&Ae(s,"borderWidth",i),
s}function Gd(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Hd(t,e){let n=t.series[e].points;return n._stroke||n._fill}function zd(t,e){return t.
series[e].points.size}var Jr=[0,0];function Vd(t,e,n){return Jr[0]=e,Jr[1]=n,Jr}function vo(t,e,n,s=!0){return o=>{o.button==0&&(!s||o.target==e)&&n(o)}}function Xr(t,e,n,s=!0){
return o=>{(!s||o.target==e)&&n(o)}}var jd={show:!0,x:!0,y:!0,lock:!1,move:Vd,points:{one:!1,show:Bd,size:zd,width:0,stroke:Hd,fill:Gd},bind:{mousedown:vo,mouseup:vo,
click:vo,dblclick:vo,mousemove:Xr,mouseleave:Xr,mouseenter:Xr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,s,o)=>s-o,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},mc={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},yi=Re({},mc,{filter:tc}),gc=Re({},yi,{size:10}),yc=Re({},mc,{show:!1}),wi='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',wc="bold "+wi,bc=1.5,Fl={
show:!0,scale:"x",stroke:li,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:wc,side:2,grid:yi,ticks:gc,border:yc,font:wi,lineGap:bc,rotate:0},
Yd="Value",Kd="Time",Il={show:!0,scale:"x",auto:!1,sorted:1,min:be,max:-be,idxs:[]};function qd(t,e,n,s,o){return e.map(r=>r==null?"":di(r))}function Jd(t,e,n,s,o,r,i){
let a=[],l=an.get(o)||0;n=i?n:xe(Po(n,o),l);for(let c=n;c<=s;c=xe(c+o,l))a.push(Object.is(c,-0)?0:c);return a}function si(t,e,n,s,o,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,c=l==10?qt:Zl,h=mt(c(n));o=us(l,h),l==10&&(o=Tn[Nt(o,Tn)]);let u=n,d=o*l;l==10&&(d=Tn[Nt(d,Tn)]);do a.push(u),u=u+o,l==10&&!an.has(u)&&(u=xe(u,an.get(
o))),u>=d&&(o=u,d=o*l,l==10&&(d=Tn[Nt(d,Tn)]));while(u<=s);return a}function Xd(t,e,n,s,o,r,i){let l=t.scales[t.axes[e].scale].asinh,c=s>l?si(t,e,ot(l,n),s,o):[
l],h=s>=0&&n<=0?[0]:[];return(n<-l?si(t,e,ot(l,-s),-n,o):[l]).reverse().map(d=>-d).concat(h,c)}var xc=/./,Zd=/[12357]/,Qd=/[125]/,Ol=/1/,oi=(t,e,n,s)=>t.map((o,r)=>e==
4&&o==0||r%s==0&&n.test(o.toExponential()[o<0?1:0])?o:null);function ef(t,e,n,s,o){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,c=r._space,h=l(10,i),u=l(
9,i)-h>=c?xc:l(7,i)-h>=c?Zd:l(5,i)-h>=c?Qd:Ol;if(u==Ol){let d=Ue(l(1,i)-h);if(d<c)return oi(e.slice().reverse(),a.distr,u,St(c/d)).reverse()}return oi(e,a.distr,
u,1)}function tf(t,e,n,s,o){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,c=Ue(l(1,i)-l(2,i));return c<a?oi(e.slice().reverse(),3,xc,St(a/c)).reverse():e}function nf(t,e,n,s){
return s==null?ci:e==null?"":di(e)}var Ul={show:!0,scale:"y",stroke:li,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:wc,side:3,grid:yi,ticks:gc,
border:yc,font:wi,lineGap:bc,rotate:0};function sf(t,e){let n=3+(t||1)*2;return xe(n*e,3)}function of(t,e){let{scale:n,idxs:s}=t.series[0],o=t._data[0],r=t.valToPos(
o[s[0]],n,!0),i=t.valToPos(o[s[1]],n,!0),a=Ue(i-r),l=t.series[e],c=a/(l.points.space*de);return s[1]-s[0]<=c}var Wl={scale:null,auto:!0,sorted:0,min:be,max:-be},
vc=(t,e,n,s,o)=>o,Bl={show:!0,auto:!0,sorted:0,gaps:vc,alpha:1,facets:[Re({},Wl,{scale:"x"}),Re({},Wl,{scale:"y"})]},Gl={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:vc,alpha:1,points:{show:of,filter:null},values:null,min:be,max:-be,idxs:[],path:null,clip:null};function rf(t,e,n,s,o){return n/10}var kc={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},af=Re({},kc,{time:!1,ori:1}),Hl={};function Sc(t,e){let n=Hl[t];return n||(n={key:t,plots:[],sub(s){n.plots.
push(s)},unsub(s){n.plots=n.plots.filter(o=>o!=s)},pub(s,o,r,i,a,l,c){for(let h=0;h<n.plots.length;h++)n.plots[h]!=o&&n.plots[h].pub(s,o,r,i,a,l,c)}},t!=null&&(Hl[t]=
n)),n}var ms=1,ri=2;function _n(t,e,n){let s=t.mode,o=t.series[e],r=s==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],c=s==2?r[1]:r[e],h=s==2?i[o.facets[0].scale]:
i[t.series[0].scale],u=s==2?i[o.facets[1].scale]:i[o.scale],d=a.left,m=a.top,w=a.width,b=a.height,S=t.valToPosH,T=t.valToPosV;return h.ori==0?n(o,l,c,h,u,S,T,d,
m,w,b,Lo,ys,No,Tc,Ec):n(o,l,c,h,u,T,S,m,d,b,w,Do,ws,vi,Ac,Pc)}function bi(t,e){let n=0,s=0,o=he(t.bands,fi);for(let r=0;r<o.length;r++){let i=o[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?s|=1:s|=2)}return[n,s==1?-1:s==2?1:s==3?2:0]}function lf(t,e,n,s,o){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return o==-1?l.min:o==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Jt(t,e,n,s,o,r){return _n(t,e,(i,a,l,c,h,u,d,m,w,b,S)=>{let T=i.pxRound,v=c.
dir*(c.ori==0?1:-1),A=c.ori==0?ys:ws,E,C;v==1?(E=n,C=s):(E=s,C=n);let _=T(u(a[E],c,b,m)),I=T(d(l[E],h,S,w)),H=T(u(a[C],c,b,m)),Z=T(d(r==1?h.max:h.min,h,S,w)),j=new Path2D(
o);return A(j,H,Z),A(j,_,Z),A(j,_,I),j})}function Co(t,e,n,s,o,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?No:vi,l=n;for(let u=0;u<t.length;u++){let d=t[u];
if(d[1]>d[0]){let m=d[0]-l;m>0&&a(i,l,s,m,s+r),l=d[1]}}let c=n+o-l,h=10;c>0&&a(i,l,s-h/2,c,s+r+h)}return i}function cf(t,e,n){let s=t[t.length-1];s&&s[0]==e?s[1]=
n:t.push([e,n])}function xi(t,e,n,s,o,r,i){let a=[],l=t.length;for(let c=o==1?n:s;c>=n&&c<=s;c+=o)if(e[c]===null){let u=c,d=c;if(o==1)for(;++c<=s&&e[c]===null;)
d=c;else for(;--c>=n&&e[c]===null;)d=c;let m=r(t[u]),w=d==u?m:r(t[d]),b=u-o;m=i<=0&&b>=0&&b<l?r(t[b]):m;let T=d+o;w=i>=0&&T>=0&&T<l?r(t[T]):w,w>=m&&a.push([m,w])}
return a}function zl(t){return t==0?ec:t==1?Oe:e=>Mn(e,t)}function Mc(t){let e=t==0?Lo:Do,n=t==0?(o,r,i,a,l,c)=>{o.arcTo(r,i,a,l,c)}:(o,r,i,a,l,c)=>{o.arcTo(i,r,
l,a,c)},s=t==0?(o,r,i,a,l)=>{o.rect(r,i,a,l)}:(o,r,i,a,l)=>{o.rect(i,r,l,a)};return(o,r,i,a,l,c=0,h=0)=>{c==0&&h==0?s(o,r,i,a,l):(c=Rt(c,a/2,l/2),h=Rt(h,a/2,l/2),
e(o,r+c,i),n(o,r+a,i,r+a,i+l,c),n(o,r+a,i+l,r,i+l,h),n(o,r,i+l,r,i,h),n(o,r,i,r+a,i,c),o.closePath())}}var Lo=(t,e,n)=>{t.moveTo(e,n)},Do=(t,e,n)=>{t.moveTo(n,e)},
ys=(t,e,n)=>{t.lineTo(e,n)},ws=(t,e,n)=>{t.lineTo(n,e)},No=Mc(0),vi=Mc(1),Tc=(t,e,n,s,o,r)=>{t.arc(e,n,s,o,r)},Ac=(t,e,n,s,o,r)=>{t.arc(n,e,s,o,r)},Ec=(t,e,n,s,o,r,i)=>{
t.bezierCurveTo(e,n,s,o,r,i)},Pc=(t,e,n,s,o,r,i)=>{t.bezierCurveTo(n,e,o,s,i,r)};function _c(t){return(e,n,s,o,r)=>_n(e,n,(i,a,l,c,h,u,d,m,w,b,S)=>{let{pxRound:T,
points:v}=i,A,E;c.ori==0?(A=Lo,E=Tc):(A=Do,E=Ac);let C=xe(v.width*de,3),_=(v.size-v.width)/2*de,I=xe(_*2,3),H=new Path2D,Z=new Path2D,{left:j,top:D,width:R,height:F}=e.
bbox;No(Z,j-I,D-I,R+I*2,F+I*2);let Y=W=>{if(l[W]!=null){let q=T(u(a[W],c,b,m)),V=T(d(l[W],h,S,w));A(H,q+_,V),E(H,q,V,_,0,ko*2)}};if(r)r.forEach(Y);else for(let W=s;W<=
o;W++)Y(W);return{stroke:C>0?H:null,fill:H,clip:Z,flags:ms|ri}})}function Cc(t){return(e,n,s,o,r,i)=>{s!=o&&(r!=s&&i!=s&&t(e,n,s),r!=o&&i!=o&&t(e,n,o),t(e,n,i))}}
var hf=Cc(ys),pf=Cc(ws);function Lc(t){let e=he(t?.alignGaps,0);return(n,s,o,r)=>_n(n,s,(i,a,l,c,h,u,d,m,w,b,S)=>{[o,r]=Ao(l,o,r);let T=i.pxRound,v=F=>T(u(F,c,b,
m)),A=F=>T(d(F,h,S,w)),E,C;c.ori==0?(E=ys,C=hf):(E=ws,C=pf);let _=c.dir*(c.ori==0?1:-1),I={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ms},H=I.
stroke,Z=!1;if(r-o>=b*4){let F=B=>n.posToVal(B,c.key,!0),Y=null,W=null,q,V,$e,pe=v(a[_==1?o:r]),re=v(a[o]),ae=v(a[r]),Q=F(_==1?re+1:ae-1);for(let B=_==1?o:r;B>=
o&&B<=r;B+=_){let ye=a[B],we=(_==1?ye<Q:ye>Q)?pe:v(ye),le=l[B];we==pe?le!=null?(V=le,Y==null?(E(H,we,A(V)),q=Y=W=V):V<Y?Y=V:V>W&&(W=V)):le===null&&(Z=!0):(Y!=null&&
C(H,pe,A(Y),A(W),A(q),A(V)),le!=null?(V=le,E(H,we,A(V)),Y=W=q=V):(Y=W=null,le===null&&(Z=!0)),pe=we,Q=F(pe+_))}Y!=null&&Y!=W&&$e!=pe&&C(H,pe,A(Y),A(W),A(q),A(V))}else
for(let F=_==1?o:r;F>=o&&F<=r;F+=_){let Y=l[F];Y===null?Z=!0:Y!=null&&E(H,v(a[F]),A(Y))}let[D,R]=bi(n,s);if(i.fill!=null||D!=0){let F=I.fill=new Path2D(H),Y=i.fillTo(
n,s,i.min,i.max,D),W=A(Y),q=v(a[o]),V=v(a[r]);_==-1&&([V,q]=[q,V]),E(F,V,W),E(F,q,W)}if(!i.spanGaps){let F=[];Z&&F.push(...xi(a,l,o,r,_,v,e)),I.gaps=F=i.gaps(n,
s,o,r,F),I.clip=Co(F,c.ori,m,w,b,S)}return R!=0&&(I.band=R==2?[Jt(n,s,o,r,H,-1),Jt(n,s,o,r,H,1)]:Jt(n,s,o,r,H,R)),I})}function uf(t){let e=he(t.align,1),n=he(t.
ascDesc,!1),s=he(t.alignGaps,0),o=he(t.extend,!1);return(r,i,a,l)=>_n(r,i,(c,h,u,d,m,w,b,S,T,v,A)=>{[a,l]=Ao(u,a,l);let E=c.pxRound,{left:C,width:_}=r.bbox,I=re=>E(
w(re,d,v,S)),H=re=>E(b(re,m,A,T)),Z=d.ori==0?ys:ws,j={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ms},D=j.stroke,R=d.dir*(d.ori==0?1:-1),F=H(
u[R==1?a:l]),Y=I(h[R==1?a:l]),W=Y,q=Y;o&&e==-1&&(q=C,Z(D,q,F)),Z(D,Y,F);for(let re=R==1?a:l;re>=a&&re<=l;re+=R){let ae=u[re];if(ae==null)continue;let Q=I(h[re]),
B=H(ae);e==1?Z(D,Q,F):Z(D,W,B),Z(D,Q,B),F=B,W=Q}let V=W;o&&e==1&&(V=C+_,Z(D,V,F));let[$e,pe]=bi(r,i);if(c.fill!=null||$e!=0){let re=j.fill=new Path2D(D),ae=c.fillTo(
r,i,c.min,c.max,$e),Q=H(ae);Z(re,V,Q),Z(re,q,Q)}if(!c.spanGaps){let re=[];re.push(...xi(h,u,a,l,R,I,s));let ae=c.width*de/2,Q=n||e==1?ae:-ae,B=n||e==-1?-ae:ae;re.
forEach(ye=>{ye[0]+=Q,ye[1]+=B}),j.gaps=re=c.gaps(r,i,a,l,re),j.clip=Co(re,d.ori,S,T,v,A)}return pe!=0&&(j.band=pe==2?[Jt(r,i,a,l,D,-1),Jt(r,i,a,l,D,1)]:Jt(r,i,
a,l,D,pe)),j})}function Vl(t,e,n,s,o,r,i=be){if(t.length>1){let a=null;for(let l=0,c=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=Ue(t[l]-t[a]);h<c&&(c=
h,i=Ue(n(t[l],s,o,r)-n(t[a],s,o,r)))}a=l}}return i}function df(t){t=t||Us;let e=he(t.size,[.6,be,1]),n=t.align||0,s=t.gap||0,o=t.radius;o=o==null?[0,0]:typeof o==
"number"?[o,0]:o;let r=ie(o),i=1-e[0],a=he(e[1],be),l=he(e[2],1),c=he(t.disp,Us),h=he(t.each,m=>{}),{fill:u,stroke:d}=c;return(m,w,b,S)=>_n(m,w,(T,v,A,E,C,_,I,H,Z,j,D)=>{
let R=T.pxRound,F=n,Y=s*de,W=a*de,q=l*de,V,$e;E.ori==0?[V,$e]=r(m,w):[$e,V]=r(m,w);let pe=E.dir*(E.ori==0?1:-1),re=E.ori==0?No:vi,ae=E.ori==0?h:(G,ke,Ie,Nn,un,Ot,dn)=>{
h(G,ke,Ie,un,Nn,dn,Ot)},Q=he(m.bands,fi).find(G=>G.series[0]==w),B=Q!=null?Q.dir:0,ye=T.fillTo(m,w,T.min,T.max,B),Le=R(I(ye,C,D,Z)),we,le,rt,Ze=j,ve=R(T.width*de),
Mt=!1,Ft=null,lt=null,Tt=null,J=null;u!=null&&(ve==0||d!=null)&&(Mt=!0,Ft=u.values(m,w,b,S),lt=new Map,new Set(Ft).forEach(G=>{G!=null&&lt.set(G,new Path2D)}),ve>
0&&(Tt=d.values(m,w,b,S),J=new Map,new Set(Tt).forEach(G=>{G!=null&&J.set(G,new Path2D)})));let{x0:ne,size:Fe}=c;if(ne!=null&&Fe!=null){F=1,v=ne.values(m,w,b,S),
ne.unit==2&&(v=v.map(Ie=>m.posToVal(H+Ie*j,E.key,!0)));let G=Fe.values(m,w,b,S);Fe.unit==2?le=G[0]*j:le=_(G[0],E,j,H)-_(0,E,j,H),Ze=Vl(v,A,_,E,j,H,Ze),rt=Ze-le+
Y}else Ze=Vl(v,A,_,E,j,H,Ze),rt=Ze*i+Y,le=Ze-rt;rt<1&&(rt=0),ve>=le/2&&(ve=0),rt<5&&(R=ec);let It=rt>0,hn=Ze-rt-(It?ve:0);le=R(ni(hn,q,W)),we=(F==0?le/2:F==pe?0:
le)-F*pe*((F==0?Y/2:0)+(It?ve/2:0));let Qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Dn=Mt?null:new Path2D,jt=null;if(Q!=null)jt=m.data[Q.series[1]];else{
let{y0:G,y1:ke}=c;G!=null&&ke!=null&&(A=ke.values(m,w,b,S),jt=G.values(m,w,b,S))}let pn=V*le,te=$e*le;for(let G=pe==1?b:S;G>=b&&G<=S;G+=pe){let ke=A[G];if(ke==null)
continue;if(jt!=null){let it=jt[G]??0;if(ke-it==0)continue;Le=I(it,C,D,Z)}let Ie=E.distr!=2||c!=null?v[G]:G,Nn=_(Ie,E,j,H),un=I(he(ke,ye),C,D,Z),Ot=R(Nn-we),dn=R(
ot(un,Le)),ct=R(Rt(un,Le)),yt=dn-ct;if(ke!=null){let it=ke<0?te:pn,At=ke<0?pn:te;Mt?(ve>0&&Tt[G]!=null&&re(J.get(Tt[G]),Ot,ct+mt(ve/2),le,ot(0,yt-ve),it,At),Ft[G]!=
null&&re(lt.get(Ft[G]),Ot,ct+mt(ve/2),le,ot(0,yt-ve),it,At)):re(Dn,Ot,ct+mt(ve/2),le,ot(0,yt-ve),it,At),ae(m,w,G,Ot-ve/2,ct,le+ve,yt)}}return ve>0?Qe.stroke=Mt?
J:Dn:Mt||(Qe._fill=T.width==0?T._fill:T._stroke??T._fill,Qe.width=0),Qe.fill=Mt?lt:Dn,Qe})}function ff(t,e){let n=he(e?.alignGaps,0);return(s,o,r,i)=>_n(s,o,(a,l,c,h,u,d,m,w,b,S,T)=>{
[r,i]=Ao(c,r,i);let v=a.pxRound,A=V=>v(d(V,h,S,w)),E=V=>v(m(V,u,T,b)),C,_,I;h.ori==0?(C=Lo,I=ys,_=Ec):(C=Do,I=ws,_=Pc);let H=h.dir*(h.ori==0?1:-1),Z=A(l[H==1?r:
i]),j=Z,D=[],R=[];for(let V=H==1?r:i;V>=r&&V<=i;V+=H)if(c[V]!=null){let pe=l[V],re=A(pe);D.push(j=re),R.push(E(c[V]))}let F={stroke:t(D,R,C,I,_,v),fill:null,clip:null,
band:null,gaps:null,flags:ms},Y=F.stroke,[W,q]=bi(s,o);if(a.fill!=null||W!=0){let V=F.fill=new Path2D(Y),$e=a.fillTo(s,o,a.min,a.max,W),pe=E($e);I(V,j,pe),I(V,Z,
pe)}if(!a.spanGaps){let V=[];V.push(...xi(l,c,r,i,H,A,n)),F.gaps=V=a.gaps(s,o,r,i,V),F.clip=Co(V,h.ori,w,b,S,T)}return q!=0&&(F.band=q==2?[Jt(s,o,r,i,Y,-1),Jt(s,
o,r,i,Y,1)]:Jt(s,o,r,i,Y,q)),F})}function mf(t){return ff(gf,t)}function gf(t,e,n,s,o,r){let i=t.length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==
2)s(a,t[1],e[1]);else{let l=Array(i),c=Array(i-1),h=Array(i-1),u=Array(i-1);for(let d=0;d<i-1;d++)h[d]=e[d+1]-e[d],u[d]=t[d+1]-t[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<
i-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[i-1]=c[i-2];
for(let d=0;d<i-1;d++)o(a,t[d]+u[d]/3,e[d]+l[d]*u[d]/3,t[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,t[d+1],e[d+1])}return a}var ii=new Set;function jl(){for(let t of ii)t.
syncRect(!0)}gs&&(En(qu,ps,jl),En(Ju,ps,jl,!0),En(So,ps,()=>{We.pxRatio=de}));var yf=Lc(),wf=_c();function Yl(t,e,n,s){return(s?[t[0],t[1]].concat(t.slice(2)):[
t[0]].concat(t.slice(1))).map((r,i)=>ai(r,i,e,n))}function bf(t,e){return t.map((n,s)=>s==0?{}:Re({},e,n))}function ai(t,e,n,s){return Re({},e==0?n:s,t)}function Dc(t,e,n){
return e==null?ds:[e,n]}var xf=Dc;function vf(t,e,n){return e==null?ds:Mo(e,n,ui,!0)}function Nc(t,e,n,s){return e==null?ds:Eo(e,n,t.scales[s].log,!1)}var kf=Nc;
function Rc(t,e,n,s){return e==null?ds:pi(e,n,t.scales[s].log,!1)}var Sf=Rc;function Mf(t,e,n,s,o){let r=ot(Tl(t),Tl(e)),i=e-t,a=Nt(o/s*i,n);do{let l=n[a],c=s*l/
i;if(c>=o&&r+(l<5?an.get(l):0)<=17)return[l,c]}while(++a<n.length);return[0,0]}function Kl(t){let e,n;return t=t.replace(/(\d+)px/,(s,o)=>(e=Oe((n=+o)*de))+"px"),
[t,e,n]}function Tf(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=xe(e[2]*de,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),e[1]=n})}function We(t,e,n){let s={mode:he(
t.mode,1)},o=s.mode;function r(p,f,g,y){let x=f.valToPct(p);return y+g*(f.dir==-1?1-x:x)}function i(p,f,g,y){let x=f.valToPct(p);return y+g*(f.dir==-1?x:1-x)}function a(p,f,g,y){
return f.ori==0?r(p,f,g,y):i(p,f,g,y)}s.valToPosH=r,s.valToPosV=i;let l=!1;s.status=0;let c=s.root=kt(Lu);if(t.id!=null&&(c.id=t.id),ft(c,t.class),t.title){let p=kt(
Ru,c);p.textContent=t.title}let h=Dt("canvas"),u=s.ctx=h.getContext("2d"),d=kt($u,c);En("click",d,p=>{p.target===w&&(Se!=zn||Ee!=Vn)&&qe.click(s,p)},!0);let m=s.
under=kt(Fu,d);d.appendChild(h);let w=s.over=kt(Iu,d);t=fs(t);let b=+he(t.pxAlign,1),S=zl(b);(t.plugins||[]).forEach(p=>{p.opts&&(t=p.opts(s,t)||t)});let T=t.ms||
.001,v=s.series=o==1?Yl(t.series||[],Il,Gl,!1):bf(t.series||[null],Bl),A=s.axes=Yl(t.axes||[],Fl,Ul,!0),E=s.scales={},C=s.bands=t.bands||[];C.forEach(p=>{p.fill=
ie(p.fill||null),p.dir=he(p.dir,-1)});let _=o==2?v[1].facets[0].scale:v[0].scale,I={axes:$p,series:Cp},H=(t.drawOrder||["axes","series"]).map(p=>I[p]);function Z(p){
let f=p.distr==3?g=>qt(g>0?g:p.clamp(s,g,p.min,p.max,p.key)):p.distr==4?g=>Kr(g,p.asinh):p.distr==100?g=>p.fwd(g):g=>g;return g=>{let y=f(g),{_min:x,_max:M}=p,P=M-
x;return(y-x)/P}}function j(p){let f=E[p];if(f==null){let g=(t.scales||Us)[p]||Us;if(g.from!=null){j(g.from);let y=Re({},E[g.from],g,{key:p});y.valToPct=Z(y),E[p]=
y}else{f=E[p]=Re({},p==_?kc:af,g),f.key=p;let y=f.time,x=f.range,M=rn(x);if((p!=_||o==2&&!y)&&(M&&(x[0]==null||x[1]==null)&&(x={min:x[0]==null?kl:{mode:1,hard:x[0],
soft:x[0]},max:x[1]==null?kl:{mode:1,hard:x[1],soft:x[1]}},M=!1),!M&&_o(x))){let P=x;x=(N,$,O)=>$==null?ds:Mo($,O,P)}f.range=ie(x||(y?xf:p==_?f.distr==3?kf:f.distr==
4?Sf:Dc:f.distr==3?Nc:f.distr==4?Rc:vf)),f.auto=ie(M?!1:f.auto),f.clamp=ie(f.clamp||rf),f._min=f._max=null,f.valToPct=Z(f)}}}j("x"),j("y"),o==1&&v.forEach(p=>{j(
p.scale)}),A.forEach(p=>{j(p.scale)});for(let p in t.scales)j(p);let D=E[_],R=D.distr,F,Y;D.ori==0?(ft(c,Du),F=r,Y=i):(ft(c,Nu),F=i,Y=r);let W={};for(let p in E){
let f=E[p];(f.min!=null||f.max!=null)&&(W[p]={min:f.min,max:f.max},f.min=f.max=null)}let q=t.tzDate||(p=>new Date(Oe(p/T))),V=t.fmtDate||mi,$e=T==1?Dd(q):$d(q),
pe=Nl(q,Dl(T==1?Ld:Rd,V)),re=$l(q,Rl(Id,V)),ae=[],Q=s.legend=Re({},Wd,t.legend),B=s.cursor=Re({},jd,{drag:{y:o==2}},t.cursor),ye=Q.show,Le=B.show,we=Q.markers;Q.
idxs=ae,we.width=ie(we.width),we.dash=ie(we.dash),we.stroke=ie(we.stroke),we.fill=ie(we.fill);let le,rt,Ze,ve=[],Mt=[],Ft,lt=!1,Tt={};if(Q.live){let p=v[1]?v[1].
values:null;lt=p!=null,Ft=lt?p(s,1,0):{_:0};for(let f in Ft)Tt[f]=ci}if(ye)if(le=Dt("table",Hu,c),Ze=Dt("tbody",null,le),Q.mount(s,le),lt){rt=Dt("thead",null,le,
Ze);let p=Dt("tr",null,rt);Dt("th",null,p);for(var J in Ft)Dt("th",cl,p).textContent=J}else ft(le,Vu),Q.live&&ft(le,zu);let ne={show:!0},Fe={show:!1};function It(p,f){
if(f==0&&(lt||!Q.live||o==2))return ds;let g=[],y=Dt("tr",ju,Ze,Ze.childNodes[f]);ft(y,p.class),p.show||ft(y,An);let x=Dt("th",null,y);if(we.show){let N=kt(Yu,x);
if(f>0){let $=we.width(s,f);$&&(N.style.border=$+"px "+we.dash(s,f)+" "+we.stroke(s,f)),N.style.background=we.fill(s,f)}}let M=kt(cl,x);p.label instanceof HTMLElement?
M.appendChild(p.label):M.textContent=p.label,f>0&&(we.show||(M.style.color=p.width>0?we.stroke(s,f):we.fill(s,f)),Qe("click",x,N=>{if(B._lock)return;mn(N);let $=v.
indexOf(p);if((N.ctrlKey||N.metaKey)!=Q.isolate){let O=v.some((U,z)=>z>0&&z!=$&&U.show);v.forEach((U,z)=>{z>0&&Wt(z,O?z==$?ne:Fe:ne,!0,De.setSeries)})}else Wt($,
{show:!p.show},!0,De.setSeries)},!1),$n&&Qe(dl,x,N=>{B._lock||(mn(N),Wt(v.indexOf(p),Yn,!0,De.setSeries))},!1));for(var P in Ft){let N=Dt("td",Ku,y);N.textContent=
"--",g.push(N)}return[y,g]}let hn=new Map;function Qe(p,f,g,y=!0){let x=hn.get(f)||{},M=B.bind[p](s,f,g,y);M&&(En(p,f,x[p]=M),hn.set(f,x))}function Dn(p,f,g){let y=hn.
get(f)||{};for(let x in y)(p==null||x==p)&&(ti(x,f,y[x]),delete y[x]);p==null&&hn.delete(f)}let jt=0,pn=0,te=0,G=0,ke=0,Ie=0,Nn=ke,un=Ie,Ot=te,dn=G,ct=0,yt=0,it=0,
At=0;s.bbox={};let hr=!1,Hs=!1,Rn=!1,fn=!1,zs=!1,wt=!1;function pr(p,f,g){(g||p!=s.width||f!=s.height)&&ji(p,f),Wn(!1),Rn=!0,Hs=!0,Bn()}function ji(p,f){s.width=
jt=te=p,s.height=pn=G=f,ke=Ie=0,Sp(),Mp();let g=s.bbox;ct=g.left=Mn(ke*de,.5),yt=g.top=Mn(Ie*de,.5),it=g.width=Mn(te*de,.5),At=g.height=Mn(G*de,.5)}let xp=3;function vp(){
let p=!1,f=0;for(;!p;){f++;let g=Np(f),y=Rp(f);p=f==xp||g&&y,p||(ji(s.width,s.height),Hs=!0)}}function kp({width:p,height:f}){pr(p,f)}s.setSize=kp;function Sp(){
let p=!1,f=!1,g=!1,y=!1;A.forEach((x,M)=>{if(x.show&&x._show){let{side:P,_size:N}=x,$=P%2,O=x.label!=null?x.labelSize:0,U=N+O;U>0&&($?(te-=U,P==3?(ke+=U,y=!0):g=
!0):(G-=U,P==0?(Ie+=U,p=!0):f=!0))}}),gn[0]=p,gn[1]=g,gn[2]=f,gn[3]=y,te-=Zt[1]+Zt[3],ke+=Zt[3],G-=Zt[2]+Zt[0],Ie+=Zt[0]}function Mp(){let p=ke+te,f=Ie+G,g=ke,y=Ie;
function x(M,P){switch(M){case 1:return p+=P,p-P;case 2:return f+=P,f-P;case 3:return g-=P,g+P;case 0:return y-=P,y+P}}A.forEach((M,P)=>{if(M.show&&M._show){let N=M.
side;M._pos=x(N,M._size),M.label!=null&&(M._lpos=x(N,M.labelSize))}})}if(B.dataIdx==null){let p=B.hover,f=p.skip=new Set(p.skip??[]);f.add(void 0);let g=p.prox=
ie(p.prox),y=p.bias??=0;B.dataIdx=(x,M,P,N)=>{if(M==0)return P;let $=P,O=g(x,M,P,N)??be,U=O>=0&&O<be,z=D.ori==0?te:G,ee=B.left,ue=e[0],ce=e[M];if(f.has(ce[P])){
$=null;let oe=null,X=null,K;if(y==0||y==-1)for(K=P;oe==null&&K-- >0;)f.has(ce[K])||(oe=K);if(y==0||y==1)for(K=P;X==null&&K++<ce.length;)f.has(ce[K])||(X=K);if(oe!=
null||X!=null)if(U){let Te=oe==null?-1/0:F(ue[oe],D,z,0),_e=X==null?1/0:F(ue[X],D,z,0),Ye=ee-Te,ge=_e-ee;Ye<=ge?Ye<=O&&($=oe):ge<=O&&($=X)}else $=X==null?oe:oe==
null?X:P-oe<=X-P?oe:X}else U&&Ue(ee-F(ue[P],D,z,0))>O&&($=null);return $}}let mn=p=>{B.event=p};B.idxs=ae,B._lock=!1;let Xe=B.points;Xe.show=ie(Xe.show),Xe.size=
ie(Xe.size),Xe.stroke=ie(Xe.stroke),Xe.width=ie(Xe.width),Xe.fill=ie(Xe.fill);let Ut=s.focus=Re({},t.focus||{alpha:.3},B.focus),$n=Ut.prox>=0,Fn=$n&&Xe.one,bt=[],
In=[],On=[];function Yi(p,f){let g=Xe.show(s,f);if(g instanceof HTMLElement)return ft(g,Gu),ft(g,p.class),Vt(g,-10,-10,te,G),w.insertBefore(g,bt[f]),g}function Ki(p,f){
if(o==1||f>0){let g=o==1&&E[p.scale].time,y=p.value;p.value=g?Pl(y)?$l(q,Rl(y,V)):y||re:y||nf,p.label=p.label||(g?Kd:Yd)}if(Fn||f>0){p.width=p.width==null?1:p.width,
p.paths=p.paths||yf||id,p.fillTo=ie(p.fillTo||lf),p.pxAlign=+he(p.pxAlign,b),p.pxRound=zl(p.pxAlign),p.stroke=ie(p.stroke||null),p.fill=ie(p.fill||null),p._stroke=
p._fill=p._paths=p._focus=null;let g=sf(ot(1,p.width),1),y=p.points=Re({},{size:g,width:ot(1,g*.2),stroke:p.stroke,space:g*2,paths:wf,_stroke:null,_fill:null},p.
points);y.show=ie(y.show),y.filter=ie(y.filter),y.fill=ie(y.fill),y.stroke=ie(y.stroke),y.paths=ie(y.paths),y.pxAlign=p.pxAlign}if(ye){let g=It(p,f);ve.splice(f,
0,g[0]),Mt.splice(f,0,g[1]),Q.values.push(null)}if(Le){ae.splice(f,0,null);let g=null;Fn?f==0&&(g=Yi(p,f)):f>0&&(g=Yi(p,f)),bt.splice(f,0,g),In.splice(f,0,0),On.
splice(f,0,0)}je("addSeries",f)}function Tp(p,f){f=f??v.length,p=o==1?ai(p,f,Il,Gl):ai(p,f,{},Bl),v.splice(f,0,p),Ki(v[f],f)}s.addSeries=Tp;function Ap(p){if(v.
splice(p,1),ye){Q.values.splice(p,1),Mt.splice(p,1);let f=ve.splice(p,1)[0];Dn(null,f.firstChild),f.remove()}Le&&(ae.splice(p,1),bt.splice(p,1)[0].remove(),In.splice(
p,1),On.splice(p,1)),je("delSeries",p)}s.delSeries=Ap;let gn=[!1,!1,!1,!1];function Ep(p,f){if(p._show=p.show,p.show){let g=p.side%2,y=E[p.scale];y==null&&(p.scale=
g?v[1].scale:_,y=E[p.scale]);let x=y.time;p.size=ie(p.size),p.space=ie(p.space),p.rotate=ie(p.rotate),rn(p.incrs)&&p.incrs.forEach(P=>{!an.has(P)&&an.set(P,sc(P))}),
p.incrs=ie(p.incrs||(y.distr==2?Pd:x?T==1?Cd:Nd:Tn)),p.splits=ie(p.splits||(x&&y.distr==1?$e:y.distr==3?si:y.distr==4?Xd:Jd)),p.stroke=ie(p.stroke),p.grid.stroke=
ie(p.grid.stroke),p.ticks.stroke=ie(p.ticks.stroke),p.border.stroke=ie(p.border.stroke);let M=p.values;p.values=rn(M)&&!rn(M[0])?ie(M):x?rn(M)?Nl(q,Dl(M,V)):Pl(
M)?Fd(q,M):M||pe:M||qd,p.filter=ie(p.filter||(y.distr>=3&&y.log==10?ef:y.distr==3&&y.log==2?tf:tc)),p.font=Kl(p.font),p.labelFont=Kl(p.labelFont),p._size=p.size(
s,null,f,0),p._space=p._rotate=p._incrs=p._found=p._splits=p._values=null,p._size>0&&(gn[f]=!0,p._el=kt(Ou,d))}}function ks(p,f,g,y){let[x,M,P,N]=g,$=f%2,O=0;return $==
0&&(N||M)&&(O=f==0&&!x||f==2&&!P?Oe(Fl.size/3):0),$==1&&(x||P)&&(O=f==1&&!M||f==3&&!N?Oe(Ul.size/2):0),O}let qi=s.padding=(t.padding||[ks,ks,ks,ks]).map(p=>ie(he(
p,ks))),Zt=s._padding=qi.map((p,f)=>p(s,f,gn,0)),Ke,Ge=null,He=null,Vs=o==1?v[0].idxs:null,Et=null,Ss=!1;function Ji(p,f){if(e=p??[],s.data=s._data=e,o==2){Ke=0;
for(let g=1;g<v.length;g++)Ke+=e[g][0].length}else{e.length==0&&(s.data=s._data=e=[[]]),Et=e[0],Ke=Et.length;let g=e;if(R==2){g=e.slice();let y=g[0]=Array(Ke);for(let x=0;x<
Ke;x++)y[x]=x}s._data=e=g}if(Wn(!0),je("setData"),R==2&&(Rn=!0),f!==!1){let g=D;g.auto(s,Ss)?ur():en(_,g.min,g.max),fn=fn||B.left>=0,wt=!0,Bn()}}s.setData=Ji;function ur(){
Ss=!0;let p,f;o==1&&(Ke>0?(Ge=Vs[0]=0,He=Vs[1]=Ke-1,p=e[0][Ge],f=e[0][He],R==2?(p=Ge,f=He):p==f&&(R==3?[p,f]=Eo(p,p,D.log,!1):R==4?[p,f]=pi(p,p,D.log,!1):D.time?
f=p+Oe(86400/T):[p,f]=Mo(p,f,ui,!0))):(Ge=Vs[0]=p=null,He=Vs[1]=f=null)),en(_,p,f)}let js,Un,dr,fr,mr,gr,yr,wr,br,at;function Xi(p,f,g,y,x,M){p??=pl,g??=fi,y??=
"butt",x??=pl,M??="round",p!=js&&(u.strokeStyle=js=p),x!=Un&&(u.fillStyle=Un=x),f!=dr&&(u.lineWidth=dr=f),M!=mr&&(u.lineJoin=mr=M),y!=gr&&(u.lineCap=gr=y),g!=fr&&
u.setLineDash(fr=g)}function Zi(p,f,g,y){f!=Un&&(u.fillStyle=Un=f),p!=yr&&(u.font=yr=p),g!=wr&&(u.textAlign=wr=g),y!=br&&(u.textBaseline=br=y)}function xr(p,f,g,y,x=0){
if(y.length>0&&p.auto(s,Ss)&&(f==null||f.min==null)){let M=he(Ge,0),P=he(He,y.length-1),N=g.min==null?ed(y,M,P,x,p.distr==3):[g.min,g.max];p.min=Rt(p.min,g.min=
N[0]),p.max=ot(p.max,g.max=N[1])}}let Qi={min:null,max:null};function Pp(){for(let y in E){let x=E[y];W[y]==null&&(x.min==null||W[_]!=null&&x.auto(s,Ss))&&(W[y]=
Qi)}for(let y in E){let x=E[y];W[y]==null&&x.from!=null&&W[x.from]!=null&&(W[y]=Qi)}W[_]!=null&&Wn(!0);let p={};for(let y in W){let x=W[y];if(x!=null){let M=p[y]=
fs(E[y],cd);if(x.min!=null)Re(M,x);else if(y!=_||o==2)if(Ke==0&&M.from==null){let P=M.range(s,null,null,y);M.min=P[0],M.max=P[1]}else M.min=be,M.max=-be}}if(Ke>
0){v.forEach((y,x)=>{if(o==1){let M=y.scale,P=W[M];if(P==null)return;let N=p[M];if(x==0){let $=N.range(s,N.min,N.max,M);N.min=$[0],N.max=$[1],Ge=Nt(N.min,e[0]),
He=Nt(N.max,e[0]),He-Ge>1&&(e[0][Ge]<N.min&&Ge++,e[0][He]>N.max&&He--),y.min=Et[Ge],y.max=Et[He]}else y.show&&y.auto&&xr(N,P,y,e[x],y.sorted);y.idxs[0]=Ge,y.idxs[1]=
He}else if(x>0&&y.show&&y.auto){let[M,P]=y.facets,N=M.scale,$=P.scale,[O,U]=e[x],z=p[N],ee=p[$];z!=null&&xr(z,W[N],M,O,M.sorted),ee!=null&&xr(ee,W[$],P,U,P.sorted),
y.min=P.min,y.max=P.max}});for(let y in p){let x=p[y],M=W[y];if(x.from==null&&(M==null||M.min==null)){let P=x.range(s,x.min==be?null:x.min,x.max==-be?null:x.max,
y);x.min=P[0],x.max=P[1]}}}for(let y in p){let x=p[y];if(x.from!=null){let M=p[x.from];if(M.min==null)x.min=x.max=null;else{let P=x.range(s,M.min,M.max,y);x.min=
P[0],x.max=P[1]}}}let f={},g=!1;for(let y in p){let x=p[y],M=E[y];if(M.min!=x.min||M.max!=x.max){M.min=x.min,M.max=x.max;let P=M.distr;M._min=P==3?qt(M.min):P==
4?Kr(M.min,M.asinh):P==100?M.fwd(M.min):M.min,M._max=P==3?qt(M.max):P==4?Kr(M.max,M.asinh):P==100?M.fwd(M.max):M.max,f[y]=g=!0}}if(g){v.forEach((y,x)=>{o==2?x>0&&
f.y&&(y._paths=null):f[y.scale]&&(y._paths=null)});for(let y in f)Rn=!0,je("setScale",y);Le&&B.left>=0&&(fn=wt=!0)}for(let y in W)W[y]=null}function _p(p){let f=ni(
Ge-1,0,Ke-1),g=ni(He+1,0,Ke-1);for(;p[f]==null&&f>0;)f--;for(;p[g]==null&&g<Ke-1;)g++;return[f,g]}function Cp(){if(Ke>0){let p=v.some(f=>f._focus)&&at!=Ut.alpha;
p&&(u.globalAlpha=at=Ut.alpha),v.forEach((f,g)=>{if(g>0&&f.show&&(ea(g,!1),ea(g,!0),f._paths==null)){let y=at;at!=f.alpha&&(u.globalAlpha=at=f.alpha);let x=o==2?
[0,e[g][0].length-1]:_p(e[g]);f._paths=f.paths(s,g,x[0],x[1]),at!=y&&(u.globalAlpha=at=y)}}),v.forEach((f,g)=>{if(g>0&&f.show){let y=at;at!=f.alpha&&(u.globalAlpha=
at=f.alpha),f._paths!=null&&ta(g,!1);{let x=f._paths!=null?f._paths.gaps:null,M=f.points.show(s,g,Ge,He,x),P=f.points.filter(s,g,M,x);(M||P)&&(f.points._paths=f.
points.paths(s,g,Ge,He,P),ta(g,!0))}at!=y&&(u.globalAlpha=at=y),je("drawSeries",g)}}),p&&(u.globalAlpha=at=1)}}function ea(p,f){let g=f?v[p].points:v[p];g._stroke=
g.stroke(s,p),g._fill=g.fill(s,p)}function ta(p,f){let g=f?v[p].points:v[p],{stroke:y,fill:x,clip:M,flags:P,_stroke:N=g._stroke,_fill:$=g._fill,_width:O=g.width}=g.
_paths;O=xe(O*de,3);let U=null,z=O%2/2;f&&$==null&&($=O>0?"#fff":N);let ee=g.pxAlign==1&&z>0;if(ee&&u.translate(z,z),!f){let ue=ct-O/2,ce=yt-O/2,oe=it+O,X=At+O;
U=new Path2D,U.rect(ue,ce,oe,X)}f?vr(N,O,g.dash,g.cap,$,y,x,P,M):Lp(p,N,O,g.dash,g.cap,$,y,x,P,U,M),ee&&u.translate(-z,-z)}function Lp(p,f,g,y,x,M,P,N,$,O,U){let z=!1;
$!=0&&C.forEach((ee,ue)=>{if(ee.series[0]==p){let ce=v[ee.series[1]],oe=e[ee.series[1]],X=(ce._paths||Us).band;rn(X)&&(X=ee.dir==1?X[0]:X[1]);let K,Te=null;ce.show&&
X&&nd(oe,Ge,He)?(Te=ee.fill(s,ue)||M,K=ce._paths.clip):X=null,vr(f,g,y,x,Te,P,N,$,O,U,K,X),z=!0}}),z||vr(f,g,y,x,M,P,N,$,O,U)}let na=ms|ri;function vr(p,f,g,y,x,M,P,N,$,O,U,z){
Xi(p,f,g,y,x),($||O||z)&&(u.save(),$&&u.clip($),O&&u.clip(O)),z?(N&na)==na?(u.clip(z),U&&u.clip(U),Ks(x,P),Ys(p,M,f)):N&ri?(Ks(x,P),u.clip(z),Ys(p,M,f)):N&ms&&(u.
save(),u.clip(z),U&&u.clip(U),Ks(x,P),u.restore(),Ys(p,M,f)):(Ks(x,P),Ys(p,M,f)),($||O||z)&&u.restore()}function Ys(p,f,g){g>0&&(f instanceof Map?f.forEach((y,x)=>{
u.strokeStyle=js=x,u.stroke(y)}):f!=null&&p&&u.stroke(f))}function Ks(p,f){f instanceof Map?f.forEach((g,y)=>{u.fillStyle=Un=y,u.fill(g)}):f!=null&&p&&u.fill(f)}
function Dp(p,f,g,y){let x=A[p],M;if(y<=0)M=[0,0];else{let P=x._space=x.space(s,p,f,g,y),N=x._incrs=x.incrs(s,p,f,g,y,P);M=Mf(f,g,N,y,P)}return x._found=M}function kr(p,f,g,y,x,M,P,N,$,O){
let U=P%2/2;b==1&&u.translate(U,U),Xi(N,P,$,O,N),u.beginPath();let z,ee,ue,ce,oe=x+(y==0||y==3?-M:M);g==0?(ee=x,ce=oe):(z=x,ue=oe);for(let X=0;X<p.length;X++)f[X]!=
null&&(g==0?z=ue=p[X]:ee=ce=p[X],u.moveTo(z,ee),u.lineTo(ue,ce));u.stroke(),b==1&&u.translate(-U,-U)}function Np(p){let f=!0;return A.forEach((g,y)=>{if(!g.show)
return;let x=E[g.scale];if(x.min==null){g._show&&(f=!1,g._show=!1,Wn(!1));return}else g._show||(f=!1,g._show=!0,Wn(!1));let M=g.side,P=M%2,{min:N,max:$}=x,[O,U]=Dp(
y,N,$,P==0?te:G);if(U==0)return;let z=x.distr==2,ee=g._splits=g.splits(s,y,N,$,O,U,z),ue=x.distr==2?ee.map(K=>Et[K]):ee,ce=x.distr==2?Et[ee[1]]-Et[ee[0]]:O,oe=g.
_values=g.values(s,g.filter(s,ue,y,U,ce),y,U,ce);g._rotate=M==2?g.rotate(s,oe,y,U):0;let X=g._size;g._size=St(g.size(s,oe,y,p)),X!=null&&g._size!=X&&(f=!1)}),f}
function Rp(p){let f=!0;return qi.forEach((g,y)=>{let x=g(s,y,gn,p);x!=Zt[y]&&(f=!1),Zt[y]=x}),f}function $p(){for(let p=0;p<A.length;p++){let f=A[p];if(!f.show||
!f._show)continue;let g=f.side,y=g%2,x,M,P=f.stroke(s,p),N=g==0||g==3?-1:1,[$,O]=f._found;if(f.label!=null){let tt=f.labelGap*N,ut=Oe((f._lpos+tt)*de);Zi(f.labelFont[0],
P,"center",g==2?"top":hl),u.save(),y==1?(x=M=0,u.translate(ut,Oe(yt+At/2)),u.rotate((g==3?-ko:ko)/2)):(x=Oe(ct+it/2),M=ut);let bn=Ql(f.label)?f.label(s,p,$,O):f.
label;u.fillText(bn,x,M),u.restore()}if(O==0)continue;let U=E[f.scale],z=y==0?it:At,ee=y==0?ct:yt,ue=f._splits,ce=U.distr==2?ue.map(tt=>Et[tt]):ue,oe=U.distr==2?
Et[ue[1]]-Et[ue[0]]:$,X=f.ticks,K=f.border,Te=X.show?X.size:0,_e=Oe(Te*de),Ye=Oe((f.alignTo==2?f._size-Te-f.gap:f.gap)*de),ge=f._rotate*-ko/180,Ce=S(f._pos*de),
ht=(_e+Ye)*N,et=Ce+ht;M=y==0?et:0,x=y==1?et:0;let xt=f.font[0],Pt=f.align==1?cs:f.align==2?Vr:ge>0?cs:ge<0?Vr:y==0?"center":g==3?Vr:cs,Gt=ge||y==1?"middle":g==2?
"top":hl;Zi(xt,P,Pt,Gt);let pt=f.font[1]*f.lineGap,vt=ue.map(tt=>S(a(tt,U,z,ee))),_t=f._values;for(let tt=0;tt<_t.length;tt++){let ut=_t[tt];if(ut!=null){y==0?x=
vt[tt]:M=vt[tt],ut=""+ut;let bn=ut.indexOf(`
`)==-1?[ut]:ut.split(/\n/gm);for(let nt=0;nt<bn.length;nt++){let va=bn[nt];ge?(u.save(),u.translate(x,M+nt*pt),u.rotate(ge),u.fillText(va,0,0),u.restore()):u.fillText(
va,x,M+nt*pt)}}}X.show&&kr(vt,X.filter(s,ce,p,O,oe),y,g,Ce,_e,xe(X.width*de,3),X.stroke(s,p),X.dash,X.cap);let Ht=f.grid;Ht.show&&kr(vt,Ht.filter(s,ce,p,O,oe),y,
y==0?2:1,y==0?yt:ct,y==0?At:it,xe(Ht.width*de,3),Ht.stroke(s,p),Ht.dash,Ht.cap),K.show&&kr([Ce],[1],y==0?1:0,y==0?1:2,y==1?yt:ct,y==1?At:it,xe(K.width*de,3),K.stroke(
s,p),K.dash,K.cap)}je("drawAxes")}function Wn(p){v.forEach((f,g)=>{g>0&&(f._paths=null,p&&(o==1?(f.min=null,f.max=null):f.facets.forEach(y=>{y.min=null,y.max=null})))})}
let qs=!1,Sr=!1,Ms=[];function Fp(){Sr=!1;for(let p=0;p<Ms.length;p++)je(...Ms[p]);Ms.length=0}function Bn(){qs||(gd(sa),qs=!0)}function Ip(p,f=!1){qs=!0,Sr=f,p(
s),sa(),f&&Ms.length>0&&queueMicrotask(Fp)}s.batch=Ip;function sa(){if(hr&&(Pp(),hr=!1),Rn&&(vp(),Rn=!1),Hs){if(Ae(m,cs,ke),Ae(m,"top",Ie),Ae(m,$s,te),Ae(m,Fs,G),
Ae(w,cs,ke),Ae(w,"top",Ie),Ae(w,$s,te),Ae(w,Fs,G),Ae(d,$s,jt),Ae(d,Fs,pn),h.width=Oe(jt*de),h.height=Oe(pn*de),A.forEach(({_el:p,_show:f,_size:g,_pos:y,side:x})=>{
if(p!=null)if(f){let M=x===3||x===0?g:0,P=x%2==1;Ae(p,P?"left":"top",y-M),Ae(p,P?"width":"height",g),Ae(p,P?"top":"left",P?Ie:ke),Ae(p,P?"height":"width",P?G:te),
ei(p,An)}else ft(p,An)}),js=Un=dr=mr=gr=yr=wr=br=fr=null,at=1,Es(!0),ke!=Nn||Ie!=un||te!=Ot||G!=dn){Wn(!1);let p=te/Ot,f=G/dn;if(Le&&!fn&&B.left>=0){B.left*=p,B.
top*=f,Gn&&Vt(Gn,Oe(B.left),0,te,G),Hn&&Vt(Hn,0,Oe(B.top),te,G);for(let g=0;g<bt.length;g++){let y=bt[g];y!=null&&(In[g]*=p,On[g]*=f,Vt(y,St(In[g]),St(On[g]),te,
G))}}if(Me.show&&!zs&&Me.left>=0&&Me.width>0){Me.left*=p,Me.width*=p,Me.top*=f,Me.height*=f;for(let g in _r)Ae(jn,g,Me[g])}Nn=ke,un=Ie,Ot=te,dn=G}je("setSize"),
Hs=!1}jt>0&&pn>0&&(u.clearRect(0,0,h.width,h.height),je("drawClear"),H.forEach(p=>p()),je("draw")),Me.show&&zs&&(Js(Me),zs=!1),Le&&fn&&(wn(null,!0,!1),fn=!1),Q.
show&&Q.live&&wt&&(Er(),wt=!1),l||(l=!0,s.status=1,je("ready")),Ss=!1,qs=!1}s.redraw=(p,f)=>{Rn=f||!1,p!==!1?en(_,D.min,D.max):Bn()};function Mr(p,f){let g=E[p];
if(g.from==null){if(Ke==0){let y=g.range(s,f.min,f.max,p);f.min=y[0],f.max=y[1]}if(f.min>f.max){let y=f.min;f.min=f.max,f.max=y}if(Ke>1&&f.min!=null&&f.max!=null&&
f.max-f.min<1e-16)return;p==_&&g.distr==2&&Ke>0&&(f.min=Nt(f.min,e[0]),f.max=Nt(f.max,e[0]),f.min==f.max&&f.max++),W[p]=f,hr=!0,Bn()}}s.setScale=Mr;let Tr,Ar,Gn,
Hn,oa,ra,zn,Vn,ia,aa,Se,Ee,Qt=!1,qe=B.drag,ze=qe.x,Ve=qe.y;Le&&(B.x&&(Tr=kt(Wu,w)),B.y&&(Ar=kt(Bu,w)),D.ori==0?(Gn=Tr,Hn=Ar):(Gn=Ar,Hn=Tr),Se=B.left,Ee=B.top);let Me=s.
select=Re({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),jn=Me.show?kt(Uu,Me.over?w:m):null;function Js(p,f){if(Me.show){for(let g in p)Me[g]=p[g],g in
_r&&Ae(jn,g,p[g]);f!==!1&&je("setSelect")}}s.setSelect=Js;function Op(p){if(v[p].show)ye&&ei(ve[p],An);else if(ye&&ft(ve[p],An),Le){let g=Fn?bt[0]:bt[p];g!=null&&
Vt(g,-10,-10,te,G)}}function en(p,f,g){Mr(p,{min:f,max:g})}function Wt(p,f,g,y){f.focus!=null&&Hp(p),f.show!=null&&v.forEach((x,M)=>{M>0&&(p==M||p==null)&&(x.show=
f.show,Op(M),o==2?(en(x.facets[0].scale,null,null),en(x.facets[1].scale,null,null)):en(x.scale,null,null),Bn())}),g!==!1&&je("setSeries",p,f),y&&Ps("setSeries",
s,p,f)}s.setSeries=Wt;function Up(p,f){Re(C[p],f)}function Wp(p,f){p.fill=ie(p.fill||null),p.dir=he(p.dir,-1),f=f??C.length,C.splice(f,0,p)}function Bp(p){p==null?
C.length=0:C.splice(p,1)}s.addBand=Wp,s.setBand=Up,s.delBand=Bp;function Gp(p,f){v[p].alpha=f,Le&&bt[p]!=null&&(bt[p].style.opacity=f),ye&&ve[p]&&(ve[p].style.opacity=
f)}let Yt,tn,yn,Yn={focus:!0};function Hp(p){if(p!=yn){let f=p==null,g=Ut.alpha!=1;v.forEach((y,x)=>{if(o==1||x>0){let M=f||x==0||x==p;y._focus=f?null:M,g&&Gp(x,
M?1:Ut.alpha)}}),yn=p,g&&Bn()}}ye&&$n&&Qe(fl,le,p=>{B._lock||(mn(p),yn!=null&&Wt(null,Yn,!0,De.setSeries))});function Bt(p,f,g){let y=E[f];g&&(p=p/de-(y.ori==1?
Ie:ke));let x=te;y.ori==1&&(x=G,p=x-p),y.dir==-1&&(p=x-p);let M=y._min,P=y._max,N=p/x,$=M+(P-M)*N,O=y.distr;return O==3?us(10,$):O==4?od($,y.asinh):O==100?y.bwd(
$):$}function zp(p,f){let g=Bt(p,_,f);return Nt(g,e[0],Ge,He)}s.valToIdx=p=>Nt(p,e[0]),s.posToIdx=zp,s.posToVal=Bt,s.valToPos=(p,f,g)=>E[f].ori==0?r(p,E[f],g?it:
te,g?ct:0):i(p,E[f],g?At:G,g?yt:0),s.setCursor=(p,f,g)=>{Se=p.left,Ee=p.top,wn(null,f,g)};function la(p,f){Ae(jn,cs,Me.left=p),Ae(jn,$s,Me.width=f)}function ca(p,f){
Ae(jn,"top",Me.top=p),Ae(jn,Fs,Me.height=f)}let Ts=D.ori==0?la:ca,As=D.ori==1?la:ca;function Vp(){if(ye&&Q.live)for(let p=o==2?1:0;p<v.length;p++){if(p==0&&lt)continue;
let f=Q.values[p],g=0;for(let y in f)Mt[p][g++].firstChild.nodeValue=f[y]}}function Er(p,f){if(p!=null&&(p.idxs?p.idxs.forEach((g,y)=>{ae[y]=g}):ld(p.idx)||ae.fill(
p.idx),Q.idx=ae[0]),ye&&Q.live){for(let g=0;g<v.length;g++)(g>0||o==1&&!lt)&&jp(g,ae[g]);Vp()}wt=!1,f!==!1&&je("setLegend")}s.setLegend=Er;function jp(p,f){let g=v[p],
y=p==0&&R==2?Et:e[p],x;lt?x=g.values(s,p,f)??Tt:(x=g.value(s,f==null?null:y[f],p,f),x=x==null?Tt:{_:x}),Q.values[p]=x}function wn(p,f,g){ia=Se,aa=Ee,[Se,Ee]=B.move(
s,Se,Ee),B.left=Se,B.top=Ee,Le&&(Gn&&Vt(Gn,Oe(Se),0,te,G),Hn&&Vt(Hn,0,Oe(Ee),te,G));let y,x=Ge>He;Yt=be,tn=null;let M=D.ori==0?te:G,P=D.ori==1?te:G;if(Se<0||Ke==
0||x){y=B.idx=null;for(let N=0;N<v.length;N++){let $=bt[N];$!=null&&Vt($,-10,-10,te,G)}$n&&Wt(null,Yn,!0,p==null&&De.setSeries),Q.live&&(ae.fill(y),wt=!0)}else{
let N,$,O;o==1&&(N=D.ori==0?Se:Ee,$=Bt(N,_),y=B.idx=Nt($,e[0],Ge,He),O=F(e[0][y],D,M,0));let U=-10,z=-10,ee=0,ue=0,ce=!0,oe="",X="";for(let K=o==2?1:0;K<v.length;K++){
let Te=v[K],_e=ae[K],Ye=_e==null?null:o==1?e[K][_e]:e[K][1][_e],ge=B.dataIdx(s,K,y,$),Ce=ge==null?null:o==1?e[K][ge]:e[K][1][ge];if(wt=wt||Ce!=Ye||ge!=_e,ae[K]=
ge,K>0&&Te.show){let ht=ge==null?-10:ge==y?O:F(o==1?e[0][ge]:e[K][0][ge],D,M,0),et=Ce==null?-10:Y(Ce,o==1?E[Te.scale]:E[Te.facets[1].scale],P,0);if($n&&Ce!=null){
let xt=D.ori==1?Se:Ee,Pt=Ue(Ut.dist(s,K,ge,et,xt));if(Pt<Yt){let Gt=Ut.bias;if(Gt!=0){let pt=Bt(xt,Te.scale),vt=Ce>=0?1:-1,_t=pt>=0?1:-1;_t==vt&&(_t==1?Gt==1?Ce>=
pt:Ce<=pt:Gt==1?Ce<=pt:Ce>=pt)&&(Yt=Pt,tn=K)}else Yt=Pt,tn=K}}if(wt||Fn){let xt,Pt;D.ori==0?(xt=ht,Pt=et):(xt=et,Pt=ht);let Gt,pt,vt,_t,Ht,tt,ut=!0,bn=Xe.bbox;if(bn!=
null){ut=!1;let nt=bn(s,K);vt=nt.left,_t=nt.top,Gt=nt.width,pt=nt.height}else vt=xt,_t=Pt,Gt=pt=Xe.size(s,K);if(tt=Xe.fill(s,K),Ht=Xe.stroke(s,K),Fn)K==tn&&Yt<=
Ut.prox&&(U=vt,z=_t,ee=Gt,ue=pt,ce=ut,oe=tt,X=Ht);else{let nt=bt[K];nt!=null&&(In[K]=vt,On[K]=_t,vl(nt,Gt,pt,ut),bl(nt,tt,Ht),Vt(nt,St(vt),St(_t),te,G))}}}}if(Fn){
let K=Ut.prox,Te=yn==null?Yt<=K:Yt>K||tn!=yn;if(wt||Te){let _e=bt[0];_e!=null&&(In[0]=U,On[0]=z,vl(_e,ee,ue,ce),bl(_e,oe,X),Vt(_e,St(U),St(z),te,G))}}}if(Me.show&&
Qt)if(p!=null){let[N,$]=De.scales,[O,U]=De.match,[z,ee]=p.cursor.sync.scales,ue=p.cursor.drag;if(ze=ue._x,Ve=ue._y,ze||Ve){let{left:ce,top:oe,width:X,height:K}=p.
select,Te=p.scales[z].ori,_e=p.posToVal,Ye,ge,Ce,ht,et,xt=N!=null&&O(N,z),Pt=$!=null&&U($,ee);xt&&ze?(Te==0?(Ye=ce,ge=X):(Ye=oe,ge=K),Ce=E[N],ht=F(_e(Ye,z),Ce,M,
0),et=F(_e(Ye+ge,z),Ce,M,0),Ts(Rt(ht,et),Ue(et-ht))):Ts(0,M),Pt&&Ve?(Te==1?(Ye=ce,ge=X):(Ye=oe,ge=K),Ce=E[$],ht=Y(_e(Ye,ee),Ce,P,0),et=Y(_e(Ye+ge,ee),Ce,P,0),As(
Rt(ht,et),Ue(et-ht))):As(0,P)}else Cr()}else{let N=Ue(ia-oa),$=Ue(aa-ra);if(D.ori==1){let ee=N;N=$,$=ee}ze=qe.x&&N>=qe.dist,Ve=qe.y&&$>=qe.dist;let O=qe.uni;O!=
null?ze&&Ve&&(ze=N>=O,Ve=$>=O,!ze&&!Ve&&($>N?Ve=!0:ze=!0)):qe.x&&qe.y&&(ze||Ve)&&(ze=Ve=!0);let U,z;ze&&(D.ori==0?(U=zn,z=Se):(U=Vn,z=Ee),Ts(Rt(U,z),Ue(z-U)),Ve||
As(0,P)),Ve&&(D.ori==1?(U=zn,z=Se):(U=Vn,z=Ee),As(Rt(U,z),Ue(z-U)),ze||Ts(0,M)),!ze&&!Ve&&(Ts(0,0),As(0,0))}if(qe._x=ze,qe._y=Ve,p==null){if(g){if(xa!=null){let[
N,$]=De.scales;De.values[0]=N!=null?Bt(D.ori==0?Se:Ee,N):null,De.values[1]=$!=null?Bt(D.ori==1?Se:Ee,$):null}Ps(jr,s,Se,Ee,te,G,y)}if($n){let N=g&&De.setSeries,
$=Ut.prox;yn==null?Yt<=$&&Wt(tn,Yn,!0,N):Yt>$?Wt(null,Yn,!0,N):tn!=yn&&Wt(tn,Yn,!0,N)}}wt&&(Q.idx=y,Er()),f!==!1&&je("setCursor")}let nn=null;Object.defineProperty(
s,"rect",{get(){return nn==null&&Es(!1),nn}});function Es(p=!1){p?nn=null:(nn=w.getBoundingClientRect(),je("syncRect",nn))}function ha(p,f,g,y,x,M,P){B._lock||Qt&&
p!=null&&p.movementX==0&&p.movementY==0||(Pr(p,f,g,y,x,M,P,!1,p!=null),p!=null?wn(null,!0,!0):wn(f,!0,!1))}function Pr(p,f,g,y,x,M,P,N,$){if(nn==null&&Es(!1),mn(
p),p!=null)g=p.clientX-nn.left,y=p.clientY-nn.top;else{if(g<0||y<0){Se=-10,Ee=-10;return}let[O,U]=De.scales,z=f.cursor.sync,[ee,ue]=z.values,[ce,oe]=z.scales,[X,
K]=De.match,Te=f.axes[0].side%2==1,_e=D.ori==0?te:G,Ye=D.ori==1?te:G,ge=Te?M:x,Ce=Te?x:M,ht=Te?y:g,et=Te?g:y;if(ce!=null?g=X(O,ce)?a(ee,E[O],_e,0):-10:g=_e*(ht/
ge),oe!=null?y=K(U,oe)?a(ue,E[U],Ye,0):-10:y=Ye*(et/Ce),D.ori==1){let xt=g;g=y,y=xt}}$&&(f==null||f.cursor.event.type==jr)&&((g<=1||g>=te-1)&&(g=Mn(g,te)),(y<=1||
y>=G-1)&&(y=Mn(y,G))),N?(oa=g,ra=y,[zn,Vn]=B.move(s,g,y)):(Se=g,Ee=y)}let _r={width:0,height:0,left:0,top:0};function Cr(){Js(_r,!1)}let pa,ua,da,fa;function ma(p,f,g,y,x,M,P){
Qt=!0,ze=Ve=qe._x=qe._y=!1,Pr(p,f,g,y,x,M,P,!0,!1),p!=null&&(Qe(Yr,Zr,ga,!1),Ps(ul,s,zn,Vn,te,G,null));let{left:N,top:$,width:O,height:U}=Me;pa=N,ua=$,da=O,fa=U}
function ga(p,f,g,y,x,M,P){Qt=qe._x=qe._y=!1,Pr(p,f,g,y,x,M,P,!1,!0);let{left:N,top:$,width:O,height:U}=Me,z=O>0||U>0,ee=pa!=N||ua!=$||da!=O||fa!=U;if(z&&ee&&Js(
Me),qe.setScale&&z&&ee){let ue=N,ce=O,oe=$,X=U;if(D.ori==1&&(ue=$,ce=U,oe=N,X=O),ze&&en(_,Bt(ue,_),Bt(ue+ce,_)),Ve)for(let K in E){let Te=E[K];K!=_&&Te.from==null&&
Te.min!=be&&en(K,Bt(oe+X,K),Bt(oe,K))}Cr()}else B.lock&&(B._lock=!B._lock,wn(f,!0,p!=null));p!=null&&(Dn(Yr,Zr),Ps(Yr,s,Se,Ee,te,G,null))}function Yp(p,f,g,y,x,M,P){
if(B._lock)return;mn(p);let N=Qt;if(Qt){let $=!0,O=!0,U=10,z,ee;D.ori==0?(z=ze,ee=Ve):(z=Ve,ee=ze),z&&ee&&($=Se<=U||Se>=te-U,O=Ee<=U||Ee>=G-U),z&&$&&(Se=Se<zn?0:
te),ee&&O&&(Ee=Ee<Vn?0:G),wn(null,!0,!0),Qt=!1}Se=-10,Ee=-10,ae.fill(null),wn(null,!0,!0),N&&(Qt=N)}function ya(p,f,g,y,x,M,P){B._lock||(mn(p),ur(),Cr(),p!=null&&
Ps(ml,s,Se,Ee,te,G,null))}function wa(){A.forEach(Tf),pr(s.width,s.height,!0)}En(So,ps,wa);let Kn={};Kn.mousedown=ma,Kn.mousemove=ha,Kn.mouseup=ga,Kn.dblclick=ya,
Kn.setSeries=(p,f,g,y)=>{let x=De.match[2];g=x(s,f,g),g!=-1&&Wt(g,y,!0,!1)},Le&&(Qe(ul,w,ma),Qe(jr,w,ha),Qe(dl,w,p=>{mn(p),Es(!1)}),Qe(fl,w,Yp),Qe(ml,w,ya),ii.add(
s),s.syncRect=Es);let Xs=s.hooks=t.hooks||{};function je(p,f,g){Sr?Ms.push([p,f,g]):p in Xs&&Xs[p].forEach(y=>{y.call(null,s,f,g)})}(t.plugins||[]).forEach(p=>{
for(let f in p.hooks)Xs[f]=(Xs[f]||[]).concat(p.hooks[f])});let ba=(p,f,g)=>g,De=Re({key:null,setSeries:!1,filters:{pub:Al,sub:Al},scales:[_,v[1]?v[1].scale:null],
match:[El,El,ba],values:[null,null]},B.sync);De.match.length==2&&De.match.push(ba),B.sync=De;let xa=De.key,Lr=Sc(xa);function Ps(p,f,g,y,x,M,P){De.filters.pub(p,
f,g,y,x,M,P)&&Lr.pub(p,f,g,y,x,M,P)}Lr.sub(s);function Kp(p,f,g,y,x,M,P){De.filters.sub(p,f,g,y,x,M,P)&&Kn[p](null,f,g,y,x,M,P)}s.pub=Kp;function qp(){Lr.unsub(
s),ii.delete(s),hn.clear(),ti(So,ps,wa),c.remove(),le?.remove(),je("destroy")}s.destroy=qp;function Dr(){je("init",t,e),Ji(e||t.data,!1),W[_]?Mr(_,W[_]):ur(),zs=
Me.show&&(Me.width>0||Me.height>0),fn=wt=!0,pr(t.width,t.height)}return v.forEach(Ki),A.forEach(Ep),n?n instanceof HTMLElement?(n.appendChild(c),Dr()):n(s,Dr):Dr(),
s}We.assign=Re;We.fmtNum=di;We.rangeNum=Mo;We.rangeLog=Eo;We.rangeAsinh=pi;We.orient=_n;We.pxRatio=de;We.join=md;We.fmtDate=mi,We.tzDate=Ad;We.sync=Sc;{We.addGap=
cf,We.clipGaps=Co;let t=We.paths={points:_c};t.linear=Lc,t.stepped=uf,t.bars=df,t.spline=mf}var Ro=128,$c=50,Af=.25,Ef=t=>[t.ray,t.truth,t.sensor,t.noReturn],Pf=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),_f=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),$o=(t,e)=>({font:ao,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function Fc(t,e,n){let s=null,o=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>s&&r()>0&&s.setSize({width:r(),height:Ro})).
observe(t),i=>r()<=0?null:((!s||i||o!==n())&&(s?.destroy(),s=e(),s.setSize({width:r(),height:Ro}),o=n()),s)}function Ic(t,e){let{session:n}=t,s=k("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),o="all",r=t.segmented("Trace",[["all","All"],["first",`First ${$c}`]],()=>o,w=>{o=w,c=null,n.changed()}),
i=0,a=-1/0,l=-1,c=null,u=Fc(s,()=>{let w=Ef(e()),b=Array.from({length:i},(S,T)=>({label:`chain ${T+1}`,stroke:w[T%w.length],width:1,points:{show:!1}}));return new We(
{width:100,height:Ro,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,_f,0,0],scales:{x:{time:!1,range:(S,T,v)=>[T,Math.max(v,T+1)]},y:{range:(S,T,v)=>Nf(
Math.max(T,a),v)}},axes:[$o(e,26),$o(e,Pf)],series:[{label:"sweep"},...b],hooks:{draw:[S=>$f(S,l,e()),S=>Rf(S,c?.burned??0,e())]}},[[],...b.map(()=>[])],s)},e),
d=k("span",{className:"caption",textContent:"log joint by sweep"}),m=k("div",{className:"charted"},k("div",{className:"buttons"},r,d),s);return t.each(()=>{let w=n.
shown,b=w?.traced?.length?w.trace.length/w.traced.length:0;if(L(m,"hidden",b===0),!w||!b)return;let S=n.document?.source.kind==="run"?"draw":"sweep";L(d,"textCo\
ntent",`log joint by ${S}`);let T=w.layer==="draw"&&n.draws.count?(n.draw+1)*w.traced[w.traced.length-1]/n.draws.count:-1,v=u(b!==i&&(i=b,!0));if(!v||c===w&&l===
T&&v.data[0].length)return;[c,l]=[w,T],a=o==="all"?Df(w,b):-1/0;let A=Cf(w,b,o);v.setData(A),s.setAttribute("data-sweeps",A[0].join())}),m}function Cf({trace:t,
traced:e},n,s){let o=s==="all"?Lf(e):[...e.keys()].filter(i=>e[i]<=$c),r=i=>Float32Array.from(o,a=>i[a]);return[r(e),...Array.from({length:n},(i,a)=>r(t.subarray(
a*e.length,(a+1)*e.length)))]}function Lf(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,s=-1/0;return[...t.keys()].filter(o=>t[o]<s&&o<e-1?!1:
(s=t[o]+n,!0))}function Df({trace:t,traced:e},n){let s=e.length,o=e.findIndex(r=>r>=Af*e[s-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.min(...t.slice(
i*s+o,(i+1)*s))))}function Nf(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function Rf(t,e,n){let{left:s,top:o,width:r,height:i}=t.bbox;e&&(t.ctx.save(),t.
ctx.globalAlpha=.12,t.ctx.fillStyle=n.axis,t.ctx.fillRect(s,o,Math.min(r,Math.max(0,t.valToPos(e,"x",!0)-s)),i),t.ctx.restore())}function $f(t,e,n){if(e<0)return;
let{left:s,top:o,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<s||a>s+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,o,2,i),t.ctx.restore())}function Oc(t,e){
let{session:n}=t,s=k("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),o=k("div",{className:"caption",textContent:"partic\
les by weight, nats below the heaviest"}),r=k("div",{className:"charted"},o,s),a=Fc(s,()=>new We({width:100,height:Ro,legend:{show:!1},cursor:{show:!1},padding:[
8,10,0,0],scales:{x:{time:!1,range:(c,h,u)=>[h,u]},y:{distr:3,range:(c,h,u)=>[.5,Math.max(10,2*u)]}},axes:[$o(e,26),{...$o(e,52),values:(c,h)=>h.map(u=>u>=1?String(
u):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:We.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],s),e),l=null;return t.each(()=>{let c=n.
shown;L(r,"hidden",!c?.weights);let h=c?.weights&&a(!1);if(!c?.weights||!h||l===c&&h.data[0].length)return;l=c;let u=[...c.weights],d=-(c.lowest??-1)/u.length,m=[
...u.map((w,b)=>(c.lowest??-1)+b*d),0];h.setData([m,[...u.map(w=>w||null),null]])}),r}function Uc(t){let{session:e,hand:n}=t,{decisions:s}=e,o=k("p",{className:"said",role:"status"}),r=k("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>s.radius,c=>s.set({radius:c}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>s.risk,c=>s.set({risk:c}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,o),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{L(l,"textContent",i()),L(o,"textContent",n.tool==="path"?Ff(t):If(t))}),a}function Ff({session:t}){let{start:e,goal:n,path:s,
trouble:o}=t.decisions;if(o)return o;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!s)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=s.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${fe(
s.length_m,2)} m, free with probability ${fe(s.probability,3)} ± ${fe(s.standard_error,3)} by ${s.draws} draws. Independent cells would say ${fe(s.independent,
3)}.${r}`}function If({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let s=Math.max(...e.
nats),o=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${fe(Math.min(...e.nats),1)} to ${fe(s,1)} nats, cells taken for indepen\
dent; the best place has a ring.${o}`}var Of=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Uf="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",Wf="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Bf="Shown is what the reading\
s tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (wi\
dth). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Gf="While you edit, the answer is belief pr\
opagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",Hf="This page samples by itself: the answer is that of the chosen method\
 after as many sweeps as are shown, and gets better as they go on.",zf="The map is made from the scans of this log. Where its poses are raw odometry, Run first \
infers where the robot was; then it samples maps.",Vf="This is a saved run: its draws, and what they say together.",jf="Mouse: the wheel zooms, the middle butto\
n pans.",Yf="Shift or the right button erases, and so does a click on a wall.",Kf="Touch: two fingers zoom and pan.";function Wc(t){let{session:e}=t,n=k("div"),
s=Oa.map(([i,a,l])=>{let c=k("tr",{},k("th",{scope:"row"},k("kbd",{textContent:i})),k("td",{textContent:a}));return t.visible(c,()=>qf[l??"all"](e)),c}),o=k("p"),
r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?Bf:Wf,l=e.editable?[`${Uf} ${a}`,e.figure?Hf:Gf]:i==="log"?[a,zf]:i==="run"?[a,Vf]:[
a];l.join()!==r&&n.replaceChildren(...l.map(c=>k("p",{textContent:c}))),r=l.join(),L(o,"textContent",[jf,...e.editable?[Yf]:[],Kf].join(" "))}),t.dialog("Help",
n,o,k("table",{},k("tbody",{},...s)))}var qf={all:()=>!0,drawn:t=>t.editable,asked:t=>t.answers,edited:t=>!t.recorded,inferred:t=>!t.recorded&&t.document?.source.
kind!=="run"};function Bc(t){let e=()=>k("input",{type:"number",step:1,required:!0,value:"21"}),[n,s]=[e(),e()];for(let i of[n,s])t.bounded(i,"side");let o=k("s\
elect",{});for(let[i,a]of Of){let l=k("option",{value:i,textContent:a});o.append(l),i!=="blank"&&t.each(()=>L(l,"disabled",t.session.figure))}t.each(()=>t.session.
figure&&L(o,"value","blank")),o.addEventListener("change",()=>{o.value==="building"&&Number(n.value)<60&&([n.value,s.value]=["120","80"])});let r=k("form",{method:"\
dialog"},t.row("World",o),t.row("Width (cells)",n),t.row("Height (cells)",s),k("div",{className:"buttons end"},k("button",{type:"submit",className:"primary",textContent:"\
Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),Number(s.value)],world:o.value}),t.hand.selected=null}),t.dialog(
"New map",r)}var Jf="The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server runs; the part \
from # on can be put after the address of any bayesmap page.",Xf="The link holds the walls, the sensors and all settings after its #. The part from # on can be \
put after the address of any bayesmap page.",Zf="The link holds the file's name and all settings after its #, but no scans and no token. It opens in this browse\
r while the server shows this file; the part from # on can be put after the address of any bayesmap page that shows it.";function Gc(t){let e=k("input",{type:"t\
ext",readOnly:!0,"aria-label":"Link"}),n=k("span",{role:"status",className:"copied"}),s=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{
document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},o=t.button(null,"Copy the link",s,{className:"primary",text:"Copy"}),r=k(
"p");t.each(()=>L(r,"textContent",t.session.figure?Xf:t.session.document?.source.kind==="simulation"?Jf:Zf));let i=t.dialog("Share",r,k("div",{className:"button\
s"},e,o),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var Qf=8;function Hc(t){let{session:e,hand:n}=t,s=k("p",{className:"words",role:"status"}),o=k("ol",{className:"spoken"}),r=t.section("Evidence of beams",s,o),i=-1;
return t.visible(r,()=>n.tool==="evidence"),t.each(()=>{let{evidence:a}=e;if(L(s,"textContent",tm(e)),i===a.version)return;i=a.version;let{nats:l,scan:c,beam:h}=a.
each??{nats:[],scan:[],beam:[]},u=Array.from(l.slice(0,Qf),(d,m)=>k("li",{},`${Ur(d)} nats: ${em(e,c[m],h[m])}`));o.replaceChildren(...u)}),r}var em=({document:t,
editable:e},n,s)=>`beam ${s+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function tm({evidence:t,quantity:e}){let{cell:n,together:s}=t;if(!n)return"\
Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";let o=`Cell ${n.x}, ${n.y}`;if(!s)return`${o}: aski\
ng its beams.`;if(!s.beams)return`${o}: no beam reaches it.`;let r=s.beams===1?"1 beam":`${s.beams} beams`;if(s.nats_for===null||s.nats_against===null)return`${o}\
: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"its surface"}[e.kind]??"what is there",a=s.beams_for||s.beams_against?"":" Non\
e of them says anything.";return`${o}: ${r}. For ${i} (blue) ${s.beams_for}, ${s.nats_for.toFixed(1)} nats; against (orange) ${s.beams_against}, ${s.nats_against.
toFixed(1)} nats.${a}`}var Xt=t=>t.charAt(0).toUpperCase()+t.slice(1),Fo=class{text="Connecting";level="info";until=0;say(e,n,s){this.text=Xt(e),this.level=n,this.until=s}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var zc=t=>Math.round(t*180/Math.PI);function Vc(t){let{session:e,hand:n}=t,{ghost:s}=e,o=(l,c)=>t.numberInput(l,()=>Number((s.pose?.[c]??0).toFixed(2)),h=>s.move(
{[c]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>zc(s.pose?.yaw??0),l=>s.move({yaw:l*Math.PI/180}),{step:5}),i=k("p",{className:"words ghosted"}),a=t.
section("Ghost",k("div",{className:"triple"},o("Ghost x","x"),o("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>L(i,"textContent",nm(t))),
a}function nm({session:t}){let{ghost:e}=t;if(e.trouble)return Xt(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:s,high:o,near:r}=e.fan,i=Array.from(o,(h,u)=>h-s[u]).filter(Number.isFinite).sort((h,u)=>h-u),a=i.length?`${fe(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",c=r?` \
Rings are the hits of scan ${r.index+1}, taken ${fe(100*r.away,0)} cm from here, turned by ${zc(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${c}`}function jc(t){let{session:e}=t,n=k("span",{className:"what"});t.each(()=>{let{grid:c,source:h}=e.document??{};if(!c||!h)return;let u=`${c.shape[0]} × ${c.shape[1]}\
 cells of ${+c.resolution.toPrecision(3)} m`;L(n,"textContent",h.name?`${h.name}, ${u}`:u)});let s=()=>!e.recorded&&!!e.document,o=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo,why:"Nothing of this page to undo"}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"\
Redo (Ctrl+Y)",when:()=>!!e.state?.can_redo,why:"Nothing to redo"}),k("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:s}),
...t.embedded?[]:[t.button("link","Share",()=>t.command("share"),{text:"Share",when:s})]];for(let c of o)t.visible(c,()=>!e.recorded);let r=t.button("theme","Th\
eme: automatic",()=>t.command("theme")),i=t.button("help","Help",()=>t.command("help"),{title:"Help (?)"}),a=k("span",{className:"space"});return{element:k("hea\
der",{},k("h1",{textContent:"bayesmap"}),n,a,...o,om(t),r,i),nameTheme(c){let h=`Theme: ${c}`;st(r,"aria-label",h),L(r,"title",h)}}}var sm=({shown:t,draws:e})=>e.
count>0||/importance|propagate/.test(t?.method??"");function om(t){let{session:e}=t,n=(l,c,h,u,d)=>{let m=t.button(null,l,()=>t.command(`export ${c}`),{text:l,when:u,
why:d});return h!=="all"&&t.visible(m,()=>!e.recorded&&(h==="document"||!e.figure)),m},s=n("Figure that samples by itself (HTML)","figure","server");t.visible(s,
()=>e.editable&&!e.figure);let o=k("div",{className:"menu",hidden:!0},n("Picture (PNG)","png","all"),n("Saved run (netCDF)","run","server",()=>sm(e),"There are \
no draws yet: chains keep them"),n("Map for robots (YAML and PGM)","map","server"),n("Page in one file (HTML)","html","server"),s,n("Document (JSON)","document",
"document")),r=t.button("save","Export",()=>i(o.hidden),{text:"Export",when:()=>!!e.document}),i=l=>{o.hidden=!l,r.setAttribute("aria-expanded",String(l)),l&&o.
firstElementChild.focus()};i(!1);let a=k("div",{className:"anchor"},r,o);return a.addEventListener("keydown",l=>{l.key!=="Escape"||o.hidden||(i(!1),r.focus(),l.
stopPropagation())}),a.addEventListener("focusout",l=>{a.contains(l.relatedTarget)||i(!1)}),o.addEventListener("click",()=>{i(!1),r.focus()}),a}var rm={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function ln(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",rm[t]),e.append(n),e}var Io=({document:t})=>!t||t.source.kind==="simulation",Si=({answers:t})=>t,Yc="surface (zoom in)",Kc=[{mark:"truth",text:"true wall",when:Io,may:Io},{mark:"ray",
text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.strokes.
length,may:t=>!Io(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!Io(t)},{mark:"unobserved",text:"unobserved"},{mark:"\
draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Si},{mark:"\
path",text:"path, as wide as the robot",when:({decisions:t})=>!!t.path,may:Si}],qc=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 % of a place"}],
Jc=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function Xc(t,e,n){let s=k("p",{className:"sentence"});return t.each(()=>L(s,"t\
extContent",im(t.session))),k("div",{className:"legend"},s,am(t,e,n),lm(t))}var ki=(t,e)=>`${t.toLocaleString("en")} ${e}${t===1?"":"s"}`;function im(t){let{shown:e,
document:n,layer:s,quantity:o,draws:r}=t;if(!e||!n)return"";let{kind:i,mean:a,value:l}=o,c={mean:i==="binary"?"How probable a wall is in each cell":Xt(`${a} of \
each cell`),draw:`One map drawn from the posterior${i==="binary"?"":`, by its ${l}`}${r.count?`, ${t.draw+1} of ${r.count}`:""}`,entropy:"How uncertain each cel\
l is, in bits",width:"How wide the 90 % interval of each cell is"}[s];if(e.method==="none")return`${c} before any reading: the prior.`;let{source:h,angles:u,sensors:d,
scans_used:m}=n,w=h.kind==="simulation"?`${ki(u*d.length,"beam")} of ${ki(d.length,"sensor")}`:ki(m??h.scans,"scan"),S=(e.method==="propagate"||e.method==="pilo\
t"||/hits|counts/.test(e.method))&&e.approximate?", approximately":s!=="draw"&&e.burned?`: the mean of the sweeps after the first ${e.burned}`:"";return`${c}, g\
iven ${w}${S}.`}function am(t,e,n){let{session:s}=t,o=k("span",{className:"ramp"}),r=k("span",{className:"name"}),i=Kc.map(h=>{let[u,d]=Oo(h),{mark:m,when:w}=h;
return w&&t.visible(u,()=>w(s)),m==="stroke"&&t.each(()=>L(d,"textContent",Ds(n())?h.text:Yc)),m==="path"&&t.each(()=>u.firstElementChild?.classList.toggle("ris\
ky",s.decisions.path?.within_risk===!1)),u}),[a,l]=[qc,Jc].map(h=>h.map(u=>Oo(u)[0]));for(let h of a)t.visible(h,()=>!!s.where.found);for(let h of l)t.visible(h,
()=>!!s.evidence.cellShown);let c="";return t.each(()=>{let{layer:h}=s;L(r,"textContent",Zc(s,h));let u=h==="entropy"||h==="width",d=`${u} ${e().ground}`;c!==d&&
(c=d,o.style.background=Ir(u?es:m=>Fr(e(),m)))}),k("ul",{"aria-label":"Legend"},k("li",{},r,k("span",{className:"scale"},"0",o,"1")),...i,cm(t),...a,...l)}function lm(t){
let{session:e}=t,n=["mean","draw","entropy","width"].map(c=>{let h=k("span");return t.each(()=>L(h,"textContent",Zc(e,c))),c==="width"&&t.visible(h,()=>e.quantity.
interval),h}),s=Kc.map(c=>{let[h,u]=Oo(c);c.mark==="stroke"&&(u.textContent=Yc);let{may:d}=c;return d&&t.visible(h,()=>d(e)),h}),o=k("span",{className:"scale"},
"00.0",k("span",{className:"ramp"}),"000.0 nats"),r=[qc,Jc].map(c=>k("ul",{},...c.map(h=>Oo(h)[0]))),i=[k("ul",{},k("li",{},"one more scan tells",o)),...r],a=k(
"li",{className:"either"},...i);t.visible(a,()=>Si(e));let l=k("span",{className:"scale"},"0",k("span",{className:"ramp"}),"1");return k("ul",{className:"room",
"aria-hidden":"true"},k("li",{},k("span",{className:"name either"},...n),l),...s,a)}function Oo({mark:t,text:e}){let n=k("i",{className:t});t==="sensor"&&n.append(
ln("sensor"));let s=k("span",{textContent:e});return[k("li",{},n,s),s]}function Zc({quantity:t},e){let{kind:n,mean:s,value:o}=t;return e==="entropy"?"entropy (b\
it)":e==="width"?"width of the 90 % interval":n==="binary"?"P(wall)":e==="draw"?o:s}function cm(t){let{decisions:e}=t.session,n=k("span",{className:"ramp"});n.style.
background=Ir(es);let[s,o]=[k("span"),k("span")],r=k("li",{className:"views"},"one more scan tells",k("span",{className:"scale"},s,n,o));return t.visible(r,()=>e.
looking&&!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(L(s,"textContent",fe(Math.min(...i),1)),L(o,"textContent",`${fe(Math.max(...i),1)} \
nats`))}),r}var hm=[.05,.1,.2,.4,.8],pm=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function Qc(t){let{session:e}=t,n=k("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),s="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,c=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...hm,r.resolution])].sort((d,m)=>d-m),[,u]=t.limits("side_of_log");if(s!==`${h} ${u}`){s=`${h} ${u}`;let d=m=>k("option",
{value:String(m),textContent:pm(m),disabled:c/m>u-1});n.replaceChildren(...h.map(d))}L(n,"value",String(r.resolution))});let o=t.row("Cell size",n);return t.visible(
o,()=>e.document?.source.kind==="log"),o}function eh(t){let{session:e}=t,n=k("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),s=k("output"),o=()=>e.
document?.source.scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=o()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});
let i=t.section("Log",k("div",{className:"player bare"},n,s));return t.visible(i,()=>!e.recorded&&e.document?.source.kind==="log"&&o()>1),t.each(()=>{let a=o(),
l=e.document?.scans_used??a;L(n,"max",String(Math.max(1,a))),(!Sn(n)||Number(n.value)!==l)&&L(n,"value",String(l));let c=l===a?`all ${a} scans`:`after ${l} of ${a}`;
n.style.setProperty("--fill",`${100*(l-1)/Math.max(1,a-1)}%`),st(n,"aria-valuetext",c),L(s,"textContent",c)}),i}var um=20,dm={importance:"particles",propagate:"rounds"},Uo=({working:t,shown:e})=>t&&e?.method==="pilot";function th(t,...e){let{session:n}=t,s=k("progress",{max:1,
value:0,"aria-label":"Progress"}),o=k("div",{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.
source.kind==="log"),l=Uo(n),c=i?i.done/i.total:r&&!a&&r.total>0&&(l||!r.approximate)?r.sweeps/r.total:0;L(s,"value",c);let h=n.remaining_s(),u=dm[r?.method??""]??
"sweeps",d=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${u}`:"",m=h!==null?h<1?"less than 1 s left":`${Math.ceil(h)} s left`:n.running?"running":"",w=d&&
r?.burned?`the first ${r.burned} left out`:"",b=n.sampling||n.running||!r||r.sweeps>=r.total?"":"stopped";i?L(o,"textContent",`${i.text}: ${i.done} of ${i.total}\
 ${i.total>um?"scans":"rounds"}`):a?L(o,"textContent","Computing"):r&&l?L(o,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):L(o,"textConten\
t",Xt([d,w,m,d&&b].filter(Boolean).join(", "))||fm(n))}),t.section("Posterior",mm(t),s,o,gm(t),wm(t),...e,ym(t))}function fm({shown:t,working:e}){return t?.method===
"propagate"?`${t.sweeps} rounds of belief propagation`:t?.method==="hits"?"Counts of hits and passes":t?.method==="counts"?"Run infers where the robot was":t?.method===
"pilot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function mm(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"\
primary",text:"Run",title:"Run (R): more sweeps of the chains on show",when:()=>e.connection.connected,why:"Not while the connection is lost"}),s=t.button("clos\
e","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||e.sampling||Uo(e),why:"Nothing is running"}),o=t.checkbox("Liv\
e",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chains, and Run goes on from their draws"),r=k("div",{className:"buttons"},n,
s,o);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function gm(t){let{session:e}=t,n=k("dl"),s=(r,i,a,l=!1)=>{let c=k("dd",{textContent:"\
–"}),h=k("div",{title:i},k("dt",{textContent:r}),c);return n.append(h),t.each(()=>{L(c,"textContent",e.shown?a(e.shown):"–"),l&&L(c,"className",e.shown?.verdict?.
level??"")}),h};s("ESS","Effective sample size of the log joint",r=>fe(r.ess,0),!0),s("R-hat","Agreement of the chains on the log joint; 1 is full",r=>fe(r.rhat,
3),!0),s("log joint","Log of prior times likelihood at the last sweep",r=>fe(r.log_joint,Math.abs(r.log_joint??0)<1e5?1:0)),s("time","Time spent on sweeps, roun\
ds or particles",r=>fe(r.seconds,1," s"));let o=s("reply","From the hand's last move to its picture",()=>fe(e.latency.eventToPaint_ms.at(-1),0," ms"));return t.
visible(o,()=>!e.recorded),n}var Mi=({shown:t})=>t?.method==="importance"?{good:"Enough particles",fair:"Few particles",bad:"Collapsed"}:{good:"Converged",fair:"\
Nearly converged",bad:"Not converged"};function ym(t){let{session:e}=t,n=k("dl",{className:"about"}),s=k("details",{},k("summary",{textContent:"Model and method\
 of this picture"}),n),o="";return t.each(()=>{let r=e.shown?.about??[];L(s,"hidden",!r.length),String(r)!==o&&(o=String(r),n.replaceChildren(...r.flatMap(([i,a])=>[
k("dt",{textContent:i}),k("dd",{textContent:a})])))}),s}function wm(t){let{session:e}=t,n=k("span"),s=t.button(null,"Show the cell",()=>t.command(`cell ${e.shown?.
verdict?.cell}`),{text:"Show the cell"});t.visible(s,()=>!!e.shown?.verdict?.cell);let o=k("div",{className:"verdict"},n,s);return t.each(()=>{let r=e.shown?.verdict;
L(o,"hidden",!r),r&&(L(n,"textContent",`${Mi(e)[r.level]}: ${r.why}`),L(o,"className",`verdict ${r.level}`))}),o}var bm="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",nh=200,
xm="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",sh="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",vm="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function ih(t){let{session:e}=t,n=k("span",{className:"chip"}),s=t.button(null,"Not converged",()=>oh(
e)?.apply?.(),{text:"Not converged",className:"chip doubt"}),o=k("div",{className:"chips"},n,s);return t.each(()=>{let r=oh(e);if(L(s,"hidden",!r),r){let u=[Mi(
e).bad,r.text].filter(Boolean).join(": ");L(s.firstElementChild,"textContent",u.charAt(0).toLowerCase()+u.slice(1)),L(s,"title",`${e.shown?.verdict?.why}.${r.apply?
` Click to ${r.text}.`:""}`),L(s,"disabled",!r.apply),st(s,"aria-label",u)}let i=e.shown;if(!i||!e.document)return L(o,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",l=i.layer==="draw"?a+(e.flicker.under?" over the mean":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="en\
tropy"?"entropy":"mean";if(i.method==="counts"){L(o,"hidden",!1);let u=e.halfway?"along poses found so far":"along raw odometry";return L(n,"textContent",`hits \
and passes · ${e.stage?e.stage.text.toLowerCase():u}`),L(n,"className","chip approximate")}let c={importance:"importance sampling",propagate:"belief propagatio\
n"}[i.method],h=i.approximate?`approximate, ${km(i,e.working)}`:c??`${i.sweeps} sweeps`;L(o,"hidden",!1),L(n,"textContent",`${l} · ${h}`),L(n,"className",i.approximate?
"chip approximate":"chip")}),o}function km({method:t,sweeps:e,total:n,averaged:s},o){return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${s===
1?"1 draw":`${s} draws`} of one chain, sensor ${o?"being":"half"} fitted: sweep ${e} of ${n}`}function oh(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="b\
ad"||!n)return null;if(t.recorded||n.source.kind==="run")return{text:""};let s=a=>()=>t.act({type:"set",patch:a}),o=e.sweeps<nh,r=n.pose_sigma===0&&n.heading_sigma===
0;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!o&&r)return{text:"try blocks",apply:s({method:"block"})};if(e.method==="importance")return{text:"try Gib\
bs",apply:s({method:"auto"})};if(e.sweeps<e.total)return null;if(!r&&!o)return{text:"poses are too uncertain"};let i=Math.min(t.limits?.sweeps[1]??0,Math.max(nh,
4*n.sweeps));return i>n.sweeps?{text:`try ${i} sweeps`,apply:s({sweeps:i})}:{text:""}}function ah(t){let{session:e}=t,n=k("span"),s=t.button(null,"Reconnect now",
()=>e.transport.retry?.(),{text:"Reconnect now"}),o=k("div",{className:"banner",role:"alert",hidden:!0},n,s);return t.each(()=>{let r=e.everConnected&&!e.connection.
connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??0)/1e3));L(o,"hidden",!r&&e.worker!=="restarted"),L(o,"className",r?"banner":"banner mild"),L(s,"hid\
den",!r);let a=`Connection lost. Trying again in ${i} s; the map is kept here.`,l=e.connection.refused?bm:a;L(n,"textContent",r?l:"The worker stopped and is bei\
ng started again. The map is kept.")}),o}function lh(t){let{session:e,hand:n}=t,s=k("div",{className:"readout",id:`${t.prefix}-readout`}),o=k("span",{role:"stat\
us","aria-live":"polite"}),r=k("span",{className:"hidden","aria-live":"polite"});return n.announce=i=>L(r,"textContent",i),n.describe=i=>rh(e,i),t.each(()=>{let{
kind:i}=e.quantity;L(s,"title",i==="binary"?xm:i==="surface"?`${sh}. ${vm}`:sh);let a=n.cursor??n.hover,c=matchMedia("(pointer: coarse)").matches?"Touch a cell":
e.editable?"Point at a cell, or press ? for the keys":"Point at a cell";L(s,"textContent",a?rh(e,a):c);let h=e.status.text==="Ready"&&e.shown?.verdict?.level===
"bad",u=e.status.text==="Ready"&&Uo(e),d=e.shown?.method==="importance"?"Ready, but importance sampling has collapsed":"Ready, but the chains have not converged",
m=e.everConnected&&!e.connection.connected&&e.status.level==="info";L(o,"textContent",m?"Connection lost":h?d:u?"Fitting the sensor":e.status.text),L(o,"classNa\
me",m?"error":h?"warning":u?"busy":e.status.level)}),{element:k("footer",{},o,s,r),readout:s}}function rh(t,e){let{document:n,shown:s}=t;if(!n)return"";let{resolution:o,
shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(o))+1),{x:l,y:c}=Xn(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${c.toFixed(a)} m`];if(s&&
s.p.length===r[0]*r[1]){let u=s.p[i]/255,{kind:d,mean:m,value:w,interval:b}=t.quantity;s.layer==="width"?h.push(`90 % interval ${u.toFixed(2)} wide`):d!=="binar\
y"&&s.layer==="draw"?h.push(`${w} ${u.toFixed(2)} in this draw`):d!=="binary"?h.push(`${m} ${u.toFixed(2)}`,...b?[]:[`entropy ${Ls(u).toFixed(2)} bit`]):s.layer===
"draw"?h.push(u>.5?"wall in this draw":"free in this draw"):h.push(`P(wall) ${u.toFixed(2)}`,`entropy ${Ls(u).toFixed(2)} bit`);let S=t.evidence.facts,T=S?.x===
e.x&&S.y===e.y?S:null,v=T?T.beams:null,A=s.reached[i]/255,E=n.source.kind==="run";if(A?!E&&A<.995&&h.push(`reached by a beam with probability ${A.toFixed(2)}`):
h.push(E?"reached by a beam in less than half of the draws":"unobserved"),A&&v!==null&&h.push(v===1?"1 beam":`${v} beams`),A&&T&&T.nats_for!==null&&T.nats_against!==
null&&v){let C={binary:"a wall",surface:"its surface"}[t.quantity.kind]??"what is there";h.push(`for ${C} ${T.beams_for}, ${T.nats_for.toFixed(1)} nats`,`agains\
t ${T.beams_against}, ${T.nats_against.toFixed(1)} nats`)}}return h.join(" · ")}var Sm={logged:"as logged",odometry:"from raw odometry"},Mm=180/Math.PI;function ch(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",s=t.select("Poses",
Sm,()=>e.document?.poses??"logged",a=>t.set({poses:a}));s.classList.add("wide"),t.visible(s,n);let o=[t.slider("pose_sigma",()=>"Position ±",{step:.05,unit:" m"}),
t.slider("heading_sigma",()=>"Yaw ±",{step:.5,unit:"°",scale:Mm})];for(let a of o)t.visible(a,()=>e.editable);let r=k("p",{className:"caption"});t.each(()=>{let{
pose_sigma:a=0,heading_sigma:l=0,method:c="auto"}=e.document??{},h=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,u=e.editable&&(a>
0||l>0)&&!/auto|gibbs|block/.test(c);L(r,"hidden",!u&&!h),L(r,"textContent",h?"Run infers where the robot was.":"This method takes poses as known; Gibbs does no\
t.")});let i=t.section("Where the robot was",s,...o,r);return t.visible(i,()=>e.editable&&!e.figure||n()&&!e.recorded),i}var Wo=t=>Math.abs(t)<.995?`${fe(100*Math.abs(t),1)} cm`:`${fe(Math.abs(t),2)} m`,Tm="Point at a reading to compare it with what the posterior predicts of it.",
Am=": preparing the comparison. The first one after an installation takes some seconds.";function hh(t){let{session:e}=t,n=k("p",{className:"words reading",role:"\
status"}),s=t.section("Reading",n);return t.visible(s,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:o,found:r,trouble:i,
slow:a}=e.reading,l=o?`Beam ${o.beam+1} of scan ${o.scan+1}${a?Am:"."}`:Tm;L(n,"textContent",i||(r?Em(r):l))}),s}function Em({scan:t,beam:e,reading:n,range:s,low:o,
median:r,high:i,residual:a,no_return:l,wall:c}){let h=`Beam ${e+1} of scan ${t+1}`,u=(T,v)=>T===null?v:`${fe(T,2)} m`,d=`median ${u(r,"no return")}, 80 % betwee\
n ${u(o,"too close")} and ${u(i,"no return")}`;if(n==="none")return`${h} came back from nothing, which was predicted with probability ${fe(l??0,3)} (${d}).`;if(n!==
"hit"||s===null)return`${h} read nothing that says how far (${d}).`;let m=a===null?"":`, ${Wo(a)} ${a<0?"shorter":"longer"} than the predicted median`,w=`${h} r\
ead ${fe(s,2)} m${m} (${d}).`;if(!c)return w;let b=`${Wo(c.across_m)} ${c.across_m<0?"behind":"in front of"} the wall, which is ${Wo(c.thickness_m)} thick`,S=`${Wo(
c.along_m)} to the ${c.along_m<0?"right":"left"} along it from the middle of its surface`;return`${w} It ended ${b} (one standard deviation), and ${S}; the beam\
 met it at ${fe(c.incidence_rad*180/Math.PI,0)}° from its normal.`}var Pm={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},_m={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},Cm={noisy:"with noise",exact:"exact"},Lm={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},Dm={raster:"raster",radial:"radial",random:"random"},Bo=2*Math.PI,Nm=t=>Math.round(t*1800/Math.PI)/10,Rm={importance:"Particles",propagate:"Round\
s"};function ph(t){let{session:e,hand:n,editor:s}=t,o=k("select",{"aria-label":"Selected sensor"});o.addEventListener("change",()=>{n.selected=Number(o.value),n.
choose("sensor")});let r="";t.each(()=>{let u=e.document?.sensors??[],d=u.map(m=>m.id).join();d!==r&&o.replaceChildren(...u.map(({id:m})=>k("option",{value:String(
m),textContent:`Sensor ${m}`}))),r=d,L(o,"value",String(n.sensor?.id??""))});let i=(u,d)=>t.numberInput(u,()=>Number((n.sensor?.[d]??0).toFixed(2)),m=>n.sensor&&
s.moveSensor(n.sensor,{[d]:m}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),u=>n.sensor&&s.moveSensor(n.sensor,{yaw:u%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),c=t.button("minus","Remove the sensor",()=>s.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1,why:"The last sensor stays"});t.visible(a,()=>(e.document?.fov??Bo)<Bo);let h=k("div",{className:"triple"},i(
"x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",k("div",{className:"buttons"},o,l,c),h)}function uh(t){let{session:e}=t,n=t.numberInput("Longest range\
 (m)",()=>e.document?.max_range??0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),s=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("\
angles",()=>"Angles",{step:1,log:!0}),n,t.numberInput("Field of view (°)",()=>Nm(e.document?.fov??Bo),a=>t.set({fov:a>=360?Bo:a*Math.PI/180}),{step:5,limits:"f\
ov",scale:180/Math.PI}),t.select("Readings",Cm,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of s)t.visible(a,()=>e.editable);let o=t.slider(
"prior",()=>"Prior P(wall)",{step:.01}),r=()=>(e.document?.cells??"binary")==="binary";t.visible(o,r);let i=t.select("Cells",_m,()=>e.document?.cells??"binary",
a=>t.set({cells:a}));return t.visible(i,()=>e.document?.source.kind==="log"),t.section("Model",i,Qc(t),o,...s)}function dh(t){let{session:e}=t,n=()=>e.document?.
method??"auto",s=()=>(e.document?.cells??"binary")==="binary",o=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",Pm,n,l=>t.set({method:l})),t.select("Order",
Dm,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||n()==="auto","Only Gibbs, cell by cell, has an order"),t.select("Start",Lm,()=>e.document?.
start??"auto",l=>t.set({start:l}),o,"Only chains have a start")],i=Array.from(r[0].lastElementChild.children);for(let l of i)l.value==="propagate"&&t.visible(l,
()=>!e.figure);for(let l of r)t.visible(l,s);let a=t.slider("burn_in",()=>"Burn-in (%)",{step:5,scale:100});return t.visible(a,()=>o()||!s()),t.section("Inferen\
ce",...r,a,t.slider("sweeps",()=>Rm[n()]??"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{step:1,limits:"\
seed"}))}function fh(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),s=t.button(
null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",k("div",{className:"\
buttons"},n,s))}var $m=0,Go=class{constructor(e,n,s,o,r,i){this.session=e;this.hand=n;this.editor=s;this.command=o;this.showLayer=r;this.embedded=i}prefix=`bayesmap${$m++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[s,o]=this.session.limits?.[e]??[1,
2];return n===1?[s,o]:[Math.ceil(10*s*n-1e-6)/10,Math.floor(10*o*n+1e-6)/10]}bounded(e,n,s=1){this.each(()=>{let[o,r]=this.limits(n,s);L(e,"min",String(o)),L(e,
"max",String(r))})}visible(e,n){this.each(()=>L(e,"hidden",!n()))}button(e,n,s,{className:o="",text:r="",when:i,why:a,title:l}={}){let c=k("button",{type:"butto\
n",className:o,title:l??n,onclick:s},e&&ln(e));return r&&c.append(k("span",{textContent:r})),r!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>{L(c,"disabl\
ed",!i()),a&&L(c,"title",c.disabled?a:l??n)}),c}segmented(e,n,s,o,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=k("div",{className:"segmented",role:"radiog\
roup","aria-label":e});for(let[l,c,h]of n){let u=k("input",{type:"radio",name:i,value:l,onchange:()=>o(l)});a.append(k("label",{title:c},u,h?ln(h):null,k("span",
{textContent:c}))),this.each(()=>{L(u,"checked",s()===l),r&&L(u,"disabled",!r(l))})}return a}section(e,...n){let s=`${this.prefix}-${e.replace(/\W/g,"")}`;return k(
"section",{"aria-labelledby":s},k("h2",{id:s,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,k("div",{className:"row"},k("lab\
el",{for:n.id,textContent:e}),n)}slider(e,n,{step:s,log:o=!1,unit:r="",scale:i=1}){let a=`${this.prefix}-${e}`,l=()=>this.limits(e,i),c=b=>{let[S,T]=l();return o?
1e3*Math.log(b/S)/Math.log(T/S):b},h=b=>{if(!o)return b;let[S,T]=l(),v=S*(T/S)**(b/1e3),A=v<100?1:10**(Math.floor(Math.log10(v))-1);return se(Math.round(v/A)*A,
S,T)},u=()=>{let b=this.session.document?.[e];return b===void 0?l()[0]:i===1?b:Number((b*i).toFixed(3))},d=k("label",{for:a}),m=k("input",{type:"range",id:a,...o?
{min:0,max:1e3,step:1}:{step:s}}),w=k("input",{type:"number",step:String(s)});return o||this.bounded(m,e,i),this.bounded(w,e,i),m.addEventListener("input",()=>this.
set({[e]:h(Number(m.value))/i})),m.addEventListener("change",()=>this.endDrag()),w.addEventListener("change",()=>{this.typed(w,n(),l(),u,b=>this.set({[e]:o?Math.
round(b):b/i})),this.endDrag()}),this.each(()=>{let b=u();L(d,"textContent",n()),st(w,"aria-label",`${n()}, number`),h(Number(m.value))!==b&&(m.value=String(c(b))),
st(m,"aria-valuetext",`${b}${r}`);let S=100*(c(b)-Number(m.min))/(Number(m.max)-Number(m.min));m.style.setProperty("--fill",`${se(S,0,100)}%`),Sn(w)||L(w,"value",
String(b))}),k("div",{className:"row slider"},d,m,w)}select(e,n,s,o,r,i=""){let a=k("select",{onchange:()=>o(a.value)});for(let[l,c]of Object.entries(n))a.append(
k("option",{value:l,textContent:c}));return this.each(()=>{L(a,"value",s()),r&&L(a,"disabled",!r()),i&&L(a,"title",a.disabled?i:"")}),this.row(e,a)}typed(e,n,[s,
o],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(se(a,s,o)),e.value=String(r()),a<s?this.session.say(`${n} is at least ${s}`,"warning"):a>o&&
this.session.say(`${n} is at most ${o}`,"warning")}numberInput(e,n,s,{step:o,limits:r,scale:i}){let a=k("input",{type:"number",step:String(o)}),l=()=>r?this.limits(
r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,l(),n,s)),this.each(()=>{Sn(a)||L(a,"value",String(n()))}),this.row(
e,a)}checkbox(e,n,s,o=""){let r=k("input",{type:"checkbox",onchange:()=>s(r.checked)});return this.each(()=>L(r,"checked",n())),k("label",{className:"check",title:o},
r,k("span",{textContent:e}))}dialog(e,...n){let s=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,o=k("button",{type:"button",className:"plain","aria-label":"Clo\
se",onclick:()=>i.close()},ln("close")),r=k("div",{className:"title"},k("h2",{id:s,textContent:e}),o),i=k("dialog",{"aria-labelledby":s},r,...n);return i.addEventListener(
"click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),i}};var Fm=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],mh="There are no draws yet: chains keep them",Im={2:"2 / s",10:"10 / s",30:"\
30 / s",1e3:"fastest"},Ho=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.
session.hasDraws)return;this.before=null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.
act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,draws:s,flicker:o,shown:r}=this.session;this.playing=e&&!o.still,e&&o.wantsMean?this.session.act(
{type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.showDraw(o.still&&r?.layer==="draw"?(n+1)%s.count:n>=s.count-1?0:n),this.session.changed()}over(e){
let{flicker:n,view:s}=this.session;n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:s.chain})):s.layer!=="draw"&&this.showLayer(
"draw"):(this.afterMean=!1,this.before&&this.before!==s.layer&&this.showLayer(this.before)),this.before=e?s.layer:null,this.session.changed()}playFromStart(){this.
showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)
return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:s,draws:o}=this.session;
s+1>=o.count&&n.on?this.showDraw(0):s+1>=o.count?this.play(!1):this.showDraw(s+1)},1e3/this.drawsPerSecond)}};function gh(t,e,n,s){let{session:o}=t,r=t.segmented(
"Show",Fm,()=>o.view.layer,m=>e.showLayer(m),m=>m==="draw"?o.hasDraws:!o.lacks.includes(m)),[,,i,a]=Array.from(r.children);L(a,"title","Width of each cell's 90 \
% interval"),t.visible(i,()=>!o.quantity.interval),t.visible(a,()=>o.quantity.interval);let l=(m,w)=>t.checkbox(m,()=>n[w],b=>{n[w]=b,o.changed()}),c=l("True wa\
lls","truth");t.visible(c,()=>!o.document||o.document.source.kind==="simulation");let[h,u]=[l("Surfaces","strokes"),l("Trajectory","trajectory")];t.visible(h,()=>!!o.
overlay?.strokes.length),t.each(()=>L(h.lastElementChild,"textContent",Ds(s())?"Surfaces":"Surfaces (zoom in)")),t.visible(u,()=>!!o.overlay?.trajectory.length);
let d=k("div",{className:"checks",role:"group","aria-label":"Marks"},c,l("Rays","rays"),l("Readings","readings"),h,u);return t.section("View",r,Om(t,e),d)}function Om(t,e){
let{session:n}=t,s=k("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});s.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(s.value))});let o=t.
button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1,why:mh}),r=k("output"),i=k("select",{"aria-label":"Chain"});i.addEventListener("\
change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:u,count:d}=n.draws;L(s,"max",String(Math.max(0,d-1))),L(s,"disabled",d===0),L(s,"value",String(
n.draw));let m=d?`${n.draw+1} of ${d}`:"none kept";st(s,"aria-valuetext",m),s.style.setProperty("--fill",`${d>1?100*n.draw/(d-1):0}%`),L(r,"textContent",m),i.length!==
Math.max(1,u)&&i.replaceChildren(...Array.from({length:Math.max(1,u)},(b,S)=>k("option",{value:String(S),textContent:`chain ${S+1}`}))),L(i,"value",String(n.view.
chain)),L(i,"disabled",u<2),d<2&&e.playing&&e.play(!1);let w=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";o.getAttribute("aria-label")!==
w&&(o.setAttribute("aria-label",w),o.replaceChildren(ln(e.playing?"pause":"play")))});let a=k("select",{"aria-label":"Speed"});for(let[u,d]of Object.entries(Im))
a.append(k("option",{value:u,textContent:d}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(
null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1,why:mh});t.each(()=>L(a,"disabled",n.draws.count<2||n.flicker.
still));let c=t.checkbox("Draws over the mean",()=>n.flicker.on,u=>e.over(u),"Each draw in its own colour over the mean, as one of the maps that the scans leave\
 possible");t.visible(c,()=>n.draws.count>1);let h=k("div",{className:"wide"},c);return k("div",{className:"player"},o,s,r,k("div",{className:"buttons wide"},i,
a,l),h)}function yh(t){let{session:e}=t,n=k("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),s=k("output");n.addEventListener("input",()=>e.act({
type:"scan",index:Number(n.value)}));let o=t.section("Scan",k("div",{className:"player bare"},n,s));return t.each(()=>{let r=e.document?.source.kind==="simulati\
on"?0:e.document?.source.scans??0;L(o,"hidden",r<2),L(n,"max",String(Math.max(0,r-1))),Sn(n)||L(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",
`${100*Number(n.value)/Math.max(1,r-1)}%`),L(s,"textContent",`${Number(n.value)+1} / ${r}`)}),o}var bh=2,wh=6,Um=.5,Wm=.005;function xh(t){let{session:e,hand:n}=t,s=k("p",{className:"whereabouts",role:"status"}),o=k("p",{className:"caption"}),r=t.section("\
Where am I?",s,o);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),L(s,"textContent",Bm(t)),L(o,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function Bm({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let s=e.p_lost>Um?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",o=!s&&e.p_lost>Wm?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${s}${Gm(e.modes)}${Hm(e,t.editable)}${o}`}function Gm(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>bh,s=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${Ti(e.mean[2],0)}`,o=`known to ${Ai(e.sigma_m)} and ${Ti(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${Ai(e.sigma_m)} apart.`:`One place: ${s}, ${o}.`;let r=t.slice(0,wh).map(({probability:a})=>Br(a)),i=t.length>wh?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${s}, ${o}.`}function Hm({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>bh)return"";let s=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),o=s.indexOf(Math.min(...s)),r=Math.abs(Math.atan2(Math.sin(t[o].mean[2]-e[2]),Math.cos(t[o].mean[2]-e[2]))),i=t.length===1?"there":o===0?"the l\
ikeliest":`the ${zm(o+1)}`;return` The robot ${n?"stands":"was recorded"} ${Ai(s[o])} and ${Ti(r,1)} from ${i}.`}var zm=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,Ti=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,Ai=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function vh(t,e,n){let{shown:s,status:o}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:s&&{generation:s.generation,layer:t.layer,approximate:s.
approximate,sweeps:s.sweeps,method:s.method,quantity:t.quantity,rhat:s.rhat,verdict:s.verdict,trace:s.trace,traced:s.traced,weights:s.weights,ess:s.ess,chain:s.
chain,draw:s.draw},probability:s?.p??new Uint8Array(0),reached:s?.reached??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{text:o.
text,level:o.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:jm(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&Vm(t.evidence.each)},over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.
strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??
0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var Vm=t=>Object.fromEntries(Object.entries(t).
map(([e,n])=>[e,Array.from(n)]));function jm({ghost:t}){let{held:e,pose:n,fan:s,answers:o,trouble:r}=t;return{held:e,pose:n,answers:o,trouble:r,fan:s&&{...s,near:s.
near&&{...s.near}}}}var Ei=new Set(["walls","move_sensor","set","view","live"]),kh=({type:t})=>!Ei.has(t),Sh="Not while the connection is lost: this needs the server";function Mh(t,e){
let{document:n,walls:s}=t,o=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)s[r*o+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;
Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??
null};else if(e.type==="move_sensor"){let r=n.sensors.find(i=>i.id===e.id);if(r)for(let i of["x","y","yaw"])r[i]=e[i]??r[i]}}var Ym=t=>Xt(`${t.replace(/^(plan|path|explore): /,"")}.`),zo=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.
session.changed())}forget(){this.forgetPath(),this.views=null,this.askedViews=""}forgetPath(){this.start=this.goal=this.path=null,this.askedPath=this.trouble="",
this.version++,this.session.changed()}ask(){let{session:e,start:n,goal:s,radius:o,risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||!e.answers)return;
let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,s,o,r])}`;n&&s&&!i.approximate&&l!==this.askedPath&&(this.askedPath=l,e.act({type:"path",start:[
n.x,n.y],goal:[s.x,s.y],radius:o,risk:r})),this.looking&&(!i.approximate||e.document?.method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"\
views"}))}receive(e,n){let s=e.type==="undecided"?Ym(e.text):"",o=e.type==="undecided"?e.question:e.type;o==="views"?this.viewTrouble=s:this.trouble=s,e.type===
"path"?this.path=e:e.type==="views"&&this.looking?this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}:o==="path"&&(this.path=null),this.version++}nearest(e){
let{views:n}=this;if(!n?.nats.length)return null;let[s,o]=[0,1/0];for(let r=0;r<n.nats.length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<o&&([s,
o]=[r,i])}return s}};var Vo=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=zt(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:s}=e;
if(!this.held||!n||!s||s.generation!==e.generation||!e.answers)return;let o=`${s.generation} ${e.sampling} ${s.approximate} ${n.x} ${n.y}`;o!==this.asked&&(this.
asked=o,e.act({type:"inspect",x:n.x,y:n.y,each:!0}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.
each=n.nats?n:null,this.version++)}};var Km="(prefers-reduced-motion: reduce)",jo=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(Km).matches}get under(){let{mean:e,
session:n}=this,{shown:s}=n;return this.on&&e&&s?.layer==="draw"&&e.generation===s.generation&&e.p.length===s.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var qm=2e3,Jm=3e3,Xm=2,Yo=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:s}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...s,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,s=e&&n.document&&vn(e,n.document.
grid);(!s||!zt(s,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:s}=e;if(!this.held||
!e.answers||!n||n.generation!==e.generation)return;!this.pose&&s?.pose.length&&(this.pose={x:s.pose[0],y:s.pose[1],yaw:s.pose[2]});let{pose:o}=this;if(!o)return;
let r=performance.now();if(r-this.askedAt>qm&&(this.waiting=0),this.waiting>=Xm)return;let i=JSON.stringify([o,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Jm;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...o,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:s,low:o,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:c}=n,{x:h,y:u,yaw:d,generation:m,draws:w,coarse:b,milliseconds:S}=e,T=e.near&&{...e.near,pose:a,ranges:l,hit:c};this.fan={x:h,y:u,yaw:d,generation:m,draws:w,
coarse:b,milliseconds:S,angles:s,low:o,median:r,high:i,near:T},this.answers++}else this.fan=null;this.version++,this.ask()}};var Ko=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let s=performance.now();for(let o of this.
waiting)o.seq<=n&&this.eventToPaint_ms.push(s-o.time);this.waiting=this.waiting.filter(o=>o.seq>n);for(let o of this.seqOfGeneration.keys())o<e&&this.seqOfGeneration.
delete(o)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var qo=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Jo=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:s}=this,o=s.document&&s.document.source.
kind!=="simulation"&&!s.recorded,r=e&&o&&s.scan?Zm(s.scan,e,n,s.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),s.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){e.type==="undecided"?this.trouble=e.text:e.beam===this.picked?.beam&&
e.scan===this.picked.scan&&(this.found=e),this.version++}};function Zm({index:t,pose:e,angles:n,ranges:s,hit:o},r,i,a){if(t===null)return null;let l={x:e[0],y:e[1]},
[c,h]=[-1,1/0];for(let u=0;u<n.length;u++){let[d,m]=[Math.cos(e[2]+n[u]),Math.sin(e[2]+n[u])],[w,b]=[r.x-l.x,r.y-l.y],S=w*d+b*m,T=o[u]?s[u]:a,v=o[u]?Math.hypot(
w-T*d,b-T*m):1/0,A=S>0&&S<T?Math.abs(w*m-b*d):1/0,E=Math.min(v,i/2+2*A);E<h&&([c,h]=[u,E])}return h<i?{scan:t,beam:c,from:l,angle:e[2]+n[c]}:null}var Xo=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble;let{pose:s,weight:o}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,
cloud:s,weight:o},this.version++}ask(){let{session:e}=this,{shown:n,scan:s}=e;if(!n||!e.answers||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;
let o=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:s?.index} ${o}`,i=performance.now();r===this.asked||this.waitingSince&&
i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var Th=new Set(["inspect","path","views","where","ghost","beam"]),Zo=class{constructor(e,n,s=null,o=null){this.transport=e;this.changed=n;this.adopt=s;this.notice=
o;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";limits=null;recorded=!1;figure=!1;lacks=[];generation=-1;acted=0;decisions=new zo(
this);evidence=new Vo(this);where=new Xo(this);ghost=new Yo(this);reading=new Jo(this);flicker=new jo(this);status=new Fo;progress=new qo;latency=new Ko;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,
text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get answers(){
return!this.recorded&&!this.figure}get running(){return this.connection.connected&&!!this.state?.running}get working(){return this.connection.connected&&!!this.
state?.working}get layer(){let e=this.shown?.layer;return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entropy":"mean"}get stage(){return this.running&&
this.shown?.method==="counts"?this.lastStage:null}get halfway(){return this.lastStage?.generation===this.shown?.generation}get draws(){return this.state?.draws??
{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(0,this.draws.count-1);return Math.
min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.
document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&
this.everConnected&&!Th.has(e.type)&&kh(e))return this.say(Sh,"warning");let s={...e,seq:++this.seq};Th.has(e.type)||(this.acted=this.seq),Ei.has(e.type)&&(this.
pending.push(s),this.foresee(s)),n&&this.latency.sent(s.seq,n),this.connection.connected?this.transport.send(s):this.everConnected&&Hr(this.portableDocument()),
this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.
wallsVersion&&(this.packed={version:this.wallsVersion,text:xn(qn(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.
effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.
flicker.take(this.shown),!0)}painted(){this.counts.paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.
send({type:"painted",generation:e}),this.reported=e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.quantity??{kind:"\
binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){let n=this.
connection.connected;if(this.connection=e,e.connected){let s=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(
s),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.
text,this.notice.level),this.everConnected=!0}else this.everConnected&&(n&&this.say("Connection lost","error"),Hr(this.portableDocument()));this.changed()}receive(e,n){
switch(e.type){case"welcome":this.generation=this.reported=-1,this.limits=e.limits,this.recorded=e.recorded,this.figure=e.figure,this.lacks=e.lacks,this.latency.
forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":e.generation>=this.generation&&this.receiveScan(e,n);break;case"overlay":this.overlay=
n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(e,n);break;case"cell":this.evidence.receive(e,
n);break;case"path":case"views":this.decisions.receive(e,n);break;case"ghost":this.ghost.receive(e,n);break;case"beam":this.reading.receive(e);break;case"undeci\
ded":e.question==="ghost"?this.ghost.receive(e,n):e.question==="beam"?this.reading.receive(e):this.decisions.receive(e,n);break;case"status":this.status.say(e.text,
e.level,this.acted);break;case"error":this.receiveRefusal(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"download":this.ondownload(
e.name,e.mime,n.data),this.status.say(`Saved ${e.name}${e.note&&`, ${e.note}`}`,"info",this.acted);break}this.changed()}receiveScan({ids:e,index:n},{pose:s,angles:o,
ranges:r,exact:i,hit:a}){this.scan?.index!==n&&this.reading.forget(),this.scan={ids:e,index:n,pose:s,angles:o,ranges:r,exact:i,hit:a}}receiveRefusal({seq:e,text:n,
remedy:s}){let o=e!==null&&e===this.broughtAt;o&&(this.broughtAt=null,this.act({type:"hello"}));let r=[n,s].filter(Boolean).join("; ");this.status.say(o?`The ma\
p that was brought along cannot be shown: ${r}`:r,"error",this.acted),this.pending=this.pending.filter(i=>i.seq!==e),e!==null&&this.latency.refused(e),this.rebuild()}receiveState(e){
this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.overlay=null,nl()),this.generation=Math.max(this.generation,e.generation),
this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.
counts.stale++;return}this.generation=e.generation;let s=n.p,{trace:o,traced:r,weights:i}=n,a=this.next??this.shown,l=n.reached,c=a&&a.p.length===s.length&&a.reached.
every((h,u)=>h===l[u])?a.reached:l;this.next={...e,p:s,trace:o,traced:r,weights:i,reached:c},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.
state,[n,s]=e.grid.shape,o=this.confirmedWalls;if((e.walls!==o.text||o.walls.length!==n*s)&&(this.confirmedWalls={text:e.walls,walls:Ct(dt(e.walls),n*s)}),this.
document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==o||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,
this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r,chain:i??0,draw:a}}for(let r of this.
pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Mh(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Ah='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Eh=`:host { display: block; height: 100dvh; container-type: size; }
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
.bar button:has(span) { width: auto; padding: 0 8px; }
.verdict button { height: 24px; padding: 0 6px; margin-left: 6px; font-size: 12px; }
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
.legend .sentence { grid-area: 1 / 1; min-height: 1.4em; color: var(--text); white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
.legend ul { grid-area: 2 / 1; display: flex; flex-wrap: wrap; align-content: start; gap: 2px 16px; list-style: none; padding: 0; }
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
dl { display: grid; grid-template-columns: repeat(5, auto); justify-content: space-between; gap: 8px; }
dl.about { grid-template-columns: auto 1fr; gap: 3px 10px; margin-top: 5px; }
.about dd { font-weight: inherit; white-space: normal; overflow-wrap: anywhere; }
summary { font-size: 12.5px; cursor: pointer; color: var(--soft); }
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
  .legend .sentence { white-space: normal; height: 2.8em; }
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
  .legend .sentence { white-space: normal; }
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
`;var _h="bayesmap-theme",Ph={auto:"light",light:"dark",dark:"auto"},Qo=class{constructor(e,n){this.app=e;this.dressed=n;let s=tg();s&&s in Ph&&(this.choice=s),this.
media.addEventListener("change",this.listen)}theme=uo.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?uo.dark:uo.light;this.app.dataset.theme=e?"dark":"light";let{truth:s,ray:o,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:c,ghost:h,belief:u}=n;for(let[d,m]of Object.entries({truth:s,ray:o,miss:r,sensor:i,hatch:a,unobserved:l,draw:c,ghost:h,belief:u}))this.
app.style.setProperty(`--${d}`,m);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Ph[this.choice];try{localStorage.setItem(_h,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function tg(){try{return localStorage.getItem(_h)}catch{return null}}var Ch=12;function Bs(t,e,{embedded:n=!1,adopt:s=null,notice:o=null,play:r}={}){let i=t.shadowRoot??t.attachShadow({mode:"open"}),a=new CSSStyleSheet;a.replaceSync(
Ah+Eh),i.adoptedStyleSheets=[a],t.toggleAttribute("data-embedded",n);let l=0,c=()=>{l||=requestAnimationFrame(le)},h=new Zo(e,c,s,o);e.open();let u=new Zn,d=new to(
h),m=new eo(h,d),w=new Ho(h),b=new Go(h,d,m,ve,J=>w.showLayer(J),n),S=[new ns,new os,new as,new is,new yo,new fo,new rs,new ts,new ls,new ss,new co],T=S.map(({name:J})=>k(
"canvas",{className:J})),v=T[T.length-1];Object.assign(v,{tabIndex:0,role:"application"});let A=new io(S,T);new lo(v,h,u,d,m,n);let E=new ro(v,h,u,d,m),C={truth:!0,
rays:!0,readings:!0,strokes:!0,trajectory:!0},_=jc(b),I=ll(b),H={chip:ih(b),banner:ah(b)},Z=k("main",{className:"stage"},...T,H.chip,H.banner),j=()=>ye.theme,D=()=>u.
transform.scale,R=Xc(b,j,D),F=lh(b);v.setAttribute("aria-describedby",F.readout.id);let Y=Gc(b),W={help:Wc(b),new:Bc(b),share:Y.dialog},[q,V,$e,pe]=[ph(b),uh(b),
dh(b),fh(b)],re=[Uc(b),xh(b),Vc(b),Hc(b),eh(b),th(b,Ic(b,j),Oc(b,j)),yh(b),hh(b),gh(b,w,C,D),q,V,ch(b),$e,pe],ae=k("aside",{"aria-label":"Controls"},...re),Q=()=>h.
recorded||h.document?.source.kind==="run";b.visible(q,()=>h.editable),b.visible(V,()=>!Q()),b.visible($e,()=>!Q()),b.visible(pe,()=>!Q()),b.each(()=>{L(I,"inert",
!h.document),L(ae,"inert",!h.document)});let B=k("div",{className:"app"},_.element,I,Z,R,ae,F.element,...Object.values(W));i.replaceChildren(B);let ye=new Qo(B,
J=>{_.nameTheme(J),c()}),Le=()=>{let J=h.editable&&d.tool==="sensor"?d.sensor?.id??null:null;return{session:h,view:u,look:{theme:ye.theme,...C,hover:d.hover,cursor:d.
cursor,selected:J}}},we="";function le(){l=0;let J=h.take();h.document&&String(h.shape)!==we&&(we=String(h.shape),u.fit(h.shape),d.cursor=d.hover=null,h.decisions.
forget(),h.evidence.forget(),h.ghost.refit(),v.setAttribute("aria-label",`Map, ${h.shape[0]} by ${h.shape[1]} cells`)),A.paint(Le()),J&&(h.painted(),w.step());let{
x:ne,y:Fe}=u.transform;H.chip.style.transform=`translate(${Math.max(ne,Je.left)}px, ${Math.max(Fe-28,6)}px)`,st(v,"data-tool",h.editable||Lt.has(d.tool)?d.tool:
"pan"),b.refresh()}let rt=new ResizeObserver(()=>{let{width:J,height:ne}=Z.getBoundingClientRect();!J||!ne||(u.resize(J,ne,devicePixelRatio||1),u.fitted&&u.fit(
h.shape),cancelAnimationFrame(l),le())});rt.observe(Z);function Ze([J,ne]){let{scale:Fe}=u.transform;Fe<Ch&&u.zoom(Ch/Fe,u.middle,h.shape);let It=u.fromGrid({x:J+
.5,y:ne+.5},h.shape[1]);u.pan(u.middle.x-It.x,u.middle.y-It.y,h.shape),E.focus(),d.setCursor({x:J,y:ne})}async function ve(J){if(J==="in"||J==="out")u.zoom(J===
"in"?1.4:1/1.4,u.middle,h.shape);else if(J==="fit")u.fit(h.shape);else if(J.startsWith("cell "))Ze(J.slice(5).split(",").map(Number));else if(J==="help")W.help.
showModal();else if(J==="new")W.new.showModal();else if(J==="theme")ye.next();else if(J==="add")E.addSensor();else if(J==="share"){let ne=h.portableDocument();ne&&
Y.show(location.href.replace(/[?#].*/,"")+await Ma(ne))}else if(J==="export png"){let ne=await Za(Le());ne&&Or("bayesmap.png",ne),h.say("Saved bayesmap.png")}else
J.startsWith("export ")&&h.act({type:"export",what:J.slice(7)});c()}h.ondownload=(J,ne,Fe)=>Or(J,new Blob([Fe],{type:ne}));let Tt=[[n?t:window,"keydown",J=>{J.defaultPrevented||
!h.document||Object.values(W).some(ne=>ne.open)||Ua(J,h,{tool:ne=>{d.choose(ne),E.focus()},layer:ne=>w.showLayer(ne),command:ve})}],[window,"online",()=>e.retry?.()],
[window,"hashchange",async()=>{if(n)return;let{document:J,damaged:ne}=await Cs();J?h.bring(J):ne&&h.say(_s,"error")}],[t,"dragover",J=>J.preventDefault()],[t,"d\
rop",J=>{J.preventDefault();let ne=J.dataTransfer?.files[0];ne&&Pa(ne,h,r)}]];for(let[J,ne,Fe]of Tt)J.addEventListener(ne,Fe);return ye.dress(),{destroy(){rt.disconnect(),
cancelAnimationFrame(l),ye.destroy();for(let[J,ne,Fe]of Tt)J.removeEventListener(ne,Fe);e.close(),i.replaceChildren()},snapshot:()=>vh(h,u,A),cellToClient(J,ne){
let Fe=v.getBoundingClientRect(),It=u.fromGrid({x:J+.5,y:ne+.5},h.shape[1]);return{x:Fe.left+It.x,y:Fe.top+It.y}}}}var ng=200,sg=.2,Be=class extends Error{},Lh=({grid:t,walls:e})=>Ct(dt(e),t.shape[0]*t.shape[1]);function Dh({grid:t},{x:e,y:n}){let[s,o]=[Math.floor((e-t.origin[0])/
t.resolution),Math.floor((n-t.origin[1])/t.resolution)];return s>=0&&s<t.shape[0]&&o>=0&&o<t.shape[1]?s*t.shape[1]+o:null}function Pi(t,e){let n=Dh(t,e);if(n===
null)throw new Be("the sensor cannot stand outside the map");if(Lh(t)[n])throw new Be("the sensor cannot stand in a wall; move it to a free cell");return{...e,yaw:e.
yaw-2*Math.PI*Math.round(e.yaw/(2*Math.PI))}}function Nh(t,e,n){switch(e.type){case"set":return[_i({...t,...e.patch},t,n),""];case"walls":return og(t,e.cells,e.
wall);case"clear":return e.what==="walls"?[{...t,walls:Rh(t.grid.shape)},""]:null;case"add_sensor":{if(t.sensors.length>=n.sensors[1])throw new Be(`there are ${t.
sensors.length} sensors already; remove one first`);let s=Math.max(...t.sensors.map(o=>o.id))+1;return[{...t,sensors:[...t.sensors,Pi(t,{id:s,x:e.x,y:e.y,yaw:e.
yaw??0})]},""]}case"move_sensor":{let s=o=>Pi(t,{id:o.id,x:e.x??o.x,y:e.y??o.y,yaw:e.yaw??o.yaw});return[{...t,sensors:t.sensors.map(o=>o.id===e.id?s(o):o)},""]}case"\
remove_sensor":{let s=t.sensors.filter(o=>o.id!==e.id);if(!s.length)throw new Be("the last sensor cannot be removed; add another first");return[{...t,sensors:s},
""]}case"new":return[rg(t,e.shape,e.world),""];default:return null}}var Rh=([t,e])=>xn(new Uint8Array(t*e+7>>3));function og(t,e,n){let s=Lh(t),o=t.grid.shape[1];
for(let[i,a]of e)s[i*o+a]=n?1:0;let r="";for(let i of t.sensors){let a=Dh(t,i);s[a]&&(r=`a sensor stands in cell (${Math.floor(a/o)}, ${a%o}): it stays free`),s[a]=
0}return[{...t,walls:xn(qn(s))},r]}function rg(t,e,n){if(n!=="blank")throw new Be("this figure can begin blank maps alone; bayesmap app has others");let[s,o]=e.
map(i=>Math.floor((i-1)/2));return{...t,grid:{shape:e,resolution:1,origin:[-.5,-.5]},walls:Rh(e),sensors:[{id:1,x:s,y:o,yaw:0}],noise:sg,max_range:2*Math.max(...e)}}
function _i(t,e,n){let s=t;for(let[h,u]of Object.entries(e)){let d=s[h];if(u!==null&&(typeof d!=typeof u||d===null))throw new Be(`${h} is missing, or of another\
 type`);let m=n[h];if(m&&typeof d=="number"&&!(d>=m[0]&&d<=m[1]))throw new Be(`${h}: ${d}; give ${m[0]} to ${m[1]}`)}let{grid:o,source:r,sensors:i,walls:a}=s;if(r.
kind!=="simulation")throw new Be("this figure shows drawn maps alone; start bayesmap app with the file");if(s.cells!=="binary"||s.pose_sigma>0||s.heading_sigma>
0)throw new Be("this figure samples walls seen from known poses alone; bayesmap app samples others");if(s.method==="propagate")throw new Be("this figure has no \
belief propagation; choose another method");let[l,c]=n.side;if(!(o.shape.length===2&&o.shape.every(h=>Number.isInteger(h)&&h>=l&&h<=c)&&o.resolution>0))throw new Be(
`grid: give ${l} to ${c} cells a side`);if(dt(a).length!==o.shape[0]*o.shape[1]+7>>3)throw new Be("walls: another number of cells than the grid's");if(!(i.length>=
n.sensors[0]&&i.length<=n.sensors[1]))throw new Be(`sensors: give ${n.sensors[0]} to ${n.sensors[1]}`);return{...s,sensors:i.map(h=>Pi(s,h))}}function ig(t){return t.
type==="walls"&&t.stroke?`walls ${t.stroke}`:t.type==="set"&&t.drag?`set ${t.drag} ${Object.keys(t.patch).sort()}`:t.type==="move_sensor"&&t.drag?`move ${t.drag}\
 ${t.id}`:null}var er=class{constructor(e){this.present=e}past=[];future=[];gesture=null;get canUndo(){return this.past.length>0}get canRedo(){return this.future.
length>0}push(e,n){let s=ig(n);(s===null||s!==this.gesture)&&(this.past.push(this.present),this.past.length>ng&&this.past.shift()),this.future=[],this.gesture=s,
this.present=e}step(e){let[n,s]=e?[this.past,this.future]:[this.future,this.past],o=n.pop();return o?(s.push(this.present),this.present=o,this.gesture=null,!0):
!1}};var ag=11102230246251565e-32,$h=2**32,Fh=1,Ih=2,Oh=3;function Ci(t,e,n){let{high:s,low:o}=t,r=o&65535,i=o>>>16,a=n&65535,l=n>>>16,c=r*a,h=i*a+(c>>>16),u=r*l+(h&
65535),d=i*l+(h>>>16)+(u>>>16);t.low=((u&65535)<<16|c&65535)>>>0,t.high=d+Math.imul(s,n)+Math.imul(o,e)>>>0}function Li(t,e){let{high:n,low:s}=t;t.low=(s^(s>>>e|
n<<32-e))>>>0,t.high=(n^n>>>e)>>>0}function $t(t,e,n){let s=e+1;n.high=Math.floor(s/$h)>>>0,n.low=s>>>0,Ci(n,2654435769,2135587861);let o=n.low+t.low;n.high=n.high+
t.high+(o>=$h?1:0)>>>0,n.low=o>>>0,Li(n,30),Ci(n,3210233709,484763065),Li(n,27),Ci(n,2496678331,321982955),Li(n,31)}var Ni=({high:t,low:e})=>t*2097152+(e>>>11),
Cn=t=>(Ni(t)+.5)*ag;function bs(...t){let e=s=>BigInt.asUintN(64,s),n=0n;for(let s of t){let o=e((n^BigInt(s))+0x9e3779b97f4a7c15n);o=e((o^o>>30n)*0xbf58476d1ce4e5b9n),
o=e((o^o>>27n)*0x94d049bb133111ebn),n=o^o>>31n}return{high:Number(n>>32n),low:Number(n&0xffffffffn)}}var Di=2654435761,lg=2246822507;function tr(t,e){let n=Math.
imul(t+e,Di);return n=Math.imul(n^n>>>15,lg),n^n>>>13}function Uh(t,e,n,s){let o=n>>>1,r=(1<<o)-1,i=(1<<n-o)-1,a=t;do{let l=a>>>o,c=a&r;l^=tr(c,s.low)&i,c^=tr(l,
s.high)&r,l^=tr(c,s.low^Di)&i,c^=tr(l,s.high^Di)&r,a=(l<<o|c)>>>0}while(a>=e);return a}var Wh=t=>Math.max(2,32-Math.clz32(t-1));function Bh(t,e){let n={high:0,low:0};
$t(t,e,n);let s=Cn(n);return $t(t,e+1,n),Math.sqrt(-2*Math.log(s))*Math.cos(2*Math.PI*Cn(n))}var cg=2**53,Gh=20,Hh=1e15,[nr,Ri,zh]=[0,1,2],or=class{constructor(e){this.p=e;let n=e*cg,s=Math.round(n);this.level=s-n===.5&&s%2?s-1:s,this.logit=Math.min(Math.
max(Math.log(e)-Math.log1p(-e),-Hh),Hh)}level;logit;draws(e){return Ni(e)<this.level}logProb(e){if(this.p===0||this.p===1)return 0;let n=0;for(let s of e)n+=s;return e.
length*Math.log1p(-this.p)+n*this.logit}};function sr(t,e){return t>40?!0:t<-40?!1:e*(1+Math.exp(-t))<1}function $i({order:t,shuffle:e},n,s){if(!e)return i=>t[i];
let o=Wh(t.length),r={high:0,low:0};return $t(n,-1-s,r),i=>t[Uh(i,t.length,o,r)]}var rr=class{constructor(e,n,s){this.problem=e;this.walls=n;this.key=s;let{offsets:o,
cells:r,noHit:i}=e.table;this.first=new Int32Array(i.length),this.current=new Float32Array(i.length),this.reached=new Int32Array(n.length),this.gain=new Float32Array(
n.length),this.known=new Uint8Array(n.length);for(let a=0;a<i.length;a++){let l=this.nextWall(o[a],o[a+1]);this.first[a]=l,this.current[a]=this.entryLoglik(a,l);
for(let c=o[a];c<Math.min(l+1,o[a+1]);c++)this.reached[r[c]]++}}first;current;reached;gain;known;bits={high:0,low:0};nextWall(e,n){let{cells:s}=this.problem.table,
o=e;for(;o<n&&!this.walls[s[o]];)o++;return o}entryLoglik(e,n){let{offsets:s,loglik:o,noHit:r}=this.problem.table;return n<s[e+1]?o[n]:r[e]}logLikelihood(){let e=0;
for(let n of this.current)e+=n;return e}moveFirst(e,n){let{offsets:s,cells:o}=this.problem.table,r=s[e+1],i=this.first[e];this.first[e]=n,this.current[e]=this.entryLoglik(
e,n);let a=Math.min(i,n);for(let c=s[e];c<Math.min(a+1,r);c++)this.known[o[c]]=nr;let l=n>i?1:-1;for(let c=a+1;c<Math.min(Math.max(i,n)+1,r);c++)this.known[o[c]]=
nr,this.reached[o[c]]+=l}put(e){let{offsets:n,beam:s,entry:o}=this.problem.index;this.walls[e]=1;for(let r=n[e];r<n[e+1];r++)this.first[s[r]]>o[r]&&this.moveFirst(
s[r],o[r])}remove(e){let{table:n,index:s}=this.problem;this.walls[e]=0;for(let o=s.offsets[e];o<s.offsets[e+1];o++){let r=s.beam[o],i=s.entry[o];this.first[r]===
i&&this.moveFirst(r,this.nextWall(i+1,n.offsets[r+1]))}}sweep(e,n){let{prior:s}=this.problem,o=e.order.length,r=$i(e,this.key,n);for(let i=0;i<o;i++){let a=r(i);
$t(this.key,n*o+a,this.bits),this.reached[a]?this.walls[a]?this.stays(a,Cn(this.bits))||this.remove(a):this.becomes(a,Cn(this.bits))&&this.put(a):this.walls[a]=
s.draws(this.bits)?1:0}}becomes(e,n){let{logit:s}=this.problem.prior;return this.known[e]===nr&&this.sumGain(e,-Gh-s),sr(s+this.gain[e],n)?this.known[e]===zh?!0:
(this.sumGain(e,-1e300),sr(s+this.gain[e],n)):!1}sumGain(e,n){let{offsets:s,beam:o,entry:r,loglik:i,gainBound:a}=this.problem.index,l=0,c=zh;for(let h=s[e];h<s[e+
1];h++){let u=l+a[h];if(u<n){l=u,c=Ri;break}this.first[o[h]]>r[h]&&(l+=Math.fround(i[h]-this.current[o[h]]))}this.gain[e]=l,this.known[e]=c}stays(e,n){let{table:s,
index:o,prior:r}=this.problem;if(this.known[e]===nr){let l=0;for(let c=o.offsets[e];c<o.offsets[e+1];c++)this.first[o.beam[c]]===o.entry[c]&&(l+=o.advantage[c]);
this.gain[e]=l,this.known[e]=Ri}let i=r.logit+this.gain[e];if(this.known[e]===Ri&&i>Gh&&sr(i,n))return!0;let a=0;for(let l=o.offsets[e];l<o.offsets[e+1];l++){let c=o.
beam[l],h=o.entry[l];this.first[c]===h&&(a+=Math.fround(o.loglik[l]-this.entryLoglik(c,this.nextWall(h+1,s.offsets[c+1]))))}return sr(r.logit+a,n)}};var hg=8,pg=-1e300,ug=2**53;function Fi(t,e,n,s){let o=Math.floor(t/s)-e,r=t%s-n;return o<0||o>1||r<0||r>1?-1:2*o+r}function Vh({table:t,shape:[e,n]}){let{offsets:s,
cells:o,noHit:r}=t,i=Math.max(1,e-1),a=Math.max(1,n-1),l=Array.from({length:i*a},()=>[]);for(let d=0;d<r.length;d++)for(let m=s[d];m<s[d+1];m++)for(let w=0;w<4;w++){
let b=Math.floor(o[m]/n)-(w>>1),S=o[m]%n-(w&1);if(b<0||b>=i||S<0||S>=a)continue;let T=l[b*a+S],v=T[T.length-1];v?.b===d&&v.last>=m-hg?v.last=m:T.push({b:d,first:m,
last:m})}let c=new Int32Array(l.length+1);l.forEach((d,m)=>c[m+1]=c[m]+d.length);let h=l.flat(),u=d=>Int32Array.from(h,m=>m[d]);return{offsets:c,beam:u("b"),first:u(
"first"),last:u("last"),rows:a}}function jh(t,e,n,s){let{prior:o,shape:[r,i]}=t.problem,{rows:a}=e,l=n.order.length,c=$i(n,t.key,s),h=new Float64Array(16),u=new Float64Array(
16),d={high:0,low:0};for(let m=0;m<l;m++){let w=c(m),b=Math.floor(w/a),S=w%a,T=4*(s*l+w),v=C=>b+(C>>1)<r&&S+(C&1)<i?(b+(C>>1))*i+S+(C&1):-1,A=0;for(let C=0;C<4;C++)
v(C)>=0&&(A+=t.reached[v(C)]);if(!A){for(let C=0;C<4;C++)v(C)<0||($t(t.key,T+C,d),t.walls[v(C)]=o.draws(d)?1:0);continue}dg(t,e,w,b,S,h),u.fill(0);for(let C=0;C<
4;C++){let _=v(C)<0||o.level===0,I=!_&&o.level===ug;for(let H=0;H<16;H++)(H>>C&1)===(I?0:1)&&(u[H]+=_||I?pg:o.logit)}for(let C=0;C<16;C++)h[C]+=u[C];$t(t.key,T,
d);let E=fg(h,Cn(d));for(let C=0;C<4;C++){let _=v(C);_<0||(E>>C&1?t.walls[_]||t.put(_):t.walls[_]&&t.remove(_))}}}function dg(t,e,n,s,o,r){let{table:i,shape:[,a]}=t.
problem,{offsets:l,cells:c,loglik:h}=i;r.fill(0);for(let u=e.offsets[n];u<e.offsets[n+1];u++){let d=e.beam[u],m=t.first[d],w=e.first[u];if(m<w)continue;let b=e.
last[u],S=l[d+1],T=m;if(m<=b&&m<S&&Fi(c[m],s,o,a)>=0)for(T=m+1;T<S&&!(t.walls[c[T]]&&Fi(c[T],s,o,a)<0);)T++;let v=t.entryLoglik(d,T),A=0;for(let E=w;E<Math.min(
b+1,T);E++){let C=Fi(c[E],s,o,a);if(C<0)continue;let _=Math.fround(h[E]-v);for(let I=0;I<16;I++)I>>C&1&&!(I&A)&&(r[I]+=_);A|=1<<C}}}function fg(t,e){let n=Math.
max(...t),s=t.map(r=>r>n-40?Math.exp(r-n):0),o=e*s.reduce((r,i)=>r+i,0);for(let r=0;r<16;r++)if(o-=s[r],o<=0&&s[r]>0)return r;return 15}function Ln(t){let e=0;for(let n=0;n<t.length;n++)e+=t[n];return e/t.length}var Ii=t=>{let e=Ln(t);return t.reduce((n,s)=>n+(s-e)**2,0)/(t.length-1)},ir=(t,e)=>t.
reduceRight((n,s)=>n*e+s,0),Yh=[[3.3871328727963665,133.14166789178438,1971.5909503065513,13731.69376550946,45921.95393154987,67265.7709270087,33430.57558358813,
2509.0809287301227],[1,42.31333070160091,687.1870074920579,5394.196021424751,21213.794301586597,39307.89580009271,28729.085735721943,5226.495278852854]],Kh=[[1.4234371107496835,
4.630337846156546,5.769497221460691,3.6478483247632045,1.2704582524523684,.2417807251774506,.022723844989269184,.0007745450142783414],[1,2.053191626637759,1.6763848301838038,
.6897673349851,.14810397642748008,.015198666563616457,.0005475938084995345,10507500716444169e-25]];function mg(t){let e=t-.5;if(Math.abs(e)<=.425){let s=.180625-
e*e;return e*ir(Yh[0],s)/ir(Yh[1],s)}let n=Math.sqrt(-Math.log(e<0?t:1-t))-1.6;return Math.sign(e)*ir(Kh[0],n)/ir(Kh[1],n)}function gg(t){let e=t[0].length>>1;return[
...t.map(n=>n.slice(0,e)),...t.map(n=>n.slice(n.length-e))]}function qh(t){let e=Float64Array.from(t.flat()).sort(),n=new Map;for(let s=0;s<e.length;){let o=s+1;
for(;o<e.length&&e[o]===e[s];)o++;n.set(e[s],mg(((s+1+o)/2-.375)/(e.length+.25))),s=o}return t.map(s=>s.map(o=>n.get(o)))}function Jh(t){let e=t[0].length;return Math.
sqrt((e-1)/e+Ii(t.map(Ln))/Ln(t.map(Ii)))}function Xh(t,e){let n=t.length;for(let s=1,o=0;s<n;s++){let r=n>>1;for(;o&r;r>>=1)o^=r;o^=r,s<o&&([t[s],t[o],e[s],e[o]]=
[t[o],t[s],e[o],e[s]])}for(let s=2;s<=n;s*=2)for(let o=0;o<s/2;o++){let r=-2*Math.PI*o/s,[i,a]=[Math.cos(r),Math.sin(r)];for(let l=o;l<n;l+=s){let c=l+s/2,[h,u]=[
t[c]*i-e[c]*a,t[c]*a+e[c]*i];[t[c],e[c]]=[t[l]-h,e[l]-u],t[l]+=h,e[l]+=u}}}function yg(t){let e=t.length,n=Ln(t),s=2**Math.ceil(Math.log2(2*e)),[o,r]=[new Float64Array(
s),new Float64Array(s)];t.forEach((i,a)=>o[a]=i-n),Xh(o,r);for(let i=0;i<s;i++)[o[i],r[i]]=[o[i]**2+r[i]**2,0];return Xh(o,r),o.slice(0,e).map(i=>i/s/e)}function wg(t){
let[e,n]=[t.length,t[0].length],s=t.map(yg),o=Ln(s.map(h=>h[0]))*n/(n-1),r=o*(n-1)/n+Ii(t.map(Ln)),i=h=>h?1-(o-Ln(s.map(u=>u[h])))/r:1,a=Math.max(1,Math.ceil((n-
2)/2)),l=-1,c=1/0;for(let h=0;h<a;h++){let u=i(2*h),d=u+i(2*h+1);if(!(d>0)||h===a-1){l+=d>0?u:Math.max(u,0);break}c=Math.min(c,d),l+=2*c}return e*n/Math.max(l,1/
Math.log10(e*n))}function Zh(t){if(t[0].length<4||t.every(c=>c.every(h=>h===t[0][0])))return null;let e=gg(t),n=Float64Array.from(e.flat()).sort(),s=(n[n.length-
1>>1]+n[n.length>>1])/2,o=e.map(c=>c.map(h=>Math.abs(h-s))),r=qh(e),[i,a]=[Jh(r),Jh(qh(o))];return{rhat:Number.isNaN(a)?i:Number.isNaN(i)?a:Math.max(i,a),ess:wg(
r)}}function Qh({table:t,prior:e,shape:n},s,o,r){let{offsets:i,cells:a,loglik:l,noHit:c}=t,h=n[0]*n[1],u={high:0,low:0},d=new Int8Array(h);return Float64Array.from(
{length:r},(m,w)=>{d.fill(0);let b=0;for(let S=0;S<c.length;S++){let T=c[S];for(let v=i[S];v<i[S+1];v++){let A=a[v];if(d[A]||($t(s,(o+w)*h+A,u),d[A]=e.draws(u)?
1:-1),d[A]>0){T=l[v];break}}b+=T}return b})}function Oi({prior:t,shape:e},n,s){let o=e[0]*e[1],r={high:0,low:0};return Uint8Array.from({length:o},(i,a)=>($t(n,s*
o+a,r),t.draws(r)?1:0))}function ep(t){let e=t.reduce((r,i)=>Math.max(r,i),-1/0),n=e+Math.log(t.reduce((r,i)=>r+Math.exp(i-e),0)),s=t.map(r=>r-n),o=s.reduce((r,i)=>r+
Math.exp(2*i),0);return{logWeights:s,logEvidence:n-Math.log(t.length),effectiveSampleSize:1/o}}var Ui=(t,e)=>e>0?Math.ceil(t-1e-9)-1:Math.floor(t+1e-9),Wi=t=>Math.abs(t)<1e-10?0:t>0?1:-1,ar=class{constructor({x:e,y:n,ux:s,uy:o},r,i,a){this.nx=r;this.ny=i;
this.stepX=Wi(s),this.stepY=Wi(o);let l=0,c=a;this.stepX?(this.gapX=1/Math.abs(s),l=Math.max(l,Math.min(-e/s,(r-e)/s)),c=Math.min(c,Math.max(-e/s,(r-e)/s))):(e<
-1e-9||e>r+1e-9)&&(c=-1),this.stepY?(this.gapY=1/Math.abs(o),l=Math.max(l,Math.min(-n/o,(i-n)/o)),c=Math.min(c,Math.max(-n/o,(i-n)/o))):(n<-1e-9||n>i+1e-9)&&(c=
-1),this.end=c+1e-9,this.x=Ui(e+(this.stepX?l*s:0),this.stepX),this.y=Ui(n+(this.stepY?l*o:0),this.stepY),this.stepX&&(this.nextX=(this.x+Math.max(this.stepX,0)-
e)/s),this.stepY&&(this.nextY=(this.y+Math.max(this.stepY,0)-n)/o),!this.stepX&&Math.abs(e-this.x)<=1e-9&&(this.alongLine=1,this.sideX=-1),!this.stepY&&Math.abs(
n-this.y)<=1e-9&&(this.alongLine=2,this.sideY=-1),this.cellX=this.x,this.cellY=this.y,this.sides=this.alongLine,this.distance=Math.max(0,Math.min(this.nextX,this.
nextY))}cellX;cellY;distance;end;x;y;sides;sideX=0;sideY=0;alongLine=0;stepX;stepY;nextX=1e300;nextY=1e300;gapX=1e300;gapY=1e300;get over(){return this.distance>
this.end}get inside(){return this.cellX>=0&&this.cellX<this.nx&&this.cellY>=0&&this.cellY<this.ny}next(){if(this.sides&1){this.cellX=this.x+this.sideX,this.cellY=
this.y,this.sides&=2;return}if(this.sides){this.cellX=this.x,this.cellY=this.y+this.sideY,this.sides=0;return}let e=this.nextX<this.nextY-1e-9,n=this.nextY<this.
nextX-1e-9;this.distance=e?this.nextX:n?this.nextY:Math.min(this.nextX,this.nextY),this.sides=this.alongLine,e===n&&(this.sideX=-this.stepX,this.sideY=-this.stepY,
this.sides=3),n||(this.nextX+=this.gapX,this.x+=this.stepX),e||(this.nextY+=this.gapY,this.y+=this.stepY),this.cellX=this.x,this.cellY=this.y}};function tp(t,[e,
n],s,o){for(let r=new ar(s,e,n,o);!r.over;r.next())if(r.inside&&t[r.cellX*n+r.cellY])return Math.min(r.distance,o);return o}function np([t,e],n,s){let o=[],r=new Int32Array(
n.length+1);return n.forEach((i,a)=>{for(let l=new ar(i,t,e,s);!l.over;l.next())l.inside&&o.push(l.cellX*e+l.cellY);r[a+1]=o.length}),{offsets:r,cells:Int32Array.
from(o)}}function sp({x:t,y:e,ux:n,uy:s},o,r){let i=Math.floor(o/r),a=o-i*r,l=0,c=1e300,h=!0,u=(d,m,w)=>{let b=Wi(m);if(!b)return;let S=1/m,T=w+(b>0?0:1)-d;l=Math.
max(l,T*S),c=Math.min(c,(T+b)*S),h&&=w===Ui(d,b)};return u(t,n,i),u(e,s,a),h?Math.max(c,0):l}var bg=Math.fround(.001),xg=-.5*Math.log(2*Math.PI);function op(t,e,n,s,o,r){let{offsets:i,cells:a}=t,l=s.sigma_m*s.sigma_m,c=.5*Math.log(l),h=(m,w)=>{let b=m-Math.
min(w,s.max_m);return xg-.5*(b*b/l)-c},u=new Float32Array(a.length),d=new Float32Array(e.length);for(let m=0;m<e.length;m++){d[m]=h(n[m],1/0);for(let w=i[m];w<i[m+
1];w++)u[w]=h(n[m],sp(e[m],a[w],o)*r)}return{offsets:i,cells:a,loglik:u,noHit:d}}function rp({offsets:t,cells:e,loglik:n,noHit:s},o){let r=Float32Array.from(s),
i=new Float32Array(e.length);for(let d=0;d<s.length;d++){let m=s[d];for(let w=t[d+1]-1;w>=t[d];w--)i[w]=n[w]-m,m=Math.max(m,n[w]),r[d]=Math.min(r[d],n[w])}let a=new Int32Array(
o+1);for(let d of e)a[d+1]++;for(let d=0;d<o;d++)a[d+1]+=a[d];let l=()=>new Float32Array(e.length),c=()=>new Int32Array(e.length),h={offsets:a,entry:c(),beam:c(),
loglik:l(),gainBound:l(),advantage:l()},u=a.slice();for(let d of[!0,!1])for(let m=0;m<s.length;m++)for(let w=t[m];w<t[m+1];w++){let b=Math.fround(n[w]-r[m]);if(b>
bg!==d)continue;let S=u[e[w]]++;h.entry[S]=w,h.beam[S]=m,h.loglik[S]=n[w],h.gainBound[S]=b,h.advantage[S]=i[w]}for(let d=0;d<o;d++)for(let m=a[d+1]-2;m>=a[d];m--)
h.gainBound[m]+=h.gainBound[m+1];return h}function Bi({angles:t,fov:e}){let n=e*(180/Math.PI);if(n===360)return Float64Array.from({length:t},(o,r)=>r*2*Math.PI/t);let s=n/(t-t%2);return Float64Array.from(
{length:t},(o,r)=>(s*r-n/2)*(Math.PI/180))}function ip(t){let{origin:e,resolution:n}=t.grid,s=[...Bi(t)];return t.sensors.flatMap(({x:o,y:r,yaw:i})=>s.map(a=>({
x:(o-e[0])/n,y:(r-e[1])/n,ux:Math.cos(i+a),uy:Math.sin(i+a)})))}function ap({grid:t,walls:e,max_range:n},s){let o=Ct(dt(e),t.shape[0]*t.shape[1]),r=n/t.resolution;
return Float64Array.from(s,i=>Math.min(tp(o,t.shape,i,r)*t.resolution,n))}function lp({grid:t,noise:e,prior:n,max_range:s},o,r){let{shape:i,resolution:a}=t,l=np(
i,o,s/a),c=op(l,o,r,{sigma_m:e,max_m:s},i[1],a);return{table:c,index:rp(c,i[0]*i[1]),prior:new or(n),shape:i}}function cp({grid:t,sensors:e,order:n},s){let[o,r]=t.
shape,[i,a]=s?[Math.max(1,o-1),Math.max(1,r-1)]:[o,r],l=Int32Array.from({length:i*a},(d,m)=>m);if(n!=="radial")return{order:l,shuffle:n==="random"};let c=(d,m)=>Math.
min(Math.max(d,0),m-1),h=e.map(({x:d,y:m})=>[c(Math.floor((d-t.origin[0])/t.resolution),o),c(Math.floor((m-t.origin[1])/t.resolution),r)]),u=l.map(d=>Math.min(...h.
map(([m,w])=>Math.abs(Math.floor(d/a)-m)+Math.abs(d%a-w))));return{order:Int32Array.from([...l].sort((d,m)=>u[d]-u[m]||d-m)),shuffle:!1}}var cn=2,hp=32,vg=300,kg=100,Sg=64<<20,Mg=.1,Tg=16,Ag=40,Gi=24,pp=[.1,.3,.5,.7,.9],fp={chains:0,count:0},Eg={gibbs:"Gibbs sampling, cell by cell",block:"Gibbs s\
ampling, 2 x 2 blocks",importance:"importance sampling",none:"none yet: this is the prior"},xs=()=>performance.now(),up=t=>Uint8Array.from(t,e=>Math.round(255*e)),
dp=t=>String(+t.toPrecision(4)),vs=class{constructor(e,n){this.document=e;this.problem=n;this.cells=n.shape[0]*n.shape[1]}done=!1;seconds=0;method="none";cells;work(e){
let n=xs();do this.step();while(!this.done&&xs()-n<e);this.seconds+=(xs()-n)/1e3}step(){this.done=!0}get draws(){return fp}beamsThrough(e){let{offsets:n}=this.problem.
index;return n[e+1]-n[e]}mean(){return new Float64Array(this.cells).fill(this.document.prior)}reached(){return new Uint8Array(this.cells)}get logJoint(){return[]}figures(e){
return{sweeps:0,total:0,ess:null,rhat:null,log_joint:null,verdict:null,burned:0}}draw(e){return null}weights(){return null}picture(e,n,s,o){let{document:r,method:i}=this,
a=e.layer==="draw"?this.draw(e):null,l=this.weights(),c=i==="gibbs"?`, ${r.order} order`:"",h={type:"field",generation:n,milliseconds:s,layer:a?"draw":"mean",method:i,
approximate:!1,...this.figures(o),draws:this.draws,quantity:{kind:"binary",mean:"P(wall)",value:"wall",interval:!1},chain:null,draw:null,averaged:null,lowest:l?.
lowest??null,seconds:i==="none"?null:this.seconds,about:[["Method",Eg[i]+c],["Prior",`independent: p wall ${dp(r.prior)}`],["Sensor",`gaussian: sigma ${dp(r.noise)}\
 m`],["Poses","known"],["Computed","in this page"]],...a&&{chain:a.chain,draw:a.draw,log_joint:a.log_joint}},u=up(a?a.map:this.mean());return[h,{p:u,reached:up(
this.reached()),...this.trace(),...l&&{weights:l.weights}}]}trace(){let e=this.logJoint,n=e[0]?.length??0,s=Math.min(n,vg),o=Array.from({length:s},(a,l)=>Math.round(
s>1?1+l*(n-1)/(s-1):1)),r=Array.from({length:Math.min(n,kg)},(a,l)=>l+1),i=[...new Set([...r,...o])].sort((a,l)=>a-l);return{trace:Float32Array.from(e.flatMap(a=>i.
map(l=>a[l-1]))),traced:Float32Array.from(i)}}},Gs=class extends vs{constructor(n,s,o,r){super(n,s);this.judging=o;let{seed:i,start:a,sweeps:l}=n;this.method=r?
"block":"gibbs",this.blocks=r?Vh(s):null,this.sites=cp(n,r),this.thin=Math.ceil(l*cn*Math.ceil(this.cells/8)/Sg),this.chains=Array.from({length:cn},(c,h)=>{let d=a===
"empty"&&n.prior<1?new Uint8Array(this.cells):Oi(s,bs(i,h,Ih),0);return new rr(s,d,bs(i,h,Fh))}),this.touched=new Uint8Array(this.cells);for(let c of s.table.cells)
this.touched[c]=1;this.present={sweep:0,sums:this.chains.map(()=>new Float64Array(this.cells)),reached:new Uint32Array(this.cells),looks:0},this.past=[this.copy()],
this.goOn(l)}chains;blocks;sites;lookAt=new Set;touched;joint=Array.from({length:cn},()=>[]);kept=Array.from({length:cn},()=>[]);thin;total=0;sweep=0;present;past;diagnosis=null;diagnosed=0;diagnoseAt=0;goOn(n){
let{lookAt:s,document:o}=this;this.total=Math.ceil((this.total+n)/this.thin)*this.thin,s.add(Math.floor(o.burn_in*this.total));for(let r=1;r<=this.total;r*=2)s.
add(r);for(let r=1;r<=hp;r++)s.add(Math.floor(this.total*r/hp));this.done=!1,this.diagnoseAt=0}burn(n){let s=Math.floor(n/this.thin),o=this.kept.map(r=>{let i=new Float64Array(
this.cells);for(let a of r.slice(0,s))Ct(a,this.cells).forEach((l,c)=>i[c]+=l);return i.map(a=>a*n/Math.max(1,s))});this.past=[{...this.past[0],sweep:n,sums:o}]}copy(){
let{sums:n,reached:s,looks:o}=this.present;return{sweep:this.sweep,sums:n.map(r=>r.slice()),reached:s.slice(),looks:o}}step(){let{present:n,document:s}=this;this.
chains.forEach((r,i)=>{this.blocks?jh(r,this.blocks,this.sites,this.sweep):r.sweep(this.sites,this.sweep);let a=n.sums[i];for(let l=0;l<this.cells;l++)a[l]+=r.walls[l];
this.joint[i].push(r.logLikelihood()+this.problem.prior.logProb(r.walls)),(this.sweep+1)%this.thin===0&&this.kept[i].push(qn(r.walls))}),this.sweep++,this.done=
this.sweep>=this.total;let o=Math.floor(s.burn_in*this.total);if(this.done&&o>this.past[0].sweep&&this.past.every(({sweep:r})=>r!==o)&&this.burn(o),!!this.lookAt.
has(this.sweep)){for(let r of this.chains)for(let i=0;i<this.cells;i++)n.reached[i]+=r.reached[i]?1:0;for(n.looks+=cn,this.sweep<=s.burn_in*this.total&&this.past.
push(this.copy());this.past.length>1&&this.past[1].sweep<=s.burn_in*this.sweep;)this.past.shift()}}get draws(){return this.kept[0].length?{chains:cn,count:this.
kept[0].length}:fp}means(){let[n]=this.past,s=Math.max(1,this.sweep-n.sweep);return this.present.sums.map((o,r)=>o.map((i,a)=>(i-n.sums[r][a])/s))}mean(){let[n,
s]=this.means();return n.map((o,r)=>this.touched[r]?(o+s[r])/2:this.document.prior)}reached(){let[n]=this.past,s=Math.max(1,this.present.looks-n.looks);return Float64Array.
from(this.present.reached,(o,r)=>(o-n.reached[r])/s)}get logJoint(){return this.joint}draw({chain:n,draw:s}){let o=Math.min(n,cn-1),{count:r}=this.draws;if(!r)return{
map:this.chains[o].walls,chain:o,draw:0,log_joint:this.joint[o].at(-1)??0};let i=Math.min(s??r-1,r-1);return{map:Ct(this.kept[o][i],this.cells),chain:o,draw:i,log_joint:this.
joint[o][(i+1)*this.thin-1]}}figures(n){let[{sweep:s}]=this.past,o=xs();(o>=this.diagnoseAt||this.done&&this.diagnosed<this.sweep)&&(this.diagnosis=Zh(this.joint.
map(c=>c.slice(s))),this.diagnosed=this.sweep,this.diagnoseAt=this.done?1/0:xs()+(xs()-o)/Mg);let r=this.joint.reduce((c,h)=>c+h[h.length-1],0)/cn,{ess:i=null,rhat:a=null}=this.
diagnosis??{},l=c=>c!==null&&Number.isFinite(c)?c:null;return{sweeps:this.sweep,total:this.total,ess:l(i),rhat:l(a),log_joint:r,verdict:this.verdict(n||this.done),
burned:s}}verdict(n){let{judging:s,sweep:o}=this,r=o<s.fewest_sweeps;if(r&&!n)return null;let i=(h,u,d=null)=>({level:h,why:u,cell:d}),a=this.difference();if(!r&&
a.cells>s.chance_share*a.among){let[h,u]=a.cell,d=`in ${a.cells} of ${a.among} observed cells, most in cell (${h}, ${u}), by ${a.by.toFixed(2)}`;return i("bad",
`P(wall) differs by over ${s.bad_difference} between the chains ${d}`,a.cell)}if(o<s.fewest_diagnosed)return i("bad",`${o} ${o===1?"sweep is":"sweeps are"} too \
few to judge`);let{rhat:l=NaN,ess:c=NaN}=this.diagnosis??{};return!Number.isFinite(l)||!Number.isFinite(c)?null:l<=s.rhat_limit?c<s.bad_ess?i("bad",`only ${c.toFixed(
0)} effective draws`):l>s.good_rhat||c<s.good_ess?i("fair",`R-hat ${l.toFixed(3)} and ${c.toFixed(0)} effective draws; ${s.good_rhat} and ${s.good_ess} are good`):
i("good",`R-hat ${l.toFixed(3)}, ${c.toFixed(0)} effective draws`):i("bad",`R-hat is ${l.toFixed(2)}, over ${s.rhat_limit}`)}difference(){let[n,s]=this.means(),
o=this.reached(),r={by:0,cell:[0,0],cells:0,among:0};for(let i=0;i<this.cells;i++){if(o[i]<.5)continue;let a=Math.abs(n[i]-s[i]);r.among++,a>this.judging.bad_difference&&
r.cells++,a>r.by&&([r.by,r.cell]=[a,[Math.floor(i/this.problem.shape[1]),i%this.problem.shape[1]]])}return r}},lr=class extends vs{constructor(n,s,o){super(n,s);
this.judging=o;this.method="importance",this.key=bs(n.seed,0,Oh),this.sums=new Float64Array(this.cells),this.touched=new Uint8Array(this.cells);for(let r of s.table.
cells)this.touched[r]=1}key;logWeights=[];most=-1/0;sum=0;sums;touched;step(){let n=this.logWeights.length,s=Math.min(Tg,this.document.sweeps-n);Qh(this.problem,
this.key,n,s).forEach((o,r)=>{if(this.logWeights.push(o),o>this.most){let l=Math.exp(this.most-o);this.sum*=l;for(let c=0;c<this.cells;c++)this.sums[c]*=l;this.
most=o}if(o<this.most-Ag)return;let i=Math.exp(o-this.most),a=Oi(this.problem,this.key,n+r);this.sum+=i;for(let l=0;l<this.cells;l++)a[l]&&(this.sums[l]+=i)}),this.
done=this.logWeights.length>=this.document.sweeps}mean(){return this.sums.map((n,s)=>this.touched[s]?n/this.sum:this.document.prior)}reached(){let n=this.mean(),
{offsets:s,cells:o,noHit:r}=this.problem.table,i=new Float64Array(this.cells);for(let a of pp){let l=new Uint8Array(this.cells);for(let c=0;c<r.length;c++)for(let h=s[c];h<
s[c+1]&&(l[o[h]]=1,!(n[o[h]]>a));h++);for(let c=0;c<this.cells;c++)i[c]+=l[c]/pp.length}return i}figures(){let{effectiveSampleSize:n}=ep(Float64Array.from(this.
logWeights));return{sweeps:this.logWeights.length,total:this.document.sweeps,ess:n,rhat:null,log_joint:null,verdict:this.verdict(n),burned:0}}verdict(n){let{bad_ess:s,
good_ess:o}=this.judging,r=n.toFixed(1)==="1.0"?"one particle carries":`${n.toFixed(1)} particles carry`;return n<s?{level:"bad",why:`${r} all the weight`,cell:null}:
{level:n>=o?"good":"fair",why:`${n.toFixed(0)} effective particles`,cell:null}}weights(){let n=this.logWeights.map(r=>r-this.most),s=Math.min(-1,...n.filter(Number.
isFinite).reduce((r,i)=>[Math.min(r[0],i)],[0])),o=new Float32Array(Gi);for(let r of n)o[Math.min(Gi-1,Math.floor(Gi*(1-r/s)))]++;return{weights:o,lowest:s}}};var Pg=12,_g=80,Cg=11,Lg=new Set(["path","views","where","ghost","beam"]),Hi="This figure has no such tool: bayesmap app has it";async function mp(t){return JSON.
parse(new TextDecoder().decode(await Jn(dt(t))))}function Dg(t,e){let n=ap(t,e),{seed:s,noise:o,angles:r,sensors:i}=t,a=i.map(({id:c})=>bs(s,c,Cg)),l=n.map((c,h)=>t.
readings==="exact"?c:c+o*Bh(a[Math.floor(h/r)],2*(h%r)));return{exact:n,readings:l}}function Ng({method:t,prior:e},{rare_walls:n}){return t!=="auto"?t:Math.min(
e,1-e)<=n?"block":"gibbs"}function gp(t,e=n=>setTimeout(n)){let{limits:n,judging:s}=t,o=new er(t.document),[r,i]=[0,0],[a,l,c]=[!0,!1,!1],h={layer:"mean",chain:0,
draw:null},u="live",d=null,[m,w]=[!1,!1],[b,S]=[0,0],T=(R,F)=>D.onmessage({type:"status",text:R,level:F},{}),v=()=>D.onmessage({type:"state",document:o.present,
generation:r,seq:i,can_undo:o.canUndo,can_redo:o.canRedo,live:a,running:l,working:c,draws:!c&&d?.draws||{chains:0,count:0},scan:0,view:h},{}),A=(R=!1)=>{d&&(S=performance.
now(),D.onmessage(...d.picture(h,r,Math.round(S-b),R)))};function E(){if(m=!1,w||!c)return;let R=!d;d??=_(),u!=="clear"&&d.work(Pg);let F=d.done||u==="clear";(R||
F||performance.now()-S>_g)&&A(),F?(l=c=!1,v()):C()}function C(){m||e(E),m=!0}function _(){let R=o.present,{sensors:F,max_range:Y}=R,W=ip(R),{exact:q,readings:V}=Dg(
R,W),$e=Float64Array.from(F.flatMap(({x:B,y:ye,yaw:Le})=>[B,ye,Le])),pe=B=>Float32Array.from(B),re={pose:$e,angles:pe(Bi(R)),ranges:pe(V),exact:pe(q),hit:Uint8Array.
from(q,B=>B<Y?1:0)};D.onmessage({type:"scan",generation:r,ids:F.map(({id:B})=>B),index:null},re);let ae=lp(R,W,V),Q=Ng(R,t);return u==="clear"?new vs(R,ae):Q===
"importance"?new lr(R,ae,s):new Gs(R,ae,s,Q==="block")}function I(R=a?"live":"clear"){r++,u=R,d=null,l=u==="run",c=!0,b=performance.now(),v(),C()}function H(){if(!c)
return v();if(!d)return I("clear");l=c=!1,A(!0),v()}function Z(R){if(R)return o.push(_i(R,t.document,n),{type:"hello"}),I();if(!r)return I();v(),A()}function j(R){
switch(R.type){case"hello":return Z(R.document);case"run":{u==="live"&&c&&(d??=_());let q=d instanceof Gs?d:null;I("run"),q?.goOn(o.present.sweeps),d=q;return}case"\
cancel":return H();case"live":return a=R.on,l?v():a?I():H();case"view":return h={layer:R.layer,chain:R.chain??h.chain,draw:R.draw??null},v(),A(!c);case"undo":case"\
redo":return o.step(R.type==="undo")?I():(T(`nothing to ${R.type}`,"info"),v());case"export":{if(R.what!=="document")throw new Be(Hi);let q=new TextEncoder().encode(
`${JSON.stringify(o.present,null,1)}
`);return D.onmessage({type:"download",name:"document.json",mime:"application/json",note:""},{data:q})}case"clear":if(R.what==="inference")return I("clear")}let F=Nh(
o.present,R,n);if(!F)throw new Be(Hi);let[Y,W]=F;o.push(Y,R),W&&T(W,"warning"),I()}let D={...sn(),open:()=>{D.onmessage({type:"welcome",version:1,limits:n,recorded:!1,
figure:!0,lacks:[]},{}),D.onmessage({type:"worker",state:"ready"},{}),D.onstatus({connected:!0})},send:R=>{if(R.type!=="painted"){if(R.type==="inspect"){let F=d?.
beamsThrough(R.x*o.present.grid.shape[1]+R.y);if(F===void 0)return;let Y={beams_for:null,nats_for:null,beams_against:null,nats_against:null};return D.onmessage(
{type:"cell",x:R.x,y:R.y,each:!1,beams:F,...Y},{})}if(Lg.has(R.type))return T(Hi,"warning");i=R.seq??i;try{j(R)}catch(F){if(!(F instanceof Be))throw F;if(R.type===
"hello")return D.onmessage({type:"error",text:F.message,remedy:"",seq:i},{});T(F.message,"warning"),v()}}},close:()=>{w=!0}};return D}var zi=250,Rg=8e3;function yp(t){let e=null,n=zi,s=0,o=!1;function r(){clearTimeout(s);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),c=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{c=!0,n=zi,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...Zs(h))},l.onclose=()=>{if(o||e!==l)return;s=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),c||$g(t()).then(u=>u&&e===l&&i.onstatus({...h,refused:u})),n=Math.min(Rg,2*n)}}let i={...sn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=zi,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{o=!0,clearTimeout(s),e?.close()}};return i}async function $g(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function wp(t){let e=(s,o=[])=>n.onmessage(s,Aa(s,o)),n={...sn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:s=>t.send(s),close:()=>t.off("m\
sg:custom",e)};return n}var Fg="This is the map that was drawn here when the connection was lost; undo leads back",cr=t=>Object.assign(window,{bayesmap:t}),G1={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let s=Bs(n,wp(t),{embedded:!0});return cr(s),()=>s.destroy()}};function bp(t,e){let n=Bs(t,Ea(e),{play:Vi(t,()=>n)});cr(n)}var Vi=(t,e)=>n=>{
e().destroy(),bp(t,n)};async function Ig(){let t=document.querySelector("[data-bayesmap]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("bod\
y { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("script[data-recording]");if(n){bp(t,await Qs(n.textContent??""));return}let s=document.
querySelector("script[data-figure]");if(s){let[{document:h,damaged:u},d]=await Promise.all([Cs(),mp(s.textContent??"")]),m=u?{text:_s,level:"error"}:null,w=Bs(t,
gp(d),{adopt:h,notice:m,play:Vi(t,()=>w)});cr(w);return}il(new URLSearchParams(location.search).get("token"));let{document:o,damaged:r}=await Cs(),i=o?null:sl(),
a=yp(()=>new URL(location.href));al(h=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(h)}${location.hash}`),a.retry?.()});let c=Bs(
t,a,{adopt:o??i,notice:r?{text:_s,level:"error"}:i?{text:Fg,level:"info"}:null,play:Vi(t,()=>c)});cr(c)}Ig();export{G1 as default,gp as localTransport,Bs as mount,mp as readFigure,Qs as readRecording,Ea as recordedTransport,yp as webSocketTransport,wp as widgetTransport};
