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

const HALF_LINE = 8;

/** Labels that stand clear of each other: each at the first free of some places, or nowhere. */
export class Labels {
  private readonly placed: { text: string; x: number; y: number; half: number }[] = [];

  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly theme: Theme,
    private readonly width: number,
    private readonly height: number,
  ) {}

  /** Finds room for a label about a point: `away` from it above or below, else to its right or left. Returns whether there is any. */
  place(text: string, x: number, y: number, away: number) {
    this.context.font = FONT;
    const half = this.context.measureText(text).width / 2 + 2;
    const middle = Math.min(Math.max(x, half), this.width - half);
    const places = [[middle, y - away - 9], [middle, y + away + 9], [x + away + half + 4, y], [x - away - half - 4, y]];
    const inside = ([px, py]: number[]) => px - half >= 0 && px + half <= this.width && py >= HALF_LINE && py <= this.height - HALF_LINE;
    const clear = ([px, py]: number[]) => this.placed.every((other) => Math.abs(px - other.x) >= half + other.half || Math.abs(py - other.y) >= 2 * HALF_LINE);
    const free = places.find((place) => inside(place) && clear(place));
    if (free) this.placed.push({ text, x: free[0], y: free[1], half });
    return Boolean(free);
  }

  /** Writes the labels: beyond the map, too, which cuts off what else is drawn. */
  write() {
    for (const { text, x, y } of this.placed) write(this.context, text, x, y, this.theme, "center", true);
  }
}
