//! Definitions of the names on a page, in an order in which they can be computed.

use std::collections::{BTreeSet, HashSet};

use super::{NamedParts, State};
use crate::expr::{ExprId, Graph, Node, Rational};
use crate::pool::Pool;

/// Definition of a name.
#[derive(Clone, Copy, Debug)]
pub(in crate::emit) struct Definition {
    /// The name, as a symbol.
    pub name: ExprId,
    /// Its value; names of earlier definitions stand in it as symbols.
    pub value: ExprId,
}

impl NamedParts {
    /// Definitions of the names given since the last call, in an order in which they can be computed.
    pub(in crate::emit) fn definitions(&self, pool: &mut Pool) -> Vec<Definition> {
        let state = &mut *self.state.borrow_mut();
        let mut definitions = Vec::new();
        for place in state.defined..state.named.len() {
            let whole = state.named[place];
            let (parts, floors) = state.inside(&pool.graph, whole);
            for &floor in &floors {
                if state.turns.contains_key(&floor) {
                    continue;
                }
                let name = format!("turn_{}", state.turns.len() + 1);
                if let Some((definition, without)) = turn(pool, floor, &name) {
                    definitions.push(definition);
                    state.turns.insert(floor, without);
                }
            }
            let turns = floors
                .iter()
                .filter_map(|floor| Some((*floor, *state.turns.get(floor)?)));
            let parts = parts.iter().map(|part| (*part, state.symbols[part]));
            let replacements: Vec<(ExprId, ExprId)> = turns.chain(parts).collect();
            let value = pool.graph.replace_parts(whole, &replacements);
            if let Some(Some(name)) = state.names.get(&whole) {
                let symbol = pool.intermediate(name);
                let name = pool.graph.variable(symbol);
                state.symbols.insert(whole, name);
                definitions.push(Definition { name, value });
            }
        }
        state.defined = state.named.len();
        definitions
    }
}

impl State {
    /// Named parts of an expression, and the numbers of whole periods outside of them.
    fn inside(&self, graph: &Graph, whole: ExprId) -> (BTreeSet<ExprId>, BTreeSet<ExprId>) {
        let (mut named, mut floors) = (BTreeSet::new(), BTreeSet::new());
        let mut seen = HashSet::from([whole]);
        let mut open = graph.operands(whole);
        while let Some(expr) = open.pop() {
            if !seen.insert(expr) {
                continue;
            }
            if self.symbols.contains_key(&expr) {
                named.insert(expr);
                continue;
            }
            if matches!(graph.node(expr), Node::Floor(_)) {
                floors.insert(expr);
            }
            open.extend(graph.operands(expr));
        }
        (named, floors)
    }
}

/// With floor((x - x0)/P): the definition `turn = x - P floor((x - x0)/P)`, and the number of periods (x - turn)/P.
/// `None` if the argument is not linear in a variable, with a constant P.
fn turn(pool: &mut Pool, whole: ExprId, name: &str) -> Option<(Definition, ExprId)> {
    let Node::Floor(periods) = *pool.graph.node(whole) else {
        return None;
    };
    let symbol = *pool.graph.symbols(periods).first()?;
    let graph = &mut pool.graph;
    let frequency = graph.derivative(periods, symbol);
    if !graph.is_constant(frequency) {
        return None;
    }
    let period = graph.power(frequency, -Rational::ONE);
    let scaled = graph.multiply(period, periods);
    let argument = match graph.node(scaled) {
        Node::Sum(terms) => {
            let mut kept = terms.to_vec();
            kept.retain(|term| !graph.is_constant(term.expr));
            let kept: Vec<ExprId> = kept
                .iter()
                .map(|term| graph.scale(term.coefficient, term.expr))
                .collect();
            graph.sum(&kept)
        }
        _ => scaled,
    };
    let skipped = graph.multiply(period, whole);
    let value = graph.subtract(argument, skipped);
    let symbol = pool.intermediate(name);
    let graph = &mut pool.graph;
    let name = graph.variable(symbol);
    let rest = graph.subtract(argument, name);
    Some((Definition { name, value }, graph.divide(rest, period)))
}
