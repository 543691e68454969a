//! Point on curve: a point of one body stays on a curve of another.

use super::geometry::subtract;
use super::{Contact, Feature, Follower, Kind, Operands, Quantity, Resolved, Row, Value};
use crate::expr::Graph;

/// r_j + R_j s_j − r_i − R_i p(s) = 0, with s as a separate coordinate (Nikravesh 1988, section 4.2.4).
pub struct PointOnCurve;

impl Kind for PointOnCurve {
    fn keyword(&self) -> &'static str {
        "point_on_curve"
    }

    fn operands(&self) -> Operands {
        Operands::POINT_AND_CURVE
    }

    fn value(&self) -> Value {
        Value::None
    }

    fn example(&self) -> &'static str {
        "`point_on_curve (2.P, rim);` with `curve rim(s) on 1 = (X, Y);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Contact(Follower::Point))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let Some(curve) = operands.curve else {
            return Vec::new();
        };
        let follower = operands.marks[0].position(graph);
        let touched = curve.position(curve.point, graph);
        let gap = subtract(follower, touched, graph);
        let row = |residual, component| Row {
            residual,
            quantity: Quantity::Length,
            component,
        };
        vec![row(gap[0], "x"), row(gap[1], "y")]
    }

    fn contact(&self, operands: &Resolved, graph: &mut Graph) -> Option<Contact> {
        let curve = operands.curve?;
        let normal = curve.normal(graph);
        Some(Contact {
            normal: curve.rotate(normal, graph),
            follower: operands.marks[0].frame,
            place: operands.marks[0].position(graph),
            fit: None,
        })
    }
}
