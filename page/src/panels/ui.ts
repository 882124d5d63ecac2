// What every panel is given, and the controls of which panels are made.

import { clamp } from "../geometry/cells";
import type { Editor } from "../input/editor";
import type { Hand } from "../input/hand";
import type { Layer, Limits, Pair, Patch } from "../protocol";
import type { Session } from "../state/session";
import { focused, h, mark, put } from "./dom";
import { icon, type IconName } from "./icons";

let count = 0; // several pages may stand in one notebook

/** `why` is said where the button is disabled. */
type ButtonOptions = { className?: string; text?: string; when?: () => boolean; why?: string | (() => string); title?: string | (() => string) };
/** `scale` is for people who read degrees where the document holds radians: the number on show is that many times the document's. */
type Range = { step: number; log?: boolean; unit?: string; scale?: number };
type NumberOptions = { step: number | "any"; limits?: keyof Limits; scale?: number };
/** A control, or a figure, that words can name: `place` is what surrounds it with its label. */
export type Named = { name: () => string; place: HTMLElement; control: HTMLElement };
type SliderKey = "prior" | "noise" | "angles" | "sweeps" | "pose_sigma" | "heading_sigma" | "burn_in";

export class Ui {
  /** Makes ids of elements unique. */
  readonly prefix = `bayesmap${count++}`;
  /** The controls with a name that is read. */
  readonly named: Named[] = [];
  private readonly updates: (() => void)[] = [];
  private readonly afterwards: (() => void)[] = [];
  // begins with a number that undo has not seen on this connection
  private drag = Math.floor(Math.random() * 2 ** 30);

  /** `command` does what is no message: zoom, help, themes, dialogs, pictures. */
  constructor(
    readonly session: Session,
    readonly hand: Hand,
    readonly editor: Editor,
    readonly command: (what: string) => void,
    readonly showLayer: (layer: Layer) => void,
    readonly embedded: boolean,
  ) {}

  /** Runs after every change. */
  each(update: () => void) {
    this.updates.push(update);
  }

  /** Runs after every change, once all else is up to date and has its place. */
  after(update: () => void) {
    this.afterwards.push(update);
  }

  refresh() {
    for (const update of [...this.updates, ...this.afterwards]) update();
  }

  /** Changes settings, as a step of undo of its own. */
  set(patch: Patch) {
    this.session.act({ type: "set", patch });
  }

  /** Changes settings by a slide, all of which is one step of undo. */
  private slide(patch: Patch) {
    this.session.act({ type: "set", patch, drag: this.drag });
  }

  /** Makes the map of some of a log's scans: coarsely while the hand drags. */
  scrub(scans_used: number | null, coarse: boolean) {
    this.session.act({ type: "set", patch: { scans_used }, drag: this.drag, ...(coarse ? { coarse } : {}) });
  }

  endDrag() {
    this.drag++;
  }

  /** Smallest and largest value as the server has them; of another unit those tenths that lie inside. */
  limits(key: keyof Limits, scale = 1): Pair {
    const [low, high] = this.session.limits?.[key] ?? [1, 2];
    return scale === 1 ? [low, high] : [Math.ceil(10 * low * scale - 1e-6) / 10, Math.floor(10 * high * scale + 1e-6) / 10];
  }

  /** Keeps a field's limits those of the server; where it has steps, the outermost ones inside these limits. */
  bounded(field: HTMLInputElement, key: keyof Limits, scale = 1, step = 0) {
    this.each(() => {
      const [low, high] = this.limits(key, scale);
      const [first, last] = step ? [Math.ceil(low / step - 1e-6), Math.floor(high / step + 1e-6)] : [low, high];
      const text = (steps: number) => String(step ? +(steps * step).toPrecision(9) : steps);
      put(field, "min", text(first));
      put(field, "max", text(last));
    });
  }

  /** Hides an element unless a condition holds. */
  visible(element: HTMLElement, when: () => boolean) {
    this.each(() => put(element, "hidden", !when()));
  }

  button(image: IconName | null, label: string, action: () => void, { className = "", text = "", when, why, title }: ButtonOptions = {}) {
    const named = () => (typeof title === "function" ? title() : (title ?? label));
    const element = h("button", { type: "button", className, title: named(), onclick: action }, image && icon(image));
    if (text) {
      element.append(h("span", { textContent: text }));
      this.named.push({ name: () => text, place: element, control: element });
    }
    if (text !== label) element.setAttribute("aria-label", label);
    if (when)
      this.each(() => {
        put(element, "disabled", !when());
        const reason = typeof why === "function" ? why() : why;
        if (reason) put(element, "title", element.disabled ? reason : named());
      });
    return element;
  }

  /** Radio buttons that look like one. */
  segmented<T extends string>(
    label: string,
    options: readonly (readonly [T, string, IconName?])[],
    current: () => T,
    choose: (value: T) => void,
  ) {
    const name = `${this.prefix}-${label.replace(/\W/g, "")}`;
    const group = h("div", { className: "segmented", role: "radiogroup", "aria-label": label });
    for (const [value, text, image] of options) {
      const input = h("input", { type: "radio", name, value, onchange: () => choose(value) });
      const place = h("label", { title: text }, input, image ? icon(image) : null, h("span", { textContent: text }));
      group.append(place);
      this.named.push({ name: () => text, place, control: input });
      this.each(() => put(input, "checked", current() === value));
    }
    return group;
  }

  section(title: string, ...children: (Node | null)[]) {
    const id = `${this.prefix}-${title.replace(/\W/g, "")}`;
    return h("section", { "aria-labelledby": id }, h("h2", { id, textContent: title }), ...children);
  }

  /** A label beside a control. */
  row(label: string, control: HTMLElement) {
    control.id = `${this.prefix}-${label.replace(/\W/g, "")}`;
    const place = h("div", { className: "row" }, h("label", { for: control.id, textContent: label }), control);
    this.named.push({ name: () => label, place, control });
    return place;
  }

  /** A slider with a number beside it. */
  slider(key: SliderKey, label: () => string, { step, log = false, unit = "", scale = 1 }: Range) {
    const id = `${this.prefix}-${key}`;
    const limits = () => this.limits(key, scale);
    const toPosition = (v: number) => {
      const [low, high] = limits();
      return log ? (1000 * Math.log(v / low)) / Math.log(high / low) : v;
    };
    const toValue = (t: number) => {
      if (!log) return t;
      const [low, high] = limits();
      const value = low * (high / low) ** (t / 1000);
      const round = value < 100 ? 1 : 10 ** (Math.floor(Math.log10(value)) - 1);
      return clamp(Math.round(value / round) * round, low, high);
    };
    const shown = () => {
      const value = this.session.document?.[key];
      return value === undefined ? limits()[0] : scale === 1 ? value : Number((value * scale).toFixed(3));
    };
    const text = h("label", { for: id });
    const range = h("input", { type: "range", id, ...(log ? { min: 0, max: 1000, step: 1 } : { step }) });
    const exact = h("input", { type: "number", step: String(step) });
    if (!log) this.bounded(range, key, scale, step);
    this.bounded(exact, key, scale);
    range.addEventListener("input", () => this.slide({ [key]: toValue(Number(range.value)) / scale }));
    range.addEventListener("change", () => this.endDrag());
    exact.addEventListener("change", () => this.typed(exact, label(), limits(), shown, (value) => this.set({ [key]: log ? Math.round(value) : value / scale })));
    this.each(() => {
      const value = shown();
      put(text, "textContent", label());
      mark(exact, "aria-label", `${label()}, number`);
      if (toValue(Number(range.value)) !== value) range.value = String(toPosition(value));
      mark(range, "aria-valuetext", `${value}${unit}`);
      const fill = (100 * (toPosition(value) - Number(range.min))) / (Number(range.max) - Number(range.min));
      range.style.setProperty("--fill", `${clamp(fill, 0, 100)}%`);
      if (!focused(exact)) put(exact, "value", String(value));
    });
    const place = h("div", { className: "row slider" }, text, range, exact);
    this.named.push({ name: label, place, control: range });
    return place;
  }

  select<T extends string>(label: string, options: Record<T, string>, current: () => T, choose: (value: T) => void, when?: () => boolean, why = "") {
    const element = h("select", { onchange: () => choose(element.value as T) });
    for (const [value, text] of Object.entries<string>(options)) element.append(h("option", { value, textContent: text }));
    this.each(() => {
      put(element, "value", current());
      if (when) put(element, "disabled", !when());
      if (why) put(element, "title", element.disabled ? why : "");
    });
    return this.row(label, element);
  }

  /** Takes what was typed, brought into its limits, and says these where it was outside; what is no number gives way to the present one. */
  private typed(field: HTMLInputElement, label: string, [low, high]: Pair, current: () => number, choose: (value: number) => void) {
    const value = field.value === "" ? NaN : Number(field.value);
    if (Number.isFinite(value)) choose(clamp(value, low, high));
    field.value = String(current());
    if (value < low) this.session.say(`${label} is at least ${low}`, "warning");
    else if (value > high) this.session.say(`${label} is at most ${high}`, "warning");
  }

  /** A number that is brought into its limits, where it has any. */
  numberInput(label: string, current: () => number, choose: (value: number) => void, { step, limits, scale }: NumberOptions) {
    const element = h("input", { type: "number", step: String(step) });
    const within = (): Pair => (limits ? this.limits(limits, scale) : [-Infinity, Infinity]);
    if (limits) this.bounded(element, limits, scale);
    element.addEventListener("change", () => this.typed(element, label, within(), current, choose));
    this.each(() => {
      if (!focused(element)) put(element, "value", String(current()));
    });
    return this.row(label, element);
  }

  checkbox(label: string, current: () => boolean, choose: (on: boolean) => void, title = "") {
    const input = h("input", { type: "checkbox", onchange: () => choose(input.checked) });
    this.each(() => put(input, "checked", current()));
    const place = h("label", { className: "check", title }, input, h("span", { textContent: label }));
    this.named.push({ name: () => label, place, control: input });
    return place;
  }

  dialog(title: string, ...children: (Node | string)[]) {
    const id = `${this.prefix}-dialog-${title.replace(/\W/g, "")}`;
    const close = h("button", { type: "button", className: "plain", "aria-label": "Close", onclick: () => dialog.close() }, icon("close"));
    const heading = h("div", { className: "title" }, h("h2", { id, textContent: title }), close);
    const dialog: HTMLDialogElement = h("dialog", { "aria-labelledby": id }, heading, ...children);
    dialog.addEventListener("click", (event) => {
      if (event.target === dialog) dialog.close();
    });
    dialog.addEventListener("keydown", (event) => event.stopPropagation());
    return dialog;
  }
}
