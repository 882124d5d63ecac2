// The tools of the hand, and zoom.

import { READING, type Tool } from "../input/hand";
import { allTools, showAllTools } from "../state/kept";
import { h, mark, put } from "./dom";
import type { Ui } from "./ui";

const TOOLS = [
  ["draw", "Draw", "draw"],
  ["erase", "Erase", "erase"],
  ["sensor", "Sensor", "sensor"],
  ["pan", "Pan", "pan"],
  ["where", "Where am I?", "where"],
  ["path", "Path", "path"],
  ["evidence", "Evidence", "evidence"],
  ["look", "Look next", "look"],
  ["ghost", "Ghost", "ghost"],
] as const;
/** At first use so many are shown, and the others by a button. */
const FIRST = 5;

export function bar(ui: Ui) {
  const { hand, session } = ui;
  const tools = ui.segmented<Tool>(
    "Tool",
    TOOLS,
    () => (session.editable || !session.document || READING.has(hand.tool) ? hand.tool : "pan"),
    (tool) => hand.choose(tool),
  );
  ui.visible(tools, () => !session.recorded);
  let all = allTools();
  const more = ui.button(null, "More tools", () => {
    showAllTools((all = !all));
    session.changed();
  }, { text: "More" });
  ui.visible(more, () => session.answers);
  ui.each(() => {
    const offered = TOOLS.filter(([tool]) => (READING.has(tool) ? !session.figure || tool === "pan" || tool === "where" : !session.document || session.editable)).map(([tool]) => tool);
    const first = new Set(all ? offered : offered.slice(0, FIRST));
    TOOLS.forEach(([tool], i) => put(tools.children[i] as HTMLElement, "hidden", !first.has(tool) && !(tool === hand.tool && offered.includes(tool))));
    put(more.lastElementChild as HTMLElement, "textContent", all ? "Fewer" : "More");
    mark(more, "aria-label", all ? "Fewer tools" : "More tools");
    put(more, "title", all ? "Fewer tools" : "More tools: paths, evidence, where to look next, the ghost");
  });
  return h(
    "div",
    { className: "bar" },
    tools,
    more,
    h("span", { className: "space" }),
    ui.button("minus", "Zoom out", () => ui.command("out"), { title: "Zoom out (\u2212)" }),
    ui.button("plus", "Zoom in", () => ui.command("in"), { title: "Zoom in (+)" }),
    ui.button("fit", "Whole map", () => ui.command("fit"), { title: "Whole map (0)" }),
  );
}
