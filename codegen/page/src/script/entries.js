// The picture of Φ_q and its entries.

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
