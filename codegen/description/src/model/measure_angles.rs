//! Resolves the angles of measures: between bodies, and between links.

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use crate::expr::ExprId;
use crate::syntax::{Expression, Name};

impl Resolver<'_> {
    /// Resolves `relative_angle(a, b)`: the angle of b minus that of a.
    pub(super) fn angle_between(
        &mut self,
        function: &Name,
        bodies: &[Expression],
    ) -> Option<Value> {
        let angles: Vec<Option<ExprId>> = bodies
            .iter()
            .map(|body| {
                let reference = self.written_place(function, body)?;
                let mark = self.turning_mark(&reference)?;
                if mark.frame.body.0 != 0 {
                    self.mention_mark(mark);
                }
                Some(self.linkage.bodies[mark.frame.body.0].frame.angle)
            })
            .collect();
        let (from, to) = (angles[0]?, angles[1]?);
        Some((self.graph.subtract(to, from), Dimension::Angle))
    }

    /// Resolves `transmission_angle(B, C, D)`: the acute angle of the lines CB and CD, from 0 to a right angle.
    pub(super) fn transmission_angle(
        &mut self,
        function: &Name,
        points: &[Expression],
    ) -> Option<Value> {
        let positions: Vec<Option<[ExprId; 2]>> = points
            .iter()
            .map(|point| {
                let reference = self.written_place(function, point)?;
                let mark = self.live_point(&reference)?;
                Some(self.live_position(mark))
            })
            .collect();
        let (before, pin, after) = (positions[0]?, positions[1]?, positions[2]?);
        let graph = &mut self.graph;
        let [first, second] =
            [before, after].map(|end| [0, 1].map(|axis| graph.subtract(end[axis], pin[axis])));
        let mut product = |a: ExprId, b: ExprId| graph.multiply(a, b);
        let along = [0, 1].map(|axis| product(first[axis], second[axis]));
        let across = [product(first[0], second[1]), product(first[1], second[0])];
        let cosine = graph.add(along[0], along[1]);
        let sine = graph.subtract(across[0], across[1]);
        let [sine, cosine] = [sine, cosine].map(|it| graph.magnitude(it));
        Some((graph.atan2(sine, cosine), Dimension::Angle))
    }
}
