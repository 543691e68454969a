//! What blocks evaluate → the functions of time and the constants in it, and what it costs.

use std::collections::HashSet;

use super::{Action, BlockProgram, Level};
use crate::expr::{ExprId, Node, SymbolId};
use crate::program::addends::{Compared, bases, compared};
use crate::program::constants::Constants;
use crate::program::operations::{is_function, written_operands};
use crate::program::{Addend, Operations, Straight, addends};
use crate::system::{SymbolRole, System, WrittenOrder};

/// Every expression that a block writes out.
pub(super) fn evaluated(actions: &[Action], newton: Option<&super::NewtonBlock>) -> Vec<ExprId> {
    let mut expressions: Vec<ExprId> = actions.iter().flat_map(Action::values).collect();
    if let Some(newton) = newton {
        expressions.extend(newton.geometry.iter().flat_map(Action::values));
        expressions.extend(newton.expressions());
    }
    expressions
}

/// The operations of each level in all blocks, the last two those of all responses to drivers and to parameters.
pub(super) fn operations(blocks: &[BlockProgram], system: &System) -> [Operations; 5] {
    let mut levels = [Operations::default(); 5];
    for block in blocks {
        let mut level = 0;
        let time = block
            .time
            .for_results(&evaluated(&block.actions, None), system);
        // Functions of time serve all levels; they count with the first.
        levels[0] += time.operations(&system.mechanism.graph);
        for action in &block.actions {
            if let Action::Section(section) = action {
                level = match section {
                    Level::Position => 0,
                    Level::Velocity => 1,
                    Level::Acceleration => 2,
                    Level::Response(direction) | Level::ResponseRate(direction) => {
                        3 + usize::from(system.directions[*direction].is_parameter())
                    }
                };
            }
            levels[level] += operations_of(action, system, block.named());
        }
    }
    levels
}

/// Sines and the like of t, inputs and parameters, which every use shares.
pub(super) fn functions_of_time(
    expressions: &[ExprId],
    system: &System,
    constants: &mut Constants,
) -> Straight {
    let graph = &system.mechanism.graph;
    let only_time = |expr: ExprId| {
        graph.symbols(expr).iter().all(|symbol: &SymbolId| {
            matches!(
                system.roles[symbol.index()],
                SymbolRole::Time | SymbolRole::Parameter(_) | SymbolRole::Input { .. }
            )
        })
    };
    let mut found = Vec::new();
    let mut seen = HashSet::new();
    let mut stack: Vec<ExprId> = expressions.iter().rev().copied().collect();
    while let Some(expr) = stack.pop() {
        if graph.is_constant(expr) || !seen.insert(expr) {
            continue;
        }
        if is_function(graph.node(expr)) && only_time(expr) {
            found.push(expr);
            continue;
        }
        stack.extend(written_operands(expr, graph).into_iter().rev());
    }
    Straight::new(
        found.into_iter().map(|expr| (expr, Vec::new())).collect(),
        system,
        constants,
    )
}

/// Names the constants that these expressions are written with.
pub(super) fn note_constants(
    expressions: &[ExprId],
    system: &System,
    time: &Straight,
    constants: &mut Constants,
) {
    visit(expressions, system, time, &mut |parts| {
        for constant in parts.iter().filter_map(|part| part.constant.as_ref()) {
            constants.add(constant, &system.mechanism.graph);
        }
    });
}

fn operations_of(action: &Action, system: &System, time: &Straight) -> Operations {
    let mut operations = Operations::default();
    if let Action::Share(statement) = action {
        return time.operations_of(statement, system);
    }
    let counted = match action {
        // What a failure reports is computed only then.
        Action::Reach { excess, scale, .. } => vec![*excess, *scale],
        _ => action.values(),
    };
    let functions = visit(&counted, system, time, &mut |parts| {
        operations += Operations::of_addends(parts)
    });
    operations += functions;
    match action {
        Action::SineCosine { .. } => operations.sines += 2,
        Action::Angle { .. } => operations.arctangents += 1,
        _ => {}
    }
    operations
}

/// Calls `each` with the addends of every expression that is written out, and returns what the functions among them take.
fn visit(
    expressions: &[ExprId],
    system: &System,
    time: &Straight,
    each: &mut dyn FnMut(&[Addend]),
) -> Operations {
    let mut functions = Operations::default();
    let graph = &system.mechanism.graph;
    let order = WrittenOrder::new(system, &[]);
    let mut stack = expressions.to_vec();
    while let Some(expr) = stack.pop() {
        if time.name_of(expr).is_some() || matches!(graph.node(expr), Node::Symbol(_)) {
            continue;
        }
        let named = |other: ExprId| time.name_of(other).is_some();
        if !graph.is_constant(expr) {
            functions += Operations::of_function(graph.node(expr));
        }
        match *graph.node(expr) {
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let Compared { left, right, .. } = compared(condition, graph, &order, &named);
                for side in [left, right] {
                    each(&side);
                    stack.extend(bases(&side));
                }
                stack.extend([below, otherwise]);
            }
            ref node if is_function(node) && !graph.is_constant(expr) => {
                stack.extend(graph.operands(expr));
            }
            _ => {
                let parts = addends(expr, graph, &order, &named);
                each(&parts);
                stack.extend(bases(&parts).filter(|&base| base != expr));
            }
        }
    }
    functions
}
