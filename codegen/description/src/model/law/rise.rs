//! Builds rises: motions from (x0, h0) to (x1, h1) with the shape of a law.
//!
//! A law is a function y(s) with y(0) = 0 and y(1) = 1. The rise is h0 up to x0, h0 + (h1 − h0) y((x − x0)/(x1 − x0)) up to x1,
//! and h1 from there on.
//!
//! Sources: MSC ADAMS, function reference (STEP, HAVSIN, STEP5); Norton, *Cam Design and Manufacturing Handbook*, chapters 2
//! and 3 (double harmonic and polynomial rises, and the family of sine, constant and cosine acceleration with the modified
//! trapezoid and the modified sine).

use super::super::expression::Value;
use super::super::resolve::Resolver;
use super::Increase;
use crate::diagnostic::Span;
use crate::expr::{ExprId, Graph, Rational};
use crate::syntax::{Expression, Name};

/// Shape of a rise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rise {
    /// 3s² − 2s³: zero velocity at the ends; the acceleration jumps.
    Cubic,
    /// 10s³ − 15s⁴ + 6s⁵: zero velocity and acceleration at the ends.
    Poly345,
    /// 35s⁴ − 84s⁵ + 70s⁶ − 20s⁷: zero velocity, acceleration and jerk at the ends.
    Poly4567,
    /// (1 − cos πs)/2: zero velocity at the ends; the acceleration jumps.
    SimpleHarmonic,
    /// s − sin(2πs)/(2π): zero velocity and acceleration at the ends.
    Cycloidal,
    /// Constant acceleration joined by quarter sines.
    ModifiedTrapezoid,
    /// A slow half wave of acceleration joined to the ends by quarter sines.
    ModifiedSine,
}

/// Fraction of the interval from x0 to x1.
type Share = (i64, i64);

/// y(s) up to a fraction of the interval.
type Piece = (Share, ExprId);

/// A coefficient with its factor.
type Scaled = (ExprId, ExprId);

impl Rise {
    /// Returns the rise of this name; `None` for other names.
    pub(super) fn named(name: &str) -> Option<Rise> {
        Some(match name {
            "step" => Rise::Cubic,
            "step5" | "poly345" => Rise::Poly345,
            "poly4567" => Rise::Poly4567,
            "havsin" | "simple_harmonic" => Rise::SimpleHarmonic,
            "cycloidal" => Rise::Cycloidal,
            "modified_trapezoid" => Rise::ModifiedTrapezoid,
            "modified_sine" => Rise::ModifiedSine,
            _ => return None,
        })
    }

    /// Returns y(s) piece by piece, each with the s up to which it applies; the last one ends at 1.
    fn pieces(self, s: ExprId, graph: &mut Graph) -> Vec<Piece> {
        let whole = match self {
            Rise::Cubic => power_sum(s, &[(2, 3), (3, -2)], graph),
            Rise::Poly345 => power_sum(s, &[(3, 10), (4, -15), (5, 6)], graph),
            Rise::Poly4567 => power_sum(s, &[(4, 35), (5, -84), (6, 70), (7, -20)], graph),
            Rise::SimpleHarmonic => {
                let angle = pi_times((1, 1), s, graph);
                let cosine = graph.cos(angle);
                let (half, one) = (graph.rational(1, 2), graph.one());
                let twice = graph.subtract(one, cosine);
                graph.multiply(half, twice)
            }
            Rise::Cycloidal => {
                let angle = pi_times((2, 1), s, graph);
                let sine = graph.sin(angle);
                let one = graph.one();
                let turn = pi_times((2, 1), one, graph);
                let wave = graph.divide(sine, turn);
                graph.subtract(s, wave)
            }
            Rise::ModifiedTrapezoid => return modified_trapezoid(s, graph),
            Rise::ModifiedSine => return modified_sine(s, graph),
        };
        vec![((1, 1), whole)]
    }

    /// Returns y(s) for s in [0, 1].
    pub(super) fn risen(self, s: ExprId, graph: &mut Graph) -> ExprId {
        let mut pieces = self.pieces(s, graph).into_iter().rev();
        let Some((_, mut risen)) = pieces.next() else {
            return s;
        };
        for ((numerator, denominator), y) in pieces {
            let end = graph.rational(numerator, denominator);
            let left = graph.subtract(s, end);
            risen = graph.choose(left, y, risen);
        }
        risen
    }

    /// Returns the motion from (x0, h0) to (x1, h1), continued after x1 by `after`. The caller handles x before x0.
    pub(super) fn segment(
        self,
        x: ExprId,
        [x0, x1]: [ExprId; 2],
        [h0, h1]: [ExprId; 2],
        after: ExprId,
        graph: &mut Graph,
    ) -> ExprId {
        let (from_start, length) = (graph.subtract(x, x0), graph.subtract(x1, x0));
        let height = graph.subtract(h1, h0);
        let s = graph.divide(from_start, length);
        let mut motion = after;
        for ((numerator, denominator), y) in self.pieces(s, graph).into_iter().rev() {
            let share = graph.rational(numerator, denominator);
            let part = graph.multiply(share, length);
            let left = graph.subtract(from_start, part);
            let risen = graph.multiply(height, y);
            let value = graph.add(h0, risen);
            motion = graph.choose(left, value, motion);
        }
        motion
    }
}

/// Returns Σ coefficient · s^exponent.
fn power_sum(s: ExprId, terms: &[(i64, i64)], graph: &mut Graph) -> ExprId {
    let parts: Vec<ExprId> = terms
        .iter()
        .map(|&(exponent, coefficient)| {
            let power = graph.power(s, Rational::integer(exponent));
            let coefficient = graph.integer(coefficient);
            graph.multiply(coefficient, power)
        })
        .collect();
    graph.sum(&parts)
}

/// Returns a fraction of π times an expression.
fn pi_times((numerator, denominator): (i64, i64), expr: ExprId, graph: &mut Graph) -> ExprId {
    let (fraction, pi) = (graph.rational(numerator, denominator), graph.pi());
    graph.product(&[fraction, pi, expr])
}

/// Returns Σ numerator/denominator · π^exponent.
fn of_pi(parts: &[(i64, i64, i64)], graph: &mut Graph) -> ExprId {
    let parts: Vec<ExprId> = parts
        .iter()
        .map(|&(numerator, denominator, exponent)| {
            let (fraction, pi) = (graph.rational(numerator, denominator), graph.pi());
            let power = graph.power(pi, Rational::integer(exponent));
            graph.multiply(fraction, power)
        })
        .collect();
    graph.sum(&parts)
}

/// Returns (Σ coefficient · part) / divisor.
fn combined(parts: &[Scaled], divisor: ExprId, graph: &mut Graph) -> ExprId {
    let parts: Vec<ExprId> = parts
        .iter()
        .map(|&(coefficient, part)| graph.multiply(coefficient, part))
        .collect();
    let sum = graph.sum(&parts);
    graph.divide(sum, divisor)
}

/// Returns the modified trapezoid. Its acceleration is a quarter sine up to 1/8, 8π/(2 + π) up to 3/8, and half a cosine wave
/// up to 5/8; the rest is the mirror image.
fn modified_trapezoid(s: ExprId, graph: &mut Graph) -> Vec<Piece> {
    let (one, angle) = (graph.one(), pi_times((4, 1), s, graph));
    let (sine, square) = (graph.sin(angle), graph.multiply(s, s));
    let divisor = of_pi(&[(2, 1, 0), (1, 1, 1)], graph);
    let numbers: [&[(i64, i64, i64)]; 11] = [
        &[(2, 1, 0)],
        &[(-1, 2, -1)],
        &[(1, 16, 1), (-1, 2, -1)],
        &[(2, 1, 0), (-1, 1, 1)],
        &[(4, 1, 1)],
        &[(-1, 2, 1)],
        &[(2, 1, 0), (2, 1, 1)],
        &[(1, 2, -1)],
        &[(-33, 16, 1), (1, 2, -1)],
        &[(2, 1, 0), (7, 1, 1)],
        &[(-4, 1, 1)],
    ];
    let [two, ripple, c0, c1, c2, d0, d1, wave, e0, e1, e2] =
        numbers.map(|parts| of_pi(parts, graph));
    let pi = graph.pi();
    let ends: [(Share, &[Scaled]); 5] = [
        ((1, 8), &[(two, s), (ripple, sine)]),
        ((3, 8), &[(c0, one), (c1, s), (c2, square)]),
        ((5, 8), &[(d0, one), (d1, s), (wave, sine)]),
        ((7, 8), &[(e0, one), (e1, s), (e2, square)]),
        ((1, 1), &[(pi, one), (two, s), (ripple, sine)]),
    ];
    ends.map(|(end, parts)| (end, combined(parts, divisor, graph)))
        .to_vec()
}

/// Returns the modified sine. Its acceleration is a quarter sine up to 1/8, half a cosine wave up to 7/8, and a quarter sine up
/// to 1; the maximum is 4π²/(4 + π).
fn modified_sine(s: ExprId, graph: &mut Graph) -> Vec<Piece> {
    let one = graph.one();
    let angle = pi_times((4, 1), s, graph);
    let (slow, phase) = (pi_times((4, 3), s, graph), pi_times((1, 6), one, graph));
    let slow = graph.subtract(slow, phase);
    let (sine, cosine) = (graph.sin(angle), graph.cos(slow));
    let divisor = of_pi(&[(4, 1, 0), (1, 1, 1)], graph);
    let (pi, two, four) = (graph.pi(), graph.integer(2), graph.integer(4));
    let (ripple, wave) = (graph.rational(-1, 4), graph.rational(-9, 4));
    let ends: [(Share, &[Scaled]); 3] = [
        ((1, 8), &[(pi, s), (ripple, sine)]),
        ((7, 8), &[(two, one), (pi, s), (wave, cosine)]),
        ((1, 1), &[(four, one), (pi, s), (ripple, sine)]),
    ];
    ends.map(|(end, parts)| (end, combined(parts, divisor, graph)))
        .to_vec()
}

impl Resolver<'_> {
    /// Evaluates `LAW(x, x0, h0, x1, h1)`.
    pub(super) fn single_rise(
        &mut self,
        rise: Rise,
        law: &Name,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Value> {
        let [_, written_x0, written_h0, written_x1, written_h1] = arguments else {
            let form = format!("{}(x, x0, h0, x1, h1)", law.text);
            self.wrong_count(&law.text, "5 arguments", arguments.len(), &form, span);
            return None;
        };
        let values = self.all_values(arguments)?;
        let [x, x0, h0, x1, h1] = values[..] else {
            return None;
        };
        let like = (&arguments[0], x.1);
        let fits = [
            self.fits_like(written_x0, x0.1, like),
            self.fits_like(written_x1, x1.1, like)
                && self.fits_like(written_x1, x1.1, (written_x0, x0.1)),
            self.fits_like(written_h1, h1.1, (written_h0, h0.1)),
        ];
        let words = Increase {
            problem: "a law of motion must end after it begins",
            label: "not larger than where it begins",
            earlier: "it begins here",
            help: "the arguments are `x, x0, h0, x1, h1` with x1 larger than x0",
        };
        let [begin, end] = [(written_x0, x0.0), (written_x1, x1.0)];
        if fits.contains(&false) || !self.increases(begin, end, &words) {
            return None;
        }
        let graph = &mut self.graph;
        let motion = rise.segment(x.0, [x0.0, x1.0], [h0.0, h1.0], h1.0, graph);
        let before = graph.subtract(x.0, x0.0);
        Some((graph.choose(before, h0.0, motion), h0.1.joined(h1.1)))
    }
}
