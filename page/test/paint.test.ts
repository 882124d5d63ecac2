// Numbers behind what is painted, in a bundle without a browser: uPlot looks for one as it loads.

import assert from "node:assert/strict";
import { test } from "node:test";
import { entropyRgb, gradient, paletteOf, probabilityRgb, THEMES } from "../src/colour";
import { Labels } from "../src/layers/text";
import { evenSweeps, lowestSettled, shownPart } from "../src/panels/chart";
import type { Field } from "../src/protocol";

const brightness = (rgb: number[]) => (rgb[0] + rgb[1] + rgb[2]) / 3;

test("probability runs from paper to ink in steps that never turn back, in both themes", () => {
  for (const [theme, paperFirst] of [[THEMES.light, true], [THEMES.dark, false]] as const) {
    const levels = Array.from({ length: 101 }, (_, i) => brightness(probabilityRgb(theme, i / 100)));
    for (let i = 1; i <= 100; i++) assert(paperFirst ? levels[i] <= levels[i - 1] : levels[i] >= levels[i - 1], String(i));
    assert(Math.abs(levels[0] - levels[100]) > 180);
  }
  const [free, wall] = [probabilityRgb(THEMES.light, 0), probabilityRgb(THEMES.light, 1)];
  assert(brightness(free) > 235 && free[0] - free[2] < 6); // paper, not warm
  assert(brightness(wall) < 90);
});

test("unobserved cells are warm, and entropy is cividis from dark to bright", () => {
  const pixels = new Uint8ClampedArray(paletteOf(THEMES.light, "value").buffer);
  const at = (i: number, share = 16) => [...pixels.subarray(4 * (256 * share + i), 4 * (256 * share + i) + 4)];
  assert.deepEqual(at(0).slice(0, 3), probabilityRgb(THEMES.light, 0));
  assert.deepEqual(at(255).slice(0, 3), probabilityRgb(THEMES.light, 1));
  const warmth = (i: number, share: number) => at(i, share)[0] - at(i, share)[2];
  for (const i of [0, 255]) for (let share = 1; share <= 16; share++) assert(warmth(i, share) <= warmth(i, share - 1), `${i} ${share}`);
  for (const i of [0, 255]) assert(warmth(i, 0) > 12, String(i));
  assert.deepEqual(entropyRgb(0), [0x00, 0x22, 0x4e]);
  assert.deepEqual(entropyRgb(1).map(Math.round), [0xfe, 0xe8, 0x38]);
  const doubt = new Uint8ClampedArray(paletteOf(THEMES.light, "entropy").buffer);
  const bright = (i: number) => brightness([...doubt.subarray(4 * (4096 + i), 4 * (4096 + i) + 3)]);
  assert(bright(128) > bright(30) && bright(30) > bright(0) && Math.abs(bright(64) - bright(255 - 64)) < 2);
  const width = new Uint8ClampedArray(paletteOf(THEMES.light, "width").buffer);
  assert(brightness([...width.subarray(4 * 4351, 4 * 4351 + 3)]) > brightness([...width.subarray(4 * 4224, 4 * 4224 + 3)]));
  assert.match(gradient(entropyRgb), /^linear-gradient\(90deg,rgb\(0,34,78\),.*rgb\(254,232,56\)\)$/);
});

test("a draw has two colours, whether a beam reaches the cell or not", () => {
  const pixels = paletteOf(THEMES.light, "state");
  for (const p of [0, 255]) for (const share of [0, 8]) assert.equal(pixels[p + 256 * share], paletteOf(THEMES.light, "value")[p + 256 * 16]);
  assert.equal(gradient(() => [1, 2, 3], true), "linear-gradient(90deg,rgb(1,2,3) 50%,rgb(1,2,3) 50%)");
});

test("doubt has one colour, whether a beam reaches the cell or not", () => {
  const pixels = paletteOf(THEMES.light, "entropy");
  for (const p of [0, 128, 255]) for (const share of [0, 8]) assert.equal(pixels[p + 256 * share], pixels[p + 256 * 16]);
});

test("labels stand clear of each other and inside the picture, or nowhere", () => {
  const written: [string, number, number][] = [];
  const context = { measureText: (text: string) => ({ width: 6 * text.length }), strokeText: () => {}, fillText: (text: string, x: number, y: number) => void written.push([text, x, y]) };
  const labels = new Labels(context as unknown as CanvasRenderingContext2D, THEMES.light, 200, 60);
  assert(labels.place("at the edge", 1, 30, 4));
  assert(labels.place("beside it", 5, 30, 4));
  assert(!labels.place("no room left here", 4, 31, 4));
  assert(labels.place("top", 100, 3, 4) && labels.place("bottom", 160, 58, 4));
  labels.write();
  const boxes = written.map(([text, x, y]) => [x - 3 * text.length, x + 3 * text.length, y - 6, y + 6]);
  assert.equal(boxes.length, 4);
  boxes.forEach(([left, right, top, bottom], i) => {
    assert(left >= 0 && right <= 200 && top >= 0 && bottom <= 60, written[i][0]);
    for (const [l, r, t, b] of boxes.slice(i + 1)) assert(right <= l || left >= r || bottom <= t || top >= b, written[i][0]);
  });
});

test("a label keeps off marks and the axis where there is room, and stands on them where there is none", () => {
  const written: [string, number, number][] = [];
  const context = { measureText: (text: string) => ({ width: 6 * text.length }), strokeText: () => {}, fillText: (text: string, x: number, y: number) => void written.push([text, x, y]) };
  const labels = new Labels(context as unknown as CanvasRenderingContext2D, THEMES.light, 200, 100, 30);
  labels.avoid({ x: 100, y: 0 }, 3, { x: 100, y: 100 }); // a path from top to bottom
  assert(labels.place("8.2 m", 100, 50, 4, 60));
  assert(labels.place("far from the axis", 20, 80, 4));
  labels.avoid({ x: 160, y: 50 }, 100);
  assert(labels.place("on", 190, 20, 4));
  labels.write();
  const [[, x], [, middle], last] = written;
  assert(Math.abs(x - 100) >= 3 + 17 && middle - 51 >= 30, String(written));
  assert.equal(last[0], "on");
});

/** Two chains: every sweep at first, later every tenth, as the session thins them. */
function thinned() {
  const traced = Float32Array.from([...Array.from({ length: 100 }, (_, i) => i + 1), ...Array.from({ length: 90 }, (_, i) => 110 + 10 * i)]);
  const chain = (c: number) => Array.from(traced, (sweep) => -1000 / sweep - c);
  return { traced, trace: Float32Array.from([...chain(0), ...chain(1)]) } as Field;
}

test("of a trace evenly many sweeps are drawn, the first no denser than the rest; or the first alone", () => {
  const field = thinned();
  const sweeps = evenSweeps(field.traced).map((i) => field.traced[i]);
  const apart = sweeps.slice(1).map((sweep, i) => sweep - sweeps[i]);
  assert.deepEqual([sweeps[0], sweeps.at(-1)], [1, 1000]);
  assert(Math.max(...apart.slice(0, -1)) < 2 * Math.min(...apart.slice(0, -1)));
  const [first, ...chains] = shownPart(field, 2, "first");
  assert.deepEqual([...first], Array.from({ length: 50 }, (_, i) => i + 1));
  assert.equal(chains.length, 2);
  assert.deepEqual([chains[0][3], chains[1][3]], [field.trace[3], field.trace[190 + 3]]);
  assert.equal(shownPart(field, 2, "all")[0].length, sweeps.length);
});

test("the scale of a trace is that of its later part", () => {
  assert.equal(lowestSettled(thinned(), 2), Math.fround(-1000 / 250 - 1));
});
