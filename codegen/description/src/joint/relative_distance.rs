//! Relative distance: a point of one body keeps its distance from a point of another. Also defines the massless link and the
//! distance driver.

use super::link::{drawn_length, link_rows, refuse_length, squared_row};
use super::{Auxiliary, Feature, Kind, Operands, Quantity, Refusal, Resolved, Row, Value};
use crate::expr::{ExprId, Graph};

/// dᵀd − L² = 0 with d = r_j + R_j s_j − r_i − R_i s_i (Haug 1989, section 3.3).
pub struct RelativeDistance;

/// dᵀd − L² = 0: a link without a body and with a revolute joint at each end; L defaults to the design configuration (Haug
/// 1989, section 3.3).
pub struct RevoluteRevolute;

/// dᵀd − f(t)² = 0 (Haug 1989, section 3.5).
pub struct DistanceDriver;

/// Joint of two points at zero distance.
const PIN: &str = "`revolute (1.P, 2.Q);`";

/// Returns the length as written, or else from the design configuration.
fn length(operands: &Resolved, graph: &mut Graph) -> ExprId {
    match operands.value {
        Some(length) => length,
        None => drawn_length(operands, graph),
    }
}

impl Kind for RelativeDistance {
    fn keyword(&self) -> &'static str {
        "relative_distance"
    }

    fn operands(&self) -> Operands {
        Operands::POINTS
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`relative_distance (1.P, 2.Q) = 2;`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Link)
    }

    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[Auxiliary::LinkAngle]
    }

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        refuse_length(length(operands, graph), PIN, graph)
    }

    fn positive(&self, operands: &Resolved, graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((length(operands, graph), "the distance"))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let length = length(operands, graph);
        squared_row(operands, length, graph)
    }

    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let length = length(operands, graph);
        link_rows(operands, length, graph)
    }
}

impl Kind for RevoluteRevolute {
    fn keyword(&self) -> &'static str {
        "revolute_revolute"
    }

    fn operands(&self) -> Operands {
        Operands::POINTS
    }

    fn value(&self) -> Value {
        Value::OrAsDrawn(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`revolute_revolute (1.P, 2.Q);` or `revolute_revolute (1.P, 2.Q) = 2;`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Link)
    }

    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[Auxiliary::LinkAngle]
    }

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        refuse_length(length(operands, graph), PIN, graph)
    }

    fn positive(&self, operands: &Resolved, graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((length(operands, graph), "the distance"))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        RelativeDistance.rows(operands, graph)
    }

    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        RelativeDistance.vector_rows(operands, graph)
    }
}

impl Kind for DistanceDriver {
    fn keyword(&self) -> &'static str {
        "distance"
    }

    fn operands(&self) -> Operands {
        Operands::POINTS
    }

    fn value(&self) -> Value {
        Value::Required(Quantity::Length)
    }

    fn example(&self) -> &'static str {
        "`drive distance(1.P, 2.Q) = 2 + 0.1*sin(t);`"
    }

    fn feature(&self, _operands: &Resolved, _graph: &mut Graph) -> Option<Feature> {
        Some(Feature::Link)
    }

    fn auxiliaries(&self) -> &'static [Auxiliary] {
        &[Auxiliary::LinkAngle, Auxiliary::Distance]
    }

    fn refusal(&self, operands: &Resolved, graph: &mut Graph) -> Option<Refusal> {
        refuse_length(length(operands, graph), PIN, graph)
    }

    fn positive(&self, operands: &Resolved, graph: &mut Graph) -> Option<(ExprId, &'static str)> {
        Some((length(operands, graph), "the distance"))
    }

    fn rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        RelativeDistance.rows(operands, graph)
    }

    /// Returns the rows of the link with its length ℓ as an unknown, and ℓ − f(t).
    fn vector_rows(&self, operands: &Resolved, graph: &mut Graph) -> Vec<Row> {
        let (Some(value), [_, distance]) = (operands.value, &operands.auxiliaries[..]) else {
            return Vec::new();
        };
        let mut rows = link_rows(operands, distance.value, graph);
        rows.push(Row {
            residual: graph.subtract(distance.value, value),
            quantity: Quantity::Length,
            component: "length",
        });
        rows
    }
}
