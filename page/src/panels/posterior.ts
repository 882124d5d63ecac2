// Run, cancel, how far it is, and how good it is.

import type { Field } from "../protocol";
import type { Session } from "../state/session";
import { sentence } from "../state/status";
import { figure, h, put } from "./dom";
import type { Ui } from "./ui";

/** Rounds of a stage of the trajectory's inference are fewer, scans are more. */
const ROUNDS = 20;
const UNITS: { [method: string]: string } = { importance: "particles", propagate: "rounds" };

/** Whether the sensor is being fitted, before there are chains. */
export const isFitting = ({ working, shown }: Session) => working && shown?.method === "pilot";

export function posteriorPanel(ui: Ui, ...charts: HTMLElement[]) {
  const { session } = ui;
  const progress = h("progress", { max: 1, value: 0, "aria-label": "Progress" });
  const doing = h("div", { className: "doing" });
  ui.each(() => {
    const field = session.shown;
    const { stage } = session;
    // what is on show may be the answer to the last question
    const old = field?.generation !== session.generation && (session.running || session.document?.source.kind === "log");
    const fitting = isFitting(session);
    const share = stage ? stage.done / stage.total : field && !old && field.total > 0 && (fitting || !field.approximate) ? field.sweeps / field.total : 0;
    put(progress, "value", share);
    const left = session.remaining_s();
    const unit = UNITS[field?.method ?? ""] ?? "sweeps";
    const done = field && !field.approximate && field.total ? `${field.sweeps} of ${field.total} ${unit}` : "";
    const state = left !== null ? (left < 1 ? "less than 1 s left" : `${Math.ceil(left)} s left`) : session.running ? "running" : "";
    const burned = done && field?.burned ? `burn-in of ${field.burned} left out` : "";
    const count = session.sampling || session.running || !field || field.sweeps >= field.total ? "" : "stopped";
    if (stage) put(doing, "textContent", `${stage.text}: ${stage.done} of ${stage.total} ${stage.total > ROUNDS ? "scans" : "rounds"}`);
    else if (old) put(doing, "textContent", "Computing");
    else if (field && fitting) put(doing, "textContent", `Fitting the sensor: sweep ${field.sweeps} of ${field.total}`);
    else put(doing, "textContent", sentence([done, burned, state, done && count].filter(Boolean).join(", ")) || idle(session));
  });
  const aside = h("p", { className: "caption", textContent: "Where am I? takes the walls as drawn. What follows here is about walls that are not known." });
  ui.visible(aside, () => session.where.map !== null);
  return ui.section("Posterior", aside, buttons(ui), progress, doing, ...figures(ui), verdict(ui), ...charts, about(ui));
}

/** Whether the method that was chosen has chains: importance sampling and belief propagation of walls have none. */
const hasChains = ({ document }: Session) => !/importance|propagate/.test(document?.method ?? "") || (document?.cells ?? "binary") !== "binary";

/** Where there are no sweeps to count. */
function idle({ shown, working, document, nothingToRun, recorded }: Session) {
  const runs = !recorded && document?.source.kind !== "run"; // else there is no Run
  const next = runs && document?.method === "importance" ? "; Run weighs particles" : runs && nothingToRun ? "; it is done, and Run has nothing to add" : "";
  if (shown?.method === "propagate") return `${shown.sweeps ? `${shown.sweeps} rounds of belief` : "Belief"} propagation${next}`;
  if (shown?.method === "hits") return "Counts of hits and passes";
  if (shown?.method === "counts") return "Run infers where the robot was";
  if (shown?.method === "pilot") return "Stopped while the sensor was fitted";
  return working ? "Computing" : "No chain yet";
}

/** What Run does. */
function runWords({ document, shown, draws }: Session) {
  if (shown?.method === "counts") return "infer where the robot was, then sample maps";
  if (document?.cells === "binary" && document.method === "importance") return "weigh particles";
  if (document?.cells === "binary" && document.method === "propagate") return "belief propagation";
  return draws.count ? "more sweeps of the chains on show" : "sample maps";
}

function buttons(ui: Ui) {
  const { session } = ui;
  const run = ui.button("play", "Run", () => session.act({ type: "run" }), {
    className: "primary",
    text: "Run",
    title: () => `Run (R): ${runWords(session)}`,
    when: () => session.connection.connected && !session.nothingToRun,
    why: () => session.nothingToRun || "Not while the connection is lost",
  });
  const cancel = ui.button("close", "Cancel", () => session.act({ type: "cancel" }), {
    text: "Cancel",
    title: "Cancel (Escape)",
    when: () => session.running || session.sampling || isFitting(session),
    why: "Nothing is running",
  });
  const live = ui.checkbox(
    "Live",
    () => Boolean(session.state?.live ?? true),
    (on) => session.act({ type: "live", on }),
    "Infer anew after every edit; Run goes on from the draws that are kept",
  );
  const element = h("div", { className: "buttons" }, run, cancel, live);
  ui.visible(element, () => !session.recorded && session.document?.source.kind !== "run");
  return element;
}

function figures(ui: Ui) {
  const { session } = ui;
  const values = h("dl");
  const meanings = h("dl", { className: "about" });
  const add = (label: string, title: string, read: (field: Field) => string, { judged = false, ofChains = false } = {}) => {
    const value = h("dd", { textContent: "\u2013" });
    const name = h("dt", { textContent: label });
    const entry = h("div", { title }, name, value);
    values.append(entry);
    if (judged) ui.named.push({ name: () => label, place: entry, control: entry });
    const meaning = [h("dt", { textContent: label }), h("dd", { textContent: title })];
    meanings.append(...meaning);
    if (ofChains) for (const part of [entry, ...meaning]) ui.visible(part, () => hasChains(session));
    ui.each(() => {
      put(value, "textContent", session.shown ? read(session.shown) : "\u2013");
      if (judged) put(value, "className", session.shown?.verdict?.level ?? "");
    });
    return { entry, name };
  };
  add("ESS", "Effective sample size of the log joint: so many independent draws would tell as much of its mean", (field) => figure(field.ess, 0), { judged: true });
  add("R-hat", "Agreement of the chains on the log joint: 1 where they agree, more where each still tells of its start", (field) => figure(field.rhat, 3), { judged: true, ofChains: true });
  const joint = add("log joint", "Log of prior times likelihood: of the draw on show, or the mean over the chains at the last sweep", (field) => figure(field.log_joint, Math.abs(field.log_joint ?? 0) < 1e5 ? 1 : 0), { ofChains: true });
  add("time", "Time spent on sweeps, rounds or particles", (field) => figure(field.seconds, 1, " s"));
  ui.each(() => put(joint.name, "textContent", `log joint, ${session.layer === "draw" ? "draw" : "mean"}`));
  const reply = add("reply", "From the hand's last move to its picture", () => figure(session.latency.eventToPaint_ms.at(-1), 0, " ms"));
  ui.visible(reply.entry, () => !session.recorded);
  // a title needs a mouse; this opens by a tap and by a key, too
  return [values, h("details", {}, h("summary", { textContent: "What these figures mean" }), meanings)];
}

/** What a verdict is called: importance sampling has no chains that could converge. */
export const verdictNames = ({ shown }: Session) =>
  shown?.method === "importance"
    ? { good: "Enough particles", fair: "Few particles", bad: "Collapsed" }
    : { good: "Converged", fair: "Nearly converged", bad: "Not converged" };

/** The method, prior, sensor and poses of what is shown. */
function about(ui: Ui) {
  const { session } = ui;
  const list = h("dl", { className: "about" });
  const element = h("details", {}, h("summary", { textContent: "Model and method of this picture" }), list);
  let known = "";
  ui.each(() => {
    const rows = session.shown?.about ?? [];
    put(element, "hidden", !rows.length);
    if (String(rows) === known) return;
    known = String(rows);
    list.replaceChildren(...rows.flatMap(([name, words]) => [h("dt", { textContent: name }), h("dd", { textContent: words })]));
  });
  return element;
}

/** The verdict in words. */
function verdict(ui: Ui) {
  const { session } = ui;
  const text = h("span");
  const show = ui.button(null, "Show the cell", () => ui.command(`cell ${session.shown?.verdict?.cell}`), { text: "Show the cell" });
  ui.visible(show, () => Boolean(session.shown?.verdict?.cell));
  const element = h("div", { className: "verdict" }, text, show);
  ui.each(() => {
    const found = session.shown?.verdict;
    if (!found) {
      // what stands below does not jump while chains begin anew
      put(element, "hidden", element.hidden || !session.working);
      put(text, "textContent", "Too early to judge.");
      return put(element, "className", "verdict early");
    }
    put(element, "hidden", false);
    put(text, "textContent", `${verdictNames(session)[found.level]}: ${found.why}`);
    put(element, "className", `verdict ${found.level}`);
  });
  return element;
}
