// Edits of the map and of its sensors, with what can be refused at once.

import { cellOf, inside } from "../geometry/cells";
import { mostOpen, nearestFree } from "../geometry/room";
import type { Pair, Point, Sensor } from "../protocol";
import type { Session } from "../state/session";
import type { Hand } from "./hand";

export class Editor {
  constructor(
    private readonly session: Session,
    private readonly hand: Hand,
  ) {}

  /** Whether there is a wall in a cell. */
  isWall(cell: Point) {
    return inside(cell, this.session.shape) && this.session.walls[cell.x * this.session.shape[1] + cell.y] === 1;
  }

  /** Sends those cells of a path that change; all of one stroke are one step of undo. */
  setWalls(path: Point[], wall: boolean, stroke: number, event: Event) {
    const { document, shape } = this.session;
    if (!document) return;
    const taken = wall ? document.sensors.map((sensor) => cellOf(sensor, document.grid)) : [];
    const cells = new Map<number, Pair>();
    for (const cell of path) {
      if (!inside(cell, shape) || this.isWall(cell) === wall) continue;
      if (taken.some((other) => other.x === cell.x && other.y === cell.y)) continue;
      cells.set(cell.x * shape[1] + cell.y, [cell.x, cell.y]);
    }
    if (path.some(({ x, y }) => taken.some((other) => other.x === x && other.y === y))) this.session.say("A sensor stands in a cell of this stroke: it stays free.", "warning");
    if (cells.size) this.session.act({ type: "walls", cells: [...cells.values()], wall, stroke }, event);
  }

  moveSensor(sensor: Sensor, place: { x?: number; y?: number; yaw?: number }, drag?: number, event?: Event) {
    const { x, y, yaw } = { ...sensor, ...place };
    if (this.refuses({ x, y })) return;
    this.session.act({ type: "move_sensor", id: sensor.id, x, y, yaw, drag }, event);
  }

  /** Another sensor: at a place in metres, in the free cell nearest to a cell, or in the most open place. */
  addSensor(where: { world: Point; yaw?: number } | { near: Point } | "where there is room") {
    const { session } = this;
    const { document } = session;
    if (!document) return;
    const place =
      where === "where there is room"
        ? mostOpen(document, session.walls)
        : "world" in where
          ? where.world
          : nearestFree(document, session.walls, where.near);
    const most = session.limits?.sensors[1] ?? Infinity;
    if (!place) session.say("There is no free cell for a sensor.", "warning");
    else if (document.sensors.length >= most) session.say(`There can be ${most} sensors at most.`, "warning");
    else if (!this.refuses(place)) {
      session.act({ type: "add_sensor", x: place.x, y: place.y, yaw: typeof where === "object" && "world" in where ? (where.yaw ?? 0) : 0 });
      this.hand.selected = Math.max(0, ...document.sensors.map((sensor) => sensor.id)) + 1;
    }
  }

  removeSensor() {
    const { sensor } = this.hand;
    if (sensor) this.session.act({ type: "remove_sensor", id: sensor.id });
  }

  /** Says so where a sensor cannot stand. */
  private refuses(world: Point) {
    const { session } = this;
    if (!session.document) return true;
    const cell = cellOf(world, session.document.grid);
    const wall = this.isWall(cell);
    if (!wall && inside(cell, session.shape)) {
      if (session.status.text.startsWith("A sensor cannot")) session.say("Ready");
      return false;
    }
    session.say(wall ? "A sensor cannot stand in a wall." : "A sensor cannot stand outside the map.", "warning");
    return true;
  }
}
