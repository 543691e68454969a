//! Equation: a row that the description writes out, over coordinates, points of bodies and t.

use super::{Feature, Kind, Operands, Resolved, Row, Value};
use crate::expr::Graph;

/// left − right = 0, as it is written.
pub struct Equation;

impl Kind for Equation {
    fn keyword(&self) -> &'static str {
        "equation"
    }

    fn operands(&self) -> Operands {
        Operands::of(&[])
    }

    fn value(&self) -> Value {
        Value::None
    }

    fn example(&self) -> &'static str {
        "`equation rope: K.x^2 + K.y^2 = 4;`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Written)
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        written_row(operands, graph)
    }
}

/// The formula with the arms of the marks put in, so that the vector form has symbols for them.
pub(super) fn written_row(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
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
