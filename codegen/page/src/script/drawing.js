// The picture of one mechanism, dressed for the assembly that is selected.

/// Most that a drawing is enlarged: its letters are those of its own size.
const LARGEST = 1.9;

const byId = (element, id) => element.querySelector(`[id="${CSS.escape(id)}"]`);

class Drawing {
  /// Takes the picture in an element over.
  constructor(holder, motion) {
    this.svg = holder.querySelector("svg");
    this.mechanism = byId(this.svg, "mechanism");
    this.legend = byId(this.svg, "legend");
    this.data = motion.data;
    this.motion = motion;
    this.box = this.svg.getAttribute("viewBox");
    this.boxes = new Map();
    this.svg.removeAttribute("width");
    this.svg.removeAttribute("height");
    const [, , width, height] = numbers(this.box);
    this.svg.style.maxWidth = `${Math.round(width * LARGEST)}px`;
    this.svg.style.aspectRatio = `${width} / ${height}`;
    this.traces = drawn("g", { class: "traces" });
    this.mechanism.insertBefore(this.traces, byId(this.mechanism, "names"));
    this.stage = new Stage(this.mechanism, motion);
    // Elements that another assembly has in place of some of the drawing's, which are kept.
    const replaced = new Set(this.data.assemblies.flatMap((own) => Object.keys(own.elements ?? {})));
    this.originals = new Map([...replaced].map((id) => [id, byId(this.svg, id)?.outerHTML]));
    [this.dressed] = this.data.assemblies;
    this.tag();
  }

  /// Gives a picture the elements of an assembly.
  dress(picture, player) {
    for (const [id, original] of this.originals) {
      const element = byId(picture, id);
      const replacement = player.elements?.[id] ?? original;
      if (element && replacement) element.outerHTML = replacement;
    }
  }

  /// Says which elements are bodies, joints and points, for pointing.
  tag() {
    this.data.bodies.forEach((body, index) => {
      const element = byId(this.mechanism, `body-${body.name}`);
      if (element && index > 0) element.dataset.is = `b${index}`;
    });
    this.data.joints.forEach((joint, index) => {
      for (const suffix of ["", "-below", "-upon"]) {
        const element = byId(this.mechanism, `joint-${joint.slug}${suffix}`);
        // A layer in which nothing lies is there for other assemblies.
        if (!element || (suffix && !element.querySelector("path, circle"))) continue;
        element.dataset.is = `j${index}`;
        element.dataset.of = joint.bodies.map((body) => `b${body}`).join(" ");
      }
    });
    for (const name of this.stage.names) {
      const point = this.data.points.findIndex((it) => it.name === name.element.dataset.point);
      name.element.dataset.is = point < 0 ? `b${name.at[0]}` : `p${point}`;
    }
  }

  /// Shows an assembly with the paths of points.
  pick(player, samples, traced) {
    if (this.originals.size && player !== this.dressed) {
      this.dress(this.mechanism, player);
      this.stage.collect();
      this.tag();
    }
    this.dressed = player;
    this.trace(samples, traced);
    this.frame(player);
  }

  trace(samples, traced) {
    this.traces.replaceChildren();
    const { times } = samples.player;
    const [first, last] = [times[0], times.at(-1)];
    const { scale } = this.stage;
    for (const index of traced) {
      const own = { "data-is": `p${index}`, "data-of": `b${this.data.points[index].body}` };
      const group = drawn("g", own, this.traces);
      const path = samples.point(index);
      const d = pathThrough(path.map(([[x]]) => hundredths(x * scale)), path.map(([[, y]]) => -y * scale));
      drawn("path", { class: "path", d }, group);
      const every = last > first ? round((last - first) / 24) : Infinity;
      for (let time = first; last > first && time <= last + 1e-9; time += every) {
        const [[x, y]] = this.motion.point(samples.player, index, interval(times, time));
        drawn("circle", { class: "tick", cx: hundredths(x * scale), cy: hundredths(-y * scale), r: 2.2 }, group);
      }
      drawn("circle", { class: "now", r: 5 }, group).dataset.now = index;
    }
  }

  /// Box around an assembly at some of its times.
  around(stage, player, times) {
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const time of times) {
      stage.show(this.motion.state(player, time), this.motion.arrows(player, time));
      const area = stage.mechanism.getBBox();
      [x0, y0, x1, y1] = [Math.min(x0, area.x), Math.min(y0, area.y), Math.max(x1, area.x + area.width), Math.max(y1, area.y + area.height)];
    }
    return [x0, y0, x1 - x0, y1 - y0];
  }

  frame(player) {
    if (player === this.data.assemblies[0]) {
      this.legend?.removeAttribute("transform");
      this.svg.setAttribute("viewBox", this.box);
      return;
    }
    if (!this.boxes.has(player)) {
      const every = Math.max(1, Math.ceil(player.times.length / 24));
      const times = player.times.filter((_, index) => index % every === 0);
      const [x, y, width, height] = this.around(this.stage, player, times);
      const [dx, dy] = numbers(this.mechanism.getAttribute("transform").replace(/^translate\(|\)$/g, ""));
      this.boxes.set(player, `${x + dx - 16} ${y + dy - 16} ${width + 32} ${height + 48}`);
    }
    this.svg.setAttribute("viewBox", this.boxes.get(player));
    // The scale bar stays in the lower left corner.
    const [left, top, , height] = numbers(this.boxes.get(player));
    this.legend?.setAttribute("transform", `translate(${left} ${top + height - numbers(this.box)[3]})`);
  }

  show(player, t) {
    const q = this.motion.state(player, t);
    this.stage.show(q, this.motion.arrows(player, t));
    const opacity = t === player.times[0] ? "" : 0.15;
    for (const element of this.stage.stills) element.style.opacity = opacity;
    for (const dot of this.traces.querySelectorAll("[data-now]")) {
      const { body, local } = this.data.points[dot.dataset.now];
      const [[x, y]] = this.motion.carried(this.motion.pose(q, body), local);
      dot.setAttribute("cx", (x * this.stage.scale).toFixed(3));
      dot.setAttribute("cy", (-y * this.stage.scale).toFixed(3));
    }
    return q;
  }

  /// Small picture of an assembly at its start, without names, in an element of the page.
  thumbnail(holder, player) {
    const picture = drawn("svg", { class: "linkwright", "aria-hidden": "true" }, holder);
    const copy = this.mechanism.cloneNode(true);
    copy.removeAttribute("transform");
    this.dress(copy, player);
    for (const part of copy.querySelectorAll("[id=names], .traces, [data-still], title")) part.remove();
    for (const part of [copy, ...copy.querySelectorAll("*")]) {
      part.removeAttribute("id");
      part.classList.remove("lit");
      delete part.dataset.is;
      delete part.dataset.of;
    }
    picture.append(copy);
    const [x, y, width, height] = this.around(new Stage(copy, this.motion), player, player.times.slice(0, 1));
    const side = Math.max(width, height) + 16;
    picture.setAttribute("viewBox", `${x + width / 2 - side / 2} ${y + height / 2 - side / 2} ${side} ${side}`);
  }
}
