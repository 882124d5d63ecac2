// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function bt(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Zn(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function dt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Sn(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Ga(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Qn=t=>Ga(t,new DecompressionStream("deflate-raw")),Ha=t=>Ga(t,new CompressionStream("deflate-r\
aw"));async function ja(t){let e=await Ha(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Sn(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Pd(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Qn(dt(e[1]))))}var Io="The link's map cannot be read: copy the link again, who\
le";async function Oo(){let t=await Pd(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var Jr={uint8:Uint8Array,uint32:Uint32Array,float32:Float32Array,float64:Float64Array},Va=8,cn=()=>({onmessage:()=>{},onstatus:()=>{}});function hn(t){let e=new DataView(
t).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let l=a.reduce((c,h)=>c*
h,1)*Jr[i].BYTES_PER_ELEMENT;o[r]=new Jr[i](t.slice(s,s+l)),s+=Math.ceil(l/Va)*Va}return[n,o]}function za(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{
let{buffer:i,byteOffset:a,byteLength:l}=e[r];n[o]=new Jr[s](i.slice(a,a+l))}),n}async function ds(t){let e=await Qn(dt(t));return hn(e.buffer)}function us([t,e]){let{document:n,ids:o,log_joint:s}=t,{chains:r,count:i,bits:a}=t.draws,l=n.grid.
shape[0]*n.grid.shape[1],c=n.source.kind!=="simulation",h=1,u={chains:r,count:i},p=0,m={layer:"mean",chain:0,draw:null},y=(D,L=D.length===0)=>{let O=D.length/o.
length;return c&&!L?D.slice(p*O,(p+1)*O):D},v=()=>o[p]-1,b=(D=0)=>{let L={generation:h,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1,scan:v()};E.onmessage(
{type:"state",document:n,seq:D,...L,draws:u,view:m},{})},x=()=>{let{pose:D,angles:L,ranges:O,exact:G,hit:te}=e,X=L.length<O.length,R={pose:y(D),angles:y(L,X),ranges:y(
O),exact:y(G),hit:y(te)};E.onmessage({type:"scan",generation:h,ids:c?[o[p]]:o,index:c?v():null},R)},S=D=>{let L=a?Math.ceil(l/8):l,O=e.draws.slice(D*L,(D+1)*L);
return a?bt(O,l).map(G=>255*G):O},A=()=>{let{p:D,width:L,reached:O,trace:G,traced:te,weights:X}=e,R=Math.min(i-1,m.draw??i-1),ee=m.layer==="draw"&&!i||m.layer===
"width"&&!L?"mean":m.layer,B=ee==="draw"?{chain:m.chain,draw:R,log_joint:s[m.chain][R]}:{},P=ee==="draw"?S(m.chain*i+R):ee==="width"?L:D;E.onmessage({...t.field,
layer:ee,...B},{p:P,reached:O,trace:G,traced:te,...X&&{weights:X}})},E={...cn(),open:()=>E.onstatus({connected:!0}),send:D=>{if(D.type==="hello"){let L=[...i?[]:
["draw"],...e.width?[]:["width"]];E.onmessage({type:"welcome",version:1,limits:null,recorded:!0,figure:!1,lacks:L,story:null},{}),b(D.seq),x(),e.trajectory&&E.onmessage(
{type:"overlay",generation:h},{strokes:e.strokes,trajectory:e.trajectory}),A()}else if(D.type==="view")m={layer:D.layer,chain:D.chain??m.chain,draw:D.draw??null},
b(D.seq),A();else if(D.type==="scan"){let L=o.map(O=>Math.abs(O-1-D.index));p=L.indexOf(Math.min(...L)),b(D.seq),x()}else if(D.type==="inspect"){let{x:L,y:O}=D,
G=e.beams[L*n.grid.shape[1]+O];E.onmessage({type:"cell",x:L,y:O,each:!1,beams:G,beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,chain:null,
prior_nats:null,log_odds:null},{})}},close:()=>{}};return E}async function _d(t,e){let n=new TextDecoder,o=t.stream().getReader(),[s,r]=["",0];for(let i=await o.read();!i.done;i=await o.read())s+=n.decode(i.value,{stream:!0}),
e((r+=i.value.length)/t.size);return s}async function Cd(t,e,n,o){try{let s=await n(t,r=>e.say(r<1?`Reading ${t.name}: ${Math.round(100*r)} %`:`Reading ${t.name}\
: making its picture`));o(hn(s))}catch(s){e.say(`The file ${t.name} cannot be shown: ${s.message}`,"error")}}async function Ya(t,e,n){let{name:o}=t;if(o.endsWith(
".nc")&&e.transport.read&&n)return Cd(t,e,e.transport.read,n);if(!/\.(html|json)$/.test(o))return e.say(`The file ${o} is not read in the page: start bayesmap a\
pp with it`,"warning");try{let s=await _d(t,i=>e.say(`Reading ${o}: ${Math.round(100*i)} %`)),r=/data-recording>(.*?)<\/script>/s.exec(s)?.[1];r&&n?n(await ds(r)):
o.endsWith(".json")&&!e.recorded?e.bring(JSON.parse(s)):e.say(`The file ${o} holds nothing that can be shown here`,"warning")}catch{e.say(`The file ${o} cannot \
be read: export it again, whole`,"error")}}var ce=(t,e,n)=>Math.min(n,Math.max(e,t)),qt=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,Ae=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Xr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function Mn(t,e){let{x:n,y:o}=Ae(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var eo=(t,e)=>Xr({x:t.x+.5,y:t.y+.5},e);
function fs(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function qa(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&s(r-1,i)!==s(r,i);l&&a<0&&(a=i),!l&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&s(i,r-1)!==s(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var Bo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Ka(t,e,n){let o=Xa(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Zr(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Ja(t,e){
let n=Nd(e,t.grid.shape),o=Xa(t),s=(i,a,l)=>{if(e[l])return-1/0;let c=2*n[l];for(let h of o)c=Math.min(c,Math.hypot(i-h.x,a-h.y));return c>0?c:-1/0},r=Ld(e,t.grid.
shape,o);return Zr(t,(i,a,l)=>r[l]?s(i,a,l):-1/0)??Zr(t,s)}function Ld(t,[e,n],o){let s=new Uint8Array(e*n),r=(i,a)=>{for(let{x:l,y:c}of fs(i,a)){if(t[l*n+c])return;
s[l*n+c]=1}};for(let i of o){for(let a=0;a<e;a++)for(let l of[0,n-1])r(i,{x:a,y:l});for(let a=0;a<n;a++)for(let l of[0,e-1])r(i,{x:l,y:a})}return s}var Xa=({sensors:t,
grid:e})=>t.map(n=>Mn(n,e));function Zr(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let l=e(i,a,i*o+a);l>r&&([s,r]=[{x:i,y:a},
l])}return s&&eo(s,t.grid)}function Nd(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<n;i++)o[r*
n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),s(r+1,i-
1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var ms=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return qt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(c=>Mn(c,r.grid)):[],l=new Map;for(let c of e)!qt(c,i)||this.isWall(c)===n||a.some(h=>h.x===
c.x&&h.y===c.y)||l.set(c.x*i[1]+c.y,[c.x,c.y]);e.some(({x:c,y:h})=>a.some(u=>u.x===c&&u.y===h))&&this.session.say("A sensor stands in a cell of this stroke: it \
stays free.","warning"),l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,yaw:a}={...e,...n};this.
refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;if(!o)return;let s=e===
"where there is room"?Ja(o,n.walls):"world"in e?e.world:Ka(o,n.walls,e.near),r=n.limits?.sensors[1]??1/0;s?o.sensors.length>=r?n.say(`There can be ${r} sensors \
at most.`,"warning"):this.refuses(s)||(n.act({type:"add_sensor",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=Math.max(0,...o.
sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"remove_sensor",
id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=Mn(e,n.document.grid),s=this.isWall(o);return!s&&qt(o,n.shape)?(n.status.text.startsWith(
"A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Ft=new Set(["pan","path","look","where","ghost","evidence"]),Dd=120,gs=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.decisions.showPath(e==="path"||e==="pan"||!Ft.has(e)),this.session.ghost.hold(
e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&qt(e,this.session.
shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(
e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.
cursor&&this.announce(this.describe(e))},Dd))}};var He={left:36,right:12,top:34,bottom:26},$d=60,Rd=160,to=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-He.left-He.right,y:this.height-He.
top-He.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:He.left+(o.x-
s*e)/2,y:He.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,o){let{scale:s}=this.transform,{x:r,
y:i}=this.corner,a=ce(s*e,Math.min(this.width,this.height)/Math.max(...o)/3,Rd),l=a/s;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.
x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=$d;this.corner.
x=ce(this.corner.x,s-e*o,this.width-s),this.corner.y=ce(this.corner.y,s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var ys=new Set(["path","look","evidence"]);function ws(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);if(e.tool==="evidence"&&t.document){let{x:h,y:u}=Ae(
o,t.document.grid);return t.evidence.pin({x:Math.floor(h),y:Math.floor(u)})}let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,l]=r.
pose.subarray(3*s,3*s+3),c=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${c}`)}var tl=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W","where am I","located"],["O, V","ghost, evidence of beams","as\
ked"],["arrows","move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["S\
pace","at the cursor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, De\
lete","add, remove a sensor","drawn"],["R, Escape","run, cancel","inferred"],["Escape","take a path off the map","asked"],["M, N, H","show the mean, a draw, the\
 entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","edited"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],Fd={ArrowLeft:[-1,0],ArrowRight:[1,0],
ArrowUp:[0,1],ArrowDown:[0,-1]},Za=Math.PI/12,bs=class{constructor(e,n,o,s,r){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;e.addEventListener(
"keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){
let{session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=Fd[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?Za:-Za;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&
o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key===
"Backspace")&&n.editable)s.removeSensor();else if(e.key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.
editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&
o.ghost.pose&&o.document){let{resolution:l}=o.document.grid,{x:c,y:h}=o.ghost.pose;o.ghost.move({x:c+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&
r.sensor&&o.document&&o.editable){let{resolution:l}=o.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.
tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},c={x:ce(l.x+e,0,i-1),y:ce(l.y+n,0,a-1)};
r.setCursor(c);let h=s.fromGrid({x:c.x+.5,y:c.y+.5},a),u=(m,y,v)=>m-ce(m,y,v),p={x:u(h.x,He.left+10,s.width-20),y:u(h.y,20,s.height-He.bottom-10)};(p.x||p.y)&&s.
pan(-p.x,-p.y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if(ys.has(o.tool)&&n.document){o.cursor?ws(n,o,s,eo(o.cursor,n.document.grid)):this.arrow(0,
0);return}if(n.editable){if(o.tool==="sensor"||o.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,
r.length)]?.id??null),o.selected!==null&&o.announce(`Sensor ${o.selected}`)}else if(!Ft.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&
!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.announce(i?"wall":"free")}}}},Uo={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",
v:"evidence"},Qa={m:"mean",n:"draw",h:"entropy"},el={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function nl(t,e,n){let o=t.composedPath()[0],s=o instanceof
HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||
e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}let i=t.key==="Escape"&&e.decisions.start!==null&&e.decisions.pathShown;
if(!(s&&!i||t.altKey)){if(Uo[r]&&(Ft.has(Uo[r])?e.answers||Uo[r]==="where"&&e.locates||Uo[r]==="pan"&&e.editable:e.editable))n.tool(Uo[r]);else if(Qa[r])n.layer(
r==="h"&&e.quantity.interval?"width":Qa[r]);else if(el[t.key])n.command(el[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(i)e.decisions.forgetPath();else if(t.
key==="Escape"&&(e.running||e.working))e.act({type:"cancel"});else return;t.preventDefault()}}var Id={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Od={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},ks={light:Id,dark:Od},ol="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Bd([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((l,c)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*s[c]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let c=ce(l,0,1);return Math.round(255*(c<=.0031308?12.92*c:1.055*c**(1/2.4)-.055))})}var xs=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),vs=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),Wo=(t,e)=>Bd(vs(t.paper,t.ink,e));function no(t){let e=Math.min(15,Math.floor(
t*16));return vs(xs(ol,6*e),xs(ol,6*e+6),t*16-e)}function sl(t,e){let n=new Uint8ClampedArray(17408).fill(255),[o,s]=[xs(t.unobserved),xs(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?Bo(r/255):r/255,a=e==="value"||e==="state"?Wo(t,r/255):no(i),l=e==="value"?vs(o,s,r/255):a;for(let c=0;c<=16;c++)n.set(vs(l,a,c/16),
4*(r+256*c))}return new Uint32Array(n.buffer)}var Qr=(t,e=!1)=>{let n=o=>`rgb(${t(o).map(Math.round)})`;return`linear-gradient(90deg,${e?`${n(0)} 50%,${n(1)} 50\
%`:[0,.125,.25,.375,.5,.625,.75,.875,1].map(n)})`};var Ms='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Tn(t,e,n,o,s,r,i=!1){t.font=Ms,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=i?`rgb(${Wo(s,1).map(Math.round)})`:s.axis,t.fillText(e,n,o)}var oo=8,Ss=class{constructor(e,n,o,s,r=0){
this.context=e;this.theme=n;this.width=o;this.height=s;this.left=r}placed=[];marks=[];avoid(e,n,o=e){let s=Math.ceil(Math.hypot(o.x-e.x,o.y-e.y)/6);for(let r=0;r<=
s;r++){let i=r/Math.max(1,s);this.marks.push({x:e.x+i*(o.x-e.x),y:e.y+i*(o.y-e.y),half:n,tall:n})}}place(e,n,o,s,r=0){this.context.font=Ms;let i=this.context.measureText(
e).width/2+2,a=Math.min(Math.max(n,this.left+i),this.width-i),[l,c]=[n+s+i+4,n-s-i-4],h=[[a,o-s-9],[a,o+s+9],[l,o],[c,o]];for(let b=oo;b<=r;b+=oo)h.push([a,o-s-
9-b],[a,o+s+9+b],...[l,c].flatMap(x=>[[x,o-b],[x,o+b]]));let u=([b,x])=>b-i>=0&&b+i<=this.width&&x>=oo&&x<=this.height-oo,p=b=>([x,S])=>b.every(A=>Math.abs(x-A.
x)>=i+A.half||Math.abs(S-A.y)>=oo+A.tall),m=h.filter(u).filter(p(this.placed)),v=m.filter(([b])=>b-i>=this.left).find(p(this.marks))??m[0];return v&&this.placed.
push({text:e,x:v[0],y:v[1],half:i,tall:oo}),!!v}write(){for(let{text:e,x:n,y:o}of this.placed)Tn(this.context,e,n,o,this.theme,"center",!0)}};var Go=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:c,context:h,layer:u}=l,p=u.shows?.(e)??!0,m=[p,...p?[...a,...u.depends(e)]:[]];m.length===
l.before.length&&m.every((y,v)=>Object.is(y,l.before[v]))||(l.before=m,c.style.visibility=p?"":"hidden",p&&((c.width!==i.width||c.height!==i.height)&&(Object.assign(
c,i),c.style.width=`${i.width/s}px`,c.style.height=`${i.height/s}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,c.width,c.height),h.setTransform(s,0,0,s,0,0),
h.save(),u.paint(h,e),h.restore(),this.paints[u.name]++))}}};function so(t,{session:e,look:n,view:o}){let{scale:s,x:r,y:i}=o.transform,a=new Ss(t,n.theme,o.width,
Math.min(o.height,i+e.shape[1]*s),Math.max(He.left,r)),{sensors:l=[],grid:c}=e.document??{};if(c)for(let h of l)a.avoid(o.fromGrid(Ae(h,c),c.shape[1]),9);return a}
function Be(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(i,a,o*r,s*r),t.clip()}function An(t,{halo:e},n,o){t.lineWidth=
4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}function ei({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function pn(t,e,n){let o=n.fromGrid(Ae(t,e),e.shape[1]),s=ce(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function rl(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=ei(e);t.lineJoin=
"round";for(let a of i){let l=pn(a,s.grid,n),{point:c,size:h}=l;a.id===o.selected&&Ud(t,l,o);let[u,p]=[Math.cos(a.yaw),-Math.sin(a.yaw)],m=(y,v)=>[c.x+h*(y*u-v*
p),c.y+h*(y*p+v*u)];t.beginPath(),t.moveTo(...m(1.25,0)),t.lineTo(...m(-.9,.8)),t.lineTo(...m(-.45,0)),t.lineTo(...m(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Tn(t,String(a.id),c.x,c.y+h*2+4,r,"center",!0)}}function Ud(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),An(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function il(t,e,n,o,s){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&pn({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function al(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var ll={touch:24,other:11},Wd=5,Gd=90,Ts=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(l,c)=>e.
addEventListener(l,c,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return Xr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(il(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&ys.has(o.tool))return this.
begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(i.id),this.begin(i);
if(e.button===1||Ft.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="sensor"&&o.select(a.id);else if(o.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let l=o.tool==="draw"!==(e.button===2||e.shiftKey),c=this.cellAt(r),h=l&&this.editor.isWall(c);this.begin({kind:"strok\
e",id:o.nextGesture(),wall:l,last:c,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Gd)}}gripAt(e,n,o){let{hand:s,view:r}=this,
i=this.reach(n),a=p=>Math.hypot(e.x-p.x,e.y-p.y),l=s.tool==="sensor"&&s.sensor?pn(s.sensor,o.grid,r):null;if(l&&s.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let c=o.sensors.map(p=>({id:p.id,...pn(p,o.grid,r)}));c.sort((p,m)=>a(
p.point)-a(m.point));let h=c.find(({point:p,size:m})=>a(p)<Math.max(i,m));if(!h)return null;let u={x:h.point.x-e.x,y:h.point.y-e.y};return{kind:"sensor",id:h.id,
drag:s.nextGesture(),grip:u}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let c of l.
length?l:[e]){let h=this.cellAt(this.at(c));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(...fs(n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(c=>c.id===n.id);if(!a||!o.document)return;let l=this.metres(i,o.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>Wd&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.size===2){let{middle:a,spread:l}=this.spread();
s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(l/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:l}),o.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&ws(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?ll.touch:ll.other}pointAtReading(e){let{document:n,reading:o,ghost:s}=this.
session;if(!n||s.held)return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:o}=this;
if(n?.kind!=="ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);al(o.ghost,n,this.metres({x:s.x+n.grip.x,y:s.y+n.grip.y},o.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level==="error"&&o.say("Ready"))}dragSensor(e){
let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(l=>l.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var Hd=5,As=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(He.left,0,o.width,o.height-He.bottom),e.clip(),s.hover&&cl(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&cl(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function cl(t,e,n,o,s,r,i){let{scale:a}=o.transform,l=o.fromGrid({x:e.x,y:e.y+1},n),c=Math.max(a,Hd),[h,u]=[l.x-(c-a)/2,l.y-(c-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(h,u,c,c),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,u,c,c)}function M(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function _(t,e,n){t[e]!==n&&(t[e]=n)}function st(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var En=t=>t.getRootNode().activeElement===t,pe=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function ti(t,e){let n=URL.
createObjectURL(e);M("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var jd=9,Vd=2.5,ro=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start&&e.pathShown||e.looking&&e.views))}paint(e,n){let{session:o}=n;if(!o.document)return;let s=so(e,n);e.save(),Be(e,n),o.decisions.looking&&this.
views(e,n,s),o.decisions.pathShown&&this.path(e,n,s),e.restore(),s.write()}views(e,{session:n,view:o,look:s},r){let{views:i}=n.decisions,a=n.document?.grid;if(!i?.
nats.length||!a)return;let l=Math.max(...i.nats),c=ce(.38*i.spacing*o.transform.scale/a.resolution,Vd,jd),h=i.nats.indexOf(l);for(let u=0;u<i.nats.length;u++){let p=o.
fromGrid(Ae({x:i.pose[3*u],y:i.pose[3*u+1]},a),a.shape[1]);e.beginPath(),e.arc(p.x,p.y,c,0,2*Math.PI),e.fillStyle=`rgb(${no(ce(i.nats[u]/Math.max(l,1e-9),0,1)).
map(Math.round)})`,e.fill(),u===h&&(e.lineWidth=2.5,e.strokeStyle=s.theme.truth,e.stroke(),r.place(`${pe(l,1)} nats`,p.x,p.y,c))}}path(e,{session:n,view:o,look:s},r){
let{start:i,goal:a,path:l,radius:c}=n.decisions,h=n.document?.grid;if(!h||!i)return;let u=p=>o.fromGrid(Ae(p,h),h.shape[1]);if(l){e.beginPath();for(let[p,m]of l.
path){let y=u({x:p,y:m});e.lineTo(y.x,y.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=l.within_risk?s.theme.sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*
c*o.transform.scale/h.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let p of a?[i,a]:[i]){let{x:m,y}=u(p);e.beginPath(),e.arc(m,y,5,0,2*Math.
PI),e.fillStyle=p===i?s.theme.sensor:s.theme.truth,e.fill(),r.avoid({x:m,y},7),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}if(l){let p=l.path.length,[[m,
y],[v,b]]=[l.path[p-1>>1],l.path[p>>1]],x=u({x:(m+v)/2,y:(y+b)/2}),S=l.path.map(([A,E])=>u({x:A,y:E}));S.forEach((A,E)=>r.avoid(A,3,S[E+1])),r.place(`${pe(l.length_m,
1)} m, P(free) ${pe(l.probability,3)}`,x.x,x.y,4,60)}else a&&n.decisions.trouble&&r.place("no path",u(a).x,u(a).y,7)}};var zd=5,[Yd,hl]=[.8,5],qd=6,Es=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:o,view:s,look:r}=n,{cell:i,each:a}=o.evidence,l=o.document?.grid;if(!i||!l)return;
e.save(),Be(e,n);let c=(x,S)=>s.fromGrid(Ae({x,y:S},l),l.shape[1]),h=x=>[c(a.start[2*x],a.start[2*x+1]),c(a.end[2*x],a.end[2*x+1])],u=a?.nats.length??0;e.lineCap=
"round";for(let x=u-1;x>=0;x--){let[S,A]=h(x),E=a.nats[x];e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(A.x,A.y),e.globalAlpha=ce(.25+Math.abs(E)/2,0,.9),e.lineWidth=
ce(hl*Math.sqrt(Math.abs(E)/qd),Yd,hl),e.strokeStyle=E>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:p}=s.transform,m=s.fromGrid({x:i.x,y:i.y+
1},l.shape[1]),y=Math.max(1,4-p/2);e.beginPath(),e.rect(m.x-y,m.y-y,p+2*y,p+2*y),An(e,r.theme,r.theme.belief,2),e.restore();let v=so(e,n),b=Math.min(zd,u);for(let x=0;x<
b;x++)v.avoid(h(x)[0],2,h(x)[1]);for(let x=0;x<b;x++){let[S,A]=h(x),E=.35+.1*x;v.place(io(a.nats[x]),S.x+E*(A.x-S.x),S.y+E*(A.y-S.y),3)}v.write()}},io=t=>`${t<0?
"−":"+"}${Math.abs(t).toFixed(1)}`;var Kd=10,Jd=7,Xd=({layer:t,quantity:e},n)=>t==="draw"&&e.kind==="binary"?"state":t==="width"?"width":n==="entropy"&&t!=="draw"?"entropy":"value",Ps=()=>document.
createElement("canvas").getContext("2d"),ao=class{name="field";cells=Ps();mask=Ps();hatch=Ps();palettes=new Map;image=new ImageData(1,1);drawn={field:null,reached:null,
palette:"",hatch:""};depends({session:e}){return[e.picture,e.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,
view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:c,y:h}=s.transform;Be(e,n);let u=o.picture;if(!u||u.p.length!==i*a){e.fillStyle=r.theme.unobserved,
e.fillRect(c,h,i*l,a*l);return}this.fill(u,i,a,r.theme,Xd(u,o.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,c,h,i*l,a*l),this.fillHatch(n),e.
drawImage(this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),l>=Kd&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:l}=this,
c=`${s.ground} ${r}`;if(l.field===e&&l.palette===c)return;let h=this.palettes.get(c)??sl(s,r);if(this.palettes.set(c,h),this.image.width!==n||this.image.height!==
o){this.image=new ImageData(n,o);for(let{canvas:p}of[i,a])Object.assign(p,{width:n,height:o});l.reached=null}let u=new Uint32Array(this.image.data.buffer);for(let p=0,
m=0;p<o;p++)for(let y=o-1-p;y<n*o;y+=o)u[m++]=h[e.p[y]+256*(e.reached[y]+8>>4)];if(i.putImageData(this.image,0,0),l.reached!==e.reached){for(let p=0,m=0;p<o;p++)
for(let y=o-1-p;y<n*o;y+=o)u[m++]=255-e.reached[y]<<24;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,reached:e.reached,palette:c})}fillHatch({
session:e,view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:l,height:c}=n,{scale:h,x:u,y:p}=n.transform,[m,y]=e.shape,v=[o.theme.ground,h,u,p,l,c,
a].join(" ");if(i.hatch===v)return;i.hatch=v;let b=Ps(),x=b.canvas.width=b.canvas.height=Math.round(Jd*a);b.strokeStyle=o.theme.hatch,b.lineWidth=a,b.beginPath();
for(let A of[-x,0,x])b.moveTo(A-1,x+1),b.lineTo(A+x+1,-1);b.stroke(),Object.assign(s.canvas,{width:Math.ceil(l*a),height:Math.ceil(c*a)}),s.setTransform(a,0,0,a,
0,0),s.imageSmoothingEnabled=!1,s.drawImage(r.canvas,u,p,m*h,y*h),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let S=s.createPattern(b.canvas,
"repeat");S.setTransform(new DOMMatrix().translate(Math.round(u*a),Math.round(p*a))),s.fillStyle=S,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,
view:o,look:s}){let[r,i]=n.shape,{scale:a,x:l,y:c}=o.transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,c),e.lineTo(l+h*a,c+i*a);for(let h=1;h<i;h++)e.moveTo(
l,c+h*a),e.lineTo(l+r*a,c+h*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var Zd=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],lo=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(Be(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(l,c)=>{let h=ce(r[c],0,a),u=o.yaw+l,p={x:o.x+h*Math.cos(u),y:o.y+h*Math.sin(u)};return n.fromGrid(Ae(p,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(y=>this.ends(n,o,o.angles,y)),{grid:l}=n.session.document,c=n.view.fromGrid(Ae(o,l),l.shape[1]),h=new Path2D;
h.moveTo(c.x,c.y);for(let{x:y,y:v}of r)h.lineTo(y,v);h.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(h);let u=new Path2D,p=new Path2D,m=ce(n.view.transform.
scale*.12,1.2,3);for(let y=0;y<r.length;y++)u.moveTo(r[y].x,r[y].y),u.lineTo(a[y].x,a[y].y),Number.isFinite(o.median[y])&&p.rect(i[y].x-m,i[y].y-m,2*m,2*m);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=ce(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(u),e.globalAlpha=1,p}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,l=ce(n.view.transform.scale*.14,1.5,4),c=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),h=new Path2D;c.forEach(({x:u,y:p},m)=>{i[m]&&
(h.moveTo(u+l,p),h.arc(u,p,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:l,handle:c}=pn({id:0,...r},i,o),[h,u]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(c.x,c.y),An(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[p,m]of Zd)e.lineTo(a.x+l*(p*h-m*u),a.y+l*(p*u+m*h));e.closePath(),e.lineJoin="round",An(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(c.x,c.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var ni=({flicker:t,shown:e,where:n})=>t.under&&!n.map?e:null,co=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,
colour:""};depends({session:e}){return[ni(e)]}shows({session:e}){return ni(e)!==null}paint(e,n){let{session:o,view:s,look:r}=n,i=ni(o);if(!i)return;let[a,l]=o.shape,
{scale:c,x:h,y:u}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Be(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,u,a*c,l*c)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(c=>parseInt(s.slice(c,c+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let l=new ImageData(
n,o);for(let c=0,h=0;c<o;c++)for(let u=o-1-c;u<n*o;u+=o,h+=4)l.data.set([r,i,a,Math.round(e.p[u]*e.reached[u]/255)],h);this.cells.putImageData(l,0,0),this.drawn=
{field:e,colour:s}}};var Qd=46,eu=22;function tu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function pl(t,{session:e,view:n,look:o}){if(!e.document)
return;let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:l,shape:c}=e.document.grid,{scale:h,x:u,y:p}=n.transform,m=tu(Qd/h*l),y=Math.min(p+c[1]*h,i-He.bottom)+
.5,v=Math.max(u,He.left)-.5;t.fillStyle=s.ground,u<v&&t.fillRect(0,0,v,i+1),p+c[1]*h>y&&t.fillRect(0,y,r+1,i+1-y);let b=Math.max(0,-Math.floor(Math.log10(m)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let x=A=>Math.ceil(a[A]/m-1e-9)*m,S=A=>a[A]+c[A]*l+1e-9;for(let A=x(0);A<=S(0);A+=m){let E=u+(A-a[0])/l*h;E<v||
E>r-4||(t.moveTo(E,y),t.lineTo(E,y+4),Tn(t,A.toFixed(b),E,y+12,s,"center"))}for(let A=x(1);A<=S(1);A+=m){let E=p+(c[1]-(A-a[1])/l)*h;E>y||E<4||(t.moveTo(v,E),t.
lineTo(v-4,E),Tn(t,A.toFixed(b),v-7,E,s,"right"))}t.stroke(),Tn(t,"m",v-eu,y+12,s,"right")}var ho=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=ei(e).flatMap(({id:i,x:a,y:l,yaw:c})=>[i,a,l,c]),{grid:s}=e.document??{},
r=dl(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:c,y:h}=s.transform;r.truth&&dl(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(c-.5,h-.5,i*l+1,a*l+1),rl(e,n),pl(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:l}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=qa(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),Be(e,n),e.transform(i,0,0,-i,a,l+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=ce(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},dl=({document:t})=>t?.source.kind==="simulation";var nu=600,ou=1500,su=65536,oi=.3,po=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;
if(!i||!a)return;Be(e,n);let{scale:l}=s.transform,c=1/a.grid.resolution,h=a.grid.shape[1],u=i.angles.length,p=i.pose.length/3,m=Math.ceil(u*p/ou),[y,v,b]=[new Path2D,
new Path2D,new Path2D],x=u*p>nu,S=new Map,A=ce(l*.1,1.3,4),E=a.scans_used??1/0,D=(i.index??0)<E?1:oi;for(let L=0;L<p;L++){let[O,G,te]=i.pose.subarray(3*L,3*L+3),
X=s.fromGrid(Ae({x:O,y:G},a.grid),h);for(let R=0;R<u;R++){let ee=i.ranges[L*u+R],B=i.hit[L*u+R]===1,P=(B?ee:a.max_range)*c*l,C=i.angles[R]+te,U={x:X.x+P*Math.cos(
C),y:X.y-P*Math.sin(C)},I=B?y:v;(L*u+R)%m===0&&(I.moveTo(X.x,X.y),I.lineTo(U.x,U.y)),B&&(x?S.set(Math.round(U.x)*su+Math.round(U.y),U):(b.moveTo(U.x+A,U.y),b.arc(
U.x,U.y,A,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=D*ce(28/Math.sqrt(u*p/m)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(y),e.strokeStyle=r.theme.
noReturn,e.stroke(v),e.globalAlpha=1),r.readings){e.globalAlpha=D,e.fillStyle=r.theme.ray,e.fill(b);let L=1.8*A;for(let{x:O,y:G}of S.values())e.fillRect(O-L/2,G-
L/2,L,L);e.globalAlpha=1}}};var ru=2.5,Ho=t=>t>=ru,uo=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(Be(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&Ho(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[c,h,u]of[[0,l,.6],
[Math.max(0,l-1),a,.6*oi]]){e.beginPath();for(let p=c;p<h;p++){let m=o.fromGrid(Ae({x:r[2*p],y:r[2*p+1]},i),i.shape[1]);e.lineTo(m.x,m.y)}e.globalAlpha=u,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,c,h,u]=r.subarray(a,a+4),[p,
m]=[o.fromGrid(Ae({x:l,y:c},i),i.shape[1]),o.fromGrid(Ae({x:h,y:u},i),i.shape[1])];e.moveTo(p.x,p.y),e.lineTo(m.x,m.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=ce(o.transform.scale/5,.8,2.5),e.stroke()}}};var iu=2.2,fo=7,[au,lu]=[.03,.75],cu=2.4477,ul=9,mo=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!s||!r)return;let i=so(
e,n);e.save(),Be(e,n),this.cloud(e,n,r);let a=s.modes.map(l=>({place:l,...this.ring(e,n,r,l,i)}));for(let{place:l,at:c,short:h}of a)i.place(si(l.probability),c.
x,c.y,h);e.restore(),i.write()}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||1;e.strokeStyle=e.fillStyle=s.theme.belief,
e.lineWidth=1.2;for(let c=0;c<a.length;c++){if(a[c]<au**2*l)continue;let[h,u,p]=i.subarray(3*c,3*c+3),m=o.fromGrid(Ae({x:h,y:u},r),r.shape[1]);e.globalAlpha=lu*
Math.sqrt(a[c]/l),e.beginPath(),e.arc(m.x,m.y,iu,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(m.x,m.y),e.lineTo(m.x+fo*Math.cos(p),m.y-fo*Math.sin(p)),e.stroke()}
e.globalAlpha=1}ring(e,{view:n,look:o},s,r,i){let[a,l,c]=r.mean,h=n.fromGrid(Ae({x:a,y:l},s),s.shape[1]),u=cu*n.transform.scale/s.resolution,[[p,m],[,y]]=r.covariance,
[v,b]=[(p+y)/2,Math.hypot((p-y)/2,m)],[x,S]=[v+b,v-b].map(E=>Math.max(ul,u*Math.sqrt(Math.max(E,0))));e.beginPath(),e.ellipse(h.x,h.y,x,S,-Math.atan2(2*m,p-y)/2,
0,2*Math.PI);let A=ul+1;return e.moveTo(h.x+A*Math.cos(c),h.y-A*Math.sin(c)),e.lineTo(h.x+(A+fo)*Math.cos(c),h.y-(A+fo)*Math.sin(c)),e.strokeStyle=o.theme.halo,
e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i.avoid(h,S),i.avoid(h,2,{x:h.x+(A+fo)*Math.cos(c),y:h.y-(A+fo)*Math.sin(c)}),{at:h,
short:S}}},si=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var fl=900,jo=2,ri=()=>[new ao,new co,new uo,new po,new ho,new ro,new mo,new lo];function ml({session:t,look:e}){let[n,o]=t.shape,s=new to;s.resize(fl,Math.round(
ce(fl*o/n,300,1800)),jo),s.fit(t.shape);let r=document.createElement("canvas");Object.assign(r,{width:s.width*jo,height:s.height*jo});let i=r.getContext("2d");i.
scale(jo,jo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);let a={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let l of ri())
(l.shows?.(a)??!0)&&(i.save(),l.paint(i,a),i.restore());return new Promise(l=>r.toBlob(l))}var _s=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:l,document:c}=o;if(!i||!c||l?.index!==
i.scan)return;Be(e,n);let{grid:h,max_range:u}=c,p=b=>{let x={x:i.from.x+b*Math.cos(i.angle),y:i.from.y+b*Math.sin(i.angle)};return s.fromGrid(Ae(x,h),h.shape[1])},
m=(b,x,S,A)=>{e.beginPath(),e.moveTo(b.x,b.y),e.lineTo(x.x,x.y),e.lineWidth=S,e.strokeStyle=A,e.stroke()},y=l.hit[i.beam]===1,v=p(y?l.ranges[i.beam]:u);if(m(p(0),
v,3,r.theme.halo),m(p(0),v,1.5,y?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let b=(x,S)=>ce(x??S,0,u);if(m(p(b(a.low,0)),p(b(a.high,u)),6,r.theme.ghost),
a.median!==null){let x=p(a.median),S={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};m({x:x.x-S.x,y:x.y-S.y},{x:x.x+S.x,y:x.y+S.y},2.5,r.theme.ghost)}}y&&(e.beginPath(),
e.arc(v.x,v.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};var gl="bayesmap-token",ii="bayesmap-kept",yl="bayesmap-tools";function wl(t){try{return localStorage.getItem(t)}catch{return null}}function Cs(t,e){try{e===null?
localStorage.removeItem(t):localStorage.setItem(t,e)}catch{}}function ai(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Cs(ii,JSON.stringify(
t))}function bl(){Cs(ii,null)}function xl(){let t=wl(ii);try{return t&&JSON.parse(t)}catch{return null}}var vl=()=>wl(yl)!==null,kl=t=>Cs(yl,t?"all":null);function Sl(t){
t&&Cs(gl,t)}function Ml(t){let e=n=>{n.key===gl&&n.newValue&&t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",
e)}var li=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["where","Where am I?","where"],["path","Path","path"],
["evidence","Evidence","evidence"],["look","Look next","look"],["ghost","Ghost","ghost"]],hu=5;function Tl(t){let{hand:e,session:n}=t,o=t.segmented("Tool",li,()=>n.
editable||!n.document||Ft.has(e.tool)?e.tool:"pan",i=>e.choose(i));t.visible(o,()=>!n.recorded);let s=vl(),r=t.button(null,"More tools",()=>{kl(s=!s),n.changed()},
{text:"More"});return t.visible(r,()=>n.answers),t.each(()=>{let i=li.filter(([l])=>Ft.has(l)?!n.figure||l==="pan"||l==="where":!n.document||n.editable).map(([l])=>l),
a=new Set(s?i:i.slice(0,hu));li.forEach(([l],c)=>_(o.children[c],"hidden",!a.has(l)&&!(l===e.tool&&i.includes(l)))),_(r.lastElementChild,"textContent",s?"Fewer":
"More"),st(r,"aria-label",s?"Fewer tools":"More tools"),_(r,"title",s?"Fewer tools":"More tools: paths, evidence, where to look next, the ghost")}),M("div",{className:"\
bar"},o,r,M("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),
{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Zt=t=>t.charAt(0).toUpperCase()+t.slice(1),Ls=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=Zt(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var pu=20,du={importance:"particles",propagate:"rounds"},Ns=({working:t,shown:e})=>t&&e?.method==="pilot";function Al(t,...e){let{session:n}=t,o=M("progress",{max:1,
value:0,"aria-label":"Progress"}),s=M("div",{className:"doing"});t.each(()=>{let i=n.shown,{stage:a}=n,l=i?.generation!==n.generation&&(n.running||n.document?.source.
kind==="log"),c=Ns(n),h=a?a.done/a.total:i&&!l&&i.total>0&&(c||!i.approximate)?i.sweeps/i.total:0;_(o,"value",h);let u=n.remaining_s(),p=du[i?.method??""]??"swe\
eps",m=i&&!i.approximate&&i.total?`${i.sweeps} of ${i.total} ${p}`:"",y=u!==null?u<1?"less than 1 s left":`${Math.ceil(u)} s left`:n.running?"running":"",v=m&&i?.
burned?`burn-in of ${i.burned} left out`:"",b=n.sampling||n.running||!i||i.sweeps>=i.total?"":"stopped";a?_(s,"textContent",`${a.text}: ${a.done} of ${a.total} ${a.
total>pu?"scans":"rounds"}`):l?_(s,"textContent","Computing"):i&&c?_(s,"textContent",`Fitting the sensor: sweep ${i.sweeps} of ${i.total}`):_(s,"textContent",Zt(
[m,v,y,m&&b].filter(Boolean).join(", "))||fu(n))});let r=M("p",{className:"caption",textContent:"Where am I? takes the walls as drawn. What follows here is abou\
t walls that are not known."});return t.visible(r,()=>n.where.map!==null),t.section("Posterior",r,gu(t),o,s,...yu(t),bu(t),...e,wu(t))}var uu=({document:t})=>!/importance|propagate/.
test(t?.method??"")||(t?.cells??"binary")!=="binary";function fu({shown:t,working:e,document:n,nothingToRun:o,recorded:s}){let r=!s&&n?.source.kind!=="run",i=r&&
n?.method==="importance"?"; Run weighs particles":r&&o?"; it is done, and Run has nothing to add":"";return t?.method==="propagate"?`${t.sweeps?`${t.sweeps} rou\
nds of belief`:"Belief"} propagation${i}`:t?.method==="hits"?"Counts of hits and passes":t?.method==="counts"?"Run infers where the robot was":t?.method==="pilo\
t"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function mu({document:t,shown:e,draws:n}){return e?.method==="counts"?"infer where the rob\
ot was, then sample maps":t?.cells==="binary"&&t.method==="importance"?"weigh particles":t?.cells==="binary"&&t.method==="propagate"?"belief propagation":n.count?
"more sweeps of the chains on show":"sample maps"}function gu(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"primary",text:"Run",
title:()=>`Run (R): ${mu(e)}`,when:()=>e.connection.connected&&!e.nothingToRun,why:()=>e.nothingToRun||"Not while the connection is lost"}),o=t.button("close","\
Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||e.sampling||Ns(e),why:"Nothing is running"}),s=t.checkbox("Live",()=>!!(e.
state?.live??!0),i=>e.act({type:"live",on:i}),"Infer anew after every edit; Run goes on from the draws that are kept"),r=M("div",{className:"buttons"},n,o,s);return t.
visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function yu(t){let{session:e}=t,n=M("dl"),o=M("dl",{className:"about"}),s=(a,l,c,{judged:h=!1,ofChains:u=!1}={})=>{
let p=M("dd",{textContent:"–"}),m=M("dt",{textContent:a}),y=M("div",{title:l},m,p);n.append(y),h&&t.named.push({name:()=>a,place:y,control:y});let v=[M("dt",{
textContent:a}),M("dd",{textContent:l})];if(o.append(...v),u)for(let b of[y,...v])t.visible(b,()=>uu(e));return t.each(()=>{_(p,"textContent",e.shown?c(e.shown):
"–"),h&&_(p,"className",e.shown?.verdict?.level??"")}),{entry:y,name:m}};s("ESS","Effective sample size of the log joint: so many independent draws would tell\
 as much of its mean",a=>pe(a.ess,0),{judged:!0}),s("R-hat","Agreement of the chains on the log joint: 1 where they agree, more where each still tells of its st\
art",a=>pe(a.rhat,3),{judged:!0,ofChains:!0});let r=s("log joint","Log of prior times likelihood: of the draw on show, or the mean over the chains at the last s\
weep",a=>pe(a.log_joint,Math.abs(a.log_joint??0)<1e5?1:0),{ofChains:!0});s("time","Time spent on sweeps, rounds or particles",a=>pe(a.seconds,1," s")),t.each(()=>_(
r.name,"textContent",`log joint, ${e.layer==="draw"?"draw":"mean"}`));let i=s("reply","From the hand's last move to its picture",()=>pe(e.latency.eventToPaint_ms.
at(-1),0," ms"));return t.visible(i.entry,()=>!e.recorded),[n,M("details",{},M("summary",{textContent:"What these figures mean"}),o)]}var Vo=({shown:t})=>t?.method===
"importance"?{good:"Enough particles",fair:"Few particles",bad:"Collapsed"}:{good:"Converged",fair:"Nearly converged",bad:"Not converged"};function wu(t){let{session:e}=t,
n=M("dl",{className:"about"}),o=M("details",{},M("summary",{textContent:"Model and method of this picture"}),n),s="";return t.each(()=>{let r=e.shown?.about??[];
_(o,"hidden",!r.length),String(r)!==s&&(s=String(r),n.replaceChildren(...r.flatMap(([i,a])=>[M("dt",{textContent:i}),M("dd",{textContent:a})])))}),o}function bu(t){
let{session:e}=t,n=M("span"),o=t.button(null,"Show the cell",()=>t.command(`cell ${e.shown?.verdict?.cell}`),{text:"Show the cell"});t.visible(o,()=>!!e.shown?.
verdict?.cell);let s=M("div",{className:"verdict"},n,o);return t.each(()=>{let r=e.shown?.verdict;if(!r)return _(s,"hidden",s.hidden||!e.working),_(n,"textConte\
nt","Too early to judge."),_(s,"className","verdict early");_(s,"hidden",!1),_(n,"textContent",`${Vo(e)[r.level]}: ${r.why}`),_(s,"className",`verdict ${r.level}`)}),
s}function Pl(t,e){let{session:n}=t,s=t.checkbox("Keep this result beside the next",()=>e.kept!==null,r=>r?e.keep():e.forget(),"Change the method, the order, the \
prior or the map, and compare: both results follow the layer and the draw");return t.visible(s,()=>n.locates&&(e.kept!==null||n.shown!==null)),s}function _l(t,e){
let[n,o]=[M("p",{className:"told-apart"}),M("p",{className:"told-apart"})];return t.visible(n,()=>e.kept!==null),t.each(()=>{if(!e.kept)return;let[s,r]=e.differences();
_(n,"textContent",`Now: ${s}. ${El(t.session)}`),_(o,"textContent",`Kept: ${r}. ${El(e.kept)}`)}),{now:n,kept:o}}function El(t){let{shown:e,draws:n}=t;if(!e)return"";
let o=e.layer==="draw"?[`Draw ${t.draw+1} of ${n.count}, log joint ${pe(e.log_joint,1)}`]:[],s=e.verdict?[Vo(t)[e.verdict.level]]:[],r=e.rhat===null?[]:[`R-hat ${pe(
e.rhat,3)}, ESS ${pe(e.ess,0)}`];return[...o,...s,...r].map(i=>`${i}.`).join(" ")}var xu="uplot",vu="u-hz",ku="u-vt",Su="u-title",Mu="u-wrap",Tu="u-under",Au="u-over",Eu="u-axis",Cn="u-off",Pu="u-select",_u="u-cursor-x",Cu="u-cursor-y",Lu="u-\
cursor-pt",Nu="u-legend",Du="u-live",$u="u-inline",Ru="u-series",Fu="u-marker",Cl="u-label",Iu="u-value",Yo="width",qo="height";var Ll="bottom",go="left",ci="right",Ai="#000",Nl=Ai+"0",hi="mousemove",Dl="mousedown",pi="mouseup",$l="mouseenter",Rl="mouseleave",Fl="dblclick",Ou="resize",Bu="\
scroll",Il="change",Is="dppxchange",Ei="--",So=typeof window<"u",gi=So?document:null,wo=So?window:null,Uu=So?navigator:null,be,Ds;function yi(){let t=devicePixelRatio;
be!=t&&(be=t,Ds&&bi(Il,Ds,yi),Ds=matchMedia(`(min-resolution: ${be-.001}dppx) and (max-resolution: ${be+.001}dppx)`),Ln(Il,Ds,yi),wo.dispatchEvent(new CustomEvent(
Is)))}function xt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function wi(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Ce(t,e,n){
t.style[e]=n+"px"}function It(t,e,n,o){let s=gi.createElement(t);return e!=null&&xt(s,e),n?.insertBefore(s,o),s}function Et(t,e){return It("div",t,e)}var Ol=new WeakMap;
function Kt(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=Ol.get(t);r!=i&&(t.style.transform=r,Ol.set(t,r),e<0||n<0||e>o||n>s?xt(t,Cn):wi(t,Cn))}var Bl=new WeakMap;
function Ul(t,e,n){let o=e+n,s=Bl.get(t);o!=s&&(Bl.set(t,o),t.style.background=e,t.style.borderColor=n)}var Wl=new WeakMap;function Gl(t,e,n,o){let s=e+""+n,r=Wl.
get(t);s!=r&&(Wl.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Pi={passive:!0},Wu={...Pi,
capture:!0};function Ln(t,e,n,o){e.addEventListener(t,n,o?Wu:Pi)}function bi(t,e,n,o){e.removeEventListener(t,n,Pi)}So&&yi();function Ot(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:vt((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function gc(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var yc=t=>t!=null,wc=t=>t!=null&&t>0,Us=gc(yc),Gu=gc(wc);function Hu(t,e,n,o=0,s=!1){
let r=s?Gu:Us,i=s?wc:yc;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(o==1)a=t[e],l=t[n];else if(o==-1)a=t[n],l=t[e];else for(let c=e;c<=n;c++){let h=t[c];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??Me,l??-Me]}function Ws(t,e,n,o){let s=Vl(t),r=Vl(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Qt:bc,a=s==1?vt:Pt,l=r==1?Pt:vt,
c=a(i(Ve(t))),h=l(i(Ve(e))),u=bo(n,c),p=bo(n,h);return n==10&&(c<0&&(u=Te(u,-c)),h<0&&(p=Te(p,-h))),o||n==2?(t=u*s,e=p*r):(t=Sc(t,u),e=Gs(e,p)),[t,e]}function _i(t,e,n,o){
let s=Ws(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ci=.1,Hl={mode:3,pad:Ci},Jo={pad:0,soft:null,mode:0},ju={min:Jo,max:Jo};function Os(t,e,n,o){return Hs(
n)?jl(t,e,n):(Jo.pad=n,Jo.soft=o?0:null,Jo.mode=o?3:0,jl(t,e,ju))}function ye(t,e){return t??e}function Vu(t,e,n){for(e=ye(e,0),n=ye(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function jl(t,e,n){let o=n.min,s=n.max,r=ye(o.pad,0),i=ye(s.pad,0),a=ye(o.hard,-Me),l=ye(s.hard,Me),c=ye(o.soft,Me),h=ye(s.soft,-Me),
u=ye(o.mode,0),p=ye(s.mode,0),m=e-t,y=Qt(m),v=ut(Ve(t),Ve(e)),b=Qt(v),x=Ve(b-y);(m<1e-24||x>10)&&(m=0,(t==0||e==0)&&(m=1e-24,u==2&&c!=Me&&(r=0),p==2&&h!=-Me&&(i=
0)));let S=m||v||1e3,A=Qt(S),E=bo(10,vt(A)),D=S*(m==0?t==0?.1:1:r),L=Te(Sc(t-D,E/10),24),O=t>=c&&(u==1||u==3&&L<=c||u==2&&L>=c)?c:Me,G=ut(a,L<O&&t>=O?O:Bt(O,L)),
te=S*(m==0?e==0?.1:1:i),X=Te(Gs(e+te,E/10),24),R=e<=h&&(p==1||p==3&&X>=h||p==2&&X<=h)?h:-Me,ee=Bt(l,X>R&&e<=R?R:ut(R,X));return G==ee&&G==0&&(ee=100),[G,ee]}var zu=new Intl.
NumberFormat(So?Uu.language:"en-US"),Li=t=>zu.format(t),kt=Math,Fs=kt.PI,Ve=kt.abs,vt=kt.floor,je=kt.round,Pt=kt.ceil,Bt=kt.min,ut=kt.max,bo=kt.pow,Vl=kt.sign,Qt=kt.
log10,bc=kt.log2,Yu=(t,e=1)=>kt.sinh(t)*e,di=(t,e=1)=>kt.asinh(t/e),Me=1/0;function zl(t){return(Qt((t^t>>31)-(t>>31))|0)+1}function xi(t,e,n){return Bt(ut(t,e),
n)}function xc(t){return typeof t=="function"}function ue(t){return xc(t)?t:()=>t}var qu=()=>{},vc=t=>t,kc=(t,e)=>e,Ku=t=>null,Yl=t=>!0,ql=(t,e)=>t==e,Ju=/\.\d*?(?=9{6,}|0{6,})/gm,
Nn=t=>{if(Tc(t)||un.has(t))return t;let e=`${t}`,n=e.match(Ju);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Nn(
s)}e${r}`}return Te(t,o)};function Pn(t,e){return Nn(Te(Nn(t/e))*e)}function Gs(t,e){return Nn(Pt(Nn(t/e))*e)}function Sc(t,e){return Nn(vt(Nn(t/e))*e)}function Te(t,e=0){
if(Tc(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return je(o)/n}var un=new Map;function Mc(t){return((""+t).split(".")[1]||"").length}function Zo(t,e,n,o){
let s=[],r=o.map(Mc);for(let i=e;i<n;i++){let a=Ve(i),l=Te(bo(t,i),a);for(let c=0;c<o.length;c++){let h=t==10?+`${o[c]}e${i}`:o[c]*l,u=(i>=0?0:a)+(i>=r[c]?0:r[c]),
p=t==10?h:Te(h,u);s.push(p),un.set(p,u)}}return s}var Xo={},Ni=[],xo=[null,null],dn=Array.isArray,Tc=Number.isInteger,Xu=t=>t===void 0;function Kl(t){return typeof t==
"string"}function Hs(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function Zu(t){return t!=null&&typeof t=="object"}var Qu=Object.getPrototypeOf(
Uint8Array),Ac="__proto__";function vo(t,e=Hs){let n;if(dn(t)){let o=t.find(s=>s!=null);if(dn(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=vo(t[s],
e)}else n=t.slice()}else if(t instanceof Qu)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Ac&&(n[o]=vo(t[o],e))}else n=t;return n}function Ue(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=Ac&&(Hs(t[s])?Ue(t[s],vo(o[s])):t[s]=vo(o[s]))}return t}var ef=0,tf=1,nf=2;function of(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function sf(t,e){if(lf(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return cf(i[0])||(i=af(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],c=l.length;for(let h=0;h<
c;h++)n.add(l[h])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),p=e?e[i][c]:tf,m=[];for(let y=0;y<h.length;y++){let v=h[y],b=r.get(l[y]);v===null?p!=ef&&(u[b]=v,
p==nf&&m.push(b)):u[b]=v}of(u,m,s),o.push(u)}}return o}var rf=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function af(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[o[l]];s.push(a)}return s}function lf(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function cf(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=ut(1,vt((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var Ec=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Pc=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function _c(t){
return t.slice(0,3)}var hf=Pc.map(_c),pf=Ec.map(_c),df={MMMM:Ec,MMM:pf,WWWW:Pc,WWW:hf};function zo(t){return(t<10?"0":"")+t}function uf(t){return(t<10?"00":t<100?
"0":"")+t}var ff={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>zo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>zo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>zo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>zo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>zo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>uf(t.getMilliseconds())};function Di(t,e){e=e||df;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?ff[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var mf=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function gf(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==mf?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var Cc=t=>t%1==0,Bs=[1,2,2.5,5],yf=Zo(10,-32,0,Bs),Lc=Zo(10,0,32,Bs),wf=Lc.filter(
Cc),_n=yf.concat(Lc),$i=`
`,Nc="{YYYY}",Jl=$i+Nc,Dc="{M}/{D}",Ko=$i+Dc,$s=Ko+"/{YY}",$c="{aa}",bf="{h}:{mm}",yo=bf+$c,Xl=$i+yo,Zl=":{ss}",xe=null;function Rc(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,l=(t==1?Zo(10,0,3,Bs).filter(Cc):Zo(10,-3,0,Bs)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),c=[[i,Nc,xe,xe,xe,xe,xe,xe,1],[s*28,"{MMM}",Jl,xe,xe,xe,xe,xe,1],[s,Dc,Jl,xe,
xe,xe,xe,xe,1],[o,"{h}"+$c,$s,xe,Ko,xe,xe,xe,1],[n,yo,$s,xe,Ko,xe,xe,xe,1],[e,Zl,$s+" "+yo,xe,Ko+" "+yo,xe,Xl,xe,1],[t,Zl+".{fff}",$s+" "+yo,xe,Ko+" "+yo,xe,Xl,
xe,1]];function h(u){return(p,m,y,v,b,x)=>{let S=[],A=b>=i,E=b>=r&&b<i,D=u(y),L=Te(D*t,3),O=ui(D.getFullYear(),A?0:D.getMonth(),E||A?1:D.getDate()),G=Te(O*t,3);
if(E||A){let te=E?b/r:0,X=A?b/i:0,R=L==G?L:Te(ui(O.getFullYear()+X,O.getMonth()+te,1)*t,3),ee=new Date(je(R/t)),B=ee.getFullYear(),P=ee.getMonth();for(let C=0;R<=
v;C++){let U=ui(B+X*C,P+te*C,1),I=U-u(Te(U*t,3));R=Te((+U+I)*t,3),R<=v&&S.push(R)}}else{let te=b>=s?s:b,X=vt(y)-vt(L),R=G+X+Gs(L-G,te);S.push(R);let ee=u(R),B=ee.
getHours()+ee.getMinutes()/n+ee.getSeconds()/o,P=b/o,C=p.axes[m]._space,U=x/C;for(;R=Te(R+b,t==1?0:3),!(R>v);)if(P>1){let I=vt(Te(B+P,6))%24,J=u(R).getHours()-I;
J>1&&(J=-1),R-=J*o,B=(B+P)%24;let Q=S[S.length-1];Te((R-Q)/b,3)*U>=.7&&S.push(R)}else S.push(R)}return S}}return[l,c,h]}var[xf,vf,kf]=Rc(1),[Sf,Mf,Tf]=Rc(.001);
Zo(2,-53,53,[1]);function Ql(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function ec(t,e){return(n,o,s,r,i)=>{let a=e.find(
y=>i>=y[0])||e[e.length-1],l,c,h,u,p,m;return o.map(y=>{let v=t(y),b=v.getFullYear(),x=v.getMonth(),S=v.getDate(),A=v.getHours(),E=v.getMinutes(),D=v.getSeconds(),
L=b!=l&&a[2]||x!=c&&a[3]||S!=h&&a[4]||A!=u&&a[5]||E!=p&&a[6]||D!=m&&a[7]||a[1];return l=b,c=x,h=S,u=A,p=E,m=D,L(v)})}}function Af(t,e){let n=Di(e);return(o,s,r,i,a)=>s.
map(l=>n(t(l)))}function ui(t,e,n){return new Date(t,e,n)}function tc(t,e){return e(t)}var Ef="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function nc(t,e){return(n,o,s,r)=>r==
null?Ei:e(t(o))}function Pf(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function _f(t,e){return t.series[e].fill(
t,e)}var Cf={show:!0,live:!0,isolate:!1,mount:qu,markers:{show:!0,width:2,stroke:Pf,fill:_f,dash:"solid"},idx:null,idxs:null,values:[]};function Lf(t,e){let n=t.
cursor.points,o=Et(),s=n.size(t,e);Ce(o,Yo,s),Ce(o,qo,s);let r=s/-2;Ce(o,"marginLeft",r),Ce(o,"marginTop",r);let i=n.width(t,e,s);return i&&Ce(o,"borderWidth",i),
o}function Nf(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Df(t,e){let n=t.series[e].points;return n._stroke||n._fill}function $f(t,e){return t.
series[e].points.size}var fi=[0,0];function Rf(t,e,n){return fi[0]=e,fi[1]=n,fi}function Rs(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function mi(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var Ff={show:!0,x:!0,y:!0,lock:!1,move:Rf,points:{one:!1,show:Lf,size:$f,width:0,stroke:Df,fill:Nf},bind:{mousedown:Rs,mouseup:Rs,
click:Rs,dblclick:Rs,mousemove:mi,mouseleave:mi,mouseenter:mi},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Fc={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Ri=Ue({},Fc,{filter:kc}),Ic=Ue({},Ri,{size:10}),Oc=Ue({},Fc,{show:!1}),Fi='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Bc="bold "+Fi,Uc=1.5,oc={
show:!0,scale:"x",stroke:Ai,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Bc,side:2,grid:Ri,ticks:Ic,border:Oc,font:Fi,lineGap:Uc,rotate:0},
If="Value",Of="Time",sc={show:!0,scale:"x",auto:!1,sorted:1,min:Me,max:-Me,idxs:[]};function Bf(t,e,n,o,s){return e.map(r=>r==null?"":Li(r))}function Uf(t,e,n,o,s,r,i){
let a=[],l=un.get(s)||0;n=i?n:Te(Gs(n,s),l);for(let c=n;c<=o;c=Te(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function vi(t,e,n,o,s,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,c=l==10?Qt:bc,h=vt(c(n));s=bo(l,h),l==10&&(s=_n[Ot(s,_n)]);let u=n,p=s*l;l==10&&(p=_n[Ot(p,_n)]);do a.push(u),u=u+s,l==10&&!un.has(u)&&(u=Te(u,un.get(
s))),u>=p&&(s=u,p=s*l,l==10&&(p=_n[Ot(p,_n)]));while(u<=o);return a}function Wf(t,e,n,o,s,r,i){let l=t.scales[t.axes[e].scale].asinh,c=o>l?vi(t,e,ut(l,n),o,s):[
l],h=o>=0&&n<=0?[0]:[];return(n<-l?vi(t,e,ut(l,-o),-n,s):[l]).reverse().map(p=>-p).concat(h,c)}var Wc=/./,Gf=/[12357]/,Hf=/[125]/,rc=/1/,ki=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function jf(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,c=r._space,h=l(10,i),u=l(
9,i)-h>=c?Wc:l(7,i)-h>=c?Gf:l(5,i)-h>=c?Hf:rc;if(u==rc){let p=Ve(l(1,i)-h);if(p<c)return ki(e.slice().reverse(),a.distr,u,Pt(c/p)).reverse()}return ki(e,a.distr,
u,1)}function Vf(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,c=Ve(l(1,i)-l(2,i));return c<a?ki(e.slice().reverse(),3,Wc,Pt(a/c)).reverse():e}function zf(t,e,n,o){
return o==null?Ei:e==null?"":Li(e)}var ic={show:!0,scale:"y",stroke:Ai,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Bc,side:3,grid:Ri,ticks:Ic,
border:Oc,font:Fi,lineGap:Uc,rotate:0};function Yf(t,e){let n=3+(t||1)*2;return Te(n*e,3)}function qf(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Ve(i-r),l=t.series[e],c=a/(l.points.space*be);return o[1]-o[0]<=c}var ac={scale:null,auto:!0,sorted:0,min:Me,max:-Me},
Gc=(t,e,n,o,s)=>s,lc={show:!0,auto:!0,sorted:0,gaps:Gc,alpha:1,facets:[Ue({},ac,{scale:"x"}),Ue({},ac,{scale:"y"})]},cc={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Gc,alpha:1,points:{show:qf,filter:null},values:null,min:Me,max:-Me,idxs:[],path:null,clip:null};function Kf(t,e,n,o,s){return n/10}var Hc={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Jf=Ue({},Hc,{time:!1,ori:1}),hc={};function jc(t,e){let n=hc[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,l,c){for(let h=0;h<n.plots.length;h++)n.plots[h]!=s&&n.plots[h].pub(o,s,r,i,a,l,c)}},t!=null&&(hc[t]=
n)),n}var ko=1,Si=2;function Dn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],c=o==2?r[1]:r[e],h=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],u=o==2?i[s.facets[1].scale]:i[s.scale],p=a.left,m=a.top,y=a.width,v=a.height,b=t.valToPosH,x=t.valToPosV;return h.ori==0?n(s,l,c,h,u,b,x,p,
m,y,v,Vs,Mo,Ys,zc,qc):n(s,l,c,h,u,x,b,m,p,v,y,zs,To,Bi,Yc,Kc)}function Ii(t,e){let n=0,o=0,s=ye(t.bands,Ni);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function Xf(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function en(t,e,n,o,s,r){return Dn(t,e,(i,a,l,c,h,u,p,m,y,v,b)=>{let x=i.pxRound,S=c.
dir*(c.ori==0?1:-1),A=c.ori==0?Mo:To,E,D;S==1?(E=n,D=o):(E=o,D=n);let L=x(u(a[E],c,v,m)),O=x(p(l[E],h,b,y)),G=x(u(a[D],c,v,m)),te=x(p(r==1?h.max:h.min,h,b,y)),X=new Path2D(
s);return A(X,G,te),A(X,L,te),A(X,L,O),X})}function js(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?Ys:Bi,l=n;for(let u=0;u<t.length;u++){let p=t[u];
if(p[1]>p[0]){let m=p[0]-l;m>0&&a(i,l,o,m,o+r),l=p[1]}}let c=n+s-l,h=10;c>0&&a(i,l,o-h/2,c,o+r+h)}return i}function Zf(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Oi(t,e,n,o,s,r,i){let a=[],l=t.length;for(let c=s==1?n:o;c>=n&&c<=o;c+=s)if(e[c]===null){let u=c,p=c;if(s==1)for(;++c<=o&&e[c]===null;)
p=c;else for(;--c>=n&&e[c]===null;)p=c;let m=r(t[u]),y=p==u?m:r(t[p]),v=u-s;m=i<=0&&v>=0&&v<l?r(t[v]):m;let x=p+s;y=i>=0&&x>=0&&x<l?r(t[x]):y,y>=m&&a.push([m,y])}
return a}function pc(t){return t==0?vc:t==1?je:e=>Pn(e,t)}function Vc(t){let e=t==0?Vs:zs,n=t==0?(s,r,i,a,l,c)=>{s.arcTo(r,i,a,l,c)}:(s,r,i,a,l,c)=>{s.arcTo(i,r,
l,a,c)},o=t==0?(s,r,i,a,l)=>{s.rect(r,i,a,l)}:(s,r,i,a,l)=>{s.rect(i,r,l,a)};return(s,r,i,a,l,c=0,h=0)=>{c==0&&h==0?o(s,r,i,a,l):(c=Bt(c,a/2,l/2),h=Bt(h,a/2,l/2),
e(s,r+c,i),n(s,r+a,i,r+a,i+l,c),n(s,r+a,i+l,r,i+l,h),n(s,r,i+l,r,i,h),n(s,r,i,r+a,i,c),s.closePath())}}var Vs=(t,e,n)=>{t.moveTo(e,n)},zs=(t,e,n)=>{t.moveTo(n,e)},
Mo=(t,e,n)=>{t.lineTo(e,n)},To=(t,e,n)=>{t.lineTo(n,e)},Ys=Vc(0),Bi=Vc(1),zc=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},Yc=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},qc=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},Kc=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function Jc(t){return(e,n,o,s,r)=>Dn(e,n,(i,a,l,c,h,u,p,m,y,v,b)=>{let{pxRound:x,
points:S}=i,A,E;c.ori==0?(A=Vs,E=zc):(A=zs,E=Yc);let D=Te(S.width*be,3),L=(S.size-S.width)/2*be,O=Te(L*2,3),G=new Path2D,te=new Path2D,{left:X,top:R,width:ee,height:B}=e.
bbox;Ys(te,X-O,R-O,ee+O*2,B+O*2);let P=C=>{if(l[C]!=null){let U=x(u(a[C],c,v,m)),I=x(p(l[C],h,b,y));A(G,U+L,I),E(G,U,I,L,0,Fs*2)}};if(r)r.forEach(P);else for(let C=o;C<=
s;C++)P(C);return{stroke:D>0?G:null,fill:G,clip:te,flags:ko|Si}})}function Xc(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var Qf=Xc(Mo),em=Xc(To);function Zc(t){let e=ye(t?.alignGaps,0);return(n,o,s,r)=>Dn(n,o,(i,a,l,c,h,u,p,m,y,v,b)=>{[s,r]=Us(l,s,r);let x=i.pxRound,S=B=>x(u(B,c,v,
m)),A=B=>x(p(B,h,b,y)),E,D;c.ori==0?(E=Mo,D=Qf):(E=To,D=em);let L=c.dir*(c.ori==0?1:-1),O={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ko},G=O.
stroke,te=!1;if(r-s>=v*4){let B=W=>n.posToVal(W,c.key,!0),P=null,C=null,U,I,ie,K=S(a[L==1?s:r]),J=S(a[s]),Q=S(a[r]),q=B(L==1?J+1:Q-1);for(let W=L==1?s:r;W>=s&&W<=
r;W+=L){let me=a[W],de=(L==1?me<q:me>q)?K:S(me),ae=l[W];de==K?ae!=null?(I=ae,P==null?(E(G,de,A(I)),U=P=C=I):I<P?P=I:I>C&&(C=I)):ae===null&&(te=!0):(P!=null&&D(G,
K,A(P),A(C),A(U),A(I)),ae!=null?(I=ae,E(G,de,A(I)),P=C=U=I):(P=C=null,ae===null&&(te=!0)),K=de,q=B(K+L))}P!=null&&P!=C&&ie!=K&&D(G,K,A(P),A(C),A(U),A(I))}else for(let B=L==
1?s:r;B>=s&&B<=r;B+=L){let P=l[B];P===null?te=!0:P!=null&&E(G,S(a[B]),A(P))}let[R,ee]=Ii(n,o);if(i.fill!=null||R!=0){let B=O.fill=new Path2D(G),P=i.fillTo(n,o,i.
min,i.max,R),C=A(P),U=S(a[s]),I=S(a[r]);L==-1&&([I,U]=[U,I]),E(B,I,C),E(B,U,C)}if(!i.spanGaps){let B=[];te&&B.push(...Oi(a,l,s,r,L,S,e)),O.gaps=B=i.gaps(n,o,s,r,
B),O.clip=js(B,c.ori,m,y,v,b)}return ee!=0&&(O.band=ee==2?[en(n,o,s,r,G,-1),en(n,o,s,r,G,1)]:en(n,o,s,r,G,ee)),O})}function tm(t){let e=ye(t.align,1),n=ye(t.ascDesc,
!1),o=ye(t.alignGaps,0),s=ye(t.extend,!1);return(r,i,a,l)=>Dn(r,i,(c,h,u,p,m,y,v,b,x,S,A)=>{[a,l]=Us(u,a,l);let E=c.pxRound,{left:D,width:L}=r.bbox,O=J=>E(y(J,p,
S,b)),G=J=>E(v(J,m,A,x)),te=p.ori==0?Mo:To,X={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ko},R=X.stroke,ee=p.dir*(p.ori==0?1:-1),B=G(u[ee==
1?a:l]),P=O(h[ee==1?a:l]),C=P,U=P;s&&e==-1&&(U=D,te(R,U,B)),te(R,P,B);for(let J=ee==1?a:l;J>=a&&J<=l;J+=ee){let Q=u[J];if(Q==null)continue;let q=O(h[J]),W=G(Q);
e==1?te(R,q,B):te(R,C,W),te(R,q,W),B=W,C=q}let I=C;s&&e==1&&(I=D+L,te(R,I,B));let[ie,K]=Ii(r,i);if(c.fill!=null||ie!=0){let J=X.fill=new Path2D(R),Q=c.fillTo(r,
i,c.min,c.max,ie),q=G(Q);te(J,I,q),te(J,U,q)}if(!c.spanGaps){let J=[];J.push(...Oi(h,u,a,l,ee,O,o));let Q=c.width*be/2,q=n||e==1?Q:-Q,W=n||e==-1?-Q:Q;J.forEach(
me=>{me[0]+=q,me[1]+=W}),X.gaps=J=c.gaps(r,i,a,l,J),X.clip=js(J,p.ori,b,x,S,A)}return K!=0&&(X.band=K==2?[en(r,i,a,l,R,-1),en(r,i,a,l,R,1)]:en(r,i,a,l,R,K)),X})}
function dc(t,e,n,o,s,r,i=Me){if(t.length>1){let a=null;for(let l=0,c=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=Ve(t[l]-t[a]);h<c&&(c=h,i=Ve(n(t[l],
o,s,r)-n(t[a],o,s,r)))}a=l}}return i}function nm(t){t=t||Xo;let e=ye(t.size,[.6,Me,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==null?[0,0]:typeof s=="number"?[s,
0]:s;let r=ue(s),i=1-e[0],a=ye(e[1],Me),l=ye(e[2],1),c=ye(t.disp,Xo),h=ye(t.each,m=>{}),{fill:u,stroke:p}=c;return(m,y,v,b)=>Dn(m,y,(x,S,A,E,D,L,O,G,te,X,R)=>{let ee=x.
pxRound,B=n,P=o*be,C=a*be,U=l*be,I,ie;E.ori==0?[I,ie]=r(m,y):[ie,I]=r(m,y);let K=E.dir*(E.ori==0?1:-1),J=E.ori==0?Ys:Bi,Q=E.ori==0?h:(V,Se,De,z,se,le,Ke)=>{h(V,
Se,De,se,z,Ke,le)},q=ye(m.bands,Ni).find(V=>V.series[0]==y),W=q!=null?q.dir:0,me=x.fillTo(m,y,x.min,x.max,W),fe=ee(O(me,D,R,te)),de,ae,Fe,We=X,ve=ee(x.width*be),
rt=!1,it=null,Ne=null,Ie=null,_t=null;u!=null&&(ve==0||p!=null)&&(rt=!0,it=u.values(m,y,v,b),Ne=new Map,new Set(it).forEach(V=>{V!=null&&Ne.set(V,new Path2D)}),
ve>0&&(Ie=p.values(m,y,v,b),_t=new Map,new Set(Ie).forEach(V=>{V!=null&&_t.set(V,new Path2D)})));let{x0:Ct,size:gn}=c;if(Ct!=null&&gn!=null){B=1,S=Ct.values(m,y,
v,b),Ct.unit==2&&(S=S.map(De=>m.posToVal(G+De*X,E.key,!0)));let V=gn.values(m,y,v,b);gn.unit==2?ae=V[0]*X:ae=L(V[0],E,X,G)-L(0,E,X,G),We=dc(S,A,L,E,X,G,We),Fe=We-
ae+P}else We=dc(S,A,L,E,X,G,We),Fe=We*i+P,ae=We-Fe;Fe<1&&(Fe=0),ve>=ae/2&&(ve=0),Fe<5&&(ee=vc);let nn=Fe>0,Wt=We-Fe-(nn?ve:0);ae=ee(xi(Wt,U,C)),de=(B==0?ae/2:B==
K?0:ae)-B*K*((B==0?P/2:0)+(nn?ve/2:0));let qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Jt=rt?null:new Path2D,Lt=null;if(q!=null)Lt=m.data[q.
series[1]];else{let{y0:V,y1:Se}=c;V!=null&&Se!=null&&(A=Se.values(m,y,v,b),Lt=V.values(m,y,v,b))}let Gt=I*ae,re=ie*ae;for(let V=K==1?v:b;V>=v&&V<=b;V+=K){let Se=A[V];
if(Se==null)continue;if(Lt!=null){let ft=Lt[V]??0;if(Se-ft==0)continue;fe=O(ft,D,R,te)}let De=E.distr!=2||c!=null?S[V]:V,z=L(De,E,X,G),se=O(ye(Se,me),D,R,te),le=ee(
z-de),Ke=ee(ut(se,fe)),at=ee(Bt(se,fe)),Ge=Ke-at;if(Se!=null){let ft=Se<0?re:Gt,Nt=Se<0?Gt:re;rt?(ve>0&&Ie[V]!=null&&J(_t.get(Ie[V]),le,at+vt(ve/2),ae,ut(0,Ge-ve),
ft,Nt),it[V]!=null&&J(Ne.get(it[V]),le,at+vt(ve/2),ae,ut(0,Ge-ve),ft,Nt)):J(Jt,le,at+vt(ve/2),ae,ut(0,Ge-ve),ft,Nt),Q(m,y,V,le-ve/2,at,ae+ve,Ge)}}return ve>0?qe.
stroke=rt?_t:Jt:rt||(qe._fill=x.width==0?x._fill:x._stroke??x._fill,qe.width=0),qe.fill=rt?Ne:Jt,qe})}function om(t,e){let n=ye(e?.alignGaps,0);return(o,s,r,i)=>Dn(
o,s,(a,l,c,h,u,p,m,y,v,b,x)=>{[r,i]=Us(c,r,i);let S=a.pxRound,A=I=>S(p(I,h,b,y)),E=I=>S(m(I,u,x,v)),D,L,O;h.ori==0?(D=Vs,O=Mo,L=qc):(D=zs,O=To,L=Kc);let G=h.dir*
(h.ori==0?1:-1),te=A(l[G==1?r:i]),X=te,R=[],ee=[];for(let I=G==1?r:i;I>=r&&I<=i;I+=G)if(c[I]!=null){let K=l[I],J=A(K);R.push(X=J),ee.push(E(c[I]))}let B={stroke:t(
R,ee,D,O,L,S),fill:null,clip:null,band:null,gaps:null,flags:ko},P=B.stroke,[C,U]=Ii(o,s);if(a.fill!=null||C!=0){let I=B.fill=new Path2D(P),ie=a.fillTo(o,s,a.min,
a.max,C),K=E(ie);O(I,X,K),O(I,te,K)}if(!a.spanGaps){let I=[];I.push(...Oi(l,c,r,i,G,A,n)),B.gaps=I=a.gaps(o,s,r,i,I),B.clip=js(I,h.ori,y,v,b,x)}return U!=0&&(B.
band=U==2?[en(o,s,r,i,P,-1),en(o,s,r,i,P,1)]:en(o,s,r,i,P,U)),B})}function sm(t){return om(rm,t)}function rm(t,e,n,o,s,r){let i=t.length;if(i<2)return null;let a=new Path2D;
if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let l=Array(i),c=Array(i-1),h=Array(i-1),u=Array(i-1);for(let p=0;p<i-1;p++)h[p]=e[p+1]-e[p],u[p]=t[p+1]-t[p],c[p]=h[p]/
u[p];l[0]=c[0];for(let p=1;p<i-1;p++)c[p]===0||c[p-1]===0||c[p-1]>0!=c[p]>0?l[p]=0:(l[p]=3*(u[p-1]+u[p])/((2*u[p]+u[p-1])/c[p-1]+(u[p]+2*u[p-1])/c[p]),isFinite(
l[p])||(l[p]=0));l[i-1]=c[i-2];for(let p=0;p<i-1;p++)s(a,t[p]+u[p]/3,e[p]+l[p]*u[p]/3,t[p+1]-u[p]/3,e[p+1]-l[p+1]*u[p]/3,t[p+1],e[p+1])}return a}var Mi=new Set;
function uc(){for(let t of Mi)t.syncRect(!0)}So&&(Ln(Ou,wo,uc),Ln(Bu,wo,uc,!0),Ln(Is,wo,()=>{ze.pxRatio=be}));var im=Zc(),am=Jc();function fc(t,e,n,o){return(o?
[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Ti(r,i,e,n))}function lm(t,e){return t.map((n,o)=>o==0?{}:Ue({},e,n))}function Ti(t,e,n,o){
return Ue({},e==0?n:o,t)}function Qc(t,e,n){return e==null?xo:[e,n]}var cm=Qc;function hm(t,e,n){return e==null?xo:Os(e,n,Ci,!0)}function eh(t,e,n,o){return e==
null?xo:Ws(e,n,t.scales[o].log,!1)}var pm=eh;function th(t,e,n,o){return e==null?xo:_i(e,n,t.scales[o].log,!1)}var dm=th;function um(t,e,n,o,s){let r=ut(zl(t),zl(
e)),i=e-t,a=Ot(s/o*i,n);do{let l=n[a],c=o*l/i;if(c>=s&&r+(l<5?un.get(l):0)<=17)return[l,c]}while(++a<n.length);return[0,0]}function mc(t){let e,n;return t=t.replace(
/(\d+)px/,(o,s)=>(e=je((n=+s)*be))+"px"),[t,e,n]}function fm(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=Te(e[2]*be,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),
e[1]=n})}function ze(t,e,n){let o={mode:ye(t.mode,1)},s=o.mode;function r(d,f,g,w){let k=f.valToPct(d);return w+g*(f.dir==-1?1-k:k)}function i(d,f,g,w){let k=f.
valToPct(d);return w+g*(f.dir==-1?k:1-k)}function a(d,f,g,w){return f.ori==0?r(d,f,g,w):i(d,f,g,w)}o.valToPosH=r,o.valToPosV=i;let l=!1;o.status=0;let c=o.root=
Et(xu);if(t.id!=null&&(c.id=t.id),xt(c,t.class),t.title){let d=Et(Su,c);d.textContent=t.title}let h=It("canvas"),u=o.ctx=h.getContext("2d"),p=Et(Mu,c);Ln("click",
p,d=>{d.target===y&&(Ee!=Yn||Le!=qn)&&ot.click(o,d)},!0);let m=o.under=Et(Tu,p);p.appendChild(h);let y=o.over=Et(Au,p);t=vo(t);let v=+ye(t.pxAlign,1),b=pc(v);(t.
plugins||[]).forEach(d=>{d.opts&&(t=d.opts(o,t)||t)});let x=t.ms||.001,S=o.series=s==1?fc(t.series||[],sc,cc,!1):lm(t.series||[null],lc),A=o.axes=fc(t.axes||[],
oc,ic,!0),E=o.scales={},D=o.bands=t.bands||[];D.forEach(d=>{d.fill=ue(d.fill||null),d.dir=ye(d.dir,-1)});let L=s==2?S[1].facets[0].scale:S[0].scale,O={axes:ud,series:ld},
G=(t.drawOrder||["axes","series"]).map(d=>O[d]);function te(d){let f=d.distr==3?g=>Qt(g>0?g:d.clamp(o,g,d.min,d.max,d.key)):d.distr==4?g=>di(g,d.asinh):d.distr==
100?g=>d.fwd(g):g=>g;return g=>{let w=f(g),{_min:k,_max:T}=d,N=T-k;return(w-k)/N}}function X(d){let f=E[d];if(f==null){let g=(t.scales||Xo)[d]||Xo;if(g.from!=null){
X(g.from);let w=Ue({},E[g.from],g,{key:d});w.valToPct=te(w),E[d]=w}else{f=E[d]=Ue({},d==L?Hc:Jf,g),f.key=d;let w=f.time,k=f.range,T=dn(k);if((d!=L||s==2&&!w)&&(T&&
(k[0]==null||k[1]==null)&&(k={min:k[0]==null?Hl:{mode:1,hard:k[0],soft:k[0]},max:k[1]==null?Hl:{mode:1,hard:k[1],soft:k[1]}},T=!1),!T&&Hs(k))){let N=k;k=($,F,H)=>F==
null?xo:Os(F,H,N)}f.range=ue(k||(w?cm:d==L?f.distr==3?pm:f.distr==4?dm:Qc:f.distr==3?eh:f.distr==4?th:hm)),f.auto=ue(T?!1:f.auto),f.clamp=ue(f.clamp||Kf),f._min=
f._max=null,f.valToPct=te(f)}}}X("x"),X("y"),s==1&&S.forEach(d=>{X(d.scale)}),A.forEach(d=>{X(d.scale)});for(let d in t.scales)X(d);let R=E[L],ee=R.distr,B,P;R.
ori==0?(xt(c,vu),B=r,P=i):(xt(c,ku),B=i,P=r);let C={};for(let d in E){let f=E[d];(f.min!=null||f.max!=null)&&(C[d]={min:f.min,max:f.max},f.min=f.max=null)}let U=t.
tzDate||(d=>new Date(je(d/x))),I=t.fmtDate||Di,ie=x==1?kf(U):Tf(U),K=ec(U,Ql(x==1?vf:Mf,I)),J=nc(U,tc(Ef,I)),Q=[],q=o.legend=Ue({},Cf,t.legend),W=o.cursor=Ue({},
Ff,{drag:{y:s==2}},t.cursor),me=q.show,fe=W.show,de=q.markers;q.idxs=Q,de.width=ue(de.width),de.dash=ue(de.dash),de.stroke=ue(de.stroke),de.fill=ue(de.fill);let ae,
Fe,We,ve=[],rt=[],it,Ne=!1,Ie={};if(q.live){let d=S[1]?S[1].values:null;Ne=d!=null,it=Ne?d(o,1,0):{_:0};for(let f in it)Ie[f]=Ei}if(me)if(ae=It("table",Nu,c),We=
It("tbody",null,ae),q.mount(o,ae),Ne){Fe=It("thead",null,ae,We);let d=It("tr",null,Fe);It("th",null,d);for(var _t in it)It("th",Cl,d).textContent=_t}else xt(ae,
$u),q.live&&xt(ae,Du);let Ct={show:!0},gn={show:!1};function nn(d,f){if(f==0&&(Ne||!q.live||s==2))return xo;let g=[],w=It("tr",Ru,We,We.childNodes[f]);xt(w,d.class),
d.show||xt(w,Cn);let k=It("th",null,w);if(de.show){let $=Et(Fu,k);if(f>0){let F=de.width(o,f);F&&($.style.border=F+"px "+de.dash(o,f)+" "+de.stroke(o,f)),$.style.
background=de.fill(o,f)}}let T=Et(Cl,k);d.label instanceof HTMLElement?T.appendChild(d.label):T.textContent=d.label,f>0&&(de.show||(T.style.color=d.width>0?de.stroke(
o,f):de.fill(o,f)),qe("click",k,$=>{if(W._lock)return;wn($);let F=S.indexOf(d);if(($.ctrlKey||$.metaKey)!=q.isolate){let H=S.some((j,Y)=>Y>0&&Y!=F&&j.show);S.forEach(
(j,Y)=>{Y>0&&jt(Y,H?Y==F?Ct:gn:Ct,!0,Oe.setSeries)})}else jt(F,{show:!d.show},!0,Oe.setSeries)},!1),On&&qe($l,k,$=>{W._lock||(wn($),jt(S.indexOf(d),Jn,!0,Oe.setSeries))},
!1));for(var N in it){let $=It("td",Iu,w);$.textContent="--",g.push($)}return[w,g]}let Wt=new Map;function qe(d,f,g,w=!0){let k=Wt.get(f)||{},T=W.bind[d](o,f,g,
w);T&&(Ln(d,f,k[d]=T),Wt.set(f,k))}function Jt(d,f,g){let w=Wt.get(f)||{};for(let k in w)(d==null||k==d)&&(bi(k,f,w[k]),delete w[k]);d==null&&Wt.delete(f)}let Lt=0,
Gt=0,re=0,V=0,Se=0,De=0,z=Se,se=De,le=re,Ke=V,at=0,Ge=0,ft=0,Nt=0;o.bbox={};let Er=!1,os=!1,In=!1,yn=!1,ss=!1,St=!1;function Pr(d,f,g){(g||d!=o.width||f!=o.height)&&
da(d,f),Hn(!1),In=!0,os=!0,jn()}function da(d,f){o.width=Lt=re=d,o.height=Gt=V=f,Se=De=0,td(),nd();let g=o.bbox;at=g.left=Pn(Se*be,.5),Ge=g.top=Pn(De*be,.5),ft=
g.width=Pn(re*be,.5),Nt=g.height=Pn(V*be,.5)}let Zp=3;function Qp(){let d=!1,f=0;for(;!d;){f++;let g=pd(f),w=dd(f);d=f==Zp||g&&w,d||(da(o.width,o.height),os=!0)}}
function ed({width:d,height:f}){Pr(d,f)}o.setSize=ed;function td(){let d=!1,f=!1,g=!1,w=!1;A.forEach((k,T)=>{if(k.show&&k._show){let{side:N,_size:$}=k,F=N%2,H=k.
label!=null?k.labelSize:0,j=$+H;j>0&&(F?(re-=j,N==3?(Se+=j,w=!0):g=!0):(V-=j,N==0?(De+=j,d=!0):f=!0))}}),bn[0]=d,bn[1]=g,bn[2]=f,bn[3]=w,re-=on[1]+on[3],Se+=on[3],
V-=on[2]+on[0],De+=on[0]}function nd(){let d=Se+re,f=De+V,g=Se,w=De;function k(T,N){switch(T){case 1:return d+=N,d-N;case 2:return f+=N,f-N;case 3:return g-=N,g+
N;case 0:return w-=N,w+N}}A.forEach((T,N)=>{if(T.show&&T._show){let $=T.side;T._pos=k($,T._size),T.label!=null&&(T._lpos=k($,T.labelSize))}})}if(W.dataIdx==null){
let d=W.hover,f=d.skip=new Set(d.skip??[]);f.add(void 0);let g=d.prox=ue(d.prox),w=d.bias??=0;W.dataIdx=(k,T,N,$)=>{if(T==0)return N;let F=N,H=g(k,T,N,$)??Me,j=H>=
0&&H<Me,Y=R.ori==0?re:V,oe=W.left,we=e[0],ge=e[T];if(f.has(ge[N])){F=null;let he=null,ne=null,Z;if(w==0||w==-1)for(Z=N;he==null&&Z-- >0;)f.has(ge[Z])||(he=Z);if(w==
0||w==1)for(Z=N;ne==null&&Z++<ge.length;)f.has(ge[Z])||(ne=Z);if(he!=null||ne!=null)if(j){let _e=he==null?-1/0:B(we[he],R,Y,0),$e=ne==null?1/0:B(we[ne],R,Y,0),tt=oe-
_e,ke=$e-oe;tt<=ke?tt<=H&&(F=he):ke<=H&&(F=ne)}else F=ne==null?he:he==null?ne:N-he<=ne-N?he:ne}else j&&Ve(oe-B(we[N],R,Y,0))>H&&(F=null);return F}}let wn=d=>{W.
event=d};W.idxs=Q,W._lock=!1;let lt=W.points;lt.show=ue(lt.show),lt.size=ue(lt.size),lt.stroke=ue(lt.stroke),lt.width=ue(lt.width),lt.fill=ue(lt.fill);let Ht=o.
focus=Ue({},t.focus||{alpha:.3},W.focus),On=Ht.prox>=0,Bn=On&&lt.one,Mt=[],Un=[],Wn=[];function ua(d,f){let g=lt.show(o,f);if(g instanceof HTMLElement)return xt(
g,Lu),xt(g,d.class),Kt(g,-10,-10,re,V),y.insertBefore(g,Mt[f]),g}function fa(d,f){if(s==1||f>0){let g=s==1&&E[d.scale].time,w=d.value;d.value=g?Kl(w)?nc(U,tc(w,
I)):w||J:w||zf,d.label=d.label||(g?Of:If)}if(Bn||f>0){d.width=d.width==null?1:d.width,d.paths=d.paths||im||Ku,d.fillTo=ue(d.fillTo||Xf),d.pxAlign=+ye(d.pxAlign,
v),d.pxRound=pc(d.pxAlign),d.stroke=ue(d.stroke||null),d.fill=ue(d.fill||null),d._stroke=d._fill=d._paths=d._focus=null;let g=Yf(ut(1,d.width),1),w=d.points=Ue(
{},{size:g,width:ut(1,g*.2),stroke:d.stroke,space:g*2,paths:am,_stroke:null,_fill:null},d.points);w.show=ue(w.show),w.filter=ue(w.filter),w.fill=ue(w.fill),w.stroke=
ue(w.stroke),w.paths=ue(w.paths),w.pxAlign=d.pxAlign}if(me){let g=nn(d,f);ve.splice(f,0,g[0]),rt.splice(f,0,g[1]),q.values.push(null)}if(fe){Q.splice(f,0,null);
let g=null;Bn?f==0&&(g=ua(d,f)):f>0&&(g=ua(d,f)),Mt.splice(f,0,g),Un.splice(f,0,0),Wn.splice(f,0,0)}et("addSeries",f)}function od(d,f){f=f??S.length,d=s==1?Ti(d,
f,sc,cc):Ti(d,f,{},lc),S.splice(f,0,d),fa(S[f],f)}o.addSeries=od;function sd(d){if(S.splice(d,1),me){q.values.splice(d,1),rt.splice(d,1);let f=ve.splice(d,1)[0];
Jt(null,f.firstChild),f.remove()}fe&&(Q.splice(d,1),Mt.splice(d,1)[0].remove(),Un.splice(d,1),Wn.splice(d,1)),et("delSeries",d)}o.delSeries=sd;let bn=[!1,!1,!1,
!1];function rd(d,f){if(d._show=d.show,d.show){let g=d.side%2,w=E[d.scale];w==null&&(d.scale=g?S[1].scale:L,w=E[d.scale]);let k=w.time;d.size=ue(d.size),d.space=
ue(d.space),d.rotate=ue(d.rotate),dn(d.incrs)&&d.incrs.forEach(N=>{!un.has(N)&&un.set(N,Mc(N))}),d.incrs=ue(d.incrs||(w.distr==2?wf:k?x==1?xf:Sf:_n)),d.splits=ue(
d.splits||(k&&w.distr==1?ie:w.distr==3?vi:w.distr==4?Wf:Uf)),d.stroke=ue(d.stroke),d.grid.stroke=ue(d.grid.stroke),d.ticks.stroke=ue(d.ticks.stroke),d.border.stroke=
ue(d.border.stroke);let T=d.values;d.values=dn(T)&&!dn(T[0])?ue(T):k?dn(T)?ec(U,Ql(T,I)):Kl(T)?Af(U,T):T||K:T||Bf,d.filter=ue(d.filter||(w.distr>=3&&w.log==10?jf:
w.distr==3&&w.log==2?Vf:kc)),d.font=mc(d.font),d.labelFont=mc(d.labelFont),d._size=d.size(o,null,f,0),d._space=d._rotate=d._incrs=d._found=d._splits=d._values=null,
d._size>0&&(bn[f]=!0,d._el=Et(Eu,p))}}function Co(d,f,g,w){let[k,T,N,$]=g,F=f%2,H=0;return F==0&&($||T)&&(H=f==0&&!k||f==2&&!N?je(oc.size/3):0),F==1&&(k||N)&&(H=
f==1&&!T||f==3&&!$?je(ic.size/2):0),H}let ma=o.padding=(t.padding||[Co,Co,Co,Co]).map(d=>ue(ye(d,Co))),on=o._padding=ma.map((d,f)=>d(o,f,bn,0)),nt,Je=null,Xe=null,
rs=s==1?S[0].idxs:null,Dt=null,Lo=!1;function ga(d,f){if(e=d??[],o.data=o._data=e,s==2){nt=0;for(let g=1;g<S.length;g++)nt+=e[g][0].length}else{e.length==0&&(o.
data=o._data=e=[[]]),Dt=e[0],nt=Dt.length;let g=e;if(ee==2){g=e.slice();let w=g[0]=Array(nt);for(let k=0;k<nt;k++)w[k]=k}o._data=e=g}if(Hn(!0),et("setData"),ee==
2&&(In=!0),f!==!1){let g=R;g.auto(o,Lo)?_r():rn(L,g.min,g.max),yn=yn||W.left>=0,St=!0,jn()}}o.setData=ga;function _r(){Lo=!0;let d,f;s==1&&(nt>0?(Je=rs[0]=0,Xe=
rs[1]=nt-1,d=e[0][Je],f=e[0][Xe],ee==2?(d=Je,f=Xe):d==f&&(ee==3?[d,f]=Ws(d,d,R.log,!1):ee==4?[d,f]=_i(d,d,R.log,!1):R.time?f=d+je(86400/x):[d,f]=Os(d,f,Ci,!0))):
(Je=rs[0]=d=null,Xe=rs[1]=f=null)),rn(L,d,f)}let is,Gn,Cr,Lr,Nr,Dr,$r,Rr,Fr,mt;function ya(d,f,g,w,k,T){d??=Nl,g??=Ni,w??="butt",k??=Nl,T??="round",d!=is&&(u.strokeStyle=
is=d),k!=Gn&&(u.fillStyle=Gn=k),f!=Cr&&(u.lineWidth=Cr=f),T!=Nr&&(u.lineJoin=Nr=T),w!=Dr&&(u.lineCap=Dr=w),g!=Lr&&u.setLineDash(Lr=g)}function wa(d,f,g,w){f!=Gn&&
(u.fillStyle=Gn=f),d!=$r&&(u.font=$r=d),g!=Rr&&(u.textAlign=Rr=g),w!=Fr&&(u.textBaseline=Fr=w)}function Ir(d,f,g,w,k=0){if(w.length>0&&d.auto(o,Lo)&&(f==null||f.
min==null)){let T=ye(Je,0),N=ye(Xe,w.length-1),$=g.min==null?Hu(w,T,N,k,d.distr==3):[g.min,g.max];d.min=Bt(d.min,g.min=$[0]),d.max=ut(d.max,g.max=$[1])}}let ba={
min:null,max:null};function id(){for(let w in E){let k=E[w];C[w]==null&&(k.min==null||C[L]!=null&&k.auto(o,Lo))&&(C[w]=ba)}for(let w in E){let k=E[w];C[w]==null&&
k.from!=null&&C[k.from]!=null&&(C[w]=ba)}C[L]!=null&&Hn(!0);let d={};for(let w in C){let k=C[w];if(k!=null){let T=d[w]=vo(E[w],Zu);if(k.min!=null)Ue(T,k);else if(w!=
L||s==2)if(nt==0&&T.from==null){let N=T.range(o,null,null,w);T.min=N[0],T.max=N[1]}else T.min=Me,T.max=-Me}}if(nt>0){S.forEach((w,k)=>{if(s==1){let T=w.scale,N=C[T];
if(N==null)return;let $=d[T];if(k==0){let F=$.range(o,$.min,$.max,T);$.min=F[0],$.max=F[1],Je=Ot($.min,e[0]),Xe=Ot($.max,e[0]),Xe-Je>1&&(e[0][Je]<$.min&&Je++,e[0][Xe]>
$.max&&Xe--),w.min=Dt[Je],w.max=Dt[Xe]}else w.show&&w.auto&&Ir($,N,w,e[k],w.sorted);w.idxs[0]=Je,w.idxs[1]=Xe}else if(k>0&&w.show&&w.auto){let[T,N]=w.facets,$=T.
scale,F=N.scale,[H,j]=e[k],Y=d[$],oe=d[F];Y!=null&&Ir(Y,C[$],T,H,T.sorted),oe!=null&&Ir(oe,C[F],N,j,N.sorted),w.min=N.min,w.max=N.max}});for(let w in d){let k=d[w],
T=C[w];if(k.from==null&&(T==null||T.min==null)){let N=k.range(o,k.min==Me?null:k.min,k.max==-Me?null:k.max,w);k.min=N[0],k.max=N[1]}}}for(let w in d){let k=d[w];
if(k.from!=null){let T=d[k.from];if(T.min==null)k.min=k.max=null;else{let N=k.range(o,T.min,T.max,w);k.min=N[0],k.max=N[1]}}}let f={},g=!1;for(let w in d){let k=d[w],
T=E[w];if(T.min!=k.min||T.max!=k.max){T.min=k.min,T.max=k.max;let N=T.distr;T._min=N==3?Qt(T.min):N==4?di(T.min,T.asinh):N==100?T.fwd(T.min):T.min,T._max=N==3?Qt(
T.max):N==4?di(T.max,T.asinh):N==100?T.fwd(T.max):T.max,f[w]=g=!0}}if(g){S.forEach((w,k)=>{s==2?k>0&&f.y&&(w._paths=null):f[w.scale]&&(w._paths=null)});for(let w in f)
In=!0,et("setScale",w);fe&&W.left>=0&&(yn=St=!0)}for(let w in C)C[w]=null}function ad(d){let f=xi(Je-1,0,nt-1),g=xi(Xe+1,0,nt-1);for(;d[f]==null&&f>0;)f--;for(;d[g]==
null&&g<nt-1;)g++;return[f,g]}function ld(){if(nt>0){let d=S.some(f=>f._focus)&&mt!=Ht.alpha;d&&(u.globalAlpha=mt=Ht.alpha),S.forEach((f,g)=>{if(g>0&&f.show&&(xa(
g,!1),xa(g,!0),f._paths==null)){let w=mt;mt!=f.alpha&&(u.globalAlpha=mt=f.alpha);let k=s==2?[0,e[g][0].length-1]:ad(e[g]);f._paths=f.paths(o,g,k[0],k[1]),mt!=w&&
(u.globalAlpha=mt=w)}}),S.forEach((f,g)=>{if(g>0&&f.show){let w=mt;mt!=f.alpha&&(u.globalAlpha=mt=f.alpha),f._paths!=null&&va(g,!1);{let k=f._paths!=null?f._paths.
gaps:null,T=f.points.show(o,g,Je,Xe,k),N=f.points.filter(o,g,T,k);(T||N)&&(f.points._paths=f.points.paths(o,g,Je,Xe,N),va(g,!0))}mt!=w&&(u.globalAlpha=mt=w),et(
"drawSeries",g)}}),d&&(u.globalAlpha=mt=1)}}function xa(d,f){let g=f?S[d].points:S[d];g._stroke=g.stroke(o,d),g._fill=g.fill(o,d)}function va(d,f){let g=f?S[d].
points:S[d],{stroke:w,fill:k,clip:T,flags:N,_stroke:$=g._stroke,_fill:F=g._fill,_width:H=g.width}=g._paths;H=Te(H*be,3);let j=null,Y=H%2/2;f&&F==null&&(F=H>0?"#\
fff":$);let oe=g.pxAlign==1&&Y>0;if(oe&&u.translate(Y,Y),!f){let we=at-H/2,ge=Ge-H/2,he=ft+H,ne=Nt+H;j=new Path2D,j.rect(we,ge,he,ne)}f?Or($,H,g.dash,g.cap,F,w,
k,N,T):cd(d,$,H,g.dash,g.cap,F,w,k,N,j,T),oe&&u.translate(-Y,-Y)}function cd(d,f,g,w,k,T,N,$,F,H,j){let Y=!1;F!=0&&D.forEach((oe,we)=>{if(oe.series[0]==d){let ge=S[oe.
series[1]],he=e[oe.series[1]],ne=(ge._paths||Xo).band;dn(ne)&&(ne=oe.dir==1?ne[0]:ne[1]);let Z,_e=null;ge.show&&ne&&Vu(he,Je,Xe)?(_e=oe.fill(o,we)||T,Z=ge._paths.
clip):ne=null,Or(f,g,w,k,_e,N,$,F,H,j,Z,ne),Y=!0}}),Y||Or(f,g,w,k,T,N,$,F,H,j)}let ka=ko|Si;function Or(d,f,g,w,k,T,N,$,F,H,j,Y){ya(d,f,g,w,k),(F||H||Y)&&(u.save(),
F&&u.clip(F),H&&u.clip(H)),Y?($&ka)==ka?(u.clip(Y),j&&u.clip(j),ls(k,N),as(d,T,f)):$&Si?(ls(k,N),u.clip(Y),as(d,T,f)):$&ko&&(u.save(),u.clip(Y),j&&u.clip(j),ls(
k,N),u.restore(),as(d,T,f)):(ls(k,N),as(d,T,f)),(F||H||Y)&&u.restore()}function as(d,f,g){g>0&&(f instanceof Map?f.forEach((w,k)=>{u.strokeStyle=is=k,u.stroke(w)}):
f!=null&&d&&u.stroke(f))}function ls(d,f){f instanceof Map?f.forEach((g,w)=>{u.fillStyle=Gn=w,u.fill(g)}):f!=null&&d&&u.fill(f)}function hd(d,f,g,w){let k=A[d],
T;if(w<=0)T=[0,0];else{let N=k._space=k.space(o,d,f,g,w),$=k._incrs=k.incrs(o,d,f,g,w,N);T=um(f,g,$,w,N)}return k._found=T}function Br(d,f,g,w,k,T,N,$,F,H){let j=N%
2/2;v==1&&u.translate(j,j),ya($,N,F,H,$),u.beginPath();let Y,oe,we,ge,he=k+(w==0||w==3?-T:T);g==0?(oe=k,ge=he):(Y=k,we=he);for(let ne=0;ne<d.length;ne++)f[ne]!=
null&&(g==0?Y=we=d[ne]:oe=ge=d[ne],u.moveTo(Y,oe),u.lineTo(we,ge));u.stroke(),v==1&&u.translate(-j,-j)}function pd(d){let f=!0;return A.forEach((g,w)=>{if(!g.show)
return;let k=E[g.scale];if(k.min==null){g._show&&(f=!1,g._show=!1,Hn(!1));return}else g._show||(f=!1,g._show=!0,Hn(!1));let T=g.side,N=T%2,{min:$,max:F}=k,[H,j]=hd(
w,$,F,N==0?re:V);if(j==0)return;let Y=k.distr==2,oe=g._splits=g.splits(o,w,$,F,H,j,Y),we=k.distr==2?oe.map(Z=>Dt[Z]):oe,ge=k.distr==2?Dt[oe[1]]-Dt[oe[0]]:H,he=g.
_values=g.values(o,g.filter(o,we,w,j,ge),w,j,ge);g._rotate=T==2?g.rotate(o,he,w,j):0;let ne=g._size;g._size=Pt(g.size(o,he,w,d)),ne!=null&&g._size!=ne&&(f=!1)}),
f}function dd(d){let f=!0;return ma.forEach((g,w)=>{let k=g(o,w,bn,d);k!=on[w]&&(f=!1),on[w]=k}),f}function ud(){for(let d=0;d<A.length;d++){let f=A[d];if(!f.show||
!f._show)continue;let g=f.side,w=g%2,k,T,N=f.stroke(o,d),$=g==0||g==3?-1:1,[F,H]=f._found;if(f.label!=null){let ht=f.labelGap*$,wt=je((f._lpos+ht)*be);wa(f.labelFont[0],
N,"center",g==2?"top":Ll),u.save(),w==1?(k=T=0,u.translate(wt,je(Ge+Nt/2)),u.rotate((g==3?-Fs:Fs)/2)):(k=je(at+ft/2),T=wt);let kn=xc(f.label)?f.label(o,d,F,H):f.
label;u.fillText(kn,k,T),u.restore()}if(H==0)continue;let j=E[f.scale],Y=w==0?ft:Nt,oe=w==0?at:Ge,we=f._splits,ge=j.distr==2?we.map(ht=>Dt[ht]):we,he=j.distr==2?
Dt[we[1]]-Dt[we[0]]:F,ne=f.ticks,Z=f.border,_e=ne.show?ne.size:0,$e=je(_e*be),tt=je((f.alignTo==2?f._size-_e-f.gap:f.gap)*be),ke=f._rotate*-Fs/180,Re=b(f._pos*be),
gt=($e+tt)*$,ct=Re+gt;T=w==0?ct:0,k=w==1?ct:0;let Tt=f.font[0],$t=f.align==1?go:f.align==2?ci:ke>0?go:ke<0?ci:w==0?"center":g==3?ci:go,zt=ke||w==1?"middle":g==2?
"top":Ll;wa(Tt,N,$t,zt);let yt=f.font[1]*f.lineGap,At=we.map(ht=>b(a(ht,j,Y,oe))),Rt=f._values;for(let ht=0;ht<Rt.length;ht++){let wt=Rt[ht];if(wt!=null){w==0?k=
At[ht]:T=At[ht],wt=""+wt;let kn=wt.indexOf(`
`)==-1?[wt]:wt.split(/\n/gm);for(let pt=0;pt<kn.length;pt++){let Wa=kn[pt];ke?(u.save(),u.translate(k,T+pt*yt),u.rotate(ke),u.fillText(Wa,0,0),u.restore()):u.fillText(
Wa,k,T+pt*yt)}}}ne.show&&Br(At,ne.filter(o,ge,d,H,he),w,g,Re,$e,Te(ne.width*be,3),ne.stroke(o,d),ne.dash,ne.cap);let Yt=f.grid;Yt.show&&Br(At,Yt.filter(o,ge,d,H,
he),w,w==0?2:1,w==0?Ge:at,w==0?Nt:ft,Te(Yt.width*be,3),Yt.stroke(o,d),Yt.dash,Yt.cap),Z.show&&Br([Re],[1],w==0?1:0,w==0?1:2,w==1?Ge:at,w==1?Nt:ft,Te(Z.width*be,
3),Z.stroke(o,d),Z.dash,Z.cap)}et("drawAxes")}function Hn(d){S.forEach((f,g)=>{g>0&&(f._paths=null,d&&(s==1?(f.min=null,f.max=null):f.facets.forEach(w=>{w.min=null,
w.max=null})))})}let cs=!1,Ur=!1,No=[];function fd(){Ur=!1;for(let d=0;d<No.length;d++)et(...No[d]);No.length=0}function jn(){cs||(rf(Sa),cs=!0)}function md(d,f=!1){
cs=!0,Ur=f,d(o),Sa(),f&&No.length>0&&queueMicrotask(fd)}o.batch=md;function Sa(){if(Er&&(id(),Er=!1),In&&(Qp(),In=!1),os){if(Ce(m,go,Se),Ce(m,"top",De),Ce(m,Yo,
re),Ce(m,qo,V),Ce(y,go,Se),Ce(y,"top",De),Ce(y,Yo,re),Ce(y,qo,V),Ce(p,Yo,Lt),Ce(p,qo,Gt),h.width=je(Lt*be),h.height=je(Gt*be),A.forEach(({_el:d,_show:f,_size:g,
_pos:w,side:k})=>{if(d!=null)if(f){let T=k===3||k===0?g:0,N=k%2==1;Ce(d,N?"left":"top",w-T),Ce(d,N?"width":"height",g),Ce(d,N?"top":"left",N?De:Se),Ce(d,N?"heig\
ht":"width",N?V:re),wi(d,Cn)}else xt(d,Cn)}),is=Gn=Cr=Nr=Dr=$r=Rr=Fr=Lr=null,mt=1,Ro(!0),Se!=z||De!=se||re!=le||V!=Ke){Hn(!1);let d=re/le,f=V/Ke;if(fe&&!yn&&W.left>=
0){W.left*=d,W.top*=f,Vn&&Kt(Vn,je(W.left),0,re,V),zn&&Kt(zn,0,je(W.top),re,V);for(let g=0;g<Mt.length;g++){let w=Mt[g];w!=null&&(Un[g]*=d,Wn[g]*=f,Kt(w,Pt(Un[g]),
Pt(Wn[g]),re,V))}}if(Pe.show&&!ss&&Pe.left>=0&&Pe.width>0){Pe.left*=d,Pe.width*=d,Pe.top*=f,Pe.height*=f;for(let g in zr)Ce(Kn,g,Pe[g])}z=Se,se=De,le=re,Ke=V}et(
"setSize"),os=!1}Lt>0&&Gt>0&&(u.clearRect(0,0,h.width,h.height),et("drawClear"),G.forEach(d=>d()),et("draw")),Pe.show&&ss&&(hs(Pe),ss=!1),fe&&yn&&(vn(null,!0,!1),
yn=!1),q.show&&q.live&&St&&(jr(),St=!1),l||(l=!0,o.status=1,et("ready")),Lo=!1,cs=!1}o.redraw=(d,f)=>{In=f||!1,d!==!1?rn(L,R.min,R.max):jn()};function Wr(d,f){let g=E[d];
if(g.from==null){if(nt==0){let w=g.range(o,f.min,f.max,d);f.min=w[0],f.max=w[1]}if(f.min>f.max){let w=f.min;f.min=f.max,f.max=w}if(nt>1&&f.min!=null&&f.max!=null&&
f.max-f.min<1e-16)return;d==L&&g.distr==2&&nt>0&&(f.min=Ot(f.min,e[0]),f.max=Ot(f.max,e[0]),f.min==f.max&&f.max++),C[d]=f,Er=!0,jn()}}o.setScale=Wr;let Gr,Hr,Vn,
zn,Ma,Ta,Yn,qn,Aa,Ea,Ee,Le,sn=!1,ot=W.drag,Ze=ot.x,Qe=ot.y;fe&&(W.x&&(Gr=Et(_u,y)),W.y&&(Hr=Et(Cu,y)),R.ori==0?(Vn=Gr,zn=Hr):(Vn=Hr,zn=Gr),Ee=W.left,Le=W.top);let Pe=o.
select=Ue({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Kn=Pe.show?Et(Pu,Pe.over?y:m):null;function hs(d,f){if(Pe.show){for(let g in d)Pe[g]=d[g],g in
zr&&Ce(Kn,g,d[g]);f!==!1&&et("setSelect")}}o.setSelect=hs;function gd(d){if(S[d].show)me&&wi(ve[d],Cn);else if(me&&xt(ve[d],Cn),fe){let g=Bn?Mt[0]:Mt[d];g!=null&&
Kt(g,-10,-10,re,V)}}function rn(d,f,g){Wr(d,{min:f,max:g})}function jt(d,f,g,w){f.focus!=null&&vd(d),f.show!=null&&S.forEach((k,T)=>{T>0&&(d==T||d==null)&&(k.show=
f.show,gd(T),s==2?(rn(k.facets[0].scale,null,null),rn(k.facets[1].scale,null,null)):rn(k.scale,null,null),jn())}),g!==!1&&et("setSeries",d,f),w&&Fo("setSeries",
o,d,f)}o.setSeries=jt;function yd(d,f){Ue(D[d],f)}function wd(d,f){d.fill=ue(d.fill||null),d.dir=ye(d.dir,-1),f=f??D.length,D.splice(f,0,d)}function bd(d){d==null?
D.length=0:D.splice(d,1)}o.addBand=wd,o.setBand=yd,o.delBand=bd;function xd(d,f){S[d].alpha=f,fe&&Mt[d]!=null&&(Mt[d].style.opacity=f),me&&ve[d]&&(ve[d].style.opacity=
f)}let Xt,an,xn,Jn={focus:!0};function vd(d){if(d!=xn){let f=d==null,g=Ht.alpha!=1;S.forEach((w,k)=>{if(s==1||k>0){let T=f||k==0||k==d;w._focus=f?null:T,g&&xd(k,
T?1:Ht.alpha)}}),xn=d,g&&jn()}}me&&On&&qe(Rl,ae,d=>{W._lock||(wn(d),xn!=null&&jt(null,Jn,!0,Oe.setSeries))});function Vt(d,f,g){let w=E[f];g&&(d=d/be-(w.ori==1?
De:Se));let k=re;w.ori==1&&(k=V,d=k-d),w.dir==-1&&(d=k-d);let T=w._min,N=w._max,$=d/k,F=T+(N-T)*$,H=w.distr;return H==3?bo(10,F):H==4?Yu(F,w.asinh):H==100?w.bwd(
F):F}function kd(d,f){let g=Vt(d,L,f);return Ot(g,e[0],Je,Xe)}o.valToIdx=d=>Ot(d,e[0]),o.posToIdx=kd,o.posToVal=Vt,o.valToPos=(d,f,g)=>E[f].ori==0?r(d,E[f],g?ft:
re,g?at:0):i(d,E[f],g?Nt:V,g?Ge:0),o.setCursor=(d,f,g)=>{Ee=d.left,Le=d.top,vn(null,f,g)};function Pa(d,f){Ce(Kn,go,Pe.left=d),Ce(Kn,Yo,Pe.width=f)}function _a(d,f){
Ce(Kn,"top",Pe.top=d),Ce(Kn,qo,Pe.height=f)}let Do=R.ori==0?Pa:_a,$o=R.ori==1?Pa:_a;function Sd(){if(me&&q.live)for(let d=s==2?1:0;d<S.length;d++){if(d==0&&Ne)continue;
let f=q.values[d],g=0;for(let w in f)rt[d][g++].firstChild.nodeValue=f[w]}}function jr(d,f){if(d!=null&&(d.idxs?d.idxs.forEach((g,w)=>{Q[w]=g}):Xu(d.idx)||Q.fill(
d.idx),q.idx=Q[0]),me&&q.live){for(let g=0;g<S.length;g++)(g>0||s==1&&!Ne)&&Md(g,Q[g]);Sd()}St=!1,f!==!1&&et("setLegend")}o.setLegend=jr;function Md(d,f){let g=S[d],
w=d==0&&ee==2?Dt:e[d],k;Ne?k=g.values(o,d,f)??Ie:(k=g.value(o,f==null?null:w[f],d,f),k=k==null?Ie:{_:k}),q.values[d]=k}function vn(d,f,g){Aa=Ee,Ea=Le,[Ee,Le]=W.
move(o,Ee,Le),W.left=Ee,W.top=Le,fe&&(Vn&&Kt(Vn,je(Ee),0,re,V),zn&&Kt(zn,0,je(Le),re,V));let w,k=Je>Xe;Xt=Me,an=null;let T=R.ori==0?re:V,N=R.ori==1?re:V;if(Ee<0||
nt==0||k){w=W.idx=null;for(let $=0;$<S.length;$++){let F=Mt[$];F!=null&&Kt(F,-10,-10,re,V)}On&&jt(null,Jn,!0,d==null&&Oe.setSeries),q.live&&(Q.fill(w),St=!0)}else{
let $,F,H;s==1&&($=R.ori==0?Ee:Le,F=Vt($,L),w=W.idx=Ot(F,e[0],Je,Xe),H=B(e[0][w],R,T,0));let j=-10,Y=-10,oe=0,we=0,ge=!0,he="",ne="";for(let Z=s==2?1:0;Z<S.length;Z++){
let _e=S[Z],$e=Q[Z],tt=$e==null?null:s==1?e[Z][$e]:e[Z][1][$e],ke=W.dataIdx(o,Z,w,F),Re=ke==null?null:s==1?e[Z][ke]:e[Z][1][ke];if(St=St||Re!=tt||ke!=$e,Q[Z]=ke,
Z>0&&_e.show){let gt=ke==null?-10:ke==w?H:B(s==1?e[0][ke]:e[Z][0][ke],R,T,0),ct=Re==null?-10:P(Re,s==1?E[_e.scale]:E[_e.facets[1].scale],N,0);if(On&&Re!=null){let Tt=R.
ori==1?Ee:Le,$t=Ve(Ht.dist(o,Z,ke,ct,Tt));if($t<Xt){let zt=Ht.bias;if(zt!=0){let yt=Vt(Tt,_e.scale),At=Re>=0?1:-1,Rt=yt>=0?1:-1;Rt==At&&(Rt==1?zt==1?Re>=yt:Re<=
yt:zt==1?Re<=yt:Re>=yt)&&(Xt=$t,an=Z)}else Xt=$t,an=Z}}if(St||Bn){let Tt,$t;R.ori==0?(Tt=gt,$t=ct):(Tt=ct,$t=gt);let zt,yt,At,Rt,Yt,ht,wt=!0,kn=lt.bbox;if(kn!=null){
wt=!1;let pt=kn(o,Z);At=pt.left,Rt=pt.top,zt=pt.width,yt=pt.height}else At=Tt,Rt=$t,zt=yt=lt.size(o,Z);if(ht=lt.fill(o,Z),Yt=lt.stroke(o,Z),Bn)Z==an&&Xt<=Ht.prox&&
(j=At,Y=Rt,oe=zt,we=yt,ge=wt,he=ht,ne=Yt);else{let pt=Mt[Z];pt!=null&&(Un[Z]=At,Wn[Z]=Rt,Gl(pt,zt,yt,wt),Ul(pt,ht,Yt),Kt(pt,Pt(At),Pt(Rt),re,V))}}}}if(Bn){let Z=Ht.
prox,_e=xn==null?Xt<=Z:Xt>Z||an!=xn;if(St||_e){let $e=Mt[0];$e!=null&&(Un[0]=j,Wn[0]=Y,Gl($e,oe,we,ge),Ul($e,he,ne),Kt($e,Pt(j),Pt(Y),re,V))}}}if(Pe.show&&sn)if(d!=
null){let[$,F]=Oe.scales,[H,j]=Oe.match,[Y,oe]=d.cursor.sync.scales,we=d.cursor.drag;if(Ze=we._x,Qe=we._y,Ze||Qe){let{left:ge,top:he,width:ne,height:Z}=d.select,
_e=d.scales[Y].ori,$e=d.posToVal,tt,ke,Re,gt,ct,Tt=$!=null&&H($,Y),$t=F!=null&&j(F,oe);Tt&&Ze?(_e==0?(tt=ge,ke=ne):(tt=he,ke=Z),Re=E[$],gt=B($e(tt,Y),Re,T,0),ct=
B($e(tt+ke,Y),Re,T,0),Do(Bt(gt,ct),Ve(ct-gt))):Do(0,T),$t&&Qe?(_e==1?(tt=ge,ke=ne):(tt=he,ke=Z),Re=E[F],gt=P($e(tt,oe),Re,N,0),ct=P($e(tt+ke,oe),Re,N,0),$o(Bt(gt,
ct),Ve(ct-gt))):$o(0,N)}else Yr()}else{let $=Ve(Aa-Ma),F=Ve(Ea-Ta);if(R.ori==1){let oe=$;$=F,F=oe}Ze=ot.x&&$>=ot.dist,Qe=ot.y&&F>=ot.dist;let H=ot.uni;H!=null?Ze&&
Qe&&(Ze=$>=H,Qe=F>=H,!Ze&&!Qe&&(F>$?Qe=!0:Ze=!0)):ot.x&&ot.y&&(Ze||Qe)&&(Ze=Qe=!0);let j,Y;Ze&&(R.ori==0?(j=Yn,Y=Ee):(j=qn,Y=Le),Do(Bt(j,Y),Ve(Y-j)),Qe||$o(0,N)),
Qe&&(R.ori==1?(j=Yn,Y=Ee):(j=qn,Y=Le),$o(Bt(j,Y),Ve(Y-j)),Ze||Do(0,T)),!Ze&&!Qe&&(Do(0,0),$o(0,0))}if(ot._x=Ze,ot._y=Qe,d==null){if(g){if(Ua!=null){let[$,F]=Oe.
scales;Oe.values[0]=$!=null?Vt(R.ori==0?Ee:Le,$):null,Oe.values[1]=F!=null?Vt(R.ori==1?Ee:Le,F):null}Fo(hi,o,Ee,Le,re,V,w)}if(On){let $=g&&Oe.setSeries,F=Ht.prox;
xn==null?Xt<=F&&jt(an,Jn,!0,$):Xt>F?jt(null,Jn,!0,$):an!=xn&&jt(an,Jn,!0,$)}}St&&(q.idx=w,jr()),f!==!1&&et("setCursor")}let ln=null;Object.defineProperty(o,"rec\
t",{get(){return ln==null&&Ro(!1),ln}});function Ro(d=!1){d?ln=null:(ln=y.getBoundingClientRect(),et("syncRect",ln))}function Ca(d,f,g,w,k,T,N){W._lock||sn&&d!=
null&&d.movementX==0&&d.movementY==0||(Vr(d,f,g,w,k,T,N,!1,d!=null),d!=null?vn(null,!0,!0):vn(f,!0,!1))}function Vr(d,f,g,w,k,T,N,$,F){if(ln==null&&Ro(!1),wn(d),
d!=null)g=d.clientX-ln.left,w=d.clientY-ln.top;else{if(g<0||w<0){Ee=-10,Le=-10;return}let[H,j]=Oe.scales,Y=f.cursor.sync,[oe,we]=Y.values,[ge,he]=Y.scales,[ne,Z]=Oe.
match,_e=f.axes[0].side%2==1,$e=R.ori==0?re:V,tt=R.ori==1?re:V,ke=_e?T:k,Re=_e?k:T,gt=_e?w:g,ct=_e?g:w;if(ge!=null?g=ne(H,ge)?a(oe,E[H],$e,0):-10:g=$e*(gt/ke),he!=
null?w=Z(j,he)?a(we,E[j],tt,0):-10:w=tt*(ct/Re),R.ori==1){let Tt=g;g=w,w=Tt}}F&&(f==null||f.cursor.event.type==hi)&&((g<=1||g>=re-1)&&(g=Pn(g,re)),(w<=1||w>=V-1)&&
(w=Pn(w,V))),$?(Ma=g,Ta=w,[Yn,qn]=W.move(o,g,w)):(Ee=g,Le=w)}let zr={width:0,height:0,left:0,top:0};function Yr(){hs(zr,!1)}let La,Na,Da,$a;function Ra(d,f,g,w,k,T,N){
sn=!0,Ze=Qe=ot._x=ot._y=!1,Vr(d,f,g,w,k,T,N,!0,!1),d!=null&&(qe(pi,gi,Fa,!1),Fo(Dl,o,Yn,qn,re,V,null));let{left:$,top:F,width:H,height:j}=Pe;La=$,Na=F,Da=H,$a=j}
function Fa(d,f,g,w,k,T,N){sn=ot._x=ot._y=!1,Vr(d,f,g,w,k,T,N,!1,!0);let{left:$,top:F,width:H,height:j}=Pe,Y=H>0||j>0,oe=La!=$||Na!=F||Da!=H||$a!=j;if(Y&&oe&&hs(
Pe),ot.setScale&&Y&&oe){let we=$,ge=H,he=F,ne=j;if(R.ori==1&&(we=F,ge=j,he=$,ne=H),Ze&&rn(L,Vt(we,L),Vt(we+ge,L)),Qe)for(let Z in E){let _e=E[Z];Z!=L&&_e.from==
null&&_e.min!=Me&&rn(Z,Vt(he+ne,Z),Vt(he,Z))}Yr()}else W.lock&&(W._lock=!W._lock,vn(f,!0,d!=null));d!=null&&(Jt(pi,gi),Fo(pi,o,Ee,Le,re,V,null))}function Td(d,f,g,w,k,T,N){
if(W._lock)return;wn(d);let $=sn;if(sn){let F=!0,H=!0,j=10,Y,oe;R.ori==0?(Y=Ze,oe=Qe):(Y=Qe,oe=Ze),Y&&oe&&(F=Ee<=j||Ee>=re-j,H=Le<=j||Le>=V-j),Y&&F&&(Ee=Ee<Yn?0:
re),oe&&H&&(Le=Le<qn?0:V),vn(null,!0,!0),sn=!1}Ee=-10,Le=-10,Q.fill(null),vn(null,!0,!0),$&&(sn=$)}function Ia(d,f,g,w,k,T,N){W._lock||(wn(d),_r(),Yr(),d!=null&&
Fo(Fl,o,Ee,Le,re,V,null))}function Oa(){A.forEach(fm),Pr(o.width,o.height,!0)}Ln(Is,wo,Oa);let Xn={};Xn.mousedown=Ra,Xn.mousemove=Ca,Xn.mouseup=Fa,Xn.dblclick=Ia,
Xn.setSeries=(d,f,g,w)=>{let k=Oe.match[2];g=k(o,f,g),g!=-1&&jt(g,w,!0,!1)},fe&&(qe(Dl,y,Ra),qe(hi,y,Ca),qe($l,y,d=>{wn(d),Ro(!1)}),qe(Rl,y,Td),qe(Fl,y,Ia),Mi.add(
o),o.syncRect=Ro);let ps=o.hooks=t.hooks||{};function et(d,f,g){Ur?No.push([d,f,g]):d in ps&&ps[d].forEach(w=>{w.call(null,o,f,g)})}(t.plugins||[]).forEach(d=>{
for(let f in d.hooks)ps[f]=(ps[f]||[]).concat(d.hooks[f])});let Ba=(d,f,g)=>g,Oe=Ue({key:null,setSeries:!1,filters:{pub:Yl,sub:Yl},scales:[L,S[1]?S[1].scale:null],
match:[ql,ql,Ba],values:[null,null]},W.sync);Oe.match.length==2&&Oe.match.push(Ba),W.sync=Oe;let Ua=Oe.key,qr=jc(Ua);function Fo(d,f,g,w,k,T,N){Oe.filters.pub(d,
f,g,w,k,T,N)&&qr.pub(d,f,g,w,k,T,N)}qr.sub(o);function Ad(d,f,g,w,k,T,N){Oe.filters.sub(d,f,g,w,k,T,N)&&Xn[d](null,f,g,w,k,T,N)}o.pub=Ad;function Ed(){qr.unsub(
o),Mi.delete(o),Wt.clear(),bi(Is,wo,Oa),c.remove(),ae?.remove(),et("destroy")}o.destroy=Ed;function Kr(){et("init",t,e),ga(e||t.data,!1),C[L]?Wr(L,C[L]):_r(),ss=
Pe.show&&(Pe.width>0||Pe.height>0),yn=St=!0,Pr(t.width,t.height)}return S.forEach(fa),A.forEach(rd),n?n instanceof HTMLElement?(n.appendChild(c),Kr()):n(o,Kr):Kr(),
o}ze.assign=Ue;ze.fmtNum=Li;ze.rangeNum=Os;ze.rangeLog=Ws;ze.rangeAsinh=_i;ze.orient=Dn;ze.pxRatio=be;ze.join=sf;ze.fmtDate=Di,ze.tzDate=gf;ze.sync=jc;{ze.addGap=
Zf,ze.clipGaps=js;let t=ze.paths={points:Jc};t.linear=Zc,t.stepped=tm,t.bars=nm,t.spline=sm}var qs=128,nh=50,mm=.25,gm=t=>[t.ray,t.truth,t.sensor,t.noReturn],ym=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),wm=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),Ks=(t,e)=>({font:Ms,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function oh(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:qs})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:qs}),s=n()),o)}function sh(t,e){let{session:n}=t,o=M("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${nh}`]],()=>s,y=>{s=y,c=null,n.changed()}),
i=0,a=-1/0,l=-1,c=null,u=oh(o,()=>{let y=gm(e()),v=Array.from({length:i},(b,x)=>({label:`chain ${x+1}`,stroke:y[x%y.length],width:1,points:{show:!1}}));return new ze(
{width:100,height:qs,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,wm,0,0],scales:{x:{time:!1,range:(b,x,S)=>[x,Math.max(S,x+1)]},y:{range:(b,x,S)=>km(
Math.max(x,a),S)}},axes:[Ks(e,26),Ks(e,ym)],series:[{label:"sweep"},...v],hooks:{draw:[b=>Mm(b,l,e()),b=>Sm(b,c?.burned??0,e())]}},[[],...v.map(()=>[])],o)},e),
p=M("span",{className:"caption",textContent:"log joint by sweep"}),m=M("div",{className:"charted"},M("div",{className:"buttons"},r,p),o);return t.each(()=>{let y=n.
shown,v=y?.traced?.length?y.trace.length/y.traced.length:0;if(_(m,"hidden",v===0&&(m.hidden||!n.working)),!y||!v)return;let b=n.document?.source.kind==="run"?"d\
raw":"sweep";_(p,"textContent",`log joint by ${b}`);let x=y.layer==="draw"&&n.draws.count?(n.draw+1)*y.traced[y.traced.length-1]/n.draws.count:-1,S=u(v!==i&&(i=
v,!0));if(!S||c===y&&l===x&&S.data[0].length)return;[c,l]=[y,x],a=s==="all"?vm(y,v):-1/0;let A=bm(y,v,s);S.setData(A),o.setAttribute("data-sweeps",A[0].join())}),
m}function bm({trace:t,traced:e},n,o){let s=o==="all"?xm(e):[...e.keys()].filter(i=>e[i]<=nh),r=i=>Float32Array.from(s,a=>i[a]);return[r(e),...Array.from({length:n},
(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}function xm(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,o=-1/0;return[...t.keys()].filter(
s=>t[s]<o&&s<e-1?!1:(o=t[s]+n,!0))}function vm({trace:t,traced:e},n){let o=e.length,s=e.findIndex(r=>r>=mm*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.
min(...t.slice(i*o+s,(i+1)*o))))}function km(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function Sm(t,e,n){let{left:o,top:s,width:r,height:i}=t.bbox;e&&(t.
ctx.save(),t.ctx.globalAlpha=.12,t.ctx.fillStyle=n.axis,t.ctx.fillRect(o,s,Math.min(r,Math.max(0,t.valToPos(e,"x",!0)-o)),i),t.ctx.restore())}function Mm(t,e,n){
if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.
restore())}function rh(t,e){let{session:n}=t,o=M("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),s=M("div",{className:"\
caption",textContent:"particles by weight, nats below the heaviest"}),r=M("div",{className:"charted"},s,o),a=oh(o,()=>new ze({width:100,height:qs,legend:{show:!1},
cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(c,h,u)=>[h,u]},y:{distr:3,range:(c,h,u)=>[.5,Math.max(10,2*u)]}},axes:[Ks(e,26),{...Ks(e,52),values:(c,h)=>h.
map(u=>u>=1?String(u):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:ze.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),l=null;return t.
each(()=>{let c=n.shown;_(r,"hidden",!c?.weights);let h=c?.weights&&a(!1);if(!c?.weights||!h||l===c&&h.data[0].length)return;l=c;let u=[...c.weights],p=-(c.lowest??
-1)/u.length,m=[...u.map((y,v)=>(c.lowest??-1)+v*p),0];h.setData([m,[...u.map(y=>y||null),null]])}),r}function ih(t){let{session:e,hand:n}=t,{decisions:o}=e,s=M("p",{className:"said",role:"status"}),r=M("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,c=>o.set({radius:c}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>o.risk,c=>o.set({risk:c}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{_(l,"textContent",i()),_(s,"textContent",n.tool==="path"?Tm(t):Am(t))}),a}function Tm({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.",i=Math.
ceil(3e3/o.draws)/1e3,a={0:`in none of ${o.draws} draws: with probability under ${i}`,1:`in all ${o.draws} draws: with probability over ${pe(Math.max(0,1-i),3)}`}[o.
probability];return`${pe(o.length_m,2)} m, free ${a??`with probability ${pe(o.probability,3)} ± ${pe(o.standard_error,3)} by ${o.draws} draws`}${a?" (95 %, wer\
e they independent)":""}. Independent cells would say ${pe(o.independent,3)}.${r}`}function Am({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;
if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tel\
l ${pe(Math.min(...e.nats),1)} to ${pe(o,1)} nats, cells taken for independent; the best place has a ring.${s}`}var Em=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Pm="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",_m="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Cm="Shown is what the reading\
s tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (wi\
dth). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Lm="While you edit, the answer is belief pr\
opagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",Nm="This page samples by itself: the answer is that of the chosen method\
 after as many sweeps as are shown, and gets better as they go on.",Dm="The map is made from the scans of this log. Where its poses are raw odometry, Run first \
infers where the robot was; then it samples maps.",$m="This is a saved run: its draws, and what they say together.",Rm="Mouse: the wheel zooms, the middle butto\
n pans.",Fm="Shift or the right button erases, and so does a click on a wall.",Im="Touch: two fingers zoom and pan.";function ah(t){let{session:e}=t,n=M("div"),
o=tl.map(([i,a,l])=>{let c=M("tr",{},M("th",{scope:"row"},M("kbd",{textContent:i})),M("td",{textContent:a}));return t.visible(c,()=>Om[l??"all"](e)),c}),s=M("p"),
r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?Cm:_m,l=e.editable?[`${Pm} ${a}`,e.figure?Nm:Lm]:i==="log"?[a,Dm]:i==="run"?[a,$m]:[
a];l.join()!==r&&n.replaceChildren(...l.map(c=>M("p",{textContent:c}))),r=l.join(),_(s,"textContent",[Rm,...e.editable?[Fm]:[],Im].join(" "))}),t.dialog("Help",
n,s,M("table",{},M("tbody",{},...o)))}var Om={all:()=>!0,drawn:t=>t.editable,asked:t=>t.answers,located:t=>t.locates,edited:t=>!t.recorded,inferred:t=>!t.recorded&&
t.document?.source.kind!=="run"};function lh(t){let e=()=>M("input",{type:"number",step:1,required:!0,value:"21"}),[n,o]=[e(),e()];for(let i of[n,o])t.bounded(i,
"side");let s=M("select",{});for(let[i,a]of Em){let l=M("option",{value:i,textContent:a});s.append(l),i!=="blank"&&t.visible(l,()=>!t.session.figure)}t.each(()=>t.
session.figure&&_(s,"value","blank")),s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<60&&([n.value,o.value]=["120","80"])});let r=M("for\
m",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),M("div",{className:"buttons end"},M("button",{type:"submit",className:"\
primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),Number(o.value)],world:s.value}),t.hand.
selected=null}),t.dialog("New map",r)}var Bm="The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while t\
he server runs; the part from # on can be put after the address of any bayesmap page.",Um="The link holds the walls, the sensors and all settings after its #. T\
he part from # on can be put after the address of any bayesmap page.",Wm="The link holds the file's name and all settings after its #, but no scans and no token\
. It opens in this browser while the server shows this file; the part from # on can be put after the address of any bayesmap page that shows it.";function ch(t){
let e=M("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=M("span",{role:"status",className:"copied"}),o=async()=>{e.select();try{await navigator.clipboard.
writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},s=t.button(null,"Copy the link",o,{className:"\
primary",text:"Copy"}),r=M("p");t.each(()=>_(r,"textContent",t.session.figure?Um:t.session.document?.source.kind==="simulation"?Bm:Wm));let i=t.dialog("Share",r,
M("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var Gm=8;function hh(t){let{session:e,hand:n}=t,o=M("p",{className:"words",role:"status"}),s=M("ol",{className:"spoken"}),r=M("p",{className:"words"}),i=M("canv\
as",{className:"trace",width:296,height:48,role:"img"}),a=M("p",{className:"caption"}),l=t.section("Evidence of beams",o,r,s,i,a),c=-1;return t.visible(l,()=>n.
tool==="evidence"),t.each(()=>{let{evidence:h}=e;if(_(o,"textContent",zm(e)),c===h.version)return;c=h.version,_(r,"textContent",jm(e));let u=Vm(i,h.each?.trace,
e.draws.chains);_(i,"hidden",!u.length),_(a,"textContent",u.length?`Share of draws so far with a wall, by draw: ${u.map((b,x)=>`chain ${x+1} ${b.toFixed(2)}`).join(
", ")}`:"");let{nats:p,scan:m,beam:y}=h.each??{nats:[],scan:[],beam:[]},v=Array.from(p.slice(0,Gm),(b,x)=>M("li",{},`${io(b)} nats: ${Hm(e,m[x],y[x])}`));s.replaceChildren(
...v)}),l}var Hm=({document:t,editable:e},n,o)=>`beam ${o+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function jm({evidence:{together:t},quantity:e,
hasDraws:n}){if(!t?.beams||e.kind!=="binary"||t.nats_for===null||t.nats_against===null)return"";let{prior_nats:o,log_odds:s,draw:r,nats_for:i,nats_against:a}=t;
if(r==null)return"Each beam is asked by itself, with the other cells as probable as they are: the sum is not the log odds of P(wall)."+(n?" Show one draw for th\
at.":"");if(o==null||s===null||s===void 0)return`Given all other cells of draw ${r+1}.`;let l=1/(1+Math.exp(-s));return`Given all other cells of draw ${r+1}: pr\
ior ${io(o)}, beams ${io(i-a)}, together log odds ${io(s)}: Gibbs draws a wall with probability ${l.toFixed(3)}.`}function Vm(t,e,n){let o=e&&n?e.length/n:0,s=o?
t.getContext("2d"):null,r=s&&getComputedStyle(t);return s?.clearRect(0,0,t.width,t.height),Array.from({length:o?n:0},(i,a)=>{let l=0;s?.beginPath();for(let c=0;c<
o;c++)l+=e[a*o+c],s?.lineTo(t.width*(c+.5)/o,2+(t.height-4)*(1-l/(c+1)));return s&&r&&(s.strokeStyle=r.getPropertyValue(a?"--truth":"--ray")||"gray"),s?.stroke(),
l/o})}function zm({evidence:t,quantity:e}){let{cell:n,together:o}=t;if(!n)return"Click a cell to see which beams speak for what is there (blue) and which agains\
t it (orange), in nats each.";let s=`Cell ${n.x}, ${n.y}`;if(!o)return`${s}: asking its beams.`;if(!o.beams)return`${s}: no beam reaches it.`;let r=o.beams===1?
"1 beam":`${o.beams} beams`;if(o.nats_for===null||o.nats_against===null)return`${s}: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"\
its surface"}[e.kind]??"what is there",a=o.beams_for||o.beams_against?"":" None of them says anything.";return`${s}: ${r}. For ${i} (blue) ${o.beams_for}, ${o.nats_for.
toFixed(1)} nats; against (orange) ${o.beams_against}, ${o.nats_against.toFixed(1)} nats.${a}`}var ph=t=>Math.round(t*180/Math.PI);function dh(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(l,c)=>t.numberInput(l,()=>Number((o.pose?.[c]??0).toFixed(2)),h=>o.move(
{[c]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>ph(o.pose?.yaw??0),l=>o.move({yaw:l*Math.PI/180}),{step:5}),i=M("p",{className:"words ghosted"}),a=t.
section("Ghost",M("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>_(i,"textContent",Ym(t))),
a}function Ym({session:t}){let{ghost:e}=t;if(e.trouble)return Zt(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(h,u)=>h-o[u]).filter(Number.isFinite).sort((h,u)=>h-u),a=i.length?`${pe(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",c=r?` \
Rings are the hits of scan ${r.index+1}, taken ${pe(100*r.away,0)} cm from here, turned by ${ph(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${c}`}function uh(t){let{session:e}=t,n=M("span",{className:"what"});t.each(()=>{let{grid:c,source:h}=e.document??{};if(!c||!h)return;let u=`${c.shape[0]} × ${c.shape[1]}\
 cells of ${+c.resolution.toPrecision(3)} m`;_(n,"textContent",h.name?`${h.name}, ${u}`:u)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo,why:"Nothing of this page to undo"}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"\
Redo (Ctrl+Y)",when:()=>!!e.state?.can_redo,why:"Nothing to redo"}),M("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),
...t.embedded?[]:[t.button("link","Share",()=>t.command("share"),{text:"Share",when:o})]];for(let c of s)t.visible(c,()=>!e.recorded);let r=t.button("theme","Th\
eme: automatic",()=>t.command("theme")),i=t.button("help","Help",()=>t.command("help"),{title:"Help (?)"}),a=M("span",{className:"space"});return{element:M("hea\
der",{},M("h1",{textContent:"bayesmap"}),n,a,...s,Km(t),r,i),nameTheme(c){let h=`Theme: ${c}`;st(r,"aria-label",h),_(r,"title",h)}}}var qm=({shown:t,draws:e})=>e.
count>0||/importance|propagate/.test(t?.method??"");function Km(t){let{session:e}=t,n=(l,c,h,u,p)=>{let m=t.button(null,l,()=>t.command(`export ${c}`),{text:l,when:u,
why:p});return h!=="all"&&t.visible(m,()=>!e.recorded&&(h==="document"||!e.figure)),m},o=n("Figure that samples by itself (HTML)","figure","server");t.visible(o,
()=>e.editable&&!e.figure);let s=M("div",{className:"menu",hidden:!0},n("Picture (PNG)","png","all"),n("Saved run (netCDF)","run","server",()=>qm(e),"There are \
no draws yet: chains keep them"),n("Map for robots (YAML and PGM)","map","server"),n("Page in one file (HTML)","html","server"),o,n("Document (JSON)","document",
"document")),r=t.button("save","Export",()=>i(s.hidden),{text:"Export",when:()=>!!e.document}),i=l=>{s.hidden=!l,r.setAttribute("aria-expanded",String(l)),l&&s.
firstElementChild.focus()};i(!1);let a=M("div",{className:"anchor",tabIndex:-1},r,s);return a.addEventListener("keydown",l=>{l.key!=="Escape"||s.hidden||(i(!1),
r.focus(),l.stopPropagation())}),a.addEventListener("focusout",l=>{a.contains(l.relatedTarget)||i(!1)}),s.addEventListener("click",()=>{i(!1),r.focus()}),a}var Jm={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function fn(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",Jm[t]),e.append(n),e}var Js=({document:t})=>!t||t.source.kind==="simulation",Wi=({answers:t})=>t,fh="surface (zoom in)",mh=[{mark:"truth",text:"true wall",when:Js,may:Js},{mark:"ray",
text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.strokes.
length,may:t=>!Js(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!Js(t)},{mark:"unobserved",text:"unobserved"},{mark:"\
draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Wi},{mark:"\
path",text:"path, as wide as the robot",when:({decisions:t})=>!!(t.path&&t.pathShown),may:Wi}],gh=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 %\
 of a place"}],yh=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function wh(t,e,n){let o=M("p",{className:"sentence"});return t.
each(()=>_(o,"textContent",Xm(t.session))),M("div",{className:"legend"},o,Zm(t,e,n),Qm(t))}var Ui=(t,e)=>`${t.toLocaleString("en")} ${e}${t===1?"":"s"}`;function Xm(t){
let{shown:e,document:n,layer:o,quantity:s,draws:r}=t;if(!e||!n)return"";if(t.where.map)return"The walls as they are drawn: where a scan was taken is asked in a \
known map.";let{kind:i,mean:a,value:l}=s,c=e.verdict?.level!=="bad",h=c?"One map drawn from the posterior":/importance/.test(e.method)?"One particle":"The map o\
f one chain, which has not converged",u={mean:i==="binary"?"How probable a wall is in each cell":Zt(`${a}, cell by cell`),draw:`${h}${i==="binary"?"":`, by its ${l}`}${r.
count?`, ${t.draw+1} of ${r.count}`:""}`,entropy:"How uncertain each cell is, in bits",width:"How wide the 90 % interval of each cell is"}[o];if(e.method==="non\
e")return`${u} before any reading: the prior.`;let{source:p,angles:m,sensors:y,scans_used:v}=n,b=p.kind==="simulation"?`${Ui(m*y.length,"beam")} of ${Ui(y.length,
"sensor")}`:Ui(v??p.scans,"scan"),x=e.method==="propagate"||e.method==="pilot"||/hits|counts/.test(e.method),S=t.stage||t.halfway?"the poses found so far":"raw \
odometry",A=e.method==="counts"?`, by counts along ${S}`:x&&e.approximate?", approximately":o!=="draw"&&e.burned?`, by sweeps ${e.burned+1} to ${e.sweeps}`:"";return`${u}\
, given ${b}${A}${c||o==="draw"?"":` (${/importance/.test(e.method)?"particles collapsed":"chains not converged"})`}.`}function Zm(t,e,n){let{session:o}=t,s=M("\
span",{className:"ramp"}),r=M("span",{className:"name"}),[i,a]=[M("span"),M("span")],l=mh.map(p=>{let[m,y]=Xs(p),{mark:v,when:b}=p;return b&&t.visible(m,()=>b(o)),
v==="stroke"&&t.each(()=>_(y,"textContent",Ho(n())?p.text:fh)),v==="path"&&t.each(()=>m.firstElementChild?.classList.toggle("risky",o.decisions.path?.within_risk===
!1)),m}),[c,h]=[gh,yh].map(p=>p.map(m=>Xs(m)[0]));for(let p of c)t.visible(p,()=>!!o.where.found);for(let p of h)t.visible(p,()=>!!o.evidence.cellShown);let u="";
return t.each(()=>{let{layer:p}=o;_(r,"textContent",bh(o,p));let m=p==="entropy"||p==="width",y=eg(o,p);_(i,"textContent",y?"free":"0"),_(a,"textContent",y?"wal\
l":"1");let v=`${m} ${y} ${e().ground}`;u!==v&&(u=v,s.style.background=Qr(m?no:b=>Wo(e(),b),y))}),M("ul",{"aria-label":"Legend"},M("li",{},r,M("span",{className:"\
scale"},i,s,a)),...l,tg(t),...c,...h)}function Qm(t){let{session:e}=t,n=["mean","draw","entropy","width"].map(c=>{let h=M("span");return t.each(()=>_(h,"textCon\
tent",bh(e,c))),c==="width"&&t.visible(h,()=>e.quantity.interval),h}),o=mh.map(c=>{let[h,u]=Xs(c);c.mark==="stroke"&&(u.textContent=fh);let{may:p}=c;return p&&t.
visible(h,()=>p(e)),h}),s=M("span",{className:"scale"},"00.0",M("span",{className:"ramp"}),"000.0 nats"),r=[gh,yh].map(c=>M("ul",{},...c.map(h=>Xs(h)[0]))),i=[M(
"ul",{},M("li",{},"one more scan tells",s)),...r],a=M("li",{className:"either"},...i);t.visible(a,()=>Wi(e));let l=M("span",{className:"scale"},"free",M("span",
{className:"ramp"}),"wall");return M("ul",{className:"room","aria-hidden":"true"},M("li",{},M("span",{className:"name either"},...n),l),...o,a)}function Xs({mark:t,
text:e}){let n=M("i",{className:t});t==="sensor"&&n.append(fn("sensor"));let o=M("span",{textContent:e});return[M("li",{},n,o),o]}var eg=({quantity:t},e)=>e==="\
draw"&&t.kind==="binary";function bh({quantity:t},e){let{kind:n,mean:o,value:s}=t;return e==="entropy"?"entropy (bit)":e==="width"?"width of the 90 % interval":
n==="binary"?e==="draw"?"cells of this draw":"P(wall)":e==="draw"?s:o}function tg(t){let{decisions:e}=t.session,n=M("span",{className:"ramp"});n.style.background=
Qr(no);let[o,s]=[M("span"),M("span")],r=M("li",{className:"views"},"one more scan tells",M("span",{className:"scale"},o,n,s));return t.visible(r,()=>e.looking&&
!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(_(o,"textContent","0"),_(s,"textContent",`${pe(Math.max(...i),1)} nats`))}),r}var ng=[.05,.1,.2,.4,.8],og=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function xh(t){let{session:e}=t,n=M("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,c=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...ng,r.resolution])].sort((p,m)=>p-m),[,u]=t.limits("side_of_log");if(o!==`${h} ${u}`){o=`${h} ${u}`;let p=y=>c/y>u-1,m=y=>M(
"option",{value:String(y),textContent:og(y)+(p(y)?": too many cells":""),disabled:p(y)});n.replaceChildren(...h.map(m))}_(n,"value",String(r.resolution))});let s=t.
row("Cell size",n);return t.visible(s,()=>e.document?.source.kind==="log"),s}function vh(t){let{session:e}=t,n=M("input",{type:"range",min:1,step:1,"aria-label":"\
Scans used"}),o=M("output"),s=()=>e.document?.source.scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=s()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener(
"change",()=>{r(!1),t.endDrag()});let i=t.section("Log",M("div",{className:"player bare"},n,o));return t.visible(i,()=>!e.recorded&&e.document?.source.kind==="l\
og"&&s()>1),t.each(()=>{let a=s(),l=e.document?.scans_used??a;_(n,"max",String(Math.max(1,a))),(!En(n)||Number(n.value)!==l)&&_(n,"value",String(l));let c=l===a?
`all ${a} scans`:`after ${l} of ${a}`;n.style.setProperty("--fill",`${100*(l-1)/Math.max(1,a-1)}%`),st(n,"aria-valuetext",c),_(o,"textContent",c)}),i}var sg="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",kh=200,
rg="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",Sh="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",ig="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function Ah(t){let{session:e}=t,n=M("span",{className:"chip"}),o=t.button(null,"Not converged",()=>Mh(
e)?.apply?.(),{text:"Not converged",className:"chip doubt"}),s=M("span",{className:"chip judged"}),r=M("div",{className:"chips"},n,s,o);return t.each(()=>{let i=e.
where.map!==null,a=i?null:Mh(e);if(_(o,"hidden",!a),a){let v=[Vo(e).bad,a.text].filter(Boolean).join(": ");_(o.firstElementChild,"textContent",v.charAt(0).toLowerCase()+
v.slice(1)),_(o,"title",`${e.shown?.verdict?.why}.${a.apply?` Click to ${a.text}.`:""}`),_(o,"disabled",!a.apply),st(o,"aria-label",v)}let l=e.shown,c=i||!l||l.
approximate||l.layer==="draw"?[]:[Number.isFinite(l.rhat)&&`R-hat ${pe(l.rhat,3)}`,Number.isFinite(l.ess)&&`ESS ${pe(l.ess,0)}`];if(_(s,"textContent",c.filter(Boolean).
join(" · ")),_(s,"hidden",!s.textContent),!l||!e.document)return _(r,"hidden",!0);if(_(r,"hidden",!1),i)return _(n,"textContent","known map: the walls as drawn"),
_(n,"className","chip");let h=e.draws.count?`draw ${e.draw+1} of ${e.draws.count}`:"draw",u=l.layer==="draw"?h+(e.flicker.under?" over the mean":""):l.layer==="\
width"?"width of the 90 % interval":e.view.layer==="entropy"?"entropy":"mean";if(l.method==="counts"){let v=e.halfway?"along poses found so far":"along raw odom\
etry";return _(n,"textContent",`hits and passes · ${e.stage?e.stage.text.toLowerCase():v}`),_(n,"className","chip approximate")}let p={importance:"importance s\
ampling",propagate:"belief propagation",none:"the prior"}[l.method],m=e.document.method==="importance"&&l.method==="propagate"?", until Run weighs particles":"",
y=l.approximate?`approximate, ${ag(l,e.working)}${m}`:p??`${l.sweeps} sweep${l.sweeps===1?"":"s"}`;_(n,"textContent",`${u} · ${y}`),_(n,"className",l.approximate?
"chip approximate":"chip")}),r}function ag({method:t,sweeps:e,total:n,averaged:o},s){return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${o===
1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} of ${n}`}function Mh(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="b\
ad"||!n)return null;if(t.recorded||n.source.kind==="run")return{text:""};let o=a=>()=>t.act({type:"set",patch:a}),s=e.sweeps<kh,r=n.pose_sigma===0&&n.heading_sigma===
0;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!s&&r)return{text:"try blocks",apply:o({method:"block"})};if(e.method==="importance")return{text:"try Gib\
bs",apply:o({method:"auto"})};if(e.sweeps<e.total)return null;let i=Math.min(t.limits?.sweeps[1]??0,Math.max(kh,4*n.sweeps));return i>n.sweeps?{text:`try ${i} s\
weeps`,apply:o({sweeps:i})}:{text:""}}function Eh(t){let{session:e}=t,n=M("span"),o=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),
s=M("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.
retryIn_ms??0)/1e3));_(s,"hidden",!r&&e.worker!=="restarted"),_(s,"className",r?"banner":"banner mild"),_(o,"hidden",!r);let a=`Connection lost. Trying again in\
 ${i} s; the map is kept here.`,l=e.connection.refused?sg:a;_(n,"textContent",r?l:"The worker stopped and is being started again. The map is kept.")}),s}function Ph(t){
let{session:e,hand:n}=t,o=M("div",{className:"readout",id:`${t.prefix}-readout`}),s=M("span",{role:"status","aria-live":"polite"}),r=M("span",{className:"hidden",
"aria-live":"polite"});return n.announce=i=>_(r,"textContent",i),n.describe=i=>Th(e,i),t.each(()=>{let{kind:i}=e.quantity;_(o,"title",i==="binary"?rg:i==="surfa\
ce"?`${Sh}. ${ig}`:Sh);let a=n.cursor??n.hover,c=matchMedia("(pointer: coarse)").matches?"Touch a cell":e.editable?"Point at a cell, or press ? for the keys":"P\
oint at a cell";_(o,"textContent",a?Th(e,a):c);let h=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad"&&!e.where.map,u=e.status.text==="Ready"&&Ns(e),p=e.
shown?.method==="importance"?"Ready, but importance sampling has collapsed":"Ready, but the chains have not converged",m=e.everConnected&&!e.connection.connected&&
e.status.level==="info";_(s,"textContent",m?"Connection lost":h?p:u?"Fitting the sensor":e.status.text),_(s,"className",m?"error":h?"warning":u?"busy":e.status.
level)}),{element:M("footer",{},s,o,r),readout:o}}function Th(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.
max(1,Math.ceil(-Math.log10(s))+1),{x:l,y:c}=eo(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${c.toFixed(a)} m`],{map:u}=t.where;if(u)h.push(u.p[i]?"wal\
l, as drawn":"free, as drawn");else if(o&&o.p.length===r[0]*r[1]){let p=o.p[i]/255,{kind:m,mean:y,value:v,interval:b}=t.quantity;o.layer==="width"?h.push(`90 % \
interval ${p.toFixed(2)} wide`):m!=="binary"&&o.layer==="draw"?h.push(`${v} ${p.toFixed(2)} in this draw`):m!=="binary"?h.push(`${y} ${p.toFixed(2)}`,...b?[]:[`\
entropy ${Bo(p).toFixed(2)} bit`]):o.layer==="draw"?h.push(p>.5?"wall in this draw":"free in this draw"):h.push(`P(wall) ${p.toFixed(2)}`,`entropy ${Bo(p).toFixed(
2)} bit`);let x=t.evidence.facts,S=x?.x===e.x&&x.y===e.y?x:null,A=S?S.beams:null,E=o.reached[i]/255,D=n.source.kind==="run";if(E?!D&&E<.995&&h.push(`reached wit\
h probability ${E.toFixed(2)}`):h.push(D?"reached by a beam in less than half of the draws":"unobserved"),E&&A!==null&&h.push(A===1?"1 beam":`${A} beams`),E&&S&&
S.nats_for!==null&&S.nats_against!==null&&A){let L={binary:"a wall",surface:"its surface"}[t.quantity.kind]??"what is there";h.push(`for ${L} ${S.beams_for}, ${S.
nats_for.toFixed(1)} nats`,`against ${S.beams_against}, ${S.nats_against.toFixed(1)} nats`)}}return h.join(" · ")}var lg={logged:"as logged",odometry:"from raw odometry"},cg=180/Math.PI;function _h(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
lg,()=>e.document?.poses??"logged",a=>t.set({poses:a}));o.classList.add("wide"),t.visible(o,n);let s=[t.slider("pose_sigma",()=>"Position ± (m)",{step:.05,unit:"\
 m"}),t.slider("heading_sigma",()=>"Yaw ± (°)",{step:.5,unit:"°",scale:cg})];for(let a of s)t.visible(a,()=>e.editable);let r=M("p",{className:"caption"});t.
each(()=>{let{pose_sigma:a=0,heading_sigma:l=0,method:c="auto"}=e.document??{},h=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,u=e.
editable&&(a>0||l>0)&&!/auto|gibbs|block/.test(c);_(r,"hidden",!u&&!h),_(r,"textContent",h?"Run infers where the robot was.":"This method takes poses as known; \
Gibbs does not.")});let i=t.section("How well poses are known",o,...s,r);return t.visible(i,()=>e.editable&&!e.figure||n()&&!e.recorded),i}var Zs=t=>Math.abs(t)<.995?`${pe(100*Math.abs(t),1)} cm`:`${pe(Math.abs(t),2)} m`,hg="Point at a reading to compare it with what the posterior predicts of it.",
pg=": preparing the comparison. The first one after an installation takes some seconds.";function Ch(t){let{session:e}=t,n=M("p",{className:"words reading",role:"\
status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i,
slow:a}=e.reading,l=s?`Beam ${s.beam+1} of scan ${s.scan+1}${a?pg:"."}`:hg;_(n,"textContent",i||(r?dg(r):l))}),o}function dg({scan:t,beam:e,reading:n,range:o,low:s,
median:r,high:i,residual:a,no_return:l,wall:c}){let h=`Beam ${e+1} of scan ${t+1}`,u=(x,S)=>x===null?S:`${pe(x,2)} m`,p=`median ${u(r,"no return")}, 80 % betwee\
n ${u(s,"too close")} and ${u(i,"no return")}`;if(n==="none")return`${h} came back from nothing, which was predicted with probability ${pe(l??0,3)} (${p}).`;if(n!==
"hit"||o===null)return`${h} read nothing that says how far (${p}).`;let m=a===null?"":`, ${Zs(a)} ${a<0?"shorter":"longer"} than the predicted median`,y=`${h} r\
ead ${pe(o,2)} m${m} (${p}).`;if(!c)return y;let v=`${Zs(c.across_m)} ${c.across_m<0?"behind":"in front of"} the wall, which is ${Zs(c.thickness_m)} thick`,b=`${Zs(
c.along_m)} to the ${c.along_m<0?"right":"left"} along it from the middle of its surface`;return`${y} It ended ${v} (one standard deviation), and ${b}; the beam\
 met it at ${pe(c.incidence_rad*180/Math.PI,0)}° from its normal.`}function Gi(t){let e=/^#step=(\d+)$/.exec(t);return e&&Math.max(0,Number(e[1])-1)}var er=t=>`#step=${t+1}`;function Lh(t,e){let n=new Map;e.forEach((r,i)=>{let a=r.
replace(/ \([^)]*\)$/,"");n.has(a)||n.set(a,i)});let o=[...n.keys()].sort((r,i)=>i.length-r.length).map(r=>r.replace(/[^\w ]/g,"\\$&"));return(o.length?t.split(
new RegExp(`\\b(${o.join("|")})(?!\\w)`)):[t]).map((r,i)=>({text:r,at:i%2?n.get(r)??null:null})).filter(r=>r.text)}var Qs=class{constructor(e){this.session=e}story=null;at=0;begins=0;onstep=()=>{};get settled(){
let{state:e,acted:n,working:o,shown:s}=this.session;return!!(s&&e&&e.seq>=n&&!o)}get step(){return this.story?.steps[this.at]??null}get last(){return(this.story?.
steps.length??1)-1}go(e){this.at=Math.min(Math.max(e,0),this.last);let{step:n}=this;n&&(this.begins++,this.bring(n.document),this.session.view.layer!==n.layer&&
this.session.act({type:"view",layer:n.layer}),this.onstep(this.at),this.session.changed())}solve(){this.step?.solution&&this.bring(this.step.solution)}bring(e){
let{session:n}=this;n.state&&!n.state.live&&n.act({type:"live",on:!0}),n.bring(e),n.answers&&e.method==="importance"&&n.act({type:"run"})}};function Dh(t){let{telling:e}=t.session,[n,o,s]=[M("h3"),M("p"),M("p",{className:"task"})],r=M("div",{className:"told","aria-live":"polite"},n,o,s),i=M("nav",{"\
aria-label":"Steps"}),a=m=>()=>e.go(e.at+m),l=M("div",{className:"buttons"},t.button(null,"Back",a(-1),{text:"Back",when:()=>e.at>0,why:"This is the first step"}),
t.button(null,"Next",a(1),{className:"primary",text:"Next",when:()=>e.at<e.last,why:"This is the last step"}),t.button(null,"Start this step again",a(0),{text:"\
Again"})),c=t.button(null,"Show me",()=>e.solve(),{text:"Show me"});t.visible(c,()=>!!e.step?.solution),l.append(c);let h=t.section("Story",i,r,l);h.className="\
story";let u=h.querySelector("h2");t.visible(h,()=>!!e.story);let p=null;return t.each(()=>{let{story:m,step:y,at:v}=e;!m||!y||(p!==m&&i.replaceChildren(...m.steps.
map(({title:b},x)=>{let S=A=>{A.preventDefault(),e.go(x)};return M("a",{href:er(x),title:b,"aria-label":`Step ${x+1}: ${b}`,textContent:String(x+1),onclick:S})})),
p=m,_(u,"textContent",m.title),_(n,"textContent",y.title),_(o,"textContent",y.text),Array.from(i.children).forEach((b,x)=>st(b,"aria-current",x===v?"step":"fals\
e")))}),ug(t,h,s),h}function ug(t,e,n){let{telling:o}=t.session,s=[],[r,i]=["",""],a=-1,l=!1,c=!1;t.after(()=>{let{step:h,begins:u}=o;if(!h)return;let p=t.named.
filter(({place:x})=>!x.closest("[hidden], dialog")),m=p.map(({name:x})=>x()),y=[h.task,...m].join("|"),v=y===r?null:Lh(h.task,m);if(r=y,v&&JSON.stringify(v)!==i){
i=JSON.stringify(v);for(let{place:x}of s)x.classList.remove("named");s=v.flatMap(({at:x})=>x===null?[]:[p[x]]);for(let{place:x}of s)x.classList.add("named");n.replaceChildren(
...v.map(({text:x,at:S})=>S===null?x:M("button",{type:"button",title:"Go to this control",textContent:x,onclick:()=>{Nh(e,p[S].place),p[S].control.focus({preventScroll:!0})}})))}
let b=e.parentElement;if(b){if(!c)for(let x of["wheel","touchmove","pointerdown","keydown"])b.addEventListener(x,()=>l=!1,{passive:!0});c=!0,a!==u&&(a=u,b.scrollTop=
0,l=!0),l&&(s.length&&$h(e)&&Nh(e,s[0].place),l=!o.settled)}})}var $h=t=>getComputedStyle(t).position==="sticky";function Nh(t,e){let n=t.parentElement;if(!n.contains(
e))return;let[o,s]=[n.getBoundingClientRect(),e.getBoundingClientRect()],r=o.top+($h(t)?t.getBoundingClientRect().height:0);(s.top<r||s.bottom>o.bottom)&&(n.scrollTop+=
(s.top+s.bottom-r-o.bottom)/2)}var Rh={auto:"By the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},fg={binary:"\
walls",reflectivity:"reflectivities",surface:"surfaces"},mg={noisy:"with noise",exact:"exact"},gg={auto:"as is best",prior:"draws of the prior",empty:"the empty\
 map"},yg={raster:"raster",radial:"radial",random:"random"},tr=2*Math.PI,wg=t=>Math.round(t*1800/Math.PI)/10,bg={importance:"Particles",propagate:"Rounds"};function Fh(t){
let{session:e,hand:n,editor:o}=t,s=M("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.choose("sensor")});
let r="";t.each(()=>{let u=e.document?.sensors??[],p=u.map(m=>m.id).join();p!==r&&s.replaceChildren(...u.map(({id:m})=>M("option",{value:String(m),textContent:`\
Sensor ${m}`}))),r=p,_(s,"value",String(n.sensor?.id??""))});let i=(u,p)=>t.numberInput(u,()=>Number((n.sensor?.[p]??0).toFixed(2)),m=>n.sensor&&o.moveSensor(n.
sensor,{[p]:m}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),u=>n.sensor&&o.moveSensor(n.sensor,{yaw:u%360*Math.PI/
180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),c=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"Remove",when:()=>(e.
document?.sensors.length??0)>1,why:"The last sensor stays"});t.visible(a,()=>(e.document?.fov??tr)<tr);let h=M("div",{className:"triple"},i("x (m)","x"),i("y (m\
)","y"),a);return t.section("Sensors",M("div",{className:"buttons"},s,l,c),h)}function Ih(t){let{session:e}=t,n=t.numberInput("Longest range (m)",()=>e.document?.
max_range??0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),o=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("angles",()=>"Angles",{
step:1,log:!0}),n,t.numberInput("Field of view (°)",()=>wg(e.document?.fov??tr),a=>t.set({fov:a>=360?tr:a*Math.PI/180}),{step:5,limits:"fov",scale:180/Math.PI}),
t.select("Readings",mg,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of o)t.visible(a,()=>e.editable);let s=t.slider("prior",()=>"Prior P\
(wall)",{step:.01}),r=()=>(e.document?.cells??"binary")==="binary";t.visible(s,r);let i=t.select("Cells",fg,()=>e.document?.cells??"binary",a=>t.set({cells:a}));
return t.visible(i,()=>e.document?.source.kind==="log"),t.section("Model",i,xh(t),s,...o)}function Oh(t){let{session:e}=t,n=()=>e.document?.method??"auto",o=()=>(e.
document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",Rh,n,c=>t.set({method:c})),t.select("Order",yg,()=>e.document?.order??
"radial",c=>t.set({order:c}),()=>n()==="gibbs"||n()==="auto","Only Gibbs, cell by cell, has an order"),t.select("Start",gg,()=>e.document?.start??"auto",c=>t.set(
{start:c}),s,"Only chains have a start")],i=Array.from(r[0].lastElementChild.children);for(let c of i)c.value==="propagate"&&t.visible(c,()=>!e.figure);let a={gibbs:"\
: cell by cell",block:": 2 × 2 blocks"};t.each(()=>_(i[0],"textContent",Rh.auto+(n()==="auto"?a[e.shown?.method??""]??"":""))),r[0].classList.add("wide");for(let c of r)
t.visible(c,o);let l=t.slider("burn_in",()=>"Burn-in (%)",{step:5,scale:100});return t.visible(l,()=>s()||!o()),t.section("Inference",...r,l,t.slider("sweeps",()=>bg[n()]??
"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,c=>t.set({seed:Math.round(c)}),{step:1,limits:"seed"}))}function Bh(t){let{session:e}=t,n=t.
button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),o=t.button(null,"Clear inference",()=>e.act({type:"cl\
ear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",M("div",{className:"buttons"},n,o))}var xg=0,nr=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${xg++}`;named=[];updates=[];afterwards=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}after(e){this.afterwards.push(e)}refresh(){for(let e of[...this.updates,...this.afterwards])e()}set(e){this.
session.act({type:"set",patch:e})}slide(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){this.session.act({type:"set",patch:{scans_used:e},drag:this.
drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[o,s]=this.session.limits?.[e]??[1,2];return n===1?[o,s]:[Math.ceil(10*o*n-1e-6)/10,Math.floor(
10*s*n+1e-6)/10]}bounded(e,n,o=1,s=0){this.each(()=>{let[r,i]=this.limits(n,o),[a,l]=s?[Math.ceil(r/s-1e-6),Math.floor(i/s+1e-6)]:[r,i],c=h=>String(s?+(h*s).toPrecision(
9):h);_(e,"min",c(a)),_(e,"max",c(l))})}visible(e,n){this.each(()=>_(e,"hidden",!n()))}button(e,n,o,{className:s="",text:r="",when:i,why:a,title:l}={}){let c=()=>typeof l==
"function"?l():l??n,h=M("button",{type:"button",className:s,title:c(),onclick:o},e&&fn(e));return r&&(h.append(M("span",{textContent:r})),this.named.push({name:()=>r,
place:h,control:h})),r!==n&&h.setAttribute("aria-label",n),i&&this.each(()=>{_(h,"disabled",!i());let u=typeof a=="function"?a():a;u&&_(h,"title",h.disabled?u:c())}),
h}segmented(e,n,o,s){let r=`${this.prefix}-${e.replace(/\W/g,"")}`,i=M("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[a,l,c]of n){let h=M(
"input",{type:"radio",name:r,value:a,onchange:()=>s(a)}),u=M("label",{title:l},h,c?fn(c):null,M("span",{textContent:l}));i.append(u),this.named.push({name:()=>l,
place:u,control:h}),this.each(()=>_(h,"checked",o()===a))}return i}section(e,...n){let o=`${this.prefix}-${e.replace(/\W/g,"")}`;return M("section",{"aria-label\
ledby":o},M("h2",{id:o,textContent:e}),...n)}row(e,n){n.id=`${this.prefix}-${e.replace(/\W/g,"")}`;let o=M("div",{className:"row"},M("label",{for:n.id,textContent:e}),
n);return this.named.push({name:()=>e,place:o,control:n}),o}slider(e,n,{step:o,log:s=!1,unit:r="",scale:i=1}){let a=`${this.prefix}-${e}`,l=()=>this.limits(e,i),
c=b=>{let[x,S]=l();return s?1e3*Math.log(b/x)/Math.log(S/x):b},h=b=>{if(!s)return b;let[x,S]=l(),A=x*(S/x)**(b/1e3),E=A<100?1:10**(Math.floor(Math.log10(A))-1);
return ce(Math.round(A/E)*E,x,S)},u=()=>{let b=this.session.document?.[e];return b===void 0?l()[0]:i===1?b:Number((b*i).toFixed(3))},p=M("label",{for:a}),m=M("i\
nput",{type:"range",id:a,...s?{min:0,max:1e3,step:1}:{step:o}}),y=M("input",{type:"number",step:String(o)});s||this.bounded(m,e,i,o),this.bounded(y,e,i),m.addEventListener(
"input",()=>this.slide({[e]:h(Number(m.value))/i})),m.addEventListener("change",()=>this.endDrag()),y.addEventListener("change",()=>this.typed(y,n(),l(),u,b=>this.
set({[e]:s?Math.round(b):b/i}))),this.each(()=>{let b=u();_(p,"textContent",n()),st(y,"aria-label",`${n()}, number`),h(Number(m.value))!==b&&(m.value=String(c(b))),
st(m,"aria-valuetext",`${b}${r}`);let x=100*(c(b)-Number(m.min))/(Number(m.max)-Number(m.min));m.style.setProperty("--fill",`${ce(x,0,100)}%`),En(y)||_(y,"value",
String(b))});let v=M("div",{className:"row slider"},p,m,y);return this.named.push({name:n,place:v,control:m}),v}select(e,n,o,s,r,i=""){let a=M("select",{onchange:()=>s(
a.value)});for(let[l,c]of Object.entries(n))a.append(M("option",{value:l,textContent:c}));return this.each(()=>{_(a,"value",o()),r&&_(a,"disabled",!r()),i&&_(a,
"title",a.disabled?i:"")}),this.row(e,a)}typed(e,n,[o,s],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(ce(a,o,s)),e.value=String(r()),a<o?this.
session.say(`${n} is at least ${o}`,"warning"):a>s&&this.session.say(`${n} is at most ${s}`,"warning")}numberInput(e,n,o,{step:s,limits:r,scale:i}){let a=M("inp\
ut",{type:"number",step:String(s)}),l=()=>r?this.limits(r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,l(),n,o)),this.
each(()=>{En(a)||_(a,"value",String(n()))}),this.row(e,a)}checkbox(e,n,o,s=""){let r=M("input",{type:"checkbox",onchange:()=>o(r.checked)});this.each(()=>_(r,"c\
hecked",n()));let i=M("label",{className:"check",title:s},r,M("span",{textContent:e}));return this.named.push({name:()=>e,place:i,control:r}),i}dialog(e,...n){let o=`${this.
prefix}-dialog-${e.replace(/\W/g,"")}`,s=M("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},fn("close")),r=M("div",{className:"\
title"},M("h2",{id:o,textContent:e}),s),i=M("dialog",{"aria-labelledby":o},r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener(
"keydown",a=>a.stopPropagation()),i}};var vg=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Qo="There are no draws yet: chains keep them",kg="There is one chain",Sg="T\
his device asks that nothing moves by itself",Mg={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},or=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){
if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.before=null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.
session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,
e&&s.wantsMean?this.session.act({type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?
0:n),this.session.changed()}over(e){let{flicker:n,view:o}=this.session;n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.
chain})):o.layer!=="draw"&&this.showLayer("draw"):(this.afterMean=!1,this.before&&this.before!==o.layer&&this.showLayer(this.before)),this.before=e?o.layer:null,
this.session.changed()}playFromStart(){this.showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||
this.playing)&&e?.layer==="mean"&&!n.wantsMean)return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.
playing)return;let{draw:o,draws:s}=this.session;o+1>=s.count&&n.on?this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function Uh(t,e,n,o){
let{session:s}=t,r=()=>s.view.layer==="draw"&&!s.hasDraws?"mean":s.view.layer,i=t.segmented("Show",vg,r,v=>e.showLayer(v)),[,a,l,c]=Array.from(i.children);_(c,"\
title","Width of each cell's 90 % interval"),t.visible(l,()=>!s.quantity.interval),t.visible(c,()=>s.quantity.interval&&!s.lacks.includes("width")),t.visible(a,
()=>s.hasDraws);let h=(v,b)=>t.checkbox(v,()=>n[b],x=>{n[b]=x,s.changed()}),u=h("True walls","truth");t.visible(u,()=>!s.document||s.document.source.kind==="sim\
ulation");let[p,m]=[h("Surfaces","strokes"),h("Trajectory","trajectory")];t.visible(p,()=>!!s.overlay?.strokes.length),t.each(()=>_(p.lastElementChild,"textCont\
ent",Ho(o())?"Surfaces":"Surfaces (zoom in)")),t.visible(m,()=>!!s.overlay?.trajectory.length);let y=M("div",{className:"checks",role:"group","aria-label":"Mark\
s"},u,h("Rays","rays"),h("Readings","readings"),p,m);return t.section("View",i,Tg(t,e),y)}function Tg(t,e){let{session:n}=t,o=M("input",{type:"range",min:0,step:1,
"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the draws",()=>e.play(!e.playing),
{when:()=>n.draws.count>1,why:Qo}),r=M("output"),i=M("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,Number(i.value))),t.each(
()=>{let{chains:p,count:m}=n.draws;_(o,"max",String(Math.max(0,m-1))),_(o,"disabled",m===0),_(o,"title",m?"":Qo),_(o,"value",String(n.draw));let y=m?`${n.draw+1}\
 of ${m}`:"none kept";st(o,"aria-valuetext",y),o.style.setProperty("--fill",`${m>1?100*n.draw/(m-1):0}%`),_(r,"textContent",y),i.length!==Math.max(1,p)&&i.replaceChildren(
...Array.from({length:Math.max(1,p)},(b,x)=>M("option",{value:String(x),textContent:`chain ${x+1}`}))),_(i,"value",String(n.view.chain)),_(i,"disabled",p<2),_(i,
"title",p>1?"":m?kg:Qo),m<2&&e.playing&&e.play(!1);let v=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";s.getAttribute("aria-label")!==
v&&(s.setAttribute("aria-label",v),s.replaceChildren(fn(e.playing?"pause":"play")))});let a=M("select",{"aria-label":"Speed"});for(let[p,m]of Object.entries(Mg))
a.append(M("option",{value:p,textContent:m}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(
null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1,why:Qo});t.each(()=>{_(a,"disabled",n.draws.count<2||n.flicker.
still),_(a,"title",n.draws.count<2?Qo:n.flicker.still?Sg:"")});let c=t.checkbox("Draws over the mean",()=>n.flicker.on,p=>e.over(p),"Each draw in its own colour\
 over the mean, as one of the maps that the scans leave possible");t.visible(c,()=>n.draws.count>1);let h=M("div",{className:"wide"},c),u=M("div",{className:"pl\
ayer"},s,o,r,M("div",{className:"buttons wide"},i,a,l),h);return t.visible(u,()=>n.hasDraws),u}function Wh(t){let{session:e}=t,n=M("input",{type:"range",min:0,step:1,
"aria-label":"Scan number"}),o=M("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.section("Scan",M("div",{className:"\
player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;_(s,"hidden",r<2),_(n,"max",String(Math.max(0,
r-1))),En(n)||_(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),_(o,"textContent",`${Number(n.value)+
1} / ${r}`)}),s}var Hh=2,Gh=6,Ag=.9,Eg=.5,Pg=.005;function jh(t){let{session:e,hand:n}=t,o=M("p",{className:"whereabouts",role:"status"}),s=M("p",{className:"caption"}),r=t.section(
"Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),_(o,"textContent",_g(t)),_(s,"textCo\
ntent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, which the map shows, as if nothing were known of its pose.":"Choose a sca\
n below: it is located in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function _g({session:t}){let{found:e,trouble:n}=t.
where;if(n)return`${n.charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>Eg?`The scan fits nowhere on this map, with proba\
bility ${e.p_lost.toFixed(2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>Pg?` That it is lost, or the map outdated, ha\
s probability ${e.p_lost.toFixed(2)}.`:"";return`${o}${Cg(e.modes)}${t.where.current?Lg(e,t.editable):" Looking again."}${s}`}function Cg(t){let[e,n]=t;if(!e)return"\
No place.";let o=e.sigma_m>Hh,s=`${e.mean[0].toFixed(2)}, ${e.mean[1].toFixed(2)} m, heading ${Hi(e.mean[2],0)}`,r=`known to ${ji(e.sigma_m)} and ${Hi(e.sigma_rad,
1)}`;if(!n)return o?`It may be almost anywhere: positions are ${ji(e.sigma_m)} apart.`:`One place: ${s}, ${r}.`;let i=t.slice(0,Gh).map(({probability:c})=>si(c)),
a=n.probability>Ag*e.probability,l=t.length>Gh?" and less":"";return`${t.length} places: ${i.join(", ")}${l}. ${a?"One of them":"The likeliest"}: ${s}, ${r}.`}function Lg({
modes:t,pose:e},n){if(!t.length||t[0].sigma_m>Hh)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(
Math.sin(t[s].mean[2]-e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the likeliest":`the ${Ng(s+1)}`;return` The robot ${n?"stands":"was reco\
rded"} ${ji(o[s])} and ${Hi(r,1)} from ${i}.`}var Ng=t=>`${t}${["th","st","nd","rd"][t%100>10&&t%100<14?0:t%10]??"th"}`,Hi=(t,e)=>`${(t*180/Math.PI).toFixed(e).
replace(/^-(?=0(\.0*)?$)/,"")}°`,ji=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(0)} cm`:`${t.toFixed(1)} m`;var Ao="recording";function Vh(t,e,n,{kept:o}){let{shown:s,status:r}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:s&&{generation:s.generation,layer:t.layer,
approximate:s.approximate,sweeps:s.sweeps,method:s.method,quantity:t.quantity,rhat:s.rhat,verdict:s.verdict,trace:s.trace,traced:s.traced,weights:s.weights,ess:s.
ess,chain:s.chain,draw:s.draw},probability:s?.p??new Uint8Array(0),reached:s?.reached??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,
status:{text:r.text,level:r.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.
viewTrouble},where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:$g(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.
trouble},evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&Dg(t.evidence.each)},over:!!t.flicker.under,beside:o&&{layer:o.layer,
chain:o.view.chain,draw:o.draw,method:o.shown?.method,probability:Array.from(o.shown?.p??[])},overlay:t.overlay&&{strokes:t.overlay.strokes.length/5,trajectory:t.
overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.
latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var Dg=t=>Object.fromEntries(Object.entries(t).map(([e,n])=>[e,Array.from(n)]));function $g({
ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.near&&{...o.near}}}}var Vi=new Set(["walls","move_sensor","set","view","live"]),zh=({type:t})=>!Vi.has(t),Yh="Not while the connection is lost: this needs the server";function qh(t,e){
let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*s+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;
Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??
null};else if(e.type==="move_sensor"){let r=n.sensors.find(i=>i.id===e.id);if(r)for(let i of["x","y","yaw"])r[i]=e[i]??r[i]}}var Rg=t=>Zt(`${t.replace(/^(plan|path|explore): /,"")}.`),sr=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;pathShown=!0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}showPath(e){this.pathShown!==e&&this.version++,this.pathShown=e}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.
views,this.askedViews]=[null,""]),this.version++,this.ask(),this.session.changed())}forget(){this.forgetPath(),this.views=null,this.askedViews=""}forgetPath(){this.
start=this.goal=this.path=null,this.askedPath=this.trouble="",this.version++,this.session.changed()}ask(){let{session:e,start:n,goal:o,radius:s,risk:r}=this,{shown:i}=e;
if(!i||i.generation!==e.generation||!e.answers)return;let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&!i.approximate&&l!==this.
askedPath&&(this.askedPath=l,e.act({type:"path",start:[n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.method==="propagate")&&
a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let o=e.type==="undecided"?Rg(e.text):"",s=e.type==="undecided"?e.question:e.type;s===
"views"?(this.viewTrouble=o,this.views=null):this.trouble=o,e.type==="path"?this.path=e:e.type==="views"&&this.looking?this.views={pose:n.pose,nats:n.nats,spacing:e.
spacing}:s==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<n.nats.length;r++){
let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,s]=[r,i])}return o}};var rr=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=qt(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:o}=e;
if(!this.held||!n||!o||o.generation!==e.generation||!e.answers)return;let{chain:s,draw:r}=o,i=o.layer==="draw"&&s!==null&&r!==null&&e.draws.count?{chain:s,draw:r}:
{},a=`${o.generation} ${e.sampling} ${o.approximate} ${n.x} ${n.y} ${JSON.stringify(i)}`;a!==this.asked&&(this.asked=a,e.act({type:"inspect",x:n.x,y:n.y,each:!0,
...i}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.each=n.nats?n:null,this.version++)}};var Fg="(prefers-reduced-motion: reduce)",ir=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(Fg).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var Ig=2e3,Og=3e3,Bg=2,ar=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&Mn(e,n.document.
grid);(!o||!qt(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
!e.answers||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>Ig&&(this.waiting=0),this.waiting>=Bg)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Og;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:c}=n,{x:h,y:u,yaw:p,generation:m,draws:y,coarse:v,milliseconds:b}=e,x=e.near&&{...e.near,pose:a,ranges:l,hit:c};this.fan={x:h,y:u,yaw:p,generation:m,draws:y,
coarse:v,milliseconds:b,angles:o,low:s,median:r,high:i,near:x},this.answers++}else this.fan=null;this.version++,this.ask()}};var lr=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var cr=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var hr=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.
kind!=="simulation"&&!o.recorded,r=e&&s&&o.scan?Ug(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),o.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){e.type==="undecided"?this.trouble=e.text:e.beam===this.picked?.beam&&
e.scan===this.picked.scan&&(this.found=e),this.version++}};function Ug({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)return null;let l={x:e[0],y:e[1]},
[c,h]=[-1,1/0];for(let u=0;u<n.length;u++){let[p,m]=[Math.cos(e[2]+n[u]),Math.sin(e[2]+n[u])],[y,v]=[r.x-l.x,r.y-l.y],b=y*p+v*m,x=s[u]?o[u]:a,S=s[u]?Math.hypot(
y-x*p,v-x*m):1/0,A=b>0&&b<x?Math.abs(y*m-v*p):1/0,E=Math.min(S,i/2+2*A);E<h&&([c,h]=[u,E])}return h<i?{scan:t,beam:c,from:l,angle:e[2]+n[c]}:null}var pr=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;known=null;knownVersion=-1;asked="";waiting=!1;follow(e,n){this.
sensor=n,e!==this.wanted&&(this.wanted=e,this.found=null,this.trouble="",this.forget(),this.version++,this.session.changed()),e&&this.ask()}get map(){let{shown:e,
editable:n,walls:o,wallsVersion:s}=this.session;return!this.wanted||!n||!e?null:((!this.known||this.knownVersion!==s)&&(this.known={...e,layer:"mean",p:o.map(r=>255*
r),reached:new Uint8Array(o.length).fill(255)},this.knownVersion=s),this.known)}get current(){let{found:e,session:n,sensor:o}=this;return e?.picture===n.generation&&
(n.editable?(o??e.sensor)===e.sensor:e.index===n.scan?.index)}forget(){[this.asked,this.waiting]=["",!1]}receive(e,n){if(this.waiting=!1,!this.wanted)return;this.
trouble=e.trouble;let{pose:o,weight:s}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,cloud:o,weight:s},this.
version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||!e.locates||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;let s=e.editable?"":
`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`;r===this.asked||this.waiting||([this.asked,this.waiting]=[r,!0],e.act(
e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var Kh=new Set(["inspect","path","views","where","ghost","beam"]),Eo=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";limits=null;recorded=!1;figure=!1;lacks=[];generation=-1;acted=0;decisions=new sr(
this);evidence=new rr(this);where=new pr(this);ghost=new ar(this);reading=new hr(this);flicker=new ir(this);telling=new Qs(this);status=new Ls;progress=new cr;latency=new lr;counts={
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
acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&this.everConnected&&!Kh.has(e.type)&&zh(e))return this.
say(Yh,"warning");if(e.type==="run"&&this.nothingToRun)return this.say(this.nothingToRun);let o={...e,seq:++this.seq};Kh.has(e.type)||(this.acted=this.seq),Vi.has(
e.type)&&(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&ai(this.portableDocument()),
this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.
wallsVersion&&(this.packed={version:this.wallsVersion,text:Sn(Zn(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.
effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.
flicker.take(this.shown),!0)}painted(){this.counts.paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.
send({type:"painted",generation:e}),this.reported=e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.quantity??{kind:"\
binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){let n=this.
connection.connected;if(this.connection=e,e.connected){let o=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(
o),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.
text,this.notice.level),this.everConnected=!0}else this.everConnected&&(n&&this.say("Connection lost","error"),ai(this.portableDocument()));this.changed()}receive(e,n){
switch(e.type){case"welcome":this.generation=this.reported=-1,this.limits=e.limits,this.recorded=e.recorded,this.figure=e.figure,this.lacks=e.lacks,this.telling.
story=e.story??null,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":e.generation>=this.generation&&this.receiveScan(
e,n);break;case"overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(e,n);break;case"\
cell":this.evidence.receive(e,n);break;case"path":case"views":this.decisions.receive(e,n);break;case"ghost":this.ghost.receive(e,n);break;case"beam":this.reading.
receive(e);break;case"undecided":e.question==="ghost"?this.ghost.receive(e,n):e.question==="beam"?this.reading.receive(e):this.decisions.receive(e,n);break;case"\
status":this.status.say(e.text,e.level,this.acted);break;case"error":this.receiveRefusal(e);break;case"worker":this.worker=e.state,this.where.forget(),this.status.
worker(e.state);break;case"download":this.ondownload(e.name,e.mime,n.data),this.status.say(e.name===Ao?"Kept beside":`Saved ${e.name}${e.note&&`, ${e.note}`}`,"\
info",this.acted);break}this.changed()}receiveScan({ids:e,index:n},{pose:o,angles:s,ranges:r,exact:i,hit:a}){this.scan?.index!==n&&this.reading.forget(),this.scan=
{ids:e,index:n,pose:o,angles:s,ranges:r,exact:i,hit:a}}receiveRefusal({seq:e,text:n,remedy:o}){let s=e!==null&&e===this.broughtAt;s&&(this.broughtAt=null,this.act(
{type:"hello"}));let r=[n,o].filter(Boolean).join("; ");this.status.say(s?`The map that was brought along cannot be shown: ${r}`:r,"error",this.acted),this.pending=
this.pending.filter(i=>i.seq!==e),e!==null&&this.latency.refused(e),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,e.document.source.kind===
"simulation"&&(this.overlay=null,bl()),this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.
filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,
traced:r,weights:i}=n,a=this.next??this.shown,l=n.reached,c=a&&a.p.length===o.length&&a.reached.every((h,u)=>h===l[u])?a.reached:l;this.next={...e,p:o,trace:s,traced:r,
weights:i,reached:c},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==
s.text||s.walls.length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:bt(dt(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==
s||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,
draw:a}=this.state.view;this.view={layer:r,chain:i??0,draw:a}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(qh(this,e),e.type===
"walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var dr=class{constructor(e){this.main=e}kept=null;draws={chains:0,count:0,kept:0};keep(){let{transport:e}=this.main;if(!e.record)return this.main.act({type:"exp\
ort",what:Ao});let n=e.record();n&&this.receive(n),this.main.changed()}forget(){this.kept=null,this.main.changed()}receive(e){this.draws=e[0].draws;let n=us(e);
this.kept=new Eo(n,this.main.changed),n.open()}follow(){let{kept:e,main:n,draws:o}=this;if(!e)return;let{layer:s,chain:r}=n.view,i=Math.max(0,Math.min(r,o.chains-
1)),a=s==="draw"&&o.count?Math.round(n.draw*(o.count-1)/Math.max(1,o.kept-1)):null,{view:l}=e;(s!==l.layer||i!==l.chain||a!==l.draw)&&e.act({type:"view",layer:s,
chain:i,draw:a}),e.take()}differences(){let e=this.main.shown?.about??[],n=this.kept?.shown?.about??[],o=(s,r)=>s.filter(([i,a])=>!r.some(([l,c])=>l===i&&c===a)).
map(([i,a])=>`${i.toLowerCase()} ${a}`).join("; ");return[o(e,n),o(n,e)].map(s=>s||"the same model and method")}};var Jh='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Xh=`:host { display: block; height: 100dvh; container-type: size; }
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
button.chip.doubt { height: auto; min-height: 26px; opacity: 1; background: var(--bad); color: var(--card); border-color: transparent; font-weight: 600; pointer\
-events: auto; }
button.chip.doubt:hover:not(:disabled) { background: var(--bad); filter: brightness(1.1); }
.chip.approximate { background: var(--warn); color: var(--warn-text); border-color: transparent; }
:has(> .beside:not([hidden])) .chip.judged { display: none; } /* the words below say them */
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
@media (max-width: 760px), (max-height: 520px) { .story .told { display: grid; } .story p:not(.task) { order: 1; } } /* what to do comes before what is seen */
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
.row.slider { grid-template-columns: 98px 1fr 62px; }
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
dl { display: grid; grid-template-columns: repeat(5, auto); justify-content: space-between; gap: 6px; white-space: nowrap; }
dl.about { grid-template-columns: auto 1fr; gap: 3px 10px; margin-top: 5px; white-space: normal; }
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
  .legend { padding: 4px 12px; max-height: 33cqh; overflow-y: auto; font-size: 12px; background: var(--card); border: solid var(--line); border-width: 1px 0 0 1\
px; }
  .legend .sentence { white-space: normal; overflow: visible; min-height: min-content; }
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
@media (forced-colors: active) { .legend i, .legend .ramp, progress, input[type=range], footer [role=status]::before { forced-color-adjust: none; } .story [aria\
-current=step], .segmented label:has(:checked), .named { outline: 2px solid Highlight; } }
`;var Qh="bayesmap-theme",Zh={auto:"light",light:"dark",dark:"auto"},ur=class{constructor(e,n){this.app=e;this.dressed=n;let o=Hg();o&&o in Zh&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=ks.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?ks.dark:ks.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:c,ghost:h,belief:u}=n;for(let[p,m]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:l,draw:c,ghost:h,belief:u}))this.
app.style.setProperty(`--${p}`,m);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Zh[this.choice];try{localStorage.setItem(Qh,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function Hg(){try{return localStorage.getItem(Qh)}catch{return null}}var ep=12;function es(t,e,{embedded:n=!1,adopt:o=null,notice:s=null,play:r}={}){let i=t.shadowRoot??t.attachShadow({mode:"open"}),a=new CSSStyleSheet;a.replaceSync(
Jh+Xh),i.adoptedStyleSheets=[a],t.toggleAttribute("data-embedded",n);let l=0,c=()=>{l||=requestAnimationFrame(Wt)},h=new Eo(e,c,o,s);e.open();let u=new to,p=new gs(
h),m=new ms(h,p),y=new or(h),v=new dr(h),b=new nr(h,p,m,Gt,z=>y.showLayer(z),n),x=[new ao,new co,new uo,new po,new _s,new Es,new ho,new ro,new mo,new lo,new As],
S=x.map(({name:z})=>M("canvas",{className:z})),A=S[S.length-1];Object.assign(A,{tabIndex:0,role:"application"});let E=new Go(x,S);new Ts(A,h,u,p,m,n);let D=new bs(
A,h,u,p,m),L={truth:!0,rays:!0,readings:!0,strokes:!0,trajectory:!0},O=uh(b),G=Tl(b),te={chip:Ah(b),banner:Eh(b)},X=ri(),R=X.map(({name:z})=>M("canvas",{className:z})),
ee=new Go(X,R),B=_l(b,v),P=M("div",{className:"beside"},...R,B.kept),C=M("main",{className:"stage"},...S,B.now,te.chip,te.banner,P),U=()=>it.theme,I=()=>u.transform.
scale,ie=wh(b,U,I),K=Ph(b);A.setAttribute("aria-describedby",K.readout.id);let J=ch(b),Q={help:ah(b),new:lh(b),share:J.dialog},[q,W,me,fe]=[Fh(b),Ih(b),Oh(b),Bh(
b)],de=Uh(b,y,L,I);de.append(Pl(b,v));let ae=[Dh(b),ih(b),jh(b),dh(b),hh(b),vh(b),Al(b,sh(b,U),rh(b,U)),Wh(b),Ch(b),de,q,W,_h(b),me,fe],Fe=M("aside",{"aria-labe\
l":"Controls"},...ae),We=()=>h.recorded||h.document?.source.kind==="run";b.visible(q,()=>h.editable),b.visible(W,()=>!We()),b.visible(me,()=>!We()),b.visible(fe,
()=>!We());let ve=p.tool;b.each(()=>{ve!==p.tool&&(Fe.scrollTop=0),ve=p.tool,_(G,"inert",!h.document),_(Fe,"inert",!h.document)});let rt=M("div",{className:"app"},
O.element,G,C,ie,Fe,K.element,...Object.values(Q));i.replaceChildren(rt),rt.addEventListener("pointerdown",({pointerType:z,clientX:se,clientY:le})=>{let Ke=i.elementFromPoint(
se,le)?.closest(":disabled");z==="touch"&&Ke?.title&&h.say(Ke.title)});let it=new ur(rt,z=>{O.nameTheme(z),c()}),Ne=()=>{let z=h.editable&&p.tool==="sensor"?p.sensor?.
id??null:null;return{session:h,view:u,look:{theme:it.theme,...L,hover:p.hover,cursor:p.cursor,selected:z}}},{telling:Ie}=h,_t=()=>{Ie.step&&p.choose(Ie.step.tool)};
Ie.onstep=z=>{_t(),n||history.replaceState(null,"",location.pathname+location.search+er(z))};let Ct=!1;function gn(){Ct=!0;let z=n||o?null:Gi(location.hash);Ie.
story&&z!==null?Ie.go(z):_t()}let nn="";function Wt(){l=0;let z=h.take();h.document&&!Ct&&gn(),h.document&&String(h.shape)!==nn&&(nn=String(h.shape),v.kept&&String(
v.kept.shape)!==nn&&v.forget(),u.fit(h.shape),p.cursor=p.hover=null,h.decisions.forget(),h.evidence.forget(),h.ghost.refit(),A.setAttribute("aria-label",`Map, ${h.
shape[0]} by ${h.shape[1]} cells`)),P.hidden===!!v.kept&&qe(),E.paint(Ne()),v.follow(),v.kept&&ee.paint({...Ne(),session:v.kept}),z&&(h.painted(),y.step());let{
x:se,y:le}=u.transform;te.chip.style.transform=`translate(${Math.max(se,He.left)}px, ${Math.max(le-28,6)}px)`,st(A,"data-tool",h.editable||Ft.has(p.tool)?p.tool:
"pan"),b.refresh()}function qe(){let{width:z,height:se}=C.getBoundingClientRect();if(!z||!se)return!1;P.hidden=!v.kept;let le=se>z;C.classList.toggle("shared",!P.
hidden),C.classList.toggle("tall",le);let Ke=P.hidden?1:.5;return u.resize(le?z:Ke*z,le?Ke*se:se,devicePixelRatio||1),u.fitted&&u.fit(h.shape),!0}let Jt=new ResizeObserver(
()=>{qe()&&(cancelAnimationFrame(l),Wt())});Jt.observe(C);function Lt([z,se]){let{scale:le}=u.transform,Ke={x:z+.5,y:se+.5},at=le<ep;at&&u.zoom(ep/le,u.middle,h.
shape);let Ge=u.fromGrid(Ke,h.shape[1]);(at||Ge.x<le||Ge.y<le||Ge.x>u.width-le||Ge.y>u.height-le)&&u.pan(u.middle.x-Ge.x,u.middle.y-Ge.y,h.shape),D.focus(),p.setCursor(
{x:z,y:se})}async function Gt(z){if(z==="in"||z==="out")u.zoom(z==="in"?1.4:1/1.4,u.middle,h.shape);else if(z==="fit")u.fit(h.shape);else if(z.startsWith("cell "))
Lt(z.slice(5).split(",").map(Number));else if(z==="help")Q.help.showModal();else if(z==="new")Q.new.showModal();else if(z==="theme")it.next();else if(z==="add")
D.addSensor();else if(z==="share"){let se=h.portableDocument();se&&J.show(location.href.replace(/[?#].*/,"")+await ja(se))}else if(z==="export png"){let se=await ml(
Ne());se&&ti("bayesmap.png",se),h.say("Saved bayesmap.png")}else z.startsWith("export ")&&h.act({type:"export",what:z.slice(7)});c()}h.ondownload=(z,se,le)=>z===
Ao?v.receive(hn(le.slice().buffer)):ti(z,new Blob([le],{type:se}));let De=[[n?t:window,"keydown",z=>{z.defaultPrevented||!h.document||Object.values(Q).some(se=>se.
open)||nl(z,h,{tool:se=>{p.choose(se),D.focus()},layer:se=>y.showLayer(se),command:Gt})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{if(n)
return;let{document:z,damaged:se}=await Oo(),le=Gi(location.hash);z?h.bring(z):Ie.story&&le!==null?Ie.go(le):se&&h.say(Io,"error")}],[t,"dragover",z=>z.preventDefault()],
[t,"drop",z=>{z.preventDefault();let se=z.dataTransfer?.files[0];se&&Ya(se,h,r)}]];for(let[z,se,le]of De)z.addEventListener(se,le);return it.dress(),{destroy(){
Jt.disconnect(),cancelAnimationFrame(l),it.destroy();for(let[z,se,le]of De)z.removeEventListener(se,le);e.close(),i.replaceChildren()},snapshot:()=>Vh(h,u,E,v),
cellToClient(z,se){let le=A.getBoundingClientRect(),Ke=u.fromGrid({x:z+.5,y:se+.5},h.shape[1]);return{x:le.left+Ke.x,y:le.top+Ke.y}}}}var jg=200,Vg=.2,Ye=class extends Error{},tp=({grid:t,walls:e})=>bt(dt(e),t.shape[0]*t.shape[1]);function np({grid:t},{x:e,y:n}){let[o,s]=[Math.floor((e-t.origin[0])/
t.resolution),Math.floor((n-t.origin[1])/t.resolution)];return o>=0&&o<t.shape[0]&&s>=0&&s<t.shape[1]?o*t.shape[1]+s:null}function zi(t,e){let n=np(t,e);if(n===
null)throw new Ye("the sensor cannot stand outside the map");if(tp(t)[n])throw new Ye("the sensor cannot stand in a wall; move it to a free cell");return{...e,yaw:e.
yaw-2*Math.PI*Math.round(e.yaw/(2*Math.PI))}}function op(t,e,n){switch(e.type){case"set":return[Yi({...t,...e.patch},t,n),""];case"walls":return zg(t,e.cells,e.
wall);case"clear":return e.what==="walls"?[{...t,walls:sp(t.grid.shape)},""]:null;case"add_sensor":{if(t.sensors.length>=n.sensors[1])throw new Ye(`there are ${t.
sensors.length} sensors already; remove one first`);let o=Math.max(...t.sensors.map(s=>s.id))+1;return[{...t,sensors:[...t.sensors,zi(t,{id:o,x:e.x,y:e.y,yaw:e.
yaw??0})]},""]}case"move_sensor":{let o=s=>zi(t,{id:s.id,x:e.x??s.x,y:e.y??s.y,yaw:e.yaw??s.yaw});return[{...t,sensors:t.sensors.map(s=>s.id===e.id?o(s):s)},""]}case"\
remove_sensor":{let o=t.sensors.filter(s=>s.id!==e.id);if(!o.length)throw new Ye("the last sensor cannot be removed; add another first");return[{...t,sensors:o},
""]}case"new":return[Yg(t,e.shape,e.world),""];default:return null}}var sp=([t,e])=>Sn(new Uint8Array(t*e+7>>3));function zg(t,e,n){let o=tp(t),s=t.grid.shape[1];
for(let[i,a]of e)o[i*s+a]=n?1:0;let r="";for(let i of t.sensors){let a=np(t,i);o[a]&&(r=`a sensor stands in cell (${Math.floor(a/s)}, ${a%s}): it stays free`),o[a]=
0}return[{...t,walls:Sn(Zn(o))},r]}function Yg(t,e,n){if(n!=="blank")throw new Ye("this figure can begin blank maps alone; bayesmap app has others");let[o,s]=e.
map(i=>Math.floor((i-1)/2));return{...t,grid:{shape:e,resolution:1,origin:[-.5,-.5]},walls:sp(e),sensors:[{id:1,x:o,y:s,yaw:0}],noise:Vg,max_range:2*Math.max(...e)}}
function Yi(t,e,n){let o=t;for(let[h,u]of Object.entries(e)){let p=o[h];if(u!==null&&(typeof p!=typeof u||p===null))throw new Ye(`${h} is missing, or of another\
 type`);let m=n[h];if(m&&typeof p=="number"&&!(p>=m[0]&&p<=m[1]))throw new Ye(`${h}: ${p}; give ${m[0]} to ${m[1]}`)}let{grid:s,source:r,sensors:i,walls:a}=o;if(r.
kind!=="simulation")throw new Ye("this figure shows drawn maps alone; start bayesmap app with the file");if(o.cells!=="binary"||o.pose_sigma>0||o.heading_sigma>
0)throw new Ye("this figure samples walls seen from known poses alone; bayesmap app samples others");if(o.method==="propagate")throw new Ye("this figure has no \
belief propagation; choose another method");let[l,c]=n.side;if(!(s.shape.length===2&&s.shape.every(h=>Number.isInteger(h)&&h>=l&&h<=c)&&s.resolution>0))throw new Ye(
`grid: give ${l} to ${c} cells a side`);if(dt(a).length!==s.shape[0]*s.shape[1]+7>>3)throw new Ye("walls: another number of cells than the grid's");if(!(i.length>=
n.sensors[0]&&i.length<=n.sensors[1]))throw new Ye(`sensors: give ${n.sensors[0]} to ${n.sensors[1]}`);return{...o,sensors:i.map(h=>zi(o,h))}}function qg(t){return t.
type==="walls"&&t.stroke?`walls ${t.stroke}`:t.type==="set"&&t.drag?`set ${t.drag} ${Object.keys(t.patch).sort()}`:t.type==="move_sensor"&&t.drag?`move ${t.drag}\
 ${t.id}`:null}var fr=class{constructor(e){this.present=e}past=[];future=[];gesture=null;get canUndo(){return this.past.length>0}get canRedo(){return this.future.
length>0}push(e,n){let o=qg(n);(o===null||o!==this.gesture)&&(this.past.push(this.present),this.past.length>jg&&this.past.shift()),this.future=[],this.gesture=o,
this.present=e}step(e){let[n,o]=e?[this.past,this.future]:[this.future,this.past],s=n.pop();return s?(o.push(this.present),this.present=s,this.gesture=null,!0):
!1}};var Kg=11102230246251565e-32,rp=2**32,ip=1,ap=2,lp=3;function qi(t,e,n){let{high:o,low:s}=t,r=s&65535,i=s>>>16,a=n&65535,l=n>>>16,c=r*a,h=i*a+(c>>>16),u=r*l+(h&
65535),p=i*l+(h>>>16)+(u>>>16);t.low=((u&65535)<<16|c&65535)>>>0,t.high=p+Math.imul(o,n)+Math.imul(s,e)>>>0}function Ki(t,e){let{high:n,low:o}=t;t.low=(o^(o>>>e|
n<<32-e))>>>0,t.high=(n^n>>>e)>>>0}function Ut(t,e,n){let o=e+1;n.high=Math.floor(o/rp)>>>0,n.low=o>>>0,qi(n,2654435769,2135587861);let s=n.low+t.low;n.high=n.high+
t.high+(s>=rp?1:0)>>>0,n.low=s>>>0,Ki(n,30),qi(n,3210233709,484763065),Ki(n,27),qi(n,2496678331,321982955),Ki(n,31)}var Xi=({high:t,low:e})=>t*2097152+(e>>>11),
$n=t=>(Xi(t)+.5)*Kg;function mn(...t){let e=o=>BigInt.asUintN(64,o),n=0n;for(let o of t){let s=e((n^BigInt(o))+0x9e3779b97f4a7c15n);s=e((s^s>>30n)*0xbf58476d1ce4e5b9n),
s=e((s^s>>27n)*0x94d049bb133111ebn),n=s^s>>31n}return{high:Number(n>>32n),low:Number(n&0xffffffffn)}}var Ji=2654435761,Jg=2246822507;function mr(t,e){let n=Math.
imul(t+e,Ji);return n=Math.imul(n^n>>>15,Jg),n^n>>>13}function cp(t,e,n,o){let s=n>>>1,r=(1<<s)-1,i=(1<<n-s)-1,a=t;do{let l=a>>>s,c=a&r;l^=mr(c,o.low)&i,c^=mr(l,
o.high)&r,l^=mr(c,o.low^Ji)&i,c^=mr(l,o.high^Ji)&r,a=(l<<s|c)>>>0}while(a>=e);return a}var hp=t=>Math.max(2,32-Math.clz32(t-1));function gr(t,e){let n={high:0,low:0};
Ut(t,e,n);let o=$n(n);return Ut(t,e+1,n),Math.sqrt(-2*Math.log(o))*Math.cos(2*Math.PI*$n(n))}var Xg=2**53,pp=20,dp=1e15,[yr,Zi,up]=[0,1,2],br=class{constructor(e){this.p=e;let n=e*Xg,o=Math.round(n);this.level=o-n===.5&&o%2?o-1:o,this.logit=Math.min(Math.
max(Math.log(e)-Math.log1p(-e),-dp),dp)}level;logit;draws(e){return Xi(e)<this.level}logProb(e){if(this.p===0||this.p===1)return 0;let n=0;for(let o of e)n+=o;return e.
length*Math.log1p(-this.p)+n*this.logit}};function wr(t,e){return t>40?!0:t<-40?!1:e*(1+Math.exp(-t))<1}function Qi({order:t,shuffle:e},n,o){if(!e)return i=>t[i];
let s=hp(t.length),r={high:0,low:0};return Ut(n,-1-o,r),i=>t[cp(i,t.length,s,r)]}var xr=class{constructor(e,n,o){this.problem=e;this.walls=n;this.key=o;let{offsets:s,
cells:r,noHit:i}=e.table;this.first=new Int32Array(i.length),this.current=new Float32Array(i.length),this.reached=new Int32Array(n.length),this.gain=new Float32Array(
n.length),this.known=new Uint8Array(n.length);for(let a=0;a<i.length;a++){let l=this.nextWall(s[a],s[a+1]);this.first[a]=l,this.current[a]=this.entryLoglik(a,l);
for(let c=s[a];c<Math.min(l+1,s[a+1]);c++)this.reached[r[c]]++}}first;current;reached;gain;known;bits={high:0,low:0};nextWall(e,n){let{cells:o}=this.problem.table,
s=e;for(;s<n&&!this.walls[o[s]];)s++;return s}entryLoglik(e,n){let{offsets:o,loglik:s,noHit:r}=this.problem.table;return n<o[e+1]?s[n]:r[e]}logLikelihood(){let e=0;
for(let n of this.current)e+=n;return e}moveFirst(e,n){let{offsets:o,cells:s}=this.problem.table,r=o[e+1],i=this.first[e];this.first[e]=n,this.current[e]=this.entryLoglik(
e,n);let a=Math.min(i,n);for(let c=o[e];c<Math.min(a+1,r);c++)this.known[s[c]]=yr;let l=n>i?1:-1;for(let c=a+1;c<Math.min(Math.max(i,n)+1,r);c++)this.known[s[c]]=
yr,this.reached[s[c]]+=l}put(e){let{offsets:n,beam:o,entry:s}=this.problem.index;this.walls[e]=1;for(let r=n[e];r<n[e+1];r++)this.first[o[r]]>s[r]&&this.moveFirst(
o[r],s[r])}remove(e){let{table:n,index:o}=this.problem;this.walls[e]=0;for(let s=o.offsets[e];s<o.offsets[e+1];s++){let r=o.beam[s],i=o.entry[s];this.first[r]===
i&&this.moveFirst(r,this.nextWall(i+1,n.offsets[r+1]))}}sweep(e,n){let{prior:o}=this.problem,s=e.order.length,r=Qi(e,this.key,n);for(let i=0;i<s;i++){let a=r(i);
Ut(this.key,n*s+a,this.bits),this.reached[a]?this.walls[a]?this.stays(a,$n(this.bits))||this.remove(a):this.becomes(a,$n(this.bits))&&this.put(a):this.walls[a]=
o.draws(this.bits)?1:0}}becomes(e,n){let{logit:o}=this.problem.prior;return this.known[e]===yr&&this.sumGain(e,-pp-o),wr(o+this.gain[e],n)?this.known[e]===up?!0:
(this.sumGain(e,-1e300),wr(o+this.gain[e],n)):!1}sumGain(e,n){let{offsets:o,beam:s,entry:r,loglik:i,gainBound:a}=this.problem.index,l=0,c=up;for(let h=o[e];h<o[e+
1];h++){let u=l+a[h];if(u<n){l=u,c=Zi;break}this.first[s[h]]>r[h]&&(l+=Math.fround(i[h]-this.current[s[h]]))}this.gain[e]=l,this.known[e]=c}stays(e,n){let{table:o,
index:s,prior:r}=this.problem;if(this.known[e]===yr){let l=0;for(let c=s.offsets[e];c<s.offsets[e+1];c++)this.first[s.beam[c]]===s.entry[c]&&(l+=s.advantage[c]);
this.gain[e]=l,this.known[e]=Zi}let i=r.logit+this.gain[e];if(this.known[e]===Zi&&i>pp&&wr(i,n))return!0;let a=0;for(let l=s.offsets[e];l<s.offsets[e+1];l++){let c=s.
beam[l],h=s.entry[l];this.first[c]===h&&(a+=Math.fround(s.loglik[l]-this.entryLoglik(c,this.nextWall(h+1,o.offsets[c+1]))))}return wr(r.logit+a,n)}};var Zg=8,Qg=-1e300,ey=2**53;function ea(t,e,n,o){let s=Math.floor(t/o)-e,r=t%o-n;return s<0||s>1||r<0||r>1?-1:2*s+r}function fp({table:t,shape:[e,n]}){let{offsets:o,
cells:s,noHit:r}=t,i=Math.max(1,e-1),a=Math.max(1,n-1),l=Array.from({length:i*a},()=>[]);for(let p=0;p<r.length;p++)for(let m=o[p];m<o[p+1];m++)for(let y=0;y<4;y++){
let v=Math.floor(s[m]/n)-(y>>1),b=s[m]%n-(y&1);if(v<0||v>=i||b<0||b>=a)continue;let x=l[v*a+b],S=x[x.length-1];S?.b===p&&S.last>=m-Zg?S.last=m:x.push({b:p,first:m,
last:m})}let c=new Int32Array(l.length+1);l.forEach((p,m)=>c[m+1]=c[m]+p.length);let h=l.flat(),u=p=>Int32Array.from(h,m=>m[p]);return{offsets:c,beam:u("b"),first:u(
"first"),last:u("last"),rows:a}}function mp(t,e,n,o){let{prior:s,shape:[r,i]}=t.problem,{rows:a}=e,l=n.order.length,c=Qi(n,t.key,o),h=new Float64Array(16),u=new Float64Array(
16),p={high:0,low:0};for(let m=0;m<l;m++){let y=c(m),v=Math.floor(y/a),b=y%a,x=4*(o*l+y),S=D=>v+(D>>1)<r&&b+(D&1)<i?(v+(D>>1))*i+b+(D&1):-1,A=0;for(let D=0;D<4;D++)
S(D)>=0&&(A+=t.reached[S(D)]);if(!A){for(let D=0;D<4;D++)S(D)<0||(Ut(t.key,x+D,p),t.walls[S(D)]=s.draws(p)?1:0);continue}ty(t,e,y,v,b,h),u.fill(0);for(let D=0;D<
4;D++){let L=S(D)<0||s.level===0,O=!L&&s.level===ey;for(let G=0;G<16;G++)(G>>D&1)===(O?0:1)&&(u[G]+=L||O?Qg:s.logit)}for(let D=0;D<16;D++)h[D]+=u[D];Ut(t.key,x,
p);let E=ny(h,$n(p));for(let D=0;D<4;D++){let L=S(D);L<0||(E>>D&1?t.walls[L]||t.put(L):t.walls[L]&&t.remove(L))}}}function ty(t,e,n,o,s,r){let{table:i,shape:[,a]}=t.
problem,{offsets:l,cells:c,loglik:h}=i;r.fill(0);for(let u=e.offsets[n];u<e.offsets[n+1];u++){let p=e.beam[u],m=t.first[p],y=e.first[u];if(m<y)continue;let v=e.
last[u],b=l[p+1],x=m;if(m<=v&&m<b&&ea(c[m],o,s,a)>=0)for(x=m+1;x<b&&!(t.walls[c[x]]&&ea(c[x],o,s,a)<0);)x++;let S=t.entryLoglik(p,x),A=0;for(let E=y;E<Math.min(
v+1,x);E++){let D=ea(c[E],o,s,a);if(D<0)continue;let L=Math.fround(h[E]-S);for(let O=0;O<16;O++)O>>D&1&&!(O&A)&&(r[O]+=L);A|=1<<D}}}function ny(t,e){let n=Math.
max(...t),o=t.map(r=>r>n-40?Math.exp(r-n):0),s=e*o.reduce((r,i)=>r+i,0);for(let r=0;r<16;r++)if(s-=o[r],s<=0&&o[r]>0)return r;return 15}function Rn(t){let e=0;for(let n=0;n<t.length;n++)e+=t[n];return e/t.length}var ta=t=>{let e=Rn(t);return t.reduce((n,o)=>n+(o-e)**2,0)/(t.length-1)},vr=(t,e)=>t.
reduceRight((n,o)=>n*e+o,0),gp=[[3.3871328727963665,133.14166789178438,1971.5909503065513,13731.69376550946,45921.95393154987,67265.7709270087,33430.57558358813,
2509.0809287301227],[1,42.31333070160091,687.1870074920579,5394.196021424751,21213.794301586597,39307.89580009271,28729.085735721943,5226.495278852854]],yp=[[1.4234371107496835,
4.630337846156546,5.769497221460691,3.6478483247632045,1.2704582524523684,.2417807251774506,.022723844989269184,.0007745450142783414],[1,2.053191626637759,1.6763848301838038,
.6897673349851,.14810397642748008,.015198666563616457,.0005475938084995345,10507500716444169e-25]];function oy(t){let e=t-.5;if(Math.abs(e)<=.425){let o=.180625-
e*e;return e*vr(gp[0],o)/vr(gp[1],o)}let n=Math.sqrt(-Math.log(e<0?t:1-t))-1.6;return Math.sign(e)*vr(yp[0],n)/vr(yp[1],n)}function sy(t){let e=t[0].length>>1;return[
...t.map(n=>n.slice(0,e)),...t.map(n=>n.slice(n.length-e))]}function wp(t){let e=Float64Array.from(t.flat()).sort(),n=new Map;for(let o=0;o<e.length;){let s=o+1;
for(;s<e.length&&e[s]===e[o];)s++;n.set(e[o],oy(((o+1+s)/2-.375)/(e.length+.25))),o=s}return t.map(o=>o.map(s=>n.get(s)))}function bp(t){let e=t[0].length;return Math.
sqrt((e-1)/e+ta(t.map(Rn))/Rn(t.map(ta)))}function xp(t,e){let n=t.length;for(let o=1,s=0;o<n;o++){let r=n>>1;for(;s&r;r>>=1)s^=r;s^=r,o<s&&([t[o],t[s],e[o],e[s]]=
[t[s],t[o],e[s],e[o]])}for(let o=2;o<=n;o*=2)for(let s=0;s<o/2;s++){let r=-2*Math.PI*s/o,[i,a]=[Math.cos(r),Math.sin(r)];for(let l=s;l<n;l+=o){let c=l+o/2,[h,u]=[
t[c]*i-e[c]*a,t[c]*a+e[c]*i];[t[c],e[c]]=[t[l]-h,e[l]-u],t[l]+=h,e[l]+=u}}}function ry(t){let e=t.length,n=Rn(t),o=2**Math.ceil(Math.log2(2*e)),[s,r]=[new Float64Array(
o),new Float64Array(o)];t.forEach((i,a)=>s[a]=i-n),xp(s,r);for(let i=0;i<o;i++)[s[i],r[i]]=[s[i]**2+r[i]**2,0];return xp(s,r),s.slice(0,e).map(i=>i/o/e)}function iy(t){
let[e,n]=[t.length,t[0].length],o=t.map(ry),s=Rn(o.map(h=>h[0]))*n/(n-1),r=s*(n-1)/n+ta(t.map(Rn)),i=h=>h?1-(s-Rn(o.map(u=>u[h])))/r:1,a=Math.max(1,Math.ceil((n-
2)/2)),l=-1,c=1/0;for(let h=0;h<a;h++){let u=i(2*h),p=u+i(2*h+1);if(!(p>0)||h===a-1){l+=p>0?u:Math.max(u,0);break}c=Math.min(c,p),l+=2*c}return e*n/Math.max(l,1/
Math.log10(e*n))}function vp(t){if(t[0].length<4||t.every(c=>c.every(h=>h===t[0][0])))return null;let e=sy(t),n=Float64Array.from(e.flat()).sort(),o=(n[n.length-
1>>1]+n[n.length>>1])/2,s=e.map(c=>c.map(h=>Math.abs(h-o))),r=wp(e),[i,a]=[bp(r),bp(wp(s))];return{rhat:Number.isNaN(a)?i:Number.isNaN(i)?a:Math.max(i,a),ess:iy(
r)}}function kp({table:t,prior:e,shape:n},o,s,r){let{offsets:i,cells:a,loglik:l,noHit:c}=t,h=n[0]*n[1],u={high:0,low:0},p=new Int8Array(h);return Float64Array.from(
{length:r},(m,y)=>{p.fill(0);let v=0;for(let b=0;b<c.length;b++){let x=c[b];for(let S=i[b];S<i[b+1];S++){let A=a[S];if(p[A]||(Ut(o,(s+y)*h+A,u),p[A]=e.draws(u)?
1:-1),p[A]>0){x=l[S];break}}v+=x}return v})}function na({prior:t,shape:e},n,o){let s=e[0]*e[1],r={high:0,low:0};return Uint8Array.from({length:s},(i,a)=>(Ut(n,o*
s+a,r),t.draws(r)?1:0))}function Sp(t){let e=t.reduce((r,i)=>Math.max(r,i),-1/0),n=e+Math.log(t.reduce((r,i)=>r+Math.exp(i-e),0)),o=t.map(r=>r-n),s=o.reduce((r,i)=>r+
Math.exp(2*i),0);return{logWeights:o,logEvidence:n-Math.log(t.length),effectiveSampleSize:1/s}}var oa=(t,e)=>e>0?Math.ceil(t-1e-9)-1:Math.floor(t+1e-9),sa=t=>Math.abs(t)<1e-10?0:t>0?1:-1,kr=class{constructor({x:e,y:n,ux:o,uy:s},r,i,a){this.nx=r;this.ny=i;
this.stepX=sa(o),this.stepY=sa(s);let l=0,c=a;this.stepX?(this.gapX=1/Math.abs(o),l=Math.max(l,Math.min(-e/o,(r-e)/o)),c=Math.min(c,Math.max(-e/o,(r-e)/o))):(e<
-1e-9||e>r+1e-9)&&(c=-1),this.stepY?(this.gapY=1/Math.abs(s),l=Math.max(l,Math.min(-n/s,(i-n)/s)),c=Math.min(c,Math.max(-n/s,(i-n)/s))):(n<-1e-9||n>i+1e-9)&&(c=
-1),this.end=c+1e-9,this.x=oa(e+(this.stepX?l*o:0),this.stepX),this.y=oa(n+(this.stepY?l*s:0),this.stepY),this.stepX&&(this.nextX=(this.x+Math.max(this.stepX,0)-
e)/o),this.stepY&&(this.nextY=(this.y+Math.max(this.stepY,0)-n)/s),!this.stepX&&Math.abs(e-this.x)<=1e-9&&(this.alongLine=1,this.sideX=-1),!this.stepY&&Math.abs(
n-this.y)<=1e-9&&(this.alongLine=2,this.sideY=-1),this.cellX=this.x,this.cellY=this.y,this.sides=this.alongLine,this.distance=Math.max(0,Math.min(this.nextX,this.
nextY))}cellX;cellY;distance;end;x;y;sides;sideX=0;sideY=0;alongLine=0;stepX;stepY;nextX=1e300;nextY=1e300;gapX=1e300;gapY=1e300;get over(){return this.distance>
this.end}get inside(){return this.cellX>=0&&this.cellX<this.nx&&this.cellY>=0&&this.cellY<this.ny}next(){if(this.sides&1){this.cellX=this.x+this.sideX,this.cellY=
this.y,this.sides&=2;return}if(this.sides){this.cellX=this.x,this.cellY=this.y+this.sideY,this.sides=0;return}let e=this.nextX<this.nextY-1e-9,n=this.nextY<this.
nextX-1e-9;this.distance=e?this.nextX:n?this.nextY:Math.min(this.nextX,this.nextY),this.sides=this.alongLine,e===n&&(this.sideX=-this.stepX,this.sideY=-this.stepY,
this.sides=3),n||(this.nextX+=this.gapX,this.x+=this.stepX),e||(this.nextY+=this.gapY,this.y+=this.stepY),this.cellX=this.x,this.cellY=this.y}};function Sr(t,[e,
n],o,s){for(let r=new kr(o,e,n,s);!r.over;r.next())if(r.inside&&t[r.cellX*n+r.cellY])return Math.min(r.distance,s);return s}function Mp([t,e],n,o){let s=[],r=new Int32Array(
n.length+1);return n.forEach((i,a)=>{for(let l=new kr(i,t,e,o);!l.over;l.next())l.inside&&s.push(l.cellX*e+l.cellY);r[a+1]=s.length}),{offsets:r,cells:Int32Array.
from(s)}}function Tp({x:t,y:e,ux:n,uy:o},s,r){let i=Math.floor(s/r),a=s-i*r,l=0,c=1e300,h=!0,u=(p,m,y)=>{let v=sa(m);if(!v)return;let b=1/m,x=y+(v>0?0:1)-p;l=Math.
max(l,x*b),c=Math.min(c,(x+v)*b),h&&=y===oa(p,v)};return u(t,n,i),u(e,o,a),h?Math.max(c,0):l}var ay=Math.fround(.001),ly=-.5*Math.log(2*Math.PI);function Ap(t,e,n,o,s,r){let{offsets:i,cells:a}=t,l=o.sigma_m*o.sigma_m,c=.5*Math.log(l),h=(m,y)=>{let v=m-Math.
min(y,o.max_m);return ly-.5*(v*v/l)-c},u=new Float32Array(a.length),p=new Float32Array(e.length);for(let m=0;m<e.length;m++){p[m]=h(n[m],1/0);for(let y=i[m];y<i[m+
1];y++)u[y]=h(n[m],Tp(e[m],a[y],s)*r)}return{offsets:i,cells:a,loglik:u,noHit:p}}function Ep({offsets:t,cells:e,loglik:n,noHit:o},s){let r=Float32Array.from(o),
i=new Float32Array(e.length);for(let p=0;p<o.length;p++){let m=o[p];for(let y=t[p+1]-1;y>=t[p];y--)i[y]=n[y]-m,m=Math.max(m,n[y]),r[p]=Math.min(r[p],n[y])}let a=new Int32Array(
s+1);for(let p of e)a[p+1]++;for(let p=0;p<s;p++)a[p+1]+=a[p];let l=()=>new Float32Array(e.length),c=()=>new Int32Array(e.length),h={offsets:a,entry:c(),beam:c(),
loglik:l(),gainBound:l(),advantage:l()},u=a.slice();for(let p of[!0,!1])for(let m=0;m<o.length;m++)for(let y=t[m];y<t[m+1];y++){let v=Math.fround(n[y]-r[m]);if(v>
ay!==p)continue;let b=u[e[y]]++;h.entry[b]=y,h.beam[b]=m,h.loglik[b]=n[y],h.gainBound[b]=v,h.advantage[b]=i[y]}for(let p=0;p<s;p++)for(let m=a[p+1]-2;m>=a[p];m--)
h.gainBound[m]+=h.gainBound[m+1];return h}function ts({angles:t,fov:e}){let n=e*(180/Math.PI);if(n===360)return Float64Array.from({length:t},(s,r)=>r*2*Math.PI/t);let o=n/(t-t%2);return Float64Array.from(
{length:t},(s,r)=>(o*r-n/2)*(Math.PI/180))}function Pp(t){let{origin:e,resolution:n}=t.grid,o=[...ts(t)];return t.sensors.flatMap(({x:s,y:r,yaw:i})=>o.map(a=>({
x:(s-e[0])/n,y:(r-e[1])/n,ux:Math.cos(i+a),uy:Math.sin(i+a)})))}function _p({grid:t,walls:e,max_range:n},o){let s=bt(dt(e),t.shape[0]*t.shape[1]),r=n/t.resolution;
return Float64Array.from(o,i=>Math.min(Sr(s,t.shape,i,r)*t.resolution,n))}function Cp({grid:t,noise:e,prior:n,max_range:o},s,r){let{shape:i,resolution:a}=t,l=Mp(
i,s,o/a),c=Ap(l,s,r,{sigma_m:e,max_m:o},i[1],a);return{table:c,index:Ep(c,i[0]*i[1]),prior:new br(n),shape:i}}function Lp({grid:t,sensors:e,order:n},o){let[s,r]=t.
shape,[i,a]=o?[Math.max(1,s-1),Math.max(1,r-1)]:[s,r],l=Int32Array.from({length:i*a},(p,m)=>m);if(n!=="radial")return{order:l,shuffle:n==="random"};let c=(p,m)=>Math.
min(Math.max(p,0),m-1),h=e.map(({x:p,y:m})=>[c(Math.floor((p-t.origin[0])/t.resolution),s),c(Math.floor((m-t.origin[1])/t.resolution),r)]),u=l.map(p=>Math.min(...h.
map(([m,y])=>Math.abs(Math.floor(p/a)-m)+Math.abs(p%a-y))));return{order:Int32Array.from([...l].sort((p,m)=>u[p]-u[m]||p-m)),shuffle:!1}}var tn=2,Np=32,cy=300,hy=100,py=64<<20,dy=.1,uy=16,fy=40,ra=24,Dp=[.1,.3,.5,.7,.9],Fp={chains:0,count:0},my={gibbs:"Gibbs sampling, cell by cell",block:"Gibbs s\
ampling, 2 x 2 blocks",importance:"importance sampling",none:"none yet: this is the prior"},Po=()=>performance.now(),$p=t=>Uint8Array.from(t,e=>Math.round(255*e)),
Rp=t=>String(+t.toPrecision(4)),_o=class{constructor(e,n){this.document=e;this.problem=n;this.cells=n.shape[0]*n.shape[1]}done=!1;seconds=0;method="none";cells;work(e){
let n=Po();do this.step();while(!this.done&&Po()-n<e);this.seconds+=(Po()-n)/1e3}step(){this.done=!0}get draws(){return Fp}beamsThrough(e){let{offsets:n}=this.problem.
index;return n[e+1]-n[e]}mean(){return new Float64Array(this.cells).fill(this.document.prior)}reached(){return new Uint8Array(this.cells)}get logJoint(){return[]}figures(e){
return{sweeps:0,total:0,ess:null,rhat:null,log_joint:null,verdict:null,burned:0}}draw(e){return null}weights(){return null}picture(e,n,o,s){let{document:r,method:i}=this,
a=e.layer==="draw"?this.draw(e):null,l=this.weights(),c=i==="gibbs"?`, ${r.order} order`:"",h={type:"field",generation:n,milliseconds:o,layer:a?"draw":"mean",method:i,
approximate:!1,...this.figures(s),draws:this.draws,quantity:{kind:"binary",mean:"P(wall)",value:"wall",interval:!1},chain:null,draw:null,averaged:null,lowest:l?.
lowest??null,seconds:i==="none"?null:this.seconds,about:[["Method",my[i]+c],["Prior",`independent: p wall ${Rp(r.prior)}`],["Sensor",`gaussian: sigma ${Rp(r.noise)}\
 m`],["Poses","known"],["Computed","in this page"]],...a&&{chain:a.chain,draw:a.draw,log_joint:a.log_joint}},u=$p(a?a.map:this.mean());return[h,{p:u,reached:$p(
this.reached()),...this.trace(),...l&&{weights:l.weights}}]}recording(e){let{document:n}=this,{chains:o,count:s}=this.draws,[r,i]=this.picture({layer:"mean",chain:0,
draw:null},1,0,!0),a=Uint32Array.from({length:this.cells},(u,p)=>this.beamsThrough(p)),{log_joint:l,draws:c}=this.recorded(),h=n.sensors.map(({id:u})=>u);return[
{version:1,document:n,field:r,ids:h,draws:{chains:o,count:s,kept:s,bits:!0},log_joint:l},{...i,...e,beams:a,draws:c}]}recorded(){return{log_joint:[],draws:new Uint8Array(
0)}}trace(){let e=this.logJoint,n=e[0]?.length??0,o=Math.min(n,cy),s=Array.from({length:o},(a,l)=>Math.round(o>1?1+l*(n-1)/(o-1):1)),r=Array.from({length:Math.min(
n,hy)},(a,l)=>l+1),i=[...new Set([...r,...s])].sort((a,l)=>a-l);return{trace:Float32Array.from(e.flatMap(a=>i.map(l=>a[l-1]))),traced:Float32Array.from(i)}}},ns=class extends _o{constructor(n,o,s,r){
super(n,o);this.judging=s;let{seed:i,start:a,sweeps:l}=n;this.method=r?"block":"gibbs",this.blocks=r?fp(o):null,this.sites=Lp(n,r),this.thin=Math.ceil(l*tn*Math.
ceil(this.cells/8)/py),this.chains=Array.from({length:tn},(c,h)=>{let p=a==="empty"&&n.prior<1?new Uint8Array(this.cells):na(o,mn(i,h,ap),0);return new xr(o,p,mn(
i,h,ip))}),this.touched=new Uint8Array(this.cells);for(let c of o.table.cells)this.touched[c]=1;this.present={sweep:0,sums:this.chains.map(()=>new Float64Array(
this.cells)),reached:new Uint32Array(this.cells),looks:0},this.past=[this.copy()],this.goOn(l)}chains;blocks;sites;lookAt=new Set;touched;joint=Array.from({length:tn},
()=>[]);likelihood=Array.from({length:tn},()=>[]);kept=Array.from({length:tn},()=>[]);thin;total=0;sweep=0;present;past;diagnosis=null;diagnosed=0;diagnoseAt=0;goOn(n){
let{lookAt:o,document:s}=this;this.total=Math.ceil((this.total+n)/this.thin)*this.thin,o.add(Math.floor(s.burn_in*this.total));for(let r=1;r<=this.total;r*=2)o.
add(r);for(let r=1;r<=Np;r++)o.add(Math.floor(this.total*r/Np));this.done=!1,this.diagnoseAt=0}burn(n){let o=Math.floor(n/this.thin),s=this.kept.map(r=>{let i=new Float64Array(
this.cells);for(let a of r.slice(0,o))bt(a,this.cells).forEach((l,c)=>i[c]+=l);return i.map(a=>a*n/Math.max(1,o))});this.past=[{...this.past[0],sweep:n,sums:s}]}copy(){
let{sums:n,reached:o,looks:s}=this.present;return{sweep:this.sweep,sums:n.map(r=>r.slice()),reached:o.slice(),looks:s}}step(){let{present:n,document:o}=this;this.
chains.forEach((r,i)=>{this.blocks?mp(r,this.blocks,this.sites,this.sweep):r.sweep(this.sites,this.sweep);let a=n.sums[i];for(let c=0;c<this.cells;c++)a[c]+=r.walls[c];
let l=r.logLikelihood();this.likelihood[i].push(l),this.joint[i].push(l+this.problem.prior.logProb(r.walls)),(this.sweep+1)%this.thin===0&&this.kept[i].push(Zn(
r.walls))}),this.sweep++,this.done=this.sweep>=this.total;let s=Math.floor(o.burn_in*this.total);if(this.done&&s>this.past[0].sweep&&this.past.every(({sweep:r})=>r!==
s)&&this.burn(s),!!this.lookAt.has(this.sweep)){for(let r of this.chains)for(let i=0;i<this.cells;i++)n.reached[i]+=r.reached[i]?1:0;for(n.looks+=tn,this.sweep<=
o.burn_in*this.total&&this.past.push(this.copy());this.past.length>1&&this.past[1].sweep<=o.burn_in*this.sweep;)this.past.shift()}}get draws(){return this.kept[0].
length?{chains:tn,count:this.kept[0].length}:Fp}recorded(){let{joint:n,kept:o,thin:s}=this,r=o.flat(),i=r[0]?.length??0,a=new Uint8Array(r.length*i);return r.forEach(
(l,c)=>a.set(l,c*i)),{log_joint:n.map(l=>l.filter((c,h)=>(h+1)%s===0)),draws:a}}means(){let[n]=this.past,o=Math.max(1,this.sweep-n.sweep);return this.present.sums.
map((s,r)=>s.map((i,a)=>(i-n.sums[r][a])/o))}mean(){let[n,o]=this.means();return n.map((s,r)=>this.touched[r]?(s+o[r])/2:this.document.prior)}reached(){let[n]=this.
past,o=Math.max(1,this.present.looks-n.looks);return Float64Array.from(this.present.reached,(s,r)=>(s-n.reached[r])/o)}get logJoint(){return this.joint}draw({chain:n,
draw:o}){let s=Math.min(n,tn-1),{count:r}=this.draws;if(!r)return{map:this.chains[s].walls,chain:s,draw:0,log_joint:this.joint[s].at(-1)??0};let i=Math.min(o??r-
1,r-1);return{map:bt(this.kept[s][i],this.cells),chain:s,draw:i,log_joint:this.joint[s][(i+1)*this.thin-1]}}figures(n){let[{sweep:o}]=this.past,s=Po();(s>=this.
diagnoseAt||this.done&&this.diagnosed<this.sweep)&&(this.diagnosis=vp(this.joint.map(c=>c.slice(o))),this.diagnosed=this.sweep,this.diagnoseAt=this.done?1/0:Po()+
(Po()-s)/dy);let r=this.joint.reduce((c,h)=>c+h[h.length-1],0)/tn,{ess:i=null,rhat:a=null}=this.diagnosis??{},l=c=>c!==null&&Number.isFinite(c)?c:null;return{sweeps:this.
sweep,total:this.total,ess:l(i),rhat:l(a),log_joint:r,verdict:this.verdict(n||this.done),burned:o}}verdict(n){let{judging:o,sweep:s}=this,r=s<o.fewest_sweeps;if(r&&
!n)return null;let i=(u,p,m=null)=>({level:u,why:p,cell:m}),a=this.difference();if(!r&&a.cells>o.chance_share*a.among){let[u,p]=a.cell,m=`in ${a.cells} of ${a.among}\
 observed cells, most in cell (${u}, ${p}), by ${a.by.toFixed(2)}`;return i("bad",`P(wall) differs by over ${o.bad_difference} between the chains ${m}`,a.cell)}
if(s<o.fewest_diagnosed)return i("bad",`${s} ${s===1?"sweep is":"sweeps are"} too few to judge`);let{rhat:l=NaN,ess:c=NaN}=this.diagnosis??{};if(l>o.rhat_limit)
return i("bad",`R-hat is ${l.toFixed(3)}, over ${o.rhat_limit}`);let h=this.misfit();return h?i("bad",`the chains agree, but on maps that the readings contradic\
t: they differ by ${+h.toPrecision(3)} times the noise`):!Number.isFinite(l)||!Number.isFinite(c)?i("good","nothing varies: the log joint is the same in all dra\
ws of all chains"):c<o.bad_ess?i("bad",`only ${c.toFixed(0)} effective draws`):l>o.good_rhat||c<o.good_ess?i("fair",`R-hat ${l.toFixed(3)} and ${c.toFixed(0)} e\
ffective draws; ${o.good_rhat} and ${o.good_ess} are good`):i("good",`R-hat ${l.toFixed(3)}, ${c.toFixed(0)} effective draws`)}misfit(){let n=this.problem.table.
noHit.length,[{sweep:o}]=this.past,s=-n*Math.log(this.document.noise*Math.sqrt(2*Math.PI)),r=this.likelihood.map(l=>l.slice(o).reduce((c,h)=>c+h,0)/(l.length-o)),
i=2*(s-Math.min(...r)),a=2/(9*n);return i>n*(1-a+this.judging.misfit_sigmas*Math.sqrt(a))**3?Math.sqrt(i/n):null}difference(){let[n,o]=this.means(),s=this.reached(),
r={by:0,cell:[0,0],cells:0,among:0};for(let i=0;i<this.cells;i++){if(s[i]<.5)continue;let a=Math.abs(n[i]-o[i]);r.among++,a>this.judging.bad_difference&&r.cells++,
a>r.by&&([r.by,r.cell]=[a,[Math.floor(i/this.problem.shape[1]),i%this.problem.shape[1]]])}return r}},Mr=class extends _o{constructor(n,o,s){super(n,o);this.judging=
s;this.method="importance",this.key=mn(n.seed,0,lp),this.sums=new Float64Array(this.cells),this.touched=new Uint8Array(this.cells);for(let r of o.table.cells)this.
touched[r]=1}key;logWeights=[];most=-1/0;sum=0;sums;touched;step(){let n=this.logWeights.length,o=Math.min(uy,this.document.sweeps-n);kp(this.problem,this.key,n,
o).forEach((s,r)=>{if(this.logWeights.push(s),s>this.most){let l=Math.exp(this.most-s);this.sum*=l;for(let c=0;c<this.cells;c++)this.sums[c]*=l;this.most=s}if(s<
this.most-fy)return;let i=Math.exp(s-this.most),a=na(this.problem,this.key,n+r);this.sum+=i;for(let l=0;l<this.cells;l++)a[l]&&(this.sums[l]+=i)}),this.done=this.
logWeights.length>=this.document.sweeps}mean(){return this.sums.map((n,o)=>this.touched[o]?n/this.sum:this.document.prior)}reached(){let n=this.mean(),{offsets:o,
cells:s,noHit:r}=this.problem.table,i=new Float64Array(this.cells);for(let a of Dp){let l=new Uint8Array(this.cells);for(let c=0;c<r.length;c++)for(let h=o[c];h<
o[c+1]&&(l[s[h]]=1,!(n[s[h]]>a));h++);for(let c=0;c<this.cells;c++)i[c]+=l[c]/Dp.length}return i}figures(){let{effectiveSampleSize:n}=Sp(Float64Array.from(this.
logWeights));return{sweeps:this.logWeights.length,total:this.document.sweeps,ess:n,rhat:null,log_joint:null,verdict:this.verdict(n),burned:0}}verdict(n){let{bad_ess:o,
good_ess:s}=this.judging,r=n.toFixed(1)==="1.0"?"one particle carries":`${n.toFixed(1)} particles carry`;return n<o?{level:"bad",why:`${r} all the weight`,cell:null}:
{level:n>=s?"good":"fair",why:`${n.toFixed(0)} effective particles`,cell:null}}weights(){let n=this.logWeights.map(r=>r-this.most),o=Math.min(-1,...n.filter(Number.
isFinite).reduce((r,i)=>[Math.min(r[0],i)],[0])),s=new Float32Array(ra);for(let r of n)s[Math.min(ra-1,Math.floor(ra*(1-r/o)))]++;return{weights:s,lowest:o}}};var Tr=.03,gy=40,Fn=180,Ip=90,ia=9,yy=24,Op=60,aa=7,Bp=50,wy=25,by=10,Up=1e3,xy=4e3,vy=21;function jp(t,e,n){let{grid:o,noise:s,max_range:r,seed:i}=t,{shape:[a,
l],resolution:c,origin:h}=o,u=bt(dt(t.walls),a*l),p=ts(t),m=r/c,y=(P,C,U)=>c*Sr(u,o.shape,{x:P,y:C,ux:Math.cos(U),uy:Math.sin(U)},m),v=(P,C)=>P>=0&&C>=0&&P<a&&C<
l&&!u[Math.floor(P)*l+Math.floor(C)],b=(1-Tr)/(s*Math.sqrt(2*Math.PI)),x=([P,C,U])=>{if(!v(P,C))return-1/0;let I=0;for(let ie=0;ie<p.length;ie++){let K=y(P,C,U+
p[ie]),J=(e[ie]-K)/s,Q=K>=r;n[ie]?I+=Math.log((Q?0:b*Math.exp(-.5*J*J))+Tr/r):I+=Math.log(Q?1-Tr/2:Tr/2)}return I},S=R(),A=Wp(S.slice(0,xy),P=>P,1.5,.2,Op);if(A.
length===Op)return ee(S.filter((P,C)=>C%Math.ceil(S.length/Up)===0));let E=mn(i,0,vy),[D,L]=[0,-1/0],O=A.slice(0,yy).map(P=>({mean:P,root:la(.4,.4,.04),poses:[],
logs:[],top:-1/0}));for(let P=0;P<=aa;P++){for(let C of O){let U=P===aa,I=U?1.4:1.2,ie=Array.from({length:U?3*Bp:Bp},()=>ky(C.mean,C.root,I,E,D+=3)),K=ie.map(({
pose:q,log:W})=>x(q)-W);C.top=Math.max(C.top,...ie.map(({log:q},W)=>K[W]+q)),L=Math.max(L,C.top),Object.assign(C,{poses:ie.map(({pose:q})=>q),logs:K});let[J,Q]=Hp(
C.poses,Gp(K,U?1:by));!U&&Q&&([C.mean,C.root]=[J,Sy(Q)])}O=O.filter(C=>C.top>L-wy*(aa-P+1)),P>=2&&(O=Wp(O.sort((C,U)=>U.top-C.top),({mean:C})=>C,1,.15))}let G=Math.
max(...O.flatMap(({logs:P})=>P)),te=O.map(({poses:P,logs:C})=>C.map(U=>Math.exp(U-G)/P.length)),X=te.flat().reduce((P,C)=>P+C,0);return B(O.map(({poses:P},C)=>({
poses:P,weights:te[C].map(U=>U/X)})),L/p.length);function R(){let P=new Float32Array(Fn),C=Array.from(p.keys()).filter((K,J)=>J%Math.ceil(p.length/gy)===0),U=Math.
hypot(s,.3*c),I=[];for(let K=0;K<a*l;K++){if(u[K])continue;let[J,Q]=[Math.floor(K/l)+.5,K%l+.5];for(let q=0;q<Fn;q++)P[q]=y(J,Q,q*2*Math.PI/Fn);for(let q=0;q<Ip;q++){
let W=q*2*Math.PI/Ip,me=0;for(let fe of C){let de=Math.round((W+p[fe])*Fn/(2*Math.PI)),ae=P[(de%Fn+Fn)%Fn],Fe=(e[fe]-ae)/U;me+=n[fe]?Math.min(Fe*Fe,ia):ae>=r?0:
ia}I.push({pose:[J,Q,W],loss:me})}}I.sort((K,J)=>K.loss-J.loss);let ie=I[0]?.loss??0;return I.filter(({loss:K})=>K<ie+.25*ia*C.length).map(({pose:K})=>K)}function ee(P){
let C=P.map(x);return B([{poses:P,weights:Gp(C,C.length/2)}],Math.max(...C)/p.length)}function B(P,C){let U=P.map(({poses:K,weights:J})=>{let Q=J.reduce((Ne,Ie)=>Ne+
Ie,0),[[q,W,me],fe]=Hp(K,J.map(Ne=>Ne/Q)),de=[c,c,1],ae=(fe??la(0,0,0)).map((Ne,Ie)=>Ne.map((_t,Ct)=>_t*de[Ie]*de[Ct])),[[Fe,We],[,ve]]=ae,rt=Math.sqrt((Fe+ve)/
2+Math.hypot((Fe-ve)/2,We));return{mean:[h[0]+q*c,h[1]+W*c,Math.atan2(Math.sin(me),Math.cos(me))],covariance:ae,probability:Q,sigma_m:rt,sigma_rad:Math.sqrt(ae[2][2])}}),
ie=P.flatMap(({poses:K,weights:J})=>K.map((Q,q)=>({pose:Q,weight:J[q]}))).sort((K,J)=>K.weight-J.weight).slice(-Up);return{modes:U.sort((K,J)=>J.probability-K.probability),
pose:Float32Array.from(ie.flatMap(({pose:[K,J,Q]})=>[h[0]+K*c,h[1]+J*c,Q])),weight:Float32Array.from(ie,({weight:K})=>K),nats_per_beam:C}}}function Wp(t,e,n,o,s=1/0){
let r=[];for(let i of t){if(r.length>=s)break;let[a,l,c]=e(i),h=u=>{let[p,m,y]=e(u);return Math.hypot(a-p,l-m)<n&&Math.abs(Math.atan2(Math.sin(c-y),Math.cos(c-y)))<
o};r.some(h)||r.push(i)}return r}var la=(...t)=>t.map((e,n)=>t.map((o,s)=>n===s?e:0));function ky(t,e,n,o,s){let r=[0,1,2].map(l=>gr(o,2*(s+l))),i=t.map((l,c)=>l+
n*e[c].reduce((h,u,p)=>h+u*r[p],0)),a=-.5*(r[0]**2+r[1]**2+r[2]**2)-Math.log(n**3*e[0][0]*e[1][1]*e[2][2]);return{pose:i,log:a}}function Gp(t,e){let n=Math.max(
...t);if(n===-1/0)return t.map(()=>1/t.length);for(let o=1;;o/=2){let s=t.map(i=>Math.exp(o*(i-n))),r=s.reduce((i,a)=>i+a,0);if(o<1e-6||r**2>=e*s.reduce((i,a)=>i+
a*a,0))return s.map(i=>i/r)}}function Hp(t,e){let n=t[e.indexOf(Math.max(...e))],o=t.map(l=>l.map((c,h)=>h===2?Math.atan2(Math.sin(c-n[2]),Math.cos(c-n[2])):c-n[h])),
s=l=>o.reduce((c,h,u)=>c+e[u]*l(h),0),r=[0,1,2].map(l=>s(c=>c[l])),i=r.map((l,c)=>r.map((h,u)=>s(p=>(p[c]-l)*(p[u]-h))));return[n.map((l,c)=>l+r[c]),i.every((l,c)=>l[c]>=
0)&&Number.isFinite(i[0][0])?i:null]}function Sy(t){let e=la(0,0,0);for(let n=0;n<3;n++)for(let o=0;o<=n;o++){let s=t[n][o];for(let r=0;r<o;r++)s-=e[n][r]*e[o][r];
e[n][o]=n===o?Math.sqrt(Math.max(s,1e-7)):s/e[o][o]}return e}var My=12,Ty=80,Ay=11,Ey=new Set(["path","views","ghost","beam"]),ca="This figure has no such tool: bayesmap app has it";async function Vp(t){return JSON.parse(
new TextDecoder().decode(await Qn(dt(t))))}function Py(t,e){let n=_p(t,e),{seed:o,noise:s,angles:r,sensors:i}=t,a=i.map(({id:c})=>mn(o,c,Ay)),l=n.map((c,h)=>t.readings===
"exact"?c:c+s*gr(a[Math.floor(h/r)],2*(h%r)));return{exact:n,readings:l}}function _y({method:t,prior:e},{rare_walls:n}){return t!=="auto"?t:Math.min(e,1-e)<=n?"\
block":"gibbs"}function zp(t,e=n=>setTimeout(n)){let{limits:n,judging:o}=t,s=new fr(t.document),[r,i]=[0,0],[a,l,c]=[!0,!1,!1],h={layer:"mean",chain:0,draw:null},
u="live",p=null,[m,y]=[!1,!1],[v,b]=[0,0],x=null,S=(P,C)=>B.onmessage({type:"status",text:P,level:C},{}),A=()=>B.onmessage({type:"state",document:s.present,generation:r,
seq:i,can_undo:s.canUndo,can_redo:s.canRedo,live:a,running:l,working:c,draws:!c&&p?.draws||{chains:0,count:0},scan:0,view:h},{}),E=(P=!1)=>{p&&(b=performance.now(),
B.onmessage(...p.picture(h,r,Math.round(b-v),P)))};function D(){if(m=!1,y||!c)return;let P=!p;p??=O(),u!=="clear"&&p.work(My);let C=p.done||u==="clear";(P||C||performance.
now()-b>Ty)&&E(),C?(l=c=!1,A()):L()}function L(){m||e(D),m=!0}function O(){let P=s.present,{sensors:C,max_range:U}=P,I=Pp(P),{exact:ie,readings:K}=Py(P,I),J=Float64Array.
from(C.flatMap(({x:fe,y:de,yaw:ae})=>[fe,de,ae])),Q=fe=>Float32Array.from(fe),q={pose:J,angles:Q(ts(P)),ranges:Q(K),exact:Q(ie),hit:Uint8Array.from(ie,fe=>fe<U?
1:0)};x=q,B.onmessage({type:"scan",generation:r,ids:C.map(({id:fe})=>fe),index:null},q);let W=Cp(P,I,K),me=_y(P,t);return u==="clear"?new _o(P,W):me==="importan\
ce"?new Mr(P,W,o):new ns(P,W,o,me==="block")}function G(P=a?"live":"clear"){r++,u=P,p=null,l=u==="run",c=!0,v=performance.now(),A(),L()}function te(){if(!c)return A();
if(!p)return G("clear");l=c=!1,E(!0),A()}function X(P){if(P)return s.push(Yi(P,t.document,n),{type:"hello"}),G();if(!r)return G();A(),E()}function R(P){let{sensors:C,
angles:U}=s.present,I=Math.max(0,C.findIndex(de=>de.id===P)),{x:ie,y:K,yaw:J}=C[I],Q=[I*U,(I+1)*U];if(!x||y)return;let{modes:q,pose:W,weight:me,nats_per_beam:fe}=jp(
s.present,x.ranges.subarray(...Q),x.hit.subarray(...Q));B.onmessage({type:"where",picture:r,sensor:C[I].id,index:null,pose:[ie,K,J],modes:q,p_lost:0,nats_per_beam:fe,
trouble:""},{pose:W,weight:me})}function ee(P){switch(P.type){case"hello":return X(P.document);case"run":{u==="live"&&c&&(p??=O());let ie=p instanceof ns?p:null;
G("run"),ie?.goOn(s.present.sweeps),p=ie;return}case"cancel":return te();case"live":return a=P.on,l?A():a?G():te();case"view":return h={layer:P.layer,chain:P.chain??
h.chain,draw:P.draw??null},A(),E(!c);case"undo":case"redo":return s.step(P.type==="undo")?G():(S(`nothing to ${P.type}`,"info"),A());case"export":{if(P.what!=="\
document")throw new Ye(ca);let ie=new TextEncoder().encode(`${JSON.stringify(s.present,null,1)}
`);return B.onmessage({type:"download",name:"document.json",mime:"application/json",note:""},{data:ie})}case"clear":if(P.what==="inference")return G("clear")}let C=op(
s.present,P,n);if(!C)throw new Ye(ca);let[U,I]=C;s.push(U,P),I&&S(I,"warning"),G()}let B={...cn(),open:()=>{B.onmessage({type:"welcome",version:1,limits:n,recorded:!1,
figure:!0,lacks:[],story:t.story},{}),B.onmessage({type:"worker",state:"ready"},{}),B.onstatus({connected:!0})},send:P=>{if(P.type!=="painted"){if(P.type==="ins\
pect"){let C=p?.beamsThrough(P.x*s.present.grid.shape[1]+P.y);if(C===void 0)return;let U={beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,
chain:null,prior_nats:null,log_odds:null};return B.onmessage({type:"cell",x:P.x,y:P.y,each:!1,beams:C,...U},{})}if(P.type==="where")return e(()=>R(P.sensor));if(Ey.
has(P.type))return S(ca,"warning");i=P.seq??i;try{ee(P)}catch(C){if(!(C instanceof Ye))throw C;if(P.type==="hello")return B.onmessage({type:"error",text:C.message,
remedy:"",seq:i},{});S(C.message,"warning"),A()}}},record:()=>p&&x&&p.recording(x),close:()=>{y=!0}};return B}var ha=250,Cy=8e3;function Yp(t){let e=null,n=ha,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),c=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{c=!0,n=ha,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...hn(h))},l.onclose=()=>{if(s||e!==l)return;o=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),c||Ly(t()).then(u=>u&&e===l&&i.onstatus({...h,refused:u})),n=Math.min(Cy,2*n)}}let i={...cn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},read:(a,l)=>new Promise((c,h)=>{let u=new URL("open",t());u.search=t().search,u.searchParams.set("name",a.name);let p=new XMLHttpRequest;p.open("POST",u),p.
responseType="arraybuffer",p.upload.onprogress=({loaded:m,total:y})=>l(m/y),p.onload=()=>p.status===200?c(p.response):h(new Error(new TextDecoder().decode(p.response))),
p.onerror=()=>h(new Error("the connection is lost")),p.send(a)}),retry:()=>{n=ha,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};
return i}async function Ly(t){try{return(await fetch(t.pathname+t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function qp(t){let e=(o,s=[])=>n.onmessage(o,za(o,s)),n={...cn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var Ny="This is the map that was drawn here when the connection was lost; undo leads back",Kp=()=>!("DecompressionStream"in window&&"adoptedStyleSheets"in document),
Jp="This page needs a newer browser: Safari 16.4, Firefox 121, Chrome 111, or later.",Ar=t=>Object.assign(window,{bayesmap:t}),dv={render({model:t,el:e}){let n=document.
createElement("div");if(e.append(n),Kp())return void(n.textContent=Jp);let o=es(n,qp(t),{embedded:!0});return Ar(o),()=>o.destroy()}};function Xp(t,e){let n=es(
t,us(e),{play:pa(t,()=>n)});Ar(n)}var pa=(t,e)=>n=>{e().destroy(),Xp(t,n)};async function Dy(){let t=document.querySelector("[data-bayesmap]");if(!t||t.shadowRoot)
return;if(Kp())return void(t.textContent=Jp);let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector(
"script[data-recording]");if(n){Xp(t,await ds(n.textContent??""));return}let o=document.querySelector("script[data-figure]");if(o){let[{document:h,damaged:u},p]=await Promise.
all([Oo(),Vp(o.textContent??"")]),m=u?{text:Io,level:"error"}:null,y=es(t,zp(p),{adopt:h,notice:m,play:pa(t,()=>y)});Ar(y);return}Sl(new URLSearchParams(location.
search).get("token"));let{document:s,damaged:r}=await Oo(),i=s?null:xl(),a=Yp(()=>new URL(location.href));Ml(h=>{history.replaceState(null,"",`${location.pathname}\
?token=${encodeURIComponent(h)}${location.hash}`),a.retry?.()});let c=es(t,a,{adopt:s??i,notice:r?{text:Io,level:"error"}:i?{text:Ny,level:"info"}:null,play:pa(
t,()=>c)});Ar(c)}Dy();export{dv as default,zp as localTransport,es as mount,Vp as readFigure,ds as readRecording,us as recordedTransport,Yp as webSocketTransport,qp as widgetTransport};
