//! Resolves `force` and `torque` statements into loads, as formulas of t, inputs, coordinates and rates.

use std::sync::Arc;

use super::dimension::Dimension;
use super::forces::Load;
use super::kinematic::KinematicTerms;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::force::{AppliedForce, AppliedTorque, Element, Terms};
use crate::joint::geometry::{BodyId, Mark};
use crate::syntax::{self, Expression};

impl Resolver<'_> {
    pub(super) fn add_force(&mut self, written: &syntax::Force) {
        let point = self.on_its_carrier(&written.point);
        let point = point.and_then(|point| {
            let mark = self.point_mark(&point)?;
            self.can_be_pushed(&mark, point.span).then_some(mark)
        });
        let axis = match &written.frame {
            None => Some(None),
            Some(name) => self.body(name).map(|body| {
                let along = [self.graph.one(), self.graph.zero()];
                let frame = self.linkage.bodies[body.0].frame;
                Some(Mark::new(frame, along, &mut self.graph))
            }),
        };
        let parts = [&written.components.x, &written.components.y];
        let (values, terms) = self.moving_values(parts, Dimension::FORCE);
        let (Some(point), Some(axis), [Some(x), Some(y)]) = (point, axis, values) else {
            return;
        };
        let element = AppliedForce {
            point,
            components: [x, y],
            axis,
            terms,
        };
        let label = format!("force on {}", written_reference(&written.point));
        self.push_load(Arc::new(element), label, written.span);
    }

    pub(super) fn add_torque(&mut self, written: &syntax::Torque) {
        let body = self.body(&written.body).and_then(|body| {
            let frame = self.linkage.bodies[body.0].frame;
            let origin = Mark::new(frame, [self.graph.zero(); 2], &mut self.graph);
            self.can_be_pushed(&origin, written.body.span)
                .then_some(origin)
        });
        let ([value], terms) = self.moving_values([&written.value], Dimension::TORQUE);
        let (Some(body), Some(value)) = (body, value) else {
            return;
        };
        let element = AppliedTorque { body, value, terms };
        let label = format!("torque on {}", written.body.text);
        self.push_load(Arc::new(element), label, written.span);
    }

    /// Resolves formulas of t, inputs, coordinates and rates, with the points in them.
    fn moving_values<const COUNT: usize>(
        &mut self,
        written: [&Expression; COUNT],
        expected: Dimension,
    ) -> ([Option<ExprId>; COUNT], Terms) {
        self.formulas.kinematic = Some(KinematicTerms::of_load(self.forces.loads.len()));
        let values = written.map(|part| self.quantity(part, expected));
        let kinematic = self.formulas.kinematic.take().unwrap_or_default();
        let terms = Terms {
            marks: kinematic.marks,
            arms: kinematic.arms,
            rated: kinematic.rated,
        };
        (values, terms)
    }

    /// True if a point is on a moving body; otherwise reports an error.
    fn can_be_pushed(&mut self, mark: &Mark, span: Span) -> bool {
        let moves = mark.frame.body != BodyId::GROUND;
        if !moves {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::JointOnOneBody,
                    span,
                    "this acts on the ground, which does not move",
                )
                .help("name a body that moves, or a point of it: `1.P`"),
            );
        }
        moves
    }

    /// True if a value is not negative at the defaults of the parameters; otherwise reports an error.
    pub(super) fn is_not_negative(
        &mut self,
        value: ExprId,
        written: &Expression,
        what: &str,
    ) -> bool {
        let is_negative = self.graph.constant_value(value).is_some_and(|it| it < 0.0);
        if is_negative {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::ValueNotAllowed,
                    written.span,
                    format!("{what} cannot be negative"),
                )
                .help("check the sign"),
            );
        }
        !is_negative
    }

    /// Adds a load.
    pub(super) fn push_load(&mut self, element: Arc<dyn Element>, label: String, span: Span) {
        self.forces.loads.push(Load {
            element,
            label,
            span,
        });
    }
}

/// Returns a reference as written in labels.
pub(super) fn written_reference(reference: &syntax::Reference) -> String {
    match &reference.body {
        Some(body) => format!("{}.{}", body.text, reference.name.text),
        None => reference.name.text.clone(),
    }
}
