//! Renders a finding in the format of rustc.
//!
//! Every marked line appears once, in order, with a row of carets for each mark. A line that is too long for a terminal is cut
//! to a window around its mark. Any span can be printed, as [`Lines`] clamps spans.

use super::source::Lines;
use super::{Diagnostic, Label};

/// Maximum length of a displayed part of a source line, in characters.
const MAX_WIDTH: usize = 120;
/// Number of characters displayed before the mark in a line that is cut.
const BEFORE: usize = 40;
/// Replacement of a tabulator.
const TABULATOR: &str = "    ";
/// Ellipsis of a cut line.
const CUT: &str = "...";

/// A label reduced to one line: from its start to its end, or to the end of that line.
struct Mark<'a> {
    line: usize,
    /// First marked column of the displayed text, counted from 0.
    start: usize,
    /// Column after the last marked one; always greater than `start`.
    end: usize,
    caret: char,
    text: &'a str,
}

/// Renders one finding, ending in a line break.
pub(super) fn one(diagnostic: &Diagnostic, lines: &Lines<'_>) -> String {
    let mut marks = vec![mark(&diagnostic.primary, '^', lines)];
    marks.extend(
        diagnostic
            .secondary
            .iter()
            .map(|label| mark(label, '-', lines)),
    );
    marks.sort_by_key(|mark| (mark.line, mark.start, mark.caret == '-'));

    let position = lines.position(diagnostic.primary.span.start as usize);
    let last = marks.iter().map(|mark| mark.line).max().unwrap_or(1);
    let gutter = last.to_string().len();
    let mut frame = Excerpt {
        text: String::new(),
        gutter,
    };
    frame.text.push_str(&format!(
        "{}[{}]: {}\n",
        diagnostic.severity.word(),
        diagnostic.code,
        diagnostic.message
    ));
    frame.text.push_str(&format!(
        "{:gutter$}--> {}:{}:{}\n",
        "",
        lines.name(),
        position.line,
        position.column
    ));
    frame.row("", "");
    let mut last_shown: Option<usize> = None;
    for group in marks.chunk_by(|one, other| one.line == other.line) {
        let line = group[0].line;
        if last_shown.is_some_and(|previous| previous + 1 < line) {
            frame.text.push_str("...\n");
        }
        frame.line(line, &displayed(lines.text(line)), group);
        last_shown = Some(line);
    }
    if !diagnostic.notes.is_empty() || !diagnostic.help.is_empty() {
        frame.row("", "");
    }
    for note in &diagnostic.notes {
        frame.remark("note", note);
    }
    for help in &diagnostic.help {
        frame.remark("help", help);
    }
    frame.text
}

struct Excerpt {
    text: String,
    gutter: usize,
}

impl Excerpt {
    /// Writes `12 | text`, without trailing blanks.
    fn row(&mut self, number: &str, text: &str) {
        let gutter = self.gutter;
        let row = format!("{number:>gutter$} | {text}");
        self.text.push_str(row.trim_end());
        self.text.push('\n');
    }

    /// Writes `= help: text`, with further lines indented under the first.
    fn remark(&mut self, word: &str, text: &str) {
        let gutter = self.gutter;
        let indent = format!("\n{:gutter$}   {:indent$}", "", "", indent = word.len() + 2);
        let text = text.split('\n').collect::<Vec<_>>().join(&indent);
        self.text
            .push_str(&format!("{:gutter$} = {word}: {text}\n", ""));
    }

    /// Writes a source line with the rows of its marks.
    fn line(&mut self, line: usize, shown: &[char], marks: &[Mark<'_>]) {
        if shown.len() <= MAX_WIDTH {
            self.row(&line.to_string(), &shown.iter().collect::<String>());
            for mark in marks {
                self.carets(mark, mark.start, mark.end);
            }
            return;
        }
        // Marks can be further apart than the window is wide, so each gets its own window.
        for mark in marks {
            let from = mark
                .start
                .saturating_sub(BEFORE)
                .min(shown.len() - MAX_WIDTH);
            let to = (from + MAX_WIDTH).min(shown.len());
            let left = if from > 0 { CUT } else { "" };
            let right = if to < shown.len() { CUT } else { "" };
            let part: String = shown[from..to].iter().collect();
            self.row(&line.to_string(), &format!("{left}{part}{right}"));
            let start = mark.start - from + left.len();
            let end = mark.end.min(to.max(mark.start + 1)) - from + left.len();
            self.carets(mark, start, end);
        }
    }

    fn carets(&mut self, mark: &Mark<'_>, start: usize, end: usize) {
        let carets: String = std::iter::repeat_n(mark.caret, end - start).collect();
        self.row("", &format!("{:start$}{carets} {}", "", mark.text));
    }
}

fn mark<'a>(label: &'a Label, caret: char, lines: &Lines<'_>) -> Mark<'a> {
    let from = lines.position(label.span.start as usize);
    let to = lines.position(label.span.range().end);
    let text = lines.text(from.line);
    let length = text.chars().count();
    let last = if to.line == from.line {
        to.column - 1
    } else {
        length
    };
    let column = |characters: usize| text.chars().take(characters).map(width).sum::<usize>();
    let start = column(from.column - 1);
    // An empty span, or one that starts in the line break, still gets one caret.
    let end = column(last).max(start + 1);
    Mark {
        line: from.line,
        start,
        end,
        caret,
        text: &label.text,
    }
}

fn width(character: char) -> usize {
    if character == '\t' {
        TABULATOR.len()
    } else {
        1
    }
}

/// Returns the displayed characters of a line. Characters that move the cursor or change the writing direction are replaced.
fn displayed(line: &str) -> Vec<char> {
    let mut characters = Vec::new();
    for character in line.chars() {
        match character {
            '\t' => characters.extend(TABULATOR.chars()),
            '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}' => {
                characters.push(char::REPLACEMENT_CHARACTER);
            }
            control if control.is_control() => characters.push(char::REPLACEMENT_CHARACTER),
            other => characters.push(other),
        }
    }
    characters
}

#[cfg(test)]
mod tests {
    use super::super::{Code, Diagnostic, Diagnostics, Source, Span};

    fn at(text: &str, part: &str) -> Span {
        let start = text.find(part).unwrap();
        Span::new(start, start + part.len())
    }

    #[test]
    fn looks_like_rustc() {
        let text = format!("{}    drive phi(1) = sine(2*t);\n", "\n".repeat(11));
        let diagnostic = Diagnostic::error(
            Code::UnknownFunction,
            at(&text, "sine"),
            "unknown function `sine`",
        )
        .label("not a function of this language")
        .help("did you mean `sin`?");
        let mut findings = Diagnostics::new();
        findings.push(diagnostic);
        let expected = "\
error[K13]: unknown function `sine`
  --> mechanisms/arm.mech:12:20
   |
12 |     drive phi(1) = sine(2*t);
   |                    ^^^^ not a function of this language
   |
   = help: did you mean `sin`?

error: 1 error in mechanisms/arm.mech
";
        assert_eq!(
            findings.render(&Source::new("mechanisms/arm.mech", text)),
            expected
        );
    }

    #[test]
    fn marks_on_one_line_and_on_others() {
        let text = "point A = (1, 2);\n\n\tpoint B, A;\nend";
        let again = text.rfind('A').unwrap();
        let diagnostic = Diagnostic::error(
            Code::DuplicateName,
            Span::new(again, again + 1),
            "`A` is declared twice",
        )
        .label("again here")
        .also(at(text, "A"), "first here")
        .also(at(text, "B"), "")
        .note("one\ntwo");
        let expected = "\
error[K12]: `A` is declared twice
 --> a.mech:3:11
  |
1 | point A = (1, 2);
  |       - first here
...
3 |     point B, A;
  |           -
  |              ^ again here
  |
  = note: one
          two
";
        assert_eq!(diagnostic.render(&Source::new("a.mech", text)), expected);
    }

    #[test]
    fn a_span_over_lines_is_marked_to_the_end_of_its_first_line() {
        let text = "ä body {\r\n  A\r\n}\r\n";
        let diagnostic =
            Diagnostic::warning(Code::NoBodies, at(text, "body {\r\n  A\r\n}"), "look");
        let expected = "\
warning[K31]: look
 --> a.mech:1:3
  |
1 | ä body {
  |   ^^^^^^
";
        assert_eq!(diagnostic.render(&Source::new("a.mech", text)), expected);
    }

    #[test]
    fn a_long_line_is_cut_around_the_mark() {
        let text = format!("{}HERE{}", "a+".repeat(200), "+b".repeat(200));
        let rendered = Diagnostic::error(Code::UnknownName, at(&text, "HERE"), "m")
            .render(&Source::new("a", text.clone()));
        let rows: Vec<&str> = rendered.lines().collect();
        assert!(
            rows[3].len() < 140 && rows[3].contains("HERE"),
            "{rendered}"
        );
        assert_eq!(rows[3].find("HERE"), rows[4].find("^^^^"), "{rendered}");
        let everything = Diagnostic::error(Code::UnknownName, Span::new(0, text.len()), "m");
        assert!(
            everything
                .render(&Source::new("a", text))
                .lines()
                .all(|row| row.len() < 140)
        );
    }

    #[test]
    fn any_span_of_any_text_is_printed() {
        for text in [
            "",
            "\n",
            "a",
            "ä\r\n\tü\u{0}\u{202e}",
            "\u{feff}x\r",
            &"é".repeat(300),
        ] {
            let source = Source::new("a", text);
            let length = text.len() as u32;
            for start in (0..=length + 2).chain([u32::MAX]) {
                for end in [0, start, start.saturating_add(1), length, u32::MAX] {
                    let span = Span { start, end };
                    let rendered = Diagnostic::error(Code::UnknownName, span, "m")
                        .also(span, "x")
                        .render(&source);
                    assert!(
                        rendered.contains('^') && rendered.contains("- x"),
                        "{rendered}"
                    );
                }
            }
        }
    }
}
