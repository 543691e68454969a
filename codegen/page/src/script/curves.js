// Curves: everything that can be plotted over time.

const LEVELS = ["", "rate", "acceleration"];
const TITLES = {
  angles: "Angles",
  lengths: "Coordinates x and y",
  points: "Points",
  contacts: "Contacts",
  forces: "Forces",
  torques: "Torques",
  powers: "Powers",
  energies: "Energies",
  determinants: "Normalized determinants",
};

/// Kinds of curves with their titles; measures are of one kind for each unit.
const titled = (curves) => {
  const measured = curves.map((it) => it.kind).filter((kind) => kind.startsWith("measured"));
  return [...Object.entries(TITLES), ...[...new Set(measured)].map((kind) => [kind, "Measures"])];
};

/// Curves of the data; each is named, so that it is found again in the next data.
const curvesOf = (motion) => {
  const { data } = motion;
  const curves = [];
  data.coordinates.forEach((own, index) => {
    const pose = own.body === null ? null : data.bodies[own.body].pose;
    const axis = pose ? pose.indexOf(index) : -1;
    curves.push({
      name: own.name,
      is: `q${index}`,
      of: own.body === null ? "" : `b${own.body}`,
      letter: axis < 0 ? own.name : ["x", "y", "φ"][axis],
      index: axis < 0 ? "" : data.bodies[own.body].name,
      mathml: own.mathml,
      kind: own.kind,
      value: (player, place, level) => motion.coordinate(player, index, place)[level],
      values: (samples, level) => samples.places.map((place) => (place[1] === 0 ? motion.at(samples.player.coordinates[index][level], place[0]) : motion.coordinate(samples.player, index, place)[level])),
    });
  });
  data.points.forEach((own, index) => {
    ["x", "y"].forEach((letter, axis) => {
      curves.push({
        name: `${letter} ${own.name}`,
        is: `p${index}`,
        of: `b${own.body}`,
        letter,
        index: own.name,
        kind: "points",
        value: (player, place, level) => motion.point(player, index, place)[level][axis],
        values: (samples, level) => samples.point(index).map((it) => it[level][axis]),
      });
    });
  });
  const single = (name, prefix, index, kind, columns) => {
    const value = (player, place) => motion.between(player[columns][index], place);
    curves.push({
      name,
      is: `${prefix}${index}`,
      of: "",
      letter: name,
      index: "",
      kind,
      value,
      values: (samples) => samples.places.map((place) => value(samples.player, place)),
    });
  };
  data.measures.forEach((name, index) => single(name, "m", index, "determinants", "measures"));
  const forces = (data.forces ?? []).filter(([, kind]) => kind in TITLES).length;
  (data.forces ?? []).forEach(([name, kind], index) => {
    single(name, "f", index, kind, "forces");
    if (index >= forces) curves.at(-1).is = `v${index - forces}`;
  });
  // A curve keeps its color, whichever others are shown.
  const counts = {};
  for (const curve of curves) {
    curve.order = counts[curve.kind] ?? 0;
    counts[curve.kind] = curve.order + 1;
  }
  return curves;
};

const unitsOf = (data) => ({ ...data.units, determinants: [["0 is singular", 1]] });

const rangeOf = (values) => {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
};
const moves = (values) => {
  const [low, high] = rangeOf(values);
  return high - low > 1e-6 * Math.max(1e-3, Math.abs(low), Math.abs(high));
};

/// Names of the curves that are shown first: those that the description requests, and measures, or else moving angles; with them forces and
/// determinants. A mechanism without moving angles shows its moving coordinates.
const firstChoice = (curves, samples, requested) => {
  const moving = (kind, most) => curves.filter((it) => it.kind === kind && moves(it.values(samples, 0))).slice(0, most);
  const chosen = curves.filter((it) => requested.includes(it.is));
  const measured = curves.filter((it) => it.kind.startsWith("measured") && !chosen.includes(it));
  chosen.push(...measured.filter((it) => moves(it.values(samples, 0))).slice(0, 7));
  if (chosen.length === 0) chosen.push(...moving("angles", 5));
  if (chosen.length === 0) chosen.push(...moving("lengths", 4));
  chosen.push(...moving("contacts", 3));
  for (const kind of ["forces", "torques", "energies", "determinants"]) chosen.push(...moving(kind, 7));
  return chosen.map((it) => it.name);
};
