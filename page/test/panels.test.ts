import { browser, Element } from "./dom";
import assert from "node:assert/strict";
import { test } from "node:test";
import { THEMES, type Theme } from "../src/colour";
import type { Figure } from "../src/messages";
import { bar } from "../src/panels/bar";
import { helpDialog, newDialog, shareDialog } from "../src/panels/dialogs";
import { h } from "../src/panels/dom";
import { head } from "../src/panels/head";
import { legend } from "../src/panels/legend";
import { logPanel } from "../src/panels/log";
import { posesPanel } from "../src/panels/poses";
import { posteriorPanel } from "../src/panels/posterior";
import { clearPanel, inferencePanel, modelPanel, sensorPanel } from "../src/panels/settings";
import { Ui } from "../src/panels/ui";
import { scanPanel, viewPanel } from "../src/panels/view";
import { Session } from "../src/state/session";
import { ThemeChoice } from "../src/theme";
import { localTransport } from "../src/transport/local";
import type { MapDocument, Quantity } from "../src/protocol";
import { aDocument, Desk, LOG, Panel, RUN, panel, SURFACES, LIMITS } from "./desk";

const patches = (desk: Desk) => desk.asked("set").map(({ patch }) => patch);
const last = (desk: Desk) => patches(desk).at(-1);

test("a slider's number and its hand set the document, and one slide is one step of undo", () => {
  const [desk, model] = panel(modelPanel);
  const slider = model.control("Prior P(wall)", "range");
  for (const value of ["0.4", "0.3", "0.2"]) slider.put(value, "input");
  slider.dispatch("change");
  slider.put("0.1", "input");
  assert.deepEqual(patches(desk), [0.4, 0.3, 0.2, 0.1].map((prior) => ({ prior })));
  const drags = desk.asked("set").map(({ drag }) => drag);
  assert(drags[0] === drags[2] && drags[2] !== drags[3]);
  assert.equal(model.control("Prior P(wall), number").value, "0.1");
  model.control("Noise (m), number").put("2", "change");
  assert.deepEqual(last(desk), { noise: 2 });
});

test("two choices of one control are two steps of undo, and so are two slides", () => {
  const figure = { version: 1, document: aDocument({ method: "gibbs" }), limits: LIMITS, rare_walls: 0.2, judging: {}, story: null } as unknown as Figure;
  const session = new Session(localTransport(figure, () => {}), () => {});
  session.transport.open();
  const desk = new Desk();
  const ui = new Ui(session, desk.hand, desk.editor, () => {}, () => {}, false);
  const found = new Panel({ ui } as Desk, () => h("div", {}, modelPanel(ui), inferencePanel(ui)));
  const steps: [string, string, string[], keyof MapDocument, unknown[]][] = [
    ["Method", "", ["block", "importance"], "method", ["gibbs", "block", "importance"]],
    ["Seed", "", ["3", "4"], "seed", [0, 3, 4]],
    ["Prior P(wall), number", "", ["0.4", "0.3"], "prior", [0.5, 0.4, 0.3]],
    ["Prior P(wall)", "range", ["0.2", "0.1"], "prior", [0.3, 0.2, 0.1]],
  ];
  for (const [label, type, values, key, states] of steps) {
    for (const value of values) found.control(label, type).put(value);
    assert.equal(session.document![key], states[2], label);
    for (const state of [states[1], states[0]]) {
      session.act({ type: "undo" });
      assert.equal(session.document![key], state, label);
    }
    for (const _ of values) session.act({ type: "redo" });
  }
});

test("long scales are logarithmic, and end at round numbers within their limits", () => {
  const [desk, model] = panel(modelPanel);
  const slider = model.control("Angles", "range");
  const chosen = ["0", "500", "1000", "731"].map((place) => (slider.put(place, "input"), (last(desk) as any).angles));
  assert.deepEqual(chosen, [10, 100, 1000, 290]);
  model.control("Angles, number").put("137", "change");
  assert.deepEqual(last(desk), { angles: 137 });
  assert.equal(slider.getAttribute("aria-valuetext"), "290");
  assert.equal(model.control("Angles", "range").getAttribute("aria-valuetext"), "137");
  const [other, inference] = panel(inferencePanel);
  const sweeps = inference.control("Sweeps", "range");
  assert.deepEqual(["0", "1000"].map((place) => (sweeps.put(place, "input"), (last(other) as any).sweeps)), [1, 100_000]);
});

const NUMBERS: [string, string, number, number, (value: number) => object][] = [
  ["Noise (m), number", "noise", 0.01, 5, (noise) => ({ noise })],
  ["Prior P(wall), number", "prior", 0.001, 0.999, (prior) => ({ prior })],
  ["Angles, number", "angles", 10, 1000, (angles) => ({ angles })],
  ["Longest range (m)", "max_range", 0.1, 10_000, (max_range) => ({ max_range })],
  ["Field of view (\u00b0)", "fov", 5, 360, (degrees) => ({ fov: (degrees * Math.PI) / 180 })],
];

test("numbers out of range are brought into it, and the limit is said until something else is done", () => {
  for (const [label, , low, high, patch] of NUMBERS) {
    const [desk, model] = panel(modelPanel);
    const name = label.replace(/, number$/, "");
    model.control(label).put(String(high + 1), "change");
    assert.deepEqual(last(desk), patch(high), label);
    assert.equal(desk.status, `${name} is at most ${high}`);
    desk.confirm(last(desk) as object);
    assert.equal(desk.status, `${name} is at most ${high}`);
    model.control(label).put(String(low - 1), "change");
    assert.deepEqual(last(desk), patch(low), label);
    assert.equal(desk.status, `${name} is at least ${low}`);
    desk.confirm(last(desk) as object);
    model.control(label).put(String((low + high) / 2), "change");
    desk.confirm(last(desk) as object);
    assert.equal(desk.status, "Ready");
  }
});

test("limits are those that the server sent: in degrees what lies inside them", () => {
  const [desk, poses] = panel(posesPanel);
  poses.control("Yaw \u00b1 (\u00b0), number").put("90", "change");
  assert((last(desk) as any).heading_sigma <= LIMITS.heading_sigma[1]); // 0.6 rad, of which 34.3 degrees are shown
  assert.equal(desk.status, "Yaw \u00b1 (\u00b0) is at most 34.3");
  desk.says("welcome", { limits: { ...LIMITS, heading_sigma: [0, Math.PI / 2], pose_sigma: [0, 7] } });
  poses.control("Yaw \u00b1 (\u00b0), number").put("89", "change");
  assert(Math.abs((last(desk) as any).heading_sigma - (89 * Math.PI) / 180) < 1e-12);
  assert.deepEqual([poses.control("Position \u00b1 (m)", "range").max, poses.control("Yaw \u00b1 (\u00b0)", "range").max], ["7", "90"]);
});

test("a prior of 0 or 1 is not taken, and the slider keeps to its steps inside the limits", () => {
  const [desk, model] = panel(modelPanel);
  for (const [typed, taken, words] of [["0", 0.001, "at least 0.001"], ["1", 0.999, "at most 0.999"]] as const) {
    model.control("Prior P(wall), number").put(typed, "change");
    assert.deepEqual(last(desk), { prior: taken });
    assert.equal(desk.status, `Prior P(wall) is ${words}`);
  }
  const { min, max } = model.control("Prior P(wall)", "range");
  assert.deepEqual([min, max], ["0.01", "0.99"]); // steps count from the least
});

test("a field that was emptied, or holds no number, shows its number again and sends nothing", () => {
  const all: [(ui: Ui) => HTMLElement, string[]][] = [
    [modelPanel, NUMBERS.map(([label]) => label)],
    [inferencePanel, ["Seed", "Sweeps, number"]],
    [sensorPanel, ["x (m)", "y (m)", "heading (\u00b0)"]],
  ];
  for (const [make, labels] of all) {
    for (const label of labels) {
      const [desk, found] = panel(make);
      const number = found.control(label).value;
      assert.notEqual(number, "", label);
      for (const text of ["", "-", "1e"]) found.control(label).put(text, "change");
      assert.equal(found.control(label).value, number, label);
      assert.deepEqual([...desk.asked("set"), ...desk.asked("move_sensor")], [], label);
    }
  }
});

test("angles are in degrees on the page and in radians in the document", () => {
  const [desk, poses] = panel(posesPanel);
  poses.control("Yaw \u00b1 (\u00b0), number").put("10", "change");
  assert(Math.abs((last(desk) as any).heading_sigma - Math.PI / 18) < 1e-12);
  assert.equal(poses.control("Yaw \u00b1 (\u00b0), number").value, "10");
  poses.control("Yaw \u00b1 (\u00b0)", "range").put("30", "input");
  assert(Math.abs((last(desk) as any).heading_sigma - Math.PI / 6) < 1e-12);
  const [other, model] = panel(modelPanel);
  model.control("Field of view (\u00b0)").put("360", "change");
  assert.deepEqual(last(other), { fov: 2 * Math.PI });
  assert.equal(model.control("Field of view (\u00b0)").value, "360");
});

test("a heading is any number of turns, and is shown where headings differ", () => {
  const [desk, sensors] = panel(sensorPanel, { fov: Math.PI });
  sensors.control("heading (\u00b0)").put("720090", "change");
  assert(Math.abs(desk.asked("move_sensor")[0].yaw - Math.PI / 2) < 1e-9);
  assert(sensors.sees("heading (\u00b0)"));
  assert(!panel(sensorPanel)[1].sees("heading (\u00b0)"));
});

test("a place outside the map is refused at once", () => {
  const [desk, sensors] = panel(sensorPanel);
  sensors.control("x (m)").put("-5", "change");
  assert.equal(desk.status, "A sensor cannot stand outside the map.");
  assert.equal(sensors.control("x (m)").value, "10");
  sensors.control("x (m)").put("4", "change");
  assert.deepEqual(desk.asked("move_sensor").map(({ x, y }) => [x, y]), [[4, 10]]);
});

test("the last sensor cannot be removed, and the list is of those there are", () => {
  const [desk, sensors] = panel(sensorPanel);
  assert.equal(sensors.control("Remove the sensor").disabled, true);
  desk.confirm({ sensors: [{ id: 1, x: 1, y: 1, yaw: 0 }, { id: 4, x: 2, y: 2, yaw: 0 }] });
  assert.equal(sensors.control("Remove the sensor").disabled, false);
  sensors.control("Selected sensor").put("4", "change");
  assert.equal(desk.hand.selected, 4);
  sensors.control("Remove the sensor").click();
  assert.deepEqual(desk.asked("remove_sensor"), [{ type: "remove_sensor", id: 4 }]);
});

test("each method has the settings that it has use for, and its own word for a sweep", () => {
  for (const [method, order, start, word] of [["auto", true, true, "Sweeps"], ["gibbs", true, true, "Sweeps"], ["block", false, true, "Sweeps"], ["propagate", false, false, "Rounds"], ["importance", false, false, "Particles"]] as const) {
    const [desk, inference] = panel(inferencePanel, { method });
    assert.deepEqual([inference.control("Order").disabled, inference.control("Start").disabled], [!order, !start], method);
    assert(inference.sees(word));
    inference.control("Method").put("block", "change");
    assert.deepEqual(last(desk), { method: "block" });
  }
  const [, surfaces] = panel(inferencePanel, { ...LOG, cells: "surface" });
  for (const name of ["Method", "Order", "Start"]) assert(!surfaces.sees(name));
  assert(!panel(modelPanel, { ...LOG, cells: "surface" })[1].sees("Prior P(wall)"));
});

test("a log has cells to choose and no noise to set; sizes that would make too many cells cannot be chosen", () => {
  const [desk, model] = panel(modelPanel, { ...LOG, source: { ...LOG.source!, bounds: [[0, 0], [120, 60]] } });
  for (const name of ["Noise (m)", "Angles", "Readings"]) assert(!model.sees(name), name);
  assert(model.sees("Cells") && model.sees("Prior P(wall)"));
  const sizes = model.control("Cell size");
  assert.deepEqual(sizes.children.map(({ value, disabled, textContent }) => [value, disabled, textContent]), [["0.05", true, "5 cm: too many cells"], ["0.1", true, "10 cm: too many cells"], ["0.2", false, "20 cm"], ["0.4", false, "40 cm"], ["0.8", false, "80 cm"], ["1", false, "1 m"]]);
  sizes.put("0.4", "change");
  assert.deepEqual(last(desk), { resolution: 0.4 });
  assert(!panel(modelPanel)[1].sees("Cell size"));
  assert(!panel(clearPanel, LOG)[1].sees("Clear walls"));
});

test("dragging along a log is coarse, and letting go is not", () => {
  const [desk, log] = panel(logPanel, LOG);
  const slider = log.control("Scans used");
  slider.put("7", "input");
  slider.put("5", "input");
  slider.put("5", "change");
  assert.deepEqual(desk.asked("set").map(({ patch, coarse }) => [patch.scans_used, coarse]), [[7, true], [5, true], [5, undefined]]);
  assert.equal(new Set(desk.asked("set").map(({ drag }) => drag)).size, 1);
  assert.match(log.text, /after 5 of 12/);
  slider.put("12", "change");
  assert.deepEqual(last(desk), { scans_used: null });
  assert.match(log.text, /all 12 scans/);
});

test("what a method that takes poses as known ignores is said", () => {
  const [desk, poses] = panel(posesPanel, { pose_sigma: 0.4 });
  assert.doesNotMatch(poses.text, /takes poses as known/);
  desk.confirm({ method: "propagate" });
  assert.match(poses.text, /This method takes poses as known; Gibbs does not/);
  const [log, choice] = panel(posesPanel, { ...LOG, poses: "odometry" });
  log.field({ method: "counts" });
  assert.match(choice.text, /Run infers where the robot was/);
  choice.control("Poses").put("logged", "change");
  assert.deepEqual(last(log), { poses: "logged" });
});

const draws = { draws: { chains: 2, count: 10 } };
const view = (ui: Ui, player = new Desk().player, scale = 30) => viewPanel(ui, player, { truth: true, rays: true, readings: true, strokes: true, trajectory: true }, () => scale);

test("walls have an entropy and numbers a width, and draws are offered where there may be some", () => {
  const [desk, layers] = panel((ui) => view(ui));
  const names = () => layers.find((one) => one.tagName === "label" && !one.hidden).map((one) => one.textContent);
  assert.deepEqual(names().slice(0, 3), ["Mean", "One draw", "Entropy"]);
  desk.field({ quantity: SURFACES });
  assert.deepEqual(names().slice(0, 3), ["Mean", "One draw", "Width"]);
  assert.deepEqual([layers.control("Draw number").disabled, layers.control("Draw number").title], [true, "There are no draws yet: chains keep them"]);
  assert.match(layers.text, /none kept/);
  desk.confirm({ method: "propagate" }); // it keeps none
  for (const name of ["One draw", "Draw number", "From the first sweep"]) assert(!layers.sees(name), name);
  desk.state(draws);
  assert.match(layers.text, /10 of 10/);
  assert(layers.sees("Draws over the mean"));
});

test("the slider of draws and the chains' list ask for that draw", () => {
  const desk = new Desk();
  const layers = new Panel(desk, (ui) => view(ui, desk.player));
  desk.state(draws);
  layers.control("Draw number").put("3", "input");
  assert.deepEqual(desk.asked("view").at(-1), { type: "view", layer: "draw", chain: 0, draw: 3 });
  layers.control("Chain").put("1", "change");
  assert.deepEqual(desk.asked("view").at(-1), { type: "view", layer: "draw", chain: 1, draw: 3 });
  layers.control("Speed").put("30", "change");
  assert.equal(desk.player.drawsPerSecond, 30);
});

test("surfaces that are too small to be drawn say so", () => {
  for (const [scale, words] of [[2.4, "Surfaces (zoom in)"], [2.5, "Surfaces"]] as const) {
    const [desk, layers] = panel((ui) => view(ui, undefined, scale), RUN);
    desk.says("overlay", {}, { strokes: new Float32Array(5), trajectory: new Float32Array(2) });
    assert(layers.sees(words));
  }
  assert(!panel((ui) => view(ui))[1].sees("Trajectory"));
});

test("the scans of a file are looked through one by one", () => {
  const [desk, scans] = panel(scanPanel, RUN);
  scans.control("Scan number").put("7", "input");
  assert.deepEqual(desk.asked("scan"), [{ type: "scan", index: 7 }]);
  assert.equal(panel(scanPanel)[1].text, "");
});

const themed = (ui: Ui) => legend(ui, () => THEMES.light as Theme, () => 30);
/** The legend that is seen: below it the same once more keeps the room. */
const named = (found: Panel) => found.find((one) => one.tagName === "ul")[0].innerText.replace(/\s+/g, " ");

test("the legend names what is on show, by the quantity's own words", () => {
  const [desk, found] = panel(themed);
  assert.match(named(found), /^P\(wall\) 0 1 true wall ray no return reading sensor unobserved/);
  desk.state({ view: { layer: "entropy", chain: null, draw: null } });
  assert.match(named(found), /^entropy \(bit\)/);
  desk.field({ quantity: SURFACES });
  desk.state({ view: { layer: "mean", chain: null, draw: null } });
  assert.match(named(found), /^mean reflectivity/);
  desk.field({ quantity: SURFACES, layer: "draw" });
  assert.match(named(found), /^reflectivity/);
  desk.state({ view: { layer: "width", chain: null, draw: null } });
  desk.field({ quantity: SURFACES, layer: "mean" }); // until there are intervals
  assert.match(named(found), /^mean reflectivity/);
  desk.field({ quantity: SURFACES, layer: "width" });
  assert.match(named(found), /^width of the 90 % interval/);
});

test("the legend names what each tool paints, while it does", () => {
  const [desk, found] = panel(themed);
  const { session } = desk;
  const seen = (words: string) => named(found).includes(words);
  const cases: [string, () => void, () => void][] = [
    ["predicted reading", () => session.ghost.hold(true), () => session.ghost.hold(false)],
    ["as wide as the robot", () => desk.says("path", { within_risk: true }), () => session.decisions.point({ x: 1, y: 1 })],
    ["speaks against it", () => (session.evidence.hold(true), session.evidence.pin({ x: 1, y: 1 })), () => session.evidence.hold(false)],
    ["possible pose", () => (session.where.follow(true, 1), desk.says("where", { modes: [{}] })), () => session.where.follow(false, 1)],
    ["one more scan tells 0 7.0 nats", () => (session.decisions.look(true), desk.says("views", {}, { pose: new Float32Array(6), nats: Float32Array.of(7, 2) })), () => session.decisions.look(false)],
    ["surface", () => desk.says("overlay", {}, { strokes: new Float32Array(5), trajectory: new Float32Array(2) }), () => desk.confirm()],
  ];
  for (const [words, come, go] of cases) {
    assert(!seen(words), words);
    come();
    assert(seen(words), words);
    go();
    assert(!seen(words), words);
  }
});

test("room is kept for all that may come to be named, and for nothing that may not", () => {
  const room = (document: Partial<MapDocument>, recorded = false) => {
    const [desk, found] = panel(themed, document);
    desk.session.recorded = recorded;
    found.text; // refreshed
    return found.find((one) => one.className === "room")[0].innerText;
  };
  for (const words of ["possible pose", "speaks for it", "one more scan tells", "predicted reading", "this draw", "true wall"]) assert(room({}).includes(words), words);
  for (const words of ["surface (zoom in)", "trajectory"]) assert(room(RUN).includes(words) && !room({}).includes(words), words);
  assert(!room(RUN).includes("true wall"));
  for (const words of ["possible pose", "predicted reading", "path, as wide"]) assert(!room(RUN, true).includes(words), words);
});

test("help and share speak of what is open", () => {
  const said = (document: Partial<MapDocument>, quantity?: Quantity) => {
    const [desk, found] = panel((ui) => helpDialog(ui) as HTMLElement, document);
    if (quantity) desk.field({ quantity });
    return found.text;
  };
  const cases: [string, string[], string[]][] = [
    [said({}), ["Draw walls", "draw, erase, sensor", "run, cancel", "Shift or the right"], ["this log", "saved run"]],
    [said(LOG), ["scans of this log", "run, cancel", "pan, path"], ["Draw walls", "draw, erase", "add, remove", "Shift or the right"]],
    [said(RUN, SURFACES), ["saved run", "(width)", "pan, path"], ["Draw walls", "draw, erase", "run, cancel", "(entropy)"]],
  ];
  for (const [text, wanted, unwanted] of cases) {
    for (const words of wanted) assert(text.includes(words), words);
    for (const words of unwanted) assert(!text.includes(words), words);
  }
  const share = (document: Partial<MapDocument>) => panel((ui) => shareDialog(ui).dialog as HTMLElement, document)[1].text;
  assert.match(share({}), /holds the walls/);
  assert.match(share(LOG), /but no scans/);
});

test("a new map is of the size that was typed", () => {
  const [desk, found] = panel((ui) => newDialog(ui) as HTMLElement);
  found.control("World").put("building", "change");
  assert.equal(found.control("Width (cells)").value, "120"); // a building needs room
  found.control("Width (cells)").put("40");
  found.control("Height (cells)").put("30");
  found.control("World").put("blank", "change");
  found.find((one) => one.tagName === "form")[0].dispatch("submit");
  assert.deepEqual(desk.asked("new"), [{ type: "new", shape: [40, 30], world: "blank" }]);
});

const top = (ui: Ui) => head(ui).element;
test("what there is to save is offered: a run where draws were kept, or none are needed", () => {
  const [desk, found] = panel(top);
  const name = "Saved run (netCDF)";
  assert.equal(found.control(name).disabled, true);
  desk.state(draws);
  assert.equal(found.control(name).disabled, false);
  desk.state({});
  desk.field({ method: "importance" });
  assert.equal(found.control(name).disabled, false);
  found.control("Export").click();
  assert.equal(found.control("Export").getAttribute("aria-expanded"), "true");
  found.control("Map for robots (YAML and PGM)").click();
  assert.deepEqual(desk.commands, ["export map"]);
  assert.equal(found.control("Export").getAttribute("aria-expanded"), "false");
});

test("the menu of exports closes when the focus leaves it, and not where a click on it gives the focus to what is around it", () => {
  const [, found] = panel(top);
  const [anchor] = found.find(({ className }) => className === "anchor") as (Element & { tabIndex?: number })[];
  const isOpen = () => found.control("Export").getAttribute("aria-expanded");
  assert.equal(anchor.tabIndex, -1);
  found.control("Export").click();
  found.control("Map for robots (YAML and PGM)").dispatch("focusout", { relatedTarget: anchor });
  assert.equal(isOpen(), "true");
  found.control("Map for robots (YAML and PGM)").dispatch("focusout", { relatedTarget: null });
  assert.equal(isOpen(), "false");
});

test("a recording offers neither edits, nor runs, nor what needs a server", () => {
  const desk = new Desk(RUN);
  desk.says("welcome", { recorded: true });
  desk.confirm();
  const [tops, tools, buttons] = [top, bar, (ui: Ui) => posteriorPanel(ui)].map((make) => new Panel(desk, make));
  for (const name of ["Undo", "Redo", "New map", "Share", "Saved run (netCDF)"]) assert(!tops.sees(name), name);
  tops.control("Export").click();
  assert(tops.sees("Picture (PNG)"));
  for (const name of ["Draw", "Path"]) assert(!tools.sees(name), name);
  for (const name of ["Run", "Cancel", "Live"]) assert(!buttons.sees(name), name);
});

test("tools that draw are offered where there is something to draw on", () => {
  const [, drawn] = panel(bar);
  const [, log] = panel(bar, LOG);
  for (const name of ["Draw", "Erase", "Sensor"]) assert(drawn.sees(name) && !log.sees(name), name);
  const seen = (found: Panel) => ["Draw", "Erase", "Sensor", "Pan", "Where am I?", "Path", "Evidence", "Look next", "Ghost"].filter((name) => found.sees(name));
  assert.deepEqual(seen(drawn), ["Draw", "Erase", "Sensor", "Pan", "Where am I?"]); // at first use
  assert.deepEqual(seen(log), ["Pan", "Where am I?", "Path", "Evidence", "Look next"]);
  drawn.control("More tools").click();
  assert.equal(seen(drawn).length, 9);
  assert.equal(seen(panel(bar)[1]).length, 9); // the browser remembers
  drawn.control("Fewer tools").click();
  assert.equal(seen(drawn).length, 5);
  assert(log.control("Pan").checked); // what is in the hand is none of a log's
});

test("the bar at the top names the file and its cells", () => {
  assert.match(panel(top, LOG)[1].text, /^bayesmap room.log, 21 \u00d7 21 cells of 1 m/);
  const [desk, found] = panel(top);
  assert.equal(found.control("Undo").disabled, true);
  desk.state({ can_undo: true });
  found.control("Undo").click();
  assert.deepEqual(desk.asked("undo"), [{ type: "undo" }]);
});

test("the theme is the system's until another is chosen, and the choice is remembered", () => {
  browser.kept.clear();
  browser.dark = true;
  const app = new Element("div");
  const names: string[] = [];
  const choice = () => new ThemeChoice(app as unknown as HTMLElement, (name) => names.push(name));
  const first = choice();
  first.dress();
  assert.equal(app.dataset.theme, "dark");
  for (const theme of ["light", "dark", "dark"]) {
    first.next();
    assert.equal(app.dataset.theme, theme);
  }
  assert.deepEqual(names, ["automatic", "light", "dark", "automatic"]);
  first.next();
  choice().dress();
  assert.equal(names.at(-1), "light");
  browser.kept.set("bayesmap-theme", "none such");
  choice().dress();
  assert.equal(names.at(-1), "automatic");
});
