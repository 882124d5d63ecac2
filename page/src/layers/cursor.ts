// The cell under the pointer, and that of the keyboard.

import type { Theme } from "../colour";
import type { Point } from "../protocol";
import type { Layer, Scene } from "./layer";
import { GUTTER, type Viewport } from "./viewport";

const SMALLEST_PIXELS = 5;

export class CursorLayer implements Layer {
  readonly name = "cursor";

  depends({ session, look }: Scene) {
    return [look.hover?.x, look.hover?.y, look.cursor?.x, look.cursor?.y, session.shape[1]];
  }

  paint(context: CanvasRenderingContext2D, { session, view, look }: Scene) {
    const { theme } = look;
    context.beginPath();
    context.rect(GUTTER.left, 0, view.width, view.height - GUTTER.bottom);
    context.clip();
    if (look.hover) frame(context, look.hover, session.shape[1], view, theme, theme.axis, 1.5);
    if (look.cursor) frame(context, look.cursor, session.shape[1], view, theme, theme.ray, 2.5);
  }
}

function frame(context: CanvasRenderingContext2D, cell: Point, ny: number, view: Viewport, theme: Theme, color: string, width: number) {
  const { scale } = view.transform;
  const corner = view.fromGrid({ x: cell.x, y: cell.y + 1 }, ny);
  const side = Math.max(scale, SMALLEST_PIXELS);
  const [left, top] = [corner.x - (side - scale) / 2, corner.y - (side - scale) / 2];
  context.lineWidth = width + 2;
  context.strokeStyle = theme.halo;
  context.strokeRect(left, top, side, side);
  context.lineWidth = width;
  context.strokeStyle = color;
  context.strokeRect(left, top, side, side);
}
