//! *A [`System`] → its solved view, evaluated without a compile step.*
//!
//! [`SolvedInterpreter`] runs the same statements as a generated module, block by block, with any choice of assembly modes:
//! that is how the assemblies of a mechanism are found one by one, and how the displacements and angles that are no
//! coordinates are known at a pose. Afterwards every unknown of the vector form has its position and rate; accelerations are
//! left to the textbook view. The module does not know how modes are chosen, nor what a determinant means.

use std::cell::RefCell;

use linkwright::closed_form::{angle_near, spans};
use linkwright::{Equations, Settings, assemble};
use linkwright_codegen::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::program::solved::{Action, Branch, Level, NewtonBlock, whole};
use linkwright_codegen::structure::{self, SolvedPlan};
use linkwright_codegen::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

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

/// The equations of a block without a closed form.
#[derive(Clone, Debug)]
struct Newton {
    positions: Vec<SymbolId>,
    rates: Vec<SymbolId>,
    scales: Vec<f64>,
    /// Residuals are lengths, but for angles that a gear or a driver ties.
    row_scale: f64,
    geometry: Vec<Operation>,
    residuals: Tape,
    jacobian: Tape,
    time_derivative: Tape,
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
                newton: block.program.newton.map(|it| newton(&it, &system)),
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

fn newton(block: &NewtonBlock, system: &System) -> Newton {
    let graph = &system.mechanism.graph;
    let unknowns: Vec<_> = block
        .unknowns
        .iter()
        .map(|&unknown| &system.vector_form.unknowns[unknown])
        .collect();
    Newton {
        positions: unknowns.iter().map(|it| it.position).collect(),
        rates: unknowns.iter().map(|it| it.rate).collect(),
        scales: unknowns
            .iter()
            .map(|it| system.scale(it.quantity))
            .collect(),
        row_scale: system.mechanism.characteristic_length,
        geometry: operations(block.geometry.iter(), system),
        residuals: Tape::new(graph, &block.residuals),
        jacobian: Tape::new(graph, &block.jacobian),
        time_derivative: Tape::new(graph, &block.time_derivative),
    }
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

impl Newton {
    /// Finds the tears and their rates from their last values.
    fn solve(&self, values: &mut Values) -> bool {
        let start = self.positions.iter().map(|it| values.symbols[it.index()]);
        let start = DVector::from_iterator(self.positions.len(), start);
        let equations = At {
            newton: self,
            symbols: RefCell::new(values.symbols.clone()),
        };
        let Ok(frame) = assemble(&equations, &start, values.t, &Settings::default()) else {
            return false;
        };
        for (place, (position, rate)) in self.positions.iter().zip(&self.rates).enumerate() {
            values.symbols[position.index()] = frame.q[place];
            values.symbols[rate.index()] = frame.qd[place];
        }
        true
    }
}

/// The equations of a Newton block after the blocks before it.
struct At<'a> {
    newton: &'a Newton,
    symbols: RefCell<Vec<f64>>,
}

impl At<'_> {
    fn evaluate(&self, tape: &Tape, tears: &DVector<f64>, results: &mut [f64]) {
        let symbols = &mut *self.symbols.borrow_mut();
        let mut workspace = Vec::new();
        for (symbol, value) in self.newton.positions.iter().zip(tears.iter()) {
            symbols[symbol.index()] = *value;
        }
        for operation in &self.newton.geometry {
            run(operation, symbols, &mut workspace);
        }
        tape.evaluate(symbols, &mut workspace, results);
    }
}

impl Equations<f64, Dyn> for At<'_> {
    fn dimension(&self) -> Dyn {
        Dyn(self.newton.positions.len())
    }

    fn residual(&self, q: &DVector<f64>, _: f64, phi: &mut DVector<f64>) {
        self.evaluate(&self.newton.residuals, q, phi.as_mut_slice());
    }

    fn jacobian(&self, q: &DVector<f64>, _: f64, phi_q: &mut DMatrix<f64>) {
        let mut rows = vec![0.0; q.len() * q.len()];
        self.evaluate(&self.newton.jacobian, q, &mut rows);
        phi_q.copy_from(&DMatrix::from_row_slice(q.len(), q.len(), &rows));
    }

    fn time_derivative(&self, q: &DVector<f64>, _: f64, phi_t: &mut DVector<f64>) {
        self.evaluate(&self.newton.time_derivative, q, phi_t.as_mut_slice());
    }

    /// Accelerations are left to the textbook view.
    fn gamma(&self, _: &DVector<f64>, _: &DVector<f64>, _: f64, gamma: &mut DVector<f64>) {
        gamma.fill(0.0);
    }

    fn row_scale(&self, _: usize) -> f64 {
        self.newton.row_scale
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.newton.scales[column]
    }
}
