// What colours and marks mean.

import { entropyRgb, gradient, probabilityRgb, type Theme } from "../colour";
import { figure, h, put } from "./dom";
import { icon } from "./icons";
import type { Ui } from "./ui";

const ENTRIES = [
  ["truth", "true wall"],
  ["ray", "ray"],
  ["miss", "no return"],
  ["dot", "reading"],
  ["sensor", "sensor"],
  ["stroke", "surface"],
  ["trajectory", "trajectory"],
  ["draw", "this draw"],
  ["ghost", "predicted reading"],
  ["belief", "possible pose"],
  ["place", "95 % of a place"],
  ["path", "path, as wide as the robot"],
  ["unobserved", "unobserved"],
];

export function legend(ui: Ui, theme: () => Theme) {
  const { session } = ui;
  const ramp = h("span", { className: "ramp" });
  const name = h("span");
  const entries = ENTRIES.map(([className, text]) => {
    const sample = h("i", { className });
    if (className === "sensor") sample.append(icon("sensor"));
    return h("li", {}, sample, text);
  });
  ui.visible(entries[0], () => !session.document || session.document.source.kind === "simulation");
  ui.visible(entries[ENTRIES.findIndex(([name]) => name === "stroke")], () => Boolean(session.overlay?.strokes.length));
  ui.visible(entries[ENTRIES.findIndex(([name]) => name === "trajectory")], () => Boolean(session.overlay?.trajectory.length));
  const entry = (wanted: string) => entries[ENTRIES.findIndex(([name]) => name === wanted)];
  ui.visible(entry("draw"), () => Boolean(session.flicker.under));
  ui.visible(entry("ghost"), () => session.ghost.held || session.reading.picked !== null);
  ui.visible(entry("belief"), () => Boolean(session.where.found));
  ui.visible(entry("place"), () => Boolean(session.where.found));
  ui.visible(entry("path"), () => Boolean(session.decisions.path));
  ui.each(() => entry("path").firstElementChild?.classList.toggle("risky", session.decisions.path?.within_risk === false));
  let painted = "";
  ui.each(() => {
    const { layer } = session;
    const { kind, mean, value } = session.quantity;
    const chance = kind === "binary" ? "P(wall)" : layer === "draw" ? value : mean;
    put(name, "textContent", layer === "entropy" ? "entropy (bit)" : layer === "width" ? "width of the 90 % interval" : chance);
    const doubt = layer === "entropy" || layer === "width";
    const key = `${doubt} ${theme().ground}`;
    if (painted === key) return;
    painted = key;
    ramp.style.background = gradient(doubt ? entropyRgb : (t) => probabilityRgb(theme(), t));
  });
  return h("ul", { className: "legend", "aria-label": "Legend" }, h("li", {}, name, "0", ramp, "1"), views(ui), ...entries);
}

/** What the dots say that show where to look next. */
function views(ui: Ui) {
  const { decisions } = ui.session;
  const ramp = h("span", { className: "ramp" });
  ramp.style.background = gradient(entropyRgb);
  const [least, most] = [h("span"), h("span")];
  const element = h("li", { className: "views" }, "one more scan tells", least, ramp, most);
  ui.visible(element, () => decisions.looking && Boolean(decisions.views?.nats.length));
  ui.each(() => {
    const nats = decisions.views?.nats;
    if (!nats?.length) return;
    put(least, "textContent", figure(Math.min(...nats), 1));
    put(most, "textContent", `${figure(Math.max(...nats), 1)} nats`);
  });
  return element;
}
