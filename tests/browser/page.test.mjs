// The page in a browser: what it shows is what the solver says, and pointing at something lights what belongs to it.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { test } from "node:test";
import { linkwright, mechanism, prepare, seek, showAllCharts, solved } from "./harness.mjs";

const { browser, made } = prepare();

const visit = async (name, options) => {
  const file = made.file(`${name}.html`);
  linkwright("view", mechanism(name), "--out", file, "--force");
  return browser.visit(`file://${file}`, options);
};

/// How far from each point of the mechanism, in pixels of the screen, the nearest dot or pin is; and where the points are.
const distances = (page, points) =>
  page.evaluate((wanted) => {
    const mechanism = document.getElementById("mechanism");
    const scale = Number(mechanism.dataset.scale);
    const onScreen = (element, x, y) => new DOMPoint(x, y).matrixTransform(element.getScreenCTM());
    const circles = [...mechanism.querySelectorAll("g[id^='body-'] circle, g[id^='joint-'] circle")].map((circle) =>
      onScreen(circle, circle.cx.baseVal.value, circle.cy.baseVal.value),
    );
    return Object.entries(wanted).map(([name, { position }]) => {
      const place = onScreen(mechanism, position[0] * scale, -position[1] * scale);
      const all = circles.map((it) => Math.hypot(it.x - place.x, it.y - place.y));
      return { name, off: Math.min(...all), x: place.x, y: place.y };
    });
  }, points);

/// The place and the angle of every body, against the solver's: the largest distance in pixels of its origin and of a point 100
/// pixels along its x axis.
const strayed = (page, { coordinates, q }) =>
  page.evaluate(
    ([names, values]) => {
      const mechanism = document.getElementById("mechanism");
      const scale = Number(mechanism.dataset.scale);
      const base = mechanism.getScreenCTM();
      let most = 0;
      let count = 0;
      for (const group of mechanism.querySelectorAll("g[id^='body-'][data-body]")) {
        const name = group.id.slice("body-".length);
        const index = names.findIndex((it) => it === `x${name}` || it === `x_${name}`);
        const [x, y, angle] = values.slice(index, index + 3);
        const turned = group.getScreenCTM();
        for (const along of [0, 100]) {
          const there = new DOMPoint(along, 0).matrixTransform(turned);
          const wanted = new DOMPoint(x * scale + along * Math.cos(angle), -y * scale - along * Math.sin(angle)).matrixTransform(base);
          most = Math.max(most, Math.hypot(there.x - wanted.x, there.y - wanted.y));
        }
        count += 1;
      }
      return { most, count };
    },
    [coordinates, q],
  );

for (const [name, bodies] of [["two_body", 2], ["excavator", 10], ["disc_cam", 2], ["planetary_gear", 3], ["jansen", 7]]) {
  test(`${name} is drawn where the solver puts it`, async () => {
    const page = await visit(name);
    let first;
    // The last two lie between the instants that the page holds.
    for (const t of [0, 1.2345, 0.7071]) {
      await seek(page, t);
      const frame = solved(mechanism(name), t);
      const bodiesOff = await strayed(page, frame);
      assert.ok(bodiesOff.count >= bodies, `${bodiesOff.count} bodies`);
      assert.ok(bodiesOff.most < 1, `at ${t} a body is ${bodiesOff.most} pixels off`);
      const found = await distances(page, frame.points);
      for (const { name: point, off } of found) assert.ok(off < 1, `${point} is ${off} pixels off at ${t}`);
      first ??= found;
      if (t > 0) {
        const moved = found.map((it, index) => Math.hypot(it.x - first[index].x, it.y - first[index].y));
        assert.ok(Math.max(...moved) > 5, `${name} does not move`);
      }
    }
    await page.close();
  });
}

test("the slider, the button and the keys move the mechanism", async () => {
  const page = await visit("two_body");
  const state = () =>
    page.evaluate(() => [document.getElementById("body-1").getAttribute("transform"), Number(document.querySelector("[data-part=time]").value)]);
  const [still, start] = await state();
  assert.equal(start, 0);
  await page.click('[data-part=play]');
  await page.waitForFunction(() => Number(document.querySelector("[data-part=time]").value) > 0.2);
  await page.click('[data-part=play]');
  const [moved, paused] = await state();
  assert.notEqual(moved, still);
  await page.waitForTimeout(200);
  assert.deepEqual(await state(), [moved, paused]);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("Home");
  assert.equal((await state())[1], 0);
  await page.keyboard.press("ArrowRight");
  assert.ok(Math.abs((await state())[1] - 0.05) < 1e-9);
  await page.keyboard.press("End");
  assert.equal((await state())[1], 5);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => Number(document.querySelector("[data-part=time]").value) < 5);
  await page.keyboard.press("Space");
  // The cursor of every curve stands at the time of the slider, also of those that are chosen later.
  await showAllCharts(page);
  const lengths = await page.$$("[data-part=chips] p:has-text('Coordinates') .chip");
  for (const chip of lengths) await chip.click();
  await showAllCharts(page);
  await seek(page, 2.5);
  const cursors = await page.$$eval(".cursor", (all) => all.map((it) => it.getAttribute("transform")));
  assert.ok(cursors.length >= 7 && new Set(cursors).size === 1, String(cursors));
  // A line of the grid goes from the first time to the last.
  const middle = await page.$eval('.chart svg path[d^="M62 "][d*="H"]', (line) => {
    const [, last] = line.getAttribute("d").match(/H([\d.]+)/);
    return (62 + Number(last)) / 2;
  });
  assert.ok(Math.abs(Number(cursors[0].match(/[\d.]+/)[0]) - middle) < 0.1, `${cursors[0]}, ${middle}`);
  await page.close();
});

test("pointing at one thing lights what belongs to it", async () => {
  const page = await visit("two_body");
  const lit = () =>
    page.evaluate(() => {
      const all = (of) => [...document.querySelectorAll(of)];
      return {
        bodies: all("#mechanism g.lit[id^='body-']").map((it) => it.id),
        joints: all("#mechanism g.lit[id^='joint-']").map((it) => it.id),
        equations: all("#phi ~ .equation.lit").map((it) => it.dataset.is),
        curves: [...new Set(all(".curve.lit").map((it) => it.dataset.is))].sort(),
      };
    });
  const rows = "section[aria-labelledby=equations] #phi + .equation";
  assert.deepEqual((await lit()).bodies, []);
  await page.evaluate(() => {
    document.querySelector(".chooser").open = true;
  });
  // From an equation: the third row is the x of the pin P.
  await page.hover(`${rows} ~ .equation[data-is="j2 e2"] b`);
  let found = await lit();
  assert.deepEqual(found.bodies, ["body-1", "body-2"]);
  assert.deepEqual(found.joints, ["joint-p"]);
  for (const curve of ["q2", "q5"]) assert.ok(found.curves.includes(curve), `${curve} in ${found.curves}`);
  // From a step of the derivation.
  await page.hover('#block-2 .equation:has([data-q="5"]) >> nth=1');
  found = await lit();
  assert.ok(found.bodies.includes("body-2") && found.curves.includes("q5"), JSON.stringify(found));
  // From a curve: φ2 is the sixth coordinate, of body 2, in the rows of the pin and in no driver.
  await page.hover('.chip[data-is="q5"]');
  found = await lit();
  assert.deepEqual(found.bodies, ["body-2"]);
  assert.deepEqual(found.curves, ["q5"]);
  assert.ok(found.equations.includes("j2 e2") && found.equations.includes("j2 e3"), String(found.equations));
  assert.ok(!found.equations.includes("j4 e5"), String(found.equations));
  const curve = await page.$('.curve[data-is="q5"] .hit');
  await curve.dispatchEvent("pointerover", { bubbles: true });
  assert.deepEqual(await lit(), found);
  // From a body in the drawing.
  await page.evaluate(() => scrollTo(0, 0));
  await page.hover("#body-1 path.body", { force: true });
  found = await lit();
  assert.deepEqual(found.bodies, ["body-1"]);
  assert.ok(found.equations.includes("j0 e0") && found.equations.includes("j4 e5"), String(found.equations));
  assert.ok(!found.equations.includes("j3 e4"), String(found.equations));
  assert.ok(found.curves.includes("q2") && !found.curves.includes("q5"), String(found.curves));
  // From nothing, and by keyboard.
  await page.hover("h1");
  assert.deepEqual(await lit(), { bodies: [], joints: [], equations: [], curves: [] });
  await page.focus(`${rows} ~ .equation[data-is="j2 e2"]`);
  assert.deepEqual((await lit()).bodies, ["body-1", "body-2"]);
  await page.close();
});

// Few instants are kept of the other motions: the page has to find the poses between them.
for (const [name, label, modes] of [
  ["two_body", "−", ["phi2=negative"]],
  ["excavator", "++++", ["phi_c4_phi_c6=positive", "phi_c1_phi_c5=positive"]],
]) {
  test(`another assembly of ${name} has its own motion`, async () => {
    const page = await visit(name);
    // Thumbnails are in the order of their labels, but the drawing's is the first.
    const place = await page.$$eval(".thumbnails button > span", (all, wanted) => all.findIndex((it) => it.textContent === wanted), label);
    assert.ok(place > 0, `no assembly ${label}`);
    await page.click(`.thumbnails button:nth-child(${place + 1})`);
    const branches = modes.flatMap((mode) => ["--branch", mode]);
    for (const t of [0, 0.377, 1.019, 3.21]) {
      await seek(page, t);
      const off = await strayed(page, solved(mechanism(name), t, ...branches));
      assert.ok(off.most < 1, `${off.most} pixels off at ${t}`);
    }
    await page.close();
  });
}

/// What the dots of the shown points' curves say: for each chart, by the label of the curve, the value that its axis gives to the dot,
/// and what a pixel is worth there.
const read = (page) =>
  page.$$eval(".charts .chart", (charts) =>
    charts
      .filter((chart) => chart.querySelector("figcaption").textContent.startsWith("Points"))
      .map((chart) => {
        const ticks = [...chart.querySelectorAll(".grid text[text-anchor=end]")].map((it) => [
          Number(it.textContent.replace("−", "-")),
          Number(it.getAttribute("y")) - 4,
        ]);
        const [[low, under], [high, above]] = [ticks[0], ticks.at(-1)];
        const pixel = (low - high) / (under - above);
        const dots = [...chart.querySelectorAll(".curve")].map((curve) => [
          curve.querySelector(".label").textContent,
          low + pixel * (Number(curve.querySelector("circle").getAttribute("cy")) - under),
        ]);
        return { caption: chart.querySelector("figcaption").textContent, pixel: Math.abs(pixel), dots: Object.fromEntries(dots) };
      }),
  );

// Displacement, velocity and acceleration of both points, by x and y.
test("the curves of A and G of the excavator are those of the solver", async () => {
  const page = await visit("excavator");
  const labels = ["xA", "xG", "yA", "yG"];
  // Of all curves of points those four are left.
  const chips = await page.$$("[data-part=chips] p:has-text('Points: ') .chip");
  for (const chip of chips) {
    const isWanted = labels.includes(await chip.textContent());
    // Charts come and go, and move what is below them: a click at a place on the screen might meet something else.
    if ((await chip.getAttribute("aria-pressed")) !== String(isWanted)) await chip.evaluate((it) => it.click());
  }
  await showAllCharts(page);
  let most = 0;
  for (const t of [0, 0.8, 2.1, 3.7]) {
    await seek(page, t);
    const { points } = solved(mechanism("excavator"), t);
    const charts = await read(page);
    assert.deepEqual(charts.map((it) => it.caption), ["Points, m", "Points: rate, m/s", "Points: acceleration, m/s²"]);
    for (const [level, { pixel, dots }] of charts.entries()) {
      assert.deepEqual(Object.keys(dots).sort(), labels);
      for (const label of labels) {
        const own = points[label.slice(1)];
        const value = [own.position, own.velocity, own.acceleration][level]["xy".indexOf(label[0])];
        const off = Math.abs(dots[label] - value) / pixel;
        assert.ok(off < 1, `${label}, ${charts[level].caption}: ${off} pixels off at ${t}`);
        most = Math.max(most, Math.abs(value));
      }
    }
  }
  assert.ok(most > 0.5, "nothing moves");
  await page.close();
});

test("an assembly whose motion ends says so", async () => {
  const page = await visit("excavator");
  const ending = await page.$(".thumbnails button:has(small)");
  assert.match(await ending.textContent(), /motion ends at t = /);
  await ending.click();
  assert.match(await page.textContent('[data-part=assembly-error]'), /.{20}/);
  await page.close();
});

test("the page fits narrow screens, in the dark and on paper", async () => {
  for (const name of ["two_body", "excavator", "disc_cam"]) {
    const page = await visit(name, { viewport: { width: 375, height: 700 }, colorScheme: "dark" });
    const [width, screen] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(width <= screen, `${name} is ${width} wide`);
    const paper = await page.evaluate(() => getComputedStyle(document.querySelector(".drawing .paper")).fill);
    assert.equal(paper, "rgb(22, 25, 29)");
    await page.emulateMedia({ media: "print" });
    const printed = await page.evaluate(() => [
      getComputedStyle(document.querySelector(".drawing .paper")).fill,
      getComputedStyle(document.body).backgroundColor,
      getComputedStyle(document.querySelector(".transport")).display,
    ]);
    assert.deepEqual(printed, ["rgb(255, 255, 255)", "rgb(255, 255, 255)", "none"]);
    await page.close();
  }
});

test("names and documentation are text", async () => {
  const hostile = `</script><script>alert(1)</script><img src=x onerror=alert(2)> "quoted' &amp; <!--`;
  const file = made.file("hostile.mech");
  writeFileSync(
    file,
    `/// ${hostile}
mechanism bad {
    /// ${hostile}
    body 1 at (0, 0, 30deg) { P: (1, 0) }
    /// ${hostile}
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    /// ${hostile}
    param rate = 2;
    drive phi(1) = rate*t;
}
`,
  );
  const html = made.file("hostile.html");
  linkwright("view", file, "--out", html);
  const page = await browser.visit(`file://${html}`);
  assert.equal(await page.$$eval("img", (all) => all.length), 0);
  assert.equal(await page.$$eval("script", (all) => all.length), 2);
  const text = await page.innerText("header");
  assert.ok(text.includes("</script><script>alert(1)</script><img src=x onerror=alert(2)>"), text);
  await page.close();
});

test("the guide of the other assembly of two_body is where its block slides", async () => {
  const page = await visit("two_body");
  const place = await page.evaluate(() => [...document.querySelectorAll(".thumbnails button")].findIndex((it) => it.textContent.trim().startsWith("−")));
  await page.click(`.thumbnails button:nth-child(${place + 1})`);
  const off = [];
  for (const t of [0, 0.7, 2.2, 3.9]) {
    await seek(page, t);
    off.push(
      await page.evaluate(() => {
        const box = (id, what) => document.querySelector(`[id="${id}"] ${what}`).getBoundingClientRect();
        const guide = box("joint-absolute_x_2-below", ".edge");
        const block = box("joint-absolute_x_2", ".part");
        return Math.max(guide.top - block.top, block.bottom - guide.bottom);
      }),
    );
  }
  assert.ok(Math.max(...off) <= 0, `beyond the guide by ${off} px`);
  await page.close();
});

/// An arm that swings between a spring and a force.
const swinging = `mechanism swinging {
    point O = (0, 0), C = (30cm, 30cm);
    body arm at O { O, P: (60cm, 0), M: (30cm, 0) }
    revolute O(ground, arm);
    drive phi(arm) = 15deg*sin(2*pi*t);
    mass arm = 5kg at M;
    spring (ground.C, arm.M) = 1N/mm;
    force on arm.P = (30N*cos(2*pi*t), -40N);
    effort;
}`;

test("a spring reaches from end to end, and a force has its direction, at every time", async () => {
  const source = made.file("swinging.mech");
  writeFileSync(source, swinging);
  const file = made.file("swinging.html");
  linkwright("view", source, "--to", "1", "--out", file, "--force");
  const page = await browser.visit(`file://${file}`);
  for (const t of [0, 0.13, 0.61, 0.94]) {
    await seek(page, t);
    const found = await page.evaluate(() => {
      const mechanism = document.getElementById("mechanism");
      const scale = Number(mechanism.dataset.scale);
      const back = mechanism.getScreenCTM().inverse();
      const place = (element, x, y) => {
        const there = new DOMPoint(x, y).matrixTransform(element.getScreenCTM()).matrixTransform(back);
        return [there.x / scale, -there.y / scale];
      };
      const spring = mechanism.querySelector("[data-length] path");
      const length = spring.getTotalLength();
      const ends = [0, length].map((at) => spring.getPointAtLength(at)).map(({ x, y }) => place(spring, x, y));
      const force = mechanism.querySelector("[data-force]");
      return { ends, tail: place(force, 0, 0), along: place(force, 1, 0) };
    });
    const angle = (Math.PI / 12) * Math.sin(2 * Math.PI * t);
    const on = (distance) => [distance * Math.cos(angle), distance * Math.sin(angle)];
    const near = ([x, y], [u, v]) => assert.ok(Math.hypot(x - u, y - v) < 1e-3, `(${x}, ${y}) is not (${u}, ${v}) at ${t}`);
    const [upper, lower] = found.ends.sort((a, b) => b[1] - a[1]);
    near(upper, [0.3, 0.3]);
    near(lower, on(0.3));
    near(found.tail, on(0.6));
    const [x, y] = [found.along[0] - found.tail[0], found.along[1] - found.tail[1]];
    const [fx, fy] = [30 * Math.cos(2 * Math.PI * t), -40];
    const off = Math.abs(x * fy - y * fx) / (Math.hypot(x, y) * Math.hypot(fx, fy));
    assert.ok(off < 0.01 && x * fx + y * fy > 0, `the force is off by ${off} at ${t}`);
  }
  await page.close();
});

test("rows with fractions do not scroll up and down, and nothing of them is cut off", async () => {
  for (const name of ["two_body", "four_bar", "quick_return"]) {
    const page = await visit(name);
    const found = await page.evaluate(() => {
      for (const section of document.querySelectorAll("article > section")) section.style.contentVisibility = "visible";
      const rows = [...document.querySelectorAll(".equation, .wide")];
      const scrolls = rows.filter((it) => it.scrollHeight > it.clientHeight && getComputedStyle(it).overflowY !== "hidden");
      const cut = rows.filter((it) => {
        const own = it.getBoundingClientRect();
        return [...it.querySelectorAll("mfrac, msqrt")].some((part) => {
          const { top, bottom } = part.getBoundingClientRect();
          return top < own.top - 0.5 || bottom > own.bottom + 0.5;
        });
      });
      return [rows.length, scrolls.length, cut.length];
    });
    assert.ok(found[0] > 10, name);
    assert.deepEqual(found.slice(1), [0, 0], name);
    await page.close();
  }
});

test("printing keeps tables and figures whole", async () => {
  const page = await visit("four_bar");
  await page.emulateMedia({ media: "print" });
  const split = await page.evaluate(() => {
    const parts = [...document.querySelectorAll("table, figure, .wide, .equation, .thumbnails button")];
    const shown = parts.filter((it) => it.getClientRects().length);
    return [shown.length, shown.filter((it) => getComputedStyle(it).breakInside !== "avoid").length];
  });
  assert.ok(split[0] > 10);
  assert.equal(split[1], 0);
  await page.close();
});
