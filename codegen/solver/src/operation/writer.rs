//! *The statements of a function* → *operations on registers*.

use std::collections::HashMap;
use std::ops::Range;

use linkwright_codegen::stages::expr::{Code, ExprId, Recorder, Register, SymbolId};
use linkwright_codegen::stages::program::{Function, Statement};

use super::Operation;
use crate::path::Isolation;

/// Writes the operations of one function after another.
pub(crate) struct Writer<'a> {
    pub recorder: Recorder<'a>,
    /// The registers with the values that symbols had at the last instant.
    last: HashMap<SymbolId, Register>,
    last_order: Vec<(SymbolId, Register)>,
    written: Vec<Operation>,
    from: usize,
}

impl<'a> Writer<'a> {
    pub fn new(recorder: Recorder<'a>) -> Writer<'a> {
        Writer {
            from: recorder.position(),
            recorder,
            last: HashMap::new(),
            last_order: Vec::new(),
            written: Vec::new(),
        }
    }

    /// Where the last value of a symbol is found.
    pub fn last(&mut self, symbol: SymbolId) -> Register {
        if let Some(&register) = self.last.get(&symbol) {
            return register;
        }
        let register = self.recorder.register();
        self.last.insert(symbol, register);
        self.last_order.push((symbol, register));
        register
    }

    /// A register for what an operation finds.
    pub fn found(&mut self, symbol: SymbolId) -> Register {
        let register = self.recorder.register();
        self.recorder.bind(symbol, register);
        register
    }

    /// Writes a statement.
    pub fn statement(&mut self, statement: &Statement) {
        let mut value = |expr: &ExprId| self.recorder.value(*expr);
        match statement {
            Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. } => {}
            Statement::Let {
                target,
                value: expr,
                ..
            } => {
                let register = value(expr);
                self.recorder.bind(*target, register);
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let [s, c] = self.recorder.sine_cosine(*angle);
                self.recorder.bind(*sine, s);
                self.recorder.bind(*cosine, c);
            }
            Statement::Lookup {
                targets,
                spline,
                argument,
            } => {
                for (order, target) in (0..).zip(targets) {
                    if let Some(target) = *target {
                        let register = self.recorder.lookup(*spline, order, *argument);
                        self.recorder.bind(target, register);
                    }
                }
            }
            Statement::Angle {
                target,
                sine,
                cosine,
            } => {
                let [sine, cosine] = [sine, cosine].map(value);
                let last = self.last(*target);
                let target = self.found(*target);
                self.operation(Operation::Angle {
                    target,
                    sine,
                    cosine,
                    last,
                });
            }
            Statement::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => {
                let [excess, scale] = [excess, scale].map(value);
                let (bounds, bridged) = self.aside(|writer| {
                    [distance, longest, shortest].map(|it| writer.recorder.value(*it))
                });
                self.operation(Operation::Reach {
                    excess,
                    scale,
                    bounds,
                    bridged,
                });
            }
            Statement::Nonzero {
                value: divisor,
                scale,
            } => {
                let [value, scale] = [divisor, scale].map(value);
                self.operation(Operation::Nonzero { value, scale });
            }
            Statement::Newton { .. } => self.operation(Operation::Newton),
            Statement::Factorize => self.operation(Operation::Factorize),
            Statement::Solve {
                targets,
                right_hand_side,
            } => {
                let right_hand_side = right_hand_side.iter().map(value).collect();
                let targets = targets.iter().map(|it| it.map(|symbol| self.found(symbol)));
                let targets = targets.collect();
                self.operation(Operation::Solve {
                    targets,
                    right_hand_side,
                });
            }
            Statement::Multipliers {
                targets,
                jacobian,
                forces,
            } => {
                let jacobian = jacobian.iter().map(&mut value).collect();
                let forces = forces.iter().map(&mut value).collect();
                let targets = targets.iter().map(|it| it.map(|symbol| self.found(symbol)));
                let targets = targets.collect();
                self.operation(Operation::Multipliers {
                    targets,
                    jacobian,
                    forces,
                });
            }
            Statement::Signal { input, found } => {
                let found = found.map(|symbol| self.found(symbol));
                let input = *input;
                self.operation(Operation::Signal { input, found });
            }
            Statement::Require {
                value: required,
                block,
            } => {
                let required = value(required);
                self.operation(Operation::Require(required, *block));
            }
            Statement::Isolate {
                blocks,
                found,
                bounds,
                sizes,
                jacobian,
                varied,
                variation,
            } => {
                let bounds = bounds.iter().map(&mut value).collect();
                let sizes = sizes.iter().map(&mut value).collect();
                let entries = jacobian.iter();
                let jacobian = entries
                    .map(|(place, entry)| (*place, value(entry)))
                    .collect();
                let found = found.iter().map(|&symbol| self.found(symbol)).collect();
                let (variation, variations) = self.function(variation);
                self.operation(Operation::Isolate(Isolation {
                    blocks: blocks.clone(),
                    bounds,
                    sizes,
                    jacobian,
                    found,
                    variation,
                    varied: varied.iter().copied().zip(variations).collect(),
                }));
            }
        }
    }

    /// Writes a function, whose results nothing else may rely on: what it does, and where its results are.
    pub fn function(&mut self, function: &Function) -> (Vec<Operation>, Vec<Register>) {
        self.apart(|writer| {
            for statement in &function.statements {
                writer.statement(statement);
            }
            let results = function.results.iter();
            results.map(|it| writer.recorder.value(it.expr)).collect()
        })
    }

    /// Writes an operation after the instructions that were recorded.
    fn operation(&mut self, operation: Operation) {
        self.flush();
        self.written.push(operation);
    }

    fn flush(&mut self) {
        let range = self.from..self.recorder.position();
        if !range.is_empty() {
            self.from = range.end;
            self.written.push(Operation::Run(range));
        }
    }

    /// What was written since the last time.
    pub fn take(&mut self) -> Vec<Operation> {
        self.flush();
        std::mem::take(&mut self.written)
    }

    /// Records instructions that run when somebody asks for them, and says where they are. Nothing else may rely on what they compute.
    pub fn aside<T>(&mut self, record: impl FnOnce(&mut Self) -> T) -> (Range<usize>, T) {
        let from = self.recorder.position();
        let (_, result) = self.apart(record);
        (from..self.recorder.position(), result)
    }

    /// Writes operations that run when somebody asks for them. Nothing else may rely on what they compute.
    pub fn apart<T>(&mut self, write: impl FnOnce(&mut Self) -> T) -> (Vec<Operation>, T) {
        let before = self.take();
        let mark = self.recorder.mark();
        let result = write(self);
        self.recorder.forget(mark);
        let operations = self.take();
        self.written = before;
        (operations, result)
    }

    /// The code, and the symbols whose last values it reads.
    pub fn finish(self) -> (Code, Vec<(SymbolId, Register)>) {
        (self.recorder.finish(), self.last_order)
    }
}
