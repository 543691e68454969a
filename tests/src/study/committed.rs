//! Reads the tables of committed reports, to compare their rows with what is computed now.

use std::fs;

use crate::files;

/// Committed report of `tests/reports`.
pub struct Committed {
    /// Name of its file.
    pub name: String,
    text: String,
}

impl Committed {
    /// Reads a report by the name of its file.
    ///
    /// # Panics
    /// If the report cannot be read.
    pub fn read(name: &str) -> Committed {
        let file = files::package("reports").join(name);
        let text = fs::read_to_string(&file);
        let text = text.unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        Committed {
            name: name.to_string(),
            text,
        }
    }

    /// Returns the rows of all tables below a heading, up to the next heading.
    ///
    /// # Panics
    /// If the report has no such heading.
    pub fn rows_below(&self, heading: &str) -> Vec<Vec<String>> {
        let mut lines = self.text.lines();
        let is_there = lines.any(|line| line.trim_start_matches('#').trim() == heading);
        assert!(is_there, "{} has no heading `{heading}`", self.name);
        let section: Vec<&str> = lines.take_while(|line| !line.starts_with('#')).collect();
        rows(&section.join("\n"))
    }
}

/// Returns the cells of all rows of tables in Markdown; the lines of dashes below headers are left out.
pub fn rows(text: &str) -> Vec<Vec<String>> {
    let lines = text.lines().filter_map(|line| {
        let inner = line.strip_prefix('|')?.strip_suffix('|')?;
        let cells: Vec<String> = inner.split('|').map(|it| it.trim().to_string()).collect();
        let is_rule = cells
            .iter()
            .all(|it| it.chars().all(|letter| "-:".contains(letter)));
        (!is_rule).then_some(cells)
    });
    lines.collect()
}
