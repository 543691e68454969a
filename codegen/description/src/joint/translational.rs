//! Translational joint: two bodies slide along a common line and keep their relative angle.

use super::geometry::{offset_along, perpendicular, subtract};
use super::{Auxiliary, Feature, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// φ_i − φ_j − φ⁰ = 0 and (R_i v)ᵀ (r_j + R_j s_j − r_i − R_i s_i) = 0, with v across the line, fixed in body i
/// (Nikravesh 1988, section 4.2.2, with the angle instead of a second cross product).
pub struct Translational;

impl Kind for Translational {
    fn keyword(&self) -> &'static str {
        "translational"
    }

    fn operands(&self) -> Operands {
        Operands::BODIES_ALONG
    }

    fn value(&self) -> Value {
        Value::None
    }

    fn example(&self) -> &'static str {
        "`translational (1, 2) along P -> Q;` with P on body 1 and Q on body 2"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Slide)
    }

    fn without(&self, component: &str) -> Option<&'static str> {
        match component {
            "angle" => Some("`point_on_line (2.Q, 1) along P -> R;` with P and R on body 1"),
            "lateral" => Some("`relative_angle(1, 2);`"),
            _ => None,
        }
    }

    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[Auxiliary::Displacement]
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let Some((axis, i, j)) = operands.along() else {
            return Vec::new();
        };
        let [across, turned] =
            [axis.direction, axis.turned].map(|along| perpendicular(along, graph));
        let lateral = offset_along(across, turned, &i, &j, graph);
        vec![
            relative_angle(operands, axis.relative_angle, graph),
            Row {
                residual: lateral,
                quantity: Quantity::Length,
                component: "lateral",
            },
        ]
    }

    /// Returns the rows φ_i − φ_j − φ⁰ and r_j + R_j s_j − r_i − R_i s_i − ℓ R_i u.
    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let (Some(axis), [displacement]) = (operands.axis, &operands.auxiliaries[..]) else {
            return Vec::new();
        };
        let [i, j] = [0, 1].map(|side| operands.marks[side].position(graph));
        let gap = subtract(j, i, graph);
        let slide = axis
            .turned
            .map(|component| graph.multiply(displacement.value, component));
        let open = subtract(gap, slide, graph);
        let row = |residual, component| Row {
            residual,
            quantity: Quantity::Length,
            component,
        };
        vec![
            relative_angle(operands, axis.relative_angle, graph),
            row(open[0], "x"),
            row(open[1], "y"),
        ]
    }
}

/// Returns the row φ_i − φ_j − φ⁰.
fn relative_angle(operands: &Resolved, drawn: ExprId, graph: &mut Graph) -> Row {
    let [i, j] = [0, 1].map(|side| operands.marks[side].frame.angle);
    let difference = graph.subtract(i, j);
    Row {
        residual: graph.subtract(difference, drawn),
        quantity: Quantity::Angle,
        component: "angle",
    }
}
