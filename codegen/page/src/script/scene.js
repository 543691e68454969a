// The drawing at an instant: where points are on the screen, and what the pointer is near to.

/// Distance within which a point is meant, in px of the screen.
const MEANT = 9;

class Scene {
  /// `state` returns `{ data, motion, drawing, player, t }`.
  constructor(holder, state) {
    Object.assign(this, { holder, state, watchers: new Set() });
  }

  get data() {
    return this.state().data;
  }

  get t() {
    return this.state().t;
  }

  /// True at the first instant of the motion.
  get isAtStart() {
    const { player, t } = this.state();
    return player !== null && t === player.times[0];
  }

  /// x, y and angle of a body in m and rad, with rates and accelerations.
  pose(body) {
    const { motion, player, t } = this.state();
    return motion.pose(motion.state(player, t), body);
  }

  /// Position of what a body carries, in m.
  carried(body, local) {
    return this.state().motion.carried(this.pose(body), local)[0];
  }

  /// Transformation from the pixels of the drawing to those of the screen.
  matrix() {
    return this.state().drawing.mechanism.getScreenCTM();
  }

  /// Position on the screen of a position in m.
  screen([x, y]) {
    const { scale } = this.state().drawing.stage;
    const place = new DOMPoint(x * scale, -y * scale).matrixTransform(this.matrix());
    return [place.x, place.y];
  }

  /// Function from a pointer to the position in m below it, in the picture as it is now.
  lens() {
    const { scale } = this.state().drawing.stage;
    const inverse = this.matrix().inverse();
    return ({ clientX, clientY }) => {
      const place = new DOMPoint(clientX, clientY).matrixTransform(inverse);
      return [place.x / scale, -place.y / scale];
    };
  }

  /// Items with a `position` in m that the pointer is near to, the nearest first, with their distance in px.
  near({ clientX, clientY }, items, reach = MEANT) {
    const apart = items.map((item) => {
      const [x, y] = this.screen(item.position);
      return { item, distance: Math.hypot(x - clientX, y - clientY) };
    });
    return apart.filter((it) => it.distance <= reach).sort((a, b) => a.distance - b.distance);
  }

  /// Calls a function after each change of the picture.
  watch(action) {
    this.watchers.add(action);
  }

  changed() {
    for (const action of this.watchers) action();
  }
}

/// Motion below which a press is a click, in px.
const STEADY = 3;

/// Drags a point from a position in m: calls `begun` when the pointer moves, `moved` with each position of the point, and `ended` with
/// true if the button was released, false if it was given up. Nothing is called for a click.
const dragPoint = (scene, position, press, signal, { begun, moved, ended }) => {
  const below = scene.lens();
  // The point is held where it was pressed.
  const [x, y] = below(press);
  const over = new AbortController();
  const options = { signal: over.signal };
  signal.addEventListener("abort", () => over.abort(), options);
  let isMoving = false;
  const isOwn = (event) => event.pointerId === press.pointerId;
  const end = (isReleased) => {
    over.abort();
    if (isMoving) ended(isReleased);
  };
  addEventListener(
    "pointermove",
    (event) => {
      if (!isOwn(event)) return;
      if (!isMoving && Math.hypot(event.clientX - press.clientX, event.clientY - press.clientY) < STEADY) return;
      if (!isMoving) begun();
      isMoving = true;
      event.preventDefault();
      const [toX, toY] = below(event);
      moved([position[0] + toX - x, position[1] + toY - y]);
    },
    options,
  );
  addEventListener("pointerup", (event) => isOwn(event) && end(true), options);
  addEventListener("pointercancel", (event) => isOwn(event) && end(false), options);
  addEventListener("keydown", (event) => event.key === "Escape" && end(false), options);
  // Text is not selected meanwhile.
  addEventListener("selectstart", (event) => event.preventDefault(), options);
};
