// Everything for the first time.

if (!player) {
  find("controls").hidden = true;
  find("live").hidden = true;
  find("plots").hidden = true;
  thumbnails();
  gather();
  document.body.dataset.ready = "";
  return;
}
sample();
trace();
slider.min = player.times[0];
slider.max = player.times.at(-1);
gather();
show();
// What is further down comes after the first picture.
setTimeout(() => {
  choose("angles", 5);
  choose("lengths", 4);
  for (const index of traced) for (const curve of curves) if (curve.is === `p${index}`) shown.add(curve);
  choose("contacts", 3);
  for (const kind of ["forces", "torques", "energies"]) choose(kind, 7);
  choose("determinants", 7);
  chips();
  thumbnails();
  pick(player);
  document.body.dataset.ready = "";
});
// Widths change with the window.
let width = innerWidth;
addEventListener("resize", () => {
  if (innerWidth === width) return;
  width = innerWidth;
  plot();
  gather();
  show();
});

