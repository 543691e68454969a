// Pages as scripts mount them: two beside one another, updates in place, and values that a provider answers for.

import assert from "node:assert/strict";
import { test } from "node:test";
import { mechanism, prepare, seek, serve, violations } from "./harness.mjs";

const servers = new Map();
const { browser } = prepare(undefined, () => {
  for (const server of servers.values()) server.end();
});

/// A served page, whose scripts can mount it again. In the window are `root`, `answer` as a provider would give it, and `mount`.
const visit = async (name, options) => {
  if (!servers.has(name)) servers.set(name, await serve(mechanism(name)));
  const { url } = servers.get(name);
  const html = await (await fetch(url)).text();
  const page = await browser.visit(url, options);
  await page.evaluate((text) => {
    const source = new DOMParser().parseFromString(text, "text/html");
    const data = JSON.parse(source.getElementById("data").textContent);
    globalThis.root = document.querySelector("[data-page]");
    globalThis.structure = source.querySelector("[data-page]").innerHTML;
    const sections = [...source.querySelectorAll("[data-section]")].map((it) => [it.dataset.section, it.innerHTML]);
    globalThis.answer = {
      ...data,
      drawing: source.querySelector("[data-part=drawing]").innerHTML,
      sections: Object.fromEntries(sections),
      range: { from: 0, to: 5, step: 0.01 },
      controls: [
        { name: "rod", kind: "parameter", value: 120, unit: "mm", low: 80, high: 160, guessed: false, docs: "Length of the rod." },
        { name: "ratio", kind: "parameter", value: 0.5, unit: "", low: 0, high: 1, guessed: true, docs: "" },
        { name: "boom", kind: "input", value: null, unit: "m", low: 0.2, high: 0.9, guessed: true, docs: "", law: "0.8 + t/10" },
      ],
    };
  }, html);
  return page;
};

/// Mounts the page again with a provider that answers when `release` is called, with what `respond` makes of the answer.
const provide = (page) =>
  page.evaluate(() => {
    linkwright.page.destroy();
    root.innerHTML = structure;
    Object.assign(globalThis, { asked: [], waiting: [], respond: (all) => all });
    globalThis.release = () => waiting.shift()?.();
    const provider = {
      ask: (question) =>
        new Promise((resolve, reject) => {
          // Text is answered at once.
          if (question.detail === "sections") return resolve({ sections: {} });
          asked.push(question);
          waiting.push(() => {
            try {
              // Values of controls are those of the description.
              resolve(respond({ ...answer }));
            } catch (error) {
              reject(error);
            }
          });
          return undefined;
        }),
    };
    globalThis.live = linkwright.mount(root, answer, provider);
  });

const row = (name) => `.control:has(b:text-is("${name}"))`;
const slide = (page, name, value) =>
  page.locator(`${row(name)} input[type=range]`).evaluate((slider, to) => {
    slider.value = to;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, value);
const type = async (page, name, value) => {
  await page.fill(`${row(name)} input[type=text]`, value);
  await page.press(`${row(name)} input[type=text]`, "Enter");
};
const asked = (page) => page.evaluate(() => asked);
const release = async (page) => {
  await page.evaluate(() => release());
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve)));
};

test("two pages in one document do not disturb one another", async () => {
  const page = await visit("two_body");
  await page.evaluate(() => {
    const other = document.createElement("div");
    other.className = "page other";
    other.innerHTML = structure;
    document.body.append(other);
    globalThis.second = linkwright.mount(other, answer);
  });
  const state = () =>
    page.evaluate(() =>
      [root, document.querySelector(".other")].map((own) => [
        own.querySelector("[id=body-1]").getAttribute("transform"),
        Number(own.querySelector("[data-part=time]").value),
        own.querySelectorAll(".lit").length,
      ]),
    );
  const [first, second] = await state();
  assert.deepEqual(first, second);
  await seek(page, 1.5);
  const moved = await state();
  assert.deepEqual(moved[1], second);
  assert.notEqual(moved[0][0], first[0]);
  // Keys are for the page that was used last.
  await page.locator(".other [data-part=drawing]").click({ position: { x: 5, y: 5 } });
  await page.keyboard.press("End");
  assert.deepEqual((await state()).map((it) => it[1]), [1.5, 5]);
  await page.locator(".other [data-part=time]").focus();
  await page.evaluate(() => document.activeElement.blur());
  await page.hover(".other #phi + .equation b");
  const lit = await state();
  assert.equal(lit[0][2], 0);
  assert.ok(lit[1][2] > 1);
  await page.evaluate(() => {
    second.destroy();
    document.querySelector(".other").remove();
  });
  await page.locator("h1").click();
  await page.keyboard.press("Home");
  assert.equal(await page.inputValue("[data-part=time]"), "0");
  await page.close();
});

test("an update replaces what it has and keeps what the reader has chosen", async () => {
  const page = await visit("excavator");
  const found = await page.evaluate(async () => {
    const part = (name) => root.querySelector(`[data-part="${name}"]`);
    const clickChip = (text) => [...part("chips").querySelectorAll(".chip")].find((it) => it.textContent === text).click();
    const other = answer.assemblies.findIndex((it, index) => index > 0 && it.times);
    part("thumbnails").children[other].click();
    part("speed").value = "0.25";
    part("live").open = true;
    root.querySelector(".chooser").open = true;
    clickChip("xA");
    clickChip("φc1");
    clickChip("B");
    part("time").value = 1.25;
    part("time").dispatchEvent(new Event("input"));
    // Not all browsers keep what is looked at where it is.
    document.documentElement.style.overflowAnchor = "none";
    const focused = root.querySelector('#phi ~ .equation[data-is="j1 e2"]');
    focused.focus();
    scrollTo(0, focused.getBoundingClientRect().top + scrollY - 200);
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const state = () => ({
      time: Number(part("time").value),
      speed: part("speed").value,
      live: part("live").open,
      chooser: root.querySelector(".chooser").open,
      chips: [...part("chips").querySelectorAll("[aria-pressed=true]")].map((it) => it.textContent),
      assembly: [part("assembly").value, [...part("thumbnails").children].findIndex((it) => it.getAttribute("aria-pressed") === "true")],
      paths: root.querySelectorAll(".traces > g").length,
      focus: document.activeElement.dataset.is,
      top: Math.round(document.activeElement.getBoundingClientRect().top / 4),
      playing: part("play").getAttribute("aria-pressed"),
    });
    const before = state();
    const next = {
      ...answer,
      title: "another title",
      drawing: answer.drawing.replace("<title>", "<!-- new --><title>"),
      sections: { ...answer.sections, bodies: `${answer.sections.bodies}${"<p>more</p>".repeat(30)}`, newton: "" },
      messages: [{ severity: "warning", code: "K1", text: "<b>watch</b> out", start: null, end: null }],
    };
    linkwright.page.update(next);
    const atOnce = state();
    await new Promise((resolve) => setTimeout(resolve, 150));
    const after = state();
    const changed = {
      title: root.querySelector("h1").textContent,
      more: root.querySelectorAll("[data-section=bodies] p").length,
      newton: root.querySelector("[data-section=newton]").hidden && root.querySelector('nav a[href="#newton"]').hidden,
      messages: part("messages").textContent,
      copies: root.querySelectorAll("[id=mechanism]").length,
    };
    // A playing page goes on.
    part("play").click();
    linkwright.page.update(answer);
    const playing = part("play").getAttribute("aria-pressed");
    const now = Number(part("time").value);
    await new Promise((resolve) => setTimeout(resolve, 300));
    const later = Number(part("time").value);
    return { before, atOnce, after, changed, playing, now, later };
  });
  assert.deepEqual(found.atOnce, found.before);
  assert.deepEqual(found.after, found.before);
  assert.equal(found.before.time, 1.25);
  assert.ok(found.before.chips.includes("xA") && !found.before.chips.includes("φc1"), String(found.before.chips));
  assert.ok(found.before.assembly[1] > 0);
  assert.deepEqual(found.changed, { title: "another title", more: 30, newton: true, messages: "Warning: <b>watch</b> out", copies: 1 });
  assert.equal(found.playing, "true");
  assert.ok(found.later > found.now && found.later < found.now + 0.5, `${found.now} to ${found.later} at a quarter of the speed`);
  await page.close();
});

test("columns of both precisions are read", async () => {
  const page = await visit("two_body");
  const [narrow, wide] = await page.evaluate(() => {
    const transforms = () => [...root.querySelectorAll("[data-body]")].map((it) => it.getAttribute("transform"));
    const seek = () => {
      const slider = root.querySelector("[data-part=time]");
      slider.value = 1.2345;
      slider.dispatchEvent(new Event("input"));
      return transforms();
    };
    const before = seek();
    const widened = (column) => {
      if (typeof column === "number") return column;
      const bytes = Uint8Array.from(atob(column), (it) => it.charCodeAt(0));
      const doubles = new Uint8Array(Float64Array.from(new Float32Array(bytes.buffer)).buffer);
      return btoa(String.fromCharCode(...doubles));
    };
    linkwright.page.update({ ...answer, wide: true, columns: answer.columns.map(widened) });
    return [before, transforms()];
  });
  assert.deepEqual(wide, narrow);
  await page.close();
});

test("without a provider, values are text", async () => {
  const page = await visit("two_body");
  const panel = await page.evaluate(() => {
    linkwright.page.destroy();
    root.innerHTML = structure;
    linkwright.mount(root, answer);
    const own = root.querySelector("[data-part=panel]");
    return { text: own.innerText.replace(/\s+/g, " "), isHidden: own.hidden, fields: own.querySelectorAll("input, button").length };
  });
  assert.deepEqual(panel, { text: "rod 120 mm ratio 0.5 boom 0.8 + t/10", isHidden: false, fields: 0 });
  await page.close();
});

test("while a slider moves, one question is under way and the newest is next", async () => {
  const page = await visit("four_bar");
  await provide(page);
  await slide(page, "rod", 100);
  await slide(page, "rod", 101);
  await slide(page, "rod", 102);
  let all = await asked(page);
  assert.equal(all.length, 1);
  assert.deepEqual([all[0].values, all[0].detail], [{ rod: "100" }, "moving"]);
  assert.deepEqual(all[0].range, { from: 0, to: 5, step: 0.01 });
  assert.equal(all[0].assembly, await page.evaluate(() => answer.assemblies[0].label));
  await release(page);
  all = await asked(page);
  assert.equal(all.length, 2, "what was passed over is not asked");
  assert.deepEqual([all[1].values, all[1].detail], [{ rod: "102" }, "moving"]);
  // It rests.
  await release(page);
  await page.waitForFunction(() => asked.length === 3);
  all = await asked(page);
  assert.deepEqual([all[2].values, all[2].detail], [{ rod: "102" }, "resting"]);
  // An answer that does not come leaves the picture, marked.
  await page.waitForSelector("[data-page].old [data-part=drawing][aria-busy=true]");
  assert.equal(await page.locator("[data-part=drawing] svg").count(), 1);
  await release(page);
  await page.waitForSelector("[data-page]:not(.old)");
  await page.waitForTimeout(250);
  assert.equal((await asked(page)).length, 3);
  await page.close();
});

test("fields go beyond guessed ends, not beyond declared ones", async () => {
  const page = await visit("four_bar");
  await provide(page);
  const complaint = () => page.textContent(`${row("rod")} .error`);
  await type(page, "rod", "161");
  assert.match(await complaint(), /rod is at most 160 mm/);
  await type(page, "rod", "79");
  assert.match(await complaint(), /rod is at least 80 mm/);
  await type(page, "rod", "much");
  assert.match(await complaint(), /a number/);
  assert.deepEqual(await asked(page), []);
  await type(page, "rod", "159.5");
  assert.equal(await complaint(), "");
  await release(page);
  await type(page, "ratio", "3,5");
  await release(page);
  const [first, second] = await asked(page);
  assert.deepEqual([first.values, first.detail], [{ rod: "159.5" }, "resting"]);
  assert.deepEqual(second.values, { rod: "159.5", ratio: "3.5" });
  const ratio = page.locator(`${row("ratio")} input[type=range]`);
  assert.equal(await ratio.evaluate((it) => Number(it.value)), 3.5);
  assert.match(await ratio.getAttribute("title"), /declares no range/);
  assert.doesNotMatch(await page.getAttribute(`${row("rod")} input[type=range]`, "title"), /declares no range/);
  // An input has its law until it has a value.
  assert.equal(await page.getAttribute(`${row("boom")} input[type=text]`, "placeholder"), "0.8 + t/10");
  assert.equal(await page.inputValue(`${row("boom")} input[type=text]`), "");
  await type(page, "boom", "0.5");
  await release(page);
  assert.equal((await asked(page)).at(-1).values.boom, "0.5");
  for (const name of ["boom", "rod"]) {
    await page.click(`${row(name)} button`);
    await release(page);
  }
  const last = (await asked(page)).at(-1);
  assert.deepEqual(last.values, { ratio: "3.5" });
  assert.equal(await page.inputValue(`${row("rod")} input[type=text]`), "120");
  // Range and assembly.
  await page.fill(".range label:has-text('to') input", "-1");
  await page.press(".range label:has-text('to') input", "Enter");
  assert.match(await page.textContent(".range .error"), /after the start/);
  await page.fill(".range label:has-text('to') input", "2");
  await page.press(".range label:has-text('to') input", "Enter");
  await release(page);
  assert.deepEqual((await asked(page)).at(-1).range, { from: 0, to: 2, step: 0.01 });
  const label = await page.evaluate(() => answer.assemblies[1].label);
  await page.selectOption("[data-part=assembly]", label);
  await release(page);
  assert.equal((await asked(page)).at(-1).assembly, label);
  await page.close();
});

for (const colorScheme of ["light", "dark"]) {
  test(`axe finds nothing among sliders and messages, ${colorScheme}`, async () => {
    const page = await visit("four_bar", { colorScheme });
    await provide(page);
    await type(page, "rod", "300");
    await page.evaluate(() => live.update({ ...answer, messages: [{ severity: "error", code: "K7", text: "one" }, { severity: "warning", code: "K8", text: "two\nthree" }] }));
    assert.deepEqual(await violations(page), []);
    await page.close();
  });
}

test("an error is shown beside the last good picture", async () => {
  const page = await visit("four_bar");
  await provide(page);
  const body = () => page.getAttribute("[id=body-crank]", "transform");
  const before = await body();
  await page.evaluate(() => {
    globalThis.respond = () => ({ messages: [{ severity: "error", code: "K7", text: "rod is too short\nfor this", start: null, end: null }] });
  });
  await type(page, "rod", "90");
  await release(page);
  assert.equal(await page.textContent("[data-part=messages] .error"), "rod is too short\nfor this");
  assert.equal(await body(), before);
  assert.equal(await page.locator("[data-page].old").count(), 1);
  await page.evaluate(() => {
    globalThis.respond = () => {
      throw new Error("the worker has ended");
    };
  });
  await type(page, "rod", "91");
  await release(page);
  assert.match(await page.textContent("[data-part=messages]"), /the worker has ended/);
  await page.evaluate(() => {
    globalThis.respond = (all) => all;
  });
  await type(page, "rod", "130");
  await release(page);
  assert.equal(await page.textContent("[data-part=messages]"), "");
  assert.equal(await page.locator("[data-page].old").count(), 0);
  await page.close();
});

test("a thousand updates leave the page as large as before", async () => {
  const page = await visit("four_bar");
  await provide(page);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const measured = async (updates) => {
    await page.evaluate(async (count) => {
      for (let index = 0; index < count; index += 1) {
        live.update(answer);
        if (index % 20 === 0) await new Promise((resolve) => requestAnimationFrame(resolve));
      }
    }, updates);
    for (let round = 0; round < 3; round += 1) await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    return Object.fromEntries(metrics.map(({ name, value }) => [name, value]));
  };
  // Code that is compiled again when it has run often is part of the heap.
  const before = await measured(500);
  const after = await measured(1000);
  assert.ok(after.Nodes <= before.Nodes * 1.02, `${before.Nodes} nodes, then ${after.Nodes}`);
  assert.ok(after.JSEventListeners <= before.JSEventListeners, `${before.JSEventListeners} listeners, then ${after.JSEventListeners}`);
  const growth = after.JSHeapUsedSize / before.JSHeapUsedSize;
  assert.ok(growth < 1.03, `the heap grows by a factor of ${growth}`);
  await page.close();
});
