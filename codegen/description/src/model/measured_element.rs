//! Resolves the functions of measures about named springs and dampers.
//!
//! Both ends of an element are those of its statement. What an element does is stated as in [`crate::force`].

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::expr::{ExprId, Number, Rational};
use crate::joint::geometry::Mark;
use crate::syntax::{Expression, Name};

/// Named spring or damper.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeasuredElement {
    /// Ends; of an element about a joint, the origins of both bodies.
    pub ends: [Mark; 2],
    /// True for an element about a joint.
    pub turns: bool,
    /// Stiffness or damping.
    pub coefficient: ExprId,
    /// Free length or angle, and preload, of a spring; `None` for a damper.
    pub rest: Option<[ExprId; 2]>,
}

impl Resolver<'_> {
    /// Resolves `length(NAME)`, `tension(NAME)` or `energy(NAME)`.
    pub(super) fn quantity_of_element(
        &mut self,
        function: &Name,
        argument: &Expression,
    ) -> Option<Value> {
        let name = self.name_in_measure(argument, "a spring or damper")?;
        let Some(&element) = self.declared.measured_elements.get(&name.text) else {
            let is_declared = self.declared.elements.declaration(&name.text).is_some();
            if !is_declared {
                let unknown = self.declared.elements.unknown(&name.text, name.span);
                self.diagnostics.push(unknown);
            }
            return None;
        };
        if let Some((declaration, _)) = self.declared.elements.declaration(&name.text) {
            let span = declaration.span;
            self.note_use(&name, span);
        }
        match (function.text.as_str(), element.rest) {
            ("length", _) if element.turns => self.report_element(&name, "length"),
            ("length", _) => self.extent_of_element(&name, &element),
            ("energy", None) => self.report_element(&name, "stored energy"),
            ("energy", Some(rest)) => {
                let [elastic, longer, preload] = self.elongation(&name, &element, rest)?;
                let graph = &mut self.graph;
                let work = graph.multiply(elastic, longer);
                let work = graph.scale(Number::rational(Rational::HALF), work);
                let before = graph.multiply(preload, longer);
                // A joule is a newton meter.
                Some((graph.add(work, before), Dimension::TORQUE))
            }
            (_, Some(rest)) => {
                let [elastic, _, preload] = self.elongation(&name, &element, rest)?;
                Some((self.graph.add(elastic, preload), force_of(&element)))
            }
            (_, None) => {
                let extent = self.extent_of_element(&name, &element)?;
                let (rate, _) = self.rate_in_measure(extent, argument.span)?;
                let tension = self.graph.multiply(element.coefficient, rate);
                Some((tension, force_of(&element)))
            }
        }
    }

    /// Returns the distance between the ends, or the angle of the second body to the first one.
    fn extent_of_element(&mut self, name: &Name, element: &MeasuredElement) -> Option<Value> {
        if element.turns {
            for mark in element.ends.iter().filter(|it| it.frame.body.0 != 0) {
                self.mention_mark(*mark);
            }
            let [from, to] = element.ends.map(|mark| mark.frame.angle);
            return Some((self.graph.subtract(to, from), Dimension::Angle));
        }
        let [from, to] = element.ends.map(|mark| self.live_position(mark));
        let gap = [0, 1].map(|axis| self.graph.subtract(to[axis], from[axis]));
        let length = self.length_in_measure(name.text.to_lowercase(), gap.to_vec())?;
        Some((length, Dimension::LENGTH))
    }

    /// Returns the elastic force or torque, the elongation and the preload of a spring.
    fn elongation(
        &mut self,
        name: &Name,
        element: &MeasuredElement,
        [free, preload]: [ExprId; 2],
    ) -> Option<[ExprId; 3]> {
        let (extent, _) = self.extent_of_element(name, element)?;
        let longer = self.graph.subtract(extent, free);
        let elastic = self.graph.multiply(element.coefficient, longer);
        Some([elastic, longer, preload])
    }

    fn report_element(&mut self, name: &Name, what: &str) -> Option<Value> {
        let message = format!("`{}` has no {what}", name.text);
        self.diagnostics.push(
            Diagnostic::error(Code::WrongForm, name.span, message)
                .help("springs have `energy(…)`, elements between two points `length(…)`, and all `tension(…)`"),
        );
        None
    }
}

/// Returns the dimension of what an element exerts.
fn force_of(element: &MeasuredElement) -> Dimension {
    match element.turns {
        true => Dimension::TORQUE,
        false => Dimension::FORCE,
    }
}
