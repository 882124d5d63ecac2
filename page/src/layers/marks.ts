// What moves with the hand or not at all: true walls, the map's frame, sensors, axes.

import { clamp, wallEdges } from "../geometry/cells";
import { paintAxes } from "./axes";
import { clipToMap, type Layer, type Scene } from "./layer";
import { paintSensors, sensorsOf } from "./sensors";

export class MarksLayer implements Layer {
  readonly name = "marks";
  private edges = new Path2D();
  private edgesOf = -1;

  depends({ session, look }: Scene) {
    const sensors = sensorsOf(session).flatMap(({ id, x, y, yaw }) => [id, x, y, yaw]);
    const { grid } = session.document ?? {};
    const truth = showsTruth(session) && look.truth && session.wallsVersion;
    return [grid && [...grid.shape, ...grid.origin, grid.resolution].join(), truth, look.selected, ...sensors];
  }

  shows({ session }: Scene) {
    return session.document !== null;
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, view, look } = scene;
    if (!session.document) return;
    const [nx, ny] = session.shape;
    const { scale, x, y } = view.transform;
    if (look.truth && showsTruth(session)) this.truth(context, scene);
    context.strokeStyle = look.theme.frame;
    context.lineWidth = 1;
    context.strokeRect(x - 0.5, y - 0.5, nx * scale + 1, ny * scale + 1);
    paintSensors(context, scene);
    paintAxes(context, scene);
  }

  private truth(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, view, look } = scene;
    const { scale, x, y } = view.transform;
    if (this.edgesOf !== session.wallsVersion) {
      this.edges = wallEdges(session.walls, session.shape);
      this.edgesOf = session.wallsVersion;
    }
    context.save();
    clipToMap(context, scene);
    context.transform(scale, 0, 0, -scale, x, y + session.shape[1] * scale);
    context.lineCap = "square";
    context.strokeStyle = look.theme.truth;
    context.lineWidth = clamp(scale * 0.09, 1, 2.5) / scale;
    context.stroke(this.edges);
    context.restore();
  }
}

const showsTruth = ({ document }: Scene["session"]) => document?.source.kind === "simulation";
