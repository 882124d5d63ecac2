// As in bayesmap.viz.palette: probability runs from paper to ink along a straight line in CIELAB, so equal steps look
// equally large to all kinds of colour vision; marks are Okabe and Ito's; unobserved is warm, hatched, and neither.

import { clamp, entropyBits } from "./geometry/cells";

type Triple = [number, number, number];

const LIGHT = {
  paper: [98, 0, 1] as Triple,
  ink: [14, 6, -24] as Triple,
  unobserved: "#efe7d8",
  unobservedWall: "#d3c5aa",
  hatch: "#bfae92",
  truth: "#d55e00",
  ray: "#0072b2",
  noReturn: "#b0679a",
  sensor: "#009e73",
  draw: "#e69f00",
  ghost: "#7b52c9",
  belief: "#6a3fb5",
  halo: "#ffffff",
  lines: "rgba(20,30,60,.07)",
  frame: "#6b7078",
  axis: "#565d68",
  ground: "#f4f5f7",
};
export type Theme = typeof LIGHT;
const DARK: Theme = {
  paper: [17, 0, -5],
  ink: [95, -2, 6],
  unobserved: "#322d25",
  unobservedWall: "#5a503f",
  hatch: "#635843",
  truth: "#f08c3c",
  ray: "#56b4e9",
  noReturn: "#d99abf",
  sensor: "#2fcf9f",
  draw: "#ffb92e",
  ghost: "#b99cff",
  belief: "#c3a6ff",
  halo: "#10141a",
  lines: "rgba(220,230,255,.07)",
  frame: "#7d8694",
  axis: "#a3abb8",
  ground: "#12151a",
};
export const THEMES = { light: LIGHT, dark: DARK };

/** Cividis in 16 steps (Nunez, Anderton and Renslow 2018). */
const CIVIDIS =
  "00224e002e6a1a386f32436d434e6c535a6d61656f6f70737d7c788c88789b9476aba072bcae6ccdbb63dec958f0d846fee838";

/** CIELAB (D65) to sRGB in 0..255 (IEC 61966-2-1). */
function labToRgb([l, a, b]: Triple): Triple {
  const fy = (l + 16) / 116;
  const white = [0.95047, 1, 1.08883];
  const [x, y, z] = [fy + a / 500, fy, fy - b / 200].map((f, i) => {
    const ratio = f > 6 / 29 ? f ** 3 : 3 * (6 / 29) ** 2 * (f - 4 / 29);
    return ratio * white[i];
  }) as Triple;
  return [
    3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
    -0.969266 * x + 1.8760108 * y + 0.041556 * z,
    0.0556434 * x - 0.2040259 * y + 1.0572252 * z,
  ].map((v) => {
    const c = clamp(v, 0, 1);
    return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  }) as Triple;
}

const hexRgb = (hex: string, at = 1) => [0, 2, 4].map((k) => parseInt(hex.slice(at + k, at + k + 2), 16)) as Triple;
const mix = (a: Triple, b: Triple, t: number) => a.map((v, i) => v + t * (b[i] - v)) as Triple;

/** The colour of wall probability p. */
export const probabilityRgb = (theme: Theme, p: number) => labToRgb(mix(theme.paper, theme.ink, p));

/** The colour of an entropy in bits. */
export function entropyRgb(bits: number): Triple {
  const i = Math.min(15, Math.floor(bits * 16));
  return mix(hexRgb(CIVIDIS, 6 * i), hexRgb(CIVIDIS, 6 * i + 6), bits * 16 - i);
}

/** Packed pixels: 256 by probability in 255ths, for each sixteenth of the probability that a beam reaches the cell. */
export function paletteOf(theme: Theme, layer: "value" | "entropy" | "width" | "state"): Uint32Array {
  const pixels = new Uint8ClampedArray(4 * 256 * 17).fill(255);
  const [free, wall] = [hexRgb(theme.unobserved), hexRgb(theme.unobservedWall)];
  for (let i = 0; i < 256; i++) {
    const doubt = layer === "entropy" ? entropyBits(i / 255) : i / 255;
    const known = layer === "value" || layer === "state" ? probabilityRgb(theme, i / 255) : entropyRgb(doubt);
    const unknown = layer === "value" ? mix(free, wall, i / 255) : known; // doubt has one colour, which the legend names, and a state of a draw has one
    for (let share = 0; share <= 16; share++) pixels.set(mix(unknown, known, share / 16), 4 * (i + 256 * share));
  }
  return new Uint32Array(pixels.buffer);
}

/** A CSS gradient of a palette, for the legend, or two swatches. */
export const gradient = (color: (t: number) => Triple, swatches = false) => {
  const css = (t: number) => `rgb(${color(t).map(Math.round)})`;
  return `linear-gradient(90deg,${swatches ? `${css(0)} 50%,${css(1)} 50%` : [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1].map(css)})`;
};
