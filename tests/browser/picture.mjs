// Writes the picture of a page that README.md and the guide show: `npm run picture`.

import path from "node:path";
import { folder, linkwright, mechanism, open, repository, seek } from "./harness.mjs";

const made = folder();
const file = made.file("excavator.html");
linkwright("view", mechanism("excavator"), "--out", file);
const browser = await open();
const page = await browser.visit(`file://${file}`, { viewport: { width: 1240, height: 700 } });
await seek(page, 0.6);
await page.evaluate(() => document.getElementById("block-2").scrollIntoView());
await page.hover('#block-2 .equation:nth-of-type(3)');
await page.waitForTimeout(300);
await page.screenshot({ path: path.join(repository, "codegen/guide/view.png") });
await browser.close();
made.remove();
