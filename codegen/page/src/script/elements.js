// Elements and numbers as text.

const SVG = "http://www.w3.org/2000/svg";

const drawn = (name, attributes, parent) => {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.append(element);
  return element;
};

/// An HTML element with its attributes and contents; attributes without a value are left out.
const made = (name, attributes = {}, ...contents) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) if (value != null) element.setAttribute(key, value);
  element.append(...contents);
  return element;
};

/// Numbers in an attribute.
const numbers = (text) => text.split(" ").map(Number);
const words = (value) => (value ?? "").split(" ").filter(Boolean);

const text = (value) => {
  const size = Math.abs(value);
  if (size < 1e-9) return "0";
  const digits = size >= 1e-3 && size < 1e6 ? String(Number(value.toPrecision(6))) : value.toExponential(4);
  return digits.replaceAll("-", "−");
};

/// Smallest step of 1, 2, 5 or 10 times a power of ten that is at least this long.
const round = (least) => {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((value) => value >= least * (1 - 1e-9));
};

/// Path through points; numbers are rounded to a hundredth of a pixel.
const pathThrough = (xs, ys) => {
  let d = "";
  for (let index = 0; index < xs.length; index += 1) d += `${index ? "L" : "M"}${xs[index]} ${Math.round(ys[index] * 100) / 100}`;
  return d;
};
const hundredths = (value) => Math.round(value * 100) / 100;
