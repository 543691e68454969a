//! Resolves `mass` and `gravity` statements.

use super::dimension::Dimension;
use super::forces::Mass;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::joint::geometry::{BodyId, Mark};
use crate::syntax::{self, Center};

impl Resolver<'_> {
    pub(super) fn add_mass(&mut self, written: &syntax::Mass) {
        let zero = self.graph.zero();
        let body = self.moving_body(&written.body);
        let body = body.filter(|&it| self.has_place(BodyId(it), &written.body));
        let mass = self.constant(&written.mass, Dimension::MASS);
        let inertia = match &written.inertia {
            Some(inertia) => self.constant(inertia, Dimension::INERTIA),
            None => Some(zero),
        };
        let center = body.and_then(|body| match &written.center {
            None => {
                let frame = self.linkage.bodies[body].frame;
                Some(Mark::new(frame, [zero; 2], &mut self.graph))
            }
            Some(Center::Point(name)) => self.mark_on(BodyId(body), name),
            Some(Center::Local(pair)) => {
                let local = self.pair(pair);
                let frame = self.linkage.bodies[body].frame;
                Some(Mark::new(frame, local, &mut self.graph))
            }
        });
        let (Some(body), Some(mass), Some(inertia), Some(center)) = (body, mass, inertia, center)
        else {
            return;
        };
        let is_possible = self.is_not_negative(mass, &written.mass, "a mass")
            & written
                .inertia
                .as_ref()
                .is_none_or(|it| self.is_not_negative(inertia, it, "a moment of inertia"));
        if !is_possible {
            return;
        }
        let values = [mass, inertia].map(|part| self.graph.constant_value(part));
        if let ([Some(0.0), Some(moment)], Some(place)) = (values, &written.inertia)
            && moment > 0.0
        {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::ValueNotAllowed,
                    place.span,
                    "a body with a moment of inertia needs a mass",
                )
                .also(written.mass.span, "the mass is zero")
                .help("give a body that only turns any mass, with its center on the axis"),
            );
            return;
        }
        let earlier = self.forces.masses.iter().find(|it| it.body == body);
        if let Some(earlier) = earlier {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::DuplicateName,
                    written.body.span,
                    format!("the mass of body `{}` is given twice", written.body.text),
                )
                .label("given again here")
                .also(earlier.span, "first given here")
                .help("remove one of them"),
            );
            return;
        }
        self.forces.masses.push(Mass {
            body,
            mass,
            center,
            inertia,
            span: written.span,
        });
    }

    pub(super) fn add_gravity(&mut self, written: &syntax::Gravity) {
        let pair = &written.acceleration;
        let parts = [&pair.x, &pair.y].map(|part| self.constant(part, Dimension::ACCELERATION));
        let [Some(x), Some(y)] = parts else {
            return;
        };
        if let Some((_, earlier)) = self.gravity {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::DuplicateName,
                    written.span,
                    "the gravity is given twice",
                )
                .label("given again here")
                .also(earlier, "first given here")
                .help("remove one of them"),
            );
            return;
        }
        self.gravity = Some(([x, y], written.span));
    }
}
