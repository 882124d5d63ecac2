// A draw over the mean: what stops beams in this draw, in a colour of its own.

import type { Field } from "../protocol";
import type { Session } from "../state/session";
import { clipToMap, type Layer, type Scene } from "./layer";

/** The draw that lies over the mean, or null. */
const drawOver = ({ flicker, shown, where }: Session) => (flicker.under && !where.map ? shown : null);

export class HypothesisLayer implements Layer {
  readonly name = "hypothesis";
  private readonly cells = document.createElement("canvas").getContext("2d") as CanvasRenderingContext2D;
  private drawn = { field: null as Field | null, colour: "" };

  depends({ session }: Scene) {
    return [drawOver(session)];
  }

  shows({ session }: Scene) {
    return drawOver(session) !== null;
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, view, look } = scene;
    const field = drawOver(session);
    if (!field) return;
    const [nx, ny] = session.shape;
    const { scale, x, y } = view.transform;
    if (this.drawn.field !== field || this.drawn.colour !== look.theme.draw) this.fill(field, nx, ny, look.theme.draw);
    clipToMap(context, scene);
    context.imageSmoothingEnabled = false;
    context.drawImage(this.cells.canvas, x, y, nx * scale, ny * scale);
  }

  /** The more probably a cell stops a beam in the draw, the less of the mean shows through. */
  private fill(field: Field, nx: number, ny: number, colour: string) {
    const [red, green, blue] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
    Object.assign(this.cells.canvas, { width: nx, height: ny });
    const image = new ImageData(nx, ny);
    for (let row = 0, k = 0; row < ny; row++) {
      for (let i = ny - 1 - row; i < nx * ny; i += ny, k += 4) {
        // where no beam has been the draw is the prior's, and would only be noise
        image.data.set([red, green, blue, Math.round((field.p[i] * field.reached[i]) / 255)], k);
      }
    }
    this.cells.putImageData(image, 0, 0);
    this.drawn = { field, colour };
  }
}
