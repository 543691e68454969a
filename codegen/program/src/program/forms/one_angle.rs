//! Solves a cos φ + b sin φ = c for one angle.
//!
//! With ρ² = a² + b², cos φ and sin φ follow from the root h = ±√((ρ − c)(ρ + c)). The sign of h is the assembly mode, and h is
//! minus the derivative of the equation in φ. Near the fold c = ±ρ, the product keeps all digits of ρ − c, where an arccosine
//! would lose half of them. An equation in the cosine alone, or the sine, gives this function, and the root gives the other one.

use std::sync::Arc;

use linkwright_math::double;

use super::determinant::{length, of_one_angle};
use super::linear::say_again;
use super::{Candidate, Determinant, Form, Solved, Transposed};
use crate::expr::ExprId;
use crate::pool::Pool;
use crate::program::builder::{Builder, Direction};
use crate::program::function::Level;
use crate::words::{Phrase, Piece, Singular, phrase};

/// Equation a cos φ + b sin φ + rest = 0.
#[derive(Clone, Debug)]
struct OneAngle {
    angle: usize,
    cosine: ExprId,
    sine: ExprId,
    rest: ExprId,
    /// Equation in terms of rotated vectors.
    equation: ExprId,
    /// Row of the original equation.
    row: usize,
}

pub(super) fn recognize(candidate: &mut Candidate<'_>) -> Option<Arc<dyn Form>> {
    let (equation, angle) = candidate.single()?;
    let pool = &mut *candidate.pool;
    if !pool.is_turned_by(equation, angle) {
        return None;
    }
    let turned = pool.split(equation, angle)?;
    Some(Arc::new(OneAngle {
        angle,
        cosine: turned.cosine,
        sine: turned.sine,
        rest: turned.rest,
        equation,
        row: candidate.rows[0],
    }))
}

impl Form for OneAngle {
    fn name(&self) -> String {
        "one angle".to_string()
    }

    fn unknowns(&self) -> Vec<usize> {
        vec![self.angle]
    }

    fn determinant(&self, pool: &mut Pool) -> Determinant {
        let parts = [self.cosine, self.sine];
        let value = of_one_angle(self.angle, parts, pool);
        let size = length(parts, pool);
        Determinant::closed(value, size, pool)
    }

    fn singular(&self) -> Singular {
        Singular::Slope {
            angle: self.angle,
            equation: self.equation,
        }
    }

    fn modes(&self) -> Option<usize> {
        Some(2)
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        self.open(builder);
        let zero = builder.graph().zero();
        let is_constant =
            |part: ExprId, builder: &Builder<'_>| builder.pool.graph.is_constant(part);
        let root = match [self.cosine == zero, self.sine == zero] {
            [false, true] if is_constant(self.cosine, builder) => self.by_function(true, builder),
            [true, false] if is_constant(self.sine, builder) => self.by_function(false, builder),
            _ => self.by_both(builder),
        };
        Box::new(Found {
            angle: self.angle,
            root,
            equation: self.equation,
        })
    }
}

impl OneAngle {
    /// Describes the origin of the equation.
    fn open(&self, builder: &mut Builder<'_>) {
        let name = Piece::Unknown(self.angle);
        let row_words = builder.row_words(self.row, &[self.angle]);
        let source = match &row_words {
            Some(words) => phrase![" from ", words],
            None => " from one equation".into(),
        };
        builder.heading(phrase![name.clone(), source]);
        builder.say(|_| match &row_words {
            Some(words) => phrase!["In ", words, ", ", name, " is the only unknown:"],
            None => phrase![
                "In what is left of the block's equations, ",
                name,
                " is the only unknown:"
            ],
        });
        builder.show(|builder| {
            let mut equations = Vec::new();
            if row_words.is_some()
                && let Some(vectors) = builder.vector_equation(self.row)
            {
                equations.push([Piece::Sum(vectors).into(), "0".into(), "as vectors".into()]);
            }
            let joint = builder.system.vector_form.rows[self.row].joint;
            let remark = match row_words {
                Some(_) => builder.origin(&[joint], self.row),
                None => Phrase::default(),
            };
            equations.push([Piece::Formula(self.equation).into(), "0".into(), remark]);
            equations
        });
    }

    /// Returns the mode with the sign of a slope in the design configuration, minus the derivative of the equation.
    fn mode(&self, builder: &mut Builder<'_>) -> ExprId {
        let [a, b] =
            [self.cosine, self.sine].map(|part| builder.system.drawn_value(part, builder.pool));
        let (sine, cosine) =
            double::sin_cos(builder.system.drawn_unknown(self.angle, builder.pool));
        let name = builder.system.unknown_name(self.angle).to_string();
        let meaning = format!(
            "the sign of the slope of the equation, which selects one of two values of {name}"
        );
        let drawn = (a * sine - b * cosine) / a.hypot(b);
        builder.branch(name, meaning, drawn)
    }

    /// Solves a cos φ = c with a constant a, or b sin φ = c, for the direction, and returns the required root.
    fn by_function(&self, by_cosine: bool, builder: &mut Builder<'_>) -> ExprId {
        let (factor, function) = match by_cosine {
            true => (self.cosine, "cosine"),
            false => (self.sine, "sine"),
        };
        builder.say(|_| {
            let name = Piece::Unknown(self.angle);
            phrase![format!("It gives the {function} of "), name, ":"]
        });
        let target = builder.graph().negate(self.rest);
        let known_function = builder.graph().divide(target, factor);
        let known_function =
            builder.angle_function(self.angle, by_cosine, known_function, Phrase::default());
        let graph = builder.graph();
        let one = graph.one();
        let [below, above] = [
            graph.subtract(one, known_function),
            graph.add(one, known_function),
        ];
        let excess = graph.multiply(below, above);
        let excess = builder.factor("excess", excess);
        // A failure is reported in metres if the equation is in metres.
        let ends = {
            let graph = builder.graph();
            let squares = [target, factor].map(|part| graph.multiply(part, part));
            let [distance, longest] = squares.map(|square| graph.sqrt(square));
            [distance, longest, graph.zero()]
        };
        builder.reach(excess, one, ends);
        let branch = self.mode(builder);
        // The slope is a sin φ or −b cos φ, so the other function has the sign of the mode or the opposite one.
        let is_negative = builder.pool.graph.constant_value(factor) < Some(0.0);
        let graph = builder.graph();
        let root = graph.sqrt(excess);
        let other = graph.multiply(branch, root);
        let other = if is_negative == by_cosine {
            graph.negate(other)
        } else {
            other
        };
        let (sine, cosine) =
            double::sin_cos(builder.system.drawn_unknown(self.angle, builder.pool));
        let drawn = if by_cosine { sine } else { cosine };
        let sign = if drawn < 0.0 { "negative" } else { "positive" };
        let remark = format!("{sign} as in the design configuration").into();
        let other = builder.angle_function(self.angle, !by_cosine, other, remark);
        let slope = builder.graph().multiply(factor, other);
        let (direction, root) = match by_cosine {
            true => (
                Direction {
                    cosine: known_function,
                    sine: other,
                },
                slope,
            ),
            false => {
                let root = builder.graph().negate(slope);
                (
                    Direction {
                        cosine: other,
                        sine: known_function,
                    },
                    root,
                )
            }
        };
        builder.angle(self.angle, direction);
        builder.say(|_| {
            let name = Piece::Unknown(self.angle);
            let words = "The sign is the assembly mode; the other one is the second solution for ";
            phrase![words, name, "."]
        });
        root
    }

    /// Solves a cos φ + b sin φ = c with both functions.
    fn by_both(&self, builder: &mut Builder<'_>) -> ExprId {
        builder.say(|_| {
            "It holds a cosine and a sine of one angle, which a square root separates:".into()
        });
        let a = builder.value("a", self.cosine);
        let b = builder.value("b", self.sine);
        let target = builder.graph().negate(self.rest);
        let c = builder.value("c", target);
        builder.show(|builder| {
            let angle = builder.position(self.angle);
            let graph = builder.graph();
            let (cosine, sine) = (graph.cos(angle), graph.sin(angle));
            let parts = [graph.multiply(a, cosine), graph.multiply(b, sine)];
            let left = graph.sum(&parts);
            vec![[
                Piece::Formula(left).into(),
                Piece::Formula(c).into(),
                "".into(),
            ]]
        });
        let radius_square = {
            let graph = builder.graph();
            let squares = [graph.multiply(a, a), graph.multiply(b, b)];
            graph.sum(&squares)
        };
        let radius_square = builder.value("rho^2", radius_square);
        let radius = builder.graph().sqrt(radius_square);
        let radius = builder.value("rho", radius);
        let graph = builder.graph();
        let [below, above] = [graph.subtract(radius, c), graph.add(radius, c)];
        let excess = graph.multiply(below, above);
        let excess = builder.factor("excess", excess);
        // The distance |c| is the root of its square.
        let graph = builder.graph();
        let square = graph.multiply(c, c);
        let (distance, shortest) = (graph.sqrt(square), graph.zero());
        builder.reach(excess, radius_square, [distance, radius, shortest]);
        let branch = self.mode(builder);
        let root = builder.graph().sqrt(excess);
        let root = builder.graph().multiply(branch, root);
        let root = builder.value_with("h", root, "with the sign of the design configuration");
        let graph = builder.graph();
        let [ac, ah] = [graph.multiply(a, c), graph.multiply(a, root)];
        let [bc, bh] = [graph.multiply(b, c), graph.multiply(b, root)];
        let (cosine, sine) = (graph.subtract(ac, bh), graph.add(bc, ah));
        let [cosine, sine] = [cosine, sine].map(|part| graph.divide(part, radius_square));
        let direction = builder.direction(self.angle, cosine, sine, "");
        builder.angle(self.angle, direction);
        builder.say(|_| {
            phrase![
                "Minus the derivative of the left side is ",
                Piece::Local("h".to_string()),
                ". Its sign is the assembly mode; the other one is the second solution."
            ]
        });
        root
    }
}

struct Found {
    angle: usize,
    /// Negative derivative of the equation.
    root: ExprId,
    equation: ExprId,
}

impl Solved for Found {
    fn determinant(&self) -> Option<ExprId> {
        Some(self.root)
    }

    fn transposed(&self, builder: &mut Builder<'_>) -> Option<Transposed> {
        Some(Transposed::One(builder.graph().negate(self.root)))
    }

    fn prepare(&mut self, builder: &mut Builder<'_>) {
        builder.say(|builder| {
            let slope = builder.graph().negate(self.root);
            phrase![
                "Velocity: differentiated, the equation is linear with the coefficient ",
                Piece::Formula(slope),
                ":"
            ]
        });
    }

    fn rates(&self, level: Level, builder: &mut Builder<'_>) {
        say_again(level, builder);
        let drift = builder.drift_at(self.equation, &[self.angle], level);
        let value = builder.graph().divide(drift, self.root);
        builder.find(self.angle, level, value);
    }
}
