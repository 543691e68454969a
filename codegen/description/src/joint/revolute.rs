//! Revolute joint: a point of one body stays on a point of another.

use super::geometry::subtract;
use super::pin_on_arm::PIN_ON_ARM;
use super::{Feature, Kind, Operands, Resolved, Row};
use crate::expr::Graph;

/// r_i + R_i s_i − r_j − R_j s_j = 0 (Haug 1989, section 3.3).
pub static REVOLUTE: Kind = Kind {
    keyword: "revolute",
    operands: Operands::PINS,
    example: "`revolute P(1, 2);` or `revolute (1.P, 2.Q);`",
    feature: |_, _| Some(Feature::Pin),
    joins_points: true,
    remainders: &[
        ("x", "`relative_y(1.P, 2.P) = 0;`"),
        ("y", "`relative_x(1.P, 2.P) = 0;`"),
    ],
    on_arm: Some(&PIN_ON_ARM),
    rows,
    ..Kind::UNSET
};

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let [i, j] = [0, 1].map(|side| operands.marks[side].position(graph));
    Row::gap(subtract(i, j, graph))
}
