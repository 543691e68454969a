//! Weld: two bodies keep their relative pose of the design configuration.

use super::relative_angle::relative_angle_row;
use super::revolute::Revolute;
use super::{Feature, Kind, Operands, Resolved, Row, Slot, Value};
use crate::expr::Graph;

/// r_i + R_i s_i − r_j = 0 and φ_j − φ_i − φ⁰ = 0, with s_i the origin of body j in the frame of body i in the design
/// configuration (Nikravesh 1988, section 4.2: a revolute joint without rotation).
pub struct Weld;

impl Kind for Weld {
    fn keyword(&self) -> &'static str {
        "weld"
    }

    fn operands(&self) -> Operands {
        Operands::of(&[Slot::Counterpart, Slot::Body])
    }

    fn value(&self) -> Value {
        Value::None
    }

    fn example(&self) -> &'static str {
        "`weld (1, 2);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Weld)
    }

    fn without(&self, component: &str) -> Option<&'static str> {
        (component == "angle").then_some("`revolute P(1, 2);`")
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let mut rows = Revolute.rows(operands, graph);
        let [i, j] = [0, 1].map(|side| operands.drawn[side].frame.angle);
        let drawn = graph.subtract(j, i);
        rows.push(relative_angle_row(operands, drawn, "angle", graph));
        rows
    }
}
