//! Lines that statements name → marks and axes.
//!
//! `(1, 2) along P -> Q` between two bodies, `(1, 2.Q) along P -> R` on one body, and `(P, Q)` of a joint written before.

use super::Joint;
use super::operands::Given;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::geometry::{Mark, Vector, dot, subtract};
use crate::joint::{AuxiliaryUnknown, Axis, Slot};
use crate::syntax::{Direction, Reference};

/// The marks, the line and the auxiliary unknowns of a joint written before.
pub(super) type LineOfJoint = (Vec<Mark>, Option<Axis>, Vec<AuxiliaryUnknown>);

impl Resolver<'_> {
    /// `(1, 2) along P -> Q`: P on the first body, Q on the second, the line as drawn.
    pub(super) fn sliding_pair(&mut self, given: &Given<'_>) -> Option<(Vec<Mark>, Axis)> {
        let along = given.along?;
        let ends = [
            (&given.operands[0], &along.from),
            (&given.operands[1], &along.to),
        ];
        let marks: Vec<Option<Mark>> = ends
            .iter()
            .map(|(operand, end)| {
                let origin = self.origin_mark(operand)?;
                let mark = match &end.body {
                    None => self.mark_on(origin.frame.body, &end.name)?,
                    Some(_) => self.point_mark(end)?,
                };
                if mark.frame.body == origin.frame.body {
                    return Some(mark);
                }
                let sliding = &operand.name.text;
                self.diagnostics.push(
                    Diagnostic::error(Code::PointNotOnBody, end.span, format!("this point is not on body `{sliding}`"))
                        .also(operand.span, "the body that slides")
                        .help("name the ends of the line in the order of the bodies: `(1, 2) along P -> Q` has P on 1 and Q on 2"),
                );
                None
            })
            .collect();
        let marks: Vec<Mark> = marks.into_iter().collect::<Option<_>>()?;
        self.different_bodies(&marks, given)?;
        let drawn = [self.drawn_mark(&marks[0]), self.drawn_mark(&marks[1])];
        let direction = self.unit_direction(drawn[0], drawn[1], along.span)?;
        let frames = [0, 1].map(|side| self.bodies[marks[side].frame.body.0].drawn);
        let direction = frames[0].unrotate(direction, &mut self.graph);
        let relative_angle = self.graph.subtract(frames[0].angle, frames[1].angle);
        let turned = marks[0].frame.rotate(direction, &mut self.graph);
        let axis = Axis {
            owner: 0,
            direction,
            turned,
            relative_angle,
        };
        Some((marks, axis))
    }

    /// `(1, 2.Q) along P -> R` with P and R on the body that the operand number `owner` names; P is its mark.
    pub(super) fn line_on_body(
        &mut self,
        slots: &[Slot],
        owner: usize,
        given: &Given<'_>,
    ) -> Option<(Vec<Mark>, Axis)> {
        let along = given.along?;
        let mut marks = self.listed_marks(slots, given)?;
        let frame = marks[owner].frame;
        let ends = [&along.from, &along.to].map(|end| {
            let mark = match &end.body {
                None => self.mark_on(frame.body, &end.name)?,
                Some(_) => self.point_mark(end)?,
            };
            if mark.frame.body == frame.body {
                return Some(mark);
            }
            let name = &self.bodies[frame.body.0].name;
            self.diagnostics.push(
                Diagnostic::error(
                    Code::PointNotOnBody,
                    end.span,
                    format!("this point is not on body `{name}`"),
                )
                .also(
                    given.operands[owner].span,
                    "the body that the line is fixed to",
                )
                .help("both ends of the line are points of that body"),
            );
            None
        });
        let [start, end] = [ends[0]?, ends[1]?];
        let direction = self.unit_direction(start.local, end.local, along.span)?;
        let turned = frame.rotate(direction, &mut self.graph);
        let drawn = [owner, 1 - owner].map(|side| self.bodies[marks[side].frame.body.0].drawn);
        let relative_angle = self.graph.subtract(drawn[0].angle, drawn[1].angle);
        marks[owner] = start;
        let axis = Axis {
            owner,
            direction,
            turned,
            relative_angle,
        };
        Some((marks, axis))
    }

    /// The unit vector from one drawn point to another.
    pub(super) fn unit_direction(
        &mut self,
        from: Vector,
        to: Vector,
        span: Span,
    ) -> Option<Vector> {
        let graph = &mut self.graph;
        let gap = subtract(to, from, graph);
        let square = dot(gap, gap, graph);
        let length = graph.sqrt(square);
        let measured = graph.constant_value(length).unwrap_or(0.0);
        if measured > 0.0 && measured.is_finite() {
            return Some([graph.divide(gap[0], length), graph.divide(gap[1], length)]);
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::DegenerateGeometry,
                span,
                "this direction has no length in the drawing",
            )
            .label("both points are at the same place")
            .help("name two points that are apart in the drawing"),
        );
        None
    }

    /// `(P, Q)`: the line of the one joint that was written `along P -> Q`, and its displacement.
    pub(super) fn existing_line(&mut self, given: &Given<'_>) -> Option<LineOfJoint> {
        let wanted = [&given.operands[0], &given.operands[1]];
        let same = |written: &Reference, end: &Reference| {
            let bodies = match (&written.body, &end.body) {
                (Some(one), Some(other)) => one.text == other.text,
                _ => true,
            };
            bodies && written.name.text == end.name.text
        };
        let matching = |from: &Reference,
                        to: &Reference,
                        joints: &[(Joint, Option<Direction>)]|
         -> Vec<usize> {
            let fits = |along: &Direction| same(from, &along.from) && same(to, &along.to);
            (0..joints.len())
                .filter(|&at| joints[at].1.as_ref().is_some_and(fits))
                .collect()
        };
        let found = matching(wanted[0], wanted[1], &self.joints);
        if let [only] = found[..] {
            let operands = &self.joints[only].0.operands;
            return Some((
                operands.marks.clone(),
                operands.axis,
                operands.auxiliaries.clone(),
            ));
        }
        let span = wanted[0].span.to(wanted[1].span);
        let [p, q] = [&wanted[0].name.text, &wanted[1].name.text];
        let diagnostic = if let Some(&first) = found.first() {
            Diagnostic::error(
                Code::WrongForm,
                span,
                format!("several joints slide along {p} -> {q}"),
            )
            .also(self.joints[first].0.span, "one of them")
            .help("name the points with their bodies: `length(1.P, 2.Q)`")
        } else if let Some(&reverse) = matching(wanted[1], wanted[0], &self.joints).first() {
            Diagnostic::error(
                Code::WrongForm,
                span,
                format!("no joint slides along {p} -> {q}"),
            )
            .also(
                self.joints[reverse].0.span,
                format!("this one slides along {q} -> {p}"),
            )
            .help(format!("write `{}({q}, {p})`", given.kind.keyword()))
        } else {
            Diagnostic::error(
                Code::WrongForm,
                span,
                format!("no joint above slides along {p} -> {q}"),
            )
            .help(format!("write {}", given.kind.example()))
        };
        self.diagnostics.push(diagnostic);
        None
    }
}
