// What is shown.

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

