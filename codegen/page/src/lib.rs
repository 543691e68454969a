//! Makes pages of planar mechanisms: a moving drawing, equations, derivation and curves.
//!
//! Drawings, formulas and derivations come from the generator, motions from the solver; this package arranges them. Scripts move the
//! drawing and draw curves from the numbers in the page, and load nothing. Every name and every line of documentation is escaped when
//! it enters the page. Numbers are JSON, in which no tag can end.
//!
//! The package reads and writes no files, and also builds for `wasm32-unknown-unknown`.

#![doc(html_root_url = "https://docs.rs/linkwright-page/0.1.0")]

mod answer;
mod assembly_table;
mod body;
pub mod check_json;
pub mod check_text;
pub mod comma_separated;
mod compact;
mod constraints;
mod controls;
mod dense_script;
mod equations;
mod forced;
mod given;
mod live;
pub mod losses;
pub mod measured;
mod message;
pub mod motion;
pub mod motors;
mod moving;
mod number;
mod pattern;
mod picture;
mod players;
mod pull;
mod question;
mod recorded;
mod restarted;
mod sections;
mod session;
mod shown_units;
mod solution;
mod start;
pub mod units;
mod whole;

pub use answer::Answer;
pub use body::skeleton;
pub use controls::Control;
pub use forced::checked;
pub use live::live;
pub use message::{Message, messages, refused};
pub use moving::labeled;
pub use pull::Pulled;
pub use question::{Detail, Pull, Question, Range};
pub use recorded::at_start;
pub use session::Session;
pub use whole::{Live, Page, page, problem};
