//! Differentiates expressions of the vector form in time.
//!
//! d/dt f = Σ ∂f/∂s ṡ over all symbols that move. Squares and products of sums are differentiated factor by factor: Σ u² gives 2
//! Σ u u̇ and not a term for each symbol.

use super::Pool;
use crate::expr::{ExprId, Factor, Graph, Node, Rational, SymbolId};

impl Pool {
    /// Records the rate of a symbol.
    pub fn set_rate(&mut self, symbol: SymbolId, rate: ExprId) {
        self.rates.insert(symbol, rate);
    }

    /// Records the rates of the unknowns and the rates of these rates.
    pub fn set_rates_of_unknowns(&mut self) {
        for &[position, rate, acceleration] in &self.unknowns {
            let [first, second] = [rate, acceleration].map(|it| self.graph.variable(it));
            self.rates.insert(position, first);
            self.rates.insert(rate, second);
        }
    }

    /// Returns d/dt of an expression of unknowns, rates, rotated vectors, parameters, inputs and t.
    pub fn rate(&mut self, expr: ExprId) -> ExprId {
        let Node::Sum(terms) = self.graph.node(expr) else {
            return match factors_of(expr, &self.graph) {
                Some(factors) => self.rate_of_product(&factors),
                None => self.rate_by_symbols(expr),
            };
        };
        let terms = terms.clone();
        let (mut rates, mut others) = (Vec::new(), Vec::new());
        for term in terms.iter() {
            match factors_of(term.expr, &self.graph) {
                Some(factors) => {
                    let rate = self.rate_of_product(&factors);
                    rates.push(self.graph.scale(term.coefficient, rate));
                }
                None => others.push(self.graph.scale(term.coefficient, term.expr)),
            }
        }
        if rates.is_empty() {
            return self.rate_by_symbols(expr);
        }
        let others = self.graph.sum(&others);
        rates.push(self.rate_by_symbols(others));
        self.graph.sum(&rates)
    }

    fn rate_by_symbols(&mut self, expr: ExprId) -> ExprId {
        let symbols = self.graph.symbols(expr).to_vec();
        let mut terms = Vec::with_capacity(symbols.len());
        for symbol in symbols {
            let Some(&rate) = self.rates.get(&symbol) else {
                unreachable!("`{}` has no rule of motion", self.graph.symbol_name(symbol))
            };
            if rate == self.graph.zero() {
                continue;
            }
            let partial = self.graph.derivative(expr, symbol);
            terms.push(self.graph.multiply(partial, rate));
        }
        self.graph.sum(&terms)
    }

    /// Returns Σ n uⁿ⁻¹ u̇ times the other factors.
    fn rate_of_product(&mut self, factors: &[Factor]) -> ExprId {
        let mut terms = Vec::with_capacity(factors.len());
        for (at, factor) in factors.iter().enumerate() {
            let rate = self.rate(factor.base);
            if rate == self.graph.zero() {
                continue;
            }
            let mut parts = vec![rate];
            for (other, own) in factors.iter().enumerate() {
                let exponent = match other == at {
                    true => own.exponent.checked_sub(Rational::ONE),
                    false => Some(own.exponent),
                };
                parts.extend(exponent.map(|exponent| self.graph.power(own.base, exponent)));
            }
            let exponent = self.graph.integer(factor.exponent.numerator() as i64);
            parts.push(exponent);
            terms.push(self.graph.product(&parts));
        }
        self.graph.sum(&terms)
    }
}

/// Returns the factors of a product of integer powers that is a square of a sum, or has two sums; otherwise `None`.
fn factors_of(expr: ExprId, graph: &Graph) -> Option<Vec<Factor>> {
    /// Differentiating higher powers by symbols is as short.
    const HIGHEST: i128 = 3;
    /// Longer products are expanded into many terms anyway.
    const MAX_FACTORS: usize = 8;
    let Node::Product(factors) = graph.node(expr) else {
        return None;
    };
    let is_whole =
        |it: &Factor| it.exponent.is_integer() && (1..=HIGHEST).contains(&it.exponent.numerator());
    let sums = factors
        .iter()
        .filter(|it| matches!(graph.node(it.base), Node::Sum(_)))
        .map(|it| it.exponent.numerator());
    let is_short = factors.len() <= MAX_FACTORS && (2..=4).contains(&sums.sum::<i128>());
    (is_short && factors.iter().all(is_whole)).then(|| factors.to_vec())
}
