// What is asked of the posterior, and its answers: a path between two points, and where to look next.

import type { SafePath, Undecided, Views as Spacing } from "../messages";
import type { Buffers, Point } from "../protocol";
import type { Asker } from "./asker";
import { sentence } from "./status";

/** Poses (n, 3) and the nats that one more scan from each is expected to tell. */
export type Views = { pose: Float32Array; nats: Float32Array; spacing: number };

/** What the library says, without the name of its command. */
const said = (text: string) => sentence(`${text.replace(/^(plan|path|explore): /, "")}.`);

export class Decisions {
  start: Point | null = null;
  goal: Point | null = null;
  radius = 0.25;
  risk = 0.01;
  path: SafePath | null = null;
  views: Views | null = null;
  /** Why there is no path, and no map of where to look next. */
  trouble = "";
  viewTrouble = "";
  /** Counts what there is to paint anew. */
  version = 0;
  /** Whether the path is on the map: it goes while another tool answers. */
  pathShown = true;
  /** Whether the map of where to look next is wanted. */
  looking = false;
  private askedPath = "";
  private askedViews = "";

  constructor(private readonly session: Asker) {}

  /** The first point of a path, then the second, then the first of another. */
  point(place: Point) {
    if (this.start && !this.goal) this.goal = place;
    else [this.start, this.goal] = [place, null];
    this.path = null;
    this.trouble = "";
    this.version++;
    this.ask();
    this.session.changed();
  }

  set(change: { radius?: number; risk?: number }) {
    Object.assign(this, change);
    this.ask();
  }

  showPath(on: boolean) {
    if (this.pathShown !== on) this.version++;
    this.pathShown = on;
  }

  look(on: boolean) {
    if (this.looking === on) return;
    this.looking = on;
    this.viewTrouble = "";
    if (!on) [this.views, this.askedViews] = [null, ""];
    this.version++;
    this.ask();
    this.session.changed();
  }

  forget() {
    this.forgetPath();
    this.views = null;
    this.askedViews = "";
  }

  forgetPath() {
    this.start = this.goal = this.path = null;
    this.askedPath = this.trouble = "";
    this.version++;
    this.session.changed();
  }

  /** Asks where the question or the picture is another than at the last time: once while chains run, and at their end. */
  ask() {
    const { session, start, goal, radius, risk } = this;
    const { shown } = session;
    if (!shown || shown.generation !== session.generation || !session.answers) return;
    const picture = `${shown.generation} ${session.sampling}`;
    const question = `${picture} ${JSON.stringify([start, goal, radius, risk])}`;
    if (start && goal && !shown.approximate && question !== this.askedPath) {
      this.askedPath = question;
      session.act({ type: "path", start: [start.x, start.y], goal: [goal.x, goal.y], radius, risk });
    }
    if (this.looking && (!shown.approximate || session.document?.method === "propagate") && picture !== this.askedViews) {
      this.askedViews = picture;
      session.act({ type: "views" });
    }
  }

  receive(notice: SafePath | Spacing | Undecided, buffers: Buffers) {
    const text = notice.type === "undecided" ? said(notice.text) : "";
    const question = notice.type === "undecided" ? notice.question : notice.type;
    if (question === "views") {
      this.viewTrouble = text;
      this.views = null; // of the picture before
    } else this.trouble = text;
    if (notice.type === "path") this.path = notice;
    else if (notice.type === "views" && this.looking) {
      this.views = { pose: buffers.pose as Float32Array, nats: buffers.nats as Float32Array, spacing: notice.spacing };
    } else if (question === "path") this.path = null;
    this.version++;
  }

  /** Number of the view that is nearest to a place, or null. */
  nearest(place: Point): number | null {
    const { views } = this;
    if (!views?.nats.length) return null;
    let [best, least] = [0, Infinity];
    for (let i = 0; i < views.nats.length; i++) {
      const away = Math.hypot(views.pose[3 * i] - place.x, views.pose[3 * i + 1] - place.y);
      if (away < least) [best, least] = [i, away];
    }
    return best;
  }
}
