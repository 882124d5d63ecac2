// What the page and the session say to each other (docs/app.md).

export type Pair = [number, number];
export type Point = { x: number; y: number };

export type Grid = { shape: Pair; resolution: number; origin: Pair };
/** Metres and radians, world frame. */
export type Sensor = { id: number; x: number; y: number; yaw: number };
export type Source = { kind: "simulation" | "run" | "log"; name?: string; scans?: number; bounds?: [Pair, Pair] };

/** Everything that determines the picture. */
export type MapDocument = {
  version: number;
  grid: Grid;
  walls: string;
  sensors: Sensor[];
  prior: number;
  noise: number;
  angles: number;
  max_range: number;
  /** Radians, of every sensor. */
  fov: number;
  readings: "noisy" | "exact";
  /** Standard deviations of every sensor's position, metres, and heading, radians. */
  pose_sigma: number;
  heading_sigma: number;
  /** Of a log: whether the robot was there, or that is raw odometry. */
  poses: "logged" | "odometry";
  cells: string;
  method: string;
  order: string;
  start: string;
  sweeps: number;
  seed: number;
  /** Of a log: from how many of its scans the map is made; null is all. */
  scans_used?: number | null;
  source: Source;
};

export type Message = { type: string; [field: string]: any };
export type Numbers = Uint8Array | Float32Array | Float64Array;
export type Buffers = { [name: string]: Numbers };

export type Layer = "mean" | "draw" | "entropy" | "width";
/** What the numbers of the map are: walls, or numbers with an interval, and the words for their mean and a draw's. */
export type Quantity = { kind: string; mean: string; value: string; interval: boolean };
/** Which field is shown; without a number the last draw. */
export type View = { layer: Layer; chain: number; draw: number | null };

/** The last `state` message. */
export type State = {
  document: MapDocument;
  generation: number;
  seq: number;
  can_undo: boolean;
  can_redo: boolean;
  live: boolean;
  running: boolean;
  /** Whether the picture is to change yet. */
  working: boolean;
  draws: { chains: number; count: number };
  view?: { layer?: Layer; chain?: number | null; draw?: number | null };
};

/** What is to be thought of a result, and why. */
export type Verdict = { level: "good" | "fair" | "bad"; why: string };

/** One picture of the posterior. */
export type Field = {
  generation: number;
  layer: Layer;
  method: string;
  approximate: boolean;
  sweeps: number;
  total: number;
  ess?: number | null;
  rhat?: number | null;
  log_joint?: number | null;
  verdict?: Verdict | null;
  quantity?: Quantity;
  /** Log joint of every chain, (chains, n), and the sweeps that these are of, (n). */
  trace: Float32Array;
  traced: Float32Array;
  /** How many particles weigh how much, and where the first bin begins, in nats below the largest. */
  weights?: Float32Array;
  lowest?: number;
  milliseconds?: number;
  chain?: number;
  draw?: number;
  /** Of the chain that fits the sensor: how many of its draws the mean is made of. */
  averaged?: number;
  /** (nx, ny), probability in 255ths. */
  p: Uint8Array;
  /** (nx, ny), 0 or 1. */
  observed: Uint8Array;
  /** `observed` as it came, packed. */
  bits: Uint8Array;
};

/** Readings and where they were taken: row s of pose (S, 3), ranges and exact (S, A) is the sensor `ids[s]`. */
export type Scan = {
  ids: number[];
  index: number | null;
  pose: Numbers;
  angles: Numbers;
  ranges: Numbers;
  exact: Numbers;
  /** (S, A), 1 where the beam met something. */
  hit: Numbers;
};

/** Refused: there is a server, which does not know this page's token. */
export type Connection = { connected: boolean; retryIn_ms?: number; refused?: boolean };

/** Over a run or a log: surfaces as strokes, (U, 5), from x, y to x, y and their reflectivity; where scans were taken, (S, 2). */
export type Overlay = { strokes: Float32Array; trajectory: Float32Array };

/** How far the inference of a log's trajectory is. */
export type Stage = { generation: number; name: string; text: string; done: number; of: number };

/** Beams through a cell; how many speak for a wall, or for what is there, and against it, and how much in nats. */
export type CellFacts = { x: number; y: number; beams: number; beams_for?: number; nats_for?: number; beams_against?: number; nats_against?: number; each?: boolean };

/** A way to the session. `onmessage` and `onstatus` are set by the page before it calls `open`. */
export type Transport = {
  send: (message: Message) => void;
  onmessage: (message: Message, buffers: Buffers) => void;
  onstatus: (connection: Connection) => void;
  open: () => void;
  /** Tries again now. */
  retry?: () => void;
  close: () => void;
};

/** What a document may hold, smallest and largest. */
export const LIMITS = {
  cells: [2, 500],
  sensors: 32,
  prior: [0, 1],
  noise: [0, 5],
  angles: [10, 1000],
  max_range: [0.1, 10_000],
  fov_deg: [5, 360],
  pose_sigma: [0, 2],
  heading_sigma_deg: [0, 30],
  sweeps: [1, 100_000],
  seed: [0, 2 ** 31 - 1],
  side_of_log: 1000,
} as const;
