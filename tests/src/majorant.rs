//! Bounds on the Taylor coefficients of expressions along a line, and on their rounding errors.
//!
//! Along the line every symbol is `value + s · slope`, |s| ≤ `reach`. Each expression f has numbers c₀ … c_K with
//! |f⁽ᵏ⁾(s)| ≤ k! c_k everywhere on the line (majorants: Moore, *Methods and Applications of Interval Analysis*,
//! 1979, section 3.4). A further bound covers the rounding error of f in floating point at any point of the line
//! (running error analysis: Higham, *Accuracy and Stability of Numerical Algorithms*, section 3.3). With them the
//! error of a difference quotient is computed, not guessed.
//!
//! Majorants of sums and products are those of their operands added and multiplied; as all derivatives of sine and
//! cosine are at most 1, the majorant of sin f is exp(Σ_{k≥1} c_k sᵏ).

use std::f64::consts::PI;

use linkwright_codegen::stages::expr::{ExprId, Factor, Graph, Node};

use crate::magnitude::{values, whole_exponent};

const ULP: f64 = f64::EPSILON;

/// Bounds for one expression: of its Taylor coefficients up to order `N` - 1, and of its rounding error.
#[derive(Clone, Copy, Debug)]
pub struct Majorant<const N: usize> {
    /// c_k ≥ |f⁽ᵏ⁾| / k!.
    pub coefficients: [f64; N],
    /// The largest difference between f and its computed value.
    pub error: f64,
}

/// A line through the space of symbols.
pub struct Line<'a> {
    /// The value of each symbol at s = 0.
    pub values: &'a [f64],
    /// The derivative of each symbol with respect to s, at least in absolute value.
    pub slopes: &'a [f64],
    /// The largest |s|.
    pub reach: f64,
}

/// The majorants of the nodes in `order` (operands first), by the node's index.
///
/// # Panics
/// As [`crate::magnitude::magnitudes`].
pub fn majorants<const N: usize>(
    graph: &Graph,
    order: &[ExprId],
    line: &Line<'_>,
) -> Vec<Majorant<N>> {
    let unset = Majorant {
        coefficients: [f64::NAN; N],
        error: f64::NAN,
    };
    let mut all = vec![unset; graph.node_count()];
    let value = values(graph, order, line.values);
    for &id in order {
        all[id.index()] = match graph.node(id) {
            Node::Number(number) => constant(number.to_f64().abs()),
            Node::Pi => constant(PI),
            Node::Symbol(symbol) => {
                let slope = line.slopes[symbol.index()].abs();
                let mut majorant = constant(line.values[symbol.index()].abs() + line.reach * slope);
                if let Some(first) = majorant.coefficients.get_mut(1) {
                    *first = slope;
                }
                majorant
            }
            Node::Sum(terms) => {
                let mut sum = Majorant {
                    coefficients: [0.0; N],
                    error: 0.0,
                };
                // A rounding of the coefficient, one of the product and one per addition.
                let roundings = (terms.len() + 2) as f64 * ULP;
                for term in terms.iter() {
                    let (coefficient, operand) =
                        (term.coefficient.to_f64().abs(), all[term.expr.index()]);
                    for (total, bound) in sum.coefficients.iter_mut().zip(operand.coefficients) {
                        *total += coefficient * bound;
                    }
                    sum.error +=
                        coefficient * (operand.error + roundings * operand.coefficients[0]);
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = Majorant {
                    coefficients: constant::<N>(1.0).coefficients,
                    error: 0.0,
                };
                for factor in factors.iter() {
                    product = power(graph, factor, &all, &value, line.reach)
                        .into_iter()
                        .fold(product, multiply);
                }
                product
            }
            Node::Sin(angle) | Node::Cos(angle) => rotation(all[angle.index()]),
            // Angle of a direction in the design configuration: it turns by the motion of its end, over its distance.
            Node::Atan2(y, x) if graph.is_fixed(id) => {
                let moved = all[y.index()].error + all[x.index()].error;
                let mut angle = constant(value[id.index()].abs());
                angle.error += ULP * angle.coefficients[0]
                    + 2.0 * moved / value[y.index()].hypot(value[x.index()]);
                angle
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let (mut larger, other) = (all[below.index()], all[otherwise.index()]);
                for (bound, other) in larger.coefficients.iter_mut().zip(other.coefficients) {
                    *bound = bound.max(other);
                }
                larger.error = larger.error.max(other.error);
                changed(
                    larger,
                    &all[condition.index()],
                    value[condition.index()],
                    line.reach,
                )
            }
            // A jump is where the argument is whole.
            Node::Floor(argument) => {
                let (argument, at) = (&all[argument.index()], value[argument.index()]);
                let mut floor = constant(at.floor().abs() + 1.0);
                floor.error = 0.0;
                changed(floor, argument, (at - at.round()).abs(), line.reach)
            }
            other => panic!("no majorant of {other:?}"),
        };
    }
    all
}

/// A number, rounded once.
fn constant<const N: usize>(size: f64) -> Majorant<N> {
    let mut coefficients = [0.0; N];
    coefficients[0] = size;
    Majorant {
        coefficients,
        error: ULP * size,
    }
}

/// Bounds if the line cannot pass a change of the pieces, at which `margin` would be zero. Otherwise only the value
/// has a bound: pieces join in two derivatives at most.
fn changed<const N: usize>(
    mut piece: Majorant<N>,
    deciding: &Majorant<N>,
    margin: f64,
    reach: f64,
) -> Majorant<N> {
    let slope = deciding.coefficients.get(1).copied().unwrap_or(0.0);
    if margin.abs() <= reach * slope + deciding.error {
        piece.coefficients[1..].fill(f64::INFINITY);
        piece.error = f64::INFINITY;
    }
    piece
}

/// A power as factors to multiply.
fn power<const N: usize>(
    graph: &Graph,
    factor: &Factor,
    all: &[Majorant<N>],
    value: &[f64],
    reach: f64,
) -> Vec<Majorant<N>> {
    let base = all[factor.base.index()];
    let exponent = factor.exponent.to_f64();
    let value = value[factor.base.index()];
    if graph.is_fixed(factor.base) {
        // |bᵖ - (b + e)ᵖ| ≤ |p| e max|b|ᵖ⁻¹, the maximum at the near or the far end.
        let far = |size: f64| size.abs().powf(exponent - 1.0);
        let slope = far(value.abs() - base.error).max(far(value.abs() + base.error));
        let mut result = constant(value.abs().powf(exponent));
        result.error = exponent.abs() * slope * base.error + 2.0 * ULP * result.coefficients[0];
        return vec![result];
    }
    if let Some(whole) = whole_exponent(exponent) {
        return vec![base; whole as usize];
    }
    vec![broken_power(base, value, exponent, reach)]
}

/// bᵖ from b (bᵖ)' = p b' bᵖ, on whose coefficients the smallest |b| of the line gives a bound; infinite where b may vanish.
fn broken_power<const N: usize>(
    base: Majorant<N>,
    value: f64,
    exponent: f64,
    reach: f64,
) -> Majorant<N> {
    let slope = base.coefficients.get(1).copied().unwrap_or(0.0);
    let smallest = value.abs() - reach * slope - base.error;
    let mut coefficients = [f64::INFINITY; N];
    if smallest <= 0.0 {
        return Majorant {
            coefficients,
            error: f64::INFINITY,
        };
    }
    let largest = |exponent: f64| {
        smallest
            .powf(exponent)
            .max(base.coefficients[0].powf(exponent))
    };
    coefficients[0] = largest(exponent);
    for k in 1..N {
        let sum: f64 = (1..=k)
            .map(|j| {
                let weight = exponent.abs() * j as f64 + (k - j) as f64;
                weight * base.coefficients[j] * coefficients[k - j]
            })
            .sum();
        coefficients[k] = sum / (k as f64 * smallest);
    }
    let error = exponent.abs() * largest(exponent - 1.0) * base.error + 4.0 * ULP * coefficients[0];
    Majorant {
        coefficients,
        error,
    }
}

fn multiply<const N: usize>(left: Majorant<N>, right: Majorant<N>) -> Majorant<N> {
    let mut coefficients = [0.0; N];
    for (i, a) in left.coefficients.iter().enumerate() {
        for (coefficient, b) in coefficients[i..].iter_mut().zip(right.coefficients) {
            *coefficient += a * b;
        }
    }
    let (a, b) = (left.coefficients[0], right.coefficients[0]);
    let error = left.error * b + right.error * a + left.error * right.error + ULP * (a * b);
    Majorant {
        coefficients,
        error,
    }
}

/// The sine or cosine: e = exp(u) from e' = u' e. The library's functions err by less than one unit in the last place.
fn rotation<const N: usize>(angle: Majorant<N>) -> Majorant<N> {
    let mut coefficients = [0.0; N];
    coefficients[0] = 1.0;
    for k in 1..N {
        let sum: f64 = (1..=k)
            .map(|j| j as f64 * angle.coefficients[j] * coefficients[k - j])
            .sum();
        coefficients[k] = sum / k as f64;
    }
    Majorant {
        coefficients,
        error: angle.error + ULP,
    }
}
