//! `angle` statements → coordinates that need no body.
//!
//! An angle stands among the bodies: it turns, and has neither place nor points. Deliberately unknown here: what formulas say of it.

use super::Body;
use super::bodies::coordinate_names;
use super::dimension::Dimension;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::joint::geometry::{BodyFrame, BodyId};
use crate::syntax::{Constant, Name};

impl Resolver<'_> {
    pub(super) fn add_angle(&mut self, written: &Constant) {
        let name = &written.name;
        let zero = self.graph.zero();
        let drawn = self.constant(&written.value, Dimension::Angle);
        if !self.may_be_declared(name) || !self.names_angle_alone(name) {
            return;
        }
        let Some(id) = self.new_body(name) else {
            return;
        };
        let [_, _, symbol] = coordinate_names(&name.text);
        let symbol = self.graph.symbol(&symbol);
        let frame = |angle| BodyFrame {
            body: id,
            origin: [zero; 2],
            angle,
        };
        let angle = self.graph.variable(symbol);
        let coordinates = self.linkage.numbered([None, None, Some(symbol)]);
        self.finish_body(
            name,
            Body {
                name: name.text.clone(),
                docs: written.docs.clone(),
                span: name.span,
                frame: frame(angle),
                coordinates,
                drawn: frame(drawn.unwrap_or(zero)),
                marks: Vec::new(),
            },
        );
    }

    /// Whether nothing that a formula could mean has this name already; an error where it has.
    fn names_angle_alone(&mut self, name: &Name) -> bool {
        let carried = self.linkage.carriers.first_carrier(&name.text);
        let taken = [
            self.declared
                .constants
                .declaration(&name.text)
                .map(|it| it.0.span),
            self.declared
                .drawn
                .declaration(&name.text)
                .map(|it| it.0.span),
            carried.map(|carried| self.carried(carried).span),
        ];
        let Some(earlier) = taken.into_iter().flatten().next() else {
            return true;
        };
        self.diagnostics.push(
            Diagnostic::error(
                Code::DuplicateName,
                name.span,
                format!("something else is named `{}`, as this angle", name.text),
            )
            .label("declared again here")
            .also(earlier, "first declared here")
            .help("formulas name an angle alone: give one of them another name"),
        );
        false
    }

    /// Reports a value or a point that is named like an angle above it.
    pub(super) fn is_no_angle(&mut self, name: &Name) -> bool {
        let Some(angle) = self.angle_named(&name.text) else {
            return true;
        };
        let earlier = self.linkage.bodies[angle.0].span;
        self.diagnostics.push(
            Diagnostic::error(
                Code::DuplicateName,
                name.span,
                format!("an angle is named `{}`, too", name.text),
            )
            .label("declared again here")
            .also(earlier, "the angle")
            .help("formulas name an angle alone: give one of them another name"),
        );
        false
    }

    /// The angle of this name.
    pub(super) fn angle_named(&self, name: &str) -> Option<BodyId> {
        let body = *self.declared.body_ids.get(name)?;
        self.linkage.bodies.get(body.0)?.is_angle().then_some(body)
    }

    /// Whether a body has a place; an error for an angle.
    pub(super) fn has_place(&mut self, body: BodyId, name: &Name) -> bool {
        let own = &self.linkage.bodies[body.0];
        if !own.is_angle() {
            return true;
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::WrongForm,
                name.span,
                format!("`{}` is an angle and has no place", name.text),
            )
            .label("a body is wanted here")
            .also(own.span, "declared as an angle")
            .help("what holds an angle is an `equation` of it; what has points is a `body`"),
        );
        false
    }
}
