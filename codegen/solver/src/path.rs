//! *What shows that blocks keep to their path* → whether an instant lies on the path of the last one.
//!
//! The statements are those of generated code; see [`linkwright::guard`].

use linkwright::chain_isolation::isolate_whole_chain;
use linkwright::isolation::isolate_all;
use linkwright::span::required;
use linkwright::{Chord, Pair, Span, Tube};
use linkwright_codegen::stages::expr::{Code, Register, SymbolId};
use linkwright_codegen::stages::program::{Function, Program};
use linkwright_codegen::stages::system::{SymbolRole, System};
use nalgebra::{DMatrix, DVector};

use crate::instant::{Instant, Layout};
use crate::interpreted::Interpreted;
use crate::operation::{Operation, Writer, run};

/// The path of a mechanism.
#[derive(Clone, Debug)]
pub(crate) struct InterpretedPath {
    /// All equations together.
    whole: Shown,
    /// Closed forms one after another.
    closed: Option<Shown>,
    /// The number of each block of the plan.
    numbers: Vec<u16>,
    /// The places of what Newton-Raphson finds, and how far it may be from a straight line where it moves.
    tubes: Vec<(usize, Option<Register>)>,
}

/// What shows something of a span.
#[derive(Clone, Debug)]
struct Shown {
    code: Code,
    /// The time, the stretch, the bend, what lies beyond, and the rounding.
    span: [Register; 5],
    /// What is read of the instant, and of the last one, and where it is there.
    read: [Vec<(Register, usize)>; 2],
    operations: Vec<Operation>,
}

/// How far unknowns may be from a straight line, as registers; see [`isolate_all`].
#[derive(Clone, Debug)]
pub(crate) struct Isolation {
    /// See [`isolate_whole_chain`].
    pub is_chain: bool,
    /// The block of each equation, by its place in the plan.
    pub blocks: Vec<usize>,
    pub bounds: Vec<Register>,
    pub curvatures: Vec<Register>,
    pub ways: Vec<Register>,
    pub sizes: Vec<Register>,
    pub jacobian: Vec<([usize; 2], Register)>,
    pub turns: Vec<bool>,
    pub turning: Vec<([usize; 2], Register)>,
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
        let newtons = program.blocks.iter().flat_map(|block| &block.newton);
        let unknowns = newtons.flat_map(|newton| &newton.unknowns);
        let unknowns: Vec<(SymbolId, Option<SymbolId>)> = unknowns
            .map(|unknown| {
                let position = system.vector_form.unknowns[*unknown].position;
                (position, path.sags.get(unknown).copied())
            })
            .collect();
        let sags = unknowns.iter().filter_map(|(_, sag)| *sag);
        let own = &path.span;
        let given = Given {
            system,
            program,
            span: [own.time, own.stretch, own.bend, own.beyond, own.rounding],
            layout,
        };
        let (whole, sags) = given.shown(&path.function, sags.collect());
        let closed = path.closed.as_ref();
        let closed = closed.map(|function| given.shown(function, Vec::new()).0);
        let mut sags = sags.into_iter();
        let tubes = unknowns.into_iter().map(|(position, sag)| {
            let sag = sag.and_then(|_| sags.next());
            (given.slot(position), sag)
        });
        let tubes = tubes.collect();
        let places = program.blocks.iter().filter_map(|block| block.place);
        let numbers = 0..places.max().map_or(0, |last| last + 1);
        Some(InterpretedPath {
            whole,
            closed,
            numbers: numbers.map(|place| program.number_of(place)).collect(),
            tubes,
        })
    }

    /// What both of its functions compute with.
    pub fn registers(&self) -> [Vec<f64>; 2] {
        let closed = self.closed.as_ref();
        let closed = closed.map_or(Vec::new(), |shown| shown.code.registers().to_vec());
        [self.whole.code.registers().to_vec(), closed]
    }

    /// See [`Blocks::is_closed`](linkwright::Blocks::is_closed).
    pub fn is_closed(&self) -> bool {
        self.closed.is_some()
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
        self.whole.show(pair, span, &self.numbers, registers)?;
        let instants = [pair.at, pair.last].map(Instant::values);
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

    /// See [`Blocks::stays_regular`](linkwright::Blocks::stays_regular).
    pub fn stay(
        &self,
        pair: &Pair<'_, Interpreted>,
        span: &Span,
        registers: &mut [f64],
    ) -> Result<(), u16> {
        match &self.closed {
            Some(closed) => closed.show(pair, span, &self.numbers, registers),
            None => Err(0),
        }
    }
}

/// What functions that show something of a span are written with.
struct Given<'a> {
    system: &'a System,
    program: &'a Program,
    /// The time, the stretch, the bend, what lies beyond, and the rounding.
    span: [SymbolId; 5],
    layout: &'a Layout,
}

impl Given<'_> {
    fn slot(&self, symbol: SymbolId) -> usize {
        let slot = self.layout.slot(symbol);
        slot.unwrap_or_else(|| {
            let name = self.system.mechanism.graph.symbol_name(symbol);
            panic!("instants keep no `{name}`")
        })
    }

    /// A function as operations, and where they leave what is asked for.
    fn shown(&self, function: &Function, asked: Vec<SymbolId>) -> (Shown, Vec<Register>) {
        let mut writer = Writer::new(self.system, self.program);
        let span = self.span.map(|symbol| writer.found(symbol));
        writer.body(function);
        let operations = writer.take();
        let asked = asked.into_iter().map(|it| writer.assembler.symbol(it));
        let asked = asked.collect();
        let mut read = [Vec::new(), Vec::new()];
        for &(symbol, register) in writer.assembler.unbound() {
            match self.system.roles[symbol.index()] {
                SymbolRole::Last(symbol) => read[1].push((register, self.slot(symbol))),
                _ => read[0].push((register, self.slot(symbol))),
            }
        }
        let (code, _) = writer.finish();
        let shown = Shown {
            code,
            span,
            read,
            operations,
        };
        (shown, asked)
    }
}

impl Shown {
    /// # Errors
    /// The number of the block of which it cannot be shown.
    fn show(
        &self,
        pair: &Pair<'_, Interpreted>,
        span: &Span,
        numbers: &[u16],
        registers: &mut [f64],
    ) -> Result<(), u16> {
        let instants = [pair.at, pair.last].map(Instant::values);
        for (read, values) in self.read.iter().zip(instants) {
            for &(register, slot) in read {
                registers[register.index()] = values[slot];
            }
        }
        let spans = [
            span.time,
            span.stretch,
            span.bend,
            span.beyond,
            span.rounding,
        ];
        for (register, value) in self.span.iter().zip(spans) {
            registers[register.index()] = value;
        }
        let [before, now] = [pair.before, pair.conditions.inputs];
        for operation in &self.operations {
            match operation {
                Operation::Signal { input, found } => {
                    let bounds = span.signal(&before.0[*input], &now.0[*input]);
                    for (register, value) in found.iter().zip(bounds) {
                        registers[register.index()] = value;
                    }
                }
                Operation::Require(value, block) => {
                    required(registers[value.index()], numbers[*block])?;
                }
                Operation::Isolate(isolation) => {
                    let found = isolation.find(span, &self.code, registers);
                    found.map_err(|block| numbers[block])?;
                }
                _ => run(operation, &self.code, registers, 0.0, 0)
                    .map_err(|failure| failure.block)?,
            }
        }
        Ok(())
    }
}

impl Isolation {
    /// # Errors
    /// The block of the plan of which it cannot be shown.
    fn find(&self, span: &Span, code: &Code, registers: &mut [f64]) -> Result<(), usize> {
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
        let matrix = |entries, registers: &[f64]| {
            let mut matrix = DMatrix::zeros(order, order);
            fill(&mut matrix, entries, registers);
            matrix
        };
        let chord = Chord {
            bend: span.bend,
            bounds: vector(&self.bounds),
            curvatures: vector(&self.curvatures),
            ways: vector(&self.ways),
            sizes: vector(&self.sizes),
            jacobian: &mut matrix(&self.jacobian, registers),
            turns: DVector::from_column_slice(&self.turns),
            turning: &mut matrix(&self.turning, registers),
        };
        let sags = match self.is_chain {
            true => isolate_whole_chain(span, chord),
            false => isolate_all(chord, |sags, variation| {
                for (register, sag) in self.found.iter().zip(sags.iter()) {
                    registers[register.index()] = *sag;
                }
                for operation in &self.variation {
                    // What bounds are made of cannot fail.
                    let _ = run(operation, code, registers, 0.0, 0);
                }
                fill(variation, &self.varied, registers);
            }),
        };
        let sags = sags.map_err(|row| self.blocks[row])?;
        for (register, sag) in self.found.iter().zip(sags.iter()) {
            registers[register.index()] = *sag;
        }
        Ok(())
    }
}
