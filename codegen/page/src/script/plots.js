// Plots.

const COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#7a5195"];
const DASHES = ["", "8 4", "2 3", "10 3 2 3", "14 5"];
const LEVELS = ["", "rate", "acceleration"];
const curves = [];
data.coordinates.forEach((own, index) => {
  const pose = own.body === null ? null : data.bodies[own.body].pose;
  const axis = pose ? pose.indexOf(index) : -1;
  curves.push({
    is: `q${index}`,
    of: own.body === null ? "" : `b${own.body}`,
    letter: axis < 0 ? own.name : ["x", "y", "φ"][axis],
    index: axis < 0 ? "" : data.bodies[own.body].name,
    mathml: own.mathml,
    kind: own.kind,
    value: (it, level) => it.q[index][level],
  });
});
data.points.forEach((own, index) => {
  ["x", "y"].forEach((letter, axis) => {
    curves.push({
      is: `p${index}`,
      of: `b${own.body}`,
      letter,
      index: own.name,
      kind: "points",
      value: (it, level) => it.points[index][level][axis],
    });
  });
});
const between = (column, time) => {
  const [k, s] = interval(player.times, time);
  const here = at(column, k);
  return s === 0 ? here : here + s * (at(column, k + 1) - here);
};
data.measures.forEach((name, index) => {
  curves.push({
    is: `m${index}`,
    of: "",
    letter: name,
    index: "",
    kind: "determinants",
    value: (it) => between(player.measures[index], it.t),
  });
});
(data.forces ?? []).forEach(([name, unit], index) => {
  curves.push({
    is: `f${index}`,
    of: "",
    letter: name,
    index: "",
    kind: { N: "forces", "N*m": "torques", W: "powers" }[unit] ?? "energies",
    value: (it) => between(player.forces[index], it.t),
  });
});
const UNITS = { ...data.units, determinants: [["0 is singular", 1]] };
const TITLES = { angles: "Angles", lengths: "Coordinates x and y", points: "Points", contacts: "Contacts", forces: "Forces", torques: "Torques", powers: "Powers", energies: "Energies", determinants: "Normalized determinants" };
const shown = new Set();
const choose = (kind, most) => {
  const moving = curves.filter((it) => it.kind === kind && moves(samples.map((sampled) => it.value(sampled, 0))));
  for (const curve of moving.slice(0, most)) shown.add(curve);
};
let charts = [];

const labelled = (parent, curve, x, y) => {
  const label = drawn("text", { x, y, class: "label" }, parent);
  label.append(curve.letter);
  if (curve.index) {
    const index = drawn("tspan", { dy: 3, "font-size": "0.8em" }, label);
    index.textContent = curve.index;
  }
};

const plot = () => {
  const holder = find("charts");
  holder.replaceChildren();
  charts = [];
  if (!player || player.times.length < 2) return;
  const width = Math.max(300, Math.min(1100, holder.clientWidth || 720));
  for (const kind of Object.keys(TITLES)) {
    const own = curves.filter((it) => it.kind === kind && shown.has(it));
    if (own.length === 0) continue;
    UNITS[kind].forEach((unit, level) => {
      chart(holder, own, `${TITLES[kind]}${level ? `: ${LEVELS[level]}` : ""}`, unit, level, width, kind === "determinants");
    });
  }
};

const chart = (holder, own, title, [unit, scale], level, width, isUnit) => {
  const figure = document.createElement("figure");
  figure.className = "chart";
  const caption = document.createElement("figcaption");
  caption.textContent = unit ? `${title}, ${unit}` : title;
  figure.append(caption);
  holder.append(figure);
  const [left, right, top, height] = [62, 64, 8, 132];
  const root = drawn("svg", { viewBox: `0 0 ${width} ${height + top + 22}`, role: "img", "aria-label": `${title} over time` }, figure);
  const [first, last] = [player.times[0], player.times.at(-1)];
  const values = own.map((curve) => samples.map((it) => scale * curve.value(it, level)));
  let [low, high] = [Infinity, -Infinity];
  for (const value of values.flat()) [low, high] = [Math.min(low, value), Math.max(high, value)];
  if (isUnit) [low, high] = [Math.min(0, low), Math.max(1, high)];
  if (high - low < 1e-6 * Math.max(1e-3 * scale, Math.abs(high))) [low, high] = [low - 1e-3 * scale, high + 1e-3 * scale];
  const x = (time) => left + ((time - first) / (last - first)) * (width - left - right);
  const y = (value) => top + (1 - (value - low) / (high - low)) * height;
  const grid = drawn("g", { class: "grid" }, root);
  const ticks = (from, to, count) => {
    const every = round((to - from) / count);
    const found = [];
    for (let k = Math.ceil(from / every - 1e-9); k * every <= to + 1e-9 * every; k += 1) found.push(k * every);
    return found;
  };
  for (const value of ticks(low, high, 4)) {
    drawn("path", { d: `M${left} ${y(value)}H${width - right}` }, grid);
    drawn("text", { x: left - 6, y: y(value) + 4, "text-anchor": "end" }, grid).textContent = text(value);
  }
  for (const time of ticks(first, last, width < 500 ? 4 : 10)) {
    drawn("path", { d: `M${x(time)} ${top}V${top + height}` }, grid);
    drawn("text", { x: x(time), y: top + height + 16, "text-anchor": "middle" }, grid).textContent = text(time);
  }
  const dots = own.map((curve, place) => {
    const order = curves.filter((it) => it.kind === curve.kind).indexOf(curve);
    const group = drawn("g", { class: "curve", "data-is": curve.is, "data-of": curve.of, style: `--color:${COLORS[order % COLORS.length]}` }, root);
    const d = pathOf(samples.map((it, index) => [x(it.t), y(values[place][index])]));
    drawn("path", { class: "hit", d }, group);
    drawn("path", { class: "line", d, "stroke-dasharray": DASHES[order % DASHES.length] }, group);
    return [drawn("circle", { r: 3.5 }, group), curve, group];
  });
  // Names stand at the ends of the curves, one below the other where these are close.
  const ends = dots.map(([, curve, group], place) => ({ curve, group, y: y(values[place].at(-1)) }));
  ends.sort((a, b) => a.y - b.y);
  let taken = top - 6;
  const room = (height + 8) / Math.max(1, ends.length);
  for (const end of ends) {
    taken = Math.max(end.y + 4, taken + Math.min(13, room));
    end.at = taken;
  }
  let limit = top + height + 8;
  for (const end of ends.reverse()) {
    end.at = Math.min(end.at, limit);
    limit = end.at - Math.min(13, room);
    labelled(end.group, end.curve, width - right + 6, end.at);
  }
  const cursor = drawn("path", { class: "cursor", d: `M0 ${top}V${top + height}` }, root);
  const seek = (event) => {
    const area = root.getBoundingClientRect();
    const part = (((event.clientX - area.left) / area.width) * width - left) / (width - left - right);
    pause();
    go(first + Math.min(1, Math.max(0, part)) * (last - first));
  };
  root.addEventListener("pointerdown", (event) => {
    seek(event);
    root.setPointerCapture(event.pointerId);
  });
  root.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) seek(event);
  });
  charts.push((now) => {
    cursor.setAttribute("transform", `translate(${x(t).toFixed(2)} 0)`);
    for (const [dot, curve] of dots) {
      dot.setAttribute("cx", x(t).toFixed(2));
      dot.setAttribute("cy", y(scale * curve.value(now, level)).toFixed(2));
    }
  });
};

const chips = () => {
  const holder = find("chips");
  holder.replaceChildren();
  for (const kind of Object.keys(TITLES)) {
    const own = curves.filter((it) => it.kind === kind);
    if (own.length === 0) continue;
    const row = document.createElement("p");
    row.append(`${TITLES[kind]}: `);
    own.forEach((curve, order) => {
      const chip = document.createElement("button");
      chip.type = "button";
      chip.className = "chip";
      chip.dataset.is = curve.is;
      chip.dataset.of = curve.of;
      chip.setAttribute("aria-pressed", String(shown.has(curve)));
      const key = drawn("svg", { viewBox: "0 0 26 8", width: 26, height: 8, "aria-hidden": "true", style: `--color:${COLORS[order % COLORS.length]}` }, chip);
      drawn("path", { class: "line", d: "M0 4H26", "stroke-dasharray": DASHES[order % DASHES.length] }, key);
      const name = document.createElement("span");
      if (curve.mathml) name.innerHTML = `<math>${curve.mathml}</math>`;
      else {
        name.append(curve.letter);
        const index = document.createElement("sub");
        index.textContent = curve.index;
        name.append(index);
      }
      chip.append(name);
      chip.addEventListener("click", () => {
        if (!shown.delete(curve)) shown.add(curve);
        chip.setAttribute("aria-pressed", String(shown.has(curve)));
        plot();
        gather();
        show();
      });
      row.append(chip);
    });
    holder.append(row);
  }
  if (data.points.some((point) => point.body > 0)) {
    const row = document.createElement("p");
    row.append("Paths in the drawing: ");
    data.points.forEach((point, index) => {
      if (point.body === 0) return;
      const chip = document.createElement("button");
      chip.type = "button";
      chip.className = "chip";
      chip.dataset.is = `p${index}`;
      chip.dataset.of = `b${point.body}`;
      chip.setAttribute("aria-pressed", String(traced.has(index)));
      chip.textContent = point.name;
      chip.addEventListener("click", () => {
        if (!traced.delete(index)) traced.add(index);
        chip.setAttribute("aria-pressed", String(traced.has(index)));
        trace();
        gather();
        show();
      });
      row.append(chip);
    });
    holder.append(row);
  }
};

