//! Solves c u + rest = 0 for one unknown that its equation contains once.

use std::sync::Arc;

use super::{Candidate, Determinant, Form, Solved, Transposed};
use crate::expr::ExprId;
use crate::pool::Pool;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::words::{Piece, Singular, phrase};

/// Equation c u + rest = 0.
#[derive(Clone, Debug)]
struct Linear {
    unknown: usize,
    coefficient: ExprId,
    rest: ExprId,
}

pub(super) fn recognize(candidate: &mut Candidate<'_>) -> Option<Arc<dyn Form>> {
    let (equation, unknown) = candidate.single()?;
    let pool = &mut *candidate.pool;
    let symbol = pool.position(unknown);
    if pool.is_turned_by(equation, unknown) {
        return None;
    }
    let coefficient = pool.graph.derivative(equation, symbol);
    let zero = pool.graph.zero();
    (!pool.graph.depends_on(coefficient, symbol)).then(|| {
        let rest = pool.graph.substitute(equation, &[(symbol, zero)]);
        Arc::new(Linear {
            unknown,
            coefficient,
            rest,
        }) as Arc<dyn Form>
    })
}

impl Form for Linear {
    fn name(&self) -> String {
        "linear".to_string()
    }

    fn unknowns(&self) -> Vec<usize> {
        vec![self.unknown]
    }

    fn determinant(&self, pool: &mut Pool) -> Determinant {
        let value = pool.written_out(self.coefficient);
        let one = pool.graph.one();
        Determinant {
            value: Some(value),
            size: None,
            normalized: pool.graph.is_fixed(value).then_some(one),
            jacobian: Vec::new(),
        }
    }

    fn singular(&self) -> Singular {
        Singular::Coefficient(self.unknown)
    }

    fn modes(&self) -> Option<usize> {
        Some(1)
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        let name = Piece::Unknown(self.unknown);
        builder.heading(phrase![name.clone(), " from a linear equation"]);
        let position = builder.position(self.unknown);
        let product = builder.graph().multiply(self.coefficient, position);
        let equation = builder.graph().add(product, self.rest);
        builder.say(|_| phrase!["The equation is linear in ", name, ":"]);
        builder.show(|_| vec![[Piece::Formula(equation).into(), "0".into(), "".into()]]);
        let coefficient = builder.factor("coefficient", self.coefficient);
        let scale = builder.graph().one();
        builder.nonzero(coefficient, scale);
        let ratio = builder.graph().divide(self.rest, coefficient);
        let value = builder.graph().negate(ratio);
        builder.find(self.unknown, Level::Position, value);
        builder.explicit_angle(self.unknown);
        Box::new(Found {
            unknown: self.unknown,
            coefficient,
            equation,
        })
    }
}

struct Found {
    unknown: usize,
    coefficient: ExprId,
    equation: ExprId,
}

impl Solved for Found {
    fn determinant(&self) -> Option<ExprId> {
        Some(self.coefficient)
    }

    fn transposed(&self, _builder: &mut Builder<'_>) -> Option<Transposed> {
        Some(Transposed::One(self.coefficient))
    }

    fn prepare(&mut self, builder: &mut Builder<'_>) {
        builder.say(|_| {
            phrase![
                "Velocity: differentiated, the equation has the same coefficient ",
                Piece::Formula(self.coefficient),
                ":"
            ]
        });
    }

    fn rates(&self, level: Level, builder: &mut Builder<'_>) {
        say_again(level, builder);
        let drift = builder.drift_at(self.equation, &[self.unknown], level);
        let ratio = builder.graph().divide(drift, self.coefficient);
        let value = builder.graph().negate(ratio);
        builder.find(self.unknown, level, value);
    }
}

/// Describes the acceleration of a single unknown.
pub(super) fn say_again(level: Level, builder: &mut Builder<'_>) {
    if level == Level::Acceleration {
        builder
            .say(|_| "Acceleration: differentiated once more, it has the same coefficient:".into());
    }
}
