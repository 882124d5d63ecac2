// Edits that are on their way show at once: what the document will be when the session has applied them.

import type { Action, MapDocument, State, View } from "../protocol";

/** Messages whose effect the page shows before they are confirmed. */
export const FORESEEN = new Set<Action["type"]>(["walls", "move_sensor", "set", "view", "live"]);

/** Whether an action comes to nothing without a server: where it cannot be foreseen, and no reconnection brings it along. */
export const needsServer = ({ type }: Action) => !FORESEEN.has(type);
export const NO_SERVER = "Not while the connection is lost: this needs the server";

/** What an edit may change; walls are (nx, ny), one byte a cell. */
export type Foreseen = { document: MapDocument; walls: Uint8Array; view: View; state: State };

/** Applies an edit to what is shown. */
export function foresee(shown: Foreseen, edit: Action) {
  const { document, walls } = shown;
  const ny = document.grid.shape[1];
  if (edit.type === "walls") for (const [x, y] of edit.cells) walls[x * ny + y] = edit.wall ? 1 : 0;
  else if (edit.type === "set") {
    const { resolution, ...settings } = edit.patch; // another grid is the session's to make
    Object.assign(document, settings);
  }
  else if (edit.type === "live") shown.state = { ...shown.state, live: edit.on };
  else if (edit.type === "view") shown.view = { layer: edit.layer, chain: edit.chain ?? shown.view.chain, draw: edit.draw ?? null };
  else if (edit.type === "move_sensor") {
    const sensor = document.sensors.find((candidate) => candidate.id === edit.id);
    if (sensor) for (const axis of ["x", "y", "yaw"] as const) sensor[axis] = edit[axis] ?? sensor[axis];
  }
}
