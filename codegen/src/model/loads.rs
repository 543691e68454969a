//! `mass`, `gravity`, `spring`, `damper`, `force` and `torque` statements → what bodies weigh and what acts on them.
//!
//! What a spring or a damper is made of does not move; a force or a torque is a formula of t, inputs, coordinates and rates. Deliberately
//! unknown here: which of the forces that follow are wanted.

use std::sync::Arc;

use super::dimension::Dimension;
use super::forces::{Load, Mass};
use super::kinematic::KinematicTerms;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::force::{
    AppliedForce, AppliedTorque, Damper, Element, Spring, Terms, TorsionDamper, TorsionSpring,
};
use crate::joint::geometry::{BodyId, Mark, length, subtract};
use crate::syntax::{self, Center, ElementKind, Expression};

/// What a load is made of that turns bodies, or pulls points.
struct Ends {
    marks: [Mark; 2],
    turns: bool,
}

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
                    "a body without a mass has no moment of inertia",
                )
                .also(written.mass.span, "the mass is zero")
                .help("a body that only turns may have any mass at a center that rests"),
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

    pub(super) fn add_element(&mut self, written: &syntax::Element) {
        let (word, plural) = match written.kind {
            ElementKind::Spring => ("spring", "a stiffness"),
            ElementKind::Damper => ("damper", "a damping"),
        };
        let duplicate = written
            .name
            .as_ref()
            .and_then(|name| self.declared.elements.declare(name, ()));
        self.diagnostics.extend(duplicate);
        let turns = written.about.is_some();
        let [of_value, of_free, of_preload] = match (written.kind, turns) {
            (ElementKind::Spring, false) => {
                [Dimension::STIFFNESS, Dimension::LENGTH, Dimension::FORCE]
            }
            (ElementKind::Spring, true) => [Dimension::TORQUE, Dimension::Angle, Dimension::TORQUE],
            (ElementKind::Damper, false) => {
                [Dimension::DAMPING, Dimension::LENGTH, Dimension::FORCE]
            }
            (ElementKind::Damper, true) => [
                Dimension::ANGULAR_DAMPING,
                Dimension::Angle,
                Dimension::TORQUE,
            ],
        };
        let ends = self.ends_of_element(written, word);
        let value = self.constant(&written.value, of_value);
        let value = value.filter(|&value| self.is_not_negative(value, &written.value, plural));
        let free = written.free.as_ref();
        let free = free.map(|free| (self.constant(free, of_free), free));
        let preload = match &written.preload {
            Some(preload) => self.constant(preload, of_preload),
            None => Some(self.graph.zero()),
        };
        let (Some(Ends { marks, turns }), Some(value), Some(preload)) = (ends, value, preload)
        else {
            return;
        };
        let free = match free {
            None => Some(self.drawn_free(marks, turns)),
            Some((Some(free), place)) if !turns => self
                .is_not_negative(free, place, "a free length")
                .then_some(free),
            Some((free, _)) => free,
        };
        let Some(free) = free else {
            return;
        };
        let zero = self.graph.zero();
        let is_spring = written.kind == ElementKind::Spring && written.free.is_some();
        let rests_at_zero = is_spring && [free, preload] == [zero; 2];
        if !turns && !rests_at_zero && !self.ends_apart(marks, word, written.span) {
            return;
        }
        let element: Arc<dyn Element> = match (written.kind, turns) {
            (ElementKind::Spring, false) => Arc::new(Spring {
                ends: marks,
                stiffness: value,
                free,
                preload,
            }),
            (ElementKind::Spring, true) => Arc::new(TorsionSpring {
                bodies: marks,
                stiffness: value,
                free,
                preload,
            }),
            (ElementKind::Damper, false) => Arc::new(Damper {
                ends: marks,
                damping: value,
            }),
            (ElementKind::Damper, true) => Arc::new(TorsionDamper {
                bodies: marks,
                damping: value,
            }),
        };
        let label = match &written.name {
            Some(name) => format!("{word} {}", name.text),
            None => {
                let operands = written.operands.iter().map(written_reference);
                format!("{word} ({})", operands.collect::<Vec<_>>().join(", "))
            }
        };
        self.push_load(element, label, written.span);
    }

    /// The two ends of a spring or a damper, on two bodies.
    fn ends_of_element(&mut self, written: &syntax::Element, word: &str) -> Option<Ends> {
        let turns = written.about.is_some();
        let example = match turns {
            true => format!("write `{word} about (1, 2) = …;` with the names of two bodies"),
            false => format!("write `{word} (1.P, 2.Q) = …;` with a point of each of two bodies"),
        };
        let [first, second] = &written.operands[..] else {
            let count = written.operands.len();
            let message = format!("a {word} acts on two bodies, not on {count}");
            self.diagnostics
                .push(Diagnostic::error(Code::WrongForm, written.span, message).help(example));
            return None;
        };
        let marks = [first, second].map(|operand| match turns {
            true => self.origin_mark(operand),
            false => self.point_mark(operand),
        });
        let [Some(first), Some(second)] = marks else {
            return None;
        };
        if first.frame.body == second.frame.body {
            let name = &self.linkage.bodies[first.frame.body.0].name;
            let message = format!("both ends of this {word} are on body `{name}`");
            self.diagnostics
                .push(Diagnostic::error(Code::JointOnOneBody, written.span, message).help(example));
            return None;
        }
        let marks = [first, second];
        Some(Ends { marks, turns })
    }

    /// The length or the angle between two ends in the drawing.
    fn drawn_free(&mut self, marks: [Mark; 2], turns: bool) -> ExprId {
        if turns {
            let angles = marks.map(|mark| self.linkage.bodies[mark.frame.body.0].drawn.angle);
            return self.graph.subtract(angles[1], angles[0]);
        }
        let [from, to] = [self.drawn_mark(&marks[0]), self.drawn_mark(&marks[1])];
        let gap = subtract(to, from, &mut self.graph);
        length(gap, &mut self.graph)
    }

    /// Whether the ends are drawn apart, so that there is a line to pull along; an error where not.
    fn ends_apart(&mut self, marks: [Mark; 2], word: &str, span: Span) -> bool {
        let [from, to] = [self.drawn_mark(&marks[0]), self.drawn_mark(&marks[1])];
        if self.are_apart(from, to) {
            return true;
        }
        let message = format!("the two ends of this {word} are drawn at the same place");
        let help = match word {
            "spring" => {
                "draw them apart, or let it rest at zero length without a preload: `free 0`"
            }
            _ => "draw them apart; a damper about a joint is written `damper about (1, 2) = …;`",
        };
        self.diagnostics.push(
            Diagnostic::error(Code::DegenerateGeometry, span, message)
                .label("has no direction in the drawing")
                .help(help),
        );
        false
    }

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

    /// Formulas of t, inputs, coordinates and rates, and the points that they mention.
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
        };
        (values, terms)
    }

    /// Whether a point is on a body that moves; an error where not.
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

    /// Whether a value is not negative, at the defaults of the parameters; an error where it is.
    fn is_not_negative(&mut self, value: ExprId, written: &Expression, what: &str) -> bool {
        let is_negative = self.graph.constant_value(value).is_some_and(|it| it < 0.0);
        if is_negative {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::ValueNotAllowed,
                    written.span,
                    format!("{what} is not negative"),
                )
                .help("is a sign wrong?"),
            );
        }
        !is_negative
    }

    fn push_load(&mut self, element: Arc<dyn Element>, label: String, span: Span) {
        self.forces.loads.push(Load {
            element,
            label,
            span,
        });
    }
}

fn written_reference(reference: &syntax::Reference) -> String {
    match &reference.body {
        Some(body) => format!("{}.{}", body.text, reference.name.text),
        None => reference.name.text.clone(),
    }
}
