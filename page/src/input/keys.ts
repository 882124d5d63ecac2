// The keyboard, on the map and on the whole page.

import { centreOf, clamp } from "../geometry/cells";
import { GUTTER, type Viewport } from "../layers/viewport";
import type { Layer, Point } from "../protocol";
import type { Session } from "../state/session";
import type { Editor } from "./editor";
import { READING, type Hand, type Tool } from "./hand";
import { pick, PICKING } from "./picking";

/** Whom keys are for: where a map can be drawn, where the posterior can be asked, where scans are located, where edits can be undone, where there is something to infer. */
export type KeysFor = "all" | "drawn" | "asked" | "located" | "edited" | "inferred";

/** What keys do, for the help. */
export const KEYS: readonly (readonly [string, string, KeysFor?])[] = [
  ["D, E, S", "draw, erase, sensor", "drawn"],
  ["P, G, L", "pan, path, look next", "asked"],
  ["W", "where am I", "located"],
  ["O, V", "ghost, evidence of beams", "asked"],
  ["arrows", "move the cursor, the sensor, the ghost or the view; with Shift by five cells"],
  ["Space", "draw or erase at the cursor; next sensor", "drawn"],
  ["Space", "at the cursor: start or goal of a path, where to look from, or the cell to ask about", "asked"],
  ["[ and ]", "turn the sensor or the ghost", "asked"],
  ["A, Delete", "add, remove a sensor", "drawn"],
  ["R, Escape", "run, cancel", "inferred"],
  ["Escape", "take a path off the map", "asked"],
  ["M, N, H", "show the mean, a draw, the entropy or the width"],
  ["Ctrl+Z, Ctrl+Y", "undo, redo", "edited"],
  ["+, \u2212, 0", "zoom in, out, whole map"],
  ["?", "this help"],
];

const ARROWS: { [key: string]: [number, number] } = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const TURN_RAD = Math.PI / 12;

/** Keys while the map has the focus. */
export class MapKeys {
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly session: Session,
    private readonly view: Viewport,
    private readonly hand: Hand,
    private readonly editor: Editor,
  ) {
    canvas.addEventListener("keydown", (event) => {
      delete canvas.dataset.pointed;
      this.key(event);
    });
    canvas.addEventListener("blur", () => {
      delete canvas.dataset.pointed;
      hand.setCursor(null);
    });
  }

  /** Takes the focus, so that arrows move the cursor. */
  focus() {
    this.canvas.focus({ preventScroll: true });
  }

  private key(event: KeyboardEvent) {
    const { session, hand, editor } = this;
    if (!session.document || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = ARROWS[event.key];
    const far = event.shiftKey ? 5 : 1;
    if (step) this.arrow(step[0] * far, step[1] * far);
    else if (event.key === " ") this.space(event);
    else if (event.key === "[" || event.key === "]") {
      const turn = event.key === "[" ? TURN_RAD : -TURN_RAD;
      if (hand.tool === "ghost" && session.ghost.pose) session.ghost.move({ yaw: session.ghost.pose.yaw + turn });
      else if (session.editable && hand.sensor) editor.moveSensor(hand.sensor, { yaw: hand.sensor.yaw + turn }, undefined, event);
    } else if (event.key.toLowerCase() === "a" && session.editable) this.addSensor();
    else if ((event.key === "Delete" || event.key === "Backspace") && session.editable) editor.removeSensor();
    else if (event.key === "Escape" && hand.cursor) hand.setCursor(null);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Another sensor, at the cursor, or where there is most room. */
  addSensor() {
    this.editor.addSensor(this.hand.cursor ? { near: this.hand.cursor } : "where there is room");
  }

  private arrow(dx: number, dy: number) {
    const { session, view, hand } = this;
    const [nx, ny] = session.shape;
    if (hand.tool === "ghost" && session.ghost.pose && session.document) {
      const { resolution } = session.document.grid;
      const { x, y } = session.ghost.pose;
      session.ghost.move({ x: x + dx * resolution, y: y + dy * resolution });
    } else if ((hand.tool === "sensor" || hand.tool === "where") && hand.sensor && session.document && session.editable) {
      const { resolution } = session.document.grid;
      hand.selected = hand.sensor.id;
      this.editor.moveSensor(hand.sensor, { x: hand.sensor.x + dx * resolution, y: hand.sensor.y + dy * resolution });
    } else if (hand.tool === "pan" && session.editable) {
      view.pan(-40 * dx, 40 * dy, session.shape);
      session.changed();
    } else {
      const from = hand.cursor ?? { x: Math.floor(nx / 2), y: Math.floor(ny / 2) };
      const cell = { x: clamp(from.x + dx, 0, nx - 1), y: clamp(from.y + dy, 0, ny - 1) };
      hand.setCursor(cell);
      const at = view.fromGrid({ x: cell.x + 0.5, y: cell.y + 0.5 }, ny);
      const off = (v: number, low: number, high: number) => v - clamp(v, low, high);
      const out = { x: off(at.x, GUTTER.left + 10, view.width - 20), y: off(at.y, 20, view.height - GUTTER.bottom - 10) };
      if (out.x || out.y) view.pan(-out.x, -out.y, session.shape);
    }
  }

  private space(event: Event) {
    const { session, hand, editor } = this;
    if (PICKING.has(hand.tool) && session.document) {
      if (!hand.cursor) this.arrow(0, 0);
      else pick(session, hand, editor, centreOf(hand.cursor, session.document.grid));
      return;
    }
    if (!session.editable) return;
    if (hand.tool === "sensor" || hand.tool === "where") {
      const sensors = session.document?.sensors ?? [];
      const i = sensors.findIndex((sensor) => sensor.id === hand.sensor?.id);
      hand.select(sensors[(i + 1) % Math.max(1, sensors.length)]?.id ?? null);
      if (hand.selected !== null) hand.announce(`Sensor ${hand.selected}`);
    } else if (!READING.has(hand.tool)) {
      if (!hand.cursor) this.arrow(0, 0);
      const cell = hand.cursor as Point;
      const wall = hand.tool === "draw" && !editor.isWall(cell);
      editor.setWalls([cell], wall, hand.nextGesture(), event);
      hand.announce(wall ? "wall" : "free");
    }
  }
}

const TOOLS: { [key: string]: Tool } = { d: "draw", e: "erase", s: "sensor", p: "pan", g: "path", l: "look", w: "where", o: "ghost", v: "evidence" };
const LAYERS: { [key: string]: Layer } = { m: "mean", n: "draw", h: "entropy" };
const COMMANDS: { [key: string]: string } = { "+": "in", "=": "in", "-": "out", "0": "fit", "?": "help" };

/** Keys of the whole page, unless they are typed into a control. */
export function pageKey(
  event: KeyboardEvent,
  session: Session,
  chosen: { tool: (tool: Tool) => void; layer: (layer: Layer) => void; command: (what: string) => void },
) {
  const target = event.composedPath()[0];
  const typing = target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && /number|text/.test(target.type));
  const letter = event.key.toLowerCase();
  if ((event.ctrlKey || event.metaKey) && !event.altKey) {
    if (typing || (letter !== "z" && letter !== "y") || session.recorded) return;
    event.preventDefault();
    session.act({ type: letter === "y" || event.shiftKey ? "redo" : "undo" });
    return;
  }
  const leavesPath = event.key === "Escape" && session.decisions.start !== null && session.decisions.pathShown;
  if ((typing && !leavesPath) || event.altKey) return;
  if (TOOLS[letter] && (READING.has(TOOLS[letter]) ? session.answers || (TOOLS[letter] === "where" && session.locates) || (TOOLS[letter] === "pan" && session.editable) : session.editable)) chosen.tool(TOOLS[letter]);
  else if (LAYERS[letter]) chosen.layer(letter === "h" && session.quantity.interval ? "width" : LAYERS[letter]);
  else if (COMMANDS[event.key]) chosen.command(COMMANDS[event.key]);
  else if (letter === "r" && !session.recorded) session.act({ type: "run" });
  else if (leavesPath) session.decisions.forgetPath();
  else if (event.key === "Escape" && (session.running || session.working)) session.act({ type: "cancel" });
  else return;
  event.preventDefault();
}
