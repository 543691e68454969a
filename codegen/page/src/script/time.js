// Time.

const slider = find("time");
const play = find("play");
let playing = false;
let last = 0;

const show = () => {
  if (!player) return;
  const place = interval(player.times, t);
  const now = { t, q: data.coordinates.map((_, index) => coordinate(player, index, place)) };
  now.points = data.points.map((point) => motionOf(now.q, point));
  stage.show(now.q, arrowsOf(player, t));
  const isDrawn = t === player.times[0];
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
      row.insertCell().textContent = data.units[own.kind][0][0];
    });
    gather();
  }
  data.coordinates.forEach((own, index) => {
    for (let level = 0; level < 3; level += 1) {
      const value = data.units[own.kind][level][1] * now.q[index][level];
      table.tBodies[0].rows[index].cells[level + 1].textContent = text(value);
    }
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

