//! Equation: a row written by the description in coordinates, points of bodies and t, or a rod between positions given by
//! formulas.

use super::link::refuse_length;
use super::{Feature, Kind, Operands, Refusal, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// left − right = 0 as written; |Q − P|² − ℓ² = 0 for a rod.
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

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        let instead = "an `equation` for each of their components";
        refuse_length(operands.length()?, instead, graph)
    }

    fn positive(&self, operands: &Resolved, _graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((operands.length()?, "the distance"))
    }

    /// Returns the formula with the rotated local vectors of the marks substituted; their symbols serve the vector form.
    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
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
}
