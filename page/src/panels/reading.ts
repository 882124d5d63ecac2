// The reading under the pointer, in words: along its beam, and across and along the wall that it met.

import type { ComparedBeam } from "../messages";
import { figure, h, put } from "./dom";
import type { Ui } from "./ui";

/** A length in words: centimetres up to a metre. */
const length = (metres: number) => (Math.abs(metres) < 0.995 ? `${figure(100 * Math.abs(metres), 1)} cm` : `${figure(Math.abs(metres), 2)} m`);
const IDLE = "Point at a reading to compare it with what the posterior predicts of it.";
const PREPARING = ": preparing the comparison. The first one after an installation takes some seconds.";

export function readingPanel(ui: Ui) {
  const { session } = ui;
  const said = h("p", { className: "words reading", role: "status" });
  const section = ui.section("Reading", said);
  ui.visible(section, () => !session.recorded && Boolean(session.document) && session.document?.source.kind !== "simulation");
  ui.each(() => {
    const { picked, found, trouble, slow } = session.reading;
    const waiting = picked ? `Beam ${picked.beam + 1} of scan ${picked.scan + 1}${slow ? PREPARING : "."}` : IDLE;
    put(said, "textContent", trouble || (found ? readingWords(found) : waiting));
  });
  return section;
}

/** What is said of a reading. */
export function readingWords({ scan, beam, reading, range, low, median, high, residual, no_return, wall }: ComparedBeam) {
  const name = `Beam ${beam + 1} of scan ${scan + 1}`;
  const end = (value: number | null, otherwise: string) => (value === null ? otherwise : `${figure(value, 2)} m`);
  const law = `median ${end(median, "no return")}, 80 % between ${end(low, "too close")} and ${end(high, "no return")}`;
  if (reading === "none") return `${name} came back from nothing, which was predicted with probability ${figure(no_return ?? 0, 3)} (${law}).`;
  if (reading !== "hit" || range === null) return `${name} read nothing that says how far (${law}).`;
  const along = residual === null ? "" : `, ${length(residual)} ${residual < 0 ? "shorter" : "longer"} than the predicted median`;
  const first = `${name} read ${figure(range, 2)} m${along} (${law}).`;
  if (!wall) return first;
  const across = `${length(wall.across_m)} ${wall.across_m < 0 ? "behind" : "in front of"} the wall, which is ${length(wall.thickness_m)} thick`;
  const aside = `${length(wall.along_m)} to the ${wall.along_m < 0 ? "right" : "left"} along it from the middle of its surface`;
  return `${first} It ended ${across} (one standard deviation), and ${aside}; the beam met it at ${figure((wall.incidence_rad * 180) / Math.PI, 0)}\u00b0 from its normal.`;
}
