// The readings: a line from the sensor to where each beam was read, and a dot there.

import { clamp, toCells } from "../geometry/cells";
import { clipToMap, type Layer, type Scene } from "./layer";

const ROUND_DOTS = 600;
/** Rays that are drawn; of more, every so many-th: thousands are but a haze, and take as long as all else. */
const MOST_RAYS = 1500;
/** Pixels: no canvas is so wide. */
const WIDEST = 1 << 16;
/** Opacity of what belongs to scans that are not used. */
export const UNUSED = 0.3;

export class RaysLayer implements Layer {
  readonly name = "rays";

  depends({ session, look }: Scene) {
    return [session.scan, session.document?.max_range, look.rays, look.readings, session.document?.scans_used];
  }

  shows({ session, look }: Scene) {
    // the ghost's fan, and a cell's beams, would be lost among them
    return Boolean(session.scan && session.document && (look.rays || look.readings) && !session.ghost.held && !session.evidence.cellShown);
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, view, look } = scene;
    const { scan, document } = session;
    if (!scan || !document) return;
    clipToMap(context, scene);
    const { scale } = view.transform;
    const cellsAMetre = 1 / document.grid.resolution;
    const ny = document.grid.shape[1];
    const beams = scan.angles.length;
    const count = scan.pose.length / 3;
    const every = Math.ceil((beams * count) / MOST_RAYS);
    const [hits, misses, dots] = [new Path2D(), new Path2D(), new Path2D()];
    const small = beams * count > ROUND_DOTS;
    const squares = new Map<number, { x: number; y: number }>();
    const radius = clamp(scale * 0.1, 1.3, 4);
    // of a log's scan that the map is not made of only a shadow is seen
    const used = document.scans_used ?? Infinity;
    const dim = (scan.index ?? 0) < used ? 1 : UNUSED;
    for (let s = 0; s < count; s++) {
      const [px, py, yaw] = scan.pose.subarray(3 * s, 3 * s + 3);
      const from = view.fromGrid(toCells({ x: px, y: py }, document.grid), ny);
      for (let b = 0; b < beams; b++) {
        const range = scan.ranges[s * beams + b];
        const hit = scan.hit[s * beams + b] === 1;
        const length = (hit ? range : document.max_range) * cellsAMetre * scale;
        const angle = scan.angles[b] + yaw;
        const to = { x: from.x + length * Math.cos(angle), y: from.y - length * Math.sin(angle) };
        const path = hit ? hits : misses;
        if ((s * beams + b) % every === 0) {
          path.moveTo(from.x, from.y);
          path.lineTo(to.x, to.y);
        }
        if (!hit) continue;
        // of the many that lie on one pixel one is enough
        if (small) squares.set(Math.round(to.x) * WIDEST + Math.round(to.y), to);
        else {
          dots.moveTo(to.x + radius, to.y);
          dots.arc(to.x, to.y, radius, 0, 2 * Math.PI);
        }
      }
    }
    if (look.rays) {
      context.lineWidth = 1;
      context.globalAlpha = dim * clamp(28 / Math.sqrt((beams * count) / every) / 5, 0.07, 0.45);
      context.strokeStyle = look.theme.ray;
      context.stroke(hits);
      context.strokeStyle = look.theme.noReturn;
      context.stroke(misses);
      context.globalAlpha = 1;
    }
    if (look.readings) {
      context.globalAlpha = dim;
      context.fillStyle = look.theme.ray;
      context.fill(dots);
      const side = 1.8 * radius;
      for (const { x, y } of squares.values()) context.fillRect(x - side / 2, y - side / 2, side, side);
      context.globalAlpha = 1;
    }
  }
}
