// Small text on the canvas.

import type { Theme } from "../colour";

export const FONT = '11px -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';

export function write(
  context: CanvasRenderingContext2D,
  text: string,
  x: number,
  y: number,
  theme: Theme,
  align: CanvasTextAlign,
  halo = false,
) {
  context.font = FONT;
  context.textAlign = align;
  context.textBaseline = "middle";
  if (halo) {
    context.strokeStyle = theme.halo;
    context.lineWidth = 3;
    context.strokeText(text, x, y);
  }
  context.fillStyle = theme.axis;
  context.fillText(text, x, y);
}
