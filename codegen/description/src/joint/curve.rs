//! Represents a curve fixed in a frame with its contact point, and derives tangent, normal and curvature from p(s).

use super::Quantity;
use super::geometry::{BodyFrame, Vector, add, dot, perpendicular};
use crate::expr::{ExprId, Graph, Rational, SymbolId};

/// A curve p(s) of one body, with the contact of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// Frame in which the curve is fixed.
    pub frame: BodyFrame,
    /// x axis of the frame in global components: R (1, 0).
    pub axis: Vector,
    /// Parameter s at the contact: a coordinate of the mechanism.
    pub parameter: SymbolId,
    /// Quantity of the parameter.
    pub quantity: Quantity,
    /// Parameter at the contact in the design configuration.
    pub estimate: ExprId,
    /// p(s) in the frame, in m.
    pub point: Vector,
    /// Range of the parameter in pictures.
    pub range: [f64; 2],
    /// 1 if the touching body lies to the right of the curve as s grows, as outside a curve that turns counterclockwise; −1 if
    /// it lies to the left.
    pub side: ExprId,
}

impl Curve {
    /// Returns R v: a vector of the frame in global components.
    pub fn rotate(&self, v: Vector, graph: &mut Graph) -> Vector {
        let across = perpendicular(self.axis, graph);
        let [along, across] = [(v[0], self.axis), (v[1], across)]
            .map(|(factor, axis)| axis.map(|component| graph.multiply(factor, component)));
        add(along, across, graph)
    }

    /// Returns r + R v: the global position of a point of the frame.
    pub fn position(&self, v: Vector, graph: &mut Graph) -> Vector {
        let arm = self.rotate(v, graph);
        add(self.frame.origin, arm, graph)
    }

    /// Returns p'(s), in the frame.
    pub fn tangent(&self, graph: &mut Graph) -> Vector {
        self.point
            .map(|component| graph.derivative(component, self.parameter))
    }

    /// Returns the unit normal towards the touching body, in the frame. Undefined where p'(s) vanishes.
    pub fn normal(&self, graph: &mut Graph) -> Vector {
        let tangent = self.tangent(graph);
        let left = perpendicular(tangent, graph);
        let square = dot(tangent, tangent, graph);
        let length = graph.sqrt(square);
        let reciprocal = graph.power(length, -Rational::ONE);
        let factor = graph.multiply(self.side, reciprocal);
        let factor = graph.negate(factor);
        left.map(|component| graph.multiply(factor, component))
    }

    /// Returns the curvature in 1/m, positive for a disc touched from outside.
    pub fn curvature(&self, graph: &mut Graph) -> ExprId {
        let first = self.tangent(graph);
        let second = first.map(|component| graph.derivative(component, self.parameter));
        let left = perpendicular(first, graph);
        let turning = dot(left, second, graph);
        let square = dot(first, first, graph);
        let length = graph.sqrt(square);
        let cube = graph.multiply(square, length);
        let curvature = graph.divide(turning, cube);
        graph.multiply(self.side, curvature)
    }
}
