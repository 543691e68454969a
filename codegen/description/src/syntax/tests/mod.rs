//! Tests parsing as a whole, from text to tree or findings.

mod errors;
mod forms;
mod motions;
mod repetition;
mod robustness;

use super::{Document, parse};
use crate::diagnostic::{Diagnostics, Source};

/// First seed mechanism, as sketched in the design.
pub(super) const TWO_BODY: &str = "\
//! ME 451 midterm, problem B.
mechanism two_body {
    body 1 at (0, 0, 30deg)      { P: (1, 0) }
    body 2 at (1.7, 2, 1)        { P: (-sqrt(3), 0), Q: (-sqrt(3)/2, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    revolute P(1, 2);
    absolute_x(2) = sqrt(3);
    drive phi(1) = pi/6 + sin(2*t);
}
";

/// Second seed mechanism, with the statements that the first does not have.
pub(super) const EXCAVATOR: &str = "\
mechanism excavator {
    point A = (-1, 0.2);  point N = (0.4, -0.2);  // global, as drawn
    point M = (0.3, 0.1), L = (0, 0),
          B = (50mm, 1e-3m);
    /* carries points given globally */
    body c1 at (-0.95, 0.55) { A, B, K }
    body c8 at (0.35, 0) facing N -> M { N }      // its x axis along the actuator
    body c7 at M turned 30deg;
    revolute L(ground, c3);
    translational (c8, c7) along N -> M;
    translational slide(c8, c7) along c8.N -> M;
    /// Extends the boom.
    drive length(N, M) = distance(N, M) + 0.05*sin(1.5*t);
    drive boom: length(N, 1.M) = 2;
}
";

/// Parses valid text.
fn good(text: &str) -> Document {
    let source = Source::new("good.mech", text);
    let mut findings = Diagnostics::new();
    let document = parse(&source, &mut findings);
    assert!(findings.is_empty(), "{}", findings.render(&source));
    document.expect("a document without findings")
}

/// Returns the rendered findings of invalid text.
fn bad(text: &str) -> String {
    let source = Source::new("bad.mech", text);
    let mut findings = Diagnostics::new();
    parse(&source, &mut findings);
    assert!(findings.has_errors(), "no error in {text}");
    findings.render(&source)
}

/// Returns codes and positions of the findings, as `K02 3:14`.
fn codes(text: &str) -> Vec<String> {
    let source = Source::new("bad.mech", text);
    let mut findings = Diagnostics::new();
    parse(&source, &mut findings);
    let place = |it: &crate::diagnostic::Diagnostic| source.position(it.primary.span.start);
    findings
        .into_sorted()
        .iter()
        .map(|it| format!("{} {}:{}", it.code, place(it).line, place(it).column))
        .collect()
}
