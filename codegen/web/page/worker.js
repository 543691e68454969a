"use strict";
// The solver in its own thread: it takes the module first, then one request after another.

let solver = null;

/// Bytes of a text in base 85, as the build writes it.
const bytesOf = (text) => {
  const bytes = new Uint8Array(Math.floor((text.length * 4) / 5));
  const group = new DataView(new ArrayBuffer(4));
  for (let at = 0, from = 0; from < text.length; at += 4, from += 5) {
    let number = 0;
    for (let place = from; place < from + 5; place += 1) {
      const code = place < text.length ? text.charCodeAt(place) : 120;
      number = 85 * number + code - (code < 60 ? 35 : 36);
    }
    group.setUint32(0, number);
    bytes.set(new Uint8Array(group.buffer, 0, Math.min(4, bytes.length - at)), at);
  }
  return bytes;
};

const start = async (packed) => {
  const stream = new Blob([bytesOf(packed)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const { instance } = await WebAssembly.instantiate(await new Response(stream).arrayBuffer());
  return instance.exports;
};

const [encoder, decoder] = [new TextEncoder(), new TextDecoder()];

const replied = ({ memory, reserve, reply, replied: place }, text) => {
  const request = encoder.encode(text);
  const address = reserve(request.length);
  new Uint8Array(memory.buffer, address, request.length).set(request);
  const length = reply();
  return decoder.decode(new Uint8Array(memory.buffer, place(), length));
};

onmessage = async ({ data: { packed, request } }) => {
  if (packed) solver = start(packed);
  else postMessage(replied(await solver, request));
};
