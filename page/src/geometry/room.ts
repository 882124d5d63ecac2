// Where another sensor can stand.

import type { MapDocument, Point } from "../protocol";
import { cellOf, centreOf, lineOfCells } from "./cells";

/** The centre of the free cell nearest to a cell, in metres; null where there is none. */
export function nearestFree(document: MapDocument, walls: Uint8Array, to: Point): Point | null {
  const taken = sensorCells(document).map(({ x, y }) => x * document.grid.shape[1] + y);
  const score = (x: number, y: number) => -((x - to.x) ** 2 + (y - to.y) ** 2);
  return best(document, (x, y, i) => (walls[i] || taken.includes(i) ? -Infinity : score(x, y)));
}

/**
 * The centre of the free cell that is farthest from walls and, twice as far, from other sensors: one in sight of a sensor,
 * so that it stands in a room and not behind its walls; any where none is in sight; null where there is none.
 */
export function mostOpen(document: MapDocument, walls: Uint8Array): Point | null {
  const away = distanceToWalls(walls, document.grid.shape);
  const sensors = sensorCells(document);
  const openness = (x: number, y: number, i: number) => {
    if (walls[i]) return -Infinity;
    let least = 2 * away[i];
    for (const sensor of sensors) least = Math.min(least, Math.hypot(x - sensor.x, y - sensor.y));
    return least > 0 ? least : -Infinity;
  };
  const seen = inSight(walls, document.grid.shape, sensors);
  return best(document, (x, y, i) => (seen[i] ? openness(x, y, i) : -Infinity)) ?? best(document, openness);
}

/** Which cells a straight line from a sensor reaches before a wall, one byte a cell. */
function inSight(walls: Uint8Array, [nx, ny]: [number, number], sensors: Point[]): Uint8Array {
  const seen = new Uint8Array(nx * ny);
  const look = (from: Point, to: Point) => {
    for (const { x, y } of lineOfCells(from, to)) {
      if (walls[x * ny + y]) return;
      seen[x * ny + y] = 1;
    }
  };
  for (const sensor of sensors) {
    for (let x = 0; x < nx; x++) for (const y of [0, ny - 1]) look(sensor, { x, y });
    for (let y = 0; y < ny; y++) for (const x of [0, nx - 1]) look(sensor, { x, y });
  }
  return seen;
}

const sensorCells = ({ sensors, grid }: MapDocument) => sensors.map((sensor) => cellOf(sensor, grid));

function best(document: MapDocument, score: (x: number, y: number, i: number) => number): Point | null {
  const [nx, ny] = document.grid.shape;
  let found: Point | null = null;
  let most = -Infinity;
  for (let x = 0; x < nx; x++) {
    for (let y = 0; y < ny; y++) {
      const value = score(x, y, x * ny + y);
      if (value > most) [found, most] = [{ x, y }, value];
    }
  }
  return found && centreOf(found, document.grid);
}

/** Chessboard distance in cells to the nearest wall or to the outside, in two passes (Rosenfeld and Pfaltz 1966). */
function distanceToWalls(walls: Uint8Array, [nx, ny]: [number, number]): Uint16Array {
  const away = new Uint16Array(nx * ny);
  const at = (x: number, y: number) => (x < 0 || y < 0 || x >= nx || y >= ny ? 0 : away[x * ny + y]);
  for (let x = 0; x < nx; x++) {
    for (let y = 0; y < ny; y++) {
      away[x * ny + y] = walls[x * ny + y] ? 0 : 1 + Math.min(at(x - 1, y - 1), at(x - 1, y), at(x - 1, y + 1), at(x, y - 1));
    }
  }
  for (let x = nx - 1; x >= 0; x--) {
    for (let y = ny - 1; y >= 0; y--) {
      const back = 1 + Math.min(at(x + 1, y + 1), at(x + 1, y), at(x + 1, y - 1), at(x, y + 1));
      away[x * ny + y] = Math.min(away[x * ny + y], back);
    }
  }
  return away;
}
