// The three providers of a page's numbers give the same ones: a file those of the others in single precision, the server and the solver
// as WebAssembly the same bits.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { folder, linkwright, mechanism, repository, serve } from "./harness.mjs";

const MECHANISMS = ["four_bar", "excavator", "jansen", "platform_3rpr", "stephenson"];

/// The solver as a page runs it, without a browser.
const solver = async () => {
  const { instance } = await WebAssembly.instantiate(readFileSync(process.env.SOLVER));
  const { memory, reserve, reply, replied } = instance.exports;
  return (request) => {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    const place = reserve(bytes.length);
    new Uint8Array(memory.buffer, place, bytes.length).set(bytes);
    const length = reply();
    return JSON.parse(new TextDecoder().decode(new Uint8Array(memory.buffer, replied(), length)));
  };
};

const column = (stored, wide) => {
  if (typeof stored === "number") return [stored];
  const bytes = Uint8Array.from(Buffer.from(stored, "base64"));
  return [...(wide ? new Float64Array(bytes.buffer) : new Float32Array(bytes.buffer))];
};

/// All numbers of the first motion, by quantity.
const numbersOf = (answer) => {
  const [player] = answer.assemblies;
  const places = [...player.coordinates.flat(), ...player.measures, ...(player.forces ?? [])];
  return [player.times, ...places.map((it) => column(answer.columns[it], answer.wide))];
};

const text = (name) => readFileSync(mechanism(name), "utf8");
const asked = { values: {}, range: { from: 0, to: 1, step: 0.01 } };

test("a file, a server and WebAssembly answer alike", { skip: !process.env.SOLVER && "SOLVER names no module" }, async () => {
  const wasm = await solver();
  const made = folder();
  for (const name of MECHANISMS) {
    const server = await serve(mechanism(name));
    const ask = async (question) => (await fetch(new URL("/ask", server.url), { method: "POST", body: JSON.stringify(question) })).json();
    try {
      for (const detail of ["moving", "resting", "sections"]) {
        const question = { ...asked, detail };
        const served = await ask(question);
        const computed = wasm({ ask: { ...question, text: text(name) } });
        // Messages name the file in one of them.
        assert.deepEqual(computed.messages, served.messages, `${name}, ${detail}`);
        assert.deepEqual(computed, served, `${name}, ${detail}`);
      }
      linkwright("view", mechanism(name), "--to", "1", "--force", "-o", made.file("page.html"));
      const html = readFileSync(made.file("page.html"), "utf8");
      const data = JSON.parse(html.match(/<script type="application\/json" id="data">(.*?)<\/script>/s)[1]);
      const live = await ask({ ...asked, detail: "resting" });
      const single = numbersOf(live).map((all, place) => (place === 0 ? all : all.map(Math.fround)));
      const inFile = numbersOf(data);
      assert.equal(inFile.length, single.length, name);
      inFile.forEach((all, place) => {
        // A column that is constant in single precision alone is one number.
        const same = all.length === single[place].length ? single[place] : [...new Set(single[place])];
        assert.deepEqual(place === 0 ? all : all.map(Math.fround), same, `${name}, column ${place}`);
      });
    } finally {
      server.end();
    }
  }
  made.remove();
});

test("a value that is set gives the motion of a description with it", { skip: !process.env.SOLVER && "SOLVER names no module" }, async () => {
  const wasm = await solver();
  const given = readFileSync(`${repository}/tests/descriptions/four_bar_given.mech`, "utf8");
  const set = wasm({ ask: { ...asked, text: given, values: { L2: "130" }, detail: "moving" } });
  const written = wasm({ ask: { ...asked, text: given.replace("L2 = 120mm", "L2 = 130mm"), detail: "moving" } });
  assert.deepEqual(numbersOf(set), numbersOf(written));
  const refused = wasm({ ask: { ...asked, text: given, values: { L2: "1kg" }, detail: "moving" } });
  assert.equal(refused.messages[0].severity, "error");
  assert.equal(refused.assemblies, undefined);
});

test("what is no request is refused, and the next one is answered", { skip: !process.env.SOLVER && "SOLVER names no module" }, async () => {
  const wasm = await solver();
  for (const request of [null, 1, "", "nothing", {}, { ask: 1 }, { ask: { text: 1 } }, { ask: { unknown: 1 } }, { hover: { question: { text: "" }, offset: -1 } }]) {
    assert.ok(wasm(request).refused, JSON.stringify(request));
  }
  assert.equal(wasm({ hover: { question: { text: "mechanism" }, offset: 99 } }), null);
  assert.deepEqual(wasm({ tokens: "" }), []);
});
