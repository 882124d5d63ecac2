// A story: steps that are told beside the map. Each is a state that can be linked to, `#step=3`.

import type { Story } from "../messages";
import type { Asker } from "./asker";
import type { MapDocument, State, View } from "../protocol";

/** The step that an address links to, from 0, or null. */
export function linkedStep(fragment: string): number | null {
  const match = /^#step=(\d+)$/.exec(fragment);
  return match && Math.max(0, Number(match[1]) - 1);
}
export const stepFragment = (at: number) => `#step=${at + 1}`;

/** What of the session a story changes. */
type Told = Asker & { state: State | null; view: View; bring: (document: MapDocument) => void };

export class Telling {
  story: Story | null = null;
  /** The number of the step, from 0. */
  at = 0;
  /** Called when a step has been gone to. */
  onstep: (at: number) => void = () => {};

  constructor(private readonly session: Told) {}

  get step() {
    return this.story?.steps[this.at] ?? null;
  }
  get last() {
    return (this.story?.steps.length ?? 1) - 1;
  }

  /** Puts the page into the state of a step, the last one if there are fewer. */
  go(at: number) {
    this.at = Math.min(Math.max(at, 0), this.last);
    const { step } = this;
    if (!step) return;
    this.bring(step.document);
    if (this.session.view.layer !== step.layer) this.session.act({ type: "view", layer: step.layer });
    this.onstep(this.at);
    this.session.changed();
  }

  /** Does what the step asks for. */
  solve() {
    if (this.step?.solution) this.bring(this.step.solution);
  }

  private bring(document: MapDocument) {
    const { session } = this;
    if (session.state && !session.state.live) session.act({ type: "live", on: true });
    session.bring(document);
    if (session.answers && document.method === "importance") session.act({ type: "run" }); // a server weighs particles when asked to
  }
}
