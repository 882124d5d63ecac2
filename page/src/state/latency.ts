// How long pointer events wait for the first picture that contains them.

/** Events are matched with generations by the numbers of the messages that they sent. */
export class Latency {
  /** Milliseconds from an event to its picture, in order. */
  readonly eventToPaint_ms: number[] = [];
  private waiting: { seq: number; time: number }[] = [];
  private readonly seqOfGeneration = new Map<number, number>();

  sent(seq: number, event: Event) {
    this.waiting.push({ seq, time: event.timeStamp });
  }

  /** A message was refused: it has no picture. */
  refused(seq: number) {
    this.waiting = this.waiting.filter((event) => event.seq !== seq);
  }

  /** A generation holds all messages up to one. */
  confirmed(generation: number, seq: number) {
    this.seqOfGeneration.set(generation, seq);
  }

  painted(generation: number) {
    const seq = this.seqOfGeneration.get(generation);
    if (seq === undefined) return;
    const now = performance.now();
    for (const event of this.waiting) if (event.seq <= seq) this.eventToPaint_ms.push(now - event.time);
    this.waiting = this.waiting.filter((event) => event.seq > seq);
    for (const older of this.seqOfGeneration.keys()) if (older < generation) this.seqOfGeneration.delete(older);
  }

  /** The connection is new, and so are its generations. */
  forget() {
    this.waiting = [];
    this.seqOfGeneration.clear();
  }
}
