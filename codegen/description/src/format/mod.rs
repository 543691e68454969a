//! Formats a description in the usual layout.
//!
//! ```text
//! text ── pieces ──> words, marks and comments ── rows ──> lines and their indentation ── columns ──> gaps between them
//! ```
//! Every statement starts a line, indented by four blanks for each pair of braces with statements around it. Its continuation
//! lines are indented by four more. Words and marks are separated by one blank or none. Comments, line breaks inside a
//! statement, and one of several blank lines are kept. Columns are kept, too: a gap of two or more blanks aligns a piece with a
//! similar piece in the next line.
//!
//! The words, marks and comments of the text and their order are unchanged. Formatting is idempotent. The meaning of statements
//! is not considered.

mod columns;
mod pieces;
mod rows;
mod spacing;
#[cfg(test)]
mod tests;

use crate::diagnostic::{Diagnostics, Source};
use crate::syntax;

/// Maximum number of layout passes: aligning columns may invalidate the gap of another column.
const PASSES: usize = 4;

/// Formats the text of a description. Names are not resolved, so an unfinished description can be formatted.
///
/// # Errors
/// Returns the findings if the text cannot be read: its layout would be a guess.
pub fn format(source: &Source) -> Result<String, Diagnostics> {
    let mut findings = Diagnostics::new();
    let document = syntax::parse(source, &mut findings);
    if document.is_none() || findings.has_errors() {
        return Err(findings);
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

/// Runs all steps on the text once.
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
