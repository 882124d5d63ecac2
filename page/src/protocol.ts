// What the page and the session say to each other: messages (written from the library's declarations) and their arrays.

import type * as wire from "./messages";

export type { Action, CellFacts, DrawCount, Grid, Limits, MapDocument, Notice, Patch, Quantity, Recording, Sensor, Source, Stage, State, Verdict } from "./messages";

/** The export that is no file: a result to keep beside the next one. */
export const RECORDING = "recording";

export type Pair = [number, number];
export type Point = { x: number; y: number };

export type Numbers = Uint8Array | Uint32Array | Float32Array | Float64Array;
export type Buffers = { [name: string]: Numbers };
/** An action with its number. */
export type Sent = wire.Action & { seq: number };

export type Layer = wire.View["layer"];
/** Which field is shown; without a number the last draw. */
export type View = { layer: Layer; chain: number; draw: number | null };

/** One picture of the posterior. */
export type Field = Omit<wire.Field, "type"> & {
  /** Log joint of every chain, (chains, n), and the sweeps that these are of, (n). */
  trace: Float32Array;
  traced: Float32Array;
  /** How many particles have which log weight. */
  weights?: Float32Array;
  /** (nx, ny), in 255ths. */
  p: Uint8Array;
  /** (nx, ny), how probably a beam reaches the cell, in 255ths. */
  reached: Uint8Array;
};

/** Readings and where they were taken: row s of pose (S, 3), ranges and exact (S, A) is the sensor `ids[s]`. */
export type Scan = Omit<wire.Scan, "type" | "generation"> & {
  pose: Numbers;
  angles: Numbers;
  ranges: Numbers;
  exact: Numbers;
  /** (S, A), 1 where the beam met something. */
  hit: Numbers;
};

/** Over a run or a log: surfaces as strokes, (U, 5), from x, y to x, y and their reflectivity; where scans were taken, (S, 2). */
export type Overlay = { strokes: Float32Array; trajectory: Float32Array };

/** Refused: there is a server, which does not know this page's token. */
export type Connection = { connected: boolean; retryIn_ms?: number; refused?: boolean };

/** A way to the session. `onmessage` and `onstatus` are set by the page before it calls `open`. */
export type Transport = {
  send: (action: wire.Action) => void;
  onmessage: (notice: wire.Notice, buffers: Buffers) => void;
  onstatus: (connection: Connection) => void;
  open: () => void;
  /** Reads a saved run by the server: its recording. Hears what share of the file has been sent. */
  read?: (file: File, heard: (share: number) => void) => Promise<ArrayBuffer>;
  /** The result on show, of a page that samples by itself; null before there is one. */
  record?: () => [wire.Recording, Buffers] | null;
  /** Tries again now. */
  retry?: () => void;
  close: () => void;
};
