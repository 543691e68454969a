//! Compiles a program into operations on registers, block by block, once for all instants.
//!
//! Values of instants are copied into registers here, and results out of them.

use std::collections::HashSet;

use linkwright_codegen::stages::assemblies::exchanges;
use linkwright_codegen::stages::emit::Notation;
use linkwright_codegen::stages::emit::derivation::{
    BlockWords, Script, SingularPose, block_words, singular_poses,
};
use linkwright_codegen::stages::expr::{Code, Register, SymbolId};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::program::{Program, Statement};
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::system::System;

use super::path::InterpretedPath;
use super::reduced::Reduced;
use crate::instant::{Instant, Layout};
use crate::newton::Newton;
use crate::operation::{Operation, Writer};
use crate::ranges::Ranges;
use crate::reader::Formulas;
use crate::supplied::{InputSignals, Modes, ParameterValues};

/// Compiled program, shared by all instants.
#[derive(Clone, Debug)]
pub(crate) struct Compiled {
    pub solved: Solved,
    pub poses: Vec<SingularPose>,
    pub layout: Layout,
    pub code: Code,
    pub blocks: Vec<InterpretedBlock>,
    pub words: Vec<BlockWords>,
    pub(super) time: Register,
    pub(super) given: Vec<Register>,
    /// Registers of the branches of closed forms.
    pub(super) signs: Vec<Register>,
    /// Registers with values of the last instant, and their indices there.
    pub(super) last: Vec<(Register, usize)>,
    /// Registers that instants keep, in order, after the given values.
    pub(super) kept: Vec<Register>,
    /// Estimates of all unknowns of the vector form; `None` if no parameter changes them.
    drawn: Option<Formulas>,
    /// Values that parameters must keep positive.
    pub(super) required: Option<Formulas>,
    pub(super) ranges: Ranges,
    /// Verification of the path; `None` for unguarded mechanisms.
    pub(super) path: Option<InterpretedPath>,
}

/// A block as operations.
#[derive(Clone, Debug)]
pub(crate) struct InterpretedBlock {
    pub operations: Vec<Operation>,
    pub newton: Option<Newton>,
    /// The places in [`Modes::closed`] of its signs.
    pub closed: Vec<usize>,
    /// Place in [`Modes::closed`] of the mode that is exchanged where it meets the other one; `None` if modes never meet in closed form.
    pub exchanged: Option<usize>,
    /// Its place in [`Modes::iterated`], where it has a Newton-Raphson.
    pub iterated: usize,
}

impl InterpretedBlock {
    /// The blocks of a program, written one after another.
    fn all(
        program: &Program,
        pool: &Pool,
        system: &System,
        writer: &mut Writer<'_>,
    ) -> Vec<InterpretedBlock> {
        let graph = &pool.graph;
        let exchanged = exchanges(pool, system, program);
        let mut signs_left: Vec<usize> = (0..program.branches.len()).collect();
        let mut blocks: Vec<InterpretedBlock> = Vec::with_capacity(program.blocks.len());
        for (number, block) in program.blocks.iter().enumerate() {
            let read = block
                .function
                .values()
                .flat_map(|value| graph.symbols(value));
            let read: HashSet<SymbolId> = read.copied().collect();
            let is_own = |place: &usize| read.contains(&program.branches[*place].symbol);
            let (closed, others): (Vec<usize>, _) = signs_left.into_iter().partition(is_own);
            let is_exchanged =
                |place: &usize| exchanged.get(&program.branches[*place].symbol) == Some(&number);
            signs_left = others;
            let mut newton = None;
            let evaluation = writer.evaluation(&block.function);
            for statement in &block.function.statements {
                if let Statement::Newton { .. } = statement {
                    newton = Newton::new(block, pool, system, writer);
                }
                writer.statement(statement, &evaluation);
            }
            blocks.push(InterpretedBlock {
                operations: writer.take(),
                iterated: blocks.iter().filter(|it| it.newton.is_some()).count(),
                newton,
                exchanged: closed.iter().copied().find(is_exchanged),
                closed,
            });
        }
        blocks
    }
}

impl Compiled {
    /// The operations of a program, and what else is asked of it at every instant.
    pub(super) fn new(solved: Solved) -> Compiled {
        let (pool, system) = (solved.pool(), solved.system());
        let (plan, program) = (solved.plan(), solved.program());
        let poses =
            |notation| singular_poses(pool, system, plan, &program.forms, Script::Text(notation));
        let words = block_words(
            &program.blocks,
            pool,
            system,
            plan,
            &poses(Notation::Unicode),
        );
        let poses = poses(Notation::Ascii);
        let layout = Layout::of_program(system, program);
        let mut writer = Writer::new(pool, system, program);
        let time = writer.found(system.mechanism.time);
        let conditions = layout.symbols()[layout.given()].iter();
        let conditions = conditions.map(|&symbol| writer.found(symbol)).collect();
        let signs = program.branches.iter();
        let signs = signs.map(|it| writer.found(it.symbol)).collect();
        writer.last(system.mechanism.time);
        let mut blocks = InterpretedBlock::all(program, pool, system, &mut writer);
        let kept = layout.symbols()[layout.solved()].iter();
        let kept = kept
            .map(|&symbol| writer.assembler.symbol(symbol))
            .collect();
        let (mut code, last) = writer.finish();
        let kept: Vec<Register> = kept;
        let operations: Vec<&[Operation]> = blocks.iter().map(|it| &it.operations[..]).collect();
        if let Some(reduced) = Reduced::new(&code, &operations, kept.iter().copied()) {
            for (block, operations) in blocks.iter_mut().zip(reduced.operations) {
                block.operations = operations;
            }
            code = reduced.code;
        }
        let last = last.into_iter().map(|(symbol, register)| {
            let slot = layout.slot(symbol);
            (
                register,
                slot.expect("instants keep what the next one reads"),
            )
        });
        let last = last.collect();
        let formulas = |function| Formulas::new([function], pool, system, program, &layout);
        let drawn = program.drawn.as_ref().map(formulas);
        let required = program.requirements.as_ref();
        let required = required.map(|it| formulas(&it.function));
        Compiled {
            required,
            ranges: Ranges::of(system),
            path: InterpretedPath::new(pool, system, program, &layout),
            last,
            drawn,
            words,
            poses,
            layout,
            code,
            blocks,
            time,
            given: conditions,
            signs,
            kept,
            solved,
        }
    }

    /// Calls `put` with what an instant starts from: the last one, the time, parameters and inputs.
    #[inline]
    pub(super) fn fill(
        &self,
        last: &Instant,
        t: f64,
        parameters: &ParameterValues,
        inputs: &InputSignals,
        mut put: impl FnMut(Register, f64),
    ) {
        for &(register, slot) in &self.last {
            put(register, last.values()[slot]);
        }
        put(self.time, t);
        let signals = inputs
            .0
            .iter()
            .flat_map(|it| [it.value, it.rate, it.acceleration]);
        let values = parameters.0.iter().copied().chain(signals);
        for (&register, value) in self.given.iter().zip(values) {
            put(register, value);
        }
    }

    /// Calls `put` with the assembly modes of closed forms.
    #[inline]
    pub(super) fn set_signs(&self, modes: &Modes, mut put: impl FnMut(Register, f64)) {
        for (&register, branch) in self.signs.iter().zip(&modes.closed) {
            put(register, branch.sign());
        }
    }

    /// Returns the slots of instants with the registers that they are taken from.
    pub(super) fn stored(&self) -> impl Iterator<Item = (usize, Register)> + '_ {
        let registers = [&self.time].into_iter();
        let registers = registers.chain(&self.given).chain(&self.kept);
        registers.copied().enumerate()
    }

    /// Takes out what an instant keeps.
    #[inline]
    pub(super) fn keep(&self, t: f64, at: &mut Instant, take: impl Fn(Register) -> f64) {
        let values = at.values_mut();
        values[0] = t;
        for (value, register) in values[1..]
            .iter_mut()
            .zip(self.given.iter().chain(&self.kept))
        {
            *value = take(*register);
        }
    }

    /// The estimates of all unknowns of the vector form.
    pub(super) fn drawn(&self, parameters: &ParameterValues) -> Vec<f64> {
        match &self.drawn {
            Some(drawn) => self.of_parameters(drawn, parameters),
            None => {
                let system = self.solved.system();
                let unknowns = 0..system.vector_form.unknowns.len();
                unknowns
                    .map(|it| system.drawn_unknown(it, self.solved.pool()))
                    .collect()
            }
        }
    }

    /// The time of the last instant, which Newton-Raphson goes on from.
    pub(super) fn last_time(&self, registers: &[f64]) -> f64 {
        // The first of what is read of the last instant.
        let time = self.last.first();
        time.map_or(0.0, |(register, _)| registers[register.index()])
    }

    /// The values of formulas that mention parameters alone.
    pub(super) fn of_parameters(
        &self,
        formulas: &Formulas,
        parameters: &ParameterValues,
    ) -> Vec<f64> {
        let mut instant = self.layout.empty();
        instant.set_given(parameters, &InputSignals::default());
        formulas.values(&instant)
    }
}
