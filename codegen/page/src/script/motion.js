// Motions: numbers at kept instants, and polynomials between them that have their rates and accelerations too.

const STILL = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];

const decoded = (stored, wide) => {
  if (typeof stored === "number") return stored;
  const bytes = Uint8Array.fromBase64?.(stored) ?? Uint8Array.from(atob(stored), (letter) => letter.charCodeAt(0));
  return wide ? new Float64Array(bytes.buffer) : new Float32Array(bytes.buffer);
};

/// The index of the last time before t, the part of the interval that has passed, and its length.
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

class Motion {
  constructor(data) {
    this.data = data;
    this.columns = new Array(data.columns.length);
  }

  at(column, index) {
    const values = (this.columns[column] ??= decoded(this.data.columns[column], this.data.wide));
    return typeof values === "number" ? values : values[index];
  }

  /// Value, rate and acceleration of a coordinate.
  coordinate(player, index, [k, s, h]) {
    const [q, rate, acceleration] = player.coordinates[index];
    const here = [this.at(q, k), this.at(rate, k), this.at(acceleration, k)];
    if (s === 0) return here;
    const [c0, c1, c2] = [here[0], h * here[1], 0.5 * h * h * here[2]];
    const d = this.at(q, k + 1) - c0 - c1 - c2;
    const e = h * this.at(rate, k + 1) - c1 - 2 * c2;
    const f = h * h * this.at(acceleration, k + 1) - 2 * c2;
    const [c3, c4, c5] = [10 * d - 4 * e + 0.5 * f, -15 * d + 7 * e - f, 6 * d - 3 * e + 0.5 * f];
    return [
      c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
      (c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h,
      (2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / (h * h),
    ];
  }

  state(player, t) {
    const place = interval(player.times, t);
    return this.data.coordinates.map((_, index) => this.coordinate(player, index, place));
  }

  between(column, [k, s]) {
    const here = this.at(column, k);
    return s === 0 ? here : here + s * (this.at(column, k + 1) - here);
  }

  /// The arrows of loads: their components in parts of the longest.
  arrows(player, t) {
    const place = interval(player.times, t);
    return (player.arrows ?? []).map((own) => own.map((column) => this.between(column, place)));
  }

  /// x, y and angle of a body.
  pose(q, body) {
    const pose = this.data.bodies[body].pose;
    return pose ? pose.map((index) => (index === null ? STILL[0] : q[index])) : STILL;
  }

  /// Position, velocity and acceleration of a point whose body has this pose.
  carried([x, y, angle], [along, aside]) {
    const [c, s] = [Math.cos(angle[0]), Math.sin(angle[0])];
    const [rx, ry] = [c * along - s * aside, s * along + c * aside];
    const [w, a] = [angle[1], angle[2]];
    return [
      [x[0] + rx, y[0] + ry],
      [x[1] - w * ry, y[1] + w * rx],
      [x[2] - a * ry - w * w * rx, y[2] + a * rx - w * w * ry],
    ];
  }

  point(player, index, place) {
    const { body, local } = this.data.points[index];
    const pose = this.data.bodies[body].pose;
    const of = (coordinate) => (coordinate === null ? STILL[0] : this.coordinate(player, coordinate, place));
    return this.carried(pose ? pose.map(of) : STILL, local);
  }
}

/// Instants at which curves and paths are drawn: those that are kept, or more where these are few.
class Samples {
  constructor(motion, player) {
    this.motion = motion;
    this.player = player;
    this.times = [];
    this.places = [];
    this.known = new Map();
    const { times } = player;
    const parts = Math.max(1, Math.ceil(200 / times.length));
    times.forEach((time, index) => {
      this.take(time, [index, 0, 0]);
      const length = times[index + 1] - time;
      for (let part = 1; index + 1 < times.length && part < parts; part += 1) {
        this.take(time + (length * part) / parts, [index, part / parts, length]);
      }
    });
  }

  take(time, place) {
    this.times.push(time);
    this.places.push(place);
  }

  /// Motion of a point at all instants.
  point(index) {
    if (!this.known.has(index)) this.known.set(index, this.places.map((place) => this.motion.point(this.player, index, place)));
    return this.known.get(index);
  }
}
