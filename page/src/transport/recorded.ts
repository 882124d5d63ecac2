// A recording inside a page in one file (docs/app.md): answers as a session would.

import { fromBase64, inflate, unpackBits } from "../geometry/bits";
import type { MapDocument, Quantity, Transport, Verdict, View } from "../protocol";
import { deaf } from "./frame";

type Rows = (number | null)[][];
/** Metres; null is no return. */
type Readings = (number | null | "-Infinity" | "NaN")[][];
export type Recording = {
  version: 1;
  document: MapDocument;
  scans: { ids: number[]; pose: Rows; angles: number[] | number[][]; ranges: Readings; exact?: Readings; hit: string };
  mean: string;
  observed: string;
  draws?: { chains: number; count: number; data: string };
  log_joint?: number[][];
  settings?: { method?: string; sweeps?: number; ess?: number | null; rhat?: number | null; verdict?: Verdict | null; quantity?: Quantity };
};

export function recordedTransport(recording: Recording): Transport {
  const { document, scans, settings = {}, log_joint = [] } = recording;
  const cells = document.grid.shape[0] * document.grid.shape[1];
  const count = recording.draws?.count ?? 0;
  const oneByOne = document.source.kind !== "simulation";
  const mean = fromBase64(recording.mean);
  const observed = fromBase64(recording.observed);
  let draws: Uint8Array | null = null;
  let index = 0;
  let view: View = { layer: "mean", chain: 0, draw: null };

  const rows = <T>(values: T[][]) => (oneByOne ? [values[index]] : values);
  const floats = (values: Readings) => Float32Array.from(rows(values).flat(), metres);

  // Beams are the same in all scans, or each scan has its own.
  const anglesOf = (scan: number) => (Array.isArray(scans.angles[scan]) ? scans.angles[scan] : scans.angles) as number[];
  const before = [0];
  scans.pose.forEach((_, scan) => before.push(before[scan] + anglesOf(scan).length));
  const allHits = unpackBits(fromBase64(scans.hit), before[scans.pose.length]);
  const hits = () => (oneByOne ? allHits.subarray(before[index], before[index + 1]) : allHits);
  const trace = Float32Array.from(log_joint.flat());
  const every = (settings.sweeps ?? count) / Math.max(1, count);
  const traced = Float32Array.from(log_joint[0] ?? [], (_, i) => (i + 1) * every);

  const state = (seq: number) => {
    const held = { chains: recording.draws?.chains ?? 0, count: draws ? count : 0 };
    const fixed = { generation: 1, can_undo: false, can_redo: false, live: false, running: false, working: false };
    transport.onmessage({ type: "state", document, seq, ...fixed, draws: held, view }, {});
  };
  const scan = () => {
    const pose = Float64Array.from(rows(scans.pose).flat(), Number);
    const message = { type: "scan", generation: 1, ids: oneByOne ? [index] : scans.ids, index: oneByOne ? index : null };
    const exact = scans.exact?.length ? floats(scans.exact) : new Float32Array(0);
    transport.onmessage(message, { pose, angles: Float32Array.from(anglesOf(index)), ranges: floats(scans.ranges), exact, hit: hits() });
  };
  const field = () => {
    const drawn = view.layer === "draw" && draws ? oneDraw(draws, view.chain * count + (view.draw ?? count - 1), cells) : null;
    const joint = log_joint[view.chain]?.[(view.layer === "draw" ? view.draw : null) ?? count - 1] ?? null;
    const which = drawn ? { ...view, draw: view.draw ?? count - 1 } : { layer: view.layer === "draw" ? "mean" : view.layer };
    const sweeps = settings.sweeps ?? count;
    const figures = { quantity: settings.quantity, sweeps, total: sweeps, ess: settings.ess, rhat: settings.rhat, verdict: settings.verdict, log_joint: joint };
    const method = settings.method ?? document.method;
    const buffers = { p: drawn ?? mean, observed, trace, traced };
    transport.onmessage({ type: "field", generation: 1, ...which, method, approximate: false, ...figures }, buffers);
  };

  const transport: Transport = {
    ...deaf(),
    open: () => transport.onstatus({ connected: true }),
    send: (message) => {
      if (message.type === "hello") {
        transport.onmessage({ type: "welcome", version: 1, recorded: true }, {});
        state(message.seq);
        scan();
        field();
        if (!count || !recording.draws) return;
        inflate(fromBase64(recording.draws.data)).then((bits) => {
          draws = bits;
          state(message.seq);
        });
      } else if (message.type === "view") {
        view = { layer: message.layer, chain: message.chain ?? view.chain, draw: message.draw ?? null };
        state(message.seq);
        field();
      } else if (message.type === "scan") {
        index = message.index;
        state(message.seq);
        scan();
      } else if (message.type === "inspect") {
        const beams = beamsThrough(document, rows(scans.pose).map((_, s) => anglesOf(oneByOne ? index : s)), rows(scans.pose), rows(scans.ranges), message.x, message.y);
        transport.onmessage({ type: "cell", x: message.x, y: message.y, beams }, {});
      }
    },
    close: () => {},
  };
  return transport;
}

const metres = (reading: Readings[number][number]) => (reading === null ? Infinity : Number(reading));

/** One map of many packed ones, in 255ths. */
function oneDraw(packed: Uint8Array, number: number, cells: number): Uint8Array {
  const first = number * cells;
  return Uint8Array.from({ length: cells }, (_, i) => ((packed[(first + i) >> 3] >> (7 - ((first + i) & 7))) & 1 ? 255 : 0));
}

/** How many beams pass through a cell before they end. */
function beamsThrough({ grid }: MapDocument, angles: number[][], poses: Rows, ranges: Readings, x: number, y: number) {
  const { origin, resolution } = grid;
  const low = [origin[0] + x * resolution, origin[1] + y * resolution];
  let passing = 0;
  poses.forEach((pose, s) => {
    const [px, py, yaw] = pose.map(Number);
    angles[s].forEach((angle, b) => {
      const [dx, dy] = [Math.cos(angle + yaw), Math.sin(angle + yaw)];
      const along = [(low[0] - px) / dx, (low[0] + resolution - px) / dx, (low[1] - py) / dy, (low[1] + resolution - py) / dy];
      const enter = Math.max(0, Math.min(along[0], along[1]), Math.min(along[2], along[3]));
      const leave = Math.min(metres(ranges[s][b]), Math.max(along[0], along[1]), Math.max(along[2], along[3]));
      if (enter < leave) passing++;
    });
  });
  return passing;
}
