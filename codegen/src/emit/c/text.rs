//! Lines of C, as a person lays them out.

use crate::emit::lines::{WIDTH, fits, terms};

/// Code that is being written.
#[derive(Clone, Debug, Default)]
pub(super) struct Text {
    lines: Vec<String>,
    depth: usize,
}

impl Text {
    /// A line, broken where it is too long.
    pub(super) fn line(&mut self, line: impl AsRef<str>) {
        let line = line.as_ref();
        let indented = format!("{}{line}", "    ".repeat(self.depth));
        match line.is_empty() {
            true => self.lines.push(String::new()),
            false => self.lines.extend(broken(&indented, 4 * self.depth)),
        }
    }

    /// A line, however long it is.
    pub(super) fn line_as_it_is(&mut self, line: &str) {
        let indent = "    ".repeat(self.depth);
        let line = format!("{indent}{line}");
        self.lines.push(line.trim_end().to_string());
    }

    /// A line that the following ones are indented under.
    pub(super) fn open(&mut self, line: impl AsRef<str>) {
        self.line(line);
        self.depth += 1;
    }

    /// The line that ends them.
    pub(super) fn close(&mut self, line: impl AsRef<str>) {
        self.depth = self.depth.saturating_sub(1);
        self.line(line);
    }

    /// Ends what is indented without a line.
    pub(super) fn close_without_line(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }

    /// An empty line between what belongs to different things.
    pub(super) fn gap(&mut self) {
        let is_begun = self.lines.last().is_some_and(|line| !line.is_empty());
        if is_begun && !self.lines.last().is_some_and(|line| line.ends_with('{')) {
            self.lines.push(String::new());
        }
    }

    /// What was written elsewhere.
    pub(super) fn append(&mut self, other: Text) {
        let indent = "    ".repeat(self.depth);
        let lines = other.lines.into_iter();
        self.lines.extend(lines.map(|line| match line.is_empty() {
            true => line,
            false => format!("{indent}{line}"),
        }));
    }

    /// How far lines are indented.
    pub(super) fn depth(&self) -> usize {
        4 * self.depth
    }

    /// Whether some line mentions a name.
    pub(super) fn mentions(&self, name: &str) -> bool {
        self.lines.iter().any(|line| mentions(line, name))
    }

    /// All lines, each with its break.
    pub(super) fn finish(self) -> String {
        self.lines.into_iter().map(|line| line + "\n").collect()
    }
}

/// Whether code mentions a name.
pub(super) fn mentions(code: &str, name: &str) -> bool {
    code.split(|character: char| !(character.is_alphanumeric() || character == '_'))
        .any(|word| word == name)
}

/// A line of code in lines of [`WIDTH`]: between terms or factors outside of all brackets, or else between what commas part in the
/// outermost ones that hold several, where it is too long.
fn broken(line: &str, depth: usize) -> Vec<String> {
    if fits(line) {
        return vec![line.to_string()];
    }
    let is_list = line.trim_end().ends_with("{") || line.contains(" = {") || line.ends_with(')');
    let in_terms = (!is_list).then(|| terms(line, depth)).flatten();
    in_terms
        .or_else(|| elements(line, depth))
        .or_else(|| terms(line, depth))
        .unwrap_or_else(|| vec![line.to_string()])
}

/// A line broken after commas inside its first brackets that hold one, indented once more.
fn elements(line: &str, depth: usize) -> Option<Vec<String>> {
    let opening = [" = {", "("]
        .iter()
        .find_map(|it| line.find(it).map(|at| at + it.len()))?;
    let mut pieces = Vec::new();
    let (mut start, mut open) = (0, 0_i32);
    for (at, letter) in line.char_indices() {
        match letter {
            '(' | '[' | '{' => open += 1,
            ')' | ']' | '}' => open -= 1,
            ',' if open == 1 && at >= opening => {
                pieces.push(&line[start..=at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    pieces.push(&line[start..]);
    if pieces.len() < 2 {
        return None;
    }
    let indent = " ".repeat(depth + 4);
    let mut lines: Vec<String> = vec![pieces[0].to_string()];
    for piece in &pieces[1..] {
        let piece = piece.trim_start();
        match lines.last_mut() {
            Some(last) if last.chars().count() + 1 + piece.chars().count() <= WIDTH => {
                last.push(' ');
                last.push_str(piece);
            }
            _ => lines.push(format!("{indent}{piece}")),
        }
    }
    Some(lines)
}
