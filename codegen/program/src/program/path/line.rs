//! An equation → how far it is from zero along the line through both frames.
//!
//! It is zero in both, so that its second derivative bounds it between them and beyond. Where that is one of time alone, as what
//! drivers do to an equation, its sign is kept: along a chain of links what drivers remainder cancels, and bounds would add it up.

use std::collections::HashSet;

use crate::expr::{ExprId, Factor, Graph, Node, Rational, SymbolId};
use crate::program::builder::Builder;
use crate::program::passes::enclosure::Enclosure;

/// How an equation runs along the line.
pub(super) struct OnLine {
    /// How far it is from zero, but for its curvature.
    pub bound: ExprId,
    /// Its second derivative over the window, as far as that is known with its sign.
    pub curvature: ExprId,
}

impl Builder<'_> {
    /// How far an equation is from zero while what it mentions is on the line, or as near as is known.
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

    /// ∂²Φ/∂t², where time acts on an equation by itself, and smoothly at any time.
    fn second_derivative_in_time(&mut self, residual: ExprId) -> Option<ExprId> {
        let time = self.system.mechanism.time;
        let first = self.graph().derivative(residual, time);
        let zero = self.graph().zero();
        let symbols = self.system.mechanism.graph.symbols(first).to_vec();
        let is_alone = symbols.into_iter().all(|symbol| {
            let value = self.graph().variable(symbol);
            symbol == time || self.enclosure(value).radius == zero
        });
        let second = self.graph().derivative(first, time);
        let graph = &self.system.mechanism.graph;
        (is_alone && second != zero && is_smooth(graph, residual, time)).then_some(second)
    }
}

/// Whether an expression has all derivatives in a symbol everywhere: bounds of a third one say nothing near the end of where a
/// function is defined, and those of a second one more.
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
