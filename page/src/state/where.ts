// "Where am I?": the posterior of the pose of one scan, asked for again whenever the picture is another.

import type { Whereabouts } from "../messages";
import type { Buffers, Field } from "../protocol";
import type { Asker } from "./asker";

/** Where a scan may have been taken; its cloud (n, 3) and weights (n), the lightest first. */
export type Located = Whereabouts & { cloud: Float32Array; weight: Float32Array };

/** Less probable places are not worth words. */
const LEAST = 0.005;

export class Where {
  found: Located | null = null;
  /** Why there is no answer. */
  trouble = "";
  /** Counts what there is to paint anew. */
  version = 0;
  private wanted = false;
  private sensor: number | null = null;
  private known: Field | null = null;
  private knownVersion = -1;
  private asked = "";
  private waiting = false;

  constructor(private readonly session: Asker) {}

  /** Whether an answer is wanted, and of a drawn world for which sensor. */
  follow(wanted: boolean, sensor: number | null) {
    this.sensor = sensor;
    if (wanted !== this.wanted) {
      this.wanted = wanted;
      this.found = null;
      this.trouble = "";
      this.forget();
      this.version++;
      this.session.changed();
    }
    if (wanted) this.ask();
  }

  /** The known map in which a scan of a drawn world is located, the walls as they are drawn; null where there is none. */
  get map(): Field | null {
    const { shown, editable, walls, wallsVersion } = this.session;
    if (!this.wanted || !editable || !shown) return null;
    if (!this.known || this.knownVersion !== wallsVersion) {
      this.known = { ...shown, layer: "mean", p: walls.map((wall) => 255 * wall), reached: new Uint8Array(walls.length).fill(255) };
      this.knownVersion = wallsVersion;
    }
    return this.known;
  }

  /** Whether the answer on show is about the present place, and not the one before. */
  get current() {
    const { found, session, sensor } = this;
    return found?.picture === session.generation && (session.editable ? (sensor ?? found.sensor) === found.sensor : found.index === session.scan?.index);
  }

  /** Another worker does not answer what the last one was asked. */
  forget() {
    [this.asked, this.waiting] = ["", false];
  }

  receive(notice: Whereabouts, buffers: Buffers) {
    this.waiting = false;
    if (!this.wanted) return;
    this.trouble = notice.trouble;
    const { pose: cloud, weight } = buffers as { [name: string]: Float32Array };
    const modes = notice.modes.filter(({ probability }, i) => i === 0 || probability >= LEAST);
    this.found = this.trouble ? null : { ...notice, modes, cloud, weight };
    this.version++;
  }

  /** One question at a time: a hand that moves on is followed as fast as answers come. */
  private ask() {
    const { session } = this;
    const { shown, scan } = session;
    if (!shown || !session.locates || session.worker !== "ready") return;
    if (session.editable && shown.generation !== session.generation) return; // its picture comes first
    const draws = session.editable ? "" : `${session.draws.count} ${session.sampling}`;
    const question = `${session.generation} ${session.editable ? this.sensor : scan?.index} ${draws}`;
    if (question === this.asked || this.waiting) return;
    [this.asked, this.waiting] = [question, true];
    session.act(session.editable && this.sensor !== null ? { type: "where", sensor: this.sensor } : { type: "where" });
  }
}
