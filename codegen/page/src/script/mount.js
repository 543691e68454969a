// A page in an element: scripts look up what they need in it, and nothing outside.

/// Shows data in an element of the structure of a page. A provider answers questions; a file has none.
///
/// Returns `question()`, `ask(detail)` and `destroy()`; where the scripts of answers are, `update(answer)` replaces what the answer has and
/// keeps the rest.
const mount = (root, first, provider = null) => {
  const part = (name) => root.querySelector(`[data-part="${name}"]`);
  const over = new AbortController();
  const { signal } = over;
  const [shown, traced] = [new Set(), new Set()];
  let data = null;
  let motion = null;
  let drawing = null;
  let player = null;
  let samples = null;
  let curves = [];
  let label = null;
  let leading = null;
  /// True while a motion under forces waits at a pose, and from the release of a point until the motion that follows comes.
  let [isHeld, isReleased] = [false, false];

  const pointing = new Pointing(root, signal);
  const values = new Values(part("live"), () => pointing.forget());
  const scene = new Scene(part("drawing"), () => ({ data, motion, drawing, player, t: clock.t }));
  const show = (t) => {
    const q = drawing.show(player, t);
    charts.show(t);
    values.show(q);
    scene.changed();
  };
  const clock = new Clock(root, part, show, signal);
  const charts = new Charts(
    part("charts"),
    (share) => {
      clock.pause();
      clock.go(player.times[0] + share * (player.times.at(-1) - player.times[0]));
    },
    () => pointing.forget(),
  );
  const indices = () => data.points.map((it, index) => (traced.has(it.name) ? index : -1)).filter((it) => it >= 0);
  const plot = () => charts.prepare(curves.filter((it) => shown.has(it.name)), samples, unitsOf(data));
  const trace = () => {
    drawing.trace(samples, indices());
    pointing.forget();
    show(clock.t);
  };
  const assemblies = new Assemblies(part, (name) => choose(name), provider !== null);
  const controls = provider
    ? new Controls(part("panel"), (detail) => (detail === "moving" ? questions.moving() : questions.ask("resting")))
    : new Given(part("panel"));
  const pulling = new Pulling(
    scene,
    {
      ranges: () => (provider ? controls.ranges() : {}),
      pause: () => {
        isReleased = false;
        clock.pause();
      },
      go: (t) => clock.go(t),
      ask: () => questions.moving(),
      hold: (isHeld) => questions?.hold(isHeld),
      released: () => {
        isReleased = controls.isFree === true;
      },
    },
    signal,
  );
  const question = (detail = "resting") => {
    const { values, range } = controls.question();
    const scale = detail === "moving" ? drawing.stage.scale : null;
    return { values, range: range ?? data.range, assembly: label, detail, scale };
  };
  /// Shows the selected assembly, or the first that moves.
  const select = () => {
    const all = data.assemblies;
    const solved = all.filter((it) => it.times);
    player = solved.find((it) => it.label === label) ?? (all[0]?.times ? all[0] : solved[0]) ?? null;
    label = player?.label ?? label;
    samples = player && new Samples(motion, player);
    clock.take(player?.times ?? null);
    root.classList.toggle("still", !player);
    if (player) drawing.pick(player, samples, indices());
    if (!isHeld) plot();
    pointing.forget();
    if (player) clock.go(clock.t);
  };
  const choose = (name) => {
    const own = data.assemblies.find((it) => it.label === name);
    label = name;
    if (own?.times && own !== player) {
      clock.pause();
      select();
      assemblies.mark(player);
    }
    questions?.ask("resting");
  };

  /// Takes a motion, the drawing of which is in the page already.
  const take = (answer) => {
    // Another mechanism begins with its own curves.
    const names = (it) => it?.coordinates.map((own) => own.name).join();
    const isFirst = names(data) !== names(answer);
    data = answer;
    motion = new Motion(data);
    drawing = new Drawing(part("drawing"), motion);
    drawing.mechanism.querySelector("[id=names]").style.display = part("names").checked ? "" : "none";
    pointing.data = data;
    values.take(data);
    curves = curvesOf(motion);
    if (isFirst) {
      shown.clear();
      traced.clear();
      label = data.assemblies[0]?.label ?? null;
      for (const point of data.points.filter((it) => it.free).slice(0, 3)) traced.add(point.name);
      clock.t = data.assemblies.find((it) => it.times)?.times[0] ?? 0;
    }
    if (shown.size === 0) begin();
    for (const curve of curves) curve.rank = curve.kind === leading ? 0 : 1;
    select();
    if (data.sketch) return;
    assemblies.take(drawing, player);
    chips();
  };
  /// Chooses the curves that are shown at first.
  const begin = () => {
    const own = data.assemblies.find((it) => it.times);
    if (!own) return;
    const requested = data.requested ?? words(part("plots").dataset.requested);
    for (const name of firstChoice(curves, new Samples(motion, own), requested)) shown.add(name);
    leading = curves.find((it) => shown.has(it.name) && requested.includes(it.is))?.kind ?? curves.find((it) => shown.has(it.name) && it.kind.startsWith("measured"))?.kind ?? curves.find((it) => shown.has(it.name))?.kind;
  };
  let chosen = "";
  const chips = () => {
    const names = curves.map((it) => `${it.is} ${it.name}`).join();
    if (names === chosen) return;
    chosen = names;
    chooser(part("chips"), { curves, points: data.points }, shown, traced, plot, trace);
  };

  const takeAnswer = (answer) => {
    label = answer.pulled?.assembly ?? label;
    isHeld = Boolean(answer.sketch && answer.pulled?.starts);
    take(answer);
    if (!isReleased || answer.sketch) return;
    isReleased = false;
    if (!clock.isPlaying) clock.toggle();
  };
  const takeSections = () => assemblies.take(drawing, player);
  const live = mount.answering?.({ root, part, clock, controls, pulling, question, take: takeAnswer, takeSections }, provider, signal);
  const questions = live?.questions;

  part("names").addEventListener("change", (event) => {
    drawing.mechanism.querySelector("[id=names]").style.display = event.target.checked ? "" : "none";
  });
  part("live").addEventListener("toggle", () => player && show(clock.t));
  for (const event of ["pointerover", "focusin"]) root.addEventListener(event, (it) => showEntry(root, it.target), { signal });
  // Paper has all charts, and the drawing at its start.
  let before = null;
  addEventListener(
    "beforeprint",
    () => {
      if (!player) return;
      before = clock.t;
      clock.pause();
      charts.draw(true);
      assemblies.draw();
      clock.go(player.times[0]);
    },
    { signal },
  );
  addEventListener("afterprint", () => player && before !== null && clock.go(before), { signal });

  take(first);
  controls.take(first);
  if (first.messages) live.messages(first.messages, false);
  return {
    update: live?.update,
    question,
    ask: (detail = "resting") => questions?.ask(detail),
    change: () => questions?.moving(),
    scene,
    hold: (isHeld) => questions?.hold(isHeld),
    choose: (values) => controls.set(values),
    forget: () => {
      label = null;
      controls.forget();
    },
    destroy: () => {
      over.abort();
      charts.end();
      assemblies.end();
    },
  };
};
