// Times of the playground in Chromium: PLAYGROUND=FILE node measure.mjs. Medians of frames that a reader sees, in ms.

import { readFileSync } from "node:fs";
import path from "node:path";
import { mechanism, open, repository } from "./harness.mjs";

const median = (all) => [...all].sort((a, b) => a - b)[Math.floor(all.length / 2)];
const worst = (all) => Math.max(...all);
const one = (all) => `${median(all).toFixed(1)} (worst ${worst(all).toFixed(1)})`;
const shown = (all) => `picture ${one(all.map(([made]) => made))}, on the screen ${one(all.map(([, seen]) => seen))}`;

const browser = await open();
const url = `file://${process.env.PLAYGROUND}`;

/// Replaces the text, and waits for its answers.
const load = async (page, text) => {
  await page.evaluate((next) => {
    const { editor } = globalThis.linkwright;
    editor.replace([{ start: 0, end: new TextEncoder().encode(editor.text()).length, text: next }]);
  }, text);
  await page.waitForTimeout(2500);
};

/// Times from an event to the picture of its answer: `act` runs in the page, `seen` says when the picture is new.
const times = (page, act, count) =>
  page.evaluate(
    async ([body, rounds]) => {
      const run = new Function("round", body);
      const drawing = document.querySelector("[data-part=drawing]");
      const all = [];
      for (let round = 0; round < rounds; round += 1) {
        const changed = new Promise((resolve) => {
          const seen = new MutationObserver(() => {
            seen.disconnect();
            resolve();
          });
          seen.observe(drawing, { childList: true, subtree: true });
        });
        const begun = performance.now();
        run(round);
        await changed;
        const made = performance.now() - begun;
        await new Promise((resolve) => { requestAnimationFrame(() => setTimeout(resolve)); });
        all.push([made, performance.now() - begun]);
        await new Promise((resolve) => { setTimeout(resolve, 40); });
      }
      return all;
    },
    [act, count],
  );

const slide = `
  const slider = document.querySelector(".control input[type=range]");
  const [low, high] = [Number(slider.min), Number(slider.max)];
  slider.value = low + (0.45 + 0.1 * Math.sin(round)) * (high - low);
  slider.dispatchEvent(new Event("input"));`;
const type = (word) => `
  const { editor } = globalThis.linkwright;
  const text = editor.text();
  const at = text.indexOf(${JSON.stringify(word)}) + ${word.length};
  editor.replace([round % 2 ? { start: at, end: at + 1, text: "" } : { start: at, end: at, text: "0" }]);`;

const fourBar = readFileSync(path.join(repository, "tests/descriptions/four_bar_given.mech"), "utf8");
const excavator = readFileSync(mechanism("excavator"), "utf8").replaceAll("0.05*sin", "stroke*sin").replace(/(mechanism \w+ \{)/, "$1\n    param stroke = 0.050;");

const begun = performance.now();
const page = await browser.visit(url);
console.log(`opened and drawn: ${(performance.now() - begun).toFixed(0)}`);
for (const [name, text, number] of [
  ["four_bar", fourBar, "param L2 = 120."],
  ["excavator", excavator, "param stroke = 0.05"],
]) {
  await load(page, text.replace("param L2 = 120mm", "param L2 = 120.0mm"));
  const sliders = await page.locator(".control").count();
  if (sliders) console.log(`${name}: slider moved ${shown(await times(page, slide, 60))}`);
  if (number) console.log(`${name}: key typed ${shown(await times(page, type(number), 40))}`);
}
console.log(browser.said);
await browser.close();
