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

/** Labels that stand clear of each other: each at the first free of some places, or nowhere. */
export class Labels {
  private readonly taken: [number, number, number, number][] = [];

  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly theme: Theme,
    private readonly width: number,
  ) {}

  /** Writes a label about a point that is `away` from it above or below, else to its right or left. Returns whether there was room. */
  write(text: string, x: number, y: number, away: number) {
    this.context.font = FONT;
    const half = this.context.measureText(text).width / 2 + 2;
    const middle = Math.min(Math.max(x, half), this.width - half);
    const places = [[middle, y - away - 9], [middle, y + away + 9], [x + away + half + 4, y], [x - away - half - 4, y]];
    const free = places.find(([px, py]) => !this.taken.some(([l, t, r, b]) => px + half > l && px - half < r && py + 8 > t && py - 8 < b));
    if (!free) return false;
    this.taken.push([free[0] - half, free[1] - 8, free[0] + half, free[1] + 8]);
    write(this.context, text, free[0], free[1], this.theme, "center", true);
    return true;
  }
}
