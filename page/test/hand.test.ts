import "./dom";
import assert from "node:assert/strict";
import { mock, test } from "node:test";
import type { Tool } from "../src/input/hand";
import { placeOf } from "../src/layers/sensors";
import type { Pair } from "../src/protocol";
import { Desk, LOG, holding, timed, wallsOf } from "./desk";

const NO_WALLS = { walls: wallsOf([]) };
const SHIFT = { shiftKey: true };
const finger = (pointerId: number) => ({ pointerType: "touch", pointerId });

test("a fast drag leaves no gaps, and all of it is one stroke", () => {
  const desk = holding("draw");
  desk.drag([[0, 4], [6, 4], [19, 4]]); // the browser says where the hand was only twice
  assert.deepEqual(desk.walls, Array.from({ length: 20 }, (_, x): Pair => [x, 4]));
  const strokes = new Set(desk.asked("walls").map(({ stroke }) => stroke));
  assert.equal(strokes.size, 1);
  assert.equal(desk.asked("walls").flatMap(({ cells }) => cells).length, 20); // none is sent twice
  desk.drag([[5, 8], [6, 8]]);
  assert.equal(new Set(desk.asked("walls").map(({ stroke }) => stroke)).size, 2);
});

test("an oblique stroke is connected by edges or corners", () => {
  const desk = holding("draw", { ...NO_WALLS, sensors: [{ id: 1, x: 20, y: 0, yaw: 0 }] });
  desk.drag([[1, 1], [14, 6], [3, 19]]);
  const cells = desk.walls;
  const reached = [cells[0]];
  for (const [x, y] of reached) reached.push(...cells.filter(([a, b]) => Math.max(Math.abs(a - x), Math.abs(b - y)) === 1 && !reached.some(([c, d]) => a === c && b === d)));
  assert.equal(reached.length, cells.length);
  assert.equal(cells.length, 14 + 13);
});

test("all places that the browser knows of a fast hand are taken", () => {
  const desk = holding("draw");
  const between: Pair[] = [[5, 5], [5, 9]];
  desk.pointer("down", [3, 3]);
  const coalesced = between.map(([x, y]) => ({ clientX: desk.at(x, y).x, clientY: desk.at(x, y).y }));
  desk.pointer("move", [9, 9], { getCoalescedEvents: () => coalesced });
  assert(desk.walls.some(([x, y]) => x === 5 && y === 5) && desk.walls.some(([x, y]) => x === 5 && y === 9));
});

test("no wall is drawn onto the robot, nor outside the map, and what is as wanted is not sent", () => {
  const desk = holding("draw", { walls: wallsOf([[6, 10]]) });
  desk.drag([[5, 10], [15, 10]]);
  assert.deepEqual(desk.walls, [5, 6, 7, 8, 9, 11, 12, 13, 14, 15].map((x): Pair => [x, 10]));
  assert(!desk.asked("walls").some(({ cells }) => cells.some(([x]: Pair) => x === 6)));
  desk.sent.length = 0;
  desk.drag([[22, 3], [25, 3]]);
  assert.deepEqual(desk.asked("walls"), []);
});

test("the eraser, the right button and Shift erase", () => {
  const walls = { walls: wallsOf([[3, 3], [4, 3], [5, 3], [6, 3]]) };
  const erased = (tool: Tool, fields: object) => {
    const desk = holding(tool, walls);
    desk.drag([[3, 3], [4, 3]], fields);
    return desk.walls;
  };
  const left: Pair[] = [[5, 3], [6, 3]];
  for (const [tool, fields] of [["erase", {}], ["draw", { button: 2 }], ["draw", SHIFT]] as const) assert.deepEqual(erased(tool, fields), left, tool);
  const desk = holding("erase", walls);
  desk.drag([[8, 8], [9, 8]], SHIFT); // and with the eraser it draws
  assert.deepEqual(desk.walls.slice(-2), [[8, 8], [9, 8]]);
});

test("a click on a wall removes it, on a free cell draws it, and a stroke from a wall draws on", () => {
  const desk = holding("draw", { walls: wallsOf([[12, 4]]) });
  desk.drag([[12, 4]]);
  assert.deepEqual(desk.walls, []);
  desk.drag([[12, 4]]);
  assert.deepEqual(desk.walls, [[12, 4]]);
  desk.drag([[12, 4], [14, 4]]);
  assert.deepEqual(desk.walls, [[12, 4], [13, 4], [14, 4]]);
});

test("the robot comes where the hand takes it, and the whole drag is one step", () => {
  const desk = holding("sensor");
  const grip = desk.at(10.2, 10.1); // not in its middle
  desk.pointer("down", grip);
  for (let k = 1; k <= 10; k++) desk.pointer("move", desk.at(10.2 - 0.3 * k, 10.1 - 0.2 * k));
  desk.pointer("up", desk.at(7.2, 8.1));
  const { x, y, yaw } = desk.session.document!.sensors[0];
  assert(Math.abs(x - 7) < 1e-9 && Math.abs(y - 8) < 1e-9 && yaw === 0);
  assert.equal(new Set(desk.asked("move_sensor").map(({ drag }) => drag)).size, 1);
  // a press beside it brings it there
  desk.drag([[3, 3]]);
  assert(Math.hypot(desk.session.document!.sensors[0].x - 3, desk.session.document!.sensors[0].y - 3) < 1e-9);
});

test("the robot does not enter walls nor leave the map, and why is said until it stands again", () => {
  for (const [cell, why] of [[[12, 5], "in a wall."], [[-2, 10], "outside the map."]] as [Pair, string][]) {
    const desk = holding("sensor", { walls: wallsOf([[12, 5]]) });
    desk.pointer("down", [10, 10]);
    desk.pointer("move", cell);
    assert.equal(desk.status, `A sensor cannot stand ${why}`);
    assert.deepEqual(desk.asked("move_sensor"), []);
    desk.pointer("move", [9, 10]);
    assert.equal(desk.status, "Ready");
    assert.equal(desk.asked("move_sensor").length, 1);
  }
});

test("its handle turns the robot", () => {
  const desk = holding("sensor");
  const { point, handle } = placeOf(desk.session.document!.sensors[0], desk.session.document!.grid, desk.view);
  desk.pointer("down", handle);
  desk.pointer("move", { x: point.x, y: point.y - 60 });
  desk.pointer("up", { x: point.x, y: point.y - 60 });
  const { x, y, yaw } = desk.session.document!.sensors[0];
  assert(Math.abs(yaw - Math.PI / 2) < 1e-9);
  assert.deepEqual([x, y], [10, 10]);
});

test("a wall drawn over a sensor leaves its cell free, and the status says so", () => {
  const desk = holding("draw");
  desk.drag([[9, 10], [10, 10], [11, 10]]);
  assert.deepEqual(desk.walls, [[9, 10], [11, 10]]);
  assert.match(desk.status, /A sensor stands in a cell of this stroke/);
});

test("of several sensors the nearest is taken, and Shift adds one where the hand is", () => {
  const desk = holding("sensor", { ...NO_WALLS, sensors: [{ id: 1, x: 10, y: 10, yaw: 0 }, { id: 4, x: 10.4, y: 10, yaw: 0 }] });
  desk.pointer("down", desk.at(10.35, 10));
  assert.equal(desk.hand.selected, 4);
  desk.pointer("up", desk.at(10.35, 10));
  desk.sent.length = 0;
  desk.drag([[8, 5]], SHIFT);
  const [added] = desk.asked("add_sensor");
  assert.deepEqual([Math.round(added.x), Math.round(added.y), added.yaw], [8, 5, 0]);
  assert.equal(desk.hand.selected, 5); // the next number
});

test("there are at most as many sensors as the server takes", () => {
  const desk = new Desk({ ...NO_WALLS, sensors: Array.from({ length: 32 }, (_, i) => ({ id: i + 1, x: i % 20, y: Math.floor(i / 20), yaw: 0 })) });
  desk.editor.addSensor("where there is room");
  assert.equal(desk.status, "There can be 32 sensors at most.");
  const full = new Desk({ walls: wallsOf(Array.from({ length: 441 }, (_, i): Pair => [Math.floor(i / 21), i % 21])) });
  full.editor.addSensor("where there is room");
  assert.equal(full.status, "There is no free cell for a sensor.");
});

test("the middle button, the pan tool and any tool on a file pan", () => {
  for (const [tool, document, fields] of [["draw", NO_WALLS, { button: 1 }], ["pan", NO_WALLS, {}], ["draw", LOG, {}]] as const) {
    const desk = holding(tool, document);
    const { x, y } = desk.view.transform;
    desk.pointer("down", { x: 400, y: 400 }, fields);
    desk.pointer("move", { x: 450, y: 440 }, fields);
    desk.pointer("up", { x: 450, y: 440 }, fields);
    assert.deepEqual([desk.view.transform.x - x, desk.view.transform.y - y], [50, 40]);
    assert.deepEqual(desk.asked("walls"), []);
  }
});

test("the wheel zooms about the pointer", () => {
  const desk = holding("draw");
  const before = desk.view.transform.scale;
  const at = desk.at(10, 12);
  desk.canvas.dispatch("wheel", { clientX: at.x, clientY: at.y, deltaX: 0, deltaY: -240, deltaMode: 0, ctrlKey: false, shiftKey: false });
  assert(desk.view.transform.scale > 1.3 * before);
  assert(Math.hypot(desk.at(10, 12).x - at.x, desk.at(10, 12).y - at.y) < 1.5);
});

test("a finger draws, and a tap draws one cell", () =>
  timed(() => {
    const desk = holding("draw");
    desk.drag([[3, 3], [5, 3], [9, 3], [13, 3]], finger(1));
    assert.equal(desk.walls.length, 11);
    desk.drag([[5, 17]], finger(1));
    assert.equal(desk.walls.length, 12);
  }));

test("a finger that rests draws, once no second one can follow", () =>
  timed(() => {
    const desk = holding("draw");
    desk.pointer("down", [5, 5], finger(1));
    mock.timers.tick(80);
    assert.deepEqual(desk.walls, []);
    mock.timers.tick(20);
    assert.deepEqual(desk.walls, [[5, 5]]);
  }));

test("two fingers zoom and pan, and draw nothing", () =>
  timed(() => {
    const desk = holding("draw");
    const { x, y } = desk.at(10, 10);
    const before = desk.view.transform.scale;
    desk.pointer("down", { x: x - 30, y }, finger(1));
    desk.pointer("down", { x: x + 30, y }, finger(2));
    mock.timers.tick(200);
    for (const spread of [40, 60, 90]) {
      desk.pointer("move", { x: x - spread, y }, finger(1));
      desk.pointer("move", { x: x + spread, y }, finger(2));
    }
    desk.pointer("up", { x: x - 90, y }, finger(1));
    desk.pointer("up", { x: x + 90, y }, finger(2));
    assert(desk.view.transform.scale > 2.5 * before);
    assert(Math.hypot(desk.at(10, 10).x - x, desk.at(10, 10).y - y) < 12);
    assert.deepEqual(desk.walls, []);
  }));

test("a finger reaches the robot from farther than a mouse", () => {
  for (const [type, taken] of [["touch", true], ["mouse", false]] as const) {
    const desk = holding("draw");
    const { x, y } = desk.at(10, 10);
    desk.pointer("down", { x: x + 20, y }, { pointerType: type });
    desk.pointer("move", { x: x + 90, y }, { pointerType: type });
    assert.equal(desk.asked("move_sensor").length > 0, taken, type);
  }
});

test("a click gives a path its points, a drag with that tool pans", () => {
  const desk = holding("path");
  desk.drag([[6, 15]]);
  desk.drag([[10, 14]]);
  const { start, goal } = desk.session.decisions;
  assert(Math.hypot(start!.x - 6, start!.y - 15) < 1e-9 && Math.hypot(goal!.x - 10, goal!.y - 14) < 1e-9);
  const { x } = desk.view.transform;
  desk.drag([[3, 3], [6, 3], [8, 3]]);
  assert.equal(desk.session.decisions.goal, goal);
  assert(desk.view.transform.x > x);
});

test("a click on the map of views places a sensor there, and on a file's map says what it would tell", () => {
  const views = { pose: Float32Array.of(3, 3, 0.5, 8, 9, 1), nats: Float32Array.of(2, 7) };
  const drawn = holding("look");
  drawn.says("views", { spacing: 1 }, views);
  drawn.drag([[7, 9]]);
  assert.deepEqual(drawn.asked("add_sensor"), [{ type: "add_sensor", x: 8, y: 9, yaw: 1 }]);
  const file = holding("look", LOG);
  file.says("views", { spacing: 1 }, views);
  file.drag([[7, 9]]);
  assert.deepEqual(file.asked("add_sensor"), []);
  assert.equal(file.status, "A scan from 8.00, 9.00 m would tell 7.0 nats");
});

test("a click with the evidence's tool asks about that cell", () => {
  const desk = holding("evidence");
  desk.drag([[7, 9]]);
  assert.deepEqual(desk.session.evidence.cell, { x: 7, y: 9 });
  assert.deepEqual(desk.asked("inspect"), [{ type: "inspect", x: 7, y: 9, each: true }]);
});

test("the ghost moves as far as the hand that took hold of it, comes to a press beside it, and turns by its handle", () => {
  const desk = holding("ghost", LOG);
  const { ghost } = desk.session;
  desk.drag([[5, 10]]);
  assert(Math.hypot(ghost.pose!.x - 5, ghost.pose!.y - 10) < 1e-9);
  for (let answers = 0; answers < 2; answers++) desk.says("ghost", { x: 5, y: 10, yaw: 0 });
  desk.pointer("down", desk.at(5.2, 10));
  desk.pointer("move", desk.at(8.2, 12));
  assert.equal(desk.asked("ghost").at(-1)!.coarse, true);
  desk.pointer("up", desk.at(8.2, 12));
  assert(Math.hypot(ghost.pose!.x - 8, ghost.pose!.y - 12) < 1e-9);
  const { point, handle } = placeOf({ id: 0, ...ghost.pose! }, desk.session.document!.grid, desk.view);
  desk.pointer("down", handle);
  desk.pointer("move", { x: point.x, y: point.y - 60 });
  desk.pointer("up", { x: point.x, y: point.y - 60 });
  assert(Math.abs(ghost.pose!.yaw - Math.PI / 2) < 1e-9 && Math.abs(ghost.pose!.x - 8) < 1e-9);
  desk.key("ArrowRight");
  desk.key("]");
  assert(Math.abs(ghost.pose!.x - 9) < 1e-9 && ghost.pose!.yaw < Math.PI / 2);
  desk.choose("pan");
  assert.equal(ghost.held, false);
});

test("the beams through a cell are asked for once the pointer rests, and not while it draws", () =>
  timed(() => {
    const desk = holding("draw");
    desk.pointer("move", [3, 3]);
    mock.timers.tick(100);
    desk.pointer("move", [4, 3]);
    mock.timers.tick(100);
    assert.deepEqual(desk.asked("inspect"), []);
    mock.timers.tick(30);
    assert.deepEqual(desk.asked("inspect"), [{ type: "inspect", x: 4, y: 3 }]);
    desk.drag([[5, 5], [6, 5]]);
    mock.timers.tick(500);
    assert.equal(desk.asked("inspect").length, 1);
    desk.canvas.dispatch("pointerleave");
    assert.equal(desk.hand.hover, null);
  }));
