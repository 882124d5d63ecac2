// A drawn world: its beams, noise-free ranges, inference problem and orders of sites, from the page's document.

import { unpackBits, fromBase64 } from "../geometry/bits";
import type { MapDocument } from "../protocol";
import { Prior, type Problem, type Sites } from "./chain";
import { cast, trace, type Beam } from "./rays";
import { beamTable, indexByCell } from "./table";

/** Beam angles in the sensor frame, radians, as bayesmap's `fan` gives them. */
export function fan({ angles, fov }: MapDocument): Float64Array {
  const degrees = fov * (180 / Math.PI);
  if (degrees === 360) return Float64Array.from({ length: angles }, (_, i) => (i * 2 * Math.PI) / angles);
  const step = degrees / (angles - (angles % 2));
  return Float64Array.from({ length: angles }, (_, i) => (step * i - degrees / 2) * (Math.PI / 180));
}

/** The beams of all sensors, one sensor after another. */
export function beamsOf(document: MapDocument): Beam[] {
  const { origin, resolution } = document.grid;
  const angles = [...fan(document)];
  return document.sensors.flatMap(({ x, y, yaw }) =>
    angles.map((angle) => ({ x: (x - origin[0]) / resolution, y: (y - origin[1]) / resolution, ux: Math.cos(yaw + angle), uy: Math.sin(yaw + angle) })),
  );
}

/** Noise-free ranges of beams, metres. */
export function rangesOf({ grid, walls, max_range }: MapDocument, beams: Beam[]): Float64Array {
  const cells = unpackBits(fromBase64(walls), grid.shape[0] * grid.shape[1]);
  const longest = max_range / grid.resolution;
  return Float64Array.from(beams, (beam) => Math.min(cast(cells, grid.shape, beam, longest) * grid.resolution, max_range));
}

/** The inference problem of readings, metres. */
export function problemOf({ grid, noise, prior, max_range }: MapDocument, beams: Beam[], readings_m: Float64Array): Problem {
  const { shape, resolution } = grid;
  const rays = trace(shape, beams, max_range / resolution);
  const table = beamTable(rays, beams, readings_m, { sigma_m: noise, max_m: max_range }, shape[1], resolution);
  return { table, index: indexByCell(table, shape[0] * shape[1]), prior: new Prior(prior), shape };
}

/** The sites of a sweep: all cells, or for blocks of 2 x 2 all positions of their first cell. */
export function sitesOf({ grid, sensors, order }: MapDocument, blocks: boolean): Sites {
  const [nx, ny] = grid.shape;
  const [columns, rows] = blocks ? [Math.max(1, nx - 1), Math.max(1, ny - 1)] : [nx, ny];
  const sites = Int32Array.from({ length: columns * rows }, (_, i) => i);
  if (order !== "radial") return { order: sites, shuffle: order === "random" };
  // Outwards from the nearest sensor, by steps to a neighbour.
  const clamp = (cell: number, size: number) => Math.min(Math.max(cell, 0), size - 1);
  const at = sensors.map(({ x, y }) => [
    clamp(Math.floor((x - grid.origin[0]) / grid.resolution), nx), clamp(Math.floor((y - grid.origin[1]) / grid.resolution), ny),
  ]);
  const distance = sites.map((i) => Math.min(...at.map(([x, y]) => Math.abs(Math.floor(i / rows) - x) + Math.abs((i % rows) - y))));
  return { order: Int32Array.from([...sites].sort((i, j) => distance[i] - distance[j] || i - j)), shuffle: false };
}
