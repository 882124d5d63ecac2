// Built by `make page` from src/bayesmap/app/protocol: edit there.

/** A regular grid of square cells in the world frame (REP-103: x right, y up, metres). */
export type Grid = {
  /** Number of cells ``(nx, ny)``. */
  shape: [number, number];
  /** Edge of a cell in metres. */
  resolution: number;
  /** World position in metres of the lower-left corner of cell ``(0, 0)``. */
  origin: [number, number];
};

/** The pose of a sensor: metres and radians, world frame. Its yaw is kept in [-pi, pi]. */
export type Sensor = {
  id: number;
  x: number;
  y: number;
  yaw: number;
};

/** The origin of the readings: simulated from the walls, or a file whose scans are shown. */
export type Source = {
  /** Simulation, run or log. */
  kind: "log" | "run" | "simulation";
  /** The file's. */
  name: string;
  /** The number of scans in the file. */
  scans: number;
  /** For a log, corners of what its scans saw, metres. Grids of any resolution cover them. */
  bounds: [[number, number], [number, number]] | null;
};

/** Everything that determines the picture. */
export type MapDocument = {
  /** The cells. */
  grid: Grid;
  /** Packed bits of the (nx, ny) map, C order (x * ny + y), most significant bit first; base64 in JSON. */
  walls: string;
  /** Empty where a file is shown. */
  sensors: Sensor[];
  /** Probability that a cell is a wall. */
  prior: number;
  /** Standard deviation of a range, metres. */
  noise: number;
  /** Beams a scan. */
  angles: number;
  /** Metres. */
  max_range: number;
  /** Field of view of every sensor, radians. */
  fov: number;
  /** With noise, or exact under the law that has the noise. */
  readings: "exact" | "noisy";
  /** Standard deviation of every sensor's position, metres. */
  pose_sigma: number;
  /** Standard deviation of every sensor's heading, radians. */
  heading_sigma: number;
  /** For a log, whether the robot was where the log says, or that is raw odometry. */
  poses: "logged" | "odometry";
  /** The kind of cells that a log is explained by, or that a run's maps are made of. */
  cells: "binary" | "reflectivity" | "surface";
  /** How the posterior is found; auto is block where walls or free cells are rare, else gibbs. */
  method: "auto" | "block" | "gibbs" | "importance" | "propagate";
  /** In which cells are visited by gibbs. */
  order: "radial" | "random" | "raster";
  /** Where chains start. */
  start: "auto" | "empty" | "prior";
  /** Of the chains, or the number of particles. */
  sweeps: number;
  /** Of all random numbers. */
  seed: number;
  /** For a log, the number of its scans, from the first on, that make the map; null is all. */
  scans_used: number | null;
  /** Where the readings come from. */
  source: Source;
  /** Of this description. */
  version: 1;
};

/** A page has connected, perhaps with a document: of a share link, or from before its connection was lost. */
export type Hello = {
  type: "hello";
  document?: object | null;
  seq?: number;
};

/** Changed settings. Only a log has `resolution`, the edge of its cells in metres. */
export type Patch = {
  prior?: number;
  noise?: number;
  angles?: number;
  max_range?: number;
  fov?: number;
  readings?: "exact" | "noisy";
  pose_sigma?: number;
  heading_sigma?: number;
  poses?: "logged" | "odometry";
  cells?: "binary" | "reflectivity" | "surface";
  method?: "auto" | "block" | "gibbs" | "importance" | "propagate";
  order?: "radial" | "random" | "raster";
  start?: "auto" | "empty" | "prior";
  sweeps?: number;
  seed?: number;
  scans_used?: number | null;
  resolution?: number;
};

/** Change settings. */
export type ChangeSettings = {
  type: "set";
  patch: Patch;
  /** Number of the drag. All changes of one drag are one step of undo. */
  drag?: number;
  /** Along a log, while the hand drags: counts of hits at once, and the posterior on the first `set` without. */
  coarse?: boolean;
  seq?: number;
};

/** Draw walls in cells, or erase them. */
export type Walls = {
  type: "walls";
  cells: [number, number][];
  wall: boolean;
  /** Number of the stroke. All messages of one stroke are one step of undo. */
  stroke?: number;
  seq?: number;
};

/** Place another sensor: metres and radians, world frame. */
export type AddSensor = {
  type: "add_sensor";
  x: number;
  y: number;
  yaw?: number;
  seq?: number;
};

/** Move or turn a sensor; what is left out stays. All moves of one drag are one step of undo. */
export type MoveSensor = {
  type: "move_sensor";
  id: number;
  x?: number | null;
  y?: number | null;
  yaw?: number | null;
  drag?: number;
  seq?: number;
};

/** Remove a sensor; the last one stays. */
export type RemoveSensor = {
  type: "remove_sensor";
  id: number;
  seq?: number;
};

/** Remove all walls, or go back to the prior. */
export type Clear = {
  type: "clear";
  what: "inference" | "walls";
  seq?: number;
};

/** Begin another map, of `shape` cells. */
export type New = {
  type: "new";
  shape: [number, number];
  world: "blank" | "building" | "tutorial";
  seq?: number;
};

/** Undo the last step, if it was this page's, or of a page that has gone. */
export type Undo = {
  type: "undo";
  seq?: number;
};

/** Redo the step that was undone last. */
export type Redo = {
  type: "redo";
  seq?: number;
};

/** Start the document's method for its number of sweeps (or particles), and keep draws. */
export type Run = {
  type: "run";
  seq?: number;
};

/** Stop; what there is stays. */
export type Cancel = {
  type: "cancel";
  seq?: number;
};

/** Choose whether every edit restarts the chains after the preview. */
export type Live = {
  type: "live";
  on: boolean;
  seq?: number;
};

/** Choose the field that this page is sent from now on; without a number it is the last draw. */
export type ShowView = {
  type: "view";
  layer: "draw" | "entropy" | "mean" | "width";
  chain?: number | null;
  draw?: number | null;
  seq?: number;
};

/** The first picture of a generation is on the canvas. It has no number, and no state confirms it. */
export type Painted = {
  type: "painted";
  generation: number;
  seq?: number;
};

/** Choose the scan of a file whose rays are shown. */
export type ShowScan = {
  type: "scan";
  index: number;
  seq?: number;
};

/** Ask for a file; answered by `download`. */
export type Export = {
  type: "export";
  what: "document" | "html" | "map" | "run";
  seq?: number;
};

/** Ask which beams go through a cell, and with `each` what each of them says; answered by `cell`. */
export type Inspect = {
  type: "inspect";
  x: number;
  y: number;
  each?: boolean;
  seq?: number;
};

/** Ask for a path for a disc; answered by `path` or `undecided`. */
export type FindPath = {
  type: "path";
  /** X, y in metres. */
  start: [number, number];
  /** X, y in metres. */
  goal: [number, number];
  /** Metres. */
  radius: number;
  /** The largest probability that the disc touches something. */
  risk: number;
  seq?: number;
};

/** Ask where one more scan would tell most; answered by `views` or `undecided`. */
export type FindViews = {
  type: "views";
  seq?: number;
};

/** Ask where a scan may have been taken: of a sensor, or the scan on show of a file; answered by `where`. */
export type WhereAmI = {
  type: "where";
  sensor?: number | null;
  seq?: number;
};

/** Ask what the laser would read at a pose, metres and radians; answered by `ghost` or `undecided`. */
export type MoveGhost = {
  type: "ghost";
  x: number;
  y: number;
  yaw: number;
  /** The hand still moves, so a few draws will do. */
  coarse?: boolean;
  seq?: number;
};

/** Ask how a reading compares with its prediction; answered by `beam` or `undecided`. */
export type CompareBeam = {
  type: "beam";
  /** Index of the scan; in a simulation, of the sensor in the document. */
  scan: number;
  /** Index of the beam. */
  beam: number;
  seq?: number;
};

/** Smallest and largest values of settings, in their units; of a path's radius and risk; of the cells a side of a drawn map (`side`) and of a log's map (`side_of_log`); of the number of sensors; of a log's cell size, metres. */
export type Limits = {
  prior: [number, number];
  noise: [number, number];
  angles: [number, number];
  max_range: [number, number];
  fov: [number, number];
  pose_sigma: [number, number];
  heading_sigma: [number, number];
  sweeps: [number, number];
  seed: [number, number];
  radius: [number, number];
  risk: [number, number];
  side: [number, number];
  sensors: [number, number];
  resolution: [number, number];
  side_of_log: [number, number];
};

/** The first message of a connection. */
export type Welcome = {
  type: "welcome";
  version: number;
  /** Null for a recording, in which nothing can be set. */
  limits: Limits | null;
  recorded: boolean;
};

/** The state of the worker. */
export type Worker = {
  type: "worker";
  state: "ready" | "restarted" | "starting";
};

/** The number of kept draws: `count` of each chain. */
export type DrawCount = {
  chains: number;
  count: number;
};

/** The field that a page is shown; without a number it is the last draw. */
export type View = {
  layer: "draw" | "entropy" | "mean" | "width";
  chain: number | null;
  draw: number | null;
};

/** The present state, after every action that was applied. */
export type State = {
  type: "state";
  document: MapDocument;
  /** Of the present picture. */
  generation: number;
  /** Number of the page's last action that was applied. */
  seq: number;
  /** Whether the next step back is this page's, or of one that has gone. */
  can_undo: boolean;
  /** The same for the next step forth. */
  can_redo: boolean;
  /** Whether edits restart the chains. */
  live: boolean;
  /** Whether a run is under way. */
  running: boolean;
  /** Whether the picture is to change yet. */
  working: boolean;
  /** Of the present result. */
  draws: DrawCount;
  /** Index of the scan on show, of a file. */
  scan: number;
  /** The field that this page is sent. */
  view: View;
};

/** Readings: all scans of a simulation, or one scan of a file. Buffers: pose float64 (S, 3); angles float32 (A); ranges and exact float32 (S, A), exact being where the beams truly end, empty for a file; hit uint8 (S, A), 0 where a beam came back from nothing. */
export type Scan = {
  type: "scan";
  /** Of the sensors, one a row. */
  ids: number[];
  /** Of the scan, of a file. */
  index: number | null;
  generation: number;
};

/** The verdict on a result, and its reason. */
export type Verdict = {
  level: "bad" | "fair" | "good";
  why: string;
};

/** The numbers of the map: the kind of cells, and the words for their mean and for one draw's number. */
export type Quantity = {
  kind: string;
  mean: string;
  value: string;
  interval: boolean;
};

/** One picture of the posterior. Buffers: p uint8 (nx, ny), probability or width in 255ths; observed uint8, packed bits of (nx, ny); trace float32 (chains, n), the log joint at the sweeps of traced float32 (n): the first 100, then evenly spread; for importance sampling weights float32 (24), how many particles have which log weight, in equal bins. */
export type Field = {
  type: "field";
  /** What the numbers are. The page makes entropy of the mean. */
  layer: "draw" | "entropy" | "mean" | "width";
  /** What found it. */
  method: string;
  /** Whether it is quick and not the posterior. */
  approximate: boolean;
  /** Done; rounds, or particles. */
  sweeps: number;
  total: number;
  /** Effective sample size of the log joint. */
  ess: number | null;
  rhat: number | null;
  /** Mean over the chains of its last value. */
  log_joint: number | null;
  /** Null where it is too early. */
  verdict: Verdict | null;
  draws: DrawCount;
  quantity: Quantity;
  milliseconds: number;
  chain: number | null;
  draw: number | null;
  /** For the chain that fits the sensor, the number of its draws that the mean is made of. */
  averaged: number | null;
  /** Where the bins of weights begin, in nats below the largest, at which they end. */
  lowest: number | null;
  generation: number;
};

/** The overlay of a run or a log. Buffers: strokes float32 (U, 5), surfaces from x, y to x, y in metres, with their reflectivity; trajectory float32 (S, 2), where the scans were taken. */
export type Overlay = {
  type: "overlay";
  generation: number;
};

/** The beams through a cell: how many speak for what is there and against it, and how much, in nats. Buffers of the strongest beams, with `each`: start and end float64 (M, 2), metres; nats, scan, beam float64 (M). */
export type CellFacts = {
  type: "cell";
  x: number;
  y: number;
  each: boolean;
  beams: number;
  /** Null where nothing can be said. */
  beams_for: number | null;
  nats_for: number | null;
  beams_against: number | null;
  nats_against: number | null;
};

/** The shortest path whose risk is low enough, or the safest. */
export type SafePath = {
  type: "path";
  /** Its corners, metres. */
  path: [number, number][];
  length_m: number;
  /** Of the disc, metres. */
  radius: number;
  /** Whether its risk is low enough. */
  within_risk: boolean;
  /** That it is free: its share of draws. */
  probability: number;
  standard_error: number;
  /** The probability if cells were independent. */
  independent: number;
  draws: number;
  generation: number;
};

/** The information expected from one more scan, at places `spacing` metres apart. Buffers: pose float32 (n, 3), the best heading at each place; nats float32 (n). */
export type Views = {
  type: "views";
  spacing: number;
  generation: number;
};

/** The scan that was taken nearest to a pose: how far away in metres, and turned by how much in radians. */
export type Near = {
  index: number;
  away: number;
  turn: number;
};

/** The virtual scan of a robot's laser at a pose, and the real scan that was taken nearest. Buffers: angles, low, median, high float32 (A), the central 80 % interval of each beam, metres, no return being infinite; of the scan near_pose float64 (3), near_ranges float32 (A), near_hit uint8 (A). */
export type GhostScan = {
  type: "ghost";
  x: number;
  y: number;
  yaw: number;
  /** By a few draws only, since the hand still moved. */
  coarse: boolean;
  /** That were asked; 0 where cells are taken for independent, for want of draws. */
  draws: number;
  near: Near | null;
  milliseconds: number;
  generation: number;
};

/** A reading in the frame of a surface: how far across and along it, and the surface's size. */
export type SurfaceOffset = {
  across_m: number;
  along_m: number;
  thickness_m: number;
  length_m: number;
  incidence_rad: number;
};

/** One reading against its prediction: metres, null where infinite or unknown. */
export type ComparedBeam = {
  type: "beam";
  scan: number;
  beam: number;
  /** That predict. */
  draws: number;
  reading: "bad" | "close" | "hit" | "none";
  range: number | null;
  /** Where the central 80 % interval begins. */
  low: number | null;
  median: number | null;
  high: number | null;
  /** The reading less the median. */
  residual: number | null;
  /** Minus the log density of the reading. */
  nats: number | null;
  /** The probability that nothing comes back. */
  no_return: number | null;
  /** The reading in the frame of the surface at which the beam most probably stopped. */
  wall: SurfaceOffset | null;
  generation: number;
};

/** The reason why a question has no answer. */
export type Undecided = {
  type: "undecided";
  text: string;
  of: "beam" | "ghost" | "path" | "views";
  generation: number;
};

/** A place where the robot may be: mean and covariance of x, y (metres) and yaw (radians). */
export type Place = {
  mean: number[];
  covariance: number[][];
  probability: number;
  sigma_m: number;
  sigma_rad: number;
};

/** The posterior of the pose from which a scan was taken. Buffers: pose float32 (n, 3) and weight float32 (n), the lightest first. */
export type Whereabouts = {
  type: "where";
  /** Generation of the picture. */
  of: number;
  /** Whose scan, in a drawn world. */
  sensor: number | null;
  /** Of the scan, of a file. */
  index: number | null;
  /** Where it was taken, as the document or the file says. */
  pose: number[];
  /** The likeliest place first. */
  modes: Place[];
  /** The probability of being nowhere on the map. */
  p_lost: number;
  nats_per_beam: number;
  /** Why there is no answer; else empty. */
  trouble: string;
};

/** Progress of the inference of a log's trajectory; `text` is the name of the stage. */
export type Stage = {
  type: "stage";
  name: string;
  text: string;
  done: number;
  of: number;
  generation: number;
};

/** A text for the status line. */
export type Status = {
  type: "status";
  text: string;
  level: "error" | "info" | "warning";
};

/** A message was refused; nothing changed. */
export type Refusal = {
  type: "error";
  text: string;
  remedy: string;
  /** The message's number, as far as it could be read. */
  seq: number | null;
};

/** A file. Buffers: data uint8. */
export type Download = {
  type: "download";
  name: string;
  mime: string;
};

/** Scans, one a row; of a simulation one a sensor. */
export type RecordedScans = {
  ids: number[];
  pose: ((number | null)[])[];
  /** Of the beams: one row that all scans have, or a row a scan. */
  angles: number[][];
  ranges: ((number | "-Infinity" | "NaN" | null)[])[];
  /** Where the beams truly end; no row for a file. */
  exact: ((number | "-Infinity" | "NaN" | null)[])[];
  /** Base64 of packed bits (S, A). */
  hit: string;
};

/** Kept maps of walls: base64 of deflate-raw of packed bits, (chains, count, nx * ny) in one run. */
export type RecordedDraws = {
  chains: number;
  count: number;
  data: string;
};

/** What a field says beside its picture. */
export type RecordedFigures = {
  method: string;
  quantity: Quantity;
  sweeps: number;
  ess: number | null;
  rhat: number | null;
  verdict: Verdict | null;
};

/** A result in a page in one file. */
export type Recording = {
  version: 1;
  document: MapDocument;
  scans: RecordedScans;
  /** Base64 of uint8 (nx, ny), in 255ths. */
  mean: string;
  /** Base64 of packed bits. */
  observed: string;
  draws: RecordedDraws;
  /** Of each draw, a row a chain. */
  log_joint: ((number | null)[])[];
  settings: RecordedFigures;
};

export type Action =
  | Hello
  | ChangeSettings
  | Walls
  | AddSensor
  | MoveSensor
  | RemoveSensor
  | Clear
  | New
  | Undo
  | Redo
  | Run
  | Cancel
  | Live
  | ShowView
  | Painted
  | ShowScan
  | Export
  | Inspect
  | FindPath
  | FindViews
  | WhereAmI
  | MoveGhost
  | CompareBeam;

export type Notice =
  | Welcome
  | Worker
  | State
  | Scan
  | Field
  | Overlay
  | CellFacts
  | SafePath
  | Views
  | GhostScan
  | ComparedBeam
  | Undecided
  | Whereabouts
  | Stage
  | Status
  | Refusal
  | Download;
