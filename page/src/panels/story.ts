// A story: the title and number of the step, what is seen, one thing to do, and the way to other steps. The controls that
// a task names are marked, and their names lead to them.

import { namedIn, stepFragment } from "../state/story";
import { h, mark, put } from "./dom";
import type { Named, Ui } from "./ui";

export function storyPanel(ui: Ui) {
  const { telling } = ui.session;
  const [title, text, task] = [h("h3"), h("p"), h("p", { className: "task" })];
  const told = h("div", { className: "told", "aria-live": "polite" }, title, text, task);
  const steps = h("nav", { "aria-label": "Steps" });
  const go = (by: number) => () => telling.go(telling.at + by);
  const buttons = h(
    "div",
    { className: "buttons" },
    ui.button(null, "Back", go(-1), { text: "Back", when: () => telling.at > 0, why: "This is the first step" }),
    ui.button(null, "Next", go(1), { className: "primary", text: "Next", when: () => telling.at < telling.last, why: "This is the last step" }),
    ui.button(null, "Start this step again", go(0), { text: "Again" }),
  );
  const solve = ui.button(null, "Show me", () => telling.solve(), { text: "Show me" });
  ui.visible(solve, () => Boolean(telling.step?.solution));
  buttons.append(solve);
  const section = ui.section("Story", steps, told, buttons);
  section.className = "story";
  const heading = section.querySelector("h2") as HTMLElement;
  ui.visible(section, () => Boolean(telling.story));
  let known: unknown = null;
  ui.each(() => {
    const { story, step, at } = telling;
    if (!story || !step) return;
    if (known !== story) {
      steps.replaceChildren(
        ...story.steps.map(({ title }, i) => {
          const onclick = (event: Event) => {
            event.preventDefault(); // the address follows, without a step back for each step on
            telling.go(i);
          };
          return h("a", { href: stepFragment(i), title, "aria-label": `Step ${i + 1}: ${title}`, textContent: String(i + 1), onclick });
        }),
      );
    }
    known = story;
    put(heading, "textContent", story.title);
    put(title, "textContent", step.title);
    put(text, "textContent", step.text);
    Array.from(steps.children).forEach((link, i) => mark(link, "aria-current", i === at ? "step" : "false"));
  });
  pointOut(ui, section, task);
  return section;
}

/** Marks the controls that the task names, makes their names lead to them, and brings the first of a new step into view. */
function pointOut(ui: Ui, section: HTMLElement, task: HTMLElement) {
  const { telling } = ui.session;
  let marked: Named[] = [];
  let [told, cut] = ["", ""];
  let begun = -1;
  /** Whether the first control is kept in view: while the layout of a new step settles, and until the reader does something. */
  let following = false;
  let heard = false;
  ui.after(() => {
    const { step, begins } = telling;
    if (!step) return;
    const all = ui.named.filter(({ place }) => !place.closest("[hidden], dialog"));
    const names = all.map(({ name }) => name());
    const key = [step.task, ...names].join("|");
    const parts = key === told ? null : namedIn(step.task, names);
    told = key;
    if (parts && JSON.stringify(parts) !== cut) {
      cut = JSON.stringify(parts);
      for (const { place } of marked) place.classList.remove("named");
      marked = parts.flatMap(({ at }) => (at === null ? [] : [all[at]]));
      for (const { place } of marked) place.classList.add("named");
      task.replaceChildren(
        ...parts.map(({ text, at }) => {
          if (at === null) return text;
          const lead = () => {
            reveal(section, all[at].place);
            all[at].control.focus({ preventScroll: true });
          };
          return h("button", { type: "button", title: "Go to this control", textContent: text, onclick: lead });
        }),
      );
    }
    const panel = section.parentElement;
    if (!panel) return;
    if (!heard) for (const type of ["wheel", "touchmove", "pointerdown", "keydown"]) panel.addEventListener(type, () => (following = false), { passive: true });
    heard = true;
    if (begun !== begins) {
      begun = begins;
      panel.scrollTop = 0; // the step is read first
      following = true;
    }
    if (!following) return;
    if (marked.length && stays(section)) reveal(section, marked[0].place);
    following = !telling.settled;
  });
}

/** Whether the step stays in view while the panel is scrolled. */
const stays = (section: HTMLElement) => getComputedStyle(section).position === "sticky";

/** Scrolls the panel so that a control in it is seen, below the step where that stays. */
function reveal(section: HTMLElement, place: HTMLElement) {
  const panel = section.parentElement as HTMLElement;
  if (!panel.contains(place)) return; // the bar is always seen
  const [room, at] = [panel.getBoundingClientRect(), place.getBoundingClientRect()];
  const top = room.top + (stays(section) ? section.getBoundingClientRect().height : 0);
  // in the middle, so that the heading and the neighbours of the control are seen, too
  if (at.top < top || at.bottom > room.bottom) panel.scrollTop += (at.top + at.bottom - top - room.bottom) / 2;
}
