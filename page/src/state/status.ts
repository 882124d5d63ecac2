// The one line that says how things are.

export type Level = "info" | "warning" | "error";

/** With a capital. */
export const sentence = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** What was said holds until a later action has been done. */
export class Status {
  text = "Connecting";
  level: Level = "info";
  private until = 0;

  /** Says something that holds until an action after number `until` is confirmed. */
  say(text: string, level: Level, until: number) {
    this.text = sentence(text);
    this.level = level;
    this.until = until;
  }

  /** Actions up to a number are confirmed. */
  confirmed(seq: number) {
    const overcome = seq > this.until && !/worker/.test(this.text);
    if (this.text === "Connecting" || overcome) this.say("Ready", "info", seq);
  }

  worker(state: string) {
    if (state === "restarted") this.say("The worker stopped and is being started again; the map is kept", "warning", this.until);
    else if (state === "ready" && this.text === "Connecting") this.say("Ready", "info", this.until);
    else if (state === "ready" && /worker/.test(this.text)) this.say("The worker runs again", "info", this.until);
  }
}
