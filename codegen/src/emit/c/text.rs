//! Lines of C, as a person lays them out.

use super::broken::broken;

/// Code that is being written.
///
/// Lines are broken at the end, because code that is written for one place may be put into another.
#[derive(Clone, Debug, Default)]
pub(super) struct Text {
    lines: Vec<Line>,
    depth: usize,
}

#[derive(Clone, Debug)]
struct Line {
    depth: usize,
    text: String,
    /// True if the line stays as it is, however long.
    is_whole: bool,
}

impl Text {
    /// A line, broken where it is too long.
    pub(super) fn line(&mut self, line: impl AsRef<str>) {
        self.push(line.as_ref(), false);
    }

    /// A line, however long it is.
    pub(super) fn line_as_it_is(&mut self, line: &str) {
        self.push(line.trim_end(), true);
    }

    fn push(&mut self, line: &str, is_whole: bool) {
        self.lines.push(Line {
            depth: self.depth,
            text: line.to_string(),
            is_whole,
        });
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
        let last = self.lines.last().map_or("{", |line| &line.text);
        if !last.is_empty() && !last.ends_with('{') {
            self.push("", true);
        }
    }

    /// What was written elsewhere.
    pub(super) fn append(&mut self, other: Text) {
        let depth = self.depth;
        self.lines.extend(other.lines.into_iter().map(|line| Line {
            depth: depth + line.depth,
            ..line
        }));
    }

    /// Whether some line mentions a name.
    pub(super) fn mentions(&self, name: &str) -> bool {
        self.lines.iter().any(|line| mentions(&line.text, name))
    }

    /// All lines, each with its break.
    pub(super) fn finish(self) -> String {
        let mut all = String::new();
        for Line {
            depth,
            text,
            is_whole,
        } in self.lines
        {
            let depth = if text.is_empty() { 0 } else { 4 * depth };
            match is_whole {
                true => all += &format!("{:depth$}{text}\n", ""),
                false => broken(&text, depth)
                    .into_iter()
                    .for_each(|line| all += &format!("{}\n", line.trim_end())),
            }
        }
        all
    }
}

/// Whether code mentions a name.
pub(super) fn mentions(code: &str, name: &str) -> bool {
    code.split(|character: char| !(character.is_alphanumeric() || character == '_'))
        .any(|word| word == name)
}
