//! States the checks of a block: positive driven lengths, reach, nonzero divisors, assembly mode, and distance from singular
//! poses.

use super::Builder;
use crate::expr::{ExprId, Number, Rational};
use crate::program::block::{Branch, Measured};
use crate::program::forms::{Form, Solved};
use crate::program::function::Statement;
use crate::program::requirements::driven_length;

/// Reciprocal of the smallest squared sine at which a closed form inside a torn block is used: rounding is then amplified
/// eightfold.
const SLENDER: i128 = 64;

impl Builder<'_> {
    /// Fails if `excess` is not positive relative to `scale`.
    pub fn reach(
        &mut self,
        excess: ExprId,
        scale: ExprId,
        [distance, longest, shortest]: [ExprId; 3],
    ) {
        if self.inside.is_some() {
            // Near a singular pose, rounding is amplified.
            let least = Rational::new(1, SLENDER).unwrap_or(Rational::ONE);
            let graph = self.graph();
            let least = graph.scale(Number::rational(least), scale);
            let excess = graph.subtract(excess, least);
            let zero = graph.zero();
            self.statements.push(Statement::Reach {
                excess,
                scale,
                distance: zero,
                longest: zero,
                shortest: zero,
            });
            return;
        }
        self.statements.push(Statement::Reach {
            excess,
            scale,
            distance,
            longest,
            shortest,
        });
    }

    /// Fails if a divisor vanishes relative to `scale`; constant divisors were checked with the plan.
    pub fn nonzero(&mut self, value: ExprId, scale: ExprId) {
        if !self.pool.graph.is_constant(value) {
            self.statements.push(Statement::Nonzero { value, scale });
        }
    }

    /// Fails if a driven length of these joints is not positive. The first block with the joint has the check.
    pub(in crate::program) fn positive(&mut self, joints: &[usize]) {
        for &joint in joints {
            if !self.driven.contains(&joint)
                && let Some((length, _)) =
                    driven_length(joint, &self.system.mechanism, &mut self.pool.graph)
            {
                self.driven.push(joint);
                self.statements.push(Statement::Positive { length, joint });
            }
        }
    }

    /// Returns a new assembly mode as a factor +1 or −1, with the sign of the sine `drawn` in the design configuration.
    /// Derivations print that sign.
    pub fn branch(&mut self, name: String, meaning: String, drawn: f64) -> ExprId {
        if let Some(inside) = &mut self.inside {
            let symbol = self.pool.intermediate("sign");
            inside.signs.push((symbol, drawn));
            return self.graph().variable(symbol);
        }
        let symbol = self.pool.intermediate("branch");
        self.branches.push(Branch {
            name,
            symbol,
            block: self.place,
            drawn,
            meaning,
        });
        self.graph().variable(symbol)
    }

    /// Records the distance from singular poses of a solved closed form or of a Newton block, as fields.
    pub(in crate::program) fn measure(&mut self, form: &dyn Form, found: &dyn Solved) {
        let names = form.unknowns().into_iter();
        let names: Vec<&str> = names.map(|it| self.system.unknown_name(it)).collect();
        let name = format!("normalized_determinant_{}", names.join("_"));
        let Some(value) = found.determinant() else {
            let both =
                ["", "_condition"].map(|suffix| self.pool.intermediate(&format!("{name}{suffix}")));
            if let Some(Statement::Newton { measure, .. }) = self
                .statements
                .iter_mut()
                .rev()
                .find(|it| matches!(it, Statement::Newton { .. }))
            {
                *measure = Some(both);
            }
            self.measured.push(Measured::Block(both));
            return;
        };
        let size = form.determinant(self.pool).size;
        let measure = match size {
            Some(size) => {
                // A moving length is computed separately; the others belong to a constant.
                let size = self.value("size", size);
                self.graph().divide(value, size)
            }
            None => value,
        };
        // A constant measure is never singular.
        if self.pool.graph.is_fixed(measure) {
            return;
        }
        let target = self.pool.intermediate(&name);
        self.assign(target, measure);
        self.measured.push(match size {
            Some(_) => Measured::Sine(target),
            None => Measured::Slope(target),
        });
    }
}
