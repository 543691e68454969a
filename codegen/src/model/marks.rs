//! References to bodies and points → marks: where on which body, and where in the drawing.

use super::operands::Given;
use super::resolve::{DrawnPoint, Resolver};
use crate::diagnostic::{Code, Diagnostic};
use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::syntax::{Name, Reference};

impl Resolver<'_> {
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
    pub(super) fn origin_mark(&mut self, reference: &Reference) -> Option<Mark> {
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
    pub(super) fn mark_on(&mut self, body: BodyId, name: &Name) -> Option<Mark> {
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

    /// `P` or `ground.P`: a point of the drawing as the ground carries it.
    pub(super) fn ground_mark(&mut self, reference: &Reference) -> Option<Mark> {
        match &reference.body {
            None => self.mark_on(BodyId::GROUND, &reference.name),
            Some(body) if body.text == "ground" => self.point_mark(reference),
            Some(body) => {
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::WrongForm,
                        reference.span,
                        format!("a point of the ground is wanted here, not one of body `{}`", body.text),
                    )
                    .help("name a point of the drawing; between points of two bodies the distance is `relative_distance`"),
                );
                None
            }
        }
    }

    /// `1.P`, or `1` for the point of the joint's name on it.
    pub(super) fn pin_mark(&mut self, operand: &Reference, given: &Given<'_>) -> Option<Mark> {
        match (&operand.body, given.name) {
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
        }
    }

    /// Where a mark is in the drawing. Turning the local vector of a point given there back again would give the same place in
    /// longer terms.
    pub(super) fn drawn_mark(&mut self, mark: &Mark) -> Vector {
        let body = &self.bodies[mark.frame.body.0];
        if let Some(named) = body.marks.iter().find(|named| named.mark == *mark) {
            return named.drawn;
        }
        let frame = body.drawn;
        let zero = self.graph.zero();
        if mark.local == [zero, zero] {
            return frame.origin;
        }
        Mark::new(frame, mark.local, &mut self.graph).position(&mut self.graph)
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
