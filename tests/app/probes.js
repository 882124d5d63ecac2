/* What tests of the page read in it, or do to it; each page of a test has these functions before its own. */

window.probes = {
  /** The page's snapshot, its arrays as texts. */
  read: () => {
    const s = bayesmap.snapshot();
    const bytes = (a) => { let t = ""; for (const v of a) t += String.fromCharCode(v); return btoa(t); };
    const plain = ([name, value]) => [name, value?.buffer ? Array.from(value, String) : value];
    const scan = s.scan && Object.fromEntries(Object.entries(s.scan).map(plain));
    const observed = bytes(s.reached.map((share) => Number(share >= 128)));
    return { ...s, probability: bytes(s.probability), observed, walls: bytes(s.walls), scan };
  },

  /** What a wait in vain tells. */
  brief: () => {
    const s = window.bayesmap?.snapshot();
    const { generation, connected, worker, running, seq, status, stage, painted, events } = s ?? {};
    const { trace, traced, ...shown } = painted ?? {};
    const { method, cells, sweeps } = s?.document ?? {};
    const known = { generation, connected, worker, running, seq, status, stage, shown, method, cells, sweeps, events };
    return JSON.stringify(known);
  },

  /** Wait for the next frame, which paints all that is known: callbacks run in the order in which they are asked for. */
  nextFrame: () => new Promise((done) => requestAnimationFrame(() => done())),

  /** Wait until all actions are confirmed and nothing has been painted for some frames. */
  still: () => new Promise((done) => {
    let before = "", frames = 0;
    const look = () => {
      const { layers, events, seq } = bayesmap.snapshot();
      const now = JSON.stringify([layers, events.paints, seq]);
      frames = now === before && seq.sent === seq.confirmed ? frames + 1 : 0;
      before = now;
      if (frames === 12) done();
      else requestAnimationFrame(look);
    };
    look();
  }),

  /** From now on, `window.seen` is all values that a function of the snapshot takes from frame to frame. */
  watch: (value) => {
    window.seen = [];
    let last;
    const look = () => {
      const now = JSON.stringify(value(bayesmap.snapshot()));
      if (now !== last) window.seen.push(JSON.parse((last = now)));
      requestAnimationFrame(look);
    };
    look();
  },

  /** Where a beam of the scan on show ended, on the page. */
  beamEnd: (beam) => {
    const { scan, document } = bayesmap.snapshot();
    const { resolution, origin } = document.grid;
    const angle = scan.pose[2] + scan.angles[beam];
    const half = (v, axis) => (v - origin[axis]) / resolution - 0.5;
    const end = [Math.cos, Math.sin].map((f, axis) => half(scan.pose[axis] + scan.ranges[beam] * f(angle), axis));
    return bayesmap.cellToClient(...end);
  },

  /** From now on, `window.written` is what is written on canvases, and where. */
  recordWriting: () => {
    window.written = [];
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...rest) {
      const { a, e } = this.getTransform();
      const wide = this.measureText(text).width;
      const from = x - ({ right: wide, end: wide, center: wide / 2 }[this.textAlign] ?? 0);
      window.written.push({ text, left: a * from + e, right: a * (from + wide) + e, y, align: this.textAlign,
                            chart: Boolean(this.canvas.closest(".chart")), wide: this.canvas.width });
      return fillText.call(this, text, x, y, ...rest);
    };
  },

  /** From now on, `window.bars` is where bars are drawn on the trace, and how far it reaches, pixels. */
  recordBars: () => {
    window.bars = [];
    const fill = CanvasRenderingContext2D.prototype.fillRect;
    CanvasRenderingContext2D.prototype.fillRect = function (x, y, width, height) {
      const chart = this.canvas.closest?.(".chart");
      const over = chart?.querySelector(".u-over").getBoundingClientRect();
      const own = this.canvas.getBoundingClientRect();
      if (chart && width === 2) window.bars.push([x + 1, (over.right - own.left) * devicePixelRatio]);
      return fill.call(this, x, y, width, height);
    };
  },

  /** How many pixels of a trace's canvas have the colour of each of two chains. */
  inked: (canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const near = (i, r, g, b) => data[i + 3] > 100 && Math.hypot(data[i] - r, data[i + 1] - g, data[i + 2] - b) < 60;
    let blue = 0, orange = 0;
    for (let i = 0; i < data.length; i += 4) { blue += near(i, 0, 114, 178); orange += near(i, 213, 94, 0); }
    return [blue, orange];
  },

  /** An element inside the page's shadow. */
  inside: (selector) => document.querySelector("[data-bayesmap]").shadowRoot.querySelector(selector),

  /** The sum of the opacities of the rays' pixels. */
  darkness: () => {
    const canvas = probes.inside("canvas.rays");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, value, i) => sum + (i % 4 === 3 ? value : 0), 0);
  },

  /** The opacity of the layer of hypotheses at each cell's centre, (cells x, cells y). */
  opacity: () => {
    const canvas = probes.inside("canvas.hypothesis");
    const context = canvas.getContext("2d");
    const box = canvas.getBoundingClientRect();
    const [nx, ny] = bayesmap.snapshot().document.grid.shape;
    const opacity = (x, y) => {
      const at = bayesmap.cellToClient(x, y);
      return context.getImageData(at.x - box.x, at.y - box.y, 1, 1).data[3];
    };
    return Array.from({ length: nx }, (_, x) => Array.from({ length: ny }, (_, y) => opacity(x, y)));
  },

  heights: () => [".stage", ".legend"].map((part) => probes.inside(part).getBoundingClientRect().height),

  /** Drop a file on the page. */
  drop: ([name, text]) => {
    const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes], name));
    const host = document.querySelector("[data-bayesmap]");
    host.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  },

  /** Of the control that has the focus: its name, whether that is seen, and its kind. */
  focus: () => {
    const e = document.querySelector("[data-bayesmap]").shadowRoot.activeElement;
    if (!e) return null;
    const ring = (x) => getComputedStyle(x).outlineStyle !== "none";
    const name = e.getAttribute("aria-label") ?? e.labels?.[0]?.textContent ?? e.textContent;
    return [name.trim(), ring(e) || ring(e.closest("label") ?? e), e.tagName];
  },

  /** Cut the line, which stays cut until `mend`. */
  cut: () => {
    const Real = WebSocket;
    const send = Real.prototype.send;
    Real.prototype.send = function (data) { this.close(); };
    window.WebSocket = class { static OPEN = 1; constructor() { setTimeout(() => this.onclose?.()); } close() {} };
    window.mend = () => { window.WebSocket = Real; Real.prototype.send = send; };
  },

  /** Mount the widget's view, as anywidget does, with a model whose messages the test carries. */
  mount: async () => {
    const { default: widget } = await import(document.querySelector("script[type=module]").src);
    const listeners = [];
    window.model = {
      sent: [],
      on: (event, listener) => listeners.push(listener),
      off: () => {},
      send: (message) => model.sent.push(message),
      deliver: (message, packed) => {
        const views = packed.map((text) => new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer));
        for (const listener of listeners) listener(message, views);
      },
    };
    const element = document.body.appendChild(document.createElement("div"));
    window.close_it = widget.render({ model, el: element });
  },

  /** The fan of the ghost, its quantiles as texts: some are infinite. */
  fan: () => {
    const f = bayesmap.snapshot().ghost.fan;
    return { ...f, quantiles: [f.low, f.median, f.high].map((a) => [...a].map(String)), angles: [...f.angles] };
  },
};
