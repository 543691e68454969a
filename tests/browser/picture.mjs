// Writes the pictures of pages that README.md and the guide show: `npm run picture`. Those of `rustdoc` are in the folder DOCUMENTATION.

import { readFileSync } from "node:fs";
import path from "node:path";
import { folder, linkwright, mechanism, open, repository, seek } from "./harness.mjs";

const pictures = process.env.PICTURES ?? path.join(repository, "codegen/guide");
const documentation = process.env.DOCUMENTATION ?? path.join(repository, "target/doc");
const made = folder();
const file = made.file("excavator.html");
linkwright("view", mechanism("excavator"), "--out", file);
const browser = await open();
const page = await browser.visit(`file://${file}`, { viewport: { width: 1240, height: 700 } });
await seek(page, 0.6);
await page.evaluate(() => document.getElementById("block-2").scrollIntoView());
await page.hover('#block-2 .equation:nth-of-type(3)');
await page.waitForTimeout(300);
await page.screenshot({ path: path.join(pictures, "view.png") });
if (process.env.PLAYGROUND) {
  const playground = await browser.visit(`file://${process.env.PLAYGROUND}`, { viewport: { width: 1560, height: 760 } });
  // The example of the guide.
  const [, text] = readFileSync(path.join(repository, "codegen/guide/live.md"), "utf8").match(/```mech\n(.*?)```/s);
  await playground.evaluate((next) => {
    const { editor } = globalThis.linkwright;
    editor.replace([{ start: 0, end: new TextEncoder().encode(editor.text()).length, text: next }]);
  }, text);
  await playground.waitForTimeout(2500);
  await seek(playground, 0.4);
  await playground.screenshot({ path: path.join(pictures, "playground.png") });
}
const documented = await browser.show(`file://${documentation}/linkwright_mechanisms/four_bar/index.html`, {
  viewport: { width: 1100, height: 1300 },
});
await documented.evaluate(() => {
  const all = [...document.querySelectorAll(".linkwright-page summary")];
  all.find((it) => it.textContent.startsWith("Block 2.")).parentElement.open = true;
});
await documented.screenshot({ path: path.join(pictures, "rustdoc.png") });
await browser.close();
made.remove();
