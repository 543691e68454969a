//! Rack and pinion: a wheel rolls without slip on a line of another body; both bodies may move and rotate.

use super::geometry::offset_along;
use super::point_on_line::slot_rows;
use super::{Auxiliary, Feature, Kind, Operands, Quantity, Refusal, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// Returns the term to add to the displacement of the centre: ± radius (φ_i − φ_k − φ⁰) − ℓ⁰.
fn rolled(operands: &Resolved, graph: &mut Graph) -> Option<ExprId> {
    let across = operands.across_in_drawing(graph)?;
    let along = operands.along_in_drawing(graph)?;
    let right = graph.constant_value(across)? < 0.0;
    let radius = match (operands.value, right) {
        (Some(radius), true) => graph.negate(radius),
        (Some(radius), false) => radius,
        // The distance from the line in the design configuration already has this sign.
        (None, _) => across,
    };
    let angle = |side: usize| operands.marks[side].frame.angle;
    let drawn = |side: usize| operands.drawn[side].frame.angle;
    let relative = graph.subtract(angle(0), angle(1));
    let drawn = graph.subtract(drawn(0), drawn(1));
    let turned = graph.subtract(relative, drawn);
    let arc = graph.multiply(radius, turned);
    Some(graph.subtract(arc, along))
}

/// (R_k u)ᵀ (r_i + R_i s_C − r_k − R_k s_P) − ℓ⁰ ± radius (φ_i − φ_k − φ⁰) = 0 (Haug 1989, section 3.4, with both bodies
/// moving).
///
/// The distance rolled since the design configuration equals the displacement of the centre C of the pinion i along the line of
/// the rack k. The sign is plus if the centre lies to the left of the line's direction in the design configuration: a wheel
/// that rolls forward there rotates clockwise.
pub static RACK: Kind = Kind {
    keyword: "rack",
    operands: Operands::POINT_ON_LINE,
    value: Value::OrAsDrawn(Quantity::Length),
    example: "`rack (pinion.C, rack) along P -> Q = 20mm;` with P and Q on the rack, where the teeth meet",
    feature,
    auxiliaries: &[Auxiliary::Displacement, Auxiliary::Offset],
    refusal,
    positive: |operands, _| Some((operands.value?, "the radius of the pinion")),
    rows,
    vector_rows: Some(vector_rows),
    ..Kind::UNSET
};

fn feature(operands: &Resolved, graph: &mut Graph) -> Option<Feature> {
    let radius = match operands.value {
        Some(radius) => radius,
        None => {
            let across = operands.across_in_drawing(graph)?;
            let is_right = graph.constant_value(across)? < 0.0;
            if is_right {
                graph.negate(across)
            } else {
                across
            }
        }
    };
    Some(Feature::Pinion(radius))
}

fn refusal(operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
    let radius = operands.value.and_then(|value| graph.constant_value(value));
    if radius.is_some_and(|radius| radius <= 0.0) {
        return Some(Refusal {
            problem: "the radius of a pinion must be positive".to_string(),
            help: "write it without a sign: the design configuration decides on which side of the line it rolls".to_string(),
        });
    }
    let across = operands.across_in_drawing(graph)?;
    let along = operands.along_in_drawing(graph)?;
    let [across, along] = [across, along].map(|part| graph.constant_value(part));
    // Bound on the rounding error of a distance of zero.
    let least = f64::EPSILON * 8.0 * along?.abs().max(radius.unwrap_or(0.0));
    (across?.abs() <= least).then(|| Refusal {
        problem: "the centre of the pinion lies on the line of the rack in the design configuration".to_string(),
        help: "name points of the rack where the teeth meet: the design configuration decides on which side the pinion rolls".to_string(),
    })
}

fn rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some((axis, rack, pinion)), Some(rolled)) = (operands.along(), rolled(operands, graph))
    else {
        return Vec::new();
    };
    let along = offset_along(axis.direction, axis.turned, &rack, &pinion, graph);
    vec![Row::length(graph.add(along, rolled), "")]
}

/// Returns the rows r_i + R_i s_C − r_k − R_k s_P − R_k (ℓ u + h v) and ℓ − ℓ⁰ ± radius (φ_i − φ_k − φ⁰).
fn vector_rows(operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
    let (Some(rolled), [along, aside]) = (rolled(operands, graph), &operands.auxiliaries[..])
    else {
        return Vec::new();
    };
    let mut rows = slot_rows(operands, aside.value, graph);
    rows.push(Row::length(graph.add(along.value, rolled), "rolling"));
    rows
}
