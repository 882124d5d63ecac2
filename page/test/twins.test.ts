// An exported page says what the live page says: every number, over kinds of cells and sources.

import { page } from "./dom";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fromBase64 } from "../src/geometry/bits";
import { Editor } from "../src/input/editor";
import { Hand } from "../src/input/hand";
import { legend } from "../src/panels/legend";
import { logPanel } from "../src/panels/log";
import { chip, foot } from "../src/panels/notice";
import { posteriorPanel } from "../src/panels/posterior";
import { Ui } from "../src/panels/ui";
import { Player, scanPanel, viewPanel } from "../src/panels/view";
import { THEMES } from "../src/colour";
import type { Action, Buffers, DrawCount, MapDocument, Notice, Transport, View } from "../src/protocol";
import { Session } from "../src/state/session";
import { unpackFrame } from "../src/transport/frame";
import { readRecording, recordedTransport } from "../src/transport/recorded";
import type { Element } from "./dom";
import { LIMITS } from "./desk";

type Said = { text?: string; frame?: string };
type Twin = { name: string; html: string; first: Said[]; steps: (Said & { action: Action })[] };
const file = process.env.BAYESMAP_LIBRARY;
const twins: Twin[] = file ? JSON.parse(readFileSync(file, "utf8")).twins : [];

/** A page and what stands on it. */
class Page {
  readonly session: Session;
  private readonly hand: Hand;
  private readonly ui: Ui;
  private readonly parts: { [name: string]: Element };

  constructor(transport: Transport) {
    this.session = new Session(transport, () => {});
    this.hand = new Hand(this.session);
    const player = new Player(this.session);
    this.ui = new Ui(this.session, this.hand, new Editor(this.session, this.hand), () => {}, () => {}, false);
    const marks = { truth: true, rays: true, readings: true, strokes: true, trajectory: true };
    const all = {
      chip: chip(this.ui), posterior: posteriorPanel(this.ui), view: viewPanel(this.ui, player, marks, () => 9), scan: scanPanel(this.ui),
      caption: legend(this.ui, () => THEMES.light, () => 9).children[0], legend: legend(this.ui, () => THEMES.light, () => 9).children[1], readout: foot(this.ui).readout, log: logPanel(this.ui),
    };
    this.parts = all as unknown as { [name: string]: Element };
    page.activeElement = null;
    transport.open();
  }

  /** What is read in each part, and the numbers behind the picture. */
  seen(action: Action) {
    const cell = action.type === "inspect" ? { x: action.x, y: action.y } : null;
    this.hand.hover = cell;
    this.session.take();
    this.ui.refresh();
    const texts = Object.fromEntries(Object.entries(this.parts).map(([name, element]) => [name, element.innerText.replace(/\s+/g, " ").trim()]));
    const { p, reached, trace, traced, weights, layer, chain, draw, log_joint, ess, rhat, sweeps, total, verdict, method } = this.session.shown!;
    const { scan, overlay } = this.session;
    return { texts, picture: { p, reached, trace, traced, weights, layer, chain, draw, log_joint, ess, rhat, sweeps, total, verdict, method }, scan, overlay };
  }
}

/** A session that says what was heard. */
function live(document: MapDocument, draws: DrawCount, twin: Twin) {
  const transport: Transport = { onmessage: () => {}, onstatus: () => {}, open: () => {}, close: () => {}, send: () => {} };
  const says = ({ text, frame }: Said) => transport.onmessage(...(text ? [JSON.parse(text) as Notice, {} as Buffers] as const : unpackFrame(fromBase64(frame!).buffer as ArrayBuffer)));
  const shown = new Page(transport);
  let view: View = { layer: "mean", chain: 0, draw: null };
  const state = () =>
    transport.onmessage({ type: "state", document, generation: 1, seq: 0, can_undo: false, can_redo: false, live: false, running: false, working: false, draws, scan: 0, view }, {});
  transport.onmessage({ type: "welcome", version: 1, limits: LIMITS, recorded: false, figure: false, lacks: [], story: null }, {});
  state();
  transport.onmessage({ type: "worker", state: "ready" }, {});
  twin.first.forEach(says);
  return {
    seen(step: Twin["steps"][number]) {
      if (step.action.type === "view") {
        view = { layer: step.action.layer, chain: step.action.chain ?? 0, draw: step.action.draw ?? null };
        state();
      }
      says(step);
      return shown.seen(step.action);
    },
  };
}

test("an exported page has every number of the live page", async (context) => {
  if (!file) return context.skip("run by pytest, which makes the results");
  assert.equal(twins.length, 12);
  for (const twin of twins) {
    const found = await readRecording(/<script[^>]*data-recording[^>]*>(.*?)<\/script>/s.exec(readFileSync(twin.html, "utf8"))![1]);
    const transport = recordedTransport(found);
    const exported = new Page(transport);
    const { document, field } = found[0];
    const here = live(document, field.draws, twin);
    for (const step of twin.steps) {
      transport.send({ ...step.action, seq: 1 });
      const [was, is] = [here.seen(step), exported.seen(step.action)];
      const name = `${twin.name}: ${JSON.stringify(step.action)}`;
      const { readout, log, chip, posterior, ...texts } = was.texts;
      assert.deepEqual([is.picture, is.scan, is.overlay], [was.picture, was.scan, was.overlay], name);
      const { readout: read, log: none, chip: small, posterior: figures, ...others } = is.texts;
      assert(chip.startsWith(small), `${name}: ${small}; ${chip}`); // without what to do about it
      assert.deepEqual(others, texts, name);
      assert.equal(figures, posterior.replace(/^Posterior Run Cancel Live/, "Posterior").replace(/ reply –|; it is done, and Run has nothing to add/g, ""), name);
      assert(readout.startsWith(read) && (step.action.type !== "inspect" || /\d beams?|unobserved|less than half/.test(read)), `${name}: ${read}; ${readout}`);
      assert.equal(none, "", name); // an export is of the scans that it was made from
    }
  }
});
