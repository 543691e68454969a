//! *Expressions and values of their symbols with errors* → *values and bounds of their errors* in floating point.
//!
//! Running error analysis (Higham, *Accuracy and Stability of Numerical Algorithms*, section 3.3), to first order in the errors
//! of the symbols.

use linkwright_codegen::expr::{ExprId, Factor, Graph, Node};

/// A value and by how much its computed value may be off.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    /// The value.
    pub value: f64,
    /// The bound of the error.
    pub error: f64,
}

impl Bounded {
    /// A number without error.
    pub fn exact(value: f64) -> Bounded {
        Bounded { value, error: 0.0 }
    }

    fn times(self, other: Bounded, ulp: f64) -> Bounded {
        let value = self.value * other.value;
        let error = self.error * other.value.abs() + self.value.abs() * other.error;
        Bounded {
            value,
            error: error + self.error * other.error + ulp * value.abs(),
        }
    }

    fn of(self, value: f64, slope: f64, ulp: f64) -> Bounded {
        Bounded {
            value,
            error: self.error * slope.abs() + ulp * value.abs(),
        }
    }
}

fn power(base: Bounded, factor: &Factor, ulp: f64) -> Bounded {
    let exponent = factor.exponent.to_f64();
    let value = base.value.powf(exponent);
    let mut error = ulp * value.abs() * exponent.abs().max(1.0);
    if base.error > 0.0 {
        // The slope of a power above one is largest at the far end of where the base may be: the square of a rate that is
        // zero but for rounding is not zero.
        let margin = if exponent > 1.0 { base.error } else { 0.0 };
        let slope = exponent * (base.value.abs() + margin).powf(exponent - 1.0);
        error += base.error * slope.abs();
    }
    Bounded { value, error }
}

/// The values of the nodes in `order` (operands first), by the node's index, where one rounding is the part `ulp` of a value.
pub fn bounds(graph: &Graph, order: &[ExprId], symbols: &[Bounded], ulp: f64) -> Vec<Bounded> {
    let mut all = vec![Bounded::exact(f64::NAN); graph.node_count()];
    for &id in order {
        let at = |id: &ExprId| all[id.index()];
        let rounded = |value: f64| Bounded {
            value,
            error: ulp * value.abs(),
        };
        all[id.index()] = match graph.node(id) {
            Node::Number(number) => rounded(number.to_f64()),
            Node::Pi => rounded(std::f64::consts::PI),
            Node::Symbol(symbol) => symbols[symbol.index()],
            Node::Sum(terms) => {
                let mut sum = Bounded::exact(0.0);
                for term in terms {
                    let coefficient = rounded(term.coefficient.to_f64());
                    let addend = coefficient.times(at(&term.expr), ulp);
                    sum.value += addend.value;
                    sum.error += addend.error + terms.len() as f64 * ulp * addend.value.abs();
                }
                sum
            }
            Node::Product(factors) => factors.iter().fold(Bounded::exact(1.0), |product, it| {
                product.times(power(at(&it.base), it, ulp), ulp)
            }),
            Node::Sin(angle) => at(angle).of(at(angle).value.sin(), at(angle).value.cos(), ulp),
            Node::Cos(angle) => at(angle).of(at(angle).value.cos(), at(angle).value.sin(), ulp),
            Node::Atan2(y, x) => {
                let (y, x) = (at(y), at(x));
                let angle = y.value.atan2(x.value);
                Bounded {
                    value: angle,
                    error: (y.error + x.error) / y.value.hypot(x.value) + ulp * angle.abs(),
                }
            }
            Node::Exp(exponent) => {
                let value = at(exponent).value.exp();
                at(exponent).of(value, value, ulp)
            }
            Node::Ln(argument) => {
                at(argument).of(at(argument).value.ln(), 1.0 / at(argument).value, ulp)
            }
            Node::Floor(argument) => Bounded::exact(at(argument).value.floor()),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => at(if at(condition).value < 0.0 {
                below
            } else {
                otherwise
            }),
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let (spline, order) = (graph.spline_of(*spline), usize::from(*order));
                let at = at(argument);
                let found = spline.at(at.value);
                // A piece is the sum of four terms, along a distance that is the difference of two places.
                let size = spline.pieces.iter().flatten().chain(&found);
                let size = size.fold(0.0_f64, |size, it| size.max(it.abs()));
                let slope = found.get(order + 1).copied().unwrap_or(0.0);
                let place = at.error + 4.0 * ulp * at.value.abs();
                Bounded {
                    value: found[order],
                    error: place * slope.abs() + 8.0 * ulp * size,
                }
            }
        };
    }
    all
}
