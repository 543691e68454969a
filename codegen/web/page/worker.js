"use strict";
// The solver in its own thread: it takes the module first, then one request after another.

let solver = null;

const bytesOf = (letters) => {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(letters);
  const text = atob(letters);
  const bytes = new Uint8Array(text.length);
  for (let index = 0; index < text.length; index += 1) bytes[index] = text.charCodeAt(index);
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
