//! A derivation → a page of plain text.

use super::document::{DisplayedEquation, Document, Item, OutlineLine};
use crate::emit::text::table::{aligned, in_lines, shown_width};

/// Words are broken into lines of at most so many columns; formulas are not.
const WIDTH: usize = 100;

/// The whole page.
pub(super) fn page(document: &Document) -> String {
    let mut text = format!(
        "mechanism {}\n\n{}\n\n{}",
        document.name,
        document.summary,
        outline(&document.outline)
    );
    for section in &document.sections {
        text.push_str(&format!("\n{}\n", section.heading));
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
    let cells = lines.iter().map(|line| {
        vec![
            line.block.clone(),
            line.unknowns.clone(),
            line.method.clone(),
            line.joints.clone(),
        ]
    });
    let table: Vec<Vec<String>> = std::iter::once(heading.to_vec()).chain(cells).collect();
    aligned(&table)
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

/// Words in lines that begin after two spaces.
fn wrapped(words: &str) -> String {
    let mut lines = vec![String::new()];
    for word in words.split(' ') {
        if let Some(line) = lines.last_mut() {
            if line.is_empty() || shown_width(line) + shown_width(word) < WIDTH {
                if !line.is_empty() {
                    line.push(' ');
                }
                line.push_str(word);
            } else {
                lines.push(word.to_string());
            }
        }
    }
    let lines: Vec<String> = lines.iter().map(|line| format!("  {line}\n")).collect();
    lines.concat()
}
