//! Answers questions of an editor about a description: names, completions, hover texts, outlines, changes of names and layouts, and
//! the points that can be dragged.
//!
//! A [`Description`] is read once for each text; every answer is a function of it and a byte offset. Meanings of names are those that
//! the generator records while it resolves them, the layout is that of `linkwright fmt`, formulas are those of `linkwright inspect`.
//!
//! ```
//! use linkwright_codegen::Source;
//! use linkwright_editing::{Description, completions};
//!
//! let text = "mechanism crank { point O = (0, 0); body arm at ";
//! let description = Description::of(Source::new("crank.mech", text));
//! let proposed = completions(&description, text.len());
//! assert!(proposed.iter().any(|it| it.label == "O"));
//! ```

#![doc(html_root_url = "https://docs.rs/linkwright-editing/0.1.0")]

mod completion;
mod definition;
mod description;
mod edit;
mod equations;
mod formatting;
mod handles;
mod hover;
mod moved;
pub mod names;
mod outline;
mod rename;
mod statement;
mod tokens;

pub use completion::{Completion, CompletionKind, completions};
pub use definition::{definitions, references};
pub use description::Description;
pub use edit::Edit;
pub use formatting::formatted;
pub use handles::{Coordinate, Handle, handles};
pub use hover::{Hover, hover};
pub use moved::{moved, step};
pub use outline::{Entry, outline};
pub use rename::{renamable, rename};
pub use tokens::{Token, TokenKind, tokens};
