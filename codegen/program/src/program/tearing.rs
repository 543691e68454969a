//! How the unknowns of a block follow one after another from some of them, its tears.
//!
//! With the tears given, closed forms find the other unknowns, and as many equations remain as there are tears. That is a shortcut
//! of Newton-Raphson on all equations, which decides wherever it does not lead through.

use std::collections::HashSet;

use super::function::{Function, Statement};
use super::passes::liveness;
use crate::expr::{ExprId, Graph, SymbolId};

/// The most tears for which the remaining equations are solved by Cramer's rule.
pub const MOST_TEARS: usize = 2;

/// A torn block as functions of its tears and of what is known before it.
#[derive(Clone, Debug)]
pub struct Tearing {
    /// Which of the block's unknowns are tears, from 0.
    pub tears: Vec<usize>,
    /// How many of the other unknowns are angles.
    pub angles: usize,
    /// The signs of the closed forms, one symbol each.
    pub signs: Vec<SymbolId>,
    /// What `evaluate` finds and `complete` needs, in order.
    pub carried: Vec<SymbolId>,
    /// The row of the block that says how large each residual is, where it is multiplied by the result of `scales`.
    pub rows: Vec<usize>,
    /// One factor a residual.
    pub scales: Function,
    /// How large the terms of each residual are in the drawing, in scales, and at least 1: rounding is a part of them.
    pub terms: Vec<f64>,
    /// The residuals, the inverse of their Jacobian in the tears row by row, and its determinant; fails where closed forms do.
    pub evaluate: Function,
    /// Of each unknown its cosine, or itself where it is a length; then their sines, rates and accelerations; then all residuals of the
    /// block; then how the unknowns respond to the tears, in scales.
    pub complete: Function,
    /// What poses are proven with.
    pub proof: Proof,
    /// What has the signs of the closed forms at a pose: a function of all unknowns.
    pub sign_values: Function,
}

/// Functions of the tears and signs that vanish where what remains does, as they were stated.
#[derive(Clone, Debug)]
pub struct Proof {
    /// One result for each residual, and then their derivatives by the tears row by row.
    pub function: Function,
    /// Components of vectors that turn, which closed forms find, with the squares of these vectors' lengths.
    pub turned: Vec<(SymbolId, ExprId)>,
}

/// What a frame keeps of a torn block beside its unknowns, and what a pose is computed from.
#[derive(Clone, Debug, PartialEq)]
pub struct TornFields {
    /// The sine and the cosine of each unknown that is an angle.
    pub directions: Vec<Option<[SymbolId; 2]>>,
    /// The determinant, and the signs of the closed forms.
    pub memory: Vec<SymbolId>,
}

impl TornFields {
    /// All that it defines.
    pub fn targets(&self) -> impl Iterator<Item = SymbolId> {
        let directions = self.directions.iter().flatten().flatten();
        directions.chain(&self.memory).copied()
    }
}

impl Tearing {
    /// Its functions.
    pub fn functions(&self) -> [&Function; 4] {
        [
            &self.scales,
            &self.evaluate,
            &self.complete,
            &self.sign_values,
        ]
    }

    /// Everything that `evaluate` and `complete` define or are given beside the tears, so that what both mention has one name.
    pub fn named(&self) -> Function {
        let results = self.evaluate.results.first();
        let given = self.signs.iter().zip(results.into_iter().cycle());
        let given = given.map(|(&sign, result)| Statement::assignment(sign, result.expr));
        let parts = [&self.evaluate, &self.complete];
        let found = parts.into_iter().flat_map(|part| part.statements.clone());
        Function {
            statements: given.chain(found).collect(),
            ..Function::default()
        }
    }

    /// The same, to be changed.
    pub(super) fn functions_mut(&mut self) -> [&mut Function; 4] {
        [
            &mut self.scales,
            &mut self.evaluate,
            &mut self.complete,
            &mut self.sign_values,
        ]
    }
}

/// The statements that results need.
pub(super) fn needed(statements: Vec<Statement>, results: Vec<ExprId>, graph: &Graph) -> Function {
    let function = Function {
        statements,
        ..Function::of_results(results)
    };
    liveness::for_results(function, graph)
}

/// Parts statements into those that the first results need, and those that the others need beside them; and says what is carried
/// from the first to the others.
pub(super) fn parted(
    statements: &[Statement],
    evaluated: Vec<ExprId>,
    completed: Vec<ExprId>,
    later: &[Statement],
    graph: &Graph,
) -> (Function, Function, Vec<SymbolId>) {
    let evaluate = needed(statements.to_vec(), evaluated, graph);
    let found: HashSet<SymbolId> = evaluate.targets().collect();
    let mut complete = needed([statements, later].concat(), completed, graph);
    complete.statements.retain(|statement| {
        let targets = statement.targets();
        !targets.is_empty() && !targets.iter().all(|target| found.contains(target))
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
