//! Writes code one instruction after another, and notes which register holds which symbol.
//!
//! Every register is written by at most one instruction. A register that none writes holds a constant, or what the caller puts there.

use std::collections::HashMap;

use super::code::{Code, Computation, Instruction, Register};
use super::graph::Graph;
use super::node::SymbolId;
use super::rational::Rational;
use super::spline::SplineId;

/// Code while it is written.
#[derive(Clone, Debug)]
pub struct Assembler<'a> {
    graph: &'a Graph,
    code: Code,
    bound: HashMap<SymbolId, Register>,
    unbound: Vec<(SymbolId, Register)>,
    /// Numbers in the code of the splines of the graph.
    splines: HashMap<SplineId, u32>,
    /// Registers of constants, by their bits.
    constants: HashMap<u64, Register>,
}

impl<'a> Assembler<'a> {
    /// Begins code without instructions and without bound symbols.
    pub fn new(graph: &'a Graph) -> Assembler<'a> {
        Assembler {
            graph,
            code: Code::default(),
            bound: HashMap::new(),
            unbound: Vec::new(),
            splines: HashMap::new(),
            constants: HashMap::new(),
        }
    }

    /// Graph of the expressions that are computed.
    pub fn graph(&self) -> &'a Graph {
        self.graph
    }

    /// Returns a new register, which holds zero until an instruction writes to it.
    ///
    /// # Panics
    /// Panics if registers exceed 32 bits.
    pub fn register(&mut self) -> Register {
        let place = u32::try_from(self.code.initial.len());
        self.code.initial.push(0.0);
        Register(place.expect("registers are numbered with 32 bits"))
    }

    /// A register that holds a constant.
    pub fn constant(&mut self, value: f64) -> Register {
        if let Some(&register) = self.constants.get(&value.to_bits()) {
            return register;
        }
        let register = self.register();
        self.code.initial[register.index()] = value;
        self.constants.insert(value.to_bits(), register);
        register
    }

    /// Binds a symbol to the register that holds it from now on.
    pub fn bind(&mut self, symbol: SymbolId, register: Register) {
        self.bound.insert(symbol, register);
    }

    /// Register of a symbol; one that is not bound gets a register that the caller has to write.
    pub fn symbol(&mut self, symbol: SymbolId) -> Register {
        if let Some(&register) = self.bound.get(&symbol) {
            return register;
        }
        let register = self.register();
        self.bound.insert(symbol, register);
        self.unbound.push((symbol, register));
        register
    }

    /// Symbols that were read without being bound, in the order of their first use.
    pub fn unbound(&self) -> &[(SymbolId, Register)] {
        &self.unbound
    }

    /// Number of the next instruction.
    pub fn position(&self) -> usize {
        self.code.length()
    }

    /// Writes an instruction.
    pub fn write(&mut self, computation: Computation) -> Register {
        let target = self.register();
        self.code.instructions.push(Instruction {
            target,
            computation,
        });
        target
    }

    /// Writes the sine and the cosine of an angle.
    pub fn sine_cosine(&mut self, angle: Register) -> [Register; 2] {
        let cosine = self.register();
        [
            self.write(Computation::SineCosine { cosine, angle }),
            cosine,
        ]
    }

    /// Number of a spline in the code.
    pub fn spline(&mut self, spline: SplineId) -> u32 {
        let splines = &mut self.code.splines;
        *self.splines.entry(spline).or_insert_with(|| {
            splines.push(self.graph.spline_table.spline(spline).clone());
            splines.len() as u32 - 1
        })
    }

    /// Number of an exponent in the code.
    pub(super) fn exponent(&mut self, exponent: Rational) -> u32 {
        self.code.exponents.push(exponent);
        self.code.exponents.len() as u32 - 1
    }

    /// The code that was written.
    pub fn finish(self) -> Code {
        self.code
    }
}
