//! Removes statements that nothing needs.
//!
//! The pass runs from the last statement of the last function to the first of the first: definitions that nothing reads later are
//! removed, and so are remarks without statements.

use crate::expr::{Graph, IdSet, SymbolId};
use crate::program::block::{Block, NewtonBlock};
use crate::program::function::{Function, Statement};
use crate::program::path::Path;

/// Removes from all blocks the statements that neither `kept` symbols nor remaining statements need.
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

/// Removes unneeded bounds from a path.
pub(in crate::program) fn prune_path(path: &mut Path, graph: &Graph) {
    for function in path.whole_functions_mut() {
        let statements = std::mem::take(&mut function.statements);
        function.statements = needed(statements, None, &mut IdSet::default(), &|_| false, graph);
    }
}

/// Returns a function with only the statements that its results need.
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

/// Returns the statements that `live` and `kept` values need; adds the symbols that they read to `live`.
fn needed(
    statements: Vec<Statement>,
    newton: Option<&NewtonBlock>,
    live: &mut IdSet<SymbolId>,
    kept: &dyn Fn(SymbolId) -> bool,
    graph: &Graph,
) -> Vec<Statement> {
    let mut needed: Vec<Statement> = Vec::with_capacity(statements.len());
    // True if a later statement remains, and if one remains before the next remark.
    let (mut remains, mut followed) = (false, false);
    for mut statement in statements.into_iter().rev() {
        let is_needed = |symbol: SymbolId| live.contains(&symbol) || kept(symbol);
        if let Statement::Solve { targets, .. }
        | Statement::Multipliers { targets, .. }
        | Statement::Friction { targets, .. } = &mut statement
        {
            for target in targets {
                *target = target.filter(|&symbol| is_needed(symbol));
            }
        }
        let keep = match &statement {
            Statement::Factorize => {
                let mut later = needed.iter();
                later.any(|later| matches!(later, Statement::Solve { .. }))
            }
            Statement::Newton { .. } => remains || statement.targets().into_iter().any(is_needed),
            Statement::Isolate { .. } | Statement::Require { .. } => true,
            // Drivers must be valid, whatever is requested.
            Statement::Positive { .. } => true,
            // A check is needed by all later statements of the function.
            Statement::Reach { .. } | Statement::Nonzero { .. } => remains,
            Statement::Section(_) => std::mem::take(&mut followed),
            _ if statement.is_said() => followed,
            _ => statement.targets().into_iter().any(is_needed),
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
