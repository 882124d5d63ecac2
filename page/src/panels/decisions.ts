// What was found: the path and its probability, or the best place to look from next.

import { figure, h, put } from "./dom";
import type { Ui } from "./ui";

export function decisionsPanel(ui: Ui) {
  const { session, hand } = ui;
  const { decisions } = session;
  const said = h("p", { className: "said", role: "status" });
  const numbers = h(
    "div",
    { className: "double" },
    ui.numberInput("Robot's radius (m)", () => decisions.radius, (radius) => decisions.set({ radius }), { step: "any", limits: "radius" }),
    ui.numberInput("Highest risk", () => decisions.risk, (risk) => decisions.set({ risk }), { step: "any", limits: "risk" }),
  );
  const title = () => (hand.tool === "path" ? "Path" : "Where to look next");
  const section = ui.section("Decision", numbers, said);
  const heading = section.querySelector("h2") as HTMLElement;
  ui.visible(section, () => hand.tool === "path" || hand.tool === "look");
  ui.visible(numbers, () => hand.tool === "path");
  ui.each(() => {
    put(heading, "textContent", title());
    put(said, "textContent", hand.tool === "path" ? pathWords(ui) : viewWords(ui));
  });
  return section;
}

function pathWords({ session }: Ui) {
  const { start, goal, path, trouble } = session.decisions;
  if (trouble) return trouble;
  if (!start) return "Click where the robot is, then where it is to go.";
  if (!goal) return "Now click where it is to go.";
  if (!path) return session.shown?.approximate ? "Waiting for draws of the map." : "Looking for a path.";
  const missed = path.within_risk ? "" : " No path was found whose risk is low enough; this is the safest.";
  // where no draw, or each, is an exception: the rule of three
  const bound = Math.ceil(3000 / path.draws) / 1000;
  const sure = { 0: `in none of ${path.draws} draws: with probability under ${bound}`, 1: `in all ${path.draws} draws: with probability over ${figure(Math.max(0, 1 - bound), 3)}` }[path.probability];
  return (
    `${figure(path.length_m, 2)} m, free ${sure ?? `with probability ${figure(path.probability, 3)} \u00b1 ${figure(path.standard_error, 3)} by ${path.draws} draws`}` +
    `${sure ? " (95 %, were they independent)" : ""}. Independent cells would say ${figure(path.independent, 3)}.${missed}`
  );
}

function viewWords({ session }: Ui) {
  const { views, viewTrouble } = session.decisions;
  if (viewTrouble) return viewTrouble;
  if (!views) return "Working out how much a scan would tell.";
  const best = Math.max(...views.nats);
  const placed = session.editable ? " Click to place another sensor." : "";
  return `One more scan would tell ${figure(Math.min(...views.nats), 1)} to ${figure(best, 1)} nats, cells taken for independent; the best place has a ring.${placed}`;
}
