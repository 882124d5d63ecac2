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
  const odds = h("p", { className: "words" });
  const trace = h("canvas", { className: "trace", width: 296, height: 48, role: "img" });
  const caption = h("p", { className: "caption" });
  const section = ui.section("Evidence of beams", said, odds, list, trace, caption);
  let listed = -1;
  ui.visible(section, () => hand.tool === "evidence");
  ui.each(() => {
    const { evidence } = session;
    put(said, "textContent", words(session));
    if (listed === evidence.version) return;
    listed = evidence.version;
    put(odds, "textContent", oddsOf(session));
    const share = drawTrace(trace, evidence.each?.trace, session.draws.chains);
    put(trace, "hidden", !share.length);
    put(caption, "textContent", share.length ? `Share of draws so far with a wall, by draw: ${share.map((s, c) => `chain ${c + 1} ${s.toFixed(2)}`).join(", ")}` : "");
    const { nats, scan, beam } = evidence.each ?? { nats: [], scan: [], beam: [] };
    const lines = Array.from(nats.slice(0, LISTED), (each, i) => h("li", {}, `${signed(each)} nats: ${nameOf(session, scan[i], beam[i])}`));
    list.replaceChildren(...lines);
  });
  return section;
}

const nameOf = ({ document, editable }: Session, scan: number, beam: number) =>
  `beam ${beam + 1} of ${editable ? `sensor ${document?.sensors[scan]?.id ?? scan + 1}` : `scan ${scan + 1}`}`;

/** How evidence and log odds belong together. */
function oddsOf({ evidence: { together }, quantity, hasDraws }: Session) {
  if (!together?.beams || quantity.kind !== "binary" || together.nats_for === null || together.nats_against === null) return "";
  const { prior_nats: prior, log_odds: odds, draw, nats_for, nats_against } = together;
  if (draw === null || draw === undefined) return "Each beam is asked by itself, with the other cells as probable as they are: the sum is not the log odds of P(wall)." + (hasDraws ? " Show one draw for that." : "");
  if (prior === null || prior === undefined || odds === null || odds === undefined) return `Given all other cells of draw ${draw + 1}.`;
  const p = 1 / (1 + Math.exp(-odds));
  return `Given all other cells of draw ${draw + 1}: prior ${signed(prior)}, beams ${signed(nats_for - nats_against)}, together log odds ${signed(odds)}: Gibbs draws a wall with probability ${p.toFixed(3)}.`;
}

/** Draws the share of draws with a wall so far, a line a chain; returns the last shares. */
export function drawTrace(canvas: HTMLCanvasElement, states: Uint8Array | undefined, chains: number): number[] {
  const n = states && chains ? states.length / chains : 0;
  const context = n ? canvas.getContext("2d") : null;
  const style = context && getComputedStyle(canvas);
  context?.clearRect(0, 0, canvas.width, canvas.height);
  return Array.from({ length: n ? chains : 0 }, (_, c) => {
    let walls = 0;
    context?.beginPath();
    for (let i = 0; i < n; i++) {
      walls += states![c * n + i];
      context?.lineTo((canvas.width * (i + 0.5)) / n, 2 + (canvas.height - 4) * (1 - walls / (i + 1)));
    }
    if (context && style) context.strokeStyle = style.getPropertyValue(c ? "--truth" : "--ray") || "gray";
    context?.stroke();
    return walls / n;
  });
}

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
