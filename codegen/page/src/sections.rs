//! Writes the sections of text of a page, in their order.

use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_solver::condition::Condition;
use linkwright_solver::condition::jacobian;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Check, Instant, View as _};
use nalgebra::DVector;

use super::number::number;
use super::{constraints, equations, given, solution, start};

/// Anchors of the sections, and their names in the table of contents.
const NAMES: [(&str, &str); 10] = [
    ("about", "About"),
    ("bodies", "Bodies"),
    ("given", "Parameters"),
    ("constraints", "Constraints"),
    ("equations", "Equations"),
    ("start", "Start"),
    ("newton", "Newton-Raphson"),
    ("derivation", "Solution"),
    ("singular", "Singular poses"),
    ("assemblies", "Assemblies"),
];

/// Section of text of a page.
#[derive(Clone, Debug)]
pub struct Section {
    /// Anchor of the heading, and the key under which an answer has the section.
    pub id: &'static str,
    /// Name in the table of contents.
    pub name: &'static str,
    /// Heading and contents; empty if the page has none, for instance without a motion.
    pub html: String,
}

impl Section {
    fn new(id: &'static str, name: &'static str, heading: &str, text: &str) -> Section {
        let html = match text.is_empty() {
            true => String::new(),
            false => format!("<h2 id=\"{id}\">{heading}</h2>\n{text}"),
        };
        Section { id, name, html }
    }

    /// Returns all sections without contents.
    pub fn all_empty() -> Vec<Section> {
        let all = NAMES.into_iter();
        all.map(|(id, name)| Section::new(id, name, "", ""))
            .collect()
    }

    /// Returns the section as an element of a page.
    pub fn element(&self) -> String {
        let Section { id, html, .. } = self;
        let hidden = if html.is_empty() { " hidden" } else { "" };
        format!(
            "<section data-section=\"{id}\" aria-labelledby=\"{id}\"{hidden}>{html}</section>\n"
        )
    }
}

/// Returns all sections of a page. `step` (s) is that of the first Newton-Raphson step; `is_drawn` is true for the assembly of the
/// design configuration, along whose motion the check has sought singular poses.
pub fn sections(check: &Check, first: Option<&Instant>, step: f64, is_drawn: bool) -> Vec<Section> {
    let view = &check.interpreted;
    let (pool, system) = (view.pool(), view.system());
    let [start, newton] = first.map_or_else(Default::default, |first| {
        [
            start::values(view, first),
            start::first_step(pool, system, first, first.t() + step),
        ]
    });
    let start_heading = format!(
        "Position, velocity and acceleration at t = {} s",
        number(first.map_or(check.start, |it| it.t()))
    );
    let singular = solution::singular(check, determinant(check, first), is_drawn);
    let contents = [
        (
            "About this mechanism",
            given::remaining_docs(&system.mechanism.docs),
        ),
        (given::moving(system).0, given::bodies(system)),
        ("Parameters and inputs", given::values(pool, system)),
        (
            "Constraints and degrees of freedom",
            constraints::section(pool, system, check),
        ),
        ("Equations", equations::section(view.derived())),
        (&start_heading, start),
        ("The first Newton-Raphson step", newton),
        ("Solution block by block", solution::derivation(check)),
        ("Singular poses", singular),
        ("Assemblies", assemblies(check)),
    ];
    let named = NAMES.into_iter().zip(contents);
    named
        .map(|((id, name), (heading, text))| Section::new(id, name, heading, &text))
        .collect()
}

/// Returns the determinant of Φ_q at the start; `None` without a motion.
fn determinant(check: &Check, first: Option<&Instant>) -> Option<f64> {
    let first = first?;
    let textbook = TextbookEquations::new(check.interpreted.pool(), check.interpreted.system());
    let q = DVector::from_column_slice(first.q());
    Some(Condition::of(&jacobian(&textbook, &q, first.t())).determinant)
}

/// Returns the text about assemblies; scripts make their pictures from the drawing.
fn assemblies(check: &Check) -> String {
    let assemblies = &check.assemblies.found;
    let names: Vec<String> = check
        .interpreted
        .mode_names()
        .iter()
        .map(|it| format!("<code>{}</code>", escaped(&it.name)))
        .collect();
    let modes = match names.is_empty() {
        true => String::new(),
        false => format!(
            " A label has one character for each of {}, in this order: the sign of its determinant, or a letter that numbers its poses.",
            names.join(", ")
        ),
    };
    let rest = match check.assemblies.are_all() {
        true => "; the list is complete.",
        false => "; others may exist.",
    };
    let choice = match assemblies.len() {
        0 | 1 => "",
        _ => " Select one to see its motion.",
    };
    format!(
        "<p>At t = {} s the mechanism can be assembled in {} {}{rest}{modes}{choice}</p>\n<div class=\"thumbnails\" data-part=\"thumbnails\" role=\"group\" aria-labelledby=\"assemblies\"></div>\n<p data-part=\"assembly-error\" class=\"error\" hidden></p>\n",
        number(check.start),
        assemblies.len(),
        if assemblies.len() == 1 { "way" } else { "ways" },
    )
}
