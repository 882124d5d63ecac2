// The page's sampler draws what the library draws from the same seeds.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { packBits, toBase64 } from "../src/geometry/bits";
import type { MapDocument } from "../src/protocol";
import { blockSweep, listBlocks } from "../src/sampler/blocks";
import { Chain } from "../src/sampler/chain";
import { rhatAndEss } from "../src/sampler/diagnostics";
import { normalised, particleMap, weighParticles } from "../src/sampler/importance";
import { mix, normal, STREAM_PARTICLES, STREAM_SWEEPS } from "../src/sampler/random";
import { beamsOf, problemOf, rangesOf, sitesOf } from "../src/sampler/world";

type World = {
  document: MapDocument; readings: number[]; exact: number[]; offsets: number[]; cells: number[]; loglik: number[]; no_hit: number[];
};
type Chains = World & { sites: number[]; draws: string[][]; log_likelihood: number[][]; log_prior: number[][]; rhat: number | null; ess: number | null };
type Particles = World & { log_weights: number[]; log_evidence: number; effective_sample_size: number; heaviest: string };

const file = process.env.BAYESMAP_LIBRARY;
const cases: { chains: Chains[]; particles: Particles[] } | null = file ? JSON.parse(readFileSync(file, "utf8")).samplers : null;
const withoutLibrary = "run by pytest, which makes the draws";

/** Numbers agree to rounding: those of single precision to a few units of their last place. */
function near(found: ArrayLike<number>, expected: number[], name: string, relative = 1e-12) {
  assert.equal(found.length, expected.length, name);
  expected.forEach((value, i) => assert(Math.abs(found[i] - value) <= relative * (1 + Math.abs(value)), `${name} ${i}: ${found[i]}, not ${value}`));
}

/** The problem of a world, made here and compared with the library's. */
function problem(world: World) {
  const beams = beamsOf(world.document);
  near(rangesOf(world.document, beams), world.exact, "exact ranges");
  const made = problemOf(world.document, beams, Float64Array.from(world.readings));
  assert.deepEqual([...made.table.offsets], world.offsets);
  assert.deepEqual([...made.table.cells], world.cells);
  near(made.table.loglik, world.loglik, "log-likelihood", 3e-7);
  near(made.table.noHit, world.no_hit, "log-likelihood of no hit", 3e-7);
  return made;
}

test("chains draw what the library's chains draw, cell by cell", (context) => {
  if (!cases) return context.skip(withoutLibrary);
  for (const world of cases.chains) {
    const { document } = world;
    const name = `${document.method}, ${document.order}, prior ${document.prior}, ${document.grid.shape}`;
    const made = problem(world);
    const blocks = document.method === "block" ? listBlocks(made) : null;
    const sites = sitesOf(document, blocks !== null);
    assert.deepEqual([...sites.order], world.sites, name);
    world.draws.forEach((draws, n) => {
      const chain = new Chain(made, new Uint8Array(document.grid.shape[0] * document.grid.shape[1]), mix(document.seed, n, STREAM_SWEEPS));
      const logs = draws.map((draw, sweep) => {
        if (blocks) blockSweep(chain, blocks, sites, sweep);
        else chain.sweep(sites, sweep);
        assert.equal(toBase64(packBits(chain.walls)), draw, `${name}: chain ${n}, sweep ${sweep}`);
        return { likelihood: chain.logLikelihood(), prior: made.prior.logProb(chain.walls) };
      });
      near(logs.map((log) => log.likelihood), world.log_likelihood[n], name, 1e-6);
      near(logs.map((log) => log.prior), world.log_prior[n], name);
    });
    const joint = world.log_likelihood.map((row, n) => row.map((value, i) => value + world.log_prior[n][i]));
    const found = rhatAndEss(joint);
    if (found) near([found.rhat, found.ess], [world.rhat!, world.ess!], `R-hat and effective sample size of ${name}`, 1e-9);
    else assert.equal(document.prior, 0, name); // a chain that cannot move has neither
  }
});

test("particles have the library's weights and maps", (context) => {
  if (!cases) return context.skip(withoutLibrary);
  for (const world of cases.particles) {
    const made = problem(world);
    const key = mix(world.document.seed, 0, STREAM_PARTICLES);
    // In two batches: a particle's map depends on its number alone.
    const weights = [...weighParticles(made, key, 0, 100), ...weighParticles(made, key, 100, world.log_weights.length - 100)];
    const { logWeights, logEvidence, effectiveSampleSize } = normalised(Float64Array.from(weights));
    near(logWeights, world.log_weights, "log weight", 1e-6);
    near([logEvidence, effectiveSampleSize], [world.log_evidence, world.effective_sample_size], "evidence and sample size", 1e-4);
    const heaviest = logWeights.indexOf(Math.max(...logWeights));
    assert.equal(toBase64(packBits(particleMap(made, key, heaviest))), world.heaviest);
  }
});

test("noise has mean 0 and variance 1, and as many large values as normal noise", () => {
  const draws = Array.from({ length: 20000 }, (_, i) => normal(mix(5, 1, 11), 2 * i));
  const moment = (power: number) => draws.reduce((sum, draw) => sum + draw ** power, 0) / draws.length;
  near([moment(1), moment(2), moment(3), moment(4) / 3], [0, 1, 0, 1], "moment", 0.05);
});
