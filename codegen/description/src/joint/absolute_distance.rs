//! Absolute distance: a point of a body stays on a circle about a point of the ground.

use super::link::{link_rows, refuse_length, squared_row};
use super::{Auxiliary, Feature, Kind, Operands, Quantity, Refusal, Resolved, Row, Slot, Value};
use crate::expr::{ExprId, Graph};

/// (r_i + R_i s_i − A)ᵀ (r_i + R_i s_i − A) − L² = 0 (Haug 1989, section 3.2).
pub struct AbsoluteDistance;

impl Kind for AbsoluteDistance {
    fn keyword(&self) -> &'static str {
        "absolute_distance"
    }

    fn operands(&self) -> Operands {
        Operands::of(&[Slot::Point, Slot::GroundPoint])
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`absolute_distance (1.P, A) = 2;` with A a point on the ground"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Link)
    }

    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[Auxiliary::LinkAngle]
    }

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        refuse_length(operands.value?, "`revolute (1.P, ground.A);`", graph)
    }

    fn positive(&self, operands: &Resolved, _graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((operands.value?, "the distance"))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        operands
            .value
            .map_or(Vec::new(), |length| squared_row(operands, length, graph))
    }

    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        operands
            .value
            .map_or(Vec::new(), |length| link_rows(operands, length, graph))
    }
}
