//! Resolves `free` statements into drivers by a signal, for coordinates moved by forces.
//!
//! The solver supplies value, rate and acceleration of the coordinate, as of an input. All analyses of a driven mechanism
//! therefore apply.

use super::dimension::Dimension;
use super::forces::Free;
use super::parameters::Sort;
use super::resolve::Resolver;
use crate::syntax::{self, Adjustable, Constant, Expression, ExpressionKind, Reference};

impl Resolver<'_> {
    pub(super) fn add_free(&mut self, written: &syntax::Free) {
        let drive = &written.drive;
        let start = Adjustable {
            constant: Constant {
                docs: drive.docs.clone(),
                name: written.name.clone(),
                value: drive.value.clone(),
                span: drive.span,
            },
            range: None,
            tolerance: None,
        };
        let input = self.add_signal(&start, Sort::Free);
        let joint = self.linkage.joints.len();
        // A finding about the signal refers to its initial value.
        let place = drive.value.span;
        let signal = Expression {
            kind: ExpressionKind::Reference(Reference {
                body: None,
                name: written.name.clone(),
                span: place,
            }),
            span: place,
        };
        match input {
            Some(_) => self.add_driven(drive, &signal, true),
            None => return,
        }
        let Some((added, _)) = self.linkage.joints.get(joint) else {
            return;
        };
        let quantity = added.kind.value.quantity();
        let expected = quantity.map(Dimension::of_rate);
        let rate = match (&written.rate, expected) {
            (Some(rate), Some(expected)) => self.constant(rate, expected),
            _ => Some(self.graph.zero()),
        };
        let (Some(input), Some(rate)) = (input, rate) else {
            return;
        };
        let time = self.graph.variable(self.formulas.time);
        let passed = self.graph.multiply(rate, time);
        let supplied = &mut self.declared.inputs[input];
        supplied.signal[0] = self.graph.add(supplied.initial, passed);
        supplied.signal[1] = rate;
        self.forces.free.push(Free {
            joint,
            input,
            span: drive.span,
        });
    }
}
