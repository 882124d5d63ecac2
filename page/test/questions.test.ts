import "./dom";
import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { Desk, LOG, wallsOf } from "./desk";

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
  assert.equal(where.current, false); // it is sensor 2's
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
  desk.confirm({ prior: 0.4 });
  desk.field();
  where.follow(true, 1);
  assert.equal(asked(desk, "where"), 3);
  desk.says("where", { picture: desk.session.generation - 1, sensor: 1, modes, pose: [0, 0, 0] }, { pose: new Float32Array(3), weight: Float32Array.of(1) });
  where.follow(true, 1);
  assert.deepEqual([where.current, asked(desk, "where")], [false, 4]); // the map has changed meanwhile
  desk.says("worker", { state: "ready" }); // another, which was not asked
  where.follow(true, 1);
  assert.equal(asked(desk, "where"), 5);
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
