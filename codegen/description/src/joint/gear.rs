//! Gears and belts: the angles of two bodies relative to a carrier keep a ratio.
//!
//! (φ_j − φ_k − φ_j⁰) ± ratio (φ_i − φ_k − φ_i⁰) = 0 with the carrier k and ratio = r_i/r_j (Haug 1989, section 3.4, for any
//! carrier). The angles φ⁰ are relative to the carrier in the design configuration. The sign is plus if the bodies rotate in
//! opposite senses.

use super::{Feature, Kind, Mesh, Operands, Quantity, Refusal, Resolved, Row, Value};
use crate::expr::Graph;

/// Two wheels with external teeth, which rotate in opposite senses.
pub static EXTERNAL_GEAR: Kind = Kind {
    keyword: "external_gear",
    operands: Operands::BODIES_ON_CARRIER,
    value: Value::Required(Quantity::Power(0)),
    example: "`external_gear (1, 2) = 20mm/40mm;`, with a carrier `external_gear (1, 2, 3) = 20/40;`, or with the force of the teeth `external_gear (1, 2) = 20/40 pressure_angle 20deg;`",
    has_pressure_angle: true,
    feature: |operands, _| Some(Feature::Wheels(Mesh::External, operands.value?)),
    refusal: |operands, graph| refusal("internal_gear", operands, graph),
    positive: |operands, _| Some((operands.value?, "the ratio of radii")),
    rows: |operands, graph| rows(true, operands, graph),
    ..Kind::UNSET
};

/// A wheel inside a ring, both rotating in one sense.
pub static INTERNAL_GEAR: Kind = Kind {
    keyword: "internal_gear",
    example: "`internal_gear (1, 2) = 20mm/40mm;`, with a carrier `internal_gear (1, 2, 3) = 20/40;`, or with the force of the teeth `internal_gear (1, 2) = 20/40 pressure_angle 20deg;`",
    feature: |operands, _| Some(Feature::Wheels(Mesh::Internal, operands.value?)),
    refusal: |operands, graph| refusal("external_gear", operands, graph),
    rows: |operands, graph| rows(false, operands, graph),
    ..EXTERNAL_GEAR
};

/// Two wheels in an open belt, both rotating in one sense.
pub static BELT: Kind = Kind {
    keyword: "belt",
    example: "`belt (1, 2) = 20mm/40mm;`, or with a carrier `belt (1, 2, 3) = 20/40;`",
    has_pressure_angle: false,
    feature: |operands, _| Some(Feature::Wheels(Mesh::Belt, operands.value?)),
    refusal: |operands, graph| refusal("crossed_belt", operands, graph),
    ..INTERNAL_GEAR
};

/// Two wheels in a crossed belt, which rotate in opposite senses.
pub static CROSSED_BELT: Kind = Kind {
    keyword: "crossed_belt",
    example: "`crossed_belt (1, 2) = 20mm/40mm;`, or with a carrier `crossed_belt (1, 2, 3) = 20/40;`",
    has_pressure_angle: false,
    feature: |operands, _| Some(Feature::Wheels(Mesh::CrossedBelt, operands.value?)),
    refusal: |operands, graph| refusal("belt", operands, graph),
    ..EXTERNAL_GEAR
};

/// Rejects a ratio that is not positive; `other` is the kind that corresponds to a negative one.
fn refusal(other: &str, operands: &Resolved, graph: &Graph) -> Option<Refusal> {
    let ratio = graph.constant_value(operands.value?)?;
    if ratio > 0.0 {
        return None;
    }
    let (problem, help) = if ratio < 0.0 {
        (
            "a ratio of radii cannot be negative".to_string(),
            format!("the sense of turning is in the word: write `{}`", other),
        )
    } else {
        (
            "a ratio of zero would only fix the second body".to_string(),
            "the ratio is the first radius over the second: `= 20mm/40mm`".to_string(),
        )
    };
    Some(Refusal { problem, help })
}

/// Returns the row of two bodies that rotate in opposite senses or in one sense relative to the carrier.
fn rows(is_opposite: bool, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let Some(ratio) = operands.value else {
        return Vec::new();
    };
    // Rotation of each wheel relative to the carrier since the design configuration.
    let [i, j] = [0, 1].map(|side| {
        let angles = [side, 2].map(|at| operands.marks[at].frame.angle);
        let drawn = [side, 2].map(|at| operands.drawn[at].frame.angle);
        let relative = graph.subtract(angles[0], angles[1]);
        let drawn = graph.subtract(drawn[0], drawn[1]);
        graph.subtract(relative, drawn)
    });
    let driven = graph.multiply(ratio, i);
    let residual = if is_opposite {
        graph.add(j, driven)
    } else {
        graph.subtract(j, driven)
    };
    vec![Row {
        residual,
        quantity: Quantity::Angle,
        component: "",
    }]
}
