// A story: the title and number of the step, what is seen, one thing to do, and the way to other steps.

import { stepFragment } from "../state/story";
import { h, mark, put } from "./dom";
import type { Ui } from "./ui";

export function storyPanel(ui: Ui) {
  const { telling } = ui.session;
  const [title, text, task] = [h("h3"), h("p"), h("p", { className: "task" })];
  const told = h("div", { className: "told", "aria-live": "polite" }, title, text, task);
  const steps = h("nav", { "aria-label": "Steps" });
  const go = (by: number) => () => telling.go(telling.at + by);
  const buttons = h(
    "div",
    { className: "buttons" },
    ui.button(null, "Back", go(-1), { text: "Back", when: () => telling.at > 0 }),
    ui.button(null, "Next", go(1), { className: "primary", text: "Next", when: () => telling.at < telling.last }),
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
    put(task, "textContent", step.task);
    Array.from(steps.children).forEach((link, i) => mark(link, "aria-current", i === at ? "step" : "false"));
  });
  return section;
}
