// A notebook's kernel, by anywidget.

import type { Message, Transport } from "../protocol";
import { deaf, unpackViews } from "./frame";

/** What anywidget gives to a widget's view. */
export type Model = {
  on: (event: "msg:custom", listener: (message: Message, views: DataView[]) => void) => void;
  off: (event: "msg:custom", listener: (message: Message, views: DataView[]) => void) => void;
  send: (message: Message) => void;
};

export function widgetTransport(model: Model): Transport {
  const listen = (message: Message, views: DataView[] = []) => transport.onmessage(message, unpackViews(message, views));
  const transport: Transport = {
    ...deaf(),
    open: () => {
      model.on("msg:custom", listen);
      transport.onstatus({ connected: true });
    },
    send: (message) => model.send(message),
    close: () => model.off("msg:custom", listen),
  };
  return transport;
}
