// The page without paint: its session, hand and panels, and a server on paper that says what a test wants.

import { Element, page } from "./dom";
import { mock } from "node:test";
import { Editor } from "../src/input/editor";
import { Hand, type Tool } from "../src/input/hand";
import { MapKeys, pageKey } from "../src/input/keys";
import { Pointer } from "../src/input/pointer";
import { Viewport } from "../src/layers/viewport";
import { toBase64, packBits } from "../src/geometry/bits";
import { Ui } from "../src/panels/ui";
import { Player } from "../src/panels/view";
import type { Action, Buffers, Field, Limits, MapDocument, Notice, Pair, Quantity, State, Transport } from "../src/protocol";
import { Session } from "../src/state/session";

/** A message of which a test looks at some fields. */
export type Message = { type: string; [field: string]: any };

/** As a server has them; where these are the library's, tests/app/test_page_build.py passes the library's. */
export const LIMITS: Limits = {
  prior: [0.001, 0.999], noise: [0.01, 5], angles: [10, 1000], max_range: [0.1, 10000], fov: [Math.PI / 36, 2 * Math.PI], pose_sigma: [0, 2],
  heading_sigma: [0, 0.6], sweeps: [1, 100000], burn_in: [0, 0.9], seed: [0, 2 ** 31 - 1], radius: [0.001, 100], risk: [1e-6, 1 - 1e-6], side: [2, 500],
  sensors: [1, 32], resolution: [0.02, 2], side_of_log: [1, 1000],
};

export const SHAPE: Pair = [21, 21];

/** A drawn map of 21 x 21 cells of a metre, cell centres on whole metres, one robot in the middle. */
export function aDocument(changes: Partial<MapDocument> = {}): MapDocument {
  return {
    version: 1,
    grid: { shape: SHAPE, resolution: 1, origin: [-0.5, -0.5] },
    walls: wallsOf([[12, 4], [12, 5]]),
    sensors: [{ id: 1, x: 10, y: 10, yaw: 0 }],
    prior: 0.5, noise: 0.2, angles: 100, max_range: 42, fov: 2 * Math.PI, readings: "noisy",
    pose_sigma: 0, heading_sigma: 0, poses: "logged", cells: "binary",
    method: "auto", order: "radial", start: "auto", sweeps: 1000, burn_in: 0.1, seed: 0, scans_used: null, source: { kind: "simulation", name: "", scans: 0, bounds: null },
    ...changes,
  };
}

export const LOG: Partial<MapDocument> = { walls: "", sensors: [], source: { kind: "log", name: "room.log", scans: 12, bounds: [[0, 0], [8, 6]] } };
export const RUN: Partial<MapDocument> = { walls: "", sensors: [], source: { kind: "run", name: "run.nc", scans: 12, bounds: null } };

/** Packed walls of some cells. */
export function wallsOf(cells: Pair[], [nx, ny]: Pair = SHAPE) {
  const walls = new Uint8Array(nx * ny);
  for (const [x, y] of cells) walls[x * ny + y] = 1;
  return toBase64(packBits(walls));
}

/** A server on paper, and the page that is connected to it. */
export class Desk {
  readonly sent: Message[] = [];
  retries = 0;
  readonly transport: Transport = {
    onmessage: () => {}, onstatus: () => {}, open: () => {}, close: () => {},
    send: (action: Action) => void this.sent.push(action),
    retry: () => void this.retries++,
  };
  readonly commands: string[] = [];
  readonly view = new Viewport();
  readonly canvas = new Element("canvas");
  readonly session: Session;
  readonly hand: Hand;
  readonly editor: Editor;
  readonly player: Player;
  readonly ui: Ui;
  readonly keys: MapKeys;
  private document: MapDocument;
  private generation = 0;

  constructor(document: Partial<MapDocument> = {}, { connect = true, adopt = null as MapDocument | null } = {}) {
    this.document = aDocument(document);
    this.session = new Session(this.transport, () => {}, adopt);
    this.hand = new Hand(this.session);
    this.editor = new Editor(this.session, this.hand);
    this.player = new Player(this.session);
    this.ui = new Ui(this.session, this.hand, this.editor, (what) => this.commands.push(what), (layer) => this.player.showLayer(layer), false);
    this.view.resize(960, 800, 1);
    const canvas = this.canvas as unknown as HTMLCanvasElement;
    new Pointer(canvas, this.session, this.view, this.hand, this.editor, false);
    this.keys = new MapKeys(canvas, this.session, this.view, this.hand, this.editor);
    if (connect) this.connect();
  }

  /** The line is there: welcome, the state, and a picture. */
  connect() {
    this.transport.onstatus({ connected: true });
    this.says("welcome", { limits: LIMITS, recorded: false, figure: false, lacks: [] });
    this.confirm();
    this.says("worker", { state: "ready" });
    this.view.fit(this.session.shape);
    this.field();
  }

  /** The line is cut. */
  cut(status = {}) {
    this.transport.onstatus({ connected: false, retryIn_ms: 250, ...status });
  }

  /** The server's message. */
  says(type: string, fields: object = {}, buffers: Buffers = {}) {
    this.transport.onmessage({ type, ...fields } as Notice, buffers);
  }

  /** Confirms all that was sent, of a document with changes, which is a generation of its own. */
  confirm(changes: Partial<MapDocument> = {}, state: Partial<State> = {}) {
    this.document = { ...this.document, ...changes };
    const seq = this.session.acted;
    const fixed = { can_undo: false, can_redo: false, live: true, running: false, working: false, draws: { chains: 0, count: 0 }, scan: 0, view: this.session.view };
    this.says("state", { document: structuredClone(this.document), generation: ++this.generation, seq, ...fixed, ...state });
  }

  /** Changes what else the server says, with no generation of its own. */
  state(state: Partial<State>) {
    this.generation--;
    this.confirm({}, state);
  }

  /** A picture of the present generation, painted. */
  field(field: Partial<Field> = {}, { paint = true } = {}) {
    const { p, reached, trace, traced, weights, ...header } = field;
    const cells = this.document.grid.shape[0] * this.document.grid.shape[1];
    const known = { generation: this.generation, layer: "mean", method: "gibbs", approximate: false, sweeps: 1000, total: 1000, burned: 0, about: [] };
    const buffers = { p: p ?? new Uint8Array(cells), reached: reached ?? new Uint8Array(cells).fill(255), trace: trace ?? new Float32Array(0), traced: traced ?? new Float32Array(0) };
    this.says("field", { ...known, ...header }, weights ? { ...buffers, weights } : buffers);
    if (paint) this.paint();
  }

  /** What a frame of the page does. */
  paint() {
    if (!this.session.take()) return;
    this.session.painted();
    this.player.step();
  }

  /** Messages of a type that were sent, without their numbers. */
  asked(type: string) {
    return this.sent.filter((message) => message.type === type).map(({ seq, ...fields }) => fields);
  }

  /** Cells with walls, as they are shown. */
  get walls(): Pair[] {
    const ny = this.session.shape[1];
    return [...this.session.walls.keys()].filter((i) => this.session.walls[i]).map((i) => [Math.floor(i / ny), i % ny]);
  }

  get status() {
    return this.session.status.text;
  }

  /** Where the centre of a cell, or of a place between cells, is on the canvas. */
  at(x: number, y: number) {
    return this.view.fromGrid({ x: x + 0.5, y: y + 0.5 }, this.session.shape[1]);
  }

  choose(tool: Tool) {
    this.hand.choose(tool);
  }

  /** A pointer's event at a place in cells, or in pixels. */
  pointer(type: "down" | "move" | "up", where: Pair | { x: number; y: number }, fields: object = {}) {
    const { x, y } = Array.isArray(where) ? this.at(...where) : where;
    return this.canvas.dispatch(`pointer${type}`, { pointerId: 1, button: 0, pointerType: "mouse", clientX: x, clientY: y, shiftKey: false, ...fields });
  }

  /** Presses in the first cell, moves through the others, lets go. */
  drag(cells: Pair[], fields: object = {}) {
    this.pointer("down", cells[0], fields);
    for (const cell of cells.slice(1)) this.pointer("move", cell, fields);
    this.pointer("up", cells[cells.length - 1], fields);
  }

  /** A key on the map, and where the map has no use for it on the page. */
  key(name: string, fields: object = {}) {
    const event = this.canvas.dispatch("keydown", { key: name, shiftKey: false, ctrlKey: false, metaKey: false, altKey: false, ...fields });
    if (!event.defaultPrevented) this.pageKey(event);
  }

  pageKey(event: object) {
    pageKey(event as KeyboardEvent, this.session, {
      tool: (tool) => this.choose(tool), layer: (layer) => this.player.showLayer(layer), command: (what) => this.commands.push(what),
    });
  }
}

/** A panel, to be looked at as a reader does. */
export class Panel {
  private readonly element: Element;

  constructor(
    private readonly desk: Desk,
    make: (ui: Ui) => HTMLElement,
  ) {
    this.element = make(desk.ui) as unknown as Element;
    page.activeElement = null;
    desk.ui.refresh();
  }

  /** What is seen, in one line. */
  get text() {
    this.desk.ui.refresh();
    return this.element.innerText.replace(/\s+/g, " ").trim();
  }

  /** The control with a label, in text or as an attribute, and of a type where several have it. */
  control(label: string, type = ""): Element {
    this.desk.ui.refresh();
    const all = this.element.all(() => true);
    const named = all.filter((one) => one.tagName === "label" && one.textContent === label);
    const found = [
      ...all.filter((one) => one.getAttribute("aria-label") === label || (one.tagName === "button" && one.textContent === label)),
      ...named.flatMap((one) => [one.all((child) => child.tagName === "input")[0], one.parent?.all(({ tagName }) => /input|select/.test(tagName))[0]]),
    ].find((one) => one && (!type || one.type === type));
    if (!found) throw new Error(`no ${type || "control"} ${label} in: ${this.element.textContent}`);
    return found;
  }

  /** Whether something is seen: no element around it is hidden. */
  sees(label: string) {
    for (let one: Element | null = this.control(label); one; one = one.parent) if (one.hidden) return false;
    return true;
  }

  find(wanted: (element: Element) => boolean) {
    this.desk.ui.refresh();
    return this.element.all(wanted);
  }
}

export const SURFACES: Quantity = { kind: "surface", mean: "mean reflectivity", value: "reflectivity", interval: true };

/** A panel of a connected page. */
export function panel(make: (ui: Ui) => HTMLElement, document: Partial<MapDocument> = {}): [Desk, Panel] {
  const desk = new Desk(document);
  return [desk, new Panel(desk, make)];
}

/** A page with a tool in the hand. */
export function holding(tool: Tool, document: Partial<MapDocument> = { walls: wallsOf([]) }) {
  const desk = new Desk(document);
  desk.choose(tool);
  desk.sent.length = 0;
  return desk;
}

/** Runs with timers that only the test moves on. */
export function timed(body: () => void) {
  mock.timers.enable({ apis: ["setTimeout"] });
  try {
    body();
  } finally {
    mock.timers.reset();
  }
}
