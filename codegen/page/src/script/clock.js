// Time: the slider, the button, the keys and one loop of animation.

/// The page that keys are for while nothing is focused: that which was used last.
let active = null;

class Clock {
  /// `show` is called with each new time.
  constructor(root, part, show, signal) {
    Object.assign(this, { root, show, t: 0, isPlaying: false, request: 0, times: null });
    this.slider = part("time");
    this.play = part("play");
    this.now = part("now");
    this.speed = part("speed");
    this.play.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("input", () => {
      this.pause();
      this.go(Number(this.slider.value));
    });
    active ??= root;
    const use = () => {
      active = root;
    };
    root.addEventListener("pointerdown", use, { signal });
    root.addEventListener("focusin", use, { signal });
    document.addEventListener("keydown", (event) => this.key(event), { signal });
    signal.addEventListener("abort", () => {
      this.pause();
      if (active === root) active = null;
    });
  }

  /// Takes the times of a motion; the time stays where it is, if it can.
  take(times) {
    this.times = times;
    if (!times) return this.pause();
    this.slider.min = times[0];
    this.slider.max = times.at(-1);
  }

  go(time) {
    if (!this.times) return;
    this.t = Math.min(this.times.at(-1), Math.max(this.times[0], time));
    this.slider.value = this.t;
    this.slider.setAttribute("aria-valuetext", `${text(this.t)} s`);
    this.now.textContent = `${this.t.toFixed(3)} s`;
    this.show(this.t);
  }

  tick(stamp) {
    const next = this.t + ((stamp - this.last) / 1000) * Number(this.speed.value);
    this.last = stamp;
    this.go(next > this.times.at(-1) ? this.times[0] : next);
    this.request = requestAnimationFrame((then) => this.tick(then));
  }

  label() {
    this.play.textContent = this.isPlaying ? "❚❚ Pause" : "▶ Play";
    this.play.setAttribute("aria-pressed", String(this.isPlaying));
  }

  pause() {
    cancelAnimationFrame(this.request);
    this.isPlaying = false;
    this.label();
  }

  toggle() {
    if (this.isPlaying) return this.pause();
    this.isPlaying = Boolean(this.times) && this.times.length > 1;
    this.label();
    if (!this.isPlaying) return undefined;
    this.last = performance.now();
    this.request = requestAnimationFrame((stamp) => this.tick(stamp));
    return undefined;
  }

  key(event) {
    const isOurs = this.root.contains(event.target) || (event.target === document.body && active === this.root);
    const isText = event.target.closest?.("input, select, textarea, button, summary, a, [contenteditable]");
    if (!isOurs || isText || event.ctrlKey || event.metaKey || event.altKey || !this.times) return;
    const step = (this.times.at(-1) - this.times[0]) / 100;
    const action = {
      " ": () => this.toggle(),
      ArrowRight: () => this.go(this.t + step),
      ArrowLeft: () => this.go(this.t - step),
      Home: () => this.go(-Infinity),
      End: () => this.go(Infinity),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }
}
