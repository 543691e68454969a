//! *The blocks of a program and what shows that frames lie on their path* → *how much one call of `advance` computes at most*.
//!
//! Closed forms compute the same in every frame. What is repeated has a bound in the runtime: the iterations of Newton-Raphson, how often a
//! guard looks at a window, the attempts of a way, the crossings of dead points and the poses that each of them compares. Counted is the
//! arithmetic of equations, elimination and substitution; norms, comparisons and copies are not. The module does not know how the
//! runtime does it, only how often; a test compares the numbers with its sources.

use crate::program::block::{Block, NewtonBlock};
use crate::program::function::{Function, Statement};
use crate::program::passes::costs::{Operations, of_function};
use crate::program::passes::elimination::{elimination, substitution};
use crate::program::passes::iterations::{BEYOND_STEPS, EVALUATIONS, STEPS};
use crate::program::path::Path;
use crate::system::System;

/// The attempts of a way, unless set otherwise.
pub const SUBSTEPS: usize = 256;

/// How many dead points one way may cross.
pub const CROSSINGS: usize = 8;
/// How often the times about a dead point are brought closer together.
pub const REFINEMENTS: usize = 32;
/// Number of the ways at which the modes are seen well apart.
pub const WAYS: usize = 12;
/// Number of the times, each nearer to a meeting than the one before, at which modes of a block are looked at beside the first.
pub const NEARER: usize = 3;
/// Number of the first blocks whose modes may be exchanged in one instant.
pub const BLOCKS: usize = 64;

/// How often a guard looks at most: at windows of 1024 to 2 steps, each 0.625 of the last one, and at the step alone.
pub const LOOKS: usize = 15;

/// How often the deviations of a window are widened.
pub const WIDENED: usize = 8;

/// What a cell of a chain takes at most: additions, multiplications and divisions; and additions and multiplications in each round.
const OF_CELL: [usize; 3] = [240, 280, 16];
const OF_CELL_IN_ROUND: usize = 32;

/// Poses of one path about a dead point: eight on both sides, the nearest one, and three modes there.
const PATH_POSES: usize = 8 + 1 + 3;

/// Poses of one crossing: two modes on both sides of each way, and at four times for each refinement. The path is told twice, as it
/// leads to the dead point and as it leads away, each time examined as a whole, and interpolated three times. At an end, its pose, two modes
/// elsewhere and two beside it.
const CROSSING_POSES: usize = 2 * 2 * WAYS + 2 * 4 * REFINEMENTS + (2 + 3 * 3) * PATH_POSES + 5;

/// Poses of one crossing for each block that may cross: two modes where the way has broken, nearer to the meeting, and on both sides of
/// each way; two modes, and two paths, told twice.
const POSES_OF_BLOCK: usize = 2 + 2 * (1 + NEARER) + 2 * 2 * WAYS + 2 * (2 + 2 * PATH_POSES);

/// Crossings at both ends of a way.
pub const ENDS: usize = 2;

/// The solves of a regularity that is in doubt, and those of rates and accelerations.
const DOUBTFUL_SOLVES: usize = 13;
const RATE_SOLVES: usize = 2;

/// Evaluations of residuals from a poor estimate, for each step of Newton-Raphson and besides, as the runtime states them.
pub const AFAR_RESIDUALS: [usize; 2] = [13, 74];
/// Evaluations of the Jacobian from there, likewise.
pub const AFAR_JACOBIANS: [usize; 2] = [5, 79];
/// Attempts of Newton-Raphson from there.
const AFAR_FINISHES: usize = 3;
/// Steps of least squares that improve a poor estimate.
pub const LEAST_SQUARES: usize = 60;

/// What a call of `advance` takes at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// All blocks once; without iterations exactly this.
    pub attempt: Operations,
    /// All blocks once from an estimate, as `recover` solves them; without iterations exactly this.
    pub recover: Operations,
    /// Whether blocks are iterated.
    pub is_iterated: bool,
    /// Number of blocks that may cross in one instant.
    pub crossing: usize,
    /// What is looked at of the path; `None` where nothing is guarded.
    pub window: Option<Looks>,
}

/// What a guard takes where it looks for a window of the path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Looks {
    /// One look.
    pub look: Operations,
    /// What the last look takes beside, which a chain of cells takes as a whole.
    pub last: Operations,
}

impl Work {
    /// Of the blocks that are kept, whose levels take so many operations, and of their path.
    pub(in crate::program) fn of(
        blocks: &[Block],
        levels: &[Operations],
        path: Option<&Path>,
        system: &System,
    ) -> Self {
        let mut attempt = Operations::default();
        for level in levels {
            attempt += *level;
        }
        let iterated: Vec<&NewtonBlock> =
            blocks.iter().filter_map(|it| it.newton.as_ref()).collect();
        // The multipliers of parts without a closed form.
        let statements = blocks.iter().flat_map(|it| &it.function.statements);
        for statement in statements {
            if let Statement::Multipliers { forces, .. } = statement {
                attempt += elimination(forces.len());
                attempt += substitution(forces.len());
            }
        }
        let mut recover = attempt;
        for newton in &iterated {
            attempt += of_newton(newton, system);
            recover += of_newton_from_afar(newton, system);
        }
        Self {
            attempt,
            recover,
            is_iterated: !iterated.is_empty(),
            crossing: blocks.len().min(BLOCKS),
            window: path.map(|path| {
                let mut window = Looks::default();
                for function in [&path.function].into_iter().chain(&path.closed) {
                    window.add(function, system);
                }
                window
            }),
        }
    }

    /// The poses that a way of so many attempts takes which one does not lead along, the first one included.
    pub fn poses(&self, substeps: usize) -> usize {
        match self.window {
            Some(_) => {
                let crossing = CROSSING_POSES + self.crossing * POSES_OF_BLOCK;
                let crossings = CROSSINGS + ENDS;
                // A way that breaks looks once more at how far modes are apart.
                2 + substeps + crossings * 2 * substeps + (crossings + 1) * crossing
            }
            None => 1 + substeps,
        }
    }

    /// How often the guard of such a way looks for a window.
    pub fn windows(&self, substeps: usize) -> usize {
        1 + substeps + (CROSSINGS + ENDS) * 2 * substeps
    }

    /// The operations of such a way: those that do not grow with the attempts, and those of each.
    pub fn whole(&self) -> [usize; 2] {
        let window = self.window.map_or(0, |it| it.total());
        let with = |substeps: usize| {
            self.poses(substeps) * self.attempt.total() + self.windows(substeps) * window
        };
        [with(0), with(1) - with(0)]
    }
}

/// Newton-Raphson with its rates and its last look.
fn of_newton(newton: &NewtonBlock, system: &System) -> Operations {
    let order = newton.unknowns.len();
    let [residuals, jacobians] = BEYOND_STEPS.map(|more| STEPS + more);
    let mut all = of_function(&newton.residual, system).times(residuals);
    all += of_function(&newton.jacobian, system).times(jacobians);
    all += of_function(&newton.time_derivative, system);
    all += of_function(&newton.gamma, system);
    all += elimination(order).times(jacobians);
    all += substitution(order).times(residuals + RATE_SOLVES + DOUBTFUL_SOLVES);
    if let Some(tearing) = &newton.tearing {
        // In vain at first, and once more for what the next frame begins with.
        all += of_function(&tearing.evaluate, system).times(EVALUATIONS + 1);
        all += of_function(&tearing.scales, system).times(2);
        all += of_function(&tearing.complete, system);
        all += of_function(&tearing.sign_values, system);
        all.sines += order;
        all.arctangents += tearing.angles;
    }
    all
}

/// Newton-Raphson from a poor estimate: least squares, then plain and damped Newton-Raphson, and whole turns that are taken off.
fn of_newton_from_afar(newton: &NewtonBlock, system: &System) -> Operations {
    let order = newton.unknowns.len();
    let residuals = AFAR_RESIDUALS[0] * STEPS + AFAR_RESIDUALS[1] + 1 + order;
    let jacobians = AFAR_JACOBIANS[0] * STEPS + AFAR_JACOBIANS[1] + 1;
    let mut all = of_newton(newton, system);
    all += of_function(&newton.residual, system).times(residuals);
    all += of_function(&newton.jacobian, system).times(jacobians);
    all += of_function(&newton.time_derivative, system).times(AFAR_FINISHES);
    all += of_function(&newton.gamma, system).times(AFAR_FINISHES);
    all += elimination(order).times(jacobians);
    all += substitution(order).times(residuals + AFAR_FINISHES * (RATE_SOLVES + DOUBTFUL_SOLVES));
    // The normal equations of each step: their matrix, the gradient, and what both are scaled by.
    let mut normal = products(order, order + 2);
    normal.divisions = order * order + 2 * order;
    all += normal.times(1 + LEAST_SQUARES);
    all
}

impl Looks {
    /// All looks.
    pub fn total(&self) -> usize {
        LOOKS * self.look.total() + self.last.total()
    }

    /// Adds what a path shows, with the largest number of rounds.
    fn add(&mut self, function: &Function, system: &System) {
        self.look += of_function(function, system);
        for statement in &function.statements {
            if let Statement::Isolate {
                is_chain,
                found,
                turning,
                variation,
                ..
            } = statement
            {
                let order = found.len();
                // An inverse takes three times the elimination, and each round three products.
                let mut whole = elimination(order).times(3);
                whole += products(order, 4);
                whole += Operations {
                    additions: order * turning.len(),
                    multiplications: order * turning.len(),
                    ..Operations::default()
                };
                let mut round = of_function(variation, system);
                round += products(order, 3);
                whole += round.times(WIDENED);
                match is_chain {
                    true => {
                        self.look += of_chain(order);
                        self.last += whole;
                    }
                    false => self.look += whole,
                }
            }
        }
    }
}

/// What shows that a chain with so many unknowns stays on its path.
fn of_chain(order: usize) -> Operations {
    let [additions, multiplications, divisions] = OF_CELL;
    let rounds = WIDENED * OF_CELL_IN_ROUND;
    let cell = Operations {
        additions: additions + rounds,
        multiplications: multiplications + rounds,
        divisions,
        ..Operations::default()
    };
    cell.times(order / 2)
}

/// Products of a square matrix with a vector.
fn products(order: usize, count: usize) -> Operations {
    Operations {
        additions: count * order * order,
        multiplications: count * order * order,
        ..Operations::default()
    }
}
