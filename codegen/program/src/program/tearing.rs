//! Solves a block explicitly from some of its unknowns, the tearing variables.
//!
//! For given tearing variables, closed forms give the other unknowns, and as many residuals remain as there are tearing
//! variables. Tearing only saves work: Newton-Raphson on all equations decides wherever tearing fails.

use std::collections::HashSet;

use super::function::{Function, Statement};
use super::passes::liveness;
use crate::expr::{ExprId, Graph, SymbolId};

/// Largest number of tearing variables with a solution of the residuals by Cramer's rule.
pub const MOST_TEARS: usize = 2;

/// Torn block as functions of its tearing variables and of earlier results.
#[derive(Clone, Debug)]
pub struct Tearing {
    /// Tearing variables: indices into the block's unknowns, from 0.
    pub tears: Vec<usize>,
    /// Number of angles among the other unknowns.
    pub angles: usize,
    /// Signs of the closed forms, one symbol each.
    pub signs: Vec<SymbolId>,
    /// Results of `evaluate` that `complete` needs, in order.
    pub carried: Vec<SymbolId>,
    /// Row of the block that scales each residual, with the factor of `scales`.
    pub rows: Vec<usize>,
    /// Factors, one per residual.
    pub scales: Function,
    /// Magnitude of each residual's terms in the design configuration, in scales, and at least 1; rounding is proportional to it.
    pub terms: Vec<f64>,
    /// Residuals, the inverse of their Jacobian in the tearing variables row by row, and its determinant; fails if a closed form
    /// fails.
    pub evaluate: Function,
    /// Cosine of each unknown, or the unknown itself if it is a length; then their sines, rates and accelerations; then all
    /// residuals of the block; then the responses of the unknowns to the tearing variables, in scales.
    pub complete: Function,
    /// Functions that prove poses.
    pub proof: Proof,
    /// Values with the signs of the closed forms at a pose: a function of all unknowns.
    pub sign_values: Function,
}

/// Functions of the tearing variables and signs that vanish with the tearing residuals, before simplification.
#[derive(Clone, Debug)]
pub struct Proof {
    /// One result for each residual, and then their derivatives in the tearing variables row by row.
    pub function: Function,
    /// Components of rotated vectors that closed forms find, with the squared lengths of these vectors.
    pub turned: Vec<(SymbolId, ExprId)>,
}

/// Fields of a torn block besides its unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct TornFields {
    /// Sine and cosine of each unknown; `None` if the unknown is a length.
    pub directions: Vec<Option<[SymbolId; 2]>>,
    /// Determinant, and signs of the closed forms.
    pub memory: Vec<SymbolId>,
}

impl TornFields {
    /// Returns the symbols of all fields.
    pub fn targets(&self) -> impl Iterator<Item = SymbolId> {
        let directions = self.directions.iter().flatten().flatten();
        directions.chain(&self.memory).copied()
    }
}

impl Tearing {
    /// Returns the functions of the torn block.
    pub fn functions(&self) -> [&Function; 4] {
        [
            &self.scales,
            &self.evaluate,
            &self.complete,
            &self.sign_values,
        ]
    }

    /// Returns all statements and results of `evaluate` and `complete` in one function, so that shared values have one name.
    pub fn named(&self) -> Function {
        let results = self.evaluate.results.first();
        let assigned = self.signs.iter().zip(results.into_iter().cycle());
        let assigned = assigned.map(|(&sign, result)| Statement::assignment(sign, result.expr));
        let parts = [&self.evaluate, &self.complete];
        let statements = parts.into_iter().flat_map(|part| part.statements.clone());
        Function {
            statements: assigned.chain(statements).collect(),
            ..Function::default()
        }
    }

    /// Returns the functions for changes.
    pub(super) fn functions_mut(&mut self) -> [&mut Function; 4] {
        [
            &mut self.scales,
            &mut self.evaluate,
            &mut self.complete,
            &mut self.sign_values,
        ]
    }
}

/// Returns the function of results with the statements that they need.
pub(super) fn needed(statements: Vec<Statement>, results: Vec<ExprId>, graph: &Graph) -> Function {
    let function = Function {
        statements,
        ..Function::of_results(results)
    };
    liveness::for_results(function, graph)
}

/// Splits statements into those for `evaluated` and the additional ones for `completed`; returns the values passed from the first
/// to the second too.
pub(super) fn parted(
    statements: &[Statement],
    evaluated: Vec<ExprId>,
    completed: Vec<ExprId>,
    later: &[Statement],
    graph: &Graph,
) -> (Function, Function, Vec<SymbolId>) {
    let evaluate = needed(statements.to_vec(), evaluated, graph);
    let defined: HashSet<SymbolId> = evaluate.targets().collect();
    let mut complete = needed([statements, later].concat(), completed, graph);
    complete.statements.retain(|statement| {
        let targets = statement.targets();
        !targets.is_empty() && !targets.iter().all(|target| defined.contains(target))
    });
    let read: HashSet<SymbolId> = complete
        .values()
        .flat_map(|expr| graph.symbols(expr))
        .copied()
        .collect();
    let mut carried: Vec<SymbolId> = Vec::new();
    for target in evaluate.targets().filter(|target| read.contains(target)) {
        if !carried.contains(&target) {
            carried.push(target);
        }
    }
    (evaluate, complete, carried)
}
