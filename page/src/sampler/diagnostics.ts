// R-hat and effective sample size of a quantity of several chains, as bayesmap.posterior.summary computes them.

function mean(values: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 0; i < values.length; i++) sum += values[i];
  return sum / values.length;
}
const variance = (values: number[]) => {
  const middle = mean(values);
  return values.reduce((sum, value) => sum + (value - middle) ** 2, 0) / (values.length - 1);
};

const polynomial = (coefficients: number[], x: number) => coefficients.reduceRight((sum, one) => sum * x + one, 0);
const MIDDLE = [
  [3.387132872796366608, 133.14166789178437745, 1971.5909503065514427, 13731.693765509461125, 45921.953931549871457, 67265.770927008700853, 33430.575583588128105, 2509.0809287301226727],
  [1, 42.313330701600911252, 687.1870074920579083, 5394.1960214247511077, 21213.794301586595867, 39307.89580009271061, 28729.085735721942674, 5226.495278852854561],
];
const TAIL = [
  [1.42343711074968357734, 4.6303378461565452959, 5.7694972214606914055, 3.64784832476320460504, 1.27045825245236838258, 0.24178072517745061177, 0.0227238449892691845833, 7.7454501427834140764e-4],
  [1, 2.05319162663775882187, 1.6763848301838038494, 0.68976733498510000455, 0.14810397642748007459, 0.0151986665636164571966, 5.475938084995344946e-4, 1.05075007164441684324e-9],
];

/** The normal quantile of a probability between 1e-11 and 1 - 1e-11 (Wichura, 1988, algorithm AS 241). */
export function normalQuantile(p: number): number {
  const q = p - 0.5;
  if (Math.abs(q) <= 0.425) {
    const r = 0.180625 - q * q;
    return (q * polynomial(MIDDLE[0], r)) / polynomial(MIDDLE[1], r);
  }
  const r = Math.sqrt(-Math.log(q < 0 ? p : 1 - p)) - 1.6;
  return (Math.sign(q) * polynomial(TAIL[0], r)) / polynomial(TAIL[1], r);
}

/** The first and the last half of each chain. */
function split(chains: number[][]): number[][] {
  const half = chains[0].length >> 1;
  return [...chains.map((chain) => chain.slice(0, half)), ...chains.map((chain) => chain.slice(chain.length - half))];
}

/** Normal scores of the ranks over all chains; ties share their mean rank. */
function rankNormalised(chains: number[][]): number[][] {
  const sorted = Float64Array.from(chains.flat()).sort();
  const scores = new Map<number, number>();
  for (let i = 0; i < sorted.length; ) {
    let end = i + 1;
    while (end < sorted.length && sorted[end] === sorted[i]) end++;
    scores.set(sorted[i], normalQuantile(((i + 1 + end) / 2 - 0.375) / (sorted.length + 0.25)));
    i = end;
  }
  return chains.map((chain) => chain.map((value) => scores.get(value)!));
}

function plainRhat(chains: number[][]): number {
  const n = chains[0].length;
  return Math.sqrt((n - 1) / n + variance(chains.map(mean)) / mean(chains.map(variance)));
}

/** In-place Fourier transform of a power of two of numbers. */
function fourier(re: Float64Array, im: Float64Array) {
  const n = re.length;
  for (let i = 1, j = 0; i < n; i++) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) [re[i], re[j], im[i], im[j]] = [re[j], re[i], im[j], im[i]];
  }
  for (let size = 2; size <= n; size *= 2) {
    for (let k = 0; k < size / 2; k++) {
      const angle = (-2 * Math.PI * k) / size;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let i = k; i < n; i += size) {
        const j = i + size / 2;
        const [x, y] = [re[j] * c - im[j] * s, re[j] * s + im[j] * c];
        [re[j], im[j]] = [re[i] - x, im[i] - y];
        re[i] += x;
        im[i] += y;
      }
    }
  }
}

function autocovariance(chain: number[]): Float64Array {
  const n = chain.length;
  const middle = mean(chain);
  const length = 2 ** Math.ceil(Math.log2(2 * n));
  const [re, im] = [new Float64Array(length), new Float64Array(length)];
  chain.forEach((value, i) => (re[i] = value - middle));
  fourier(re, im);
  for (let i = 0; i < length; i++) [re[i], im[i]] = [re[i] ** 2 + im[i] ** 2, 0];
  fourier(re, im); // the spectrum is even: forth is back
  return re.slice(0, n).map((value) => value / length / n);
}

/** Geyer's initial monotone sequence; the chains are not split. */
function plainEss(chains: number[][]): number {
  const [m, n] = [chains.length, chains[0].length];
  const lagged = chains.map(autocovariance);
  const within = (mean(lagged.map((one) => one[0])) * n) / (n - 1);
  const plus = (within * (n - 1)) / n + variance(chains.map(mean));
  const rho = (lag: number) => (lag ? 1 - (within - mean(lagged.map((one) => one[lag]))) / plus : 1);
  const pairs = Math.max(1, Math.ceil((n - 2) / 2));
  let tau = -1;
  let least = Infinity;
  for (let pair = 0; pair < pairs; pair++) {
    const even = rho(2 * pair);
    const sum = even + rho(2 * pair + 1);
    if (!(sum > 0) || pair === pairs - 1) {
      tau += sum > 0 ? even : Math.max(even, 0);
      break;
    }
    least = Math.min(least, sum);
    tau += 2 * least;
  }
  return (m * n) / Math.max(tau, 1 / Math.log10(m * n));
}

/** Rank-normalised R-hat and bulk effective sample size; null below four draws a chain, and where nothing ever changed. */
export function rhatAndEss(chains: number[][]): { rhat: number; ess: number } | null {
  if (chains[0].length < 4 || chains.every((chain) => chain.every((value) => value === chains[0][0]))) return null;
  const halves = split(chains);
  const all = Float64Array.from(halves.flat()).sort();
  const median = (all[(all.length - 1) >> 1] + all[all.length >> 1]) / 2;
  const folded = halves.map((half) => half.map((value) => Math.abs(value - median)));
  const ranked = rankNormalised(halves);
  const [bulk, spread] = [plainRhat(ranked), plainRhat(rankNormalised(folded))];
  const rhat = Number.isNaN(spread) ? bulk : Number.isNaN(bulk) ? spread : Math.max(bulk, spread);
  return { rhat, ess: plainEss(ranked) };
}
