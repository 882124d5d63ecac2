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

/** A stretch of a text, and where it names a control the index of the name, else null. */
export type Stretch = { text: string; at: number | null };

/** The stretches of a text, cut at the names in it: whole words, and the longest name where several fit. */
export function namedIn(text: string, names: string[]): Stretch[] {
  const known = new Map<string, number>();
  names.forEach((name, at) => {
    const word = name.replace(/ \([^)]*\)$/, ""); // "Noise" is Noise (m)
    if (!known.has(word)) known.set(word, at);
  });
  const words = [...known.keys()].sort((a, b) => b.length - a.length).map((word) => word.replace(/[^\w ]/g, "\\$&"));
  const parts = words.length ? text.split(new RegExp(`\\b(${words.join("|")})(?!\\w)`)) : [text];
  return parts.map((part, i) => ({ text: part, at: i % 2 ? (known.get(part) ?? null) : null })).filter((part) => part.text);
}

/** What of the session a story changes. */
type Told = Asker & { state: State | null; view: View; acted: number; working: boolean; bring: (document: MapDocument) => void };

export class Telling {
  story: Story | null = null;
  /** The number of the step, from 0. */
  at = 0;
  /** Counts how often a step began. */
  begins = 0;
  /** Called when a step has been gone to. */
  onstep: (at: number) => void = () => {};

  constructor(private readonly session: Told) {}

  /** Whether the step's picture is there, so that the panel will not change by itself. */
  get settled() {
    const { state, acted, working, shown } = this.session;
    return Boolean(shown && state && state.seq >= acted && !working);
  }

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
    this.begins++;
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
