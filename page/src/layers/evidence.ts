// The beams through the cell that was clicked: blue where they speak for what is there, orange where against it.

import { clamp, toCells } from "../geometry/cells";
import type { Point } from "../protocol";
import { clipToMap, labelsOf, strokeOnHalo, type Layer, type Scene } from "./layer";

/** Beams whose nats are written beside them. */
const LABELLED = 5;
const [THINNEST, WIDEST] = [0.8, 5];
/** Nats whose beam is drawn at the greatest width. */
const LOUDEST = 6;

export class EvidenceLayer implements Layer {
  readonly name = "evidence";

  depends({ session }: Scene) {
    return [session.evidence.version, session.document?.grid.resolution, session.document?.grid.origin.join()];
  }

  shows({ session: { evidence, document } }: Scene) {
    return Boolean(evidence.cellShown && document);
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, view, look } = scene;
    const { cell, each } = session.evidence;
    const grid = session.document?.grid;
    if (!cell || !grid) return;
    context.save();
    clipToMap(context, scene);
    const at = (x: number, y: number) => view.fromGrid(toCells({ x, y }, grid), grid.shape[1]);
    const ends = (i: number): [Point, Point] => [at(each!.start[2 * i], each!.start[2 * i + 1]), at(each!.end[2 * i], each!.end[2 * i + 1])];
    const count = each?.nats.length ?? 0;
    context.lineCap = "round";
    for (let i = count - 1; i >= 0; i--) {
      const [from, to] = ends(i);
      const nats = each!.nats[i];
      context.beginPath();
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
      context.globalAlpha = clamp(0.25 + Math.abs(nats) / 2, 0, 0.9);
      context.lineWidth = clamp(WIDEST * Math.sqrt(Math.abs(nats) / LOUDEST), THINNEST, WIDEST);
      context.strokeStyle = nats > 0 ? look.theme.ray : look.theme.truth;
      context.stroke();
    }
    context.globalAlpha = 1;
    const { scale } = view.transform;
    const corner = view.fromGrid({ x: cell.x, y: cell.y + 1 }, grid.shape[1]);
    const margin = Math.max(1, 4 - scale / 2); // a small cell has a frame that can be seen
    context.beginPath();
    context.rect(corner.x - margin, corner.y - margin, scale + 2 * margin, scale + 2 * margin);
    strokeOnHalo(context, look.theme, look.theme.belief, 2);
    context.restore();
    const labels = labelsOf(context, scene);
    const labelled = Math.min(LABELLED, count);
    for (let i = 0; i < labelled; i++) labels.avoid(ends(i)[0], 2, ends(i)[1]);
    for (let i = 0; i < labelled; i++) {
      const [from, to] = ends(i);
      const along = 0.35 + 0.1 * i; // neighbouring beams are close
      labels.place(signed(each!.nats[i]), from.x + along * (to.x - from.x), from.y + along * (to.y - from.y), 3);
    }
    labels.write();
  }
}

/** Nats with their sign. */
export const signed = (nats: number) => `${nats < 0 ? "\u2212" : "+"}${Math.abs(nats).toFixed(1)}`;
