//! Limits blocks to what some observables need, as the `output` statements of a description limit generated code.

use std::sync::Arc;

use linkwright::Blocks as _;
use linkwright_codegen::stages::expr::Register;

use super::Interpreted;
use super::reduced::Reduced;
use crate::observable::Observable;
use crate::operation::Operation;

/// Operations and registers of limited blocks.
#[derive(Clone, Debug)]
pub(super) struct Limited {
    pub reduced: Reduced,
    /// Slots of instants with their registers. Other slots are zero.
    pub stored: Vec<(usize, Register)>,
}

impl Interpreted {
    /// Returns the blocks without what these observables do not need. The values of observables keep their bits; a quantity that is left out
    /// cannot fail. Blocks that compare whole instants, or that blame loads, stay as they are.
    pub(crate) fn limited_to(&self, observables: &[Observable]) -> Interpreted {
        let limited = match self.may_cross() || self.loads.is_some() {
            true => None,
            false => self.limits(observables),
        };
        let mut blocks = self.clone();
        if let Some(limited) = limited {
            blocks.emitted = None;
            // Registers of quantities that are left out hold zeros.
            let registers = limited.reduced.code.registers().to_vec();
            blocks.registers = registers.into();
            blocks.limited = Some(Arc::new(limited));
        }
        blocks
    }

    fn limits(&self, observables: &[Observable]) -> Option<Limited> {
        let compiled = &*self.compiled;
        let first = compiled.layout.solved().start;
        let mut is_needed = vec![false; compiled.layout.symbols().len()];
        is_needed[..first].fill(true);
        for slot in self.slots_of(observables) {
            *is_needed.get_mut(slot)? = true;
        }
        if let Some(path) = &compiled.path {
            path.slots().for_each(|slot| is_needed[slot] = true);
        }
        let blocks = compiled.blocks.iter();
        let blocks: Vec<&[Operation]> = blocks.map(|it| &it.operations[..]).collect();
        loop {
            let kept = compiled.kept.iter().zip(&is_needed[first..]);
            let read = kept.filter(|(_, needed)| **needed).map(|(it, _)| *it);
            let reduced = Reduced::new(&compiled.code, &blocks, read)?;
            let mut is_complete = true;
            for &(register, slot) in &compiled.last {
                if reduced.reads.has(register) && !is_needed[slot] {
                    is_needed[slot] = true;
                    is_complete = false;
                }
            }
            if is_complete {
                let stored = compiled.stored();
                return Some(Limited {
                    stored: stored.filter(|(slot, _)| is_needed[*slot]).collect(),
                    reduced,
                });
            }
        }
    }

    /// Slots from which observables are read.
    fn slots_of(&self, observables: &[Observable]) -> Vec<usize> {
        let formulas = self.points_of(observables);
        let slots = observables.iter().filter_map(|it| match *it {
            Observable::Coordinate { place, level } => self.coordinate_slot(place, level),
            Observable::Point { place, axis, level } => self.point_slot(place, level, axis),
            Observable::Reported(column) => self.reported_slot(column),
        });
        let of_points = formulas.iter().flat_map(|it| it.slots());
        slots.chain(of_points).collect()
    }
}
