// A figure that samples in the page (docs/app.md): answers as the session of a server would, without one.

import { checked, edit, History, Refused } from "../figure/edits";
import { Chains, Job, Weighing } from "../figure/jobs";
import { fromBase64, inflate } from "../geometry/bits";
import type { Figure } from "../messages";
import type { Action, Buffers, MapDocument, Sent, Transport, View } from "../protocol";
import { mix, normal } from "../sampler/random";
import { locate } from "../sampler/where";
import { beamsOf, fan, problemOf, rangesOf } from "../sampler/world";
import { deaf } from "./frame";

const SLICE_MS = 12; // of work between two looks at the hand
const FRAME_MS = 80; // between two pictures of chains that go on
const STREAM_NOISE = 11;
const QUESTIONS = new Set<Action["type"]>(["path", "views", "ghost", "beam"]);
const ELSEWHERE = "This figure has no such tool: bayesmap app has it";

/** The figure in the text of a page's element. */
export async function readFigure(text: string): Promise<Figure> {
  return JSON.parse(new TextDecoder().decode(await inflate(fromBase64(text))));
}

/** Readings of all sensors, metres, and what their beams truly meet. */
function readingsOf(document: MapDocument, beams: ReturnType<typeof beamsOf>) {
  const exact = rangesOf(document, beams);
  const { seed, noise, angles, sensors } = document;
  const keys = sensors.map(({ id }) => mix(seed, id, STREAM_NOISE));
  const readings = exact.map((range, b) => (document.readings === "exact" ? range : range + noise * normal(keys[Math.floor(b / angles)], 2 * (b % angles))));
  return { exact, readings };
}

/** The method that a document asks for: "auto" takes blocks where walls or free cells are rare. */
function methodOf({ method, prior }: MapDocument, { rare_walls }: Figure) {
  return method !== "auto" ? method : Math.min(prior, 1 - prior) <= rare_walls ? "block" : "gibbs";
}

export function localTransport(figure: Figure, later: (work: () => void) => void = (work) => setTimeout(work)): Transport {
  const { limits, judging } = figure;
  const history = new History(figure.document);
  let [generation, seq] = [0, 0];
  let [live, running, working] = [true, false, false];
  let view: View = { layer: "mean", chain: 0, draw: null };
  let mode: "live" | "run" | "clear" = "live";
  let job: Job | null = null;
  let [waiting, closed] = [false, false];
  let [began, framed] = [0, 0];
  let scan: (Buffers & { ranges: Float32Array; hit: Uint8Array }) | null = null;

  const say = (text: string, level: "info" | "warning") => transport.onmessage({ type: "status", text, level }, {});
  const state = () =>
    transport.onmessage({
      type: "state", document: history.present, generation, seq, can_undo: history.canUndo, can_redo: history.canRedo, live, running, working,
      draws: (!working && job?.draws) || { chains: 0, count: 0 }, scan: 0, view,
    }, {});
  const picture = (over = false) => {
    if (!job) return;
    framed = performance.now();
    transport.onmessage(...job.picture(view, generation, Math.round(framed - began), over));
  };

  /** Work for a while, and go on later. */
  function slice() {
    waiting = false;
    if (closed || !working) return;
    const first = !job;
    job ??= begin();
    if (mode !== "clear") job.work(SLICE_MS);
    const done = job.done || mode === "clear";
    if (first || done || performance.now() - framed > FRAME_MS) picture();
    if (done) {
      running = working = false;
      state();
    } else goOn();
  }
  function goOn() {
    if (!waiting) later(slice);
    waiting = true;
  }

  /** Send the readings of the document, and set up what samples from them. */
  function begin(): Job {
    const document = history.present;
    const { sensors, max_range } = document;
    const beams = beamsOf(document);
    const { exact, readings } = readingsOf(document, beams);
    const pose = Float64Array.from(sensors.flatMap(({ x, y, yaw }) => [x, y, yaw]));
    const single = (values: Float64Array) => Float32Array.from(values);
    const rays = { pose, angles: single(fan(document)), ranges: single(readings), exact: single(exact), hit: Uint8Array.from(exact, (range) => (range < max_range ? 1 : 0)) };
    scan = rays;
    transport.onmessage({ type: "scan", generation, ids: sensors.map(({ id }) => id), index: null }, rays);
    const problem = problemOf(document, beams, readings);
    const method = methodOf(document, figure);
    if (mode === "clear") return new Job(document, problem);
    if (method === "importance") return new Weighing(document, problem, judging);
    return new Chains(document, problem, judging, method === "block");
  }

  function restart(next: typeof mode = live ? "live" : "clear") {
    generation++;
    mode = next;
    job = null;
    running = mode === "run";
    working = true;
    began = performance.now();
    state();
    goOn();
  }

  /** Stop where the work is; before its first picture, show the prior. */
  function cancel() {
    if (!working) return state();
    if (!job) return restart("clear");
    running = working = false;
    picture(true);
    state();
  }

  function hello(brought: object | null | undefined) {
    if (brought) {
      history.push(checked(brought, figure.document, limits), { type: "hello" });
      return restart();
    }
    if (!generation) return restart();
    state();
    picture();
  }

  /** Say where the scan of a sensor may have been taken, in the world as it is drawn. */
  function where(id: number | null | undefined) {
    const { sensors, angles } = history.present;
    const row = Math.max(0, sensors.findIndex((sensor) => sensor.id === id));
    const { x, y, yaw } = sensors[row];
    const beams = [row * angles, (row + 1) * angles];
    if (!scan || closed) return;
    const { modes, pose, weight, nats_per_beam } = locate(history.present, scan.ranges.subarray(...beams), scan.hit.subarray(...beams));
    transport.onmessage(
      { type: "where", picture: generation, sensor: sensors[row].id, index: null, pose: [x, y, yaw], modes, p_lost: 0, nats_per_beam, trouble: "" },
      { pose, weight },
    );
  }

  function act(action: Action) {
    switch (action.type) {
      case "hello":
        return hello(action.document);
      case "run": {
        if (mode === "live" && working) job ??= begin();
        const chains = job instanceof Chains ? job : null;
        restart("run");
        chains?.goOn(history.present.sweeps);
        job = chains; // those of Live, or of an earlier run, go on
        return;
      }
      case "cancel":
        return cancel();
      case "live":
        live = action.on;
        if (running) return state();
        return live ? restart() : cancel();
      case "view":
        view = { layer: action.layer, chain: action.chain ?? view.chain, draw: action.draw ?? null };
        state();
        return picture(!working);
      case "undo":
      case "redo":
        if (history.step(action.type === "undo")) return restart();
        say(`nothing to ${action.type}`, "info");
        return state();
      case "export": {
        if (action.what !== "document") throw new Refused(ELSEWHERE);
        const data = new TextEncoder().encode(`${JSON.stringify(history.present, null, 1)}\n`);
        return transport.onmessage({ type: "download", name: "document.json", mime: "application/json", note: "" }, { data });
      }
      case "clear":
        if (action.what === "inference") return restart("clear");
    }
    const edited = edit(history.present, action, limits);
    if (!edited) throw new Refused(ELSEWHERE);
    const [document, remark] = edited;
    history.push(document, action);
    if (remark) say(remark, "warning");
    restart();
  }

  const transport: Transport = {
    ...deaf(),
    open: () => {
      transport.onmessage({ type: "welcome", version: 1, limits, recorded: false, figure: true, lacks: [], story: figure.story }, {});
      transport.onmessage({ type: "worker", state: "ready" }, {});
      transport.onstatus({ connected: true });
    },
    send: (action) => {
      if (action.type === "painted") return;
      if (action.type === "inspect") {
        const beams = job?.beamsThrough(action.x * history.present.grid.shape[1] + action.y);
        if (beams === undefined) return;
        const nothing = { beams_for: null, nats_for: null, beams_against: null, nats_against: null, draw: null, chain: null, prior_nats: null, log_odds: null };
        return transport.onmessage({ type: "cell", x: action.x, y: action.y, each: false, beams, ...nothing }, {});
      }
      if (action.type === "where") return later(() => where(action.sensor));
      if (QUESTIONS.has(action.type)) return say(ELSEWHERE, "warning");
      seq = (action as Sent).seq ?? seq;
      try {
        act(action);
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
        if (action.type === "hello") return transport.onmessage({ type: "error", text: error.message, remedy: "", seq }, {});
        say(error.message, "warning");
        state();
      }
    },
    record: () => job && scan && job.recording(scan),
    close: () => {
      closed = true;
    },
  };
  return transport;
}
