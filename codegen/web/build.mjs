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

const packed = (contents) => gzipSync(contents, { level: 9 }).toString("base64");
const script = compact(ofPage("SCRIPT", "LIVE_SCRIPT") + own("saved.js", "solver.js", "dragging.js", "playground.js"));
const unpacked = {
  gallery,
  worker: compact(own("worker.js")),
  scripts: [readFileSync(editor, "utf8"), `"use strict";\n(() => {\n${script}})();\n`],
};
const parts = {
  style: compact(ofPage("STYLE", "LIVE_STYLE") + own("playground.css")),
  solver: packed(readFileSync(wasm)),
  parts: packed(JSON.stringify(unpacked)),
  loader: compact(own("loader.js")),
  licenses: readFileSync(licenses, "utf8").replaceAll("<", "‹"),
};
for (const [name, text] of Object.entries(parts)) if (/<\/(script|style)/i.test(text)) throw new Error(`${name} ends its element`);
const page = inside("page/playground.html").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
mkdirSync(path.dirname(output), { recursive: true });
writeFileSync(output, page);
for (const [name, text] of Object.entries(parts)) console.log(`${name.padEnd(10)} ${String(Buffer.byteLength(text)).padStart(9)} bytes`);
console.log(`${"all".padEnd(10)} ${String(Buffer.byteLength(page)).padStart(9)} bytes: ${output}`);
