//! *A [`System`] → its solved view, evaluated without a compile step.*
//!
//! [`SolvedInterpreter`] runs the same statements as a generated module, block by block, with any choice of assembly modes:
//! that is how the assemblies of a mechanism are found one by one, and how the displacements and angles that are no
//! coordinates are known at a pose. Afterwards every unknown of the vector form has its position and rate; accelerations are
//! left to the textbook view. The module does not know how modes are chosen, nor what a determinant means.

mod newton;

use linkwright::closed_form::{angle_near, spans};
use linkwright_codegen::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::program::solved::{Action, Branch, Level, whole};
use linkwright_codegen::structure::{self, SolvedPlan};
use linkwright_codegen::system::System;
use nalgebra::DVector;

use newton::Newton;

/// The solved view of a mechanism with nothing left out, in SI units: m, rad, s.
#[derive(Clone, Debug)]
pub struct SolvedInterpreter {
    /// The system with the values that are computed on the way.
    pub system: System,
    /// The plan that is followed.
    pub plan: SolvedPlan,
    blocks: Vec<Block>,
    time: SymbolId,
    signals: Tape,
    signal_symbols: Vec<SymbolId>,
}

/// A block as instructions.
#[derive(Clone, Debug)]
struct Block {
    operations: Vec<Operation>,
    newton: Option<Newton>,
    branches: Vec<Branch>,
}

#[derive(Clone, Debug)]
enum Operation {
    Let(SymbolId, Tape),
    SineCosine([SymbolId; 2], Tape),
    Angle(SymbolId, Tape),
    /// Fails unless the first value is safely positive beside the second.
    Reach(Tape),
    /// The same for the squares of both.
    Nonzero(Tape),
    Newton,
}

/// The values of all symbols: what has been computed so far.
#[derive(Clone, Debug)]
pub struct Values {
    /// The time (s).
    pub t: f64,
    /// By symbol.
    pub symbols: Vec<f64>,
}

/// The first block that cannot be solved in the chosen modes, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unsolved {
    /// The block.
    pub block: usize,
}

impl SolvedInterpreter {
    /// The solved view of `system`; `None` where its equations do not determine the motion.
    pub fn new(system: &System) -> Option<SolvedInterpreter> {
        let mut system = system.clone();
        // What is asked for would leave other things out.
        system.mechanism.requests.clear();
        system.mechanism.transmissions.clear();
        system.directions.clear();
        let plan = structure::plan_of_motion(&mut system)?;
        let lowered = whole(&mut system, &plan);
        let blocks = lowered.into_iter().map(|block| {
            let before = |action: &&Action| {
                !matches!(
                    action,
                    Action::Section(Level::Acceleration | Level::Response(_))
                )
            };
            let actions = block.program.actions.iter().take_while(before);
            Block {
                operations: operations(actions, &system),
                newton: block.program.newton.map(|it| Newton::new(&it, &system)),
                branches: block.branches,
            }
        });
        let blocks = blocks.collect();
        let inputs = system.mechanism.inputs.iter();
        let signals: Vec<ExprId> = inputs.clone().flat_map(|it| it.signal).collect();
        Some(SolvedInterpreter {
            time: system.mechanism.time,
            signals: Tape::new(&system.mechanism.graph, &signals),
            signal_symbols: inputs.flat_map(|it| it.symbols).collect(),
            plan,
            blocks,
            system,
        })
    }

    /// The assembly modes of a block.
    pub fn branches(&self, block: usize) -> &[Branch] {
        &self.blocks[block].branches
    }

    /// How many blocks there are.
    pub fn block_count(&self) -> usize {
        self.blocks.len()
    }

    /// The sign of every assembly mode in the drawing, block by block.
    pub fn drawn_signs(&self) -> Vec<Vec<bool>> {
        let signs = |block: &Block| block.branches.iter().map(|it| it.positive).collect();
        self.blocks.iter().map(signs).collect()
    }

    /// What is known before the first block: time, parameters and inputs, and the drawing's unknowns as what angles are near
    /// to.
    pub fn begin(&self, t: f64) -> Values {
        let graph = &self.system.mechanism.graph;
        let mut symbols = vec![0.0; graph.symbol_count()];
        graph.fill_nominal(&mut symbols);
        for unknown in &self.system.vector_form.unknowns {
            symbols[unknown.position.index()] =
                graph.constant_value(unknown.estimate).unwrap_or(0.0);
        }
        let mut values = Values { t, symbols };
        self.set_time(&mut values, t);
        values
    }

    /// Puts in another time, and what the inputs are then.
    pub fn set_time(&self, values: &mut Values, t: f64) {
        values.t = t;
        values.symbols[self.time.index()] = t;
        let mut signals = vec![0.0; self.signal_symbols.len()];
        self.signals
            .evaluate(&values.symbols, &mut Vec::new(), &mut signals);
        for (symbol, value) in self.signal_symbols.iter().zip(signals) {
            values.symbols[symbol.index()] = value;
        }
    }

    /// Solves one block in the modes with these signs (`true` for positive), after those before it.
    ///
    /// # Errors
    /// The block's links do not reach, or Newton-Raphson fails from the last values.
    pub fn solve_block(
        &self,
        index: usize,
        signs: &[bool],
        values: &mut Values,
    ) -> Result<(), Unsolved> {
        let block = &self.blocks[index];
        for (branch, positive) in block.branches.iter().zip(signs) {
            values.symbols[branch.symbol.index()] = if *positive { 1.0 } else { -1.0 };
        }
        let mut workspace = Vec::new();
        for operation in &block.operations {
            let done = match (operation, &block.newton) {
                (Operation::Newton, Some(newton)) => newton.solve(values),
                _ => run(operation, &mut values.symbols, &mut workspace),
            };
            if !done {
                return Err(Unsolved { block: index });
            }
        }
        Ok(())
    }

    /// Solves all blocks at `t`, from `values` as the last pose.
    ///
    /// # Errors
    /// The first block that cannot be solved.
    pub fn solve(&self, t: f64, signs: &[Vec<bool>], values: &mut Values) -> Result<(), Unsolved> {
        self.set_time(values, t);
        for (index, signs) in signs.iter().enumerate() {
            self.solve_block(index, signs, values)?;
        }
        Ok(())
    }

    /// The coordinates q among the values.
    pub fn pose(&self, values: &Values) -> DVector<f64> {
        let positions = self.system.coordinates.iter().map(|it| it.position);
        DVector::from_iterator(
            self.system.coordinates.len(),
            positions.map(|symbol| values.symbols[symbol.index()]),
        )
    }

    /// Puts in the coordinates of a pose, as what angles are near to and Newton-Raphson starts from.
    pub fn set_pose(&self, values: &mut Values, q: &DVector<f64>) {
        for (coordinate, value) in self.system.coordinates.iter().zip(q.iter()) {
            values.symbols[coordinate.position.index()] = *value;
        }
    }
}

/// Actions as operations; comments and sections do nothing.
fn operations<'a>(actions: impl Iterator<Item = &'a Action>, system: &System) -> Vec<Operation> {
    let tape = |roots: &[ExprId]| Tape::new(&system.mechanism.graph, roots);
    actions
        .filter_map(|action| {
            Some(match action {
                Action::Let { target, value } => Operation::Let(*target, tape(&[*value])),
                Action::SineCosine {
                    sine,
                    cosine,
                    angle,
                } => Operation::SineCosine([*sine, *cosine], tape(&[*angle])),
                Action::Angle {
                    unknown,
                    sine,
                    cosine,
                } => Operation::Angle(
                    system.vector_form.unknowns[*unknown].position,
                    tape(&[*sine, *cosine]),
                ),
                Action::Reach { excess, scale, .. } => Operation::Reach(tape(&[*excess, *scale])),
                Action::Nonzero { value, scale } => Operation::Nonzero(tape(&[*value, *scale])),
                Action::Newton => Operation::Newton,
                // Shared values are evaluated where they occur; nothing is factorized without directions.
                _ => return None,
            })
        })
        .collect()
}

/// Runs one operation; whether it could be.
fn run(operation: &Operation, symbols: &mut [f64], workspace: &mut Vec<f64>) -> bool {
    let mut pair = [0.0; 2];
    match operation {
        Operation::Let(target, tape) => {
            tape.evaluate(symbols, workspace, &mut pair[..1]);
            symbols[target.index()] = pair[0];
            pair[0].is_finite()
        }
        Operation::SineCosine([sine, cosine], tape) => {
            tape.evaluate(symbols, workspace, &mut pair[..1]);
            (symbols[sine.index()], symbols[cosine.index()]) = pair[0].sin_cos();
            true
        }
        Operation::Angle(target, tape) => {
            tape.evaluate(symbols, workspace, &mut pair);
            let near = symbols[target.index()];
            symbols[target.index()] = angle_near(pair[0], pair[1], near);
            true
        }
        Operation::Reach(tape) => {
            tape.evaluate(symbols, workspace, &mut pair);
            spans(pair[0], pair[1])
        }
        Operation::Nonzero(tape) => {
            tape.evaluate(symbols, workspace, &mut pair);
            spans(pair[0] * pair[0], pair[1] * pair[1])
        }
        Operation::Newton => false,
    }
}
