// The ghost in words and numbers.

import { sentence } from "../state/status";
import { figure, h, put } from "./dom";
import type { Ui } from "./ui";

const degrees = (rad: number) => Math.round((rad * 180) / Math.PI);

export function ghostPanel(ui: Ui) {
  const { session, hand } = ui;
  const { ghost } = session;
  // names of their own: those of sensors are on the page, too
  const number = (label: string, axis: "x" | "y") =>
    ui.numberInput(label, () => Number((ghost.pose?.[axis] ?? 0).toFixed(2)), (value) => ghost.move({ [axis]: value }), { step: "any" });
  const yaw = ui.numberInput("Ghost yaw (\u00b0)", () => degrees(ghost.pose?.yaw ?? 0), (value) => ghost.move({ yaw: (value * Math.PI) / 180 }), { step: 5 });
  const said = h("p", { className: "words ghosted" });
  const section = ui.section("Ghost", h("div", { className: "triple" }, number("Ghost x", "x"), number("Ghost y", "y"), yaw), said);
  ui.visible(section, () => hand.tool === "ghost");
  ui.each(() => put(said, "textContent", ghostWords(ui)));
  return section;
}

function ghostWords({ session }: Ui) {
  const { ghost } = session;
  if (ghost.trouble) return sentence(`${ghost.trouble}.`);
  if (!ghost.fan) return ghost.pose ? "Working out what its laser would read." : "Drag the ghost to see what its laser would read.";
  const { draws, low, high, near } = ghost.fan;
  const finite = Array.from(high, (end, i) => end - low[i]).filter(Number.isFinite).sort((a, b) => a - b);
  const width = finite.length ? `${figure(100 * finite[finite.length >> 1], 0)} cm wide at the median beam` : "as wide as the laser's range";
  const by = draws ? `${draws} draws of the map` : "the mean map, cells taken for independent";
  const beside = near
    ? ` Rings are the hits of scan ${near.index + 1}, taken ${figure(100 * near.away, 0)} cm from here, turned by ${degrees(near.turn)}\u00b0.`
    : "";
  return `Dots are predictive medians, bars the central 80 % interval, ${width}, by ${by}.${beside}`;
}
