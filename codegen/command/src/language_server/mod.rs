//! Answers requests of an editor about open descriptions, in the language server protocol on stdin and stdout.
//!
//! ```text
//! transport ── messages ──> session ── texts ──> checker ── findings ──> diagnostics
//!                              └── questions ──> requests ──> converted answers of linkwright-editing
//! ```
//!
//! Texts and places of findings are those of the generator, the layout is that of `linkwright fmt`, formulas are those of `linkwright
//! inspect`, meanings of names are those that the generator records while it resolves them. Every answer is a function of the text and an
//! offset in the text, which `linkwright-editing` computes; only `session` holds several documents and their changes.

mod capabilities;
mod checker;
mod converted;
mod diagnostics;
mod document;
mod requests;
mod session;
mod text;
mod transport;

#[doc(no_inline)]
pub use linkwright_editing::names;
pub use session::serve;
