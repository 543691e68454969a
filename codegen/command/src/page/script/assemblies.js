// Assemblies.

const around = (root, poses) => {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const q of poses) {
    root.show(q);
    const area = root.root.getBBox();
    [x0, y0, x1, y1] = [Math.min(x0, area.x), Math.min(y0, area.y), Math.max(x1, area.x + area.width), Math.max(y1, area.y + area.height)];
  }
  return [x0, y0, x1 - x0, y1 - y0];
};
const boxes = new Map();
const frame = () => {
  if (player === data.assemblies[0]) return svg.setAttribute("viewBox", box);
  if (!boxes.has(player)) {
    const every = Math.max(1, Math.ceil(player.times.length / 24));
    const poses = player.times.filter((_, index) => index % every === 0).map((time) => state(player, time));
    const [x, y, width, height] = around(stage, poses);
    const [dx, dy] = numbers(mechanism.getAttribute("transform").replace(/^translate\(|\)$/g, ""));
    boxes.set(player, `${x + dx - 16} ${y + dy - 16} ${width + 32} ${height + 48}`);
  }
  svg.setAttribute("viewBox", boxes.get(player));
};

const pick = (own) => {
  if (!own.times) return;
  if (own !== player) {
    pause();
    player = own;
    sample();
    trace();
  }
  frame();
  plot();
  gather();
  slider.min = player.times[0];
  slider.max = player.times.at(-1);
  go(t);
  for (const button of find("thumbnails").children) button.setAttribute("aria-pressed", String(button.player === player));
  const error = find("assembly-error");
  error.hidden = !player.error;
  error.textContent = player.error ? `${player.label}: ${player.error}` : "";
};

const thumbnails = () => {
  const holder = find("thumbnails");
  for (const own of data.assemblies) {
    const button = document.createElement("button");
    button.type = "button";
    button.player = own;
    button.setAttribute("aria-pressed", String(own === player));
    if (own.times) {
      const picture = drawn("svg", { class: "linkwright", "aria-hidden": "true" }, button);
      const copy = mechanism.cloneNode(true);
      copy.removeAttribute("transform");
      for (const part of copy.querySelectorAll("#names, #traces, [data-still], title")) part.remove();
      for (const part of [copy, ...copy.querySelectorAll("*")]) {
        part.removeAttribute("id");
        delete part.dataset.is;
        delete part.dataset.of;
      }
      picture.append(copy);
      holder.append(button);
      const [x, y, width, height] = around(new Stage(copy), [state(own, own.times[0])]);
      const side = Math.max(width, height) + 16;
      picture.setAttribute("viewBox", `${x + width / 2 - side / 2} ${y + height / 2 - side / 2} ${side} ${side}`);
    } else {
      button.disabled = true;
      holder.append(button);
    }
    const caption = document.createElement("span");
    caption.textContent = own.label;
    button.append(caption);
    if (own.error) {
      const why = document.createElement("small");
      why.textContent = own.times ? `ends at ${text(own.times.at(-1))} s` : own.error;
      why.title = own.error;
      button.append(why);
    }
    button.addEventListener("click", () => pick(own));
  }
};

