//! Breaks long code into readable lines.

/// Width of the longest line, which is that of the documentation.
pub(super) const WIDTH: usize = 120;

/// True if a line is short enough.
pub(super) fn fits(line: &str) -> bool {
    line.chars().count() <= WIDTH
}

/// Joins pieces in full lines.
pub(super) fn filled<'a>(pieces: impl IntoIterator<Item = &'a str>, depth: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for piece in pieces {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + piece.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(piece);
            }
            _ => lines.push(format!("{:depth$}{piece}", "")),
        }
    }
    lines
}

/// A long sum, or else a long product, in lines that begin with an operator. A term that is longer than a line breaks once more,
/// between its factors.
pub(super) fn terms(statement: &str, depth: usize) -> Option<Vec<String>> {
    let statement = statement.trim_start();
    between(statement, SUM, depth, depth + 4)
        .or_else(|| between(statement, PRODUCT, depth, depth + 4))
}

const SUM: [&str; 2] = [" + ", " - "];
const PRODUCT: [&str; 2] = [" * ", " / "];

/// Lines broken before these operators, with the indentation of the first one and of the others.
fn between(text: &str, operators: [&str; 2], depth: usize, others: usize) -> Option<Vec<String>> {
    let mut lines: Vec<String> = Vec::new();
    // Text after a term of several lines does not continue the last of them.
    let mut is_open = false;
    for piece in split(text, operators)? {
        let length = piece.chars().count();
        let indent = if lines.is_empty() { depth } else { others };
        match lines.last_mut() {
            Some(line) if is_open && line.chars().count() + 1 + length <= WIDTH => {
                line.push(' ');
                line.push_str(piece);
            }
            _ if indent + length <= WIDTH => {
                lines.push(format!("{:indent$}{piece}", ""));
                is_open = true;
            }
            _ if operators == SUM => {
                lines.extend(between(piece, PRODUCT, indent, others + 4)?);
                is_open = false;
            }
            _ => return None,
        }
    }
    Some(lines)
}

/// Text split before each of these operators outside of all brackets; `None` if there are none.
fn split<'a>(text: &'a str, operators: [&str; 2]) -> Option<Vec<&'a str>> {
    let (mut pieces, mut start, mut open) = (Vec::new(), 0, 0_i32);
    for (place, letter) in text.char_indices() {
        match letter {
            '(' | '[' | '{' => open += 1,
            ')' | ']' | '}' => open -= 1,
            '"' => return None,
            ' ' if open == 0 && operators.iter().any(|it| text[place..].starts_with(it)) => {
                pieces.push(&text[start..place]);
                start = place + 1;
            }
            _ => {}
        }
    }
    pieces.push(&text[start..]);
    (pieces.len() > 1).then_some(pieces)
}
