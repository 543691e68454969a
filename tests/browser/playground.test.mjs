// The playground as a reader uses it: one file that is opened from disk.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { linkwright, mechanism, prepare, repository, solved, violations } from "./harness.mjs";

const file = process.env.PLAYGROUND;
const skip = !file && "PLAYGROUND names no page";
/// Bytes that the page may have, and time for what is computed.
const [LARGEST, PATIENCE] = [2_300_000, 20_000];

const { browser, made } = prepare();

const visit = (fragment = "", options = {}) => browser.visit(`file://${file}${fragment}`, options);
const textOf = (page) => page.evaluate(() => linkwright.editor.text());
const write = (page, text) =>
  page.evaluate((next) => {
    const { editor } = linkwright;
    editor.replace([{ start: 0, end: new TextEncoder().encode(editor.text()).length, text: next }]);
  }, text);
const titled = (page, title) => page.waitForFunction((name) => document.querySelector("#pane-mechanism h1")?.textContent === name, title, { timeout: PATIENCE });
/// Waits until nothing is computed.
const rested = (page) =>
  page.waitForFunction(() => [linkwright.solver, linkwright.patient].every((it) => !it.current && it.waiting.length === 0) && !document.querySelector(".page.old"), null, { timeout: PATIENCE });
const rest = async (page) => {
  await page.waitForTimeout(300);
  await rested(page);
};

const given = () => readFileSync(`${repository}/tests/descriptions/four_bar_given.mech`, "utf8");

/// The playground with a description that has parameters and an input.
const visitGiven = async (options = {}) => {
  const page = await visit("", options);
  await write(page, given());
  await titled(page, "four_bar_given");
  await rest(page);
  return page;
};

test("the file is small, and holds everything", { skip }, () => {
  const html = readFileSync(file, "utf8");
  assert.ok(Buffer.byteLength(html) <= LARGEST, `${Buffer.byteLength(html)} bytes`);
  assert.match(html, /connect-src|default-src 'none'/);
  assert.doesNotMatch(html, /https?:\/\/(?!www\.w3\.org)[^"'\s]*\.(js|css|woff)/);
});

test("an error is underlined where it is, and the motion comes back with its end", { skip }, async () => {
  const page = await visit();
  const text = await textOf(page);
  await write(page, text.replace("revolute D(ground, rocker);", "revolute D(ground, rocke);"));
  await page.waitForSelector(".cm-lintRange-error", { timeout: PATIENCE });
  assert.equal(await page.$eval(".cm-lintRange-error", (it) => it.textContent), "rocke");
  assert.match(await page.$eval("[data-part=messages]", (it) => it.textContent), /rocker/);
  assert.equal(await page.$$eval("[data-part=drawing] svg", (all) => all.length), 1, "the last picture stays");
  await page.click("[data-bar=undo]");
  await page.waitForFunction(() => !document.querySelector(".cm-lintRange-error") && document.querySelector("[data-part=messages]").textContent.trim() === "", null, { timeout: PATIENCE });
  assert.equal(await textOf(page), text);
  await page.close();
});

test("sliders of a parameter and of an input move the joints to where the solver puts them", { skip }, async () => {
  const page = await visitGiven();
  const set = (name, value) =>
    page.evaluate(
      ([of, next]) => {
        const row = [...document.querySelectorAll(".control")].find((it) => it.querySelector("b").textContent === of);
        const field = row.querySelector("input[type=text]");
        field.value = next;
        field.dispatchEvent(new Event("change"));
      },
      [name, value],
    );
  await set("L2", "130");
  await set("crank_angle", "75");
  await rest(page);
  const path = `${repository}/tests/descriptions/four_bar_given.mech`;
  const { coordinates, q } = solved(path, 0, "--set", "L2=130mm", "--set", "crank_angle=75deg");
  const of = (name) => q[coordinates.indexOf(name)];
  const place = await page.evaluate(() => {
    const group = document.querySelector('[data-part=drawing] [id="body-coupler"]');
    const [x, y] = group.getAttribute("transform").match(/translate\(([-\d.]+) ([-\d.]+)\)/).slice(1).map(Number);
    return { x, y, scale: Number(document.querySelector("[data-part=drawing] [id=mechanism]").dataset.scale) };
  });
  assert.ok(Math.abs(place.x - place.scale * of("x_coupler")) < 0.01, JSON.stringify([place, of("x_coupler")]));
  assert.ok(Math.abs(-place.y - place.scale * of("y_coupler")) < 0.01);
  await page.close();
});

test("an address and a saved page hold the text, the values and the times", { skip }, async () => {
  const page = await visitGiven();
  await page.evaluate(() => linkwright.page().choose({ L2: 133 }));
  await page.click("[data-bar=share]");
  await page.waitForFunction(() => location.hash.length > 100);
  const address = await page.evaluate(() => location.hash);
  const downloading = page.waitForEvent("download");
  await page.click("[data-bar=save]");
  const saved = made.file("saved.html");
  await (await downloading).saveAs(saved);
  await page.close();
  for (const [url, isPage] of [[`file://${file}${address}`, false], [`file://${saved}`, true]]) {
    const other = await browser.visit(url);
    assert.equal(await textOf(other), given());
    const values = await other.evaluate(() => linkwright.page().question().values);
    assert.deepEqual(values, { L2: "133" });
    assert.equal(await other.$eval(".split", (it) => it.classList.contains("whole")), isPage);
    await other.close();
  }
  // A saved page saves itself.
  const again = await browser.visit(`file://${saved}`);
  const savedAgain = again.waitForEvent("download");
  await again.click("[data-bar=save]");
  await (await savedAgain).saveAs(made.file("again.html"));
  assert.ok(readFileSync(saved).equals(readFileSync(made.file("again.html"))));
  await again.close();
});

test("hostile addresses and files are read as texts", { skip }, async () => {
  const hostile = `mechanism a { /// <img src=x onerror="document.title='hurt'"><script>document.title='hurt'</script>
    point O = (0, 0); body b at O { O, A: (1, 0) } revolute O(ground, b); drive phi(b) = t; }</script><script>document.title='hurt'</script>`;
  const packed = async (value) => {
    const stream = new Blob([JSON.stringify(value)]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    return `#${Buffer.from(await new Response(stream).arrayBuffer()).toString("base64url")}`;
  };
  const bomb = { text: "x".repeat(30_000_000) };
  const fragments = [
    await packed({ text: hostile, files: { "</script>": "<b>" }, values: { "<b>": "<i>" }, assembly: "<u>" }),
    await packed({ text: hostile.split("</script><script>document")[0] }),
    await packed(bomb),
    await packed({ text: 1 }),
    await packed(null),
    await packed({ text: "", range: { from: 0, to: 1e300, step: 1e-300 } }),
    "#%00%ff", "#AAAA", "#<script>document.title='hurt'</script>", `#${"A".repeat(500_000)}`, "#__proto__",
  ];
  let random = 12345;
  const next = () => (random = (random * 1103515245 + 12345) % 2147483648);
  const good = fragments[0];
  for (let round = 0; round < 12; round += 1) {
    const at = 1 + (next() % (good.length - 1));
    fragments.push(good.slice(0, at) + "ABCDEFGHabcdefgh0123-_"[next() % 22] + good.slice(at + 1));
  }
  const page = await visit(fragments[0]);
  await rested(page);
  for (const fragment of fragments) {
    await page.goto("about:blank");
    await page.goto(`file://${file}${fragment}`);
    await page.waitForFunction(() => globalThis.linkwright?.editor, null, { timeout: PATIENCE });
    await rested(page);
    assert.notEqual(await page.title(), "hurt", fragment.slice(0, 60));
    assert.equal(await page.$$eval("#pane-mechanism img, #pane-mechanism script", (all) => all.length), 0);
  }
  await page.close();
});

test("what takes too long is ended, and the page goes on", { skip }, async () => {
  const page = await visit();
  await page.evaluate(() => {
    const { solver } = linkwright;
    solver.limit = 300;
    solver.worker.terminate();
  });
  const text = await textOf(page);
  await write(page, text.replace("40deg + 3*t", "40deg + 2*t"));
  await page.waitForFunction(() => document.querySelector("[data-part=messages]").textContent.includes("longer than"), null, { timeout: PATIENCE });
  await page.evaluate(() => {
    linkwright.solver.limit = 15000;
  });
  await write(page, text);
  await rest(page);
  assert.equal((await page.$eval("[data-part=messages]", (it) => it.textContent)).trim(), "");
  await page.close();
});

test("every example is solved and drawn", { skip }, async () => {
  const page = await visit();
  const names = await page.$$eval("[data-bar=gallery] option", (all) => all.slice(1).map((it) => it.textContent));
  assert.ok(names.length > 20, String(names));
  for (const [index, name] of names.entries()) {
    await page.selectOption("[data-bar=gallery]", String(index));
    await page.waitForFunction((of) => linkwright.editor.text().includes(of), readFileSync(mechanism(name), "utf8").slice(0, 400), { timeout: PATIENCE });
    await rest(page);
    const messages = await page.$$eval("[data-part=messages] .error", (all) => all.map((it) => it.textContent));
    assert.deepEqual(messages, [], name);
    assert.ok((await page.$$("[data-part=drawing] path")).length > 3, name);
  }
  await page.close();
});

test("a thousand moves of a slider leave the memory as it was", { skip }, async () => {
  const page = await visitGiven();
  const session = await page.context().newCDPSession(page);
  const used = async () => {
    await session.send("HeapProfiler.collectGarbage");
    return (await session.send("Runtime.getHeapUsage")).usedSize;
  };
  const move = (count) =>
    page.evaluate(async (rounds) => {
      const slider = document.querySelector(".control input[type=range]");
      const [low, high] = [Number(slider.min), Number(slider.max)];
      for (let round = 0; round < rounds; round += 1) {
        slider.value = low + (0.5 + 0.1 * Math.sin(round)) * (high - low);
        slider.dispatchEvent(new Event("input"));
        await new Promise((resolve) => { setTimeout(resolve); });
        while (linkwright.solver.current) await new Promise((resolve) => { setTimeout(resolve, 1); });
      }
    }, count);
  await move(100);
  await rest(page);
  const first = await used();
  await move(1000);
  await rest(page);
  const last = await used();
  assert.ok(last < first + 1_500_000, `${first} and ${last} bytes`);
  await page.close();
});

for (const options of [{}, { colorScheme: "dark", viewport: { width: 375, height: 800 } }]) {
  test(`axe finds nothing in the playground ${JSON.stringify(options)}`, { skip }, async () => {
    const page = await visitGiven(options);
    assert.deepEqual(await violations(page), []);
    await write(page, given().replace("revolute D(ground, rocker);", "revolute D(ground, rocke);"));
    await page.waitForSelector(".cm-lintRange-error", { timeout: PATIENCE });
    assert.deepEqual(await violations(page), []);
    await page.click("#tab-rust");
    await page.waitForFunction(() => document.querySelector("#pane-rust > pre").textContent !== "");
    assert.deepEqual(await violations(page), []);
    await page.close();
  });
}

test("code, checks and downloads are those of the command", { skip }, async () => {
  const page = await visit();
  const path = mechanism("four_bar");
  const code = (language) => {
    const target = made.file(`four_bar.${language === "rust" ? "rs" : "c"}`);
    linkwright("generate", path, "--lang", language, "-o", target);
    return readFileSync(target, "utf8");
  };
  for (const [tab, expected] of [["check", linkwright("check", path)], ["rust", code("rust")], ["c", code("c")]]) {
    await page.click(`#tab-${tab}`);
    const pane = `#pane-${tab} > pre`;
    await page.waitForFunction((it) => document.querySelector(it).textContent !== "", pane, { timeout: PATIENCE });
    const text = await page.$eval(pane, (it) => it.textContent);
    // Files of C follow one another.
    assert.equal(tab === "c" ? text.slice(0, expected.length) : text, expected, tab);
  }
  await page.click("#tab-mechanism");
  const downloads = [
    ["mech", readFileSync(path, "utf8")],
    ["latex", linkwright("plan", path, "--format", "latex")],
    ["csv", linkwright("solve", path, "--csv", "-")],
  ];
  const downloaded = async (kind) => {
    const downloading = page.waitForEvent("download");
    await page.selectOption("[data-bar=download]", kind);
    const target = made.file(`download.${kind}`);
    await (await downloading).saveAs(target);
    return readFileSync(target, "utf8");
  };
  for (const [kind, expected] of downloads) assert.equal(await downloaded(kind), expected, kind);
  assert.match(await downloaded("svg"), /^<svg/);
  await page.close();
});
