// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function yt(t,e){let n=new Uint8Array(e);for(let s=0;s<e;s++)n[s]=t[s>>3]>>7-(s&7)&1;return n}function Jn(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function it(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function xn(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Na(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Xn=t=>Na(t,new DecompressionStream("deflate-raw")),Ra=t=>Na(t,new CompressionStream("deflate-r\
aw"));async function $a(t){let e=await Ra(new TextEncoder().encode(JSON.stringify(t)));return"#m="+xn(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function fu(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Xn(it(e[1]))))}var Ds="The link's map cannot be read: copy the link again, who\
le";async function Ns(){let t=await fu(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var Wr={uint8:Uint8Array,uint32:Uint32Array,float32:Float32Array,float64:Float64Array},Fa=8,rn=()=>({onmessage:()=>{},onstatus:()=>{}});function Zn(t){let e=new DataView(
t).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),s={},o=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let l=a.reduce((c,h)=>c*
h,1)*Wr[i].BYTES_PER_ELEMENT;s[r]=new Wr[i](t.slice(o,o+l)),o+=Math.ceil(l/Fa)*Fa}return[n,s]}function Ia(t,e){let n={};return(t.buffers??[]).forEach(({name:s,dtype:o},r)=>{
let{buffer:i,byteOffset:a,byteLength:l}=e[r];n[s]=new Wr[o](i.slice(a,a+l))}),n}async function so(t){let e=await Xn(it(t));return Zn(e.buffer)}function Oa([t,e]){let{document:n,ids:s,log_joint:o}=t,{chains:r,count:i,bits:a}=t.draws,l=n.grid.
shape[0]*n.grid.shape[1],c=n.source.kind!=="simulation",h=1,d={chains:r,count:i},u=0,m={layer:"mean",chain:0,draw:null},b=(N,L=N.length===0)=>{let O=N.length/s.
length;return c&&!L?N.slice(u*O,(u+1)*O):N},w=()=>s[u]-1,S=(N=0)=>{let L={generation:h,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1,scan:w()};_.onmessage(
{type:"state",document:n,seq:N,...L,draws:d,view:m},{})},M=()=>{let{pose:N,angles:L,ranges:O,exact:G,hit:te}=e,J=L.length<O.length,$={pose:b(N),angles:b(L,J),ranges:b(
O),exact:b(G),hit:b(te)};_.onmessage({type:"scan",generation:h,ids:c?[s[u]]:s,index:c?w():null},$)},k=N=>{let L=a?Math.ceil(l/8):l,O=e.draws.slice(N*L,(N+1)*L);
return a?yt(O,l).map(G=>255*G):O},E=()=>{let{p:N,width:L,reached:O,trace:G,traced:te,weights:J}=e,$=Math.min(i-1,m.draw??i-1),ee=m.layer==="draw"&&!i||m.layer===
"width"&&!L?"mean":m.layer,U=ee==="draw"?{chain:m.chain,draw:$,log_joint:o[m.chain][$]}:{},A=ee==="draw"?k(m.chain*i+$):ee==="width"?L:N;_.onmessage({...t.field,
layer:ee,...U},{p:A,reached:O,trace:G,traced:te,...J&&{weights:J}})},_={...rn(),open:()=>_.onstatus({connected:!0}),send:N=>{if(N.type==="hello"){let L=[...i?[]:
["draw"],...e.width?[]:["width"]];_.onmessage({type:"welcome",version:1,limits:null,recorded:!0,figure:!1,lacks:L,story:null},{}),S(N.seq),M(),e.trajectory&&_.onmessage(
{type:"overlay",generation:h},{strokes:e.strokes,trajectory:e.trajectory}),E()}else if(N.type==="view")m={layer:N.layer,chain:N.chain??m.chain,draw:N.draw??null},
S(N.seq),E();else if(N.type==="scan"){let L=s.map(O=>Math.abs(O-1-N.index));u=L.indexOf(Math.min(...L)),S(N.seq),M()}else if(N.type==="inspect"){let{x:L,y:O}=N,
G=e.beams[L*n.grid.shape[1]+O];_.onmessage({type:"cell",x:L,y:O,each:!1,beams:G,beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,chain:null,
prior_nats:null,log_odds:null},{})}},close:()=>{}};return _}async function mu(t,e){let n=new TextDecoder,s=t.stream().getReader(),[o,r]=["",0];for(let i=await s.read();!i.done;i=await s.read())o+=n.decode(i.value,{stream:!0}),
e((r+=i.value.length)/t.size);return o}async function gu(t,e,n,s){try{let o=await n(t,r=>e.say(r<1?`Reading ${t.name}: ${Math.round(100*r)} %`:`Reading ${t.name}\
: making its picture`));s(Zn(o))}catch(o){e.say(`${t.name} cannot be shown: ${o.message}`,"error")}}async function Ua(t,e,n){let{name:s}=t;if(s.endsWith(".nc")&&
e.transport.read&&n)return gu(t,e,e.transport.read,n);if(!/\.(html|json)$/.test(s))return e.say(`${s} is not read in the page: start bayesmap app with it`,"warn\
ing");try{let o=await mu(t,i=>e.say(`Reading ${s}: ${Math.round(100*i)} %`)),r=/data-recording>(.*?)<\/script>/s.exec(o)?.[1];r&&n?n(await so(r)):s.endsWith(".j\
son")&&!e.recorded?e.bring(JSON.parse(o)):e.say(`${s} holds nothing that can be shown here`,"warning")}catch{e.say(`${s} cannot be read: export it again, whole`,
"error")}}var le=(t,e,n)=>Math.min(n,Math.max(e,t)),Vt=({x:t,y:e},[n,s])=>t>=0&&e>=0&&t<n&&e<s,Le=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Gr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function vn(t,e){let{x:n,y:s}=Le(t,e);return{x:Math.floor(n),y:Math.floor(s)}}var Qn=(t,e)=>Gr({x:t.x+.5,y:t.y+.5},e);
function Ba(t,e){let n=[],s=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let o=0;o<=s;o++){let r=s?o/s:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Wa(t,[e,n]){let s=new Path2D,o=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&o(r-1,i)!==o(r,i);l&&a<0&&(a=i),!l&&a>=0&&(s.moveTo(r,a),s.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&o(i,r-1)!==o(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(s.moveTo(a,r),s.lineTo(i,r),a=-1)}return s}var Rs=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Ga(t,e,n){let s=za(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),o=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Va(t,(r,i,a)=>e[a]||s.includes(a)?-1/0:o(r,i))}function Ha(t,e){
let n=yu(e,t.grid.shape),s=za(t);return Va(t,(o,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let l of s)a=Math.min(a,Math.hypot(o-l.x,r-l.y));return a>0?a:-1/0})}
var za=({sensors:t,grid:e})=>t.map(n=>vn(n,e));function Va(t,e){let[n,s]=t.grid.shape,o=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<s;a++){let l=e(i,a,i*s+a);
l>r&&([o,r]=[{x:i,y:a},l])}return o&&Qn(o,t.grid)}function yu(t,[e,n]){let s=new Uint16Array(e*n),o=(r,i)=>r<0||i<0||r>=e||i>=n?0:s[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)s[r*n+i]=t[r*n+i]?0:1+Math.min(o(r-1,i-1),o(r-1,i),o(r-1,i+1),o(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(o(r+1,i+1),o(r+1,i),
o(r+1,i-1),o(r,i+1));s[r*n+i]=Math.min(s[r*n+i],a)}return s}var oo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Vt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,s,o){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(c=>vn(c,r.grid)):[],l=new Map;for(let c of e)!Vt(c,i)||this.isWall(c)===n||a.some(h=>h.x===
c.x&&h.y===c.y)||l.set(c.x*i[1]+c.y,[c.x,c.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:s},o)}moveSensor(e,n,s,o){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:s},o)}addSensor(e){let{session:n}=this,{document:s}=n;
if(!s)return;let o=e==="where there is room"?Ha(s,n.walls):"world"in e?e.world:Ga(s,n.walls,e.near),r=n.limits?.sensors[1]??1/0;o?s.sensors.length>=r?n.say(`The\
re can be ${r} sensors at most.`,"warning"):this.refuses(o)||(n.act({type:"add_sensor",x:o.x,y:o.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=
Math.max(0,...s.sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"\
remove_sensor",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let s=vn(e,n.document.grid),o=this.isWall(s);return!o&&Vt(s,n.shape)?(n.status.text.
startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(o?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var At=new Set(["pan","path","look","where","ghost","evidence"]),bu=120,ro=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.decisions.showPath(e==="path"||e==="pan"||!At.has(e)),this.session.ghost.hold(
e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&Vt(e,this.session.
shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(
e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.
cursor&&this.announce(this.describe(e))},bu))}};var Qe={left:36,right:12,top:34,bottom:26},wu=60,xu=160,es=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,s){[
this.width,this.height,this.ratio]=[e,n,s]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let s={x:this.width-Qe.left-Qe.right,y:this.height-Qe.
top-Qe.bottom},o=Math.max(.05,Math.min(s.x/e,s.y/n));o*this.ratio>4&&(o=Math.floor(o*this.ratio)/this.ratio),this.transform.scale=o,this.corner={x:Qe.left+(s.x-
o*e)/2,y:Qe.top+(s.y-o*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,s){let{scale:o}=this.transform,{x:r,
y:i}=this.corner,a=le(o*e,Math.min(this.width,this.height)/Math.max(...s)/3,xu),l=a/o;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(s)}pan(e,n,s){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(s)}toGrid(e,n){let{scale:s,x:o,y:r}=this.transform;return{x:(e.
x-o)/s,y:n-(e.y-r)/s}}fromGrid(e,n){let{scale:s,x:o,y:r}=this.transform;return{x:o+e.x*s,y:r+(n-e.y)*s}}settle([e,n]){let{scale:s}=this.transform,o=wu;this.corner.
x=le(this.corner.x,o-e*s,this.width-o),this.corner.y=le(this.corner.y,o-n*s,this.height-o),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var io=new Set(["path","look","evidence"]);function ao(t,e,n,s){if(e.tool==="path")return t.decisions.point(s);if(e.tool==="evidence"&&t.document){let{x:h,y:d}=Le(
s,t.document.grid);return t.evidence.pin({x:Math.floor(h),y:Math.floor(d)})}let o=t.decisions.nearest(s),{views:r}=t.decisions;if(o===null||!r)return;let[i,a,l]=r.
pose.subarray(3*o,3*o+3),c=`${r.nats[o].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${c}`)}var Ka=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W","where am I","located"],["O, V","ghost, evidence of beams","as\
ked"],["arrows","move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["S\
pace","at the cursor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, De\
lete","add, remove a sensor","drawn"],["R, Escape","run, cancel","inferred"],["Escape","take a path off the map","asked"],["M, N, H","show the mean, a draw, the\
 entropy or the width"],["Ctrl+Z, Ctrl+Y","undo, redo","edited"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],vu={ArrowLeft:[-1,0],ArrowRight:[1,0],
ArrowUp:[0,1],ArrowDown:[0,-1]},ja=Math.PI/12,lo=class{constructor(e,n,s,o,r){this.canvas=e;this.session=n;this.view=s;this.hand=o;this.editor=r;e.addEventListener(
"keydown",i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,o.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){
let{session:n,hand:s,editor:o}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=vu[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?ja:-ja;s.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&
s.sensor&&o.moveSensor(s.sensor,{yaw:s.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key===
"Backspace")&&n.editable)o.removeSensor();else if(e.key==="Escape"&&s.cursor)s.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.
editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:s,view:o,hand:r}=this,[i,a]=s.shape;if(r.tool==="ghost"&&
s.ghost.pose&&s.document){let{resolution:l}=s.document.grid,{x:c,y:h}=s.ghost.pose;s.ghost.move({x:c+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&
r.sensor&&s.document&&s.editable){let{resolution:l}=s.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.
tool==="pan"&&s.editable)o.pan(-40*e,40*n,s.shape),s.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},c={x:le(l.x+e,0,i-1),y:le(l.y+n,0,a-1)};
r.setCursor(c);let h=o.fromGrid({x:c.x+.5,y:c.y+.5},a),d=(m,b,w)=>m-le(m,b,w),u={x:d(h.x,Qe.left+10,o.width-20),y:d(h.y,20,o.height-Qe.bottom-10)};(u.x||u.y)&&o.
pan(-u.x,-u.y,s.shape)}}space(e){let{session:n,hand:s,editor:o}=this;if(io.has(s.tool)&&n.document){s.cursor?ao(n,s,o,Qn(s.cursor,n.document.grid)):this.arrow(0,
0);return}if(n.editable){if(s.tool==="sensor"||s.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===s.sensor?.id);s.select(r[(i+1)%Math.max(1,
r.length)]?.id??null),s.selected!==null&&s.announce(`Sensor ${s.selected}`)}else if(!At.has(s.tool)){s.cursor||this.arrow(0,0);let r=s.cursor,i=s.tool==="draw"&&
!o.isWall(r);o.setWalls([r],i,s.nextGesture(),e),s.announce(i?"wall":"free")}}}},$s={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",
v:"evidence"},Ya={m:"mean",n:"draw",h:"entropy"},qa={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function Ja(t,e,n){let s=t.composedPath()[0],o=s instanceof
HTMLSelectElement||s instanceof HTMLInputElement&&/number|text/.test(s.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(o||r!=="z"&&r!=="y"||
e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}if(!(o||t.altKey)){if($s[r]&&(At.has($s[r])?e.answers||$s[r]==="wher\
e"&&e.locates||$s[r]==="pan"&&e.editable:e.editable))n.tool($s[r]);else if(Ya[r])n.layer(r==="h"&&e.quantity.interval?"width":Ya[r]);else if(qa[t.key])n.command(
qa[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"run"});else if(t.key==="Escape"&&e.decisions.start&&e.decisions.pathShown)e.decisions.forgetPath();else if(t.
key==="Escape"&&(e.running||e.working))e.act({type:"cancel"});else return;t.preventDefault()}}var co=class{paints={};sheets;constructor(e,n){this.sheets=e.map((s,o)=>({layer:s,canvas:n[o],context:n[o].getContext("2d"),before:[]}));for(let{name:s}of e)this.
paints[s]=0}paint(e){let{width:n,height:s,ratio:o,transform:r}=e.view;if(!n||!s)return;let i={width:Math.max(1,Math.ceil(n*o)),height:Math.max(1,Math.ceil(s*o))},
a=[e.look.theme,n,s,o,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:c,context:h,layer:d}=l,u=d.shows?.(e)??!0,m=[u,...u?[...a,...d.depends(e)]:[]];m.length===
l.before.length&&m.every((b,w)=>Object.is(b,l.before[w]))||(l.before=m,c.style.visibility=u?"":"hidden",u&&((c.width!==i.width||c.height!==i.height)&&(Object.assign(
c,i),c.style.width=`${i.width/o}px`,c.style.height=`${i.height/o}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,c.width,c.height),h.setTransform(o,0,0,o,0,0),
h.save(),d.paint(h,e),h.restore(),this.paints[d.name]++))}}};function Ie(t,{session:e,view:n}){let[s,o]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,s*r,o*r),t.clip()}function kn(t,{halo:e},n,s){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=s,t.strokeStyle=n,t.stroke()}var ho='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Kt(t,e,n,s,o,r,i=!1){t.font=ho,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=o.halo,t.lineWidth=3,t.strokeText(e,n,s)),t.fillStyle=o.axis,t.fillText(e,n,s)}var Hr=8,ts=class{constructor(e,n,s,o){this.context=e;
this.theme=n;this.width=s;this.height=o}placed=[];place(e,n,s,o){this.context.font=ho;let r=this.context.measureText(e).width/2+2,i=Math.min(Math.max(n,r),this.
width-r),a=[[i,s-o-9],[i,s+o+9],[n+o+r+4,s],[n-o-r-4,s]],l=([d,u])=>d-r>=0&&d+r<=this.width&&u>=Hr&&u<=this.height-Hr,c=([d,u])=>this.placed.every(m=>Math.abs(d-
m.x)>=r+m.half||Math.abs(u-m.y)>=2*Hr),h=a.find(d=>l(d)&&c(d));return h&&this.placed.push({text:e,x:h[0],y:h[1],half:r}),!!h}write(){for(let{text:e,x:n,y:s}of this.
placed)Kt(this.context,e,n,s,this.theme,"center",!0)}};function zr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(s,o)=>o).map(s=>({id:s,x:e.pose[3*s],y:e.
pose[3*s+1],yaw:e.pose[3*s+2]})):[]}function an(t,e,n){let s=n.fromGrid(Le(t,e),e.shape[1]),o=le(n.transform.scale*.42,7,13),r=o*2.6,i={x:s.x+r*Math.cos(t.yaw),
y:s.y-r*Math.sin(t.yaw)};return{point:s,size:o,handle:i}}function Xa(t,{session:e,view:n,look:s}){let o=e.document;if(!o)return;let{theme:r}=s,i=zr(e);t.lineJoin=
"round";for(let a of i){let l=an(a,o.grid,n),{point:c,size:h}=l;a.id===s.selected&&ku(t,l,s);let[d,u]=[Math.cos(a.yaw),-Math.sin(a.yaw)],m=(b,w)=>[c.x+h*(b*d-w*
u),c.y+h*(b*u+w*d)];t.beginPath(),t.moveTo(...m(1.25,0)),t.lineTo(...m(-.9,.8)),t.lineTo(...m(-.45,0)),t.lineTo(...m(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Kt(t,String(a.id),c.x,c.y+h*2+4,r,"center",!0)}}function ku(t,{point:e,size:n,handle:s},{
theme:o}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(s.x,s.y),t.moveTo(s.x+4.5,s.y),t.arc(s.x,s.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),kn(t,o,o.sensor,1.5),t.beginPath(),t.arc(s.x,s.y,4,0,2*Math.PI),t.fillStyle=o.halo,t.fill()}function Za(t,e,n,s,o){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&an({id:0,...t.pose},s,o);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Qa(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var el={touch:24,other:11},Su=5,Mu=90,po=class{constructor(e,n,s,o,r,i){this.canvas=e;this.session=n;this.view=s;this.hand=o;this.editor=r;this.embedded=i;let a=(l,c)=>e.
addEventListener(l,c,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{o.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return Gr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:s}=this,
{document:o}=n;if(!o)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",s.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&s.tool==="ghost")return this.begin(Za(n.ghost,r,this.reach(e),o.grid,this.view)),this.dragGhost(e);if(e.button===0&&io.has(s.tool))return this.
begin({kind:"pick",first:r});let i=s.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,o):null;if(i?.kind==="sensor")return s.select(i.id),this.begin(i);
if(e.button===1||At.has(s.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,o);if(a)this.begin(a),a.kind==="sensor"&&s.select(a.id);else if(s.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,o)}):s.sensor&&(s.selected=s.sensor.id,this.begin({kind:"sensor",id:s.sensor.id,drag:s.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let l=s.tool==="draw"!==(e.button===2||e.shiftKey),c=this.cellAt(r),h=l&&this.editor.isWall(c);this.begin({kind:"strok\
e",id:s.nextGesture(),wall:l,last:c,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Mu)}}gripAt(e,n,s){let{hand:o,view:r}=this,
i=this.reach(n),a=u=>Math.hypot(e.x-u.x,e.y-u.y),l=o.tool==="sensor"&&o.sensor?an(o.sensor,s.grid,r):null;if(l&&o.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:o.sensor.id,drag:o.nextGesture()};if(n.button!==0||o.tool==="erase")return null;let c=s.sensors.map(u=>({id:u.id,...an(u,s.grid,r)}));c.sort((u,m)=>a(
u.point)-a(m.point));let h=c.find(({point:u,size:m})=>a(u)<Math.max(i,m));if(!h)return null;let d={x:h.point.x-e.x,y:h.point.y-e.y};return{kind:"sensor",id:h.id,
drag:o.nextGesture(),grip:d}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:s,view:o,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let c of l.
length?l:[e]){let h=this.cellAt(this.at(c));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(...Ba(n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=s.document?.sensors.find(c=>c.id===n.id);if(!a||!s.document)return;let l=this.metres(i,s.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>Su&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")o.pan(i.x-n.last.x,i.y-n.last.y,s.shape),n.last=i,s.changed();else if(this.fingers.size===2){let{middle:a,spread:l}=this.spread();
o.pan(a.x-n.middle.x,a.y-n.middle.y,s.shape),o.zoom(l/n.spread,a,s.shape),Object.assign(n,{middle:a,spread:l}),s.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&ao(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?el.touch:el.other}pointAtReading(e){let{document:n,reading:s,ghost:o}=this.
session;if(!n||o.held)return;let r=n.grid.resolution/this.view.transform.scale;s.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:s}=this;
if(n?.kind!=="ghost"||!s.document)return;this.hand.point(null);let o=this.at(e);Qa(s.ghost,n,this.metres({x:o.x+n.grip.x,y:o.y+n.grip.y},s.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let s=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-s*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-s*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:s,gesture:o}=this;o?.kind==="stroke"&&(this.editor.setWalls(e,o.wall,o.id,n),s.status.level==="error"&&s.say("Ready"))}dragSensor(e){
let{gesture:n,session:s}=this,{document:o}=s;if(n?.kind!=="sensor"||!o)return;this.hand.point(null);let r=o.sensors.find(l=>l.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},o);r&&this.editor.moveSensor(r,a,n.drag,e)}};var Tu=5,uo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:s,look:o}){
let{theme:r}=o;e.beginPath(),e.rect(Qe.left,0,s.width,s.height-Qe.bottom),e.clip(),o.hover&&tl(e,o.hover,n.shape[1],s,r,r.axis,1.5),o.cursor&&tl(e,o.cursor,n.shape[1],
s,r,r.ray,2.5)}};function tl(t,e,n,s,o,r,i){let{scale:a}=s.transform,l=s.fromGrid({x:e.x,y:e.y+1},n),c=Math.max(a,Tu),[h,d]=[l.x-(c-a)/2,l.y-(c-a)/2];t.lineWidth=
i+2,t.strokeStyle=o.halo,t.strokeRect(h,d,c,c),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,d,c,c)}var Au={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Eu={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},go={light:Au,dark:Eu},nl="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function Pu([t,e,n]){let s=(t+16)/116,o=[.95047,1,1.08883],[r,i,
a]=[s+e/500,s,s-n/200].map((l,c)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*o[c]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let c=le(l,0,1);return Math.round(255*(c<=.0031308?12.92*c:1.055*c**(1/2.4)-.055))})}var fo=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),mo=(t,e,n)=>t.map((s,o)=>s+n*(e[o]-s)),Vr=(t,e)=>Pu(mo(t.paper,t.ink,e));function ns(t){let e=Math.min(15,Math.floor(
t*16));return mo(fo(nl,6*e),fo(nl,6*e+6),t*16-e)}function sl(t,e){let n=new Uint8ClampedArray(17408).fill(255),[s,o]=[fo(t.unobserved),fo(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?Rs(r/255):r/255,a=e==="value"?Vr(t,r/255):ns(i),l=e==="value"?mo(s,o,r/255):a;for(let c=0;c<=16;c++)n.set(mo(l,a,c/16),4*(r+256*c))}
return new Uint32Array(n.buffer)}var jr=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;function v(t,e={},...n){let s=document.createElement(t);for(let[o,r]of Object.entries(e))o.startsWith("on")?s.addEventListener(o.slice(2),r):o.includes("-")||o===
"role"||o==="for"?s.setAttribute(o,r):s[o]=r;for(let o of n)o!==null&&s.append(o);return s}function C(t,e,n){t[e]!==n&&(t[e]=n)}function et(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var Sn=t=>t.getRootNode().activeElement===t,we=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function Yr(t,e){let n=URL.
createObjectURL(e);v("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var _u=9,Cu=2.5,ss=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start&&e.pathShown||e.looking&&e.views))}paint(e,n){let{session:s}=n;if(!s.document)return;let o=new ts(e,n.look.theme,n.view.width,n.view.height);
e.save(),Ie(e,n),s.decisions.looking&&this.views(e,n,o),s.decisions.pathShown&&this.path(e,n,o),e.restore(),o.write()}views(e,{session:n,view:s,look:o},r){let{views:i}=n.
decisions,a=n.document?.grid;if(!i?.nats.length||!a)return;let l=Math.max(...i.nats),c=le(.38*i.spacing*s.transform.scale/a.resolution,Cu,_u),h=i.nats.indexOf(l);
for(let d=0;d<i.nats.length;d++){let u=s.fromGrid(Le({x:i.pose[3*d],y:i.pose[3*d+1]},a),a.shape[1]);e.beginPath(),e.arc(u.x,u.y,c,0,2*Math.PI),e.fillStyle=`rgb(${ns(
le(i.nats[d]/Math.max(l,1e-9),0,1)).map(Math.round)})`,e.fill(),d===h&&(e.lineWidth=2.5,e.strokeStyle=o.theme.truth,e.stroke(),r.place(`${we(l,1)} nats`,u.x,u.y,
c))}}path(e,{session:n,view:s,look:o},r){let{start:i,goal:a,path:l,radius:c}=n.decisions,h=n.document?.grid;if(!h||!i)return;let d=u=>s.fromGrid(Le(u,h),h.shape[1]);
if(l){e.beginPath();for(let[u,m]of l.path){let b=d({x:u,y:m});e.lineTo(b.x,b.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=l.within_risk?o.theme.sensor:o.theme.
truth,e.globalAlpha=.3,e.lineWidth=2*c*s.transform.scale/h.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let u of a?[i,a]:[i]){let{x:m,y:b}=d(
u);e.beginPath(),e.arc(m,b,5,0,2*Math.PI),e.fillStyle=u===i?o.theme.sensor:o.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=o.theme.halo,e.stroke()}if(l){let u=l.
path.length,[[m,b],[w,S]]=[l.path[u-1>>1],l.path[u>>1]],M=d({x:(m+w)/2,y:(b+S)/2});r.place(`${we(l.length_m,1)} m, free with probability ${we(l.probability,3)}`,
M.x,M.y,4)}else a&&n.decisions.trouble&&r.place("no path",d(a).x,d(a).y,7)}};var Lu=5,[Du,ol]=[.8,5],Nu=6,yo=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:s,view:o,look:r}=n,{cell:i,each:a}=s.evidence,l=s.document?.grid;if(!i||!l)return;
Ie(e,n);let c=(w,S)=>o.fromGrid(Le({x:w,y:S},l),l.shape[1]),h=w=>[c(a.start[2*w],a.start[2*w+1]),c(a.end[2*w],a.end[2*w+1])],d=a?.nats.length??0;e.lineCap="roun\
d";for(let w=d-1;w>=0;w--){let[S,M]=h(w),k=a.nats[w];e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(M.x,M.y),e.globalAlpha=le(.25+Math.abs(k)/2,0,.9),e.lineWidth=le(ol*
Math.sqrt(Math.abs(k)/Nu),Du,ol),e.strokeStyle=k>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:u}=o.transform,m=o.fromGrid({x:i.x,y:i.y+1},l.
shape[1]),b=Math.max(1,4-u/2);e.beginPath(),e.rect(m.x-b,m.y-b,u+2*b,u+2*b),kn(e,r.theme,r.theme.belief,2);for(let w=Math.min(Lu,d)-1;w>=0;w--){let[S,M]=h(w),k=.35+
.1*w,E={x:S.x+k*(M.x-S.x),y:S.y+k*(M.y-S.y)};Kt(e,os(a.nats[w]),E.x,E.y,r.theme,"center",!0)}}},os=t=>`${t<0?"−":"+"}${Math.abs(t).toFixed(1)}`;var Ru=10,$u=7,Fu=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",bo=()=>document.createElement("canvas").getContext("2d"),rs=class{name="\
field";cells=bo();mask=bo();hatch=bo();palettes=new Map;image=new ImageData(1,1);drawn={field:null,reached:null,palette:"",hatch:""};depends({session:e}){return[
e.flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:s,view:o,look:r}=n;if(!s.document)
return;let[i,a]=s.shape,{scale:l,x:c,y:h}=o.transform;Ie(e,n);let d=s.flicker.under??s.shown;if(!d||d.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
c,h,i*l,a*l);return}this.fill(d,i,a,r.theme,Fu(d,s.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,c,h,i*l,a*l),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/o.ratio,this.hatch.canvas.height/o.ratio),l>=Ru&&this.lines(e,n)}fill(e,n,s,o,r){let{cells:i,mask:a,drawn:l}=this,
c=`${o.ground} ${r}`;if(l.field===e&&l.palette===c)return;let h=this.palettes.get(c)??sl(o,r);if(this.palettes.set(c,h),this.image.width!==n||this.image.height!==
s){this.image=new ImageData(n,s);for(let{canvas:u}of[i,a])Object.assign(u,{width:n,height:s});l.reached=null}let d=new Uint32Array(this.image.data.buffer);for(let u=0,
m=0;u<s;u++)for(let b=s-1-u;b<n*s;b+=s)d[m++]=h[e.p[b]+256*(e.reached[b]+8>>4)];if(i.putImageData(this.image,0,0),l.reached!==e.reached){for(let u=0,m=0;u<s;u++)
for(let b=s-1-u;b<n*s;b+=s)d[m++]=255-e.reached[b]<<24;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,reached:e.reached,palette:c})}fillHatch({
session:e,view:n,look:s}){let{hatch:o,mask:r,drawn:i}=this,{ratio:a,width:l,height:c}=n,{scale:h,x:d,y:u}=n.transform,[m,b]=e.shape,w=[s.theme.ground,h,d,u,l,c,
a].join(" ");if(i.hatch===w)return;i.hatch=w;let S=bo(),M=S.canvas.width=S.canvas.height=Math.round($u*a);S.strokeStyle=s.theme.hatch,S.lineWidth=a,S.beginPath();
for(let E of[-M,0,M])S.moveTo(E-1,M+1),S.lineTo(E+M+1,-1);S.stroke(),Object.assign(o.canvas,{width:Math.ceil(l*a),height:Math.ceil(c*a)}),o.setTransform(a,0,0,a,
0,0),o.imageSmoothingEnabled=!1,o.drawImage(r.canvas,d,u,m*h,b*h),o.globalCompositeOperation="source-in",o.setTransform(1,0,0,1,0,0);let k=o.createPattern(S.canvas,
"repeat");k.setTransform(new DOMMatrix().translate(Math.round(d*a),Math.round(u*a))),o.fillStyle=k,o.fillRect(0,0,o.canvas.width,o.canvas.height)}lines(e,{session:n,
view:s,look:o}){let[r,i]=n.shape,{scale:a,x:l,y:c}=s.transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,c),e.lineTo(l+h*a,c+i*a);for(let h=1;h<i;h++)e.moveTo(
l,c+h*a),e.lineTo(l+r*a,c+h*a);e.strokeStyle=o.theme.lines,e.lineWidth=1,e.stroke()}};var Iu=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],is=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:s}=n.session;if(!(!s.held||!s.pose||!n.session.document)){if(Ie(e,n),s.fan){let o=this.
fan(e,n,s.fan);s.fan.near&&this.near(e,n,s.fan,s.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(o)}this.robot(e,n,s.pose)}}ends({session:e,view:n},s,o,r){let{grid:i,
max_range:a}=e.document;return Array.from(o,(l,c)=>{let h=le(r[c],0,a),d=s.yaw+l,u={x:s.x+h*Math.cos(d),y:s.y+h*Math.sin(d)};return n.fromGrid(Le(u,i),i.shape[1])})}fan(e,n,s){
let{theme:o}=n.look,[r,i,a]=[s.low,s.median,s.high].map(b=>this.ends(n,s,s.angles,b)),{grid:l}=n.session.document,c=n.view.fromGrid(Le(s,l),l.shape[1]),h=new Path2D;
h.moveTo(c.x,c.y);for(let{x:b,y:w}of r)h.lineTo(b,w);h.closePath(),e.fillStyle=o.ghost,e.globalAlpha=.1,e.fill(h);let d=new Path2D,u=new Path2D,m=le(n.view.transform.
scale*.12,1.2,3);for(let b=0;b<r.length;b++)d.moveTo(r[b].x,r[b].y),d.lineTo(a[b].x,a[b].y),Number.isFinite(s.median[b])&&u.rect(i[b].x-m,i[b].y-m,2*m,2*m);return e.
strokeStyle=o.ghost,e.lineCap="round",e.lineWidth=le(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(d),e.globalAlpha=1,u}near(e,n,s,{pose:o,ranges:r,
hit:i}){let{theme:a}=n.look,l=le(n.view.transform.scale*.14,1.5,4),c=this.ends(n,{x:o[0],y:o[1],yaw:o[2]},s.angles,r),h=new Path2D;c.forEach(({x:d,y:u},m)=>{i[m]&&
(h.moveTo(d+l,u),h.arc(d,u,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:s,look:o},r){let{grid:i}=n.document,{point:a,
size:l,handle:c}=an({id:0,...r},i,s),[h,d]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(c.x,c.y),kn(e,o.theme,o.theme.ghost,1.5),
e.beginPath();for(let[u,m]of Iu)e.lineTo(a.x+l*(u*h-m*d),a.y+l*(u*d+m*h));e.closePath(),e.lineJoin="round",kn(e,o.theme,o.theme.ghost,2),e.fillStyle=o.theme.halo,
e.fill(),e.beginPath(),e.arc(c.x,c.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var as=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:s,view:o,look:r}=n,i=s.flicker.under&&s.shown;if(!i)return;let[a,l]=s.shape,
{scale:c,x:h,y:d}=o.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Ie(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,d,a*c,l*c)}fill(e,n,s,o){let[r,i,a]=[1,3,5].map(c=>parseInt(o.slice(c,c+2),16));Object.assign(this.cells.canvas,{width:n,height:s});let l=new ImageData(
n,s);for(let c=0,h=0;c<s;c++)for(let d=s-1-c;d<n*s;d+=s,h+=4)l.data.set([r,i,a,Math.round(e.p[d]*e.reached[d]/255)],h);this.cells.putImageData(l,0,0),this.drawn=
{field:e,colour:o}}};var Ou=46,Uu=22;function Bu(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function rl(t,{session:e,view:n,look:s}){if(!e.document)
return;let{theme:o}=s,{width:r,height:i}=n,{origin:a,resolution:l,shape:c}=e.document.grid,{scale:h,x:d,y:u}=n.transform,m=Bu(Ou/h*l),b=Math.min(u+c[1]*h,i-Qe.bottom)+
.5,w=Math.max(d,Qe.left)-.5;t.fillStyle=o.ground,d<w&&t.fillRect(0,0,w,i+1),u+c[1]*h>b&&t.fillRect(0,b,r+1,i+1-b);let S=Math.max(0,-Math.floor(Math.log10(m)+1e-9));
t.strokeStyle=o.frame,t.lineWidth=1,t.beginPath();let M=E=>Math.ceil(a[E]/m-1e-9)*m,k=E=>a[E]+c[E]*l+1e-9;for(let E=M(0);E<=k(0);E+=m){let _=d+(E-a[0])/l*h;_<w||
_>r-4||(t.moveTo(_,b),t.lineTo(_,b+4),Kt(t,E.toFixed(S),_,b+12,o,"center"))}for(let E=M(1);E<=k(1);E+=m){let _=u+(c[1]-(E-a[1])/l)*h;_>b||_<4||(t.moveTo(w,_),t.
lineTo(w-4,_),Kt(t,E.toFixed(S),w-7,_,o,"right"))}t.stroke(),Kt(t,"m",w-Uu,b+12,o,"right")}var ls=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let s=zr(e).flatMap(({id:i,x:a,y:l,yaw:c})=>[i,a,l,c]),{grid:o}=e.document??{},
r=il(e)&&n.truth&&e.wallsVersion;return[o&&[...o.shape,...o.origin,o.resolution].join(),r,n.selected,...s]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:s,view:o,look:r}=n;if(!s.document)return;let[i,a]=s.shape,{scale:l,x:c,y:h}=o.transform;r.truth&&il(s)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(c-.5,h-.5,i*l+1,a*l+1),Xa(e,n),rl(e,n)}truth(e,n){let{session:s,view:o,look:r}=n,{scale:i,x:a,y:l}=o.transform;this.edgesOf!==s.wallsVersion&&
(this.edges=Wa(s.walls,s.shape),this.edgesOf=s.wallsVersion),e.save(),Ie(e,n),e.transform(i,0,0,-i,a,l+s.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=le(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},il=({document:t})=>t?.source.kind==="simulation";var Wu=600,Gu=1500,Hu=65536,qr=.3,cs=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:s,view:o,look:r}=n,{scan:i,document:a}=s;
if(!i||!a)return;Ie(e,n);let{scale:l}=o.transform,c=1/a.grid.resolution,h=a.grid.shape[1],d=i.angles.length,u=i.pose.length/3,m=Math.ceil(d*u/Gu),[b,w,S]=[new Path2D,
new Path2D,new Path2D],M=d*u>Wu,k=new Map,E=le(l*.1,1.3,4),_=a.scans_used??1/0,N=(i.index??0)<_?1:qr;for(let L=0;L<u;L++){let[O,G,te]=i.pose.subarray(3*L,3*L+3),
J=o.fromGrid(Le({x:O,y:G},a.grid),h);for(let $=0;$<d;$++){let ee=i.ranges[L*d+$],U=i.hit[L*d+$]===1,A=(U?ee:a.max_range)*c*l,P=i.angles[$]+te,B={x:J.x+A*Math.cos(
P),y:J.y-A*Math.sin(P)},I=U?b:w;(L*d+$)%m===0&&(I.moveTo(J.x,J.y),I.lineTo(B.x,B.y)),U&&(M?k.set(Math.round(B.x)*Hu+Math.round(B.y),B):(S.moveTo(B.x+E,B.y),S.arc(
B.x,B.y,E,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=N*le(28/Math.sqrt(d*u/m)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(b),e.strokeStyle=r.theme.
noReturn,e.stroke(w),e.globalAlpha=1),r.readings){e.globalAlpha=N,e.fillStyle=r.theme.ray,e.fill(S);let L=1.8*E;for(let{x:O,y:G}of k.values())e.fillRect(O-L/2,G-
L/2,L,L);e.globalAlpha=1}}};var zu=2.5,Fs=t=>t>=zu,hs=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:s,look:o}=n,{overlay:r,document:i}=s;!r||!i||(Ie(e,n),o.trajectory&&
this.trajectory(e,n,r.trajectory),o.strokes&&Fs(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:s,look:o},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=o.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[c,h,d]of[[0,l,.6],
[Math.max(0,l-1),a,.6*qr]]){e.beginPath();for(let u=c;u<h;u++){let m=s.fromGrid(Le({x:r[2*u],y:r[2*u+1]},i),i.shape[1]);e.lineTo(m.x,m.y)}e.globalAlpha=d,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:s,look:o},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,c,h,d]=r.subarray(a,a+4),[u,
m]=[s.fromGrid(Le({x:l,y:c},i),i.shape[1]),s.fromGrid(Le({x:h,y:d},i),i.shape[1])];e.moveTo(u.x,u.y),e.lineTo(m.x,m.y)}e.strokeStyle=o.theme.ray,e.lineCap="roun\
d",e.lineWidth=le(s.transform.scale/5,.8,2.5),e.stroke()}}};var Vu=2.2,wo=7,[ju,Yu]=[.03,.75],qu=2.4477,al=9,ps=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:s}=n,{found:o}=s.where,r=s.document?.grid;if(!o||!r)return;let i=new ts(
e,n.look.theme,n.view.width,n.view.height);e.save(),Ie(e,n),this.cloud(e,n,r);for(let a of o.modes)this.place(e,n,r,a,i);e.restore(),i.write()}cloud(e,{session:n,
view:s,look:o},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||1;e.strokeStyle=e.fillStyle=o.theme.belief,e.lineWidth=1.2;for(let c=0;c<a.length;c++){if(a[c]<
ju**2*l)continue;let[h,d,u]=i.subarray(3*c,3*c+3),m=s.fromGrid(Le({x:h,y:d},r),r.shape[1]);e.globalAlpha=Yu*Math.sqrt(a[c]/l),e.beginPath(),e.arc(m.x,m.y,Vu,0,2*
Math.PI),e.fill(),e.beginPath(),e.moveTo(m.x,m.y),e.lineTo(m.x+wo*Math.cos(u),m.y-wo*Math.sin(u)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:s},o,r,i){let[
a,l,c]=r.mean,h=n.fromGrid(Le({x:a,y:l},o),o.shape[1]),d=qu*n.transform.scale/o.resolution,[[u,m],[,b]]=r.covariance,[w,S]=[(u+b)/2,Math.hypot((u-b)/2,m)],[M,k]=[
w+S,w-S].map(_=>Math.max(al,d*Math.sqrt(Math.max(_,0))));e.beginPath(),e.ellipse(h.x,h.y,M,k,-Math.atan2(2*m,u-b)/2,0,2*Math.PI);let E=al+1;e.moveTo(h.x+E*Math.
cos(c),h.y-E*Math.sin(c)),e.lineTo(h.x+(E+wo)*Math.cos(c),h.y-(E+wo)*Math.sin(c)),e.strokeStyle=s.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=s.theme.belief,
e.lineWidth=2,e.stroke(),i.place(Kr(r.probability),h.x,h.y,k)}},Kr=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var ll=900,Is=2;function cl({session:t,look:e}){let[n,s]=t.shape,o=new es;o.resize(ll,Math.round(le(ll*s/n,300,1800)),Is),o.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:o.width*Is,height:o.height*Is});let i=r.getContext("2d");i.scale(Is,Is),i.fillStyle=e.theme.ground,i.fillRect(0,0,o.width,o.height);
let a=[new rs,new as,new hs,new cs,new ls,new ss,new ps,new is],l={session:t,view:o,look:{...e,hover:null,cursor:null,selected:null}};for(let c of a)(c.shows?.(
l)??!0)&&(i.save(),c.paint(i,l),i.restore());return new Promise(c=>r.toBlob(c))}var xo=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:s,ghost:o}}){return!!(!o.
held&&e.picked&&n&&s?.index===e.picked.scan)}paint(e,n){let{session:s,view:o,look:r}=n,{picked:i,found:a}=s.reading,{scan:l,document:c}=s;if(!i||!c||l?.index!==
i.scan)return;Ie(e,n);let{grid:h,max_range:d}=c,u=S=>{let M={x:i.from.x+S*Math.cos(i.angle),y:i.from.y+S*Math.sin(i.angle)};return o.fromGrid(Le(M,h),h.shape[1])},
m=(S,M,k,E)=>{e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(M.x,M.y),e.lineWidth=k,e.strokeStyle=E,e.stroke()},b=l.hit[i.beam]===1,w=u(b?l.ranges[i.beam]:d);if(m(u(0),
w,3,r.theme.halo),m(u(0),w,1.5,b?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let S=(M,k)=>le(M??k,0,d);if(m(u(S(a.low,0)),u(S(a.high,d)),6,r.theme.ghost),
a.median!==null){let M=u(a.median),k={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};m({x:M.x-k.x,y:M.y-k.y},{x:M.x+k.x,y:M.y+k.y},2.5,r.theme.ghost)}}b&&(e.beginPath(),
e.arc(w.x,w.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};var hl="bayesmap-token",Jr="bayesmap-kept",pl="bayesmap-tools";function ul(t){try{return localStorage.getItem(t)}catch{return null}}function vo(t,e){try{e===null?
localStorage.removeItem(t):localStorage.setItem(t,e)}catch{}}function Xr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&vo(Jr,JSON.stringify(
t))}function dl(){vo(Jr,null)}function fl(){let t=ul(Jr);try{return t&&JSON.parse(t)}catch{return null}}var ml=()=>ul(pl)!==null,gl=t=>vo(pl,t?"all":null);function yl(t){
t&&vo(hl,t)}function bl(t){let e=n=>{n.key===hl&&n.newValue&&t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",
e)}var Zr=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["where","Where am I?","where"],["path","Path","path"],
["evidence","Evidence","evidence"],["look","Look next","look"],["ghost","Ghost","ghost"]],Ku=5;function wl(t){let{hand:e,session:n}=t,s=t.segmented("Tool",Zr,()=>n.
editable||!n.document||At.has(e.tool)?e.tool:"pan",i=>e.choose(i),i=>(At.has(i)?n.answers||i==="where"&&n.locates:n.editable)||i==="pan");t.visible(s,()=>!n.recorded);
let o=ml(),r=t.button(null,"More tools",()=>{gl(o=!o),n.changed()},{text:"More"});return t.visible(r,()=>n.answers),t.each(()=>{let i=Zr.filter(([l])=>At.has(l)?
!n.figure||l==="pan"||l==="where":!n.document||n.editable).map(([l])=>l),a=new Set(o?i:i.slice(0,Ku));Zr.forEach(([l],c)=>C(s.children[c],"hidden",!a.has(l)&&!(l===
e.tool&&i.includes(l)))),C(r.lastElementChild,"textContent",o?"Fewer":"More"),et(r,"aria-label",o?"Fewer tools":"More tools"),C(r,"title",o?"Fewer tools":"More \
tools: paths, evidence, where to look next, the ghost")}),v("div",{className:"bar"},s,r,v("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command(
"out"),{title:"Zoom out (−)"}),t.button("plus","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Wh\
ole map (0)"}))}var Ju="uplot",Xu="u-hz",Zu="u-vt",Qu="u-title",ed="u-wrap",td="u-under",nd="u-over",sd="u-axis",An="u-off",od="u-select",rd="u-cursor-x",id="u-cursor-y",ad="u-\
cursor-pt",ld="u-legend",cd="u-live",hd="u-inline",pd="u-series",ud="u-marker",xl="u-label",dd="u-value",Us="width",Bs="height";var vl="bottom",us="left",Qr="right",gi="#000",kl=gi+"0",ei="mousemove",Sl="mousedown",ti="mouseup",Ml="mouseenter",Tl="mouseleave",Al="dblclick",fd="resize",md="\
scroll",El="change",Ao="dppxchange",yi="--",ws=typeof window<"u",ii=ws?document:null,fs=ws?window:null,gd=ws?navigator:null,ye,ko;function ai(){let t=devicePixelRatio;
ye!=t&&(ye=t,ko&&ci(El,ko,ai),ko=matchMedia(`(min-resolution: ${ye-.001}dppx) and (max-resolution: ${ye+.001}dppx)`),En(El,ko,ai),fs.dispatchEvent(new CustomEvent(
Ao)))}function bt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function li(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function _e(t,e,n){
t.style[e]=n+"px"}function Rt(t,e,n,s){let o=ii.createElement(t);return e!=null&&bt(o,e),n?.insertBefore(o,s),o}function Et(t,e){return Rt("div",t,e)}var Pl=new WeakMap;
function jt(t,e,n,s,o){let r="translate("+e+"px,"+n+"px)",i=Pl.get(t);r!=i&&(t.style.transform=r,Pl.set(t,r),e<0||n<0||e>s||n>o?bt(t,An):li(t,An))}var _l=new WeakMap;
function Cl(t,e,n){let s=e+n,o=_l.get(t);s!=o&&(_l.set(t,s),t.style.background=e,t.style.borderColor=n)}var Ll=new WeakMap;function Dl(t,e,n,s){let o=e+""+n,r=Ll.
get(t);o!=r&&(Ll.set(t,o),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=s?-e/2+"px":0,t.style.marginTop=s?-n/2+"px":0)}var bi={passive:!0},yd={...bi,
capture:!0};function En(t,e,n,s){e.addEventListener(t,n,s?yd:bi)}function ci(t,e,n,s){e.removeEventListener(t,n,bi)}ws&&ai();function $t(t,e,n,s){let o;n=n||0,s=
s||e.length-1;let r=s<=2147483647;for(;s-n>1;)o=r?n+s>>1:wt((n+s)/2),e[o]<t?n=o:s=o;return t-e[n]<=e[s]-t?n:s}function ic(t){return(n,s,o)=>{let r=-1,i=-1;for(let a=s;a<=
o;a++)if(t(n[a])){r=a;break}for(let a=o;a>=s;a--)if(t(n[a])){i=a;break}return[r,i]}}var ac=t=>t!=null,lc=t=>t!=null&&t>0,_o=ic(ac),bd=ic(lc);function wd(t,e,n,s=0,o=!1){
let r=o?bd:_o,i=o?lc:ac;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(s==1)a=t[e],l=t[n];else if(s==-1)a=t[n],l=t[e];else for(let c=e;c<=n;c++){let h=t[c];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??ke,l??-ke]}function Co(t,e,n,s){let o=$l(t),r=$l(e);t==e&&(o==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Jt:cc,a=o==1?wt:Pt,l=r==1?Pt:wt,
c=a(i(We(t))),h=l(i(We(e))),d=ms(n,c),u=ms(n,h);return n==10&&(c<0&&(d=Se(d,-c)),h<0&&(u=Se(u,-h))),s||n==2?(t=d*o,e=u*r):(t=dc(t,d),e=Lo(e,u)),[t,e]}function wi(t,e,n,s){
let o=Co(t,e,n,s);return t==0&&(o[0]=0),e==0&&(o[1]=0),o}var xi=.1,Nl={mode:3,pad:xi},Gs={pad:0,soft:null,mode:0},xd={min:Gs,max:Gs};function Eo(t,e,n,s){return Do(
n)?Rl(t,e,n):(Gs.pad=n,Gs.soft=s?0:null,Gs.mode=s?3:0,Rl(t,e,xd))}function me(t,e){return t??e}function vd(t,e,n){for(e=me(e,0),n=me(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Rl(t,e,n){let s=n.min,o=n.max,r=me(s.pad,0),i=me(o.pad,0),a=me(s.hard,-ke),l=me(o.hard,ke),c=me(s.soft,ke),h=me(o.soft,-ke),
d=me(s.mode,0),u=me(o.mode,0),m=e-t,b=Jt(m),w=at(We(t),We(e)),S=Jt(w),M=We(S-b);(m<1e-24||M>10)&&(m=0,(t==0||e==0)&&(m=1e-24,d==2&&c!=ke&&(r=0),u==2&&h!=-ke&&(i=
0)));let k=m||w||1e3,E=Jt(k),_=ms(10,wt(E)),N=k*(m==0?t==0?.1:1:r),L=Se(dc(t-N,_/10),24),O=t>=c&&(d==1||d==3&&L<=c||d==2&&L>=c)?c:ke,G=at(a,L<O&&t>=O?O:Ft(O,L)),
te=k*(m==0?e==0?.1:1:i),J=Se(Lo(e+te,_/10),24),$=e<=h&&(u==1||u==3&&J>=h||u==2&&J<=h)?h:-ke,ee=Ft(l,J>$&&e<=$?$:at($,J));return G==ee&&G==0&&(ee=100),[G,ee]}var kd=new Intl.
NumberFormat(ws?gd.language:"en-US"),vi=t=>kd.format(t),xt=Math,To=xt.PI,We=xt.abs,wt=xt.floor,Be=xt.round,Pt=xt.ceil,Ft=xt.min,at=xt.max,ms=xt.pow,$l=xt.sign,Jt=xt.
log10,cc=xt.log2,Sd=(t,e=1)=>xt.sinh(t)*e,ni=(t,e=1)=>xt.asinh(t/e),ke=1/0;function Fl(t){return(Jt((t^t>>31)-(t>>31))|0)+1}function hi(t,e,n){return Ft(at(t,e),
n)}function hc(t){return typeof t=="function"}function ue(t){return hc(t)?t:()=>t}var Md=()=>{},pc=t=>t,uc=(t,e)=>e,Td=t=>null,Il=t=>!0,Ol=(t,e)=>t==e,Ad=/\.\d*?(?=9{6,}|0{6,})/gm,
Pn=t=>{if(mc(t)||cn.has(t))return t;let e=`${t}`,n=e.match(Ad);if(n==null)return t;let s=n[0].length-1;if(e.indexOf("e-")!=-1){let[o,r]=e.split("e");return+`${Pn(
o)}e${r}`}return Se(t,s)};function Mn(t,e){return Pn(Se(Pn(t/e))*e)}function Lo(t,e){return Pn(Pt(Pn(t/e))*e)}function dc(t,e){return Pn(wt(Pn(t/e))*e)}function Se(t,e=0){
if(mc(t))return t;let n=10**e,s=t*n*(1+Number.EPSILON);return Be(s)/n}var cn=new Map;function fc(t){return((""+t).split(".")[1]||"").length}function zs(t,e,n,s){
let o=[],r=s.map(fc);for(let i=e;i<n;i++){let a=We(i),l=Se(ms(t,i),a);for(let c=0;c<s.length;c++){let h=t==10?+`${s[c]}e${i}`:s[c]*l,d=(i>=0?0:a)+(i>=r[c]?0:r[c]),
u=t==10?h:Se(h,d);o.push(u),cn.set(u,d)}}return o}var Hs={},ki=[],gs=[null,null],ln=Array.isArray,mc=Number.isInteger,Ed=t=>t===void 0;function Ul(t){return typeof t==
"string"}function Do(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function Pd(t){return t!=null&&typeof t=="object"}var _d=Object.getPrototypeOf(
Uint8Array),gc="__proto__";function ys(t,e=Do){let n;if(ln(t)){let s=t.find(o=>o!=null);if(ln(s)||e(s)){n=Array(t.length);for(let o=0;o<t.length;o++)n[o]=ys(t[o],
e)}else n=t.slice()}else if(t instanceof _d)n=t.slice();else if(e(t)){n={};for(let s in t)s!=gc&&(n[s]=ys(t[s],e))}else n=t;return n}function Oe(t){let e=arguments;
for(let n=1;n<e.length;n++){let s=e[n];for(let o in s)o!=gc&&(Do(t[o])?Oe(t[o],ys(s[o])):t[o]=ys(s[o]))}return t}var Cd=0,Ld=1,Dd=2;function Nd(t,e,n){for(let s=0,
o,r=-1;s<e.length;s++){let i=e[s];if(i>r){for(o=i-1;o>=0&&t[o]==null;)t[o--]=null;for(o=i+1;o<n&&t[o]==null;)t[r=o++]=null}}}function Rd(t,e){if(Id(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return Od(i[0])||(i=Fd(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],c=l.length;for(let h=0;h<
c;h++)n.add(l[h])}let s=[Array.from(n).sort((i,a)=>i-a)],o=s[0].length,r=new Map;for(let i=0;i<o;i++)r.set(s[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let c=1;c<a.length;c++){let h=a[c],d=Array(o).fill(void 0),u=e?e[i][c]:Ld,m=[];for(let b=0;b<h.length;b++){let w=h[b],S=r.get(l[b]);w===null?u!=Cd&&(d[S]=w,
u==Dd&&m.push(S)):d[S]=w}Nd(d,m,o),s.push(d)}}return s}var $d=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Fd(t){let e=t[0],n=e.
length,s=Array(n);for(let r=0;r<s.length;r++)s[r]=r;s.sort((r,i)=>e[r]-e[i]);let o=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[s[l]];o.push(a)}return o}function Id(t){let e=t[0][0],n=e.length;for(let s=1;s<t.length;s++){let o=t[s][0];if(o.length!=n)return!1;if(o!=e){for(let r=0;r<n;r++)
if(o[r]!=e[r])return!1}}return!0}function Od(t,e=100){let n=t.length;if(n<=1)return!0;let s=0,o=n-1;for(;s<=o&&t[s]==null;)s++;for(;o>=s&&t[o]==null;)o--;if(o<=
s)return!0;let r=at(1,wt((o-s+1)/e));for(let i=t[s],a=s+r;a<=o;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var yc=["January","February","March",
"April","May","June","July","August","September","October","November","December"],bc=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function wc(t){
return t.slice(0,3)}var Ud=bc.map(wc),Bd=yc.map(wc),Wd={MMMM:yc,MMM:Bd,WWWW:bc,WWW:Ud};function Os(t){return(t<10?"0":"")+t}function Gd(t){return(t<10?"00":t<100?
"0":"")+t}var Hd={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>Os(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>Os(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>Os(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>Os(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>Os(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Gd(t.getMilliseconds())};function Si(t,e){e=e||Wd;let n=[],s=/\{([a-z]+)\}|[^{]+/gi,
o;for(;o=s.exec(t);)n.push(o[0][0]=="{"?Hd[o[1]]:o[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var zd=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function Vd(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==zd?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var xc=t=>t%1==0,Po=[1,2,2.5,5],jd=zs(10,-32,0,Po),vc=zs(10,0,32,Po),Yd=vc.filter(
xc),Tn=jd.concat(vc),Mi=`
`,kc="{YYYY}",Bl=Mi+kc,Sc="{M}/{D}",Ws=Mi+Sc,So=Ws+"/{YY}",Mc="{aa}",qd="{h}:{mm}",ds=qd+Mc,Wl=Mi+ds,Gl=":{ss}",be=null;function Tc(t){let e=t*1e3,n=e*60,s=n*60,
o=s*24,r=o*30,i=o*365,l=(t==1?zs(10,0,3,Po).filter(xc):zs(10,-3,0,Po)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,s,s*2,s*3,s*4,s*6,s*8,s*12,o,o*2,o*3,o*
4,o*5,o*6,o*7,o*8,o*9,o*10,o*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),c=[[i,kc,be,be,be,be,be,be,1],[o*28,"{MMM}",Bl,be,be,be,be,be,1],[o,Sc,Bl,be,
be,be,be,be,1],[s,"{h}"+Mc,So,be,Ws,be,be,be,1],[n,ds,So,be,Ws,be,be,be,1],[e,Gl,So+" "+ds,be,Ws+" "+ds,be,Wl,be,1],[t,Gl+".{fff}",So+" "+ds,be,Ws+" "+ds,be,Wl,
be,1]];function h(d){return(u,m,b,w,S,M)=>{let k=[],E=S>=i,_=S>=r&&S<i,N=d(b),L=Se(N*t,3),O=si(N.getFullYear(),E?0:N.getMonth(),_||E?1:N.getDate()),G=Se(O*t,3);
if(_||E){let te=_?S/r:0,J=E?S/i:0,$=L==G?L:Se(si(O.getFullYear()+J,O.getMonth()+te,1)*t,3),ee=new Date(Be($/t)),U=ee.getFullYear(),A=ee.getMonth();for(let P=0;$<=
w;P++){let B=si(U+J*P,A+te*P,1),I=B-d(Se(B*t,3));$=Se((+B+I)*t,3),$<=w&&k.push($)}}else{let te=S>=o?o:S,J=wt(b)-wt(L),$=G+J+Lo(L-G,te);k.push($);let ee=d($),U=ee.
getHours()+ee.getMinutes()/n+ee.getSeconds()/s,A=S/s,P=u.axes[m]._space,B=M/P;for(;$=Se($+S,t==1?0:3),!($>w);)if(A>1){let I=wt(Se(U+A,6))%24,X=d($).getHours()-I;
X>1&&(X=-1),$-=X*s,U=(U+A)%24;let Q=k[k.length-1];Se(($-Q)/S,3)*B>=.7&&k.push($)}else k.push($)}return k}}return[l,c,h]}var[Kd,Jd,Xd]=Tc(1),[Zd,Qd,ef]=Tc(.001);
zs(2,-53,53,[1]);function Hl(t,e){return t.map(n=>n.map((s,o)=>o==0||o==8||s==null?s:e(o==1||n[8]==0?s:n[1]+s)))}function zl(t,e){return(n,s,o,r,i)=>{let a=e.find(
b=>i>=b[0])||e[e.length-1],l,c,h,d,u,m;return s.map(b=>{let w=t(b),S=w.getFullYear(),M=w.getMonth(),k=w.getDate(),E=w.getHours(),_=w.getMinutes(),N=w.getSeconds(),
L=S!=l&&a[2]||M!=c&&a[3]||k!=h&&a[4]||E!=d&&a[5]||_!=u&&a[6]||N!=m&&a[7]||a[1];return l=S,c=M,h=k,d=E,u=_,m=N,L(w)})}}function tf(t,e){let n=Si(e);return(s,o,r,i,a)=>o.
map(l=>n(t(l)))}function si(t,e,n){return new Date(t,e,n)}function Vl(t,e){return e(t)}var nf="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function jl(t,e){return(n,s,o,r)=>r==
null?yi:e(t(s))}function sf(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function of(t,e){return t.series[e].fill(
t,e)}var rf={show:!0,live:!0,isolate:!1,mount:Md,markers:{show:!0,width:2,stroke:sf,fill:of,dash:"solid"},idx:null,idxs:null,values:[]};function af(t,e){let n=t.
cursor.points,s=Et(),o=n.size(t,e);_e(s,Us,o),_e(s,Bs,o);let r=o/-2;_e(s,"marginLeft",r),_e(s,"marginTop",r);let i=n.width(t,e,o);return i&&_e(s,"borderWidth",i),
s}function lf(t,e){let n=t.series[e].points;return n._fill||n._stroke}function cf(t,e){let n=t.series[e].points;return n._stroke||n._fill}function hf(t,e){return t.
series[e].points.size}var oi=[0,0];function pf(t,e,n){return oi[0]=e,oi[1]=n,oi}function Mo(t,e,n,s=!0){return o=>{o.button==0&&(!s||o.target==e)&&n(o)}}function ri(t,e,n,s=!0){
return o=>{(!s||o.target==e)&&n(o)}}var uf={show:!0,x:!0,y:!0,lock:!1,move:pf,points:{one:!1,show:af,size:hf,width:0,stroke:cf,fill:lf},bind:{mousedown:Mo,mouseup:Mo,
click:Mo,dblclick:Mo,mousemove:ri,mouseleave:ri,mouseenter:ri},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,s,o)=>s-o,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Ac={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Ti=Oe({},Ac,{filter:uc}),Ec=Oe({},Ti,{size:10}),Pc=Oe({},Ac,{show:!1}),Ai='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',_c="bold "+Ai,Cc=1.5,Yl={
show:!0,scale:"x",stroke:gi,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:_c,side:2,grid:Ti,ticks:Ec,border:Pc,font:Ai,lineGap:Cc,rotate:0},
df="Value",ff="Time",ql={show:!0,scale:"x",auto:!1,sorted:1,min:ke,max:-ke,idxs:[]};function mf(t,e,n,s,o){return e.map(r=>r==null?"":vi(r))}function gf(t,e,n,s,o,r,i){
let a=[],l=cn.get(o)||0;n=i?n:Se(Lo(n,o),l);for(let c=n;c<=s;c=Se(c+o,l))a.push(Object.is(c,-0)?0:c);return a}function pi(t,e,n,s,o,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,c=l==10?Jt:cc,h=wt(c(n));o=ms(l,h),l==10&&(o=Tn[$t(o,Tn)]);let d=n,u=o*l;l==10&&(u=Tn[$t(u,Tn)]);do a.push(d),d=d+o,l==10&&!cn.has(d)&&(d=Se(d,cn.get(
o))),d>=u&&(o=d,u=o*l,l==10&&(u=Tn[$t(u,Tn)]));while(d<=s);return a}function yf(t,e,n,s,o,r,i){let l=t.scales[t.axes[e].scale].asinh,c=s>l?pi(t,e,at(l,n),s,o):[
l],h=s>=0&&n<=0?[0]:[];return(n<-l?pi(t,e,at(l,-s),-n,o):[l]).reverse().map(u=>-u).concat(h,c)}var Lc=/./,bf=/[12357]/,wf=/[125]/,Kl=/1/,ui=(t,e,n,s)=>t.map((o,r)=>e==
4&&o==0||r%s==0&&n.test(o.toExponential()[o<0?1:0])?o:null);function xf(t,e,n,s,o){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,c=r._space,h=l(10,i),d=l(
9,i)-h>=c?Lc:l(7,i)-h>=c?bf:l(5,i)-h>=c?wf:Kl;if(d==Kl){let u=We(l(1,i)-h);if(u<c)return ui(e.slice().reverse(),a.distr,d,Pt(c/u)).reverse()}return ui(e,a.distr,
d,1)}function vf(t,e,n,s,o){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,c=We(l(1,i)-l(2,i));return c<a?ui(e.slice().reverse(),3,Lc,Pt(a/c)).reverse():e}function kf(t,e,n,s){
return s==null?yi:e==null?"":vi(e)}var Jl={show:!0,scale:"y",stroke:gi,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:_c,side:3,grid:Ti,ticks:Ec,
border:Pc,font:Ai,lineGap:Cc,rotate:0};function Sf(t,e){let n=3+(t||1)*2;return Se(n*e,3)}function Mf(t,e){let{scale:n,idxs:s}=t.series[0],o=t._data[0],r=t.valToPos(
o[s[0]],n,!0),i=t.valToPos(o[s[1]],n,!0),a=We(i-r),l=t.series[e],c=a/(l.points.space*ye);return s[1]-s[0]<=c}var Xl={scale:null,auto:!0,sorted:0,min:ke,max:-ke},
Dc=(t,e,n,s,o)=>o,Zl={show:!0,auto:!0,sorted:0,gaps:Dc,alpha:1,facets:[Oe({},Xl,{scale:"x"}),Oe({},Xl,{scale:"y"})]},Ql={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Dc,alpha:1,points:{show:Mf,filter:null},values:null,min:ke,max:-ke,idxs:[],path:null,clip:null};function Tf(t,e,n,s,o){return n/10}var Nc={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Af=Oe({},Nc,{time:!1,ori:1}),ec={};function Rc(t,e){let n=ec[t];return n||(n={key:t,plots:[],sub(s){n.plots.
push(s)},unsub(s){n.plots=n.plots.filter(o=>o!=s)},pub(s,o,r,i,a,l,c){for(let h=0;h<n.plots.length;h++)n.plots[h]!=o&&n.plots[h].pub(s,o,r,i,a,l,c)}},t!=null&&(ec[t]=
n)),n}var bs=1,di=2;function _n(t,e,n){let s=t.mode,o=t.series[e],r=s==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],c=s==2?r[1]:r[e],h=s==2?i[o.facets[0].scale]:
i[t.series[0].scale],d=s==2?i[o.facets[1].scale]:i[o.scale],u=a.left,m=a.top,b=a.width,w=a.height,S=t.valToPosH,M=t.valToPosV;return h.ori==0?n(o,l,c,h,d,S,M,u,
m,b,w,Ro,xs,Fo,Fc,Oc):n(o,l,c,h,d,M,S,m,u,w,b,$o,vs,_i,Ic,Uc)}function Ei(t,e){let n=0,s=0,o=me(t.bands,ki);for(let r=0;r<o.length;r++){let i=o[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?s|=1:s|=2)}return[n,s==1?-1:s==2?1:s==3?2:0]}function Ef(t,e,n,s,o){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return o==-1?l.min:o==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Xt(t,e,n,s,o,r){return _n(t,e,(i,a,l,c,h,d,u,m,b,w,S)=>{let M=i.pxRound,k=c.
dir*(c.ori==0?1:-1),E=c.ori==0?xs:vs,_,N;k==1?(_=n,N=s):(_=s,N=n);let L=M(d(a[_],c,w,m)),O=M(u(l[_],h,S,b)),G=M(d(a[N],c,w,m)),te=M(u(r==1?h.max:h.min,h,S,b)),J=new Path2D(
o);return E(J,G,te),E(J,L,te),E(J,L,O),J})}function No(t,e,n,s,o,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?Fo:_i,l=n;for(let d=0;d<t.length;d++){let u=t[d];
if(u[1]>u[0]){let m=u[0]-l;m>0&&a(i,l,s,m,s+r),l=u[1]}}let c=n+o-l,h=10;c>0&&a(i,l,s-h/2,c,s+r+h)}return i}function Pf(t,e,n){let s=t[t.length-1];s&&s[0]==e?s[1]=
n:t.push([e,n])}function Pi(t,e,n,s,o,r,i){let a=[],l=t.length;for(let c=o==1?n:s;c>=n&&c<=s;c+=o)if(e[c]===null){let d=c,u=c;if(o==1)for(;++c<=s&&e[c]===null;)
u=c;else for(;--c>=n&&e[c]===null;)u=c;let m=r(t[d]),b=u==d?m:r(t[u]),w=d-o;m=i<=0&&w>=0&&w<l?r(t[w]):m;let M=u+o;b=i>=0&&M>=0&&M<l?r(t[M]):b,b>=m&&a.push([m,b])}
return a}function tc(t){return t==0?pc:t==1?Be:e=>Mn(e,t)}function $c(t){let e=t==0?Ro:$o,n=t==0?(o,r,i,a,l,c)=>{o.arcTo(r,i,a,l,c)}:(o,r,i,a,l,c)=>{o.arcTo(i,r,
l,a,c)},s=t==0?(o,r,i,a,l)=>{o.rect(r,i,a,l)}:(o,r,i,a,l)=>{o.rect(i,r,l,a)};return(o,r,i,a,l,c=0,h=0)=>{c==0&&h==0?s(o,r,i,a,l):(c=Ft(c,a/2,l/2),h=Ft(h,a/2,l/2),
e(o,r+c,i),n(o,r+a,i,r+a,i+l,c),n(o,r+a,i+l,r,i+l,h),n(o,r,i+l,r,i,h),n(o,r,i,r+a,i,c),o.closePath())}}var Ro=(t,e,n)=>{t.moveTo(e,n)},$o=(t,e,n)=>{t.moveTo(n,e)},
xs=(t,e,n)=>{t.lineTo(e,n)},vs=(t,e,n)=>{t.lineTo(n,e)},Fo=$c(0),_i=$c(1),Fc=(t,e,n,s,o,r)=>{t.arc(e,n,s,o,r)},Ic=(t,e,n,s,o,r)=>{t.arc(n,e,s,o,r)},Oc=(t,e,n,s,o,r,i)=>{
t.bezierCurveTo(e,n,s,o,r,i)},Uc=(t,e,n,s,o,r,i)=>{t.bezierCurveTo(n,e,o,s,i,r)};function Bc(t){return(e,n,s,o,r)=>_n(e,n,(i,a,l,c,h,d,u,m,b,w,S)=>{let{pxRound:M,
points:k}=i,E,_;c.ori==0?(E=Ro,_=Fc):(E=$o,_=Ic);let N=Se(k.width*ye,3),L=(k.size-k.width)/2*ye,O=Se(L*2,3),G=new Path2D,te=new Path2D,{left:J,top:$,width:ee,height:U}=e.
bbox;Fo(te,J-O,$-O,ee+O*2,U+O*2);let A=P=>{if(l[P]!=null){let B=M(d(a[P],c,w,m)),I=M(u(l[P],h,S,b));E(G,B+L,I),_(G,B,I,L,0,To*2)}};if(r)r.forEach(A);else for(let P=s;P<=
o;P++)A(P);return{stroke:N>0?G:null,fill:G,clip:te,flags:bs|di}})}function Wc(t){return(e,n,s,o,r,i)=>{s!=o&&(r!=s&&i!=s&&t(e,n,s),r!=o&&i!=o&&t(e,n,o),t(e,n,i))}}
var _f=Wc(xs),Cf=Wc(vs);function Gc(t){let e=me(t?.alignGaps,0);return(n,s,o,r)=>_n(n,s,(i,a,l,c,h,d,u,m,b,w,S)=>{[o,r]=_o(l,o,r);let M=i.pxRound,k=U=>M(d(U,c,w,
m)),E=U=>M(u(U,h,S,b)),_,N;c.ori==0?(_=xs,N=_f):(_=vs,N=Cf);let L=c.dir*(c.ori==0?1:-1),O={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:bs},G=O.
stroke,te=!1;if(r-o>=w*4){let U=W=>n.posToVal(W,c.key,!0),A=null,P=null,B,I,re,K=k(a[L==1?o:r]),X=k(a[o]),Q=k(a[r]),Y=U(L==1?X+1:Q-1);for(let W=L==1?o:r;W>=o&&W<=
r;W+=L){let de=a[W],pe=(L==1?de<Y:de>Y)?K:k(de),se=l[W];pe==K?se!=null?(I=se,A==null?(_(G,pe,E(I)),B=A=P=I):I<A?A=I:I>P&&(P=I)):se===null&&(te=!0):(A!=null&&N(G,
K,E(A),E(P),E(B),E(I)),se!=null?(I=se,_(G,pe,E(I)),A=P=B=I):(A=P=null,se===null&&(te=!0)),K=pe,Y=U(K+L))}A!=null&&A!=P&&re!=K&&N(G,K,E(A),E(P),E(B),E(I))}else for(let U=L==
1?o:r;U>=o&&U<=r;U+=L){let A=l[U];A===null?te=!0:A!=null&&_(G,k(a[U]),E(A))}let[$,ee]=Ei(n,s);if(i.fill!=null||$!=0){let U=O.fill=new Path2D(G),A=i.fillTo(n,s,i.
min,i.max,$),P=E(A),B=k(a[o]),I=k(a[r]);L==-1&&([I,B]=[B,I]),_(U,I,P),_(U,B,P)}if(!i.spanGaps){let U=[];te&&U.push(...Pi(a,l,o,r,L,k,e)),O.gaps=U=i.gaps(n,s,o,r,
U),O.clip=No(U,c.ori,m,b,w,S)}return ee!=0&&(O.band=ee==2?[Xt(n,s,o,r,G,-1),Xt(n,s,o,r,G,1)]:Xt(n,s,o,r,G,ee)),O})}function Lf(t){let e=me(t.align,1),n=me(t.ascDesc,
!1),s=me(t.alignGaps,0),o=me(t.extend,!1);return(r,i,a,l)=>_n(r,i,(c,h,d,u,m,b,w,S,M,k,E)=>{[a,l]=_o(d,a,l);let _=c.pxRound,{left:N,width:L}=r.bbox,O=X=>_(b(X,u,
k,S)),G=X=>_(w(X,m,E,M)),te=u.ori==0?xs:vs,J={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:bs},$=J.stroke,ee=u.dir*(u.ori==0?1:-1),U=G(d[ee==
1?a:l]),A=O(h[ee==1?a:l]),P=A,B=A;o&&e==-1&&(B=N,te($,B,U)),te($,A,U);for(let X=ee==1?a:l;X>=a&&X<=l;X+=ee){let Q=d[X];if(Q==null)continue;let Y=O(h[X]),W=G(Q);
e==1?te($,Y,U):te($,P,W),te($,Y,W),U=W,P=Y}let I=P;o&&e==1&&(I=N+L,te($,I,U));let[re,K]=Ei(r,i);if(c.fill!=null||re!=0){let X=J.fill=new Path2D($),Q=c.fillTo(r,
i,c.min,c.max,re),Y=G(Q);te(X,I,Y),te(X,B,Y)}if(!c.spanGaps){let X=[];X.push(...Pi(h,d,a,l,ee,O,s));let Q=c.width*ye/2,Y=n||e==1?Q:-Q,W=n||e==-1?-Q:Q;X.forEach(
de=>{de[0]+=Y,de[1]+=W}),J.gaps=X=c.gaps(r,i,a,l,X),J.clip=No(X,u.ori,S,M,k,E)}return K!=0&&(J.band=K==2?[Xt(r,i,a,l,$,-1),Xt(r,i,a,l,$,1)]:Xt(r,i,a,l,$,K)),J})}
function nc(t,e,n,s,o,r,i=ke){if(t.length>1){let a=null;for(let l=0,c=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=We(t[l]-t[a]);h<c&&(c=h,i=We(n(t[l],
s,o,r)-n(t[a],s,o,r)))}a=l}}return i}function Df(t){t=t||Hs;let e=me(t.size,[.6,ke,1]),n=t.align||0,s=t.gap||0,o=t.radius;o=o==null?[0,0]:typeof o=="number"?[o,
0]:o;let r=ue(o),i=1-e[0],a=me(e[1],ke),l=me(e[2],1),c=me(t.disp,Hs),h=me(t.each,m=>{}),{fill:d,stroke:u}=c;return(m,b,w,S)=>_n(m,b,(M,k,E,_,N,L,O,G,te,J,$)=>{let ee=M.
pxRound,U=n,A=s*ye,P=a*ye,B=l*ye,I,re;_.ori==0?[I,re]=r(m,b):[re,I]=r(m,b);let K=_.dir*(_.ori==0?1:-1),X=_.ori==0?Fo:_i,Q=_.ori==0?h:(j,Te,Ue,Rn,un,Ut,dn)=>{h(j,
Te,Ue,un,Rn,dn,Ut)},Y=me(m.bands,ki).find(j=>j.series[0]==b),W=Y!=null?Y.dir:0,de=M.fillTo(m,b,M.min,M.max,W),ce=ee(O(de,N,$,te)),pe,se,$e,ze=J,xe=ee(M.width*ye),
nt=!1,pt=null,Re=null,lt=null,_t=null;d!=null&&(xe==0||u!=null)&&(nt=!0,pt=d.values(m,b,w,S),Re=new Map,new Set(pt).forEach(j=>{j!=null&&Re.set(j,new Path2D)}),
xe>0&&(lt=u.values(m,b,w,S),_t=new Map,new Set(lt).forEach(j=>{j!=null&&_t.set(j,new Path2D)})));let{x0:Yt,size:Nn}=c;if(Yt!=null&&Nn!=null){U=1,k=Yt.values(m,b,
w,S),Yt.unit==2&&(k=k.map(Ue=>m.posToVal(G+Ue*J,_.key,!0)));let j=Nn.values(m,b,w,S);Nn.unit==2?se=j[0]*J:se=L(j[0],_,J,G)-L(0,_,J,G),ze=nc(k,E,L,_,J,G,ze),$e=ze-
se+A}else ze=nc(k,E,L,_,J,G,ze),$e=ze*i+A,se=ze-$e;$e<1&&($e=0),xe>=se/2&&(xe=0),$e<5&&(ee=pc);let Ms=$e>0,Ot=ze-$e-(Ms?xe:0);se=ee(hi(Ot,B,P)),pe=(U==0?se/2:U==
K?0:se)-U*K*((U==0?A/2:0)+(Ms?xe/2:0));let z={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},ae=nt?null:new Path2D,Me=null;if(Y!=null)Me=m.data[Y.
series[1]];else{let{y0:j,y1:Te}=c;j!=null&&Te!=null&&(E=Te.values(m,b,w,S),Me=j.values(m,b,w,S))}let ut=I*se,ie=re*se;for(let j=K==1?w:S;j>=w&&j<=S;j+=K){let Te=E[j];
if(Te==null)continue;if(Me!=null){let ct=Me[j]??0;if(Te-ct==0)continue;ce=O(ct,N,$,te)}let Ue=_.distr!=2||c!=null?k[j]:j,Rn=L(Ue,_,J,G),un=O(me(Te,de),N,$,te),Ut=ee(
Rn-pe),dn=ee(at(un,ce)),dt=ee(Ft(un,ce)),vt=dn-dt;if(Te!=null){let ct=Te<0?ie:ut,Ct=Te<0?ut:ie;nt?(xe>0&&lt[j]!=null&&X(_t.get(lt[j]),Ut,dt+wt(xe/2),se,at(0,vt-
xe),ct,Ct),pt[j]!=null&&X(Re.get(pt[j]),Ut,dt+wt(xe/2),se,at(0,vt-xe),ct,Ct)):X(ae,Ut,dt+wt(xe/2),se,at(0,vt-xe),ct,Ct),Q(m,b,j,Ut-xe/2,dt,se+xe,vt)}}return xe>
0?z.stroke=nt?_t:ae:nt||(z._fill=M.width==0?M._fill:M._stroke??M._fill,z.width=0),z.fill=nt?Re:ae,z})}function Nf(t,e){let n=me(e?.alignGaps,0);return(s,o,r,i)=>_n(
s,o,(a,l,c,h,d,u,m,b,w,S,M)=>{[r,i]=_o(c,r,i);let k=a.pxRound,E=I=>k(u(I,h,S,b)),_=I=>k(m(I,d,M,w)),N,L,O;h.ori==0?(N=Ro,O=xs,L=Oc):(N=$o,O=vs,L=Uc);let G=h.dir*
(h.ori==0?1:-1),te=E(l[G==1?r:i]),J=te,$=[],ee=[];for(let I=G==1?r:i;I>=r&&I<=i;I+=G)if(c[I]!=null){let K=l[I],X=E(K);$.push(J=X),ee.push(_(c[I]))}let U={stroke:t(
$,ee,N,O,L,k),fill:null,clip:null,band:null,gaps:null,flags:bs},A=U.stroke,[P,B]=Ei(s,o);if(a.fill!=null||P!=0){let I=U.fill=new Path2D(A),re=a.fillTo(s,o,a.min,
a.max,P),K=_(re);O(I,J,K),O(I,te,K)}if(!a.spanGaps){let I=[];I.push(...Pi(l,c,r,i,G,E,n)),U.gaps=I=a.gaps(s,o,r,i,I),U.clip=No(I,h.ori,b,w,S,M)}return B!=0&&(U.
band=B==2?[Xt(s,o,r,i,A,-1),Xt(s,o,r,i,A,1)]:Xt(s,o,r,i,A,B)),U})}function Rf(t){return Nf($f,t)}function $f(t,e,n,s,o,r){let i=t.length;if(i<2)return null;let a=new Path2D;
if(n(a,t[0],e[0]),i==2)s(a,t[1],e[1]);else{let l=Array(i),c=Array(i-1),h=Array(i-1),d=Array(i-1);for(let u=0;u<i-1;u++)h[u]=e[u+1]-e[u],d[u]=t[u+1]-t[u],c[u]=h[u]/
d[u];l[0]=c[0];for(let u=1;u<i-1;u++)c[u]===0||c[u-1]===0||c[u-1]>0!=c[u]>0?l[u]=0:(l[u]=3*(d[u-1]+d[u])/((2*d[u]+d[u-1])/c[u-1]+(d[u]+2*d[u-1])/c[u]),isFinite(
l[u])||(l[u]=0));l[i-1]=c[i-2];for(let u=0;u<i-1;u++)o(a,t[u]+d[u]/3,e[u]+l[u]*d[u]/3,t[u+1]-d[u]/3,e[u+1]-l[u+1]*d[u]/3,t[u+1],e[u+1])}return a}var fi=new Set;
function sc(){for(let t of fi)t.syncRect(!0)}ws&&(En(fd,fs,sc),En(md,fs,sc,!0),En(Ao,fs,()=>{Ge.pxRatio=ye}));var Ff=Gc(),If=Bc();function oc(t,e,n,s){return(s?
[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>mi(r,i,e,n))}function Of(t,e){return t.map((n,s)=>s==0?{}:Oe({},e,n))}function mi(t,e,n,s){
return Oe({},e==0?n:s,t)}function Hc(t,e,n){return e==null?gs:[e,n]}var Uf=Hc;function Bf(t,e,n){return e==null?gs:Eo(e,n,xi,!0)}function zc(t,e,n,s){return e==
null?gs:Co(e,n,t.scales[s].log,!1)}var Wf=zc;function Vc(t,e,n,s){return e==null?gs:wi(e,n,t.scales[s].log,!1)}var Gf=Vc;function Hf(t,e,n,s,o){let r=at(Fl(t),Fl(
e)),i=e-t,a=$t(o/s*i,n);do{let l=n[a],c=s*l/i;if(c>=o&&r+(l<5?cn.get(l):0)<=17)return[l,c]}while(++a<n.length);return[0,0]}function rc(t){let e,n;return t=t.replace(
/(\d+)px/,(s,o)=>(e=Be((n=+o)*ye))+"px"),[t,e,n]}function zf(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=Se(e[2]*ye,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),
e[1]=n})}function Ge(t,e,n){let s={mode:me(t.mode,1)},o=s.mode;function r(p,f,g,y){let x=f.valToPct(p);return y+g*(f.dir==-1?1-x:x)}function i(p,f,g,y){let x=f.
valToPct(p);return y+g*(f.dir==-1?x:1-x)}function a(p,f,g,y){return f.ori==0?r(p,f,g,y):i(p,f,g,y)}s.valToPosH=r,s.valToPosV=i;let l=!1;s.status=0;let c=s.root=
Et(Ju);if(t.id!=null&&(c.id=t.id),bt(c,t.class),t.title){let p=Et(Qu,c);p.textContent=t.title}let h=Rt("canvas"),d=s.ctx=h.getContext("2d"),u=Et(ed,c);En("click",
u,p=>{p.target===b&&(Ae!=Vn||Ce!=jn)&&Ze.click(s,p)},!0);let m=s.under=Et(td,u);u.appendChild(h);let b=s.over=Et(nd,u);t=ys(t);let w=+me(t.pxAlign,1),S=tc(w);(t.
plugins||[]).forEach(p=>{p.opts&&(t=p.opts(s,t)||t)});let M=t.ms||.001,k=s.series=o==1?oc(t.series||[],ql,Ql,!1):Of(t.series||[null],Zl),E=s.axes=oc(t.axes||[],
Yl,Jl,!0),_=s.scales={},N=s.bands=t.bands||[];N.forEach(p=>{p.fill=ue(p.fill||null),p.dir=me(p.dir,-1)});let L=o==2?k[1].facets[0].scale:k[0].scale,O={axes:Qp,series:qp},
G=(t.drawOrder||["axes","series"]).map(p=>O[p]);function te(p){let f=p.distr==3?g=>Jt(g>0?g:p.clamp(s,g,p.min,p.max,p.key)):p.distr==4?g=>ni(g,p.asinh):p.distr==
100?g=>p.fwd(g):g=>g;return g=>{let y=f(g),{_min:x,_max:T}=p,D=T-x;return(y-x)/D}}function J(p){let f=_[p];if(f==null){let g=(t.scales||Hs)[p]||Hs;if(g.from!=null){
J(g.from);let y=Oe({},_[g.from],g,{key:p});y.valToPct=te(y),_[p]=y}else{f=_[p]=Oe({},p==L?Nc:Af,g),f.key=p;let y=f.time,x=f.range,T=ln(x);if((p!=L||o==2&&!y)&&(T&&
(x[0]==null||x[1]==null)&&(x={min:x[0]==null?Nl:{mode:1,hard:x[0],soft:x[0]},max:x[1]==null?Nl:{mode:1,hard:x[1],soft:x[1]}},T=!1),!T&&Do(x))){let D=x;x=(R,F,H)=>F==
null?gs:Eo(F,H,D)}f.range=ue(x||(y?Uf:p==L?f.distr==3?Wf:f.distr==4?Gf:Hc:f.distr==3?zc:f.distr==4?Vc:Bf)),f.auto=ue(T?!1:f.auto),f.clamp=ue(f.clamp||Tf),f._min=
f._max=null,f.valToPct=te(f)}}}J("x"),J("y"),o==1&&k.forEach(p=>{J(p.scale)}),E.forEach(p=>{J(p.scale)});for(let p in t.scales)J(p);let $=_[L],ee=$.distr,U,A;$.
ori==0?(bt(c,Xu),U=r,A=i):(bt(c,Zu),U=i,A=r);let P={};for(let p in _){let f=_[p];(f.min!=null||f.max!=null)&&(P[p]={min:f.min,max:f.max},f.min=f.max=null)}let B=t.
tzDate||(p=>new Date(Be(p/M))),I=t.fmtDate||Si,re=M==1?Xd(B):ef(B),K=zl(B,Hl(M==1?Jd:Qd,I)),X=jl(B,Vl(nf,I)),Q=[],Y=s.legend=Oe({},rf,t.legend),W=s.cursor=Oe({},
uf,{drag:{y:o==2}},t.cursor),de=Y.show,ce=W.show,pe=Y.markers;Y.idxs=Q,pe.width=ue(pe.width),pe.dash=ue(pe.dash),pe.stroke=ue(pe.stroke),pe.fill=ue(pe.fill);let se,
$e,ze,xe=[],nt=[],pt,Re=!1,lt={};if(Y.live){let p=k[1]?k[1].values:null;Re=p!=null,pt=Re?p(s,1,0):{_:0};for(let f in pt)lt[f]=yi}if(de)if(se=Rt("table",ld,c),ze=
Rt("tbody",null,se),Y.mount(s,se),Re){$e=Rt("thead",null,se,ze);let p=Rt("tr",null,$e);Rt("th",null,p);for(var _t in pt)Rt("th",xl,p).textContent=_t}else bt(se,
hd),Y.live&&bt(se,cd);let Yt={show:!0},Nn={show:!1};function Ms(p,f){if(f==0&&(Re||!Y.live||o==2))return gs;let g=[],y=Rt("tr",pd,ze,ze.childNodes[f]);bt(y,p.class),
p.show||bt(y,An);let x=Rt("th",null,y);if(pe.show){let R=Et(ud,x);if(f>0){let F=pe.width(s,f);F&&(R.style.border=F+"px "+pe.dash(s,f)+" "+pe.stroke(s,f)),R.style.
background=pe.fill(s,f)}}let T=Et(xl,x);p.label instanceof HTMLElement?T.appendChild(p.label):T.textContent=p.label,f>0&&(pe.show||(T.style.color=p.width>0?pe.stroke(
s,f):pe.fill(s,f)),z("click",x,R=>{if(W._lock)return;mn(R);let F=k.indexOf(p);if((R.ctrlKey||R.metaKey)!=Y.isolate){let H=k.some((V,q)=>q>0&&q!=F&&V.show);k.forEach(
(V,q)=>{q>0&&Wt(q,H?q==F?Yt:Nn:Yt,!0,Fe.setSeries)})}else Wt(F,{show:!p.show},!0,Fe.setSeries)},!1),Fn&&z(Ml,x,R=>{W._lock||(mn(R),Wt(k.indexOf(p),qn,!0,Fe.setSeries))},
!1));for(var D in pt){let R=Rt("td",dd,y);R.textContent="--",g.push(R)}return[y,g]}let Ot=new Map;function z(p,f,g,y=!0){let x=Ot.get(f)||{},T=W.bind[p](s,f,g,y);
T&&(En(p,f,x[p]=T),Ot.set(f,x))}function ae(p,f,g){let y=Ot.get(f)||{};for(let x in y)(p==null||x==p)&&(ci(x,f,y[x]),delete y[x]);p==null&&Ot.delete(f)}let Me=0,
ut=0,ie=0,j=0,Te=0,Ue=0,Rn=Te,un=Ue,Ut=ie,dn=j,dt=0,vt=0,ct=0,Ct=0;s.bbox={};let br=!1,qs=!1,$n=!1,fn=!1,Ks=!1,kt=!1;function wr(p,f,g){(g||p!=s.width||f!=s.height)&&
sa(p,f),Wn(!1),$n=!0,qs=!0,Gn()}function sa(p,f){s.width=Me=ie=p,s.height=ut=j=f,Te=Ue=0,Wp(),Gp();let g=s.bbox;dt=g.left=Mn(Te*ye,.5),vt=g.top=Mn(Ue*ye,.5),ct=
g.width=Mn(ie*ye,.5),Ct=g.height=Mn(j*ye,.5)}let Op=3;function Up(){let p=!1,f=0;for(;!p;){f++;let g=Xp(f),y=Zp(f);p=f==Op||g&&y,p||(sa(s.width,s.height),qs=!0)}}
function Bp({width:p,height:f}){wr(p,f)}s.setSize=Bp;function Wp(){let p=!1,f=!1,g=!1,y=!1;E.forEach((x,T)=>{if(x.show&&x._show){let{side:D,_size:R}=x,F=D%2,H=x.
label!=null?x.labelSize:0,V=R+H;V>0&&(F?(ie-=V,D==3?(Te+=V,y=!0):g=!0):(j-=V,D==0?(Ue+=V,p=!0):f=!0))}}),gn[0]=p,gn[1]=g,gn[2]=f,gn[3]=y,ie-=en[1]+en[3],Te+=en[3],
j-=en[2]+en[0],Ue+=en[0]}function Gp(){let p=Te+ie,f=Ue+j,g=Te,y=Ue;function x(T,D){switch(T){case 1:return p+=D,p-D;case 2:return f+=D,f-D;case 3:return g-=D,g+
D;case 0:return y-=D,y+D}}E.forEach((T,D)=>{if(T.show&&T._show){let R=T.side;T._pos=x(R,T._size),T.label!=null&&(T._lpos=x(R,T.labelSize))}})}if(W.dataIdx==null){
let p=W.hover,f=p.skip=new Set(p.skip??[]);f.add(void 0);let g=p.prox=ue(p.prox),y=p.bias??=0;W.dataIdx=(x,T,D,R)=>{if(T==0)return D;let F=D,H=g(x,T,D,R)??ke,V=H>=
0&&H<ke,q=$.ori==0?ie:j,oe=W.left,ge=e[0],fe=e[T];if(f.has(fe[D])){F=null;let he=null,ne=null,Z;if(y==0||y==-1)for(Z=D;he==null&&Z-- >0;)f.has(fe[Z])||(he=Z);if(y==
0||y==1)for(Z=D;ne==null&&Z++<fe.length;)f.has(fe[Z])||(ne=Z);if(he!=null||ne!=null)if(V){let Pe=he==null?-1/0:U(ge[he],$,q,0),De=ne==null?1/0:U(ge[ne],$,q,0),Je=oe-
Pe,ve=De-oe;Je<=ve?Je<=H&&(F=he):ve<=H&&(F=ne)}else F=ne==null?he:he==null?ne:D-he<=ne-D?he:ne}else V&&We(oe-U(ge[D],$,q,0))>H&&(F=null);return F}}let mn=p=>{W.
event=p};W.idxs=Q,W._lock=!1;let tt=W.points;tt.show=ue(tt.show),tt.size=ue(tt.size),tt.stroke=ue(tt.stroke),tt.width=ue(tt.width),tt.fill=ue(tt.fill);let Bt=s.
focus=Oe({},t.focus||{alpha:.3},W.focus),Fn=Bt.prox>=0,In=Fn&&tt.one,St=[],On=[],Un=[];function oa(p,f){let g=tt.show(s,f);if(g instanceof HTMLElement)return bt(
g,ad),bt(g,p.class),jt(g,-10,-10,ie,j),b.insertBefore(g,St[f]),g}function ra(p,f){if(o==1||f>0){let g=o==1&&_[p.scale].time,y=p.value;p.value=g?Ul(y)?jl(B,Vl(y,
I)):y||X:y||kf,p.label=p.label||(g?ff:df)}if(In||f>0){p.width=p.width==null?1:p.width,p.paths=p.paths||Ff||Td,p.fillTo=ue(p.fillTo||Ef),p.pxAlign=+me(p.pxAlign,
w),p.pxRound=tc(p.pxAlign),p.stroke=ue(p.stroke||null),p.fill=ue(p.fill||null),p._stroke=p._fill=p._paths=p._focus=null;let g=Sf(at(1,p.width),1),y=p.points=Oe(
{},{size:g,width:at(1,g*.2),stroke:p.stroke,space:g*2,paths:If,_stroke:null,_fill:null},p.points);y.show=ue(y.show),y.filter=ue(y.filter),y.fill=ue(y.fill),y.stroke=
ue(y.stroke),y.paths=ue(y.paths),y.pxAlign=p.pxAlign}if(de){let g=Ms(p,f);xe.splice(f,0,g[0]),nt.splice(f,0,g[1]),Y.values.push(null)}if(ce){Q.splice(f,0,null);
let g=null;In?f==0&&(g=oa(p,f)):f>0&&(g=oa(p,f)),St.splice(f,0,g),On.splice(f,0,0),Un.splice(f,0,0)}Ke("addSeries",f)}function Hp(p,f){f=f??k.length,p=o==1?mi(p,
f,ql,Ql):mi(p,f,{},Zl),k.splice(f,0,p),ra(k[f],f)}s.addSeries=Hp;function zp(p){if(k.splice(p,1),de){Y.values.splice(p,1),nt.splice(p,1);let f=xe.splice(p,1)[0];
ae(null,f.firstChild),f.remove()}ce&&(Q.splice(p,1),St.splice(p,1)[0].remove(),On.splice(p,1),Un.splice(p,1)),Ke("delSeries",p)}s.delSeries=zp;let gn=[!1,!1,!1,
!1];function Vp(p,f){if(p._show=p.show,p.show){let g=p.side%2,y=_[p.scale];y==null&&(p.scale=g?k[1].scale:L,y=_[p.scale]);let x=y.time;p.size=ue(p.size),p.space=
ue(p.space),p.rotate=ue(p.rotate),ln(p.incrs)&&p.incrs.forEach(D=>{!cn.has(D)&&cn.set(D,fc(D))}),p.incrs=ue(p.incrs||(y.distr==2?Yd:x?M==1?Kd:Zd:Tn)),p.splits=ue(
p.splits||(x&&y.distr==1?re:y.distr==3?pi:y.distr==4?yf:gf)),p.stroke=ue(p.stroke),p.grid.stroke=ue(p.grid.stroke),p.ticks.stroke=ue(p.ticks.stroke),p.border.stroke=
ue(p.border.stroke);let T=p.values;p.values=ln(T)&&!ln(T[0])?ue(T):x?ln(T)?zl(B,Hl(T,I)):Ul(T)?tf(B,T):T||K:T||mf,p.filter=ue(p.filter||(y.distr>=3&&y.log==10?xf:
y.distr==3&&y.log==2?vf:uc)),p.font=rc(p.font),p.labelFont=rc(p.labelFont),p._size=p.size(s,null,f,0),p._space=p._rotate=p._incrs=p._found=p._splits=p._values=null,
p._size>0&&(gn[f]=!0,p._el=Et(sd,u))}}function Ts(p,f,g,y){let[x,T,D,R]=g,F=f%2,H=0;return F==0&&(R||T)&&(H=f==0&&!x||f==2&&!D?Be(Yl.size/3):0),F==1&&(x||D)&&(H=
f==1&&!T||f==3&&!R?Be(Jl.size/2):0),H}let ia=s.padding=(t.padding||[Ts,Ts,Ts,Ts]).map(p=>ue(me(p,Ts))),en=s._padding=ia.map((p,f)=>p(s,f,gn,0)),Xe,Ve=null,je=null,
Js=o==1?k[0].idxs:null,Lt=null,As=!1;function aa(p,f){if(e=p??[],s.data=s._data=e,o==2){Xe=0;for(let g=1;g<k.length;g++)Xe+=e[g][0].length}else{e.length==0&&(s.
data=s._data=e=[[]]),Lt=e[0],Xe=Lt.length;let g=e;if(ee==2){g=e.slice();let y=g[0]=Array(Xe);for(let x=0;x<Xe;x++)y[x]=x}s._data=e=g}if(Wn(!0),Ke("setData"),ee==
2&&($n=!0),f!==!1){let g=$;g.auto(s,As)?xr():nn(L,g.min,g.max),fn=fn||W.left>=0,kt=!0,Gn()}}s.setData=aa;function xr(){As=!0;let p,f;o==1&&(Xe>0?(Ve=Js[0]=0,je=
Js[1]=Xe-1,p=e[0][Ve],f=e[0][je],ee==2?(p=Ve,f=je):p==f&&(ee==3?[p,f]=Co(p,p,$.log,!1):ee==4?[p,f]=wi(p,p,$.log,!1):$.time?f=p+Be(86400/M):[p,f]=Eo(p,f,xi,!0))):
(Ve=Js[0]=p=null,je=Js[1]=f=null)),nn(L,p,f)}let Xs,Bn,vr,kr,Sr,Mr,Tr,Ar,Er,ht;function la(p,f,g,y,x,T){p??=kl,g??=ki,y??="butt",x??=kl,T??="round",p!=Xs&&(d.strokeStyle=
Xs=p),x!=Bn&&(d.fillStyle=Bn=x),f!=vr&&(d.lineWidth=vr=f),T!=Sr&&(d.lineJoin=Sr=T),y!=Mr&&(d.lineCap=Mr=y),g!=kr&&d.setLineDash(kr=g)}function ca(p,f,g,y){f!=Bn&&
(d.fillStyle=Bn=f),p!=Tr&&(d.font=Tr=p),g!=Ar&&(d.textAlign=Ar=g),y!=Er&&(d.textBaseline=Er=y)}function Pr(p,f,g,y,x=0){if(y.length>0&&p.auto(s,As)&&(f==null||f.
min==null)){let T=me(Ve,0),D=me(je,y.length-1),R=g.min==null?wd(y,T,D,x,p.distr==3):[g.min,g.max];p.min=Ft(p.min,g.min=R[0]),p.max=at(p.max,g.max=R[1])}}let ha={
min:null,max:null};function jp(){for(let y in _){let x=_[y];P[y]==null&&(x.min==null||P[L]!=null&&x.auto(s,As))&&(P[y]=ha)}for(let y in _){let x=_[y];P[y]==null&&
x.from!=null&&P[x.from]!=null&&(P[y]=ha)}P[L]!=null&&Wn(!0);let p={};for(let y in P){let x=P[y];if(x!=null){let T=p[y]=ys(_[y],Pd);if(x.min!=null)Oe(T,x);else if(y!=
L||o==2)if(Xe==0&&T.from==null){let D=T.range(s,null,null,y);T.min=D[0],T.max=D[1]}else T.min=ke,T.max=-ke}}if(Xe>0){k.forEach((y,x)=>{if(o==1){let T=y.scale,D=P[T];
if(D==null)return;let R=p[T];if(x==0){let F=R.range(s,R.min,R.max,T);R.min=F[0],R.max=F[1],Ve=$t(R.min,e[0]),je=$t(R.max,e[0]),je-Ve>1&&(e[0][Ve]<R.min&&Ve++,e[0][je]>
R.max&&je--),y.min=Lt[Ve],y.max=Lt[je]}else y.show&&y.auto&&Pr(R,D,y,e[x],y.sorted);y.idxs[0]=Ve,y.idxs[1]=je}else if(x>0&&y.show&&y.auto){let[T,D]=y.facets,R=T.
scale,F=D.scale,[H,V]=e[x],q=p[R],oe=p[F];q!=null&&Pr(q,P[R],T,H,T.sorted),oe!=null&&Pr(oe,P[F],D,V,D.sorted),y.min=D.min,y.max=D.max}});for(let y in p){let x=p[y],
T=P[y];if(x.from==null&&(T==null||T.min==null)){let D=x.range(s,x.min==ke?null:x.min,x.max==-ke?null:x.max,y);x.min=D[0],x.max=D[1]}}}for(let y in p){let x=p[y];
if(x.from!=null){let T=p[x.from];if(T.min==null)x.min=x.max=null;else{let D=x.range(s,T.min,T.max,y);x.min=D[0],x.max=D[1]}}}let f={},g=!1;for(let y in p){let x=p[y],
T=_[y];if(T.min!=x.min||T.max!=x.max){T.min=x.min,T.max=x.max;let D=T.distr;T._min=D==3?Jt(T.min):D==4?ni(T.min,T.asinh):D==100?T.fwd(T.min):T.min,T._max=D==3?Jt(
T.max):D==4?ni(T.max,T.asinh):D==100?T.fwd(T.max):T.max,f[y]=g=!0}}if(g){k.forEach((y,x)=>{o==2?x>0&&f.y&&(y._paths=null):f[y.scale]&&(y._paths=null)});for(let y in f)
$n=!0,Ke("setScale",y);ce&&W.left>=0&&(fn=kt=!0)}for(let y in P)P[y]=null}function Yp(p){let f=hi(Ve-1,0,Xe-1),g=hi(je+1,0,Xe-1);for(;p[f]==null&&f>0;)f--;for(;p[g]==
null&&g<Xe-1;)g++;return[f,g]}function qp(){if(Xe>0){let p=k.some(f=>f._focus)&&ht!=Bt.alpha;p&&(d.globalAlpha=ht=Bt.alpha),k.forEach((f,g)=>{if(g>0&&f.show&&(pa(
g,!1),pa(g,!0),f._paths==null)){let y=ht;ht!=f.alpha&&(d.globalAlpha=ht=f.alpha);let x=o==2?[0,e[g][0].length-1]:Yp(e[g]);f._paths=f.paths(s,g,x[0],x[1]),ht!=y&&
(d.globalAlpha=ht=y)}}),k.forEach((f,g)=>{if(g>0&&f.show){let y=ht;ht!=f.alpha&&(d.globalAlpha=ht=f.alpha),f._paths!=null&&ua(g,!1);{let x=f._paths!=null?f._paths.
gaps:null,T=f.points.show(s,g,Ve,je,x),D=f.points.filter(s,g,T,x);(T||D)&&(f.points._paths=f.points.paths(s,g,Ve,je,D),ua(g,!0))}ht!=y&&(d.globalAlpha=ht=y),Ke(
"drawSeries",g)}}),p&&(d.globalAlpha=ht=1)}}function pa(p,f){let g=f?k[p].points:k[p];g._stroke=g.stroke(s,p),g._fill=g.fill(s,p)}function ua(p,f){let g=f?k[p].
points:k[p],{stroke:y,fill:x,clip:T,flags:D,_stroke:R=g._stroke,_fill:F=g._fill,_width:H=g.width}=g._paths;H=Se(H*ye,3);let V=null,q=H%2/2;f&&F==null&&(F=H>0?"#\
fff":R);let oe=g.pxAlign==1&&q>0;if(oe&&d.translate(q,q),!f){let ge=dt-H/2,fe=vt-H/2,he=ct+H,ne=Ct+H;V=new Path2D,V.rect(ge,fe,he,ne)}f?_r(R,H,g.dash,g.cap,F,y,
x,D,T):Kp(p,R,H,g.dash,g.cap,F,y,x,D,V,T),oe&&d.translate(-q,-q)}function Kp(p,f,g,y,x,T,D,R,F,H,V){let q=!1;F!=0&&N.forEach((oe,ge)=>{if(oe.series[0]==p){let fe=k[oe.
series[1]],he=e[oe.series[1]],ne=(fe._paths||Hs).band;ln(ne)&&(ne=oe.dir==1?ne[0]:ne[1]);let Z,Pe=null;fe.show&&ne&&vd(he,Ve,je)?(Pe=oe.fill(s,ge)||T,Z=fe._paths.
clip):ne=null,_r(f,g,y,x,Pe,D,R,F,H,V,Z,ne),q=!0}}),q||_r(f,g,y,x,T,D,R,F,H,V)}let da=bs|di;function _r(p,f,g,y,x,T,D,R,F,H,V,q){la(p,f,g,y,x),(F||H||q)&&(d.save(),
F&&d.clip(F),H&&d.clip(H)),q?(R&da)==da?(d.clip(q),V&&d.clip(V),Qs(x,D),Zs(p,T,f)):R&di?(Qs(x,D),d.clip(q),Zs(p,T,f)):R&bs&&(d.save(),d.clip(q),V&&d.clip(V),Qs(
x,D),d.restore(),Zs(p,T,f)):(Qs(x,D),Zs(p,T,f)),(F||H||q)&&d.restore()}function Zs(p,f,g){g>0&&(f instanceof Map?f.forEach((y,x)=>{d.strokeStyle=Xs=x,d.stroke(y)}):
f!=null&&p&&d.stroke(f))}function Qs(p,f){f instanceof Map?f.forEach((g,y)=>{d.fillStyle=Bn=y,d.fill(g)}):f!=null&&p&&d.fill(f)}function Jp(p,f,g,y){let x=E[p],
T;if(y<=0)T=[0,0];else{let D=x._space=x.space(s,p,f,g,y),R=x._incrs=x.incrs(s,p,f,g,y,D);T=Hf(f,g,R,y,D)}return x._found=T}function Cr(p,f,g,y,x,T,D,R,F,H){let V=D%
2/2;w==1&&d.translate(V,V),la(R,D,F,H,R),d.beginPath();let q,oe,ge,fe,he=x+(y==0||y==3?-T:T);g==0?(oe=x,fe=he):(q=x,ge=he);for(let ne=0;ne<p.length;ne++)f[ne]!=
null&&(g==0?q=ge=p[ne]:oe=fe=p[ne],d.moveTo(q,oe),d.lineTo(ge,fe));d.stroke(),w==1&&d.translate(-V,-V)}function Xp(p){let f=!0;return E.forEach((g,y)=>{if(!g.show)
return;let x=_[g.scale];if(x.min==null){g._show&&(f=!1,g._show=!1,Wn(!1));return}else g._show||(f=!1,g._show=!0,Wn(!1));let T=g.side,D=T%2,{min:R,max:F}=x,[H,V]=Jp(
y,R,F,D==0?ie:j);if(V==0)return;let q=x.distr==2,oe=g._splits=g.splits(s,y,R,F,H,V,q),ge=x.distr==2?oe.map(Z=>Lt[Z]):oe,fe=x.distr==2?Lt[oe[1]]-Lt[oe[0]]:H,he=g.
_values=g.values(s,g.filter(s,ge,y,V,fe),y,V,fe);g._rotate=T==2?g.rotate(s,he,y,V):0;let ne=g._size;g._size=Pt(g.size(s,he,y,p)),ne!=null&&g._size!=ne&&(f=!1)}),
f}function Zp(p){let f=!0;return ia.forEach((g,y)=>{let x=g(s,y,gn,p);x!=en[y]&&(f=!1),en[y]=x}),f}function Qp(){for(let p=0;p<E.length;p++){let f=E[p];if(!f.show||
!f._show)continue;let g=f.side,y=g%2,x,T,D=f.stroke(s,p),R=g==0||g==3?-1:1,[F,H]=f._found;if(f.label!=null){let ot=f.labelGap*R,gt=Be((f._lpos+ot)*ye);ca(f.labelFont[0],
D,"center",g==2?"top":vl),d.save(),y==1?(x=T=0,d.translate(gt,Be(vt+Ct/2)),d.rotate((g==3?-To:To)/2)):(x=Be(dt+ct/2),T=gt);let wn=hc(f.label)?f.label(s,p,F,H):f.
label;d.fillText(wn,x,T),d.restore()}if(H==0)continue;let V=_[f.scale],q=y==0?ct:Ct,oe=y==0?dt:vt,ge=f._splits,fe=V.distr==2?ge.map(ot=>Lt[ot]):ge,he=V.distr==2?
Lt[ge[1]]-Lt[ge[0]]:F,ne=f.ticks,Z=f.border,Pe=ne.show?ne.size:0,De=Be(Pe*ye),Je=Be((f.alignTo==2?f._size-Pe-f.gap:f.gap)*ye),ve=f._rotate*-To/180,Ne=S(f._pos*ye),
ft=(De+Je)*R,st=Ne+ft;T=y==0?st:0,x=y==1?st:0;let Mt=f.font[0],Dt=f.align==1?us:f.align==2?Qr:ve>0?us:ve<0?Qr:y==0?"center":g==3?Qr:us,Ht=ve||y==1?"middle":g==2?
"top":vl;ca(Mt,D,Dt,Ht);let mt=f.font[1]*f.lineGap,Tt=ge.map(ot=>S(a(ot,V,q,oe))),Nt=f._values;for(let ot=0;ot<Nt.length;ot++){let gt=Nt[ot];if(gt!=null){y==0?x=
Tt[ot]:T=Tt[ot],gt=""+gt;let wn=gt.indexOf(`
`)==-1?[gt]:gt.split(/\n/gm);for(let rt=0;rt<wn.length;rt++){let Da=wn[rt];ve?(d.save(),d.translate(x,T+rt*mt),d.rotate(ve),d.fillText(Da,0,0),d.restore()):d.fillText(
Da,x,T+rt*mt)}}}ne.show&&Cr(Tt,ne.filter(s,fe,p,H,he),y,g,Ne,De,Se(ne.width*ye,3),ne.stroke(s,p),ne.dash,ne.cap);let zt=f.grid;zt.show&&Cr(Tt,zt.filter(s,fe,p,H,
he),y,y==0?2:1,y==0?vt:dt,y==0?Ct:ct,Se(zt.width*ye,3),zt.stroke(s,p),zt.dash,zt.cap),Z.show&&Cr([Ne],[1],y==0?1:0,y==0?1:2,y==1?vt:dt,y==1?Ct:ct,Se(Z.width*ye,
3),Z.stroke(s,p),Z.dash,Z.cap)}Ke("drawAxes")}function Wn(p){k.forEach((f,g)=>{g>0&&(f._paths=null,p&&(o==1?(f.min=null,f.max=null):f.facets.forEach(y=>{y.min=null,
y.max=null})))})}let eo=!1,Lr=!1,Es=[];function eu(){Lr=!1;for(let p=0;p<Es.length;p++)Ke(...Es[p]);Es.length=0}function Gn(){eo||($d(fa),eo=!0)}function tu(p,f=!1){
eo=!0,Lr=f,p(s),fa(),f&&Es.length>0&&queueMicrotask(eu)}s.batch=tu;function fa(){if(br&&(jp(),br=!1),$n&&(Up(),$n=!1),qs){if(_e(m,us,Te),_e(m,"top",Ue),_e(m,Us,
ie),_e(m,Bs,j),_e(b,us,Te),_e(b,"top",Ue),_e(b,Us,ie),_e(b,Bs,j),_e(u,Us,Me),_e(u,Bs,ut),h.width=Be(Me*ye),h.height=Be(ut*ye),E.forEach(({_el:p,_show:f,_size:g,
_pos:y,side:x})=>{if(p!=null)if(f){let T=x===3||x===0?g:0,D=x%2==1;_e(p,D?"left":"top",y-T),_e(p,D?"width":"height",g),_e(p,D?"top":"left",D?Ue:Te),_e(p,D?"heig\
ht":"width",D?j:ie),li(p,An)}else bt(p,An)}),Xs=Bn=vr=Sr=Mr=Tr=Ar=Er=kr=null,ht=1,Cs(!0),Te!=Rn||Ue!=un||ie!=Ut||j!=dn){Wn(!1);let p=ie/Ut,f=j/dn;if(ce&&!fn&&W.
left>=0){W.left*=p,W.top*=f,Hn&&jt(Hn,Be(W.left),0,ie,j),zn&&jt(zn,0,Be(W.top),ie,j);for(let g=0;g<St.length;g++){let y=St[g];y!=null&&(On[g]*=p,Un[g]*=f,jt(y,Pt(
On[g]),Pt(Un[g]),ie,j))}}if(Ee.show&&!Ks&&Ee.left>=0&&Ee.width>0){Ee.left*=p,Ee.width*=p,Ee.top*=f,Ee.height*=f;for(let g in Ir)_e(Yn,g,Ee[g])}Rn=Te,un=Ue,Ut=ie,
dn=j}Ke("setSize"),qs=!1}Me>0&&ut>0&&(d.clearRect(0,0,h.width,h.height),Ke("drawClear"),G.forEach(p=>p()),Ke("draw")),Ee.show&&Ks&&(to(Ee),Ks=!1),ce&&fn&&(bn(null,
!0,!1),fn=!1),Y.show&&Y.live&&kt&&($r(),kt=!1),l||(l=!0,s.status=1,Ke("ready")),As=!1,eo=!1}s.redraw=(p,f)=>{$n=f||!1,p!==!1?nn(L,$.min,$.max):Gn()};function Dr(p,f){
let g=_[p];if(g.from==null){if(Xe==0){let y=g.range(s,f.min,f.max,p);f.min=y[0],f.max=y[1]}if(f.min>f.max){let y=f.min;f.min=f.max,f.max=y}if(Xe>1&&f.min!=null&&
f.max!=null&&f.max-f.min<1e-16)return;p==L&&g.distr==2&&Xe>0&&(f.min=$t(f.min,e[0]),f.max=$t(f.max,e[0]),f.min==f.max&&f.max++),P[p]=f,br=!0,Gn()}}s.setScale=Dr;
let Nr,Rr,Hn,zn,ma,ga,Vn,jn,ya,ba,Ae,Ce,tn=!1,Ze=W.drag,Ye=Ze.x,qe=Ze.y;ce&&(W.x&&(Nr=Et(rd,b)),W.y&&(Rr=Et(id,b)),$.ori==0?(Hn=Nr,zn=Rr):(Hn=Rr,zn=Nr),Ae=W.left,
Ce=W.top);let Ee=s.select=Oe({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Yn=Ee.show?Et(od,Ee.over?b:m):null;function to(p,f){if(Ee.show){for(let g in p)
Ee[g]=p[g],g in Ir&&_e(Yn,g,p[g]);f!==!1&&Ke("setSelect")}}s.setSelect=to;function nu(p){if(k[p].show)de&&li(xe[p],An);else if(de&&bt(xe[p],An),ce){let g=In?St[0]:
St[p];g!=null&&jt(g,-10,-10,ie,j)}}function nn(p,f,g){Dr(p,{min:f,max:g})}function Wt(p,f,g,y){f.focus!=null&&au(p),f.show!=null&&k.forEach((x,T)=>{T>0&&(p==T||
p==null)&&(x.show=f.show,nu(T),o==2?(nn(x.facets[0].scale,null,null),nn(x.facets[1].scale,null,null)):nn(x.scale,null,null),Gn())}),g!==!1&&Ke("setSeries",p,f),
y&&Ls("setSeries",s,p,f)}s.setSeries=Wt;function su(p,f){Oe(N[p],f)}function ou(p,f){p.fill=ue(p.fill||null),p.dir=me(p.dir,-1),f=f??N.length,N.splice(f,0,p)}function ru(p){
p==null?N.length=0:N.splice(p,1)}s.addBand=ou,s.setBand=su,s.delBand=ru;function iu(p,f){k[p].alpha=f,ce&&St[p]!=null&&(St[p].style.opacity=f),de&&xe[p]&&(xe[p].
style.opacity=f)}let qt,sn,yn,qn={focus:!0};function au(p){if(p!=yn){let f=p==null,g=Bt.alpha!=1;k.forEach((y,x)=>{if(o==1||x>0){let T=f||x==0||x==p;y._focus=f?
null:T,g&&iu(x,T?1:Bt.alpha)}}),yn=p,g&&Gn()}}de&&Fn&&z(Tl,se,p=>{W._lock||(mn(p),yn!=null&&Wt(null,qn,!0,Fe.setSeries))});function Gt(p,f,g){let y=_[f];g&&(p=p/
ye-(y.ori==1?Ue:Te));let x=ie;y.ori==1&&(x=j,p=x-p),y.dir==-1&&(p=x-p);let T=y._min,D=y._max,R=p/x,F=T+(D-T)*R,H=y.distr;return H==3?ms(10,F):H==4?Sd(F,y.asinh):
H==100?y.bwd(F):F}function lu(p,f){let g=Gt(p,L,f);return $t(g,e[0],Ve,je)}s.valToIdx=p=>$t(p,e[0]),s.posToIdx=lu,s.posToVal=Gt,s.valToPos=(p,f,g)=>_[f].ori==0?
r(p,_[f],g?ct:ie,g?dt:0):i(p,_[f],g?Ct:j,g?vt:0),s.setCursor=(p,f,g)=>{Ae=p.left,Ce=p.top,bn(null,f,g)};function wa(p,f){_e(Yn,us,Ee.left=p),_e(Yn,Us,Ee.width=f)}
function xa(p,f){_e(Yn,"top",Ee.top=p),_e(Yn,Bs,Ee.height=f)}let Ps=$.ori==0?wa:xa,_s=$.ori==1?wa:xa;function cu(){if(de&&Y.live)for(let p=o==2?1:0;p<k.length;p++){
if(p==0&&Re)continue;let f=Y.values[p],g=0;for(let y in f)nt[p][g++].firstChild.nodeValue=f[y]}}function $r(p,f){if(p!=null&&(p.idxs?p.idxs.forEach((g,y)=>{Q[y]=
g}):Ed(p.idx)||Q.fill(p.idx),Y.idx=Q[0]),de&&Y.live){for(let g=0;g<k.length;g++)(g>0||o==1&&!Re)&&hu(g,Q[g]);cu()}kt=!1,f!==!1&&Ke("setLegend")}s.setLegend=$r;function hu(p,f){
let g=k[p],y=p==0&&ee==2?Lt:e[p],x;Re?x=g.values(s,p,f)??lt:(x=g.value(s,f==null?null:y[f],p,f),x=x==null?lt:{_:x}),Y.values[p]=x}function bn(p,f,g){ya=Ae,ba=Ce,
[Ae,Ce]=W.move(s,Ae,Ce),W.left=Ae,W.top=Ce,ce&&(Hn&&jt(Hn,Be(Ae),0,ie,j),zn&&jt(zn,0,Be(Ce),ie,j));let y,x=Ve>je;qt=ke,sn=null;let T=$.ori==0?ie:j,D=$.ori==1?ie:
j;if(Ae<0||Xe==0||x){y=W.idx=null;for(let R=0;R<k.length;R++){let F=St[R];F!=null&&jt(F,-10,-10,ie,j)}Fn&&Wt(null,qn,!0,p==null&&Fe.setSeries),Y.live&&(Q.fill(y),
kt=!0)}else{let R,F,H;o==1&&(R=$.ori==0?Ae:Ce,F=Gt(R,L),y=W.idx=$t(F,e[0],Ve,je),H=U(e[0][y],$,T,0));let V=-10,q=-10,oe=0,ge=0,fe=!0,he="",ne="";for(let Z=o==2?
1:0;Z<k.length;Z++){let Pe=k[Z],De=Q[Z],Je=De==null?null:o==1?e[Z][De]:e[Z][1][De],ve=W.dataIdx(s,Z,y,F),Ne=ve==null?null:o==1?e[Z][ve]:e[Z][1][ve];if(kt=kt||Ne!=
Je||ve!=De,Q[Z]=ve,Z>0&&Pe.show){let ft=ve==null?-10:ve==y?H:U(o==1?e[0][ve]:e[Z][0][ve],$,T,0),st=Ne==null?-10:A(Ne,o==1?_[Pe.scale]:_[Pe.facets[1].scale],D,0);
if(Fn&&Ne!=null){let Mt=$.ori==1?Ae:Ce,Dt=We(Bt.dist(s,Z,ve,st,Mt));if(Dt<qt){let Ht=Bt.bias;if(Ht!=0){let mt=Gt(Mt,Pe.scale),Tt=Ne>=0?1:-1,Nt=mt>=0?1:-1;Nt==Tt&&
(Nt==1?Ht==1?Ne>=mt:Ne<=mt:Ht==1?Ne<=mt:Ne>=mt)&&(qt=Dt,sn=Z)}else qt=Dt,sn=Z}}if(kt||In){let Mt,Dt;$.ori==0?(Mt=ft,Dt=st):(Mt=st,Dt=ft);let Ht,mt,Tt,Nt,zt,ot,gt=!0,
wn=tt.bbox;if(wn!=null){gt=!1;let rt=wn(s,Z);Tt=rt.left,Nt=rt.top,Ht=rt.width,mt=rt.height}else Tt=Mt,Nt=Dt,Ht=mt=tt.size(s,Z);if(ot=tt.fill(s,Z),zt=tt.stroke(s,
Z),In)Z==sn&&qt<=Bt.prox&&(V=Tt,q=Nt,oe=Ht,ge=mt,fe=gt,he=ot,ne=zt);else{let rt=St[Z];rt!=null&&(On[Z]=Tt,Un[Z]=Nt,Dl(rt,Ht,mt,gt),Cl(rt,ot,zt),jt(rt,Pt(Tt),Pt(
Nt),ie,j))}}}}if(In){let Z=Bt.prox,Pe=yn==null?qt<=Z:qt>Z||sn!=yn;if(kt||Pe){let De=St[0];De!=null&&(On[0]=V,Un[0]=q,Dl(De,oe,ge,fe),Cl(De,he,ne),jt(De,Pt(V),Pt(
q),ie,j))}}}if(Ee.show&&tn)if(p!=null){let[R,F]=Fe.scales,[H,V]=Fe.match,[q,oe]=p.cursor.sync.scales,ge=p.cursor.drag;if(Ye=ge._x,qe=ge._y,Ye||qe){let{left:fe,top:he,
width:ne,height:Z}=p.select,Pe=p.scales[q].ori,De=p.posToVal,Je,ve,Ne,ft,st,Mt=R!=null&&H(R,q),Dt=F!=null&&V(F,oe);Mt&&Ye?(Pe==0?(Je=fe,ve=ne):(Je=he,ve=Z),Ne=_[R],
ft=U(De(Je,q),Ne,T,0),st=U(De(Je+ve,q),Ne,T,0),Ps(Ft(ft,st),We(st-ft))):Ps(0,T),Dt&&qe?(Pe==1?(Je=fe,ve=ne):(Je=he,ve=Z),Ne=_[F],ft=A(De(Je,oe),Ne,D,0),st=A(De(
Je+ve,oe),Ne,D,0),_s(Ft(ft,st),We(st-ft))):_s(0,D)}else Or()}else{let R=We(ya-ma),F=We(ba-ga);if($.ori==1){let oe=R;R=F,F=oe}Ye=Ze.x&&R>=Ze.dist,qe=Ze.y&&F>=Ze.
dist;let H=Ze.uni;H!=null?Ye&&qe&&(Ye=R>=H,qe=F>=H,!Ye&&!qe&&(F>R?qe=!0:Ye=!0)):Ze.x&&Ze.y&&(Ye||qe)&&(Ye=qe=!0);let V,q;Ye&&($.ori==0?(V=Vn,q=Ae):(V=jn,q=Ce),Ps(
Ft(V,q),We(q-V)),qe||_s(0,D)),qe&&($.ori==1?(V=Vn,q=Ae):(V=jn,q=Ce),_s(Ft(V,q),We(q-V)),Ye||Ps(0,T)),!Ye&&!qe&&(Ps(0,0),_s(0,0))}if(Ze._x=Ye,Ze._y=qe,p==null){if(g){
if(La!=null){let[R,F]=Fe.scales;Fe.values[0]=R!=null?Gt($.ori==0?Ae:Ce,R):null,Fe.values[1]=F!=null?Gt($.ori==1?Ae:Ce,F):null}Ls(ei,s,Ae,Ce,ie,j,y)}if(Fn){let R=g&&
Fe.setSeries,F=Bt.prox;yn==null?qt<=F&&Wt(sn,qn,!0,R):qt>F?Wt(null,qn,!0,R):sn!=yn&&Wt(sn,qn,!0,R)}}kt&&(Y.idx=y,$r()),f!==!1&&Ke("setCursor")}let on=null;Object.
defineProperty(s,"rect",{get(){return on==null&&Cs(!1),on}});function Cs(p=!1){p?on=null:(on=b.getBoundingClientRect(),Ke("syncRect",on))}function va(p,f,g,y,x,T,D){
W._lock||tn&&p!=null&&p.movementX==0&&p.movementY==0||(Fr(p,f,g,y,x,T,D,!1,p!=null),p!=null?bn(null,!0,!0):bn(f,!0,!1))}function Fr(p,f,g,y,x,T,D,R,F){if(on==null&&
Cs(!1),mn(p),p!=null)g=p.clientX-on.left,y=p.clientY-on.top;else{if(g<0||y<0){Ae=-10,Ce=-10;return}let[H,V]=Fe.scales,q=f.cursor.sync,[oe,ge]=q.values,[fe,he]=q.
scales,[ne,Z]=Fe.match,Pe=f.axes[0].side%2==1,De=$.ori==0?ie:j,Je=$.ori==1?ie:j,ve=Pe?T:x,Ne=Pe?x:T,ft=Pe?y:g,st=Pe?g:y;if(fe!=null?g=ne(H,fe)?a(oe,_[H],De,0):-10:
g=De*(ft/ve),he!=null?y=Z(V,he)?a(ge,_[V],Je,0):-10:y=Je*(st/Ne),$.ori==1){let Mt=g;g=y,y=Mt}}F&&(f==null||f.cursor.event.type==ei)&&((g<=1||g>=ie-1)&&(g=Mn(g,ie)),
(y<=1||y>=j-1)&&(y=Mn(y,j))),R?(ma=g,ga=y,[Vn,jn]=W.move(s,g,y)):(Ae=g,Ce=y)}let Ir={width:0,height:0,left:0,top:0};function Or(){to(Ir,!1)}let ka,Sa,Ma,Ta;function Aa(p,f,g,y,x,T,D){
tn=!0,Ye=qe=Ze._x=Ze._y=!1,Fr(p,f,g,y,x,T,D,!0,!1),p!=null&&(z(ti,ii,Ea,!1),Ls(Sl,s,Vn,jn,ie,j,null));let{left:R,top:F,width:H,height:V}=Ee;ka=R,Sa=F,Ma=H,Ta=V}
function Ea(p,f,g,y,x,T,D){tn=Ze._x=Ze._y=!1,Fr(p,f,g,y,x,T,D,!1,!0);let{left:R,top:F,width:H,height:V}=Ee,q=H>0||V>0,oe=ka!=R||Sa!=F||Ma!=H||Ta!=V;if(q&&oe&&to(
Ee),Ze.setScale&&q&&oe){let ge=R,fe=H,he=F,ne=V;if($.ori==1&&(ge=F,fe=V,he=R,ne=H),Ye&&nn(L,Gt(ge,L),Gt(ge+fe,L)),qe)for(let Z in _){let Pe=_[Z];Z!=L&&Pe.from==
null&&Pe.min!=ke&&nn(Z,Gt(he+ne,Z),Gt(he,Z))}Or()}else W.lock&&(W._lock=!W._lock,bn(f,!0,p!=null));p!=null&&(ae(ti,ii),Ls(ti,s,Ae,Ce,ie,j,null))}function pu(p,f,g,y,x,T,D){
if(W._lock)return;mn(p);let R=tn;if(tn){let F=!0,H=!0,V=10,q,oe;$.ori==0?(q=Ye,oe=qe):(q=qe,oe=Ye),q&&oe&&(F=Ae<=V||Ae>=ie-V,H=Ce<=V||Ce>=j-V),q&&F&&(Ae=Ae<Vn?0:
ie),oe&&H&&(Ce=Ce<jn?0:j),bn(null,!0,!0),tn=!1}Ae=-10,Ce=-10,Q.fill(null),bn(null,!0,!0),R&&(tn=R)}function Pa(p,f,g,y,x,T,D){W._lock||(mn(p),xr(),Or(),p!=null&&
Ls(Al,s,Ae,Ce,ie,j,null))}function _a(){E.forEach(zf),wr(s.width,s.height,!0)}En(Ao,fs,_a);let Kn={};Kn.mousedown=Aa,Kn.mousemove=va,Kn.mouseup=Ea,Kn.dblclick=Pa,
Kn.setSeries=(p,f,g,y)=>{let x=Fe.match[2];g=x(s,f,g),g!=-1&&Wt(g,y,!0,!1)},ce&&(z(Sl,b,Aa),z(ei,b,va),z(Ml,b,p=>{mn(p),Cs(!1)}),z(Tl,b,pu),z(Al,b,Pa),fi.add(s),
s.syncRect=Cs);let no=s.hooks=t.hooks||{};function Ke(p,f,g){Lr?Es.push([p,f,g]):p in no&&no[p].forEach(y=>{y.call(null,s,f,g)})}(t.plugins||[]).forEach(p=>{for(let f in p.
hooks)no[f]=(no[f]||[]).concat(p.hooks[f])});let Ca=(p,f,g)=>g,Fe=Oe({key:null,setSeries:!1,filters:{pub:Il,sub:Il},scales:[L,k[1]?k[1].scale:null],match:[Ol,Ol,
Ca],values:[null,null]},W.sync);Fe.match.length==2&&Fe.match.push(Ca),W.sync=Fe;let La=Fe.key,Ur=Rc(La);function Ls(p,f,g,y,x,T,D){Fe.filters.pub(p,f,g,y,x,T,D)&&
Ur.pub(p,f,g,y,x,T,D)}Ur.sub(s);function uu(p,f,g,y,x,T,D){Fe.filters.sub(p,f,g,y,x,T,D)&&Kn[p](null,f,g,y,x,T,D)}s.pub=uu;function du(){Ur.unsub(s),fi.delete(s),
Ot.clear(),ci(Ao,fs,_a),c.remove(),se?.remove(),Ke("destroy")}s.destroy=du;function Br(){Ke("init",t,e),aa(e||t.data,!1),P[L]?Dr(L,P[L]):xr(),Ks=Ee.show&&(Ee.width>
0||Ee.height>0),fn=kt=!0,wr(t.width,t.height)}return k.forEach(ra),E.forEach(Vp),n?n instanceof HTMLElement?(n.appendChild(c),Br()):n(s,Br):Br(),s}Ge.assign=Oe;
Ge.fmtNum=vi;Ge.rangeNum=Eo;Ge.rangeLog=Co;Ge.rangeAsinh=wi;Ge.orient=_n;Ge.pxRatio=ye;Ge.join=Rd;Ge.fmtDate=Si,Ge.tzDate=Vd;Ge.sync=Rc;{Ge.addGap=Pf,Ge.clipGaps=
No;let t=Ge.paths={points:Bc};t.linear=Gc,t.stepped=Lf,t.bars=Df,t.spline=Rf}var Io=128,jc=50,Vf=.25,jf=t=>[t.ray,t.truth,t.sensor,t.noReturn],Yf=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),qf=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),Oo=(t,e)=>({font:ho,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function Yc(t,e,n){let s=null,o=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>s&&r()>0&&s.setSize({width:r(),height:Io})).
observe(t),i=>r()<=0?null:((!s||i||o!==n())&&(s?.destroy(),s=e(),s.setSize({width:r(),height:Io}),o=n()),s)}function qc(t,e){let{session:n}=t,s=v("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),o="all",r=t.segmented("Trace",[["all","All"],["first",`First ${jc}`]],()=>o,b=>{o=b,c=null,n.changed()}),
i=0,a=-1/0,l=-1,c=null,d=Yc(s,()=>{let b=jf(e()),w=Array.from({length:i},(S,M)=>({label:`chain ${M+1}`,stroke:b[M%b.length],width:1,points:{show:!1}}));return new Ge(
{width:100,height:Io,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,qf,0,0],scales:{x:{time:!1,range:(S,M,k)=>[M,Math.max(k,M+1)]},y:{range:(S,M,k)=>Zf(
Math.max(M,a),k)}},axes:[Oo(e,26),Oo(e,Yf)],series:[{label:"sweep"},...w],hooks:{draw:[S=>em(S,l,e()),S=>Qf(S,c?.burned??0,e())]}},[[],...w.map(()=>[])],s)},e),
u=v("span",{className:"caption",textContent:"log joint by sweep"}),m=v("div",{className:"charted"},v("div",{className:"buttons"},r,u),s);return t.each(()=>{let b=n.
shown,w=b?.traced?.length?b.trace.length/b.traced.length:0;if(C(m,"hidden",w===0&&(m.hidden||!n.working)),!b||!w)return;let S=n.document?.source.kind==="run"?"d\
raw":"sweep";C(u,"textContent",`log joint by ${S}`);let M=b.layer==="draw"&&n.draws.count?(n.draw+1)*b.traced[b.traced.length-1]/n.draws.count:-1,k=d(w!==i&&(i=
w,!0));if(!k||c===b&&l===M&&k.data[0].length)return;[c,l]=[b,M],a=o==="all"?Xf(b,w):-1/0;let E=Kf(b,w,o);k.setData(E),s.setAttribute("data-sweeps",E[0].join())}),
m}function Kf({trace:t,traced:e},n,s){let o=s==="all"?Jf(e):[...e.keys()].filter(i=>e[i]<=jc),r=i=>Float32Array.from(o,a=>i[a]);return[r(e),...Array.from({length:n},
(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}function Jf(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,s=-1/0;return[...t.keys()].filter(
o=>t[o]<s&&o<e-1?!1:(s=t[o]+n,!0))}function Xf({trace:t,traced:e},n){let s=e.length,o=e.findIndex(r=>r>=Vf*e[s-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.
min(...t.slice(i*s+o,(i+1)*s))))}function Zf(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function Qf(t,e,n){let{left:s,top:o,width:r,height:i}=t.bbox;e&&(t.
ctx.save(),t.ctx.globalAlpha=.12,t.ctx.fillStyle=n.axis,t.ctx.fillRect(s,o,Math.min(r,Math.max(0,t.valToPos(e,"x",!0)-s)),i),t.ctx.restore())}function em(t,e,n){
if(e<0)return;let{left:s,top:o,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<s||a>s+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,o,2,i),t.ctx.
restore())}function Kc(t,e){let{session:n}=t,s=v("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),o=v("div",{className:"\
caption",textContent:"particles by weight, nats below the heaviest"}),r=v("div",{className:"charted"},o,s),a=Yc(s,()=>new Ge({width:100,height:Io,legend:{show:!1},
cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(c,h,d)=>[h,d]},y:{distr:3,range:(c,h,d)=>[.5,Math.max(10,2*d)]}},axes:[Oo(e,26),{...Oo(e,52),values:(c,h)=>h.
map(d=>d>=1?String(d):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Ge.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],s),e),l=null;return t.
each(()=>{let c=n.shown;C(r,"hidden",!c?.weights);let h=c?.weights&&a(!1);if(!c?.weights||!h||l===c&&h.data[0].length)return;l=c;let d=[...c.weights],u=-(c.lowest??
-1)/d.length,m=[...d.map((b,w)=>(c.lowest??-1)+w*u),0];h.setData([m,[...d.map(b=>b||null),null]])}),r}function Jc(t){let{session:e,hand:n}=t,{decisions:s}=e,o=v("p",{className:"said",role:"status"}),r=v("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>s.radius,c=>s.set({radius:c}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>s.risk,c=>s.set({risk:c}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,o),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{C(l,"textContent",i()),C(o,"textContent",n.tool==="path"?tm(t):nm(t))}),a}function tm({session:t}){let{start:e,goal:n,path:s,
trouble:o}=t.decisions;if(o)return o;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!s)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=s.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${we(
s.length_m,2)} m, free with probability ${we(s.probability,3)} ± ${we(s.standard_error,3)} by ${s.draws} draws. Independent cells would say ${we(s.independent,
3)}.${r}`}function nm({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let s=Math.max(...e.
nats),o=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${we(Math.min(...e.nats),1)} to ${we(s,1)} nats, cells taken for indepen\
dent; the best place has a ring.${o}`}var sm=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],om="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",rm="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",im="Shown is what the reading\
s tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (wi\
dth). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",am="While you edit, the answer is belief pr\
opagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",lm="This page samples by itself: the answer is that of the chosen method\
 after as many sweeps as are shown, and gets better as they go on.",cm="The map is made from the scans of this log. Where its poses are raw odometry, Run first \
infers where the robot was; then it samples maps.",hm="This is a saved run: its draws, and what they say together.",pm="Mouse: the wheel zooms, the middle butto\
n pans.",um="Shift or the right button erases, and so does a click on a wall.",dm="Touch: two fingers zoom and pan.";function Xc(t){let{session:e}=t,n=v("div"),
s=Ka.map(([i,a,l])=>{let c=v("tr",{},v("th",{scope:"row"},v("kbd",{textContent:i})),v("td",{textContent:a}));return t.visible(c,()=>fm[l??"all"](e)),c}),o=v("p"),
r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?im:rm,l=e.editable?[`${om} ${a}`,e.figure?lm:am]:i==="log"?[a,cm]:i==="run"?[a,hm]:[
a];l.join()!==r&&n.replaceChildren(...l.map(c=>v("p",{textContent:c}))),r=l.join(),C(o,"textContent",[pm,...e.editable?[um]:[],dm].join(" "))}),t.dialog("Help",
n,o,v("table",{},v("tbody",{},...s)))}var fm={all:()=>!0,drawn:t=>t.editable,asked:t=>t.answers,located:t=>t.locates,edited:t=>!t.recorded,inferred:t=>!t.recorded&&
t.document?.source.kind!=="run"};function Zc(t){let e=()=>v("input",{type:"number",step:1,required:!0,value:"21"}),[n,s]=[e(),e()];for(let i of[n,s])t.bounded(i,
"side");let o=v("select",{});for(let[i,a]of sm){let l=v("option",{value:i,textContent:a});o.append(l),i!=="blank"&&t.each(()=>C(l,"disabled",t.session.figure))}
t.each(()=>t.session.figure&&C(o,"value","blank")),o.addEventListener("change",()=>{o.value==="building"&&Number(n.value)<60&&([n.value,s.value]=["120","80"])});
let r=v("form",{method:"dialog"},t.row("World",o),t.row("Width (cells)",n),t.row("Height (cells)",s),v("div",{className:"buttons end"},v("button",{type:"submit",
className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),Number(s.value)],world:o.value}),
t.hand.selected=null}),t.dialog("New map",r)}var mm="The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser \
while the server runs; the part from # on can be put after the address of any bayesmap page.",gm="The link holds the walls, the sensors and all settings after i\
ts #. The part from # on can be put after the address of any bayesmap page.",ym="The link holds the file's name and all settings after its #, but no scans and n\
o token. It opens in this browser while the server shows this file; the part from # on can be put after the address of any bayesmap page that shows it.";function Qc(t){
let e=v("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=v("span",{role:"status",className:"copied"}),s=async()=>{e.select();try{await navigator.clipboard.
writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},o=t.button(null,"Copy the link",s,{className:"\
primary",text:"Copy"}),r=v("p");t.each(()=>C(r,"textContent",t.session.figure?gm:t.session.document?.source.kind==="simulation"?mm:ym));let i=t.dialog("Share",r,
v("div",{className:"buttons"},e,o),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var bm=8;function eh(t){let{session:e,hand:n}=t,s=v("p",{className:"words",role:"status"}),o=v("ol",{className:"spoken"}),r=v("p",{className:"words"}),i=v("canv\
as",{className:"trace",width:296,height:48,role:"img"}),a=v("p",{className:"caption"}),l=t.section("Evidence of beams",s,r,o,i,a),c=-1;return t.visible(l,()=>n.
tool==="evidence"),t.each(()=>{let{evidence:h}=e;if(C(s,"textContent",km(e)),c===h.version)return;c=h.version,C(r,"textContent",xm(e));let d=vm(i,h.each?.trace,
e.draws.chains);C(i,"hidden",!d.length),C(a,"textContent",d.length?`Share of draws so far with a wall, by draw: ${d.map((S,M)=>`chain ${M+1} ${S.toFixed(2)}`).join(
", ")}`:"");let{nats:u,scan:m,beam:b}=h.each??{nats:[],scan:[],beam:[]},w=Array.from(u.slice(0,bm),(S,M)=>v("li",{},`${os(S)} nats: ${wm(e,m[M],b[M])}`));o.replaceChildren(
...w)}),l}var wm=({document:t,editable:e},n,s)=>`beam ${s+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function xm({evidence:{together:t},quantity:e}){
if(!t?.beams||e.kind!=="binary"||t.nats_for===null||t.nats_against===null)return"";let{prior_nats:n,log_odds:s,draw:o,nats_for:r,nats_against:i}=t;if(o==null)return"\
Each beam is asked by itself, with the other cells as probable as they are: the sum is not the log odds of P(wall). Show one draw for that.";if(n==null||s===null||
s===void 0)return`Given all other cells of draw ${o+1}.`;let a=1/(1+Math.exp(-s));return`Given all other cells of draw ${o+1}: prior ${os(n)}, beams ${os(r-i)},\
 together log odds ${os(s)}: Gibbs draws a wall with probability ${a.toFixed(3)}.`}function vm(t,e,n){let s=e&&n?e.length/n:0,o=s?t.getContext("2d"):null,r=o&&getComputedStyle(
t);return o?.clearRect(0,0,t.width,t.height),Array.from({length:s?n:0},(i,a)=>{let l=0;o?.beginPath();for(let c=0;c<s;c++)l+=e[a*s+c],o?.lineTo(t.width*(c+.5)/s,
2+(t.height-4)*(1-l/(c+1)));return o&&r&&(o.strokeStyle=r.getPropertyValue(a?"--truth":"--ray")||"gray"),o?.stroke(),l/s})}function km({evidence:t,quantity:e}){
let{cell:n,together:s}=t;if(!n)return"Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";let o=`Cell ${n.
x}, ${n.y}`;if(!s)return`${o}: asking its beams.`;if(!s.beams)return`${o}: no beam reaches it.`;let r=s.beams===1?"1 beam":`${s.beams} beams`;if(s.nats_for===null||
s.nats_against===null)return`${o}: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"its surface"}[e.kind]??"what is there",a=s.beams_for||
s.beams_against?"":" None of them says anything.";return`${o}: ${r}. For ${i} (blue) ${s.beams_for}, ${s.nats_for.toFixed(1)} nats; against (orange) ${s.beams_against}\
, ${s.nats_against.toFixed(1)} nats.${a}`}var Zt=t=>t.charAt(0).toUpperCase()+t.slice(1),Uo=class{text="Connecting";level="info";until=0;say(e,n,s){this.text=Zt(e),this.level=n,this.until=s}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var th=t=>Math.round(t*180/Math.PI);function nh(t){let{session:e,hand:n}=t,{ghost:s}=e,o=(l,c)=>t.numberInput(l,()=>Number((s.pose?.[c]??0).toFixed(2)),h=>s.move(
{[c]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>th(s.pose?.yaw??0),l=>s.move({yaw:l*Math.PI/180}),{step:5}),i=v("p",{className:"words ghosted"}),a=t.
section("Ghost",v("div",{className:"triple"},o("Ghost x","x"),o("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>C(i,"textContent",Sm(t))),
a}function Sm({session:t}){let{ghost:e}=t;if(e.trouble)return Zt(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:s,high:o,near:r}=e.fan,i=Array.from(o,(h,d)=>h-s[d]).filter(Number.isFinite).sort((h,d)=>h-d),a=i.length?`${we(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",c=r?` \
Rings are the hits of scan ${r.index+1}, taken ${we(100*r.away,0)} cm from here, turned by ${th(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${c}`}function sh(t){let{session:e}=t,n=v("span",{className:"what"});t.each(()=>{let{grid:c,source:h}=e.document??{};if(!c||!h)return;let d=`${c.shape[0]} × ${c.shape[1]}\
 cells of ${+c.resolution.toPrecision(3)} m`;C(n,"textContent",h.name?`${h.name}, ${d}`:d)});let s=()=>!e.recorded&&!!e.document,o=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo,why:"Nothing of this page to undo"}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"\
Redo (Ctrl+Y)",when:()=>!!e.state?.can_redo,why:"Nothing to redo"}),v("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:s}),
...t.embedded?[]:[t.button("link","Share",()=>t.command("share"),{text:"Share",when:s})]];for(let c of o)t.visible(c,()=>!e.recorded);let r=t.button("theme","Th\
eme: automatic",()=>t.command("theme")),i=t.button("help","Help",()=>t.command("help"),{title:"Help (?)"}),a=v("span",{className:"space"});return{element:v("hea\
der",{},v("h1",{textContent:"bayesmap"}),n,a,...o,Tm(t),r,i),nameTheme(c){let h=`Theme: ${c}`;et(r,"aria-label",h),C(r,"title",h)}}}var Mm=({shown:t,draws:e})=>e.
count>0||/importance|propagate/.test(t?.method??"");function Tm(t){let{session:e}=t,n=(l,c,h,d,u)=>{let m=t.button(null,l,()=>t.command(`export ${c}`),{text:l,when:d,
why:u});return h!=="all"&&t.visible(m,()=>!e.recorded&&(h==="document"||!e.figure)),m},s=n("Figure that samples by itself (HTML)","figure","server");t.visible(s,
()=>e.editable&&!e.figure);let o=v("div",{className:"menu",hidden:!0},n("Picture (PNG)","png","all"),n("Saved run (netCDF)","run","server",()=>Mm(e),"There are \
no draws yet: chains keep them"),n("Map for robots (YAML and PGM)","map","server"),n("Page in one file (HTML)","html","server"),s,n("Document (JSON)","document",
"document")),r=t.button("save","Export",()=>i(o.hidden),{text:"Export",when:()=>!!e.document}),i=l=>{o.hidden=!l,r.setAttribute("aria-expanded",String(l)),l&&o.
firstElementChild.focus()};i(!1);let a=v("div",{className:"anchor"},r,o);return a.addEventListener("keydown",l=>{l.key!=="Escape"||o.hidden||(i(!1),r.focus(),l.
stopPropagation())}),a.addEventListener("focusout",l=>{a.contains(l.relatedTarget)||i(!1)}),o.addEventListener("click",()=>{i(!1),r.focus()}),a}var Am={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function hn(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",Am[t]),e.append(n),e}var Bo=({document:t})=>!t||t.source.kind==="simulation",Li=({answers:t})=>t,oh="surface (zoom in)",rh=[{mark:"truth",text:"true wall",when:Bo,may:Bo},{mark:"ray",
text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.strokes.
length,may:t=>!Bo(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!Bo(t)},{mark:"unobserved",text:"unobserved"},{mark:"\
draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Li},{mark:"\
path",text:"path, as wide as the robot",when:({decisions:t})=>!!(t.path&&t.pathShown),may:Li}],ih=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 %\
 of a place"}],ah=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function lh(t,e,n){let s=v("p",{className:"sentence"});return t.
each(()=>C(s,"textContent",Em(t.session))),v("div",{className:"legend"},s,Pm(t,e,n),_m(t))}var Ci=(t,e)=>`${t.toLocaleString("en")} ${e}${t===1?"":"s"}`;function Em(t){
let{shown:e,document:n,layer:s,quantity:o,draws:r}=t;if(!e||!n)return"";let{kind:i,mean:a,value:l}=o,c={mean:i==="binary"?"How probable a wall is in each cell":
Zt(`${a} of each cell`),draw:`One map drawn from the posterior${i==="binary"?"":`, by its ${l}`}${r.count?`, ${t.draw+1} of ${r.count}`:""}`,entropy:"How uncert\
ain each cell is, in bits",width:"How wide the 90 % interval of each cell is"}[s];if(e.method==="none")return`${c} before any reading: the prior.`;let{source:h,
angles:d,sensors:u,scans_used:m}=n,b=h.kind==="simulation"?`${Ci(d*u.length,"beam")} of ${Ci(u.length,"sensor")}`:Ci(m??h.scans,"scan"),S=(e.method==="propagate"||
e.method==="pilot"||/hits|counts/.test(e.method))&&e.approximate?", approximately":s!=="draw"&&e.burned?`: the mean of the sweeps after the first ${e.burned}`:"";
return`${c}, given ${b}${S}.`}function Pm(t,e,n){let{session:s}=t,o=v("span",{className:"ramp"}),r=v("span",{className:"name"}),i=rh.map(h=>{let[d,u]=Wo(h),{mark:m,
when:b}=h;return b&&t.visible(d,()=>b(s)),m==="stroke"&&t.each(()=>C(u,"textContent",Fs(n())?h.text:oh)),m==="path"&&t.each(()=>d.firstElementChild?.classList.toggle(
"risky",s.decisions.path?.within_risk===!1)),d}),[a,l]=[ih,ah].map(h=>h.map(d=>Wo(d)[0]));for(let h of a)t.visible(h,()=>!!s.where.found);for(let h of l)t.visible(
h,()=>!!s.evidence.cellShown);let c="";return t.each(()=>{let{layer:h}=s;C(r,"textContent",ch(s,h));let d=h==="entropy"||h==="width",u=`${d} ${e().ground}`;c!==
u&&(c=u,o.style.background=jr(d?ns:m=>Vr(e(),m)))}),v("ul",{"aria-label":"Legend"},v("li",{},r,v("span",{className:"scale"},"0",o,"1")),...i,Cm(t),...a,...l)}function _m(t){
let{session:e}=t,n=["mean","draw","entropy","width"].map(c=>{let h=v("span");return t.each(()=>C(h,"textContent",ch(e,c))),c==="width"&&t.visible(h,()=>e.quantity.
interval),h}),s=rh.map(c=>{let[h,d]=Wo(c);c.mark==="stroke"&&(d.textContent=oh);let{may:u}=c;return u&&t.visible(h,()=>u(e)),h}),o=v("span",{className:"scale"},
"00.0",v("span",{className:"ramp"}),"000.0 nats"),r=[ih,ah].map(c=>v("ul",{},...c.map(h=>Wo(h)[0]))),i=[v("ul",{},v("li",{},"one more scan tells",o)),...r],a=v(
"li",{className:"either"},...i);t.visible(a,()=>Li(e));let l=v("span",{className:"scale"},"0",v("span",{className:"ramp"}),"1");return v("ul",{className:"room",
"aria-hidden":"true"},v("li",{},v("span",{className:"name either"},...n),l),...s,a)}function Wo({mark:t,text:e}){let n=v("i",{className:t});t==="sensor"&&n.append(
hn("sensor"));let s=v("span",{textContent:e});return[v("li",{},n,s),s]}function ch({quantity:t},e){let{kind:n,mean:s,value:o}=t;return e==="entropy"?"entropy (b\
it)":e==="width"?"width of the 90 % interval":n==="binary"?"P(wall)":e==="draw"?o:s}function Cm(t){let{decisions:e}=t.session,n=v("span",{className:"ramp"});n.style.
background=jr(ns);let[s,o]=[v("span"),v("span")],r=v("li",{className:"views"},"one more scan tells",v("span",{className:"scale"},s,n,o));return t.visible(r,()=>e.
looking&&!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(C(s,"textContent","0"),C(o,"textContent",`${we(Math.max(...i),1)} nats`))}),r}var Lm=[.05,.1,.2,.4,.8],Dm=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function hh(t){let{session:e}=t,n=v("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),s="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,c=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...Lm,r.resolution])].sort((u,m)=>u-m),[,d]=t.limits("side_of_log");if(s!==`${h} ${d}`){s=`${h} ${d}`;let u=m=>v("option",
{value:String(m),textContent:Dm(m),disabled:c/m>d-1});n.replaceChildren(...h.map(u))}C(n,"value",String(r.resolution))});let o=t.row("Cell size",n);return t.visible(
o,()=>e.document?.source.kind==="log"),o}function ph(t){let{session:e}=t,n=v("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),s=v("output"),o=()=>e.
document?.source.scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=o()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});
let i=t.section("Log",v("div",{className:"player bare"},n,s));return t.visible(i,()=>!e.recorded&&e.document?.source.kind==="log"&&o()>1),t.each(()=>{let a=o(),
l=e.document?.scans_used??a;C(n,"max",String(Math.max(1,a))),(!Sn(n)||Number(n.value)!==l)&&C(n,"value",String(l));let c=l===a?`all ${a} scans`:`after ${l} of ${a}`;
n.style.setProperty("--fill",`${100*(l-1)/Math.max(1,a-1)}%`),et(n,"aria-valuetext",c),C(s,"textContent",c)}),i}var Nm=20,Rm={importance:"particles",propagate:"rounds"},Go=({working:t,shown:e})=>t&&e?.method==="pilot";function uh(t,...e){let{session:n}=t,s=v("progress",{max:1,
value:0,"aria-label":"Progress"}),o=v("div",{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.
source.kind==="log"),l=Go(n),c=i?i.done/i.total:r&&!a&&r.total>0&&(l||!r.approximate)?r.sweeps/r.total:0;C(s,"value",c);let h=n.remaining_s(),d=Rm[r?.method??""]??
"sweeps",u=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${d}`:"",m=h!==null?h<1?"less than 1 s left":`${Math.ceil(h)} s left`:n.running?"running":"",b=u&&
r?.burned?`the first ${r.burned} left out`:"",w=n.sampling||n.running||!r||r.sweeps>=r.total?"":"stopped";i?C(o,"textContent",`${i.text}: ${i.done} of ${i.total}\
 ${i.total>Nm?"scans":"rounds"}`):a?C(o,"textContent","Computing"):r&&l?C(o,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):C(o,"textConten\
t",Zt([u,b,m,u&&w].filter(Boolean).join(", "))||$m(n))}),t.section("Posterior",Fm(t),s,o,Im(t),Um(t),...e,Om(t))}function $m({shown:t,working:e,document:n}){let s=n?.
method==="importance"?"; Run weighs particles":"";return t?.method==="propagate"?`${t.sweeps} rounds of belief propagation${s}`:t?.method==="hits"?"Counts of hi\
ts and passes":t?.method==="counts"?"Run infers where the robot was":t?.method==="pilot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function Fm(t){
let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"primary",text:"Run",title:"Run (R): more sweeps of the chains on show",when:()=>e.connection.
connected,why:"Not while the connection is lost"}),s=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||
e.sampling||Go(e),why:"Nothing is running"}),o=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chains, and Run\
 goes on from their draws"),r=v("div",{className:"buttons"},n,s,o);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function Im(t){let{session:e}=t,
n=v("dl"),s=(r,i,a,l=!1)=>{let c=v("dd",{textContent:"–"}),h=v("div",{title:i},v("dt",{textContent:r}),c);return n.append(h),t.each(()=>{C(c,"textContent",e.shown?
a(e.shown):"–"),l&&C(c,"className",e.shown?.verdict?.level??"")}),h};s("ESS","Effective sample size of the log joint",r=>we(r.ess,0),!0),s("R-hat","Agreement \
of the chains on the log joint; 1 is full",r=>we(r.rhat,3),!0),s("log joint","Log of prior times likelihood at the last sweep",r=>we(r.log_joint,Math.abs(r.log_joint??
0)<1e5?1:0)),s("time","Time spent on sweeps, rounds or particles",r=>we(r.seconds,1," s"));let o=s("reply","From the hand's last move to its picture",()=>we(e.latency.
eventToPaint_ms.at(-1),0," ms"));return t.visible(o,()=>!e.recorded),n}var Di=({shown:t})=>t?.method==="importance"?{good:"Enough particles",fair:"Few particles",
bad:"Collapsed"}:{good:"Converged",fair:"Nearly converged",bad:"Not converged"};function Om(t){let{session:e}=t,n=v("dl",{className:"about"}),s=v("details",{},v(
"summary",{textContent:"Model and method of this picture"}),n),o="";return t.each(()=>{let r=e.shown?.about??[];C(s,"hidden",!r.length),String(r)!==o&&(o=String(
r),n.replaceChildren(...r.flatMap(([i,a])=>[v("dt",{textContent:i}),v("dd",{textContent:a})])))}),s}function Um(t){let{session:e}=t,n=v("span"),s=t.button(null,
"Show the cell",()=>t.command(`cell ${e.shown?.verdict?.cell}`),{text:"Show the cell"});t.visible(s,()=>!!e.shown?.verdict?.cell);let o=v("div",{className:"verd\
ict"},n,s);return t.each(()=>{let r=e.shown?.verdict;if(!r)return C(o,"hidden",o.hidden||!e.working),C(n,"textContent","Too early to judge."),C(o,"className","v\
erdict early");C(o,"hidden",!1),C(n,"textContent",`${Di(e)[r.level]}: ${r.why}`),C(o,"className",`verdict ${r.level}`)}),o}var Bm="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",dh=200,
Wm="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",fh="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",Gm="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function yh(t){let{session:e}=t,n=v("span",{className:"chip"}),s=t.button(null,"Not converged",()=>mh(
e)?.apply?.(),{text:"Not converged",className:"chip doubt"}),o=v("div",{className:"chips"},n,s);return t.each(()=>{let r=mh(e);if(C(s,"hidden",!r),r){let u=[Di(
e).bad,r.text].filter(Boolean).join(": ");C(s.firstElementChild,"textContent",u.charAt(0).toLowerCase()+u.slice(1)),C(s,"title",`${e.shown?.verdict?.why}.${r.apply?
` Click to ${r.text}.`:""}`),C(s,"disabled",!r.apply),et(s,"aria-label",u)}let i=e.shown;if(!i||!e.document)return C(o,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",l=i.layer==="draw"?a+(e.flicker.under?" over the mean":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="en\
tropy"?"entropy":"mean";if(i.method==="counts"){C(o,"hidden",!1);let u=e.halfway?"along poses found so far":"along raw odometry";return C(n,"textContent",`hits \
and passes · ${e.stage?e.stage.text.toLowerCase():u}`),C(n,"className","chip approximate")}let c={importance:"importance sampling",propagate:"belief propagatio\
n"}[i.method],h=e.document.method==="importance"&&i.method==="propagate"?", until Run weighs particles":"",d=i.approximate?`approximate, ${Hm(i,e.working)}${h}`:
c??`${i.sweeps} sweeps`;C(o,"hidden",!1),C(n,"textContent",`${l} · ${d}`),C(n,"className",i.approximate?"chip approximate":"chip")}),o}function Hm({method:t,sweeps:e,
total:n,averaged:s},o){return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${s===1?"1 draw":`${s} draws`} of one chain, sensor ${o?"being":"hal\
f"} fitted: sweep ${e} of ${n}`}function mh(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n)return null;if(t.recorded||n.source.kind==="run")return{
text:""};let s=a=>()=>t.act({type:"set",patch:a}),o=e.sweeps<dh,r=n.pose_sigma===0&&n.heading_sigma===0;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!o&&
r)return{text:"try blocks",apply:s({method:"block"})};if(e.method==="importance")return{text:"try Gibbs",apply:s({method:"auto"})};if(e.sweeps<e.total)return null;
if(!r&&!o)return{text:"poses are too uncertain"};let i=Math.min(t.limits?.sweeps[1]??0,Math.max(dh,4*n.sweeps));return i>n.sweeps?{text:`try ${i} sweeps`,apply:s(
{sweeps:i})}:{text:""}}function bh(t){let{session:e}=t,n=v("span"),s=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),o=v("div",{
className:"banner",role:"alert",hidden:!0},n,s);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??
0)/1e3));C(o,"hidden",!r&&e.worker!=="restarted"),C(o,"className",r?"banner":"banner mild"),C(s,"hidden",!r);let a=`Connection lost. Trying again in ${i} s; the\
 map is kept here.`,l=e.connection.refused?Bm:a;C(n,"textContent",r?l:"The worker stopped and is being started again. The map is kept.")}),o}function wh(t){let{
session:e,hand:n}=t,s=v("div",{className:"readout",id:`${t.prefix}-readout`}),o=v("span",{role:"status","aria-live":"polite"}),r=v("span",{className:"hidden","a\
ria-live":"polite"});return n.announce=i=>C(r,"textContent",i),n.describe=i=>gh(e,i),t.each(()=>{let{kind:i}=e.quantity;C(s,"title",i==="binary"?Wm:i==="surface"?
`${fh}. ${Gm}`:fh);let a=n.cursor??n.hover,c=matchMedia("(pointer: coarse)").matches?"Touch a cell":e.editable?"Point at a cell, or press ? for the keys":"Point\
 at a cell";C(s,"textContent",a?gh(e,a):c);let h=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad",d=e.status.text==="Ready"&&Go(e),u=e.shown?.method==="\
importance"?"Ready, but importance sampling has collapsed":"Ready, but the chains have not converged",m=e.everConnected&&!e.connection.connected&&e.status.level===
"info";C(o,"textContent",m?"Connection lost":h?u:d?"Fitting the sensor":e.status.text),C(o,"className",m?"error":h?"warning":d?"busy":e.status.level)}),{element:v(
"footer",{},o,s,r),readout:s}}function gh(t,e){let{document:n,shown:s}=t;if(!n)return"";let{resolution:o,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.
log10(o))+1),{x:l,y:c}=Qn(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${c.toFixed(a)} m`];if(s&&s.p.length===r[0]*r[1]){let d=s.p[i]/255,{kind:u,mean:m,
value:b,interval:w}=t.quantity;s.layer==="width"?h.push(`90 % interval ${d.toFixed(2)} wide`):u!=="binary"&&s.layer==="draw"?h.push(`${b} ${d.toFixed(2)} in thi\
s draw`):u!=="binary"?h.push(`${m} ${d.toFixed(2)}`,...w?[]:[`entropy ${Rs(d).toFixed(2)} bit`]):s.layer==="draw"?h.push(d>.5?"wall in this draw":"free in this \
draw"):h.push(`P(wall) ${d.toFixed(2)}`,`entropy ${Rs(d).toFixed(2)} bit`);let S=t.evidence.facts,M=S?.x===e.x&&S.y===e.y?S:null,k=M?M.beams:null,E=s.reached[i]/
255,_=n.source.kind==="run";if(E?!_&&E<.995&&h.push(`reached by a beam with probability ${E.toFixed(2)}`):h.push(_?"reached by a beam in less than half of the d\
raws":"unobserved"),E&&k!==null&&h.push(k===1?"1 beam":`${k} beams`),E&&M&&M.nats_for!==null&&M.nats_against!==null&&k){let N={binary:"a wall",surface:"its surf\
ace"}[t.quantity.kind]??"what is there";h.push(`for ${N} ${M.beams_for}, ${M.nats_for.toFixed(1)} nats`,`against ${M.beams_against}, ${M.nats_against.toFixed(1)}\
 nats`)}}return h.join(" · ")}var zm={logged:"as logged",odometry:"from raw odometry"},Vm=180/Math.PI;function xh(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",s=t.select("Poses",
zm,()=>e.document?.poses??"logged",a=>t.set({poses:a}));s.classList.add("wide"),t.visible(s,n);let o=[t.slider("pose_sigma",()=>"Position ±",{step:.05,unit:" m"}),
t.slider("heading_sigma",()=>"Yaw ±",{step:.5,unit:"°",scale:Vm})];for(let a of o)t.visible(a,()=>e.editable);let r=v("p",{className:"caption"});t.each(()=>{let{
pose_sigma:a=0,heading_sigma:l=0,method:c="auto"}=e.document??{},h=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,d=e.editable&&(a>
0||l>0)&&!/auto|gibbs|block/.test(c);C(r,"hidden",!d&&!h),C(r,"textContent",h?"Run infers where the robot was.":"This method takes poses as known; Gibbs does no\
t.")});let i=t.section("Where the robot was",s,...o,r);return t.visible(i,()=>e.editable&&!e.figure||n()&&!e.recorded),i}var Ho=t=>Math.abs(t)<.995?`${we(100*Math.abs(t),1)} cm`:`${we(Math.abs(t),2)} m`,jm="Point at a reading to compare it with what the posterior predicts of it.",
Ym=": preparing the comparison. The first one after an installation takes some seconds.";function vh(t){let{session:e}=t,n=v("p",{className:"words reading",role:"\
status"}),s=t.section("Reading",n);return t.visible(s,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:o,found:r,trouble:i,
slow:a}=e.reading,l=o?`Beam ${o.beam+1} of scan ${o.scan+1}${a?Ym:"."}`:jm;C(n,"textContent",i||(r?qm(r):l))}),s}function qm({scan:t,beam:e,reading:n,range:s,low:o,
median:r,high:i,residual:a,no_return:l,wall:c}){let h=`Beam ${e+1} of scan ${t+1}`,d=(M,k)=>M===null?k:`${we(M,2)} m`,u=`median ${d(r,"no return")}, 80 % betwee\
n ${d(o,"too close")} and ${d(i,"no return")}`;if(n==="none")return`${h} came back from nothing, which was predicted with probability ${we(l??0,3)} (${u}).`;if(n!==
"hit"||s===null)return`${h} read nothing that says how far (${u}).`;let m=a===null?"":`, ${Ho(a)} ${a<0?"shorter":"longer"} than the predicted median`,b=`${h} r\
ead ${we(s,2)} m${m} (${u}).`;if(!c)return b;let w=`${Ho(c.across_m)} ${c.across_m<0?"behind":"in front of"} the wall, which is ${Ho(c.thickness_m)} thick`,S=`${Ho(
c.along_m)} to the ${c.along_m<0?"right":"left"} along it from the middle of its surface`;return`${b} It ended ${w} (one standard deviation), and ${S}; the beam\
 met it at ${we(c.incidence_rad*180/Math.PI,0)}° from its normal.`}function Ni(t){let e=/^#step=(\d+)$/.exec(t);return e&&Math.max(0,Number(e[1])-1)}var Vo=t=>`#step=${t+1}`,zo=class{constructor(e){this.session=e}story=null;at=0;onstep=()=>{};get step(){
return this.story?.steps[this.at]??null}get last(){return(this.story?.steps.length??1)-1}go(e){this.at=Math.min(Math.max(e,0),this.last);let{step:n}=this;n&&(this.
bring(n.document),this.session.view.layer!==n.layer&&this.session.act({type:"view",layer:n.layer}),this.onstep(this.at),this.session.changed())}solve(){this.step?.
solution&&this.bring(this.step.solution)}bring(e){let{session:n}=this;n.state&&!n.state.live&&n.act({type:"live",on:!0}),n.bring(e),n.answers&&e.method==="impor\
tance"&&n.act({type:"run"})}};function kh(t){let{telling:e}=t.session,[n,s,o]=[v("h3"),v("p"),v("p",{className:"task"})],r=v("div",{className:"told","aria-live":"polite"},n,s,o),i=v("nav",{"\
aria-label":"Steps"}),a=m=>()=>e.go(e.at+m),l=v("div",{className:"buttons"},t.button(null,"Back",a(-1),{text:"Back",when:()=>e.at>0}),t.button(null,"Next",a(1),
{className:"primary",text:"Next",when:()=>e.at<e.last}),t.button(null,"Start this step again",a(0),{text:"Again"})),c=t.button(null,"Show me",()=>e.solve(),{text:"\
Show me"});t.visible(c,()=>!!e.step?.solution),l.append(c);let h=t.section("Story",i,r,l);h.className="story";let d=h.querySelector("h2");t.visible(h,()=>!!e.story);
let u=null;return t.each(()=>{let{story:m,step:b,at:w}=e;!m||!b||(u!==m&&i.replaceChildren(...m.steps.map(({title:S},M)=>{let k=E=>{E.preventDefault(),e.go(M)};
return v("a",{href:Vo(M),title:S,"aria-label":`Step ${M+1}: ${S}`,textContent:String(M+1),onclick:k})})),u=m,C(d,"textContent",m.title),C(n,"textContent",b.title),
C(s,"textContent",b.text),C(o,"textContent",b.task),Array.from(i.children).forEach((S,M)=>et(S,"aria-current",M===w?"step":"false")))}),h}var Km={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Jm={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},Xm={noisy:"with noise",exact:"exact"},Zm={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},Qm={raster:"raster",radial:"radial",random:"random"},jo=2*Math.PI,eg=t=>Math.round(t*1800/Math.PI)/10,tg={importance:"Particles",propagate:"Round\
s"};function Sh(t){let{session:e,hand:n,editor:s}=t,o=v("select",{"aria-label":"Selected sensor"});o.addEventListener("change",()=>{n.selected=Number(o.value),n.
choose("sensor")});let r="";t.each(()=>{let d=e.document?.sensors??[],u=d.map(m=>m.id).join();u!==r&&o.replaceChildren(...d.map(({id:m})=>v("option",{value:String(
m),textContent:`Sensor ${m}`}))),r=u,C(o,"value",String(n.sensor?.id??""))});let i=(d,u)=>t.numberInput(d,()=>Number((n.sensor?.[u]??0).toFixed(2)),m=>n.sensor&&
s.moveSensor(n.sensor,{[u]:m}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),d=>n.sensor&&s.moveSensor(n.sensor,{yaw:d%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),c=t.button("minus","Remove the sensor",()=>s.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1,why:"The last sensor stays"});t.visible(a,()=>(e.document?.fov??jo)<jo);let h=v("div",{className:"triple"},i(
"x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",v("div",{className:"buttons"},o,l,c),h)}function Mh(t){let{session:e}=t,n=t.numberInput("Longest range\
 (m)",()=>e.document?.max_range??0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),s=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("\
angles",()=>"Angles",{step:1,log:!0}),n,t.numberInput("Field of view (°)",()=>eg(e.document?.fov??jo),a=>t.set({fov:a>=360?jo:a*Math.PI/180}),{step:5,limits:"f\
ov",scale:180/Math.PI}),t.select("Readings",Xm,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of s)t.visible(a,()=>e.editable);let o=t.slider(
"prior",()=>"Prior P(wall)",{step:.01}),r=()=>(e.document?.cells??"binary")==="binary";t.visible(o,r);let i=t.select("Cells",Jm,()=>e.document?.cells??"binary",
a=>t.set({cells:a}));return t.visible(i,()=>e.document?.source.kind==="log"),t.section("Model",i,hh(t),o,...s)}function Th(t){let{session:e}=t,n=()=>e.document?.
method??"auto",s=()=>(e.document?.cells??"binary")==="binary",o=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",Km,n,l=>t.set({method:l})),t.select("Order",
Qm,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||n()==="auto","Only Gibbs, cell by cell, has an order"),t.select("Start",Zm,()=>e.document?.
start??"auto",l=>t.set({start:l}),o,"Only chains have a start")],i=Array.from(r[0].lastElementChild.children);for(let l of i)l.value==="propagate"&&t.visible(l,
()=>!e.figure);for(let l of r)t.visible(l,s);let a=t.slider("burn_in",()=>"Burn-in (%)",{step:5,scale:100});return t.visible(a,()=>o()||!s()),t.section("Inferen\
ce",...r,a,t.slider("sweeps",()=>tg[n()]??"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{step:1,limits:"\
seed"}))}function Ah(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),s=t.button(
null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",v("div",{className:"\
buttons"},n,s))}var ng=0,Yo=class{constructor(e,n,s,o,r,i){this.session=e;this.hand=n;this.editor=s;this.command=o;this.showLayer=r;this.embedded=i}prefix=`bayesmap${ng++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[s,o]=this.session.limits?.[e]??[1,
2];return n===1?[s,o]:[Math.ceil(10*s*n-1e-6)/10,Math.floor(10*o*n+1e-6)/10]}bounded(e,n,s=1){this.each(()=>{let[o,r]=this.limits(n,s);C(e,"min",String(o)),C(e,
"max",String(r))})}visible(e,n){this.each(()=>C(e,"hidden",!n()))}button(e,n,s,{className:o="",text:r="",when:i,why:a,title:l}={}){let c=v("button",{type:"butto\
n",className:o,title:l??n,onclick:s},e&&hn(e));return r&&c.append(v("span",{textContent:r})),r!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>{C(c,"disabl\
ed",!i()),a&&C(c,"title",c.disabled?a:l??n)}),c}segmented(e,n,s,o,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=v("div",{className:"segmented",role:"radiog\
roup","aria-label":e});for(let[l,c,h]of n){let d=v("input",{type:"radio",name:i,value:l,onchange:()=>o(l)});a.append(v("label",{title:c},d,h?hn(h):null,v("span",
{textContent:c}))),this.each(()=>{C(d,"checked",s()===l),r&&C(d,"disabled",!r(l))})}return a}section(e,...n){let s=`${this.prefix}-${e.replace(/\W/g,"")}`;return v(
"section",{"aria-labelledby":s},v("h2",{id:s,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,v("div",{className:"row"},v("lab\
el",{for:n.id,textContent:e}),n)}slider(e,n,{step:s,log:o=!1,unit:r="",scale:i=1}){let a=`${this.prefix}-${e}`,l=()=>this.limits(e,i),c=w=>{let[S,M]=l();return o?
1e3*Math.log(w/S)/Math.log(M/S):w},h=w=>{if(!o)return w;let[S,M]=l(),k=S*(M/S)**(w/1e3),E=k<100?1:10**(Math.floor(Math.log10(k))-1);return le(Math.round(k/E)*E,
S,M)},d=()=>{let w=this.session.document?.[e];return w===void 0?l()[0]:i===1?w:Number((w*i).toFixed(3))},u=v("label",{for:a}),m=v("input",{type:"range",id:a,...o?
{min:0,max:1e3,step:1}:{step:s}}),b=v("input",{type:"number",step:String(s)});return o||this.bounded(m,e,i),this.bounded(b,e,i),m.addEventListener("input",()=>this.
set({[e]:h(Number(m.value))/i})),m.addEventListener("change",()=>this.endDrag()),b.addEventListener("change",()=>{this.typed(b,n(),l(),d,w=>this.set({[e]:o?Math.
round(w):w/i})),this.endDrag()}),this.each(()=>{let w=d();C(u,"textContent",n()),et(b,"aria-label",`${n()}, number`),h(Number(m.value))!==w&&(m.value=String(c(w))),
et(m,"aria-valuetext",`${w}${r}`);let S=100*(c(w)-Number(m.min))/(Number(m.max)-Number(m.min));m.style.setProperty("--fill",`${le(S,0,100)}%`),Sn(b)||C(b,"value",
String(w))}),v("div",{className:"row slider"},u,m,b)}select(e,n,s,o,r,i=""){let a=v("select",{onchange:()=>o(a.value)});for(let[l,c]of Object.entries(n))a.append(
v("option",{value:l,textContent:c}));return this.each(()=>{C(a,"value",s()),r&&C(a,"disabled",!r()),i&&C(a,"title",a.disabled?i:"")}),this.row(e,a)}typed(e,n,[s,
o],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(le(a,s,o)),e.value=String(r()),a<s?this.session.say(`${n} is at least ${s}`,"warning"):a>o&&
this.session.say(`${n} is at most ${o}`,"warning")}numberInput(e,n,s,{step:o,limits:r,scale:i}){let a=v("input",{type:"number",step:String(o)}),l=()=>r?this.limits(
r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,l(),n,s)),this.each(()=>{Sn(a)||C(a,"value",String(n()))}),this.row(
e,a)}checkbox(e,n,s,o=""){let r=v("input",{type:"checkbox",onchange:()=>s(r.checked)});return this.each(()=>C(r,"checked",n())),v("label",{className:"check",title:o},
r,v("span",{textContent:e}))}dialog(e,...n){let s=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,o=v("button",{type:"button",className:"plain","aria-label":"Clo\
se",onclick:()=>i.close()},hn("close")),r=v("div",{className:"title"},v("h2",{id:s,textContent:e}),o),i=v("dialog",{"aria-labelledby":s},r,...n);return i.addEventListener(
"click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),i}};var sg=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Eh="There are no draws yet: chains keep them",og={2:"2 / s",10:"10 / s",30:"\
30 / s",1e3:"fastest"},qo=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.
session.hasDraws)return;this.before=null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.
act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,draws:s,flicker:o,shown:r}=this.session;this.playing=e&&!o.still,e&&o.wantsMean?this.session.act(
{type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.showDraw(o.still&&r?.layer==="draw"?(n+1)%s.count:n>=s.count-1?0:n),this.session.changed()}over(e){
let{flicker:n,view:s}=this.session;n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:s.chain})):s.layer!=="draw"&&this.showLayer(
"draw"):(this.afterMean=!1,this.before&&this.before!==s.layer&&this.showLayer(this.before)),this.before=e?s.layer:null,this.session.changed()}playFromStart(){this.
showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)
return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:s,draws:o}=this.session;
s+1>=o.count&&n.on?this.showDraw(0):s+1>=o.count?this.play(!1):this.showDraw(s+1)},1e3/this.drawsPerSecond)}};function Ph(t,e,n,s){let{session:o}=t,r=t.segmented(
"Show",sg,()=>o.view.layer,m=>e.showLayer(m),m=>m==="draw"?o.hasDraws:!o.lacks.includes(m)),[,,i,a]=Array.from(r.children);C(a,"title","Width of each cell's 90 \
% interval"),t.visible(i,()=>!o.quantity.interval),t.visible(a,()=>o.quantity.interval);let l=(m,b)=>t.checkbox(m,()=>n[b],w=>{n[b]=w,o.changed()}),c=l("True wa\
lls","truth");t.visible(c,()=>!o.document||o.document.source.kind==="simulation");let[h,d]=[l("Surfaces","strokes"),l("Trajectory","trajectory")];t.visible(h,()=>!!o.
overlay?.strokes.length),t.each(()=>C(h.lastElementChild,"textContent",Fs(s())?"Surfaces":"Surfaces (zoom in)")),t.visible(d,()=>!!o.overlay?.trajectory.length);
let u=v("div",{className:"checks",role:"group","aria-label":"Marks"},c,l("Rays","rays"),l("Readings","readings"),h,d);return t.section("View",r,rg(t,e),u)}function rg(t,e){
let{session:n}=t,s=v("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});s.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(s.value))});let o=t.
button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1,why:Eh}),r=v("output"),i=v("select",{"aria-label":"Chain"});i.addEventListener("\
change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:d,count:u}=n.draws;C(s,"max",String(Math.max(0,u-1))),C(s,"disabled",u===0),C(s,"value",String(
n.draw));let m=u?`${n.draw+1} of ${u}`:"none kept";et(s,"aria-valuetext",m),s.style.setProperty("--fill",`${u>1?100*n.draw/(u-1):0}%`),C(r,"textContent",m),i.length!==
Math.max(1,d)&&i.replaceChildren(...Array.from({length:Math.max(1,d)},(w,S)=>v("option",{value:String(S),textContent:`chain ${S+1}`}))),C(i,"value",String(n.view.
chain)),C(i,"disabled",d<2),u<2&&e.playing&&e.play(!1);let b=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";o.getAttribute("aria-label")!==
b&&(o.setAttribute("aria-label",b),o.replaceChildren(hn(e.playing?"pause":"play")))});let a=v("select",{"aria-label":"Speed"});for(let[d,u]of Object.entries(og))
a.append(v("option",{value:d,textContent:u}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(
null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1,why:Eh});t.each(()=>C(a,"disabled",n.draws.count<2||n.flicker.
still));let c=t.checkbox("Draws over the mean",()=>n.flicker.on,d=>e.over(d),"Each draw in its own colour over the mean, as one of the maps that the scans leave\
 possible");t.visible(c,()=>n.draws.count>1);let h=v("div",{className:"wide"},c);return v("div",{className:"player"},o,s,r,v("div",{className:"buttons wide"},i,
a,l),h)}function _h(t){let{session:e}=t,n=v("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),s=v("output");n.addEventListener("input",()=>e.act({
type:"scan",index:Number(n.value)}));let o=t.section("Scan",v("div",{className:"player bare"},n,s));return t.each(()=>{let r=e.document?.source.kind==="simulati\
on"?0:e.document?.source.scans??0;C(o,"hidden",r<2),C(n,"max",String(Math.max(0,r-1))),Sn(n)||C(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",
`${100*Number(n.value)/Math.max(1,r-1)}%`),C(s,"textContent",`${Number(n.value)+1} / ${r}`)}),o}var Lh=2,Ch=6,ig=.5,ag=.005;function Dh(t){let{session:e,hand:n}=t,s=v("p",{className:"whereabouts",role:"status"}),o=v("p",{className:"caption"}),r=t.section("\
Where am I?",s,o);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),C(s,"textContent",lg(t)),C(o,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function lg({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let s=e.p_lost>ig?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",o=!s&&e.p_lost>ag?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${s}${cg(e.modes)}${hg(e,t.editable)}${o}`}function cg(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>Lh,s=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${Ri(e.mean[2],0)}`,o=`known to ${$i(e.sigma_m)} and ${Ri(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${$i(e.sigma_m)} apart.`:`One place: ${s}, ${o}.`;let r=t.slice(0,Ch).map(({probability:a})=>Kr(a)),i=t.length>Ch?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${s}, ${o}.`}function hg({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>Lh)return"";let s=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),o=s.indexOf(Math.min(...s)),r=Math.abs(Math.atan2(Math.sin(t[o].mean[2]-e[2]),Math.cos(t[o].mean[2]-e[2]))),i=t.length===1?"there":o===0?"the l\
ikeliest":`the ${pg(o+1)}`;return` The robot ${n?"stands":"was recorded"} ${$i(s[o])} and ${Ri(r,1)} from ${i}.`}var pg=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,Ri=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,$i=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function Nh(t,e,n){let{shown:s,status:o}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:s&&{generation:s.generation,layer:t.layer,approximate:s.
approximate,sweeps:s.sweeps,method:s.method,quantity:t.quantity,rhat:s.rhat,verdict:s.verdict,trace:s.trace,traced:s.traced,weights:s.weights,ess:s.ess,chain:s.
chain,draw:s.draw},probability:s?.p??new Uint8Array(0),reached:s?.reached??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{text:o.
text,level:o.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:dg(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&ug(t.evidence.each)},over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.
strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??
0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var ug=t=>Object.fromEntries(Object.entries(t).
map(([e,n])=>[e,Array.from(n)]));function dg({ghost:t}){let{held:e,pose:n,fan:s,answers:o,trouble:r}=t;return{held:e,pose:n,answers:o,trouble:r,fan:s&&{...s,near:s.
near&&{...s.near}}}}var Fi=new Set(["walls","move_sensor","set","view","live"]),Rh=({type:t})=>!Fi.has(t),$h="Not while the connection is lost: this needs the server";function Fh(t,e){
let{document:n,walls:s}=t,o=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)s[r*o+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;
Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??
null};else if(e.type==="move_sensor"){let r=n.sensors.find(i=>i.id===e.id);if(r)for(let i of["x","y","yaw"])r[i]=e[i]??r[i]}}var fg=t=>Zt(`${t.replace(/^(plan|path|explore): /,"")}.`),Ko=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;pathShown=!0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}showPath(e){this.pathShown!==e&&this.version++,this.pathShown=e}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.
views,this.askedViews]=[null,""]),this.version++,this.ask(),this.session.changed())}forget(){this.forgetPath(),this.views=null,this.askedViews=""}forgetPath(){this.
start=this.goal=this.path=null,this.askedPath=this.trouble="",this.version++,this.session.changed()}ask(){let{session:e,start:n,goal:s,radius:o,risk:r}=this,{shown:i}=e;
if(!i||i.generation!==e.generation||!e.answers)return;let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,s,o,r])}`;n&&s&&!i.approximate&&l!==this.
askedPath&&(this.askedPath=l,e.act({type:"path",start:[n.x,n.y],goal:[s.x,s.y],radius:o,risk:r})),this.looking&&(!i.approximate||e.document?.method==="propagate")&&
a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let s=e.type==="undecided"?fg(e.text):"",o=e.type==="undecided"?e.question:e.type;o===
"views"?(this.viewTrouble=s,this.views=null):this.trouble=s,e.type==="path"?this.path=e:e.type==="views"&&this.looking?this.views={pose:n.pose,nats:n.nats,spacing:e.
spacing}:o==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[s,o]=[0,1/0];for(let r=0;r<n.nats.length;r++){
let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<o&&([s,o]=[r,i])}return s}};var Jo=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=Vt(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:s}=e;
if(!this.held||!n||!s||s.generation!==e.generation||!e.answers)return;let{chain:o,draw:r}=s,i=s.layer==="draw"&&o!==null&&r!==null&&e.draws.count?{chain:o,draw:r}:
{},a=`${s.generation} ${e.sampling} ${s.approximate} ${n.x} ${n.y} ${JSON.stringify(i)}`;a!==this.asked&&(this.asked=a,e.act({type:"inspect",x:n.x,y:n.y,each:!0,
...i}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.each=n.nats?n:null,this.version++)}};var mg="(prefers-reduced-motion: reduce)",Xo=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(mg).matches}get under(){let{mean:e,
session:n}=this,{shown:s}=n;return this.on&&e&&s?.layer==="draw"&&e.generation===s.generation&&e.p.length===s.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var gg=2e3,yg=3e3,bg=2,Zo=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:s}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...s,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,s=e&&n.document&&vn(e,n.document.
grid);(!s||!Vt(s,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:s}=e;if(!this.held||
!e.answers||!n||n.generation!==e.generation)return;!this.pose&&s?.pose.length&&(this.pose={x:s.pose[0],y:s.pose[1],yaw:s.pose[2]});let{pose:o}=this;if(!o)return;
let r=performance.now();if(r-this.askedAt>gg&&(this.waiting=0),this.waiting>=bg)return;let i=JSON.stringify([o,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>yg;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...o,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:s,low:o,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:c}=n,{x:h,y:d,yaw:u,generation:m,draws:b,coarse:w,milliseconds:S}=e,M=e.near&&{...e.near,pose:a,ranges:l,hit:c};this.fan={x:h,y:d,yaw:u,generation:m,draws:b,
coarse:w,milliseconds:S,angles:s,low:o,median:r,high:i,near:M},this.answers++}else this.fan=null;this.version++,this.ask()}};var Qo=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let s=performance.now();for(let o of this.
waiting)o.seq<=n&&this.eventToPaint_ms.push(s-o.time);this.waiting=this.waiting.filter(o=>o.seq>n);for(let o of this.seqOfGeneration.keys())o<e&&this.seqOfGeneration.
delete(o)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var er=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var tr=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:s}=this,o=s.document&&s.document.source.
kind!=="simulation"&&!s.recorded,r=e&&o&&s.scan?wg(s.scan,e,n,s.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),s.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){e.type==="undecided"?this.trouble=e.text:e.beam===this.picked?.beam&&
e.scan===this.picked.scan&&(this.found=e),this.version++}};function wg({index:t,pose:e,angles:n,ranges:s,hit:o},r,i,a){if(t===null)return null;let l={x:e[0],y:e[1]},
[c,h]=[-1,1/0];for(let d=0;d<n.length;d++){let[u,m]=[Math.cos(e[2]+n[d]),Math.sin(e[2]+n[d])],[b,w]=[r.x-l.x,r.y-l.y],S=b*u+w*m,M=o[d]?s[d]:a,k=o[d]?Math.hypot(
b-M*u,w-M*m):1/0,E=S>0&&S<M?Math.abs(b*m-w*u):1/0,_=Math.min(k,i/2+2*E);_<h&&([c,h]=[d,_])}return h<i?{scan:t,beam:c,from:l,angle:e[2]+n[c]}:null}var nr=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble;let{pose:s,weight:o}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,
cloud:s,weight:o},this.version++}ask(){let{session:e}=this,{shown:n,scan:s}=e;if(!n||!e.locates||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;
let o=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:s?.index} ${o}`,i=performance.now();r===this.asked||this.waitingSince&&
i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var Ih=new Set(["inspect","path","views","where","ghost","beam"]),sr=class{constructor(e,n,s=null,o=null){this.transport=e;this.changed=n;this.adopt=s;this.notice=
o;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";limits=null;recorded=!1;figure=!1;lacks=[];generation=-1;acted=0;decisions=new Ko(
this);evidence=new Jo(this);where=new nr(this);ghost=new Zo(this);reading=new tr(this);flicker=new Xo(this);telling=new zo(this);status=new Uo;progress=new er;latency=new Qo;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,
text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get answers(){
return!this.recorded&&!this.figure}get locates(){return this.answers||this.figure}get running(){return this.connection.connected&&!!this.state?.running}get working(){
return this.connection.connected&&!!this.state?.working}get layer(){let e=this.shown?.layer;return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entrop\
y":"mean"}get stage(){return this.running&&this.shown?.method==="counts"?this.lastStage:null}get halfway(){return this.lastStage?.generation===this.shown?.generation}get draws(){
return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(
0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&
/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;
if(!this.connection.connected&&this.everConnected&&!Ih.has(e.type)&&Rh(e))return this.say($h,"warning");let s={...e,seq:++this.seq};Ih.has(e.type)||(this.acted=
this.seq),Fi.has(e.type)&&(this.pending.push(s),this.foresee(s)),n&&this.latency.sent(s.seq,n),this.connection.connected?this.transport.send(s):this.everConnected&&
Xr(this.portableDocument()),this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.
packed.version!==this.wallsVersion&&(this.packed={version:this.wallsVersion,text:xn(Jn(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){
let e=this.effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.
next=null,this.flicker.take(this.shown),!0)}painted(){this.counts.paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&
this.transport.send({type:"painted",generation:e}),this.reported=e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.
quantity??{kind:"binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){
let n=this.connection.connected;if(this.connection=e,e.connected){let s=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),
this.bring(s),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(
this.notice.text,this.notice.level),this.everConnected=!0}else this.everConnected&&(n&&this.say("Connection lost","error"),Xr(this.portableDocument()));this.changed()}receive(e,n){
switch(e.type){case"welcome":this.generation=this.reported=-1,this.limits=e.limits,this.recorded=e.recorded,this.figure=e.figure,this.lacks=e.lacks,this.telling.
story=e.story??null,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":e.generation>=this.generation&&this.receiveScan(
e,n);break;case"overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(e,n);break;case"\
cell":this.evidence.receive(e,n);break;case"path":case"views":this.decisions.receive(e,n);break;case"ghost":this.ghost.receive(e,n);break;case"beam":this.reading.
receive(e);break;case"undecided":e.question==="ghost"?this.ghost.receive(e,n):e.question==="beam"?this.reading.receive(e):this.decisions.receive(e,n);break;case"\
status":this.status.say(e.text,e.level,this.acted);break;case"error":this.receiveRefusal(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"\
download":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}${e.note&&`, ${e.note}`}`,"info",this.acted);break}this.changed()}receiveScan({ids:e,
index:n},{pose:s,angles:o,ranges:r,exact:i,hit:a}){this.scan?.index!==n&&this.reading.forget(),this.scan={ids:e,index:n,pose:s,angles:o,ranges:r,exact:i,hit:a}}receiveRefusal({
seq:e,text:n,remedy:s}){let o=e!==null&&e===this.broughtAt;o&&(this.broughtAt=null,this.act({type:"hello"}));let r=[n,s].filter(Boolean).join("; ");this.status.
say(o?`The map that was brought along cannot be shown: ${r}`:r,"error",this.acted),this.pending=this.pending.filter(i=>i.seq!==e),e!==null&&this.latency.refused(
e),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.overlay=null,dl()),this.generation=Math.
max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.
generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let s=n.p,{trace:o,traced:r,weights:i}=n,a=this.next??this.shown,l=n.reached,
c=a&&a.p.length===s.length&&a.reached.every((h,d)=>h===l[d])?a.reached:l;this.next={...e,p:s,trace:o,traced:r,weights:i,reached:c},this.progress.hear(this.next)}rebuild(){
if(!this.state)return;let{document:e}=this.state,[n,s]=e.grid.shape,o=this.confirmedWalls;if((e.walls!==o.text||o.walls.length!==n*s)&&(this.confirmedWalls={text:e.
walls,walls:yt(it(e.walls),n*s)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==o||this.wallsAhead)&&(this.walls=this.confirmedWalls.
walls.slice(),this.wallsVersion++,this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r,chain:i??
0,draw:a}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Fh(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Oh='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Uh=`:host { display: block; height: 100dvh; container-type: size; }
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
.story { background: var(--tint); grid-template-columns: minmax(0, 1fr); }
.story .buttons { flex-wrap: wrap; }
.story nav { display: flex; gap: 4px; }
.story nav a { flex: 1 1 0; min-width: 0; max-width: 40px; padding: 3px 0; border-radius: 6px; border: 1px solid var(--control); background: var(--card); color:\
 inherit; text-align: center; text-decoration: none; }
.story nav a:hover { border-color: var(--accent); }
.story nav a[aria-current=step] { background: var(--accent); border-color: var(--accent); color: var(--on-accent); font-weight: 600; }
.story h3 { font-size: 15px; margin-bottom: 3px; }
.story .task { margin-top: 6px; padding-left: 9px; border-left: 3px solid var(--accent); font-weight: 600; }
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
@media (forced-colors: active) { .story [aria-current=step], .segmented label:has(:checked) { outline: 2px solid Highlight; } }
`;var Wh="bayesmap-theme",Bh={auto:"light",light:"dark",dark:"auto"},or=class{constructor(e,n){this.app=e;this.dressed=n;let s=kg();s&&s in Bh&&(this.choice=s),this.
media.addEventListener("change",this.listen)}theme=go.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?go.dark:go.light;this.app.dataset.theme=e?"dark":"light";let{truth:s,ray:o,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:c,ghost:h,belief:d}=n;for(let[u,m]of Object.entries({truth:s,ray:o,miss:r,sensor:i,hatch:a,unobserved:l,draw:c,ghost:h,belief:d}))this.
app.style.setProperty(`--${u}`,m);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Bh[this.choice];try{localStorage.setItem(Wh,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function kg(){try{return localStorage.getItem(Wh)}catch{return null}}var Gh=12;function Vs(t,e,{embedded:n=!1,adopt:s=null,notice:o=null,play:r}={}){let i=t.shadowRoot??t.attachShadow({mode:"open"}),a=new CSSStyleSheet;a.replaceSync(
Oh+Uh),i.adoptedStyleSheets=[a],t.toggleAttribute("data-embedded",n);let l=0,c=()=>{l||=requestAnimationFrame(pt)},h=new sr(e,c,s,o);e.open();let d=new es,u=new ro(
h),m=new oo(h,u),b=new qo(h),w=new Yo(h,u,m,_t,z=>b.showLayer(z),n),S=[new rs,new as,new hs,new cs,new xo,new yo,new ls,new ss,new ps,new is,new uo],M=S.map(({name:z})=>v(
"canvas",{className:z})),k=M[M.length-1];Object.assign(k,{tabIndex:0,role:"application"});let E=new co(S,M);new po(k,h,d,u,m,n);let _=new lo(k,h,d,u,m),N={truth:!0,
rays:!0,readings:!0,strokes:!0,trajectory:!0},L=sh(w),O=wl(w),G={chip:yh(w),banner:bh(w)},te=v("main",{className:"stage"},...M,G.chip,G.banner),J=()=>ce.theme,$=()=>d.
transform.scale,ee=lh(w,J,$),U=wh(w);k.setAttribute("aria-describedby",U.readout.id);let A=Qc(w),P={help:Xc(w),new:Zc(w),share:A.dialog},[B,I,re,K]=[Sh(w),Mh(w),
Th(w),Ah(w)],X=[kh(w),Jc(w),Dh(w),nh(w),eh(w),ph(w),uh(w,qc(w,J),Kc(w,J)),_h(w),vh(w),Ph(w,b,N,$),B,I,xh(w),re,K],Q=v("aside",{"aria-label":"Controls"},...X),Y=()=>h.
recorded||h.document?.source.kind==="run";w.visible(B,()=>h.editable),w.visible(I,()=>!Y()),w.visible(re,()=>!Y()),w.visible(K,()=>!Y());let W=u.tool;w.each(()=>{
W!==u.tool&&(Q.scrollTop=0),W=u.tool,C(O,"inert",!h.document),C(Q,"inert",!h.document)});let de=v("div",{className:"app"},L.element,O,te,ee,Q,U.element,...Object.
values(P));i.replaceChildren(de);let ce=new or(de,z=>{L.nameTheme(z),c()}),pe=()=>{let z=h.editable&&u.tool==="sensor"?u.sensor?.id??null:null;return{session:h,
view:d,look:{theme:ce.theme,...N,hover:u.hover,cursor:u.cursor,selected:z}}},{telling:se}=h,$e=()=>{se.step&&u.choose(se.step.tool)};se.onstep=z=>{$e(),n||history.
replaceState(null,"",location.pathname+location.search+Vo(z))};let ze=!1;function xe(){ze=!0;let z=n||s?null:Ni(location.hash);se.story&&z!==null?se.go(z):$e()}
let nt="";function pt(){l=0;let z=h.take();h.document&&!ze&&xe(),h.document&&String(h.shape)!==nt&&(nt=String(h.shape),d.fit(h.shape),u.cursor=u.hover=null,h.decisions.
forget(),h.evidence.forget(),h.ghost.refit(),k.setAttribute("aria-label",`Map, ${h.shape[0]} by ${h.shape[1]} cells`)),E.paint(pe()),z&&(h.painted(),b.step());let{
x:ae,y:Me}=d.transform;G.chip.style.transform=`translate(${Math.max(ae,Qe.left)}px, ${Math.max(Me-28,6)}px)`,et(k,"data-tool",h.editable||At.has(u.tool)?u.tool:
"pan"),w.refresh()}let Re=new ResizeObserver(()=>{let{width:z,height:ae}=te.getBoundingClientRect();!z||!ae||(d.resize(z,ae,devicePixelRatio||1),d.fitted&&d.fit(
h.shape),cancelAnimationFrame(l),pt())});Re.observe(te);function lt([z,ae]){let{scale:Me}=d.transform;Me<Gh&&d.zoom(Gh/Me,d.middle,h.shape);let ut=d.fromGrid({x:z+
.5,y:ae+.5},h.shape[1]);d.pan(d.middle.x-ut.x,d.middle.y-ut.y,h.shape),_.focus(),u.setCursor({x:z,y:ae})}async function _t(z){if(z==="in"||z==="out")d.zoom(z===
"in"?1.4:1/1.4,d.middle,h.shape);else if(z==="fit")d.fit(h.shape);else if(z.startsWith("cell "))lt(z.slice(5).split(",").map(Number));else if(z==="help")P.help.
showModal();else if(z==="new")P.new.showModal();else if(z==="theme")ce.next();else if(z==="add")_.addSensor();else if(z==="share"){let ae=h.portableDocument();ae&&
A.show(location.href.replace(/[?#].*/,"")+await $a(ae))}else if(z==="export png"){let ae=await cl(pe());ae&&Yr("bayesmap.png",ae),h.say("Saved bayesmap.png")}else
z.startsWith("export ")&&h.act({type:"export",what:z.slice(7)});c()}h.ondownload=(z,ae,Me)=>Yr(z,new Blob([Me],{type:ae}));let Ot=[[n?t:window,"keydown",z=>{z.defaultPrevented||
!h.document||Object.values(P).some(ae=>ae.open)||Ja(z,h,{tool:ae=>{u.choose(ae),_.focus()},layer:ae=>b.showLayer(ae),command:_t})}],[window,"online",()=>e.retry?.()],
[window,"hashchange",async()=>{if(n)return;let{document:z,damaged:ae}=await Ns(),Me=Ni(location.hash);z?h.bring(z):se.story&&Me!==null?se.go(Me):ae&&h.say(Ds,"e\
rror")}],[t,"dragover",z=>z.preventDefault()],[t,"drop",z=>{z.preventDefault();let ae=z.dataTransfer?.files[0];ae&&Ua(ae,h,r)}]];for(let[z,ae,Me]of Ot)z.addEventListener(
ae,Me);return ce.dress(),{destroy(){Re.disconnect(),cancelAnimationFrame(l),ce.destroy();for(let[z,ae,Me]of Ot)z.removeEventListener(ae,Me);e.close(),i.replaceChildren()},
snapshot:()=>Nh(h,d,E),cellToClient(z,ae){let Me=k.getBoundingClientRect(),ut=d.fromGrid({x:z+.5,y:ae+.5},h.shape[1]);return{x:Me.left+ut.x,y:Me.top+ut.y}}}}var Sg=200,Mg=.2,He=class extends Error{},Hh=({grid:t,walls:e})=>yt(it(e),t.shape[0]*t.shape[1]);function zh({grid:t},{x:e,y:n}){let[s,o]=[Math.floor((e-t.origin[0])/
t.resolution),Math.floor((n-t.origin[1])/t.resolution)];return s>=0&&s<t.shape[0]&&o>=0&&o<t.shape[1]?s*t.shape[1]+o:null}function Ii(t,e){let n=zh(t,e);if(n===
null)throw new He("the sensor cannot stand outside the map");if(Hh(t)[n])throw new He("the sensor cannot stand in a wall; move it to a free cell");return{...e,yaw:e.
yaw-2*Math.PI*Math.round(e.yaw/(2*Math.PI))}}function Vh(t,e,n){switch(e.type){case"set":return[Oi({...t,...e.patch},t,n),""];case"walls":return Tg(t,e.cells,e.
wall);case"clear":return e.what==="walls"?[{...t,walls:jh(t.grid.shape)},""]:null;case"add_sensor":{if(t.sensors.length>=n.sensors[1])throw new He(`there are ${t.
sensors.length} sensors already; remove one first`);let s=Math.max(...t.sensors.map(o=>o.id))+1;return[{...t,sensors:[...t.sensors,Ii(t,{id:s,x:e.x,y:e.y,yaw:e.
yaw??0})]},""]}case"move_sensor":{let s=o=>Ii(t,{id:o.id,x:e.x??o.x,y:e.y??o.y,yaw:e.yaw??o.yaw});return[{...t,sensors:t.sensors.map(o=>o.id===e.id?s(o):o)},""]}case"\
remove_sensor":{let s=t.sensors.filter(o=>o.id!==e.id);if(!s.length)throw new He("the last sensor cannot be removed; add another first");return[{...t,sensors:s},
""]}case"new":return[Ag(t,e.shape,e.world),""];default:return null}}var jh=([t,e])=>xn(new Uint8Array(t*e+7>>3));function Tg(t,e,n){let s=Hh(t),o=t.grid.shape[1];
for(let[i,a]of e)s[i*o+a]=n?1:0;let r="";for(let i of t.sensors){let a=zh(t,i);s[a]&&(r=`a sensor stands in cell (${Math.floor(a/o)}, ${a%o}): it stays free`),s[a]=
0}return[{...t,walls:xn(Jn(s))},r]}function Ag(t,e,n){if(n!=="blank")throw new He("this figure can begin blank maps alone; bayesmap app has others");let[s,o]=e.
map(i=>Math.floor((i-1)/2));return{...t,grid:{shape:e,resolution:1,origin:[-.5,-.5]},walls:jh(e),sensors:[{id:1,x:s,y:o,yaw:0}],noise:Mg,max_range:2*Math.max(...e)}}
function Oi(t,e,n){let s=t;for(let[h,d]of Object.entries(e)){let u=s[h];if(d!==null&&(typeof u!=typeof d||u===null))throw new He(`${h} is missing, or of another\
 type`);let m=n[h];if(m&&typeof u=="number"&&!(u>=m[0]&&u<=m[1]))throw new He(`${h}: ${u}; give ${m[0]} to ${m[1]}`)}let{grid:o,source:r,sensors:i,walls:a}=s;if(r.
kind!=="simulation")throw new He("this figure shows drawn maps alone; start bayesmap app with the file");if(s.cells!=="binary"||s.pose_sigma>0||s.heading_sigma>
0)throw new He("this figure samples walls seen from known poses alone; bayesmap app samples others");if(s.method==="propagate")throw new He("this figure has no \
belief propagation; choose another method");let[l,c]=n.side;if(!(o.shape.length===2&&o.shape.every(h=>Number.isInteger(h)&&h>=l&&h<=c)&&o.resolution>0))throw new He(
`grid: give ${l} to ${c} cells a side`);if(it(a).length!==o.shape[0]*o.shape[1]+7>>3)throw new He("walls: another number of cells than the grid's");if(!(i.length>=
n.sensors[0]&&i.length<=n.sensors[1]))throw new He(`sensors: give ${n.sensors[0]} to ${n.sensors[1]}`);return{...s,sensors:i.map(h=>Ii(s,h))}}function Eg(t){return t.
type==="walls"&&t.stroke?`walls ${t.stroke}`:t.type==="set"&&t.drag?`set ${t.drag} ${Object.keys(t.patch).sort()}`:t.type==="move_sensor"&&t.drag?`move ${t.drag}\
 ${t.id}`:null}var rr=class{constructor(e){this.present=e}past=[];future=[];gesture=null;get canUndo(){return this.past.length>0}get canRedo(){return this.future.
length>0}push(e,n){let s=Eg(n);(s===null||s!==this.gesture)&&(this.past.push(this.present),this.past.length>Sg&&this.past.shift()),this.future=[],this.gesture=s,
this.present=e}step(e){let[n,s]=e?[this.past,this.future]:[this.future,this.past],o=n.pop();return o?(s.push(this.present),this.present=o,this.gesture=null,!0):
!1}};var Pg=11102230246251565e-32,Yh=2**32,qh=1,Kh=2,Jh=3;function Ui(t,e,n){let{high:s,low:o}=t,r=o&65535,i=o>>>16,a=n&65535,l=n>>>16,c=r*a,h=i*a+(c>>>16),d=r*l+(h&
65535),u=i*l+(h>>>16)+(d>>>16);t.low=((d&65535)<<16|c&65535)>>>0,t.high=u+Math.imul(s,n)+Math.imul(o,e)>>>0}function Bi(t,e){let{high:n,low:s}=t;t.low=(s^(s>>>e|
n<<32-e))>>>0,t.high=(n^n>>>e)>>>0}function It(t,e,n){let s=e+1;n.high=Math.floor(s/Yh)>>>0,n.low=s>>>0,Ui(n,2654435769,2135587861);let o=n.low+t.low;n.high=n.high+
t.high+(o>=Yh?1:0)>>>0,n.low=o>>>0,Bi(n,30),Ui(n,3210233709,484763065),Bi(n,27),Ui(n,2496678331,321982955),Bi(n,31)}var Gi=({high:t,low:e})=>t*2097152+(e>>>11),
Cn=t=>(Gi(t)+.5)*Pg;function pn(...t){let e=s=>BigInt.asUintN(64,s),n=0n;for(let s of t){let o=e((n^BigInt(s))+0x9e3779b97f4a7c15n);o=e((o^o>>30n)*0xbf58476d1ce4e5b9n),
o=e((o^o>>27n)*0x94d049bb133111ebn),n=o^o>>31n}return{high:Number(n>>32n),low:Number(n&0xffffffffn)}}var Wi=2654435761,_g=2246822507;function ir(t,e){let n=Math.
imul(t+e,Wi);return n=Math.imul(n^n>>>15,_g),n^n>>>13}function Xh(t,e,n,s){let o=n>>>1,r=(1<<o)-1,i=(1<<n-o)-1,a=t;do{let l=a>>>o,c=a&r;l^=ir(c,s.low)&i,c^=ir(l,
s.high)&r,l^=ir(c,s.low^Wi)&i,c^=ir(l,s.high^Wi)&r,a=(l<<o|c)>>>0}while(a>=e);return a}var Zh=t=>Math.max(2,32-Math.clz32(t-1));function ar(t,e){let n={high:0,low:0};
It(t,e,n);let s=Cn(n);return It(t,e+1,n),Math.sqrt(-2*Math.log(s))*Math.cos(2*Math.PI*Cn(n))}var Cg=2**53,Qh=20,ep=1e15,[lr,Hi,tp]=[0,1,2],hr=class{constructor(e){this.p=e;let n=e*Cg,s=Math.round(n);this.level=s-n===.5&&s%2?s-1:s,this.logit=Math.min(Math.
max(Math.log(e)-Math.log1p(-e),-ep),ep)}level;logit;draws(e){return Gi(e)<this.level}logProb(e){if(this.p===0||this.p===1)return 0;let n=0;for(let s of e)n+=s;return e.
length*Math.log1p(-this.p)+n*this.logit}};function cr(t,e){return t>40?!0:t<-40?!1:e*(1+Math.exp(-t))<1}function zi({order:t,shuffle:e},n,s){if(!e)return i=>t[i];
let o=Zh(t.length),r={high:0,low:0};return It(n,-1-s,r),i=>t[Xh(i,t.length,o,r)]}var pr=class{constructor(e,n,s){this.problem=e;this.walls=n;this.key=s;let{offsets:o,
cells:r,noHit:i}=e.table;this.first=new Int32Array(i.length),this.current=new Float32Array(i.length),this.reached=new Int32Array(n.length),this.gain=new Float32Array(
n.length),this.known=new Uint8Array(n.length);for(let a=0;a<i.length;a++){let l=this.nextWall(o[a],o[a+1]);this.first[a]=l,this.current[a]=this.entryLoglik(a,l);
for(let c=o[a];c<Math.min(l+1,o[a+1]);c++)this.reached[r[c]]++}}first;current;reached;gain;known;bits={high:0,low:0};nextWall(e,n){let{cells:s}=this.problem.table,
o=e;for(;o<n&&!this.walls[s[o]];)o++;return o}entryLoglik(e,n){let{offsets:s,loglik:o,noHit:r}=this.problem.table;return n<s[e+1]?o[n]:r[e]}logLikelihood(){let e=0;
for(let n of this.current)e+=n;return e}moveFirst(e,n){let{offsets:s,cells:o}=this.problem.table,r=s[e+1],i=this.first[e];this.first[e]=n,this.current[e]=this.entryLoglik(
e,n);let a=Math.min(i,n);for(let c=s[e];c<Math.min(a+1,r);c++)this.known[o[c]]=lr;let l=n>i?1:-1;for(let c=a+1;c<Math.min(Math.max(i,n)+1,r);c++)this.known[o[c]]=
lr,this.reached[o[c]]+=l}put(e){let{offsets:n,beam:s,entry:o}=this.problem.index;this.walls[e]=1;for(let r=n[e];r<n[e+1];r++)this.first[s[r]]>o[r]&&this.moveFirst(
s[r],o[r])}remove(e){let{table:n,index:s}=this.problem;this.walls[e]=0;for(let o=s.offsets[e];o<s.offsets[e+1];o++){let r=s.beam[o],i=s.entry[o];this.first[r]===
i&&this.moveFirst(r,this.nextWall(i+1,n.offsets[r+1]))}}sweep(e,n){let{prior:s}=this.problem,o=e.order.length,r=zi(e,this.key,n);for(let i=0;i<o;i++){let a=r(i);
It(this.key,n*o+a,this.bits),this.reached[a]?this.walls[a]?this.stays(a,Cn(this.bits))||this.remove(a):this.becomes(a,Cn(this.bits))&&this.put(a):this.walls[a]=
s.draws(this.bits)?1:0}}becomes(e,n){let{logit:s}=this.problem.prior;return this.known[e]===lr&&this.sumGain(e,-Qh-s),cr(s+this.gain[e],n)?this.known[e]===tp?!0:
(this.sumGain(e,-1e300),cr(s+this.gain[e],n)):!1}sumGain(e,n){let{offsets:s,beam:o,entry:r,loglik:i,gainBound:a}=this.problem.index,l=0,c=tp;for(let h=s[e];h<s[e+
1];h++){let d=l+a[h];if(d<n){l=d,c=Hi;break}this.first[o[h]]>r[h]&&(l+=Math.fround(i[h]-this.current[o[h]]))}this.gain[e]=l,this.known[e]=c}stays(e,n){let{table:s,
index:o,prior:r}=this.problem;if(this.known[e]===lr){let l=0;for(let c=o.offsets[e];c<o.offsets[e+1];c++)this.first[o.beam[c]]===o.entry[c]&&(l+=o.advantage[c]);
this.gain[e]=l,this.known[e]=Hi}let i=r.logit+this.gain[e];if(this.known[e]===Hi&&i>Qh&&cr(i,n))return!0;let a=0;for(let l=o.offsets[e];l<o.offsets[e+1];l++){let c=o.
beam[l],h=o.entry[l];this.first[c]===h&&(a+=Math.fround(o.loglik[l]-this.entryLoglik(c,this.nextWall(h+1,s.offsets[c+1]))))}return cr(r.logit+a,n)}};var Lg=8,Dg=-1e300,Ng=2**53;function Vi(t,e,n,s){let o=Math.floor(t/s)-e,r=t%s-n;return o<0||o>1||r<0||r>1?-1:2*o+r}function np({table:t,shape:[e,n]}){let{offsets:s,
cells:o,noHit:r}=t,i=Math.max(1,e-1),a=Math.max(1,n-1),l=Array.from({length:i*a},()=>[]);for(let u=0;u<r.length;u++)for(let m=s[u];m<s[u+1];m++)for(let b=0;b<4;b++){
let w=Math.floor(o[m]/n)-(b>>1),S=o[m]%n-(b&1);if(w<0||w>=i||S<0||S>=a)continue;let M=l[w*a+S],k=M[M.length-1];k?.b===u&&k.last>=m-Lg?k.last=m:M.push({b:u,first:m,
last:m})}let c=new Int32Array(l.length+1);l.forEach((u,m)=>c[m+1]=c[m]+u.length);let h=l.flat(),d=u=>Int32Array.from(h,m=>m[u]);return{offsets:c,beam:d("b"),first:d(
"first"),last:d("last"),rows:a}}function sp(t,e,n,s){let{prior:o,shape:[r,i]}=t.problem,{rows:a}=e,l=n.order.length,c=zi(n,t.key,s),h=new Float64Array(16),d=new Float64Array(
16),u={high:0,low:0};for(let m=0;m<l;m++){let b=c(m),w=Math.floor(b/a),S=b%a,M=4*(s*l+b),k=N=>w+(N>>1)<r&&S+(N&1)<i?(w+(N>>1))*i+S+(N&1):-1,E=0;for(let N=0;N<4;N++)
k(N)>=0&&(E+=t.reached[k(N)]);if(!E){for(let N=0;N<4;N++)k(N)<0||(It(t.key,M+N,u),t.walls[k(N)]=o.draws(u)?1:0);continue}Rg(t,e,b,w,S,h),d.fill(0);for(let N=0;N<
4;N++){let L=k(N)<0||o.level===0,O=!L&&o.level===Ng;for(let G=0;G<16;G++)(G>>N&1)===(O?0:1)&&(d[G]+=L||O?Dg:o.logit)}for(let N=0;N<16;N++)h[N]+=d[N];It(t.key,M,
u);let _=$g(h,Cn(u));for(let N=0;N<4;N++){let L=k(N);L<0||(_>>N&1?t.walls[L]||t.put(L):t.walls[L]&&t.remove(L))}}}function Rg(t,e,n,s,o,r){let{table:i,shape:[,a]}=t.
problem,{offsets:l,cells:c,loglik:h}=i;r.fill(0);for(let d=e.offsets[n];d<e.offsets[n+1];d++){let u=e.beam[d],m=t.first[u],b=e.first[d];if(m<b)continue;let w=e.
last[d],S=l[u+1],M=m;if(m<=w&&m<S&&Vi(c[m],s,o,a)>=0)for(M=m+1;M<S&&!(t.walls[c[M]]&&Vi(c[M],s,o,a)<0);)M++;let k=t.entryLoglik(u,M),E=0;for(let _=b;_<Math.min(
w+1,M);_++){let N=Vi(c[_],s,o,a);if(N<0)continue;let L=Math.fround(h[_]-k);for(let O=0;O<16;O++)O>>N&1&&!(O&E)&&(r[O]+=L);E|=1<<N}}}function $g(t,e){let n=Math.
max(...t),s=t.map(r=>r>n-40?Math.exp(r-n):0),o=e*s.reduce((r,i)=>r+i,0);for(let r=0;r<16;r++)if(o-=s[r],o<=0&&s[r]>0)return r;return 15}function Ln(t){let e=0;for(let n=0;n<t.length;n++)e+=t[n];return e/t.length}var ji=t=>{let e=Ln(t);return t.reduce((n,s)=>n+(s-e)**2,0)/(t.length-1)},ur=(t,e)=>t.
reduceRight((n,s)=>n*e+s,0),op=[[3.3871328727963665,133.14166789178438,1971.5909503065513,13731.69376550946,45921.95393154987,67265.7709270087,33430.57558358813,
2509.0809287301227],[1,42.31333070160091,687.1870074920579,5394.196021424751,21213.794301586597,39307.89580009271,28729.085735721943,5226.495278852854]],rp=[[1.4234371107496835,
4.630337846156546,5.769497221460691,3.6478483247632045,1.2704582524523684,.2417807251774506,.022723844989269184,.0007745450142783414],[1,2.053191626637759,1.6763848301838038,
.6897673349851,.14810397642748008,.015198666563616457,.0005475938084995345,10507500716444169e-25]];function Fg(t){let e=t-.5;if(Math.abs(e)<=.425){let s=.180625-
e*e;return e*ur(op[0],s)/ur(op[1],s)}let n=Math.sqrt(-Math.log(e<0?t:1-t))-1.6;return Math.sign(e)*ur(rp[0],n)/ur(rp[1],n)}function Ig(t){let e=t[0].length>>1;return[
...t.map(n=>n.slice(0,e)),...t.map(n=>n.slice(n.length-e))]}function ip(t){let e=Float64Array.from(t.flat()).sort(),n=new Map;for(let s=0;s<e.length;){let o=s+1;
for(;o<e.length&&e[o]===e[s];)o++;n.set(e[s],Fg(((s+1+o)/2-.375)/(e.length+.25))),s=o}return t.map(s=>s.map(o=>n.get(o)))}function ap(t){let e=t[0].length;return Math.
sqrt((e-1)/e+ji(t.map(Ln))/Ln(t.map(ji)))}function lp(t,e){let n=t.length;for(let s=1,o=0;s<n;s++){let r=n>>1;for(;o&r;r>>=1)o^=r;o^=r,s<o&&([t[s],t[o],e[s],e[o]]=
[t[o],t[s],e[o],e[s]])}for(let s=2;s<=n;s*=2)for(let o=0;o<s/2;o++){let r=-2*Math.PI*o/s,[i,a]=[Math.cos(r),Math.sin(r)];for(let l=o;l<n;l+=s){let c=l+s/2,[h,d]=[
t[c]*i-e[c]*a,t[c]*a+e[c]*i];[t[c],e[c]]=[t[l]-h,e[l]-d],t[l]+=h,e[l]+=d}}}function Og(t){let e=t.length,n=Ln(t),s=2**Math.ceil(Math.log2(2*e)),[o,r]=[new Float64Array(
s),new Float64Array(s)];t.forEach((i,a)=>o[a]=i-n),lp(o,r);for(let i=0;i<s;i++)[o[i],r[i]]=[o[i]**2+r[i]**2,0];return lp(o,r),o.slice(0,e).map(i=>i/s/e)}function Ug(t){
let[e,n]=[t.length,t[0].length],s=t.map(Og),o=Ln(s.map(h=>h[0]))*n/(n-1),r=o*(n-1)/n+ji(t.map(Ln)),i=h=>h?1-(o-Ln(s.map(d=>d[h])))/r:1,a=Math.max(1,Math.ceil((n-
2)/2)),l=-1,c=1/0;for(let h=0;h<a;h++){let d=i(2*h),u=d+i(2*h+1);if(!(u>0)||h===a-1){l+=u>0?d:Math.max(d,0);break}c=Math.min(c,u),l+=2*c}return e*n/Math.max(l,1/
Math.log10(e*n))}function cp(t){if(t[0].length<4||t.every(c=>c.every(h=>h===t[0][0])))return null;let e=Ig(t),n=Float64Array.from(e.flat()).sort(),s=(n[n.length-
1>>1]+n[n.length>>1])/2,o=e.map(c=>c.map(h=>Math.abs(h-s))),r=ip(e),[i,a]=[ap(r),ap(ip(o))];return{rhat:Number.isNaN(a)?i:Number.isNaN(i)?a:Math.max(i,a),ess:Ug(
r)}}function hp({table:t,prior:e,shape:n},s,o,r){let{offsets:i,cells:a,loglik:l,noHit:c}=t,h=n[0]*n[1],d={high:0,low:0},u=new Int8Array(h);return Float64Array.from(
{length:r},(m,b)=>{u.fill(0);let w=0;for(let S=0;S<c.length;S++){let M=c[S];for(let k=i[S];k<i[S+1];k++){let E=a[k];if(u[E]||(It(s,(o+b)*h+E,d),u[E]=e.draws(d)?
1:-1),u[E]>0){M=l[k];break}}w+=M}return w})}function Yi({prior:t,shape:e},n,s){let o=e[0]*e[1],r={high:0,low:0};return Uint8Array.from({length:o},(i,a)=>(It(n,s*
o+a,r),t.draws(r)?1:0))}function pp(t){let e=t.reduce((r,i)=>Math.max(r,i),-1/0),n=e+Math.log(t.reduce((r,i)=>r+Math.exp(i-e),0)),s=t.map(r=>r-n),o=s.reduce((r,i)=>r+
Math.exp(2*i),0);return{logWeights:s,logEvidence:n-Math.log(t.length),effectiveSampleSize:1/o}}var qi=(t,e)=>e>0?Math.ceil(t-1e-9)-1:Math.floor(t+1e-9),Ki=t=>Math.abs(t)<1e-10?0:t>0?1:-1,dr=class{constructor({x:e,y:n,ux:s,uy:o},r,i,a){this.nx=r;this.ny=i;
this.stepX=Ki(s),this.stepY=Ki(o);let l=0,c=a;this.stepX?(this.gapX=1/Math.abs(s),l=Math.max(l,Math.min(-e/s,(r-e)/s)),c=Math.min(c,Math.max(-e/s,(r-e)/s))):(e<
-1e-9||e>r+1e-9)&&(c=-1),this.stepY?(this.gapY=1/Math.abs(o),l=Math.max(l,Math.min(-n/o,(i-n)/o)),c=Math.min(c,Math.max(-n/o,(i-n)/o))):(n<-1e-9||n>i+1e-9)&&(c=
-1),this.end=c+1e-9,this.x=qi(e+(this.stepX?l*s:0),this.stepX),this.y=qi(n+(this.stepY?l*o:0),this.stepY),this.stepX&&(this.nextX=(this.x+Math.max(this.stepX,0)-
e)/s),this.stepY&&(this.nextY=(this.y+Math.max(this.stepY,0)-n)/o),!this.stepX&&Math.abs(e-this.x)<=1e-9&&(this.alongLine=1,this.sideX=-1),!this.stepY&&Math.abs(
n-this.y)<=1e-9&&(this.alongLine=2,this.sideY=-1),this.cellX=this.x,this.cellY=this.y,this.sides=this.alongLine,this.distance=Math.max(0,Math.min(this.nextX,this.
nextY))}cellX;cellY;distance;end;x;y;sides;sideX=0;sideY=0;alongLine=0;stepX;stepY;nextX=1e300;nextY=1e300;gapX=1e300;gapY=1e300;get over(){return this.distance>
this.end}get inside(){return this.cellX>=0&&this.cellX<this.nx&&this.cellY>=0&&this.cellY<this.ny}next(){if(this.sides&1){this.cellX=this.x+this.sideX,this.cellY=
this.y,this.sides&=2;return}if(this.sides){this.cellX=this.x,this.cellY=this.y+this.sideY,this.sides=0;return}let e=this.nextX<this.nextY-1e-9,n=this.nextY<this.
nextX-1e-9;this.distance=e?this.nextX:n?this.nextY:Math.min(this.nextX,this.nextY),this.sides=this.alongLine,e===n&&(this.sideX=-this.stepX,this.sideY=-this.stepY,
this.sides=3),n||(this.nextX+=this.gapX,this.x+=this.stepX),e||(this.nextY+=this.gapY,this.y+=this.stepY),this.cellX=this.x,this.cellY=this.y}};function fr(t,[e,
n],s,o){for(let r=new dr(s,e,n,o);!r.over;r.next())if(r.inside&&t[r.cellX*n+r.cellY])return Math.min(r.distance,o);return o}function up([t,e],n,s){let o=[],r=new Int32Array(
n.length+1);return n.forEach((i,a)=>{for(let l=new dr(i,t,e,s);!l.over;l.next())l.inside&&o.push(l.cellX*e+l.cellY);r[a+1]=o.length}),{offsets:r,cells:Int32Array.
from(o)}}function dp({x:t,y:e,ux:n,uy:s},o,r){let i=Math.floor(o/r),a=o-i*r,l=0,c=1e300,h=!0,d=(u,m,b)=>{let w=Ki(m);if(!w)return;let S=1/m,M=b+(w>0?0:1)-u;l=Math.
max(l,M*S),c=Math.min(c,(M+w)*S),h&&=b===qi(u,w)};return d(t,n,i),d(e,s,a),h?Math.max(c,0):l}var Bg=Math.fround(.001),Wg=-.5*Math.log(2*Math.PI);function fp(t,e,n,s,o,r){let{offsets:i,cells:a}=t,l=s.sigma_m*s.sigma_m,c=.5*Math.log(l),h=(m,b)=>{let w=m-Math.
min(b,s.max_m);return Wg-.5*(w*w/l)-c},d=new Float32Array(a.length),u=new Float32Array(e.length);for(let m=0;m<e.length;m++){u[m]=h(n[m],1/0);for(let b=i[m];b<i[m+
1];b++)d[b]=h(n[m],dp(e[m],a[b],o)*r)}return{offsets:i,cells:a,loglik:d,noHit:u}}function mp({offsets:t,cells:e,loglik:n,noHit:s},o){let r=Float32Array.from(s),
i=new Float32Array(e.length);for(let u=0;u<s.length;u++){let m=s[u];for(let b=t[u+1]-1;b>=t[u];b--)i[b]=n[b]-m,m=Math.max(m,n[b]),r[u]=Math.min(r[u],n[b])}let a=new Int32Array(
o+1);for(let u of e)a[u+1]++;for(let u=0;u<o;u++)a[u+1]+=a[u];let l=()=>new Float32Array(e.length),c=()=>new Int32Array(e.length),h={offsets:a,entry:c(),beam:c(),
loglik:l(),gainBound:l(),advantage:l()},d=a.slice();for(let u of[!0,!1])for(let m=0;m<s.length;m++)for(let b=t[m];b<t[m+1];b++){let w=Math.fround(n[b]-r[m]);if(w>
Bg!==u)continue;let S=d[e[b]]++;h.entry[S]=b,h.beam[S]=m,h.loglik[S]=n[b],h.gainBound[S]=w,h.advantage[S]=i[b]}for(let u=0;u<o;u++)for(let m=a[u+1]-2;m>=a[u];m--)
h.gainBound[m]+=h.gainBound[m+1];return h}function js({angles:t,fov:e}){let n=e*(180/Math.PI);if(n===360)return Float64Array.from({length:t},(o,r)=>r*2*Math.PI/t);let s=n/(t-t%2);return Float64Array.from(
{length:t},(o,r)=>(s*r-n/2)*(Math.PI/180))}function gp(t){let{origin:e,resolution:n}=t.grid,s=[...js(t)];return t.sensors.flatMap(({x:o,y:r,yaw:i})=>s.map(a=>({
x:(o-e[0])/n,y:(r-e[1])/n,ux:Math.cos(i+a),uy:Math.sin(i+a)})))}function yp({grid:t,walls:e,max_range:n},s){let o=yt(it(e),t.shape[0]*t.shape[1]),r=n/t.resolution;
return Float64Array.from(s,i=>Math.min(fr(o,t.shape,i,r)*t.resolution,n))}function bp({grid:t,noise:e,prior:n,max_range:s},o,r){let{shape:i,resolution:a}=t,l=up(
i,o,s/a),c=fp(l,o,r,{sigma_m:e,max_m:s},i[1],a);return{table:c,index:mp(c,i[0]*i[1]),prior:new hr(n),shape:i}}function wp({grid:t,sensors:e,order:n},s){let[o,r]=t.
shape,[i,a]=s?[Math.max(1,o-1),Math.max(1,r-1)]:[o,r],l=Int32Array.from({length:i*a},(u,m)=>m);if(n!=="radial")return{order:l,shuffle:n==="random"};let c=(u,m)=>Math.
min(Math.max(u,0),m-1),h=e.map(({x:u,y:m})=>[c(Math.floor((u-t.origin[0])/t.resolution),o),c(Math.floor((m-t.origin[1])/t.resolution),r)]),d=l.map(u=>Math.min(...h.
map(([m,b])=>Math.abs(Math.floor(u/a)-m)+Math.abs(u%a-b))));return{order:Int32Array.from([...l].sort((u,m)=>d[u]-d[m]||u-m)),shuffle:!1}}var Qt=2,xp=32,Gg=300,Hg=100,zg=64<<20,Vg=.1,jg=16,Yg=40,Ji=24,vp=[.1,.3,.5,.7,.9],Mp={chains:0,count:0},qg={gibbs:"Gibbs sampling, cell by cell",block:"Gibbs s\
ampling, 2 x 2 blocks",importance:"importance sampling",none:"none yet: this is the prior"},ks=()=>performance.now(),kp=t=>Uint8Array.from(t,e=>Math.round(255*e)),
Sp=t=>String(+t.toPrecision(4)),Ss=class{constructor(e,n){this.document=e;this.problem=n;this.cells=n.shape[0]*n.shape[1]}done=!1;seconds=0;method="none";cells;work(e){
let n=ks();do this.step();while(!this.done&&ks()-n<e);this.seconds+=(ks()-n)/1e3}step(){this.done=!0}get draws(){return Mp}beamsThrough(e){let{offsets:n}=this.problem.
index;return n[e+1]-n[e]}mean(){return new Float64Array(this.cells).fill(this.document.prior)}reached(){return new Uint8Array(this.cells)}get logJoint(){return[]}figures(e){
return{sweeps:0,total:0,ess:null,rhat:null,log_joint:null,verdict:null,burned:0}}draw(e){return null}weights(){return null}picture(e,n,s,o){let{document:r,method:i}=this,
a=e.layer==="draw"?this.draw(e):null,l=this.weights(),c=i==="gibbs"?`, ${r.order} order`:"",h={type:"field",generation:n,milliseconds:s,layer:a?"draw":"mean",method:i,
approximate:!1,...this.figures(o),draws:this.draws,quantity:{kind:"binary",mean:"P(wall)",value:"wall",interval:!1},chain:null,draw:null,averaged:null,lowest:l?.
lowest??null,seconds:i==="none"?null:this.seconds,about:[["Method",qg[i]+c],["Prior",`independent: p wall ${Sp(r.prior)}`],["Sensor",`gaussian: sigma ${Sp(r.noise)}\
 m`],["Poses","known"],["Computed","in this page"]],...a&&{chain:a.chain,draw:a.draw,log_joint:a.log_joint}},d=kp(a?a.map:this.mean());return[h,{p:d,reached:kp(
this.reached()),...this.trace(),...l&&{weights:l.weights}}]}trace(){let e=this.logJoint,n=e[0]?.length??0,s=Math.min(n,Gg),o=Array.from({length:s},(a,l)=>Math.round(
s>1?1+l*(n-1)/(s-1):1)),r=Array.from({length:Math.min(n,Hg)},(a,l)=>l+1),i=[...new Set([...r,...o])].sort((a,l)=>a-l);return{trace:Float32Array.from(e.flatMap(a=>i.
map(l=>a[l-1]))),traced:Float32Array.from(i)}}},Ys=class extends Ss{constructor(n,s,o,r){super(n,s);this.judging=o;let{seed:i,start:a,sweeps:l}=n;this.method=r?
"block":"gibbs",this.blocks=r?np(s):null,this.sites=wp(n,r),this.thin=Math.ceil(l*Qt*Math.ceil(this.cells/8)/zg),this.chains=Array.from({length:Qt},(c,h)=>{let u=a===
"empty"&&n.prior<1?new Uint8Array(this.cells):Yi(s,pn(i,h,Kh),0);return new pr(s,u,pn(i,h,qh))}),this.touched=new Uint8Array(this.cells);for(let c of s.table.cells)
this.touched[c]=1;this.present={sweep:0,sums:this.chains.map(()=>new Float64Array(this.cells)),reached:new Uint32Array(this.cells),looks:0},this.past=[this.copy()],
this.goOn(l)}chains;blocks;sites;lookAt=new Set;touched;joint=Array.from({length:Qt},()=>[]);likelihood=Array.from({length:Qt},()=>[]);kept=Array.from({length:Qt},
()=>[]);thin;total=0;sweep=0;present;past;diagnosis=null;diagnosed=0;diagnoseAt=0;goOn(n){let{lookAt:s,document:o}=this;this.total=Math.ceil((this.total+n)/this.
thin)*this.thin,s.add(Math.floor(o.burn_in*this.total));for(let r=1;r<=this.total;r*=2)s.add(r);for(let r=1;r<=xp;r++)s.add(Math.floor(this.total*r/xp));this.done=
!1,this.diagnoseAt=0}burn(n){let s=Math.floor(n/this.thin),o=this.kept.map(r=>{let i=new Float64Array(this.cells);for(let a of r.slice(0,s))yt(a,this.cells).forEach(
(l,c)=>i[c]+=l);return i.map(a=>a*n/Math.max(1,s))});this.past=[{...this.past[0],sweep:n,sums:o}]}copy(){let{sums:n,reached:s,looks:o}=this.present;return{sweep:this.
sweep,sums:n.map(r=>r.slice()),reached:s.slice(),looks:o}}step(){let{present:n,document:s}=this;this.chains.forEach((r,i)=>{this.blocks?sp(r,this.blocks,this.sites,
this.sweep):r.sweep(this.sites,this.sweep);let a=n.sums[i];for(let c=0;c<this.cells;c++)a[c]+=r.walls[c];let l=r.logLikelihood();this.likelihood[i].push(l),this.
joint[i].push(l+this.problem.prior.logProb(r.walls)),(this.sweep+1)%this.thin===0&&this.kept[i].push(Jn(r.walls))}),this.sweep++,this.done=this.sweep>=this.total;
let o=Math.floor(s.burn_in*this.total);if(this.done&&o>this.past[0].sweep&&this.past.every(({sweep:r})=>r!==o)&&this.burn(o),!!this.lookAt.has(this.sweep)){for(let r of this.
chains)for(let i=0;i<this.cells;i++)n.reached[i]+=r.reached[i]?1:0;for(n.looks+=Qt,this.sweep<=s.burn_in*this.total&&this.past.push(this.copy());this.past.length>
1&&this.past[1].sweep<=s.burn_in*this.sweep;)this.past.shift()}}get draws(){return this.kept[0].length?{chains:Qt,count:this.kept[0].length}:Mp}means(){let[n]=this.
past,s=Math.max(1,this.sweep-n.sweep);return this.present.sums.map((o,r)=>o.map((i,a)=>(i-n.sums[r][a])/s))}mean(){let[n,s]=this.means();return n.map((o,r)=>this.
touched[r]?(o+s[r])/2:this.document.prior)}reached(){let[n]=this.past,s=Math.max(1,this.present.looks-n.looks);return Float64Array.from(this.present.reached,(o,r)=>(o-
n.reached[r])/s)}get logJoint(){return this.joint}draw({chain:n,draw:s}){let o=Math.min(n,Qt-1),{count:r}=this.draws;if(!r)return{map:this.chains[o].walls,chain:o,
draw:0,log_joint:this.joint[o].at(-1)??0};let i=Math.min(s??r-1,r-1);return{map:yt(this.kept[o][i],this.cells),chain:o,draw:i,log_joint:this.joint[o][(i+1)*this.
thin-1]}}figures(n){let[{sweep:s}]=this.past,o=ks();(o>=this.diagnoseAt||this.done&&this.diagnosed<this.sweep)&&(this.diagnosis=cp(this.joint.map(c=>c.slice(s))),
this.diagnosed=this.sweep,this.diagnoseAt=this.done?1/0:ks()+(ks()-o)/Vg);let r=this.joint.reduce((c,h)=>c+h[h.length-1],0)/Qt,{ess:i=null,rhat:a=null}=this.diagnosis??
{},l=c=>c!==null&&Number.isFinite(c)?c:null;return{sweeps:this.sweep,total:this.total,ess:l(i),rhat:l(a),log_joint:r,verdict:this.verdict(n||this.done),burned:s}}verdict(n){
let{judging:s,sweep:o}=this,r=o<s.fewest_sweeps;if(r&&!n)return null;let i=(d,u,m=null)=>({level:d,why:u,cell:m}),a=this.difference();if(!r&&a.cells>s.chance_share*
a.among){let[d,u]=a.cell,m=`in ${a.cells} of ${a.among} observed cells, most in cell (${d}, ${u}), by ${a.by.toFixed(2)}`;return i("bad",`P(wall) differs by ove\
r ${s.bad_difference} between the chains ${m}`,a.cell)}if(o<s.fewest_diagnosed)return i("bad",`${o} ${o===1?"sweep is":"sweeps are"} too few to judge`);let{rhat:l=NaN,
ess:c=NaN}=this.diagnosis??{};if(l>s.rhat_limit)return i("bad",`R-hat is ${l.toFixed(2)}, over ${s.rhat_limit}`);let h=this.misfit();return h?i("bad",`the chain\
s agree, but on maps that the readings contradict: they differ by ${+h.toPrecision(3)} times the noise`):!Number.isFinite(l)||!Number.isFinite(c)?i("good","noth\
ing varies: the log joint is the same in all draws of all chains"):c<s.bad_ess?i("bad",`only ${c.toFixed(0)} effective draws`):l>s.good_rhat||c<s.good_ess?i("fa\
ir",`R-hat ${l.toFixed(3)} and ${c.toFixed(0)} effective draws; ${s.good_rhat} and ${s.good_ess} are good`):i("good",`R-hat ${l.toFixed(3)}, ${c.toFixed(0)} eff\
ective draws`)}misfit(){let n=this.problem.table.noHit.length,[{sweep:s}]=this.past,o=-n*Math.log(this.document.noise*Math.sqrt(2*Math.PI)),r=this.likelihood.map(
l=>l.slice(s).reduce((c,h)=>c+h,0)/(l.length-s)),i=2*(o-Math.min(...r)),a=2/(9*n);return i>n*(1-a+this.judging.misfit_sigmas*Math.sqrt(a))**3?Math.sqrt(i/n):null}difference(){
let[n,s]=this.means(),o=this.reached(),r={by:0,cell:[0,0],cells:0,among:0};for(let i=0;i<this.cells;i++){if(o[i]<.5)continue;let a=Math.abs(n[i]-s[i]);r.among++,
a>this.judging.bad_difference&&r.cells++,a>r.by&&([r.by,r.cell]=[a,[Math.floor(i/this.problem.shape[1]),i%this.problem.shape[1]]])}return r}},mr=class extends Ss{constructor(n,s,o){
super(n,s);this.judging=o;this.method="importance",this.key=pn(n.seed,0,Jh),this.sums=new Float64Array(this.cells),this.touched=new Uint8Array(this.cells);for(let r of s.
table.cells)this.touched[r]=1}key;logWeights=[];most=-1/0;sum=0;sums;touched;step(){let n=this.logWeights.length,s=Math.min(jg,this.document.sweeps-n);hp(this.problem,
this.key,n,s).forEach((o,r)=>{if(this.logWeights.push(o),o>this.most){let l=Math.exp(this.most-o);this.sum*=l;for(let c=0;c<this.cells;c++)this.sums[c]*=l;this.
most=o}if(o<this.most-Yg)return;let i=Math.exp(o-this.most),a=Yi(this.problem,this.key,n+r);this.sum+=i;for(let l=0;l<this.cells;l++)a[l]&&(this.sums[l]+=i)}),this.
done=this.logWeights.length>=this.document.sweeps}mean(){return this.sums.map((n,s)=>this.touched[s]?n/this.sum:this.document.prior)}reached(){let n=this.mean(),
{offsets:s,cells:o,noHit:r}=this.problem.table,i=new Float64Array(this.cells);for(let a of vp){let l=new Uint8Array(this.cells);for(let c=0;c<r.length;c++)for(let h=s[c];h<
s[c+1]&&(l[o[h]]=1,!(n[o[h]]>a));h++);for(let c=0;c<this.cells;c++)i[c]+=l[c]/vp.length}return i}figures(){let{effectiveSampleSize:n}=pp(Float64Array.from(this.
logWeights));return{sweeps:this.logWeights.length,total:this.document.sweeps,ess:n,rhat:null,log_joint:null,verdict:this.verdict(n),burned:0}}verdict(n){let{bad_ess:s,
good_ess:o}=this.judging,r=n.toFixed(1)==="1.0"?"one particle carries":`${n.toFixed(1)} particles carry`;return n<s?{level:"bad",why:`${r} all the weight`,cell:null}:
{level:n>=o?"good":"fair",why:`${n.toFixed(0)} effective particles`,cell:null}}weights(){let n=this.logWeights.map(r=>r-this.most),s=Math.min(-1,...n.filter(Number.
isFinite).reduce((r,i)=>[Math.min(r[0],i)],[0])),o=new Float32Array(Ji);for(let r of n)o[Math.min(Ji-1,Math.floor(Ji*(1-r/s)))]++;return{weights:o,lowest:s}}};var gr=.03,Kg=40,Dn=180,Tp=90,Xi=9,Jg=24,Ap=60,Zi=7,Ep=50,Xg=25,Zg=10,Pp=1e3,Qg=4e3,ey=21;function Dp(t,e,n){let{grid:s,noise:o,max_range:r,seed:i}=t,{shape:[a,
l],resolution:c,origin:h}=s,d=yt(it(t.walls),a*l),u=js(t),m=r/c,b=(A,P,B)=>c*fr(d,s.shape,{x:A,y:P,ux:Math.cos(B),uy:Math.sin(B)},m),w=(A,P)=>A>=0&&P>=0&&A<a&&P<
l&&!d[Math.floor(A)*l+Math.floor(P)],S=(1-gr)/(o*Math.sqrt(2*Math.PI)),M=([A,P,B])=>{if(!w(A,P))return-1/0;let I=0;for(let re=0;re<u.length;re++){let K=b(A,P,B+
u[re]),X=(e[re]-K)/o,Q=K>=r;n[re]?I+=Math.log((Q?0:S*Math.exp(-.5*X*X))+gr/r):I+=Math.log(Q?1-gr/2:gr/2)}return I},k=$(),E=_p(k.slice(0,Qg),A=>A,1.5,.2,Ap);if(E.
length===Ap)return ee(k.filter((A,P)=>P%Math.ceil(k.length/Pp)===0));let _=pn(i,0,ey),[N,L]=[0,-1/0],O=E.slice(0,Jg).map(A=>({mean:A,root:Qi(.4,.4,.04),poses:[],
logs:[],top:-1/0}));for(let A=0;A<=Zi;A++){for(let P of O){let B=A===Zi,I=B?1.4:1.2,re=Array.from({length:B?3*Ep:Ep},()=>ty(P.mean,P.root,I,_,N+=3)),K=re.map(({
pose:Y,log:W})=>M(Y)-W);P.top=Math.max(P.top,...re.map(({log:Y},W)=>K[W]+Y)),L=Math.max(L,P.top),Object.assign(P,{poses:re.map(({pose:Y})=>Y),logs:K});let[X,Q]=Lp(
P.poses,Cp(K,B?1:Zg));!B&&Q&&([P.mean,P.root]=[X,ny(Q)])}O=O.filter(P=>P.top>L-Xg*(Zi-A+1)),A>=2&&(O=_p(O.sort((P,B)=>B.top-P.top),({mean:P})=>P,1,.15))}let G=Math.
max(...O.flatMap(({logs:A})=>A)),te=O.map(({poses:A,logs:P})=>P.map(B=>Math.exp(B-G)/A.length)),J=te.flat().reduce((A,P)=>A+P,0);return U(O.map(({poses:A},P)=>({
poses:A,weights:te[P].map(B=>B/J)})),L/u.length);function $(){let A=new Float32Array(Dn),P=Array.from(u.keys()).filter((K,X)=>X%Math.ceil(u.length/Kg)===0),B=Math.
hypot(o,.3*c),I=[];for(let K=0;K<a*l;K++){if(d[K])continue;let[X,Q]=[Math.floor(K/l)+.5,K%l+.5];for(let Y=0;Y<Dn;Y++)A[Y]=b(X,Q,Y*2*Math.PI/Dn);for(let Y=0;Y<Tp;Y++){
let W=Y*2*Math.PI/Tp,de=0;for(let ce of P){let pe=Math.round((W+u[ce])*Dn/(2*Math.PI)),se=A[(pe%Dn+Dn)%Dn],$e=(e[ce]-se)/B;de+=n[ce]?Math.min($e*$e,Xi):se>=r?0:
Xi}I.push({pose:[X,Q,W],loss:de})}}I.sort((K,X)=>K.loss-X.loss);let re=I[0]?.loss??0;return I.filter(({loss:K})=>K<re+.25*Xi*P.length).map(({pose:K})=>K)}function ee(A){
let P=A.map(M);return U([{poses:A,weights:Cp(P,P.length/2)}],Math.max(...P)/u.length)}function U(A,P){let B=A.map(({poses:K,weights:X})=>{let Q=X.reduce((Re,lt)=>Re+
lt,0),[[Y,W,de],ce]=Lp(K,X.map(Re=>Re/Q)),pe=[c,c,1],se=(ce??Qi(0,0,0)).map((Re,lt)=>Re.map((_t,Yt)=>_t*pe[lt]*pe[Yt])),[[$e,ze],[,xe]]=se,nt=Math.sqrt(($e+xe)/
2+Math.hypot(($e-xe)/2,ze));return{mean:[h[0]+Y*c,h[1]+W*c,Math.atan2(Math.sin(de),Math.cos(de))],covariance:se,probability:Q,sigma_m:nt,sigma_rad:Math.sqrt(se[2][2])}}),
re=A.flatMap(({poses:K,weights:X})=>K.map((Q,Y)=>({pose:Q,weight:X[Y]}))).sort((K,X)=>K.weight-X.weight).slice(-Pp);return{modes:B.sort((K,X)=>X.probability-K.probability),
pose:Float32Array.from(re.flatMap(({pose:[K,X,Q]})=>[h[0]+K*c,h[1]+X*c,Q])),weight:Float32Array.from(re,({weight:K})=>K),nats_per_beam:P}}}function _p(t,e,n,s,o=1/0){
let r=[];for(let i of t){if(r.length>=o)break;let[a,l,c]=e(i),h=d=>{let[u,m,b]=e(d);return Math.hypot(a-u,l-m)<n&&Math.abs(Math.atan2(Math.sin(c-b),Math.cos(c-b)))<
s};r.some(h)||r.push(i)}return r}var Qi=(...t)=>t.map((e,n)=>t.map((s,o)=>n===o?e:0));function ty(t,e,n,s,o){let r=[0,1,2].map(l=>ar(s,2*(o+l))),i=t.map((l,c)=>l+
n*e[c].reduce((h,d,u)=>h+d*r[u],0)),a=-.5*(r[0]**2+r[1]**2+r[2]**2)-Math.log(n**3*e[0][0]*e[1][1]*e[2][2]);return{pose:i,log:a}}function Cp(t,e){let n=Math.max(
...t);if(n===-1/0)return t.map(()=>1/t.length);for(let s=1;;s/=2){let o=t.map(i=>Math.exp(s*(i-n))),r=o.reduce((i,a)=>i+a,0);if(s<1e-6||r**2>=e*o.reduce((i,a)=>i+
a*a,0))return o.map(i=>i/r)}}function Lp(t,e){let n=t[e.indexOf(Math.max(...e))],s=t.map(l=>l.map((c,h)=>h===2?Math.atan2(Math.sin(c-n[2]),Math.cos(c-n[2])):c-n[h])),
o=l=>s.reduce((c,h,d)=>c+e[d]*l(h),0),r=[0,1,2].map(l=>o(c=>c[l])),i=r.map((l,c)=>r.map((h,d)=>o(u=>(u[c]-l)*(u[d]-h))));return[n.map((l,c)=>l+r[c]),i.every((l,c)=>l[c]>=
0)&&Number.isFinite(i[0][0])?i:null]}function ny(t){let e=Qi(0,0,0);for(let n=0;n<3;n++)for(let s=0;s<=n;s++){let o=t[n][s];for(let r=0;r<s;r++)o-=e[n][r]*e[s][r];
e[n][s]=n===s?Math.sqrt(Math.max(o,1e-7)):o/e[s][s]}return e}var sy=12,oy=80,ry=11,iy=new Set(["path","views","ghost","beam"]),ea="This figure has no such tool: bayesmap app has it";async function Np(t){return JSON.parse(
new TextDecoder().decode(await Xn(it(t))))}function ay(t,e){let n=yp(t,e),{seed:s,noise:o,angles:r,sensors:i}=t,a=i.map(({id:c})=>pn(s,c,ry)),l=n.map((c,h)=>t.readings===
"exact"?c:c+o*ar(a[Math.floor(h/r)],2*(h%r)));return{exact:n,readings:l}}function ly({method:t,prior:e},{rare_walls:n}){return t!=="auto"?t:Math.min(e,1-e)<=n?"\
block":"gibbs"}function Rp(t,e=n=>setTimeout(n)){let{limits:n,judging:s}=t,o=new rr(t.document),[r,i]=[0,0],[a,l,c]=[!0,!1,!1],h={layer:"mean",chain:0,draw:null},
d="live",u=null,[m,b]=[!1,!1],[w,S]=[0,0],M=null,k=(A,P)=>U.onmessage({type:"status",text:A,level:P},{}),E=()=>U.onmessage({type:"state",document:o.present,generation:r,
seq:i,can_undo:o.canUndo,can_redo:o.canRedo,live:a,running:l,working:c,draws:!c&&u?.draws||{chains:0,count:0},scan:0,view:h},{}),_=(A=!1)=>{u&&(S=performance.now(),
U.onmessage(...u.picture(h,r,Math.round(S-w),A)))};function N(){if(m=!1,b||!c)return;let A=!u;u??=O(),d!=="clear"&&u.work(sy);let P=u.done||d==="clear";(A||P||performance.
now()-S>oy)&&_(),P?(l=c=!1,E()):L()}function L(){m||e(N),m=!0}function O(){let A=o.present,{sensors:P,max_range:B}=A,I=gp(A),{exact:re,readings:K}=ay(A,I),X=Float64Array.
from(P.flatMap(({x:ce,y:pe,yaw:se})=>[ce,pe,se])),Q=ce=>Float32Array.from(ce),Y={pose:X,angles:Q(js(A)),ranges:Q(K),exact:Q(re),hit:Uint8Array.from(re,ce=>ce<B?
1:0)};M=Y,U.onmessage({type:"scan",generation:r,ids:P.map(({id:ce})=>ce),index:null},Y);let W=bp(A,I,K),de=ly(A,t);return d==="clear"?new Ss(A,W):de==="importan\
ce"?new mr(A,W,s):new Ys(A,W,s,de==="block")}function G(A=a?"live":"clear"){r++,d=A,u=null,l=d==="run",c=!0,w=performance.now(),E(),L()}function te(){if(!c)return E();
if(!u)return G("clear");l=c=!1,_(!0),E()}function J(A){if(A)return o.push(Oi(A,t.document,n),{type:"hello"}),G();if(!r)return G();E(),_()}function $(A){let{sensors:P,
angles:B}=o.present,I=Math.max(0,P.findIndex(pe=>pe.id===A)),{x:re,y:K,yaw:X}=P[I],Q=[I*B,(I+1)*B];if(!M||b)return;let{modes:Y,pose:W,weight:de,nats_per_beam:ce}=Dp(
o.present,M.ranges.subarray(...Q),M.hit.subarray(...Q));U.onmessage({type:"where",picture:r,sensor:P[I].id,index:null,pose:[re,K,X],modes:Y,p_lost:0,nats_per_beam:ce,
trouble:""},{pose:W,weight:de})}function ee(A){switch(A.type){case"hello":return J(A.document);case"run":{d==="live"&&c&&(u??=O());let re=u instanceof Ys?u:null;
G("run"),re?.goOn(o.present.sweeps),u=re;return}case"cancel":return te();case"live":return a=A.on,l?E():a?G():te();case"view":return h={layer:A.layer,chain:A.chain??
h.chain,draw:A.draw??null},E(),_(!c);case"undo":case"redo":return o.step(A.type==="undo")?G():(k(`nothing to ${A.type}`,"info"),E());case"export":{if(A.what!=="\
document")throw new He(ea);let re=new TextEncoder().encode(`${JSON.stringify(o.present,null,1)}
`);return U.onmessage({type:"download",name:"document.json",mime:"application/json",note:""},{data:re})}case"clear":if(A.what==="inference")return G("clear")}let P=Vh(
o.present,A,n);if(!P)throw new He(ea);let[B,I]=P;o.push(B,A),I&&k(I,"warning"),G()}let U={...rn(),open:()=>{U.onmessage({type:"welcome",version:1,limits:n,recorded:!1,
figure:!0,lacks:[],story:t.story},{}),U.onmessage({type:"worker",state:"ready"},{}),U.onstatus({connected:!0})},send:A=>{if(A.type!=="painted"){if(A.type==="ins\
pect"){let P=u?.beamsThrough(A.x*o.present.grid.shape[1]+A.y);if(P===void 0)return;let B={beams_for:null,nats_for:null,beams_against:null,nats_against:null,draw:null,
chain:null,prior_nats:null,log_odds:null};return U.onmessage({type:"cell",x:A.x,y:A.y,each:!1,beams:P,...B},{})}if(A.type==="where")return e(()=>$(A.sensor));if(iy.
has(A.type))return k(ea,"warning");i=A.seq??i;try{ee(A)}catch(P){if(!(P instanceof He))throw P;if(A.type==="hello")return U.onmessage({type:"error",text:P.message,
remedy:"",seq:i},{});k(P.message,"warning"),E()}}},close:()=>{b=!0}};return U}var ta=250,cy=8e3;function $p(t){let e=null,n=ta,s=0,o=!1;function r(){clearTimeout(s);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),c=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{c=!0,n=ta,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...Zn(h))},l.onclose=()=>{if(o||e!==l)return;s=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),c||hy(t()).then(d=>d&&e===l&&i.onstatus({...h,refused:d})),n=Math.min(cy,2*n)}}let i={...rn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},read:(a,l)=>new Promise((c,h)=>{let d=new URL("open",t());d.search=t().search,d.searchParams.set("name",a.name);let u=new XMLHttpRequest;u.open("POST",d),u.
responseType="arraybuffer",u.upload.onprogress=({loaded:m,total:b})=>l(m/b),u.onload=()=>u.status===200?c(u.response):h(new Error(new TextDecoder().decode(u.response))),
u.onerror=()=>h(new Error("the connection is lost")),u.send(a)}),retry:()=>{n=ta,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{o=!0,clearTimeout(s),e?.close()}};
return i}async function hy(t){try{return(await fetch(t.pathname+t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Fp(t){let e=(s,o=[])=>n.onmessage(s,Ia(s,o)),n={...rn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:s=>t.send(s),close:()=>t.off("m\
sg:custom",e)};return n}var py="This is the map that was drawn here when the connection was lost; undo leads back",yr=t=>Object.assign(window,{bayesmap:t}),Lx={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let s=Vs(n,Fp(t),{embedded:!0});return yr(s),()=>s.destroy()}};function Ip(t,e){let n=Vs(t,Oa(e),{play:na(t,()=>n)});yr(n)}var na=(t,e)=>n=>{
e().destroy(),Ip(t,n)};async function uy(){let t=document.querySelector("[data-bayesmap]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("bod\
y { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("script[data-recording]");if(n){Ip(t,await so(n.textContent??""));return}let s=document.
querySelector("script[data-figure]");if(s){let[{document:h,damaged:d},u]=await Promise.all([Ns(),Np(s.textContent??"")]),m=d?{text:Ds,level:"error"}:null,b=Vs(t,
Rp(u),{adopt:h,notice:m,play:na(t,()=>b)});yr(b);return}yl(new URLSearchParams(location.search).get("token"));let{document:o,damaged:r}=await Ns(),i=o?null:fl(),
a=$p(()=>new URL(location.href));bl(h=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(h)}${location.hash}`),a.retry?.()});let c=Vs(
t,a,{adopt:o??i,notice:r?{text:Ds,level:"error"}:i?{text:py,level:"info"}:null,play:na(t,()=>c)});yr(c)}uy();export{Lx as default,Rp as localTransport,Vs as mount,Np as readFigure,so as readRecording,Oa as recordedTransport,$p as webSocketTransport,Fp as widgetTransport};
