//! Transmits unit loads and superposes them: reactions are linear in all loads.

use super::free_bodies;
use super::reaction::Multipliers;
use super::virtual_work::{Carried, sweep};
use crate::expr::{ExprId, SymbolId};
use crate::program::builder::Builder;
use crate::program::forms::Transposed;
use crate::structure::SolvedPlan;
use crate::words::Piece;

/// Reactions to loads, and to multiples of unit loads besides.
pub(super) struct Superposed {
    /// Multipliers of all rows.
    pub multipliers: Multipliers,
    /// Reactions to each unit load, and the amount of this unit.
    units: Vec<(Carried, ExprId)>,
}

impl Superposed {
    /// Superposes reactions to these amounts of unit loads; values are named `name_p_x`.
    pub fn new(
        alone: &Multipliers,
        units: Vec<(Carried, Multipliers)>,
        amounts: &[ExprId],
        name: &str,
        builder: &mut Builder<'_>,
    ) -> Superposed {
        let mut multipliers = alone.clone();
        for (place, multiplier) in multipliers.rows.iter_mut().enumerate() {
            let mut terms = vec![*multiplier];
            for ((_, unit), &amount) in units.iter().zip(amounts) {
                terms.push(builder.graph().multiply(amount, unit.rows[place]));
            }
            let sum = builder.graph().sum(&terms);
            let name = free_bodies::named(name, place, builder);
            *multiplier = builder.value(&name, sum);
        }
        let units = units.into_iter().map(|(carried, _)| carried);
        Superposed {
            multipliers,
            units: units.zip(amounts.iter().copied()).collect(),
        }
    }

    /// Returns the work of the unit loads along the value of a driver.
    pub fn along(&self, shift: SymbolId, builder: &mut Builder<'_>) -> ExprId {
        let amounts: Vec<ExprId> = self.units.iter().map(|(_, amount)| *amount).collect();
        self.along_with(&amounts, shift, builder)
    }

    /// Returns the work of other amounts of the unit loads along the value of a driver.
    pub fn along_with(
        &self,
        amounts: &[ExprId],
        shift: SymbolId,
        builder: &mut Builder<'_>,
    ) -> ExprId {
        let units = self.units.iter().zip(amounts);
        let terms = units.map(|((unit, _), amount)| {
            let work = unit.along(shift, builder);
            builder.graph().multiply(*amount, work)
        });
        let terms: Vec<ExprId> = terms.collect();
        builder.graph().sum(&terms)
    }
}

/// Transmits a unit load; names begin with `prefix`. Returns what subsystems carry, and the multipliers of all rows.
pub(super) fn transmitted(
    load: Vec<ExprId>,
    prefix: &str,
    plan: &SolvedPlan,
    transposed: &[Vec<Option<Transposed>>],
    builder: &mut Builder<'_>,
) -> (Carried, Vec<ExprId>) {
    let zero = builder.graph().zero();
    let load = load.into_iter().enumerate();
    let load = load.map(|(unknown, value)| {
        let name = builder.system.unknown_name(unknown).to_string();
        builder.value(&format!("{prefix}load_{name}"), value)
    });
    let load: Vec<ExprId> = load.collect();
    let carried = sweep(plan, transposed, &load, prefix, builder);
    let multipliers = free_bodies::multipliers(plan, &load, &carried, prefix, builder);
    let values = multipliers.into_iter();
    let rows = values.enumerate().map(|(place, value)| {
        let name = free_bodies::named(&format!("{prefix}carried"), place, builder);
        let named = builder.value(&name, value);
        if value != zero && builder.graph().is_constant(value) {
            builder.show(|_| {
                vec![[
                    Piece::Local(name).into(),
                    Piece::Formula(value).into(),
                    "".into(),
                ]]
            });
        }
        named
    });
    let rows = rows.collect();
    (carried, rows)
}
