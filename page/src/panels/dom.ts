// Elements of the DOM, made and kept up to date by hand.

/**
 * An element; properties by name, attributes where the name has a hyphen, listeners where it begins with "on".
 */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: { [name: string]: any } = {},
  ...children: (Node | string | null)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, value);
    else (element as any)[name] = value;
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

/** Sets a property where it differs, so that nothing is announced or laid out twice. */
export function put<T extends object, K extends keyof T>(target: T, name: K, value: T[K]) {
  if (target[name] !== value) target[name] = value;
}

/** The same for an attribute. */
export function mark(target: Element, name: string, value: string) {
  if (target.getAttribute(name) !== value) target.setAttribute(name, value);
}

/** Whether an element has the focus, in whatever tree it stands. */
export const focused = (element: Element) => (element.getRootNode() as ShadowRoot).activeElement === element;

/** A number as text, or a dash. */
export const figure = (value: number | null | undefined, digits: number, unit = "") =>
  value == null || !Number.isFinite(value) ? "\u2013" : value.toFixed(digits) + unit;

/** Offers bytes as a file. */
export function download(name: string, blob: Blob) {
  const url = URL.createObjectURL(blob);
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
