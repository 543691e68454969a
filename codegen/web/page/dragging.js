// Points whose coordinates are plain numbers in the text: handles that write these numbers.

/// Distance within which the pointer makes a handle visible, in px, and rest after which keys begin another step of undoing, in ms.
const [VISIBLE, PAUSE] = [48, 1500];

/// Directions of keys on the screen.
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

class Dragging {
  /// `text` returns the description, `replace` changes it and `undo` takes the last change back; `isCurrent` is true while the drawing
  /// is of the text, `isGiven` while all values are those of the text. `handles` and `move` ask the solver; `hold` is told while a point is
  /// held.
  constructor(scene, hooks, signal) {
    Object.assign(this, { scene, hooks, signal, of: null, items: [], dragged: null, busy: null });
    this.group = drawn("g", { class: "handles", role: "group", "aria-label": "Points to move" });
    this.reason = made("div", { class: "reason", role: "status", hidden: "" });
    document.body.append(this.reason);
    const on = (event, action, options = {}) => scene.holder.addEventListener(event, action, { signal, ...options });
    on("pointermove", (event) => this.hover(event));
    on("pointerleave", () => this.hover(null));
    // Before points are pulled by time.
    on("pointerdown", (event) => this.press(event), { capture: true });
    on("touchstart", (event) => event.touches.length === 1 && this.point(event.touches[0]) && event.preventDefault(), { passive: false });
    this.group.addEventListener("keydown", (event) => this.key(event));
    this.group.addEventListener("focusout", () => this.dragged?.isByKeys && this.end(true));
    // A handle that is replaced with the drawing keeps the focus until it is given away.
    const give = ({ target }) => {
      this.focused = this.group.contains(target) ? target.closest("[data-index]")?.dataset.index : undefined;
    };
    for (const event of ["focusin", "pointerdown"]) document.addEventListener(event, give, { signal, capture: true });
    scene.watch(() => this.refresh());
    this.refresh();
  }

  /// True while the drawing is the design configuration of the text.
  get isActive() {
    return this.scene.isAtStart && this.hooks.isCurrent() && this.hooks.isGiven();
  }

  /// Takes a changed picture: handles are asked for once for each text.
  async refresh() {
    const { svg, mechanism } = this.scene.state().drawing;
    if (this.group.parentNode !== svg) {
      svg.append(this.group);
      // What contains handles is no picture alone.
      svg.setAttribute("role", "group");
      this.focus();
    }
    this.group.setAttribute("transform", mechanism.getAttribute("transform") ?? "");
    this.place();
    if (this.dragged || !this.isActive) return;
    const text = this.hooks.text();
    if (text === this.of || text === this.asked) return;
    this.asked = text;
    const all = await this.hooks.handles(text).catch(() => []);
    if (this.asked === text) this.asked = null;
    // A reply about an older text is dropped.
    if (text !== this.hooks.text() || this.signal.aborted) return;
    this.of = text;
    this.take(all);
  }

  take(all) {
    const { data } = this.scene;
    const items = all.map((own, index) => {
      const body = own.body === null ? 0 : data.bodies.findIndex((it) => it.name === own.body);
      const point = data.points.find((it) => it.name === own.point);
      return { own, index, body, point, name: own.body ? `${own.point} of ${own.body}` : own.point };
    });
    this.items = items.filter((it) => it.body >= 0);
    const movable = this.items.filter((it) => it.own.position);
    this.group.replaceChildren(
      ...movable.map(({ index, name }) => {
        const element = drawn("g", { class: "handle", tabindex: 0, role: "button", "aria-roledescription": "movable point", "aria-label": name, "data-index": index });
        drawn("circle", { r: 7 }, element);
        return element;
      }),
    );
    this.place();
    this.focus();
  }

  /// Gives the focus back to the handle that had it.
  focus() {
    if (this.focused !== undefined) this.elementOf(this.focused)?.focus({ preventScroll: true });
  }

  elementOf(index) {
    return this.group.querySelector(`[data-index="${index}"]`);
  }

  /// Position of a point in the drawing: that of the point itself, if it has one, so that a handle is where the point is.
  positionOf({ own, body, point }) {
    if (own.position && body > 0) return this.scene.carried(body, own.position);
    return point ? this.scene.carried(point.body, point.local) : own.position;
  }

  /// Puts the handles where their points are.
  place() {
    const isShown = this.dragged !== null || (this.scene.isAtStart && this.hooks.isGiven());
    this.group.style.display = isShown ? "" : "none";
    // What is hidden for a moment keeps the focus.
    this.group.classList.toggle("stale", this.dragged === null && !this.isReady);
    if (this.dragged === null && !this.isReady) return;
    const { scale } = this.scene.state().drawing.stage;
    for (const item of this.items) {
      const element = this.elementOf(item.index);
      item.position = this.dragged?.item.index === item.index ? this.dragged.to : this.positionOf(item);
      if (element && item.position) element.setAttribute("transform", `translate(${item.position[0] * scale} ${-item.position[1] * scale})`);
    }
  }

  get isReady() {
    return this.dragged === null && this.isActive && this.of === this.hooks.text();
  }

  /// The item that the pointer means. Of several at one place, points at the origin of their frame come last, and fixed ones after them.
  point(pointer, hasFixed = false) {
    if (!this.isReady) return null;
    const all = this.items.filter((it) => it.position && (hasFixed || it.own.position));
    const near = this.scene.near(pointer, all);
    const rank = ({ own }) => (own.position ? (own.body !== null && own.position.every((it) => it === 0) ? 1 : 0) : 2);
    const least = near[0]?.distance;
    const there = near.filter((it) => it.distance < least + 0.5).map((it) => it.item);
    return there.sort((a, b) => rank(a) - rank(b))[0] ?? null;
  }

  hover(event) {
    if (event?.buttons) return;
    const item = event && this.point(event, true);
    this.scene.holder.classList.toggle("draggable", Boolean(item?.own.position));
    const near = new Set(event && this.isReady ? this.scene.near(event, this.items.filter((it) => it.position), VISIBLE).map((it) => String(it.item.index)) : []);
    for (const element of this.group.children) element.classList.toggle("near", near.has(element.dataset.index));
    this.explain(item?.own.reason ? `${item.name}: ${item.own.reason}` : "", event);
  }

  /// Says beside the pointer why a point has no handle. The page does not move for it, or the pointer would be elsewhere.
  explain(words, pointer) {
    if (this.reason.textContent !== words) this.reason.textContent = words;
    this.reason.hidden = words === "";
    if (words) Object.assign(this.reason.style, { left: `${pointer.clientX + 14}px`, top: `${pointer.clientY + 14}px` });
  }

  press(event) {
    const item = event.button === 0 && event.isPrimary ? this.point(event) : null;
    // Nothing is pulled while handles are on their way.
    if (item || this.dragged || (this.isActive && !this.isReady)) event.stopPropagation();
    if (!item) return;
    dragPoint(this.scene, item.position, event, this.signal, {
      begun: () => this.begin(item),
      moved: (to) => this.aim(to),
      ended: (isReleased) => this.end(isReleased),
    });
  }

  /// Begins a drag. The pose of the body is that at its beginning: the mechanism that is solved anew may turn the body.
  begin(item, isByKeys = false) {
    const angle = item.body > 0 ? this.scene.pose(item.body)[2][0] : 0;
    const [from, written] = [item.position, item.own.position];
    this.dragged = { item, isByKeys, turn: [Math.cos(angle), Math.sin(angle)], from, to: from, written, goal: written };
    this.hooks.hold(!isByKeys);
    this.scene.holder.classList.toggle("pulling", !isByKeys);
    this.elementOf(item.index)?.classList.add("moved");
  }

  /// Moves the dragged point to a position in m.
  aim(to) {
    const { from, written, turn } = this.dragged;
    const [c, s] = turn;
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    this.aimAt([written[0] + c * dx + s * dy, written[1] + c * dy - s * dx], to);
  }

  /// Moves the dragged point to coordinates in m, which are at a position.
  aimAt(goal, to) {
    const drag = this.dragged;
    Object.assign(drag, { goal, to });
    this.place();
    this.busy ??= this.write(drag).finally(() => {
      this.busy = null;
    });
  }

  /// Writes the newest coordinates until they are in the text.
  async write(drag) {
    let written = null;
    while (drag.goal !== written && !drag.isGivenUp) {
      written = drag.goal;
      const text = this.hooks.text();
      const changes = await this.hooks.move(text, drag.item.index, written).catch(() => []);
      if (drag.isGivenUp) return;
      // The text has changed meanwhile, so that the places are others.
      if (text !== this.hooks.text()) written = null;
      else if (changes.length) {
        this.hooks.replace(changes, drag.hasChanged === true);
        drag.hasChanged = true;
      }
    }
  }

  /// Ends a drag after its last position is written; one that is given up is taken back.
  async end(isReleased) {
    const drag = this.dragged;
    if (!isReleased) {
      drag.isGivenUp = true;
      if (drag.hasChanged) this.hooks.undo();
    }
    await this.busy;
    if (this.dragged !== drag) return;
    this.dragged = null;
    this.hooks.hold(false);
    this.scene.holder.classList.remove("pulling");
    this.elementOf(drag.item.index)?.classList.remove("moved");
    this.refresh();
  }

  /// Arrow keys move the focused point by steps of its resolution along an axis of its frame: that which points there most.
  key(event) {
    if (event.key === "Escape" && this.dragged?.isByKeys) this.end(false);
    const way = WAYS[event.key];
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const { index } = event.target.closest("[data-index]").dataset;
    const item = this.items.find((it) => String(it.index) === index);
    if (!this.dragged && this.isReady && item?.position) this.begin(item, true);
    const drag = this.dragged;
    if (!drag?.isByKeys || drag.item !== item) return;
    const [c, s] = drag.turn;
    const [along, aside] = [c * way[0] + s * way[1], c * way[1] - s * way[0]];
    const axis = Math.abs(along) > Math.abs(aside) ? 0 : 1;
    const step = Math.sign(axis ? aside : along) * item.own.step[axis] * (event.shiftKey ? 10 : 1);
    const [dx, dy] = axis ? [0, step] : [step, 0];
    const to = [drag.to[0] + c * dx - s * dy, drag.to[1] + s * dx + c * dy];
    this.aimAt([drag.goal[0] + dx, drag.goal[1] + dy], to);
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.dragged === drag && this.end(true), PAUSE);
  }
}
