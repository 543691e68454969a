//! *Expressions of a system* → *their values at an instant*.

use std::cell::RefCell;

use linkwright_codegen::stages::expr::{Code, ExprId, Graph, Recorder, Register};

use crate::instant::{Instant, Layout};

/// Evaluates expressions of what instants keep.
#[derive(Clone, Debug)]
pub struct Reader {
    code: Code,
    /// Registers and the places that they are read from.
    read: Vec<(Register, usize)>,
    results: Vec<Register>,
    registers: RefCell<Vec<f64>>,
}

impl Reader {
    /// The values of these expressions.
    ///
    /// # Panics
    /// Where an expression mentions what instants do not keep.
    pub fn new(graph: &Graph, layout: &Layout, roots: &[ExprId]) -> Reader {
        Reader::recorded(graph, layout, |recorder| {
            roots.iter().map(|&root| recorder.value(root)).collect()
        })
    }

    /// The values of whatever is recorded.
    ///
    /// # Panics
    /// Where an expression mentions what instants do not keep.
    pub fn recorded(
        graph: &Graph,
        layout: &Layout,
        record: impl FnOnce(&mut Recorder<'_>) -> Vec<Register>,
    ) -> Reader {
        let mut recorder = Recorder::new(graph);
        let results = record(&mut recorder);
        let read = recorder.unbound().iter().map(|&(symbol, register)| {
            let slot = layout.slot(symbol);
            let slot =
                slot.unwrap_or_else(|| panic!("instants keep no `{}`", graph.symbol_name(symbol)));
            (register, slot)
        });
        let read = read.collect();
        let code = recorder.finish();
        Reader {
            registers: RefCell::new(code.registers().to_vec()),
            code,
            read,
            results,
        }
    }

    /// Writes the values in their order over `values`.
    pub fn read(&self, instant: &Instant, values: &mut Vec<f64>) {
        let registers = &mut *self.registers.borrow_mut();
        for &(register, slot) in &self.read {
            registers[register.index()] = instant.values()[slot];
        }
        self.code.run(0..self.code.length(), registers);
        values.clear();
        values.extend(self.results.iter().map(|it| registers[it.index()]));
    }

    /// The values in their order.
    pub fn values(&self, instant: &Instant) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.results.len());
        self.read(instant, &mut values);
        values
    }
}
