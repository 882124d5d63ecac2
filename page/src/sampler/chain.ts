// A chain on binary walls, as in bayesmap.kernels.walls.chains, and its single-site sweeps, as in walls.gibbs.

import { cipherBits, first53, randomBits, shuffled, toUniform, type Word } from "./random";
import type { BeamTable, CellIndex } from "./table";

const CERTAIN_LEVEL = 2 ** 53; // the level of probability one
const CERTAIN = 20; // log-odds from which a bound replaces the sum
const LOG_ODDS_OF_FIXED = 1e15; // replaces infinite log-odds
const [UNKNOWN, BOUND, EXACT] = [0, 1, 2];

/** Independent cells of one wall probability. */
export class Prior {
  /** The probability in units of 2^-53. */
  readonly level: number;
  readonly logit: number;

  constructor(readonly p: number) {
    const level = p * CERTAIN_LEVEL;
    const rounded = Math.round(level);
    this.level = rounded - level === 0.5 && rounded % 2 ? rounded - 1 : rounded; // halves go to the even number
    this.logit = Math.min(Math.max(Math.log(p) - Math.log1p(-p), -LOG_ODDS_OF_FIXED), LOG_ODDS_OF_FIXED);
  }

  draws(bits: Word): boolean {
    return first53(bits) < this.level;
  }

  /** log p(walls). */
  logProb(walls: Uint8Array): number {
    if (this.p === 0 || this.p === 1) return 0; // the only map that can be
    let n = 0;
    for (const wall of walls) n += wall;
    return walls.length * Math.log1p(-this.p) + n * this.logit;
  }
}

/** Draw from a Bernoulli law by inversion: u < 1 / (1 + exp(-log odds)). */
function drawWall(logOdds: number, u: number): boolean {
  if (logOdds > 40) return true;
  if (logOdds < -40) return false;
  return u * (1 + Math.exp(-logOdds)) < 1;
}

/** A table with its index, and the sites of a sweep in their order, which may be shuffled in each sweep. */
export type Problem = { table: BeamTable; index: CellIndex; prior: Prior; shape: [number, number] };
export type Sites = { order: Int32Array; shuffle: boolean };

/** The i-th site of each sweep, given the sweep's key. */
export function siteOf({ order, shuffle }: Sites, key: Word, sweep: number): (i: number) => number {
  if (!shuffle) return (i) => order[i];
  const bits = cipherBits(order.length);
  const shuffleKey = { high: 0, low: 0 };
  randomBits(key, -1 - sweep, shuffleKey);
  return (i) => order[shuffled(i, order.length, bits, shuffleKey)];
}

export class Chain {
  readonly first: Int32Array; // entry of each beam's first wall
  readonly current: Float32Array; // its log-likelihood
  readonly reached: Int32Array; // beams that reach each cell
  private readonly gain: Float32Array;
  private readonly known: Uint8Array;
  private readonly bits: Word = { high: 0, low: 0 };

  /** Derive the state from the walls, 1 for a wall; the chain changes them. */
  constructor(readonly problem: Problem, readonly walls: Uint8Array, readonly key: Word) {
    const { offsets, cells, noHit } = problem.table;
    this.first = new Int32Array(noHit.length);
    this.current = new Float32Array(noHit.length);
    this.reached = new Int32Array(walls.length);
    this.gain = new Float32Array(walls.length);
    this.known = new Uint8Array(walls.length);
    for (let b = 0; b < noHit.length; b++) {
      const k = this.nextWall(offsets[b], offsets[b + 1]);
      this.first[b] = k;
      this.current[b] = this.entryLoglik(b, k);
      for (let j = offsets[b]; j < Math.min(k + 1, offsets[b + 1]); j++) this.reached[cells[j]]++;
    }
  }

  /** The first entry in [start, end) whose cell is a wall, or end. */
  nextWall(start: number, end: number): number {
    const { cells } = this.problem.table;
    let k = start;
    while (k < end && !this.walls[cells[k]]) k++;
    return k;
  }

  /** The log-likelihood of beam b's reading when entry k is its first wall. */
  entryLoglik(b: number, k: number): number {
    const { offsets, loglik, noHit } = this.problem.table;
    return k < offsets[b + 1] ? loglik[k] : noHit[b];
  }

  /** log p(readings | walls). */
  logLikelihood(): number {
    let total = 0;
    for (const term of this.current) total += term;
    return total;
  }

  /** Let beam b end at entry k. */
  private moveFirst(b: number, k: number) {
    const { offsets, cells } = this.problem.table;
    const end = offsets[b + 1];
    const f = this.first[b];
    this.first[b] = k;
    this.current[b] = this.entryLoglik(b, k);
    const nearer = Math.min(f, k);
    for (let j = offsets[b]; j < Math.min(nearer + 1, end); j++) this.known[cells[j]] = UNKNOWN;
    const change = k > f ? 1 : -1;
    for (let j = nearer + 1; j < Math.min(Math.max(f, k) + 1, end); j++) {
      this.known[cells[j]] = UNKNOWN;
      this.reached[cells[j]] += change;
    }
  }

  put(c: number) {
    const { offsets, beam, entry } = this.problem.index;
    this.walls[c] = 1;
    for (let i = offsets[c]; i < offsets[c + 1]; i++) if (this.first[beam[i]] > entry[i]) this.moveFirst(beam[i], entry[i]);
  }

  remove(c: number) {
    const { table, index } = this.problem;
    this.walls[c] = 0;
    for (let i = index.offsets[c]; i < index.offsets[c + 1]; i++) {
      const b = index.beam[i];
      const e = index.entry[i];
      if (this.first[b] === e) this.moveFirst(b, this.nextWall(e + 1, table.offsets[b + 1]));
    }
  }

  /** Draw every cell once from its conditional. */
  sweep(sites: Sites, sweep: number) {
    const { prior } = this.problem;
    const size = sites.order.length;
    const site = siteOf(sites, this.key, sweep);
    for (let i = 0; i < size; i++) {
      const c = site(i);
      randomBits(this.key, sweep * size + c, this.bits);
      if (!this.reached[c]) this.walls[c] = prior.draws(this.bits) ? 1 : 0;
      else if (this.walls[c]) {
        if (!this.stays(c, toUniform(this.bits))) this.remove(c);
      } else if (this.becomes(c, toUniform(this.bits))) this.put(c);
    }
  }

  /** Draw whether a free cell becomes a wall. */
  private becomes(c: number, u: number): boolean {
    const { logit } = this.problem.prior;
    if (this.known[c] === UNKNOWN) this.sumGain(c, -CERTAIN - logit);
    if (!drawWall(logit + this.gain[c], u)) return false;
    if (this.known[c] === EXACT) return true;
    // The bound allows a wall: draw again with the exact sum and the same uniform number.
    this.sumGain(c, -1e300);
    return drawWall(logit + this.gain[c], u);
  }

  /** Store the gain of a wall in a free cell: the exact sum, or a bound as soon as the sum must stay below `enough`. */
  private sumGain(c: number, enough: number) {
    const { offsets, beam, entry, loglik, gainBound } = this.problem.index;
    let gain = 0;
    let known = EXACT;
    for (let i = offsets[c]; i < offsets[c + 1]; i++) {
      const bound = gain + gainBound[i];
      if (bound < enough) {
        gain = bound;
        known = BOUND;
        break;
      }
      if (this.first[beam[i]] > entry[i]) gain += Math.fround(loglik[i] - this.current[beam[i]]);
    }
    this.gain[c] = gain;
    this.known[c] = known;
  }

  /** Draw whether a wall stays a wall. */
  private stays(c: number, u: number): boolean {
    const { table, index, prior } = this.problem;
    if (this.known[c] === UNKNOWN) {
      // Lower bound: each beam that ends here has its advantage over all entries behind.
      let least = 0;
      for (let i = index.offsets[c]; i < index.offsets[c + 1]; i++) {
        if (this.first[index.beam[i]] === index.entry[i]) least += index.advantage[i];
      }
      this.gain[c] = least;
      this.known[c] = BOUND;
    }
    const least = prior.logit + this.gain[c];
    if (this.known[c] === BOUND && least > CERTAIN && drawWall(least, u)) return true;
    let gain = 0;
    for (let i = index.offsets[c]; i < index.offsets[c + 1]; i++) {
      const b = index.beam[i];
      const e = index.entry[i];
      if (this.first[b] === e) gain += Math.fround(index.loglik[i] - this.entryLoglik(b, this.nextWall(e + 1, table.offsets[b + 1])));
    }
    return drawWall(prior.logit + gain, u);
  }
}
