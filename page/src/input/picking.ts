// A place on the map is chosen, by a click or by the keyboard: a point of a path, where to look from next, a cell.

import { toCells } from "../geometry/cells";
import type { Point } from "../protocol";
import type { Session } from "../state/session";
import type { Editor } from "./editor";
import type { Hand, Tool } from "./hand";

/** Tools that a click gives a place. */
export const PICKING = new Set<Tool>(["path", "look", "evidence"]);

/** Takes a place in metres: the start or the goal of a path, a cell to ask about, else the view that is nearest to it. */
export function pick(session: Session, hand: Hand, editor: Editor, place: Point) {
  if (hand.tool === "path") return session.decisions.point(place);
  if (hand.tool === "evidence" && session.document) {
    const { x, y } = toCells(place, session.document.grid);
    return session.evidence.pin({ x: Math.floor(x), y: Math.floor(y) });
  }
  const found = session.decisions.nearest(place);
  const { views } = session.decisions;
  if (found === null || !views) return;
  const [x, y, yaw] = views.pose.subarray(3 * found, 3 * found + 3);
  const nats = `${views.nats[found].toFixed(1)} nats`;
  if (session.editable) editor.addSensor({ world: { x, y }, yaw });
  else session.say(`A scan from ${x.toFixed(2)}, ${y.toFixed(2)} m would tell ${nats}`);
}
