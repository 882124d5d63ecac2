// Puts the page into an element: makes its parts and ties them together.

import { DAMAGED, takeFragment, toFragment } from "./fragment";
import { openDropped, type Play } from "./input/dropped";
import { Editor } from "./input/editor";
import { Hand, READING } from "./input/hand";
import { MapKeys, pageKey } from "./input/keys";
import { Pointer } from "./input/pointer";
import { CursorLayer } from "./layers/cursor";
import { DecisionsLayer } from "./layers/decisions";
import { EvidenceLayer } from "./layers/evidence";
import { FieldLayer } from "./layers/field";
import { GhostLayer } from "./layers/ghost";
import { HypothesisLayer } from "./layers/hypothesis";
import { Stack, type Scene } from "./layers/layer";
import { MarksLayer } from "./layers/marks";
import { OverlayLayer } from "./layers/overlay";
import { picture, stillLayers } from "./layers/picture";
import { RaysLayer } from "./layers/rays";
import { ReadingLayer } from "./layers/reading";
import { GUTTER, Viewport } from "./layers/viewport";
import { WhereLayer } from "./layers/where";
import { bar } from "./panels/bar";
import { besideCaptions, keepControl } from "./panels/beside";
import { traceChart, weightChart } from "./panels/chart";
import { decisionsPanel } from "./panels/decisions";
import { helpDialog, newDialog, shareDialog } from "./panels/dialogs";
import { download, h, mark, put } from "./panels/dom";
import { evidencePanel } from "./panels/evidence";
import { ghostPanel } from "./panels/ghost";
import { head } from "./panels/head";
import { legend } from "./panels/legend";
import { logPanel } from "./panels/log";
import { banner, chip, foot } from "./panels/notice";
import { posesPanel } from "./panels/poses";
import { posteriorPanel } from "./panels/posterior";
import { readingPanel } from "./panels/reading";
import { storyPanel } from "./panels/story";
import { clearPanel, inferencePanel, modelPanel, sensorPanel } from "./panels/settings";
import { Ui } from "./panels/ui";
import { Player, scanPanel, viewPanel } from "./panels/view";
import { wherePanel } from "./panels/where";
import type { Export } from "./messages";
import { RECORDING, type MapDocument, type Transport } from "./protocol";
import { snapshot } from "./snapshot";
import { Beside } from "./state/beside";
import { Session } from "./state/session";
import type { Level } from "./state/status";
import { linkedStep, stepFragment } from "./state/story";
import CHARTS from "uplot/dist/uPlot.min.css";
import STYLE from "./style.css";
import { ThemeChoice } from "./theme";
import { unpackFrame } from "./transport/frame";

/** Pixels a cell from which on one cell is easily seen. */
const SEEN_FROM_SCALE = 12;

export type Options = {
  /** In a notebook. */
  embedded?: boolean;
  /** A document to adopt, of a share link or from before the connection was lost. */
  adopt?: MapDocument | null;
  /** What to say once it is connected. */
  notice?: { text: string; level: Level } | null;
  /** Plays a recording that is dropped onto the page. */
  play?: Play;
};

export function mount(element: HTMLElement, transport: Transport, { embedded = false, adopt = null, notice = null, play }: Options = {}) {
  const shadow = element.shadowRoot ?? element.attachShadow({ mode: "open" });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(CHARTS + STYLE);
  shadow.adoptedStyleSheets = [sheet];
  element.toggleAttribute("data-embedded", embedded);

  let frame = 0;
  const schedule = () => {
    frame ||= requestAnimationFrame(draw);
  };
  const session = new Session(transport, schedule, adopt, notice);
  transport.open(); // what it says is heard when the page is there: it is on its way while that is made
  const view = new Viewport();
  const hand = new Hand(session);
  const editor = new Editor(session, hand);
  const player = new Player(session);
  const beside = new Beside(session);
  const ui = new Ui(session, hand, editor, command, (layer) => player.showLayer(layer), embedded);

  // the map
  const layers = [
    new FieldLayer(), new HypothesisLayer(), new OverlayLayer(), new RaysLayer(), new ReadingLayer(), new EvidenceLayer(), new MarksLayer(),
    new DecisionsLayer(), new WhereLayer(), new GhostLayer(), new CursorLayer(),
  ];
  const canvases = layers.map(({ name }) => h("canvas", { className: name }));
  const canvas = canvases[canvases.length - 1]; // on top: it has the focus and the pointer
  Object.assign(canvas, { tabIndex: 0, role: "application" });
  const stack = new Stack(layers, canvases);
  new Pointer(canvas, session, view, hand, editor, embedded);
  const keys = new MapKeys(canvas, session, view, hand, editor);

  // around it
  const shown = { truth: true, rays: true, readings: true, strokes: true, trajectory: true };
  const top = head(ui);
  const tools = bar(ui);
  const onMap = { chip: chip(ui), banner: banner(ui) };
  const keptLayers = stillLayers();
  const keptCanvases = keptLayers.map(({ name }) => h("canvas", { className: name }));
  const keptStack = new Stack(keptLayers, keptCanvases);
  const captions = besideCaptions(ui, beside);
  const keptStage = h("div", { className: "beside" }, ...keptCanvases, captions.kept);
  const stage = h("main", { className: "stage" }, ...canvases, captions.now, onMap.chip, onMap.banner, keptStage);
  const dressed = () => themes.theme;
  const scale = () => view.transform.scale;
  const legendOfMap = legend(ui, dressed, scale);
  const bottom = foot(ui);
  canvas.setAttribute("aria-describedby", bottom.readout.id);
  const share = shareDialog(ui);
  const dialogs = { help: helpDialog(ui), new: newDialog(ui), share: share.dialog };
  const [sensors, model, inference, clear] = [sensorPanel(ui), modelPanel(ui), inferencePanel(ui), clearPanel(ui)];
  const viewing = viewPanel(ui, player, shown, scale);
  viewing.append(keepControl(ui, beside));
  const panels = [
    storyPanel(ui),
    decisionsPanel(ui), wherePanel(ui), ghostPanel(ui), evidencePanel(ui), logPanel(ui), posteriorPanel(ui, traceChart(ui, dressed), weightChart(ui, dressed)),
    scanPanel(ui), readingPanel(ui), viewing, sensors, model, posesPanel(ui), inference, clear,
  ];
  const panel = h("aside", { "aria-label": "Controls" }, ...panels);
  const isRun = () => session.recorded || session.document?.source.kind === "run";
  ui.visible(sensors, () => session.editable);
  ui.visible(model, () => !isRun());
  ui.visible(inference, () => !isRun());
  ui.visible(clear, () => !isRun());
  let held = hand.tool;
  ui.each(() => {
    if (held !== hand.tool) panel.scrollTop = 0; // there a tool's answers are
    held = hand.tool;
    put(tools, "inert", !session.document);
    put(panel, "inert", !session.document);
  });
  const app = h("div", { className: "app" }, top.element, tools, stage, legendOfMap, panel, bottom.element, ...Object.values(dialogs));
  shadow.replaceChildren(app);
  app.addEventListener("pointerdown", ({ pointerType, clientX, clientY }) => {
    const control = shadow.elementFromPoint(clientX, clientY)?.closest<HTMLButtonElement>(":disabled");
    if (pointerType === "touch" && control?.title) session.say(control.title); // fingers do not hover
  });
  const themes = new ThemeChoice(app, (name) => {
    top.nameTheme(name);
    schedule();
  });

  const scene = (): Scene => {
    const selected = session.editable && hand.tool === "sensor" ? (hand.sensor?.id ?? null) : null;
    return { session, view, look: { theme: themes.theme, ...shown, hover: hand.hover, cursor: hand.cursor, selected } };
  };

  // the story, if there is one: it begins with the step of the address, unless the address holds a map
  const { telling } = session;
  const takeUp = () => {
    if (telling.step) hand.choose(telling.step.tool);
  };
  telling.onstep = (at) => {
    takeUp();
    if (!embedded) history.replaceState(null, "", location.pathname + location.search + stepFragment(at));
  };
  let begun = false;
  function begin() {
    begun = true;
    const linked = embedded || adopt ? null : linkedStep(location.hash);
    if (telling.story && linked !== null) telling.go(linked);
    else takeUp();
  }

  // painting: once a frame at most
  let shape = "";
  function draw() {
    frame = 0;
    const fresh = session.take();
    if (session.document && !begun) begin();
    if (session.document && String(session.shape) !== shape) {
      shape = String(session.shape);
      if (beside.kept && String(beside.kept.shape) !== shape) beside.forget();
      view.fit(session.shape);
      hand.cursor = hand.hover = null;
      session.decisions.forget();
      session.evidence.forget();
      session.ghost.refit();
      canvas.setAttribute("aria-label", `Map, ${session.shape[0]} by ${session.shape[1]} cells`);
    }
    if (keptStage.hidden === Boolean(beside.kept)) layOut();
    stack.paint(scene());
    beside.follow();
    if (beside.kept) keptStack.paint({ ...scene(), session: beside.kept });
    if (fresh) {
      session.painted();
      player.step();
    }
    const { x, y } = view.transform;
    onMap.chip.style.transform = `translate(${Math.max(x, GUTTER.left)}px, ${Math.max(y - 28, 6)}px)`;
    mark(canvas, "data-tool", session.editable || READING.has(hand.tool) ? hand.tool : "pan");
    ui.refresh();
  }
  /** Gives the map its room: the whole stage, or half of it beside a kept result. */
  function layOut() {
    const { width, height } = stage.getBoundingClientRect();
    if (!width || !height) return false;
    keptStage.hidden = !beside.kept;
    const tall = height > width;
    stage.classList.toggle("shared", !keptStage.hidden);
    stage.classList.toggle("tall", tall);
    const half = keptStage.hidden ? 1 : 0.5;
    view.resize(tall ? width : half * width, tall ? half * height : height, devicePixelRatio || 1);
    if (view.fitted) view.fit(session.shape);
    return true;
  }
  const observer = new ResizeObserver(() => {
    if (!layOut()) return;
    cancelAnimationFrame(frame);
    draw(); // at once: a canvas that was resized is blank
  });
  observer.observe(stage);

  /** Puts the cursor on a cell, and moves the map only where the cell is outside or too small to be seen. */
  function show([x, y]: number[]) {
    const { scale } = view.transform;
    const centre = { x: x + 0.5, y: y + 0.5 };
    const small = scale < SEEN_FROM_SCALE;
    if (small) view.zoom(SEEN_FROM_SCALE / scale, view.middle, session.shape);
    const at = view.fromGrid(centre, session.shape[1]);
    if (small || at.x < scale || at.y < scale || at.x > view.width - scale || at.y > view.height - scale) view.pan(view.middle.x - at.x, view.middle.y - at.y, session.shape);
    keys.focus();
    hand.setCursor({ x, y });
  }

  /** Does what is no message. */
  async function command(what: string) {
    if (what === "in" || what === "out") view.zoom(what === "in" ? 1.4 : 1 / 1.4, view.middle, session.shape);
    else if (what === "fit") view.fit(session.shape);
    else if (what.startsWith("cell ")) show(what.slice(5).split(",").map(Number));
    else if (what === "help") dialogs.help.showModal();
    else if (what === "new") dialogs.new.showModal();
    else if (what === "theme") themes.next();
    else if (what === "add") keys.addSensor();
    else if (what === "share") {
      const whole = session.portableDocument();
      // without the token: who has it need not be told, and nobody else shall have it
      if (whole) share.show(location.href.replace(/[?#].*/, "") + (await toFragment(whole)));
    } else if (what === "export png") {
      const blob = await picture(scene());
      if (blob) download("bayesmap.png", blob);
      session.say("Saved bayesmap.png");
    } else if (what.startsWith("export ")) session.act({ type: "export", what: what.slice(7) as Export["what"] });
    schedule();
  }
  session.ondownload = (name, mime, data) => name === RECORDING ? beside.receive(unpackFrame(data.slice().buffer as ArrayBuffer)) : download(name, new Blob([data as Uint8Array<ArrayBuffer>], { type: mime }));

  const key = (event: KeyboardEvent) => {
    if (event.defaultPrevented || !session.document || Object.values(dialogs).some((dialog) => dialog.open)) return;
    pageKey(event, session, {
      tool: (tool) => {
        hand.choose(tool);
        keys.focus();
      },
      layer: (layer) => player.showLayer(layer),
      command,
    });
  };
  const online = () => transport.retry?.();
  const hash = async () => {
    if (embedded) return;
    const { document, damaged } = await takeFragment();
    const step = linkedStep(location.hash);
    if (document) session.bring(document);
    else if (telling.story && step !== null) telling.go(step);
    else if (damaged) session.say(DAMAGED, "error");
  };
  const listeners: [EventTarget, string, EventListener][] = [
    [embedded ? element : window, "keydown", key as EventListener],
    [window, "online", online],
    [window, "hashchange", hash],
    [element, "dragover", (event) => event.preventDefault()],
    [element, "drop", (event) => {
      event.preventDefault();
      const file = (event as DragEvent).dataTransfer?.files[0];
      if (file) openDropped(file, session, play);
    }],
  ];
  for (const [target, type, listener] of listeners) target.addEventListener(type, listener);
  themes.dress();

  return {
    destroy() {
      observer.disconnect();
      cancelAnimationFrame(frame);
      themes.destroy();
      for (const [target, type, listener] of listeners) target.removeEventListener(type, listener);
      transport.close();
      shadow.replaceChildren();
    },
    /** What is known and shown, for tests. */
    snapshot: () => snapshot(session, view, stack, beside),
    /** Where the centre of a cell is on the page. */
    cellToClient(x: number, y: number) {
      const box = canvas.getBoundingClientRect();
      const point = view.fromGrid({ x: x + 0.5, y: y + 0.5 }, session.shape[1]);
      return { x: box.left + point.x, y: box.top + point.y };
    },
  };
}
export type Handle = ReturnType<typeof mount>;
