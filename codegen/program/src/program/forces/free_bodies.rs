//! Derives the multipliers of all equations from those of subsystems, body by body.
//!
//! Column u of Φ_qᵀ λ = Q − M q̈ is the balance of forces along x or y, or of moments, of one free body. With known multipliers
//! of the subsystems, most columns have one unknown multiplier left, as in free-body diagrams by hand. If no column has, one
//! multiplier is expressed by others.
//!
//! Every body rotates independently here, so moments between tied bodies are found too. Multipliers of equations that tie angles
//! are found anew, since the subsystems know only one of such bodies.

use std::collections::{BTreeMap, BTreeSet};

use super::virtual_work::Carried;
use crate::expr::{ExprId, Node, SymbolId};
use crate::joint::Quantity;
use crate::program::builder::Builder;
use crate::program::function::Statement;
use crate::structure::SolvedPlan;
use crate::words::Piece;

/// Largest rounding residual of a balance that others imply, relative to its largest factor.
const DEPENDENT: f64 = 1e-9;

/// Balance: its unknown multipliers with their factors, and their sum.
struct Balance {
    factors: BTreeMap<usize, ExprId>,
    sum: Vec<ExprId>,
}

/// Returns the multiplier of every row of the vector form, with names that begin with `prefix`.
pub(super) fn multipliers(
    plan: &SolvedPlan,
    loads: &[ExprId],
    carried: &Carried,
    prefix: &str,
    builder: &mut Builder<'_>,
) -> Vec<ExprId> {
    let zero = builder.graph().zero();
    let rows = builder.system.vector_form.rows.len();
    let mut multipliers: Vec<Option<ExprId>> = vec![None; rows];
    for (&row, &multiplier) in &carried.multipliers {
        // Angles of tied bodies are one unknown in the subsystems.
        if builder.system.vector_form.rows[row].quantity != Quantity::Angle {
            multipliers[row] = Some(multiplier);
        }
    }
    let mut balances = balances(loads, builder);
    for (row, multiplier) in multipliers.iter().enumerate() {
        if let Some(multiplier) = multiplier {
            settle(row, *multiplier, &mut balances, builder);
        }
    }
    let order = order(plan, balances.len());
    let mut expressed: Vec<(usize, Balance)> = Vec::new();
    let mut open: BTreeSet<usize> = order.iter().copied().collect();
    while multipliers.iter().any(Option::is_none) && !open.is_empty() {
        let alone = order
            .iter()
            .copied()
            .find(|column| open.contains(column) && is_solvable(&balances[*column], 1, builder));
        if let Some(column) = alone {
            open.remove(&column);
            let Some((row, factor)) = only(&balances[column]) else {
                continue;
            };
            let sum = builder.graph().sum(&balances[column].sum);
            let value = builder.graph().divide(sum, factor);
            let value = builder.value(&name(prefix, row, builder), value);
            multipliers[row] = Some(value);
            settle(row, value, &mut balances, builder);
            continue;
        }
        // In a loop of bodies, the shortest balance expresses one multiplier by the others, which later balances determine.
        let shortest = order
            .iter()
            .copied()
            .filter(|column| {
                open.contains(column) && is_solvable(&balances[*column], usize::MAX, builder)
            })
            .min_by_key(|&column| balances[column].factors.len());
        let Some(column) = shortest else {
            break;
        };
        open.remove(&column);
        let balance = std::mem::replace(
            &mut balances[column],
            Balance {
                factors: BTreeMap::new(),
                sum: Vec::new(),
            },
        );
        let constant = |value: &ExprId| matches!(builder.pool.graph.node(*value), Node::Number(_));
        let Some((&row, &factor)) = balance.factors.iter().find(|(_, value)| constant(value))
        else {
            continue;
        };
        eliminate(row, factor, &balance, &mut balances, builder);
        expressed.push((row, balance));
    }
    let is_left = |row: &usize| {
        multipliers[*row].is_none() && !expressed.iter().any(|(expressed, _)| expressed == row)
    };
    let left: Vec<usize> = (0..rows).filter(is_left).collect();
    let remaining = order.iter().filter(|column| open.contains(column));
    let remaining: Vec<&Balance> = remaining.map(|&column| &balances[column]).collect();
    for (row, value) in at_once(&left, remaining, prefix, builder) {
        multipliers[row] = Some(value);
    }
    for (row, balance) in expressed.into_iter().rev() {
        let mut terms = balance.sum.clone();
        let mut factor_of_row = None;
        for (&other, &factor) in &balance.factors {
            if other == row {
                factor_of_row = Some(factor);
                continue;
            }
            let value = multipliers[other].unwrap_or(zero);
            let graph = builder.graph();
            let product = graph.multiply(factor, value);
            terms.push(graph.negate(product));
        }
        let (sum, one) = (builder.graph().sum(&terms), builder.graph().one());
        let value = builder.graph().divide(sum, factor_of_row.unwrap_or(one));
        let value = builder.value(&name(prefix, row, builder), value);
        multipliers[row] = Some(value);
    }
    multipliers
        .into_iter()
        .map(|it| it.unwrap_or(zero))
        .collect()
}

/// Solves for the remaining multipliers by as many independent balances, if parameters occur in all their factors.
fn at_once(
    left: &[usize],
    mut remaining: Vec<&Balance>,
    prefix: &str,
    builder: &mut Builder<'_>,
) -> Vec<(usize, ExprId)> {
    remaining.retain(|balance| left.iter().any(|row| balance.factors.contains_key(row)));
    if let ([row], [balance]) = (left, &remaining[..]) {
        let sum = builder.graph().sum(&balance.sum);
        let value = builder.graph().divide(sum, balance.factors[row]);
        return vec![(*row, builder.value(&name(prefix, *row, builder), value))];
    }
    let zero = builder.graph().zero();
    let chosen = independent(left, &remaining, builder);
    if left.is_empty() || chosen.len() < left.len() {
        return Vec::new();
    }
    builder.say(|_| {
        "Parameters change the factors of all that is left, which one linear system gives:".into()
    });
    let names: Vec<String> = left.iter().map(|&row| name(prefix, row, builder)).collect();
    let targets: Vec<SymbolId> = names
        .iter()
        .map(|name| builder.pool.intermediate(name))
        .collect();
    let factor = |row: &usize, balance: &Balance| balance.factors.get(row).copied();
    let forces: Vec<ExprId> = chosen
        .iter()
        .map(|balance| builder.graph().sum(&balance.sum))
        .collect();
    builder.show(|builder| {
        let equations = chosen.iter().zip(&forces).map(|(balance, &force)| {
            let terms: Vec<ExprId> = left
                .iter()
                .zip(&targets)
                .filter_map(|(row, &target)| {
                    let factor = factor(row, balance)?;
                    let graph = builder.graph();
                    let multiplier = graph.variable(target);
                    Some(graph.multiply(factor, multiplier))
                })
                .collect();
            let sum = builder.graph().sum(&terms);
            [
                Piece::Formula(sum).into(),
                Piece::Formula(force).into(),
                "".into(),
            ]
        });
        equations.collect()
    });
    let rows = left.iter().flat_map(|row| {
        let factors = chosen.iter().map(|balance| factor(row, balance));
        factors.map(|it| it.unwrap_or(zero)).collect::<Vec<_>>()
    });
    let jacobian = rows.collect();
    builder.state(Statement::Multipliers {
        targets: targets.iter().copied().map(Some).collect(),
        jacobian,
        forces,
    });
    let graph = builder.graph();
    let values = targets.into_iter().map(|target| graph.variable(target));
    left.iter().copied().zip(values).collect()
}

/// Returns as many balances as are independent in these multipliers, for the values of the description.
fn independent<'b>(
    left: &[usize],
    remaining: &[&'b Balance],
    builder: &Builder<'_>,
) -> Vec<&'b Balance> {
    let graph = &builder.pool.graph;
    let mut chosen = Vec::new();
    let mut reduced: Vec<(usize, Vec<f64>)> = Vec::new();
    for &balance in remaining {
        let factors = left.iter().map(|row| match balance.factors.get(row) {
            Some(&factor) => graph.constant_value(factor),
            None => Some(0.0),
        });
        let Some(mut factors) = factors.collect::<Option<Vec<f64>>>() else {
            continue;
        };
        let largest = |values: &[f64]| {
            let sizes = values.iter().map(|it| it.abs()).enumerate();
            sizes.max_by(|one, other| one.1.total_cmp(&other.1))
        };
        let size = largest(&factors).map_or(0.0, |(_, size)| size);
        for (pivot, earlier) in &reduced {
            let share = factors[*pivot] / earlier[*pivot];
            let pairs = factors.iter_mut().zip(earlier);
            pairs.for_each(|(own, other)| *own -= share * other);
        }
        if let Some((pivot, rest)) = largest(&factors)
            && rest > DEPENDENT * size
        {
            reduced.push((pivot, factors));
            chosen.push(balance);
        }
    }
    chosen
}

/// Returns the balance of every unknown.
fn balances(loads: &[ExprId], builder: &mut Builder<'_>) -> Vec<Balance> {
    let unknowns = builder.system.vector_form.unknowns.len();
    let mut balances: Vec<Balance> = (0..unknowns)
        .map(|unknown| Balance {
            factors: BTreeMap::new(),
            sum: loads.get(unknown).copied().into_iter().collect(),
        })
        .collect();
    for joint in 0..builder.system.mechanism.joints.len() {
        for (row, columns) in builder.passing(joint).rows {
            for (unknown, factor) in columns {
                balances[unknown].factors.insert(row, factor);
            }
        }
    }
    balances
}

/// Returns the columns in reverse order of solution: bodies are cut free from the end of the chain.
fn order(plan: &SolvedPlan, count: usize) -> Vec<usize> {
    let mut order = Vec::with_capacity(count);
    for block in plan.blocks.iter().rev() {
        order.extend(block.definitions.iter().rev().map(|it| it.unknown));
        order.extend(block.parts.iter().rev().flat_map(|part| &part.unknowns));
    }
    order
}

/// Substitutes a known multiplier in all balances.
fn settle(row: usize, value: ExprId, balances: &mut [Balance], builder: &mut Builder<'_>) {
    for balance in balances {
        if let Some(factor) = balance.factors.remove(&row) {
            let graph = builder.graph();
            let product = graph.multiply(factor, value);
            balance.sum.push(graph.negate(product));
        }
    }
}

/// Eliminates a multiplier, expressed by others, from all balances.
fn eliminate(
    row: usize,
    factor: ExprId,
    by: &Balance,
    balances: &mut [Balance],
    builder: &mut Builder<'_>,
) {
    for balance in balances {
        let Some(own) = balance.factors.remove(&row) else {
            continue;
        };
        let graph = builder.graph();
        let share = graph.divide(own, factor);
        let share = graph.negate(share);
        let zero = graph.zero();
        for (&other, &value) in by.factors.iter().filter(|(other, _)| **other != row) {
            let added = graph.multiply(share, value);
            let before = balance.factors.get(&other).copied().unwrap_or(zero);
            let after = graph.add(before, added);
            if after == zero {
                balance.factors.remove(&other);
            } else {
                balance.factors.insert(other, after);
            }
        }
        let sum = graph.sum(&by.sum);
        balance.sum.push(graph.multiply(share, sum));
    }
}

/// True if a balance has at most `most` unknown multipliers, and a number as the factor of one.
fn is_solvable(balance: &Balance, most: usize, builder: &Builder<'_>) -> bool {
    let graph = &builder.pool.graph;
    let mut factors = balance.factors.values();
    let has_constant = factors.any(|value| matches!(graph.node(*value), Node::Number(_)));
    has_constant && balance.factors.len() <= most
}

fn only(balance: &Balance) -> Option<(usize, ExprId)> {
    let (&row, &factor) = balance.factors.iter().next()?;
    Some((row, factor))
}

/// Returns the name of a multiplier: `carried_p_x`.
fn name(prefix: &str, row: usize, builder: &Builder<'_>) -> String {
    named(&format!("{prefix}carried"), row, builder)
}

/// Returns a name for a value of a row: `unit_p_x`.
pub(super) fn named(what: &str, row: usize, builder: &Builder<'_>) -> String {
    let row = &builder.system.vector_form.rows[row];
    let slug = &builder.system.mechanism.joints[row.joint].slug;
    match row.component {
        "" => format!("{what}_{slug}"),
        component => format!("{what}_{slug}_{component}"),
    }
}
