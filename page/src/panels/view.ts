// Which field is shown, the draws one by one, the marks, and the scans of a file.

import { strokesShowAt } from "../layers/overlay";
import type { Layer } from "../protocol";
import type { Session } from "../state/session";
import { focused, h, mark, put } from "./dom";
import { icon } from "./icons";
import type { Ui } from "./ui";

const LAYERS = [
  ["mean", "Mean"],
  ["draw", "One draw"],
  ["entropy", "Entropy"],
  ["width", "Width"],
] as const;
const NO_DRAWS = "There are no draws yet: chains keep them";
const ONE_CHAIN = "There is one chain";
const STILL = "This device asks that nothing moves by itself";
/** Draws a second. */
const SPEEDS: Record<string, string> = { "2": "2 / s", "10": "10 / s", "30": "30 / s", "1000": "fastest" };

/** Shows draws one after another, until the last; the next is asked for when one has been painted. */
export class Player {
  playing = false;
  drawsPerSecond = 10;
  /** Whether a draw is to follow the mean that was asked for. */
  private afterMean = false;
  /** What was shown before draws were laid over the mean, unless something else was chosen since. */
  private before: Layer | null = null;

  constructor(private readonly session: Session) {}

  showLayer(layer: Layer) {
    if (layer !== "draw") this.play(false);
    else if (!this.session.hasDraws) return;
    this.before = null;
    this.session.act({ type: "view", layer, chain: this.session.view.chain });
  }

  showDraw(draw: number, chain = this.session.view.chain) {
    this.session.act({ type: "view", layer: "draw", chain, draw });
  }

  /** Draws one after another; the next one alone for who wants nothing to move by itself. */
  play(on: boolean) {
    const { draw, draws, flicker, shown } = this.session;
    this.playing = on && !flicker.still;
    if (on && flicker.wantsMean) this.session.act({ type: "view", layer: "mean", chain: this.session.view.chain });
    else if (on) this.showDraw(flicker.still && shown?.layer === "draw" ? (draw + 1) % draws.count : draw >= draws.count - 1 ? 0 : draw);
    this.session.changed();
  }

  /** Draws over the mean; without them what was shown before is shown again. */
  over(on: boolean) {
    const { flicker, view } = this.session;
    flicker.on = on;
    if (!on) {
      this.afterMean = false;
      if (this.before && this.before !== view.layer) this.showLayer(this.before);
    } else if (flicker.wantsMean) {
      this.afterMean = true;
      this.session.act({ type: "view", layer: "mean", chain: view.chain });
    } else if (view.layer !== "draw") this.showLayer("draw");
    this.before = on ? view.layer : null;
    this.session.changed();
  }

  /** Plays the first sweeps of a chain, from the first draw on. */
  playFromStart() {
    this.showDraw(0);
    this.playing = true;
    this.session.changed();
  }

  /** Called after a picture is painted. */
  step() {
    const { shown, flicker } = this.session;
    if (flicker.on && (this.afterMean || this.playing) && shown?.layer === "mean" && !flicker.wantsMean) {
      this.afterMean = false;
      return this.showDraw(this.session.draw);
    }
    if (!this.playing || shown?.layer !== "draw") return;
    setTimeout(() => {
      if (!this.playing) return;
      const { draw, draws } = this.session;
      if (draw + 1 >= draws.count && flicker.on) this.showDraw(0); // hypotheses have no end
      else if (draw + 1 >= draws.count) this.play(false);
      else this.showDraw(draw + 1);
    }, 1000 / this.drawsPerSecond);
  }
}

/** Marks that can be switched off. */
export type Shown = { truth: boolean; rays: boolean; readings: boolean; strokes: boolean; trajectory: boolean };

export function viewPanel(ui: Ui, player: Player, shown: Shown, scale: () => number) {
  const { session } = ui;
  const current = () => (session.view.layer === "draw" && !session.hasDraws ? "mean" : session.view.layer);
  const layers = ui.segmented<Layer>("Show", LAYERS, current, (layer) => player.showLayer(layer));
  // walls have no interval, and the entropy of a reflectivity is none of the map's
  const [, draw, entropy, width] = Array.from(layers.children) as HTMLElement[];
  put(width, "title", "Width of each cell's 90 % interval");
  ui.visible(entropy, () => !session.quantity.interval);
  ui.visible(width, () => session.quantity.interval && !session.lacks.includes("width"));
  ui.visible(draw, () => session.hasDraws);
  const box = (label: string, name: keyof Shown) =>
    ui.checkbox(label, () => shown[name], (on) => {
      shown[name] = on;
      session.changed();
    });
  const truth = box("True walls", "truth");
  ui.visible(truth, () => !session.document || session.document.source.kind === "simulation");
  const [strokes, trajectory] = [box("Surfaces", "strokes"), box("Trajectory", "trajectory")];
  ui.visible(strokes, () => Boolean(session.overlay?.strokes.length));
  ui.each(() => put(strokes.lastElementChild as HTMLElement, "textContent", strokesShowAt(scale()) ? "Surfaces" : "Surfaces (zoom in)"));
  ui.visible(trajectory, () => Boolean(session.overlay?.trajectory.length));
  const marks = h("div", { className: "checks", role: "group", "aria-label": "Marks" }, truth, box("Rays", "rays"), box("Readings", "readings"), strokes, trajectory);
  return ui.section("View", layers, playerControls(ui, player), marks);
}

function playerControls(ui: Ui, player: Player) {
  const { session } = ui;
  const slider = h("input", { type: "range", min: 0, step: 1, "aria-label": "Draw number" });
  slider.addEventListener("input", () => {
    player.play(false);
    player.showDraw(Number(slider.value));
  });
  const play = ui.button("play", "Play the draws", () => player.play(!player.playing), { when: () => session.draws.count > 1, why: NO_DRAWS });
  const count = h("output");
  const chain = h("select", { "aria-label": "Chain" });
  chain.addEventListener("change", () => player.showDraw(session.draw, Number(chain.value)));
  ui.each(() => {
    const { chains, count: n } = session.draws;
    put(slider, "max", String(Math.max(0, n - 1)));
    put(slider, "disabled", n === 0);
    put(slider, "title", n ? "" : NO_DRAWS);
    put(slider, "value", String(session.draw));
    const text = n ? `${session.draw + 1} of ${n}` : "none kept";
    mark(slider, "aria-valuetext", text);
    slider.style.setProperty("--fill", `${n > 1 ? (100 * session.draw) / (n - 1) : 0}%`);
    put(count, "textContent", text);
    if (chain.length !== Math.max(1, chains)) {
      chain.replaceChildren(...Array.from({ length: Math.max(1, chains) }, (_, c) => h("option", { value: String(c), textContent: `chain ${c + 1}` })));
    }
    put(chain, "value", String(session.view.chain));
    put(chain, "disabled", chains < 2);
    put(chain, "title", chains > 1 ? "" : n ? ONE_CHAIN : NO_DRAWS);
    if (n < 2 && player.playing) player.play(false);
    const label = session.flicker.still ? "Next draw" : player.playing ? "Pause the draws" : "Play the draws";
    if (play.getAttribute("aria-label") === label) return;
    play.setAttribute("aria-label", label);
    play.replaceChildren(icon(player.playing ? "pause" : "play"));
  });
  const speed = h("select", { "aria-label": "Speed" });
  for (const [value, text] of Object.entries(SPEEDS)) speed.append(h("option", { value, textContent: text }));
  speed.value = String(player.drawsPerSecond);
  speed.addEventListener("change", () => (player.drawsPerSecond = Number(speed.value)));
  const first = ui.button(null, "From the first sweep", () => player.playFromStart(), { text: "From the first", when: () => session.draws.count > 1, why: NO_DRAWS });
  ui.each(() => {
    put(speed, "disabled", session.draws.count < 2 || session.flicker.still);
    put(speed, "title", session.draws.count < 2 ? NO_DRAWS : session.flicker.still ? STILL : "");
  });
  const over = ui.checkbox("Draws over the mean", () => session.flicker.on, (on) => player.over(on), "Each draw in its own colour over the mean, as one of the maps that the scans leave possible");
  ui.visible(over, () => session.draws.count > 1);
  const more = h("div", { className: "wide" }, over);
  const controls = h("div", { className: "player" }, play, slider, count, h("div", { className: "buttons wide" }, chain, speed, first), more);
  ui.visible(controls, () => session.hasDraws);
  return controls;
}

export function scanPanel(ui: Ui) {
  const { session } = ui;
  const slider = h("input", { type: "range", min: 0, step: 1, "aria-label": "Scan number" });
  const count = h("output");
  slider.addEventListener("input", () => session.act({ type: "scan", index: Number(slider.value) }));
  const section = ui.section("Scan", h("div", { className: "player bare" }, slider, count));
  ui.each(() => {
    const scans = session.document?.source.kind === "simulation" ? 0 : (session.document?.source.scans ?? 0);
    put(section, "hidden", scans < 2);
    put(slider, "max", String(Math.max(0, scans - 1)));
    if (!focused(slider)) put(slider, "value", String(session.scan?.index ?? 0));
    slider.style.setProperty("--fill", `${(100 * Number(slider.value)) / Math.max(1, scans - 1)}%`);
    put(count, "textContent", `${Number(slider.value) + 1} / ${scans}`);
  });
  return section;
}
