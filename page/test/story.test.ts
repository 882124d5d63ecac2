// Stories: the way through the steps, what the panel says, and what a figure answers to "Where was I?".

import { aDocument, LIMITS, panel, wallsOf } from "./desk";
import { Element, page } from "./dom";
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Story } from "../src/messages";
import { h } from "../src/panels/dom";
import { inferencePanel, modelPanel } from "../src/panels/settings";
import { storyPanel } from "../src/panels/story";
import type { Ui } from "../src/panels/ui";
import type { MapDocument, Pair } from "../src/protocol";
import { locate } from "../src/sampler/where";
import { beamsOf, rangesOf } from "../src/sampler/world";
import { linkedStep, namedIn, stepFragment } from "../src/state/story";

const [FIRST, SECOND, SOLVED] = [aDocument({ prior: 0.3 }), aDocument({ method: "importance" }), aDocument({ method: "block" })];
const STORY: Story = {
  title: "A story",
  steps: [
    { title: "One", text: "Seen.", task: "Do it.", document: FIRST, solution: null, layer: "mean", tool: "draw" },
    { title: "Two", text: "Also seen.", task: "Do that.", document: SECOND, solution: SOLVED, layer: "entropy", tool: "sensor" },
  ],
};

function told() {
  const [desk, shown] = panel(storyPanel);
  desk.says("welcome", { limits: LIMITS, recorded: false, figure: false, lacks: [], story: STORY });
  desk.ui.refresh();
  return { desk, shown, brought: () => desk.asked("hello").map(({ document }) => document).filter(Boolean) };
}

test("an address names a step, and a step an address", () => {
  assert.deepEqual(["#step=3", "#step=0", "#step=x", "#m=abc", ""].map(linkedStep), [2, 0, null, null, null]);
  assert.equal(linkedStep(stepFragment(4)), 4);
});

test("each step is a state of the page, with what is seen and one thing to do", () => {
  const { desk, shown, brought } = told();
  const { telling } = desk.session;
  const gone: number[] = [];
  telling.onstep = (at) => gone.push(at);
  assert.match(shown.text, /A story.*One.*Seen\..*Do it\./s);
  const titles = () => ["Back", "Next"].map((name) => [shown.control(name).disabled, shown.control(name).title]);
  assert.deepEqual(titles(), [[true, "This is the first step"], [false, "Next"]]);
  shown.control("Next").dispatch("click");
  assert.deepEqual(titles(), [[false, "Back"], [true, "This is the last step"]]);
  assert.match(shown.text, /Two.*Also seen\..*Do that\./s);
  assert.deepEqual([brought(), desk.asked("view").at(-1)!.layer, desk.asked("run").length], [[SECOND], "entropy", 1]);
  shown.control("Show me").dispatch("click");
  assert.deepEqual(brought().at(-1), SOLVED);
  shown.control("Start this step again").dispatch("click");
  assert.deepEqual(brought().at(-1), SECOND);
  telling.go(9);
  telling.go(-1);
  assert.deepEqual(gone, [1, 1, 1, 0]);
  assert.deepEqual(brought().at(-1), FIRST);
});

test("a task names controls by whole words, the longest name first, without units", () => {
  const names = ["Noise (m)", "Draw", "Draws over the mean", "Prior P(wall)", "Where am I?", "Add"];
  const named = (text: string) => namedIn(text, names).map(({ text, at }) => (at === null ? text : `<${names[at]}>`)).join("");
  assert.equal(named("Set Prior P(wall), under Model, to 0.3."), "Set <Prior P(wall)>, under Model, to 0.3.");
  assert.equal(named("Choose Draw, then Where am I? again."), "Choose <Draw>, then <Where am I?> again.");
  assert.equal(named("Tick Draws over the mean. Noise stays."), "Tick <Draws over the mean>. <Noise (m)> stays.");
  assert.equal(named("Drawing Additional noise"), "Drawing Additional noise");
  assert.deepEqual([namedIn("Do it.", []), namedIn("Add", names)], [[{ text: "Do it.", at: null }], [{ text: "Add", at: 5 }]]);
});

/** The story above the settings, in a panel 400 pixels high in which the control of a label lies 900 pixels down. */
function beside(task: string, label: string) {
  const steps = [STORY.steps[0], { ...STORY.steps[1], task }];
  const [desk, shown] = panel((ui: Ui) => h("aside", {}, storyPanel(ui), modelPanel(ui), inferencePanel(ui)));
  desk.says("welcome", { limits: LIMITS, recorded: false, figure: false, lacks: [], story: { ...STORY, steps } });
  const [aside] = shown.find(({ tagName }) => tagName === "aside");
  aside.box.height = 400;
  const [section] = shown.find(({ className }) => className === "story");
  section.box.height = 150;
  const row = shown.control(label).parent!;
  Object.defineProperty(row, "box", { get: () => ({ left: 0, top: 900 - aside.scrollTop, width: 300, height: 30 }) });
  const lead = () => shown.find(({ tagName, title }) => tagName === "button" && title === "Go to this control")[0] as Element;
  return { desk, shown, aside, section, row, lead };
}

test("the control that a step names is marked, and its name leads to it", () => {
  const { desk, shown, aside, row, lead } = beside("Set Prior P(wall) to 0.3.", "Prior P(wall)");
  assert.doesNotMatch(row.className, /named/);
  aside.scrollTop = 300;
  desk.session.telling.go(1);
  assert.match(shown.text, /Set Prior P\(wall\) to 0\.3\./);
  assert.match(row.className, /row slider named/);
  assert.equal(aside.scrollTop, 0); // where the step does not stay in view, it is read first
  lead().click();
  assert.equal(aside.scrollTop, 715); // in the middle
  assert.equal(page.activeElement, shown.control("Prior P(wall)", "range"));
  desk.session.telling.go(0);
  desk.ui.refresh();
  assert.doesNotMatch(row.className, /named/);
});

test("where a step stays in view, the control that it names is brought beneath it, until the reader does something", () => {
  const { desk, aside, section, row } = beside("Set Particles to 20 000.", "Sweeps");
  section.style.position = "sticky";
  desk.session.telling.go(1);
  desk.ui.refresh();
  assert.doesNotMatch(row.className, /named/); // until the step's method is there, they are sweeps
  desk.confirm(SECOND, { working: true });
  desk.ui.refresh();
  assert.match(row.className, /named/);
  assert.equal(aside.scrollTop, 640); // in the middle of what the step leaves
  Object.defineProperty(row, "box", { get: () => ({ left: 0, top: 1100 - aside.scrollTop, width: 300, height: 30 }) });
  desk.ui.refresh(); // a chart has come
  assert.equal(aside.scrollTop, 840);
  section.dispatch("wheel");
  aside.scrollTop = 500;
  desk.ui.refresh();
  assert.equal(aside.scrollTop, 500);
});

test("without Live a step is sampled all the same, and without a story nothing is told", () => {
  const { desk } = told();
  desk.session.act({ type: "live", on: false });
  desk.session.telling.go(0);
  assert.equal(desk.asked("live").at(-1)!.on, true);
  const [other, empty] = panel(storyPanel);
  other.session.telling.go(0);
  assert.deepEqual([other.asked("hello").filter(({ document }) => document).length, empty.sees("Next")], [0, false]);
});

const ROOM: Pair[] = [];
for (let i = 3; i <= 17; i++) ROOM.push([3, i], [17, i], [i, 3], [i, 17]);

function located(changes: Partial<MapDocument>, noise: (b: number) => number = () => 0) {
  const document = aDocument({ walls: wallsOf(ROOM), sensors: [{ id: 1, x: 6, y: 8, yaw: 0.5 }], ...changes });
  const exact = rangesOf(document, beamsOf(document));
  return locate(document, exact.map((range, b) => range + noise(b)), exact.map((range) => (range < document.max_range ? 1 : 0)));
}

test("a square room looks alike from four places, and a wall in its corner tells them apart", () => {
  const alike = located({}, (b) => 0.2 * Math.sin(7 * b)).modes;
  assert.equal(alike.length, 4);
  for (const { probability, sigma_m } of alike) assert(Math.abs(probability - 0.25) < 0.1 && sigma_m > 0.01 && sigma_m < 0.08);
  const known = new Set(alike.map(({ mean: [x, y] }) => `${Math.round(x)} ${Math.round(y)}`));
  assert.deepEqual(known, new Set(["6 8", "12 6", "14 12", "8 14"]));
  const { modes, weight, pose } = located({ walls: wallsOf([...ROOM, [4, 4], [5, 4], [4, 5]]) });
  assert.equal(modes.length, 1);
  [6, 8, 0.5].forEach((truth, i) => assert(Math.abs(modes[0].mean[i] - truth) < 0.05));
  assert(pose.length === 3 * weight.length && weight.every((one, i) => !i || one >= weight[i - 1]));
});

test("in an empty world the robot may be anywhere", () => {
  const { modes } = located({ walls: wallsOf([]) });
  assert(modes.length === 1 && modes[0].sigma_m > 2);
});

const world = (walls: string, at = { x: 10, y: 10 }) => aDocument({ walls, sensors: [{ id: 1, ...at, yaw: 0 }] });
const TUTORIAL = "AAAAAAAcAICgBAQAOCAAQQACDAA4IABBAAIIABBAAIPgfAECAAhwAEIAAhAAH4AAAAAAAAAAAAA=";
const HALL: Pair[] = [];
for (let i = 2; i <= 18; i++) HALL.push([2, i], [18, i], [i, 2], [i, 18]);
/** x, y, yaw, probability, sigma_m and sigma_rad of the places that bayesmap's `Locator` finds for exact readings. */
const LIBRARY: [MapDocument, number[][]][] = [
  [world(TUTORIAL), [[9.996, 10.003, -0.001, 1, 0.0186, 0.00259]]],
  [
    world(wallsOf(HALL), { x: 6, y: 8 }),
    [[8, 14, -1.571, 0.257, 0.0276, 0.00381], [12.001, 6.001, 1.571, 0.254, 0.0297, 0.0038], [6, 7.999, 0, 0.25, 0.0289, 0.00387], [14.001, 12, 3.141, 0.239, 0.029, 0.00391]],
  ],
];

test("places are those that the library finds", () => {
  for (const [document, places] of LIBRARY) {
    const { modes } = located(document);
    assert.equal(modes.length, places.length);
    for (const [x, y, yaw, probability, sigma_m, sigma_rad] of places) {
      const near = modes.find(({ mean }) => Math.hypot(mean[0] - x, mean[1] - y) < sigma_m && Math.abs(Math.sin(mean[2] - yaw)) < sigma_rad);
      assert(near && Math.abs(near.probability - probability) < 0.15, `${[x, y]} is not in ${JSON.stringify(modes)}`);
      for (const ratio of [near.sigma_m / sigma_m, near.sigma_rad / sigma_rad]) assert(ratio > 1 / 1.6 && ratio < 1.6, `${[x, y]}: ${ratio}`);
    }
  }
});
