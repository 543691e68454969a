//! Derived equations, plans, pictures and the words for them, many of them as snapshots.

mod beside;
mod block_words;
mod definitions;
mod derivations;
mod determinants;
mod determinism;
mod drawings;
mod dyad_chain;
mod explained_factors;
mod faces_of_modules;
mod lines_of_modules;
mod meeting;
mod named_parts;
mod plans;
mod singular_words;
mod snapshots;
mod words_of_modules;
mod workshop;

/// Compares a text with the snapshot `tests/snapshots/<folder>/<name>.snap`.
fn assert_snapshot(folder: &str, name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(linkwright_tests::files::package("snapshots").join(folder));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}
