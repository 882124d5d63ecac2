import { browser } from "./dom";
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Action, Field, Pair } from "../src/protocol";
import { Latency } from "../src/state/latency";
import { Progress } from "../src/state/progress";
import { Status } from "../src/state/status";
import { Desk, aDocument, LOG, wallsOf } from "./desk";

const WALLS: Pair[] = [[12, 4], [12, 5]];

test("an edit shows before it is confirmed, and once it is, what the server says holds", () => {
  const desk = new Desk();
  desk.session.act({ type: "walls", cells: [[3, 3], [3, 4]], wall: true, stroke: 1 });
  assert.deepEqual(desk.walls, [[3, 3], [3, 4], ...WALLS]);
  assert.deepEqual(desk.session.effectiveDocument()!.walls, wallsOf([[3, 3], [3, 4], ...WALLS]));
  desk.confirm({ walls: wallsOf([[3, 3], ...WALLS]) }); // it took but one of them
  assert.deepEqual(desk.walls, [[3, 3], ...WALLS]);
});

test("edits that are on their way stay on top of a state that does not hold them yet", () => {
  const desk = new Desk();
  desk.session.act({ type: "walls", cells: [[3, 3]], wall: true, stroke: 1 });
  const first = desk.session.acted;
  desk.session.act({ type: "set", patch: { prior: 0.2, resolution: 3 } });
  desk.session.act({ type: "move_sensor", id: 1, x: 8, y: 9, yaw: 1 });
  desk.session.act({ type: "walls", cells: [[12, 4]], wall: false, stroke: 2 });
  desk.confirm({ walls: wallsOf([[3, 3], ...WALLS]) }, { seq: first });
  assert.deepEqual(desk.walls, [[3, 3], [12, 5]]);
  assert.equal(desk.session.document!.prior, 0.2);
  assert.equal(desk.session.document!.grid.resolution, 1); // another grid is the server's to make
  assert.deepEqual(desk.session.document!.sensors, [{ id: 1, x: 8, y: 9, yaw: 1 }]);
  assert.equal(desk.session.state!.document.prior, 0.5); // nothing of it was said by the server
  desk.confirm({ prior: 0.2, walls: wallsOf([[3, 3], [12, 5]]), sensors: [{ id: 1, x: 8, y: 9, yaw: 1 }] });
  assert.deepEqual(desk.walls, [[3, 3], [12, 5]]);
});

test("an edit that is refused is taken back, and why is said with its remedy", () => {
  const desk = new Desk();
  desk.session.act({ type: "move_sensor", id: 1, x: 12, y: 5, yaw: 0 });
  const refused = desk.session.acted;
  desk.session.act({ type: "walls", cells: [[3, 3]], wall: true, stroke: 1 });
  desk.says("error", { text: "sensor 1 stands in a wall", remedy: "choose a free cell", seq: refused });
  assert.deepEqual(desk.session.document!.sensors[0].x, 10);
  assert.deepEqual(desk.walls, [[3, 3], ...WALLS]); // the other is still on its way
  assert.equal(desk.status, "Sensor 1 stands in a wall; choose a free cell");
  assert.equal(desk.session.status.level, "error");
  desk.says("error", { text: "too many", seq: desk.session.acted });
  assert.deepEqual(desk.walls, WALLS);
});

test("the walls' version counts what changes them, and nothing else", () => {
  const desk = new Desk();
  const counted = (action: () => void) => {
    const before = desk.session.wallsVersion;
    action();
    return desk.session.wallsVersion - before;
  };
  assert.equal(counted(() => desk.session.act({ type: "set", patch: { prior: 0.1 } })), 0);
  assert.equal(counted(() => desk.confirm({ prior: 0.1 })), 0);
  assert(counted(() => desk.session.act({ type: "walls", cells: [[3, 3]], wall: true, stroke: 1 })) > 0);
  assert(counted(() => desk.confirm({ walls: wallsOf([[3, 3], ...WALLS]) })) > 0);
  assert.equal(counted(() => desk.state({})), 0);
});

test("a picture of an older generation is never shown, and of several that wait only the newest", () => {
  const desk = new Desk();
  const old = desk.session.generation;
  desk.confirm({ prior: 0.1 });
  desk.field({ generation: old, sweeps: 5 });
  assert.equal(desk.session.counts.stale, 1);
  assert.equal(desk.session.shown!.sweeps, 1000);
  const paints = desk.session.counts.paints;
  desk.field({ sweeps: 1 }, { paint: false });
  desk.field({ sweeps: 2 }, { paint: false });
  desk.paint();
  assert.deepEqual([desk.session.shown!.sweeps, desk.session.counts.paints - paints], [2, 1]);
  desk.paint();
  assert.equal(desk.session.counts.paints - paints, 1);
});

test("the first picture of each generation is reported, once", () => {
  const desk = new Desk();
  desk.sent.length = 0;
  desk.confirm({ prior: 0.1 });
  for (let i = 0; i < 3; i++) desk.field({ sweeps: i });
  assert.deepEqual(desk.asked("painted"), [{ type: "painted", generation: desk.session.generation }]);
});

test("readings of an older generation are not taken", () => {
  const desk = new Desk();
  const scan = (generation: number, x: number) =>
    desk.says("scan", { generation, ids: [1] }, { pose: Float64Array.of(x, 0, 0), angles: Float32Array.of(0), ranges: Float32Array.of(1), exact: Float32Array.of(1), hit: Uint8Array.of(1) });
  scan(desk.session.generation, 4);
  desk.confirm({ prior: 0.1 });
  scan(desk.session.generation - 1, 5);
  assert.equal(desk.session.scan!.pose[0], 4);
});

test("a frame of the same cells seen shares them, and of others does not", () => {
  const desk = new Desk();
  const { reached } = desk.session.shown!;
  desk.field({ sweeps: 1 });
  assert.equal(desk.session.shown!.reached, reached);
  desk.field({ reached: new Uint8Array(441) });
  assert.deepEqual(desk.session.shown!.reached, new Uint8Array(441));
});

test("a field of a chain that comes before the first state waits for it", () => {
  const desk = new Desk({}, { connect: false });
  desk.field({}, { paint: false });
  assert.equal(desk.session.take(), false);
  desk.confirm();
  assert.equal(desk.session.take(), true);
});

test("questions change nothing: no state confirms them", () => {
  const desk = new Desk();
  const { acted } = desk.session;
  for (const type of ["inspect", "path", "views", "where", "ghost", "beam"]) desk.session.act({ type } as Action);
  assert.equal(desk.session.acted, acted);
  desk.session.act({ type: "undo" });
  assert.equal(desk.session.acted, acted + 7); // of one count with them
});

test("the view is the server's, but for one that is on its way", () => {
  const desk = new Desk();
  desk.session.act({ type: "view", layer: "draw", chain: 1, draw: 4 });
  desk.confirm({}, { seq: desk.session.acted - 1, view: { layer: "mean", chain: 0, draw: null } });
  assert.deepEqual(desk.session.view, { layer: "draw", chain: 1, draw: 4 });
  desk.confirm({}, { view: { layer: "entropy", chain: null, draw: null } });
  assert.deepEqual(desk.session.view, { layer: "entropy", chain: 0, draw: null });
});

test("what a layer's colours are: the mean stands for what is not there yet", () => {
  const desk = new Desk();
  desk.session.act({ type: "view", layer: "width" });
  assert.equal(desk.session.layer, "mean");
  desk.field({ layer: "width" });
  assert.equal(desk.session.layer, "width");
  desk.field({ layer: "mean" });
  desk.session.act({ type: "view", layer: "entropy" });
  assert.equal(desk.session.layer, "entropy");
});

test("offline, walls and settings go on and travel at reconnection; what needs the server is refused", () => {
  const desk = new Desk();
  desk.cut();
  assert.equal(desk.status, "Connection lost");
  assert.equal(desk.session.status.level, "error");
  desk.sent.length = 0;
  for (const needs of [{ type: "undo" }, { type: "run" }, { type: "add_sensor", x: 1, y: 1 }, { type: "remove_sensor", id: 1 }, { type: "export", what: "run" }]) {
    desk.session.act(needs as Action);
    assert.equal(desk.status, "Not while the connection is lost: this needs the server", JSON.stringify(needs));
  }
  desk.session.act({ type: "walls", cells: [[8, 8]], wall: true, stroke: 1 });
  desk.session.act({ type: "move_sensor", id: 1, x: 3, y: 3, yaw: 0 });
  desk.session.act({ type: "set", patch: { prior: 0.25 } });
  assert.deepEqual(desk.walls, [[8, 8], ...WALLS]);
  assert.deepEqual(desk.sent, []);
  assert.deepEqual(JSON.parse(browser.kept.get("bayesmap-kept")!).walls, wallsOf([[8, 8], ...WALLS])); // a tab may close
  desk.transport.onstatus({ connected: true });
  const [hello] = desk.asked("hello");
  assert.deepEqual([hello.document.walls, hello.document.prior, hello.document.sensors[0].x], [wallsOf([[8, 8], ...WALLS]), 0.25, 3]);
  assert.equal(desk.status, "Connected again");
  desk.says("welcome", {});
  desk.confirm({ walls: hello.document.walls });
  assert.equal(browser.kept.has("bayesmap-kept"), false); // the server has it now
});

test("of a file's map the server has the cells: settings travel alone, and nothing is kept", () => {
  const desk = new Desk(LOG);
  desk.cut();
  desk.session.act({ type: "set", patch: { prior: 0.25 } });
  assert.equal(browser.kept.has("bayesmap-kept"), false);
  desk.sent.length = 0;
  desk.transport.onstatus({ connected: true });
  const [hello] = desk.asked("hello");
  assert.deepEqual([hello.document.walls, hello.document.prior], ["", 0.25]);
});

test("a page that looked at another layer looks at it again", () => {
  const desk = new Desk();
  desk.session.act({ type: "view", layer: "entropy" });
  desk.confirm({}, { view: { layer: "entropy", chain: null, draw: null } });
  desk.cut();
  desk.sent.length = 0;
  desk.transport.onstatus({ connected: true });
  assert.deepEqual(desk.asked("view"), [{ type: "view", layer: "entropy", chain: 0, draw: null }]);
});

test("a new server's generations begin anew", () => {
  const desk = new Desk();
  for (let i = 0; i < 5; i++) desk.confirm({ prior: i / 10 });
  desk.cut();
  desk.transport.onstatus({ connected: true });
  desk.says("welcome", {});
  desk.says("state", { ...desk.session.state, generation: 1, seq: desk.session.acted });
  desk.field({ generation: 1, sweeps: 3 });
  assert.equal(desk.session.shown!.sweeps, 3);
});

test("a document that is brought along and is none gives way to the server's, and that is said", () => {
  const desk = new Desk({}, { connect: false, adopt: { ...aDocument(), grid: "none" as any } });
  desk.transport.onstatus({ connected: true });
  const [hello] = desk.sent;
  assert.equal(hello.document.grid, "none");
  desk.says("welcome", {});
  desk.says("error", { text: "grid: not an object", seq: hello.seq });
  assert.deepEqual(desk.asked("hello").at(-1), { type: "hello" });
  assert.equal(desk.status, "The map that was brought along cannot be shown: grid: not an object");
  desk.confirm();
  assert.equal(desk.session.document!.grid.shape[0], 21);
});

test("nothing is sent before there is a document", () => {
  const desk = new Desk({}, { connect: false });
  desk.transport.onstatus({ connected: true });
  desk.session.act({ type: "run" });
  assert.deepEqual(desk.sent.map(({ type }) => type), ["hello"]);
});

test("another map than a file's has no overlay of the file", () => {
  const desk = new Desk(LOG);
  desk.says("overlay", {}, { strokes: new Float32Array(10), trajectory: new Float32Array(24) });
  assert.equal(desk.session.overlay!.trajectory.length, 24);
  desk.confirm(aDocument());
  assert.equal(desk.session.overlay, null);
});

test("what was said holds until a later action is done", () => {
  const status = new Status();
  assert.equal(status.text, "Connecting");
  status.confirmed(1);
  assert.equal(status.text, "Ready");
  status.say("nothing to redo", "warning", 5);
  status.confirmed(5);
  assert.equal(status.text, "Nothing to redo");
  status.confirmed(6);
  assert.deepEqual([status.text, status.level], ["Ready", "info"]);
});

test("that the worker stopped is said until it runs again, whatever is done meanwhile", () => {
  const status = new Status();
  status.confirmed(1);
  status.worker("restarted");
  assert.match(status.text, /worker stopped.*the map is kept/);
  status.confirmed(9);
  assert.match(status.text, /worker stopped/);
  status.worker("ready");
  assert.equal(status.text, "The worker runs again");
});

test("events wait for the first picture that contains them", () => {
  const latency = new Latency();
  const event = (ago: number) => ({ timeStamp: performance.now() - ago }) as Event;
  latency.sent(1, event(100));
  latency.sent(2, event(50));
  latency.sent(3, event(10));
  latency.confirmed(7, 2);
  latency.painted(6); // a generation of which nothing is known
  assert.deepEqual(latency.eventToPaint_ms, []);
  latency.painted(7);
  const [first, second] = latency.eventToPaint_ms;
  assert(first >= 100 && first < 1100 && second >= 50 && second < first);
  latency.painted(7);
  assert.equal(latency.eventToPaint_ms.length, 2);
  latency.refused(3);
  latency.confirmed(8, 3);
  latency.painted(8);
  assert.equal(latency.eventToPaint_ms.length, 2);
  latency.sent(4, event(1));
  latency.forget();
  latency.confirmed(9, 4);
  latency.painted(9);
  assert.equal(latency.eventToPaint_ms.length, 2);
});

test("the time that is left is that of the sweeps seen, and of a new chain none is foretold", () => {
  const { now } = performance;
  let time = 0;
  Object.assign(performance, { now: () => time });
  try {
    const progress = new Progress();
    const field = (generation: number, sweeps: number) => ({ generation, sweeps, total: 1000, approximate: false }) as Field;
    const heard = (at: number, one: Field) => {
      time = at;
      progress.hear(one);
      return progress.remaining_s(one);
    };
    assert.equal(heard(0, field(1, 100)), null);
    assert.equal(heard(1000, field(1, 200)), 8);
    assert.equal(heard(4000, field(1, 400)), 8);
    assert.equal(heard(5000, field(2, 10)), null);
    assert.equal(heard(6000, field(2, 505)), 1);
    assert.equal(heard(6500, field(2, 20)), null); // begun anew
    progress.hear({ ...field(3, 500), approximate: true });
    assert.equal(progress.remaining_s(field(2, 20)), null);
  } finally {
    Object.assign(performance, { now });
  }
});
