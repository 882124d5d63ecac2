// The path that was found, with all that the robot sweeps, and how much is to be learnt from where.

import { entropyRgb } from "../colour";
import { clamp, toCells } from "../geometry/cells";
import type { Point } from "../protocol";
import { figure } from "../panels/dom";
import { clipToMap, labelsOf, type Layer, type Scene } from "./layer";
import type { Labels } from "./text";

const LARGEST_DOT = 9;
const SMALLEST_DOT = 2.5;

export class DecisionsLayer implements Layer {
  readonly name = "decisions";

  depends({ session }: Scene) {
    return [session.decisions.version, session.document?.grid.resolution];
  }

  shows({ session: { decisions, document } }: Scene) {
    return Boolean(document && ((decisions.start && decisions.pathShown) || (decisions.looking && decisions.views)));
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session } = scene;
    if (!session.document) return;
    const labels = labelsOf(context, scene);
    context.save();
    clipToMap(context, scene);
    if (session.decisions.looking) this.views(context, scene, labels);
    if (session.decisions.pathShown) this.path(context, scene, labels);
    context.restore();
    labels.write();
  }

  private views(context: CanvasRenderingContext2D, { session, view, look }: Scene, labels: Labels) {
    const { views } = session.decisions;
    const grid = session.document?.grid;
    if (!views?.nats.length || !grid) return;
    const high = Math.max(...views.nats);
    const radius = clamp((0.38 * views.spacing * view.transform.scale) / grid.resolution, SMALLEST_DOT, LARGEST_DOT);
    const best = views.nats.indexOf(high);
    for (let i = 0; i < views.nats.length; i++) {
      const place = view.fromGrid(toCells({ x: views.pose[3 * i], y: views.pose[3 * i + 1] }, grid), grid.shape[1]);
      context.beginPath();
      context.arc(place.x, place.y, radius, 0, 2 * Math.PI);
      context.fillStyle = `rgb(${entropyRgb(clamp(views.nats[i] / Math.max(high, 1e-9), 0, 1)).map(Math.round)})`;
      context.fill();
      if (i !== best) continue;
      context.lineWidth = 2.5;
      context.strokeStyle = look.theme.truth;
      context.stroke();
      labels.place(`${figure(high, 1)} nats`, place.x, place.y, radius);
    }
  }

  private path(context: CanvasRenderingContext2D, { session, view, look }: Scene, labels: Labels) {
    const { start, goal, path, radius } = session.decisions;
    const grid = session.document?.grid;
    if (!grid || !start) return;
    const at = (place: Point) => view.fromGrid(toCells(place, grid), grid.shape[1]);
    if (path) {
      context.beginPath();
      for (const [x, y] of path.path) {
        const place = at({ x, y });
        context.lineTo(place.x, place.y);
      }
      context.lineJoin = context.lineCap = "round";
      context.strokeStyle = path.within_risk ? look.theme.sensor : look.theme.truth;
      context.globalAlpha = 0.3;
      context.lineWidth = (2 * radius * view.transform.scale) / grid.resolution;
      context.stroke();
      context.globalAlpha = 1;
      context.lineWidth = 2;
      context.stroke();
    }
    for (const place of goal ? [start, goal] : [start]) {
      const { x, y } = at(place);
      context.beginPath();
      context.arc(x, y, 5, 0, 2 * Math.PI);
      context.fillStyle = place === start ? look.theme.sensor : look.theme.truth;
      context.fill();
      labels.avoid({ x, y }, 7);
      context.lineWidth = 2;
      context.strokeStyle = look.theme.halo;
      context.stroke();
    }
    if (path) {
      const corners = path.path.length;
      const [[x0, y0], [x1, y1]] = [path.path[(corners - 1) >> 1], path.path[corners >> 1]];
      const middle = at({ x: (x0 + x1) / 2, y: (y0 + y1) / 2 });
      const points = path.path.map(([x, y]) => at({ x, y }));
      points.forEach((point, i) => labels.avoid(point, 3, points[i + 1]));
      labels.place(`${figure(path.length_m, 1)} m, P(free) ${figure(path.probability, 3)}`, middle.x, middle.y, 4, 60);
    } else if (goal && session.decisions.trouble) labels.place("no path", at(goal).x, at(goal).y, 7);
  }
}
