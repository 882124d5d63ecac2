// The ghost: a fan between the ends of the 80 % interval of each beam, its medians, and the scan that was taken nearby.

import { clamp, toCells } from "../geometry/cells";
import type { Fan, NearScan, Pose } from "../state/ghost";
import { clipToMap, strokeOnHalo, type Layer, type Scene } from "./layer";
import { placeOf } from "./sensors";

const ARROW = [[1.25, 0], [-0.9, 0.8], [-0.45, 0], [-0.9, -0.8]] as const;

export class GhostLayer implements Layer {
  readonly name = "ghost";

  depends({ session }: Scene) {
    return [session.ghost.version, session.document?.grid.resolution, session.document?.max_range];
  }

  shows({ session: { ghost, document } }: Scene) {
    return Boolean(ghost.held && ghost.pose && document);
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { ghost } = scene.session;
    if (!ghost.held || !ghost.pose || !scene.session.document) return;
    clipToMap(context, scene);
    if (ghost.fan) {
      const medians = this.fan(context, scene, ghost.fan);
      if (ghost.fan.near) this.near(context, scene, ghost.fan, ghost.fan.near);
      context.fillStyle = scene.look.theme.ghost;
      context.fill(medians);
    }
    this.robot(context, scene, ghost.pose);
  }

  /** The places at some range along each beam; no return is taken for the longest range. */
  private ends({ session, view }: Scene, pose: Pose, angles: Float32Array, ranges: Float32Array) {
    const { grid, max_range } = session.document as NonNullable<typeof session.document>;
    return Array.from(angles, (angle, i) => {
      const range = clamp(ranges[i], 0, max_range);
      const heading = pose.yaw + angle;
      const world = { x: pose.x + range * Math.cos(heading), y: pose.y + range * Math.sin(heading) };
      return view.fromGrid(toCells(world, grid), grid.shape[1]);
    });
  }

  /** Paints the bars, and returns the medians. */
  private fan(context: CanvasRenderingContext2D, scene: Scene, fan: Fan) {
    const { theme } = scene.look;
    const [low, median, high] = [fan.low, fan.median, fan.high].map((ranges) => this.ends(scene, fan, fan.angles, ranges));
    const { grid } = scene.session.document as NonNullable<typeof scene.session.document>;
    const from = scene.view.fromGrid(toCells(fan, grid), grid.shape[1]);
    // what the laser sees through: up to where one reading in ten ends
    const seen = new Path2D();
    seen.moveTo(from.x, from.y);
    for (const { x, y } of low) seen.lineTo(x, y);
    seen.closePath();
    context.fillStyle = theme.ghost;
    context.globalAlpha = 0.1;
    context.fill(seen);
    // one stroke a beam from the tenth to the ninetieth hundredth: where neighbours agree they make a band
    const bars = new Path2D();
    const dots = new Path2D();
    const radius = clamp(scene.view.transform.scale * 0.12, 1.2, 3);
    for (let i = 0; i < low.length; i++) {
      bars.moveTo(low[i].x, low[i].y);
      bars.lineTo(high[i].x, high[i].y);
      if (Number.isFinite(fan.median[i])) dots.rect(median[i].x - radius, median[i].y - radius, 2 * radius, 2 * radius);
    }
    context.strokeStyle = theme.ghost;
    context.lineCap = "round";
    context.lineWidth = clamp(scene.view.transform.scale * 0.25, 2, 5);
    context.globalAlpha = 0.4;
    context.stroke(bars);
    context.globalAlpha = 1;
    return dots;
  }

  /** The hits of a scan that was taken nearby, as rings beside the fan. */
  private near(context: CanvasRenderingContext2D, scene: Scene, fan: Fan, { pose, ranges, hit }: NearScan) {
    const { theme } = scene.look;
    const radius = clamp(scene.view.transform.scale * 0.14, 1.5, 4);
    const ends = this.ends(scene, { x: pose[0], y: pose[1], yaw: pose[2] }, fan.angles, ranges);
    const rings = new Path2D();
    ends.forEach(({ x, y }, i) => {
      if (!hit[i]) return;
      rings.moveTo(x + radius, y);
      rings.arc(x, y, radius, 0, 2 * Math.PI);
    });
    context.lineWidth = 1;
    context.strokeStyle = theme.truth;
    context.stroke(rings);
  }

  private robot(context: CanvasRenderingContext2D, { session, view, look }: Scene, pose: Pose) {
    const { grid } = session.document as NonNullable<typeof session.document>;
    const { point, size, handle } = placeOf({ id: 0, ...pose }, grid, view);
    const [cos, sin] = [Math.cos(pose.yaw), -Math.sin(pose.yaw)];
    context.beginPath();
    context.moveTo(point.x, point.y);
    context.lineTo(handle.x, handle.y);
    strokeOnHalo(context, look.theme, look.theme.ghost, 1.5);
    context.beginPath();
    for (const [a, b] of ARROW) context.lineTo(point.x + size * (a * cos - b * sin), point.y + size * (a * sin + b * cos));
    context.closePath();
    context.lineJoin = "round";
    strokeOnHalo(context, look.theme, look.theme.ghost, 2);
    context.fillStyle = look.theme.halo;
    context.fill();
    context.beginPath();
    context.arc(handle.x, handle.y, 4.5, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}
