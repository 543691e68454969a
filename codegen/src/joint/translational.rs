//! Translational joint: two bodies slide along a common line and keep their relative angle.

use super::geometry::{offset_along, perpendicular};
use super::{Kind, Operands, Quantity, Resolved, Row};
use crate::expr::Graph;

/// φ_i − φ_j − φ⁰ = 0 and (R_i v)ᵀ (r_j + R_j s_j − r_i − R_i s_i) = 0, with v across the line, fixed in body i
/// (Nikravesh 1988, section 4.2.2, with the angle instead of a second cross product).
pub struct Translational;

impl Kind for Translational {
    fn keyword(&self) -> &'static str {
        "translational"
    }

    fn operands(&self) -> Operands {
        Operands::BodiesAlong
    }

    fn value(&self) -> Option<Quantity> {
        None
    }

    fn example(&self) -> &'static str {
        "`translational (1, 2) along P -> Q;` with P on body 1 and Q on body 2"
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let [i, j] = [operands.marks[0], operands.marks[1]];
        let Some(axis) = operands.axis else {
            return Vec::new();
        };
        let turned = graph.subtract(i.frame.angle, j.frame.angle);
        let angle = graph.subtract(turned, axis.relative_angle);
        let across = perpendicular(axis.direction, graph);
        let lateral = offset_along(across, &i, &j, graph);
        vec![
            Row {
                residual: angle,
                quantity: Quantity::Angle,
                component: "angle",
            },
            Row {
                residual: lateral,
                quantity: Quantity::Length,
                component: "lateral",
            },
        ]
    }
}
