// A robot that is not there: where the hand has put it, and what its laser would read.

import { cellOf, inside } from "../geometry/cells";
import type { VirtualScan, NearestScan, Undecided } from "../messages";
import type { Buffers } from "../protocol";
import type { Asker } from "./asker";

/** Metres and radians, world frame. */
export type Pose = { x: number; y: number; yaw: number };
/** The scan that was taken nearest, and what it read. */
export type NearScan = NearestScan & { pose: Float64Array; ranges: Float32Array; hit: Uint8Array };
/** Predictive median and central 80 % interval of each beam, metres; no return is infinite. */
export type Fan = Omit<VirtualScan, "type" | "near"> & {
  angles: Float32Array;
  low: Float32Array;
  median: Float32Array;
  high: Float32Array;
  near: NearScan | null;
};

/** An answer that takes longer will not come: the worker was started again. */
const PATIENCE_MS = 2000;
/** While chains run the fan is asked for again after this. */
const AGAIN_MS = 3000;

/** Questions under way at a time: while one is answered the next is on its way. */
const MOST_ASKED = 2;

/** Few questions are under way at a time, and the next one asks for where the ghost is then: a fast hand waits for nothing. */
export class Ghost {
  /** Whether the hand holds it. */
  held = false;
  pose: Pose | null = null;
  fan: Fan | null = null;
  /** Why there is no fan. */
  trouble = "";
  /** Counts what there is to paint anew. */
  version = 0;
  /** How many fans came. */
  answers = 0;
  /** Whether the hand moves it: meanwhile a few draws do. */
  private moving = false;
  private askedAt = -Infinity;
  /** Questions under way. */
  private waiting = 0;
  private asked = "";

  constructor(private readonly session: Asker) {}

  /** Takes it up. */
  hold(on: boolean) {
    if (this.held === on) return;
    this.held = on;
    this.version++;
    this.ask();
    this.session.changed();
  }

  /** Brings it to another place; `moving` is a hand that has not let go. */
  move(change: Partial<Pose>, moving = false) {
    const { pose } = this;
    this.moving = moving;
    this.pose = { x: 0, y: 0, yaw: 0, ...pose, ...change };
    this.version++;
    this.ask();
    this.session.changed();
  }

  /** The hand has let go. */
  rest() {
    if (!this.moving) return;
    this.moving = false;
    this.ask();
  }

  /** The map has another size: where the ghost stood may be no part of it. */
  refit() {
    const { pose, session } = this;
    const at = pose && session.document && cellOf(pose, session.document.grid);
    if (!at || !inside(at, session.shape)) this.pose = null;
    this.fan = null;
    this.asked = this.trouble = "";
    this.version++;
  }

  /** Asks where place or picture is another than at the last time. */
  ask() {
    const { session } = this;
    const { shown, scan } = session;
    if (!this.held || !session.answers || !shown || shown.generation !== session.generation) return;
    // at first it stands where the scan on show was taken
    if (!this.pose && scan?.pose.length) this.pose = { x: scan.pose[0], y: scan.pose[1], yaw: scan.pose[2] };
    const { pose } = this;
    if (!pose) return;
    const now = performance.now();
    if (now - this.askedAt > PATIENCE_MS) this.waiting = 0;
    if (this.waiting >= MOST_ASKED) return;
    const question = JSON.stringify([pose, this.moving, shown.generation, session.sampling, shown.approximate]);
    const old = session.sampling && now - this.askedAt > AGAIN_MS;
    if (question === this.asked && !old) return;
    [this.asked, this.askedAt] = [question, now];
    this.waiting++;
    session.act({ type: "ghost", ...pose, coarse: this.moving });
  }

  receive(notice: VirtualScan | Undecided, buffers: Buffers) {
    this.waiting = Math.max(0, this.waiting - 1);
    this.trouble = notice.type === "undecided" ? notice.text : "";
    if (notice.type === "ghost") {
      const { angles, low, median, high, near_pose, near_ranges, near_hit } = buffers as any;
      const { x, y, yaw, generation, draws, coarse, milliseconds } = notice;
      const near = notice.near && { ...notice.near, pose: near_pose, ranges: near_ranges, hit: near_hit };
      this.fan = { x, y, yaw, generation, draws, coarse, milliseconds, angles, low, median, high, near };
      this.answers++;
    } else this.fan = null;
    this.version++;
    this.ask();
  }
}
