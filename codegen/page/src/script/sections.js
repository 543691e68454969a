// Sections of text: their replacement keeps what is open, focused and looked at.

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

/// The cells of the picture of Φ_q: pointing at one shows its entry.
const showEntry = (root, target) => {
  const cell = target.closest?.(".pattern [data-entry]");
  if (!cell || !root.contains(cell)) return;
  const figure = cell.closest("figure");
  const output = figure.querySelector("output");
  const entry = root.querySelector(`.entry[data-entry="${cell.dataset.entry}"]`);
  const [row, column] = numbers(cell.dataset.entry);
  if (!entry || output.dataset.entry === cell.dataset.entry) return;
  output.dataset.entry = cell.dataset.entry;
  const name = root.querySelector(`.names [data-q="${column}"]`)?.outerHTML ?? "";
  const slope = `<math><mfrac><mrow><mo>∂</mo><msub><mi mathvariant="normal">Φ</mi><mn>${row + 1}</mn></msub></mrow><mrow><mo>∂</mo>${name}</mrow></mfrac><mo>=</mo></math>`;
  output.innerHTML = `${slope} ${entry.querySelector(".value").innerHTML}`;
};
