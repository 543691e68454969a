// Live pages of `view --live`, as a command with the feature writes them.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { mechanism, prepare, repository } from "./harness.mjs";

const live = process.env.LIVE_LINKWRIGHT;
const skip = !live && "LIVE_LINKWRIGHT names no command";

const { browser, made } = prepare();

const view = (...args) => execFileSync(live, ["view", ...args], { encoding: "utf8" });

test("a live page shows the mechanism, its values and its times, and moves when a slider does", { skip }, async () => {
  const file = made.file("live.html");
  view(`${repository}/tests/descriptions/four_bar_given.mech`, "--live", "--set", "L2=13cm", "--to", "2", "--branch", "phi_coupler_phi_rocker=other", "-o", file);
  const page = await browser.visit(`file://${file}`);
  const question = await page.evaluate(() => linkwright.page().question());
  assert.deepEqual([question.values, question.range], [{ L2: "130" }, { from: 0, to: 2, step: 0.01 }]);
  assert.equal(question.assembly, "+");
  assert.ok(await page.$eval(".split", (it) => it.classList.contains("whole")), "the description is hidden at first");
  await page.waitForSelector(".control");
  const place = () => page.$eval('[data-part=drawing] [id="body-coupler"]', (it) => it.getAttribute("transform"));
  const before = await place();
  await page.evaluate(() => {
    const slider = [...document.querySelectorAll(".control")].at(-1).querySelector("input[type=range]");
    slider.value = Number(slider.value) + 10;
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForFunction((old) => document.querySelector('[data-part=drawing] [id="body-coupler"]').getAttribute("transform") !== old, before);
  await page.click("[data-bar=source]");
  assert.match(await page.$eval(".cm-content", (it) => it.textContent), /mechanism four_bar_given/);
  await page.close();
});

test("tables are in the page", { skip }, async () => {
  const file = made.file("table.html");
  view(`${repository}/tests/descriptions/table_of_file.mech`, "--live", "-o", file);
  const page = await browser.visit(`file://${file}`);
  assert.deepEqual(await page.$$eval("[data-part=messages] .error", (all) => all.map((it) => it.textContent)), []);
  assert.ok(await page.evaluate(() => linkwright.page() !== null));
  await page.close();
});

test("what a live page cannot hold is refused, and nothing is written", { skip }, () => {
  const file = made.file("none.html");
  const ran = spawnSync(live, ["view", `${repository}/tests/descriptions/four_bar_given.mech`, "--live", "--set", "crank_angle=3*t", "-o", file], { encoding: "utf8" });
  assert.equal(ran.status, 2);
  assert.match(ran.stderr, /does not set a number/);
  assert.throws(() => readFileSync(file));
  // A file of somebody else stays.
  writeFileSync(file, "mine");
  assert.equal(spawnSync(live, ["view", mechanism("four_bar"), "--live", "-o", file]).status, 2);
  assert.equal(readFileSync(file, "utf8"), "mine");
});
