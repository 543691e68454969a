//! Lays out a derivation as a LaTeX document.

use super::document::{DisplayedEquation, Document, Item, OutlineLine};
use crate::emit::latex::lines::{
    Line, displayed, document as latex_document, fragment as latex_fragment, title,
};

/// Whole document, which requires only amsmath.
pub(super) fn page(document: &Document) -> String {
    latex_document(&body(document))
}

/// Equations for a document that has a preamble.
pub(super) fn fragment(document: &Document) -> String {
    latex_fragment(&body(document))
}

fn body(document: &Document) -> String {
    let mut text = format!(
        "{}{}\n\n{}",
        title(&document.name),
        document.summary,
        outline(&document.outline)
    );
    for section in &document.sections {
        text.push_str(&format!("\n\\subsection*{{{}}}\n", section.heading));
        for item in &section.items {
            match item {
                Item::Paragraph(words) => text.push_str(&format!("\n{words}\n")),
                Item::Equations(equations) => text.push_str(&displayed(equations.iter().map(line))),
            }
        }
    }
    text
}

fn outline(lines: &[OutlineLine]) -> String {
    let rows: Vec<String> = lines
        .iter()
        .map(|line| {
            format!(
                "{} & \\raggedright {} & \\raggedright {} & \\raggedright {} \\tabularnewline\n",
                line.block, line.unknowns, line.method, line.joints
            )
        })
        .collect();
    format!(
        "{{\\small\n\\begin{{tabular}}{{lp{{6cm}}p{{3.5cm}}p{{5cm}}}}\n\
         block & unknowns & method & joints \\\\ \\hline\n{}\\end{{tabular}}}}\n",
        rows.concat()
    )
}

fn line(equation: &DisplayedEquation) -> Line<'_> {
    Line {
        left: &equation.left,
        right: &equation.right,
        note: &equation.note,
    }
}
