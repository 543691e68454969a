// Buttons that choose the curves in the charts and the paths in the drawing.

const chip = (name, is, of, isPressed, ...contents) => {
  const own = { type: "button", class: "chip", "data-is": is, "data-of": of, "aria-pressed": String(isPressed), "aria-label": name };
  return made("button", own, ...contents);
};

const sample = (curve) => {
  const [color, dashes] = lookOf(curve);
  const key = drawn("svg", { viewBox: "0 0 26 8", width: 26, height: 8, "aria-hidden": "true", class: color });
  drawn("path", { class: "line", d: "M0 4H26", "stroke-dasharray": dashes }, key);
  return key;
};

const nameOf = (curve) => {
  const name = made("span");
  if (curve.mathml) name.innerHTML = `<math>${curve.mathml}</math>`;
  else name.append(curve.letter, made("sub", {}, curve.index));
  return name;
};

/// Rows of buttons. `shown` has names of curves, `traced` names of points; `plot` and `trace` are called after a change.
const chooser = (holder, { curves, points }, shown, traced, plot, trace) => {
  const rows = [];
  const row = (title, buttons) => {
    if (buttons.length) rows.push(made("p", {}, `${title}: `, ...buttons));
  };
  const toggled = (names, name, button, after) => {
    button.addEventListener("click", () => {
      if (!names.delete(name)) names.add(name);
      button.setAttribute("aria-pressed", String(names.has(name)));
      after();
    });
    return button;
  };
  for (const [kind, title] of titled(curves)) {
    const own = curves.filter((it) => it.kind === kind);
    row(title, own.map((curve) => {
      const button = chip(`${curve.letter} ${curve.index}`.trim(), curve.is, curve.of, shown.has(curve.name), sample(curve), nameOf(curve));
      return toggled(shown, curve.name, button, plot);
    }));
  }
  const moving = points.map((point, index) => ({ ...point, index })).filter((it) => it.body > 0);
  row("Paths in the drawing", moving.map(({ name, body, index }) => toggled(traced, name, chip(name, `p${index}`, `b${body}`, traced.has(name), name), trace)));
  holder.replaceChildren(...rows);
};
