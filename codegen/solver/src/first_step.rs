//! Computes the first Newton-Raphson step from an estimate, with the equations of the textbook formulation.

use linkwright::Equations;
use linkwright::generated::{Factorization, Scales};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::condition::jacobian;
use crate::textbook::TextbookEquations;

/// Linear system Φ_q Δq = −Φ at a pose of n coordinates.
#[derive(Clone, Debug)]
pub struct FirstStep {
    /// Pose (n).
    pub q: DVector<f64>,
    /// Φ_q (n × n).
    pub jacobian: DMatrix<f64>,
    /// Φ (n).
    pub residual: DVector<f64>,
    /// Δq (n); `None` if Φ_q is singular.
    pub correction: Option<DVector<f64>>,
}

/// Returns the step from the pose `q` at the time `t` (s) (Haug 1989, section 4.5).
pub fn first_step(pool: &Pool, system: &System, q: &[f64], t: f64) -> FirstStep {
    let equations = TextbookEquations::new(pool, system);
    let q = DVector::from_column_slice(q);
    let order = q.len();
    let mut residual = DVector::zeros(order);
    equations.residual(&q, t, &mut residual);
    let jacobian = jacobian(&equations, &q, t);
    let factorization = Factorization::new(&jacobian, &Scales::unit(Dyn(order)), 0.0);
    let correction = factorization.ok().map(|factorization| {
        let mut correction = -&residual;
        factorization.solve(&mut correction);
        correction
    });
    FirstStep {
        q,
        jacobian,
        residual,
        correction: correction.filter(|it| it.iter().all(|value| value.is_finite())),
    }
}

#[cfg(test)]
mod tests {
    use super::first_step;
    use linkwright_codegen::diagnostic::Source;

    /// A crank of length 1 is estimated at 0 and driven to t: φ₁ becomes t, and the rest follows from the tangent.
    #[test]
    fn a_crank_steps_along_its_tangent() {
        let text = "mechanism crank { body 1 at (0, 0) { O: (0, 0) } revolute O(ground, 1); drive phi(1) = t; }";
        let text = text
            .replacen("{", "{ point O = (0, 0);", 1)
            .replace("{ O: (0, 0) }", "{ O }");
        let read = linkwright_codegen::read(&Source::new("crank.mech", &text));
        let derived = read.expect("a description").only().expect("one motion");
        let step = first_step(&derived.pool, &derived.system, &[0.25, -0.5, 0.125], 2.0);
        let correction = step.correction.expect("a regular pose");
        assert_eq!(correction.as_slice(), [-0.25, 0.5, 1.875]);
    }
}
