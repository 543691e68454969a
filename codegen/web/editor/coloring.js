// Coloring: tokens of the library as decorations, which follow the changes of the text until new tokens arrive.

import { StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, ViewPlugin } from "@codemirror/view";
import { offsetsOf } from "./offsets.js";

/** Pause after a change before tokens are requested, in ms: less than a frame of the screen. */
const PAUSE = 15;

/** Kinds with the color of the text. */
const PLAIN = new Set(["name"]);

const colored = StateEffect.define();

const decorations = StateField.define({
  create: () => Decoration.none,
  update: (current, transaction) => {
    const mapped = transaction.docChanged ? current.map(transaction.changes) : current;
    return transaction.effects.reduce((set, effect) => (effect.is(colored) ? effect.value : set), mapped);
  },
  provide: (field) => EditorView.decorations.from(field),
});

const marks = new Map();

const mark = (kind) => {
  if (!marks.has(kind)) marks.set(kind, Decoration.mark({ class: `linkwright-token linkwright-${kind}` }));
  return marks.get(kind);
};

const ranges = (tokens, text) => {
  const offsets = offsetsOf(text);
  const each = tokens.filter(([, , kind]) => !PLAIN.has(kind)).map(([from, to, kind]) => [offsets.unit(from), offsets.unit(to), kind]);
  return Decoration.set(
    each.filter(([from, to]) => from < to).map(([from, to, kind]) => mark(kind).range(from, to)),
    true,
  );
};

/** Extension that colors a text by the answers of `tokens`. An answer about an older text is dropped. */
export const coloring = (tokens) => [
  decorations,
  ViewPlugin.define((view) => {
    let timer;
    const request = async () => {
      const { doc } = view.state;
      const text = doc.toString();
      const answer = await tokens(text);
      if (view.state.doc === doc && timer !== null) view.dispatch({ effects: colored.of(ranges(answer, text)) });
    };
    const later = () => {
      clearTimeout(timer);
      // Without an answer, the last colors stay.
      timer = setTimeout(() => request().catch(() => {}), PAUSE);
    };
    later();
    return {
      update: (update) => {
        if (update.docChanged) later();
      },
      destroy: () => {
        clearTimeout(timer);
        timer = null;
      },
    };
  }),
];
