// Motions: numbers at kept instants, and polynomials between them that have their rates and accelerations too.

const columns = new Map();
const column = (place) => {
  if (!columns.has(place)) {
    const stored = data.columns[place];
    if (typeof stored === "number") columns.set(place, stored);
    else {
      const letters = atob(stored);
      const bytes = new Uint8Array(letters.length);
      for (let index = 0; index < letters.length; index += 1) bytes[index] = letters.charCodeAt(index);
      columns.set(place, new Float32Array(bytes.buffer));
    }
  }
  return columns.get(place);
};
const at = (place, index) => {
  const values = column(place);
  return typeof values === "number" ? values : values[index];
};

/// The place of t among the times: the index before it, and which part of the interval has passed.
const interval = (times, t) => {
  let [low, high] = [0, times.length - 1];
  if (high === 0 || t <= times[0]) return [0, 0, 0];
  if (t >= times[high]) return [high, 0, 0];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  const length = times[high] - times[low];
  return [low, (t - times[low]) / length, length];
};

const coordinate = (player, index, [k, s, h]) => {
  const [q, rate, acceleration] = player.coordinates[index];
  const here = [at(q, k), at(rate, k), at(acceleration, k)];
  if (s === 0) return here;
  const [c0, c1, c2] = [here[0], h * here[1], 0.5 * h * h * here[2]];
  const d = at(q, k + 1) - c0 - c1 - c2;
  const e = h * at(rate, k + 1) - c1 - 2 * c2;
  const f = h * h * at(acceleration, k + 1) - 2 * c2;
  const [c3, c4, c5] = [10 * d - 4 * e + 0.5 * f, -15 * d + 7 * e - f, 6 * d - 3 * e + 0.5 * f];
  return [
    c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
    (c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h,
    (2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / (h * h),
  ];
};

const state = (player, t) => {
  const place = interval(player.times, t);
  return data.coordinates.map((_, index) => coordinate(player, index, place));
};

/// The arrows of loads: their components in parts of the longest.
const arrowsOf = (player, t) => {
  const [k, s] = interval(player.times, t);
  const value = (place) => (s === 0 ? at(place, k) : (1 - s) * at(place, k) + s * at(place, k + 1));
  return (player.arrows ?? []).map((own) => own.map(value));
};

const still = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
const poseOf = (q, body) => {
  const pose = data.bodies[body].pose;
  return pose ? pose.map((index) => (index === null ? [0, 0, 0] : q[index])) : still;
};

/// Position, velocity and acceleration of a point.
const motionOf = (q, point) => {
  const [x, y, angle] = poseOf(q, point.body);
  const [c, s] = [Math.cos(angle[0]), Math.sin(angle[0])];
  const [rx, ry] = [c * point.local[0] - s * point.local[1], s * point.local[0] + c * point.local[1]];
  const [w, a] = [angle[1], angle[2]];
  return [
    [x[0] + rx, y[0] + ry],
    [x[1] - w * ry, y[1] + w * rx],
    [x[2] - a * ry - w * w * rx, y[2] + a * rx - w * w * ry],
  ];
};

