// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin.
function Lt(t,e){let n=new Uint8Array(e);for(let s=0;s<e;s++)n[s]=t[s>>3]>>7-(s&7)&1;return n}function Kn(t){let e=new Uint8Array(t.length+7>>3);for(let n=0;n<t.
length;n++)t[n]&&(e[n>>3]|=128>>(n&7));return e}function mt(t){let e=atob(t.replace(/-/g,"+").replace(/_/g,"/"));return Uint8Array.from(e,n=>n.charCodeAt(0))}function xn(t){
let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}async function Sa(t,e){let n=new Blob([t]).stream().pipeThrough(
e);return new Uint8Array(await new Response(n).arrayBuffer())}var Jn=t=>Sa(t,new DecompressionStream("deflate-raw")),Ma=t=>Sa(t,new CompressionStream("deflate-r\
aw"));async function Ta(t){let e=await Ma(new TextEncoder().encode(JSON.stringify(t)));return"#m="+xn(e).replace(/\+/g,"-").replace(/\//g,"_").replace(/=+$/,"")}async function Xp(t){
let e=/^#m=([\w-]+)$/.exec(t);return e&&JSON.parse(new TextDecoder().decode(await Jn(mt(e[1]))))}var _s="The link's map cannot be read: copy the link again, who\
le";async function Cs(){let t=await Xp(location.hash).catch(()=>null),e=!t&&location.hash.startsWith("#m=");return t&&history.replaceState(null,"",location.pathname+
location.search),{document:t,damaged:e}}var Nr={uint8:Uint8Array,uint32:Uint32Array,float32:Float32Array,float64:Float64Array},Aa=8,rn=()=>({onmessage:()=>{},onstatus:()=>{}});function Zs(t){let e=new DataView(
t).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(new Uint8Array(t,4,e))),s={},o=4+e;for(let{name:r,dtype:i,shape:a}of n.buffers??[]){let l=a.reduce((c,h)=>c*
h,1)*Nr[i].BYTES_PER_ELEMENT;s[r]=new Nr[i](t.slice(o,o+l)),o+=Math.ceil(l/Aa)*Aa}return[n,s]}function Ea(t,e){let n={};return(t.buffers??[]).forEach(({name:s,dtype:o},r)=>{
let{buffer:i,byteOffset:a,byteLength:l}=e[r];n[s]=new Nr[o](i.slice(a,a+l))}),n}async function Qs(t){let e=await Jn(mt(t));return Zs(e.buffer)}function Pa([t,e]){let{document:n,ids:s,log_joint:o}=t,{chains:r,count:i,bits:a}=t.draws,l=n.grid.
shape[0]*n.grid.shape[1],c=n.source.kind!=="simulation",h=1,u={chains:r,count:i},d=0,m={layer:"mean",chain:0,draw:null},w=(L,_=L.length===0)=>{let I=L.length/s.
length;return c&&!_?L.slice(d*I,(d+1)*I):L},b=()=>s[d]-1,S=(L=0)=>{let _={generation:h,can_undo:!1,can_redo:!1,live:!1,running:!1,working:!1,scan:b()};E.onmessage(
{type:"state",document:n,seq:L,..._,draws:u,view:m},{})},T=()=>{let{pose:L,angles:_,ranges:I,exact:H,hit:Z}=e,j=_.length<I.length,D={pose:w(L),angles:w(_,j),ranges:w(
I),exact:w(H),hit:w(Z)};E.onmessage({type:"scan",generation:h,ids:c?[s[d]]:s,index:c?b():null},D)},v=L=>{let _=a?Math.ceil(l/8):l,I=e.draws.slice(L*_,(L+1)*_);return a?
Lt(I,l).map(H=>255*H):I},A=()=>{let{p:L,width:_,reached:I,trace:H,traced:Z,weights:j}=e,D=Math.min(i-1,m.draw??i-1),R=m.layer==="draw"&&!i||m.layer==="width"&&!_?
"mean":m.layer,F=R==="draw"?{chain:m.chain,draw:D,log_joint:o[m.chain][D]}:{},Y=R==="draw"?v(m.chain*i+D):R==="width"?_:L;E.onmessage({...t.field,layer:R,...F},
{p:Y,reached:I,trace:H,traced:Z,...j&&{weights:j}})},E={...rn(),open:()=>E.onstatus({connected:!0}),send:L=>{if(L.type==="hello"){let _=[...i?[]:["draw"],...e.width?
[]:["width"]];E.onmessage({type:"welcome",version:1,limits:null,recorded:!0,figure:!1,lacks:_},{}),S(L.seq),T(),e.trajectory&&E.onmessage({type:"overlay",generation:h},
{strokes:e.strokes,trajectory:e.trajectory}),A()}else if(L.type==="view")m={layer:L.layer,chain:L.chain??m.chain,draw:L.draw??null},S(L.seq),A();else if(L.type===
"scan"){let _=s.map(I=>Math.abs(I-1-L.index));d=_.indexOf(Math.min(..._)),S(L.seq),T()}else if(L.type==="inspect"){let{x:_,y:I}=L,H=e.beams[_*n.grid.shape[1]+I];
E.onmessage({type:"cell",x:_,y:I,each:!1,beams:H,beams_for:null,nats_for:null,beams_against:null,nats_against:null},{})}},close:()=>{}};return E}async function Zp(t,e){let n=new TextDecoder,s=t.stream().getReader(),[o,r]=["",0];for(let i=await s.read();!i.done;i=await s.read())o+=n.decode(i.value,{stream:!0}),
e((r+=i.value.length)/t.size);return o}async function _a(t,e,n){let{name:s}=t;if(!/\.(html|json)$/.test(s))return e.say(`${s} is not read in the page: start bay\
esmap app with it`,"warning");try{let o=await Zp(t,i=>e.say(`Reading ${s}: ${Math.round(100*i)} %`)),r=/data-recording>(.*?)<\/script>/s.exec(o)?.[1];r&&n?n(await Qs(
r)):s.endsWith(".json")&&!e.recorded?e.bring(JSON.parse(o)):e.say(`${s} holds nothing that can be shown here`,"warning")}catch{e.say(`${s} cannot be read: expor\
t it again, whole`,"error")}}var se=(t,e,n)=>Math.min(n,Math.max(e,t)),Ht=({x:t,y:e},[n,s])=>t>=0&&e>=0&&t<n&&e<s,Pe=(t,{resolution:e,origin:n})=>({x:(t.x-n[0])/e,y:(t.y-n[1])/e}),Rr=(t,{resolution:e,
origin:n})=>({x:n[0]+t.x*e,y:n[1]+t.y*e});function vn(t,e){let{x:n,y:s}=Pe(t,e);return{x:Math.floor(n),y:Math.floor(s)}}var Xn=(t,e)=>Rr({x:t.x+.5,y:t.y+.5},e);
function Ca(t,e){let n=[],s=Math.max(Math.abs(e.x-t.x),Math.abs(e.y-t.y));for(let o=0;o<=s;o++){let r=s?o/s:0;n.push({x:Math.round(t.x+r*(e.x-t.x)),y:Math.round(
t.y+r*(e.y-t.y))})}return n}function La(t,[e,n]){let s=new Path2D,o=(r,i)=>r>=0&&r<e&&i>=0&&i<n?t[r*n+i]:0;for(let r=0;r<=e;r++)for(let i=0,a=-1;i<=n;i++){let l=i<
n&&o(r-1,i)!==o(r,i);l&&a<0&&(a=i),!l&&a>=0&&(s.moveTo(r,a),s.lineTo(r,i),a=-1)}for(let r=0;r<=n;r++)for(let i=0,a=-1;i<=e;i++){let l=i<e&&o(i,r-1)!==o(i,r);l&&
a<0&&(a=i),!l&&a>=0&&(s.moveTo(a,r),s.lineTo(i,r),a=-1)}return s}var Ls=t=>t<=0||t>=1?0:-(t*Math.log2(t)+(1-t)*Math.log2(1-t));function Da(t,e,n){let s=Ra(t).map(({x:r,y:i})=>r*t.grid.shape[1]+i),o=(r,i)=>-((r-n.x)**2+(i-n.y)**2);return $a(t,(r,i,a)=>e[a]||s.includes(a)?-1/0:o(r,i))}function Na(t,e){
let n=Qp(e,t.grid.shape),s=Ra(t);return $a(t,(o,r,i)=>{if(e[i])return-1/0;let a=2*n[i];for(let l of s)a=Math.min(a,Math.hypot(o-l.x,r-l.y));return a>0?a:-1/0})}
var Ra=({sensors:t,grid:e})=>t.map(n=>vn(n,e));function $a(t,e){let[n,s]=t.grid.shape,o=null,r=-1/0;for(let i=0;i<n;i++)for(let a=0;a<s;a++){let l=e(i,a,i*s+a);
l>r&&([o,r]=[{x:i,y:a},l])}return o&&Xn(o,t.grid)}function Qp(t,[e,n]){let s=new Uint16Array(e*n),o=(r,i)=>r<0||i<0||r>=e||i>=n?0:s[r*n+i];for(let r=0;r<e;r++)for(let i=0;i<
n;i++)s[r*n+i]=t[r*n+i]?0:1+Math.min(o(r-1,i-1),o(r-1,i),o(r-1,i+1),o(r,i-1));for(let r=e-1;r>=0;r--)for(let i=n-1;i>=0;i--){let a=1+Math.min(o(r+1,i+1),o(r+1,i),
o(r+1,i-1),o(r,i+1));s[r*n+i]=Math.min(s[r*n+i],a)}return s}var eo=class{constructor(e,n){this.session=e;this.hand=n}isWall(e){return Ht(e,this.session.shape)&&this.session.walls[e.x*this.session.shape[1]+e.y]===1}setWalls(e,n,s,o){
let{document:r,shape:i}=this.session;if(!r)return;let a=n?r.sensors.map(c=>vn(c,r.grid)):[],l=new Map;for(let c of e)!Ht(c,i)||this.isWall(c)===n||a.some(h=>h.x===
c.x&&h.y===c.y)||l.set(c.x*i[1]+c.y,[c.x,c.y]);l.size&&this.session.act({type:"walls",cells:[...l.values()],wall:n,stroke:s},o)}moveSensor(e,n,s,o){let{x:r,y:i,
yaw:a}={...e,...n};this.refuses({x:r,y:i})||this.session.act({type:"move_sensor",id:e.id,x:r,y:i,yaw:a,drag:s},o)}addSensor(e){let{session:n}=this,{document:s}=n;
if(!s)return;let o=e==="where there is room"?Na(s,n.walls):"world"in e?e.world:Da(s,n.walls,e.near),r=n.limits?.sensors[1]??1/0;o?s.sensors.length>=r?n.say(`The\
re can be ${r} sensors at most.`,"warning"):this.refuses(o)||(n.act({type:"add_sensor",x:o.x,y:o.y,yaw:typeof e=="object"&&"world"in e?e.yaw??0:0}),this.hand.selected=
Math.max(0,...s.sensors.map(i=>i.id))+1):n.say("There is no free cell for a sensor.","warning")}removeSensor(){let{sensor:e}=this.hand;e&&this.session.act({type:"\
remove_sensor",id:e.id})}refuses(e){let{session:n}=this;if(!n.document)return!0;let s=vn(e,n.document.grid),o=this.isWall(s);return!o&&Ht(s,n.shape)?(n.status.text.
startsWith("A sensor cannot")&&n.say("Ready"),!1):(n.say(o?"A sensor cannot stand in a wall.":"A sensor cannot stand outside the map.","warning"),!0)}};var Mt=new Set(["pan","path","look","where","ghost","evidence"]),eu=120,to=class{constructor(e){this.session=e}tool="draw";selected=null;hover=null;cursor=null;busy=!1;announce=()=>{};describe=()=>"";gestures=Math.
floor(Math.random()*2**30);asked=0;nextGesture(){return++this.gestures}get sensor(){let e=this.session.document?.sensors??[];return e.find(n=>n.id===this.selected)??
e[0]??null}choose(e){this.tool=e,this.session.decisions.look(e==="look"),this.session.decisions.showPath(e==="path"||e==="pan"||!Mt.has(e)),this.session.ghost.hold(
e==="ghost"),this.session.evidence.hold(e==="evidence"),this.session.changed()}select(e){this.selected=e,this.session.changed()}point(e){let n=e&&Ht(e,this.session.
shape)?e:null;n?.x===this.hover?.x&&n?.y===this.hover?.y||(this.hover=n,this.ask(n),this.session.changed())}setCursor(e){!e&&!this.cursor||(this.cursor=e,this.ask(
e),this.session.changed())}ask(e){clearTimeout(this.asked),!(!e||this.busy)&&(this.asked=window.setTimeout(()=>{this.session.act({type:"inspect",x:e.x,y:e.y}),this.
cursor&&this.announce(this.describe(e))},eu))}};var Je={left:36,right:12,top:34,bottom:26},tu=60,nu=160,Zn=class{width=0;height=0;ratio=1;transform={scale:1,x:0,y:0};fitted=!0;corner={x:0,y:0};resize(e,n,s){[
this.width,this.height,this.ratio]=[e,n,s]}get middle(){return{x:this.width/2,y:this.height/2}}fit([e,n]){let s={x:this.width-Je.left-Je.right,y:this.height-Je.
top-Je.bottom},o=Math.max(.05,Math.min(s.x/e,s.y/n));o*this.ratio>4&&(o=Math.floor(o*this.ratio)/this.ratio),this.transform.scale=o,this.corner={x:Je.left+(s.x-
o*e)/2,y:Je.top+(s.y-o*n)/2},this.fitted=!0,this.settle([e,n]),this.corner={x:this.transform.x,y:this.transform.y}}zoom(e,n,s){let{scale:o}=this.transform,{x:r,
y:i}=this.corner,a=se(o*e,Math.min(this.width,this.height)/Math.max(...s)/3,nu),l=a/o;this.transform.scale=a,this.corner={x:n.x-l*(n.x-r),y:n.y-l*(n.y-i)},this.
fitted=!1,this.settle(s)}pan(e,n,s){this.corner.x+=e,this.corner.y+=n,this.fitted=!1,this.settle(s)}toGrid(e,n){let{scale:s,x:o,y:r}=this.transform;return{x:(e.
x-o)/s,y:n-(e.y-r)/s}}fromGrid(e,n){let{scale:s,x:o,y:r}=this.transform;return{x:o+e.x*s,y:r+(n-e.y)*s}}settle([e,n]){let{scale:s}=this.transform,o=tu;this.corner.
x=se(this.corner.x,o-e*s,this.width-o),this.corner.y=se(this.corner.y,o-n*s,this.height-o),this.transform.x=Math.round(this.corner.x*this.ratio)/this.ratio,this.
transform.y=Math.round(this.corner.y*this.ratio)/this.ratio}};var no=new Set(["path","look","evidence"]);function so(t,e,n,s){if(e.tool==="path")return t.decisions.point(s);if(e.tool==="evidence"&&t.document){let{x:h,y:u}=Pe(
s,t.document.grid);return t.evidence.pin({x:Math.floor(h),y:Math.floor(u)})}let o=t.decisions.nearest(s),{views:r}=t.decisions;if(o===null||!r)return;let[i,a,l]=r.
pose.subarray(3*o,3*o+3),c=`${r.nats[o].toFixed(1)} nats`;t.editable?n.addSensor({world:{x:i,y:a},yaw:l}):t.say(`A scan from ${i.toFixed(2)}, ${a.toFixed(2)} m \
would tell ${c}`)}var Ua=[["D, E, S","draw, erase, sensor","drawn"],["P, G, L","pan, path, look next","asked"],["W, O, V","where am I, ghost, evidence of beams","asked"],["arrows",
"move the cursor, the sensor, the ghost or the view; with Shift by five cells"],["Space","draw or erase at the cursor; next sensor","drawn"],["Space","at the cu\
rsor: start or goal of a path, where to look from, or the cell to ask about","asked"],["[ and ]","turn the sensor or the ghost","asked"],["A, Delete","add, remo\
ve a sensor","drawn"],["R, Escape","run, cancel","inferred"],["Escape","take a path off the map","asked"],["M, N, H","show the mean, a draw, the entropy or the \
width"],["Ctrl+Z, Ctrl+Y","undo, redo","edited"],["+, −, 0","zoom in, out, whole map"],["?","this help"]],su={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],
ArrowDown:[0,-1]},Fa=Math.PI/12,ro=class{constructor(e,n,s,o,r){this.canvas=e;this.session=n;this.view=s;this.hand=o;this.editor=r;e.addEventListener("keydown",
i=>{delete e.dataset.pointed,this.key(i)}),e.addEventListener("blur",()=>{delete e.dataset.pointed,o.setCursor(null)})}focus(){this.canvas.focus({preventScroll:!0})}key(e){
let{session:n,hand:s,editor:o}=this;if(!n.document||e.ctrlKey||e.metaKey||e.altKey)return;let r=su[e.key],i=e.shiftKey?5:1;if(r)this.arrow(r[0]*i,r[1]*i);else if(e.
key===" ")this.space(e);else if(e.key==="["||e.key==="]"){let a=e.key==="["?Fa:-Fa;s.tool==="ghost"&&n.ghost.pose?n.ghost.move({yaw:n.ghost.pose.yaw+a}):n.editable&&
s.sensor&&o.moveSensor(s.sensor,{yaw:s.sensor.yaw+a},void 0,e)}else if(e.key.toLowerCase()==="a"&&n.editable)this.addSensor();else if((e.key==="Delete"||e.key===
"Backspace")&&n.editable)o.removeSensor();else if(e.key==="Escape"&&s.cursor)s.setCursor(null);else return;e.preventDefault(),e.stopPropagation()}addSensor(){this.
editor.addSensor(this.hand.cursor?{near:this.hand.cursor}:"where there is room")}arrow(e,n){let{session:s,view:o,hand:r}=this,[i,a]=s.shape;if(r.tool==="ghost"&&
s.ghost.pose&&s.document){let{resolution:l}=s.document.grid,{x:c,y:h}=s.ghost.pose;s.ghost.move({x:c+e*l,y:h+n*l})}else if((r.tool==="sensor"||r.tool==="where")&&
r.sensor&&s.document&&s.editable){let{resolution:l}=s.document.grid;r.selected=r.sensor.id,this.editor.moveSensor(r.sensor,{x:r.sensor.x+e*l,y:r.sensor.y+n*l})}else if(r.
tool==="pan"&&s.editable)o.pan(-40*e,40*n,s.shape),s.changed();else{let l=r.cursor??{x:Math.floor(i/2),y:Math.floor(a/2)},c={x:se(l.x+e,0,i-1),y:se(l.y+n,0,a-1)};
r.setCursor(c);let h=o.fromGrid({x:c.x+.5,y:c.y+.5},a),u=(m,w,b)=>m-se(m,w,b),d={x:u(h.x,Je.left+10,o.width-20),y:u(h.y,20,o.height-Je.bottom-10)};(d.x||d.y)&&o.
pan(-d.x,-d.y,s.shape)}}space(e){let{session:n,hand:s,editor:o}=this;if(no.has(s.tool)&&n.document){s.cursor?so(n,s,o,Xn(s.cursor,n.document.grid)):this.arrow(0,
0);return}if(n.editable){if(s.tool==="sensor"||s.tool==="where"){let r=n.document?.sensors??[],i=r.findIndex(a=>a.id===s.sensor?.id);s.select(r[(i+1)%Math.max(1,
r.length)]?.id??null),s.selected!==null&&s.announce(`Sensor ${s.selected}`)}else if(!Mt.has(s.tool)){s.cursor||this.arrow(0,0);let r=s.cursor,i=s.tool==="draw"&&
!o.isWall(r);o.setWalls([r],i,s.nextGesture(),e),s.announce(i?"wall":"free")}}}},oo={d:"draw",e:"erase",s:"sensor",p:"pan",g:"path",l:"look",w:"where",o:"ghost",
v:"evidence"},Ia={m:"mean",n:"draw",h:"entropy"},Oa={"+":"in","=":"in","-":"out",0:"fit","?":"help"};function Wa(t,e,n){let s=t.composedPath()[0],o=s instanceof
HTMLSelectElement||s instanceof HTMLInputElement&&/number|text/.test(s.type),r=t.key.toLowerCase();if((t.ctrlKey||t.metaKey)&&!t.altKey){if(o||r!=="z"&&r!=="y"||
e.recorded)return;t.preventDefault(),e.act({type:r==="y"||t.shiftKey?"redo":"undo"});return}if(!(o||t.altKey)){if(oo[r]&&(Mt.has(oo[r])?e.answers||oo[r]==="pan"&&
e.editable:e.editable))n.tool(oo[r]);else if(Ia[r])n.layer(r==="h"&&e.quantity.interval?"width":Ia[r]);else if(Oa[t.key])n.command(Oa[t.key]);else if(r==="r"&&!e.
recorded)e.act({type:"run"});else if(t.key==="Escape"&&e.decisions.start&&e.decisions.pathShown)e.decisions.forgetPath();else if(t.key==="Escape"&&(e.running||e.
working))e.act({type:"cancel"});else return;t.preventDefault()}}var io=class{paints={};sheets;constructor(e,n){this.sheets=e.map((s,o)=>({layer:s,canvas:n[o],context:n[o].getContext("2d"),before:[]}));for(let{name:s}of e)this.
paints[s]=0}paint(e){let{width:n,height:s,ratio:o,transform:r}=e.view;if(!n||!s)return;let i={width:Math.max(1,Math.ceil(n*o)),height:Math.max(1,Math.ceil(s*o))},
a=[e.look.theme,n,s,o,r.scale,r.x,r.y];for(let l of this.sheets){let{canvas:c,context:h,layer:u}=l,d=u.shows?.(e)??!0,m=[d,...d?[...a,...u.depends(e)]:[]];m.length===
l.before.length&&m.every((w,b)=>Object.is(w,l.before[b]))||(l.before=m,c.style.visibility=d?"":"hidden",d&&((c.width!==i.width||c.height!==i.height)&&(Object.assign(
c,i),c.style.width=`${i.width/o}px`,c.style.height=`${i.height/o}px`),h.setTransform(1,0,0,1,0,0),h.clearRect(0,0,c.width,c.height),h.setTransform(o,0,0,o,0,0),
h.save(),u.paint(h,e),h.restore(),this.paints[u.name]++))}}};function Ne(t,{session:e,view:n}){let[s,o]=e.shape,{scale:r,x:i,y:a}=n.transform;t.beginPath(),t.rect(
i,a,s*r,o*r),t.clip()}function kn(t,{halo:e},n,s){t.lineWidth=4,t.strokeStyle=e,t.stroke(),t.lineWidth=s,t.strokeStyle=n,t.stroke()}var ao='11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';function Kt(t,e,n,s,o,r,i=!1){t.font=ao,t.textAlign=r,t.textBaseline=
"middle",i&&(t.strokeStyle=o.halo,t.lineWidth=3,t.strokeText(e,n,s)),t.fillStyle=o.axis,t.fillText(e,n,s)}var $r=8,Qn=class{constructor(e,n,s,o){this.context=e;
this.theme=n;this.width=s;this.height=o}placed=[];place(e,n,s,o){this.context.font=ao;let r=this.context.measureText(e).width/2+2,i=Math.min(Math.max(n,r),this.
width-r),a=[[i,s-o-9],[i,s+o+9],[n+o+r+4,s],[n-o-r-4,s]],l=([u,d])=>u-r>=0&&u+r<=this.width&&d>=$r&&d<=this.height-$r,c=([u,d])=>this.placed.every(m=>Math.abs(u-
m.x)>=r+m.half||Math.abs(d-m.y)>=2*$r),h=a.find(u=>l(u)&&c(u));return h&&this.placed.push({text:e,x:h[0],y:h[1],half:r}),!!h}write(){for(let{text:e,x:n,y:s}of this.
placed)Kt(this.context,e,n,s,this.theme,"center",!0)}};function Fr({document:t,scan:e}){return t?t.source.kind==="simulation"||!e?t.sensors:Array.from({length:e.pose.length/3},(s,o)=>o).map(s=>({id:s,x:e.pose[3*s],y:e.
pose[3*s+1],yaw:e.pose[3*s+2]})):[]}function an(t,e,n){let s=n.fromGrid(Pe(t,e),e.shape[1]),o=se(n.transform.scale*.42,7,13),r=o*2.6,i={x:s.x+r*Math.cos(t.yaw),
y:s.y-r*Math.sin(t.yaw)};return{point:s,size:o,handle:i}}function Ba(t,{session:e,view:n,look:s}){let o=e.document;if(!o)return;let{theme:r}=s,i=Fr(e);t.lineJoin=
"round";for(let a of i){let l=an(a,o.grid,n),{point:c,size:h}=l;a.id===s.selected&&ou(t,l,s);let[u,d]=[Math.cos(a.yaw),-Math.sin(a.yaw)],m=(w,b)=>[c.x+h*(w*u-b*
d),c.y+h*(w*d+b*u)];t.beginPath(),t.moveTo(...m(1.25,0)),t.lineTo(...m(-.9,.8)),t.lineTo(...m(-.45,0)),t.lineTo(...m(-.9,-.8)),t.closePath(),t.strokeStyle=r.halo,
t.lineWidth=3,t.stroke(),t.fillStyle=r.sensor,t.fill(),i.length>1&&i.length<100&&Kt(t,String(a.id),c.x,c.y+h*2+4,r,"center",!0)}}function ou(t,{point:e,size:n,handle:s},{
theme:o}){t.beginPath(),t.moveTo(e.x,e.y),t.lineTo(s.x,s.y),t.moveTo(s.x+4.5,s.y),t.arc(s.x,s.y,4.5,0,2*Math.PI),t.moveTo(e.x+n*1.7,e.y),t.arc(e.x,e.y,n*1.7,0,2*
Math.PI),kn(t,o,o.sensor,1.5),t.beginPath(),t.arc(s.x,s.y,4,0,2*Math.PI),t.fillStyle=o.halo,t.fill()}function Ga(t,e,n,s,o){let r=l=>Math.hypot(e.x-l.x,e.y-l.y),i=t.pose&&an({id:0,...t.pose},s,o);return i&&r(i.handle)<Math.min(n,r(i.point))?{kind:"ghost",turn:!0,
grip:{x:0,y:0}}:{kind:"ghost",turn:!1,grip:i&&r(i.point)<Math.max(n,i.size)?{x:i.point.x-e.x,y:i.point.y-e.y}:{x:0,y:0}}}function Ha(t,e,n){e.turn?t.pose&&t.move(
{yaw:Math.atan2(n.y-t.pose.y,n.x-t.pose.x)},!0):t.move(n,!0)}var za={touch:24,other:11},ru=5,iu=90,lo=class{constructor(e,n,s,o,r,i){this.canvas=e;this.session=n;this.view=s;this.hand=o;this.editor=r;this.embedded=i;let a=(l,c)=>e.
addEventListener(l,c,{passive:!1});a("pointerdown",l=>this.down(l)),a("pointermove",l=>this.move(l)),a("pointerup",l=>this.up(l)),a("pointercancel",l=>this.up(l)),
a("pointerleave",()=>{o.point(null),this.touched||n.reading.point(null,0)}),a("wheel",l=>this.wheel(l)),a("contextmenu",l=>l.preventDefault())}fingers=new Map;gesture=null;touched=!1;at(e){
let n=this.canvas.getBoundingClientRect();return{x:e.clientX-n.left,y:e.clientY-n.top}}cellAt(e){let n=this.view.toGrid(e,this.session.shape[1]);return{x:Math.floor(
n.x),y:Math.floor(n.y)}}metres(e,{grid:n}){return Rr(this.view.toGrid(e,n.shape[1]),n)}begin(e){this.gesture=e,this.hand.busy=!0}down(e){let{session:n,hand:s}=this,
{document:o}=n;if(!o)return;e.preventDefault(),this.canvas.focus({preventScroll:!0}),this.canvas.dataset.pointed="",s.setCursor(null),this.canvas.setPointerCapture(
e.pointerId);let r=this.at(e);if(this.fingers.set(e.pointerId,r),this.fingers.size===2)return this.begin({kind:"pinch",...this.spread()});if(this.gesture)return;
if(e.button===0&&s.tool==="ghost")return this.begin(Ga(n.ghost,r,this.reach(e),o.grid,this.view)),this.dragGhost(e);if(e.button===0&&no.has(s.tool))return this.
begin({kind:"pick",first:r});let i=s.tool==="where"&&n.editable&&e.button!==1?this.gripAt(r,e,o):null;if(i?.kind==="sensor")return s.select(i.id),this.begin(i);
if(e.button===1||Mt.has(s.tool)||!n.editable)return this.begin({kind:"pan",last:r});let a=this.gripAt(r,e,o);if(a)this.begin(a),a.kind==="sensor"&&s.select(a.id);else if(s.
tool==="sensor")e.shiftKey?this.editor.addSensor({world:this.metres(r,o)}):s.sensor&&(s.selected=s.sensor.id,this.begin({kind:"sensor",id:s.sensor.id,drag:s.nextGesture(),
grip:{x:0,y:0}}),this.dragSensor(e));else{let l=s.tool==="draw"!==(e.button===2||e.shiftKey),c=this.cellAt(r),h=l&&this.editor.isWall(c);this.begin({kind:"strok\
e",id:s.nextGesture(),wall:l,last:c,held:e,onWall:h}),e.pointerType!=="touch"?this.release():setTimeout(()=>this.release(),iu)}}gripAt(e,n,s){let{hand:o,view:r}=this,
i=this.reach(n),a=d=>Math.hypot(e.x-d.x,e.y-d.y),l=o.tool==="sensor"&&o.sensor?an(o.sensor,s.grid,r):null;if(l&&o.sensor&&a(l.handle)<Math.min(i,a(l.point)))return{
kind:"turn",id:o.sensor.id,drag:o.nextGesture()};if(n.button!==0||o.tool==="erase")return null;let c=s.sensors.map(d=>({id:d.id,...an(d,s.grid,r)}));c.sort((d,m)=>a(
d.point)-a(m.point));let h=c.find(({point:d,size:m})=>a(d)<Math.max(i,m));if(!h)return null;let u={x:h.point.x-e.x,y:h.point.y-e.y};return{kind:"sensor",id:h.id,
drag:o.nextGesture(),grip:u}}release(){if(this.gesture?.kind!=="stroke"||!this.gesture.held)return;let e=this.gesture.held;this.gesture.held=null,this.stroke([this.
gesture.last],e)}move(e){let{gesture:n,session:s,view:o,hand:r}=this,i=this.at(e);if(this.fingers.has(e.pointerId)&&this.fingers.set(e.pointerId,i),!n)r.point(this.
cellAt(i)),this.pointAtReading(e);else if(n.kind==="ghost")this.dragGhost(e);else if(n.kind==="stroke"){this.release();let a=[],l=e.getCoalescedEvents?.()??[];for(let c of l.
length?l:[e]){let h=this.cellAt(this.at(c));(h.x!==n.last.x||h.y!==n.last.y)&&(n.onWall=!1),a.push(...Ca(n.last,h)),n.last=h}this.stroke(a,e),r.point(n.last)}else if(n.
kind==="sensor")this.dragSensor(e);else if(n.kind==="turn"){let a=s.document?.sensors.find(c=>c.id===n.id);if(!a||!s.document)return;let l=this.metres(i,s.document);
this.editor.moveSensor(a,{yaw:Math.atan2(l.y-a.y,l.x-a.x)},n.drag,e)}else if(n.kind==="pick")Math.hypot(i.x-n.first.x,i.y-n.first.y)>ru&&this.begin({kind:"pan",
last:i});else if(n.kind==="pan")o.pan(i.x-n.last.x,i.y-n.last.y,s.shape),n.last=i,s.changed();else if(this.fingers.size===2){let{middle:a,spread:l}=this.spread();
o.pan(a.x-n.middle.x,a.y-n.middle.y,s.shape),o.zoom(l/n.spread,a,s.shape),Object.assign(n,{middle:a,spread:l}),s.changed()}}up(e){e.type==="pointerup"&&this.release(),
e.type==="pointerup"&&this.gesture?.kind==="stroke"&&this.gesture.onWall&&this.editor.setWalls([this.gesture.last],!1,this.gesture.id,e),e.type==="pointerup"&&this.
gesture?.kind==="pick"&&this.session.document&&so(this.session,this.hand,this.editor,this.metres(this.gesture.first,this.session.document)),this.fingers.delete(
e.pointerId),this.fingers.size===0&&(this.gesture=null,this.hand.busy=!1,this.session.ghost.rest()),this.touched=e.pointerType==="touch",this.touched&&(this.hand.
point(this.cellAt(this.at(e))),this.pointAtReading(e))}reach({pointerType:e}){return e==="touch"?za.touch:za.other}pointAtReading(e){let{document:n,reading:s,ghost:o}=this.
session;if(!n||o.held)return;let r=n.grid.resolution/this.view.transform.scale;s.point(this.metres(this.at(e),n),this.reach(e)*r)}dragGhost(e){let{gesture:n,session:s}=this;
if(n?.kind!=="ghost"||!s.document)return;this.hand.point(null);let o=this.at(e);Ha(s.ghost,n,this.metres({x:o.x+n.grip.x,y:o.y+n.grip.y},s.document))}spread(){let[
e,n]=[...this.fingers.values()];return{middle:{x:(e.x+n.x)/2,y:(e.y+n.y)/2},spread:Math.max(10,Math.hypot(e.x-n.x,e.y-n.y))}}wheel(e){if(!this.session.document)
return;let n=this.canvas.getRootNode().activeElement===this.canvas;if(this.embedded&&!e.ctrlKey&&!n)return;e.preventDefault();let s=e.deltaMode===1?16:1;e.shiftKey?
this.view.pan(-s*(e.deltaX||e.deltaY),0,this.session.shape):this.view.zoom(Math.exp(-s*e.deltaY*(e.ctrlKey?.01:.0016)),this.at(e),this.session.shape),this.session.
changed()}stroke(e,n){let{session:s,gesture:o}=this;o?.kind==="stroke"&&(this.editor.setWalls(e,o.wall,o.id,n),s.status.level==="error"&&s.say("Ready"))}dragSensor(e){
let{gesture:n,session:s}=this,{document:o}=s;if(n?.kind!=="sensor"||!o)return;this.hand.point(null);let r=o.sensors.find(l=>l.id===n.id),i=this.at(e),a=this.metres(
{x:i.x+n.grip.x,y:i.y+n.grip.y},o);r&&this.editor.moveSensor(r,a,n.drag,e)}};var au=5,co=class{name="cursor";depends({session:e,look:n}){return[n.hover?.x,n.hover?.y,n.cursor?.x,n.cursor?.y,e.shape[1]]}paint(e,{session:n,view:s,look:o}){
let{theme:r}=o;e.beginPath(),e.rect(Je.left,0,s.width,s.height-Je.bottom),e.clip(),o.hover&&Va(e,o.hover,n.shape[1],s,r,r.axis,1.5),o.cursor&&Va(e,o.cursor,n.shape[1],
s,r,r.ray,2.5)}};function Va(t,e,n,s,o,r,i){let{scale:a}=s.transform,l=s.fromGrid({x:e.x,y:e.y+1},n),c=Math.max(a,au),[h,u]=[l.x-(c-a)/2,l.y-(c-a)/2];t.lineWidth=
i+2,t.strokeStyle=o.halo,t.strokeRect(h,u,c,c),t.lineWidth=i,t.strokeStyle=r,t.strokeRect(h,u,c,c)}var lu={paper:[98,0,1],ink:[14,6,-24],unobserved:"#efe7d8",unobservedWall:"#d3c5aa",hatch:"#bfae92",truth:"#d55e00",ray:"#0072b2",noReturn:"#b0679a",sensor:"#00\
9e73",draw:"#e69f00",ghost:"#7b52c9",belief:"#6a3fb5",halo:"#ffffff",lines:"rgba(20,30,60,.07)",frame:"#6b7078",axis:"#565d68",ground:"#f4f5f7"},cu={paper:[17,0,
-5],ink:[95,-2,6],unobserved:"#322d25",unobservedWall:"#5a503f",hatch:"#635843",truth:"#f08c3c",ray:"#56b4e9",noReturn:"#d99abf",sensor:"#2fcf9f",draw:"#ffb92e",
ghost:"#b99cff",belief:"#c3a6ff",halo:"#10141a",lines:"rgba(220,230,255,.07)",frame:"#7d8694",axis:"#a3abb8",ground:"#12151a"},uo={light:lu,dark:cu},ja="00224e0\
02e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";function hu([t,e,n]){let s=(t+16)/116,o=[.95047,1,1.08883],[r,i,
a]=[s+e/500,s,s-n/200].map((l,c)=>(l>.20689655172413793?l**3:.12841854934601665*(l-.13793103448275862))*o[c]);return[3.2404542*r-1.5371385*i-.4985314*a,-.969266*
r+1.8760108*i+.041556*a,.0556434*r-.2040259*i+1.0572252*a].map(l=>{let c=se(l,0,1);return Math.round(255*(c<=.0031308?12.92*c:1.055*c**(1/2.4)-.055))})}var ho=(t,e=1)=>[
0,2,4].map(n=>parseInt(t.slice(e+n,e+n+2),16)),po=(t,e,n)=>t.map((s,o)=>s+n*(e[o]-s)),Ir=(t,e)=>hu(po(t.paper,t.ink,e));function es(t){let e=Math.min(15,Math.floor(
t*16));return po(ho(ja,6*e),ho(ja,6*e+6),t*16-e)}function Ya(t,e){let n=new Uint8ClampedArray(17408).fill(255),[s,o]=[ho(t.unobserved),ho(t.unobservedWall)];for(let r=0;r<
256;r++){let i=e==="entropy"?Ls(r/255):r/255,a=e==="value"?Ir(t,r/255):es(i),l=e==="value"?po(s,o,r/255):a;for(let c=0;c<=16;c++)n.set(po(l,a,c/16),4*(r+256*c))}
return new Uint32Array(n.buffer)}var Or=t=>`linear-gradient(90deg,${[0,.125,.25,.375,.5,.625,.75,.875,1].map(e=>`rgb(${t(e).map(Math.round)})`)})`;function k(t,e={},...n){let s=document.createElement(t);for(let[o,r]of Object.entries(e))o.startsWith("on")?s.addEventListener(o.slice(2),r):o.includes("-")||o===
"role"||o==="for"?s.setAttribute(o,r):s[o]=r;for(let o of n)o!==null&&s.append(o);return s}function C(t,e,n){t[e]!==n&&(t[e]=n)}function st(t,e,n){t.getAttribute(
e)!==n&&t.setAttribute(e,n)}var Sn=t=>t.getRootNode().activeElement===t,me=(t,e,n="")=>t==null||!Number.isFinite(t)?"–":t.toFixed(e)+n;function Ur(t,e){let n=URL.
createObjectURL(e);k("a",{href:n,download:t}).click(),setTimeout(()=>URL.revokeObjectURL(n),1e4)}var pu=9,uu=2.5,ts=class{name="decisions";depends({session:e}){return[e.decisions.version,e.document?.grid.resolution]}shows({session:{decisions:e,document:n}}){
return!!(n&&(e.start&&e.pathShown||e.looking&&e.views))}paint(e,n){let{session:s}=n;if(!s.document)return;let o=new Qn(e,n.look.theme,n.view.width,n.view.height);
e.save(),Ne(e,n),s.decisions.looking&&this.views(e,n,o),s.decisions.pathShown&&this.path(e,n,o),e.restore(),o.write()}views(e,{session:n,view:s,look:o},r){let{views:i}=n.
decisions,a=n.document?.grid;if(!i?.nats.length||!a)return;let l=Math.max(...i.nats),c=se(.38*i.spacing*s.transform.scale/a.resolution,uu,pu),h=i.nats.indexOf(l);
for(let u=0;u<i.nats.length;u++){let d=s.fromGrid(Pe({x:i.pose[3*u],y:i.pose[3*u+1]},a),a.shape[1]);e.beginPath(),e.arc(d.x,d.y,c,0,2*Math.PI),e.fillStyle=`rgb(${es(
se(i.nats[u]/Math.max(l,1e-9),0,1)).map(Math.round)})`,e.fill(),u===h&&(e.lineWidth=2.5,e.strokeStyle=o.theme.truth,e.stroke(),r.place(`${me(l,1)} nats`,d.x,d.y,
c))}}path(e,{session:n,view:s,look:o},r){let{start:i,goal:a,path:l,radius:c}=n.decisions,h=n.document?.grid;if(!h||!i)return;let u=d=>s.fromGrid(Pe(d,h),h.shape[1]);
if(l){e.beginPath();for(let[d,m]of l.path){let w=u({x:d,y:m});e.lineTo(w.x,w.y)}e.lineJoin=e.lineCap="round",e.strokeStyle=l.within_risk?o.theme.sensor:o.theme.
truth,e.globalAlpha=.3,e.lineWidth=2*c*s.transform.scale/h.resolution,e.stroke(),e.globalAlpha=1,e.lineWidth=2,e.stroke()}for(let d of a?[i,a]:[i]){let{x:m,y:w}=u(
d);e.beginPath(),e.arc(m,w,5,0,2*Math.PI),e.fillStyle=d===i?o.theme.sensor:o.theme.truth,e.fill(),e.lineWidth=2,e.strokeStyle=o.theme.halo,e.stroke()}if(l){let d=l.
path.length,[[m,w],[b,S]]=[l.path[d-1>>1],l.path[d>>1]],T=u({x:(m+b)/2,y:(w+S)/2});r.place(`${me(l.length_m,1)} m, free with probability ${me(l.probability,3)}`,
T.x,T.y,4)}else a&&n.decisions.trouble&&r.place("no path",u(a).x,u(a).y,7)}};var du=5,[fu,qa]=[.8,5],mu=6,fo=class{name="evidence";depends({session:e}){return[e.evidence.version,e.document?.grid.resolution,e.document?.grid.origin.join()]}shows({
session:{evidence:e,document:n}}){return!!(e.cellShown&&n)}paint(e,n){let{session:s,view:o,look:r}=n,{cell:i,each:a}=s.evidence,l=s.document?.grid;if(!i||!l)return;
Ne(e,n);let c=(b,S)=>o.fromGrid(Pe({x:b,y:S},l),l.shape[1]),h=b=>[c(a.start[2*b],a.start[2*b+1]),c(a.end[2*b],a.end[2*b+1])],u=a?.nats.length??0;e.lineCap="roun\
d";for(let b=u-1;b>=0;b--){let[S,T]=h(b),v=a.nats[b];e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(T.x,T.y),e.globalAlpha=se(.25+Math.abs(v)/2,0,.9),e.lineWidth=se(qa*
Math.sqrt(Math.abs(v)/mu),fu,qa),e.strokeStyle=v>0?r.theme.ray:r.theme.truth,e.stroke()}e.globalAlpha=1;let{scale:d}=o.transform,m=o.fromGrid({x:i.x,y:i.y+1},l.
shape[1]),w=Math.max(1,4-d/2);e.beginPath(),e.rect(m.x-w,m.y-w,d+2*w,d+2*w),kn(e,r.theme,r.theme.belief,2);for(let b=Math.min(du,u)-1;b>=0;b--){let[S,T]=h(b),v=.35+
.1*b,A={x:S.x+v*(T.x-S.x),y:S.y+v*(T.y-S.y)};Kt(e,Wr(a.nats[b]),A.x,A.y,r.theme,"center",!0)}}},Wr=t=>`${t<0?"−":"+"}${Math.abs(t).toFixed(1)}`;var gu=10,yu=7,wu=(t,e)=>t.layer==="width"?"width":e==="entropy"&&t.layer!=="draw"?"entropy":"value",mo=()=>document.createElement("canvas").getContext("2d"),ns=class{name="\
field";cells=mo();mask=mo();hatch=mo();palettes=new Map;image=new ImageData(1,1);drawn={field:null,reached:null,palette:"",hatch:""};depends({session:e}){return[
e.flicker.under??e.shown,e.view.layer==="entropy",...e.shape]}shows({session:e}){return e.document!==null}paint(e,n){let{session:s,view:o,look:r}=n;if(!s.document)
return;let[i,a]=s.shape,{scale:l,x:c,y:h}=o.transform;Ne(e,n);let u=s.flicker.under??s.shown;if(!u||u.p.length!==i*a){e.fillStyle=r.theme.unobserved,e.fillRect(
c,h,i*l,a*l);return}this.fill(u,i,a,r.theme,wu(u,s.view.layer)),e.imageSmoothingEnabled=!1,e.drawImage(this.cells.canvas,c,h,i*l,a*l),this.fillHatch(n),e.drawImage(
this.hatch.canvas,0,0,this.hatch.canvas.width/o.ratio,this.hatch.canvas.height/o.ratio),l>=gu&&this.lines(e,n)}fill(e,n,s,o,r){let{cells:i,mask:a,drawn:l}=this,
c=`${o.ground} ${r}`;if(l.field===e&&l.palette===c)return;let h=this.palettes.get(c)??Ya(o,r);if(this.palettes.set(c,h),this.image.width!==n||this.image.height!==
s){this.image=new ImageData(n,s);for(let{canvas:d}of[i,a])Object.assign(d,{width:n,height:s});l.reached=null}let u=new Uint32Array(this.image.data.buffer);for(let d=0,
m=0;d<s;d++)for(let w=s-1-d;w<n*s;w+=s)u[m++]=h[e.p[w]+256*(e.reached[w]+8>>4)];if(i.putImageData(this.image,0,0),l.reached!==e.reached){for(let d=0,m=0;d<s;d++)
for(let w=s-1-d;w<n*s;w+=s)u[m++]=255-e.reached[w]<<24;a.putImageData(this.image,0,0),l.hatch=""}Object.assign(l,{field:e,reached:e.reached,palette:c})}fillHatch({
session:e,view:n,look:s}){let{hatch:o,mask:r,drawn:i}=this,{ratio:a,width:l,height:c}=n,{scale:h,x:u,y:d}=n.transform,[m,w]=e.shape,b=[s.theme.ground,h,u,d,l,c,
a].join(" ");if(i.hatch===b)return;i.hatch=b;let S=mo(),T=S.canvas.width=S.canvas.height=Math.round(yu*a);S.strokeStyle=s.theme.hatch,S.lineWidth=a,S.beginPath();
for(let A of[-T,0,T])S.moveTo(A-1,T+1),S.lineTo(A+T+1,-1);S.stroke(),Object.assign(o.canvas,{width:Math.ceil(l*a),height:Math.ceil(c*a)}),o.setTransform(a,0,0,a,
0,0),o.imageSmoothingEnabled=!1,o.drawImage(r.canvas,u,d,m*h,w*h),o.globalCompositeOperation="source-in",o.setTransform(1,0,0,1,0,0);let v=o.createPattern(S.canvas,
"repeat");v.setTransform(new DOMMatrix().translate(Math.round(u*a),Math.round(d*a))),o.fillStyle=v,o.fillRect(0,0,o.canvas.width,o.canvas.height)}lines(e,{session:n,
view:s,look:o}){let[r,i]=n.shape,{scale:a,x:l,y:c}=s.transform;e.beginPath();for(let h=1;h<r;h++)e.moveTo(l+h*a,c),e.lineTo(l+h*a,c+i*a);for(let h=1;h<i;h++)e.moveTo(
l,c+h*a),e.lineTo(l+r*a,c+h*a);e.strokeStyle=o.theme.lines,e.lineWidth=1,e.stroke()}};var bu=[[1.25,0],[-.9,.8],[-.45,0],[-.9,-.8]],ss=class{name="ghost";depends({session:e}){return[e.ghost.version,e.document?.grid.resolution,e.document?.max_range]}shows({
session:{ghost:e,document:n}}){return!!(e.held&&e.pose&&n)}paint(e,n){let{ghost:s}=n.session;if(!(!s.held||!s.pose||!n.session.document)){if(Ne(e,n),s.fan){let o=this.
fan(e,n,s.fan);s.fan.near&&this.near(e,n,s.fan,s.fan.near),e.fillStyle=n.look.theme.ghost,e.fill(o)}this.robot(e,n,s.pose)}}ends({session:e,view:n},s,o,r){let{grid:i,
max_range:a}=e.document;return Array.from(o,(l,c)=>{let h=se(r[c],0,a),u=s.yaw+l,d={x:s.x+h*Math.cos(u),y:s.y+h*Math.sin(u)};return n.fromGrid(Pe(d,i),i.shape[1])})}fan(e,n,s){
let{theme:o}=n.look,[r,i,a]=[s.low,s.median,s.high].map(w=>this.ends(n,s,s.angles,w)),{grid:l}=n.session.document,c=n.view.fromGrid(Pe(s,l),l.shape[1]),h=new Path2D;
h.moveTo(c.x,c.y);for(let{x:w,y:b}of r)h.lineTo(w,b);h.closePath(),e.fillStyle=o.ghost,e.globalAlpha=.1,e.fill(h);let u=new Path2D,d=new Path2D,m=se(n.view.transform.
scale*.12,1.2,3);for(let w=0;w<r.length;w++)u.moveTo(r[w].x,r[w].y),u.lineTo(a[w].x,a[w].y),Number.isFinite(s.median[w])&&d.rect(i[w].x-m,i[w].y-m,2*m,2*m);return e.
strokeStyle=o.ghost,e.lineCap="round",e.lineWidth=se(n.view.transform.scale*.25,2,5),e.globalAlpha=.4,e.stroke(u),e.globalAlpha=1,d}near(e,n,s,{pose:o,ranges:r,
hit:i}){let{theme:a}=n.look,l=se(n.view.transform.scale*.14,1.5,4),c=this.ends(n,{x:o[0],y:o[1],yaw:o[2]},s.angles,r),h=new Path2D;c.forEach(({x:u,y:d},m)=>{i[m]&&
(h.moveTo(u+l,d),h.arc(u,d,l,0,2*Math.PI))}),e.lineWidth=1,e.strokeStyle=a.truth,e.stroke(h)}robot(e,{session:n,view:s,look:o},r){let{grid:i}=n.document,{point:a,
size:l,handle:c}=an({id:0,...r},i,s),[h,u]=[Math.cos(r.yaw),-Math.sin(r.yaw)];e.beginPath(),e.moveTo(a.x,a.y),e.lineTo(c.x,c.y),kn(e,o.theme,o.theme.ghost,1.5),
e.beginPath();for(let[d,m]of bu)e.lineTo(a.x+l*(d*h-m*u),a.y+l*(d*u+m*h));e.closePath(),e.lineJoin="round",kn(e,o.theme,o.theme.ghost,2),e.fillStyle=o.theme.halo,
e.fill(),e.beginPath(),e.arc(c.x,c.y,4.5,0,2*Math.PI),e.fill(),e.stroke()}};var os=class{name="hypothesis";cells=document.createElement("canvas").getContext("2d");drawn={field:null,colour:""};depends({session:e}){return[e.flicker.under&&
e.shown]}shows({session:e}){return!!(e.flicker.under&&e.shown)}paint(e,n){let{session:s,view:o,look:r}=n,i=s.flicker.under&&s.shown;if(!i)return;let[a,l]=s.shape,
{scale:c,x:h,y:u}=o.transform;(this.drawn.field!==i||this.drawn.colour!==r.theme.draw)&&this.fill(i,a,l,r.theme.draw),Ne(e,n),e.imageSmoothingEnabled=!1,e.drawImage(
this.cells.canvas,h,u,a*c,l*c)}fill(e,n,s,o){let[r,i,a]=[1,3,5].map(c=>parseInt(o.slice(c,c+2),16));Object.assign(this.cells.canvas,{width:n,height:s});let l=new ImageData(
n,s);for(let c=0,h=0;c<s;c++)for(let u=s-1-c;u<n*s;u+=s,h+=4)l.data.set([r,i,a,Math.round(e.p[u]*e.reached[u]/255)],h);this.cells.putImageData(l,0,0),this.drawn=
{field:e,colour:o}}};var xu=46,vu=22;function ku(t){let e=10**Math.floor(Math.log10(t));return e*([1,2,5].find(n=>n*e>=t)??10)}function Ka(t,{session:e,view:n,look:s}){if(!e.document)
return;let{theme:o}=s,{width:r,height:i}=n,{origin:a,resolution:l,shape:c}=e.document.grid,{scale:h,x:u,y:d}=n.transform,m=ku(xu/h*l),w=Math.min(d+c[1]*h,i-Je.bottom)+
.5,b=Math.max(u,Je.left)-.5;t.fillStyle=o.ground,u<b&&t.fillRect(0,0,b,i+1),d+c[1]*h>w&&t.fillRect(0,w,r+1,i+1-w);let S=Math.max(0,-Math.floor(Math.log10(m)+1e-9));
t.strokeStyle=o.frame,t.lineWidth=1,t.beginPath();let T=A=>Math.ceil(a[A]/m-1e-9)*m,v=A=>a[A]+c[A]*l+1e-9;for(let A=T(0);A<=v(0);A+=m){let E=u+(A-a[0])/l*h;E<b||
E>r-4||(t.moveTo(E,w),t.lineTo(E,w+4),Kt(t,A.toFixed(S),E,w+12,o,"center"))}for(let A=T(1);A<=v(1);A+=m){let E=d+(c[1]-(A-a[1])/l)*h;E>w||E<4||(t.moveTo(b,E),t.
lineTo(b-4,E),Kt(t,A.toFixed(S),b-7,E,o,"right"))}t.stroke(),Kt(t,"m",b-vu,w+12,o,"right")}var rs=class{name="marks";edges=new Path2D;edgesOf=-1;depends({session:e,look:n}){let s=Fr(e).flatMap(({id:i,x:a,y:l,yaw:c})=>[i,a,l,c]),{grid:o}=e.document??{},
r=Ja(e)&&n.truth&&e.wallsVersion;return[o&&[...o.shape,...o.origin,o.resolution].join(),r,n.selected,...s]}shows({session:e}){return e.document!==null}paint(e,n){
let{session:s,view:o,look:r}=n;if(!s.document)return;let[i,a]=s.shape,{scale:l,x:c,y:h}=o.transform;r.truth&&Ja(s)&&this.truth(e,n),e.strokeStyle=r.theme.frame,
e.lineWidth=1,e.strokeRect(c-.5,h-.5,i*l+1,a*l+1),Ba(e,n),Ka(e,n)}truth(e,n){let{session:s,view:o,look:r}=n,{scale:i,x:a,y:l}=o.transform;this.edgesOf!==s.wallsVersion&&
(this.edges=La(s.walls,s.shape),this.edgesOf=s.wallsVersion),e.save(),Ne(e,n),e.transform(i,0,0,-i,a,l+s.shape[1]*i),e.lineCap="square",e.strokeStyle=r.theme.truth,
e.lineWidth=se(i*.09,1,2.5)/i,e.stroke(this.edges),e.restore()}},Ja=({document:t})=>t?.source.kind==="simulation";var Su=600,Mu=1500,Tu=65536,Br=.3,is=class{name="rays";depends({session:e,look:n}){return[e.scan,e.document?.max_range,n.rays,n.readings,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.scan&&e.document&&(n.rays||n.readings)&&!e.ghost.held&&!e.evidence.cellShown)}paint(e,n){let{session:s,view:o,look:r}=n,{scan:i,document:a}=s;
if(!i||!a)return;Ne(e,n);let{scale:l}=o.transform,c=1/a.grid.resolution,h=a.grid.shape[1],u=i.angles.length,d=i.pose.length/3,m=Math.ceil(u*d/Mu),[w,b,S]=[new Path2D,
new Path2D,new Path2D],T=u*d>Su,v=new Map,A=se(l*.1,1.3,4),E=a.scans_used??1/0,L=(i.index??0)<E?1:Br;for(let _=0;_<d;_++){let[I,H,Z]=i.pose.subarray(3*_,3*_+3),
j=o.fromGrid(Pe({x:I,y:H},a.grid),h);for(let D=0;D<u;D++){let R=i.ranges[_*u+D],F=i.hit[_*u+D]===1,Y=(F?R:a.max_range)*c*l,W=i.angles[D]+Z,K={x:j.x+Y*Math.cos(W),
y:j.y-Y*Math.sin(W)},V=F?w:b;(_*u+D)%m===0&&(V.moveTo(j.x,j.y),V.lineTo(K.x,K.y)),F&&(T?v.set(Math.round(K.x)*Tu+Math.round(K.y),K):(S.moveTo(K.x+A,K.y),S.arc(K.
x,K.y,A,0,2*Math.PI)))}}if(r.rays&&(e.lineWidth=1,e.globalAlpha=L*se(28/Math.sqrt(u*d/m)/5,.07,.45),e.strokeStyle=r.theme.ray,e.stroke(w),e.strokeStyle=r.theme.
noReturn,e.stroke(b),e.globalAlpha=1),r.readings){e.globalAlpha=L,e.fillStyle=r.theme.ray,e.fill(S);let _=1.8*A;for(let{x:I,y:H}of v.values())e.fillRect(I-_/2,H-
_/2,_,_);e.globalAlpha=1}}};var Au=2.5,Ds=t=>t>=Au,as=class{name="overlay";depends({session:e,look:n}){return[e.overlay,n.strokes,n.trajectory,e.document?.grid.resolution,e.document?.scans_used]}shows({
session:e,look:n}){return!!(e.overlay&&e.document&&(n.strokes||n.trajectory))}paint(e,n){let{session:s,look:o}=n,{overlay:r,document:i}=s;!r||!i||(Ne(e,n),o.trajectory&&
this.trajectory(e,n,r.trajectory),o.strokes&&Ds(n.view.transform.scale)&&this.strokes(e,n,r.strokes))}trajectory(e,{session:n,view:s,look:o},r){let i=n.document?.
grid;if(!i)return;let a=r.length/2,l=Math.min(a,n.document?.scans_used??a);e.strokeStyle=o.theme.sensor,e.lineWidth=1,e.lineJoin="round";for(let[c,h,u]of[[0,l,.6],
[Math.max(0,l-1),a,.6*Br]]){e.beginPath();for(let d=c;d<h;d++){let m=s.fromGrid(Pe({x:r[2*d],y:r[2*d+1]},i),i.shape[1]);e.lineTo(m.x,m.y)}e.globalAlpha=u,e.stroke()}
e.globalAlpha=1}strokes(e,{session:n,view:s,look:o},r){let i=n.document?.grid;if(i){e.beginPath();for(let a=0;a<r.length;a+=5){let[l,c,h,u]=r.subarray(a,a+4),[d,
m]=[s.fromGrid(Pe({x:l,y:c},i),i.shape[1]),s.fromGrid(Pe({x:h,y:u},i),i.shape[1])];e.moveTo(d.x,d.y),e.lineTo(m.x,m.y)}e.strokeStyle=o.theme.ray,e.lineCap="roun\
d",e.lineWidth=se(s.transform.scale/5,.8,2.5),e.stroke()}}};var Eu=2.2,go=7,[Pu,_u]=[.03,.75],Cu=2.4477,Xa=9,ls=class{name="where";depends({session:e}){return[e.where.version,e.document?.grid.resolution,e.document?.grid.
origin.join()]}shows({session:e}){return!!(e.where.found&&e.document)}paint(e,n){let{session:s}=n,{found:o}=s.where,r=s.document?.grid;if(!o||!r)return;let i=new Qn(
e,n.look.theme,n.view.width,n.view.height);e.save(),Ne(e,n),this.cloud(e,n,r);for(let a of o.modes)this.place(e,n,r,a,i);e.restore(),i.write()}cloud(e,{session:n,
view:s,look:o},r){let{cloud:i,weight:a}=n.where.found,l=a[a.length-1]||1;e.strokeStyle=e.fillStyle=o.theme.belief,e.lineWidth=1.2;for(let c=0;c<a.length;c++){if(a[c]<
Pu**2*l)continue;let[h,u,d]=i.subarray(3*c,3*c+3),m=s.fromGrid(Pe({x:h,y:u},r),r.shape[1]);e.globalAlpha=_u*Math.sqrt(a[c]/l),e.beginPath(),e.arc(m.x,m.y,Eu,0,2*
Math.PI),e.fill(),e.beginPath(),e.moveTo(m.x,m.y),e.lineTo(m.x+go*Math.cos(d),m.y-go*Math.sin(d)),e.stroke()}e.globalAlpha=1}place(e,{view:n,look:s},o,r,i){let[
a,l,c]=r.mean,h=n.fromGrid(Pe({x:a,y:l},o),o.shape[1]),u=Cu*n.transform.scale/o.resolution,[[d,m],[,w]]=r.covariance,[b,S]=[(d+w)/2,Math.hypot((d-w)/2,m)],[T,v]=[
b+S,b-S].map(E=>Math.max(Xa,u*Math.sqrt(Math.max(E,0))));e.beginPath(),e.ellipse(h.x,h.y,T,v,-Math.atan2(2*m,d-w)/2,0,2*Math.PI);let A=Xa+1;e.moveTo(h.x+A*Math.
cos(c),h.y-A*Math.sin(c)),e.lineTo(h.x+(A+go)*Math.cos(c),h.y-(A+go)*Math.sin(c)),e.strokeStyle=s.theme.halo,e.lineWidth=4,e.stroke(),e.strokeStyle=s.theme.belief,
e.lineWidth=2,e.stroke(),i.place(Gr(r.probability),h.x,h.y,v)}},Gr=t=>t>.995&&t<1?"over 99 %":t<.005?"under 1 %":`${Math.round(100*t)} %`;var Za=900,Ns=2;function Qa({session:t,look:e}){let[n,s]=t.shape,o=new Zn;o.resize(Za,Math.round(se(Za*s/n,300,1800)),Ns),o.fit(t.shape);let r=document.createElement(
"canvas");Object.assign(r,{width:o.width*Ns,height:o.height*Ns});let i=r.getContext("2d");i.scale(Ns,Ns),i.fillStyle=e.theme.ground,i.fillRect(0,0,o.width,o.height);
let a=[new ns,new os,new as,new is,new rs,new ts,new ls,new ss],l={session:t,view:o,look:{...e,hover:null,cursor:null,selected:null}};for(let c of a)(c.shows?.(
l)??!0)&&(i.save(),c.paint(i,l),i.restore());return new Promise(c=>r.toBlob(c))}var yo=class{name="reading";depends({session:e}){return[e.reading.version,e.document?.grid.resolution]}shows({session:{reading:e,document:n,scan:s,ghost:o}}){return!!(!o.
held&&e.picked&&n&&s?.index===e.picked.scan)}paint(e,n){let{session:s,view:o,look:r}=n,{picked:i,found:a}=s.reading,{scan:l,document:c}=s;if(!i||!c||l?.index!==
i.scan)return;Ne(e,n);let{grid:h,max_range:u}=c,d=S=>{let T={x:i.from.x+S*Math.cos(i.angle),y:i.from.y+S*Math.sin(i.angle)};return o.fromGrid(Pe(T,h),h.shape[1])},
m=(S,T,v,A)=>{e.beginPath(),e.moveTo(S.x,S.y),e.lineTo(T.x,T.y),e.lineWidth=v,e.strokeStyle=A,e.stroke()},w=l.hit[i.beam]===1,b=d(w?l.ranges[i.beam]:u);if(m(d(0),
b,3,r.theme.halo),m(d(0),b,1.5,w?r.theme.ray:r.theme.noReturn),e.lineCap="butt",a){let S=(T,v)=>se(T??v,0,u);if(m(d(S(a.low,0)),d(S(a.high,u)),6,r.theme.ghost),
a.median!==null){let T=d(a.median),v={x:7*Math.sin(i.angle),y:7*Math.cos(i.angle)};m({x:T.x-v.x,y:T.y-v.y},{x:T.x+v.x,y:T.y+v.y},2.5,r.theme.ghost)}}w&&(e.beginPath(),
e.arc(b.x,b.y,4.5,0,2*Math.PI),e.fillStyle=r.theme.ray,e.fill(),e.lineWidth=2,e.strokeStyle=r.theme.halo,e.stroke())}};var el="bayesmap-token",Hr="bayesmap-kept",tl="bayesmap-tools";function nl(t){try{return localStorage.getItem(t)}catch{return null}}function wo(t,e){try{e===null?
localStorage.removeItem(t):localStorage.setItem(t,e)}catch{}}function zr(t){t?.source.kind==="simulation"&&location.protocol.startsWith("http")&&wo(Hr,JSON.stringify(
t))}function sl(){wo(Hr,null)}function ol(){let t=nl(Hr);try{return t&&JSON.parse(t)}catch{return null}}var rl=()=>nl(tl)!==null,il=t=>wo(tl,t?"all":null);function al(t){
t&&wo(el,t)}function ll(t){let e=n=>{n.key===el&&n.newValue&&t(n.newValue)};return window.addEventListener("storage",e),()=>window.removeEventListener("storage",
e)}var Vr=[["draw","Draw","draw"],["erase","Erase","erase"],["sensor","Sensor","sensor"],["pan","Pan","pan"],["where","Where am I?","where"],["path","Path","path"],
["evidence","Evidence","evidence"],["look","Look next","look"],["ghost","Ghost","ghost"]],Lu=5;function cl(t){let{hand:e,session:n}=t,s=t.segmented("Tool",Vr,()=>n.
editable||!n.document||Mt.has(e.tool)?e.tool:"pan",i=>e.choose(i),i=>(Mt.has(i)?n.answers:n.editable)||i==="pan");t.visible(s,()=>!n.recorded);let o=rl(),r=t.button(
null,"More tools",()=>{il(o=!o),n.changed()},{text:"More"});return t.visible(r,()=>n.answers),t.each(()=>{let i=Vr.filter(([l])=>Mt.has(l)?!n.figure||l==="pan":
!n.document||n.editable).map(([l])=>l),a=new Set(o?i:i.slice(0,Lu));Vr.forEach(([l],c)=>C(s.children[c],"hidden",!a.has(l)&&!(l===e.tool&&i.includes(l)))),C(r.lastElementChild,
"textContent",o?"Fewer":"More"),st(r,"aria-label",o?"Fewer tools":"More tools"),C(r,"title",o?"Fewer tools":"More tools: paths, evidence, where to look next, th\
e ghost")}),k("div",{className:"bar"},s,r,k("span",{className:"space"}),t.button("minus","Zoom out",()=>t.command("out"),{title:"Zoom out (−)"}),t.button("plu\
s","Zoom in",()=>t.command("in"),{title:"Zoom in (+)"}),t.button("fit","Whole map",()=>t.command("fit"),{title:"Whole map (0)"}))}var Du="uplot",Nu="u-hz",Ru="u-vt",$u="u-title",Fu="u-wrap",Iu="u-under",Ou="u-over",Uu="u-axis",An="u-off",Wu="u-select",Bu="u-cursor-x",Gu="u-cursor-y",Hu="u-\
cursor-pt",zu="u-legend",Vu="u-live",ju="u-inline",Yu="u-series",qu="u-marker",hl="u-label",Ku="u-value",$s="width",Fs="height";var pl="bottom",cs="left",jr="right",ci="#000",ul=ci+"0",Yr="mousemove",dl="mousedown",qr="mouseup",fl="mouseenter",ml="mouseleave",gl="dblclick",Ju="resize",Xu="\
scroll",yl="change",So="dppxchange",hi="--",gs=typeof window<"u",Qr=gs?document:null,ps=gs?window:null,Zu=gs?navigator:null,de,bo;function ei(){let t=devicePixelRatio;
de!=t&&(de=t,bo&&ni(yl,bo,ei),bo=matchMedia(`(min-resolution: ${de-.001}dppx) and (max-resolution: ${de+.001}dppx)`),En(yl,bo,ei),ps.dispatchEvent(new CustomEvent(
So)))}function gt(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function ti(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function Te(t,e,n){
t.style[e]=n+"px"}function Dt(t,e,n,s){let o=Qr.createElement(t);return e!=null&&gt(o,e),n?.insertBefore(o,s),o}function Tt(t,e){return Dt("div",t,e)}var wl=new WeakMap;
function zt(t,e,n,s,o){let r="translate("+e+"px,"+n+"px)",i=wl.get(t);r!=i&&(t.style.transform=r,wl.set(t,r),e<0||n<0||e>s||n>o?gt(t,An):ti(t,An))}var bl=new WeakMap;
function xl(t,e,n){let s=e+n,o=bl.get(t);s!=o&&(bl.set(t,s),t.style.background=e,t.style.borderColor=n)}var vl=new WeakMap;function kl(t,e,n,s){let o=e+""+n,r=vl.
get(t);o!=r&&(vl.set(t,o),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=s?-e/2+"px":0,t.style.marginTop=s?-n/2+"px":0)}var pi={passive:!0},Qu={...pi,
capture:!0};function En(t,e,n,s){e.addEventListener(t,n,s?Qu:pi)}function ni(t,e,n,s){e.removeEventListener(t,n,pi)}gs&&ei();function Nt(t,e,n,s){let o;n=n||0,s=
s||e.length-1;let r=s<=2147483647;for(;s-n>1;)o=r?n+s>>1:yt((n+s)/2),e[o]<t?n=o:s=o;return t-e[n]<=e[s]-t?n:s}function Jl(t){return(n,s,o)=>{let r=-1,i=-1;for(let a=s;a<=
o;a++)if(t(n[a])){r=a;break}for(let a=o;a>=s;a--)if(t(n[a])){i=a;break}return[r,i]}}var Xl=t=>t!=null,Zl=t=>t!=null&&t>0,Ao=Jl(Xl),ed=Jl(Zl);function td(t,e,n,s=0,o=!1){
let r=o?ed:Ao,i=o?Zl:Xl;[e,n]=r(t,e,n);let a=t[e],l=t[e];if(e>-1)if(s==1)a=t[e],l=t[n];else if(s==-1)a=t[n],l=t[e];else for(let c=e;c<=n;c++){let h=t[c];i(h)&&(h<
a?a=h:h>l&&(l=h))}return[a??we,l??-we]}function Eo(t,e,n,s){let o=Tl(t),r=Tl(e);t==e&&(o==-1?(t*=n,e/=n):(t/=n,e*=n));let i=n==10?Jt:Ql,a=o==1?yt:At,l=r==1?At:yt,
c=a(i(Oe(t))),h=l(i(Oe(e))),u=us(n,c),d=us(n,h);return n==10&&(c<0&&(u=be(u,-c)),h<0&&(d=be(d,-h))),s||n==2?(t=u*o,e=d*r):(t=sc(t,u),e=Po(e,d)),[t,e]}function ui(t,e,n,s){
let o=Eo(t,e,n,s);return t==0&&(o[0]=0),e==0&&(o[1]=0),o}var di=.1,Sl={mode:3,pad:di},Os={pad:0,soft:null,mode:0},nd={min:Os,max:Os};function Mo(t,e,n,s){return _o(
n)?Ml(t,e,n):(Os.pad=n,Os.soft=s?0:null,Os.mode=s?3:0,Ml(t,e,nd))}function he(t,e){return t??e}function sd(t,e,n){for(e=he(e,0),n=he(n,t.length-1);e<=n;){if(t[e]!=
null)return!0;e++}return!1}function Ml(t,e,n){let s=n.min,o=n.max,r=he(s.pad,0),i=he(o.pad,0),a=he(s.hard,-we),l=he(o.hard,we),c=he(s.soft,we),h=he(o.soft,-we),
u=he(s.mode,0),d=he(o.mode,0),m=e-t,w=Jt(m),b=ot(Oe(t),Oe(e)),S=Jt(b),T=Oe(S-w);(m<1e-24||T>10)&&(m=0,(t==0||e==0)&&(m=1e-24,u==2&&c!=we&&(r=0),d==2&&h!=-we&&(i=
0)));let v=m||b||1e3,A=Jt(v),E=us(10,yt(A)),L=v*(m==0?t==0?.1:1:r),_=be(sc(t-L,E/10),24),I=t>=c&&(u==1||u==3&&_<=c||u==2&&_>=c)?c:we,H=ot(a,_<I&&t>=I?I:Rt(I,_)),
Z=v*(m==0?e==0?.1:1:i),j=be(Po(e+Z,E/10),24),D=e<=h&&(d==1||d==3&&j>=h||d==2&&j<=h)?h:-we,R=Rt(l,j>D&&e<=D?D:ot(D,j));return H==R&&H==0&&(R=100),[H,R]}var od=new Intl.
NumberFormat(gs?Zu.language:"en-US"),fi=t=>od.format(t),wt=Math,ko=wt.PI,Oe=wt.abs,yt=wt.floor,Ie=wt.round,At=wt.ceil,Rt=wt.min,ot=wt.max,us=wt.pow,Tl=wt.sign,Jt=wt.
log10,Ql=wt.log2,rd=(t,e=1)=>wt.sinh(t)*e,Kr=(t,e=1)=>wt.asinh(t/e),we=1/0;function Al(t){return(Jt((t^t>>31)-(t>>31))|0)+1}function si(t,e,n){return Rt(ot(t,e),
n)}function ec(t){return typeof t=="function"}function ae(t){return ec(t)?t:()=>t}var id=()=>{},tc=t=>t,nc=(t,e)=>e,ad=t=>null,El=t=>!0,Pl=(t,e)=>t==e,ld=/\.\d*?(?=9{6,}|0{6,})/gm,
Pn=t=>{if(rc(t)||cn.has(t))return t;let e=`${t}`,n=e.match(ld);if(n==null)return t;let s=n[0].length-1;if(e.indexOf("e-")!=-1){let[o,r]=e.split("e");return+`${Pn(
o)}e${r}`}return be(t,s)};function Mn(t,e){return Pn(be(Pn(t/e))*e)}function Po(t,e){return Pn(At(Pn(t/e))*e)}function sc(t,e){return Pn(yt(Pn(t/e))*e)}function be(t,e=0){
if(rc(t))return t;let n=10**e,s=t*n*(1+Number.EPSILON);return Ie(s)/n}var cn=new Map;function oc(t){return((""+t).split(".")[1]||"").length}function Ws(t,e,n,s){
let o=[],r=s.map(oc);for(let i=e;i<n;i++){let a=Oe(i),l=be(us(t,i),a);for(let c=0;c<s.length;c++){let h=t==10?+`${s[c]}e${i}`:s[c]*l,u=(i>=0?0:a)+(i>=r[c]?0:r[c]),
d=t==10?h:be(h,u);o.push(d),cn.set(d,u)}}return o}var Us={},mi=[],ds=[null,null],ln=Array.isArray,rc=Number.isInteger,cd=t=>t===void 0;function _l(t){return typeof t==
"string"}function _o(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function hd(t){return t!=null&&typeof t=="object"}var pd=Object.getPrototypeOf(
Uint8Array),ic="__proto__";function fs(t,e=_o){let n;if(ln(t)){let s=t.find(o=>o!=null);if(ln(s)||e(s)){n=Array(t.length);for(let o=0;o<t.length;o++)n[o]=fs(t[o],
e)}else n=t.slice()}else if(t instanceof pd)n=t.slice();else if(e(t)){n={};for(let s in t)s!=ic&&(n[s]=fs(t[s],e))}else n=t;return n}function Re(t){let e=arguments;
for(let n=1;n<e.length;n++){let s=e[n];for(let o in s)o!=ic&&(_o(t[o])?Re(t[o],fs(s[o])):t[o]=fs(s[o]))}return t}var ud=0,dd=1,fd=2;function md(t,e,n){for(let s=0,
o,r=-1;s<e.length;s++){let i=e[s];if(i>r){for(o=i-1;o>=0&&t[o]==null;)t[o--]=null;for(o=i+1;o<n&&t[o]==null;)t[r=o++]=null}}}function gd(t,e){if(bd(t)){let i=t[0].
slice();for(let a=1;a<t.length;a++)i.push(...t[a].slice(1));return xd(i[0])||(i=wd(i)),i}let n=new Set;for(let i=0;i<t.length;i++){let l=t[i][0],c=l.length;for(let h=0;h<
c;h++)n.add(l[h])}let s=[Array.from(n).sort((i,a)=>i-a)],o=s[0].length,r=new Map;for(let i=0;i<o;i++)r.set(s[0][i],i);for(let i=0;i<t.length;i++){let a=t[i],l=a[0];
for(let c=1;c<a.length;c++){let h=a[c],u=Array(o).fill(void 0),d=e?e[i][c]:dd,m=[];for(let w=0;w<h.length;w++){let b=h[w],S=r.get(l[w]);b===null?d!=ud&&(u[S]=b,
d==fd&&m.push(S)):u[S]=b}md(u,m,o),s.push(u)}}return s}var yd=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function wd(t){let e=t[0],n=e.
length,s=Array(n);for(let r=0;r<s.length;r++)s[r]=r;s.sort((r,i)=>e[r]-e[i]);let o=[];for(let r=0;r<t.length;r++){let i=t[r],a=Array(n);for(let l=0;l<n;l++)a[l]=
i[s[l]];o.push(a)}return o}function bd(t){let e=t[0][0],n=e.length;for(let s=1;s<t.length;s++){let o=t[s][0];if(o.length!=n)return!1;if(o!=e){for(let r=0;r<n;r++)
if(o[r]!=e[r])return!1}}return!0}function xd(t,e=100){let n=t.length;if(n<=1)return!0;let s=0,o=n-1;for(;s<=o&&t[s]==null;)s++;for(;o>=s&&t[o]==null;)o--;if(o<=
s)return!0;let r=ot(1,yt((o-s+1)/e));for(let i=t[s],a=s+r;a<=o;a+=r){let l=t[a];if(l!=null){if(l<=i)return!1;i=l}}return!0}var ac=["January","February","March",
"April","May","June","July","August","September","October","November","December"],lc=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function cc(t){
return t.slice(0,3)}var vd=lc.map(cc),kd=ac.map(cc),Sd={MMMM:ac,MMM:kd,WWWW:lc,WWW:vd};function Rs(t){return(t<10?"0":"")+t}function Md(t){return(t<10?"00":t<100?
"0":"")+t}var Td={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>Rs(t.getMonth()+
1),M:t=>t.getMonth()+1,DD:t=>Rs(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>Rs(t.getHours()),H:t=>t.getHours(),
h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>Rs(t.
getMinutes()),m:t=>t.getMinutes(),ss:t=>Rs(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>Md(t.getMilliseconds())};function gi(t,e){e=e||Sd;let n=[],s=/\{([a-z]+)\}|[^{]+/gi,
o;for(;o=s.exec(t);)n.push(o[0][0]=="{"?Td[o[1]]:o[0]);return r=>{let i="";for(let a=0;a<n.length;a++)i+=typeof n[a]=="string"?n[a]:n[a](r,e);return i}}var Ad=new Intl.
DateTimeFormat().resolvedOptions().timeZone;function Ed(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==Ad?n=t:(n=new Date(
t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var hc=t=>t%1==0,To=[1,2,2.5,5],Pd=Ws(10,-32,0,To),pc=Ws(10,0,32,To),_d=pc.filter(
hc),Tn=Pd.concat(pc),yi=`
`,uc="{YYYY}",Cl=yi+uc,dc="{M}/{D}",Is=yi+dc,xo=Is+"/{YY}",fc="{aa}",Cd="{h}:{mm}",hs=Cd+fc,Ll=yi+hs,Dl=":{ss}",fe=null;function mc(t){let e=t*1e3,n=e*60,s=n*60,
o=s*24,r=o*30,i=o*365,l=(t==1?Ws(10,0,3,To).filter(hc):Ws(10,-3,0,To)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,s,s*2,s*3,s*4,s*6,s*8,s*12,o,o*2,o*3,o*
4,o*5,o*6,o*7,o*8,o*9,o*10,o*15,r,r*2,r*3,r*4,r*6,i,i*2,i*5,i*10,i*25,i*50,i*100]),c=[[i,uc,fe,fe,fe,fe,fe,fe,1],[o*28,"{MMM}",Cl,fe,fe,fe,fe,fe,1],[o,dc,Cl,fe,
fe,fe,fe,fe,1],[s,"{h}"+fc,xo,fe,Is,fe,fe,fe,1],[n,hs,xo,fe,Is,fe,fe,fe,1],[e,Dl,xo+" "+hs,fe,Is+" "+hs,fe,Ll,fe,1],[t,Dl+".{fff}",xo+" "+hs,fe,Is+" "+hs,fe,Ll,
fe,1]];function h(u){return(d,m,w,b,S,T)=>{let v=[],A=S>=i,E=S>=r&&S<i,L=u(w),_=be(L*t,3),I=Jr(L.getFullYear(),A?0:L.getMonth(),E||A?1:L.getDate()),H=be(I*t,3);
if(E||A){let Z=E?S/r:0,j=A?S/i:0,D=_==H?_:be(Jr(I.getFullYear()+j,I.getMonth()+Z,1)*t,3),R=new Date(Ie(D/t)),F=R.getFullYear(),Y=R.getMonth();for(let W=0;D<=b;W++){
let K=Jr(F+j*W,Y+Z*W,1),V=K-u(be(K*t,3));D=be((+K+V)*t,3),D<=b&&v.push(D)}}else{let Z=S>=o?o:S,j=yt(w)-yt(_),D=H+j+Po(_-H,Z);v.push(D);let R=u(D),F=R.getHours()+
R.getMinutes()/n+R.getSeconds()/s,Y=S/s,W=d.axes[m]._space,K=T/W;for(;D=be(D+S,t==1?0:3),!(D>b);)if(Y>1){let V=yt(be(F+Y,6))%24,re=u(D).getHours()-V;re>1&&(re=-1),
D-=re*s,F=(F+Y)%24;let ie=v[v.length-1];be((D-ie)/S,3)*K>=.7&&v.push(D)}else v.push(D)}return v}}return[l,c,h]}var[Ld,Dd,Nd]=mc(1),[Rd,$d,Fd]=mc(.001);Ws(2,-53,
53,[1]);function Nl(t,e){return t.map(n=>n.map((s,o)=>o==0||o==8||s==null?s:e(o==1||n[8]==0?s:n[1]+s)))}function Rl(t,e){return(n,s,o,r,i)=>{let a=e.find(w=>i>=
w[0])||e[e.length-1],l,c,h,u,d,m;return s.map(w=>{let b=t(w),S=b.getFullYear(),T=b.getMonth(),v=b.getDate(),A=b.getHours(),E=b.getMinutes(),L=b.getSeconds(),_=S!=
l&&a[2]||T!=c&&a[3]||v!=h&&a[4]||A!=u&&a[5]||E!=d&&a[6]||L!=m&&a[7]||a[1];return l=S,c=T,h=v,u=A,d=E,m=L,_(b)})}}function Id(t,e){let n=gi(e);return(s,o,r,i,a)=>o.
map(l=>n(t(l)))}function Jr(t,e,n){return new Date(t,e,n)}function $l(t,e){return e(t)}var Od="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Fl(t,e){return(n,s,o,r)=>r==
null?hi:e(t(s))}function Ud(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function Wd(t,e){return t.series[e].fill(
t,e)}var Bd={show:!0,live:!0,isolate:!1,mount:id,markers:{show:!0,width:2,stroke:Ud,fill:Wd,dash:"solid"},idx:null,idxs:null,values:[]};function Gd(t,e){let n=t.
cursor.points,s=Tt(),o=n.size(t,e);Te(s,$s,o),Te(s,Fs,o);let r=o/-2;Te(s,"marginLeft",r),Te(s,"marginTop",r);let i=n.width(t,e,o);return i&&Te(s,"borderWidth",i),
s}function Hd(t,e){let n=t.series[e].points;return n._fill||n._stroke}function zd(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Vd(t,e){return t.
series[e].points.size}var Xr=[0,0];function jd(t,e,n){return Xr[0]=e,Xr[1]=n,Xr}function vo(t,e,n,s=!0){return o=>{o.button==0&&(!s||o.target==e)&&n(o)}}function Zr(t,e,n,s=!0){
return o=>{(!s||o.target==e)&&n(o)}}var Yd={show:!0,x:!0,y:!0,lock:!1,move:jd,points:{one:!1,show:Gd,size:Vd,width:0,stroke:zd,fill:Hd},bind:{mousedown:vo,mouseup:vo,
click:vo,dblclick:vo,mousemove:Zr,mouseleave:Zr,mouseenter:Zr},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},
_x:!1,_y:!1},focus:{dist:(t,e,n,s,o)=>s-o,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},gc={
show:!0,stroke:"rgba(0,0,0,0.07)",width:2},wi=Re({},gc,{filter:nc}),yc=Re({},wi,{size:10}),wc=Re({},gc,{show:!1}),bi='12px system-ui, -apple-system, "Segoe UI",\
 Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',bc="bold "+bi,xc=1.5,Il={
show:!0,scale:"x",stroke:ci,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:bc,side:2,grid:wi,ticks:yc,border:wc,font:bi,lineGap:xc,rotate:0},
qd="Value",Kd="Time",Ol={show:!0,scale:"x",auto:!1,sorted:1,min:we,max:-we,idxs:[]};function Jd(t,e,n,s,o){return e.map(r=>r==null?"":fi(r))}function Xd(t,e,n,s,o,r,i){
let a=[],l=cn.get(o)||0;n=i?n:be(Po(n,o),l);for(let c=n;c<=s;c=be(c+o,l))a.push(Object.is(c,-0)?0:c);return a}function oi(t,e,n,s,o,r,i){let a=[],l=t.scales[t.axes[e].
scale].log,c=l==10?Jt:Ql,h=yt(c(n));o=us(l,h),l==10&&(o=Tn[Nt(o,Tn)]);let u=n,d=o*l;l==10&&(d=Tn[Nt(d,Tn)]);do a.push(u),u=u+o,l==10&&!cn.has(u)&&(u=be(u,cn.get(
o))),u>=d&&(o=u,d=o*l,l==10&&(d=Tn[Nt(d,Tn)]));while(u<=s);return a}function Zd(t,e,n,s,o,r,i){let l=t.scales[t.axes[e].scale].asinh,c=s>l?oi(t,e,ot(l,n),s,o):[
l],h=s>=0&&n<=0?[0]:[];return(n<-l?oi(t,e,ot(l,-s),-n,o):[l]).reverse().map(d=>-d).concat(h,c)}var vc=/./,Qd=/[12357]/,ef=/[125]/,Ul=/1/,ri=(t,e,n,s)=>t.map((o,r)=>e==
4&&o==0||r%s==0&&n.test(o.toExponential()[o<0?1:0])?o:null);function tf(t,e,n,s,o){let r=t.axes[n],i=r.scale,a=t.scales[i],l=t.valToPos,c=r._space,h=l(10,i),u=l(
9,i)-h>=c?vc:l(7,i)-h>=c?Qd:l(5,i)-h>=c?ef:Ul;if(u==Ul){let d=Oe(l(1,i)-h);if(d<c)return ri(e.slice().reverse(),a.distr,u,At(c/d)).reverse()}return ri(e,a.distr,
u,1)}function nf(t,e,n,s,o){let r=t.axes[n],i=r.scale,a=r._space,l=t.valToPos,c=Oe(l(1,i)-l(2,i));return c<a?ri(e.slice().reverse(),3,vc,At(a/c)).reverse():e}function sf(t,e,n,s){
return s==null?hi:e==null?"":fi(e)}var Wl={show:!0,scale:"y",stroke:ci,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:bc,side:3,grid:wi,ticks:yc,
border:wc,font:bi,lineGap:xc,rotate:0};function of(t,e){let n=3+(t||1)*2;return be(n*e,3)}function rf(t,e){let{scale:n,idxs:s}=t.series[0],o=t._data[0],r=t.valToPos(
o[s[0]],n,!0),i=t.valToPos(o[s[1]],n,!0),a=Oe(i-r),l=t.series[e],c=a/(l.points.space*de);return s[1]-s[0]<=c}var Bl={scale:null,auto:!0,sorted:0,min:we,max:-we},
kc=(t,e,n,s,o)=>o,Gl={show:!0,auto:!0,sorted:0,gaps:kc,alpha:1,facets:[Re({},Bl,{scale:"x"}),Re({},Bl,{scale:"y"})]},Hl={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,
gaps:kc,alpha:1,points:{show:rf,filter:null},values:null,min:we,max:-we,idxs:[],path:null,clip:null};function af(t,e,n,s,o){return n/10}var Sc={time:!0,auto:!0,
distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},lf=Re({},Sc,{time:!1,ori:1}),zl={};function Mc(t,e){let n=zl[t];return n||(n={key:t,plots:[],sub(s){n.plots.
push(s)},unsub(s){n.plots=n.plots.filter(o=>o!=s)},pub(s,o,r,i,a,l,c){for(let h=0;h<n.plots.length;h++)n.plots[h]!=o&&n.plots[h].pub(s,o,r,i,a,l,c)}},t!=null&&(zl[t]=
n)),n}var ms=1,ii=2;function _n(t,e,n){let s=t.mode,o=t.series[e],r=s==2?t._data[e]:t._data,i=t.scales,a=t.bbox,l=r[0],c=s==2?r[1]:r[e],h=s==2?i[o.facets[0].scale]:
i[t.series[0].scale],u=s==2?i[o.facets[1].scale]:i[o.scale],d=a.left,m=a.top,w=a.width,b=a.height,S=t.valToPosH,T=t.valToPosV;return h.ori==0?n(o,l,c,h,u,S,T,d,
m,w,b,Lo,ys,No,Ac,Pc):n(o,l,c,h,u,T,S,m,d,b,w,Do,ws,ki,Ec,_c)}function xi(t,e){let n=0,s=0,o=he(t.bands,mi);for(let r=0;r<o.length;r++){let i=o[r];i.series[0]==
e?n=i.dir:i.series[1]==e&&(i.dir==1?s|=1:s|=2)}return[n,s==1?-1:s==2?1:s==3?2:0]}function cf(t,e,n,s,o){let r=t.mode,i=t.series[e],a=r==2?i.facets[1].scale:i.scale,
l=t.scales[a];return o==-1?l.min:o==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Xt(t,e,n,s,o,r){return _n(t,e,(i,a,l,c,h,u,d,m,w,b,S)=>{let T=i.pxRound,v=c.
dir*(c.ori==0?1:-1),A=c.ori==0?ys:ws,E,L;v==1?(E=n,L=s):(E=s,L=n);let _=T(u(a[E],c,b,m)),I=T(d(l[E],h,S,w)),H=T(u(a[L],c,b,m)),Z=T(d(r==1?h.max:h.min,h,S,w)),j=new Path2D(
o);return A(j,H,Z),A(j,_,Z),A(j,_,I),j})}function Co(t,e,n,s,o,r){let i=null;if(t.length>0){i=new Path2D;let a=e==0?No:ki,l=n;for(let u=0;u<t.length;u++){let d=t[u];
if(d[1]>d[0]){let m=d[0]-l;m>0&&a(i,l,s,m,s+r),l=d[1]}}let c=n+o-l,h=10;c>0&&a(i,l,s-h/2,c,s+r+h)}return i}function hf(t,e,n){let s=t[t.length-1];s&&s[0]==e?s[1]=
n:t.push([e,n])}function vi(t,e,n,s,o,r,i){let a=[],l=t.length;for(let c=o==1?n:s;c>=n&&c<=s;c+=o)if(e[c]===null){let u=c,d=c;if(o==1)for(;++c<=s&&e[c]===null;)
d=c;else for(;--c>=n&&e[c]===null;)d=c;let m=r(t[u]),w=d==u?m:r(t[d]),b=u-o;m=i<=0&&b>=0&&b<l?r(t[b]):m;let T=d+o;w=i>=0&&T>=0&&T<l?r(t[T]):w,w>=m&&a.push([m,w])}
return a}function Vl(t){return t==0?tc:t==1?Ie:e=>Mn(e,t)}function Tc(t){let e=t==0?Lo:Do,n=t==0?(o,r,i,a,l,c)=>{o.arcTo(r,i,a,l,c)}:(o,r,i,a,l,c)=>{o.arcTo(i,r,
l,a,c)},s=t==0?(o,r,i,a,l)=>{o.rect(r,i,a,l)}:(o,r,i,a,l)=>{o.rect(i,r,l,a)};return(o,r,i,a,l,c=0,h=0)=>{c==0&&h==0?s(o,r,i,a,l):(c=Rt(c,a/2,l/2),h=Rt(h,a/2,l/2),
e(o,r+c,i),n(o,r+a,i,r+a,i+l,c),n(o,r+a,i+l,r,i+l,h),n(o,r,i+l,r,i,h),n(o,r,i,r+a,i,c),o.closePath())}}var Lo=(t,e,n)=>{t.moveTo(e,n)},Do=(t,e,n)=>{t.moveTo(n,e)},
ys=(t,e,n)=>{t.lineTo(e,n)},ws=(t,e,n)=>{t.lineTo(n,e)},No=Tc(0),ki=Tc(1),Ac=(t,e,n,s,o,r)=>{t.arc(e,n,s,o,r)},Ec=(t,e,n,s,o,r)=>{t.arc(n,e,s,o,r)},Pc=(t,e,n,s,o,r,i)=>{
t.bezierCurveTo(e,n,s,o,r,i)},_c=(t,e,n,s,o,r,i)=>{t.bezierCurveTo(n,e,o,s,i,r)};function Cc(t){return(e,n,s,o,r)=>_n(e,n,(i,a,l,c,h,u,d,m,w,b,S)=>{let{pxRound:T,
points:v}=i,A,E;c.ori==0?(A=Lo,E=Ac):(A=Do,E=Ec);let L=be(v.width*de,3),_=(v.size-v.width)/2*de,I=be(_*2,3),H=new Path2D,Z=new Path2D,{left:j,top:D,width:R,height:F}=e.
bbox;No(Z,j-I,D-I,R+I*2,F+I*2);let Y=W=>{if(l[W]!=null){let K=T(u(a[W],c,b,m)),V=T(d(l[W],h,S,w));A(H,K+_,V),E(H,K,V,_,0,ko*2)}};if(r)r.forEach(Y);else for(let W=s;W<=
o;W++)Y(W);return{stroke:L>0?H:null,fill:H,clip:Z,flags:ms|ii}})}function Lc(t){return(e,n,s,o,r,i)=>{s!=o&&(r!=s&&i!=s&&t(e,n,s),r!=o&&i!=o&&t(e,n,o),t(e,n,i))}}
var pf=Lc(ys),uf=Lc(ws);function Dc(t){let e=he(t?.alignGaps,0);return(n,s,o,r)=>_n(n,s,(i,a,l,c,h,u,d,m,w,b,S)=>{[o,r]=Ao(l,o,r);let T=i.pxRound,v=F=>T(u(F,c,b,
m)),A=F=>T(d(F,h,S,w)),E,L;c.ori==0?(E=ys,L=pf):(E=ws,L=uf);let _=c.dir*(c.ori==0?1:-1),I={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ms},H=I.
stroke,Z=!1;if(r-o>=b*4){let F=B=>n.posToVal(B,c.key,!0),Y=null,W=null,K,V,$e,pe=v(a[_==1?o:r]),re=v(a[o]),ie=v(a[r]),Q=F(_==1?re+1:ie-1);for(let B=_==1?o:r;B>=
o&&B<=r;B+=_){let Ae=a[B],ye=(_==1?Ae<Q:Ae>Q)?pe:v(Ae),le=l[B];ye==pe?le!=null?(V=le,Y==null?(E(H,ye,A(V)),K=Y=W=V):V<Y?Y=V:V>W&&(W=V)):le===null&&(Z=!0):(Y!=null&&
L(H,pe,A(Y),A(W),A(K),A(V)),le!=null?(V=le,E(H,ye,A(V)),Y=W=K=V):(Y=W=null,le===null&&(Z=!0)),pe=ye,Q=F(pe+_))}Y!=null&&Y!=W&&$e!=pe&&L(H,pe,A(Y),A(W),A(K),A(V))}else
for(let F=_==1?o:r;F>=o&&F<=r;F+=_){let Y=l[F];Y===null?Z=!0:Y!=null&&E(H,v(a[F]),A(Y))}let[D,R]=xi(n,s);if(i.fill!=null||D!=0){let F=I.fill=new Path2D(H),Y=i.fillTo(
n,s,i.min,i.max,D),W=A(Y),K=v(a[o]),V=v(a[r]);_==-1&&([V,K]=[K,V]),E(F,V,W),E(F,K,W)}if(!i.spanGaps){let F=[];Z&&F.push(...vi(a,l,o,r,_,v,e)),I.gaps=F=i.gaps(n,
s,o,r,F),I.clip=Co(F,c.ori,m,w,b,S)}return R!=0&&(I.band=R==2?[Xt(n,s,o,r,H,-1),Xt(n,s,o,r,H,1)]:Xt(n,s,o,r,H,R)),I})}function df(t){let e=he(t.align,1),n=he(t.
ascDesc,!1),s=he(t.alignGaps,0),o=he(t.extend,!1);return(r,i,a,l)=>_n(r,i,(c,h,u,d,m,w,b,S,T,v,A)=>{[a,l]=Ao(u,a,l);let E=c.pxRound,{left:L,width:_}=r.bbox,I=re=>E(
w(re,d,v,S)),H=re=>E(b(re,m,A,T)),Z=d.ori==0?ys:ws,j={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ms},D=j.stroke,R=d.dir*(d.ori==0?1:-1),F=H(
u[R==1?a:l]),Y=I(h[R==1?a:l]),W=Y,K=Y;o&&e==-1&&(K=L,Z(D,K,F)),Z(D,Y,F);for(let re=R==1?a:l;re>=a&&re<=l;re+=R){let ie=u[re];if(ie==null)continue;let Q=I(h[re]),
B=H(ie);e==1?Z(D,Q,F):Z(D,W,B),Z(D,Q,B),F=B,W=Q}let V=W;o&&e==1&&(V=L+_,Z(D,V,F));let[$e,pe]=xi(r,i);if(c.fill!=null||$e!=0){let re=j.fill=new Path2D(D),ie=c.fillTo(
r,i,c.min,c.max,$e),Q=H(ie);Z(re,V,Q),Z(re,K,Q)}if(!c.spanGaps){let re=[];re.push(...vi(h,u,a,l,R,I,s));let ie=c.width*de/2,Q=n||e==1?ie:-ie,B=n||e==-1?-ie:ie;re.
forEach(Ae=>{Ae[0]+=Q,Ae[1]+=B}),j.gaps=re=c.gaps(r,i,a,l,re),j.clip=Co(re,d.ori,S,T,v,A)}return pe!=0&&(j.band=pe==2?[Xt(r,i,a,l,D,-1),Xt(r,i,a,l,D,1)]:Xt(r,i,
a,l,D,pe)),j})}function jl(t,e,n,s,o,r,i=we){if(t.length>1){let a=null;for(let l=0,c=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let h=Oe(t[l]-t[a]);h<c&&(c=
h,i=Oe(n(t[l],s,o,r)-n(t[a],s,o,r)))}a=l}}return i}function ff(t){t=t||Us;let e=he(t.size,[.6,we,1]),n=t.align||0,s=t.gap||0,o=t.radius;o=o==null?[0,0]:typeof o==
"number"?[o,0]:o;let r=ae(o),i=1-e[0],a=he(e[1],we),l=he(e[2],1),c=he(t.disp,Us),h=he(t.each,m=>{}),{fill:u,stroke:d}=c;return(m,w,b,S)=>_n(m,w,(T,v,A,E,L,_,I,H,Z,j,D)=>{
let R=T.pxRound,F=n,Y=s*de,W=a*de,K=l*de,V,$e;E.ori==0?[V,$e]=r(m,w):[$e,V]=r(m,w);let pe=E.dir*(E.ori==0?1:-1),re=E.ori==0?No:ki,ie=E.ori==0?h:(G,xe,Fe,Nn,un,It,dn)=>{
h(G,xe,Fe,un,Nn,dn,It)},Q=he(m.bands,mi).find(G=>G.series[0]==w),B=Q!=null?Q.dir:0,Ae=T.fillTo(m,w,T.min,T.max,B),_e=R(I(Ae,L,D,Z)),ye,le,rt,Xe=j,ve=R(T.width*de),
lt=!1,Ft=null,ct=null,Vt=null,jt=null;u!=null&&(ve==0||d!=null)&&(lt=!0,Ft=u.values(m,w,b,S),ct=new Map,new Set(Ft).forEach(G=>{G!=null&&ct.set(G,new Path2D)}),
ve>0&&(Vt=d.values(m,w,b,S),jt=new Map,new Set(Vt).forEach(G=>{G!=null&&jt.set(G,new Path2D)})));let{x0:J,size:ne}=c;if(J!=null&&ne!=null){F=1,v=J.values(m,w,b,
S),J.unit==2&&(v=v.map(Fe=>m.posToVal(H+Fe*j,E.key,!0)));let G=ne.values(m,w,b,S);ne.unit==2?le=G[0]*j:le=_(G[0],E,j,H)-_(0,E,j,H),Xe=jl(v,A,_,E,j,H,Xe),rt=Xe-le+
Y}else Xe=jl(v,A,_,E,j,H,Xe),rt=Xe*i+Y,le=Xe-rt;rt<1&&(rt=0),ve>=le/2&&(ve=0),rt<5&&(R=tc);let Be=rt>0,ht=Xe-rt-(Be?ve:0);le=R(si(ht,K,W)),ye=(F==0?le/2:F==pe?0:
le)-F*pe*((F==0?Y/2:0)+(Be?ve/2:0));let Qe={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Dn=lt?null:new Path2D,Yt=null;if(Q!=null)Yt=m.data[Q.series[1]];else{
let{y0:G,y1:xe}=c;G!=null&&xe!=null&&(A=xe.values(m,w,b,S),Yt=G.values(m,w,b,S))}let pn=V*le,te=$e*le;for(let G=pe==1?b:S;G>=b&&G<=S;G+=pe){let xe=A[G];if(xe==null)
continue;if(Yt!=null){let it=Yt[G]??0;if(xe-it==0)continue;_e=I(it,L,D,Z)}let Fe=E.distr!=2||c!=null?v[G]:G,Nn=_(Fe,E,j,H),un=I(he(xe,Ae),L,D,Z),It=R(Nn-ye),dn=R(
ot(un,_e)),pt=R(Rt(un,_e)),bt=dn-pt;if(xe!=null){let it=xe<0?te:pn,Et=xe<0?pn:te;lt?(ve>0&&Vt[G]!=null&&re(jt.get(Vt[G]),It,pt+yt(ve/2),le,ot(0,bt-ve),it,Et),Ft[G]!=
null&&re(ct.get(Ft[G]),It,pt+yt(ve/2),le,ot(0,bt-ve),it,Et)):re(Dn,It,pt+yt(ve/2),le,ot(0,bt-ve),it,Et),ie(m,w,G,It-ve/2,pt,le+ve,bt)}}return ve>0?Qe.stroke=lt?
jt:Dn:lt||(Qe._fill=T.width==0?T._fill:T._stroke??T._fill,Qe.width=0),Qe.fill=lt?ct:Dn,Qe})}function mf(t,e){let n=he(e?.alignGaps,0);return(s,o,r,i)=>_n(s,o,(a,l,c,h,u,d,m,w,b,S,T)=>{
[r,i]=Ao(c,r,i);let v=a.pxRound,A=V=>v(d(V,h,S,w)),E=V=>v(m(V,u,T,b)),L,_,I;h.ori==0?(L=Lo,I=ys,_=Pc):(L=Do,I=ws,_=_c);let H=h.dir*(h.ori==0?1:-1),Z=A(l[H==1?r:
i]),j=Z,D=[],R=[];for(let V=H==1?r:i;V>=r&&V<=i;V+=H)if(c[V]!=null){let pe=l[V],re=A(pe);D.push(j=re),R.push(E(c[V]))}let F={stroke:t(D,R,L,I,_,v),fill:null,clip:null,
band:null,gaps:null,flags:ms},Y=F.stroke,[W,K]=xi(s,o);if(a.fill!=null||W!=0){let V=F.fill=new Path2D(Y),$e=a.fillTo(s,o,a.min,a.max,W),pe=E($e);I(V,j,pe),I(V,Z,
pe)}if(!a.spanGaps){let V=[];V.push(...vi(l,c,r,i,H,A,n)),F.gaps=V=a.gaps(s,o,r,i,V),F.clip=Co(V,h.ori,w,b,S,T)}return K!=0&&(F.band=K==2?[Xt(s,o,r,i,Y,-1),Xt(s,
o,r,i,Y,1)]:Xt(s,o,r,i,Y,K)),F})}function gf(t){return mf(yf,t)}function yf(t,e,n,s,o,r){let i=t.length;if(i<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),i==
2)s(a,t[1],e[1]);else{let l=Array(i),c=Array(i-1),h=Array(i-1),u=Array(i-1);for(let d=0;d<i-1;d++)h[d]=e[d+1]-e[d],u[d]=t[d+1]-t[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<
i-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[i-1]=c[i-2];
for(let d=0;d<i-1;d++)o(a,t[d]+u[d]/3,e[d]+l[d]*u[d]/3,t[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,t[d+1],e[d+1])}return a}var ai=new Set;function Yl(){for(let t of ai)t.
syncRect(!0)}gs&&(En(Ju,ps,Yl),En(Xu,ps,Yl,!0),En(So,ps,()=>{Ue.pxRatio=de}));var wf=Dc(),bf=Cc();function ql(t,e,n,s){return(s?[t[0],t[1]].concat(t.slice(2)):[
t[0]].concat(t.slice(1))).map((r,i)=>li(r,i,e,n))}function xf(t,e){return t.map((n,s)=>s==0?{}:Re({},e,n))}function li(t,e,n,s){return Re({},e==0?n:s,t)}function Nc(t,e,n){
return e==null?ds:[e,n]}var vf=Nc;function kf(t,e,n){return e==null?ds:Mo(e,n,di,!0)}function Rc(t,e,n,s){return e==null?ds:Eo(e,n,t.scales[s].log,!1)}var Sf=Rc;
function $c(t,e,n,s){return e==null?ds:ui(e,n,t.scales[s].log,!1)}var Mf=$c;function Tf(t,e,n,s,o){let r=ot(Al(t),Al(e)),i=e-t,a=Nt(o/s*i,n);do{let l=n[a],c=s*l/
i;if(c>=o&&r+(l<5?cn.get(l):0)<=17)return[l,c]}while(++a<n.length);return[0,0]}function Kl(t){let e,n;return t=t.replace(/(\d+)px/,(s,o)=>(e=Ie((n=+o)*de))+"px"),
[t,e,n]}function Af(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=be(e[2]*de,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),e[1]=n})}function Ue(t,e,n){let s={mode:he(
t.mode,1)},o=s.mode;function r(p,f,g,y){let x=f.valToPct(p);return y+g*(f.dir==-1?1-x:x)}function i(p,f,g,y){let x=f.valToPct(p);return y+g*(f.dir==-1?x:1-x)}function a(p,f,g,y){
return f.ori==0?r(p,f,g,y):i(p,f,g,y)}s.valToPosH=r,s.valToPosV=i;let l=!1;s.status=0;let c=s.root=Tt(Du);if(t.id!=null&&(c.id=t.id),gt(c,t.class),t.title){let p=Tt(
$u,c);p.textContent=t.title}let h=Dt("canvas"),u=s.ctx=h.getContext("2d"),d=Tt(Fu,c);En("click",d,p=>{p.target===w&&(ke!=zn||Ee!=Vn)&&Ke.click(s,p)},!0);let m=s.
under=Tt(Iu,d);d.appendChild(h);let w=s.over=Tt(Ou,d);t=fs(t);let b=+he(t.pxAlign,1),S=Vl(b);(t.plugins||[]).forEach(p=>{p.opts&&(t=p.opts(s,t)||t)});let T=t.ms||
.001,v=s.series=o==1?ql(t.series||[],Ol,Hl,!1):xf(t.series||[null],Gl),A=s.axes=ql(t.axes||[],Il,Wl,!0),E=s.scales={},L=s.bands=t.bands||[];L.forEach(p=>{p.fill=
ae(p.fill||null),p.dir=he(p.dir,-1)});let _=o==2?v[1].facets[0].scale:v[0].scale,I={axes:Fp,series:Lp},H=(t.drawOrder||["axes","series"]).map(p=>I[p]);function Z(p){
let f=p.distr==3?g=>Jt(g>0?g:p.clamp(s,g,p.min,p.max,p.key)):p.distr==4?g=>Kr(g,p.asinh):p.distr==100?g=>p.fwd(g):g=>g;return g=>{let y=f(g),{_min:x,_max:M}=p,P=M-
x;return(y-x)/P}}function j(p){let f=E[p];if(f==null){let g=(t.scales||Us)[p]||Us;if(g.from!=null){j(g.from);let y=Re({},E[g.from],g,{key:p});y.valToPct=Z(y),E[p]=
y}else{f=E[p]=Re({},p==_?Sc:lf,g),f.key=p;let y=f.time,x=f.range,M=ln(x);if((p!=_||o==2&&!y)&&(M&&(x[0]==null||x[1]==null)&&(x={min:x[0]==null?Sl:{mode:1,hard:x[0],
soft:x[0]},max:x[1]==null?Sl:{mode:1,hard:x[1],soft:x[1]}},M=!1),!M&&_o(x))){let P=x;x=(N,$,O)=>$==null?ds:Mo($,O,P)}f.range=ae(x||(y?vf:p==_?f.distr==3?Sf:f.distr==
4?Mf:Nc:f.distr==3?Rc:f.distr==4?$c:kf)),f.auto=ae(M?!1:f.auto),f.clamp=ae(f.clamp||af),f._min=f._max=null,f.valToPct=Z(f)}}}j("x"),j("y"),o==1&&v.forEach(p=>{j(
p.scale)}),A.forEach(p=>{j(p.scale)});for(let p in t.scales)j(p);let D=E[_],R=D.distr,F,Y;D.ori==0?(gt(c,Nu),F=r,Y=i):(gt(c,Ru),F=i,Y=r);let W={};for(let p in E){
let f=E[p];(f.min!=null||f.max!=null)&&(W[p]={min:f.min,max:f.max},f.min=f.max=null)}let K=t.tzDate||(p=>new Date(Ie(p/T))),V=t.fmtDate||gi,$e=T==1?Nd(K):Fd(K),
pe=Rl(K,Nl(T==1?Dd:$d,V)),re=Fl(K,$l(Od,V)),ie=[],Q=s.legend=Re({},Bd,t.legend),B=s.cursor=Re({},Yd,{drag:{y:o==2}},t.cursor),Ae=Q.show,_e=B.show,ye=Q.markers;Q.
idxs=ie,ye.width=ae(ye.width),ye.dash=ae(ye.dash),ye.stroke=ae(ye.stroke),ye.fill=ae(ye.fill);let le,rt,Xe,ve=[],lt=[],Ft,ct=!1,Vt={};if(Q.live){let p=v[1]?v[1].
values:null;ct=p!=null,Ft=ct?p(s,1,0):{_:0};for(let f in Ft)Vt[f]=hi}if(Ae)if(le=Dt("table",zu,c),Xe=Dt("tbody",null,le),Q.mount(s,le),ct){rt=Dt("thead",null,le,
Xe);let p=Dt("tr",null,rt);Dt("th",null,p);for(var jt in Ft)Dt("th",hl,p).textContent=jt}else gt(le,ju),Q.live&&gt(le,Vu);let J={show:!0},ne={show:!1};function Be(p,f){
if(f==0&&(ct||!Q.live||o==2))return ds;let g=[],y=Dt("tr",Yu,Xe,Xe.childNodes[f]);gt(y,p.class),p.show||gt(y,An);let x=Dt("th",null,y);if(ye.show){let N=Tt(qu,x);
if(f>0){let $=ye.width(s,f);$&&(N.style.border=$+"px "+ye.dash(s,f)+" "+ye.stroke(s,f)),N.style.background=ye.fill(s,f)}}let M=Tt(hl,x);p.label instanceof HTMLElement?
M.appendChild(p.label):M.textContent=p.label,f>0&&(ye.show||(M.style.color=p.width>0?ye.stroke(s,f):ye.fill(s,f)),Qe("click",x,N=>{if(B._lock)return;mn(N);let $=v.
indexOf(p);if((N.ctrlKey||N.metaKey)!=Q.isolate){let O=v.some((U,z)=>z>0&&z!=$&&U.show);v.forEach((U,z)=>{z>0&&Ut(z,O?z==$?J:ne:J,!0,De.setSeries)})}else Ut($,{
show:!p.show},!0,De.setSeries)},!1),$n&&Qe(fl,x,N=>{B._lock||(mn(N),Ut(v.indexOf(p),Yn,!0,De.setSeries))},!1));for(var P in Ft){let N=Dt("td",Ku,y);N.textContent=
"--",g.push(N)}return[y,g]}let ht=new Map;function Qe(p,f,g,y=!0){let x=ht.get(f)||{},M=B.bind[p](s,f,g,y);M&&(En(p,f,x[p]=M),ht.set(f,x))}function Dn(p,f,g){let y=ht.
get(f)||{};for(let x in y)(p==null||x==p)&&(ni(x,f,y[x]),delete y[x]);p==null&&ht.delete(f)}let Yt=0,pn=0,te=0,G=0,xe=0,Fe=0,Nn=xe,un=Fe,It=te,dn=G,pt=0,bt=0,it=0,
Et=0;s.bbox={};let hr=!1,Hs=!1,Rn=!1,fn=!1,zs=!1,xt=!1;function pr(p,f,g){(g||p!=s.width||f!=s.height)&&Yi(p,f),Wn(!1),Rn=!0,Hs=!0,Bn()}function Yi(p,f){s.width=
Yt=te=p,s.height=pn=G=f,xe=Fe=0,Mp(),Tp();let g=s.bbox;pt=g.left=Mn(xe*de,.5),bt=g.top=Mn(Fe*de,.5),it=g.width=Mn(te*de,.5),Et=g.height=Mn(G*de,.5)}let vp=3;function kp(){
let p=!1,f=0;for(;!p;){f++;let g=Rp(f),y=$p(f);p=f==vp||g&&y,p||(Yi(s.width,s.height),Hs=!0)}}function Sp({width:p,height:f}){pr(p,f)}s.setSize=Sp;function Mp(){
let p=!1,f=!1,g=!1,y=!1;A.forEach((x,M)=>{if(x.show&&x._show){let{side:P,_size:N}=x,$=P%2,O=x.label!=null?x.labelSize:0,U=N+O;U>0&&($?(te-=U,P==3?(xe+=U,y=!0):g=
!0):(G-=U,P==0?(Fe+=U,p=!0):f=!0))}}),gn[0]=p,gn[1]=g,gn[2]=f,gn[3]=y,te-=en[1]+en[3],xe+=en[3],G-=en[2]+en[0],Fe+=en[0]}function Tp(){let p=xe+te,f=Fe+G,g=xe,y=Fe;
function x(M,P){switch(M){case 1:return p+=P,p-P;case 2:return f+=P,f-P;case 3:return g-=P,g+P;case 0:return y-=P,y+P}}A.forEach((M,P)=>{if(M.show&&M._show){let N=M.
side;M._pos=x(N,M._size),M.label!=null&&(M._lpos=x(N,M.labelSize))}})}if(B.dataIdx==null){let p=B.hover,f=p.skip=new Set(p.skip??[]);f.add(void 0);let g=p.prox=
ae(p.prox),y=p.bias??=0;B.dataIdx=(x,M,P,N)=>{if(M==0)return P;let $=P,O=g(x,M,P,N)??we,U=O>=0&&O<we,z=D.ori==0?te:G,ee=B.left,ue=e[0],ce=e[M];if(f.has(ce[P])){
$=null;let oe=null,X=null,q;if(y==0||y==-1)for(q=P;oe==null&&q-- >0;)f.has(ce[q])||(oe=q);if(y==0||y==1)for(q=P;X==null&&q++<ce.length;)f.has(ce[q])||(X=q);if(oe!=
null||X!=null)if(U){let Me=oe==null?-1/0:F(ue[oe],D,z,0),Ce=X==null?1/0:F(ue[X],D,z,0),Ye=ee-Me,ge=Ce-ee;Ye<=ge?Ye<=O&&($=oe):ge<=O&&($=X)}else $=X==null?oe:oe==
null?X:P-oe<=X-P?oe:X}else U&&Oe(ee-F(ue[P],D,z,0))>O&&($=null);return $}}let mn=p=>{B.event=p};B.idxs=ie,B._lock=!1;let Ze=B.points;Ze.show=ae(Ze.show),Ze.size=
ae(Ze.size),Ze.stroke=ae(Ze.stroke),Ze.width=ae(Ze.width),Ze.fill=ae(Ze.fill);let Ot=s.focus=Re({},t.focus||{alpha:.3},B.focus),$n=Ot.prox>=0,Fn=$n&&Ze.one,vt=[],
In=[],On=[];function qi(p,f){let g=Ze.show(s,f);if(g instanceof HTMLElement)return gt(g,Hu),gt(g,p.class),zt(g,-10,-10,te,G),w.insertBefore(g,vt[f]),g}function Ki(p,f){
if(o==1||f>0){let g=o==1&&E[p.scale].time,y=p.value;p.value=g?_l(y)?Fl(K,$l(y,V)):y||re:y||sf,p.label=p.label||(g?Kd:qd)}if(Fn||f>0){p.width=p.width==null?1:p.width,
p.paths=p.paths||wf||ad,p.fillTo=ae(p.fillTo||cf),p.pxAlign=+he(p.pxAlign,b),p.pxRound=Vl(p.pxAlign),p.stroke=ae(p.stroke||null),p.fill=ae(p.fill||null),p._stroke=
p._fill=p._paths=p._focus=null;let g=of(ot(1,p.width),1),y=p.points=Re({},{size:g,width:ot(1,g*.2),stroke:p.stroke,space:g*2,paths:bf,_stroke:null,_fill:null},p.
points);y.show=ae(y.show),y.filter=ae(y.filter),y.fill=ae(y.fill),y.stroke=ae(y.stroke),y.paths=ae(y.paths),y.pxAlign=p.pxAlign}if(Ae){let g=Be(p,f);ve.splice(f,
0,g[0]),lt.splice(f,0,g[1]),Q.values.push(null)}if(_e){ie.splice(f,0,null);let g=null;Fn?f==0&&(g=qi(p,f)):f>0&&(g=qi(p,f)),vt.splice(f,0,g),In.splice(f,0,0),On.
splice(f,0,0)}je("addSeries",f)}function Ap(p,f){f=f??v.length,p=o==1?li(p,f,Ol,Hl):li(p,f,{},Gl),v.splice(f,0,p),Ki(v[f],f)}s.addSeries=Ap;function Ep(p){if(v.
splice(p,1),Ae){Q.values.splice(p,1),lt.splice(p,1);let f=ve.splice(p,1)[0];Dn(null,f.firstChild),f.remove()}_e&&(ie.splice(p,1),vt.splice(p,1)[0].remove(),In.splice(
p,1),On.splice(p,1)),je("delSeries",p)}s.delSeries=Ep;let gn=[!1,!1,!1,!1];function Pp(p,f){if(p._show=p.show,p.show){let g=p.side%2,y=E[p.scale];y==null&&(p.scale=
g?v[1].scale:_,y=E[p.scale]);let x=y.time;p.size=ae(p.size),p.space=ae(p.space),p.rotate=ae(p.rotate),ln(p.incrs)&&p.incrs.forEach(P=>{!cn.has(P)&&cn.set(P,oc(P))}),
p.incrs=ae(p.incrs||(y.distr==2?_d:x?T==1?Ld:Rd:Tn)),p.splits=ae(p.splits||(x&&y.distr==1?$e:y.distr==3?oi:y.distr==4?Zd:Xd)),p.stroke=ae(p.stroke),p.grid.stroke=
ae(p.grid.stroke),p.ticks.stroke=ae(p.ticks.stroke),p.border.stroke=ae(p.border.stroke);let M=p.values;p.values=ln(M)&&!ln(M[0])?ae(M):x?ln(M)?Rl(K,Nl(M,V)):_l(
M)?Id(K,M):M||pe:M||Jd,p.filter=ae(p.filter||(y.distr>=3&&y.log==10?tf:y.distr==3&&y.log==2?nf:nc)),p.font=Kl(p.font),p.labelFont=Kl(p.labelFont),p._size=p.size(
s,null,f,0),p._space=p._rotate=p._incrs=p._found=p._splits=p._values=null,p._size>0&&(gn[f]=!0,p._el=Tt(Uu,d))}}function ks(p,f,g,y){let[x,M,P,N]=g,$=f%2,O=0;return $==
0&&(N||M)&&(O=f==0&&!x||f==2&&!P?Ie(Il.size/3):0),$==1&&(x||P)&&(O=f==1&&!M||f==3&&!N?Ie(Wl.size/2):0),O}let Ji=s.padding=(t.padding||[ks,ks,ks,ks]).map(p=>ae(he(
p,ks))),en=s._padding=Ji.map((p,f)=>p(s,f,gn,0)),qe,Ge=null,He=null,Vs=o==1?v[0].idxs:null,Pt=null,Ss=!1;function Xi(p,f){if(e=p??[],s.data=s._data=e,o==2){qe=0;
for(let g=1;g<v.length;g++)qe+=e[g][0].length}else{e.length==0&&(s.data=s._data=e=[[]]),Pt=e[0],qe=Pt.length;let g=e;if(R==2){g=e.slice();let y=g[0]=Array(qe);for(let x=0;x<
qe;x++)y[x]=x}s._data=e=g}if(Wn(!0),je("setData"),R==2&&(Rn=!0),f!==!1){let g=D;g.auto(s,Ss)?ur():nn(_,g.min,g.max),fn=fn||B.left>=0,xt=!0,Bn()}}s.setData=Xi;function ur(){
Ss=!0;let p,f;o==1&&(qe>0?(Ge=Vs[0]=0,He=Vs[1]=qe-1,p=e[0][Ge],f=e[0][He],R==2?(p=Ge,f=He):p==f&&(R==3?[p,f]=Eo(p,p,D.log,!1):R==4?[p,f]=ui(p,p,D.log,!1):D.time?
f=p+Ie(86400/T):[p,f]=Mo(p,f,di,!0))):(Ge=Vs[0]=p=null,He=Vs[1]=f=null)),nn(_,p,f)}let js,Un,dr,fr,mr,gr,yr,wr,br,at;function Zi(p,f,g,y,x,M){p??=ul,g??=mi,y??=
"butt",x??=ul,M??="round",p!=js&&(u.strokeStyle=js=p),x!=Un&&(u.fillStyle=Un=x),f!=dr&&(u.lineWidth=dr=f),M!=mr&&(u.lineJoin=mr=M),y!=gr&&(u.lineCap=gr=y),g!=fr&&
u.setLineDash(fr=g)}function Qi(p,f,g,y){f!=Un&&(u.fillStyle=Un=f),p!=yr&&(u.font=yr=p),g!=wr&&(u.textAlign=wr=g),y!=br&&(u.textBaseline=br=y)}function xr(p,f,g,y,x=0){
if(y.length>0&&p.auto(s,Ss)&&(f==null||f.min==null)){let M=he(Ge,0),P=he(He,y.length-1),N=g.min==null?td(y,M,P,x,p.distr==3):[g.min,g.max];p.min=Rt(p.min,g.min=
N[0]),p.max=ot(p.max,g.max=N[1])}}let ea={min:null,max:null};function _p(){for(let y in E){let x=E[y];W[y]==null&&(x.min==null||W[_]!=null&&x.auto(s,Ss))&&(W[y]=
ea)}for(let y in E){let x=E[y];W[y]==null&&x.from!=null&&W[x.from]!=null&&(W[y]=ea)}W[_]!=null&&Wn(!0);let p={};for(let y in W){let x=W[y];if(x!=null){let M=p[y]=
fs(E[y],hd);if(x.min!=null)Re(M,x);else if(y!=_||o==2)if(qe==0&&M.from==null){let P=M.range(s,null,null,y);M.min=P[0],M.max=P[1]}else M.min=we,M.max=-we}}if(qe>
0){v.forEach((y,x)=>{if(o==1){let M=y.scale,P=W[M];if(P==null)return;let N=p[M];if(x==0){let $=N.range(s,N.min,N.max,M);N.min=$[0],N.max=$[1],Ge=Nt(N.min,e[0]),
He=Nt(N.max,e[0]),He-Ge>1&&(e[0][Ge]<N.min&&Ge++,e[0][He]>N.max&&He--),y.min=Pt[Ge],y.max=Pt[He]}else y.show&&y.auto&&xr(N,P,y,e[x],y.sorted);y.idxs[0]=Ge,y.idxs[1]=
He}else if(x>0&&y.show&&y.auto){let[M,P]=y.facets,N=M.scale,$=P.scale,[O,U]=e[x],z=p[N],ee=p[$];z!=null&&xr(z,W[N],M,O,M.sorted),ee!=null&&xr(ee,W[$],P,U,P.sorted),
y.min=P.min,y.max=P.max}});for(let y in p){let x=p[y],M=W[y];if(x.from==null&&(M==null||M.min==null)){let P=x.range(s,x.min==we?null:x.min,x.max==-we?null:x.max,
y);x.min=P[0],x.max=P[1]}}}for(let y in p){let x=p[y];if(x.from!=null){let M=p[x.from];if(M.min==null)x.min=x.max=null;else{let P=x.range(s,M.min,M.max,y);x.min=
P[0],x.max=P[1]}}}let f={},g=!1;for(let y in p){let x=p[y],M=E[y];if(M.min!=x.min||M.max!=x.max){M.min=x.min,M.max=x.max;let P=M.distr;M._min=P==3?Jt(M.min):P==
4?Kr(M.min,M.asinh):P==100?M.fwd(M.min):M.min,M._max=P==3?Jt(M.max):P==4?Kr(M.max,M.asinh):P==100?M.fwd(M.max):M.max,f[y]=g=!0}}if(g){v.forEach((y,x)=>{o==2?x>0&&
f.y&&(y._paths=null):f[y.scale]&&(y._paths=null)});for(let y in f)Rn=!0,je("setScale",y);_e&&B.left>=0&&(fn=xt=!0)}for(let y in W)W[y]=null}function Cp(p){let f=si(
Ge-1,0,qe-1),g=si(He+1,0,qe-1);for(;p[f]==null&&f>0;)f--;for(;p[g]==null&&g<qe-1;)g++;return[f,g]}function Lp(){if(qe>0){let p=v.some(f=>f._focus)&&at!=Ot.alpha;
p&&(u.globalAlpha=at=Ot.alpha),v.forEach((f,g)=>{if(g>0&&f.show&&(ta(g,!1),ta(g,!0),f._paths==null)){let y=at;at!=f.alpha&&(u.globalAlpha=at=f.alpha);let x=o==2?
[0,e[g][0].length-1]:Cp(e[g]);f._paths=f.paths(s,g,x[0],x[1]),at!=y&&(u.globalAlpha=at=y)}}),v.forEach((f,g)=>{if(g>0&&f.show){let y=at;at!=f.alpha&&(u.globalAlpha=
at=f.alpha),f._paths!=null&&na(g,!1);{let x=f._paths!=null?f._paths.gaps:null,M=f.points.show(s,g,Ge,He,x),P=f.points.filter(s,g,M,x);(M||P)&&(f.points._paths=f.
points.paths(s,g,Ge,He,P),na(g,!0))}at!=y&&(u.globalAlpha=at=y),je("drawSeries",g)}}),p&&(u.globalAlpha=at=1)}}function ta(p,f){let g=f?v[p].points:v[p];g._stroke=
g.stroke(s,p),g._fill=g.fill(s,p)}function na(p,f){let g=f?v[p].points:v[p],{stroke:y,fill:x,clip:M,flags:P,_stroke:N=g._stroke,_fill:$=g._fill,_width:O=g.width}=g.
_paths;O=be(O*de,3);let U=null,z=O%2/2;f&&$==null&&($=O>0?"#fff":N);let ee=g.pxAlign==1&&z>0;if(ee&&u.translate(z,z),!f){let ue=pt-O/2,ce=bt-O/2,oe=it+O,X=Et+O;
U=new Path2D,U.rect(ue,ce,oe,X)}f?vr(N,O,g.dash,g.cap,$,y,x,P,M):Dp(p,N,O,g.dash,g.cap,$,y,x,P,U,M),ee&&u.translate(-z,-z)}function Dp(p,f,g,y,x,M,P,N,$,O,U){let z=!1;
$!=0&&L.forEach((ee,ue)=>{if(ee.series[0]==p){let ce=v[ee.series[1]],oe=e[ee.series[1]],X=(ce._paths||Us).band;ln(X)&&(X=ee.dir==1?X[0]:X[1]);let q,Me=null;ce.show&&
X&&sd(oe,Ge,He)?(Me=ee.fill(s,ue)||M,q=ce._paths.clip):X=null,vr(f,g,y,x,Me,P,N,$,O,U,q,X),z=!0}}),z||vr(f,g,y,x,M,P,N,$,O,U)}let sa=ms|ii;function vr(p,f,g,y,x,M,P,N,$,O,U,z){
Zi(p,f,g,y,x),($||O||z)&&(u.save(),$&&u.clip($),O&&u.clip(O)),z?(N&sa)==sa?(u.clip(z),U&&u.clip(U),qs(x,P),Ys(p,M,f)):N&ii?(qs(x,P),u.clip(z),Ys(p,M,f)):N&ms&&(u.
save(),u.clip(z),U&&u.clip(U),qs(x,P),u.restore(),Ys(p,M,f)):(qs(x,P),Ys(p,M,f)),($||O||z)&&u.restore()}function Ys(p,f,g){g>0&&(f instanceof Map?f.forEach((y,x)=>{
u.strokeStyle=js=x,u.stroke(y)}):f!=null&&p&&u.stroke(f))}function qs(p,f){f instanceof Map?f.forEach((g,y)=>{u.fillStyle=Un=y,u.fill(g)}):f!=null&&p&&u.fill(f)}
function Np(p,f,g,y){let x=A[p],M;if(y<=0)M=[0,0];else{let P=x._space=x.space(s,p,f,g,y),N=x._incrs=x.incrs(s,p,f,g,y,P);M=Tf(f,g,N,y,P)}return x._found=M}function kr(p,f,g,y,x,M,P,N,$,O){
let U=P%2/2;b==1&&u.translate(U,U),Zi(N,P,$,O,N),u.beginPath();let z,ee,ue,ce,oe=x+(y==0||y==3?-M:M);g==0?(ee=x,ce=oe):(z=x,ue=oe);for(let X=0;X<p.length;X++)f[X]!=
null&&(g==0?z=ue=p[X]:ee=ce=p[X],u.moveTo(z,ee),u.lineTo(ue,ce));u.stroke(),b==1&&u.translate(-U,-U)}function Rp(p){let f=!0;return A.forEach((g,y)=>{if(!g.show)
return;let x=E[g.scale];if(x.min==null){g._show&&(f=!1,g._show=!1,Wn(!1));return}else g._show||(f=!1,g._show=!0,Wn(!1));let M=g.side,P=M%2,{min:N,max:$}=x,[O,U]=Np(
y,N,$,P==0?te:G);if(U==0)return;let z=x.distr==2,ee=g._splits=g.splits(s,y,N,$,O,U,z),ue=x.distr==2?ee.map(q=>Pt[q]):ee,ce=x.distr==2?Pt[ee[1]]-Pt[ee[0]]:O,oe=g.
_values=g.values(s,g.filter(s,ue,y,U,ce),y,U,ce);g._rotate=M==2?g.rotate(s,oe,y,U):0;let X=g._size;g._size=At(g.size(s,oe,y,p)),X!=null&&g._size!=X&&(f=!1)}),f}
function $p(p){let f=!0;return Ji.forEach((g,y)=>{let x=g(s,y,gn,p);x!=en[y]&&(f=!1),en[y]=x}),f}function Fp(){for(let p=0;p<A.length;p++){let f=A[p];if(!f.show||
!f._show)continue;let g=f.side,y=g%2,x,M,P=f.stroke(s,p),N=g==0||g==3?-1:1,[$,O]=f._found;if(f.label!=null){let tt=f.labelGap*N,ft=Ie((f._lpos+tt)*de);Qi(f.labelFont[0],
P,"center",g==2?"top":pl),u.save(),y==1?(x=M=0,u.translate(ft,Ie(bt+Et/2)),u.rotate((g==3?-ko:ko)/2)):(x=Ie(pt+it/2),M=ft);let bn=ec(f.label)?f.label(s,p,$,O):f.
label;u.fillText(bn,x,M),u.restore()}if(O==0)continue;let U=E[f.scale],z=y==0?it:Et,ee=y==0?pt:bt,ue=f._splits,ce=U.distr==2?ue.map(tt=>Pt[tt]):ue,oe=U.distr==2?
Pt[ue[1]]-Pt[ue[0]]:$,X=f.ticks,q=f.border,Me=X.show?X.size:0,Ce=Ie(Me*de),Ye=Ie((f.alignTo==2?f._size-Me-f.gap:f.gap)*de),ge=f._rotate*-ko/180,Le=S(f._pos*de),
ut=(Ce+Ye)*N,et=Le+ut;M=y==0?et:0,x=y==1?et:0;let kt=f.font[0],_t=f.align==1?cs:f.align==2?jr:ge>0?cs:ge<0?jr:y==0?"center":g==3?jr:cs,Bt=ge||y==1?"middle":g==2?
"top":pl;Qi(kt,P,_t,Bt);let dt=f.font[1]*f.lineGap,St=ue.map(tt=>S(a(tt,U,z,ee))),Ct=f._values;for(let tt=0;tt<Ct.length;tt++){let ft=Ct[tt];if(ft!=null){y==0?x=
St[tt]:M=St[tt],ft=""+ft;let bn=ft.indexOf(`
`)==-1?[ft]:ft.split(/\n/gm);for(let nt=0;nt<bn.length;nt++){let ka=bn[nt];ge?(u.save(),u.translate(x,M+nt*dt),u.rotate(ge),u.fillText(ka,0,0),u.restore()):u.fillText(
ka,x,M+nt*dt)}}}X.show&&kr(St,X.filter(s,ce,p,O,oe),y,g,Le,Ce,be(X.width*de,3),X.stroke(s,p),X.dash,X.cap);let Gt=f.grid;Gt.show&&kr(St,Gt.filter(s,ce,p,O,oe),y,
y==0?2:1,y==0?bt:pt,y==0?Et:it,be(Gt.width*de,3),Gt.stroke(s,p),Gt.dash,Gt.cap),q.show&&kr([Le],[1],y==0?1:0,y==0?1:2,y==1?bt:pt,y==1?Et:it,be(q.width*de,3),q.stroke(
s,p),q.dash,q.cap)}je("drawAxes")}function Wn(p){v.forEach((f,g)=>{g>0&&(f._paths=null,p&&(o==1?(f.min=null,f.max=null):f.facets.forEach(y=>{y.min=null,y.max=null})))})}
let Ks=!1,Sr=!1,Ms=[];function Ip(){Sr=!1;for(let p=0;p<Ms.length;p++)je(...Ms[p]);Ms.length=0}function Bn(){Ks||(yd(oa),Ks=!0)}function Op(p,f=!1){Ks=!0,Sr=f,p(
s),oa(),f&&Ms.length>0&&queueMicrotask(Ip)}s.batch=Op;function oa(){if(hr&&(_p(),hr=!1),Rn&&(kp(),Rn=!1),Hs){if(Te(m,cs,xe),Te(m,"top",Fe),Te(m,$s,te),Te(m,Fs,G),
Te(w,cs,xe),Te(w,"top",Fe),Te(w,$s,te),Te(w,Fs,G),Te(d,$s,Yt),Te(d,Fs,pn),h.width=Ie(Yt*de),h.height=Ie(pn*de),A.forEach(({_el:p,_show:f,_size:g,_pos:y,side:x})=>{
if(p!=null)if(f){let M=x===3||x===0?g:0,P=x%2==1;Te(p,P?"left":"top",y-M),Te(p,P?"width":"height",g),Te(p,P?"top":"left",P?Fe:xe),Te(p,P?"height":"width",P?G:te),
ti(p,An)}else gt(p,An)}),js=Un=dr=mr=gr=yr=wr=br=fr=null,at=1,Es(!0),xe!=Nn||Fe!=un||te!=It||G!=dn){Wn(!1);let p=te/It,f=G/dn;if(_e&&!fn&&B.left>=0){B.left*=p,B.
top*=f,Gn&&zt(Gn,Ie(B.left),0,te,G),Hn&&zt(Hn,0,Ie(B.top),te,G);for(let g=0;g<vt.length;g++){let y=vt[g];y!=null&&(In[g]*=p,On[g]*=f,zt(y,At(In[g]),At(On[g]),te,
G))}}if(Se.show&&!zs&&Se.left>=0&&Se.width>0){Se.left*=p,Se.width*=p,Se.top*=f,Se.height*=f;for(let g in _r)Te(jn,g,Se[g])}Nn=xe,un=Fe,It=te,dn=G}je("setSize"),
Hs=!1}Yt>0&&pn>0&&(u.clearRect(0,0,h.width,h.height),je("drawClear"),H.forEach(p=>p()),je("draw")),Se.show&&zs&&(Js(Se),zs=!1),_e&&fn&&(wn(null,!0,!1),fn=!1),Q.
show&&Q.live&&xt&&(Er(),xt=!1),l||(l=!0,s.status=1,je("ready")),Ss=!1,Ks=!1}s.redraw=(p,f)=>{Rn=f||!1,p!==!1?nn(_,D.min,D.max):Bn()};function Mr(p,f){let g=E[p];
if(g.from==null){if(qe==0){let y=g.range(s,f.min,f.max,p);f.min=y[0],f.max=y[1]}if(f.min>f.max){let y=f.min;f.min=f.max,f.max=y}if(qe>1&&f.min!=null&&f.max!=null&&
f.max-f.min<1e-16)return;p==_&&g.distr==2&&qe>0&&(f.min=Nt(f.min,e[0]),f.max=Nt(f.max,e[0]),f.min==f.max&&f.max++),W[p]=f,hr=!0,Bn()}}s.setScale=Mr;let Tr,Ar,Gn,
Hn,ra,ia,zn,Vn,aa,la,ke,Ee,tn=!1,Ke=B.drag,ze=Ke.x,Ve=Ke.y;_e&&(B.x&&(Tr=Tt(Bu,w)),B.y&&(Ar=Tt(Gu,w)),D.ori==0?(Gn=Tr,Hn=Ar):(Gn=Ar,Hn=Tr),ke=B.left,Ee=B.top);let Se=s.
select=Re({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),jn=Se.show?Tt(Wu,Se.over?w:m):null;function Js(p,f){if(Se.show){for(let g in p)Se[g]=p[g],g in
_r&&Te(jn,g,p[g]);f!==!1&&je("setSelect")}}s.setSelect=Js;function Up(p){if(v[p].show)Ae&&ti(ve[p],An);else if(Ae&&gt(ve[p],An),_e){let g=Fn?vt[0]:vt[p];g!=null&&
zt(g,-10,-10,te,G)}}function nn(p,f,g){Mr(p,{min:f,max:g})}function Ut(p,f,g,y){f.focus!=null&&zp(p),f.show!=null&&v.forEach((x,M)=>{M>0&&(p==M||p==null)&&(x.show=
f.show,Up(M),o==2?(nn(x.facets[0].scale,null,null),nn(x.facets[1].scale,null,null)):nn(x.scale,null,null),Bn())}),g!==!1&&je("setSeries",p,f),y&&Ps("setSeries",
s,p,f)}s.setSeries=Ut;function Wp(p,f){Re(L[p],f)}function Bp(p,f){p.fill=ae(p.fill||null),p.dir=he(p.dir,-1),f=f??L.length,L.splice(f,0,p)}function Gp(p){p==null?
L.length=0:L.splice(p,1)}s.addBand=Bp,s.setBand=Wp,s.delBand=Gp;function Hp(p,f){v[p].alpha=f,_e&&vt[p]!=null&&(vt[p].style.opacity=f),Ae&&ve[p]&&(ve[p].style.opacity=
f)}let qt,sn,yn,Yn={focus:!0};function zp(p){if(p!=yn){let f=p==null,g=Ot.alpha!=1;v.forEach((y,x)=>{if(o==1||x>0){let M=f||x==0||x==p;y._focus=f?null:M,g&&Hp(x,
M?1:Ot.alpha)}}),yn=p,g&&Bn()}}Ae&&$n&&Qe(ml,le,p=>{B._lock||(mn(p),yn!=null&&Ut(null,Yn,!0,De.setSeries))});function Wt(p,f,g){let y=E[f];g&&(p=p/de-(y.ori==1?
Fe:xe));let x=te;y.ori==1&&(x=G,p=x-p),y.dir==-1&&(p=x-p);let M=y._min,P=y._max,N=p/x,$=M+(P-M)*N,O=y.distr;return O==3?us(10,$):O==4?rd($,y.asinh):O==100?y.bwd(
$):$}function Vp(p,f){let g=Wt(p,_,f);return Nt(g,e[0],Ge,He)}s.valToIdx=p=>Nt(p,e[0]),s.posToIdx=Vp,s.posToVal=Wt,s.valToPos=(p,f,g)=>E[f].ori==0?r(p,E[f],g?it:
te,g?pt:0):i(p,E[f],g?Et:G,g?bt:0),s.setCursor=(p,f,g)=>{ke=p.left,Ee=p.top,wn(null,f,g)};function ca(p,f){Te(jn,cs,Se.left=p),Te(jn,$s,Se.width=f)}function ha(p,f){
Te(jn,"top",Se.top=p),Te(jn,Fs,Se.height=f)}let Ts=D.ori==0?ca:ha,As=D.ori==1?ca:ha;function jp(){if(Ae&&Q.live)for(let p=o==2?1:0;p<v.length;p++){if(p==0&&ct)continue;
let f=Q.values[p],g=0;for(let y in f)lt[p][g++].firstChild.nodeValue=f[y]}}function Er(p,f){if(p!=null&&(p.idxs?p.idxs.forEach((g,y)=>{ie[y]=g}):cd(p.idx)||ie.fill(
p.idx),Q.idx=ie[0]),Ae&&Q.live){for(let g=0;g<v.length;g++)(g>0||o==1&&!ct)&&Yp(g,ie[g]);jp()}xt=!1,f!==!1&&je("setLegend")}s.setLegend=Er;function Yp(p,f){let g=v[p],
y=p==0&&R==2?Pt:e[p],x;ct?x=g.values(s,p,f)??Vt:(x=g.value(s,f==null?null:y[f],p,f),x=x==null?Vt:{_:x}),Q.values[p]=x}function wn(p,f,g){aa=ke,la=Ee,[ke,Ee]=B.move(
s,ke,Ee),B.left=ke,B.top=Ee,_e&&(Gn&&zt(Gn,Ie(ke),0,te,G),Hn&&zt(Hn,0,Ie(Ee),te,G));let y,x=Ge>He;qt=we,sn=null;let M=D.ori==0?te:G,P=D.ori==1?te:G;if(ke<0||qe==
0||x){y=B.idx=null;for(let N=0;N<v.length;N++){let $=vt[N];$!=null&&zt($,-10,-10,te,G)}$n&&Ut(null,Yn,!0,p==null&&De.setSeries),Q.live&&(ie.fill(y),xt=!0)}else{
let N,$,O;o==1&&(N=D.ori==0?ke:Ee,$=Wt(N,_),y=B.idx=Nt($,e[0],Ge,He),O=F(e[0][y],D,M,0));let U=-10,z=-10,ee=0,ue=0,ce=!0,oe="",X="";for(let q=o==2?1:0;q<v.length;q++){
let Me=v[q],Ce=ie[q],Ye=Ce==null?null:o==1?e[q][Ce]:e[q][1][Ce],ge=B.dataIdx(s,q,y,$),Le=ge==null?null:o==1?e[q][ge]:e[q][1][ge];if(xt=xt||Le!=Ye||ge!=Ce,ie[q]=
ge,q>0&&Me.show){let ut=ge==null?-10:ge==y?O:F(o==1?e[0][ge]:e[q][0][ge],D,M,0),et=Le==null?-10:Y(Le,o==1?E[Me.scale]:E[Me.facets[1].scale],P,0);if($n&&Le!=null){
let kt=D.ori==1?ke:Ee,_t=Oe(Ot.dist(s,q,ge,et,kt));if(_t<qt){let Bt=Ot.bias;if(Bt!=0){let dt=Wt(kt,Me.scale),St=Le>=0?1:-1,Ct=dt>=0?1:-1;Ct==St&&(Ct==1?Bt==1?Le>=
dt:Le<=dt:Bt==1?Le<=dt:Le>=dt)&&(qt=_t,sn=q)}else qt=_t,sn=q}}if(xt||Fn){let kt,_t;D.ori==0?(kt=ut,_t=et):(kt=et,_t=ut);let Bt,dt,St,Ct,Gt,tt,ft=!0,bn=Ze.bbox;if(bn!=
null){ft=!1;let nt=bn(s,q);St=nt.left,Ct=nt.top,Bt=nt.width,dt=nt.height}else St=kt,Ct=_t,Bt=dt=Ze.size(s,q);if(tt=Ze.fill(s,q),Gt=Ze.stroke(s,q),Fn)q==sn&&qt<=
Ot.prox&&(U=St,z=Ct,ee=Bt,ue=dt,ce=ft,oe=tt,X=Gt);else{let nt=vt[q];nt!=null&&(In[q]=St,On[q]=Ct,kl(nt,Bt,dt,ft),xl(nt,tt,Gt),zt(nt,At(St),At(Ct),te,G))}}}}if(Fn){
let q=Ot.prox,Me=yn==null?qt<=q:qt>q||sn!=yn;if(xt||Me){let Ce=vt[0];Ce!=null&&(In[0]=U,On[0]=z,kl(Ce,ee,ue,ce),xl(Ce,oe,X),zt(Ce,At(U),At(z),te,G))}}}if(Se.show&&
tn)if(p!=null){let[N,$]=De.scales,[O,U]=De.match,[z,ee]=p.cursor.sync.scales,ue=p.cursor.drag;if(ze=ue._x,Ve=ue._y,ze||Ve){let{left:ce,top:oe,width:X,height:q}=p.
select,Me=p.scales[z].ori,Ce=p.posToVal,Ye,ge,Le,ut,et,kt=N!=null&&O(N,z),_t=$!=null&&U($,ee);kt&&ze?(Me==0?(Ye=ce,ge=X):(Ye=oe,ge=q),Le=E[N],ut=F(Ce(Ye,z),Le,M,
0),et=F(Ce(Ye+ge,z),Le,M,0),Ts(Rt(ut,et),Oe(et-ut))):Ts(0,M),_t&&Ve?(Me==1?(Ye=ce,ge=X):(Ye=oe,ge=q),Le=E[$],ut=Y(Ce(Ye,ee),Le,P,0),et=Y(Ce(Ye+ge,ee),Le,P,0),As(
Rt(ut,et),Oe(et-ut))):As(0,P)}else Cr()}else{let N=Oe(aa-ra),$=Oe(la-ia);if(D.ori==1){let ee=N;N=$,$=ee}ze=Ke.x&&N>=Ke.dist,Ve=Ke.y&&$>=Ke.dist;let O=Ke.uni;O!=
null?ze&&Ve&&(ze=N>=O,Ve=$>=O,!ze&&!Ve&&($>N?Ve=!0:ze=!0)):Ke.x&&Ke.y&&(ze||Ve)&&(ze=Ve=!0);let U,z;ze&&(D.ori==0?(U=zn,z=ke):(U=Vn,z=Ee),Ts(Rt(U,z),Oe(z-U)),Ve||
As(0,P)),Ve&&(D.ori==1?(U=zn,z=ke):(U=Vn,z=Ee),As(Rt(U,z),Oe(z-U)),ze||Ts(0,M)),!ze&&!Ve&&(Ts(0,0),As(0,0))}if(Ke._x=ze,Ke._y=Ve,p==null){if(g){if(va!=null){let[
N,$]=De.scales;De.values[0]=N!=null?Wt(D.ori==0?ke:Ee,N):null,De.values[1]=$!=null?Wt(D.ori==1?ke:Ee,$):null}Ps(Yr,s,ke,Ee,te,G,y)}if($n){let N=g&&De.setSeries,
$=Ot.prox;yn==null?qt<=$&&Ut(sn,Yn,!0,N):qt>$?Ut(null,Yn,!0,N):sn!=yn&&Ut(sn,Yn,!0,N)}}xt&&(Q.idx=y,Er()),f!==!1&&je("setCursor")}let on=null;Object.defineProperty(
s,"rect",{get(){return on==null&&Es(!1),on}});function Es(p=!1){p?on=null:(on=w.getBoundingClientRect(),je("syncRect",on))}function pa(p,f,g,y,x,M,P){B._lock||tn&&
p!=null&&p.movementX==0&&p.movementY==0||(Pr(p,f,g,y,x,M,P,!1,p!=null),p!=null?wn(null,!0,!0):wn(f,!0,!1))}function Pr(p,f,g,y,x,M,P,N,$){if(on==null&&Es(!1),mn(
p),p!=null)g=p.clientX-on.left,y=p.clientY-on.top;else{if(g<0||y<0){ke=-10,Ee=-10;return}let[O,U]=De.scales,z=f.cursor.sync,[ee,ue]=z.values,[ce,oe]=z.scales,[X,
q]=De.match,Me=f.axes[0].side%2==1,Ce=D.ori==0?te:G,Ye=D.ori==1?te:G,ge=Me?M:x,Le=Me?x:M,ut=Me?y:g,et=Me?g:y;if(ce!=null?g=X(O,ce)?a(ee,E[O],Ce,0):-10:g=Ce*(ut/
ge),oe!=null?y=q(U,oe)?a(ue,E[U],Ye,0):-10:y=Ye*(et/Le),D.ori==1){let kt=g;g=y,y=kt}}$&&(f==null||f.cursor.event.type==Yr)&&((g<=1||g>=te-1)&&(g=Mn(g,te)),(y<=1||
y>=G-1)&&(y=Mn(y,G))),N?(ra=g,ia=y,[zn,Vn]=B.move(s,g,y)):(ke=g,Ee=y)}let _r={width:0,height:0,left:0,top:0};function Cr(){Js(_r,!1)}let ua,da,fa,ma;function ga(p,f,g,y,x,M,P){
tn=!0,ze=Ve=Ke._x=Ke._y=!1,Pr(p,f,g,y,x,M,P,!0,!1),p!=null&&(Qe(qr,Qr,ya,!1),Ps(dl,s,zn,Vn,te,G,null));let{left:N,top:$,width:O,height:U}=Se;ua=N,da=$,fa=O,ma=U}
function ya(p,f,g,y,x,M,P){tn=Ke._x=Ke._y=!1,Pr(p,f,g,y,x,M,P,!1,!0);let{left:N,top:$,width:O,height:U}=Se,z=O>0||U>0,ee=ua!=N||da!=$||fa!=O||ma!=U;if(z&&ee&&Js(
Se),Ke.setScale&&z&&ee){let ue=N,ce=O,oe=$,X=U;if(D.ori==1&&(ue=$,ce=U,oe=N,X=O),ze&&nn(_,Wt(ue,_),Wt(ue+ce,_)),Ve)for(let q in E){let Me=E[q];q!=_&&Me.from==null&&
Me.min!=we&&nn(q,Wt(oe+X,q),Wt(oe,q))}Cr()}else B.lock&&(B._lock=!B._lock,wn(f,!0,p!=null));p!=null&&(Dn(qr,Qr),Ps(qr,s,ke,Ee,te,G,null))}function qp(p,f,g,y,x,M,P){
if(B._lock)return;mn(p);let N=tn;if(tn){let $=!0,O=!0,U=10,z,ee;D.ori==0?(z=ze,ee=Ve):(z=Ve,ee=ze),z&&ee&&($=ke<=U||ke>=te-U,O=Ee<=U||Ee>=G-U),z&&$&&(ke=ke<zn?0:
te),ee&&O&&(Ee=Ee<Vn?0:G),wn(null,!0,!0),tn=!1}ke=-10,Ee=-10,ie.fill(null),wn(null,!0,!0),N&&(tn=N)}function wa(p,f,g,y,x,M,P){B._lock||(mn(p),ur(),Cr(),p!=null&&
Ps(gl,s,ke,Ee,te,G,null))}function ba(){A.forEach(Af),pr(s.width,s.height,!0)}En(So,ps,ba);let qn={};qn.mousedown=ga,qn.mousemove=pa,qn.mouseup=ya,qn.dblclick=wa,
qn.setSeries=(p,f,g,y)=>{let x=De.match[2];g=x(s,f,g),g!=-1&&Ut(g,y,!0,!1)},_e&&(Qe(dl,w,ga),Qe(Yr,w,pa),Qe(fl,w,p=>{mn(p),Es(!1)}),Qe(ml,w,qp),Qe(gl,w,wa),ai.add(
s),s.syncRect=Es);let Xs=s.hooks=t.hooks||{};function je(p,f,g){Sr?Ms.push([p,f,g]):p in Xs&&Xs[p].forEach(y=>{y.call(null,s,f,g)})}(t.plugins||[]).forEach(p=>{
for(let f in p.hooks)Xs[f]=(Xs[f]||[]).concat(p.hooks[f])});let xa=(p,f,g)=>g,De=Re({key:null,setSeries:!1,filters:{pub:El,sub:El},scales:[_,v[1]?v[1].scale:null],
match:[Pl,Pl,xa],values:[null,null]},B.sync);De.match.length==2&&De.match.push(xa),B.sync=De;let va=De.key,Lr=Mc(va);function Ps(p,f,g,y,x,M,P){De.filters.pub(p,
f,g,y,x,M,P)&&Lr.pub(p,f,g,y,x,M,P)}Lr.sub(s);function Kp(p,f,g,y,x,M,P){De.filters.sub(p,f,g,y,x,M,P)&&qn[p](null,f,g,y,x,M,P)}s.pub=Kp;function Jp(){Lr.unsub(
s),ai.delete(s),ht.clear(),ni(So,ps,ba),c.remove(),le?.remove(),je("destroy")}s.destroy=Jp;function Dr(){je("init",t,e),Xi(e||t.data,!1),W[_]?Mr(_,W[_]):ur(),zs=
Se.show&&(Se.width>0||Se.height>0),fn=xt=!0,pr(t.width,t.height)}return v.forEach(Ki),A.forEach(Pp),n?n instanceof HTMLElement?(n.appendChild(c),Dr()):n(s,Dr):Dr(),
s}Ue.assign=Re;Ue.fmtNum=fi;Ue.rangeNum=Mo;Ue.rangeLog=Eo;Ue.rangeAsinh=ui;Ue.orient=_n;Ue.pxRatio=de;Ue.join=gd;Ue.fmtDate=gi,Ue.tzDate=Ed;Ue.sync=Mc;{Ue.addGap=
hf,Ue.clipGaps=Co;let t=Ue.paths={points:Cc};t.linear=Dc,t.stepped=df,t.bars=ff,t.spline=gf}var Ro=128,Fc=50,Ef=.25,Pf=t=>[t.ray,t.truth,t.sensor,t.noReturn],_f=(t,e)=>Math.max(40,14+6.6*Math.max(0,...(e??[]).map(n=>n?.length??0))),Cf=({data:t})=>Math.
max(10,4+3.3*(t?.[0]?.at(-1)??0).toLocaleString("en").length),$o=(t,e)=>({font:ao,size:e,stroke:()=>t().axis,grid:{stroke:()=>t().lines,width:1},ticks:{stroke:()=>t().
frame,width:1,size:4}});function Ic(t,e,n){let s=null,o=null,r=()=>Math.floor(t.clientWidth);return new ResizeObserver(()=>s&&r()>0&&s.setSize({width:r(),height:Ro})).
observe(t),i=>r()<=0?null:((!s||i||o!==n())&&(s?.destroy(),s=e(),s.setSize({width:r(),height:Ro}),o=n()),s)}function Oc(t,e){let{session:n}=t,s=k("div",{className:"\
chart",role:"img","aria-label":"Trace: log joint by sweep"}),o="all",r=t.segmented("Trace",[["all","All"],["first",`First ${Fc}`]],()=>o,w=>{o=w,c=null,n.changed()}),
i=0,a=-1/0,l=-1,c=null,u=Ic(s,()=>{let w=Pf(e()),b=Array.from({length:i},(S,T)=>({label:`chain ${T+1}`,stroke:w[T%w.length],width:1,points:{show:!1}}));return new Ue(
{width:100,height:Ro,legend:{show:!1},cursor:{drag:{x:!1,y:!1},y:!1},padding:[8,Cf,0,0],scales:{x:{time:!1,range:(S,T,v)=>[T,Math.max(v,T+1)]},y:{range:(S,T,v)=>Rf(
Math.max(T,a),v)}},axes:[$o(e,26),$o(e,_f)],series:[{label:"sweep"},...b],hooks:{draw:[S=>Ff(S,l,e()),S=>$f(S,c?.burned??0,e())]}},[[],...b.map(()=>[])],s)},e),
d=k("span",{className:"caption",textContent:"log joint by sweep"}),m=k("div",{className:"charted"},k("div",{className:"buttons"},r,d),s);return t.each(()=>{let w=n.
shown,b=w?.traced?.length?w.trace.length/w.traced.length:0;if(C(m,"hidden",b===0&&(m.hidden||!n.working)),!w||!b)return;let S=n.document?.source.kind==="run"?"d\
raw":"sweep";C(d,"textContent",`log joint by ${S}`);let T=w.layer==="draw"&&n.draws.count?(n.draw+1)*w.traced[w.traced.length-1]/n.draws.count:-1,v=u(b!==i&&(i=
b,!0));if(!v||c===w&&l===T&&v.data[0].length)return;[c,l]=[w,T],a=o==="all"?Nf(w,b):-1/0;let A=Lf(w,b,o);v.setData(A),s.setAttribute("data-sweeps",A[0].join())}),
m}function Lf({trace:t,traced:e},n,s){let o=s==="all"?Df(e):[...e.keys()].filter(i=>e[i]<=Fc),r=i=>Float32Array.from(o,a=>i[a]);return[r(e),...Array.from({length:n},
(i,a)=>r(t.subarray(a*e.length,(a+1)*e.length)))]}function Df(t){let e=t.length,n=e>2?Math.min(t[e-1]-t[e-2],t[e-2]-t[e-3]):1,s=-1/0;return[...t.keys()].filter(
o=>t[o]<s&&o<e-1?!1:(s=t[o]+n,!0))}function Nf({trace:t,traced:e},n){let s=e.length,o=e.findIndex(r=>r>=Ef*e[s-1]);return Math.min(...Array.from({length:n},(r,i)=>Math.
min(...t.slice(i*s+o,(i+1)*s))))}function Rf(t,e){let n=Math.max(.06*(e-t),.5);return[t-n,e+n]}function $f(t,e,n){let{left:s,top:o,width:r,height:i}=t.bbox;e&&(t.
ctx.save(),t.ctx.globalAlpha=.12,t.ctx.fillStyle=n.axis,t.ctx.fillRect(s,o,Math.min(r,Math.max(0,t.valToPos(e,"x",!0)-s)),i),t.ctx.restore())}function Ff(t,e,n){
if(e<0)return;let{left:s,top:o,width:r,height:i}=t.bbox,a=t.valToPos(e,"x",!0);a<s||a>s+r||(t.ctx.save(),t.ctx.fillStyle=n.axis,t.ctx.fillRect(a-1,o,2,i),t.ctx.
restore())}function Uc(t,e){let{session:n}=t,s=k("div",{className:"chart",role:"img","aria-label":"Histogram of the particles' weights"}),o=k("div",{className:"\
caption",textContent:"particles by weight, nats below the heaviest"}),r=k("div",{className:"charted"},o,s),a=Ic(s,()=>new Ue({width:100,height:Ro,legend:{show:!1},
cursor:{show:!1},padding:[8,10,0,0],scales:{x:{time:!1,range:(c,h,u)=>[h,u]},y:{distr:3,range:(c,h,u)=>[.5,Math.max(10,2*u)]}},axes:[$o(e,26),{...$o(e,52),values:(c,h)=>h.
map(u=>u>=1?String(u):"")}],series:[{},{fill:e().ray,stroke:e().ray,paths:Ue.paths.bars?.({size:[.9,100],align:1}),points:{show:!1}}]},[[],[]],s),e),l=null;return t.
each(()=>{let c=n.shown;C(r,"hidden",!c?.weights);let h=c?.weights&&a(!1);if(!c?.weights||!h||l===c&&h.data[0].length)return;l=c;let u=[...c.weights],d=-(c.lowest??
-1)/u.length,m=[...u.map((w,b)=>(c.lowest??-1)+b*d),0];h.setData([m,[...u.map(w=>w||null),null]])}),r}function Wc(t){let{session:e,hand:n}=t,{decisions:s}=e,o=k("p",{className:"said",role:"status"}),r=k("div",{className:"double"},t.numberInput("Robot's radius (m\
)",()=>s.radius,c=>s.set({radius:c}),{step:"any",limits:"radius"}),t.numberInput("Highest risk",()=>s.risk,c=>s.set({risk:c}),{step:"any",limits:"risk"})),i=()=>n.
tool==="path"?"Path":"Where to look next",a=t.section("Decision",r,o),l=a.querySelector("h2");return t.visible(a,()=>n.tool==="path"||n.tool==="look"),t.visible(
r,()=>n.tool==="path"),t.each(()=>{C(l,"textContent",i()),C(o,"textContent",n.tool==="path"?If(t):Of(t))}),a}function If({session:t}){let{start:e,goal:n,path:s,
trouble:o}=t.decisions;if(o)return o;if(!e)return"Click where the robot is, then where it is to go.";if(!n)return"Now click where it is to go.";if(!s)return t.shown?.
approximate?"Waiting for draws of the map.":"Looking for a path.";let r=s.within_risk?"":" No path was found whose risk is low enough; this is the safest.";return`${me(
s.length_m,2)} m, free with probability ${me(s.probability,3)} ± ${me(s.standard_error,3)} by ${s.draws} draws. Independent cells would say ${me(s.independent,
3)}.${r}`}function Of({session:t}){let{views:e,viewTrouble:n}=t.decisions;if(n)return n;if(!e)return"Working out how much a scan would tell.";let s=Math.max(...e.
nats),o=t.editable?" Click to place another sensor.":"";return`One more scan would tell ${me(Math.min(...e.nats),1)} to ${me(s,1)} nats, cells taken for indepen\
dent; the best place has a ring.${o}`}var Uf=[["tutorial","the tutorial's map"],["building","a building"],["blank","blank"]],Wf="Draw walls, and drag the robot: a beam reads the first wall that it h\
its, with noise.",Bf="Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt\
 remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Gf="Shown is what the reading\
s tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (wi\
dth). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.",Hf="While you edit, the answer is belief pr\
opagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",zf="This page samples by itself: the answer is that of the chosen method\
 after as many sweeps as are shown, and gets better as they go on.",Vf="The map is made from the scans of this log. Where its poses are raw odometry, Run first \
infers where the robot was; then it samples maps.",jf="This is a saved run: its draws, and what they say together.",Yf="Mouse: the wheel zooms, the middle butto\
n pans.",qf="Shift or the right button erases, and so does a click on a wall.",Kf="Touch: two fingers zoom and pan.";function Bc(t){let{session:e}=t,n=k("div"),
s=Ua.map(([i,a,l])=>{let c=k("tr",{},k("th",{scope:"row"},k("kbd",{textContent:i})),k("td",{textContent:a}));return t.visible(c,()=>Jf[l??"all"](e)),c}),o=k("p"),
r="";return t.each(()=>{let i=e.document?.source.kind,a=e.quantity.interval?Gf:Bf,l=e.editable?[`${Wf} ${a}`,e.figure?zf:Hf]:i==="log"?[a,Vf]:i==="run"?[a,jf]:[
a];l.join()!==r&&n.replaceChildren(...l.map(c=>k("p",{textContent:c}))),r=l.join(),C(o,"textContent",[Yf,...e.editable?[qf]:[],Kf].join(" "))}),t.dialog("Help",
n,o,k("table",{},k("tbody",{},...s)))}var Jf={all:()=>!0,drawn:t=>t.editable,asked:t=>t.answers,edited:t=>!t.recorded,inferred:t=>!t.recorded&&t.document?.source.
kind!=="run"};function Gc(t){let e=()=>k("input",{type:"number",step:1,required:!0,value:"21"}),[n,s]=[e(),e()];for(let i of[n,s])t.bounded(i,"side");let o=k("s\
elect",{});for(let[i,a]of Uf){let l=k("option",{value:i,textContent:a});o.append(l),i!=="blank"&&t.each(()=>C(l,"disabled",t.session.figure))}t.each(()=>t.session.
figure&&C(o,"value","blank")),o.addEventListener("change",()=>{o.value==="building"&&Number(n.value)<60&&([n.value,s.value]=["120","80"])});let r=k("form",{method:"\
dialog"},t.row("World",o),t.row("Width (cells)",n),t.row("Height (cells)",s),k("div",{className:"buttons end"},k("button",{type:"submit",className:"primary",textContent:"\
Create"})));return r.addEventListener("submit",()=>{t.session.act({type:"new",shape:[Number(n.value),Number(s.value)],world:o.value}),t.hand.selected=null}),t.dialog(
"New map",r)}var Xf="The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server runs; the part \
from # on can be put after the address of any bayesmap page.",Zf="The link holds the walls, the sensors and all settings after its #. The part from # on can be \
put after the address of any bayesmap page.",Qf="The link holds the file's name and all settings after its #, but no scans and no token. It opens in this browse\
r while the server shows this file; the part from # on can be put after the address of any bayesmap page that shows it.";function Hc(t){let e=k("input",{type:"t\
ext",readOnly:!0,"aria-label":"Link"}),n=k("span",{role:"status",className:"copied"}),s=async()=>{e.select();try{await navigator.clipboard.writeText(e.value)}catch{
document.execCommand("copy")}n.textContent="Copied",setTimeout(()=>n.textContent="",2e3)},o=t.button(null,"Copy the link",s,{className:"primary",text:"Copy"}),r=k(
"p");t.each(()=>C(r,"textContent",t.session.figure?Zf:t.session.document?.source.kind==="simulation"?Xf:Qf));let i=t.dialog("Share",r,k("div",{className:"button\
s"},e,o),n);return{dialog:i,show(a){e.value=a,i.showModal(),e.select()}}}var em=8;function zc(t){let{session:e,hand:n}=t,s=k("p",{className:"words",role:"status"}),o=k("ol",{className:"spoken"}),r=t.section("Evidence of beams",s,o),i=-1;
return t.visible(r,()=>n.tool==="evidence"),t.each(()=>{let{evidence:a}=e;if(C(s,"textContent",nm(e)),i===a.version)return;i=a.version;let{nats:l,scan:c,beam:h}=a.
each??{nats:[],scan:[],beam:[]},u=Array.from(l.slice(0,em),(d,m)=>k("li",{},`${Wr(d)} nats: ${tm(e,c[m],h[m])}`));o.replaceChildren(...u)}),r}var tm=({document:t,
editable:e},n,s)=>`beam ${s+1} of ${e?`sensor ${t?.sensors[n]?.id??n+1}`:`scan ${n+1}`}`;function nm({evidence:t,quantity:e}){let{cell:n,together:s}=t;if(!n)return"\
Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";let o=`Cell ${n.x}, ${n.y}`;if(!s)return`${o}: aski\
ng its beams.`;if(!s.beams)return`${o}: no beam reaches it.`;let r=s.beams===1?"1 beam":`${s.beams} beams`;if(s.nats_for===null||s.nats_against===null)return`${o}\
: ${r}; there are no draws to ask what they say.`;let i={binary:"a wall",surface:"its surface"}[e.kind]??"what is there",a=s.beams_for||s.beams_against?"":" Non\
e of them says anything.";return`${o}: ${r}. For ${i} (blue) ${s.beams_for}, ${s.nats_for.toFixed(1)} nats; against (orange) ${s.beams_against}, ${s.nats_against.
toFixed(1)} nats.${a}`}var Zt=t=>t.charAt(0).toUpperCase()+t.slice(1),Fo=class{text="Connecting";level="info";until=0;say(e,n,s){this.text=Zt(e),this.level=n,this.until=s}confirmed(e){
let n=e>this.until&&!/worker/.test(this.text);(this.text==="Connecting"||n)&&this.say("Ready","info",e)}worker(e){e==="restarted"?this.say("The worker stopped a\
nd is being started again; the map is kept","warning",this.until):e==="ready"&&this.text==="Connecting"?this.say("Ready","info",this.until):e==="ready"&&/worker/.
test(this.text)&&this.say("The worker runs again","info",this.until)}};var Vc=t=>Math.round(t*180/Math.PI);function jc(t){let{session:e,hand:n}=t,{ghost:s}=e,o=(l,c)=>t.numberInput(l,()=>Number((s.pose?.[c]??0).toFixed(2)),h=>s.move(
{[c]:h}),{step:"any"}),r=t.numberInput("Ghost yaw (°)",()=>Vc(s.pose?.yaw??0),l=>s.move({yaw:l*Math.PI/180}),{step:5}),i=k("p",{className:"words ghosted"}),a=t.
section("Ghost",k("div",{className:"triple"},o("Ghost x","x"),o("Ghost y","y"),r),i);return t.visible(a,()=>n.tool==="ghost"),t.each(()=>C(i,"textContent",sm(t))),
a}function sm({session:t}){let{ghost:e}=t;if(e.trouble)return Zt(`${e.trouble}.`);if(!e.fan)return e.pose?"Working out what its laser would read.":"Drag the gho\
st to see what its laser would read.";let{draws:n,low:s,high:o,near:r}=e.fan,i=Array.from(o,(h,u)=>h-s[u]).filter(Number.isFinite).sort((h,u)=>h-u),a=i.length?`${me(
100*i[i.length>>1],0)} cm wide at the median beam`:"as wide as the laser's range",l=n?`${n} draws of the map`:"the mean map, cells taken for independent",c=r?` \
Rings are the hits of scan ${r.index+1}, taken ${me(100*r.away,0)} cm from here, turned by ${Vc(r.turn)}°.`:"";return`Dots are predictive medians, bars the cen\
tral 80 % interval, ${a}, by ${l}.${c}`}function Yc(t){let{session:e}=t,n=k("span",{className:"what"});t.each(()=>{let{grid:c,source:h}=e.document??{};if(!c||!h)return;let u=`${c.shape[0]} × ${c.shape[1]}\
 cells of ${+c.resolution.toPrecision(3)} m`;C(n,"textContent",h.name?`${h.name}, ${u}`:u)});let s=()=>!e.recorded&&!!e.document,o=[t.button("undo","Undo",()=>e.
act({type:"undo"}),{title:"Undo (Ctrl+Z)",when:()=>!!e.state?.can_undo,why:"Nothing of this page to undo"}),t.button("redo","Redo",()=>e.act({type:"redo"}),{title:"\
Redo (Ctrl+Y)",when:()=>!!e.state?.can_redo,why:"Nothing to redo"}),k("span",{className:"gap"}),t.button("grid","New map",()=>t.command("new"),{text:"New map",when:s}),
...t.embedded?[]:[t.button("link","Share",()=>t.command("share"),{text:"Share",when:s})]];for(let c of o)t.visible(c,()=>!e.recorded);let r=t.button("theme","Th\
eme: automatic",()=>t.command("theme")),i=t.button("help","Help",()=>t.command("help"),{title:"Help (?)"}),a=k("span",{className:"space"});return{element:k("hea\
der",{},k("h1",{textContent:"bayesmap"}),n,a,...o,rm(t),r,i),nameTheme(c){let h=`Theme: ${c}`;st(r,"aria-label",h),C(r,"title",h)}}}var om=({shown:t,draws:e})=>e.
count>0||/importance|propagate/.test(t?.method??"");function rm(t){let{session:e}=t,n=(l,c,h,u,d)=>{let m=t.button(null,l,()=>t.command(`export ${c}`),{text:l,when:u,
why:d});return h!=="all"&&t.visible(m,()=>!e.recorded&&(h==="document"||!e.figure)),m},s=n("Figure that samples by itself (HTML)","figure","server");t.visible(s,
()=>e.editable&&!e.figure);let o=k("div",{className:"menu",hidden:!0},n("Picture (PNG)","png","all"),n("Saved run (netCDF)","run","server",()=>om(e),"There are \
no draws yet: chains keep them"),n("Map for robots (YAML and PGM)","map","server"),n("Page in one file (HTML)","html","server"),s,n("Document (JSON)","document",
"document")),r=t.button("save","Export",()=>i(o.hidden),{text:"Export",when:()=>!!e.document}),i=l=>{o.hidden=!l,r.setAttribute("aria-expanded",String(l)),l&&o.
firstElementChild.focus()};i(!1);let a=k("div",{className:"anchor"},r,o);return a.addEventListener("keydown",l=>{l.key!=="Escape"||o.hidden||(i(!1),r.focus(),l.
stopPropagation())}),a.addEventListener("focusout",l=>{a.contains(l.relatedTarget)||i(!1)}),o.addEventListener("click",()=>{i(!1),r.focus()}),a}var im={draw:"M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",erase:"M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",sensor:"M12 3l7 17-7-4-7 4z",pan:"M12 3v18M3 12h18M9.\
5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",path:"M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",look:"\
M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",where:"M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a\
2 2 0 1 0 .1 0",ghost:"M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",evidence:"M3 5l13 7M3 19l13-7M3 12h13M17 8.\
500h4.500v7H17z",undo:"M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",redo:"M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",plus:"M12 5v14M5 12h14",minus:"M5 12h14",fit:"\
M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",play:"M7 4.5l12 7.5-12 7.5z",pause:"M8.5 5v14M15.5 5v14",link:"M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 \
4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",save:"M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",grid:"M4 4h16v16H4zM4 12h16M12 4v16",theme:"M12 3a9 9 0 1 0 0 18zM12 3a\
9 9 0 0 1 0 18",help:"M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",close:"M6 6l12 12M18 6L6 18"};function hn(t){let e=document.createElementNS(
"http://www.w3.org/2000/svg","svg"),n=document.createElementNS("http://www.w3.org/2000/svg","path");return e.setAttribute("viewBox","0 0 24 24"),e.setAttribute(
"aria-hidden","true"),n.setAttribute("d",im[t]),e.append(n),e}var Io=({document:t})=>!t||t.source.kind==="simulation",Mi=({answers:t})=>t,qc="surface (zoom in)",Kc=[{mark:"truth",text:"true wall",when:Io,may:Io},{mark:"ray",
text:"ray"},{mark:"miss",text:"no return"},{mark:"dot",text:"reading"},{mark:"sensor",text:"sensor"},{mark:"stroke",text:"surface",when:({overlay:t})=>!!t?.strokes.
length,may:t=>!Io(t)},{mark:"trajectory",text:"trajectory",when:({overlay:t})=>!!t?.trajectory.length,may:t=>!Io(t)},{mark:"unobserved",text:"unobserved"},{mark:"\
draw",text:"this draw",when:({flicker:t})=>!!t.under},{mark:"ghost",text:"predicted reading",when:({ghost:t,reading:e})=>t.held||e.picked!==null,may:Mi},{mark:"\
path",text:"path, as wide as the robot",when:({decisions:t})=>!!(t.path&&t.pathShown),may:Mi}],Jc=[{mark:"belief",text:"possible pose"},{mark:"place",text:"95 %\
 of a place"}],Xc=[{mark:"for",text:"speaks for it"},{mark:"against",text:"speaks against it"}];function Zc(t,e,n){let s=k("p",{className:"sentence"});return t.
each(()=>C(s,"textContent",am(t.session))),k("div",{className:"legend"},s,lm(t,e,n),cm(t))}var Si=(t,e)=>`${t.toLocaleString("en")} ${e}${t===1?"":"s"}`;function am(t){
let{shown:e,document:n,layer:s,quantity:o,draws:r}=t;if(!e||!n)return"";let{kind:i,mean:a,value:l}=o,c={mean:i==="binary"?"How probable a wall is in each cell":
Zt(`${a} of each cell`),draw:`One map drawn from the posterior${i==="binary"?"":`, by its ${l}`}${r.count?`, ${t.draw+1} of ${r.count}`:""}`,entropy:"How uncert\
ain each cell is, in bits",width:"How wide the 90 % interval of each cell is"}[s];if(e.method==="none")return`${c} before any reading: the prior.`;let{source:h,
angles:u,sensors:d,scans_used:m}=n,w=h.kind==="simulation"?`${Si(u*d.length,"beam")} of ${Si(d.length,"sensor")}`:Si(m??h.scans,"scan"),S=(e.method==="propagate"||
e.method==="pilot"||/hits|counts/.test(e.method))&&e.approximate?", approximately":s!=="draw"&&e.burned?`: the mean of the sweeps after the first ${e.burned}`:"";
return`${c}, given ${w}${S}.`}function lm(t,e,n){let{session:s}=t,o=k("span",{className:"ramp"}),r=k("span",{className:"name"}),i=Kc.map(h=>{let[u,d]=Oo(h),{mark:m,
when:w}=h;return w&&t.visible(u,()=>w(s)),m==="stroke"&&t.each(()=>C(d,"textContent",Ds(n())?h.text:qc)),m==="path"&&t.each(()=>u.firstElementChild?.classList.toggle(
"risky",s.decisions.path?.within_risk===!1)),u}),[a,l]=[Jc,Xc].map(h=>h.map(u=>Oo(u)[0]));for(let h of a)t.visible(h,()=>!!s.where.found);for(let h of l)t.visible(
h,()=>!!s.evidence.cellShown);let c="";return t.each(()=>{let{layer:h}=s;C(r,"textContent",Qc(s,h));let u=h==="entropy"||h==="width",d=`${u} ${e().ground}`;c!==
d&&(c=d,o.style.background=Or(u?es:m=>Ir(e(),m)))}),k("ul",{"aria-label":"Legend"},k("li",{},r,k("span",{className:"scale"},"0",o,"1")),...i,hm(t),...a,...l)}function cm(t){
let{session:e}=t,n=["mean","draw","entropy","width"].map(c=>{let h=k("span");return t.each(()=>C(h,"textContent",Qc(e,c))),c==="width"&&t.visible(h,()=>e.quantity.
interval),h}),s=Kc.map(c=>{let[h,u]=Oo(c);c.mark==="stroke"&&(u.textContent=qc);let{may:d}=c;return d&&t.visible(h,()=>d(e)),h}),o=k("span",{className:"scale"},
"00.0",k("span",{className:"ramp"}),"000.0 nats"),r=[Jc,Xc].map(c=>k("ul",{},...c.map(h=>Oo(h)[0]))),i=[k("ul",{},k("li",{},"one more scan tells",o)),...r],a=k(
"li",{className:"either"},...i);t.visible(a,()=>Mi(e));let l=k("span",{className:"scale"},"0",k("span",{className:"ramp"}),"1");return k("ul",{className:"room",
"aria-hidden":"true"},k("li",{},k("span",{className:"name either"},...n),l),...s,a)}function Oo({mark:t,text:e}){let n=k("i",{className:t});t==="sensor"&&n.append(
hn("sensor"));let s=k("span",{textContent:e});return[k("li",{},n,s),s]}function Qc({quantity:t},e){let{kind:n,mean:s,value:o}=t;return e==="entropy"?"entropy (b\
it)":e==="width"?"width of the 90 % interval":n==="binary"?"P(wall)":e==="draw"?o:s}function hm(t){let{decisions:e}=t.session,n=k("span",{className:"ramp"});n.style.
background=Or(es);let[s,o]=[k("span"),k("span")],r=k("li",{className:"views"},"one more scan tells",k("span",{className:"scale"},s,n,o));return t.visible(r,()=>e.
looking&&!!e.views?.nats.length),t.each(()=>{let i=e.views?.nats;i?.length&&(C(s,"textContent","0"),C(o,"textContent",`${me(Math.max(...i),1)} nats`))}),r}var pm=[.05,.1,.2,.4,.8],um=t=>t<1?`${+(100*t).toPrecision(3)} cm`:`${+t.toPrecision(3)} m`;function eh(t){let{session:e}=t,n=k("select",{onchange:()=>e.act({type:"\
set",patch:{resolution:Number(n.value)}})}),s="";t.each(()=>{let{grid:r,source:i}=e.document??{};if(!r||i?.kind!=="log"||!i.bounds)return;let[a,l]=i.bounds,c=Math.
max(l[0]-a[0],l[1]-a[1]),h=[...new Set([...pm,r.resolution])].sort((d,m)=>d-m),[,u]=t.limits("side_of_log");if(s!==`${h} ${u}`){s=`${h} ${u}`;let d=m=>k("option",
{value:String(m),textContent:um(m),disabled:c/m>u-1});n.replaceChildren(...h.map(d))}C(n,"value",String(r.resolution))});let o=t.row("Cell size",n);return t.visible(
o,()=>e.document?.source.kind==="log"),o}function th(t){let{session:e}=t,n=k("input",{type:"range",min:1,step:1,"aria-label":"Scans used"}),s=k("output"),o=()=>e.
document?.source.scans??0,r=a=>{let l=Number(n.value);t.scrub(l>=o()?null:l,a)};n.addEventListener("input",()=>r(!0)),n.addEventListener("change",()=>{r(!1),t.endDrag()});
let i=t.section("Log",k("div",{className:"player bare"},n,s));return t.visible(i,()=>!e.recorded&&e.document?.source.kind==="log"&&o()>1),t.each(()=>{let a=o(),
l=e.document?.scans_used??a;C(n,"max",String(Math.max(1,a))),(!Sn(n)||Number(n.value)!==l)&&C(n,"value",String(l));let c=l===a?`all ${a} scans`:`after ${l} of ${a}`;
n.style.setProperty("--fill",`${100*(l-1)/Math.max(1,a-1)}%`),st(n,"aria-valuetext",c),C(s,"textContent",c)}),i}var dm=20,fm={importance:"particles",propagate:"rounds"},Uo=({working:t,shown:e})=>t&&e?.method==="pilot";function nh(t,...e){let{session:n}=t,s=k("progress",{max:1,
value:0,"aria-label":"Progress"}),o=k("div",{className:"doing"});return t.each(()=>{let r=n.shown,{stage:i}=n,a=r?.generation!==n.generation&&(n.running||n.document?.
source.kind==="log"),l=Uo(n),c=i?i.done/i.total:r&&!a&&r.total>0&&(l||!r.approximate)?r.sweeps/r.total:0;C(s,"value",c);let h=n.remaining_s(),u=fm[r?.method??""]??
"sweeps",d=r&&!r.approximate&&r.total?`${r.sweeps} of ${r.total} ${u}`:"",m=h!==null?h<1?"less than 1 s left":`${Math.ceil(h)} s left`:n.running?"running":"",w=d&&
r?.burned?`the first ${r.burned} left out`:"",b=n.sampling||n.running||!r||r.sweeps>=r.total?"":"stopped";i?C(o,"textContent",`${i.text}: ${i.done} of ${i.total}\
 ${i.total>dm?"scans":"rounds"}`):a?C(o,"textContent","Computing"):r&&l?C(o,"textContent",`Fitting the sensor: sweep ${r.sweeps} of ${r.total}`):C(o,"textConten\
t",Zt([d,w,m,d&&b].filter(Boolean).join(", "))||mm(n))}),t.section("Posterior",gm(t),s,o,ym(t),bm(t),...e,wm(t))}function mm({shown:t,working:e,document:n}){let s=n?.
method==="importance"?"; Run weighs particles":"";return t?.method==="propagate"?`${t.sweeps} rounds of belief propagation${s}`:t?.method==="hits"?"Counts of hi\
ts and passes":t?.method==="counts"?"Run infers where the robot was":t?.method==="pilot"?"Stopped while the sensor was fitted":e?"Computing":"No chain yet"}function gm(t){
let{session:e}=t,n=t.button("play","Run",()=>e.act({type:"run"}),{className:"primary",text:"Run",title:"Run (R): more sweeps of the chains on show",when:()=>e.connection.
connected,why:"Not while the connection is lost"}),s=t.button("close","Cancel",()=>e.act({type:"cancel"}),{text:"Cancel",title:"Cancel (Escape)",when:()=>e.running||
e.sampling||Uo(e),why:"Nothing is running"}),o=t.checkbox("Live",()=>!!(e.state?.live??!0),i=>e.act({type:"live",on:i}),"Every edit restarts the chains, and Run\
 goes on from their draws"),r=k("div",{className:"buttons"},n,s,o);return t.visible(r,()=>!e.recorded&&e.document?.source.kind!=="run"),r}function ym(t){let{session:e}=t,
n=k("dl"),s=(r,i,a,l=!1)=>{let c=k("dd",{textContent:"–"}),h=k("div",{title:i},k("dt",{textContent:r}),c);return n.append(h),t.each(()=>{C(c,"textContent",e.shown?
a(e.shown):"–"),l&&C(c,"className",e.shown?.verdict?.level??"")}),h};s("ESS","Effective sample size of the log joint",r=>me(r.ess,0),!0),s("R-hat","Agreement \
of the chains on the log joint; 1 is full",r=>me(r.rhat,3),!0),s("log joint","Log of prior times likelihood at the last sweep",r=>me(r.log_joint,Math.abs(r.log_joint??
0)<1e5?1:0)),s("time","Time spent on sweeps, rounds or particles",r=>me(r.seconds,1," s"));let o=s("reply","From the hand's last move to its picture",()=>me(e.latency.
eventToPaint_ms.at(-1),0," ms"));return t.visible(o,()=>!e.recorded),n}var Ti=({shown:t})=>t?.method==="importance"?{good:"Enough particles",fair:"Few particles",
bad:"Collapsed"}:{good:"Converged",fair:"Nearly converged",bad:"Not converged"};function wm(t){let{session:e}=t,n=k("dl",{className:"about"}),s=k("details",{},k(
"summary",{textContent:"Model and method of this picture"}),n),o="";return t.each(()=>{let r=e.shown?.about??[];C(s,"hidden",!r.length),String(r)!==o&&(o=String(
r),n.replaceChildren(...r.flatMap(([i,a])=>[k("dt",{textContent:i}),k("dd",{textContent:a})])))}),s}function bm(t){let{session:e}=t,n=k("span"),s=t.button(null,
"Show the cell",()=>t.command(`cell ${e.shown?.verdict?.cell}`),{text:"Show the cell"});t.visible(s,()=>!!e.shown?.verdict?.cell);let o=k("div",{className:"verd\
ict"},n,s);return t.each(()=>{let r=e.shown?.verdict;if(!r)return C(o,"hidden",o.hidden||!e.working),C(n,"textContent","Too early to judge."),C(o,"className","v\
erdict early");C(o,"hidden",!1),C(n,"textContent",`${Ti(e)[r.level]}: ${r.why}`),C(o,"className",`verdict ${r.level}`)}),o}var xm="The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.",sh=200,
vm="For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less \
likely",oh="For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied \
(log ratio), summed over the beams that it makes likelier, and less likely",km="Emptied means without the surface that the cell owns: where a neighbour's surfac\
e explains the same readings, they say little of this one.";function ah(t){let{session:e}=t,n=k("span",{className:"chip"}),s=t.button(null,"Not converged",()=>rh(
e)?.apply?.(),{text:"Not converged",className:"chip doubt"}),o=k("div",{className:"chips"},n,s);return t.each(()=>{let r=rh(e);if(C(s,"hidden",!r),r){let d=[Ti(
e).bad,r.text].filter(Boolean).join(": ");C(s.firstElementChild,"textContent",d.charAt(0).toLowerCase()+d.slice(1)),C(s,"title",`${e.shown?.verdict?.why}.${r.apply?
` Click to ${r.text}.`:""}`),C(s,"disabled",!r.apply),st(s,"aria-label",d)}let i=e.shown;if(!i||!e.document)return C(o,"hidden",!0);let a=e.draws.count?`draw ${e.
draw+1} of ${e.draws.count}`:"draw",l=i.layer==="draw"?a+(e.flicker.under?" over the mean":""):i.layer==="width"?"width of the 90 % interval":e.view.layer==="en\
tropy"?"entropy":"mean";if(i.method==="counts"){C(o,"hidden",!1);let d=e.halfway?"along poses found so far":"along raw odometry";return C(n,"textContent",`hits \
and passes · ${e.stage?e.stage.text.toLowerCase():d}`),C(n,"className","chip approximate")}let c={importance:"importance sampling",propagate:"belief propagatio\
n"}[i.method],h=e.document.method==="importance"&&i.method==="propagate"?", until Run weighs particles":"",u=i.approximate?`approximate, ${Sm(i,e.working)}${h}`:
c??`${i.sweeps} sweeps`;C(o,"hidden",!1),C(n,"textContent",`${l} · ${u}`),C(n,"className",i.approximate?"chip approximate":"chip")}),o}function Sm({method:t,sweeps:e,
total:n,averaged:s},o){return t==="hits"?"counts of hits":t!=="pilot"?"belief propagation":`${s===1?"1 draw":`${s} draws`} of one chain, sensor ${o?"being":"hal\
f"} fitted: sweep ${e} of ${n}`}function rh(t){let{shown:e,document:n}=t;if(e?.verdict?.level!=="bad"||!n)return null;if(t.recorded||n.source.kind==="run")return{
text:""};let s=a=>()=>t.act({type:"set",patch:a}),o=e.sweeps<sh,r=n.pose_sigma===0&&n.heading_sigma===0;if(e.method==="gibbs"&&n.source.kind==="simulation"&&!o&&
r)return{text:"try blocks",apply:s({method:"block"})};if(e.method==="importance")return{text:"try Gibbs",apply:s({method:"auto"})};if(e.sweeps<e.total)return null;
if(!r&&!o)return{text:"poses are too uncertain"};let i=Math.min(t.limits?.sweeps[1]??0,Math.max(sh,4*n.sweeps));return i>n.sweeps?{text:`try ${i} sweeps`,apply:s(
{sweeps:i})}:{text:""}}function lh(t){let{session:e}=t,n=k("span"),s=t.button(null,"Reconnect now",()=>e.transport.retry?.(),{text:"Reconnect now"}),o=k("div",{
className:"banner",role:"alert",hidden:!0},n,s);return t.each(()=>{let r=e.everConnected&&!e.connection.connected,i=Math.max(1,Math.round((e.connection.retryIn_ms??
0)/1e3));C(o,"hidden",!r&&e.worker!=="restarted"),C(o,"className",r?"banner":"banner mild"),C(s,"hidden",!r);let a=`Connection lost. Trying again in ${i} s; the\
 map is kept here.`,l=e.connection.refused?xm:a;C(n,"textContent",r?l:"The worker stopped and is being started again. The map is kept.")}),o}function ch(t){let{
session:e,hand:n}=t,s=k("div",{className:"readout",id:`${t.prefix}-readout`}),o=k("span",{role:"status","aria-live":"polite"}),r=k("span",{className:"hidden","a\
ria-live":"polite"});return n.announce=i=>C(r,"textContent",i),n.describe=i=>ih(e,i),t.each(()=>{let{kind:i}=e.quantity;C(s,"title",i==="binary"?vm:i==="surface"?
`${oh}. ${km}`:oh);let a=n.cursor??n.hover,c=matchMedia("(pointer: coarse)").matches?"Touch a cell":e.editable?"Point at a cell, or press ? for the keys":"Point\
 at a cell";C(s,"textContent",a?ih(e,a):c);let h=e.status.text==="Ready"&&e.shown?.verdict?.level==="bad",u=e.status.text==="Ready"&&Uo(e),d=e.shown?.method==="\
importance"?"Ready, but importance sampling has collapsed":"Ready, but the chains have not converged",m=e.everConnected&&!e.connection.connected&&e.status.level===
"info";C(o,"textContent",m?"Connection lost":h?d:u?"Fitting the sensor":e.status.text),C(o,"className",m?"error":h?"warning":u?"busy":e.status.level)}),{element:k(
"footer",{},o,s,r),readout:s}}function ih(t,e){let{document:n,shown:s}=t;if(!n)return"";let{resolution:o,shape:r}=n.grid,i=e.x*r[1]+e.y,a=Math.max(1,Math.ceil(-Math.
log10(o))+1),{x:l,y:c}=Xn(e,n.grid),h=[`Cell ${e.x}, ${e.y}`,`${l.toFixed(a)}, ${c.toFixed(a)} m`];if(s&&s.p.length===r[0]*r[1]){let u=s.p[i]/255,{kind:d,mean:m,
value:w,interval:b}=t.quantity;s.layer==="width"?h.push(`90 % interval ${u.toFixed(2)} wide`):d!=="binary"&&s.layer==="draw"?h.push(`${w} ${u.toFixed(2)} in thi\
s draw`):d!=="binary"?h.push(`${m} ${u.toFixed(2)}`,...b?[]:[`entropy ${Ls(u).toFixed(2)} bit`]):s.layer==="draw"?h.push(u>.5?"wall in this draw":"free in this \
draw"):h.push(`P(wall) ${u.toFixed(2)}`,`entropy ${Ls(u).toFixed(2)} bit`);let S=t.evidence.facts,T=S?.x===e.x&&S.y===e.y?S:null,v=T?T.beams:null,A=s.reached[i]/
255,E=n.source.kind==="run";if(A?!E&&A<.995&&h.push(`reached by a beam with probability ${A.toFixed(2)}`):h.push(E?"reached by a beam in less than half of the d\
raws":"unobserved"),A&&v!==null&&h.push(v===1?"1 beam":`${v} beams`),A&&T&&T.nats_for!==null&&T.nats_against!==null&&v){let L={binary:"a wall",surface:"its surf\
ace"}[t.quantity.kind]??"what is there";h.push(`for ${L} ${T.beams_for}, ${T.nats_for.toFixed(1)} nats`,`against ${T.beams_against}, ${T.nats_against.toFixed(1)}\
 nats`)}}return h.join(" · ")}var Mm={logged:"as logged",odometry:"from raw odometry"},Tm=180/Math.PI;function hh(t){let{session:e}=t,n=()=>e.document?.source.kind==="log",s=t.select("Poses",
Mm,()=>e.document?.poses??"logged",a=>t.set({poses:a}));s.classList.add("wide"),t.visible(s,n);let o=[t.slider("pose_sigma",()=>"Position ±",{step:.05,unit:" m"}),
t.slider("heading_sigma",()=>"Yaw ±",{step:.5,unit:"°",scale:Tm})];for(let a of o)t.visible(a,()=>e.editable);let r=k("p",{className:"caption"});t.each(()=>{let{
pose_sigma:a=0,heading_sigma:l=0,method:c="auto"}=e.document??{},h=n()&&e.document?.poses==="odometry"&&e.shown?.method==="counts"&&!e.running,u=e.editable&&(a>
0||l>0)&&!/auto|gibbs|block/.test(c);C(r,"hidden",!u&&!h),C(r,"textContent",h?"Run infers where the robot was.":"This method takes poses as known; Gibbs does no\
t.")});let i=t.section("Where the robot was",s,...o,r);return t.visible(i,()=>e.editable&&!e.figure||n()&&!e.recorded),i}var Wo=t=>Math.abs(t)<.995?`${me(100*Math.abs(t),1)} cm`:`${me(Math.abs(t),2)} m`,Am="Point at a reading to compare it with what the posterior predicts of it.",
Em=": preparing the comparison. The first one after an installation takes some seconds.";function ph(t){let{session:e}=t,n=k("p",{className:"words reading",role:"\
status"}),s=t.section("Reading",n);return t.visible(s,()=>!e.recorded&&!!e.document&&e.document?.source.kind!=="simulation"),t.each(()=>{let{picked:o,found:r,trouble:i,
slow:a}=e.reading,l=o?`Beam ${o.beam+1} of scan ${o.scan+1}${a?Em:"."}`:Am;C(n,"textContent",i||(r?Pm(r):l))}),s}function Pm({scan:t,beam:e,reading:n,range:s,low:o,
median:r,high:i,residual:a,no_return:l,wall:c}){let h=`Beam ${e+1} of scan ${t+1}`,u=(T,v)=>T===null?v:`${me(T,2)} m`,d=`median ${u(r,"no return")}, 80 % betwee\
n ${u(o,"too close")} and ${u(i,"no return")}`;if(n==="none")return`${h} came back from nothing, which was predicted with probability ${me(l??0,3)} (${d}).`;if(n!==
"hit"||s===null)return`${h} read nothing that says how far (${d}).`;let m=a===null?"":`, ${Wo(a)} ${a<0?"shorter":"longer"} than the predicted median`,w=`${h} r\
ead ${me(s,2)} m${m} (${d}).`;if(!c)return w;let b=`${Wo(c.across_m)} ${c.across_m<0?"behind":"in front of"} the wall, which is ${Wo(c.thickness_m)} thick`,S=`${Wo(
c.along_m)} to the ${c.along_m<0?"right":"left"} along it from the middle of its surface`;return`${w} It ended ${b} (one standard deviation), and ${S}; the beam\
 met it at ${me(c.incidence_rad*180/Math.PI,0)}° from its normal.`}var _m={auto:"Chosen by the prior",gibbs:"Gibbs, cell by cell",block:"Gibbs, 2 × 2 blocks",propagate:"Belief propagation",importance:"Importance sampling"},Cm={
binary:"walls",reflectivity:"reflectivities",surface:"surfaces"},Lm={noisy:"with noise",exact:"exact"},Dm={auto:"as is best",prior:"draws of the prior",empty:"t\
he empty map"},Nm={raster:"raster",radial:"radial",random:"random"},Bo=2*Math.PI,Rm=t=>Math.round(t*1800/Math.PI)/10,$m={importance:"Particles",propagate:"Round\
s"};function uh(t){let{session:e,hand:n,editor:s}=t,o=k("select",{"aria-label":"Selected sensor"});o.addEventListener("change",()=>{n.selected=Number(o.value),n.
choose("sensor")});let r="";t.each(()=>{let u=e.document?.sensors??[],d=u.map(m=>m.id).join();d!==r&&o.replaceChildren(...u.map(({id:m})=>k("option",{value:String(
m),textContent:`Sensor ${m}`}))),r=d,C(o,"value",String(n.sensor?.id??""))});let i=(u,d)=>t.numberInput(u,()=>Number((n.sensor?.[d]??0).toFixed(2)),m=>n.sensor&&
s.moveSensor(n.sensor,{[d]:m}),{step:"any"}),a=t.numberInput("heading (°)",()=>Math.round((n.sensor?.yaw??0)*180/Math.PI),u=>n.sensor&&s.moveSensor(n.sensor,{yaw:u%
360*Math.PI/180}),{step:5}),l=t.button("plus","Add a sensor",()=>t.command("add"),{text:"Add"}),c=t.button("minus","Remove the sensor",()=>s.removeSensor(),{text:"\
Remove",when:()=>(e.document?.sensors.length??0)>1,why:"The last sensor stays"});t.visible(a,()=>(e.document?.fov??Bo)<Bo);let h=k("div",{className:"triple"},i(
"x (m)","x"),i("y (m)","y"),a);return t.section("Sensors",k("div",{className:"buttons"},o,l,c),h)}function dh(t){let{session:e}=t,n=t.numberInput("Longest range\
 (m)",()=>e.document?.max_range??0,a=>t.set({max_range:a}),{step:"any",limits:"max_range"}),s=[t.slider("noise",()=>"Noise (m)",{step:.01,unit:" m"}),t.slider("\
angles",()=>"Angles",{step:1,log:!0}),n,t.numberInput("Field of view (°)",()=>Rm(e.document?.fov??Bo),a=>t.set({fov:a>=360?Bo:a*Math.PI/180}),{step:5,limits:"f\
ov",scale:180/Math.PI}),t.select("Readings",Lm,()=>e.document?.readings??"noisy",a=>t.set({readings:a}))];for(let a of s)t.visible(a,()=>e.editable);let o=t.slider(
"prior",()=>"Prior P(wall)",{step:.01}),r=()=>(e.document?.cells??"binary")==="binary";t.visible(o,r);let i=t.select("Cells",Cm,()=>e.document?.cells??"binary",
a=>t.set({cells:a}));return t.visible(i,()=>e.document?.source.kind==="log"),t.section("Model",i,eh(t),o,...s)}function fh(t){let{session:e}=t,n=()=>e.document?.
method??"auto",s=()=>(e.document?.cells??"binary")==="binary",o=()=>/auto|gibbs|block/.test(n()),r=[t.select("Method",_m,n,l=>t.set({method:l})),t.select("Order",
Nm,()=>e.document?.order??"radial",l=>t.set({order:l}),()=>n()==="gibbs"||n()==="auto","Only Gibbs, cell by cell, has an order"),t.select("Start",Dm,()=>e.document?.
start??"auto",l=>t.set({start:l}),o,"Only chains have a start")],i=Array.from(r[0].lastElementChild.children);for(let l of i)l.value==="propagate"&&t.visible(l,
()=>!e.figure);for(let l of r)t.visible(l,s);let a=t.slider("burn_in",()=>"Burn-in (%)",{step:5,scale:100});return t.visible(a,()=>o()||!s()),t.section("Inferen\
ce",...r,a,t.slider("sweeps",()=>$m[n()]??"Sweeps",{step:1,log:!0}),t.numberInput("Seed",()=>e.document?.seed??0,l=>t.set({seed:Math.round(l)}),{step:1,limits:"\
seed"}))}function mh(t){let{session:e}=t,n=t.button(null,"Clear walls",()=>e.act({type:"clear",what:"walls"}),{text:"Clear walls",when:()=>e.editable}),s=t.button(
null,"Clear inference",()=>e.act({type:"clear",what:"inference"}),{text:"Clear inference"});return t.visible(n,()=>e.editable),t.section("Clear",k("div",{className:"\
buttons"},n,s))}var Fm=0,Go=class{constructor(e,n,s,o,r,i){this.session=e;this.hand=n;this.editor=s;this.command=o;this.showLayer=r;this.embedded=i}prefix=`bayesmap${Fm++}`;updates=[];drag=Math.
floor(Math.random()*2**30);each(e){this.updates.push(e)}refresh(){for(let e of this.updates)e()}set(e){this.session.act({type:"set",patch:e,drag:this.drag})}scrub(e,n){
this.session.act({type:"set",patch:{scans_used:e},drag:this.drag,...n?{coarse:n}:{}})}endDrag(){this.drag++}limits(e,n=1){let[s,o]=this.session.limits?.[e]??[1,
2];return n===1?[s,o]:[Math.ceil(10*s*n-1e-6)/10,Math.floor(10*o*n+1e-6)/10]}bounded(e,n,s=1){this.each(()=>{let[o,r]=this.limits(n,s);C(e,"min",String(o)),C(e,
"max",String(r))})}visible(e,n){this.each(()=>C(e,"hidden",!n()))}button(e,n,s,{className:o="",text:r="",when:i,why:a,title:l}={}){let c=k("button",{type:"butto\
n",className:o,title:l??n,onclick:s},e&&hn(e));return r&&c.append(k("span",{textContent:r})),r!==n&&c.setAttribute("aria-label",n),i&&this.each(()=>{C(c,"disabl\
ed",!i()),a&&C(c,"title",c.disabled?a:l??n)}),c}segmented(e,n,s,o,r){let i=`${this.prefix}-${e.replace(/\W/g,"")}`,a=k("div",{className:"segmented",role:"radiog\
roup","aria-label":e});for(let[l,c,h]of n){let u=k("input",{type:"radio",name:i,value:l,onchange:()=>o(l)});a.append(k("label",{title:c},u,h?hn(h):null,k("span",
{textContent:c}))),this.each(()=>{C(u,"checked",s()===l),r&&C(u,"disabled",!r(l))})}return a}section(e,...n){let s=`${this.prefix}-${e.replace(/\W/g,"")}`;return k(
"section",{"aria-labelledby":s},k("h2",{id:s,textContent:e}),...n)}row(e,n){return n.id=`${this.prefix}-${e.replace(/\W/g,"")}`,k("div",{className:"row"},k("lab\
el",{for:n.id,textContent:e}),n)}slider(e,n,{step:s,log:o=!1,unit:r="",scale:i=1}){let a=`${this.prefix}-${e}`,l=()=>this.limits(e,i),c=b=>{let[S,T]=l();return o?
1e3*Math.log(b/S)/Math.log(T/S):b},h=b=>{if(!o)return b;let[S,T]=l(),v=S*(T/S)**(b/1e3),A=v<100?1:10**(Math.floor(Math.log10(v))-1);return se(Math.round(v/A)*A,
S,T)},u=()=>{let b=this.session.document?.[e];return b===void 0?l()[0]:i===1?b:Number((b*i).toFixed(3))},d=k("label",{for:a}),m=k("input",{type:"range",id:a,...o?
{min:0,max:1e3,step:1}:{step:s}}),w=k("input",{type:"number",step:String(s)});return o||this.bounded(m,e,i),this.bounded(w,e,i),m.addEventListener("input",()=>this.
set({[e]:h(Number(m.value))/i})),m.addEventListener("change",()=>this.endDrag()),w.addEventListener("change",()=>{this.typed(w,n(),l(),u,b=>this.set({[e]:o?Math.
round(b):b/i})),this.endDrag()}),this.each(()=>{let b=u();C(d,"textContent",n()),st(w,"aria-label",`${n()}, number`),h(Number(m.value))!==b&&(m.value=String(c(b))),
st(m,"aria-valuetext",`${b}${r}`);let S=100*(c(b)-Number(m.min))/(Number(m.max)-Number(m.min));m.style.setProperty("--fill",`${se(S,0,100)}%`),Sn(w)||C(w,"value",
String(b))}),k("div",{className:"row slider"},d,m,w)}select(e,n,s,o,r,i=""){let a=k("select",{onchange:()=>o(a.value)});for(let[l,c]of Object.entries(n))a.append(
k("option",{value:l,textContent:c}));return this.each(()=>{C(a,"value",s()),r&&C(a,"disabled",!r()),i&&C(a,"title",a.disabled?i:"")}),this.row(e,a)}typed(e,n,[s,
o],r,i){let a=e.value===""?NaN:Number(e.value);Number.isFinite(a)&&i(se(a,s,o)),e.value=String(r()),a<s?this.session.say(`${n} is at least ${s}`,"warning"):a>o&&
this.session.say(`${n} is at most ${o}`,"warning")}numberInput(e,n,s,{step:o,limits:r,scale:i}){let a=k("input",{type:"number",step:String(o)}),l=()=>r?this.limits(
r,i):[-1/0,1/0];return r&&this.bounded(a,r,i),a.addEventListener("change",()=>this.typed(a,e,l(),n,s)),this.each(()=>{Sn(a)||C(a,"value",String(n()))}),this.row(
e,a)}checkbox(e,n,s,o=""){let r=k("input",{type:"checkbox",onchange:()=>s(r.checked)});return this.each(()=>C(r,"checked",n())),k("label",{className:"check",title:o},
r,k("span",{textContent:e}))}dialog(e,...n){let s=`${this.prefix}-dialog-${e.replace(/\W/g,"")}`,o=k("button",{type:"button",className:"plain","aria-label":"Clo\
se",onclick:()=>i.close()},hn("close")),r=k("div",{className:"title"},k("h2",{id:s,textContent:e}),o),i=k("dialog",{"aria-labelledby":s},r,...n);return i.addEventListener(
"click",a=>{a.target===i&&i.close()}),i.addEventListener("keydown",a=>a.stopPropagation()),i}};var Im=[["mean","Mean"],["draw","One draw"],["entropy","Entropy"],["width","Width"]],gh="There are no draws yet: chains keep them",Om={2:"2 / s",10:"10 / s",30:"\
30 / s",1e3:"fastest"},Ho=class{constructor(e){this.session=e}playing=!1;drawsPerSecond=10;afterMean=!1;before=null;showLayer(e){if(e!=="draw")this.play(!1);else if(!this.
session.hasDraws)return;this.before=null,this.session.act({type:"view",layer:e,chain:this.session.view.chain})}showDraw(e,n=this.session.view.chain){this.session.
act({type:"view",layer:"draw",chain:n,draw:e})}play(e){let{draw:n,draws:s,flicker:o,shown:r}=this.session;this.playing=e&&!o.still,e&&o.wantsMean?this.session.act(
{type:"view",layer:"mean",chain:this.session.view.chain}):e&&this.showDraw(o.still&&r?.layer==="draw"?(n+1)%s.count:n>=s.count-1?0:n),this.session.changed()}over(e){
let{flicker:n,view:s}=this.session;n.on=e,e?n.wantsMean?(this.afterMean=!0,this.session.act({type:"view",layer:"mean",chain:s.chain})):s.layer!=="draw"&&this.showLayer(
"draw"):(this.afterMean=!1,this.before&&this.before!==s.layer&&this.showLayer(this.before)),this.before=e?s.layer:null,this.session.changed()}playFromStart(){this.
showDraw(0),this.playing=!0,this.session.changed()}step(){let{shown:e,flicker:n}=this.session;if(n.on&&(this.afterMean||this.playing)&&e?.layer==="mean"&&!n.wantsMean)
return this.afterMean=!1,this.showDraw(this.session.draw);!this.playing||e?.layer!=="draw"||setTimeout(()=>{if(!this.playing)return;let{draw:s,draws:o}=this.session;
s+1>=o.count&&n.on?this.showDraw(0):s+1>=o.count?this.play(!1):this.showDraw(s+1)},1e3/this.drawsPerSecond)}};function yh(t,e,n,s){let{session:o}=t,r=t.segmented(
"Show",Im,()=>o.view.layer,m=>e.showLayer(m),m=>m==="draw"?o.hasDraws:!o.lacks.includes(m)),[,,i,a]=Array.from(r.children);C(a,"title","Width of each cell's 90 \
% interval"),t.visible(i,()=>!o.quantity.interval),t.visible(a,()=>o.quantity.interval);let l=(m,w)=>t.checkbox(m,()=>n[w],b=>{n[w]=b,o.changed()}),c=l("True wa\
lls","truth");t.visible(c,()=>!o.document||o.document.source.kind==="simulation");let[h,u]=[l("Surfaces","strokes"),l("Trajectory","trajectory")];t.visible(h,()=>!!o.
overlay?.strokes.length),t.each(()=>C(h.lastElementChild,"textContent",Ds(s())?"Surfaces":"Surfaces (zoom in)")),t.visible(u,()=>!!o.overlay?.trajectory.length);
let d=k("div",{className:"checks",role:"group","aria-label":"Marks"},c,l("Rays","rays"),l("Readings","readings"),h,u);return t.section("View",r,Um(t,e),d)}function Um(t,e){
let{session:n}=t,s=k("input",{type:"range",min:0,step:1,"aria-label":"Draw number"});s.addEventListener("input",()=>{e.play(!1),e.showDraw(Number(s.value))});let o=t.
button("play","Play the draws",()=>e.play(!e.playing),{when:()=>n.draws.count>1,why:gh}),r=k("output"),i=k("select",{"aria-label":"Chain"});i.addEventListener("\
change",()=>e.showDraw(n.draw,Number(i.value))),t.each(()=>{let{chains:u,count:d}=n.draws;C(s,"max",String(Math.max(0,d-1))),C(s,"disabled",d===0),C(s,"value",String(
n.draw));let m=d?`${n.draw+1} of ${d}`:"none kept";st(s,"aria-valuetext",m),s.style.setProperty("--fill",`${d>1?100*n.draw/(d-1):0}%`),C(r,"textContent",m),i.length!==
Math.max(1,u)&&i.replaceChildren(...Array.from({length:Math.max(1,u)},(b,S)=>k("option",{value:String(S),textContent:`chain ${S+1}`}))),C(i,"value",String(n.view.
chain)),C(i,"disabled",u<2),d<2&&e.playing&&e.play(!1);let w=n.flicker.still?"Next draw":e.playing?"Pause the draws":"Play the draws";o.getAttribute("aria-label")!==
w&&(o.setAttribute("aria-label",w),o.replaceChildren(hn(e.playing?"pause":"play")))});let a=k("select",{"aria-label":"Speed"});for(let[u,d]of Object.entries(Om))
a.append(k("option",{value:u,textContent:d}));a.value=String(e.drawsPerSecond),a.addEventListener("change",()=>e.drawsPerSecond=Number(a.value));let l=t.button(
null,"From the first sweep",()=>e.playFromStart(),{text:"From the first",when:()=>n.draws.count>1,why:gh});t.each(()=>C(a,"disabled",n.draws.count<2||n.flicker.
still));let c=t.checkbox("Draws over the mean",()=>n.flicker.on,u=>e.over(u),"Each draw in its own colour over the mean, as one of the maps that the scans leave\
 possible");t.visible(c,()=>n.draws.count>1);let h=k("div",{className:"wide"},c);return k("div",{className:"player"},o,s,r,k("div",{className:"buttons wide"},i,
a,l),h)}function wh(t){let{session:e}=t,n=k("input",{type:"range",min:0,step:1,"aria-label":"Scan number"}),s=k("output");n.addEventListener("input",()=>e.act({
type:"scan",index:Number(n.value)}));let o=t.section("Scan",k("div",{className:"player bare"},n,s));return t.each(()=>{let r=e.document?.source.kind==="simulati\
on"?0:e.document?.source.scans??0;C(o,"hidden",r<2),C(n,"max",String(Math.max(0,r-1))),Sn(n)||C(n,"value",String(e.scan?.index??0)),n.style.setProperty("--fill",
`${100*Number(n.value)/Math.max(1,r-1)}%`),C(s,"textContent",`${Number(n.value)+1} / ${r}`)}),o}var xh=2,bh=6,Wm=.5,Bm=.005;function vh(t){let{session:e,hand:n}=t,s=k("p",{className:"whereabouts",role:"status"}),o=k("p",{className:"caption"}),r=t.section("\
Where am I?",s,o);return t.visible(r,()=>n.tool==="where"),t.each(()=>{e.where.follow(n.tool==="where",n.sensor?.id??null),C(s,"textContent",Gm(t)),C(o,"textCon\
tent",e.editable?"Drag the robot: its scan is located among the walls that are drawn, as if nothing were known of its pose.":"Choose a scan below: it is located\
 in this map, as if nothing were known of its pose. The arrow is where it was recorded.")}),r}function Gm({session:t}){let{found:e,trouble:n}=t.where;if(n)return`${n.
charAt(0).toUpperCase()}${n.slice(1)}.`;if(!e)return"Looking everywhere.";let s=e.p_lost>Wm?`The scan fits nowhere on this map, with probability ${e.p_lost.toFixed(
2)}: the robot is lost, or the map is outdated. If it is on the map: `:"",o=!s&&e.p_lost>Bm?` That it is lost, or the map outdated, has probability ${e.p_lost.toFixed(
2)}.`:"";return`${s}${Hm(e.modes)}${zm(e,t.editable)}${o}`}function Hm(t){let[e]=t;if(!e)return"No place.";let n=e.sigma_m>xh,s=`${e.mean[0].toFixed(2)}, ${e.mean[1].
toFixed(2)} m, heading ${Ai(e.mean[2],0)}`,o=`known to ${Ei(e.sigma_m)} and ${Ai(e.sigma_rad,1)}`;if(t.length===1)return n?`It may be almost anywhere: positions\
 are ${Ei(e.sigma_m)} apart.`:`One place: ${s}, ${o}.`;let r=t.slice(0,bh).map(({probability:a})=>Gr(a)),i=t.length>bh?" and less":"";return`${t.length} places:\
 ${r.join(", ")}${i}. The likeliest: ${s}, ${o}.`}function zm({modes:t,pose:e},n){if(!t.length||t[0].sigma_m>xh)return"";let s=t.map(({mean:a})=>Math.hypot(a[0]-
e[0],a[1]-e[1])),o=s.indexOf(Math.min(...s)),r=Math.abs(Math.atan2(Math.sin(t[o].mean[2]-e[2]),Math.cos(t[o].mean[2]-e[2]))),i=t.length===1?"there":o===0?"the l\
ikeliest":`the ${Vm(o+1)}`;return` The robot ${n?"stands":"was recorded"} ${Ei(s[o])} and ${Ai(r,1)} from ${i}.`}var Vm=t=>`${t}${["th","st","nd","rd"][t%100>10&&
t%100<14?0:t%10]??"th"}`,Ai=(t,e)=>`${(t*180/Math.PI).toFixed(e).replace(/^-(?=0(\.0*)?$)/,"")}°`,Ei=t=>t<.0095?`${(1e3*t).toFixed(0)} mm`:t<1?`${(100*t).toFixed(
0)} cm`:`${t.toFixed(1)} m`;function kh(t,e,n){let{shown:s,status:o}=t;return{document:t.effectiveDocument(),generation:t.generation,painted:s&&{generation:s.generation,layer:t.layer,approximate:s.
approximate,sweeps:s.sweeps,method:s.method,quantity:t.quantity,rhat:s.rhat,verdict:s.verdict,trace:s.trace,traced:s.traced,weights:s.weights,ess:s.ess,chain:s.
chain,draw:s.draw},probability:s?.p??new Uint8Array(0),reached:s?.reached??new Uint8Array(0),walls:t.walls,sensors:t.document?.sensors??[],scan:t.scan,status:{text:o.
text,level:o.level},connected:t.connection.connected,decisions:{path:t.decisions.path,views:t.decisions.views,trouble:t.decisions.trouble||t.decisions.viewTrouble},
where:{found:t.where.found,trouble:t.where.trouble},stage:t.stage,ghost:Ym(t),reading:{picked:t.reading.picked,found:t.reading.found,trouble:t.reading.trouble},
evidence:{cell:t.evidence.cell,together:t.evidence.together,each:t.evidence.each&&jm(t.evidence.each)},over:!!t.flicker.under,overlay:t.overlay&&{strokes:t.overlay.
strokes.length/5,trajectory:t.overlay.trajectory.length/2},worker:t.worker,running:t.running,draws:t.draws,view:t.view,seq:{sent:t.acted,confirmed:t.state?.seq??
0},events:{...t.counts,eventToPaint_ms:t.latency.eventToPaint_ms},layers:{...n.paints},transform:{...e.transform}}}var jm=t=>Object.fromEntries(Object.entries(t).
map(([e,n])=>[e,Array.from(n)]));function Ym({ghost:t}){let{held:e,pose:n,fan:s,answers:o,trouble:r}=t;return{held:e,pose:n,answers:o,trouble:r,fan:s&&{...s,near:s.
near&&{...s.near}}}}var Pi=new Set(["walls","move_sensor","set","view","live"]),Sh=({type:t})=>!Pi.has(t),Mh="Not while the connection is lost: this needs the server";function Th(t,e){
let{document:n,walls:s}=t,o=n.grid.shape[1];if(e.type==="walls")for(let[r,i]of e.cells)s[r*o+i]=e.wall?1:0;else if(e.type==="set"){let{resolution:r,...i}=e.patch;
Object.assign(n,i)}else if(e.type==="live")t.state={...t.state,live:e.on};else if(e.type==="view")t.view={layer:e.layer,chain:e.chain??t.view.chain,draw:e.draw??
null};else if(e.type==="move_sensor"){let r=n.sensors.find(i=>i.id===e.id);if(r)for(let i of["x","y","yaw"])r[i]=e[i]??r[i]}}var qm=t=>Zt(`${t.replace(/^(plan|path|explore): /,"")}.`),zo=class{constructor(e){this.session=e}start=null;goal=null;radius=.25;risk=.01;path=null;views=null;trouble="";viewTrouble="";version=0;pathShown=!0;looking=!1;askedPath="";askedViews="";point(e){
this.start&&!this.goal?this.goal=e:[this.start,this.goal]=[e,null],this.path=null,this.trouble="",this.version++,this.ask(),this.session.changed()}set(e){Object.
assign(this,e),this.ask()}showPath(e){this.pathShown!==e&&this.version++,this.pathShown=e}look(e){this.looking!==e&&(this.looking=e,this.viewTrouble="",e||([this.
views,this.askedViews]=[null,""]),this.version++,this.ask(),this.session.changed())}forget(){this.forgetPath(),this.views=null,this.askedViews=""}forgetPath(){this.
start=this.goal=this.path=null,this.askedPath=this.trouble="",this.version++,this.session.changed()}ask(){let{session:e,start:n,goal:s,radius:o,risk:r}=this,{shown:i}=e;
if(!i||i.generation!==e.generation||!e.answers)return;let a=`${i.generation} ${e.sampling}`,l=`${a} ${JSON.stringify([n,s,o,r])}`;n&&s&&!i.approximate&&l!==this.
askedPath&&(this.askedPath=l,e.act({type:"path",start:[n.x,n.y],goal:[s.x,s.y],radius:o,risk:r})),this.looking&&(!i.approximate||e.document?.method==="propagate")&&
a!==this.askedViews&&(this.askedViews=a,e.act({type:"views"}))}receive(e,n){let s=e.type==="undecided"?qm(e.text):"",o=e.type==="undecided"?e.question:e.type;o===
"views"?(this.viewTrouble=s,this.views=null):this.trouble=s,e.type==="path"?this.path=e:e.type==="views"&&this.looking?this.views={pose:n.pose,nats:n.nats,spacing:e.
spacing}:o==="path"&&(this.path=null),this.version++}nearest(e){let{views:n}=this;if(!n?.nats.length)return null;let[s,o]=[0,1/0];for(let r=0;r<n.nats.length;r++){
let i=Math.hypot(n.pose[3*r]-e.x,n.pose[3*r+1]-e.y);i<o&&([s,o]=[r,i])}return s}};var Vo=class{constructor(e){this.session=e}facts=null;cell=null;together=null;each=null;version=0;held=!1;asked="";get cellShown(){return this.held&&this.cell!==
null}hold(e){this.held!==e&&(this.held=e,this.version++,this.ask())}pin(e){this.cell=Ht(e,this.session.shape)?e:null,this.together=this.each=null,this.asked="",
this.version++,this.ask(),this.session.changed()}forget(){this.cell=this.together=this.each=this.facts=null,this.version++}ask(){let{session:e,cell:n}=this,{shown:s}=e;
if(!this.held||!n||!s||s.generation!==e.generation||!e.answers)return;let o=`${s.generation} ${e.sampling} ${s.approximate} ${n.x} ${n.y}`;o!==this.asked&&(this.
asked=o,e.act({type:"inspect",x:n.x,y:n.y,each:!0}))}receive(e,n){this.facts=e,!(!e.each||e.x!==this.cell?.x||e.y!==this.cell?.y)&&(this.together=this.facts,this.
each=n.nats?n:null,this.version++)}};var Km="(prefers-reduced-motion: reduce)",jo=class{constructor(e){this.session=e}on=!1;mean=null;get still(){return matchMedia(Km).matches}get under(){let{mean:e,
session:n}=this,{shown:s}=n;return this.on&&e&&s?.layer==="draw"&&e.generation===s.generation&&e.p.length===s.p.length?e:null}get wantsMean(){return this.on&&this.
mean?.generation!==this.session.generation}take(e){e.layer!=="draw"&&e.layer!=="width"&&(this.mean=e)}};var Jm=2e3,Xm=3e3,Zm=2,Yo=class{constructor(e){this.session=e}held=!1;pose=null;fan=null;trouble="";version=0;answers=0;moving=!1;askedAt=-1/0;waiting=0;asked="";hold(e){
this.held!==e&&(this.held=e,this.version++,this.ask(),this.session.changed())}move(e,n=!1){let{pose:s}=this;this.moving=n,this.pose={x:0,y:0,yaw:0,...s,...e},this.
version++,this.ask(),this.session.changed()}rest(){this.moving&&(this.moving=!1,this.ask())}refit(){let{pose:e,session:n}=this,s=e&&n.document&&vn(e,n.document.
grid);(!s||!Ht(s,n.shape))&&(this.pose=null),this.fan=null,this.asked=this.trouble="",this.version++}ask(){let{session:e}=this,{shown:n,scan:s}=e;if(!this.held||
!e.answers||!n||n.generation!==e.generation)return;!this.pose&&s?.pose.length&&(this.pose={x:s.pose[0],y:s.pose[1],yaw:s.pose[2]});let{pose:o}=this;if(!o)return;
let r=performance.now();if(r-this.askedAt>Jm&&(this.waiting=0),this.waiting>=Zm)return;let i=JSON.stringify([o,this.moving,n.generation,e.sampling,n.approximate]),
a=e.sampling&&r-this.askedAt>Xm;i===this.asked&&!a||([this.asked,this.askedAt]=[i,r],this.waiting++,e.act({type:"ghost",...o,coarse:this.moving}))}receive(e,n){
if(this.waiting=Math.max(0,this.waiting-1),this.trouble=e.type==="undecided"?e.text:"",e.type==="ghost"){let{angles:s,low:o,median:r,high:i,near_pose:a,near_ranges:l,
near_hit:c}=n,{x:h,y:u,yaw:d,generation:m,draws:w,coarse:b,milliseconds:S}=e,T=e.near&&{...e.near,pose:a,ranges:l,hit:c};this.fan={x:h,y:u,yaw:d,generation:m,draws:w,
coarse:b,milliseconds:S,angles:s,low:o,median:r,high:i,near:T},this.answers++}else this.fan=null;this.version++,this.ask()}};var qo=class{eventToPaint_ms=[];waiting=[];seqOfGeneration=new Map;sent(e,n){this.waiting.push({seq:e,time:n.timeStamp})}refused(e){this.waiting=this.waiting.filter(
n=>n.seq!==e)}confirmed(e,n){this.seqOfGeneration.set(e,n)}painted(e){let n=this.seqOfGeneration.get(e);if(n===void 0)return;let s=performance.now();for(let o of this.
waiting)o.seq<=n&&this.eventToPaint_ms.push(s-o.time);this.waiting=this.waiting.filter(o=>o.seq>n);for(let o of this.seqOfGeneration.keys())o<e&&this.seqOfGeneration.
delete(o)}forget(){this.waiting=[],this.seqOfGeneration.clear()}};var Ko=class{generation=-1;last=0;from={sweeps:0,time:0};hear(e){e.approximate||e.sweeps<=0||((this.generation!==e.generation||e.sweeps<this.last)&&(this.generation=
e.generation,this.from={sweeps:e.sweeps,time:performance.now()}),this.last=e.sweeps)}remaining_s(e){let n=e.sweeps-this.from.sweeps;return n>0?(e.total-e.sweeps)*
(performance.now()-this.from.time)/n/1e3:null}};var Jo=class{constructor(e){this.session=e}picked=null;found=null;trouble="";slow=!1;version=0;timer=0;point(e,n){let{session:s}=this,o=s.document&&s.document.source.
kind!=="simulation"&&!s.recorded,r=e&&o&&s.scan?Qm(s.scan,e,n,s.document?.max_range??1/0):null;r?.beam===this.picked?.beam&&r?.scan===this.picked?.scan||(this.picked=
r,this.found=null,this.trouble="",this.slow=!1,this.version++,clearTimeout(this.timer),r&&(this.timer=window.setTimeout(()=>this.ask(r),120)),s.changed())}ask({
scan:e,beam:n}){this.session.act({type:"beam",scan:e,beam:n}),this.timer=window.setTimeout(()=>{this.slow=!0,this.session.changed()},1e3)}forget(){this.picked&&
(clearTimeout(this.timer),this.picked=this.found=null,this.slow=!1,this.version++)}receive(e){e.type==="undecided"?this.trouble=e.text:e.beam===this.picked?.beam&&
e.scan===this.picked.scan&&(this.found=e),this.version++}};function Qm({index:t,pose:e,angles:n,ranges:s,hit:o},r,i,a){if(t===null)return null;let l={x:e[0],y:e[1]},
[c,h]=[-1,1/0];for(let u=0;u<n.length;u++){let[d,m]=[Math.cos(e[2]+n[u]),Math.sin(e[2]+n[u])],[w,b]=[r.x-l.x,r.y-l.y],S=w*d+b*m,T=o[u]?s[u]:a,v=o[u]?Math.hypot(
w-T*d,b-T*m):1/0,A=S>0&&S<T?Math.abs(w*m-b*d):1/0,E=Math.min(v,i/2+2*A);E<h&&([c,h]=[u,E])}return h<i?{scan:t,beam:c,from:l,angle:e[2]+n[c]}:null}var Xo=class{constructor(e){this.session=e}found=null;trouble="";version=0;wanted=!1;sensor=null;asked="";waitingSince=0;follow(e,n){this.sensor=n,e!==this.wanted&&
(this.wanted=e,this.found=null,[this.trouble,this.asked,this.waitingSince]=["","",0],this.version++,this.session.changed()),e&&this.ask()}receive(e,n){if(this.waitingSince=
0,!this.wanted)return;this.trouble=e.trouble;let{pose:s,weight:o}=n,r=e.modes.filter(({probability:i},a)=>a===0||i>=.005);this.found=this.trouble?null:{...e,modes:r,
cloud:s,weight:o},this.version++}ask(){let{session:e}=this,{shown:n,scan:s}=e;if(!n||!e.answers||e.worker!=="ready"||e.editable&&n.generation!==e.generation)return;
let o=e.editable?"":`${e.draws.count} ${e.sampling}`,r=`${e.generation} ${e.editable?this.sensor:s?.index} ${o}`,i=performance.now();r===this.asked||this.waitingSince&&
i-this.waitingSince<5e3||([this.asked,this.waitingSince]=[r,i],e.act(e.editable&&this.sensor!==null?{type:"where",sensor:this.sensor}:{type:"where"}))}};var Ah=new Set(["inspect","path","views","where","ghost","beam"]),Zo=class{constructor(e,n,s=null,o=null){this.transport=e;this.changed=n;this.adopt=s;this.notice=
o;e.onmessage=(r,i)=>this.receive(r,i),e.onstatus=r=>this.onstatus(r)}connection={connected:!1};everConnected=!1;document=null;walls=new Uint8Array(0);wallsVersion=0;view={
layer:"mean",chain:0,draw:null};state=null;scan=null;overlay=null;shown=null;lastStage=null;worker="starting";limits=null;recorded=!1;figure=!1;lacks=[];generation=-1;acted=0;decisions=new zo(
this);evidence=new Vo(this);where=new Xo(this);ghost=new Yo(this);reading=new Jo(this);flicker=new jo(this);status=new Fo;progress=new Ko;latency=new qo;counts={
paints:0,stale:0};ondownload=()=>{};seq=0;next=null;pending=[];reported=-1;confirmedWalls={text:"",walls:this.walls};wallsAhead=!1;broughtAt=null;packed={version:-1,
text:""};get shape(){return this.document?this.document.grid.shape:[1,1]}get editable(){return!this.recorded&&this.document?.source.kind==="simulation"}get answers(){
return!this.recorded&&!this.figure}get running(){return this.connection.connected&&!!this.state?.running}get working(){return this.connection.connected&&!!this.
state?.working}get layer(){let e=this.shown?.layer;return e==="draw"||e==="width"?e:this.view.layer==="entropy"?"entropy":"mean"}get stage(){return this.running&&
this.shown?.method==="counts"?this.lastStage:null}get halfway(){return this.lastStage?.generation===this.shown?.generation}get draws(){return this.state?.draws??
{chains:0,count:0}}get sampling(){let e=this.shown;return!!(e&&!e.approximate&&e.sweeps<e.total&&this.working)}get draw(){let e=Math.max(0,this.draws.count-1);return Math.
min(e,this.view.draw??(this.shown?.layer==="draw"?this.shown.draw??e:e))}get hasDraws(){return this.draws.count>0||!this.recorded&&/auto|gibbs|block/.test(this.
document?.method??"")}say(e,n="info"){this.status.say(e,n,this.acted),this.changed()}act(e,n){if(!this.document&&e.type!=="hello")return;if(!this.connection.connected&&
this.everConnected&&!Ah.has(e.type)&&Sh(e))return this.say(Mh,"warning");let s={...e,seq:++this.seq};Ah.has(e.type)||(this.acted=this.seq),Pi.has(e.type)&&(this.
pending.push(s),this.foresee(s)),n&&this.latency.sent(s.seq,n),this.connection.connected?this.transport.send(s):this.everConnected&&zr(this.portableDocument()),
this.changed()}bring(e){this.act(e?{type:"hello",document:e}:{type:"hello"}),this.broughtAt=e?this.seq:null}effectiveDocument(){return this.packed.version!==this.
wallsVersion&&(this.packed={version:this.wallsVersion,text:xn(Kn(this.walls))}),this.document&&{...this.document,walls:this.packed.text}}portableDocument(){let e=this.
effectiveDocument();return e&&(e.source.kind==="simulation"?e:{...e,walls:""})}take(){return!this.next||!this.document?!1:(this.shown=this.next,this.next=null,this.
flicker.take(this.shown),!0)}painted(){this.counts.paints++;let{generation:e}=this.shown??this;this.latency.painted(e),e>this.reported&&!this.recorded&&this.transport.
send({type:"painted",generation:e}),this.reported=e;for(let n of[this.decisions,this.ghost,this.evidence])n.ask()}get quantity(){return this.shown?.quantity??{kind:"\
binary",mean:"P(wall)",value:"wall",interval:!1}}remaining_s(){return this.shown&&this.sampling?this.progress.remaining_s(this.shown):null}onstatus(e){let n=this.
connection.connected;if(this.connection=e,e.connected){let s=this.everConnected?this.portableDocument():this.adopt;this.pending=[],this.latency.forget(),this.bring(
s),this.view.layer!=="mean"&&this.document&&this.act({type:"view",...this.view}),this.everConnected?this.say("Connected again"):this.notice&&this.say(this.notice.
text,this.notice.level),this.everConnected=!0}else this.everConnected&&(n&&this.say("Connection lost","error"),zr(this.portableDocument()));this.changed()}receive(e,n){
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
this.status.confirmed(e.seq),this.state=e,e.document.source.kind==="simulation"&&(this.overlay=null,sl()),this.generation=Math.max(this.generation,e.generation),
this.latency.confirmed(e.generation,e.seq),this.pending=this.pending.filter(n=>n.seq>e.seq),this.rebuild()}receiveField(e,n){if(e.generation<this.generation){this.
counts.stale++;return}this.generation=e.generation;let s=n.p,{trace:o,traced:r,weights:i}=n,a=this.next??this.shown,l=n.reached,c=a&&a.p.length===s.length&&a.reached.
every((h,u)=>h===l[u])?a.reached:l;this.next={...e,p:s,trace:o,traced:r,weights:i,reached:c},this.progress.hear(this.next)}rebuild(){if(!this.state)return;let{document:e}=this.
state,[n,s]=e.grid.shape,o=this.confirmedWalls;if((e.walls!==o.text||o.walls.length!==n*s)&&(this.confirmedWalls={text:e.walls,walls:Lt(mt(e.walls),n*s)}),this.
document={...e,sensors:e.sensors.map(r=>({...r}))},(this.confirmedWalls!==o||this.wallsAhead)&&(this.walls=this.confirmedWalls.walls.slice(),this.wallsVersion++,
this.wallsAhead=!1),!this.pending.some(r=>r.type==="view")){let{layer:r,chain:i,draw:a}=this.state.view;this.view={layer:r,chain:i??0,draw:a}}for(let r of this.
pending)this.foresee(r)}foresee(e){!this.document||!this.state||(Th(this,e),e.type==="walls"&&(this.wallsVersion++,this.wallsAhead=!0))}};var Eh='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helveti\
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
.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Ph=`:host { display: block; height: 100dvh; container-type: size; }
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
`;var Ch="bayesmap-theme",_h={auto:"light",light:"dark",dark:"auto"},Qo=class{constructor(e,n){this.app=e;this.dressed=n;let s=ng();s&&s in _h&&(this.choice=s),this.
media.addEventListener("change",this.listen)}theme=uo.light;media=matchMedia("(prefers-color-scheme: dark)");choice="auto";listen=()=>this.dress();dress(){let e=this.
choice==="dark"||this.choice==="auto"&&this.media.matches,n=this.theme=e?uo.dark:uo.light;this.app.dataset.theme=e?"dark":"light";let{truth:s,ray:o,noReturn:r,sensor:i,
hatch:a,unobserved:l,draw:c,ghost:h,belief:u}=n;for(let[d,m]of Object.entries({truth:s,ray:o,miss:r,sensor:i,hatch:a,unobserved:l,draw:c,ghost:h,belief:u}))this.
app.style.setProperty(`--${d}`,m);this.dressed(this.choice==="auto"?"automatic":this.choice)}next(){this.choice=_h[this.choice];try{localStorage.setItem(Ch,this.
choice)}catch{}this.dress()}destroy(){this.media.removeEventListener("change",this.listen)}};function ng(){try{return localStorage.getItem(Ch)}catch{return null}}var Lh=12;function Bs(t,e,{embedded:n=!1,adopt:s=null,notice:o=null,play:r}={}){let i=t.shadowRoot??t.attachShadow({mode:"open"}),a=new CSSStyleSheet;a.replaceSync(
Eh+Ph),i.adoptedStyleSheets=[a],t.toggleAttribute("data-embedded",n);let l=0,c=()=>{l||=requestAnimationFrame(rt)},h=new Zo(e,c,s,o);e.open();let u=new Zn,d=new to(
h),m=new eo(h,d),w=new Ho(h),b=new Go(h,d,m,lt,J=>w.showLayer(J),n),S=[new ns,new os,new as,new is,new yo,new fo,new rs,new ts,new ls,new ss,new co],T=S.map(({name:J})=>k(
"canvas",{className:J})),v=T[T.length-1];Object.assign(v,{tabIndex:0,role:"application"});let A=new io(S,T);new lo(v,h,u,d,m,n);let E=new ro(v,h,u,d,m),L={truth:!0,
rays:!0,readings:!0,strokes:!0,trajectory:!0},_=Yc(b),I=cl(b),H={chip:ah(b),banner:lh(b)},Z=k("main",{className:"stage"},...T,H.chip,H.banner),j=()=>_e.theme,D=()=>u.
transform.scale,R=Zc(b,j,D),F=ch(b);v.setAttribute("aria-describedby",F.readout.id);let Y=Hc(b),W={help:Bc(b),new:Gc(b),share:Y.dialog},[K,V,$e,pe]=[uh(b),dh(b),
fh(b),mh(b)],re=[Wc(b),vh(b),jc(b),zc(b),th(b),nh(b,Oc(b,j),Uc(b,j)),wh(b),ph(b),yh(b,w,L,D),K,V,hh(b),$e,pe],ie=k("aside",{"aria-label":"Controls"},...re),Q=()=>h.
recorded||h.document?.source.kind==="run";b.visible(K,()=>h.editable),b.visible(V,()=>!Q()),b.visible($e,()=>!Q()),b.visible(pe,()=>!Q());let B=d.tool;b.each(()=>{
B!==d.tool&&(ie.scrollTop=0),B=d.tool,C(I,"inert",!h.document),C(ie,"inert",!h.document)});let Ae=k("div",{className:"app"},_.element,I,Z,R,ie,F.element,...Object.
values(W));i.replaceChildren(Ae);let _e=new Qo(Ae,J=>{_.nameTheme(J),c()}),ye=()=>{let J=h.editable&&d.tool==="sensor"?d.sensor?.id??null:null;return{session:h,
view:u,look:{theme:_e.theme,...L,hover:d.hover,cursor:d.cursor,selected:J}}},le="";function rt(){l=0;let J=h.take();h.document&&String(h.shape)!==le&&(le=String(
h.shape),u.fit(h.shape),d.cursor=d.hover=null,h.decisions.forget(),h.evidence.forget(),h.ghost.refit(),v.setAttribute("aria-label",`Map, ${h.shape[0]} by ${h.shape[1]}\
 cells`)),A.paint(ye()),J&&(h.painted(),w.step());let{x:ne,y:Be}=u.transform;H.chip.style.transform=`translate(${Math.max(ne,Je.left)}px, ${Math.max(Be-28,6)}px\
)`,st(v,"data-tool",h.editable||Mt.has(d.tool)?d.tool:"pan"),b.refresh()}let Xe=new ResizeObserver(()=>{let{width:J,height:ne}=Z.getBoundingClientRect();!J||!ne||
(u.resize(J,ne,devicePixelRatio||1),u.fitted&&u.fit(h.shape),cancelAnimationFrame(l),rt())});Xe.observe(Z);function ve([J,ne]){let{scale:Be}=u.transform;Be<Lh&&
u.zoom(Lh/Be,u.middle,h.shape);let ht=u.fromGrid({x:J+.5,y:ne+.5},h.shape[1]);u.pan(u.middle.x-ht.x,u.middle.y-ht.y,h.shape),E.focus(),d.setCursor({x:J,y:ne})}async function lt(J){
if(J==="in"||J==="out")u.zoom(J==="in"?1.4:1/1.4,u.middle,h.shape);else if(J==="fit")u.fit(h.shape);else if(J.startsWith("cell "))ve(J.slice(5).split(",").map(Number));else if(J===
"help")W.help.showModal();else if(J==="new")W.new.showModal();else if(J==="theme")_e.next();else if(J==="add")E.addSensor();else if(J==="share"){let ne=h.portableDocument();
ne&&Y.show(location.href.replace(/[?#].*/,"")+await Ta(ne))}else if(J==="export png"){let ne=await Qa(ye());ne&&Ur("bayesmap.png",ne),h.say("Saved bayesmap.png")}else
J.startsWith("export ")&&h.act({type:"export",what:J.slice(7)});c()}h.ondownload=(J,ne,Be)=>Ur(J,new Blob([Be],{type:ne}));let jt=[[n?t:window,"keydown",J=>{J.defaultPrevented||
!h.document||Object.values(W).some(ne=>ne.open)||Wa(J,h,{tool:ne=>{d.choose(ne),E.focus()},layer:ne=>w.showLayer(ne),command:lt})}],[window,"online",()=>e.retry?.()],
[window,"hashchange",async()=>{if(n)return;let{document:J,damaged:ne}=await Cs();J?h.bring(J):ne&&h.say(_s,"error")}],[t,"dragover",J=>J.preventDefault()],[t,"d\
rop",J=>{J.preventDefault();let ne=J.dataTransfer?.files[0];ne&&_a(ne,h,r)}]];for(let[J,ne,Be]of jt)J.addEventListener(ne,Be);return _e.dress(),{destroy(){Xe.disconnect(),
cancelAnimationFrame(l),_e.destroy();for(let[J,ne,Be]of jt)J.removeEventListener(ne,Be);e.close(),i.replaceChildren()},snapshot:()=>kh(h,u,A),cellToClient(J,ne){
let Be=v.getBoundingClientRect(),ht=u.fromGrid({x:J+.5,y:ne+.5},h.shape[1]);return{x:Be.left+ht.x,y:Be.top+ht.y}}}}var sg=200,og=.2,We=class extends Error{},Dh=({grid:t,walls:e})=>Lt(mt(e),t.shape[0]*t.shape[1]);function Nh({grid:t},{x:e,y:n}){let[s,o]=[Math.floor((e-t.origin[0])/
t.resolution),Math.floor((n-t.origin[1])/t.resolution)];return s>=0&&s<t.shape[0]&&o>=0&&o<t.shape[1]?s*t.shape[1]+o:null}function _i(t,e){let n=Nh(t,e);if(n===
null)throw new We("the sensor cannot stand outside the map");if(Dh(t)[n])throw new We("the sensor cannot stand in a wall; move it to a free cell");return{...e,yaw:e.
yaw-2*Math.PI*Math.round(e.yaw/(2*Math.PI))}}function Rh(t,e,n){switch(e.type){case"set":return[Ci({...t,...e.patch},t,n),""];case"walls":return rg(t,e.cells,e.
wall);case"clear":return e.what==="walls"?[{...t,walls:$h(t.grid.shape)},""]:null;case"add_sensor":{if(t.sensors.length>=n.sensors[1])throw new We(`there are ${t.
sensors.length} sensors already; remove one first`);let s=Math.max(...t.sensors.map(o=>o.id))+1;return[{...t,sensors:[...t.sensors,_i(t,{id:s,x:e.x,y:e.y,yaw:e.
yaw??0})]},""]}case"move_sensor":{let s=o=>_i(t,{id:o.id,x:e.x??o.x,y:e.y??o.y,yaw:e.yaw??o.yaw});return[{...t,sensors:t.sensors.map(o=>o.id===e.id?s(o):o)},""]}case"\
remove_sensor":{let s=t.sensors.filter(o=>o.id!==e.id);if(!s.length)throw new We("the last sensor cannot be removed; add another first");return[{...t,sensors:s},
""]}case"new":return[ig(t,e.shape,e.world),""];default:return null}}var $h=([t,e])=>xn(new Uint8Array(t*e+7>>3));function rg(t,e,n){let s=Dh(t),o=t.grid.shape[1];
for(let[i,a]of e)s[i*o+a]=n?1:0;let r="";for(let i of t.sensors){let a=Nh(t,i);s[a]&&(r=`a sensor stands in cell (${Math.floor(a/o)}, ${a%o}): it stays free`),s[a]=
0}return[{...t,walls:xn(Kn(s))},r]}function ig(t,e,n){if(n!=="blank")throw new We("this figure can begin blank maps alone; bayesmap app has others");let[s,o]=e.
map(i=>Math.floor((i-1)/2));return{...t,grid:{shape:e,resolution:1,origin:[-.5,-.5]},walls:$h(e),sensors:[{id:1,x:s,y:o,yaw:0}],noise:og,max_range:2*Math.max(...e)}}
function Ci(t,e,n){let s=t;for(let[h,u]of Object.entries(e)){let d=s[h];if(u!==null&&(typeof d!=typeof u||d===null))throw new We(`${h} is missing, or of another\
 type`);let m=n[h];if(m&&typeof d=="number"&&!(d>=m[0]&&d<=m[1]))throw new We(`${h}: ${d}; give ${m[0]} to ${m[1]}`)}let{grid:o,source:r,sensors:i,walls:a}=s;if(r.
kind!=="simulation")throw new We("this figure shows drawn maps alone; start bayesmap app with the file");if(s.cells!=="binary"||s.pose_sigma>0||s.heading_sigma>
0)throw new We("this figure samples walls seen from known poses alone; bayesmap app samples others");if(s.method==="propagate")throw new We("this figure has no \
belief propagation; choose another method");let[l,c]=n.side;if(!(o.shape.length===2&&o.shape.every(h=>Number.isInteger(h)&&h>=l&&h<=c)&&o.resolution>0))throw new We(
`grid: give ${l} to ${c} cells a side`);if(mt(a).length!==o.shape[0]*o.shape[1]+7>>3)throw new We("walls: another number of cells than the grid's");if(!(i.length>=
n.sensors[0]&&i.length<=n.sensors[1]))throw new We(`sensors: give ${n.sensors[0]} to ${n.sensors[1]}`);return{...s,sensors:i.map(h=>_i(s,h))}}function ag(t){return t.
type==="walls"&&t.stroke?`walls ${t.stroke}`:t.type==="set"&&t.drag?`set ${t.drag} ${Object.keys(t.patch).sort()}`:t.type==="move_sensor"&&t.drag?`move ${t.drag}\
 ${t.id}`:null}var er=class{constructor(e){this.present=e}past=[];future=[];gesture=null;get canUndo(){return this.past.length>0}get canRedo(){return this.future.
length>0}push(e,n){let s=ag(n);(s===null||s!==this.gesture)&&(this.past.push(this.present),this.past.length>sg&&this.past.shift()),this.future=[],this.gesture=s,
this.present=e}step(e){let[n,s]=e?[this.past,this.future]:[this.future,this.past],o=n.pop();return o?(s.push(this.present),this.present=o,this.gesture=null,!0):
!1}};var lg=11102230246251565e-32,Fh=2**32,Ih=1,Oh=2,Uh=3;function Li(t,e,n){let{high:s,low:o}=t,r=o&65535,i=o>>>16,a=n&65535,l=n>>>16,c=r*a,h=i*a+(c>>>16),u=r*l+(h&
65535),d=i*l+(h>>>16)+(u>>>16);t.low=((u&65535)<<16|c&65535)>>>0,t.high=d+Math.imul(s,n)+Math.imul(o,e)>>>0}function Di(t,e){let{high:n,low:s}=t;t.low=(s^(s>>>e|
n<<32-e))>>>0,t.high=(n^n>>>e)>>>0}function $t(t,e,n){let s=e+1;n.high=Math.floor(s/Fh)>>>0,n.low=s>>>0,Li(n,2654435769,2135587861);let o=n.low+t.low;n.high=n.high+
t.high+(o>=Fh?1:0)>>>0,n.low=o>>>0,Di(n,30),Li(n,3210233709,484763065),Di(n,27),Li(n,2496678331,321982955),Di(n,31)}var Ri=({high:t,low:e})=>t*2097152+(e>>>11),
Cn=t=>(Ri(t)+.5)*lg;function bs(...t){let e=s=>BigInt.asUintN(64,s),n=0n;for(let s of t){let o=e((n^BigInt(s))+0x9e3779b97f4a7c15n);o=e((o^o>>30n)*0xbf58476d1ce4e5b9n),
o=e((o^o>>27n)*0x94d049bb133111ebn),n=o^o>>31n}return{high:Number(n>>32n),low:Number(n&0xffffffffn)}}var Ni=2654435761,cg=2246822507;function tr(t,e){let n=Math.
imul(t+e,Ni);return n=Math.imul(n^n>>>15,cg),n^n>>>13}function Wh(t,e,n,s){let o=n>>>1,r=(1<<o)-1,i=(1<<n-o)-1,a=t;do{let l=a>>>o,c=a&r;l^=tr(c,s.low)&i,c^=tr(l,
s.high)&r,l^=tr(c,s.low^Ni)&i,c^=tr(l,s.high^Ni)&r,a=(l<<o|c)>>>0}while(a>=e);return a}var Bh=t=>Math.max(2,32-Math.clz32(t-1));function Gh(t,e){let n={high:0,low:0};
$t(t,e,n);let s=Cn(n);return $t(t,e+1,n),Math.sqrt(-2*Math.log(s))*Math.cos(2*Math.PI*Cn(n))}var hg=2**53,Hh=20,zh=1e15,[nr,$i,Vh]=[0,1,2],or=class{constructor(e){this.p=e;let n=e*hg,s=Math.round(n);this.level=s-n===.5&&s%2?s-1:s,this.logit=Math.min(Math.
max(Math.log(e)-Math.log1p(-e),-zh),zh)}level;logit;draws(e){return Ri(e)<this.level}logProb(e){if(this.p===0||this.p===1)return 0;let n=0;for(let s of e)n+=s;return e.
length*Math.log1p(-this.p)+n*this.logit}};function sr(t,e){return t>40?!0:t<-40?!1:e*(1+Math.exp(-t))<1}function Fi({order:t,shuffle:e},n,s){if(!e)return i=>t[i];
let o=Bh(t.length),r={high:0,low:0};return $t(n,-1-s,r),i=>t[Wh(i,t.length,o,r)]}var rr=class{constructor(e,n,s){this.problem=e;this.walls=n;this.key=s;let{offsets:o,
cells:r,noHit:i}=e.table;this.first=new Int32Array(i.length),this.current=new Float32Array(i.length),this.reached=new Int32Array(n.length),this.gain=new Float32Array(
n.length),this.known=new Uint8Array(n.length);for(let a=0;a<i.length;a++){let l=this.nextWall(o[a],o[a+1]);this.first[a]=l,this.current[a]=this.entryLoglik(a,l);
for(let c=o[a];c<Math.min(l+1,o[a+1]);c++)this.reached[r[c]]++}}first;current;reached;gain;known;bits={high:0,low:0};nextWall(e,n){let{cells:s}=this.problem.table,
o=e;for(;o<n&&!this.walls[s[o]];)o++;return o}entryLoglik(e,n){let{offsets:s,loglik:o,noHit:r}=this.problem.table;return n<s[e+1]?o[n]:r[e]}logLikelihood(){let e=0;
for(let n of this.current)e+=n;return e}moveFirst(e,n){let{offsets:s,cells:o}=this.problem.table,r=s[e+1],i=this.first[e];this.first[e]=n,this.current[e]=this.entryLoglik(
e,n);let a=Math.min(i,n);for(let c=s[e];c<Math.min(a+1,r);c++)this.known[o[c]]=nr;let l=n>i?1:-1;for(let c=a+1;c<Math.min(Math.max(i,n)+1,r);c++)this.known[o[c]]=
nr,this.reached[o[c]]+=l}put(e){let{offsets:n,beam:s,entry:o}=this.problem.index;this.walls[e]=1;for(let r=n[e];r<n[e+1];r++)this.first[s[r]]>o[r]&&this.moveFirst(
s[r],o[r])}remove(e){let{table:n,index:s}=this.problem;this.walls[e]=0;for(let o=s.offsets[e];o<s.offsets[e+1];o++){let r=s.beam[o],i=s.entry[o];this.first[r]===
i&&this.moveFirst(r,this.nextWall(i+1,n.offsets[r+1]))}}sweep(e,n){let{prior:s}=this.problem,o=e.order.length,r=Fi(e,this.key,n);for(let i=0;i<o;i++){let a=r(i);
$t(this.key,n*o+a,this.bits),this.reached[a]?this.walls[a]?this.stays(a,Cn(this.bits))||this.remove(a):this.becomes(a,Cn(this.bits))&&this.put(a):this.walls[a]=
s.draws(this.bits)?1:0}}becomes(e,n){let{logit:s}=this.problem.prior;return this.known[e]===nr&&this.sumGain(e,-Hh-s),sr(s+this.gain[e],n)?this.known[e]===Vh?!0:
(this.sumGain(e,-1e300),sr(s+this.gain[e],n)):!1}sumGain(e,n){let{offsets:s,beam:o,entry:r,loglik:i,gainBound:a}=this.problem.index,l=0,c=Vh;for(let h=s[e];h<s[e+
1];h++){let u=l+a[h];if(u<n){l=u,c=$i;break}this.first[o[h]]>r[h]&&(l+=Math.fround(i[h]-this.current[o[h]]))}this.gain[e]=l,this.known[e]=c}stays(e,n){let{table:s,
index:o,prior:r}=this.problem;if(this.known[e]===nr){let l=0;for(let c=o.offsets[e];c<o.offsets[e+1];c++)this.first[o.beam[c]]===o.entry[c]&&(l+=o.advantage[c]);
this.gain[e]=l,this.known[e]=$i}let i=r.logit+this.gain[e];if(this.known[e]===$i&&i>Hh&&sr(i,n))return!0;let a=0;for(let l=o.offsets[e];l<o.offsets[e+1];l++){let c=o.
beam[l],h=o.entry[l];this.first[c]===h&&(a+=Math.fround(o.loglik[l]-this.entryLoglik(c,this.nextWall(h+1,s.offsets[c+1]))))}return sr(r.logit+a,n)}};var pg=8,ug=-1e300,dg=2**53;function Ii(t,e,n,s){let o=Math.floor(t/s)-e,r=t%s-n;return o<0||o>1||r<0||r>1?-1:2*o+r}function jh({table:t,shape:[e,n]}){let{offsets:s,
cells:o,noHit:r}=t,i=Math.max(1,e-1),a=Math.max(1,n-1),l=Array.from({length:i*a},()=>[]);for(let d=0;d<r.length;d++)for(let m=s[d];m<s[d+1];m++)for(let w=0;w<4;w++){
let b=Math.floor(o[m]/n)-(w>>1),S=o[m]%n-(w&1);if(b<0||b>=i||S<0||S>=a)continue;let T=l[b*a+S],v=T[T.length-1];v?.b===d&&v.last>=m-pg?v.last=m:T.push({b:d,first:m,
last:m})}let c=new Int32Array(l.length+1);l.forEach((d,m)=>c[m+1]=c[m]+d.length);let h=l.flat(),u=d=>Int32Array.from(h,m=>m[d]);return{offsets:c,beam:u("b"),first:u(
"first"),last:u("last"),rows:a}}function Yh(t,e,n,s){let{prior:o,shape:[r,i]}=t.problem,{rows:a}=e,l=n.order.length,c=Fi(n,t.key,s),h=new Float64Array(16),u=new Float64Array(
16),d={high:0,low:0};for(let m=0;m<l;m++){let w=c(m),b=Math.floor(w/a),S=w%a,T=4*(s*l+w),v=L=>b+(L>>1)<r&&S+(L&1)<i?(b+(L>>1))*i+S+(L&1):-1,A=0;for(let L=0;L<4;L++)
v(L)>=0&&(A+=t.reached[v(L)]);if(!A){for(let L=0;L<4;L++)v(L)<0||($t(t.key,T+L,d),t.walls[v(L)]=o.draws(d)?1:0);continue}fg(t,e,w,b,S,h),u.fill(0);for(let L=0;L<
4;L++){let _=v(L)<0||o.level===0,I=!_&&o.level===dg;for(let H=0;H<16;H++)(H>>L&1)===(I?0:1)&&(u[H]+=_||I?ug:o.logit)}for(let L=0;L<16;L++)h[L]+=u[L];$t(t.key,T,
d);let E=mg(h,Cn(d));for(let L=0;L<4;L++){let _=v(L);_<0||(E>>L&1?t.walls[_]||t.put(_):t.walls[_]&&t.remove(_))}}}function fg(t,e,n,s,o,r){let{table:i,shape:[,a]}=t.
problem,{offsets:l,cells:c,loglik:h}=i;r.fill(0);for(let u=e.offsets[n];u<e.offsets[n+1];u++){let d=e.beam[u],m=t.first[d],w=e.first[u];if(m<w)continue;let b=e.
last[u],S=l[d+1],T=m;if(m<=b&&m<S&&Ii(c[m],s,o,a)>=0)for(T=m+1;T<S&&!(t.walls[c[T]]&&Ii(c[T],s,o,a)<0);)T++;let v=t.entryLoglik(d,T),A=0;for(let E=w;E<Math.min(
b+1,T);E++){let L=Ii(c[E],s,o,a);if(L<0)continue;let _=Math.fround(h[E]-v);for(let I=0;I<16;I++)I>>L&1&&!(I&A)&&(r[I]+=_);A|=1<<L}}}function mg(t,e){let n=Math.
max(...t),s=t.map(r=>r>n-40?Math.exp(r-n):0),o=e*s.reduce((r,i)=>r+i,0);for(let r=0;r<16;r++)if(o-=s[r],o<=0&&s[r]>0)return r;return 15}function Ln(t){let e=0;for(let n=0;n<t.length;n++)e+=t[n];return e/t.length}var Oi=t=>{let e=Ln(t);return t.reduce((n,s)=>n+(s-e)**2,0)/(t.length-1)},ir=(t,e)=>t.
reduceRight((n,s)=>n*e+s,0),qh=[[3.3871328727963665,133.14166789178438,1971.5909503065513,13731.69376550946,45921.95393154987,67265.7709270087,33430.57558358813,
2509.0809287301227],[1,42.31333070160091,687.1870074920579,5394.196021424751,21213.794301586597,39307.89580009271,28729.085735721943,5226.495278852854]],Kh=[[1.4234371107496835,
4.630337846156546,5.769497221460691,3.6478483247632045,1.2704582524523684,.2417807251774506,.022723844989269184,.0007745450142783414],[1,2.053191626637759,1.6763848301838038,
.6897673349851,.14810397642748008,.015198666563616457,.0005475938084995345,10507500716444169e-25]];function gg(t){let e=t-.5;if(Math.abs(e)<=.425){let s=.180625-
e*e;return e*ir(qh[0],s)/ir(qh[1],s)}let n=Math.sqrt(-Math.log(e<0?t:1-t))-1.6;return Math.sign(e)*ir(Kh[0],n)/ir(Kh[1],n)}function yg(t){let e=t[0].length>>1;return[
...t.map(n=>n.slice(0,e)),...t.map(n=>n.slice(n.length-e))]}function Jh(t){let e=Float64Array.from(t.flat()).sort(),n=new Map;for(let s=0;s<e.length;){let o=s+1;
for(;o<e.length&&e[o]===e[s];)o++;n.set(e[s],gg(((s+1+o)/2-.375)/(e.length+.25))),s=o}return t.map(s=>s.map(o=>n.get(o)))}function Xh(t){let e=t[0].length;return Math.
sqrt((e-1)/e+Oi(t.map(Ln))/Ln(t.map(Oi)))}function Zh(t,e){let n=t.length;for(let s=1,o=0;s<n;s++){let r=n>>1;for(;o&r;r>>=1)o^=r;o^=r,s<o&&([t[s],t[o],e[s],e[o]]=
[t[o],t[s],e[o],e[s]])}for(let s=2;s<=n;s*=2)for(let o=0;o<s/2;o++){let r=-2*Math.PI*o/s,[i,a]=[Math.cos(r),Math.sin(r)];for(let l=o;l<n;l+=s){let c=l+s/2,[h,u]=[
t[c]*i-e[c]*a,t[c]*a+e[c]*i];[t[c],e[c]]=[t[l]-h,e[l]-u],t[l]+=h,e[l]+=u}}}function wg(t){let e=t.length,n=Ln(t),s=2**Math.ceil(Math.log2(2*e)),[o,r]=[new Float64Array(
s),new Float64Array(s)];t.forEach((i,a)=>o[a]=i-n),Zh(o,r);for(let i=0;i<s;i++)[o[i],r[i]]=[o[i]**2+r[i]**2,0];return Zh(o,r),o.slice(0,e).map(i=>i/s/e)}function bg(t){
let[e,n]=[t.length,t[0].length],s=t.map(wg),o=Ln(s.map(h=>h[0]))*n/(n-1),r=o*(n-1)/n+Oi(t.map(Ln)),i=h=>h?1-(o-Ln(s.map(u=>u[h])))/r:1,a=Math.max(1,Math.ceil((n-
2)/2)),l=-1,c=1/0;for(let h=0;h<a;h++){let u=i(2*h),d=u+i(2*h+1);if(!(d>0)||h===a-1){l+=d>0?u:Math.max(u,0);break}c=Math.min(c,d),l+=2*c}return e*n/Math.max(l,1/
Math.log10(e*n))}function Qh(t){if(t[0].length<4||t.every(c=>c.every(h=>h===t[0][0])))return null;let e=yg(t),n=Float64Array.from(e.flat()).sort(),s=(n[n.length-
1>>1]+n[n.length>>1])/2,o=e.map(c=>c.map(h=>Math.abs(h-s))),r=Jh(e),[i,a]=[Xh(r),Xh(Jh(o))];return{rhat:Number.isNaN(a)?i:Number.isNaN(i)?a:Math.max(i,a),ess:bg(
r)}}function ep({table:t,prior:e,shape:n},s,o,r){let{offsets:i,cells:a,loglik:l,noHit:c}=t,h=n[0]*n[1],u={high:0,low:0},d=new Int8Array(h);return Float64Array.from(
{length:r},(m,w)=>{d.fill(0);let b=0;for(let S=0;S<c.length;S++){let T=c[S];for(let v=i[S];v<i[S+1];v++){let A=a[v];if(d[A]||($t(s,(o+w)*h+A,u),d[A]=e.draws(u)?
1:-1),d[A]>0){T=l[v];break}}b+=T}return b})}function Ui({prior:t,shape:e},n,s){let o=e[0]*e[1],r={high:0,low:0};return Uint8Array.from({length:o},(i,a)=>($t(n,s*
o+a,r),t.draws(r)?1:0))}function tp(t){let e=t.reduce((r,i)=>Math.max(r,i),-1/0),n=e+Math.log(t.reduce((r,i)=>r+Math.exp(i-e),0)),s=t.map(r=>r-n),o=s.reduce((r,i)=>r+
Math.exp(2*i),0);return{logWeights:s,logEvidence:n-Math.log(t.length),effectiveSampleSize:1/o}}var Wi=(t,e)=>e>0?Math.ceil(t-1e-9)-1:Math.floor(t+1e-9),Bi=t=>Math.abs(t)<1e-10?0:t>0?1:-1,ar=class{constructor({x:e,y:n,ux:s,uy:o},r,i,a){this.nx=r;this.ny=i;
this.stepX=Bi(s),this.stepY=Bi(o);let l=0,c=a;this.stepX?(this.gapX=1/Math.abs(s),l=Math.max(l,Math.min(-e/s,(r-e)/s)),c=Math.min(c,Math.max(-e/s,(r-e)/s))):(e<
-1e-9||e>r+1e-9)&&(c=-1),this.stepY?(this.gapY=1/Math.abs(o),l=Math.max(l,Math.min(-n/o,(i-n)/o)),c=Math.min(c,Math.max(-n/o,(i-n)/o))):(n<-1e-9||n>i+1e-9)&&(c=
-1),this.end=c+1e-9,this.x=Wi(e+(this.stepX?l*s:0),this.stepX),this.y=Wi(n+(this.stepY?l*o:0),this.stepY),this.stepX&&(this.nextX=(this.x+Math.max(this.stepX,0)-
e)/s),this.stepY&&(this.nextY=(this.y+Math.max(this.stepY,0)-n)/o),!this.stepX&&Math.abs(e-this.x)<=1e-9&&(this.alongLine=1,this.sideX=-1),!this.stepY&&Math.abs(
n-this.y)<=1e-9&&(this.alongLine=2,this.sideY=-1),this.cellX=this.x,this.cellY=this.y,this.sides=this.alongLine,this.distance=Math.max(0,Math.min(this.nextX,this.
nextY))}cellX;cellY;distance;end;x;y;sides;sideX=0;sideY=0;alongLine=0;stepX;stepY;nextX=1e300;nextY=1e300;gapX=1e300;gapY=1e300;get over(){return this.distance>
this.end}get inside(){return this.cellX>=0&&this.cellX<this.nx&&this.cellY>=0&&this.cellY<this.ny}next(){if(this.sides&1){this.cellX=this.x+this.sideX,this.cellY=
this.y,this.sides&=2;return}if(this.sides){this.cellX=this.x,this.cellY=this.y+this.sideY,this.sides=0;return}let e=this.nextX<this.nextY-1e-9,n=this.nextY<this.
nextX-1e-9;this.distance=e?this.nextX:n?this.nextY:Math.min(this.nextX,this.nextY),this.sides=this.alongLine,e===n&&(this.sideX=-this.stepX,this.sideY=-this.stepY,
this.sides=3),n||(this.nextX+=this.gapX,this.x+=this.stepX),e||(this.nextY+=this.gapY,this.y+=this.stepY),this.cellX=this.x,this.cellY=this.y}};function np(t,[e,
n],s,o){for(let r=new ar(s,e,n,o);!r.over;r.next())if(r.inside&&t[r.cellX*n+r.cellY])return Math.min(r.distance,o);return o}function sp([t,e],n,s){let o=[],r=new Int32Array(
n.length+1);return n.forEach((i,a)=>{for(let l=new ar(i,t,e,s);!l.over;l.next())l.inside&&o.push(l.cellX*e+l.cellY);r[a+1]=o.length}),{offsets:r,cells:Int32Array.
from(o)}}function op({x:t,y:e,ux:n,uy:s},o,r){let i=Math.floor(o/r),a=o-i*r,l=0,c=1e300,h=!0,u=(d,m,w)=>{let b=Bi(m);if(!b)return;let S=1/m,T=w+(b>0?0:1)-d;l=Math.
max(l,T*S),c=Math.min(c,(T+b)*S),h&&=w===Wi(d,b)};return u(t,n,i),u(e,s,a),h?Math.max(c,0):l}var xg=Math.fround(.001),vg=-.5*Math.log(2*Math.PI);function rp(t,e,n,s,o,r){let{offsets:i,cells:a}=t,l=s.sigma_m*s.sigma_m,c=.5*Math.log(l),h=(m,w)=>{let b=m-Math.
min(w,s.max_m);return vg-.5*(b*b/l)-c},u=new Float32Array(a.length),d=new Float32Array(e.length);for(let m=0;m<e.length;m++){d[m]=h(n[m],1/0);for(let w=i[m];w<i[m+
1];w++)u[w]=h(n[m],op(e[m],a[w],o)*r)}return{offsets:i,cells:a,loglik:u,noHit:d}}function ip({offsets:t,cells:e,loglik:n,noHit:s},o){let r=Float32Array.from(s),
i=new Float32Array(e.length);for(let d=0;d<s.length;d++){let m=s[d];for(let w=t[d+1]-1;w>=t[d];w--)i[w]=n[w]-m,m=Math.max(m,n[w]),r[d]=Math.min(r[d],n[w])}let a=new Int32Array(
o+1);for(let d of e)a[d+1]++;for(let d=0;d<o;d++)a[d+1]+=a[d];let l=()=>new Float32Array(e.length),c=()=>new Int32Array(e.length),h={offsets:a,entry:c(),beam:c(),
loglik:l(),gainBound:l(),advantage:l()},u=a.slice();for(let d of[!0,!1])for(let m=0;m<s.length;m++)for(let w=t[m];w<t[m+1];w++){let b=Math.fround(n[w]-r[m]);if(b>
xg!==d)continue;let S=u[e[w]]++;h.entry[S]=w,h.beam[S]=m,h.loglik[S]=n[w],h.gainBound[S]=b,h.advantage[S]=i[w]}for(let d=0;d<o;d++)for(let m=a[d+1]-2;m>=a[d];m--)
h.gainBound[m]+=h.gainBound[m+1];return h}function Gi({angles:t,fov:e}){let n=e*(180/Math.PI);if(n===360)return Float64Array.from({length:t},(o,r)=>r*2*Math.PI/t);let s=n/(t-t%2);return Float64Array.from(
{length:t},(o,r)=>(s*r-n/2)*(Math.PI/180))}function ap(t){let{origin:e,resolution:n}=t.grid,s=[...Gi(t)];return t.sensors.flatMap(({x:o,y:r,yaw:i})=>s.map(a=>({
x:(o-e[0])/n,y:(r-e[1])/n,ux:Math.cos(i+a),uy:Math.sin(i+a)})))}function lp({grid:t,walls:e,max_range:n},s){let o=Lt(mt(e),t.shape[0]*t.shape[1]),r=n/t.resolution;
return Float64Array.from(s,i=>Math.min(np(o,t.shape,i,r)*t.resolution,n))}function cp({grid:t,noise:e,prior:n,max_range:s},o,r){let{shape:i,resolution:a}=t,l=sp(
i,o,s/a),c=rp(l,o,r,{sigma_m:e,max_m:s},i[1],a);return{table:c,index:ip(c,i[0]*i[1]),prior:new or(n),shape:i}}function hp({grid:t,sensors:e,order:n},s){let[o,r]=t.
shape,[i,a]=s?[Math.max(1,o-1),Math.max(1,r-1)]:[o,r],l=Int32Array.from({length:i*a},(d,m)=>m);if(n!=="radial")return{order:l,shuffle:n==="random"};let c=(d,m)=>Math.
min(Math.max(d,0),m-1),h=e.map(({x:d,y:m})=>[c(Math.floor((d-t.origin[0])/t.resolution),o),c(Math.floor((m-t.origin[1])/t.resolution),r)]),u=l.map(d=>Math.min(...h.
map(([m,w])=>Math.abs(Math.floor(d/a)-m)+Math.abs(d%a-w))));return{order:Int32Array.from([...l].sort((d,m)=>u[d]-u[m]||d-m)),shuffle:!1}}var Qt=2,pp=32,kg=300,Sg=100,Mg=64<<20,Tg=.1,Ag=16,Eg=40,Hi=24,up=[.1,.3,.5,.7,.9],mp={chains:0,count:0},Pg={gibbs:"Gibbs sampling, cell by cell",block:"Gibbs s\
ampling, 2 x 2 blocks",importance:"importance sampling",none:"none yet: this is the prior"},xs=()=>performance.now(),dp=t=>Uint8Array.from(t,e=>Math.round(255*e)),
fp=t=>String(+t.toPrecision(4)),vs=class{constructor(e,n){this.document=e;this.problem=n;this.cells=n.shape[0]*n.shape[1]}done=!1;seconds=0;method="none";cells;work(e){
let n=xs();do this.step();while(!this.done&&xs()-n<e);this.seconds+=(xs()-n)/1e3}step(){this.done=!0}get draws(){return mp}beamsThrough(e){let{offsets:n}=this.problem.
index;return n[e+1]-n[e]}mean(){return new Float64Array(this.cells).fill(this.document.prior)}reached(){return new Uint8Array(this.cells)}get logJoint(){return[]}figures(e){
return{sweeps:0,total:0,ess:null,rhat:null,log_joint:null,verdict:null,burned:0}}draw(e){return null}weights(){return null}picture(e,n,s,o){let{document:r,method:i}=this,
a=e.layer==="draw"?this.draw(e):null,l=this.weights(),c=i==="gibbs"?`, ${r.order} order`:"",h={type:"field",generation:n,milliseconds:s,layer:a?"draw":"mean",method:i,
approximate:!1,...this.figures(o),draws:this.draws,quantity:{kind:"binary",mean:"P(wall)",value:"wall",interval:!1},chain:null,draw:null,averaged:null,lowest:l?.
lowest??null,seconds:i==="none"?null:this.seconds,about:[["Method",Pg[i]+c],["Prior",`independent: p wall ${fp(r.prior)}`],["Sensor",`gaussian: sigma ${fp(r.noise)}\
 m`],["Poses","known"],["Computed","in this page"]],...a&&{chain:a.chain,draw:a.draw,log_joint:a.log_joint}},u=dp(a?a.map:this.mean());return[h,{p:u,reached:dp(
this.reached()),...this.trace(),...l&&{weights:l.weights}}]}trace(){let e=this.logJoint,n=e[0]?.length??0,s=Math.min(n,kg),o=Array.from({length:s},(a,l)=>Math.round(
s>1?1+l*(n-1)/(s-1):1)),r=Array.from({length:Math.min(n,Sg)},(a,l)=>l+1),i=[...new Set([...r,...o])].sort((a,l)=>a-l);return{trace:Float32Array.from(e.flatMap(a=>i.
map(l=>a[l-1]))),traced:Float32Array.from(i)}}},Gs=class extends vs{constructor(n,s,o,r){super(n,s);this.judging=o;let{seed:i,start:a,sweeps:l}=n;this.method=r?
"block":"gibbs",this.blocks=r?jh(s):null,this.sites=hp(n,r),this.thin=Math.ceil(l*Qt*Math.ceil(this.cells/8)/Mg),this.chains=Array.from({length:Qt},(c,h)=>{let d=a===
"empty"&&n.prior<1?new Uint8Array(this.cells):Ui(s,bs(i,h,Oh),0);return new rr(s,d,bs(i,h,Ih))}),this.touched=new Uint8Array(this.cells);for(let c of s.table.cells)
this.touched[c]=1;this.present={sweep:0,sums:this.chains.map(()=>new Float64Array(this.cells)),reached:new Uint32Array(this.cells),looks:0},this.past=[this.copy()],
this.goOn(l)}chains;blocks;sites;lookAt=new Set;touched;joint=Array.from({length:Qt},()=>[]);likelihood=Array.from({length:Qt},()=>[]);kept=Array.from({length:Qt},
()=>[]);thin;total=0;sweep=0;present;past;diagnosis=null;diagnosed=0;diagnoseAt=0;goOn(n){let{lookAt:s,document:o}=this;this.total=Math.ceil((this.total+n)/this.
thin)*this.thin,s.add(Math.floor(o.burn_in*this.total));for(let r=1;r<=this.total;r*=2)s.add(r);for(let r=1;r<=pp;r++)s.add(Math.floor(this.total*r/pp));this.done=
!1,this.diagnoseAt=0}burn(n){let s=Math.floor(n/this.thin),o=this.kept.map(r=>{let i=new Float64Array(this.cells);for(let a of r.slice(0,s))Lt(a,this.cells).forEach(
(l,c)=>i[c]+=l);return i.map(a=>a*n/Math.max(1,s))});this.past=[{...this.past[0],sweep:n,sums:o}]}copy(){let{sums:n,reached:s,looks:o}=this.present;return{sweep:this.
sweep,sums:n.map(r=>r.slice()),reached:s.slice(),looks:o}}step(){let{present:n,document:s}=this;this.chains.forEach((r,i)=>{this.blocks?Yh(r,this.blocks,this.sites,
this.sweep):r.sweep(this.sites,this.sweep);let a=n.sums[i];for(let c=0;c<this.cells;c++)a[c]+=r.walls[c];let l=r.logLikelihood();this.likelihood[i].push(l),this.
joint[i].push(l+this.problem.prior.logProb(r.walls)),(this.sweep+1)%this.thin===0&&this.kept[i].push(Kn(r.walls))}),this.sweep++,this.done=this.sweep>=this.total;
let o=Math.floor(s.burn_in*this.total);if(this.done&&o>this.past[0].sweep&&this.past.every(({sweep:r})=>r!==o)&&this.burn(o),!!this.lookAt.has(this.sweep)){for(let r of this.
chains)for(let i=0;i<this.cells;i++)n.reached[i]+=r.reached[i]?1:0;for(n.looks+=Qt,this.sweep<=s.burn_in*this.total&&this.past.push(this.copy());this.past.length>
1&&this.past[1].sweep<=s.burn_in*this.sweep;)this.past.shift()}}get draws(){return this.kept[0].length?{chains:Qt,count:this.kept[0].length}:mp}means(){let[n]=this.
past,s=Math.max(1,this.sweep-n.sweep);return this.present.sums.map((o,r)=>o.map((i,a)=>(i-n.sums[r][a])/s))}mean(){let[n,s]=this.means();return n.map((o,r)=>this.
touched[r]?(o+s[r])/2:this.document.prior)}reached(){let[n]=this.past,s=Math.max(1,this.present.looks-n.looks);return Float64Array.from(this.present.reached,(o,r)=>(o-
n.reached[r])/s)}get logJoint(){return this.joint}draw({chain:n,draw:s}){let o=Math.min(n,Qt-1),{count:r}=this.draws;if(!r)return{map:this.chains[o].walls,chain:o,
draw:0,log_joint:this.joint[o].at(-1)??0};let i=Math.min(s??r-1,r-1);return{map:Lt(this.kept[o][i],this.cells),chain:o,draw:i,log_joint:this.joint[o][(i+1)*this.
thin-1]}}figures(n){let[{sweep:s}]=this.past,o=xs();(o>=this.diagnoseAt||this.done&&this.diagnosed<this.sweep)&&(this.diagnosis=Qh(this.joint.map(c=>c.slice(s))),
this.diagnosed=this.sweep,this.diagnoseAt=this.done?1/0:xs()+(xs()-o)/Tg);let r=this.joint.reduce((c,h)=>c+h[h.length-1],0)/Qt,{ess:i=null,rhat:a=null}=this.diagnosis??
{},l=c=>c!==null&&Number.isFinite(c)?c:null;return{sweeps:this.sweep,total:this.total,ess:l(i),rhat:l(a),log_joint:r,verdict:this.verdict(n||this.done),burned:s}}verdict(n){
let{judging:s,sweep:o}=this,r=o<s.fewest_sweeps;if(r&&!n)return null;let i=(u,d,m=null)=>({level:u,why:d,cell:m}),a=this.difference();if(!r&&a.cells>s.chance_share*
a.among){let[u,d]=a.cell,m=`in ${a.cells} of ${a.among} observed cells, most in cell (${u}, ${d}), by ${a.by.toFixed(2)}`;return i("bad",`P(wall) differs by ove\
r ${s.bad_difference} between the chains ${m}`,a.cell)}if(o<s.fewest_diagnosed)return i("bad",`${o} ${o===1?"sweep is":"sweeps are"} too few to judge`);let{rhat:l=NaN,
ess:c=NaN}=this.diagnosis??{};if(l>s.rhat_limit)return i("bad",`R-hat is ${l.toFixed(2)}, over ${s.rhat_limit}`);let h=this.misfit();return h?i("bad",`the chain\
s agree, but on maps that the readings contradict: they differ by ${+h.toPrecision(3)} times the noise`):!Number.isFinite(l)||!Number.isFinite(c)?i("good","noth\
ing varies: the log joint is the same in all draws of all chains"):c<s.bad_ess?i("bad",`only ${c.toFixed(0)} effective draws`):l>s.good_rhat||c<s.good_ess?i("fa\
ir",`R-hat ${l.toFixed(3)} and ${c.toFixed(0)} effective draws; ${s.good_rhat} and ${s.good_ess} are good`):i("good",`R-hat ${l.toFixed(3)}, ${c.toFixed(0)} eff\
ective draws`)}misfit(){let n=this.problem.table.noHit.length,[{sweep:s}]=this.past,o=-n*Math.log(this.document.noise*Math.sqrt(2*Math.PI)),r=this.likelihood.map(
l=>l.slice(s).reduce((c,h)=>c+h,0)/(l.length-s)),i=2*(o-Math.min(...r)),a=2/(9*n);return i>n*(1-a+this.judging.misfit_sigmas*Math.sqrt(a))**3?Math.sqrt(i/n):null}difference(){
let[n,s]=this.means(),o=this.reached(),r={by:0,cell:[0,0],cells:0,among:0};for(let i=0;i<this.cells;i++){if(o[i]<.5)continue;let a=Math.abs(n[i]-s[i]);r.among++,
a>this.judging.bad_difference&&r.cells++,a>r.by&&([r.by,r.cell]=[a,[Math.floor(i/this.problem.shape[1]),i%this.problem.shape[1]]])}return r}},lr=class extends vs{constructor(n,s,o){
super(n,s);this.judging=o;this.method="importance",this.key=bs(n.seed,0,Uh),this.sums=new Float64Array(this.cells),this.touched=new Uint8Array(this.cells);for(let r of s.
table.cells)this.touched[r]=1}key;logWeights=[];most=-1/0;sum=0;sums;touched;step(){let n=this.logWeights.length,s=Math.min(Ag,this.document.sweeps-n);ep(this.problem,
this.key,n,s).forEach((o,r)=>{if(this.logWeights.push(o),o>this.most){let l=Math.exp(this.most-o);this.sum*=l;for(let c=0;c<this.cells;c++)this.sums[c]*=l;this.
most=o}if(o<this.most-Eg)return;let i=Math.exp(o-this.most),a=Ui(this.problem,this.key,n+r);this.sum+=i;for(let l=0;l<this.cells;l++)a[l]&&(this.sums[l]+=i)}),this.
done=this.logWeights.length>=this.document.sweeps}mean(){return this.sums.map((n,s)=>this.touched[s]?n/this.sum:this.document.prior)}reached(){let n=this.mean(),
{offsets:s,cells:o,noHit:r}=this.problem.table,i=new Float64Array(this.cells);for(let a of up){let l=new Uint8Array(this.cells);for(let c=0;c<r.length;c++)for(let h=s[c];h<
s[c+1]&&(l[o[h]]=1,!(n[o[h]]>a));h++);for(let c=0;c<this.cells;c++)i[c]+=l[c]/up.length}return i}figures(){let{effectiveSampleSize:n}=tp(Float64Array.from(this.
logWeights));return{sweeps:this.logWeights.length,total:this.document.sweeps,ess:n,rhat:null,log_joint:null,verdict:this.verdict(n),burned:0}}verdict(n){let{bad_ess:s,
good_ess:o}=this.judging,r=n.toFixed(1)==="1.0"?"one particle carries":`${n.toFixed(1)} particles carry`;return n<s?{level:"bad",why:`${r} all the weight`,cell:null}:
{level:n>=o?"good":"fair",why:`${n.toFixed(0)} effective particles`,cell:null}}weights(){let n=this.logWeights.map(r=>r-this.most),s=Math.min(-1,...n.filter(Number.
isFinite).reduce((r,i)=>[Math.min(r[0],i)],[0])),o=new Float32Array(Hi);for(let r of n)o[Math.min(Hi-1,Math.floor(Hi*(1-r/s)))]++;return{weights:o,lowest:s}}};var _g=12,Cg=80,Lg=11,Dg=new Set(["path","views","where","ghost","beam"]),zi="This figure has no such tool: bayesmap app has it";async function gp(t){return JSON.
parse(new TextDecoder().decode(await Jn(mt(t))))}function Ng(t,e){let n=lp(t,e),{seed:s,noise:o,angles:r,sensors:i}=t,a=i.map(({id:c})=>bs(s,c,Lg)),l=n.map((c,h)=>t.
readings==="exact"?c:c+o*Gh(a[Math.floor(h/r)],2*(h%r)));return{exact:n,readings:l}}function Rg({method:t,prior:e},{rare_walls:n}){return t!=="auto"?t:Math.min(
e,1-e)<=n?"block":"gibbs"}function yp(t,e=n=>setTimeout(n)){let{limits:n,judging:s}=t,o=new er(t.document),[r,i]=[0,0],[a,l,c]=[!0,!1,!1],h={layer:"mean",chain:0,
draw:null},u="live",d=null,[m,w]=[!1,!1],[b,S]=[0,0],T=(R,F)=>D.onmessage({type:"status",text:R,level:F},{}),v=()=>D.onmessage({type:"state",document:o.present,
generation:r,seq:i,can_undo:o.canUndo,can_redo:o.canRedo,live:a,running:l,working:c,draws:!c&&d?.draws||{chains:0,count:0},scan:0,view:h},{}),A=(R=!1)=>{d&&(S=performance.
now(),D.onmessage(...d.picture(h,r,Math.round(S-b),R)))};function E(){if(m=!1,w||!c)return;let R=!d;d??=_(),u!=="clear"&&d.work(_g);let F=d.done||u==="clear";(R||
F||performance.now()-S>Cg)&&A(),F?(l=c=!1,v()):L()}function L(){m||e(E),m=!0}function _(){let R=o.present,{sensors:F,max_range:Y}=R,W=ap(R),{exact:K,readings:V}=Ng(
R,W),$e=Float64Array.from(F.flatMap(({x:B,y:Ae,yaw:_e})=>[B,Ae,_e])),pe=B=>Float32Array.from(B),re={pose:$e,angles:pe(Gi(R)),ranges:pe(V),exact:pe(K),hit:Uint8Array.
from(K,B=>B<Y?1:0)};D.onmessage({type:"scan",generation:r,ids:F.map(({id:B})=>B),index:null},re);let ie=cp(R,W,V),Q=Rg(R,t);return u==="clear"?new vs(R,ie):Q===
"importance"?new lr(R,ie,s):new Gs(R,ie,s,Q==="block")}function I(R=a?"live":"clear"){r++,u=R,d=null,l=u==="run",c=!0,b=performance.now(),v(),L()}function H(){if(!c)
return v();if(!d)return I("clear");l=c=!1,A(!0),v()}function Z(R){if(R)return o.push(Ci(R,t.document,n),{type:"hello"}),I();if(!r)return I();v(),A()}function j(R){
switch(R.type){case"hello":return Z(R.document);case"run":{u==="live"&&c&&(d??=_());let K=d instanceof Gs?d:null;I("run"),K?.goOn(o.present.sweeps),d=K;return}case"\
cancel":return H();case"live":return a=R.on,l?v():a?I():H();case"view":return h={layer:R.layer,chain:R.chain??h.chain,draw:R.draw??null},v(),A(!c);case"undo":case"\
redo":return o.step(R.type==="undo")?I():(T(`nothing to ${R.type}`,"info"),v());case"export":{if(R.what!=="document")throw new We(zi);let K=new TextEncoder().encode(
`${JSON.stringify(o.present,null,1)}
`);return D.onmessage({type:"download",name:"document.json",mime:"application/json",note:""},{data:K})}case"clear":if(R.what==="inference")return I("clear")}let F=Rh(
o.present,R,n);if(!F)throw new We(zi);let[Y,W]=F;o.push(Y,R),W&&T(W,"warning"),I()}let D={...rn(),open:()=>{D.onmessage({type:"welcome",version:1,limits:n,recorded:!1,
figure:!0,lacks:[]},{}),D.onmessage({type:"worker",state:"ready"},{}),D.onstatus({connected:!0})},send:R=>{if(R.type!=="painted"){if(R.type==="inspect"){let F=d?.
beamsThrough(R.x*o.present.grid.shape[1]+R.y);if(F===void 0)return;let Y={beams_for:null,nats_for:null,beams_against:null,nats_against:null};return D.onmessage(
{type:"cell",x:R.x,y:R.y,each:!1,beams:F,...Y},{})}if(Dg.has(R.type))return T(zi,"warning");i=R.seq??i;try{j(R)}catch(F){if(!(F instanceof We))throw F;if(R.type===
"hello")return D.onmessage({type:"error",text:F.message,remedy:"",seq:i},{});T(F.message,"warning"),v()}}},close:()=>{w=!0}};return D}var Vi=250,$g=8e3;function wp(t){let e=null,n=Vi,s=0,o=!1;function r(){clearTimeout(s);let a=new URL("socket",t());a.protocol=a.protocol.replace("http","ws"),a.
search=t().search;let l=new WebSocket(a),c=!1;e=l,l.binaryType="arraybuffer",l.onopen=()=>{c=!0,n=Vi,i.onstatus({connected:!0})},l.onmessage=({data:h})=>{typeof h==
"string"?i.onmessage(JSON.parse(h),{}):i.onmessage(...Zs(h))},l.onclose=()=>{if(o||e!==l)return;s=window.setTimeout(r,n);let h={connected:!1,retryIn_ms:n};i.onstatus(
h),c||Fg(t()).then(u=>u&&e===l&&i.onstatus({...h,refused:u})),n=Math.min($g,2*n)}}let i={...rn(),open:r,send:a=>{e?.readyState===WebSocket.OPEN&&e.send(JSON.stringify(
a))},retry:()=>{n=Vi,e?.readyState!==WebSocket.OPEN&&r()},close:()=>{o=!0,clearTimeout(s),e?.close()}};return i}async function Fg(t){try{return(await fetch(t.pathname+
t.search,{method:"HEAD",cache:"no-store"})).status===403}catch{return!1}}function bp(t){let e=(s,o=[])=>n.onmessage(s,Ea(s,o)),n={...rn(),open:()=>{t.on("msg:custom",e),n.onstatus({connected:!0})},send:s=>t.send(s),close:()=>t.off("m\
sg:custom",e)};return n}var Ig="This is the map that was drawn here when the connection was lost; undo leads back",cr=t=>Object.assign(window,{bayesmap:t}),H1={render({model:t,el:e}){let n=document.
createElement("div");e.append(n);let s=Bs(n,bp(t),{embedded:!0});return cr(s),()=>s.destroy()}};function xp(t,e){let n=Bs(t,Pa(e),{play:ji(t,()=>n)});cr(n)}var ji=(t,e)=>n=>{
e().destroy(),xp(t,n)};async function Og(){let t=document.querySelector("[data-bayesmap]");if(!t||t.shadowRoot)return;let e=new CSSStyleSheet;e.replaceSync("bod\
y { margin: 0; }"),document.adoptedStyleSheets.push(e);let n=document.querySelector("script[data-recording]");if(n){xp(t,await Qs(n.textContent??""));return}let s=document.
querySelector("script[data-figure]");if(s){let[{document:h,damaged:u},d]=await Promise.all([Cs(),gp(s.textContent??"")]),m=u?{text:_s,level:"error"}:null,w=Bs(t,
yp(d),{adopt:h,notice:m,play:ji(t,()=>w)});cr(w);return}al(new URLSearchParams(location.search).get("token"));let{document:o,damaged:r}=await Cs(),i=o?null:ol(),
a=wp(()=>new URL(location.href));ll(h=>{history.replaceState(null,"",`${location.pathname}?token=${encodeURIComponent(h)}${location.hash}`),a.retry?.()});let c=Bs(
t,a,{adopt:o??i,notice:r?{text:_s,level:"error"}:i?{text:Ig,level:"info"}:null,play:ji(t,()=>c)});cr(c)}Og();export{H1 as default,yp as localTransport,Bs as mount,gp as readFigure,Qs as readRecording,Pa as recordedTransport,wp as webSocketTransport,bp as widgetTransport};
