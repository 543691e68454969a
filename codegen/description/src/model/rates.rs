//! Differentiates `rate(FORMULA)` in forces and torques by the chain rule.
//!
//! Coordinates and inputs have their own rates, local vectors rotate with their bodies, and the rate of t is 1.

use super::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::{ExprId, SymbolId};
use crate::syntax::Expression;

impl Resolver<'_> {
    /// Resolves the rate of the single argument.
    pub(super) fn rate_in_load(&mut self, arguments: &[Expression], span: Span) -> Option<Value> {
        let [argument] = arguments else {
            let count = arguments.len();
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongArgumentCount,
                    span,
                    format!("`rate` takes 1 argument, not {count}"),
                )
                .label(format!("{count} given"))
                .help("write `rate(…)` with one formula, such as `rate(phi(1))`"),
            );
            return None;
        };
        let (value, _) = self.value(argument)?;
        let symbols = self.graph.symbols(value).to_vec();
        let mut terms = Vec::with_capacity(symbols.len());
        for symbol in symbols {
            if self.graph.nominal(symbol).is_some() {
                continue;
            }
            let Some(rate) = self.rate_of_symbol(symbol) else {
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::OutsideGrammar,
                        argument.span,
                        "formulas of forces cannot contain the rate of a rate",
                    )
                    .label("mentions a rate")
                    .help("forces depend on positions and velocities, not on accelerations"),
                );
                return None;
            };
            let partial = self.graph.derivative(value, symbol);
            terms.push(self.graph.multiply(partial, rate));
        }
        if let Some(kinematic) = &mut self.formulas.kinematic {
            kinematic.rated.push(value);
        }
        // The unit of a factor of a rate is rarely written, as with a factor of t.
        Some((self.graph.sum(&terms), Dimension::OfTime))
    }

    /// Returns the rate of a symbol in a formula; `None` for a symbol that is a rate itself.
    fn rate_of_symbol(&mut self, symbol: SymbolId) -> Option<ExprId> {
        if symbol == self.formulas.time {
            return Some(self.graph.one());
        }
        if self.linkage.coordinate_places.contains_key(&symbol) {
            return Some(self.rate_of_coordinate(symbol));
        }
        if let Some(&input) = self.declared.input_places.get(&symbol) {
            let rate = self.declared.inputs[input].symbols[1];
            return Some(self.graph.variable(rate));
        }
        let kinematic = self.formulas.kinematic.as_ref()?;
        let arms = kinematic.marks.iter().zip(&kinematic.arms);
        let mut arms = arms.filter_map(|(mark, arm)| Some((*mark, (*arm)?)));
        let (mark, [x, y]) = arms.find(|(_, arm)| arm.contains(&symbol))?;
        let [_, _, angle] = self.linkage.bodies[mark.frame.body.0].coordinates;
        let turning = self.rate_of_coordinate(angle?.symbol);
        let other = self.graph.variable(if symbol == x { y } else { x });
        let turned = self.graph.multiply(turning, other);
        Some(if symbol == x {
            self.graph.negate(turned)
        } else {
            turned
        })
    }

    /// Returns the symbol of the rate of a coordinate, as used in the equations.
    fn rate_of_coordinate(&mut self, coordinate: SymbolId) -> ExprId {
        let name = format!("{}'", self.graph.symbol_name(coordinate));
        let rate = self.graph.symbol(&name);
        self.graph.variable(rate)
    }
}
