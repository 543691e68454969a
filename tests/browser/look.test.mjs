// The looks of a page: what the first screen has, formulas that keep to their lines, curves that are drawn when they are seen, paper, and
// the rules of accessibility.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { linkwright, mechanism, prepare, seek, showAllCharts, violations } from "./harness.mjs";

const { browser, made } = prepare();
const pages = new Map();

/// The page of a description; one with an error is written, too.
const visit = async (name, options, description = mechanism(name)) => {
  if (!pages.has(name)) {
    const file = made.file(`${name}.html`);
    try {
      linkwright("view", description, "--out", file, "--force");
    } catch {
      // The command reports an error of the motion, and so does the page.
    }
    pages.set(name, `file://${file}`);
  }
  return browser.visit(pages.get(name), options);
};

/// A mechanism whose loop does not close.
const apart = () => {
  const file = made.file("apart.mech");
  writeFileSync(file, readFileSync(mechanism("two_body"), "utf8").replace("absolute_x(2) = sqrt(3)", "absolute_x(2) = 5"));
  return file;
};

for (const [width, height, share] of [[1280, 800, 0.35], [1920, 1080, 0.25], [2560, 1300, 0.25], [3840, 2100, 0.2]]) {
  test(`the first screen of ${width} pixels has the drawing, its controls and the curves`, async () => {
    for (const name of ["excavator", "two_body"]) {
      const page = await visit(name, { viewport: { width, height } });
      const boxes = await page.evaluate(() =>
        Object.fromEntries(
          [".drawing", ".transport", ".chart"].map((it) => {
            const { left, right, top, bottom } = document.querySelector(it).getBoundingClientRect();
            return [it, { left, right, top, bottom }];
          }),
        ),
      );
      for (const [part, box] of Object.entries(boxes)) {
        assert.ok(box.left >= 0 && box.top >= 0 && box.right <= width && box.bottom <= height, `${part} of ${name}: ${JSON.stringify(box)}`);
      }
      const drawing = boxes[".drawing"];
      const area = ((drawing.right - drawing.left) * (drawing.bottom - drawing.top)) / (width * height);
      assert.ok(area > share, `the drawing fills ${area} of the screen`);
      // It stays when the text is read.
      await page.evaluate(() => document.getElementById("derivation").scrollIntoView());
      const { top, bottom } = await page.$eval(".drawing", (it) => it.getBoundingClientRect().toJSON());
      assert.ok(top >= 0 && bottom <= height, `${top} to ${bottom}`);
      await page.close();
    }
  });
}

test("requested curves come first", async () => {
  const page = await visit("excavator_tool");
  const captions = await page.$$eval(".chart figcaption", (all) => all.map((it) => it.textContent));
  assert.deepEqual(captions.slice(0, 3), ["Points, m", "Points: rate, m/s", "Points: acceleration, m/s²"]);
  const labels = await page.$$eval(".chart:first-child .label", (all) => all.map((it) => it.textContent));
  assert.deepEqual(labels.sort(), ["xK", "yK"]);
  await page.close();
});

test("pieces of formulas on different lines do not touch, and no formula of the excavator scrolls", async () => {
  for (const width of [1280, 2560]) {
    const page = await visit("excavator", { viewport: { width, height: 900 } });
    const found = await page.evaluate(() => {
      for (const section of document.querySelectorAll("article > section")) section.style.contentVisibility = "visible";
      const rows = [...document.querySelectorAll("#phi ~ .equation")];
      const touching = rows.filter((row) => {
        const boxes = [...row.querySelectorAll("math")].map((it) => it.getBoundingClientRect());
        return boxes.some((a, index) =>
          boxes.slice(index + 1).some((b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > -2 && Math.abs(a.bottom - b.bottom) > 20),
        );
      });
      const scrolling = rows.filter((it) => it.scrollWidth > it.clientWidth + 1 || it.scrollHeight > it.clientHeight + 1);
      return [rows.length, touching.length, scrolling.length];
    });
    assert.ok(found[0] > 90, String(found));
    assert.deepEqual(found.slice(1), [0, 0]);
    await page.close();
  }
});

test("indices of φ and y hang as low as those of x", async () => {
  const page = await visit("two_body");
  const drops = await page.evaluate(() => {
    const all = [...document.querySelectorAll(".names msub[data-q]")];
    return all.map((it) => {
      const line = it.closest("math").getBoundingClientRect();
      const probe = document.createElement("span");
      probe.style.cssText = "display:inline-block;width:0;height:0";
      it.closest("math").before(probe);
      const baseline = probe.getBoundingClientRect().bottom;
      probe.remove();
      return { letter: it.firstElementChild.textContent, drop: it.lastElementChild.getBoundingClientRect().bottom - baseline, line: line.height };
    });
  });
  const of = (letter) => drops.filter((it) => it.letter === letter).map((it) => it.drop);
  for (const letter of ["x", "y", "φ"]) assert.ok(of(letter).length > 1, letter);
  const first = of("x")[0];
  for (const { letter, drop } of drops.filter((it) => ["x", "y", "φ"].includes(it.letter))) {
    assert.ok(Math.abs(drop - first) < 0.75, `${letter}: ${drop} px instead of ${first}`);
  }
  await page.close();
});

test("a cell of the pattern of the Jacobian shows its entry and lights its row and its body", async () => {
  const page = await visit("excavator");
  const cells = await page.$$eval(".pattern rect[data-entry]", (all) => all.map((it) => it.dataset.entry));
  const entries = await page.$$eval(".entry[data-entry]", (all) => all.map((it) => it.dataset.entry));
  assert.deepEqual(cells, entries);
  assert.equal(cells.length, 112);
  assert.equal(await page.locator("#phi-q ~ .equation mfrac mo:text-is('∂')").count(), 0);
  await page.hover('.pattern rect[data-entry="0 8"]');
  assert.equal((await page.textContent(".pattern output")).replace(/\s+/g, ""), "∂Φ1∂φc3=−0.2cosφc3");
  const lit = await page.$$eval("#phi ~ .equation.lit", (all) => all.map((it) => it.dataset.is));
  assert.ok(lit.includes("j0 e0"), String(lit));
  const bodies = await page.$$eval("[id=mechanism] g.lit[id^='body-']", (all) => all.map((it) => it.id));
  assert.deepEqual(bodies, ["body-c3"]);
  await page.close();
});

test("charts are drawn when they come into view, and for paper", async () => {
  const page = await visit("excavator", { viewport: { width: 1280, height: 400 } });
  const counts = () => page.$$eval(".chart", (all) => [all.length, all.filter((it) => it.querySelector(".line")).length]);
  const [all, seen] = await counts();
  assert.ok(seen >= 1 && seen < all, `${seen} of ${all}`);
  await seek(page, 2);
  await page.evaluate(() => document.querySelector(".chart:last-child").scrollIntoView());
  await page.waitForFunction(() => document.querySelector(".chart:last-child .cursor"));
  const cursors = await page.$$eval(".chart .cursor", (them) => [...new Set(them.map((it) => it.getAttribute("transform")))]);
  assert.equal(cursors.length, 1, String(cursors));
  await page.close();

  const paper = await visit("excavator", { viewport: { width: 1280, height: 400 } });
  await seek(paper, 2);
  const moved = await paper.getAttribute("[id=body-c1]", "transform");
  await paper.evaluate(() => {
    addEventListener("beforeprint", () => {
      globalThis.printed = [
        document.querySelectorAll(".chart").length - document.querySelectorAll(".chart .line").length,
        Number(document.querySelector("[data-part=time]").value),
        document.querySelectorAll(".thumbnails svg").length,
      ];
    });
  });
  const pdf = await paper.pdf();
  assert.ok(pdf.length > 10000);
  const [missing, time, pictures] = await paper.evaluate(() => globalThis.printed);
  assert.ok(missing <= 0, `${missing} charts are missing`);
  assert.equal(time, 0);
  assert.ok(pictures > 10, `${pictures} assemblies`);
  assert.equal(await paper.getAttribute("[id=body-c1]", "transform"), moved);
  await paper.close();
});

test("values are a table for readers of screens, and motion can be reduced", async () => {
  const page = await visit("two_body", { reducedMotion: "reduce" });
  await page.click(".live summary");
  await page.waitForSelector(".live tbody tr");
  const rows = await page.$$eval(".live tbody tr", (all) => all.map((row) => row.innerText));
  assert.equal(rows.length, 6);
  assert.equal(await page.locator(".live th[scope=row]").count(), 6);
  const durations = await page.$$eval(".equation, .linkwright path, button", (all) => [...new Set(all.map((it) => getComputedStyle(it).transitionDuration))]);
  assert.deepEqual(durations, ["0s"]);
  const label = await page.getAttribute(".chart svg", "aria-label");
  assert.match(label, /^Angles over time: φ1 from −?[\d.]+ to [\d.]+, φ2 from/);
  await page.close();
});

for (const [name, options] of [
  ["excavator", {}],
  ["excavator", { colorScheme: "dark", viewport: { width: 375, height: 800 } }],
  ["two_body", { viewport: { width: 2560, height: 1300 } }],
  ["apart", {}],
]) {
  test(`axe finds nothing on the page of ${name} ${JSON.stringify(options)}`, async () => {
    const page = await visit(name, options, name === "apart" ? apart() : mechanism(name));
    if (name !== "apart") await showAllCharts(page);
    assert.deepEqual(await violations(page), []);
    await page.close();
  });
}
