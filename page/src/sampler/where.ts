// Where a scan was taken in a drawn world: the posterior over free positions and all headings. A search over cells and
// headings finds candidates; each is refined by importance sampling from a normal law that adapts to the posterior.

import { unpackBits, fromBase64 } from "../geometry/bits";
import type { Place } from "../messages";
import type { MapDocument } from "../protocol";
import { mix, normal, type Word } from "./random";
import { cast } from "./rays";
import { fan } from "./world";

const OUTLIERS = 0.03; // share of readings that are uniform up to the longest range
const MOST_BEAMS = 40; // of the search
const DIRECTIONS = 180; // of the ranges that the search looks up
const HEADINGS = 90;
const CLIP = 9; // squared errors of the search, in standard deviations, count for so much at most
const CANDIDATES = 24;
const VAGUE = 60; // candidates: where that many poses fit, no place is worth a name
const ROUNDS = 7;
const POSES = 50; // of a candidate and round; three times as many in the last
const BEHIND_NATS = 25; // candidates that are so far behind the best, times the rounds to come, are given up
const LEAST_ESS = 10;
const MOST_POSES = 1000; // in the cloud
const SEARCHED = 4000; // poses among which candidates are looked for
const STREAM_WHERE = 21;

type Pose = [number, number, number];
/** The answer: places, the likeliest first, and a cloud of poses, the lightest first. */
export type Located = { modes: Place[]; pose: Float32Array; weight: Float32Array; nats_per_beam: number };

/** The posterior of the pose of readings, metres, of which those without a `hit` are no return. */
export function locate(document: MapDocument, readings: ArrayLike<number>, hit: ArrayLike<number>): Located {
  const { grid, noise, max_range, seed } = document;
  const { shape: [nx, ny], resolution, origin } = grid;
  const walls = unpackBits(fromBase64(document.walls), nx * ny);
  const angles = fan(document);
  const longest = max_range / resolution;
  const rangeAt = (x: number, y: number, angle: number) =>
    resolution * cast(walls, grid.shape, { x, y, ux: Math.cos(angle), uy: Math.sin(angle) }, longest);
  const free = (x: number, y: number) => x >= 0 && y >= 0 && x < nx && y < ny && !walls[Math.floor(x) * ny + Math.floor(y)];

  /** Log-likelihood of the readings at a pose in cells and radians. */
  const height = (1 - OUTLIERS) / (noise * Math.sqrt(2 * Math.PI));
  const logLikelihood = ([x, y, yaw]: Pose) => {
    if (!free(x, y)) return -Infinity;
    let sum = 0;
    for (let b = 0; b < angles.length; b++) {
      const range = rangeAt(x, y, yaw + angles[b]);
      const error = (readings[b] - range) / noise;
      const lost = range >= max_range;
      if (!hit[b]) sum += Math.log(lost ? 1 - OUTLIERS / 2 : OUTLIERS / 2);
      else sum += Math.log((lost ? 0 : height * Math.exp(-0.5 * error * error)) + OUTLIERS / max_range);
    }
    return sum;
  };

  const fitting = search();
  const candidates = apart(fitting.slice(0, SEARCHED), (pose) => pose, 1.5, 0.2, VAGUE);
  if (candidates.length === VAGUE) return vague(fitting.filter((_, i) => i % Math.ceil(fitting.length / MOST_POSES) === 0));
  const key = mix(seed, 0, STREAM_WHERE);
  let [counter, best] = [0, -Infinity];
  let places = candidates.slice(0, CANDIDATES).map((mean) => ({ mean, root: diagonal(0.4, 0.4, 0.04), poses: [] as Pose[], logs: [] as number[], top: -Infinity }));
  for (let round = 0; round <= ROUNDS; round++) {
    for (const place of places) {
      const last = round === ROUNDS;
      const wide = last ? 1.4 : 1.2; // tails are heavier than the law's
      const drawn = Array.from({ length: last ? 3 * POSES : POSES }, () => draw(place.mean, place.root, wide, key, (counter += 3)));
      const logs = drawn.map(({ pose, log }) => logLikelihood(pose) - log);
      place.top = Math.max(place.top, ...drawn.map(({ log }, i) => logs[i] + log));
      best = Math.max(best, place.top);
      Object.assign(place, { poses: drawn.map(({ pose }) => pose), logs });
      const [mean, covariance] = moments(place.poses, tempered(logs, last ? 1 : LEAST_ESS));
      if (!last && covariance) [place.mean, place.root] = [mean, cholesky(covariance)];
    }
    places = places.filter((place) => place.top > best - BEHIND_NATS * (ROUNDS - round + 1));
    if (round >= 2) places = apart(places.sort((a, b) => b.top - a.top), ({ mean }) => mean, 1, 0.15); // several candidates climb one hill
  }
  const most = Math.max(...places.flatMap(({ logs }) => logs));
  const shares = places.map(({ poses, logs }) => logs.map((log) => Math.exp(log - most) / poses.length));
  const total = shares.flat().reduce((a, b) => a + b, 0);
  return answer(
    places.map(({ poses }, i) => ({ poses, weights: shares[i].map((share) => share / total) })),
    best / angles.length,
  );

  /** Poses of cells and headings that fit about, the best first. */
  function search(): Pose[] {
    const table = new Float32Array(DIRECTIONS);
    const chosen = Array.from(angles.keys()).filter((_, b) => b % Math.ceil(angles.length / MOST_BEAMS) === 0);
    const sigma = Math.hypot(noise, 0.3 * resolution);
    const found: { pose: Pose; loss: number }[] = [];
    for (let c = 0; c < nx * ny; c++) {
      if (walls[c]) continue;
      const [x, y] = [Math.floor(c / ny) + 0.5, (c % ny) + 0.5];
      for (let d = 0; d < DIRECTIONS; d++) table[d] = rangeAt(x, y, (d * 2 * Math.PI) / DIRECTIONS);
      for (let k = 0; k < HEADINGS; k++) {
        const yaw = (k * 2 * Math.PI) / HEADINGS;
        let loss = 0;
        for (const b of chosen) {
          const d = Math.round(((yaw + angles[b]) * DIRECTIONS) / (2 * Math.PI));
          const range = table[((d % DIRECTIONS) + DIRECTIONS) % DIRECTIONS];
          const error = (readings[b] - range) / sigma;
          loss += hit[b] ? Math.min(error * error, CLIP) : range >= max_range ? 0 : CLIP;
        }
        found.push({ pose: [x, y, yaw], loss });
      }
    }
    found.sort((a, b) => a.loss - b.loss);
    const least = found[0]?.loss ?? 0;
    return found.filter(({ loss }) => loss < least + 0.25 * CLIP * chosen.length).map(({ pose }) => pose);
  }

  function vague(poses: Pose[]): Located {
    const logs = poses.map(logLikelihood);
    return answer([{ poses, weights: tempered(logs, logs.length / 2) }], Math.max(...logs) / angles.length);
  }

  /** Places and the cloud in metres. */
  function answer(parts: { poses: Pose[]; weights: number[] }[], nats_per_beam: number): Located {
    const modes = parts.map(({ poses, weights }): Place => {
      const probability = weights.reduce((a, b) => a + b, 0);
      const [[x, y, yaw], covariance] = moments(poses, weights.map((weight) => weight / probability));
      const metres = [resolution, resolution, 1];
      const scaled = (covariance ?? diagonal(0, 0, 0)).map((row, i) => row.map((value, j) => value * metres[i] * metres[j]));
      const [[a, b], [, d]] = scaled;
      const sigma_m = Math.sqrt((a + d) / 2 + Math.hypot((a - d) / 2, b));
      const mean = [origin[0] + x * resolution, origin[1] + y * resolution, Math.atan2(Math.sin(yaw), Math.cos(yaw))];
      return { mean, covariance: scaled, probability, sigma_m, sigma_rad: Math.sqrt(scaled[2][2]) };
    });
    const cloud = parts.flatMap(({ poses, weights }) => poses.map((pose, i) => ({ pose, weight: weights[i] })));
    const heaviest = cloud.sort((a, b) => a.weight - b.weight).slice(-MOST_POSES);
    return {
      modes: modes.sort((a, b) => b.probability - a.probability),
      pose: Float32Array.from(heaviest.flatMap(({ pose: [x, y, yaw] }) => [origin[0] + x * resolution, origin[1] + y * resolution, yaw])),
      weight: Float32Array.from(heaviest, ({ weight }) => weight),
      nats_per_beam,
    };
  }
}

/** Those that are apart from all better ones, by cells or by radians. */
function apart<T>(sorted: T[], poseOf: (one: T) => Pose, cells: number, radians: number, most = Infinity): T[] {
  const kept: T[] = [];
  for (const one of sorted) {
    if (kept.length >= most) break;
    const [x, y, yaw] = poseOf(one);
    const near = (other: T) => {
      const [u, v, turn] = poseOf(other);
      return Math.hypot(x - u, y - v) < cells && Math.abs(Math.atan2(Math.sin(yaw - turn), Math.cos(yaw - turn))) < radians;
    };
    if (!kept.some(near)) kept.push(one);
  }
  return kept;
}

const diagonal = (...values: number[]) => values.map((value, i) => values.map((_, j) => (i === j ? value : 0)));

/** A draw of a normal law, its standard deviations `wide` times wider, and its log density but for a constant. */
function draw(mean: Pose, root: number[][], wide: number, key: Word, counter: number) {
  const z = [0, 1, 2].map((i) => normal(key, 2 * (counter + i)));
  const pose = mean.map((at, i) => at + wide * root[i].reduce((sum, value, j) => sum + value * z[j], 0)) as Pose;
  const log = -0.5 * (z[0] ** 2 + z[1] ** 2 + z[2] ** 2) - Math.log(wide ** 3 * root[0][0] * root[1][1] * root[2][2]);
  return { pose, log };
}

/** Normalised weights, tempered until they are worth so many. */
function tempered(logs: number[], leastEss: number): number[] {
  const most = Math.max(...logs);
  if (most === -Infinity) return logs.map(() => 1 / logs.length);
  for (let power = 1; ; power /= 2) {
    const weights = logs.map((log) => Math.exp(power * (log - most)));
    const total = weights.reduce((a, b) => a + b, 0);
    if (power < 1e-6 || total ** 2 >= leastEss * weights.reduce((a, b) => a + b * b, 0)) return weights.map((weight) => weight / total);
  }
}

/** Mean and covariance of weighted poses; headings are taken about the heaviest one. */
function moments(poses: Pose[], weights: number[]): [Pose, number[][] | null] {
  const heaviest = poses[weights.indexOf(Math.max(...weights))];
  const away = poses.map((pose) => pose.map((value, i) => (i === 2 ? Math.atan2(Math.sin(value - heaviest[2]), Math.cos(value - heaviest[2])) : value - heaviest[i])));
  const sum = (value: (pose: number[]) => number) => away.reduce((total, pose, k) => total + weights[k] * value(pose), 0);
  const shift = [0, 1, 2].map((i) => sum((pose) => pose[i]));
  const covariance = shift.map((m, i) => shift.map((n, j) => sum((pose) => (pose[i] - m) * (pose[j] - n))));
  const mean = heaviest.map((value, i) => value + shift[i]) as Pose;
  return [mean, covariance.every((row, i) => row[i] >= 0) && Number.isFinite(covariance[0][0]) ? covariance : null];
}

/** The lower root of a covariance, (3, 3), with a floor for each variance. */
function cholesky(covariance: number[][]): number[][] {
  const root = diagonal(0, 0, 0);
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j <= i; j++) {
      let value = covariance[i][j];
      for (let k = 0; k < j; k++) value -= root[i][k] * root[j][k];
      root[i][j] = i === j ? Math.sqrt(Math.max(value, 1e-7)) : value / root[j][j];
    }
  }
  return root;
}
