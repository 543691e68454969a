//! Gears and belts: the angles of two bodies relative to a carrier keep a ratio.

use super::{Feature, Kind, Mesh, Operands, Quantity, Refusal, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// (φ_j − φ_k − φ_j⁰) ± ratio (φ_i − φ_k − φ_i⁰) = 0 with the carrier k and ratio = r_i/r_j (Haug 1989, section 3.4, for any
/// carrier).
///
/// The angles φ⁰ are relative to the carrier in the design configuration. The sign is plus if the bodies rotate in opposite
/// senses.
pub struct Gear {
    keyword: &'static str,
    example: &'static str,
    /// Kind that corresponds to a negative ratio.
    other: &'static str,
    /// True if the two rotate in opposite senses relative to the carrier.
    opposite: bool,
    /// Connection of the wheels.
    mesh: Mesh,
}

/// Two wheels with external teeth, which rotate in opposite senses.
pub static EXTERNAL_GEAR: Gear = Gear {
    keyword: "external_gear",
    example: "`external_gear (1, 2) = 20mm/40mm;`, with a carrier `external_gear (1, 2, 3) = 20/40;`, or with the force of the teeth `external_gear (1, 2) = 20/40 pressure_angle 20deg;`",
    other: "internal_gear",
    opposite: true,
    mesh: Mesh::External,
};

/// A wheel inside a ring, both rotating in one sense.
pub static INTERNAL_GEAR: Gear = Gear {
    keyword: "internal_gear",
    example: "`internal_gear (1, 2) = 20mm/40mm;`, with a carrier `internal_gear (1, 2, 3) = 20/40;`, or with the force of the teeth `internal_gear (1, 2) = 20/40 pressure_angle 20deg;`",
    other: "external_gear",
    opposite: false,
    mesh: Mesh::Internal,
};

/// Two wheels in an open belt, both rotating in one sense.
pub static BELT: Gear = Gear {
    keyword: "belt",
    example: "`belt (1, 2) = 20mm/40mm;`, or with a carrier `belt (1, 2, 3) = 20/40;`",
    other: "crossed_belt",
    opposite: false,
    mesh: Mesh::Belt,
};

/// Two wheels in a crossed belt, which rotate in opposite senses.
pub static CROSSED_BELT: Gear = Gear {
    keyword: "crossed_belt",
    example: "`crossed_belt (1, 2) = 20mm/40mm;`, or with a carrier `crossed_belt (1, 2, 3) = 20/40;`",
    other: "belt",
    opposite: true,
    mesh: Mesh::CrossedBelt,
};

impl Kind for Gear {
    fn keyword(&self) -> &'static str {
        self.keyword
    }

    fn operands(&self) -> Operands {
        Operands::BODIES_ON_CARRIER
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Power(0))
    }

    fn example(&self) -> &'static str {
        self.example
    }

    fn has_pressure_angle(&self) -> bool {
        matches!(self.mesh, Mesh::External | Mesh::Internal)
    }

    fn feature(&self, operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Wheels(self.mesh, operands.value?))
    }

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        let ratio = graph.constant_value(operands.value?)?;
        if ratio > 0.0 {
            return None;
        }
        let (problem, help) = if ratio < 0.0 {
            (
                "a ratio of radii cannot be negative".to_string(),
                format!(
                    "the sense of turning is in the word: write `{}`",
                    self.other
                ),
            )
        } else {
            (
                "a ratio of zero would only fix the second body".to_string(),
                "the ratio is the first radius over the second: `= 20mm/40mm`".to_string(),
            )
        };
        Some(Refusal { problem, help })
    }

    fn positive(&self, operands: &Resolved, _graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((operands.value?, "the ratio of radii"))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
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
        let residual = if self.opposite {
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
}
