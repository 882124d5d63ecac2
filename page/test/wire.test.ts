import { browser, keptElsewhere } from "./dom";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { mock, test } from "node:test";
import { fromFragment, takeFragment, toFragment } from "../src/fragment";
import { fromBase64, packBits } from "../src/geometry/bits";
import type { Action, Buffers, Connection, Field, MapDocument, Notice, Recording } from "../src/protocol";
import { Beside } from "../src/state/beside";
import { forget, keep, keptDocument, keepToken, onToken } from "../src/state/kept";
import { unpackFrame, type WithBuffers } from "../src/transport/frame";
import { readRecording, recordedTransport } from "../src/transport/recorded";
import { webSocketTransport } from "../src/transport/socket";
import { widgetTransport, type Model } from "../src/transport/widget";
import { aDocument, Desk, LIMITS, LOG, wallsOf, type Message } from "./desk";

/** What the library says, where its tests run these (tests/app/test_page_build.py). */
const file = process.env.BAYESMAP_LIBRARY;
const library = file ? JSON.parse(readFileSync(file, "utf8")) : null;
const withoutLibrary = "run by pytest, this is compared with the library";

/** A frame as docs/app.md says. */
function framed(message: object, ...buffers: Uint8Array[]) {
  const header = new TextEncoder().encode(JSON.stringify(message).padEnd(8 * Math.ceil((JSON.stringify(message).length + 4) / 8) - 4));
  const sizes = buffers.map((buffer) => Math.ceil(buffer.length / 8) * 8);
  const bytes = new Uint8Array(4 + header.length + sizes.reduce((a, b) => a + b, 0));
  new DataView(bytes.buffer).setUint32(0, header.length, true);
  bytes.set(header, 4);
  let at = 4 + header.length;
  buffers.forEach((buffer, i) => {
    bytes.set(buffer, at);
    at += sizes[i];
  });
  return bytes.buffer;
}

test("a frame's buffers are found by name, of their type, whatever their sizes", () => {
  const buffers = [
    { name: "p", dtype: "uint8", shape: [3, 1] },
    { name: "pose", dtype: "float64", shape: [1, 3] },
    { name: "none", dtype: "float32", shape: [0] },
    { name: "ranges", dtype: "float32", shape: [2] },
  ];
  const ranges = Float32Array.of(1.5, Infinity);
  const pose = Float64Array.of(0.1, -2, Math.PI);
  const [message, found] = unpackFrame(framed({ type: "field", generation: 7, buffers }, Uint8Array.of(1, 2, 255), new Uint8Array(pose.buffer), new Uint8Array(0), new Uint8Array(ranges.buffer)));
  assert.equal((message as Message).generation, 7);
  assert.deepEqual(found, { p: Uint8Array.of(1, 2, 255), pose, none: new Float32Array(0), ranges });
});

test("the library's frame, its links and its limits are understood", async (context) => {
  if (!library) return context.skip(withoutLibrary);
  const [message, buffers] = unpackFrame(fromBase64(library.frame).buffer as ArrayBuffer);
  assert.equal(message.type, "field");
  for (const [name, values] of Object.entries<number[]>(library.buffers)) assert.deepEqual(Array.from(buffers[name]), values, name);
  assert.deepEqual(await fromFragment(library.fragment), library.document);
  assert.deepEqual(library.limits, LIMITS); // those that the other tests have
});

test("an exported page says so where a browser is too old to unpack it", () => {
  const page = readFileSync("../src/bayesmap/app/static/one_file.html", "utf8");
  const [, script] = /<script>([^]*?)<\/script>/.exec(page)!;
  for (const [window, words] of [[{}, /^This page needs a newer browser: Safari 16\.4/], [{ DecompressionStream: class {} }, /^$/]] as const) {
    const host = { textContent: "" };
    new Function("window", "document", script)(window, { querySelector: () => host });
    assert.match(host.textContent, words);
  }
});

test("a link holds the document, and is read back from the address and taken off it", async () => {
  const document = aDocument({ prior: 0.375 });
  const link = await toFragment(document);
  assert.match(link, /^#m=[\w-]+$/);
  assert(link.length < 1000);
  assert.deepEqual(await fromFragment(link), document);
  assert.equal(await fromFragment(""), null);
  assert.equal(await fromFragment("#other"), null);
  location.hash = link;
  assert.deepEqual(await takeFragment(), { document, damaged: false });
  assert.equal(location.hash, "");
  assert.deepEqual(await takeFragment(), { document: null, damaged: false });
});

test("a damaged link is said to be one", async () => {
  const whole = await toFragment(aDocument());
  for (const damaged of ["#m=nonsense", "#m=eyJ2ZXJzaW9uIjoxfQ", "#m=", whole.slice(0, -9)]) {
    location.hash = damaged;
    assert.deepEqual(await takeFragment(), { document: null, damaged: true }, damaged);
  }
  location.hash = "";
});

test("a drawn map is kept while the connection is lost, and a file's map and a page in one file are not", () => {
  keep(aDocument(LOG));
  assert.equal(keptDocument(), null);
  Object.assign(location, { protocol: "file:" });
  keep(aDocument());
  assert.equal(keptDocument(), null);
  Object.assign(location, { protocol: "http:" });
  keep(aDocument());
  assert.deepEqual(keptDocument(), aDocument());
  forget();
  assert.equal(keptDocument(), null);
  browser.kept.set("bayesmap-kept", "{");
  assert.equal(keptDocument(), null);
  forget();
});

test("another tab's token is told, and what else it keeps is not", () => {
  const told: string[] = [];
  const end = onToken((token) => told.push(token));
  keepToken("first");
  assert.equal(browser.kept.get("bayesmap-token"), "first");
  keepToken(null);
  assert.equal(browser.kept.get("bayesmap-token"), "first");
  keptElsewhere("bayesmap-token", "second");
  keptElsewhere("bayesmap-kept", "{}");
  end();
  keptElsewhere("bayesmap-token", "third");
  assert.deepEqual(told, ["second"]);
});

/** A line that opens and closes as the test says. */
class Line {
  static readonly OPEN = 1;
  static all: Line[] = [];
  readyState = 0;
  binaryType = "";
  readonly sent: string[] = [];
  onopen = () => {};
  onclose = () => {};
  onmessage: (event: { data: unknown }) => void = () => {};
  constructor(readonly url: URL) {
    Line.all.push(this);
  }
  send(text: string) {
    this.sent.push(text);
  }
  close() {
    this.readyState = 3;
    this.onclose();
  }
  open() {
    this.readyState = 1;
    this.onopen();
  }
}

/** The transport of a server, and what it told. */
function connected(answer: number | null = null) {
  Line.all = [];
  const asked: string[] = [];
  const fetch = async (address: string) => {
    asked.push(address);
    if (answer === null) throw new Error("nobody is there");
    return { status: answer };
  };
  Object.assign(globalThis, { WebSocket: Line, fetch });
  const statuses: Connection[] = [];
  const messages: [Message, Buffers][] = [];
  const transport = webSocketTransport(() => new URL("http://127.0.0.1:8000/?token=abc"));
  Object.assign(transport, { onstatus: (status: Connection) => statuses.push(status), onmessage: (...message: [Message, Buffers]) => messages.push(message) });
  transport.open();
  return { transport, statuses, messages, asked };
}

test("the socket is the page's own server's, with its token, and carries text and frames", () => {
  const { transport, statuses, messages } = connected();
  const [line] = Line.all;
  assert.equal(String(line.url), "ws://127.0.0.1:8000/socket?token=abc");
  transport.send({ type: "run", seq: 1 });
  assert.deepEqual(line.sent, []);
  line.open();
  assert.deepEqual(statuses, [{ connected: true }]);
  transport.send({ type: "hello", seq: 1 });
  assert.deepEqual(line.sent.map((text) => JSON.parse(text)), [{ type: "hello", seq: 1 }]);
  line.onmessage({ data: '{"type":"welcome"}' });
  line.onmessage({ data: framed({ type: "field", buffers: [{ name: "p", dtype: "uint8", shape: [1] }] }, Uint8Array.of(9)) });
  assert.deepEqual(messages.map(([{ type }]) => type), ["welcome", "field"]);
  assert.deepEqual(messages[1][1].p, Uint8Array.of(9));
});

test("a lost line is tried again, each time after twice as long, at most eight seconds; a click tries at once", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  try {
    const { transport, statuses } = connected();
    Line.all[0].open();
    const waits = [250, 500, 1000, 2000, 4000, 8000, 8000];
    for (const wait of waits) {
      const before = Line.all.length;
      Line.all.at(-1)!.close();
      assert.deepEqual(statuses.at(-1), { connected: false, retryIn_ms: wait });
      mock.timers.tick(wait - 1);
      assert.equal(Line.all.length, before);
      mock.timers.tick(1);
      assert.equal(Line.all.length, before + 1);
    }
    Line.all.at(-1)!.close();
    const before = Line.all.length;
    transport.retry!();
    assert.equal(Line.all.length, before + 1);
    Line.all.at(-1)!.open();
    transport.retry!(); // there is nothing to try
    assert.equal(Line.all.length, before + 1);
    Line.all.at(-1)!.close();
    assert.equal(statuses.at(-1)!.retryIn_ms, 250); // from the beginning again
    transport.close();
    mock.timers.tick(60_000);
    assert.equal(Line.all.length, before + 1);
  } finally {
    mock.timers.reset();
  }
});

test("a server that is there and refuses the token is told from one that is not there", async () => {
  for (const [answer, refused] of [[403, true], [200, undefined], [null, undefined]] as const) {
    const { transport, statuses, asked } = connected(answer);
    Line.all[0].close();
    await new Promise((done) => setTimeout(done, 1));
    assert.deepEqual(asked, ["/?token=abc"]);
    assert.equal(statuses.at(-1)!.refused, refused);
    transport.close();
  }
});

test("a notebook's kernel sends buffers beside their message", () => {
  let listener: ((message: WithBuffers, views: DataView[]) => void) | null = null;
  const sent: Action[] = [];
  const model: Model = { on: (_, listen) => (listener = listen), off: () => (listener = null), send: (message) => sent.push(message) };
  const transport = widgetTransport(model);
  const heard: [Notice, Buffers][] = [];
  const statuses: Connection[] = [];
  Object.assign(transport, { onmessage: (...message: [Notice, Buffers]) => heard.push(message), onstatus: (status: Connection) => statuses.push(status) });
  transport.open();
  assert.deepEqual(statuses, [{ connected: true }]);
  const bytes = new Uint8Array(24);
  new Float32Array(bytes.buffer, 8, 2).set([1.5, -2]);
  listener!({ type: "scan", buffers: [{ name: "ranges", dtype: "float32", shape: [2] }] } as WithBuffers, [new DataView(bytes.buffer, 8, 8)]);
  listener!({ type: "status", text: "x", level: "info" }, []);
  assert.deepEqual(heard.map(([, buffers]) => buffers), [{ ranges: Float32Array.of(1.5, -2) }, {}]);
  transport.send({ type: "run" });
  assert.deepEqual(sent, [{ type: "run" }]);
  transport.close();
  assert.equal(listener, null);
});

/** What a recording answers to some actions. */
function played(recording: [Recording, Buffers], ...asked: Action[]) {
  const heard: [Message, Buffers][] = [];
  const transport = recordedTransport(recording);
  Object.assign(transport, { onmessage: (...message: [Notice, Buffers]) => heard.push(message) });
  transport.open();
  transport.send({ type: "hello", seq: 1 });
  const first = heard.splice(0);
  asked.forEach((action, i) => transport.send({ ...action, seq: i + 2 }));
  return { first, heard };
}

const SMALL: MapDocument = aDocument({ grid: { shape: [3, 2], resolution: 1, origin: [0, 0] }, walls: wallsOf([[2, 0]], [3, 2]), sensors: [{ id: 1, x: 0.5, y: 0.5, yaw: 0 }], angles: 2 });
const FIELD = { type: "field", generation: 1, layer: "mean", method: "gibbs", sweeps: 30, total: 30, ess: 12, log_joint: -6, quantity: { kind: "binary" }, burned: 0, about: [], draws: { chains: 2, count: 3 } } as unknown as Field;

/** Two chains of three draws of six cells: draw d of chain c has walls in the cells below c + d. */
function recording(changes: Partial<Recording> = {}, buffers: Buffers = {}): [Recording, Buffers] {
  const draws = [0, 1, 2, 1, 2, 3].flatMap((walls) => [...packBits(Uint8Array.from({ length: 6 }, (_, cell) => Number(cell < walls)))]);
  const known = {
    p: Uint8Array.of(0, 51, 102, 153, 204, 255), reached: Uint8Array.of(255, 255, 255, 0, 0, 255), beams: Uint32Array.of(2, 1, 0, 1, 0, 0), draws: Uint8Array.from(draws),
    trace: Float32Array.of(-9, -8), traced: Float32Array.of(1), pose: Float64Array.of(0.5, 0.5, 0), angles: Float32Array.of(0, 1.5), ranges: Float32Array.of(1.5, Infinity),
    exact: Float32Array.of(1.4, Infinity), hit: Uint8Array.of(1, 0),
  };
  const whole = { version: 1, document: SMALL, field: FIELD, ids: [1], draws: { chains: 2, count: 3, kept: 30, bits: true }, log_joint: [[-9, -8, -7], [-6, -5, -4]], ...changes } as Recording;
  return [whole, { ...known, ...buffers }];
}

test("a recording says hello as a session does, and passes on what the session said", () => {
  const { first } = played(recording());
  assert.deepEqual(first.map(([{ type }]) => type), ["welcome", "state", "scan", "field"]);
  const [[welcome], [state], [scan, rays], [field, { p, reached, trace, traced }]] = first;
  assert(welcome.recorded && !state.running && !state.can_undo);
  assert.deepEqual([state.draws, welcome.lacks], [{ chains: 2, count: 3 }, ["width"]]);
  const [, { pose, angles, ranges, exact, hit, ...known }] = recording();
  assert.deepEqual([scan.ids, scan.index, rays], [[1], null, { pose, angles, ranges, exact, hit }]);
  assert.deepEqual([field, { p, reached, trace, traced }], [FIELD, { p: known.p, reached: known.reached, trace: known.trace, traced: known.traced }]);
});

test("a result that is kept shows the layer, the chain and the draw of the one beside it", () => {
  const desk = new Desk();
  const beside = new Beside(desk.session);
  const shown = () => {
    beside.follow();
    const { layer, chain, draw, p } = beside.kept!.shown!;
    return { layer, cells: [...p].filter(Boolean).length, ...(layer === "draw" ? { chain, draw } : {}) };
  };
  beside.follow(); // nothing is kept
  beside.keep();
  assert.deepEqual(desk.asked("export"), [{ type: "export", what: "recording" }]);
  beside.receive(recording({ field: { ...FIELD, about: [["method", "blocks"], ["prior", "0.5"]] } as unknown as Recording["field"] }));
  assert.deepEqual(shown(), { layer: "mean", cells: 5 });
  desk.state({ draws: { chains: 4, count: 30 } });
  desk.field({ about: [["method", "single cells"], ["prior", "0.5"]] });
  assert.deepEqual(beside.differences(), ["method single cells", "method blocks"]);
  desk.field({ about: [["prior", "0.5"]] });
  assert.deepEqual(beside.differences(), ["the same model and method", "method blocks"]);
  for (const [draw, kept] of [[0, 0], [14, 1], [29, 2]]) {
    desk.player.showDraw(draw, 1); // three of 30 draws were kept
    assert.deepEqual(shown(), { layer: "draw", chain: 1, draw: kept, cells: 1 + kept });
  }
  desk.player.showDraw(29, 3); // there are two chains
  assert.deepEqual(shown(), { layer: "draw", chain: 1, draw: 2, cells: 3 });
  desk.player.showLayer("entropy");
  assert.deepEqual([shown().layer, beside.kept!.layer], ["entropy", "entropy"]);
  beside.forget();
  assert.equal(beside.kept, null);
});

test("each draw of a recording is that chain's that draw, of walls and of numbers", () => {
  const views = [0, 1].flatMap((chain) => [0, 1, 2].map((draw) => ({ type: "view", layer: "draw", chain, draw }) as const));
  const { heard } = played(recording(), ...views, { type: "view", layer: "draw", chain: 0 }, { type: "view", layer: "entropy" });
  const fields = heard.filter(([{ type }]) => type === "field");
  views.forEach(({ chain, draw }, i) => {
    const [message, { p }] = fields[i];
    assert.deepEqual([message.layer, message.chain, message.draw], ["draw", chain, draw]);
    assert.deepEqual([...p], Array.from({ length: 6 }, (_, cell) => (cell < chain + draw ? 255 : 0)));
    assert.equal(message.log_joint, [[-9, -8, -7], [-6, -5, -4]][chain][draw]);
  });
  assert.equal(fields[6][0].draw, 2); // without a number the last
  assert.equal(fields[7][0].layer, "entropy");
  assert.deepEqual([...fields[7][1].p], [0, 51, 102, 153, 204, 255]); // of the mean, made by the page
  const numbers = recording({ draws: { chains: 1, count: 2, kept: 2, bits: false } }, { draws: Uint8Array.from({ length: 12 }, (_, i) => i), width: Uint8Array.of(9, 9, 9, 9, 9, 9) });
  const shown = played(numbers, { type: "view", layer: "draw", chain: 0, draw: 1 }, { type: "view", layer: "width" }).heard.filter(([{ type }]) => type === "field");
  assert.deepEqual(shown.map(([{ layer }, { p }]) => [layer, ...p]), [["draw", 6, 7, 8, 9, 10, 11], ["width", 9, 9, 9, 9, 9, 9]]);
});

test("of a file's recording one scan is shown at a time, with its trajectory; of scans left out the nearest", () => {
  const buffers = {
    pose: Float64Array.of(0.5, 0.5, 0, 1.5, 0.5, 1), angles: Float32Array.of(0, 1, 2, 3), ranges: Float32Array.of(1, 2, 3, Infinity), exact: new Float32Array(0),
    hit: Uint8Array.of(1, 1, 1, 0), strokes: new Float32Array(0), trajectory: Float32Array.of(0.5, 0.5, 1.5, 0.5),
  };
  const document = { ...SMALL, source: { kind: "run", name: "run.nc", scans: 9, bounds: null } as const };
  const { first, heard } = played(recording({ ids: [1, 9], document }, buffers), { type: "scan", index: 6 });
  assert.deepEqual(first.find(([{ type }]) => type === "overlay")![1].trajectory, buffers.trajectory);
  const [[before, at], [after, then]] = [...first, ...heard].filter(([{ type }]) => type === "scan");
  assert.deepEqual([before.index, after.index], [0, 8]);
  assert.deepEqual([[...at.ranges], [...then.ranges], [...then.hit], [...then.pose], [...then.angles]], [[1, 2], [3, Infinity], [1, 0], [1.5, 0.5, 1], [2, 3]]);
  const same = played(recording({ ids: [1, 9], document }, { ...buffers, angles: Float32Array.of(0, 1) }), { type: "scan", index: 8 }).heard.find(([{ type }]) => type === "scan")!;
  assert.deepEqual([...same[1].angles], [0, 1]);
});

test("a recording without draws shows its mean where a draw is asked for", () => {
  const { first, heard } = played(recording({ draws: { chains: 0, count: 0, kept: 0, bits: false }, log_joint: [] }), { type: "view", layer: "draw", chain: 0 });
  const [field, { p }] = heard.find(([{ type }]) => type === "field")!;
  assert.deepEqual([field.layer, p[5], field.method, first[0][0].lacks], ["mean", 255, "gibbs", ["draw", "width"]]);
});

test("the beams through a cell of a recording are those that the session counted", () => {
  const cells = [[0, 0], [0, 1], [1, 0], [1, 1]];
  const { heard } = played(recording(), ...cells.map(([x, y]) => ({ type: "inspect", x, y }) as const));
  assert.deepEqual(heard.map(([{ beams }]) => beams), [2, 1, 0, 1]);
});

test("the tutorial's page plays", async (context) => {
  if (!library) return context.skip(withoutLibrary);
  const html = readFileSync(library.tutorial, "utf8");
  const found = await readRecording(/<script[^>]*data-recording[^>]*>(.*?)<\/script>/s.exec(html)![1]);
  const { first, heard } = played(found, { type: "view", layer: "draw", chain: 0 });
  const field = first.find(([{ type }]) => type === "field")!;
  assert.equal(field[0].sweeps, 1000);
  assert.equal(field[1].p.length, 441);
  const draw = heard.find(([{ type }]) => type === "field")![1].p;
  assert.deepEqual([...new Set(draw)].sort(), [0, 255]);
});
