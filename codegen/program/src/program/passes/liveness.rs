//! Functions → what of them something needs.
//!
//! From the last statement of the last function to the first of the first: what defines a value that nothing after it reads is left
//! out, and so are words about nothing.

use crate::expr::{Graph, IdSet, SymbolId};
use crate::program::block::{Block, NewtonBlock};
use crate::program::function::{Function, Statement};
use crate::program::path::Path;

/// Leaves out of all blocks what neither `kept` nor anything that is kept asks for.
pub(in crate::program) fn prune(
    blocks: &mut [Block],
    kept: &dyn Fn(SymbolId) -> bool,
    graph: &Graph,
) {
    let mut live = IdSet::default();
    for block in blocks.iter_mut().rev() {
        let statements = std::mem::take(&mut block.function.statements);
        let newton = block.newton.as_ref();
        block.function.statements = needed(statements, newton, &mut live, kept, graph);
        let is_newton = |it: &Statement| matches!(it, Statement::Newton { .. });
        if !block.function.statements.iter().any(is_newton) {
            block.newton = None;
        }
    }
}

/// Leaves out of a path the bounds that nothing relies on.
pub(in crate::program) fn prune_path(path: &mut Path, graph: &Graph) {
    for function in path.whole_functions_mut() {
        let statements = std::mem::take(&mut function.statements);
        function.statements = needed(statements, None, &mut IdSet::default(), &|_| false, graph);
    }
}

/// A function with the statements alone that its results need.
pub(in crate::program) fn for_results(function: Function, graph: &Graph) -> Function {
    let results = function.results.iter();
    let mut live = results
        .flat_map(|result| graph.symbols(result.expr))
        .copied()
        .collect();
    Function {
        statements: needed(function.statements, None, &mut live, &|_| false, graph),
        ..function
    }
}

/// The statements that `live` values and `kept` ones need; afterwards `live` holds what they read.
fn needed(
    statements: Vec<Statement>,
    newton: Option<&NewtonBlock>,
    live: &mut IdSet<SymbolId>,
    kept: &dyn Fn(SymbolId) -> bool,
    graph: &Graph,
) -> Vec<Statement> {
    let mut needed: Vec<Statement> = Vec::with_capacity(statements.len());
    // Whether anything after this place remains at all, and whether anything does before the next words.
    let (mut remains, mut followed) = (false, false);
    for mut statement in statements.into_iter().rev() {
        let wanted = |symbol: SymbolId| live.contains(&symbol) || kept(symbol);
        if let Statement::Solve { targets, .. } | Statement::Multipliers { targets, .. } =
            &mut statement
        {
            for target in targets {
                *target = target.filter(|&symbol| wanted(symbol));
            }
        }
        let keep = match &statement {
            Statement::Factorize => {
                let mut later = needed.iter();
                later.any(|later| matches!(later, Statement::Solve { .. }))
            }
            Statement::Newton { .. } => remains || statement.targets().into_iter().any(wanted),
            Statement::Isolate { .. } | Statement::Require { .. } => true,
            // What drives the mechanism must be allowed, whatever is asked for.
            Statement::Positive { .. } => true,
            // What is checked is needed by all that follows in the function.
            Statement::Reach { .. } | Statement::Nonzero { .. } => remains,
            Statement::Section(_) => std::mem::take(&mut followed),
            _ if statement.is_said() => followed,
            _ => statement.targets().into_iter().any(wanted),
        };
        if !keep {
            continue;
        }
        if !statement.is_said() {
            (remains, followed) = (true, true);
        }
        live.extend(
            statement
                .values()
                .into_iter()
                .flat_map(|expr| graph.symbols(expr)),
        );
        if let Some(inner) = statement.inner() {
            live.extend(inner.values().flat_map(|expr| graph.symbols(expr)));
        }
        if let (Statement::Newton { .. }, Some(newton)) = (&statement, newton) {
            let values = newton.functions().flat_map(Function::values);
            live.extend(values.flat_map(|expr| graph.symbols(expr)));
        }
        needed.push(statement);
    }
    needed.reverse();
    needed
}
