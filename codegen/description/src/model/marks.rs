//! Resolves references to bodies and points into marks and into global positions.

use super::NamedMark;
use super::carriers::Carried;
use super::declared::DrawnPoint;
use super::operands::WrittenJoint;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, nearest};
use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::syntax::{Name, Reference};

impl Resolver<'_> {
    /// Returns the body of this name; `None` after an error.
    pub(super) fn body(&mut self, name: &Name) -> Option<BodyId> {
        if let Some((declaration, body)) = self.declared.body_ids.found(&name.text) {
            self.note_use(name, declaration);
            return Some(body);
        }
        let carriers = self.names_of_carriers(&name.text);
        let diagnostic = self.declared.body_ids.unknown(&name.text, name.span);
        let unfinished = self.declared.unfinished_body.as_ref();
        if let Some(own) = unfinished.filter(|own| own.text == name.text) {
            let message = format!("the body `{}` cannot depend on itself", name.text);
            self.diagnostics.push(
                Diagnostic::error(Code::UnknownName, name.span, message)
                    .label("used before the body is complete")
                    .also(own.span, "declared here")
                    .help("name points on the ground, or on bodies above this one"),
            );
            return None;
        }
        self.diagnostics.push(match carriers.first() {
            Some(body) => diagnostic
                .label("expected a body, found a point")
                .instead(format!("name a body, such as `{body}`, which carries it")),
            None if self.declared.drawn.get(&name.text).is_some() => diagnostic
                .label("expected a body, found a point")
                .instead("a point that no body carries is fixed to the `ground`"),
            None => diagnostic,
        });
        None
    }

    /// Returns the names of the bodies that have a point of this name.
    pub(super) fn names_of_carriers(&self, point: &str) -> Vec<&str> {
        let carriers = self.linkage.carriers.all_of(point);
        carriers
            .map(|(body, _)| self.linkage.bodies[body.0].name.as_str())
            .collect()
    }

    /// Reports a point of bodies that is named without a body.
    pub(super) fn report_without_body(&mut self, name: &Name) {
        let carriers = self.names_of_carriers(&name.text);
        let written: Vec<String> = carriers
            .iter()
            .map(|body| format!("`{body}.{}`", name.text))
            .collect();
        let message = match carriers.as_slice() {
            [body] => format!("the point `{}` is on body `{body}`", name.text),
            _ => format!("several bodies have a point `{}`", name.text),
        };
        let mut diagnostic = Diagnostic::error(Code::PointNotOnBody, name.span, message)
            .label("named without a body");
        for carried in self.linkage.carriers.all_of(&name.text).take(2) {
            diagnostic = diagnostic.also(self.carried(carried).span, "carried here");
        }
        diagnostic = diagnostic.help(format!("write {}", alternatives(&written)));
        if self.declared.drawn.get(&name.text).is_some() {
            diagnostic = diagnostic.help(format!(
                "its design position, fixed to the ground, is `ground.{}`",
                name.text
            ));
        }
        self.diagnostics.push(diagnostic);
    }

    /// Resolves a body named alone, for its origin.
    pub(super) fn origin_mark(&mut self, reference: &Reference) -> Option<Mark> {
        let mark = self.turning_mark(reference)?;
        self.has_place(mark.frame.body, &reference.name)
            .then_some(mark)
    }

    /// Resolves a body or an angle named alone, for its angle.
    pub(super) fn turning_mark(&mut self, reference: &Reference) -> Option<Mark> {
        if reference.body.is_some() {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    reference.span,
                    "expected a body, found one of its points",
                )
                .help(format!(
                    "write `{}`",
                    reference.body.as_ref().map_or("", |body| &body.text)
                )),
            );
            return None;
        }
        let body = self.body(&reference.name)?;
        let frame = self.linkage.bodies[body.0].frame;
        let zero = self.graph.zero();
        Some(Mark::new(frame, [zero, zero], &mut self.graph))
    }

    /// Resolves `BODY` for its origin, `BODY.POINT`, or `POINT` for a global point that is on no body, and thus on the ground.
    pub(super) fn point_mark(&mut self, reference: &Reference) -> Option<Mark> {
        if let Some(body) = &reference.body {
            let body = self.body(body)?;
            return self.mark_on(body, &reference.name);
        }
        let name = &reference.name;
        if self.declared.body_ids.get(&name.text).is_some() {
            return self.origin_mark(reference);
        }
        if !self.names_of_carriers(&name.text).is_empty() {
            self.report_without_body(name);
            return None;
        }
        if self.declared.drawn.get(&name.text).is_some() {
            return self.mark_on_ground(name);
        }
        let bodies = self
            .declared
            .body_ids
            .iter()
            .map(|(name, _)| name.text.as_str());
        let points = self
            .declared
            .drawn
            .iter()
            .map(|(name, _)| name.text.as_str());
        let diagnostic = self.declared.body_ids.unknown(&name.text, name.span);
        self.diagnostics
            .push(match nearest(&name.text, bodies.chain(points)) {
                Some(meant) => diagnostic.instead(format!("did you mean `{meant}`?")),
                None => {
                    diagnostic.instead("declare a body or a point of this name above this line")
                }
            });
        None
    }

    /// Resolves a point of this name on a body. All global points are on the ground.
    pub(super) fn mark_on(&mut self, body: BodyId, name: &Name) -> Option<Mark> {
        let owner = Name {
            text: self.linkage.bodies[body.0].name.clone(),
            span: name.span,
        };
        if !self.has_place(body, &owner) {
            return None;
        }
        let carrier = &self.linkage.bodies[body.0];
        if let Some(at) = self.linkage.carriers.on_body(body, &name.text) {
            return Some(self.carried_mark(name, (body, at)));
        }
        let drawn = self.declared.drawn.declaration(&name.text);
        if let (BodyId::GROUND, Some((declared, point))) = (body, drawn) {
            let (frame, local, declaration) = (carrier.frame, point.position, declared.span);
            self.note_use(name, declaration);
            return Some(Mark::new(frame, local, &mut self.graph));
        }
        let carried_elsewhere = self.linkage.carriers.first_carrier(&name.text).is_some();
        let diagnostic = if body == BodyId::GROUND {
            Diagnostic::error(
                Code::PointNotOnBody,
                name.span,
                format!("point `{}` is not on the ground", name.text),
            )
            .label("no `point` has this name")
            .help(format!(
                "declare its position: `point {} = (x, y);`",
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
            self.declared.drawn.unknown(&name.text, name.span)
        };
        self.diagnostics.push(diagnostic);
        None
    }

    /// Returns a point of a body that is used by its name.
    pub(super) fn carried_mark(&mut self, name: &Name, carried: Carried) -> Mark {
        let &NamedMark { span, mark, .. } = self.carried(carried);
        self.note_use(name, span);
        mark
    }

    /// Resolves a global point that is on no body, including later bodies.
    pub(super) fn mark_on_ground(&mut self, name: &Name) -> Option<Mark> {
        let Some(&(body, place)) = self.declared.carried.get(name.text.as_str()) else {
            return self.mark_on(BodyId::GROUND, name);
        };
        let text = &name.text;
        self.diagnostics.push(
            Diagnostic::error(
                Code::PointNotOnBody,
                name.span,
                format!("the point `{text}` is on body `{body}`, which is declared below"),
            )
            .label("named without a body")
            .also(place, "carried here")
            .help(format!(
                "move this statement below the body, and write `{body}.{text}`"
            ))
            .help(format!(
                "its design position, fixed to the ground, is `ground.{text}`"
            )),
        );
        None
    }

    /// Resolves `P` or `ground.P`: a global point, fixed to the ground.
    pub(super) fn ground_mark(&mut self, reference: &Reference) -> Option<Mark> {
        match &reference.body {
            None => self.mark_on(BodyId::GROUND, &reference.name),
            Some(body) if body.text == "ground" => self.point_mark(reference),
            Some(body) => {
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::WrongForm,
                        reference.span,
                        format!("expected a point of the ground, found one of body `{}`", body.text),
                    )
                    .help("name a point on the ground; between points of two bodies the distance is `relative_distance`"),
                );
                None
            }
        }
    }

    /// Resolves `1.P`, or `1` for the body's point with the joint's name.
    pub(super) fn pin_mark(
        &mut self,
        operand: &Reference,
        given: &WrittenJoint<'_>,
    ) -> Option<Mark> {
        match (&operand.body, given.name) {
            (Some(_), _) => self.point_mark(operand),
            (None, Some(point)) => {
                let body = self.body(&operand.name)?;
                self.mark_on(body, point)
            }
            (None, None) if self.declared.body_ids.get(&operand.name.text).is_none() => {
                self.point_mark(operand)
            }
            (None, None) => {
                let body = self.body(&operand.name)?;
                if !self.has_place(body, &operand.name) {
                    return None;
                }
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::WrongForm,
                        operand.span,
                        "the point of this body is not named",
                    )
                    .help(format!("write {}", given.kind.example)),
                );
                None
            }
        }
    }

    /// Returns the position of a mark in the design configuration. A global point keeps its written position; rotating its
    /// local vector back would give equal but longer terms.
    pub(super) fn drawn_mark(&mut self, mark: &Mark) -> Vector {
        let body = &self.linkage.bodies[mark.frame.body.0];
        if let Some(at) = self.linkage.carriers.at_place(mark.frame.body, mark.local) {
            return body.marks[at].drawn;
        }
        let frame = body.drawn;
        let zero = self.graph.zero();
        if mark.local == [zero, zero] {
            return frame.origin;
        }
        Mark::new(frame, mark.local, &mut self.graph).position(&mut self.graph)
    }

    /// Returns the position, in the design configuration, of a point in an expression or direction.
    pub(super) fn drawn_point(&mut self, reference: &Reference) -> Option<Vector> {
        if reference.body.is_some() {
            let mark = self.point_mark(reference)?;
            return Some(self.drawn_mark(&mark));
        }
        match self.declared.drawn.declaration(&reference.name.text) {
            Some((declared, &DrawnPoint { position, .. })) => {
                self.note_use(&reference.name, declared.span);
                Some(position)
            }
            None => {
                let name = &reference.name.text;
                let carriers = self.names_of_carriers(name);
                let written: Vec<String> = carriers
                    .iter()
                    .map(|body| format!("`{body}.{name}`"))
                    .collect();
                let diagnostic = self.declared.drawn.unknown(name, reference.span);
                self.diagnostics.push(match carriers.as_slice() {
                    [] => diagnostic,
                    [body] => diagnostic.instead(format!(
                        "body `{body}` has a point of this name: write {}",
                        written[0]
                    )),
                    _ => diagnostic.instead(format!(
                        "bodies have points of this name: write {}",
                        alternatives(&written)
                    )),
                });
                None
            }
        }
    }
}

/// Lists a few alternatives for help lines.
fn alternatives(written: &[String]) -> String {
    match written {
        [rest @ .., last] if !rest.is_empty() && rest.len() < 3 => {
            format!("{} or {last}", rest.join(", "))
        }
        _ => written[..written.len().min(3)].join(", "),
    }
}
