// Sensors, model, method: what the document holds besides the walls.

import { LIMITS } from "../protocol";
import { h, put } from "./dom";
import type { Ui } from "./ui";

const METHODS = {
  gibbs: "Gibbs, cell by cell",
  block: "Gibbs, 2 \u00d7 2 blocks",
  propagate: "Belief propagation",
  importance: "Importance sampling",
};
const ORDERS = { raster: "raster", radial: "radial", random: "random" };
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
  });
  const numbers = h("div", { className: "triple" }, place("x (m)", "x"), place("y (m)", "y"), heading);
  return ui.section("Sensors", h("div", { className: "buttons" }, list, add, remove), numbers);
}

export function modelPanel(ui: Ui) {
  const { session } = ui;
  const [least, most] = LIMITS.max_range;
  const range = ui.numberInput("Longest range (m)", () => session.document?.max_range ?? 0, (max_range) => ui.set({ max_range }), { min: least, max: most, step: "any" });
  const simulated = [
    ui.slider("noise", () => "Noise (m)", { low: LIMITS.noise[0], high: LIMITS.noise[1], step: 0.01, unit: " m" }),
    ui.slider("angles", () => "Angles", { low: LIMITS.angles[0], high: LIMITS.angles[1], step: 1, log: true }),
    range,
  ];
  for (const element of simulated) ui.visible(element, () => session.editable);
  const prior = ui.slider("prior", () => "Prior P(wall)", { low: LIMITS.prior[0], high: LIMITS.prior[1], step: 0.01 });
  return ui.section("Model", prior, ...simulated);
}

export function inferencePanel(ui: Ui) {
  const { session } = ui;
  const method = () => session.document?.method ?? "gibbs";
  const [least, most] = LIMITS.seed;
  return ui.section(
    "Inference",
    ui.select("Method", METHODS, method, (value) => ui.set({ method: value })),
    ui.select("Order", ORDERS, () => session.document?.order ?? "radial", (order) => ui.set({ order }), () => method() === "gibbs"),
    ui.slider("sweeps", () => UNITS[method()] ?? "Sweeps", { low: LIMITS.sweeps[0], high: LIMITS.sweeps[1], step: 1, log: true }),
    ui.numberInput("Seed", () => session.document?.seed ?? 0, (seed) => ui.set({ seed: Math.round(seed) }), { min: least, max: most, step: 1 }),
  );
}

export function clearPanel(ui: Ui) {
  const { session } = ui;
  const walls = ui.button(null, "Clear walls", () => session.act({ type: "clear", what: "walls" }), { text: "Clear walls", when: () => session.editable });
  const inference = ui.button(null, "Clear inference", () => session.act({ type: "clear", what: "inference" }), { text: "Clear inference" });
  return ui.section("Clear", h("div", { className: "buttons" }, walls, inference));
}
