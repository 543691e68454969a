//! Makes the functions of tearing variables: tearing residuals, their derivatives, and the final results.

use std::collections::HashSet;

use super::Torn;
use super::completed::completed;
use super::levels::solve_level;
use super::rests::{Rest, inverse, rests};
use super::sequence::{Remaining, Step};
use super::stated::Stated;
use crate::expr::{ExprId, Node, SymbolId};
use crate::joint::Quantity;
use crate::pool::{Pool, SymbolRole};
use crate::program::block::NewtonBlock;
use crate::program::builder::Builder;
use crate::program::function::{Function, Level, Statement};
use crate::program::tearing::{Proof, Tearing, needed, parted};
use crate::system::System;

pub(super) fn is_angle(unknown: usize, builder: &Builder<'_>) -> bool {
    builder.system.vector_form.unknowns[unknown].quantity == Quantity::Angle
}

/// Returns the functions; `None` if the design configuration does not decide the sign of a closed form.
pub(super) fn tearing(
    torn: &Torn,
    block: &NewtonBlock,
    builder: &mut Builder<'_>,
) -> Option<Tearing> {
    let places = builder
        .derivatives
        .tear(&torn.sequence.tears, builder.pool, builder.system);
    let before = builder.begin_inside();
    let tearing = stated(torn, &places, block, builder);
    builder.end_inside(before);
    builder.derivatives.mend(&places);
    tearing
}

fn stated(
    torn: &Torn,
    places: &[usize],
    block: &NewtonBlock,
    builder: &mut Builder<'_>,
) -> Option<Tearing> {
    let sequence = &torn.sequence;
    let (mut steps, sign_values) = positions(torn, builder)?;
    let rests = rests(torn, &mut steps, places, builder);
    let (determinant, inverse) = inverse(&rests, builder);
    let residuals = rests.iter().map(|rest| rest.residual);
    let evaluated: Vec<ExprId> = residuals
        .chain(inverse.iter().copied())
        .chain([determinant])
        .collect();
    let statements = std::mem::take(&mut builder.statements);
    for level in [Level::Velocity, Level::Acceleration] {
        solve_level(torn, &mut steps, places, &inverse, level, builder);
    }
    let later = std::mem::take(&mut builder.statements);
    let completed = completed(torn, places, block, builder)?;
    let all = statements.iter().chain(&later);
    let results = evaluated.iter().chain(&completed).copied();
    if reads_unfound(torn, all, results, builder.pool) {
        return None;
    }
    let graph = &builder.pool.graph;
    let (evaluate, complete, carried) = parted(&statements, evaluated, completed, &later, graph);
    let (scales, terms) = scales(torn, &steps, block, builder);
    let proof = proof(torn, &rests, statements, builder);
    let place = |tear| {
        let unknowns = torn.whole.unknowns.iter();
        unknowns.clone().position(|unknown| unknown == tear)
    };
    let signs = builder.inside.as_ref().map(|inside| &inside.signs);
    let others = torn.whole.unknowns.iter();
    let others = others.filter(|unknown| !sequence.tears.contains(unknown));
    Some(Tearing {
        angles: others.filter(|&&it| is_angle(it, builder)).count(),
        tears: sequence.tears.iter().filter_map(place).collect(),
        signs: signs.into_iter().flatten().map(|(sign, _)| *sign).collect(),
        carried,
        proof,
        rows: scales.iter().map(|(row, _)| *row).collect(),
        terms,
        scales: Function::of_results(scales.into_iter().map(|(_, factor)| factor)),
        evaluate,
        complete,
        sign_values: Function::of_results(sign_values),
    })
}

/// Returns the functions that prove poses. If three circles give everything, their determinant is not needed.
fn proof(
    torn: &Torn,
    rests: &[Rest],
    statements: Vec<Statement>,
    builder: &mut Builder<'_>,
) -> Proof {
    let sequence = &torn.sequence;
    if let (&[Step::ThreeCircles(ref circles)], &[tear]) =
        (&sequence.steps[..], &sequence.tears[..])
    {
        let shifts = builder.derivatives.shifts();
        let proof = circles.proof(tear, builder);
        let proof = proof.map(|part| builder.without(part, &shifts));
        return Proof {
            function: Function::of_results(proof),
            turned: Vec::new(),
        };
    }
    // A link between two pins is rotated to point from one to the other, whatever their distance.
    let closed = sequence.steps.iter().filter_map(|step| match step {
        Step::Closed(form) => Some(form.unknowns()),
        _ => None,
    });
    let mut turned = Vec::new();
    for unknown in closed.flatten() {
        let arms = builder.pool.arms_of(unknown);
        let arms: Vec<_> = arms.map(|arm| (arm.symbols, arm.local)).collect();
        for (symbols, local) in arms {
            let square = builder.dot(local, local);
            turned.extend(symbols.map(|symbol| (symbol, square)));
        }
    }
    let slopes = rests.iter().flat_map(|rest| &rest.slopes).copied();
    let results = rests.iter().map(|rest| rest.residual).chain(slopes);
    Proof {
        function: needed(statements, results.collect(), builder.graph()),
        turned,
    }
}

/// States the positions of all steps, and returns the values with the signs of their closed forms.
fn positions(torn: &Torn, builder: &mut Builder<'_>) -> Option<(Vec<Stated>, Vec<ExprId>)> {
    for &tear in &torn.sequence.tears {
        if is_angle(tear, builder) {
            builder.explicit_angle(tear);
        }
    }
    let (mut steps, mut sign_values) = (Vec::new(), Vec::new());
    for step in &torn.sequence.steps {
        steps.push(match step {
            Step::TwoPins(link) => Stated::TwoPins(link.position(builder)),
            Step::ThreeCircles(circles) => Stated::ThreeCircles(circles.position(builder)),
            Step::Closed(form) => {
                let solved = form.position(builder);
                sign_values.extend(sign_value(form.as_ref(), sign_values.len(), builder)?);
                Stated::Closed(solved)
            }
        });
    }
    Some((steps, sign_values))
}

/// True if these statements and results read the position of an unsolved unknown.
fn reads_unfound<'a>(
    torn: &Torn,
    statements: impl Iterator<Item = &'a Statement> + Clone,
    results: impl Iterator<Item = ExprId>,
    pool: &Pool,
) -> bool {
    let graph = &pool.graph;
    let targets: HashSet<SymbolId> = statements.clone().flat_map(Statement::targets).collect();
    let mut read = statements.flat_map(Statement::values).chain(results);
    let is_missing = |symbol: &SymbolId| {
        let unknown = match pool.role(*symbol) {
            SymbolRole::Position(unknown) => unknown,
            _ => return false,
        };
        torn.whole.unknowns.contains(&unknown)
            && !torn.sequence.tears.contains(&unknown)
            && !targets.contains(symbol)
    };
    read.any(|expr| graph.symbols(expr).iter().any(is_missing))
}

/// Returns, for each tearing residual, the index of its equation and the factor to the scale of that equation; and the magnitude
/// of its terms in the design configuration, at least 1.
fn scales(
    torn: &Torn,
    steps: &[Stated],
    block: &NewtonBlock,
    builder: &mut Builder<'_>,
) -> (Vec<(usize, ExprId)>, Vec<f64>) {
    let scales: Vec<(usize, ExprId)> = torn
        .sequence
        .remaining
        .iter()
        .map(|remaining| match *remaining {
            Remaining::Equation(at) => (at, builder.graph().one()),
            Remaining::Length { step, equation } => match steps[step].link() {
                Some(link) => (equation, link.length(builder)),
                None => (equation, builder.graph().one()),
            },
        })
        .collect();
    let terms = torn
        .sequence
        .remaining
        .iter()
        .map(|remaining| match *remaining {
            Remaining::Equation(at) => {
                let scale = block.scaled_by[0].scale(block.quantities[at]);
                (magnitude(torn.whole.residuals[at], builder.pool, builder.system) / scale).max(1.0)
            }
            Remaining::Length { .. } => 1.0,
        });
    (scales, terms.collect())
}

/// Returns the sum of the magnitudes of a sum's terms in the design configuration.
fn magnitude(sum: ExprId, pool: &Pool, system: &System) -> f64 {
    let graph = &pool.graph;
    match graph.node(sum) {
        Node::Sum(terms) => {
            let values = terms.iter();
            let values =
                values.map(|term| term.coefficient.to_f64() * system.drawn_value(term.expr, pool));
            values.map(f64::abs).sum()
        }
        _ => system.drawn_value(sum, pool).abs(),
    }
}

/// Returns the value with the sign of the last stated closed form, in terms of unknowns, if it has one. `None` if the design
/// configuration does not relate both signs.
fn sign_value(
    form: &dyn crate::program::forms::Form,
    known: usize,
    builder: &mut Builder<'_>,
) -> Option<Option<ExprId>> {
    let signs = builder.inside.as_ref().map(|inside| &inside.signs);
    let drawn = match signs.map_or(&[][..], |signs| &signs[known..]) {
        [] => return Some(None),
        [(_, drawn)] => *drawn,
        _ => return None,
    };
    let value = form.determinant(builder.pool).value?;
    let agreement = drawn * builder.system.drawn_value(value, builder.pool);
    // NaN must count as undecided, hence these comparisons.
    let (same, opposite) = (agreement > 0.0, agreement < 0.0);
    let graph = &mut builder.pool.graph;
    match (same, opposite) {
        (true, _) => Some(Some(value)),
        (_, true) => Some(Some(graph.negate(value))),
        _ => None,
    }
}
