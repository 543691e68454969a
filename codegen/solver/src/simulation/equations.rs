//! Evaluates the equations of motion of a mechanism with free coordinates in any pose: constraints, masses, loads, energies, powers.
//!
//! Free coordinates are unknowns like all others: with their values s after q, Φ(q, s, t) = 0 are joints and drivers, and f directions of
//! (q, s) are left to the forces. No block of the solved formulation is used, so that the choice of free coordinates does not matter.

use linkwright::{Signal, Values as _};
use linkwright_codegen::stages::expr::{ExprId, SymbolId};
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

use super::elongations::Elongations;
use crate::instant::{Instant, Layout};
use crate::reader::Reader;
use crate::supplied::{InputLaws, Numbers};

/// Equations of a mechanism that forces move.
#[derive(Clone, Debug)]
pub(crate) struct MotionEquations {
    layout: Layout,
    parameters: Numbers,
    laws: InputLaws,
    /// Evaluator of the residual of each constraint, then of the entries of Φ_q.
    constraints: Reader,
    entries: Vec<(usize, usize)>,
    /// Evaluator of Φ_t and γ of each constraint, Q − M q̈, the entries of M, the energies and the power.
    dynamics: Reader,
    masses: Vec<(usize, usize)>,
    /// Inputs that are the values of free coordinates.
    free: Vec<usize>,
    /// Elongations of springs and dampers.
    pub(super) elongations: Elongations,
    /// True for each unknown that is a length.
    pub is_length: Vec<bool>,
    /// Units of rows: lengths of the mechanism.
    pub row_scales: Vec<f64>,
    pub coordinate_scales: Vec<f64>,
}

/// Parameter or input that is varied while the mechanism rests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Varied {
    /// Index among the parameters, and symbol.
    Parameter(usize, SymbolId),
    /// Index among the inputs.
    Input(usize),
}

/// Loads and energies in a pose with rates.
pub(crate) struct Dynamics {
    /// Φ_t of the constraints.
    pub time_derivative: DVector<f64>,
    /// γ of the constraints.
    pub gamma: DVector<f64>,
    /// Q − M q̈ for q̈ = 0.
    pub loads: DVector<f64>,
    pub mass: DMatrix<f64>,
    /// Kinetic and potential energy (J).
    pub energies: [f64; 2],
    /// Power of forces, torques, dampers and external changes of stores (W).
    pub power: f64,
}

impl MotionEquations {
    /// Creates the equations of a system; `None` if no coordinate is free or forces are undetermined.
    pub fn new(pool: &Pool, system: &System) -> Option<MotionEquations> {
        let mut pool = pool.draft();
        let loads = system.forces.clone()?;
        let layout = Layout::new(system, &[]);
        let free = system.mechanism.forces.free.clone();
        if free.is_empty() {
            return None;
        }
        let held = system.rows.clone();
        let count = system.coordinates.len();
        let mut quantities: Vec<Quantity> =
            system.coordinates.iter().map(|it| it.quantity).collect();
        for coordinate in &free {
            let (_, _, quantity) = system
                .driven()
                .find(|(_, joint, _)| *joint == coordinate.joint)?;
            quantities.push(quantity);
        }
        let (mut entries, mut values) = (Vec::new(), Vec::new());
        for (row, own) in held.iter().enumerate() {
            for entry in &own.jacobian {
                entries.push((row, entry.coordinate));
                values.push(entry.value);
            }
            for (place, coordinate) in free.iter().enumerate() {
                let [value, ..] = system.mechanism.inputs[coordinate.input].symbols;
                let graph = &mut pool.graph;
                let entry = graph.derivative(own.residual, value);
                if entry != graph.zero() {
                    entries.push((row, count + place));
                    values.push(entry);
                }
            }
        }
        let residuals = held.iter().map(|row| row.residual);
        let constraints: Vec<ExprId> = residuals.chain(values).collect();
        let constraints = Reader::new(&pool.graph, &layout, &constraints);
        let mut written = |root: ExprId| {
            let root = pool.graph.substitute(root, &loads.lengths);
            pool.written_out(root)
        };
        let right_sides: Vec<ExprId> = loads.loads.iter().map(|it| written(*it)).collect();
        let [kinetic, potential, added] =
            [loads.kinetic, loads.potential, loads.added].map(&mut written);
        let graph = &mut pool.graph;
        let (mut masses, mut inertias) = (Vec::new(), Vec::new());
        for (row, &load) in right_sides.iter().enumerate() {
            for (column, coordinate) in system.coordinates.iter().enumerate() {
                let entry = graph.derivative(load, coordinate.acceleration);
                if entry != graph.zero() {
                    masses.push((row, column));
                    inertias.push(graph.negate(entry));
                }
            }
        }
        // A store that depends on time or on inputs changes externally.
        let one = graph.one();
        let mut outside = vec![(system.mechanism.time, one)];
        for input in &system.mechanism.inputs {
            let [value, rate, acceleration] = input.symbols;
            outside.push((value, graph.variable(rate)));
            outside.push((rate, graph.variable(acceleration)));
        }
        let mut powers = vec![added];
        for (symbol, rate) in outside {
            let along = graph.derivative(potential, symbol);
            powers.push(graph.multiply(along, rate));
        }
        let power = graph.sum(&powers);
        let zero = graph.zero();
        let mut roots: Vec<ExprId> = held.iter().map(|row| row.time_derivative).collect();
        roots.extend(held.iter().map(|row| row.gamma));
        roots.extend(
            right_sides
                .into_iter()
                .chain(std::iter::repeat(zero))
                .take(count),
        );
        roots.extend(inertias);
        roots.extend([kinetic, potential, power]);
        let dynamics = Reader::new(&pool.graph, &layout, &roots);
        let elongations = Elongations::of(&mut pool, system, &layout);
        Some(MotionEquations {
            parameters: Numbers::nominal_parameters(&pool, system),
            laws: InputLaws::of(&pool, system),
            row_scales: held
                .iter()
                .map(|row| system.scale(row.quantity, &pool))
                .collect(),
            coordinate_scales: quantities
                .iter()
                .map(|it| system.scale(*it, &pool))
                .collect(),
            is_length: quantities
                .iter()
                .map(|it| it.power_of_length() > 0)
                .collect(),
            elongations,
            free: free.iter().map(|it| it.input).collect(),
            layout,
            constraints,
            entries,
            dynamics,
            masses,
        })
    }

    /// Sets a parameter by its index and its symbol, or an input that a caller holds.
    pub fn set(&mut self, place: Varied, value: f64) {
        match place {
            Varied::Parameter(place, symbol) => {
                self.parameters.set(place, value);
                self.laws.set_symbol(symbol, value);
            }
            Varied::Input(place) => self.laws.hold(place, value),
        }
    }

    /// Layout of the values of instants.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Number of equations, and number of unknowns.
    pub fn dimensions(&self) -> [usize; 2] {
        [self.row_scales.len(), self.coordinate_scales.len()]
    }

    /// Number of free coordinates, the last unknowns.
    pub fn free_count(&self) -> usize {
        self.free.len()
    }

    /// Returns the unit of a free coordinate: 1 for an angle, or a length.
    pub fn free_scale(&self, place: usize) -> f64 {
        let bodies = self.coordinate_scales.len() - self.free.len();
        self.coordinate_scales[bodies + place]
    }

    /// Returns an instant at a time (s) with the inputs of their laws.
    pub fn instant(&self, t: f64) -> Instant {
        let mut instant = self.layout.empty();
        instant.set_given(&self.parameters, &self.laws.at(t));
        instant.values_mut()[0] = t;
        instant
    }

    /// Returns an instant at a time (s) at which all inputs stand still.
    pub fn resting_instant(&self, t: f64) -> Instant {
        let mut instant = self.instant(t);
        let mut inputs = self.layout.inputs(&instant);
        for signal in &mut inputs.0 {
            *signal = Signal::constant(signal.value);
        }
        instant.set_given(&self.parameters, &inputs);
        instant
    }

    /// Returns the unknowns of an instant, their rates or their accelerations.
    pub fn level(&self, instant: &Instant, level: usize) -> Vec<f64> {
        let inputs = self.layout.inputs(instant);
        let free = self.free.iter().map(|&input| {
            let signal = inputs.0[input];
            [signal.value, signal.rate, signal.acceleration][level]
        });
        let coordinates = [instant.q(), instant.qd(), instant.qdd()][level];
        coordinates.iter().copied().chain(free).collect()
    }

    /// Writes unknowns, their rates or their accelerations into an instant.
    pub fn set_level(&self, instant: &mut Instant, level: usize, values: &[f64]) {
        let mut frame = instant.frame();
        let (own, free) = values.split_at(frame.q.len());
        [&mut frame.q, &mut frame.qd, &mut frame.qdd][level].copy_from_slice(own);
        instant.set_frame(&frame);
        let mut inputs = self.layout.inputs(instant);
        for (&input, value) in self.free.iter().zip(free) {
            let signal = &mut inputs.0[input];
            *[
                &mut signal.value,
                &mut signal.rate,
                &mut signal.acceleration,
            ][level] = *value;
        }
        instant.set_given(&self.parameters, &inputs);
    }

    /// Sets all rates and accelerations of the unknowns to 0.
    pub fn still(&self, instant: &mut Instant) {
        let [_, columns] = self.dimensions();
        for level in [1, 2] {
            self.set_level(instant, level, &vec![0.0; columns]);
        }
    }

    /// Returns R⁻¹ Φ and R⁻¹ Φ_q C in the pose of an instant.
    pub fn constraints(&self, instant: &Instant) -> (DVector<f64>, DMatrix<f64>) {
        let [rows, columns] = self.dimensions();
        let values = self.constraints.values(instant);
        let residual = DVector::from_fn(rows, |row, _| values[row] / self.row_scales[row]);
        let mut matrix = DMatrix::zeros(rows, columns);
        for (&(row, column), value) in self.entries.iter().zip(&values[rows..]) {
            matrix[(row, column)] += value * self.coordinate_scales[column] / self.row_scales[row];
        }
        (residual, matrix)
    }

    /// Returns the loads and energies at an instant with pose and rates, whose accelerations are zero.
    pub fn dynamics(&self, instant: &Instant) -> Dynamics {
        let [rows, columns] = self.dimensions();
        let bodies = instant.q().len();
        let values = self.dynamics.values(instant);
        let part =
            |from: usize, count: usize| DVector::from_column_slice(&values[from..from + count]);
        let mut mass = DMatrix::zeros(columns, columns);
        let rest = &values[2 * rows + bodies..];
        for (&place, value) in self.masses.iter().zip(rest) {
            mass[place] = *value;
        }
        let energies = &rest[self.masses.len()..];
        Dynamics {
            time_derivative: part(0, rows),
            gamma: part(rows, rows),
            loads: part(2 * rows, bodies).resize_vertically(columns, 0.0),
            mass,
            energies: [energies[0], energies[1]],
            power: energies[2],
        }
    }
}
