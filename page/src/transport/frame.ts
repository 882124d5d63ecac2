// Messages on the wire.

import type { Buffers, Notice, Numbers, Transport } from "../protocol";

type Entry = { name: string; dtype: string; shape: number[] };
/** A message that says which buffers come with it. */
export type WithBuffers = Notice & { buffers?: Entry[] };

const ARRAYS: { [dtype: string]: { new (buffer: ArrayBuffer): Numbers; readonly BYTES_PER_ELEMENT: number } } = {
  uint8: Uint8Array,
  uint32: Uint32Array,
  float32: Float32Array,
  float64: Float64Array,
};
const ALIGNMENT = 8;

/** A transport that nobody listens to yet. */
export const deaf = (): Pick<Transport, "onmessage" | "onstatus"> => ({ onmessage: () => {}, onstatus: () => {} });

/** A binary frame: length, JSON, buffers padded to 8 bytes. */
export function unpackFrame<Message = Notice>(frame: ArrayBuffer): [Message, Buffers] {
  const length = new DataView(frame).getUint32(0, true);
  const message: Message & { buffers?: Entry[] } = JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 4, length)));
  const buffers: Buffers = {};
  let at = 4 + length;
  for (const { name, dtype, shape } of message.buffers ?? []) {
    const size = shape.reduce((a, b) => a * b, 1) * ARRAYS[dtype].BYTES_PER_ELEMENT;
    buffers[name] = new ARRAYS[dtype](frame.slice(at, at + size));
    at += Math.ceil(size / ALIGNMENT) * ALIGNMENT;
  }
  return [message, buffers];
}

/** Buffers that came beside their message. */
export function unpackViews(message: WithBuffers, views: DataView[]): Buffers {
  const buffers: Buffers = {};
  (message.buffers ?? []).forEach(({ name, dtype }, i) => {
    const { buffer, byteOffset, byteLength } = views[i];
    buffers[name] = new ARRAYS[dtype](buffer.slice(byteOffset, byteOffset + byteLength) as ArrayBuffer);
  });
  return buffers;
}
