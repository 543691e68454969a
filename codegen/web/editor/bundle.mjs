// Writes the editor as one script, or the licenses of what is in it: `node bundle.mjs [--licenses] [FILE]`.

import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const folder = path.dirname(fileURLToPath(import.meta.url));
const words = process.argv.slice(2);
const isLicenses = words[0] === "--licenses";
const [file] = isLicenses ? words.slice(1) : words;

const { outputFiles, metafile } = await build({
  absWorkingDir: folder,
  stdin: { contents: 'import { createEditor } from "./editor.js";\nglobalThis.createEditor = createEditor;\n', resolveDir: folder },
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  metafile: true,
  write: false,
});

const write = (name, text) => {
  const target = path.resolve(file ?? path.join(folder, "bundle", name));
  mkdirSync(path.dirname(target), { recursive: true });
  writeFileSync(target, text);
  return target;
};

/** Packages of which the script has at least one byte. */
const packages = () => {
  const [output] = Object.values(metafile.outputs);
  const inputs = Object.entries(output.inputs).filter(([, { bytesInOutput }]) => bytesInOutput > 0);
  const names = inputs.map(([input]) => input.match(/^node_modules\/((?:@[^/]+\/)?[^/]+)\//)?.[1]);
  return [...new Set(names.filter(Boolean))].sort();
};

const license = (name) => {
  const inside = path.join(folder, "node_modules", name);
  const { version, license } = JSON.parse(readFileSync(path.join(inside, "package.json"), "utf8"));
  if (license !== "MIT") throw new Error(`the license of ${name} is ${license}`);
  const text = readdirSync(inside).find((it) => /^licen[sc]e/i.test(it));
  if (!text) throw new Error(`${name} has no text of its license`);
  return `${name} ${version}\n\n${readFileSync(path.join(inside, text), "utf8").trim()}\n`;
};

if (isLicenses) {
  const all = packages();
  write("licenses.txt", all.map(license).join(`\n${"-".repeat(80)}\n\n`));
  console.log(`licenses of ${all.length} packages: ${all.join(", ")}`);
} else {
  const [{ text, contents }] = outputFiles;
  write("editor.js", text);
  console.log(`${contents.length} bytes, ${gzipSync(contents, { level: 9 }).length} with gzip`);
}
