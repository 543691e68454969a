//! Operands of joint and drive statements → marks and axes.
//!
//! Every kind says which form of operands it takes; nothing here depends on the kind beyond that form.

use super::resolve::{DrawnPoint, Resolver};
use super::{Joint, Role};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::geometry::{BodyId, Mark, Vector, dot, subtract};
use crate::joint::{Axis, Kind, Operands, Resolved};
use crate::syntax::{Direction, Expression, Name, Reference};

use super::dimension::Dimension;

/// What a joint or drive statement gives its kind.
pub(super) struct Given<'a> {
    pub kind: &'static dyn Kind,
    pub role: Role,
    pub name: Option<&'a Name>,
    pub operands: &'a [Reference],
    pub along: Option<&'a Direction>,
    pub value: Option<&'a Expression>,
    pub span: Span,
}

impl Resolver<'_> {
    /// The operands in the form that the kind takes; `None` after an error.
    pub(super) fn operands(&mut self, given: &Given<'_>) -> Option<Resolved> {
        let form = given.kind.operands();
        let count = match form {
            Operands::Body | Operands::Point => 1,
            Operands::PointPair | Operands::BodiesAlong | Operands::AxisOf => 2,
        };
        let along_fits = given.along.is_some() == (form == Operands::BodiesAlong);
        let value_fits = given.value.is_some() == given.kind.value().is_some();
        if given.operands.len() != count || !along_fits || !value_fits {
            self.report_form(given, count);
            return None;
        }
        let value = match (given.value, given.kind.value()) {
            (Some(written), Some(quantity)) => {
                let expected = Dimension::of(quantity);
                let value = match given.role {
                    Role::Constraint => self.constant(written, expected),
                    Role::Driver => self.quantity(written, expected),
                };
                // The operands are looked at even when the value is wrong, so that all errors are reported at once.
                value.map(Some)
            }
            _ => Some(None),
        };
        let (marks, axis) = match form {
            Operands::Body => (vec![self.origin_mark(&given.operands[0])?], None),
            Operands::Point => (vec![self.point_mark(&given.operands[0])?], None),
            Operands::PointPair => (self.point_pair(given)?, None),
            Operands::BodiesAlong => self.sliding_pair(given)?,
            Operands::AxisOf => self.existing_axis(given)?,
        };
        Some(Resolved {
            marks,
            axis,
            value: value?,
        })
    }

    fn report_form(&mut self, given: &Given<'_>, count: usize) {
        let keyword = given.kind.keyword();
        let (problem, span) = if given.operands.len() != count {
            let noun = if count == 1 { "operand" } else { "operands" };
            (
                format!(
                    "`{keyword}` takes {count} {noun}, not {}",
                    given.operands.len()
                ),
                given.span,
            )
        } else if given.value.is_some() != given.kind.value().is_some() {
            match given.value {
                Some(value) => (format!("`{keyword}` takes no value"), value.span),
                None => (format!("`{keyword}` needs a value after `=`"), given.span),
            }
        } else {
            match given.along {
                Some(along) => (format!("`{keyword}` takes no `along`"), along.span),
                None => (
                    format!("`{keyword}` needs the line to slide on: `along P -> Q`"),
                    given.span,
                ),
            }
        };
        self.diagnostics.push(
            Diagnostic::error(Code::WrongForm, span, problem)
                .help(format!("write {}", given.kind.example())),
        );
    }

    /// The body of this name.
    pub(super) fn body(&mut self, name: &Name) -> Option<BodyId> {
        match self.body_ids.get(&name.text) {
            Some(&body) => Some(body),
            None => {
                self.diagnostics
                    .push(self.body_ids.unknown(&name.text, name.span));
                None
            }
        }
    }

    /// A body named alone, for its origin.
    fn origin_mark(&mut self, reference: &Reference) -> Option<Mark> {
        if reference.body.is_some() {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    reference.span,
                    "a body is wanted here, not one of its points",
                )
                .help(format!(
                    "write `{}`",
                    reference.body.as_ref().map_or("", |body| &body.text)
                )),
            );
            return None;
        }
        let body = self.body(&reference.name)?;
        let frame = self.bodies[body.0].frame;
        let zero = self.graph.zero();
        Some(Mark::new(frame, [zero, zero], &mut self.graph))
    }

    /// `BODY` for its origin or `BODY.POINT`.
    pub(super) fn point_mark(&mut self, reference: &Reference) -> Option<Mark> {
        match &reference.body {
            None => self.origin_mark(reference),
            Some(body) => {
                let body = self.body(body)?;
                self.mark_on(body, &reference.name)
            }
        }
    }

    /// The point of this name on a body. The ground carries every drawn point.
    fn mark_on(&mut self, body: BodyId, name: &Name) -> Option<Mark> {
        let carrier = &self.bodies[body.0];
        if let Some(mark) = carrier.marks.iter().find(|mark| mark.name == name.text) {
            return Some(mark.mark);
        }
        let drawn = self.drawn.get(&name.text);
        if let (BodyId::GROUND, Some(point)) = (body, drawn) {
            let (frame, local) = (carrier.frame, point.position);
            return Some(Mark::new(frame, local, &mut self.graph));
        }
        let carried_elsewhere = self
            .bodies
            .iter()
            .any(|body| body.marks.iter().any(|mark| mark.name == name.text));
        let diagnostic = if body == BodyId::GROUND {
            Diagnostic::error(
                Code::PointNotOnBody,
                name.span,
                format!("point `{}` is not on the ground", name.text),
            )
            .label("no drawn point has this name")
            .help(format!(
                "declare where it is: `point {} = (x, y);`",
                name.text
            ))
        } else if drawn.is_some() || carried_elsewhere {
            let add = if drawn.is_some() {
                name.text.clone()
            } else {
                format!("{}: (x, y)", name.text)
            };
            Diagnostic::error(
                Code::PointNotOnBody,
                name.span,
                format!("point `{}` is not on body `{}`", name.text, carrier.name),
            )
            .also(
                carrier.span,
                format!("body `{}` does not list it", carrier.name),
            )
            .help(format!("if the body carries it, add `{add}` to its braces"))
        } else {
            self.drawn.unknown(&name.text, name.span)
        };
        self.diagnostics.push(diagnostic);
        None
    }

    /// `P(1, 2)` or `(1.P, 2.Q)`, in any mixture.
    fn point_pair(&mut self, given: &Given<'_>) -> Option<Vec<Mark>> {
        let marks: Vec<Option<Mark>> = given
            .operands
            .iter()
            .map(|operand| match (&operand.body, given.name) {
                (Some(_), _) => self.point_mark(operand),
                (None, Some(point)) => {
                    let body = self.body(&operand.name)?;
                    self.mark_on(body, point)
                }
                (None, None) => {
                    self.diagnostics.push(
                        Diagnostic::error(
                            Code::WrongForm,
                            operand.span,
                            "the point of this body is not named",
                        )
                        .help(format!("write {}", given.kind.example())),
                    );
                    None
                }
            })
            .collect();
        let marks: Vec<Mark> = marks.into_iter().collect::<Option<_>>()?;
        self.two_bodies(&marks, given)?;
        Some(marks)
    }

    fn two_bodies(&mut self, marks: &[Mark], given: &Given<'_>) -> Option<()> {
        if marks[0].frame.body != marks[1].frame.body {
            return Some(());
        }
        let name = &self.bodies[marks[0].frame.body.0].name;
        self.diagnostics.push(
            Diagnostic::error(
                Code::JointOnOneBody,
                given.span,
                format!("this joins body `{name}` to itself"),
            )
            .help("a joint needs two bodies; the fixed frame is called `ground`"),
        );
        None
    }

    /// `(1, 2) along P -> Q`: P on the first body, Q on the second, the line as drawn.
    fn sliding_pair(&mut self, given: &Given<'_>) -> Option<(Vec<Mark>, Option<Axis>)> {
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
        self.two_bodies(&marks, given)?;
        let drawn = [self.drawn_mark(&marks[0]), self.drawn_mark(&marks[1])];
        let direction = self.unit_direction(drawn[0], drawn[1], along.span)?;
        let frames = [0, 1].map(|side| self.bodies[marks[side].frame.body.0].drawn);
        let direction = frames[0].unrotate(direction, &mut self.graph);
        let relative_angle = self.graph.subtract(frames[0].angle, frames[1].angle);
        let turned = marks[0].frame.rotate(direction, &mut self.graph);
        // No coordinate can have this name: its joint's number begins with a digit.
        let slide = self
            .graph
            .symbol(&format!("{} displacement", self.joints.len()));
        let displacement = self.graph.variable(slide);
        let axis = Axis {
            direction,
            turned,
            displacement,
            relative_angle,
        };
        Some((marks, Some(axis)))
    }

    /// Where a mark is in the drawing. Turning the local vector of a point given there back again would give the same place in
    /// longer terms.
    fn drawn_mark(&mut self, mark: &Mark) -> Vector {
        let body = &self.bodies[mark.frame.body.0];
        if let Some(named) = body.marks.iter().find(|named| named.mark == *mark) {
            return named.drawn;
        }
        let frame = body.drawn;
        Mark::new(frame, mark.local, &mut self.graph).position(&mut self.graph)
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

    /// `(P, Q)`: the axis of the one joint that was written `along P -> Q`.
    fn existing_axis(&mut self, given: &Given<'_>) -> Option<(Vec<Mark>, Option<Axis>)> {
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
            return Some((operands.marks.clone(), operands.axis));
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

    /// A point named in an expression or direction, where it is in the drawing.
    pub(super) fn drawn_point(&mut self, reference: &Reference) -> Option<Vector> {
        if reference.body.is_some() {
            let mark = self.point_mark(reference)?;
            return Some(self.drawn_mark(&mark));
        }
        match self.drawn.get(&reference.name.text) {
            Some(DrawnPoint { position, .. }) => Some(*position),
            None => {
                let diagnostic = self.drawn.unknown(&reference.name.text, reference.span);
                let local = self.bodies.iter().find(|body| {
                    body.marks
                        .iter()
                        .any(|mark| mark.name == reference.name.text)
                });
                self.diagnostics.push(match local {
                    Some(body) => diagnostic.help(format!(
                        "body `{0}` has a point of this name: write `{0}.{1}`",
                        body.name, reference.name.text
                    )),
                    None => diagnostic,
                });
                None
            }
        }
    }
}
