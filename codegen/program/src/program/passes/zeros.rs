//! Replaces values that are known to be zero.
//!
//! A value that a statement sets to zero is zero in all later statements: a zero rate is not multiplied. The statement itself
//! remains, as the value may be requested.

use std::collections::HashMap;

use crate::expr::{ExprId, Graph, SymbolId};
use crate::program::block::Block;
use crate::program::function::{Function, Statement};

/// Substitutes zero for all values that are known to be zero, block by block in solve order.
pub(in crate::program) fn propagate(blocks: &mut [Block], graph: &mut Graph) {
    let zero = graph.zero();
    let mut zeros: HashMap<SymbolId, ExprId> = HashMap::new();
    for function in blocks.iter_mut().flat_map(Block::functions_mut) {
        function.change_values(&mut |expr| without(expr, &zeros, graph));
        // One pass suffices for later blocks; within the function, a zero may make another value zero.
        loop {
            let zero_targets = function
                .statements
                .iter()
                .filter_map(|statement| match statement {
                    Statement::Let { target, value, .. } if *value == zero => Some(*target),
                    _ => None,
                });
            let before = zeros.len();
            zeros.extend(zero_targets.map(|target| (target, zero)));
            if zeros.len() == before {
                break;
            }
            function.change_values(&mut |expr| without(expr, &zeros, graph));
        }
    }
}

fn without(expr: ExprId, zeros: &HashMap<SymbolId, ExprId>, graph: &mut Graph) -> ExprId {
    let zero_symbols: Vec<(SymbolId, ExprId)> = graph
        .symbols(expr)
        .iter()
        .filter_map(|symbol| Some((*symbol, *zeros.get(symbol)?)))
        .collect();
    match zero_symbols.is_empty() {
        true => expr,
        false => graph.substitute(expr, &zero_symbols),
    }
}

impl Function {
    /// Replaces the expressions that the function evaluates.
    pub(in crate::program) fn change_values(&mut self, change: &mut dyn FnMut(ExprId) -> ExprId) {
        for statement in &mut self.statements {
            statement.change_values(change);
        }
        for result in &mut self.results {
            result.expr = change(result.expr);
        }
    }
}
