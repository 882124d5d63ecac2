// The cloud of poses from which a scan may have been taken, and its places with their probabilities.

import { toCells } from "../geometry/cells";
import type { Grid } from "../protocol";
import type { Place } from "../messages";
import { clipToMap, labelsOf, type Layer, type Scene } from "./layer";
import type { Labels } from "./text";

const DOT = 2.2;
const TICK = 7;
const [FAINTEST, STRONGEST] = [0.03, 0.75];
/** A place is ringed at 95 %, and so that it can be seen. */
const RADIUS_95 = 2.4477;
const SMALLEST_RING = 9;

export class WhereLayer implements Layer {
  readonly name = "where";

  depends({ session }: Scene) {
    return [session.where.version, session.document?.grid.resolution, session.document?.grid.origin.join()];
  }

  shows({ session }: Scene) {
    return Boolean(session.where.found && session.document);
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session } = scene;
    const { found } = session.where;
    const grid = session.document?.grid;
    if (!found || !grid) return;
    const labels = labelsOf(context, scene);
    context.save();
    clipToMap(context, scene);
    this.cloud(context, scene, grid);
    const rings = found.modes.map((place) => ({ place, ...this.ring(context, scene, grid, place, labels) }));
    for (const { place, at, short } of rings) labels.place(percent(place.probability), at.x, at.y, short); // the likeliest first: it has the best room
    context.restore();
    labels.write();
  }

  private cloud(context: CanvasRenderingContext2D, { session, view, look }: Scene, grid: Grid) {
    const { cloud, weight } = session.where.found!;
    const most = weight[weight.length - 1] || 1;
    context.strokeStyle = context.fillStyle = look.theme.belief;
    context.lineWidth = 1.2;
    for (let i = 0; i < weight.length; i++) {
      if (weight[i] < FAINTEST ** 2 * most) continue;
      const [x, y, yaw] = cloud.subarray(3 * i, 3 * i + 3);
      const at = view.fromGrid(toCells({ x, y }, grid), grid.shape[1]);
      context.globalAlpha = STRONGEST * Math.sqrt(weight[i] / most);
      context.beginPath();
      context.arc(at.x, at.y, DOT, 0, 2 * Math.PI);
      context.fill();
      context.beginPath();
      context.moveTo(at.x, at.y);
      context.lineTo(at.x + TICK * Math.cos(yaw), at.y - TICK * Math.sin(yaw));
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  private ring(context: CanvasRenderingContext2D, { view, look }: Scene, grid: Grid, place: Place, labels: Labels) {
    const [x, y, yaw] = place.mean;
    const at = view.fromGrid(toCells({ x, y }, grid), grid.shape[1]);
    const pixels = (RADIUS_95 * view.transform.scale) / grid.resolution;
    const [[a, b], [, d]] = place.covariance;
    const [middle, apart] = [(a + d) / 2, Math.hypot((a - d) / 2, b)];
    const [long, short] = [middle + apart, middle - apart].map((v) => Math.max(SMALLEST_RING, pixels * Math.sqrt(Math.max(v, 0))));
    context.beginPath();
    context.ellipse(at.x, at.y, long, short, -Math.atan2(2 * b, a - d) / 2, 0, 2 * Math.PI);
    const from = SMALLEST_RING + 1;
    context.moveTo(at.x + from * Math.cos(yaw), at.y - from * Math.sin(yaw));
    context.lineTo(at.x + (from + TICK) * Math.cos(yaw), at.y - (from + TICK) * Math.sin(yaw));
    context.strokeStyle = look.theme.halo;
    context.lineWidth = 4;
    context.stroke();
    context.strokeStyle = look.theme.belief;
    context.lineWidth = 2;
    context.stroke();
    labels.avoid(at, short);
    labels.avoid(at, 2, { x: at.x + (from + TICK) * Math.cos(yaw), y: at.y - (from + TICK) * Math.sin(yaw) });
    return { at, short };
  }
}

/** A probability as people read it. */
export const percent = (p: number) => (p > 0.995 && p < 1 ? "over 99 %" : p < 0.005 ? "under 1 %" : `${Math.round(100 * p)} %`);
