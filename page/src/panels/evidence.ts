// What beams say of the cell that was clicked, in words and one by one.

import { signed } from "../layers/evidence";
import type { Session } from "../state/session";
import { h, put } from "./dom";
import type { Ui } from "./ui";

const LISTED = 8;

export function evidencePanel(ui: Ui) {
  const { session, hand } = ui;
  const said = h("p", { className: "words", role: "status" });
  const list = h("ol", { className: "spoken" });
  const section = ui.section("Evidence of beams", said, list);
  let listed = -1;
  ui.visible(section, () => hand.tool === "evidence");
  ui.each(() => {
    const { evidence } = session;
    put(said, "textContent", words(session));
    if (listed === evidence.version) return;
    listed = evidence.version;
    const { nats, scan, beam } = evidence.each ?? { nats: [], scan: [], beam: [] };
    const lines = Array.from(nats.slice(0, LISTED), (each, i) => h("li", {}, `${signed(each)} nats: ${nameOf(session, scan[i], beam[i])}`));
    list.replaceChildren(...lines);
  });
  return section;
}

const nameOf = ({ document, editable }: Session, scan: number, beam: number) =>
  `beam ${beam + 1} of ${editable ? `sensor ${document?.sensors[scan]?.id ?? scan + 1}` : `scan ${scan + 1}`}`;

function words({ evidence, quantity }: Session) {
  const { cell, together } = evidence;
  if (!cell) return "Click a cell to see which beams speak for what is there (blue) and which against it (orange), in nats each.";
  const name = `Cell ${cell.x}, ${cell.y}`;
  if (!together) return `${name}: asking its beams.`;
  if (!together.beams) return `${name}: no beam reaches it.`;
  const beams = together.beams === 1 ? "1 beam" : `${together.beams} beams`;
  if (together.nats_for === null || together.nats_against === null) return `${name}: ${beams}; there are no draws to ask what they say.`;
  const what = { binary: "a wall", surface: "its surface" }[quantity.kind] ?? "what is there";
  const silent = together.beams_for || together.beams_against ? "" : " None of them says anything.";
  return (
    `${name}: ${beams}. For ${what} (blue) ${together.beams_for}, ${together.nats_for.toFixed(1)} nats; ` +
    `against (orange) ${together.beams_against}, ${together.nats_against.toFixed(1)} nats.${silent}`
  );
}
