// Points that are dragged: numbers in the text of the playground, the time of a motion, and inputs where somebody answers.
//
// PLAYGROUND is the path of the playground; without it, its tests are skipped.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { linkwright, mechanism, prepare, seek, serve, solved } from "./harness.mjs";

const playground = process.env.PLAYGROUND;
const isSkipped = playground ? false : "PLAYGROUND is not set";

const { browser, made } = prepare();

/// The pixels of the screen of a position in m, and the scale in pixels per metre.
const onScreen = (page, [x, y]) =>
  page.evaluate(
    ([x, y]) => {
      const drawing = document.querySelector("[id=mechanism]");
      const scale = Number(drawing.dataset.scale);
      const matrix = drawing.getScreenCTM();
      const place = new DOMPoint(x * scale, -y * scale).matrixTransform(matrix);
      return { at: [place.x, place.y], scale: scale * matrix.a };
    },
    [x, y],
  );

/// Drags from one position of the screen to another; between them the pointer stops a few times.
const drag = async (page, from, to, { isHeld = false } = {}) => {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (let part = 1; part <= 8; part += 1) {
    await page.mouse.move(...[0, 1].map((axis) => from[axis] + ((to[axis] - from[axis]) * part) / 8));
    await page.waitForTimeout(20);
  }
  if (!isHeld) await page.mouse.up();
};

const time = async (page) => Number(await page.inputValue("[data-part=time]"));

/// Coupler point of the four-bar linkage at a time.
const coupler = (t) => solved(mechanism("four_bar"), t).points.P.position;

const view = async () => {
  const file = made.file("page.html");
  linkwright("view", mechanism("four_bar"), "--out", file);
  return browser.visit(pathToFileURL(file).href);
};

test("a point of a page pulls the time to where it is nearest", async () => {
  const page = await view();
  await seek(page, 0.3);
  const [from, to] = [await onScreen(page, coupler(0.3)), await onScreen(page, coupler(0.8))];
  await page.mouse.move(...from.at);
  assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector(".drawing svg")).cursor), "grab");
  await drag(page, from.at, to.at);
  assert.ok(Math.abs((await time(page)) - 0.8) < 2e-3, `it is at ${await time(page)} s`);

  // Beside its path it is at the nearest place, from which both directions lead away.
  const goal = [coupler(0.5)[0] + 0.012, coupler(0.5)[1] + 0.02];
  await drag(page, to.at, (await onScreen(page, goal)).at);
  const t = await time(page);
  const apart = (at) => Math.hypot(coupler(at)[0] - goal[0], coupler(at)[1] - goal[1]);
  assert.ok(t > 0.1 && t < 0.7, `it is at ${t} s`);
  assert.ok(apart(t) <= apart(t - 0.01) && apart(t) <= apart(t + 0.01), `it is at ${t} s`);
  await page.close();
});

test("a click changes nothing, and a motion that plays is paused by a pull", async () => {
  const page = await view();
  await seek(page, 0.3);
  const { at } = await onScreen(page, coupler(0.3));
  await page.mouse.move(...at);
  const lit = () => page.evaluate(() => document.querySelectorAll(".lit").length);
  const count = await lit();
  await page.mouse.down();
  await page.mouse.move(at[0] + 1, at[1] + 1);
  await page.mouse.up();
  assert.ok(count > 0, "the point is lit");
  assert.deepEqual([await time(page), await lit()], [0.3, count]);

  // The motion plays slowly, so that the point is still below the pointer.
  await page.selectOption("[data-part=speed]", "0.1");
  await page.click("[data-part=play]");
  const isPlaying = () => page.getAttribute("[data-part=play]", "aria-pressed");
  assert.equal(await isPlaying(), "true");
  const { x, y, width, height } = await page.locator("circle.now").last().boundingBox();
  await drag(page, [x + width / 2, y + height / 2], [x + 40, y + 10]);
  assert.equal(await isPlaying(), "false");
  await page.close();
});

/// An arm with two inputs.
const ARM = `mechanism arm {
    input a = 30deg;
    input b = 80deg;
    point O = (0, 0);
    body upper at (0, 0, 30deg)      { O: (0, 0), E: (1, 0) }
    body lower at (0.87, 0.5, 80deg) { E: (0, 0), P: (0.8, 0) }
    revolute O(ground, upper);
    revolute E(upper, lower);
    drive phi(upper) = a;
    drive phi(lower) = b;
}
`;

test("a point pulls inputs of a page that is served", async () => {
  writeFileSync(made.file("arm.mech"), ARM);
  const server = await serve(made.file("arm.mech"));
  const page = await browser.visit(server.url);
  const angles = () => page.evaluate(() => [...document.querySelectorAll(".control input[type=text]")].map((it) => (Number(it.value) * Math.PI) / 180));
  const tip = ([a, b]) => [Math.cos(a) + 0.8 * Math.cos(b), Math.sin(a) + 0.8 * Math.sin(b)];
  const first = await angles();
  assert.equal(first.length, 2);
  const goal = [0.9, 1.1];
  const [from, to] = [await onScreen(page, tip(first)), await onScreen(page, goal)];
  await drag(page, from.at, to.at);
  let distance = Infinity;
  for (let waited = 0; waited < 3000 && distance > 1e-3; waited += 50) {
    await page.waitForTimeout(50);
    const now = tip(await angles());
    distance = Math.hypot(now[0] - goal[0], now[1] - goal[1]);
  }
  // The pointer is at whole pixels.
  assert.ok(distance < 2 / from.scale, `it is ${distance} m away`);
  await page.close();
  server.end();
});

/// A pendulum that forces move.
const PENDULUM = `mechanism pendulum {
    point O = (0, 0);
    body bob at O { O, S: (0, -2) }
    revolute O(ground, bob);
    free swing: phi(bob) = 30deg;
    mass bob = 3kg at S inertia 0.5;
    gravity = (0, -9.81);
}
`;

const bobOf = (angle) => [2 * Math.sin(angle), -2 * Math.cos(angle)];

/// The start of the pendulum in the field of its control, in rad.
const swing = async (page) => (Number(await page.inputValue(".control input[type=text]")) * Math.PI) / 180;

const isPlaying = async (page) => (await page.getAttribute("[data-part=play]", "aria-pressed")) === "true";

/// Angle of the bob as it is shown, from where its dot is.
const shown = (page) =>
  page.evaluate(() => {
    const [dot] = document.querySelectorAll("circle.now");
    return Math.atan2(Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy")));
  });

/// Lifts the bob to a direction, lets go, and tests where it is, that it swings from there, and that the start of the description returns.
const lift = async (page) => {
  await seek(page, 0.4);
  const start = await shown(page);
  const [from, to] = [await onScreen(page, bobOf(start)), await onScreen(page, bobOf(1.4))];
  await drag(page, from.at, to.at, { isHeld: true });
  const near = (angle, goal) => Math.abs(angle - goal) < 2 / from.scale;
  await page.waitForFunction((goal) => Math.abs((Number(document.querySelector(".control input[type=text]").value) * Math.PI) / 180 - goal) < 0.01, 1.4);
  assert.ok(near(await swing(page), 1.4), `it is lifted to ${await swing(page)}`);
  // It waits there while it is held.
  await page.waitForTimeout(300);
  assert.ok(near(await shown(page), 1.4), `it is shown at ${await shown(page)}`);
  assert.equal(await isPlaying(page), false);
  await page.mouse.up();
  await page.waitForFunction(() => document.querySelector("[data-part=play]").getAttribute("aria-pressed") === "true");
  // Released at rest, it is on the other side after half a period.
  let least = 2;
  for (let waited = 0; waited < 4000 && least > -1.3; waited += 20) {
    await page.waitForTimeout(20);
    least = Math.min(least, await shown(page));
  }
  assert.ok(least < -1.3 && least > -1.4 - 2 / from.scale, `it swings to ${least}`);
  await page.click("[data-part=play]");
  await page.click('[aria-label="reset swing"]');
  assert.equal(await page.inputValue(".control input[type=text]"), "30");
  await seek(page, 0);
  await page.waitForFunction(() => {
    const [dot] = document.querySelectorAll("circle.now");
    return Math.abs(Math.atan2(Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy"))) - Math.PI / 6) < 1e-3;
  });
};

test("a pendulum of a page that is served is lifted, and swings when it is released", async () => {
  writeFileSync(made.file("pendulum.mech"), PENDULUM);
  const server = await serve(made.file("pendulum.mech"));
  const page = await browser.visit(server.url);
  await lift(page);
  await page.close();
  server.end();
});

test("a pendulum in a file pulls the time of its motion", async () => {
  writeFileSync(made.file("pendulum.mech"), PENDULUM);
  linkwright("view", made.file("pendulum.mech"), "--out", made.file("pendulum.html"));
  const page = await browser.visit(pathToFileURL(made.file("pendulum.html")).href);
  await seek(page, 0.2);
  const [from, to] = [await onScreen(page, bobOf(await shown(page))), await onScreen(page, bobOf(-0.2))];
  await drag(page, from.at, to.at);
  // It falls to the other side, and has the direction of the pointer there.
  assert.ok(Math.abs((await shown(page)) + 0.2) < 2 / from.scale, `it is at ${await shown(page)}`);
  assert.ok((await time(page)) > 0.2);
  assert.equal(await isPlaying(page), false);
  await page.close();
});

const visitPlayground = async (text) => {
  const page = await browser.visit(pathToFileURL(playground).href);
  if (text) await setText(page, text);
  return page;
};

const textOf = (page) => page.evaluate(() => globalThis.linkwright.editor.text());

const setText = async (page, text) => {
  await page.evaluate((text) => {
    const { editor } = globalThis.linkwright;
    editor.replace([{ start: 0, end: new TextEncoder().encode(editor.text()).length, text }]);
  }, text);
};

/// Waits until points can be dragged: the drawing is of the text, and complete, so that it does not change its scale.
const ready = async (page) => {
  const isReady = () => document.querySelector(".handles:not(.stale) .handle") !== null && !globalThis.linkwright.page().scene.data.sketch;
  await page.waitForFunction(isReady, null, { polling: 20 });
};

/// Coordinates that a text gives a point, in m.
const written = (text, name) => {
  const [, x, y] = text.match(new RegExp(`\\b${name}(?::| =) \\(([^,]+), ([^)]+)\\)`));
  return [x, y].map((it) => Number(it.trim().replace(/mm$/, "e-3")));
};

const FOUR_BAR = readFileSync(mechanism("four_bar"), "utf8");
/// Rounding of its numbers in m, with what a share of a pixel is worth.
const ROUNDED = 1.1e-5;

/// Records where the button is pressed and where the pointer is last.
const recordPointer = (page) =>
  page.evaluate(() => {
    globalThis.pointers = {};
    addEventListener("pointerdown", (it) => (globalThis.pointers.first = [it.clientX, it.clientY]), true);
    addEventListener("pointermove", (it) => (globalThis.pointers.last = [it.clientX, it.clientY]), true);
  });

const dragged = async (page) => {
  const { first, last } = await page.evaluate(() => globalThis.pointers);
  return [last[0] - first[0], last[1] - first[1]];
};

test("a local point writes its numbers, and one step of undoing restores them", { skip: isSkipped }, async () => {
  const page = await visitPlayground(FOUR_BAR);
  await ready(page);
  await recordPointer(page);
  const { at, scale } = await onScreen(page, coupler(0));
  await drag(page, at, [at[0] + 37, at[1] - 52]);
  const [dx, dy] = await dragged(page);
  const { coordinates, q } = solved(mechanism("four_bar"), 0);
  const angle = q[coordinates.indexOf("phi_coupler")];
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const global = [dx / scale, -dy / scale];
  const expected = [0.06 + c * global[0] + s * global[1], 0.04 + c * global[1] - s * global[0]];
  await page.waitForFunction((text) => globalThis.linkwright.editor.text() !== text, FOUR_BAR);
  await ready(page);
  const text = await textOf(page);
  const numbers = written(text, "P");
  for (const axis of [0, 1]) assert.ok(Math.abs(numbers[axis] - expected[axis]) < ROUNDED, `${numbers} are not ${expected}`);
  assert.equal(text.replace(/P: \([^)]*\)/, "P: (60mm, 40mm)"), FOUR_BAR, "nothing else is changed");
  // The drawing has followed, and the point is where the pointer is.
  const place = await page.evaluate(() => document.querySelector('.handle[aria-label="P of coupler"]').getBoundingClientRect().toJSON());
  const now = await page.evaluate(() => globalThis.pointers.last);
  const apart = Math.hypot(place.x + place.width / 2 - now[0], place.y + place.height / 2 - now[1]);
  assert.ok(apart < 2 || (await onScreen(page, [0, 0])).scale !== scale, `it is ${apart} px away`);

  await page.click("[data-bar=undo]");
  assert.equal(await textOf(page), FOUR_BAR);
  await page.close();
});

test("a global point writes its numbers, and Escape takes a drag back", { skip: isSkipped }, async () => {
  const page = await visitPlayground(FOUR_BAR);
  await ready(page);
  await recordPointer(page);
  const { at, scale } = await onScreen(page, [0.1, 0]);
  await drag(page, at, [at[0] + 20, at[1] + 9]);
  const [dx, dy] = await dragged(page);
  await page.waitForFunction((text) => globalThis.linkwright.editor.text() !== text, FOUR_BAR);
  await ready(page);
  const numbers = written(await textOf(page), "D");
  const expected = [0.1 + dx / scale, -dy / scale];
  for (const axis of [0, 1]) assert.ok(Math.abs(numbers[axis] - expected[axis]) < ROUNDED, `${numbers} are not ${expected}`);

  const text = await textOf(page);
  const there = (await onScreen(page, numbers)).at;
  await drag(page, there, [there[0] - 40, there[1] - 30], { isHeld: true });
  await page.waitForFunction((text) => globalThis.linkwright.editor.text() !== text, text);
  await page.keyboard.press("Escape");
  assert.equal(await textOf(page), text);
  await page.mouse.up();
  await page.waitForTimeout(100);
  assert.equal(await textOf(page), text);
  await page.close();
});

test("arrow keys move a point by steps, which are undone together", { skip: isSkipped }, async () => {
  const page = await visitPlayground(FOUR_BAR);
  await ready(page);
  await page.focus('.handle[aria-label="D"]');
  const before = await time(page);
  for (const key of ["ArrowRight", "ArrowRight", "Shift+ArrowUp", "ArrowLeft"]) await page.keyboard.press(key);
  await page.waitForFunction(() => globalThis.linkwright.editor.text().includes("D = (100.01mm, 0.10mm)") || globalThis.linkwright.editor.text().includes("D = (100.01mm, 0.1mm)"));
  assert.equal(await time(page), before, "keys do not move the time");
  // The drawing is replaced, and the handle keeps the focus.
  await page.waitForTimeout(1000);
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "D");
  await page.click("[data-bar=undo]");
  assert.equal(await textOf(page), FOUR_BAR);
  await page.close();
});

test("points of formulas say why they have no handle", { skip: isSkipped }, async () => {
  const page = await visitPlayground(readFileSync(mechanism("two_body"), "utf8"));
  await page.waitForFunction(() => document.querySelector('.handle[aria-label="P of 1"]') !== null);
  await ready(page);
  const { at } = await onScreen(page, solved(mechanism("two_body"), 0).points.Q.position);
  await page.mouse.move(...at);
  await page.mouse.move(at[0] + 1, at[1]);
  assert.match(await page.locator(".reason").innerText(), /^Q of 2: .*formula/);
  assert.deepEqual((await onScreen(page, solved(mechanism("two_body"), 0).points.Q.position)).at, at, "nothing moves for it");
  await page.mouse.move(at[0] + 120, at[1] + 90);
  assert.ok(await page.locator(".reason").isHidden());
  await page.close();
});

test("a pendulum is lifted, and its start is part of the address", { skip: isSkipped }, async () => {
  const page = await visitPlayground(PENDULUM);
  await page.waitForFunction(() => document.querySelector(".page h1").textContent === "pendulum");
  await ready(page);
  await lift(page);
  assert.equal(await textOf(page), PENDULUM);
  await seek(page, 0.4);
  const [from, to] = [await onScreen(page, bobOf(await shown(page))), await onScreen(page, bobOf(-1))];
  await drag(page, from.at, to.at);
  await page.waitForFunction(() => document.querySelector("[data-part=play]").getAttribute("aria-pressed") === "true");
  const lifted = await swing(page);
  assert.ok(Math.abs(lifted + 1) < 2 / from.scale, `it is lifted to ${lifted}`);
  const value = await page.inputValue(".control input[type=text]");
  await page.click("[data-bar=share]");
  await page.waitForFunction(() => document.querySelector("[data-bar=note]").textContent !== "");
  const next = await browser.visit(page.url());
  await next.waitForFunction((value) => document.querySelector(".control input[type=text]")?.value === value, value);
  await seek(next, 0);
  assert.ok(Math.abs((await shown(next)) - lifted) < 1e-3, `it starts at ${await shown(next)}`);
  await next.close();
  await page.close();
});

test("away from the start, points pull the time", { skip: isSkipped }, async () => {
  const page = await visitPlayground(FOUR_BAR);
  await ready(page);
  await seek(page, 0.3);
  assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector(".handles")).display), "none");
  const [from, to] = [await onScreen(page, coupler(0.3)), await onScreen(page, coupler(0.7))];
  await drag(page, from.at, to.at);
  assert.ok(Math.abs((await time(page)) - 0.7) < 5e-3, `it is at ${await time(page)} s`);
  assert.equal(await textOf(page), FOUR_BAR);
  await page.close();
});
