// The editor of the playground in a browser, with answers that are computed here: colors, marks, proposals and texts at the right
// letters, whatever their width, and nothing that the page's policy refuses.

import assert from "node:assert/strict";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { prepare, repository } from "./harness.mjs";

const sources = path.join(repository, "codegen/web/editor");
const bundle = process.env.EDITOR_BUNDLE ?? path.join(sources, "bundle/editor.js");

const POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'";

/// The widths of the first line are 1, 2, 3 and 4 bytes in UTF-8; the last takes two units of UTF-16.
const TEXT = "// aä€𝕏 Länge\npoint Ö1 = (120mm, 3);\npoint P = (1, 2);\n";

/// A page with an editor, and answers: words, numbers and comments are tokens, names are proposed, `P` has a text.
const html = (script) => `<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${POLICY}">
<title>editor</title><style>
:root { color-scheme: light dark; --ink: #111; --paper: #fff; --soft: #eee; --line: #ccc; --note: #666; --accent: #00f; --bad: #f00; --warn: #fa0; }
</style><body><button id="before">before</button><div id="editor" style="height: 400px"></div><button id="after">after</button>
<script>${script}</script><script>
const bytes = (text) => new TextEncoder().encode(text).length;
window.asked = { tokens: 0, complete: [], hover: [] };
window.changes = [];
window.delay = 0;
const later = (value) => new Promise((resolve) => setTimeout(() => resolve(value), window.delay));
const kinds = [["comment", /^\\/\\/.*/], ["keyword", /^point\\b/], ["name", /^[\\p{L}_][\\p{L}\\d_]*/u], ["number", /^\\d+/], ["operator", /^[^\\s]/u]];
const tokens = (text) => {
  window.asked.tokens += 1;
  const all = [];
  for (let at = 0; at < text.length; ) {
    const rest = text.slice(at);
    const [kind, match] = kinds.map(([kind, form]) => [kind, rest.match(form)]).find(([, match]) => match) ?? [];
    const length = match ? match[0].length : 1;
    if (match) all.push([bytes(text.slice(0, at)), bytes(text.slice(0, at + length)), kind]);
    at += length;
  }
  return later(all);
};
const complete = (text, offset) => {
  window.asked.complete.push(offset);
  const start = offset - text.slice(0, text.length).split("\\n").at(-2).match(/\\w*$/)[0].length;
  return later(["revolute", "redundant", "reaction"].map((it) => (
    { label: it, kind: "keyword", detail: "statement", documentation: "see \`P\` <b>bold</b>", start, end: offset, text: it })));
};
const hover = (text, offset) => {
  window.asked.hover.push(offset);
  const start = bytes(text.slice(0, text.indexOf("P =")));
  return later(offset < start || offset > start + 1 ? null : { start, end: start + 1, text: "\`\`\`mech\\npoint P\\n\`\`\`\\n\\npoint with \`x\`\\n\\n- one\\n- <img src=x>" });
};
window.editor = createEditor(document.getElementById("editor"), {
  text: ${JSON.stringify(TEXT)}, label: "Mechanism", tokens, complete, hover,
  change: (text) => window.changes.push(text),
  messages: [{ severity: "error", code: "K11", text: "no unit is named \`mm\`\\n  |", start: bytes("// aä€𝕏 Länge\\npoint Ö1 = (120"), end: bytes("// aä€𝕏 Länge\\npoint Ö1 = (120mm") },
             { severity: "warning", code: "K17", text: "without a place", start: null, end: null }],
});
document.body.dataset.ready = "";
</script></body></html>`;

const { browser, made } = prepare(() => writeFileSync(made.file("editor.html"), html(readFileSync(bundle, "utf8"))));

const visit = () => browser.visit(`file://${made.file("editor.html")}`);

const textOf = (page) => page.evaluate(() => editor.text());

/// The texts with a class, joined where an element is split.
const texts = (page, selector) => page.$$eval(selector, (all) => all.map((it) => it.textContent));

const colored = (page, expected) =>
  page.waitForFunction(
    (expected) => {
      const all = [...document.querySelectorAll(".linkwright-token")];
      return JSON.stringify(all.map((it) => [it.textContent, it.className.split("linkwright-").at(-1)])) === JSON.stringify(expected);
    },
    expected,
    { timeout: 2000 },
  );

const operators = (text) => [...text].map((it) => [it, "operator"]);

const line = (digits, other) => [["point", "keyword"], ...operators("=("), [digits, "number"], ...operators(","), [other, "number"], ...operators(");")];

test("offsets in bytes and in units of UTF-16 belong to the same letters", async () => {
  const { Offsets } = await import(path.join(sources, "offsets.js"));
  for (const text of ["", "plain", "ä", "𝕏", "aä€𝕏b", "€€\n𝕏𝕏ä", TEXT]) {
    const offsets = new Offsets(text);
    let [unit, byte] = [0, 0];
    for (const letter of text) {
      const bytes = Buffer.byteLength(letter);
      for (let inside = 0; inside < letter.length; inside += 1) assert.equal(offsets.byte(unit + inside), byte, text);
      for (let inside = 0; inside < bytes; inside += 1) assert.equal(offsets.unit(byte + inside), unit, text);
      unit += letter.length;
      byte += bytes;
    }
    for (const beyond of [0, 1, 99]) assert.deepEqual([offsets.byte(unit + beyond), offsets.unit(byte + beyond)], [byte, unit], text);
  }
});

test("the script asks for nothing and evaluates nothing", () => {
  const forbidden = /innerHTML|outerHTML|insertAdjacentHTML|document\.write|XMLHttpRequest|WebSocket|EventSource|sendBeacon|\bfetch\(|\bimport\(|\beval\(|new Function/;
  for (const name of readdirSync(sources).filter((it) => it.endsWith(".js"))) {
    assert.doesNotMatch(readFileSync(path.join(sources, name), "utf8"), forbidden, name);
  }
  const script = readFileSync(bundle, "utf8");
  assert.equal(script.match(forbidden), null);
  assert.ok(gzipSync(script, { level: 9 }).length <= 130_000);
});

test("letters of every width are colored, also after a change", async () => {
  const page = await visit();
  const first = ["// aä€𝕏 Länge", "comment"];
  await colored(page, [first, ...line("120", "3"), ...line("1", "2")]);
  await page.evaluate((text) => editor.select(new TextEncoder().encode(text).length), "// aä€𝕏 Länge\npoint Ö1 = (12");
  await page.keyboard.type("7");
  assert.equal(await textOf(page), TEXT.replace("120", "1270"));
  await colored(page, [first, ...line("1270", "3"), ...line("1", "2")]);
  // Until tokens arrive, colors move with their letters.
  await page.evaluate(() => {
    delay = 300;
  });
  const before = await page.evaluate(() => asked.tokens);
  await page.keyboard.type("€");
  await page.waitForFunction((before) => asked.tokens > before, before);
  await colored(page, [first, ...line("127€0", "3"), ...line("1", "2")]);
  // The late answer about this text is dropped.
  await page.evaluate(() => {
    delay = 0;
  });
  await page.keyboard.type("ä");
  const split = line("127", "3").toSpliced(4, 0, ["€", "operator"]);
  await colored(page, [first, ...split, ...line("1", "2")]);
  await page.waitForTimeout(400);
  await colored(page, [first, ...split, ...line("1", "2")]);
  await page.close();
});

test("a message marks its letters and can be read", async () => {
  const page = await visit();
  assert.deepEqual(await texts(page, ".cm-lintRange-error"), ["mm"]);
  assert.equal(await page.$$eval(".cm-lint-marker-error", (all) => all.length), 1);
  const style = await page.$eval(".cm-lintRange-error", (it) => [getComputedStyle(it).textDecorationStyle, getComputedStyle(it).backgroundImage]);
  assert.deepEqual(style, ["wavy", "none"]);
  await page.hover(".cm-lintRange-error");
  await page.waitForSelector(".linkwright-message");
  assert.deepEqual(await texts(page, ".linkwright-message"), ["no unit is named `mm`\n  |"]);
  // A mark follows its letters, and messages about an older text are not shown.
  await page.evaluate(() => editor.replace([{ start: 0, end: 2, text: "//€" }]));
  assert.deepEqual(await texts(page, ".cm-lintRange-error"), ["mm"]);
  await page.evaluate((old) => editor.show([], old), TEXT);
  assert.deepEqual(await texts(page, ".cm-lintRange-error"), ["mm"]);
  await page.evaluate(() => editor.show([]));
  assert.deepEqual(await texts(page, ".cm-lintRange-error"), []);
  await page.close();
});

test("words are proposed and written", async () => {
  const page = await visit();
  const end = Buffer.byteLength(TEXT);
  await page.evaluate((end) => editor.select(end), end);
  await page.keyboard.type("re\n");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("End");
  await page.keyboard.press("Control+Space");
  await page.waitForSelector(".cm-tooltip-autocomplete li");
  assert.deepEqual((await texts(page, ".cm-tooltip-autocomplete li .cm-completionLabel")).sort(), ["reaction", "redundant", "revolute"]);
  assert.deepEqual(await page.evaluate(() => asked.complete.at(-1)), end + 2);
  await page.waitForSelector(".cm-completionInfo");
  assert.deepEqual(await texts(page, ".cm-completionInfo p"), ["see P <b>bold</b>"]);
  await page.keyboard.type("vol");
  await page.waitForFunction(() => document.querySelectorAll(".cm-tooltip-autocomplete li").length === 1);
  // For a moment, a list that has just opened takes no key.
  await page.waitForTimeout(100);
  await page.keyboard.press("Enter");
  assert.equal(await textOf(page), `${TEXT}revolute\n`);
  await page.close();
});

test("a text beside the pointer has elements, and what is written as HTML stays text", async () => {
  const page = await visit();
  const place = await page.evaluate(() => {
    const lines = [...document.querySelectorAll(".cm-line")];
    const range = document.createRange();
    const walk = document.createTreeWalker(lines[2], NodeFilter.SHOW_TEXT);
    for (let node = walk.nextNode(); node; node = walk.nextNode()) {
      const at = node.data.indexOf("P");
      if (at < 0) continue;
      range.setStart(node, at);
      range.setEnd(node, at + 1);
      const { x, y, width, height } = range.getBoundingClientRect();
      return { x: x + width / 3, y: y + height / 2 };
    }
    return null;
  });
  await page.mouse.move(place.x, place.y);
  await page.waitForSelector(".cm-tooltip-hover .linkwright-markdown");
  const shown = await page.$eval(".linkwright-markdown", (it) => [...it.children].map((child) => `${child.tagName}: ${child.textContent}`));
  assert.deepEqual(shown, ["PRE: point P", "P: point with x", "UL: one<img src=x>"]);
  assert.equal(await page.$$eval(".linkwright-markdown code, .linkwright-markdown li", (all) => all.length), 3);
  const before = Buffer.byteLength(TEXT.slice(0, TEXT.indexOf("P =")));
  assert.ok((await page.evaluate(() => asked.hover)).some((it) => it === before || it === before + 1));
  await page.close();
});

test("changes are undone in steps, and a drag is one step", async () => {
  const page = await visit();
  const start = Buffer.byteLength(TEXT.slice(0, TEXT.indexOf("120")));
  const drag = (text, length, isJoined) =>
    page.evaluate(([start, text, length, isJoined]) => editor.replace([{ start, end: start + length, text }], isJoined), [start, text, length, isJoined]);
  await drag("121", 3, false);
  await drag("1300", 3, true);
  await drag("140", 4, true);
  const dragged = TEXT.replace("120", "140");
  assert.equal(await textOf(page), dragged);
  await drag("150", 3, false);
  await page.evaluate(() => editor.undo());
  assert.equal(await textOf(page), dragged);
  await page.evaluate(() => editor.undo());
  assert.equal(await textOf(page), TEXT);
  await page.evaluate(() => editor.redo());
  assert.equal(await textOf(page), dragged);
  assert.equal(await page.evaluate(() => changes.length), 7);
  assert.equal(await page.evaluate(() => changes.at(-1)), dragged);
  // By keys.
  await page.evaluate(() => editor.focus());
  await page.keyboard.press("Control+z");
  assert.equal(await textOf(page), TEXT);
  // Another text begins anew.
  await page.evaluate(() => editor.set("point Ä = (7, 8);"));
  await page.evaluate(() => editor.undo());
  assert.equal(await textOf(page), "point Ä = (7, 8);");
  await colored(page, line("7", "8"));
  assert.equal(await page.evaluate(() => changes.length), 8);
  await page.close();
});

test("the editor has a name, Tab leaves it, and it can be removed", async () => {
  const page = await visit();
  const content = await page.$eval(".cm-content", (it) => ({
    name: it.getAttribute("aria-label"),
    description: document.getElementById(it.getAttribute("aria-describedby")).textContent,
  }));
  assert.equal(content.name, "Mechanism");
  assert.match(content.description, /Tab leaves the editor/);
  const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.className);
  await page.focus("#before");
  await page.keyboard.press("Tab");
  assert.match(await focused(), /cm-content/);
  await page.keyboard.press("Tab");
  assert.equal(await focused(), "after");
  assert.equal(await textOf(page), TEXT);
  const paper = () => page.$eval(".cm-editor", (it) => getComputedStyle(it).backgroundColor);
  assert.equal(await paper(), "rgb(255, 255, 255)");
  await page.evaluate(() => document.documentElement.style.setProperty("--paper", "#101010"));
  assert.equal(await paper(), "rgb(16, 16, 16)");
  await page.evaluate(() => editor.destroy());
  assert.equal(await page.$eval("#editor", (it) => it.childElementCount), 0);
  await page.close();
});
