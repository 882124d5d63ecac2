// What beams say of a cell: together of the one under the pointer, each by itself of the one that was clicked.

import { inside } from "../geometry/cells";
import type { Buffers, CellFacts, Point } from "../protocol";
import type { Asker } from "./asker";

/** The beams that say most, strongest first: from where to where (M, 2), metres, their nats, their numbers. */
export type Spoken = { start: Float64Array; end: Float64Array; nats: Float64Array; scan: Float64Array; beam: Float64Array; trace?: Uint8Array };

export class Evidence {
  /** Of the cell that was asked about last. */
  facts: CellFacts | null = null;
  /** The cell that was clicked, what all beams say of it, and what each does. */
  cell: Point | null = null;
  together: CellFacts | null = null;
  each: Spoken | null = null;
  /** Counts what there is to paint anew. */
  version = 0;
  /** Whether it is shown. */
  held = false;
  private asked = "";

  /** Whether the beams of a cell are on the map. */
  get cellShown() {
    return this.held && this.cell !== null;
  }

  constructor(private readonly session: Asker) {}

  hold(on: boolean) {
    if (this.held === on) return;
    this.held = on;
    this.version++;
    this.ask();
  }

  /** Asks about another cell; outside the map about none. */
  pin(cell: Point) {
    this.cell = inside(cell, this.session.shape) ? cell : null;
    this.together = this.each = null;
    this.asked = "";
    this.version++;
    this.ask();
    this.session.changed();
  }

  forget() {
    this.cell = this.together = this.each = this.facts = null;
    this.version++;
  }

  /** Asks where the cell or the picture is another than at the last time: once while chains run, and at their end. */
  ask() {
    const { session, cell } = this;
    const { shown } = session;
    if (!this.held || !cell || !shown || shown.generation !== session.generation || !session.answers) return;
    const { chain, draw } = shown;
    const given = shown.layer === "draw" && chain !== null && draw !== null && session.draws.count ? { chain, draw } : {};
    const question = `${shown.generation} ${session.sampling} ${shown.approximate} ${cell.x} ${cell.y} ${JSON.stringify(given)}`;
    if (question === this.asked) return;
    this.asked = question;
    session.act({ type: "inspect", x: cell.x, y: cell.y, each: true, ...given });
  }

  receive(facts: CellFacts, buffers: Buffers) {
    this.facts = facts;
    if (!facts.each || facts.x !== this.cell?.x || facts.y !== this.cell?.y) return;
    this.together = this.facts;
    this.each = buffers.nats ? (buffers as unknown as Spoken) : null;
    this.version++;
  }
}
