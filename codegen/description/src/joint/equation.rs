//! Equation: a row written by the description in coordinates, points of bodies and t, or a rod between positions given by
//! formulas.

use super::link::refuse_length;
use super::{Feature, Kind, Operands, Refusal, Resolved, Row};
use crate::expr::Graph;

/// left − right = 0 as written; |Q − P|² − ℓ² = 0 for a rod.
pub static EQUATION: Kind = Kind {
    keyword: "equation",
    operands: Operands::of(&[]),
    example: "`equation rope: K.x^2 + K.y^2 = 4;`",
    feature: |_, _| Some(Feature::Written),
    refusal,
    positive: |operands, _| Some((operands.length()?, "the distance")),
    rows,
    ..Kind::UNSET
};

fn refusal(operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
    let instead = "an `equation` for each of their components";
    refuse_length(operands.length()?, instead, graph)
}

/// Returns the formula with the rotated local vectors of the marks substituted; their symbols serve the vector form.
fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let Some(formula) = &operands.formula else {
        return Vec::new();
    };
    let mut arms = Vec::new();
    for (mark, symbols) in operands.marks.iter().zip(&formula.arms) {
        if let Some([x, y]) = *symbols {
            arms.extend([(x, mark.arm[0]), (y, mark.arm[1])]);
        }
    }
    vec![Row {
        residual: graph.substitute(formula.residual, &arms),
        quantity: formula.quantity,
        component: "",
    }]
}
