// Light, dark, or as the system is: the choice is remembered.

import { THEMES, type Theme } from "./colour";

const KEY = "bayesmap-theme";
const NEXT = { auto: "light", light: "dark", dark: "auto" } as const;
type Choice = keyof typeof NEXT;

export class ThemeChoice {
  theme: Theme = THEMES.light;
  private readonly media = matchMedia("(prefers-color-scheme: dark)");
  private choice: Choice = "auto";
  private readonly listen = () => this.dress();

  /** `dressed` is told the name of the choice after every change. */
  constructor(
    private readonly app: HTMLElement,
    private readonly dressed: (name: string) => void,
  ) {
    const kept = remembered();
    if (kept && kept in NEXT) this.choice = kept as Choice;
    this.media.addEventListener("change", this.listen);
  }

  /** Colours the page. */
  dress() {
    const dark = this.choice === "dark" || (this.choice === "auto" && this.media.matches);
    const theme = (this.theme = dark ? THEMES.dark : THEMES.light);
    this.app.dataset.theme = dark ? "dark" : "light";
    const { truth, ray, noReturn: miss, sensor, hatch, unobserved, draw, ghost, belief } = theme;
    for (const [name, value] of Object.entries({ truth, ray, miss, sensor, hatch, unobserved, draw, ghost, belief })) {
      this.app.style.setProperty(`--${name}`, value);
    }
    this.dressed(this.choice === "auto" ? "automatic" : this.choice);
  }

  next() {
    this.choice = NEXT[this.choice];
    try {
      localStorage.setItem(KEY, this.choice);
    } catch {
      // the choice holds for this page only
    }
    this.dress();
  }

  destroy() {
    this.media.removeEventListener("change", this.listen);
  }
}

function remembered() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null; // a page without storage
  }
}
