import "./dom";
import assert from "node:assert/strict";
import { test } from "node:test";
import { decisionsPanel } from "../src/panels/decisions";
import { h } from "../src/panels/dom";
import { evidencePanel } from "../src/panels/evidence";
import { ghostPanel } from "../src/panels/ghost";
import { captionOf } from "../src/panels/legend";
import { banner, chip, foot } from "../src/panels/notice";
import { posteriorPanel } from "../src/panels/posterior";
import { readingPanel, readingWords } from "../src/panels/reading";
import type { Ui } from "../src/panels/ui";
import { wherePanel } from "../src/panels/where";
import type { MapDocument } from "../src/protocol";
import { Desk, LOG, RUN, panel, SURFACES } from "./desk";

const last = (desk: Desk) => desk.asked("set").at(-1)?.patch;
const draws = { draws: { chains: 2, count: 10 } };

test("the map says what it shows, and what a quick answer is made of", () => {
  const [desk, found] = panel(chip);
  assert.match(found.text, /^mean \u00b7 1000 sweeps/);
  desk.field({ sweeps: 1, rhat: 1.0012, ess: 99.6 });
  assert.match(found.text, /^mean \u00b7 1 sweep R-hat 1.001 \u00b7 ESS 100/);
  desk.field({ approximate: true, method: "propagate" });
  assert.match(found.text, /^mean \u00b7 approximate, belief propagation/);
  desk.field({ approximate: true, method: "hits" });
  assert.match(found.text, /approximate, counts of hits/);
  desk.field({ approximate: true, method: "pilot", averaged: 1, sweeps: 3, total: 9 });
  assert.match(found.text, /1 draw of one chain, sensor half fitted: sweep 3 of 9/);
  desk.state({ working: true });
  assert.match(found.text, /sensor being fitted/);
  desk.state(draws);
  desk.field({ layer: "draw", draw: 3, method: "importance" });
  assert.match(found.text, /^draw 4 of 10 \u00b7 importance sampling/);
  desk.field({ method: "counts" });
  assert.match(found.text, /^hits and passes \u00b7 along raw odometry/);
});

const BAD = { verdict: { level: "bad" as const, why: "R-hat 1.3", cell: null } };
test("what to do where chains have not converged is one click, and none where nothing can be done", () => {
  const cases: [Partial<MapDocument>, object, string | null, object?][] = [
    [{ method: "gibbs" }, { method: "gibbs", sweeps: 1000 }, "try blocks", { method: "block" }],
    [{ method: "gibbs", sweeps: 10 }, { method: "gibbs", sweeps: 10, total: 10 }, "try 200 sweeps", { sweeps: 200 }],
    [{ method: "block", sweeps: 300 }, { method: "block", sweeps: 300, total: 300 }, "try 1200 sweeps", { sweeps: 1200 }],
    [{ method: "block", sweeps: 60_000 }, { method: "block", sweeps: 60_000, total: 60_000 }, "try 100000 sweeps", { sweeps: 100_000 }],
    [{ method: "block", sweeps: 100_000 }, { method: "block", sweeps: 100_000, total: 100_000 }, ""],
    [{ method: "gibbs", pose_sigma: 0.5 }, { method: "gibbs" }, "try 4000 sweeps", { sweeps: 4000 }], // at each shift of the map sweeps help
    [{ method: "block" }, { method: "block", sweeps: 300 }, null], // it goes on
    [{ ...LOG, method: "gibbs" }, { method: "gibbs" }, "try 4000 sweeps", { sweeps: 4000 }],
    [RUN, { method: "gibbs" }, ""],
  ];
  for (const [document, field, words, patch] of cases) {
    const [desk, found] = panel(chip, document);
    desk.field({ ...BAD, ...field });
    if (words === null) assert.doesNotMatch(found.text, /not converged/);
    else if (!patch) {
      assert.match(found.text, new RegExp(`not converged${words && `: ${words}`}$`));
      assert(found.control(words ? `Not converged: ${words}` : "Not converged").disabled);
    } else {
      assert.match(found.text, new RegExp(`not converged: ${words}$`));
      found.control(`Not converged: ${words}`).click();
      assert.deepEqual(last(desk), patch);
    }
    desk.field({ verdict: { level: "fair", why: "", cell: null } });
    assert.doesNotMatch(found.text, /not converged/);
  }
});

const status = (ui: Ui) => foot(ui).element;
test("the status says that chains have not converged, that a sensor is fitted, and otherwise what there is to say", () => {
  const [desk, found] = panel(status);
  assert.match(found.text, /^Ready Point at a cell, or press \? for the keys/);
  desk.field(BAD);
  assert.match(found.text, /^Ready, but the chains have not converged/);
  desk.session.say("Saved run.nc");
  assert.match(found.text, /^Saved run.nc/);
  desk.confirm({ prior: 0.1 });
  desk.session.act({ type: "undo" });
  desk.confirm({}, { working: true });
  desk.field({ method: "pilot", approximate: true });
  assert.match(found.text, /^Fitting the sensor/);
});

test("the read-out tells of the cell under the hand: place, posterior, beams", () => {
  const [desk, found] = panel(status);
  const p = new Uint8Array(441).fill(51);
  const reached = new Uint8Array(441).fill(255);
  [reached[439], reached[440]] = [51, 0];
  desk.field({ p, reached });
  desk.hand.point({ x: 10, y: 12 });
  assert.match(found.text, /Cell 10, 12 \u00b7 10.0, 12.0 m \u00b7 P\(wall\) 0.20 \u00b7 entropy 0.72 bit/);
  desk.says("cell", { x: 10, y: 12, beams: 1, beams_for: 0, nats_for: 0, beams_against: 1, nats_against: 2.345 });
  assert.match(found.text, /1 beam \u00b7 for a wall 0, 0.0 nats \u00b7 against 1, 2.3 nats/);
  desk.hand.point({ x: 11, y: 12 });
  assert.doesNotMatch(found.text, /beam/); // those were another cell's
  desk.hand.point({ x: 20, y: 20 });
  assert.match(found.text, /Cell 20, 20 .* unobserved/);
  desk.hand.point({ x: 20, y: 19 });
  assert.match(found.text, /Cell 20, 19 .* reached with probability 0.20/);
  desk.field({ p: new Uint8Array(441).fill(255), layer: "draw" });
  assert.match(found.text, /wall in this draw/);
  desk.field({ p, quantity: SURFACES });
  assert.match(found.text, /mean reflectivity 0.20/);
  assert.doesNotMatch(found.text, /entropy/);
  desk.field({ p, quantity: SURFACES, layer: "draw" });
  assert.match(found.text, /reflectivity 0.20 in this draw/);
  desk.field({ p, quantity: SURFACES, layer: "width" });
  assert.match(found.text, /90 % interval 0.20 wide/);
  desk.hand.point({ x: 21, y: 3 });
  assert.equal(desk.hand.hover, null);
});

test("that line or worker is lost is said on the map, with what can be done", () => {
  const [desk, found] = panel(banner);
  assert.equal(found.text, "");
  desk.says("worker", { state: "restarted" });
  assert.match(found.text, /^The worker stopped and is being started again. The map is kept.$/);
  desk.says("worker", { state: "ready" });
  assert.equal(found.text, "");
  desk.cut({ retryIn_ms: 3900 });
  assert.match(found.text, /^Connection lost. Trying again in 4 s; the map is kept here. Reconnect now$/);
  found.control("Reconnect now").click();
  assert.equal(desk.retries, 1);
  desk.cut({ refused: true });
  assert.match(found.text, /started again, with another address/);
});

const posterior = (ui: Ui) => posteriorPanel(ui);
test("progress is said in words, and is none of what is no longer asked", () => {
  const [desk, found] = panel(posterior);
  const { now } = performance;
  let time = 0;
  Object.assign(performance, { now: () => time });
  try {
    desk.confirm({ sweeps: 5000 }, { running: true, working: true });
    desk.field({ sweeps: 1000, total: 5000 });
    assert.match(found.text, /1000 of 5000 sweeps, running/);
    time = 2000;
    desk.field({ sweeps: 2000, total: 5000 });
    assert.match(found.text, /2000 of 5000 sweeps, 6 s left/);
    assert.equal(found.control("Progress").value, 0.4 as unknown as string);
    time = 5000;
    desk.field({ sweeps: 4900, total: 5000 });
    assert.match(found.text, /less than 1 s left/);
    assert.equal(found.control("Cancel").disabled, false);
    desk.state({});
    assert.match(found.text, /4900 of 5000 sweeps, stopped/);
    assert.equal(found.control("Cancel").disabled, true);
    desk.cut();
    assert.equal(found.control("Run").disabled, true);
  } finally {
    Object.assign(performance, { now });
  }
  const [other, importance] = panel(posterior, { method: "importance" });
  other.field({ method: "importance", sweeps: 500, total: 500 });
  assert.match(importance.text, /500 of 500 particles/);
});

test("a log's picture of the last question is not taken for the answer to the next", () => {
  const [desk, found] = panel(posterior, LOG);
  desk.confirm({ prior: 0.2 }, { working: true });
  assert.match(found.text, /Computing/);
  desk.field({ method: "pilot", approximate: true, sweeps: 2, total: 8 });
  assert.match(found.text, /Fitting the sensor: sweep 2 of 8/);
  desk.state({});
  assert.match(found.text, /Stopped while the sensor was fitted/);
  desk.field({ method: "counts", approximate: true });
  assert.match(found.text, /Run infers where the robot was/);
  desk.state({ running: true });
  desk.says("stage", { generation: 9, name: "loops", text: "Closing loops", done: 3, total: 110 });
  assert.match(found.text, /Closing loops: 3 of 110 scans/);
});

test("figures are shown with their verdict, and a dash where there are none", () => {
  const [desk, found] = panel(posterior);
  desk.field({ ess: 812.4, rhat: 1.0123, log_joint: -123.456, verdict: { level: "good", why: "R-hat 1.01", cell: null } });
  assert.match(found.text, /ESS 812 R-hat 1.012 log joint, mean -123.5/);
  assert.match(found.text, /Converged: R-hat 1.01/);
  assert.equal(found.find((one) => one.tagName === "dd" && one.className === "good").length, 2);
  const [meaning] = found.find(({ tagName, firstElementChild }) => tagName === "details" && firstElementChild?.textContent === "What these figures mean");
  assert.deepEqual(desk.ui.named.map(({ name }) => name()).filter((name) => /[A-Z]{2}|-/.test(name)), ["ESS", "R-hat"]); // of a story
  assert.match(meaning.innerText, /ESS +Effective sample size .* R-hat +Agreement of the chains on the log joint: 1 where they agree/);
  assert(!found.sees("Show the cell"));
  desk.field({ ess: 1, method: "importance", verdict: { level: "bad", why: "one particle", cell: null } });
  assert.match(found.text, /Collapsed: one particle/);
  desk.field({ verdict: { ...BAD.verdict, cell: [3, 4] }, ess: null, rhat: Infinity });
  assert.match(found.text, /ESS \u2013 R-hat \u2013/);
  assert.match(found.text, /Not converged: R-hat 1.3/);
  assert.equal(found.find((one) => one.className === "bad").length, 2);
  found.control("Show the cell").click();
  assert.deepEqual(desk.commands, ["cell 3,4"]);
});

test("what is left out, how long it took, and of which model and method the picture is", () => {
  const [desk, found] = panel(posterior);
  desk.field({ burned: 100, seconds: 3.21, about: [["Method", "Gibbs sampling"], ["Prior", "independent: p wall 0.5"]] });
  assert.match(found.text, /1000 of 1000 sweeps, burn-in of 100 left out/);
  assert.match(captionOf(desk.session), /, by sweeps 101 to 1000\.$/);
  assert.match(found.text, /time 3.2 s/);
  assert.match(found.text, /Model and method of this picture Method Gibbs sampling Prior independent: p wall 0.5/);
  desk.field({ method: "propagate", approximate: true, sweeps: 7, total: 0 });
  assert.match(found.text, /7 rounds of belief propagation/);
});

test("Run is disabled with its reason where belief propagation is done, and its key says so", () => {
  const [desk, found] = panel(posterior, { method: "propagate" });
  assert.equal(found.control("Run").disabled, false); // its picture is not there
  desk.field({ method: "propagate", approximate: true, sweeps: 7, total: 0 });
  assert.equal(found.control("Run").disabled, true);
  assert.match(found.control("Run").title, /^Belief propagation is done/);
  assert.match(found.text, /7 rounds of belief propagation; it is done, and Run has nothing to add/);
  desk.key("r");
  assert.match(desk.status, /^Belief propagation is done and has no sweeps to add; choose Gibbs/);
  assert.deepEqual(desk.asked("run"), []);
  desk.confirm({ method: "gibbs" });
  assert.equal(found.control("Run").disabled, false);
  assert.equal(found.control("Run").title, "Run (R): sample maps");
  desk.state(draws);
  assert.equal(found.control("Run").title, "Run (R): more sweeps of the chains on show");
  desk.confirm({ method: "importance" });
  assert.equal(found.control("Run").title, "Run (R): weigh particles");
  const [log, ofLog] = panel(posterior, { ...LOG, method: "propagate", poses: "odometry" });
  log.field({ method: "propagate", approximate: true });
  assert.equal(ofLog.control("Run").disabled, false); // it infers the trajectory
});

test("a path, and why there is none, in words", () => {
  const [desk, found] = panel(decisionsPanel);
  desk.choose("path");
  const { decisions } = desk.session;
  assert.match(found.text, /^Path .*Click where the robot is/);
  decisions.point({ x: 1, y: 1 });
  assert.match(found.text, /Now click where it is to go/);
  decisions.point({ x: 2, y: 2 });
  assert.match(found.text, /Looking for a path/);
  desk.says("path", { length_m: 3.456, probability: 0.98765, standard_error: 0.001, draws: 40, independent: 0.5, within_risk: false });
  assert.match(found.text, /3.46 m, free with probability 0.988 \u00b1 0.001 by 40 draws. Independent cells would say 0.500. No path was found whose risk is low enough; this is the safest./);
  desk.says("path", { length_m: 3.456, probability: 1, standard_error: 0, draws: 1800, independent: 0.5, within_risk: true });
  assert.match(found.text, /3.46 m, free in all 1800 draws: with probability over 0.998 \(95 %, were they independent\)\. Independent cells/);
  desk.says("undecided", { question: "path", text: "path: there is no way" });
  assert.match(found.text, /There is no way\.$/);
  desk.choose("look");
  assert.match(found.text, /^Where to look next Working out how much a scan would tell/);
  desk.says("views", {}, { pose: new Float32Array(6), nats: Float32Array.of(2, 7.25) });
  assert.match(found.text, /One more scan would tell 2.0 to 7.3 nats.*Click to place another sensor/);
  desk.choose("pan");
  assert.equal(found.text, "");
});

test("the ghost in words", () => {
  const [desk, found] = panel(ghostPanel);
  desk.choose("ghost");
  assert.match(found.text, /Drag the ghost/);
  found.control("Ghost x").put("3", "change");
  found.control("Ghost yaw (\u00b0)").put("30", "change");
  assert(Math.abs(desk.session.ghost.pose!.yaw - Math.PI / 6) < 1e-12);
  assert.match(found.text, /Working out what its laser would read/);
  const fan = { low: Float32Array.of(1, 2, 3), high: Float32Array.of(1.1, 2.3, Infinity), median: Float32Array.of(1, 2, 3), angles: new Float32Array(3) };
  desk.says("ghost", { draws: 20, near: { index: 0, away: 0.123, turn: -0.1 } }, fan);
  assert.match(found.text, /central 80 % interval, 30 cm wide at the median beam, by 20 draws of the map. Rings are the hits of scan 1, taken 12 cm from here, turned by -6\u00b0/);
  desk.says("ghost", { draws: 0, near: null }, { ...fan, high: Float32Array.of(Infinity, Infinity, Infinity) });
  assert.match(found.text, /as wide as the laser's range, by the mean map/);
  assert.doesNotMatch(found.text, /hits of scan/);
  desk.says("undecided", { question: "ghost", text: "run inference first" });
  assert.match(found.text, /Run inference first\./);
});

test("a cell's beams in words, the strongest by name", () => {
  const [desk, found] = panel(evidencePanel, { sensors: [{ id: 7, x: 1, y: 1, yaw: 0 }] });
  desk.choose("evidence");
  assert.match(found.text, /Click a cell/);
  desk.session.evidence.pin({ x: 3, y: 4 });
  assert.match(found.text, /Cell 3, 4: asking its beams/);
  const said = (facts: object, nats: number[] = []) => {
    const each = { nats: Float64Array.from(nats), scan: new Float64Array(nats.length), beam: Float64Array.from(nats, (_, i) => i) };
    desk.says("cell", { x: 3, y: 4, each: true, ...facts }, each);
    return found.text;
  };
  assert.match(said({ beams: 0 }), /no beam reaches it/);
  assert.match(said({ beams: 2, nats_for: null, nats_against: null }), /2 beams; there are no draws to ask/);
  const facts = { beams: 12, beams_for: 3, nats_for: 4.56, beams_against: 1, nats_against: 0.5 };
  const words = said(facts, [2.5, -1.25, 0, 0, 0, 0, 0, 0, 0, 0]);
  assert.match(words, /12 beams. For a wall \(blue\) 3, 4.6 nats; against \(orange\) 1, 0.5 nats/);
  assert.match(words, /\+2.5 nats: beam 1 of sensor 7 \u22121.3 nats: beam 2 of sensor 7/);
  assert.equal(found.find((one) => one.tagName === "li").length, 8);
  assert.match(said({ beams: 1, beams_for: 0, nats_for: 0, beams_against: 0, nats_against: 0 }), /1 beam\. .*None of them says anything/);
  desk.field({ quantity: SURFACES });
  assert.match(said(facts), /For its surface/);
});

test("prior and beams make up the log odds given one draw, and a cell's trace is drawn", () => {
  const [desk, found] = panel(evidencePanel);
  desk.choose("evidence");
  desk.state({ draws: { chains: 2, count: 4 } });
  desk.field({ layer: "draw", chain: 1, draw: 2 });
  desk.session.evidence.pin({ x: 3, y: 4 });
  assert.deepEqual(desk.asked("inspect").at(-1), { type: "inspect", x: 3, y: 4, each: true, chain: 1, draw: 2 });
  const facts = { x: 3, y: 4, each: true, beams: 9, beams_for: 2, nats_for: 3, beams_against: 1, nats_against: 0.5 };
  const trace = Uint8Array.of(1, 1, 0, 1, 0, 0, 0, 1);
  const each = { nats: Float64Array.of(3), scan: new Float64Array(1), beam: new Float64Array(1), trace };
  desk.says("cell", { ...facts, draw: 2, chain: 1, prior_nats: -0.5, log_odds: 2 }, each);
  assert.match(found.text, /Given all other cells of draw 3: prior \u22120.5, beams \+2.5, together log odds \+2.0: Gibbs draws a wall with probability 0.881/);
  assert.match(found.text, /Share of draws so far with a wall, by draw: chain 1 0.75, chain 2 0.25/);
  desk.field({ layer: "mean", chain: null, draw: null });
  desk.session.evidence.ask();
  assert.deepEqual(desk.asked("inspect").at(-1), { type: "inspect", x: 3, y: 4, each: true });
  desk.says("cell", { ...facts, draw: null });
  assert.match(found.text, /the sum is not the log odds of P\(wall\)/);
  assert.doesNotMatch(found.text, /Share of draws/);
});

test("where the robot may be, in words", () => {
  const [desk, found] = panel(wherePanel);
  desk.choose("where");
  assert.match(found.text, /Looking everywhere\./);
  const place = (probability: number, x = 3, sigma_m = 0.02) => ({ probability, mean: [x, 4, Math.PI / 2], sigma_m, sigma_rad: 0.01, covariance: [] });
  const said = (modes: object[], fields = {}) => {
    desk.says("where", { picture: 1, sensor: 1, modes, pose: [3.1, 4, Math.PI / 2], p_lost: 0, ...fields }, { pose: new Float32Array(3), weight: new Float32Array(1) });
    return found.text;
  };
  assert.match(said([place(1)]), /One place: 3.00, 4.00 m, heading 90\u00b0, known to 2 cm and 0.6\u00b0. The robot stands 10 cm and 0.0\u00b0 from there\./);
  assert.match(said([place(0.7, 9), place(0.3)]), /2 places: 70 %, 30 %. The likeliest: 9.00, 4.00 m.*The robot stands 10 cm and 0.0\u00b0 from the 2nd/);
  assert.match(said(Array.from({ length: 7 }, () => place(1 / 7))), /7 places: (14 %, ){5}14 % and less/);
  assert.match(said([place(1, 3, 5)]), /It may be almost anywhere/);
  assert.match(said([...Array.from({ length: 10 }, () => place(0.1, 9)), place(0.05)]), / from the 11th\./);
  assert.match(said([place(1)], { picture: 0 }), /0.6\u00b0. Looking again\. Drag/); // the robot has moved on
  assert.match(said([place(1)], { p_lost: 0.2 }), /That it is lost, or the map outdated, has probability 0.20/);
  assert.match(said([place(1)], { p_lost: 0.9 }), /The scan fits nowhere on this map, with probability 0.90/);
  assert.match(said([], { trouble: "there are no draws yet" }), /There are no draws yet\./);
});

test("where walls are known, nothing is said of the posterior of unknown ones", () => {
  const [desk, found] = panel((ui) => h("div", {}, chip(ui), foot(ui).element, posteriorPanel(ui), wherePanel(ui)));
  desk.field(BAD);
  assert.match(found.text, /^mean .*not converged.*Ready, but the chains/);
  assert.doesNotMatch(found.text, /not known/);
  desk.choose("where");
  desk.ui.refresh(); // the map is asked for
  desk.hand.point({ x: 12, y: 4 });
  assert.match(found.text, /^known map: the walls as drawn Ready Cell 12, 4 .* wall, as drawn Posterior Where am I\? takes the walls as drawn/);
  assert.match(captionOf(desk.session), /^The walls as they are drawn/);
  desk.hand.point({ x: 1, y: 1 });
  assert.match(found.text, /free, as drawn/);
});

test("a reading in words: along its beam, and across and along the wall that it met", () => {
  const wall = { across_m: -0.012, along_m: 0.5, thickness_m: 0.02, length_m: 2, incidence_rad: 0.7 };
  const reading = { type: "beam" as const, generation: 1, scan: 0, beam: 30, draws: 9, reading: "hit" as const, range: 2.345, low: 2.3, median: 2.36, high: null, residual: -0.0152, nats: 1, no_return: 0.01, wall };
  assert.equal(
    readingWords(reading),
    "Beam 31 of scan 1 read 2.35 m, 1.5 cm shorter than the predicted median (median 2.36 m, 80 % between 2.30 m and no return). " +
      "It ended 1.2 cm behind the wall, which is 2.0 cm thick (one standard deviation), and 50.0 cm to the left along it from the middle of its surface; the beam met it at 40\u00b0 from its normal.",
  );
  assert.match(readingWords({ ...reading, residual: 1.5, wall: null }), /, 1.50 m longer than the predicted median \(.*\)\.$/);
  assert.match(readingWords({ ...reading, wall: { ...wall, across_m: 0.1, along_m: -2 } }), /10.0 cm in front of the wall.*2.00 m to the right/);
  assert.match(readingWords({ ...reading, reading: "none", range: null, low: null }), /came back from nothing, which was predicted with probability 0.010 \(median 2.36 m, 80 % between too close/);
  assert.match(readingWords({ ...reading, reading: "bad", range: null }), /read nothing that says how far/);
});

test("readings are compared over a file, and what takes long is said to be prepared", () => {
  const [desk, found] = panel(readingPanel, RUN);
  assert.match(found.text, /Point at a reading/);
  desk.session.reading.picked = { scan: 0, beam: 30, from: { x: 0, y: 0 }, angle: 0 };
  assert.match(found.text, /Beam 31 of scan 1\.$/);
  desk.session.reading.slow = true;
  assert.match(found.text, /Beam 31 of scan 1: preparing the comparison/);
  assert.equal(panel(readingPanel)[1].text, "");
});
