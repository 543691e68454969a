//! Lines of code that are too long → lines as a person breaks them.
//!
//! What fits into a line stays on it. Brackets break around their elements: short ones fill the lines of a list, others have a line
//! each. Sums and products break before their operators. Nothing but spaces and commas after last elements is added or left out.

use crate::emit::lines::{filled, fits};

/// Elements up to this length share a line with others, with their commas.
const SHORT: usize = 36;

const SUM: [&str; 2] = [" + ", " - "];
const PRODUCT: [&str; 2] = [" * ", " / "];

/// Lines of a statement, an element or the head of an item that begins so deep.
pub(super) fn broken(line: &str, depth: usize) -> Vec<String> {
    let whole = format!("{:depth$}{line}", "");
    if is_short(&whole) {
        return vec![whole];
    }
    let mut ends = ["?;", ";", ",", " {"].into_iter();
    let end = ends.find(|end| line.ends_with(end)).unwrap_or("");
    let text = &line[..line.len() - end.len()];
    let mut lines = Vec::new();
    let elements = parts(text, ", ");
    if end == "," && elements.len() > 1 {
        let elements: Vec<String> = elements.iter().map(|it| format!("{it},")).collect();
        return filled(elements.iter().map(String::as_str), depth);
    }
    let value = text.find(" = ").map_or(0, |at| at + 3);
    let value = match text[value..].starts_with("if ") || text[value..].starts_with("{ ") {
        true => value,
        false => 0,
    };
    let (before, text) = text.split_at(value);
    Part {
        before: before.to_string(),
        text,
        after: end.to_string(),
    }
    .lay([depth, depth + 4], &mut lines);
    lines
}

/// A text that may be broken, and what stands before and after it on its first and last line.
struct Part<'a> {
    before: String,
    text: &'a str,
    after: String,
}

impl Part<'_> {
    /// Adds the lines: the first so deep, and the others.
    fn lay(&self, depths: [usize; 2], lines: &mut Vec<String>) {
        let Part {
            before,
            text,
            after,
        } = self;
        let first = depths[0];
        let whole = format!("{:first$}{before}{text}{after}", "");
        if is_short(&whole) {
            lines.push(whole);
        } else if text.starts_with("if ") && text.contains("} else ") {
            self.choice(first, lines);
        } else if let Some(pieces) = operands(text) {
            self.operation(&pieces, depths, lines);
        } else if text.starts_with("{ ") {
            self.block(first, lines);
        } else if let Some((at, _)) = outer(text).find(|(at, _)| text[*at..].starts_with(").")) {
            self.chain(at + 1, first, lines);
        } else if !self.brackets(depths, lines) {
            lines.push(whole);
        }
    }

    /// A call, and what is called on its value.
    fn chain(&self, at: usize, depth: usize, lines: &mut Vec<String>) {
        let (call, method) = self.text.split_at(at);
        let part = |before: &str, text, after: &str| Part {
            before: before.to_string(),
            text,
            after: after.to_string(),
        };
        let start = lines.len();
        part(&self.before, call, "").lay([depth, depth + 4], lines);
        let depth = if lines.len() > start + 1 {
            depth
        } else {
            depth + 4
        };
        part("", method, &self.after).lay([depth, depth + 4], lines);
    }

    /// Terms or factors in lines that they fill.
    fn operation(&self, pieces: &[&str], [first, others]: [usize; 2], lines: &mut Vec<String>) {
        // What follows a term of several lines does not continue the last of them.
        let mut is_open = false;
        for (place, text) in pieces.iter().enumerate() {
            let is_last = place + 1 == pieces.len();
            let part = Part {
                before: if place == 0 {
                    self.before.clone()
                } else {
                    String::new()
                },
                text,
                after: if is_last {
                    self.after.clone()
                } else {
                    String::new()
                },
            };
            let whole = format!("{}{text}{}", part.before, part.after);
            let indent = if place == 0 { first } else { others };
            match lines.last_mut() {
                Some(line) if is_open && is_short(&format!("{line} {whole}")) => {
                    *line += &format!(" {whole}");
                }
                _ => {
                    is_open = is_short(&format!("{:indent$}{whole}", ""));
                    part.lay([indent, others + 4], lines);
                }
            }
        }
    }

    /// `if … { … } else { … }` with its arms in lines of their own.
    fn choice(&self, depth: usize, lines: &mut Vec<String>) {
        let (mut before, mut rest) = (self.before.clone(), self.text);
        while let Some(group) = groups(rest).into_iter().find(|it| it.opens(rest, '{')) {
            let condition = rest[..group.start].trim_end();
            let words = ["if ", "else if ", "else"].into_iter();
            let word = words
                .filter(|it| condition.starts_with(it))
                .max_by_key(|it| it.len());
            let word = word.unwrap_or("");
            let head = Part {
                before: before + word,
                text: &condition[word.len()..],
                after: " {".to_string(),
            };
            head.lay([depth, depth + 4], lines);
            let arm = Part::of(rest[group.start + 1..group.end].trim());
            arm.lay([depth + 4, depth + 8], lines);
            (before, rest) = ("} ".to_string(), rest[group.end + 1..].trim_start());
            if !rest.starts_with("else") {
                break;
            }
        }
        let space = if rest.is_empty() { "" } else { " " };
        lines.push(format!("{:depth$}}}{space}{rest}{}", "", self.after));
    }

    /// Statements between braces that end with a value.
    fn block(&self, depth: usize, lines: &mut Vec<String>) {
        lines.push(format!("{:depth$}{}{{", "", self.before));
        let statements = parts(self.text[1..self.text.len() - 1].trim(), "; ");
        for (place, statement) in statements.iter().enumerate() {
            let end = if place + 1 < statements.len() {
                ";"
            } else {
                ""
            };
            lines.extend(broken(&format!("{statement}{end}"), depth + 4));
        }
        lines.push(format!("{:depth$}}}{}", "", self.after));
    }

    /// What is in the brackets that hold most; false if there are none.
    fn brackets(&self, depths: [usize; 2], lines: &mut Vec<String>) -> bool {
        let Part {
            before,
            text,
            after,
        } = self;
        let [first, inside] = [depths[0], depths[0] + 4];
        let is_function = text.starts_with("fn ") || text.starts_with("pub fn ");
        let all = groups(text);
        let widest = match is_function {
            true => all.first(),
            false => all.iter().rev().max_by_key(|it| it.end - it.start),
        };
        let Some(group) = widest.filter(|it| it.end > it.start + 1) else {
            return false;
        };
        let (start, end) = (&text[..=group.start], &text[group.end..]);
        let inner = text[group.start + 1..group.end].trim();
        let elements = parts(inner, ", ");
        let is_alone = elements.len() == 1;
        let is_bare = start.trim_end_matches('(').ends_with([' ', '-']) || start == "(";
        if is_alone && (is_call(inner) || is_bare) {
            let part = Part {
                before: format!("{before}{start}"),
                text: inner,
                after: format!("{end}{after}"),
            };
            part.lay(depths, lines);
            return true;
        }
        lines.push(format!("{:first$}{before}{start}", ""));
        let is_repeated = parts(inner, "; ").len() > 1;
        let elements = elements.iter().map(|element| match *element {
            ".." => "..".to_string(),
            _ if is_repeated => element.to_string(),
            _ => format!("{element},"),
        });
        let elements: Vec<String> = elements.collect();
        if start.ends_with('[') && elements.iter().all(|it| it.len() <= SHORT) {
            lines.extend(filled(elements.iter().map(String::as_str), inside));
        } else {
            elements
                .iter()
                .for_each(|it| lines.extend(element(it, inside)));
        }
        lines.push(format!("{:first$}{end}{after}", ""));
        true
    }
}

impl<'a> Part<'a> {
    fn of(text: &'a str) -> Part<'a> {
        Part {
            before: String::new(),
            text,
            after: String::new(),
        }
    }
}

/// Lines of an element, which ends with its comma.
fn element(element: &str, depth: usize) -> Vec<String> {
    let (text, end) = match element.strip_suffix(',') {
        Some(text) => (text, ","),
        None => (element, ""),
    };
    let value = text.find(": if ").map_or(0, |at| at + 2);
    let part = Part {
        before: text[..value].to_string(),
        text: &text[value..],
        after: end.to_string(),
    };
    let mut lines = Vec::new();
    part.lay([depth, depth + 4], &mut lines);
    lines
}

/// True for what stands on one line. The arms of a choice have lines of their own.
fn is_short(line: &str) -> bool {
    fits(line)
        && !line
            .trim_start()
            .trim_start_matches("} else ")
            .contains("} else ")
}

/// True for a call, a list or a structure.
fn is_call(text: &str) -> bool {
    text.ends_with([')', ']', '}']) && !text.starts_with("if ") && operands(text).is_none()
}

/// Terms, or else factors, with the operators before them; `None` if there is one alone.
fn operands(text: &str) -> Option<Vec<&str>> {
    let pieces = [SUM, PRODUCT].map(|operators| {
        let starts =
            outer(text).filter(|(at, _)| operators.iter().any(|it| text[*at..].starts_with(it)));
        let mut start = 0;
        let mut pieces: Vec<&str> = Vec::new();
        for (at, _) in starts {
            pieces.push(&text[start..at]);
            start = at + 1;
        }
        pieces.push(&text[start..]);
        pieces
    });
    pieces.into_iter().find(|it| it.len() > 1)
}

/// What separators outside of all brackets part.
fn parts<'a>(text: &'a str, separator: &str) -> Vec<&'a str> {
    let (mut found, mut start) = (Vec::new(), 0);
    for (at, _) in outer(text) {
        if text[at..].starts_with(separator) {
            found.push(&text[start..at]);
            start = at + separator.len();
        }
    }
    found.push(text[start..].trim_end_matches(','));
    found
}

/// Brackets outside of all others: where they open and close.
#[derive(Clone, Copy)]
struct Group {
    start: usize,
    end: usize,
}

impl Group {
    fn opens(self, text: &str, bracket: char) -> bool {
        text[self.start..].starts_with(bracket)
    }
}

fn groups(text: &str) -> Vec<Group> {
    let mut found = Vec::new();
    let mut start = None;
    for (at, letter) in outer(text) {
        match (letter, start) {
            ('(' | '[' | '{', None) => start = Some(at),
            (')' | ']' | '}', Some(open)) => {
                found.push(Group {
                    start: open,
                    end: at,
                });
                start = None;
            }
            _ => {}
        }
    }
    found
}

/// The letters that stand outside of all brackets and strings, with the outermost brackets.
fn outer(text: &str) -> impl Iterator<Item = (usize, char)> {
    let (mut open, mut is_string, mut is_escaped, mut before) = (0_i32, false, false, ' ');
    text.char_indices().filter(move |&(at, letter)| {
        if is_string {
            is_string = is_escaped || letter != '"';
            is_escaped = !is_escaped && letter == '\\';
            return false;
        }
        let follows = text[at + letter.len_utf8()..].chars().next();
        let change = match letter {
            '(' | '[' | '{' => 1,
            ')' | ']' | '}' => -1,
            // As in `Matrix<2, 3>`: signs of comparison have spaces around them.
            '<' if before != ' ' => 1,
            '>' if before != ' ' && before != '-' && follows != Some('=') => -1,
            _ => 0,
        };
        is_string = letter == '"';
        before = letter;
        let is_outside = open + change.min(0) == 0;
        open += change;
        is_outside && !is_string
    })
}

#[cfg(test)]
mod tests {
    use super::broken;

    /// Lines of a statement eight deep.
    fn lines(statement: &str) -> String {
        let lines = broken(statement, 8);
        let content = |text: &str| text.replace([' ', '\n', ','], "");
        assert_eq!(content(&lines.concat()), content(statement));
        lines.join("\n")
    }

    #[test]
    fn what_fits_into_a_line_stays_on_it() {
        let statement = "let a = f([1.0, 2.0], b)?;";
        assert_eq!(lines(statement), format!("        {statement}"));
    }

    #[test]
    fn elements_of_brackets_have_lines_of_their_own() {
        let long = "a_long_name * another_long_name_of_a_value";
        assert_eq!(
            lines(&format!("return Err(no({long}, {long}, {long}));")),
            format!(
                "        return Err(no(\n            {long},\n            {long},\n            {long},\n        ));"
            )
        );
        assert_eq!(
            lines(&format!("fn f({long}: A, {long}: B<2, 3>) -> C<1, 2> {{")),
            format!(
                "        fn f(\n            {long}: A,\n            {long}: B<2, 3>,\n        ) -> C<1, 2> {{"
            )
        );
    }

    #[test]
    fn short_elements_fill_their_lines() {
        let [full, rest] =
            [18, 4].map(|count| format!("            {}\n", vec!["1.25,"; count].join(" ")));
        assert_eq!(
            lines(&format!("let x = [{}];", ["1.25"; 40].join(", "))),
            format!("        let x = [\n{full}{full}{rest}        ];")
        );
    }

    #[test]
    fn a_sum_breaks_outside_of_brackets() {
        let term = "alpha * (beta - gamma)";
        assert_eq!(
            lines(&format!("let x = {};", [term; 6].join(" + "))),
            format!(
                "        let x = {}\n            + {term} + {term};",
                [term; 4].join(" + ")
            )
        );
    }

    #[test]
    fn a_factor_that_is_longer_than_a_line_breaks_in_its_brackets() {
        let term = "alpha * (beta - gamma)";
        let sum = [term; 6].join(" + ");
        assert_eq!(
            lines(&format!("let x = ({sum}) * delta;")),
            format!(
                "        let x = ({}\n                + {term} + {term})\n            * delta;",
                [term; 4].join(" + ")
            )
        );
    }

    #[test]
    fn arms_of_a_choice_have_lines_of_their_own() {
        assert_eq!(
            lines("let a = if b < c + d { -1.0 } else if e > 0.0 { f(g, h) } else { 2.0 };"),
            "        let a = if b < c + d {\n            -1.0\n        } else if e > 0.0 {\n            f(g, h)\n        } else {\n            2.0\n        };"
        );
        assert_eq!(
            lines("at.a = 2.0 * (if b < c { d } else { e }) * f;"),
            "        at.a = 2.0\n            * (if b < c {\n                d\n            } else {\n                e\n            })\n            * f;"
        );
    }

    #[test]
    fn brackets_and_commas_in_strings_are_text() {
        let (words, others) = (
            "joined at A, B (and C), \\\"D\\\"".repeat(4),
            "w, ".repeat(30),
        );
        assert_eq!(
            lines(&format!("BlockName::new(\"{words}\", \"{others}\"),")),
            format!(
                "        BlockName::new(\n            \"{words}\",\n            \"{others}\",\n        ),"
            )
        );
    }

    #[test]
    fn steps_of_a_long_chain_are_statements() {
        let sum = ["a_term_of_a_sum"; 5].join(" + ");
        assert_eq!(
            lines(&format!("let x = {{ let partial = {sum}; partial + b }};")),
            format!(
                "        let x = {{\n            let partial = {sum};\n            partial + b\n        }};"
            )
        );
    }
}
