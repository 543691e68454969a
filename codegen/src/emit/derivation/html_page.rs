//! Lays out a derivation as parts of an HTML page.

use super::document::{DisplayedEquation, Document, Item, OutlineLine, Section};
use crate::emit::markup::escaped;
use crate::emit::mathml::lines;

/// Derivation for a page.
#[derive(Clone, Debug)]
pub struct HtmlDerivation {
    /// Numbers of unknowns by solution method, as text.
    pub summary: String,
    /// Rows of the table of unknowns and methods.
    pub outline: String,
    /// One for each block, then undetermined bearing forces and singular poses, if there are any.
    pub sections: Vec<HtmlSection>,
}

/// A section with its heading.
#[derive(Clone, Debug)]
pub struct HtmlSection {
    /// Heading.
    pub heading: String,
    /// Text below the heading.
    pub body: String,
}

pub(super) fn page(document: &Document) -> HtmlDerivation {
    HtmlDerivation {
        summary: escaped(&document.summary),
        outline: document.outline.iter().map(outline).collect(),
        sections: document.sections.iter().map(section).collect(),
    }
}

fn outline(line: &OutlineLine) -> String {
    format!(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        line.block, line.unknowns, line.method, line.joints
    )
}

fn section(section: &Section) -> HtmlSection {
    let items = section.items.iter().map(|item| match item {
        Item::Paragraph(words) => format!("<p>{words}</p>\n"),
        Item::Equations(equations) => equations.iter().map(displayed).collect(),
    });
    HtmlSection {
        heading: section.heading.clone(),
        body: items.collect(),
    }
}

/// An equation that may be broken before its signs.
fn displayed(equation: &DisplayedEquation) -> String {
    let row = format!("{}<mo>=</mo>{}", equation.left, equation.right);
    let note = match equation.note.as_str() {
        "" => String::new(),
        note => format!("<small>{note}</small>"),
    };
    format!(
        "<div class=\"equation\"><span>{}</span>{note}</div>\n",
        lines(&row)
    )
}
