//! Lays out a derivation as plain text.

use super::document::{DisplayedEquation, Document, Item, OutlineLine};
use crate::emit::text::table::{aligned, in_lines, shown_width};

/// Number of columns at which words are wrapped; formulas are not.
const WIDTH: usize = 100;

/// Width at which a cell of the table of blocks is broken after a comma.
const WIDEST_CELL: usize = 80;

/// The whole page.
pub(super) fn page(document: &Document) -> String {
    let mut text = format!(
        "mechanism {}\n\n{}\n\n{}",
        document.name,
        document.summary,
        outline(&document.outline)
    );
    for section in &document.sections {
        text.push_str(&format!(
            "\n{}\n",
            filled(section.heading.split(' '), WIDTH).join("\n")
        ));
        for item in &section.items {
            text.push('\n');
            match item {
                Item::Paragraph(words) => text.push_str(&wrapped(words)),
                Item::Equations(equations) => text.push_str(&displayed(equations)),
            }
        }
    }
    text
}

/// The table alone.
pub(super) fn outline(lines: &[OutlineLine]) -> String {
    let heading = ["block", "unknowns", "method", "joints"].map(String::from);
    let cells = lines.iter().flat_map(|line| {
        let cells = [&line.block, &line.unknowns, &line.method, &line.joints].map(|it| folded(it));
        let height = cells.iter().map(Vec::len).max().unwrap_or(0);
        (0..height).map(move |row| {
            cells
                .each_ref()
                .map(|lines| lines.get(row).cloned().unwrap_or_default())
                .to_vec()
        })
    });
    let table: Vec<Vec<String>> = std::iter::once(heading.to_vec()).chain(cells).collect();
    aligned(&table)
}

/// Breaks a list into lines no wider than a cell if its entries permit.
fn folded(list: &str) -> Vec<String> {
    let mut depth = 0_i32;
    let entries = list.split_inclusive(|character| {
        depth += i32::from(character == '(') - i32::from(character == ')');
        depth == 0 && character == ','
    });
    filled(entries.map(str::trim_start), WIDEST_CELL)
}

fn displayed(equations: &[DisplayedEquation]) -> String {
    let lines: Vec<Vec<String>> = equations
        .iter()
        .flat_map(|equation| {
            let lines = in_lines(&equation.left, &equation.right);
            let mut cells: Vec<Vec<String>> = lines
                .into_iter()
                .map(|line| vec![String::new(), line])
                .collect();
            if !equation.note.is_empty() {
                cells[0].push(format!("[{}]", equation.note));
            }
            cells
        })
        .collect();
    aligned(&lines)
}

/// Wraps words in lines that begin after two spaces.
fn wrapped(words: &str) -> String {
    let lines = filled(words.split(' '), WIDTH).into_iter();
    let lines: Vec<String> = lines.map(|line| format!("  {line}\n")).collect();
    lines.concat()
}

/// Joins pieces by blanks, in lines no wider than this if each piece permits.
fn filled<'a>(pieces: impl Iterator<Item = &'a str>, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for piece in pieces {
        match lines.last_mut() {
            Some(line) if shown_width(line) + 1 + shown_width(piece) <= width => {
                line.push(' ');
                line.push_str(piece);
            }
            _ => lines.push(piece.to_string()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_are_broken_after_commas() {
        let names: Vec<String> = (0..40).map(|number| format!("phi_{number}")).collect();
        let line = OutlineLine {
            block: "1".to_string(),
            unknowns: names.join(", "),
            method: "Newton of size 2 for 40 unknowns".to_string(),
            joints: "A, B".to_string(),
        };
        let text = outline(&[line]);
        assert!(text.lines().all(|line| shown_width(line) <= 135), "{text}");
        let words = text
            .split_whitespace()
            .map(|word| word.trim_end_matches(','));
        let angles: Vec<&str> = words.filter(|word| word.starts_with("phi_")).collect();
        assert_eq!(angles, names);
        assert_eq!(text.matches("Newton").count(), 1, "{text}");
    }
}
