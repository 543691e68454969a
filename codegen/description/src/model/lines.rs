//! Resolves lines in statements into marks and axes: `(1, 2) along P -> Q` between two bodies, `(1, 2.Q) along P -> R` on one
//! body, and `(P, Q)` of an earlier joint.

use super::Joint;
use super::loads::written_reference;
use super::operands::WrittenJoint;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{ExprId, Node};
use crate::joint::geometry::{Mark, Vector, length, subtract, tidied};
use crate::joint::{AuxiliaryUnknown, Axis, Slot};
use crate::syntax::{Direction, Reference};

/// Marks, line and auxiliary unknowns of an earlier joint.
pub(super) type LineOfJoint = (Vec<Mark>, Option<Axis>, Vec<AuxiliaryUnknown>);

/// Relative difference of coordinates below which positions are equal up to rounding.
const ROUNDING: f64 = 1e-14;
/// Help for two coincident points.
pub(super) const DISTINCT_POINTS_HELP: &str =
    "name two points that are apart in the design configuration";

impl Resolver<'_> {
    /// Resolves `(1, 2) along P -> Q`: P on the first body, Q on the second, the line of the design configuration.
    pub(super) fn sliding_pair(&mut self, given: &WrittenJoint<'_>) -> Option<(Vec<Mark>, Axis)> {
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
        let sliding = &given.operands[1].name.text;
        let help = format!(
            "place body `{sliding}` further along the line, on the side to which it slides: its pose is an estimate, and a driver may still start at length zero"
        );
        let direction = self.unit_direction(drawn[0], drawn[1], along.span, &help)?;
        let frames = [0, 1].map(|side| self.linkage.bodies[marks[side].frame.body.0].drawn);
        let direction = frames[0].unrotate(direction, &mut self.graph);
        let relative_angle = self.graph.subtract(frames[0].angle, frames[1].angle);
        let turned = marks[0].frame.rotate(direction, &mut self.graph);
        let axis = Axis {
            owner: 0,
            other: 1,
            direction,
            turned,
            relative_angle,
        };
        Some((marks, axis))
    }

    /// Resolves `(1, 2.Q) along P -> R` with P and R on the body of the operand number `owner`; P is its mark.
    pub(super) fn line_on_body(
        &mut self,
        slots: &[Slot],
        owner: usize,
        given: &WrittenJoint<'_>,
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
            let name = &self.linkage.bodies[frame.body.0].name;
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
        let direction =
            self.unit_direction(start.local, end.local, along.span, DISTINCT_POINTS_HELP)?;
        let turned = frame.rotate(direction, &mut self.graph);
        let drawn =
            [owner, 1 - owner].map(|side| self.linkage.bodies[marks[side].frame.body.0].drawn);
        let relative_angle = self.graph.subtract(drawn[0].angle, drawn[1].angle);
        marks[owner] = start;
        let axis = Axis {
            owner,
            other: 1 - owner,
            direction,
            turned,
            relative_angle,
        };
        Some((marks, axis))
    }

    /// Returns the unit vector from one global point to another; `help` applies if they coincide.
    pub(super) fn unit_direction(
        &mut self,
        from: Vector,
        to: Vector,
        span: Span,
        help: &str,
    ) -> Option<Vector> {
        let graph = &mut self.graph;
        let gap = subtract(to, from, graph);
        let length = length(gap, graph);
        let measured = graph.constant_value(length).unwrap_or(0.0);
        if measured > 0.0 && measured.is_finite() && self.are_apart(from, to) {
            let graph = &mut self.graph;
            let along = gap.map(|part| graph.divide(part, length));
            return Some(tidied(along, graph));
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::DegenerateGeometry,
                span,
                "this direction has no length in the design configuration",
            )
            .label("both points are at the same place")
            .help(help),
        );
        None
    }

    /// True if two positions differ by more than the rounding of their roots and sines.
    pub(super) fn are_apart(&self, from: Vector, to: Vector) -> bool {
        let graph = &self.graph;
        let parts = from.into_iter().chain(to);
        if parts
            .clone()
            .all(|part| matches!(graph.node(part), Node::Number(_)))
        {
            return from != to;
        }
        let value = |part: ExprId| graph.constant_value(part).unwrap_or(0.0);
        let gap = (value(to[0]) - value(from[0])).hypot(value(to[1]) - value(from[1]));
        let size = parts.fold(0.0_f64, |most, part| most.max(value(part).abs()));
        gap > ROUNDING * size
    }

    /// Resolves `(P, Q)`: line and displacement of the one joint with `along P -> Q`.
    pub(super) fn existing_line(&mut self, given: &WrittenJoint<'_>) -> Option<LineOfJoint> {
        let points = [&given.operands[0], &given.operands[1]];
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
        for body in points.iter().filter_map(|point| point.body.as_ref()) {
            self.body(body)?;
        }
        let joints_along = matching(points[0], points[1], &self.linkage.joints);
        if let [only] = joints_along[..] {
            let (joint, along) = &self.linkage.joints[only];
            let operands = &joint.operands;
            let line = (
                operands.marks.clone(),
                operands.axis,
                operands.auxiliaries.clone(),
            );
            let ends = along.as_ref().map(ends_of);
            self.note_ends(points, ends);
            return Some(line);
        }
        // The missing joint is explained by an earlier error.
        let is_broken = |along: &Direction| {
            let fits = |from, to| same(from, &along.from) && same(to, &along.to);
            fits(points[0], points[1]) || fits(points[1], points[0])
        };
        if let Some(along) = self.linkage.broken_lines.iter().find(|it| is_broken(it)) {
            self.note_ends(points, Some(ends_of(along)));
            return None;
        }
        let span = points[0].span.to(points[1].span);
        let [p, q] = points.map(written_reference);
        let diagnostic = if let Some(&first) = joints_along.first() {
            Diagnostic::error(
                Code::WrongForm,
                span,
                format!("several joints slide along {p} -> {q}"),
            )
            .also(self.linkage.joints[first].0.span, "one of them")
            .help("name the points with their bodies: `length(1.P, 2.Q)`")
        } else if let Some(&reverse) = matching(points[1], points[0], &self.linkage.joints).first()
        {
            Diagnostic::error(
                Code::WrongForm,
                span,
                format!("no joint slides along {p} -> {q}"),
            )
            .also(
                self.linkage.joints[reverse].0.span,
                format!("this one slides along {q} -> {p}"),
            )
            .help(format!("write `{}({q}, {p})`", given.kind.keyword))
        } else {
            Diagnostic::error(
                Code::WrongForm,
                span,
                format!("no joint above slides along {p} -> {q}"),
            )
            .help(format!("write {}", given.kind.example))
        };
        self.diagnostics.push(diagnostic);
        None
    }

    /// Records that points name the ends of an earlier line.
    fn note_ends(&mut self, points: [&Reference; 2], ends: Option<[Span; 2]>) {
        for (point, end) in points.into_iter().zip(ends.into_iter().flatten()) {
            self.note_use(&point.name, end);
        }
    }
}

/// Returns the source locations of the points at the ends of a line.
fn ends_of(along: &Direction) -> [Span; 2] {
    [&along.from, &along.to].map(|end| end.name.span)
}
