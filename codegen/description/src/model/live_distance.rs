//! Resolves variable distances, between points of bodies and between positions given by formulas.
//!
//! `distance((X, Y, Z), (X, Y, Z)) = LENGTH` is a rod in space: one scalar equation of squares, as for the distances of the
//! textbook.

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::expr::{ExprId, Rational};
use crate::syntax::{Equation, Expression, ExpressionKind, Name};

/// Rod on one side of an equation.
pub(super) struct WrittenRod<'a> {
    pub ends: [&'a Expression; 2],
    pub length: &'a Expression,
}

/// Returns the rod of an equation; `None` unless one side is a distance with a position given by formulas.
pub(super) fn written_rod(equation: &Equation) -> Option<WrittenRod<'_>> {
    let sides = [
        (&equation.left, &equation.right),
        (&equation.right, &equation.left),
    ];
    sides.into_iter().find_map(|(side, length)| {
        let ExpressionKind::Call {
            function,
            arguments,
        } = &side.kind
        else {
            return None;
        };
        let [from, to] = arguments.as_slice() else {
            return None;
        };
        let ends = [from, to];
        let is_rod = function.text == "distance" && ends.into_iter().any(is_place);
        is_rod.then_some(WrittenRod { ends, length })
    })
}

fn is_place(written: &Expression) -> bool {
    matches!(written.kind, ExpressionKind::Components(_))
}

impl Resolver<'_> {
    /// Returns the variable distance between two points or positions.
    pub(super) fn live_distance(&mut self, ends: [&Expression; 2]) -> Option<Value> {
        if self.formulas.kinematic.as_mut()?.measure().is_some() {
            let gap = self.gap(ends)?;
            let names = ends.map(|end| match &end.kind {
                ExpressionKind::Reference(reference) => reference.name.text.to_lowercase(),
                _ => "place".to_string(),
            });
            let length = self.length_in_measure(names.join("_"), gap)?;
            return Some((length, Dimension::LENGTH));
        }
        let square = self.square_of_distance(ends)?;
        Some((self.graph.sqrt(square), Dimension::LENGTH))
    }

    /// Returns the square of the variable distance.
    pub(super) fn square_of_distance(&mut self, ends: [&Expression; 2]) -> Option<ExprId> {
        let gap = self.gap(ends)?;
        let squares = gap.into_iter();
        let squares = squares.map(|gap| self.graph.power(gap, Rational::integer(2)));
        let squares: Vec<ExprId> = squares.collect();
        Some(self.graph.sum(&squares))
    }

    /// Returns the components of the vector between two positions.
    fn gap(&mut self, ends: [&Expression; 2]) -> Option<Vec<ExprId>> {
        // Both ends are resolved even after an error, so that all errors are reported at once.
        let [from, to] = ends.map(|end| self.live_place(end));
        let (from, to) = (from?, to?);
        if from.len() != to.len() {
            let [one, other] = [from.len(), to.len()];
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    ends[1].span,
                    format!("a position of {other} components has no distance to one of {one}"),
                )
                .label(format!("{other} components"))
                .also(ends[0].span, format!("{one} components"))
                .help("give both in the plane, or both in space"),
            );
            return None;
        }
        let ends = from.into_iter().zip(to);
        let gap = ends.map(|(from, to)| self.graph.subtract(to, from));
        Some(gap.collect())
    }

    /// Returns the components of a position: two of a point, two or three of a tuple of formulas.
    fn live_place(&mut self, end: &Expression) -> Option<Vec<ExprId>> {
        let ExpressionKind::Components(components) = &end.kind else {
            let name = Name {
                text: "distance".to_string(),
                span: end.span,
            };
            let reference = self.written_place(&name, end)?;
            let mark = self.live_point(&reference)?;
            return Some(self.live_position(mark).to_vec());
        };
        let values: Vec<Option<ExprId>> = components
            .iter()
            .map(|part| self.quantity(part, Dimension::LENGTH))
            .collect();
        values.into_iter().collect()
    }
}
