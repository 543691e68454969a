//! *The equations of a block without a closed form → its tears and their rates*, by the runtime's Newton-Raphson.

use std::cell::RefCell;

use linkwright::{Equations, Settings, assemble};
use linkwright_codegen::expr::{SymbolId, Tape};
use linkwright_codegen::program::solved::NewtonBlock;
use linkwright_codegen::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

use super::{Operation, Values, operations, run};

/// The equations of a block without a closed form.
#[derive(Clone, Debug)]
pub(super) struct Newton {
    positions: Vec<SymbolId>,
    rates: Vec<SymbolId>,
    scales: Vec<f64>,
    row_scales: Vec<f64>,
    geometry: Vec<Operation>,
    residuals: Tape,
    jacobian: Tape,
    time_derivative: Tape,
}

impl Newton {
    /// The equations as instructions.
    pub(super) fn new(block: &NewtonBlock, system: &System) -> Newton {
        let graph = &system.mechanism.graph;
        let unknowns: Vec<_> = block
            .unknowns
            .iter()
            .map(|&unknown| &system.vector_form.unknowns[unknown])
            .collect();
        Newton {
            positions: unknowns.iter().map(|it| it.position).collect(),
            rates: unknowns.iter().map(|it| it.rate).collect(),
            scales: unknowns
                .iter()
                .map(|it| system.scale(it.quantity))
                .collect(),
            row_scales: block
                .quantities
                .iter()
                .map(|it| system.scale(*it))
                .collect(),
            geometry: operations(block.geometry.iter(), system),
            residuals: Tape::new(graph, &block.residuals),
            jacobian: Tape::new(graph, &block.jacobian),
            time_derivative: Tape::new(graph, &block.time_derivative),
        }
    }

    /// Finds the tears and their rates from their last values.
    pub(super) fn solve(&self, values: &mut Values) -> bool {
        let start = self.positions.iter().map(|it| values.symbols[it.index()]);
        let start = DVector::from_iterator(self.positions.len(), start);
        let equations = At {
            newton: self,
            symbols: RefCell::new(values.symbols.clone()),
        };
        let Ok(frame) = assemble(&equations, &start, values.t, &Settings::default()) else {
            return false;
        };
        for (place, (position, rate)) in self.positions.iter().zip(&self.rates).enumerate() {
            values.symbols[position.index()] = frame.q[place];
            values.symbols[rate.index()] = frame.qd[place];
        }
        true
    }
}

/// The equations of a Newton block after the blocks before it.
struct At<'a> {
    newton: &'a Newton,
    symbols: RefCell<Vec<f64>>,
}

impl At<'_> {
    fn evaluate(&self, tape: &Tape, tears: &DVector<f64>, results: &mut [f64]) {
        let symbols = &mut *self.symbols.borrow_mut();
        let mut workspace = Vec::new();
        for (symbol, value) in self.newton.positions.iter().zip(tears.iter()) {
            symbols[symbol.index()] = *value;
        }
        for operation in &self.newton.geometry {
            run(operation, symbols, &mut workspace);
        }
        tape.evaluate(symbols, &mut workspace, results);
    }
}

impl Equations<f64, Dyn> for At<'_> {
    fn dimension(&self) -> Dyn {
        Dyn(self.newton.positions.len())
    }

    fn residual(&self, q: &DVector<f64>, _: f64, phi: &mut DVector<f64>) {
        self.evaluate(&self.newton.residuals, q, phi.as_mut_slice());
    }

    fn jacobian(&self, q: &DVector<f64>, _: f64, phi_q: &mut DMatrix<f64>) {
        let mut rows = vec![0.0; q.len() * q.len()];
        self.evaluate(&self.newton.jacobian, q, &mut rows);
        phi_q.copy_from(&DMatrix::from_row_slice(q.len(), q.len(), &rows));
    }

    fn time_derivative(&self, q: &DVector<f64>, _: f64, phi_t: &mut DVector<f64>) {
        self.evaluate(&self.newton.time_derivative, q, phi_t.as_mut_slice());
    }

    /// Accelerations are left to the textbook view.
    fn gamma(&self, _: &DVector<f64>, _: &DVector<f64>, _: f64, gamma: &mut DVector<f64>) {
        gamma.fill(0.0);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.newton.row_scales[row]
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.newton.scales[column]
    }
}
