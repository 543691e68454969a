//! Determines whether equations are periodic in an angle.
//!
//! Closed forms and proofs find directions of links, which suffices if angles only occur in sines and cosines. Gears, racks or
//! user equations may count turns, so that results depend on the number of turns too.

use std::collections::{BTreeSet, HashSet};

use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::program::{Function, Program, Statement};
use crate::system::System;
use crate::words::Singular;

/// True if an equation counts the turns of an angle of which the others only find the direction: poses then exist that differ by
/// turns of this angle.
pub fn counts_turns(pool: &Pool, system: &System, program: &Program) -> bool {
    let form = &system.vector_form;
    let graph = &pool.graph;
    let is_angle = |unknown: &usize| form.unknowns[*unknown].quantity == Quantity::Angle;
    let forms = program.forms.iter().flatten();
    let directed = forms.filter(|form| !matches!(form.singular(), Singular::Coefficient(_)));
    let directed = directed.flat_map(|form| form.unknowns());
    let mut directed: BTreeSet<usize> = directed.filter(is_angle).collect();
    let symbol = |unknown: usize| form.unknowns[unknown].position;
    let mut rows: Vec<ExprId> = form.rows.iter().map(|row| row.residual).collect();
    // Angles that follow from an integer number of turns are periodic too.
    loop {
        let before = rows.len();
        let mut left = Vec::new();
        for &row in &rows {
            let counted: Vec<usize> = directed
                .iter()
                .copied()
                .filter(|&it| winds(row, symbol(it), &HashSet::from([symbol(it)]), graph))
                .collect();
            if counted.is_empty() {
                left.push(row);
                continue;
            }
            let symbols = graph.symbols(row).iter();
            let others = (0..form.unknowns.len())
                .filter(|it| is_angle(it) && !directed.contains(it))
                .filter(|&it| symbols.clone().any(|own| *own == symbol(it)));
            let [other] = others.collect::<Vec<usize>>()[..] else {
                return true;
            };
            let Some(divisor) = coefficient(row, symbol(other), graph) else {
                return true;
            };
            let is_whole = |&it: &usize| {
                let ratio = coefficient(row, symbol(it), graph).map(|own| own / divisor);
                ratio.is_some_and(|ratio| ratio.fract() == 0.0)
            };
            if !counted.iter().all(is_whole) {
                return true;
            }
            directed.insert(other);
        }
        rows = left;
        if rows.len() == before {
            return false;
        }
    }
}

/// Returns the coefficient of an angle in a sum that is linear in the angle.
fn coefficient(sum: ExprId, angle: SymbolId, graph: &Graph) -> Option<f64> {
    let Node::Sum(terms) = graph.node(sum) else {
        return None;
    };
    let is_it = |expr: ExprId| matches!(graph.node(expr), Node::Symbol(own) if *own == angle);
    let matching_term = terms.iter().find(|term| is_it(term.expr))?;
    let tainted = HashSet::from([angle]);
    let mut others = terms.iter().filter(|term| !is_it(term.expr));
    others
        .all(|term| !winds(term.expr, angle, &tainted, graph))
        .then(|| matching_term.coefficient.to_f64())
}

/// True if a function is periodic in an angle: the angle occurs only in sines and cosines, with integer factors.
pub(super) fn is_periodic(function: &Function, angle: SymbolId, graph: &Graph) -> bool {
    let mut tainted = HashSet::from([angle]);
    for statement in &function.statements {
        match *statement {
            Statement::Let { target, value, .. } => {
                if winds(value, angle, &tainted, graph) {
                    tainted.insert(target);
                }
            }
            Statement::SineCosine { angle: of, .. } => {
                if !turns_wholly(of, angle, &tainted, graph) {
                    return false;
                }
            }
            _ => {
                let mut values = statement.values().into_iter();
                if values.any(|value| mentions(value, &tainted, graph)) {
                    return false;
                }
            }
        }
    }
    let mut results = function.results.iter();
    results.all(|result| !winds(result.expr, angle, &tainted, graph))
}

fn mentions(expr: ExprId, tainted: &HashSet<SymbolId>, graph: &Graph) -> bool {
    let mut symbols = graph.symbols(expr).iter();
    symbols.any(|symbol| tainted.contains(symbol))
}

/// True if an expression may change with one more turn of an angle.
fn winds(expr: ExprId, angle: SymbolId, tainted: &HashSet<SymbolId>, graph: &Graph) -> bool {
    if !mentions(expr, tainted, graph) {
        return false;
    }
    let of = |expr: ExprId| winds(expr, angle, tainted, graph);
    match graph.node(expr) {
        Node::Sum(terms) => terms.iter().any(|term| of(term.expr)),
        Node::Product(factors) => factors.iter().any(|factor| of(factor.base)),
        Node::Sin(inner) | Node::Cos(inner) => !turns_wholly(*inner, angle, tainted, graph),
        _ => true,
    }
}

/// True if an expression changes by whole turns while an angle changes by one turn.
fn turns_wholly(expr: ExprId, angle: SymbolId, tainted: &HashSet<SymbolId>, graph: &Graph) -> bool {
    match graph.node(expr) {
        Node::Symbol(symbol) => *symbol == angle || !tainted.contains(symbol),
        Node::Sum(terms) => terms.iter().all(|term| {
            let is_whole = || {
                let coefficient = term.coefficient.to_f64();
                coefficient.fract() == 0.0 && term.coefficient.is_rational()
            };
            match graph.node(term.expr) {
                Node::Symbol(symbol) if *symbol == angle => is_whole(),
                _ => !winds(term.expr, angle, tainted, graph),
            }
        }),
        _ => !winds(expr, angle, tainted, graph),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Number;

    #[test]
    fn counting_turns_is_not_periodic() {
        let mut graph = Graph::new();
        let [phi, other] = ["phi", "other"].map(|name| graph.symbol(name));
        let [angle, free] = [phi, other].map(|symbol| graph.variable(symbol));
        let half = graph.scale(Number::float(0.5), angle);
        let twice = graph.add(angle, angle);
        let moved = graph.subtract(free, twice);
        let [whole, parted] = [moved, half].map(|angle| graph.sin(angle));
        let rack = graph.add(whole, angle);
        let periodic = |expr: ExprId| is_periodic(&Function::of_results([expr]), phi, &graph);
        assert!(periodic(whole) && periodic(free));
        assert!(!periodic(parted) && !periodic(rack));
    }
}
