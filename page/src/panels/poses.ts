// What is known of the poses: of a log whether they are raw odometry, of a drawn world how uncertain they are.

import { h, put } from "./dom";
import type { Ui } from "./ui";

const POSES = { logged: "as logged", odometry: "from raw odometry" };
const DEGREES = 180 / Math.PI;

export function posesPanel(ui: Ui) {
  const { session } = ui;
  const isLog = () => session.document?.source.kind === "log";
  const poses = ui.select("Poses", POSES, () => session.document?.poses ?? "logged", (value) => ui.set({ poses: value }));
  poses.classList.add("wide");
  ui.visible(poses, isLog);
  const uncertain = [
    ui.slider("pose_sigma", () => "Position \u00b1 (m)", { step: 0.05, unit: " m" }),
    ui.slider("heading_sigma", () => "Yaw \u00b1 (\u00b0)", { step: 0.5, unit: "\u00b0", scale: DEGREES }),
  ];
  for (const element of uncertain) ui.visible(element, () => session.editable);
  const remark = h("p", { className: "caption" });
  ui.each(() => {
    const { pose_sigma = 0, heading_sigma = 0, method = "auto" } = session.document ?? {};
    const raw = isLog() && session.document?.poses === "odometry" && session.shown?.method === "counts" && !session.running;
    const unused = session.editable && (pose_sigma > 0 || heading_sigma > 0) && !/auto|gibbs|block/.test(method);
    put(remark, "hidden", !unused && !raw);
    put(remark, "textContent", raw ? "Run infers where the robot was." : "This method takes poses as known; Gibbs does not.");
  });
  const section = ui.section("How well poses are known", poses, ...uncertain, remark);
  ui.visible(section, () => (session.editable && !session.figure) || (isLog() && !session.recorded));
  return section;
}
