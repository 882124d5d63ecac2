// Over the map of a run or a log: surfaces as strokes, and where the scans were taken.

import { clamp, toCells } from "../geometry/cells";
import { clipToMap, type Layer, type Scene } from "./layer";
import { UNUSED } from "./rays";

/** Strokes are drawn where cells are at least so large, in CSS pixels, as in bayesmap.viz.figure. */
const STROKES_FROM_SCALE = 2.5;
export const strokesShowAt = (scale: number) => scale >= STROKES_FROM_SCALE;

export class OverlayLayer implements Layer {
  readonly name = "overlay";

  depends({ session, look }: Scene) {
    return [session.overlay, look.strokes, look.trajectory, session.document?.grid.resolution, session.document?.scans_used];
  }

  shows({ session, look }: Scene) {
    return Boolean(session.overlay && session.document && (look.strokes || look.trajectory));
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, look } = scene;
    const { overlay, document } = session;
    if (!overlay || !document) return;
    clipToMap(context, scene);
    if (look.trajectory) this.trajectory(context, scene, overlay.trajectory);
    if (look.strokes && strokesShowAt(scene.view.transform.scale)) this.strokes(context, scene, overlay.strokes);
  }

  private trajectory(context: CanvasRenderingContext2D, { session, view, look }: Scene, places: Float32Array) {
    const grid = session.document?.grid;
    if (!grid) return;
    const scans = places.length / 2;
    const used = Math.min(scans, session.document?.scans_used ?? scans);
    context.strokeStyle = look.theme.sensor;
    context.lineWidth = 1;
    context.lineJoin = "round";
    for (const [first, last, alpha] of [[0, used, 0.6], [Math.max(0, used - 1), scans, 0.6 * UNUSED]]) {
      context.beginPath();
      for (let i = first; i < last; i++) {
        const at = view.fromGrid(toCells({ x: places[2 * i], y: places[2 * i + 1] }, grid), grid.shape[1]);
        context.lineTo(at.x, at.y);
      }
      context.globalAlpha = alpha;
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  private strokes(context: CanvasRenderingContext2D, { session, view, look }: Scene, strokes: Float32Array) {
    const grid = session.document?.grid;
    if (!grid) return;
    context.beginPath();
    for (let i = 0; i < strokes.length; i += 5) {
      const [x0, y0, x1, y1] = strokes.subarray(i, i + 4);
      const [from, to] = [view.fromGrid(toCells({ x: x0, y: y0 }, grid), grid.shape[1]), view.fromGrid(toCells({ x: x1, y: y1 }, grid), grid.shape[1])];
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
    }
    context.strokeStyle = look.theme.ray;
    context.lineCap = "round";
    context.lineWidth = clamp(view.transform.scale / 5, 0.8, 2.5);
    context.stroke();
  }
}
