// A result that is kept beside the one on show, under the same controls of layers and draws.

import { RECORDING, type Buffers, type DrawCount, type Recording } from "../protocol";
import { recordedTransport } from "../transport/recorded";
import { Session } from "./session";

export class Beside {
  /** The session that plays the kept result, or null. */
  kept: Session | null = null;
  private draws: DrawCount & { kept: number } = { chains: 0, count: 0, kept: 0 };

  constructor(private readonly main: Session) {}

  /** Keeps the result on show: the server's, or the page's own. */
  keep() {
    const { transport } = this.main;
    if (!transport.record) return this.main.act({ type: "export", what: RECORDING });
    const recording = transport.record();
    if (recording) this.receive(recording);
    this.main.changed();
  }

  forget() {
    this.kept = null;
    this.main.changed();
  }

  /** The result to keep has come. */
  receive(recording: [Recording, Buffers]) {
    this.draws = recording[0].draws;
    const transport = recordedTransport(recording);
    this.kept = new Session(transport, this.main.changed);
    transport.open();
  }

  /** Shows the layer, the chain and the draw of the main result. Not all draws are kept of a long run: the nearest is shown. */
  follow() {
    const { kept, main, draws } = this;
    if (!kept) return;
    const { layer, chain: asked } = main.view;
    const chain = Math.max(0, Math.min(asked, draws.chains - 1));
    const draw = layer === "draw" && draws.count ? Math.round((main.draw * (draws.count - 1)) / Math.max(1, draws.kept - 1)) : null;
    const { view } = kept;
    if (layer !== view.layer || chain !== view.chain || draw !== view.draw) kept.act({ type: "view", layer, chain, draw });
    kept.take();
  }

  /** What tells the two results apart, in words: of the one on show, and of the kept one. */
  differences(): [string, string] {
    const now = this.main.shown?.about ?? [];
    const then = this.kept?.shown?.about ?? [];
    const apart = (rows: [string, string][], others: [string, string][]) =>
      rows.filter(([name, words]) => !others.some(([other, same]) => other === name && same === words)).map(([name, words]) => `${name.toLowerCase()} ${words}`).join("; ");
    return [apart(now, then), apart(then, now)].map((words) => words || "the same model and method") as [string, string];
  }
}
