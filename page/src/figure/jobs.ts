// The samplers' work in short steps, and the pictures of what they have found so far.

import { packBits, unpackBits } from "../geometry/bits";
import type { Field as Picture, Figure, Verdict } from "../messages";
import type { Buffers, MapDocument, Recording, View } from "../protocol";
import { blockSweep, listBlocks, type Blocks } from "../sampler/blocks";
import { Chain, type Problem, type Sites } from "../sampler/chain";
import { rhatAndEss } from "../sampler/diagnostics";
import { normalised, particleMap, weighParticles } from "../sampler/importance";
import { mix, STREAM_PARTICLES, STREAM_START, STREAM_SWEEPS } from "../sampler/random";
import { sitesOf } from "../sampler/world";

const CHAINS = 2;
const LOOKS = 32; // times per run that reached cells are counted, besides sweeps 1, 2, 4 and so on
const TRACED = 300;
const FIRST_SWEEPS = 100;
const DRAW_BYTES = 64 << 20; // kept draws are thinned to fit
const DIAGNOSIS_SHARE = 0.1; // of the time
const PIECE = 16; // particles weighed at once
const NEGLIGIBLE_NATS = 40;
const WEIGHT_BINS = 24;
const THRESHOLDS = [0.1, 0.3, 0.5, 0.7, 0.9];
const NONE = { chains: 0, count: 0 };

const METHODS = { gibbs: "Gibbs sampling, cell by cell", block: "Gibbs sampling, 2 x 2 blocks", importance: "importance sampling", none: "none yet: this is the prior" };
type Method = keyof typeof METHODS;

/** What a picture shows besides its numbers. */
type Figures = Pick<Picture, "sweeps" | "total" | "ess" | "rhat" | "log_joint" | "verdict" | "burned">;
type Judging = Figure["judging"];

const now = () => performance.now();
const inLevels = (numbers: ArrayLike<number>) => Uint8Array.from(numbers, (number) => Math.round(255 * number));
const number = (value: number) => String(+value.toPrecision(4));

/** Inference on one document: before its first step, the prior. */
export class Job {
  done = false;
  seconds = 0;
  method: Method = "none";
  protected readonly cells: number;

  constructor(readonly document: MapDocument, protected readonly problem: Problem) {
    this.cells = problem.shape[0] * problem.shape[1];
  }

  /** Work for some milliseconds, at least one step. */
  work(budget_ms: number) {
    const began = now();
    do this.step();
    while (!this.done && now() - began < budget_ms);
    this.seconds += (now() - began) / 1000;
  }

  protected step() {
    this.done = true;
  }

  get draws() {
    return NONE;
  }

  /** The number of beams through a cell. */
  beamsThrough(c: number): number {
    const { offsets } = this.problem.index;
    return offsets[c + 1] - offsets[c];
  }

  protected mean(): ArrayLike<number> {
    return new Float64Array(this.cells).fill(this.document.prior);
  }

  /** How probably a beam reaches each cell. */
  protected reached(): ArrayLike<number> {
    return new Uint8Array(this.cells);
  }

  /** The log joint of every sweep, one row per chain. */
  protected get logJoint(): number[][] {
    return [];
  }

  protected figures(_over: boolean): Figures {
    return { sweeps: 0, total: 0, ess: null, rhat: null, log_joint: null, verdict: null, burned: 0 };
  }

  /** A map, its chain, its number and its log joint, if there are maps. */
  protected draw(_view: View): { map: Uint8Array; chain: number; draw: number; log_joint: number } | null {
    return null;
  }

  protected weights(): { weights: Float32Array; lowest: number } | null {
    return null;
  }

  picture(view: View, generation: number, milliseconds: number, over: boolean): [Picture, Buffers] {
    const { document, method } = this;
    const one = view.layer === "draw" ? this.draw(view) : null;
    const weights = this.weights();
    const order = method === "gibbs" ? `, ${document.order} order` : "";
    const picture: Picture = {
      type: "field", generation, milliseconds, layer: one ? "draw" : "mean", method, approximate: false, ...this.figures(over), draws: this.draws,
      quantity: { kind: "binary", mean: "P(wall)", value: "wall", interval: false }, chain: null, draw: null, averaged: null,
      lowest: weights?.lowest ?? null, seconds: method === "none" ? null : this.seconds,
      about: [
        ["Method", METHODS[method] + order], ["Prior", `independent: p wall ${number(document.prior)}`],
        ["Sensor", `gaussian: sigma ${number(document.noise)} m`], ["Poses", "known"], ["Computed", "in this page"],
      ],
      ...(one && { chain: one.chain, draw: one.draw, log_joint: one.log_joint }),
    };
    const p = inLevels(one ? one.map : this.mean());
    return [picture, { p, reached: inLevels(this.reached()), ...this.trace(), ...(weights && { weights: weights.weights }) }];
  }

  /** The result with its draws, for a page that plays it. */
  recording(rays: Buffers): [Recording, Buffers] {
    const { document } = this;
    const { chains, count } = this.draws;
    const [field, buffers] = this.picture({ layer: "mean", chain: 0, draw: null }, 1, 0, true);
    const beams = Uint32Array.from({ length: this.cells }, (_, c) => this.beamsThrough(c));
    const { log_joint, draws } = this.recorded();
    const ids = document.sensors.map(({ id }) => id);
    return [{ version: 1, document, field, ids, draws: { chains, count, kept: count, bits: true }, log_joint }, { ...buffers, ...rays, beams, draws }];
  }

  /** The draws of all chains, packed, and the log joint of each. */
  protected recorded(): { log_joint: number[][]; draws: Uint8Array } {
    return { log_joint: [], draws: new Uint8Array(0) };
  }

  /** The log joint of the first sweeps, and of later ones evenly. */
  private trace() {
    const rows = this.logJoint;
    const count = rows[0]?.length ?? 0;
    const points = Math.min(count, TRACED);
    const later = Array.from({ length: points }, (_, i) => Math.round(points > 1 ? 1 + (i * (count - 1)) / (points - 1) : 1));
    const first = Array.from({ length: Math.min(count, FIRST_SWEEPS) }, (_, i) => i + 1);
    const chosen = [...new Set([...first, ...later])].sort((a, b) => a - b);
    return { trace: Float32Array.from(rows.flatMap((row) => chosen.map((sweep) => row[sweep - 1]))), traced: Float32Array.from(chosen) };
  }
}

type Past = { sweep: number; sums: Float64Array[]; reached: Uint32Array; looks: number };

/** Chains of single-site or block sweeps. */
export class Chains extends Job {
  private readonly chains: Chain[];
  private readonly blocks: Blocks | null;
  private readonly sites: Sites;
  private readonly lookAt = new Set<number>();
  private readonly touched: Uint8Array;
  private readonly joint: number[][] = Array.from({ length: CHAINS }, () => []);
  private readonly likelihood: number[][] = Array.from({ length: CHAINS }, () => []);
  private readonly kept: Uint8Array[][] = Array.from({ length: CHAINS }, () => []);
  private readonly thin: number;
  private total = 0;
  private sweep = 0;
  private present: Past;
  private past: Past[];
  private diagnosis: { rhat: number; ess: number } | null = null;
  private diagnosed = 0;
  private diagnoseAt = 0;

  constructor(document: MapDocument, problem: Problem, private readonly judging: Judging, blocks: boolean) {
    super(document, problem);
    const { seed, start, sweeps } = document;
    this.method = blocks ? "block" : "gibbs";
    this.blocks = blocks ? listBlocks(problem) : null;
    this.sites = sitesOf(document, blocks);
    this.thin = Math.ceil((sweeps * CHAINS * Math.ceil(this.cells / 8)) / DRAW_BYTES);
    this.chains = Array.from({ length: CHAINS }, (_, n) => {
      const empty = start === "empty" && document.prior < 1;
      const walls = empty ? new Uint8Array(this.cells) : particleMap(problem, mix(seed, n, STREAM_START), 0);
      return new Chain(problem, walls, mix(seed, n, STREAM_SWEEPS));
    });
    this.touched = new Uint8Array(this.cells);
    for (const c of problem.table.cells) this.touched[c] = 1;
    this.present = { sweep: 0, sums: this.chains.map(() => new Float64Array(this.cells)), reached: new Uint32Array(this.cells), looks: 0 };
    this.past = [this.copy()];
    this.goOn(sweeps);
  }

  /** Let the chains do more sweeps from where they are. All draws so far are kept. */
  goOn(sweeps: number) {
    const { lookAt, document } = this;
    this.total = Math.ceil((this.total + sweeps) / this.thin) * this.thin;
    lookAt.add(Math.floor(document.burn_in * this.total));
    for (let sweep = 1; sweep <= this.total; sweep *= 2) lookAt.add(sweep);
    for (let k = 1; k <= LOOKS; k++) lookAt.add(Math.floor((this.total * k) / LOOKS));
    this.done = false;
    this.diagnoseAt = 0;
  }

  /** Leave out the sweeps before this one, at which no sums were kept, by means of the kept draws. */
  private burn(sweep: number) {
    const first = Math.floor(sweep / this.thin);
    const sums = this.kept.map((draws) => {
      const sum = new Float64Array(this.cells);
      for (const draw of draws.slice(0, first)) unpackBits(draw, this.cells).forEach((wall, c) => (sum[c] += wall));
      return sum.map((walls) => (walls * sweep) / Math.max(1, first));
    });
    this.past = [{ ...this.past[0], sweep, sums }];
  }

  private copy(): Past {
    const { sums, reached, looks } = this.present;
    return { sweep: this.sweep, sums: sums.map((sum) => sum.slice()), reached: reached.slice(), looks };
  }

  protected step() {
    const { present, document } = this;
    this.chains.forEach((chain, n) => {
      if (this.blocks) blockSweep(chain, this.blocks, this.sites, this.sweep);
      else chain.sweep(this.sites, this.sweep);
      const sums = present.sums[n];
      for (let c = 0; c < this.cells; c++) sums[c] += chain.walls[c];
      const likelihood = chain.logLikelihood();
      this.likelihood[n].push(likelihood);
      this.joint[n].push(likelihood + this.problem.prior.logProb(chain.walls));
      if ((this.sweep + 1) % this.thin === 0) this.kept[n].push(packBits(chain.walls));
    });
    this.sweep++;
    this.done = this.sweep >= this.total;
    const burned = Math.floor(document.burn_in * this.total);
    if (this.done && burned > this.past[0].sweep && this.past.every(({ sweep }) => sweep !== burned)) this.burn(burned);
    if (!this.lookAt.has(this.sweep)) return;
    // Count the cells that beams reach, and end the burn-in at the last of these sweeps that lies within it.
    for (const chain of this.chains) for (let c = 0; c < this.cells; c++) present.reached[c] += chain.reached[c] ? 1 : 0;
    present.looks += CHAINS;
    if (this.sweep <= document.burn_in * this.total) this.past.push(this.copy());
    while (this.past.length > 1 && this.past[1].sweep <= document.burn_in * this.sweep) this.past.shift();
  }

  get draws() {
    return this.kept[0].length ? { chains: CHAINS, count: this.kept[0].length } : NONE;
  }

  protected recorded() {
    const { joint, kept, thin } = this;
    const maps = kept.flat();
    const size = maps[0]?.length ?? 0;
    const draws = new Uint8Array(maps.length * size);
    maps.forEach((map, i) => draws.set(map, i * size));
    return { log_joint: joint.map((row) => row.filter((_, sweep) => (sweep + 1) % thin === 0)), draws };
  }

  private means(): Float64Array[] {
    const [burned] = this.past;
    const count = Math.max(1, this.sweep - burned.sweep);
    return this.present.sums.map((sums, n) => sums.map((sum, c) => (sum - burned.sums[n][c]) / count));
  }

  protected mean() {
    const [first, second] = this.means();
    return first.map((p, c) => (this.touched[c] ? (p + second[c]) / 2 : this.document.prior));
  }

  protected reached() {
    const [burned] = this.past;
    const looks = Math.max(1, this.present.looks - burned.looks);
    return Float64Array.from(this.present.reached, (count, c) => (count - burned.reached[c]) / looks);
  }

  protected get logJoint() {
    return this.joint;
  }

  protected draw({ chain: asked, draw: wanted }: View) {
    const chain = Math.min(asked, CHAINS - 1);
    const { count } = this.draws;
    if (!count) return { map: this.chains[chain].walls, chain, draw: 0, log_joint: this.joint[chain].at(-1) ?? 0 };
    const draw = Math.min(wanted ?? count - 1, count - 1);
    return { map: unpackBits(this.kept[chain][draw], this.cells), chain, draw, log_joint: this.joint[chain][(draw + 1) * this.thin - 1] };
  }

  protected figures(over: boolean): Figures {
    const [{ sweep: burned }] = this.past;
    const began = now();
    if (began >= this.diagnoseAt || (this.done && this.diagnosed < this.sweep)) {
      this.diagnosis = rhatAndEss(this.joint.map((row) => row.slice(burned)));
      this.diagnosed = this.sweep;
      this.diagnoseAt = this.done ? Infinity : now() + (now() - began) / DIAGNOSIS_SHARE;
    }
    const last = this.joint.reduce((sum, row) => sum + row[row.length - 1], 0) / CHAINS;
    const { ess = null, rhat = null } = this.diagnosis ?? {};
    const finite = (value: number | null) => (value !== null && Number.isFinite(value) ? value : null);
    return { sweeps: this.sweep, total: this.total, ess: finite(ess), rhat: finite(rhat), log_joint: last, verdict: this.verdict(over || this.done), burned };
  }

  /** The verdict of bayesmap's `judge_chains`. */
  private verdict(over: boolean): Verdict | null {
    const { judging, sweep } = this;
    const few = sweep < judging.fewest_sweeps;
    if (few && !over) return null;
    const verdict = (level: Verdict["level"], why: string, cell: Verdict["cell"] = null): Verdict => ({ level, why, cell });
    const apart = this.difference();
    if (!few && apart.cells > judging.chance_share * apart.among) {
      const [x, y] = apart.cell;
      const where = `in ${apart.cells} of ${apart.among} observed cells, most in cell (${x}, ${y}), by ${apart.by.toFixed(2)}`;
      return verdict("bad", `P(wall) differs by over ${judging.bad_difference} between the chains ${where}`, apart.cell);
    }
    if (sweep < judging.fewest_diagnosed) return verdict("bad", `${sweep} ${sweep === 1 ? "sweep is" : "sweeps are"} too few to judge`);
    const { rhat = NaN, ess = NaN } = this.diagnosis ?? {};
    if (rhat > judging.rhat_limit) return verdict("bad", `R-hat is ${rhat.toFixed(3)}, over ${judging.rhat_limit}`);
    const misfit = this.misfit();
    if (misfit) return verdict("bad", `the chains agree, but on maps that the readings contradict: they differ by ${+misfit.toPrecision(3)} times the noise`);
    if (!Number.isFinite(rhat) || !Number.isFinite(ess)) return verdict("good", "nothing varies: the log joint is the same in all draws of all chains");
    if (ess < judging.bad_ess) return verdict("bad", `only ${ess.toFixed(0)} effective draws`);
    if (rhat > judging.good_rhat || ess < judging.good_ess) {
      return verdict("fair", `R-hat ${rhat.toFixed(3)} and ${ess.toFixed(0)} effective draws; ${judging.good_rhat} and ${judging.good_ess} are good`);
    }
    return verdict("good", `R-hat ${rhat.toFixed(3)}, ${ess.toFixed(0)} effective draws`);
  }

  /** How far the draws are from the readings, in standard deviations, if they contradict them: bayesmap's `misfit_of`. */
  private misfit(): number | null {
    const beams = this.problem.table.noHit.length;
    const [{ sweep: burned }] = this.past;
    const peak = -beams * Math.log(this.document.noise * Math.sqrt(2 * Math.PI));
    const means = this.likelihood.map((row) => row.slice(burned).reduce((sum, value) => sum + value, 0) / (row.length - burned));
    const squares = 2 * (peak - Math.min(...means));
    const narrow = 2 / (9 * beams);
    return squares > beams * (1 - narrow + this.judging.misfit_sigmas * Math.sqrt(narrow)) ** 3 ? Math.sqrt(squares / beams) : null;
  }

  /** How far the chains' means differ in the cells that beams reach in half of the draws. */
  private difference() {
    const [first, second] = this.means();
    const reached = this.reached();
    const found = { by: 0, cell: [0, 0] as [number, number], cells: 0, among: 0 };
    for (let c = 0; c < this.cells; c++) {
      if (reached[c] < 0.5) continue;
      const by = Math.abs(first[c] - second[c]);
      found.among++;
      if (by > this.judging.bad_difference) found.cells++;
      if (by > found.by) [found.by, found.cell] = [by, [Math.floor(c / this.problem.shape[1]), c % this.problem.shape[1]]];
    }
    return found;
  }
}

/** Importance sampling, a few particles at a time. */
export class Weighing extends Job {
  private readonly key;
  private readonly logWeights: number[] = [];
  private most = -Infinity;
  private sum = 0;
  private readonly sums: Float64Array;
  private readonly touched: Uint8Array;

  constructor(document: MapDocument, problem: Problem, private readonly judging: Judging) {
    super(document, problem);
    this.method = "importance";
    this.key = mix(document.seed, 0, STREAM_PARTICLES);
    this.sums = new Float64Array(this.cells);
    this.touched = new Uint8Array(this.cells);
    for (const c of problem.table.cells) this.touched[c] = 1;
  }

  protected step() {
    const before = this.logWeights.length;
    const count = Math.min(PIECE, this.document.sweeps - before);
    weighParticles(this.problem, this.key, before, count).forEach((weight, i) => {
      this.logWeights.push(weight);
      if (weight > this.most) {
        // Weights are relative to the largest.
        const smaller = Math.exp(this.most - weight);
        this.sum *= smaller;
        for (let c = 0; c < this.cells; c++) this.sums[c] *= smaller;
        this.most = weight;
      }
      if (weight < this.most - NEGLIGIBLE_NATS) return;
      const share = Math.exp(weight - this.most);
      const map = particleMap(this.problem, this.key, before + i);
      this.sum += share;
      for (let c = 0; c < this.cells; c++) if (map[c]) this.sums[c] += share;
    });
    this.done = this.logWeights.length >= this.document.sweeps;
  }

  protected mean() {
    return this.sums.map((sum, c) => (this.touched[c] ? sum / this.sum : this.document.prior));
  }

  /** The share of five maps, with walls where the mean is over a threshold, in which a beam reaches each cell. */
  protected reached() {
    const mean = this.mean();
    const { offsets, cells, noHit } = this.problem.table;
    const shares = new Float64Array(this.cells);
    for (const threshold of THRESHOLDS) {
      const reached = new Uint8Array(this.cells);
      for (let b = 0; b < noHit.length; b++) {
        for (let k = offsets[b]; k < offsets[b + 1]; k++) {
          reached[cells[k]] = 1;
          if (mean[cells[k]] > threshold) break;
        }
      }
      for (let c = 0; c < this.cells; c++) shares[c] += reached[c] / THRESHOLDS.length;
    }
    return shares;
  }

  protected figures(): Figures {
    const { effectiveSampleSize: ess } = normalised(Float64Array.from(this.logWeights));
    return { sweeps: this.logWeights.length, total: this.document.sweeps, ess, rhat: null, log_joint: null, verdict: this.verdict(ess), burned: 0 };
  }

  private verdict(ess: number): Verdict {
    const { bad_ess, good_ess } = this.judging;
    const carry = ess.toFixed(1) === "1.0" ? "one particle carries" : `${ess.toFixed(1)} particles carry`;
    if (ess < bad_ess) return { level: "bad", why: `${carry} all the weight`, cell: null };
    return { level: ess >= good_ess ? "good" : "fair", why: `${ess.toFixed(0)} effective particles`, cell: null };
  }

  /** Particles by log weight, in equal bins from the lightest to the heaviest. */
  protected weights() {
    const below = this.logWeights.map((weight) => weight - this.most);
    const lowest = Math.min(-1, ...below.filter(Number.isFinite).reduce((a, b) => [Math.min(a[0], b)], [0]));
    const weights = new Float32Array(WEIGHT_BINS);
    for (const weight of below) weights[Math.min(WEIGHT_BINS - 1, Math.floor(WEIGHT_BINS * (1 - weight / lowest)))]++;
    return { weights, lowest };
  }
}

