// How far the chain on show is, and when it will be done.

import type { Field } from "../protocol";

export class Progress {
  private generation = -1;
  private last = 0;
  private from = { sweeps: 0, time: 0 };

  /** A field has come. */
  hear(field: Field) {
    if (field.approximate || field.sweeps <= 0) return;
    if (this.generation !== field.generation || field.sweeps < this.last) {
      this.generation = field.generation;
      this.from = { sweeps: field.sweeps, time: performance.now() };
    }
    this.last = field.sweeps;
  }

  /** Seconds until the chain of a field is done, or null where nothing can be said. */
  remaining_s(field: Field): number | null {
    const done = field.sweeps - this.from.sweeps;
    return done > 0 ? ((field.total - field.sweeps) * (performance.now() - this.from.time)) / done / 1000 : null;
  }
}
