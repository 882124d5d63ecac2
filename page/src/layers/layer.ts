// What a layer of the picture is, and the stack that repaints those that changed.

import type { Theme } from "../colour";
import { toCells } from "../geometry/cells";
import type { Point } from "../protocol";
import type { Session } from "../state/session";
import { Labels } from "./text";
import { GUTTER, type Viewport } from "./viewport";

/** What is drawn besides the map. */
export type Look = {
  theme: Theme;
  truth: boolean;
  rays: boolean;
  readings: boolean;
  strokes: boolean;
  trajectory: boolean;
  /** The cell under the pointer, and the keyboard's. */
  hover: Point | null;
  cursor: Point | null;
  /** Id of the sensor that has a handle to turn it. */
  selected: number | null;
};

/** All that a layer may show. */
export type Scene = { session: Session; view: Viewport; look: Look };

/** One transparent sheet of the picture. */
export interface Layer {
  readonly name: string;
  /** What its picture depends on besides theme and viewport: it is repainted when one of these is another value. */
  depends(scene: Scene): unknown[];
  /** Whether there is anything to draw, which is taken for granted where this is not asked. */
  shows?(scene: Scene): boolean;
  /** Draws onto a clear sheet; the context's unit is the CSS pixel. */
  paint(context: CanvasRenderingContext2D, scene: Scene): void;
}

type Sheet = { layer: Layer; canvas: HTMLCanvasElement; context: CanvasRenderingContext2D; before: unknown[] };

/** Sheets one above the other, each on a canvas of its own; the last one is on top and takes the pointer. */
export class Stack {
  /** How often each layer was painted. */
  readonly paints: { [name: string]: number } = {};
  private readonly sheets: Sheet[];

  constructor(layers: Layer[], canvases: HTMLCanvasElement[]) {
    this.sheets = layers.map((layer, i) => ({
      layer,
      canvas: canvases[i],
      context: canvases[i].getContext("2d") as CanvasRenderingContext2D,
      before: [],
    }));
    for (const { name } of layers) this.paints[name] = 0;
  }

  /** Paints the layers that are no longer as they were. */
  paint(scene: Scene) {
    const { width, height, ratio, transform } = scene.view;
    if (!width || !height) return; // not laid out yet
    const pixels = { width: Math.max(1, Math.ceil(width * ratio)), height: Math.max(1, Math.ceil(height * ratio)) };
    const common = [scene.look.theme, width, height, ratio, transform.scale, transform.x, transform.y];
    for (const sheet of this.sheets) {
      const { canvas, context, layer } = sheet;
      const shows = layer.shows?.(scene) ?? true;
      const now = [shows, ...(shows ? [...common, ...layer.depends(scene)] : [])];
      if (now.length === sheet.before.length && now.every((value, i) => Object.is(value, sheet.before[i]))) continue;
      sheet.before = now;
      // even a clear sheet costs a browser time in every frame: the copying of its pixels, where there is no GPU
      canvas.style.visibility = shows ? "" : "hidden";
      if (!shows) continue;
      if (canvas.width !== pixels.width || canvas.height !== pixels.height) {
        Object.assign(canvas, pixels);
        // a stage of half a pixel more must not stretch the sheet
        canvas.style.width = `${pixels.width / ratio}px`;
        canvas.style.height = `${pixels.height / ratio}px`;
      }
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, canvas.width, canvas.height);
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.save();
      layer.paint(context, scene);
      context.restore();
      this.paints[layer.name]++;
    }
  }
}

/** Labels over the map. */
export function labelsOf(context: CanvasRenderingContext2D, { session, look, view }: Scene) {
  const { scale, x, y } = view.transform;
  const labels = new Labels(context, look.theme, view.width, Math.min(view.height, y + session.shape[1] * scale), Math.max(GUTTER.left, x));
  const { sensors = [], grid } = session.document ?? {};
  if (grid) for (const sensor of sensors) labels.avoid(view.fromGrid(toCells(sensor, grid), grid.shape[1]), 9);
  return labels;
}

/** Restricts drawing to the map. */
export function clipToMap(context: CanvasRenderingContext2D, { session, view }: Scene) {
  const [nx, ny] = session.shape;
  const { scale, x, y } = view.transform;
  context.beginPath();
  context.rect(x, y, nx * scale, ny * scale);
  context.clip();
}

/** Strokes the path in a colour, on a wider line that sets it off from whatever lies beneath. */
export function strokeOnHalo(context: CanvasRenderingContext2D, { halo }: Theme, colour: string, width: number) {
  context.lineWidth = 4;
  context.strokeStyle = halo;
  context.stroke();
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.stroke();
}
