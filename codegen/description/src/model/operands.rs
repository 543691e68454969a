//! Resolves the operands of joint and drive statements.
//!
//! Every kind defines the form of its operands; nothing else here depends on the kind.

use super::Role;
use super::dimension::Dimension;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::geometry::{BodyId, Mark, subtract};
use crate::joint::{
    Auxiliary, AuxiliaryUnknown, Drawn, Kind, Line, Refusal, Resolved, Slot, Value,
};
use crate::syntax::{Direction, Expression, Name, Reference};

/// A joint or drive statement, as written.
pub(super) struct WrittenJoint<'a> {
    pub kind: &'static Kind,
    pub role: Role,
    /// True if the quantity is free, and thus moved by forces.
    pub is_free: bool,
    pub name: Option<&'a Name>,
    pub operands: &'a [Reference],
    pub along: Option<&'a Direction>,
    pub value: Option<&'a Expression>,
    /// Pressure angle of the teeth; `None` if not written.
    pub pressure_angle: Option<&'a Expression>,
    /// True if the operand is an angle that is named alone.
    pub is_bare: bool,
    /// Location where the part of this statement is placed; `None` outside parts.
    pub placed: Option<Span>,
    pub span: Span,
}

/// True if a required value is present, and no value is present where none is permitted.
fn value_fits(given: &WrittenJoint<'_>) -> bool {
    match given.kind.value {
        Value::None => given.value.is_none(),
        Value::Required(_) => given.value.is_some(),
        Value::OrAsDrawn(_) => true,
    }
}

impl Resolver<'_> {
    /// Resolves the operands in the form of the kind; `None` after an error.
    pub(super) fn operands(&mut self, given: &WrittenJoint<'_>) -> Option<Resolved> {
        let form = given.kind.operands;
        let count = given.operands.len();
        let along_fits = given.along.is_some() == form.is_along();
        if !(form.fewest()..=form.slots.len()).contains(&count) || !along_fits || !value_fits(given)
        {
            self.note_operands(given.operands, given.along, form.line.owners());
            self.report_form(given);
            return None;
        }
        let value = match (given.value, given.kind.value.quantity()) {
            (Some(written), Some(quantity)) => {
                let expected = Dimension::of(quantity);
                let value = match given.role {
                    Role::Constraint => self.constant(written, expected),
                    Role::Driver => self.quantity(written, expected),
                };
                let is_length = expected == Dimension::LENGTH;
                let value =
                    value.filter(|&value| !is_length || self.is_measurable(value, written.span));
                // The operands are resolved even with a wrong value, so that all errors are reported at once.
                value.map(Some)
            }
            _ => Some(None),
        };
        let (marks, axis, shared) = match form.line {
            Line::None => (self.listed_marks(form.slots, given)?, None, Vec::new()),
            Line::Between => {
                let (marks, axis) = self.sliding_pair(given)?;
                (marks, Some(axis), Vec::new())
            }
            Line::On(owner) => {
                let (marks, axis) = self.line_on_body(form.slots, owner, given)?;
                (marks, Some(axis), Vec::new())
            }
            Line::Existing => self.existing_line(given)?,
        };
        let drawn: Vec<Drawn> = marks
            .iter()
            .map(|mark| Drawn {
                frame: self.linkage.bodies[mark.frame.body.0].drawn,
                position: self.drawn_mark(mark),
            })
            .collect();
        let auxiliaries = match form.line {
            Line::Existing => shared,
            _ => AuxiliaryUnknown::of(given.kind, self.linkage.joints.len(), &mut self.graph),
        };
        let curve = form.slots.iter().position(|slot| *slot == Slot::Curve);
        let curve = match curve {
            Some(at) => self.named_curve(&given.operands[at]),
            None => None,
        };
        let touched = curve.map(|curve| {
            let slug = self.unique_slug(given);
            self.touched_curve(&curve, &slug)
        });
        let operands = Resolved {
            marks,
            drawn,
            axis,
            curve: touched,
            value: value?,
            auxiliaries,
            formula: None,
        };
        match given.kind.refusal(&operands, &mut self.graph) {
            None if !self.link_has_direction(given, &operands) => None,
            None => match curve {
                Some(curve) => self.touch(given, &curve, operands),
                None => Some(operands),
            },
            Some(Refusal { problem, help }) => {
                let span = given.value.map_or(given.span, |value| value.span);
                self.diagnostics
                    .push(Diagnostic::error(Code::ValueNotAllowed, span, problem).help(help));
                None
            }
        }
    }

    /// True if the ends of a link are apart in the design configuration, for kinds with a link; otherwise reports an error.
    fn link_has_direction(&mut self, given: &WrittenJoint<'_>, operands: &Resolved) -> bool {
        if !given.kind.auxiliaries.contains(&Auxiliary::LinkAngle) {
            return true;
        }
        let [from, to] = [0, 1].map(|side| operands.drawn[side].position);
        if self.are_apart(from, to) {
            return true;
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::DegenerateGeometry,
                given.span,
                "the two ends of this distance coincide in the design configuration",
            )
            .label("has no direction")
            .help("place the bodies so that the points are apart"),
        );
        false
    }

    /// Returns the mark of every slot; the ground for an omitted carrier.
    pub(super) fn listed_marks(
        &mut self,
        slots: &[Slot],
        given: &WrittenJoint<'_>,
    ) -> Option<Vec<Mark>> {
        let marks: Vec<Option<Mark>> = given
            .operands
            .iter()
            .zip(slots)
            .map(|(operand, slot)| match slot {
                Slot::Turning => self.turning_mark(operand),
                Slot::Body | Slot::Counterpart | Slot::Carrier => self.origin_mark(operand),
                Slot::Point => self.point_mark(operand),
                Slot::Pin => self.pin_mark(operand, given),
                Slot::GroundPoint => self.ground_mark(operand),
                Slot::Curve => {
                    let body = self.named_curve(operand)?.body;
                    let frame = self.linkage.bodies[body.0].frame;
                    Some(Mark::new(frame, [self.graph.zero(); 2], &mut self.graph))
                }
            })
            .collect();
        let mut marks: Vec<Mark> = marks.into_iter().collect::<Option<_>>()?;
        for _ in &slots[marks.len()..] {
            let ground = self.linkage.bodies[BodyId::GROUND.0].frame;
            marks.push(Mark::new(ground, [self.graph.zero(); 2], &mut self.graph));
        }
        self.different_bodies(&marks, given)?;
        let counterpart = slots.iter().position(|slot| *slot == Slot::Counterpart);
        if let Some(at) = counterpart {
            let place = self.drawn_mark(&marks[1 - at]);
            let drawn = self.linkage.bodies[marks[at].frame.body.0].drawn;
            let gap = subtract(place, drawn.origin, &mut self.graph);
            let local = drawn.unrotate(gap, &mut self.graph);
            marks[at] = Mark::new(marks[at].frame, local, &mut self.graph);
        }
        Some(marks)
    }

    fn report_form(&mut self, given: &WrittenJoint<'_>) {
        let keyword = given.kind.keyword;
        let form = given.kind.operands;
        let (fewest, most) = (form.fewest(), form.slots.len());
        let mut help = format!("write {}", given.kind.example);
        let (problem, span) = if !(fewest..=most).contains(&given.operands.len()) {
            let noun = if most == 1 { "operand" } else { "operands" };
            let count = if fewest == most {
                most.to_string()
            } else {
                format!("{fewest} or {most}")
            };
            (
                format!(
                    "`{keyword}` takes {count} {noun}, not {}",
                    given.operands.len()
                ),
                given.span,
            )
        } else if !value_fits(given) {
            match given.value {
                Some(value) => (format!("`{keyword}` takes no value"), value.span),
                None => (format!("`{keyword}` needs a value after `=`"), given.span),
            }
        } else {
            match given.along {
                Some(along) => (format!("`{keyword}` takes no `along`"), along.span),
                None => {
                    let line = match form.line {
                        Line::Between => "the line to slide on",
                        _ => "a line",
                    };
                    if let Some(complete) = self.with_line(given) {
                        help = complete;
                    }
                    (
                        format!("`{keyword}` needs {line}: `along P -> Q`"),
                        given.span,
                    )
                }
            }
        };
        self.diagnostics
            .push(Diagnostic::error(Code::WrongForm, span, problem).help(help));
    }

    /// Returns the help that completes a statement without its line, with points of its bodies if there are enough; `None` if a
    /// body is not declared.
    fn with_line(&self, given: &WrittenJoint<'_>) -> Option<String> {
        let carried = |at: usize| {
            let operand = given.operands.get(at)?;
            let name = operand.body.as_ref().unwrap_or(&operand.name);
            let body = *self.declared.body_ids.get(&name.text)?;
            let marks = self.linkage.bodies[body.0].marks.iter();
            let points: Vec<&str> = marks.map(|it| it.name.as_str()).collect();
            Some((name.text.as_str(), points))
        };
        let (from, to, place) = match given.kind.operands.line {
            Line::Between => {
                let ((first, from), (second, to)) = (carried(0)?, carried(1)?);
                let from = from.first().copied().unwrap_or("P");
                let to = to.last().copied().unwrap_or("Q");
                let place = format!("with {from} on `{first}` and {to} on `{second}`");
                (from, to, place)
            }
            Line::On(owner) => {
                let (body, points) = carried(owner)?;
                let (from, to) = match points.as_slice() {
                    [from, .., to] => (*from, *to),
                    _ => ("P", "R"),
                };
                (from, to, format!("with {from} and {to} on `{body}`"))
            }
            Line::None | Line::Existing => return None,
        };
        let value = if given.value.is_some() { " = …" } else { "" };
        let written = super::joints::label(given);
        Some(format!(
            "write `{written} along {from} -> {to}{value};` {place}"
        ))
    }

    /// Requires a moving body among the operands; `None` after an error.
    fn moves(&mut self, bodies: &[BodyId], given: &WrittenJoint<'_>) -> Option<()> {
        if bodies.iter().any(|body| *body != BodyId::GROUND) {
            return Some(());
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::JointOnOneBody,
                given.span,
                "this constrains only the ground, which does not move",
            )
            .help("name a body that moves, or a point of it: `1.P`"),
        );
        None
    }

    /// Requires different bodies as operands; `None` after an error.
    pub(super) fn different_bodies(
        &mut self,
        marks: &[Mark],
        given: &WrittenJoint<'_>,
    ) -> Option<()> {
        let bodies: Vec<BodyId> = marks.iter().map(|mark| mark.frame.body).collect();
        let twice = (1..bodies.len()).find(|&at| bodies[..at].contains(&bodies[at]));
        let Some(at) = twice else {
            return self.moves(&bodies, given);
        };
        let name = &self.linkage.bodies[bodies[at].0].name;
        let carrier = given.kind.operands.slots.get(at) == Some(&Slot::Carrier);
        let (problem, help) = if carrier {
            (
                format!("body `{name}` cannot be its own carrier"),
                "name a third body as the carrier; without one it is the `ground`",
            )
        } else {
            (
                format!("this joins body `{name}` to itself"),
                "a joint needs two bodies; the fixed frame is called `ground`",
            )
        };
        self.diagnostics
            .push(Diagnostic::error(Code::JointOnOneBody, given.span, problem).help(help));
        None
    }
}
