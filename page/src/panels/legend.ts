// What colours and marks mean.

import { entropyRgb, gradient, probabilityRgb, type Theme } from "../colour";
import { h, put } from "./dom";
import { icon } from "./icons";
import type { Ui } from "./ui";

const ENTRIES = [
  ["truth", "true wall"],
  ["ray", "ray"],
  ["miss", "no return"],
  ["dot", "reading"],
  ["sensor", "sensor"],
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
  let painted = "";
  ui.each(() => {
    const entropy = session.view.layer === "entropy";
    put(name, "textContent", entropy ? "entropy (bit)" : "P(wall)");
    const key = `${entropy} ${theme().ground}`;
    if (painted === key) return;
    painted = key;
    ramp.style.background = gradient(entropy ? entropyRgb : (t) => probabilityRgb(theme(), t));
  });
  return h("ul", { className: "legend", "aria-label": "Legend" }, h("li", {}, name, "0", ramp, "1"), ...entries);
}
