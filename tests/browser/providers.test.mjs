// The three providers of a page's numbers give the same ones: a file those of the others in single precision, the server and the solver
// as WebAssembly the same bits.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { folder, linkwright, mechanism, repository, serve } from "./harness.mjs";

/// Links that forces move: products of matrices of this size differ among processors unless their order is fixed.
const LINKS = Array.from({ length: 7 }, (_, index) => index + 1);
const CHAIN = `mechanism chain {
    point P0 = (0, 0), ${LINKS.map((it) => `P${it} = (0.${it}, 0)`).join(", ")};
    ${LINKS.map((it) => `body b${it} at P${it - 1} { P${it - 1}, P${it} }`).join("\n    ")}
    revolute P0(ground, b1);
    ${LINKS.slice(1).map((it) => `revolute P${it - 1}(b${it - 1}, b${it});`).join("\n    ")}
    ${LINKS.map((it) => `free s${it}: phi(b${it}) = 0;`).join("\n    ")}
    ${LINKS.map((it) => `mass b${it} = 1kg at P${it} inertia 0.001;`).join("\n    ")}
    gravity = (0, -9.81);
}
`;

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

const asked = { values: {}, range: { from: 0, to: 1, step: 0.01 } };

test("a file, a server and WebAssembly answer alike", { skip: !process.env.SOLVER && "SOLVER names no module" }, async () => {
  const wasm = await solver();
  const made = folder();
  writeFileSync(made.file("chain.mech"), CHAIN);
  const driven = ["four_bar", "excavator", "jansen", "platform_3rpr", "stephenson"].map(mechanism);
  for (const file of [...driven, `${repository}/tests/descriptions/free_linkage.mech`, made.file("chain.mech")]) {
    const name = path.basename(file);
    const server = await serve(file);
    const ask = async (question) => (await fetch(new URL("/ask", server.url), { method: "POST", body: JSON.stringify(question) })).json();
    try {
      for (const detail of ["moving", "resting", "sections"]) {
        const question = { ...asked, detail };
        const served = await ask(question);
        const computed = wasm({ ask: { ...question, text: readFileSync(file, "utf8") } });
        // Messages name the file in one of them.
        assert.deepEqual(computed.messages, served.messages, `${name}, ${detail}`);
        assert.deepEqual(computed, served, `${name}, ${detail}`);
      }
      linkwright("view", file, "--to", "1", "--force", "-o", made.file("page.html"));
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

test("a server and WebAssembly start a motion under forces alike from where a point is pulled to", { skip: !process.env.SOLVER && "SOLVER names no module" }, async () => {
  const wasm = await solver();
  const file = `${repository}/tests/descriptions/free_linkage.mech`;
  const server = await serve(file);
  try {
    for (const detail of ["moving", "resting"]) {
      const question = { ...asked, detail, pull: { point: "S_load", to: [0.5, 0.2], t: 0.6 } };
      const response = await fetch(new URL("/ask", server.url), { method: "POST", body: JSON.stringify(question) });
      const served = await response.json();
      assert.deepEqual(wasm({ ask: { ...question, text: readFileSync(file, "utf8") } }), served, detail);
      assert.deepEqual([served.pulled.t, served.pulled.starts, served.pulled.values.length], [0, true, 2]);
      assert.equal(served.assemblies[0].times.length, detail === "moving" ? 1 : 101);
    }
  } finally {
    server.end();
  }
});

test("what is no request is refused, and the next one is answered", { skip: !process.env.SOLVER && "SOLVER names no module" }, async () => {
  const wasm = await solver();
  for (const request of [null, 1, "", "nothing", {}, { ask: 1 }, { ask: { text: 1 } }, { ask: { unknown: 1 } }, { hover: { question: { text: "" }, offset: -1 } }]) {
    assert.ok(wasm(request).refused, JSON.stringify(request));
  }
  assert.equal(wasm({ hover: { question: { text: "mechanism" }, offset: 99 } }), null);
  assert.deepEqual(wasm({ tokens: "" }), []);
});
