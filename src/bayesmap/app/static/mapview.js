// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function wt(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Zn(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function ht(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Sn(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Ga(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Qn=t=>Ga(t,new DecompressionStream("deflate-raw")),Ha=t=>Ga(t,new CompressionStream("deflate-r\
aw"));async function ja(t){let e=await Ha(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Sn(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Ed(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Qn(ht(e[1]))))}var Io="The link's map cannot be read: copy the link again, who\
le";async function Oo(){let t=await Ed(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var Jr={uint8:Uint8Array,uint32:Uint32Array,float32:Float32Array,float64:Float64Array},Va=8,cn=()=>({onmessage:()=>{},onstatus:()=>{}});function hn(t){let e=new DataView(
t).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let l=a.reduce((c,h)=>c*
h,1)*Jr[i].BYTES_PER_ELEMENT;o[r]=new Jr[i](t.slice(s,s+l)),s+=Math.ceil(l/Va)*Va}return[n,o]}function za(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{
let{buffer:i,byteOffset:a,byteLength:l}=e[r];n[o]=new Jr[s](i.slice(a,a+l))}),n}async function ds(t){let e=await Qn(ht(t));return hn(e.buffer)}function us([t,e]){let{document:n,ids:o,log_joint:s}=t,{chains:r,count:i,bits:a}=t.draws,l=n.grid.
shape[0]*n.grid.shape[1],c=n.source.kind!=="simulation",h=1,u={chains:r,count:i},d=0,m={layer:"mean",chain:0,draw:null},y=(D,L=D.length===0)=>{let O=D.length/o.
length;return c&&!L?D.slice(d*O,(d+1)*O):D},M=()=>o[d]-1,b=(D=0)=>{let L={generation:h,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1,scan:M()};E.onmessage(
{type:"state",document:n,seq:D,...L,draws:u,view:m},{})},x=()=>{let{pose:D,angles:L,ranges:O,exact:G,hit:te}=e,X=L.length<O.length,$={pose:y(D),angles:y(L,X),ranges:y(
O),exact:y(G),hit:y(te)};E.onmessage({type:"scan",generation:h,ids:c?[o[d]]:o,index:c?M():null},$)},k=D=>{let L=a?Math.ceil(l/8):l,O=e.draws.slice(D*L,(D+1)*L);
return a?wt(O,l).map(G=>255*G):O},A=()=>{let{p:D,width:L,reached:O,trace:G,traced:te,weights:X}=e,$=Math.min(i-1,m.draw??i-1),ee=m.layer==="draw"&&!i||m.layer===
"width"&&!L?"mean":m.layer,U=ee==="draw"?{chain:m.chain,draw:$,log_joint:s[m.chain][$]}:{},P=ee==="draw"?k(m.chain*i+$):ee==="width"?L:D;E.onmessage({...t.field,
layer:ee,...U},{p:P,reached:O,trace:G,traced:te,...X&&{weights:X}})},E={...cn(),open:()=>E.onstatus({connected:!0}),send:D=>{if(D.type==="hello"){let L=[...i?[]:
["draw"],...e.width?[]:["width"]];E.onmessage({type:"welcome",version:1,limits:null,recorded:!0,figure:!1,lacks:L,story:null},{}),b(D.seq),x(),e.trajectory&&E.onmessage(
{type:"overlay",generation:h},{strokes:e.strokes,trajectory:e.trajectory}),A()}else if(D.type==="view")m={layer:D.layer,chain:D.chain??m.chain,draw:D.draw??null},
b(D.seq),A();else if(D.type==="scan"){let L=o.map(O=>Math.abs(O-1-D.index));d=L.indexOf(Math.min(...L)),b(D.seq),x()}else if(D.type==="inspect"){let{x:L,y:O}=D,
G=e.beams[L*n.grid.shape[1]+O];E.onmessage({type:"cell",x:L,y:O,each:!1,beams:G,beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,chain:null,
prior_nats:null,log_odds:null},{})}},close:()=>{}};return E}async function Pd(t,e){let n=new TextDecoder,o=t.stream().getReader(),[s,r]=["",0];for(let i=await o.read();!i.done;i=await o.read())s+=n.decode(i.value,{stream:!0}),
e((r+=i.value.length)/t.size);return s}async function _d(t,e,n,o){try{let s=await n(t,r=>e.say(r<1?`Reading ${t.name}: ${Math.round(100*r)} %`:`Reading ${t.name}\
: making its picture`));o(hn(s))}catch(s){e.say(`The file ${t.name} cannot be shown: ${s.message}`,"error")}}async function Ya(t,e,n){let{name:o}=t;if(o.endsWith(
".nc")&&e.transport.read&&n)return _d(t,e,e.transport.read,n);if(!/\.(html|json)$/.test(o))return e.say(`The file ${o} is not read in the page: start bayesmap a\
pp with it`,"warning");try{let s=await Pd(t,i=>e.say(`Reading ${o}: ${Math.round(100*i)} %`)),r=/data-recording>(.*?)<\/script>/s.exec(s)?.[1];r&&n?n(await ds(r)):
o.endsWith(".json")&&!e.recorded?e.bring(JSON.parse(s)):e.say(`The file ${o} holds nothing that can be shown here`,"warning")}catch{e.say(`The file ${o} cannot \
be read: export it again, whole`,"error")}}var le=(t,e,n)=>Math.min(n,Math.max(e,t)),qt=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,Ae=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Xr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function Mn(t,e){let{x:n,y:o}=Ae(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var eo=(t,e)=>Xr({x:t.x+.5,y:t.y+.5},e);
function fs(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function qa(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&s(r-1,i)!==s(r,i);l&&a<0&&(a=i),!l&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&s(i,r-1)!==s(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var Uo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Ka(t,e,n){let o=Xa(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Zr(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Ja(t,e){
let n=Ld(e,t.grid.shape),o=Xa(t),s=(i,a,l)=>{if(e[l])return-1/0;let c=2*n[l];for(let h of o)c=Math.min(c,Math.hypot(i-h.x,a-h.y));return c>0?c:-1/0},r=Cd(e,t.grid.
shape,o);return Zr(t,(i,a,l)=>r[l]?s(i,a,l):-1/0)??Zr(t,s)}function Cd(t,[e,n],o){let s=new Uint8Array(e*n),r=(i,a)=>{for(let{x:l,y:c}of fs(i,a)){if(t[l*n+c])return;
s[l*n+c]=1}};for(let i of o){for(let a=0;a<e;a++)for(let l of[0,n-1])r(i,{x:a,y:l});for(let a=0;a<n;a++)for(let l of[0,e-1])r(i,{x:l,y:a})}return s}var Xa=({sensors:t,
grid:e})=>t.map(n=>Mn(n,e));function Zr(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let l=e(i,a,i*o+a);l>r&&([s,r]=[{x:i,y:a},
l])}return s&&eo(s,t.grid)}function Ld(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<n;i++)o[r*
n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),s(r+1,i-
1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var ms=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return qt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(c=>Mn(c,r.grid)):[],l=new Map;for(let c of e)!qt(c,i)||this.isWall(c)===n||a.some(h=>h.x===
c.x&&h.y===c.y)||l.set(c.x*i[1]+c.y,[c.x,c.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?Ja(o,n.walls):"world"in e?e.world:Ka(o,n.walls,e.near),r=n.limits?.sensors[1]??1/0;s?o.sensors.length>=r?n.say(`The\
re can be ${r} sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"add_sensor",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=
Math.max(0,...o.sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"\
remove_sensor",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=Mn(e,n.document.grid),s=this.isWall(o);return!s&&qt(o,n.shape)?(n.status.text.
startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Ft=new Set(["pan","path","look","where","ghost","evidence"]),Nd=120,gs=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.decisions.showPath(e==="path"||e==="pan"||!Ft.has(e)),this.session.ghost.hold(
e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&qt(e,this.session.
shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(
e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.
cursor&&this.announce(this.describe(e))},Nd))}};var He={left:36,right:12,top:34,bottom:26},Dd=60,Rd=160,to=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-He.left-He.right,y:this.height-He.
top-He.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:He.left+(o.x-
s*e)/2,y:He.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,o){let{scale:s}=this.transform,{x:r,
y:i}=this.corner,a=le(s*e,Math.min(this.width,this.height)/Math.max(...o)/3,Rd),l=a/s;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.
x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=Dd;this.corner.
x=le(this.corner.x,s-e*o,this.width-s),this.corner.y=le(this.corner.y,s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var ys=new Set(["path","look","evidence"]);function ws(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);if(e.tool==="evidence"&&t.document){let{x:h,y:u}=Ae(
o,t.document.grid);return t.evidence.pin({x:Math.floor(h),y:Math.floor(u)})}let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,l]=r.
pose.subarray(3*s,3*s+3),c=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${c}`)}var tl=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W","where am I","located"],["O, V","ghost, evidence of beams","as\
ked"],["arrows","move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["S\
pace","at the cursor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, De\
lete","add, remove a sensor","drawn"],["R, Escape","run, cancel","inferred"],["Escape","take a path off the map","asked"],["M, N, H","show the mean, a draw, the\
 entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","edited"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],$d={ArrowLeft:[-1,0],ArrowRight:[1,0],
ArrowUp:[0,1],ArrowDown:[0,-1]},Za=Math.PI/12,bs=class{constructor(e,n,o,s,r){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;e.addEventListener(
"keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){
let{session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=$d[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?Za:-Za;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&
o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key===
"Backspace")&&n.editable)s.removeSensor();else if(e.key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.
editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&
o.ghost.pose&&o.document){let{resolution:l}=o.document.grid,{x:c,y:h}=o.ghost.pose;o.ghost.move({x:c+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&
r.sensor&&o.document&&o.editable){let{resolution:l}=o.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.
tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},c={x:le(l.x+e,0,i-1),y:le(l.y+n,0,a-1)};
r.setCursor(c);let h=s.fromGrid({x:c.x+.5,y:c.y+.5},a),u=(m,y,M)=>m-le(m,y,M),d={x:u(h.x,He.left+10,s.width-20),y:u(h.y,20,s.height-He.bottom-10)};(d.x||d.y)&&s.
pan(-d.x,-d.y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if(ys.has(o.tool)&&n.document){o.cursor?ws(n,o,s,eo(o.cursor,n.document.grid)):this.arrow(0,
0);return}if(n.editable){if(o.tool==="sensor"||o.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,
r.length)]?.id??null),o.selected!==null&&o.announce(`Sensor ${o.selected}`)}else if(!Ft.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&
!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.announce(i?"wall":"free")}}}},Bo={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",
v:"evidence"},Qa={m:"mean",n:"draw",h:"entropy"},el={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function nl(t,e,n){let o=t.composedPath()[0],s=o instanceof
HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||
e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}let i=t.key==="Escape"&&e.decisions.start!==null&&e.decisions.pathShown;
if(!(s&&!i||t.altKey)){if(Bo[r]&&(Ft.has(Bo[r])?e.answers||Bo[r]==="where"&&e.locates||Bo[r]==="pan"&&e.editable:e.editable))n.tool(Bo[r]);else if(Qa[r])n.layer(
r==="h"&&e.quantity.interval?"width":Qa[r]);else if(el[t.key])n.command(el[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(i)e.decisions.forgetPath();else if(t.
key==="Escape"&&(e.running||e.working))e.act({type:"cancel"});else return;t.preventDefault()}}var Fd={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Id={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},ks={light:Fd,dark:Id},ol="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Od([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((l,c)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*s[c]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let c=le(l,0,1);return Math.round(255*(c<=.0031308?12.92*c:1.055*c**(1/2.4)-.055))})}var xs=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),vs=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),Wo=(t,e)=>Od(vs(t.paper,t.ink,e));function no(t){let e=Math.min(15,Math.floor(
t*16));return vs(xs(ol,6*e),xs(ol,6*e+6),t*16-e)}function sl(t,e){let n=new Uint8ClampedArray(17408).fill(255),[o,s]=[xs(t.unobserved),xs(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?Uo(r/255):r/255,a=e==="value"?Wo(t,r/255):no(i),l=e==="value"?vs(o,s,r/255):a;for(let c=0;c<=16;c++)n.set(vs(l,a,c/16),4*(r+256*c))}
return new Uint32Array(n.buffer)}var Qr=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;var Ms='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Tn(t,e,n,o,s,r,i=!1){t.font=Ms,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=i?`rgb(${Wo(s,1).map(Math.round)})`:s.axis,t.fillText(e,n,o)}var oo=8,Ss=class{constructor(e,n,o,s,r=0){
this.context=e;this.theme=n;this.width=o;this.height=s;this.left=r}placed=[];marks=[];avoid(e,n,o=e){let s=Math.ceil(Math.hypot(o.x-e.x,o.y-e.y)/6);for(let r=0;r<=
s;r++){let i=r/Math.max(1,s);this.marks.push({x:e.x+i*(o.x-e.x),y:e.y+i*(o.y-e.y),half:n,tall:n})}}place(e,n,o,s,r=0){this.context.font=Ms;let i=this.context.measureText(
e).width/2+2,a=Math.min(Math.max(n,this.left+i),this.width-i),[l,c]=[n+s+i+4,n-s-i-4],h=[[a,o-s-9],[a,o+s+9],[l,o],[c,o]];for(let b=oo;b<=r;b+=oo)h.push([a,o-s-
9-b],[a,o+s+9+b],...[l,c].flatMap(x=>[[x,o-b],[x,o+b]]));let u=([b,x])=>b-i>=0&&b+i<=this.width&&x>=oo&&x<=this.height-oo,d=b=>([x,k])=>b.every(A=>Math.abs(x-A.
x)>=i+A.half||Math.abs(k-A.y)>=oo+A.tall),m=h.filter(u).filter(d(this.placed)),M=m.filter(([b])=>b-i>=this.left).find(d(this.marks))??m[0];return M&&this.placed.
push({text:e,x:M[0],y:M[1],half:i,tall:oo}),!!M}write(){for(let{text:e,x:n,y:o}of this.placed)Tn(this.context,e,n,o,this.theme,"center",!0)}};var Go=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:c,context:h,layer:u}=l,d=u.shows?.(e)??!0,m=[d,...d?[...a,...u.depends(e)]:[]];m.length===
l.before.length&&m.every((y,M)=>Object.is(y,l.before[M]))||(l.before=m,c.style.visibility=d?"":"hidden",d&&((c.width!==i.width||c.height!==i.height)&&(Object.assign(
c,i),c.style.width=`${i.width/s}px`,c.style.height=`${i.height/s}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,c.width,c.height),h.setTransform(s,0,0,s,0,0),
h.save(),u.paint(h,e),h.restore(),this.paints[u.name]++))}}};function so(t,{session:e,look:n,view:o}){let{scale:s,x:r,y:i}=o.transform,a=new Ss(t,n.theme,o.width,
Math.min(o.height,i+e.shape[1]*s),Math.max(He.left,r)),{sensors:l=[],grid:c}=e.document??{};if(c)for(let h of l)a.avoid(o.fromGrid(Ae(h,c),c.shape[1]),9);return a}
function Ue(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(i,a,o*r,s*r),t.clip()}function An(t,{halo:e},n,o){t.lineWidth=
4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}function ei({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function pn(t,e,n){let o=n.fromGrid(Ae(t,e),e.shape[1]),s=le(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function rl(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=ei(e);t.lineJoin=
"round";for(let a of i){let l=pn(a,s.grid,n),{point:c,size:h}=l;a.id===o.selected&&Ud(t,l,o);let[u,d]=[Math.cos(a.yaw),-Math.sin(a.yaw)],m=(y,M)=>[c.x+h*(y*u-M*
d),c.y+h*(y*d+M*u)];t.beginPath(),t.moveTo(...m(1.25,0)),t.lineTo(...m(-.9,.8)),t.lineTo(...m(-.45,0)),t.lineTo(...m(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Tn(t,String(a.id),c.x,c.y+h*2+4,r,"center",!0)}}function Ud(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),An(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function il(t,e,n,o,s){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&pn({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function al(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var ll={touch:24,other:11},Bd=5,Wd=90,Ts=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(l,c)=>e.
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
e",id:o.nextGesture(),wall:l,last:c,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Wd)}}gripAt(e,n,o){let{hand:s,view:r}=this,
i=this.reach(n),a=d=>Math.hypot(e.x-d.x,e.y-d.y),l=s.tool==="sensor"&&s.sensor?pn(s.sensor,o.grid,r):null;if(l&&s.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let c=o.sensors.map(d=>({id:d.id,...pn(d,o.grid,r)}));c.sort((d,m)=>a(
d.point)-a(m.point));let h=c.find(({point:d,size:m})=>a(d)<Math.max(i,m));if(!h)return null;let u={x:h.point.x-e.x,y:h.point.y-e.y};return{kind:"sensor",id:h.id,
drag:s.nextGesture(),grip:u}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let c of l.
length?l:[e]){let h=this.cellAt(this.at(c));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(...fs(n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(c=>c.id===n.id);if(!a||!o.document)return;let l=this.metres(i,o.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>Bd&&this.begin({kind:"pan",
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
{x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var Gd=5,As=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(He.left,0,o.width,o.height-He.bottom),e.clip(),s.hover&&cl(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&cl(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function cl(t,e,n,o,s,r,i){let{scale:a}=o.transform,l=o.fromGrid({x:e.x,y:e.y+1},n),c=Math.max(a,Gd),[h,u]=[l.x-(c-a)/2,l.y-(c-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(h,u,c,c),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,u,c,c)}function S(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function C(t,e,n){t[e]!==n&&(t[e]=n)}function ot(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var En=t=>t.getRootNode().activeElement===t,me=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function ti(t,e){let n=URL.
createObjectURL(e);S("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Hd=9,jd=2.5,ro=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start&&e.pathShown||e.looking&&e.views))}paint(e,n){let{session:o}=n;if(!o.document)return;let s=so(e,n);e.save(),Ue(e,n),o.decisions.looking&&this.
views(e,n,s),o.decisions.pathShown&&this.path(e,n,s),e.restore(),s.write()}views(e,{session:n,view:o,look:s},r){let{views:i}=n.decisions,a=n.document?.grid;if(!i?.
nats.length||!a)return;let l=Math.max(...i.nats),c=le(.38*i.spacing*o.transform.scale/a.resolution,jd,Hd),h=i.nats.indexOf(l);for(let u=0;u<i.nats.length;u++){let d=o.
fromGrid(Ae({x:i.pose[3*u],y:i.pose[3*u+1]},a),a.shape[1]);e.beginPath(),e.arc(d.x,d.y,c,0,2*Math.PI),e.fillStyle=`rgb(${no(le(i.nats[u]/Math.max(l,1e-9),0,1)).
map(Math.round)})`,e.fill(),u===h&&(e.lineWidth=2.5,e.strokeStyle=s.theme.truth,e.stroke(),r.place(`${me(l,1)} nats`,d.x,d.y,c))}}path(e,{session:n,view:o,look:s},r){
let{start:i,goal:a,path:l,radius:c}=n.decisions,h=n.document?.grid;if(!h||!i)return;let u=d=>o.fromGrid(Ae(d,h),h.shape[1]);if(l){e.beginPath();for(let[d,m]of l.
path){let y=u({x:d,y:m});e.lineTo(y.x,y.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=l.within_risk?s.theme.sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*
c*o.transform.scale/h.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let d of a?[i,a]:[i]){let{x:m,y}=u(d);e.beginPath(),e.arc(m,y,5,0,2*Math.
PI),e.fillStyle=d===i?s.theme.sensor:s.theme.truth,e.fill(),r.avoid({x:m,y},7),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}if(l){let d=l.path.length,[[m,
y],[M,b]]=[l.path[d-1>>1],l.path[d>>1]],x=u({x:(m+M)/2,y:(y+b)/2}),k=l.path.map(([A,E])=>u({x:A,y:E}));k.forEach((A,E)=>r.avoid(A,3,k[E+1])),r.place(`${me(l.length_m,
1)} m, P(free) ${me(l.probability,3)}`,x.x,x.y,4,60)}else a&&n.decisions.trouble&&r.place("no path",u(a).x,u(a).y,7)}};var Vd=5,[zd,hl]=[.8,5],Yd=6,Es=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:o,view:s,look:r}=n,{cell:i,each:a}=o.evidence,l=o.document?.grid;if(!i||!l)return;
e.save(),Ue(e,n);let c=(x,k)=>s.fromGrid(Ae({x,y:k},l),l.shape[1]),h=x=>[c(a.start[2*x],a.start[2*x+1]),c(a.end[2*x],a.end[2*x+1])],u=a?.nats.length??0;e.lineCap=
"round";for(let x=u-1;x>=0;x--){let[k,A]=h(x),E=a.nats[x];e.beginPath(),e.moveTo(k.x,k.y),e.lineTo(A.x,A.y),e.globalAlpha=le(.25+Math.abs(E)/2,0,.9),e.lineWidth=
le(hl*Math.sqrt(Math.abs(E)/Yd),zd,hl),e.strokeStyle=E>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:d}=s.transform,m=s.fromGrid({x:i.x,y:i.y+
1},l.shape[1]),y=Math.max(1,4-d/2);e.beginPath(),e.rect(m.x-y,m.y-y,d+2*y,d+2*y),An(e,r.theme,r.theme.belief,2),e.restore();let M=so(e,n),b=Math.min(Vd,u);for(let x=0;x<
b;x++)M.avoid(h(x)[0],2,h(x)[1]);for(let x=0;x<b;x++){let[k,A]=h(x),E=.35+.1*x;M.place(io(a.nats[x]),k.x+E*(A.x-k.x),k.y+E*(A.y-k.y),3)}M.write()}},io=t=>`${t<0?
"−":"+"}${Math.abs(t).toFixed(1)}`;var qd=10,Kd=7,Jd=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",Ps=()=>document.createElement("canvas").getContext("2d"),ao=class{name="\
field";cells=Ps();mask=Ps();hatch=Ps();palettes=new Map;image=new ImageData(1,1);drawn={field:null,reached:null,palette:"",hatch:""};depends({session:e}){return[
e.picture,e.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.
shape,{scale:l,x:c,y:h}=s.transform;Ue(e,n);let u=o.picture;if(!u||u.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(c,h,i*l,a*l);return}this.fill(u,i,
a,r.theme,Jd(u,o.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,c,h,i*l,a*l),this.fillHatch(n),e.drawImage(this.hatch.canvas,0,0,this.hatch.canvas.
width/s.ratio,this.hatch.canvas.height/s.ratio),l>=qd&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:l}=this,c=`${s.ground} ${r}`;if(l.field===e&&l.palette===
c)return;let h=this.palettes.get(c)??sl(s,r);if(this.palettes.set(c,h),this.image.width!==n||this.image.height!==o){this.image=new ImageData(n,o);for(let{canvas:d}of[
i,a])Object.assign(d,{width:n,height:o});l.reached=null}let u=new Uint32Array(this.image.data.buffer);for(let d=0,m=0;d<o;d++)for(let y=o-1-d;y<n*o;y+=o)u[m++]=
h[e.p[y]+256*(e.reached[y]+8>>4)];if(i.putImageData(this.image,0,0),l.reached!==e.reached){for(let d=0,m=0;d<o;d++)for(let y=o-1-d;y<n*o;y+=o)u[m++]=255-e.reached[y]<<
24;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,reached:e.reached,palette:c})}fillHatch({session:e,view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,
{ratio:a,width:l,height:c}=n,{scale:h,x:u,y:d}=n.transform,[m,y]=e.shape,M=[o.theme.ground,h,u,d,l,c,a].join(" ");if(i.hatch===M)return;i.hatch=M;let b=Ps(),x=b.
canvas.width=b.canvas.height=Math.round(Kd*a);b.strokeStyle=o.theme.hatch,b.lineWidth=a,b.beginPath();for(let A of[-x,0,x])b.moveTo(A-1,x+1),b.lineTo(A+x+1,-1);
b.stroke(),Object.assign(s.canvas,{width:Math.ceil(l*a),height:Math.ceil(c*a)}),s.setTransform(a,0,0,a,0,0),s.imageSmoothingEnabled=!1,s.drawImage(r.canvas,u,d,
m*h,y*h),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let k=s.createPattern(b.canvas,"repeat");k.setTransform(new DOMMatrix().translate(Math.
round(u*a),Math.round(d*a))),s.fillStyle=k,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,view:o,look:s}){let[r,i]=n.shape,{scale:a,x:l,y:c}=o.
transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,c),e.lineTo(l+h*a,c+i*a);for(let h=1;h<i;h++)e.moveTo(l,c+h*a),e.lineTo(l+r*a,c+h*a);e.strokeStyle=s.
theme.lines,e.lineWidth=1,e.stroke()}};var Xd=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],lo=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(Ue(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(l,c)=>{let h=le(r[c],0,a),u=o.yaw+l,d={x:o.x+h*Math.cos(u),y:o.y+h*Math.sin(u)};return n.fromGrid(Ae(d,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(y=>this.ends(n,o,o.angles,y)),{grid:l}=n.session.document,c=n.view.fromGrid(Ae(o,l),l.shape[1]),h=new Path2D;
h.moveTo(c.x,c.y);for(let{x:y,y:M}of r)h.lineTo(y,M);h.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(h);let u=new Path2D,d=new Path2D,m=le(n.view.transform.
scale*.12,1.2,3);for(let y=0;y<r.length;y++)u.moveTo(r[y].x,r[y].y),u.lineTo(a[y].x,a[y].y),Number.isFinite(o.median[y])&&d.rect(i[y].x-m,i[y].y-m,2*m,2*m);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=le(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(u),e.globalAlpha=1,d}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,l=le(n.view.transform.scale*.14,1.5,4),c=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),h=new Path2D;c.forEach(({x:u,y:d},m)=>{i[m]&&
(h.moveTo(u+l,d),h.arc(u,d,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:l,handle:c}=pn({id:0,...r},i,o),[h,u]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(c.x,c.y),An(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[d,m]of Xd)e.lineTo(a.x+l*(d*h-m*u),a.y+l*(d*u+m*h));e.closePath(),e.lineJoin="round",An(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(c.x,c.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var ni=({flicker:t,shown:e,where:n})=>t.under&&!n.map?e:null,co=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,
colour:""};depends({session:e}){return[ni(e)]}shows({session:e}){return ni(e)!==null}paint(e,n){let{session:o,view:s,look:r}=n,i=ni(o);if(!i)return;let[a,l]=o.shape,
{scale:c,x:h,y:u}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Ue(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,u,a*c,l*c)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(c=>parseInt(s.slice(c,c+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let l=new ImageData(
n,o);for(let c=0,h=0;c<o;c++)for(let u=o-1-c;u<n*o;u+=o,h+=4)l.data.set([r,i,a,Math.round(e.p[u]*e.reached[u]/255)],h);this.cells.putImageData(l,0,0),this.drawn=
{field:e,colour:s}}};var Zd=46,Qd=22;function eu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function pl(t,{session:e,view:n,look:o}){if(!e.document)
return;let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:l,shape:c}=e.document.grid,{scale:h,x:u,y:d}=n.transform,m=eu(Zd/h*l),y=Math.min(d+c[1]*h,i-He.bottom)+
.5,M=Math.max(u,He.left)-.5;t.fillStyle=s.ground,u<M&&t.fillRect(0,0,M,i+1),d+c[1]*h>y&&t.fillRect(0,y,r+1,i+1-y);let b=Math.max(0,-Math.floor(Math.log10(m)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let x=A=>Math.ceil(a[A]/m-1e-9)*m,k=A=>a[A]+c[A]*l+1e-9;for(let A=x(0);A<=k(0);A+=m){let E=u+(A-a[0])/l*h;E<M||
E>r-4||(t.moveTo(E,y),t.lineTo(E,y+4),Tn(t,A.toFixed(b),E,y+12,s,"center"))}for(let A=x(1);A<=k(1);A+=m){let E=d+(c[1]-(A-a[1])/l)*h;E>y||E<4||(t.moveTo(M,E),t.
lineTo(M-4,E),Tn(t,A.toFixed(b),M-7,E,s,"right"))}t.stroke(),Tn(t,"m",M-Qd,y+12,s,"right")}var ho=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=ei(e).flatMap(({id:i,x:a,y:l,yaw:c})=>[i,a,l,c]),{grid:s}=e.document??{},
r=dl(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:c,y:h}=s.transform;r.truth&&dl(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(c-.5,h-.5,i*l+1,a*l+1),rl(e,n),pl(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:l}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=qa(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),Ue(e,n),e.transform(i,0,0,-i,a,l+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=le(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},dl=({document:t})=>t?.source.kind==="simulation";var tu=600,nu=1500,ou=65536,oi=.3,po=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;
if(!i||!a)return;Ue(e,n);let{scale:l}=s.transform,c=1/a.grid.resolution,h=a.grid.shape[1],u=i.angles.length,d=i.pose.length/3,m=Math.ceil(u*d/nu),[y,M,b]=[new Path2D,
new Path2D,new Path2D],x=u*d>tu,k=new Map,A=le(l*.1,1.3,4),E=a.scans_used??1/0,D=(i.index??0)<E?1:oi;for(let L=0;L<d;L++){let[O,G,te]=i.pose.subarray(3*L,3*L+3),
X=s.fromGrid(Ae({x:O,y:G},a.grid),h);for(let $=0;$<u;$++){let ee=i.ranges[L*u+$],U=i.hit[L*u+$]===1,P=(U?ee:a.max_range)*c*l,_=i.angles[$]+te,B={x:X.x+P*Math.cos(
_),y:X.y-P*Math.sin(_)},I=U?y:M;(L*u+$)%m===0&&(I.moveTo(X.x,X.y),I.lineTo(B.x,B.y)),U&&(x?k.set(Math.round(B.x)*ou+Math.round(B.y),B):(b.moveTo(B.x+A,B.y),b.arc(
B.x,B.y,A,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=D*le(28/Math.sqrt(u*d/m)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(y),e.strokeStyle=r.theme.
noReturn,e.stroke(M),e.globalAlpha=1),r.readings){e.globalAlpha=D,e.fillStyle=r.theme.ray,e.fill(b);let L=1.8*A;for(let{x:O,y:G}of k.values())e.fillRect(O-L/2,G-
L/2,L,L);e.globalAlpha=1}}};var su=2.5,Ho=t=>t>=su,uo=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(Ue(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&Ho(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[c,h,u]of[[0,l,.6],
[Math.max(0,l-1),a,.6*oi]]){e.beginPath();for(let d=c;d<h;d++){let m=o.fromGrid(Ae({x:r[2*d],y:r[2*d+1]},i),i.shape[1]);e.lineTo(m.x,m.y)}e.globalAlpha=u,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,c,h,u]=r.subarray(a,a+4),[d,
m]=[o.fromGrid(Ae({x:l,y:c},i),i.shape[1]),o.fromGrid(Ae({x:h,y:u},i),i.shape[1])];e.moveTo(d.x,d.y),e.lineTo(m.x,m.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=le(o.transform.scale/5,.8,2.5),e.stroke()}}};var ru=2.2,fo=7,[iu,au]=[.03,.75],lu=2.4477,ul=9,mo=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!s||!r)return;let i=so(
e,n);e.save(),Ue(e,n),this.cloud(e,n,r);let a=s.modes.map(l=>({place:l,...this.ring(e,n,r,l,i)}));for(let{place:l,at:c,short:h}of a)i.place(si(l.probability),c.
x,c.y,h);e.restore(),i.write()}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||1;e.strokeStyle=e.fillStyle=s.theme.belief,
e.lineWidth=1.2;for(let c=0;c<a.length;c++){if(a[c]<iu**2*l)continue;let[h,u,d]=i.subarray(3*c,3*c+3),m=o.fromGrid(Ae({x:h,y:u},r),r.shape[1]);e.globalAlpha=au*
Math.sqrt(a[c]/l),e.beginPath(),e.arc(m.x,m.y,ru,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(m.x,m.y),e.lineTo(m.x+fo*Math.cos(d),m.y-fo*Math.sin(d)),e.stroke()}
e.globalAlpha=1}ring(e,{view:n,look:o},s,r,i){let[a,l,c]=r.mean,h=n.fromGrid(Ae({x:a,y:l},s),s.shape[1]),u=lu*n.transform.scale/s.resolution,[[d,m],[,y]]=r.covariance,
[M,b]=[(d+y)/2,Math.hypot((d-y)/2,m)],[x,k]=[M+b,M-b].map(E=>Math.max(ul,u*Math.sqrt(Math.max(E,0))));e.beginPath(),e.ellipse(h.x,h.y,x,k,-Math.atan2(2*m,d-y)/2,
0,2*Math.PI);let A=ul+1;return e.moveTo(h.x+A*Math.cos(c),h.y-A*Math.sin(c)),e.lineTo(h.x+(A+fo)*Math.cos(c),h.y-(A+fo)*Math.sin(c)),e.strokeStyle=o.theme.halo,
e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i.avoid(h,k),i.avoid(h,2,{x:h.x+(A+fo)*Math.cos(c),y:h.y-(A+fo)*Math.sin(c)}),{at:h,
short:k}}},si=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var fl=900,jo=2,ri=()=>[new ao,new co,new uo,new po,new ho,new ro,new mo,new lo];function ml({session:t,look:e}){let[n,o]=t.shape,s=new to;s.resize(fl,Math.round(
le(fl*o/n,300,1800)),jo),s.fit(t.shape);let r=document.createElement("canvas");Object.assign(r,{width:s.width*jo,height:s.height*jo});let i=r.getContext("2d");i.
scale(jo,jo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);let a={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let l of ri())
(l.shows?.(a)??!0)&&(i.save(),l.paint(i,a),i.restore());return new Promise(l=>r.toBlob(l))}var _s=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:l,document:c}=o;if(!i||!c||l?.index!==
i.scan)return;Ue(e,n);let{grid:h,max_range:u}=c,d=b=>{let x={x:i.from.x+b*Math.cos(i.angle),y:i.from.y+b*Math.sin(i.angle)};return s.fromGrid(Ae(x,h),h.shape[1])},
m=(b,x,k,A)=>{e.beginPath(),e.moveTo(b.x,b.y),e.lineTo(x.x,x.y),e.lineWidth=k,e.strokeStyle=A,e.stroke()},y=l.hit[i.beam]===1,M=d(y?l.ranges[i.beam]:u);if(m(d(0),
M,3,r.theme.halo),m(d(0),M,1.5,y?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let b=(x,k)=>le(x??k,0,u);if(m(d(b(a.low,0)),d(b(a.high,u)),6,r.theme.ghost),
a.median!==null){let x=d(a.median),k={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};m({x:x.x-k.x,y:x.y-k.y},{x:x.x+k.x,y:x.y+k.y},2.5,r.theme.ghost)}}y&&(e.beginPath(),
e.arc(M.x,M.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};var gl="bayesmap-token",ii="bayesmap-kept",yl="bayesmap-tools";function wl(t){try{return localStorage.getItem(t)}catch{return null}}function Cs(t,e){try{e===null?
localStorage.removeItem(t):localStorage.setItem(t,e)}catch{}}function ai(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&Cs(ii,JSON.stringify(
t))}function bl(){Cs(ii,null)}function xl(){let t=wl(ii);try{return t&&JSON.parse(t)}catch{return null}}var vl=()=>wl(yl)!==null,kl=t=>Cs(yl,t?"all":null);function Sl(t){
t&&Cs(gl,t)}function Ml(t){let e=n=>{n.key===gl&&n.newValue&&t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",
e)}var li=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["where","Where am I?","where"],["path","Path","path"],
["evidence","Evidence","evidence"],["look","Look next","look"],["ghost","Ghost","ghost"]],cu=5;function Tl(t){let{hand:e,session:n}=t,o=t.segmented("Tool",li,()=>n.
editable||!n.document||Ft.has(e.tool)?e.tool:"pan",i=>e.choose(i));t.visible(o,()=>!n.recorded);let s=vl(),r=t.button(null,"More tools",()=>{kl(s=!s),n.changed()},
{text:"More"});return t.visible(r,()=>n.answers),t.each(()=>{let i=li.filter(([l])=>Ft.has(l)?!n.figure||l==="pan"||l==="where":!n.document||n.editable).map(([l])=>l),
a=new Set(s?i:i.slice(0,cu));li.forEach(([l],c)=>C(o.children[c],"hidden",!a.has(l)&&!(l===e.tool&&i.includes(l)))),C(r.lastElementChild,"textContent",s?"Fewer":
"More"),ot(r,"aria-label",s?"Fewer tools":"More tools"),C(r,"title",s?"Fewer tools":"More tools: paths, evidence, where to look next, the ghost")}),S("div",{className:"\
bar"},o,r,S("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),
{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Zt=t=>t.charAt(0).toUpperCase()+t.slice(1),Ls=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=Zt(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var hu=20,pu={importance:"particles",propagate:"rounds"},Ns=({working:t,shown:e})=>t&&e?.method==="pilot";function Al(t,...e){let{session:n}=t,o=S("progress",{max:1,
value:0,"aria-label":"Progress"}),s=S("div",{className:"doing"});t.each(()=>{let i=n.shown,{stage:a}=n,l=i?.generation!==n.generation&&(n.running||n.document?.source.
kind==="log"),c=Ns(n),h=a?a.done/a.total:i&&!l&&i.total>0&&(c||!i.approximate)?i.sweeps/i.total:0;C(o,"value",h);let u=n.remaining_s(),d=pu[i?.method??""]??"swe\
eps",m=i&&!i.approximate&&i.total?`${i.sweeps} of ${i.total} ${d}`:"",y=u!==null?u<1?"less than 1 s left":`${Math.ceil(u)} s left`:n.running?"running":"",M=m&&i?.
burned?`burn-in of ${i.burned} left out`:"",b=n.sampling||n.running||!i||i.sweeps>=i.total?"":"stopped";a?C(s,"textContent",`${a.text}: ${a.done} of ${a.total} ${a.
total>hu?"scans":"rounds"}`):l?C(s,"textContent","Computing"):i&&c?C(s,"textContent",`Fitting the sensor: sweep ${i.sweeps} of ${i.total}`):C(s,"textContent",Zt(
[m,M,y,m&&b].filter(Boolean).join(", "))||uu(n))});let r=S("p",{className:"caption",textContent:"This is the posterior of walls that are not known. The map show\
s the drawn walls, which Where am I? takes as known."});return t.visible(r,()=>n.where.map!==null),t.section("Posterior",r,mu(t),o,s,...gu(t),wu(t),...e,yu(t))}
var du=({document:t})=>!/importance|propagate/.test(t?.method??"")||(t?.cells??"binary")!=="binary";function uu({shown:t,working:e,document:n,nothingToRun:o,recorded:s}){
let r=!s&&n?.source.kind!=="run",i=r&&n?.method==="importance"?"; Run weighs particles":r&&o?"; it is done, and Run has nothing to add":"";return t?.method==="p\
ropagate"?`${t.sweeps?`${t.sweeps} rounds of belief`:"Belief"} propagation${i}`:t?.method==="hits"?"Counts of hits and passes":t?.method==="counts"?"Run infers \
where the robot was":t?.method==="pilot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function fu({document:t,shown:e,draws:n}){return e?.
method==="counts"?"infer where the robot was, then sample maps":t?.cells==="binary"&&t.method==="importance"?"weigh particles":t?.cells==="binary"&&t.method==="\
propagate"?"belief propagation":n.count?"more sweeps of the chains on show":"sample maps"}function mu(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"\
run"}),{className:"primary",text:"Run",title:()=>`Run (R): ${fu(e)}`,when:()=>e.connection.connected&&!e.nothingToRun,why:()=>e.nothingToRun||"Not while the con\
nection is lost"}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||e.sampling||Ns(e),why:"Noth\
ing is running"}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Infer anew after every edit; Run goes on from the draws that are k\
ept"),r=S("div",{className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function gu(t){let{session:e}=t,n=S("dl"),o=S(
"dl",{className:"about"}),s=(i,a,l,{judged:c=!1,ofChains:h=!1}={})=>{let u=S("dd",{textContent:"–"}),d=S("div",{title:a},S("dt",{textContent:i}),u);n.append(d),
c&&t.named.push({name:()=>i,place:d,control:d});let m=[S("dt",{textContent:i}),S("dd",{textContent:a})];if(o.append(...m),h)for(let y of[d,...m])t.visible(y,()=>du(
e));return t.each(()=>{C(u,"textContent",e.shown?l(e.shown):"–"),c&&C(u,"className",e.shown?.verdict?.level??"")}),d};s("ESS","Effective sample size of the lo\
g joint: so many independent draws would tell as much of its mean",i=>me(i.ess,0),{judged:!0}),s("R-hat","Agreement of the chains on the log joint: 1 where they\
 agree, more where each still tells of its start",i=>me(i.rhat,3),{judged:!0,ofChains:!0}),s("log joint","Log of prior times likelihood at the last sweep",i=>me(
i.log_joint,Math.abs(i.log_joint??0)<1e5?1:0),{ofChains:!0}),s("time","Time spent on sweeps, rounds or particles",i=>me(i.seconds,1," s"));let r=s("reply","From\
 the hand's last move to its picture",()=>me(e.latency.eventToPaint_ms.at(-1),0," ms"));return t.visible(r,()=>!e.recorded),[n,S("details",{},S("summary",{textContent:"\
What these figures mean"}),o)]}var Vo=({shown:t})=>t?.method==="importance"?{good:"Enough particles",fair:"Few particles",bad:"Collapsed"}:{good:"Converged",fair:"\
Nearly converged",bad:"Not converged"};function yu(t){let{session:e}=t,n=S("dl",{className:"about"}),o=S("details",{},S("summary",{textContent:"Model and method\
 of this picture"}),n),s="";return t.each(()=>{let r=e.shown?.about??[];C(o,"hidden",!r.length),String(r)!==s&&(s=String(r),n.replaceChildren(...r.flatMap(([i,a])=>[
S("dt",{textContent:i}),S("dd",{textContent:a})])))}),o}function wu(t){let{session:e}=t,n=S("span"),o=t.button(null,"Show the cell",()=>t.command(`cell ${e.shown?.
verdict?.cell}`),{text:"Show the cell"});t.visible(o,()=>!!e.shown?.verdict?.cell);let s=S("div",{className:"verdict"},n,o);return t.each(()=>{let r=e.shown?.verdict;
if(!r)return C(s,"hidden",s.hidden||!e.working),C(n,"textContent","Too early to judge."),C(s,"className","verdict early");C(s,"hidden",!1),C(n,"textContent",`${Vo(
e)[r.level]}: ${r.why}`),C(s,"className",`verdict ${r.level}`)}),s}function Pl(t,e){let{session:n}=t,s=t.checkbox("Keep this result beside the next",()=>e.kept!==null,r=>r?e.keep():e.forget(),"Change the method, the order, the \
prior or the map, and compare: both results follow the layer and the draw");return t.visible(s,()=>n.locates&&(e.kept!==null||n.shown!==null)),s}function _l(t,e){
let[n,o]=[S("p",{className:"told-apart"}),S("p",{className:"told-apart"})];return t.visible(n,()=>e.kept!==null),t.each(()=>{if(!e.kept)return;let[s,r]=e.differences();
C(n,"textContent",`Now: ${s}. ${El(t.session)}`),C(o,"textContent",`Kept: ${r}. ${El(e.kept)}`)}),{now:n,kept:o}}function El(t){let{shown:e,draws:n}=t;if(!e)return"";
let o=e.layer==="draw"?[`Draw ${t.draw+1} of ${n.count}, log joint ${me(e.log_joint,1)}`]:[],s=e.verdict?[Vo(t)[e.verdict.level]]:[],r=e.rhat===null?[]:[`R-hat ${me(
e.rhat,3)}, ESS ${me(e.ess,0)}`];return[...o,...s,...r].map(i=>`${i}.`).join(" ")}var bu="uplot",xu="u-hz",vu="u-vt",ku="u-title",Su="u-wrap",Mu="u-under",Tu="u-over",Au="u-axis",Cn="u-off",Eu="u-select",Pu="u-cursor-x",_u="u-cursor-y",Cu="u-\
cursor-pt",Lu="u-legend",Nu="u-live",Du="u-inline",Ru="u-series",$u="u-marker",Cl="u-label",Fu="u-value",Yo="width",qo="height";var Ll="bottom",go="left",ci="right",Ai="#000",Nl=Ai+"0",hi="mousemove",Dl="mousedown",pi="mouseup",Rl="mouseenter",$l="mouseleave",Fl="dblclick",Iu="resize",Ou="\
scroll",Il="change",Is="dppxchange",Ei="--",So=typeof window<"u",gi=So?document:null,wo=So?window:null,Uu=So?navigator:null,be,Ds;function yi(){let t=devicePixelRatio;
be!=t&&(be=t,Ds&&bi(Il,Ds,yi),Ds=matchMedia(`(min-resolution: ${be-.001}dppx) and (max-resolution: ${be+.001}dppx)`),Ln(Il,Ds,yi),wo.dispatchEvent(new CustomEvent(
Is)))}function bt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function wi(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Ce(t,e,n){
t.style[e]=n+"px"}function It(t,e,n,o){let s=gi.createElement(t);return e!=null&&bt(s,e),n?.insertBefore(s,o),s}function Et(t,e){return It("div",t,e)}var Ol=new WeakMap;
function Kt(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=Ol.get(t);r!=i&&(t.style.transform=r,Ol.set(t,r),e<0||n<0||e>o||n>s?bt(t,Cn):wi(t,Cn))}var Ul=new WeakMap;
function Bl(t,e,n){let o=e+n,s=Ul.get(t);o!=s&&(Ul.set(t,o),t.style.background=e,t.style.borderColor=n)}var Wl=new WeakMap;function Gl(t,e,n,o){let s=e+""+n,r=Wl.
get(t);s!=r&&(Wl.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Pi={passive:!0},Bu={...Pi,
capture:!0};function Ln(t,e,n,o){e.addEventListener(t,n,o?Bu:Pi)}function bi(t,e,n,o){e.removeEventListener(t,n,Pi)}So&&yi();function Ot(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:xt((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function gc(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var yc=t=>t!=null,wc=t=>t!=null&&t>0,Bs=gc(yc),Wu=gc(wc);function Gu(t,e,n,o=0,s=!1){
let r=s?Wu:Bs,i=s?wc:yc;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(o==1)a=t[e],l=t[n];else if(o==-1)a=t[n],l=t[e];else for(let c=e;c<=n;c++){let h=t[c];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??Me,l??-Me]}function Ws(t,e,n,o){let s=Vl(t),r=Vl(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Qt:bc,a=s==1?xt:Pt,l=r==1?Pt:xt,
c=a(i(Ve(t))),h=l(i(Ve(e))),u=bo(n,c),d=bo(n,h);return n==10&&(c<0&&(u=Te(u,-c)),h<0&&(d=Te(d,-h))),o||n==2?(t=u*s,e=d*r):(t=Sc(t,u),e=Gs(e,d)),[t,e]}function _i(t,e,n,o){
let s=Ws(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ci=.1,Hl={mode:3,pad:Ci},Jo={pad:0,soft:null,mode:0},Hu={min:Jo,max:Jo};function Os(t,e,n,o){return Hs(
n)?jl(t,e,n):(Jo.pad=n,Jo.soft=o?0:null,Jo.mode=o?3:0,jl(t,e,Hu))}function ye(t,e){return t??e}function ju(t,e,n){for(e=ye(e,0),n=ye(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function jl(t,e,n){let o=n.min,s=n.max,r=ye(o.pad,0),i=ye(s.pad,0),a=ye(o.hard,-Me),l=ye(s.hard,Me),c=ye(o.soft,Me),h=ye(s.soft,-Me),
u=ye(o.mode,0),d=ye(s.mode,0),m=e-t,y=Qt(m),M=pt(Ve(t),Ve(e)),b=Qt(M),x=Ve(b-y);(m<1e-24||x>10)&&(m=0,(t==0||e==0)&&(m=1e-24,u==2&&c!=Me&&(r=0),d==2&&h!=-Me&&(i=
0)));let k=m||M||1e3,A=Qt(k),E=bo(10,xt(A)),D=k*(m==0?t==0?.1:1:r),L=Te(Sc(t-D,E/10),24),O=t>=c&&(u==1||u==3&&L<=c||u==2&&L>=c)?c:Me,G=pt(a,L<O&&t>=O?O:Ut(O,L)),
te=k*(m==0?e==0?.1:1:i),X=Te(Gs(e+te,E/10),24),$=e<=h&&(d==1||d==3&&X>=h||d==2&&X<=h)?h:-Me,ee=Ut(l,X>$&&e<=$?$:pt($,X));return G==ee&&G==0&&(ee=100),[G,ee]}var Vu=new Intl.
NumberFormat(So?Uu.language:"en-US"),Li=t=>Vu.format(t),vt=Math,Fs=vt.PI,Ve=vt.abs,xt=vt.floor,je=vt.round,Pt=vt.ceil,Ut=vt.min,pt=vt.max,bo=vt.pow,Vl=vt.sign,Qt=vt.
log10,bc=vt.log2,zu=(t,e=1)=>vt.sinh(t)*e,di=(t,e=1)=>vt.asinh(t/e),Me=1/0;function zl(t){return(Qt((t^t>>31)-(t>>31))|0)+1}function xi(t,e,n){return Ut(pt(t,e),
n)}function xc(t){return typeof t=="function"}function pe(t){return xc(t)?t:()=>t}var Yu=()=>{},vc=t=>t,kc=(t,e)=>e,qu=t=>null,Yl=t=>!0,ql=(t,e)=>t==e,Ku=/\.\d*?(?=9{6,}|0{6,})/gm,
Nn=t=>{if(Tc(t)||un.has(t))return t;let e=`${t}`,n=e.match(Ku);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Nn(
s)}e${r}`}return Te(t,o)};function Pn(t,e){return Nn(Te(Nn(t/e))*e)}function Gs(t,e){return Nn(Pt(Nn(t/e))*e)}function Sc(t,e){return Nn(xt(Nn(t/e))*e)}function Te(t,e=0){
if(Tc(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return je(o)/n}var un=new Map;function Mc(t){return((""+t).split(".")[1]||"").length}function Zo(t,e,n,o){
let s=[],r=o.map(Mc);for(let i=e;i<n;i++){let a=Ve(i),l=Te(bo(t,i),a);for(let c=0;c<o.length;c++){let h=t==10?+`${o[c]}e${i}`:o[c]*l,u=(i>=0?0:a)+(i>=r[c]?0:r[c]),
d=t==10?h:Te(h,u);s.push(d),un.set(d,u)}}return s}var Xo={},Ni=[],xo=[null,null],dn=Array.isArray,Tc=Number.isInteger,Ju=t=>t===void 0;function Kl(t){return typeof t==
"string"}function Hs(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function Xu(t){return t!=null&&typeof t=="object"}var Zu=Object.getPrototypeOf(
Uint8Array),Ac="__proto__";function vo(t,e=Hs){let n;if(dn(t)){let o=t.find(s=>s!=null);if(dn(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=vo(t[s],
e)}else n=t.slice()}else if(t instanceof Zu)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Ac&&(n[o]=vo(t[o],e))}else n=t;return n}function Be(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=Ac&&(Hs(t[s])?Be(t[s],vo(o[s])):t[s]=vo(o[s]))}return t}var Qu=0,ef=1,tf=2;function nf(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function of(t,e){if(af(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return lf(i[0])||(i=rf(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],c=l.length;for(let h=0;h<
c;h++)n.add(l[h])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),d=e?e[i][c]:ef,m=[];for(let y=0;y<h.length;y++){let M=h[y],b=r.get(l[y]);M===null?d!=Qu&&(u[b]=M,
d==tf&&m.push(b)):u[b]=M}nf(u,m,s),o.push(u)}}return o}var sf=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function rf(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[o[l]];s.push(a)}return s}function af(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function lf(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=pt(1,xt((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var Ec=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Pc=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function _c(t){
return t.slice(0,3)}var cf=Pc.map(_c),hf=Ec.map(_c),pf={MMMM:Ec,MMM:hf,WWWW:Pc,WWW:cf};function zo(t){return(t<10?"0":"")+t}function df(t){return(t<10?"00":t<100?
"0":"")+t}var uf={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>zo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>zo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>zo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>zo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>zo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>df(t.getMilliseconds())};function Di(t,e){e=e||pf;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?uf[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var ff=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function mf(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==ff?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var Cc=t=>t%1==0,Us=[1,2,2.5,5],gf=Zo(10,-32,0,Us),Lc=Zo(10,0,32,Us),yf=Lc.filter(
Cc),_n=gf.concat(Lc),Ri=`
`,Nc="{YYYY}",Jl=Ri+Nc,Dc="{M}/{D}",Ko=Ri+Dc,Rs=Ko+"/{YY}",Rc="{aa}",wf="{h}:{mm}",yo=wf+Rc,Xl=Ri+yo,Zl=":{ss}",xe=null;function $c(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,l=(t==1?Zo(10,0,3,Us).filter(Cc):Zo(10,-3,0,Us)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),c=[[i,Nc,xe,xe,xe,xe,xe,xe,1],[s*28,"{MMM}",Jl,xe,xe,xe,xe,xe,1],[s,Dc,Jl,xe,
xe,xe,xe,xe,1],[o,"{h}"+Rc,Rs,xe,Ko,xe,xe,xe,1],[n,yo,Rs,xe,Ko,xe,xe,xe,1],[e,Zl,Rs+" "+yo,xe,Ko+" "+yo,xe,Xl,xe,1],[t,Zl+".{fff}",Rs+" "+yo,xe,Ko+" "+yo,xe,Xl,
xe,1]];function h(u){return(d,m,y,M,b,x)=>{let k=[],A=b>=i,E=b>=r&&b<i,D=u(y),L=Te(D*t,3),O=ui(D.getFullYear(),A?0:D.getMonth(),E||A?1:D.getDate()),G=Te(O*t,3);
if(E||A){let te=E?b/r:0,X=A?b/i:0,$=L==G?L:Te(ui(O.getFullYear()+X,O.getMonth()+te,1)*t,3),ee=new Date(je($/t)),U=ee.getFullYear(),P=ee.getMonth();for(let _=0;$<=
M;_++){let B=ui(U+X*_,P+te*_,1),I=B-u(Te(B*t,3));$=Te((+B+I)*t,3),$<=M&&k.push($)}}else{let te=b>=s?s:b,X=xt(y)-xt(L),$=G+X+Gs(L-G,te);k.push($);let ee=u($),U=ee.
getHours()+ee.getMinutes()/n+ee.getSeconds()/o,P=b/o,_=d.axes[m]._space,B=x/_;for(;$=Te($+b,t==1?0:3),!($>M);)if(P>1){let I=xt(Te(U+P,6))%24,J=u($).getHours()-I;
J>1&&(J=-1),$-=J*o,U=(U+P)%24;let Q=k[k.length-1];Te(($-Q)/b,3)*B>=.7&&k.push($)}else k.push($)}return k}}return[l,c,h]}var[bf,xf,vf]=$c(1),[kf,Sf,Mf]=$c(.001);
Zo(2,-53,53,[1]);function Ql(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function ec(t,e){return(n,o,s,r,i)=>{let a=e.find(
y=>i>=y[0])||e[e.length-1],l,c,h,u,d,m;return o.map(y=>{let M=t(y),b=M.getFullYear(),x=M.getMonth(),k=M.getDate(),A=M.getHours(),E=M.getMinutes(),D=M.getSeconds(),
L=b!=l&&a[2]||x!=c&&a[3]||k!=h&&a[4]||A!=u&&a[5]||E!=d&&a[6]||D!=m&&a[7]||a[1];return l=b,c=x,h=k,u=A,d=E,m=D,L(M)})}}function Tf(t,e){let n=Di(e);return(o,s,r,i,a)=>s.
map(l=>n(t(l)))}function ui(t,e,n){return new Date(t,e,n)}function tc(t,e){return e(t)}var Af="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function nc(t,e){return(n,o,s,r)=>r==
null?Ei:e(t(o))}function Ef(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Pf(t,e){return t.series[e].fill(
t,e)}var _f={show:!0,live:!0,isolate:!1,mount:Yu,markers:{show:!0,width:2,stroke:Ef,fill:Pf,dash:"solid"},idx:null,idxs:null,values:[]};function Cf(t,e){let n=t.
cursor.points,o=Et(),s=n.size(t,e);Ce(o,Yo,s),Ce(o,qo,s);let r=s/-2;Ce(o,"marginLeft",r),Ce(o,"marginTop",r);let i=n.width(t,e,s);return i&&Ce(o,"borderWidth",i),
o}function Lf(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Nf(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Df(t,e){return t.
series[e].points.size}var fi=[0,0];function Rf(t,e,n){return fi[0]=e,fi[1]=n,fi}function $s(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function mi(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var $f={show:!0,x:!0,y:!0,lock:!1,move:Rf,points:{one:!1,show:Cf,size:Df,width:0,stroke:Nf,fill:Lf},bind:{mousedown:$s,mouseup:$s,
click:$s,dblclick:$s,mousemove:mi,mouseleave:mi,mouseenter:mi},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Fc={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},$i=Be({},Fc,{filter:kc}),Ic=Be({},$i,{size:10}),Oc=Be({},Fc,{show:!1}),Fi='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Uc="bold "+Fi,Bc=1.5,oc={
show:!0,scale:"x",stroke:Ai,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Uc,side:2,grid:$i,ticks:Ic,border:Oc,font:Fi,lineGap:Bc,rotate:0},
Ff="Value",If="Time",sc={show:!0,scale:"x",auto:!1,sorted:1,min:Me,max:-Me,idxs:[]};function Of(t,e,n,o,s){return e.map(r=>r==null?"":Li(r))}function Uf(t,e,n,o,s,r,i){
let a=[],l=un.get(s)||0;n=i?n:Te(Gs(n,s),l);for(let c=n;c<=o;c=Te(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function vi(t,e,n,o,s,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,c=l==10?Qt:bc,h=xt(c(n));s=bo(l,h),l==10&&(s=_n[Ot(s,_n)]);let u=n,d=s*l;l==10&&(d=_n[Ot(d,_n)]);do a.push(u),u=u+s,l==10&&!un.has(u)&&(u=Te(u,un.get(
s))),u>=d&&(s=u,d=s*l,l==10&&(d=_n[Ot(d,_n)]));while(u<=o);return a}function Bf(t,e,n,o,s,r,i){let l=t.scales[t.axes[e].scale].asinh,c=o>l?vi(t,e,pt(l,n),o,s):[
l],h=o>=0&&n<=0?[0]:[];return(n<-l?vi(t,e,pt(l,-o),-n,s):[l]).reverse().map(d=>-d).concat(h,c)}var Wc=/./,Wf=/[12357]/,Gf=/[125]/,rc=/1/,ki=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function Hf(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,c=r._space,h=l(10,i),u=l(
9,i)-h>=c?Wc:l(7,i)-h>=c?Wf:l(5,i)-h>=c?Gf:rc;if(u==rc){let d=Ve(l(1,i)-h);if(d<c)return ki(e.slice().reverse(),a.distr,u,Pt(c/d)).reverse()}return ki(e,a.distr,
u,1)}function jf(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,c=Ve(l(1,i)-l(2,i));return c<a?ki(e.slice().reverse(),3,Wc,Pt(a/c)).reverse():e}function Vf(t,e,n,o){
return o==null?Ei:e==null?"":Li(e)}var ic={show:!0,scale:"y",stroke:Ai,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Uc,side:3,grid:$i,ticks:Ic,
border:Oc,font:Fi,lineGap:Bc,rotate:0};function zf(t,e){let n=3+(t||1)*2;return Te(n*e,3)}function Yf(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Ve(i-r),l=t.series[e],c=a/(l.points.space*be);return o[1]-o[0]<=c}var ac={scale:null,auto:!0,sorted:0,min:Me,max:-Me},
Gc=(t,e,n,o,s)=>s,lc={show:!0,auto:!0,sorted:0,gaps:Gc,alpha:1,facets:[Be({},ac,{scale:"x"}),Be({},ac,{scale:"y"})]},cc={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Gc,alpha:1,points:{show:Yf,filter:null},values:null,min:Me,max:-Me,idxs:[],path:null,clip:null};function qf(t,e,n,o,s){return n/10}var Hc={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Kf=Be({},Hc,{time:!1,ori:1}),hc={};function jc(t,e){let n=hc[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,l,c){for(let h=0;h<n.plots.length;h++)n.plots[h]!=s&&n.plots[h].pub(o,s,r,i,a,l,c)}},t!=null&&(hc[t]=
n)),n}var ko=1,Si=2;function Dn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],c=o==2?r[1]:r[e],h=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],u=o==2?i[s.facets[1].scale]:i[s.scale],d=a.left,m=a.top,y=a.width,M=a.height,b=t.valToPosH,x=t.valToPosV;return h.ori==0?n(s,l,c,h,u,b,x,d,
m,y,M,Vs,Mo,Ys,zc,qc):n(s,l,c,h,u,x,b,m,d,M,y,zs,To,Ui,Yc,Kc)}function Ii(t,e){let n=0,o=0,s=ye(t.bands,Ni);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function Jf(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function en(t,e,n,o,s,r){return Dn(t,e,(i,a,l,c,h,u,d,m,y,M,b)=>{let x=i.pxRound,k=c.
dir*(c.ori==0?1:-1),A=c.ori==0?Mo:To,E,D;k==1?(E=n,D=o):(E=o,D=n);let L=x(u(a[E],c,M,m)),O=x(d(l[E],h,b,y)),G=x(u(a[D],c,M,m)),te=x(d(r==1?h.max:h.min,h,b,y)),X=new Path2D(
s);return A(X,G,te),A(X,L,te),A(X,L,O),X})}function js(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?Ys:Ui,l=n;for(let u=0;u<t.length;u++){let d=t[u];
if(d[1]>d[0]){let m=d[0]-l;m>0&&a(i,l,o,m,o+r),l=d[1]}}let c=n+s-l,h=10;c>0&&a(i,l,o-h/2,c,o+r+h)}return i}function Xf(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function Oi(t,e,n,o,s,r,i){let a=[],l=t.length;for(let c=s==1?n:o;c>=n&&c<=o;c+=s)if(e[c]===null){let u=c,d=c;if(s==1)for(;++c<=o&&e[c]===null;)
d=c;else for(;--c>=n&&e[c]===null;)d=c;let m=r(t[u]),y=d==u?m:r(t[d]),M=u-s;m=i<=0&&M>=0&&M<l?r(t[M]):m;let x=d+s;y=i>=0&&x>=0&&x<l?r(t[x]):y,y>=m&&a.push([m,y])}
return a}function pc(t){return t==0?vc:t==1?je:e=>Pn(e,t)}function Vc(t){let e=t==0?Vs:zs,n=t==0?(s,r,i,a,l,c)=>{s.arcTo(r,i,a,l,c)}:(s,r,i,a,l,c)=>{s.arcTo(i,r,
l,a,c)},o=t==0?(s,r,i,a,l)=>{s.rect(r,i,a,l)}:(s,r,i,a,l)=>{s.rect(i,r,l,a)};return(s,r,i,a,l,c=0,h=0)=>{c==0&&h==0?o(s,r,i,a,l):(c=Ut(c,a/2,l/2),h=Ut(h,a/2,l/2),
e(s,r+c,i),n(s,r+a,i,r+a,i+l,c),n(s,r+a,i+l,r,i+l,h),n(s,r,i+l,r,i,h),n(s,r,i,r+a,i,c),s.closePath())}}var Vs=(t,e,n)=>{t.moveTo(e,n)},zs=(t,e,n)=>{t.moveTo(n,e)},
Mo=(t,e,n)=>{t.lineTo(e,n)},To=(t,e,n)=>{t.lineTo(n,e)},Ys=Vc(0),Ui=Vc(1),zc=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},Yc=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},qc=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},Kc=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function Jc(t){return(e,n,o,s,r)=>Dn(e,n,(i,a,l,c,h,u,d,m,y,M,b)=>{let{pxRound:x,
points:k}=i,A,E;c.ori==0?(A=Vs,E=zc):(A=zs,E=Yc);let D=Te(k.width*be,3),L=(k.size-k.width)/2*be,O=Te(L*2,3),G=new Path2D,te=new Path2D,{left:X,top:$,width:ee,height:U}=e.
bbox;Ys(te,X-O,$-O,ee+O*2,U+O*2);let P=_=>{if(l[_]!=null){let B=x(u(a[_],c,M,m)),I=x(d(l[_],h,b,y));A(G,B+L,I),E(G,B,I,L,0,Fs*2)}};if(r)r.forEach(P);else for(let _=o;_<=
s;_++)P(_);return{stroke:D>0?G:null,fill:G,clip:te,flags:ko|Si}})}function Xc(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var Zf=Xc(Mo),Qf=Xc(To);function Zc(t){let e=ye(t?.alignGaps,0);return(n,o,s,r)=>Dn(n,o,(i,a,l,c,h,u,d,m,y,M,b)=>{[s,r]=Bs(l,s,r);let x=i.pxRound,k=U=>x(u(U,c,M,
m)),A=U=>x(d(U,h,b,y)),E,D;c.ori==0?(E=Mo,D=Zf):(E=To,D=Qf);let L=c.dir*(c.ori==0?1:-1),O={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ko},G=O.
stroke,te=!1;if(r-s>=M*4){let U=W=>n.posToVal(W,c.key,!0),P=null,_=null,B,I,ie,K=k(a[L==1?s:r]),J=k(a[s]),Q=k(a[r]),q=U(L==1?J+1:Q-1);for(let W=L==1?s:r;W>=s&&W<=
r;W+=L){let fe=a[W],he=(L==1?fe<q:fe>q)?K:k(fe),ae=l[W];he==K?ae!=null?(I=ae,P==null?(E(G,he,A(I)),B=P=_=I):I<P?P=I:I>_&&(_=I)):ae===null&&(te=!0):(P!=null&&D(G,
K,A(P),A(_),A(B),A(I)),ae!=null?(I=ae,E(G,he,A(I)),P=_=B=I):(P=_=null,ae===null&&(te=!0)),K=he,q=U(K+L))}P!=null&&P!=_&&ie!=K&&D(G,K,A(P),A(_),A(B),A(I))}else for(let U=L==
1?s:r;U>=s&&U<=r;U+=L){let P=l[U];P===null?te=!0:P!=null&&E(G,k(a[U]),A(P))}let[$,ee]=Ii(n,o);if(i.fill!=null||$!=0){let U=O.fill=new Path2D(G),P=i.fillTo(n,o,i.
min,i.max,$),_=A(P),B=k(a[s]),I=k(a[r]);L==-1&&([I,B]=[B,I]),E(U,I,_),E(U,B,_)}if(!i.spanGaps){let U=[];te&&U.push(...Oi(a,l,s,r,L,k,e)),O.gaps=U=i.gaps(n,o,s,r,
U),O.clip=js(U,c.ori,m,y,M,b)}return ee!=0&&(O.band=ee==2?[en(n,o,s,r,G,-1),en(n,o,s,r,G,1)]:en(n,o,s,r,G,ee)),O})}function em(t){let e=ye(t.align,1),n=ye(t.ascDesc,
!1),o=ye(t.alignGaps,0),s=ye(t.extend,!1);return(r,i,a,l)=>Dn(r,i,(c,h,u,d,m,y,M,b,x,k,A)=>{[a,l]=Bs(u,a,l);let E=c.pxRound,{left:D,width:L}=r.bbox,O=J=>E(y(J,d,
k,b)),G=J=>E(M(J,m,A,x)),te=d.ori==0?Mo:To,X={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ko},$=X.stroke,ee=d.dir*(d.ori==0?1:-1),U=G(u[ee==
1?a:l]),P=O(h[ee==1?a:l]),_=P,B=P;s&&e==-1&&(B=D,te($,B,U)),te($,P,U);for(let J=ee==1?a:l;J>=a&&J<=l;J+=ee){let Q=u[J];if(Q==null)continue;let q=O(h[J]),W=G(Q);
e==1?te($,q,U):te($,_,W),te($,q,W),U=W,_=q}let I=_;s&&e==1&&(I=D+L,te($,I,U));let[ie,K]=Ii(r,i);if(c.fill!=null||ie!=0){let J=X.fill=new Path2D($),Q=c.fillTo(r,
i,c.min,c.max,ie),q=G(Q);te(J,I,q),te(J,B,q)}if(!c.spanGaps){let J=[];J.push(...Oi(h,u,a,l,ee,O,o));let Q=c.width*be/2,q=n||e==1?Q:-Q,W=n||e==-1?-Q:Q;J.forEach(
fe=>{fe[0]+=q,fe[1]+=W}),X.gaps=J=c.gaps(r,i,a,l,J),X.clip=js(J,d.ori,b,x,k,A)}return K!=0&&(X.band=K==2?[en(r,i,a,l,$,-1),en(r,i,a,l,$,1)]:en(r,i,a,l,$,K)),X})}
function dc(t,e,n,o,s,r,i=Me){if(t.length>1){let a=null;for(let l=0,c=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=Ve(t[l]-t[a]);h<c&&(c=h,i=Ve(n(t[l],
o,s,r)-n(t[a],o,s,r)))}a=l}}return i}function tm(t){t=t||Xo;let e=ye(t.size,[.6,Me,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==null?[0,0]:typeof s=="number"?[s,
0]:s;let r=pe(s),i=1-e[0],a=ye(e[1],Me),l=ye(e[2],1),c=ye(t.disp,Xo),h=ye(t.each,m=>{}),{fill:u,stroke:d}=c;return(m,y,M,b)=>Dn(m,y,(x,k,A,E,D,L,O,G,te,X,$)=>{let ee=x.
pxRound,U=n,P=o*be,_=a*be,B=l*be,I,ie;E.ori==0?[I,ie]=r(m,y):[ie,I]=r(m,y);let K=E.dir*(E.ori==0?1:-1),J=E.ori==0?Ys:Ui,Q=E.ori==0?h:(V,Se,De,z,se,ue,Ge)=>{h(V,
Se,De,se,z,Ge,ue)},q=ye(m.bands,Ni).find(V=>V.series[0]==y),W=q!=null?q.dir:0,fe=x.fillTo(m,y,x.min,x.max,W),de=ee(O(fe,D,$,te)),he,ae,Fe,We=X,ve=ee(x.width*be),
st=!1,rt=null,Ne=null,Ie=null,_t=null;u!=null&&(ve==0||d!=null)&&(st=!0,rt=u.values(m,y,M,b),Ne=new Map,new Set(rt).forEach(V=>{V!=null&&Ne.set(V,new Path2D)}),
ve>0&&(Ie=d.values(m,y,M,b),_t=new Map,new Set(Ie).forEach(V=>{V!=null&&_t.set(V,new Path2D)})));let{x0:Ct,size:gn}=c;if(Ct!=null&&gn!=null){U=1,k=Ct.values(m,y,
M,b),Ct.unit==2&&(k=k.map(De=>m.posToVal(G+De*X,E.key,!0)));let V=gn.values(m,y,M,b);gn.unit==2?ae=V[0]*X:ae=L(V[0],E,X,G)-L(0,E,X,G),We=dc(k,A,L,E,X,G,We),Fe=We-
ae+P}else We=dc(k,A,L,E,X,G,We),Fe=We*i+P,ae=We-Fe;Fe<1&&(Fe=0),ve>=ae/2&&(ve=0),Fe<5&&(ee=vc);let nn=Fe>0,Wt=We-Fe-(nn?ve:0);ae=ee(xi(Wt,B,_)),he=(U==0?ae/2:U==
K?0:ae)-U*K*((U==0?P/2:0)+(nn?ve/2:0));let qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Jt=st?null:new Path2D,Lt=null;if(q!=null)Lt=m.data[q.
series[1]];else{let{y0:V,y1:Se}=c;V!=null&&Se!=null&&(A=Se.values(m,y,M,b),Lt=V.values(m,y,M,b))}let Gt=I*ae,re=ie*ae;for(let V=K==1?M:b;V>=M&&V<=b;V+=K){let Se=A[V];
if(Se==null)continue;if(Lt!=null){let dt=Lt[V]??0;if(Se-dt==0)continue;de=O(dt,D,$,te)}let De=E.distr!=2||c!=null?k[V]:V,z=L(De,E,X,G),se=O(ye(Se,fe),D,$,te),ue=ee(
z-he),Ge=ee(pt(se,de)),ft=ee(Ut(se,de)),kt=Ge-ft;if(Se!=null){let dt=Se<0?re:Gt,Nt=Se<0?Gt:re;st?(ve>0&&Ie[V]!=null&&J(_t.get(Ie[V]),ue,ft+xt(ve/2),ae,pt(0,kt-ve),
dt,Nt),rt[V]!=null&&J(Ne.get(rt[V]),ue,ft+xt(ve/2),ae,pt(0,kt-ve),dt,Nt)):J(Jt,ue,ft+xt(ve/2),ae,pt(0,kt-ve),dt,Nt),Q(m,y,V,ue-ve/2,ft,ae+ve,kt)}}return ve>0?qe.
stroke=st?_t:Jt:st||(qe._fill=x.width==0?x._fill:x._stroke??x._fill,qe.width=0),qe.fill=st?Ne:Jt,qe})}function nm(t,e){let n=ye(e?.alignGaps,0);return(o,s,r,i)=>Dn(
o,s,(a,l,c,h,u,d,m,y,M,b,x)=>{[r,i]=Bs(c,r,i);let k=a.pxRound,A=I=>k(d(I,h,b,y)),E=I=>k(m(I,u,x,M)),D,L,O;h.ori==0?(D=Vs,O=Mo,L=qc):(D=zs,O=To,L=Kc);let G=h.dir*
(h.ori==0?1:-1),te=A(l[G==1?r:i]),X=te,$=[],ee=[];for(let I=G==1?r:i;I>=r&&I<=i;I+=G)if(c[I]!=null){let K=l[I],J=A(K);$.push(X=J),ee.push(E(c[I]))}let U={stroke:t(
$,ee,D,O,L,k),fill:null,clip:null,band:null,gaps:null,flags:ko},P=U.stroke,[_,B]=Ii(o,s);if(a.fill!=null||_!=0){let I=U.fill=new Path2D(P),ie=a.fillTo(o,s,a.min,
a.max,_),K=E(ie);O(I,X,K),O(I,te,K)}if(!a.spanGaps){let I=[];I.push(...Oi(l,c,r,i,G,A,n)),U.gaps=I=a.gaps(o,s,r,i,I),U.clip=js(I,h.ori,y,M,b,x)}return B!=0&&(U.
band=B==2?[en(o,s,r,i,P,-1),en(o,s,r,i,P,1)]:en(o,s,r,i,P,B)),U})}function om(t){return nm(sm,t)}function sm(t,e,n,o,s,r){let i=t.length;if(i<2)return null;let a=new Path2D;
if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let l=Array(i),c=Array(i-1),h=Array(i-1),u=Array(i-1);for(let d=0;d<i-1;d++)h[d]=e[d+1]-e[d],u[d]=t[d+1]-t[d],c[d]=h[d]/
u[d];l[0]=c[0];for(let d=1;d<i-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(
l[d])||(l[d]=0));l[i-1]=c[i-2];for(let d=0;d<i-1;d++)s(a,t[d]+u[d]/3,e[d]+l[d]*u[d]/3,t[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,t[d+1],e[d+1])}return a}var Mi=new Set;
function uc(){for(let t of Mi)t.syncRect(!0)}So&&(Ln(Iu,wo,uc),Ln(Ou,wo,uc,!0),Ln(Is,wo,()=>{ze.pxRatio=be}));var rm=Zc(),im=Jc();function fc(t,e,n,o){return(o?
[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Ti(r,i,e,n))}function am(t,e){return t.map((n,o)=>o==0?{}:Be({},e,n))}function Ti(t,e,n,o){
return Be({},e==0?n:o,t)}function Qc(t,e,n){return e==null?xo:[e,n]}var lm=Qc;function cm(t,e,n){return e==null?xo:Os(e,n,Ci,!0)}function eh(t,e,n,o){return e==
null?xo:Ws(e,n,t.scales[o].log,!1)}var hm=eh;function th(t,e,n,o){return e==null?xo:_i(e,n,t.scales[o].log,!1)}var pm=th;function dm(t,e,n,o,s){let r=pt(zl(t),zl(
e)),i=e-t,a=Ot(s/o*i,n);do{let l=n[a],c=o*l/i;if(c>=s&&r+(l<5?un.get(l):0)<=17)return[l,c]}while(++a<n.length);return[0,0]}function mc(t){let e,n;return t=t.replace(
/(\d+)px/,(o,s)=>(e=je((n=+s)*be))+"px"),[t,e,n]}function um(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=Te(e[2]*be,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),
e[1]=n})}function ze(t,e,n){let o={mode:ye(t.mode,1)},s=o.mode;function r(p,f,g,w){let v=f.valToPct(p);return w+g*(f.dir==-1?1-v:v)}function i(p,f,g,w){let v=f.
valToPct(p);return w+g*(f.dir==-1?v:1-v)}function a(p,f,g,w){return f.ori==0?r(p,f,g,w):i(p,f,g,w)}o.valToPosH=r,o.valToPosV=i;let l=!1;o.status=0;let c=o.root=
Et(bu);if(t.id!=null&&(c.id=t.id),bt(c,t.class),t.title){let p=Et(ku,c);p.textContent=t.title}let h=It("canvas"),u=o.ctx=h.getContext("2d"),d=Et(Su,c);Ln("click",
d,p=>{p.target===y&&(Ee!=Yn||Le!=qn)&&nt.click(o,p)},!0);let m=o.under=Et(Mu,d);d.appendChild(h);let y=o.over=Et(Tu,d);t=vo(t);let M=+ye(t.pxAlign,1),b=pc(M);(t.
plugins||[]).forEach(p=>{p.opts&&(t=p.opts(o,t)||t)});let x=t.ms||.001,k=o.series=s==1?fc(t.series||[],sc,cc,!1):am(t.series||[null],lc),A=o.axes=fc(t.axes||[],
oc,ic,!0),E=o.scales={},D=o.bands=t.bands||[];D.forEach(p=>{p.fill=pe(p.fill||null),p.dir=ye(p.dir,-1)});let L=s==2?k[1].facets[0].scale:k[0].scale,O={axes:dd,series:ad},
G=(t.drawOrder||["axes","series"]).map(p=>O[p]);function te(p){let f=p.distr==3?g=>Qt(g>0?g:p.clamp(o,g,p.min,p.max,p.key)):p.distr==4?g=>di(g,p.asinh):p.distr==
100?g=>p.fwd(g):g=>g;return g=>{let w=f(g),{_min:v,_max:T}=p,N=T-v;return(w-v)/N}}function X(p){let f=E[p];if(f==null){let g=(t.scales||Xo)[p]||Xo;if(g.from!=null){
X(g.from);let w=Be({},E[g.from],g,{key:p});w.valToPct=te(w),E[p]=w}else{f=E[p]=Be({},p==L?Hc:Kf,g),f.key=p;let w=f.time,v=f.range,T=dn(v);if((p!=L||s==2&&!w)&&(T&&
(v[0]==null||v[1]==null)&&(v={min:v[0]==null?Hl:{mode:1,hard:v[0],soft:v[0]},max:v[1]==null?Hl:{mode:1,hard:v[1],soft:v[1]}},T=!1),!T&&Hs(v))){let N=v;v=(R,F,H)=>F==
null?xo:Os(F,H,N)}f.range=pe(v||(w?lm:p==L?f.distr==3?hm:f.distr==4?pm:Qc:f.distr==3?eh:f.distr==4?th:cm)),f.auto=pe(T?!1:f.auto),f.clamp=pe(f.clamp||qf),f._min=
f._max=null,f.valToPct=te(f)}}}X("x"),X("y"),s==1&&k.forEach(p=>{X(p.scale)}),A.forEach(p=>{X(p.scale)});for(let p in t.scales)X(p);let $=E[L],ee=$.distr,U,P;$.
ori==0?(bt(c,xu),U=r,P=i):(bt(c,vu),U=i,P=r);let _={};for(let p in E){let f=E[p];(f.min!=null||f.max!=null)&&(_[p]={min:f.min,max:f.max},f.min=f.max=null)}let B=t.
tzDate||(p=>new Date(je(p/x))),I=t.fmtDate||Di,ie=x==1?vf(B):Mf(B),K=ec(B,Ql(x==1?xf:Sf,I)),J=nc(B,tc(Af,I)),Q=[],q=o.legend=Be({},_f,t.legend),W=o.cursor=Be({},
$f,{drag:{y:s==2}},t.cursor),fe=q.show,de=W.show,he=q.markers;q.idxs=Q,he.width=pe(he.width),he.dash=pe(he.dash),he.stroke=pe(he.stroke),he.fill=pe(he.fill);let ae,
Fe,We,ve=[],st=[],rt,Ne=!1,Ie={};if(q.live){let p=k[1]?k[1].values:null;Ne=p!=null,rt=Ne?p(o,1,0):{_:0};for(let f in rt)Ie[f]=Ei}if(fe)if(ae=It("table",Lu,c),We=
It("tbody",null,ae),q.mount(o,ae),Ne){Fe=It("thead",null,ae,We);let p=It("tr",null,Fe);It("th",null,p);for(var _t in rt)It("th",Cl,p).textContent=_t}else bt(ae,
Du),q.live&&bt(ae,Nu);let Ct={show:!0},gn={show:!1};function nn(p,f){if(f==0&&(Ne||!q.live||s==2))return xo;let g=[],w=It("tr",Ru,We,We.childNodes[f]);bt(w,p.class),
p.show||bt(w,Cn);let v=It("th",null,w);if(he.show){let R=Et($u,v);if(f>0){let F=he.width(o,f);F&&(R.style.border=F+"px "+he.dash(o,f)+" "+he.stroke(o,f)),R.style.
background=he.fill(o,f)}}let T=Et(Cl,v);p.label instanceof HTMLElement?T.appendChild(p.label):T.textContent=p.label,f>0&&(he.show||(T.style.color=p.width>0?he.stroke(
o,f):he.fill(o,f)),qe("click",v,R=>{if(W._lock)return;wn(R);let F=k.indexOf(p);if((R.ctrlKey||R.metaKey)!=q.isolate){let H=k.some((j,Y)=>Y>0&&Y!=F&&j.show);k.forEach(
(j,Y)=>{Y>0&&jt(Y,H?Y==F?Ct:gn:Ct,!0,Oe.setSeries)})}else jt(F,{show:!p.show},!0,Oe.setSeries)},!1),On&&qe(Rl,v,R=>{W._lock||(wn(R),jt(k.indexOf(p),Jn,!0,Oe.setSeries))},
!1));for(var N in rt){let R=It("td",Fu,w);R.textContent="--",g.push(R)}return[w,g]}let Wt=new Map;function qe(p,f,g,w=!0){let v=Wt.get(f)||{},T=W.bind[p](o,f,g,
w);T&&(Ln(p,f,v[p]=T),Wt.set(f,v))}function Jt(p,f,g){let w=Wt.get(f)||{};for(let v in w)(p==null||v==p)&&(bi(v,f,w[v]),delete w[v]);p==null&&Wt.delete(f)}let Lt=0,
Gt=0,re=0,V=0,Se=0,De=0,z=Se,se=De,ue=re,Ge=V,ft=0,kt=0,dt=0,Nt=0;o.bbox={};let Er=!1,os=!1,In=!1,yn=!1,ss=!1,St=!1;function Pr(p,f,g){(g||p!=o.width||f!=o.height)&&
da(p,f),Hn(!1),In=!0,os=!0,jn()}function da(p,f){o.width=Lt=re=p,o.height=Gt=V=f,Se=De=0,ed(),td();let g=o.bbox;ft=g.left=Pn(Se*be,.5),kt=g.top=Pn(De*be,.5),dt=
g.width=Pn(re*be,.5),Nt=g.height=Pn(V*be,.5)}let Xp=3;function Zp(){let p=!1,f=0;for(;!p;){f++;let g=hd(f),w=pd(f);p=f==Xp||g&&w,p||(da(o.width,o.height),os=!0)}}
function Qp({width:p,height:f}){Pr(p,f)}o.setSize=Qp;function ed(){let p=!1,f=!1,g=!1,w=!1;A.forEach((v,T)=>{if(v.show&&v._show){let{side:N,_size:R}=v,F=N%2,H=v.
label!=null?v.labelSize:0,j=R+H;j>0&&(F?(re-=j,N==3?(Se+=j,w=!0):g=!0):(V-=j,N==0?(De+=j,p=!0):f=!0))}}),bn[0]=p,bn[1]=g,bn[2]=f,bn[3]=w,re-=on[1]+on[3],Se+=on[3],
V-=on[2]+on[0],De+=on[0]}function td(){let p=Se+re,f=De+V,g=Se,w=De;function v(T,N){switch(T){case 1:return p+=N,p-N;case 2:return f+=N,f-N;case 3:return g-=N,g+
N;case 0:return w-=N,w+N}}A.forEach((T,N)=>{if(T.show&&T._show){let R=T.side;T._pos=v(R,T._size),T.label!=null&&(T._lpos=v(R,T.labelSize))}})}if(W.dataIdx==null){
let p=W.hover,f=p.skip=new Set(p.skip??[]);f.add(void 0);let g=p.prox=pe(p.prox),w=p.bias??=0;W.dataIdx=(v,T,N,R)=>{if(T==0)return N;let F=N,H=g(v,T,N,R)??Me,j=H>=
0&&H<Me,Y=$.ori==0?re:V,oe=W.left,we=e[0],ge=e[T];if(f.has(ge[N])){F=null;let ce=null,ne=null,Z;if(w==0||w==-1)for(Z=N;ce==null&&Z-- >0;)f.has(ge[Z])||(ce=Z);if(w==
0||w==1)for(Z=N;ne==null&&Z++<ge.length;)f.has(ge[Z])||(ne=Z);if(ce!=null||ne!=null)if(j){let _e=ce==null?-1/0:U(we[ce],$,Y,0),Re=ne==null?1/0:U(we[ne],$,Y,0),et=oe-
_e,ke=Re-oe;et<=ke?et<=H&&(F=ce):ke<=H&&(F=ne)}else F=ne==null?ce:ce==null?ne:N-ce<=ne-N?ce:ne}else j&&Ve(oe-U(we[N],$,Y,0))>H&&(F=null);return F}}let wn=p=>{W.
event=p};W.idxs=Q,W._lock=!1;let it=W.points;it.show=pe(it.show),it.size=pe(it.size),it.stroke=pe(it.stroke),it.width=pe(it.width),it.fill=pe(it.fill);let Ht=o.
focus=Be({},t.focus||{alpha:.3},W.focus),On=Ht.prox>=0,Un=On&&it.one,Mt=[],Bn=[],Wn=[];function ua(p,f){let g=it.show(o,f);if(g instanceof HTMLElement)return bt(
g,Cu),bt(g,p.class),Kt(g,-10,-10,re,V),y.insertBefore(g,Mt[f]),g}function fa(p,f){if(s==1||f>0){let g=s==1&&E[p.scale].time,w=p.value;p.value=g?Kl(w)?nc(B,tc(w,
I)):w||J:w||Vf,p.label=p.label||(g?If:Ff)}if(Un||f>0){p.width=p.width==null?1:p.width,p.paths=p.paths||rm||qu,p.fillTo=pe(p.fillTo||Jf),p.pxAlign=+ye(p.pxAlign,
M),p.pxRound=pc(p.pxAlign),p.stroke=pe(p.stroke||null),p.fill=pe(p.fill||null),p._stroke=p._fill=p._paths=p._focus=null;let g=zf(pt(1,p.width),1),w=p.points=Be(
{},{size:g,width:pt(1,g*.2),stroke:p.stroke,space:g*2,paths:im,_stroke:null,_fill:null},p.points);w.show=pe(w.show),w.filter=pe(w.filter),w.fill=pe(w.fill),w.stroke=
pe(w.stroke),w.paths=pe(w.paths),w.pxAlign=p.pxAlign}if(fe){let g=nn(p,f);ve.splice(f,0,g[0]),st.splice(f,0,g[1]),q.values.push(null)}if(de){Q.splice(f,0,null);
let g=null;Un?f==0&&(g=ua(p,f)):f>0&&(g=ua(p,f)),Mt.splice(f,0,g),Bn.splice(f,0,0),Wn.splice(f,0,0)}Qe("addSeries",f)}function nd(p,f){f=f??k.length,p=s==1?Ti(p,
f,sc,cc):Ti(p,f,{},lc),k.splice(f,0,p),fa(k[f],f)}o.addSeries=nd;function od(p){if(k.splice(p,1),fe){q.values.splice(p,1),st.splice(p,1);let f=ve.splice(p,1)[0];
Jt(null,f.firstChild),f.remove()}de&&(Q.splice(p,1),Mt.splice(p,1)[0].remove(),Bn.splice(p,1),Wn.splice(p,1)),Qe("delSeries",p)}o.delSeries=od;let bn=[!1,!1,!1,
!1];function sd(p,f){if(p._show=p.show,p.show){let g=p.side%2,w=E[p.scale];w==null&&(p.scale=g?k[1].scale:L,w=E[p.scale]);let v=w.time;p.size=pe(p.size),p.space=
pe(p.space),p.rotate=pe(p.rotate),dn(p.incrs)&&p.incrs.forEach(N=>{!un.has(N)&&un.set(N,Mc(N))}),p.incrs=pe(p.incrs||(w.distr==2?yf:v?x==1?bf:kf:_n)),p.splits=pe(
p.splits||(v&&w.distr==1?ie:w.distr==3?vi:w.distr==4?Bf:Uf)),p.stroke=pe(p.stroke),p.grid.stroke=pe(p.grid.stroke),p.ticks.stroke=pe(p.ticks.stroke),p.border.stroke=
pe(p.border.stroke);let T=p.values;p.values=dn(T)&&!dn(T[0])?pe(T):v?dn(T)?ec(B,Ql(T,I)):Kl(T)?Tf(B,T):T||K:T||Of,p.filter=pe(p.filter||(w.distr>=3&&w.log==10?Hf:
w.distr==3&&w.log==2?jf:kc)),p.font=mc(p.font),p.labelFont=mc(p.labelFont),p._size=p.size(o,null,f,0),p._space=p._rotate=p._incrs=p._found=p._splits=p._values=null,
p._size>0&&(bn[f]=!0,p._el=Et(Au,d))}}function Co(p,f,g,w){let[v,T,N,R]=g,F=f%2,H=0;return F==0&&(R||T)&&(H=f==0&&!v||f==2&&!N?je(oc.size/3):0),F==1&&(v||N)&&(H=
f==1&&!T||f==3&&!R?je(ic.size/2):0),H}let ma=o.padding=(t.padding||[Co,Co,Co,Co]).map(p=>pe(ye(p,Co))),on=o._padding=ma.map((p,f)=>p(o,f,bn,0)),tt,Ke=null,Je=null,
rs=s==1?k[0].idxs:null,Dt=null,Lo=!1;function ga(p,f){if(e=p??[],o.data=o._data=e,s==2){tt=0;for(let g=1;g<k.length;g++)tt+=e[g][0].length}else{e.length==0&&(o.
data=o._data=e=[[]]),Dt=e[0],tt=Dt.length;let g=e;if(ee==2){g=e.slice();let w=g[0]=Array(tt);for(let v=0;v<tt;v++)w[v]=v}o._data=e=g}if(Hn(!0),Qe("setData"),ee==
2&&(In=!0),f!==!1){let g=$;g.auto(o,Lo)?_r():rn(L,g.min,g.max),yn=yn||W.left>=0,St=!0,jn()}}o.setData=ga;function _r(){Lo=!0;let p,f;s==1&&(tt>0?(Ke=rs[0]=0,Je=
rs[1]=tt-1,p=e[0][Ke],f=e[0][Je],ee==2?(p=Ke,f=Je):p==f&&(ee==3?[p,f]=Ws(p,p,$.log,!1):ee==4?[p,f]=_i(p,p,$.log,!1):$.time?f=p+je(86400/x):[p,f]=Os(p,f,Ci,!0))):
(Ke=rs[0]=p=null,Je=rs[1]=f=null)),rn(L,p,f)}let is,Gn,Cr,Lr,Nr,Dr,Rr,$r,Fr,ut;function ya(p,f,g,w,v,T){p??=Nl,g??=Ni,w??="butt",v??=Nl,T??="round",p!=is&&(u.strokeStyle=
is=p),v!=Gn&&(u.fillStyle=Gn=v),f!=Cr&&(u.lineWidth=Cr=f),T!=Nr&&(u.lineJoin=Nr=T),w!=Dr&&(u.lineCap=Dr=w),g!=Lr&&u.setLineDash(Lr=g)}function wa(p,f,g,w){f!=Gn&&
(u.fillStyle=Gn=f),p!=Rr&&(u.font=Rr=p),g!=$r&&(u.textAlign=$r=g),w!=Fr&&(u.textBaseline=Fr=w)}function Ir(p,f,g,w,v=0){if(w.length>0&&p.auto(o,Lo)&&(f==null||f.
min==null)){let T=ye(Ke,0),N=ye(Je,w.length-1),R=g.min==null?Gu(w,T,N,v,p.distr==3):[g.min,g.max];p.min=Ut(p.min,g.min=R[0]),p.max=pt(p.max,g.max=R[1])}}let ba={
min:null,max:null};function rd(){for(let w in E){let v=E[w];_[w]==null&&(v.min==null||_[L]!=null&&v.auto(o,Lo))&&(_[w]=ba)}for(let w in E){let v=E[w];_[w]==null&&
v.from!=null&&_[v.from]!=null&&(_[w]=ba)}_[L]!=null&&Hn(!0);let p={};for(let w in _){let v=_[w];if(v!=null){let T=p[w]=vo(E[w],Xu);if(v.min!=null)Be(T,v);else if(w!=
L||s==2)if(tt==0&&T.from==null){let N=T.range(o,null,null,w);T.min=N[0],T.max=N[1]}else T.min=Me,T.max=-Me}}if(tt>0){k.forEach((w,v)=>{if(s==1){let T=w.scale,N=_[T];
if(N==null)return;let R=p[T];if(v==0){let F=R.range(o,R.min,R.max,T);R.min=F[0],R.max=F[1],Ke=Ot(R.min,e[0]),Je=Ot(R.max,e[0]),Je-Ke>1&&(e[0][Ke]<R.min&&Ke++,e[0][Je]>
R.max&&Je--),w.min=Dt[Ke],w.max=Dt[Je]}else w.show&&w.auto&&Ir(R,N,w,e[v],w.sorted);w.idxs[0]=Ke,w.idxs[1]=Je}else if(v>0&&w.show&&w.auto){let[T,N]=w.facets,R=T.
scale,F=N.scale,[H,j]=e[v],Y=p[R],oe=p[F];Y!=null&&Ir(Y,_[R],T,H,T.sorted),oe!=null&&Ir(oe,_[F],N,j,N.sorted),w.min=N.min,w.max=N.max}});for(let w in p){let v=p[w],
T=_[w];if(v.from==null&&(T==null||T.min==null)){let N=v.range(o,v.min==Me?null:v.min,v.max==-Me?null:v.max,w);v.min=N[0],v.max=N[1]}}}for(let w in p){let v=p[w];
if(v.from!=null){let T=p[v.from];if(T.min==null)v.min=v.max=null;else{let N=v.range(o,T.min,T.max,w);v.min=N[0],v.max=N[1]}}}let f={},g=!1;for(let w in p){let v=p[w],
T=E[w];if(T.min!=v.min||T.max!=v.max){T.min=v.min,T.max=v.max;let N=T.distr;T._min=N==3?Qt(T.min):N==4?di(T.min,T.asinh):N==100?T.fwd(T.min):T.min,T._max=N==3?Qt(
T.max):N==4?di(T.max,T.asinh):N==100?T.fwd(T.max):T.max,f[w]=g=!0}}if(g){k.forEach((w,v)=>{s==2?v>0&&f.y&&(w._paths=null):f[w.scale]&&(w._paths=null)});for(let w in f)
In=!0,Qe("setScale",w);de&&W.left>=0&&(yn=St=!0)}for(let w in _)_[w]=null}function id(p){let f=xi(Ke-1,0,tt-1),g=xi(Je+1,0,tt-1);for(;p[f]==null&&f>0;)f--;for(;p[g]==
null&&g<tt-1;)g++;return[f,g]}function ad(){if(tt>0){let p=k.some(f=>f._focus)&&ut!=Ht.alpha;p&&(u.globalAlpha=ut=Ht.alpha),k.forEach((f,g)=>{if(g>0&&f.show&&(xa(
g,!1),xa(g,!0),f._paths==null)){let w=ut;ut!=f.alpha&&(u.globalAlpha=ut=f.alpha);let v=s==2?[0,e[g][0].length-1]:id(e[g]);f._paths=f.paths(o,g,v[0],v[1]),ut!=w&&
(u.globalAlpha=ut=w)}}),k.forEach((f,g)=>{if(g>0&&f.show){let w=ut;ut!=f.alpha&&(u.globalAlpha=ut=f.alpha),f._paths!=null&&va(g,!1);{let v=f._paths!=null?f._paths.
gaps:null,T=f.points.show(o,g,Ke,Je,v),N=f.points.filter(o,g,T,v);(T||N)&&(f.points._paths=f.points.paths(o,g,Ke,Je,N),va(g,!0))}ut!=w&&(u.globalAlpha=ut=w),Qe(
"drawSeries",g)}}),p&&(u.globalAlpha=ut=1)}}function xa(p,f){let g=f?k[p].points:k[p];g._stroke=g.stroke(o,p),g._fill=g.fill(o,p)}function va(p,f){let g=f?k[p].
points:k[p],{stroke:w,fill:v,clip:T,flags:N,_stroke:R=g._stroke,_fill:F=g._fill,_width:H=g.width}=g._paths;H=Te(H*be,3);let j=null,Y=H%2/2;f&&F==null&&(F=H>0?"#\
fff":R);let oe=g.pxAlign==1&&Y>0;if(oe&&u.translate(Y,Y),!f){let we=ft-H/2,ge=kt-H/2,ce=dt+H,ne=Nt+H;j=new Path2D,j.rect(we,ge,ce,ne)}f?Or(R,H,g.dash,g.cap,F,w,
v,N,T):ld(p,R,H,g.dash,g.cap,F,w,v,N,j,T),oe&&u.translate(-Y,-Y)}function ld(p,f,g,w,v,T,N,R,F,H,j){let Y=!1;F!=0&&D.forEach((oe,we)=>{if(oe.series[0]==p){let ge=k[oe.
series[1]],ce=e[oe.series[1]],ne=(ge._paths||Xo).band;dn(ne)&&(ne=oe.dir==1?ne[0]:ne[1]);let Z,_e=null;ge.show&&ne&&ju(ce,Ke,Je)?(_e=oe.fill(o,we)||T,Z=ge._paths.
clip):ne=null,Or(f,g,w,v,_e,N,R,F,H,j,Z,ne),Y=!0}}),Y||Or(f,g,w,v,T,N,R,F,H,j)}let ka=ko|Si;function Or(p,f,g,w,v,T,N,R,F,H,j,Y){ya(p,f,g,w,v),(F||H||Y)&&(u.save(),
F&&u.clip(F),H&&u.clip(H)),Y?(R&ka)==ka?(u.clip(Y),j&&u.clip(j),ls(v,N),as(p,T,f)):R&Si?(ls(v,N),u.clip(Y),as(p,T,f)):R&ko&&(u.save(),u.clip(Y),j&&u.clip(j),ls(
v,N),u.restore(),as(p,T,f)):(ls(v,N),as(p,T,f)),(F||H||Y)&&u.restore()}function as(p,f,g){g>0&&(f instanceof Map?f.forEach((w,v)=>{u.strokeStyle=is=v,u.stroke(w)}):
f!=null&&p&&u.stroke(f))}function ls(p,f){f instanceof Map?f.forEach((g,w)=>{u.fillStyle=Gn=w,u.fill(g)}):f!=null&&p&&u.fill(f)}function cd(p,f,g,w){let v=A[p],
T;if(w<=0)T=[0,0];else{let N=v._space=v.space(o,p,f,g,w),R=v._incrs=v.incrs(o,p,f,g,w,N);T=dm(f,g,R,w,N)}return v._found=T}function Ur(p,f,g,w,v,T,N,R,F,H){let j=N%
2/2;M==1&&u.translate(j,j),ya(R,N,F,H,R),u.beginPath();let Y,oe,we,ge,ce=v+(w==0||w==3?-T:T);g==0?(oe=v,ge=ce):(Y=v,we=ce);for(let ne=0;ne<p.length;ne++)f[ne]!=
null&&(g==0?Y=we=p[ne]:oe=ge=p[ne],u.moveTo(Y,oe),u.lineTo(we,ge));u.stroke(),M==1&&u.translate(-j,-j)}function hd(p){let f=!0;return A.forEach((g,w)=>{if(!g.show)
return;let v=E[g.scale];if(v.min==null){g._show&&(f=!1,g._show=!1,Hn(!1));return}else g._show||(f=!1,g._show=!0,Hn(!1));let T=g.side,N=T%2,{min:R,max:F}=v,[H,j]=cd(
w,R,F,N==0?re:V);if(j==0)return;let Y=v.distr==2,oe=g._splits=g.splits(o,w,R,F,H,j,Y),we=v.distr==2?oe.map(Z=>Dt[Z]):oe,ge=v.distr==2?Dt[oe[1]]-Dt[oe[0]]:H,ce=g.
_values=g.values(o,g.filter(o,we,w,j,ge),w,j,ge);g._rotate=T==2?g.rotate(o,ce,w,j):0;let ne=g._size;g._size=Pt(g.size(o,ce,w,p)),ne!=null&&g._size!=ne&&(f=!1)}),
f}function pd(p){let f=!0;return ma.forEach((g,w)=>{let v=g(o,w,bn,p);v!=on[w]&&(f=!1),on[w]=v}),f}function dd(){for(let p=0;p<A.length;p++){let f=A[p];if(!f.show||
!f._show)continue;let g=f.side,w=g%2,v,T,N=f.stroke(o,p),R=g==0||g==3?-1:1,[F,H]=f._found;if(f.label!=null){let lt=f.labelGap*R,yt=je((f._lpos+lt)*be);wa(f.labelFont[0],
N,"center",g==2?"top":Ll),u.save(),w==1?(v=T=0,u.translate(yt,je(kt+Nt/2)),u.rotate((g==3?-Fs:Fs)/2)):(v=je(ft+dt/2),T=yt);let kn=xc(f.label)?f.label(o,p,F,H):f.
label;u.fillText(kn,v,T),u.restore()}if(H==0)continue;let j=E[f.scale],Y=w==0?dt:Nt,oe=w==0?ft:kt,we=f._splits,ge=j.distr==2?we.map(lt=>Dt[lt]):we,ce=j.distr==2?
Dt[we[1]]-Dt[we[0]]:F,ne=f.ticks,Z=f.border,_e=ne.show?ne.size:0,Re=je(_e*be),et=je((f.alignTo==2?f._size-_e-f.gap:f.gap)*be),ke=f._rotate*-Fs/180,$e=b(f._pos*be),
mt=(Re+et)*R,at=$e+mt;T=w==0?at:0,v=w==1?at:0;let Tt=f.font[0],Rt=f.align==1?go:f.align==2?ci:ke>0?go:ke<0?ci:w==0?"center":g==3?ci:go,zt=ke||w==1?"middle":g==2?
"top":Ll;wa(Tt,N,Rt,zt);let gt=f.font[1]*f.lineGap,At=we.map(lt=>b(a(lt,j,Y,oe))),$t=f._values;for(let lt=0;lt<$t.length;lt++){let yt=$t[lt];if(yt!=null){w==0?v=
At[lt]:T=At[lt],yt=""+yt;let kn=yt.indexOf(`
`)==-1?[yt]:yt.split(/\n/gm);for(let ct=0;ct<kn.length;ct++){let Wa=kn[ct];ke?(u.save(),u.translate(v,T+ct*gt),u.rotate(ke),u.fillText(Wa,0,0),u.restore()):u.fillText(
Wa,v,T+ct*gt)}}}ne.show&&Ur(At,ne.filter(o,ge,p,H,ce),w,g,$e,Re,Te(ne.width*be,3),ne.stroke(o,p),ne.dash,ne.cap);let Yt=f.grid;Yt.show&&Ur(At,Yt.filter(o,ge,p,H,
ce),w,w==0?2:1,w==0?kt:ft,w==0?Nt:dt,Te(Yt.width*be,3),Yt.stroke(o,p),Yt.dash,Yt.cap),Z.show&&Ur([$e],[1],w==0?1:0,w==0?1:2,w==1?kt:ft,w==1?Nt:dt,Te(Z.width*be,
3),Z.stroke(o,p),Z.dash,Z.cap)}Qe("drawAxes")}function Hn(p){k.forEach((f,g)=>{g>0&&(f._paths=null,p&&(s==1?(f.min=null,f.max=null):f.facets.forEach(w=>{w.min=null,
w.max=null})))})}let cs=!1,Br=!1,No=[];function ud(){Br=!1;for(let p=0;p<No.length;p++)Qe(...No[p]);No.length=0}function jn(){cs||(sf(Sa),cs=!0)}function fd(p,f=!1){
cs=!0,Br=f,p(o),Sa(),f&&No.length>0&&queueMicrotask(ud)}o.batch=fd;function Sa(){if(Er&&(rd(),Er=!1),In&&(Zp(),In=!1),os){if(Ce(m,go,Se),Ce(m,"top",De),Ce(m,Yo,
re),Ce(m,qo,V),Ce(y,go,Se),Ce(y,"top",De),Ce(y,Yo,re),Ce(y,qo,V),Ce(d,Yo,Lt),Ce(d,qo,Gt),h.width=je(Lt*be),h.height=je(Gt*be),A.forEach(({_el:p,_show:f,_size:g,
_pos:w,side:v})=>{if(p!=null)if(f){let T=v===3||v===0?g:0,N=v%2==1;Ce(p,N?"left":"top",w-T),Ce(p,N?"width":"height",g),Ce(p,N?"top":"left",N?De:Se),Ce(p,N?"heig\
ht":"width",N?V:re),wi(p,Cn)}else bt(p,Cn)}),is=Gn=Cr=Nr=Dr=Rr=$r=Fr=Lr=null,ut=1,$o(!0),Se!=z||De!=se||re!=ue||V!=Ge){Hn(!1);let p=re/ue,f=V/Ge;if(de&&!yn&&W.left>=
0){W.left*=p,W.top*=f,Vn&&Kt(Vn,je(W.left),0,re,V),zn&&Kt(zn,0,je(W.top),re,V);for(let g=0;g<Mt.length;g++){let w=Mt[g];w!=null&&(Bn[g]*=p,Wn[g]*=f,Kt(w,Pt(Bn[g]),
Pt(Wn[g]),re,V))}}if(Pe.show&&!ss&&Pe.left>=0&&Pe.width>0){Pe.left*=p,Pe.width*=p,Pe.top*=f,Pe.height*=f;for(let g in zr)Ce(Kn,g,Pe[g])}z=Se,se=De,ue=re,Ge=V}Qe(
"setSize"),os=!1}Lt>0&&Gt>0&&(u.clearRect(0,0,h.width,h.height),Qe("drawClear"),G.forEach(p=>p()),Qe("draw")),Pe.show&&ss&&(hs(Pe),ss=!1),de&&yn&&(vn(null,!0,!1),
yn=!1),q.show&&q.live&&St&&(jr(),St=!1),l||(l=!0,o.status=1,Qe("ready")),Lo=!1,cs=!1}o.redraw=(p,f)=>{In=f||!1,p!==!1?rn(L,$.min,$.max):jn()};function Wr(p,f){let g=E[p];
if(g.from==null){if(tt==0){let w=g.range(o,f.min,f.max,p);f.min=w[0],f.max=w[1]}if(f.min>f.max){let w=f.min;f.min=f.max,f.max=w}if(tt>1&&f.min!=null&&f.max!=null&&
f.max-f.min<1e-16)return;p==L&&g.distr==2&&tt>0&&(f.min=Ot(f.min,e[0]),f.max=Ot(f.max,e[0]),f.min==f.max&&f.max++),_[p]=f,Er=!0,jn()}}o.setScale=Wr;let Gr,Hr,Vn,
zn,Ma,Ta,Yn,qn,Aa,Ea,Ee,Le,sn=!1,nt=W.drag,Xe=nt.x,Ze=nt.y;de&&(W.x&&(Gr=Et(Pu,y)),W.y&&(Hr=Et(_u,y)),$.ori==0?(Vn=Gr,zn=Hr):(Vn=Hr,zn=Gr),Ee=W.left,Le=W.top);let Pe=o.
select=Be({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Kn=Pe.show?Et(Eu,Pe.over?y:m):null;function hs(p,f){if(Pe.show){for(let g in p)Pe[g]=p[g],g in
zr&&Ce(Kn,g,p[g]);f!==!1&&Qe("setSelect")}}o.setSelect=hs;function md(p){if(k[p].show)fe&&wi(ve[p],Cn);else if(fe&&bt(ve[p],Cn),de){let g=Un?Mt[0]:Mt[p];g!=null&&
Kt(g,-10,-10,re,V)}}function rn(p,f,g){Wr(p,{min:f,max:g})}function jt(p,f,g,w){f.focus!=null&&xd(p),f.show!=null&&k.forEach((v,T)=>{T>0&&(p==T||p==null)&&(v.show=
f.show,md(T),s==2?(rn(v.facets[0].scale,null,null),rn(v.facets[1].scale,null,null)):rn(v.scale,null,null),jn())}),g!==!1&&Qe("setSeries",p,f),w&&Fo("setSeries",
o,p,f)}o.setSeries=jt;function gd(p,f){Be(D[p],f)}function yd(p,f){p.fill=pe(p.fill||null),p.dir=ye(p.dir,-1),f=f??D.length,D.splice(f,0,p)}function wd(p){p==null?
D.length=0:D.splice(p,1)}o.addBand=yd,o.setBand=gd,o.delBand=wd;function bd(p,f){k[p].alpha=f,de&&Mt[p]!=null&&(Mt[p].style.opacity=f),fe&&ve[p]&&(ve[p].style.opacity=
f)}let Xt,an,xn,Jn={focus:!0};function xd(p){if(p!=xn){let f=p==null,g=Ht.alpha!=1;k.forEach((w,v)=>{if(s==1||v>0){let T=f||v==0||v==p;w._focus=f?null:T,g&&bd(v,
T?1:Ht.alpha)}}),xn=p,g&&jn()}}fe&&On&&qe($l,ae,p=>{W._lock||(wn(p),xn!=null&&jt(null,Jn,!0,Oe.setSeries))});function Vt(p,f,g){let w=E[f];g&&(p=p/be-(w.ori==1?
De:Se));let v=re;w.ori==1&&(v=V,p=v-p),w.dir==-1&&(p=v-p);let T=w._min,N=w._max,R=p/v,F=T+(N-T)*R,H=w.distr;return H==3?bo(10,F):H==4?zu(F,w.asinh):H==100?w.bwd(
F):F}function vd(p,f){let g=Vt(p,L,f);return Ot(g,e[0],Ke,Je)}o.valToIdx=p=>Ot(p,e[0]),o.posToIdx=vd,o.posToVal=Vt,o.valToPos=(p,f,g)=>E[f].ori==0?r(p,E[f],g?dt:
re,g?ft:0):i(p,E[f],g?Nt:V,g?kt:0),o.setCursor=(p,f,g)=>{Ee=p.left,Le=p.top,vn(null,f,g)};function Pa(p,f){Ce(Kn,go,Pe.left=p),Ce(Kn,Yo,Pe.width=f)}function _a(p,f){
Ce(Kn,"top",Pe.top=p),Ce(Kn,qo,Pe.height=f)}let Do=$.ori==0?Pa:_a,Ro=$.ori==1?Pa:_a;function kd(){if(fe&&q.live)for(let p=s==2?1:0;p<k.length;p++){if(p==0&&Ne)continue;
let f=q.values[p],g=0;for(let w in f)st[p][g++].firstChild.nodeValue=f[w]}}function jr(p,f){if(p!=null&&(p.idxs?p.idxs.forEach((g,w)=>{Q[w]=g}):Ju(p.idx)||Q.fill(
p.idx),q.idx=Q[0]),fe&&q.live){for(let g=0;g<k.length;g++)(g>0||s==1&&!Ne)&&Sd(g,Q[g]);kd()}St=!1,f!==!1&&Qe("setLegend")}o.setLegend=jr;function Sd(p,f){let g=k[p],
w=p==0&&ee==2?Dt:e[p],v;Ne?v=g.values(o,p,f)??Ie:(v=g.value(o,f==null?null:w[f],p,f),v=v==null?Ie:{_:v}),q.values[p]=v}function vn(p,f,g){Aa=Ee,Ea=Le,[Ee,Le]=W.
move(o,Ee,Le),W.left=Ee,W.top=Le,de&&(Vn&&Kt(Vn,je(Ee),0,re,V),zn&&Kt(zn,0,je(Le),re,V));let w,v=Ke>Je;Xt=Me,an=null;let T=$.ori==0?re:V,N=$.ori==1?re:V;if(Ee<0||
tt==0||v){w=W.idx=null;for(let R=0;R<k.length;R++){let F=Mt[R];F!=null&&Kt(F,-10,-10,re,V)}On&&jt(null,Jn,!0,p==null&&Oe.setSeries),q.live&&(Q.fill(w),St=!0)}else{
let R,F,H;s==1&&(R=$.ori==0?Ee:Le,F=Vt(R,L),w=W.idx=Ot(F,e[0],Ke,Je),H=U(e[0][w],$,T,0));let j=-10,Y=-10,oe=0,we=0,ge=!0,ce="",ne="";for(let Z=s==2?1:0;Z<k.length;Z++){
let _e=k[Z],Re=Q[Z],et=Re==null?null:s==1?e[Z][Re]:e[Z][1][Re],ke=W.dataIdx(o,Z,w,F),$e=ke==null?null:s==1?e[Z][ke]:e[Z][1][ke];if(St=St||$e!=et||ke!=Re,Q[Z]=ke,
Z>0&&_e.show){let mt=ke==null?-10:ke==w?H:U(s==1?e[0][ke]:e[Z][0][ke],$,T,0),at=$e==null?-10:P($e,s==1?E[_e.scale]:E[_e.facets[1].scale],N,0);if(On&&$e!=null){let Tt=$.
ori==1?Ee:Le,Rt=Ve(Ht.dist(o,Z,ke,at,Tt));if(Rt<Xt){let zt=Ht.bias;if(zt!=0){let gt=Vt(Tt,_e.scale),At=$e>=0?1:-1,$t=gt>=0?1:-1;$t==At&&($t==1?zt==1?$e>=gt:$e<=
gt:zt==1?$e<=gt:$e>=gt)&&(Xt=Rt,an=Z)}else Xt=Rt,an=Z}}if(St||Un){let Tt,Rt;$.ori==0?(Tt=mt,Rt=at):(Tt=at,Rt=mt);let zt,gt,At,$t,Yt,lt,yt=!0,kn=it.bbox;if(kn!=null){
yt=!1;let ct=kn(o,Z);At=ct.left,$t=ct.top,zt=ct.width,gt=ct.height}else At=Tt,$t=Rt,zt=gt=it.size(o,Z);if(lt=it.fill(o,Z),Yt=it.stroke(o,Z),Un)Z==an&&Xt<=Ht.prox&&
(j=At,Y=$t,oe=zt,we=gt,ge=yt,ce=lt,ne=Yt);else{let ct=Mt[Z];ct!=null&&(Bn[Z]=At,Wn[Z]=$t,Gl(ct,zt,gt,yt),Bl(ct,lt,Yt),Kt(ct,Pt(At),Pt($t),re,V))}}}}if(Un){let Z=Ht.
prox,_e=xn==null?Xt<=Z:Xt>Z||an!=xn;if(St||_e){let Re=Mt[0];Re!=null&&(Bn[0]=j,Wn[0]=Y,Gl(Re,oe,we,ge),Bl(Re,ce,ne),Kt(Re,Pt(j),Pt(Y),re,V))}}}if(Pe.show&&sn)if(p!=
null){let[R,F]=Oe.scales,[H,j]=Oe.match,[Y,oe]=p.cursor.sync.scales,we=p.cursor.drag;if(Xe=we._x,Ze=we._y,Xe||Ze){let{left:ge,top:ce,width:ne,height:Z}=p.select,
_e=p.scales[Y].ori,Re=p.posToVal,et,ke,$e,mt,at,Tt=R!=null&&H(R,Y),Rt=F!=null&&j(F,oe);Tt&&Xe?(_e==0?(et=ge,ke=ne):(et=ce,ke=Z),$e=E[R],mt=U(Re(et,Y),$e,T,0),at=
U(Re(et+ke,Y),$e,T,0),Do(Ut(mt,at),Ve(at-mt))):Do(0,T),Rt&&Ze?(_e==1?(et=ge,ke=ne):(et=ce,ke=Z),$e=E[F],mt=P(Re(et,oe),$e,N,0),at=P(Re(et+ke,oe),$e,N,0),Ro(Ut(mt,
at),Ve(at-mt))):Ro(0,N)}else Yr()}else{let R=Ve(Aa-Ma),F=Ve(Ea-Ta);if($.ori==1){let oe=R;R=F,F=oe}Xe=nt.x&&R>=nt.dist,Ze=nt.y&&F>=nt.dist;let H=nt.uni;H!=null?Xe&&
Ze&&(Xe=R>=H,Ze=F>=H,!Xe&&!Ze&&(F>R?Ze=!0:Xe=!0)):nt.x&&nt.y&&(Xe||Ze)&&(Xe=Ze=!0);let j,Y;Xe&&($.ori==0?(j=Yn,Y=Ee):(j=qn,Y=Le),Do(Ut(j,Y),Ve(Y-j)),Ze||Ro(0,N)),
Ze&&($.ori==1?(j=Yn,Y=Ee):(j=qn,Y=Le),Ro(Ut(j,Y),Ve(Y-j)),Xe||Do(0,T)),!Xe&&!Ze&&(Do(0,0),Ro(0,0))}if(nt._x=Xe,nt._y=Ze,p==null){if(g){if(Ba!=null){let[R,F]=Oe.
scales;Oe.values[0]=R!=null?Vt($.ori==0?Ee:Le,R):null,Oe.values[1]=F!=null?Vt($.ori==1?Ee:Le,F):null}Fo(hi,o,Ee,Le,re,V,w)}if(On){let R=g&&Oe.setSeries,F=Ht.prox;
xn==null?Xt<=F&&jt(an,Jn,!0,R):Xt>F?jt(null,Jn,!0,R):an!=xn&&jt(an,Jn,!0,R)}}St&&(q.idx=w,jr()),f!==!1&&Qe("setCursor")}let ln=null;Object.defineProperty(o,"rec\
t",{get(){return ln==null&&$o(!1),ln}});function $o(p=!1){p?ln=null:(ln=y.getBoundingClientRect(),Qe("syncRect",ln))}function Ca(p,f,g,w,v,T,N){W._lock||sn&&p!=
null&&p.movementX==0&&p.movementY==0||(Vr(p,f,g,w,v,T,N,!1,p!=null),p!=null?vn(null,!0,!0):vn(f,!0,!1))}function Vr(p,f,g,w,v,T,N,R,F){if(ln==null&&$o(!1),wn(p),
p!=null)g=p.clientX-ln.left,w=p.clientY-ln.top;else{if(g<0||w<0){Ee=-10,Le=-10;return}let[H,j]=Oe.scales,Y=f.cursor.sync,[oe,we]=Y.values,[ge,ce]=Y.scales,[ne,Z]=Oe.
match,_e=f.axes[0].side%2==1,Re=$.ori==0?re:V,et=$.ori==1?re:V,ke=_e?T:v,$e=_e?v:T,mt=_e?w:g,at=_e?g:w;if(ge!=null?g=ne(H,ge)?a(oe,E[H],Re,0):-10:g=Re*(mt/ke),ce!=
null?w=Z(j,ce)?a(we,E[j],et,0):-10:w=et*(at/$e),$.ori==1){let Tt=g;g=w,w=Tt}}F&&(f==null||f.cursor.event.type==hi)&&((g<=1||g>=re-1)&&(g=Pn(g,re)),(w<=1||w>=V-1)&&
(w=Pn(w,V))),R?(Ma=g,Ta=w,[Yn,qn]=W.move(o,g,w)):(Ee=g,Le=w)}let zr={width:0,height:0,left:0,top:0};function Yr(){hs(zr,!1)}let La,Na,Da,Ra;function $a(p,f,g,w,v,T,N){
sn=!0,Xe=Ze=nt._x=nt._y=!1,Vr(p,f,g,w,v,T,N,!0,!1),p!=null&&(qe(pi,gi,Fa,!1),Fo(Dl,o,Yn,qn,re,V,null));let{left:R,top:F,width:H,height:j}=Pe;La=R,Na=F,Da=H,Ra=j}
function Fa(p,f,g,w,v,T,N){sn=nt._x=nt._y=!1,Vr(p,f,g,w,v,T,N,!1,!0);let{left:R,top:F,width:H,height:j}=Pe,Y=H>0||j>0,oe=La!=R||Na!=F||Da!=H||Ra!=j;if(Y&&oe&&hs(
Pe),nt.setScale&&Y&&oe){let we=R,ge=H,ce=F,ne=j;if($.ori==1&&(we=F,ge=j,ce=R,ne=H),Xe&&rn(L,Vt(we,L),Vt(we+ge,L)),Ze)for(let Z in E){let _e=E[Z];Z!=L&&_e.from==
null&&_e.min!=Me&&rn(Z,Vt(ce+ne,Z),Vt(ce,Z))}Yr()}else W.lock&&(W._lock=!W._lock,vn(f,!0,p!=null));p!=null&&(Jt(pi,gi),Fo(pi,o,Ee,Le,re,V,null))}function Md(p,f,g,w,v,T,N){
if(W._lock)return;wn(p);let R=sn;if(sn){let F=!0,H=!0,j=10,Y,oe;$.ori==0?(Y=Xe,oe=Ze):(Y=Ze,oe=Xe),Y&&oe&&(F=Ee<=j||Ee>=re-j,H=Le<=j||Le>=V-j),Y&&F&&(Ee=Ee<Yn?0:
re),oe&&H&&(Le=Le<qn?0:V),vn(null,!0,!0),sn=!1}Ee=-10,Le=-10,Q.fill(null),vn(null,!0,!0),R&&(sn=R)}function Ia(p,f,g,w,v,T,N){W._lock||(wn(p),_r(),Yr(),p!=null&&
Fo(Fl,o,Ee,Le,re,V,null))}function Oa(){A.forEach(um),Pr(o.width,o.height,!0)}Ln(Is,wo,Oa);let Xn={};Xn.mousedown=$a,Xn.mousemove=Ca,Xn.mouseup=Fa,Xn.dblclick=Ia,
Xn.setSeries=(p,f,g,w)=>{let v=Oe.match[2];g=v(o,f,g),g!=-1&&jt(g,w,!0,!1)},de&&(qe(Dl,y,$a),qe(hi,y,Ca),qe(Rl,y,p=>{wn(p),$o(!1)}),qe($l,y,Md),qe(Fl,y,Ia),Mi.add(
o),o.syncRect=$o);let ps=o.hooks=t.hooks||{};function Qe(p,f,g){Br?No.push([p,f,g]):p in ps&&ps[p].forEach(w=>{w.call(null,o,f,g)})}(t.plugins||[]).forEach(p=>{
for(let f in p.hooks)ps[f]=(ps[f]||[]).concat(p.hooks[f])});let Ua=(p,f,g)=>g,Oe=Be({key:null,setSeries:!1,filters:{pub:Yl,sub:Yl},scales:[L,k[1]?k[1].scale:null],
match:[ql,ql,Ua],values:[null,null]},W.sync);Oe.match.length==2&&Oe.match.push(Ua),W.sync=Oe;let Ba=Oe.key,qr=jc(Ba);function Fo(p,f,g,w,v,T,N){Oe.filters.pub(p,
f,g,w,v,T,N)&&qr.pub(p,f,g,w,v,T,N)}qr.sub(o);function Td(p,f,g,w,v,T,N){Oe.filters.sub(p,f,g,w,v,T,N)&&Xn[p](null,f,g,w,v,T,N)}o.pub=Td;function Ad(){qr.unsub(
o),Mi.delete(o),Wt.clear(),bi(Is,wo,Oa),c.remove(),ae?.remove(),Qe("destroy")}o.destroy=Ad;function Kr(){Qe("init",t,e),ga(e||t.data,!1),_[L]?Wr(L,_[L]):_r(),ss=
Pe.show&&(Pe.width>0||Pe.height>0),yn=St=!0,Pr(t.width,t.height)}return k.forEach(fa),A.forEach(sd),n?n instanceof HTMLElement?(n.appendChild(c),Kr()):n(o,Kr):Kr(),
o}ze.assign=Be;ze.fmtNum=Li;ze.rangeNum=Os;ze.rangeLog=Ws;ze.rangeAsinh=_i;ze.orient=Dn;ze.pxRatio=be;ze.join=of;ze.fmtDate=Di,ze.tzDate=mf;ze.sync=jc;{ze.addGap=
Xf,ze.clipGaps=js;let t=ze.paths={points:Jc};t.linear=Zc,t.stepped=em,t.bars=tm,t.spline=om}var qs=128,nh=50,fm=.25,mm=t=>[t.ray,t.truth,t.sensor,t.noReturn],gm=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),ym=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),Ks=(t,e)=>({font:Ms,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function oh(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:qs})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:qs}),s=n()),o)}function sh(t,e){let{session:n}=t,o=S("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${nh}`]],()=>s,y=>{s=y,c=null,n.changed()}),
i=0,a=-1/0,l=-1,c=null,u=oh(o,()=>{let y=mm(e()),M=Array.from({length:i},(b,x)=>({label:`chain ${x+1}`,stroke:y[x%y.length],width:1,points:{show:!1}}));return new ze(
{width:100,height:qs,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,ym,0,0],scales:{x:{time:!1,range:(b,x,k)=>[x,Math.max(k,x+1)]},y:{range:(b,x,k)=>vm(
Math.max(x,a),k)}},axes:[Ks(e,26),Ks(e,gm)],series:[{label:"sweep"},...M],hooks:{draw:[b=>Sm(b,l,e()),b=>km(b,c?.burned??0,e())]}},[[],...M.map(()=>[])],o)},e),
d=S("span",{className:"caption",textContent:"log joint by sweep"}),m=S("div",{className:"charted"},S("div",{className:"buttons"},r,d),o);return t.each(()=>{let y=n.
shown,M=y?.traced?.length?y.trace.length/y.traced.length:0;if(C(m,"hidden",M===0&&(m.hidden||!n.working)),!y||!M)return;let b=n.document?.source.kind==="run"?"d\
raw":"sweep";C(d,"textContent",`log joint by ${b}`);let x=y.layer==="draw"&&n.draws.count?(n.draw+1)*y.traced[y.traced.length-1]/n.draws.count:-1,k=u(M!==i&&(i=
M,!0));if(!k||c===y&&l===x&&k.data[0].length)return;[c,l]=[y,x],a=s==="all"?xm(y,M):-1/0;let A=wm(y,M,s);k.setData(A),o.setAttribute("data-sweeps",A[0].join())}),
m}function wm({trace:t,traced:e},n,o){let s=o==="all"?bm(e):[...e.keys()].filter(i=>e[i]<=nh),r=i=>Float32Array.from(s,a=>i[a]);return[r(e),...Array.from({length:n},
(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}function bm(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,o=-1/0;return[...t.keys()].filter(
s=>t[s]<o&&s<e-1?!1:(o=t[s]+n,!0))}function xm({trace:t,traced:e},n){let o=e.length,s=e.findIndex(r=>r>=fm*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.
min(...t.slice(i*o+s,(i+1)*o))))}function vm(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function km(t,e,n){let{left:o,top:s,width:r,height:i}=t.bbox;e&&(t.
ctx.save(),t.ctx.globalAlpha=.12,t.ctx.fillStyle=n.axis,t.ctx.fillRect(o,s,Math.min(r,Math.max(0,t.valToPos(e,"x",!0)-o)),i),t.ctx.restore())}function Sm(t,e,n){
if(e<0)return;let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.
restore())}function rh(t,e){let{session:n}=t,o=S("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),s=S("div",{className:"\
caption",textContent:"particles by weight, nats below the heaviest"}),r=S("div",{className:"charted"},s,o),a=oh(o,()=>new ze({width:100,height:qs,legend:{show:!1},
cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(c,h,u)=>[h,u]},y:{distr:3,range:(c,h,u)=>[.5,Math.max(10,2*u)]}},axes:[Ks(e,26),{...Ks(e,52),values:(c,h)=>h.
map(u=>u>=1?String(u):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:ze.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),l=null;return t.
each(()=>{let c=n.shown;C(r,"hidden",!c?.weights);let h=c?.weights&&a(!1);if(!c?.weights||!h||l===c&&h.data[0].length)return;l=c;let u=[...c.weights],d=-(c.lowest??
-1)/u.length,m=[...u.map((y,M)=>(c.lowest??-1)+M*d),0];h.setData([m,[...u.map(y=>y||null),null]])}),r}function ih(t){let{session:e,hand:n}=t,{decisions:o}=e,s=S("p",{className:"said",role:"status"}),r=S("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,c=>o.set({radius:c}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>o.risk,c=>o.set({risk:c}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{C(l,"textContent",i()),C(s,"textContent",n.tool==="path"?Mm(t):Tm(t))}),a}function Mm({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${me(
o.length_m,2)} m, free with probability ${me(o.probability,3)} ± ${me(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${me(o.independent,
3)}.${r}`}function Tm({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.
nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${me(Math.min(...e.nats),1)} to ${me(o,1)} nats, cells taken for indepen\
dent; the best place has a ring.${s}`}var Am=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Em="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",Pm="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",_m="Shown is what the reading\
s tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (wi\
dth). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Cm="While you edit, the answer is belief pr\
opagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",Lm="This page samples by itself: the answer is that of the chosen method\
 after as many sweeps as are shown, and gets better as they go on.",Nm="The map is made from the scans of this log. Where its poses are raw odometry, Run first \
infers where the robot was; then it samples maps.",Dm="This is a saved run: its draws, and what they say together.",Rm="Mouse: the wheel zooms, the middle butto\
n pans.",$m="Shift or the right button erases, and so does a click on a wall.",Fm="Touch: two fingers zoom and pan.";function ah(t){let{session:e}=t,n=S("div"),
o=tl.map(([i,a,l])=>{let c=S("tr",{},S("th",{scope:"row"},S("kbd",{textContent:i})),S("td",{textContent:a}));return t.visible(c,()=>Im[l??"all"](e)),c}),s=S("p"),
r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?_m:Pm,l=e.editable?[`${Em} ${a}`,e.figure?Lm:Cm]:i==="log"?[a,Nm]:i==="run"?[a,Dm]:[
a];l.join()!==r&&n.replaceChildren(...l.map(c=>S("p",{textContent:c}))),r=l.join(),C(s,"textContent",[Rm,...e.editable?[$m]:[],Fm].join(" "))}),t.dialog("Help",
n,s,S("table",{},S("tbody",{},...o)))}var Im={all:()=>!0,drawn:t=>t.editable,asked:t=>t.answers,located:t=>t.locates,edited:t=>!t.recorded,inferred:t=>!t.recorded&&
t.document?.source.kind!=="run"};function lh(t){let e=()=>S("input",{type:"number",step:1,required:!0,value:"21"}),[n,o]=[e(),e()];for(let i of[n,o])t.bounded(i,
"side");let s=S("select",{});for(let[i,a]of Am){let l=S("option",{value:i,textContent:a});s.append(l),i!=="blank"&&t.visible(l,()=>!t.session.figure)}t.each(()=>t.
session.figure&&C(s,"value","blank")),s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<60&&([n.value,o.value]=["120","80"])});let r=S("for\
m",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),S("div",{className:"buttons end"},S("button",{type:"submit",className:"\
primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),Number(o.value)],world:s.value}),t.hand.
selected=null}),t.dialog("New map",r)}var Om="The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while t\
he server runs; the part from # on can be put after the address of any bayesmap page.",Um="The link holds the walls, the sensors and all settings after its #. T\
he part from # on can be put after the address of any bayesmap page.",Bm="The link holds the file's name and all settings after its #, but no scans and no token\
. It opens in this browser while the server shows this file; the part from # on can be put after the address of any bayesmap page that shows it.";function ch(t){
let e=S("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=S("span",{role:"status",className:"copied"}),o=async()=>{e.select();try{await navigator.clipboard.
writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},s=t.button(null,"Copy the link",o,{className:"\
primary",text:"Copy"}),r=S("p");t.each(()=>C(r,"textContent",t.session.figure?Um:t.session.document?.source.kind==="simulation"?Om:Bm));let i=t.dialog("Share",r,
S("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var Wm=8;function hh(t){let{session:e,hand:n}=t,o=S("p",{className:"words",role:"status"}),s=S("ol",{className:"spoken"}),r=S("p",{className:"words"}),i=S("canv\
as",{className:"trace",width:296,height:48,role:"img"}),a=S("p",{className:"caption"}),l=t.section("Evidence of beams",o,r,s,i,a),c=-1;return t.visible(l,()=>n.
tool==="evidence"),t.each(()=>{let{evidence:h}=e;if(C(o,"textContent",Vm(e)),c===h.version)return;c=h.version,C(r,"textContent",Hm(e));let u=jm(i,h.each?.trace,
e.draws.chains);C(i,"hidden",!u.length),C(a,"textContent",u.length?`Share of draws so far with a wall, by draw: ${u.map((b,x)=>`chain ${x+1} ${b.toFixed(2)}`).join(
", ")}`:"");let{nats:d,scan:m,beam:y}=h.each??{nats:[],scan:[],beam:[]},M=Array.from(d.slice(0,Wm),(b,x)=>S("li",{},`${io(b)} nats: ${Gm(e,m[x],y[x])}`));s.replaceChildren(
...M)}),l}var Gm=({document:t,editable:e},n,o)=>`beam ${o+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function Hm({evidence:{together:t},quantity:e,
hasDraws:n}){if(!t?.beams||e.kind!=="binary"||t.nats_for===null||t.nats_against===null)return"";let{prior_nats:o,log_odds:s,draw:r,nats_for:i,nats_against:a}=t;
if(r==null)return"Each beam is asked by itself, with the other cells as probable as they are: the sum is not the log odds of P(wall)."+(n?" Show one draw for th\
at.":"");if(o==null||s===null||s===void 0)return`Given all other cells of draw ${r+1}.`;let l=1/(1+Math.exp(-s));return`Given all other cells of draw ${r+1}: pr\
ior ${io(o)}, beams ${io(i-a)}, together log odds ${io(s)}: Gibbs draws a wall with probability ${l.toFixed(3)}.`}function jm(t,e,n){let o=e&&n?e.length/n:0,s=o?
t.getContext("2d"):null,r=s&&getComputedStyle(t);return s?.clearRect(0,0,t.width,t.height),Array.from({length:o?n:0},(i,a)=>{let l=0;s?.beginPath();for(let c=0;c<
o;c++)l+=e[a*o+c],s?.lineTo(t.width*(c+.5)/o,2+(t.height-4)*(1-l/(c+1)));return s&&r&&(s.strokeStyle=r.getPropertyValue(a?"--truth":"--ray")||"gray"),s?.stroke(),
l/o})}function Vm({evidence:t,quantity:e}){let{cell:n,together:o}=t;if(!n)return"Click a cell to see which beams speak for what is there (blue) and which agains\
t it (orange), in nats each.";let s=`Cell ${n.x}, ${n.y}`;if(!o)return`${s}: asking its beams.`;if(!o.beams)return`${s}: no beam reaches it.`;let r=o.beams===1?
"1 beam":`${o.beams} beams`;if(o.nats_for===null||o.nats_against===null)return`${s}: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"\
its surface"}[e.kind]??"what is there",a=o.beams_for||o.beams_against?"":" None of them says anything.";return`${s}: ${r}. For ${i} (blue) ${o.beams_for}, ${o.nats_for.
toFixed(1)} nats; against (orange) ${o.beams_against}, ${o.nats_against.toFixed(1)} nats.${a}`}var ph=t=>Math.round(t*180/Math.PI);function dh(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(l,c)=>t.numberInput(l,()=>Number((o.pose?.[c]??0).toFixed(2)),h=>o.move(
{[c]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>ph(o.pose?.yaw??0),l=>o.move({yaw:l*Math.PI/180}),{step:5}),i=S("p",{className:"words ghosted"}),a=t.
section("Ghost",S("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>C(i,"textContent",zm(t))),
a}function zm({session:t}){let{ghost:e}=t;if(e.trouble)return Zt(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(h,u)=>h-o[u]).filter(Number.isFinite).sort((h,u)=>h-u),a=i.length?`${me(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",c=r?` \
Rings are the hits of scan ${r.index+1}, taken ${me(100*r.away,0)} cm from here, turned by ${ph(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${c}`}function uh(t){let{session:e}=t,n=S("span",{className:"what"});t.each(()=>{let{grid:c,source:h}=e.document??{};if(!c||!h)return;let u=`${c.shape[0]} × ${c.shape[1]}\
 cells of ${+c.resolution.toPrecision(3)} m`;C(n,"textContent",h.name?`${h.name}, ${u}`:u)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo,why:"Nothing of this page to undo"}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"\
Redo (Ctrl+Y)",when:()=>!!e.state?.can_redo,why:"Nothing to redo"}),S("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),
...t.embedded?[]:[t.button("link","Share",()=>t.command("share"),{text:"Share",when:o})]];for(let c of s)t.visible(c,()=>!e.recorded);let r=t.button("theme","Th\
eme: automatic",()=>t.command("theme")),i=t.button("help","Help",()=>t.command("help"),{title:"Help (?)"}),a=S("span",{className:"space"});return{element:S("hea\
der",{},S("h1",{textContent:"bayesmap"}),n,a,...s,qm(t),r,i),nameTheme(c){let h=`Theme: ${c}`;ot(r,"aria-label",h),C(r,"title",h)}}}var Ym=({shown:t,draws:e})=>e.
count>0||/importance|propagate/.test(t?.method??"");function qm(t){let{session:e}=t,n=(l,c,h,u,d)=>{let m=t.button(null,l,()=>t.command(`export ${c}`),{text:l,when:u,
why:d});return h!=="all"&&t.visible(m,()=>!e.recorded&&(h==="document"||!e.figure)),m},o=n("Figure that samples by itself (HTML)","figure","server");t.visible(o,
()=>e.editable&&!e.figure);let s=S("div",{className:"menu",hidden:!0},n("Picture (PNG)","png","all"),n("Saved run (netCDF)","run","server",()=>Ym(e),"There are \
no draws yet: chains keep them"),n("Map for robots (YAML and PGM)","map","server"),n("Page in one file (HTML)","html","server"),o,n("Document (JSON)","document",
"document")),r=t.button("save","Export",()=>i(s.hidden),{text:"Export",when:()=>!!e.document}),i=l=>{s.hidden=!l,r.setAttribute("aria-expanded",String(l)),l&&s.
firstElementChild.focus()};i(!1);let a=S("div",{className:"anchor",tabIndex:-1},r,s);return a.addEventListener("keydown",l=>{l.key!=="Escape"||s.hidden||(i(!1),
r.focus(),l.stopPropagation())}),a.addEventListener("focusout",l=>{a.contains(l.relatedTarget)||i(!1)}),s.addEventListener("click",()=>{i(!1),r.focus()}),a}var Km={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function fn(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",Km[t]),e.append(n),e}var Js=({document:t})=>!t||t.source.kind==="simulation",Wi=({answers:t})=>t,fh="surface (zoom in)",mh=[{mark:"truth",text:"true wall",when:Js,may:Js},{mark:"ray",
text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.strokes.
length,may:t=>!Js(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!Js(t)},{mark:"unobserved",text:"unobserved"},{mark:"\
draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Wi},{mark:"\
path",text:"path, as wide as the robot",when:({decisions:t})=>!!(t.path&&t.pathShown),may:Wi}],gh=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 %\
 of a place"}],yh=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function wh(t,e,n){let o=S("p",{className:"sentence"});return t.
each(()=>C(o,"textContent",Jm(t.session))),S("div",{className:"legend"},o,Xm(t,e,n),Zm(t))}var Bi=(t,e)=>`${t.toLocaleString("en")} ${e}${t===1?"":"s"}`;function Jm(t){
let{shown:e,document:n,layer:o,quantity:s,draws:r}=t;if(!e||!n)return"";if(t.where.map)return"The walls as they are drawn: where a scan was taken is asked in a \
known map.";let{kind:i,mean:a,value:l}=s,c=e.verdict?.level!=="bad",h=c?"One map drawn from the posterior":/importance/.test(e.method)?"One particle":"The map o\
f one chain, which has not converged",u={mean:i==="binary"?"How probable a wall is in each cell":Zt(`${a}, cell by cell`),draw:`${h}${i==="binary"?"":`, by its ${l}`}${r.
count?`, ${t.draw+1} of ${r.count}`:""}`,entropy:"How uncertain each cell is, in bits",width:"How wide the 90 % interval of each cell is"}[o];if(e.method==="non\
e")return`${u} before any reading: the prior.`;let{source:d,angles:m,sensors:y,scans_used:M}=n,b=d.kind==="simulation"?`${Bi(m*y.length,"beam")} of ${Bi(y.length,
"sensor")}`:Bi(M??d.scans,"scan"),x=e.method==="propagate"||e.method==="pilot"||/hits|counts/.test(e.method),k=t.stage||t.halfway?"the poses found so far":"raw \
odometry",A=e.method==="counts"?`, by counts along ${k}`:x&&e.approximate?", approximately":o!=="draw"&&e.burned?`, by sweeps ${e.burned+1} to ${e.sweeps}`:"";return`${u}\
, given ${b}${A}${c||o==="draw"?"":", as far as it is known"}.`}function Xm(t,e,n){let{session:o}=t,s=S("span",{className:"ramp"}),r=S("span",{className:"name"}),
i=mh.map(h=>{let[u,d]=Xs(h),{mark:m,when:y}=h;return y&&t.visible(u,()=>y(o)),m==="stroke"&&t.each(()=>C(d,"textContent",Ho(n())?h.text:fh)),m==="path"&&t.each(
()=>u.firstElementChild?.classList.toggle("risky",o.decisions.path?.within_risk===!1)),u}),[a,l]=[gh,yh].map(h=>h.map(u=>Xs(u)[0]));for(let h of a)t.visible(h,()=>!!o.
where.found);for(let h of l)t.visible(h,()=>!!o.evidence.cellShown);let c="";return t.each(()=>{let{layer:h}=o;C(r,"textContent",bh(o,h));let u=h==="entropy"||h===
"width",d=`${u} ${e().ground}`;c!==d&&(c=d,s.style.background=Qr(u?no:m=>Wo(e(),m)))}),S("ul",{"aria-label":"Legend"},S("li",{},r,S("span",{className:"scale"},"\
0",s,"1")),...i,Qm(t),...a,...l)}function Zm(t){let{session:e}=t,n=["mean","draw","entropy","width"].map(c=>{let h=S("span");return t.each(()=>C(h,"textContent",
bh(e,c))),c==="width"&&t.visible(h,()=>e.quantity.interval),h}),o=mh.map(c=>{let[h,u]=Xs(c);c.mark==="stroke"&&(u.textContent=fh);let{may:d}=c;return d&&t.visible(
h,()=>d(e)),h}),s=S("span",{className:"scale"},"00.0",S("span",{className:"ramp"}),"000.0 nats"),r=[gh,yh].map(c=>S("ul",{},...c.map(h=>Xs(h)[0]))),i=[S("ul",{},
S("li",{},"one more scan tells",s)),...r],a=S("li",{className:"either"},...i);t.visible(a,()=>Wi(e));let l=S("span",{className:"scale"},"0",S("span",{className:"\
ramp"}),"1");return S("ul",{className:"room","aria-hidden":"true"},S("li",{},S("span",{className:"name either"},...n),l),...o,a)}function Xs({mark:t,text:e}){let n=S(
"i",{className:t});t==="sensor"&&n.append(fn("sensor"));let o=S("span",{textContent:e});return[S("li",{},n,o),o]}function bh({quantity:t},e){let{kind:n,mean:o,value:s}=t;
return e==="entropy"?"entropy (bit)":e==="width"?"width of the 90 % interval":n==="binary"?"P(wall)":e==="draw"?s:o}function Qm(t){let{decisions:e}=t.session,n=S(
"span",{className:"ramp"});n.style.background=Qr(no);let[o,s]=[S("span"),S("span")],r=S("li",{className:"views"},"one more scan tells",S("span",{className:"scal\
e"},o,n,s));return t.visible(r,()=>e.looking&&!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(C(o,"textContent","0"),C(s,"textContent",`${me(
Math.max(...i),1)} nats`))}),r}var eg=[.05,.1,.2,.4,.8],tg=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function xh(t){let{session:e}=t,n=S("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,c=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...eg,r.resolution])].sort((d,m)=>d-m),[,u]=t.limits("side_of_log");if(o!==`${h} ${u}`){o=`${h} ${u}`;let d=y=>c/y>u-1,m=y=>S(
"option",{value:String(y),textContent:tg(y)+(d(y)?": too many cells":""),disabled:d(y)});n.replaceChildren(...h.map(m))}C(n,"value",String(r.resolution))});let s=t.
row("Cell size",n);return t.visible(s,()=>e.document?.source.kind==="log"),s}function vh(t){let{session:e}=t,n=S("input",{type:"range",min:1,step:1,"aria-label":"\
Scans used"}),o=S("output"),s=()=>e.document?.source.scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=s()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener(
"change",()=>{r(!1),t.endDrag()});let i=t.section("Log",S("div",{className:"player bare"},n,o));return t.visible(i,()=>!e.recorded&&e.document?.source.kind==="l\
og"&&s()>1),t.each(()=>{let a=s(),l=e.document?.scans_used??a;C(n,"max",String(Math.max(1,a))),(!En(n)||Number(n.value)!==l)&&C(n,"value",String(l));let c=l===a?
`all ${a} scans`:`after ${l} of ${a}`;n.style.setProperty("--fill",`${100*(l-1)/Math.max(1,a-1)}%`),ot(n,"aria-valuetext",c),C(o,"textContent",c)}),i}var ng="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",kh=200,
og="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",Sh="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",sg="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function Ah(t){let{session:e}=t,n=S("span",{className:"chip"}),o=t.button(null,"Not converged",()=>Mh(
e)?.apply?.(),{text:"Not converged",className:"chip doubt"}),s=S("div",{className:"chips"},n,o);return t.each(()=>{let r=e.where.map!==null,i=r?null:Mh(e);if(C(
o,"hidden",!i),i){let m=[Vo(e).bad,i.text].filter(Boolean).join(": ");C(o.firstElementChild,"textContent",m.charAt(0).toLowerCase()+m.slice(1)),C(o,"title",`${e.
shown?.verdict?.why}.${i.apply?` Click to ${i.text}.`:""}`),C(o,"disabled",!i.apply),ot(o,"aria-label",m)}let a=e.shown;if(!a||!e.document)return C(s,"hidden",!0);
if(C(s,"hidden",!1),r)return C(n,"textContent","known map: the walls as drawn"),C(n,"className","chip");let l=e.draws.count?`draw ${e.draw+1} of ${e.draws.count}`:
"draw",c=a.layer==="draw"?l+(e.flicker.under?" over the mean":""):a.layer==="width"?"width of the 90 % interval":e.view.layer==="entropy"?"entropy":"mean";if(a.
method==="counts"){let m=e.halfway?"along poses found so far":"along raw odometry";return C(n,"textContent",`hits and passes · ${e.stage?e.stage.text.toLowerCase():
m}`),C(n,"className","chip approximate")}let h={importance:"importance sampling",propagate:"belief propagation",none:"the prior"}[a.method],u=e.document.method===
"importance"&&a.method==="propagate"?", until Run weighs particles":"",d=a.approximate?`approximate, ${rg(a,e.working)}${u}`:h??`${a.sweeps} sweeps`;C(n,"textCo\
ntent",`${c} · ${d}`),C(n,"className",a.approximate?"chip approximate":"chip")}),s}function rg({method:t,sweeps:e,total:n,averaged:o},s){return t==="hits"?"cou\
nts of hits":t!=="pilot"?"belief propagation":`${o===1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} of ${n}`}function Mh(t){
let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n)return null;if(t.recorded||n.source.kind==="run")return{text:""};let o=a=>()=>t.act({type:"set",patch:a}),
s=e.sweeps<kh,r=n.pose_sigma===0&&n.heading_sigma===0;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!s&&r)return{text:"try blocks",apply:o({method:"block"})};
if(e.method==="importance")return{text:"try Gibbs",apply:o({method:"auto"})};if(e.sweeps<e.total)return null;let i=Math.min(t.limits?.sweeps[1]??0,Math.max(kh,4*
n.sweeps));return i>n.sweeps?{text:`try ${i} sweeps`,apply:o({sweeps:i})}:{text:""}}function Eh(t){let{session:e}=t,n=S("span"),o=t.button(null,"Reconnect now",
()=>e.transport.retry?.(),{text:"Reconnect now"}),s=S("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.
connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??0)/1e3));C(s,"hidden",!r&&e.worker!=="restarted"),C(s,"className",r?"banner":"banner mild"),C(o,"hid\
den",!r);let a=`Connection lost. Trying again in ${i} s; the map is kept here.`,l=e.connection.refused?ng:a;C(n,"textContent",r?l:"The worker stopped and is bei\
ng started again. The map is kept.")}),s}function Ph(t){let{session:e,hand:n}=t,o=S("div",{className:"readout",id:`${t.prefix}-readout`}),s=S("span",{role:"stat\
us","aria-live":"polite"}),r=S("span",{className:"hidden","aria-live":"polite"});return n.announce=i=>C(r,"textContent",i),n.describe=i=>Th(e,i),t.each(()=>{let{
kind:i}=e.quantity;C(o,"title",i==="binary"?og:i==="surface"?`${Sh}. ${sg}`:Sh);let a=n.cursor??n.hover,c=matchMedia("(pointer: coarse)").matches?"Touch a cell":
e.editable?"Point at a cell, or press ? for the keys":"Point at a cell";C(o,"textContent",a?Th(e,a):c);let h=e.status.text==="Ready"&&e.shown?.verdict?.level===
"bad"&&!e.where.map,u=e.status.text==="Ready"&&Ns(e),d=e.shown?.method==="importance"?"Ready, but importance sampling has collapsed":"Ready, but the chains have\
 not converged",m=e.everConnected&&!e.connection.connected&&e.status.level==="info";C(s,"textContent",m?"Connection lost":h?d:u?"Fitting the sensor":e.status.text),
C(s,"className",m?"error":h?"warning":u?"busy":e.status.level)}),{element:S("footer",{},s,o,r),readout:o}}function Th(t,e){let{document:n,shown:o}=t;if(!n)return"";
let{resolution:s,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+1),{x:l,y:c}=eo(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${c.
toFixed(a)} m`],{map:u}=t.where;if(u)h.push(u.p[i]?"wall, as drawn":"free, as drawn");else if(o&&o.p.length===r[0]*r[1]){let d=o.p[i]/255,{kind:m,mean:y,value:M,
interval:b}=t.quantity;o.layer==="width"?h.push(`90 % interval ${d.toFixed(2)} wide`):m!=="binary"&&o.layer==="draw"?h.push(`${M} ${d.toFixed(2)} in this draw`):
m!=="binary"?h.push(`${y} ${d.toFixed(2)}`,...b?[]:[`entropy ${Uo(d).toFixed(2)} bit`]):o.layer==="draw"?h.push(d>.5?"wall in this draw":"free in this draw"):h.
push(`P(wall) ${d.toFixed(2)}`,`entropy ${Uo(d).toFixed(2)} bit`);let x=t.evidence.facts,k=x?.x===e.x&&x.y===e.y?x:null,A=k?k.beams:null,E=o.reached[i]/255,D=n.
source.kind==="run";if(E?!D&&E<.995&&h.push(`reached with probability ${E.toFixed(2)}`):h.push(D?"reached by a beam in less than half of the draws":"unobserved"),
E&&A!==null&&h.push(A===1?"1 beam":`${A} beams`),E&&k&&k.nats_for!==null&&k.nats_against!==null&&A){let L={binary:"a wall",surface:"its surface"}[t.quantity.kind]??
"what is there";h.push(`for ${L} ${k.beams_for}, ${k.nats_for.toFixed(1)} nats`,`against ${k.beams_against}, ${k.nats_against.toFixed(1)} nats`)}}return h.join(
" · ")}var ig={logged:"as logged",odometry:"from raw odometry"},ag=180/Math.PI;function _h(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
ig,()=>e.document?.poses??"logged",a=>t.set({poses:a}));o.classList.add("wide"),t.visible(o,n);let s=[t.slider("pose_sigma",()=>"Position ±",{step:.05,unit:" m"}),
t.slider("heading_sigma",()=>"Yaw ±",{step:.5,unit:"°",scale:ag})];for(let a of s)t.visible(a,()=>e.editable);let r=S("p",{className:"caption"});t.each(()=>{let{
pose_sigma:a=0,heading_sigma:l=0,method:c="auto"}=e.document??{},h=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,u=e.editable&&(a>
0||l>0)&&!/auto|gibbs|block/.test(c);C(r,"hidden",!u&&!h),C(r,"textContent",h?"Run infers where the robot was.":"This method takes poses as known; Gibbs does no\
t.")});let i=t.section("Where the robot was",o,...s,r);return t.visible(i,()=>e.editable&&!e.figure||n()&&!e.recorded),i}var Zs=t=>Math.abs(t)<.995?`${me(100*Math.abs(t),1)} cm`:`${me(Math.abs(t),2)} m`,lg="Point at a reading to compare it with what the posterior predicts of it.",
cg=": preparing the comparison. The first one after an installation takes some seconds.";function Ch(t){let{session:e}=t,n=S("p",{className:"words reading",role:"\
status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i,
slow:a}=e.reading,l=s?`Beam ${s.beam+1} of scan ${s.scan+1}${a?cg:"."}`:lg;C(n,"textContent",i||(r?hg(r):l))}),o}function hg({scan:t,beam:e,reading:n,range:o,low:s,
median:r,high:i,residual:a,no_return:l,wall:c}){let h=`Beam ${e+1} of scan ${t+1}`,u=(x,k)=>x===null?k:`${me(x,2)} m`,d=`median ${u(r,"no return")}, 80 % betwee\
n ${u(s,"too close")} and ${u(i,"no return")}`;if(n==="none")return`${h} came back from nothing, which was predicted with probability ${me(l??0,3)} (${d}).`;if(n!==
"hit"||o===null)return`${h} read nothing that says how far (${d}).`;let m=a===null?"":`, ${Zs(a)} ${a<0?"shorter":"longer"} than the predicted median`,y=`${h} r\
ead ${me(o,2)} m${m} (${d}).`;if(!c)return y;let M=`${Zs(c.across_m)} ${c.across_m<0?"behind":"in front of"} the wall, which is ${Zs(c.thickness_m)} thick`,b=`${Zs(
c.along_m)} to the ${c.along_m<0?"right":"left"} along it from the middle of its surface`;return`${y} It ended ${M} (one standard deviation), and ${b}; the beam\
 met it at ${me(c.incidence_rad*180/Math.PI,0)}° from its normal.`}function Gi(t){let e=/^#step=(\d+)$/.exec(t);return e&&Math.max(0,Number(e[1])-1)}var er=t=>`#step=${t+1}`;function Lh(t,e){let n=new Map;e.forEach((r,i)=>{let a=r.
replace(/ \([^)]*\)$/,"");n.has(a)||n.set(a,i)});let o=[...n.keys()].sort((r,i)=>i.length-r.length).map(r=>r.replace(/[^\w ]/g,"\\$&"));return(o.length?t.split(
new RegExp(`\\b(${o.join("|")})(?!\\w)`)):[t]).map((r,i)=>({text:r,at:i%2?n.get(r)??null:null})).filter(r=>r.text)}var Qs=class{constructor(e){this.session=e}story=null;at=0;begins=0;onstep=()=>{};get settled(){
let{state:e,acted:n,working:o,shown:s}=this.session;return!!(s&&e&&e.seq>=n&&!o)}get step(){return this.story?.steps[this.at]??null}get last(){return(this.story?.
steps.length??1)-1}go(e){this.at=Math.min(Math.max(e,0),this.last);let{step:n}=this;n&&(this.begins++,this.bring(n.document),this.session.view.layer!==n.layer&&
this.session.act({type:"view",layer:n.layer}),this.onstep(this.at),this.session.changed())}solve(){this.step?.solution&&this.bring(this.step.solution)}bring(e){
let{session:n}=this;n.state&&!n.state.live&&n.act({type:"live",on:!0}),n.bring(e),n.answers&&e.method==="importance"&&n.act({type:"run"})}};function Dh(t){let{telling:e}=t.session,[n,o,s]=[S("h3"),S("p"),S("p",{className:"task"})],r=S("div",{className:"told","aria-live":"polite"},n,o,s),i=S("nav",{"\
aria-label":"Steps"}),a=m=>()=>e.go(e.at+m),l=S("div",{className:"buttons"},t.button(null,"Back",a(-1),{text:"Back",when:()=>e.at>0,why:"This is the first step"}),
t.button(null,"Next",a(1),{className:"primary",text:"Next",when:()=>e.at<e.last,why:"This is the last step"}),t.button(null,"Start this step again",a(0),{text:"\
Again"})),c=t.button(null,"Show me",()=>e.solve(),{text:"Show me"});t.visible(c,()=>!!e.step?.solution),l.append(c);let h=t.section("Story",i,r,l);h.className="\
story";let u=h.querySelector("h2");t.visible(h,()=>!!e.story);let d=null;return t.each(()=>{let{story:m,step:y,at:M}=e;!m||!y||(d!==m&&i.replaceChildren(...m.steps.
map(({title:b},x)=>{let k=A=>{A.preventDefault(),e.go(x)};return S("a",{href:er(x),title:b,"aria-label":`Step ${x+1}: ${b}`,textContent:String(x+1),onclick:k})})),
d=m,C(u,"textContent",m.title),C(n,"textContent",y.title),C(o,"textContent",y.text),Array.from(i.children).forEach((b,x)=>ot(b,"aria-current",x===M?"step":"fals\
e")))}),pg(t,h,s),h}function pg(t,e,n){let{telling:o}=t.session,s=[],[r,i]=["",""],a=-1,l=!1,c=!1;t.after(()=>{let{step:h,begins:u}=o;if(!h)return;let d=t.named.
filter(({place:x})=>!x.closest("[hidden], dialog")),m=d.map(({name:x})=>x()),y=[h.task,...m].join("|"),M=y===r?null:Lh(h.task,m);if(r=y,M&&JSON.stringify(M)!==i){
i=JSON.stringify(M);for(let{place:x}of s)x.classList.remove("named");s=M.flatMap(({at:x})=>x===null?[]:[d[x]]);for(let{place:x}of s)x.classList.add("named");n.replaceChildren(
...M.map(({text:x,at:k})=>k===null?x:S("button",{type:"button",title:"Go to this control",textContent:x,onclick:()=>{Nh(e,d[k].place),d[k].control.focus({preventScroll:!0})}})))}
let b=e.parentElement;if(b){if(!c)for(let x of["wheel","touchmove","pointerdown","keydown"])b.addEventListener(x,()=>l=!1,{passive:!0});c=!0,a!==u&&(a=u,b.scrollTop=
0,l=!0),l&&(s.length&&Rh(e)&&Nh(e,s[0].place),l=!o.settled)}})}var Rh=t=>getComputedStyle(t).position==="sticky";function Nh(t,e){let n=t.parentElement;if(!n.contains(
e))return;let[o,s]=[n.getBoundingClientRect(),e.getBoundingClientRect()],r=o.top+(Rh(t)?t.getBoundingClientRect().height:0);(s.top<r||s.bottom>o.bottom)&&(n.scrollTop+=
(s.top+s.bottom-r-o.bottom)/2)}var dg={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},ug={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},fg={noisy:"with noise",exact:"exact"},mg={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},gg={raster:"raster",radial:"radial",random:"random"},tr=2*Math.PI,yg=t=>Math.round(t*1800/Math.PI)/10,wg={importance:"Particles",propagate:"Round\
s"};function $h(t){let{session:e,hand:n,editor:o}=t,s=S("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let u=e.document?.sensors??[],d=u.map(m=>m.id).join();d!==r&&s.replaceChildren(...u.map(({id:m})=>S("option",{value:String(
m),textContent:`Sensor ${m}`}))),r=d,C(s,"value",String(n.sensor?.id??""))});let i=(u,d)=>t.numberInput(u,()=>Number((n.sensor?.[d]??0).toFixed(2)),m=>n.sensor&&
o.moveSensor(n.sensor,{[d]:m}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),u=>n.sensor&&o.moveSensor(n.sensor,{yaw:u%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),c=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1,why:"The last sensor stays"});t.visible(a,()=>(e.document?.fov??tr)<tr);let h=S("div",{className:"triple"},i(
"x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",S("div",{className:"buttons"},s,l,c),h)}function Fh(t){let{session:e}=t,n=t.numberInput("Longest range\
 (m)",()=>e.document?.max_range??0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),o=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("\
angles",()=>"Angles",{step:1,log:!0}),n,t.numberInput("Field of view (°)",()=>yg(e.document?.fov??tr),a=>t.set({fov:a>=360?tr:a*Math.PI/180}),{step:5,limits:"f\
ov",scale:180/Math.PI}),t.select("Readings",fg,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of o)t.visible(a,()=>e.editable);let s=t.slider(
"prior",()=>"Prior P(wall)",{step:.01}),r=()=>(e.document?.cells??"binary")==="binary";t.visible(s,r);let i=t.select("Cells",ug,()=>e.document?.cells??"binary",
a=>t.set({cells:a}));return t.visible(i,()=>e.document?.source.kind==="log"),t.section("Model",i,xh(t),s,...o)}function Ih(t){let{session:e}=t,n=()=>e.document?.
method??"auto",o=()=>(e.document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",dg,n,l=>t.set({method:l})),t.select("Order",
gg,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||n()==="auto","Only Gibbs, cell by cell, has an order"),t.select("Start",mg,()=>e.document?.
start??"auto",l=>t.set({start:l}),s,"Only chains have a start")],i=Array.from(r[0].lastElementChild.children);for(let l of i)l.value==="propagate"&&t.visible(l,
()=>!e.figure);for(let l of r)t.visible(l,o);let a=t.slider("burn_in",()=>"Burn-in (%)",{step:5,scale:100});return t.visible(a,()=>s()||!o()),t.section("Inferen\
ce",...r,a,t.slider("sweeps",()=>wg[n()]??"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{step:1,limits:"\
seed"}))}function Oh(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),o=t.button(
null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",S("div",{className:"\
buttons"},n,o))}var bg=0,nr=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${bg++}`;named=[];updates=[];afterwards=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}after(e){this.afterwards.push(e)}refresh(){for(let e of[...this.updates,...this.afterwards])e()}set(e){this.
session.act({type:"set",patch:e})}slide(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){this.session.act({type:"set",patch:{scans_used:e},drag:this.
drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[o,s]=this.session.limits?.[e]??[1,2];return n===1?[o,s]:[Math.ceil(10*o*n-1e-6)/10,Math.floor(
10*s*n+1e-6)/10]}bounded(e,n,o=1,s=0){this.each(()=>{let[r,i]=this.limits(n,o),[a,l]=s?[Math.ceil(r/s-1e-6),Math.floor(i/s+1e-6)]:[r,i],c=h=>String(s?+(h*s).toPrecision(
9):h);C(e,"min",c(a)),C(e,"max",c(l))})}visible(e,n){this.each(()=>C(e,"hidden",!n()))}button(e,n,o,{className:s="",text:r="",when:i,why:a,title:l}={}){let c=()=>typeof l==
"function"?l():l??n,h=S("button",{type:"button",className:s,title:c(),onclick:o},e&&fn(e));return r&&(h.append(S("span",{textContent:r})),this.named.push({name:()=>r,
place:h,control:h})),r!==n&&h.setAttribute("aria-label",n),i&&this.each(()=>{C(h,"disabled",!i());let u=typeof a=="function"?a():a;u&&C(h,"title",h.disabled?u:c())}),
h}segmented(e,n,o,s){let r=`${this.prefix}-${e.replace(/\W/g,"")}`,i=S("div",{className:"segmented",role:"radiogroup","aria-label":e});for(let[a,l,c]of n){let h=S(
"input",{type:"radio",name:r,value:a,onchange:()=>s(a)}),u=S("label",{title:l},h,c?fn(c):null,S("span",{textContent:l}));i.append(u),this.named.push({name:()=>l,
place:u,control:h}),this.each(()=>C(h,"checked",o()===a))}return i}section(e,...n){let o=`${this.prefix}-${e.replace(/\W/g,"")}`;return S("section",{"aria-label\
ledby":o},S("h2",{id:o,textContent:e}),...n)}row(e,n){n.id=`${this.prefix}-${e.replace(/\W/g,"")}`;let o=S("div",{className:"row"},S("label",{for:n.id,textContent:e}),
n);return this.named.push({name:()=>e,place:o,control:n}),o}slider(e,n,{step:o,log:s=!1,unit:r="",scale:i=1}){let a=`${this.prefix}-${e}`,l=()=>this.limits(e,i),
c=b=>{let[x,k]=l();return s?1e3*Math.log(b/x)/Math.log(k/x):b},h=b=>{if(!s)return b;let[x,k]=l(),A=x*(k/x)**(b/1e3),E=A<100?1:10**(Math.floor(Math.log10(A))-1);
return le(Math.round(A/E)*E,x,k)},u=()=>{let b=this.session.document?.[e];return b===void 0?l()[0]:i===1?b:Number((b*i).toFixed(3))},d=S("label",{for:a}),m=S("i\
nput",{type:"range",id:a,...s?{min:0,max:1e3,step:1}:{step:o}}),y=S("input",{type:"number",step:String(o)});s||this.bounded(m,e,i,o),this.bounded(y,e,i),m.addEventListener(
"input",()=>this.slide({[e]:h(Number(m.value))/i})),m.addEventListener("change",()=>this.endDrag()),y.addEventListener("change",()=>this.typed(y,n(),l(),u,b=>this.
set({[e]:s?Math.round(b):b/i}))),this.each(()=>{let b=u();C(d,"textContent",n()),ot(y,"aria-label",`${n()}, number`),h(Number(m.value))!==b&&(m.value=String(c(b))),
ot(m,"aria-valuetext",`${b}${r}`);let x=100*(c(b)-Number(m.min))/(Number(m.max)-Number(m.min));m.style.setProperty("--fill",`${le(x,0,100)}%`),En(y)||C(y,"value",
String(b))});let M=S("div",{className:"row slider"},d,m,y);return this.named.push({name:n,place:M,control:m}),M}select(e,n,o,s,r,i=""){let a=S("select",{onchange:()=>s(
a.value)});for(let[l,c]of Object.entries(n))a.append(S("option",{value:l,textContent:c}));return this.each(()=>{C(a,"value",o()),r&&C(a,"disabled",!r()),i&&C(a,
"title",a.disabled?i:"")}),this.row(e,a)}typed(e,n,[o,s],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(le(a,o,s)),e.value=String(r()),a<o?this.
session.say(`${n} is at least ${o}`,"warning"):a>s&&this.session.say(`${n} is at most ${s}`,"warning")}numberInput(e,n,o,{step:s,limits:r,scale:i}){let a=S("inp\
ut",{type:"number",step:String(s)}),l=()=>r?this.limits(r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,l(),n,o)),this.
each(()=>{En(a)||C(a,"value",String(n()))}),this.row(e,a)}checkbox(e,n,o,s=""){let r=S("input",{type:"checkbox",onchange:()=>o(r.checked)});this.each(()=>C(r,"c\
hecked",n()));let i=S("label",{className:"check",title:s},r,S("span",{textContent:e}));return this.named.push({name:()=>e,place:i,control:r}),i}dialog(e,...n){let o=`${this.
prefix}-dialog-${e.replace(/\W/g,"")}`,s=S("button",{type:"button",className:"plain","aria-label":"Close",onclick:()=>i.close()},fn("close")),r=S("div",{className:"\
title"},S("h2",{id:o,textContent:e}),s),i=S("dialog",{"aria-labelledby":o},r,...n);return i.addEventListener("click",a=>{a.target===i&&i.close()}),i.addEventListener(
"keydown",a=>a.stopPropagation()),i}};var xg=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Qo="There are no draws yet: chains keep them",vg="There is one chain",kg="T\
his device asks that nothing moves by itself",Sg={2:"2 / s",10:"10 / s",30:"30 / s",1e3:"fastest"},or=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){
if(e!=="draw")this.play(!1);else if(!this.session.hasDraws)return;this.before=null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.
session.view.chain){this.session.act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,
e&&s.wantsMean?this.session.act({type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?
0:n),this.session.changed()}over(e){let{flicker:n,view:o}=this.session;n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.
chain})):o.layer!=="draw"&&this.showLayer("draw"):(this.afterMean=!1,this.before&&this.before!==o.layer&&this.showLayer(this.before)),this.before=e?o.layer:null,
this.session.changed()}playFromStart(){this.showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||
this.playing)&&e?.layer==="mean"&&!n.wantsMean)return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.
playing)return;let{draw:o,draws:s}=this.session;o+1>=s.count&&n.on?this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function Uh(t,e,n,o){
let{session:s}=t,r=()=>s.view.layer==="draw"&&!s.hasDraws?"mean":s.view.layer,i=t.segmented("Show",xg,r,M=>e.showLayer(M)),[,a,l,c]=Array.from(i.children);C(c,"\
title","Width of each cell's 90 % interval"),t.visible(l,()=>!s.quantity.interval),t.visible(c,()=>s.quantity.interval&&!s.lacks.includes("width")),t.visible(a,
()=>s.hasDraws);let h=(M,b)=>t.checkbox(M,()=>n[b],x=>{n[b]=x,s.changed()}),u=h("True walls","truth");t.visible(u,()=>!s.document||s.document.source.kind==="sim\
ulation");let[d,m]=[h("Surfaces","strokes"),h("Trajectory","trajectory")];t.visible(d,()=>!!s.overlay?.strokes.length),t.each(()=>C(d.lastElementChild,"textCont\
ent",Ho(o())?"Surfaces":"Surfaces (zoom in)")),t.visible(m,()=>!!s.overlay?.trajectory.length);let y=S("div",{className:"checks",role:"group","aria-label":"Mark\
s"},u,h("Rays","rays"),h("Readings","readings"),d,m);return t.section("View",i,Mg(t,e),y)}function Mg(t,e){let{session:n}=t,o=S("input",{type:"range",min:0,step:1,
"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.button("play","Play the draws",()=>e.play(!e.playing),
{when:()=>n.draws.count>1,why:Qo}),r=S("output"),i=S("select",{"aria-label":"Chain"});i.addEventListener("change",()=>e.showDraw(n.draw,Number(i.value))),t.each(
()=>{let{chains:d,count:m}=n.draws;C(o,"max",String(Math.max(0,m-1))),C(o,"disabled",m===0),C(o,"title",m?"":Qo),C(o,"value",String(n.draw));let y=m?`${n.draw+1}\
 of ${m}`:"none kept";ot(o,"aria-valuetext",y),o.style.setProperty("--fill",`${m>1?100*n.draw/(m-1):0}%`),C(r,"textContent",y),i.length!==Math.max(1,d)&&i.replaceChildren(
...Array.from({length:Math.max(1,d)},(b,x)=>S("option",{value:String(x),textContent:`chain ${x+1}`}))),C(i,"value",String(n.view.chain)),C(i,"disabled",d<2),C(i,
"title",d>1?"":m?vg:Qo),m<2&&e.playing&&e.play(!1);let M=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";s.getAttribute("aria-label")!==
M&&(s.setAttribute("aria-label",M),s.replaceChildren(fn(e.playing?"pause":"play")))});let a=S("select",{"aria-label":"Speed"});for(let[d,m]of Object.entries(Sg))
a.append(S("option",{value:d,textContent:m}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(
null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1,why:Qo});t.each(()=>{C(a,"disabled",n.draws.count<2||n.flicker.
still),C(a,"title",n.draws.count<2?Qo:n.flicker.still?kg:"")});let c=t.checkbox("Draws over the mean",()=>n.flicker.on,d=>e.over(d),"Each draw in its own colour\
 over the mean, as one of the maps that the scans leave possible");t.visible(c,()=>n.draws.count>1);let h=S("div",{className:"wide"},c),u=S("div",{className:"pl\
ayer"},s,o,r,S("div",{className:"buttons wide"},i,a,l),h);return t.visible(u,()=>n.hasDraws),u}function Bh(t){let{session:e}=t,n=S("input",{type:"range",min:0,step:1,
"aria-label":"Scan number"}),o=S("output");n.addEventListener("input",()=>e.act({type:"scan",index:Number(n.value)}));let s=t.section("Scan",S("div",{className:"\
player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulation"?0:e.document?.source.scans??0;C(s,"hidden",r<2),C(n,"max",String(Math.max(0,
r-1))),En(n)||C(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",`${100*Number(n.value)/Math.max(1,r-1)}%`),C(o,"textContent",`${Number(n.value)+
1} / ${r}`)}),s}var Gh=2,Wh=6,Tg=.9,Ag=.5,Eg=.005;function Hh(t){let{session:e,hand:n}=t,o=S("p",{className:"whereabouts",role:"status"}),s=S("p",{className:"caption"}),r=t.section(
"Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),C(o,"textContent",Pg(t)),C(s,"textCo\
ntent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, which the map shows, as if nothing were known of its pose.":"Choose a sca\
n below: it is located in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function Pg({session:t}){let{found:e,trouble:n}=t.
where;if(n)return`${n.charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>Ag?`The scan fits nowhere on this map, with proba\
bility ${e.p_lost.toFixed(2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>Eg?` That it is lost, or the map outdated, ha\
s probability ${e.p_lost.toFixed(2)}.`:"";return`${o}${_g(e.modes)}${Cg(e,t.editable)}${s}`}function _g(t){let[e,n]=t;if(!e)return"No place.";let o=e.sigma_m>Gh,
s=`${e.mean[0].toFixed(2)}, ${e.mean[1].toFixed(2)} m, heading ${Hi(e.mean[2],0)}`,r=`known to ${ji(e.sigma_m)} and ${Hi(e.sigma_rad,1)}`;if(!n)return o?`It may\
 be almost anywhere: positions are ${ji(e.sigma_m)} apart.`:`One place: ${s}, ${r}.`;let i=t.slice(0,Wh).map(({probability:c})=>si(c)),a=n.probability>Tg*e.probability,
l=t.length>Wh?" and less":"";return`${t.length} places: ${i.join(", ")}${l}. ${a?"One of them":"The likeliest"}: ${s}, ${r}.`}function Cg({modes:t,pose:e},n){if(!t.
length||t[0].sigma_m>Gh)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-
e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the likeliest":`the ${Lg(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${ji(o[s])} and\
 ${Hi(r,1)} from ${i}.`}var Lg=t=>`${t}${["th","st","nd","rd"][t%100>10&&t%100<14?0:t%10]??"th"}`,Hi=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,
"")}°`,ji=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(0)} cm`:`${t.toFixed(1)} m`;var Ao="recording";function jh(t,e,n,{kept:o}){let{shown:s,status:r}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:s&&{generation:s.generation,layer:t.layer,
approximate:s.approximate,sweeps:s.sweeps,method:s.method,quantity:t.quantity,rhat:s.rhat,verdict:s.verdict,trace:s.trace,traced:s.traced,weights:s.weights,ess:s.
ess,chain:s.chain,draw:s.draw},probability:s?.p??new Uint8Array(0),reached:s?.reached??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,
status:{text:r.text,level:r.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.
viewTrouble},where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:Dg(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.
trouble},evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&Ng(t.evidence.each)},over:!!t.flicker.under,beside:o&&{layer:o.layer,
chain:o.view.chain,draw:o.draw,method:o.shown?.method,probability:Array.from(o.shown?.p??[])},overlay:t.overlay&&{strokes:t.overlay.strokes.length/5,trajectory:t.
overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??0},events:{...t.counts,eventToPaint_ms:t.
latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var Ng=t=>Object.fromEntries(Object.entries(t).map(([e,n])=>[e,Array.from(n)]));function Dg({
ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.near&&{...o.near}}}}var Vi=new Set(["walls","move_sensor","set","view","live"]),Vh=({type:t})=>!Vi.has(t),zh="Not while the connection is lost: this needs the server";function Yh(t,e){
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
...i}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.each=n.nats?n:null,this.version++)}};var $g="(prefers-reduced-motion: reduce)",ir=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia($g).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var Fg=2e3,Ig=3e3,Og=2,ar=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&Mn(e,n.document.
grid);(!o||!qt(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
!e.answers||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>Fg&&(this.waiting=0),this.waiting>=Og)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Ig;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:c}=n,{x:h,y:u,yaw:d,generation:m,draws:y,coarse:M,milliseconds:b}=e,x=e.near&&{...e.near,pose:a,ranges:l,hit:c};this.fan={x:h,y:u,yaw:d,generation:m,draws:y,
coarse:M,milliseconds:b,angles:o,low:s,median:r,high:i,near:x},this.answers++}else this.fan=null;this.version++,this.ask()}};var lr=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
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
[c,h]=[-1,1/0];for(let u=0;u<n.length;u++){let[d,m]=[Math.cos(e[2]+n[u]),Math.sin(e[2]+n[u])],[y,M]=[r.x-l.x,r.y-l.y],b=y*d+M*m,x=s[u]?o[u]:a,k=s[u]?Math.hypot(
y-x*d,M-x*m):1/0,A=b>0&&b<x?Math.abs(y*m-M*d):1/0,E=Math.min(k,i/2+2*A);E<h&&([c,h]=[u,E])}return h<i?{scan:t,beam:c,from:l,angle:e[2]+n[c]}:null}var pr=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;known=null;knownVersion=-1;asked="";waitingSince=0;follow(e,n){
this.sensor=n,e!==this.wanted&&(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.
ask()}get map(){let{shown:e,editable:n,walls:o,wallsVersion:s}=this.session;return!this.wanted||!n||!e?null:((!this.known||this.knownVersion!==s)&&(this.known={
...e,layer:"mean",p:o.map(r=>255*r),reached:new Uint8Array(o.length).fill(255)},this.knownVersion=s),this.known)}receive(e,n){if(this.waitingSince=0,!this.wanted)
return;this.trouble=e.trouble;let{pose:o,weight:s}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,cloud:o,weight:s},
this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||!e.locates||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;let s=e.editable?
"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.asked||this.waitingSince&&i-this.waitingSince<
5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var qh=new Set(["inspect","path","views","where","ghost","beam"]),Eo=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
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
acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&this.everConnected&&!qh.has(e.type)&&Vh(e))return this.
say(zh,"warning");if(e.type==="run"&&this.nothingToRun)return this.say(this.nothingToRun);let o={...e,seq:++this.seq};qh.has(e.type)||(this.acted=this.seq),Vi.has(
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
status":this.status.say(e.text,e.level,this.acted);break;case"error":this.receiveRefusal(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"\
download":this.ondownload(e.name,e.mime,n.data),this.status.say(e.name===Ao?"Kept beside":`Saved ${e.name}${e.note&&`, ${e.note}`}`,"info",this.acted);break}this.
changed()}receiveScan({ids:e,index:n},{pose:o,angles:s,ranges:r,exact:i,hit:a}){this.scan?.index!==n&&this.reading.forget(),this.scan={ids:e,index:n,pose:o,angles:s,
ranges:r,exact:i,hit:a}}receiveRefusal({seq:e,text:n,remedy:o}){let s=e!==null&&e===this.broughtAt;s&&(this.broughtAt=null,this.act({type:"hello"}));let r=[n,o].
filter(Boolean).join("; ");this.status.say(s?`The map that was brought along cannot be shown: ${r}`:r,"error",this.acted),this.pending=this.pending.filter(i=>i.
seq!==e),e!==null&&this.latency.refused(e),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.
overlay=null,bl()),this.generation=Math.max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.
seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,
a=this.next??this.shown,l=n.reached,c=a&&a.p.length===o.length&&a.reached.every((h,u)=>h===l[u])?a.reached:l;this.next={...e,p:o,trace:s,traced:r,weights:i,reached:c},
this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==s.text||s.walls.
length!==n*o)&&(this.confirmedWalls={text:e.walls,walls:wt(ht(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==s||
this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,
draw:a}=this.state.view;this.view={layer:r,chain:i??0,draw:a}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Yh(this,e),e.type===
"walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var dr=class{constructor(e){this.main=e}kept=null;draws={chains:0,count:0,kept:0};keep(){let{transport:e}=this.main;if(!e.record)return this.main.act({type:"exp\
ort",what:Ao});let n=e.record();n&&this.receive(n),this.main.changed()}forget(){this.kept=null,this.main.changed()}receive(e){this.draws=e[0].draws;let n=us(e);
this.kept=new Eo(n,this.main.changed),n.open()}follow(){let{kept:e,main:n,draws:o}=this;if(!e)return;let{layer:s,chain:r}=n.view,i=Math.max(0,Math.min(r,o.chains-
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
button.chip.doubt { height: auto; min-height: 26px; opacity: 1; background: var(--bad); color: var(--card); border-color: transparent; font-weight: 600; pointer\
-events: auto; }
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
`;var Zh="bayesmap-theme",Xh={auto:"light",light:"dark",dark:"auto"},ur=class{constructor(e,n){this.app=e;this.dressed=n;let o=Gg();o&&o in Xh&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=ks.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?ks.dark:ks.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:c,ghost:h,belief:u}=n;for(let[d,m]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:l,draw:c,ghost:h,belief:u}))this.
app.style.setProperty(`--${d}`,m);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Xh[this.choice];try{localStorage.setItem(Zh,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function Gg(){try{return localStorage.getItem(Zh)}catch{return null}}var Qh=12;function es(t,e,{embedded:n=!1,adopt:o=null,notice:s=null,play:r}={}){let i=t.shadowRoot??t.attachShadow({mode:"open"}),a=new CSSStyleSheet;a.replaceSync(
Kh+Jh),i.adoptedStyleSheets=[a],t.toggleAttribute("data-embedded",n);let l=0,c=()=>{l||=requestAnimationFrame(Wt)},h=new Eo(e,c,o,s);e.open();let u=new to,d=new gs(
h),m=new ms(h,d),y=new or(h),M=new dr(h),b=new nr(h,d,m,Gt,z=>y.showLayer(z),n),x=[new ao,new co,new uo,new po,new _s,new Es,new ho,new ro,new mo,new lo,new As],
k=x.map(({name:z})=>S("canvas",{className:z})),A=k[k.length-1];Object.assign(A,{tabIndex:0,role:"application"});let E=new Go(x,k);new Ts(A,h,u,d,m,n);let D=new bs(
A,h,u,d,m),L={truth:!0,rays:!0,readings:!0,strokes:!0,trajectory:!0},O=uh(b),G=Tl(b),te={chip:Ah(b),banner:Eh(b)},X=ri(),$=X.map(({name:z})=>S("canvas",{className:z})),
ee=new Go(X,$),U=_l(b,M),P=S("div",{className:"beside"},...$,U.kept),_=S("main",{className:"stage"},...k,U.now,te.chip,te.banner,P),B=()=>rt.theme,I=()=>u.transform.
scale,ie=wh(b,B,I),K=Ph(b);A.setAttribute("aria-describedby",K.readout.id);let J=ch(b),Q={help:ah(b),new:lh(b),share:J.dialog},[q,W,fe,de]=[$h(b),Fh(b),Ih(b),Oh(
b)],he=Uh(b,y,L,I);he.append(Pl(b,M));let ae=[Dh(b),ih(b),Hh(b),dh(b),hh(b),vh(b),Al(b,sh(b,B),rh(b,B)),Bh(b),Ch(b),he,q,W,_h(b),fe,de],Fe=S("aside",{"aria-labe\
l":"Controls"},...ae),We=()=>h.recorded||h.document?.source.kind==="run";b.visible(q,()=>h.editable),b.visible(W,()=>!We()),b.visible(fe,()=>!We()),b.visible(de,
()=>!We());let ve=d.tool;b.each(()=>{ve!==d.tool&&(Fe.scrollTop=0),ve=d.tool,C(G,"inert",!h.document),C(Fe,"inert",!h.document)});let st=S("div",{className:"app"},
O.element,G,_,ie,Fe,K.element,...Object.values(Q));i.replaceChildren(st),st.addEventListener("pointerdown",({pointerType:z,clientX:se,clientY:ue})=>{let Ge=i.elementFromPoint(
se,ue)?.closest(":disabled");z==="touch"&&Ge?.title&&h.say(Ge.title)});let rt=new ur(st,z=>{O.nameTheme(z),c()}),Ne=()=>{let z=h.editable&&d.tool==="sensor"?d.sensor?.
id??null:null;return{session:h,view:u,look:{theme:rt.theme,...L,hover:d.hover,cursor:d.cursor,selected:z}}},{telling:Ie}=h,_t=()=>{Ie.step&&d.choose(Ie.step.tool)};
Ie.onstep=z=>{_t(),n||history.replaceState(null,"",location.pathname+location.search+er(z))};let Ct=!1;function gn(){Ct=!0;let z=n||o?null:Gi(location.hash);Ie.
story&&z!==null?Ie.go(z):_t()}let nn="";function Wt(){l=0;let z=h.take();h.document&&!Ct&&gn(),h.document&&String(h.shape)!==nn&&(nn=String(h.shape),M.kept&&String(
M.kept.shape)!==nn&&M.forget(),u.fit(h.shape),d.cursor=d.hover=null,h.decisions.forget(),h.evidence.forget(),h.ghost.refit(),A.setAttribute("aria-label",`Map, ${h.
shape[0]} by ${h.shape[1]} cells`)),P.hidden===!!M.kept&&qe(),E.paint(Ne()),M.follow(),M.kept&&ee.paint({...Ne(),session:M.kept}),z&&(h.painted(),y.step());let{
x:se,y:ue}=u.transform;te.chip.style.transform=`translate(${Math.max(se,He.left)}px, ${Math.max(ue-28,6)}px)`,ot(A,"data-tool",h.editable||Ft.has(d.tool)?d.tool:
"pan"),b.refresh()}function qe(){let{width:z,height:se}=_.getBoundingClientRect();if(!z||!se)return!1;P.hidden=!M.kept;let ue=se>z;_.classList.toggle("shared",!P.
hidden),_.classList.toggle("tall",ue);let Ge=P.hidden?1:.5;return u.resize(ue?z:Ge*z,ue?Ge*se:se,devicePixelRatio||1),u.fitted&&u.fit(h.shape),!0}let Jt=new ResizeObserver(
()=>{qe()&&(cancelAnimationFrame(l),Wt())});Jt.observe(_);function Lt([z,se]){let{scale:ue}=u.transform;ue<Qh&&u.zoom(Qh/ue,u.middle,h.shape);let Ge=u.fromGrid(
{x:z+.5,y:se+.5},h.shape[1]);u.pan(u.middle.x-Ge.x,u.middle.y-Ge.y,h.shape),D.focus(),d.setCursor({x:z,y:se})}async function Gt(z){if(z==="in"||z==="out")u.zoom(
z==="in"?1.4:1/1.4,u.middle,h.shape);else if(z==="fit")u.fit(h.shape);else if(z.startsWith("cell "))Lt(z.slice(5).split(",").map(Number));else if(z==="help")Q.help.
showModal();else if(z==="new")Q.new.showModal();else if(z==="theme")rt.next();else if(z==="add")D.addSensor();else if(z==="share"){let se=h.portableDocument();se&&
J.show(location.href.replace(/[?#].*/,"")+await ja(se))}else if(z==="export png"){let se=await ml(Ne());se&&ti("bayesmap.png",se),h.say("Saved bayesmap.png")}else
z.startsWith("export ")&&h.act({type:"export",what:z.slice(7)});c()}h.ondownload=(z,se,ue)=>z===Ao?M.receive(hn(ue.slice().buffer)):ti(z,new Blob([ue],{type:se}));
let De=[[n?t:window,"keydown",z=>{z.defaultPrevented||!h.document||Object.values(Q).some(se=>se.open)||nl(z,h,{tool:se=>{d.choose(se),D.focus()},layer:se=>y.showLayer(
se),command:Gt})}],[window,"online",()=>e.retry?.()],[window,"hashchange",async()=>{if(n)return;let{document:z,damaged:se}=await Oo(),ue=Gi(location.hash);z?h.bring(
z):Ie.story&&ue!==null?Ie.go(ue):se&&h.say(Io,"error")}],[t,"dragover",z=>z.preventDefault()],[t,"drop",z=>{z.preventDefault();let se=z.dataTransfer?.files[0];se&&
Ya(se,h,r)}]];for(let[z,se,ue]of De)z.addEventListener(se,ue);return rt.dress(),{destroy(){Jt.disconnect(),cancelAnimationFrame(l),rt.destroy();for(let[z,se,ue]of De)
z.removeEventListener(se,ue);e.close(),i.replaceChildren()},snapshot:()=>jh(h,u,E,M),cellToClient(z,se){let ue=A.getBoundingClientRect(),Ge=u.fromGrid({x:z+.5,y:se+
.5},h.shape[1]);return{x:ue.left+Ge.x,y:ue.top+Ge.y}}}}var Hg=200,jg=.2,Ye=class extends Error{},ep=({grid:t,walls:e})=>wt(ht(e),t.shape[0]*t.shape[1]);function tp({grid:t},{x:e,y:n}){let[o,s]=[Math.floor((e-t.origin[0])/
t.resolution),Math.floor((n-t.origin[1])/t.resolution)];return o>=0&&o<t.shape[0]&&s>=0&&s<t.shape[1]?o*t.shape[1]+s:null}function zi(t,e){let n=tp(t,e);if(n===
null)throw new Ye("the sensor cannot stand outside the map");if(ep(t)[n])throw new Ye("the sensor cannot stand in a wall; move it to a free cell");return{...e,yaw:e.
yaw-2*Math.PI*Math.round(e.yaw/(2*Math.PI))}}function np(t,e,n){switch(e.type){case"set":return[Yi({...t,...e.patch},t,n),""];case"walls":return Vg(t,e.cells,e.
wall);case"clear":return e.what==="walls"?[{...t,walls:op(t.grid.shape)},""]:null;case"add_sensor":{if(t.sensors.length>=n.sensors[1])throw new Ye(`there are ${t.
sensors.length} sensors already; remove one first`);let o=Math.max(...t.sensors.map(s=>s.id))+1;return[{...t,sensors:[...t.sensors,zi(t,{id:o,x:e.x,y:e.y,yaw:e.
yaw??0})]},""]}case"move_sensor":{let o=s=>zi(t,{id:s.id,x:e.x??s.x,y:e.y??s.y,yaw:e.yaw??s.yaw});return[{...t,sensors:t.sensors.map(s=>s.id===e.id?o(s):s)},""]}case"\
remove_sensor":{let o=t.sensors.filter(s=>s.id!==e.id);if(!o.length)throw new Ye("the last sensor cannot be removed; add another first");return[{...t,sensors:o},
""]}case"new":return[zg(t,e.shape,e.world),""];default:return null}}var op=([t,e])=>Sn(new Uint8Array(t*e+7>>3));function Vg(t,e,n){let o=ep(t),s=t.grid.shape[1];
for(let[i,a]of e)o[i*s+a]=n?1:0;let r="";for(let i of t.sensors){let a=tp(t,i);o[a]&&(r=`a sensor stands in cell (${Math.floor(a/s)}, ${a%s}): it stays free`),o[a]=
0}return[{...t,walls:Sn(Zn(o))},r]}function zg(t,e,n){if(n!=="blank")throw new Ye("this figure can begin blank maps alone; bayesmap app has others");let[o,s]=e.
map(i=>Math.floor((i-1)/2));return{...t,grid:{shape:e,resolution:1,origin:[-.5,-.5]},walls:op(e),sensors:[{id:1,x:o,y:s,yaw:0}],noise:jg,max_range:2*Math.max(...e)}}
function Yi(t,e,n){let o=t;for(let[h,u]of Object.entries(e)){let d=o[h];if(u!==null&&(typeof d!=typeof u||d===null))throw new Ye(`${h} is missing, or of another\
 type`);let m=n[h];if(m&&typeof d=="number"&&!(d>=m[0]&&d<=m[1]))throw new Ye(`${h}: ${d}; give ${m[0]} to ${m[1]}`)}let{grid:s,source:r,sensors:i,walls:a}=o;if(r.
kind!=="simulation")throw new Ye("this figure shows drawn maps alone; start bayesmap app with the file");if(o.cells!=="binary"||o.pose_sigma>0||o.heading_sigma>
0)throw new Ye("this figure samples walls seen from known poses alone; bayesmap app samples others");if(o.method==="propagate")throw new Ye("this figure has no \
belief propagation; choose another method");let[l,c]=n.side;if(!(s.shape.length===2&&s.shape.every(h=>Number.isInteger(h)&&h>=l&&h<=c)&&s.resolution>0))throw new Ye(
`grid: give ${l} to ${c} cells a side`);if(ht(a).length!==s.shape[0]*s.shape[1]+7>>3)throw new Ye("walls: another number of cells than the grid's");if(!(i.length>=
n.sensors[0]&&i.length<=n.sensors[1]))throw new Ye(`sensors: give ${n.sensors[0]} to ${n.sensors[1]}`);return{...o,sensors:i.map(h=>zi(o,h))}}function Yg(t){return t.
type==="walls"&&t.stroke?`walls ${t.stroke}`:t.type==="set"&&t.drag?`set ${t.drag} ${Object.keys(t.patch).sort()}`:t.type==="move_sensor"&&t.drag?`move ${t.drag}\
 ${t.id}`:null}var fr=class{constructor(e){this.present=e}past=[];future=[];gesture=null;get canUndo(){return this.past.length>0}get canRedo(){return this.future.
length>0}push(e,n){let o=Yg(n);(o===null||o!==this.gesture)&&(this.past.push(this.present),this.past.length>Hg&&this.past.shift()),this.future=[],this.gesture=o,
this.present=e}step(e){let[n,o]=e?[this.past,this.future]:[this.future,this.past],s=n.pop();return s?(o.push(this.present),this.present=s,this.gesture=null,!0):
!1}};var qg=11102230246251565e-32,sp=2**32,rp=1,ip=2,ap=3;function qi(t,e,n){let{high:o,low:s}=t,r=s&65535,i=s>>>16,a=n&65535,l=n>>>16,c=r*a,h=i*a+(c>>>16),u=r*l+(h&
65535),d=i*l+(h>>>16)+(u>>>16);t.low=((u&65535)<<16|c&65535)>>>0,t.high=d+Math.imul(o,n)+Math.imul(s,e)>>>0}function Ki(t,e){let{high:n,low:o}=t;t.low=(o^(o>>>e|
n<<32-e))>>>0,t.high=(n^n>>>e)>>>0}function Bt(t,e,n){let o=e+1;n.high=Math.floor(o/sp)>>>0,n.low=o>>>0,qi(n,2654435769,2135587861);let s=n.low+t.low;n.high=n.high+
t.high+(s>=sp?1:0)>>>0,n.low=s>>>0,Ki(n,30),qi(n,3210233709,484763065),Ki(n,27),qi(n,2496678331,321982955),Ki(n,31)}var Xi=({high:t,low:e})=>t*2097152+(e>>>11),
Rn=t=>(Xi(t)+.5)*qg;function mn(...t){let e=o=>BigInt.asUintN(64,o),n=0n;for(let o of t){let s=e((n^BigInt(o))+0x9e3779b97f4a7c15n);s=e((s^s>>30n)*0xbf58476d1ce4e5b9n),
s=e((s^s>>27n)*0x94d049bb133111ebn),n=s^s>>31n}return{high:Number(n>>32n),low:Number(n&0xffffffffn)}}var Ji=2654435761,Kg=2246822507;function mr(t,e){let n=Math.
imul(t+e,Ji);return n=Math.imul(n^n>>>15,Kg),n^n>>>13}function lp(t,e,n,o){let s=n>>>1,r=(1<<s)-1,i=(1<<n-s)-1,a=t;do{let l=a>>>s,c=a&r;l^=mr(c,o.low)&i,c^=mr(l,
o.high)&r,l^=mr(c,o.low^Ji)&i,c^=mr(l,o.high^Ji)&r,a=(l<<s|c)>>>0}while(a>=e);return a}var cp=t=>Math.max(2,32-Math.clz32(t-1));function gr(t,e){let n={high:0,low:0};
Bt(t,e,n);let o=Rn(n);return Bt(t,e+1,n),Math.sqrt(-2*Math.log(o))*Math.cos(2*Math.PI*Rn(n))}var Jg=2**53,hp=20,pp=1e15,[yr,Zi,dp]=[0,1,2],br=class{constructor(e){this.p=e;let n=e*Jg,o=Math.round(n);this.level=o-n===.5&&o%2?o-1:o,this.logit=Math.min(Math.
max(Math.log(e)-Math.log1p(-e),-pp),pp)}level;logit;draws(e){return Xi(e)<this.level}logProb(e){if(this.p===0||this.p===1)return 0;let n=0;for(let o of e)n+=o;return e.
length*Math.log1p(-this.p)+n*this.logit}};function wr(t,e){return t>40?!0:t<-40?!1:e*(1+Math.exp(-t))<1}function Qi({order:t,shuffle:e},n,o){if(!e)return i=>t[i];
let s=cp(t.length),r={high:0,low:0};return Bt(n,-1-o,r),i=>t[lp(i,t.length,s,r)]}var xr=class{constructor(e,n,o){this.problem=e;this.walls=n;this.key=o;let{offsets:s,
cells:r,noHit:i}=e.table;this.first=new Int32Array(i.length),this.current=new Float32Array(i.length),this.reached=new Int32Array(n.length),this.gain=new Float32Array(
n.length),this.known=new Uint8Array(n.length);for(let a=0;a<i.length;a++){let l=this.nextWall(s[a],s[a+1]);this.first[a]=l,this.current[a]=this.entryLoglik(a,l);
for(let c=s[a];c<Math.min(l+1,s[a+1]);c++)this.reached[r[c]]++}}first;current;reached;gain;known;bits={high:0,low:0};nextWall(e,n){let{cells:o}=this.problem.table,
s=e;for(;s<n&&!this.walls[o[s]];)s++;return s}entryLoglik(e,n){let{offsets:o,loglik:s,noHit:r}=this.problem.table;return n<o[e+1]?s[n]:r[e]}logLikelihood(){let e=0;
for(let n of this.current)e+=n;return e}moveFirst(e,n){let{offsets:o,cells:s}=this.problem.table,r=o[e+1],i=this.first[e];this.first[e]=n,this.current[e]=this.entryLoglik(
e,n);let a=Math.min(i,n);for(let c=o[e];c<Math.min(a+1,r);c++)this.known[s[c]]=yr;let l=n>i?1:-1;for(let c=a+1;c<Math.min(Math.max(i,n)+1,r);c++)this.known[s[c]]=
yr,this.reached[s[c]]+=l}put(e){let{offsets:n,beam:o,entry:s}=this.problem.index;this.walls[e]=1;for(let r=n[e];r<n[e+1];r++)this.first[o[r]]>s[r]&&this.moveFirst(
o[r],s[r])}remove(e){let{table:n,index:o}=this.problem;this.walls[e]=0;for(let s=o.offsets[e];s<o.offsets[e+1];s++){let r=o.beam[s],i=o.entry[s];this.first[r]===
i&&this.moveFirst(r,this.nextWall(i+1,n.offsets[r+1]))}}sweep(e,n){let{prior:o}=this.problem,s=e.order.length,r=Qi(e,this.key,n);for(let i=0;i<s;i++){let a=r(i);
Bt(this.key,n*s+a,this.bits),this.reached[a]?this.walls[a]?this.stays(a,Rn(this.bits))||this.remove(a):this.becomes(a,Rn(this.bits))&&this.put(a):this.walls[a]=
o.draws(this.bits)?1:0}}becomes(e,n){let{logit:o}=this.problem.prior;return this.known[e]===yr&&this.sumGain(e,-hp-o),wr(o+this.gain[e],n)?this.known[e]===dp?!0:
(this.sumGain(e,-1e300),wr(o+this.gain[e],n)):!1}sumGain(e,n){let{offsets:o,beam:s,entry:r,loglik:i,gainBound:a}=this.problem.index,l=0,c=dp;for(let h=o[e];h<o[e+
1];h++){let u=l+a[h];if(u<n){l=u,c=Zi;break}this.first[s[h]]>r[h]&&(l+=Math.fround(i[h]-this.current[s[h]]))}this.gain[e]=l,this.known[e]=c}stays(e,n){let{table:o,
index:s,prior:r}=this.problem;if(this.known[e]===yr){let l=0;for(let c=s.offsets[e];c<s.offsets[e+1];c++)this.first[s.beam[c]]===s.entry[c]&&(l+=s.advantage[c]);
this.gain[e]=l,this.known[e]=Zi}let i=r.logit+this.gain[e];if(this.known[e]===Zi&&i>hp&&wr(i,n))return!0;let a=0;for(let l=s.offsets[e];l<s.offsets[e+1];l++){let c=s.
beam[l],h=s.entry[l];this.first[c]===h&&(a+=Math.fround(s.loglik[l]-this.entryLoglik(c,this.nextWall(h+1,o.offsets[c+1]))))}return wr(r.logit+a,n)}};var Xg=8,Zg=-1e300,Qg=2**53;function ea(t,e,n,o){let s=Math.floor(t/o)-e,r=t%o-n;return s<0||s>1||r<0||r>1?-1:2*s+r}function up({table:t,shape:[e,n]}){let{offsets:o,
cells:s,noHit:r}=t,i=Math.max(1,e-1),a=Math.max(1,n-1),l=Array.from({length:i*a},()=>[]);for(let d=0;d<r.length;d++)for(let m=o[d];m<o[d+1];m++)for(let y=0;y<4;y++){
let M=Math.floor(s[m]/n)-(y>>1),b=s[m]%n-(y&1);if(M<0||M>=i||b<0||b>=a)continue;let x=l[M*a+b],k=x[x.length-1];k?.b===d&&k.last>=m-Xg?k.last=m:x.push({b:d,first:m,
last:m})}let c=new Int32Array(l.length+1);l.forEach((d,m)=>c[m+1]=c[m]+d.length);let h=l.flat(),u=d=>Int32Array.from(h,m=>m[d]);return{offsets:c,beam:u("b"),first:u(
"first"),last:u("last"),rows:a}}function fp(t,e,n,o){let{prior:s,shape:[r,i]}=t.problem,{rows:a}=e,l=n.order.length,c=Qi(n,t.key,o),h=new Float64Array(16),u=new Float64Array(
16),d={high:0,low:0};for(let m=0;m<l;m++){let y=c(m),M=Math.floor(y/a),b=y%a,x=4*(o*l+y),k=D=>M+(D>>1)<r&&b+(D&1)<i?(M+(D>>1))*i+b+(D&1):-1,A=0;for(let D=0;D<4;D++)
k(D)>=0&&(A+=t.reached[k(D)]);if(!A){for(let D=0;D<4;D++)k(D)<0||(Bt(t.key,x+D,d),t.walls[k(D)]=s.draws(d)?1:0);continue}ey(t,e,y,M,b,h),u.fill(0);for(let D=0;D<
4;D++){let L=k(D)<0||s.level===0,O=!L&&s.level===Qg;for(let G=0;G<16;G++)(G>>D&1)===(O?0:1)&&(u[G]+=L||O?Zg:s.logit)}for(let D=0;D<16;D++)h[D]+=u[D];Bt(t.key,x,
d);let E=ty(h,Rn(d));for(let D=0;D<4;D++){let L=k(D);L<0||(E>>D&1?t.walls[L]||t.put(L):t.walls[L]&&t.remove(L))}}}function ey(t,e,n,o,s,r){let{table:i,shape:[,a]}=t.
problem,{offsets:l,cells:c,loglik:h}=i;r.fill(0);for(let u=e.offsets[n];u<e.offsets[n+1];u++){let d=e.beam[u],m=t.first[d],y=e.first[u];if(m<y)continue;let M=e.
last[u],b=l[d+1],x=m;if(m<=M&&m<b&&ea(c[m],o,s,a)>=0)for(x=m+1;x<b&&!(t.walls[c[x]]&&ea(c[x],o,s,a)<0);)x++;let k=t.entryLoglik(d,x),A=0;for(let E=y;E<Math.min(
M+1,x);E++){let D=ea(c[E],o,s,a);if(D<0)continue;let L=Math.fround(h[E]-k);for(let O=0;O<16;O++)O>>D&1&&!(O&A)&&(r[O]+=L);A|=1<<D}}}function ty(t,e){let n=Math.
max(...t),o=t.map(r=>r>n-40?Math.exp(r-n):0),s=e*o.reduce((r,i)=>r+i,0);for(let r=0;r<16;r++)if(s-=o[r],s<=0&&o[r]>0)return r;return 15}function $n(t){let e=0;for(let n=0;n<t.length;n++)e+=t[n];return e/t.length}var ta=t=>{let e=$n(t);return t.reduce((n,o)=>n+(o-e)**2,0)/(t.length-1)},vr=(t,e)=>t.
reduceRight((n,o)=>n*e+o,0),mp=[[3.3871328727963665,133.14166789178438,1971.5909503065513,13731.69376550946,45921.95393154987,67265.7709270087,33430.57558358813,
2509.0809287301227],[1,42.31333070160091,687.1870074920579,5394.196021424751,21213.794301586597,39307.89580009271,28729.085735721943,5226.495278852854]],gp=[[1.4234371107496835,
4.630337846156546,5.769497221460691,3.6478483247632045,1.2704582524523684,.2417807251774506,.022723844989269184,.0007745450142783414],[1,2.053191626637759,1.6763848301838038,
.6897673349851,.14810397642748008,.015198666563616457,.0005475938084995345,10507500716444169e-25]];function ny(t){let e=t-.5;if(Math.abs(e)<=.425){let o=.180625-
e*e;return e*vr(mp[0],o)/vr(mp[1],o)}let n=Math.sqrt(-Math.log(e<0?t:1-t))-1.6;return Math.sign(e)*vr(gp[0],n)/vr(gp[1],n)}function oy(t){let e=t[0].length>>1;return[
...t.map(n=>n.slice(0,e)),...t.map(n=>n.slice(n.length-e))]}function yp(t){let e=Float64Array.from(t.flat()).sort(),n=new Map;for(let o=0;o<e.length;){let s=o+1;
for(;s<e.length&&e[s]===e[o];)s++;n.set(e[o],ny(((o+1+s)/2-.375)/(e.length+.25))),o=s}return t.map(o=>o.map(s=>n.get(s)))}function wp(t){let e=t[0].length;return Math.
sqrt((e-1)/e+ta(t.map($n))/$n(t.map(ta)))}function bp(t,e){let n=t.length;for(let o=1,s=0;o<n;o++){let r=n>>1;for(;s&r;r>>=1)s^=r;s^=r,o<s&&([t[o],t[s],e[o],e[s]]=
[t[s],t[o],e[s],e[o]])}for(let o=2;o<=n;o*=2)for(let s=0;s<o/2;s++){let r=-2*Math.PI*s/o,[i,a]=[Math.cos(r),Math.sin(r)];for(let l=s;l<n;l+=o){let c=l+o/2,[h,u]=[
t[c]*i-e[c]*a,t[c]*a+e[c]*i];[t[c],e[c]]=[t[l]-h,e[l]-u],t[l]+=h,e[l]+=u}}}function sy(t){let e=t.length,n=$n(t),o=2**Math.ceil(Math.log2(2*e)),[s,r]=[new Float64Array(
o),new Float64Array(o)];t.forEach((i,a)=>s[a]=i-n),bp(s,r);for(let i=0;i<o;i++)[s[i],r[i]]=[s[i]**2+r[i]**2,0];return bp(s,r),s.slice(0,e).map(i=>i/o/e)}function ry(t){
let[e,n]=[t.length,t[0].length],o=t.map(sy),s=$n(o.map(h=>h[0]))*n/(n-1),r=s*(n-1)/n+ta(t.map($n)),i=h=>h?1-(s-$n(o.map(u=>u[h])))/r:1,a=Math.max(1,Math.ceil((n-
2)/2)),l=-1,c=1/0;for(let h=0;h<a;h++){let u=i(2*h),d=u+i(2*h+1);if(!(d>0)||h===a-1){l+=d>0?u:Math.max(u,0);break}c=Math.min(c,d),l+=2*c}return e*n/Math.max(l,1/
Math.log10(e*n))}function xp(t){if(t[0].length<4||t.every(c=>c.every(h=>h===t[0][0])))return null;let e=oy(t),n=Float64Array.from(e.flat()).sort(),o=(n[n.length-
1>>1]+n[n.length>>1])/2,s=e.map(c=>c.map(h=>Math.abs(h-o))),r=yp(e),[i,a]=[wp(r),wp(yp(s))];return{rhat:Number.isNaN(a)?i:Number.isNaN(i)?a:Math.max(i,a),ess:ry(
r)}}function vp({table:t,prior:e,shape:n},o,s,r){let{offsets:i,cells:a,loglik:l,noHit:c}=t,h=n[0]*n[1],u={high:0,low:0},d=new Int8Array(h);return Float64Array.from(
{length:r},(m,y)=>{d.fill(0);let M=0;for(let b=0;b<c.length;b++){let x=c[b];for(let k=i[b];k<i[b+1];k++){let A=a[k];if(d[A]||(Bt(o,(s+y)*h+A,u),d[A]=e.draws(u)?
1:-1),d[A]>0){x=l[k];break}}M+=x}return M})}function na({prior:t,shape:e},n,o){let s=e[0]*e[1],r={high:0,low:0};return Uint8Array.from({length:s},(i,a)=>(Bt(n,o*
s+a,r),t.draws(r)?1:0))}function kp(t){let e=t.reduce((r,i)=>Math.max(r,i),-1/0),n=e+Math.log(t.reduce((r,i)=>r+Math.exp(i-e),0)),o=t.map(r=>r-n),s=o.reduce((r,i)=>r+
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
n],o,s){for(let r=new kr(o,e,n,s);!r.over;r.next())if(r.inside&&t[r.cellX*n+r.cellY])return Math.min(r.distance,s);return s}function Sp([t,e],n,o){let s=[],r=new Int32Array(
n.length+1);return n.forEach((i,a)=>{for(let l=new kr(i,t,e,o);!l.over;l.next())l.inside&&s.push(l.cellX*e+l.cellY);r[a+1]=s.length}),{offsets:r,cells:Int32Array.
from(s)}}function Mp({x:t,y:e,ux:n,uy:o},s,r){let i=Math.floor(s/r),a=s-i*r,l=0,c=1e300,h=!0,u=(d,m,y)=>{let M=sa(m);if(!M)return;let b=1/m,x=y+(M>0?0:1)-d;l=Math.
max(l,x*b),c=Math.min(c,(x+M)*b),h&&=y===oa(d,M)};return u(t,n,i),u(e,o,a),h?Math.max(c,0):l}var iy=Math.fround(.001),ay=-.5*Math.log(2*Math.PI);function Tp(t,e,n,o,s,r){let{offsets:i,cells:a}=t,l=o.sigma_m*o.sigma_m,c=.5*Math.log(l),h=(m,y)=>{let M=m-Math.
min(y,o.max_m);return ay-.5*(M*M/l)-c},u=new Float32Array(a.length),d=new Float32Array(e.length);for(let m=0;m<e.length;m++){d[m]=h(n[m],1/0);for(let y=i[m];y<i[m+
1];y++)u[y]=h(n[m],Mp(e[m],a[y],s)*r)}return{offsets:i,cells:a,loglik:u,noHit:d}}function Ap({offsets:t,cells:e,loglik:n,noHit:o},s){let r=Float32Array.from(o),
i=new Float32Array(e.length);for(let d=0;d<o.length;d++){let m=o[d];for(let y=t[d+1]-1;y>=t[d];y--)i[y]=n[y]-m,m=Math.max(m,n[y]),r[d]=Math.min(r[d],n[y])}let a=new Int32Array(
s+1);for(let d of e)a[d+1]++;for(let d=0;d<s;d++)a[d+1]+=a[d];let l=()=>new Float32Array(e.length),c=()=>new Int32Array(e.length),h={offsets:a,entry:c(),beam:c(),
loglik:l(),gainBound:l(),advantage:l()},u=a.slice();for(let d of[!0,!1])for(let m=0;m<o.length;m++)for(let y=t[m];y<t[m+1];y++){let M=Math.fround(n[y]-r[m]);if(M>
iy!==d)continue;let b=u[e[y]]++;h.entry[b]=y,h.beam[b]=m,h.loglik[b]=n[y],h.gainBound[b]=M,h.advantage[b]=i[y]}for(let d=0;d<s;d++)for(let m=a[d+1]-2;m>=a[d];m--)
h.gainBound[m]+=h.gainBound[m+1];return h}function ts({angles:t,fov:e}){let n=e*(180/Math.PI);if(n===360)return Float64Array.from({length:t},(s,r)=>r*2*Math.PI/t);let o=n/(t-t%2);return Float64Array.from(
{length:t},(s,r)=>(o*r-n/2)*(Math.PI/180))}function Ep(t){let{origin:e,resolution:n}=t.grid,o=[...ts(t)];return t.sensors.flatMap(({x:s,y:r,yaw:i})=>o.map(a=>({
x:(s-e[0])/n,y:(r-e[1])/n,ux:Math.cos(i+a),uy:Math.sin(i+a)})))}function Pp({grid:t,walls:e,max_range:n},o){let s=wt(ht(e),t.shape[0]*t.shape[1]),r=n/t.resolution;
return Float64Array.from(o,i=>Math.min(Sr(s,t.shape,i,r)*t.resolution,n))}function _p({grid:t,noise:e,prior:n,max_range:o},s,r){let{shape:i,resolution:a}=t,l=Sp(
i,s,o/a),c=Tp(l,s,r,{sigma_m:e,max_m:o},i[1],a);return{table:c,index:Ap(c,i[0]*i[1]),prior:new br(n),shape:i}}function Cp({grid:t,sensors:e,order:n},o){let[s,r]=t.
shape,[i,a]=o?[Math.max(1,s-1),Math.max(1,r-1)]:[s,r],l=Int32Array.from({length:i*a},(d,m)=>m);if(n!=="radial")return{order:l,shuffle:n==="random"};let c=(d,m)=>Math.
min(Math.max(d,0),m-1),h=e.map(({x:d,y:m})=>[c(Math.floor((d-t.origin[0])/t.resolution),s),c(Math.floor((m-t.origin[1])/t.resolution),r)]),u=l.map(d=>Math.min(...h.
map(([m,y])=>Math.abs(Math.floor(d/a)-m)+Math.abs(d%a-y))));return{order:Int32Array.from([...l].sort((d,m)=>u[d]-u[m]||d-m)),shuffle:!1}}var tn=2,Lp=32,ly=300,cy=100,hy=64<<20,py=.1,dy=16,uy=40,ra=24,Np=[.1,.3,.5,.7,.9],$p={chains:0,count:0},fy={gibbs:"Gibbs sampling, cell by cell",block:"Gibbs s\
ampling, 2 x 2 blocks",importance:"importance sampling",none:"none yet: this is the prior"},Po=()=>performance.now(),Dp=t=>Uint8Array.from(t,e=>Math.round(255*e)),
Rp=t=>String(+t.toPrecision(4)),_o=class{constructor(e,n){this.document=e;this.problem=n;this.cells=n.shape[0]*n.shape[1]}done=!1;seconds=0;method="none";cells;work(e){
let n=Po();do this.step();while(!this.done&&Po()-n<e);this.seconds+=(Po()-n)/1e3}step(){this.done=!0}get draws(){return $p}beamsThrough(e){let{offsets:n}=this.problem.
index;return n[e+1]-n[e]}mean(){return new Float64Array(this.cells).fill(this.document.prior)}reached(){return new Uint8Array(this.cells)}get logJoint(){return[]}figures(e){
return{sweeps:0,total:0,ess:null,rhat:null,log_joint:null,verdict:null,burned:0}}draw(e){return null}weights(){return null}picture(e,n,o,s){let{document:r,method:i}=this,
a=e.layer==="draw"?this.draw(e):null,l=this.weights(),c=i==="gibbs"?`, ${r.order} order`:"",h={type:"field",generation:n,milliseconds:o,layer:a?"draw":"mean",method:i,
approximate:!1,...this.figures(s),draws:this.draws,quantity:{kind:"binary",mean:"P(wall)",value:"wall",interval:!1},chain:null,draw:null,averaged:null,lowest:l?.
lowest??null,seconds:i==="none"?null:this.seconds,about:[["Method",fy[i]+c],["Prior",`independent: p wall ${Rp(r.prior)}`],["Sensor",`gaussian: sigma ${Rp(r.noise)}\
 m`],["Poses","known"],["Computed","in this page"]],...a&&{chain:a.chain,draw:a.draw,log_joint:a.log_joint}},u=Dp(a?a.map:this.mean());return[h,{p:u,reached:Dp(
this.reached()),...this.trace(),...l&&{weights:l.weights}}]}recording(e){let{document:n}=this,{chains:o,count:s}=this.draws,[r,i]=this.picture({layer:"mean",chain:0,
draw:null},1,0,!0),a=Uint32Array.from({length:this.cells},(u,d)=>this.beamsThrough(d)),{log_joint:l,draws:c}=this.recorded(),h=n.sensors.map(({id:u})=>u);return[
{version:1,document:n,field:r,ids:h,draws:{chains:o,count:s,kept:s,bits:!0},log_joint:l},{...i,...e,beams:a,draws:c}]}recorded(){return{log_joint:[],draws:new Uint8Array(
0)}}trace(){let e=this.logJoint,n=e[0]?.length??0,o=Math.min(n,ly),s=Array.from({length:o},(a,l)=>Math.round(o>1?1+l*(n-1)/(o-1):1)),r=Array.from({length:Math.min(
n,cy)},(a,l)=>l+1),i=[...new Set([...r,...s])].sort((a,l)=>a-l);return{trace:Float32Array.from(e.flatMap(a=>i.map(l=>a[l-1]))),traced:Float32Array.from(i)}}},ns=class extends _o{constructor(n,o,s,r){
super(n,o);this.judging=s;let{seed:i,start:a,sweeps:l}=n;this.method=r?"block":"gibbs",this.blocks=r?up(o):null,this.sites=Cp(n,r),this.thin=Math.ceil(l*tn*Math.
ceil(this.cells/8)/hy),this.chains=Array.from({length:tn},(c,h)=>{let d=a==="empty"&&n.prior<1?new Uint8Array(this.cells):na(o,mn(i,h,ip),0);return new xr(o,d,mn(
i,h,rp))}),this.touched=new Uint8Array(this.cells);for(let c of o.table.cells)this.touched[c]=1;this.present={sweep:0,sums:this.chains.map(()=>new Float64Array(
this.cells)),reached:new Uint32Array(this.cells),looks:0},this.past=[this.copy()],this.goOn(l)}chains;blocks;sites;lookAt=new Set;touched;joint=Array.from({length:tn},
()=>[]);likelihood=Array.from({length:tn},()=>[]);kept=Array.from({length:tn},()=>[]);thin;total=0;sweep=0;present;past;diagnosis=null;diagnosed=0;diagnoseAt=0;goOn(n){
let{lookAt:o,document:s}=this;this.total=Math.ceil((this.total+n)/this.thin)*this.thin,o.add(Math.floor(s.burn_in*this.total));for(let r=1;r<=this.total;r*=2)o.
add(r);for(let r=1;r<=Lp;r++)o.add(Math.floor(this.total*r/Lp));this.done=!1,this.diagnoseAt=0}burn(n){let o=Math.floor(n/this.thin),s=this.kept.map(r=>{let i=new Float64Array(
this.cells);for(let a of r.slice(0,o))wt(a,this.cells).forEach((l,c)=>i[c]+=l);return i.map(a=>a*n/Math.max(1,o))});this.past=[{...this.past[0],sweep:n,sums:s}]}copy(){
let{sums:n,reached:o,looks:s}=this.present;return{sweep:this.sweep,sums:n.map(r=>r.slice()),reached:o.slice(),looks:s}}step(){let{present:n,document:o}=this;this.
chains.forEach((r,i)=>{this.blocks?fp(r,this.blocks,this.sites,this.sweep):r.sweep(this.sites,this.sweep);let a=n.sums[i];for(let c=0;c<this.cells;c++)a[c]+=r.walls[c];
let l=r.logLikelihood();this.likelihood[i].push(l),this.joint[i].push(l+this.problem.prior.logProb(r.walls)),(this.sweep+1)%this.thin===0&&this.kept[i].push(Zn(
r.walls))}),this.sweep++,this.done=this.sweep>=this.total;let s=Math.floor(o.burn_in*this.total);if(this.done&&s>this.past[0].sweep&&this.past.every(({sweep:r})=>r!==
s)&&this.burn(s),!!this.lookAt.has(this.sweep)){for(let r of this.chains)for(let i=0;i<this.cells;i++)n.reached[i]+=r.reached[i]?1:0;for(n.looks+=tn,this.sweep<=
o.burn_in*this.total&&this.past.push(this.copy());this.past.length>1&&this.past[1].sweep<=o.burn_in*this.sweep;)this.past.shift()}}get draws(){return this.kept[0].
length?{chains:tn,count:this.kept[0].length}:$p}recorded(){let{joint:n,kept:o,thin:s}=this,r=o.flat(),i=r[0]?.length??0,a=new Uint8Array(r.length*i);return r.forEach(
(l,c)=>a.set(l,c*i)),{log_joint:n.map(l=>l.filter((c,h)=>(h+1)%s===0)),draws:a}}means(){let[n]=this.past,o=Math.max(1,this.sweep-n.sweep);return this.present.sums.
map((s,r)=>s.map((i,a)=>(i-n.sums[r][a])/o))}mean(){let[n,o]=this.means();return n.map((s,r)=>this.touched[r]?(s+o[r])/2:this.document.prior)}reached(){let[n]=this.
past,o=Math.max(1,this.present.looks-n.looks);return Float64Array.from(this.present.reached,(s,r)=>(s-n.reached[r])/o)}get logJoint(){return this.joint}draw({chain:n,
draw:o}){let s=Math.min(n,tn-1),{count:r}=this.draws;if(!r)return{map:this.chains[s].walls,chain:s,draw:0,log_joint:this.joint[s].at(-1)??0};let i=Math.min(o??r-
1,r-1);return{map:wt(this.kept[s][i],this.cells),chain:s,draw:i,log_joint:this.joint[s][(i+1)*this.thin-1]}}figures(n){let[{sweep:o}]=this.past,s=Po();(s>=this.
diagnoseAt||this.done&&this.diagnosed<this.sweep)&&(this.diagnosis=xp(this.joint.map(c=>c.slice(o))),this.diagnosed=this.sweep,this.diagnoseAt=this.done?1/0:Po()+
(Po()-s)/py);let r=this.joint.reduce((c,h)=>c+h[h.length-1],0)/tn,{ess:i=null,rhat:a=null}=this.diagnosis??{},l=c=>c!==null&&Number.isFinite(c)?c:null;return{sweeps:this.
sweep,total:this.total,ess:l(i),rhat:l(a),log_joint:r,verdict:this.verdict(n||this.done),burned:o}}verdict(n){let{judging:o,sweep:s}=this,r=s<o.fewest_sweeps;if(r&&
!n)return null;let i=(u,d,m=null)=>({level:u,why:d,cell:m}),a=this.difference();if(!r&&a.cells>o.chance_share*a.among){let[u,d]=a.cell,m=`in ${a.cells} of ${a.among}\
 observed cells, most in cell (${u}, ${d}), by ${a.by.toFixed(2)}`;return i("bad",`P(wall) differs by over ${o.bad_difference} between the chains ${m}`,a.cell)}
if(s<o.fewest_diagnosed)return i("bad",`${s} ${s===1?"sweep is":"sweeps are"} too few to judge`);let{rhat:l=NaN,ess:c=NaN}=this.diagnosis??{};if(l>o.rhat_limit)
return i("bad",`R-hat is ${l.toFixed(3)}, over ${o.rhat_limit}`);let h=this.misfit();return h?i("bad",`the chains agree, but on maps that the readings contradic\
t: they differ by ${+h.toPrecision(3)} times the noise`):!Number.isFinite(l)||!Number.isFinite(c)?i("good","nothing varies: the log joint is the same in all dra\
ws of all chains"):c<o.bad_ess?i("bad",`only ${c.toFixed(0)} effective draws`):l>o.good_rhat||c<o.good_ess?i("fair",`R-hat ${l.toFixed(3)} and ${c.toFixed(0)} e\
ffective draws; ${o.good_rhat} and ${o.good_ess} are good`):i("good",`R-hat ${l.toFixed(3)}, ${c.toFixed(0)} effective draws`)}misfit(){let n=this.problem.table.
noHit.length,[{sweep:o}]=this.past,s=-n*Math.log(this.document.noise*Math.sqrt(2*Math.PI)),r=this.likelihood.map(l=>l.slice(o).reduce((c,h)=>c+h,0)/(l.length-o)),
i=2*(s-Math.min(...r)),a=2/(9*n);return i>n*(1-a+this.judging.misfit_sigmas*Math.sqrt(a))**3?Math.sqrt(i/n):null}difference(){let[n,o]=this.means(),s=this.reached(),
r={by:0,cell:[0,0],cells:0,among:0};for(let i=0;i<this.cells;i++){if(s[i]<.5)continue;let a=Math.abs(n[i]-o[i]);r.among++,a>this.judging.bad_difference&&r.cells++,
a>r.by&&([r.by,r.cell]=[a,[Math.floor(i/this.problem.shape[1]),i%this.problem.shape[1]]])}return r}},Mr=class extends _o{constructor(n,o,s){super(n,o);this.judging=
s;this.method="importance",this.key=mn(n.seed,0,ap),this.sums=new Float64Array(this.cells),this.touched=new Uint8Array(this.cells);for(let r of o.table.cells)this.
touched[r]=1}key;logWeights=[];most=-1/0;sum=0;sums;touched;step(){let n=this.logWeights.length,o=Math.min(dy,this.document.sweeps-n);vp(this.problem,this.key,n,
o).forEach((s,r)=>{if(this.logWeights.push(s),s>this.most){let l=Math.exp(this.most-s);this.sum*=l;for(let c=0;c<this.cells;c++)this.sums[c]*=l;this.most=s}if(s<
this.most-uy)return;let i=Math.exp(s-this.most),a=na(this.problem,this.key,n+r);this.sum+=i;for(let l=0;l<this.cells;l++)a[l]&&(this.sums[l]+=i)}),this.done=this.
logWeights.length>=this.document.sweeps}mean(){return this.sums.map((n,o)=>this.touched[o]?n/this.sum:this.document.prior)}reached(){let n=this.mean(),{offsets:o,
cells:s,noHit:r}=this.problem.table,i=new Float64Array(this.cells);for(let a of Np){let l=new Uint8Array(this.cells);for(let c=0;c<r.length;c++)for(let h=o[c];h<
o[c+1]&&(l[s[h]]=1,!(n[s[h]]>a));h++);for(let c=0;c<this.cells;c++)i[c]+=l[c]/Np.length}return i}figures(){let{effectiveSampleSize:n}=kp(Float64Array.from(this.
logWeights));return{sweeps:this.logWeights.length,total:this.document.sweeps,ess:n,rhat:null,log_joint:null,verdict:this.verdict(n),burned:0}}verdict(n){let{bad_ess:o,
good_ess:s}=this.judging,r=n.toFixed(1)==="1.0"?"one particle carries":`${n.toFixed(1)} particles carry`;return n<o?{level:"bad",why:`${r} all the weight`,cell:null}:
{level:n>=s?"good":"fair",why:`${n.toFixed(0)} effective particles`,cell:null}}weights(){let n=this.logWeights.map(r=>r-this.most),o=Math.min(-1,...n.filter(Number.
isFinite).reduce((r,i)=>[Math.min(r[0],i)],[0])),s=new Float32Array(ra);for(let r of n)s[Math.min(ra-1,Math.floor(ra*(1-r/o)))]++;return{weights:s,lowest:o}}};var Tr=.03,my=40,Fn=180,Fp=90,ia=9,gy=24,Ip=60,aa=7,Op=50,yy=25,wy=10,Up=1e3,by=4e3,xy=21;function Hp(t,e,n){let{grid:o,noise:s,max_range:r,seed:i}=t,{shape:[a,
l],resolution:c,origin:h}=o,u=wt(ht(t.walls),a*l),d=ts(t),m=r/c,y=(P,_,B)=>c*Sr(u,o.shape,{x:P,y:_,ux:Math.cos(B),uy:Math.sin(B)},m),M=(P,_)=>P>=0&&_>=0&&P<a&&_<
l&&!u[Math.floor(P)*l+Math.floor(_)],b=(1-Tr)/(s*Math.sqrt(2*Math.PI)),x=([P,_,B])=>{if(!M(P,_))return-1/0;let I=0;for(let ie=0;ie<d.length;ie++){let K=y(P,_,B+
d[ie]),J=(e[ie]-K)/s,Q=K>=r;n[ie]?I+=Math.log((Q?0:b*Math.exp(-.5*J*J))+Tr/r):I+=Math.log(Q?1-Tr/2:Tr/2)}return I},k=$(),A=Bp(k.slice(0,by),P=>P,1.5,.2,Ip);if(A.
length===Ip)return ee(k.filter((P,_)=>_%Math.ceil(k.length/Up)===0));let E=mn(i,0,xy),[D,L]=[0,-1/0],O=A.slice(0,gy).map(P=>({mean:P,root:la(.4,.4,.04),poses:[],
logs:[],top:-1/0}));for(let P=0;P<=aa;P++){for(let _ of O){let B=P===aa,I=B?1.4:1.2,ie=Array.from({length:B?3*Op:Op},()=>vy(_.mean,_.root,I,E,D+=3)),K=ie.map(({
pose:q,log:W})=>x(q)-W);_.top=Math.max(_.top,...ie.map(({log:q},W)=>K[W]+q)),L=Math.max(L,_.top),Object.assign(_,{poses:ie.map(({pose:q})=>q),logs:K});let[J,Q]=Gp(
_.poses,Wp(K,B?1:wy));!B&&Q&&([_.mean,_.root]=[J,ky(Q)])}O=O.filter(_=>_.top>L-yy*(aa-P+1)),P>=2&&(O=Bp(O.sort((_,B)=>B.top-_.top),({mean:_})=>_,1,.15))}let G=Math.
max(...O.flatMap(({logs:P})=>P)),te=O.map(({poses:P,logs:_})=>_.map(B=>Math.exp(B-G)/P.length)),X=te.flat().reduce((P,_)=>P+_,0);return U(O.map(({poses:P},_)=>({
poses:P,weights:te[_].map(B=>B/X)})),L/d.length);function $(){let P=new Float32Array(Fn),_=Array.from(d.keys()).filter((K,J)=>J%Math.ceil(d.length/my)===0),B=Math.
hypot(s,.3*c),I=[];for(let K=0;K<a*l;K++){if(u[K])continue;let[J,Q]=[Math.floor(K/l)+.5,K%l+.5];for(let q=0;q<Fn;q++)P[q]=y(J,Q,q*2*Math.PI/Fn);for(let q=0;q<Fp;q++){
let W=q*2*Math.PI/Fp,fe=0;for(let de of _){let he=Math.round((W+d[de])*Fn/(2*Math.PI)),ae=P[(he%Fn+Fn)%Fn],Fe=(e[de]-ae)/B;fe+=n[de]?Math.min(Fe*Fe,ia):ae>=r?0:
ia}I.push({pose:[J,Q,W],loss:fe})}}I.sort((K,J)=>K.loss-J.loss);let ie=I[0]?.loss??0;return I.filter(({loss:K})=>K<ie+.25*ia*_.length).map(({pose:K})=>K)}function ee(P){
let _=P.map(x);return U([{poses:P,weights:Wp(_,_.length/2)}],Math.max(..._)/d.length)}function U(P,_){let B=P.map(({poses:K,weights:J})=>{let Q=J.reduce((Ne,Ie)=>Ne+
Ie,0),[[q,W,fe],de]=Gp(K,J.map(Ne=>Ne/Q)),he=[c,c,1],ae=(de??la(0,0,0)).map((Ne,Ie)=>Ne.map((_t,Ct)=>_t*he[Ie]*he[Ct])),[[Fe,We],[,ve]]=ae,st=Math.sqrt((Fe+ve)/
2+Math.hypot((Fe-ve)/2,We));return{mean:[h[0]+q*c,h[1]+W*c,Math.atan2(Math.sin(fe),Math.cos(fe))],covariance:ae,probability:Q,sigma_m:st,sigma_rad:Math.sqrt(ae[2][2])}}),
ie=P.flatMap(({poses:K,weights:J})=>K.map((Q,q)=>({pose:Q,weight:J[q]}))).sort((K,J)=>K.weight-J.weight).slice(-Up);return{modes:B.sort((K,J)=>J.probability-K.probability),
pose:Float32Array.from(ie.flatMap(({pose:[K,J,Q]})=>[h[0]+K*c,h[1]+J*c,Q])),weight:Float32Array.from(ie,({weight:K})=>K),nats_per_beam:_}}}function Bp(t,e,n,o,s=1/0){
let r=[];for(let i of t){if(r.length>=s)break;let[a,l,c]=e(i),h=u=>{let[d,m,y]=e(u);return Math.hypot(a-d,l-m)<n&&Math.abs(Math.atan2(Math.sin(c-y),Math.cos(c-y)))<
o};r.some(h)||r.push(i)}return r}var la=(...t)=>t.map((e,n)=>t.map((o,s)=>n===s?e:0));function vy(t,e,n,o,s){let r=[0,1,2].map(l=>gr(o,2*(s+l))),i=t.map((l,c)=>l+
n*e[c].reduce((h,u,d)=>h+u*r[d],0)),a=-.5*(r[0]**2+r[1]**2+r[2]**2)-Math.log(n**3*e[0][0]*e[1][1]*e[2][2]);return{pose:i,log:a}}function Wp(t,e){let n=Math.max(
...t);if(n===-1/0)return t.map(()=>1/t.length);for(let o=1;;o/=2){let s=t.map(i=>Math.exp(o*(i-n))),r=s.reduce((i,a)=>i+a,0);if(o<1e-6||r**2>=e*s.reduce((i,a)=>i+
a*a,0))return s.map(i=>i/r)}}function Gp(t,e){let n=t[e.indexOf(Math.max(...e))],o=t.map(l=>l.map((c,h)=>h===2?Math.atan2(Math.sin(c-n[2]),Math.cos(c-n[2])):c-n[h])),
s=l=>o.reduce((c,h,u)=>c+e[u]*l(h),0),r=[0,1,2].map(l=>s(c=>c[l])),i=r.map((l,c)=>r.map((h,u)=>s(d=>(d[c]-l)*(d[u]-h))));return[n.map((l,c)=>l+r[c]),i.every((l,c)=>l[c]>=
0)&&Number.isFinite(i[0][0])?i:null]}function ky(t){let e=la(0,0,0);for(let n=0;n<3;n++)for(let o=0;o<=n;o++){let s=t[n][o];for(let r=0;r<o;r++)s-=e[n][r]*e[o][r];
e[n][o]=n===o?Math.sqrt(Math.max(s,1e-7)):s/e[o][o]}return e}var Sy=12,My=80,Ty=11,Ay=new Set(["path","views","ghost","beam"]),ca="This figure has no such tool: bayesmap app has it";async function jp(t){return JSON.parse(
new TextDecoder().decode(await Qn(ht(t))))}function Ey(t,e){let n=Pp(t,e),{seed:o,noise:s,angles:r,sensors:i}=t,a=i.map(({id:c})=>mn(o,c,Ty)),l=n.map((c,h)=>t.readings===
"exact"?c:c+s*gr(a[Math.floor(h/r)],2*(h%r)));return{exact:n,readings:l}}function Py({method:t,prior:e},{rare_walls:n}){return t!=="auto"?t:Math.min(e,1-e)<=n?"\
block":"gibbs"}function Vp(t,e=n=>setTimeout(n)){let{limits:n,judging:o}=t,s=new fr(t.document),[r,i]=[0,0],[a,l,c]=[!0,!1,!1],h={layer:"mean",chain:0,draw:null},
u="live",d=null,[m,y]=[!1,!1],[M,b]=[0,0],x=null,k=(P,_)=>U.onmessage({type:"status",text:P,level:_},{}),A=()=>U.onmessage({type:"state",document:s.present,generation:r,
seq:i,can_undo:s.canUndo,can_redo:s.canRedo,live:a,running:l,working:c,draws:!c&&d?.draws||{chains:0,count:0},scan:0,view:h},{}),E=(P=!1)=>{d&&(b=performance.now(),
U.onmessage(...d.picture(h,r,Math.round(b-M),P)))};function D(){if(m=!1,y||!c)return;let P=!d;d??=O(),u!=="clear"&&d.work(Sy);let _=d.done||u==="clear";(P||_||performance.
now()-b>My)&&E(),_?(l=c=!1,A()):L()}function L(){m||e(D),m=!0}function O(){let P=s.present,{sensors:_,max_range:B}=P,I=Ep(P),{exact:ie,readings:K}=Ey(P,I),J=Float64Array.
from(_.flatMap(({x:de,y:he,yaw:ae})=>[de,he,ae])),Q=de=>Float32Array.from(de),q={pose:J,angles:Q(ts(P)),ranges:Q(K),exact:Q(ie),hit:Uint8Array.from(ie,de=>de<B?
1:0)};x=q,U.onmessage({type:"scan",generation:r,ids:_.map(({id:de})=>de),index:null},q);let W=_p(P,I,K),fe=Py(P,t);return u==="clear"?new _o(P,W):fe==="importan\
ce"?new Mr(P,W,o):new ns(P,W,o,fe==="block")}function G(P=a?"live":"clear"){r++,u=P,d=null,l=u==="run",c=!0,M=performance.now(),A(),L()}function te(){if(!c)return A();
if(!d)return G("clear");l=c=!1,E(!0),A()}function X(P){if(P)return s.push(Yi(P,t.document,n),{type:"hello"}),G();if(!r)return G();A(),E()}function $(P){let{sensors:_,
angles:B}=s.present,I=Math.max(0,_.findIndex(he=>he.id===P)),{x:ie,y:K,yaw:J}=_[I],Q=[I*B,(I+1)*B];if(!x||y)return;let{modes:q,pose:W,weight:fe,nats_per_beam:de}=Hp(
s.present,x.ranges.subarray(...Q),x.hit.subarray(...Q));U.onmessage({type:"where",picture:r,sensor:_[I].id,index:null,pose:[ie,K,J],modes:q,p_lost:0,nats_per_beam:de,
trouble:""},{pose:W,weight:fe})}function ee(P){switch(P.type){case"hello":return X(P.document);case"run":{u==="live"&&c&&(d??=O());let ie=d instanceof ns?d:null;
G("run"),ie?.goOn(s.present.sweeps),d=ie;return}case"cancel":return te();case"live":return a=P.on,l?A():a?G():te();case"view":return h={layer:P.layer,chain:P.chain??
h.chain,draw:P.draw??null},A(),E(!c);case"undo":case"redo":return s.step(P.type==="undo")?G():(k(`nothing to ${P.type}`,"info"),A());case"export":{if(P.what!=="\
document")throw new Ye(ca);let ie=new TextEncoder().encode(`${JSON.stringify(s.present,null,1)}
`);return U.onmessage({type:"download",name:"document.json",mime:"application/json",note:""},{data:ie})}case"clear":if(P.what==="inference")return G("clear")}let _=np(
s.present,P,n);if(!_)throw new Ye(ca);let[B,I]=_;s.push(B,P),I&&k(I,"warning"),G()}let U={...cn(),open:()=>{U.onmessage({type:"welcome",version:1,limits:n,recorded:!1,
figure:!0,lacks:[],story:t.story},{}),U.onmessage({type:"worker",state:"ready"},{}),U.onstatus({connected:!0})},send:P=>{if(P.type!=="painted"){if(P.type==="ins\
pect"){let _=d?.beamsThrough(P.x*s.present.grid.shape[1]+P.y);if(_===void 0)return;let B={beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,
chain:null,prior_nats:null,log_odds:null};return U.onmessage({type:"cell",x:P.x,y:P.y,each:!1,beams:_,...B},{})}if(P.type==="where")return e(()=>$(P.sensor));if(Ay.
has(P.type))return k(ca,"warning");i=P.seq??i;try{ee(P)}catch(_){if(!(_ instanceof Ye))throw _;if(P.type==="hello")return U.onmessage({type:"error",text:_.message,
remedy:"",seq:i},{});k(_.message,"warning"),A()}}},record:()=>d&&x&&d.recording(x),close:()=>{y=!0}};return U}var ha=250,_y=8e3;function zp(t){let e=null,n=ha,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),c=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{c=!0,n=ha,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...hn(h))},l.onclose=()=>{if(s||e!==l)return;o=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),c||Cy(t()).then(u=>u&&e===l&&i.onstatus({...h,refused:u})),n=Math.min(_y,2*n)}}let i={...cn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},read:(a,l)=>new Promise((c,h)=>{let u=new URL("open",t());u.search=t().search,u.searchParams.set("name",a.name);let d=new XMLHttpRequest;d.open("POST",u),d.
responseType="arraybuffer",d.upload.onprogress=({loaded:m,total:y})=>l(m/y),d.onload=()=>d.status===200?c(d.response):h(new Error(new TextDecoder().decode(d.response))),
d.onerror=()=>h(new Error("the connection is lost")),d.send(a)}),retry:()=>{n=ha,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};
return i}async function Cy(t){try{return(await fetch(t.pathname+t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Yp(t){let e=(o,s=[])=>n.onmessage(o,za(o,s)),n={...cn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var Ly="This is the map that was drawn here when the connection was lost; undo leads back",qp=()=>!("DecompressionStream"in window&&"adoptedStyleSheets"in document),
Kp="This page needs a newer browser: Safari 16.4, Firefox 121, Chrome 111, or later.",Ar=t=>Object.assign(window,{bayesmap:t}),pv={render({model:t,el:e}){let n=document.
createElement("div");if(e.append(n),qp())return void(n.textContent=Kp);let o=es(n,Yp(t),{embedded:!0});return Ar(o),()=>o.destroy()}};function Jp(t,e){let n=es(
t,us(e),{play:pa(t,()=>n)});Ar(n)}var pa=(t,e)=>n=>{e().destroy(),Jp(t,n)};async function Ny(){let t=document.querySelector("[data-bayesmap]");if(!t||t.shadowRoot)
return;if(qp())return void(t.textContent=Kp);let e=new CSSStyleSheet;e.replaceSync("body { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector(
"script[data-recording]");if(n){Jp(t,await ds(n.textContent??""));return}let o=document.querySelector("script[data-figure]");if(o){let[{document:h,damaged:u},d]=await Promise.
all([Oo(),jp(o.textContent??"")]),m=u?{text:Io,level:"error"}:null,y=es(t,Vp(d),{adopt:h,notice:m,play:pa(t,()=>y)});Ar(y);return}Sl(new URLSearchParams(location.
search).get("token"));let{document:s,damaged:r}=await Oo(),i=s?null:xl(),a=zp(()=>new URL(location.href));Ml(h=>{history.replaceState(null,"",`${location.pathname}\
?token=${encodeURIComponent(h)}${location.hash}`),a.retry?.()});let c=es(t,a,{adopt:s??i,notice:r?{text:Io,level:"error"}:i?{text:Ly,level:"info"}:null,play:pa(
t,()=>c)});Ar(c)}Ny();export{pv as default,Vp as localTransport,es as mount,jp as readFigure,ds as readRecording,us as recordedTransport,zp as webSocketTransport,Yp as widgetTransport};
