// The command, and a page of it in a browser that reports everything it says and asks for.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before } from "node:test";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const repository = process.env.REPOSITORY ?? path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const command = process.env.LINKWRIGHT ?? path.join(repository, "target/release/linkwright");
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

export const mechanism = (name) => path.join(repository, "mechanisms", `${name}.mech`);

/// What the command prints.
export const linkwright = (...args) => execFileSync(command, args, { encoding: "utf8", maxBuffer: 1 << 28 });

/// The solved instant of a mechanism.
export const solved = (file, t, ...args) => {
  const whole = JSON.parse(linkwright("solve", file, "--json", "--at", String(t), ...args));
  return { coordinates: whole.coordinates, ...whole.frames[0] };
};

/// A folder that is removed in the end.
export const folder = () => {
  const made = mkdtempSync(path.join(tmpdir(), "linkwright-browser-"));
  return { file: (name) => path.join(made, name), remove: () => rmSync(made, { recursive: true }) };
};

export const open = async () => {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const said = [];
  const visit = async (url, options = {}) => {
    const page = await browser.newPage({ viewport: { width: 1400, height: 900 }, ...options });
    page.on("console", (message) => said.push(`console: ${message.text()}`));
    page.on("pageerror", (error) => said.push(`error: ${error.message}`));
    page.on("dialog", (dialog) => {
      said.push(`dialog: ${dialog.message()}`);
      dialog.dismiss();
    });
    const own = new URL(url);
    page.on("request", (request) => {
      const asked = new URL(request.url());
      const isOwn = own.protocol === "file:" ? asked.pathname === own.pathname : asked.origin === own.origin;
      if (!isOwn && !["data:", "blob:"].includes(asked.protocol)) said.push(`request: ${asked.href}`);
    });
    await page.goto(url);
    await page.waitForSelector("body[data-ready], #problem");
    return page;
  };
  /// A page that somebody else has written, which may ask for what it needs.
  const show = async (url, options = {}) => {
    const page = await browser.newPage(options);
    await page.goto(url, { waitUntil: "load" });
    return page;
  };
  return { visit, show, said, close: () => browser.close() };
};

/// A browser and a folder for all tests of a file, in which nothing is said on the console and nothing is asked for. `begin` and `end` do
/// what a file needs besides.
export const prepare = (begin = () => {}, end = () => {}) => {
  let [opened, made] = [null, null];
  before(async () => {
    opened = await open();
    made = folder();
    await begin();
  });
  after(async () => {
    await opened.close();
    await end();
    made.remove();
    assert.deepEqual(opened.said, [], "nothing is said on the console, and nothing is asked for");
  });
  return {
    browser: { visit: (...args) => opened.visit(...args), show: (...args) => opened.show(...args) },
    made: { file: (name) => made.file(name) },
  };
};

/// Moves the slider of a page.
export const seek = (page, t) =>
  page.evaluate((value) => {
    const slider = document.querySelector("[data-part=time]");
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
  }, t);

/// The text of a page that is served, and how to end it.
export const serve = async (file) => {
  const server = spawn(command, ["view", file, "--watch", "--port", "0"]);
  let printed = "";
  let complaints = "";
  server.stderr.on("data", (part) => {
    complaints += part;
  });
  const url = await new Promise((resolve, reject) => {
    server.on("exit", (code) => reject(new Error(`it ends with ${code}: ${complaints}`)));
    server.stdout.on("data", (part) => {
      printed += part;
      const found = printed.match(/http:\/\/\S+/);
      if (found) resolve(found[0]);
    });
  });
  return { url, complaints: () => complaints, end: () => server.kill() };
};

/// Opens the choice of curves, and makes the window so high that all charts are drawn.
export const showAllCharts = async (page) => {
  await page.setViewportSize({ width: page.viewportSize().width, height: 3500 });
  await page.evaluate(() => {
    document.querySelector(".chooser").open = true;
  });
  await page.waitForFunction(() => [...document.querySelectorAll(".chart")].every((it) => it.querySelector(".cursor")));
};

/// Violations of the rules of accessibility.
export const violations = async (page) => {
  await page.evaluate(axe);
  return page.evaluate(async () => {
    // The rule does not read formulas, which browsers do.
    globalThis.axe.configure({ rules: [{ id: "empty-table-header", selector: "th:not(:has(mi, mn))" }] });
    for (const section of document.querySelectorAll("article > section")) section.style.contentVisibility = "visible";
    const { violations: all } = await globalThis.axe.run(document, { resultTypes: ["violations"] });
    return all.map(({ id, nodes }) => `${id}: ${nodes.length}, ${nodes.slice(0, 3).map((it) => `${it.html.slice(0, 160)} ${it.failureSummary ?? ""}`).join(" | ")}`);
  });
};
