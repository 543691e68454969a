//! *The statements of a function* → *operations on registers*.

use std::collections::HashMap;
use std::ops::Range;

use linkwright_codegen::stages::expr::{Code, ExprId, Recorder, Register, SymbolId};
use linkwright_codegen::stages::program::{Function, Requirements, Statement};

use super::Operation;
use crate::path::Isolation;

/// Writes the operations of one function after another.
pub(crate) struct Writer<'a> {
    pub recorder: Recorder<'a>,
    /// Values that must be positive; failures give their places.
    pub requirements: Option<&'a Requirements>,
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
            requirements: None,
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
        match statement {
            Statement::Let { target, value, .. } => {
                let register = self.recorder.value(*value);
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
            _ => {
                if let Some(operation) = self.operation_of(statement) {
                    self.operation(operation);
                }
            }
        }
    }

    /// What a statement does beside instructions; `None` where that is nothing. The values that it needs are recorded.
    fn operation_of(&mut self, statement: &Statement) -> Option<Operation> {
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
                sine: self.recorder.value(*sine),
                cosine: self.recorder.value(*cosine),
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
                let [excess, scale] = [excess, scale].map(|it| self.recorder.value(*it));
                let (bounds, bridged) = self.aside(|writer| {
                    [distance, longest, shortest].map(|it| writer.recorder.value(*it))
                });
                Operation::Reach {
                    excess,
                    scale,
                    bounds,
                    bridged,
                }
            }
            Statement::Nonzero { value, scale } => Operation::Nonzero {
                value: self.recorder.value(*value),
                scale: self.recorder.value(*scale),
            },
            Statement::Positive { length, joint } => Operation::Positive {
                length: self.recorder.value(*length),
                place: self.requirements.map_or(0, |it| {
                    u16::try_from(it.place_of(*joint)).unwrap_or(u16::MAX)
                }),
            },
            Statement::Newton { .. } => Operation::Newton,
            Statement::Factorize => Operation::Factorize,
            Statement::Solve {
                targets,
                right_hand_side,
            } => Operation::Solve {
                right_hand_side: self.values(right_hand_side),
                targets: self.targets(targets),
            },
            Statement::Multipliers {
                targets,
                jacobian,
                forces,
            } => Operation::Multipliers {
                jacobian: self.values(jacobian),
                forces: self.values(forces),
                targets: self.targets(targets),
            },
            Statement::Signal { input, found } => Operation::Signal {
                input: *input,
                found: found.map(|symbol| self.found(symbol)),
            },
            Statement::Require { value, block } => {
                Operation::Require(self.recorder.value(*value), *block)
            }
            Statement::Isolate {
                is_chain,
                blocks,
                found,
                bounds,
                curvatures,
                ways,
                sizes,
                jacobian,
                turns,
                turning,
                varied,
                variation,
            } => {
                let [bounds, curvatures, ways, sizes] =
                    [bounds, curvatures, ways, sizes].map(|it| self.values(it));
                let [jacobian, turning] = [jacobian, turning].map(|entries| {
                    let entries = entries.iter();
                    entries
                        .map(|(place, entry)| (*place, self.recorder.value(*entry)))
                        .collect()
                });
                let found = found.iter().map(|&symbol| self.found(symbol)).collect();
                let (variation, variations) = self.function(variation);
                Operation::Isolate(Isolation {
                    is_chain: *is_chain,
                    blocks: blocks.clone(),
                    bounds,
                    curvatures,
                    ways,
                    sizes,
                    jacobian,
                    turns: turns.clone(),
                    turning,
                    found,
                    variation,
                    varied: varied.iter().copied().zip(variations).collect(),
                })
            }
        })
    }

    fn values(&mut self, exprs: &[ExprId]) -> Vec<Register> {
        exprs.iter().map(|it| self.recorder.value(*it)).collect()
    }

    fn targets(&mut self, symbols: &[Option<SymbolId>]) -> Vec<Option<Register>> {
        let symbols = symbols.iter();
        symbols
            .map(|it| it.map(|symbol| self.found(symbol)))
            .collect()
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
