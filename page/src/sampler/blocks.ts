// 2 x 2 block sweeps, as in bayesmap.kernels.walls.block: four cells are drawn together from their 16 joint states.

import { siteOf, type Chain, type Problem, type Sites } from "./chain";
import { randomBits, toUniform } from "./random";

const LOOK_BACK = 8; // entries: a beam's cells in one block lie close together
const IMPOSSIBLE = -1e300; // log weight
const CERTAIN_LEVEL = 2 ** 53;

/** The beams that touch each block, and the first and last of their entries in it. */
export type Blocks = { offsets: Int32Array; beam: Int32Array; first: Int32Array; last: Int32Array; rows: number };

/** The place of cell c in the block at (x, y), 0 to 3, or -1 if it lies outside. */
function placeIn(c: number, x: number, y: number, ny: number): number {
  const dx = Math.floor(c / ny) - x;
  const dy = (c % ny) - y;
  return dx < 0 || dx > 1 || dy < 0 || dy > 1 ? -1 : 2 * dx + dy;
}

export function listBlocks({ table, shape: [nx, ny] }: Problem): Blocks {
  const { offsets, cells, noHit } = table;
  const columns = Math.max(1, nx - 1);
  const rows = Math.max(1, ny - 1);
  const found: { b: number; first: number; last: number }[][] = Array.from({ length: columns * rows }, () => []);
  for (let b = 0; b < noHit.length; b++) {
    for (let k = offsets[b]; k < offsets[b + 1]; k++) {
      for (let corner = 0; corner < 4; corner++) {
        const x = Math.floor(cells[k] / ny) - (corner >> 1);
        const y = (cells[k] % ny) - (corner & 1);
        if (x < 0 || x >= columns || y < 0 || y >= rows) continue;
        const here = found[x * rows + y];
        const met = here[here.length - 1];
        if (met?.b === b && met.last >= k - LOOK_BACK) met.last = k;
        else here.push({ b, first: k, last: k });
      }
    }
  }
  const starts = new Int32Array(found.length + 1);
  found.forEach((here, block) => (starts[block + 1] = starts[block] + here.length));
  const all = found.flat();
  const whole = (name: "b" | "first" | "last") => Int32Array.from(all, (one) => one[name]);
  return { offsets: starts, beam: whole("b"), first: whole("first"), last: whole("last"), rows };
}

/** Make a sweep over all positions of a block. */
export function blockSweep(chain: Chain, blocks: Blocks, sites: Sites, sweep: number) {
  const { prior, shape: [nx, ny] } = chain.problem;
  const { rows } = blocks;
  const size = sites.order.length;
  const site = siteOf(sites, chain.key, sweep);
  const weights = new Float64Array(16);
  const ofPrior = new Float64Array(16);
  const bits = { high: 0, low: 0 };
  for (let i = 0; i < size; i++) {
    const block = site(i);
    const x = Math.floor(block / rows);
    const y = block % rows;
    const counter = 4 * (sweep * size + block);
    const cellAt = (j: number) => (x + (j >> 1) < nx && y + (j & 1) < ny ? (x + (j >> 1)) * ny + y + (j & 1) : -1);
    let reaching = 0;
    for (let j = 0; j < 4; j++) if (cellAt(j) >= 0) reaching += chain.reached[cellAt(j)];
    if (!reaching) {
      for (let j = 0; j < 4; j++) {
        if (cellAt(j) < 0) continue;
        randomBits(chain.key, counter + j, bits);
        chain.walls[cellAt(j)] = prior.draws(bits) ? 1 : 0;
      }
      continue;
    }
    weigh(chain, blocks, block, x, y, weights);
    ofPrior.fill(0);
    for (let j = 0; j < 4; j++) {
      const never = cellAt(j) < 0 || prior.level === 0;
      const always = !never && prior.level === CERTAIN_LEVEL;
      for (let m = 0; m < 16; m++) if (((m >> j) & 1) === (always ? 0 : 1)) ofPrior[m] += never || always ? IMPOSSIBLE : prior.logit;
    }
    for (let m = 0; m < 16; m++) weights[m] += ofPrior[m];
    randomBits(chain.key, counter, bits);
    const state = drawState(weights, toUniform(bits));
    for (let j = 0; j < 4; j++) {
      const c = cellAt(j);
      if (c < 0) continue;
      if ((state >> j) & 1) {
        if (!chain.walls[c]) chain.put(c);
      } else if (chain.walls[c]) chain.remove(c);
    }
  }
}

/** The log-likelihood of the 16 states, up to a constant; each beam is walked once. */
function weigh(chain: Chain, blocks: Blocks, block: number, x: number, y: number, weights: Float64Array) {
  const { table, shape: [, ny] } = chain.problem;
  const { offsets, cells, loglik } = table;
  weights.fill(0);
  for (let i = blocks.offsets[block]; i < blocks.offsets[block + 1]; i++) {
    const b = blocks.beam[i];
    const f = chain.first[b];
    const k = blocks.first[i];
    if (f < k) continue; // a wall stands before the block
    const last = blocks.last[i];
    const end = offsets[b + 1];
    // The first wall outside the block.
    let out = f;
    if (f <= last && f < end && placeIn(cells[f], x, y, ny) >= 0) {
      out = f + 1;
      while (out < end && !(chain.walls[cells[out]] && placeIn(cells[out], x, y, ny) < 0)) out++;
    }
    const outside = chain.entryLoglik(b, out);
    // The states in which each cell of the block is the beam's first wall.
    let free = 0;
    for (let e = k; e < Math.min(last + 1, out); e++) {
      const j = placeIn(cells[e], x, y, ny);
      if (j < 0) continue;
      const gain = Math.fround(loglik[e] - outside);
      for (let m = 0; m < 16; m++) if ((m >> j) & 1 && !(m & free)) weights[m] += gain;
      free |= 1 << j;
    }
  }
}

/** Draw a state by its log weight; states more than 40 nats below the largest are left out. */
function drawState(weights: Float64Array, u: number): number {
  const most = Math.max(...weights);
  const shares = weights.map((weight) => (weight > most - 40 ? Math.exp(weight - most) : 0));
  let level = u * shares.reduce((sum, share) => sum + share, 0);
  for (let m = 0; m < 16; m++) {
    level -= shares[m];
    if (level <= 0 && shares[m] > 0) return m;
  }
  return 15;
}
