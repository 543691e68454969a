//! Point on a line of another body, or at an offset from it: a pin in a slot, and the massless slider.

use super::geometry::{offset_along, perpendicular, subtract};
use super::{Auxiliary, Feature, Kind, Line, Operands, Quantity, Resolved, Row, Slot, Value};
use crate::expr::{ExprId, Graph};

/// (R_i v)ᵀ (r_j + R_j s_Q − r_i − R_i s_P) = 0, with v across the line through P, fixed in body i (Haug 1989, section 3.3).
pub struct PointOnLine;

/// (R_i v)ᵀ (r_j + R_j s_Q − r_i − R_i s_P) − offset = 0: a link without a body that slides on body i and rotates about Q (Haug
/// 1989, section 3.3).
pub struct RevoluteTranslational;

/// Returns the row of the point across the line, along the unit normal in global components.
fn lateral_row(operands: &Resolved, offset: ExprId, graph: &mut Graph) -> Vec<Row> {
    let Some((axis, i, j)) = operands.along() else {
        return Vec::new();
    };
    let [across, turned] = [axis.direction, axis.turned].map(|along| perpendicular(along, graph));
    let lateral = offset_along(across, turned, &i, &j, graph);
    vec![Row {
        residual: graph.subtract(lateral, offset),
        quantity: Quantity::Length,
        component: "",
    }]
}

/// Returns the rows r_j + R_j s_Q − r_i − R_i s_P − R_i (ℓ u + offset v).
pub(super) fn slot_rows(operands: &Resolved, offset: ExprId, graph: &mut Graph) -> Vec<Row> {
    let (Some((axis, i, j)), [displacement]) = (operands.along(), &operands.auxiliaries[..]) else {
        return Vec::new();
    };
    let [i, j] = [i, j].map(|mark| mark.position(graph));
    let gap = subtract(j, i, graph);
    let across = perpendicular(axis.turned, graph);
    let open = [0, 1].map(|part| {
        let along = graph.multiply(displacement.value, axis.turned[part]);
        let aside = graph.multiply(offset, across[part]);
        let reached = graph.add(along, aside);
        graph.subtract(gap[part], reached)
    });
    let row = |residual, component| Row {
        residual,
        quantity: Quantity::Length,
        component,
    };
    vec![row(open[0], "x"), row(open[1], "y")]
}

/// Returns the offset to the left of the line, as written or else from the design configuration.
fn offset(operands: &Resolved, graph: &mut Graph) -> ExprId {
    match (operands.value, operands.across_in_drawing(graph)) {
        (Some(offset), _) | (None, Some(offset)) => offset,
        (None, None) => graph.zero(),
    }
}

impl Kind for PointOnLine {
    fn keyword(&self) -> &'static str {
        "point_on_line"
    }

    fn operands(&self) -> Operands {
        Operands {
            slots: &[Slot::Point, Slot::Body],
            line: Line::On(1),
        }
    }

    fn value(&self) -> Value {
        Value::None
    }

    fn example(&self) -> &'static str {
        "`point_on_line (2.Q, 1) along P -> R;` with P and R on body 1"
    }

    fn feature(&self, _operands: &Resolved, graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Slot(graph.zero()))
    }

    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[Auxiliary::Displacement]
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let zero = graph.zero();
        lateral_row(operands, zero, graph)
    }

    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let zero = graph.zero();
        slot_rows(operands, zero, graph)
    }
}

impl Kind for RevoluteTranslational {
    fn keyword(&self) -> &'static str {
        "revolute_translational"
    }

    fn operands(&self) -> Operands {
        Operands {
            slots: &[Slot::Body, Slot::Point],
            line: Line::On(0),
        }
    }

    fn value(&self) -> Value {
        Value::OrAsDrawn(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`revolute_translational (1, 2.Q) along P -> R = 20mm;` with P and R on body 1"
    }

    fn feature(&self, operands: &Resolved, graph: &mut Graph) -> Option<Feature> {
        let offset = offset(operands, graph);
        Some(Feature::Slot(offset))
    }

    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[Auxiliary::Displacement]
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let offset = offset(operands, graph);
        lateral_row(operands, offset, graph)
    }

    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let offset = offset(operands, graph);
        slot_rows(operands, offset, graph)
    }
}
