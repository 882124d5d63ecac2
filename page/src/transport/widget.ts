// A notebook's kernel, by anywidget.

import type { Action, Transport } from "../protocol";
import { deaf, unpackViews, type WithBuffers } from "./frame";

/** What anywidget gives to a widget's view. */
export type Model = {
  on: (event: "msg:custom", listener: (message: WithBuffers, views: DataView[]) => void) => void;
  off: (event: "msg:custom", listener: (message: WithBuffers, views: DataView[]) => void) => void;
  send: (action: Action) => void;
};

export function widgetTransport(model: Model): Transport {
  const listen = (message: WithBuffers, views: DataView[] = []) => transport.onmessage(message, unpackViews(message, views));
  const transport: Transport = {
    ...deaf(),
    open: () => {
      model.on("msg:custom", listen);
      transport.onstatus({ connected: true });
    },
    send: (action) => model.send(action),
    close: () => model.off("msg:custom", listen),
  };
  return transport;
}
