//! Resolves `angle` statements into coordinates without a body.
//!
//! An angle is listed among the bodies: it rotates, and has neither a position nor points.

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
        let help = "formulas name an angle alone: give one of them another name";
        if !self.may_be_declared(name) || !self.means_nothing_else(name, "angle", help) {
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

    /// True if the name of an angle or a measure has no other meaning in formulas; otherwise reports an error.
    pub(super) fn means_nothing_else(&mut self, name: &Name, sort: &str, help: &str) -> bool {
        let carried = self.linkage.carriers.first_carrier(&name.text);
        let constant = self.declared.constants.declaration(&name.text);
        let drawn = self.declared.drawn.declaration(&name.text);
        let earlier = [
            constant.map(|it| it.0.span),
            drawn.map(|it| it.0.span),
            carried.map(|carried| self.carried(carried).span),
        ];
        let Some(earlier) = earlier.into_iter().flatten().next() else {
            return true;
        };
        self.diagnostics.push(
            Diagnostic::error(
                Code::DuplicateName,
                name.span,
                format!("something else is named `{}`, as this {sort}", name.text),
            )
            .label("declared again here")
            .also(earlier, "first declared here")
            .help(help),
        );
        false
    }

    /// True unless an earlier angle or measure has the name of this value or point, which is reported.
    pub(super) fn is_no_angle(&mut self, name: &Name) -> bool {
        let angle = self.angle_named(&name.text);
        let angle = angle.map(|it| (self.linkage.bodies[it.0].span, "an angle", "the angle"));
        let measure = self.declared.measures.declaration(&name.text);
        let measure = measure.map(|(earlier, _)| (earlier.span, "a measure", "the measure"));
        let Some((earlier, sort, label)) = angle.or(measure) else {
            return true;
        };
        self.diagnostics.push(
            Diagnostic::error(
                Code::DuplicateName,
                name.span,
                format!("{sort} is named `{}`, too", name.text),
            )
            .label("declared again here")
            .also(earlier, label)
            .help(format!(
                "formulas name {sort} alone: give one of them another name"
            )),
        );
        false
    }

    /// Returns the angle of this name.
    pub(super) fn angle_named(&self, name: &str) -> Option<BodyId> {
        let body = *self.declared.body_ids.get(name)?;
        self.linkage.bodies.get(body.0)?.is_angle().then_some(body)
    }

    /// True if a body has a position; reports an error for an angle.
    pub(super) fn has_place(&mut self, body: BodyId, name: &Name) -> bool {
        let body_of_name = &self.linkage.bodies[body.0];
        if !body_of_name.is_angle() {
            return true;
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::WrongForm,
                name.span,
                format!("`{}` is an angle and has no position", name.text),
            )
            .label("expected a body")
            .also(body_of_name.span, "declared as an angle")
            .help("constrain an angle by an `equation`; only a `body` has points"),
        );
        false
    }
}
