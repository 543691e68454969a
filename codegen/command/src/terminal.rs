//! Folds text to the width of the terminal.
//!
//! Formulas are broken before an operator or after a comma, sentences also between words. They continue below their beginning. Output
//! to a file or another program is never broken.

use std::io::IsTerminal as _;

use linkwright_codegen::stages::emit::text::shown_width;

/// Smallest width that text is folded to, in columns.
const NARROWEST: usize = 40;

/// Indentation of a continued line from the beginning of its formula.
const HANGING: usize = 2;

/// Part of a line in which the beginning of a formula is sought, after the last gap of two spaces.
const LEFT_HALF: f64 = 0.5;

/// Operators that a line is broken before.
const SIGNS: [&str; 4] = ["+", "-", "−", "="];

/// Returns the width of the terminal that shows stdout, in columns; `None` if stdout is not a terminal.
pub fn columns() -> Option<usize> {
    if !std::io::stdout().is_terminal() {
        return None;
    }
    let (terminal_size::Width(columns), _) = terminal_size::terminal_size()?;
    Some(usize::from(columns).max(NARROWEST))
}

/// Folds the text for the terminal; returns it unchanged if stdout is not a terminal.
pub fn fitted(text: String) -> String {
    match columns() {
        Some(columns) => folded(&text, columns),
        None => text,
    }
}

/// Folds the text to lines of at most `columns` columns, if it has places for a break.
pub fn folded(text: &str, columns: usize) -> String {
    let mut folded = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        fold(line, columns, &mut folded);
    }
    folded
}

fn fold(line: &str, columns: usize, folded: &mut String) {
    let indent = start_of_formula(line, columns) + HANGING;
    let (mut rest, mut room) = (line, columns);
    while shown_width(rest.trim_end()) > room {
        let Some(place) = last_break(rest, room) else {
            break;
        };
        let (now, later) = rest.split_at(place);
        folded.push_str(now.trim_end());
        folded.push('\n');
        folded.push_str(&" ".repeat(indent));
        (rest, room) = (later.trim_start_matches(' '), columns - indent);
    }
    folded.push_str(rest);
}

/// Returns the column after the last gap of two spaces on the left.
fn start_of_formula(line: &str, columns: usize) -> usize {
    let left = (LEFT_HALF * columns as f64) as usize;
    let end = line.char_indices().nth(left).map_or(line.len(), |it| it.0);
    let gap = line[..end].rfind("  ").map_or(0, |place| place + 2);
    shown_width(&line[..gap])
}

/// Returns the last place at which a line fits the room: before an operator or after a comma, otherwise between words.
///
/// If no place is early enough, the first one is returned; `None` if there is none.
fn last_break(line: &str, room: usize) -> Option<usize> {
    let words = line.char_indices().filter(|&(place, character)| {
        let before = line[..place].chars().next_back();
        let last_word = line[..place].split_whitespace().next_back();
        // A sign stays with the word behind it.
        let is_word = last_word.is_some_and(|it| !SIGNS.contains(&it));
        before == Some(' ') && character != ' ' && is_word
    });
    let words: Vec<usize> = words.map(|it| it.0).collect();
    let is_break = |place: &usize| {
        let word = line[*place..].split(' ').next();
        word.is_some_and(|it| SIGNS.contains(&it))
            || line[..*place].trim_end().ends_with([',', ':'])
    };
    let fits = |place: &usize| shown_width(line[..*place].trim_end()) <= room;
    let breaks = || words.iter().copied();
    breaks()
        .rfind(|it| is_break(it) && fits(it))
        .or_else(|| breaks().rfind(fits))
        .or_else(|| breaks().next())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_broken_before_operators_and_hang() {
        let text = "  1  revolute P  x_c1 + cos(phi_c1) - x_c2 + sqrt(3)*cos(phi_c2) - 0.25\nend\n";
        let expected = "  1  revolute P  x_c1 + cos(phi_c1) - x_c2\n                   + sqrt(3)*cos(phi_c2) - 0.25\nend\n";
        assert_eq!(folded(text, 50), expected);
        assert_eq!(folded(text, 200), text);
    }

    #[test]
    fn no_line_is_longer_than_the_terminal_and_nothing_is_lost() {
        let entries = "  1  revolute P  x1: 1,  phi1: -sin(phi1),  x2: -1,  phi2: -sqrt(3)*sin(phi2),  y2: 0.5*cos(phi2) - x2";
        for columns in 40..120 {
            let folded = folded(entries, columns);
            assert!(
                folded.lines().all(|it| shown_width(it) <= columns),
                "{folded}"
            );
            let words = |text: &str| text.split_whitespace().collect::<String>();
            assert_eq!(words(&folded), words(entries));
        }
    }

    #[test]
    fn a_sentence_without_a_comma_is_broken_between_words() {
        let sentence =
            "* is the closest of all; it would be singular where L-G and G-H are collinear";
        assert_eq!(
            folded(sentence, 40),
            "* is the closest of all; it would be\n  singular where L-G and G-H are\n  collinear"
        );
    }

    #[test]
    fn words_without_break_stay_whole() {
        let name = "x".repeat(90);
        assert_eq!(folded(&name, 40), name);
    }
}
