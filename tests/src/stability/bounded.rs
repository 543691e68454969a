//! Bounds the error of expressions in floating point, from exact values and the errors of symbols.
//!
//! Running error analysis (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 3.3): every
//! operation adds its own rounding, and passes on the errors of its operands. Two magnitudes are kept of each error:
//! the largest possible one ([`Margin::worst`]), and the root of its mean square ([`Margin::expected`]). Sums are
//! bounded for every order of their terms. A rounding is half an ε of the result. Sine, cosine and exponential are
//! within one ε, which mathematical libraries promise. Numbers that the scalar holds exactly have no error.

use linkwright_codegen::stages::expr::{ExprId, Factor, Graph, Node, Number};

use super::precise::{Precise, of_number};
use super::verdict::Scalar;

/// Bounds on the error of a computed value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Margin {
    /// Bound on the error.
    pub worst: f64,
    /// Standard deviation for independent, evenly distributed roundings.
    pub expected: f64,
}

impl Margin {
    /// No error.
    pub const NONE: Margin = Margin {
        worst: 0.0,
        expected: 0.0,
    };

    /// Evenly distributed error of at most this magnitude.
    pub fn even(size: f64) -> Margin {
        Margin {
            worst: size.abs(),
            expected: size.abs() / 3.0_f64.sqrt(),
        }
    }

    /// Sum of both errors.
    pub fn plus(self, other: Margin) -> Margin {
        Margin {
            worst: self.worst + other.worst,
            expected: self.expected.hypot(other.expected),
        }
    }

    /// Error of a multiple; zero times anything is zero.
    pub fn times(self, factor: f64) -> Margin {
        if factor == 0.0 {
            return Margin::NONE;
        }
        Margin {
            worst: self.worst * factor.abs(),
            expected: self.expected * factor.abs(),
        }
    }
}

/// Product in which zero times anything, also infinity, is zero.
pub fn product_of(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

/// Rounding error of a number in the scalar.
fn literal(number: &Number, scalar: Scalar) -> Margin {
    let kept = Precise::from_f64(scalar.round(number.to_f64()));
    Margin::even(of_number(number).minus(&kept).to_f64())
}

/// Power, error and number of roundings of base ^ exponent.
fn power(base: f64, error: Margin, factor: &Factor) -> (f64, Margin, f64) {
    let exponent = factor.exponent.to_f64();
    let value = base.powf(exponent);
    let steps = factor.exponent.numerator().unsigned_abs() as f64;
    let roots = if factor.exponent.denominator() == 1 {
        0.0
    } else {
        1.0
    };
    let roundings = (steps - 1.0) + roots + if exponent < 0.0 { 1.0 } else { 0.0 };
    if error.worst == 0.0 {
        return (value, Margin::NONE, roundings);
    }
    let slope = exponent * base.powf(exponent - 1.0);
    // The slope is largest at one end of the range of the base; beyond zero it has no bound unless the power is
    // whole.
    let (low, high) = (base.abs() - error.worst, base.abs() + error.worst);
    let steepest = |at: f64| (exponent * at.powf(exponent - 1.0)).abs();
    let worst = if exponent >= 1.0 {
        steepest(high)
    } else if low > 0.0 {
        steepest(low)
    } else {
        f64::INFINITY
    };
    let margin = Margin {
        worst: worst * error.worst,
        expected: error.expected * slope.abs(),
    };
    (value, margin, roundings)
}

/// Errors of the nodes in `order` (operands first), by the node's index. `values` are the exact values of the nodes,
/// `symbols` the errors of the symbols.
pub fn errors(
    graph: &Graph,
    order: &[ExprId],
    values: &[f64],
    symbols: &[Margin],
    scalar: Scalar,
) -> Vec<Margin> {
    let epsilon = scalar.epsilon();
    let unit = epsilon / 2.0;
    let rounding = |size: f64| scalar.rounding(size);
    let mut all = vec![Margin::NONE; graph.node_count()];
    for &id in order {
        let error = |id: &ExprId| all[id.index()];
        let value = |id: &ExprId| values[id.index()];
        let node_value = values[id.index()];
        all[id.index()] = match graph.node(id) {
            Node::Number(number) => literal(number, scalar),
            Node::Pi => Margin::even(unit * node_value),
            Node::Symbol(symbol) => symbols[symbol.index()],
            Node::Sum(terms) => {
                let (mut sum, mut sizes, mut count) = (Margin::NONE, 0.0, 0.0_f64);
                for term in terms.iter() {
                    let coefficient = term.coefficient.to_f64();
                    let addend = coefficient * value(&term.expr);
                    sum = sum.plus(error(&term.expr).times(coefficient));
                    // A factor that is a power of two is exact.
                    if coefficient.abs().log2().fract() != 0.0 && value(&term.expr) != 1.0 {
                        let factor = literal(&term.coefficient, scalar).times(value(&term.expr));
                        sum = sum.plus(factor).plus(rounding(addend));
                    } else if value(&term.expr) == 1.0 {
                        sum = sum.plus(literal(&term.coefficient, scalar));
                    }
                    if addend != 0.0 {
                        sizes += addend.abs();
                        count += 1.0;
                    }
                }
                // The last addition rounds the result, each of the others at most the sum of all magnitudes.
                if count >= 2.0 {
                    let result = node_value.abs() + sum.worst;
                    sum = sum.plus(rounding(result.min(sizes)));
                    for _ in 2..count as u32 {
                        sum = sum.plus(rounding(sizes));
                    }
                }
                sum
            }
            Node::Product(factors) => {
                let (mut product, mut margin, mut roundings) = (1.0, Margin::NONE, -1.0);
                for factor in factors.iter() {
                    let (power, off, node_value) =
                        power(value(&factor.base), error(&factor.base), factor);
                    let both = product_of(margin.worst, off.worst);
                    margin = margin.times(power).plus(off.times(product));
                    margin.worst += both;
                    product *= power;
                    roundings += 1.0 + node_value;
                }
                for _ in 0..roundings as u32 {
                    margin = margin.plus(rounding(node_value.abs() + margin.worst));
                }
                margin
            }
            Node::Sin(angle) | Node::Cos(angle) => {
                let (sine, cosine) = value(angle).sin_cos();
                let slope = if matches!(graph.node(id), Node::Sin(_)) {
                    cosine
                } else {
                    sine
                };
                function(error(angle), slope, 1.0, epsilon * node_value)
            }
            Node::Atan2(y, x) => {
                let size = value(y).hypot(value(x));
                let moved = error(y).plus(error(x)).times(1.0 / size);
                moved.plus(Margin::even(epsilon * node_value))
            }
            Node::Exp(exponent) => {
                let largest = node_value * error(exponent).worst.exp();
                function(error(exponent), node_value, largest, epsilon * node_value)
            }
            Node::Ln(argument) => {
                let off = error(argument);
                let least = value(argument) - off.worst;
                let largest = if least > 0.0 {
                    1.0 / least
                } else {
                    f64::INFINITY
                };
                function(off, 1.0 / value(argument), largest, epsilon * node_value)
            }
            // At a jump, or where pieces meet, the error has no bound; the study's motions avoid these.
            Node::Floor(_) => Margin::NONE,
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let piece = if value(condition) < 0.0 {
                    below
                } else {
                    otherwise
                };
                error(piece)
            }
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let (spline, order) = (graph.spline_of(*spline), usize::from(*order));
                let spline_values = spline.at(value(argument));
                // A piece is the sum of four terms, along a distance that is the difference of two arguments.
                let size = spline.pieces.iter().flatten().chain(&spline_values);
                let size = size.fold(0.0_f64, |size, it| size.max(it.abs()));
                let slope = spline_values.get(order + 1).copied().unwrap_or(0.0);
                let place = error(argument).plus(Margin::even(4.0 * unit * value(argument)));
                place.times(slope).plus(Margin::even(8.0 * unit * size))
            }
        };
    }
    all
}

/// Error of a function with this slope, never steeper than `steepest`, and its own rounding.
fn function(argument: Margin, slope: f64, steepest: f64, rounding: f64) -> Margin {
    if argument.worst == 0.0 {
        return Margin::even(rounding);
    }
    // The slope itself changes by no more than the argument, as all these functions have second derivatives below it.
    let slope_there = (slope.abs() + argument.worst * steepest).min(steepest);
    let moved = Margin {
        worst: argument.worst * slope_there,
        expected: argument.expected * slope.abs(),
    };
    moved.plus(Margin::even(rounding))
}
