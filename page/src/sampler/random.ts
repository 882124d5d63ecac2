// Counter-based random numbers: the bits of bayesmap.kernels.random, from the same keys and counters.

/** 64 bits in two halves, both from 0 to 2^32 - 1. */
export type Word = { high: number; low: number };

const TO_UNIT = 2 ** -53;
const HALF = 2 ** 32;

/** Streams of a seed, as in bayesmap.samplers.sampler. */
export const STREAM_SWEEPS = 1;
export const STREAM_START = 2;
export const STREAM_PARTICLES = 3;

/** Multiply a word in place by a constant, modulo 2^64: products of 16 bits are exact numbers. */
function multiply(word: Word, high: number, low: number) {
  const { high: wordHigh, low: wordLow } = word;
  const a0 = wordLow & 0xffff;
  const a1 = wordLow >>> 16;
  const b0 = low & 0xffff;
  const b1 = low >>> 16;
  const least = a0 * b0;
  const middle = a1 * b0 + (least >>> 16);
  const other = a0 * b1 + (middle & 0xffff);
  const carried = a1 * b1 + (middle >>> 16) + (other >>> 16);
  word.low = (((other & 0xffff) << 16) | (least & 0xffff)) >>> 0;
  word.high = (carried + Math.imul(wordHigh, low) + Math.imul(wordLow, high)) >>> 0;
}

/** x ^ (x >> shift), in place. */
function fold(word: Word, shift: number) {
  const { high, low } = word;
  word.low = (low ^ ((low >>> shift) | (high << (32 - shift)))) >>> 0;
  word.high = (high ^ (high >>> shift)) >>> 0;
}

/** Write 64 random bits into `out`. The counter lies within 2^53 of 0; a negative one counts from 2^64. */
export function randomBits(key: Word, counter: number, out: Word) {
  const n = counter + 1;
  out.high = Math.floor(n / HALF) >>> 0;
  out.low = n >>> 0;
  multiply(out, 0x9e3779b9, 0x7f4a7c15);
  const low = out.low + key.low;
  out.high = (out.high + key.high + (low >= HALF ? 1 : 0)) >>> 0;
  out.low = low >>> 0;
  fold(out, 30);
  multiply(out, 0xbf58476d, 0x1ce4e5b9);
  fold(out, 27);
  multiply(out, 0x94d049bb, 0x133111eb);
  fold(out, 31);
}

/** The first 53 bits, as a whole number. */
export const first53 = ({ high, low }: Word) => high * 0x200000 + (low >>> 11);

/** A number in the open interval (0, 1). */
export const toUniform = (word: Word) => (first53(word) + 0.5) * TO_UNIT;

/** A key mixed from whole numbers, such as (seed, chain, stream). */
export function mix(...words: number[]): Word {
  const mask = (value: bigint) => BigInt.asUintN(64, value);
  let state = 0n;
  for (const word of words) {
    let x = mask((state ^ BigInt(word)) + 0x9e3779b97f4a7c15n);
    x = mask((x ^ (x >> 30n)) * 0xbf58476d1ce4e5b9n);
    x = mask((x ^ (x >> 27n)) * 0x94d049bb133111ebn);
    state = x ^ (x >> 31n);
  }
  return { high: Number(state >> 32n), low: Number(state & 0xffffffffn) };
}

const ODD_1 = 0x9e3779b1;
const ODD_2 = 0x85ebca6b;

function scramble(x: number, key: number): number {
  let mixed = Math.imul(x + key, ODD_1);
  mixed = Math.imul(mixed ^ (mixed >>> 15), ODD_2);
  return mixed ^ (mixed >>> 13);
}

/** Element i of a permutation of range(size): a Feistel cipher of `bits` bits, repeated until it falls inside. */
export function shuffled(i: number, size: number, bits: number, key: Word): number {
  const lowBits = bits >>> 1;
  const lowMask = (1 << lowBits) - 1;
  const highMask = (1 << (bits - lowBits)) - 1;
  let x = i;
  do {
    let high = x >>> lowBits;
    let low = x & lowMask;
    high ^= scramble(low, key.low) & highMask;
    low ^= scramble(high, key.high) & lowMask;
    high ^= scramble(low, key.low ^ ODD_1) & highMask;
    low ^= scramble(high, key.high ^ ODD_1) & lowMask;
    x = ((high << lowBits) | low) >>> 0;
  } while (x >= size);
  return x;
}

/** Width in bits of the cipher that shuffles `size` elements. */
export const cipherBits = (size: number) => Math.max(2, 32 - Math.clz32(size - 1));

/** A standard normal number (Box and Muller, 1958); takes two counters. */
export function normal(key: Word, counter: number): number {
  const word = { high: 0, low: 0 };
  randomBits(key, counter, word);
  const u = toUniform(word);
  randomBits(key, counter + 1, word);
  return Math.sqrt(-2 * Math.log(u)) * Math.cos(2 * Math.PI * toUniform(word));
}
