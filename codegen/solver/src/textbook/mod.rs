//! Evaluates Φ of a [`System`] and its derivatives as functions of pose and time.
//!
//! [`TextbookEquations`] implements [`Equations`](linkwright::Equations) with one [`Tape`] per function, so that solvers of equations
//! apply to descriptions without a compile step. Φ_q holds zeros wherever the system lists no entry.

mod directions;
mod equations;
mod observed;

use std::cell::RefCell;

use linkwright_codegen::stages::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::DVector;

use crate::supplied::{InputSignals, ParameterValues};
use directions::Directions;

/// Mechanism as functions of pose and time, in SI units: m, rad, s.
///
/// Vectors follow the order of [`System::coordinates`] and [`System::rows`]; both have n entries. The functions borrow
/// internal buffers while they run, so an interpreter belongs to one thread; clone it for another.
#[derive(Clone, Debug)]
pub struct TextbookEquations {
    dimension: usize,
    residual: Tape,
    jacobian: Tape,
    /// Index of each result of `jacobian` in the column-major n × n matrix.
    places: Vec<usize>,
    time_derivative: Tape,
    gamma: Tape,
    /// Residuals of the rows that are not solved.
    monitored: Tape,
    monitored_count: usize,
    /// Six results per output: position, velocity, acceleration.
    outputs: Tape,
    output_names: Vec<String>,
    directions: Directions,
    /// Three results per contact: the velocity of the follower along and across the normal, and the square of the sliding speed.
    pressures: Tape,
    pressure_count: usize,
    estimate: DVector<f64>,
    row_scales: Vec<f64>,
    coordinate_scales: Vec<f64>,
    /// Symbols of q, q̇, q̈ and t.
    positions: Vec<SymbolId>,
    rates: Vec<SymbolId>,
    accelerations: Vec<SymbolId>,
    time: SymbolId,
    /// Value, rate and acceleration of every input at one time, and their symbols.
    signals: Tape,
    signal_symbols: Vec<SymbolId>,
    parameter_symbols: Vec<SymbolId>,
    scratch: RefCell<Scratch>,
}

/// Buffers that each evaluation overwrites.
#[derive(Clone, Debug)]
struct Scratch {
    /// Value of each symbol.
    symbols: Vec<f64>,
    /// Intermediate values of the tapes.
    workspace: Vec<f64>,
    /// Results other than vectors of n entries.
    results: Vec<f64>,
    /// Inputs at one time.
    signals: Vec<f64>,
    /// True if the inputs are supplied, so that their laws do not apply.
    are_supplied: bool,
}

impl TextbookEquations {
    /// Creates the functions of `system`, which must have as many rows as coordinates; `linkwright_codegen::Read::check` verifies that.
    ///
    /// # Panics
    /// If the system is not square.
    pub fn new(pool: &Pool, system: &System) -> TextbookEquations {
        let dimension = system.coordinates.len();
        assert_eq!(
            system.rows.len(),
            dimension,
            "a system must pass `check` before it is solved"
        );
        let graph = &pool.graph;
        let rows = |pick: fn(&linkwright_codegen::stages::system::Row) -> ExprId| {
            let roots: Vec<ExprId> = system.rows.iter().map(pick).collect();
            Tape::new(graph, &roots)
        };
        let mut entries = Vec::new();
        let mut places = Vec::new();
        for (index, row) in system.rows.iter().enumerate() {
            for entry in &row.jacobian {
                entries.push(entry.value);
                places.push(entry.coordinate * dimension + index);
            }
        }
        let motions: Vec<ExprId> = system
            .outputs
            .iter()
            .flat_map(|output| [output.position, output.velocity, output.acceleration])
            .flatten()
            .collect();
        let pressures: Vec<ExprId> = system
            .pressures
            .iter()
            .flat_map(|pressure| [pressure.along, pressure.across, pressure.sliding])
            .collect();
        let coordinates = &system.coordinates;
        let inputs = system.mechanism.inputs.iter();
        TextbookEquations {
            dimension,
            residual: rows(|row| row.residual),
            jacobian: Tape::new(graph, &entries),
            time_derivative: rows(|row| row.time_derivative),
            gamma: rows(|row| row.gamma),
            monitored: {
                let watched = system.monitored.iter().map(|row| row.residual);
                Tape::new(graph, &watched.collect::<Vec<_>>())
            },
            monitored_count: system.monitored.len(),
            outputs: Tape::new(graph, &motions),
            pressures: Tape::new(graph, &pressures),
            pressure_count: system.pressures.len(),
            output_names: system
                .outputs
                .iter()
                .map(|output| output.name.clone())
                .collect(),
            directions: Directions::new(pool, system),
            // A design configuration that is not constant was rejected before; NaN would be reported as not finite.
            estimate: DVector::from_iterator(
                dimension,
                coordinates
                    .iter()
                    .map(|it| graph.constant_value(it.estimate).unwrap_or(f64::NAN)),
            ),
            row_scales: system
                .rows
                .iter()
                .map(|row| system.scale(row.quantity, pool))
                .collect(),
            coordinate_scales: coordinates
                .iter()
                .map(|it| system.scale(it.quantity, pool))
                .collect(),
            positions: coordinates.iter().map(|it| it.position).collect(),
            rates: coordinates.iter().map(|it| it.rate).collect(),
            accelerations: coordinates.iter().map(|it| it.acceleration).collect(),
            time: system.mechanism.time,
            signals: Tape::new(
                graph,
                &inputs.clone().flat_map(|it| it.signal).collect::<Vec<_>>(),
            ),
            signal_symbols: inputs.flat_map(|it| it.symbols).collect(),
            parameter_symbols: system
                .mechanism
                .parameters
                .iter()
                .map(|it| it.symbol)
                .collect(),
            scratch: RefCell::new(Scratch {
                symbols: parameters(pool),
                workspace: Vec::new(),
                signals: Vec::new(),
                are_supplied: false,
                results: vec![0.0; places.len().max(motions.len()).max(pressures.len())],
            }),
            places,
        }
    }

    /// Sets parameters and inputs; the laws of the inputs no longer apply.
    pub fn supply(&self, parameters: &ParameterValues, inputs: &InputSignals) {
        let scratch = &mut *self.scratch.borrow_mut();
        scratch.are_supplied = true;
        self.fill(&mut scratch.symbols, &self.parameter_symbols, &parameters.0);
        let signals = inputs.0.iter();
        let signals = signals.flat_map(|it| [it.value, it.rate, it.acceleration]);
        scratch.signals.clear();
        scratch.signals.extend(signals);
        for (symbol, value) in self.signal_symbols.iter().zip(&scratch.signals) {
            scratch.symbols[symbol.index()] = *value;
        }
    }

    /// Pose q (n) of the design configuration: an estimate that need not satisfy the equations.
    pub fn estimate(&self) -> &DVector<f64> {
        &self.estimate
    }

    /// Sets the time, and the inputs of their laws.
    fn set_time(&self, scratch: &mut Scratch, t: f64) {
        scratch.symbols[self.time.index()] = t;
        if self.signal_symbols.is_empty() || scratch.are_supplied {
            return;
        }
        scratch.signals.resize(self.signal_symbols.len(), 0.0);
        self.signals.evaluate(
            &scratch.symbols,
            &mut scratch.workspace,
            &mut scratch.signals,
        );
        for (symbol, value) in self.signal_symbols.iter().zip(&scratch.signals) {
            scratch.symbols[symbol.index()] = *value;
        }
    }

    fn fill(&self, symbols: &mut [f64], places: &[SymbolId], values: &[f64]) {
        for (symbol, value) in places.iter().zip(values) {
            symbols[symbol.index()] = *value;
        }
    }

    /// Evaluates a function with n results at (q, t), and q̇ if it needs rates.
    fn evaluate(
        &self,
        tape: &Tape,
        q: &DVector<f64>,
        qd: Option<&DVector<f64>>,
        t: f64,
        results: &mut DVector<f64>,
    ) {
        let scratch = &mut *self.scratch.borrow_mut();
        self.fill(&mut scratch.symbols, &self.positions, q.as_slice());
        if let Some(qd) = qd {
            self.fill(&mut scratch.symbols, &self.rates, qd.as_slice());
        }
        self.set_time(scratch, t);
        tape.evaluate(
            &scratch.symbols,
            &mut scratch.workspace,
            results.as_mut_slice(),
        );
    }
}

/// Returns a value per symbol: parameters at their nominal values, and zero for all others.
fn parameters(pool: &Pool) -> Vec<f64> {
    let graph = &pool.graph;
    let mut symbols = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut symbols);
    symbols
}
