// The beam table and its index by cells, as bayesmap.kernels.walls.table builds them, for normal noise.

import { stopAt, type Beam, type Rays } from "./rays";

const GAIN = Math.fround(1e-3); // nats: incidences that can gain less than this come last in their cell
const LOG_HEIGHT = -0.5 * Math.log(2 * Math.PI);

/** Log-likelihood of each beam's reading for its first wall in each of its cells, and for none. */
export type BeamTable = Rays & { loglik: Float32Array; noHit: Float32Array };

/** The table by cells: the fields are those of bayesmap's `CellIndex`. */
export type CellIndex = {
  offsets: Int32Array;
  entry: Int32Array;
  beam: Int32Array;
  loglik: Float32Array;
  gainBound: Float32Array;
  advantage: Float32Array;
};

export type Law = { sigma_m: number; max_m: number };

/** Fill in the likelihoods of readings, metres, in a grid of `ny` cells a column, each `edge_m` wide. */
export function beamTable(rays: Rays, beams: Beam[], readings_m: Float64Array, law: Law, ny: number, edge_m: number): BeamTable {
  const { offsets, cells } = rays;
  const variance = law.sigma_m * law.sigma_m;
  const constant = 0.5 * Math.log(variance);
  const logDensity = (reading_m: number, distance_m: number) => {
    const error = reading_m - Math.min(distance_m, law.max_m);
    return LOG_HEIGHT - 0.5 * ((error * error) / variance) - constant;
  };
  const loglik = new Float32Array(cells.length);
  const noHit = new Float32Array(beams.length);
  for (let b = 0; b < beams.length; b++) {
    noHit[b] = logDensity(readings_m[b], Infinity);
    for (let k = offsets[b]; k < offsets[b + 1]; k++) loglik[k] = logDensity(readings_m[b], stopAt(beams[b], cells[k], ny) * edge_m);
  }
  return { offsets, cells, loglik, noHit };
}

export function indexByCell({ offsets, cells, loglik, noHit }: BeamTable, nCells: number): CellIndex {
  // Each beam's least log-likelihood, and each entry's advantage over those behind it.
  const lowest = Float32Array.from(noHit);
  const advantages = new Float32Array(cells.length);
  for (let b = 0; b < noHit.length; b++) {
    let behind = noHit[b];
    for (let k = offsets[b + 1] - 1; k >= offsets[b]; k--) {
      advantages[k] = loglik[k] - behind;
      behind = Math.max(behind, loglik[k]);
      lowest[b] = Math.min(lowest[b], loglik[k]);
    }
  }
  // Where each cell's incidences begin.
  const starts = new Int32Array(nCells + 1);
  for (const c of cells) starts[c + 1]++;
  for (let c = 0; c < nCells; c++) starts[c + 1] += starts[c];
  const reals = () => new Float32Array(cells.length);
  const whole = () => new Int32Array(cells.length);
  const index = { offsets: starts, entry: whole(), beam: whole(), loglik: reals(), gainBound: reals(), advantage: reals() };
  // Incidences that can gain come first.
  const filled = starts.slice();
  for (const gaining of [true, false]) {
    for (let b = 0; b < noHit.length; b++) {
      for (let k = offsets[b]; k < offsets[b + 1]; k++) {
        const gain = Math.fround(loglik[k] - lowest[b]);
        if (gain > GAIN !== gaining) continue;
        const i = filled[cells[k]]++;
        index.entry[i] = k;
        index.beam[i] = b;
        index.loglik[i] = loglik[k];
        index.gainBound[i] = gain;
        index.advantage[i] = advantages[k];
      }
    }
  }
  // A bound covers an incidence and all after it.
  for (let c = 0; c < nCells; c++) {
    for (let i = starts[c + 1] - 2; i >= starts[c]; i--) index.gainBound[i] += index.gainBound[i + 1];
  }
  return index;
}
