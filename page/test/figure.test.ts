// A figure that samples in the page: it answers as a session would, by the samplers of bayesmap.

import { aDocument, LIMITS, wallsOf } from "./desk";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { packBits, toBase64 } from "../src/geometry/bits";
import type { Figure } from "../src/messages";
import type { MapDocument } from "../src/protocol";
import { Beside } from "../src/state/beside";
import { Session } from "../src/state/session";
import { localTransport } from "../src/transport/local";

const file = process.env.BAYESMAP_LIBRARY;
const library = file ? JSON.parse(readFileSync(file, "utf8")) : null;

const judging: Figure["judging"] = {
  rhat_limit: 1.05, good_rhat: 1.01, good_ess: 400, bad_ess: 50, fewest_sweeps: 200, fewest_diagnosed: 4, bad_difference: 0.25, misfit_sigmas: 4, chance_share: 0.01,
};

/** A page with a figure, whose work is done when a test says so. */
class Shown {
  readonly session: Session;
  private work: (() => void)[] = [];

  constructor(document: Partial<MapDocument> = {}, story: Figure["story"] = null) {
    const figure: Figure = { version: 1, document: aDocument(document), limits: LIMITS, rare_walls: 0.2, judging, story };
    const transport = localTransport(figure, (work) => void this.work.push(work));
    this.session = new Session(transport, () => {});
    transport.open();
  }

  /** Works for one slice, or to the end. */
  slice() {
    for (const work of this.work.splice(0)) work();
    if (this.session.take()) this.session.painted();
  }
  finish() {
    while (this.work.length) this.slice();
    return this.session.shown!;
  }

  /** P(wall) of a cell. */
  p(x: number, y: number) {
    return this.session.shown!.p[x * this.session.shape[1] + y] / 255;
  }
}

test("a figure keeps a result with its draws beside the next one", () => {
  const page = new Shown({ sweeps: 40, prior: 0.3, method: "gibbs", burn_in: 0 });
  const before = page.finish();
  const beside = new Beside(page.session);
  beside.keep();
  beside.follow();
  assert.deepEqual(beside.kept!.shown!.p, before.p);
  const draw = (number: number) => {
    page.session.act({ type: "view", layer: "draw", chain: 1, draw: number });
    page.session.take();
    beside.follow();
    return [page.session.shown!, beside.kept!.shown!].map(({ p, log_joint }) => [log_joint, ...p]);
  };
  for (const number of [0, 17, 39]) {
    const [ours, theirs] = draw(number);
    assert.deepEqual(ours, theirs); // the same result still
  }
  page.session.act({ type: "set", patch: { method: "block" } });
  page.finish();
  assert.match(String(beside.differences()), /method Gibbs sampling, 2 x 2 blocks,method Gibbs sampling, cell by cell/);
  const [ours, theirs] = draw(5);
  assert.notDeepEqual(ours, theirs);
  assert.equal(beside.kept!.shown!.draw, 5);
});

test("a figure shows the posterior of what it is given, and of what is drawn in it", () => {
  const page = new Shown({ sweeps: 300, noise: 0.4 });
  const first = page.finish();
  assert.equal(first.sweeps, 300);
  assert(page.p(12, 4) + page.p(12, 5) > 0.9 && page.p(8, 10) < 0.05);
  assert(Math.abs(page.p(14, 0) - 0.5) < 0.1); // behind the wall
  assert(first.verdict && first.rhat! > 0.9 && first.ess! > 1);
  assert.deepEqual([first.trace.length, first.traced.length, first.traced[0], first.traced.at(-1)], [2 * first.traced.length, first.traced.length, 1, 300]);
  // The first picture after a wall in front of the robot is of this wall.
  page.session.act({ type: "walls", cells: [[12, 9], [12, 10], [12, 11]], wall: true });
  page.slice();
  assert.equal(page.session.shown!.generation, page.session.generation);
  page.finish();
  assert(page.p(12, 10) > 0.9 && page.p(16, 10) > 0.1);
  // The robot is moved behind it, and a wall in its cell is not drawn.
  page.session.act({ type: "move_sensor", id: 1, x: 15, y: 10 });
  page.session.act({ type: "walls", cells: [[15, 10]], wall: true });
  assert.match(page.session.status.text, /sensor stands in cell \(15, 10\)/);
  page.finish();
  assert.deepEqual([page.session.scan!.pose[0], page.session.walls[15 * 21 + 10]], [15, 0]);
});

test("a run keeps the draws that the library draws from the same readings", (context) => {
  if (!library) return context.skip("run by pytest, which makes the draws");
  const exact = library.samplers.chains.filter((one: { document: MapDocument }) => one.document.readings === "exact");
  assert(exact.length >= 6);
  for (const { document, draws, log_likelihood, log_prior } of exact) {
    const page = new Shown({ ...document, start: "empty", sweeps: draws[0].length, burn_in: 0 });
    page.session.act({ type: "live", on: false });
    page.session.act({ type: "run" });
    page.finish();
    assert.deepEqual(page.session.draws, { chains: 2, count: draws[0].length });
    draws.forEach((row: string[], chain: number) =>
      row.forEach((draw, number) => {
        page.session.act({ type: "view", layer: "draw", chain, draw: number });
        page.session.take();
        const { p, layer, log_joint } = page.session.shown!;
        assert.deepEqual([layer, toBase64(packBits(p))], ["draw", draw]);
        assert(Math.abs(log_joint! - log_likelihood[chain][number] - log_prior[chain][number]) < 1e-3);
      }),
    );
  }
});

test("strokes and drags are single steps of undo", () => {
  const page = new Shown({ sweeps: 5 });
  const before = page.session.effectiveDocument()!.walls;
  for (const x of [3, 4, 5]) page.session.act({ type: "walls", cells: [[x, 3]], wall: true, stroke: 7 });
  page.session.act({ type: "set", patch: { prior: 0.2 }, drag: 8 });
  page.session.act({ type: "set", patch: { prior: 0.1 }, drag: 8 });
  page.session.act({ type: "undo" });
  assert.equal(page.session.document!.prior, 0.5);
  page.session.act({ type: "undo" });
  assert.deepEqual([page.session.effectiveDocument()!.walls, page.session.state!.can_undo, page.session.state!.can_redo], [before, false, true]);
  page.session.act({ type: "redo" });
  assert.equal(page.session.walls[4 * 21 + 3], 1);
});

test("importance sampling shows its weights, and says that it has collapsed", () => {
  const page = new Shown({ method: "importance", sweeps: 500 });
  const { weights, ess, verdict, method } = page.finish();
  assert.equal(weights!.reduce((a, b) => a + b), 500);
  assert.deepEqual([method, verdict!.level], ["importance", "bad"]);
  assert(ess! >= 1 && ess! < 50);
});

test("a run goes on from the draws of Live, at whatever sweep it is asked for", () => {
  const settings = { sweeps: 20, burn_in: 0.2 };
  const whole = new Shown({ ...settings, sweeps: 40 });
  const expected = whole.finish();
  for (const early of [true, false]) {
    const page = new Shown(settings);
    if (!early) page.finish();
    page.session.act({ type: "run" });
    const shown = page.finish();
    assert.deepEqual([shown.total, shown.burned, page.session.draws.count], [40, 8, 40]);
    assert.deepEqual([...shown.p], [...expected.p]);
  }
});

test("rare walls are sampled by blocks, and without Live an edit waits for Run", () => {
  const page = new Shown({ prior: 0.1, sweeps: 20 });
  assert.equal(page.finish().method, "block");
  page.session.act({ type: "live", on: false });
  page.session.act({ type: "set", patch: { prior: 0.4 } });
  assert.deepEqual([page.finish().method, page.p(12, 4)], ["none", 102 / 255]);
  page.session.act({ type: "run" });
  page.slice();
  assert.equal(page.finish().method, "gibbs");
  page.session.act({ type: "set", patch: { prior: 0.4, sweeps: 100000 } });
  page.session.act({ type: "run" });
  page.slice();
  page.session.act({ type: "cancel" });
  assert(page.finish().sweeps < 100000 && !page.session.running);
});

test("a document that is none, or that a figure cannot sample, is refused with a reason", () => {
  const page = new Shown({ sweeps: 5 });
  page.finish();
  const cases: [object, RegExp][] = [
    [{ prior: 0.3 }, /is missing, or of another type/], [aDocument({ walls: wallsOf([], [3, 3]) }), /Walls: another number/], [aDocument({ noise: 99 }), /Noise: 99; give 0.01 to 5/],
    [aDocument({ method: "propagate" }), /no belief propagation/], [aDocument({ pose_sigma: 0.1 }), /known poses/], [aDocument({ sensors: [{ id: 1, x: 99, y: 0, yaw: 0 }] }), /outside the map/],
  ];
  for (const [brought, why] of cases) {
    page.session.bring(brought as MapDocument);
    assert.match(page.session.status.text, why);
    assert.equal(page.session.document!.noise, 0.2);
  }
  page.session.bring(aDocument({ prior: 0.25 }));
  assert.equal(page.session.document!.prior, 0.25);
  page.session.act({ type: "path", start: [0, 0], goal: [1, 1], radius: 0.1, risk: 0.1 });
  assert.match(page.session.status.text, /bayesmap app has it/);
});
