// Mouse, pen and fingers on the map.

import { lineOfCells, toMetres } from "../geometry/cells";
import { placeOf } from "../layers/sensors";
import type { Viewport } from "../layers/viewport";
import type { MapDocument, Point } from "../protocol";
import type { Session } from "../state/session";
import type { Editor } from "./editor";
import { dragGhost, takeGhost, type GhostGesture } from "./ghosting";
import { READING, type Hand } from "./hand";
import { pick, PICKING } from "./picking";

const REACH = { touch: 24, other: 11 };
/** A hand that moves no further has clicked. */
const CLICK_PIXELS = 5;
/** A second finger may follow a first at once, and then the first was no stroke. */
const SECOND_FINGER_MS = 90;

type Gesture =
  | { kind: "stroke"; id: number; wall: boolean; last: Point; held: PointerEvent | null; onWall: boolean }
  | { kind: "sensor"; id: number; drag: number; grip: Point }
  | { kind: "turn"; id: number; drag: number }
  | { kind: "pan"; last: Point }
  | { kind: "pick"; first: Point }
  | GhostGesture
  | { kind: "pinch"; middle: Point; spread: number };

export class Pointer {
  private readonly fingers = new Map<number, Point>();
  private gesture: Gesture | null = null;
  /** Whether the last thing on the map was a finger. */
  private touched = false;

  /** In a notebook (embedded) the wheel belongs to the page until the map has the focus. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly session: Session,
    private readonly view: Viewport,
    private readonly hand: Hand,
    private readonly editor: Editor,
    private readonly embedded: boolean,
  ) {
    const listen = <K extends keyof HTMLElementEventMap>(type: K, listener: (event: HTMLElementEventMap[K]) => void) =>
      canvas.addEventListener(type, listener, { passive: false });
    listen("pointerdown", (event) => this.down(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => this.up(event));
    listen("pointercancel", (event) => this.up(event));
    listen("pointerleave", () => {
      hand.point(null);
      if (!this.touched) session.reading.point(null, 0);
    });
    listen("wheel", (event) => this.wheel(event));
    listen("contextmenu", (event) => event.preventDefault());
  }

  private at(event: { clientX: number; clientY: number }): Point {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  /** The cell under a point of the canvas; it may lie outside the grid. */
  private cellAt(point: Point): Point {
    const grid = this.view.toGrid(point, this.session.shape[1]);
    return { x: Math.floor(grid.x), y: Math.floor(grid.y) };
  }

  private metres(point: Point, { grid }: MapDocument): Point {
    return toMetres(this.view.toGrid(point, grid.shape[1]), grid);
  }

  private begin(gesture: Gesture) {
    this.gesture = gesture;
    this.hand.busy = true;
  }

  private down(event: PointerEvent) {
    const { session, hand } = this;
    const { document } = session;
    if (!document) return;
    event.preventDefault();
    this.canvas.focus({ preventScroll: true });
    this.canvas.dataset.pointed = ""; // who points needs no frame around the focus
    hand.setCursor(null);
    this.canvas.setPointerCapture(event.pointerId);
    const point = this.at(event);
    this.fingers.set(event.pointerId, point);
    if (this.fingers.size === 2) return this.begin({ kind: "pinch", ...this.spread() });
    if (this.gesture) return;
    if (event.button === 0 && hand.tool === "ghost") {
      this.begin(takeGhost(session.ghost, point, this.reach(event), document.grid, this.view));
      return this.dragGhost(event);
    }
    if (event.button === 0 && PICKING.has(hand.tool)) return this.begin({ kind: "pick", first: point });
    // who asks where the robot is may drag it
    const held = hand.tool === "where" && session.editable && event.button !== 1 ? this.gripAt(point, event, document) : null;
    if (held?.kind === "sensor") {
      hand.select(held.id);
      return this.begin(held);
    }
    if (event.button === 1 || READING.has(hand.tool) || !session.editable) return this.begin({ kind: "pan", last: point });
    const grip = this.gripAt(point, event, document);
    if (grip) {
      this.begin(grip);
      if (grip.kind === "sensor") hand.select(grip.id);
    } else if (hand.tool === "sensor") {
      if (event.shiftKey) this.editor.addSensor({ world: this.metres(point, document) });
      else if (hand.sensor) {
        hand.selected = hand.sensor.id;
        this.begin({ kind: "sensor", id: hand.sensor.id, drag: hand.nextGesture(), grip: { x: 0, y: 0 } });
        this.dragSensor(event);
      }
    } else {
      const wall = (hand.tool === "draw") !== (event.button === 2 || event.shiftKey);
      const cell = this.cellAt(point);
      const onWall = wall && this.editor.isWall(cell);
      this.begin({ kind: "stroke", id: hand.nextGesture(), wall, last: cell, held: event, onWall });
      if (event.pointerType !== "touch") this.release();
      else setTimeout(() => this.release(), SECOND_FINGER_MS);
    }
  }

  /** The gesture that takes hold of a sensor or its handle at a point, where there is one. */
  private gripAt(point: Point, event: PointerEvent, document: MapDocument): Gesture | null {
    const { hand, view } = this;
    const reach = this.reach(event);
    const near = (other: Point) => Math.hypot(point.x - other.x, point.y - other.y);
    const own = hand.tool === "sensor" && hand.sensor ? placeOf(hand.sensor, document.grid, view) : null;
    if (own && hand.sensor && near(own.handle) < Math.min(reach, near(own.point))) {
      return { kind: "turn", id: hand.sensor.id, drag: hand.nextGesture() };
    }
    if (event.button !== 0 || hand.tool === "erase") return null;
    const places = document.sensors.map((sensor) => ({ id: sensor.id, ...placeOf(sensor, document.grid, view) }));
    places.sort((a, b) => near(a.point) - near(b.point));
    const place = places.find(({ point: other, size }) => near(other) < Math.max(reach, size));
    if (!place) return null;
    const shift = { x: place.point.x - point.x, y: place.point.y - point.y };
    return { kind: "sensor", id: place.id, drag: hand.nextGesture(), grip: shift };
  }

  /** Draws the first cell of a stroke. */
  private release() {
    if (this.gesture?.kind !== "stroke" || !this.gesture.held) return;
    const event = this.gesture.held;
    this.gesture.held = null;
    this.stroke([this.gesture.last], event);
  }

  private move(event: PointerEvent) {
    const { gesture, session, view, hand } = this;
    const point = this.at(event);
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, point);
    if (!gesture) {
      hand.point(this.cellAt(point));
      this.pointAtReading(event);
    } else if (gesture.kind === "ghost") {
      this.dragGhost(event);
    } else if (gesture.kind === "stroke") {
      this.release();
      const path = [];
      const events = event.getCoalescedEvents?.() ?? [];
      for (const each of events.length ? events : [event]) {
        const cell = this.cellAt(this.at(each));
        if (cell.x !== gesture.last.x || cell.y !== gesture.last.y) gesture.onWall = false;
        path.push(...lineOfCells(gesture.last, cell));
        gesture.last = cell;
      }
      this.stroke(path, event);
      hand.point(gesture.last);
    } else if (gesture.kind === "sensor") {
      this.dragSensor(event);
    } else if (gesture.kind === "turn") {
      const sensor = session.document?.sensors.find((candidate) => candidate.id === gesture.id);
      if (!sensor || !session.document) return;
      const world = this.metres(point, session.document);
      this.editor.moveSensor(sensor, { yaw: Math.atan2(world.y - sensor.y, world.x - sensor.x) }, gesture.drag, event);
    } else if (gesture.kind === "pick") {
      // a hand that moves on has taken hold of the map
      if (Math.hypot(point.x - gesture.first.x, point.y - gesture.first.y) > CLICK_PIXELS) this.begin({ kind: "pan", last: point });
    } else if (gesture.kind === "pan") {
      view.pan(point.x - gesture.last.x, point.y - gesture.last.y, session.shape);
      gesture.last = point;
      session.changed();
    } else if (this.fingers.size === 2) {
      const { middle, spread } = this.spread();
      view.pan(middle.x - gesture.middle.x, middle.y - gesture.middle.y, session.shape);
      view.zoom(spread / gesture.spread, middle, session.shape);
      Object.assign(gesture, { middle, spread });
      session.changed();
    }
  }

  private up(event: PointerEvent) {
    if (event.type === "pointerup") this.release();
    // a wall that was clicked, and not drawn on from, goes
    if (event.type === "pointerup" && this.gesture?.kind === "stroke" && this.gesture.onWall) {
      this.editor.setWalls([this.gesture.last], false, this.gesture.id, event);
    }
    if (event.type === "pointerup" && this.gesture?.kind === "pick" && this.session.document) {
      pick(this.session, this.hand, this.editor, this.metres(this.gesture.first, this.session.document));
    }
    this.fingers.delete(event.pointerId);
    if (this.fingers.size === 0) {
      this.gesture = null;
      this.hand.busy = false;
      this.session.ghost.rest();
    }
    this.touched = event.pointerType === "touch";
    if (!this.touched) return;
    this.hand.point(this.cellAt(this.at(event))); // a finger cannot hover: its last cell stays
    this.pointAtReading(event);
  }

  private reach({ pointerType }: PointerEvent) {
    return pointerType === "touch" ? REACH.touch : REACH.other;
  }

  private pointAtReading(event: PointerEvent) {
    const { document, reading, ghost } = this.session;
    if (!document || ghost.held) return;
    const metresAPixel = document.grid.resolution / this.view.transform.scale;
    reading.point(this.metres(this.at(event), document), this.reach(event) * metresAPixel);
  }

  private dragGhost(event: PointerEvent) {
    const { gesture, session } = this;
    if (gesture?.kind !== "ghost" || !session.document) return;
    this.hand.point(null);
    const point = this.at(event);
    dragGhost(session.ghost, gesture, this.metres({ x: point.x + gesture.grip.x, y: point.y + gesture.grip.y }, session.document));
  }

  private spread() {
    const [a, b] = [...this.fingers.values()];
    return { middle: { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }, spread: Math.max(10, Math.hypot(a.x - b.x, a.y - b.y)) };
  }

  private wheel(event: WheelEvent) {
    if (!this.session.document) return;
    const focused = (this.canvas.getRootNode() as ShadowRoot).activeElement === this.canvas;
    if (this.embedded && !event.ctrlKey && !focused) return;
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 16 : 1;
    if (event.shiftKey) this.view.pan(-unit * (event.deltaX || event.deltaY), 0, this.session.shape);
    else this.view.zoom(Math.exp(-unit * event.deltaY * (event.ctrlKey ? 0.01 : 0.0016)), this.at(event), this.session.shape);
    this.session.changed();
  }

  private stroke(path: Point[], event: Event) {
    const { session, gesture } = this;
    if (gesture?.kind !== "stroke") return;
    this.editor.setWalls(path, gesture.wall, gesture.id, event);
    if (session.status.level === "error") session.say("Ready");
  }

  private dragSensor(event: PointerEvent) {
    const { gesture, session } = this;
    const { document } = session;
    if (gesture?.kind !== "sensor" || !document) return;
    this.hand.point(null);
    const sensor = document.sensors.find((candidate) => candidate.id === gesture.id);
    const point = this.at(event);
    const world = this.metres({ x: point.x + gesture.grip.x, y: point.y + gesture.grip.y }, document);
    if (sensor) this.editor.moveSensor(sensor, world, gesture.drag, event);
  }
}
