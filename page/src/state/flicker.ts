// Draws over the mean, one after the other: each is a map that the scans leave possible.

import type { Field } from "../protocol";
import type { Asker } from "./asker";

const REDUCED = "(prefers-reduced-motion: reduce)";

export class Flicker {
  /** Whether draws are shown over the mean, and not in its place. */
  on = false;
  /** The last mean of the present picture. */
  private mean: Field | null = null;

  constructor(private readonly session: Asker) {}

  /** Whether who looks wants nothing to move by itself. */
  get still() {
    return matchMedia(REDUCED).matches;
  }

  /** The mean under the draw on show, or null where draws stand alone. */
  get under(): Field | null {
    const { mean, session } = this;
    const { shown } = session;
    return this.on && mean && shown?.layer === "draw" && mean.generation === shown.generation && mean.p.length === shown.p.length ? mean : null;
  }

  /** Whether the mean has to be fetched before a draw can be shown over it. */
  get wantsMean() {
    return this.on && this.mean?.generation !== this.session.generation;
  }

  /** A field is on show. */
  take(field: Field) {
    if (field.layer !== "draw" && field.layer !== "width") this.mean = field;
  }
}
