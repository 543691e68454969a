// Parameters, inputs and the range of time, which a provider answers for: sliders and fields.

/// Number of steps of a slider.
const STEPS = 400;

/// Value with as many digits as a step of its slider is worth.
const rounded = (value, step) => Number(value.toFixed(Math.max(0, Math.min(12, 1 - Math.floor(Math.log10(step))))));

const plain = (value) => String(Number(value.toPrecision(12)));

class Control {
  /// `changed` is called with what kind of change it is: "moving" or "resting".
  constructor(own, changed) {
    this.changed = changed;
    this.value = null;
    this.slider = made("input", { type: "range", step: "any", "aria-label": own.name });
    this.field = made("input", { type: "text", inputmode: "decimal", autocomplete: "off", "aria-label": `${own.name}, number` });
    this.unit = made("span", { class: "unit" });
    this.reset = made("button", { type: "button", class: "quiet", title: "value of the description", "aria-label": `reset ${own.name}` }, "↺");
    this.problem = made("small", { class: "error", role: "alert" });
    this.name = made("b", {}, own.name);
    this.row = made("div", { class: "control" }, this.name, this.slider, this.field, this.unit, this.reset, this.problem);
    this.slider.addEventListener("input", () => {
      const { low, high } = this;
      this.put(rounded(Number(this.slider.value), (high - low) / STEPS));
      changed("moving");
    });
    this.slider.addEventListener("change", () => changed("resting"));
    this.field.addEventListener("change", () => this.type());
    this.field.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.show();
    });
    this.reset.addEventListener("click", () => {
      this.value = null;
      this.show();
      changed("resting");
    });
    this.take(own);
  }

  /// Takes what an answer says about it; a value that was set here stays.
  take(own) {
    this.own = own;
    // A value that has changed in the description counts more than one that was set before.
    if (this.given !== undefined && this.given !== own.value) this.value = null;
    this.given = own.value;
    this.low = own.low ?? Math.min(0, 2 * (own.value ?? 0.5));
    this.high = own.high ?? Math.max(0, 2 * (own.value ?? 0.5));
    if (this.high === this.low) this.high = this.low + 1;
    const isGuess = own.guessed || own.low == null || own.high == null;
    this.isGuess = isGuess;
    this.row.classList.toggle("guessed", isGuess);
    this.slider.title = `${text(this.low)} to ${text(this.high)} ${own.unit}${isGuess ? ": the description declares no range; type a number to go beyond" : ""}`;
    this.unit.textContent = own.unit;
    this.name.title = own.docs || own.kind;
    if (document.activeElement !== this.field) this.show();
  }

  get current() {
    return this.value ?? this.given;
  }

  show() {
    const { current } = this;
    const center = current ?? (this.low + this.high) / 2;
    // A value beyond a guessed end moves this end.
    this.slider.min = Math.min(this.low, center);
    this.slider.max = Math.max(this.high, center);
    this.slider.value = center;
    this.slider.setAttribute("aria-valuetext", current === null ? this.own.law || "" : `${text(current)} ${this.own.unit}`);
    this.field.value = current === null ? "" : plain(current);
    this.field.placeholder = this.own.law ?? "";
    this.row.classList.toggle("law", current === null);
    this.reset.disabled = this.value === null;
    this.complain("");
  }

  put(value) {
    this.value = value;
    this.show();
  }

  complain(words) {
    this.problem.textContent = words;
    if (words) this.field.setAttribute("aria-invalid", "true");
    else this.field.removeAttribute("aria-invalid");
  }

  type() {
    const typed = this.field.value.trim().replace(",", ".").replace("−", "-");
    const { name, unit } = this.own;
    if (typed === "" && this.own.law) {
      this.value = null;
      this.show();
      return this.changed("resting");
    }
    const value = Number(typed);
    if (typed === "" || !Number.isFinite(value)) return this.complain(`${name} is a number in ${unit || "no unit"}`);
    if (!this.isGuess && value < this.low) return this.complain(`${name} is at least ${text(this.low)} ${unit}`);
    if (!this.isGuess && value > this.high) return this.complain(`${name} is at most ${text(this.high)} ${unit}`);
    this.put(value);
    return this.changed("resting");
  }
}

class Controls {
  constructor(panel, changed) {
    Object.assign(this, { panel, changed, controls: new Map(), shape: null, edited: {}, awaited: {} });
  }

  /// Takes the controls of an answer; one about what moves has none.
  take(data) {
    this.range = data.range ?? null;
    const all = data.controls ?? [];
    this.panel.hidden = all.length === 0 && !this.range;
    const shape = JSON.stringify(all.map((own) => [own.kind, own.name]));
    if (shape !== this.shape) this.build(all, shape);
    else for (const own of all) this.controls.get(own.name).take(own);
    this.showRange();
  }

  build(all, shape) {
    this.shape = shape;
    const before = this.controls;
    this.controls = new Map(
      all.map((own) => {
        const kept = before.get(own.name);
        kept?.take(own);
        return [own.name, kept ?? new Control(own, this.changed)];
      }),
    );
    const { awaited } = this;
    this.awaited = {};
    this.set(awaited);
    this.panel.replaceChildren(...[...this.controls.values()].map((it) => it.row));
    if (this.range) this.panel.append(this.rangeRow());
  }

  rangeRow() {
    this.fields = {};
    const field = (name, words) => {
      const input = made("input", { type: "text", inputmode: "decimal", autocomplete: "off" });
      input.addEventListener("change", () => this.typeRange(name, input));
      this.fields[name] = input;
      return made("label", {}, `${words} `, input);
    };
    this.problem = made("small", { class: "error", role: "alert" });
    const all = [field("from", "from"), field("to", "to"), field("step", "step")];
    return made("div", { class: "range" }, made("b", {}, made("i", {}, "t")), ...all, made("span", { class: "unit" }, "s"), this.problem);
  }

  showRange() {
    const range = this.question().range;
    if (!this.fields || !range) return;
    for (const [name, input] of Object.entries(this.fields)) {
      if (document.activeElement !== input) input.value = plain(range[name]);
    }
  }

  typeRange(name, input) {
    const range = { ...this.question().range, [name]: Number(input.value.replace(",", ".").replace("−", "-")) };
    const complaint = !Number.isFinite(range[name])
      ? `${name} is a number in s`
      : range.to <= range.from
        ? "the end is after the start"
        : range.step <= 0
          ? "the step is more than 0"
          : "";
    this.problem.textContent = complaint;
    if (complaint) return;
    this.edited[name] = range[name];
    this.changed("resting");
  }

  /// Sets values by name, as a question has them.
  set(values) {
    for (const [name, value] of Object.entries(values)) {
      const number = Number(value);
      const control = this.controls.get(name);
      if (!Number.isFinite(number)) continue;
      if (control) control.put(number);
      else this.awaited[name] = plain(number);
    }
  }

  /// Ends of the inputs and free coordinates that have one value, by name.
  ranges() {
    const inputs = [...this.controls].filter(([, it]) => it.own.kind !== "parameter" && it.current !== null);
    return Object.fromEntries(inputs.map(([name, it]) => [name, [it.low, it.high]]));
  }

  /// True if forces move coordinates of the mechanism.
  get isFree() {
    return [...this.controls.values()].some((it) => it.own.kind === "free coordinate");
  }

  /// Returns to the values and the times of the description.
  forget() {
    this.edited = {};
    this.awaited = {};
    for (const control of this.controls.values()) control.put(null);
  }

  /// Values that differ from the description, by name, and the range of time.
  question() {
    const changed = [...this.controls].filter(([, it]) => it.value !== null);
    return {
      values: { ...this.awaited, ...Object.fromEntries(changed.map(([name, it]) => [name, plain(it.value)])) },
      range: this.range && { ...this.range, ...this.edited },
    };
  }
}
