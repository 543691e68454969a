// Editor of the playground: `createEditor(parent, options)`.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, isolateHistory, redo, undo } from "@codemirror/commands";
import { bracketMatching, indentUnit } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { search, searchKeymap } from "@codemirror/search";
import { Annotation, EditorState } from "@codemirror/state";
import { EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
import { completionSource, diagnostics, hovering } from "./answers.js";
import { coloring } from "./coloring.js";
import { offsetsOf } from "./offsets.js";
import { theme } from "./theme.js";

/** Description for screen readers. */
const DESCRIPTION =
  "Tab leaves the editor. Control and space propose words, F8 goes to the next message, Control and Shift and M list all messages.";

/** True if a change continues the last one, so that both are undone together. */
const joined = Annotation.define();

let editors = 0;

const language = () => [{ commentTokens: { line: "//", block: { open: "/*", close: "*/" } }, closeBrackets: { brackets: ["(", "[", "{"] } }];

/**
 * Creates an editor in an element. All offsets are bytes of UTF-8 in the text; line breaks of the text are `\n`.
 *
 * @param {Element} parent
 * @param {object} options
 * @param {string} [options.text] first text
 * @param {string} [options.label] name for screen readers
 * @param {(text: string) => void} [options.change] called after every change, also by `replace`, `undo` and `redo`, not by `set`
 * @param {(text: string) => Promise<[number, number, string][]>} options.tokens beginning, end and kind of each token
 * @param {(text: string, offset: number) => Promise<object[]>} options.complete proposals, see `completionSource`
 * @param {(text: string, offset: number) => Promise<object | null>} options.hover text beside the pointer, see `hovering`
 * @param {object[]} [options.messages] messages about the first text, see `diagnostics`
 */
export const createEditor = (parent, options) => {
  const describing = document.createElement("div");
  describing.hidden = true;
  describing.id = `linkwright-editor-${(editors += 1)}`;
  describing.textContent = DESCRIPTION;
  const extensions = [
    lineNumbers(),
    lintGutter(),
    history({ joinToEvent: (transaction, isAdjacent) => transaction.annotation(joined) ?? isAdjacent }),
    bracketMatching(),
    closeBrackets(),
    search({ top: true }),
    highlightActiveLine(),
    highlightActiveLineGutter(),
    indentUnit.of("    "),
    EditorState.languageData.of(language),
    EditorView.lineWrapping,
    EditorView.contentAttributes.of({ tabindex: "0", "aria-label": options.label ?? "Description of the mechanism", "aria-describedby": describing.id }),
    // Tab is not bound, so that it leaves the editor.
    keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...completionKeymap, ...lintKeymap]),
    autocompletion({ override: [completionSource(options.complete)], icons: false }),
    hovering(options.hover),
    coloring(options.tokens),
    EditorView.updateListener.of((update) => {
      if (update.docChanged) options.change?.(update.state.doc.toString());
    }),
    theme,
  ];
  const stateOf = (text) => EditorState.create({ doc: text, extensions });
  const view = new EditorView({ state: stateOf(options.text ?? ""), parent });
  parent.append(describing);
  const text = () => view.state.doc.toString();
  /** Shows messages about a text, by default the current one; without effect if the text has changed since. */
  const show = (messages, of = text()) => {
    if (of === text()) view.dispatch(setDiagnostics(view.state, diagnostics(messages, of)));
  };
  show(options.messages ?? []);
  return {
    text,
    show,
    /** Begins with another text; what was done before cannot be undone. */
    set: (text) => view.setState(stateOf(text)),
    /**
     * Replaces parts `{ start, end, text }` of the current text, in one step of undoing. With `isJoined`, the step continues the last one,
     * as while a point is dragged.
     */
    replace: (changes, isJoined = false) => {
      const offsets = offsetsOf(text());
      const each = changes.map((it) => ({ from: offsets.unit(it.start), to: offsets.unit(it.end), insert: it.text }));
      const annotations = isJoined ? joined.of(true) : isolateHistory.of("before");
      view.dispatch({ changes: each, annotations });
    },
    /** Puts the cursor at an offset and the focus into the editor. */
    select: (offset) => {
      const anchor = offsetsOf(text()).unit(offset);
      view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
      view.focus();
    },
    undo: () => undo(view),
    redo: () => redo(view),
    focus: () => view.focus(),
    destroy: () => {
      view.destroy();
      describing.remove();
    },
  };
};
