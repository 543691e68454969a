// Assemblies.

const around = (root, own, times) => {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const time of times) {
    root.show(state(own, time), arrowsOf(own, time));
    const area = root.root.getBBox();
    [x0, y0, x1, y1] = [Math.min(x0, area.x), Math.min(y0, area.y), Math.max(x1, area.x + area.width), Math.max(y1, area.y + area.height)];
  }
  return [x0, y0, x1 - x0, y1 - y0];
};
const boxes = new Map();
const frame = () => {
  const legend = svg.querySelector("#legend");
  if (player === data.assemblies[0]) {
    legend.removeAttribute("transform");
    return svg.setAttribute("viewBox", box);
  }
  if (!boxes.has(player)) {
    const every = Math.max(1, Math.ceil(player.times.length / 24));
    const times = player.times.filter((_, index) => index % every === 0);
    const [x, y, width, height] = around(stage, player, times);
    const [dx, dy] = numbers(mechanism.getAttribute("transform").replace(/^translate\(|\)$/g, ""));
    boxes.set(player, `${x + dx - 16} ${y + dy - 16} ${width + 32} ${height + 48}`);
  }
  svg.setAttribute("viewBox", boxes.get(player));
  // The scale bar stays in the lower left corner.
  const [left, top, , height] = numbers(boxes.get(player));
  legend.setAttribute("transform", `translate(${left} ${top + height - numbers(box)[3]})`);
};

const pick = (own) => {
  if (!own.times) return;
  if (own !== player) {
    pause();
    player = own;
    sample();
    trace();
  }
  dress(mechanism, player);
  stage.collect();
  tag();
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
      dress(copy, own);
      for (const part of copy.querySelectorAll("#names, #traces, [data-still], title")) part.remove();
      for (const part of [copy, ...copy.querySelectorAll("*")]) {
        part.removeAttribute("id");
        delete part.dataset.is;
        delete part.dataset.of;
      }
      picture.append(copy);
      holder.append(button);
      const [x, y, width, height] = around(new Stage(copy), own, own.times.slice(0, 1));
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
      why.textContent = own.times ? `motion ends at t = ${text(own.times.at(-1))} s` : own.error;
      why.title = own.error;
      button.append(why);
    }
    button.addEventListener("click", () => pick(own));
  }
};

