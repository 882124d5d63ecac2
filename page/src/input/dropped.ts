// Files that are dropped onto the page: a page in one file and a saved run are played, a document is shown.

import type { Buffers, Recording, Transport } from "../protocol";
import type { Session } from "../state/session";
import { unpackFrame } from "../transport/frame";
import { readRecording } from "../transport/recorded";

/** Plays a recording in the place of what is shown. */
export type Play = (recording: [Recording, Buffers]) => void;

/** The text of a file, piece by piece. */
async function read(file: File, heard: (share: number) => void) {
  const decoder = new TextDecoder();
  const reader = file.stream().getReader();
  let [text, done] = ["", 0];
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    text += decoder.decode(piece.value, { stream: true });
    heard((done += piece.value.length) / file.size);
  }
  return text;
}

/** Plays a saved run, which the server reads. */
async function openRun(file: File, session: Session, readRun: NonNullable<Transport["read"]>, play: Play) {
  try {
    const recording = await readRun(file, (share) => session.say(share < 1 ? `Reading ${file.name}: ${Math.round(100 * share)} %` : `Reading ${file.name}: making its picture`));
    play(unpackFrame<Recording>(recording));
  } catch (error) {
    session.say(`The file ${file.name} cannot be shown: ${(error as Error).message}`, "error");
  }
}

export async function openDropped(file: File, session: Session, play: Play | undefined) {
  const { name } = file;
  if (name.endsWith(".nc") && session.transport.read && play) return openRun(file, session, session.transport.read, play);
  if (!/\.(html|json)$/.test(name)) return session.say(`The file ${name} is not read in the page: start bayesmap app with it`, "warning");
  try {
    const text = await read(file, (share) => session.say(`Reading ${name}: ${Math.round(100 * share)} %`));
    const recording = /data-recording>(.*?)<\/script>/s.exec(text)?.[1];
    if (recording && play) play(await readRecording(recording));
    else if (name.endsWith(".json") && !session.recorded) session.bring(JSON.parse(text));
    else session.say(`The file ${name} holds nothing that can be shown here`, "warning");
  } catch {
    session.say(`The file ${name} cannot be read: export it again, whole`, "error");
  }
}
