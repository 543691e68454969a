// Runs the module that is named on the command line and prints what it prints.

import { readFileSync, writeSync } from 'node:fs';

const text = [];
const decoder = new TextDecoder();
const host = {
  write(start, length) {
    text.push(decoder.decode(new Uint8Array(instance.exports.memory.buffer, start, length)));
  },
};
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), { host });
instance.exports.run();
writeSync(1, text.join(''));
