// What the hand holds: the tool, the chosen sensor, the cell under the pointer, the keyboard's cell.

import { inside } from "../geometry/cells";
import type { Point, Sensor } from "../protocol";
import type { Session } from "../state/session";

export type Tool = "draw" | "erase" | "sensor" | "pan" | "path" | "look" | "where" | "ghost" | "evidence";
/** Tools that change nothing. */
export const READING = new Set<Tool>(["pan", "path", "look", "where", "ghost", "evidence"]);
const REST_MS = 120;

export class Hand {
  tool: Tool = "draw";
  /** Id of the sensor that was chosen. */
  selected: number | null = null;
  hover: Point | null = null;
  cursor: Point | null = null;
  /** Whether a gesture is under way. */
  busy = false;
  /** Says something to a screen reader. */
  announce: (text: string) => void = () => {};
  /** What is said of a cell that the keyboard points at. */
  describe: (cell: Point) => string = () => "";
  // begins with a number that undo has not seen on this connection
  private gestures = Math.floor(Math.random() * 2 ** 30);
  private asked = 0;

  constructor(private readonly session: Session) {}

  /** A number for another gesture. */
  nextGesture() {
    return ++this.gestures;
  }

  /** The chosen sensor, or the first. */
  get sensor(): Sensor | null {
    const sensors = this.session.document?.sensors ?? [];
    return sensors.find((sensor) => sensor.id === this.selected) ?? sensors[0] ?? null;
  }

  choose(tool: Tool) {
    this.tool = tool;
    this.session.decisions.look(tool === "look");
    this.session.decisions.showPath(tool === "path" || tool === "pan" || !READING.has(tool));
    this.session.ghost.hold(tool === "ghost");
    this.session.evidence.hold(tool === "evidence");
    this.session.changed();
  }

  select(id: number | null) {
    this.selected = id;
    this.session.changed();
  }

  /** The read-out follows the pointer; the beams through the cell are asked for once it rests. */
  point(cell: Point | null) {
    const at = cell && inside(cell, this.session.shape) ? cell : null;
    if (at?.x === this.hover?.x && at?.y === this.hover?.y) return;
    this.hover = at;
    this.ask(at);
    this.session.changed();
  }

  setCursor(cell: Point | null) {
    if (!cell && !this.cursor) return;
    this.cursor = cell;
    this.ask(cell);
    this.session.changed();
  }

  private ask(cell: Point | null) {
    clearTimeout(this.asked);
    if (!cell || this.busy) return;
    this.asked = window.setTimeout(() => {
      this.session.act({ type: "inspect", x: cell.x, y: cell.y });
      if (this.cursor) this.announce(this.describe(cell));
    }, REST_MS);
  }
}
