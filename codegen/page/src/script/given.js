// Parameters and inputs as text, where no others can be asked for.

class Given {
  constructor(panel) {
    this.panel = panel;
  }

  take(data) {
    const all = data.controls ?? [];
    const rows = all.map((own) => {
      const value = own.value === null ? own.law ?? "" : `${text(own.value)} ${own.unit}`;
      return made("div", {}, made("dt", { title: own.docs || own.kind }, own.name), made("dd", {}, value));
    });
    this.panel.hidden = rows.length === 0;
    this.panel.replaceChildren(made("dl", { class: "given" }, ...rows));
  }

  question() {
    return { values: {}, range: null };
  }
}
