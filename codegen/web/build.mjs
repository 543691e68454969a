// Writes the playground as one file: `node build.mjs WASM EDITOR LICENSES OUTPUT`.

import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const folder = path.dirname(fileURLToPath(import.meta.url));
const [wasm, editor, licenses, output] = process.argv.slice(2);
const inside = (...parts) => readFileSync(path.join(folder, ...parts), "utf8");

/// Files that a constant of the page library joins, in their order.
const joined = (name) => {
  const library = inside("../page/src/whole.rs");
  const [, list] = library.match(new RegExp(`const ${name}: &str = ([^;]*);`)) ?? [];
  if (!list) throw new Error(`the library of pages has no ${name}`);
  return [...list.matchAll(/include_str!\("([^"]+)"\)/g)].map(([, file]) => file);
};
const compact = (text) =>
  text
    .split("\n")
    .map((line) => line.trimStart())
    .filter((line) => line && !line.startsWith("//") && !line.startsWith("/*"))
    .map((line) => `${line}\n`)
    .join("");
const ofPage = (...names) => names.flatMap(joined).map((file) => inside("../page/src", file)).join("");
const own = (...files) => files.map((file) => inside("page", file)).join("");

/// Examples, those with which one begins first.
const first = ["four_bar", "two_body", "excavator"];
const mechanisms = path.join(folder, "../../mechanisms");
const names = readdirSync(mechanisms).filter((file) => file.endsWith(".mech")).map((file) => file.replace(/\.mech$/, "")).sort();
const gallery = [...first, ...names.filter((name) => !first.includes(name))].map((name) => ({ name, text: readFileSync(path.join(mechanisms, `${name}.mech`), "utf8") }));

const zipped = (contents) => gzipSync(contents, { level: 9 });

/// Base 85: five letters from # to x without < for four bytes, and one letter more than bytes at the end. It is shorter than Base64.
const letters = (bytes) => {
  let text = "";
  for (let at = 0; at < bytes.length; at += 4) {
    const count = Math.min(4, bytes.length - at);
    const group = Buffer.alloc(4);
    bytes.copy(group, 0, at, at + count);
    const number = group.readUInt32BE();
    for (let place = 4; place >= 4 - count; place -= 1) {
      const digit = Math.floor(number / 85 ** place) % 85;
      text += String.fromCharCode(digit < 25 ? digit + 35 : digit + 36);
    }
  }
  return text;
};
const script = compact(ofPage("SCRIPT", "LIVE_SCRIPT") + own("saved.js", "solver.js", "dragging.js", "playground.js"));
const unpacked = {
  gallery,
  worker: compact(own("worker.js")),
  scripts: [readFileSync(editor, "utf8"), `"use strict";\n(() => {\n${script}})();\n`],
};
const parts = {
  style: compact(ofPage("STYLE", "LIVE_STYLE") + own("playground.css")),
  solver: letters(zipped(readFileSync(wasm))),
  parts: zipped(JSON.stringify(unpacked)).toString("base64"),
  loader: compact(own("loader.js")),
  licenses: readFileSync(licenses, "utf8").replaceAll("<", "‹"),
};
for (const [name, text] of Object.entries(parts)) if (/<\/(script|style)/i.test(text)) throw new Error(`${name} ends its element`);
const page = inside("page/playground.html").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
mkdirSync(path.dirname(output), { recursive: true });
writeFileSync(output, page);
for (const [name, text] of Object.entries(parts)) console.log(`${name.padEnd(10)} ${String(Buffer.byteLength(text)).padStart(9)} bytes`);
console.log(`${"all".padEnd(10)} ${String(Buffer.byteLength(page)).padStart(9)} bytes: ${output}`);
