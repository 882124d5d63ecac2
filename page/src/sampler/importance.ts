// Importance sampling from the prior, as in bayesmap.kernels.walls.table: a map is drawn again from its number.

import type { Problem } from "./chain";
import { randomBits, type Word } from "./random";

/** log p(readings | map) of particles `first` to `first + count - 1`; only cells that beams reach are drawn. */
export function weighParticles({ table, prior, shape }: Problem, key: Word, first: number, count: number): Float64Array {
  const { offsets, cells, loglik, noHit } = table;
  const nCells = shape[0] * shape[1];
  const bits = { high: 0, low: 0 };
  const drawn = new Int8Array(nCells); // of one particle: 0 not yet, 1 a wall, -1 free
  return Float64Array.from({ length: count }, (_, i) => {
    drawn.fill(0);
    let total = 0;
    for (let b = 0; b < noHit.length; b++) {
      let term = noHit[b];
      for (let k = offsets[b]; k < offsets[b + 1]; k++) {
        const c = cells[k];
        if (!drawn[c]) {
          randomBits(key, (first + i) * nCells + c, bits);
          drawn[c] = prior.draws(bits) ? 1 : -1;
        }
        if (drawn[c] > 0) {
          term = loglik[k];
          break;
        }
      }
      total += term;
    }
    return total;
  });
}

/** The whole map of a particle. */
export function particleMap({ prior, shape }: Problem, key: Word, particle: number): Uint8Array {
  const nCells = shape[0] * shape[1];
  const bits = { high: 0, low: 0 };
  return Uint8Array.from({ length: nCells }, (_, c) => {
    randomBits(key, particle * nCells + c, bits);
    return prior.draws(bits) ? 1 : 0;
  });
}

/** The normalised log weights, the log evidence, and the effective sample size of particles. */
export function normalised(logWeights: Float64Array) {
  const most = logWeights.reduce((a, b) => Math.max(a, b), -Infinity);
  const logTotal = most + Math.log(logWeights.reduce((sum, weight) => sum + Math.exp(weight - most), 0));
  const relative = logWeights.map((weight) => weight - logTotal);
  const squares = relative.reduce((sum, weight) => sum + Math.exp(2 * weight), 0);
  return { logWeights: relative, logEvidence: logTotal - Math.log(logWeights.length), effectiveSampleSize: 1 / squares };
}
