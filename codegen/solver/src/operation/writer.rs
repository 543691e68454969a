//! Writes the statements of functions as operations on registers.
//!
//! [`Evaluation`] decides the order of arithmetic; the writer only assigns registers.

use std::collections::HashMap;
use std::ops::Range;

use linkwright_codegen::stages::expr::{Assembler, Code, Computation, ExprId, Register, SymbolId};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::program::{Evaluation, Function, Program, Statement};
use linkwright_codegen::stages::system::System;

use super::{FrictionJoints, Isolation, Operation};

/// Writes the operations of one function after another.
pub(crate) struct Writer<'a> {
    pub assembler: Assembler<'a>,
    pub(super) program: &'a Program,
    pool: &'a Pool,
    system: &'a System,
    /// Registers of computations.
    computed: HashMap<Computation, Register>,
    /// Computations in order, so that the last ones can be forgotten.
    journal: Vec<Computation>,
    /// The registers with the values that symbols had at the last instant.
    last: HashMap<SymbolId, Register>,
    last_order: Vec<(SymbolId, Register)>,
    written: Vec<Operation>,
    from: usize,
}

impl<'a> Writer<'a> {
    /// Begins a writer without operations.
    pub fn new(pool: &'a Pool, system: &'a System, program: &'a Program) -> Writer<'a> {
        let assembler = Assembler::new(&pool.graph);
        Writer {
            from: assembler.position(),
            assembler,
            program,
            pool,
            system,
            computed: HashMap::new(),
            journal: Vec::new(),
            last: HashMap::new(),
            last_order: Vec::new(),
            written: Vec::new(),
        }
    }

    /// Returns the register of a symbol's value at the last instant.
    pub fn last(&mut self, symbol: SymbolId) -> Register {
        if let Some(&register) = self.last.get(&symbol) {
            return register;
        }
        let register = self.assembler.register();
        self.last.insert(symbol, register);
        self.last_order.push((symbol, register));
        register
    }

    /// Returns a register for a result of an operation, or for a value of the caller.
    pub fn found(&mut self, symbol: SymbolId) -> Register {
        let register = self.assembler.register();
        self.assembler.bind(symbol, register);
        register
    }

    /// Writes the statements of a function and what computes its results.
    pub fn body(&mut self, function: &Function) -> Vec<Register> {
        let evaluation = self.evaluation(function);
        for statement in &function.statements {
            self.statement(statement, &evaluation);
        }
        let results = function.results.iter();
        results
            .map(|it| self.arithmetic(&evaluation.result(it)))
            .collect()
    }

    /// Order of arithmetic in a function.
    pub fn evaluation<'f>(&self, function: &'f Function) -> Evaluation<'f>
    where
        'a: 'f,
    {
        Evaluation::new(function, self.pool, self.system, &self.program.constants)
    }

    /// Writes a computation that was not written before.
    pub(super) fn compute(&mut self, computation: Computation) -> Register {
        if let Some(&register) = self.computed.get(&computation) {
            return register;
        }
        let register = self.assembler.write(computation);
        self.note(computation, register);
        register
    }

    fn note(&mut self, computation: Computation, register: Register) {
        self.computed.insert(computation, register);
        self.journal.push(computation);
    }

    /// The sine and the cosine of an angle, computed together.
    fn sine_cosine(&mut self, angle: Register) -> [Register; 2] {
        let both = [Computation::Sine(angle), Computation::Cosine(angle)];
        if let [Some(&sine), Some(&cosine)] = both.map(|it| self.computed.get(&it)) {
            return [sine, cosine];
        }
        let registers = self.assembler.sine_cosine(angle);
        for (computation, register) in both.into_iter().zip(registers) {
            self.note(computation, register);
        }
        registers
    }

    fn value(&mut self, expr: ExprId, evaluation: &Evaluation<'_>) -> Register {
        self.arithmetic(&evaluation.value(expr))
    }

    /// Writes a statement of a function.
    pub fn statement(&mut self, statement: &Statement, evaluation: &Evaluation<'_>) {
        match statement {
            Statement::Let { target, value, .. } => {
                let register = self.arithmetic(&evaluation.assigned(*target, *value));
                self.assembler.bind(*target, register);
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let angle = self.value(*angle, evaluation);
                let [s, c] = self.sine_cosine(angle);
                self.assembler.bind(*sine, s);
                self.assembler.bind(*cosine, c);
            }
            Statement::Lookup {
                targets,
                spline,
                argument,
            } => {
                let place = self.value(*argument, evaluation);
                for (order, target) in (0..).zip(targets) {
                    if let Some(target) = *target {
                        let register = self.lookup(*spline, order, place);
                        self.assembler.bind(target, register);
                    }
                }
            }
            _ => {
                if let Some(operation) = self.operation_of(statement, evaluation) {
                    self.operation(operation);
                }
            }
        }
    }

    /// Returns the operation of a statement, after its operands are written; `None` if instructions suffice.
    fn operation_of(
        &mut self,
        statement: &Statement,
        evaluation: &Evaluation<'_>,
    ) -> Option<Operation> {
        Some(match statement {
            Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. }
            | Statement::Let { .. }
            | Statement::SineCosine { .. }
            | Statement::Lookup { .. } => return None,
            Statement::Angle {
                target,
                sine,
                cosine,
            } => Operation::Angle {
                sine: self.value(*sine, evaluation),
                cosine: self.value(*cosine, evaluation),
                last: self.last(*target),
                target: self.found(*target),
            },
            Statement::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => {
                let [excess, scale] = [excess, scale].map(|it| self.value(*it, evaluation));
                let (bounds, bridged) = self.aside(|writer| {
                    [distance, longest, shortest].map(|it| writer.value(*it, evaluation))
                });
                Operation::Reach {
                    excess,
                    scale,
                    bounds,
                    bridged,
                }
            }
            Statement::Nonzero { value, scale } => Operation::Nonzero {
                value: self.value(*value, evaluation),
                scale: self.value(*scale, evaluation),
            },
            Statement::Positive { length, joint } => Operation::Positive {
                length: self.value(*length, evaluation),
                place: self.program.requirements.as_ref().map_or(0, |it| {
                    u16::try_from(it.place_of(*joint)).unwrap_or(u16::MAX)
                }),
            },
            Statement::Newton { .. } => Operation::Newton,
            Statement::Factorize => Operation::Factorize,
            Statement::Solve {
                targets,
                right_hand_side,
            } => Operation::Solve {
                right_hand_side: self.values(right_hand_side, evaluation),
                targets: self.targets(targets),
            },
            Statement::Multipliers {
                targets,
                jacobian,
                forces,
            } => Operation::Multipliers {
                jacobian: self.values(jacobian, evaluation),
                forces: self.values(forces, evaluation),
                targets: self.targets(targets),
            },
            Statement::Friction {
                pins,
                targets,
                coefficients,
                alone,
                units,
            } => {
                let coefficients = self.values(coefficients, evaluation);
                let [alone, units] = [alone, units].map(|pairs| {
                    let pairs = pairs.iter();
                    pairs
                        .map(|pair| pair.map(|it| self.value(it, evaluation)))
                        .collect()
                });
                Operation::Friction {
                    joints: FrictionJoints {
                        pins: *pins,
                        coefficients,
                        alone,
                        units,
                    },
                    targets: self.targets(targets),
                }
            }
            Statement::Signal { input, found } => Operation::Signal {
                input: *input,
                found: found.map(|symbol| self.found(symbol)),
            },
            Statement::Require { value, block } => {
                Operation::Require(self.value(*value, evaluation), *block)
            }
            Statement::Isolate {
                is_chain,
                blocks,
                found,
                bounds,
                curvatures,
                changes,
                sizes,
                jacobian,
                turns,
                turning,
                varied,
                variation,
            } => {
                let [bounds, curvatures, changes, sizes] =
                    [bounds, curvatures, changes, sizes].map(|it| self.values(it, evaluation));
                let [jacobian, turning] = [jacobian, turning].map(|entries| {
                    let entries = entries.iter();
                    entries
                        .map(|(place, entry)| (*place, self.value(*entry, evaluation)))
                        .collect()
                });
                let deviations = found.iter().map(|&symbol| self.found(symbol)).collect();
                let (variation, variations) = self.function(variation);
                Operation::Isolate(Isolation {
                    is_chain: *is_chain,
                    blocks: blocks.clone(),
                    bounds,
                    curvatures,
                    changes,
                    sizes,
                    jacobian,
                    turns: turns.clone(),
                    turning,
                    found: deviations,
                    variation,
                    varied: varied.iter().copied().zip(variations).collect(),
                })
            }
        })
    }

    fn values(&mut self, exprs: &[ExprId], evaluation: &Evaluation<'_>) -> Vec<Register> {
        exprs.iter().map(|it| self.value(*it, evaluation)).collect()
    }

    fn targets(&mut self, symbols: &[Option<SymbolId>]) -> Vec<Option<Register>> {
        let symbols = symbols.iter();
        symbols
            .map(|it| it.map(|symbol| self.found(symbol)))
            .collect()
    }

    /// Writes a function apart from others; returns its operations and the registers of its results.
    pub fn function(&mut self, function: &Function) -> (Vec<Operation>, Vec<Register>) {
        self.apart(|writer| writer.body(function))
    }

    /// Writes an operation after the instructions before it.
    fn operation(&mut self, operation: Operation) {
        self.flush();
        self.written.push(operation);
    }

    fn flush(&mut self) {
        let range = self.from..self.assembler.position();
        if !range.is_empty() {
            self.from = range.end;
            self.written.push(Operation::Run(range));
        }
    }

    /// Returns the operations written since the last call.
    pub fn take(&mut self) -> Vec<Operation> {
        self.flush();
        std::mem::take(&mut self.written)
    }

    /// Writes instructions that run only on request, and returns their range. Nothing else may rely on what they compute.
    pub fn aside<T>(&mut self, write: impl FnOnce(&mut Self) -> T) -> (Range<usize>, T) {
        let from = self.assembler.position();
        let (_, result) = self.apart(write);
        (from..self.assembler.position(), result)
    }

    /// Writes operations that run only on request. Nothing else may rely on what they compute.
    pub fn apart<T>(&mut self, write: impl FnOnce(&mut Self) -> T) -> (Vec<Operation>, T) {
        let before = self.take();
        let mark = self.journal.len();
        let result = write(self);
        for computation in self.journal.drain(mark..) {
            self.computed.remove(&computation);
        }
        let operations = self.take();
        self.written = before;
        (operations, result)
    }

    /// The code, and the symbols whose last values it reads.
    pub fn finish(self) -> (Code, Vec<(SymbolId, Register)>) {
        (self.assembler.finish(), self.last_order)
    }
}
