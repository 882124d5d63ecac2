/**
 * bayesmap's page: draw walls, drag the robot, watch the posterior.
 *
 * One module, three homes: the page of `bayesmap app` (WebSocket), the notebook widget (anywidget), and the static
 * export (a recording inside the file). The protocol is described in docs/app.md; nothing here computes inference.
 *
 *   geometry    bits, cells, lines, rays
 *   colour      the probability and entropy palettes, light and dark
 *   session     what the page knows: the document, edits not yet confirmed, the newest field
 *   painter     the canvas
 *   hand        pointer and keyboard on the canvas
 *   controls    everything in the DOM
 *   transports  WebSocket, anywidget, recording
 *   mount       ties them together
 *
 * @module mapview
 */

// ------------------------------------------------------------------------------------------------------ types

/** @typedef {{shape: [number, number], resolution: number, origin: [number, number]}} Grid */
/** @typedef {{id: number, x: number, y: number, yaw: number}} Sensor metres and radians, world frame */
/** @typedef {{kind: string, name?: string, scans?: number}} Source */
/**
 * @typedef {{version: number, grid: Grid, walls: string, sensors: Sensor[], prior: number, noise: number,
 *   angles: number, max_range: number, method: string, order: string, sweeps: number, seed: number,
 *   source: Source}} MapDocument
 */
/** @typedef {{type: string, [field: string]: any}} Message */
/** @typedef {Uint8Array | Float32Array | Float64Array} Numbers */
/** @typedef {{[name: string]: Numbers}} Buffers */
/** @typedef {{layer: string, chain: number, draw: number | null}} View without a number the last draw */
/** @typedef {{connected: boolean, retryIn_ms?: number}} Connection */
/**
 * @typedef {object} Transport
 * @property {(message: Message) => void} send
 * @property {(message: Message, buffers: Buffers) => void} onmessage set by the page
 * @property {(connection: Connection) => void} onstatus set by the page
 * @property {() => void} open begins; the page has set its two listeners
 * @property {() => void} [retry] tries again now
 * @property {() => void} close
 */
/**
 * @typedef {object} Field one picture of the posterior
 * @property {number} generation
 * @property {string} layer
 * @property {string} method
 * @property {boolean} approximate
 * @property {number} sweeps
 * @property {number} total
 * @property {number | null} [ess]
 * @property {number | null} [rhat]
 * @property {number | null} [log_joint]
 * @property {number} [milliseconds]
 * @property {number} [chain]
 * @property {number} [draw]
 * @property {Uint8Array} p (nx, ny), probability in 255ths
 * @property {Uint8Array} observed (nx, ny), 0 or 1
 * @property {Uint8Array} bits observed, as it came
 */
/**
 * @typedef {{ids: number[], index: number | null, pose: Numbers, angles: Numbers, ranges: Numbers,
 *   exact: Numbers}} Scan
 */
/** @typedef {{x: number, y: number}} Point */
/** @typedef {"draw" | "erase" | "sensor" | "pan"} Tool */

// --------------------------------------------------------------------------------------------------- geometry

/**
 * @param {number} value @param {number} low @param {number} high
 */
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

/** The n first bits, most significant first, one byte each. @param {Uint8Array} bytes @param {number} n */
export function unpackBits(bytes, n) {
  const bits = new Uint8Array(n);
  for (let i = 0; i < n; i++) bits[i] = (bytes[i >> 3] >> (7 - (i & 7))) & 1;
  return bits;
}

/** The inverse of `unpackBits`. @param {Uint8Array} bits */
export function packBits(bits) {
  const bytes = new Uint8Array((bits.length + 7) >> 3);
  for (let i = 0; i < bits.length; i++) if (bits[i]) bytes[i >> 3] |= 128 >> (i & 7);
  return bytes;
}

/** @param {string} text base64, of either alphabet */
export function fromBase64(text) {
  const binary = atob(text.replace(/-/g, "+").replace(/_/g, "/"));
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** @param {Uint8Array} bytes */
export function toBase64(bytes) {
  let binary = "";
  for (let i = 0; i < bytes.length; i += 8192) binary += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(binary);
}

/** Bytes through a (de)compression stream. @param {Uint8Array} bytes @param {GenericTransformStream} stream */
async function through(bytes, stream) {
  const piped = new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (bytes)]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}
const inflate = (/** @type {Uint8Array} */ bytes) => through(bytes, new DecompressionStream("deflate-raw"));
const deflate = (/** @type {Uint8Array} */ bytes) => through(bytes, new CompressionStream("deflate-raw"));

/** The fragment of a share link: base64url of the deflated document. @param {MapDocument} document */
export async function toFragment(document) {
  const packed = await deflate(new TextEncoder().encode(JSON.stringify(document)));
  return "#m=" + toBase64(packed).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** The document of a fragment, or null if it holds none. @param {string} fragment @returns {Promise<MapDocument | null>} */
export async function fromFragment(fragment) {
  const match = /^#m=([\w-]+)$/.exec(fragment);
  return match && JSON.parse(new TextDecoder().decode(await inflate(fromBase64(match[1]))));
}

/**
 * Cells from one to another without a gap (Bresenham): neighbours share an edge or a corner, and beams stop at corners.
 * @param {Point} from @param {Point} to
 * @returns {Point[]}
 */
export function lineOfCells(from, to) {
  const cells = [];
  const steps = Math.max(Math.abs(to.x - from.x), Math.abs(to.y - from.y));
  for (let i = 0; i <= steps; i++) {
    const t = steps ? i / steps : 0;
    cells.push({ x: Math.round(from.x + t * (to.x - from.x)), y: Math.round(from.y + t * (to.y - from.y)) });
  }
  return cells;
}

/** The edges between walls and free cells, in cells from the grid's lower left corner. */
/** @param {Uint8Array} walls @param {number} nx @param {number} ny */
export function wallEdges(walls, nx, ny) {
  const path = new Path2D();
  const at = (/** @type {number} */ x, /** @type {number} */ y) =>
    x >= 0 && x < nx && y >= 0 && y < ny ? walls[x * ny + y] : 0;
  for (let x = 0; x <= nx; x++) {
    for (let y = 0, start = -1; y <= ny; y++) {
      const edge = y < ny && at(x - 1, y) !== at(x, y);
      if (edge && start < 0) start = y;
      if (!edge && start >= 0) {
        path.moveTo(x, start);
        path.lineTo(x, y);
        start = -1;
      }
    }
  }
  for (let y = 0; y <= ny; y++) {
    for (let x = 0, start = -1; x <= nx; x++) {
      const edge = x < nx && at(x, y - 1) !== at(x, y);
      if (edge && start < 0) start = x;
      if (!edge && start >= 0) {
        path.moveTo(start, y);
        path.lineTo(x, y);
        start = -1;
      }
    }
  }
  return path;
}

/** Entropy of a cell in bits. @param {number} p */
export const entropyBits = (p) => (p <= 0 || p >= 1 ? 0 : -(p * Math.log2(p) + (1 - p) * Math.log2(1 - p)));

/** With a capital. @param {string} text */
const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** 1, 2 or 5 times a power of ten, at least `least`. @param {number} least */
function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((m) => m * power >= least) ?? 10);
}

// ----------------------------------------------------------------------------------------------------- colour
// As in bayesmap.viz.palette: probability runs from paper to ink along a straight line in CIELAB, so equal steps look
// equally large to all kinds of colour vision; marks are Okabe and Ito's; unobserved is warm, hatched, and neither.

/** @typedef {[number, number, number]} Triple */

const LIGHT = {
  paper: /** @type {Triple} */ ([98, 0, 1]),
  ink: /** @type {Triple} */ ([14, 6, -24]),
  unobserved: "#efe7d8",
  unobservedWall: "#d3c5aa",
  hatch: "#bfae92",
  truth: "#d55e00",
  ray: "#0072b2",
  noReturn: "#b0679a",
  sensor: "#009e73",
  halo: "#ffffff",
  lines: "rgba(20,30,60,.07)",
  frame: "#6b7078",
  axis: "#565d68",
  ground: "#f4f5f7",
};
const DARK = {
  paper: /** @type {Triple} */ ([17, 0, -5]),
  ink: /** @type {Triple} */ ([95, -2, 6]),
  unobserved: "#322d25",
  unobservedWall: "#5a503f",
  hatch: "#635843",
  truth: "#f08c3c",
  ray: "#56b4e9",
  noReturn: "#d99abf",
  sensor: "#2fcf9f",
  halo: "#10141a",
  lines: "rgba(220,230,255,.07)",
  frame: "#7d8694",
  axis: "#a3abb8",
  ground: "#12151a",
};
/** @typedef {typeof LIGHT} Theme */

/** Cividis in 16 steps (Nunez, Anderton and Renslow 2018). */
const CIVIDIS =
  "00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";

/** CIELAB (D65) to sRGB in 0..255 (IEC 61966-2-1). @param {Triple} lab @returns {Triple} */
function labToRgb([l, a, b]) {
  const fy = (l + 16) / 116;
  const [x, y, z] = [fy + a / 500, fy, fy - b / 200].map((f, i) => {
    const ratio = f > 6 / 29 ? f ** 3 : 3 * (6 / 29) ** 2 * (f - 4 / 29);
    return ratio * [0.95047, 1, 1.08883][i];
  });
  return /** @type {Triple} */ (
    [
      3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
      -0.969266 * x + 1.8760108 * y + 0.041556 * z,
      0.0556434 * x - 0.2040259 * y + 1.0572252 * z,
    ].map((v) => {
      const c = clamp(v, 0, 1);
      return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
    })
  );
}

/** @param {string} hex @param {number} [at] @returns {Triple} */
const hexRgb = (hex, at = 1) => /** @type {Triple} */ ([0, 2, 4].map((k) => parseInt(hex.slice(at + k, at + k + 2), 16)));

/** @param {Triple} a @param {Triple} b @param {number} t @returns {Triple} */
const mix = (a, b, t) => /** @type {Triple} */ (a.map((v, i) => v + t * (b[i] - v)));

/** The colour of wall probability p. @param {Theme} theme @param {number} p */
const probabilityRgb = (theme, p) => labToRgb(mix(theme.paper, theme.ink, p));

/** The colour of an entropy in bits. @param {number} bits */
function entropyRgb(bits) {
  const i = Math.min(15, Math.floor(bits * 16));
  return mix(hexRgb(CIVIDIS, 6 * i), hexRgb(CIVIDIS, 6 * i + 6), bits * 16 - i);
}

/**
 * 512 packed pixels: by probability in 255ths where a beam has been, and 256 on where none has.
 * @param {Theme} theme @param {boolean} entropy
 */
function paletteOf(theme, entropy) {
  const pixels = new Uint8ClampedArray(4 * 512).fill(255);
  const faded = [hexRgb(theme.unobserved), hexRgb(theme.unobservedWall)];
  for (let i = 0; i < 256; i++) {
    pixels.set(entropy ? entropyRgb(entropyBits(i / 255)) : probabilityRgb(theme, i / 255), 4 * i);
    pixels.set(mix(faded[0], faded[1], entropy ? 0 : i / 255), 4 * (i + 256));
  }
  return new Uint32Array(pixels.buffer);
}

/** A CSS gradient of a palette, for the legend. @param {(t: number) => Triple} color */
const gradient = (color) =>
  `linear-gradient(90deg,${[0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1].map((t) => `rgb(${color(t).map(Math.round)})`)})`;

// ---------------------------------------------------------------------------------------------------- session

/** What a document may hold (docs/app.md). */
const LIMITS = { cells: [2, 500], sensors: 32, angles: [10, 1000], noise: [0, 5], sweeps: [1, 100000] };

/** Messages whose effect the page shows before they are confirmed. */
const FORESEEN = new Set(["walls", "sensor", "set", "view", "live"]);

/** What the page knows. It changes by `receive` and `act`, and calls `changed` after. */
export class Session {
  /** @param {Transport} transport @param {() => void} changed */
  constructor(transport, changed) {
    this.transport = transport;
    this.changed = changed;
    /** @type {Connection} */
    this.connection = { connected: false };
    this.everConnected = false;
    /** @type {MapDocument | null} the document with the edits that are on their way */
    this.document = null;
    /** @type {MapDocument | null} the document to adopt on connecting, from a share link */
    this.adopt = null;
    this.recorded = false;
    this.seq = 0;
    this.acted = 0;
    this.generation = -1;
    this.walls = new Uint8Array(0);
    this.wallsVersion = 0;
    this.packed = { version: -1, text: "" };
    /** Whether the walls are ahead of the confirmed ones. */
    this.ahead = false;
    /** @type {Message | null} the last `state` */
    this.state = null;
    /** @type {{text: string, walls: Uint8Array}} */
    this.confirmedWalls = { text: "", walls: this.walls };
    /** @type {Message[]} */
    this.pending = [];
    /** @type {View} */
    this.view = { layer: "mean", chain: 0, draw: null };
    /** @type {Scan | null} */
    this.scan = null;
    /** @type {Field | null} accepted, to be painted next */
    this.next = null;
    /** @type {Field | null} on the canvas */
    this.shown = null;
    /** @type {{generation: number, from: [number, number], joint: [number, number][]}} of the chain on show */
    this.trace = { generation: -1, from: [0, 0], joint: [] };
    /** @type {{x: number, y: number, beams: number} | null} */
    this.cell = null;
    this.status = { text: "Connecting", level: "info" };
    /** The last action before the status: what is said of a refusal holds until another is done. */
    this.saidAt = 0;
    this.worker = "starting";
    this.events = { paints: 0, stale: 0, eventToPaint_ms: /** @type {number[]} */ ([]) };
    /** @type {{seq: number, time: number}[]} pointer events whose picture is still to come */
    this.waiting = [];
    /** @type {Map<number, number>} */
    this.seqOfGeneration = new Map();
    /** @type {(name: string, mime: string, data: Uint8Array) => void} */
    this.ondownload = () => {};
  }

  get shape() {
    return this.document ? this.document.grid.shape : /** @type {[number, number]} */ ([1, 1]);
  }
  get editable() {
    return !this.recorded && this.document?.source.kind === "simulation";
  }
  get running() {
    return Boolean(this.state?.running);
  }
  get draws() {
    return /** @type {{chains: number, count: number}} */ (this.state?.draws ?? { chains: 0, count: 0 });
  }

  /** Whether there is a chain on show, and it goes on. */
  get sampling() {
    const field = this.shown;
    return Boolean(field && !field.approximate && field.sweeps < field.total && (this.running || this.state?.live));
  }
  /** The draw on show, from 0. */
  get draw() {
    const last = Math.max(0, this.draws.count - 1);
    return Math.min(last, this.view.draw ?? (this.shown?.layer === "draw" ? (this.shown.draw ?? last) : last));
  }
  get hasDraws() {
    return this.draws.count > 0 || (!this.recorded && /gibbs|block/.test(this.document?.method ?? ""));
  }

  /** @param {string} text @param {string} [level] */
  say(text, level = "info") {
    this.status = { text, level };
    this.saidAt = this.acted;
    this.changed();
  }

  /**
   * Sends an action; its effect shows at once.
   * @param {Message} message @param {Event} [event] the pointer event that it came from, to time its picture
   */
  act(message, event) {
    if (!this.document && message.type !== "hello") return;
    const sent = { ...message, seq: ++this.seq };
    if (message.type !== "inspect") this.acted = this.seq; // a question changes nothing, and no state confirms it
    if (FORESEEN.has(message.type)) {
      this.pending.push(sent);
      this.foresee(sent);
    }
    if (event) this.waiting.push({ seq: sent.seq, time: event.timeStamp });
    if (this.connection.connected) this.transport.send(sent);
    this.changed();
  }

  /** @param {Connection} connection */
  onstatus(connection) {
    this.connection = connection;
    if (connection.connected) {
      // on a reconnection the document goes back to the server, with what was edited meanwhile
      const document = this.everConnected ? this.effectiveDocument() : this.adopt;
      this.pending = [];
      this.waiting = [];
      this.act(document ? { type: "hello", document } : { type: "hello" });
      if (this.everConnected) this.say("Connected again");
      this.everConnected = true;
    } else if (this.everConnected) this.say("Connection lost", "error");
    this.changed();
  }

  /** @returns {MapDocument | null} */
  effectiveDocument() {
    if (this.packed.version !== this.wallsVersion) this.packed = { version: this.wallsVersion, text: toBase64(packBits(this.walls)) };
    return this.document && { ...this.document, walls: this.packed.text };
  }

  /** @param {Message} message @param {Buffers} buffers */
  receive(message, buffers) {
    switch (message.type) {
      case "welcome":
        this.generation = -1;
        this.recorded = Boolean(message.recorded);
        this.seqOfGeneration.clear();
        this.next = null;
        break;
      case "state":
        this.receiveState(message);
        break;
      case "scan":
        if (message.generation >= this.generation) {
          const { pose, angles, ranges, exact } = buffers;
          this.scan = { ids: message.ids ?? [], index: message.index ?? null, pose, angles, ranges, exact };
        }
        break;
      case "field":
        this.receiveField(message, buffers);
        break;
      case "cell":
        this.cell = { x: message.x, y: message.y, beams: message.beams };
        break;
      case "status":
        this.status = { text: sentence(message.text), level: message.level ?? "info" };
        this.saidAt = this.acted;
        break;
      case "error":
        this.status = { text: sentence([message.text, message.remedy].filter(Boolean).join("; ")), level: "error" };
        this.saidAt = this.acted;
        this.pending = this.pending.filter((edit) => edit.seq !== message.seq);
        this.waiting = this.waiting.filter((event) => event.seq !== message.seq);
        this.rebuild();
        break;
      case "worker":
        this.worker = message.state;
        if (message.state === "restarted") {
          this.status = { text: "The worker stopped and is being started again; the map is kept", level: "warning" };
        } else if (message.state === "ready" && (this.status.text === "Connecting" || /worker/.test(this.status.text))) {
          this.status = { text: this.status.text === "Connecting" ? "Ready" : "The worker runs again", level: "info" };
        }
        break;
      case "download":
        this.ondownload(message.name, message.mime, /** @type {Uint8Array} */ (buffers.data));
        this.status = { text: `Saved ${message.name}`, level: "info" };
        break;
    }
    this.changed();
  }

  /** @param {Message} message */
  receiveState(message) {
    const overcome = this.status.level !== "info" && (message.seq ?? 0) > this.saidAt && !/worker/.test(this.status.text);
    if (this.status.text === "Connecting" || overcome) this.status = { text: "Ready", level: "info" };
    this.state = message;
    this.generation = Math.max(this.generation, message.generation);
    this.seqOfGeneration.set(message.generation, message.seq ?? 0);
    this.pending = this.pending.filter((edit) => edit.seq > (message.seq ?? 0));
    this.rebuild();
  }

  /** The document as confirmed, and on it the edits that are on their way. */
  rebuild() {
    if (!this.state) return;
    const document = /** @type {MapDocument} */ (this.state.document);
    const [nx, ny] = document.grid.shape;
    const confirmed = this.confirmedWalls;
    if (document.walls !== confirmed.text || confirmed.walls.length !== nx * ny) {
      this.confirmedWalls = { text: document.walls, walls: unpackBits(fromBase64(document.walls), nx * ny) };
    }
    this.document = { ...document, sensors: document.sensors.map((sensor) => ({ ...sensor })) };
    if (this.confirmedWalls !== confirmed || this.ahead) {
      this.walls = this.confirmedWalls.walls.slice();
      this.wallsVersion++;
      this.ahead = false;
    }
    if (this.state.view && !this.pending.some((edit) => edit.type === "view")) {
      const { layer, chain, draw } = this.state.view;
      this.view = { layer: layer ?? "mean", chain: chain ?? 0, draw: draw ?? null };
    }
    for (const edit of this.pending) this.foresee(edit);
  }

  /** Shows what an edit will do. @param {Message} edit */
  foresee(edit) {
    const document = this.document;
    if (!document) return;
    const ny = document.grid.shape[1];
    if (edit.type === "walls") {
      for (const [x, y] of edit.cells) this.walls[x * ny + y] = edit.wall ? 1 : 0;
      this.wallsVersion++;
      this.ahead = true;
    } else if (edit.type === "set") {
      Object.assign(document, edit.patch);
    } else if (edit.type === "live") {
      this.state = { .../** @type {Message} */ (this.state), live: edit.on };
    } else if (edit.type === "view") {
      this.view = { layer: edit.layer, chain: edit.chain ?? this.view.chain, draw: edit.draw ?? null };
    } else if (edit.type === "sensor" && edit.op === "move") {
      const sensor = document.sensors.find((candidate) => candidate.id === edit.id);
      if (sensor) Object.assign(sensor, { x: edit.x, y: edit.y, yaw: edit.yaw });
    }
  }

  /** @param {Message} message @param {Buffers} buffers */
  receiveField(message, buffers) {
    if (message.generation < this.generation) {
      this.events.stale++;
      return;
    }
    this.generation = message.generation;
    const p = /** @type {Uint8Array} */ (buffers.p);
    const bits = /** @type {Uint8Array} */ (buffers.observed);
    const old = this.next ?? this.shown;
    // most frames of a chain see the same cells
    const same = old && old.p.length === p.length && old.bits.every((byte, i) => byte === bits[i]);
    const observed = same ? old.observed : unpackBits(bits, p.length);
    this.next = /** @type {any} */ ({ ...message, p, observed, bits: same ? old.bits : bits });
    if (!message.approximate && message.sweeps > 0) {
      const last = this.trace.joint.at(-1);
      if (this.trace.generation !== message.generation || (last && message.sweeps < last[0])) {
        this.trace = { generation: message.generation, from: [message.sweeps, performance.now()], joint: [] };
      }
      if (message.log_joint != null && last?.[0] !== message.sweeps) this.trace.joint.push([message.sweeps, message.log_joint]);
    }
  }

  /** Seconds until the chain on show is done, or null where nothing can be said. */
  remaining_s() {
    const field = this.shown;
    if (!field || !this.sampling) return null;
    const [sweeps, time] = this.trace.from;
    const done = field.sweeps - sweeps;
    return done > 0 ? ((field.total - field.sweeps) * (performance.now() - time)) / done / 1000 : null;
  }

  /** Takes the newest field for painting; the pointer events that it answers are timed by `painted`. */
  take() {
    if (!this.next) return false;
    this.shown = this.next;
    this.next = null;
    return true;
  }

  /** The field on show is on the canvas now. */
  painted() {
    this.events.paints++;
    const field = /** @type {Field} */ (this.shown);
    const seq = this.seqOfGeneration.get(field.generation);
    if (seq === undefined) return;
    const now = performance.now();
    this.waiting = this.waiting.filter((event) => {
      if (event.seq > seq) return true;
      this.events.eventToPaint_ms.push(now - event.time);
      return false;
    });
    for (const generation of this.seqOfGeneration.keys()) {
      if (generation < field.generation) this.seqOfGeneration.delete(generation);
    }
  }
}

// ---------------------------------------------------------------------------------------------------- painter

/** Room for the axes, in CSS pixels. */
const GUTTER = { left: 36, right: 12, top: 34, bottom: 26 };

/**
 * @typedef {object} Look what to draw besides the map
 * @property {Theme} theme
 * @property {boolean} truth
 * @property {boolean} rays
 * @property {boolean} readings
 * @property {Point | null} hover
 * @property {Point | null} cursor the keyboard's
 * @property {number | null} selected a sensor's id, with a handle to turn it
 */

/** Draws the session on a canvas; one blit a layer, whatever the number of cells. */
export class Painter {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.width = 0;
    this.height = 0;
    this.ratio = 1;
    /** CSS pixels a cell, and where the map's upper left corner is, on a device pixel. */
    this.transform = { scale: 1, x: 0, y: 0 };
    /** That corner before it was rounded. */
    this.corner = { x: 0, y: 0 };
    this.fitted = true;
    this.cells = document.createElement("canvas").getContext("2d");
    this.mask = document.createElement("canvas").getContext("2d");
    this.hatch = document.createElement("canvas").getContext("2d");
    this.drawn = { field: /** @type {Field | null} */ (null), bits: /** @type {Uint8Array | null} */ (null), palette: "", hatch: "", walls: -1 };
    this.image = new ImageData(1, 1);
    this.edges = new Path2D();
    /** @type {Map<string, Uint32Array>} */
    this.palettes = new Map();
  }

  /** @param {number} width @param {number} height @param {number} ratio */
  resize(width, height, ratio) {
    [this.width, this.height, this.ratio] = [width, height, ratio];
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
    this.drawn.hatch = "";
  }

  /** The whole map, centred, on whole device pixels where cells are large. @param {[number, number]} shape */
  fit([nx, ny]) {
    const room = { x: this.width - GUTTER.left - GUTTER.right, y: this.height - GUTTER.top - GUTTER.bottom };
    let scale = Math.max(0.05, Math.min(room.x / nx, room.y / ny));
    if (scale * this.ratio > 4) scale = Math.floor(scale * this.ratio) / this.ratio;
    this.transform.scale = scale;
    this.corner = { x: GUTTER.left + (room.x - scale * nx) / 2, y: GUTTER.top + (room.y - scale * ny) / 2 };
    this.fitted = true;
    this.settle([nx, ny]);
  }

  /** Zooms about a point of the canvas. @param {number} factor @param {Point} about @param {[number, number]} shape */
  zoom(factor, about, shape) {
    const { scale } = this.transform;
    const { x, y } = this.corner;
    const next = clamp(scale * factor, Math.min(this.width, this.height) / Math.max(...shape) / 3, 160);
    const k = next / scale;
    this.transform.scale = next;
    this.corner = { x: about.x - k * (about.x - x), y: about.y - k * (about.y - y) };
    this.fitted = false;
    this.settle(shape);
  }

  /** @param {number} dx @param {number} dy @param {[number, number]} shape */
  pan(dx, dy, shape) {
    this.corner.x += dx;
    this.corner.y += dy;
    this.fitted = false;
    this.settle(shape);
  }

  /** Keeps a part of the map in sight, and its corner on a device pixel. @param {[number, number]} shape */
  settle([nx, ny]) {
    const { scale } = this.transform;
    const keep = 60;
    this.corner.x = clamp(this.corner.x, keep - nx * scale, this.width - keep);
    this.corner.y = clamp(this.corner.y, keep - ny * scale, this.height - keep);
    this.transform.x = Math.round(this.corner.x * this.ratio) / this.ratio;
    this.transform.y = Math.round(this.corner.y * this.ratio) / this.ratio;
  }

  /** Cells from the grid's lower left corner, of a point of the canvas. @param {Point} point @param {number} ny */
  toGrid(point, ny) {
    const { scale, x, y } = this.transform;
    return { x: (point.x - x) / scale, y: ny - (point.y - y) / scale };
  }

  /** @param {Point} grid @param {number} ny */
  fromGrid(grid, ny) {
    const { scale, x, y } = this.transform;
    return { x: x + grid.x * scale, y: y + (ny - grid.y) * scale };
  }

  /** @param {Session} session @param {Look} look */
  paint(session, look) {
    const { context, width, height, ratio } = this;
    const { theme } = look;
    const [nx, ny] = session.shape;
    const { scale, x, y } = this.transform;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = theme.ground;
    context.fillRect(0, 0, width, height);
    if (!session.document) return;
    context.save();
    context.beginPath();
    context.rect(x, y, nx * scale, ny * scale);
    context.clip();
    this.paintField(session, theme);
    if (scale >= 10) this.paintLines(nx, ny, theme);
    this.paintScan(session, look);
    if (look.truth && session.document.source.kind === "simulation") this.paintTruth(session, theme);
    context.restore();
    context.strokeStyle = theme.frame;
    context.lineWidth = 1;
    context.strokeRect(x - 0.5, y - 0.5, nx * scale + 1, ny * scale + 1);
    this.paintCursors(look, ny);
    this.paintSensors(session, look);
    this.paintAxes(session, theme);
  }

  /** @param {Session} session @param {Theme} theme */
  paintField(session, theme) {
    const { context, cells, mask, drawn } = this;
    const field = session.shown;
    const [nx, ny] = session.shape;
    const { scale, x, y } = this.transform;
    if (!cells || !mask || !field || field.p.length !== nx * ny) {
      context.fillStyle = theme.unobserved;
      context.fillRect(x, y, nx * scale, ny * scale);
      return;
    }
    const entropy = session.view.layer === "entropy" && field.layer !== "draw";
    const name = `${theme.ground} ${entropy}`;
    if (drawn.field !== field || drawn.palette !== name) {
      const palette = this.palettes.get(name) ?? paletteOf(theme, entropy);
      this.palettes.set(name, palette);
      if (this.image.width !== nx || this.image.height !== ny) this.image = new ImageData(nx, ny);
      const { image } = this;
      const pixels = new Uint32Array(image.data.buffer);
      for (let row = 0, k = 0; row < ny; row++) {
        for (let i = ny - 1 - row; i < nx * ny; i += ny) pixels[k++] = palette[field.p[i] + (field.observed[i] ? 0 : 256)];
      }
      put(cells.canvas, "width", nx);
      put(cells.canvas, "height", ny);
      cells.putImageData(image, 0, 0);
      if (drawn.bits !== field.bits) {
        for (let row = 0, k = 0; row < ny; row++) {
          for (let i = ny - 1 - row; i < nx * ny; i += ny) pixels[k++] = field.observed[i] ? 0 : 0xff000000;
        }
        put(mask.canvas, "width", nx);
        put(mask.canvas, "height", ny);
        mask.putImageData(image, 0, 0);
        drawn.hatch = "";
      }
      Object.assign(drawn, { field, bits: field.bits, palette: name });
    }
    context.imageSmoothingEnabled = false;
    context.drawImage(cells.canvas, x, y, nx * scale, ny * scale);
    this.paintHatch(theme, nx, ny);
  }

  /** Oblique lines where no beam has been, at the same distance on screen at any zoom. */
  /** @param {Theme} theme @param {number} nx @param {number} ny */
  paintHatch(theme, nx, ny) {
    const { context, hatch, mask, ratio, canvas, drawn } = this;
    if (!hatch || !mask) return;
    const { scale, x, y } = this.transform;
    const key = `${theme.ground} ${scale} ${x} ${y}`;
    if (drawn.hatch !== key) {
      const tile = document.createElement("canvas");
      const size = (tile.width = tile.height = Math.round(7 * ratio));
      const pen = /** @type {CanvasRenderingContext2D} */ (tile.getContext("2d"));
      pen.strokeStyle = theme.hatch;
      pen.lineWidth = ratio;
      pen.beginPath();
      for (const shift of [-size, 0, size]) {
        pen.moveTo(shift - 1, size + 1);
        pen.lineTo(shift + size + 1, -1);
      }
      pen.stroke();
      put(hatch.canvas, "width", canvas.width);
      put(hatch.canvas, "height", canvas.height);
      hatch.setTransform(ratio, 0, 0, ratio, 0, 0);
      hatch.imageSmoothingEnabled = false;
      hatch.globalCompositeOperation = "copy";
      hatch.drawImage(mask.canvas, x, y, nx * scale, ny * scale);
      hatch.globalCompositeOperation = "source-in";
      hatch.setTransform(1, 0, 0, 1, 0, 0);
      const pattern = /** @type {CanvasPattern} */ (hatch.createPattern(tile, "repeat"));
      pattern.setTransform(new DOMMatrix().translate(Math.round(x * ratio), Math.round(y * ratio)));
      hatch.fillStyle = pattern;
      hatch.fillRect(0, 0, canvas.width, canvas.height);
      drawn.hatch = key;
    }
    context.drawImage(hatch.canvas, 0, 0, this.width, this.height);
  }

  /** @param {number} nx @param {number} ny @param {Theme} theme */
  paintLines(nx, ny, theme) {
    const { context } = this;
    const { scale, x, y } = this.transform;
    context.beginPath();
    for (let i = 1; i < nx; i++) {
      context.moveTo(x + i * scale, y);
      context.lineTo(x + i * scale, y + ny * scale);
    }
    for (let j = 1; j < ny; j++) {
      context.moveTo(x, y + j * scale);
      context.lineTo(x + nx * scale, y + j * scale);
    }
    context.strokeStyle = theme.lines;
    context.lineWidth = 1;
    context.stroke();
  }

  /** @param {Session} session @param {Theme} theme */
  paintTruth(session, theme) {
    const { context, drawn, ratio } = this;
    const [nx, ny] = session.shape;
    const { scale, x, y } = this.transform;
    if (drawn.walls !== session.wallsVersion) {
      this.edges = wallEdges(session.walls, nx, ny);
      drawn.walls = session.wallsVersion;
    }
    context.save();
    context.transform(scale, 0, 0, -scale, x, y + ny * scale);
    context.lineCap = "square";
    context.strokeStyle = theme.truth;
    context.lineWidth = clamp(scale * 0.09, 1, 2.5) / scale;
    context.stroke(this.edges);
    context.restore();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  /** @param {Session} session @param {Look} look */
  paintScan(session, { theme, rays, readings }) {
    const { context } = this;
    const { scan, document } = session;
    if (!scan || !document || !(rays || readings)) return;
    const { resolution, origin } = document.grid;
    const { scale } = this.transform;
    const beams = scan.angles.length;
    const sensors = scan.pose.length / 3;
    const hits = new Path2D();
    const misses = new Path2D();
    const dots = new Path2D();
    const radius = clamp(scale * 0.1, 1.3, 4);
    const ny = document.grid.shape[1];
    for (let s = 0; s < sensors; s++) {
      const [px, py, yaw] = scan.pose.subarray(3 * s, 3 * s + 3);
      const from = this.fromGrid({ x: (px - origin[0]) / resolution, y: (py - origin[1]) / resolution }, ny);
      for (let b = 0; b < beams; b++) {
        const range = scan.ranges[s * beams + b];
        // a simulated beam that met nothing reads the longest range, give or take the noise
        const met = scan.exact.length ? scan.exact[s * beams + b] : range;
        const hit = Number.isFinite(range) && met < document.max_range;
        const length = ((hit ? range : document.max_range) / resolution) * scale;
        const angle = scan.angles[b] + yaw;
        const to = { x: from.x + length * Math.cos(angle), y: from.y - length * Math.sin(angle) };
        const path = hit ? hits : misses;
        path.moveTo(from.x, from.y);
        path.lineTo(to.x, to.y);
        if (!hit) continue;
        dots.moveTo(to.x + radius, to.y);
        dots.arc(to.x, to.y, radius, 0, 2 * Math.PI);
      }
    }
    if (rays) {
      context.lineWidth = 1;
      context.globalAlpha = clamp(28 / Math.sqrt(beams * sensors) / 5, 0.07, 0.45);
      context.strokeStyle = theme.ray;
      context.stroke(hits);
      context.strokeStyle = theme.noReturn;
      context.stroke(misses);
      context.globalAlpha = 1;
    }
    if (readings) {
      context.fillStyle = theme.ray;
      context.fill(dots);
    }
  }

  /** Where the sensors stand: the document's, or of a log those of the scan. @param {Session} session @returns {Sensor[]} */
  static sensorsOf(session) {
    const { document, scan } = session;
    if (!document) return [];
    if (document.source.kind === "simulation" || !scan) return document.sensors;
    const ids = Array.from({ length: scan.pose.length / 3 }, (_, s) => s);
    return ids.map((s) => ({ id: s, x: scan.pose[3 * s], y: scan.pose[3 * s + 1], yaw: scan.pose[3 * s + 2] }));
  }

  /** A sensor on the canvas, and the handle that turns it. @param {Sensor} sensor @param {Grid} grid */
  placeOf(sensor, { resolution, origin, shape }) {
    const at = { x: (sensor.x - origin[0]) / resolution, y: (sensor.y - origin[1]) / resolution };
    const point = this.fromGrid(at, shape[1]);
    const size = clamp(this.transform.scale * 0.42, 7, 13);
    const reach = size * 2.6;
    const handle = { x: point.x + reach * Math.cos(sensor.yaw), y: point.y - reach * Math.sin(sensor.yaw) };
    return { point, size, handle };
  }

  /** @param {Session} session @param {Look} look */
  paintSensors(session, { theme, selected }) {
    const { context } = this;
    const document = session.document;
    if (!document) return;
    const sensors = Painter.sensorsOf(session);
    context.lineJoin = "round";
    for (const sensor of sensors) {
      const { point, size, handle } = this.placeOf(sensor, document.grid);
      const [cos, sin] = [Math.cos(sensor.yaw), -Math.sin(sensor.yaw)];
      const to = (/** @type {number} */ a, /** @type {number} */ b) =>
        /** @type {[number, number]} */ ([point.x + size * (a * cos - b * sin), point.y + size * (a * sin + b * cos)]);
      if (sensor.id === selected) {
        context.beginPath();
        context.moveTo(point.x, point.y);
        context.lineTo(handle.x, handle.y);
        context.moveTo(handle.x + 4.5, handle.y);
        context.arc(handle.x, handle.y, 4.5, 0, 2 * Math.PI);
        context.moveTo(point.x + size * 1.7, point.y);
        context.arc(point.x, point.y, size * 1.7, 0, 2 * Math.PI);
        context.strokeStyle = theme.halo;
        context.lineWidth = 4;
        context.stroke();
        context.strokeStyle = theme.sensor;
        context.lineWidth = 1.5;
        context.stroke();
        context.beginPath();
        context.arc(handle.x, handle.y, 4, 0, 2 * Math.PI);
        context.fillStyle = theme.halo;
        context.fill();
      }
      context.beginPath();
      context.moveTo(...to(1.25, 0));
      context.lineTo(...to(-0.9, 0.8));
      context.lineTo(...to(-0.45, 0));
      context.lineTo(...to(-0.9, -0.8));
      context.closePath();
      context.strokeStyle = theme.halo;
      context.lineWidth = 3;
      context.stroke();
      context.fillStyle = theme.sensor;
      context.fill();
      if (sensors.length > 1 && sensors.length < 100) {
        this.write(String(sensor.id), point.x, point.y + size * 2 + 4, theme, "center", true);
      }
    }
  }

  /** @param {Look} look @param {number} ny */
  paintCursors({ theme, hover, cursor }, ny) {
    const { context } = this;
    const { scale } = this.transform;
    for (const [cell, color, width] of /** @type {[Point | null, string, number][]} */ ([
      [hover, theme.axis, 1.5],
      [cursor, theme.ray, 2.5],
    ])) {
      if (!cell) continue;
      const corner = this.fromGrid({ x: cell.x, y: cell.y + 1 }, ny);
      const side = Math.max(scale, 5);
      const out = { x: corner.x - (side - scale) / 2, y: corner.y - (side - scale) / 2 };
      context.lineWidth = width + 2;
      context.strokeStyle = theme.halo;
      context.strokeRect(out.x, out.y, side, side);
      context.lineWidth = width;
      context.strokeStyle = color;
      context.strokeRect(out.x, out.y, side, side);
    }
  }

  /** @param {Session} session @param {Theme} theme */
  paintAxes(session, theme) {
    const { context, width, height } = this;
    if (!session.document) return;
    const { origin, resolution, shape } = session.document.grid;
    const { scale, x, y } = this.transform;
    const step = niceStep((46 / scale) * resolution);
    const bottom = Math.min(y + shape[1] * scale, height - GUTTER.bottom) + 0.5;
    const left = Math.max(x, GUTTER.left) - 0.5;
    // a strip for the numbers where the map runs under them
    context.fillStyle = theme.ground;
    if (x < left) context.fillRect(0, 0, left, height);
    if (y + shape[1] * scale > bottom) context.fillRect(0, bottom, width, height - bottom);
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    context.strokeStyle = theme.frame;
    context.lineWidth = 1;
    context.beginPath();
    const first = (/** @type {0 | 1} */ axis) => Math.ceil(origin[axis] / step - 1e-9) * step;
    const last = (/** @type {0 | 1} */ axis) => origin[axis] + shape[axis] * resolution + 1e-9;
    for (let m = first(0); m <= last(0); m += step) {
      const at = x + ((m - origin[0]) / resolution) * scale;
      if (at < left || at > width - 4) continue;
      context.moveTo(at, bottom);
      context.lineTo(at, bottom + 4);
      this.write(m.toFixed(digits), at, bottom + 12, theme, "center");
    }
    for (let m = first(1); m <= last(1); m += step) {
      const at = y + (shape[1] - (m - origin[1]) / resolution) * scale;
      if (at > bottom || at < 4) continue;
      context.moveTo(left, at);
      context.lineTo(left - 4, at);
      this.write(m.toFixed(digits), left - 7, at, theme, "right");
    }
    context.stroke();
    this.write("m", left - 7, bottom + 12, theme, "right");
  }

  /**
   * @param {string} text @param {number} x @param {number} y @param {Theme} theme
   * @param {CanvasTextAlign} align @param {boolean} [halo]
   */
  write(text, x, y, theme, align, halo = false) {
    const { context } = this;
    context.font = '11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';
    context.textAlign = align;
    context.textBaseline = "middle";
    if (halo) {
      context.strokeStyle = theme.halo;
      context.lineWidth = 3;
      context.strokeText(text, x, y);
    }
    context.fillStyle = theme.axis;
    context.fillText(text, x, y);
  }
}

// ------------------------------------------------------------------------------------------------------- hand

/** Pointer and keyboard on the canvas. */
class Hand {
  /**
   * @param {HTMLCanvasElement} canvas @param {Session} session @param {Painter} painter @param {() => void} changed
   * @param {boolean} embedded in a notebook the wheel belongs to the page until the map has the focus
   */
  constructor(canvas, session, painter, changed, embedded) {
    this.canvas = canvas;
    this.session = session;
    this.painter = painter;
    this.changed = changed;
    this.embedded = embedded;
    /** @type {Tool} */
    this.tool = "draw";
    /** @type {number | null} */
    this.selected = null;
    /** @type {Point | null} */
    this.hover = null;
    /** @type {Point | null} */
    this.cursor = null;
    /** @type {Map<number, Point>} fingers on the canvas */
    this.fingers = new Map();
    /** @type {{kind: "stroke", id: number, wall: boolean, last: Point, held: PointerEvent | null}
     *   | {kind: "sensor", id: number, drag: number, grip: Point} | {kind: "turn", id: number, drag: number}
     *   | {kind: "pan", last: Point} | {kind: "pinch", middle: Point, spread: number} | null} */
    this.gesture = null;
    this.gestures = Math.floor(Math.random() * 2 ** 30); // a number that undo has not seen on this connection
    this.asked = 0;
    /** @type {(text: string) => void} */
    this.announce = () => {};
    for (const [type, listener] of /** @type {[string, (event: any) => void][]} */ ([
      ["pointerdown", (event) => this.down(event)],
      ["pointermove", (event) => this.move(event)],
      ["pointerup", (event) => this.up(event)],
      ["pointercancel", (event) => this.up(event)],
      ["pointerleave", () => this.point(null)],
      ["wheel", (event) => this.wheel(event)],
      ["keydown", (event) => this.key(event)],
      ["contextmenu", (event) => event.preventDefault()],
      ["blur", () => this.setCursor(null)],
    ])) {
      canvas.addEventListener(type, listener, { passive: false });
    }
  }

  /** @param {{clientX: number, clientY: number}} event @returns {Point} */
  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  /** The cell under a point of the canvas; it may lie outside the grid. @param {Point} point @returns {Point} */
  cellAt(point) {
    const grid = this.painter.toGrid(point, this.session.shape[1]);
    return { x: Math.floor(grid.x), y: Math.floor(grid.y) };
  }

  /** @param {Point} cell */
  inside({ x, y }) {
    const [nx, ny] = this.session.shape;
    return x >= 0 && y >= 0 && x < nx && y < ny;
  }

  /** Metres of a point of the canvas. @param {Point} point @returns {Point} */
  metres(point) {
    const { resolution, origin, shape } = /** @type {MapDocument} */ (this.session.document).grid;
    const grid = this.painter.toGrid(point, shape[1]);
    return { x: origin[0] + grid.x * resolution, y: origin[1] + grid.y * resolution };
  }

  /** The cell of a point in metres. @param {Point} world @returns {Point} */
  cellOf(world) {
    const { resolution, origin } = /** @type {MapDocument} */ (this.session.document).grid;
    return { x: Math.floor((world.x - origin[0]) / resolution), y: Math.floor((world.y - origin[1]) / resolution) };
  }

  /** The centre of a cell in metres. @param {Point} cell @returns {Point} */
  centreOf(cell) {
    const { resolution, origin } = /** @type {MapDocument} */ (this.session.document).grid;
    return { x: origin[0] + (cell.x + 0.5) * resolution, y: origin[1] + (cell.y + 0.5) * resolution };
  }

  get sensor() {
    const sensors = this.session.document?.sensors ?? [];
    return sensors.find((sensor) => sensor.id === this.selected) ?? sensors[0] ?? null;
  }

  /** @param {Tool} tool */
  choose(tool) {
    this.tool = tool;
    this.changed();
  }

  /** @param {PointerEvent} event */
  down(event) {
    const { session, painter } = this;
    if (!session.document) return;
    event.preventDefault();
    this.canvas.focus({ preventScroll: true });
    this.setCursor(null);
    this.canvas.setPointerCapture(event.pointerId);
    const point = this.at(event);
    this.fingers.set(event.pointerId, point);
    if (this.fingers.size === 2) {
      this.gesture = { kind: "pinch", ...this.spread() };
      return;
    }
    if (this.gesture) return;
    if (event.button === 1 || this.tool === "pan" || !session.editable) {
      this.gesture = { kind: "pan", last: point };
      return;
    }
    const { grid } = session.document;
    const reach = event.pointerType === "touch" ? 24 : 11;
    const near = (/** @type {Point} */ other) => Math.hypot(point.x - other.x, point.y - other.y);
    const own = this.tool === "sensor" && this.sensor && painter.placeOf(this.sensor, grid);
    if (own && this.sensor && near(own.handle) < Math.min(reach, near(own.point))) {
      this.gesture = { kind: "turn", id: this.sensor.id, drag: ++this.gestures };
      return;
    }
    const places = session.document.sensors.map((sensor) => ({ sensor, ...painter.placeOf(sensor, grid) }));
    const grip = places.sort((a, b) => near(a.point) - near(b.point)).find((place) => near(place.point) < Math.max(reach, place.size));
    if (grip && event.button === 0 && this.tool !== "erase") {
      this.selected = grip.sensor.id;
      const shift = { x: grip.point.x - point.x, y: grip.point.y - point.y };
      this.gesture = { kind: "sensor", id: grip.sensor.id, drag: ++this.gestures, grip: shift };
      this.changed();
    } else if (this.tool === "sensor") {
      if (event.shiftKey) this.addSensor(this.metres(point));
      else if (this.sensor) {
        this.selected = this.sensor.id;
        this.gesture = { kind: "sensor", id: this.sensor.id, drag: ++this.gestures, grip: { x: 0, y: 0 } };
        this.dragSensor(event);
      }
    } else {
      const wall = (this.tool === "draw") !== (event.button === 2 || event.shiftKey);
      this.gesture = { kind: "stroke", id: ++this.gestures, wall, last: this.cellAt(point), held: event };
      // a second finger may follow at once, and then this one was no stroke
      if (event.pointerType !== "touch") this.release();
      else setTimeout(() => this.release(), 90);
    }
  }

  /** Draws the first cell of a stroke. */
  release() {
    if (this.gesture?.kind !== "stroke" || !this.gesture.held) return;
    const event = this.gesture.held;
    this.gesture.held = null;
    this.stroke([this.gesture.last], event);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { gesture, session, painter } = this;
    const point = this.at(event);
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, point);
    if (!gesture) {
      this.point(this.cellAt(point));
    } else if (gesture.kind === "stroke") {
      this.release();
      const path = [];
      const events = event.getCoalescedEvents?.() ?? [];
      for (const each of events.length ? events : [event]) {
        const cell = this.cellAt(this.at(each));
        path.push(...lineOfCells(gesture.last, cell));
        gesture.last = cell;
      }
      this.stroke(path, event);
      this.point(gesture.last);
    } else if (gesture.kind === "sensor") {
      this.dragSensor(event);
    } else if (gesture.kind === "turn") {
      const sensor = session.document?.sensors.find((candidate) => candidate.id === gesture.id);
      if (!sensor) return;
      const world = this.metres(point);
      this.moveSensor(sensor, { yaw: Math.atan2(world.y - sensor.y, world.x - sensor.x) }, gesture.drag, event);
    } else if (gesture.kind === "pan") {
      painter.pan(point.x - gesture.last.x, point.y - gesture.last.y, session.shape);
      gesture.last = point;
      this.changed();
    } else if (this.fingers.size === 2) {
      const { middle, spread } = this.spread();
      painter.pan(middle.x - gesture.middle.x, middle.y - gesture.middle.y, session.shape);
      painter.zoom(spread / gesture.spread, middle, session.shape);
      Object.assign(gesture, { middle, spread });
      this.changed();
    }
  }

  /** @param {PointerEvent} event */
  up(event) {
    if (event.type === "pointerup") this.release();
    this.fingers.delete(event.pointerId);
    if (this.fingers.size === 0) this.gesture = null;
    if (event.pointerType === "touch") this.point(this.cellAt(this.at(event))); // a finger cannot hover: its last cell stays
  }

  spread() {
    const [a, b] = [...this.fingers.values()];
    return { middle: { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }, spread: Math.max(10, Math.hypot(a.x - b.x, a.y - b.y)) };
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    if (!this.session.document) return;
    const focused = /** @type {ShadowRoot} */ (this.canvas.getRootNode()).activeElement === this.canvas;
    if (this.embedded && !event.ctrlKey && !focused) return;
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 16 : 1;
    if (event.shiftKey) this.painter.pan(-unit * (event.deltaX || event.deltaY), 0, this.session.shape);
    else this.painter.zoom(Math.exp(-unit * event.deltaY * (event.ctrlKey ? 0.01 : 0.0016)), this.at(event), this.session.shape);
    this.changed();
  }

  /** The read-out follows the pointer; the beams through the cell are asked for once it rests. @param {Point | null} cell */
  point(cell) {
    const inside = cell && this.inside(cell) ? cell : null;
    if (inside?.x === this.hover?.x && inside?.y === this.hover?.y) return;
    this.hover = inside;
    this.ask(inside);
    this.changed();
  }

  /** @param {Point | null} cell */
  setCursor(cell) {
    if (!cell && !this.cursor) return;
    this.cursor = cell;
    this.ask(cell);
    this.changed();
  }

  /** @param {Point | null} cell */
  ask(cell) {
    clearTimeout(this.asked);
    if (!cell || this.gesture) return;
    this.asked = window.setTimeout(() => {
      this.session.act({ type: "inspect", x: cell.x, y: cell.y });
      if (this.cursor) this.announce(describeCell(this.session, cell));
    }, 120);
  }

  /** @param {Point[]} path @param {Event} event */
  stroke(path, event) {
    const { session, gesture } = this;
    if (gesture?.kind !== "stroke") return;
    this.setWalls(path, gesture.wall, gesture.id, event);
    if (session.status.level === "error") session.say("Ready");
  }

  /**
   * Sends those cells of a path that change.
   * @param {Point[]} path @param {boolean} wall @param {number} stroke @param {Event} event
   */
  setWalls(path, wall, stroke, event) {
    const { session } = this;
    const ny = session.shape[1];
    const taken = wall ? (session.document?.sensors ?? []).map((sensor) => this.cellOf(sensor)) : [];
    /** @type {Map<number, [number, number]>} */
    const cells = new Map();
    for (const cell of path) {
      if (!this.inside(cell) || session.walls[cell.x * ny + cell.y] === Number(wall)) continue;
      if (taken.some((other) => other.x === cell.x && other.y === cell.y)) continue;
      cells.set(cell.x * ny + cell.y, [cell.x, cell.y]);
    }
    if (cells.size) session.act({ type: "walls", cells: [...cells.values()], wall, stroke }, event);
  }

  /** @param {PointerEvent} event */
  dragSensor(event) {
    const { gesture, session } = this;
    if (gesture?.kind !== "sensor") return;
    this.point(null);
    const sensor = session.document?.sensors.find((candidate) => candidate.id === gesture.id);
    const point = this.at(event);
    if (!sensor) return;
    this.moveSensor(sensor, this.metres({ x: point.x + gesture.grip.x, y: point.y + gesture.grip.y }), gesture.drag, event);
  }

  /**
   * @param {Sensor} sensor @param {{x?: number, y?: number, yaw?: number}} place
   * @param {number | undefined} drag @param {Event} [event]
   */
  moveSensor(sensor, place, drag, event) {
    const { x, y, yaw } = { ...sensor, ...place };
    if (this.refuses({ x, y })) return;
    this.session.act({ type: "sensor", op: "move", id: sensor.id, x, y, yaw, drag }, event);
  }

  /** Says so where a sensor cannot stand. @param {Point} world */
  refuses(world) {
    const cell = this.cellOf(world);
    const { session } = this;
    const wall = this.inside(cell) && session.walls[cell.x * session.shape[1] + cell.y];
    if (!wall && this.inside(cell)) {
      if (session.status.text.startsWith("A sensor cannot")) session.say("Ready");
      return false;
    }
    session.say(wall ? "A sensor cannot stand in a wall." : "A sensor cannot stand outside the map.", "warning");
    return true;
  }

  /** @param {Point} [world] where; else the free cell nearest to the middle of the view */
  addSensor(world) {
    const { session, painter } = this;
    if (!session.document) return;
    const [nx, ny] = session.shape;
    const place = world ?? this.nearestFree(this.cursor ?? this.cellAt({ x: painter.width / 2, y: painter.height / 2 }), nx, ny);
    if (!place) session.say("There is no free cell for a sensor.", "warning");
    else if (session.document.sensors.length >= LIMITS.sensors) session.say(`There can be ${LIMITS.sensors} sensors at most.`, "warning");
    else if (!this.refuses(place)) {
      session.act({ type: "sensor", op: "add", x: place.x, y: place.y, yaw: 0 });
      this.selected = Math.max(0, ...session.document.sensors.map((sensor) => sensor.id)) + 1;
    }
  }

  /** @param {Point} to @param {number} nx @param {number} ny @returns {Point | null} */
  nearestFree(to, nx, ny) {
    const { session } = this;
    const taken = new Set((session.document?.sensors ?? []).map((sensor) => this.cellOf(sensor)).map(({ x, y }) => x * ny + y));
    let best = null;
    let least = Infinity;
    for (let i = 0; i < nx * ny; i++) {
      const away = (Math.floor(i / ny) - to.x) ** 2 + ((i % ny) - to.y) ** 2;
      if (away < least && !session.walls[i] && !taken.has(i)) [best, least] = [i, away];
    }
    return best === null ? null : this.centreOf({ x: Math.floor(best / ny), y: best % ny });
  }

  removeSensor() {
    if (this.sensor) this.session.act({ type: "sensor", op: "remove", id: this.sensor.id });
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const { session } = this;
    if (!session.document || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (step) this.arrow(step[0] * (event.shiftKey ? 5 : 1), step[1] * (event.shiftKey ? 5 : 1));
    else if (event.key === " ") this.space(event);
    else if (event.key === "[" || event.key === "]") {
      if (session.editable && this.sensor) {
        this.moveSensor(this.sensor, { yaw: this.sensor.yaw + ((event.key === "[" ? 15 : -15) * Math.PI) / 180 }, undefined, event);
      }
    } else if (event.key.toLowerCase() === "a" && session.editable) this.addSensor();
    else if ((event.key === "Delete" || event.key === "Backspace") && session.editable) this.removeSensor();
    else if (event.key === "Escape") this.setCursor(null);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {number} dx @param {number} dy */
  arrow(dx, dy) {
    const { session, painter } = this;
    const [nx, ny] = session.shape;
    if (this.tool === "sensor" && this.sensor && session.editable) {
      const { resolution } = /** @type {MapDocument} */ (session.document).grid;
      this.selected = this.sensor.id;
      this.moveSensor(this.sensor, { x: this.sensor.x + dx * resolution, y: this.sensor.y + dy * resolution }, undefined);
    } else if (this.tool === "pan" && session.editable) {
      painter.pan(-40 * dx, 40 * dy, session.shape);
      this.changed();
    } else {
      const from = this.cursor ?? { x: Math.floor(nx / 2), y: Math.floor(ny / 2) };
      this.setCursor({ x: clamp(from.x + dx, 0, nx - 1), y: clamp(from.y + dy, 0, ny - 1) });
      const at = painter.fromGrid({ x: (this.cursor?.x ?? 0) + 0.5, y: (this.cursor?.y ?? 0) + 0.5 }, ny);
      const off = (/** @type {number} */ v, /** @type {number} */ low, /** @type {number} */ high) => v - clamp(v, low, high);
      const out = { x: off(at.x, GUTTER.left + 10, painter.width - 20), y: off(at.y, 20, painter.height - GUTTER.bottom - 10) };
      if (out.x || out.y) painter.pan(-out.x, -out.y, session.shape);
    }
  }

  /** @param {Event} event */
  space(event) {
    const { session } = this;
    const sensors = session.document?.sensors ?? [];
    if (!session.editable) return;
    if (this.tool === "sensor") {
      const i = sensors.findIndex((sensor) => sensor.id === this.sensor?.id);
      this.selected = sensors[(i + 1) % Math.max(1, sensors.length)]?.id ?? null;
      if (this.selected !== null) this.announce(`Sensor ${this.selected}`);
      this.changed();
    } else if (this.tool !== "pan") {
      if (!this.cursor) this.arrow(0, 0);
      const cell = /** @type {Point} */ (this.cursor);
      const wall = this.tool === "draw" && !session.walls[cell.x * session.shape[1] + cell.y];
      this.setWalls([cell], wall, ++this.gestures, event);
      this.announce(wall ? "wall" : "free");
    }
  }
}

/** What the read-out says of a cell. @param {Session} session @param {Point} cell */
function describeCell(session, cell) {
  const { document, shown } = session;
  if (!document) return "";
  const { resolution, origin, shape } = document.grid;
  const i = cell.x * shape[1] + cell.y;
  const digits = Math.max(1, Math.ceil(-Math.log10(resolution)) + 1);
  const metres = [origin[0] + (cell.x + 0.5) * resolution, origin[1] + (cell.y + 0.5) * resolution];
  const parts = [`Cell ${cell.x}, ${cell.y}`, `${metres[0].toFixed(digits)}, ${metres[1].toFixed(digits)} m`];
  if (shown && shown.p.length === shape[0] * shape[1]) {
    const p = shown.p[i] / 255;
    if (shown.layer === "draw") parts.push(p > 0.5 ? "wall in this draw" : "free in this draw");
    else parts.push(`P(wall) ${p.toFixed(2)}`, `entropy ${entropyBits(p).toFixed(2)} bit`);
    const beams = session.cell && session.cell.x === cell.x && session.cell.y === cell.y ? session.cell.beams : null;
    if (!shown.observed[i]) parts.push("unobserved");
    else if (beams !== null) parts.push(beams === 1 ? "1 beam" : `${beams} beams`);
  }
  return parts.join(" \u00b7 ");
}

// --------------------------------------------------------------------------------------------------- controls

const ICONS = {
  draw: "M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",
  erase: "M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",
  sensor: "M12 3l7 17-7-4-7 4z",
  pan: "M12 3v18M3 12h18M9.5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",
  undo: "M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",
  redo: "M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  play: "M7 4.5l12 7.5-12 7.5z",
  pause: "M8.5 5v14M15.5 5v14",
  link: "M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",
  save: "M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",
  grid: "M4 4h16v16H4zM4 12h16M12 4v16",
  theme: "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",
  help: "M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",
  close: "M6 6l12 12M18 6L6 18",
};

/** @param {keyof typeof ICONS} name */
function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}

/**
 * An element; properties by name, attributes where the name has a hyphen, listeners where it begins with "on".
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag @param {{[name: string]: any}} [properties] @param {(Node | string | null)[]} children
 * @returns {HTMLElementTagNameMap[K]}
 */
function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, value);
    else /** @type {any} */ (element)[name] = value;
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

/** Sets a property where it differs, so that nothing is announced or laid out twice. */
/** @param {any} target @param {string} name @param {unknown} value */
function put(target, name, value) {
  if (target[name] !== value) target[name] = value;
}

/** @param {number | null | undefined} value @param {number} digits @param {string} [unit] */
const number = (value, digits, unit = "") => (value == null || !Number.isFinite(value) ? "\u2013" : value.toFixed(digits) + unit);

const METHODS = {
  gibbs: "Gibbs, cell by cell",
  block: "Gibbs, 2 \u00d7 2 blocks",
  propagate: "Belief propagation",
  importance: "Importance sampling",
};
const ORDERS = { raster: "raster", radial: "radial", random: "random" };
const KEYS = [
  ["D, E, S, P", "draw, erase, sensor, pan"],
  ["arrows", "move the cursor, the sensor or the view; with Shift by five cells"],
  ["Space", "draw or erase at the cursor; next sensor"],
  ["[ and ]", "turn the sensor"],
  ["A, Delete", "add, remove a sensor"],
  ["R, Escape", "run, cancel"],
  ["M, N, H", "show the mean, a draw, the entropy"],
  ["Ctrl+Z, Ctrl+Y", "undo, redo"],
  ["+, \u2212, 0", "zoom in, out, whole map"],
  ["?", "this help"],
];

let names = 0; // several widgets may stand in one notebook

/** Everything in the DOM but the map itself. */
class Controls {
  /** @param {Session} session @param {Painter} painter @param {Hand} hand @param {(what: string) => void} command */
  constructor(session, painter, hand, command) {
    this.session = session;
    this.painter = painter;
    this.hand = hand;
    this.command = command;
    this.prefix = `bayesmap${names++}`;
    this.show = { truth: true, rays: true, readings: true };
    this.playing = false;
    /** @type {HTMLButtonElement | undefined} */
    this.themeButton = undefined;
    /** @type {HTMLElement | undefined} */
    this.ramp = undefined;
    /** @type {HTMLInputElement | undefined} */
    this.shareLink = undefined;
    /** @type {(() => void)[]} what `refresh` runs */
    this.updates = [];
    this.drag = Math.floor(Math.random() * 2 ** 30);
    this.head = this.buildHead();
    this.bar = this.buildBar();
    this.chip = this.buildChip();
    this.banner = this.buildBanner();
    this.legend = this.buildLegend();
    this.readout = h("div", { className: "readout", id: `${this.prefix}-readout` });
    this.each(() => {
      const cell = this.hand.cursor ?? this.hand.hover;
      const keys = session.editable && !matchMedia("(pointer: coarse)").matches;
      const idle = keys ? "Point at a cell, or press ? for the keys" : "Point at a cell";
      put(this.readout, "textContent", cell ? describeCell(session, cell) : idle);
    });
    this.status = h("span", { role: "status", "aria-live": "polite" });
    this.live = h("span", { className: "hidden", "aria-live": "polite" });
    this.hand.announce = (text) => put(this.live, "textContent", text);
    this.foot = h("footer", {}, this.status, this.readout, this.live);
    this.each(() => {
      put(this.status, "textContent", session.status.text);
      put(this.status, "className", session.status.level);
    });
    this.help = this.buildHelp();
    this.create = this.buildNew();
    this.share = this.buildShare();
    const edits = [this.sensorSection(), this.modelSection(), this.inferenceSection(), this.mapSection()];
    this.panel = h("aside", { "aria-label": "Controls" }, this.posteriorSection(), this.viewSection(), this.scanSection(), ...edits);
    this.each(() => {
      const [sensor, model, inference, map] = edits;
      put(sensor, "hidden", !session.editable);
      const kind = session.recorded ? "run" : session.document?.source.kind;
      put(model, "hidden", kind === "run");
      put(inference, "hidden", kind === "run");
      put(map, "hidden", session.recorded);
      put(this.bar, "inert", !session.document);
      put(this.panel, "inert", !session.document);
    });
  }

  /** @param {() => void} update */
  each(update) {
    this.updates.push(update);
  }

  refresh() {
    for (const update of this.updates) update();
  }

  /**
   * @param {keyof typeof ICONS | null} image @param {string} label @param {() => void} action
   * @param {{className?: string, text?: string, when?: () => boolean, title?: string}} [options]
   */
  button(image, label, action, { className = "", text = "", when, title } = {}) {
    const element = h("button", { type: "button", className, title: title ?? label, onclick: action }, image && icon(image));
    if (text) element.append(h("span", { textContent: text }));
    if (text !== label) element.setAttribute("aria-label", label);
    if (when) this.each(() => put(element, "disabled", !when()));
    return element;
  }

  /**
   * Radio buttons that look like one.
   * @param {string} label @param {[string, string, (keyof typeof ICONS)?][]} options
   * @param {() => string} current @param {(value: string) => void} choose @param {(value: string) => boolean} [when]
   */
  segmented(label, options, current, choose, when) {
    const name = `${this.prefix}-${label.replace(/\W/g, "")}`;
    const group = h("div", { className: "segmented", role: "radiogroup", "aria-label": label });
    for (const [value, text, image] of options) {
      const input = h("input", { type: "radio", name, value, onchange: () => choose(value) });
      group.append(h("label", { title: text }, input, image ? icon(image) : null, h("span", { textContent: text })));
      this.each(() => {
        put(input, "checked", current() === value);
        if (when) put(input, "disabled", !when(value));
      });
    }
    return group;
  }

  /** @param {string} title @param {(Node | null)[]} children */
  section(title, ...children) {
    const id = `${this.prefix}-${title}`;
    return h("section", { "aria-labelledby": id }, h("h2", { id, textContent: title }), ...children);
  }

  /** @param {{[name: string]: any}} patch */
  set(patch) {
    this.session.act({ type: "set", patch, drag: this.drag });
  }

  /**
   * A slider with a number beside it.
   * @param {"prior" | "noise" | "angles" | "sweeps"} key @param {() => string} label
   * @param {{low: number, high: number, step: number, log?: boolean, unit?: string}} range
   */
  slider(key, label, { low, high, step, log = false, unit = "" }) {
    const id = `${this.prefix}-${key}`;
    const toPosition = (/** @type {number} */ v) => (log ? (1000 * Math.log(v / low)) / Math.log(high / low) : v);
    const toValue = (/** @type {number} */ t) => {
      if (!log) return t;
      const value = low * (high / low) ** (t / 1000);
      const round = value < 100 ? 1 : 10 ** (Math.floor(Math.log10(value)) - 1);
      return clamp(Math.round(value / round) * round, low, high);
    };
    const text = h("label", { for: id });
    const range = h("input", { type: "range", id, ...(log ? { min: 0, max: 1000, step: 1 } : { min: low, max: high, step }) });
    const exact = h("input", { type: "number", min: String(low), max: String(high), step: String(step) });
    range.addEventListener("input", () => this.set({ [key]: toValue(Number(range.value)) }));
    range.addEventListener("change", () => this.drag++);
    exact.addEventListener("change", () => {
      const value = Number(exact.value);
      if (exact.value === "" || !Number.isFinite(value)) exact.value = String(this.session.document?.[key]);
      else this.set({ [key]: log ? Math.round(clamp(value, low, high)) : clamp(value, low, high) });
      this.drag++;
    });
    this.each(() => {
      const value = this.session.document?.[key] ?? low;
      put(text, "textContent", label());
      if (exact.getAttribute("aria-label") !== `${label()}, number`) exact.setAttribute("aria-label", `${label()}, number`);
      if (toValue(Number(range.value)) !== value) range.value = String(toPosition(value));
      range.setAttribute("aria-valuetext", `${value}${unit}`);
      const fill = (100 * (toPosition(value) - Number(range.min))) / (Number(range.max) - Number(range.min));
      range.style.setProperty("--fill", `${clamp(fill, 0, 100)}%`);
      if (/** @type {ShadowRoot} */ (exact.getRootNode()).activeElement !== exact) put(exact, "value", String(value));
    });
    return h("div", { className: "row slider" }, text, range, exact);
  }

  /** @param {string} label @param {HTMLElement} control */
  row(label, control) {
    control.id = `${this.prefix}-${label.replace(/\W/g, "")}`;
    return h("div", { className: "row" }, h("label", { for: control.id, textContent: label }), control);
  }

  /**
   * @param {string} label @param {{[value: string]: string}} options @param {() => string} current
   * @param {(value: string) => void} choose @param {() => boolean} [when]
   */
  select(label, options, current, choose, when) {
    const element = h("select", { onchange: () => choose(element.value) });
    for (const [value, text] of Object.entries(options)) element.append(h("option", { value, textContent: text }));
    this.each(() => {
      put(element, "value", current());
      if (when) put(element, "disabled", !when());
    });
    return this.row(label, element);
  }

  /**
   * @param {string} label @param {() => number} current @param {(value: number) => void} choose
   * @param {{[name: string]: any}} [properties]
   */
  numberInput(label, current, choose, properties = {}) {
    const element = h("input", { type: "number", ...properties });
    element.addEventListener("change", () => {
      if (element.value !== "" && Number.isFinite(Number(element.value))) choose(Number(element.value));
    });
    this.each(() => {
      if (/** @type {ShadowRoot} */ (element.getRootNode()).activeElement !== element) put(element, "value", String(current()));
    });
    return this.row(label, element);
  }

  /** @param {string} label @param {() => boolean} current @param {(on: boolean) => void} choose @param {string} [title] */
  checkbox(label, current, choose, title = "") {
    const input = h("input", { type: "checkbox", onchange: () => choose(input.checked) });
    this.each(() => put(input, "checked", current()));
    return h("label", { className: "check", title }, input, h("span", { textContent: label }));
  }

  buildHead() {
    const { session } = this;
    const what = h("span", { className: "what" });
    this.each(() => {
      const { grid, source } = session.document ?? {};
      if (!grid || !source) return;
      const size = `${grid.shape[0]} \u00d7 ${grid.shape[1]} cells of ${+grid.resolution.toPrecision(3)} m`;
      put(what, "textContent", source.name ? `${source.name}, ${size}` : size);
    });
    const live = () => !session.recorded && Boolean(session.document);
    const item = (/** @type {string} */ label, /** @type {string} */ value, /** @type {boolean} */ server) => {
      const element = this.button(null, label, () => this.command(`export ${value}`), { text: label });
      if (server) this.each(() => put(element, "hidden", session.recorded));
      return element;
    };
    const menu = h(
      "div",
      { className: "menu", hidden: true },
      item("Picture (PNG)", "png", false),
      item("Saved run (netCDF)", "run", true),
      item("Map for robots (YAML and PGM)", "map", true),
      item("Page with its draws (HTML)", "html", true),
      item("Document (JSON)", "document", true),
    );
    const toggle = this.button("save", "Export", () => open(menu.hidden), { text: "Export", when: () => Boolean(session.document) });
    const open = (/** @type {boolean} */ on) => {
      menu.hidden = !on;
      toggle.setAttribute("aria-expanded", String(on));
      if (on) /** @type {HTMLElement} */ (menu.firstElementChild).focus();
    };
    open(false);
    const anchor = h("div", { className: "anchor" }, toggle, menu);
    anchor.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && !menu.hidden) {
        open(false);
        toggle.focus();
        event.stopPropagation();
      }
    });
    anchor.addEventListener("focusout", (event) => {
      if (!anchor.contains(/** @type {Node | null} */ (event.relatedTarget))) open(false);
    });
    menu.addEventListener("click", () => {
      open(false);
      toggle.focus();
    });
    const theme = this.button("theme", "Theme: automatic", () => this.command("theme"));
    this.themeButton = theme;
    const only = [
      this.button("undo", "Undo", () => session.act({ type: "undo" }), { title: "Undo (Ctrl+Z)", when: () => Boolean(session.state?.can_undo) }),
      this.button("redo", "Redo", () => session.act({ type: "redo" }), { title: "Redo (Ctrl+Y)", when: () => Boolean(session.state?.can_redo) }),
      h("span", { className: "gap" }),
      this.button("grid", "New map", () => this.command("new"), { text: "New map", when: live }),
      // a notebook's address holds no map, and may hold the notebook's token
      ...(this.hand.embedded ? [] : [this.button("link", "Share", () => this.command("share"), { text: "Share", when: live })]),
    ];
    for (const element of only) this.each(() => put(element, "hidden", session.recorded));
    const help = this.button("help", "Help", () => this.command("help"), { title: "Help (?)" });
    return h("header", {}, h("h1", { textContent: "bayesmap" }), what, h("span", { className: "space" }), ...only, anchor, theme, help);
  }

  buildBar() {
    const { hand, session } = this;
    const tools = this.segmented(
      "Tool",
      [
        ["draw", "Draw", "draw"],
        ["erase", "Erase", "erase"],
        ["sensor", "Sensor", "sensor"],
        ["pan", "Pan", "pan"],
      ],
      () => (session.editable || !session.document ? hand.tool : "pan"),
      (value) => hand.choose(/** @type {Tool} */ (value)),
      (value) => session.editable || value === "pan",
    );
    this.each(() => put(tools, "hidden", Boolean(session.document) && !session.editable));
    return h(
      "div",
      { className: "bar" },
      tools,
      h("span", { className: "space" }),
      this.button("minus", "Zoom out", () => this.command("out"), { title: "Zoom out (\u2212)" }),
      this.button("plus", "Zoom in", () => this.command("in"), { title: "Zoom in (+)" }),
      this.button("fit", "Whole map", () => this.command("fit"), { title: "Whole map (0)" }),
    );
  }

  /** Says on the map itself what is shown, and that the quick answer is approximate. */
  buildChip() {
    const { session } = this;
    const chip = h("div", { className: "chip" });
    this.each(() => {
      const field = session.shown;
      if (!field || !session.document) return put(chip, "hidden", true);
      const numbered = session.draws.count ? `draw ${session.draw + 1} of ${session.draws.count}` : "draw";
      const kind = field.layer === "draw" ? numbered : session.view.layer === "entropy" ? "entropy" : "mean";
      const by = field.approximate
        ? "approximate, belief propagation"
        : { importance: "importance sampling", propagate: "belief propagation" }[field.method] ?? `${field.sweeps} sweeps`;
      put(chip, "hidden", false);
      put(chip, "textContent", `${kind} \u00b7 ${by}`);
      put(chip, "className", field.approximate ? "chip approximate" : "chip");
    });
    return chip;
  }

  buildBanner() {
    const { session } = this;
    const text = h("span");
    const retry = this.button(null, "Reconnect now", () => session.transport.retry?.(), { text: "Reconnect now" });
    const banner = h("div", { className: "banner", role: "alert", hidden: true }, text, retry);
    this.each(() => {
      const lost = session.everConnected && !session.connection.connected;
      const seconds = Math.max(1, Math.round((session.connection.retryIn_ms ?? 0) / 1000));
      put(banner, "hidden", !lost && session.worker !== "restarted");
      put(banner, "className", lost ? "banner" : "banner mild");
      put(retry, "hidden", !lost);
      const wait = `Connection lost. Trying again in ${seconds} s; the map is kept here.`;
      put(text, "textContent", lost ? wait : "The worker stopped and is being started again. The map is kept.");
    });
    return banner;
  }

  buildLegend() {
    const { session } = this;
    const ramp = h("span", { className: "ramp" });
    const name = h("span");
    const entries = [
      ["truth", "true wall"],
      ["ray", "ray"],
      ["miss", "no return"],
      ["dot", "reading"],
      ["sensor", "sensor"],
      ["unobserved", "unobserved"],
    ].map(([className, text]) => {
      const mark = h("i", { className });
      if (className === "sensor") mark.append(icon("sensor"));
      return h("li", {}, mark, text);
    });
    this.each(() => put(entries[0], "hidden", Boolean(session.document) && session.document?.source.kind !== "simulation"));
    this.each(() => put(name, "textContent", session.view.layer === "entropy" ? "entropy (bit)" : "P(wall)"));
    this.ramp = ramp;
    return h("ul", { className: "legend", "aria-label": "Legend" }, h("li", {}, name, "0", ramp, "1"), ...entries);
  }

  posteriorSection() {
    const { session } = this;
    const progress = h("progress", { max: 1, value: 0, "aria-label": "Progress" });
    const doing = h("div", { className: "doing" });
    this.each(() => {
      const field = session.shown;
      const share = field && field.total > 0 && !field.approximate ? field.sweeps / field.total : 0;
      put(progress, "value", share);
      const left = session.remaining_s();
      const unit = { importance: "particles", propagate: "rounds" }[field?.method ?? ""] ?? "sweeps";
      const count = field && !field.approximate && field.total ? `${field.sweeps} of ${field.total} ${unit}` : "";
      const state = left !== null ? (left < 1 ? "less than 1 s left" : `${Math.ceil(left)} s left`) : session.running ? "running" : "";
      put(doing, "textContent", sentence([count, state].filter(Boolean).join(", ")) || "No chain yet");
    });
    const run = this.button("play", "Run", () => session.act({ type: "run" }), { className: "primary", text: "Run", title: "Run (R)" });
    const cancel = this.button("close", "Cancel", () => session.act({ type: "cancel" }), { text: "Cancel", title: "Cancel (Escape)", when: () => session.running || session.sampling });
    const live = this.checkbox(
      "Live",
      () => Boolean(session.state?.live ?? true),
      (on) => session.act({ type: "live", on }),
      "Every edit restarts the chain",
    );
    const buttons = h("div", { className: "buttons" }, run, cancel, live);
    this.each(() => put(buttons, "hidden", session.recorded || session.document?.source.kind === "run"));
    const values = h("dl");
    for (const [label, title, read] of /** @type {[string, string, (field: Field) => string][]} */ ([
      ["ESS", "Effective sample size of the log joint", (field) => number(field.ess, 0)],
      ["R-hat", "Agreement of the chains on the log joint; 1 is full", (field) => number(field.rhat, 3)],
      ["log joint", "Log of prior times likelihood at the last sweep", (field) => number(field.log_joint, 1)],
      ["reply", "From the hand's last move to its picture", () => number(session.events.eventToPaint_ms.at(-1), 0, " ms")],
    ])) {
      const value = h("dd", { textContent: "\u2013" });
      values.append(h("div", { title }, h("dt", { textContent: label }), value));
      this.each(() => put(value, "textContent", session.shown ? read(session.shown) : "\u2013"));
    }
    return this.section("Posterior", buttons, progress, doing, values, this.sparkline());
  }

  /** The log joint by sweep. */
  sparkline() {
    const { session } = this;
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    const line = document.createElementNS("http://www.w3.org/2000/svg", "polyline");
    svg.setAttribute("viewBox", "0 0 100 30");
    svg.setAttribute("preserveAspectRatio", "none");
    svg.setAttribute("class", "trace");
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", "Log joint by sweep");
    svg.append(line);
    let drawn = -1;
    this.each(() => {
      const { joint } = session.trace;
      if (joint.length === drawn) return;
      drawn = joint.length;
      const points = joint.filter((_, i) => i % Math.ceil(joint.length / 200) === 0 || i === joint.length - 1);
      const values = points.map((point) => point[1]);
      const [low, high] = [Math.min(...values), Math.max(...values)];
      const [first, last] = [points[0]?.[0] ?? 0, points.at(-1)?.[0] ?? 1];
      const text = points.map(([sweep, value]) => `${((100 * (sweep - first)) / (last - first || 1)).toFixed(1)},${(28 - (26 * (value - low)) / (high - low || 1)).toFixed(1)}`);
      line.setAttribute("points", points.length > 1 ? text.join(" ") : "");
    });
    return svg;
  }

  viewSection() {
    const { session } = this;
    const layers = this.segmented(
      "Show",
      [
        ["mean", "Mean"],
        ["draw", "One draw"],
        ["entropy", "Entropy"],
      ],
      () => session.view.layer,
      (layer) => this.showLayer(layer),
      (layer) => layer !== "draw" || session.hasDraws,
    );
    const slider = h("input", { type: "range", min: 0, step: 1, "aria-label": "Draw number" });
    slider.addEventListener("input", () => {
      this.play(false);
      this.showDraw(Number(slider.value));
    });
    const play = this.button("play", "Play the draws", () => this.play(!this.playing), { when: () => session.draws.count > 1 });
    const count = h("output");
    const chain = h("select", { "aria-label": "Chain" });
    chain.addEventListener("change", () => this.showDraw(session.draw, Number(chain.value)));
    this.each(() => {
      const { chains, count: n } = session.draws;
      put(slider, "max", String(Math.max(0, n - 1)));
      put(slider, "disabled", n === 0);
      put(slider, "value", String(session.draw));
      const text = n ? `${session.draw + 1} of ${n}` : "none kept";
      slider.setAttribute("aria-valuetext", text);
      slider.style.setProperty("--fill", `${n > 1 ? (100 * session.draw) / (n - 1) : 0}%`);
      put(count, "textContent", text);
      if (chain.length !== Math.max(1, chains)) {
        chain.replaceChildren(...Array.from({ length: Math.max(1, chains) }, (_, c) => h("option", { value: String(c), textContent: `chain ${c + 1}` })));
      }
      put(chain, "value", String(session.view.chain));
      put(chain, "disabled", chains < 2);
      if (n < 2 && this.playing) this.play(false);
    });
    this.each(() => {
      const label = this.playing ? "Pause the draws" : "Play the draws";
      if (play.getAttribute("aria-label") === label) return;
      play.setAttribute("aria-label", label);
      play.replaceChildren(icon(this.playing ? "pause" : "play"));
    });
    const truth = this.checkbox("True walls", () => this.show.truth, (on) => this.mark("truth", on));
    this.each(() => put(truth, "hidden", Boolean(session.document) && session.document?.source.kind !== "simulation"));
    const marks = h(
      "div",
      { className: "checks", role: "group", "aria-label": "Marks" },
      truth,
      this.checkbox("Rays", () => this.show.rays, (on) => this.mark("rays", on)),
      this.checkbox("Readings", () => this.show.readings, (on) => this.mark("readings", on)),
    );
    return this.section("View", layers, h("div", { className: "player" }, play, slider, count, chain), marks);
  }

  /** @param {"truth" | "rays" | "readings"} mark @param {boolean} on */
  mark(mark, on) {
    this.show[mark] = on;
    this.hand.changed();
  }

  /** @param {string} layer */
  showLayer(layer) {
    if (layer !== "draw") this.play(false);
    else if (!this.session.hasDraws) return;
    this.session.act({ type: "view", layer, chain: this.session.view.chain });
  }

  /** @param {number} draw @param {number} [chain] */
  showDraw(draw, chain = this.session.view.chain) {
    this.session.act({ type: "view", layer: "draw", chain, draw });
  }

  /** Plays on until the last draw; the next is asked for when one has been painted. @param {boolean} on */
  play(on) {
    this.playing = on;
    if (on) {
      const { draw, draws } = this.session;
      this.showDraw(draw >= draws.count - 1 ? 0 : draw);
    }
    this.hand.changed();
  }

  /** Called after a picture is painted. */
  step() {
    if (!this.playing || this.session.shown?.layer !== "draw") return;
    setTimeout(() => {
      if (!this.playing) return;
      const { draw, draws } = this.session;
      if (draw + 1 >= draws.count) this.play(false);
      else this.showDraw(draw + 1);
    }, 90);
  }

  scanSection() {
    const { session } = this;
    const slider = h("input", { type: "range", min: 0, step: 1, "aria-label": "Scan number" });
    const count = h("output");
    slider.addEventListener("input", () => session.act({ type: "scan", index: Number(slider.value) }));
    const section = this.section("Scan", h("div", { className: "player bare" }, slider, count));
    this.each(() => {
      const scans = session.document?.source.kind === "simulation" ? 0 : (session.document?.source.scans ?? 0);
      put(section, "hidden", scans < 2);
      put(slider, "max", String(Math.max(0, scans - 1)));
      const index = session.scan?.index ?? 0;
      if (/** @type {ShadowRoot} */ (slider.getRootNode()).activeElement !== slider) put(slider, "value", String(index));
      slider.style.setProperty("--fill", `${(100 * Number(slider.value)) / Math.max(1, scans - 1)}%`);
      put(count, "textContent", `${Number(slider.value) + 1} / ${scans}`);
    });
    return section;
  }

  sensorSection() {
    const { session, hand } = this;
    const list = h("select", { onchange: () => this.select_(Number(list.value)) });
    let known = "";
    this.each(() => {
      const sensors = session.document?.sensors ?? [];
      const ids = sensors.map((sensor) => sensor.id).join();
      if (ids !== known) list.replaceChildren(...sensors.map(({ id }) => h("option", { value: String(id), textContent: `Sensor ${id}` })));
      known = ids;
      put(list, "value", String(hand.sensor?.id ?? ""));
    });
    const place = (/** @type {string} */ label, /** @type {"x" | "y"} */ axis) =>
      this.numberInput(
        label,
        () => Number((hand.sensor?.[axis] ?? 0).toFixed(2)),
        (value) => hand.sensor && hand.moveSensor(hand.sensor, { [axis]: value }, undefined),
        { step: "any" },
      );
    const heading = this.numberInput(
      "heading (\u00b0)",
      () => Math.round(((hand.sensor?.yaw ?? 0) * 180) / Math.PI),
      (value) => hand.sensor && hand.moveSensor(hand.sensor, { yaw: ((value % 360) * Math.PI) / 180 }, undefined),
      { step: 5 },
    );
    const add = this.button("plus", "Add a sensor", () => hand.addSensor(), { text: "Add" });
    const remove = this.button("minus", "Remove the sensor", () => hand.removeSensor(), {
      text: "Remove",
      when: () => (session.document?.sensors.length ?? 0) > 1,
    });
    const numbers = h("div", { className: "triple" }, place("x (m)", "x"), place("y (m)", "y"), heading);
    return this.section("Sensors", h("div", { className: "buttons" }, this.named("Selected sensor", list), add, remove), numbers);
  }

  /** @param {string} label @param {HTMLElement} element */
  named(label, element) {
    element.setAttribute("aria-label", label);
    return element;
  }

  /** @param {number} id */
  select_(id) {
    this.hand.selected = id;
    this.hand.choose("sensor");
  }

  modelSection() {
    const { session } = this;
    const simulated = [
      this.slider("noise", () => "Noise (m)", { low: 0, high: 5, step: 0.01, unit: " m" }),
      this.slider("angles", () => "Angles", { low: LIMITS.angles[0], high: LIMITS.angles[1], step: 1, log: true }),
      this.numberInput("Longest range (m)", () => session.document?.max_range ?? 0, (max_range) => this.set({ max_range }), { min: 0, step: "any" }),
    ];
    this.each(() => simulated.forEach((element) => put(element, "hidden", !session.editable)));
    return this.section("Model", this.slider("prior", () => "Prior P(wall)", { low: 0, high: 1, step: 0.01 }), ...simulated);
  }

  inferenceSection() {
    const { session } = this;
    const method = () => session.document?.method ?? "gibbs";
    const unit = () => ({ importance: "Particles", propagate: "Rounds" })[method()] ?? "Sweeps";
    return this.section(
      "Inference",
      this.select("Method", METHODS, method, (value) => this.set({ method: value })),
      this.select("Order", ORDERS, () => session.document?.order ?? "radial", (order) => this.set({ order }), () => method() === "gibbs"),
      this.slider("sweeps", unit, { low: LIMITS.sweeps[0], high: LIMITS.sweeps[1], step: 1, log: true }),
      this.numberInput("Seed", () => session.document?.seed ?? 0, (seed) => this.set({ seed: Math.max(0, Math.round(seed)) }), { min: 0, step: 1 }),
    );
  }

  mapSection() {
    const { session } = this;
    const walls = this.button(null, "Clear walls", () => session.act({ type: "clear", what: "walls" }), { text: "Clear walls", when: () => session.editable });
    const inference = this.button(null, "Clear inference", () => session.act({ type: "clear", what: "inference" }), { text: "Clear inference" });
    return this.section("Clear", h("div", { className: "buttons" }, walls, inference));
  }

  /** @param {string} title @param {(Node | string)[]} children */
  dialog(title, ...children) {
    const id = `${this.prefix}-dialog-${title.replace(/\W/g, "")}`;
    const close = h("button", { type: "button", className: "plain", "aria-label": "Close", onclick: () => dialog.close() }, icon("close"));
    const dialog = h("dialog", { "aria-labelledby": id }, h("div", { className: "title" }, h("h2", { id, textContent: title }), close), ...children);
    dialog.addEventListener("click", (event) => {
      if (event.target === dialog) dialog.close();
    });
    dialog.addEventListener("keydown", (event) => event.stopPropagation());
    return dialog;
  }

  buildHelp() {
    const rows = KEYS.map(([key, text]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", { textContent: key })), h("td", { textContent: text })));
    return this.dialog(
      "Help",
      h("p", { textContent: "Draw walls, and drag the robot: a beam reads the first wall that it hits, with noise. Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (draw), and where doubt remains (entropy). No beam has been where it is hatched." }),
      h("p", { textContent: "While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact in the long run." }),
      h("table", {}, h("tbody", {}, ...rows)),
      h("p", { textContent: "Mouse: the wheel zooms, the middle button pans, Shift or the right button erases. Touch: two fingers zoom and pan." }),
    );
  }

  buildNew() {
    const { session } = this;
    const id = this.prefix;
    const size = () => h("input", { type: "number", min: LIMITS.cells[0], max: LIMITS.cells[1], step: 1, required: true, value: "21" });
    const [width, height] = [size(), size()];
    const world = h("select", {});
    for (const [value, text] of [["tutorial", "the tutorial's map"], ["building", "a building"], ["blank", "blank"]]) world.append(h("option", { value, textContent: text }));
    world.addEventListener("change", () => {
      if (world.value === "building" && Number(width.value) < 60) [width.value, height.value] = ["120", "80"];
    });
    const line = (/** @type {string} */ label, /** @type {HTMLElement} */ control) => {
      control.id = `${id}-new-${label.replace(/\W/g, "")}`;
      return h("div", { className: "row" }, h("label", { for: control.id, textContent: label }), control);
    };
    const form = h(
      "form",
      { method: "dialog" },
      line("World", world),
      line("Width (cells)", width),
      line("Height (cells)", height),
      h("div", { className: "buttons end" }, h("button", { type: "submit", className: "primary", textContent: "Create" })),
    );
    form.addEventListener("submit", () => {
      session.act({ type: "new", shape: [Number(width.value), Number(height.value)], world: world.value });
      this.hand.selected = null;
    });
    return this.dialog("New map", form);
  }

  buildShare() {
    this.shareLink = h("input", { type: "text", readOnly: true, "aria-label": "Link" });
    const copied = h("span", { role: "status", className: "copied" });
    const link = this.shareLink;
    const copy = this.button(null, "Copy the link", async () => {
      link.select();
      try {
        await navigator.clipboard.writeText(link.value);
      } catch {
        document.execCommand("copy");
      }
      copied.textContent = "Copied";
      setTimeout(() => (copied.textContent = ""), 2000);
    }, { className: "primary", text: "Copy" });
    return this.dialog(
      "Share",
      h("p", { textContent: "The link holds the walls, the sensors and all settings after its #. It opens on this server while it runs; the part from # on can be put after the address of any bayesmap page." }),
      h("div", { className: "buttons" }, link, copy),
      copied,
    );
  }
}

const STYLE = `
:host { display: block; height: 100dvh; container-type: inline-size; }
:host([data-embedded]) { height: 720px; }
* { box-sizing: border-box; margin: 0; }
[hidden], .hidden { display: none !important; }
.hidden[aria-live] { display: block !important; position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.app { --ground: #f4f5f7; --card: #fff; --text: #1d2430; --soft: #565d68; --line: #d8dce2; --control: #848c98; --accent: #00639c;
  --on-accent: #fff; --tint: #e3eef6; --bad: #a43b00; --warn: #fff4d6; --warn-text: #5c4300; color-scheme: light;
  display: grid; height: 100%; grid-template: "head head" auto "bar panel" auto "stage panel" minmax(0, 1fr) "legend panel" auto "foot foot" auto / minmax(0, 1fr) 328px;
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
button { display: inline-flex; align-items: center; justify-content: center; gap: 6px; height: 32px; padding: 0 10px; border: 1px solid transparent; border-radius: 6px;
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
.menu { position: absolute; z-index: 5; top: 38px; right: 0; padding: 5px; display: grid; background: var(--card); border: 1px solid var(--line); border-radius: 8px; box-shadow: 0 8px 28px #0004; }
.menu button { justify-content: flex-start; }
.bar { grid-area: bar; display: flex; align-items: center; gap: 2px; padding: 10px 12px 0; }
.segmented { display: inline-flex; padding: 2px; border: 1px solid var(--line); border-radius: 8px; background: var(--card); }
.segmented label { position: relative; display: inline-flex; align-items: center; justify-content: center; gap: 6px; flex: 1; min-height: 30px; padding: 0 11px; border-radius: 6px; cursor: pointer; white-space: nowrap; }
.segmented input { position: absolute; inset: 0; width: 100%; height: 100%; opacity: 0; cursor: pointer; }
.segmented label:has(:checked) { background: var(--accent); color: var(--on-accent); font-weight: 600; }
.segmented label:has(:disabled) { color: var(--soft); opacity: .55; }
.segmented label:has(:focus-visible) { outline: 2px solid var(--accent); outline-offset: 2px; }
.segmented label:hover:not(:has(:checked)):not(:has(:disabled)) { background: var(--tint); }
.stage { grid-area: stage; position: relative; min-height: 0; overflow: hidden; }
canvas { position: absolute; inset: 0; width: 100%; height: 100%; touch-action: none; cursor: crosshair; }
canvas[data-tool=pan] { cursor: grab; }
canvas[data-tool=sensor] { cursor: default; }
canvas:focus-visible { outline-offset: -3px; }
.chip { position: absolute; left: 0; top: 0; white-space: nowrap; padding: 2px 8px; border-radius: 5px; background: var(--card); color: var(--text); border: 1px solid var(--line); font-size: 12px; pointer-events: none; }
.chip.approximate { background: var(--warn); color: var(--warn-text); border-color: transparent; }
.banner { position: absolute; z-index: 4; left: 12px; right: 12px; top: 10px; display: flex; flex-wrap: wrap; align-items: center; gap: 6px 12px; padding: 8px 12px; border-radius: 8px; background: var(--bad); color: var(--card); box-shadow: 0 4px 16px #0004; }
.banner.mild { background: var(--warn); color: var(--warn-text); }
.banner button { border-color: currentColor; }
.banner button:hover { background: #0002 !important; }
.legend { grid-area: legend; display: flex; flex-wrap: wrap; gap: 2px 16px; list-style: none; padding: 2px 12px 9px 46px; font-size: 12.5px; color: var(--soft); }
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
select, input[type=number], input[type=text] { width: 100%; height: 30px; padding: 0 7px; border: 1px solid var(--control); border-radius: 6px; background: var(--card); }
select:disabled { opacity: .55; }
input[type=range] { appearance: none; width: 100%; height: 22px; margin: 0; background: none; cursor: pointer; touch-action: pan-y; }
input[type=range]::-webkit-slider-runnable-track { height: 4px; border-radius: 2px; background: linear-gradient(var(--accent) 0 0) 0 / var(--fill, 0%) 100% no-repeat var(--line); }
input[type=range]::-webkit-slider-thumb { appearance: none; width: 16px; height: 16px; margin-top: -6px; border-radius: 50%; border: 2px solid var(--card); background: var(--accent); box-shadow: 0 0 0 1px var(--accent); }
input[type=range]::-moz-range-track { height: 4px; border-radius: 2px; background: linear-gradient(var(--accent) 0 0) 0 / var(--fill, 0%) 100% no-repeat var(--line); }
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
footer { grid-area: foot; display: flex; gap: 6px 24px; justify-content: space-between; padding: 5px 16px 6px; border-top: 1px solid var(--line); background: var(--card); font-size: 12.5px; min-height: 30px; }
footer [role=status]::before { content: ""; display: inline-block; width: 8px; height: 8px; margin-right: 8px; border-radius: 50%; background: var(--sensor); }
footer .warning::before { background: #e0a000; }
footer .error { color: var(--bad); }
footer .error::before { background: var(--bad); }
footer [role=status] { min-width: 0; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.readout { color: var(--soft); white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
dialog { margin: auto; width: min(540px, calc(100% - 32px)); max-height: calc(100% - 32px); padding: 16px 20px 20px; border: 1px solid var(--line); border-radius: 12px; background: var(--card); color: var(--text); box-shadow: 0 16px 60px #0006; }
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
@media (pointer: coarse) { button, select, input[type=number], input[type=text], .segmented label { min-height: 40px; } input[type=range] { height: 34px; } .check { min-height: 40px; } }
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
`;

// ------------------------------------------------------------------------------------------------- transports

const ARRAYS = /** @type {{[dtype: string]: new (buffer: ArrayBuffer) => Numbers}} */ ({
  uint8: Uint8Array,
  float32: Float32Array,
  float64: Float64Array,
});
/** @typedef {{name: string, dtype: string, shape: number[]}} BufferEntry */

/** A binary frame: length, JSON, buffers padded to 8 bytes. @param {ArrayBuffer} frame @returns {[Message, Buffers]} */
export function unpackFrame(frame) {
  const length = new DataView(frame).getUint32(0, true);
  const message = /** @type {Message} */ (JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 4, length))));
  /** @type {Buffers} */
  const buffers = {};
  let at = 4 + length;
  for (const { name, dtype, shape } of /** @type {BufferEntry[]} */ (message.buffers)) {
    const size = shape.reduce((a, b) => a * b, 1) * (dtype === "float64" ? 8 : dtype === "float32" ? 4 : 1);
    buffers[name] = new ARRAYS[dtype](frame.slice(at, at + size));
    at += Math.ceil(size / 8) * 8;
  }
  return [message, buffers];
}

/** @returns {Pick<Transport, "onmessage" | "onstatus">} */
const deaf = () => ({ onmessage: () => {}, onstatus: () => {} });

/** The server of `bayesmap app`; it reconnects, waiting twice as long each time up to 8 s. @param {string} url @returns {Transport} */
export function webSocketTransport(url) {
  /** @type {WebSocket | null} */
  let socket = null;
  let wait_ms = 250;
  let timer = 0;
  let closed = false;
  function open() {
    clearTimeout(timer);
    const current = new WebSocket(url);
    socket = current;
    current.binaryType = "arraybuffer";
    current.onopen = () => {
      wait_ms = 250;
      transport.onstatus({ connected: true });
    };
    current.onmessage = ({ data }) => {
      if (typeof data === "string") transport.onmessage(JSON.parse(data), {});
      else transport.onmessage(...unpackFrame(data));
    };
    current.onclose = () => {
      if (closed || socket !== current) return;
      timer = window.setTimeout(open, wait_ms);
      transport.onstatus({ connected: false, retryIn_ms: wait_ms });
      wait_ms = Math.min(8000, 2 * wait_ms);
    };
  }
  /** @type {Transport} */
  const transport = {
    ...deaf(),
    open,
    send: (message) => {
      if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
    },
    retry: () => {
      wait_ms = 250;
      if (socket?.readyState !== WebSocket.OPEN) open();
    },
    close: () => {
      closed = true;
      clearTimeout(timer);
      socket?.close();
    },
  };
  return transport;
}

/** A notebook's kernel. @param {any} model anywidget's @returns {Transport} */
export function widgetTransport(model) {
  const listen = (/** @type {Message} */ message, /** @type {DataView[]} */ views = []) => {
    /** @type {Buffers} */
    const buffers = {};
    (message.buffers ?? []).forEach((/** @type {BufferEntry} */ { name, dtype }, /** @type {number} */ i) => {
      const { buffer, byteOffset, byteLength } = views[i];
      buffers[name] = new ARRAYS[dtype](/** @type {ArrayBuffer} */ (buffer.slice(byteOffset, byteOffset + byteLength)));
    });
    transport.onmessage(message, buffers);
  };
  /** @type {Transport} */
  const transport = {
    ...deaf(),
    open: () => {
      model.on("msg:custom", listen);
      transport.onstatus({ connected: true });
    },
    send: (message) => model.send(message),
    close: () => model.off("msg:custom", listen),
  };
  return transport;
}

/** A recording inside the page (docs/app.md). @param {any} recording @returns {Transport} */
export function recordedTransport(recording) {
  const { document, scans, settings = {}, log_joint = [] } = recording;
  const [nx, ny] = document.grid.shape;
  const cells = nx * ny;
  const count = recording.draws?.count ?? 0;
  const oneByOne = document.source.kind !== "simulation";
  const mean = fromBase64(recording.mean);
  const observed = fromBase64(recording.observed);
  /** @type {Uint8Array | null} */
  let draws = null;
  let index = 0;
  /** @type {View} */
  let view = { layer: "mean", chain: 0, draw: null };
  const rows = (/** @type {(number | null)[][]} */ values) => (oneByOne ? [values[index]] : values);
  const floats = (/** @type {(number | null)[][]} */ values) =>
    Float32Array.from(rows(values ?? []).flat(), (value) => value ?? Infinity);
  const state = (/** @type {number} */ seq) => {
    const held = { chains: recording.draws?.chains ?? 0, count: draws ? count : 0 };
    const message = { type: "state", document, generation: 1, seq, can_undo: false, can_redo: false, live: false, running: false };
    transport.onmessage({ ...message, draws: held, view }, {});
  };
  const scan = () => {
    const pose = Float64Array.from(rows(scans.pose).flat(), Number);
    const message = { type: "scan", generation: 1, ids: oneByOne ? [index] : scans.ids, index: oneByOne ? index : null };
    const exact = scans.exact?.length ? floats(scans.exact) : new Float32Array(0);
    transport.onmessage(message, { pose, angles: Float32Array.from(scans.angles), ranges: floats(scans.ranges), exact });
  };
  const field = () => {
    let p = mean;
    if (view.layer === "draw" && draws) {
      p = new Uint8Array(cells);
      const first = (view.chain * count + (view.draw ?? count - 1)) * cells;
      for (let i = 0; i < cells; i++) p[i] = (draws[(first + i) >> 3] >> (7 - ((first + i) & 7))) & 1 ? 255 : 0;
    }
    const joint = log_joint[view.chain]?.[(view.layer === "draw" ? view.draw : null) ?? count - 1] ?? null;
    const which = p === mean ? { layer: view.layer === "draw" ? "mean" : view.layer } : { ...view, draw: view.draw ?? count - 1 };
    const numbers = { sweeps: settings.sweeps ?? count, total: settings.sweeps ?? count, ess: settings.ess, rhat: settings.rhat, log_joint: joint };
    transport.onmessage({ type: "field", generation: 1, ...which, method: settings.method ?? document.method, approximate: false, ...numbers }, { p, observed });
  };
  /** How many of the scan's beams pass through a cell before they end. @param {number} x @param {number} y */
  const beams = (x, y) => {
    const { origin, resolution } = document.grid;
    const low = [origin[0] + x * resolution, origin[1] + y * resolution];
    const ranges = rows(scans.ranges);
    let passing = 0;
    rows(scans.pose).forEach((pose, s) => {
      const [px, py, yaw] = pose.map(Number);
      scans.angles.forEach((/** @type {number} */ angle, /** @type {number} */ b) => {
        const [dx, dy] = [Math.cos(angle + yaw), Math.sin(angle + yaw)];
        const along = [(low[0] - px) / dx, (low[0] + resolution - px) / dx, (low[1] - py) / dy, (low[1] + resolution - py) / dy];
        const enter = Math.max(0, Math.min(along[0], along[1]), Math.min(along[2], along[3]));
        const leave = Math.min(ranges[s][b] ?? Infinity, Math.max(along[0], along[1]), Math.max(along[2], along[3]));
        if (enter < leave) passing++;
      });
    });
    return passing;
  };
  /** @type {Transport} */
  const transport = {
    ...deaf(),
    open: () => transport.onstatus({ connected: true }),
    send: (message) => {
      if (message.type === "hello") {
        transport.onmessage({ type: "welcome", version: 1, recorded: true }, {});
        state(message.seq);
        scan();
        field();
        if (count) {
          inflate(fromBase64(recording.draws.data)).then((bits) => {
            draws = bits;
            state(message.seq);
          });
        }
      } else if (message.type === "view") {
        view = { layer: message.layer, chain: message.chain ?? view.chain, draw: message.draw ?? null };
        state(message.seq);
        field();
      } else if (message.type === "scan") {
        index = message.index;
        state(message.seq);
        scan();
      } else if (message.type === "inspect") {
        transport.onmessage({ type: "cell", x: message.x, y: message.y, beams: beams(message.x, message.y) }, {});
      }
    },
    close: () => {},
  };
  return transport;
}

// ------------------------------------------------------------------------------------------------------ mount

/** Offers bytes as a file. @param {string} name @param {Blob} blob */
function download(name, blob) {
  const url = URL.createObjectURL(blob);
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/**
 * Puts the page into an element.
 * @param {HTMLElement} element @param {Transport} transport
 * @param {{embedded?: boolean, document?: MapDocument | null}} [options] embedded: in a notebook; document: to adopt
 */
export function mount(element, transport, { embedded = false, document: adopted = null } = {}) {
  const shadow = element.shadowRoot ?? element.attachShadow({ mode: "open" });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  shadow.adoptedStyleSheets = [sheet];
  element.toggleAttribute("data-embedded", embedded);

  const canvas = h("canvas", { tabIndex: 0, role: "application" });
  const painter = new Painter(canvas);
  let frame = 0;
  const schedule = () => {
    frame ||= requestAnimationFrame(draw);
  };
  const session = new Session(transport, schedule);
  session.adopt = adopted;
  const hand = new Hand(canvas, session, painter, schedule, embedded);
  const controls = new Controls(session, painter, hand, command);
  const stage = h("main", { className: "stage" }, canvas, controls.chip, controls.banner);
  const dialogs = [controls.help, controls.create, controls.share];
  const app = h("div", { className: "app" }, controls.head, controls.bar, stage, controls.legend, controls.panel, controls.foot, ...dialogs);
  canvas.setAttribute("aria-describedby", controls.readout.id);
  shadow.replaceChildren(app);

  // colours
  const darkMedia = matchMedia("(prefers-color-scheme: dark)");
  let choice = "auto";
  try {
    choice = localStorage.getItem("bayesmap-theme") ?? "auto";
  } catch {
    // a page without storage
  }
  let theme = LIGHT;
  function dress() {
    const dark = choice === "dark" || (choice === "auto" && darkMedia.matches);
    theme = dark ? DARK : LIGHT;
    app.dataset.theme = dark ? "dark" : "light";
    const colors = { truth: theme.truth, ray: theme.ray, miss: theme.noReturn, sensor: theme.sensor, hatch: theme.hatch, unobserved: theme.unobserved };
    for (const [name, value] of Object.entries(colors)) app.style.setProperty(`--${name}`, value);
    const label = `Theme: ${choice === "auto" ? "automatic" : choice}`;
    controls.themeButton?.setAttribute("aria-label", label);
    if (controls.themeButton) controls.themeButton.title = label;
    schedule();
  }
  darkMedia.addEventListener("change", dress);

  // painting: once a frame at most
  let shape = "";
  function draw() {
    frame = 0;
    const fresh = session.take();
    if (session.document && String(session.shape) !== shape) {
      shape = String(session.shape);
      painter.fit(session.shape);
      hand.cursor = hand.hover = null;
      canvas.setAttribute("aria-label", `Map, ${session.shape[0]} by ${session.shape[1]} cells`);
    }
    painter.paint(session, look());
    if (fresh) {
      session.painted();
      controls.step();
    }
    const { x, y } = painter.transform;
    controls.chip.style.transform = `translate(${Math.max(x, GUTTER.left)}px, ${Math.max(y - 28, 6)}px)`;
    put(canvas.dataset, "tool", session.editable ? hand.tool : "pan");
    const ramp = session.view.layer === "entropy" ? entropyRgb : (/** @type {number} */ t) => probabilityRgb(theme, t);
    const key = `${session.view.layer === "entropy"} ${theme.ground}`;
    if (controls.ramp && controls.ramp.dataset.key !== key) {
      controls.ramp.dataset.key = key;
      controls.ramp.style.background = gradient(ramp);
    }
    controls.refresh();
  }
  /** @returns {Look} */
  function look() {
    const selected = session.editable && hand.tool === "sensor" ? (hand.sensor?.id ?? null) : null;
    return { theme, ...controls.show, hover: hand.hover, cursor: hand.cursor, selected };
  }
  const observer = new ResizeObserver(() => {
    const { width, height } = stage.getBoundingClientRect();
    if (!width || !height) return;
    painter.resize(width, height, devicePixelRatio || 1);
    if (painter.fitted) painter.fit(session.shape);
    cancelAnimationFrame(frame);
    draw(); // at once: a canvas that was resized is blank
  });
  observer.observe(stage);

  // commands that are not messages
  /** @param {string} what */
  async function command(what) {
    const middle = { x: painter.width / 2, y: painter.height / 2 };
    if (what === "in" || what === "out") painter.zoom(what === "in" ? 1.4 : 1 / 1.4, middle, session.shape);
    else if (what === "fit") painter.fit(session.shape);
    else if (what === "help") controls.help?.showModal();
    else if (what === "new") controls.create?.showModal();
    else if (what === "theme") {
      choice = { auto: "light", light: "dark", dark: "auto" }[choice] ?? "auto";
      try {
        localStorage.setItem("bayesmap-theme", choice);
      } catch {
        // the choice holds for this page only
      }
      dress();
    } else if (what === "share") {
      const whole = session.effectiveDocument();
      if (!whole || !controls.shareLink) return;
      controls.shareLink.value = location.href.replace(/#.*/, "") + (await toFragment(whole));
      controls.share?.showModal();
      controls.shareLink.select();
    } else if (what === "export png") picture();
    else if (what.startsWith("export ")) session.act({ type: "export", what: what.slice(7) });
    schedule();
  }

  /** The whole map, at twice the pixels, as it looks now. */
  function picture() {
    const other = new Painter(h("canvas"));
    const [nx, ny] = session.shape;
    const width = 900;
    other.resize(width, clamp((width * ny) / nx, 300, 1800), 2);
    other.fit(session.shape);
    other.paint(session, { ...look(), hover: null, cursor: null, selected: null });
    other.canvas.toBlob((blob) => {
      if (blob) download("bayesmap.png", blob);
      session.say("Saved bayesmap.png");
    });
  }
  session.ondownload = (name, mime, data) => download(name, new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (data)], { type: mime }));

  // keys of the whole page; those of the map are the hand's
  /** @param {KeyboardEvent} event */
  function key(event) {
    if (event.defaultPrevented || !session.document || dialogs.some((dialog) => dialog?.open)) return;
    const target = /** @type {HTMLElement} */ (event.composedPath()[0]);
    const typing = target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && /number|text/.test(target.type));
    if ((event.ctrlKey || event.metaKey) && !event.altKey) {
      const letter = event.key.toLowerCase();
      if (typing || (letter !== "z" && letter !== "y") || session.recorded) return;
      event.preventDefault();
      session.act({ type: letter === "y" || event.shiftKey ? "redo" : "undo" });
      return;
    }
    if (typing || event.altKey) return;
    const tool = /** @type {{[key: string]: Tool}} */ ({ d: "draw", e: "erase", s: "sensor", p: "pan" })[event.key.toLowerCase()];
    const layer = { m: "mean", n: "draw", h: "entropy" }[event.key.toLowerCase()];
    const zoom = { "+": "in", "=": "in", "-": "out", "0": "fit", "?": "help" }[event.key];
    if (tool && session.editable) {
      hand.choose(tool);
      canvas.focus({ preventScroll: true });
    } else if (layer) controls.showLayer(layer);
    else if (zoom) command(zoom);
    else if (event.key.toLowerCase() === "r" && !session.recorded) session.act({ type: "run" });
    else if (event.key === "Escape" && (session.running || session.sampling)) session.act({ type: "cancel" });
    else return;
    event.preventDefault();
  }
  const keys = embedded ? element : window;
  keys.addEventListener("keydown", /** @type {EventListener} */ (key));

  transport.onmessage = (message, buffers) => session.receive(message, buffers);
  transport.onstatus = (connection) => session.onstatus(connection);
  const online = () => transport.retry?.();
  const hash = async () => {
    const document = embedded ? null : await takeFragment();
    if (document) session.act({ type: "hello", document });
  };
  window.addEventListener("online", online);
  window.addEventListener("hashchange", hash);
  dress();
  transport.open();

  return {
    destroy() {
      observer.disconnect();
      cancelAnimationFrame(frame);
      darkMedia.removeEventListener("change", dress);
      keys.removeEventListener("keydown", /** @type {EventListener} */ (key));
      window.removeEventListener("online", online);
      window.removeEventListener("hashchange", hash);
      transport.close();
      shadow.replaceChildren();
    },
    /** What is known and shown, for tests. */
    snapshot() {
      const { shown, view } = session;
      return {
        document: session.effectiveDocument(),
        generation: session.generation,
        painted: shown && {
          generation: shown.generation,
          layer: shown.layer === "draw" ? "draw" : view.layer === "entropy" ? "entropy" : "mean",
          approximate: shown.approximate,
          sweeps: shown.sweeps,
          method: shown.method,
          rhat: shown.rhat,
          chain: shown.chain,
          draw: shown.draw,
          ess: shown.ess,
        },
        probability: shown?.p ?? new Uint8Array(0),
        observed: shown?.observed ?? new Uint8Array(0),
        walls: session.walls,
        sensors: session.document?.sensors ?? [],
        scan: session.scan,
        status: session.status,
        connected: session.connection.connected,
        worker: session.worker,
        running: session.running,
        draws: session.draws,
        view,
        seq: { sent: session.acted, confirmed: session.state?.seq ?? 0 },
        events: session.events,
        transform: { ...painter.transform },
      };
    },
    /** Where the centre of a cell is on the page. @param {number} x @param {number} y */
    cellToClient(x, y) {
      const box = canvas.getBoundingClientRect();
      const point = painter.fromGrid({ x: x + 0.5, y: y + 0.5 }, session.shape[1]);
      return { x: box.left + point.x, y: box.top + point.y };
    },
  };
}
/** @typedef {ReturnType<typeof mount>} Handle */

/** @param {Handle} handle */
const expose = (handle) => Object.assign(window, { bayesmap: handle });

export default {
  /** anywidget's entry. @param {{model: any, el: HTMLElement}} context */
  render({ model, el }) {
    const host = document.createElement("div");
    el.append(host);
    const handle = mount(host, widgetTransport(model), { embedded: true });
    expose(handle);
    return () => handle.destroy();
  },
};

/** The document of the address's fragment, which is taken off: a reload shows what has become of it. */
async function takeFragment() {
  const found = await fromFragment(location.hash).catch(() => null);
  if (found) history.replaceState(null, "", location.pathname + location.search);
  return found;
}

/** Mounts the page of the server, or the recording of a static export, where a document asks for it. */
async function start() {
  const host = /** @type {HTMLElement | null} */ (document.querySelector("[data-bayesmap]"));
  if (!host || host.shadowRoot) return;
  const sheet = new CSSStyleSheet();
  sheet.replaceSync("body { margin: 0; }");
  document.adoptedStyleSheets.push(sheet);
  const recording = document.querySelector("script[data-recording]");
  if (recording) {
    expose(mount(host, recordedTransport(JSON.parse(recording.textContent ?? ""))));
    return;
  }
  const url = new URL("socket" + location.search, location.href);
  url.protocol = url.protocol.replace("http", "ws");
  url.hash = "";
  expose(mount(host, webSocketTransport(url.href), { document: await takeFragment() }));
}
start();
