//! Breaks statements of C that exceed a line.
//!
//! A sum has one term per line. Products, arguments and elements fill their lines. Outer brackets break before inner ones.

use crate::emit::lines::{WIDTH, fits};

/// Break before or after an operator.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Before ` + ` or ` - `: a line for each term.
    Sum,
    /// Before ` && `, ` || `, ` ? `, ` : `, ` >= ` or ` < `.
    Choice,
    /// After a comma.
    Comma,
    /// Before ` * ` or ` / `.
    Product,
    /// After an opening bracket or before ` = `.
    Opening,
}

const KINDS: [Kind; 5] = [
    Kind::Choice,
    Kind::Sum,
    Kind::Comma,
    Kind::Product,
    Kind::Opening,
];

const SUM: [&str; 2] = [" + ", " - "];
const PRODUCT: [&str; 2] = [" * ", " / "];
const CHOICE: [&str; 7] = [" && ", " || ", " ? ", " : ", " >= ", " < ", " > "];

/// Returns the lines of a statement that begins at this depth.
pub(super) fn broken(statement: &str, depth: usize) -> Vec<String> {
    let line = format!("{:depth$}{statement}", "");
    if fits(&line) {
        return vec![line];
    }
    let deepest = statement.matches(['(', '[', '{']).count();
    for level in 0..=deepest {
        for kind in KINDS {
            let pieces = pieces(statement, level, kind);
            // The first piece fits, so the break helps.
            let helps = pieces.len() > 1 && pieces[0].len() + depth <= WIDTH;
            if helps {
                return filled(&pieces, kind, depth);
            }
        }
    }
    match in_string(statement, depth) {
        Some([first, rest]) => {
            let mut lines = vec![first];
            lines.extend(broken(&rest, depth));
            lines
        }
        None => vec![line],
    }
}

fn filled(pieces: &[&str], kind: Kind, depth: usize) -> Vec<String> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    for piece in pieces {
        let fills = kind != Kind::Sum;
        match lines.last_mut() {
            Some((depth, line)) if fills && *depth + line.len() + 1 + piece.len() <= WIDTH => {
                line.push(' ');
                line.push_str(piece);
            }
            _ => {
                let indent = if lines.is_empty() { depth } else { depth + 4 };
                lines.push((indent, piece.to_string()));
            }
        }
    }
    let lines = lines.into_iter();
    lines
        .flat_map(|(depth, line)| broken(&line, depth))
        .collect()
}

/// Returns the pieces between the breaks of a kind that `level` brackets enclose.
fn pieces(statement: &str, level: usize, kind: Kind) -> Vec<&str> {
    let (mut pieces, mut start, mut open) = (Vec::new(), 0, 0_usize);
    let (mut is_string, mut is_escaped) = (false, false);
    for (at, letter) in statement.char_indices() {
        if is_string {
            is_string = letter != '"' || is_escaped;
            is_escaped = letter == '\\' && !is_escaped;
            continue;
        }
        let rest = &statement[at..];
        let starts = |operators: &[&str]| operators.iter().any(|it| rest.starts_with(it));
        let is_level = open == level;
        let break_at = match kind {
            Kind::Sum => (is_level && starts(&SUM)).then_some(at),
            Kind::Choice => (is_level && starts(&CHOICE)).then_some(at),
            Kind::Product => (is_level && starts(&PRODUCT)).then_some(at),
            Kind::Comma => (is_level && rest.starts_with(", ")).then_some(at + 1),
            Kind::Opening => {
                (is_level && rest.starts_with(" = ") && !rest.starts_with(" = {")).then_some(at + 2)
            }
        };
        if let Some(place) = break_at {
            pieces.push(statement[start..place].trim_start());
            start = place;
        }
        match letter {
            '(' | '[' | '{' => open += 1,
            ')' | ']' | '}' => open = open.saturating_sub(1),
            '"' => is_string = true,
            _ => {}
        }
    }
    pieces.push(statement[start..].trim_start());
    pieces
}

/// Returns a statement in two parts, of which the first ends within a string; C joins both strings.
fn in_string(statement: &str, depth: usize) -> Option<[String; 2]> {
    let begin = statement.find('"')?;
    let room = WIDTH.checked_sub(depth + 1)?;
    let part = statement.get(..room)?;
    let at = part.rfind(' ').filter(|at| *at > begin + 1)?;
    let (first, rest) = statement.split_at(at + 1);
    Some([format!("{:depth$}{first}\"", ""), format!("\"{rest}")])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_has_a_line_for_each_term() {
        let term = "alpha * (beta - gamma)";
        let sum = format!("const double x = {}", [term; 6].join(" + "));
        let lines = broken(&format!("{sum};"), 4);
        assert_eq!(lines.len(), 6);
        assert_eq!(lines[0], format!("    const double x = {term}"));
        assert_eq!(lines[5], format!("        + {term};"));
    }

    #[test]
    fn outer_brackets_break_before_inner_ones() {
        let call = format!(
            "return f({}, g(a, b));",
            "argument_of_some_length, ".repeat(5).trim_end_matches(", ")
        );
        let lines = broken(&call, 4);
        assert!(lines.iter().all(|it| it.len() <= WIDTH), "{lines:?}");
        assert_eq!(lines.last().map(|it| it.trim()), Some("g(a, b));"));
        let nested = format!(
            "x = y * (z * (w + {}));",
            "a_value_of_some_length + "
                .repeat(6)
                .trim_end_matches(" + ")
        );
        assert!(broken(&nested, 8).iter().all(|it| it.len() <= WIDTH));
    }

    #[test]
    fn strings_are_joined_by_c() {
        let words = "word ".repeat(40);
        let lines = broken(&format!("{{\"{}\", \"\"}},", words.trim()), 4);
        assert!(lines.iter().all(|it| it.len() <= WIDTH), "{lines:?}");
        assert!(lines[0].ends_with(" \"") && lines[1].starts_with("    \"word"));
    }
}
