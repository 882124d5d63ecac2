// The reading under the pointer, and how it compares with its prediction.

import type { ComparedBeam, Undecided } from "../messages";
import type { Point, Scan } from "../protocol";
import type { Asker } from "./asker";

const REST_MS = 120;
/** An answer that takes longer is being prepared: the first one after an installation is compiled. */
const SLOW_MS = 1000;

/** A beam of a file's scan: its number, where it starts and where its reading ends, metres. */
export type Picked = { scan: number; beam: number; from: Point; angle: number };

export class Reading {
  picked: Picked | null = null;
  found: ComparedBeam | null = null;
  trouble = "";
  /** Whether the answer is long in coming. */
  slow = false;
  /** Counts what there is to paint anew. */
  version = 0;
  private timer = 0;

  constructor(private readonly session: Asker) {}

  /** Follows the pointer, null where it has gone; `near_m` is how close to a reading it has to be. */
  point(place: Point | null, near_m: number) {
    const { session } = this;
    const isFile = session.document && session.document.source.kind !== "simulation" && !session.recorded;
    const picked = place && isFile && session.scan ? pick(session.scan, place, near_m, session.document?.max_range ?? Infinity) : null;
    if (picked?.beam === this.picked?.beam && picked?.scan === this.picked?.scan) return;
    this.picked = picked;
    this.found = null;
    this.trouble = "";
    this.slow = false;
    this.version++;
    clearTimeout(this.timer);
    if (picked) this.timer = window.setTimeout(() => this.ask(picked), REST_MS);
    session.changed();
  }

  private ask({ scan, beam }: Picked) {
    this.session.act({ type: "beam", scan, beam });
    this.timer = window.setTimeout(() => {
      this.slow = true;
      this.session.changed();
    }, SLOW_MS);
  }

  /** Another scan is on show. */
  forget() {
    if (!this.picked) return;
    clearTimeout(this.timer);
    this.picked = this.found = null;
    this.slow = false;
    this.version++;
  }

  receive(notice: ComparedBeam | Undecided) {
    if (notice.type === "undecided") this.trouble = notice.text;
    else if (notice.beam === this.picked?.beam && notice.scan === this.picked.scan) this.found = notice;
    this.version++;
  }
}

/** The beam whose reading, or for want of one whose line, passes nearest to a place. */
function pick({ index, pose, angles, ranges, hit }: Scan, place: Point, near_m: number, longest_m: number): Picked | null {
  if (index === null) return null;
  const from = { x: pose[0], y: pose[1] };
  let [best, least] = [-1, Infinity];
  for (let b = 0; b < angles.length; b++) {
    const [ux, uy] = [Math.cos(pose[2] + angles[b]), Math.sin(pose[2] + angles[b])];
    const [dx, dy] = [place.x - from.x, place.y - from.y];
    const along = dx * ux + dy * uy;
    const range = hit[b] ? ranges[b] : longest_m;
    const atEnd = hit[b] ? Math.hypot(dx - range * ux, dy - range * uy) : Infinity;
    const beside = along > 0 && along < range ? Math.abs(dx * uy - dy * ux) : Infinity;
    // a reading is meant rather than a line, which passes by everywhere
    const away = Math.min(atEnd, near_m / 2 + 2 * beside);
    if (away < least) [best, least] = [b, away];
  }
  return least < near_m ? { scan: index, beam: best, from, angle: pose[2] + angles[best] } : null;
}
