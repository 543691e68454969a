//! *An editor's questions about an open description → answers*, in the language server protocol on stdin and stdout.
//!
//! ```text
//! transport ── messages ──> session ── texts ──> checker ── findings ──> diagnostics
//!                              └── questions ──> requests ──> hover, definition, completion, rename, outline, formatting
//! ```
//! Texts and places of findings are the generator's own, layout is that of `linkwright fmt`, formulas are those of `linkwright
//! inspect`. What names stand for is found by [`names`], from the statements alone. Every answer is a function of the text and an
//! offset in it; only `session` knows that there are several documents and that they change.

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
