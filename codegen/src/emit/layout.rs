//! Breaks lines of code that are too long.
//!
//! Code that fits into a line stays on it. Lists break between their elements: short ones fill the lines, others have a line each.
//! Sums have a line for each term, products break before their operators. Spaces and commas after last elements are all that changes.

use super::lines::{WIDTH, filled, fits};

/// Lists in brackets of a language.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Lists {
    /// Elements stand between the lines of their brackets, and the last one has a comma.
    Apart,
    /// Elements continue the line of their opening bracket.
    Filled,
}

/// Longest element, with its comma, that shares a line with others.
const SHARED_LENGTH: usize = 36;

/// Operators that a line breaks before, those that bind least first.
const OPERATORS: [&[&str]; 3] = [
    &[" && ", " || ", " ? ", " : ", " >= ", " < ", " > "],
    SUM,
    &[" * ", " / "],
];

const SUM: &[&str] = &[" + ", " - "];

/// Lines of a statement, an element or the head of an item that begins so deep.
pub(super) fn broken(line: &str, depth: usize, lists: Lists) -> Vec<String> {
    let whole = format!("{:depth$}{line}", "");
    if is_short(&whole) {
        return vec![whole];
    }
    let mut ends = ["?;", ";", ",", " {"].into_iter();
    let end = ends.find(|end| line.ends_with(end)).unwrap_or("");
    let text = &line[..line.len() - end.len()];
    let elements = parts(text, ", ");
    if end == "," && elements.len() > 1 {
        let elements: Vec<String> = elements.iter().map(|it| format!("{it},")).collect();
        return filled(elements.iter().map(String::as_str), depth);
    }
    // A choice or a block that is a value.
    let value = outer(text).find_map(|(at, _)| {
        let value = [" = ", ": "]
            .iter()
            .find_map(|it| text[at..].strip_prefix(it))?;
        let is_open = ["if ", "{ "].iter().any(|it| value.starts_with(it));
        is_open.then_some(text.len() - value.len())
    });
    let (before, text) = text.split_at(value.unwrap_or(0));
    let all = Vec::new();
    let mut lines = Lines { all, lists };
    lines.lay(&part(before, text, end), [depth, depth + 4]);
    lines.all
}

/// A text that may be broken, and what stands before it on its first line and after it on its last one.
struct Part<'a> {
    before: String,
    text: &'a str,
    after: String,
}

fn part(before: impl Into<String>, text: &str, after: impl Into<String>) -> Part<'_> {
    let (before, after) = (before.into(), after.into());
    Part {
        before,
        text,
        after,
    }
}

struct Lines {
    all: Vec<String>,
    lists: Lists,
}

impl Lines {
    /// Adds the lines of a part: the first so deep, and those that continue it.
    fn lay(&mut self, part: &Part<'_>, depths: [usize; 2]) {
        let (depth, text) = (depths[0], part.text);
        let whole = format!("{:depth$}{}{text}{}", "", part.before, part.after);
        if is_short(&whole) {
            self.all.push(whole);
        } else if text.starts_with("if ") && text.contains("} else ") {
            self.choice(part, depth);
        } else if let Some((pieces, fills)) = operands(text) {
            self.pieces(part, &pieces, fills, depths);
        } else if text.starts_with("{ ") {
            self.block(part, depth);
        } else if let Some((at, _)) = outer(text).find(|(at, _)| text[*at..].starts_with(").")) {
            self.chain(part, at + 1, depth);
        } else if !self.brackets(part, depths) {
            let equals = outer(text).find(|(at, _)| text[*at..].starts_with(" = "));
            match equals.map(|(at, _)| text.split_at(at + " =".len())) {
                Some((head, value)) => {
                    self.all.push(format!("{:depth$}{}{head}", "", part.before));
                    let value = self::part("", value.trim_start(), &*part.after);
                    self.lay(&value, [depths[1], depths[1] + 4]);
                }
                None => self.string(part, depth),
            }
        }
    }

    /// Adds pieces of a text, each on a line of its own or as many as fit.
    fn pieces(&mut self, whole: &Part<'_>, pieces: &[&str], fills: bool, depths: [usize; 2]) {
        let [first, others] = depths;
        // A piece does not continue the last line of a piece of several lines.
        let mut is_open = false;
        for (place, text) in pieces.iter().enumerate() {
            let is_last = place + 1 == pieces.len();
            let after = if is_last { &*whole.after } else { "" };
            let (before, depth) = match place {
                0 => (&*whole.before, first),
                _ => ("", others),
            };
            let line = format!("{before}{text}{after}");
            match self.all.last_mut() {
                Some(open) if is_open && is_short(&format!("{open} {line}")) => {
                    *open += &format!(" {line}");
                }
                _ => {
                    is_open = fills && is_short(&format!("{:depth$}{line}", ""));
                    self.lay(&part(before, text, after), [depth, others + 4]);
                }
            }
        }
    }

    /// Adds `if … { … } else { … }` with its arms in lines of their own.
    fn choice(&mut self, whole: &Part<'_>, depth: usize) {
        let (mut before, mut rest) = (whole.before.clone(), whole.text);
        while let Some([start, end]) = groups(rest)
            .into_iter()
            .find(|it| rest[it[0]..].starts_with('{'))
        {
            let condition = rest[..start].trim_end();
            let mut words = ["else if ", "else", "if "].into_iter();
            let word = words.find(|it| condition.starts_with(it)).unwrap_or("");
            let head = part(before + word, &condition[word.len()..], " {");
            self.lay(&head, [depth, depth + 4]);
            let arm = part("", rest[start + 1..end].trim(), "");
            self.lay(&arm, [depth + 4, depth + 8]);
            (before, rest) = ("} ".to_string(), rest[end + 1..].trim_start());
            if !rest.starts_with("else") {
                break;
            }
        }
        let space = if rest.is_empty() { "" } else { " " };
        self.all
            .push(format!("{:depth$}}}{space}{rest}{}", "", whole.after));
    }

    /// Adds statements between braces that end with a value.
    fn block(&mut self, whole: &Part<'_>, depth: usize) {
        self.all.push(format!("{:depth$}{}{{", "", whole.before));
        let statements = parts(whole.text[1..whole.text.len() - 1].trim(), "; ");
        for (place, statement) in statements.iter().enumerate() {
            let end = if place + 1 < statements.len() {
                ";"
            } else {
                ""
            };
            self.all
                .extend(broken(&format!("{statement}{end}"), depth + 4, self.lists));
        }
        self.all.push(format!("{:depth$}}}{}", "", whole.after));
    }

    /// Adds a call, and what is called on its value.
    fn chain(&mut self, whole: &Part<'_>, at: usize, depth: usize) {
        let (call, method) = whole.text.split_at(at);
        let start = self.all.len();
        self.lay(&part(&*whole.before, call, ""), [depth, depth + 4]);
        let is_one_line = self.all.len() == start + 1;
        let depth = if is_one_line { depth + 4 } else { depth };
        self.lay(&part("", method, &*whole.after), [depth, depth + 4]);
    }

    /// Adds what is in the brackets that hold most; returns false if there are none.
    fn brackets(&mut self, whole: &Part<'_>, depths: [usize; 2]) -> bool {
        let Part {
            before,
            text,
            after,
        } = whole;
        let (depth, inside) = (depths[0], depths[0] + 4);
        let all = groups(text);
        let heads = ["fn ", "pub fn ", "pub(super) fn "];
        let widest = match heads.iter().any(|it| text.starts_with(it)) {
            true => all.get(usize::from(text.starts_with("pub("))),
            false => all.iter().rev().max_by_key(|[start, end]| end - start),
        };
        let Some([start, end]) = widest.filter(|[start, end]| *end > start + 1) else {
            return false;
        };
        let (open, inner, close) = (
            &text[..=*start],
            text[start + 1..*end].trim(),
            &text[*end..],
        );
        let elements = parts(inner, ", ");
        let is_bare = open == "(" || open.ends_with(" (") || open.ends_with("-(");
        let is_filled = self.lists == Lists::Filled;
        let alone = part(format!("{before}{open}"), inner, format!("{close}{after}"));
        if elements.len() == 1 && (is_filled || is_bare || is_call(inner)) {
            let breaks = operands(inner).is_some() || !groups(inner).is_empty();
            if breaks {
                self.lay(&alone, depths);
            }
            return breaks;
        }
        let is_repeated = parts(inner, "; ").len() > 1;
        let last = elements.len() - usize::from(is_filled || is_repeated);
        let elements = elements.iter().enumerate();
        let elements = elements.map(|(place, element)| match place < last && *element != ".." {
            true => format!("{element},"),
            false => element.to_string(),
        });
        let elements: Vec<String> = elements.collect();
        let texts: Vec<&str> = elements.iter().map(String::as_str).collect();
        let head = format!("{:depth$}{before}{open}", "");
        if is_filled && is_short(&format!("{head}{}", texts[0])) {
            self.pieces(&alone, &texts, true, depths);
            return true;
        }
        self.all.push(head);
        if is_filled {
            let rest = part("", inner, format!("{close}{after}"));
            self.pieces(&rest, &texts, true, [inside; 2]);
            return true;
        }
        if open.ends_with('[') && elements.iter().all(|it| it.len() <= SHARED_LENGTH) {
            self.all.extend(filled(texts, inside));
        } else {
            texts
                .iter()
                .for_each(|it| self.all.extend(broken(it, inside, self.lists)));
        }
        self.all.push(format!("{:depth$}{close}{after}", ""));
        true
    }

    /// Adds a string in parts that the language joins. They end with spaces between words.
    fn string(&mut self, whole: &Part<'_>, depth: usize) {
        let (end, begin) = match self.lists {
            Lists::Apart => ("\\", ""),
            Lists::Filled => ("\"", "\""),
        };
        let mut rest = format!("{}{}{}", whole.before, whole.text, whole.after);
        while whole.text.starts_with('"') && !fits(&format!("{:depth$}{rest}", "")) {
            let room = rest.char_indices().nth(WIDTH - depth - 1);
            let start = room.map_or(&*rest, |(at, _)| &rest[..at]);
            let mut spaces = start.match_indices(' ').map(|(at, _)| at + 1);
            let Some(at) = spaces.rfind(|at| !rest[*at..].starts_with([' ', '"'])) else {
                break;
            };
            self.all.push(format!("{:depth$}{}{end}", "", &rest[..at]));
            rest = format!("{begin}{}", &rest[at..]);
        }
        self.all.push(format!("{:depth$}{rest}", ""));
    }
}

/// True for a line that is not broken. The arms of a choice have lines of their own.
fn is_short(line: &str) -> bool {
    let content = line.trim_start().trim_start_matches("} else ");
    fits(line) && !content.contains("} else ")
}

/// True for a call, a list or a structure.
fn is_call(text: &str) -> bool {
    text.ends_with([')', ']', '}']) && !text.starts_with("if ") && operands(text).is_none()
}

/// Operands with the operators before them, and true if they fill lines; a sum has a line for each term. `None` if there is one alone.
fn operands(text: &str) -> Option<(Vec<&str>, bool)> {
    OPERATORS.iter().find_map(|operators| {
        let (mut pieces, mut start) = (Vec::new(), 0);
        for (at, _) in outer(text) {
            if operators.iter().any(|it| text[at..].starts_with(it)) {
                pieces.push(&text[start..at]);
                start = at + 1;
            }
        }
        pieces.push(&text[start..]);
        (pieces.len() > 1).then_some((pieces, *operators != SUM))
    })
}

/// Parts of a text between separators that stand outside of all brackets.
fn parts<'a>(text: &'a str, separator: &str) -> Vec<&'a str> {
    let (mut parts, mut start) = (Vec::new(), 0);
    for (at, _) in outer(text) {
        if text[at..].starts_with(separator) {
            parts.push(&text[start..at]);
            start = at + separator.len();
        }
    }
    parts.push(&text[start..]);
    parts
}

/// Places of the brackets that stand outside of all others: where they open and close.
fn groups(text: &str) -> Vec<[usize; 2]> {
    let brackets = outer(text).filter(|(_, it)| "()[]{}".contains(*it));
    let places: Vec<usize> = brackets.map(|(at, _)| at).collect();
    places.as_chunks().0.to_vec()
}

/// Letters that stand outside of all brackets and strings, with the outermost brackets.
fn outer(text: &str) -> impl Iterator<Item = (usize, char)> {
    let (mut open, mut is_string, mut is_escaped, mut before) = (0_i32, false, false, ' ');
    text.char_indices().filter(move |&(_, letter)| {
        if is_string {
            is_string = is_escaped || letter != '"';
            is_escaped = !is_escaped && letter == '\\';
            return false;
        }
        let change = match letter {
            '(' | '[' | '{' => 1,
            ')' | ']' | '}' => -1,
            // As in `Matrix<2, 3>`: signs of comparison have spaces around them.
            '<' if before != ' ' => 1,
            '>' if before != ' ' && before != '-' => -1,
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
    use super::{Lists, broken, fits};

    /// Lines of a statement eight deep.
    fn lines(statement: &str) -> String {
        let lines = broken(statement, 8, Lists::Apart);
        let content = |text: &str| text.replace([' ', '\n', ','], "");
        assert_eq!(content(&lines.concat()), content(statement));
        lines.join("\n")
    }

    #[test]
    fn fitting_lines_stay_as_they_are() {
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
    fn a_sum_has_a_line_for_each_term() {
        let term = "alpha * (beta - gamma)";
        let others = format!("\n            + {term}").repeat(5);
        assert_eq!(
            lines(&format!("let x = {};", [term; 6].join(" + "))),
            format!("        let x = {term}{others};")
        );
    }

    #[test]
    fn a_factor_that_is_longer_than_a_line_breaks_in_its_brackets() {
        let term = "alpha * (beta - gamma)";
        let others = format!("\n                + {term}").repeat(5);
        assert_eq!(
            lines(&format!("let x = ({}) * delta;", [term; 6].join(" + "))),
            format!("        let x = ({term}{others})\n            * delta;")
        );
    }

    #[test]
    fn elements_of_c_continue_the_line() {
        let long = "a_long_name * another_long_name_of_a_value";
        assert_eq!(
            broken(
                &format!("return f({long}, g({long}, a), {long});"),
                4,
                Lists::Filled
            ),
            [
                format!("    return f({long}, g({long}, a),"),
                format!("        {long});")
            ]
        );
        let name = "a".repeat(100);
        assert_eq!(
            broken(
                &format!("static void {name}(const void *found, double t)"),
                0,
                Lists::Filled
            ),
            [
                format!("static void {name}("),
                "    const void *found, double t)".to_string()
            ]
        );
    }

    #[test]
    fn strings_break_between_words() {
        let words = ["word"; 40].join(" ");
        let [rust, c] =
            [Lists::Apart, Lists::Filled].map(|it| broken(&format!("\"{words}\","), 4, it));
        assert!(rust.iter().chain(&c).all(|it| fits(it)), "{rust:?} {c:?}");
        let joined = |lines: Vec<String>, between: &str| {
            let lines: Vec<&str> = lines.iter().map(|it| it.trim_start()).collect();
            lines.join("\n").replace(between, "")
        };
        assert_eq!(joined(rust, "\\\n"), format!("\"{words}\","));
        assert_eq!(joined(c, "\"\n\""), format!("\"{words}\","));
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
            "joined at A, B (and C), \\\"D\\\"".repeat(3),
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
    fn code_in_strings_is_text() {
        let [left, right] =
            ["a = if b - c { d } else { e }; ", "x: { y } + z * w, "].map(|it| it.repeat(3));
        assert_eq!(
            lines(&format!("BlockName::new(\"{left}\", \"{right}\"),")),
            format!(
                "        BlockName::new(\n            \"{left}\",\n            \"{right}\",\n        ),"
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
