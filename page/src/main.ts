// bayesmap's page: draw walls, drag the robot, watch the posterior. One module, three homes: the page of `bayesmap
// app` (WebSocket), the notebook widget (anywidget), and the static export (a recording inside the file).

import { takeFragment } from "./fragment";
import { mount, type Handle } from "./mount";
import { recordedTransport } from "./transport/recorded";
import { webSocketTransport } from "./transport/socket";
import { widgetTransport, type Model } from "./transport/widget";

export { mount, recordedTransport, webSocketTransport, widgetTransport };

/** `window.bayesmap` is the page that was shown last. */
const expose = (handle: Handle) => Object.assign(window, { bayesmap: handle });

export default {
  /** anywidget's entry. */
  render({ model, el }: { model: Model; el: HTMLElement }) {
    const host = document.createElement("div");
    el.append(host);
    const handle = mount(host, widgetTransport(model), { embedded: true });
    expose(handle);
    return () => handle.destroy();
  },
};

/** Mounts the page of the server, or the recording of a static export, where a document asks for it. */
async function start() {
  const host = document.querySelector<HTMLElement>("[data-bayesmap]");
  if (!host || host.shadowRoot) return;
  const sheet = new CSSStyleSheet();
  sheet.replaceSync("body { margin: 0; }");
  document.adoptedStyleSheets.push(sheet);
  const recording = document.querySelector("script[data-recording]");
  if (recording) {
    expose(mount(host, recordedTransport(JSON.parse(recording.textContent ?? ""))));
    return;
  }
  const url = new URL("socket" + location.search, location.href);
  url.protocol = url.protocol.replace("http", "ws");
  url.hash = "";
  expose(mount(host, webSocketTransport(url.href), { adopt: await takeFragment() }));
}
start();
