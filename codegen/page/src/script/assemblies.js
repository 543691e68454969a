// The choice of an assembly: small pictures, and a list beside the drawing.

class Assemblies {
  constructor(part, choose, canAsk) {
    Object.assign(this, { part, choose, canAsk });
    this.list = part("assembly");
    this.list.addEventListener("change", () => choose(this.list.value));
    this.seen = new IntersectionObserver(
      (entries) => {
        this.isVisible = entries.at(-1).isIntersecting;
        if (this.isVisible) this.draw();
      },
      { rootMargin: `${NEAR}px` },
    );
  }

  /// True if an assembly can be shown, or asked for.
  isOpen(own) {
    return Boolean(own.times) || this.canAsk;
  }

  /// Takes the assemblies of a drawing; pictures are made when they come into view.
  take(drawing, player) {
    this.drawing = drawing;
    const all = drawing.data.assemblies;
    const holder = this.part("thumbnails");
    const shape = JSON.stringify(all.map((own) => [own.label, own.error, own.times?.at(-1)]));
    this.isStale = true;
    if (shape !== this.shape || holder !== this.holder) this.build(all, holder);
    this.shape = shape;
    if (this.isVisible) this.draw();
    this.mark(player);
  }

  build(all, holder) {
    const choices = all.map((own) => made("option", { value: own.label, disabled: this.isOpen(own) ? null : "" }, own.label));
    this.list.replaceChildren(...choices);
    this.list.closest("label").hidden = all.length < 2;
    if (holder !== this.holder) {
      this.seen.disconnect();
      this.isVisible = false;
      this.holder = holder;
      if (holder) this.seen.observe(holder);
    }
    holder?.replaceChildren(...all.map((own) => this.button(own)));
  }

  button(own) {
    const button = made("button", { type: "button", "aria-pressed": "false", disabled: this.isOpen(own) ? null : "" });
    button.append(made("span", {}, own.label));
    if (own.error) {
      const why = own.times ? `motion ends at t = ${text(own.times.at(-1))} s` : own.error;
      button.append(made("small", { title: own.error }, why));
    }
    button.addEventListener("click", () => this.choose(own.label));
    return button;
  }

  draw() {
    if (!this.isStale || !this.holder) return;
    this.isStale = false;
    this.drawing.data.assemblies.forEach((own, index) => {
      if (!own.times) return;
      const button = this.holder.children[index];
      button.querySelector("svg")?.remove();
      this.drawing.thumbnail(button, own);
      button.prepend(button.lastChild);
    });
  }

  /// Marks the assembly that is shown, and says why its motion ends.
  mark(player) {
    const all = this.drawing.data.assemblies;
    if (player) this.list.value = player.label;
    [...(this.holder?.children ?? [])].forEach((button, index) => button.setAttribute("aria-pressed", String(all[index] === player)));
    const error = this.part("assembly-error");
    if (!error) return;
    error.hidden = !player?.error;
    error.textContent = player?.error ? `${player.label}: ${player.error}` : "";
  }

  end() {
    this.seen.disconnect();
  }
}
