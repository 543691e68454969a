//! Resolves `spring` and `damper` statements into loads between two bodies, with constant coefficients.

use std::sync::Arc;

use super::dimension::Dimension;
use super::loads::written_reference;
use super::measured_element::MeasuredElement;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::force::{Damper, Element, Spring, TorsionDamper, TorsionSpring};
use crate::joint::geometry::{Mark, length, subtract};
use crate::syntax::{self, ElementKind};

/// Ends of an element that exerts a torque on bodies or a force on points.
struct Ends {
    marks: [Mark; 2],
    turns: bool,
}

impl Resolver<'_> {
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
        if let Some(name) = &written.name {
            let element = MeasuredElement {
                ends: marks,
                turns,
                coefficient: value,
                rest: (written.kind == ElementKind::Spring).then_some([free, preload]),
            };
            let elements = &mut self.declared.measured_elements;
            elements.entry(name.text.clone()).or_insert(element);
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

    /// Resolves the two ends of a spring or a damper, on two bodies.
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

    /// Returns the distance or the angle between two ends in the design configuration.
    fn drawn_free(&mut self, marks: [Mark; 2], turns: bool) -> ExprId {
        if turns {
            let angles = marks.map(|mark| self.linkage.bodies[mark.frame.body.0].drawn.angle);
            return self.graph.subtract(angles[1], angles[0]);
        }
        let [from, to] = [self.drawn_mark(&marks[0]), self.drawn_mark(&marks[1])];
        let gap = subtract(to, from, &mut self.graph);
        length(gap, &mut self.graph)
    }

    /// True if the ends are apart in the design configuration, so that the line of force is defined; otherwise reports an
    /// error.
    fn ends_apart(&mut self, marks: [Mark; 2], word: &str, span: Span) -> bool {
        let [from, to] = [self.drawn_mark(&marks[0]), self.drawn_mark(&marks[1])];
        if self.are_apart(from, to) {
            return true;
        }
        let message = format!("the two ends of this {word} coincide in the design configuration");
        let help = match word {
            "spring" => {
                "place them apart, or let it rest at zero length without a preload: `free 0`"
            }
            _ => "place them apart; a damper about a joint is written `damper about (1, 2) = …;`",
        };
        self.diagnostics.push(
            Diagnostic::error(Code::DegenerateGeometry, span, message)
                .label("has no direction")
                .help(help),
        );
        false
    }
}
