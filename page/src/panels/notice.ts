// What is said on and under the map: the chip, the banner, the status line and the read-out of a cell.

import { centreOf, entropyBits } from "../geometry/cells";
import type { Field, Patch, Point } from "../protocol";
import type { Session } from "../state/session";
import { figure, h, mark, put } from "./dom";
import { isFitting, verdictNames } from "./posterior";
import type { Ui } from "./ui";

const REFUSED =
  "The server was started again, with another address. Open the address that it has printed: this page then goes on with it, and the map is kept here.";

/** Of fewer sweeps more are the remedy, whatever the method. */
const FEWEST_SWEEPS = 200;

/** What beams are said to speak for and against. */
const OF_WALLS = "For and against a wall: the log ratio of each beam's likelihood with a wall in the cell and without, summed over the beams that it makes likelier, and less likely";
const OF_STOPS =
  "For and against what is there: how much likelier each beam's reading is under the draws of the map than under the same draws with this cell emptied (log ratio), summed over the beams that it makes likelier, and less likely";
const NEIGHBOURS = "Emptied means without the surface that the cell owns: where a neighbour's surface explains the same readings, they say little of this one.";

/** Says on the map itself what is shown, that the quick answer is approximate, and that chains have not converged. */
export function chip(ui: Ui) {
  const { session } = ui;
  const what = h("span", { className: "chip" });
  const remedy = ui.button(null, "Not converged", () => tryRemedy(session)?.apply?.(), { text: "Not converged", className: "chip doubt" });
  const judged = h("span", { className: "chip judged" });
  const element = h("div", { className: "chips" }, what, judged, remedy);
  ui.each(() => {
    const known = session.where.map !== null;
    const found = known ? null : tryRemedy(session);
    put(remedy, "hidden", !found);
    if (found) {
      const words = [verdictNames(session).bad, found.text].filter(Boolean).join(": ");
      put(remedy.firstElementChild as HTMLElement, "textContent", words.charAt(0).toLowerCase() + words.slice(1));
      put(remedy, "title", `${session.shown?.verdict?.why}.${found.apply ? ` Click to ${found.text}.` : ""}`);
      put(remedy, "disabled", !found.apply);
      mark(remedy, "aria-label", words);
    }
    const field = session.shown;
    const figures = known || !field || field.approximate || field.layer === "draw" ? [] : [Number.isFinite(field.rhat) && `R-hat ${figure(field.rhat, 3)}`, Number.isFinite(field.ess) && `ESS ${figure(field.ess, 0)}`];
    put(judged, "textContent", figures.filter(Boolean).join(" \u00b7 "));
    put(judged, "hidden", !judged.textContent);
    if (!field || !session.document) return put(element, "hidden", true);
    put(element, "hidden", false);
    if (known) {
      put(what, "textContent", "known map: the walls as drawn");
      return put(what, "className", "chip");
    }
    const numbered = session.draws.count ? `draw ${session.draw + 1} of ${session.draws.count}` : "draw";
    const kind = field.layer === "draw" ? numbered + (session.flicker.under ? " over the mean" : "") : field.layer === "width" ? "width of the 90 % interval" : session.view.layer === "entropy" ? "entropy" : "mean";
    if (field.method === "counts") {
      const along = session.halfway ? "along poses found so far" : "along raw odometry";
      put(what, "textContent", `hits and passes \u00b7 ${session.stage ? session.stage.text.toLowerCase() : along}`);
      return put(what, "className", "chip approximate");
    }
    const other = { importance: "importance sampling", propagate: "belief propagation", none: "the prior" }[field.method];
    const until = session.document.method === "importance" && field.method === "propagate" ? ", until Run weighs particles" : "";
    const by = field.approximate ? `approximate, ${quick(field, session.working)}${until}` : (other ?? `${field.sweeps} sweep${field.sweeps === 1 ? "" : "s"}`);
    put(what, "textContent", `${kind} \u00b7 ${by}`);
    put(what, "className", field.approximate ? "chip approximate" : "chip");
  });
  return element;
}

/** What a quick answer is made of. */
function quick({ method, sweeps, total, averaged }: Field, working: boolean) {
  if (method === "hits") return "counts of hits";
  if (method !== "pilot") return "belief propagation";
  const draws = averaged === 1 ? "1 draw" : `${averaged} draws`;
  return `${draws} of one chain, sensor ${working ? "being" : "half"} fitted: sweep ${sweeps} of ${total}`;
}

/** What to do where the result on show is bad, and no way where nothing can be done here; null where it is not bad. */
function tryRemedy(session: Session): { text: string; apply?: () => void } | null {
  const { shown, document } = session;
  if (shown?.verdict?.level !== "bad" || !document) return null;
  if (session.recorded || document.source.kind === "run") return { text: "" };
  const set = (patch: Patch) => () => session.act({ type: "set", patch });
  const few = shown.sweeps < FEWEST_SWEEPS;
  const sure = document.pose_sigma === 0 && document.heading_sigma === 0; // else sweeps help, and blocks do not
  if (shown.method === "gibbs" && document.source.kind === "simulation" && !few && sure) return { text: "try blocks", apply: set({ method: "block" }) };
  if (shown.method === "importance") return { text: "try Gibbs", apply: set({ method: "auto" }) };
  if (shown.sweeps < shown.total) return null; // it goes on, or was cancelled
  const sweeps = Math.min(session.limits?.sweeps[1] ?? 0, Math.max(FEWEST_SWEEPS, 4 * document.sweeps));
  return sweeps > document.sweeps ? { text: `try ${sweeps} sweeps`, apply: set({ sweeps }) } : { text: "" };
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
    const offline = session.connection.refused ? REFUSED : wait;
    put(text, "textContent", lost ? offline : "The worker stopped and is being started again. The map is kept.");
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
    const { kind } = session.quantity;
    put(readout, "title", kind === "binary" ? OF_WALLS : kind === "surface" ? `${OF_STOPS}. ${NEIGHBOURS}` : OF_STOPS);
    const cell = hand.cursor ?? hand.hover;
    const fingers = matchMedia("(pointer: coarse)").matches;
    const idle = fingers ? "Touch a cell" : session.editable ? "Point at a cell, or press ? for the keys" : "Point at a cell";
    put(readout, "textContent", cell ? describeCell(session, cell) : idle);
    const doubt = session.status.text === "Ready" && session.shown?.verdict?.level === "bad" && !session.where.map;
    const fitting = session.status.text === "Ready" && isFitting(session);
    const bad = session.shown?.method === "importance" ? "Ready, but importance sampling has collapsed" : "Ready, but the chains have not converged";
    const lost = session.everConnected && !session.connection.connected && session.status.level === "info";
    put(status, "textContent", lost ? "Connection lost" : doubt ? bad : fitting ? "Fitting the sensor" : session.status.text);
    put(status, "className", lost ? "error" : doubt ? "warning" : fitting ? "busy" : session.status.level);
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
  const { map } = session.where;
  if (map) parts.push(map.p[i] ? "wall, as drawn" : "free, as drawn");
  else if (shown && shown.p.length === shape[0] * shape[1]) {
    const p = shown.p[i] / 255;
    const { kind, mean, value, interval } = session.quantity;
    if (shown.layer === "width") parts.push(`90 % interval ${p.toFixed(2)} wide`);
    else if (kind !== "binary" && shown.layer === "draw") parts.push(`${value} ${p.toFixed(2)} in this draw`);
    else if (kind !== "binary") parts.push(`${mean} ${p.toFixed(2)}`, ...(interval ? [] : [`entropy ${entropyBits(p).toFixed(2)} bit`]));
    else if (shown.layer === "draw") parts.push(p > 0.5 ? "wall in this draw" : "free in this draw");
    else parts.push(`P(wall) ${p.toFixed(2)}`, `entropy ${entropyBits(p).toFixed(2)} bit`);
    const about = session.evidence.facts;
    const facts = about?.x === cell.x && about.y === cell.y ? about : null;
    const beams = facts ? facts.beams : null;
    const reached = shown.reached[i] / 255;
    const whole = document.source.kind === "run"; // of a saved run only the half is known
    if (!reached) parts.push(whole ? "reached by a beam in less than half of the draws" : "unobserved");
    else if (!whole && reached < 0.995) parts.push(`reached with probability ${reached.toFixed(2)}`);
    if (reached && beams !== null) parts.push(beams === 1 ? "1 beam" : `${beams} beams`);
    if (reached && facts && facts.nats_for !== null && facts.nats_against !== null && beams) {
      const what = { binary: "a wall", surface: "its surface" }[session.quantity.kind] ?? "what is there";
      parts.push(`for ${what} ${facts.beams_for}, ${facts.nats_for.toFixed(1)} nats`, `against ${facts.beams_against}, ${facts.nats_against.toFixed(1)} nats`);
    }
  }
  return parts.join(" \u00b7 ");
}
