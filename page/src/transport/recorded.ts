// A recording inside a page in one file (docs/app.md): answers as a session would.

import { inflate, fromBase64, unpackBits } from "../geometry/bits";
import type { Buffers, Layer, Numbers, Recording, Transport, View } from "../protocol";
import { deaf, unpackFrame } from "./frame";

/** The recording in the text of a page's element, and its buffers. */
export async function readRecording(text: string): Promise<[Recording, Buffers]> {
  const bytes = await inflate(fromBase64(text));
  return unpackFrame<Recording>(bytes.buffer as ArrayBuffer);
}

export function recordedTransport([recording, buffers]: [Recording, Buffers]): Transport {
  const { document, ids, log_joint } = recording;
  const { chains, count, bits } = recording.draws;
  const cells = document.grid.shape[0] * document.grid.shape[1];
  const oneByOne = document.source.kind !== "simulation";
  const generation = 1;
  const counted = { chains, count };
  let row = 0;
  let view: View = { layer: "mean", chain: 0, draw: null };

  /** The values of the scans on show, among those of all. */
  const shown = (values: Numbers, whole = values.length === 0) => {
    const each = values.length / ids.length;
    return oneByOne && !whole ? values.slice(row * each, (row + 1) * each) : values;
  };
  const index = () => ids[row] - 1;
  const state = (seq = 0) => {
    const fixed = { generation, can_undo: false, can_redo: false, live: false, running: false, working: false, scan: index() };
    transport.onmessage({ type: "state", document, seq, ...fixed, draws: counted, view }, {});
  };
  const scan = () => {
    const { pose, angles, ranges, exact, hit } = buffers;
    const shared = angles.length < ranges.length; // beams are the same in all scans, or each scan has its own
    const rays = { pose: shown(pose), angles: shown(angles, shared), ranges: shown(ranges), exact: shown(exact), hit: shown(hit) };
    transport.onmessage({ type: "scan", generation, ids: oneByOne ? [ids[row]] : ids, index: oneByOne ? index() : null }, rays);
  };
  /** One map, in 255ths. */
  const oneDraw = (number: number) => {
    const size = bits ? Math.ceil(cells / 8) : cells;
    const map = buffers.draws.slice(number * size, (number + 1) * size) as Uint8Array;
    return bits ? unpackBits(map, cells).map((wall) => 255 * wall) : map;
  };
  const field = () => {
    const { p, width, reached, trace, traced, weights } = buffers;
    const draw = Math.min(count - 1, view.draw ?? count - 1);
    const asked: Layer = view.layer === "draw" && !count ? "mean" : view.layer === "width" && !width ? "mean" : view.layer;
    const drawn = asked === "draw" ? { chain: view.chain, draw, log_joint: log_joint[view.chain][draw] } : {};
    const numbers = asked === "draw" ? oneDraw(view.chain * count + draw) : asked === "width" ? width : p;
    transport.onmessage({ ...recording.field, layer: asked, ...drawn }, { p: numbers, reached, trace, traced, ...(weights && { weights }) });
  };

  const transport: Transport = {
    ...deaf(),
    open: () => transport.onstatus({ connected: true }),
    send: (action) => {
      if (action.type === "hello") {
        const lacks: Layer[] = [...(count ? [] : ["draw" as const]), ...(buffers.width ? [] : ["width" as const])];
        transport.onmessage({ type: "welcome", version: 1, limits: null, recorded: true, figure: false, lacks, story: null }, {});
        state(action.seq);
        scan();
        if (buffers.trajectory) transport.onmessage({ type: "overlay", generation }, { strokes: buffers.strokes, trajectory: buffers.trajectory });
        field();
      } else if (action.type === "view") {
        view = { layer: action.layer, chain: action.chain ?? view.chain, draw: action.draw ?? null };
        state(action.seq);
        field();
      } else if (action.type === "scan") {
        const away = ids.map((id) => Math.abs(id - 1 - action.index)); // of a long log not all scans are here
        row = away.indexOf(Math.min(...away));
        state(action.seq);
        scan();
      } else if (action.type === "inspect") {
        const { x, y } = action;
        const beams = buffers.beams[x * document.grid.shape[1] + y];
        transport.onmessage({ type: "cell", x, y, each: false, beams, beams_for: null, nats_for: null, beams_against: null, nats_against: null, draw: null, chain: null, prior_nats: null, log_odds: null }, {});
      }
    },
    close: () => {},
  };
  return transport;
}
