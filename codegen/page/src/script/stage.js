// The drawing: groups that say which frame they are in are put there. Here y points downwards.

/// Paths of an element, each as it was written.
const pathsOf = (element) => [...element.querySelectorAll("path")].map((path) => [path, (path.dataset.drawn ??= path.getAttribute("d"))]);

class Stage {
  constructor(mechanism, motion) {
    this.mechanism = mechanism;
    this.motion = motion;
    this.scale = Number(mechanism.dataset.scale);
    this.names = this.all("data-follows").map((element) => ({ element, at: numbers(element.dataset.follows), first: numbers(element.dataset.first) }));
    this.collect();
  }

  all(name) {
    return [...this.mechanism.querySelectorAll(`[${name}]`)];
  }

  /// Finds what moves, also after elements have been replaced.
  collect() {
    this.bodies = this.all("data-body").map((element) => [element, Number(element.dataset.body)]);
    this.riders = this.all("data-turned").map((element) => [element, numbers(element.dataset.at), Number(element.dataset.turned)]);
    this.forces = this.all("data-force").map((element) => [element, numbers(element.dataset.at), Number(element.dataset.force)]);
    this.torques = this.all("data-torque").map((element) => [element, numbers(element.dataset.at), ...numbers(element.dataset.torque)]);
    this.spirals = this.all("data-wound").map((element) => ({
      winding: [Number(element.dataset.turned), ...numbers(element.dataset.wound)],
      paths: pathsOf(element),
    }));
    this.links = this.all("data-from").map((element) => ({
      element,
      from: numbers(element.dataset.from),
      to: numbers(element.dataset.to),
      length: Number(element.dataset.length ?? 0),
      paths: pathsOf(element),
    }));
    this.stills = this.all("data-still");
  }

  /// Where a body is: x and y in pixels, and its angle, clockwise as y points.
  place(q, body) {
    const [x, y, angle] = this.motion.pose(q, body);
    return [x[0] * this.scale, -y[0] * this.scale, -angle[0]];
  }

  global(q, [body, x, y]) {
    const [ox, oy, angle] = this.place(q, body);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return [ox + c * x - s * y, oy + s * x + c * y];
  }

  show(q, arrows = []) {
    const put = (element, x, y, angle, rest = "") => {
      element.setAttribute("transform", `translate(${x.toFixed(3)} ${y.toFixed(3)})rotate(${((angle * 180) / Math.PI).toFixed(4)})${rest}`);
    };
    for (const [element, body] of this.bodies) put(element, ...this.place(q, body));
    for (const [element, where, body] of this.riders) {
      put(element, ...this.global(q, where), this.place(q, body)[2]);
    }
    for (const spiral of this.spirals) {
      const [first, second, start, inner, outer] = spiral.winding;
      const turned = this.place(q, second)[2] - this.place(q, first)[2] - (start * Math.PI) / 180;
      // The inner end turns with the first body, the outer end with the second one.
      const wound = (_, x, y) => {
        const angle = (turned * (Math.hypot(x, y) - inner)) / (outer - inner);
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        return `${(c * x - s * y).toFixed(2)} ${(s * x + c * y).toFixed(2)}`;
      };
      for (const [path, d] of spiral.paths) path.setAttribute("d", d.replace(/([-\d.]+) ([-\d.]+)/g, wound));
    }
    for (const link of this.links) {
      const [from, to] = [this.global(q, link.from), this.global(q, link.to)];
      const [x, y] = [to[0] - from[0], to[1] - from[1]];
      put(link.element, ...from, Math.atan2(y, x));
      if (!link.length) continue;
      // Lines keep their width where x grows with the distance.
      const factor = Math.hypot(x, y) / link.length;
      for (const [path, d] of link.paths) path.setAttribute("d", d.replace(/([-\d.]+) ([-\d.]+)/g, (_, along, aside) => `${(factor * along).toFixed(2)} ${aside}`));
    }
    for (const [element, where, load] of this.forces) {
      const [x, y] = arrows[load] ?? [0, 0];
      put(element, ...this.global(q, where), Math.atan2(-y, x), `scale(${Math.hypot(x, y).toFixed(4)})`);
    }
    for (const [element, where, load, turned] of this.torques) {
      const [size] = arrows[load] ?? [0];
      const angle = this.place(q, where[0])[2] + (turned * Math.PI) / 180;
      put(element, ...this.global(q, where), angle, `scale(${Math.abs(size).toFixed(4)} ${size.toFixed(4)})`);
    }
    for (const name of this.names) {
      const [x, y] = this.global(q, name.at);
      name.element.setAttribute("transform", `translate(${(x - name.first[0]).toFixed(2)} ${(y - name.first[1]).toFixed(2)})`);
    }
  }
}
