// The server of `bayesmap app`.

import type { Transport } from "../protocol";
import { deaf, unpackFrame } from "./frame";

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 8000;

/**
 * It reconnects, waiting twice as long each time. `address` is the page's, with its token: a server that is there but
 * refuses it has been started again.
 */
export function webSocketTransport(address: () => URL): Transport {
  let socket: WebSocket | null = null;
  let wait_ms = FIRST_WAIT_MS;
  let timer = 0;
  let closed = false;
  function open() {
    clearTimeout(timer);
    const url = new URL("socket", address());
    url.protocol = url.protocol.replace("http", "ws");
    url.search = address().search;
    const current = new WebSocket(url);
    let opened = false;
    socket = current;
    current.binaryType = "arraybuffer";
    current.onopen = () => {
      opened = true;
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
      const status = { connected: false, retryIn_ms: wait_ms };
      transport.onstatus(status);
      if (!opened) refused(address()).then((refused) => refused && socket === current && transport.onstatus({ ...status, refused }));
      wait_ms = Math.min(LONGEST_WAIT_MS, 2 * wait_ms);
    };
  }
  const transport: Transport = {
    ...deaf(),
    open,
    send: (message) => {
      if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
    },
    read: (file, heard) =>
      new Promise((resolve, reject) => {
        const url = new URL("open", address());
        url.search = address().search;
        url.searchParams.set("name", file.name);
        const request = new XMLHttpRequest(); // fetch does not tell how much it has sent
        request.open("POST", url);
        request.responseType = "arraybuffer";
        request.upload.onprogress = ({ loaded, total }) => heard(loaded / total);
        request.onload = () => (request.status === 200 ? resolve(request.response) : reject(new Error(new TextDecoder().decode(request.response))));
        request.onerror = () => reject(new Error("the connection is lost"));
        request.send(file);
      }),
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

/** Whether a server is there and does not take the token. */
async function refused(address: URL): Promise<boolean> {
  try {
    return (await fetch(address.pathname + address.search, { method: "HEAD", cache: "no-store" })).status === 403;
  } catch {
    return false;
  }
}
