//! Answers requests of an editor about open descriptions, in the language server protocol on stdin and stdout.
//!
//! ```text
//! transport ── messages ──> session ── texts ──> checker ── findings ──> diagnostics
//!                              └── questions ──> requests ──> hover, definition, completion, rename, outline, formatting
//! ```
//!
//! Texts and places of findings are those of the generator, the layout is that of `linkwright fmt`, formulas are those of `linkwright
//! inspect`, meanings of names are those that the generator records while it resolves them. Every answer is a function of the text and an
//! offset in the text; only `session` holds several documents and their changes.

mod capabilities;
mod checker;
mod completion;
mod definition;
mod description;
mod diagnostics;
mod document;
mod equations;
mod formatting;
mod hover;
pub mod names;
mod outline;
mod rename;
mod requests;
mod session;
mod statement;
mod text;
mod transport;

pub use session::serve;
