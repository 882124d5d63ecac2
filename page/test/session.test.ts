import { browser } from "./dom";
import assert from "node:assert/strict";
import { mock, test } from "node:test";
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

/** Answers that the page asks for: of which picture, and again of another. */
const asked = (desk: Desk, type: string) => desk.asked(type).length;

test("a path is asked for once a picture, and anew when place, radius or picture is another", () => {
  const desk = new Desk();
  const { decisions } = desk.session;
  decisions.point({ x: 1, y: 2 });
  assert.equal(asked(desk, "path"), 0);
  decisions.point({ x: 3, y: 4 });
  assert.deepEqual(desk.asked("path"), [{ type: "path", start: [1, 2], goal: [3, 4], radius: 0.25, risk: 0.01 }]);
  desk.field();
  assert.equal(asked(desk, "path"), 1);
  decisions.set({ radius: 0.4 });
  assert.equal(asked(desk, "path"), 2);
  desk.confirm({ walls: wallsOf([[3, 3]]) });
  desk.field({ approximate: true, method: "propagate" }); // draws are to come
  assert.equal(asked(desk, "path"), 2);
  desk.field();
  assert.equal(asked(desk, "path"), 3);
  desk.says("path", { path: [[1, 2], [3, 4]], probability: 0.9 });
  assert(decisions.path);
  decisions.point({ x: 9, y: 9 }); // the start of another
  assert.deepEqual([decisions.path, decisions.goal], [null, null]);
});

test("why there is no path is no answer about views", () => {
  const desk = new Desk();
  const { decisions } = desk.session;
  decisions.look(true);
  assert.equal(asked(desk, "views"), 1);
  desk.says("undecided", { question: "path", text: "plan: at the start the disc touches something" });
  assert.deepEqual([decisions.trouble, decisions.viewTrouble], ["At the start the disc touches something.", ""]);
  const views = { pose: Float32Array.of(5, 1, 3, 5, 9, 0), nats: Float32Array.of(3, 7) };
  desk.says("views", { spacing: 1 }, views);
  assert.deepEqual([decisions.nearest({ x: 5, y: 8 }), decisions.nearest({ x: 5, y: 2 })], [1, 0]);
  decisions.look(false);
  assert.equal(decisions.views, null);
  desk.says("views", { spacing: 1 }, views); // too late
  assert.equal(decisions.views, null);
});

test("the ghost asks where it stands, two questions at a time, the next for where it is then", () => {
  const desk = new Desk();
  const { ghost } = desk.session;
  const buffers = { angles: Float32Array.of(0), low: Float32Array.of(1), median: Float32Array.of(2), high: Float32Array.of(3) };
  desk.says("scan", { generation: desk.session.generation, ids: [1] }, { pose: Float64Array.of(4, 5, 0.5), angles: Float32Array.of(0), ranges: Float32Array.of(1), exact: Float32Array.of(1), hit: Uint8Array.of(1) });
  ghost.hold(true);
  assert.deepEqual(desk.asked("ghost"), [{ type: "ghost", x: 4, y: 5, yaw: 0.5, coarse: false }]); // where the scan was taken
  for (let x = 5; x < 9; x++) ghost.move({ x }, true);
  assert.deepEqual(desk.asked("ghost").map(({ x, coarse }) => [x, coarse]), [[4, false], [5, true]]);
  desk.says("ghost", { x: 4, y: 5, yaw: 0.5, draws: 32, generation: desk.session.generation }, buffers);
  assert.deepEqual(desk.asked("ghost").map(({ x, coarse }) => [x, coarse]).at(-1), [8, true]); // and none between
  desk.says("ghost", { x: 5 }, buffers);
  ghost.rest();
  assert.deepEqual(desk.asked("ghost").at(-1), { type: "ghost", x: 8, y: 5, yaw: 0.5, coarse: false });
  assert.equal(ghost.answers, 2);
  desk.says("undecided", { question: "ghost", text: "run inference first" });
  assert.deepEqual([ghost.trouble, ghost.fan], ["run inference first", null]);
  ghost.hold(false);
  const before = asked(desk, "ghost");
  desk.confirm();
  desk.field();
  assert.equal(asked(desk, "ghost"), before); // it was put away
});

test("a ghost that is no part of another map is forgotten", () => {
  const desk = new Desk();
  const { ghost } = desk.session;
  ghost.hold(true);
  ghost.move({ x: 18, y: 3, yaw: 0 });
  desk.confirm({ grid: { shape: [21, 21], resolution: 0.5, origin: [-0.5, -0.5] } });
  ghost.refit();
  assert.equal(ghost.pose, null);
  ghost.move({ x: 3, y: 3, yaw: 0 });
  ghost.refit();
  assert.deepEqual(ghost.pose, { x: 3, y: 3, yaw: 0 });
});

test("of the cell that was clicked all beams are asked, once a picture, and another's answer is not shown", () => {
  const desk = new Desk();
  const { evidence } = desk.session;
  evidence.pin({ x: 3, y: 4 });
  assert.equal(asked(desk, "inspect"), 0); // its tool is not in the hand
  evidence.hold(true);
  assert.deepEqual(desk.asked("inspect"), [{ type: "inspect", x: 3, y: 4, each: true }]);
  desk.field();
  assert.equal(asked(desk, "inspect"), 1);
  desk.says("cell", { x: 9, y: 9, each: true, beams: 2 }, { nats: Float64Array.of(1) });
  assert.equal(evidence.together, null);
  desk.says("cell", { x: 3, y: 4, beams: 2 }); // of the pointer
  assert.deepEqual([evidence.facts!.beams, evidence.together], [2, null]);
  desk.says("cell", { x: 3, y: 4, each: true, beams: 5 }, { nats: Float64Array.of(1) });
  assert.deepEqual([evidence.together!.beams, evidence.each!.nats.length, evidence.cellShown], [5, 1, true]);
  evidence.pin({ x: 3, y: 21 });
  assert.equal(evidence.cell, null);
});

test("the robot's place is asked for one question at a time, of the sensor in the hand", () => {
  const desk = new Desk({ sensors: [{ id: 1, x: 1, y: 1, yaw: 0 }, { id: 2, x: 2, y: 2, yaw: 0 }] });
  const { where } = desk.session;
  where.follow(true, 2);
  where.follow(true, 1);
  assert.deepEqual(desk.asked("where"), [{ type: "where", sensor: 2 }]);
  const modes = [0.6, 0.398, 0.002].map((probability) => ({ probability, mean: [0, 0, 0] }));
  desk.says("where", { picture: 1, modes, pose: [0, 0, 0] }, { pose: new Float32Array(3), weight: Float32Array.of(1) });
  assert.equal(where.found!.modes.length, 2); // the last is not worth words
  where.follow(true, 1);
  assert.deepEqual(desk.asked("where").at(-1), { type: "where", sensor: 1 });
  desk.confirm({ prior: 0.3 });
  where.follow(true, 1);
  assert.equal(asked(desk, "where"), 2); // its picture comes first
  desk.field();
  desk.says("where", { modes: [], trouble: "no draws yet" });
  assert.deepEqual([where.trouble, where.found], ["no draws yet", null]);
  where.follow(true, 1);
  assert.equal(asked(desk, "where"), 3);
  where.follow(false, null);
  assert.equal(where.trouble, "");
});

test("while a scan of a drawn world is located, the picture is the known map, and follows its walls", () => {
  const desk = new Desk({ walls: wallsOf([[3, 4]]) });
  const { session } = desk;
  desk.field({ p: new Uint8Array(441).fill(100), reached: new Uint8Array(441), layer: "draw" });
  assert.equal(session.picture, session.shown);
  session.where.follow(true, 1);
  const known = session.picture!;
  assert.deepEqual([known.p[3 * 21 + 4], known.p[3 * 21 + 5], known.reached[0], session.layer], [255, 0, 255, "mean"]);
  assert.equal(session.picture, known); // nothing to paint anew
  session.act({ type: "walls", cells: [[3, 5]], wall: true, stroke: 1 });
  assert.equal(session.picture!.p[3 * 21 + 5], 255);
  session.where.follow(false, 1);
  assert.equal(session.picture, session.shown);
  const log = new Desk(LOG);
  log.session.where.follow(true, null);
  assert.equal(log.session.where.map, null); // its map is the posterior's
});

/** A desk with a scan from (2, 2): beams along x, along y, between them with no return, and one that passes by the first one's end. */
function withScan() {
  const desk = new Desk({ ...LOG, max_range: 10 });
  const scan = (index: number) =>
    desk.says("scan", { generation: desk.session.generation, ids: [index], index }, { pose: Float64Array.of(2, 2, 0), angles: Float32Array.of(0, Math.PI / 2, Math.PI / 4, 0.02), ranges: Float32Array.of(5, 3, Infinity, 9), exact: new Float32Array(0), hit: Uint8Array.of(1, 1, 0, 1) });
  scan(3);
  return { desk, scan };
}

test("the reading nearest to the pointer is picked, a line for want of one, and far from all nothing", () => {
  const { desk } = withScan();
  const { reading } = desk.session;
  const at = (x: number, y: number) => {
    reading.point({ x, y }, 0.4);
    return reading.picked?.beam ?? null;
  };
  assert.deepEqual([at(7, 2.1), at(2, 5.2), at(8, 8), at(6, 2), at(9, 1.7), at(0, 0)], [0, 1, 2, 0, null, null]);
  reading.point(null, 0.4);
  assert.equal(reading.picked, null);
});

test("a reading is asked about once the pointer rests, an answer that is long in coming is being prepared", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  try {
    const { desk, scan } = withScan();
    const { reading } = desk.session;
    reading.point({ x: 7, y: 2 }, 0.4);
    mock.timers.tick(100);
    reading.point({ x: 2, y: 5 }, 0.4);
    mock.timers.tick(100);
    assert.equal(asked(desk, "beam"), 0);
    mock.timers.tick(30);
    assert.deepEqual(desk.asked("beam"), [{ type: "beam", scan: 3, beam: 1 }]);
    mock.timers.tick(900);
    assert.equal(reading.slow, false);
    mock.timers.tick(200);
    assert.equal(reading.slow, true);
    desk.says("beam", { scan: 3, beam: 0 }); // of the one before
    assert.equal(reading.found, null);
    desk.says("beam", { scan: 3, beam: 1, range: 3 });
    assert.equal(reading.found!.range, 3);
    scan(4);
    assert.deepEqual([reading.picked, reading.found, reading.slow], [null, null, false]);
  } finally {
    mock.timers.reset();
  }
});

test("a drawn map's readings, and a recording's, are not compared", () => {
  const desk = new Desk();
  desk.says("scan", { generation: desk.session.generation, ids: [1], index: 0 }, { pose: Float64Array.of(2, 2, 0), angles: Float32Array.of(0), ranges: Float32Array.of(5), exact: Float32Array.of(5), hit: Uint8Array.of(1) });
  desk.session.reading.point({ x: 7, y: 2 }, 0.4);
  assert.equal(desk.session.reading.picked, null);
  const { desk: other } = withScan();
  other.session.recorded = true;
  other.session.reading.point({ x: 7, y: 2 }, 0.4);
  assert.equal(other.session.reading.picked, null);
});

test("a recording asks its session nothing", () => {
  const desk = new Desk(LOG);
  desk.says("welcome", { recorded: true });
  desk.confirm();
  const { session } = desk;
  desk.sent.length = 0;
  session.decisions.point({ x: 1, y: 1 });
  session.decisions.point({ x: 2, y: 2 });
  session.decisions.look(true);
  session.ghost.hold(true);
  session.ghost.move({ x: 1, y: 1 });
  session.evidence.hold(true);
  session.evidence.pin({ x: 1, y: 1 });
  session.where.follow(true, null);
  desk.field();
  assert.deepEqual(desk.sent.map(({ type }) => type), []);
  assert(!session.editable);
});
