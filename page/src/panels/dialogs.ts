// Help, new map, share.

import { KEYS } from "../input/keys";
import { LIMITS } from "../protocol";
import { h } from "./dom";
import type { Ui } from "./ui";

const WORLDS = [
  ["tutorial", "the tutorial's map"],
  ["building", "a building"],
  ["blank", "blank"],
];
const EXPLAINED = [
  "Draw walls, and drag the robot: a beam reads the first wall that it hits, with noise. Shown is what the readings tell about the walls: how probable each is (mean), one whole map that explains them (draw), and where doubt remains (entropy). No beam has been where it is hatched.",
  "While you edit, the answer is belief propagation, which is approximate. Gibbs sampling follows, and is exact in the long run.",
];
const MOUSE = "Mouse: the wheel zooms, the middle button pans, Shift or the right button erases, and so does a click on a wall. Touch: two fingers zoom and pan.";

export function helpDialog(ui: Ui) {
  const rows = KEYS.map(([key, text]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", { textContent: key })), h("td", { textContent: text })));
  const paragraphs = EXPLAINED.map((text) => h("p", { textContent: text }));
  return ui.dialog("Help", ...paragraphs, h("table", {}, h("tbody", {}, ...rows)), h("p", { textContent: MOUSE }));
}

export function newDialog(ui: Ui) {
  const size = () => h("input", { type: "number", min: LIMITS.cells[0], max: LIMITS.cells[1], step: 1, required: true, value: "21" });
  const [width, height] = [size(), size()];
  const world = h("select", {});
  for (const [value, text] of WORLDS) world.append(h("option", { value, textContent: text }));
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
    ui.session.act({ type: "new", shape: [Number(width.value), Number(height.value)], world: world.value });
    ui.hand.selected = null;
  });
  return ui.dialog("New map", form);
}

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
  const explained =
    "The link holds the walls, the sensors and all settings after its #, and no token. It opens in this browser while the server runs; the part from # on can be put after the address of any bayesmap page.";
  const dialog = ui.dialog("Share", h("p", { textContent: explained }), h("div", { className: "buttons" }, link, button), copied);
  return {
    dialog,
    show(address: string) {
      link.value = address;
      dialog.showModal();
      link.select();
    },
  };
}
