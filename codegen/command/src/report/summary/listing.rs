//! Writes lines of a title and a text, with an aligned second column.

use std::io::{self, Write};

use linkwright_codegen::stages::emit::text::shown_width;

use super::WIDTH;

/// Largest number of lines of a list; the rest of a longer list is left out.
const LINES: usize = 2;

/// Column in which the text begins.
const INDENT: usize = 24;

/// Writes `  title   text` with the second column aligned.
pub(super) fn line(output: &mut dyn Write, title: &str, text: &str) -> io::Result<()> {
    let gap = " ".repeat(INDENT.saturating_sub(2 + shown_width(title)).max(1));
    writeln!(output, "  {title}{gap}{text}")
}

/// Writes a count and the names behind it, wrapped.
pub(super) fn list(
    output: &mut dyn Write,
    title: &str,
    count: usize,
    names: impl Iterator<Item = String>,
) -> io::Result<()> {
    line(output, title, &wrapped(count, names).join("\n"))
}

/// Writes a count and as many of the first names as fit on [`LINES`] lines.
pub(super) fn shortened(
    output: &mut dyn Write,
    title: &str,
    count: usize,
    names: impl Iterator<Item = String>,
) -> io::Result<()> {
    let mut lines = wrapped(count, names);
    if lines.len() > LINES {
        lines.truncate(LINES);
        if let Some(last) = lines.last_mut() {
            last.push_str(" …");
        }
    }
    line(output, title, &lines.join("\n"))
}

/// Returns the lines of a count and the names behind it; all but the first are indented.
fn wrapped(count: usize, names: impl Iterator<Item = String>) -> Vec<String> {
    let mut lines = vec![count.to_string()];
    let mut column = INDENT + lines[0].len();
    for (index, name) in names.enumerate() {
        let separator = if index == 0 { ":" } else { "," };
        let length = name.chars().count() + 1 + separator.len();
        let breaks = column + length > WIDTH && column > INDENT;
        if let Some(last) = lines.last_mut() {
            last.push_str(separator);
            if !breaks {
                last.push(' ');
                last.push_str(&name);
            }
        }
        column += length;
        if breaks {
            lines.push(format!("{}{name}", " ".repeat(INDENT)));
            column = INDENT + name.chars().count();
        }
    }
    lines
}
