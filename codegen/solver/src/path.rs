//! *What shows that blocks keep to their path* → whether an instant lies on the path of the last one.
//!
//! The statements are those of generated code; see [`linkwright::guard`].

use linkwright::span::{isolate_all, required};
use linkwright::{Pair, Span, Tube};
use linkwright_codegen::stages::expr::{Code, Recorder, Register, SymbolId};
use linkwright_codegen::stages::program::Program;
use linkwright_codegen::stages::system::{SymbolRole, System};
use nalgebra::{DMatrix, DVector};

use crate::instant::{Instant, Layout};
use crate::interpreted::Interpreted;
use crate::operation::{Operation, Writer, run};
use crate::supplied::InputSignals;

/// The path of a mechanism.
#[derive(Clone, Debug)]
pub(crate) struct InterpretedPath {
    code: Code,
    /// The time, the stretch, the bend and what lies beyond.
    span: [Register; 4],
    /// What is read of the instant, and of the last one, and where it is there.
    read: [Vec<(Register, usize)>; 2],
    operations: Vec<Operation>,
    /// The number of each block of the plan.
    numbers: Vec<u16>,
    /// The places of what Newton-Raphson finds, and how far it may be from a straight line where it moves.
    tubes: Vec<(usize, Option<Register>)>,
}

/// How far unknowns may be from a straight line, as registers; see [`isolate_all`].
#[derive(Clone, Debug)]
pub(crate) struct Isolation {
    /// The block of each equation, by its place in the plan.
    pub blocks: Vec<usize>,
    pub bounds: Vec<Register>,
    pub sizes: Vec<Register>,
    pub jacobian: Vec<([usize; 2], Register)>,
    /// One sag an unknown.
    pub found: Vec<Register>,
    pub variation: Vec<Operation>,
    pub varied: Vec<([usize; 2], Register)>,
}

impl InterpretedPath {
    /// `None` where nobody asks for it.
    ///
    /// # Panics
    /// Where a path mentions what instants do not keep.
    pub fn new(system: &System, program: &Program, layout: &Layout) -> Option<InterpretedPath> {
        let path = program.path.as_ref()?;
        let graph = &system.mechanism.graph;
        let mut recorder = Recorder::new(graph);
        let own = &path.span;
        let span = [own.time, own.stretch, own.bend, own.beyond];
        let span = span.map(|symbol| {
            let register = recorder.register();
            recorder.bind(symbol, register);
            register
        });
        let mut writer = Writer::new(recorder);
        let slot = |symbol: SymbolId| {
            let slot = layout.slot(symbol);
            slot.unwrap_or_else(|| panic!("instants keep no `{}`", graph.symbol_name(symbol)))
        };
        for statement in &path.function.statements {
            writer.statement(statement);
        }
        let operations = writer.take();
        let newtons = program.blocks.iter().flat_map(|block| &block.newton);
        let tubes = newtons.flat_map(|newton| &newton.unknowns).map(|unknown| {
            let sag = path.sags.get(unknown);
            let position = system.vector_form.unknowns[*unknown].position;
            (slot(position), sag.map(|&sag| writer.recorder.symbol(sag)))
        });
        let tubes = tubes.collect();
        let mut read = [Vec::new(), Vec::new()];
        for &(symbol, register) in writer.recorder.unbound() {
            match system.roles[symbol.index()] {
                SymbolRole::Last(symbol) => read[1].push((register, slot(symbol))),
                _ => read[0].push((register, slot(symbol))),
            }
        }
        let places = program.blocks.iter().filter_map(|block| block.place);
        let numbers = 0..places.max().map_or(0, |last| last + 1);
        let (code, _) = writer.finish();
        Some(InterpretedPath {
            code,
            span,
            read,
            operations,
            numbers: numbers.map(|place| program.number_of(place)).collect(),
            tubes,
        })
    }

    /// What it computes with.
    pub fn registers(&self) -> &[f64] {
        self.code.registers()
    }

    /// How many tubes there are.
    pub fn tube_count(&self) -> usize {
        self.tubes.len()
    }

    /// See [`Blocks::keeps_to_path`](linkwright::Blocks::keeps_to_path).
    pub fn keep(
        &self,
        pair: &Pair<'_, Interpreted>,
        span: &Span,
        tubes: &mut Vec<Tube>,
        registers: &mut [f64],
    ) -> Result<(), u16> {
        let instants = [pair.at, pair.last].map(Instant::values);
        for (read, values) in self.read.iter().zip(instants) {
            for &(register, slot) in read {
                registers[register.index()] = values[slot];
            }
        }
        let spans = [span.time, span.stretch, span.bend, span.beyond];
        for (register, value) in self.span.iter().zip(spans) {
            registers[register.index()] = value;
        }
        let inputs = [pair.before, pair.conditions.inputs];
        for operation in &self.operations {
            self.show(operation, registers, inputs, span)?;
        }
        let tube = |&(slot, sag): &(usize, Option<Register>)| {
            let [now, before] = instants.map(|values| values[slot]);
            Tube::new(now, before, sag.map_or(0.0, |sag| registers[sag.index()]))
        };
        tubes.clear();
        tubes.extend(self.tubes.iter().map(tube));
        Ok(())
    }

    /// See [`Blocks::is_within`](linkwright::Blocks::is_within).
    pub fn are_within(&self, at: &Instant, tubes: &[Tube], steps: f64) -> bool {
        let mut tubes = self.tubes.iter().zip(tubes);
        tubes.all(|(&(slot, _), tube)| tube.holds(at.values()[slot], steps))
    }

    fn show(
        &self,
        operation: &Operation,
        registers: &mut [f64],
        [before, now]: [&InputSignals; 2],
        span: &Span,
    ) -> Result<(), u16> {
        match operation {
            Operation::Signal { input, found } => {
                let bounds = span.signal(&before.0[*input], &now.0[*input]);
                for (register, value) in found.iter().zip(bounds) {
                    registers[register.index()] = value;
                }
                Ok(())
            }
            Operation::Require(value, block) => {
                required(registers[value.index()], self.numbers[*block])
            }
            Operation::Isolate(isolation) => isolation
                .find(&self.code, registers)
                .map_err(|block| self.numbers[block]),
            _ => run(operation, &self.code, registers, 0.0, 0).map_err(|failure| failure.block),
        }
    }
}

impl Isolation {
    /// # Errors
    /// The block of the plan of which it cannot be shown.
    fn find(&self, code: &Code, registers: &mut [f64]) -> Result<(), usize> {
        let order = self.found.len();
        let fill =
            |matrix: &mut DMatrix<f64>, entries: &[([usize; 2], Register)], registers: &[f64]| {
                for &([row, column], register) in entries {
                    matrix[(row, column)] = registers[register.index()];
                }
            };
        let vector = |places: &[Register]| {
            DVector::from_iterator(order, places.iter().map(|it| registers[it.index()]))
        };
        let (bounds, magnitudes) = (vector(&self.bounds), vector(&self.sizes));
        let mut jacobian = DMatrix::zeros(order, order);
        fill(&mut jacobian, &self.jacobian, registers);
        let sags = isolate_all(&bounds, &magnitudes, &jacobian, |sags, variation| {
            for (register, sag) in self.found.iter().zip(sags.iter()) {
                registers[register.index()] = *sag;
            }
            for operation in &self.variation {
                // What bounds are made of cannot fail.
                let _ = run(operation, code, registers, 0.0, 0);
            }
            fill(variation, &self.varied, registers);
        });
        let sags = sags.map_err(|row| self.blocks[row])?;
        for (register, sag) in self.found.iter().zip(sags.iter()) {
            registers[register.index()] = *sag;
        }
        Ok(())
    }
}
