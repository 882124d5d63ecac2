// Where the map is on the canvas: CSS pixels of the stage and cells of the grid, y up.

import { clamp } from "../geometry/cells";
import type { Pair, Point } from "../protocol";

/** Room for the axes, in CSS pixels. */
export const GUTTER = { left: 36, right: 12, top: 34, bottom: 26 };
const KEPT_IN_SIGHT = 60;
const LARGEST_SCALE = 160;

export class Viewport {
  /** CSS pixels of the canvas, and device pixels to each. */
  width = 0;
  height = 0;
  ratio = 1;
  /** CSS pixels a cell, and where the map's upper left corner is, on a device pixel. */
  transform = { scale: 1, x: 0, y: 0 };
  /** Whether the whole map is shown, and is to be after the canvas has another size. */
  fitted = true;
  /** The map's upper left corner before it was rounded. */
  private corner = { x: 0, y: 0 };

  resize(width: number, height: number, ratio: number) {
    [this.width, this.height, this.ratio] = [width, height, ratio];
  }

  get middle(): Point {
    return { x: this.width / 2, y: this.height / 2 };
  }

  /** The whole map, centred, on whole device pixels where cells are large. */
  fit([nx, ny]: Pair) {
    const room = { x: this.width - GUTTER.left - GUTTER.right, y: this.height - GUTTER.top - GUTTER.bottom };
    let scale = Math.max(0.05, Math.min(room.x / nx, room.y / ny));
    if (scale * this.ratio > 4) scale = Math.floor(scale * this.ratio) / this.ratio;
    this.transform.scale = scale;
    this.corner = { x: GUTTER.left + (room.x - scale * nx) / 2, y: GUTTER.top + (room.y - scale * ny) / 2 };
    this.fitted = true;
    this.settle([nx, ny]);
    this.corner = { x: this.transform.x, y: this.transform.y }; // zooming begins with what is seen, not half a pixel beside it
  }

  /** Zooms about a point of the canvas. */
  zoom(factor: number, about: Point, shape: Pair) {
    const { scale } = this.transform;
    const { x, y } = this.corner;
    const next = clamp(scale * factor, Math.min(this.width, this.height) / Math.max(...shape) / 3, LARGEST_SCALE);
    const k = next / scale;
    this.transform.scale = next;
    this.corner = { x: about.x - k * (about.x - x), y: about.y - k * (about.y - y) };
    this.fitted = false;
    this.settle(shape);
  }

  pan(dx: number, dy: number, shape: Pair) {
    this.corner.x += dx;
    this.corner.y += dy;
    this.fitted = false;
    this.settle(shape);
  }

  /** Cells from the grid's lower left corner, of a point of the canvas. */
  toGrid(point: Point, ny: number): Point {
    const { scale, x, y } = this.transform;
    return { x: (point.x - x) / scale, y: ny - (point.y - y) / scale };
  }

  /** The inverse of `toGrid`. */
  fromGrid(grid: Point, ny: number): Point {
    const { scale, x, y } = this.transform;
    return { x: x + grid.x * scale, y: y + (ny - grid.y) * scale };
  }

  /** Keeps a part of the map in sight, and its corner on a device pixel. */
  private settle([nx, ny]: Pair) {
    const { scale } = this.transform;
    const keep = KEPT_IN_SIGHT;
    this.corner.x = clamp(this.corner.x, keep - nx * scale, this.width - keep);
    this.corner.y = clamp(this.corner.y, keep - ny * scale, this.height - keep);
    this.transform.x = Math.round(this.corner.x * this.ratio) / this.ratio;
    this.transform.y = Math.round(this.corner.y * this.ratio) / this.ratio;
  }
}
