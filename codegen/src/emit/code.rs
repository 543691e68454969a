//! Lines of code that are being written.
//!
//! Lines know how deep they stand, and are broken at the end alone: what is written for one place may be put into another.

/// Code that is being written.
#[derive(Clone, Debug, Default)]
pub(super) struct Code {
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

impl Code {
    pub(super) fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Adds a line, which is broken if it is too long.
    pub(super) fn line(&mut self, line: impl Into<String>) {
        self.push(line.into(), false);
    }

    /// Adds a line, however long it is.
    pub(super) fn whole(&mut self, line: impl Into<String>) {
        self.push(line.into(), true);
    }

    fn push(&mut self, text: String, is_whole: bool) {
        let depth = self.depth;
        self.lines.push(Line {
            depth,
            text,
            is_whole,
        });
    }

    /// Adds a line that the following ones are indented under.
    pub(super) fn open(&mut self, line: impl Into<String>) {
        self.line(line);
        self.depth += 1;
    }

    /// Adds the line that ends them.
    pub(super) fn close(&mut self, line: impl Into<String>) {
        self.end();
        self.line(line);
    }

    /// Ends them without a line.
    pub(super) fn end(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }

    /// Adds the line that ends them and begins others.
    pub(super) fn turn(&mut self, line: impl Into<String>) {
        self.close(line);
        self.depth += 1;
    }

    /// Adds an empty line between what belongs to different things.
    pub(super) fn gap(&mut self) {
        let last = self.lines.last().map_or("{", |line| &line.text);
        if !last.is_empty() && !last.ends_with('{') {
            self.line("");
        }
    }

    /// Adds what was written elsewhere.
    pub(super) fn append(&mut self, other: Code) {
        let depth = self.depth;
        self.lines.extend(other.lines.into_iter().map(|line| Line {
            depth: depth + line.depth,
            ..line
        }));
    }

    /// Names and numbers, except for those in comments and strings; names that dots join are one.
    pub(super) fn words(&self) -> impl Iterator<Item = &str> {
        let code = self.lines.iter().map(|line| line.text.as_str());
        let code = code.filter(|line| !line.starts_with("//"));
        code.flat_map(outside_strings).flat_map(|part| {
            part.split(|it: char| !(it.is_alphanumeric() || it == '_' || it == '.'))
                .filter(|word| !word.is_empty())
        })
    }

    /// Names alone.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.words().flat_map(|word| word.split('.'))
    }

    /// All lines, each with its break, as a language breaks them.
    pub(super) fn finish(&self, broken: fn(&str, usize) -> Vec<String>) -> String {
        let mut all = String::new();
        for line in &self.lines {
            let depth = 4 * line.depth;
            if line.is_whole || line.text.is_empty() {
                let indent = if line.text.is_empty() { 0 } else { depth };
                all.extend([&" ".repeat(indent), line.text.as_str(), "\n"]);
                continue;
            }
            for line in broken(&line.text, depth) {
                all.extend([line.as_str(), "\n"]);
            }
        }
        all
    }
}

/// The parts of a line between its strings.
fn outside_strings(line: &str) -> Vec<&str> {
    let (mut parts, mut start, mut is_inside, mut is_escaped) = (Vec::new(), 0, false, false);
    for (place, byte) in line.bytes().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = is_inside,
            b'"' => {
                if !is_inside {
                    parts.push(&line[start..place]);
                }
                (is_inside, start) = (!is_inside, place + 1);
            }
            _ => {}
        }
    }
    if !is_inside {
        parts.push(&line[start..]);
    }
    parts
}
