// The walk of a beam through the grid, as bayesmap.kernels.walk does it, and the cells of many beams.

import type { Grid } from "../protocol";

const TIE = 1e-9; // cells: closer than this to a corner or a line is on it
const PARALLEL = 1e-10; // direction cosines below this are zero
const NEVER = 1e300; // distance of a grid line that the beam does not cross
const SIDE_X = 1;
const SIDE_Y = 2;

/** A beam: its start in cells from the grid's corner, and its unit vector. */
export type Beam = { x: number; y: number; ux: number; uy: number };

/** The cell of a coordinate; on a grid line, the cell that the beam leaves. */
const cellBefore = (p: number, step: number) => (step > 0 ? Math.ceil(p - TIE) - 1 : Math.floor(p + TIE));

const stepOf = (u: number) => (Math.abs(u) < PARALLEL ? 0 : u > 0 ? 1 : -1);

/** Every cell that a beam touches, in order: `cellX, cellY` at `distance`, in cells. */
class Walk {
  cellX: number;
  cellY: number;
  distance: number;
  private readonly end: number;
  private x: number;
  private y: number;
  private sides: number;
  private sideX = 0;
  private sideY = 0;
  private readonly alongLine: number = 0;
  private readonly stepX: number;
  private readonly stepY: number;
  private nextX = NEVER;
  private nextY = NEVER;
  private readonly gapX: number = NEVER;
  private readonly gapY: number = NEVER;

  constructor({ x: px, y: py, ux, uy }: Beam, private readonly nx: number, private readonly ny: number, longest: number) {
    this.stepX = stepOf(ux);
    this.stepY = stepOf(uy);
    // Where the beam enters and leaves the grid.
    let enter = 0;
    let leave = longest;
    if (this.stepX) {
      this.gapX = 1 / Math.abs(ux);
      enter = Math.max(enter, Math.min(-px / ux, (nx - px) / ux));
      leave = Math.min(leave, Math.max(-px / ux, (nx - px) / ux));
    } else if (px < -TIE || px > nx + TIE) leave = -1;
    if (this.stepY) {
      this.gapY = 1 / Math.abs(uy);
      enter = Math.max(enter, Math.min(-py / uy, (ny - py) / uy));
      leave = Math.min(leave, Math.max(-py / uy, (ny - py) / uy));
    } else if (py < -TIE || py > ny + TIE) leave = -1;
    this.end = leave + TIE;
    // The first cell and the next grid lines.
    this.x = cellBefore(px + (this.stepX ? enter * ux : 0), this.stepX);
    this.y = cellBefore(py + (this.stepY ? enter * uy : 0), this.stepY);
    if (this.stepX) this.nextX = (this.x + Math.max(this.stepX, 0) - px) / ux;
    if (this.stepY) this.nextY = (this.y + Math.max(this.stepY, 0) - py) / uy;
    // A beam along a grid line touches the cells on its other side too.
    if (!this.stepX && Math.abs(px - this.x) <= TIE) {
      this.alongLine = SIDE_X;
      this.sideX = -1;
    }
    if (!this.stepY && Math.abs(py - this.y) <= TIE) {
      this.alongLine = SIDE_Y;
      this.sideY = -1;
    }
    this.cellX = this.x;
    this.cellY = this.y;
    this.sides = this.alongLine;
    this.distance = Math.max(0, Math.min(this.nextX, this.nextY));
  }

  get over() {
    return this.distance > this.end;
  }

  get inside() {
    return this.cellX >= 0 && this.cellX < this.nx && this.cellY >= 0 && this.cellY < this.ny;
  }

  /** Advance to the next touch: a side cell that is still due, else the cell across the next grid line. */
  next() {
    if (this.sides & SIDE_X) {
      this.cellX = this.x + this.sideX;
      this.cellY = this.y;
      this.sides &= SIDE_Y;
      return;
    }
    if (this.sides) {
      this.cellX = this.x;
      this.cellY = this.y + this.sideY;
      this.sides = 0;
      return;
    }
    const crossX = this.nextX < this.nextY - TIE;
    const crossY = this.nextY < this.nextX - TIE;
    this.distance = crossX ? this.nextX : crossY ? this.nextY : Math.min(this.nextX, this.nextY);
    this.sides = this.alongLine;
    if (crossX === crossY) {
      // Through a corner: both neighbours are touched first, then the cell beyond.
      this.sideX = -this.stepX;
      this.sideY = -this.stepY;
      this.sides = SIDE_X | SIDE_Y;
    }
    if (!crossY) {
      this.nextX += this.gapX;
      this.x += this.stepX;
    }
    if (!crossX) {
      this.nextY += this.gapY;
      this.y += this.stepY;
    }
    this.cellX = this.x;
    this.cellY = this.y;
  }
}

/** The distance to the first wall, in cells, at most `longest`. */
export function cast(walls: Uint8Array, [nx, ny]: Grid["shape"], beam: Beam, longest: number): number {
  for (const walk = new Walk(beam, nx, ny, longest); !walk.over; walk.next()) {
    if (walk.inside && walls[walk.cellX * ny + walk.cellY]) return Math.min(walk.distance, longest);
  }
  return longest;
}

/** Beam b touches `cells[offsets[b]]` to `cells[offsets[b + 1] - 1]`, in order. */
export type Rays = { offsets: Int32Array; cells: Int32Array };

/** Follow beams for at most `longest` cells. */
export function trace([nx, ny]: Grid["shape"], beams: Beam[], longest: number): Rays {
  const cells: number[] = [];
  const offsets = new Int32Array(beams.length + 1);
  beams.forEach((beam, b) => {
    for (const walk = new Walk(beam, nx, ny, longest); !walk.over; walk.next()) {
      if (walk.inside) cells.push(walk.cellX * ny + walk.cellY);
    }
    offsets[b + 1] = cells.length;
  });
  return { offsets, cells: Int32Array.from(cells) };
}

/** The distance at which a beam stops in a cell that it touches: where it enters, or leaves the cell of its start. */
export function stopAt({ x: px, y: py, ux, uy }: Beam, cell: number, ny: number): number {
  const x = Math.floor(cell / ny);
  const y = cell - x * ny;
  let enter = 0;
  let leave = NEVER;
  let holdsStart = true;
  const axis = (start: number, u: number, at: number) => {
    const step = stepOf(u);
    if (!step) return;
    const perCell = 1 / u;
    const near = at + (step > 0 ? 0 : 1) - start;
    enter = Math.max(enter, near * perCell);
    leave = Math.min(leave, (near + step) * perCell);
    holdsStart &&= at === cellBefore(start, step);
  };
  axis(px, ux, x);
  axis(py, uy, y);
  return holdsStart ? Math.max(leave, 0) : enter;
}
