// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function Oo(t,e){let n=new Uint8Array(e);for(let o=0;o<e;o++)n[o]=t[o>>3]>>7-(o&7)&1;return n}function Wi(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function Wn(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function Io(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Gi(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Uo=t=>Gi(t,new DecompressionStream("deflate-raw")),Hi=t=>Gi(t,new CompressionStream("deflate-r\
aw"));async function zi(t){let e=await Hi(new TextEncoder().encode(JSON.stringify(t)));return"#m="+Io(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function _h(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Uo(Wn(e[1]))))}var Wo="The link's map cannot be read: copy the link again, who\
le";async function Go(){let t=await _h(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var pr={uint8:Uint8Array,uint32:Uint32Array,float32:Float32Array,float64:Float64Array},Bi=8,Gn=()=>({onmessage:()=>{},onstatus:()=>{}});function Ho(t){let e=new DataView(
t).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),o={},s=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let l=a.reduce((h,d)=>h*
d,1)*pr[i].BYTES_PER_ELEMENT;o[r]=new pr[i](t.slice(s,s+l)),s+=Math.ceil(l/Bi)*Bi}return[n,o]}function Vi(t,e){let n={};return(t.buffers??[]).forEach(({name:o,dtype:s},r)=>{
let{buffer:i,byteOffset:a,byteLength:l}=e[r];n[o]=new pr[s](i.slice(a,a+l))}),n}async function zo(t){let e=await Uo(Wn(t));return Ho(e.buffer)}function ji([t,e]){let{document:n,ids:o,log_joint:s}=t,{chains:r,count:i,bits:a}=t.draws,l=n.grid.
shape[0]*n.grid.shape[1],h=n.source.kind!=="simulation",d=1,u={chains:r,count:i},f=0,y={layer:"mean",chain:0,draw:null},b=(R,_=R.length===0)=>{let G=R.length/o.
length;return h&&!_?R.slice(f*G,(f+1)*G):R},x=()=>o[f]-1,M=(R=0)=>{let _={generation:d,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1,scan:x()};E.onmessage(
{type:"state",document:n,seq:R,..._,draws:u,view:y},{})},T=()=>{let{pose:R,angles:_,ranges:G,exact:B,hit:Q}=e,V=_.length<G.length,N={pose:b(R),angles:b(_,V),ranges:b(
G),exact:b(B),hit:b(Q)};E.onmessage({type:"scan",generation:d,ids:h?[o[f]]:o,index:h?x():null},N)},S=R=>{let _=a?Math.ceil(l/8):l,G=e.draws.slice(R*_,(R+1)*_);return a?
Oo(G,l).map(B=>255*B):G},A=()=>{let{p:R,width:_,reached:G,trace:B,traced:Q,weights:V}=e,N=Math.min(i-1,y.draw??i-1),Y=y.layer==="draw"&&!i||y.layer==="width"&&!_?
"mean":y.layer,I=Y==="draw"?{chain:y.chain,draw:N,log_joint:s[y.chain][N]}:{},q=Y==="draw"?S(y.chain*i+N):Y==="width"?_:R;E.onmessage({...t.field,layer:Y,...I},
{p:q,reached:G,trace:B,traced:Q,...V&&{weights:V}})},E={...Gn(),open:()=>E.onstatus({connected:!0}),send:R=>{if(R.type==="hello"){let _=[...i?[]:["draw"],...e.width?
[]:["width"]];E.onmessage({type:"welcome",version:1,limits:null,recorded:!0,lacks:_},{}),M(R.seq),T(),e.trajectory&&E.onmessage({type:"overlay",generation:d},{strokes:e.
strokes,trajectory:e.trajectory}),A()}else if(R.type==="view")y={layer:R.layer,chain:R.chain??y.chain,draw:R.draw??null},M(R.seq),A();else if(R.type==="scan"){let _=o.
map(G=>Math.abs(G-1-R.index));f=_.indexOf(Math.min(..._)),M(R.seq),T()}else if(R.type==="inspect"){let{x:_,y:G}=R,B=e.beams[_*n.grid.shape[1]+G];E.onmessage({type:"\
cell",x:_,y:G,each:!1,beams:B,beams_for:null,nats_for:null,beams_against:null,nats_against:null},{})}},close:()=>{}};return E}async function Lh(t,e){let n=new TextDecoder,o=t.stream().getReader(),[s,r]=["",0];for(let i=await o.read();!i.done;i=await o.read())s+=n.decode(i.value,{stream:!0}),
e((r+=i.value.length)/t.size);return s}async function Ki(t,e,n){let{name:o}=t;if(!/\.(html|json)$/.test(o))return e.say(`${o} is not read in the page: start bay\
esmap app with it`,"warning");try{let s=await Lh(t,i=>e.say(`Reading ${o}: ${Math.round(100*i)} %`)),r=/data-recording>(.*?)<\/script>/s.exec(s)?.[1];r&&n?n(await zo(
r)):o.endsWith(".json")&&!e.recorded?e.bring(JSON.parse(s)):e.say(`${o} holds nothing that can be shown here`,"warning")}catch{e.say(`${o} cannot be read: expor\
t it again, whole`,"error")}}var oe=(t,e,n)=>Math.min(n,Math.max(e,t)),Wt=({x:t,y:e},[n,o])=>t>=0&&e>=0&&t<n&&e<o,Ce=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),ur=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function fn(t,e){let{x:n,y:o}=Ce(t,e);return{x:Math.floor(n),y:Math.floor(o)}}var Hn=(t,e)=>ur({x:t.x+.5,y:t.y+.5},e);
function qi(t,e){let n=[],o=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let s=0;s<=o;s++){let r=o?s/o:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function Yi(t,[e,n]){let o=new Path2D,s=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&s(r-1,i)!==s(r,i);l&&a<0&&(a=i),!l&&a>=0&&(o.moveTo(r,a),o.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&s(i,r-1)!==s(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(o.moveTo(a,r),o.lineTo(i,r),a=-1)}return o}var wo=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Ji(t,e,n){let o=Qi(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),s=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return Xi(t,(r,i,a)=>e[a]||o.includes(a)?-1/0:s(r,i))}function Zi(t,e){
let n=Nh(e,t.grid.shape),o=Qi(t);return Xi(t,(s,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let l of o)a=Math.min(a,Math.hypot(s-l.x,r-l.y));return a>0?a:-1/0})}
var Qi=({sensors:t,grid:e})=>t.map(n=>fn(n,e));function Xi(t,e){let[n,o]=t.grid.shape,s=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<o;a++){let l=e(i,a,i*o+a);
l>r&&([s,r]=[{x:i,y:a},l])}return s&&Hn(s,t.grid)}function Nh(t,[e,n]){let o=new Uint16Array(e*n),s=(r,i)=>r<0||i<0||r>=e||i>=n?0:o[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)o[r*n+i]=t[r*n+i]?0:1+Math.min(s(r-1,i-1),s(r-1,i),s(r-1,i+1),s(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(s(r+1,i+1),s(r+1,i),
s(r+1,i-1),s(r,i+1));o[r*n+i]=Math.min(o[r*n+i],a)}return o}var Bo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Wt(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,o,s){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(h=>fn(h,r.grid)):[],l=new Map;for(let h of e)!Wt(h,i)||this.isWall(h)===n||a.some(d=>d.x===
h.x&&d.y===h.y)||l.set(h.x*i[1]+h.y,[h.x,h.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:o},s)}moveSensor(e,n,o,s){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:o},s)}addSensor(e){let{session:n}=this,{document:o}=n;
if(!o)return;let s=e==="where there is room"?Zi(o,n.walls):"world"in e?e.world:Ji(o,n.walls,e.near),r=n.limits?.sensors[1]??1/0;s?o.sensors.length>=r?n.say(`The\
re can be ${r} sensors at most.`,"warning"):this.refuses(s)||(n.act({type:"add_sensor",x:s.x,y:s.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=
Math.max(0,...o.sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"\
remove_sensor",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let o=fn(e,n.document.grid),s=this.isWall(o);return!s&&Wt(o,n.shape)?(n.status.text.
startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(s?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Ct=new Set(["pan","path","look","where","ghost","evidence"]),Dh=120,Vo=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.ghost.hold(e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.
changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&Wt(e,this.session.shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=
n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.
busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.cursor&&this.announce(this.describe(e))},Dh))}};var Ye={left:36,right:12,top:34,bottom:26},Rh=60,$h=160,zn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,o){[
this.width,this.height,this.ratio]=[e,n,o]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let o={x:this.width-Ye.left-Ye.right,y:this.height-Ye.
top-Ye.bottom},s=Math.max(.05,Math.min(o.x/e,o.y/n));s*this.ratio>4&&(s=Math.floor(s*this.ratio)/this.ratio),this.transform.scale=s,this.corner={x:Ye.left+(o.x-
s*e)/2,y:Ye.top+(o.y-s*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,o){let{scale:s}=this.transform,{x:r,
y:i}=this.corner,a=oe(s*e,Math.min(this.width,this.height)/Math.max(...o)/3,$h),l=a/s;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(o)}pan(e,n,o){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(o)}toGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:(e.
x-s)/o,y:n-(e.y-r)/o}}fromGrid(e,n){let{scale:o,x:s,y:r}=this.transform;return{x:s+e.x*o,y:r+(n-e.y)*o}}settle([e,n]){let{scale:o}=this.transform,s=Rh;this.corner.
x=oe(this.corner.x,s-e*o,this.width-s),this.corner.y=oe(this.corner.y,s-n*o,this.height-s),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var jo=new Set(["path","look","evidence"]);function Ko(t,e,n,o){if(e.tool==="path")return t.decisions.point(o);if(e.tool==="evidence"&&t.document){let{x:d,y:u}=Ce(
o,t.document.grid);return t.evidence.pin({x:Math.floor(d),y:Math.floor(u)})}let s=t.decisions.nearest(o),{views:r}=t.decisions;if(s===null||!r)return;let[i,a,l]=r.
pose.subarray(3*s,3*s+3),h=`${r.nats[s].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${h}`)}var oa=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W, O, V","where am I, ghost, evidence of beams","asked"],["arrows",
"move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["Space","at the cu\
rsor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, Delete","add, remo\
ve a sensor","drawn"],["R, Escape","run, cancel","inferred"],["Escape","take a path off the map","asked"],["M, N, H","show the mean, a draw, the entropy or the \
width"],["Ctrl+Z, Ctrl+Y","undo, redo","asked"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],Fh={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[
0,-1]},ea=Math.PI/12,qo=class{constructor(e,n,o,s,r){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;e.addEventListener("keydown",i=>{delete e.
dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,s.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){let{
session:n,hand:o,editor:s}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=Fh[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?ea:-ea;o.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&
o.sensor&&s.moveSensor(o.sensor,{yaw:o.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key===
"Backspace")&&n.editable)s.removeSensor();else if(e.key==="Escape"&&o.cursor)o.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.
editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:o,view:s,hand:r}=this,[i,a]=o.shape;if(r.tool==="ghost"&&
o.ghost.pose&&o.document){let{resolution:l}=o.document.grid,{x:h,y:d}=o.ghost.pose;o.ghost.move({x:h+e*l,y:d+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&
r.sensor&&o.document&&o.editable){let{resolution:l}=o.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.
tool==="pan"&&o.editable)s.pan(-40*e,40*n,o.shape),o.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},h={x:oe(l.x+e,0,i-1),y:oe(l.y+n,0,a-1)};
r.setCursor(h);let d=s.fromGrid({x:h.x+.5,y:h.y+.5},a),u=(y,b,x)=>y-oe(y,b,x),f={x:u(d.x,Ye.left+10,s.width-20),y:u(d.y,20,s.height-Ye.bottom-10)};(f.x||f.y)&&s.
pan(-f.x,-f.y,o.shape)}}space(e){let{session:n,hand:o,editor:s}=this;if(jo.has(o.tool)&&n.document){o.cursor?Ko(n,o,s,Hn(o.cursor,n.document.grid)):this.arrow(0,
0);return}if(n.editable){if(o.tool==="sensor"||o.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===o.sensor?.id);o.select(r[(i+1)%Math.max(1,
r.length)]?.id??null),o.selected!==null&&o.announce(`Sensor ${o.selected}`)}else if(!Ct.has(o.tool)){o.cursor||this.arrow(0,0);let r=o.cursor,i=o.tool==="draw"&&
!s.isWall(r);s.setWalls([r],i,o.nextGesture(),e),o.announce(i?"wall":"free")}}}},fr={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",
v:"evidence"},ta={m:"mean",n:"draw",h:"entropy"},na={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function sa(t,e,n){let o=t.composedPath()[0],s=o instanceof
HTMLSelectElement||o instanceof HTMLInputElement&&/number|text/.test(o.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(s||r!=="z"&&r!=="y"||
e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}if(!(s||t.altKey)){if(fr[r]&&(e.editable||Ct.has(fr[r])&&!e.recorded))
n.tool(fr[r]);else if(ta[r])n.layer(r==="h"&&e.quantity.interval?"width":ta[r]);else if(na[t.key])n.command(na[t.key]);else if(r==="r"&&!e.recorded)e.act({type:"\
run"});else if(t.key==="Escape"&&e.decisions.start)e.decisions.forgetPath();else if(t.key==="Escape"&&(e.running||e.working))e.act({type:"cancel"});else return;
t.preventDefault()}}var Yo=class{paints={};sheets;constructor(e,n){this.sheets=e.map((o,s)=>({layer:o,canvas:n[s],context:n[s].getContext("2d"),before:[]}));for(let{name:o}of e)this.
paints[o]=0}paint(e){let{width:n,height:o,ratio:s,transform:r}=e.view;if(!n||!o)return;let i={width:Math.max(1,Math.ceil(n*s)),height:Math.max(1,Math.ceil(o*s))},
a=[e.look.theme,n,o,s,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:h,context:d,layer:u}=l,f=u.shows?.(e)??!0,y=[f,...f?[...a,...u.depends(e)]:[]];y.length===
l.before.length&&y.every((b,x)=>Object.is(b,l.before[x]))||(l.before=y,h.style.visibility=f?"":"hidden",f&&((h.width!==i.width||h.height!==i.height)&&(Object.assign(
h,i),h.style.width=`${i.width/s}px`,h.style.height=`${i.height/s}px`),d.setTransform(1,0,0,1,0,0),d.clearRect(0,0,h.width,h.height),d.setTransform(s,0,0,s,0,0),
d.save(),u.paint(d,e),d.restore(),this.paints[u.name]++))}}};function Ne(t,{session:e,view:n}){let[o,s]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,o*r,s*r),t.clip()}function mn(t,{halo:e},n,o){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=o,t.strokeStyle=n,t.stroke()}var Jo='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Bt(t,e,n,o,s,r,i=!1){t.font=Jo,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=s.halo,t.lineWidth=3,t.strokeText(e,n,o)),t.fillStyle=s.axis,t.fillText(e,n,o)}var Bn=class{constructor(e,n,o){this.context=e;this.theme=
n;this.width=o}taken=[];write(e,n,o,s){this.context.font=Jo;let r=this.context.measureText(e).width/2+2,i=Math.min(Math.max(n,r),this.width-r),l=[[i,o-s-9],[i,o+
s+9],[n+s+r+4,o],[n-s-r-4,o]].find(([h,d])=>!this.taken.some(([u,f,y,b])=>h+r>u&&h-r<y&&d+8>f&&d-8<b));return l?(this.taken.push([l[0]-r,l[1]-8,l[0]+r,l[1]+8]),
Bt(this.context,e,l[0],l[1],this.theme,"center",!0),!0):!1}};function mr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(o,s)=>s).map(o=>({id:o,x:e.pose[3*o],y:e.
pose[3*o+1],yaw:e.pose[3*o+2]})):[]}function Xt(t,e,n){let o=n.fromGrid(Ce(t,e),e.shape[1]),s=oe(n.transform.scale*.42,7,13),r=s*2.6,i={x:o.x+r*Math.cos(t.yaw),
y:o.y-r*Math.sin(t.yaw)};return{point:o,size:s,handle:i}}function ra(t,{session:e,view:n,look:o}){let s=e.document;if(!s)return;let{theme:r}=o,i=mr(e);t.lineJoin=
"round";for(let a of i){let l=Xt(a,s.grid,n),{point:h,size:d}=l;a.id===o.selected&&Oh(t,l,o);let[u,f]=[Math.cos(a.yaw),-Math.sin(a.yaw)],y=(b,x)=>[h.x+d*(b*u-x*
f),h.y+d*(b*f+x*u)];t.beginPath(),t.moveTo(...y(1.25,0)),t.lineTo(...y(-.9,.8)),t.lineTo(...y(-.45,0)),t.lineTo(...y(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Bt(t,String(a.id),h.x,h.y+d*2+4,r,"center",!0)}}function Oh(t,{point:e,size:n,handle:o},{
theme:s}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(o.x,o.y),t.moveTo(o.x+4.5,o.y),t.arc(o.x,o.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),mn(t,s,s.sensor,1.5),t.beginPath(),t.arc(o.x,o.y,4,0,2*Math.PI),t.fillStyle=s.halo,t.fill()}function ia(t,e,n,o,s){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&Xt({id:0,...t.pose},o,s);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function aa(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var la={touch:24,other:11},Ih=5,Uh=90,Zo=class{constructor(e,n,o,s,r,i){this.canvas=e;this.session=n;this.view=o;this.hand=s;this.editor=r;this.embedded=i;let a=(l,h)=>e.
addEventListener(l,h,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{s.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return ur(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:o}=this,
{document:s}=n;if(!s)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",o.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&o.tool==="ghost")return this.begin(ia(n.ghost,r,this.reach(e),s.grid,this.view)),this.dragGhost(e);if(e.button===0&&jo.has(o.tool))return this.
begin({kind:"pick",first:r});let i=o.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,s):null;if(i?.kind==="sensor")return o.select(i.id),this.begin(i);
if(e.button===1||Ct.has(o.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,s);if(a)this.begin(a),a.kind==="sensor"&&o.select(a.id);else if(o.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,s)}):o.sensor&&(o.selected=o.sensor.id,this.begin({kind:"sensor",id:o.sensor.id,drag:o.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let l=o.tool==="draw"!==(e.button===2||e.shiftKey),h=this.cellAt(r),d=l&&this.editor.isWall(h);this.begin({kind:"strok\
e",id:o.nextGesture(),wall:l,last:h,held:e,onWall:d}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),Uh)}}gripAt(e,n,o){let{hand:s,view:r}=this,
i=this.reach(n),a=f=>Math.hypot(e.x-f.x,e.y-f.y),l=s.tool==="sensor"&&s.sensor?Xt(s.sensor,o.grid,r):null;if(l&&s.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:s.sensor.id,drag:s.nextGesture()};if(n.button!==0||s.tool==="erase")return null;let h=o.sensors.map(f=>({id:f.id,...Xt(f,o.grid,r)}));h.sort((f,y)=>a(
f.point)-a(y.point));let d=h.find(({point:f,size:y})=>a(f)<Math.max(i,y));if(!d)return null;let u={x:d.point.x-e.x,y:d.point.y-e.y};return{kind:"sensor",id:d.id,
drag:s.nextGesture(),grip:u}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:o,view:s,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let h of l.
length?l:[e]){let d=this.cellAt(this.at(h));(d.x!==n.last.x||d.y!==n.last.y)&&(n.onWall=!1),a.push(...qi(n.last,d)),n.last=d}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=o.document?.sensors.find(h=>h.id===n.id);if(!a||!o.document)return;let l=this.metres(i,o.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>Ih&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")s.pan(i.x-n.last.x,i.y-n.last.y,o.shape),n.last=i,o.changed();else if(this.fingers.size===2){let{middle:a,spread:l}=this.spread();
s.pan(a.x-n.middle.x,a.y-n.middle.y,o.shape),s.zoom(l/n.spread,a,o.shape),Object.assign(n,{middle:a,spread:l}),o.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&Ko(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?la.touch:la.other}pointAtReading(e){let{document:n,reading:o,ghost:s}=this.
session;if(!n||s.held)return;let r=n.grid.resolution/this.view.transform.scale;o.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:o}=this;
if(n?.kind!=="ghost"||!o.document)return;this.hand.point(null);let s=this.at(e);aa(o.ghost,n,this.metres({x:s.x+n.grip.x,y:s.y+n.grip.y},o.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let o=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-o*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-o*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:o,gesture:s}=this;s?.kind==="stroke"&&(this.editor.setWalls(e,s.wall,s.id,n),o.status.level==="error"&&o.say("Ready"))}dragSensor(e){
let{gesture:n,session:o}=this,{document:s}=o;if(n?.kind!=="sensor"||!s)return;this.hand.point(null);let r=s.sensors.find(l=>l.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},s);r&&this.editor.moveSensor(r,a,n.drag,e)}};var Wh=5,Qo=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:o,look:s}){
let{theme:r}=s;e.beginPath(),e.rect(Ye.left,0,o.width,o.height-Ye.bottom),e.clip(),s.hover&&ca(e,s.hover,n.shape[1],o,r,r.axis,1.5),s.cursor&&ca(e,s.cursor,n.shape[1],
o,r,r.ray,2.5)}};function ca(t,e,n,o,s,r,i){let{scale:a}=o.transform,l=o.fromGrid({x:e.x,y:e.y+1},n),h=Math.max(a,Wh),[d,u]=[l.x-(h-a)/2,l.y-(h-a)/2];t.lineWidth=
i+2,t.strokeStyle=s.halo,t.strokeRect(d,u,h,h),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(d,u,h,h)}var Gh={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},Hh={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},ts={light:Gh,dark:Hh},ha="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function zh([t,e,n]){let o=(t+16)/116,s=[.95047,1,1.08883],[r,i,
a]=[o+e/500,o,o-n/200].map((l,h)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*s[h]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let h=oe(l,0,1);return Math.round(255*(h<=.0031308?12.92*h:1.055*h**(1/2.4)-.055))})}var Xo=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),es=(t,e,n)=>t.map((o,s)=>o+n*(e[s]-o)),gr=(t,e)=>zh(es(t.paper,t.ink,e));function Vn(t){let e=Math.min(15,Math.floor(
t*16));return es(Xo(ha,6*e),Xo(ha,6*e+6),t*16-e)}function da(t,e){let n=new Uint8ClampedArray(17408).fill(255),[o,s]=[Xo(t.unobserved),Xo(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?wo(r/255):r/255,a=e==="value"?gr(t,r/255):Vn(i),l=es(o,s,e==="value"?r/255:0);for(let h=0;h<=16;h++)n.set(es(l,a,h/16),4*(r+256*h))}
return new Uint32Array(n.buffer)}var yr=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;function v(t,e={},...n){let o=document.createElement(t);for(let[s,r]of Object.entries(e))s.startsWith("on")?o.addEventListener(s.slice(2),r):s.includes("-")||s===
"role"||s==="for"?o.setAttribute(s,r):o[s]=r;for(let s of n)s!==null&&o.append(s);return o}function C(t,e,n){t[e]!==n&&(t[e]=n)}function nt(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var gn=t=>t.getRootNode().activeElement===t,ue=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function wr(t,e){let n=URL.
createObjectURL(e);v("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var Bh=9,Vh=2.5,jn=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start||e.looking&&e.views))}paint(e,n){let{session:o}=n;if(!o.document)return;Ne(e,n);let s=new Bn(e,n.look.theme,n.view.width);o.decisions.looking&&
this.views(e,n,s),this.path(e,n,s)}views(e,{session:n,view:o,look:s},r){let{views:i}=n.decisions,a=n.document?.grid;if(!i?.nats.length||!a)return;let[l,h]=[Math.
min(...i.nats),Math.max(...i.nats)],d=oe(.38*i.spacing*o.transform.scale/a.resolution,Vh,Bh),u=i.nats.indexOf(h);for(let f=0;f<i.nats.length;f++){let y=o.fromGrid(
Ce({x:i.pose[3*f],y:i.pose[3*f+1]},a),a.shape[1]);e.beginPath(),e.arc(y.x,y.y,d,0,2*Math.PI),e.fillStyle=`rgb(${Vn(oe((i.nats[f]-l)/Math.max(h-l,1e-9),0,1)).map(
Math.round)})`,e.fill(),f===u&&(e.lineWidth=2.5,e.strokeStyle=s.theme.truth,e.stroke(),r.write(`${ue(h,1)} nats`,y.x,y.y,d))}}path(e,{session:n,view:o,look:s},r){
let{start:i,goal:a,path:l,radius:h}=n.decisions,d=n.document?.grid;if(!d||!i)return;let u=f=>o.fromGrid(Ce(f,d),d.shape[1]);if(l){e.beginPath();for(let[f,y]of l.
path){let b=u({x:f,y});e.lineTo(b.x,b.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=l.within_risk?s.theme.sensor:s.theme.truth,e.globalAlpha=.3,e.lineWidth=2*h*
o.transform.scale/d.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let f of a?[i,a]:[i]){let{x:y,y:b}=u(f);e.beginPath(),e.arc(y,b,5,0,2*Math.
PI),e.fillStyle=f===i?s.theme.sensor:s.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=s.theme.halo,e.stroke()}if(l){let f=l.path.length,[[y,b],[x,M]]=[l.path[f-
1>>1],l.path[f>>1]],T=u({x:(y+x)/2,y:(b+M)/2});r.write(`${ue(l.length_m,1)} m, free with probability ${ue(l.probability,3)}`,T.x,T.y,4)}else a&&n.decisions.trouble&&
r.write("no path",u(a).x,u(a).y,7)}};var jh=5,[Kh,pa]=[.8,5],qh=6,ns=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:o,view:s,look:r}=n,{cell:i,each:a}=o.evidence,l=o.document?.grid;if(!i||!l)return;
Ne(e,n);let h=(x,M)=>s.fromGrid(Ce({x,y:M},l),l.shape[1]),d=x=>[h(a.start[2*x],a.start[2*x+1]),h(a.end[2*x],a.end[2*x+1])],u=a?.nats.length??0;e.lineCap="round";
for(let x=u-1;x>=0;x--){let[M,T]=d(x),S=a.nats[x];e.beginPath(),e.moveTo(M.x,M.y),e.lineTo(T.x,T.y),e.globalAlpha=oe(.25+Math.abs(S)/2,0,.9),e.lineWidth=oe(pa*Math.
sqrt(Math.abs(S)/qh),Kh,pa),e.strokeStyle=S>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:f}=s.transform,y=s.fromGrid({x:i.x,y:i.y+1},l.shape[1]),
b=Math.max(1,4-f/2);e.beginPath(),e.rect(y.x-b,y.y-b,f+2*b,f+2*b),mn(e,r.theme,r.theme.belief,2);for(let x=Math.min(jh,u)-1;x>=0;x--){let[M,T]=d(x),S=.35+.1*x,A={
x:M.x+S*(T.x-M.x),y:M.y+S*(T.y-M.y)};Bt(e,br(a.nats[x]),A.x,A.y,r.theme,"center",!0)}}},br=t=>`${t<0?"−":"+"}${Math.abs(t).toFixed(1)}`;var Yh=10,Jh=7,Zh=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",os=()=>document.createElement("canvas").getContext("2d"),Kn=class{name="\
field";cells=os();mask=os();hatch=os();palettes=new Map;image=new ImageData(1,1);drawn={field:null,reached:null,palette:"",hatch:""};depends({session:e}){return[
e.flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:o,view:s,look:r}=n;if(!o.document)
return;let[i,a]=o.shape,{scale:l,x:h,y:d}=s.transform;Ne(e,n);let u=o.flicker.under??o.shown;if(!u||u.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
h,d,i*l,a*l);return}this.fill(u,i,a,r.theme,Zh(u,o.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,h,d,i*l,a*l),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/s.ratio,this.hatch.canvas.height/s.ratio),l>=Yh&&this.lines(e,n)}fill(e,n,o,s,r){let{cells:i,mask:a,drawn:l}=this,
h=`${s.ground} ${r}`;if(l.field===e&&l.palette===h)return;let d=this.palettes.get(h)??da(s,r);if(this.palettes.set(h,d),this.image.width!==n||this.image.height!==
o){this.image=new ImageData(n,o);for(let{canvas:f}of[i,a])Object.assign(f,{width:n,height:o});l.reached=null}let u=new Uint32Array(this.image.data.buffer);for(let f=0,
y=0;f<o;f++)for(let b=o-1-f;b<n*o;b+=o)u[y++]=d[e.p[b]+256*(e.reached[b]+8>>4)];if(i.putImageData(this.image,0,0),l.reached!==e.reached){for(let f=0,y=0;f<o;f++)
for(let b=o-1-f;b<n*o;b+=o)u[y++]=255-e.reached[b]<<24;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,reached:e.reached,palette:h})}fillHatch({
session:e,view:n,look:o}){let{hatch:s,mask:r,drawn:i}=this,{ratio:a,width:l,height:h}=n,{scale:d,x:u,y:f}=n.transform,[y,b]=e.shape,x=[o.theme.ground,d,u,f,l,h,
a].join(" ");if(i.hatch===x)return;i.hatch=x;let M=os(),T=M.canvas.width=M.canvas.height=Math.round(Jh*a);M.strokeStyle=o.theme.hatch,M.lineWidth=a,M.beginPath();
for(let A of[-T,0,T])M.moveTo(A-1,T+1),M.lineTo(A+T+1,-1);M.stroke(),Object.assign(s.canvas,{width:Math.ceil(l*a),height:Math.ceil(h*a)}),s.setTransform(a,0,0,a,
0,0),s.imageSmoothingEnabled=!1,s.drawImage(r.canvas,u,f,y*d,b*d),s.globalCompositeOperation="source-in",s.setTransform(1,0,0,1,0,0);let S=s.createPattern(M.canvas,
"repeat");S.setTransform(new DOMMatrix().translate(Math.round(u*a),Math.round(f*a))),s.fillStyle=S,s.fillRect(0,0,s.canvas.width,s.canvas.height)}lines(e,{session:n,
view:o,look:s}){let[r,i]=n.shape,{scale:a,x:l,y:h}=o.transform;e.beginPath();for(let d=1;d<r;d++)e.moveTo(l+d*a,h),e.lineTo(l+d*a,h+i*a);for(let d=1;d<i;d++)e.moveTo(
l,h+d*a),e.lineTo(l+r*a,h+d*a);e.strokeStyle=s.theme.lines,e.lineWidth=1,e.stroke()}};var Qh=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],qn=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:o}=n.session;if(!(!o.held||!o.pose||!n.session.document)){if(Ne(e,n),o.fan){let s=this.
fan(e,n,o.fan);o.fan.near&&this.near(e,n,o.fan,o.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(s)}this.robot(e,n,o.pose)}}ends({session:e,view:n},o,s,r){let{grid:i,
max_range:a}=e.document;return Array.from(s,(l,h)=>{let d=oe(r[h],0,a),u=o.yaw+l,f={x:o.x+d*Math.cos(u),y:o.y+d*Math.sin(u)};return n.fromGrid(Ce(f,i),i.shape[1])})}fan(e,n,o){
let{theme:s}=n.look,[r,i,a]=[o.low,o.median,o.high].map(b=>this.ends(n,o,o.angles,b)),{grid:l}=n.session.document,h=n.view.fromGrid(Ce(o,l),l.shape[1]),d=new Path2D;
d.moveTo(h.x,h.y);for(let{x:b,y:x}of r)d.lineTo(b,x);d.closePath(),e.fillStyle=s.ghost,e.globalAlpha=.1,e.fill(d);let u=new Path2D,f=new Path2D,y=oe(n.view.transform.
scale*.12,1.2,3);for(let b=0;b<r.length;b++)u.moveTo(r[b].x,r[b].y),u.lineTo(a[b].x,a[b].y),Number.isFinite(o.median[b])&&f.rect(i[b].x-y,i[b].y-y,2*y,2*y);return e.
strokeStyle=s.ghost,e.lineCap="round",e.lineWidth=oe(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(u),e.globalAlpha=1,f}near(e,n,o,{pose:s,ranges:r,
hit:i}){let{theme:a}=n.look,l=oe(n.view.transform.scale*.14,1.5,4),h=this.ends(n,{x:s[0],y:s[1],yaw:s[2]},o.angles,r),d=new Path2D;h.forEach(({x:u,y:f},y)=>{i[y]&&
(d.moveTo(u+l,f),d.arc(u,f,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(d)}robot(e,{session:n,view:o,look:s},r){let{grid:i}=n.document,{point:a,
size:l,handle:h}=Xt({id:0,...r},i,o),[d,u]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(h.x,h.y),mn(e,s.theme,s.theme.ghost,1.5),
e.beginPath();for(let[f,y]of Qh)e.lineTo(a.x+l*(f*d-y*u),a.y+l*(f*u+y*d));e.closePath(),e.lineJoin="round",mn(e,s.theme,s.theme.ghost,2),e.fillStyle=s.theme.halo,
e.fill(),e.beginPath(),e.arc(h.x,h.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var Yn=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:o,view:s,look:r}=n,i=o.flicker.under&&o.shown;if(!i)return;let[a,l]=o.shape,
{scale:h,x:d,y:u}=s.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Ne(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,d,u,a*h,l*h)}fill(e,n,o,s){let[r,i,a]=[1,3,5].map(h=>parseInt(s.slice(h,h+2),16));Object.assign(this.cells.canvas,{width:n,height:o});let l=new ImageData(
n,o);for(let h=0,d=0;h<o;h++)for(let u=o-1-h;u<n*o;u+=o,d+=4)l.data.set([r,i,a,Math.round(e.p[u]*e.reached[u]/255)],d);this.cells.putImageData(l,0,0),this.drawn=
{field:e,colour:s}}};var Xh=46,ed=22;function td(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function ua(t,{session:e,view:n,look:o}){if(!e.document)
return;let{theme:s}=o,{width:r,height:i}=n,{origin:a,resolution:l,shape:h}=e.document.grid,{scale:d,x:u,y:f}=n.transform,y=td(Xh/d*l),b=Math.min(f+h[1]*d,i-Ye.bottom)+
.5,x=Math.max(u,Ye.left)-.5;t.fillStyle=s.ground,u<x&&t.fillRect(0,0,x,i+1),f+h[1]*d>b&&t.fillRect(0,b,r+1,i+1-b);let M=Math.max(0,-Math.floor(Math.log10(y)+1e-9));
t.strokeStyle=s.frame,t.lineWidth=1,t.beginPath();let T=A=>Math.ceil(a[A]/y-1e-9)*y,S=A=>a[A]+h[A]*l+1e-9;for(let A=T(0);A<=S(0);A+=y){let E=u+(A-a[0])/l*d;E<x||
E>r-4||(t.moveTo(E,b),t.lineTo(E,b+4),Bt(t,A.toFixed(M),E,b+12,s,"center"))}for(let A=T(1);A<=S(1);A+=y){let E=f+(h[1]-(A-a[1])/l)*d;E>b||E<4||(t.moveTo(x,E),t.
lineTo(x-4,E),Bt(t,A.toFixed(M),x-7,E,s,"right"))}t.stroke(),Bt(t,"m",x-ed,b+12,s,"right")}var Jn=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let o=mr(e).flatMap(({id:i,x:a,y:l,yaw:h})=>[i,a,l,h]),{grid:s}=e.document??{},
r=fa(e)&&n.truth&&e.wallsVersion;return[s&&[...s.shape,...s.origin,s.resolution].join(),r,n.selected,...o]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:o,view:s,look:r}=n;if(!o.document)return;let[i,a]=o.shape,{scale:l,x:h,y:d}=s.transform;r.truth&&fa(o)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(h-.5,d-.5,i*l+1,a*l+1),ra(e,n),ua(e,n)}truth(e,n){let{session:o,view:s,look:r}=n,{scale:i,x:a,y:l}=s.transform;this.edgesOf!==o.wallsVersion&&
(this.edges=Yi(o.walls,o.shape),this.edgesOf=o.wallsVersion),e.save(),Ne(e,n),e.transform(i,0,0,-i,a,l+o.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=oe(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},fa=({document:t})=>t?.source.kind==="simulation";var nd=600,od=1500,sd=65536,xr=.3,Zn=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:o,view:s,look:r}=n,{scan:i,document:a}=o;
if(!i||!a)return;Ne(e,n);let{scale:l}=s.transform,h=1/a.grid.resolution,d=a.grid.shape[1],u=i.angles.length,f=i.pose.length/3,y=Math.ceil(u*f/od),[b,x,M]=[new Path2D,
new Path2D,new Path2D],T=u*f>nd,S=new Map,A=oe(l*.1,1.3,4),E=a.scans_used??1/0,R=(i.index??0)<E?1:xr;for(let _=0;_<f;_++){let[G,B,Q]=i.pose.subarray(3*_,3*_+3),
V=s.fromGrid(Ce({x:G,y:B},a.grid),d);for(let N=0;N<u;N++){let Y=i.ranges[_*u+N],I=i.hit[_*u+N]===1,q=(I?Y:a.max_range)*h*l,W=i.angles[N]+Q,Z={x:V.x+q*Math.cos(W),
y:V.y-q*Math.sin(W)},H=I?b:x;(_*u+N)%y===0&&(H.moveTo(V.x,V.y),H.lineTo(Z.x,Z.y)),I&&(T?S.set(Math.round(Z.x)*sd+Math.round(Z.y),Z):(M.moveTo(Z.x+A,Z.y),M.arc(Z.
x,Z.y,A,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=R*oe(28/Math.sqrt(u*f/y)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(b),e.strokeStyle=r.theme.
noReturn,e.stroke(x),e.globalAlpha=1),r.readings){e.globalAlpha=R,e.fillStyle=r.theme.ray,e.fill(M);let _=1.8*A;for(let{x:G,y:B}of S.values())e.fillRect(G-_/2,B-
_/2,_,_);e.globalAlpha=1}}};var rd=2.5,bo=t=>t>=rd,Qn=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:o,look:s}=n,{overlay:r,document:i}=o;!r||!i||(Ne(e,n),s.trajectory&&
this.trajectory(e,n,r.trajectory),s.strokes&&bo(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:o,look:s},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=s.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[h,d,u]of[[0,l,.6],
[Math.max(0,l-1),a,.6*xr]]){e.beginPath();for(let f=h;f<d;f++){let y=o.fromGrid(Ce({x:r[2*f],y:r[2*f+1]},i),i.shape[1]);e.lineTo(y.x,y.y)}e.globalAlpha=u,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:o,look:s},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,h,d,u]=r.subarray(a,a+4),[f,
y]=[o.fromGrid(Ce({x:l,y:h},i),i.shape[1]),o.fromGrid(Ce({x:d,y:u},i),i.shape[1])];e.moveTo(f.x,f.y),e.lineTo(y.x,y.y)}e.strokeStyle=s.theme.ray,e.lineCap="roun\
d",e.lineWidth=oe(o.transform.scale/5,.8,2.5),e.stroke()}}};var id=2.2,ss=7,[ad,ld]=[.03,.75],cd=2.4477,ma=9,Xn=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:o}=n,{found:s}=o.where,r=o.document?.grid;if(!s||!r)return;Ne(e,n),
this.cloud(e,n,r);let i=new Bn(e,n.look.theme,n.view.width);for(let a of s.modes)this.place(e,n,r,a,i)}cloud(e,{session:n,view:o,look:s},r){let{cloud:i,weight:a}=n.
where.found,l=a[a.length-1]||1;e.strokeStyle=e.fillStyle=s.theme.belief,e.lineWidth=1.2;for(let h=0;h<a.length;h++){if(a[h]<ad**2*l)continue;let[d,u,f]=i.subarray(
3*h,3*h+3),y=o.fromGrid(Ce({x:d,y:u},r),r.shape[1]);e.globalAlpha=ld*Math.sqrt(a[h]/l),e.beginPath(),e.arc(y.x,y.y,id,0,2*Math.PI),e.fill(),e.beginPath(),e.moveTo(
y.x,y.y),e.lineTo(y.x+ss*Math.cos(f),y.y-ss*Math.sin(f)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:o},s,r,i){let[a,l,h]=r.mean,d=n.fromGrid(Ce({x:a,y:l},s),
s.shape[1]),u=cd*n.transform.scale/s.resolution,[[f,y],[,b]]=r.covariance,[x,M]=[(f+b)/2,Math.hypot((f-b)/2,y)],[T,S]=[x+M,x-M].map(E=>Math.max(ma,u*Math.sqrt(Math.
max(E,0))));e.beginPath(),e.ellipse(d.x,d.y,T,S,-Math.atan2(2*y,f-b)/2,0,2*Math.PI);let A=ma+1;e.moveTo(d.x+A*Math.cos(h),d.y-A*Math.sin(h)),e.lineTo(d.x+(A+ss)*
Math.cos(h),d.y-(A+ss)*Math.sin(h)),e.strokeStyle=o.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=o.theme.belief,e.lineWidth=2,e.stroke(),i.write(vr(r.probability),
d.x,d.y,S)}},vr=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var ga=900,xo=2;function ya({session:t,look:e}){let[n,o]=t.shape,s=new zn;s.resize(ga,Math.round(oe(ga*o/n,300,1800)),xo),s.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:s.width*xo,height:s.height*xo});let i=r.getContext("2d");i.scale(xo,xo),i.fillStyle=e.theme.ground,i.fillRect(0,0,s.width,s.height);
let a=[new Kn,new Yn,new Qn,new Zn,new Jn,new jn,new Xn,new qn],l={session:t,view:s,look:{...e,hover:null,cursor:null,selected:null}};for(let h of a)(h.shows?.(
l)??!0)&&(i.save(),h.paint(i,l),i.restore());return new Promise(h=>r.toBlob(h))}var rs=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:o,ghost:s}}){return!!(!s.
held&&e.picked&&n&&o?.index===e.picked.scan)}paint(e,n){let{session:o,view:s,look:r}=n,{picked:i,found:a}=o.reading,{scan:l,document:h}=o;if(!i||!h||l?.index!==
i.scan)return;Ne(e,n);let{grid:d,max_range:u}=h,f=M=>{let T={x:i.from.x+M*Math.cos(i.angle),y:i.from.y+M*Math.sin(i.angle)};return s.fromGrid(Ce(T,d),d.shape[1])},
y=(M,T,S,A)=>{e.beginPath(),e.moveTo(M.x,M.y),e.lineTo(T.x,T.y),e.lineWidth=S,e.strokeStyle=A,e.stroke()},b=l.hit[i.beam]===1,x=f(b?l.ranges[i.beam]:u);if(y(f(0),
x,3,r.theme.halo),y(f(0),x,1.5,b?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let M=(T,S)=>oe(T??S,0,u);if(y(f(M(a.low,0)),f(M(a.high,u)),6,r.theme.ghost),
a.median!==null){let T=f(a.median),S={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};y({x:T.x-S.x,y:T.y-S.y},{x:T.x+S.x,y:T.y+S.y},2.5,r.theme.ghost)}}b&&(e.beginPath(),
e.arc(x.x,x.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};var wa="bayesmap-token",kr="bayesmap-kept",ba="bayesmap-tools";function xa(t){try{return localStorage.getItem(t)}catch{return null}}function is(t,e){try{e===null?
localStorage.removeItem(t):localStorage.setItem(t,e)}catch{}}function Sr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&is(kr,JSON.stringify(
t))}function va(){is(kr,null)}function ka(){let t=xa(kr);try{return t&&JSON.parse(t)}catch{return null}}var Sa=()=>xa(ba)!==null,Ma=t=>is(ba,t?"all":null);function Ta(t){
t&&is(wa,t)}function Pa(t){let e=n=>{n.key===wa&&n.newValue&&t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",
e)}var Mr=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["where","Where am I?","where"],["path","Path","path"],
["evidence","Evidence","evidence"],["look","Look next","look"],["ghost","Ghost","ghost"]],hd=5;function Ea(t){let{hand:e,session:n}=t,o=t.segmented("Tool",Mr,()=>n.
editable||!n.document||Ct.has(e.tool)?e.tool:"pan",i=>e.choose(i),i=>n.editable||Ct.has(i)&&!n.recorded||i==="pan");t.visible(o,()=>!n.recorded);let s=Sa(),r=t.
button(null,"More tools",()=>{Ma(s=!s),n.changed()},{text:"More"});return t.visible(r,()=>!n.recorded),t.each(()=>{let i=Mr.filter(([l])=>Ct.has(l)||!n.document||
n.editable).map(([l])=>l),a=new Set(s?i:i.slice(0,hd));Mr.forEach(([l],h)=>C(o.children[h],"hidden",!a.has(l)&&!(l===e.tool&&i.includes(l)))),C(r.lastElementChild,
"textContent",s?"Fewer":"More"),nt(r,"aria-label",s?"Fewer tools":"More tools"),C(r,"title",s?"Fewer tools":"More tools: paths, evidence, where to look next, th\
e ghost")}),v("div",{className:"bar"},o,r,v("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plu\
s","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var dd="uplot",pd="u-hz",ud="u-vt",fd="u-title",md="u-wrap",gd="u-under",yd="u-over",wd="u-axis",bn="u-off",bd="u-select",xd="u-cursor-x",vd="u-cursor-y",kd="u-\
cursor-pt",Sd="u-legend",Md="u-live",Td="u-inline",Pd="u-series",Ed="u-marker",Ca="u-label",Cd="u-value",ko="width",So="height";var Aa="bottom",eo="left",Tr="right",Hr="#000",_a=Hr+"0",Pr="mousemove",La="mousedown",Er="mouseup",Na="mouseenter",Da="mouseleave",Ra="dblclick",Ad="resize",_d="\
scroll",$a="change",ds="dppxchange",zr="--",ao=typeof window<"u",Nr=ao?document:null,no=ao?window:null,Ld=ao?navigator:null,pe,as;function Dr(){let t=devicePixelRatio;
pe!=t&&(pe=t,as&&$r($a,as,Dr),as=matchMedia(`(min-resolution: ${pe-.001}dppx) and (max-resolution: ${pe+.001}dppx)`),xn($a,as,Dr),no.dispatchEvent(new CustomEvent(
ds)))}function pt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function Rr(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Pe(t,e,n){
t.style[e]=n+"px"}function At(t,e,n,o){let s=Nr.createElement(t);return e!=null&&pt(s,e),n?.insertBefore(s,o),s}function xt(t,e){return At("div",t,e)}var Fa=new WeakMap;
function Gt(t,e,n,o,s){let r="translate("+e+"px,"+n+"px)",i=Fa.get(t);r!=i&&(t.style.transform=r,Fa.set(t,r),e<0||n<0||e>o||n>s?pt(t,bn):Rr(t,bn))}var Oa=new WeakMap;
function Ia(t,e,n){let o=e+n,s=Oa.get(t);o!=s&&(Oa.set(t,o),t.style.background=e,t.style.borderColor=n)}var Ua=new WeakMap;function Wa(t,e,n,o){let s=e+""+n,r=Ua.
get(t);s!=r&&(Ua.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=o?-e/2+"px":0,t.style.marginTop=o?-n/2+"px":0)}var Br={passive:!0},Nd={...Br,
capture:!0};function xn(t,e,n,o){e.addEventListener(t,n,o?Nd:Br)}function $r(t,e,n,o){e.removeEventListener(t,n,Br)}ao&&Dr();function _t(t,e,n,o){let s;n=n||0,o=
o||e.length-1;let r=o<=2147483647;for(;o-n>1;)s=r?n+o>>1:ut((n+o)/2),e[s]<t?n=s:o=s;return t-e[n]<=e[o]-t?n:o}function fl(t){return(n,o,s)=>{let r=-1,i=-1;for(let a=o;a<=
s;a++)if(t(n[a])){r=a;break}for(let a=s;a>=o;a--)if(t(n[a])){i=a;break}return[r,i]}}var ml=t=>t!=null,gl=t=>t!=null&&t>0,fs=fl(ml),Dd=fl(gl);function Rd(t,e,n,o=0,s=!1){
let r=s?Dd:fs,i=s?gl:ml;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(o==1)a=t[e],l=t[n];else if(o==-1)a=t[n],l=t[e];else for(let h=e;h<=n;h++){let d=t[h];i(d)&&(d<
a?a=d:d>l&&(l=d))}return[a??we,l??-we]}function ms(t,e,n,o){let s=za(t),r=za(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Vt:yl,a=s==1?ut:vt,l=r==1?vt:ut,
h=a(i(Oe(t))),d=l(i(Oe(e))),u=oo(n,h),f=oo(n,d);return n==10&&(h<0&&(u=be(u,-h)),d<0&&(f=be(f,-d))),o||n==2?(t=u*s,e=f*r):(t=vl(t,u),e=gs(e,f)),[t,e]}function Vr(t,e,n,o){
let s=ms(t,e,n,o);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var jr=.1,Ga={mode:3,pad:jr},To={pad:0,soft:null,mode:0},$d={min:To,max:To};function ps(t,e,n,o){return ys(
n)?Ha(t,e,n):(To.pad=n,To.soft=o?0:null,To.mode=o?3:0,Ha(t,e,$d))}function ce(t,e){return t??e}function Fd(t,e,n){for(e=ce(e,0),n=ce(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Ha(t,e,n){let o=n.min,s=n.max,r=ce(o.pad,0),i=ce(s.pad,0),a=ce(o.hard,-we),l=ce(s.hard,we),h=ce(o.soft,we),d=ce(s.soft,-we),
u=ce(o.mode,0),f=ce(s.mode,0),y=e-t,b=Vt(y),x=ot(Oe(t),Oe(e)),M=Vt(x),T=Oe(M-b);(y<1e-24||T>10)&&(y=0,(t==0||e==0)&&(y=1e-24,u==2&&h!=we&&(r=0),f==2&&d!=-we&&(i=
0)));let S=y||x||1e3,A=Vt(S),E=oo(10,ut(A)),R=S*(y==0?t==0?.1:1:r),_=be(vl(t-R,E/10),24),G=t>=h&&(u==1||u==3&&_<=h||u==2&&_>=h)?h:we,B=ot(a,_<G&&t>=G?G:Lt(G,_)),
Q=S*(y==0?e==0?.1:1:i),V=be(gs(e+Q,E/10),24),N=e<=d&&(f==1||f==3&&V>=d||f==2&&V<=d)?d:-we,Y=Lt(l,V>N&&e<=N?N:ot(N,V));return B==Y&&B==0&&(Y=100),[B,Y]}var Od=new Intl.
NumberFormat(ao?Ld.language:"en-US"),Kr=t=>Od.format(t),ft=Math,hs=ft.PI,Oe=ft.abs,ut=ft.floor,Fe=ft.round,vt=ft.ceil,Lt=ft.min,ot=ft.max,oo=ft.pow,za=ft.sign,Vt=ft.
log10,yl=ft.log2,Id=(t,e=1)=>ft.sinh(t)*e,Cr=(t,e=1)=>ft.asinh(t/e),we=1/0;function Ba(t){return(Vt((t^t>>31)-(t>>31))|0)+1}function Fr(t,e,n){return Lt(ot(t,e),
n)}function wl(t){return typeof t=="function"}function re(t){return wl(t)?t:()=>t}var Ud=()=>{},bl=t=>t,xl=(t,e)=>e,Wd=t=>null,Va=t=>!0,ja=(t,e)=>t==e,Gd=/\.\d*?(?=9{6,}|0{6,})/gm,
vn=t=>{if(Sl(t)||tn.has(t))return t;let e=`${t}`,n=e.match(Gd);if(n==null)return t;let o=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${vn(
s)}e${r}`}return be(t,o)};function yn(t,e){return vn(be(vn(t/e))*e)}function gs(t,e){return vn(vt(vn(t/e))*e)}function vl(t,e){return vn(ut(vn(t/e))*e)}function be(t,e=0){
if(Sl(t))return t;let n=10**e,o=t*n*(1+Number.EPSILON);return Fe(o)/n}var tn=new Map;function kl(t){return((""+t).split(".")[1]||"").length}function Eo(t,e,n,o){
let s=[],r=o.map(kl);for(let i=e;i<n;i++){let a=Oe(i),l=be(oo(t,i),a);for(let h=0;h<o.length;h++){let d=t==10?+`${o[h]}e${i}`:o[h]*l,u=(i>=0?0:a)+(i>=r[h]?0:r[h]),
f=t==10?d:be(d,u);s.push(f),tn.set(f,u)}}return s}var Po={},qr=[],so=[null,null],en=Array.isArray,Sl=Number.isInteger,Hd=t=>t===void 0;function Ka(t){return typeof t==
"string"}function ys(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function zd(t){return t!=null&&typeof t=="object"}var Bd=Object.getPrototypeOf(
Uint8Array),Ml="__proto__";function ro(t,e=ys){let n;if(en(t)){let o=t.find(s=>s!=null);if(en(o)||e(o)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=ro(t[s],
e)}else n=t.slice()}else if(t instanceof Bd)n=t.slice();else if(e(t)){n={};for(let o in t)o!=Ml&&(n[o]=ro(t[o],e))}else n=t;return n}function De(t){let e=arguments;
for(let n=1;n<e.length;n++){let o=e[n];for(let s in o)s!=Ml&&(ys(t[s])?De(t[s],ro(o[s])):t[s]=ro(o[s]))}return t}var Vd=0,jd=1,Kd=2;function qd(t,e,n){for(let o=0,
s,r=-1;o<e.length;o++){let i=e[o];if(i>r){for(s=i-1;s>=0&&t[s]==null;)t[s--]=null;for(s=i+1;s<n&&t[s]==null;)t[r=s++]=null}}}function Yd(t,e){if(Qd(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return Xd(i[0])||(i=Zd(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],h=l.length;for(let d=0;d<
h;d++)n.add(l[d])}let o=[Array.from(n).sort((i,a)=>i-a)],s=o[0].length,r=new Map;for(let i=0;i<s;i++)r.set(o[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let h=1;h<a.length;h++){let d=a[h],u=Array(s).fill(void 0),f=e?e[i][h]:jd,y=[];for(let b=0;b<d.length;b++){let x=d[b],M=r.get(l[b]);x===null?f!=Vd&&(u[M]=x,
f==Kd&&y.push(M)):u[M]=x}qd(u,y,s),o.push(u)}}return o}var Jd=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function Zd(t){let e=t[0],n=e.
length,o=Array(n);for(let r=0;r<o.length;r++)o[r]=r;o.sort((r,i)=>e[r]-e[i]);let s=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[o[l]];s.push(a)}return s}function Qd(t){let e=t[0][0],n=e.length;for(let o=1;o<t.length;o++){let s=t[o][0];if(s.length!=n)return!1;if(s!=e){for(let r=0;r<n;r++)
if(s[r]!=e[r])return!1}}return!0}function Xd(t,e=100){let n=t.length;if(n<=1)return!0;let o=0,s=n-1;for(;o<=s&&t[o]==null;)o++;for(;s>=o&&t[s]==null;)s--;if(s<=
o)return!0;let r=ot(1,ut((s-o+1)/e));for(let i=t[o],a=o+r;a<=s;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var Tl=["January","February","March",
"April","May","June","July","August","September","October","November","December"],Pl=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function El(t){
return t.slice(0,3)}var ep=Pl.map(El),tp=Tl.map(El),np={MMMM:Tl,MMM:tp,WWWW:Pl,WWW:ep};function vo(t){return(t<10?"0":"")+t}function op(t){return(t<10?"00":t<100?
"0":"")+t}var sp={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>vo(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>vo(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>vo(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>vo(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>vo(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>op(t.getMilliseconds())};function Yr(t,e){e=e||np;let n=[],o=/\{([a-z]+)\}|[^{]+/gi,
s;for(;s=o.exec(t);)n.push(s[0][0]=="{"?sp[s[1]]:s[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var rp=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function ip(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==rp?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var Cl=t=>t%1==0,us=[1,2,2.5,5],ap=Eo(10,-32,0,us),Al=Eo(10,0,32,us),lp=Al.filter(
Cl),wn=ap.concat(Al),Jr=`
`,_l="{YYYY}",qa=Jr+_l,Ll="{M}/{D}",Mo=Jr+Ll,ls=Mo+"/{YY}",Nl="{aa}",cp="{h}:{mm}",to=cp+Nl,Ya=Jr+to,Ja=":{ss}",fe=null;function Dl(t){let e=t*1e3,n=e*60,o=n*60,
s=o*24,r=s*30,i=s*365,l=(t==1?Eo(10,0,3,us).filter(Cl):Eo(10,-3,0,us)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,o,o*2,o*3,o*4,o*6,o*8,o*12,s,s*2,s*3,s*
4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),h=[[i,_l,fe,fe,fe,fe,fe,fe,1],[s*28,"{MMM}",qa,fe,fe,fe,fe,fe,1],[s,Ll,qa,fe,
fe,fe,fe,fe,1],[o,"{h}"+Nl,ls,fe,Mo,fe,fe,fe,1],[n,to,ls,fe,Mo,fe,fe,fe,1],[e,Ja,ls+" "+to,fe,Mo+" "+to,fe,Ya,fe,1],[t,Ja+".{fff}",ls+" "+to,fe,Mo+" "+to,fe,Ya,
fe,1]];function d(u){return(f,y,b,x,M,T)=>{let S=[],A=M>=i,E=M>=r&&M<i,R=u(b),_=be(R*t,3),G=Ar(R.getFullYear(),A?0:R.getMonth(),E||A?1:R.getDate()),B=be(G*t,3);
if(E||A){let Q=E?M/r:0,V=A?M/i:0,N=_==B?_:be(Ar(G.getFullYear()+V,G.getMonth()+Q,1)*t,3),Y=new Date(Fe(N/t)),I=Y.getFullYear(),q=Y.getMonth();for(let W=0;N<=x;W++){
let Z=Ar(I+V*W,q+Q*W,1),H=Z-u(be(Z*t,3));N=be((+Z+H)*t,3),N<=x&&S.push(N)}}else{let Q=M>=s?s:M,V=ut(b)-ut(_),N=B+V+gs(_-B,Q);S.push(N);let Y=u(N),I=Y.getHours()+
Y.getMinutes()/n+Y.getSeconds()/o,q=M/o,W=f.axes[y]._space,Z=T/W;for(;N=be(N+M,t==1?0:3),!(N>x);)if(q>1){let H=ut(be(I+q,6))%24,ie=u(N).getHours()-H;ie>1&&(ie=-1),
N-=ie*o,I=(I+q)%24;let he=S[S.length-1];be((N-he)/M,3)*Z>=.7&&S.push(N)}else S.push(N)}return S}}return[l,h,d]}var[hp,dp,pp]=Dl(1),[up,fp,mp]=Dl(.001);Eo(2,-53,
53,[1]);function Za(t,e){return t.map(n=>n.map((o,s)=>s==0||s==8||o==null?o:e(s==1||n[8]==0?o:n[1]+o)))}function Qa(t,e){return(n,o,s,r,i)=>{let a=e.find(b=>i>=
b[0])||e[e.length-1],l,h,d,u,f,y;return o.map(b=>{let x=t(b),M=x.getFullYear(),T=x.getMonth(),S=x.getDate(),A=x.getHours(),E=x.getMinutes(),R=x.getSeconds(),_=M!=
l&&a[2]||T!=h&&a[3]||S!=d&&a[4]||A!=u&&a[5]||E!=f&&a[6]||R!=y&&a[7]||a[1];return l=M,h=T,d=S,u=A,f=E,y=R,_(x)})}}function gp(t,e){let n=Yr(e);return(o,s,r,i,a)=>s.
map(l=>n(t(l)))}function Ar(t,e,n){return new Date(t,e,n)}function Xa(t,e){return e(t)}var yp="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function el(t,e){return(n,o,s,r)=>r==
null?zr:e(t(o))}function wp(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function bp(t,e){return t.series[e].fill(
t,e)}var xp={show:!0,live:!0,isolate:!1,mount:Ud,markers:{show:!0,width:2,stroke:wp,fill:bp,dash:"solid"},idx:null,idxs:null,values:[]};function vp(t,e){let n=t.
cursor.points,o=xt(),s=n.size(t,e);Pe(o,ko,s),Pe(o,So,s);let r=s/-2;Pe(o,"marginLeft",r),Pe(o,"marginTop",r);let i=n.width(t,e,s);return i&&Pe(o,"borderWidth",i),
o}function kp(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Sp(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Mp(t,e){return t.
series[e].points.size}var _r=[0,0];function Tp(t,e,n){return _r[0]=e,_r[1]=n,_r}function cs(t,e,n,o=!0){return s=>{s.button==0&&(!o||s.target==e)&&n(s)}}function Lr(t,e,n,o=!0){
return s=>{(!o||s.target==e)&&n(s)}}var Pp={show:!0,x:!0,y:!0,lock:!1,move:Tp,points:{one:!1,show:vp,size:Mp,width:0,stroke:Sp,fill:kp},bind:{mousedown:cs,mouseup:cs,
click:cs,dblclick:cs,mousemove:Lr,mouseleave:Lr,mouseenter:Lr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,o,s)=>o-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Rl={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Zr=De({},Rl,{filter:xl}),$l=De({},Zr,{size:10}),Fl=De({},Rl,{show:!1}),Qr='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Ol="bold "+Qr,Il=1.5,tl={
show:!0,scale:"x",stroke:Hr,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Ol,side:2,grid:Zr,ticks:$l,border:Fl,font:Qr,lineGap:Il,rotate:0},
Ep="Value",Cp="Time",nl={show:!0,scale:"x",auto:!1,sorted:1,min:we,max:-we,idxs:[]};function Ap(t,e,n,o,s){return e.map(r=>r==null?"":Kr(r))}function _p(t,e,n,o,s,r,i){
let a=[],l=tn.get(s)||0;n=i?n:be(gs(n,s),l);for(let h=n;h<=o;h=be(h+s,l))a.push(Object.is(h,-0)?0:h);return a}function Or(t,e,n,o,s,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,h=l==10?Vt:yl,d=ut(h(n));s=oo(l,d),l==10&&(s=wn[_t(s,wn)]);let u=n,f=s*l;l==10&&(f=wn[_t(f,wn)]);do a.push(u),u=u+s,l==10&&!tn.has(u)&&(u=be(u,tn.get(
s))),u>=f&&(s=u,f=s*l,l==10&&(f=wn[_t(f,wn)]));while(u<=o);return a}function Lp(t,e,n,o,s,r,i){let l=t.scales[t.axes[e].scale].asinh,h=o>l?Or(t,e,ot(l,n),o,s):[
l],d=o>=0&&n<=0?[0]:[];return(n<-l?Or(t,e,ot(l,-o),-n,s):[l]).reverse().map(f=>-f).concat(d,h)}var Ul=/./,Np=/[12357]/,Dp=/[125]/,ol=/1/,Ir=(t,e,n,o)=>t.map((s,r)=>e==
4&&s==0||r%o==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function Rp(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,h=r._space,d=l(10,i),u=l(
9,i)-d>=h?Ul:l(7,i)-d>=h?Np:l(5,i)-d>=h?Dp:ol;if(u==ol){let f=Oe(l(1,i)-d);if(f<h)return Ir(e.slice().reverse(),a.distr,u,vt(h/f)).reverse()}return Ir(e,a.distr,
u,1)}function $p(t,e,n,o,s){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,h=Oe(l(1,i)-l(2,i));return h<a?Ir(e.slice().reverse(),3,Ul,vt(a/h)).reverse():e}function Fp(t,e,n,o){
return o==null?zr:e==null?"":Kr(e)}var sl={show:!0,scale:"y",stroke:Hr,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Ol,side:3,grid:Zr,ticks:$l,
border:Fl,font:Qr,lineGap:Il,rotate:0};function Op(t,e){let n=3+(t||1)*2;return be(n*e,3)}function Ip(t,e){let{scale:n,idxs:o}=t.series[0],s=t._data[0],r=t.valToPos(
s[o[0]],n,!0),i=t.valToPos(s[o[1]],n,!0),a=Oe(i-r),l=t.series[e],h=a/(l.points.space*pe);return o[1]-o[0]<=h}var rl={scale:null,auto:!0,sorted:0,min:we,max:-we},
Wl=(t,e,n,o,s)=>s,il={show:!0,auto:!0,sorted:0,gaps:Wl,alpha:1,facets:[De({},rl,{scale:"x"}),De({},rl,{scale:"y"})]},al={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:Wl,alpha:1,points:{show:Ip,filter:null},values:null,min:we,max:-we,idxs:[],path:null,clip:null};function Up(t,e,n,o,s){return n/10}var Gl={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Wp=De({},Gl,{time:!1,ori:1}),ll={};function Hl(t,e){let n=ll[t];return n||(n={key:t,plots:[],sub(o){n.plots.
push(o)},unsub(o){n.plots=n.plots.filter(s=>s!=o)},pub(o,s,r,i,a,l,h){for(let d=0;d<n.plots.length;d++)n.plots[d]!=s&&n.plots[d].pub(o,s,r,i,a,l,h)}},t!=null&&(ll[t]=
n)),n}var io=1,Ur=2;function kn(t,e,n){let o=t.mode,s=t.series[e],r=o==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],h=o==2?r[1]:r[e],d=o==2?i[s.facets[0].scale]:
i[t.series[0].scale],u=o==2?i[s.facets[1].scale]:i[s.scale],f=a.left,y=a.top,b=a.width,x=a.height,M=t.valToPosH,T=t.valToPosV;return d.ori==0?n(s,l,h,d,u,M,T,f,
y,b,x,bs,lo,vs,Bl,jl):n(s,l,h,d,u,T,M,y,f,x,b,xs,co,ti,Vl,Kl)}function Xr(t,e){let n=0,o=0,s=ce(t.bands,qr);for(let r=0;r<s.length;r++){let i=s[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?o|=1:o|=2)}return[n,o==1?-1:o==2?1:o==3?2:0]}function Gp(t,e,n,o,s){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function jt(t,e,n,o,s,r){return kn(t,e,(i,a,l,h,d,u,f,y,b,x,M)=>{let T=i.pxRound,S=h.
dir*(h.ori==0?1:-1),A=h.ori==0?lo:co,E,R;S==1?(E=n,R=o):(E=o,R=n);let _=T(u(a[E],h,x,y)),G=T(f(l[E],d,M,b)),B=T(u(a[R],h,x,y)),Q=T(f(r==1?d.max:d.min,d,M,b)),V=new Path2D(
s);return A(V,B,Q),A(V,_,Q),A(V,_,G),V})}function ws(t,e,n,o,s,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?vs:ti,l=n;for(let u=0;u<t.length;u++){let f=t[u];
if(f[1]>f[0]){let y=f[0]-l;y>0&&a(i,l,o,y,o+r),l=f[1]}}let h=n+s-l,d=10;h>0&&a(i,l,o-d/2,h,o+r+d)}return i}function Hp(t,e,n){let o=t[t.length-1];o&&o[0]==e?o[1]=
n:t.push([e,n])}function ei(t,e,n,o,s,r,i){let a=[],l=t.length;for(let h=s==1?n:o;h>=n&&h<=o;h+=s)if(e[h]===null){let u=h,f=h;if(s==1)for(;++h<=o&&e[h]===null;)
f=h;else for(;--h>=n&&e[h]===null;)f=h;let y=r(t[u]),b=f==u?y:r(t[f]),x=u-s;y=i<=0&&x>=0&&x<l?r(t[x]):y;let T=f+s;b=i>=0&&T>=0&&T<l?r(t[T]):b,b>=y&&a.push([y,b])}
return a}function cl(t){return t==0?bl:t==1?Fe:e=>yn(e,t)}function zl(t){let e=t==0?bs:xs,n=t==0?(s,r,i,a,l,h)=>{s.arcTo(r,i,a,l,h)}:(s,r,i,a,l,h)=>{s.arcTo(i,r,
l,a,h)},o=t==0?(s,r,i,a,l)=>{s.rect(r,i,a,l)}:(s,r,i,a,l)=>{s.rect(i,r,l,a)};return(s,r,i,a,l,h=0,d=0)=>{h==0&&d==0?o(s,r,i,a,l):(h=Lt(h,a/2,l/2),d=Lt(d,a/2,l/2),
e(s,r+h,i),n(s,r+a,i,r+a,i+l,h),n(s,r+a,i+l,r,i+l,d),n(s,r,i+l,r,i,d),n(s,r,i,r+a,i,h),s.closePath())}}var bs=(t,e,n)=>{t.moveTo(e,n)},xs=(t,e,n)=>{t.moveTo(n,e)},
lo=(t,e,n)=>{t.lineTo(e,n)},co=(t,e,n)=>{t.lineTo(n,e)},vs=zl(0),ti=zl(1),Bl=(t,e,n,o,s,r)=>{t.arc(e,n,o,s,r)},Vl=(t,e,n,o,s,r)=>{t.arc(n,e,o,s,r)},jl=(t,e,n,o,s,r,i)=>{
t.bezierCurveTo(e,n,o,s,r,i)},Kl=(t,e,n,o,s,r,i)=>{t.bezierCurveTo(n,e,s,o,i,r)};function ql(t){return(e,n,o,s,r)=>kn(e,n,(i,a,l,h,d,u,f,y,b,x,M)=>{let{pxRound:T,
points:S}=i,A,E;h.ori==0?(A=bs,E=Bl):(A=xs,E=Vl);let R=be(S.width*pe,3),_=(S.size-S.width)/2*pe,G=be(_*2,3),B=new Path2D,Q=new Path2D,{left:V,top:N,width:Y,height:I}=e.
bbox;vs(Q,V-G,N-G,Y+G*2,I+G*2);let q=W=>{if(l[W]!=null){let Z=T(u(a[W],h,x,y)),H=T(f(l[W],d,M,b));A(B,Z+_,H),E(B,Z,H,_,0,hs*2)}};if(r)r.forEach(q);else for(let W=o;W<=
s;W++)q(W);return{stroke:R>0?B:null,fill:B,clip:Q,flags:io|Ur}})}function Yl(t){return(e,n,o,s,r,i)=>{o!=s&&(r!=o&&i!=o&&t(e,n,o),r!=s&&i!=s&&t(e,n,s),t(e,n,i))}}
var zp=Yl(lo),Bp=Yl(co);function Jl(t){let e=ce(t?.alignGaps,0);return(n,o,s,r)=>kn(n,o,(i,a,l,h,d,u,f,y,b,x,M)=>{[s,r]=fs(l,s,r);let T=i.pxRound,S=I=>T(u(I,h,x,
y)),A=I=>T(f(I,d,M,b)),E,R;h.ori==0?(E=lo,R=zp):(E=co,R=Bp);let _=h.dir*(h.ori==0?1:-1),G={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:io},B=G.
stroke,Q=!1;if(r-s>=x*4){let I=z=>n.posToVal(z,h.key,!0),q=null,W=null,Z,H,je,ge=S(a[_==1?s:r]),ie=S(a[s]),he=S(a[r]),ee=I(_==1?ie+1:he-1);for(let z=_==1?s:r;z>=
s&&z<=r;z+=_){let ke=a[z],ye=(_==1?ke<ee:ke>ee)?ge:S(ke),ae=l[z];ye==ge?ae!=null?(H=ae,q==null?(E(B,ye,A(H)),Z=q=W=H):H<q?q=H:H>W&&(W=H)):ae===null&&(Q=!0):(q!=
null&&R(B,ge,A(q),A(W),A(Z),A(H)),ae!=null?(H=ae,E(B,ye,A(H)),q=W=Z=H):(q=W=null,ae===null&&(Q=!0)),ge=ye,ee=I(ge+_))}q!=null&&q!=W&&je!=ge&&R(B,ge,A(q),A(W),A(
Z),A(H))}else for(let I=_==1?s:r;I>=s&&I<=r;I+=_){let q=l[I];q===null?Q=!0:q!=null&&E(B,S(a[I]),A(q))}let[N,Y]=Xr(n,o);if(i.fill!=null||N!=0){let I=G.fill=new Path2D(
B),q=i.fillTo(n,o,i.min,i.max,N),W=A(q),Z=S(a[s]),H=S(a[r]);_==-1&&([H,Z]=[Z,H]),E(I,H,W),E(I,Z,W)}if(!i.spanGaps){let I=[];Q&&I.push(...ei(a,l,s,r,_,S,e)),G.gaps=
I=i.gaps(n,o,s,r,I),G.clip=ws(I,h.ori,y,b,x,M)}return Y!=0&&(G.band=Y==2?[jt(n,o,s,r,B,-1),jt(n,o,s,r,B,1)]:jt(n,o,s,r,B,Y)),G})}function Vp(t){let e=ce(t.align,
1),n=ce(t.ascDesc,!1),o=ce(t.alignGaps,0),s=ce(t.extend,!1);return(r,i,a,l)=>kn(r,i,(h,d,u,f,y,b,x,M,T,S,A)=>{[a,l]=fs(u,a,l);let E=h.pxRound,{left:R,width:_}=r.
bbox,G=ie=>E(b(ie,f,S,M)),B=ie=>E(x(ie,y,A,T)),Q=f.ori==0?lo:co,V={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:io},N=V.stroke,Y=f.dir*(f.ori==
0?1:-1),I=B(u[Y==1?a:l]),q=G(d[Y==1?a:l]),W=q,Z=q;s&&e==-1&&(Z=R,Q(N,Z,I)),Q(N,q,I);for(let ie=Y==1?a:l;ie>=a&&ie<=l;ie+=Y){let he=u[ie];if(he==null)continue;let ee=G(
d[ie]),z=B(he);e==1?Q(N,ee,I):Q(N,W,z),Q(N,ee,z),I=z,W=ee}let H=W;s&&e==1&&(H=R+_,Q(N,H,I));let[je,ge]=Xr(r,i);if(h.fill!=null||je!=0){let ie=V.fill=new Path2D(
N),he=h.fillTo(r,i,h.min,h.max,je),ee=B(he);Q(ie,H,ee),Q(ie,Z,ee)}if(!h.spanGaps){let ie=[];ie.push(...ei(d,u,a,l,Y,G,o));let he=h.width*pe/2,ee=n||e==1?he:-he,
z=n||e==-1?-he:he;ie.forEach(ke=>{ke[0]+=ee,ke[1]+=z}),V.gaps=ie=h.gaps(r,i,a,l,ie),V.clip=ws(ie,f.ori,M,T,S,A)}return ge!=0&&(V.band=ge==2?[jt(r,i,a,l,N,-1),jt(
r,i,a,l,N,1)]:jt(r,i,a,l,N,ge)),V})}function hl(t,e,n,o,s,r,i=we){if(t.length>1){let a=null;for(let l=0,h=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let d=Oe(
t[l]-t[a]);d<h&&(h=d,i=Oe(n(t[l],o,s,r)-n(t[a],o,s,r)))}a=l}}return i}function jp(t){t=t||Po;let e=ce(t.size,[.6,we,1]),n=t.align||0,o=t.gap||0,s=t.radius;s=s==
null?[0,0]:typeof s=="number"?[s,0]:s;let r=re(s),i=1-e[0],a=ce(e[1],we),l=ce(e[2],1),h=ce(t.disp,Po),d=ce(t.each,y=>{}),{fill:u,stroke:f}=h;return(y,b,x,M)=>kn(
y,b,(T,S,A,E,R,_,G,B,Q,V,N)=>{let Y=T.pxRound,I=n,q=o*pe,W=a*pe,Z=l*pe,H,je;E.ori==0?[H,je]=r(y,b):[je,H]=r(y,b);let ge=E.dir*(E.ori==0?1:-1),ie=E.ori==0?vs:ti,
he=E.ori==0?d:(O,ve,$e,Mn,rn,Rt,an)=>{d(O,ve,$e,rn,Mn,an,Rt)},ee=ce(y.bands,qr).find(O=>O.series[0]==b),z=ee!=null?ee.dir:0,ke=T.fillTo(y,b,T.min,T.max,z),Ue=Y(
G(ke,R,N,Q)),ye,ae,st,Ze=V,xe=Y(T.width*pe),kt=!1,Nt=null,at=null,St=null,K=null;u!=null&&(xe==0||f!=null)&&(kt=!0,Nt=u.values(y,b,x,M),at=new Map,new Set(Nt).forEach(
O=>{O!=null&&at.set(O,new Path2D)}),xe>0&&(St=f.values(y,b,x,M),K=new Map,new Set(St).forEach(O=>{O!=null&&K.set(O,new Path2D)})));let{x0:ne,size:Re}=h;if(ne!=null&&
Re!=null){I=1,S=ne.values(y,b,x,M),ne.unit==2&&(S=S.map($e=>y.posToVal(B+$e*V,E.key,!0)));let O=Re.values(y,b,x,M);Re.unit==2?ae=O[0]*V:ae=_(O[0],E,V,B)-_(0,E,V,
B),Ze=hl(S,A,_,E,V,B,Ze),st=Ze-ae+q}else Ze=hl(S,A,_,E,V,B,Ze),st=Ze*i+q,ae=Ze-st;st<1&&(st=0),xe>=ae/2&&(xe=0),st<5&&(Y=bl);let Dt=st>0,on=Ze-st-(Dt?xe:0);ae=Y(
Fr(on,Z,W)),ye=(I==0?ae/2:I==ge?0:ae)-I*ge*((I==0?q/2:0)+(Dt?xe/2:0));let Qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Sn=kt?null:new Path2D,
Ht=null;if(ee!=null)Ht=y.data[ee.series[1]];else{let{y0:O,y1:ve}=h;O!=null&&ve!=null&&(A=ve.values(y,b,x,M),Ht=O.values(y,b,x,M))}let sn=H*ae,te=je*ae;for(let O=ge==
1?x:M;O>=x&&O<=M;O+=ge){let ve=A[O];if(ve==null)continue;if(Ht!=null){let rt=Ht[O]??0;if(ve-rt==0)continue;Ue=G(rt,R,N,Q)}let $e=E.distr!=2||h!=null?S[O]:O,Mn=_(
$e,E,V,B),rn=G(ce(ve,ke),R,N,Q),Rt=Y(Mn-ye),an=Y(ot(rn,Ue)),lt=Y(Lt(rn,Ue)),mt=an-lt;if(ve!=null){let rt=ve<0?te:sn,Mt=ve<0?sn:te;kt?(xe>0&&St[O]!=null&&ie(K.get(
St[O]),Rt,lt+ut(xe/2),ae,ot(0,mt-xe),rt,Mt),Nt[O]!=null&&ie(at.get(Nt[O]),Rt,lt+ut(xe/2),ae,ot(0,mt-xe),rt,Mt)):ie(Sn,Rt,lt+ut(xe/2),ae,ot(0,mt-xe),rt,Mt),he(y,
b,O,Rt-xe/2,lt,ae+xe,mt)}}return xe>0?Qe.stroke=kt?K:Sn:kt||(Qe._fill=T.width==0?T._fill:T._stroke??T._fill,Qe.width=0),Qe.fill=kt?at:Sn,Qe})}function Kp(t,e){let n=ce(
e?.alignGaps,0);return(o,s,r,i)=>kn(o,s,(a,l,h,d,u,f,y,b,x,M,T)=>{[r,i]=fs(h,r,i);let S=a.pxRound,A=H=>S(f(H,d,M,b)),E=H=>S(y(H,u,T,x)),R,_,G;d.ori==0?(R=bs,G=lo,
_=jl):(R=xs,G=co,_=Kl);let B=d.dir*(d.ori==0?1:-1),Q=A(l[B==1?r:i]),V=Q,N=[],Y=[];for(let H=B==1?r:i;H>=r&&H<=i;H+=B)if(h[H]!=null){let ge=l[H],ie=A(ge);N.push(
V=ie),Y.push(E(h[H]))}let I={stroke:t(N,Y,R,G,_,S),fill:null,clip:null,band:null,gaps:null,flags:io},q=I.stroke,[W,Z]=Xr(o,s);if(a.fill!=null||W!=0){let H=I.fill=
new Path2D(q),je=a.fillTo(o,s,a.min,a.max,W),ge=E(je);G(H,V,ge),G(H,Q,ge)}if(!a.spanGaps){let H=[];H.push(...ei(l,h,r,i,B,A,n)),I.gaps=H=a.gaps(o,s,r,i,H),I.clip=
ws(H,d.ori,b,x,M,T)}return Z!=0&&(I.band=Z==2?[jt(o,s,r,i,q,-1),jt(o,s,r,i,q,1)]:jt(o,s,r,i,q,Z)),I})}function qp(t){return Kp(Yp,t)}function Yp(t,e,n,o,s,r){let i=t.
length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==2)o(a,t[1],e[1]);else{let l=Array(i),h=Array(i-1),d=Array(i-1),u=Array(i-1);for(let f=0;f<i-1;f++)
d[f]=e[f+1]-e[f],u[f]=t[f+1]-t[f],h[f]=d[f]/u[f];l[0]=h[0];for(let f=1;f<i-1;f++)h[f]===0||h[f-1]===0||h[f-1]>0!=h[f]>0?l[f]=0:(l[f]=3*(u[f-1]+u[f])/((2*u[f]+u[f-
1])/h[f-1]+(u[f]+2*u[f-1])/h[f]),isFinite(l[f])||(l[f]=0));l[i-1]=h[i-2];for(let f=0;f<i-1;f++)s(a,t[f]+u[f]/3,e[f]+l[f]*u[f]/3,t[f+1]-u[f]/3,e[f+1]-l[f+1]*u[f]/
3,t[f+1],e[f+1])}return a}var Wr=new Set;function dl(){for(let t of Wr)t.syncRect(!0)}ao&&(xn(Ad,no,dl),xn(_d,no,dl,!0),xn(ds,no,()=>{Ie.pxRatio=pe}));var Jp=Jl(),
Zp=ql();function pl(t,e,n,o){return(o?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((r,i)=>Gr(r,i,e,n))}function Qp(t,e){return t.map((n,o)=>o==
0?{}:De({},e,n))}function Gr(t,e,n,o){return De({},e==0?n:o,t)}function Zl(t,e,n){return e==null?so:[e,n]}var Xp=Zl;function eu(t,e,n){return e==null?so:ps(e,n,
jr,!0)}function Ql(t,e,n,o){return e==null?so:ms(e,n,t.scales[o].log,!1)}var tu=Ql;function Xl(t,e,n,o){return e==null?so:Vr(e,n,t.scales[o].log,!1)}var nu=Xl;function ou(t,e,n,o,s){
let r=ot(Ba(t),Ba(e)),i=e-t,a=_t(s/o*i,n);do{let l=n[a],h=o*l/i;if(h>=s&&r+(l<5?tn.get(l):0)<=17)return[l,h]}while(++a<n.length);return[0,0]}function ul(t){let e,
n;return t=t.replace(/(\d+)px/,(o,s)=>(e=Fe((n=+s)*pe))+"px"),[t,e,n]}function su(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=be(e[2]*pe,1);e[0]=e[0].replace(
/[0-9.]+px/,n+"px"),e[1]=n})}function Ie(t,e,n){let o={mode:ce(t.mode,1)},s=o.mode;function r(c,p,m,g){let w=p.valToPct(c);return g+m*(p.dir==-1?1-w:w)}function i(c,p,m,g){
let w=p.valToPct(c);return g+m*(p.dir==-1?w:1-w)}function a(c,p,m,g){return p.ori==0?r(c,p,m,g):i(c,p,m,g)}o.valToPosH=r,o.valToPosV=i;let l=!1;o.status=0;let h=o.
root=xt(dd);if(t.id!=null&&(h.id=t.id),pt(h,t.class),t.title){let c=xt(fd,h);c.textContent=t.title}let d=At("canvas"),u=o.ctx=d.getContext("2d"),f=xt(md,h);xn("\
click",f,c=>{c.target===b&&(Se!=$n||Ee!=Fn)&&qe.click(o,c)},!0);let y=o.under=xt(gd,f);f.appendChild(d);let b=o.over=xt(yd,f);t=ro(t);let x=+ce(t.pxAlign,1),M=cl(
x);(t.plugins||[]).forEach(c=>{c.opts&&(t=c.opts(o,t)||t)});let T=t.ms||.001,S=o.series=s==1?pl(t.series||[],nl,al,!1):Qp(t.series||[null],il),A=o.axes=pl(t.axes||
[],tl,sl,!0),E=o.scales={},R=o.bands=t.bands||[];R.forEach(c=>{c.fill=re(c.fill||null),c.dir=ce(c.dir,-1)});let _=s==2?S[1].facets[0].scale:S[0].scale,G={axes:mh,
series:hh},B=(t.drawOrder||["axes","series"]).map(c=>G[c]);function Q(c){let p=c.distr==3?m=>Vt(m>0?m:c.clamp(o,m,c.min,c.max,c.key)):c.distr==4?m=>Cr(m,c.asinh):
c.distr==100?m=>c.fwd(m):m=>m;return m=>{let g=p(m),{_min:w,_max:k}=c,P=k-w;return(g-w)/P}}function V(c){let p=E[c];if(p==null){let m=(t.scales||Po)[c]||Po;if(m.
from!=null){V(m.from);let g=De({},E[m.from],m,{key:c});g.valToPct=Q(g),E[c]=g}else{p=E[c]=De({},c==_?Gl:Wp,m),p.key=c;let g=p.time,w=p.range,k=en(w);if((c!=_||s==
2&&!g)&&(k&&(w[0]==null||w[1]==null)&&(w={min:w[0]==null?Ga:{mode:1,hard:w[0],soft:w[0]},max:w[1]==null?Ga:{mode:1,hard:w[1],soft:w[1]}},k=!1),!k&&ys(w))){let P=w;
w=(L,D,$)=>D==null?so:ps(D,$,P)}p.range=re(w||(g?Xp:c==_?p.distr==3?tu:p.distr==4?nu:Zl:p.distr==3?Ql:p.distr==4?Xl:eu)),p.auto=re(k?!1:p.auto),p.clamp=re(p.clamp||
Up),p._min=p._max=null,p.valToPct=Q(p)}}}V("x"),V("y"),s==1&&S.forEach(c=>{V(c.scale)}),A.forEach(c=>{V(c.scale)});for(let c in t.scales)V(c);let N=E[_],Y=N.distr,
I,q;N.ori==0?(pt(h,pd),I=r,q=i):(pt(h,ud),I=i,q=r);let W={};for(let c in E){let p=E[c];(p.min!=null||p.max!=null)&&(W[c]={min:p.min,max:p.max},p.min=p.max=null)}
let Z=t.tzDate||(c=>new Date(Fe(c/T))),H=t.fmtDate||Yr,je=T==1?pp(Z):mp(Z),ge=Qa(Z,Za(T==1?dp:fp,H)),ie=el(Z,Xa(yp,H)),he=[],ee=o.legend=De({},xp,t.legend),z=o.
cursor=De({},Pp,{drag:{y:s==2}},t.cursor),ke=ee.show,Ue=z.show,ye=ee.markers;ee.idxs=he,ye.width=re(ye.width),ye.dash=re(ye.dash),ye.stroke=re(ye.stroke),ye.fill=
re(ye.fill);let ae,st,Ze,xe=[],kt=[],Nt,at=!1,St={};if(ee.live){let c=S[1]?S[1].values:null;at=c!=null,Nt=at?c(o,1,0):{_:0};for(let p in Nt)St[p]=zr}if(ke)if(ae=
At("table",Sd,h),Ze=At("tbody",null,ae),ee.mount(o,ae),at){st=At("thead",null,ae,Ze);let c=At("tr",null,st);At("th",null,c);for(var K in Nt)At("th",Ca,c).textContent=
K}else pt(ae,Td),ee.live&&pt(ae,Md);let ne={show:!0},Re={show:!1};function Dt(c,p){if(p==0&&(at||!ee.live||s==2))return so;let m=[],g=At("tr",Pd,Ze,Ze.childNodes[p]);
pt(g,c.class),c.show||pt(g,bn);let w=At("th",null,g);if(ye.show){let L=xt(Ed,w);if(p>0){let D=ye.width(o,p);D&&(L.style.border=D+"px "+ye.dash(o,p)+" "+ye.stroke(
o,p)),L.style.background=ye.fill(o,p)}}let k=xt(Ca,w);c.label instanceof HTMLElement?k.appendChild(c.label):k.textContent=c.label,p>0&&(ye.show||(k.style.color=
c.width>0?ye.stroke(o,p):ye.fill(o,p)),Qe("click",w,L=>{if(z._lock)return;cn(L);let D=S.indexOf(c);if((L.ctrlKey||L.metaKey)!=ee.isolate){let $=S.some((F,U)=>U>
0&&U!=D&&F.show);S.forEach((F,U)=>{U>0&&Ft(U,$?U==D?ne:Re:ne,!0,Le.setSeries)})}else Ft(D,{show:!c.show},!0,Le.setSeries)},!1),Pn&&Qe(Na,w,L=>{z._lock||(cn(L),Ft(
S.indexOf(c),In,!0,Le.setSeries))},!1));for(var P in Nt){let L=At("td",Cd,g);L.textContent="--",m.push(L)}return[g,m]}let on=new Map;function Qe(c,p,m,g=!0){let w=on.
get(p)||{},k=z.bind[c](o,p,m,g);k&&(xn(c,p,w[c]=k),on.set(p,w))}function Sn(c,p,m){let g=on.get(p)||{};for(let w in g)(c==null||w==c)&&($r(w,p,g[w]),delete g[w]);
c==null&&on.delete(p)}let Ht=0,sn=0,te=0,O=0,ve=0,$e=0,Mn=ve,rn=$e,Rt=te,an=O,lt=0,mt=0,rt=0,Mt=0;o.bbox={};let zs=!1,Co=!1,Tn=!1,ln=!1,Ao=!1,gt=!1;function Bs(c,p,m){
(m||c!=o.width||p!=o.height)&&hi(c,p),Ln(!1),Tn=!0,Co=!0,Nn()}function hi(c,p){o.width=Ht=te=c,o.height=sn=O=p,ve=$e=0,oh(),sh();let m=o.bbox;lt=m.left=yn(ve*pe,
.5),mt=m.top=yn($e*pe,.5),rt=m.width=yn(te*pe,.5),Mt=m.height=yn(O*pe,.5)}let eh=3;function th(){let c=!1,p=0;for(;!c;){p++;let m=uh(p),g=fh(p);c=p==eh||m&&g,c||
(hi(o.width,o.height),Co=!0)}}function nh({width:c,height:p}){Bs(c,p)}o.setSize=nh;function oh(){let c=!1,p=!1,m=!1,g=!1;A.forEach((w,k)=>{if(w.show&&w._show){let{
side:P,_size:L}=w,D=P%2,$=w.label!=null?w.labelSize:0,F=L+$;F>0&&(D?(te-=F,P==3?(ve+=F,g=!0):m=!0):(O-=F,P==0?($e+=F,c=!0):p=!0))}}),hn[0]=c,hn[1]=m,hn[2]=p,hn[3]=
g,te-=qt[1]+qt[3],ve+=qt[3],O-=qt[2]+qt[0],$e+=qt[0]}function sh(){let c=ve+te,p=$e+O,m=ve,g=$e;function w(k,P){switch(k){case 1:return c+=P,c-P;case 2:return p+=
P,p-P;case 3:return m-=P,m+P;case 0:return g-=P,g+P}}A.forEach((k,P)=>{if(k.show&&k._show){let L=k.side;k._pos=w(L,k._size),k.label!=null&&(k._lpos=w(L,k.labelSize))}})}
if(z.dataIdx==null){let c=z.hover,p=c.skip=new Set(c.skip??[]);p.add(void 0);let m=c.prox=re(c.prox),g=c.bias??=0;z.dataIdx=(w,k,P,L)=>{if(k==0)return P;let D=P,
$=m(w,k,P,L)??we,F=$>=0&&$<we,U=N.ori==0?te:O,X=z.left,de=e[0],le=e[k];if(p.has(le[P])){D=null;let se=null,J=null,j;if(g==0||g==-1)for(j=P;se==null&&j-- >0;)p.has(
le[j])||(se=j);if(g==0||g==1)for(j=P;J==null&&j++<le.length;)p.has(le[j])||(J=j);if(se!=null||J!=null)if(F){let Te=se==null?-1/0:I(de[se],N,U,0),Ae=J==null?1/0:
I(de[J],N,U,0),Ve=X-Te,me=Ae-X;Ve<=me?Ve<=$&&(D=se):me<=$&&(D=J)}else D=J==null?se:se==null?J:P-se<=J-P?se:J}else F&&Oe(X-I(de[P],N,U,0))>$&&(D=null);return D}}
let cn=c=>{z.event=c};z.idxs=he,z._lock=!1;let Je=z.points;Je.show=re(Je.show),Je.size=re(Je.size),Je.stroke=re(Je.stroke),Je.width=re(Je.width),Je.fill=re(Je.fill);
let $t=o.focus=De({},t.focus||{alpha:.3},z.focus),Pn=$t.prox>=0,En=Pn&&Je.one,yt=[],Cn=[],An=[];function di(c,p){let m=Je.show(o,p);if(m instanceof HTMLElement)
return pt(m,kd),pt(m,c.class),Gt(m,-10,-10,te,O),b.insertBefore(m,yt[p]),m}function pi(c,p){if(s==1||p>0){let m=s==1&&E[c.scale].time,g=c.value;c.value=m?Ka(g)?
el(Z,Xa(g,H)):g||ie:g||Fp,c.label=c.label||(m?Cp:Ep)}if(En||p>0){c.width=c.width==null?1:c.width,c.paths=c.paths||Jp||Wd,c.fillTo=re(c.fillTo||Gp),c.pxAlign=+ce(
c.pxAlign,x),c.pxRound=cl(c.pxAlign),c.stroke=re(c.stroke||null),c.fill=re(c.fill||null),c._stroke=c._fill=c._paths=c._focus=null;let m=Op(ot(1,c.width),1),g=c.
points=De({},{size:m,width:ot(1,m*.2),stroke:c.stroke,space:m*2,paths:Zp,_stroke:null,_fill:null},c.points);g.show=re(g.show),g.filter=re(g.filter),g.fill=re(g.
fill),g.stroke=re(g.stroke),g.paths=re(g.paths),g.pxAlign=c.pxAlign}if(ke){let m=Dt(c,p);xe.splice(p,0,m[0]),kt.splice(p,0,m[1]),ee.values.push(null)}if(Ue){he.
splice(p,0,null);let m=null;En?p==0&&(m=di(c,p)):p>0&&(m=di(c,p)),yt.splice(p,0,m),Cn.splice(p,0,0),An.splice(p,0,0)}Be("addSeries",p)}function rh(c,p){p=p??S.length,
c=s==1?Gr(c,p,nl,al):Gr(c,p,{},il),S.splice(p,0,c),pi(S[p],p)}o.addSeries=rh;function ih(c){if(S.splice(c,1),ke){ee.values.splice(c,1),kt.splice(c,1);let p=xe.splice(
c,1)[0];Sn(null,p.firstChild),p.remove()}Ue&&(he.splice(c,1),yt.splice(c,1)[0].remove(),Cn.splice(c,1),An.splice(c,1)),Be("delSeries",c)}o.delSeries=ih;let hn=[
!1,!1,!1,!1];function ah(c,p){if(c._show=c.show,c.show){let m=c.side%2,g=E[c.scale];g==null&&(c.scale=m?S[1].scale:_,g=E[c.scale]);let w=g.time;c.size=re(c.size),
c.space=re(c.space),c.rotate=re(c.rotate),en(c.incrs)&&c.incrs.forEach(P=>{!tn.has(P)&&tn.set(P,kl(P))}),c.incrs=re(c.incrs||(g.distr==2?lp:w?T==1?hp:up:wn)),c.
splits=re(c.splits||(w&&g.distr==1?je:g.distr==3?Or:g.distr==4?Lp:_p)),c.stroke=re(c.stroke),c.grid.stroke=re(c.grid.stroke),c.ticks.stroke=re(c.ticks.stroke),c.
border.stroke=re(c.border.stroke);let k=c.values;c.values=en(k)&&!en(k[0])?re(k):w?en(k)?Qa(Z,Za(k,H)):Ka(k)?gp(Z,k):k||ge:k||Ap,c.filter=re(c.filter||(g.distr>=
3&&g.log==10?Rp:g.distr==3&&g.log==2?$p:xl)),c.font=ul(c.font),c.labelFont=ul(c.labelFont),c._size=c.size(o,null,p,0),c._space=c._rotate=c._incrs=c._found=c._splits=
c._values=null,c._size>0&&(hn[p]=!0,c._el=xt(wd,f))}}function ho(c,p,m,g){let[w,k,P,L]=m,D=p%2,$=0;return D==0&&(L||k)&&($=p==0&&!w||p==2&&!P?Fe(tl.size/3):0),D==
1&&(w||P)&&($=p==1&&!k||p==3&&!L?Fe(sl.size/2):0),$}let ui=o.padding=(t.padding||[ho,ho,ho,ho]).map(c=>re(ce(c,ho))),qt=o._padding=ui.map((c,p)=>c(o,p,hn,0)),Ke,
We=null,Ge=null,_o=s==1?S[0].idxs:null,Tt=null,po=!1;function fi(c,p){if(e=c??[],o.data=o._data=e,s==2){Ke=0;for(let m=1;m<S.length;m++)Ke+=e[m][0].length}else{
e.length==0&&(o.data=o._data=e=[[]]),Tt=e[0],Ke=Tt.length;let m=e;if(Y==2){m=e.slice();let g=m[0]=Array(Ke);for(let w=0;w<Ke;w++)g[w]=w}o._data=e=m}if(Ln(!0),Be(
"setData"),Y==2&&(Tn=!0),p!==!1){let m=N;m.auto(o,po)?Vs():Jt(_,m.min,m.max),ln=ln||z.left>=0,gt=!0,Nn()}}o.setData=fi;function Vs(){po=!0;let c,p;s==1&&(Ke>0?(We=
_o[0]=0,Ge=_o[1]=Ke-1,c=e[0][We],p=e[0][Ge],Y==2?(c=We,p=Ge):c==p&&(Y==3?[c,p]=ms(c,c,N.log,!1):Y==4?[c,p]=Vr(c,c,N.log,!1):N.time?p=c+Fe(86400/T):[c,p]=ps(c,p,
jr,!0))):(We=_o[0]=c=null,Ge=_o[1]=p=null)),Jt(_,c,p)}let Lo,_n,js,Ks,qs,Ys,Js,Zs,Qs,it;function mi(c,p,m,g,w,k){c??=_a,m??=qr,g??="butt",w??=_a,k??="round",c!=
Lo&&(u.strokeStyle=Lo=c),w!=_n&&(u.fillStyle=_n=w),p!=js&&(u.lineWidth=js=p),k!=qs&&(u.lineJoin=qs=k),g!=Ys&&(u.lineCap=Ys=g),m!=Ks&&u.setLineDash(Ks=m)}function gi(c,p,m,g){
p!=_n&&(u.fillStyle=_n=p),c!=Js&&(u.font=Js=c),m!=Zs&&(u.textAlign=Zs=m),g!=Qs&&(u.textBaseline=Qs=g)}function Xs(c,p,m,g,w=0){if(g.length>0&&c.auto(o,po)&&(p==
null||p.min==null)){let k=ce(We,0),P=ce(Ge,g.length-1),L=m.min==null?Rd(g,k,P,w,c.distr==3):[m.min,m.max];c.min=Lt(c.min,m.min=L[0]),c.max=ot(c.max,m.max=L[1])}}
let yi={min:null,max:null};function lh(){for(let g in E){let w=E[g];W[g]==null&&(w.min==null||W[_]!=null&&w.auto(o,po))&&(W[g]=yi)}for(let g in E){let w=E[g];W[g]==
null&&w.from!=null&&W[w.from]!=null&&(W[g]=yi)}W[_]!=null&&Ln(!0);let c={};for(let g in W){let w=W[g];if(w!=null){let k=c[g]=ro(E[g],zd);if(w.min!=null)De(k,w);else if(g!=
_||s==2)if(Ke==0&&k.from==null){let P=k.range(o,null,null,g);k.min=P[0],k.max=P[1]}else k.min=we,k.max=-we}}if(Ke>0){S.forEach((g,w)=>{if(s==1){let k=g.scale,P=W[k];
if(P==null)return;let L=c[k];if(w==0){let D=L.range(o,L.min,L.max,k);L.min=D[0],L.max=D[1],We=_t(L.min,e[0]),Ge=_t(L.max,e[0]),Ge-We>1&&(e[0][We]<L.min&&We++,e[0][Ge]>
L.max&&Ge--),g.min=Tt[We],g.max=Tt[Ge]}else g.show&&g.auto&&Xs(L,P,g,e[w],g.sorted);g.idxs[0]=We,g.idxs[1]=Ge}else if(w>0&&g.show&&g.auto){let[k,P]=g.facets,L=k.
scale,D=P.scale,[$,F]=e[w],U=c[L],X=c[D];U!=null&&Xs(U,W[L],k,$,k.sorted),X!=null&&Xs(X,W[D],P,F,P.sorted),g.min=P.min,g.max=P.max}});for(let g in c){let w=c[g],
k=W[g];if(w.from==null&&(k==null||k.min==null)){let P=w.range(o,w.min==we?null:w.min,w.max==-we?null:w.max,g);w.min=P[0],w.max=P[1]}}}for(let g in c){let w=c[g];
if(w.from!=null){let k=c[w.from];if(k.min==null)w.min=w.max=null;else{let P=w.range(o,k.min,k.max,g);w.min=P[0],w.max=P[1]}}}let p={},m=!1;for(let g in c){let w=c[g],
k=E[g];if(k.min!=w.min||k.max!=w.max){k.min=w.min,k.max=w.max;let P=k.distr;k._min=P==3?Vt(k.min):P==4?Cr(k.min,k.asinh):P==100?k.fwd(k.min):k.min,k._max=P==3?Vt(
k.max):P==4?Cr(k.max,k.asinh):P==100?k.fwd(k.max):k.max,p[g]=m=!0}}if(m){S.forEach((g,w)=>{s==2?w>0&&p.y&&(g._paths=null):p[g.scale]&&(g._paths=null)});for(let g in p)
Tn=!0,Be("setScale",g);Ue&&z.left>=0&&(ln=gt=!0)}for(let g in W)W[g]=null}function ch(c){let p=Fr(We-1,0,Ke-1),m=Fr(Ge+1,0,Ke-1);for(;c[p]==null&&p>0;)p--;for(;c[m]==
null&&m<Ke-1;)m++;return[p,m]}function hh(){if(Ke>0){let c=S.some(p=>p._focus)&&it!=$t.alpha;c&&(u.globalAlpha=it=$t.alpha),S.forEach((p,m)=>{if(m>0&&p.show&&(wi(
m,!1),wi(m,!0),p._paths==null)){let g=it;it!=p.alpha&&(u.globalAlpha=it=p.alpha);let w=s==2?[0,e[m][0].length-1]:ch(e[m]);p._paths=p.paths(o,m,w[0],w[1]),it!=g&&
(u.globalAlpha=it=g)}}),S.forEach((p,m)=>{if(m>0&&p.show){let g=it;it!=p.alpha&&(u.globalAlpha=it=p.alpha),p._paths!=null&&bi(m,!1);{let w=p._paths!=null?p._paths.
gaps:null,k=p.points.show(o,m,We,Ge,w),P=p.points.filter(o,m,k,w);(k||P)&&(p.points._paths=p.points.paths(o,m,We,Ge,P),bi(m,!0))}it!=g&&(u.globalAlpha=it=g),Be(
"drawSeries",m)}}),c&&(u.globalAlpha=it=1)}}function wi(c,p){let m=p?S[c].points:S[c];m._stroke=m.stroke(o,c),m._fill=m.fill(o,c)}function bi(c,p){let m=p?S[c].
points:S[c],{stroke:g,fill:w,clip:k,flags:P,_stroke:L=m._stroke,_fill:D=m._fill,_width:$=m.width}=m._paths;$=be($*pe,3);let F=null,U=$%2/2;p&&D==null&&(D=$>0?"#\
fff":L);let X=m.pxAlign==1&&U>0;if(X&&u.translate(U,U),!p){let de=lt-$/2,le=mt-$/2,se=rt+$,J=Mt+$;F=new Path2D,F.rect(de,le,se,J)}p?er(L,$,m.dash,m.cap,D,g,w,P,
k):dh(c,L,$,m.dash,m.cap,D,g,w,P,F,k),X&&u.translate(-U,-U)}function dh(c,p,m,g,w,k,P,L,D,$,F){let U=!1;D!=0&&R.forEach((X,de)=>{if(X.series[0]==c){let le=S[X.series[1]],
se=e[X.series[1]],J=(le._paths||Po).band;en(J)&&(J=X.dir==1?J[0]:J[1]);let j,Te=null;le.show&&J&&Fd(se,We,Ge)?(Te=X.fill(o,de)||k,j=le._paths.clip):J=null,er(p,
m,g,w,Te,P,L,D,$,F,j,J),U=!0}}),U||er(p,m,g,w,k,P,L,D,$,F)}let xi=io|Ur;function er(c,p,m,g,w,k,P,L,D,$,F,U){mi(c,p,m,g,w),(D||$||U)&&(u.save(),D&&u.clip(D),$&&
u.clip($)),U?(L&xi)==xi?(u.clip(U),F&&u.clip(F),Do(w,P),No(c,k,p)):L&Ur?(Do(w,P),u.clip(U),No(c,k,p)):L&io&&(u.save(),u.clip(U),F&&u.clip(F),Do(w,P),u.restore(),
No(c,k,p)):(Do(w,P),No(c,k,p)),(D||$||U)&&u.restore()}function No(c,p,m){m>0&&(p instanceof Map?p.forEach((g,w)=>{u.strokeStyle=Lo=w,u.stroke(g)}):p!=null&&c&&u.
stroke(p))}function Do(c,p){p instanceof Map?p.forEach((m,g)=>{u.fillStyle=_n=g,u.fill(m)}):p!=null&&c&&u.fill(p)}function ph(c,p,m,g){let w=A[c],k;if(g<=0)k=[0,
0];else{let P=w._space=w.space(o,c,p,m,g),L=w._incrs=w.incrs(o,c,p,m,g,P);k=ou(p,m,L,g,P)}return w._found=k}function tr(c,p,m,g,w,k,P,L,D,$){let F=P%2/2;x==1&&u.
translate(F,F),mi(L,P,D,$,L),u.beginPath();let U,X,de,le,se=w+(g==0||g==3?-k:k);m==0?(X=w,le=se):(U=w,de=se);for(let J=0;J<c.length;J++)p[J]!=null&&(m==0?U=de=c[J]:
X=le=c[J],u.moveTo(U,X),u.lineTo(de,le));u.stroke(),x==1&&u.translate(-F,-F)}function uh(c){let p=!0;return A.forEach((m,g)=>{if(!m.show)return;let w=E[m.scale];
if(w.min==null){m._show&&(p=!1,m._show=!1,Ln(!1));return}else m._show||(p=!1,m._show=!0,Ln(!1));let k=m.side,P=k%2,{min:L,max:D}=w,[$,F]=ph(g,L,D,P==0?te:O);if(F==
0)return;let U=w.distr==2,X=m._splits=m.splits(o,g,L,D,$,F,U),de=w.distr==2?X.map(j=>Tt[j]):X,le=w.distr==2?Tt[X[1]]-Tt[X[0]]:$,se=m._values=m.values(o,m.filter(
o,de,g,F,le),g,F,le);m._rotate=k==2?m.rotate(o,se,g,F):0;let J=m._size;m._size=vt(m.size(o,se,g,c)),J!=null&&m._size!=J&&(p=!1)}),p}function fh(c){let p=!0;return ui.
forEach((m,g)=>{let w=m(o,g,hn,c);w!=qt[g]&&(p=!1),qt[g]=w}),p}function mh(){for(let c=0;c<A.length;c++){let p=A[c];if(!p.show||!p._show)continue;let m=p.side,g=m%
2,w,k,P=p.stroke(o,c),L=m==0||m==3?-1:1,[D,$]=p._found;if(p.label!=null){let et=p.labelGap*L,dt=Fe((p._lpos+et)*pe);gi(p.labelFont[0],P,"center",m==2?"top":Aa),
u.save(),g==1?(w=k=0,u.translate(dt,Fe(mt+Mt/2)),u.rotate((m==3?-hs:hs)/2)):(w=Fe(lt+rt/2),k=dt);let un=wl(p.label)?p.label(o,c,D,$):p.label;u.fillText(un,w,k),
u.restore()}if($==0)continue;let F=E[p.scale],U=g==0?rt:Mt,X=g==0?lt:mt,de=p._splits,le=F.distr==2?de.map(et=>Tt[et]):de,se=F.distr==2?Tt[de[1]]-Tt[de[0]]:D,J=p.
ticks,j=p.border,Te=J.show?J.size:0,Ae=Fe(Te*pe),Ve=Fe((p.alignTo==2?p._size-Te-p.gap:p.gap)*pe),me=p._rotate*-hs/180,_e=M(p._pos*pe),ct=(Ae+Ve)*L,Xe=_e+ct;k=g==
0?Xe:0,w=g==1?Xe:0;let wt=p.font[0],Pt=p.align==1?eo:p.align==2?Tr:me>0?eo:me<0?Tr:g==0?"center":m==3?Tr:eo,It=me||g==1?"middle":m==2?"top":Aa;gi(wt,P,Pt,It);let ht=p.
font[1]*p.lineGap,bt=de.map(et=>M(a(et,F,U,X))),Et=p._values;for(let et=0;et<Et.length;et++){let dt=Et[et];if(dt!=null){g==0?w=bt[et]:k=bt[et],dt=""+dt;let un=dt.
indexOf(`
`)==-1?[dt]:dt.split(/\n/gm);for(let tt=0;tt<un.length;tt++){let Ui=un[tt];me?(u.save(),u.translate(w,k+tt*ht),u.rotate(me),u.fillText(Ui,0,0),u.restore()):u.fillText(
Ui,w,k+tt*ht)}}}J.show&&tr(bt,J.filter(o,le,c,$,se),g,m,_e,Ae,be(J.width*pe,3),J.stroke(o,c),J.dash,J.cap);let Ut=p.grid;Ut.show&&tr(bt,Ut.filter(o,le,c,$,se),g,
g==0?2:1,g==0?mt:lt,g==0?Mt:rt,be(Ut.width*pe,3),Ut.stroke(o,c),Ut.dash,Ut.cap),j.show&&tr([_e],[1],g==0?1:0,g==0?1:2,g==1?mt:lt,g==1?Mt:rt,be(j.width*pe,3),j.stroke(
o,c),j.dash,j.cap)}Be("drawAxes")}function Ln(c){S.forEach((p,m)=>{m>0&&(p._paths=null,c&&(s==1?(p.min=null,p.max=null):p.facets.forEach(g=>{g.min=null,g.max=null})))})}
let Ro=!1,nr=!1,uo=[];function gh(){nr=!1;for(let c=0;c<uo.length;c++)Be(...uo[c]);uo.length=0}function Nn(){Ro||(Jd(vi),Ro=!0)}function yh(c,p=!1){Ro=!0,nr=p,c(
o),vi(),p&&uo.length>0&&queueMicrotask(gh)}o.batch=yh;function vi(){if(zs&&(lh(),zs=!1),Tn&&(th(),Tn=!1),Co){if(Pe(y,eo,ve),Pe(y,"top",$e),Pe(y,ko,te),Pe(y,So,O),
Pe(b,eo,ve),Pe(b,"top",$e),Pe(b,ko,te),Pe(b,So,O),Pe(f,ko,Ht),Pe(f,So,sn),d.width=Fe(Ht*pe),d.height=Fe(sn*pe),A.forEach(({_el:c,_show:p,_size:m,_pos:g,side:w})=>{
if(c!=null)if(p){let k=w===3||w===0?m:0,P=w%2==1;Pe(c,P?"left":"top",g-k),Pe(c,P?"width":"height",m),Pe(c,P?"top":"left",P?$e:ve),Pe(c,P?"height":"width",P?O:te),
Rr(c,bn)}else pt(c,bn)}),Lo=_n=js=qs=Ys=Js=Zs=Qs=Ks=null,it=1,go(!0),ve!=Mn||$e!=rn||te!=Rt||O!=an){Ln(!1);let c=te/Rt,p=O/an;if(Ue&&!ln&&z.left>=0){z.left*=c,z.
top*=p,Dn&&Gt(Dn,Fe(z.left),0,te,O),Rn&&Gt(Rn,0,Fe(z.top),te,O);for(let m=0;m<yt.length;m++){let g=yt[m];g!=null&&(Cn[m]*=c,An[m]*=p,Gt(g,vt(Cn[m]),vt(An[m]),te,
O))}}if(Me.show&&!Ao&&Me.left>=0&&Me.width>0){Me.left*=c,Me.width*=c,Me.top*=p,Me.height*=p;for(let m in lr)Pe(On,m,Me[m])}Mn=ve,rn=$e,Rt=te,an=O}Be("setSize"),
Co=!1}Ht>0&&sn>0&&(u.clearRect(0,0,d.width,d.height),Be("drawClear"),B.forEach(c=>c()),Be("draw")),Me.show&&Ao&&($o(Me),Ao=!1),Ue&&ln&&(pn(null,!0,!1),ln=!1),ee.
show&&ee.live&&gt&&(ir(),gt=!1),l||(l=!0,o.status=1,Be("ready")),po=!1,Ro=!1}o.redraw=(c,p)=>{Tn=p||!1,c!==!1?Jt(_,N.min,N.max):Nn()};function or(c,p){let m=E[c];
if(m.from==null){if(Ke==0){let g=m.range(o,p.min,p.max,c);p.min=g[0],p.max=g[1]}if(p.min>p.max){let g=p.min;p.min=p.max,p.max=g}if(Ke>1&&p.min!=null&&p.max!=null&&
p.max-p.min<1e-16)return;c==_&&m.distr==2&&Ke>0&&(p.min=_t(p.min,e[0]),p.max=_t(p.max,e[0]),p.min==p.max&&p.max++),W[c]=p,zs=!0,Nn()}}o.setScale=or;let sr,rr,Dn,
Rn,ki,Si,$n,Fn,Mi,Ti,Se,Ee,Yt=!1,qe=z.drag,He=qe.x,ze=qe.y;Ue&&(z.x&&(sr=xt(xd,b)),z.y&&(rr=xt(vd,b)),N.ori==0?(Dn=sr,Rn=rr):(Dn=rr,Rn=sr),Se=z.left,Ee=z.top);let Me=o.
select=De({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),On=Me.show?xt(bd,Me.over?b:y):null;function $o(c,p){if(Me.show){for(let m in c)Me[m]=c[m],m in
lr&&Pe(On,m,c[m]);p!==!1&&Be("setSelect")}}o.setSelect=$o;function wh(c){if(S[c].show)ke&&Rr(xe[c],bn);else if(ke&&pt(xe[c],bn),Ue){let m=En?yt[0]:yt[c];m!=null&&
Gt(m,-10,-10,te,O)}}function Jt(c,p,m){or(c,{min:p,max:m})}function Ft(c,p,m,g){p.focus!=null&&Sh(c),p.show!=null&&S.forEach((w,k)=>{k>0&&(c==k||c==null)&&(w.show=
p.show,wh(k),s==2?(Jt(w.facets[0].scale,null,null),Jt(w.facets[1].scale,null,null)):Jt(w.scale,null,null),Nn())}),m!==!1&&Be("setSeries",c,p),g&&yo("setSeries",
o,c,p)}o.setSeries=Ft;function bh(c,p){De(R[c],p)}function xh(c,p){c.fill=re(c.fill||null),c.dir=ce(c.dir,-1),p=p??R.length,R.splice(p,0,c)}function vh(c){c==null?
R.length=0:R.splice(c,1)}o.addBand=xh,o.setBand=bh,o.delBand=vh;function kh(c,p){S[c].alpha=p,Ue&&yt[c]!=null&&(yt[c].style.opacity=p),ke&&xe[c]&&(xe[c].style.opacity=
p)}let zt,Zt,dn,In={focus:!0};function Sh(c){if(c!=dn){let p=c==null,m=$t.alpha!=1;S.forEach((g,w)=>{if(s==1||w>0){let k=p||w==0||w==c;g._focus=p?null:k,m&&kh(w,
k?1:$t.alpha)}}),dn=c,m&&Nn()}}ke&&Pn&&Qe(Da,ae,c=>{z._lock||(cn(c),dn!=null&&Ft(null,In,!0,Le.setSeries))});function Ot(c,p,m){let g=E[p];m&&(c=c/pe-(g.ori==1?
$e:ve));let w=te;g.ori==1&&(w=O,c=w-c),g.dir==-1&&(c=w-c);let k=g._min,P=g._max,L=c/w,D=k+(P-k)*L,$=g.distr;return $==3?oo(10,D):$==4?Id(D,g.asinh):$==100?g.bwd(
D):D}function Mh(c,p){let m=Ot(c,_,p);return _t(m,e[0],We,Ge)}o.valToIdx=c=>_t(c,e[0]),o.posToIdx=Mh,o.posToVal=Ot,o.valToPos=(c,p,m)=>E[p].ori==0?r(c,E[p],m?rt:
te,m?lt:0):i(c,E[p],m?Mt:O,m?mt:0),o.setCursor=(c,p,m)=>{Se=c.left,Ee=c.top,pn(null,p,m)};function Pi(c,p){Pe(On,eo,Me.left=c),Pe(On,ko,Me.width=p)}function Ei(c,p){
Pe(On,"top",Me.top=c),Pe(On,So,Me.height=p)}let fo=N.ori==0?Pi:Ei,mo=N.ori==1?Pi:Ei;function Th(){if(ke&&ee.live)for(let c=s==2?1:0;c<S.length;c++){if(c==0&&at)
continue;let p=ee.values[c],m=0;for(let g in p)kt[c][m++].firstChild.nodeValue=p[g]}}function ir(c,p){if(c!=null&&(c.idxs?c.idxs.forEach((m,g)=>{he[g]=m}):Hd(c.
idx)||he.fill(c.idx),ee.idx=he[0]),ke&&ee.live){for(let m=0;m<S.length;m++)(m>0||s==1&&!at)&&Ph(m,he[m]);Th()}gt=!1,p!==!1&&Be("setLegend")}o.setLegend=ir;function Ph(c,p){
let m=S[c],g=c==0&&Y==2?Tt:e[c],w;at?w=m.values(o,c,p)??St:(w=m.value(o,p==null?null:g[p],c,p),w=w==null?St:{_:w}),ee.values[c]=w}function pn(c,p,m){Mi=Se,Ti=Ee,
[Se,Ee]=z.move(o,Se,Ee),z.left=Se,z.top=Ee,Ue&&(Dn&&Gt(Dn,Fe(Se),0,te,O),Rn&&Gt(Rn,0,Fe(Ee),te,O));let g,w=We>Ge;zt=we,Zt=null;let k=N.ori==0?te:O,P=N.ori==1?te:
O;if(Se<0||Ke==0||w){g=z.idx=null;for(let L=0;L<S.length;L++){let D=yt[L];D!=null&&Gt(D,-10,-10,te,O)}Pn&&Ft(null,In,!0,c==null&&Le.setSeries),ee.live&&(he.fill(
g),gt=!0)}else{let L,D,$;s==1&&(L=N.ori==0?Se:Ee,D=Ot(L,_),g=z.idx=_t(D,e[0],We,Ge),$=I(e[0][g],N,k,0));let F=-10,U=-10,X=0,de=0,le=!0,se="",J="";for(let j=s==2?
1:0;j<S.length;j++){let Te=S[j],Ae=he[j],Ve=Ae==null?null:s==1?e[j][Ae]:e[j][1][Ae],me=z.dataIdx(o,j,g,D),_e=me==null?null:s==1?e[j][me]:e[j][1][me];if(gt=gt||_e!=
Ve||me!=Ae,he[j]=me,j>0&&Te.show){let ct=me==null?-10:me==g?$:I(s==1?e[0][me]:e[j][0][me],N,k,0),Xe=_e==null?-10:q(_e,s==1?E[Te.scale]:E[Te.facets[1].scale],P,0);
if(Pn&&_e!=null){let wt=N.ori==1?Se:Ee,Pt=Oe($t.dist(o,j,me,Xe,wt));if(Pt<zt){let It=$t.bias;if(It!=0){let ht=Ot(wt,Te.scale),bt=_e>=0?1:-1,Et=ht>=0?1:-1;Et==bt&&
(Et==1?It==1?_e>=ht:_e<=ht:It==1?_e<=ht:_e>=ht)&&(zt=Pt,Zt=j)}else zt=Pt,Zt=j}}if(gt||En){let wt,Pt;N.ori==0?(wt=ct,Pt=Xe):(wt=Xe,Pt=ct);let It,ht,bt,Et,Ut,et,dt=!0,
un=Je.bbox;if(un!=null){dt=!1;let tt=un(o,j);bt=tt.left,Et=tt.top,It=tt.width,ht=tt.height}else bt=wt,Et=Pt,It=ht=Je.size(o,j);if(et=Je.fill(o,j),Ut=Je.stroke(o,
j),En)j==Zt&&zt<=$t.prox&&(F=bt,U=Et,X=It,de=ht,le=dt,se=et,J=Ut);else{let tt=yt[j];tt!=null&&(Cn[j]=bt,An[j]=Et,Wa(tt,It,ht,dt),Ia(tt,et,Ut),Gt(tt,vt(bt),vt(Et),
te,O))}}}}if(En){let j=$t.prox,Te=dn==null?zt<=j:zt>j||Zt!=dn;if(gt||Te){let Ae=yt[0];Ae!=null&&(Cn[0]=F,An[0]=U,Wa(Ae,X,de,le),Ia(Ae,se,J),Gt(Ae,vt(F),vt(U),te,
O))}}}if(Me.show&&Yt)if(c!=null){let[L,D]=Le.scales,[$,F]=Le.match,[U,X]=c.cursor.sync.scales,de=c.cursor.drag;if(He=de._x,ze=de._y,He||ze){let{left:le,top:se,width:J,
height:j}=c.select,Te=c.scales[U].ori,Ae=c.posToVal,Ve,me,_e,ct,Xe,wt=L!=null&&$(L,U),Pt=D!=null&&F(D,X);wt&&He?(Te==0?(Ve=le,me=J):(Ve=se,me=j),_e=E[L],ct=I(Ae(
Ve,U),_e,k,0),Xe=I(Ae(Ve+me,U),_e,k,0),fo(Lt(ct,Xe),Oe(Xe-ct))):fo(0,k),Pt&&ze?(Te==1?(Ve=le,me=J):(Ve=se,me=j),_e=E[D],ct=q(Ae(Ve,X),_e,P,0),Xe=q(Ae(Ve+me,X),_e,
P,0),mo(Lt(ct,Xe),Oe(Xe-ct))):mo(0,P)}else cr()}else{let L=Oe(Mi-ki),D=Oe(Ti-Si);if(N.ori==1){let X=L;L=D,D=X}He=qe.x&&L>=qe.dist,ze=qe.y&&D>=qe.dist;let $=qe.uni;
$!=null?He&&ze&&(He=L>=$,ze=D>=$,!He&&!ze&&(D>L?ze=!0:He=!0)):qe.x&&qe.y&&(He||ze)&&(He=ze=!0);let F,U;He&&(N.ori==0?(F=$n,U=Se):(F=Fn,U=Ee),fo(Lt(F,U),Oe(U-F)),
ze||mo(0,P)),ze&&(N.ori==1?(F=$n,U=Se):(F=Fn,U=Ee),mo(Lt(F,U),Oe(U-F)),He||fo(0,k)),!He&&!ze&&(fo(0,0),mo(0,0))}if(qe._x=He,qe._y=ze,c==null){if(m){if(Ii!=null){
let[L,D]=Le.scales;Le.values[0]=L!=null?Ot(N.ori==0?Se:Ee,L):null,Le.values[1]=D!=null?Ot(N.ori==1?Se:Ee,D):null}yo(Pr,o,Se,Ee,te,O,g)}if(Pn){let L=m&&Le.setSeries,
D=$t.prox;dn==null?zt<=D&&Ft(Zt,In,!0,L):zt>D?Ft(null,In,!0,L):Zt!=dn&&Ft(Zt,In,!0,L)}}gt&&(ee.idx=g,ir()),p!==!1&&Be("setCursor")}let Qt=null;Object.defineProperty(
o,"rect",{get(){return Qt==null&&go(!1),Qt}});function go(c=!1){c?Qt=null:(Qt=b.getBoundingClientRect(),Be("syncRect",Qt))}function Ci(c,p,m,g,w,k,P){z._lock||Yt&&
c!=null&&c.movementX==0&&c.movementY==0||(ar(c,p,m,g,w,k,P,!1,c!=null),c!=null?pn(null,!0,!0):pn(p,!0,!1))}function ar(c,p,m,g,w,k,P,L,D){if(Qt==null&&go(!1),cn(
c),c!=null)m=c.clientX-Qt.left,g=c.clientY-Qt.top;else{if(m<0||g<0){Se=-10,Ee=-10;return}let[$,F]=Le.scales,U=p.cursor.sync,[X,de]=U.values,[le,se]=U.scales,[J,
j]=Le.match,Te=p.axes[0].side%2==1,Ae=N.ori==0?te:O,Ve=N.ori==1?te:O,me=Te?k:w,_e=Te?w:k,ct=Te?g:m,Xe=Te?m:g;if(le!=null?m=J($,le)?a(X,E[$],Ae,0):-10:m=Ae*(ct/me),
se!=null?g=j(F,se)?a(de,E[F],Ve,0):-10:g=Ve*(Xe/_e),N.ori==1){let wt=m;m=g,g=wt}}D&&(p==null||p.cursor.event.type==Pr)&&((m<=1||m>=te-1)&&(m=yn(m,te)),(g<=1||g>=
O-1)&&(g=yn(g,O))),L?(ki=m,Si=g,[$n,Fn]=z.move(o,m,g)):(Se=m,Ee=g)}let lr={width:0,height:0,left:0,top:0};function cr(){$o(lr,!1)}let Ai,_i,Li,Ni;function Di(c,p,m,g,w,k,P){
Yt=!0,He=ze=qe._x=qe._y=!1,ar(c,p,m,g,w,k,P,!0,!1),c!=null&&(Qe(Er,Nr,Ri,!1),yo(La,o,$n,Fn,te,O,null));let{left:L,top:D,width:$,height:F}=Me;Ai=L,_i=D,Li=$,Ni=F}
function Ri(c,p,m,g,w,k,P){Yt=qe._x=qe._y=!1,ar(c,p,m,g,w,k,P,!1,!0);let{left:L,top:D,width:$,height:F}=Me,U=$>0||F>0,X=Ai!=L||_i!=D||Li!=$||Ni!=F;if(U&&X&&$o(Me),
qe.setScale&&U&&X){let de=L,le=$,se=D,J=F;if(N.ori==1&&(de=D,le=F,se=L,J=$),He&&Jt(_,Ot(de,_),Ot(de+le,_)),ze)for(let j in E){let Te=E[j];j!=_&&Te.from==null&&Te.
min!=we&&Jt(j,Ot(se+J,j),Ot(se,j))}cr()}else z.lock&&(z._lock=!z._lock,pn(p,!0,c!=null));c!=null&&(Sn(Er,Nr),yo(Er,o,Se,Ee,te,O,null))}function Eh(c,p,m,g,w,k,P){
if(z._lock)return;cn(c);let L=Yt;if(Yt){let D=!0,$=!0,F=10,U,X;N.ori==0?(U=He,X=ze):(U=ze,X=He),U&&X&&(D=Se<=F||Se>=te-F,$=Ee<=F||Ee>=O-F),U&&D&&(Se=Se<$n?0:te),
X&&$&&(Ee=Ee<Fn?0:O),pn(null,!0,!0),Yt=!1}Se=-10,Ee=-10,he.fill(null),pn(null,!0,!0),L&&(Yt=L)}function $i(c,p,m,g,w,k,P){z._lock||(cn(c),Vs(),cr(),c!=null&&yo(
Ra,o,Se,Ee,te,O,null))}function Fi(){A.forEach(su),Bs(o.width,o.height,!0)}xn(ds,no,Fi);let Un={};Un.mousedown=Di,Un.mousemove=Ci,Un.mouseup=Ri,Un.dblclick=$i,Un.
setSeries=(c,p,m,g)=>{let w=Le.match[2];m=w(o,p,m),m!=-1&&Ft(m,g,!0,!1)},Ue&&(Qe(La,b,Di),Qe(Pr,b,Ci),Qe(Na,b,c=>{cn(c),go(!1)}),Qe(Da,b,Eh),Qe(Ra,b,$i),Wr.add(
o),o.syncRect=go);let Fo=o.hooks=t.hooks||{};function Be(c,p,m){nr?uo.push([c,p,m]):c in Fo&&Fo[c].forEach(g=>{g.call(null,o,p,m)})}(t.plugins||[]).forEach(c=>{
for(let p in c.hooks)Fo[p]=(Fo[p]||[]).concat(c.hooks[p])});let Oi=(c,p,m)=>m,Le=De({key:null,setSeries:!1,filters:{pub:Va,sub:Va},scales:[_,S[1]?S[1].scale:null],
match:[ja,ja,Oi],values:[null,null]},z.sync);Le.match.length==2&&Le.match.push(Oi),z.sync=Le;let Ii=Le.key,hr=Hl(Ii);function yo(c,p,m,g,w,k,P){Le.filters.pub(c,
p,m,g,w,k,P)&&hr.pub(c,p,m,g,w,k,P)}hr.sub(o);function Ch(c,p,m,g,w,k,P){Le.filters.sub(c,p,m,g,w,k,P)&&Un[c](null,p,m,g,w,k,P)}o.pub=Ch;function Ah(){hr.unsub(
o),Wr.delete(o),on.clear(),$r(ds,no,Fi),h.remove(),ae?.remove(),Be("destroy")}o.destroy=Ah;function dr(){Be("init",t,e),fi(e||t.data,!1),W[_]?or(_,W[_]):Vs(),Ao=
Me.show&&(Me.width>0||Me.height>0),ln=gt=!0,Bs(t.width,t.height)}return S.forEach(pi),A.forEach(ah),n?n instanceof HTMLElement?(n.appendChild(h),dr()):n(o,dr):dr(),
o}Ie.assign=De;Ie.fmtNum=Kr;Ie.rangeNum=ps;Ie.rangeLog=ms;Ie.rangeAsinh=Vr;Ie.orient=kn;Ie.pxRatio=pe;Ie.join=Yd;Ie.fmtDate=Yr,Ie.tzDate=ip;Ie.sync=Hl;{Ie.addGap=
Hp,Ie.clipGaps=ws;let t=Ie.paths={points:ql};t.linear=Jl,t.stepped=Vp,t.bars=jp,t.spline=qp}var ks=128,ec=50,ru=.25,iu=t=>[t.ray,t.truth,t.sensor,t.noReturn],au=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),lu=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),Ss=(t,e)=>({font:Jo,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function tc(t,e,n){let o=null,s=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>o&&r()>0&&o.setSize({width:r(),height:ks})).
observe(t),i=>r()<=0?null:((!o||i||s!==n())&&(o?.destroy(),o=e(),o.setSize({width:r(),height:ks}),s=n()),o)}function nc(t,e){let{session:n}=t,o=v("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),s="all",r=t.segmented("Trace",[["all","All"],["first",`First ${ec}`]],()=>s,b=>{s=b,h=null,n.changed()}),
i=0,a=-1/0,l=-1,h=null,u=tc(o,()=>{let b=iu(e()),x=Array.from({length:i},(M,T)=>({label:`chain ${T+1}`,stroke:b[T%b.length],width:1,points:{show:!1}}));return new Ie(
{width:100,height:ks,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,lu,0,0],scales:{x:{time:!1,range:(M,T,S)=>[T,Math.max(S,T+1)]},y:{range:(M,T,S)=>pu(
Math.max(T,a),S)}},axes:[Ss(e,26),Ss(e,au)],series:[{label:"sweep"},...x],hooks:{draw:[M=>fu(M,l,e()),M=>uu(M,h?.burned??0,e())]}},[[],...x.map(()=>[])],o)},e),
f=v("span",{className:"caption",textContent:"log joint by sweep"}),y=v("div",{className:"charted"},v("div",{className:"buttons"},r,f),o);return t.each(()=>{let b=n.
shown,x=b?.traced?.length?b.trace.length/b.traced.length:0;if(C(y,"hidden",x===0),!b||!x)return;let M=n.document?.source.kind==="run"?"draw":"sweep";C(f,"textCo\
ntent",`log joint by ${M}`);let T=b.layer==="draw"&&n.draws.count?(n.draw+1)*b.traced[b.traced.length-1]/n.draws.count:-1,S=u(x!==i&&(i=x,!0));if(!S||h===b&&l===
T&&S.data[0].length)return;[h,l]=[b,T],a=s==="all"?du(b,x):-1/0;let A=cu(b,x,s);S.setData(A),o.setAttribute("data-sweeps",A[0].join())}),y}function cu({trace:t,
traced:e},n,o){let s=o==="all"?hu(e):[...e.keys()].filter(i=>e[i]<=ec),r=i=>Float32Array.from(s,a=>i[a]);return[r(e),...Array.from({length:n},(i,a)=>r(t.subarray(
a*e.length,(a+1)*e.length)))]}function hu(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,o=-1/0;return[...t.keys()].filter(s=>t[s]<o&&s<e-1?!1:
(o=t[s]+n,!0))}function du({trace:t,traced:e},n){let o=e.length,s=e.findIndex(r=>r>=ru*e[o-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.min(...t.slice(
i*o+s,(i+1)*o))))}function pu(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function uu(t,e,n){let{left:o,top:s,width:r,height:i}=t.bbox;e&&(t.ctx.save(),t.
ctx.globalAlpha=.12,t.ctx.fillStyle=n.axis,t.ctx.fillRect(o,s,Math.min(r,Math.max(0,t.valToPos(e,"x",!0)-o)),i),t.ctx.restore())}function fu(t,e,n){if(e<0)return;
let{left:o,top:s,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<o||a>o+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,s,2,i),t.ctx.restore())}function oc(t,e){
let{session:n}=t,o=v("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),s=v("div",{className:"caption",textContent:"partic\
les by weight, nats below the heaviest"}),r=v("div",{className:"charted"},s,o),a=tc(o,()=>new Ie({width:100,height:ks,legend:{show:!1},cursor:{show:!1},padding:[
8,10,0,0],scales:{x:{time:!1,range:(h,d,u)=>[d,u]},y:{distr:3,range:(h,d,u)=>[.5,Math.max(10,2*u)]}},axes:[Ss(e,26),{...Ss(e,52),values:(h,d)=>d.map(u=>u>=1?String(
u):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Ie.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],o),e),l=null;return t.each(()=>{let h=n.
shown;C(r,"hidden",!h?.weights);let d=h?.weights&&a(!1);if(!h?.weights||!d||l===h&&d.data[0].length)return;l=h;let u=[...h.weights],f=-(h.lowest??-1)/u.length,y=[
...u.map((b,x)=>(h.lowest??-1)+x*f),0];d.setData([y,[...u.map(b=>b||null),null]])}),r}function sc(t){let{session:e,hand:n}=t,{decisions:o}=e,s=v("p",{className:"said",role:"status"}),r=v("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>o.radius,h=>o.set({radius:h}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>o.risk,h=>o.set({risk:h}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,s),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{C(l,"textContent",i()),C(s,"textContent",n.tool==="path"?mu(t):gu(t))}),a}function mu({session:t}){let{start:e,goal:n,path:o,
trouble:s}=t.decisions;if(s)return s;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!o)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=o.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${ue(
o.length_m,2)} m, free with probability ${ue(o.probability,3)} ± ${ue(o.standard_error,3)} by ${o.draws} draws. Independent cells would say ${ue(o.independent,
3)}.${r}`}function gu({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let o=Math.max(...e.
nats),s=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${ue(Math.min(...e.nats),1)} to ${ue(o,1)} nats, cells taken for indepen\
dent; the best place has a ring.${s}`}var yu=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],wu="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",bu="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",xu="Shown is what the reading\
s tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (wi\
dth). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",vu="While you edit, the answer is belief pr\
opagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",ku="The map is made from the scans of this log. Where its poses are raw \
odometry, Run first infers where the robot was; then it samples maps, and keeps them as draws.",Su="This is a saved run: its draws, and what they say together.",
Mu="Mouse: the wheel zooms, the middle button pans.",Tu="Shift or the right button erases, and so does a click on a wall.",Pu="Touch: two fingers zoom and pan.";
function rc(t){let{session:e}=t,n=v("div"),o=oa.map(([i,a,l])=>{let h=v("tr",{},v("th",{scope:"row"},v("kbd",{textContent:i})),v("td",{textContent:a}));return t.
visible(h,()=>Eu[l??"all"](e)),h}),s=v("p"),r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?xu:bu,l=e.editable?[`${wu} ${a}`,vu]:i===
"log"?[a,ku]:i==="run"?[a,Su]:[a];l.join()!==r&&n.replaceChildren(...l.map(h=>v("p",{textContent:h}))),r=l.join(),C(s,"textContent",[Mu,...e.editable?[Tu]:[],Pu].
join(" "))}),t.dialog("Help",n,s,v("table",{},v("tbody",{},...o)))}var Eu={all:()=>!0,drawn:t=>t.editable,asked:t=>!t.recorded,inferred:t=>!t.recorded&&t.document?.
source.kind!=="run"};function ic(t){let e=()=>v("input",{type:"number",step:1,required:!0,value:"21"}),[n,o]=[e(),e()];for(let i of[n,o])t.bounded(i,"side");let s=v(
"select",{});for(let[i,a]of yu)s.append(v("option",{value:i,textContent:a}));s.addEventListener("change",()=>{s.value==="building"&&Number(n.value)<60&&([n.value,
o.value]=["120","80"])});let r=v("form",{method:"dialog"},t.row("World",s),t.row("Width (cells)",n),t.row("Height (cells)",o),v("div",{className:"buttons end"},
v("button",{type:"submit",className:"primary",textContent:"Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),
Number(o.value)],world:s.value}),t.hand.selected=null}),t.dialog("New map",r)}var Cu="The link holds the walls, the sensors and all settings after its #, and no\
 token. It opens in this browser while the server runs; the part from # on can be put after the address of any bayesmap page.",Au="The link holds the file's nam\
e and all settings after its #, but no scans and no token. It opens in this browser while the server shows this file; the part from # on can be put after the ad\
dress of any bayesmap page that shows it.";function ac(t){let e=v("input",{type:"text",readOnly:!0,"aria-label":"Link"}),n=v("span",{role:"status",className:"co\
pied"}),o=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent=
"",2e3)},s=t.button(null,"Copy the link",o,{className:"primary",text:"Copy"}),r=v("p");t.each(()=>C(r,"textContent",t.session.document?.source.kind==="simulatio\
n"?Cu:Au));let i=t.dialog("Share",r,v("div",{className:"buttons"},e,s),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var _u=8;function lc(t){let{session:e,hand:n}=t,o=v("p",{className:"words",role:"status"}),s=v("ol",{className:"spoken"}),r=t.section("Evidence of beams",o,s),i=-1;
return t.visible(r,()=>n.tool==="evidence"),t.each(()=>{let{evidence:a}=e;if(C(o,"textContent",Nu(e)),i===a.version)return;i=a.version;let{nats:l,scan:h,beam:d}=a.
each??{nats:[],scan:[],beam:[]},u=Array.from(l.slice(0,_u),(f,y)=>v("li",{},`${br(f)} nats: ${Lu(e,h[y],d[y])}`));s.replaceChildren(...u)}),r}var Lu=({document:t,
editable:e},n,o)=>`beam ${o+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function Nu({evidence:t,quantity:e}){let{cell:n,together:o}=t;if(!n)return"\
Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";let s=`Cell ${n.x}, ${n.y}`;if(!o)return`${s}: aski\
ng its beams.`;if(!o.beams)return`${s}: no beam reaches it.`;let r=o.beams===1?"1 beam":`${o.beams} beams`;if(o.nats_for===null||o.nats_against===null)return`${s}\
: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"its surface"}[e.kind]??"what is there",a=o.beams_for||o.beams_against?"":" Non\
e of them says anything.";return`${s}: ${r}. For ${i} (blue) ${o.beams_for}, ${o.nats_for.toFixed(1)} nats; against (orange) ${o.beams_against}, ${o.nats_against.
toFixed(1)} nats.${a}`}var Kt=t=>t.charAt(0).toUpperCase()+t.slice(1),Ms=class{text="Connecting";level="info";until=0;say(e,n,o){this.text=Kt(e),this.level=n,this.until=o}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var cc=t=>Math.round(t*180/Math.PI);function hc(t){let{session:e,hand:n}=t,{ghost:o}=e,s=(l,h)=>t.numberInput(l,()=>Number((o.pose?.[h]??0).toFixed(2)),d=>o.move(
{[h]:d}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>cc(o.pose?.yaw??0),l=>o.move({yaw:l*Math.PI/180}),{step:5}),i=v("p",{className:"words ghosted"}),a=t.
section("Ghost",v("div",{className:"triple"},s("Ghost x","x"),s("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>C(i,"textContent",Du(t))),
a}function Du({session:t}){let{ghost:e}=t;if(e.trouble)return Kt(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:o,high:s,near:r}=e.fan,i=Array.from(s,(d,u)=>d-o[u]).filter(Number.isFinite).sort((d,u)=>d-u),a=i.length?`${ue(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",h=r?` \
Rings are the hits of scan ${r.index+1}, taken ${ue(100*r.away,0)} cm from here, turned by ${cc(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${h}`}function dc(t){let{session:e}=t,n=v("span",{className:"what"});t.each(()=>{let{grid:h,source:d}=e.document??{};if(!h||!d)return;let u=`${h.shape[0]} × ${h.shape[1]}\
 cells of ${+h.resolution.toPrecision(3)} m`;C(n,"textContent",d.name?`${d.name}, ${u}`:u)});let o=()=>!e.recorded&&!!e.document,s=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo,why:"Nothing of this page to undo"}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"\
Redo (Ctrl+Y)",when:()=>!!e.state?.can_redo,why:"Nothing to redo"}),v("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:o}),
...t.embedded?[]:[t.button("link","Share",()=>t.command("share"),{text:"Share",when:o})]];for(let h of s)t.visible(h,()=>!e.recorded);let r=t.button("theme","Th\
eme: automatic",()=>t.command("theme")),i=t.button("help","Help",()=>t.command("help"),{title:"Help (?)"}),a=v("span",{className:"space"});return{element:v("hea\
der",{},v("h1",{textContent:"bayesmap"}),n,a,...s,$u(t),r,i),nameTheme(h){let d=`Theme: ${h}`;nt(r,"aria-label",d),C(r,"title",d)}}}var Ru=({shown:t,draws:e})=>e.
count>0||/importance|propagate/.test(t?.method??"");function $u(t){let{session:e}=t,n=(a,l,h,d,u)=>{let f=t.button(null,a,()=>t.command(`export ${l}`),{text:a,when:d,
why:u});return h&&t.visible(f,()=>!e.recorded),f},o=v("div",{className:"menu",hidden:!0},n("Picture (PNG)","png",!1),n("Saved run (netCDF)","run",!0,()=>Ru(e),"\
No draws are kept yet: Run keeps them"),n("Map for robots (YAML and PGM)","map",!0),n("Page in one file (HTML)","html",!0),n("Document (JSON)","document",!0)),s=t.
button("save","Export",()=>r(o.hidden),{text:"Export",when:()=>!!e.document}),r=a=>{o.hidden=!a,s.setAttribute("aria-expanded",String(a)),a&&o.firstElementChild.
focus()};r(!1);let i=v("div",{className:"anchor"},s,o);return i.addEventListener("keydown",a=>{a.key!=="Escape"||o.hidden||(r(!1),s.focus(),a.stopPropagation())}),
i.addEventListener("focusout",a=>{i.contains(a.relatedTarget)||r(!1)}),o.addEventListener("click",()=>{r(!1),s.focus()}),i}var Fu={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function nn(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",Fu[t]),e.append(n),e}var Ts=({document:t})=>!t||t.source.kind==="simulation",oi=({recorded:t})=>!t,pc="surface (zoom in)",uc=[{mark:"truth",text:"true wall",when:Ts,may:Ts},{mark:"r\
ay",text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.
strokes.length,may:t=>!Ts(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!Ts(t)},{mark:"unobserved",text:"unobserved"},
{mark:"draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:oi},
{mark:"path",text:"path, as wide as the robot",when:({decisions:t})=>!!t.path,may:oi}],fc=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 % of a pl\
ace"}],mc=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function gc(t,e,n){let o=v("p",{className:"sentence"});return t.each(()=>C(
o,"textContent",Ou(t.session))),v("div",{className:"legend"},o,Iu(t,e,n),Uu(t))}var ni=(t,e)=>`${t.toLocaleString("en")} ${e}${t===1?"":"s"}`;function Ou(t){let{
shown:e,document:n,layer:o,quantity:s,draws:r}=t;if(!e||!n)return"";let{kind:i,mean:a,value:l}=s,h={mean:i==="binary"?"How probable a wall is in each cell":Kt(`${a}\
 of each cell`),draw:`One map drawn from the posterior${i==="binary"?"":`, by its ${l}`}${r.count?`, ${t.draw+1} of ${r.count}`:""}`,entropy:"How uncertain each\
 cell is, in bits",width:"How wide the 90 % interval of each cell is"}[o];if(e.method==="none")return`${h} before any reading: the prior.`;let{source:d,angles:u,
sensors:f,scans_used:y}=n,b=d.kind==="simulation"?`${ni(u*f.length,"beam")} of ${ni(f.length,"sensor")}`:ni(y??d.scans,"scan"),M=(e.method==="propagate"||e.method===
"pilot"||/hits|counts/.test(e.method))&&e.approximate?", approximately":o!=="draw"&&e.burned?`: the mean of the sweeps after the first ${e.burned}`:"";return`${h}\
, given ${b}${M}.`}function Iu(t,e,n){let{session:o}=t,s=v("span",{className:"ramp"}),r=v("span",{className:"name"}),i=uc.map(d=>{let[u,f]=Ps(d),{mark:y,when:b}=d;
return b&&t.visible(u,()=>b(o)),y==="stroke"&&t.each(()=>C(f,"textContent",bo(n())?d.text:pc)),y==="path"&&t.each(()=>u.firstElementChild?.classList.toggle("ris\
ky",o.decisions.path?.within_risk===!1)),u}),[a,l]=[fc,mc].map(d=>d.map(u=>Ps(u)[0]));for(let d of a)t.visible(d,()=>!!o.where.found);for(let d of l)t.visible(d,
()=>!!o.evidence.cellShown);let h="";return t.each(()=>{let{layer:d}=o;C(r,"textContent",yc(o,d));let u=d==="entropy"||d==="width",f=`${u} ${e().ground}`;h!==f&&
(h=f,s.style.background=yr(u?Vn:y=>gr(e(),y)))}),v("ul",{"aria-label":"Legend"},v("li",{},r,v("span",{className:"scale"},"0",s,"1")),...i,Wu(t),...a,...l)}function Uu(t){
let{session:e}=t,n=["mean","draw","entropy","width"].map(h=>{let d=v("span");return t.each(()=>C(d,"textContent",yc(e,h))),h==="width"&&t.visible(d,()=>e.quantity.
interval),d}),o=uc.map(h=>{let[d,u]=Ps(h);h.mark==="stroke"&&(u.textContent=pc);let{may:f}=h;return f&&t.visible(d,()=>f(e)),d}),s=v("span",{className:"scale"},
"00.0",v("span",{className:"ramp"}),"000.0 nats"),r=[fc,mc].map(h=>v("ul",{},...h.map(d=>Ps(d)[0]))),i=[v("ul",{},v("li",{},"one more scan tells",s)),...r],a=v(
"li",{className:"either"},...i);t.visible(a,()=>oi(e));let l=v("span",{className:"scale"},"0",v("span",{className:"ramp"}),"1");return v("ul",{className:"room",
"aria-hidden":"true"},v("li",{},v("span",{className:"name either"},...n),l),...o,a)}function Ps({mark:t,text:e}){let n=v("i",{className:t});t==="sensor"&&n.append(
nn("sensor"));let o=v("span",{textContent:e});return[v("li",{},n,o),o]}function yc({quantity:t},e){let{kind:n,mean:o,value:s}=t;return e==="entropy"?"entropy (b\
it)":e==="width"?"width of the 90 % interval":n==="binary"?"P(wall)":e==="draw"?s:o}function Wu(t){let{decisions:e}=t.session,n=v("span",{className:"ramp"});n.style.
background=yr(Vn);let[o,s]=[v("span"),v("span")],r=v("li",{className:"views"},"one more scan tells",v("span",{className:"scale"},o,n,s));return t.visible(r,()=>e.
looking&&!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(C(o,"textContent",ue(Math.min(...i),1)),C(s,"textContent",`${ue(Math.max(...i),1)} \
nats`))}),r}var Gu=[.05,.1,.2,.4,.8],Hu=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function wc(t){let{session:e}=t,n=v("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),o="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,h=Math.
max(l[0]-a[0],l[1]-a[1]),d=[...new Set([...Gu,r.resolution])].sort((f,y)=>f-y),[,u]=t.limits("side_of_log");if(o!==`${d} ${u}`){o=`${d} ${u}`;let f=y=>v("option",
{value:String(y),textContent:Hu(y),disabled:h/y>u-1});n.replaceChildren(...d.map(f))}C(n,"value",String(r.resolution))});let s=t.row("Cell size",n);return t.visible(
s,()=>e.document?.source.kind==="log"),s}function bc(t){let{session:e}=t,n=v("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),o=v("output"),s=()=>e.
document?.source.scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=s()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});
let i=t.section("Log",v("div",{className:"player bare"},n,o));return t.visible(i,()=>!e.recorded&&e.document?.source.kind==="log"&&s()>1),t.each(()=>{let a=s(),
l=e.document?.scans_used??a;C(n,"max",String(Math.max(1,a))),(!gn(n)||Number(n.value)!==l)&&C(n,"value",String(l));let h=l===a?`all ${a} scans`:`after ${l} of ${a}`;
n.style.setProperty("--fill",`${100*(l-1)/Math.max(1,a-1)}%`),nt(n,"aria-valuetext",h),C(o,"textContent",h)}),i}var zu=20,Bu={importance:"particles",propagate:"rounds"},Es=({working:t,shown:e})=>t&&e?.method==="pilot";function xc(t,...e){let{session:n}=t,o=v("progress",{max:1,
value:0,"aria-label":"Progress"}),s=v("div",{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.
source.kind==="log"),l=Es(n),h=i?i.done/i.total:r&&!a&&r.total>0&&(l||!r.approximate)?r.sweeps/r.total:0;C(o,"value",h);let d=n.remaining_s(),u=Bu[r?.method??""]??
"sweeps",f=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${u}`:"",y=d!==null?d<1?"less than 1 s left":`${Math.ceil(d)} s left`:n.running?"running":"",b=f&&
r?.burned?`the first ${r.burned} left out`:"",x=n.sampling||n.running||!r||r.sweeps>=r.total?"":"stopped";i?C(s,"textContent",`${i.text}: ${i.done} of ${i.total}\
 ${i.total>zu?"scans":"rounds"}`):a?C(s,"textContent","Computing"):r&&l?C(s,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):C(s,"textConten\
t",Kt([f,b,y,f&&x].filter(Boolean).join(", "))||Vu(n))}),t.section("Posterior",ju(t),o,s,Ku(t),Yu(t),...e,qu(t))}function Vu({shown:t,working:e}){return t?.method===
"propagate"?`${t.sweeps} rounds of belief propagation`:t?.method==="hits"?"Counts of hits and passes":t?.method==="counts"?"Run infers where the robot was":t?.method===
"pilot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function ju(t){let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"\
primary",text:"Run",title:"Run (R)",when:()=>e.connection.connected,why:"Not while the connection is lost"}),o=t.button("close","Cancel",()=>e.act({type:"cancel"}),
{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||e.sampling||Es(e),why:"Nothing is running"}),s=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({
type:"live",on:i}),"Every edit restarts the chain"),r=v("div",{className:"buttons"},n,o,s);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),
r}function Ku(t){let{session:e}=t,n=v("dl"),o=(r,i,a,l=!1)=>{let h=v("dd",{textContent:"–"}),d=v("div",{title:i},v("dt",{textContent:r}),h);return n.append(d),
t.each(()=>{C(h,"textContent",e.shown?a(e.shown):"–"),l&&C(h,"className",e.shown?.verdict?.level??"")}),d};o("ESS","Effective sample size of the log joint",r=>ue(
r.ess,0),!0),o("R-hat","Agreement of the chains on the log joint; 1 is full",r=>ue(r.rhat,3),!0),o("log joint","Log of prior times likelihood at the last sweep",
r=>ue(r.log_joint,Math.abs(r.log_joint??0)<1e5?1:0)),o("time","Time spent on sweeps, rounds or particles",r=>ue(r.seconds,1," s"));let s=o("reply","From the han\
d's last move to its picture",()=>ue(e.latency.eventToPaint_ms.at(-1),0," ms"));return t.visible(s,()=>!e.recorded),n}var si=({shown:t})=>t?.method==="importanc\
e"?{good:"Enough particles",fair:"Few particles",bad:"Collapsed"}:{good:"Converged",fair:"Nearly converged",bad:"Not converged"};function qu(t){let{session:e}=t,
n=v("dl",{className:"about"}),o=v("details",{},v("summary",{textContent:"Model and method of this picture"}),n),s="";return t.each(()=>{let r=e.shown?.about??[];
C(o,"hidden",!r.length),String(r)!==s&&(s=String(r),n.replaceChildren(...r.flatMap(([i,a])=>[v("dt",{textContent:i}),v("dd",{textContent:a})])))}),o}function Yu(t){
let{session:e}=t,n=v("span"),o=t.button(null,"Show the cell",()=>t.command(`cell ${e.shown?.verdict?.cell}`),{text:"Show the cell"});t.visible(o,()=>!!e.shown?.
verdict?.cell);let s=v("div",{className:"verdict"},n,o);return t.each(()=>{let r=e.shown?.verdict;C(s,"hidden",!r),r&&(C(n,"textContent",`${si(e)[r.level]}: ${r.
why}`),C(s,"className",`verdict ${r.level}`))}),s}var Ju="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",vc=200,
Zu="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",kc="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",Qu="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function Tc(t){let{session:e}=t,n=v("span",{className:"chip"}),o=t.button(null,"Not converged",()=>Sc(
e)?.apply?.(),{text:"Not converged",className:"chip doubt"}),s=v("div",{className:"chips"},n,o);return t.each(()=>{let r=Sc(e);if(C(o,"hidden",!r),r){let u=[si(
e).bad,r.text].filter(Boolean).join(": ");C(o.firstElementChild,"textContent",u.charAt(0).toLowerCase()+u.slice(1)),C(o,"title",`${e.shown?.verdict?.why}.${r.apply?
` Click to ${r.text}.`:""}`),C(o,"disabled",!r.apply),nt(o,"aria-label",u)}let i=e.shown;if(!i||!e.document)return C(s,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",l=i.layer==="draw"?a+(e.flicker.under?" over the mean":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="en\
tropy"?"entropy":"mean";if(i.method==="counts"){C(s,"hidden",!1);let u=e.halfway?"along poses found so far":"along raw odometry";return C(n,"textContent",`hits \
and passes · ${e.stage?e.stage.text.toLowerCase():u}`),C(n,"className","chip approximate")}let h={importance:"importance sampling",propagate:"belief propagatio\
n"}[i.method],d=i.approximate?`approximate, ${Xu(i,e.working)}`:h??`${i.sweeps} sweeps`;C(s,"hidden",!1),C(n,"textContent",`${l} · ${d}`),C(n,"className",i.approximate?
"chip approximate":"chip")}),s}function Xu({method:t,sweeps:e,total:n,averaged:o},s){return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${o===
1?"1 draw":`${o} draws`} of one chain, sensor ${s?"being":"half"} fitted: sweep ${e} of ${n}`}function Sc(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="b\
ad"||!n)return null;if(t.recorded||n.source.kind==="run")return{text:""};let o=a=>()=>t.act({type:"set",patch:a}),s=e.sweeps<vc,r=n.pose_sigma===0&&n.heading_sigma===
0;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!s&&r)return{text:"try blocks",apply:o({method:"block"})};if(e.method==="importance")return{text:"try Gib\
bs",apply:o({method:"auto"})};if(e.sweeps<e.total)return null;if(!r&&!s)return{text:"poses are too uncertain"};let i=Math.min(t.limits?.sweeps[1]??0,Math.max(vc,
4*n.sweeps));return i>n.sweeps?{text:`try ${i} sweeps`,apply:o({sweeps:i})}:{text:""}}function Pc(t){let{session:e}=t,n=v("span"),o=t.button(null,"Reconnect now",
()=>e.transport.retry?.(),{text:"Reconnect now"}),s=v("div",{className:"banner",role:"alert",hidden:!0},n,o);return t.each(()=>{let r=e.everConnected&&!e.connection.
connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??0)/1e3));C(s,"hidden",!r&&e.worker!=="restarted"),C(s,"className",r?"banner":"banner mild"),C(o,"hid\
den",!r);let a=`Connection lost. Trying again in ${i} s; the map is kept here.`,l=e.connection.refused?Ju:a;C(n,"textContent",r?l:"The worker stopped and is bei\
ng started again. The map is kept.")}),s}function Ec(t){let{session:e,hand:n}=t,o=v("div",{className:"readout",id:`${t.prefix}-readout`}),s=v("span",{role:"stat\
us","aria-live":"polite"}),r=v("span",{className:"hidden","aria-live":"polite"});return n.announce=i=>C(r,"textContent",i),n.describe=i=>Mc(e,i),t.each(()=>{let{
kind:i}=e.quantity;C(o,"title",i==="binary"?Zu:i==="surface"?`${kc}. ${Qu}`:kc);let a=n.cursor??n.hover,h=matchMedia("(pointer: coarse)").matches?"Touch a cell":
e.editable?"Point at a cell, or press ? for the keys":"Point at a cell";C(o,"textContent",a?Mc(e,a):h);let d=e.status.text==="Ready"&&e.shown?.verdict?.level===
"bad",u=e.status.text==="Ready"&&Es(e),f=e.shown?.method==="importance"?"Ready, but importance sampling has collapsed":"Ready, but the chains have not converged",
y=e.everConnected&&!e.connection.connected&&e.status.level==="info";C(s,"textContent",y?"Connection lost":d?f:u?"Fitting the sensor":e.status.text),C(s,"classNa\
me",y?"error":d?"warning":u?"busy":e.status.level)}),{element:v("footer",{},s,o,r),readout:o}}function Mc(t,e){let{document:n,shown:o}=t;if(!n)return"";let{resolution:s,
shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.log10(s))+1),{x:l,y:h}=Hn(e,n.grid),d=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${h.toFixed(a)} m`];if(o&&
o.p.length===r[0]*r[1]){let u=o.p[i]/255,{kind:f,mean:y,value:b,interval:x}=t.quantity;o.layer==="width"?d.push(`90 % interval ${u.toFixed(2)} wide`):f!=="binar\
y"&&o.layer==="draw"?d.push(`${b} ${u.toFixed(2)} in this draw`):f!=="binary"?d.push(`${y} ${u.toFixed(2)}`,...x?[]:[`entropy ${wo(u).toFixed(2)} bit`]):o.layer===
"draw"?d.push(u>.5?"wall in this draw":"free in this draw"):d.push(`P(wall) ${u.toFixed(2)}`,`entropy ${wo(u).toFixed(2)} bit`);let M=t.evidence.facts,T=M?.x===
e.x&&M.y===e.y?M:null,S=T?T.beams:null,A=o.reached[i]/255,E=n.source.kind==="run";if(A?!E&&A<.995&&d.push(`reached by a beam with probability ${A.toFixed(2)}`):
d.push(E?"reached by a beam in less than half of the draws":"unobserved"),A&&S!==null&&d.push(S===1?"1 beam":`${S} beams`),A&&T&&T.nats_for!==null&&T.nats_against!==
null&&S){let R={binary:"a wall",surface:"its surface"}[t.quantity.kind]??"what is there";d.push(`for ${R} ${T.beams_for}, ${T.nats_for.toFixed(1)} nats`,`agains\
t ${T.beams_against}, ${T.nats_against.toFixed(1)} nats`)}}return d.join(" · ")}var ef={logged:"as logged",odometry:"from raw odometry"},tf=180/Math.PI;function Cc(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",o=t.select("Poses",
ef,()=>e.document?.poses??"logged",a=>t.set({poses:a}));o.classList.add("wide"),t.visible(o,n);let s=[t.slider("pose_sigma",()=>"Position ±",{step:.05,unit:" m"}),
t.slider("heading_sigma",()=>"Yaw ±",{step:.5,unit:"°",scale:tf})];for(let a of s)t.visible(a,()=>e.editable);let r=v("p",{className:"caption"});t.each(()=>{let{
pose_sigma:a=0,heading_sigma:l=0,method:h="auto"}=e.document??{},d=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,u=e.editable&&(a>
0||l>0)&&!/auto|gibbs|block/.test(h);C(r,"hidden",!u&&!d),C(r,"textContent",d?"Run infers where the robot was.":"This method takes poses as known; Gibbs does no\
t.")});let i=t.section("Where the robot was",o,...s,r);return t.visible(i,()=>e.editable||n()&&!e.recorded),i}var Cs=t=>Math.abs(t)<.995?`${ue(100*Math.abs(t),1)} cm`:`${ue(Math.abs(t),2)} m`,nf="Point at a reading to compare it with what the posterior predicts of it.",
of=": preparing the comparison. The first one after an installation takes some seconds.";function Ac(t){let{session:e}=t,n=v("p",{className:"words reading",role:"\
status"}),o=t.section("Reading",n);return t.visible(o,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:s,found:r,trouble:i,
slow:a}=e.reading,l=s?`Beam ${s.beam+1} of scan ${s.scan+1}${a?of:"."}`:nf;C(n,"textContent",i||(r?sf(r):l))}),o}function sf({scan:t,beam:e,reading:n,range:o,low:s,
median:r,high:i,residual:a,no_return:l,wall:h}){let d=`Beam ${e+1} of scan ${t+1}`,u=(T,S)=>T===null?S:`${ue(T,2)} m`,f=`median ${u(r,"no return")}, 80 % betwee\
n ${u(s,"too close")} and ${u(i,"no return")}`;if(n==="none")return`${d} came back from nothing, which was predicted with probability ${ue(l??0,3)} (${f}).`;if(n!==
"hit"||o===null)return`${d} read nothing that says how far (${f}).`;let y=a===null?"":`, ${Cs(a)} ${a<0?"shorter":"longer"} than the predicted median`,b=`${d} r\
ead ${ue(o,2)} m${y} (${f}).`;if(!h)return b;let x=`${Cs(h.across_m)} ${h.across_m<0?"behind":"in front of"} the wall, which is ${Cs(h.thickness_m)} thick`,M=`${Cs(
h.along_m)} to the ${h.along_m<0?"right":"left"} along it from the middle of its surface`;return`${b} It ended ${x} (one standard deviation), and ${M}; the beam\
 met it at ${ue(h.incidence_rad*180/Math.PI,0)}° from its normal.`}var rf={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},af={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},lf={noisy:"with noise",exact:"exact"},cf={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},hf={raster:"raster",radial:"radial",random:"random"},As=2*Math.PI,df=t=>Math.round(t*1800/Math.PI)/10,pf={importance:"Particles",propagate:"Round\
s"};function _c(t){let{session:e,hand:n,editor:o}=t,s=v("select",{"aria-label":"Selected sensor"});s.addEventListener("change",()=>{n.selected=Number(s.value),n.
choose("sensor")});let r="";t.each(()=>{let u=e.document?.sensors??[],f=u.map(y=>y.id).join();f!==r&&s.replaceChildren(...u.map(({id:y})=>v("option",{value:String(
y),textContent:`Sensor ${y}`}))),r=f,C(s,"value",String(n.sensor?.id??""))});let i=(u,f)=>t.numberInput(u,()=>Number((n.sensor?.[f]??0).toFixed(2)),y=>n.sensor&&
o.moveSensor(n.sensor,{[f]:y}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),u=>n.sensor&&o.moveSensor(n.sensor,{yaw:u%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),h=t.button("minus","Remove the sensor",()=>o.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1,why:"The last sensor stays"});t.visible(a,()=>(e.document?.fov??As)<As);let d=v("div",{className:"triple"},i(
"x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",v("div",{className:"buttons"},s,l,h),d)}function Lc(t){let{session:e}=t,n=t.numberInput("Longest range\
 (m)",()=>e.document?.max_range??0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),o=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("\
angles",()=>"Angles",{step:1,log:!0}),n,t.numberInput("Field of view (°)",()=>df(e.document?.fov??As),a=>t.set({fov:a>=360?As:a*Math.PI/180}),{step:5,limits:"f\
ov",scale:180/Math.PI}),t.select("Readings",lf,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of o)t.visible(a,()=>e.editable);let s=t.slider(
"prior",()=>"Prior P(wall)",{step:.01}),r=()=>(e.document?.cells??"binary")==="binary";t.visible(s,r);let i=t.select("Cells",af,()=>e.document?.cells??"binary",
a=>t.set({cells:a}));return t.visible(i,()=>e.document?.source.kind==="log"),t.section("Model",i,wc(t),s,...o)}function Nc(t){let{session:e}=t,n=()=>e.document?.
method??"auto",o=()=>(e.document?.cells??"binary")==="binary",s=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",rf,n,a=>t.set({method:a})),t.select("Order",
hf,()=>e.document?.order??"radial",a=>t.set({order:a}),()=>n()==="gibbs"||n()==="auto","Only Gibbs, cell by cell, has an order"),t.select("Start",cf,()=>e.document?.
start??"auto",a=>t.set({start:a}),s,"Only chains have a start")];for(let a of r)t.visible(a,o);let i=t.slider("burn_in",()=>"Burn-in (%)",{step:5,scale:100});return t.
visible(i,()=>s()||!o()),t.section("Inference",...r,i,t.slider("sweeps",()=>pf[n()]??"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,a=>t.
set({seed:Math.round(a)}),{step:1,limits:"seed"}))}function Dc(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"C\
lear walls",when:()=>e.editable}),o=t.button(null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.
editable),t.section("Clear",v("div",{className:"buttons"},n,o))}var uf=0,_s=class{constructor(e,n,o,s,r,i){this.session=e;this.hand=n;this.editor=o;this.command=s;this.showLayer=r;this.embedded=i}prefix=`bayesmap${uf++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[o,s]=this.session.limits?.[e]??[1,
2];return n===1?[o,s]:[Math.ceil(10*o*n-1e-6)/10,Math.floor(10*s*n+1e-6)/10]}bounded(e,n,o=1){this.each(()=>{let[s,r]=this.limits(n,o);C(e,"min",String(s)),C(e,
"max",String(r))})}visible(e,n){this.each(()=>C(e,"hidden",!n()))}button(e,n,o,{className:s="",text:r="",when:i,why:a,title:l}={}){let h=v("button",{type:"butto\
n",className:s,title:l??n,onclick:o},e&&nn(e));return r&&h.append(v("span",{textContent:r})),r!==n&&h.setAttribute("aria-label",n),i&&this.each(()=>{C(h,"disabl\
ed",!i()),a&&C(h,"title",h.disabled?a:l??n)}),h}segmented(e,n,o,s,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=v("div",{className:"segmented",role:"radiog\
roup","aria-label":e});for(let[l,h,d]of n){let u=v("input",{type:"radio",name:i,value:l,onchange:()=>s(l)});a.append(v("label",{title:h},u,d?nn(d):null,v("span",
{textContent:h}))),this.each(()=>{C(u,"checked",o()===l),r&&C(u,"disabled",!r(l))})}return a}section(e,...n){let o=`${this.prefix}-${e.replace(/\W/g,"")}`;return v(
"section",{"aria-labelledby":o},v("h2",{id:o,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,v("div",{className:"row"},v("lab\
el",{for:n.id,textContent:e}),n)}slider(e,n,{step:o,log:s=!1,unit:r="",scale:i=1}){let a=`${this.prefix}-${e}`,l=()=>this.limits(e,i),h=x=>{let[M,T]=l();return s?
1e3*Math.log(x/M)/Math.log(T/M):x},d=x=>{if(!s)return x;let[M,T]=l(),S=M*(T/M)**(x/1e3),A=S<100?1:10**(Math.floor(Math.log10(S))-1);return oe(Math.round(S/A)*A,
M,T)},u=()=>{let x=this.session.document?.[e];return x===void 0?l()[0]:i===1?x:Number((x*i).toFixed(3))},f=v("label",{for:a}),y=v("input",{type:"range",id:a,...s?
{min:0,max:1e3,step:1}:{step:o}}),b=v("input",{type:"number",step:String(o)});return s||this.bounded(y,e,i),this.bounded(b,e,i),y.addEventListener("input",()=>this.
set({[e]:d(Number(y.value))/i})),y.addEventListener("change",()=>this.endDrag()),b.addEventListener("change",()=>{this.typed(b,n(),l(),u,x=>this.set({[e]:s?Math.
round(x):x/i})),this.endDrag()}),this.each(()=>{let x=u();C(f,"textContent",n()),nt(b,"aria-label",`${n()}, number`),d(Number(y.value))!==x&&(y.value=String(h(x))),
nt(y,"aria-valuetext",`${x}${r}`);let M=100*(h(x)-Number(y.min))/(Number(y.max)-Number(y.min));y.style.setProperty("--fill",`${oe(M,0,100)}%`),gn(b)||C(b,"value",
String(x))}),v("div",{className:"row slider"},f,y,b)}select(e,n,o,s,r,i=""){let a=v("select",{onchange:()=>s(a.value)});for(let[l,h]of Object.entries(n))a.append(
v("option",{value:l,textContent:h}));return this.each(()=>{C(a,"value",o()),r&&C(a,"disabled",!r()),i&&C(a,"title",a.disabled?i:"")}),this.row(e,a)}typed(e,n,[o,
s],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(oe(a,o,s)),e.value=String(r()),a<o?this.session.say(`${n} is at least ${o}`,"warning"):a>s&&
this.session.say(`${n} is at most ${s}`,"warning")}numberInput(e,n,o,{step:s,limits:r,scale:i}){let a=v("input",{type:"number",step:String(s)}),l=()=>r?this.limits(
r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,l(),n,o)),this.each(()=>{gn(a)||C(a,"value",String(n()))}),this.row(
e,a)}checkbox(e,n,o,s=""){let r=v("input",{type:"checkbox",onchange:()=>o(r.checked)});return this.each(()=>C(r,"checked",n())),v("label",{className:"check",title:s},
r,v("span",{textContent:e}))}dialog(e,...n){let o=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,s=v("button",{type:"button",className:"plain","aria-label":"Clo\
se",onclick:()=>i.close()},nn("close")),r=v("div",{className:"title"},v("h2",{id:o,textContent:e}),s),i=v("dialog",{"aria-labelledby":o},r,...n);return i.addEventListener(
"click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),i}};var ff=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],Rc="No draws are kept yet: Run keeps them",mf={2:"2 / s",10:"10 / s",30:"30\
 / s",1e3:"fastest"},Ls=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.
session.hasDraws)return;this.before=null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.
act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,draws:o,flicker:s,shown:r}=this.session;this.playing=e&&!s.still,e&&s.wantsMean?this.session.act(
{type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.showDraw(s.still&&r?.layer==="draw"?(n+1)%o.count:n>=o.count-1?0:n),this.session.changed()}over(e){
let{flicker:n,view:o}=this.session;n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:o.chain})):o.layer!=="draw"&&this.showLayer(
"draw"):(this.afterMean=!1,this.before&&this.before!==o.layer&&this.showLayer(this.before)),this.before=e?o.layer:null,this.session.changed()}playFromStart(){this.
showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)
return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:o,draws:s}=this.session;
o+1>=s.count&&n.on?this.showDraw(0):o+1>=s.count?this.play(!1):this.showDraw(o+1)},1e3/this.drawsPerSecond)}};function $c(t,e,n,o){let{session:s}=t,r=t.segmented(
"Show",ff,()=>s.view.layer,y=>e.showLayer(y),y=>y==="draw"?s.hasDraws:!s.lacks.includes(y)),[,,i,a]=Array.from(r.children);C(a,"title","Width of each cell's 90 \
% interval"),t.visible(i,()=>!s.quantity.interval),t.visible(a,()=>s.quantity.interval);let l=(y,b)=>t.checkbox(y,()=>n[b],x=>{n[b]=x,s.changed()}),h=l("True wa\
lls","truth");t.visible(h,()=>!s.document||s.document.source.kind==="simulation");let[d,u]=[l("Surfaces","strokes"),l("Trajectory","trajectory")];t.visible(d,()=>!!s.
overlay?.strokes.length),t.each(()=>C(d.lastElementChild,"textContent",bo(o())?"Surfaces":"Surfaces (zoom in)")),t.visible(u,()=>!!s.overlay?.trajectory.length);
let f=v("div",{className:"checks",role:"group","aria-label":"Marks"},h,l("Rays","rays"),l("Readings","readings"),d,u);return t.section("View",r,gf(t,e),f)}function gf(t,e){
let{session:n}=t,o=v("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});o.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(o.value))});let s=t.
button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1,why:Rc}),r=v("output"),i=v("select",{"aria-label":"Chain"});i.addEventListener("\
change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:u,count:f}=n.draws;C(o,"max",String(Math.max(0,f-1))),C(o,"disabled",f===0),C(o,"value",String(
n.draw));let y=f?`${n.draw+1} of ${f}`:"none kept";nt(o,"aria-valuetext",y),o.style.setProperty("--fill",`${f>1?100*n.draw/(f-1):0}%`),C(r,"textContent",y),i.length!==
Math.max(1,u)&&i.replaceChildren(...Array.from({length:Math.max(1,u)},(x,M)=>v("option",{value:String(M),textContent:`chain ${M+1}`}))),C(i,"value",String(n.view.
chain)),C(i,"disabled",u<2),f<2&&e.playing&&e.play(!1);let b=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";s.getAttribute("aria-label")!==
b&&(s.setAttribute("aria-label",b),s.replaceChildren(nn(e.playing?"pause":"play")))});let a=v("select",{"aria-label":"Speed"});for(let[u,f]of Object.entries(mf))
a.append(v("option",{value:u,textContent:f}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(
null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1,why:Rc});t.each(()=>C(a,"disabled",n.draws.count<2||n.flicker.
still));let h=t.checkbox("Draws over the mean",()=>n.flicker.on,u=>e.over(u),"Each draw in its own colour over the mean, as one of the maps that the scans leave\
 possible");t.visible(h,()=>n.draws.count>1);let d=v("div",{className:"wide"},h);return v("div",{className:"player"},s,o,r,v("div",{className:"buttons wide"},i,
a,l),d)}function Fc(t){let{session:e}=t,n=v("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),o=v("output");n.addEventListener("input",()=>e.act({
type:"scan",index:Number(n.value)}));let s=t.section("Scan",v("div",{className:"player bare"},n,o));return t.each(()=>{let r=e.document?.source.kind==="simulati\
on"?0:e.document?.source.scans??0;C(s,"hidden",r<2),C(n,"max",String(Math.max(0,r-1))),gn(n)||C(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",
`${100*Number(n.value)/Math.max(1,r-1)}%`),C(o,"textContent",`${Number(n.value)+1} / ${r}`)}),s}var Ic=2,Oc=6,yf=.5,wf=.005;function Uc(t){let{session:e,hand:n}=t,o=v("p",{className:"whereabouts",role:"status"}),s=v("p",{className:"caption"}),r=t.section("\
Where am I?",o,s);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),C(o,"textContent",bf(t)),C(s,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function bf({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let o=e.p_lost>yf?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",s=!o&&e.p_lost>wf?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${o}${xf(e.modes)}${vf(e,t.editable)}${s}`}function xf(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>Ic,o=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${ri(e.mean[2],0)}`,s=`known to ${ii(e.sigma_m)} and ${ri(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${ii(e.sigma_m)} apart.`:`One place: ${o}, ${s}.`;let r=t.slice(0,Oc).map(({probability:a})=>vr(a)),i=t.length>Oc?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${o}, ${s}.`}function vf({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>Ic)return"";let o=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),s=o.indexOf(Math.min(...o)),r=Math.abs(Math.atan2(Math.sin(t[s].mean[2]-e[2]),Math.cos(t[s].mean[2]-e[2]))),i=t.length===1?"there":s===0?"the l\
ikeliest":`the ${kf(s+1)}`;return` The robot ${n?"stands":"was recorded"} ${ii(o[s])} and ${ri(r,1)} from ${i}.`}var kf=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,ri=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,ii=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function Wc(t,e,n){let{shown:o,status:s}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:o&&{generation:o.generation,layer:t.layer,approximate:o.
approximate,sweeps:o.sweeps,method:o.method,quantity:t.quantity,rhat:o.rhat,verdict:o.verdict,trace:o.trace,traced:o.traced,weights:o.weights,ess:o.ess,chain:o.
chain,draw:o.draw},probability:o?.p??new Uint8Array(0),reached:o?.reached??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{text:s.
text,level:s.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:Mf(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&Sf(t.evidence.each)},over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.
strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??
0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var Sf=t=>Object.fromEntries(Object.entries(t).
map(([e,n])=>[e,Array.from(n)]));function Mf({ghost:t}){let{held:e,pose:n,fan:o,answers:s,trouble:r}=t;return{held:e,pose:n,answers:s,trouble:r,fan:o&&{...o,near:o.
near&&{...o.near}}}}var ai=new Set(["walls","move_sensor","set","view","live"]),Gc=({type:t})=>!ai.has(t),Hc="Not while the connection is lost: this needs the server";function zc(t,e){
let{document:n,walls:o}=t,s=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)o[r*s+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;
Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??
null};else if(e.type==="move_sensor"){let r=n.sensors.find(i=>i.id===e.id);if(r)for(let i of["x","y","yaw"])r[i]=e[i]??r[i]}}var Tf=t=>Kt(`${t.replace(/^(plan|path|explore): /,"")}.`),Ns=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.views,this.askedViews]=[null,""]),this.version++,this.ask(),this.
session.changed())}forget(){this.forgetPath(),this.views=null,this.askedViews=""}forgetPath(){this.start=this.goal=this.path=null,this.askedPath=this.trouble="",
this.version++,this.session.changed()}ask(){let{session:e,start:n,goal:o,radius:s,risk:r}=this,{shown:i}=e;if(!i||i.generation!==e.generation||e.recorded)return;
let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,o,s,r])}`;n&&o&&!i.approximate&&l!==this.askedPath&&(this.askedPath=l,e.act({type:"path",start:[
n.x,n.y],goal:[o.x,o.y],radius:s,risk:r})),this.looking&&(!i.approximate||e.document?.method==="propagate")&&a!==this.askedViews&&(this.askedViews=a,e.act({type:"\
views"}))}receive(e,n){let o=e.type==="undecided"?Tf(e.text):"",s=e.type==="undecided"?e.question:e.type;s==="views"?this.viewTrouble=o:this.trouble=o,e.type===
"path"?this.path=e:e.type==="views"&&this.looking?this.views={pose:n.pose,nats:n.nats,spacing:e.spacing}:s==="path"&&(this.path=null),this.version++}nearest(e){
let{views:n}=this;if(!n?.nats.length)return null;let[o,s]=[0,1/0];for(let r=0;r<n.nats.length;r++){let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<s&&([o,
s]=[r,i])}return o}};var Ds=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=Wt(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:o}=e;
if(!this.held||!n||!o||o.generation!==e.generation||e.recorded)return;let s=`${o.generation} ${e.sampling} ${o.approximate} ${n.x} ${n.y}`;s!==this.asked&&(this.
asked=s,e.act({type:"inspect",x:n.x,y:n.y,each:!0}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.
each=n.nats?n:null,this.version++)}};var Pf="(prefers-reduced-motion: reduce)",Rs=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(Pf).matches}get under(){let{mean:e,
session:n}=this,{shown:o}=n;return this.on&&e&&o?.layer==="draw"&&e.generation===o.generation&&e.p.length===o.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var Ef=2e3,Cf=3e3,Af=2,$s=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:o}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...o,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,o=e&&n.document&&fn(e,n.document.
grid);(!o||!Wt(o,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!this.held||
e.recorded||!n||n.generation!==e.generation)return;!this.pose&&o?.pose.length&&(this.pose={x:o.pose[0],y:o.pose[1],yaw:o.pose[2]});let{pose:s}=this;if(!s)return;
let r=performance.now();if(r-this.askedAt>Ef&&(this.waiting=0),this.waiting>=Af)return;let i=JSON.stringify([s,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Cf;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...s,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:o,low:s,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:h}=n,{x:d,y:u,yaw:f,generation:y,draws:b,coarse:x,milliseconds:M}=e,T=e.near&&{...e.near,pose:a,ranges:l,hit:h};this.fan={x:d,y:u,yaw:f,generation:y,draws:b,
coarse:x,milliseconds:M,angles:o,low:s,median:r,high:i,near:T},this.answers++}else this.fan=null;this.version++,this.ask()}};var Fs=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let o=performance.now();for(let s of this.
waiting)s.seq<=n&&this.eventToPaint_ms.push(o-s.time);this.waiting=this.waiting.filter(s=>s.seq>n);for(let s of this.seqOfGeneration.keys())s<e&&this.seqOfGeneration.
delete(s)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var Os=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Is=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:o}=this,s=o.document&&o.document.source.
kind!=="simulation"&&!o.recorded,r=e&&s&&o.scan?_f(o.scan,e,n,o.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),o.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){e.type==="undecided"?this.trouble=e.text:e.beam===this.picked?.beam&&
e.scan===this.picked.scan&&(this.found=e),this.version++}};function _f({index:t,pose:e,angles:n,ranges:o,hit:s},r,i,a){if(t===null)return null;let l={x:e[0],y:e[1]},
[h,d]=[-1,1/0];for(let u=0;u<n.length;u++){let[f,y]=[Math.cos(e[2]+n[u]),Math.sin(e[2]+n[u])],[b,x]=[r.x-l.x,r.y-l.y],M=b*f+x*y,T=s[u]?o[u]:a,S=s[u]?Math.hypot(
b-T*f,x-T*y):1/0,A=M>0&&M<T?Math.abs(b*y-x*f):1/0,E=Math.min(S,i/2+2*A);E<d&&([h,d]=[u,E])}return d<i?{scan:t,beam:h,from:l,angle:e[2]+n[h]}:null}var Us=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble;let{pose:o,weight:s}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,
cloud:o,weight:s},this.version++}ask(){let{session:e}=this,{shown:n,scan:o}=e;if(!n||e.recorded||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;
let s=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:o?.index} ${s}`,i=performance.now();r===this.asked||this.waitingSince&&
i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var Bc=new Set(["inspect","path","views","where","ghost","beam"]),Ws=class{constructor(e,n,o=null,s=null){this.transport=e;this.changed=n;this.adopt=o;this.notice=
s;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";limits=null;recorded=!1;lacks=[];generation=-1;acted=0;decisions=new Ns(
this);evidence=new Ds(this);where=new Us(this);ghost=new $s(this);reading=new Is(this);flicker=new Rs(this);status=new Ms;progress=new Os;latency=new Fs;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,
text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get running(){
return this.connection.connected&&!!this.state?.running}get working(){return this.connection.connected&&!!this.state?.working}get layer(){let e=this.shown?.layer;
return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entropy":"mean"}get stage(){return this.running&&this.shown?.method==="counts"?this.lastStage:null}get halfway(){
return this.lastStage?.generation===this.shown?.generation}get draws(){return this.state?.draws??{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&
!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(0,this.draws.count-1);return Math.min(e,this.view.draw??(this.shown?.layer==="draw"?this.
shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.document?.method??"")}say(e,n="info"){this.status.say(e,
n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&this.everConnected&&!Bc.has(e.type)&&Gc(e))return this.
say(Hc,"warning");let o={...e,seq:++this.seq};Bc.has(e.type)||(this.acted=this.seq),ai.has(e.type)&&(this.pending.push(o),this.foresee(o)),n&&this.latency.sent(
o.seq,n),this.connection.connected?this.transport.send(o):this.everConnected&&Sr(this.portableDocument()),this.changed()}bring(e){this.act(e?{type:"hello",document:e}:
{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.wallsVersion&&(this.packed={version:this.wallsVersion,text:Io(
Wi(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.effectiveDocument();return e&&(e.source.kind==="simulat\
ion"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.flicker.take(this.shown),!0)}painted(){this.counts.
paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.send({type:"painted",generation:e}),this.reported=
e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.quantity??{kind:"binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){
return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){if(this.connection=e,e.connected){let n=this.everConnected?this.portableDocument():
this.adopt;this.pending=[],this.latency.forget(),this.bring(n),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?
this.say("Connected again"):this.notice&&this.say(this.notice.text,this.notice.level),this.everConnected=!0}else this.everConnected&&(this.say("Connection lost",
"error"),Sr(this.portableDocument()));this.changed()}receive(e,n){switch(e.type){case"welcome":this.generation=this.reported=-1,this.limits=e.limits,this.recorded=
e.recorded,this.lacks=e.lacks,this.latency.forget(),this.next=null;break;case"state":this.receiveState(e);break;case"scan":e.generation>=this.generation&&this.receiveScan(
e,n);break;case"overlay":this.overlay=n;break;case"field":this.receiveField(e,n);break;case"stage":this.lastStage=e;break;case"where":this.where.receive(e,n);break;case"\
cell":this.evidence.receive(e,n);break;case"path":case"views":this.decisions.receive(e,n);break;case"ghost":this.ghost.receive(e,n);break;case"beam":this.reading.
receive(e);break;case"undecided":e.question==="ghost"?this.ghost.receive(e,n):e.question==="beam"?this.reading.receive(e):this.decisions.receive(e,n);break;case"\
status":this.status.say(e.text,e.level,this.acted);break;case"error":this.receiveRefusal(e);break;case"worker":this.worker=e.state,this.status.worker(e.state);break;case"\
download":this.ondownload(e.name,e.mime,n.data),this.status.say(`Saved ${e.name}${e.note&&`, ${e.note}`}`,"info",this.acted);break}this.changed()}receiveScan({ids:e,
index:n},{pose:o,angles:s,ranges:r,exact:i,hit:a}){this.scan?.index!==n&&this.reading.forget(),this.scan={ids:e,index:n,pose:o,angles:s,ranges:r,exact:i,hit:a}}receiveRefusal({
seq:e,text:n,remedy:o}){let s=e!==null&&e===this.broughtAt;s&&(this.broughtAt=null,this.act({type:"hello"}));let r=[n,o].filter(Boolean).join("; ");this.status.
say(s?`The map that was brought along cannot be shown: ${r}`:r,"error",this.acted),this.pending=this.pending.filter(i=>i.seq!==e),e!==null&&this.latency.refused(
e),this.rebuild()}receiveState(e){this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.overlay=null,va()),this.generation=Math.
max(this.generation,e.generation),this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.
generation<this.generation){this.counts.stale++;return}this.generation=e.generation;let o=n.p,{trace:s,traced:r,weights:i}=n,a=this.next??this.shown,l=n.reached,
h=a&&a.p.length===o.length&&a.reached.every((d,u)=>d===l[u])?a.reached:l;this.next={...e,p:o,trace:s,traced:r,weights:i,reached:h},this.progress.hear(this.next)}rebuild(){
if(!this.state)return;let{document:e}=this.state,[n,o]=e.grid.shape,s=this.confirmedWalls;if((e.walls!==s.text||s.walls.length!==n*o)&&(this.confirmedWalls={text:e.
walls,walls:Oo(Wn(e.walls),n*o)}),this.document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==s||this.wallsAhead)&&(this.walls=this.confirmedWalls.
walls.slice(),this.wallsVersion++,this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r,chain:i??
0,draw:a}}for(let r of this.pending)this.foresee(r)}foresee(e){!this.document||!this.state||(zc(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Vc='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var jc=`:host { display: block; height: 100dvh; container-type: size; }
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
`;var qc="bayesmap-theme",Kc={auto:"light",light:"dark",dark:"auto"},Gs=class{constructor(e,n){this.app=e;this.dressed=n;let o=Df();o&&o in Kc&&(this.choice=o),this.
media.addEventListener("change",this.listen)}theme=ts.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?ts.dark:ts.light;this.app.dataset.theme=e?"dark":"light";let{truth:o,ray:s,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:h,ghost:d,belief:u}=n;for(let[f,y]of Object.entries({truth:o,ray:s,miss:r,sensor:i,hatch:a,unobserved:l,draw:h,ghost:d,belief:u}))this.
app.style.setProperty(`--${f}`,y);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=Kc[this.choice];try{localStorage.setItem(qc,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function Df(){try{return localStorage.getItem(qc)}catch{return null}}var Yc=12;function Hs(t,e,{embedded:n=!1,adopt:o=null,notice:s=null,play:r}={}){let i=t.shadowRoot??t.attachShadow({mode:"open"}),a=new CSSStyleSheet;a.replaceSync(
Vc+jc),i.adoptedStyleSheets=[a],t.toggleAttribute("data-embedded",n);let l=0,h=()=>{l||=requestAnimationFrame(ae)},d=new Ws(e,h,o,s);e.open();let u=new zn,f=new Vo(
d),y=new Bo(d,f),b=new Ls(d),x=new _s(d,f,y,xe,K=>b.showLayer(K),n),M=[new Kn,new Yn,new Qn,new Zn,new rs,new ns,new Jn,new jn,new Xn,new qn,new Qo],T=M.map(({name:K})=>v(
"canvas",{className:K})),S=T[T.length-1];Object.assign(S,{tabIndex:0,role:"application"});let A=new Yo(M,T);new Zo(S,d,u,f,y,n);let E=new qo(S,d,u,f,y),R={truth:!0,
rays:!0,readings:!0,strokes:!0,trajectory:!0},_=dc(x),G=Ea(x),B={chip:Tc(x),banner:Pc(x)},Q=v("main",{className:"stage"},...T,B.chip,B.banner),V=()=>ke.theme,N=()=>u.
transform.scale,Y=gc(x,V,N),I=Ec(x);S.setAttribute("aria-describedby",I.readout.id);let q=ac(x),W={help:rc(x),new:ic(x),share:q.dialog},[Z,H,je,ge]=[_c(x),Lc(x),
Nc(x),Dc(x)],ie=[sc(x),Uc(x),hc(x),lc(x),bc(x),xc(x,nc(x,V),oc(x,V)),Fc(x),Ac(x),$c(x,b,R,N),Z,H,Cc(x),je,ge],he=v("aside",{"aria-label":"Controls"},...ie),ee=()=>d.
recorded||d.document?.source.kind==="run";x.visible(Z,()=>d.editable),x.visible(H,()=>!ee()),x.visible(je,()=>!ee()),x.visible(ge,()=>!ee()),x.each(()=>{C(G,"in\
ert",!d.document),C(he,"inert",!d.document)});let z=v("div",{className:"app"},_.element,G,Q,Y,he,I.element,...Object.values(W));i.replaceChildren(z);let ke=new Gs(
z,K=>{_.nameTheme(K),h()}),Ue=()=>{let K=d.editable&&f.tool==="sensor"?f.sensor?.id??null:null;return{session:d,view:u,look:{theme:ke.theme,...R,hover:f.hover,cursor:f.
cursor,selected:K}}},ye="";function ae(){l=0;let K=d.take();d.document&&String(d.shape)!==ye&&(ye=String(d.shape),u.fit(d.shape),f.cursor=f.hover=null,d.decisions.
forget(),d.evidence.forget(),d.ghost.refit(),S.setAttribute("aria-label",`Map, ${d.shape[0]} by ${d.shape[1]} cells`)),A.paint(Ue()),K&&(d.painted(),b.step());let{
x:ne,y:Re}=u.transform;B.chip.style.transform=`translate(${Math.max(ne,Ye.left)}px, ${Math.max(Re-28,6)}px)`,nt(S,"data-tool",d.editable||Ct.has(f.tool)?f.tool:
"pan"),x.refresh()}let st=new ResizeObserver(()=>{let{width:K,height:ne}=Q.getBoundingClientRect();!K||!ne||(u.resize(K,ne,devicePixelRatio||1),u.fitted&&u.fit(
d.shape),cancelAnimationFrame(l),ae())});st.observe(Q);function Ze([K,ne]){let{scale:Re}=u.transform;Re<Yc&&u.zoom(Yc/Re,u.middle,d.shape);let Dt=u.fromGrid({x:K+
.5,y:ne+.5},d.shape[1]);u.pan(u.middle.x-Dt.x,u.middle.y-Dt.y,d.shape),E.focus(),f.setCursor({x:K,y:ne})}async function xe(K){if(K==="in"||K==="out")u.zoom(K===
"in"?1.4:1/1.4,u.middle,d.shape);else if(K==="fit")u.fit(d.shape);else if(K.startsWith("cell "))Ze(K.slice(5).split(",").map(Number));else if(K==="help")W.help.
showModal();else if(K==="new")W.new.showModal();else if(K==="theme")ke.next();else if(K==="add")E.addSensor();else if(K==="share"){let ne=d.portableDocument();ne&&
q.show(location.origin+location.pathname+await zi(ne))}else if(K==="export png"){let ne=await ya(Ue());ne&&wr("bayesmap.png",ne),d.say("Saved bayesmap.png")}else
K.startsWith("export ")&&d.act({type:"export",what:K.slice(7)});h()}d.ondownload=(K,ne,Re)=>wr(K,new Blob([Re],{type:ne}));let St=[[n?t:window,"keydown",K=>{K.defaultPrevented||
!d.document||Object.values(W).some(ne=>ne.open)||sa(K,d,{tool:ne=>{f.choose(ne),E.focus()},layer:ne=>b.showLayer(ne),command:xe})}],[window,"online",()=>e.retry?.()],
[window,"hashchange",async()=>{if(n)return;let{document:K,damaged:ne}=await Go();K?d.bring(K):ne&&d.say(Wo,"error")}],[t,"dragover",K=>K.preventDefault()],[t,"d\
rop",K=>{K.preventDefault();let ne=K.dataTransfer?.files[0];ne&&Ki(ne,d,r)}]];for(let[K,ne,Re]of St)K.addEventListener(ne,Re);return ke.dress(),{destroy(){st.disconnect(),
cancelAnimationFrame(l),ke.destroy();for(let[K,ne,Re]of St)K.removeEventListener(ne,Re);e.close(),i.replaceChildren()},snapshot:()=>Wc(d,u,A),cellToClient(K,ne){
let Re=S.getBoundingClientRect(),Dt=u.fromGrid({x:K+.5,y:ne+.5},d.shape[1]);return{x:Re.left+Dt.x,y:Re.top+Dt.y}}}}var li=250,Rf=8e3;function Jc(t){let e=null,n=li,o=0,s=!1;function r(){clearTimeout(o);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),h=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{h=!0,n=li,i.onstatus({connected:!0})},l.onmessage=({data:d})=>{typeof d==
"string"?i.onmessage(JSON.parse(d),{}):i.onmessage(...Ho(d))},l.onclose=()=>{if(s||e!==l)return;o=window.setTimeout(r,n);let d={connected:!1,retryIn_ms:n};i.onstatus(
d),h||$f(t()).then(u=>u&&e===l&&i.onstatus({...d,refused:u})),n=Math.min(Rf,2*n)}}let i={...Gn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=li,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{s=!0,clearTimeout(o),e?.close()}};return i}async function $f(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function Zc(t){let e=(o,s=[])=>n.onmessage(o,Vi(o,s)),n={...Gn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:o=>t.send(o),close:()=>t.off("m\
sg:custom",e)};return n}var Ff="This is the map that was drawn here when the connection was lost; undo leads back",ci=t=>Object.assign(window,{bayesmap:t}),aw={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let o=Hs(n,Zc(t),{embedded:!0});return ci(o),()=>o.destroy()}};function Qc(t,e){let n=Hs(t,ji(e),{play:Xc(t,()=>n)});ci(n)}var Xc=(t,e)=>n=>{
e().destroy(),Qc(t,n)};async function Of(){let t=document.querySelector("[data-bayesmap]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("bod\
y { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("script[data-recording]");if(n){Qc(t,await zo(n.textContent??""));return}Ta(
new URLSearchParams(location.search).get("token"));let{document:o,damaged:s}=await Go(),r=o?null:ka(),i=Jc(()=>new URL(location.href));Pa(h=>{history.replaceState(
null,"",`${location.pathname}?token=${encodeURIComponent(h)}${location.hash}`),i.retry?.()});let l=Hs(t,i,{adopt:o??r,notice:s?{text:Wo,level:"error"}:r?{text:Ff,
level:"info"}:null,play:Xc(t,()=>l)});ci(l)}Of();export{aw as default,Hs as mount,zo as readRecording,ji as recordedTransport,Jc as webSocketTransport,Zc as widgetTransport};
