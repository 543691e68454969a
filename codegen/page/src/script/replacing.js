// Pictures and sections in place of others: what is open, focused and looked at stays.

/// Replaces a picture. Its style sheet stays if it is the same, so that the styles of the page need not be computed again.
const replaceDrawing = (holder, html) => {
  const parsed = made("template");
  parsed.innerHTML = html;
  const next = parsed.content.querySelector("svg");
  const svg = holder.querySelector("svg");
  const [style, sheet] = [svg, next].map((it) => it?.querySelector("style"));
  if (!style || style.textContent !== sheet?.textContent) return holder.replaceChildren(next);
  sheet.remove();
  for (const child of [...svg.childNodes]) if (child !== style) child.remove();
  for (const { name, value } of next.attributes) svg.setAttribute(name, value);
  return svg.append(...next.childNodes);
};

/// Replaces the mechanism by that of another picture of the same scale; names stay beside their points.
const replaceMechanism = (holder, text) => {
  const old = byId(holder, "mechanism");
  const template = document.createElement("template");
  template.innerHTML = text;
  const mechanism = byId(template.content, "mechanism");
  const [names, others] = [byId(old, "names"), byId(mechanism, "names")];
  const points = new Map([...others.querySelectorAll("[data-point]")].map((it) => [it.dataset.point, it.dataset.follows]));
  for (const name of names.querySelectorAll("[data-point]")) name.dataset.follows = points.get(name.dataset.point) ?? name.dataset.follows;
  others.replaceWith(names);
  mechanism.setAttribute("transform", old.getAttribute("transform"));
  old.replaceWith(mechanism);
};

const FOCUSABLE = "a, button, input, select, summary, [tabindex]";

/// Sections by name, in the order of the page.
const sectionsOf = (root) => new Map([...root.querySelectorAll("[data-section]")].map((it) => [it.dataset.section, it]));

/// Replaces sections. What is at the top of the window stays there.
const replaceSections = (root, sections) => {
  const all = sectionsOf(root);
  const visible = [...all.values()].find((it) => it.getBoundingClientRect().bottom > 0);
  const before = visible?.getBoundingClientRect().top;
  for (const [name, html] of Object.entries(sections)) {
    const section = all.get(name);
    if (!section || section.text === html) continue;
    const opened = [...section.querySelectorAll("details[open] > summary")].map((it) => it.textContent);
    const focused = [...section.querySelectorAll(FOCUSABLE)].indexOf(document.activeElement);
    section.innerHTML = html ?? "";
    section.text = html;
    section.hidden = !html;
    for (const summary of section.querySelectorAll("summary")) if (opened.includes(summary.textContent)) summary.parentElement.open = true;
    if (focused >= 0) section.querySelectorAll(FOCUSABLE)[focused]?.focus({ preventScroll: true });
    const link = root.querySelector(`nav a[href="#${CSS.escape(name)}"]`);
    if (link) link.hidden = !html;
  }
  if (!visible || before >= 0) return;
  const keep = () => {
    const moved = visible.getBoundingClientRect().top - before;
    if (Math.abs(moved) > 1) scrollBy({ top: moved, behavior: "instant" });
  };
  keep();
  // Sections above take the heights that they have outside of the window after the next frame.
  requestAnimationFrame(() => requestAnimationFrame(keep));
};
