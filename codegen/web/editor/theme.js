// Looks: the variables of the page, so that the editor is light or dark with it. Nothing is loaded, marks are drawn by borders.

import { EditorView } from "@codemirror/view";

const mixed = (color, share) => `color-mix(in srgb, var(--${color}) ${share}%, var(--paper))`;

const underline = (color) => ({
  backgroundImage: "none",
  paddingBottom: "0",
  textDecoration: `underline wavy var(--${color})`,
  textDecorationSkipInk: "none",
  textUnderlineOffset: "3px",
});

const gutterMark = (color, radius) => ({
  content: "normal",
  width: "0.6em",
  height: "0.6em",
  margin: "0.45em 0.2em",
  borderRadius: radius,
  background: `var(--${color})`,
});

export const theme = EditorView.theme({
  "&": { color: "var(--ink)", backgroundColor: "var(--paper)", height: "100%", fontSize: "14px" },
  "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "-2px" },
  ".cm-scroller": { fontFamily: 'ui-monospace, "Liberation Mono", "DejaVu Sans Mono", monospace', lineHeight: "1.5" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-gutters": { color: "var(--note)", backgroundColor: "var(--soft)", borderRight: "1px solid var(--line)" },
  ".cm-activeLine": { backgroundColor: mixed("line", 25) },
  ".cm-activeLineGutter": { color: "var(--ink)", backgroundColor: mixed("line", 60) },
  ".cm-matchingBracket, &.cm-focused .cm-matchingBracket": { backgroundColor: mixed("accent", 25) },
  ".cm-nonmatchingBracket, &.cm-focused .cm-nonmatchingBracket": { backgroundColor: mixed("bad", 25) },
  ".cm-searchMatch": { backgroundColor: mixed("warn", 25), outline: "none" },
  ".cm-searchMatch-selected": { backgroundColor: mixed("warn", 50) },
  ".cm-tooltip, .cm-panels": { color: "var(--ink)", backgroundColor: "var(--soft)", border: "1px solid var(--line)" },
  ".cm-panels input, .cm-panels button": { color: "var(--ink)", background: "var(--paper)", border: "1px solid var(--line)" },
  ".cm-tooltip": { maxWidth: "min(46rem, 90vw)" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { color: "var(--paper)", backgroundColor: "var(--accent)" },
  ".cm-completionDetail": { fontStyle: "normal", opacity: "0.75" },
  ".cm-lintRange-error": underline("bad"),
  ".cm-lintRange-warning": underline("warn"),
  ".cm-lintRange-active": { backgroundColor: mixed("warn", 20) },
  ".cm-lintPoint-error:after": { borderBottomColor: "var(--bad)" },
  ".cm-lintPoint-warning:after": { borderBottomColor: "var(--warn)" },
  ".cm-lint-marker-error": gutterMark("bad", "50%"),
  ".cm-lint-marker-warning": gutterMark("warn", "0"),
  ".cm-diagnostic-error": { borderLeftColor: "var(--bad)" },
  ".cm-diagnostic-warning": { borderLeftColor: "var(--warn)" },
  ".cm-diagnosticSource": { color: "var(--note)" },
  ".linkwright-message": { whiteSpace: "pre-wrap", fontFamily: 'ui-monospace, "Liberation Mono", "DejaVu Sans Mono", monospace' },
  ".linkwright-markdown": { padding: "4px 10px", maxHeight: "24rem", overflow: "auto" },
  ".linkwright-markdown p, .linkwright-markdown pre, .linkwright-markdown ul": { margin: "6px 0" },
  ".linkwright-markdown pre": { whiteSpace: "pre-wrap" },
  ".linkwright-markdown code": { backgroundColor: "var(--paper)" },
  ".linkwright-keyword": { color: "var(--accent)", fontWeight: "600" },
  ".linkwright-number, .linkwright-text": { color: "var(--token-number, light-dark(#0a6b3d, #7fd6a4))" },
  ".linkwright-unit": { color: "var(--token-unit, light-dark(#7a3e9d, #d3a6ee))" },
  ".linkwright-operator": { color: "var(--note)" },
  ".linkwright-comment": { color: "var(--note)", fontStyle: "italic" },
  ".linkwright-documentation": { color: "var(--token-documentation, light-dark(#4b6584, #a9bfd8))", fontStyle: "italic" },
});
