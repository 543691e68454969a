//! *Source → the same description in the usual layout.*
//!
//! ```text
//! text ── pieces ──> words, marks and comments ── rows ──> lines and their indentation ── columns ──> gaps between them
//! ```
//! Every statement starts a line of its own, four blanks deep for each pair of braces with statements around it; what goes on below
//! its first line is four blanks deeper. Between words and marks stands one blank or none. Kept are comments, the line breaks inside
//! a statement, one of several blank lines, and columns: where a gap of two or more blanks brings something below its like in the
//! next line, both stay below one another.
//!
//! Afterwards the text has the words, marks and comments that it had, in their order, and formatting it again changes nothing. What
//! a statement means is not known here.

mod columns;
mod pieces;
mod rows;
mod spacing;
#[cfg(test)]
mod tests;

use crate::diagnostic::{Diagnostics, Source};
use crate::syntax;

/// A gap by hand may have to be given up once others have moved; so often it is looked again.
const PASSES: usize = 4;

/// The text of a description as it is usually laid out. Names are not looked up: a description may be formatted while it is written.
///
/// # Errors
/// The text cannot be read; what could be made of it would be a guess.
pub fn format(source: &Source) -> Result<String, Diagnostics> {
    let mut found = Diagnostics::new();
    let document = syntax::parse(source, &mut found);
    if document.is_none() || found.has_errors() {
        return Err(found);
    }
    let first_line = source.text.split_inclusive('\n').next();
    let has_carriage_returns = first_line.is_some_and(|line| line.ends_with("\r\n"));
    let mut text = source.text.replace("\r\n", "\n");
    for pass in 1..=PASSES {
        let next = laid_out(&text, pass < PASSES);
        if next == text {
            break;
        }
        text = next;
    }
    Ok(match has_carriage_returns {
        true => text.replace('\n', "\r\n"),
        false => text,
    })
}

/// The text once through all steps.
fn laid_out(text: &str, keeps_number_columns: bool) -> String {
    let pieces = pieces::pieces(text);
    let rows = rows::rows(&pieces);
    let gaps = columns::gaps(&pieces, &rows, keeps_number_columns);
    let mut written = String::with_capacity(text.len());
    for row in &rows {
        if row.blank_before {
            written.push('\n');
        }
        for index in row.pieces.clone() {
            written.extend(std::iter::repeat_n(' ', gaps[index]));
            written.push_str(pieces[index].text);
        }
        written.push('\n');
    }
    written
}
