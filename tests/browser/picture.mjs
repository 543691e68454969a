// Writes the pictures of pages that README.md and the guide show: `npm run picture`. Those of `rustdoc` are in the folder DOCUMENTATION.

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
