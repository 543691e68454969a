// A page that is served while its description is edited.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import http from "node:http";
import { test } from "node:test";
import { mechanism, prepare, seek, serve } from "./harness.mjs";

let server;
const text = readFileSync(mechanism("two_body"), "utf8");

const { browser, made } = prepare(
  async () => {
    writeFileSync(made.file("a.mech"), text);
    server = await serve(made.file("a.mech"));
  },
  () => server.end(),
);

/// Saves a text; how long the page takes until something holds, in ms.
const saved = async (page, next, holds, argument) => {
  const start = performance.now();
  writeFileSync(made.file("a.mech"), next);
  await page.waitForFunction(holds, argument, { polling: 20, timeout: 5000 });
  return performance.now() - start;
};

test("an edit arrives within a second, and so does an error, which goes when it is mended", async () => {
  const page = await browser.visit(server.url);
  const hasBody = (name) => document.body.dataset.ready !== undefined && document.querySelector("header")?.innerText.includes(name);
  assert.ok((await page.innerText("header")).includes("The two-body mechanism"));
  await seek(page, 1.5);
  const edited = text.replace("The two-body mechanism of the exam", "The edited mechanism");
  assert.notEqual(edited, text);
  let taken = await saved(page, edited, hasBody, "The edited mechanism");
  assert.ok(taken < 1000, `an edit takes ${taken} ms`);
  // What was looked at is looked at still.
  assert.equal(Number(await page.inputValue('[data-part=time]')), 1.5);

  const broken = edited.replace("revolute P(1, 2);", "revolute R(1, 2);");
  assert.notEqual(broken, edited);
  taken = await saved(page, broken, () => document.getElementById("problem") !== null);
  assert.ok(taken < 1000, `an error takes ${taken} ms`);
  const shown = await page.$eval("#problem", (it) => it.textContent.trim());
  assert.match(shown, /^error\[/);
  assert.ok(server.complaints().includes(shown), `${shown}\nis not what the terminal says:\n${server.complaints()}`);

  taken = await saved(page, text, hasBody, "The two-body mechanism");
  assert.ok(taken < 1000, `mending takes ${taken} ms`);
  assert.equal(await page.$("#problem"), null);
  await page.close();
});

test("nobody else is answered", async () => {
  const url = new URL(server.url);
  assert.equal(url.hostname, "127.0.0.1");
  const status = (path, host, method = "GET") =>
    new Promise((resolve, reject) => {
      const request = http.request({ hostname: url.hostname, port: url.port, path, method, headers: { host } }, (response) => {
        response.resume();
        resolve(response.statusCode);
      });
      request.on("error", reject);
      request.end();
    });
  assert.equal(await status("/", url.host), 200);
  assert.equal(await status("/", "example.com"), 403);
  assert.equal(await status("/", `example.com:${url.port}`), 403);
  assert.equal(await status("/a.mech", url.host), 404);
  assert.equal(await status("/", url.host, "POST"), 405);
});
