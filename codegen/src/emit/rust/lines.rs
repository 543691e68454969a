//! Breaks lines of Rust, strings included.

use crate::emit::layout;
use crate::emit::lines::{WIDTH, fits};

/// Returns the lines of a statement, an element or the head of an item at this depth.
pub(super) fn broken(line: &str, depth: usize) -> Vec<String> {
    let lines = layout::broken(line, depth).into_iter();
    lines.flat_map(within_strings).collect()
}

/// Breaks a line within its strings, at spaces: Rust skips the break after a backslash and the spaces that follow.
fn within_strings(line: String) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest = line;
    let depth = rest.len() - rest.trim_start().len();
    while !fits(&rest) {
        let Some(at) = last_space(&rest) else { break };
        let next = format!("{:depth$}{}", "", &rest[at + 1..]);
        rest.truncate(at + 1);
        lines.push(rest + "\\");
        rest = next;
    }
    lines.push(rest);
    lines
}

/// Returns the index of the last space between two words of a string that leaves room for a backslash.
fn last_space(line: &str) -> Option<usize> {
    let quotes = line
        .find('"')
        .filter(|_| line.trim_end().ends_with(['"', ',', ')', ';']));
    let begin = line.len() - line.trim_start().len();
    let begin = quotes.unwrap_or(begin).max(begin);
    let room = line.char_indices().nth(WIDTH - 1)?.0;
    let at = line[..room].rfind(' ')?;
    let is_word = |it: char| it != ' ' && it != '"';
    let between = line[..at].ends_with(is_word) && line[at + 1..].starts_with(is_word);
    let before = line[..at].matches('"').count();
    let is_inside = before % 2 == 1 || (before == 0 && quotes.is_some_and(|it| it > at));
    (at > begin && between && is_inside).then_some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_are_broken_between_words() {
        let text = "word ".repeat(60);
        let line = format!("        \"{}\",", text.trim());
        let lines = within_strings(line.clone());
        assert!(lines.iter().all(|it| fits(it)), "{lines:?}");
        let joined: String = lines
            .iter()
            .map(|it| it.trim_start().trim_end_matches('\\'))
            .collect();
        assert_eq!(joined, line.trim_start());
    }

    #[test]
    fn code_is_not_broken() {
        let line = format!("    let {} = 1.0;", "a".repeat(130));
        assert_eq!(within_strings(line.clone()), [line]);
    }
}
