//! *A [`System`] → its solved view, evaluated without a compile step.*
//!
//! [`SolvedInterpreter`] runs the same statements as a generated module, block by block, with any choice of assembly modes:
//! that is how the assemblies of a mechanism are found one by one, and how the displacements and angles that are no
//! coordinates are known at a pose. Afterwards every unknown of the vector form has its position, rate and acceleration. Like
//! the generated module, blocks without a closed form keep the mode in which they were assembled, and a step that is too long
//! for them is divided. The module does not know how modes are chosen, nor what a determinant means.

mod newton;
mod operation;

use linkwright::{Failure, Settings, in_steps};
use linkwright_codegen::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::program::solved::{Action, Branch, Level, whole};
use linkwright_codegen::structure::{self, SolvedPlan};
use linkwright_codegen::system::{Coordinate, System};
use nalgebra::DVector;

use newton::{Known, Newton};
use operation::{Operation, operations, run};

pub use newton::{SAME, STARTS, Sought};

/// How far a pose of the textbook view may be from one of the solved view, in the scale of each coordinate: at a singular pose
/// the root of what residuals may be.
const SAME_POSE: f64 = 1e-4;

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
    name: String,
    spoken: String,
    operations: Vec<Operation>,
    newton: Option<Newton>,
    branches: Vec<Branch>,
}

/// The values of all symbols: what has been computed so far.
#[derive(Clone, Debug)]
pub struct Values {
    /// The time (s).
    pub t: f64,
    /// By symbol.
    pub symbols: Vec<f64>,
    /// The last frame and the mode of every block without a closed form; `None` for one that is yet to be assembled.
    known: Vec<Option<Known>>,
}

impl SolvedInterpreter {
    /// The solved view of `system`; `None` where its equations do not determine the motion.
    pub fn new(system: &System) -> Option<SolvedInterpreter> {
        let mut system = system.clone();
        // What is asked for would leave other things out.
        system.mechanism.requests.clear();
        system.mechanism.transmissions.clear();
        system.mechanism.monitor = false;
        system.directions.clear();
        let plan = structure::plan_of_motion(&mut system)?;
        let lowered = whole(&mut system, &plan);
        let blocks = lowered.into_iter().map(|block| {
            let before = |action: &&Action| !matches!(action, Action::Section(Level::Response(_)));
            let actions = block.program.actions.iter().take_while(before);
            Block {
                operations: operations(actions, &system),
                newton: block.program.newton.map(|it| Newton::new(&it, &system)),
                branches: block.branches,
                name: block.program.name,
                spoken: block.program.spoken,
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

    /// All combinations of signs that the assembly modes of a block can have, positive ones first.
    pub fn choices(&self, block: usize) -> impl Iterator<Item = Vec<bool>> + use<> {
        let modes = self.blocks[block].branches.len();
        (0..1_usize << modes.min(usize::BITS as usize - 2))
            .map(move |choice| (0..modes).map(|mode| choice >> mode & 1 == 0).collect())
    }

    /// The name of a block in the generated code, and what a person calls it.
    pub fn block_names(&self, block: usize) -> [&str; 2] {
        let block = &self.blocks[block];
        [&block.name, &block.spoken]
    }

    /// Whether a block has no closed form, so that Newton-Raphson solves it.
    pub fn is_iterated(&self, block: usize) -> bool {
        self.blocks[block].newton.is_some()
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
        let known = vec![None; self.blocks.len()];
        let mut values = Values { t, symbols, known };
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

    /// Solves one block in the modes with these signs (`true` for positive), after those before it. One without a closed form
    /// goes on from its last frame, or is assembled near the last values.
    ///
    /// # Errors
    /// The block's links do not reach, or Newton-Raphson fails; the values of this block are then not those of a pose.
    pub fn solve_block(
        &self,
        index: usize,
        signs: &[bool],
        values: &mut Values,
    ) -> Result<(), Failure<f64>> {
        self.run_block(index, signs, Sought::Near, values)
    }

    /// Solves one block like [`SolvedInterpreter::solve_block`], but in the mode that is sought where it has no closed form.
    ///
    /// # Errors
    /// The same; [`linkwright::FailureKind::WrongBranch`] where no pose of that mode was found.
    pub fn run_block(
        &self,
        index: usize,
        signs: &[bool],
        sought: Sought,
        values: &mut Values,
    ) -> Result<(), Failure<f64>> {
        let block = &self.blocks[index];
        set_signs(block, signs, values);
        let mut workspace = Vec::new();
        let number = u16::try_from(index).unwrap_or(u16::MAX);
        for operation in &block.operations {
            let done = match (operation, &block.newton) {
                (Operation::Newton, Some(newton)) => newton.solve(
                    values.t,
                    &mut values.symbols,
                    &mut values.known[index],
                    sought,
                ),
                _ => run(operation, values.t, &mut values.symbols, &mut workspace),
            };
            done.map_err(|failure| failure.in_block(number))?;
        }
        Ok(())
    }

    /// The poses of one block in the modes with these signs, after those before it: one at most for a closed form; for a block
    /// without one those that Newton-Raphson finds from the last values, first, and from [`STARTS`] poses at random, of which
    /// there may be more.
    pub fn poses(&self, index: usize, signs: &[bool], values: &Values) -> Vec<Values> {
        let solved_from = |mut start: Values| {
            start.known[index] = None;
            let solved = self.solve_block(index, signs, &mut start);
            solved.ok().map(|()| start)
        };
        let Some(newton) = &self.blocks[index].newton else {
            return solved_from(values.clone()).into_iter().collect();
        };
        let mut before = values.clone();
        if self.run_until_newton(index, signs, &mut before).is_err() {
            return Vec::new();
        }
        let tears = newton.poses(values.t, &before.symbols);
        let poses = tears.iter().filter_map(|pose| {
            let mut start = values.clone();
            newton.place(pose, &mut start.symbols);
            solved_from(start)
        });
        poses.collect()
    }

    /// Computes what a block's Newton-Raphson is given.
    fn run_until_newton(
        &self,
        index: usize,
        signs: &[bool],
        values: &mut Values,
    ) -> Result<(), Failure<f64>> {
        let block = &self.blocks[index];
        set_signs(block, signs, values);
        let before = |operation: &&Operation| !matches!(operation, Operation::Newton);
        let mut workspace = Vec::new();
        for operation in block.operations.iter().take_while(before) {
            run(operation, values.t, &mut values.symbols, &mut workspace)?;
        }
        Ok(())
    }

    /// Solves all blocks at `t`, from `values` as the last pose, in as many steps as blocks without a closed form need.
    ///
    /// # Errors
    /// The first block that cannot be solved; the values stay as they were.
    pub fn solve(
        &self,
        t: f64,
        signs: &[Vec<bool>],
        values: &mut Values,
    ) -> Result<(), Failure<f64>> {
        let mut last = values.clone();
        let mut step = |target: f64| {
            let mut after = last.clone();
            self.set_time(&mut after, target);
            for (index, signs) in signs.iter().enumerate() {
                self.solve_block(index, signs, &mut after)?;
            }
            last = after;
            Ok(())
        };
        if let Err(failure) = step(t) {
            if values.known.iter().all(Option::is_none) {
                return Err(failure);
            }
            in_steps(values.t, t, Settings::<f64>::default().substeps, step)
                .map_err(|broken| broken.failure)?;
        }
        *values = last;
        Ok(())
    }

    /// The signs of all assembly modes at a pose q (n), and the values there; `None` where the pose is none of the solved view.
    pub fn modes_of(&self, q: &DVector<f64>, t: f64) -> Option<(Vec<Vec<bool>>, Values)> {
        let mut values = self.begin(t);
        self.set_pose(&mut values, q);
        let mut signs = Vec::with_capacity(self.blocks.len());
        for index in 0..self.blocks.len() {
            let (own, solved) = self.choices(index).find_map(|own| {
                let mut solved = values.clone();
                self.solve_block(index, &own, &mut solved).ok()?;
                let pose = self.pose(&solved);
                let mut pairs = self
                    .system
                    .coordinates
                    .iter()
                    .zip(pose.iter().zip(q.iter()));
                let same = pairs.all(|(coordinate, (found, wanted))| {
                    (found - wanted).abs() <= SAME_POSE * self.system.scale(coordinate.quantity)
                });
                same.then_some((own, solved))
            })?;
            values = solved;
            signs.push(own);
        }
        Some((signs, values))
    }

    /// The coordinates q among the values.
    pub fn pose(&self, values: &Values) -> DVector<f64> {
        let [q, _, _] = self.levels(values);
        q
    }

    /// q, q̇ and q̈ among the values.
    pub fn levels(&self, values: &Values) -> [DVector<f64>; 3] {
        let symbols = |level: fn(&Coordinate) -> SymbolId| {
            let symbols = self.system.coordinates.iter().map(level);
            let values = symbols.map(|symbol| values.symbols[symbol.index()]);
            DVector::from_vec(values.collect())
        };
        [
            symbols(|it| it.position),
            symbols(|it| it.rate),
            symbols(|it| it.acceleration),
        ]
    }

    /// Puts in the coordinates of a pose, as what angles are near to and Newton-Raphson starts from: an estimate, so that blocks
    /// are assembled anew.
    pub fn set_pose(&self, values: &mut Values, q: &DVector<f64>) {
        values.known.fill(None);
        for (coordinate, value) in self.system.coordinates.iter().zip(q.iter()) {
            values.symbols[coordinate.position.index()] = *value;
        }
    }
}

/// Puts in the assembly modes of a block.
fn set_signs(block: &Block, signs: &[bool], values: &mut Values) {
    for (branch, positive) in block.branches.iter().zip(signs) {
        values.symbols[branch.symbol.index()] = if *positive { 1.0 } else { -1.0 };
    }
}
