// Edits of a drawn world in a page without a server, and the steps that can be undone.

import { fromBase64, packBits, toBase64, unpackBits } from "../geometry/bits";
import type { Action, Limits, MapDocument, Sensor } from "../protocol";

const DEPTH = 200; // steps that can be undone
const NEW_NOISE_M = 0.2;

/** An action that is refused: nothing has changed. */
export class Refused extends Error {}

const wallsOf = ({ grid, walls }: MapDocument) => unpackBits(fromBase64(walls), grid.shape[0] * grid.shape[1]);

/** The flat index of the cell of a point, or null outside the map. */
function cellAt({ grid }: MapDocument, { x, y }: { x: number; y: number }): number | null {
  const [i, j] = [Math.floor((x - grid.origin[0]) / grid.resolution), Math.floor((y - grid.origin[1]) / grid.resolution)];
  return i >= 0 && i < grid.shape[0] && j >= 0 && j < grid.shape[1] ? i * grid.shape[1] + j : null;
}

function standing(document: MapDocument, sensor: Sensor): Sensor {
  const cell = cellAt(document, sensor);
  if (cell === null) throw new Refused("the sensor cannot stand outside the map");
  if (wallsOf(document)[cell]) throw new Refused("the sensor cannot stand in a wall; move it to a free cell");
  return { ...sensor, yaw: sensor.yaw - 2 * Math.PI * Math.round(sensor.yaw / (2 * Math.PI)) };
}

/** The document after an edit, and a remark if only part of it was possible; null if the action is no edit. */
export function edit(document: MapDocument, action: Action, limits: Limits): [MapDocument, string] | null {
  switch (action.type) {
    case "set":
      return [checked({ ...document, ...action.patch }, document, limits), ""];
    case "walls":
      return drawn(document, action.cells, action.wall);
    case "clear":
      return action.what === "walls" ? [{ ...document, walls: blank(document.grid.shape) }, ""] : null;
    case "add_sensor": {
      if (document.sensors.length >= limits.sensors[1]) throw new Refused(`there are ${document.sensors.length} sensors already; remove one first`);
      const id = Math.max(...document.sensors.map((sensor) => sensor.id)) + 1;
      return [{ ...document, sensors: [...document.sensors, standing(document, { id, x: action.x, y: action.y, yaw: action.yaw ?? 0 })] }, ""];
    }
    case "move_sensor": {
      const moved = (sensor: Sensor) => standing(document, { id: sensor.id, x: action.x ?? sensor.x, y: action.y ?? sensor.y, yaw: action.yaw ?? sensor.yaw });
      return [{ ...document, sensors: document.sensors.map((sensor) => (sensor.id === action.id ? moved(sensor) : sensor)) }, ""];
    }
    case "remove_sensor": {
      const sensors = document.sensors.filter((sensor) => sensor.id !== action.id);
      if (!sensors.length) throw new Refused("the last sensor cannot be removed; add another first");
      return [{ ...document, sensors }, ""];
    }
    case "new":
      return [begun(document, action.shape, action.world), ""];
    default:
      return null;
  }
}

const blank = ([nx, ny]: [number, number]) => toBase64(new Uint8Array((nx * ny + 7) >> 3));

function drawn(document: MapDocument, cells: [number, number][], wall: boolean): [MapDocument, string] {
  const walls = wallsOf(document);
  const ny = document.grid.shape[1];
  for (const [x, y] of cells) walls[x * ny + y] = wall ? 1 : 0;
  let remark = "";
  for (const sensor of document.sensors) {
    const cell = cellAt(document, sensor)!;
    if (walls[cell]) remark = `a sensor stands in cell (${Math.floor(cell / ny)}, ${cell % ny}): it stays free`;
    walls[cell] = 0;
  }
  return [{ ...document, walls: toBase64(packBits(walls)) }, remark];
}

/** A blank map with one sensor near the middle. */
function begun(before: MapDocument, shape: [number, number], world: string): MapDocument {
  if (world !== "blank") throw new Refused("this figure can begin blank maps alone; bayesmap app has others");
  const [x, y] = shape.map((size) => Math.floor((size - 1) / 2));
  const grid = { shape, resolution: 1, origin: [-0.5, -0.5] as [number, number] };
  return { ...before, grid, walls: blank(shape), sensors: [{ id: 1, x, y, yaw: 0 }], noise: NEW_NOISE_M, max_range: 2 * Math.max(...shape) };
}

/** A document from outside, if it has the fields of another and its numbers lie within the limits. */
export function checked(brought: object, like: MapDocument, limits: Limits): MapDocument {
  const document = brought as MapDocument;
  for (const [name, value] of Object.entries(like) as [keyof MapDocument, unknown][]) {
    const is = document[name];
    if (value !== null && (typeof is !== typeof value || is === null)) throw new Refused(`${name} is missing, or of another type`);
    const bounds = limits[name as keyof Limits];
    if (bounds && typeof is === "number" && !(is >= bounds[0] && is <= bounds[1])) throw new Refused(`${name}: ${is}; give ${bounds[0]} to ${bounds[1]}`);
  }
  const { grid, source, sensors, walls } = document;
  if (source.kind !== "simulation") throw new Refused("this figure shows drawn maps alone; start bayesmap app with the file");
  if (document.cells !== "binary" || document.pose_sigma > 0 || document.heading_sigma > 0) throw new Refused("this figure samples walls seen from known poses alone; bayesmap app samples others");
  if (document.method === "propagate") throw new Refused("this figure has no belief propagation; choose another method");
  const [least, most] = limits.side;
  if (!(grid.shape.length === 2 && grid.shape.every((size) => Number.isInteger(size) && size >= least && size <= most) && grid.resolution > 0)) throw new Refused(`grid: give ${least} to ${most} cells a side`);
  if (fromBase64(walls).length !== (grid.shape[0] * grid.shape[1] + 7) >> 3) throw new Refused("walls: another number of cells than the grid's");
  if (!(sensors.length >= limits.sensors[0] && sensors.length <= limits.sensors[1])) throw new Refused(`sensors: give ${limits.sensors[0]} to ${limits.sensors[1]}`);
  return { ...document, sensors: sensors.map((sensor) => standing(document, sensor)) };
}

/** The stroke or drag that an action belongs to: all its actions are one step of undo. */
function gestureOf(action: Action): string | null {
  if (action.type === "walls" && action.stroke) return `walls ${action.stroke}`;
  if (action.type === "set" && action.drag) return `set ${action.drag} ${Object.keys(action.patch).sort()}`;
  if (action.type === "move_sensor" && action.drag) return `move ${action.drag} ${action.id}`;
  return null;
}

export class History {
  private readonly past: MapDocument[] = [];
  private future: MapDocument[] = [];
  private gesture: string | null = null;

  constructor(public present: MapDocument) {}

  get canUndo() {
    return this.past.length > 0;
  }
  get canRedo() {
    return this.future.length > 0;
  }

  push(document: MapDocument, action: Action) {
    const gesture = gestureOf(action);
    if (gesture === null || gesture !== this.gesture) {
      this.past.push(this.present);
      if (this.past.length > DEPTH) this.past.shift();
    }
    this.future = [];
    this.gesture = gesture;
    this.present = document;
  }

  /** Go one step back, or forward; whether there was one. */
  step(back: boolean): boolean {
    const [from, to] = back ? [this.past, this.future] : [this.future, this.past];
    const document = from.pop();
    if (!document) return false;
    to.push(this.present);
    this.present = document;
    this.gesture = null;
    return true;
  }
}
