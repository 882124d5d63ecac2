import "./dom";
import assert from "node:assert/strict";
import { test } from "node:test";
import { deflate, fromBase64, inflate, packBits, toBase64, unpackBits } from "../src/geometry/bits";
import { cellOf, centreOf, clamp, entropyBits, inside, lineOfCells, toCells, toMetres, wallEdges } from "../src/geometry/cells";
import { mostOpen, nearestFree } from "../src/geometry/room";
import { GUTTER, Viewport } from "../src/layers/viewport";
import type { Grid, Pair } from "../src/protocol";
import { aDocument, SHAPE } from "./desk";

/** The tutorial's map, packed. */
const TUTORIAL = "AAAAAAAcAICgBAQAOCAAQQACDAA4IABBAAIIABBAAIPgfAECAAhwAEIAAhAAH4AAAAAAAAAAAAA=";
const GRID: Grid = { shape: [40, 30], resolution: 0.2, origin: [-1.3, 2.5] };

/** Numbers that look random, and are the same each time. */
function* numbers(seed = 1) {
  for (let state = seed; ; ) yield (state = (state * 48271) % 2147483647) / 2147483647;
}

test("bits are packed with the most significant first, and unpacked again", () => {
  assert.deepEqual([...packBits(Uint8Array.of(1, 0, 0, 0, 0, 0, 0, 1, 1))], [0b10000001, 0b10000000]);
  const random = numbers();
  for (const n of [0, 1, 7, 8, 9, 441]) {
    const bits = Uint8Array.from({ length: n }, () => Math.round(random.next().value as number));
    assert.deepEqual(unpackBits(packBits(bits), n), bits);
  }
  assert.deepEqual([...unpackBits(fromBase64("AIA="), 9)], [0, 0, 0, 0, 0, 0, 0, 0, 1]);
});

test("base64 is read in both alphabets and written whole however long", async () => {
  assert.deepEqual(fromBase64("-_8"), fromBase64("+/8="));
  const random = numbers(7);
  const bytes = Uint8Array.from({ length: 20_001 }, () => 255 * (random.next().value as number));
  assert.deepEqual(fromBase64(toBase64(bytes)), bytes);
  assert.equal(toBase64(bytes), btoa(String.fromCharCode(...bytes)));
  assert.deepEqual(await inflate(await deflate(bytes)), bytes);
});

test("a line of cells begins and ends where it should and has no gaps", () => {
  const random = numbers(3);
  for (let i = 0; i < 300; i++) {
    const [ax, ay, bx, by] = [0, 0, 0, 0].map(() => Math.floor(40 * (random.next().value as number)));
    const line = lineOfCells({ x: ax, y: ay }, { x: bx, y: by });
    assert.deepEqual(line[0], { x: ax, y: ay });
    assert.deepEqual(line.at(-1), { x: bx, y: by });
    assert.equal(line.length, Math.max(Math.abs(ax - bx), Math.abs(ay - by)) + 1);
    for (let k = 1; k < line.length; k++) assert(Math.max(Math.abs(line[k].x - line[k - 1].x), Math.abs(line[k].y - line[k - 1].y)) === 1);
    for (const { x, y } of line) {
      const off = Math.abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) / Math.max(1, Math.hypot(bx - ax, by - ay));
      assert(off <= 0.7072, `${x}, ${y} is ${off} off`); // half a cell's diagonal
    }
  }
});

test("metres and cells: a cell's centre lies in it, and both ways are inverse", () => {
  for (const cell of [{ x: 0, y: 0 }, { x: 39, y: 29 }, { x: 17, y: 4 }]) {
    assert.deepEqual(cellOf(centreOf(cell, GRID), GRID), cell);
    const there = toMetres(toCells({ x: 1.234, y: 5.678 }, GRID), GRID);
    assert(Math.hypot(there.x - 1.234, there.y - 5.678) < 1e-12);
  }
  assert.deepEqual(cellOf({ x: -1.31, y: 2.49 }, GRID), { x: -1, y: -1 });
  assert(Math.abs(centreOf({ x: 2, y: 3 }, GRID).x - -0.8) < 1e-12 && Math.abs(centreOf({ x: 2, y: 3 }, GRID).y - 3.2) < 1e-12);
  assert(inside({ x: 0, y: 29 }, GRID.shape) && !inside({ x: 40, y: 0 }, GRID.shape) && !inside({ x: 0, y: 30 }, GRID.shape) && !inside({ x: -1, y: 0 }, GRID.shape));
  assert.deepEqual([clamp(-1, 0, 5), clamp(9, 0, 5), clamp(3, 0, 5)], [0, 5, 3]);
});

test("entropy is one bit where nothing is known and none where all is", () => {
  assert.deepEqual([0, 0.5, 1].map(entropyBits), [0, 1, 0]);
  assert(Math.abs(entropyBits(0.11) - 0.4999) < 1e-3 && Math.abs(entropyBits(0.2) - entropyBits(0.8)) < 1e-12);
});

test("edges are those between walls and free cells, and collinear ones are one line", () => {
  const lines = (cells: Pair[], [nx, ny]: Pair) => {
    const walls = new Uint8Array(nx * ny);
    for (const [x, y] of cells) walls[x * ny + y] = 1;
    return (wallEdges(walls, [nx, ny]) as unknown as { lines: number[][] }).lines.sort();
  };
  assert.deepEqual(lines([[1, 0], [1, 1]], [3, 2]), [[1, 0, 1, 2], [1, 0, 2, 0], [1, 2, 2, 2], [2, 0, 2, 2]]);
  assert.deepEqual(lines([], [3, 2]), []);
  // each unit edge is there once, however walls lie
  const random = numbers(5);
  const [nx, ny] = [9, 6];
  const cells: Pair[] = Array.from({ length: nx * ny }, (_, i): Pair => [Math.floor(i / ny), i % ny]).filter(() => (random.next().value as number) < 0.4);
  const is = (x: number, y: number) => cells.some(([a, b]) => a === x && b === y);
  let edges = 0;
  for (let x = 0; x <= nx; x++) for (let y = 0; y <= ny; y++) edges += Number(y < ny && is(x - 1, y) !== is(x, y)) + Number(x < nx && is(x, y - 1) !== is(x, y));
  assert.equal(lines(cells, [nx, ny]).reduce((sum, [a, b, c, d]) => sum + Math.abs(a - c) + Math.abs(b - d), 0), edges);
});

test("another sensor stands in the open, apart from others, and never in a wall", () => {
  const walls = new Uint8Array(441);
  const wall = (x: number, y: number) => (walls[x * 21 + y] = 1);
  for (let i = 0; i < 21; i++) for (const [x, y] of [[0, i], [20, i], [i, 0], [i, 20], [12, i]]) if (x !== 12 || i < 15) wall(x, y);
  const document = aDocument();
  for (let count = 2; count <= 4; count++) {
    const place = mostOpen(document, walls);
    assert(place);
    for (const other of document.sensors) assert(Math.hypot(place.x - other.x, place.y - other.y) >= 4, `${count}`);
    for (let x = place.x - 1; x <= place.x + 1; x++) for (let y = place.y - 1; y <= place.y + 1; y++) assert.equal(walls[x * 21 + y], 0);
    document.sensors.push({ id: count, ...place, yaw: 0 });
  }
  assert.equal(mostOpen(document, new Uint8Array(441).fill(1)), null);
  // the outside is no better than a wall
  assert.deepEqual(mostOpen({ ...document, sensors: [] }, new Uint8Array(441)), { x: 10, y: 10 });
});

test("another sensor stands in sight of the first, not behind a wall where there is more room", () => {
  const walls = new Uint8Array(441);
  for (let i = 8; i <= 12; i++) for (const [x, y] of [[8, i], [12, i], [i, 8], [i, 12]]) walls[x * 21 + y] = 1;
  const place = mostOpen(aDocument(), walls);
  assert(place && [place.x, place.y].every((v) => v > 8 && v < 12) && (place.x !== 10 || place.y !== 10));
  walls[9 * 21 + 9] = walls[9 * 21 + 10] = walls[9 * 21 + 11] = walls[10 * 21 + 9] = walls[10 * 21 + 11] = 1;
  for (const y of [9, 10, 11]) walls[11 * 21 + y] = 1;
  const outside = mostOpen(aDocument(), walls); // there is no room beside the first
  assert(outside && walls[outside.x * 21 + outside.y] === 0);
  const tutorial = aDocument({ walls: TUTORIAL });
  assert.deepEqual(mostOpen(tutorial, unpackBits(fromBase64(TUTORIAL), 441)), { x: 3, y: 7 });
});

test("the nearest free cell is no wall and holds no sensor", () => {
  const document = aDocument();
  const walls = new Uint8Array(441);
  walls[10 * 21 + 11] = walls[11 * 21 + 10] = walls[9 * 21 + 10] = 1;
  assert.deepEqual(nearestFree(document, walls, { x: 10, y: 10 }), { x: 10, y: 9 });
  assert.deepEqual(nearestFree(document, walls, { x: 3, y: 4 }), { x: 3, y: 4 });
  assert.equal(nearestFree(document, new Uint8Array(441).fill(1), { x: 3, y: 4 }), null);
});

function view(ratio = 1) {
  const made = new Viewport();
  made.resize(960, 800, ratio);
  made.fit(SHAPE);
  return made;
}

test("the whole map fits between the axes, on whole device pixels", () => {
  for (const ratio of [1, 2, 1.5]) {
    const { transform, width, height } = view(ratio);
    const { scale, x, y } = transform;
    assert(x >= GUTTER.left - 1 && x + 21 * scale <= width - GUTTER.right + 1 && y >= GUTTER.top - 1 && y + 21 * scale <= height - GUTTER.bottom + 1);
    for (const pixels of [scale * ratio, x * ratio, y * ratio]) assert(Math.abs(pixels - Math.round(pixels)) < 1e-9);
    assert(21 * scale > 0.9 * (height - GUTTER.top - GUTTER.bottom));
  }
});

test("zoom keeps what is under the pointer, pan moves with it, and both keep the map in sight", () => {
  const made = view();
  const about = made.fromGrid({ x: 10.5, y: 12.5 }, 21);
  const before = made.transform.scale;
  for (let i = 0; i < 8; i++) made.zoom(1.4, about, SHAPE);
  const after = made.fromGrid({ x: 10.5, y: 12.5 }, 21);
  assert(Math.hypot(after.x - about.x, after.y - about.y) < 1.5);
  assert(made.transform.scale > 3 * before && !made.fitted);
  made.pan(50, 40, SHAPE);
  const moved = made.fromGrid({ x: 10.5, y: 12.5 }, 21);
  assert(Math.abs(moved.x - after.x - 50) <= 1 && Math.abs(moved.y - after.y - 40) <= 1);
  made.pan(1e6, -1e6, SHAPE);
  const { x, y, scale } = made.transform;
  assert(x <= 960 - 59 && y + 21 * scale >= 59);
  for (let i = 0; i < 40; i++) made.zoom(1.4, about, SHAPE);
  assert.equal(made.transform.scale, 160);
  for (let i = 0; i < 80; i++) made.zoom(1 / 1.4, about, SHAPE);
  assert(made.transform.scale * 21 > 800 / 3 - 1);
  made.fit(SHAPE);
  assert(made.fitted && made.transform.scale === before);
});

test("a place of the grid and its point on the canvas are inverse, y up", () => {
  const made = view();
  made.zoom(1.7, { x: 111, y: 222 }, SHAPE);
  const back = made.toGrid(made.fromGrid({ x: 3.25, y: 17.5 }, 21), 21);
  assert(Math.hypot(back.x - 3.25, back.y - 17.5) < 1e-9);
  assert(made.fromGrid({ x: 0, y: 1 }, 21).y < made.fromGrid({ x: 0, y: 0 }, 21).y);
});
