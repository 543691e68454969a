// Pointing at something lights what it is about, and what is about it.

const SAYING = ".equation, .pose, section.block, tr";
const POINTED = "[data-is], [data-of]:not(section), .equation, .pose";
const meet = (a, b) => a.some((it) => b.includes(it));

class Pointing {
  constructor(root, signal) {
    this.root = root;
    this.items = null;
    this.pointed = null;
    this.lit = [];
    this.rests = "";
    const on = (event, action) => root.addEventListener(event, action, { signal });
    // What is scrolled or moved below a pointer that rests is not pointed at.
    on("pointerover", (event) => {
      const place = `${event.clientX} ${event.clientY}`;
      if (place !== this.rests) this.light(event.target);
      this.rests = place;
    });
    on("pointerleave", () => this.light(null));
    on("focusin", (event) => this.light(event.target));
    on("focusout", () => this.light(null));
  }

  /// Elements have changed: what is pointed at is lit again in the next frame.
  forget() {
    this.items = null;
    if (!this.pointed || this.request) return;
    this.request = requestAnimationFrame(() => {
      this.request = 0;
      const { pointed } = this;
      this.pointed = null;
      this.unlight();
      if (pointed?.isConnected) this.light(pointed);
    });
  }

  unlight() {
    for (const own of this.lit) own.classList.remove("lit");
    this.lit = [];
  }

  bodyOf(index) {
    const body = this.data.coordinates[index]?.body;
    return body == null ? [] : [`b${body}`];
  }

  /// What an element is and what it is about: names in its attributes, the unknowns of a formula and their bodies.
  meaning(element) {
    const formulas = element.matches(SAYING) ? [...element.querySelectorAll("[data-q]")] : [];
    const joints = element.matches("section.block") ? words(element.dataset.joints) : [];
    const symbols = [...new Set(formulas.map((it) => it.dataset.q))];
    return {
      element,
      is: words(element.dataset.is),
      of: [...words(element.dataset.of), ...joints, ...symbols.flatMap((it) => [`q${it}`, ...this.bodyOf(it)])],
    };
  }

  light(target) {
    const element = target?.closest?.(POINTED) ?? null;
    const symbol = element ? null : target?.closest?.("[data-q]") ?? null;
    const source = element ?? symbol;
    if (source === this.pointed) return;
    this.pointed = source;
    this.unlight();
    if (!source || !this.data) return;
    this.items ??= [...this.root.querySelectorAll("[data-is], [data-of], .equation, .pose, section.block")].map((it) => this.meaning(it));
    const own = symbol ? { is: [`q${symbol.dataset.q}`], of: this.bodyOf(symbol.dataset.q) } : this.meaning(element);
    const belongs = (item) => item.element === source || meet(item.is, own.is) || meet(item.is, own.of) || meet(item.of, own.is);
    this.lit = this.items.filter(belongs).map((it) => it.element);
    const symbols = own.is.filter((it) => it[0] === "q").map((it) => `[data-q="${it.slice(1)}"]`);
    if (symbols.length) this.lit.push(...this.root.querySelectorAll(symbols.join()));
    for (const it of this.lit) it.classList.add("lit");
  }
}
