//! How far each step of a block is from singular → fields of the frame.
//!
//! A closed form has its determinant at hand: divided by the lengths of the two vectors it is the sine of the angle between
//! them. A Newton block is measured by the runtime, with the factorization that finds its rates. Nothing of this is computed
//! where no `monitor` statement asks for it.

use super::block::Pending;
use super::builder::Builder;
use crate::expr::SymbolId;
use crate::structure::{Step, determinant};

/// The fields that hold how far a step is from singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// The sine of the angle between the two vectors of a closed form.
    Sine(SymbolId),
    /// The coefficient of a linear step.
    Slope(SymbolId),
    /// The determinant of a Newton block with columns of length 1, and its reciprocal condition.
    Block([SymbolId; 2]),
}

impl Measured {
    /// Its fields.
    pub fn fields(&self) -> Vec<SymbolId> {
        match self {
            Measured::Sine(field) | Measured::Slope(field) => vec![*field],
            Measured::Block(both) => both.to_vec(),
        }
    }
}

impl Builder<'_> {
    /// The measure of a closed form whose position has been found; `None` where it is never singular.
    pub(super) fn measured(&mut self, step: &Step, found: &Pending) -> Option<Measured> {
        let size = {
            let graph = &mut self.system.mechanism.graph;
            determinant(step, &self.system.vector_form, graph).size
        };
        let value = found.determinant();
        let measure = match size {
            Some(size) => {
                // A length that moves is computed by itself; the others are part of a constant.
                let size = self.value("size", size);
                self.graph().divide(value, size)
            }
            None => value,
        };
        if self.graph().is_fixed(measure) {
            return None;
        }
        let name = self.closeness_name(step, "");
        let target = self.system.intermediate(&name);
        self.assign(target, measure);
        Some(match size {
            Some(_) => Measured::Sine(target),
            None => Measured::Slope(target),
        })
    }

    /// The fields of a Newton block's measure, which the runtime finds.
    pub(super) fn measured_block(&mut self, step: &Step) -> [SymbolId; 2] {
        ["", "_condition"].map(|suffix| {
            let name = self.closeness_name(step, suffix);
            self.system.intermediate(&name)
        })
    }

    /// `closeness_phi_c3_phi_c10`.
    fn closeness_name(&self, step: &Step, suffix: &str) -> String {
        let unknowns = step.unknowns().into_iter();
        let names: Vec<&str> = unknowns.map(|it| self.system.unknown_name(it)).collect();
        format!("closeness_{}{suffix}", names.join("_"))
    }
}

/// The fields of everything that is measured.
pub(super) fn measured_fields<'a>(
    measured: impl Iterator<Item = &'a Measured>,
) -> impl Iterator<Item = SymbolId> {
    measured.flat_map(Measured::fields)
}
