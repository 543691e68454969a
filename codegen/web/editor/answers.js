// Answers of the library in the form of CodeMirror: proposals, texts beside the pointer, messages.

import { hoverTooltip } from "@codemirror/view";
import { rendered } from "./markdown.js";
import { offsetsOf } from "./offsets.js";

/** Source of proposals: `complete(text, offset)` resolves to `[{ label, kind, detail, documentation, start, end, text }]`. */
export const completionSource = (complete) => async (context) => {
  const word = context.matchBefore(/[A-Za-z_]\w*|\./);
  if (!context.explicit && !word) return null;
  const text = context.state.doc.toString();
  const offsets = offsetsOf(text);
  const proposals = await complete(text, offsets.byte(context.pos)).catch(() => []);
  if (proposals.length === 0) return null;
  const { start, end } = proposals[0];
  return {
    from: offsets.unit(start),
    to: Math.max(offsets.unit(end), context.pos),
    options: proposals.map((it) => ({
      label: it.label,
      apply: it.text,
      type: it.kind,
      detail: it.detail,
      info: it.documentation ? () => rendered(it.documentation) : undefined,
    })),
    validFor: /^\w*$/,
  };
};

/** Texts beside the pointer: `hover(text, offset)` resolves to `{ start, end, text }` with Markdown, or to null. */
export const hovering = (hover) =>
  hoverTooltip(async (view, place) => {
    const { doc } = view.state;
    const text = doc.toString();
    const offsets = offsetsOf(text);
    const answer = await hover(text, offsets.byte(place)).catch(() => null);
    if (!answer || view.state.doc !== doc) return null;
    return {
      pos: offsets.unit(answer.start),
      end: offsets.unit(answer.end),
      above: true,
      create: () => ({ dom: rendered(answer.text) }),
    };
  });

const messageElement = (message) => {
  const shown = document.createElement("div");
  shown.className = "linkwright-message";
  shown.textContent = message.text;
  return shown;
};

/** Messages `{ severity, code, text, start, end }` as diagnostics; those without a place are left out. */
export const diagnostics = (messages, text) => {
  const offsets = offsetsOf(text);
  const placed = messages.filter((it) => it.start !== null && it.start !== undefined);
  return placed.map((it) => ({
    from: offsets.unit(it.start),
    to: Math.max(offsets.unit(it.start), offsets.unit(it.end ?? it.start)),
    severity: it.severity === "error" ? "error" : "warning",
    source: it.code,
    message: it.text,
    renderMessage: () => messageElement(it),
  }));
};
