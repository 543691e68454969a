//! Holds the values that a caller supplies: pose, parameters, inputs and assembly modes, in the order of the description.

use linkwright::{Branch, Signal, Values};
use linkwright_codegen::stages::expr::{SymbolId, Tape};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;

/// Numbers in the order of a description and in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Numbers(pub Vec<f64>);

/// Value of each coordinate.
pub type Pose = Numbers;

/// Parameters of a description.
pub type ParameterValues = Numbers;

/// Inputs of a description at one time, in its order and in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InputSignals(pub Vec<Signal>);

/// Assembly mode of every loop.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Modes {
    /// Modes of loops in closed form that have two.
    pub closed: Vec<Branch>,
    /// Modes of loops that Newton-Raphson solves; `None` if the estimate decides.
    pub iterated: Vec<Option<Branch>>,
}

/// Name of an assembly mode, and its index in [`Modes`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModeName {
    /// Name in generated code.
    pub name: String,
    /// Index in [`Modes::closed`], or else in [`Modes::iterated`].
    pub place: usize,
    /// True for the mode of a closed form.
    pub is_closed: bool,
}

impl Numbers {
    /// Returns the nominal parameters of a description.
    #[doc(hidden)]
    pub fn nominal_parameters(pool: &Pool, system: &System) -> ParameterValues {
        let mechanism = &system.mechanism;
        let nominal = |symbol| pool.graph.nominal(symbol).unwrap_or(f64::NAN);
        let parameters = mechanism.parameters.iter();
        Numbers(parameters.map(|it| nominal(it.symbol)).collect())
    }
}

impl InputSignals {
    /// Returns the initial inputs of the description, at rest.
    #[doc(hidden)]
    pub fn initial(pool: &Pool, system: &System) -> InputSignals {
        let mechanism = &system.mechanism;
        let value = |expr| pool.graph.constant_value(expr).unwrap_or(f64::NAN);
        let inputs = mechanism.inputs.iter();
        InputSignals(
            inputs
                .map(|it| Signal::constant(value(it.initial)))
                .collect(),
        )
    }
}

impl Values<f64> for Numbers {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn value(&self, index: usize) -> Option<f64> {
        self.0.get(index).copied()
    }

    fn set(&mut self, index: usize, value: f64) {
        if let Some(place) = self.0.get_mut(index) {
            *place = value;
        }
    }

    fn are_finite(&self) -> bool {
        self.0.iter().all(|value| value.is_finite())
    }
}

impl Values<Signal> for InputSignals {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn value(&self, index: usize) -> Option<Signal> {
        self.0.get(index).copied()
    }

    fn set(&mut self, index: usize, signal: Signal) {
        if let Some(place) = self.0.get_mut(index) {
            *place = signal;
        }
    }

    fn are_finite(&self) -> bool {
        let numbers = |it: &Signal| [it.value, it.rate, it.acceleration];
        self.0.iter().flat_map(numbers).all(f64::is_finite)
    }
}

/// Inputs of a description as functions of time, which hold unless a caller supplies inputs.
#[derive(Clone, Debug)]
pub struct InputLaws {
    tape: Tape,
    /// Values by symbol, with the nominal parameters.
    symbols: Vec<f64>,
    time: usize,
    count: usize,
    /// Inputs on lines, each with its value at t = 0 and its rate, in place of their laws.
    lines: Vec<(usize, [f64; 2])>,
}

impl InputLaws {
    /// Returns the laws of the inputs of a system.
    #[doc(hidden)]
    pub fn of(pool: &Pool, system: &System) -> InputLaws {
        let mechanism = &system.mechanism;
        let mut symbols = vec![0.0; pool.graph.symbol_count()];
        pool.graph.fill_nominal(&mut symbols);
        let signals: Vec<_> = mechanism.inputs.iter().flat_map(|it| it.signal).collect();
        InputLaws {
            tape: Tape::new(&pool.graph, &signals),
            symbols,
            time: mechanism.time.index(),
            count: signals.len(),
            lines: Vec::new(),
        }
    }

    /// Returns the laws with this input on a line: its value at t = 0 and its rate.
    pub(crate) fn on_line(mut self, input: usize, line: [f64; 2]) -> InputLaws {
        self.lines.push((input, line));
        self
    }

    /// Sets the value of a symbol in all laws.
    pub(crate) fn set_symbol(&mut self, symbol: SymbolId, value: f64) {
        if let Some(place) = self.symbols.get_mut(symbol.index()) {
            *place = value;
        }
    }

    /// Holds an input at a value.
    pub(crate) fn hold(&mut self, input: usize, value: f64) {
        self.lines.retain(|(place, _)| *place != input);
        self.lines.push((input, [value, 0.0]));
    }

    /// Returns the inputs at time `t` (s).
    pub fn at(&self, t: f64) -> InputSignals {
        if self.count == 0 {
            return InputSignals::default();
        }
        let mut symbols = self.symbols.clone();
        symbols[self.time] = t;
        let mut values = vec![0.0; self.count];
        self.tape.evaluate(&symbols, &mut Vec::new(), &mut values);
        for &(input, [at, rate]) in &self.lines {
            values[3 * input..3 * input + 3].copy_from_slice(&[at + rate * t, rate, 0.0]);
        }
        let signals = values
            .chunks_exact(3)
            .map(|it| Signal::new(it[0], it[1], it[2]));
        InputSignals(signals.collect())
    }
}
