// What this browser keeps for a page of this very address and port: the token, so that links need not carry it, and the
// map while the connection is lost, so that it survives its tab. Without storage nothing is kept, and nothing fails.

import type { MapDocument } from "../protocol";

const TOKEN = "bayesmap-token";
const DOCUMENT = "bayesmap-kept";
const TOOLS = "bayesmap-tools";

function stored(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

function store(key: string, value: string | null) {
  try {
    if (value === null) localStorage.removeItem(key);
    else localStorage.setItem(key, value);
  } catch {
    // a page without storage
  }
}

/** Keeps a drawn map until the connection is there again. */
export function keep(document: MapDocument | null) {
  if (document?.source.kind === "simulation" && location.protocol.startsWith("http")) store(DOCUMENT, JSON.stringify(document));
}

export function forget() {
  store(DOCUMENT, null);
}

/** The map that was kept, or null. */
export function keptDocument(): MapDocument | null {
  const text = stored(DOCUMENT);
  try {
    return text && JSON.parse(text);
  } catch {
    return null;
  }
}

/** Whether all tools are shown, as this browser was last asked for. */
export const allTools = () => stored(TOOLS) !== null;
export const showAllTools = (on: boolean) => store(TOOLS, on ? "all" : null);

/** Remembers the token of the page's address. */
export function keepToken(token: string | null) {
  if (token) store(TOKEN, token);
}

/** Tells of another token, which a page that was opened later has brought. Returns what ends that. */
export function onToken(told: (token: string) => void): () => void {
  const listen = (event: StorageEvent) => {
    if (event.key === TOKEN && event.newValue) told(event.newValue);
  };
  window.addEventListener("storage", listen);
  return () => window.removeEventListener("storage", listen);
}
