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
  /** Kind of source: simulation, run or log. */
  kind: "log" | "run" | "simulation";
  /** Name of the file. */
  name: string;
  /** Number of scans in the file. */
  scans: number;
  /** For a log, corners of the area that its scans saw, metres. Grids of any resolution cover it. */
  bounds: [[number, number], [number, number]] | null;
};

/** The map, the sensors and the settings from which the picture is computed. */
export type MapDocument = {
  /** Grid of cells. */
  grid: Grid;
  /** Packed bits of the (nx, ny) map, C order (x * ny + y), most significant bit first; base64 in JSON. */
  walls: string;
  /** Sensors of a simulation; empty for a file. */
  sensors: Sensor[];
  /** Prior probability that a cell is a wall. */
  prior: number;
  /** Standard deviation of a range, metres. */
  noise: number;
  /** Number of beams per scan. */
  angles: number;
  /** Longest range, metres. */
  max_range: number;
  /** Field of view of every sensor, radians. */
  fov: number;
  /** 'noisy', or 'exact': noise-free ranges, still inferred with the noisy sensor law. */
  readings: "exact" | "noisy";
  /** Standard deviation of every sensor's position, metres. */
  pose_sigma: number;
  /** Standard deviation of every sensor's heading, radians. */
  heading_sigma: number;
  /** For a log, 'logged' if its poses are known, or 'odometry' if they are raw odometry. */
  poses: "logged" | "odometry";
  /** Kind of cells: the kind to infer from a log, or the kind in a run's maps. */
  cells: "binary" | "reflectivity" | "surface";
  /** Inference method; 'auto' is 'block' if walls or free cells are rare, else 'gibbs'. */
  method: "auto" | "block" | "gibbs" | "importance" | "propagate";
  /** Order in which gibbs visits the cells. */
  order: "radial" | "random" | "raster";
  /** Map from which chains start. */
  start: "auto" | "empty" | "prior";
  /** Number of sweeps of the chains, or number of particles. */
  sweeps: number;
  /** Share of the sweeps done, the first ones, that is left out of the mean, R-hat and the effective sample size. */
  burn_in: number;
  /** Seed of all random numbers. */
  seed: number;
  /** For a log, number of first scans that make the map; null means all scans. */
  scans_used: number | null;
  /** Origin of the readings. */
  source: Source;
  /** Version of this format. */
  version: 1;
};

/** Report that a page has connected. */
export type Hello = {
  type: "hello";
  /** Document of a share link, or of the time before a lost connection; null if the page has none. */
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
  burn_in?: number;
  seed?: number;
  scans_used?: number | null;
  resolution?: number;
};

/** Change settings. */
export type ChangeSettings = {
  type: "set";
  /** The changed settings. */
  patch: Patch;
  /** Number of the drag. All changes of one drag are one step of undo. */
  drag?: number;
  /** For a log, true while the hand drags: show counts of hits only. The first `set` with false starts inference. */
  coarse?: boolean;
  seq?: number;
};

/** Draw walls in cells, or erase them. */
export type PaintWalls = {
  type: "walls";
  /** Indices (x, y) of the cells. */
  cells: [number, number][];
  /** True to draw walls, false to erase them. */
  wall: boolean;
  /** Number of the stroke. All messages of one stroke are one step of undo. */
  stroke?: number;
  seq?: number;
};

/** Place another sensor at a pose in the world frame. */
export type AddSensor = {
  type: "add_sensor";
  /** Position, metres. */
  x: number;
  /** Position, metres. */
  y: number;
  /** Heading, radians. */
  yaw?: number;
  seq?: number;
};

/** Move or turn a sensor. Coordinates that are left out stay as they are. */
export type MoveSensor = {
  type: "move_sensor";
  /** Id of the sensor. */
  id: number;
  /** New position in the world frame, metres. */
  x?: number | null;
  /** New position in the world frame, metres. */
  y?: number | null;
  /** New heading, radians. */
  yaw?: number | null;
  /** Number of the drag. All moves of one drag are one step of undo. */
  drag?: number;
  seq?: number;
};

/** Remove a sensor. The last sensor cannot be removed. */
export type RemoveSensor = {
  type: "remove_sensor";
  /** Id of the sensor. */
  id: number;
  seq?: number;
};

/** Remove all walls, or go back to the prior. */
export type Clear = {
  type: "clear";
  /** "inference" goes back to the prior. */
  what: "inference" | "walls";
  seq?: number;
};

/** Begin another map. */
export type NewMap = {
  type: "new";
  /** Number of cells along x and y. */
  shape: [number, number];
  /** Walls of the new map. */
  world: "blank" | "building" | "tutorial";
  seq?: number;
};

/** Undo the last step of this page, or of a page that is no longer connected. */
export type Undo = {
  type: "undo";
  seq?: number;
};

/** Redo the step that was undone last, under the same condition as `undo`. */
export type Redo = {
  type: "redo";
  seq?: number;
};

/** Run the document's method for its number of sweeps or particles. Chains on show go on from where they are. */
export type Run = {
  type: "run";
  seq?: number;
};

/** Stop inference. The result so far stays. */
export type Cancel = {
  type: "cancel";
  seq?: number;
};

/** Choose whether every edit restarts the chains after the preview. */
export type SetLive = {
  type: "live";
  /** Whether every edit restarts the chains. */
  on: boolean;
  seq?: number;
};

/** Choose the field that this page gets from now on. Layer "draw" without a draw number is the last draw. */
export type ShowView = {
  type: "view";
  /** Layer of the field. */
  layer: "draw" | "entropy" | "mean" | "width";
  /** Index of the chain, for a draw. */
  chain?: number | null;
  /** Index of the draw. */
  draw?: number | null;
  seq?: number;
};

/** Report that the first picture of a generation is on the canvas. No state confirms this message. */
export type Painted = {
  type: "painted";
  /** Number of the picture. */
  generation: number;
  seq?: number;
};

/** Choose the scan whose rays are shown, for a file. */
export type ShowScan = {
  type: "scan";
  /** Index of the scan. */
  index: number;
  seq?: number;
};

/** Ask for a file of the result or the document; answered by `download`. */
export type Export = {
  type: "export";
  /** Kind of file. */
  what: "document" | "figure" | "html" | "map" | "recording" | "run";
  seq?: number;
};

/** Ask for the evidence of the beams through a cell; answered by `cell`. */
export type Inspect = {
  type: "inspect";
  /** Index of the cell along x. */
  x: number;
  /** Index of the cell along y. */
  y: number;
  /** True to get also the evidence of each beam. */
  each?: boolean;
  /** Index of the draw's chain. */
  chain?: number;
  /** For walls, index of the draw that gives the other cells; null means the mean map. */
  draw?: number | null;
  seq?: number;
};

/** Ask for a path on which a disc can move; answered by `path` or `undecided`. */
export type FindPath = {
  type: "path";
  /** Start of the path, x and y in metres. */
  start: [number, number];
  /** Goal of the path, x and y in metres. */
  goal: [number, number];
  /** Radius of the disc, metres. */
  radius: number;
  /** Largest allowed probability that the disc touches something. */
  risk: number;
  seq?: number;
};

/** Ask for the information expected from one more scan at free places; answered by `views` or `undecided`. */
export type FindViews = {
  type: "views";
  seq?: number;
};

/** Ask where a scan may have been taken; answered by `where`. For a file, it is the scan on show. */
export type WhereAmI = {
  type: "where";
  /** Id of the sensor whose scan is meant, in a drawn world. */
  sensor?: number | null;
  seq?: number;
};

/** Ask for the virtual scan at a pose in the world frame; answered by `ghost` or `undecided`. */
export type MoveVirtualScan = {
  type: "ghost";
  /** Position, metres. */
  x: number;
  /** Position, metres. */
  y: number;
  /** Heading, radians. */
  yaw: number;
  /** True while the hand moves: predict from a few draws only. */
  coarse?: boolean;
  seq?: number;
};

/** Ask how a reading compares with its prediction; answered by `beam` or `undecided`. */
export type CompareBeam = {
  type: "beam";
  /** Index of the scan; in a simulation, index of the sensor in the document. */
  scan: number;
  /** Index of the beam. */
  beam: number;
  seq?: number;
};

/** Smallest and largest values: of settings, in their units; of a path's radius and risk; of the number of cells per side of a drawn map (`side`) and of a log's map (`side_of_log`); of the number of sensors; and of a log's cell size, metres. */
export type Limits = {
  prior: [number, number];
  noise: [number, number];
  angles: [number, number];
  max_range: [number, number];
  fov: [number, number];
  pose_sigma: [number, number];
  heading_sigma: [number, number];
  sweeps: [number, number];
  burn_in: [number, number];
  seed: [number, number];
  radius: [number, number];
  risk: [number, number];
  side: [number, number];
  sensors: [number, number];
  resolution: [number, number];
  side_of_log: [number, number];
};

/** A step of a story: a document to show, a text about its picture, and a task for the reader. */
export type Step = {
  /** Title of the step. */
  title: string;
  /** Text about the picture. */
  text: string;
  /** Task for the reader. */
  task: string;
  /** Document to show. */
  document: MapDocument;
  /** Document once the task is done; null if only a hand can do the task. */
  solution: MapDocument | null;
  /** Layer to show. */
  layer: "draw" | "entropy" | "mean" | "width";
  /** Tool that the page selects. */
  tool: "draw" | "erase" | "evidence" | "ghost" | "look" | "pan" | "path" | "sensor" | "where";
};

/** A story: a title and steps that are shown beside the map, one at a time. */
export type Story = {
  /** Title of the story. */
  title: string;
  /** Steps in order. */
  steps: Step[];
};

/** The first message of a connection. */
export type Welcome = {
  type: "welcome";
  /** Version of the document's format. */
  version: number;
  /** Limits of the settings; null for a recording, which has no settings to change. */
  limits: Limits | null;
  /** Whether the page plays a recording. */
  recorded: boolean;
  /** Whether the page samples by itself, without a server. */
  figure: boolean;
  /** Layers for which a recording has no numbers. */
  lacks: ("draw" | "entropy" | "mean" | "width")[];
  /** A story to tell beside the map. */
  story: Story | null;
};

/** A change in the state of the worker process, which does the inference. */
export type Worker = {
  type: "worker";
  /** New state. */
  state: "ready" | "restarted" | "starting";
};

/** The number of kept draws: `count` per chain. */
export type DrawCount = {
  /** Number of chains. */
  chains: number;
  /** Number of kept draws of each chain. */
  count: number;
};

/** The field that a page shows. Layer "draw" without a draw number is the last draw. */
export type View = {
  /** Layer of the field. */
  layer: "draw" | "entropy" | "mean" | "width";
  /** Index of the chain, for a draw. */
  chain: number | null;
  /** Index of the draw. */
  draw: number | null;
};

/** The present state, sent after every action that was applied. */
export type State = {
  type: "state";
  /** Present document. */
  document: MapDocument;
  /** Number of the present picture. */
  generation: number;
  /** Number of the page's last action that was applied. */
  seq: number;
  /** Whether this page may undo the last edit. */
  can_undo: boolean;
  /** Whether this page may redo the edit that was undone last. */
  can_redo: boolean;
  /** Whether edits restart the chains. */
  live: boolean;
  /** Whether a run is under way. */
  running: boolean;
  /** Whether the picture is still being computed. */
  working: boolean;
  /** Number of kept draws of the present result. */
  draws: DrawCount;
  /** Index of the scan on show, for a file. */
  scan: number;
  /** Field that this page gets. */
  view: View;
};

/** Readings: all scans of a simulation, or one scan of a file. Buffers: pose float64 (S, 3); angles float32 (A); ranges float32 (S, A); exact float32 (S, A), the noise-free ranges, empty for a file; hit uint8 (S, A), 0 for a beam without a return. */
export type Scan = {
  type: "scan";
  /** Ids of the sensors, one per row. */
  ids: number[];
  /** Index of the scan, for a file. */
  index: number | null;
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** The verdict on a result, and its reason. */
export type Verdict = {
  /** The verdict. */
  level: "bad" | "fair" | "good";
  /** The reason. */
  why: string;
  /** The cell that the reason names. */
  cell: [number, number] | null;
};

/** The quantity that a map shows, in words. */
export type Quantity = {
  /** Kind of cells. */
  kind: string;
  /** Words for the posterior mean, such as "P(wall)". */
  mean: string;
  /** Words for the value in one draw. */
  value: string;
  /** Whether the quantity has credible intervals. */
  interval: boolean;
};

/** One picture of the posterior. Buffers: p uint8 (nx, ny), probability or interval width in 255ths; reached uint8 (nx, ny), probability in 255ths that a beam reaches each cell; traced float32 (n), sweep numbers: the first 100, then evenly spread; trace float32 (chains, n), the log joint at these sweeps; for importance sampling also weights float32 (24), a histogram of the particles' log weights. */
export type Field = {
  type: "field";
  /** Layer of the numbers. The page computes the entropy from the mean. */
  layer: "draw" | "entropy" | "mean" | "width";
  /** Name of the method. */
  method: string;
  /** Whether the mean is a quick approximation of the posterior mean. */
  approximate: boolean;
  /** Number of sweeps, rounds or particles done. */
  sweeps: number;
  /** Number of sweeps or particles to do. */
  total: number;
  /** Effective sample size of the log joint, or of the weights. */
  ess: number | null;
  /** R-hat of the log joint. */
  rhat: number | null;
  /** Last log joint, averaged over the chains. */
  log_joint: number | null;
  /** Verdict on the result; null while it is too early. */
  verdict: Verdict | null;
  /** Number of kept draws. */
  draws: DrawCount;
  /** Quantity that the numbers show. */
  quantity: Quantity;
  /** Time since the job began. */
  milliseconds: number;
  /** Index of the chain, for a draw. */
  chain: number | null;
  /** Index of the draw. */
  draw: number | null;
  /** Number of draws in the mean, for the chain that fits the sensor. */
  averaged: number | null;
  /** Lower edge of the first bin of weights, in nats relative to the largest log weight, where the bins end. */
  lowest: number | null;
  /** Number of first sweeps that are left out of the mean, R-hat and the effective sample size. */
  burned: number;
  /** Time spent on sweeps, rounds or particles. */
  seconds: number | null;
  /** The method, the prior, the sensor and the poses of what is shown, in words. */
  about: [string, string][];
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** The overlay of a run or a log. Buffers: strokes float32 (U, 5), surfaces as segments x, y, x, y in metres, and their reflectivity; trajectory float32 (S, 2), the positions of the scans in metres. */
export type Overlay = {
  type: "overlay";
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** The evidence of the beams through a cell, for and against an obstacle in it. Buffers of the strongest beams, with `each`: start and end float64 (M, 2), metres; nats, scan, beam float64 (M); of walls with kept draws also trace uint8 (chains, n), 1 in the draws with a wall. */
export type CellFacts = {
  type: "cell";
  /** Index of the cell along x. */
  x: number;
  /** Index of the cell along y. */
  y: number;
  /** Whether the question asked for each beam. */
  each: boolean;
  /** Number of beams through the cell. */
  beams: number;
  /** Number of beams for an obstacle; null, like the next fields, if the evidence cannot be computed. */
  beams_for: number | null;
  /** Sum of the log ratios of the beams for an obstacle. */
  nats_for: number | null;
  /** Number of beams against an obstacle. */
  beams_against: number | null;
  /** Absolute sum of the log ratios of the beams against an obstacle. */
  nats_against: number | null;
  /** Index of the draw whose other cells are given. */
  draw: number | null;
  /** Index of the chain of this draw. */
  chain: number | null;
  /** With a draw, log odds of a wall by the prior; null where it is sure. */
  prior_nats: number | null;
  /** Log odds of a wall given all other cells of the draw: those by which Gibbs draws it. */
  log_odds: number | null;
};

/** The shortest path whose risk is low enough, or the safest. */
export type SafePath = {
  type: "path";
  /** Corners of the path, metres. */
  path: [number, number][];
  /** Length of the path. */
  length_m: number;
  /** Radius of the disc, metres. */
  radius: number;
  /** Whether the risk of the path is low enough. */
  within_risk: boolean;
  /** Probability that the path is free: the share of draws in which it is. */
  probability: number;
  /** Standard error of `probability`. */
  standard_error: number;
  /** Probability that the path is free if cells were independent. */
  independent: number;
  /** Number of draws. */
  draws: number;
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** The information expected from one more scan, at places that are `spacing` metres apart. Buffers: pose float32 (n, 3), the best heading at each place; nats float32 (n). */
export type Views = {
  type: "views";
  /** Distance between neighbouring places, metres. */
  spacing: number;
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** The real scan nearest to a pose. */
export type NearestScan = {
  /** Index of the scan. */
  index: number;
  /** Distance of the scan's position from the pose, metres. */
  away: number;
  /** Heading of the scan minus heading of the pose, radians. */
  turn: number;
};

/** The virtual scan of a robot's laser at a pose, and the nearest real scan. Buffers: angles float32 (A); low, median, high float32 (A), the median and central 80 % interval of each beam in metres, infinite for no return; of the real scan near_pose float64 (3), near_ranges float32 (A), near_hit uint8 (A). */
export type VirtualScan = {
  type: "ghost";
  /** X of the pose, metres. */
  x: number;
  /** Y of the pose, metres. */
  y: number;
  /** Heading of the pose, radians. */
  yaw: number;
  /** Whether only a few draws were used, since the hand still moved. */
  coarse: boolean;
  /** Number of draws used; 0 without draws, when cells count as independent. */
  draws: number;
  /** Nearest real scan, if one is near enough. */
  near: NearestScan | null;
  /** Time that the prediction took. */
  milliseconds: number;
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** A reading in the frame of a surface, whose covariance has the axes across and along the surface. */
export type SurfaceOffset = {
  /** Offset of the reading across the surface. */
  across_m: number;
  /** Offset of the reading along the surface. */
  along_m: number;
  /** Standard deviation of the surface across. */
  thickness_m: number;
  /** Standard deviation of the surface along. */
  length_m: number;
  /** Angle between the beam and the surface's normal. */
  incidence_rad: number;
};

/** One reading compared with its prediction. Lengths are in metres; null means infinite or unknown. */
export type ComparedBeam = {
  type: "beam";
  /** Index of the scan. */
  scan: number;
  /** Index of the beam. */
  beam: number;
  /** Number of draws used. */
  draws: number;
  /** Kind of reading: a range, no return, too close, or invalid. */
  reading: "bad" | "close" | "hit" | "none";
  /** Reading. */
  range: number | null;
  /** Lower end of the central 80 % interval. */
  low: number | null;
  /** Median of the prediction. */
  median: number | null;
  /** Upper end of the central 80 % interval. */
  high: number | null;
  /** Reading minus median. */
  residual: number | null;
  /** Negative log density of the reading. */
  nats: number | null;
  /** Probability of no return. */
  no_return: number | null;
  /** Reading in the frame of the surface at which the beam most probably stopped. */
  wall: SurfaceOffset | null;
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** The reason why a question has no answer. */
export type Undecided = {
  type: "undecided";
  /** The reason. */
  text: string;
  /** Type of the message that would have answered the question. */
  question: "beam" | "ghost" | "path" | "views";
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** A mode of the pose's posterior: mean and covariance of x, y (metres) and yaw (radians). */
export type Place = {
  /** Mean pose, (3,). */
  mean: number[];
  /** Covariance of the pose, (3, 3). */
  covariance: number[][];
  /** Probability of the mode. */
  probability: number;
  /** Standard deviation of the position along its longest axis. */
  sigma_m: number;
  /** Standard deviation of the heading. */
  sigma_rad: number;
};

/** The posterior of the pose from which a scan was taken. Buffers: pose float32 (n, 3) and weight float32 (n), the smallest weight first. */
export type Whereabouts = {
  type: "where";
  /** Number of the picture, as in other messages. */
  picture: number;
  /** Id of the sensor, in a drawn world. */
  sensor: number | null;
  /** Index of the scan, for a file. */
  index: number | null;
  /** Pose of the scan in the document or the file. */
  pose: number[];
  /** Places where the robot may be, the most probable first. */
  modes: Place[];
  /** Probability that the pose is nowhere on the map. */
  p_lost: number;
  /** Log density of the readings per beam, under the best pose. */
  nats_per_beam: number;
  /** Reason why there is no answer; else empty. */
  trouble: string;
};

/** Progress in one stage of the inference of a log's trajectory. */
export type Stage = {
  type: "stage";
  /** Name of the stage. */
  name: string;
  /** Name of the stage in words, for users. */
  text: string;
  /** Number of parts done. */
  done: number;
  /** Number of parts in all. */
  total: number;
  /** Number of the picture: that of the job which computed it. */
  generation: number;
};

/** A message for the status line. */
export type Status = {
  type: "status";
  /** Text of the message. */
  text: string;
  /** Severity. */
  level: "error" | "info" | "warning";
};

/** Report that a message was refused. Nothing has changed. */
export type Refusal = {
  type: "error";
  /** Description of the fault. */
  text: string;
  /** What to do instead, or empty. */
  remedy: string;
  /** Number of the message, if it could be read. */
  seq: number | null;
};

/** A file to save. Buffers: data uint8. */
export type Download = {
  type: "download";
  /** Name of the file. */
  name: string;
  /** Media type of the file. */
  mime: string;
  /** What the file holds, for the status line. */
  note: string;
};

/** The numbers and the format of the draws in a recording. */
export type RecordedDraws = {
  /** Number of chains. */
  chains: number;
  /** Number of draws of each chain in the recording. */
  count: number;
  /** Number of kept draws of each chain in the result. */
  kept: number;
  /** True for walls, packed bits of a map; false for stop probabilities in 255ths. */
  bits: boolean;
};

/** The result in a page in one file: the messages of a session, for a page without one. Buffers: the buffers of `Field` for the mean; width uint8 (nx, ny) if there are intervals; beams uint32 (nx * ny,), the beams through each cell; draws uint8 (chains, count, bytes of a map); the buffers of `Scan` for all recorded scans, with one row of angles for each scan if scans differ in them; for a file the buffers of `Overlay`. */
export type Recording = {
  /** Version of this format. */
  version: 1;
  /** Document of the result. */
  document: MapDocument;
  /** The mean. */
  field: Field;
  /** Id of each recorded scan: of its sensor, or its index in the file plus 1. */
  ids: number[];
  /** Numbers of draws. */
  draws: RecordedDraws;
  /** Log joint of each draw, one row per chain. */
  log_joint: number[][];
};

/** The limits by which chains and particles are judged. R-hat and effective sample size: Vehtari et al. (2021). */
export type VerdictLimits = {
  /** R-hat over this is bad. */
  rhat_limit: number;
  /** R-hat up to this is good. */
  good_rhat: number;
  /** This many effective draws make R-hat reliable. */
  good_ess: number;
  /** Fewer effective draws are bad. */
  bad_ess: number;
  /** Fewest sweeps for a verdict on running chains, and for a comparison of their means. */
  fewest_sweeps: number;
  /** R-hat needs two draws in each half of a chain. */
  fewest_diagnosed: number;
  /** A cell's means in two chains differ: 5 standard errors of 200 draws at p = 1/2. */
  bad_difference: number;
  /** One of 30 000 true maps has a larger misfit. */
  misfit_sigmas: number;
  /** Share of the cells in which means of chains may differ by more. */
  chance_share: number;
};

/** The data of a figure, with which a page begins a session without a server. */
export type Figure = {
  /** Version of this format. */
  version: 1;
  /** Document of a drawn world. */
  document: MapDocument;
  /** Limits of the settings. */
  limits: Limits;
  /** Prior of walls or free cells up to which method "auto" means blocks. */
  rare_walls: number;
  /** Limits by which chains are judged. */
  judging: VerdictLimits;
  /** Story to tell beside the map. */
  story: Story | null;
};

export type Action =
  | Hello
  | ChangeSettings
  | PaintWalls
  | AddSensor
  | MoveSensor
  | RemoveSensor
  | Clear
  | NewMap
  | Undo
  | Redo
  | Run
  | Cancel
  | SetLive
  | ShowView
  | Painted
  | ShowScan
  | Export
  | Inspect
  | FindPath
  | FindViews
  | WhereAmI
  | MoveVirtualScan
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
  | VirtualScan
  | ComparedBeam
  | Undecided
  | Whereabouts
  | Stage
  | Status
  | Refusal
  | Download;
