// bayesmap's page: draw walls, drag the robot, watch the posterior. One module, three homes: the page of `bayesmap
// app` (WebSocket), the notebook widget (anywidget), and a file (a recording, or a figure that samples in the page).

import { DAMAGED, takeFragment } from "./fragment";
import { mount, type Handle } from "./mount";
import { keepToken, keptDocument, onToken } from "./state/kept";
import { localTransport, readFigure } from "./transport/local";
import { readRecording, recordedTransport } from "./transport/recorded";
import { webSocketTransport } from "./transport/socket";
import { widgetTransport, type Model } from "./transport/widget";

export { localTransport, mount, readFigure, readRecording, recordedTransport, webSocketTransport, widgetTransport };

const KEPT = "This is the map that was drawn here when the connection was lost; undo leads back";

/** In Safari the last to come of what the page needs (docs/app.md). */
const isTooOld = () => !("DecompressionStream" in window && "adoptedStyleSheets" in document);
const TOO_OLD = "This page needs a newer browser: Safari 16.4, Firefox 121, Chrome 111, or later.";

/** `window.bayesmap` is the page that was shown last. */
const expose = (handle: Handle) => Object.assign(window, { bayesmap: handle });

export default {
  /** anywidget's entry. */
  render({ model, el }: { model: Model; el: HTMLElement }) {
    const host = document.createElement("div");
    el.append(host);
    if (isTooOld()) return void (host.textContent = TOO_OLD);
    const handle = mount(host, widgetTransport(model), { embedded: true });
    expose(handle);
    return () => handle.destroy();
  },
};

/** Shows a recording in an element, and in its place any that is dropped onto it. */
function play(host: HTMLElement, recording: Parameters<typeof recordedTransport>[0]) {
  const handle = mount(host, recordedTransport(recording), { play: replay(host, () => handle) });
  expose(handle);
}
const replay = (host: HTMLElement, shown: () => Handle) => (recording: Parameters<typeof recordedTransport>[0]) => {
  shown().destroy();
  play(host, recording);
};

/** Mounts the page of the server, or the recording of a static export, where a document asks for it. */
async function start() {
  const host = document.querySelector<HTMLElement>("[data-bayesmap]");
  if (!host || host.shadowRoot) return;
  if (isTooOld()) return void (host.textContent = TOO_OLD);
  const sheet = new CSSStyleSheet();
  sheet.replaceSync("body { margin: 0; }");
  document.adoptedStyleSheets.push(sheet);
  const recording = document.querySelector("script[data-recording]");
  if (recording) {
    play(host, await readRecording(recording.textContent ?? ""));
    return;
  }
  const figure = document.querySelector("script[data-figure]");
  if (figure) {
    const [{ document: linked, damaged }, read] = await Promise.all([takeFragment(), readFigure(figure.textContent ?? "")]);
    const notice = damaged ? ({ text: DAMAGED, level: "error" } as const) : null;
    const handle: Handle = mount(host, localTransport(read), { adopt: linked, notice, play: replay(host, () => handle) });
    expose(handle);
    return;
  }
  keepToken(new URLSearchParams(location.search).get("token"));
  const { document: linked, damaged } = await takeFragment();
  const kept = linked ? null : keptDocument();
  const transport = webSocketTransport(() => new URL(location.href));
  onToken((token) => {
    history.replaceState(null, "", `${location.pathname}?token=${encodeURIComponent(token)}${location.hash}`);
    transport.retry?.();
  });
  const notice = damaged ? ({ text: DAMAGED, level: "error" } as const) : kept ? ({ text: KEPT, level: "info" } as const) : null;
  const handle: Handle = mount(host, transport, { adopt: linked ?? kept, notice, play: replay(host, () => handle) });
  expose(handle);
}
start();
