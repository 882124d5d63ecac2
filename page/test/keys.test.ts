import { browser, Element } from "./dom";
import assert from "node:assert/strict";
import { mock, test } from "node:test";
import type { Tool } from "../src/input/hand";
import { Desk, LOG, holding, timed, wallsOf } from "./desk";

const NO_WALLS = { walls: wallsOf([]) };
const SHIFT = { shiftKey: true };

test("walls are drawn, undone and inferred by keys alone", () => {
  const desk = holding("pan");
  desk.key("d");
  for (const key of ["ArrowUp", "ArrowUp", "ArrowUp", "ArrowLeft"]) desk.key(key);
  desk.key(" ");
  desk.key("ArrowLeft");
  desk.key(" ");
  assert.deepEqual(desk.walls, [[8, 13], [9, 13]]);
  desk.key(" "); // again: free
  assert.deepEqual(desk.walls, [[9, 13]]);
  desk.key("e");
  desk.key("ArrowRight");
  desk.key(" ");
  assert.deepEqual(desk.walls, []);
  desk.key("z", { ctrlKey: true });
  desk.key("y", { metaKey: true });
  desk.key("Z", { ctrlKey: true, shiftKey: true });
  desk.key("r");
  assert.deepEqual(desk.sent.slice(-4).map(({ type }) => type), ["undo", "redo", "redo", "run"]);
});

test("the robot is moved, turned, added and removed by keys", () => {
  const desk = holding("sensor");
  desk.key("ArrowDown");
  desk.key("ArrowLeft", SHIFT);
  desk.key("[");
  const { x, y, yaw } = desk.session.document!.sensors[0];
  assert.deepEqual([x, y], [5, 9]);
  assert(Math.abs(yaw - Math.PI / 12) < 1e-12);
  desk.key("a");
  desk.key("Delete");
  assert.deepEqual(desk.sent.slice(-2).map(({ type }) => type), ["add_sensor", "remove_sensor"]);
});

test("Space takes the next sensor, and its name is said", () => {
  const desk = holding("sensor", { ...NO_WALLS, sensors: [{ id: 1, x: 1, y: 1, yaw: 0 }, { id: 5, x: 3, y: 3, yaw: 0 }] });
  const said: string[] = [];
  desk.hand.announce = (text) => said.push(text);
  desk.key(" ");
  desk.key(" ");
  assert.deepEqual(said, ["Sensor 5", "Sensor 1"]);
});

test("Space erases no wall with a tool that does not draw, and chooses where such a tool asks for a place", () => {
  for (const tool of ["look", "ghost", "where", "pan", "evidence", "path"] as const) {
    const desk = holding(tool, { walls: wallsOf([[10, 10]]), sensors: [{ id: 1, x: 3, y: 3, yaw: 0 }] });
    desk.key(" ");
    desk.key(" ");
    assert.deepEqual(desk.walls, [[10, 10]]);
    assert.deepEqual(desk.asked("walls"), [], tool);
    if (tool === "evidence") assert.deepEqual(desk.session.evidence.cell, { x: 10, y: 10 });
    if (tool === "path") assert.deepEqual(desk.session.decisions.start, { x: 10, y: 10 });
  }
});

test("the cursor stays on the map, the map comes after it, and Escape puts it away", () => {
  const desk = holding("draw");
  for (let i = 0; i < 30; i++) desk.key("ArrowRight");
  assert.deepEqual(desk.hand.cursor, { x: 20, y: 10 });
  for (let i = 0; i < 12; i++) desk.view.zoom(1.4, { x: 100, y: 100 }, [21, 21]);
  desk.key("ArrowDown");
  const at = desk.at(20, 9);
  assert(at.x > 0 && at.x < 960 && at.y > 0 && at.y < 800);
  desk.key("Escape");
  assert.equal(desk.hand.cursor, null);
});

test("the cell under the cursor is said once the hand rests", () =>
  timed(() => {
    const desk = holding("draw");
    const said: string[] = [];
    desk.hand.announce = (text) => said.push(text);
    desk.hand.describe = ({ x, y }) => `Cell ${x}, ${y}`;
    desk.key("ArrowRight");
    desk.key("ArrowRight");
    mock.timers.tick(200);
    assert.deepEqual(said, ["Cell 12, 10"]);
  }));

test("letters choose tools and layers, and what a file or a recording has not got they leave alone", () => {
  const letters: [string, Tool][] = [["d", "draw"], ["e", "erase"], ["s", "sensor"], ["p", "pan"], ["g", "path"], ["l", "look"], ["w", "where"], ["o", "ghost"], ["v", "evidence"]];
  const chosen = (desk: Desk, [letter]: [string, Tool]) => {
    desk.hand.tool = "pan";
    desk.key(letter.toUpperCase());
    return desk.hand.tool;
  };
  assert.deepEqual(letters.map((entry) => chosen(new Desk(), entry)), letters.map(([, tool]) => tool));
  assert.deepEqual(letters.map((entry) => chosen(new Desk(LOG), entry)), letters.map(([, tool], i) => (i < 3 ? "pan" : tool)));
  const recorded = () => {
    const desk = new Desk(LOG);
    desk.session.recorded = true;
    return desk;
  };
  assert.deepEqual(letters.map((entry) => chosen(recorded(), entry)), letters.map(() => "pan"));
  const silent = recorded();
  silent.sent.length = 0;
  for (const key of ["r", "Escape"]) silent.key(key);
  silent.key("z", { ctrlKey: true });
  assert.deepEqual(silent.sent, []);
  const desk = new Desk();
  desk.sent.length = 0;
  for (const key of ["m", "n", "h"]) desk.key(key);
  assert.deepEqual(desk.asked("view").map(({ layer }) => layer), ["mean", "draw", "entropy"]);
});

test("H shows the width where entropy would mean nothing", () => {
  const desk = new Desk();
  desk.field({ quantity: { kind: "surface", mean: "m", value: "v", interval: true } });
  desk.key("h");
  assert.equal(desk.asked("view").at(-1)!.layer, "width");
});

test("where nothing is known any more, the dots of where to look next go", () => {
  const desk = new Desk();
  const { decisions } = desk.session;
  decisions.look(true);
  desk.says("views", { spacing: 1 }, { pose: new Float32Array(3), nats: Float32Array.of(2) });
  assert(decisions.views);
  desk.says("undecided", { question: "views", text: "nothing is known to be free yet" }); // inference was cleared
  assert.deepEqual([decisions.views, decisions.viewTrouble], [null, "Nothing is known to be free yet."]);
});

test("Escape takes a path away, but first what runs where other tools have hidden it", () => {
  const desk = new Desk();
  const { decisions } = desk.session;
  desk.field();
  desk.hand.choose("path");
  for (const at of [1, 2]) decisions.point({ x: at, y: 1 });
  for (const [tool, shown] of [["evidence", false], ["draw", true], ["look", false], ["pan", true], ["ghost", false]] as const) {
    desk.hand.choose(tool);
    assert.equal(decisions.pathShown, shown, tool);
  }
  desk.key("Escape");
  assert(decisions.start && decisions.goal);
  desk.hand.choose("path");
  desk.key("Escape");
  assert.deepEqual([decisions.start, decisions.goal, decisions.path], [null, null, null]);
});

test("Escape cancels what runs, and + - 0 ? are the page's commands", () => {
  const desk = new Desk();
  desk.key("Escape");
  assert.deepEqual(desk.asked("cancel"), []);
  desk.state({ running: true, working: true });
  desk.key("Escape");
  assert.deepEqual(desk.asked("cancel"), [{ type: "cancel" }]);
  for (const key of ["+", "=", "-", "0", "?"]) desk.key(key);
  assert.deepEqual(desk.commands, ["in", "in", "out", "fit", "help"]);
});

test("what is typed into a field is no key of the page, and a slider's is", () => {
  const desk = new Desk();
  const typed = (element: Element, key: string, fields = {}) => desk.pageKey(element.dispatch("keydown", { key, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...fields }));
  const input = (type: string) => Object.assign(document.createElement("input") as unknown as Element, { type });
  desk.sent.length = 0;
  typed(input("number"), "r");
  typed(input("number"), "z", { ctrlKey: true });
  typed(document.createElement("select") as unknown as Element, "m");
  assert.deepEqual(desk.sent, []);
  typed(input("range"), "r");
  assert.deepEqual(desk.asked("run"), [{ type: "run" }]);
  desk.session.decisions.point({ x: 1, y: 1 });
  typed(input("number"), "Escape"); // but a path goes
  assert.equal(desk.session.decisions.start, null);
});

/** A desk with some draws. */
function drawn(count = 4) {
  const desk = new Desk();
  desk.field();
  desk.state({ draws: { chains: 2, count } });
  desk.sent.length = 0;
  return desk;
}
/** The server shows what was asked for last. */
const answer = (desk: Desk) => {
  const { layer, chain, draw } = desk.asked("view").at(-1) as any;
  desk.state({ draws: desk.session.draws, view: { layer, chain, draw } });
  desk.field({ layer, chain, draw: layer === "draw" ? (draw ?? desk.session.draws.count - 1) : undefined });
};
const lastView = (desk: Desk) => {
  const { layer, draw } = desk.asked("view").at(-1) ?? ({} as any);
  return [layer, draw];
};

test("draws are played one after another, and it stops at the last", () =>
  timed(() => {
    const desk = drawn();
    const { player } = desk;
    player.play(true);
    const seen = [];
    for (let i = 0; i < 12 && player.playing; i++) {
      answer(desk);
      seen.push(desk.session.shown!.draw);
      mock.timers.tick(100);
    }
    assert.deepEqual(seen, [0, 1, 2, 3]);
    assert.equal(player.playing, false);
  }));

test("no draw is asked for before the last one was painted", () =>
  timed(() => {
    const desk = drawn();
    desk.player.play(true);
    mock.timers.tick(5000);
    assert.equal(desk.asked("view").length, 1);
  }));

test("over the mean draws have no end", () =>
  timed(() => {
    const desk = drawn();
    const { player } = desk;
    player.over(true);
    answer(desk);
    assert(desk.session.flicker.under);
    player.play(true);
    const seen = [];
    for (let i = 0; i < 9; i++) {
      answer(desk);
      seen.push(desk.session.shown!.draw);
      mock.timers.tick(100);
    }
    assert.deepEqual(seen, [0, 1, 2, 3, 0, 1, 2, 3, 0]);
    player.play(false);
    answer(desk);
    const asked = desk.asked("view").length;
    mock.timers.tick(5000);
    assert.equal(desk.asked("view").length, asked);
  }));

test("without draws over the mean, the layer before is back; one that was chosen since stays", () => {
  for (const before of ["mean", "entropy", "draw"] as const) {
    const desk = drawn();
    desk.player.showLayer(before);
    answer(desk);
    desk.player.over(true);
    answer(desk);
    assert.deepEqual([desk.session.view.layer, Boolean(desk.session.flicker.under)], ["draw", true], before);
    desk.player.over(false);
    answer(desk);
    assert.deepEqual([desk.session.view.layer, desk.session.flicker.under], [before, null]);
  }
  const desk = drawn();
  desk.player.over(true);
  answer(desk);
  desk.player.showLayer("entropy");
  answer(desk);
  desk.player.over(false);
  assert.equal(desk.session.view.layer, "entropy");
});

test("a page that has seen no mean of this picture fetches it before draws lie on it", () => {
  const desk = new Desk();
  desk.confirm({ prior: 0.2 }, { draws: { chains: 1, count: 4 }, view: { layer: "draw", chain: 0, draw: 2 } });
  desk.field({ layer: "draw", chain: 0, draw: 2 });
  desk.player.over(true);
  assert.deepEqual(lastView(desk)[0], "mean");
  answer(desk);
  assert.equal(lastView(desk)[0], "draw");
  answer(desk);
  assert(desk.session.flicker.under);
});

test("who wants nothing to move by itself is shown one draw at a time", () =>
  timed(() => {
    browser.still = true;
    try {
      const desk = drawn(3);
      desk.player.showDraw(1);
      answer(desk);
      for (const draw of [2, 0, 1]) {
        desk.player.play(true);
        assert.deepEqual(lastView(desk), ["draw", draw]);
        answer(desk);
      }
      const asked = desk.asked("view").length;
      mock.timers.tick(5000);
      assert.equal(desk.asked("view").length, asked);
      assert.equal(desk.player.playing, false);
    } finally {
      browser.still = false;
    }
  }));

test("the first sweeps of a chain are played from the first draw", () => {
  const desk = drawn();
  desk.player.playFromStart();
  assert.deepEqual([lastView(desk), desk.player.playing], [["draw", 0], true]);
});

test("draws cannot be shown where none can be", () => {
  const desk = new Desk({ method: "propagate" });
  desk.sent.length = 0;
  desk.player.showLayer("draw");
  assert.deepEqual(desk.asked("view"), []);
});
