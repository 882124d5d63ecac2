// A recording inside a page in one file (docs/app.md): answers as a session would.

import { fromBase64, inflate, unpackBits } from "../geometry/bits";
import type { MapDocument, Recording, Transport, View } from "../protocol";
import { deaf } from "./frame";

/** Metres; null is no return, "-Infinity" too close, "NaN" an invalid reading. */
type Reading = Recording["scans"]["ranges"][number][number];

export function recordedTransport(recording: Recording): Transport {
  const { document, scans, settings, log_joint } = recording;
  const cells = document.grid.shape[0] * document.grid.shape[1];
  const { chains, count } = recording.draws;
  const oneByOne = document.source.kind !== "simulation";
  const mean = fromBase64(recording.mean);
  const observed = fromBase64(recording.observed);
  let draws: Uint8Array | null = null;
  let index = 0;
  let view: View = { layer: "mean", chain: 0, draw: null };

  const rows = <T>(values: T[][]) => (oneByOne ? [values[index]] : values);
  const floats = (values: Reading[][]) => Float32Array.from(rows(values).flat(), metres);

  // Beams are the same in all scans, or each scan has its own.
  const anglesOf = (scan: number) => scans.angles[scan] ?? scans.angles[0];
  const before = [0];
  scans.pose.forEach((_, scan) => before.push(before[scan] + anglesOf(scan).length));
  const allHits = unpackBits(fromBase64(scans.hit), before[scans.pose.length]);
  const hits = () => (oneByOne ? allHits.subarray(before[index], before[index + 1]) : allHits);
  const trace = Float32Array.from(log_joint.flat(), Number);
  const every = settings.sweeps / Math.max(1, count);
  const traced = Float32Array.from(log_joint[0] ?? [], (_, i) => (i + 1) * every);
  const generation = 1;
  const held = () => ({ chains, count: draws ? count : 0 });

  const state = (seq = 0) => {
    const fixed = { generation, can_undo: false, can_redo: false, live: false, running: false, working: false, scan: index };
    transport.onmessage({ type: "state", document, seq, ...fixed, draws: held(), view }, {});
  };
  const scan = () => {
    const pose = Float64Array.from(rows(scans.pose).flat(), Number);
    const exact = scans.exact.length ? floats(scans.exact) : new Float32Array(0);
    const buffers = { pose, angles: Float32Array.from(anglesOf(index)), ranges: floats(scans.ranges), exact, hit: hits() };
    transport.onmessage({ type: "scan", generation, ids: oneByOne ? [index] : scans.ids, index: oneByOne ? index : null }, buffers);
  };
  const field = () => {
    const wished = view.layer === "draw";
    const draw = (wished ? view.draw : null) ?? count - 1;
    const drawn = wished && draws ? oneDraw(draws, view.chain * count + draw, cells) : null;
    const { method, quantity, sweeps, ess, rhat, verdict } = settings;
    const figures = { sweeps, total: sweeps, ess, rhat, verdict, log_joint: log_joint[view.chain]?.[draw] ?? null };
    const which = drawn ? { layer: view.layer, chain: view.chain, draw } : { layer: wished ? "mean" : view.layer, chain: null, draw: null } as const;
    const fixed = { generation, approximate: false, milliseconds: 0, averaged: null, lowest: null };
    transport.onmessage({ type: "field", ...fixed, ...which, method, quantity, ...figures, draws: held() }, { p: drawn ?? mean, observed, trace, traced });
  };

  const transport: Transport = {
    ...deaf(),
    open: () => transport.onstatus({ connected: true }),
    send: (action) => {
      if (action.type === "hello") {
        transport.onmessage({ type: "welcome", version: 1, limits: null, recorded: true }, {});
        state(action.seq);
        scan();
        field();
        if (!count) return;
        inflate(fromBase64(recording.draws.data)).then((bits) => {
          draws = bits;
          state(action.seq);
        });
      } else if (action.type === "view") {
        view = { layer: action.layer, chain: action.chain ?? view.chain, draw: action.draw ?? null };
        state(action.seq);
        field();
      } else if (action.type === "scan") {
        index = action.index;
        state(action.seq);
        scan();
      } else if (action.type === "inspect") {
        const { x, y } = action;
        const beams = beamsThrough(document, rows(scans.pose).map((_, s) => anglesOf(oneByOne ? index : s)), rows(scans.pose), rows(scans.ranges), x, y);
        const unknown = { beams_for: null, nats_for: null, beams_against: null, nats_against: null };
        transport.onmessage({ type: "cell", x, y, each: false, beams, ...unknown }, {});
      }
    },
    close: () => {},
  };
  return transport;
}

const metres = (reading: Reading) => (reading === null ? Infinity : Number(reading));

/** One map of many packed ones, in 255ths. */
function oneDraw(packed: Uint8Array, number: number, cells: number): Uint8Array {
  const first = number * cells;
  return Uint8Array.from({ length: cells }, (_, i) => ((packed[(first + i) >> 3] >> (7 - ((first + i) & 7))) & 1 ? 255 : 0));
}

/** How many beams pass through a cell before they end. */
function beamsThrough({ grid }: MapDocument, angles: number[][], poses: Recording["scans"]["pose"], ranges: Reading[][], x: number, y: number) {
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
