// What is said on and under the map: the chip, the banner, the status line and the read-out of a cell.

import { centreOf, entropyBits } from "../geometry/cells";
import type { Point } from "../protocol";
import type { Session } from "../state/session";
import { h, put } from "./dom";
import type { Ui } from "./ui";

/** Says on the map itself what is shown, and that the quick answer is approximate. */
export function chip(ui: Ui) {
  const { session } = ui;
  const element = h("div", { className: "chip" });
  ui.each(() => {
    const field = session.shown;
    if (!field || !session.document) return put(element, "hidden", true);
    const numbered = session.draws.count ? `draw ${session.draw + 1} of ${session.draws.count}` : "draw";
    const kind = field.layer === "draw" ? numbered : session.view.layer === "entropy" ? "entropy" : "mean";
    const other = { importance: "importance sampling", propagate: "belief propagation" }[field.method];
    const by = field.approximate ? "approximate, belief propagation" : (other ?? `${field.sweeps} sweeps`);
    put(element, "hidden", false);
    put(element, "textContent", `${kind} \u00b7 ${by}`);
    put(element, "className", field.approximate ? "chip approximate" : "chip");
  });
  return element;
}

/** Says that the connection or the worker is lost. */
export function banner(ui: Ui) {
  const { session } = ui;
  const text = h("span");
  const retry = ui.button(null, "Reconnect now", () => session.transport.retry?.(), { text: "Reconnect now" });
  const element = h("div", { className: "banner", role: "alert", hidden: true }, text, retry);
  ui.each(() => {
    const lost = session.everConnected && !session.connection.connected;
    const seconds = Math.max(1, Math.round((session.connection.retryIn_ms ?? 0) / 1000));
    put(element, "hidden", !lost && session.worker !== "restarted");
    put(element, "className", lost ? "banner" : "banner mild");
    put(retry, "hidden", !lost);
    const wait = `Connection lost. Trying again in ${seconds} s; the map is kept here.`;
    put(text, "textContent", lost ? wait : "The worker stopped and is being started again. The map is kept.");
  });
  return element;
}

/** Status and read-out, and what is said to a screen reader alone. */
export function foot(ui: Ui) {
  const { session, hand } = ui;
  const readout = h("div", { className: "readout", id: `${ui.prefix}-readout` });
  const status = h("span", { role: "status", "aria-live": "polite" });
  const spoken = h("span", { className: "hidden", "aria-live": "polite" });
  hand.announce = (text) => put(spoken, "textContent", text);
  hand.describe = (cell) => describeCell(session, cell);
  ui.each(() => {
    const cell = hand.cursor ?? hand.hover;
    const keys = session.editable && !matchMedia("(pointer: coarse)").matches;
    const idle = keys ? "Point at a cell, or press ? for the keys" : "Point at a cell";
    put(readout, "textContent", cell ? describeCell(session, cell) : idle);
    put(status, "textContent", session.status.text);
    put(status, "className", session.status.level);
  });
  return { element: h("footer", {}, status, readout, spoken), readout };
}

/** What the read-out says of a cell. */
function describeCell(session: Session, cell: Point) {
  const { document, shown } = session;
  if (!document) return "";
  const { resolution, shape } = document.grid;
  const i = cell.x * shape[1] + cell.y;
  const digits = Math.max(1, Math.ceil(-Math.log10(resolution)) + 1);
  const { x, y } = centreOf(cell, document.grid);
  const parts = [`Cell ${cell.x}, ${cell.y}`, `${x.toFixed(digits)}, ${y.toFixed(digits)} m`];
  if (shown && shown.p.length === shape[0] * shape[1]) {
    const p = shown.p[i] / 255;
    if (shown.layer === "draw") parts.push(p > 0.5 ? "wall in this draw" : "free in this draw");
    else parts.push(`P(wall) ${p.toFixed(2)}`, `entropy ${entropyBits(p).toFixed(2)} bit`);
    const beams = session.cell?.x === cell.x && session.cell.y === cell.y ? session.cell.beams : null;
    if (!shown.observed[i]) parts.push("unobserved");
    else if (beams !== null) parts.push(beams === 1 ? "1 beam" : `${beams} beams`);
  }
  return parts.join(" \u00b7 ");
}
