// Small text on the canvas.

import { probabilityRgb, type Theme } from "../colour";
import type { Point } from "../protocol";

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
  context.fillStyle = halo ? `rgb(${probabilityRgb(theme, 1).map(Math.round)})` : theme.axis;
  context.fillText(text, x, y);
}

const HALF_LINE = 8;

type Box = { x: number; y: number; half: number; tall: number };

/** Labels that stand clear of each other, and of marks where there is room: each at the first free of some places, or nowhere. */
export class Labels {
  private readonly placed: (Box & { text: string })[] = [];
  private readonly marks: Box[] = [];

  /** `left` is where the map begins: the axis's numbers stand before it. */
  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly theme: Theme,
    private readonly width: number,
    private readonly height: number,
    private readonly left = 0,
  ) {}

  /** Keeps labels off what is drawn within `half` pixels of a point, or of the line to another. */
  avoid(from: Point, half: number, to = from) {
    const steps = Math.ceil(Math.hypot(to.x - from.x, to.y - from.y) / 6);
    for (let k = 0; k <= steps; k++) {
      const share = k / Math.max(1, steps);
      this.marks.push({ x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y), half, tall: half });
    }
  }

  /** Finds room for a label about a point: `away` from it, or up to `more` further, above or below, else to its right or left. Returns whether there is any. */
  place(text: string, x: number, y: number, away: number, more = 0) {
    this.context.font = FONT;
    const half = this.context.measureText(text).width / 2 + 2;
    const middle = Math.min(Math.max(x, this.left + half), this.width - half);
    const [right, left] = [x + away + half + 4, x - away - half - 4];
    const places = [[middle, y - away - 9], [middle, y + away + 9], [right, y], [left, y]];
    for (let d = HALF_LINE; d <= more; d += HALF_LINE) {
      places.push([middle, y - away - 9 - d], [middle, y + away + 9 + d], ...[right, left].flatMap((at) => [[at, y - d], [at, y + d]]));
    }
    const inside = ([px, py]: number[]) => px - half >= 0 && px + half <= this.width && py >= HALF_LINE && py <= this.height - HALF_LINE;
    const clear = (others: Box[]) => ([px, py]: number[]) => others.every((other) => Math.abs(px - other.x) >= half + other.half || Math.abs(py - other.y) >= HALF_LINE + other.tall);
    const room = places.filter(inside).filter(clear(this.placed));
    const best = room.filter(([px]) => px - half >= this.left).find(clear(this.marks));
    const free = best ?? room[0];
    if (free) this.placed.push({ text, x: free[0], y: free[1], half, tall: HALF_LINE });
    return Boolean(free);
  }

  /** Writes the labels: beyond the map, too, which cuts off what else is drawn. */
  write() {
    for (const { text, x, y } of this.placed) write(this.context, text, x, y, this.theme, "center", true);
  }
}
