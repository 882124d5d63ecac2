// The server of `bayesmap app`.

import type { Transport } from "../protocol";
import { deaf, unpackFrame } from "./frame";

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 8000;

/** It reconnects, waiting twice as long each time. */
export function webSocketTransport(url: string): Transport {
  let socket: WebSocket | null = null;
  let wait_ms = FIRST_WAIT_MS;
  let timer = 0;
  let closed = false;
  function open() {
    clearTimeout(timer);
    const current = new WebSocket(url);
    socket = current;
    current.binaryType = "arraybuffer";
    current.onopen = () => {
      wait_ms = FIRST_WAIT_MS;
      transport.onstatus({ connected: true });
    };
    current.onmessage = ({ data }) => {
      if (typeof data === "string") transport.onmessage(JSON.parse(data), {});
      else transport.onmessage(...unpackFrame(data));
    };
    current.onclose = () => {
      if (closed || socket !== current) return;
      timer = window.setTimeout(open, wait_ms);
      transport.onstatus({ connected: false, retryIn_ms: wait_ms });
      wait_ms = Math.min(LONGEST_WAIT_MS, 2 * wait_ms);
    };
  }
  const transport: Transport = {
    ...deaf(),
    open,
    send: (message) => {
      if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
    },
    retry: () => {
      wait_ms = FIRST_WAIT_MS;
      if (socket?.readyState !== WebSocket.OPEN) open();
    },
    close: () => {
      closed = true;
      clearTimeout(timer);
      socket?.close();
    },
  };
  return transport;
}
