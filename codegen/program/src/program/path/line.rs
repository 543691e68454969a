//! Bounds an equation along the chord between both frames.
//!
//! The equation is zero in both frames, so its second derivative bounds it between and beyond the frames. The sign of the
//! derivative is kept if it depends on time alone, as with drivers: along a chain of links, contributions of drivers cancel,
//! while bounds would add up.

use std::collections::HashSet;

use crate::expr::{ExprId, Factor, Graph, Node, Rational, SymbolId};
use crate::program::builder::Builder;
use crate::program::passes::enclosure::Enclosure;

/// Bounds of an equation on the chord.
pub(super) struct OnLine {
    /// Bound on the residual, without its curvature.
    pub bound: ExprId,
    /// Second derivative over the window, as far as its value and sign are known.
    pub curvature: ExprId,
}

impl Builder<'_> {
    /// Bounds an equation while its symbols are on the chord, or within their bounds of it.
    pub(super) fn on_line(&mut self, residual: ExprId) -> OnLine {
        let Some(second) = self.second_derivative_in_time(residual) else {
            let (bound, curvature) = (self.enclosure(residual).deviation, self.graph().zero());
            return OnLine { bound, curvature };
        };
        let time = self.system.mechanism.time;
        let [window, remainder] = [self.paths.window.time, self.paths.window.remainder];
        let [window, remainder] = [window, remainder].map(|it| self.graph().variable(it));
        let zero = self.graph().zero();
        let changed = self.enclosure(second).radius;
        let unmoved = Enclosure {
            radius: zero,
            deviation: zero,
        };
        self.paths.enclosures.know(time, unmoved);
        let without = self.enclosure(residual).deviation;
        let moved = Enclosure {
            radius: window,
            deviation: zero,
        };
        self.paths.enclosures.know(time, moved);
        let curvature = self.graph().product(&[second, window, window]);
        let change = self.graph().product(&[changed, remainder, window, window]);
        OnLine {
            bound: self.graph().add(without, change),
            curvature,
        }
    }

    /// Returns ∂²Φ/∂t² if the equation depends on time explicitly, and smoothly at any time; otherwise `None`.
    fn second_derivative_in_time(&mut self, residual: ExprId) -> Option<ExprId> {
        let time = self.system.mechanism.time;
        let first = self.graph().derivative(residual, time);
        let zero = self.graph().zero();
        let symbols = self.pool.graph.symbols(first).to_vec();
        let is_alone = symbols.into_iter().all(|symbol| {
            let value = self.graph().variable(symbol);
            symbol == time || self.enclosure(value).radius == zero
        });
        let second = self.graph().derivative(first, time);
        let graph = &self.pool.graph;
        (is_alone && second != zero && is_smooth(graph, residual, time)).then_some(second)
    }
}

/// True if an expression has all derivatives in a symbol everywhere. Bounds of a second derivative need one more order, and those
/// of a third fail near the end of a domain.
fn is_smooth(graph: &Graph, expr: ExprId, symbol: SymbolId) -> bool {
    let (mut open, mut seen) = (vec![expr], HashSet::new());
    while let Some(expr) = open.pop() {
        if !graph.depends_on(expr, symbol) || !seen.insert(expr) {
            continue;
        }
        match graph.node(expr) {
            Node::Choose { .. } | Node::Floor(_) | Node::Atan2(..) | Node::Ln(_) => return false,
            Node::Spline { order, .. } if *order > 0 => return false,
            Node::Product(factors) => {
                let is_whole =
                    |exponent: Rational| exponent.denominator() == 1 && !exponent.is_negative();
                let moving = |factor: &&Factor| graph.depends_on(factor.base, symbol);
                if !factors
                    .iter()
                    .filter(moving)
                    .all(|it| is_whole(it.exponent))
                {
                    return false;
                }
                open.extend(factors.iter().map(|factor| factor.base));
            }
            _ => open.extend(graph.operands(expr)),
        }
    }
    true
}
