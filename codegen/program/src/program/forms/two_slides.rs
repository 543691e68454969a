//! Solves ℓ_a d + ℓ_b e + c = 0 with known directions: two lines meet.

use std::sync::Arc;

use super::closing::Closing;
use super::determinant::{crossed, orientation, sizes};
use super::{Candidate, Determinant, Form, Solved, Transposed};
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::pool::Pool;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::words::{Piece, Singular, phrase};

/// Equation ℓ_a d + ℓ_b e + c = 0.
#[derive(Clone, Debug)]
struct TwoSlides {
    /// Displacements ℓ_a and ℓ_b.
    slides: [usize; 2],
    /// Directions d and e.
    directions: [Vector; 2],
    /// Vector c, the known vector that closes the loop.
    closure: Vector,
}

pub(super) fn recognize(candidate: &mut Candidate<'_>) -> Option<Arc<dyn Form>> {
    let (equations, slides) = candidate.pair_of([false, false])?;
    let pool = &mut *candidate.pool;
    let symbols = slides.map(|slide| pool.position(slide));
    let directions =
        symbols.map(|symbol| equations.map(|equation| pool.graph.derivative(equation, symbol)));
    let mut parts = directions.iter().flatten();
    let linear = parts.all(|&part| symbols.iter().all(|&it| !pool.graph.depends_on(part, it)));
    let turns = |equation: &ExprId| slides.iter().any(|&it| pool.is_turned_by(*equation, it));
    if !linear || equations.iter().any(turns) {
        return None;
    }
    let zeros = symbols.map(|symbol| (symbol, pool.graph.zero()));
    let closure = equations.map(|equation| pool.graph.substitute(equation, &zeros));
    Some(Arc::new(TwoSlides {
        slides,
        directions,
        closure,
    }))
}

impl Form for TwoSlides {
    fn name(&self) -> String {
        "PRP or RPP dyad".to_string()
    }

    fn unknowns(&self) -> Vec<usize> {
        self.slides.to_vec()
    }

    fn determinant(&self, pool: &mut Pool) -> Determinant {
        let [(first, d), (second, e)] = self
            .directions
            .map(|direction| orientation(direction, pool));
        let value = crossed([first, second], [d, e], pool);
        let size = sizes([d, e], pool);
        Determinant::closed(value, size, pool)
    }

    fn singular(&self) -> Singular {
        Singular::Lines {
            slides: self.slides,
        }
    }

    fn modes(&self) -> Option<usize> {
        Some(1)
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        let [first, second] = self.slides.map(Piece::Unknown);
        builder.heading(phrase![first, " and ", second, " from two lines"]);
        let lengths = self.slides.map(|slide| builder.position(slide));
        let slid = [0, 1].map(|side| {
            self.directions[side].map(|part| builder.graph().multiply(lengths[side], part))
        });
        builder.say(|_| "The loop closes, as vectors and by components:".into());
        builder.show(|builder| {
            let whole = [0, 1].map(|axis| {
                let parts = [slid[0][axis], slid[1][axis], self.closure[axis]];
                builder.graph().sum(&parts)
            });
            builder.closed_loop(Piece::Sum(whole).into(), whole)
        });
        builder.say(|_| "Two lines of known direction meet. By Cramer's rule:".into());
        let [d, e] = [("d", self.directions[0]), ("e", self.directions[1])]
            .map(|(name, vector)| builder.vector(name, vector));
        let determinant = builder.cross(d, e);
        let remark = Piece::Cross("d".to_string(), "e".to_string());
        let determinant = builder.value_with("D", determinant, remark);
        let scale = builder.graph().one();
        builder.nonzero(determinant, scale);
        let c = builder.vector("c", self.closure);
        let numerators = [builder.cross(e, c), builder.cross(c, d)];
        for (slide, numerator) in self.slides.into_iter().zip(numerators) {
            let value = builder.graph().divide(numerator, determinant);
            builder.find(slide, Level::Position, value);
        }
        let chain = [slid[0], slid[1], self.closure];
        Box::new(Found {
            closing: Closing::new(self.slides, &chain, None, builder),
            columns: [d, e],
            determinant,
        })
    }
}

struct Found {
    closing: Closing,
    columns: [Vector; 2],
    /// Determinant d × e.
    determinant: ExprId,
}

impl Solved for Found {
    fn determinant(&self) -> Option<ExprId> {
        Some(self.determinant)
    }

    fn transposed(&self, _builder: &mut Builder<'_>) -> Option<Transposed> {
        Some(Transposed::Two {
            columns: self.columns,
            determinant: self.determinant,
            arrangement: 0,
            reversed: false,
        })
    }

    fn prepare(&mut self, builder: &mut Builder<'_>) {
        self.closing.say(Piece::Formula(self.determinant), builder);
    }

    fn rates(&self, level: Level, builder: &mut Builder<'_>) {
        let one = builder.graph().one();
        let inverse = builder.graph().divide(one, self.determinant);
        self.closing.solve(self.columns, inverse, level, builder);
    }
}
