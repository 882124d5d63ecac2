// Help, new map, share.

import { KEYS, type KeysFor } from "../input/keys";
import type { NewMap } from "../messages";
import type { Session } from "../state/session";
import { h, put } from "./dom";
import type { Ui } from "./ui";

const WORLDS: [NewMap["world"], string][] = [
  ["tutorial", "the tutorial's map"],
  ["building", "a building"],
  ["blank", "blank"],
];
const DRAWN = "Draw walls, and drag the robot: a beam reads the first wall that it hits, with noise.";
const WALLS =
  "Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (one draw), and where doubt remains (entropy). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.";
const NUMBERS =
  "Shown is what the readings tell about how likely each cell is to stop a beam: what is expected (mean), one whole map that explains them (one draw), and how wide the 90 % interval is (width). The denser the hatch, the less probably a beam reaches the cell; where it is full, the prior is all there is.";
const EDITED = "While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact in the long run.";
const FIGURE = "This page samples by itself: the answer is that of the chosen method after as many sweeps as are shown, and gets better as they go on.";
const LOG = "The map is made from the scans of this log. Where its poses are raw odometry, Run first infers where the robot was; then it samples maps.";
const RUN = "This is a saved run: its draws, and what they say together.";
const MOUSE = "Mouse: the wheel zooms, the middle button pans.";
const MOUSE_DRAWS = "Shift or the right button erases, and so does a click on a wall.";
const TOUCH = "Touch: two fingers zoom and pan.";

export function helpDialog(ui: Ui) {
  const { session } = ui;
  const said = h("div");
  const rows = KEYS.map(([key, text, when]) => {
    const row = h("tr", {}, h("th", { scope: "row" }, h("kbd", { textContent: key })), h("td", { textContent: text }));
    ui.visible(row, () => KEYS_OF[when ?? "all"](session));
    return row;
  });
  const mouse = h("p");
  let known = "";
  ui.each(() => {
    const kind = session.document?.source.kind;
    const shown = session.quantity.interval ? NUMBERS : WALLS;
    const texts = session.editable ? [`${DRAWN} ${shown}`, session.figure ? FIGURE : EDITED] : kind === "log" ? [shown, LOG] : kind === "run" ? [shown, RUN] : [shown];
    if (texts.join() !== known) said.replaceChildren(...texts.map((text) => h("p", { textContent: text })));
    known = texts.join();
    put(mouse, "textContent", [MOUSE, ...(session.editable ? [MOUSE_DRAWS] : []), TOUCH].join(" "));
  });
  return ui.dialog("Help", said, mouse, h("table", {}, h("tbody", {}, ...rows)));
}

/** Which keys there are for whom. */
const KEYS_OF: Record<KeysFor, (session: Session) => boolean> = {
  all: () => true,
  drawn: (session) => session.editable,
  asked: (session) => session.answers,
  located: (session) => session.locates,
  edited: (session) => !session.recorded,
  inferred: (session) => !session.recorded && session.document?.source.kind !== "run",
};

export function newDialog(ui: Ui) {
  const size = () => h("input", { type: "number", step: 1, required: true, value: "21" });
  const [width, height] = [size(), size()];
  for (const field of [width, height]) ui.bounded(field, "side");
  const world = h("select", {});
  for (const [value, text] of WORLDS) {
    const option = h("option", { value, textContent: text });
    world.append(option);
    if (value !== "blank") ui.visible(option, () => !ui.session.figure); // which has no other worlds
  }
  ui.each(() => ui.session.figure && put(world, "value", "blank"));
  world.addEventListener("change", () => {
    if (world.value === "building" && Number(width.value) < 60) [width.value, height.value] = ["120", "80"];
  });
  const form = h(
    "form",
    { method: "dialog" },
    ui.row("World", world),
    ui.row("Width (cells)", width),
    ui.row("Height (cells)", height),
    h("div", { className: "buttons end" }, h("button", { type: "submit", className: "primary", textContent: "Create" })),
  );
  form.addEventListener("submit", () => {
    ui.session.act({ type: "new", shape: [Number(width.value), Number(height.value)], world: world.value as NewMap["world"] });
    ui.hand.selected = null;
  });
  return ui.dialog("New map", form);
}

const OF_DRAWN =
  "The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server runs; the part from # on can be put after the address of any bayesmap page.";
const OF_FIGURE = "The link holds the walls, the sensors and all settings after its #. The part from # on can be put after the address of any bayesmap page.";
const OF_FILE =
  "The link holds the file's name and all settings after its #, but no scans and no token. It opens in this browser while the server shows this file; the part from # on can be put after the address of any bayesmap page that shows it.";

export function shareDialog(ui: Ui) {
  const link = h("input", { type: "text", readOnly: true, "aria-label": "Link" });
  const copied = h("span", { role: "status", className: "copied" });
  const copy = async () => {
    link.select();
    try {
      await navigator.clipboard.writeText(link.value);
    } catch {
      document.execCommand("copy");
    }
    copied.textContent = "Copied";
    setTimeout(() => (copied.textContent = ""), 2000);
  };
  const button = ui.button(null, "Copy the link", copy, { className: "primary", text: "Copy" });
  const explained = h("p");
  ui.each(() => put(explained, "textContent", ui.session.figure ? OF_FIGURE : ui.session.document?.source.kind === "simulation" ? OF_DRAWN : OF_FILE));
  const dialog = ui.dialog("Share", explained, h("div", { className: "buttons" }, link, button), copied);
  return {
    dialog,
    show(address: string) {
      link.value = address;
      dialog.showModal();
      link.select();
    },
  };
}
