// Charts: curves of one kind over time. One that is not visible is drawn when it comes into view.

const COLORS = 7;
const DASHES = ["", "8 4", "2 3", "10 3 2 3", "14 5"];
const [LEFT, RIGHT, TOP] = [62, 64, 8];
/// Height of a chart of this width.
const heightOf = (width) => Math.round(Math.max(132, Math.min(220, width / 4)));
/// Distance in pixels from the window in which charts are drawn already.
const NEAR = 300;

/// Attributes that give a curve its color and its dashes.
const lookOf = ({ order }) => [`curve-${order % COLORS}`, DASHES[order % DASHES.length]];

/// Round numbers in a range, about as many as requested.
const ticks = (from, to, count) => {
  const every = round((to - from) / count);
  const found = [];
  for (let k = Math.ceil(from / every - 1e-9); k * every <= to + 1e-9 * every; k += 1) found.push(k * every);
  return found;
};

/// Heights in a chart as text, to a tenth of a pixel. They are few, and numbers take long to write.
const heights = [];
const tenth = (height) => {
  const tenths = Math.round(height * 10);
  heights[tenths] ??= String(tenths / 10);
  return heights[tenths];
};

class Chart {
  /// `seek` is called with a share of the range of time, `changed` after elements have been made.
  constructor(kind, level, seek, changed) {
    Object.assign(this, { kind, level, seek, changed, isVisible: false, isStale: true, dots: [] });
    this.caption = made("figcaption");
    this.figure = made("figure", { class: "chart" }, this.caption);
    // Its values are told when it is drawn.
    this.svg = drawn("svg", { role: "img", "aria-label": kind }, this.figure);
    this.svg.addEventListener("pointerdown", (event) => {
      this.point(event);
      this.svg.setPointerCapture(event.pointerId);
    });
    this.svg.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) this.point(event);
    });
  }

  point(event) {
    const area = this.svg.getBoundingClientRect();
    const part = (((event.clientX - area.left) / area.width) * this.width - LEFT) / (this.width - LEFT - this.right);
    this.seek(Math.min(1, Math.max(0, part)));
  }

  /// Takes new values, which are drawn later.
  prepare(curves, samples, [unit, scale], width, right) {
    Object.assign(this, { curves, samples, scale, width, right, height: heightOf(width), isStale: true });
    this.title = `${TITLES[this.kind] ?? "Measures"}${this.level ? `: ${LEVELS[this.level]}` : ""}`;
    this.unit = unit;
    this.caption.textContent = unit ? `${this.title}, ${unit}` : this.title;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height + TOP + 22}`);
  }

  draw() {
    this.isStale = false;
    const { svg, curves, samples, scale, width, height } = this;
    const values = curves.map((curve) => curve.values(samples, this.level).map((value) => scale * value));
    const ranges = values.map(rangeOf);
    let [low, high] = [Math.min(...ranges.map(([it]) => it)), Math.max(...ranges.map(([, it]) => it))];
    if (this.kind === "determinants") [low, high] = [Math.min(0, low), Math.max(1, high)];
    if (high - low < 1e-6 * Math.max(1e-3 * scale, Math.abs(high))) [low, high] = [low - 1e-3 * scale, high + 1e-3 * scale];
    const [first, last] = [samples.times[0], samples.times.at(-1)];
    const x = (time) => LEFT + ((time - first) / (last - first)) * (width - LEFT - this.right);
    const y = (value) => TOP + (1 - (value - low) / (high - low)) * height;
    Object.assign(this, { x, y });
    const about = curves.map((curve, place) => `${curve.letter}${curve.index} from ${text(ranges[place][0])} to ${text(ranges[place][1])}`);
    svg.setAttribute("aria-label", `${this.title} over time: ${about.join(", ")} ${this.kind === "determinants" ? "" : this.unit}`);
    this.build();
    this.verticals(first, last);
    this.horizontals(low, high);
    const steps = samples.times.map((time, index) => `${index ? "L" : "M"}${hundredths(x(time))} `);
    this.dots.forEach((own, place) => {
      let [line, hit] = ["", ""];
      values[place].forEach((value, index) => {
        const step = steps[index] + tenth(y(value));
        line += step;
        // A wide line for the pointer needs fewer points.
        if (index % 4 === 0 || index === steps.length - 1) hit += step;
      });
      own.curve = curves[place];
      own.y = y(values[place].at(-1));
      own.hit.setAttribute("d", hit);
      own.line.setAttribute("d", line);
    });
    this.label();
  }

  /// Makes the elements of the curves, which stay while the curves do.
  build() {
    const shape = JSON.stringify(this.curves.map(({ is, name, order }) => [is, name, order]));
    if (shape === this.shape) return;
    this.shape = shape;
    this.frame = null;
    const { svg } = this;
    svg.replaceChildren();
    this.grids = [drawn("g", { class: "grid" }, svg), drawn("g", { class: "grid" }, svg)];
    this.dots = this.curves.map((curve) => {
      const [color, dashes] = lookOf(curve);
      const group = drawn("g", { class: `curve ${color}`, "data-is": curve.is, "data-of": curve.of }, svg);
      const hit = drawn("path", { class: "hit" }, group);
      const line = drawn("path", { class: "line", "stroke-dasharray": dashes }, group);
      const dot = drawn("circle", { r: 3.5 }, group);
      const label = drawn("text", { class: "label" }, group);
      label.append(curve.letter);
      if (curve.index) drawn("tspan", { dy: 3, "font-size": "0.8em" }, label).textContent = curve.index;
      return { hit, line, dot, label, curve };
    });
    this.cursor = drawn("path", { class: "cursor" }, svg);
    this.changed();
  }

  /// Lines and numbers of times, which are those of all motions of a range.
  verticals(first, last) {
    const frame = `${first} ${last} ${this.width} ${this.right}`;
    if (frame === this.frame) return;
    this.frame = frame;
    const [grid] = this.grids;
    const bottom = TOP + this.height;
    this.cursor.setAttribute("d", `M0 ${TOP}V${bottom}`);
    grid.replaceChildren();
    for (const time of ticks(first, last, this.width < 500 ? 4 : 10)) {
      const x = this.x(time);
      drawn("path", { d: `M${x} ${TOP}V${bottom}` }, grid);
      drawn("text", { x, y: bottom + 16, "text-anchor": "middle" }, grid).textContent = text(time);
    }
  }

  horizontals(low, high) {
    const [, grid] = this.grids;
    grid.replaceChildren();
    for (const value of ticks(low, high, 4)) {
      const y = this.y(value);
      drawn("path", { d: `M${LEFT} ${y}H${this.width - this.right}` }, grid);
      drawn("text", { x: LEFT - 6, y: y + 4, "text-anchor": "end" }, grid).textContent = text(value);
    }
  }

  /// Puts names at the ends of the curves, one below the other where these are close.
  label() {
    const ends = [...this.dots].sort((a, b) => a.y - b.y);
    const room = Math.min(13, (this.height + 8) / Math.max(1, ends.length));
    let taken = TOP - 6;
    for (const end of ends) {
      taken = Math.max(end.y + 4, taken + room);
      end.at = taken;
    }
    let limit = TOP + this.height + 8;
    for (const end of ends.reverse()) {
      end.at = Math.min(end.at, limit);
      limit = end.at - room;
      end.label.setAttribute("x", this.width - this.right + 6);
      end.label.setAttribute("y", hundredths(end.at));
    }
  }

  move(t, place) {
    const at = this.x(t).toFixed(2);
    this.cursor.setAttribute("transform", `translate(${at} 0)`);
    for (const { dot, curve } of this.dots) {
      dot.setAttribute("cx", at);
      dot.setAttribute("cy", this.y(this.scale * curve.value(this.samples.player, place, this.level)).toFixed(2));
    }
  }
}

class Charts {
  constructor(holder, seek, changed) {
    Object.assign(this, { holder, seek, changed, charts: new Map(), all: [], t: null });
    this.seen = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries) {
          const chart = this.all.find((it) => it.figure === target);
          if (chart) chart.isVisible = isIntersecting;
        }
        this.draw();
      },
      { rootMargin: `${NEAR}px` },
    );
    this.width = 0;
    this.resized = new ResizeObserver(() => {
      if (!this.samples || this.measure() === this.width) return;
      this.width = 0;
      this.prepare(this.curves, this.samples, this.units);
    });
    this.resized.observe(holder);
  }

  measure() {
    const column = this.all[0]?.figure.clientWidth || this.holder.clientWidth || 720;
    return Math.max(280, Math.min(1100, column));
  }

  /// Shows these curves; without a motion there is none.
  prepare(curves, samples, units) {
    Object.assign(this, { curves, samples, units });
    const kinds = titled(curves).map(([kind]) => [kind, curves.filter((it) => it.kind === kind)]);
    // What was chosen first is first on the page.
    kinds.sort(([, a], [, b]) => (a[0]?.rank ?? 0) - (b[0]?.rank ?? 0));
    const wanted = [];
    for (const [kind, own] of samples && samples.player.times.length > 1 ? kinds : []) {
      if (own.length) units[kind].forEach((unit, level) => wanted.push({ kind, level, own, unit }));
    }
    const before = this.all;
    this.all = wanted.map(({ kind, level }) => {
      const key = `${kind} ${level}`;
      if (!this.charts.has(key)) this.charts.set(key, new Chart(kind, level, this.seek, this.changed));
      return this.charts.get(key);
    });
    const isSame = before.length === this.all.length && before.every((it, index) => it === this.all[index]);
    if (!isSame) {
      this.holder.replaceChildren(...this.all.map((it) => it.figure));
      for (const chart of before) if (!this.all.includes(chart)) this.seen.unobserve(chart.figure);
    }
    // To measure is to lay everything out, so that it is done only if the width can have changed.
    if (!isSame || !this.width) this.width = this.measure();
    // Names beside the curves are as long as their description has them; all charts have one axis of time.
    const lengths = wanted.flatMap(({ own }) => own.map((it) => it.letter.length + 0.8 * it.index.length));
    const right = Math.min(Math.max(RIGHT, 12 + 7.5 * Math.max(0, ...lengths)), 0.3 * this.width);
    this.all.forEach((chart, index) => chart.prepare(wanted[index].own, samples, wanted[index].unit, this.width, right));
    if (!isSame) {
      for (const chart of this.all) {
        const { top, bottom } = chart.figure.getBoundingClientRect();
        chart.isVisible = bottom > -NEAR && top < innerHeight + NEAR;
        this.seen.observe(chart.figure);
      }
    }
    this.draw();
  }

  /// Draws what is visible, or everything for paper.
  draw(everything = false) {
    const stale = this.all.filter((it) => it.isStale && (it.isVisible || everything));
    for (const chart of stale) chart.draw();
    if (this.t !== null) this.show(this.t);
  }

  show(t) {
    this.t = t;
    if (!this.samples) return;
    const place = interval(this.samples.player.times, t);
    for (const chart of this.all) if (!chart.isStale) chart.move(t, place);
  }

  end() {
    this.seen.disconnect();
    this.resized.disconnect();
  }
}
