//! *Equations and an angle* → *whether the angle a turn further is the same pose*.
//!
//! Closed forms and proofs find directions of links. That is all that there is to know where angles occur in sines and cosines alone; but
//! where a gear, a rack or an equation of one's own counts turns, what follows from a direction depends on how often it has gone round.

use std::collections::{BTreeSet, HashSet};

use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::joint::Quantity;
use crate::program::{Function, Program, Statement};
use crate::system::System;
use crate::words::Singular;

/// Whether some equation of a mechanism counts the turns of an angle of which the others find the direction alone: then there are poses
/// that differ by turns of it.
pub fn counts_turns(system: &System, program: &Program) -> bool {
    let form = &system.vector_form;
    let graph = &system.mechanism.graph;
    let is_angle = |unknown: &usize| form.unknowns[*unknown].quantity == Quantity::Angle;
    let forms = program.forms.iter().flatten();
    let directed = forms.filter(|form| !matches!(form.singular(), Singular::Coefficient(_)));
    let directed = directed.flat_map(|form| form.unknowns());
    let mut directed: BTreeSet<usize> = directed.filter(is_angle).collect();
    let symbol = |unknown: usize| form.unknowns[unknown].position;
    let mut rows: Vec<ExprId> = form.rows.iter().map(|row| row.residual).collect();
    // What a whole number of turns follows from turns wholly itself.
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
            let own = graph.symbols(row).iter();
            let others = (0..form.unknowns.len())
                .filter(|it| is_angle(it) && !directed.contains(it))
                .filter(|&it| own.clone().any(|own| *own == symbol(it)));
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

/// The number that an angle is multiplied by in a sum that is linear in it.
fn coefficient(sum: ExprId, angle: SymbolId, graph: &Graph) -> Option<f64> {
    let Node::Sum(terms) = graph.node(sum) else {
        return None;
    };
    let is_it = |expr: ExprId| matches!(graph.node(expr), Node::Symbol(own) if *own == angle);
    let own = terms.iter().find(|term| is_it(term.expr))?;
    let tainted = HashSet::from([angle]);
    let mut others = terms.iter().filter(|term| !is_it(term.expr));
    others
        .all(|term| !winds(term.expr, angle, &tainted, graph))
        .then(|| own.coefficient.to_f64())
}

/// Whether a function is the same where an angle is a turn further: it occurs in sines and cosines alone, as often as a whole number says.
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

/// Whether an expression is another one a turn further.
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

/// Whether an angle is the same direction where another one is a turn further.
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
    fn what_counts_turns_is_not_periodic() {
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
