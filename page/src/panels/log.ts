// Of a log: from how many of its scans the map is made, and on cells of which size.

import { focused, h, mark, put } from "./dom";
import type { Ui } from "./ui";

const SIZES_M = [0.05, 0.1, 0.2, 0.4, 0.8];
const words = (metres: number) => (metres < 1 ? `${+(100 * metres).toPrecision(3)} cm` : `${+metres.toPrecision(3)} m`);

/** The edge of a cell; sizes that would make too many cells cannot be chosen. */
export function cellSize(ui: Ui) {
  const { session } = ui;
  const select = h("select", { onchange: () => session.act({ type: "set", patch: { resolution: Number(select.value) } }) });
  let known = "";
  ui.each(() => {
    const { grid, source } = session.document ?? {};
    if (!grid || source?.kind !== "log" || !source.bounds) return;
    const [low, high] = source.bounds;
    const side = Math.max(high[0] - low[0], high[1] - low[1]);
    const sizes = [...new Set([...SIZES_M, grid.resolution])].sort((a, b) => a - b);
    const [, most] = ui.limits("side_of_log");
    if (known !== `${sizes} ${most}`) {
      known = `${sizes} ${most}`;
      const isTooSmall = (size: number) => side / size > most - 1;
      const option = (size: number) => h("option", { value: String(size), textContent: words(size) + (isTooSmall(size) ? ": too many cells" : ""), disabled: isTooSmall(size) });
      select.replaceChildren(...sizes.map(option));
    }
    put(select, "value", String(grid.resolution));
  });
  const row = ui.row("Cell size", select);
  ui.visible(row, () => session.document?.source.kind === "log");
  return row;
}

/** A scrubber along the log: counts of hits while the hand drags, the posterior when it lets go. */
export function logPanel(ui: Ui) {
  const { session } = ui;
  const slider = h("input", { type: "range", min: 1, step: 1, "aria-label": "Scans used" });
  const count = h("output");
  const all = () => session.document?.source.scans ?? 0;
  const send = (coarse: boolean) => {
    const used = Number(slider.value);
    ui.scrub(used >= all() ? null : used, coarse);
  };
  slider.addEventListener("input", () => send(true));
  slider.addEventListener("change", () => {
    send(false);
    ui.endDrag();
  });
  const section = ui.section("Log", h("div", { className: "player bare" }, slider, count));
  ui.visible(section, () => !session.recorded && session.document?.source.kind === "log" && all() > 1);
  ui.each(() => {
    const scans = all();
    const used = session.document?.scans_used ?? scans;
    put(slider, "max", String(Math.max(1, scans)));
    if (!focused(slider) || Number(slider.value) !== used) put(slider, "value", String(used));
    const text = used === scans ? `all ${scans} scans` : `after ${used} of ${scans}`;
    slider.style.setProperty("--fill", `${(100 * (used - 1)) / Math.max(1, scans - 1)}%`);
    mark(slider, "aria-valuetext", text);
    put(count, "textContent", text);
  });
  return section;
}
