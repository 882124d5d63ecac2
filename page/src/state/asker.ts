// What an answer about the posterior needs of the session: what is on show, and a way to ask.

import type { Action, DrawCount, Field, MapDocument, Pair, Scan } from "../protocol";

export interface Asker {
  readonly document: MapDocument | null;
  readonly shape: Pair;
  /** (nx, ny), one byte a cell, as drawn; `wallsVersion` counts its changes. */
  readonly walls: Uint8Array;
  readonly wallsVersion: number;
  /** The field on the canvas. */
  readonly shown: Field | null;
  readonly scan: Scan | null;
  /** The newest generation that was seen. */
  readonly generation: number;
  readonly draws: DrawCount;
  /** Whether there is a chain on show, and it goes on. */
  readonly sampling: boolean;
  /** Whether the map is a drawn one, whose walls and sensors can be edited. */
  readonly editable: boolean;
  /** Whether the page plays a recording. */
  readonly recorded: boolean;
  /** Whether there is a server that answers questions about the posterior. */
  readonly answers: boolean;
  /** Whether scans are located: by a server, or in the page. */
  readonly locates: boolean;
  readonly worker: string;
  act(action: Action): void;
  /** Is called after every change of what is shown. */
  readonly changed: () => void;
}
