//! Functions of several blocks → the same without the values that are known to be zero.
//!
//! What a statement sets to zero is zero wherever it is read afterwards: a rate that was just found to be 0 is not multiplied. The
//! statement itself stays, as somebody may ask for the value.

use std::collections::HashMap;

use crate::expr::{ExprId, Graph, SymbolId};
use crate::program::block::Block;
use crate::program::function::{Function, Statement};

/// Puts zeros in the place of all values that are known to be zero, block by block in solve order.
pub(in crate::program) fn propagate(blocks: &mut [Block], graph: &mut Graph) {
    let zero = graph.zero();
    let mut zeros: HashMap<SymbolId, ExprId> = HashMap::new();
    for function in blocks.iter_mut().flat_map(Block::functions_mut) {
        function.change_values(&mut |expr| without(expr, &zeros, graph));
        // One pass suffices for what follows; within the function a value may become zero by one before it.
        loop {
            let found = function
                .statements
                .iter()
                .filter_map(|statement| match statement {
                    Statement::Let { target, value, .. } if *value == zero => Some(*target),
                    _ => None,
                });
            let before = zeros.len();
            zeros.extend(found.map(|target| (target, zero)));
            if zeros.len() == before {
                break;
            }
            function.change_values(&mut |expr| without(expr, &zeros, graph));
        }
    }
}

fn without(expr: ExprId, zeros: &HashMap<SymbolId, ExprId>, graph: &mut Graph) -> ExprId {
    let found: Vec<(SymbolId, ExprId)> = graph
        .symbols(expr)
        .iter()
        .filter_map(|symbol| Some((*symbol, *zeros.get(symbol)?)))
        .collect();
    match found.is_empty() {
        true => expr,
        false => graph.substitute(expr, &found),
    }
}

impl Function {
    /// Changes the expressions that it evaluates.
    pub(in crate::program) fn change_values(&mut self, change: &mut dyn FnMut(ExprId) -> ExprId) {
        for statement in &mut self.statements {
            statement.change_values(change);
        }
        for result in &mut self.results {
            result.expr = change(result.expr);
        }
    }
}
