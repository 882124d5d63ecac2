// As much of a browser as the page's logic needs, without layout and without paint: elements hold what they are given
// and pass events on. Importing this file puts it in place; what needs more than this is tested in a browser.

type Listener = (event: any) => void;

export class Element {
  readonly children: Element[] = [];
  parent: Element | null = null;
  readonly dataset: { [name: string]: string } = {};
  readonly style: { [name: string]: any } = { setProperty: (name: string, value: string) => (this.style[name] = value) };
  hidden = false;
  disabled = false;
  checked = false;
  className = "";
  type = "";
  title = "";
  value = "";
  min = "";
  max = "";
  open = false;
  returnValue = "";
  clientWidth = 0;
  scrollTop = 0;
  /** Where it lies on the screen, for a test to say. */
  box = { left: 0, top: 0, width: 960, height: 800 };
  private own = "";
  private readonly attributes = new Map<string, string>();
  private readonly listeners = new Map<string, Listener[]>();

  constructor(readonly tagName: string) {}

  get textContent(): string {
    return this.own + this.children.map((child) => child.textContent).join("");
  }
  set textContent(text: string) {
    this.children.length = 0;
    this.own = text;
  }
  /** What is seen of it. */
  get innerText(): string {
    return this.hidden ? "" : this.own + this.children.map((child) => child.innerText).join(" ");
  }
  get length() {
    return this.children.length;
  }
  get firstElementChild(): Element | null {
    return this.children[0] ?? null;
  }
  get lastElementChild(): Element | null {
    return this.children.at(-1) ?? null;
  }
  get parentElement() {
    return this.parent;
  }
  readonly classList = {
    add: (name: string) => this.classList.toggle(name, true),
    remove: (name: string) => this.classList.toggle(name, false),
    toggle: (name: string, on: boolean) => {
      const names = this.className.split(" ").filter((other) => other && other !== name);
      this.className = [...names, ...(on ? [name] : [])].join(" ");
    },
  };
  append(...children: (Element | string)[]) {
    for (const child of children) {
      const element = typeof child === "string" ? Object.assign(new Element("#text"), { textContent: child }) : child;
      element.parent = this;
      this.children.push(element);
    }
  }
  replaceChildren(...children: (Element | string)[]) {
    this.textContent = "";
    this.append(...children);
    if (this.tagName === "select" && children.length) this.value = (children[0] as Element).value;
  }
  querySelector(tag: string): Element | null {
    return this.all((element) => element.tagName === tag)[0] ?? null;
  }
  /** The nearest of it and those around it that is hidden, or of one of the tags named. */
  closest(selector: string): Element | null {
    const tags = selector.split(", ");
    const is = (tags.includes("[hidden]") && this.hidden) || tags.includes(this.tagName);
    return is ? this : (this.parent?.closest(selector) ?? null);
  }
  contains(other: Element | null): boolean {
    return other === this || Boolean(other?.parent && this.contains(other.parent));
  }
  /** It and all below it that are as wanted. */
  all(wanted: (element: Element) => boolean): Element[] {
    return [...(wanted(this) ? [this] : []), ...this.children.flatMap((child) => child.all(wanted))];
  }
  setAttribute(name: string, value: string) {
    this.attributes.set(name, value);
  }
  getAttribute(name: string) {
    return this.attributes.get(name) ?? null;
  }
  addEventListener(type: string, listener: Listener) {
    this.listeners.set(type, [...(this.listeners.get(type) ?? []), listener]);
  }
  removeEventListener(type: string, listener: Listener) {
    this.listeners.set(type, (this.listeners.get(type) ?? []).filter((other) => other !== listener));
  }
  /** Passes an event on; returns it, with whether somebody took it. */
  dispatch(type: string, fields: object = {}) {
    const event = {
      type,
      target: this,
      timeStamp: performance.now(),
      defaultPrevented: false,
      preventDefault: () => (event.defaultPrevented = true),
      stopPropagation: () => {},
      composedPath: () => [this],
      ...fields,
    };
    for (let at: Element | null = this; at; at = at.parent) for (const listener of at.listeners.get(type) ?? []) listener(event);
    return event;
  }
  click() {
    if (!this.disabled) this.dispatch("click");
  }
  /** As a hand changes a control. */
  put(value: string | boolean, ...types: string[]) {
    if (typeof value === "boolean") this.checked = value;
    else this.value = value;
    for (const type of types.length ? types : ["input", "change"]) this.dispatch(type);
  }
  getRootNode() {
    return page;
  }
  getContext() {
    return null;
  }
  getBoundingClientRect() {
    const { left, top, width, height } = this.box;
    return { left, top, width, height, right: left + width, bottom: top + height };
  }
  setPointerCapture() {}
  focus() {
    page.activeElement = this;
  }
  showModal() {
    this.open = true;
  }
  close() {
    this.open = false;
  }
}

/** The element that has the focus. */
export const page: { activeElement: Element | null } = { activeElement: null };

/** What the browser keeps, whether who looks wants nothing to move by itself, and whether the system is dark. */
export const browser = { kept: new Map<string, string>(), still: false, dark: false };

class Select extends Element {}
class Input extends Element {}

const make = (tag: string) => (tag === "select" ? new Select(tag) : tag === "input" ? new Input(tag) : new Element(tag));
const window_ = new Element("#window");
Object.assign(globalThis, {
  document: { createElement: make, createElementNS: (_: string, tag: string) => make(tag) },
  window: Object.assign(globalThis, {
    addEventListener: window_.addEventListener.bind(window_),
    removeEventListener: window_.removeEventListener.bind(window_),
  }),
  HTMLSelectElement: Select,
  HTMLInputElement: Input,
  getComputedStyle: ({ style }: Element) => style,
  ResizeObserver: class {
    observe() {}
  },
  location: { protocol: "http:", hash: "", pathname: "/", search: "" },
  history: { replaceState: (_: unknown, __: string, address: string) => Object.assign(location, { hash: /#.*/.exec(address)?.[0] ?? "" }) },
  matchMedia: (query: string) => ({
    matches: (query.includes("reduced-motion") && browser.still) || (query.includes("dark") && browser.dark),
    addEventListener: () => {},
    removeEventListener: () => {},
  }),
  localStorage: {
    getItem: (key: string) => browser.kept.get(key) ?? null,
    setItem: (key: string, value: string) => browser.kept.set(key, value),
    removeItem: (key: string) => browser.kept.delete(key),
  },
  Path2D: class {
    readonly lines: number[][] = [];
    moveTo(x: number, y: number) {
      this.lines.push([x, y]);
    }
    lineTo(x: number, y: number) {
      this.lines.at(-1)?.push(x, y);
    }
  },
});

/** Another tab of the same browser has kept something. */
export const keptElsewhere = (key: string, newValue: string) => window_.dispatch("storage", { key, newValue });
