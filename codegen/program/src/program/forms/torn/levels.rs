//! States rates and accelerations of all unknowns from the steps of a sequence and the inverse of its residuals' Jacobian.

use super::Torn;
use super::rests::rest_rate;
use super::stated::Stated;
use crate::expr::{ExprId, SymbolId};
use crate::pool::SymbolRole;
use crate::program::builder::Builder;
use crate::program::function::{Level, Statement};

/// States a level: derivatives at constant tearing variables, then those of the tearing variables, then the total.
pub(super) fn solve_level(
    torn: &Torn,
    steps: &mut [Stated],
    places: &[usize],
    inverse: &[ExprId],
    level: Level,
    builder: &mut Builder<'_>,
) {
    let before = std::mem::take(&mut builder.statements);
    for step in steps.iter_mut() {
        step.rates(level, builder);
    }
    let level_statements = std::mem::replace(&mut builder.statements, before);
    let symbol_at = |unknown: usize, builder: &Builder<'_>| {
        let unknown = &builder.system.vector_form.unknowns[unknown];
        match level {
            Level::Velocity => unknown.rate,
            _ => unknown.acceleration,
        }
    };
    let zero = builder.graph().zero();
    let tears: Vec<SymbolId> = torn
        .sequence
        .tears
        .iter()
        .map(|&tear| symbol_at(tear, builder))
        .collect();
    let mut held: Vec<(SymbolId, ExprId)> = tears.iter().map(|&tear| (tear, zero)).collect();
    let mut moved: Vec<(SymbolId, ExprId, ExprId)> = Vec::new();
    for statement in level_statements {
        let Statement::Let { target, value, .. } = statement else {
            builder.state(statement);
            continue;
        };
        let at_rest = builder.graph().substitute(value, &held);
        if at_rest == value {
            builder.assign(target, value);
            continue;
        }
        let name = format!("{}_held", builder.system.symbol_name(target, builder.pool));
        let resting = builder.value(&name, at_rest);
        held.push((target, resting));
        moved.push((target, value, resting));
    }
    let mut drifts = Vec::with_capacity(places.len());
    for remaining in &torn.sequence.remaining {
        let drift = rest_rate(torn, steps, *remaining, level, builder);
        let drift = builder.graph().substitute(drift, &held);
        drifts.push(builder.value("drift", drift));
    }
    for (row, &tear) in inverse.chunks(places.len()).zip(&tears) {
        let terms = row.iter().zip(&drifts);
        let terms: Vec<ExprId> = terms
            .map(|(&entry, &drift)| builder.graph().multiply(entry, drift))
            .collect();
        let sum = builder.graph().sum(&terms);
        let value = builder.graph().negate(sum);
        builder.assign(tear, value);
    }
    for (target, value, resting) in moved {
        let unknown = match builder.pool.role(target) {
            SymbolRole::Rate(unknown) | SymbolRole::Acceleration(unknown) => Some(unknown),
            _ => None,
        };
        let whole = match unknown {
            None => value,
            Some(unknown) => {
                let mut terms = vec![resting];
                for (&place, &tear) in places.iter().zip(&tears) {
                    let response = builder.derivatives.of_unknown(unknown, place, builder.pool);
                    let tear = builder.graph().variable(tear);
                    terms.push(builder.graph().multiply(response, tear));
                }
                builder.graph().sum(&terms)
            }
        };
        builder.assign(target, whole);
    }
}
