//! Writes pairs of components as a sum of vectors: positions of origins, rotated local vectors, constants.

use std::collections::BTreeSet;

use super::System;
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::Vector;
use crate::pool::{Arm, Pool};

/// Term of a sum of vectors, with its factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VectorTerm {
    /// Origin of a body: an index into the mechanism's bodies.
    Origin(usize, ExprId),
    /// R(φ) s of an unknown φ.
    Turned(usize, Vector, ExprId),
    /// Constant vector.
    Constant(Vector),
}

impl System {
    /// Returns two expressions as one sum of vectors, never empty; `None` if they are not the components of such a sum.
    pub fn vector_sum(&self, pair: Vector, pool: &mut Pool) -> Option<Vec<VectorTerm>> {
        let mut terms = Vec::new();
        let mut rest = pair;
        // Terms come from these unknowns only: removing a term adds no unknown.
        let [x, y] = pair.map(|part| pool.mentioned(part));
        let mentioned: BTreeSet<usize> = x.into_iter().chain(y).collect();
        let mut bodies = BTreeSet::new();
        let mut others = Vec::new();
        for unknown in mentioned {
            match self.vector_form.unknowns[unknown].describes.body() {
                Some(body) => drop(bodies.insert(body)),
                None => others.push(unknown),
            }
        }
        for body in bodies {
            if let [Some(x), Some(y), _] = self.mechanism.bodies[body].coordinates {
                let symbols = [x.symbol, y.symbol];
                if let Some(factor) = take_factor(&mut rest, symbols, &mut pool.graph) {
                    terms.push(VectorTerm::Origin(body, factor));
                }
            }
            take_arms(self.vector_form.angle_of(body), &mut rest, &mut terms, pool);
        }
        for other in others {
            take_arms(other, &mut rest, &mut terms, pool);
        }
        let graph = &pool.graph;
        if !rest.iter().all(|&part| graph.is_fixed(part)) {
            return None;
        }
        if rest != [graph.zero(); 2] || terms.is_empty() {
            terms.push(VectorTerm::Constant(rest));
        }
        Some(terms)
    }
}

/// Moves the vectors that an angle rotates out of a sum.
fn take_arms(angle: usize, rest: &mut Vector, terms: &mut Vec<VectorTerm>, pool: &mut Pool) {
    let arms: Vec<Arm> = pool.arms_of(angle).cloned().collect();
    for arm in arms {
        if let Some(factor) = take_factor(rest, arm.symbols, &mut pool.graph) {
            terms.push(VectorTerm::Turned(angle, arm.local, factor));
        }
    }
}

/// Moves a vector with these symbols as components out of a sum. Returns its factor if both components have the same factor.
fn take_factor(rest: &mut Vector, symbols: [SymbolId; 2], graph: &mut Graph) -> Option<ExprId> {
    if !symbols
        .iter()
        .zip(*rest)
        .all(|(&symbol, part)| graph.depends_on(part, symbol))
    {
        return None;
    }
    let zero = graph.zero();
    let factors = [0, 1].map(|axis| graph.derivative(rest[axis], symbols[axis]));
    let other = [0, 1].map(|axis| graph.derivative(rest[axis], symbols[1 - axis]));
    if factors[0] != factors[1] || factors[0] == zero || other != [zero, zero] {
        return None;
    }
    *rest = rest.map(|part| graph.substitute(part, &symbols.map(|it| (it, zero))));
    Some(factors[0])
}
