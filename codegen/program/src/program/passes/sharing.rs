//! Makes functions compute every value once.
//!
//! Function calls have a name, and so have values of several uses, right before their first use. In a block, functions of t,
//! inputs and parameters serve all levels. Rotated vectors and closed forms need no more: their sines and cosines are symbols
//! already. If equations contain the path of a curve or a law of an unknown, all their parts are shared, and so are those of very
//! long values: code then grows with the graph of expressions, and not with the expanded tree.

use std::collections::HashMap;

use super::costs::{is_function, written_operands};
use super::usage::{Orders, Usage};
use crate::expr::{ExprId, Graph, IdMap, IdSet, Node, Number, SplineId, SymbolId};
use crate::pool::{Pool, SymbolRole};
use crate::program::function::{Function, Statement};
use crate::program::quantities::rotated_component;
use crate::system::System;

/// Length of a value, in characters, from which on all its parts are shared.
const MAX_LENGTH: u64 = 4000;

/// Length of a sum in parentheses, in characters, from which on the sum has its own statement.
const LONGEST_NESTED: u64 = 3000;

/// Numerator or denominator from which on the name of a multiple of t omits them.
const LARGEST_IN_NAME: i128 = 1000;

/// Shares common subexpressions of a function of a block.
pub(in crate::program) fn share(function: &mut Function, pool: &mut Pool, system: &System) {
    let values: Vec<ExprId> = function.values().collect();
    let timed = functions_of_time(&values, pool);
    name(function, &timed, pool, system);
    let graph = &pool.graph;
    let is_named = |expr| function.name_of(expr).is_some();
    let mut long = values
        .iter()
        .filter(|&&expr| !graph.is_within_with_names(expr, MAX_LENGTH, &is_named));
    if long.next().is_some() || calls_functions(&values, function, graph) {
        name(function, &values, pool, system);
    }
}

/// Shares all common subexpressions of a function.
pub(in crate::program) fn share_all(function: &mut Function, pool: &mut Pool, system: &System) {
    let values: Vec<ExprId> = function.values().collect();
    name(function, &values, pool, system);
}

/// Names those parts of these expressions that deserve a name.
fn name(function: &mut Function, roots: &[ExprId], pool: &mut Pool, system: &System) {
    let graph = &pool.graph;
    let usage = Usage::of(roots, graph, function);
    let whole: IdSet<ExprId> = roots.iter().copied().collect();
    let mut deserving: IdSet<ExprId> = IdSet::default();
    for &expr in &usage.ordered {
        let has_name = |part| deserving.contains(&part) || function.name_of(part).is_some();
        let is_nested = matches!(graph.node(expr), Node::Sum(_))
            && !usage.is_arm(expr)
            && !whole.contains(&expr);
        let breaks_line =
            || is_nested && !graph.is_within_with_names(expr, LONGEST_NESTED, &has_name);
        if usage.deserves_name(expr, graph) || breaks_line() {
            deserving.insert(expr);
        }
    }
    if deserving.is_empty() {
        return;
    }
    let mut sharing = Sharing {
        usage,
        deserving,
        numbers: HashMap::new(),
        seen: IdSet::default(),
        statements: Vec::with_capacity(function.statements.len()),
        named: std::mem::take(&mut function.named),
    };
    for statement in std::mem::take(&mut function.statements) {
        let targets = statement.targets();
        for value in statement.values() {
            sharing.define_parts(value, &targets, pool, system);
        }
        sharing.statements.push(statement);
    }
    for result in &function.results {
        sharing.define_parts(result.expr, &[], pool, system);
    }
    function.statements = sharing.statements;
    function.named = sharing.named;
}

/// Function under construction.
struct Sharing {
    usage: Usage,
    deserving: IdSet<ExprId>,
    /// Last number of each name.
    numbers: HashMap<String, usize>,
    seen: IdSet<ExprId>,
    statements: Vec<Statement>,
    named: IdMap<ExprId, SymbolId>,
}

impl Sharing {
    /// Defines the unnamed parts of an expression that deserve a name, operands first. An expression that is the value of these
    /// `targets` is written out there, so its parts must be defined before.
    fn define_parts(
        &mut self,
        expr: ExprId,
        targets: &[SymbolId],
        pool: &mut Pool,
        system: &System,
    ) {
        // True if the operands of the expression on the stack have been visited.
        let mut stack = vec![(expr, false)];
        while let Some((expr, done)) = stack.pop() {
            let graph = &pool.graph;
            let name = self.named.get(&expr);
            if done {
                if self.deserving.contains(&expr) && name.is_none() {
                    self.define(expr, pool, system);
                }
            } else if !graph.is_constant(expr)
                && name.is_none_or(|name| targets.contains(name))
                && self.seen.insert(expr)
            {
                stack.push((expr, true));
                let operands = written_operands(expr, graph).into_iter().rev();
                stack.extend(operands.map(|operand| (operand, false)));
            }
        }
    }

    fn define(&mut self, expr: ExprId, pool: &mut Pool, system: &System) {
        match *pool.graph.node(expr) {
            Node::Sin(angle) | Node::Cos(angle) => self.define_angle(expr, angle, pool, system),
            Node::Spline {
                spline, argument, ..
            } => self.define_lookup(spline, argument, pool),
            ref node => {
                let base = match node {
                    _ if pool.graph.magnitude_of(expr).is_some() => "size",
                    Node::Atan2(..) => "angle",
                    Node::Exp(_) => "exponential",
                    Node::Ln(_) => "logarithm",
                    Node::Floor(_) => "whole",
                    Node::Choose { .. } => "piece",
                    _ => "shared",
                };
                let name = match base {
                    "shared" => rotated_component(expr, pool, system),
                    _ => None,
                };
                let name = name.unwrap_or_else(|| self.numbered(base));
                let target = self.call(expr, &name, pool);
                self.statements.push(Statement::assignment(target, expr));
            }
        }
    }

    fn define_angle(&mut self, expr: ExprId, angle: ExprId, pool: &mut Pool, system: &System) {
        let base = angle_name(angle, pool, system).unwrap_or_else(|| self.numbered("argument"));
        let both = self.usage.sine_cosine.get(&angle).copied();
        let [sine, cosine] = ["sin", "cos"].map(|function| format!("{function}_{base}"));
        if let Some((Some(first), Some(second))) = both {
            let sine = self.call(first, &sine, pool);
            let cosine = self.call(second, &cosine, pool);
            self.statements.push(Statement::SineCosine {
                sine,
                cosine,
                angle,
            });
            return;
        }
        let name = match pool.graph.node(expr) {
            Node::Sin(_) => sine,
            _ => cosine,
        };
        let target = self.call(expr, &name, pool);
        self.statements.push(Statement::assignment(target, expr));
    }

    fn define_lookup(&mut self, spline: SplineId, argument: ExprId, pool: &mut Pool) {
        let orders: Orders = self
            .usage
            .splines
            .get(&(spline, argument))
            .copied()
            .unwrap_or_default();
        let base = pool.graph.spline_of(spline).name.to_lowercase();
        let base = self.numbered(&base);
        let mut targets = [None; 4];
        for (place, suffix) in ["", "_slope", "_second", "_third"].into_iter().enumerate() {
            targets[place] =
                orders[place].map(|expr| self.call(expr, &format!("{base}{suffix}"), pool));
        }
        let named: Vec<(ExprId, SymbolId)> = orders
            .iter()
            .zip(targets)
            .filter_map(|(order, target)| order.zip(target))
            .collect();
        self.statements.push(match named[..] {
            [(expr, target)] => Statement::assignment(target, expr),
            _ => Statement::Lookup {
                targets,
                spline,
                argument,
            },
        });
    }

    fn call(&mut self, expr: ExprId, name: &str, pool: &mut Pool) -> SymbolId {
        let symbol = pool.intermediate(name);
        self.named.insert(expr, symbol);
        symbol
    }

    /// Returns a numbered name: `shared_1`, `lift_2`.
    fn numbered(&mut self, base: &str) -> String {
        let number = self.numbers.entry(base.to_string()).or_insert(0);
        *number += 1;
        format!("{base}_{number}")
    }
}

/// Returns the name of an angle in the names of its functions: `phi1`, `t`, `2t`.
fn angle_name(angle: ExprId, pool: &Pool, system: &System) -> Option<String> {
    match pool.graph.node(angle) {
        Node::Symbol(symbol) => match pool.role(*symbol) {
            SymbolRole::Position(unknown) => Some(system.unknown_name(unknown).to_string()),
            SymbolRole::Time => Some("t".to_string()),
            _ => None,
        },
        _ => multiple_of_time(angle, pool),
    }
}

/// Returns `2t` for 2·t, `3t_over_2` for 3/2·t; otherwise `None`.
fn multiple_of_time(angle: ExprId, pool: &Pool) -> Option<String> {
    let Node::Sum(terms) = pool.graph.node(angle) else {
        return None;
    };
    let [term] = &**terms else { return None };
    let Node::Symbol(symbol) = pool.graph.node(term.expr) else {
        return None;
    };
    let Number::Exact {
        rational,
        radicand: 1,
    } = term.coefficient
    else {
        return None;
    };
    let (numerator, denominator) = (rational.numerator(), rational.denominator());
    let short = (1..LARGEST_IN_NAME).contains(&numerator) && denominator < LARGEST_IN_NAME;
    if pool.role(*symbol) != SymbolRole::Time || !short {
        return None;
    }
    let multiple = match numerator {
        1 => "t".to_string(),
        _ => format!("{numerator}t"),
    };
    Some(match denominator {
        1 => multiple,
        _ => format!("{multiple}_over_{denominator}"),
    })
}

/// Returns the function calls of t, inputs and parameters alone that are not inside another one.
fn functions_of_time(expressions: &[ExprId], pool: &Pool) -> Vec<ExprId> {
    let graph = &pool.graph;
    let only_time = |expr: ExprId| {
        graph.symbols(expr).iter().all(|symbol| {
            matches!(
                pool.role(*symbol),
                SymbolRole::Time | SymbolRole::Parameter(_) | SymbolRole::Input { .. }
            )
        })
    };
    let mut calls = Vec::new();
    let mut seen = IdSet::default();
    let mut stack: Vec<ExprId> = expressions.iter().rev().copied().collect();
    while let Some(expr) = stack.pop() {
        if graph.is_constant(expr) || !seen.insert(expr) {
            continue;
        }
        if is_function(graph.node(expr)) && only_time(expr) {
            calls.push(expr);
            continue;
        }
        stack.extend(written_operands(expr, graph).into_iter().rev());
    }
    calls
}

/// True if a function call in these expressions has no name yet.
fn calls_functions(expressions: &[ExprId], function: &Function, graph: &Graph) -> bool {
    let mut seen: IdSet<ExprId> = IdSet::default();
    let mut stack = expressions.to_vec();
    while let Some(expr) = stack.pop() {
        if graph.is_constant(expr) || function.name_of(expr).is_some() || !seen.insert(expr) {
            continue;
        }
        if is_function(graph.node(expr)) {
            return true;
        }
        stack.extend(graph.operands(expr));
    }
    false
}
