// Cells and metres: arrays are indexed x * ny + y, y is up, a cell is named by its two indices.

import type { Grid, Pair, Point } from "../protocol";

export const clamp = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));

export const inside = ({ x, y }: Point, [nx, ny]: Pair) => x >= 0 && y >= 0 && x < nx && y < ny;

/** Cells from the grid's lower left corner, of a place in metres. */
export const toCells = (world: Point, { resolution, origin }: Grid): Point => ({
  x: (world.x - origin[0]) / resolution,
  y: (world.y - origin[1]) / resolution,
});

/** The inverse of `toCells`. */
export const toMetres = (place: Point, { resolution, origin }: Grid): Point => ({
  x: origin[0] + place.x * resolution,
  y: origin[1] + place.y * resolution,
});

/** The cell in which a place in metres lies; it may lie outside the grid. */
export function cellOf(world: Point, grid: Grid): Point {
  const { x, y } = toCells(world, grid);
  return { x: Math.floor(x), y: Math.floor(y) };
}

/** The centre of a cell in metres. */
export const centreOf = (cell: Point, grid: Grid): Point => toMetres({ x: cell.x + 0.5, y: cell.y + 0.5 }, grid);

/** Cells from one to another without a gap (Bresenham): neighbours share an edge or a corner, and beams stop at corners. */
export function lineOfCells(from: Point, to: Point): Point[] {
  const cells = [];
  const steps = Math.max(Math.abs(to.x - from.x), Math.abs(to.y - from.y));
  for (let i = 0; i <= steps; i++) {
    const t = steps ? i / steps : 0;
    cells.push({ x: Math.round(from.x + t * (to.x - from.x)), y: Math.round(from.y + t * (to.y - from.y)) });
  }
  return cells;
}

/** The edges between walls and free cells, in cells from the grid's lower left corner; collinear ones are one line. */
export function wallEdges(walls: Uint8Array, [nx, ny]: Pair): Path2D {
  const path = new Path2D();
  const at = (x: number, y: number) => (x >= 0 && x < nx && y >= 0 && y < ny ? walls[x * ny + y] : 0);
  for (let x = 0; x <= nx; x++) {
    for (let y = 0, start = -1; y <= ny; y++) {
      const edge = y < ny && at(x - 1, y) !== at(x, y);
      if (edge && start < 0) start = y;
      if (!edge && start >= 0) {
        path.moveTo(x, start);
        path.lineTo(x, y);
        start = -1;
      }
    }
  }
  for (let y = 0; y <= ny; y++) {
    for (let x = 0, start = -1; x <= nx; x++) {
      const edge = x < nx && at(x, y - 1) !== at(x, y);
      if (edge && start < 0) start = x;
      if (!edge && start >= 0) {
        path.moveTo(start, y);
        path.lineTo(x, y);
        start = -1;
      }
    }
  }
  return path;
}

/** Entropy of a cell in bits. */
export const entropyBits = (p: number) => (p <= 0 || p >= 1 ? 0 : -(p * Math.log2(p) + (1 - p) * Math.log2(1 - p)));
