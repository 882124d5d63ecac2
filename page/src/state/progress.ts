// How far the chain on show is, and when it will be done.

import type { Field } from "../protocol";

export class Progress {
  /** [sweep, log joint] of the frames of one generation. */
  joint: [number, number][] = [];
  private generation = -1;
  private last = 0;
  private from = { sweeps: 0, time: 0 };

  /** A field has come. */
  hear(field: Field) {
    if (field.approximate || field.sweeps <= 0) return;
    if (this.generation !== field.generation || field.sweeps < this.last) {
      this.generation = field.generation;
      this.from = { sweeps: field.sweeps, time: performance.now() };
      this.joint = [];
    }
    this.last = field.sweeps;
    if (field.log_joint != null && this.joint.at(-1)?.[0] !== field.sweeps) this.joint.push([field.sweeps, field.log_joint]);
  }

  /** Seconds until the chain of a field is done, or null where nothing can be said. */
  remaining_s(field: Field): number | null {
    const done = field.sweeps - this.from.sweeps;
    return done > 0 ? ((field.total - field.sweeps) * (performance.now() - this.from.time)) / done / 1000 : null;
  }
}
