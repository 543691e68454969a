"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const find = (id) => document.getElementById(id);
  const SVG = "http://www.w3.org/2000/svg";
  const drawn = (name, attributes, parent) => {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (parent) parent.append(element);
    return element;
  };

  // ---- Motions: numbers at kept instants, and polynomials between them that have their rates and accelerations too.

  const columns = new Map();
  const column = (place) => {
    if (!columns.has(place)) {
      const stored = data.columns[place];
      if (typeof stored === "number") columns.set(place, stored);
      else {
        const letters = atob(stored);
        const bytes = new Uint8Array(letters.length);
        for (let index = 0; index < letters.length; index += 1) bytes[index] = letters.charCodeAt(index);
        columns.set(place, new Float32Array(bytes.buffer));
      }
    }
    return columns.get(place);
  };
  const at = (place, index) => {
    const values = column(place);
    return typeof values === "number" ? values : values[index];
  };

  /// The place of t among the times: the index before it, and which part of the interval has passed.
  const interval = (times, t) => {
    let [low, high] = [0, times.length - 1];
    if (high === 0 || t <= times[0]) return [0, 0, 0];
    if (t >= times[high]) return [high, 0, 0];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= t) low = middle;
      else high = middle;
    }
    const length = times[high] - times[low];
    return [low, (t - times[low]) / length, length];
  };

  const coordinate = (player, index, [k, s, h]) => {
    const [q, rate, acceleration] = player.coordinates[index];
    const here = [at(q, k), at(rate, k), at(acceleration, k)];
    if (s === 0) return here;
    const [c0, c1, c2] = [here[0], h * here[1], 0.5 * h * h * here[2]];
    const d = at(q, k + 1) - c0 - c1 - c2;
    const e = h * at(rate, k + 1) - c1 - 2 * c2;
    const f = h * h * at(acceleration, k + 1) - 2 * c2;
    const [c3, c4, c5] = [10 * d - 4 * e + 0.5 * f, -15 * d + 7 * e - f, 6 * d - 3 * e + 0.5 * f];
    return [
      c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
      (c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h,
      (2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / (h * h),
    ];
  };

  const state = (player, t) => {
    const place = interval(player.times, t);
    return data.coordinates.map((_, index) => coordinate(player, index, place));
  };

  const still = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  const poseOf = (q, body) => {
    const pose = data.bodies[body].pose;
    return pose ? pose.map((index) => q[index]) : still;
  };

  /// Position, velocity and acceleration of a point.
  const motionOf = (q, point) => {
    const [x, y, angle] = poseOf(q, point.body);
    const [c, s] = [Math.cos(angle[0]), Math.sin(angle[0])];
    const [rx, ry] = [c * point.local[0] - s * point.local[1], s * point.local[0] + c * point.local[1]];
    const [w, a] = [angle[1], angle[2]];
    return [
      [x[0] + rx, y[0] + ry],
      [x[1] - w * ry, y[1] + w * rx],
      [x[2] - a * ry - w * w * rx, y[2] + a * rx - w * w * ry],
    ];
  };

  // ---- The drawing: groups that say which frame they are in are put there. Here y points downwards.

  const svg = document.querySelector("#drawing svg");
  const numbers = (text) => text.split(" ").map(Number);

  class Stage {
    constructor(root) {
      this.root = root;
      this.scale = Number(root.dataset.scale);
      const all = (name) => [...root.querySelectorAll(`[data-${name}]`)];
      this.bodies = all("body").map((element) => [element, Number(element.dataset.body)]);
      this.riders = all("at").map((element) => [element, numbers(element.dataset.at), Number(element.dataset.turned)]);
      this.links = all("from").map((element) => ({
        element,
        from: numbers(element.dataset.from),
        to: numbers(element.dataset.to),
        stretches: element.querySelector(".massless") !== null,
      }));
      this.names = all("follows").map((element) => ({ element, at: numbers(element.dataset.follows) }));
      this.stills = all("still");
    }

    /// Where a body is: x and y in pixels, and its angle, clockwise as y points.
    place(q, body) {
      const [x, y, angle] = poseOf(q, body);
      return [x[0] * this.scale, -y[0] * this.scale, -angle[0]];
    }

    global(q, [body, x, y]) {
      const [ox, oy, angle] = this.place(q, body);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      return [ox + c * x - s * y, oy + s * x + c * y];
    }

    show(q) {
      const put = (element, x, y, angle, rest = "") => {
        element.setAttribute("transform", `translate(${x.toFixed(3)} ${y.toFixed(3)})rotate(${((angle * 180) / Math.PI).toFixed(4)})${rest}`);
      };
      for (const [element, body] of this.bodies) put(element, ...this.place(q, body));
      for (const [element, where, body] of this.riders) {
        put(element, ...this.global(q, where), this.place(q, body)[2]);
      }
      for (const link of this.links) {
        const [from, to] = [this.global(q, link.from), this.global(q, link.to)];
        const [x, y] = [to[0] - from[0], to[1] - from[1]];
        const length = Math.hypot(x, y);
        link.length ??= length;
        const rest = link.stretches && link.length > 0 ? `scale(${(length / link.length).toFixed(5)} 1)` : "";
        put(link.element, ...from, Math.atan2(y, x), rest);
      }
      for (const name of this.names) {
        const [x, y] = this.global(q, name.at);
        name.first ??= [x, y];
        name.element.setAttribute("transform", `translate(${(x - name.first[0]).toFixed(2)} ${(y - name.first[1]).toFixed(2)})`);
      }
    }
  }

  const mechanism = svg.querySelector("#mechanism");
  const stage = new Stage(mechanism);
  const box = svg.getAttribute("viewBox");
  svg.removeAttribute("width");
  svg.removeAttribute("height");
  svg.style.maxWidth = `${numbers(box)[2]}px`;

  // ---- What is shown.

  const solved = data.assemblies.filter((it) => it.times);
  let player = data.assemblies[0].times ? data.assemblies[0] : solved[0];
  let t = player ? player.times[0] : 0;
  const traced = new Set(data.points.map((_, index) => index).filter((index) => data.points[index].free).slice(0, 3));
  const traces = drawn("g", { id: "traces" });
  mechanism.insertBefore(traces, mechanism.querySelector("#names"));

  const text = (value) => {
    if (Math.abs(value) < 1e-9) return "0";
    const size = Math.abs(value);
    const digits = size >= 1e-3 && size < 1e6 ? String(Number(value.toPrecision(6))) : value.toExponential(4);
    return digits.replaceAll("-", "−");
  };
  const moves = (values) => {
    let [low, high] = [Infinity, -Infinity];
    for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
    return high - low > 1e-6 * Math.max(1e-3, Math.abs(low), Math.abs(high));
  };

  /// Times at which curves and paths are drawn: those that are kept, or more where these are few.
  let samples = [];
  const sample = () => {
    const times = player.times;
    const between = Math.max(1, Math.ceil(200 / times.length));
    samples = [];
    const take = (time) => {
      const q = state(player, time);
      samples.push({ t: time, q, points: data.points.map((point) => motionOf(q, point)) });
    };
    times.forEach((time, index) => {
      take(time);
      const next = times[index + 1];
      for (let part = 1; next !== undefined && part < between; part += 1) take(time + ((next - time) * part) / between);
    });
  };

  const pathOf = (points) => points.map(([x, y], index) => `${index ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`).join("");
  const round = (least) => {
    const power = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map((digit) => digit * power).find((value) => value >= least * (1 - 1e-9));
  };

  const trace = () => {
    traces.replaceChildren();
    for (const index of traced) {
      const group = drawn("g", { "data-is": `p${index}`, "data-of": `b${data.points[index].body}` }, traces);
      const place = ([x, y]) => [x * stage.scale, -y * stage.scale];
      drawn("path", { class: "path", d: pathOf(samples.map((it) => place(it.points[index][0]))) }, group);
      const [first, last] = [player.times[0], player.times.at(-1)];
      if (last > first) {
        const every = round((last - first) / 24);
        for (let time = first; time <= last + 1e-9; time += every) {
          const [x, y] = place(motionOf(state(player, time), data.points[index])[0]);
          drawn("circle", { class: "tick", cx: x.toFixed(2), cy: y.toFixed(2), r: 2.2 }, group);
        }
      }
      drawn("circle", { class: "now", r: 5 }, group).dataset.now = index;
    }
  };

  // ---- Plots.

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
      kind: { rad: "angles", m: "lengths" }[own.unit] ?? "contacts",
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
  data.measures.forEach((name, index) => {
    curves.push({
      is: `m${index}`,
      of: "",
      letter: name,
      index: "",
      kind: "determinants",
      value: (it) => {
        const [k, s] = interval(player.times, it.t);
        const here = at(player.measures[index], k);
        return s === 0 ? here : here + s * (at(player.measures[index], k + 1) - here);
      },
    });
  });
  const UNITS = { angles: ["rad", "rad/s", "rad/s²"], lengths: ["m", "m/s", "m/s²"], points: ["m", "m/s", "m/s²"], contacts: ["", "1/s", "1/s²"], determinants: ["0 is singular"] };
  const TITLES = { angles: "Angles", lengths: "Coordinates x and y", points: "Points", contacts: "Contacts", determinants: "Determinants, normalized" };
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

  const chart = (holder, own, title, unit, level, width, isUnit) => {
    const figure = document.createElement("figure");
    figure.className = "chart";
    const caption = document.createElement("figcaption");
    caption.textContent = unit ? `${title}, ${unit}` : title;
    figure.append(caption);
    holder.append(figure);
    const [left, right, top, height] = [62, 64, 8, 132];
    const root = drawn("svg", { viewBox: `0 0 ${width} ${height + top + 22}`, role: "img", "aria-label": `${title} over time` }, figure);
    const [first, last] = [player.times[0], player.times.at(-1)];
    const values = own.map((curve) => samples.map((it) => curve.value(it, level)));
    let [low, high] = [Infinity, -Infinity];
    for (const value of values.flat()) [low, high] = [Math.min(low, value), Math.max(high, value)];
    if (isUnit) [low, high] = [Math.min(0, low), Math.max(1, high)];
    if (high - low < 1e-6 * Math.max(1e-3, Math.abs(high))) [low, high] = [low - 1e-3, high + 1e-3];
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
        dot.setAttribute("cy", y(curve.value(now, level)).toFixed(2));
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

  // ---- Pointing at something lights what it is about, and what is about it.

  let items = [];
  const words = (value) => (value ?? "").split(" ").filter(Boolean);
  data.bodies.forEach((body, index) => {
    const element = svg.querySelector(`[id="body-${CSS.escape(body.name)}"]`);
    if (element && index > 0) element.dataset.is = `b${index}`;
  });
  data.joints.forEach((joint, index) => {
    for (const suffix of ["", "-below", "-upon"]) {
      const element = svg.querySelector(`[id="joint-${CSS.escape(joint.slug)}${suffix}"]`);
      if (!element) continue;
      element.dataset.is = `j${index}`;
      element.dataset.of = joint.bodies.map((body) => `b${body}`).join(" ");
    }
  });
  for (const name of stage.names) {
    const point = data.points.findIndex((it) => it.name === name.element.dataset.point);
    name.element.dataset.is = point < 0 ? `b${name.at[0]}` : `p${point}`;
  }
  for (const block of document.querySelectorAll("section.block")) block.dataset.of = block.dataset.joints;

  const gather = () => {
    items = [...document.querySelectorAll("[data-is], [data-of]")].map((element) => {
      const symbols = element.matches(".equation, .pose, section.block, tr") ? [...element.querySelectorAll("[data-q]")] : [];
      return { element, is: new Set(words(element.dataset.is)), of: new Set([...words(element.dataset.of), ...symbols.map((it) => `q${it.dataset.q}`)]) };
    });
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
    const symbols = element?.matches(".equation, .pose, tr") ? [...element.querySelectorAll("[data-q]")].map((it) => `q${it.dataset.q}`) : [];
    const own = symbol
      ? { is: new Set([`q${symbol.dataset.q}`]), of: new Set(bodyOf(symbol.dataset.q)) }
      : { is: new Set(words(element.dataset.is)), of: new Set([...words(element.dataset.of), ...symbols]) };
    for (const item of items) {
      if (item.element === source || meet(item.is, own.is) || meet(item.is, own.of) || meet(item.of, own.is)) item.element.classList.add("lit");
    }
    const named = [...own.is].filter((it) => it[0] === "q").map((it) => `[data-q="${it.slice(1)}"]`);
    if (named.length) sheet.textContent = `${named.join(",")}{background:var(--lit);outline:1px solid var(--accent)}`;
  };
  const bodyOf = (index) => {
    const body = data.coordinates[index]?.body;
    return body == null ? [] : [`b${body}`];
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

  // ---- Time.

  const slider = find("time");
  const play = find("play");
  let playing = false;
  let last = 0;

  const show = () => {
    if (!player) return;
    const place = interval(player.times, t);
    const now = { t, q: data.coordinates.map((_, index) => coordinate(player, index, place)) };
    now.points = data.points.map((point) => motionOf(now.q, point));
    stage.show(now.q);
    const isDrawn = player === data.assemblies[0] && t === player.times[0];
    for (const element of stage.stills) element.style.opacity = isDrawn ? "" : 0.15;
    for (const dot of traces.querySelectorAll("[data-now]")) {
      const [x, y] = now.points[dot.dataset.now][0];
      dot.setAttribute("cx", (x * stage.scale).toFixed(3));
      dot.setAttribute("cy", (-y * stage.scale).toFixed(3));
    }
    for (const update of charts) update(now);
    slider.value = t;
    slider.setAttribute("aria-valuetext", `${text(t)} s`);
    find("now").textContent = `${t.toFixed(3)} s`;
    if (find("live").open) list(now);
  };

  const list = (now) => {
    const table = find("values");
    if (table.rows.length === 0) {
      table.innerHTML = "<thead><tr><th></th><th>position</th><th>rate</th><th>acceleration</th><th>unit</th></tr></thead>";
      const body = table.createTBody();
      data.coordinates.forEach((own, index) => {
        const row = body.insertRow();
        row.dataset.is = `q${index}`;
        const head = document.createElement("th");
        head.innerHTML = `<math>${own.mathml}</math>`;
        row.append(head);
        for (let level = 0; level < 3; level += 1) row.insertCell();
        row.insertCell().textContent = own.unit;
      });
      gather();
    }
    data.coordinates.forEach((_, index) => {
      for (let level = 0; level < 3; level += 1) table.tBodies[0].rows[index].cells[level + 1].textContent = text(now.q[index][level]);
    });
  };

  const go = (time) => {
    t = Math.min(player.times.at(-1), Math.max(player.times[0], time));
    show();
  };
  const tick = (stamp) => {
    if (!playing) return;
    const [first, end] = [player.times[0], player.times.at(-1)];
    const next = t + ((stamp - last) / 1000) * Number(find("speed").value);
    last = stamp;
    go(next > end ? first : next);
    requestAnimationFrame(tick);
  };
  const label = () => {
    play.textContent = playing ? "❚❚ Pause" : "▶ Play";
    play.setAttribute("aria-pressed", String(playing));
  };
  const pause = () => {
    playing = false;
    label();
  };
  const toggle = () => {
    playing = !playing && player.times.length > 1;
    label();
    if (!playing) return;
    last = performance.now();
    requestAnimationFrame(tick);
  };
  play.addEventListener("click", toggle);
  slider.addEventListener("input", () => {
    pause();
    go(Number(slider.value));
  });
  find("names").addEventListener("change", (event) => {
    mechanism.querySelector("#names").style.display = event.target.checked ? "" : "none";
  });
  find("live").addEventListener("toggle", show);
  document.addEventListener("keydown", (event) => {
    if (event.target.closest("input, select, button, summary") || event.ctrlKey || event.metaKey || event.altKey || !player) return;
    const step = (player.times.at(-1) - player.times[0]) / 100;
    const action = { " ": toggle, ArrowRight: () => go(t + step), ArrowLeft: () => go(t - step), Home: () => go(-Infinity), End: () => go(Infinity) }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });

  // ---- Assemblies.

  const around = (root, poses) => {
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const q of poses) {
      root.show(q);
      const area = root.root.getBBox();
      [x0, y0, x1, y1] = [Math.min(x0, area.x), Math.min(y0, area.y), Math.max(x1, area.x + area.width), Math.max(y1, area.y + area.height)];
    }
    return [x0, y0, x1 - x0, y1 - y0];
  };
  const boxes = new Map();
  const frame = () => {
    if (player === data.assemblies[0]) return svg.setAttribute("viewBox", box);
    if (!boxes.has(player)) {
      const every = Math.max(1, Math.ceil(player.times.length / 24));
      const poses = player.times.filter((_, index) => index % every === 0).map((time) => state(player, time));
      const [x, y, width, height] = around(stage, poses);
      const [dx, dy] = numbers(mechanism.getAttribute("transform").replace(/^translate\(|\)$/g, ""));
      boxes.set(player, `${x + dx - 16} ${y + dy - 16} ${width + 32} ${height + 48}`);
    }
    svg.setAttribute("viewBox", boxes.get(player));
  };

  const pick = (own) => {
    if (!own.times) return;
    if (own !== player) {
      pause();
      player = own;
      sample();
      trace();
    }
    frame();
    plot();
    gather();
    slider.min = player.times[0];
    slider.max = player.times.at(-1);
    go(t);
    for (const button of find("thumbnails").children) button.setAttribute("aria-pressed", String(button.player === player));
    const error = find("assembly-error");
    error.hidden = !player.error;
    error.textContent = player.error ? `${player.label}: ${player.error}` : "";
  };

  const thumbnails = () => {
    const holder = find("thumbnails");
    for (const own of data.assemblies) {
      const button = document.createElement("button");
      button.type = "button";
      button.player = own;
      button.setAttribute("aria-pressed", String(own === player));
      if (own.times) {
        const picture = drawn("svg", { class: "linkwright", "aria-hidden": "true" }, button);
        const copy = mechanism.cloneNode(true);
        copy.removeAttribute("transform");
        for (const part of copy.querySelectorAll("#names, #traces, [data-still], title")) part.remove();
        for (const part of [copy, ...copy.querySelectorAll("*")]) {
          part.removeAttribute("id");
          delete part.dataset.is;
          delete part.dataset.of;
        }
        picture.append(copy);
        holder.append(button);
        const [x, y, width, height] = around(new Stage(copy), [state(own, own.times[0])]);
        const side = Math.max(width, height) + 16;
        picture.setAttribute("viewBox", `${x + width / 2 - side / 2} ${y + height / 2 - side / 2} ${side} ${side}`);
      } else {
        button.disabled = true;
        holder.append(button);
      }
      const caption = document.createElement("span");
      caption.textContent = own.label;
      button.append(caption);
      if (own.error) {
        const why = document.createElement("small");
        why.textContent = own.times ? `ends at ${text(own.times.at(-1))} s` : own.error;
        why.title = own.error;
        button.append(why);
      }
      button.addEventListener("click", () => pick(own));
    }
  };

  // ---- Everything for the first time.

  if (!player) {
    find("controls").hidden = true;
    find("live").hidden = true;
    find("plots").hidden = true;
    thumbnails();
    gather();
    document.body.dataset.ready = "";
    return;
  }
  sample();
  trace();
  slider.min = player.times[0];
  slider.max = player.times.at(-1);
  gather();
  show();
  // What is further down comes after the first picture.
  setTimeout(() => {
    choose("angles", 5);
    choose("lengths", 4);
    for (const index of traced) for (const curve of curves) if (curve.is === `p${index}`) shown.add(curve);
    choose("contacts", 3);
    choose("determinants", 7);
    chips();
    thumbnails();
    pick(player);
    document.body.dataset.ready = "";
  });
  // Widths change with the window.
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    plot();
    gather();
    show();
  });
})();
