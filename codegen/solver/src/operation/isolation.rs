//! Bounds the deviations of all unknowns from the chord of a window.

use linkwright::generated::{Chord, TimeWindow, isolate_all, isolate_whole_chain};
use linkwright_codegen::stages::expr::{Code, Register};
use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, Dyn, OMatrix, OVector};

use super::{Operation, run};

/// Bounds on deviations from the chord, as registers; see [`isolate_all`].
#[derive(Clone, Debug)]
pub(crate) struct Isolation {
    /// True for a chain; see [`isolate_whole_chain`].
    pub is_chain: bool,
    /// Block of each equation: an index into the plan.
    pub blocks: Vec<usize>,
    pub bounds: Vec<Register>,
    pub curvatures: Vec<Register>,
    pub changes: Vec<Register>,
    pub sizes: Vec<Register>,
    pub jacobian: Vec<([usize; 2], Register)>,
    pub turns: Vec<bool>,
    pub turning: Vec<([usize; 2], Register)>,
    /// Deviation of each unknown.
    pub found: Vec<Register>,
    pub variation: Vec<Operation>,
    pub varied: Vec<([usize; 2], Register)>,
}

impl Isolation {
    /// Finds the deviations of all unknowns.
    ///
    /// # Errors
    /// The index in the plan of the block whose verification fails.
    pub fn find(
        &self,
        window: &TimeWindow,
        code: &Code,
        registers: &mut [f64],
    ) -> Result<(), usize> {
        // Small vectors and matrices of a known dimension lie on the stack.
        match self.found.len() {
            1 => self.find_in(Const::<1>, window, code, registers),
            2 => self.find_in(Const::<2>, window, code, registers),
            3 => self.find_in(Const::<3>, window, code, registers),
            4 => self.find_in(Const::<4>, window, code, registers),
            5 => self.find_in(Const::<5>, window, code, registers),
            6 => self.find_in(Const::<6>, window, code, registers),
            order => self.find_in(Dyn(order), window, code, registers),
        }
    }

    fn find_in<D: Dim>(
        &self,
        order: D,
        window: &TimeWindow,
        code: &Code,
        registers: &mut [f64],
    ) -> Result<(), usize>
    where
        DefaultAllocator: Allocator<D> + Allocator<D, D>,
    {
        let fill = |matrix: &mut OMatrix<f64, D, D>,
                    entries: &[([usize; 2], Register)],
                    registers: &[f64]| {
            for &([row, column], register) in entries {
                matrix[(row, column)] = registers[register.index()];
            }
        };
        let vector = |places: &[Register]| {
            let values = places.iter().map(|it| registers[it.index()]);
            OVector::from_iterator_generic(order, Const::<1>, values)
        };
        let matrix = |entries, registers: &[f64]| {
            let mut matrix = OMatrix::zeros_generic(order, order);
            fill(&mut matrix, entries, registers);
            matrix
        };
        let turns = self.turns.iter().copied();
        let chord = Chord {
            remainder: window.remainder,
            bounds: vector(&self.bounds),
            curvatures: vector(&self.curvatures),
            changes: vector(&self.changes),
            sizes: vector(&self.sizes),
            jacobian: &mut matrix(&self.jacobian, registers),
            turns: OVector::from_iterator_generic(order, Const::<1>, turns),
            turning: &mut matrix(&self.turning, registers),
        };
        let deviations = match self.is_chain {
            true => isolate_whole_chain(window, chord),
            false => isolate_all(chord, |deviations, variation| {
                for (register, deviation) in self.found.iter().zip(deviations.iter()) {
                    registers[register.index()] = *deviation;
                }
                for operation in &self.variation {
                    // Functions of bounds cannot fail.
                    let _ = run(operation, code, registers, 0.0, 0);
                }
                fill(variation, &self.varied, registers);
            }),
        };
        let deviations = deviations.map_err(|row| self.blocks[row])?;
        for (register, deviation) in self.found.iter().zip(deviations.iter()) {
            registers[register.index()] = *deviation;
        }
        Ok(())
    }
}
