// The tools of the hand, and zoom.

import { READING, type Tool } from "../input/hand";
import { h } from "./dom";
import type { Ui } from "./ui";

const TOOLS = [
  ["draw", "Draw", "draw"],
  ["erase", "Erase", "erase"],
  ["sensor", "Sensor", "sensor"],
  ["pan", "Pan", "pan"],
  ["path", "Path", "path"],
  ["look", "Look next", "look"],
  ["where", "Where am I?", "where"],
  ["ghost", "Ghost", "ghost"],
  ["evidence", "Evidence", "evidence"],
] as const;

export function bar(ui: Ui) {
  const { hand, session } = ui;
  const tools = ui.segmented<Tool>(
    "Tool",
    TOOLS,
    () => (session.editable || !session.document || READING.has(hand.tool) ? hand.tool : "pan"),
    (tool) => hand.choose(tool),
    (tool) => session.editable || (READING.has(tool) && !session.recorded) || tool === "pan",
  );
  ui.visible(tools, () => !session.recorded);
  TOOLS.forEach(([tool], i) => {
    if (!READING.has(tool)) ui.visible(tools.children[i] as HTMLElement, () => !session.document || session.editable);
  });
  return h(
    "div",
    { className: "bar" },
    tools,
    h("span", { className: "space" }),
    ui.button("minus", "Zoom out", () => ui.command("out"), { title: "Zoom out (\u2212)" }),
    ui.button("plus", "Zoom in", () => ui.command("in"), { title: "Zoom in (+)" }),
    ui.button("fit", "Whole map", () => ui.command("fit"), { title: "Whole map (0)" }),
  );
}
