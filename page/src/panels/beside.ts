// A result beside the one on show: the control that keeps it, and what stands under each of the two maps.

import type { Beside } from "../state/beside";
import type { Session } from "../state/session";
import { figure, h, put } from "./dom";
import { verdictNames } from "./posterior";
import type { Ui } from "./ui";

export function keepControl(ui: Ui, beside: Beside) {
  const { session } = ui;
  const title = "Change the method, the order, the prior or the map, and compare: both results follow the layer and the draw";
  const control = ui.checkbox("Keep this result beside the next", () => beside.kept !== null, (on) => (on ? beside.keep() : beside.forget()), title);
  ui.visible(control, () => session.locates && (beside.kept !== null || session.shown !== null));
  return control;
}

/** The words under the map on show, and under the kept one. */
export function besideCaptions(ui: Ui, beside: Beside) {
  const [now, kept] = [h("p", { className: "told-apart" }), h("p", { className: "told-apart" })];
  ui.visible(now, () => beside.kept !== null);
  ui.each(() => {
    if (!beside.kept) return;
    const [ours, theirs] = beside.differences();
    put(now, "textContent", `Now: ${ours}. ${figures(ui.session)}`);
    put(kept, "textContent", `Kept: ${theirs}. ${figures(beside.kept)}`);
  });
  return { now, kept };
}

/** How good a result is, and which draw is seen. */
function figures(session: Session) {
  const { shown, draws } = session;
  if (!shown) return "";
  const draw = shown.layer === "draw" ? [`Draw ${session.draw + 1} of ${draws.count}, log joint ${figure(shown.log_joint, 1)}`] : [];
  const judged = shown.verdict ? [verdictNames(session)[shown.verdict.level]] : [];
  const mixed = shown.rhat === null ? [] : [`R-hat ${figure(shown.rhat, 3)}, ESS ${figure(shown.ess, 0)}`];
  return [...draw, ...judged, ...mixed].map((words) => `${words}.`).join(" ");
}
