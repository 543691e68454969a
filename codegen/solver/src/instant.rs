//! Stores the values of one solved instant, and their layout.

use std::collections::HashMap;
use std::ops::Range;

use linkwright::{Frame, Signal};
use linkwright_codegen::stages::expr::SymbolId;
use linkwright_codegen::stages::program::Program;
use linkwright_codegen::stages::system::System;
use nalgebra::{DVector, Dyn};

use crate::supplied::{InputSignals, ParameterValues};

/// Solved instant in m, rad and s: the time, parameters and inputs, q, q̇, q̈, and the further values of a `Layout`.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    values: Vec<f64>,
    /// Index of the first coordinate, and number of coordinates.
    pose: [usize; 2],
    /// Motion of points from the program that is written out; empty if it has the same formulas.
    outputs: Vec<OutputMotion>,
}

/// Position, rate or acceleration of a point of `output`, as the program that is written out computes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OutputMotion {
    /// Index of the point.
    pub point: usize,
    /// Order of the derivative.
    pub level: usize,
    /// Components in m, m/s or m/s².
    pub components: [f64; 2],
}

/// Layout of the values of instants.
#[derive(Clone, Debug)]
pub struct Layout {
    slots: HashMap<SymbolId, usize>,
    symbols: Vec<SymbolId>,
    parameters: usize,
    inputs: usize,
    coordinates: usize,
}

impl Layout {
    /// Creates the layout of a system's instants with all coordinates and these further values.
    pub(crate) fn new(system: &System, fields: &[SymbolId]) -> Layout {
        Layout::with(system, system.coordinates.len(), fields)
    }

    /// Creates the layout of a program's instants. If single outputs are requested, the coordinates that the program computes are among
    /// its fields, and `q` is empty.
    pub(crate) fn of_program(system: &System, program: &Program) -> Layout {
        let coordinates = match program.outputs {
            None => system.coordinates.len(),
            Some(_) => 0,
        };
        Layout::with(system, coordinates, &program.fields)
    }

    /// Creates the layout with this number of coordinates: all or none.
    fn with(system: &System, count: usize, fields: &[SymbolId]) -> Layout {
        let mechanism = &system.mechanism;
        let coordinates = &system.coordinates[..count];
        let mut symbols = vec![mechanism.time];
        symbols.extend(mechanism.parameters.iter().map(|it| it.symbol));
        symbols.extend(mechanism.inputs.iter().flat_map(|it| it.symbols));
        symbols.extend(coordinates.iter().map(|it| it.position));
        symbols.extend(coordinates.iter().map(|it| it.rate));
        symbols.extend(coordinates.iter().map(|it| it.acceleration));
        symbols.extend(fields);
        Layout {
            slots: symbols.iter().copied().zip(0..).collect(),
            symbols,
            parameters: mechanism.parameters.len(),
            inputs: 3 * mechanism.inputs.len(),
            coordinates: count,
        }
    }

    /// True if instants hold all coordinates of the system.
    pub(crate) fn holds_coordinates(&self, system: &System) -> bool {
        self.coordinates == system.coordinates.len()
    }

    /// Returns the index of a symbol's value; `None` if instants do not store the symbol.
    pub fn slot(&self, symbol: SymbolId) -> Option<usize> {
        self.slots.get(&symbol).copied()
    }

    /// Returns the index of a coordinate (level 0), its rate (1) or its acceleration (2); `None` if instants do not hold it.
    pub(crate) fn coordinate_slot(&self, place: usize, level: usize) -> Option<usize> {
        let is_held = place < self.coordinates && level < 3;
        is_held.then(|| self.given().end + level * self.coordinates + place)
    }

    /// Returns an instant of zeros.
    pub(crate) fn empty(&self) -> Instant {
        Instant {
            values: vec![0.0; self.symbols.len()],
            pose: [self.given().end, self.coordinates],
            outputs: Vec::new(),
        }
    }

    /// Indices of parameters and inputs.
    pub(crate) fn given(&self) -> Range<usize> {
        1..1 + self.parameters + self.inputs
    }

    /// Returns the inputs that an instant was solved with.
    pub(crate) fn inputs(&self, instant: &Instant) -> InputSignals {
        let supplied = &instant.values()[self.given()];
        let signals = supplied[self.parameters..].chunks_exact(3);
        InputSignals(signals.map(|it| Signal::new(it[0], it[1], it[2])).collect())
    }

    /// Indices of solved values: q, q̇, q̈ and all that follows.
    pub(crate) fn solved(&self) -> Range<usize> {
        self.given().end..self.symbols.len()
    }

    /// Symbols by index.
    pub(crate) fn symbols(&self) -> &[SymbolId] {
        &self.symbols
    }
}

impl Instant {
    /// Time (s).
    pub fn t(&self) -> f64 {
        self.values[0]
    }

    /// Coordinates q; empty if single outputs limit what instants hold.
    pub fn q(&self) -> &[f64] {
        self.level(0)
    }

    /// Rates q̇, as many as coordinates.
    pub fn qd(&self) -> &[f64] {
        self.level(1)
    }

    /// Accelerations q̈, as many as coordinates.
    pub fn qdd(&self) -> &[f64] {
        self.level(2)
    }

    /// All values, by `Layout::slot`.
    #[doc(hidden)]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Adds a multiple of the difference of two instants to all values except for the time.
    pub(crate) fn add(&mut self, multiple: f64, instant: &Instant, base: &Instant) {
        let values = instant.values.iter().zip(&base.values);
        for (sum, (value, base)) in self.values.iter_mut().zip(values).skip(1) {
            *sum += multiple * (value - base);
        }
    }

    /// Motion of points from the program that is written out.
    pub(crate) fn outputs(&self) -> &[OutputMotion] {
        &self.outputs
    }

    pub(crate) fn set_outputs(&mut self, outputs: Vec<OutputMotion>) {
        self.outputs = outputs;
    }

    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Returns the instant as a frame for solvers of one dense system.
    pub fn frame(&self) -> Frame<f64, Dyn> {
        Frame {
            t: self.t(),
            q: DVector::from_column_slice(self.q()),
            qd: DVector::from_column_slice(self.qd()),
            qdd: DVector::from_column_slice(self.qdd()),
        }
    }

    pub(crate) fn set_frame(&mut self, frame: &Frame<f64, Dyn>) {
        self.values[0] = frame.t;
        for (level, vector) in [&frame.q, &frame.qd, &frame.qdd].into_iter().enumerate() {
            let range = self.range(level);
            self.values[range].copy_from_slice(vector.as_slice());
        }
    }

    /// Returns a coordinate with its rate and its acceleration; `None` if the instant does not hold the coordinate.
    pub fn coordinate(&self, index: usize) -> Option<[f64; 3]> {
        Some([
            *self.q().get(index)?,
            *self.qd().get(index)?,
            *self.qdd().get(index)?,
        ])
    }

    pub(crate) fn set_given(&mut self, parameters: &ParameterValues, inputs: &InputSignals) {
        let signals = inputs
            .0
            .iter()
            .flat_map(|it| [it.value, it.rate, it.acceleration]);
        let supplied = parameters.0.iter().copied().chain(signals);
        for (place, value) in self.values[1..].iter_mut().zip(supplied) {
            *place = value;
        }
    }

    fn level(&self, level: usize) -> &[f64] {
        &self.values[self.range(level)]
    }

    fn range(&self, level: usize) -> Range<usize> {
        let [from, length] = self.pose;
        from + level * length..from + (level + 1) * length
    }
}
