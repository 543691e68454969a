// Does the grammar color every description of the repository, and each word as what it is?

"use strict";

const assert = require("node:assert");
const fs = require("node:fs");
const path = require("node:path");
const { test } = require("node:test");
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

const extension = path.resolve(__dirname, "..");
const repository = process.env.REPOSITORY ?? path.resolve(extension, "../../..");

async function grammar() {
  const wasm = fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm"));
  await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
  const onigLib = Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  });
  const file = path.join(extension, "syntaxes/mech.tmLanguage.json");
  const loadGrammar = async () => textmate.parseRawGrammar(fs.readFileSync(file, "utf8"), file);
  return new textmate.Registry({ onigLib, loadGrammar }).loadGrammar("source.mech");
}

const loaded = grammar();

/// The tokens of a text: each with its words and its innermost scope, without the blanks between them.
async function tokens(text) {
  const found = [];
  let state = textmate.INITIAL;
  for (const line of text.split("\n")) {
    const read = (await loaded).tokenizeLine(line, state);
    state = read.ruleStack;
    for (const { startIndex, endIndex, scopes } of read.tokens) {
      const word = line.slice(startIndex, endIndex).trim();
      if (word !== "") {
        found.push([word, scopes.at(-1).replace(/\.mech$/, "")]);
      }
    }
  }
  return found;
}

/// The descriptions in a folder and those in it.
function descriptions(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const inner = path.join(folder, entry.name);
    const isOther = ["target", "node_modules"].includes(entry.name) || entry.name.startsWith(".");
    if (entry.isDirectory() && !isOther) {
      return descriptions(inner);
    }
    return entry.isFile() && entry.name.endsWith(".mech") ? [inner] : [];
  });
}

test("every word of every description is colored", async () => {
  const files = descriptions(repository);
  assert.ok(files.length >= 90, `only ${files.length} descriptions`);
  const seen = new Set();
  for (const file of files.filter((it) => !it.includes("errors"))) {
    const text = fs.readFileSync(file, "utf8");
    // What is written, without comments and files, by the rules of the language alone.
    let depth = 0;
    const written = text.replace(/"[^"\n]*"|\/\/[^\n]*|\/\*|\*\/|[^/*"]+|[/*]/g, (part) => {
      depth += part === "/*" ? 1 : part === "*/" ? -1 : 0;
      const isComment = depth > 0 || part === "*/" || part.startsWith("//");
      return isComment || part.startsWith('"') ? " " : part;
    });
    const expected = written.match(/[A-Za-z_]\w*|\d\w*/g) ?? [];
    const found = await tokens(text);
    const words = [];
    for (const [word, scope] of found) {
      assert.notStrictEqual(scope, "source", `${file}: ${word} has no color`);
      seen.add(scope);
      if (!/^(comment|string)/.test(scope)) {
        words.push(...(word.match(/[A-Za-z_]\w*|\d\w*/g) ?? []).map((it) => [it, scope]));
      }
    }
    // A unit is a token of its own behind its number.
    const joined = words.map(([word]) => word).join("");
    assert.strictEqual(joined, expected.join(""), file);
  }
  for (const scope of [
    "comment.line.documentation",
    "comment.line.double-slash",
    "constant.numeric",
    "entity.name",
    "keyword.control.statement",
    "keyword.other.clause",
    "keyword.other.unit",
    "storage.type.joint",
    "storage.type.quantity",
    "support.function",
    "support.function.law",
    "variable.other",
  ]) {
    assert.ok(seen.has(scope), `nothing is a ${scope}`);
  }
});

test("each word is what it is", async () => {
  const text = `/// Docs.
mechanism m { // one
    param L = 1.5e-3mm;
    body 1 at A turned 30deg { A, t: (L, 0) }
    redundant revolute P(1, ground);
    translational (1, two) along A -> 1.P;
    drive free_one: phi(1) = if t < 2s { 4.5N/mm*sin(t) } else { pi };
    drive length(A, B) = sequence(t, cycloidal, (0, 0), (1, 1));
    free swing: phi(1) = 0.2 rate 1.5;
    equation x(1) + K.y = distance(A, B);
    table f = "f.csv" columns (a, 2) in (deg, mm) periodic;
    output velocity K, phi(1);
    gravity = (0, -9.81m/s^2); monitor;
    repeat i from 1 to 3 { part leg[i] = cell(size = 2mm) at (i, 0); }
    /* two /* inner */ const */ effort;
}`;
  const found = await tokens(text);
  const scopes = (word) => found.filter(([it]) => it === word).map(([, scope]) => scope);
  const expect = (word, ...expected) => assert.deepStrictEqual(scopes(word), expected, word);
  const statement = "keyword.control.statement";
  for (const word of ["mechanism", "param", "body", "redundant", "free", "equation", "table"]) {
    expect(word, statement);
  }
  for (const word of ["output", "gravity", "monitor", "effort", "repeat", "part"]) {
    expect(word, statement);
  }
  expect("drive", statement, statement);
  expect("m", "entity.name");
  expect("L", "entity.name", "variable.other");
  expect("leg", "entity.name");
  expect("i", "entity.name", "variable.other", "variable.other");
  expect("from", "keyword.other.clause");
  expect("1.5e-3", "constant.numeric");
  expect("mm", "keyword.other.unit", "variable.other", "keyword.other.unit");
  expect("deg", "keyword.other.unit", "variable.other");
  expect("m/s^2", "keyword.other.unit");
  expect("N/mm", "keyword.other.unit");
  expect("at", "keyword.other.clause", "keyword.other.clause");
  expect("rate", "keyword.other.clause");
  expect("along", "keyword.other.clause");
  expect("if", "keyword.other.clause");
  expect("else", "keyword.other.clause");
  expect("revolute", "storage.type.joint");
  expect("P", "entity.name", "variable.other");
  expect("translational", "storage.type.joint");
  expect("ground", "variable.language");
  expect("free_one", "entity.name");
  expect("phi", "storage.type.quantity", "storage.type.quantity", "support.function.coordinate");
  expect("length", "storage.type.quantity");
  expect("sin", "support.function");
  expect("distance", "support.function");
  expect("sequence", "support.function.law");
  expect("cycloidal", "support.function.law");
  expect("x", "support.function.coordinate");
  expect("y", "variable.other.property");
  expect("pi", "constant.language");
  expect("t", "variable.other", "constant.language", "constant.language", "constant.language");
  expect("velocity", "support.constant.level");
  expect("periodic", "support.constant.ends");
  expect('f.csv', "string.quoted.double");
  expect("/// Docs.", "comment.line.documentation");
  expect("// one", "comment.line.double-slash");
  expect("->", "keyword.operator.direction");
  // A comment in a comment ends with it.
  assert.ok(found.some(([word, scope]) => word === "const" && scope === "comment.block"));
});
