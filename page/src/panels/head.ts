// The bar at the top: what is shown, undo, new map, share, export, theme, help.

import { h, mark, put } from "./dom";
import type { Session } from "../state/session";
import type { Ui } from "./ui";

export function head(ui: Ui) {
  const { session } = ui;
  const what = h("span", { className: "what" });
  ui.each(() => {
    const { grid, source } = session.document ?? {};
    if (!grid || !source) return;
    const size = `${grid.shape[0]} \u00d7 ${grid.shape[1]} cells of ${+grid.resolution.toPrecision(3)} m`;
    put(what, "textContent", source.name ? `${source.name}, ${size}` : size);
  });
  const live = () => !session.recorded && Boolean(session.document);
  const only = [
    ui.button("undo", "Undo", () => session.act({ type: "undo" }), { title: "Undo (Ctrl+Z)", when: () => Boolean(session.state?.can_undo), why: "Nothing of this page to undo" }),
    ui.button("redo", "Redo", () => session.act({ type: "redo" }), { title: "Redo (Ctrl+Y)", when: () => Boolean(session.state?.can_redo), why: "Nothing to redo" }),
    h("span", { className: "gap" }),
    ui.button("grid", "New map", () => ui.command("new"), { text: "New map", when: live }),
    // a notebook's address holds no map, and may hold the notebook's token
    ...(ui.embedded ? [] : [ui.button("link", "Share", () => ui.command("share"), { text: "Share", when: live })]),
  ];
  for (const element of only) ui.visible(element, () => !session.recorded);
  const theme = ui.button("theme", "Theme: automatic", () => ui.command("theme"));
  const help = ui.button("help", "Help", () => ui.command("help"), { title: "Help (?)" });
  const space = h("span", { className: "space" });
  const element = h("header", {}, h("h1", { textContent: "bayesmap" }), what, space, ...only, exportMenu(ui), theme, help);
  return {
    element,
    nameTheme(name: string) {
      const label = `Theme: ${name}`;
      mark(theme, "aria-label", label);
      put(theme, "title", label);
    },
  };
}

/** Whether there is something to save: draws that were kept, or the answer of a method that needs none. */
const hasRun = ({ shown, draws }: Session) => draws.count > 0 || /importance|propagate/.test(shown?.method ?? "");

function exportMenu(ui: Ui) {
  const { session } = ui;
  const item = (label: string, value: string, where: "all" | "document" | "server", when?: () => boolean, why?: string) => {
    const element = ui.button(null, label, () => ui.command(`export ${value}`), { text: label, when, why });
    if (where !== "all") ui.visible(element, () => !session.recorded && (where === "document" || !session.figure));
    return element;
  };
  const figure = item("Figure that samples by itself (HTML)", "figure", "server");
  ui.visible(figure, () => session.editable && !session.figure);
  const menu = h(
    "div",
    { className: "menu", hidden: true },
    item("Picture (PNG)", "png", "all"),
    item("Saved run (netCDF)", "run", "server", () => hasRun(session), "There are no draws yet: chains keep them"),
    item("Map for robots (YAML and PGM)", "map", "server"),
    item("Page in one file (HTML)", "html", "server"),
    figure,
    item("Document (JSON)", "document", "document"),
  );
  const toggle = ui.button("save", "Export", () => open(menu.hidden), { text: "Export", when: () => Boolean(session.document) });
  const open = (on: boolean) => {
    menu.hidden = !on;
    toggle.setAttribute("aria-expanded", String(on));
    if (on) (menu.firstElementChild as HTMLElement).focus();
  };
  open(false);
  // Safari gives a button that is clicked no focus: what is around it takes it, or the menu would close before the click
  const anchor = h("div", { className: "anchor", tabIndex: -1 }, toggle, menu);
  anchor.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || menu.hidden) return;
    open(false);
    toggle.focus();
    event.stopPropagation();
  });
  anchor.addEventListener("focusout", (event) => {
    if (!anchor.contains(event.relatedTarget as Node | null)) open(false);
  });
  menu.addEventListener("click", () => {
    open(false);
    toggle.focus();
  });
  return anchor;
}
