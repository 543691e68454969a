// The drawing: groups that say which frame they are in are put there. Here y points downwards.

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

