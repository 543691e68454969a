//! Substitutes expressions for symbols or for subexpressions, all at once.
//!
//! The result is built with the same constructors, so it is canonical. Shared parts are rebuilt once; parts without a replaced
//! symbol are not visited. Deeply nested expressions are rebuilt from the inside out.

use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Node, SymbolId};
use super::number::Number;
use super::product::Monomial;
use std::collections::HashMap;

/// Depth from which operands are rebuilt first.
const OPERANDS_FIRST_DEPTH: u32 = 32;

/// Replacements with the results so far.
struct Substitution {
    /// Replacements sorted by symbol.
    replacements: Vec<(SymbolId, ExprId)>,
    done: HashMap<ExprId, ExprId, BuildExprHasher>,
    /// True if `done` contains replacements of subexpressions, so that every node must be visited.
    parts: bool,
}

impl Graph {
    /// Replaces symbols by expressions, all at once: replacements are not searched. The first replacement of a symbol counts.
    pub fn substitute(&mut self, expr: ExprId, replacements: &[(SymbolId, ExprId)]) -> ExprId {
        let mut replacements = replacements.to_vec();
        replacements.sort_by_key(|&(symbol, _)| symbol);
        replacements.dedup_by_key(|&mut (symbol, _)| symbol);
        let mut substitution = Substitution {
            replacements,
            done: HashMap::default(),
            parts: false,
        };
        self.replace(expr, &mut substitution)
    }

    /// Replaces subexpressions wherever they occur, except for the expression itself.
    pub fn replace_parts(&mut self, expr: ExprId, replacements: &[(ExprId, ExprId)]) -> ExprId {
        let done = replacements.iter().copied();
        let mut substitution = Substitution {
            replacements: Vec::new(),
            done: done.filter(|&(part, _)| part != expr).collect(),
            parts: true,
        };
        self.replace(expr, &mut substitution)
    }

    fn replace(&mut self, expr: ExprId, substitution: &mut Substitution) -> ExprId {
        if !substitution.parts && !self.concerns(expr, substitution) {
            return expr;
        }
        if let Some(&known) = substitution.done.get(&expr) {
            return known;
        }
        if self.depth(expr) > OPERANDS_FIRST_DEPTH {
            for operand in self.open_in(expr, substitution) {
                self.rebuild(operand, substitution);
            }
        }
        self.rebuild(expr, substitution)
    }

    /// Returns the subexpressions to rebuild, operands first.
    fn open_in(&self, expr: ExprId, substitution: &Substitution) -> Vec<ExprId> {
        self.open_operands(expr, |operand| {
            (substitution.parts || self.concerns(operand, substitution))
                && !substitution.done.contains_key(&operand)
        })
    }

    /// Rebuilds an expression from its replaced operands.
    fn rebuild(&mut self, expr: ExprId, substitution: &mut Substitution) -> ExprId {
        self.ledger.touch(1);
        let result = match self.node(expr) {
            Node::Number(_) | Node::Pi => expr,
            Node::Symbol(symbol) => {
                let index = substitution
                    .replacements
                    .binary_search_by_key(symbol, |&(symbol, _)| symbol);
                index.map_or(expr, |index| substitution.replacements[index].1)
            }
            Node::Sum(terms) => {
                let terms = terms.clone();
                let parts: Vec<(Number, ExprId)> = terms
                    .iter()
                    .map(|term| (term.coefficient, self.replace(term.expr, substitution)))
                    .collect();
                self.combine(&parts)
            }
            Node::Product(factors) => {
                let factors = factors.clone();
                let bases: Vec<ExprId> = factors
                    .iter()
                    .map(|factor| self.replace(factor.base, substitution))
                    .collect();
                if self.any_non_finite(&bases) {
                    self.not_a_number()
                } else {
                    let mut monomial = Monomial::new(Number::ONE);
                    for (base, factor) in bases.into_iter().zip(factors.iter()) {
                        self.push_power(&mut monomial, base, factor.exponent);
                    }
                    self.finish(monomial)
                }
            }
            Node::Sin(angle) => {
                let angle = self.replace(*angle, substitution);
                self.sin(angle)
            }
            Node::Cos(angle) => {
                let angle = self.replace(*angle, substitution);
                self.cos(angle)
            }
            Node::Atan2(y, x) => {
                let (y, x) = (*y, *x);
                let y = self.replace(y, substitution);
                let x = self.replace(x, substitution);
                self.atan2(y, x)
            }
            Node::Exp(exponent) => {
                let exponent = self.replace(*exponent, substitution);
                self.exp(exponent)
            }
            Node::Ln(argument) => {
                let argument = self.replace(*argument, substitution);
                self.ln(argument)
            }
            Node::Floor(argument) => {
                let argument = self.replace(*argument, substitution);
                self.floor(argument)
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let parts = [*condition, *below, *otherwise];
                let [condition, below, otherwise] =
                    parts.map(|part| self.replace(part, substitution));
                self.choose(condition, below, otherwise)
            }
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let (spline, order, argument) = (*spline, *order, *argument);
                let argument = self.replace(argument, substitution);
                self.spline(spline, order, argument)
            }
        };
        substitution.done.insert(expr, result);
        result
    }

    /// True if a replaced symbol occurs: the elements of the shorter sorted list are looked up in the longer one.
    fn concerns(&self, expr: ExprId, substitution: &Substitution) -> bool {
        let (symbols, replacements) = (self.symbols(expr), &substitution.replacements);
        if symbols.len() < replacements.len() {
            symbols.iter().any(|symbol| {
                replacements
                    .binary_search_by_key(symbol, |&(symbol, _)| symbol)
                    .is_ok()
            })
        } else {
            replacements
                .iter()
                .any(|(symbol, _)| symbols.binary_search(symbol).is_ok())
        }
    }
}
