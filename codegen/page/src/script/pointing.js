// Pointing at something lights what it is about, and what is about it.

let items = [];
const words = (value) => (value ?? "").split(" ").filter(Boolean);
const tag = () => {
  data.bodies.forEach((body, index) => {
    const element = svg.querySelector(`[id="body-${CSS.escape(body.name)}"]`);
    if (element && index > 0) element.dataset.is = `b${index}`;
  });
  data.joints.forEach((joint, index) => {
    for (const suffix of ["", "-below", "-upon"]) {
      const element = svg.querySelector(`[id="joint-${CSS.escape(joint.slug)}${suffix}"]`);
      // A layer in which nothing lies is there for other assemblies.
      if (!element || (suffix && !element.querySelector("path, circle"))) continue;
      element.dataset.is = `j${index}`;
      element.dataset.of = joint.bodies.map((body) => `b${body}`).join(" ");
    }
  });
};
tag();
for (const name of stage.names) {
  const point = data.points.findIndex((it) => it.name === name.element.dataset.point);
  name.element.dataset.is = point < 0 ? `b${name.at[0]}` : `p${point}`;
}
for (const block of document.querySelectorAll("section.block")) block.dataset.of = block.dataset.joints;

/// The unknowns of a formula, and the bodies whose they are.
const SAYING = ".equation, .pose, section.block, tr";
const symbols = (element) => {
  const all = element.matches(SAYING) ? [...element.querySelectorAll("[data-q]")] : [];
  return all.flatMap((it) => [`q${it.dataset.q}`, ...bodyOf(it.dataset.q)]);
};
const bodyOf = (index) => {
  const body = data.coordinates[index]?.body;
  return body == null ? [] : [`b${body}`];
};
const gather = () => {
  items = [...document.querySelectorAll("[data-is], [data-of], .equation, .pose")].map((element) => ({
    element,
    is: new Set(words(element.dataset.is)),
    of: new Set([...words(element.dataset.of), ...symbols(element)]),
  }));
};
const meet = (a, b) => [...a].some((it) => b.has(it));
const sheet = document.createElement("style");
document.head.append(sheet);
let pointed = null;
const light = (target) => {
  const element = target?.closest?.("[data-is], [data-of]:not(section), .equation, .pose") ?? null;
  const symbol = element ? null : target?.closest?.("[data-q]") ?? null;
  const source = element ?? symbol;
  if (source === pointed) return;
  pointed = source;
  for (const { element: own } of items) own.classList.remove("lit");
  sheet.textContent = "";
  if (!source) return;
  const own = symbol
    ? { is: new Set([`q${symbol.dataset.q}`]), of: new Set(bodyOf(symbol.dataset.q)) }
    : { is: new Set(words(element.dataset.is)), of: new Set([...words(element.dataset.of), ...symbols(element)]) };
  for (const item of items) {
    if (item.element === source || meet(item.is, own.is) || meet(item.is, own.of) || meet(item.of, own.is)) item.element.classList.add("lit");
  }
  const named = [...own.is].filter((it) => it[0] === "q").map((it) => `[data-q="${it.slice(1)}"]`);
  if (named.length) sheet.textContent = `${named.join(",")}{background:var(--lit);outline:1px solid var(--accent)}`;
};
// What is scrolled or moved below a pointer that rests is not pointed at.
let rests = "";
document.addEventListener("pointerover", (event) => {
  const place = `${event.clientX} ${event.clientY}`;
  if (place !== rests) light(event.target);
  rests = place;
});
document.addEventListener("pointerleave", () => light(null));
document.addEventListener("focusin", (event) => light(event.target));
document.addEventListener("focusout", () => light(null));

