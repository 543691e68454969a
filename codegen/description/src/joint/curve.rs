//! A curve fixed in a frame and the point of it that is touched → its tangent, normal and curvature.
//!
//! All of them follow from p(s) by differentiation. Deliberately unknown here: how the curve was written, and what touches it.

use super::Quantity;
use super::geometry::{BodyFrame, Vector, add, dot, perpendicular};
use crate::expr::{ExprId, Graph, Rational, SymbolId};

/// A curve p(s) of one body and where one joint touches it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// The frame it is fixed in.
    pub frame: BodyFrame,
    /// The x axis of that frame in global components: R (1, 0).
    pub axis: Vector,
    /// s where the joint touches it: a coordinate of the mechanism.
    pub parameter: SymbolId,
    /// What the parameter is measured in.
    pub quantity: Quantity,
    /// The parameter in the drawing.
    pub estimate: ExprId,
    /// p(s), in the frame, in m.
    pub point: Vector,
    /// Where the parameter begins and ends in a drawing.
    pub range: [f64; 2],
    /// 1 where what touches lies to the right of the curve as s grows, as it does outside a curve that turns
    /// counterclockwise; −1 where it lies to the left.
    pub side: ExprId,
}

impl Curve {
    /// R v: a vector of the frame in global components.
    pub fn rotate(&self, v: Vector, graph: &mut Graph) -> Vector {
        let across = perpendicular(self.axis, graph);
        let [along, across] = [(v[0], self.axis), (v[1], across)]
            .map(|(factor, axis)| axis.map(|component| graph.multiply(factor, component)));
        add(along, across, graph)
    }

    /// r + R v: where a point of the frame is.
    pub fn position(&self, v: Vector, graph: &mut Graph) -> Vector {
        let arm = self.rotate(v, graph);
        add(self.frame.origin, arm, graph)
    }

    /// p'(s), in the frame.
    pub fn tangent(&self, graph: &mut Graph) -> Vector {
        self.point
            .map(|component| graph.derivative(component, self.parameter))
    }

    /// The unit vector across the tangent towards what touches, in the frame. There is none where p'(s) vanishes.
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

    /// The curvature towards the side that is not touched, in 1/m: positive for a disc touched from outside.
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
