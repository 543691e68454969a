// Markdown of hover texts and documentation: fenced code, lists, paragraphs and code spans, as elements with text alone.

const element = (name, className, children) => {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...children);
  return made;
};

/** Text with code spans. */
const spans = (text) => text.split(/`([^`]+)`/).map((part, place) => (place % 2 ? element("code", "", [part]) : part));

const isItem = (line) => /^\s*[-*] /.test(line);

const paragraph = (lines) => element("p", "", spans(lines.join(" ")));

/** Elements of a block without blank lines. */
const block = (lines) => {
  const made = [];
  while (lines.length) {
    const start = lines.findIndex(isItem);
    if (start < 0) {
      made.push(paragraph(lines));
      break;
    }
    if (start > 0) made.push(paragraph(lines.slice(0, start)));
    const items = [];
    let rest = lines.slice(start);
    while (rest.length) {
      const next = rest.slice(1).findIndex(isItem);
      const item = next < 0 ? rest : rest.slice(0, next + 1);
      items.push(element("li", "", spans([item[0].replace(/^\s*[-*] /, ""), ...item.slice(1)].join(" "))));
      rest = rest.slice(item.length);
    }
    made.push(element("ul", "", items));
    break;
  }
  return made;
};

/** Renders a text of Markdown. */
export const rendered = (text) => {
  const made = [];
  let lines = [];
  let code;
  const close = () => {
    if (lines.length) made.push(...block(lines));
    lines = [];
  };
  for (const line of text.split("\n")) {
    if (line.startsWith("```")) {
      if (code) made.push(element("pre", "", [code.join("\n")]));
      else close();
      code = code ? undefined : [];
    } else if (code) code.push(line);
    else if (line.trim() === "") close();
    else lines.push(line);
  }
  if (code) made.push(element("pre", "", [code.join("\n")]));
  close();
  return element("div", "linkwright-markdown", made);
};
