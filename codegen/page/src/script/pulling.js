// Points of moving bodies that are pulled: the time follows the pointer, or the inputs do where a provider answers.

/// Largest number of steps for one position of the pointer, largest step in parts of the motion, and number of halvings of a step.
const [PULL_STEPS, PULL_SHARE, PULL_HALVINGS] = [60, 1 / 50, 30];

/// Time at which a point is nearest to a position, followed downhill from a time: never to another branch of its path.
const pulledTime = (motion, player, index, [x, y], start) => {
  const { times } = player;
  const [first, last] = [times[0], times.at(-1)];
  const longest = (last - first) * PULL_SHARE;
  const at = (t) => motion.point(player, index, interval(times, t));
  const distance = ([[px, py]]) => Math.hypot(px - x, py - y);
  let t = start;
  for (let step = 0; step < PULL_STEPS; step += 1) {
    const here = at(t);
    const [[px, py], [vx, vy], [ax, ay]] = here;
    const slope = vx * (px - x) + vy * (py - y);
    const curvature = vx * vx + vy * vy + ax * (px - x) + ay * (py - y);
    const downhill = slope > 0 ? -longest : longest;
    let change = curvature > 0 ? Math.max(-longest, Math.min(longest, -slope / curvature)) : downhill;
    let next = t;
    for (let half = 0; half < PULL_HALVINGS; half += 1) {
      next = Math.max(first, Math.min(last, t + change));
      if (distance(at(next)) < distance(here)) break;
      change /= 2;
      next = t;
    }
    if (next === t) break;
    t = next;
  }
  return t;
};

class Pulling {
  /// `ranges` returns the ends of the inputs that can move, by name; `pause` stops the motion, `go` shows a time; `ask` asks for the
  /// answer to a pull, `hold` is told while a point is held, and `released` when it is let go.
  constructor(scene, hooks, signal) {
    Object.assign(this, { scene, hooks, signal, goal: null });
    const on = (event, action, options = {}) => scene.holder.addEventListener(event, action, { signal, ...options });
    on("pointermove", (event) => this.hover(event));
    on("pointerleave", () => this.mark(false));
    on("pointerdown", (event) => this.press(event));
    // A finger on a point does not scroll.
    on("touchstart", (event) => event.touches.length === 1 && this.point(event.touches[0]) && event.preventDefault(), { passive: false });
  }

  mark(isSet) {
    this.scene.holder.classList.toggle("pullable", isSet);
  }

  /// Points of moving bodies where they are now.
  points() {
    const { data, motion, player, t } = this.scene.state();
    if (!player || (player.times.length < 2 && !this.hasInputs())) return [];
    const place = interval(player.times, t);
    const all = data.points.map((own, index) => ({ own, index }));
    const moving = all.filter(({ own }) => data.bodies[own.body].pose?.some((it) => it !== null));
    return moving.map(({ own, index }) => ({ own, index, position: motion.point(player, index, place)[0] }));
  }

  point(pointer) {
    return this.scene.near(pointer, this.points())[0]?.item ?? null;
  }

  hasInputs() {
    return Object.keys(this.hooks.ranges()).length > 0;
  }

  hover(event) {
    if (event.buttons === 0) this.mark(this.point(event) !== null);
  }

  press(event) {
    const point = event.button === 0 && event.isPrimary ? this.point(event) : null;
    if (!point) return;
    const { classList } = this.scene.holder;
    dragPoint(this.scene, point.position, event, this.signal, {
      begun: () => {
        this.hooks.pause();
        this.hooks.hold(true);
        classList.add("pulling");
      },
      moved: (to) => this.pull(point, to),
      ended: (isReleased) => {
        if (isReleased) this.hooks.released();
        this.hooks.hold(false);
        classList.remove("pulling");
      },
    });
  }

  pull(point, to) {
    const { motion, player, t } = this.scene.state();
    if (!player) return;
    if (this.hasInputs()) {
      this.goal = { point: point.own.name, to };
      this.hooks.ask();
    } else this.hooks.go(pulledTime(motion, player, point.index, to, t));
  }

  /// The pull that a question has; it is answered once.
  question() {
    const { goal } = this;
    this.goal = null;
    return goal && { ...goal, t: this.scene.t, ranges: this.hooks.ranges() };
  }
}
