//! Separates the prose of a source file, comments and string literals, from its code.
//!
//! Lines keep their numbers: line n of each part stands in line n of the file.

/// A line of a source file, taken apart.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Line {
    /// Code, with empty literals in the place of strings.
    pub code: String,
    /// Text of a comment without its marks.
    pub comment: String,
    /// Marks that open the comment: `//`, `///`, `//!` or `/*`; empty without a comment.
    pub marks: &'static str,
    /// Contents of string literals.
    pub strings: String,
}

/// Surroundings of a character.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Code,
    LineComment,
    BlockComment(usize),
    Text,
    /// A raw string that ends with a quote and so many number signs.
    RawText(usize),
}

/// Marks of comments, longest first.
const MARKS: [&str; 4] = ["///", "//!", "//", "/*"];

/// Takes a file of Rust or C apart.
pub fn lines(source: &str) -> Vec<Line> {
    let mut state = State::Code;
    source.lines().map(|line| taken(line, &mut state)).collect()
}

fn taken(line: &str, state: &mut State) -> Line {
    let mut taken = Line::default();
    if let State::BlockComment(_) = state {
        taken.marks = "/*";
    }
    let mut rest = line;
    while let Some(next) = rest.chars().next() {
        let mut length = next.len_utf8();
        match *state {
            State::Code => {
                if let Some(marks) = MARKS.into_iter().find(|it| rest.starts_with(it)) {
                    taken.marks = marks;
                    length = marks.len();
                    *state = match marks {
                        "/*" => State::BlockComment(1),
                        _ => State::LineComment,
                    };
                } else if let Some(signs) = raw_opening(rest, &taken.code) {
                    taken.code.push_str("\"\"");
                    length = 2 + signs;
                    *state = State::RawText(signs);
                } else if let Some(character) = character(rest) {
                    taken.code.push_str("' '");
                    length = character;
                } else if next == '"' {
                    taken.code.push_str("\"\"");
                    *state = State::Text;
                } else {
                    taken.code.push(next);
                }
            }
            State::LineComment => taken.comment.push(next),
            State::BlockComment(depth) => {
                let change = [("/*", depth + 1), ("*/", depth - 1)];
                match change.into_iter().find(|it| rest.starts_with(it.0)) {
                    Some((_, 0)) => (length, *state) = (2, State::Code),
                    Some((_, depth)) => (length, *state) = (2, State::BlockComment(depth)),
                    None => taken.comment.push(next),
                }
            }
            State::Text => match next {
                '"' => {
                    taken.strings.push('\n');
                    *state = State::Code;
                }
                '\\' => length += rest[1..].chars().next().map_or(0, char::len_utf8),
                _ => taken.strings.push(next),
            },
            State::RawText(signs) => match rest.strip_prefix('"') {
                Some(end) if end.starts_with(&"#".repeat(signs)) => {
                    taken.strings.push('\n');
                    length += signs;
                    *state = State::Code;
                }
                _ => taken.strings.push(next),
            },
        }
        rest = &rest[length..];
    }
    if *state == State::LineComment {
        *state = State::Code;
    }
    taken
}

/// Number of number signs of a raw string that begins here; `None` if none does.
fn raw_opening(rest: &str, before: &str) -> Option<usize> {
    let is_name = |it: char| it.is_alphanumeric() || it == '_';
    if before.chars().next_back().is_some_and(is_name) && !before.ends_with('b') {
        return None;
    }
    let signs = rest.strip_prefix('r')?;
    let count = signs.len() - signs.trim_start_matches('#').len();
    signs[count..].starts_with('"').then_some(count)
}

/// Length of a character literal that begins here; `None` for a lifetime and everything else.
fn character(rest: &str) -> Option<usize> {
    let inside = rest.strip_prefix('\'')?;
    if let Some(escaped) = inside.strip_prefix('\\') {
        let skipped = escaped.chars().next()?.len_utf8();
        let end = escaped[skipped..].find('\'')?;
        return Some(2 + skipped + end + 1);
    }
    let width = inside.chars().next()?.len_utf8();
    inside[width..].starts_with('\'').then_some(width + 2)
}
