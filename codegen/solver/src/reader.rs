//! Evaluates expressions of a system, and functions of its program, at an instant.

use std::cell::RefCell;

use linkwright_codegen::stages::expr::{
    Code, ExprId, Graph, Lanes, Reads, Recorder, Register, SymbolId,
};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::program::{Function, Program};
use linkwright_codegen::stages::system::System;

use crate::instant::{Instant, Layout};
use crate::operation::Writer;

/// Evaluator of expressions of values that instants keep.
#[derive(Clone, Debug)]
pub struct Reader {
    formulas: Formulas,
    registers: RefCell<Vec<f64>>,
}

/// Code that reads values of instants.
#[derive(Clone, Debug)]
pub(crate) struct Formulas {
    code: Code,
    /// Registers and the places that they are read from.
    read: Vec<(Register, usize)>,
    results: Vec<Register>,
}

impl Reader {
    /// Creates an evaluator of these expressions.
    ///
    /// # Panics
    /// Panics if an expression mentions a symbol that instants do not keep.
    pub fn new(graph: &Graph, layout: &Layout, roots: &[ExprId]) -> Reader {
        Reader::recorded(graph, layout, |recorder| {
            roots.iter().map(|&root| recorder.value(root)).collect()
        })
    }

    /// Creates an evaluator of the recorded values.
    ///
    /// # Panics
    /// Panics if an expression mentions a symbol that instants do not keep.
    pub fn recorded(
        graph: &Graph,
        layout: &Layout,
        record: impl FnOnce(&mut Recorder<'_>) -> Vec<Register>,
    ) -> Reader {
        let mut recorder = Recorder::new(graph);
        let results = record(&mut recorder);
        let read = slots(recorder.symbols(), graph, layout);
        Reader::of(Formulas {
            code: recorder.finish(),
            read,
            results,
        })
    }

    pub(crate) fn of(formulas: Formulas) -> Reader {
        Reader {
            registers: RefCell::new(formulas.code.registers().to_vec()),
            formulas,
        }
    }

    pub(crate) fn formulas(&self) -> &Formulas {
        &self.formulas
    }

    /// Writes the values in their order over `values`.
    pub fn read(&self, instant: &Instant, values: &mut Vec<f64>) {
        values.clear();
        let registers = &mut *self.registers.borrow_mut();
        values.extend(self.formulas.evaluated(instant, registers));
    }

    /// The values in their order.
    pub fn values(&self, instant: &Instant) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.formulas.results.len());
        self.read(instant, &mut values);
        values
    }
}

impl Formulas {
    /// The results of functions of a program, which cannot fail, one after another.
    ///
    /// # Panics
    /// Panics if a function mentions a symbol that instants do not keep.
    pub fn new<'a>(
        functions: impl IntoIterator<Item = &'a Function>,
        pool: &Pool,
        system: &System,
        program: &Program,
        layout: &Layout,
    ) -> Formulas {
        let mut writer = Writer::new(pool, system, program);
        let functions = functions.into_iter();
        let results = functions.flat_map(|it| writer.body(it)).collect();
        let read = slots(writer.assembler.unbound(), &pool.graph, layout);
        let (code, _) = writer.finish();
        Formulas {
            code,
            read,
            results,
        }
    }

    /// Returns the code without what only other results than these need.
    pub fn limited_to(&self, results: &[usize]) -> Formulas {
        let mut reads = Reads::new(&self.code);
        let needed = results.iter().filter_map(|it| self.results.get(*it));
        reads.add(needed.copied());
        reads.add_range(&self.code, 0..self.code.length());
        let (code, _) = self.code.reduced(&reads);
        let read = self.read.iter().copied();
        Formulas {
            code,
            read: read.filter(|(register, _)| reads.has(*register)).collect(),
            results: self.results.clone(),
        }
    }

    /// Slots of instants that are read.
    pub fn slots(&self) -> impl Iterator<Item = usize> + '_ {
        self.read.iter().map(|(_, slot)| *slot)
    }

    /// Registers of all lanes before the first evaluation.
    pub fn lanes(&self) -> Vec<Lanes> {
        self.code.lanes()
    }

    /// Evaluates all lanes at these values of instants.
    #[inline(always)]
    pub fn evaluate_lanes(&self, values: &[Lanes], registers: &mut [Lanes]) {
        for &(register, slot) in &self.read {
            registers[register.index()] = values[slot];
        }
        self.code.run_lanes(0..self.code.length(), registers);
    }

    /// Returns a result in all lanes; `None` if there is none of this index.
    pub fn result_lanes(&self, index: usize, registers: &[Lanes]) -> Option<Lanes> {
        let register = self.results.get(index)?;
        Some(registers[register.index()])
    }

    /// The values in their order.
    pub fn values(&self, instant: &Instant) -> Vec<f64> {
        let mut registers = self.code.registers().to_vec();
        self.evaluated(instant, &mut registers).collect()
    }

    fn evaluated<'a>(
        &'a self,
        instant: &Instant,
        registers: &'a mut [f64],
    ) -> impl Iterator<Item = f64> + use<'a> {
        for &(register, slot) in &self.read {
            registers[register.index()] = instant.values()[slot];
        }
        self.code.run(0..self.code.length(), registers);
        self.results.iter().map(|it| registers[it.index()])
    }
}

/// Returns the indices of symbols in instants.
///
/// # Panics
/// Panics if instants do not keep a symbol.
fn slots(
    symbols: &[(SymbolId, Register)],
    graph: &Graph,
    layout: &Layout,
) -> Vec<(Register, usize)> {
    let slots = symbols.iter().map(|&(symbol, register)| {
        let slot = layout.slot(symbol);
        let slot =
            slot.unwrap_or_else(|| panic!("instants keep no `{}`", graph.symbol_name(symbol)));
        (register, slot)
    });
    slots.collect()
}
