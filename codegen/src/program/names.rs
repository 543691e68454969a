//! Names of local values.

use std::collections::{HashMap, HashSet};

use crate::expr::{ExprId, Node, Number};
use crate::system::{SymbolRole, System};

/// The names given so far in one function.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    taken: HashSet<String>,
    /// The last number given to each base name.
    numbers: HashMap<String, usize>,
}

impl Names {
    /// Names beside those that are taken.
    pub(super) fn beside(taken: impl Iterator<Item = String>) -> Names {
        Names {
            taken: taken.collect(),
            numbers: HashMap::new(),
        }
    }

    /// `shared_1` for a value that is used again, `exponential_1` or `piece_1` for the value of a function.
    pub(super) fn value(&mut self, node: &Node) -> String {
        let base = match node {
            Node::Atan2(..) => "angle",
            Node::Exp(_) => "exponential",
            Node::Ln(_) => "logarithm",
            Node::Floor(_) => "whole",
            Node::Choose { .. } => "piece",
            _ => "shared",
        };
        self.numbered(base)
    }

    /// `lift_1`, `lift_1_slope`, `lift_1_second`, `lift_1_third`: a table and its derivatives at one place.
    pub(super) fn spline(&mut self, table: &str) -> [String; 4] {
        let base = table.to_lowercase();
        loop {
            let value = self.numbered(&base);
            let names = ["", "_slope", "_second", "_third"].map(|order| format!("{value}{order}"));
            if names[1..].iter().all(|name| !self.taken.contains(name)) {
                self.taken.extend(names[1..].iter().cloned());
                return names;
            }
        }
    }

    fn numbered(&mut self, base: &str) -> String {
        let number = self.numbers.entry(base.to_string()).or_insert(0);
        loop {
            *number += 1;
            let name = format!("{base}_{number}");
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }

    /// `sin_phi1` and `cos_phi1`; the names of other angles are numbered.
    pub(super) fn sine_and_cosine(&mut self, angle: ExprId, system: &System) -> (String, String) {
        let base = match system.mechanism.graph.node(angle) {
            Node::Symbol(symbol) => match system.roles[symbol.index()] {
                SymbolRole::Position(coordinate) => {
                    Some(system.unknown_name(coordinate).to_string())
                }
                SymbolRole::Time => Some("t".to_string()),
                _ => None,
            },
            _ => multiple_of_time(angle, system),
        };
        let base = base.filter(|base| self.taken.insert(format!("sin_{base}")));
        let base = base.unwrap_or_else(|| self.numbered("argument"));
        (format!("sin_{base}"), format!("cos_{base}"))
    }
}

/// `2t` of 2·t, `3t_over_2` of 3/2·t.
fn multiple_of_time(angle: ExprId, system: &System) -> Option<String> {
    let Node::Sum(terms) = system.mechanism.graph.node(angle) else {
        return None;
    };
    let [term] = &**terms else { return None };
    let Node::Symbol(symbol) = system.mechanism.graph.node(term.expr) else {
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
    let short = (1..1000).contains(&numerator) && denominator < 1000;
    if system.roles[symbol.index()] != SymbolRole::Time || !short {
        return None;
    }
    let multiple = if numerator == 1 {
        "t".to_string()
    } else {
        format!("{numerator}t")
    };
    Some(if denominator == 1 {
        multiple
    } else {
        format!("{multiple}_over_{denominator}")
    })
}
