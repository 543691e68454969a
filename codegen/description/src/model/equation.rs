//! Resolves `equation` statements into rows.
//!
//! An equation becomes a joint whose marks are the bodies and points in its formulas.

use super::kinematic::KinematicTerms;
use super::live_distance::{WrittenRod, written_rod};
use super::resolve::Resolver;
use super::{Dimension, Joint, Role};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::Mark;
use crate::joint::{Drawn, EQUATION, Formula, Quantity, Refusal, Resolved};
use crate::syntax::Equation;

/// A resolved equation.
struct Stated {
    residual: ExprId,
    quantity: Quantity,
    /// Length of an equivalent rod, with its location; `None` for other equations.
    length: Option<(ExprId, Span)>,
}

impl Resolver<'_> {
    pub(super) fn add_equation(&mut self, equation: &Equation) {
        let name = equation.name.as_ref();
        let duplicate = name.and_then(|name| self.declared.equations.declare(name, ()));
        self.diagnostics.extend(duplicate);
        self.formulas.kinematic = Some(KinematicTerms::default());
        let stated = match written_rod(equation) {
            Some(rod) => self.rod(&rod),
            None => self.sides(equation),
        };
        let kinematic = self.formulas.kinematic.take().unwrap_or_default();
        let Some(Stated {
            residual,
            quantity,
            length,
        }) = stated
        else {
            return;
        };
        let (marks, arms) = self.mentioned_in(residual, kinematic);
        if marks.is_empty() {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    equation.span,
                    "this equation mentions no coordinate",
                )
                .label("restricts nothing")
                .help("an equation is about coordinates and points of bodies: `x(1)`, `phi(1)`, `K.x`"),
            );
            return;
        }
        let drawn = marks
            .iter()
            .map(|mark| Drawn {
                frame: self.linkage.bodies[mark.frame.body.0].drawn,
                position: self.drawn_mark(mark),
            })
            .collect();
        let operands = Resolved {
            marks,
            drawn,
            axis: None,
            curve: None,
            value: length.map(|it| it.0),
            auxiliaries: Vec::new(),
            formula: Some(Formula {
                residual,
                arms,
                quantity,
            }),
        };
        if let (Some((_, place)), Some(Refusal { problem, help })) =
            (length, EQUATION.refusal(&operands, &mut self.graph))
        {
            self.diagnostics
                .push(Diagnostic::error(Code::ValueNotAllowed, place, problem).help(help));
            return;
        }
        self.linkage.equation_count += 1;
        let number = self.linkage.equation_count;
        let (label, slug) = match name {
            Some(name) => (format!("equation {}", name.text), name.text.clone()),
            None => (format!("equation {number}"), format!("equation_{number}")),
        };
        // An equation that depends on time or on an input is a driver.
        let role = match self.moving(residual) {
            Some(_) => Role::Driver,
            None => Role::Constraint,
        };
        let joint = Joint {
            kind: EQUATION,
            role,
            redundant: equation.redundant,
            name: name.map(|name| name.text.clone()),
            name_span: name.map(|name| name.span),
            label,
            slug: self.linkage.unique_slug(&slug),
            docs: equation.docs.clone(),
            operands,
            pressure_angle: None,
            span: equation.span,
        };
        self.linkage.push_joint(joint, None);
    }

    /// Returns left − right.
    fn sides(&mut self, equation: &Equation) -> Option<Stated> {
        // Both sides are resolved even after an error, so that all errors are reported at once.
        let (left, right) = (self.value(&equation.left), self.value(&equation.right));
        let ((left, of_left), (right, of_right)) = (left?, right?);
        if !of_left.fits(of_right) {
            self.report_sides(equation, of_left, of_right);
            return None;
        }
        Some(Stated {
            residual: self.graph.subtract(left, right),
            quantity: of_left.joined(of_right).quantity(),
            length: None,
        })
    }

    /// Returns the square of a distance minus the square of the length.
    fn rod(&mut self, rod: &WrittenRod<'_>) -> Option<Stated> {
        let square = self.square_of_distance(rod.ends);
        let length = self.quantity(rod.length, Dimension::LENGTH);
        let (square, length) = (square?, length?);
        let square_of_length = self.graph.multiply(length, length);
        Some(Stated {
            residual: self.graph.subtract(square, square_of_length),
            quantity: Quantity::Power(2),
            length: self
                .graph
                .is_fixed(length)
                .then_some((length, rod.length.span)),
        })
    }

    /// Returns the marks of bodies that remain in a residual after cancellation, with the symbols of their rotated local
    /// vectors.
    fn mentioned_in(
        &self,
        residual: ExprId,
        kinematic: KinematicTerms,
    ) -> (Vec<Mark>, Vec<Option<[SymbolId; 2]>>) {
        let marks = kinematic.marks.into_iter().zip(kinematic.arms);
        marks
            .filter(|(mark, arm)| {
                let symbols = self.linkage.bodies[mark.frame.body.0].coordinates;
                let symbols = symbols.iter().flatten().map(|it| it.symbol);
                let mut symbols = symbols.chain(arm.iter().flatten().copied());
                symbols.any(|symbol| self.graph.depends_on(residual, symbol))
            })
            .unzip()
    }

    fn report_sides(&mut self, equation: &Equation, left: Dimension, right: Dimension) {
        let finding = Diagnostic::error(
                Code::WrongDimension,
                equation.right.span,
                format!("{} cannot be equal to {}", left.name(), right.name()),
            )
            .label(format!("this is {}", right.name()))
            .also(
                equation.left.span,
                format!("this is {}", left.name()),
            )
            .help("give both sides the same kind of unit: the square of a length, for example, is equal to the square of a length");
        let finding = self.with_declarations(finding, &[&equation.left, &equation.right]);
        self.diagnostics.push(finding);
    }
}
