//! Adds the reactions of monitored rows so that the norm of all reactions is smallest.
//!
//! If rows repeat others, reactions of these rows against the others balance to zero and may be added in any amount. A unit
//! reaction of each monitored row is transmitted like a load, which gives the reactions of all other rows. Of all sums, the one
//! with the least sum of squared components over all joints is chosen. Forces count as they are, moments divided by the
//! characteristic length (Björck 1996, Numerical Methods for Least Squares Problems, section 1.1). The normal equations have one
//! row per monitored row and a positive definite matrix.

use super::characteristic;
use super::reaction::{Multipliers, components};
use super::unit::{Superposed, transmitted};
use super::virtual_work::Carried;
use crate::expr::{ExprId, Node, SymbolId};
use crate::model::Role;
use crate::program::builder::Builder;
use crate::program::forms::Transposed;
use crate::program::function::Statement;
use crate::structure::SolvedPlan;
use crate::system::Component;
use crate::words::Piece;

/// Returns the multipliers of all rows with the least norm, from those of the vector form alone.
pub(super) fn shared(
    plan: &SolvedPlan,
    transposed: &[Vec<Option<Transposed>>],
    alone: Vec<ExprId>,
    builder: &mut Builder<'_>,
) -> Superposed {
    let (zero, one) = (builder.graph().zero(), builder.graph().one());
    let count = builder.system.monitored.len();
    let mut units: Vec<(Carried, Multipliers)> = Vec::with_capacity(count);
    for (row, load) in unit_loads(builder).into_iter().enumerate() {
        builder.say(|builder| {
            let monitored_row = &builder.system.monitored[row];
            let label = &builder.system.mechanism.joints[monitored_row.joint].label;
            let number = row + 1;
            format!("Rigid bodies leave open what {label} carries. A unit of it, share {number}, is balanced by these:").into()
        });
        let prefix = format!("unit_{}_", row + 1);
        let (carried, rows) = transmitted(load, &prefix, plan, transposed, builder);
        let mut monitored = vec![zero; count];
        monitored[row] = one;
        units.push((carried, Multipliers { rows, monitored }));
    }
    let alone = Multipliers {
        rows: alone,
        monitored: vec![zero; count],
    };
    builder.say(|_| {
        "Any multiple of these may be added; the squares of all forces, and of all moments over the characteristic length, have the least sum where:".into()
    });
    let shares = shares(&alone, &units, builder);
    let mut shared = Superposed::new(&alone, units, &shares, "shared", builder);
    shared.multipliers.monitored = shares;
    shared
}

/// Returns the loads of a unit multiplier of each monitored row on every unknown.
fn unit_loads(builder: &mut Builder<'_>) -> Vec<Vec<ExprId>> {
    let zero = builder.graph().zero();
    let unknowns = builder.system.vector_form.unknowns.len();
    let mut loads = vec![vec![zero; unknowns]; builder.system.monitored.len()];
    for joint in 0..builder.system.mechanism.joints.len() {
        for (row, columns) in builder.passing(joint).monitored {
            for (unknown, value) in columns {
                loads[row][unknown] = builder.graph().negate(value);
            }
        }
    }
    loads
}

/// Returns the amount of each unit in the least norm.
fn shares(
    alone: &Multipliers,
    units: &[(Carried, Multipliers)],
    builder: &mut Builder<'_>,
) -> Vec<ExprId> {
    let zero = builder.graph().zero();
    let count = units.len();
    // Coefficients of the normal equations.
    let mut products = vec![vec![Vec::new(); count]; count];
    let mut against = vec![Vec::new(); count];
    for joint in 0..builder.system.mechanism.joints.len() {
        if builder.system.mechanism.joints[joint].role != Role::Constraint {
            continue;
        }
        let components = weighed(joint, alone, "alone", builder);
        let of_units: Vec<Vec<ExprId>> = units
            .iter()
            .enumerate()
            .map(|(row, (_, unit))| weighed(joint, unit, &format!("unit_{}", row + 1), builder))
            .collect();
        for (row, one) in of_units.iter().enumerate() {
            for (component, &value) in one.iter().enumerate() {
                if value == zero {
                    continue;
                }
                let product = builder.graph().multiply(value, components[component]);
                against[row].push(builder.graph().negate(product));
                for (column, other) in of_units.iter().enumerate().take(row + 1) {
                    let product = builder.graph().multiply(value, other[component]);
                    products[row][column].push(product);
                }
            }
        }
    }
    let mut matrix = vec![zero; count * count];
    for row in 0..count {
        for column in 0..=row {
            let sum = builder.graph().sum(&products[row][column]);
            let sum = builder.value(&format!("product_{}_{}", row + 1, column + 1), sum);
            matrix[row * count + column] = sum;
            matrix[column * count + row] = sum;
        }
    }
    let against: Vec<ExprId> = against
        .iter()
        .map(|terms| builder.graph().sum(terms))
        .collect();
    if let (&[product], &[against]) = (&matrix[..], &against[..]) {
        let share = builder.graph().divide(against, product);
        return vec![builder.value("share_1", share)];
    }
    let targets: Vec<SymbolId> = (1..=count)
        .map(|number| builder.pool.intermediate(&format!("share_{number}")))
        .collect();
    builder.show(|builder| {
        let equations = (0..count).map(|row| {
            let terms = targets.iter().zip(&matrix[row * count..]);
            let terms: Vec<ExprId> = terms
                .map(|(&target, &factor)| {
                    let share = builder.graph().variable(target);
                    builder.graph().multiply(factor, share)
                })
                .collect();
            let sum = builder.graph().sum(&terms);
            [
                Piece::Formula(sum).into(),
                Piece::Formula(against[row]).into(),
                "".into(),
            ]
        });
        equations.collect()
    });
    builder.state(Statement::Multipliers {
        targets: targets.iter().copied().map(Some).collect(),
        jacobian: matrix,
        forces: against,
    });
    let graph = builder.graph();
    targets.into_iter().map(|it| graph.variable(it)).collect()
}

/// Returns the components of a joint's reaction, in N.
fn weighed(
    joint: usize,
    multipliers: &Multipliers,
    name: &str,
    builder: &mut Builder<'_>,
) -> Vec<ExprId> {
    let length = characteristic(builder.pool, builder.system);
    let slug = builder.system.mechanism.joints[joint].slug.clone();
    let system = &builder.system;
    let mut rows = system.rows.iter().chain(&system.monitored);
    let measured = rows.find(|row| row.joint == joint);
    // The multiplier of an equation is the work per unit of its residual.
    let power = measured.map_or(1, |row| row.quantity.power_of_length());
    let values = components(joint, multipliers, builder).into_iter();
    let weighed = values.map(|(component, value)| {
        let lengths = match component {
            Component::Moment => -1,
            Component::Multiplier => power - 1,
            _ => 0,
        };
        let graph = builder.graph();
        let mut value = value;
        for _ in 0..lengths.max(0) {
            value = graph.multiply(value, length);
        }
        for _ in 0..(-lengths).max(0) {
            value = graph.divide(value, length);
        }
        if matches!(graph.node(value), Node::Number(_)) {
            return value;
        }
        builder.value(&format!("{name}_{slug}_{}", component.suffix()), value)
    });
    weighed.collect()
}
