// Sensors, model, method: what the document holds besides the walls.

import { h, put } from "./dom";
import { cellSize } from "./log";
import type { Ui } from "./ui";

const METHODS: Record<string, string> = {
  auto: "By the prior",
  gibbs: "Gibbs, cell by cell",
  block: "Gibbs, 2 \u00d7 2 blocks",
  propagate: "Belief propagation",
  importance: "Importance sampling",
};
const CELLS: Record<string, string> = { binary: "walls", reflectivity: "reflectivities", surface: "surfaces" };
const READINGS = { noisy: "with noise", exact: "exact" };
const STARTS: Record<string, string> = { auto: "as is best", prior: "draws of the prior", empty: "the empty map" };
const ORDERS: Record<string, string> = { raster: "raster", radial: "radial", random: "random" };
const FULL_CIRCLE = 2 * Math.PI;
const degrees = (rad: number) => Math.round((rad * 1800) / Math.PI) / 10;
const UNITS: { [method: string]: string } = { importance: "Particles", propagate: "Rounds" };

export function sensorPanel(ui: Ui) {
  const { session, hand, editor } = ui;
  const list = h("select", { "aria-label": "Selected sensor" });
  list.addEventListener("change", () => {
    hand.selected = Number(list.value);
    hand.choose("sensor");
  });
  let known = "";
  ui.each(() => {
    const sensors = session.document?.sensors ?? [];
    const ids = sensors.map((sensor) => sensor.id).join();
    if (ids !== known) list.replaceChildren(...sensors.map(({ id }) => h("option", { value: String(id), textContent: `Sensor ${id}` })));
    known = ids;
    put(list, "value", String(hand.sensor?.id ?? ""));
  });
  const place = (label: string, axis: "x" | "y") =>
    ui.numberInput(
      label,
      () => Number((hand.sensor?.[axis] ?? 0).toFixed(2)),
      (value) => hand.sensor && editor.moveSensor(hand.sensor, { [axis]: value }),
      { step: "any" },
    );
  const heading = ui.numberInput(
    "heading (\u00b0)",
    () => Math.round(((hand.sensor?.yaw ?? 0) * 180) / Math.PI),
    (value) => hand.sensor && editor.moveSensor(hand.sensor, { yaw: ((value % 360) * Math.PI) / 180 }),
    { step: 5 },
  );
  const add = ui.button("plus", "Add a sensor", () => ui.command("add"), { text: "Add" });
  const remove = ui.button("minus", "Remove the sensor", () => editor.removeSensor(), {
    text: "Remove",
    when: () => (session.document?.sensors.length ?? 0) > 1,
    why: "The last sensor stays",
  });
  // in a full circle all headings are alike
  ui.visible(heading, () => (session.document?.fov ?? FULL_CIRCLE) < FULL_CIRCLE);
  const numbers = h("div", { className: "triple" }, place("x (m)", "x"), place("y (m)", "y"), heading);
  return ui.section("Sensors", h("div", { className: "buttons" }, list, add, remove), numbers);
}

export function modelPanel(ui: Ui) {
  const { session } = ui;
  const range = ui.numberInput("Longest range (m)", () => session.document?.max_range ?? 0, (max_range) => ui.set({ max_range }), { step: "any", limits: "max_range" });
  const simulated = [
    ui.slider("noise", () => "Noise (m)", { step: 0.01, unit: " m" }),
    ui.slider("angles", () => "Angles", { step: 1, log: true }),
    range,
    ui.numberInput(
      "Field of view (\u00b0)",
      () => degrees(session.document?.fov ?? FULL_CIRCLE),
      (value) => ui.set({ fov: value >= 360 ? FULL_CIRCLE : (value * Math.PI) / 180 }),
      { step: 5, limits: "fov", scale: 180 / Math.PI },
    ),
    ui.select("Readings", READINGS, () => session.document?.readings ?? "noisy", (readings) => ui.set({ readings })),
  ];
  for (const element of simulated) ui.visible(element, () => session.editable);
  const prior = ui.slider("prior", () => "Prior P(wall)", { step: 0.01 });
  const isWalls = () => (session.document?.cells ?? "binary") === "binary";
  ui.visible(prior, isWalls);
  const cells = ui.select("Cells", CELLS, () => session.document?.cells ?? "binary", (kind) => ui.set({ cells: kind }));
  ui.visible(cells, () => session.document?.source.kind === "log");
  return ui.section("Model", cells, cellSize(ui), prior, ...simulated);
}

export function inferencePanel(ui: Ui) {
  const { session } = ui;
  const method = () => session.document?.method ?? "auto";
  const isWalls = () => (session.document?.cells ?? "binary") === "binary";
  const isChain = () => /auto|gibbs|block/.test(method());
  const ofWalls = [
    ui.select("Method", METHODS, method, (value) => ui.set({ method: value })),
    ui.select("Order", ORDERS, () => session.document?.order ?? "radial", (order) => ui.set({ order }), () => method() === "gibbs" || method() === "auto", "Only Gibbs, cell by cell, has an order"),
    ui.select("Start", STARTS, () => session.document?.start ?? "auto", (start) => ui.set({ start }), isChain, "Only chains have a start"),
  ];
  const options = Array.from((ofWalls[0].lastElementChild as HTMLSelectElement).children) as HTMLOptionElement[];
  for (const option of options) if (option.value === "propagate") ui.visible(option, () => !session.figure); // which samples, and nothing else
  const chosen: Record<string, string> = { gibbs: ": cell by cell", block: ": 2 \u00d7 2 blocks" };
  ui.each(() => put(options[0], "textContent", METHODS.auto + (method() === "auto" ? (chosen[session.shown?.method ?? ""] ?? "") : "")));
  ofWalls[0].classList.add("wide");
  for (const element of ofWalls) ui.visible(element, isWalls); // other cells have one sampler
  const burnIn = ui.slider("burn_in", () => "Burn-in (%)", { step: 5, scale: 100 });
  ui.visible(burnIn, () => isChain() || !isWalls());
  return ui.section(
    "Inference",
    ...ofWalls,
    burnIn,
    ui.slider("sweeps", () => UNITS[method()] ?? "Sweeps", { step: 1, log: true }),
    ui.numberInput("Seed", () => session.document?.seed ?? 0, (seed) => ui.set({ seed: Math.round(seed) }), { step: 1, limits: "seed" }),
  );
}

export function clearPanel(ui: Ui) {
  const { session } = ui;
  const walls = ui.button(null, "Clear walls", () => session.act({ type: "clear", what: "walls" }), { text: "Clear walls", when: () => session.editable });
  const inference = ui.button(null, "Clear inference", () => session.act({ type: "clear", what: "inference" }), { text: "Clear inference" });
  ui.visible(walls, () => session.editable); // a file has none
  return ui.section("Clear", h("div", { className: "buttons" }, walls, inference));
}
