//! Verifies that blocks stay on their path: an instant continues the path of the last one.
//!
//! The statements are those of generated code; see [`linkwright::Blocks::verify_path`].

use linkwright::generated::{Pair, PathEnclosure, TimeWindow, required};
use linkwright::lanes::Mask;
use linkwright_codegen::stages::expr::{Code, LANES, Lanes, Register, SymbolId};
use linkwright_codegen::stages::pool::{Pool, SymbolRole};
use linkwright_codegen::stages::program::{Function, Program};
use linkwright_codegen::stages::system::System;

use super::Interpreted;
use crate::instant::{Instant, Layout};
use crate::operation::{Operation, Writer, run, run_lanes};

/// Path of a mechanism.
#[derive(Clone, Debug)]
pub(crate) struct InterpretedPath {
    /// Verification of all equations together.
    whole: WindowCheck,
    /// Verification of closed forms in their order; `None` if there are none.
    closed: Option<WindowCheck>,
    /// Number of each block of the plan.
    numbers: Vec<u16>,
    /// Indices of the unknowns of Newton-Raphson, and bounds on their deviations from the chord if they move.
    enclosures: Vec<(usize, Option<Register>)>,
}

/// Verification of a window as operations.
#[derive(Clone, Debug)]
struct WindowCheck {
    code: Code,
    /// Registers of the time, the steps, the remainder, the margin beyond the window, and the rounding.
    window: [Register; 5],
    /// Registers that are read of the instant, and of the last one, with their indices there.
    read: [Vec<(Register, usize)>; 2],
    operations: Vec<Operation>,
}

impl InterpretedPath {
    /// Returns the path; `None` if the program does not verify paths.
    ///
    /// # Panics
    /// If a path mentions values that instants do not store.
    pub fn new(
        pool: &Pool,
        system: &System,
        program: &Program,
        layout: &Layout,
    ) -> Option<InterpretedPath> {
        let path = program.path.as_ref()?;
        let newtons = program.blocks.iter().flat_map(|block| &block.newton);
        let unknowns = newtons.flat_map(|newton| &newton.unknowns);
        let unknowns: Vec<(SymbolId, Option<SymbolId>)> = unknowns
            .map(|unknown| {
                let position = system.vector_form.unknowns[*unknown].position;
                (position, path.deviations.get(unknown).copied())
            })
            .collect();
        let deviations = unknowns.iter().filter_map(|(_, deviation)| *deviation);
        let bounds = &path.window;
        let context = CheckWriter {
            pool,
            system,
            program,
            window: [
                bounds.time,
                bounds.steps,
                bounds.remainder,
                bounds.beyond,
                bounds.rounding,
            ],
            layout,
        };
        let (whole, deviations) = context.write(&path.function, deviations.collect());
        let closed = path.closed.as_ref();
        let closed = closed.map(|function| context.write(function, Vec::new()).0);
        let mut deviations = deviations.into_iter();
        let enclosures = unknowns.into_iter().map(|(position, deviation)| {
            let deviation = deviation.and_then(|_| deviations.next());
            (context.slot(position), deviation)
        });
        let enclosures = enclosures.collect();
        let places = program.blocks.iter().filter_map(|block| block.place);
        let numbers = 0..places.max().map_or(0, |last| last + 1);
        Some(InterpretedPath {
            whole,
            closed,
            numbers: numbers.map(|place| program.number_of(place)).collect(),
            enclosures,
        })
    }

    /// Slots of instants that are read.
    pub fn slots(&self) -> impl Iterator<Item = usize> + '_ {
        let checks = [Some(&self.whole), self.closed.as_ref()].into_iter();
        let read = checks.flatten().flat_map(|it| it.read.iter().flatten());
        let read = read.map(|(_, slot)| *slot);
        read.chain(self.enclosures.iter().map(|(slot, _)| *slot))
    }

    /// Returns the registers of both verifications.
    pub fn registers(&self) -> [Vec<f64>; 2] {
        let closed = self.closed.as_ref();
        let closed = closed.map_or(Vec::new(), |shown| shown.code.registers().to_vec());
        [self.whole.code.registers().to_vec(), closed]
    }

    /// Registers of the verification of closed forms in lanes.
    pub fn lanes(&self) -> Vec<Lanes> {
        let closed = self.closed.as_ref();
        closed.map_or(Vec::new(), |closed| closed.code.lanes())
    }

    /// Returns the lanes whose blocks stay nonsingular; see [`InLanes::verify_lanes`](linkwright::lanes::InLanes::verify_lanes).
    #[inline(always)]
    pub fn stay_in_lanes(
        &self,
        pair: [&[Lanes]; 2],
        window: &TimeWindow<Lanes>,
        registers: &mut [Lanes],
    ) -> Mask<LANES> {
        match &self.closed {
            Some(closed) => closed.verify_lanes(pair, window, registers),
            None => Mask::NONE,
        }
    }

    /// True if the path closes; see [`Blocks::is_closed`](linkwright::Blocks::is_closed).
    pub fn is_closed(&self) -> bool {
        self.closed.is_some()
    }

    /// Number of enclosures.
    pub fn enclosure_count(&self) -> usize {
        self.enclosures.len()
    }

    /// Verifies a path; see [`Blocks::verify_path`](linkwright::Blocks::verify_path).
    pub fn keep(
        &self,
        pair: &Pair<'_, Interpreted>,
        window: &TimeWindow,
        enclosures: &mut Vec<PathEnclosure>,
        registers: &mut [f64],
    ) -> Result<(), u16> {
        self.whole.verify(pair, window, &self.numbers, registers)?;
        let instants = [pair.at, pair.last].map(Instant::values);
        let enclosure = |&(slot, deviation): &(usize, Option<Register>)| {
            let [now, before] = instants.map(|values| values[slot]);
            PathEnclosure::new(
                now,
                before,
                deviation.map_or(0.0, |deviation| registers[deviation.index()]),
            )
        };
        enclosures.clear();
        enclosures.extend(self.enclosures.iter().map(enclosure));
        Ok(())
    }

    /// True if an instant lies in enclosures; see [`Blocks::is_within`](linkwright::Blocks::is_within).
    pub fn are_within(&self, at: &Instant, enclosures: &[PathEnclosure], steps: f64) -> bool {
        let mut enclosures = self.enclosures.iter().zip(enclosures);
        enclosures.all(|(&(slot, _), enclosure)| enclosure.holds(at.values()[slot], steps))
    }

    /// Verifies that blocks stay nonsingular; see [`Blocks::verify_nonsingular`](linkwright::Blocks::verify_nonsingular).
    pub fn stay(
        &self,
        pair: &Pair<'_, Interpreted>,
        window: &TimeWindow,
        registers: &mut [f64],
    ) -> Result<(), u16> {
        match &self.closed {
            Some(closed) => closed.verify(pair, window, &self.numbers, registers),
            None => Err(0),
        }
    }
}

/// Context in which verifications are written as operations.
struct CheckWriter<'a> {
    pool: &'a Pool,
    system: &'a System,
    program: &'a Program,
    /// Symbols of the time, the steps, the remainder, the margin beyond the window, and the rounding.
    window: [SymbolId; 5],
    layout: &'a Layout,
}

impl CheckWriter<'_> {
    fn slot(&self, symbol: SymbolId) -> usize {
        let slot = self.layout.slot(symbol);
        slot.unwrap_or_else(|| {
            let name = self.pool.graph.symbol_name(symbol);
            panic!("instants keep no `{name}`")
        })
    }

    /// Writes a function as operations; returns the registers of the requested symbols.
    fn write(&self, function: &Function, symbols: Vec<SymbolId>) -> (WindowCheck, Vec<Register>) {
        let mut writer = Writer::new(self.pool, self.system, self.program);
        let window = self.window.map(|symbol| writer.found(symbol));
        writer.body(function);
        let operations = writer.take();
        let requested = symbols.into_iter().map(|it| writer.assembler.symbol(it));
        let requested = requested.collect();
        let mut read = [Vec::new(), Vec::new()];
        for &(symbol, register) in writer.assembler.unbound() {
            match self.pool.role(symbol) {
                SymbolRole::Last(symbol) => read[1].push((register, self.slot(symbol))),
                _ => read[0].push((register, self.slot(symbol))),
            }
        }
        let (code, _) = writer.finish();
        let verification = WindowCheck {
            code,
            window,
            read,
            operations,
        };
        (verification, requested)
    }
}

impl WindowCheck {
    /// Verifies a window.
    ///
    /// # Errors
    /// The number of the block whose verification fails.
    fn verify(
        &self,
        pair: &Pair<'_, Interpreted>,
        window: &TimeWindow,
        numbers: &[u16],
        registers: &mut [f64],
    ) -> Result<(), u16> {
        let instants = [pair.at, pair.last].map(Instant::values);
        self.supply(instants, window, registers);
        let [before, now] = [pair.before, pair.conditions.inputs];
        for operation in &self.operations {
            match operation {
                Operation::Signal { input, found } => {
                    let bounds = window.signal(&before.0[*input], &now.0[*input]);
                    for (register, value) in found.iter().zip(bounds) {
                        registers[register.index()] = value;
                    }
                }
                Operation::Require(value, block) => {
                    required(registers[value.index()], numbers[*block])?;
                }
                Operation::Isolate(isolation) => {
                    let isolated = isolation.find(window, &self.code, registers);
                    isolated.map_err(|block| numbers[block])?;
                }
                _ => run(operation, &self.code, registers, 0.0, 0)
                    .map_err(|failure| failure.block)?,
            }
        }
        Ok(())
    }

    /// Writes what a verification reads of two instants and of the window.
    #[inline(always)]
    fn supply<T: Copy>(&self, pair: [&[T]; 2], window: &TimeWindow<T>, registers: &mut [T]) {
        for (read, values) in self.read.iter().zip(pair) {
            for &(register, slot) in read {
                registers[register.index()] = values[slot];
            }
        }
        let numbers_of_window = [
            window.time,
            window.steps,
            window.remainder,
            window.beyond,
            window.rounding,
        ];
        for (register, value) in self.window.iter().zip(numbers_of_window) {
            registers[register.index()] = value;
        }
    }

    /// Returns the lanes whose windows are verified, for two instants of each.
    #[inline(always)]
    fn verify_lanes(
        &self,
        pair: [&[Lanes]; 2],
        window: &TimeWindow<Lanes>,
        registers: &mut [Lanes],
    ) -> Mask<LANES> {
        self.supply(pair, window, registers);
        let mut failed = Mask::NONE;
        for operation in &self.operations {
            failed |= match operation {
                Operation::Require(value, _) => {
                    let value = registers[value.index()];
                    !Mask::of(|lane| value.0[lane] >= 0.0)
                }
                _ => run_lanes(operation, &self.code, registers),
            };
        }
        !failed
    }
}
