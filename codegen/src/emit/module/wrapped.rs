//! Breaks lines of prose between words.

/// Longest line of documentation, in characters: as much as a comment has at the depth of a method in a motion's module.
const WIDTH: usize = 104;

/// Space at which no line is broken.
pub(in crate::emit) const JOINED: char = '\u{e000}';

/// Returns lines of at most [`WIDTH`] characters. Words that do not fit begin the next line of their paragraph or list element.
/// Tables and code between fences are not broken.
pub(in crate::emit) fn wrapped<S: AsRef<str>>(lines: impl IntoIterator<Item = S>) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    let mut is_code = false;
    // True if the last line has words of a longer one, which the next line of the paragraph continues.
    let mut is_open = false;
    for line in lines {
        let line = line.as_ref();
        let is_fence = line.trim_start().starts_with("```");
        if is_code || is_fence || is_row(line) {
            is_code ^= is_fence;
            is_open = false;
            all.push(line.to_string());
            continue;
        }
        let continues = is_open && is_prose(line);
        let indent = indentation(all.last().filter(|_| continues).map_or(line, |it| it));
        let mut rest = match continues {
            true => format!("{} {}", all.pop().unwrap_or_default(), line.trim_start()),
            false => line.to_string(),
        };
        is_open = continues;
        while let Some(at) = break_of(&rest, indent) {
            let next = format!("{:indent$}{}", "", rest[at..].trim_start());
            rest.truncate(at);
            all.push(std::mem::replace(&mut rest, next));
            is_open = true;
        }
        all.push(rest);
    }
    all.iter().map(|line| line.replace(JOINED, " ")).collect()
}

/// Returns the index of the space at which a line is broken; `None` if the line fits or has no such space.
fn break_of(line: &str, indent: usize) -> Option<usize> {
    let end = line.char_indices().nth(WIDTH)?.0;
    let first = indent.max(2);
    let end = end + usize::from(line[end..].starts_with(' '));
    let breaks = |at: &usize| *at > first && !begins_block(line[*at..].trim_start());
    let mut before = line[..end].rmatch_indices(' ').map(|it| it.0);
    let mut after = line[end..].match_indices(' ').map(|it| end + it.0);
    before.find(breaks).or_else(|| after.find(breaks))
}

/// True if Markdown reads a line that begins with this text as a list, a heading or a quotation, even within code.
fn begins_block(text: &str) -> bool {
    let digits = text.trim_start_matches(|it: char| it.is_ascii_digit());
    let is_number =
        digits.len() < text.len() && (digits.starts_with(". ") || digits.starts_with(") "));
    let marks = ["- ", "* ", "+ ", "#", ">", "```"];
    is_number || marks.iter().any(|it| text.starts_with(it))
}

/// True if a line is the row of a table.
fn is_row(line: &str) -> bool {
    let line = line.trim();
    line.starts_with("| ") && line.ends_with('|')
}

/// True if a line continues a paragraph.
fn is_prose(line: &str) -> bool {
    let text = line.trim_start();
    !text.is_empty() && line.len() - text.len() < 4 && !begins_block(text)
}

/// Returns the depth of the lines that continue a line.
fn indentation(line: &str) -> usize {
    let text = line.trim_start();
    let depth = line.len() - text.len();
    match text.starts_with("- ") || text.starts_with("* ") {
        true => depth + 2,
        false => depth,
    }
}

#[cfg(test)]
mod tests {
    use super::{WIDTH, wrapped};

    #[test]
    fn short_lines_stay_as_they_are() {
        let lines = ["One line.", "", "- An element", "  of a list."];
        assert_eq!(wrapped(lines), lines);
    }

    #[test]
    fn words_begin_the_next_line_of_their_paragraph() {
        let long = "word ".repeat(25);
        let lines = wrapped([long.trim(), "and others.", "", "Next."]);
        assert_eq!(lines[0].len(), "word ".repeat(20).len() + 4);
        assert_eq!(lines[1..], ["word word word word and others.", "", "Next."]);
    }

    #[test]
    fn elements_of_lists_are_indented() {
        let long = format!("- 1: `{}`", "alpha + ".repeat(30).trim_end());
        let lines = wrapped([long.as_str(), "- 2"]);
        assert!(lines.iter().all(|it| it.chars().count() <= WIDTH));
        assert!(lines[1].starts_with("  alpha"));
        assert_eq!(lines.last().map(String::as_str), Some("- 2"));
    }

    #[test]
    fn letters_beyond_ascii_count_once() {
        let long = "φ̇ × ÄÖÜ ".repeat(30);
        assert!(wrapped([long]).iter().all(|it| it.chars().count() <= WIDTH));
    }

    #[test]
    fn tables_and_code_are_not_broken() {
        let row = format!("| {} |", "cell ".repeat(40));
        let lines = ["```".to_string(), "x ".repeat(100), "```".to_string(), row];
        assert_eq!(wrapped(&lines), lines);
    }
}
