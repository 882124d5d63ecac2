// The hand on the ghost: it comes to where the pointer is, or turns by its handle.

import { placeOf } from "../layers/sensors";
import type { Viewport } from "../layers/viewport";
import type { Grid, Point } from "../protocol";
import type { Ghost } from "../state/ghost";

export type GhostGesture = { kind: "ghost"; turn: boolean; grip: Point };

/** Takes hold of the ghost at a point of the canvas; what is far from it brings it there. `reach` is in CSS pixels. */
export function takeGhost(ghost: Ghost, point: Point, reach: number, grid: Grid, view: Viewport): GhostGesture {
  const near = (other: Point) => Math.hypot(point.x - other.x, point.y - other.y);
  const place = ghost.pose && placeOf({ id: 0, ...ghost.pose }, grid, view);
  if (place && near(place.handle) < Math.min(reach, near(place.point))) return { kind: "ghost", turn: true, grip: { x: 0, y: 0 } };
  const on = place && near(place.point) < Math.max(reach, place.size);
  return { kind: "ghost", turn: false, grip: on ? { x: place.point.x - point.x, y: place.point.y - point.y } : { x: 0, y: 0 } };
}

/** Follows the pointer, which is at a place in metres; the grip is taken into account already. */
export function dragGhost(ghost: Ghost, gesture: GhostGesture, world: Point) {
  if (!gesture.turn) ghost.move(world, true);
  else if (ghost.pose) ghost.move({ yaw: Math.atan2(world.y - ghost.pose.y, world.x - ghost.pose.x) }, true);
}
