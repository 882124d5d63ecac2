// Run, cancel, how far it is, and how good it is.

import type { Field } from "../protocol";
import { sentence } from "../state/status";
import { figure, h, put } from "./dom";
import type { Ui } from "./ui";

const UNITS: { [method: string]: string } = { importance: "particles", propagate: "rounds" };

export function posteriorPanel(ui: Ui) {
  const { session } = ui;
  const progress = h("progress", { max: 1, value: 0, "aria-label": "Progress" });
  const doing = h("div", { className: "doing" });
  ui.each(() => {
    const field = session.shown;
    const share = field && field.total > 0 && !field.approximate ? field.sweeps / field.total : 0;
    put(progress, "value", share);
    const left = session.remaining_s();
    const unit = UNITS[field?.method ?? ""] ?? "sweeps";
    const done = field && !field.approximate && field.total ? `${field.sweeps} of ${field.total} ${unit}` : "";
    const state = left !== null ? (left < 1 ? "less than 1 s left" : `${Math.ceil(left)} s left`) : session.running ? "running" : "";
    put(doing, "textContent", sentence([done, state].filter(Boolean).join(", ")) || "No chain yet");
  });
  return ui.section("Posterior", buttons(ui), progress, doing, figures(ui), sparkline(ui));
}

function buttons(ui: Ui) {
  const { session } = ui;
  const run = ui.button("play", "Run", () => session.act({ type: "run" }), { className: "primary", text: "Run", title: "Run (R)" });
  const cancel = ui.button("close", "Cancel", () => session.act({ type: "cancel" }), {
    text: "Cancel",
    title: "Cancel (Escape)",
    when: () => session.running || session.sampling,
  });
  const live = ui.checkbox(
    "Live",
    () => Boolean(session.state?.live ?? true),
    (on) => session.act({ type: "live", on }),
    "Every edit restarts the chain",
  );
  const element = h("div", { className: "buttons" }, run, cancel, live);
  ui.visible(element, () => !session.recorded && session.document?.source.kind !== "run");
  return element;
}

function figures(ui: Ui) {
  const { session } = ui;
  const values = h("dl");
  const add = (label: string, title: string, read: (field: Field) => string) => {
    const value = h("dd", { textContent: "\u2013" });
    values.append(h("div", { title }, h("dt", { textContent: label }), value));
    ui.each(() => put(value, "textContent", session.shown ? read(session.shown) : "\u2013"));
  };
  add("ESS", "Effective sample size of the log joint", (field) => figure(field.ess, 0));
  add("R-hat", "Agreement of the chains on the log joint; 1 is full", (field) => figure(field.rhat, 3));
  add("log joint", "Log of prior times likelihood at the last sweep", (field) => figure(field.log_joint, 1));
  add("reply", "From the hand's last move to its picture", () => figure(session.latency.eventToPaint_ms.at(-1), 0, " ms"));
  return values;
}

/** The log joint by sweep. */
function sparkline(ui: Ui) {
  const { progress } = ui.session;
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "polyline");
  const attributes = { viewBox: "0 0 100 30", preserveAspectRatio: "none", class: "trace", role: "img", "aria-label": "Log joint by sweep" };
  for (const [name, value] of Object.entries(attributes)) svg.setAttribute(name, value);
  svg.append(line);
  let drawn = -1;
  ui.each(() => {
    const { joint } = progress;
    if (joint.length === drawn) return;
    drawn = joint.length;
    const points = joint.filter((_, i) => i % Math.ceil(joint.length / 200) === 0 || i === joint.length - 1);
    const values = points.map((point) => point[1]);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const [first, last] = [points[0]?.[0] ?? 0, points.at(-1)?.[0] ?? 1];
    const x = (sweep: number) => ((100 * (sweep - first)) / (last - first || 1)).toFixed(1);
    const y = (value: number) => (28 - (26 * (value - low)) / (high - low || 1)).toFixed(1);
    line.setAttribute("points", points.length > 1 ? points.map(([sweep, value]) => `${x(sweep)},${y(value)}`).join(" ") : "");
  });
  return svg;
}
