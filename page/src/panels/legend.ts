// What colours and marks mean. Room is kept for whatever the hand may call forth, so that the map never moves under it.

import { entropyRgb, gradient, probabilityRgb, type Theme } from "../colour";
import { strokesShowAt } from "../layers/overlay";
import type { Layer } from "../protocol";
import type { Session } from "../state/session";
import { sentence } from "../state/status";
import { figure, h, put } from "./dom";
import { icon } from "./icons";
import type { Ui } from "./ui";

/** Scale of the map on show, in CSS pixels a cell. */
type Scale = () => number;
type Entry = {
  mark: string;
  text: string;
  /** Whether it is there, and whether it may come to be with what is open. */
  when?: (session: Session) => boolean;
  may?: (session: Session) => boolean;
};

const simulated = ({ document }: Session) => !document || document.source.kind === "simulation";
const asked = ({ answers }: Session) => answers;
/** Where strokes would be too small to tell apart, none are drawn. */
const FAR = "surface (zoom in)";

const ENTRIES: Entry[] = [
  { mark: "truth", text: "true wall", when: simulated, may: simulated },
  { mark: "ray", text: "ray" },
  { mark: "miss", text: "no return" },
  { mark: "dot", text: "reading" },
  { mark: "sensor", text: "sensor" },
  { mark: "stroke", text: "surface", when: ({ overlay }) => Boolean(overlay?.strokes.length), may: (session) => !simulated(session) },
  { mark: "trajectory", text: "trajectory", when: ({ overlay }) => Boolean(overlay?.trajectory.length), may: (session) => !simulated(session) },
  { mark: "unobserved", text: "unobserved" },
  { mark: "draw", text: "this draw", when: ({ flicker }) => Boolean(flicker.under) },
  { mark: "ghost", text: "predicted reading", when: ({ ghost, reading }) => ghost.held || reading.picked !== null, may: asked },
  { mark: "path", text: "path, as wide as the robot", when: ({ decisions }) => Boolean(decisions.path && decisions.pathShown), may: asked },
];
/** Of the tools Where am I? and Evidence alone: what one tool paints is never seen beside what another does. */
const PLACES: Entry[] = [
  { mark: "belief", text: "possible pose" },
  { mark: "place", text: "95 % of a place" },
];
const BEAMS: Entry[] = [
  { mark: "for", text: "speaks for it" },
  { mark: "against", text: "speaks against it" },
];

export function legend(ui: Ui, theme: () => Theme, scale: Scale) {
  const caption = h("p", { className: "sentence" });
  ui.each(() => put(caption, "textContent", captionOf(ui.session)));
  return h("div", { className: "legend" }, caption, list(ui, theme, scale), room(ui));
}

const counted = (n: number, word: string) => `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;

/** What one sees, in one sentence. */
export function captionOf(session: Session) {
  const { shown, document, layer, quantity, draws } = session;
  if (!shown || !document) return "";
  if (session.where.map) return "The walls as they are drawn: where a scan was taken is asked in a known map.";
  const { kind, mean, value } = quantity;
  // A chain that has not converged, and particles that have collapsed, give no draw of the posterior.
  const ofPosterior = shown.verdict?.level !== "bad";
  const oneMap = ofPosterior ? "One map drawn from the posterior" : /importance/.test(shown.method) ? "One particle" : "The map of one chain, which has not converged";
  const what = {
    mean: kind === "binary" ? "How probable a wall is in each cell" : sentence(`${mean}, cell by cell`),
    draw: `${oneMap}${kind === "binary" ? "" : `, by its ${value}`}${draws.count ? `, ${session.draw + 1} of ${draws.count}` : ""}`,
    entropy: "How uncertain each cell is, in bits", width: "How wide the 90 % interval of each cell is",
  }[layer];
  if (shown.method === "none") return `${what} before any reading: the prior.`;
  const { source, angles, sensors, scans_used } = document;
  const given = source.kind === "simulation" ? `${counted(angles * sensors.length, "beam")} of ${counted(sensors.length, "sensor")}` : counted(scans_used ?? source.scans, "scan");
  const quick = shown.method === "propagate" || shown.method === "pilot" || /hits|counts/.test(shown.method);
  const along = session.stage || session.halfway ? "the poses found so far" : "raw odometry";
  const by = shown.method === "counts" ? `, by counts along ${along}` : quick && shown.approximate ? ", approximately" : layer !== "draw" && shown.burned ? `, by sweeps ${shown.burned + 1} to ${shown.sweeps}` : "";
  return `${what}, given ${given}${by}${ofPosterior || layer === "draw" ? "" : ` (${/importance/.test(shown.method) ? "particles collapsed" : "chains not converged"})`}.`;
}

/** What is seen. */
function list(ui: Ui, theme: () => Theme, scale: Scale) {
  const { session } = ui;
  const ramp = h("span", { className: "ramp" });
  const name = h("span", { className: "name" });
  const [least, most] = [h("span"), h("span")];
  const entries = ENTRIES.map((entry) => {
    const [element, text] = item(entry);
    const { mark, when } = entry;
    if (when) ui.visible(element, () => when(session));
    if (mark === "stroke") ui.each(() => put(text, "textContent", strokesShowAt(scale()) ? entry.text : FAR));
    if (mark === "path") ui.each(() => element.firstElementChild?.classList.toggle("risky", session.decisions.path?.within_risk === false));
    return element;
  });
  const [places, beams] = [PLACES, BEAMS].map((entries) => entries.map((entry) => item(entry)[0]));
  for (const place of places) ui.visible(place, () => Boolean(session.where.found));
  for (const beam of beams) ui.visible(beam, () => Boolean(session.evidence.cellShown));
  let painted = "";
  ui.each(() => {
    const { layer } = session;
    put(name, "textContent", nameOf(session, layer));
    const doubt = layer === "entropy" || layer === "width";
    const states = isStates(session, layer);
    put(least, "textContent", states ? "free" : "0");
    put(most, "textContent", states ? "wall" : "1");
    const key = `${doubt} ${states} ${theme().ground}`;
    if (painted === key) return;
    painted = key;
    ramp.style.background = gradient(doubt ? entropyRgb : (t) => probabilityRgb(theme(), t), states);
  });
  return h("ul", { "aria-label": "Legend" }, h("li", {}, name, h("span", { className: "scale" }, least, ramp, most)), ...entries, views(ui), ...places, ...beams);
}

/** As much as may ever be seen with what is open, without being seen: it keeps the height. */
function room(ui: Ui) {
  const { session } = ui;
  const names = (["mean", "draw", "entropy", "width"] as const).map((layer) => {
    const name = h("span");
    ui.each(() => put(name, "textContent", nameOf(session, layer)));
    if (layer === "width") ui.visible(name, () => session.quantity.interval); // walls have none
    return name;
  });
  const entries = ENTRIES.map((entry) => {
    const [element, text] = item(entry);
    if (entry.mark === "stroke") text.textContent = FAR;
    const { may } = entry;
    if (may) ui.visible(element, () => may(session));
    return element;
  });
  const numbers = h("span", { className: "scale" }, "00.0", h("span", { className: "ramp" }), "000.0 nats");
  const lists = [PLACES, BEAMS].map((list) => h("ul", {}, ...list.map((entry) => item(entry)[0])));
  const either = [h("ul", {}, h("li", {}, "one more scan tells", numbers)), ...lists];
  const tool = h("li", { className: "either" }, ...either);
  ui.visible(tool, () => asked(session));
  const scale = h("span", { className: "scale" }, "free", h("span", { className: "ramp" }), "wall");
  return h("ul", { className: "room", "aria-hidden": "true" }, h("li", {}, h("span", { className: "name either" }, ...names), scale), ...entries, tool);
}

/** An entry, and the element of its words. */
function item({ mark, text }: Entry): [HTMLElement, HTMLElement] {
  const sample = h("i", { className: mark });
  if (mark === "sensor") sample.append(icon("sensor"));
  const words = h("span", { textContent: text });
  return [h("li", {}, sample, words), words];
}

/** Whether the cells on show have two states: a draw of walls. */
const isStates = ({ quantity }: Session, layer: Layer) => layer === "draw" && quantity.kind === "binary";

/** What the colours of a layer are. */
function nameOf({ quantity }: Session, layer: Layer) {
  const { kind, mean, value } = quantity;
  if (layer === "entropy") return "entropy (bit)";
  if (layer === "width") return "width of the 90 % interval";
  return kind === "binary" ? (layer === "draw" ? "cells of this draw" : "P(wall)") : layer === "draw" ? value : mean;
}

/** What the dots say that show where to look next. */
function views(ui: Ui) {
  const { decisions } = ui.session;
  const ramp = h("span", { className: "ramp" });
  ramp.style.background = gradient(entropyRgb);
  const [least, most] = [h("span"), h("span")];
  const element = h("li", { className: "views" }, "one more scan tells", h("span", { className: "scale" }, least, ramp, most));
  ui.visible(element, () => decisions.looking && Boolean(decisions.views?.nats.length));
  ui.each(() => {
    const nats = decisions.views?.nats;
    if (!nats?.length) return;
    put(least, "textContent", "0");
    put(most, "textContent", `${figure(Math.max(...nats), 1)} nats`);
  });
  return element;
}
