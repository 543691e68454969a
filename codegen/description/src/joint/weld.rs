//! Weld: two bodies keep their relative pose of the design configuration.

use super::relative_angle::relative_angle_row;
use super::revolute::REVOLUTE;
use super::{Feature, Kind, Operands, Resolved, Row, Slot};
use crate::expr::Graph;

/// r_i + R_i s_i − r_j = 0 and φ_j − φ_i − φ⁰ = 0, with s_i the origin of body j in the frame of body i in the design
/// configuration (Nikravesh 1988, section 4.2: a revolute joint without rotation).
pub static WELD: Kind = Kind {
    keyword: "weld",
    operands: Operands::of(&[Slot::Counterpart, Slot::Body]),
    example: "`weld (1, 2);`",
    feature: |_, _| Some(Feature::Weld),
    remainders: &[("angle", "`revolute P(1, 2);`")],
    rows,
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let mut rows = REVOLUTE.rows(operands, graph);
    let [i, j] = [0, 1].map(|side| operands.drawn[side].frame.angle);
    let drawn = graph.subtract(j, i);
    rows.push(relative_angle_row(operands, drawn, "angle", graph));
    rows
}
