// What the page knows: the document, the edits that are on their way, the newest field.

import { fromBase64, packBits, toBase64, unpackBits } from "../geometry/bits";
import type { Field as Picture, Refusal, Scan as Readings } from "../messages";
import {
  RECORDING, type Action, type Buffers, type Connection, type Field, type Layer, type Limits, type MapDocument, type Notice, type Overlay, type Pair,
  type Quantity, type Scan, type Sent, type Stage, type State, type Transport, type View,
} from "../protocol";
import { forget, keep } from "./kept";
import { FORESEEN, foresee, needsServer, NO_SERVER, type Foreseen } from "./foreseen";
import { Decisions } from "./decisions";
import { Evidence } from "./evidence";
import { Flicker } from "./flicker";
import { Ghost } from "./ghost";
import { Latency } from "./latency";
import { Progress } from "./progress";
import { Reading } from "./reading";
import { Telling } from "./story";
import { Status, type Level } from "./status";
import { Where } from "./where";

const QUESTIONS = new Set<Action["type"]>(["inspect", "path", "views", "where", "ghost", "beam"]);

/** It changes by `receive` and `act`, and calls `changed` after. */
export class Session {
  connection: Connection = { connected: false };
  everConnected = false;
  /** The document with the edits that are on their way. */
  document: MapDocument | null = null;
  /** (nx, ny), one byte a cell, with the same edits; `wallsVersion` counts its changes. */
  walls: Uint8Array = new Uint8Array(0);
  wallsVersion = 0;
  view: View = { layer: "mean", chain: 0, draw: null };
  state: State | null = null;
  scan: Scan | null = null;
  overlay: Overlay | null = null;
  /** The field on the canvas. */
  shown: Field | null = null;
  /** Of the trajectory that was inferred last. */
  private lastStage: Stage | null = null;
  worker = "starting";
  /** Of what can be set, as the server has them. */
  limits: Limits | null = null;
  /** Whether the page plays a recording. */
  recorded = false;
  /** Whether the page samples by itself, without a server. */
  figure = false;
  /** Layers for which a recording has no numbers. */
  lacks: Layer[] = [];
  /** The newest generation that was seen. */
  generation = -1;
  /** Number of the last message that changes something. */
  acted = 0;
  readonly decisions = new Decisions(this);
  readonly evidence = new Evidence(this);
  readonly where = new Where(this);
  readonly ghost = new Ghost(this);
  readonly reading = new Reading(this);
  readonly flicker = new Flicker(this);
  readonly telling = new Telling(this);
  readonly status = new Status();
  readonly progress = new Progress();
  readonly latency = new Latency();
  readonly counts = { paints: 0, stale: 0 };
  ondownload: (name: string, mime: string, data: Uint8Array) => void = () => {};

  private seq = 0;
  private next: Field | null = null;
  private pending: Sent[] = [];
  /** The last generation whose painting was reported. */
  private reported = -1;
  private confirmedWalls = { text: "", walls: this.walls };
  private wallsAhead = false;
  /** Number of the last hello that brought a document. */
  private broughtAt: number | null = null;
  private packed = { version: -1, text: "" };

  /** `adopt` is a document to adopt on connecting, `notice` what to say then. */
  constructor(
    readonly transport: Transport,
    readonly changed: () => void,
    private readonly adopt: MapDocument | null = null,
    private readonly notice: { text: string; level: Level } | null = null,
  ) {
    transport.onmessage = (message, buffers) => this.receive(message, buffers);
    transport.onstatus = (connection) => this.onstatus(connection);
  }

  get shape(): Pair {
    return this.document ? this.document.grid.shape : [1, 1];
  }
  get editable() {
    return !this.recorded && this.document?.source.kind === "simulation";
  }
  /** Whether there is a server that answers questions about the posterior. */
  get answers() {
    return !this.recorded && !this.figure;
  }
  /** Whether scans are located: by the server, or in the page. */
  get locates() {
    return this.answers || this.figure;
  }
  get running() {
    return this.connection.connected && Boolean(this.state?.running);
  }
  /** Whether the picture is to change yet. */
  get working() {
    return this.connection.connected && Boolean(this.state?.working);
  }
  /** What the colours on show are; before there are draws or intervals, the mean stands for them. */
  get layer(): Layer {
    if (this.where.map) return "mean";
    const own = this.shown?.layer;
    return own === "draw" || own === "width" ? own : this.view.layer === "entropy" ? "entropy" : "mean";
  }
  /** The field whose colours the cells have: a known map, the mean under a draw, or what was sent last. */
  get picture(): Field | null {
    return this.where.map ?? this.flicker.under ?? this.shown;
  }
  /** How far the trajectory is that is being inferred. */
  get stage() {
    return this.running && this.shown?.method === "counts" ? this.lastStage : null;
  }
  /** Whether the poses on show are somewhere between odometry and the trajectory: it was cancelled on the way. */
  get halfway() {
    return this.lastStage?.generation === this.shown?.generation;
  }
  get draws() {
    return this.state?.draws ?? { chains: 0, count: 0 };
  }
  /** Whether there is a chain on show, and it goes on. */
  get sampling() {
    const field = this.shown;
    return Boolean(field && !field.approximate && field.sweeps < field.total && this.working);
  }
  /** Why Run would change nothing; empty where it would. */
  get nothingToRun() {
    const { document, shown, working } = this;
    const ended = shown?.method === "propagate" && shown.generation === this.generation && !working;
    const propagates = document?.method === "propagate" && document.cells === "binary" && document.poses === "logged";
    return ended && propagates ? "Belief propagation is done and has no sweeps to add; choose Gibbs to sample maps" : "";
  }
  /** The draw on show, from 0. */
  get draw() {
    const last = Math.max(0, this.draws.count - 1);
    return Math.min(last, this.view.draw ?? (this.shown?.layer === "draw" ? (this.shown.draw ?? last) : last));
  }
  get hasDraws() {
    return this.draws.count > 0 || (!this.recorded && /auto|gibbs|block/.test(this.document?.method ?? ""));
  }

  say(text: string, level: Level = "info") {
    this.status.say(text, level, this.acted);
    this.changed();
  }

  /** Sends an action; its effect shows at once. The pointer event that it came from is timed until its picture. */
  act(action: Action, event?: Event) {
    if (!this.document && action.type !== "hello") return;
    if (!this.connection.connected && this.everConnected && !QUESTIONS.has(action.type) && needsServer(action)) return this.say(NO_SERVER, "warning");
    if (action.type === "run" && this.nothingToRun) return this.say(this.nothingToRun);
    const sent = { ...action, seq: ++this.seq };
    if (!QUESTIONS.has(action.type)) this.acted = this.seq; // a question changes nothing, and no state confirms it
    if (FORESEEN.has(action.type)) {
      this.pending.push(sent);
      this.foresee(sent);
    }
    if (event) this.latency.sent(sent.seq, event);
    if (this.connection.connected) this.transport.send(sent);
    else if (this.everConnected) keep(this.portableDocument());
    this.changed();
  }

  /** Says hello, with a document for the server to adopt where there is one. */
  bring(document: MapDocument | null) {
    this.act(document ? { type: "hello", document } : { type: "hello" });
    this.broughtAt = document ? this.seq : null;
  }

  /** The document as it is shown, edits included. */
  effectiveDocument(): MapDocument | null {
    if (this.packed.version !== this.wallsVersion) {
      this.packed = { version: this.wallsVersion, text: toBase64(packBits(this.walls)) };
    }
    return this.document && { ...this.document, walls: this.packed.text };
  }

  /** The same as it travels: of a file's map the server has the cells. */
  portableDocument(): MapDocument | null {
    const whole = this.effectiveDocument();
    return whole && (whole.source.kind === "simulation" ? whole : { ...whole, walls: "" });
  }

  /** Takes the newest field for painting: whether there is one. */
  take() {
    if (!this.next || !this.document) return false; // a field of a running chain may come before the first state
    this.shown = this.next;
    this.next = null;
    this.flicker.take(this.shown);
    return true;
  }

  /** The field on show is on the canvas now. */
  painted() {
    this.counts.paints++;
    const { generation } = this.shown ?? this;
    this.latency.painted(generation);
    if (generation > this.reported && !this.recorded) this.transport.send({ type: "painted", generation });
    this.reported = generation;
    for (const asking of [this.decisions, this.ghost, this.evidence]) asking.ask();
  }

  /** What the numbers of the map are. */
  get quantity(): Quantity {
    return this.shown?.quantity ?? { kind: "binary", mean: "P(wall)", value: "wall", interval: false };
  }

  /** Seconds until the chain on show is done, or null where nothing can be said. */
  remaining_s() {
    return this.shown && this.sampling ? this.progress.remaining_s(this.shown) : null;
  }

  private onstatus(connection: Connection) {
    const wasConnected = this.connection.connected;
    this.connection = connection;
    if (connection.connected) {
      // on a reconnection the document goes back to the server, with what was edited meanwhile
      const document = this.everConnected ? this.portableDocument() : this.adopt;
      this.pending = [];
      this.latency.forget();
      this.bring(document);
      if (this.view.layer !== "mean" && this.document) this.act({ type: "view", ...this.view });
      if (this.everConnected) this.say("Connected again");
      else if (this.notice) this.say(this.notice.text, this.notice.level);
      this.everConnected = true;
    } else if (this.everConnected) {
      if (wasConnected) this.say("Connection lost", "error"); // each try to connect again comes here, too
      keep(this.portableDocument());
    }
    this.changed();
  }

  private receive(notice: Notice, buffers: Buffers) {
    switch (notice.type) {
      case "welcome":
        this.generation = this.reported = -1;
        this.limits = notice.limits;
        this.recorded = notice.recorded;
        this.figure = notice.figure;
        this.lacks = notice.lacks;
        this.telling.story = notice.story ?? null;
        this.latency.forget();
        this.next = null;
        break;
      case "state":
        this.receiveState(notice);
        break;
      case "scan":
        if (notice.generation >= this.generation) this.receiveScan(notice, buffers);
        break;
      case "overlay":
        this.overlay = buffers as unknown as Overlay;
        break;
      case "field":
        this.receiveField(notice, buffers);
        break;
      case "stage":
        this.lastStage = notice;
        break;
      case "where":
        this.where.receive(notice, buffers);
        break;
      case "cell":
        this.evidence.receive(notice, buffers);
        break;
      case "path":
      case "views":
        this.decisions.receive(notice, buffers);
        break;
      case "ghost":
        this.ghost.receive(notice, buffers);
        break;
      case "beam":
        this.reading.receive(notice);
        break;
      case "undecided":
        if (notice.question === "ghost") this.ghost.receive(notice, buffers);
        else if (notice.question === "beam") this.reading.receive(notice);
        else this.decisions.receive(notice, buffers);
        break;
      case "status":
        this.status.say(notice.text, notice.level, this.acted);
        break;
      case "error":
        this.receiveRefusal(notice);
        break;
      case "worker":
        this.worker = notice.state;
        this.where.forget();
        this.status.worker(notice.state);
        break;
      case "download":
        this.ondownload(notice.name, notice.mime, buffers.data as Uint8Array);
        this.status.say(notice.name === RECORDING ? "Kept beside" : `Saved ${notice.name}${notice.note && `, ${notice.note}`}`, "info", this.acted);
        break;
    }
    this.changed();
  }

  private receiveScan({ ids, index }: Readings, { pose, angles, ranges, exact, hit }: Buffers) {
    if (this.scan?.index !== index) this.reading.forget();
    this.scan = { ids, index, pose, angles, ranges, exact, hit };
  }

  private receiveRefusal({ seq, text, remedy }: Refusal) {
    const brought = seq !== null && seq === this.broughtAt;
    if (brought) {
      // the document that this page brought is none: it takes the server's
      this.broughtAt = null;
      this.act({ type: "hello" });
    }
    const why = [text, remedy].filter(Boolean).join("; ");
    this.status.say(brought ? `The map that was brought along cannot be shown: ${why}` : why, "error", this.acted);
    this.pending = this.pending.filter((edit) => edit.seq !== seq);
    if (seq !== null) this.latency.refused(seq);
    this.rebuild();
  }

  private receiveState(state: State) {
    this.status.confirmed(state.seq);
    this.state = state;
    if (state.document.source.kind === "simulation") {
      this.overlay = null; // of the file that was shown before
      forget(); // the server has the map now; one that shows a file did not take it
    }
    this.generation = Math.max(this.generation, state.generation);
    this.latency.confirmed(state.generation, state.seq);
    this.pending = this.pending.filter((edit) => edit.seq > state.seq);
    this.rebuild();
  }

  private receiveField(picture: Picture, buffers: Buffers) {
    if (picture.generation < this.generation) {
      this.counts.stale++;
      return;
    }
    this.generation = picture.generation;
    const p = buffers.p as Uint8Array;
    const { trace, traced, weights } = buffers as { [name: string]: Float32Array };
    const old = this.next ?? this.shown;
    const now = buffers.reached as Uint8Array;
    // most frames of a chain see the same cells
    const reached = old && old.p.length === p.length && old.reached.every((share, i) => share === now[i]) ? old.reached : now;
    this.next = { ...picture, p, trace, traced, weights, reached };
    this.progress.hear(this.next);
  }

  /** The document as confirmed, and on it the edits that are on their way. */
  private rebuild() {
    if (!this.state) return;
    const { document } = this.state;
    const [nx, ny] = document.grid.shape;
    const confirmed = this.confirmedWalls;
    if (document.walls !== confirmed.text || confirmed.walls.length !== nx * ny) {
      this.confirmedWalls = { text: document.walls, walls: unpackBits(fromBase64(document.walls), nx * ny) };
    }
    this.document = { ...document, sensors: document.sensors.map((sensor) => ({ ...sensor })) };
    if (this.confirmedWalls !== confirmed || this.wallsAhead) {
      this.walls = this.confirmedWalls.walls.slice();
      this.wallsVersion++;
      this.wallsAhead = false;
    }
    if (!this.pending.some((edit) => edit.type === "view")) {
      const { layer, chain, draw } = this.state.view;
      this.view = { layer, chain: chain ?? 0, draw };
    }
    for (const edit of this.pending) this.foresee(edit);
  }

  private foresee(edit: Action) {
    if (!this.document || !this.state) return;
    foresee(this as Foreseen, edit);
    if (edit.type === "walls") {
      this.wallsVersion++;
      this.wallsAhead = true;
    }
  }
}
