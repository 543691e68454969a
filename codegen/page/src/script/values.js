// The table of current values: all coordinates as numbers.

class Values {
  constructor(details, filled) {
    this.details = details;
    this.table = details.querySelector("table");
    this.filled = filled;
  }

  /// Takes new data; rows are made when the table is open.
  take(data) {
    const names = data.coordinates.map((own) => own.mathml).join();
    this.data = data;
    if (names !== this.names) this.table.replaceChildren();
    this.names = names;
  }

  fill() {
    this.table.innerHTML = "<thead><tr><td></td><th scope=\"col\">position</th><th scope=\"col\">rate</th><th scope=\"col\">acceleration</th><th scope=\"col\">unit</th></tr></thead>";
    const body = this.table.createTBody();
    this.data.coordinates.forEach((own, index) => {
      const row = body.insertRow();
      row.dataset.is = `q${index}`;
      const head = made("th", { scope: "row" });
      head.innerHTML = `<math>${own.mathml}</math>`;
      row.append(head);
      for (let level = 0; level < 3; level += 1) row.insertCell();
      row.insertCell().textContent = this.data.units[own.kind][0][0];
    });
    this.filled();
  }

  show(q) {
    if (!this.details.open) return;
    if (this.table.rows.length === 0) this.fill();
    const { rows } = this.table.tBodies[0];
    this.data.coordinates.forEach((own, index) => {
      for (let level = 0; level < 3; level += 1) {
        rows[index].cells[level + 1].textContent = text(this.data.units[own.kind][level][1] * q[index][level]);
      }
    });
  }
}
