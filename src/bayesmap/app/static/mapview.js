// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function wt(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Zn(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function ht(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Mn(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Wa(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Qn=t=>Wa(t,new DecompressionStream("deflate-raw")),Ga=t=>Wa(t,new CompressionStream("deflate-r\
aw"));async function Ha(t){let e=await Ga(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Mn(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Ed(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Qn(ht(e[1]))))}var $o="The link's map cannot be read: copy the link again, who\
le";async function Fo(){let t=await Ed(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var zr={uint8:Uint8Array,uint32:Uint32Array,float32:Float32Array,float64:Float64Array},Va=8,hn=()=>({onmessage:()=>{},onstatus:()=>{}});function pn(t){let e=new DataView(
t).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let l=a.reduce((c,h)=>c*
h,1)*zr[i].BYTES_PER_ELEMENT;o[r]=new zr[i](t.slice(s,s+l)),s+=Math.ceil(l/Va)*Va}return[n,o]}function ja(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{
let{buffer:i,byteOffset:a,byteLength:l}=e[r];n[o]=new zr[s](i.slice(a,a+l))}),n}async function ls(t){let e=await Qn(ht(t));return pn(e.buffer)}function cs([t,e]){let{document:n,ids:o,log_joint:s}=t,{chains:r,count:i,bits:a}=t.draws,l=n.grid.
shape[0]*n.grid.shape[1],c=n.source.kind!=="simulation",h=1,u={chains:r,count:i},d=0,m={layer:"mean",chain:0,draw:null},w=(D,L=D.length===0)=>{let O=D.length/o.
length;return c&&!L?D.slice(d*O,(d+1)*O):D},v=()=>o[d]-1,b=(D=0)=>{let L={generation:h,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1,scan:v()};P.onmessage(
{type:"state",document:n,seq:D,...L,draws:u,view:m},{})},M=()=>{let{pose:D,angles:L,ranges:O,exact:G,hit:te}=e,X=L.length<O.length,$={pose:w(D),angles:w(L,X),ranges:w(
O),exact:w(G),hit:w(te)};P.onmessage({type:"scan",generation:h,ids:c?[o[d]]:o,index:c?v():null},$)},S=D=>{let L=a?Math.ceil(l/8):l,O=e.draws.slice(D*L,(D+1)*L);
return a?wt(O,l).map(G=>255*G):O},E=()=>{let{p:D,width:L,reached:O,trace:G,traced:te,weights:X}=e,$=Math.min(i-1,m.draw??i-1),ee=m.layer==="draw"&&!i||m.layer===
"width"&&!L?"mean":m.layer,U=ee==="draw"?{chain:m.chain,draw:$,log_joint:s[m.chain][$]}:{},A=ee==="draw"?S(m.chain*i+$):ee==="width"?L:D;P.onmessage({...t.field,
layer:ee,...U},{p:A,reached:O,trace:G,traced:te,...X&&{weights:X}})},P={...hn(),open:()=>P.onstatus({connected:!0}),send:D=>{if(D.type==="hello"){let L=[...i?[]:
["draw"],...e.width?[]:["width"]];P.onmessage({type:"welcome",version:1,limits:null,recorded:!0,figure:!1,lacks:L,story:null},{}),b(D.seq),M(),e.trajectory&&P.onmessage(
{type:"overlay",generation:h},{strokes:e.strokes,trajectory:e.trajectory}),E()}else if(D.type==="view")m={layer:D.layer,chain:D.chain??m.chain,draw:D.draw??null},
b(D.seq),E();else if(D.type==="scan"){let L=o.map(O=>Math.abs(O-1-D.index));d=L.indexOf(Math.min(...L)),b(D.seq),M()}else if(D.type==="inspect"){let{x:L,y:O}=D,
G=e.beams[L*n.grid.shape[1]+O];P.onmessage({type:"cell",x:L,y:O,each:!1,beams:G,beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,chain:null,
prior_nats:null,log_odds:null},{})}},close:()=>{}};return P}async function Pd(t,e){let n=new TextDecoder,o=t.stream().getReader(),[s,r]=["",0];for(let i=await o.read();!i.done;i=await o.read())s+=n.decode(i.value,{stream:!0}),
e((r+=i.value.length)/t.size);return s}async function _d(t,e,n,o){try{let s=await n(t,r=>e.say(r<1?`Reading ${t.name}: ${Math.round(100*r)} %`:`Reading ${t.name}\
: making its picture`));o(pn(s))}catch(s){e.say(`${t.name} cannot be shown: ${s.message}`,"error")}}async function za(t,e,n){let{name:o}=t;if(o.endsWith(".nc")&&
e.transport.read&&n)return _d(t,e,e.transport.read,n);if(!/\.(html|json)$/.test(o))return e.say(`${o} is not read in the page: start bayesmap app with it`,"warn\
ing");try{let s=await Pd(t,i=>e.say(`Reading ${o}: ${Math.round(100*i)} %`)),r=/data-recording>(.*?)<\/script>/s.exec(s)?.[1];r&&n?n(await ls(r)):o.endsWith(".j\
son")&&!e.recorded?e.bring(JSON.parse(s)):e.say(`${o} holds nothing that can be shown here`,"warning")}catch{e.say(`${o} cannot be read: export it again, whole`,
"error")}}var le=(t,e,n)=>Math.min(n,Math.max(e,t)),qt=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,Le=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Yr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function Tn(t,e){let{x:n,y:o}=Le(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var eo=(t,e)=>Yr({x:t.x+.5,y:t.y+.5},e);
function hs(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Ya(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&s(r-1,i)!==s(r,i);l&&a<0&&(a=i),!l&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&s(i,r-1)!==s(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var Io=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function qa(t,e,n){let o=Ja(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return qr(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Ka(t,e){
let n=Ld(e,t.grid.shape),o=Ja(t),s=(i,a,l)=>{if(e[l])return-1/0;let c=2*n[l];for(let h of o)c=Math.min(c,Math.hypot(i-h.x,a-h.y));return c>0?c:-1/0},r=Cd(e,t.grid.
shape,o);return qr(t,(i,a,l)=>r[l]?s(i,a,l):-1/0)??qr(t,s)}function Cd(t,[e,n],o){let s=new Uint8Array(e*n),r=(i,a)=>{for(let{x:l,y:c}of hs(i,a)){if(t[l*n+c])return;
s[l*n+c]=1}};for(let i of o){for(let a=0;a<e;a++)for(let l of[0,n-1])r(i,{x:a,y:l});for(let a=0;a<n;a++)for(let l of[0,e-1])r(i,{x:l,y:a})}return s}var Ja=({sensors:t,
grid:e})=>t.map(n=>Tn(n,e));function qr(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let l=e(i,a,i*o+a);l>r&&([s,r]=[{x:i,y:a},
l])}return s&&eo(s,t.grid)}function Ld(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<n;i++)o[r*
n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),s(r+1,i-
1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var ps=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return qt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(c=>Tn(c,r.grid)):[],l=new Map;for(let c of e)!qt(c,i)||this.isWall(c)===n||a.some(h=>h.x===
c.x&&h.y===c.y)||l.set(c.x*i[1]+c.y,[c.x,c.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?Ka(o,n.walls):"world"in e?e.world:qa(o,n.walls,e.near),r=n.limits?.sensors[1]??1/0;s?o.sensors.length>=r?n.say(`The\
re can be ${r} sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"add_sensor",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=
Math.max(0,...o.sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"\
remove_sensor",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=Tn(e,n.document.grid),s=this.isWall(o);return!s&&qt(o,n.shape)?(n.status.text.
startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Et=new Set(["pan","path","look","where","ghost","evidence"]),Nd=120,ds=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.decisions.showPath(e==="path"||e==="pan"||!Et.has(e)),this.session.ghost.hold(
e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&qt(e,this.session.
shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(
e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.
cursor&&this.announce(this.describe(e))},Nd))}};var tt={left:36,right:12,top:34,bottom:26},Dd=60,Rd=160,to=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-tt.left-tt.right,y:this.height-tt.
top-tt.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:tt.left+(o.x-
s*e)/2,y:tt.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,o){let{scale:s}=this.transform,{x:r,
y:i}=this.corner,a=le(s*e,Math.min(this.width,this.height)/Math.max(...o)/3,Rd),l=a/s;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.
x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=Dd;this.corner.
x=le(this.corner.x,s-e*o,this.width-s),this.corner.y=le(this.corner.y,s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var us=new Set(["path","look","evidence"]);function fs(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);if(e.tool==="evidence"&&t.document){let{x:h,y:u}=Le(
o,t.document.grid);return t.evidence.pin({x:Math.floor(h),y:Math.floor(u)})}let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,l]=r.
pose.subarray(3*s,3*s+3),c=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${c}`)}var el=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W","where am I","located"],["O, V","ghost, evidence of beams","as\
ked"],["arrows","move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["S\
pace","at the cursor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, De\
lete","add, remove a sensor","drawn"],["R, Escape","run, cancel","inferred"],["Escape","take a path off the map","asked"],["M, N, H","show the mean, a draw, the\
 entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","edited"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],$d={ArrowLeft:[-1,0],ArrowRight:[1,0],
ArrowUp:[0,1],ArrowDown:[0,-1]},Xa=Math.PI/12,ms=class{constructor(e,n,o,s,r){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;e.addEventListener(
"keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){
let{session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=$d[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?Xa:-Xa;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&
o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key===
"Backspace")&&n.editable)s.removeSensor();else if(e.key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.
editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&
o.ghost.pose&&o.document){let{resolution:l}=o.document.grid,{x:c,y:h}=o.ghost.pose;o.ghost.move({x:c+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&
r.sensor&&o.document&&o.editable){let{resolution:l}=o.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.
tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},c={x:le(l.x+e,0,i-1),y:le(l.y+n,0,a-1)};
r.setCursor(c);let h=s.fromGrid({x:c.x+.5,y:c.y+.5},a),u=(m,w,v)=>m-le(m,w,v),d={x:u(h.x,tt.left+10,s.width-20),y:u(h.y,20,s.height-tt.bottom-10)};(d.x||d.y)&&s.
pan(-d.x,-d.y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if(us.has(o.tool)&&n.document){o.cursor?fs(n,o,s,eo(o.cursor,n.document.grid)):this.arrow(0,
0);return}if(n.editable){if(o.tool==="sensor"||o.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,
r.length)]?.id??null),o.selected!==null&&o.announce(`Sensor ${o.selected}`)}else if(!Et.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&
!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.announce(i?"wall":"free")}}}},Oo={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",
v:"evidence"},Za={m:"mean",n:"draw",h:"entropy"},Qa={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function tl(t,e,n){let o=t.composedPath()[0],s=o instanceof
HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||
e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}if(!(s||t.altKey)){if(Oo[r]&&(Et.has(Oo[r])?e.answers||Oo[r]==="wher\
e"&&e.locates||Oo[r]==="pan"&&e.editable:e.editable))n.tool(Oo[r]);else if(Za[r])n.layer(r==="h"&&e.quantity.interval?"width":Za[r]);else if(Qa[t.key])n.command(
Qa[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&e.decisions.start&&e.decisions.pathShown)e.decisions.forgetPath();else if(t.
key==="Escape"&&(e.running||e.working))e.act({type:"cancel"});else return;t.preventDefault()}}var Uo=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:c,context:h,layer:u}=l,d=u.shows?.(e)??!0,m=[d,...d?[...a,...u.depends(e)]:[]];m.length===
l.before.length&&m.every((w,v)=>Object.is(w,l.before[v]))||(l.before=m,c.style.visibility=d?"":"hidden",d&&((c.width!==i.width||c.height!==i.height)&&(Object.assign(
c,i),c.style.width=`${i.width/s}px`,c.style.height=`${i.height/s}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,c.width,c.height),h.setTransform(s,0,0,s,0,0),
h.save(),u.paint(h,e),h.restore(),this.paints[u.name]++))}}};function Ue(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,o*r,s*r),t.clip()}function An(t,{halo:e},n,o){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}var gs='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Zt(t,e,n,o,s,r,i=!1){t.font=gs,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}var Kr=8,no=class{constructor(e,n,o,s){this.context=e;
this.theme=n;this.width=o;this.height=s}placed=[];place(e,n,o,s){this.context.font=gs;let r=this.context.measureText(e).width/2+2,i=Math.min(Math.max(n,r),this.
width-r),a=[[i,o-s-9],[i,o+s+9],[n+s+r+4,o],[n-s-r-4,o]],l=([u,d])=>u-r>=0&&u+r<=this.width&&d>=Kr&&d<=this.height-Kr,c=([u,d])=>this.placed.every(m=>Math.abs(u-
m.x)>=r+m.half||Math.abs(d-m.y)>=2*Kr),h=a.find(u=>l(u)&&c(u));return h&&this.placed.push({text:e,x:h[0],y:h[1],half:r}),!!h}write(){for(let{text:e,x:n,y:o}of this.
placed)Zt(this.context,e,n,o,this.theme,"center",!0)}};function Jr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function dn(t,e,n){let o=n.fromGrid(Le(t,e),e.shape[1]),s=le(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function nl(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=Jr(e);t.lineJoin=
"round";for(let a of i){let l=dn(a,s.grid,n),{point:c,size:h}=l;a.id===o.selected&&Fd(t,l,o);let[u,d]=[Math.cos(a.yaw),-Math.sin(a.yaw)],m=(w,v)=>[c.x+h*(w*u-v*
d),c.y+h*(w*d+v*u)];t.beginPath(),t.moveTo(...m(1.25,0)),t.lineTo(...m(-.9,.8)),t.lineTo(...m(-.45,0)),t.lineTo(...m(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Zt(t,String(a.id),c.x,c.y+h*2+4,r,"center",!0)}}function Fd(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),An(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function ol(t,e,n,o,s){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&dn({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function sl(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var rl={touch:24,other:11},Id=5,Od=90,ys=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(l,c)=>e.
addEventListener(l,c,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return Yr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(ol(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&us.has(o.tool))return this.
begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(i.id),this.begin(i);
if(e.button===1||Et.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="sensor"&&o.select(a.id);else if(o.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let l=o.tool==="draw"!==(e.button===2||e.shiftKey),c=this.cellAt(r),h=l&&this.editor.isWall(c);this.begin({kind:"strok\
e",id:o.nextGesture(),wall:l,last:c,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Od)}}gripAt(e,n,o){let{hand:s,view:r}=this,
i=this.reach(n),a=d=>Math.hypot(e.x-d.x,e.y-d.y),l=s.tool==="sensor"&&s.sensor?dn(s.sensor,o.grid,r):null;if(l&&s.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let c=o.sensors.map(d=>({id:d.id,...dn(d,o.grid,r)}));c.sort((d,m)=>a(
d.point)-a(m.point));let h=c.find(({point:d,size:m})=>a(d)<Math.max(i,m));if(!h)return null;let u={x:h.point.x-e.x,y:h.point.y-e.y};return{kind:"sensor",id:h.id,
drag:s.nextGesture(),grip:u}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let c of l.
length?l:[e]){let h=this.cellAt(this.at(c));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(...hs(n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(c=>c.id===n.id);if(!a||!o.document)return;let l=this.metres(i,o.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>Id&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.size===2){let{middle:a,spread:l}=this.spread();
s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(l/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:l}),o.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&fs(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?rl.touch:rl.other}pointAtReading(e){let{document:n,reading:o,ghost:s}=this.
session;if(!n||s.held)return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:o}=this;
if(n?.kind!=="ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);sl(o.ghost,n,this.metres({x:s.x+n.grip.x,y:s.y+n.grip.y},o.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level==="error"&&o.say("Ready"))}dragSensor(e){
let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(l=>l.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var Ud=5,ws=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(tt.left,0,o.width,o.height-tt.bottom),e.clip(),s.hover&&il(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&il(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function il(t,e,n,o,s,r,i){let{scale:a}=o.transform,l=o.fromGrid({x:e.x,y:e.y+1},n),c=Math.max(a,Ud),[h,u]=[l.x-(c-a)/2,l.y-(c-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(h,u,c,c),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,u,c,c)}var Bd={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Wd={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},vs={light:Bd,dark:Wd},al="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Gd([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((l,c)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*s[c]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let c=le(l,0,1);return Math.round(255*(c<=.0031308?12.92*c:1.055*c**(1/2.4)-.055))})}var bs=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),xs=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),Xr=(t,e)=>Gd(xs(t.paper,t.ink,e));function oo(t){let e=Math.min(15,Math.floor(
t*16));return xs(bs(al,6*e),bs(al,6*e+6),t*16-e)}function ll(t,e){let n=new Uint8ClampedArray(17408).fill(255),[o,s]=[bs(t.unobserved),bs(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?Io(r/255):r/255,a=e==="value"?Xr(t,r/255):oo(i),l=e==="value"?xs(o,s,r/255):a;for(let c=0;c<=16;c++)n.set(xs(l,a,c/16),4*(r+256*c))}
return new Uint32Array(n.buffer)}var Zr=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;function k(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function C(t,e,n){t[e]!==n&&(t[e]=n)}function nt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var En=t=>t.getRootNode().activeElement===t,fe=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function Qr(t,e){let n=URL.
createObjectURL(e);k("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Hd=9,Vd=2.5,so=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start&&e.pathShown||e.looking&&e.views))}paint(e,n){let{session:o}=n;if(!o.document)return;let s=new no(e,n.look.theme,n.view.width,n.view.height);
e.save(),Ue(e,n),o.decisions.looking&&this.views(e,n,s),o.decisions.pathShown&&this.path(e,n,s),e.restore(),s.write()}views(e,{session:n,view:o,look:s},r){let{views:i}=n.
decisions,a=n.document?.grid;if(!i?.nats.length||!a)return;let l=Math.max(...i.nats),c=le(.38*i.spacing*o.transform.scale/a.resolution,Vd,Hd),h=i.nats.indexOf(l);
for(let u=0;u<i.nats.length;u++){let d=o.fromGrid(Le({x:i.pose[3*u],y:i.pose[3*u+1]},a),a.shape[1]);e.beginPath(),e.arc(d.x,d.y,c,0,2*Math.PI),e.fillStyle=`rgb(${oo(
le(i.nats[u]/Math.max(l,1e-9),0,1)).map(Math.round)})`,e.fill(),u===h&&(e.lineWidth=2.5,e.strokeStyle=s.theme.truth,e.stroke(),r.place(`${fe(l,1)} nats`,d.x,d.y,
c))}}path(e,{session:n,view:o,look:s},r){let{start:i,goal:a,path:l,radius:c}=n.decisions,h=n.document?.grid;if(!h||!i)return;let u=d=>o.fromGrid(Le(d,h),h.shape[1]);
if(l){e.beginPath();for(let[d,m]of l.path){let w=u({x:d,y:m});e.lineTo(w.x,w.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=l.within_risk?s.theme.sensor:s.theme.
truth,e.globalAlpha=.3,e.lineWidth=2*c*o.transform.scale/h.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let d of a?[i,a]:[i]){let{x:m,y:w}=u(
d);e.beginPath(),e.arc(m,w,5,0,2*Math.PI),e.fillStyle=d===i?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}if(l){let d=l.
path.length,[[m,w],[v,b]]=[l.path[d-1>>1],l.path[d>>1]],M=u({x:(m+v)/2,y:(w+b)/2});r.place(`${fe(l.length_m,1)} m, free with probability ${fe(l.probability,3)}`,
M.x,M.y,4)}else a&&n.decisions.trouble&&r.place("no path",u(a).x,u(a).y,7)}};var jd=5,[zd,cl]=[.8,5],Yd=6,ks=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:o,view:s,look:r}=n,{cell:i,each:a}=o.evidence,l=o.document?.grid;if(!i||!l)return;
Ue(e,n);let c=(v,b)=>s.fromGrid(Le({x:v,y:b},l),l.shape[1]),h=v=>[c(a.start[2*v],a.start[2*v+1]),c(a.end[2*v],a.end[2*v+1])],u=a?.nats.length??0;e.lineCap="roun\
d";for(let v=u-1;v>=0;v--){let[b,M]=h(v),S=a.nats[v];e.beginPath(),e.moveTo(b.x,b.y),e.lineTo(M.x,M.y),e.globalAlpha=le(.25+Math.abs(S)/2,0,.9),e.lineWidth=le(cl*
Math.sqrt(Math.abs(S)/Yd),zd,cl),e.strokeStyle=S>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:d}=s.transform,m=s.fromGrid({x:i.x,y:i.y+1},l.
shape[1]),w=Math.max(1,4-d/2);e.beginPath(),e.rect(m.x-w,m.y-w,d+2*w,d+2*w),An(e,r.theme,r.theme.belief,2);for(let v=Math.min(jd,u)-1;v>=0;v--){let[b,M]=h(v),S=.35+
.1*v,E={x:b.x+S*(M.x-b.x),y:b.y+S*(M.y-b.y)};Zt(e,ro(a.nats[v]),E.x,E.y,r.theme,"center",!0)}}},ro=t=>`${t<0?"−":"+"}${Math.abs(t).toFixed(1)}`;var qd=10,Kd=7,Jd=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Ss=()=>document.createElement("canvas").getContext("2d"),io=class{name="\
field";cells=Ss();mask=Ss();hatch=Ss();palettes=new Map;image=new ImageData(1,1);drawn={field:null,reached:null,palette:"",hatch:""};depends({session:e}){return[
e.picture,e.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.
shape,{scale:l,x:c,y:h}=s.transform;Ue(e,n);let u=o.picture;if(!u||u.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(c,h,i*l,a*l);return}this.fill(u,i,
a,r.theme,Jd(u,o.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,c,h,i*l,a*l),this.fillHatch(n),e.drawImage(this.hatch.canvas,0,0,this.hatch.canvas.
width/s.ratio,this.hatch.canvas.height/s.ratio),l>=qd&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:l}=this,c=`${s.ground} ${r}`;if(l.field===e&&l.palette===
c)return;let h=this.palettes.get(c)??ll(s,r);if(this.palettes.set(c,h),this.image.width!==n||this.image.height!==o){this.image=new ImageData(n,o);for(let{canvas:d}of[
i,a])Object.assign(d,{width:n,height:o});l.reached=null}let u=new Uint32Array(this.image.data.buffer);for(let d=0,m=0;d<o;d++)for(let w=o-1-d;w<n*o;w+=o)u[m++]=
h[e.p[w]+256*(e.reached[w]+8>>4)];if(i.putImageData(this.image,0,0),l.reached!==e.reached){for(let d=0,m=0;d<o;d++)for(let w=o-1-d;w<n*o;w+=o)u[m++]=255-e.reached[w]<<
24;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,reached:e.reached,palette:c})}fillHatch({session:e,view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,
{ratio:a,width:l,height:c}=n,{scale:h,x:u,y:d}=n.transform,[m,w]=e.shape,v=[o.theme.ground,h,u,d,l,c,a].join(" ");if(i.hatch===v)return;i.hatch=v;let b=Ss(),M=b.
canvas.width=b.canvas.height=Math.round(Kd*a);b.strokeStyle=o.theme.hatch,b.lineWidth=a,b.beginPath();for(let E of[-M,0,M])b.moveTo(E-1,M+1),b.lineTo(E+M+1,-1);
b.stroke(),Object.assign(s.canvas,{width:Math.ceil(l*a),height:Math.ceil(c*a)}),s.setTransform(a,0,0,a,0,0),s.imageSmoothingEnabled=!1,s.drawImage(r.canvas,u,d,
m*h,w*h),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let S=s.createPattern(b.canvas,"repeat");S.setTransform(new DOMMatrix().translate(Math.
round(u*a),Math.round(d*a))),s.fillStyle=S,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,view:o,look:s}){let[r,i]=n.shape,{scale:a,x:l,y:c}=o.
transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,c),e.lineTo(l+h*a,c+i*a);for(let h=1;h<i;h++)e.moveTo(l,c+h*a),e.lineTo(l+r*a,c+h*a);e.strokeStyle=s.
theme.lines,e.lineWidth=1,e.stroke()}};var Xd=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],ao=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(Ue(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(l,c)=>{let h=le(r[c],0,a),u=o.yaw+l,d={x:o.x+h*Math.cos(u),y:o.y+h*Math.sin(u)};return n.fromGrid(Le(d,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(w=>this.ends(n,o,o.angles,w)),{grid:l}=n.session.document,c=n.view.fromGrid(Le(o,l),l.shape[1]),h=new Path2D;
h.moveTo(c.x,c.y);for(let{x:w,y:v}of r)h.lineTo(w,v);h.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(h);let u=new Path2D,d=new Path2D,m=le(n.view.transform.
scale*.12,1.2,3);for(let w=0;w<r.length;w++)u.moveTo(r[w].x,r[w].y),u.lineTo(a[w].x,a[w].y),Number.isFinite(o.median[w])&&d.rect(i[w].x-m,i[w].y-m,2*m,2*m);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=le(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(u),e.globalAlpha=1,d}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,l=le(n.view.transform.scale*.14,1.5,4),c=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),h=new Path2D;c.forEach(({x:u,y:d},m)=>{i[m]&&
(h.moveTo(u+l,d),h.arc(u,d,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:l,handle:c}=dn({id:0,...r},i,o),[h,u]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(c.x,c.y),An(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[d,m]of Xd)e.lineTo(a.x+l*(d*h-m*u),a.y+l*(d*u+m*h));e.closePath(),e.lineJoin="round",An(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(c.x,c.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var ei=({flicker:t,shown:e,where:n})=>t.under&&!n.map?e:null,lo=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,
colour:""};depends({session:e}){return[ei(e)]}shows({session:e}){return ei(e)!==null}paint(e,n){let{session:o,view:s,look:r}=n,i=ei(o);if(!i)return;let[a,l]=o.shape,
{scale:c,x:h,y:u}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Ue(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,u,a*c,l*c)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(c=>parseInt(s.slice(c,c+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let l=new ImageData(
n,o);for(let c=0,h=0;c<o;c++)for(let u=o-1-c;u<n*o;u+=o,h+=4)l.data.set([r,i,a,Math.round(e.p[u]*e.reached[u]/255)],h);this.cells.putImageData(l,0,0),this.drawn=
{field:e,colour:s}}};var Zd=46,Qd=22;function eu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function hl(t,{session:e,view:n,look:o}){if(!e.document)
return;let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:l,shape:c}=e.document.grid,{scale:h,x:u,y:d}=n.transform,m=eu(Zd/h*l),w=Math.min(d+c[1]*h,i-tt.bottom)+
.5,v=Math.max(u,tt.left)-.5;t.fillStyle=s.ground,u<v&&t.fillRect(0,0,v,i+1),d+c[1]*h>w&&t.fillRect(0,w,r+1,i+1-w);let b=Math.max(0,-Math.floor(Math.log10(m)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let M=E=>Math.ceil(a[E]/m-1e-9)*m,S=E=>a[E]+c[E]*l+1e-9;for(let E=M(0);E<=S(0);E+=m){let P=u+(E-a[0])/l*h;P<v||
P>r-4||(t.moveTo(P,w),t.lineTo(P,w+4),Zt(t,E.toFixed(b),P,w+12,s,"center"))}for(let E=M(1);E<=S(1);E+=m){let P=d+(c[1]-(E-a[1])/l)*h;P>w||P<4||(t.moveTo(v,P),t.
lineTo(v-4,P),Zt(t,E.toFixed(b),v-7,P,s,"right"))}t.stroke(),Zt(t,"m",v-Qd,w+12,s,"right")}var co=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=Jr(e).flatMap(({id:i,x:a,y:l,yaw:c})=>[i,a,l,c]),{grid:s}=e.document??{},
r=pl(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:c,y:h}=s.transform;r.truth&&pl(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(c-.5,h-.5,i*l+1,a*l+1),nl(e,n),hl(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:l}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=Ya(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),Ue(e,n),e.transform(i,0,0,-i,a,l+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=le(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},pl=({document:t})=>t?.source.kind==="simulation";var tu=600,nu=1500,ou=65536,ti=.3,ho=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;
if(!i||!a)return;Ue(e,n);let{scale:l}=s.transform,c=1/a.grid.resolution,h=a.grid.shape[1],u=i.angles.length,d=i.pose.length/3,m=Math.ceil(u*d/nu),[w,v,b]=[new Path2D,
new Path2D,new Path2D],M=u*d>tu,S=new Map,E=le(l*.1,1.3,4),P=a.scans_used??1/0,D=(i.index??0)<P?1:ti;for(let L=0;L<d;L++){let[O,G,te]=i.pose.subarray(3*L,3*L+3),
X=s.fromGrid(Le({x:O,y:G},a.grid),h);for(let $=0;$<u;$++){let ee=i.ranges[L*u+$],U=i.hit[L*u+$]===1,A=(U?ee:a.max_range)*c*l,_=i.angles[$]+te,B={x:X.x+A*Math.cos(
_),y:X.y-A*Math.sin(_)},I=U?w:v;(L*u+$)%m===0&&(I.moveTo(X.x,X.y),I.lineTo(B.x,B.y)),U&&(M?S.set(Math.round(B.x)*ou+Math.round(B.y),B):(b.moveTo(B.x+E,B.y),b.arc(
B.x,B.y,E,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=D*le(28/Math.sqrt(u*d/m)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(w),e.strokeStyle=r.theme.
noReturn,e.stroke(v),e.globalAlpha=1),r.readings){e.globalAlpha=D,e.fillStyle=r.theme.ray,e.fill(b);let L=1.8*E;for(let{x:O,y:G}of S.values())e.fillRect(O-L/2,G-
L/2,L,L);e.globalAlpha=1}}};var su=2.5,Bo=t=>t>=su,po=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(Ue(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&Bo(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[c,h,u]of[[0,l,.6],
[Math.max(0,l-1),a,.6*ti]]){e.beginPath();for(let d=c;d<h;d++){let m=o.fromGrid(Le({x:r[2*d],y:r[2*d+1]},i),i.shape[1]);e.lineTo(m.x,m.y)}e.globalAlpha=u,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,c,h,u]=r.subarray(a,a+4),[d,
m]=[o.fromGrid(Le({x:l,y:c},i),i.shape[1]),o.fromGrid(Le({x:h,y:u},i),i.shape[1])];e.moveTo(d.x,d.y),e.lineTo(m.x,m.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=le(o.transform.scale/5,.8,2.5),e.stroke()}}};var ru=2.2,Ms=7,[iu,au]=[.03,.75],lu=2.4477,dl=9,uo=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!s||!r)return;let i=new no(
e,n.look.theme,n.view.width,n.view.height);e.save(),Ue(e,n),this.cloud(e,n,r);for(let a of s.modes)this.place(e,n,r,a,i);e.restore(),i.write()}cloud(e,{session:n,
view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||1;e.strokeStyle=e.fillStyle=s.theme.belief,e.lineWidth=1.2;for(let c=0;c<a.length;c++){if(a[c]<
iu**2*l)continue;let[h,u,d]=i.subarray(3*c,3*c+3),m=o.fromGrid(Le({x:h,y:u},r),r.shape[1]);e.globalAlpha=au*Math.sqrt(a[c]/l),e.beginPath(),e.arc(m.x,m.y,ru,0,2*
Math.PI),e.fill(),e.beginPath(),e.moveTo(m.x,m.y),e.lineTo(m.x+Ms*Math.cos(d),m.y-Ms*Math.sin(d)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:o},s,r,i){let[
a,l,c]=r.mean,h=n.fromGrid(Le({x:a,y:l},s),s.shape[1]),u=lu*n.transform.scale/s.resolution,[[d,m],[,w]]=r.covariance,[v,b]=[(d+w)/2,Math.hypot((d-w)/2,m)],[M,S]=[
v+b,v-b].map(P=>Math.max(dl,u*Math.sqrt(Math.max(P,0))));e.beginPath(),e.ellipse(h.x,h.y,M,S,-Math.atan2(2*m,d-w)/2,0,2*Math.PI);let E=dl+1;e.moveTo(h.x+E*Math.
cos(c),h.y-E*Math.sin(c)),e.lineTo(h.x+(E+Ms)*Math.cos(c),h.y-(E+Ms)*Math.sin(c)),e.strokeStyle=o.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,
e.lineWidth=2,e.stroke(),i.place(ni(r.probability),h.x,h.y,S)}},ni=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var ul=900,Wo=2,oi=()=>[new io,new lo,new po,new ho,new co,new so,new uo,new ao];function fl({session:t,look:e}){let[n,o]=t.shape,s=new to;s.resize(ul,Math.round(
le(ul*o/n,300,1800)),Wo),s.fit(t.shape);let r=document.createElement("canvas");Object.assign(r,{width:s.width*Wo,height:s.height*Wo});let i=r.getContext("2d");i.
scale(Wo,Wo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);let a={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let l of oi())
(l.shows?.(a)??!0)&&(i.save(),l.paint(i,a),i.restore());return new Promise(l=>r.toBlob(l))}var Ts=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:l,document:c}=o;if(!i||!c||l?.index!==
i.scan)return;Ue(e,n);let{grid:h,max_range:u}=c,d=b=>{let M={x:i.from.x+b*Math.cos(i.angle),y:i.from.y+b*Math.sin(i.angle)};return s.fromGrid(Le(M,h),h.shape[1])},
m=(b,M,S,E)=>{e.beginPath(),e.moveTo(b.x,b.y),e.lineTo(M.x,M.y),e.lineWidth=S,e.strokeStyle=E,e.stroke()},w=l.hit[i.beam]===1,v=d(w?l.ranges[i.beam]:u);if(m(d(0),
v,3,r.theme.halo),m(d(0),v,1.5,w?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let b=(M,S)=>le(M??S,0,u);if(m(d(b(a.low,0)),d(b(a.high,u)),6,r.theme.ghost),
a.median!==null){let M=d(a.median),S={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};m({x:M.x-S.x,y:M.y-S.y},{x:M.x+S.x,y:M.y+S.y},2.5,r.theme.ghost)}}w&&(e.beginPath(),
e.arc(v.x,v.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};var ml="bayesmap-token",si="bayesmap-kept",gl="bayesmap-tools";function yl(t){try{return localStorage.getItem(t)}catch{return null}}function As(t,e){try{e===null?
localStorage.removeItem(t):localStorage.setItem(t,e)}catch{}}function ri(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&As(si,JSON.stringify(
t))}function wl(){As(si,null)}function bl(){let t=yl(si);try{return t&&JSON.parse(t)}catch{return null}}var xl=()=>yl(gl)!==null,vl=t=>As(gl,t?"all":null);function kl(t){
t&&As(ml,t)}function Sl(t){let e=n=>{n.key===ml&&n.newValue&&t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",
e)}var ii=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["where","Where am I?","where"],["path","Path","path"],
["evidence","Evidence","evidence"],["look","Look next","look"],["ghost","Ghost","ghost"]],cu=5;function Ml(t){let{hand:e,session:n}=t,o=t.segmented("Tool",ii,()=>n.
editable||!n.document||Et.has(e.tool)?e.tool:"pan",i=>e.choose(i),i=>(Et.has(i)?n.answers||i==="where"&&n.locates:n.editable)||i==="pan");t.visible(o,()=>!n.recorded);
let s=xl(),r=t.button(null,"More tools",()=>{vl(s=!s),n.changed()},{text:"More"});return t.visible(r,()=>n.answers),t.each(()=>{let i=ii.filter(([l])=>Et.has(l)?
!n.figure||l==="pan"||l==="where":!n.document||n.editable).map(([l])=>l),a=new Set(s?i:i.slice(0,cu));ii.forEach(([l],c)=>C(o.children[c],"hidden",!a.has(l)&&!(l===
e.tool&&i.includes(l)))),C(r.lastElementChild,"textContent",s?"Fewer":"More"),nt(r,"aria-label",s?"Fewer tools":"More tools"),C(r,"title",s?"Fewer tools":"More \
tools: paths, evidence, where to look next, the ghost")}),k("div",{className:"bar"},o,r,k("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command(
"out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Wh\
ole map (0)"}))}var Qt=t=>t.charAt(0).toUpperCase()+t.slice(1),Es=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=Qt(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var hu=20,pu={importance:"particles",propagate:"rounds"},ai=t=>`burn-in of ${t} left out`,Ps=({working:t,shown:e})=>t&&e?.method==="pilot";function Tl(t,...e){let{
session:n}=t,o=k("progress",{max:1,value:0,"aria-label":"Progress"}),s=k("div",{className:"doing"});t.each(()=>{let i=n.shown,{stage:a}=n,l=i?.generation!==n.generation&&
(n.running||n.document?.source.kind==="log"),c=Ps(n),h=a?a.done/a.total:i&&!l&&i.total>0&&(c||!i.approximate)?i.sweeps/i.total:0;C(o,"value",h);let u=n.remaining_s(),
d=pu[i?.method??""]??"sweeps",m=i&&!i.approximate&&i.total?`${i.sweeps} of ${i.total} ${d}`:"",w=u!==null?u<1?"less than 1 s left":`${Math.ceil(u)} s left`:n.running?
"running":"",v=m&&i?.burned?ai(i.burned):"",b=n.sampling||n.running||!i||i.sweeps>=i.total?"":"stopped";a?C(s,"textContent",`${a.text}: ${a.done} of ${a.total} ${a.
total>hu?"scans":"rounds"}`):l?C(s,"textContent","Computing"):i&&c?C(s,"textContent",`Fitting the sensor: sweep ${i.sweeps} of ${i.total}`):C(s,"textContent",Qt(
[m,v,w,m&&b].filter(Boolean).join(", "))||du(n))});let r=k("p",{className:"caption",textContent:"This is the posterior of walls that are not known. The map show\
s the drawn walls, which Where am I? takes as known."});return t.visible(r,()=>n.where.map!==null),t.section("Posterior",r,uu(t),o,s,...fu(t),gu(t),...e,mu(t))}
function du({shown:t,working:e,document:n,nothingToRun:o}){let s=n?.method==="importance"?"; Run weighs particles":o&&"; it is done, and Run has nothing to add";
return t?.method==="propagate"?`${t.sweeps} rounds of belief propagation${s}`:t?.method==="hits"?"Counts of hits and passes":t?.method==="counts"?"Run infers wh\
ere the robot was":t?.method==="pilot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function uu(t){let{session:e}=t,n=t.button("play","Run",
()=>e.act({type:"run"}),{className:"primary",text:"Run",title:"Run (R): more sweeps of the chains on show",when:()=>e.connection.connected&&!e.nothingToRun,why:()=>e.
nothingToRun||"Not while the connection is lost"}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||
e.sampling||Ps(e),why:"Nothing is running"}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chains, and Run\
 goes on from their draws"),r=k("div",{className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function fu(t){let{session:e}=t,
n=k("dl"),o=k("dl",{className:"about"}),s=(i,a,l,c=!1)=>{let h=k("dd",{textContent:"–"}),u=k("div",{title:a},k("dt",{textContent:i}),h);return n.append(u),c&&
t.named.push({name:()=>i,place:u,control:u}),o.append(k("dt",{textContent:i}),k("dd",{textContent:a})),t.each(()=>{C(h,"textContent",e.shown?l(e.shown):"–"),c&&
C(h,"className",e.shown?.verdict?.level??"")}),u};s("ESS","Effective sample size of the log joint: so many independent draws would tell as much of its mean",i=>fe(
i.ess,0),!0),s("R-hat","Agreement of the chains on the log joint: 1 where they agree, more where each still tells of its start",i=>fe(i.rhat,3),!0),s("log joint",
"Log of prior times likelihood at the last sweep",i=>fe(i.log_joint,Math.abs(i.log_joint??0)<1e5?1:0)),s("time","Time spent on sweeps, rounds or particles",i=>fe(
i.seconds,1," s"));let r=s("reply","From the hand's last move to its picture",()=>fe(e.latency.eventToPaint_ms.at(-1),0," ms"));return t.visible(r,()=>!e.recorded),
[n,k("details",{},k("summary",{textContent:"What these figures mean"}),o)]}var Go=({shown:t})=>t?.method==="importance"?{good:"Enough particles",fair:"Few parti\
cles",bad:"Collapsed"}:{good:"Converged",fair:"Nearly converged",bad:"Not converged"};function mu(t){let{session:e}=t,n=k("dl",{className:"about"}),o=k("details",
{},k("summary",{textContent:"Model and method of this picture"}),n),s="";return t.each(()=>{let r=e.shown?.about??[];C(o,"hidden",!r.length),String(r)!==s&&(s=String(
r),n.replaceChildren(...r.flatMap(([i,a])=>[k("dt",{textContent:i}),k("dd",{textContent:a})])))}),o}function gu(t){let{session:e}=t,n=k("span"),o=t.button(null,
"Show the cell",()=>t.command(`cell ${e.shown?.verdict?.cell}`),{text:"Show the cell"});t.visible(o,()=>!!e.shown?.verdict?.cell);let s=k("div",{className:"verd\
ict"},n,o);return t.each(()=>{let r=e.shown?.verdict;if(!r)return C(s,"hidden",s.hidden||!e.working),C(n,"textContent","Too early to judge."),C(s,"className","v\
erdict early");C(s,"hidden",!1),C(n,"textContent",`${Go(e)[r.level]}: ${r.why}`),C(s,"className",`verdict ${r.level}`)}),s}function El(t,e){let{session:n}=t,s=t.checkbox("Keep this result beside the next",()=>e.kept!==null,r=>r?e.keep():e.forget(),"Change the method, the order, the \
prior or the map, and compare: both results follow the layer and the draw");return t.visible(s,()=>n.locates&&(e.kept!==null||n.shown!==null)),s}function Pl(t,e){
let[n,o]=[k("p",{className:"told-apart"}),k("p",{className:"told-apart"})];return t.visible(n,()=>e.kept!==null),t.each(()=>{if(!e.kept)return;let[s,r]=e.differences();
C(n,"textContent",`Now: ${s}. ${Al(t.session)}`),C(o,"textContent",`Kept: ${r}. ${Al(e.kept)}`)}),{now:n,kept:o}}function Al(t){let{shown:e,draws:n}=t;if(!e)return"";
let o=e.layer==="draw"?[`Draw ${t.draw+1} of ${n.count}, log joint ${fe(e.log_joint,1)}`]:[],s=e.verdict?[Go(t)[e.verdict.level]]:[],r=e.rhat===null?[]:[`R-hat ${fe(
e.rhat,3)}, ESS ${fe(e.ess,0)}`];return[...o,...s,...r].map(i=>`${i}.`).join(" ")}var yu="uplot",wu="u-hz",bu="u-vt",xu="u-title",vu="u-wrap",ku="u-under",Su="u-over",Mu="u-axis",Cn="u-off",Tu="u-select",Au="u-cursor-x",Eu="u-cursor-y",Pu="u-\
cursor-pt",_u="u-legend",Cu="u-live",Lu="u-inline",Nu="u-series",Du="u-marker",_l="u-label",Ru="u-value",Vo="width",jo="height";var Cl="bottom",fo="left",li="right",Ti="#000",Ll=Ti+"0",ci="mousemove",Nl="mousedown",hi="mouseup",Dl="mouseenter",Rl="mouseleave",$l="dblclick",$u="resize",Fu="\
scroll",Fl="change",Ds="dppxchange",Ai="--",vo=typeof window<"u",mi=vo?document:null,go=vo?window:null,Iu=vo?navigator:null,be,_s;function gi(){let t=devicePixelRatio;
be!=t&&(be=t,_s&&wi(Fl,_s,gi),_s=matchMedia(`(min-resolution: ${be-.001}dppx) and (max-resolution: ${be+.001}dppx)`),Ln(Fl,_s,gi),go.dispatchEvent(new CustomEvent(
Ds)))}function bt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function yi(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function _e(t,e,n){
t.style[e]=n+"px"}function It(t,e,n,o){let s=mi.createElement(t);return e!=null&&bt(s,e),n?.insertBefore(s,o),s}function Pt(t,e){return It("div",t,e)}var Il=new WeakMap;
function Kt(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=Il.get(t);r!=i&&(t.style.transform=r,Il.set(t,r),e<0||n<0||e>o||n>s?bt(t,Cn):yi(t,Cn))}var Ol=new WeakMap;
function Ul(t,e,n){let o=e+n,s=Ol.get(t);o!=s&&(Ol.set(t,o),t.style.background=e,t.style.borderColor=n)}var Bl=new WeakMap;function Wl(t,e,n,o){let s=e+""+n,r=Bl.
get(t);s!=r&&(Bl.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Ei={passive:!0},Ou={...Ei,
capture:!0};function Ln(t,e,n,o){e.addEventListener(t,n,o?Ou:Ei)}function wi(t,e,n,o){e.removeEventListener(t,n,Ei)}vo&&gi();function Ot(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:xt((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function mc(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var gc=t=>t!=null,yc=t=>t!=null&&t>0,Fs=mc(gc),Uu=mc(yc);function Bu(t,e,n,o=0,s=!1){
let r=s?Uu:Fs,i=s?yc:gc;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(o==1)a=t[e],l=t[n];else if(o==-1)a=t[n],l=t[e];else for(let c=e;c<=n;c++){let h=t[c];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??Me,l??-Me]}function Is(t,e,n,o){let s=Vl(t),r=Vl(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?en:wc,a=s==1?xt:_t,l=r==1?_t:xt,
c=a(i(He(t))),h=l(i(He(e))),u=yo(n,c),d=yo(n,h);return n==10&&(c<0&&(u=Te(u,-c)),h<0&&(d=Te(d,-h))),o||n==2?(t=u*s,e=d*r):(t=kc(t,u),e=Os(e,d)),[t,e]}function Pi(t,e,n,o){
let s=Is(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var _i=.1,Gl={mode:3,pad:_i},Yo={pad:0,soft:null,mode:0},Wu={min:Yo,max:Yo};function Rs(t,e,n,o){return Us(
n)?Hl(t,e,n):(Yo.pad=n,Yo.soft=o?0:null,Yo.mode=o?3:0,Hl(t,e,Wu))}function ye(t,e){return t??e}function Gu(t,e,n){for(e=ye(e,0),n=ye(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Hl(t,e,n){let o=n.min,s=n.max,r=ye(o.pad,0),i=ye(s.pad,0),a=ye(o.hard,-Me),l=ye(s.hard,Me),c=ye(o.soft,Me),h=ye(s.soft,-Me),
u=ye(o.mode,0),d=ye(s.mode,0),m=e-t,w=en(m),v=pt(He(t),He(e)),b=en(v),M=He(b-w);(m<1e-24||M>10)&&(m=0,(t==0||e==0)&&(m=1e-24,u==2&&c!=Me&&(r=0),d==2&&h!=-Me&&(i=
0)));let S=m||v||1e3,E=en(S),P=yo(10,xt(E)),D=S*(m==0?t==0?.1:1:r),L=Te(kc(t-D,P/10),24),O=t>=c&&(u==1||u==3&&L<=c||u==2&&L>=c)?c:Me,G=pt(a,L<O&&t>=O?O:Ut(O,L)),
te=S*(m==0?e==0?.1:1:i),X=Te(Os(e+te,P/10),24),$=e<=h&&(d==1||d==3&&X>=h||d==2&&X<=h)?h:-Me,ee=Ut(l,X>$&&e<=$?$:pt($,X));return G==ee&&G==0&&(ee=100),[G,ee]}var Hu=new Intl.
NumberFormat(vo?Iu.language:"en-US"),Ci=t=>Hu.format(t),vt=Math,Ns=vt.PI,He=vt.abs,xt=vt.floor,Ge=vt.round,_t=vt.ceil,Ut=vt.min,pt=vt.max,yo=vt.pow,Vl=vt.sign,en=vt.
log10,wc=vt.log2,Vu=(t,e=1)=>vt.sinh(t)*e,pi=(t,e=1)=>vt.asinh(t/e),Me=1/0;function jl(t){return(en((t^t>>31)-(t>>31))|0)+1}function bi(t,e,n){return Ut(pt(t,e),
n)}function bc(t){return typeof t=="function"}function pe(t){return bc(t)?t:()=>t}var ju=()=>{},xc=t=>t,vc=(t,e)=>e,zu=t=>null,zl=t=>!0,Yl=(t,e)=>t==e,Yu=/\.\d*?(?=9{6,}|0{6,})/gm,
Nn=t=>{if(Mc(t)||fn.has(t))return t;let e=`${t}`,n=e.match(Yu);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Nn(
s)}e${r}`}return Te(t,o)};function Pn(t,e){return Nn(Te(Nn(t/e))*e)}function Os(t,e){return Nn(_t(Nn(t/e))*e)}function kc(t,e){return Nn(xt(Nn(t/e))*e)}function Te(t,e=0){
if(Mc(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Ge(o)/n}var fn=new Map;function Sc(t){return((""+t).split(".")[1]||"").length}function Ko(t,e,n,o){
let s=[],r=o.map(Sc);for(let i=e;i<n;i++){let a=He(i),l=Te(yo(t,i),a);for(let c=0;c<o.length;c++){let h=t==10?+`${o[c]}e${i}`:o[c]*l,u=(i>=0?0:a)+(i>=r[c]?0:r[c]),
d=t==10?h:Te(h,u);s.push(d),fn.set(d,u)}}return s}var qo={},Li=[],wo=[null,null],un=Array.isArray,Mc=Number.isInteger,qu=t=>t===void 0;function ql(t){return typeof t==
"string"}function Us(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function Ku(t){return t!=null&&typeof t=="object"}var Ju=Object.getPrototypeOf(
Uint8Array),Tc="__proto__";function bo(t,e=Us){let n;if(un(t)){let o=t.find(s=>s!=null);if(un(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=bo(t[s],
e)}else n=t.slice()}else if(t instanceof Ju)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Tc&&(n[o]=bo(t[o],e))}else n=t;return n}function Be(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=Tc&&(Us(t[s])?Be(t[s],bo(o[s])):t[s]=bo(o[s]))}return t}var Xu=0,Zu=1,Qu=2;function ef(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function tf(t,e){if(sf(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return rf(i[0])||(i=of(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],c=l.length;for(let h=0;h<
c;h++)n.add(l[h])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),d=e?e[i][c]:Zu,m=[];for(let w=0;w<h.length;w++){let v=h[w],b=r.get(l[w]);v===null?d!=Xu&&(u[b]=v,
d==Qu&&m.push(b)):u[b]=v}ef(u,m,s),o.push(u)}}return o}var nf=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function of(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[o[l]];s.push(a)}return s}function sf(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function rf(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=pt(1,xt((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var Ac=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Ec=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Pc(t){
return t.slice(0,3)}var af=Ec.map(Pc),lf=Ac.map(Pc),cf={MMMM:Ac,MMM:lf,WWWW:Ec,WWW:af};function Ho(t){return(t<10?"0":"")+t}function hf(t){return(t<10?"00":t<100?
"0":"")+t}var pf={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>Ho(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>Ho(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>Ho(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>Ho(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>Ho(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>hf(t.getMilliseconds())};function Ni(t,e){e=e||cf;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?pf[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var df=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function uf(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==df?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var _c=t=>t%1==0,$s=[1,2,2.5,5],ff=Ko(10,-32,0,$s),Cc=Ko(10,0,32,$s),mf=Cc.filter(
_c),_n=ff.concat(Cc),Di=`
`,Lc="{YYYY}",Kl=Di+Lc,Nc="{M}/{D}",zo=Di+Nc,Cs=zo+"/{YY}",Dc="{aa}",gf="{h}:{mm}",mo=gf+Dc,Jl=Di+mo,Xl=":{ss}",xe=null;function Rc(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,l=(t==1?Ko(10,0,3,$s).filter(_c):Ko(10,-3,0,$s)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),c=[[i,Lc,xe,xe,xe,xe,xe,xe,1],[s*28,"{MMM}",Kl,xe,xe,xe,xe,xe,1],[s,Nc,Kl,xe,
xe,xe,xe,xe,1],[o,"{h}"+Dc,Cs,xe,zo,xe,xe,xe,1],[n,mo,Cs,xe,zo,xe,xe,xe,1],[e,Xl,Cs+" "+mo,xe,zo+" "+mo,xe,Jl,xe,1],[t,Xl+".{fff}",Cs+" "+mo,xe,zo+" "+mo,xe,Jl,
xe,1]];function h(u){return(d,m,w,v,b,M)=>{let S=[],E=b>=i,P=b>=r&&b<i,D=u(w),L=Te(D*t,3),O=di(D.getFullYear(),E?0:D.getMonth(),P||E?1:D.getDate()),G=Te(O*t,3);
if(P||E){let te=P?b/r:0,X=E?b/i:0,$=L==G?L:Te(di(O.getFullYear()+X,O.getMonth()+te,1)*t,3),ee=new Date(Ge($/t)),U=ee.getFullYear(),A=ee.getMonth();for(let _=0;$<=
v;_++){let B=di(U+X*_,A+te*_,1),I=B-u(Te(B*t,3));$=Te((+B+I)*t,3),$<=v&&S.push($)}}else{let te=b>=s?s:b,X=xt(w)-xt(L),$=G+X+Os(L-G,te);S.push($);let ee=u($),U=ee.
getHours()+ee.getMinutes()/n+ee.getSeconds()/o,A=b/o,_=d.axes[m]._space,B=M/_;for(;$=Te($+b,t==1?0:3),!($>v);)if(A>1){let I=xt(Te(U+A,6))%24,J=u($).getHours()-I;
J>1&&(J=-1),$-=J*o,U=(U+A)%24;let Q=S[S.length-1];Te(($-Q)/b,3)*B>=.7&&S.push($)}else S.push($)}return S}}return[l,c,h]}var[yf,wf,bf]=Rc(1),[xf,vf,kf]=Rc(.001);
Ko(2,-53,53,[1]);function Zl(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function Ql(t,e){return(n,o,s,r,i)=>{let a=e.find(
w=>i>=w[0])||e[e.length-1],l,c,h,u,d,m;return o.map(w=>{let v=t(w),b=v.getFullYear(),M=v.getMonth(),S=v.getDate(),E=v.getHours(),P=v.getMinutes(),D=v.getSeconds(),
L=b!=l&&a[2]||M!=c&&a[3]||S!=h&&a[4]||E!=u&&a[5]||P!=d&&a[6]||D!=m&&a[7]||a[1];return l=b,c=M,h=S,u=E,d=P,m=D,L(v)})}}function Sf(t,e){let n=Ni(e);return(o,s,r,i,a)=>s.
map(l=>n(t(l)))}function di(t,e,n){return new Date(t,e,n)}function ec(t,e){return e(t)}var Mf="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function tc(t,e){return(n,o,s,r)=>r==
null?Ai:e(t(o))}function Tf(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Af(t,e){return t.series[e].fill(
t,e)}var Ef={show:!0,live:!0,isolate:!1,mount:ju,markers:{show:!0,width:2,stroke:Tf,fill:Af,dash:"solid"},idx:null,idxs:null,values:[]};function Pf(t,e){let n=t.
cursor.points,o=Pt(),s=n.size(t,e);_e(o,Vo,s),_e(o,jo,s);let r=s/-2;_e(o,"marginLeft",r),_e(o,"marginTop",r);let i=n.width(t,e,s);return i&&_e(o,"borderWidth",i),
o}function _f(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Cf(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Lf(t,e){return t.
series[e].points.size}var ui=[0,0];function Nf(t,e,n){return ui[0]=e,ui[1]=n,ui}function Ls(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function fi(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var Df={show:!0,x:!0,y:!0,lock:!1,move:Nf,points:{one:!1,show:Pf,size:Lf,width:0,stroke:Cf,fill:_f},bind:{mousedown:Ls,mouseup:Ls,
click:Ls,dblclick:Ls,mousemove:fi,mouseleave:fi,mouseenter:fi},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},$c={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Ri=Be({},$c,{filter:vc}),Fc=Be({},Ri,{size:10}),Ic=Be({},$c,{show:!1}),$i='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Oc="bold "+$i,Uc=1.5,nc={
show:!0,scale:"x",stroke:Ti,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Oc,side:2,grid:Ri,ticks:Fc,border:Ic,font:$i,lineGap:Uc,rotate:0},
Rf="Value",$f="Time",oc={show:!0,scale:"x",auto:!1,sorted:1,min:Me,max:-Me,idxs:[]};function Ff(t,e,n,o,s){return e.map(r=>r==null?"":Ci(r))}function If(t,e,n,o,s,r,i){
let a=[],l=fn.get(s)||0;n=i?n:Te(Os(n,s),l);for(let c=n;c<=o;c=Te(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function xi(t,e,n,o,s,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,c=l==10?en:wc,h=xt(c(n));s=yo(l,h),l==10&&(s=_n[Ot(s,_n)]);let u=n,d=s*l;l==10&&(d=_n[Ot(d,_n)]);do a.push(u),u=u+s,l==10&&!fn.has(u)&&(u=Te(u,fn.get(
s))),u>=d&&(s=u,d=s*l,l==10&&(d=_n[Ot(d,_n)]));while(u<=o);return a}function Of(t,e,n,o,s,r,i){let l=t.scales[t.axes[e].scale].asinh,c=o>l?xi(t,e,pt(l,n),o,s):[
l],h=o>=0&&n<=0?[0]:[];return(n<-l?xi(t,e,pt(l,-o),-n,s):[l]).reverse().map(d=>-d).concat(h,c)}var Bc=/./,Uf=/[12357]/,Bf=/[125]/,sc=/1/,vi=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function Wf(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,c=r._space,h=l(10,i),u=l(
9,i)-h>=c?Bc:l(7,i)-h>=c?Uf:l(5,i)-h>=c?Bf:sc;if(u==sc){let d=He(l(1,i)-h);if(d<c)return vi(e.slice().reverse(),a.distr,u,_t(c/d)).reverse()}return vi(e,a.distr,
u,1)}function Gf(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,c=He(l(1,i)-l(2,i));return c<a?vi(e.slice().reverse(),3,Bc,_t(a/c)).reverse():e}function Hf(t,e,n,o){
return o==null?Ai:e==null?"":Ci(e)}var rc={show:!0,scale:"y",stroke:Ti,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Oc,side:3,grid:Ri,ticks:Fc,
border:Ic,font:$i,lineGap:Uc,rotate:0};function Vf(t,e){let n=3+(t||1)*2;return Te(n*e,3)}function jf(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=He(i-r),l=t.series[e],c=a/(l.points.space*be);return o[1]-o[0]<=c}var ic={scale:null,auto:!0,sorted:0,min:Me,max:-Me},
Wc=(t,e,n,o,s)=>s,ac={show:!0,auto:!0,sorted:0,gaps:Wc,alpha:1,facets:[Be({},ic,{scale:"x"}),Be({},ic,{scale:"y"})]},lc={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Wc,alpha:1,points:{show:jf,filter:null},values:null,min:Me,max:-Me,idxs:[],path:null,clip:null};function zf(t,e,n,o,s){return n/10}var Gc={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Yf=Be({},Gc,{time:!1,ori:1}),cc={};function Hc(t,e){let n=cc[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,l,c){for(let h=0;h<n.plots.length;h++)n.plots[h]!=s&&n.plots[h].pub(o,s,r,i,a,l,c)}},t!=null&&(cc[t]=
n)),n}var xo=1,ki=2;function Dn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],c=o==2?r[1]:r[e],h=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],u=o==2?i[s.facets[1].scale]:i[s.scale],d=a.left,m=a.top,w=a.width,v=a.height,b=t.valToPosH,M=t.valToPosV;return h.ori==0?n(s,l,c,h,u,b,M,d,
m,w,v,Ws,ko,Hs,jc,Yc):n(s,l,c,h,u,M,b,m,d,v,w,Gs,So,Oi,zc,qc)}function Fi(t,e){let n=0,o=0,s=ye(t.bands,Li);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function qf(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function tn(t,e,n,o,s,r){return Dn(t,e,(i,a,l,c,h,u,d,m,w,v,b)=>{let M=i.pxRound,S=c.
dir*(c.ori==0?1:-1),E=c.ori==0?ko:So,P,D;S==1?(P=n,D=o):(P=o,D=n);let L=M(u(a[P],c,v,m)),O=M(d(l[P],h,b,w)),G=M(u(a[D],c,v,m)),te=M(d(r==1?h.max:h.min,h,b,w)),X=new Path2D(
s);return E(X,G,te),E(X,L,te),E(X,L,O),X})}function Bs(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?Hs:Oi,l=n;for(let u=0;u<t.length;u++){let d=t[u];
if(d[1]>d[0]){let m=d[0]-l;m>0&&a(i,l,o,m,o+r),l=d[1]}}let c=n+s-l,h=10;c>0&&a(i,l,o-h/2,c,o+r+h)}return i}function Kf(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Ii(t,e,n,o,s,r,i){let a=[],l=t.length;for(let c=s==1?n:o;c>=n&&c<=o;c+=s)if(e[c]===null){let u=c,d=c;if(s==1)for(;++c<=o&&e[c]===null;)
d=c;else for(;--c>=n&&e[c]===null;)d=c;let m=r(t[u]),w=d==u?m:r(t[d]),v=u-s;m=i<=0&&v>=0&&v<l?r(t[v]):m;let M=d+s;w=i>=0&&M>=0&&M<l?r(t[M]):w,w>=m&&a.push([m,w])}
return a}function hc(t){return t==0?xc:t==1?Ge:e=>Pn(e,t)}function Vc(t){let e=t==0?Ws:Gs,n=t==0?(s,r,i,a,l,c)=>{s.arcTo(r,i,a,l,c)}:(s,r,i,a,l,c)=>{s.arcTo(i,r,
l,a,c)},o=t==0?(s,r,i,a,l)=>{s.rect(r,i,a,l)}:(s,r,i,a,l)=>{s.rect(i,r,l,a)};return(s,r,i,a,l,c=0,h=0)=>{c==0&&h==0?o(s,r,i,a,l):(c=Ut(c,a/2,l/2),h=Ut(h,a/2,l/2),
e(s,r+c,i),n(s,r+a,i,r+a,i+l,c),n(s,r+a,i+l,r,i+l,h),n(s,r,i+l,r,i,h),n(s,r,i,r+a,i,c),s.closePath())}}var Ws=(t,e,n)=>{t.moveTo(e,n)},Gs=(t,e,n)=>{t.moveTo(n,e)},
ko=(t,e,n)=>{t.lineTo(e,n)},So=(t,e,n)=>{t.lineTo(n,e)},Hs=Vc(0),Oi=Vc(1),jc=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},zc=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},Yc=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},qc=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function Kc(t){return(e,n,o,s,r)=>Dn(e,n,(i,a,l,c,h,u,d,m,w,v,b)=>{let{pxRound:M,
points:S}=i,E,P;c.ori==0?(E=Ws,P=jc):(E=Gs,P=zc);let D=Te(S.width*be,3),L=(S.size-S.width)/2*be,O=Te(L*2,3),G=new Path2D,te=new Path2D,{left:X,top:$,width:ee,height:U}=e.
bbox;Hs(te,X-O,$-O,ee+O*2,U+O*2);let A=_=>{if(l[_]!=null){let B=M(u(a[_],c,v,m)),I=M(d(l[_],h,b,w));E(G,B+L,I),P(G,B,I,L,0,Ns*2)}};if(r)r.forEach(A);else for(let _=o;_<=
s;_++)A(_);return{stroke:D>0?G:null,fill:G,clip:te,flags:xo|ki}})}function Jc(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var Jf=Jc(ko),Xf=Jc(So);function Xc(t){let e=ye(t?.alignGaps,0);return(n,o,s,r)=>Dn(n,o,(i,a,l,c,h,u,d,m,w,v,b)=>{[s,r]=Fs(l,s,r);let M=i.pxRound,S=U=>M(u(U,c,v,
m)),E=U=>M(d(U,h,b,w)),P,D;c.ori==0?(P=ko,D=Jf):(P=So,D=Xf);let L=c.dir*(c.ori==0?1:-1),O={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:xo},G=O.
stroke,te=!1;if(r-s>=v*4){let U=W=>n.posToVal(W,c.key,!0),A=null,_=null,B,I,ie,K=S(a[L==1?s:r]),J=S(a[s]),Q=S(a[r]),q=U(L==1?J+1:Q-1);for(let W=L==1?s:r;W>=s&&W<=
r;W+=L){let ue=a[W],he=(L==1?ue<q:ue>q)?K:S(ue),ae=l[W];he==K?ae!=null?(I=ae,A==null?(P(G,he,E(I)),B=A=_=I):I<A?A=I:I>_&&(_=I)):ae===null&&(te=!0):(A!=null&&D(G,
K,E(A),E(_),E(B),E(I)),ae!=null?(I=ae,P(G,he,E(I)),A=_=B=I):(A=_=null,ae===null&&(te=!0)),K=he,q=U(K+L))}A!=null&&A!=_&&ie!=K&&D(G,K,E(A),E(_),E(B),E(I))}else for(let U=L==
1?s:r;U>=s&&U<=r;U+=L){let A=l[U];A===null?te=!0:A!=null&&P(G,S(a[U]),E(A))}let[$,ee]=Fi(n,o);if(i.fill!=null||$!=0){let U=O.fill=new Path2D(G),A=i.fillTo(n,o,i.
min,i.max,$),_=E(A),B=S(a[s]),I=S(a[r]);L==-1&&([I,B]=[B,I]),P(U,I,_),P(U,B,_)}if(!i.spanGaps){let U=[];te&&U.push(...Ii(a,l,s,r,L,S,e)),O.gaps=U=i.gaps(n,o,s,r,
U),O.clip=Bs(U,c.ori,m,w,v,b)}return ee!=0&&(O.band=ee==2?[tn(n,o,s,r,G,-1),tn(n,o,s,r,G,1)]:tn(n,o,s,r,G,ee)),O})}function Zf(t){let e=ye(t.align,1),n=ye(t.ascDesc,
!1),o=ye(t.alignGaps,0),s=ye(t.extend,!1);return(r,i,a,l)=>Dn(r,i,(c,h,u,d,m,w,v,b,M,S,E)=>{[a,l]=Fs(u,a,l);let P=c.pxRound,{left:D,width:L}=r.bbox,O=J=>P(w(J,d,
S,b)),G=J=>P(v(J,m,E,M)),te=d.ori==0?ko:So,X={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:xo},$=X.stroke,ee=d.dir*(d.ori==0?1:-1),U=G(u[ee==
1?a:l]),A=O(h[ee==1?a:l]),_=A,B=A;s&&e==-1&&(B=D,te($,B,U)),te($,A,U);for(let J=ee==1?a:l;J>=a&&J<=l;J+=ee){let Q=u[J];if(Q==null)continue;let q=O(h[J]),W=G(Q);
e==1?te($,q,U):te($,_,W),te($,q,W),U=W,_=q}let I=_;s&&e==1&&(I=D+L,te($,I,U));let[ie,K]=Fi(r,i);if(c.fill!=null||ie!=0){let J=X.fill=new Path2D($),Q=c.fillTo(r,
i,c.min,c.max,ie),q=G(Q);te(J,I,q),te(J,B,q)}if(!c.spanGaps){let J=[];J.push(...Ii(h,u,a,l,ee,O,o));let Q=c.width*be/2,q=n||e==1?Q:-Q,W=n||e==-1?-Q:Q;J.forEach(
ue=>{ue[0]+=q,ue[1]+=W}),X.gaps=J=c.gaps(r,i,a,l,J),X.clip=Bs(J,d.ori,b,M,S,E)}return K!=0&&(X.band=K==2?[tn(r,i,a,l,$,-1),tn(r,i,a,l,$,1)]:tn(r,i,a,l,$,K)),X})}
function pc(t,e,n,o,s,r,i=Me){if(t.length>1){let a=null;for(let l=0,c=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=He(t[l]-t[a]);h<c&&(c=h,i=He(n(t[l],
o,s,r)-n(t[a],o,s,r)))}a=l}}return i}function Qf(t){t=t||qo;let e=ye(t.size,[.6,Me,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==null?[0,0]:typeof s=="number"?[s,
0]:s;let r=pe(s),i=1-e[0],a=ye(e[1],Me),l=ye(e[2],1),c=ye(t.disp,qo),h=ye(t.each,m=>{}),{fill:u,stroke:d}=c;return(m,w,v,b)=>Dn(m,w,(M,S,E,P,D,L,O,G,te,X,$)=>{let ee=M.
pxRound,U=n,A=o*be,_=a*be,B=l*be,I,ie;P.ori==0?[I,ie]=r(m,w):[ie,I]=r(m,w);let K=P.dir*(P.ori==0?1:-1),J=P.ori==0?Hs:Oi,Q=P.ori==0?h:(j,Se,De,z,re,me,st)=>{h(j,
Se,De,re,z,st,me)},q=ye(m.bands,Li).find(j=>j.series[0]==w),W=q!=null?q.dir:0,ue=M.fillTo(m,w,M.min,M.max,W),de=ee(O(ue,D,$,te)),he,ae,Fe,We=X,ve=ee(M.width*be),
it=!1,ot=null,Ne=null,Ie=null,Ct=null;u!=null&&(ve==0||d!=null)&&(it=!0,ot=u.values(m,w,v,b),Ne=new Map,new Set(ot).forEach(j=>{j!=null&&Ne.set(j,new Path2D)}),
ve>0&&(Ie=d.values(m,w,v,b),Ct=new Map,new Set(Ie).forEach(j=>{j!=null&&Ct.set(j,new Path2D)})));let{x0:Lt,size:yn}=c;if(Lt!=null&&yn!=null){U=1,S=Lt.values(m,w,
v,b),Lt.unit==2&&(S=S.map(De=>m.posToVal(G+De*X,P.key,!0)));let j=yn.values(m,w,v,b);yn.unit==2?ae=j[0]*X:ae=L(j[0],P,X,G)-L(0,P,X,G),We=pc(S,E,L,P,X,G,We),Fe=We-
ae+A}else We=pc(S,E,L,P,X,G,We),Fe=We*i+A,ae=We-Fe;Fe<1&&(Fe=0),ve>=ae/2&&(ve=0),Fe<5&&(ee=xc);let on=Fe>0,Wt=We-Fe-(on?ve:0);ae=ee(bi(Wt,B,_)),he=(U==0?ae/2:U==
K?0:ae)-U*K*((U==0?A/2:0)+(on?ve/2:0));let ze={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Jt=it?null:new Path2D,Nt=null;if(q!=null)Nt=m.data[q.
series[1]];else{let{y0:j,y1:Se}=c;j!=null&&Se!=null&&(E=Se.values(m,w,v,b),Nt=j.values(m,w,v,b))}let Gt=I*ae,se=ie*ae;for(let j=K==1?v:b;j>=v&&j<=b;j+=K){let Se=E[j];
if(Se==null)continue;if(Nt!=null){let dt=Nt[j]??0;if(Se-dt==0)continue;de=O(dt,D,$,te)}let De=P.distr!=2||c!=null?S[j]:j,z=L(De,P,X,G),re=O(ye(Se,ue),D,$,te),me=ee(
z-he),st=ee(pt(re,de)),ft=ee(Ut(re,de)),kt=st-ft;if(Se!=null){let dt=Se<0?se:Gt,Dt=Se<0?Gt:se;it?(ve>0&&Ie[j]!=null&&J(Ct.get(Ie[j]),me,ft+xt(ve/2),ae,pt(0,kt-ve),
dt,Dt),ot[j]!=null&&J(Ne.get(ot[j]),me,ft+xt(ve/2),ae,pt(0,kt-ve),dt,Dt)):J(Jt,me,ft+xt(ve/2),ae,pt(0,kt-ve),dt,Dt),Q(m,w,j,me-ve/2,ft,ae+ve,kt)}}return ve>0?ze.
stroke=it?Ct:Jt:it||(ze._fill=M.width==0?M._fill:M._stroke??M._fill,ze.width=0),ze.fill=it?Ne:Jt,ze})}function em(t,e){let n=ye(e?.alignGaps,0);return(o,s,r,i)=>Dn(
o,s,(a,l,c,h,u,d,m,w,v,b,M)=>{[r,i]=Fs(c,r,i);let S=a.pxRound,E=I=>S(d(I,h,b,w)),P=I=>S(m(I,u,M,v)),D,L,O;h.ori==0?(D=Ws,O=ko,L=Yc):(D=Gs,O=So,L=qc);let G=h.dir*
(h.ori==0?1:-1),te=E(l[G==1?r:i]),X=te,$=[],ee=[];for(let I=G==1?r:i;I>=r&&I<=i;I+=G)if(c[I]!=null){let K=l[I],J=E(K);$.push(X=J),ee.push(P(c[I]))}let U={stroke:t(
$,ee,D,O,L,S),fill:null,clip:null,band:null,gaps:null,flags:xo},A=U.stroke,[_,B]=Fi(o,s);if(a.fill!=null||_!=0){let I=U.fill=new Path2D(A),ie=a.fillTo(o,s,a.min,
a.max,_),K=P(ie);O(I,X,K),O(I,te,K)}if(!a.spanGaps){let I=[];I.push(...Ii(l,c,r,i,G,E,n)),U.gaps=I=a.gaps(o,s,r,i,I),U.clip=Bs(I,h.ori,w,v,b,M)}return B!=0&&(U.
band=B==2?[tn(o,s,r,i,A,-1),tn(o,s,r,i,A,1)]:tn(o,s,r,i,A,B)),U})}function tm(t){return em(nm,t)}function nm(t,e,n,o,s,r){let i=t.length;if(i<2)return null;let a=new Path2D;
if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let l=Array(i),c=Array(i-1),h=Array(i-1),u=Array(i-1);for(let d=0;d<i-1;d++)h[d]=e[d+1]-e[d],u[d]=t[d+1]-t[d],c[d]=h[d]/
u[d];l[0]=c[0];for(let d=1;d<i-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(
l[d])||(l[d]=0));l[i-1]=c[i-2];for(let d=0;d<i-1;d++)s(a,t[d]+u[d]/3,e[d]+l[d]*u[d]/3,t[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,t[d+1],e[d+1])}return a}var Si=new Set;
function dc(){for(let t of Si)t.syncRect(!0)}vo&&(Ln($u,go,dc),Ln(Fu,go,dc,!0),Ln(Ds,go,()=>{Ve.pxRatio=be}));var om=Xc(),sm=Kc();function uc(t,e,n,o){return(o?
[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Mi(r,i,e,n))}function rm(t,e){return t.map((n,o)=>o==0?{}:Be({},e,n))}function Mi(t,e,n,o){
return Be({},e==0?n:o,t)}function Zc(t,e,n){return e==null?wo:[e,n]}var im=Zc;function am(t,e,n){return e==null?wo:Rs(e,n,_i,!0)}function Qc(t,e,n,o){return e==
null?wo:Is(e,n,t.scales[o].log,!1)}var lm=Qc;function eh(t,e,n,o){return e==null?wo:Pi(e,n,t.scales[o].log,!1)}var cm=eh;function hm(t,e,n,o,s){let r=pt(jl(t),jl(
e)),i=e-t,a=Ot(s/o*i,n);do{let l=n[a],c=o*l/i;if(c>=s&&r+(l<5?fn.get(l):0)<=17)return[l,c]}while(++a<n.length);return[0,0]}function fc(t){let e,n;return t=t.replace(
/(\d+)px/,(o,s)=>(e=Ge((n=+s)*be))+"px"),[t,e,n]}function pm(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=Te(e[2]*be,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),
e[1]=n})}function Ve(t,e,n){let o={mode:ye(t.mode,1)},s=o.mode;function r(p,f,g,y){let x=f.valToPct(p);return y+g*(f.dir==-1?1-x:x)}function i(p,f,g,y){let x=f.
valToPct(p);return y+g*(f.dir==-1?x:1-x)}function a(p,f,g,y){return f.ori==0?r(p,f,g,y):i(p,f,g,y)}o.valToPosH=r,o.valToPosV=i;let l=!1;o.status=0;let c=o.root=
Pt(yu);if(t.id!=null&&(c.id=t.id),bt(c,t.class),t.title){let p=Pt(xu,c);p.textContent=t.title}let h=It("canvas"),u=o.ctx=h.getContext("2d"),d=Pt(vu,c);Ln("click",
d,p=>{p.target===w&&(Ae!=Yn||Ce!=qn)&&et.click(o,p)},!0);let m=o.under=Pt(ku,d);d.appendChild(h);let w=o.over=Pt(Su,d);t=bo(t);let v=+ye(t.pxAlign,1),b=hc(v);(t.
plugins||[]).forEach(p=>{p.opts&&(t=p.opts(o,t)||t)});let M=t.ms||.001,S=o.series=s==1?uc(t.series||[],oc,lc,!1):rm(t.series||[null],ac),E=o.axes=uc(t.axes||[],
nc,rc,!0),P=o.scales={},D=o.bands=t.bands||[];D.forEach(p=>{p.fill=pe(p.fill||null),p.dir=ye(p.dir,-1)});let L=s==2?S[1].facets[0].scale:S[0].scale,O={axes:dd,series:ad},
G=(t.drawOrder||["axes","series"]).map(p=>O[p]);function te(p){let f=p.distr==3?g=>en(g>0?g:p.clamp(o,g,p.min,p.max,p.key)):p.distr==4?g=>pi(g,p.asinh):p.distr==
100?g=>p.fwd(g):g=>g;return g=>{let y=f(g),{_min:x,_max:T}=p,N=T-x;return(y-x)/N}}function X(p){let f=P[p];if(f==null){let g=(t.scales||qo)[p]||qo;if(g.from!=null){
X(g.from);let y=Be({},P[g.from],g,{key:p});y.valToPct=te(y),P[p]=y}else{f=P[p]=Be({},p==L?Gc:Yf,g),f.key=p;let y=f.time,x=f.range,T=un(x);if((p!=L||s==2&&!y)&&(T&&
(x[0]==null||x[1]==null)&&(x={min:x[0]==null?Gl:{mode:1,hard:x[0],soft:x[0]},max:x[1]==null?Gl:{mode:1,hard:x[1],soft:x[1]}},T=!1),!T&&Us(x))){let N=x;x=(R,F,H)=>F==
null?wo:Rs(F,H,N)}f.range=pe(x||(y?im:p==L?f.distr==3?lm:f.distr==4?cm:Zc:f.distr==3?Qc:f.distr==4?eh:am)),f.auto=pe(T?!1:f.auto),f.clamp=pe(f.clamp||zf),f._min=
f._max=null,f.valToPct=te(f)}}}X("x"),X("y"),s==1&&S.forEach(p=>{X(p.scale)}),E.forEach(p=>{X(p.scale)});for(let p in t.scales)X(p);let $=P[L],ee=$.distr,U,A;$.
ori==0?(bt(c,wu),U=r,A=i):(bt(c,bu),U=i,A=r);let _={};for(let p in P){let f=P[p];(f.min!=null||f.max!=null)&&(_[p]={min:f.min,max:f.max},f.min=f.max=null)}let B=t.
tzDate||(p=>new Date(Ge(p/M))),I=t.fmtDate||Ni,ie=M==1?bf(B):kf(B),K=Ql(B,Zl(M==1?wf:vf,I)),J=tc(B,ec(Mf,I)),Q=[],q=o.legend=Be({},Ef,t.legend),W=o.cursor=Be({},
Df,{drag:{y:s==2}},t.cursor),ue=q.show,de=W.show,he=q.markers;q.idxs=Q,he.width=pe(he.width),he.dash=pe(he.dash),he.stroke=pe(he.stroke),he.fill=pe(he.fill);let ae,
Fe,We,ve=[],it=[],ot,Ne=!1,Ie={};if(q.live){let p=S[1]?S[1].values:null;Ne=p!=null,ot=Ne?p(o,1,0):{_:0};for(let f in ot)Ie[f]=Ai}if(ue)if(ae=It("table",_u,c),We=
It("tbody",null,ae),q.mount(o,ae),Ne){Fe=It("thead",null,ae,We);let p=It("tr",null,Fe);It("th",null,p);for(var Ct in ot)It("th",_l,p).textContent=Ct}else bt(ae,
Lu),q.live&&bt(ae,Cu);let Lt={show:!0},yn={show:!1};function on(p,f){if(f==0&&(Ne||!q.live||s==2))return wo;let g=[],y=It("tr",Nu,We,We.childNodes[f]);bt(y,p.class),
p.show||bt(y,Cn);let x=It("th",null,y);if(he.show){let R=Pt(Du,x);if(f>0){let F=he.width(o,f);F&&(R.style.border=F+"px "+he.dash(o,f)+" "+he.stroke(o,f)),R.style.
background=he.fill(o,f)}}let T=Pt(_l,x);p.label instanceof HTMLElement?T.appendChild(p.label):T.textContent=p.label,f>0&&(he.show||(T.style.color=p.width>0?he.stroke(
o,f):he.fill(o,f)),ze("click",x,R=>{if(W._lock)return;bn(R);let F=S.indexOf(p);if((R.ctrlKey||R.metaKey)!=q.isolate){let H=S.some((V,Y)=>Y>0&&Y!=F&&V.show);S.forEach(
(V,Y)=>{Y>0&&Vt(Y,H?Y==F?Lt:yn:Lt,!0,Oe.setSeries)})}else Vt(F,{show:!p.show},!0,Oe.setSeries)},!1),On&&ze(Dl,x,R=>{W._lock||(bn(R),Vt(S.indexOf(p),Jn,!0,Oe.setSeries))},
!1));for(var N in ot){let R=It("td",Ru,y);R.textContent="--",g.push(R)}return[y,g]}let Wt=new Map;function ze(p,f,g,y=!0){let x=Wt.get(f)||{},T=W.bind[p](o,f,g,
y);T&&(Ln(p,f,x[p]=T),Wt.set(f,x))}function Jt(p,f,g){let y=Wt.get(f)||{};for(let x in y)(p==null||x==p)&&(wi(x,f,y[x]),delete y[x]);p==null&&Wt.delete(f)}let Nt=0,
Gt=0,se=0,j=0,Se=0,De=0,z=Se,re=De,me=se,st=j,ft=0,kt=0,dt=0,Dt=0;o.bbox={};let Sr=!1,Qo=!1,In=!1,wn=!1,es=!1,St=!1;function Mr(p,f,g){(g||p!=o.width||f!=o.height)&&
pa(p,f),Hn(!1),In=!0,Qo=!0,Vn()}function pa(p,f){o.width=Nt=se=p,o.height=Gt=j=f,Se=De=0,ed(),td();let g=o.bbox;ft=g.left=Pn(Se*be,.5),kt=g.top=Pn(De*be,.5),dt=
g.width=Pn(se*be,.5),Dt=g.height=Pn(j*be,.5)}let Xp=3;function Zp(){let p=!1,f=0;for(;!p;){f++;let g=hd(f),y=pd(f);p=f==Xp||g&&y,p||(pa(o.width,o.height),Qo=!0)}}
function Qp({width:p,height:f}){Mr(p,f)}o.setSize=Qp;function ed(){let p=!1,f=!1,g=!1,y=!1;E.forEach((x,T)=>{if(x.show&&x._show){let{side:N,_size:R}=x,F=N%2,H=x.
label!=null?x.labelSize:0,V=R+H;V>0&&(F?(se-=V,N==3?(Se+=V,y=!0):g=!0):(j-=V,N==0?(De+=V,p=!0):f=!0))}}),xn[0]=p,xn[1]=g,xn[2]=f,xn[3]=y,se-=sn[1]+sn[3],Se+=sn[3],
j-=sn[2]+sn[0],De+=sn[0]}function td(){let p=Se+se,f=De+j,g=Se,y=De;function x(T,N){switch(T){case 1:return p+=N,p-N;case 2:return f+=N,f-N;case 3:return g-=N,g+
N;case 0:return y-=N,y+N}}E.forEach((T,N)=>{if(T.show&&T._show){let R=T.side;T._pos=x(R,T._size),T.label!=null&&(T._lpos=x(R,T.labelSize))}})}if(W.dataIdx==null){
let p=W.hover,f=p.skip=new Set(p.skip??[]);f.add(void 0);let g=p.prox=pe(p.prox),y=p.bias??=0;W.dataIdx=(x,T,N,R)=>{if(T==0)return N;let F=N,H=g(x,T,N,R)??Me,V=H>=
0&&H<Me,Y=$.ori==0?se:j,oe=W.left,we=e[0],ge=e[T];if(f.has(ge[N])){F=null;let ce=null,ne=null,Z;if(y==0||y==-1)for(Z=N;ce==null&&Z-- >0;)f.has(ge[Z])||(ce=Z);if(y==
0||y==1)for(Z=N;ne==null&&Z++<ge.length;)f.has(ge[Z])||(ne=Z);if(ce!=null||ne!=null)if(V){let Pe=ce==null?-1/0:U(we[ce],$,Y,0),Re=ne==null?1/0:U(we[ne],$,Y,0),Ze=oe-
Pe,ke=Re-oe;Ze<=ke?Ze<=H&&(F=ce):ke<=H&&(F=ne)}else F=ne==null?ce:ce==null?ne:N-ce<=ne-N?ce:ne}else V&&He(oe-U(we[N],$,Y,0))>H&&(F=null);return F}}let bn=p=>{W.
event=p};W.idxs=Q,W._lock=!1;let rt=W.points;rt.show=pe(rt.show),rt.size=pe(rt.size),rt.stroke=pe(rt.stroke),rt.width=pe(rt.width),rt.fill=pe(rt.fill);let Ht=o.
focus=Be({},t.focus||{alpha:.3},W.focus),On=Ht.prox>=0,Un=On&&rt.one,Mt=[],Bn=[],Wn=[];function da(p,f){let g=rt.show(o,f);if(g instanceof HTMLElement)return bt(
g,Pu),bt(g,p.class),Kt(g,-10,-10,se,j),w.insertBefore(g,Mt[f]),g}function ua(p,f){if(s==1||f>0){let g=s==1&&P[p.scale].time,y=p.value;p.value=g?ql(y)?tc(B,ec(y,
I)):y||J:y||Hf,p.label=p.label||(g?$f:Rf)}if(Un||f>0){p.width=p.width==null?1:p.width,p.paths=p.paths||om||zu,p.fillTo=pe(p.fillTo||qf),p.pxAlign=+ye(p.pxAlign,
v),p.pxRound=hc(p.pxAlign),p.stroke=pe(p.stroke||null),p.fill=pe(p.fill||null),p._stroke=p._fill=p._paths=p._focus=null;let g=Vf(pt(1,p.width),1),y=p.points=Be(
{},{size:g,width:pt(1,g*.2),stroke:p.stroke,space:g*2,paths:sm,_stroke:null,_fill:null},p.points);y.show=pe(y.show),y.filter=pe(y.filter),y.fill=pe(y.fill),y.stroke=
pe(y.stroke),y.paths=pe(y.paths),y.pxAlign=p.pxAlign}if(ue){let g=on(p,f);ve.splice(f,0,g[0]),it.splice(f,0,g[1]),q.values.push(null)}if(de){Q.splice(f,0,null);
let g=null;Un?f==0&&(g=da(p,f)):f>0&&(g=da(p,f)),Mt.splice(f,0,g),Bn.splice(f,0,0),Wn.splice(f,0,0)}Xe("addSeries",f)}function nd(p,f){f=f??S.length,p=s==1?Mi(p,
f,oc,lc):Mi(p,f,{},ac),S.splice(f,0,p),ua(S[f],f)}o.addSeries=nd;function od(p){if(S.splice(p,1),ue){q.values.splice(p,1),it.splice(p,1);let f=ve.splice(p,1)[0];
Jt(null,f.firstChild),f.remove()}de&&(Q.splice(p,1),Mt.splice(p,1)[0].remove(),Bn.splice(p,1),Wn.splice(p,1)),Xe("delSeries",p)}o.delSeries=od;let xn=[!1,!1,!1,
!1];function sd(p,f){if(p._show=p.show,p.show){let g=p.side%2,y=P[p.scale];y==null&&(p.scale=g?S[1].scale:L,y=P[p.scale]);let x=y.time;p.size=pe(p.size),p.space=
pe(p.space),p.rotate=pe(p.rotate),un(p.incrs)&&p.incrs.forEach(N=>{!fn.has(N)&&fn.set(N,Sc(N))}),p.incrs=pe(p.incrs||(y.distr==2?mf:x?M==1?yf:xf:_n)),p.splits=pe(
p.splits||(x&&y.distr==1?ie:y.distr==3?xi:y.distr==4?Of:If)),p.stroke=pe(p.stroke),p.grid.stroke=pe(p.grid.stroke),p.ticks.stroke=pe(p.ticks.stroke),p.border.stroke=
pe(p.border.stroke);let T=p.values;p.values=un(T)&&!un(T[0])?pe(T):x?un(T)?Ql(B,Zl(T,I)):ql(T)?Sf(B,T):T||K:T||Ff,p.filter=pe(p.filter||(y.distr>=3&&y.log==10?Wf:
y.distr==3&&y.log==2?Gf:vc)),p.font=fc(p.font),p.labelFont=fc(p.labelFont),p._size=p.size(o,null,f,0),p._space=p._rotate=p._incrs=p._found=p._splits=p._values=null,
p._size>0&&(xn[f]=!0,p._el=Pt(Mu,d))}}function Po(p,f,g,y){let[x,T,N,R]=g,F=f%2,H=0;return F==0&&(R||T)&&(H=f==0&&!x||f==2&&!N?Ge(nc.size/3):0),F==1&&(x||N)&&(H=
f==1&&!T||f==3&&!R?Ge(rc.size/2):0),H}let fa=o.padding=(t.padding||[Po,Po,Po,Po]).map(p=>pe(ye(p,Po))),sn=o._padding=fa.map((p,f)=>p(o,f,xn,0)),Qe,Ye=null,qe=null,
ts=s==1?S[0].idxs:null,Rt=null,_o=!1;function ma(p,f){if(e=p??[],o.data=o._data=e,s==2){Qe=0;for(let g=1;g<S.length;g++)Qe+=e[g][0].length}else{e.length==0&&(o.
data=o._data=e=[[]]),Rt=e[0],Qe=Rt.length;let g=e;if(ee==2){g=e.slice();let y=g[0]=Array(Qe);for(let x=0;x<Qe;x++)y[x]=x}o._data=e=g}if(Hn(!0),Xe("setData"),ee==
2&&(In=!0),f!==!1){let g=$;g.auto(o,_o)?Tr():an(L,g.min,g.max),wn=wn||W.left>=0,St=!0,Vn()}}o.setData=ma;function Tr(){_o=!0;let p,f;s==1&&(Qe>0?(Ye=ts[0]=0,qe=
ts[1]=Qe-1,p=e[0][Ye],f=e[0][qe],ee==2?(p=Ye,f=qe):p==f&&(ee==3?[p,f]=Is(p,p,$.log,!1):ee==4?[p,f]=Pi(p,p,$.log,!1):$.time?f=p+Ge(86400/M):[p,f]=Rs(p,f,_i,!0))):
(Ye=ts[0]=p=null,qe=ts[1]=f=null)),an(L,p,f)}let ns,Gn,Ar,Er,Pr,_r,Cr,Lr,Nr,ut;function ga(p,f,g,y,x,T){p??=Ll,g??=Li,y??="butt",x??=Ll,T??="round",p!=ns&&(u.strokeStyle=
ns=p),x!=Gn&&(u.fillStyle=Gn=x),f!=Ar&&(u.lineWidth=Ar=f),T!=Pr&&(u.lineJoin=Pr=T),y!=_r&&(u.lineCap=_r=y),g!=Er&&u.setLineDash(Er=g)}function ya(p,f,g,y){f!=Gn&&
(u.fillStyle=Gn=f),p!=Cr&&(u.font=Cr=p),g!=Lr&&(u.textAlign=Lr=g),y!=Nr&&(u.textBaseline=Nr=y)}function Dr(p,f,g,y,x=0){if(y.length>0&&p.auto(o,_o)&&(f==null||f.
min==null)){let T=ye(Ye,0),N=ye(qe,y.length-1),R=g.min==null?Bu(y,T,N,x,p.distr==3):[g.min,g.max];p.min=Ut(p.min,g.min=R[0]),p.max=pt(p.max,g.max=R[1])}}let wa={
min:null,max:null};function rd(){for(let y in P){let x=P[y];_[y]==null&&(x.min==null||_[L]!=null&&x.auto(o,_o))&&(_[y]=wa)}for(let y in P){let x=P[y];_[y]==null&&
x.from!=null&&_[x.from]!=null&&(_[y]=wa)}_[L]!=null&&Hn(!0);let p={};for(let y in _){let x=_[y];if(x!=null){let T=p[y]=bo(P[y],Ku);if(x.min!=null)Be(T,x);else if(y!=
L||s==2)if(Qe==0&&T.from==null){let N=T.range(o,null,null,y);T.min=N[0],T.max=N[1]}else T.min=Me,T.max=-Me}}if(Qe>0){S.forEach((y,x)=>{if(s==1){let T=y.scale,N=_[T];
if(N==null)return;let R=p[T];if(x==0){let F=R.range(o,R.min,R.max,T);R.min=F[0],R.max=F[1],Ye=Ot(R.min,e[0]),qe=Ot(R.max,e[0]),qe-Ye>1&&(e[0][Ye]<R.min&&Ye++,e[0][qe]>
R.max&&qe--),y.min=Rt[Ye],y.max=Rt[qe]}else y.show&&y.auto&&Dr(R,N,y,e[x],y.sorted);y.idxs[0]=Ye,y.idxs[1]=qe}else if(x>0&&y.show&&y.auto){let[T,N]=y.facets,R=T.
scale,F=N.scale,[H,V]=e[x],Y=p[R],oe=p[F];Y!=null&&Dr(Y,_[R],T,H,T.sorted),oe!=null&&Dr(oe,_[F],N,V,N.sorted),y.min=N.min,y.max=N.max}});for(let y in p){let x=p[y],
T=_[y];if(x.from==null&&(T==null||T.min==null)){let N=x.range(o,x.min==Me?null:x.min,x.max==-Me?null:x.max,y);x.min=N[0],x.max=N[1]}}}for(let y in p){let x=p[y];
if(x.from!=null){let T=p[x.from];if(T.min==null)x.min=x.max=null;else{let N=x.range(o,T.min,T.max,y);x.min=N[0],x.max=N[1]}}}let f={},g=!1;for(let y in p){let x=p[y],
T=P[y];if(T.min!=x.min||T.max!=x.max){T.min=x.min,T.max=x.max;let N=T.distr;T._min=N==3?en(T.min):N==4?pi(T.min,T.asinh):N==100?T.fwd(T.min):T.min,T._max=N==3?en(
T.max):N==4?pi(T.max,T.asinh):N==100?T.fwd(T.max):T.max,f[y]=g=!0}}if(g){S.forEach((y,x)=>{s==2?x>0&&f.y&&(y._paths=null):f[y.scale]&&(y._paths=null)});for(let y in f)
In=!0,Xe("setScale",y);de&&W.left>=0&&(wn=St=!0)}for(let y in _)_[y]=null}function id(p){let f=bi(Ye-1,0,Qe-1),g=bi(qe+1,0,Qe-1);for(;p[f]==null&&f>0;)f--;for(;p[g]==
null&&g<Qe-1;)g++;return[f,g]}function ad(){if(Qe>0){let p=S.some(f=>f._focus)&&ut!=Ht.alpha;p&&(u.globalAlpha=ut=Ht.alpha),S.forEach((f,g)=>{if(g>0&&f.show&&(ba(
g,!1),ba(g,!0),f._paths==null)){let y=ut;ut!=f.alpha&&(u.globalAlpha=ut=f.alpha);let x=s==2?[0,e[g][0].length-1]:id(e[g]);f._paths=f.paths(o,g,x[0],x[1]),ut!=y&&
(u.globalAlpha=ut=y)}}),S.forEach((f,g)=>{if(g>0&&f.show){let y=ut;ut!=f.alpha&&(u.globalAlpha=ut=f.alpha),f._paths!=null&&xa(g,!1);{let x=f._paths!=null?f._paths.
gaps:null,T=f.points.show(o,g,Ye,qe,x),N=f.points.filter(o,g,T,x);(T||N)&&(f.points._paths=f.points.paths(o,g,Ye,qe,N),xa(g,!0))}ut!=y&&(u.globalAlpha=ut=y),Xe(
"drawSeries",g)}}),p&&(u.globalAlpha=ut=1)}}function ba(p,f){let g=f?S[p].points:S[p];g._stroke=g.stroke(o,p),g._fill=g.fill(o,p)}function xa(p,f){let g=f?S[p].
points:S[p],{stroke:y,fill:x,clip:T,flags:N,_stroke:R=g._stroke,_fill:F=g._fill,_width:H=g.width}=g._paths;H=Te(H*be,3);let V=null,Y=H%2/2;f&&F==null&&(F=H>0?"#\
fff":R);let oe=g.pxAlign==1&&Y>0;if(oe&&u.translate(Y,Y),!f){let we=ft-H/2,ge=kt-H/2,ce=dt+H,ne=Dt+H;V=new Path2D,V.rect(we,ge,ce,ne)}f?Rr(R,H,g.dash,g.cap,F,y,
x,N,T):ld(p,R,H,g.dash,g.cap,F,y,x,N,V,T),oe&&u.translate(-Y,-Y)}function ld(p,f,g,y,x,T,N,R,F,H,V){let Y=!1;F!=0&&D.forEach((oe,we)=>{if(oe.series[0]==p){let ge=S[oe.
series[1]],ce=e[oe.series[1]],ne=(ge._paths||qo).band;un(ne)&&(ne=oe.dir==1?ne[0]:ne[1]);let Z,Pe=null;ge.show&&ne&&Gu(ce,Ye,qe)?(Pe=oe.fill(o,we)||T,Z=ge._paths.
clip):ne=null,Rr(f,g,y,x,Pe,N,R,F,H,V,Z,ne),Y=!0}}),Y||Rr(f,g,y,x,T,N,R,F,H,V)}let va=xo|ki;function Rr(p,f,g,y,x,T,N,R,F,H,V,Y){ga(p,f,g,y,x),(F||H||Y)&&(u.save(),
F&&u.clip(F),H&&u.clip(H)),Y?(R&va)==va?(u.clip(Y),V&&u.clip(V),ss(x,N),os(p,T,f)):R&ki?(ss(x,N),u.clip(Y),os(p,T,f)):R&xo&&(u.save(),u.clip(Y),V&&u.clip(V),ss(
x,N),u.restore(),os(p,T,f)):(ss(x,N),os(p,T,f)),(F||H||Y)&&u.restore()}function os(p,f,g){g>0&&(f instanceof Map?f.forEach((y,x)=>{u.strokeStyle=ns=x,u.stroke(y)}):
f!=null&&p&&u.stroke(f))}function ss(p,f){f instanceof Map?f.forEach((g,y)=>{u.fillStyle=Gn=y,u.fill(g)}):f!=null&&p&&u.fill(f)}function cd(p,f,g,y){let x=E[p],
T;if(y<=0)T=[0,0];else{let N=x._space=x.space(o,p,f,g,y),R=x._incrs=x.incrs(o,p,f,g,y,N);T=hm(f,g,R,y,N)}return x._found=T}function $r(p,f,g,y,x,T,N,R,F,H){let V=N%
2/2;v==1&&u.translate(V,V),ga(R,N,F,H,R),u.beginPath();let Y,oe,we,ge,ce=x+(y==0||y==3?-T:T);g==0?(oe=x,ge=ce):(Y=x,we=ce);for(let ne=0;ne<p.length;ne++)f[ne]!=
null&&(g==0?Y=we=p[ne]:oe=ge=p[ne],u.moveTo(Y,oe),u.lineTo(we,ge));u.stroke(),v==1&&u.translate(-V,-V)}function hd(p){let f=!0;return E.forEach((g,y)=>{if(!g.show)
return;let x=P[g.scale];if(x.min==null){g._show&&(f=!1,g._show=!1,Hn(!1));return}else g._show||(f=!1,g._show=!0,Hn(!1));let T=g.side,N=T%2,{min:R,max:F}=x,[H,V]=cd(
y,R,F,N==0?se:j);if(V==0)return;let Y=x.distr==2,oe=g._splits=g.splits(o,y,R,F,H,V,Y),we=x.distr==2?oe.map(Z=>Rt[Z]):oe,ge=x.distr==2?Rt[oe[1]]-Rt[oe[0]]:H,ce=g.
_values=g.values(o,g.filter(o,we,y,V,ge),y,V,ge);g._rotate=T==2?g.rotate(o,ce,y,V):0;let ne=g._size;g._size=_t(g.size(o,ce,y,p)),ne!=null&&g._size!=ne&&(f=!1)}),
f}function pd(p){let f=!0;return fa.forEach((g,y)=>{let x=g(o,y,xn,p);x!=sn[y]&&(f=!1),sn[y]=x}),f}function dd(){for(let p=0;p<E.length;p++){let f=E[p];if(!f.show||
!f._show)continue;let g=f.side,y=g%2,x,T,N=f.stroke(o,p),R=g==0||g==3?-1:1,[F,H]=f._found;if(f.label!=null){let lt=f.labelGap*R,yt=Ge((f._lpos+lt)*be);ya(f.labelFont[0],
N,"center",g==2?"top":Cl),u.save(),y==1?(x=T=0,u.translate(yt,Ge(kt+Dt/2)),u.rotate((g==3?-Ns:Ns)/2)):(x=Ge(ft+dt/2),T=yt);let Sn=bc(f.label)?f.label(o,p,F,H):f.
label;u.fillText(Sn,x,T),u.restore()}if(H==0)continue;let V=P[f.scale],Y=y==0?dt:Dt,oe=y==0?ft:kt,we=f._splits,ge=V.distr==2?we.map(lt=>Rt[lt]):we,ce=V.distr==2?
Rt[we[1]]-Rt[we[0]]:F,ne=f.ticks,Z=f.border,Pe=ne.show?ne.size:0,Re=Ge(Pe*be),Ze=Ge((f.alignTo==2?f._size-Pe-f.gap:f.gap)*be),ke=f._rotate*-Ns/180,$e=b(f._pos*be),
mt=(Re+Ze)*R,at=$e+mt;T=y==0?at:0,x=y==1?at:0;let Tt=f.font[0],$t=f.align==1?fo:f.align==2?li:ke>0?fo:ke<0?li:y==0?"center":g==3?li:fo,zt=ke||y==1?"middle":g==2?
"top":Cl;ya(Tt,N,$t,zt);let gt=f.font[1]*f.lineGap,At=we.map(lt=>b(a(lt,V,Y,oe))),Ft=f._values;for(let lt=0;lt<Ft.length;lt++){let yt=Ft[lt];if(yt!=null){y==0?x=
At[lt]:T=At[lt],yt=""+yt;let Sn=yt.indexOf(`
`)==-1?[yt]:yt.split(/\n/gm);for(let ct=0;ct<Sn.length;ct++){let Ba=Sn[ct];ke?(u.save(),u.translate(x,T+ct*gt),u.rotate(ke),u.fillText(Ba,0,0),u.restore()):u.fillText(
Ba,x,T+ct*gt)}}}ne.show&&$r(At,ne.filter(o,ge,p,H,ce),y,g,$e,Re,Te(ne.width*be,3),ne.stroke(o,p),ne.dash,ne.cap);let Yt=f.grid;Yt.show&&$r(At,Yt.filter(o,ge,p,H,
ce),y,y==0?2:1,y==0?kt:ft,y==0?Dt:dt,Te(Yt.width*be,3),Yt.stroke(o,p),Yt.dash,Yt.cap),Z.show&&$r([$e],[1],y==0?1:0,y==0?1:2,y==1?kt:ft,y==1?Dt:dt,Te(Z.width*be,
3),Z.stroke(o,p),Z.dash,Z.cap)}Xe("drawAxes")}function Hn(p){S.forEach((f,g)=>{g>0&&(f._paths=null,p&&(s==1?(f.min=null,f.max=null):f.facets.forEach(y=>{y.min=null,
y.max=null})))})}let rs=!1,Fr=!1,Co=[];function ud(){Fr=!1;for(let p=0;p<Co.length;p++)Xe(...Co[p]);Co.length=0}function Vn(){rs||(nf(ka),rs=!0)}function fd(p,f=!1){
rs=!0,Fr=f,p(o),ka(),f&&Co.length>0&&queueMicrotask(ud)}o.batch=fd;function ka(){if(Sr&&(rd(),Sr=!1),In&&(Zp(),In=!1),Qo){if(_e(m,fo,Se),_e(m,"top",De),_e(m,Vo,
se),_e(m,jo,j),_e(w,fo,Se),_e(w,"top",De),_e(w,Vo,se),_e(w,jo,j),_e(d,Vo,Nt),_e(d,jo,Gt),h.width=Ge(Nt*be),h.height=Ge(Gt*be),E.forEach(({_el:p,_show:f,_size:g,
_pos:y,side:x})=>{if(p!=null)if(f){let T=x===3||x===0?g:0,N=x%2==1;_e(p,N?"left":"top",y-T),_e(p,N?"width":"height",g),_e(p,N?"top":"left",N?De:Se),_e(p,N?"heig\
ht":"width",N?j:se),yi(p,Cn)}else bt(p,Cn)}),ns=Gn=Ar=Pr=_r=Cr=Lr=Nr=Er=null,ut=1,Do(!0),Se!=z||De!=re||se!=me||j!=st){Hn(!1);let p=se/me,f=j/st;if(de&&!wn&&W.left>=
0){W.left*=p,W.top*=f,jn&&Kt(jn,Ge(W.left),0,se,j),zn&&Kt(zn,0,Ge(W.top),se,j);for(let g=0;g<Mt.length;g++){let y=Mt[g];y!=null&&(Bn[g]*=p,Wn[g]*=f,Kt(y,_t(Bn[g]),
_t(Wn[g]),se,j))}}if(Ee.show&&!es&&Ee.left>=0&&Ee.width>0){Ee.left*=p,Ee.width*=p,Ee.top*=f,Ee.height*=f;for(let g in Gr)_e(Kn,g,Ee[g])}z=Se,re=De,me=se,st=j}Xe(
"setSize"),Qo=!1}Nt>0&&Gt>0&&(u.clearRect(0,0,h.width,h.height),Xe("drawClear"),G.forEach(p=>p()),Xe("draw")),Ee.show&&es&&(is(Ee),es=!1),de&&wn&&(kn(null,!0,!1),
wn=!1),q.show&&q.live&&St&&(Br(),St=!1),l||(l=!0,o.status=1,Xe("ready")),_o=!1,rs=!1}o.redraw=(p,f)=>{In=f||!1,p!==!1?an(L,$.min,$.max):Vn()};function Ir(p,f){let g=P[p];
if(g.from==null){if(Qe==0){let y=g.range(o,f.min,f.max,p);f.min=y[0],f.max=y[1]}if(f.min>f.max){let y=f.min;f.min=f.max,f.max=y}if(Qe>1&&f.min!=null&&f.max!=null&&
f.max-f.min<1e-16)return;p==L&&g.distr==2&&Qe>0&&(f.min=Ot(f.min,e[0]),f.max=Ot(f.max,e[0]),f.min==f.max&&f.max++),_[p]=f,Sr=!0,Vn()}}o.setScale=Ir;let Or,Ur,jn,
zn,Sa,Ma,Yn,qn,Ta,Aa,Ae,Ce,rn=!1,et=W.drag,Ke=et.x,Je=et.y;de&&(W.x&&(Or=Pt(Au,w)),W.y&&(Ur=Pt(Eu,w)),$.ori==0?(jn=Or,zn=Ur):(jn=Ur,zn=Or),Ae=W.left,Ce=W.top);let Ee=o.
select=Be({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Kn=Ee.show?Pt(Tu,Ee.over?w:m):null;function is(p,f){if(Ee.show){for(let g in p)Ee[g]=p[g],g in
Gr&&_e(Kn,g,p[g]);f!==!1&&Xe("setSelect")}}o.setSelect=is;function md(p){if(S[p].show)ue&&yi(ve[p],Cn);else if(ue&&bt(ve[p],Cn),de){let g=Un?Mt[0]:Mt[p];g!=null&&
Kt(g,-10,-10,se,j)}}function an(p,f,g){Ir(p,{min:f,max:g})}function Vt(p,f,g,y){f.focus!=null&&xd(p),f.show!=null&&S.forEach((x,T)=>{T>0&&(p==T||p==null)&&(x.show=
f.show,md(T),s==2?(an(x.facets[0].scale,null,null),an(x.facets[1].scale,null,null)):an(x.scale,null,null),Vn())}),g!==!1&&Xe("setSeries",p,f),y&&Ro("setSeries",
o,p,f)}o.setSeries=Vt;function gd(p,f){Be(D[p],f)}function yd(p,f){p.fill=pe(p.fill||null),p.dir=ye(p.dir,-1),f=f??D.length,D.splice(f,0,p)}function wd(p){p==null?
D.length=0:D.splice(p,1)}o.addBand=yd,o.setBand=gd,o.delBand=wd;function bd(p,f){S[p].alpha=f,de&&Mt[p]!=null&&(Mt[p].style.opacity=f),ue&&ve[p]&&(ve[p].style.opacity=
f)}let Xt,ln,vn,Jn={focus:!0};function xd(p){if(p!=vn){let f=p==null,g=Ht.alpha!=1;S.forEach((y,x)=>{if(s==1||x>0){let T=f||x==0||x==p;y._focus=f?null:T,g&&bd(x,
T?1:Ht.alpha)}}),vn=p,g&&Vn()}}ue&&On&&ze(Rl,ae,p=>{W._lock||(bn(p),vn!=null&&Vt(null,Jn,!0,Oe.setSeries))});function jt(p,f,g){let y=P[f];g&&(p=p/be-(y.ori==1?
De:Se));let x=se;y.ori==1&&(x=j,p=x-p),y.dir==-1&&(p=x-p);let T=y._min,N=y._max,R=p/x,F=T+(N-T)*R,H=y.distr;return H==3?yo(10,F):H==4?Vu(F,y.asinh):H==100?y.bwd(
F):F}function vd(p,f){let g=jt(p,L,f);return Ot(g,e[0],Ye,qe)}o.valToIdx=p=>Ot(p,e[0]),o.posToIdx=vd,o.posToVal=jt,o.valToPos=(p,f,g)=>P[f].ori==0?r(p,P[f],g?dt:
se,g?ft:0):i(p,P[f],g?Dt:j,g?kt:0),o.setCursor=(p,f,g)=>{Ae=p.left,Ce=p.top,kn(null,f,g)};function Ea(p,f){_e(Kn,fo,Ee.left=p),_e(Kn,Vo,Ee.width=f)}function Pa(p,f){
_e(Kn,"top",Ee.top=p),_e(Kn,jo,Ee.height=f)}let Lo=$.ori==0?Ea:Pa,No=$.ori==1?Ea:Pa;function kd(){if(ue&&q.live)for(let p=s==2?1:0;p<S.length;p++){if(p==0&&Ne)continue;
let f=q.values[p],g=0;for(let y in f)it[p][g++].firstChild.nodeValue=f[y]}}function Br(p,f){if(p!=null&&(p.idxs?p.idxs.forEach((g,y)=>{Q[y]=g}):qu(p.idx)||Q.fill(
p.idx),q.idx=Q[0]),ue&&q.live){for(let g=0;g<S.length;g++)(g>0||s==1&&!Ne)&&Sd(g,Q[g]);kd()}St=!1,f!==!1&&Xe("setLegend")}o.setLegend=Br;function Sd(p,f){let g=S[p],
y=p==0&&ee==2?Rt:e[p],x;Ne?x=g.values(o,p,f)??Ie:(x=g.value(o,f==null?null:y[f],p,f),x=x==null?Ie:{_:x}),q.values[p]=x}function kn(p,f,g){Ta=Ae,Aa=Ce,[Ae,Ce]=W.
move(o,Ae,Ce),W.left=Ae,W.top=Ce,de&&(jn&&Kt(jn,Ge(Ae),0,se,j),zn&&Kt(zn,0,Ge(Ce),se,j));let y,x=Ye>qe;Xt=Me,ln=null;let T=$.ori==0?se:j,N=$.ori==1?se:j;if(Ae<0||
Qe==0||x){y=W.idx=null;for(let R=0;R<S.length;R++){let F=Mt[R];F!=null&&Kt(F,-10,-10,se,j)}On&&Vt(null,Jn,!0,p==null&&Oe.setSeries),q.live&&(Q.fill(y),St=!0)}else{
let R,F,H;s==1&&(R=$.ori==0?Ae:Ce,F=jt(R,L),y=W.idx=Ot(F,e[0],Ye,qe),H=U(e[0][y],$,T,0));let V=-10,Y=-10,oe=0,we=0,ge=!0,ce="",ne="";for(let Z=s==2?1:0;Z<S.length;Z++){
let Pe=S[Z],Re=Q[Z],Ze=Re==null?null:s==1?e[Z][Re]:e[Z][1][Re],ke=W.dataIdx(o,Z,y,F),$e=ke==null?null:s==1?e[Z][ke]:e[Z][1][ke];if(St=St||$e!=Ze||ke!=Re,Q[Z]=ke,
Z>0&&Pe.show){let mt=ke==null?-10:ke==y?H:U(s==1?e[0][ke]:e[Z][0][ke],$,T,0),at=$e==null?-10:A($e,s==1?P[Pe.scale]:P[Pe.facets[1].scale],N,0);if(On&&$e!=null){let Tt=$.
ori==1?Ae:Ce,$t=He(Ht.dist(o,Z,ke,at,Tt));if($t<Xt){let zt=Ht.bias;if(zt!=0){let gt=jt(Tt,Pe.scale),At=$e>=0?1:-1,Ft=gt>=0?1:-1;Ft==At&&(Ft==1?zt==1?$e>=gt:$e<=
gt:zt==1?$e<=gt:$e>=gt)&&(Xt=$t,ln=Z)}else Xt=$t,ln=Z}}if(St||Un){let Tt,$t;$.ori==0?(Tt=mt,$t=at):(Tt=at,$t=mt);let zt,gt,At,Ft,Yt,lt,yt=!0,Sn=rt.bbox;if(Sn!=null){
yt=!1;let ct=Sn(o,Z);At=ct.left,Ft=ct.top,zt=ct.width,gt=ct.height}else At=Tt,Ft=$t,zt=gt=rt.size(o,Z);if(lt=rt.fill(o,Z),Yt=rt.stroke(o,Z),Un)Z==ln&&Xt<=Ht.prox&&
(V=At,Y=Ft,oe=zt,we=gt,ge=yt,ce=lt,ne=Yt);else{let ct=Mt[Z];ct!=null&&(Bn[Z]=At,Wn[Z]=Ft,Wl(ct,zt,gt,yt),Ul(ct,lt,Yt),Kt(ct,_t(At),_t(Ft),se,j))}}}}if(Un){let Z=Ht.
prox,Pe=vn==null?Xt<=Z:Xt>Z||ln!=vn;if(St||Pe){let Re=Mt[0];Re!=null&&(Bn[0]=V,Wn[0]=Y,Wl(Re,oe,we,ge),Ul(Re,ce,ne),Kt(Re,_t(V),_t(Y),se,j))}}}if(Ee.show&&rn)if(p!=
null){let[R,F]=Oe.scales,[H,V]=Oe.match,[Y,oe]=p.cursor.sync.scales,we=p.cursor.drag;if(Ke=we._x,Je=we._y,Ke||Je){let{left:ge,top:ce,width:ne,height:Z}=p.select,
Pe=p.scales[Y].ori,Re=p.posToVal,Ze,ke,$e,mt,at,Tt=R!=null&&H(R,Y),$t=F!=null&&V(F,oe);Tt&&Ke?(Pe==0?(Ze=ge,ke=ne):(Ze=ce,ke=Z),$e=P[R],mt=U(Re(Ze,Y),$e,T,0),at=
U(Re(Ze+ke,Y),$e,T,0),Lo(Ut(mt,at),He(at-mt))):Lo(0,T),$t&&Je?(Pe==1?(Ze=ge,ke=ne):(Ze=ce,ke=Z),$e=P[F],mt=A(Re(Ze,oe),$e,N,0),at=A(Re(Ze+ke,oe),$e,N,0),No(Ut(mt,
at),He(at-mt))):No(0,N)}else Hr()}else{let R=He(Ta-Sa),F=He(Aa-Ma);if($.ori==1){let oe=R;R=F,F=oe}Ke=et.x&&R>=et.dist,Je=et.y&&F>=et.dist;let H=et.uni;H!=null?Ke&&
Je&&(Ke=R>=H,Je=F>=H,!Ke&&!Je&&(F>R?Je=!0:Ke=!0)):et.x&&et.y&&(Ke||Je)&&(Ke=Je=!0);let V,Y;Ke&&($.ori==0?(V=Yn,Y=Ae):(V=qn,Y=Ce),Lo(Ut(V,Y),He(Y-V)),Je||No(0,N)),
Je&&($.ori==1?(V=Yn,Y=Ae):(V=qn,Y=Ce),No(Ut(V,Y),He(Y-V)),Ke||Lo(0,T)),!Ke&&!Je&&(Lo(0,0),No(0,0))}if(et._x=Ke,et._y=Je,p==null){if(g){if(Ua!=null){let[R,F]=Oe.
scales;Oe.values[0]=R!=null?jt($.ori==0?Ae:Ce,R):null,Oe.values[1]=F!=null?jt($.ori==1?Ae:Ce,F):null}Ro(ci,o,Ae,Ce,se,j,y)}if(On){let R=g&&Oe.setSeries,F=Ht.prox;
vn==null?Xt<=F&&Vt(ln,Jn,!0,R):Xt>F?Vt(null,Jn,!0,R):ln!=vn&&Vt(ln,Jn,!0,R)}}St&&(q.idx=y,Br()),f!==!1&&Xe("setCursor")}let cn=null;Object.defineProperty(o,"rec\
t",{get(){return cn==null&&Do(!1),cn}});function Do(p=!1){p?cn=null:(cn=w.getBoundingClientRect(),Xe("syncRect",cn))}function _a(p,f,g,y,x,T,N){W._lock||rn&&p!=
null&&p.movementX==0&&p.movementY==0||(Wr(p,f,g,y,x,T,N,!1,p!=null),p!=null?kn(null,!0,!0):kn(f,!0,!1))}function Wr(p,f,g,y,x,T,N,R,F){if(cn==null&&Do(!1),bn(p),
p!=null)g=p.clientX-cn.left,y=p.clientY-cn.top;else{if(g<0||y<0){Ae=-10,Ce=-10;return}let[H,V]=Oe.scales,Y=f.cursor.sync,[oe,we]=Y.values,[ge,ce]=Y.scales,[ne,Z]=Oe.
match,Pe=f.axes[0].side%2==1,Re=$.ori==0?se:j,Ze=$.ori==1?se:j,ke=Pe?T:x,$e=Pe?x:T,mt=Pe?y:g,at=Pe?g:y;if(ge!=null?g=ne(H,ge)?a(oe,P[H],Re,0):-10:g=Re*(mt/ke),ce!=
null?y=Z(V,ce)?a(we,P[V],Ze,0):-10:y=Ze*(at/$e),$.ori==1){let Tt=g;g=y,y=Tt}}F&&(f==null||f.cursor.event.type==ci)&&((g<=1||g>=se-1)&&(g=Pn(g,se)),(y<=1||y>=j-1)&&
(y=Pn(y,j))),R?(Sa=g,Ma=y,[Yn,qn]=W.move(o,g,y)):(Ae=g,Ce=y)}let Gr={width:0,height:0,left:0,top:0};function Hr(){is(Gr,!1)}let Ca,La,Na,Da;function Ra(p,f,g,y,x,T,N){
rn=!0,Ke=Je=et._x=et._y=!1,Wr(p,f,g,y,x,T,N,!0,!1),p!=null&&(ze(hi,mi,$a,!1),Ro(Nl,o,Yn,qn,se,j,null));let{left:R,top:F,width:H,height:V}=Ee;Ca=R,La=F,Na=H,Da=V}
function $a(p,f,g,y,x,T,N){rn=et._x=et._y=!1,Wr(p,f,g,y,x,T,N,!1,!0);let{left:R,top:F,width:H,height:V}=Ee,Y=H>0||V>0,oe=Ca!=R||La!=F||Na!=H||Da!=V;if(Y&&oe&&is(
Ee),et.setScale&&Y&&oe){let we=R,ge=H,ce=F,ne=V;if($.ori==1&&(we=F,ge=V,ce=R,ne=H),Ke&&an(L,jt(we,L),jt(we+ge,L)),Je)for(let Z in P){let Pe=P[Z];Z!=L&&Pe.from==
null&&Pe.min!=Me&&an(Z,jt(ce+ne,Z),jt(ce,Z))}Hr()}else W.lock&&(W._lock=!W._lock,kn(f,!0,p!=null));p!=null&&(Jt(hi,mi),Ro(hi,o,Ae,Ce,se,j,null))}function Md(p,f,g,y,x,T,N){
if(W._lock)return;bn(p);let R=rn;if(rn){let F=!0,H=!0,V=10,Y,oe;$.ori==0?(Y=Ke,oe=Je):(Y=Je,oe=Ke),Y&&oe&&(F=Ae<=V||Ae>=se-V,H=Ce<=V||Ce>=j-V),Y&&F&&(Ae=Ae<Yn?0:
se),oe&&H&&(Ce=Ce<qn?0:j),kn(null,!0,!0),rn=!1}Ae=-10,Ce=-10,Q.fill(null),kn(null,!0,!0),R&&(rn=R)}function Fa(p,f,g,y,x,T,N){W._lock||(bn(p),Tr(),Hr(),p!=null&&
Ro($l,o,Ae,Ce,se,j,null))}function Ia(){E.forEach(pm),Mr(o.width,o.height,!0)}Ln(Ds,go,Ia);let Xn={};Xn.mousedown=Ra,Xn.mousemove=_a,Xn.mouseup=$a,Xn.dblclick=Fa,
Xn.setSeries=(p,f,g,y)=>{let x=Oe.match[2];g=x(o,f,g),g!=-1&&Vt(g,y,!0,!1)},de&&(ze(Nl,w,Ra),ze(ci,w,_a),ze(Dl,w,p=>{bn(p),Do(!1)}),ze(Rl,w,Md),ze($l,w,Fa),Si.add(
o),o.syncRect=Do);let as=o.hooks=t.hooks||{};function Xe(p,f,g){Fr?Co.push([p,f,g]):p in as&&as[p].forEach(y=>{y.call(null,o,f,g)})}(t.plugins||[]).forEach(p=>{
for(let f in p.hooks)as[f]=(as[f]||[]).concat(p.hooks[f])});let Oa=(p,f,g)=>g,Oe=Be({key:null,setSeries:!1,filters:{pub:zl,sub:zl},scales:[L,S[1]?S[1].scale:null],
match:[Yl,Yl,Oa],values:[null,null]},W.sync);Oe.match.length==2&&Oe.match.push(Oa),W.sync=Oe;let Ua=Oe.key,Vr=Hc(Ua);function Ro(p,f,g,y,x,T,N){Oe.filters.pub(p,
f,g,y,x,T,N)&&Vr.pub(p,f,g,y,x,T,N)}Vr.sub(o);function Td(p,f,g,y,x,T,N){Oe.filters.sub(p,f,g,y,x,T,N)&&Xn[p](null,f,g,y,x,T,N)}o.pub=Td;function Ad(){Vr.unsub(
o),Si.delete(o),Wt.clear(),wi(Ds,go,Ia),c.remove(),ae?.remove(),Xe("destroy")}o.destroy=Ad;function jr(){Xe("init",t,e),ma(e||t.data,!1),_[L]?Ir(L,_[L]):Tr(),es=
Ee.show&&(Ee.width>0||Ee.height>0),wn=St=!0,Mr(t.width,t.height)}return S.forEach(ua),E.forEach(sd),n?n instanceof HTMLElement?(n.appendChild(c),jr()):n(o,jr):jr(),
o}Ve.assign=Be;Ve.fmtNum=Ci;Ve.rangeNum=Rs;Ve.rangeLog=Is;Ve.rangeAsinh=Pi;Ve.orient=Dn;Ve.pxRatio=be;Ve.join=tf;Ve.fmtDate=Ni,Ve.tzDate=uf;Ve.sync=Hc;{Ve.addGap=
Kf,Ve.clipGaps=Bs;let t=Ve.paths={points:Kc};t.linear=Xc,t.stepped=Zf,t.bars=Qf,t.spline=tm}var Vs=128,th=50,dm=.25,um=t=>[t.ray,t.truth,t.sensor,t.noReturn],fm=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),mm=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),js=(t,e)=>({font:gs,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function nh(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:Vs})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:Vs}),s=n()),o)}function oh(t,e){let{session:n}=t,o=k("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${th}`]],()=>s,w=>{s=w,c=null,n.changed()}),
i=0,a=-1/0,l=-1,c=null,u=nh(o,()=>{let w=um(e()),v=Array.from({length:i},(b,M)=>({label:`chain ${M+1}`,stroke:w[M%w.length],width:1,points:{show:!1}}));return new Ve(
{width:100,height:Vs,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,mm,0,0],scales:{x:{time:!1,range:(b,M,S)=>[M,Math.max(S,M+1)]},y:{range:(b,M,S)=>bm(
Math.max(M,a),S)}},axes:[js(e,26),js(e,fm)],series:[{label:"sweep"},...v],hooks:{draw:[b=>vm(b,l,e()),b=>xm(b,c?.burned??0,e())]}},[[],...v.map(()=>[])],o)},e),
d=k("span",{className:"caption",textContent:"log joint by sweep"}),m=k("div",{className:"charted"},k("div",{className:"buttons"},r,d),o);return t.each(()=>{let w=n.
shown,v=w?.traced?.length?w.trace.length/w.traced.length:0;if(C(m,"hidden",v===0&&(m.hidden||!n.working)),!w||!v)return;let b=n.document?.source.kind==="run"?"d\
raw":"sweep";C(d,"textContent",`log joint by ${b}`);let M=w.layer==="draw"&&n.draws.count?(n.draw+1)*w.traced[w.traced.length-1]/n.draws.count:-1,S=u(v!==i&&(i=
v,!0));if(!S||c===w&&l===M&&S.data[0].length)return;[c,l]=[w,M],a=s==="all"?wm(w,v):-1/0;let E=gm(w,v,s);S.setData(E),o.setAttribute("data-sweeps",E[0].join())}),
m}function gm({trace:t,traced:e},n,o){let s=o==="all"?ym(e):[...e.keys()].filter(i=>e[i]<=th),r=i=>Float32Array.from(s,a=>i[a]);return[r(e),...Array.from({length:n},
(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}function ym(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,o=-1/0;return[...t.keys()].filter(
s=>t[s]<o&&s<e-1?!1:(o=t[s]+n,!0))}function wm({trace:t,traced:e},n){let o=e.length,s=e.findIndex(r=>r>=dm*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.
min(...t.slice(i*o+s,(i+1)*o))))}function bm(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function xm(t,e,n){let{left:o,top:s,width:r,height:i}=t.bbox;e&&(t.
ctx.save(),t.ctx.globalAlpha=.12,t.ctx.fillStyle=n.axis,t.ctx.fillRect(o,s,Math.min(r,Math.max(0,t.valToPos(e,"x",!0)-o)),i),t.ctx.restore())}function vm(t,e,n){
if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.
restore())}function sh(t,e){let{session:n}=t,o=k("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),s=k("div",{className:"\
caption",textContent:"particles by weight, nats below the heaviest"}),r=k("div",{className:"charted"},s,o),a=nh(o,()=>new Ve({width:100,height:Vs,legend:{show:!1},
cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(c,h,u)=>[h,u]},y:{distr:3,range:(c,h,u)=>[.5,Math.max(10,2*u)]}},axes:[js(e,26),{...js(e,52),values:(c,h)=>h.
map(u=>u>=1?String(u):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Ve.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),l=null;return t.
each(()=>{let c=n.shown;C(r,"hidden",!c?.weights);let h=c?.weights&&a(!1);if(!c?.weights||!h||l===c&&h.data[0].length)return;l=c;let u=[...c.weights],d=-(c.lowest??
-1)/u.length,m=[...u.map((w,v)=>(c.lowest??-1)+v*d),0];h.setData([m,[...u.map(w=>w||null),null]])}),r}function rh(t){let{session:e,hand:n}=t,{decisions:o}=e,s=k("p",{className:"said",role:"status"}),r=k("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,c=>o.set({radius:c}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>o.risk,c=>o.set({risk:c}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{C(l,"textContent",i()),C(s,"textContent",n.tool==="path"?km(t):Sm(t))}),a}function km({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${fe(
o.length_m,2)} m, free with probability ${fe(o.probability,3)} ± ${fe(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${fe(o.independent,
3)}.${r}`}function Sm({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.
nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${fe(Math.min(...e.nats),1)} to ${fe(o,1)} nats, cells taken for indepen\
dent; the best place has a ring.${s}`}var Mm=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Tm="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",Am="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Em="Shown is what the reading\
s tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (wi\
dth). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Pm="While you edit, the answer is belief pr\
opagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",_m="This page samples by itself: the answer is that of the chosen method\
 after as many sweeps as are shown, and gets better as they go on.",Cm="The map is made from the scans of this log. Where its poses are raw odometry, Run first \
infers where the robot was; then it samples maps.",Lm="This is a saved run: its draws, and what they say together.",Nm="Mouse: the wheel zooms, the middle butto\
n pans.",Dm="Shift or the right button erases, and so does a click on a wall.",Rm="Touch: two fingers zoom and pan.";function ih(t){let{session:e}=t,n=k("div"),
o=el.map(([i,a,l])=>{let c=k("tr",{},k("th",{scope:"row"},k("kbd",{textContent:i})),k("td",{textContent:a}));return t.visible(c,()=>$m[l??"all"](e)),c}),s=k("p"),
r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?Em:Am,l=e.editable?[`${Tm} ${a}`,e.figure?_m:Pm]:i==="log"?[a,Cm]:i==="run"?[a,Lm]:[
a];l.join()!==r&&n.replaceChildren(...l.map(c=>k("p",{textContent:c}))),r=l.join(),C(s,"textContent",[Nm,...e.editable?[Dm]:[],Rm].join(" "))}),t.dialog("Help",
n,s,k("table",{},k("tbody",{},...o)))}var $m={all:()=>!0,drawn:t=>t.editable,asked:t=>t.answers,located:t=>t.locates,edited:t=>!t.recorded,inferred:t=>!t.recorded&&
t.document?.source.kind!=="run"};function ah(t){let e=()=>k("input",{type:"number",step:1,required:!0,value:"21"}),[n,o]=[e(),e()];for(let i of[n,o])t.bounded(i,
"side");let s=k("select",{});for(let[i,a]of Mm){let l=k("option",{value:i,textContent:a});s.append(l),i!=="blank"&&t.each(()=>C(l,"disabled",t.session.figure))}
t.each(()=>t.session.figure&&C(s,"value","blank")),s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<60&&([n.value,o.value]=["120","80"])});
let r=k("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),k("div",{className:"buttons end"},k("button",{type:"submit",
className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),Number(o.value)],world:s.value}),
t.hand.selected=null}),t.dialog("New map",r)}var Fm="The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser \
while the server runs; the part from # on can be put after the address of any bayesmap page.",Im="The link holds the walls, the sensors and all settings after i\
ts #. The part from # on can be put after the address of any bayesmap page.",Om="The link holds the file's name and all settings after its #, but no scans and n\
o token. It opens in this browser while the server shows this file; the part from # on can be put after the address of any bayesmap page that shows it.";function lh(t){
let e=k("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=k("span",{role:"status",className:"copied"}),o=async()=>{e.select();try{await navigator.clipboard.
writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},s=t.button(null,"Copy the link",o,{className:"\
primary",text:"Copy"}),r=k("p");t.each(()=>C(r,"textContent",t.session.figure?Im:t.session.document?.source.kind==="simulation"?Fm:Om));let i=t.dialog("Share",r,
k("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var Um=8;function ch(t){let{session:e,hand:n}=t,o=k("p",{className:"words",role:"status"}),s=k("ol",{className:"spoken"}),r=k("p",{className:"words"}),i=k("canv\
as",{className:"trace",width:296,height:48,role:"img"}),a=k("p",{className:"caption"}),l=t.section("Evidence of beams",o,r,s,i,a),c=-1;return t.visible(l,()=>n.
tool==="evidence"),t.each(()=>{let{evidence:h}=e;if(C(o,"textContent",Hm(e)),c===h.version)return;c=h.version,C(r,"textContent",Wm(e));let u=Gm(i,h.each?.trace,
e.draws.chains);C(i,"hidden",!u.length),C(a,"textContent",u.length?`Share of draws so far with a wall, by draw: ${u.map((b,M)=>`chain ${M+1} ${b.toFixed(2)}`).join(
", ")}`:"");let{nats:d,scan:m,beam:w}=h.each??{nats:[],scan:[],beam:[]},v=Array.from(d.slice(0,Um),(b,M)=>k("li",{},`${ro(b)} nats: ${Bm(e,m[M],w[M])}`));s.replaceChildren(
...v)}),l}var Bm=({document:t,editable:e},n,o)=>`beam ${o+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function Wm({evidence:{together:t},quantity:e}){
if(!t?.beams||e.kind!=="binary"||t.nats_for===null||t.nats_against===null)return"";let{prior_nats:n,log_odds:o,draw:s,nats_for:r,nats_against:i}=t;if(s==null)return"\
Each beam is asked by itself, with the other cells as probable as they are: the sum is not the log odds of P(wall). Show one draw for that.";if(n==null||o===null||
o===void 0)return`Given all other cells of draw ${s+1}.`;let a=1/(1+Math.exp(-o));return`Given all other cells of draw ${s+1}: prior ${ro(n)}, beams ${ro(r-i)},\
 together log odds ${ro(o)}: Gibbs draws a wall with probability ${a.toFixed(3)}.`}function Gm(t,e,n){let o=e&&n?e.length/n:0,s=o?t.getContext("2d"):null,r=s&&getComputedStyle(
t);return s?.clearRect(0,0,t.width,t.height),Array.from({length:o?n:0},(i,a)=>{let l=0;s?.beginPath();for(let c=0;c<o;c++)l+=e[a*o+c],s?.lineTo(t.width*(c+.5)/o,
2+(t.height-4)*(1-l/(c+1)));return s&&r&&(s.strokeStyle=r.getPropertyValue(a?"--truth":"--ray")||"gray"),s?.stroke(),l/o})}function Hm({evidence:t,quantity:e}){
let{cell:n,together:o}=t;if(!n)return"Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";let s=`Cell ${n.
x}, ${n.y}`;if(!o)return`${s}: asking its beams.`;if(!o.beams)return`${s}: no beam reaches it.`;let r=o.beams===1?"1 beam":`${o.beams} beams`;if(o.nats_for===null||
o.nats_against===null)return`${s}: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"its surface"}[e.kind]??"what is there",a=o.beams_for||
o.beams_against?"":" None of them says anything.";return`${s}: ${r}. For ${i} (blue) ${o.beams_for}, ${o.nats_for.toFixed(1)} nats; against (orange) ${o.beams_against}\
, ${o.nats_against.toFixed(1)} nats.${a}`}var hh=t=>Math.round(t*180/Math.PI);function ph(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(l,c)=>t.numberInput(l,()=>Number((o.pose?.[c]??0).toFixed(2)),h=>o.move(
{[c]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>hh(o.pose?.yaw??0),l=>o.move({yaw:l*Math.PI/180}),{step:5}),i=k("p",{className:"words ghosted"}),a=t.
section("Ghost",k("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>C(i,"textContent",Vm(t))),
a}function Vm({session:t}){let{ghost:e}=t;if(e.trouble)return Qt(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(h,u)=>h-o[u]).filter(Number.isFinite).sort((h,u)=>h-u),a=i.length?`${fe(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",c=r?` \
Rings are the hits of scan ${r.index+1}, taken ${fe(100*r.away,0)} cm from here, turned by ${hh(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${c}`}function dh(t){let{session:e}=t,n=k("span",{className:"what"});t.each(()=>{let{grid:c,source:h}=e.document??{};if(!c||!h)return;let u=`${c.shape[0]} × ${c.shape[1]}\
 cells of ${+c.resolution.toPrecision(3)} m`;C(n,"textContent",h.name?`${h.name}, ${u}`:u)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo,why:"Nothing of this page to undo"}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"\
Redo (Ctrl+Y)",when:()=>!!e.state?.can_redo,why:"Nothing to redo"}),k("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),
...t.embedded?[]:[t.button("link","Share",()=>t.command("share"),{text:"Share",when:o})]];for(let c of s)t.visible(c,()=>!e.recorded);let r=t.button("theme","Th\
eme: automatic",()=>t.command("theme")),i=t.button("help","Help",()=>t.command("help"),{title:"Help (?)"}),a=k("span",{className:"space"});return{element:k("hea\
der",{},k("h1",{textContent:"bayesmap"}),n,a,...s,zm(t),r,i),nameTheme(c){let h=`Theme: ${c}`;nt(r,"aria-label",h),C(r,"title",h)}}}var jm=({shown:t,draws:e})=>e.
count>0||/importance|propagate/.test(t?.method??"");function zm(t){let{session:e}=t,n=(l,c,h,u,d)=>{let m=t.button(null,l,()=>t.command(`export ${c}`),{text:l,when:u,
why:d});return h!=="all"&&t.visible(m,()=>!e.recorded&&(h==="document"||!e.figure)),m},o=n("Figure that samples by itself (HTML)","figure","server");t.visible(o,
()=>e.editable&&!e.figure);let s=k("div",{className:"menu",hidden:!0},n("Picture (PNG)","png","all"),n("Saved run (netCDF)","run","server",()=>jm(e),"There are \
no draws yet: chains keep them"),n("Map for robots (YAML and PGM)","map","server"),n("Page in one file (HTML)","html","server"),o,n("Document (JSON)","document",
"document")),r=t.button("save","Export",()=>i(s.hidden),{text:"Export",when:()=>!!e.document}),i=l=>{s.hidden=!l,r.setAttribute("aria-expanded",String(l)),l&&s.
firstElementChild.focus()};i(!1);let a=k("div",{className:"anchor",tabIndex:-1},r,s);return a.addEventListener("keydown",l=>{l.key!=="Escape"||s.hidden||(i(!1),
r.focus(),l.stopPropagation())}),a.addEventListener("focusout",l=>{a.contains(l.relatedTarget)||i(!1)}),s.addEventListener("click",()=>{i(!1),r.focus()}),a}var Ym={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function mn(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",Ym[t]),e.append(n),e}var zs=({document:t})=>!t||t.source.kind==="simulation",Bi=({answers:t})=>t,uh="surface (zoom in)",fh=[{mark:"truth",text:"true wall",when:zs,may:zs},{mark:"ray",
text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.strokes.
length,may:t=>!zs(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!zs(t)},{mark:"unobserved",text:"unobserved"},{mark:"\
draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Bi},{mark:"\
path",text:"path, as wide as the robot",when:({decisions:t})=>!!(t.path&&t.pathShown),may:Bi}],mh=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 %\
 of a place"}],gh=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function yh(t,e,n){let o=k("p",{className:"sentence"});return t.
each(()=>C(o,"textContent",qm(t.session))),k("div",{className:"legend"},o,Km(t,e,n),Jm(t))}var Ui=(t,e)=>`${t.toLocaleString("en")} ${e}${t===1?"":"s"}`;function qm(t){
let{shown:e,document:n,layer:o,quantity:s,draws:r}=t;if(!e||!n)return"";if(t.where.map)return"The walls as they are drawn: where a scan was taken is asked in a \
known map.";let{kind:i,mean:a,value:l}=s,c=e.verdict?.level!=="bad",h=c?"One map drawn from the posterior":/importance/.test(e.method)?"One particle":"The map o\
f one chain, which has not converged",u={mean:i==="binary"?"How probable a wall is in each cell":Qt(`${a} of each cell`),draw:`${h}${i==="binary"?"":`, by its ${l}`}${r.
count?`, ${t.draw+1} of ${r.count}`:""}`,entropy:"How uncertain each cell is, in bits",width:"How wide the 90 % interval of each cell is"}[o];if(e.method==="non\
e")return`${u} before any reading: the prior.`;let{source:d,angles:m,sensors:w,scans_used:v}=n,b=d.kind==="simulation"?`${Ui(m*w.length,"beam")} of ${Ui(w.length,
"sensor")}`:Ui(v??d.scans,"scan"),S=(e.method==="propagate"||e.method==="pilot"||/hits|counts/.test(e.method))&&e.approximate?", approximately":o!=="draw"&&e.burned?
`: the mean of sweeps, ${ai(e.burned)}`:"";return`${u}, given ${b}${S}${c||o==="draw"?"":", as far as it is known"}.`}function Km(t,e,n){let{session:o}=t,s=k("s\
pan",{className:"ramp"}),r=k("span",{className:"name"}),i=fh.map(h=>{let[u,d]=Ys(h),{mark:m,when:w}=h;return w&&t.visible(u,()=>w(o)),m==="stroke"&&t.each(()=>C(
d,"textContent",Bo(n())?h.text:uh)),m==="path"&&t.each(()=>u.firstElementChild?.classList.toggle("risky",o.decisions.path?.within_risk===!1)),u}),[a,l]=[mh,gh].
map(h=>h.map(u=>Ys(u)[0]));for(let h of a)t.visible(h,()=>!!o.where.found);for(let h of l)t.visible(h,()=>!!o.evidence.cellShown);let c="";return t.each(()=>{let{
layer:h}=o;C(r,"textContent",wh(o,h));let u=h==="entropy"||h==="width",d=`${u} ${e().ground}`;c!==d&&(c=d,s.style.background=Zr(u?oo:m=>Xr(e(),m)))}),k("ul",{"a\
ria-label":"Legend"},k("li",{},r,k("span",{className:"scale"},"0",s,"1")),...i,Xm(t),...a,...l)}function Jm(t){let{session:e}=t,n=["mean","draw","entropy","widt\
h"].map(c=>{let h=k("span");return t.each(()=>C(h,"textContent",wh(e,c))),c==="width"&&t.visible(h,()=>e.quantity.interval),h}),o=fh.map(c=>{let[h,u]=Ys(c);c.mark===
"stroke"&&(u.textContent=uh);let{may:d}=c;return d&&t.visible(h,()=>d(e)),h}),s=k("span",{className:"scale"},"00.0",k("span",{className:"ramp"}),"000.0 nats"),r=[
mh,gh].map(c=>k("ul",{},...c.map(h=>Ys(h)[0]))),i=[k("ul",{},k("li",{},"one more scan tells",s)),...r],a=k("li",{className:"either"},...i);t.visible(a,()=>Bi(e));
let l=k("span",{className:"scale"},"0",k("span",{className:"ramp"}),"1");return k("ul",{className:"room","aria-hidden":"true"},k("li",{},k("span",{className:"na\
me either"},...n),l),...o,a)}function Ys({mark:t,text:e}){let n=k("i",{className:t});t==="sensor"&&n.append(mn("sensor"));let o=k("span",{textContent:e});return[
k("li",{},n,o),o]}function wh({quantity:t},e){let{kind:n,mean:o,value:s}=t;return e==="entropy"?"entropy (bit)":e==="width"?"width of the 90 % interval":n==="bi\
nary"?"P(wall)":e==="draw"?s:o}function Xm(t){let{decisions:e}=t.session,n=k("span",{className:"ramp"});n.style.background=Zr(oo);let[o,s]=[k("span"),k("span")],
r=k("li",{className:"views"},"one more scan tells",k("span",{className:"scale"},o,n,s));return t.visible(r,()=>e.looking&&!!e.views?.nats.length),t.each(()=>{let i=e.
views?.nats;i?.length&&(C(o,"textContent","0"),C(s,"textContent",`${fe(Math.max(...i),1)} nats`))}),r}var Zm=[.05,.1,.2,.4,.8],Qm=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function bh(t){let{session:e}=t,n=k("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,c=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...Zm,r.resolution])].sort((d,m)=>d-m),[,u]=t.limits("side_of_log");if(o!==`${h} ${u}`){o=`${h} ${u}`;let d=m=>k("option",
{value:String(m),textContent:Qm(m),disabled:c/m>u-1});n.replaceChildren(...h.map(d))}C(n,"value",String(r.resolution))});let s=t.row("Cell size",n);return t.visible(
s,()=>e.document?.source.kind==="log"),s}function xh(t){let{session:e}=t,n=k("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),o=k("output"),s=()=>e.
document?.source.scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=s()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});
let i=t.section("Log",k("div",{className:"player bare"},n,o));return t.visible(i,()=>!e.recorded&&e.document?.source.kind==="log"&&s()>1),t.each(()=>{let a=s(),
l=e.document?.scans_used??a;C(n,"max",String(Math.max(1,a))),(!En(n)||Number(n.value)!==l)&&C(n,"value",String(l));let c=l===a?`all ${a} scans`:`after ${l} of ${a}`;
n.style.setProperty("--fill",`${100*(l-1)/Math.max(1,a-1)}%`),nt(n,"aria-valuetext",c),C(o,"textContent",c)}),i}var eg="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",vh=200,
tg="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",kh="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",ng="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function Th(t){let{session:e}=t,n=k("span",{className:"chip"}),o=t.button(null,"Not converged",()=>Sh(
e)?.apply?.(),{text:"Not converged",className:"chip doubt"}),s=k("div",{className:"chips"},n,o);return t.each(()=>{let r=e.where.map!==null,i=r?null:Sh(e);if(C(
o,"hidden",!i),i){let m=[Go(e).bad,i.text].filter(Boolean).join(": ");C(o.firstElementChild,"textContent",m.charAt(0).toLowerCase()+m.slice(1)),C(o,"title",`${e.
shown?.verdict?.why}.${i.apply?` Click to ${i.text}.`:""}`),C(o,"disabled",!i.apply),nt(o,"aria-label",m)}let a=e.shown;if(!a||!e.document)return C(s,"hidden",!0);
if(C(s,"hidden",!1),r)return C(n,"textContent","known map: the walls as drawn"),C(n,"className","chip");let l=e.draws.count?`draw ${e.draw+1} of ${e.draws.count}`:
"draw",c=a.layer==="draw"?l+(e.flicker.under?" over the mean":""):a.layer==="width"?"width of the 90 % interval":e.view.layer==="entropy"?"entropy":"mean";if(a.
method==="counts"){let m=e.halfway?"along poses found so far":"along raw odometry";return C(n,"textContent",`hits and passes · ${e.stage?e.stage.text.toLowerCase():
m}`),C(n,"className","chip approximate")}let h={importance:"importance sampling",propagate:"belief propagation"}[a.method],u=e.document.method==="importance"&&a.
method==="propagate"?", until Run weighs particles":"",d=a.approximate?`approximate, ${og(a,e.working)}${u}`:h??`${a.sweeps} sweeps`;C(n,"textContent",`${c} · ${d}`),
C(n,"className",a.approximate?"chip approximate":"chip")}),s}function og({method:t,sweeps:e,total:n,averaged:o},s){return t==="hits"?"counts of hits":t!=="pilot"?
"belief propagation":`${o===1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} of ${n}`}function Sh(t){let{shown:e,document:n}=t;
if(e?.verdict?.level!=="bad"||!n)return null;if(t.recorded||n.source.kind==="run")return{text:""};let o=a=>()=>t.act({type:"set",patch:a}),s=e.sweeps<vh,r=n.pose_sigma===
0&&n.heading_sigma===0;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!s&&r)return{text:"try blocks",apply:o({method:"block"})};if(e.method==="importance")
return{text:"try Gibbs",apply:o({method:"auto"})};if(e.sweeps<e.total)return null;if(!r&&!s)return{text:"poses are too uncertain"};let i=Math.min(t.limits?.sweeps[1]??
0,Math.max(vh,4*n.sweeps));return i>n.sweeps?{text:`try ${i} sweeps`,apply:o({sweeps:i})}:{text:""}}function Ah(t){let{session:e}=t,n=k("span"),o=t.button(null,
"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),s=k("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&
!e.connection.connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??0)/1e3));C(s,"hidden",!r&&e.worker!=="restarted"),C(s,"className",r?"banner":"banner m\
ild"),C(o,"hidden",!r);let a=`Connection lost. Trying again in ${i} s; the map is kept here.`,l=e.connection.refused?eg:a;C(n,"textContent",r?l:"The worker stop\
ped and is being started again. The map is kept.")}),s}function Eh(t){let{session:e,hand:n}=t,o=k("div",{className:"readout",id:`${t.prefix}-readout`}),s=k("spa\
n",{role:"status","aria-live":"polite"}),r=k("span",{className:"hidden","aria-live":"polite"});return n.announce=i=>C(r,"textContent",i),n.describe=i=>Mh(e,i),t.
each(()=>{let{kind:i}=e.quantity;C(o,"title",i==="binary"?tg:i==="surface"?`${kh}. ${ng}`:kh);let a=n.cursor??n.hover,c=matchMedia("(pointer: coarse)").matches?
"Touch a cell":e.editable?"Point at a cell, or press ? for the keys":"Point at a cell";C(o,"textContent",a?Mh(e,a):c);let h=e.status.text==="Ready"&&e.shown?.verdict?.
level==="bad"&&!e.where.map,u=e.status.text==="Ready"&&Ps(e),d=e.shown?.method==="importance"?"Ready, but importance sampling has collapsed":"Ready, but the cha\
ins have not converged",m=e.everConnected&&!e.connection.connected&&e.status.level==="info";C(s,"textContent",m?"Connection lost":h?d:u?"Fitting the sensor":e.status.
text),C(s,"className",m?"error":h?"warning":u?"busy":e.status.level)}),{element:k("footer",{},s,o,r),readout:o}}function Mh(t,e){let{document:n,shown:o}=t;if(!n)
return"";let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+1),{x:l,y:c}=eo(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(
a)}, ${c.toFixed(a)} m`],{map:u}=t.where;if(u)h.push(u.p[i]?"wall, as drawn":"free, as drawn");else if(o&&o.p.length===r[0]*r[1]){let d=o.p[i]/255,{kind:m,mean:w,
value:v,interval:b}=t.quantity;o.layer==="width"?h.push(`90 % interval ${d.toFixed(2)} wide`):m!=="binary"&&o.layer==="draw"?h.push(`${v} ${d.toFixed(2)} in thi\
s draw`):m!=="binary"?h.push(`${w} ${d.toFixed(2)}`,...b?[]:[`entropy ${Io(d).toFixed(2)} bit`]):o.layer==="draw"?h.push(d>.5?"wall in this draw":"free in this \
draw"):h.push(`P(wall) ${d.toFixed(2)}`,`entropy ${Io(d).toFixed(2)} bit`);let M=t.evidence.facts,S=M?.x===e.x&&M.y===e.y?M:null,E=S?S.beams:null,P=o.reached[i]/
255,D=n.source.kind==="run";if(P?!D&&P<.995&&h.push(`reached by a beam with probability ${P.toFixed(2)}`):h.push(D?"reached by a beam in less than half of the d\
raws":"unobserved"),P&&E!==null&&h.push(E===1?"1 beam":`${E} beams`),P&&S&&S.nats_for!==null&&S.nats_against!==null&&E){let L={binary:"a wall",surface:"its surf\
ace"}[t.quantity.kind]??"what is there";h.push(`for ${L} ${S.beams_for}, ${S.nats_for.toFixed(1)} nats`,`against ${S.beams_against}, ${S.nats_against.toFixed(1)}\
 nats`)}}return h.join(" · ")}var sg={logged:"as logged",odometry:"from raw odometry"},rg=180/Math.PI;function Ph(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
sg,()=>e.document?.poses??"logged",a=>t.set({poses:a}));o.classList.add("wide"),t.visible(o,n);let s=[t.slider("pose_sigma",()=>"Position ±",{step:.05,unit:" m"}),
t.slider("heading_sigma",()=>"Yaw ±",{step:.5,unit:"°",scale:rg})];for(let a of s)t.visible(a,()=>e.editable);let r=k("p",{className:"caption"});t.each(()=>{let{
pose_sigma:a=0,heading_sigma:l=0,method:c="auto"}=e.document??{},h=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,u=e.editable&&(a>
0||l>0)&&!/auto|gibbs|block/.test(c);C(r,"hidden",!u&&!h),C(r,"textContent",h?"Run infers where the robot was.":"This method takes poses as known; Gibbs does no\
t.")});let i=t.section("Where the robot was",o,...s,r);return t.visible(i,()=>e.editable&&!e.figure||n()&&!e.recorded),i}var qs=t=>Math.abs(t)<.995?`${fe(100*Math.abs(t),1)} cm`:`${fe(Math.abs(t),2)} m`,ig="Point at a reading to compare it with what the posterior predicts of it.",
ag=": preparing the comparison. The first one after an installation takes some seconds.";function _h(t){let{session:e}=t,n=k("p",{className:"words reading",role:"\
status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i,
slow:a}=e.reading,l=s?`Beam ${s.beam+1} of scan ${s.scan+1}${a?ag:"."}`:ig;C(n,"textContent",i||(r?lg(r):l))}),o}function lg({scan:t,beam:e,reading:n,range:o,low:s,
median:r,high:i,residual:a,no_return:l,wall:c}){let h=`Beam ${e+1} of scan ${t+1}`,u=(M,S)=>M===null?S:`${fe(M,2)} m`,d=`median ${u(r,"no return")}, 80 % betwee\
n ${u(s,"too close")} and ${u(i,"no return")}`;if(n==="none")return`${h} came back from nothing, which was predicted with probability ${fe(l??0,3)} (${d}).`;if(n!==
"hit"||o===null)return`${h} read nothing that says how far (${d}).`;let m=a===null?"":`, ${qs(a)} ${a<0?"shorter":"longer"} than the predicted median`,w=`${h} r\
ead ${fe(o,2)} m${m} (${d}).`;if(!c)return w;let v=`${qs(c.across_m)} ${c.across_m<0?"behind":"in front of"} the wall, which is ${qs(c.thickness_m)} thick`,b=`${qs(
c.along_m)} to the ${c.along_m<0?"right":"left"} along it from the middle of its surface`;return`${w} It ended ${v} (one standard deviation), and ${b}; the beam\
 met it at ${fe(c.incidence_rad*180/Math.PI,0)}° from its normal.`}function Wi(t){let e=/^#step=(\d+)$/.exec(t);return e&&Math.max(0,Number(e[1])-1)}var Js=t=>`#step=${t+1}`;function Ch(t,e){let n=new Map;e.forEach((r,i)=>{let a=r.
replace(/ \([^)]*\)$/,"");n.has(a)||n.set(a,i)});let o=[...n.keys()].sort((r,i)=>i.length-r.length).map(r=>r.replace(/[^\w ]/g,"\\$&"));return(o.length?t.split(
new RegExp(`\\b(${o.join("|")})(?!\\w)`)):[t]).map((r,i)=>({text:r,at:i%2?n.get(r)??null:null})).filter(r=>r.text)}var Ks=class{constructor(e){this.session=e}story=null;at=0;begins=0;onstep=()=>{};get settled(){
let{state:e,acted:n,working:o,shown:s}=this.session;return!!(s&&e&&e.seq>=n&&!o)}get step(){return this.story?.steps[this.at]??null}get last(){return(this.story?.
steps.length??1)-1}go(e){this.at=Math.min(Math.max(e,0),this.last);let{step:n}=this;n&&(this.begins++,this.bring(n.document),this.session.view.layer!==n.layer&&
this.session.act({type:"view",layer:n.layer}),this.onstep(this.at),this.session.changed())}solve(){this.step?.solution&&this.bring(this.step.solution)}bring(e){
let{session:n}=this;n.state&&!n.state.live&&n.act({type:"live",on:!0}),n.bring(e),n.answers&&e.method==="importance"&&n.act({type:"run"})}};function Nh(t){let{telling:e}=t.session,[n,o,s]=[k("h3"),k("p"),k("p",{className:"task"})],r=k("div",{className:"told","aria-live":"polite"},n,o,s),i=k("nav",{"\
aria-label":"Steps"}),a=m=>()=>e.go(e.at+m),l=k("div",{className:"buttons"},t.button(null,"Back",a(-1),{text:"Back",when:()=>e.at>0,why:"This is the first step"}),
t.button(null,"Next",a(1),{className:"primary",text:"Next",when:()=>e.at<e.last,why:"This is the last step"}),t.button(null,"Start this step again",a(0),{text:"\
Again"})),c=t.button(null,"Show me",()=>e.solve(),{text:"Show me"});t.visible(c,()=>!!e.step?.solution),l.append(c);let h=t.section("Story",i,r,l);h.className="\
story";let u=h.querySelector("h2");t.visible(h,()=>!!e.story);let d=null;return t.each(()=>{let{story:m,step:w,at:v}=e;!m||!w||(d!==m&&i.replaceChildren(...m.steps.
map(({title:b},M)=>{let S=E=>{E.preventDefault(),e.go(M)};return k("a",{href:Js(M),title:b,"aria-label":`Step ${M+1}: ${b}`,textContent:String(M+1),onclick:S})})),
d=m,C(u,"textContent",m.title),C(n,"textContent",w.title),C(o,"textContent",w.text),Array.from(i.children).forEach((b,M)=>nt(b,"aria-current",M===v?"step":"fals\
e")))}),cg(t,h,s),h}function cg(t,e,n){let{telling:o}=t.session,s=[],[r,i]=["",""],a=-1,l=!1,c=!1;t.after(()=>{let{step:h,begins:u}=o;if(!h)return;let d=t.named.
filter(({place:M})=>!M.closest("[hidden], dialog")),m=d.map(({name:M})=>M()),w=[h.task,...m].join("|"),v=w===r?null:Ch(h.task,m);if(r=w,v&&JSON.stringify(v)!==i){
i=JSON.stringify(v);for(let{place:M}of s)M.classList.remove("named");s=v.flatMap(({at:M})=>M===null?[]:[d[M]]);for(let{place:M}of s)M.classList.add("named");n.replaceChildren(
...v.map(({text:M,at:S})=>S===null?M:k("button",{type:"button",title:"Go to this control",textContent:M,onclick:()=>{Lh(e,d[S].place),d[S].control.focus({preventScroll:!0})}})))}
let b=e.parentElement;if(b){if(!c)for(let M of["wheel","touchmove","pointerdown","keydown"])b.addEventListener(M,()=>l=!1,{passive:!0});c=!0,a!==u&&(a=u,b.scrollTop=
0,l=!0),l&&(s.length&&Dh(e)&&Lh(e,s[0].place),l=!o.settled)}})}var Dh=t=>getComputedStyle(t).position==="sticky";function Lh(t,e){let n=t.parentElement;if(!n.contains(
e))return;let[o,s]=[n.getBoundingClientRect(),e.getBoundingClientRect()],r=o.top+(Dh(t)?t.getBoundingClientRect().height:0);(s.top<r||s.bottom>o.bottom)&&(n.scrollTop+=
(s.top+s.bottom-r-o.bottom)/2)}var hg={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},pg={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},dg={noisy:"with noise",exact:"exact"},ug={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},fg={raster:"raster",radial:"radial",random:"random"},Xs=2*Math.PI,mg=t=>Math.round(t*1800/Math.PI)/10,gg={importance:"Particles",propagate:"Round\
s"};function Rh(t){let{session:e,hand:n,editor:o}=t,s=k("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let u=e.document?.sensors??[],d=u.map(m=>m.id).join();d!==r&&s.replaceChildren(...u.map(({id:m})=>k("option",{value:String(
m),textContent:`Sensor ${m}`}))),r=d,C(s,"value",String(n.sensor?.id??""))});let i=(u,d)=>t.numberInput(u,()=>Number((n.sensor?.[d]??0).toFixed(2)),m=>n.sensor&&
o.moveSensor(n.sensor,{[d]:m}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),u=>n.sensor&&o.moveSensor(n.sensor,{yaw:u%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),c=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1,why:"The last sensor stays"});t.visible(a,()=>(e.document?.fov??Xs)<Xs);let h=k("div",{className:"triple"},i(
"x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",k("div",{className:"buttons"},s,l,c),h)}function $h(t){let{session:e}=t,n=t.numberInput("Longest range\
 (m)",()=>e.document?.max_range??0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),o=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("\
angles",()=>"Angles",{step:1,log:!0}),n,t.numberInput("Field of view (°)",()=>mg(e.document?.fov??Xs),a=>t.set({fov:a>=360?Xs:a*Math.PI/180}),{step:5,limits:"f\
ov",scale:180/Math.PI}),t.select("Readings",dg,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of o)t.visible(a,()=>e.editable);let s=t.slider(
"prior",()=>"Prior P(wall)",{step:.01}),r=()=>(e.document?.cells??"binary")==="binary";t.visible(s,r);let i=t.select("Cells",pg,()=>e.document?.cells??"binary",
a=>t.set({cells:a}));return t.visible(i,()=>e.document?.source.kind==="log"),t.section("Model",i,bh(t),s,...o)}function Fh(t){let{session:e}=t,n=()=>e.document?.
method??"auto",o=()=>(e.document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",hg,n,l=>t.set({method:l})),t.select("Order",
fg,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||n()==="auto","Only Gibbs, cell by cell, has an order"),t.select("Start",ug,()=>e.document?.
start??"auto",l=>t.set({start:l}),s,"Only chains have a start")],i=Array.from(r[0].lastElementChild.children);for(let l of i)l.value==="propagate"&&t.visible(l,
()=>!e.figure);for(let l of r)t.visible(l,o);let a=t.slider("burn_in",()=>"Burn-in (%)",{step:5,scale:100});return t.visible(a,()=>s()||!o()),t.section("Inferen\
ce",...r,a,t.slider("sweeps",()=>gg[n()]??"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{step:1,limits:"\
seed"}))}function Ih(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),o=t.button(
null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",k("div",{className:"\
buttons"},n,o))}var yg=0,Zs=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${yg++}`;named=[];updates=[];afterwards=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}after(e){this.afterwards.push(e)}refresh(){for(let e of[...this.updates,...this.afterwards])e()}set(e){this.
session.act({type:"set",patch:e})}slide(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){this.session.act({type:"set",patch:{scans_used:e},drag:this.
drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[o,s]=this.session.limits?.[e]??[1,2];return n===1?[o,s]:[Math.ceil(10*o*n-1e-6)/10,Math.floor(
10*s*n+1e-6)/10]}bounded(e,n,o=1,s=0){this.each(()=>{let[r,i]=this.limits(n,o),[a,l]=s?[Math.ceil(r/s-1e-6),Math.floor(i/s+1e-6)]:[r,i],c=h=>String(s?+(h*s).toPrecision(
9):h);C(e,"min",c(a)),C(e,"max",c(l))})}visible(e,n){this.each(()=>C(e,"hidden",!n()))}button(e,n,o,{className:s="",text:r="",when:i,why:a,title:l}={}){let c=k(
"button",{type:"button",className:s,title:l??n,onclick:o},e&&mn(e));return r&&(c.append(k("span",{textContent:r})),this.named.push({name:()=>r,place:c,control:c})),
r!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>{C(c,"disabled",!i());let h=typeof a=="function"?a():a;h&&C(c,"title",c.disabled?h:l??n)}),c}segmented(e,n,o,s,r){
let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=k("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[l,c,h]of n){let u=k("input",{type:"rad\
io",name:i,value:l,onchange:()=>s(l)}),d=k("label",{title:c},u,h?mn(h):null,k("span",{textContent:c}));a.append(d),this.named.push({name:()=>c,place:d,control:u}),
this.each(()=>{C(u,"checked",o()===l),r&&C(u,"disabled",!r(l))})}return a}section(e,...n){let o=`${this.prefix}-${e.replace(/\W/g,"")}`;return k("section",{"ari\
a-labelledby":o},k("h2",{id:o,textContent:e}),...n)}row(e,n){n.id=`${this.prefix}-${e.replace(/\W/g,"")}`;let o=k("div",{className:"row"},k("label",{for:n.id,textContent:e}),
n);return this.named.push({name:()=>e,place:o,control:n}),o}slider(e,n,{step:o,log:s=!1,unit:r="",scale:i=1}){let a=`${this.prefix}-${e}`,l=()=>this.limits(e,i),
c=b=>{let[M,S]=l();return s?1e3*Math.log(b/M)/Math.log(S/M):b},h=b=>{if(!s)return b;let[M,S]=l(),E=M*(S/M)**(b/1e3),P=E<100?1:10**(Math.floor(Math.log10(E))-1);
return le(Math.round(E/P)*P,M,S)},u=()=>{let b=this.session.document?.[e];return b===void 0?l()[0]:i===1?b:Number((b*i).toFixed(3))},d=k("label",{for:a}),m=k("i\
nput",{type:"range",id:a,...s?{min:0,max:1e3,step:1}:{step:o}}),w=k("input",{type:"number",step:String(o)});s||this.bounded(m,e,i,o),this.bounded(w,e,i),m.addEventListener(
"input",()=>this.slide({[e]:h(Number(m.value))/i})),m.addEventListener("change",()=>this.endDrag()),w.addEventListener("change",()=>this.typed(w,n(),l(),u,b=>this.
set({[e]:s?Math.round(b):b/i}))),this.each(()=>{let b=u();C(d,"textContent",n()),nt(w,"aria-label",`${n()}, number`),h(Number(m.value))!==b&&(m.value=String(c(b))),
nt(m,"aria-valuetext",`${b}${r}`);let M=100*(c(b)-Number(m.min))/(Number(m.max)-Number(m.min));m.style.setProperty("--fill",`${le(M,0,100)}%`),En(w)||C(w,"value",
String(b))});let v=k("div",{className:"row slider"},d,m,w);return this.named.push({name:n,place:v,control:m}),v}select(e,n,o,s,r,i=""){let a=k("select",{onchange:()=>s(
a.value)});for(let[l,c]of Object.entries(n))a.append(k("option",{value:l,textContent:c}));return this.each(()=>{C(a,"value",o()),r&&C(a,"disabled",!r()),i&&C(a,
"title",a.disabled?i:"")}),this.row(e,a)}typed(e,n,[o,s],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(le(a,o,s)),e.value=String(r()),a<o?this.
session.say(`${n} is at least ${o}`,"warning"):a>s&&this.session.say(`${n} is at most ${s}`,"warning")}numberInput(e,n,o,{step:s,limits:r,scale:i}){let a=k("inp\
ut",{type:"number",step:String(s)}),l=()=>r?this.limits(r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,l(),n,o)),this.
each(()=>{En(a)||C(a,"value",String(n()))}),this.row(e,a)}checkbox(e,n,o,s=""){let r=k("input",{type:"checkbox",onchange:()=>o(r.checked)});this.each(()=>C(r,"c\
hecked",n()));let i=k("label",{className:"check",title:s},r,k("span",{textContent:e}));return this.named.push({name:()=>e,place:i,control:r}),i}dialog(e,...n){let o=`${this.
prefix}-dialog-${e.replace(/\W/g,"")}`,s=k("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},mn("close")),r=k("div",{className:"\
title"},k("h2",{id:o,textContent:e}),s),i=k("dialog",{"aria-labelledby":o},r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener(
"keydown",a=>a.stopPropagation()),i}};var wg=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Oh="There are no draws yet: chains keep them",bg={2:"2 / s",10:"10 / s",30:"\
30 / s",1e3:"fastest"},Qs=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.
session.hasDraws)return;this.before=null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.
act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,e&&s.wantsMean?this.session.act(
{type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?0:n),this.session.changed()}over(e){
let{flicker:n,view:o}=this.session;n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.chain})):o.layer!=="draw"&&this.showLayer(
"draw"):(this.afterMean=!1,this.before&&this.before!==o.layer&&this.showLayer(this.before)),this.before=e?o.layer:null,this.session.changed()}playFromStart(){this.
showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)
return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:o,draws:s}=this.session;
o+1>=s.count&&n.on?this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function Uh(t,e,n,o){let{session:s}=t,r=t.segmented(
"Show",wg,()=>s.view.layer,m=>e.showLayer(m),m=>m==="draw"?s.hasDraws:!s.lacks.includes(m)),[,,i,a]=Array.from(r.children);C(a,"title","Width of each cell's 90 \
% interval"),t.visible(i,()=>!s.quantity.interval),t.visible(a,()=>s.quantity.interval);let l=(m,w)=>t.checkbox(m,()=>n[w],v=>{n[w]=v,s.changed()}),c=l("True wa\
lls","truth");t.visible(c,()=>!s.document||s.document.source.kind==="simulation");let[h,u]=[l("Surfaces","strokes"),l("Trajectory","trajectory")];t.visible(h,()=>!!s.
overlay?.strokes.length),t.each(()=>C(h.lastElementChild,"textContent",Bo(o())?"Surfaces":"Surfaces (zoom in)")),t.visible(u,()=>!!s.overlay?.trajectory.length);
let d=k("div",{className:"checks",role:"group","aria-label":"Marks"},c,l("Rays","rays"),l("Readings","readings"),h,u);return t.section("View",r,xg(t,e),d)}function xg(t,e){
let{session:n}=t,o=k("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.
button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1,why:Oh}),r=k("output"),i=k("select",{"aria-label":"Chain"});i.addEventListener("\
change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:u,count:d}=n.draws;C(o,"max",String(Math.max(0,d-1))),C(o,"disabled",d===0),C(o,"value",String(
n.draw));let m=d?`${n.draw+1} of ${d}`:"none kept";nt(o,"aria-valuetext",m),o.style.setProperty("--fill",`${d>1?100*n.draw/(d-1):0}%`),C(r,"textContent",m),i.length!==
Math.max(1,u)&&i.replaceChildren(...Array.from({length:Math.max(1,u)},(v,b)=>k("option",{value:String(b),textContent:`chain ${b+1}`}))),C(i,"value",String(n.view.
chain)),C(i,"disabled",u<2),d<2&&e.playing&&e.play(!1);let w=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";s.getAttribute("aria-label")!==
w&&(s.setAttribute("aria-label",w),s.replaceChildren(mn(e.playing?"pause":"play")))});let a=k("select",{"aria-label":"Speed"});for(let[u,d]of Object.entries(bg))
a.append(k("option",{value:u,textContent:d}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(
null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1,why:Oh});t.each(()=>C(a,"disabled",n.draws.count<2||n.flicker.
still));let c=t.checkbox("Draws over the mean",()=>n.flicker.on,u=>e.over(u),"Each draw in its own colour over the mean, as one of the maps that the scans leave\
 possible");t.visible(c,()=>n.draws.count>1);let h=k("div",{className:"wide"},c);return k("div",{className:"player"},s,o,r,k("div",{className:"buttons wide"},i,
a,l),h)}function Bh(t){let{session:e}=t,n=k("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=k("output");n.addEventListener("input",()=>e.act({
type:"scan",index:Number(n.value)}));let s=t.section("Scan",k("div",{className:"player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulati\
on"?0:e.document?.source.scans??0;C(s,"hidden",r<2),C(n,"max",String(Math.max(0,r-1))),En(n)||C(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",
`${100*Number(n.value)/Math.max(1,r-1)}%`),C(o,"textContent",`${Number(n.value)+1} / ${r}`)}),s}var Gh=2,Wh=6,vg=.9,kg=.5,Sg=.005;function Hh(t){let{session:e,hand:n}=t,o=k("p",{className:"whereabouts",role:"status"}),s=k("p",{className:"caption"}),r=t.section(
"Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),C(o,"textContent",Mg(t)),C(s,"textCo\
ntent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, which the map shows, as if nothing were known of its pose.":"Choose a sca\
n below: it is located in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function Mg({session:t}){let{found:e,trouble:n}=t.
where;if(n)return`${n.charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>kg?`The scan fits nowhere on this map, with proba\
bility ${e.p_lost.toFixed(2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>Sg?` That it is lost, or the map outdated, ha\
s probability ${e.p_lost.toFixed(2)}.`:"";return`${o}${Tg(e.modes)}${Ag(e,t.editable)}${s}`}function Tg(t){let[e,n]=t;if(!e)return"No place.";let o=e.sigma_m>Gh,
s=`${e.mean[0].toFixed(2)}, ${e.mean[1].toFixed(2)} m, heading ${Gi(e.mean[2],0)}`,r=`known to ${Hi(e.sigma_m)} and ${Gi(e.sigma_rad,1)}`;if(!n)return o?`It may\
 be almost anywhere: positions are ${Hi(e.sigma_m)} apart.`:`One place: ${s}, ${r}.`;let i=t.slice(0,Wh).map(({probability:c})=>ni(c)),a=n.probability>vg*e.probability,
l=t.length>Wh?" and less":"";return`${t.length} places: ${i.join(", ")}${l}. ${a?"One of them":"The likeliest"}: ${s}, ${r}.`}function Ag({modes:t,pose:e},n){if(!t.
length||t[0].sigma_m>Gh)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-
e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the likeliest":`the ${Eg(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${Hi(o[s])} and\
 ${Gi(r,1)} from ${i}.`}var Eg=t=>`${t}${["th","st","nd","rd"][t%100>10&&t%100<14?0:t%10]??"th"}`,Gi=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,
"")}°`,Hi=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(0)} cm`:`${t.toFixed(1)} m`;var Mo="recording";function Vh(t,e,n,{kept:o}){let{shown:s,status:r}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:s&&{generation:s.generation,layer:t.layer,
approximate:s.approximate,sweeps:s.sweeps,method:s.method,quantity:t.quantity,rhat:s.rhat,verdict:s.verdict,trace:s.trace,traced:s.traced,weights:s.weights,ess:s.
ess,chain:s.chain,draw:s.draw},probability:s?.p??new Uint8Array(0),reached:s?.reached??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,
status:{text:r.text,level:r.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.
viewTrouble},where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:_g(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.
trouble},evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&Pg(t.evidence.each)},over:!!t.flicker.under,beside:o&&{layer:o.layer,
chain:o.view.chain,draw:o.draw,method:o.shown?.method,probability:Array.from(o.shown?.p??[])},overlay:t.overlay&&{strokes:t.overlay.strokes.length/5,trajectory:t.
overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.
latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var Pg=t=>Object.fromEntries(Object.entries(t).map(([e,n])=>[e,Array.from(n)]));function _g({
ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.near&&{...o.near}}}}var Vi=new Set(["walls","move_sensor","set","view","live"]),jh=({type:t})=>!Vi.has(t),zh="Not while the connection is lost: this needs the server";function Yh(t,e){
let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*s+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;
Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??
null};else if(e.type==="move_sensor"){let r=n.sensors.find(i=>i.id===e.id);if(r)for(let i of["x","y","yaw"])r[i]=e[i]??r[i]}}var Cg=t=>Qt(`${t.replace(/^(plan|path|explore): /,"")}.`),er=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;pathShown=!0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}showPath(e){this.pathShown!==e&&this.version++,this.pathShown=e}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.
views,this.askedViews]=[null,""]),this.version++,this.ask(),this.session.changed())}forget(){this.forgetPath(),this.views=null,this.askedViews=""}forgetPath(){this.
start=this.goal=this.path=null,this.askedPath=this.trouble="",this.version++,this.session.changed()}ask(){let{session:e,start:n,goal:o,radius:s,risk:r}=this,{shown:i}=e;
if(!i||i.generation!==e.generation||!e.answers)return;let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&!i.approximate&&l!==this.
askedPath&&(this.askedPath=l,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.method==="propagate")&&
a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let o=e.type==="undecided"?Cg(e.text):"",s=e.type==="undecided"?e.question:e.type;s===
"views"?(this.viewTrouble=o,this.views=null):this.trouble=o,e.type==="path"?this.path=e:e.type==="views"&&this.looking?this.views={pose:n.pose,nats:n.nats,spacing:e.
spacing}:s==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<n.nats.length;r++){
let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,s]=[r,i])}return o}};var tr=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=qt(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:o}=e;
if(!this.held||!n||!o||o.generation!==e.generation||!e.answers)return;let{chain:s,draw:r}=o,i=o.layer==="draw"&&s!==null&&r!==null&&e.draws.count?{chain:s,draw:r}:
{},a=`${o.generation} ${e.sampling} ${o.approximate} ${n.x} ${n.y} ${JSON.stringify(i)}`;a!==this.asked&&(this.asked=a,e.act({type:"inspect",x:n.x,y:n.y,each:!0,
...i}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.each=n.nats?n:null,this.version++)}};var Lg="(prefers-reduced-motion: reduce)",nr=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(Lg).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var Ng=2e3,Dg=3e3,Rg=2,or=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&Tn(e,n.document.
grid);(!o||!qt(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
!e.answers||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>Ng&&(this.waiting=0),this.waiting>=Rg)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Dg;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:c}=n,{x:h,y:u,yaw:d,generation:m,draws:w,coarse:v,milliseconds:b}=e,M=e.near&&{...e.near,pose:a,ranges:l,hit:c};this.fan={x:h,y:u,yaw:d,generation:m,draws:w,
coarse:v,milliseconds:b,angles:o,low:s,median:r,high:i,near:M},this.answers++}else this.fan=null;this.version++,this.ask()}};var sr=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var rr=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var ir=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.
kind!=="simulation"&&!o.recorded,r=e&&s&&o.scan?$g(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),o.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){e.type==="undecided"?this.trouble=e.text:e.beam===this.picked?.beam&&
e.scan===this.picked.scan&&(this.found=e),this.version++}};function $g({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)return null;let l={x:e[0],y:e[1]},
[c,h]=[-1,1/0];for(let u=0;u<n.length;u++){let[d,m]=[Math.cos(e[2]+n[u]),Math.sin(e[2]+n[u])],[w,v]=[r.x-l.x,r.y-l.y],b=w*d+v*m,M=s[u]?o[u]:a,S=s[u]?Math.hypot(
w-M*d,v-M*m):1/0,E=b>0&&b<M?Math.abs(w*m-v*d):1/0,P=Math.min(S,i/2+2*E);P<h&&([c,h]=[u,P])}return h<i?{scan:t,beam:c,from:l,angle:e[2]+n[c]}:null}var ar=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;known=null;knownVersion=-1;asked="";waitingSince=0;follow(e,n){
this.sensor=n,e!==this.wanted&&(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.
ask()}get map(){let{shown:e,editable:n,walls:o,wallsVersion:s}=this.session;return!this.wanted||!n||!e?null:((!this.known||this.knownVersion!==s)&&(this.known={
...e,layer:"mean",p:o.map(r=>255*r),reached:new Uint8Array(o.length).fill(255)},this.knownVersion=s),this.known)}receive(e,n){if(this.waitingSince=0,!this.wanted)
return;this.trouble=e.trouble;let{pose:o,weight:s}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,cloud:o,weight:s},
this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||!e.locates||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;let s=e.editable?
"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.asked||this.waitingSince&&i-this.waitingSince<
5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var qh=new Set(["inspect","path","views","where","ghost","beam"]),To=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";limits=null;recorded=!1;figure=!1;lacks=[];generation=-1;acted=0;decisions=new er(
this);evidence=new tr(this);where=new ar(this);ghost=new or(this);reading=new ir(this);flicker=new nr(this);telling=new Ks(this);status=new Es;progress=new rr;latency=new sr;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,
text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get answers(){
return!this.recorded&&!this.figure}get locates(){return this.answers||this.figure}get running(){return this.connection.connected&&!!this.state?.running}get working(){
return this.connection.connected&&!!this.state?.working}get layer(){if(this.where.map)return"mean";let e=this.shown?.layer;return e==="draw"||e==="width"?e:this.
view.layer==="entropy"?"entropy":"mean"}get picture(){return this.where.map??this.flicker.under??this.shown}get stage(){return this.running&&this.shown?.method===
"counts"?this.lastStage:null}get halfway(){return this.lastStage?.generation===this.shown?.generation}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){
let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&this.working)}get nothingToRun(){let{document:e,shown:n,working:o}=this,s=n?.method==="propagate"&&
n.generation===this.generation&&!o,r=e?.method==="propagate"&&e.cells==="binary"&&e.poses==="logged";return s&&r?"Belief propagation is done and has no sweeps t\
o add; choose Gibbs to sample maps":""}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.
draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,n,this.
acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&this.everConnected&&!qh.has(e.type)&&jh(e))return this.
say(zh,"warning");if(e.type==="run"&&this.nothingToRun)return this.say(this.nothingToRun);let o={...e,seq:++this.seq};qh.has(e.type)||(this.acted=this.seq),Vi.has(
e.type)&&(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&ri(this.portableDocument()),
this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.
wallsVersion&&(this.packed={version:this.wallsVersion,text:Mn(Zn(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.
effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.
flicker.take(this.shown),!0)}painted(){this.counts.paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.
send({type:"painted",generation:e}),this.reported=e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.quantity??{kind:"\
binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){let n=this.
connection.connected;if(this.connection=e,e.connected){let o=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(
o),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.
text,this.notice.level),this.everConnected=!0}else this.everConnected&&(n&&this.say("Connection lost","error"),ri(this.portableDocument()));this.changed()}receive(e,n){
switch(e.type){case"welcome":this.generation=this.reported=-1,this.limits=e.limits,this.recorded=e.recorded,this.figure=e.figure,this.lacks=e.lacks,this.telling.
story=e.story??null,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":e.generation>=this.generation&&this.receiveScan(
e,n);break;case"overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(e,n);break;case"\
cell":this.evidence.receive(e,n);break;case"path":case"views":this.decisions.receive(e,n);break;case"ghost":this.ghost.receive(e,n);break;case"beam":this.reading.
receive(e);break;case"undecided":e.question==="ghost"?this.ghost.receive(e,n):e.question==="beam"?this.reading.receive(e):this.decisions.receive(e,n);break;case"\
status":this.status.say(e.text,e.level,this.acted);break;case"error":this.receiveRefusal(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"\
download":this.ondownload(e.name,e.mime,n.data),this.status.say(e.name===Mo?"Kept beside":`Saved ${e.name}${e.note&&`, ${e.note}`}`,"info",this.acted);break}this.
changed()}receiveScan({ids:e,index:n},{pose:o,angles:s,ranges:r,exact:i,hit:a}){this.scan?.index!==n&&this.reading.forget(),this.scan={ids:e,index:n,pose:o,angles:s,
ranges:r,exact:i,hit:a}}receiveRefusal({seq:e,text:n,remedy:o}){let s=e!==null&&e===this.broughtAt;s&&(this.broughtAt=null,this.act({type:"hello"}));let r=[n,o].
filter(Boolean).join("; ");this.status.say(s?`The map that was brought along cannot be shown: ${r}`:r,"error",this.acted),this.pending=this.pending.filter(i=>i.
seq!==e),e!==null&&this.latency.refused(e),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.
overlay=null,wl()),this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.
seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,
a=this.next??this.shown,l=n.reached,c=a&&a.p.length===o.length&&a.reached.every((h,u)=>h===l[u])?a.reached:l;this.next={...e,p:o,trace:s,traced:r,weights:i,reached:c},
this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==s.text||s.walls.
length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:wt(ht(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==s||
this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,
draw:a}=this.state.view;this.view={layer:r,chain:i??0,draw:a}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Yh(this,e),e.type===
"walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var lr=class{constructor(e){this.main=e}kept=null;draws={chains:0,count:0,kept:0};keep(){let{transport:e}=this.main;if(!e.record)return this.main.act({type:"exp\
ort",what:Mo});let n=e.record();n&&this.receive(n),this.main.changed()}forget(){this.kept=null,this.main.changed()}receive(e){this.draws=e[0].draws;let n=cs(e);
this.kept=new To(n,this.main.changed),n.open()}follow(){let{kept:e,main:n,draws:o}=this;if(!e)return;let{layer:s,chain:r}=n.view,i=Math.max(0,Math.min(r,o.chains-
1)),a=s==="draw"&&o.count?Math.round(n.draw*(o.count-1)/Math.max(1,o.kept-1)):null,{view:l}=e;(s!==l.layer||i!==l.chain||a!==l.draw)&&e.act({type:"view",layer:s,
chain:i,draw:a}),e.take()}differences(){let e=this.main.shown?.about??[],n=this.kept?.shown?.about??[],o=(s,r)=>s.filter(([i,a])=>!r.some(([l,c])=>l===i&&c===a)).
map(([i,a])=>`${i.toLowerCase()} ${a}`).join("; ");return[o(e,n),o(n,e)].map(s=>s||"the same model and method")}};var Kh='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Jh=`:host { display: block; height: 100dvh; container-type: size; }
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
.beside { position: absolute; inset: 0 0 0 50%; overflow: hidden; border-left: 1px solid var(--line); }
.tall > .beside { inset: 50% 0 0 0; border-left: 0; border-top: 1px solid var(--line); }
.told-apart { position: absolute; left: 0; bottom: 0; width: 100%; padding: 3px 10px; background: var(--card); color: var(--text); font-size: 12px; pointer-even\
ts: none; }
.shared > .told-apart { width: 50%; }
.shared.tall > .told-apart { width: 100%; bottom: 50%; }
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
.story { background: var(--tint); grid-template-columns: minmax(0, 1fr); }
.story .buttons { flex-wrap: wrap; }
@media (min-height: 700px) { .story .buttons { position: sticky; bottom: 0; padding: 4px 0; background: var(--tint); } } /* in view on a tall phone */
@media (max-width: 760px) { .story .told { display: grid; } .story p:not(.task) { order: 1; } } /* what to do comes before what is seen */
.story nav { display: flex; gap: 4px; }
.story nav a { flex: 1 1 0; min-width: 0; max-width: 40px; padding: 3px 0; border-radius: 6px; border: 1px solid var(--control); background: var(--card); color:\
 inherit; text-align: center; text-decoration: none; }
.story nav a:hover { border-color: var(--accent); }
.story nav a[aria-current=step] { background: var(--accent); border-color: var(--accent); color: var(--on-accent); font-weight: 600; }
.story h3 { font-size: 15px; margin-bottom: 3px; }
.story .task { margin-top: 6px; padding-left: 9px; border-left: 3px solid var(--accent); font-weight: 600; }
.story .task button { display: inline; height: auto; min-height: 0; padding: 0; border: 0; border-radius: 2px; background: none; color: var(--accent); font-weig\
ht: inherit; text-align: left; text-decoration: underline; text-underline-offset: 2px; white-space: normal; }
.named { border-radius: 6px; box-shadow: 0 0 0 2px var(--card), 0 0 0 4px var(--accent); }
.row.named, dl .named { box-shadow: 0 0 0 4px var(--card), 0 0 0 6px var(--accent); }
@container (min-width: 761px) and (min-height: 700px) { .story { position: sticky; top: 0; z-index: 3; max-height: 62cqh; overflow-y: auto; } } /* what a step a\
sks for is read beside what it asks to change */
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
.trace { width: 100%; border: 1px solid var(--line); border-radius: 4px; }
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
.verdict.early { border-color: var(--line); }
.verdict { min-height: 3em; font-size: 12.5px; padding-left: 9px; border-left: 3px solid var(--good); color: var(--soft); }
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
@container (max-width: 1360px) { .bar .segmented label { padding: 0 6px; gap: 4px; } .bar .segmented svg { width: 16px; } }
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
@container (max-width: 450px) { .bar { flex-wrap: wrap; } .bar .segmented label { padding: 0 9px; } }
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
  .bar .segmented label { min-height: 32px; padding: 0 11px; }
  .bar button { min-height: 30px; }
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
@media (forced-colors: active) { .story [aria-current=step], .segmented label:has(:checked), .named { outline: 2px solid Highlight; } }
`;var Zh="bayesmap-theme",Xh={auto:"light",light:"dark",dark:"auto"},cr=class{constructor(e,n){this.app=e;this.dressed=n;let o=Og();o&&o in Xh&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=vs.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?vs.dark:vs.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:c,ghost:h,belief:u}=n;for(let[d,m]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:l,draw:c,ghost:h,belief:u}))this.
app.style.setProperty(`--${d}`,m);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Xh[this.choice];try{localStorage.setItem(Zh,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function Og(){try{return localStorage.getItem(Zh)}catch{return null}}var Qh=12;function Jo(t,e,{embedded:n=!1,adopt:o=null,notice:s=null,play:r}={}){let i=t.shadowRoot??t.attachShadow({mode:"open"}),a=new CSSStyleSheet;a.replaceSync(
Kh+Jh),i.adoptedStyleSheets=[a],t.toggleAttribute("data-embedded",n);let l=0,c=()=>{l||=requestAnimationFrame(Wt)},h=new To(e,c,o,s);e.open();let u=new to,d=new ds(
h),m=new ps(h,d),w=new Qs(h),v=new lr(h),b=new Zs(h,d,m,Gt,z=>w.showLayer(z),n),M=[new io,new lo,new po,new ho,new Ts,new ks,new co,new so,new uo,new ao,new ws],
S=M.map(({name:z})=>k("canvas",{className:z})),E=S[S.length-1];Object.assign(E,{tabIndex:0,role:"application"});let P=new Uo(M,S);new ys(E,h,u,d,m,n);let D=new ms(
E,h,u,d,m),L={truth:!0,rays:!0,readings:!0,strokes:!0,trajectory:!0},O=dh(b),G=Ml(b),te={chip:Th(b),banner:Ah(b)},X=oi(),$=X.map(({name:z})=>k("canvas",{className:z})),
ee=new Uo(X,$),U=Pl(b,v),A=k("div",{className:"beside"},...$,U.kept),_=k("main",{className:"stage"},...S,U.now,te.chip,te.banner,A),B=()=>ot.theme,I=()=>u.transform.
scale,ie=yh(b,B,I),K=Eh(b);E.setAttribute("aria-describedby",K.readout.id);let J=lh(b),Q={help:ih(b),new:ah(b),share:J.dialog},[q,W,ue,de]=[Rh(b),$h(b),Fh(b),Ih(
b)],he=Uh(b,w,L,I);he.append(El(b,v));let ae=[Nh(b),rh(b),Hh(b),ph(b),ch(b),xh(b),Tl(b,oh(b,B),sh(b,B)),Bh(b),_h(b),he,q,W,Ph(b),ue,de],Fe=k("aside",{"aria-labe\
l":"Controls"},...ae),We=()=>h.recorded||h.document?.source.kind==="run";b.visible(q,()=>h.editable),b.visible(W,()=>!We()),b.visible(ue,()=>!We()),b.visible(de,
()=>!We());let ve=d.tool;b.each(()=>{ve!==d.tool&&(Fe.scrollTop=0),ve=d.tool,C(G,"inert",!h.document),C(Fe,"inert",!h.document)});let it=k("div",{className:"app"},
O.element,G,_,ie,Fe,K.element,...Object.values(Q));i.replaceChildren(it);let ot=new cr(it,z=>{O.nameTheme(z),c()}),Ne=()=>{let z=h.editable&&d.tool==="sensor"?d.
sensor?.id??null:null;return{session:h,view:u,look:{theme:ot.theme,...L,hover:d.hover,cursor:d.cursor,selected:z}}},{telling:Ie}=h,Ct=()=>{Ie.step&&d.choose(Ie.
step.tool)};Ie.onstep=z=>{Ct(),n||history.replaceState(null,"",location.pathname+location.search+Js(z))};let Lt=!1;function yn(){Lt=!0;let z=n||o?null:Wi(location.
hash);Ie.story&&z!==null?Ie.go(z):Ct()}let on="";function Wt(){l=0;let z=h.take();h.document&&!Lt&&yn(),h.document&&String(h.shape)!==on&&(on=String(h.shape),v.
kept&&String(v.kept.shape)!==on&&v.forget(),u.fit(h.shape),d.cursor=d.hover=null,h.decisions.forget(),h.evidence.forget(),h.ghost.refit(),E.setAttribute("aria-l\
abel",`Map, ${h.shape[0]} by ${h.shape[1]} cells`)),A.hidden===!!v.kept&&ze(),P.paint(Ne()),v.follow(),v.kept&&ee.paint({...Ne(),session:v.kept}),z&&(h.painted(),
w.step());let{x:re,y:me}=u.transform;te.chip.style.transform=`translate(${Math.max(re,tt.left)}px, ${Math.max(me-28,6)}px)`,nt(E,"data-tool",h.editable||Et.has(
d.tool)?d.tool:"pan"),b.refresh()}function ze(){let{width:z,height:re}=_.getBoundingClientRect();if(!z||!re)return!1;A.hidden=!v.kept;let me=re>z;_.classList.toggle(
"shared",!A.hidden),_.classList.toggle("tall",me);let st=A.hidden?1:.5;return u.resize(me?z:st*z,me?st*re:re,devicePixelRatio||1),u.fitted&&u.fit(h.shape),!0}let Jt=new ResizeObserver(
()=>{ze()&&(cancelAnimationFrame(l),Wt())});Jt.observe(_);function Nt([z,re]){let{scale:me}=u.transform;me<Qh&&u.zoom(Qh/me,u.middle,h.shape);let st=u.fromGrid(
{x:z+.5,y:re+.5},h.shape[1]);u.pan(u.middle.x-st.x,u.middle.y-st.y,h.shape),D.focus(),d.setCursor({x:z,y:re})}async function Gt(z){if(z==="in"||z==="out")u.zoom(
z==="in"?1.4:1/1.4,u.middle,h.shape);else if(z==="fit")u.fit(h.shape);else if(z.startsWith("cell "))Nt(z.slice(5).split(",").map(Number));else if(z==="help")Q.help.
showModal();else if(z==="new")Q.new.showModal();else if(z==="theme")ot.next();else if(z==="add")D.addSensor();else if(z==="share"){let re=h.portableDocument();re&&
J.show(location.href.replace(/[?#].*/,"")+await Ha(re))}else if(z==="export png"){let re=await fl(Ne());re&&Qr("bayesmap.png",re),h.say("Saved bayesmap.png")}else
z.startsWith("export ")&&h.act({type:"export",what:z.slice(7)});c()}h.ondownload=(z,re,me)=>z===Mo?v.receive(pn(me.slice().buffer)):Qr(z,new Blob([me],{type:re}));
let De=[[n?t:window,"keydown",z=>{z.defaultPrevented||!h.document||Object.values(Q).some(re=>re.open)||tl(z,h,{tool:re=>{d.choose(re),D.focus()},layer:re=>w.showLayer(
re),command:Gt})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{if(n)return;let{document:z,damaged:re}=await Fo(),me=Wi(location.hash);z?h.bring(
z):Ie.story&&me!==null?Ie.go(me):re&&h.say($o,"error")}],[t,"dragover",z=>z.preventDefault()],[t,"drop",z=>{z.preventDefault();let re=z.dataTransfer?.files[0];re&&
za(re,h,r)}]];for(let[z,re,me]of De)z.addEventListener(re,me);return ot.dress(),{destroy(){Jt.disconnect(),cancelAnimationFrame(l),ot.destroy();for(let[z,re,me]of De)
z.removeEventListener(re,me);e.close(),i.replaceChildren()},snapshot:()=>Vh(h,u,P,v),cellToClient(z,re){let me=E.getBoundingClientRect(),st=u.fromGrid({x:z+.5,y:re+
.5},h.shape[1]);return{x:me.left+st.x,y:me.top+st.y}}}}var Ug=200,Bg=.2,je=class extends Error{},ep=({grid:t,walls:e})=>wt(ht(e),t.shape[0]*t.shape[1]);function tp({grid:t},{x:e,y:n}){let[o,s]=[Math.floor((e-t.origin[0])/
t.resolution),Math.floor((n-t.origin[1])/t.resolution)];return o>=0&&o<t.shape[0]&&s>=0&&s<t.shape[1]?o*t.shape[1]+s:null}function ji(t,e){let n=tp(t,e);if(n===
null)throw new je("the sensor cannot stand outside the map");if(ep(t)[n])throw new je("the sensor cannot stand in a wall; move it to a free cell");return{...e,yaw:e.
yaw-2*Math.PI*Math.round(e.yaw/(2*Math.PI))}}function np(t,e,n){switch(e.type){case"set":return[zi({...t,...e.patch},t,n),""];case"walls":return Wg(t,e.cells,e.
wall);case"clear":return e.what==="walls"?[{...t,walls:op(t.grid.shape)},""]:null;case"add_sensor":{if(t.sensors.length>=n.sensors[1])throw new je(`there are ${t.
sensors.length} sensors already; remove one first`);let o=Math.max(...t.sensors.map(s=>s.id))+1;return[{...t,sensors:[...t.sensors,ji(t,{id:o,x:e.x,y:e.y,yaw:e.
yaw??0})]},""]}case"move_sensor":{let o=s=>ji(t,{id:s.id,x:e.x??s.x,y:e.y??s.y,yaw:e.yaw??s.yaw});return[{...t,sensors:t.sensors.map(s=>s.id===e.id?o(s):s)},""]}case"\
remove_sensor":{let o=t.sensors.filter(s=>s.id!==e.id);if(!o.length)throw new je("the last sensor cannot be removed; add another first");return[{...t,sensors:o},
""]}case"new":return[Gg(t,e.shape,e.world),""];default:return null}}var op=([t,e])=>Mn(new Uint8Array(t*e+7>>3));function Wg(t,e,n){let o=ep(t),s=t.grid.shape[1];
for(let[i,a]of e)o[i*s+a]=n?1:0;let r="";for(let i of t.sensors){let a=tp(t,i);o[a]&&(r=`a sensor stands in cell (${Math.floor(a/s)}, ${a%s}): it stays free`),o[a]=
0}return[{...t,walls:Mn(Zn(o))},r]}function Gg(t,e,n){if(n!=="blank")throw new je("this figure can begin blank maps alone; bayesmap app has others");let[o,s]=e.
map(i=>Math.floor((i-1)/2));return{...t,grid:{shape:e,resolution:1,origin:[-.5,-.5]},walls:op(e),sensors:[{id:1,x:o,y:s,yaw:0}],noise:Bg,max_range:2*Math.max(...e)}}
function zi(t,e,n){let o=t;for(let[h,u]of Object.entries(e)){let d=o[h];if(u!==null&&(typeof d!=typeof u||d===null))throw new je(`${h} is missing, or of another\
 type`);let m=n[h];if(m&&typeof d=="number"&&!(d>=m[0]&&d<=m[1]))throw new je(`${h}: ${d}; give ${m[0]} to ${m[1]}`)}let{grid:s,source:r,sensors:i,walls:a}=o;if(r.
kind!=="simulation")throw new je("this figure shows drawn maps alone; start bayesmap app with the file");if(o.cells!=="binary"||o.pose_sigma>0||o.heading_sigma>
0)throw new je("this figure samples walls seen from known poses alone; bayesmap app samples others");if(o.method==="propagate")throw new je("this figure has no \
belief propagation; choose another method");let[l,c]=n.side;if(!(s.shape.length===2&&s.shape.every(h=>Number.isInteger(h)&&h>=l&&h<=c)&&s.resolution>0))throw new je(
`grid: give ${l} to ${c} cells a side`);if(ht(a).length!==s.shape[0]*s.shape[1]+7>>3)throw new je("walls: another number of cells than the grid's");if(!(i.length>=
n.sensors[0]&&i.length<=n.sensors[1]))throw new je(`sensors: give ${n.sensors[0]} to ${n.sensors[1]}`);return{...o,sensors:i.map(h=>ji(o,h))}}function Hg(t){return t.
type==="walls"&&t.stroke?`walls ${t.stroke}`:t.type==="set"&&t.drag?`set ${t.drag} ${Object.keys(t.patch).sort()}`:t.type==="move_sensor"&&t.drag?`move ${t.drag}\
 ${t.id}`:null}var hr=class{constructor(e){this.present=e}past=[];future=[];gesture=null;get canUndo(){return this.past.length>0}get canRedo(){return this.future.
length>0}push(e,n){let o=Hg(n);(o===null||o!==this.gesture)&&(this.past.push(this.present),this.past.length>Ug&&this.past.shift()),this.future=[],this.gesture=o,
this.present=e}step(e){let[n,o]=e?[this.past,this.future]:[this.future,this.past],s=n.pop();return s?(o.push(this.present),this.present=s,this.gesture=null,!0):
!1}};var Vg=11102230246251565e-32,sp=2**32,rp=1,ip=2,ap=3;function Yi(t,e,n){let{high:o,low:s}=t,r=s&65535,i=s>>>16,a=n&65535,l=n>>>16,c=r*a,h=i*a+(c>>>16),u=r*l+(h&
65535),d=i*l+(h>>>16)+(u>>>16);t.low=((u&65535)<<16|c&65535)>>>0,t.high=d+Math.imul(o,n)+Math.imul(s,e)>>>0}function qi(t,e){let{high:n,low:o}=t;t.low=(o^(o>>>e|
n<<32-e))>>>0,t.high=(n^n>>>e)>>>0}function Bt(t,e,n){let o=e+1;n.high=Math.floor(o/sp)>>>0,n.low=o>>>0,Yi(n,2654435769,2135587861);let s=n.low+t.low;n.high=n.high+
t.high+(s>=sp?1:0)>>>0,n.low=s>>>0,qi(n,30),Yi(n,3210233709,484763065),qi(n,27),Yi(n,2496678331,321982955),qi(n,31)}var Ji=({high:t,low:e})=>t*2097152+(e>>>11),
Rn=t=>(Ji(t)+.5)*Vg;function gn(...t){let e=o=>BigInt.asUintN(64,o),n=0n;for(let o of t){let s=e((n^BigInt(o))+0x9e3779b97f4a7c15n);s=e((s^s>>30n)*0xbf58476d1ce4e5b9n),
s=e((s^s>>27n)*0x94d049bb133111ebn),n=s^s>>31n}return{high:Number(n>>32n),low:Number(n&0xffffffffn)}}var Ki=2654435761,jg=2246822507;function pr(t,e){let n=Math.
imul(t+e,Ki);return n=Math.imul(n^n>>>15,jg),n^n>>>13}function lp(t,e,n,o){let s=n>>>1,r=(1<<s)-1,i=(1<<n-s)-1,a=t;do{let l=a>>>s,c=a&r;l^=pr(c,o.low)&i,c^=pr(l,
o.high)&r,l^=pr(c,o.low^Ki)&i,c^=pr(l,o.high^Ki)&r,a=(l<<s|c)>>>0}while(a>=e);return a}var cp=t=>Math.max(2,32-Math.clz32(t-1));function dr(t,e){let n={high:0,low:0};
Bt(t,e,n);let o=Rn(n);return Bt(t,e+1,n),Math.sqrt(-2*Math.log(o))*Math.cos(2*Math.PI*Rn(n))}var zg=2**53,hp=20,pp=1e15,[ur,Xi,dp]=[0,1,2],mr=class{constructor(e){this.p=e;let n=e*zg,o=Math.round(n);this.level=o-n===.5&&o%2?o-1:o,this.logit=Math.min(Math.
max(Math.log(e)-Math.log1p(-e),-pp),pp)}level;logit;draws(e){return Ji(e)<this.level}logProb(e){if(this.p===0||this.p===1)return 0;let n=0;for(let o of e)n+=o;return e.
length*Math.log1p(-this.p)+n*this.logit}};function fr(t,e){return t>40?!0:t<-40?!1:e*(1+Math.exp(-t))<1}function Zi({order:t,shuffle:e},n,o){if(!e)return i=>t[i];
let s=cp(t.length),r={high:0,low:0};return Bt(n,-1-o,r),i=>t[lp(i,t.length,s,r)]}var gr=class{constructor(e,n,o){this.problem=e;this.walls=n;this.key=o;let{offsets:s,
cells:r,noHit:i}=e.table;this.first=new Int32Array(i.length),this.current=new Float32Array(i.length),this.reached=new Int32Array(n.length),this.gain=new Float32Array(
n.length),this.known=new Uint8Array(n.length);for(let a=0;a<i.length;a++){let l=this.nextWall(s[a],s[a+1]);this.first[a]=l,this.current[a]=this.entryLoglik(a,l);
for(let c=s[a];c<Math.min(l+1,s[a+1]);c++)this.reached[r[c]]++}}first;current;reached;gain;known;bits={high:0,low:0};nextWall(e,n){let{cells:o}=this.problem.table,
s=e;for(;s<n&&!this.walls[o[s]];)s++;return s}entryLoglik(e,n){let{offsets:o,loglik:s,noHit:r}=this.problem.table;return n<o[e+1]?s[n]:r[e]}logLikelihood(){let e=0;
for(let n of this.current)e+=n;return e}moveFirst(e,n){let{offsets:o,cells:s}=this.problem.table,r=o[e+1],i=this.first[e];this.first[e]=n,this.current[e]=this.entryLoglik(
e,n);let a=Math.min(i,n);for(let c=o[e];c<Math.min(a+1,r);c++)this.known[s[c]]=ur;let l=n>i?1:-1;for(let c=a+1;c<Math.min(Math.max(i,n)+1,r);c++)this.known[s[c]]=
ur,this.reached[s[c]]+=l}put(e){let{offsets:n,beam:o,entry:s}=this.problem.index;this.walls[e]=1;for(let r=n[e];r<n[e+1];r++)this.first[o[r]]>s[r]&&this.moveFirst(
o[r],s[r])}remove(e){let{table:n,index:o}=this.problem;this.walls[e]=0;for(let s=o.offsets[e];s<o.offsets[e+1];s++){let r=o.beam[s],i=o.entry[s];this.first[r]===
i&&this.moveFirst(r,this.nextWall(i+1,n.offsets[r+1]))}}sweep(e,n){let{prior:o}=this.problem,s=e.order.length,r=Zi(e,this.key,n);for(let i=0;i<s;i++){let a=r(i);
Bt(this.key,n*s+a,this.bits),this.reached[a]?this.walls[a]?this.stays(a,Rn(this.bits))||this.remove(a):this.becomes(a,Rn(this.bits))&&this.put(a):this.walls[a]=
o.draws(this.bits)?1:0}}becomes(e,n){let{logit:o}=this.problem.prior;return this.known[e]===ur&&this.sumGain(e,-hp-o),fr(o+this.gain[e],n)?this.known[e]===dp?!0:
(this.sumGain(e,-1e300),fr(o+this.gain[e],n)):!1}sumGain(e,n){let{offsets:o,beam:s,entry:r,loglik:i,gainBound:a}=this.problem.index,l=0,c=dp;for(let h=o[e];h<o[e+
1];h++){let u=l+a[h];if(u<n){l=u,c=Xi;break}this.first[s[h]]>r[h]&&(l+=Math.fround(i[h]-this.current[s[h]]))}this.gain[e]=l,this.known[e]=c}stays(e,n){let{table:o,
index:s,prior:r}=this.problem;if(this.known[e]===ur){let l=0;for(let c=s.offsets[e];c<s.offsets[e+1];c++)this.first[s.beam[c]]===s.entry[c]&&(l+=s.advantage[c]);
this.gain[e]=l,this.known[e]=Xi}let i=r.logit+this.gain[e];if(this.known[e]===Xi&&i>hp&&fr(i,n))return!0;let a=0;for(let l=s.offsets[e];l<s.offsets[e+1];l++){let c=s.
beam[l],h=s.entry[l];this.first[c]===h&&(a+=Math.fround(s.loglik[l]-this.entryLoglik(c,this.nextWall(h+1,o.offsets[c+1]))))}return fr(r.logit+a,n)}};var Yg=8,qg=-1e300,Kg=2**53;function Qi(t,e,n,o){let s=Math.floor(t/o)-e,r=t%o-n;return s<0||s>1||r<0||r>1?-1:2*s+r}function up({table:t,shape:[e,n]}){let{offsets:o,
cells:s,noHit:r}=t,i=Math.max(1,e-1),a=Math.max(1,n-1),l=Array.from({length:i*a},()=>[]);for(let d=0;d<r.length;d++)for(let m=o[d];m<o[d+1];m++)for(let w=0;w<4;w++){
let v=Math.floor(s[m]/n)-(w>>1),b=s[m]%n-(w&1);if(v<0||v>=i||b<0||b>=a)continue;let M=l[v*a+b],S=M[M.length-1];S?.b===d&&S.last>=m-Yg?S.last=m:M.push({b:d,first:m,
last:m})}let c=new Int32Array(l.length+1);l.forEach((d,m)=>c[m+1]=c[m]+d.length);let h=l.flat(),u=d=>Int32Array.from(h,m=>m[d]);return{offsets:c,beam:u("b"),first:u(
"first"),last:u("last"),rows:a}}function fp(t,e,n,o){let{prior:s,shape:[r,i]}=t.problem,{rows:a}=e,l=n.order.length,c=Zi(n,t.key,o),h=new Float64Array(16),u=new Float64Array(
16),d={high:0,low:0};for(let m=0;m<l;m++){let w=c(m),v=Math.floor(w/a),b=w%a,M=4*(o*l+w),S=D=>v+(D>>1)<r&&b+(D&1)<i?(v+(D>>1))*i+b+(D&1):-1,E=0;for(let D=0;D<4;D++)
S(D)>=0&&(E+=t.reached[S(D)]);if(!E){for(let D=0;D<4;D++)S(D)<0||(Bt(t.key,M+D,d),t.walls[S(D)]=s.draws(d)?1:0);continue}Jg(t,e,w,v,b,h),u.fill(0);for(let D=0;D<
4;D++){let L=S(D)<0||s.level===0,O=!L&&s.level===Kg;for(let G=0;G<16;G++)(G>>D&1)===(O?0:1)&&(u[G]+=L||O?qg:s.logit)}for(let D=0;D<16;D++)h[D]+=u[D];Bt(t.key,M,
d);let P=Xg(h,Rn(d));for(let D=0;D<4;D++){let L=S(D);L<0||(P>>D&1?t.walls[L]||t.put(L):t.walls[L]&&t.remove(L))}}}function Jg(t,e,n,o,s,r){let{table:i,shape:[,a]}=t.
problem,{offsets:l,cells:c,loglik:h}=i;r.fill(0);for(let u=e.offsets[n];u<e.offsets[n+1];u++){let d=e.beam[u],m=t.first[d],w=e.first[u];if(m<w)continue;let v=e.
last[u],b=l[d+1],M=m;if(m<=v&&m<b&&Qi(c[m],o,s,a)>=0)for(M=m+1;M<b&&!(t.walls[c[M]]&&Qi(c[M],o,s,a)<0);)M++;let S=t.entryLoglik(d,M),E=0;for(let P=w;P<Math.min(
v+1,M);P++){let D=Qi(c[P],o,s,a);if(D<0)continue;let L=Math.fround(h[P]-S);for(let O=0;O<16;O++)O>>D&1&&!(O&E)&&(r[O]+=L);E|=1<<D}}}function Xg(t,e){let n=Math.
max(...t),o=t.map(r=>r>n-40?Math.exp(r-n):0),s=e*o.reduce((r,i)=>r+i,0);for(let r=0;r<16;r++)if(s-=o[r],s<=0&&o[r]>0)return r;return 15}function $n(t){let e=0;for(let n=0;n<t.length;n++)e+=t[n];return e/t.length}var ea=t=>{let e=$n(t);return t.reduce((n,o)=>n+(o-e)**2,0)/(t.length-1)},yr=(t,e)=>t.
reduceRight((n,o)=>n*e+o,0),mp=[[3.3871328727963665,133.14166789178438,1971.5909503065513,13731.69376550946,45921.95393154987,67265.7709270087,33430.57558358813,
2509.0809287301227],[1,42.31333070160091,687.1870074920579,5394.196021424751,21213.794301586597,39307.89580009271,28729.085735721943,5226.495278852854]],gp=[[1.4234371107496835,
4.630337846156546,5.769497221460691,3.6478483247632045,1.2704582524523684,.2417807251774506,.022723844989269184,.0007745450142783414],[1,2.053191626637759,1.6763848301838038,
.6897673349851,.14810397642748008,.015198666563616457,.0005475938084995345,10507500716444169e-25]];function Zg(t){let e=t-.5;if(Math.abs(e)<=.425){let o=.180625-
e*e;return e*yr(mp[0],o)/yr(mp[1],o)}let n=Math.sqrt(-Math.log(e<0?t:1-t))-1.6;return Math.sign(e)*yr(gp[0],n)/yr(gp[1],n)}function Qg(t){let e=t[0].length>>1;return[
...t.map(n=>n.slice(0,e)),...t.map(n=>n.slice(n.length-e))]}function yp(t){let e=Float64Array.from(t.flat()).sort(),n=new Map;for(let o=0;o<e.length;){let s=o+1;
for(;s<e.length&&e[s]===e[o];)s++;n.set(e[o],Zg(((o+1+s)/2-.375)/(e.length+.25))),o=s}return t.map(o=>o.map(s=>n.get(s)))}function wp(t){let e=t[0].length;return Math.
sqrt((e-1)/e+ea(t.map($n))/$n(t.map(ea)))}function bp(t,e){let n=t.length;for(let o=1,s=0;o<n;o++){let r=n>>1;for(;s&r;r>>=1)s^=r;s^=r,o<s&&([t[o],t[s],e[o],e[s]]=
[t[s],t[o],e[s],e[o]])}for(let o=2;o<=n;o*=2)for(let s=0;s<o/2;s++){let r=-2*Math.PI*s/o,[i,a]=[Math.cos(r),Math.sin(r)];for(let l=s;l<n;l+=o){let c=l+o/2,[h,u]=[
t[c]*i-e[c]*a,t[c]*a+e[c]*i];[t[c],e[c]]=[t[l]-h,e[l]-u],t[l]+=h,e[l]+=u}}}function ey(t){let e=t.length,n=$n(t),o=2**Math.ceil(Math.log2(2*e)),[s,r]=[new Float64Array(
o),new Float64Array(o)];t.forEach((i,a)=>s[a]=i-n),bp(s,r);for(let i=0;i<o;i++)[s[i],r[i]]=[s[i]**2+r[i]**2,0];return bp(s,r),s.slice(0,e).map(i=>i/o/e)}function ty(t){
let[e,n]=[t.length,t[0].length],o=t.map(ey),s=$n(o.map(h=>h[0]))*n/(n-1),r=s*(n-1)/n+ea(t.map($n)),i=h=>h?1-(s-$n(o.map(u=>u[h])))/r:1,a=Math.max(1,Math.ceil((n-
2)/2)),l=-1,c=1/0;for(let h=0;h<a;h++){let u=i(2*h),d=u+i(2*h+1);if(!(d>0)||h===a-1){l+=d>0?u:Math.max(u,0);break}c=Math.min(c,d),l+=2*c}return e*n/Math.max(l,1/
Math.log10(e*n))}function xp(t){if(t[0].length<4||t.every(c=>c.every(h=>h===t[0][0])))return null;let e=Qg(t),n=Float64Array.from(e.flat()).sort(),o=(n[n.length-
1>>1]+n[n.length>>1])/2,s=e.map(c=>c.map(h=>Math.abs(h-o))),r=yp(e),[i,a]=[wp(r),wp(yp(s))];return{rhat:Number.isNaN(a)?i:Number.isNaN(i)?a:Math.max(i,a),ess:ty(
r)}}function vp({table:t,prior:e,shape:n},o,s,r){let{offsets:i,cells:a,loglik:l,noHit:c}=t,h=n[0]*n[1],u={high:0,low:0},d=new Int8Array(h);return Float64Array.from(
{length:r},(m,w)=>{d.fill(0);let v=0;for(let b=0;b<c.length;b++){let M=c[b];for(let S=i[b];S<i[b+1];S++){let E=a[S];if(d[E]||(Bt(o,(s+w)*h+E,u),d[E]=e.draws(u)?
1:-1),d[E]>0){M=l[S];break}}v+=M}return v})}function ta({prior:t,shape:e},n,o){let s=e[0]*e[1],r={high:0,low:0};return Uint8Array.from({length:s},(i,a)=>(Bt(n,o*
s+a,r),t.draws(r)?1:0))}function kp(t){let e=t.reduce((r,i)=>Math.max(r,i),-1/0),n=e+Math.log(t.reduce((r,i)=>r+Math.exp(i-e),0)),o=t.map(r=>r-n),s=o.reduce((r,i)=>r+
Math.exp(2*i),0);return{logWeights:o,logEvidence:n-Math.log(t.length),effectiveSampleSize:1/s}}var na=(t,e)=>e>0?Math.ceil(t-1e-9)-1:Math.floor(t+1e-9),oa=t=>Math.abs(t)<1e-10?0:t>0?1:-1,wr=class{constructor({x:e,y:n,ux:o,uy:s},r,i,a){this.nx=r;this.ny=i;
this.stepX=oa(o),this.stepY=oa(s);let l=0,c=a;this.stepX?(this.gapX=1/Math.abs(o),l=Math.max(l,Math.min(-e/o,(r-e)/o)),c=Math.min(c,Math.max(-e/o,(r-e)/o))):(e<
-1e-9||e>r+1e-9)&&(c=-1),this.stepY?(this.gapY=1/Math.abs(s),l=Math.max(l,Math.min(-n/s,(i-n)/s)),c=Math.min(c,Math.max(-n/s,(i-n)/s))):(n<-1e-9||n>i+1e-9)&&(c=
-1),this.end=c+1e-9,this.x=na(e+(this.stepX?l*o:0),this.stepX),this.y=na(n+(this.stepY?l*s:0),this.stepY),this.stepX&&(this.nextX=(this.x+Math.max(this.stepX,0)-
e)/o),this.stepY&&(this.nextY=(this.y+Math.max(this.stepY,0)-n)/s),!this.stepX&&Math.abs(e-this.x)<=1e-9&&(this.alongLine=1,this.sideX=-1),!this.stepY&&Math.abs(
n-this.y)<=1e-9&&(this.alongLine=2,this.sideY=-1),this.cellX=this.x,this.cellY=this.y,this.sides=this.alongLine,this.distance=Math.max(0,Math.min(this.nextX,this.
nextY))}cellX;cellY;distance;end;x;y;sides;sideX=0;sideY=0;alongLine=0;stepX;stepY;nextX=1e300;nextY=1e300;gapX=1e300;gapY=1e300;get over(){return this.distance>
this.end}get inside(){return this.cellX>=0&&this.cellX<this.nx&&this.cellY>=0&&this.cellY<this.ny}next(){if(this.sides&1){this.cellX=this.x+this.sideX,this.cellY=
this.y,this.sides&=2;return}if(this.sides){this.cellX=this.x,this.cellY=this.y+this.sideY,this.sides=0;return}let e=this.nextX<this.nextY-1e-9,n=this.nextY<this.
nextX-1e-9;this.distance=e?this.nextX:n?this.nextY:Math.min(this.nextX,this.nextY),this.sides=this.alongLine,e===n&&(this.sideX=-this.stepX,this.sideY=-this.stepY,
this.sides=3),n||(this.nextX+=this.gapX,this.x+=this.stepX),e||(this.nextY+=this.gapY,this.y+=this.stepY),this.cellX=this.x,this.cellY=this.y}};function br(t,[e,
n],o,s){for(let r=new wr(o,e,n,s);!r.over;r.next())if(r.inside&&t[r.cellX*n+r.cellY])return Math.min(r.distance,s);return s}function Sp([t,e],n,o){let s=[],r=new Int32Array(
n.length+1);return n.forEach((i,a)=>{for(let l=new wr(i,t,e,o);!l.over;l.next())l.inside&&s.push(l.cellX*e+l.cellY);r[a+1]=s.length}),{offsets:r,cells:Int32Array.
from(s)}}function Mp({x:t,y:e,ux:n,uy:o},s,r){let i=Math.floor(s/r),a=s-i*r,l=0,c=1e300,h=!0,u=(d,m,w)=>{let v=oa(m);if(!v)return;let b=1/m,M=w+(v>0?0:1)-d;l=Math.
max(l,M*b),c=Math.min(c,(M+v)*b),h&&=w===na(d,v)};return u(t,n,i),u(e,o,a),h?Math.max(c,0):l}var ny=Math.fround(.001),oy=-.5*Math.log(2*Math.PI);function Tp(t,e,n,o,s,r){let{offsets:i,cells:a}=t,l=o.sigma_m*o.sigma_m,c=.5*Math.log(l),h=(m,w)=>{let v=m-Math.
min(w,o.max_m);return oy-.5*(v*v/l)-c},u=new Float32Array(a.length),d=new Float32Array(e.length);for(let m=0;m<e.length;m++){d[m]=h(n[m],1/0);for(let w=i[m];w<i[m+
1];w++)u[w]=h(n[m],Mp(e[m],a[w],s)*r)}return{offsets:i,cells:a,loglik:u,noHit:d}}function Ap({offsets:t,cells:e,loglik:n,noHit:o},s){let r=Float32Array.from(o),
i=new Float32Array(e.length);for(let d=0;d<o.length;d++){let m=o[d];for(let w=t[d+1]-1;w>=t[d];w--)i[w]=n[w]-m,m=Math.max(m,n[w]),r[d]=Math.min(r[d],n[w])}let a=new Int32Array(
s+1);for(let d of e)a[d+1]++;for(let d=0;d<s;d++)a[d+1]+=a[d];let l=()=>new Float32Array(e.length),c=()=>new Int32Array(e.length),h={offsets:a,entry:c(),beam:c(),
loglik:l(),gainBound:l(),advantage:l()},u=a.slice();for(let d of[!0,!1])for(let m=0;m<o.length;m++)for(let w=t[m];w<t[m+1];w++){let v=Math.fround(n[w]-r[m]);if(v>
ny!==d)continue;let b=u[e[w]]++;h.entry[b]=w,h.beam[b]=m,h.loglik[b]=n[w],h.gainBound[b]=v,h.advantage[b]=i[w]}for(let d=0;d<s;d++)for(let m=a[d+1]-2;m>=a[d];m--)
h.gainBound[m]+=h.gainBound[m+1];return h}function Xo({angles:t,fov:e}){let n=e*(180/Math.PI);if(n===360)return Float64Array.from({length:t},(s,r)=>r*2*Math.PI/t);let o=n/(t-t%2);return Float64Array.from(
{length:t},(s,r)=>(o*r-n/2)*(Math.PI/180))}function Ep(t){let{origin:e,resolution:n}=t.grid,o=[...Xo(t)];return t.sensors.flatMap(({x:s,y:r,yaw:i})=>o.map(a=>({
x:(s-e[0])/n,y:(r-e[1])/n,ux:Math.cos(i+a),uy:Math.sin(i+a)})))}function Pp({grid:t,walls:e,max_range:n},o){let s=wt(ht(e),t.shape[0]*t.shape[1]),r=n/t.resolution;
return Float64Array.from(o,i=>Math.min(br(s,t.shape,i,r)*t.resolution,n))}function _p({grid:t,noise:e,prior:n,max_range:o},s,r){let{shape:i,resolution:a}=t,l=Sp(
i,s,o/a),c=Tp(l,s,r,{sigma_m:e,max_m:o},i[1],a);return{table:c,index:Ap(c,i[0]*i[1]),prior:new mr(n),shape:i}}function Cp({grid:t,sensors:e,order:n},o){let[s,r]=t.
shape,[i,a]=o?[Math.max(1,s-1),Math.max(1,r-1)]:[s,r],l=Int32Array.from({length:i*a},(d,m)=>m);if(n!=="radial")return{order:l,shuffle:n==="random"};let c=(d,m)=>Math.
min(Math.max(d,0),m-1),h=e.map(({x:d,y:m})=>[c(Math.floor((d-t.origin[0])/t.resolution),s),c(Math.floor((m-t.origin[1])/t.resolution),r)]),u=l.map(d=>Math.min(...h.
map(([m,w])=>Math.abs(Math.floor(d/a)-m)+Math.abs(d%a-w))));return{order:Int32Array.from([...l].sort((d,m)=>u[d]-u[m]||d-m)),shuffle:!1}}var nn=2,Lp=32,sy=300,ry=100,iy=64<<20,ay=.1,ly=16,cy=40,sa=24,Np=[.1,.3,.5,.7,.9],$p={chains:0,count:0},hy={gibbs:"Gibbs sampling, cell by cell",block:"Gibbs s\
ampling, 2 x 2 blocks",importance:"importance sampling",none:"none yet: this is the prior"},Ao=()=>performance.now(),Dp=t=>Uint8Array.from(t,e=>Math.round(255*e)),
Rp=t=>String(+t.toPrecision(4)),Eo=class{constructor(e,n){this.document=e;this.problem=n;this.cells=n.shape[0]*n.shape[1]}done=!1;seconds=0;method="none";cells;work(e){
let n=Ao();do this.step();while(!this.done&&Ao()-n<e);this.seconds+=(Ao()-n)/1e3}step(){this.done=!0}get draws(){return $p}beamsThrough(e){let{offsets:n}=this.problem.
index;return n[e+1]-n[e]}mean(){return new Float64Array(this.cells).fill(this.document.prior)}reached(){return new Uint8Array(this.cells)}get logJoint(){return[]}figures(e){
return{sweeps:0,total:0,ess:null,rhat:null,log_joint:null,verdict:null,burned:0}}draw(e){return null}weights(){return null}picture(e,n,o,s){let{document:r,method:i}=this,
a=e.layer==="draw"?this.draw(e):null,l=this.weights(),c=i==="gibbs"?`, ${r.order} order`:"",h={type:"field",generation:n,milliseconds:o,layer:a?"draw":"mean",method:i,
approximate:!1,...this.figures(s),draws:this.draws,quantity:{kind:"binary",mean:"P(wall)",value:"wall",interval:!1},chain:null,draw:null,averaged:null,lowest:l?.
lowest??null,seconds:i==="none"?null:this.seconds,about:[["Method",hy[i]+c],["Prior",`independent: p wall ${Rp(r.prior)}`],["Sensor",`gaussian: sigma ${Rp(r.noise)}\
 m`],["Poses","known"],["Computed","in this page"]],...a&&{chain:a.chain,draw:a.draw,log_joint:a.log_joint}},u=Dp(a?a.map:this.mean());return[h,{p:u,reached:Dp(
this.reached()),...this.trace(),...l&&{weights:l.weights}}]}recording(e){let{document:n}=this,{chains:o,count:s}=this.draws,[r,i]=this.picture({layer:"mean",chain:0,
draw:null},1,0,!0),a=Uint32Array.from({length:this.cells},(u,d)=>this.beamsThrough(d)),{log_joint:l,draws:c}=this.recorded(),h=n.sensors.map(({id:u})=>u);return[
{version:1,document:n,field:r,ids:h,draws:{chains:o,count:s,kept:s,bits:!0},log_joint:l},{...i,...e,beams:a,draws:c}]}recorded(){return{log_joint:[],draws:new Uint8Array(
0)}}trace(){let e=this.logJoint,n=e[0]?.length??0,o=Math.min(n,sy),s=Array.from({length:o},(a,l)=>Math.round(o>1?1+l*(n-1)/(o-1):1)),r=Array.from({length:Math.min(
n,ry)},(a,l)=>l+1),i=[...new Set([...r,...s])].sort((a,l)=>a-l);return{trace:Float32Array.from(e.flatMap(a=>i.map(l=>a[l-1]))),traced:Float32Array.from(i)}}},Zo=class extends Eo{constructor(n,o,s,r){
super(n,o);this.judging=s;let{seed:i,start:a,sweeps:l}=n;this.method=r?"block":"gibbs",this.blocks=r?up(o):null,this.sites=Cp(n,r),this.thin=Math.ceil(l*nn*Math.
ceil(this.cells/8)/iy),this.chains=Array.from({length:nn},(c,h)=>{let d=a==="empty"&&n.prior<1?new Uint8Array(this.cells):ta(o,gn(i,h,ip),0);return new gr(o,d,gn(
i,h,rp))}),this.touched=new Uint8Array(this.cells);for(let c of o.table.cells)this.touched[c]=1;this.present={sweep:0,sums:this.chains.map(()=>new Float64Array(
this.cells)),reached:new Uint32Array(this.cells),looks:0},this.past=[this.copy()],this.goOn(l)}chains;blocks;sites;lookAt=new Set;touched;joint=Array.from({length:nn},
()=>[]);likelihood=Array.from({length:nn},()=>[]);kept=Array.from({length:nn},()=>[]);thin;total=0;sweep=0;present;past;diagnosis=null;diagnosed=0;diagnoseAt=0;goOn(n){
let{lookAt:o,document:s}=this;this.total=Math.ceil((this.total+n)/this.thin)*this.thin,o.add(Math.floor(s.burn_in*this.total));for(let r=1;r<=this.total;r*=2)o.
add(r);for(let r=1;r<=Lp;r++)o.add(Math.floor(this.total*r/Lp));this.done=!1,this.diagnoseAt=0}burn(n){let o=Math.floor(n/this.thin),s=this.kept.map(r=>{let i=new Float64Array(
this.cells);for(let a of r.slice(0,o))wt(a,this.cells).forEach((l,c)=>i[c]+=l);return i.map(a=>a*n/Math.max(1,o))});this.past=[{...this.past[0],sweep:n,sums:s}]}copy(){
let{sums:n,reached:o,looks:s}=this.present;return{sweep:this.sweep,sums:n.map(r=>r.slice()),reached:o.slice(),looks:s}}step(){let{present:n,document:o}=this;this.
chains.forEach((r,i)=>{this.blocks?fp(r,this.blocks,this.sites,this.sweep):r.sweep(this.sites,this.sweep);let a=n.sums[i];for(let c=0;c<this.cells;c++)a[c]+=r.walls[c];
let l=r.logLikelihood();this.likelihood[i].push(l),this.joint[i].push(l+this.problem.prior.logProb(r.walls)),(this.sweep+1)%this.thin===0&&this.kept[i].push(Zn(
r.walls))}),this.sweep++,this.done=this.sweep>=this.total;let s=Math.floor(o.burn_in*this.total);if(this.done&&s>this.past[0].sweep&&this.past.every(({sweep:r})=>r!==
s)&&this.burn(s),!!this.lookAt.has(this.sweep)){for(let r of this.chains)for(let i=0;i<this.cells;i++)n.reached[i]+=r.reached[i]?1:0;for(n.looks+=nn,this.sweep<=
o.burn_in*this.total&&this.past.push(this.copy());this.past.length>1&&this.past[1].sweep<=o.burn_in*this.sweep;)this.past.shift()}}get draws(){return this.kept[0].
length?{chains:nn,count:this.kept[0].length}:$p}recorded(){let{joint:n,kept:o,thin:s}=this,r=o.flat(),i=r[0]?.length??0,a=new Uint8Array(r.length*i);return r.forEach(
(l,c)=>a.set(l,c*i)),{log_joint:n.map(l=>l.filter((c,h)=>(h+1)%s===0)),draws:a}}means(){let[n]=this.past,o=Math.max(1,this.sweep-n.sweep);return this.present.sums.
map((s,r)=>s.map((i,a)=>(i-n.sums[r][a])/o))}mean(){let[n,o]=this.means();return n.map((s,r)=>this.touched[r]?(s+o[r])/2:this.document.prior)}reached(){let[n]=this.
past,o=Math.max(1,this.present.looks-n.looks);return Float64Array.from(this.present.reached,(s,r)=>(s-n.reached[r])/o)}get logJoint(){return this.joint}draw({chain:n,
draw:o}){let s=Math.min(n,nn-1),{count:r}=this.draws;if(!r)return{map:this.chains[s].walls,chain:s,draw:0,log_joint:this.joint[s].at(-1)??0};let i=Math.min(o??r-
1,r-1);return{map:wt(this.kept[s][i],this.cells),chain:s,draw:i,log_joint:this.joint[s][(i+1)*this.thin-1]}}figures(n){let[{sweep:o}]=this.past,s=Ao();(s>=this.
diagnoseAt||this.done&&this.diagnosed<this.sweep)&&(this.diagnosis=xp(this.joint.map(c=>c.slice(o))),this.diagnosed=this.sweep,this.diagnoseAt=this.done?1/0:Ao()+
(Ao()-s)/ay);let r=this.joint.reduce((c,h)=>c+h[h.length-1],0)/nn,{ess:i=null,rhat:a=null}=this.diagnosis??{},l=c=>c!==null&&Number.isFinite(c)?c:null;return{sweeps:this.
sweep,total:this.total,ess:l(i),rhat:l(a),log_joint:r,verdict:this.verdict(n||this.done),burned:o}}verdict(n){let{judging:o,sweep:s}=this,r=s<o.fewest_sweeps;if(r&&
!n)return null;let i=(u,d,m=null)=>({level:u,why:d,cell:m}),a=this.difference();if(!r&&a.cells>o.chance_share*a.among){let[u,d]=a.cell,m=`in ${a.cells} of ${a.among}\
 observed cells, most in cell (${u}, ${d}), by ${a.by.toFixed(2)}`;return i("bad",`P(wall) differs by over ${o.bad_difference} between the chains ${m}`,a.cell)}
if(s<o.fewest_diagnosed)return i("bad",`${s} ${s===1?"sweep is":"sweeps are"} too few to judge`);let{rhat:l=NaN,ess:c=NaN}=this.diagnosis??{};if(l>o.rhat_limit)
return i("bad",`R-hat is ${l.toFixed(2)}, over ${o.rhat_limit}`);let h=this.misfit();return h?i("bad",`the chains agree, but on maps that the readings contradic\
t: they differ by ${+h.toPrecision(3)} times the noise`):!Number.isFinite(l)||!Number.isFinite(c)?i("good","nothing varies: the log joint is the same in all dra\
ws of all chains"):c<o.bad_ess?i("bad",`only ${c.toFixed(0)} effective draws`):l>o.good_rhat||c<o.good_ess?i("fair",`R-hat ${l.toFixed(3)} and ${c.toFixed(0)} e\
ffective draws; ${o.good_rhat} and ${o.good_ess} are good`):i("good",`R-hat ${l.toFixed(3)}, ${c.toFixed(0)} effective draws`)}misfit(){let n=this.problem.table.
noHit.length,[{sweep:o}]=this.past,s=-n*Math.log(this.document.noise*Math.sqrt(2*Math.PI)),r=this.likelihood.map(l=>l.slice(o).reduce((c,h)=>c+h,0)/(l.length-o)),
i=2*(s-Math.min(...r)),a=2/(9*n);return i>n*(1-a+this.judging.misfit_sigmas*Math.sqrt(a))**3?Math.sqrt(i/n):null}difference(){let[n,o]=this.means(),s=this.reached(),
r={by:0,cell:[0,0],cells:0,among:0};for(let i=0;i<this.cells;i++){if(s[i]<.5)continue;let a=Math.abs(n[i]-o[i]);r.among++,a>this.judging.bad_difference&&r.cells++,
a>r.by&&([r.by,r.cell]=[a,[Math.floor(i/this.problem.shape[1]),i%this.problem.shape[1]]])}return r}},xr=class extends Eo{constructor(n,o,s){super(n,o);this.judging=
s;this.method="importance",this.key=gn(n.seed,0,ap),this.sums=new Float64Array(this.cells),this.touched=new Uint8Array(this.cells);for(let r of o.table.cells)this.
touched[r]=1}key;logWeights=[];most=-1/0;sum=0;sums;touched;step(){let n=this.logWeights.length,o=Math.min(ly,this.document.sweeps-n);vp(this.problem,this.key,n,
o).forEach((s,r)=>{if(this.logWeights.push(s),s>this.most){let l=Math.exp(this.most-s);this.sum*=l;for(let c=0;c<this.cells;c++)this.sums[c]*=l;this.most=s}if(s<
this.most-cy)return;let i=Math.exp(s-this.most),a=ta(this.problem,this.key,n+r);this.sum+=i;for(let l=0;l<this.cells;l++)a[l]&&(this.sums[l]+=i)}),this.done=this.
logWeights.length>=this.document.sweeps}mean(){return this.sums.map((n,o)=>this.touched[o]?n/this.sum:this.document.prior)}reached(){let n=this.mean(),{offsets:o,
cells:s,noHit:r}=this.problem.table,i=new Float64Array(this.cells);for(let a of Np){let l=new Uint8Array(this.cells);for(let c=0;c<r.length;c++)for(let h=o[c];h<
o[c+1]&&(l[s[h]]=1,!(n[s[h]]>a));h++);for(let c=0;c<this.cells;c++)i[c]+=l[c]/Np.length}return i}figures(){let{effectiveSampleSize:n}=kp(Float64Array.from(this.
logWeights));return{sweeps:this.logWeights.length,total:this.document.sweeps,ess:n,rhat:null,log_joint:null,verdict:this.verdict(n),burned:0}}verdict(n){let{bad_ess:o,
good_ess:s}=this.judging,r=n.toFixed(1)==="1.0"?"one particle carries":`${n.toFixed(1)} particles carry`;return n<o?{level:"bad",why:`${r} all the weight`,cell:null}:
{level:n>=s?"good":"fair",why:`${n.toFixed(0)} effective particles`,cell:null}}weights(){let n=this.logWeights.map(r=>r-this.most),o=Math.min(-1,...n.filter(Number.
isFinite).reduce((r,i)=>[Math.min(r[0],i)],[0])),s=new Float32Array(sa);for(let r of n)s[Math.min(sa-1,Math.floor(sa*(1-r/o)))]++;return{weights:s,lowest:o}}};var vr=.03,py=40,Fn=180,Fp=90,ra=9,dy=24,Ip=60,ia=7,Op=50,uy=25,fy=10,Up=1e3,my=4e3,gy=21;function Hp(t,e,n){let{grid:o,noise:s,max_range:r,seed:i}=t,{shape:[a,
l],resolution:c,origin:h}=o,u=wt(ht(t.walls),a*l),d=Xo(t),m=r/c,w=(A,_,B)=>c*br(u,o.shape,{x:A,y:_,ux:Math.cos(B),uy:Math.sin(B)},m),v=(A,_)=>A>=0&&_>=0&&A<a&&_<
l&&!u[Math.floor(A)*l+Math.floor(_)],b=(1-vr)/(s*Math.sqrt(2*Math.PI)),M=([A,_,B])=>{if(!v(A,_))return-1/0;let I=0;for(let ie=0;ie<d.length;ie++){let K=w(A,_,B+
d[ie]),J=(e[ie]-K)/s,Q=K>=r;n[ie]?I+=Math.log((Q?0:b*Math.exp(-.5*J*J))+vr/r):I+=Math.log(Q?1-vr/2:vr/2)}return I},S=$(),E=Bp(S.slice(0,my),A=>A,1.5,.2,Ip);if(E.
length===Ip)return ee(S.filter((A,_)=>_%Math.ceil(S.length/Up)===0));let P=gn(i,0,gy),[D,L]=[0,-1/0],O=E.slice(0,dy).map(A=>({mean:A,root:aa(.4,.4,.04),poses:[],
logs:[],top:-1/0}));for(let A=0;A<=ia;A++){for(let _ of O){let B=A===ia,I=B?1.4:1.2,ie=Array.from({length:B?3*Op:Op},()=>yy(_.mean,_.root,I,P,D+=3)),K=ie.map(({
pose:q,log:W})=>M(q)-W);_.top=Math.max(_.top,...ie.map(({log:q},W)=>K[W]+q)),L=Math.max(L,_.top),Object.assign(_,{poses:ie.map(({pose:q})=>q),logs:K});let[J,Q]=Gp(
_.poses,Wp(K,B?1:fy));!B&&Q&&([_.mean,_.root]=[J,wy(Q)])}O=O.filter(_=>_.top>L-uy*(ia-A+1)),A>=2&&(O=Bp(O.sort((_,B)=>B.top-_.top),({mean:_})=>_,1,.15))}let G=Math.
max(...O.flatMap(({logs:A})=>A)),te=O.map(({poses:A,logs:_})=>_.map(B=>Math.exp(B-G)/A.length)),X=te.flat().reduce((A,_)=>A+_,0);return U(O.map(({poses:A},_)=>({
poses:A,weights:te[_].map(B=>B/X)})),L/d.length);function $(){let A=new Float32Array(Fn),_=Array.from(d.keys()).filter((K,J)=>J%Math.ceil(d.length/py)===0),B=Math.
hypot(s,.3*c),I=[];for(let K=0;K<a*l;K++){if(u[K])continue;let[J,Q]=[Math.floor(K/l)+.5,K%l+.5];for(let q=0;q<Fn;q++)A[q]=w(J,Q,q*2*Math.PI/Fn);for(let q=0;q<Fp;q++){
let W=q*2*Math.PI/Fp,ue=0;for(let de of _){let he=Math.round((W+d[de])*Fn/(2*Math.PI)),ae=A[(he%Fn+Fn)%Fn],Fe=(e[de]-ae)/B;ue+=n[de]?Math.min(Fe*Fe,ra):ae>=r?0:
ra}I.push({pose:[J,Q,W],loss:ue})}}I.sort((K,J)=>K.loss-J.loss);let ie=I[0]?.loss??0;return I.filter(({loss:K})=>K<ie+.25*ra*_.length).map(({pose:K})=>K)}function ee(A){
let _=A.map(M);return U([{poses:A,weights:Wp(_,_.length/2)}],Math.max(..._)/d.length)}function U(A,_){let B=A.map(({poses:K,weights:J})=>{let Q=J.reduce((Ne,Ie)=>Ne+
Ie,0),[[q,W,ue],de]=Gp(K,J.map(Ne=>Ne/Q)),he=[c,c,1],ae=(de??aa(0,0,0)).map((Ne,Ie)=>Ne.map((Ct,Lt)=>Ct*he[Ie]*he[Lt])),[[Fe,We],[,ve]]=ae,it=Math.sqrt((Fe+ve)/
2+Math.hypot((Fe-ve)/2,We));return{mean:[h[0]+q*c,h[1]+W*c,Math.atan2(Math.sin(ue),Math.cos(ue))],covariance:ae,probability:Q,sigma_m:it,sigma_rad:Math.sqrt(ae[2][2])}}),
ie=A.flatMap(({poses:K,weights:J})=>K.map((Q,q)=>({pose:Q,weight:J[q]}))).sort((K,J)=>K.weight-J.weight).slice(-Up);return{modes:B.sort((K,J)=>J.probability-K.probability),
pose:Float32Array.from(ie.flatMap(({pose:[K,J,Q]})=>[h[0]+K*c,h[1]+J*c,Q])),weight:Float32Array.from(ie,({weight:K})=>K),nats_per_beam:_}}}function Bp(t,e,n,o,s=1/0){
let r=[];for(let i of t){if(r.length>=s)break;let[a,l,c]=e(i),h=u=>{let[d,m,w]=e(u);return Math.hypot(a-d,l-m)<n&&Math.abs(Math.atan2(Math.sin(c-w),Math.cos(c-w)))<
o};r.some(h)||r.push(i)}return r}var aa=(...t)=>t.map((e,n)=>t.map((o,s)=>n===s?e:0));function yy(t,e,n,o,s){let r=[0,1,2].map(l=>dr(o,2*(s+l))),i=t.map((l,c)=>l+
n*e[c].reduce((h,u,d)=>h+u*r[d],0)),a=-.5*(r[0]**2+r[1]**2+r[2]**2)-Math.log(n**3*e[0][0]*e[1][1]*e[2][2]);return{pose:i,log:a}}function Wp(t,e){let n=Math.max(
...t);if(n===-1/0)return t.map(()=>1/t.length);for(let o=1;;o/=2){let s=t.map(i=>Math.exp(o*(i-n))),r=s.reduce((i,a)=>i+a,0);if(o<1e-6||r**2>=e*s.reduce((i,a)=>i+
a*a,0))return s.map(i=>i/r)}}function Gp(t,e){let n=t[e.indexOf(Math.max(...e))],o=t.map(l=>l.map((c,h)=>h===2?Math.atan2(Math.sin(c-n[2]),Math.cos(c-n[2])):c-n[h])),
s=l=>o.reduce((c,h,u)=>c+e[u]*l(h),0),r=[0,1,2].map(l=>s(c=>c[l])),i=r.map((l,c)=>r.map((h,u)=>s(d=>(d[c]-l)*(d[u]-h))));return[n.map((l,c)=>l+r[c]),i.every((l,c)=>l[c]>=
0)&&Number.isFinite(i[0][0])?i:null]}function wy(t){let e=aa(0,0,0);for(let n=0;n<3;n++)for(let o=0;o<=n;o++){let s=t[n][o];for(let r=0;r<o;r++)s-=e[n][r]*e[o][r];
e[n][o]=n===o?Math.sqrt(Math.max(s,1e-7)):s/e[o][o]}return e}var by=12,xy=80,vy=11,ky=new Set(["path","views","ghost","beam"]),la="This figure has no such tool: bayesmap app has it";async function Vp(t){return JSON.parse(
new TextDecoder().decode(await Qn(ht(t))))}function Sy(t,e){let n=Pp(t,e),{seed:o,noise:s,angles:r,sensors:i}=t,a=i.map(({id:c})=>gn(o,c,vy)),l=n.map((c,h)=>t.readings===
"exact"?c:c+s*dr(a[Math.floor(h/r)],2*(h%r)));return{exact:n,readings:l}}function My({method:t,prior:e},{rare_walls:n}){return t!=="auto"?t:Math.min(e,1-e)<=n?"\
block":"gibbs"}function jp(t,e=n=>setTimeout(n)){let{limits:n,judging:o}=t,s=new hr(t.document),[r,i]=[0,0],[a,l,c]=[!0,!1,!1],h={layer:"mean",chain:0,draw:null},
u="live",d=null,[m,w]=[!1,!1],[v,b]=[0,0],M=null,S=(A,_)=>U.onmessage({type:"status",text:A,level:_},{}),E=()=>U.onmessage({type:"state",document:s.present,generation:r,
seq:i,can_undo:s.canUndo,can_redo:s.canRedo,live:a,running:l,working:c,draws:!c&&d?.draws||{chains:0,count:0},scan:0,view:h},{}),P=(A=!1)=>{d&&(b=performance.now(),
U.onmessage(...d.picture(h,r,Math.round(b-v),A)))};function D(){if(m=!1,w||!c)return;let A=!d;d??=O(),u!=="clear"&&d.work(by);let _=d.done||u==="clear";(A||_||performance.
now()-b>xy)&&P(),_?(l=c=!1,E()):L()}function L(){m||e(D),m=!0}function O(){let A=s.present,{sensors:_,max_range:B}=A,I=Ep(A),{exact:ie,readings:K}=Sy(A,I),J=Float64Array.
from(_.flatMap(({x:de,y:he,yaw:ae})=>[de,he,ae])),Q=de=>Float32Array.from(de),q={pose:J,angles:Q(Xo(A)),ranges:Q(K),exact:Q(ie),hit:Uint8Array.from(ie,de=>de<B?
1:0)};M=q,U.onmessage({type:"scan",generation:r,ids:_.map(({id:de})=>de),index:null},q);let W=_p(A,I,K),ue=My(A,t);return u==="clear"?new Eo(A,W):ue==="importan\
ce"?new xr(A,W,o):new Zo(A,W,o,ue==="block")}function G(A=a?"live":"clear"){r++,u=A,d=null,l=u==="run",c=!0,v=performance.now(),E(),L()}function te(){if(!c)return E();
if(!d)return G("clear");l=c=!1,P(!0),E()}function X(A){if(A)return s.push(zi(A,t.document,n),{type:"hello"}),G();if(!r)return G();E(),P()}function $(A){let{sensors:_,
angles:B}=s.present,I=Math.max(0,_.findIndex(he=>he.id===A)),{x:ie,y:K,yaw:J}=_[I],Q=[I*B,(I+1)*B];if(!M||w)return;let{modes:q,pose:W,weight:ue,nats_per_beam:de}=Hp(
s.present,M.ranges.subarray(...Q),M.hit.subarray(...Q));U.onmessage({type:"where",picture:r,sensor:_[I].id,index:null,pose:[ie,K,J],modes:q,p_lost:0,nats_per_beam:de,
trouble:""},{pose:W,weight:ue})}function ee(A){switch(A.type){case"hello":return X(A.document);case"run":{u==="live"&&c&&(d??=O());let ie=d instanceof Zo?d:null;
G("run"),ie?.goOn(s.present.sweeps),d=ie;return}case"cancel":return te();case"live":return a=A.on,l?E():a?G():te();case"view":return h={layer:A.layer,chain:A.chain??
h.chain,draw:A.draw??null},E(),P(!c);case"undo":case"redo":return s.step(A.type==="undo")?G():(S(`nothing to ${A.type}`,"info"),E());case"export":{if(A.what!=="\
document")throw new je(la);let ie=new TextEncoder().encode(`${JSON.stringify(s.present,null,1)}
`);return U.onmessage({type:"download",name:"document.json",mime:"application/json",note:""},{data:ie})}case"clear":if(A.what==="inference")return G("clear")}let _=np(
s.present,A,n);if(!_)throw new je(la);let[B,I]=_;s.push(B,A),I&&S(I,"warning"),G()}let U={...hn(),open:()=>{U.onmessage({type:"welcome",version:1,limits:n,recorded:!1,
figure:!0,lacks:[],story:t.story},{}),U.onmessage({type:"worker",state:"ready"},{}),U.onstatus({connected:!0})},send:A=>{if(A.type!=="painted"){if(A.type==="ins\
pect"){let _=d?.beamsThrough(A.x*s.present.grid.shape[1]+A.y);if(_===void 0)return;let B={beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,
chain:null,prior_nats:null,log_odds:null};return U.onmessage({type:"cell",x:A.x,y:A.y,each:!1,beams:_,...B},{})}if(A.type==="where")return e(()=>$(A.sensor));if(ky.
has(A.type))return S(la,"warning");i=A.seq??i;try{ee(A)}catch(_){if(!(_ instanceof je))throw _;if(A.type==="hello")return U.onmessage({type:"error",text:_.message,
remedy:"",seq:i},{});S(_.message,"warning"),E()}}},record:()=>d&&M&&d.recording(M),close:()=>{w=!0}};return U}var ca=250,Ty=8e3;function zp(t){let e=null,n=ca,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),c=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{c=!0,n=ca,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...pn(h))},l.onclose=()=>{if(s||e!==l)return;o=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),c||Ay(t()).then(u=>u&&e===l&&i.onstatus({...h,refused:u})),n=Math.min(Ty,2*n)}}let i={...hn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},read:(a,l)=>new Promise((c,h)=>{let u=new URL("open",t());u.search=t().search,u.searchParams.set("name",a.name);let d=new XMLHttpRequest;d.open("POST",u),d.
responseType="arraybuffer",d.upload.onprogress=({loaded:m,total:w})=>l(m/w),d.onload=()=>d.status===200?c(d.response):h(new Error(new TextDecoder().decode(d.response))),
d.onerror=()=>h(new Error("the connection is lost")),d.send(a)}),retry:()=>{n=ca,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};
return i}async function Ay(t){try{return(await fetch(t.pathname+t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Yp(t){let e=(o,s=[])=>n.onmessage(o,ja(o,s)),n={...hn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var Ey="This is the map that was drawn here when the connection was lost; undo leads back",qp=()=>!("DecompressionStream"in window&&"adoptedStyleSheets"in document),
Kp="This page needs a newer browser: Safari 16.4, Firefox 121, Chrome 111, or later.",kr=t=>Object.assign(window,{bayesmap:t}),av={render({model:t,el:e}){let n=document.
createElement("div");if(e.append(n),qp())return void(n.textContent=Kp);let o=Jo(n,Yp(t),{embedded:!0});return kr(o),()=>o.destroy()}};function Jp(t,e){let n=Jo(
t,cs(e),{play:ha(t,()=>n)});kr(n)}var ha=(t,e)=>n=>{e().destroy(),Jp(t,n)};async function Py(){let t=document.querySelector("[data-bayesmap]");if(!t||t.shadowRoot)
return;if(qp())return void(t.textContent=Kp);let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector(
"script[data-recording]");if(n){Jp(t,await ls(n.textContent??""));return}let o=document.querySelector("script[data-figure]");if(o){let[{document:h,damaged:u},d]=await Promise.
all([Fo(),Vp(o.textContent??"")]),m=u?{text:$o,level:"error"}:null,w=Jo(t,jp(d),{adopt:h,notice:m,play:ha(t,()=>w)});kr(w);return}kl(new URLSearchParams(location.
search).get("token"));let{document:s,damaged:r}=await Fo(),i=s?null:bl(),a=zp(()=>new URL(location.href));Sl(h=>{history.replaceState(null,"",`${location.pathname}\
?token=${encodeURIComponent(h)}${location.hash}`),a.retry?.()});let c=Jo(t,a,{adopt:s??i,notice:r?{text:$o,level:"error"}:i?{text:Ey,level:"info"}:null,play:ha(
t,()=>c)});kr(c)}Py();export{av as default,jp as localTransport,Jo as mount,Vp as readFigure,ls as readRecording,cs as recordedTransport,zp as webSocketTransport,Yp as widgetTransport};
