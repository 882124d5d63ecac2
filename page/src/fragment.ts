// A share link: the page's address with `#m=` and the base64url of the deflated document.

import { deflate, fromBase64, inflate, toBase64 } from "./geometry/bits";
import type { MapDocument } from "./protocol";

/** The fragment that holds a document. */
export async function toFragment(document: MapDocument): Promise<string> {
  const packed = await deflate(new TextEncoder().encode(JSON.stringify(document)));
  return "#m=" + toBase64(packed).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** The document of a fragment, or null if it holds none. Rejects where it is damaged. */
export async function fromFragment(fragment: string): Promise<MapDocument | null> {
  const match = /^#m=([\w-]+)$/.exec(fragment);
  return match && JSON.parse(new TextDecoder().decode(await inflate(fromBase64(match[1]))));
}

export const DAMAGED = "The link's map cannot be read: copy the link again, whole";

/** The document of the address's fragment, which is taken off: a reload shows what has become of it. */
export async function takeFragment(): Promise<{ document: MapDocument | null; damaged: boolean }> {
  const found = await fromFragment(location.hash).catch(() => null);
  const damaged = !found && location.hash.startsWith("#m=");
  if (found) history.replaceState(null, "", location.pathname + location.search);
  return { document: found, damaged };
}
