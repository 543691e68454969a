//! Bounds the operations of one call of `advance`.
//!
//! Closed forms take the same operations in every frame. Repetition has limits in the runtime: iterations of Newton-Raphson,
//! windows that a guard examines, substeps, crossings of dead centers, and poses that each crossing compares. Counts include the
//! arithmetic of equations, elimination and substitution, without norms, comparisons and copies. Limits repeat those of the
//! runtime; a test compares them with its sources.

use crate::pool::Pool;
use crate::program::block::{Block, NewtonBlock};
use crate::program::function::{Function, Statement};
use crate::program::passes::costs::{Operations, of_function};
use crate::program::passes::elimination::{elimination, substitution};
use crate::program::passes::iterations::{BEYOND_STEPS, EVALUATIONS, STEPS};
use crate::program::path::Path;
use crate::system::System;

/// Default number of substeps of a call.
pub const SUBSTEPS: usize = 256;

/// Largest number of dead centers that one call may cross.
pub const CROSSINGS: usize = 8;
/// Largest number of refinements of the times about a dead center.
pub const REFINEMENTS: usize = 32;
/// Number of distances from a dead center at which the modes are compared as well separated.
pub const WAYS: usize = 12;
/// Number of times, each nearer to a change point than the one before, at which modes of another block are compared, besides the
/// first.
pub const NEARER: usize = 3;
/// Number of the first blocks whose modes may be exchanged in one instant.
pub const BLOCKS: usize = 64;

/// Largest number of windows that a guard examines: of 1024 to 2 steps, each 0.625 of the last one, and the step alone.
pub const LOOKS: usize = 15;

/// Largest number of inflations of a window's deviations.
pub const WIDENED: usize = 8;

/// Largest numbers of additions, multiplications and divisions for a cell of a chain; below, those of additions and of
/// multiplications in each round.
const OF_CELL: [usize; 3] = [240, 280, 16];
const OF_CELL_IN_ROUND: usize = 32;

/// Largest number of steps that solve for the forces of friction.
pub const FRICTION_STEPS: usize = 32;

/// Poses of one path about a dead center: eight on both sides, the nearest one, and three modes there.
const PATH_POSES: usize = 8 + 1 + 3;

/// Poses of one crossing: two modes on both sides at each distance, and at four times for each refinement. The path is followed
/// twice, to the dead center and away from it, each time examined as a whole and interpolated three times. An end needs its pose,
/// two modes elsewhere and two near it.
const CROSSING_POSES: usize = 2 * 2 * WAYS + 2 * 4 * REFINEMENTS + (2 + 3 * 3) * PATH_POSES + 5;

/// Poses of one crossing for each block that may cross: two modes where the path has broken, nearer to the change point, and on
/// both sides at each distance; two modes and two paths, followed twice.
const POSES_OF_BLOCK: usize = 2 + 2 * (1 + NEARER) + 2 * 2 * WAYS + 2 * (2 + 2 * PATH_POSES);

/// Crossings at both ends of a call's path.
pub const ENDS: usize = 2;

/// Solves of a doubtful regularity check; below, those of rates and accelerations.
const DOUBTFUL_SOLVES: usize = 13;
const RATE_SOLVES: usize = 2;

/// Evaluations of residuals from a rough estimate, per step of Newton-Raphson and in addition, as in the runtime.
pub const AFAR_RESIDUALS: [usize; 2] = [13, 74];
/// Evaluations of the Jacobian from a rough estimate, likewise.
pub const AFAR_JACOBIANS: [usize; 2] = [5, 79];
/// Attempts of Newton-Raphson from a rough estimate.
const AFAR_FINISHES: usize = 3;
/// Steps of least squares that improve a rough estimate.
pub const LEAST_SQUARES: usize = 60;

/// Largest work of a call of `advance`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Operations of all blocks once; exact without iterations.
    pub attempt: Operations,
    /// Operations of all blocks once from an estimate, as `recover` solves them; exact without iterations.
    pub recover: Operations,
    /// True if a block is iterated.
    pub is_iterated: bool,
    /// True if the forces of friction are iterated.
    pub has_friction: bool,
    /// Number of blocks that may cross in one instant.
    pub crossing: usize,
    /// Work of the path verification; `None` if the path is not guarded.
    pub window: Option<Looks>,
}

/// Work of a guard for a window of the path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Looks {
    /// Operations of one examination of a window.
    pub look: Operations,
    /// Additional operations of the last examination, which inverts the Jacobian of a chain as a whole.
    pub last: Operations,
}

impl Work {
    /// Returns the work of the kept blocks, given the operations of their levels, and of their path.
    pub(in crate::program) fn of(
        blocks: &[Block],
        levels: &[Operations],
        path: Option<&Path>,
        pool: &Pool,
        system: &System,
    ) -> Self {
        let mut attempt = Operations::default();
        for level in levels {
            attempt += *level;
        }
        let iterated: Vec<&NewtonBlock> =
            blocks.iter().filter_map(|it| it.newton.as_ref()).collect();
        let mut has_friction = false;
        // Multipliers of subsystems without a closed form, and friction.
        let statements = blocks.iter().flat_map(|it| &it.function.statements);
        for statement in statements {
            if let Statement::Multipliers { forces, .. } = statement {
                attempt += elimination(forces.len());
                attempt += substitution(forces.len());
            }
            if let Statement::Friction { coefficients, .. } = statement {
                attempt += of_friction(coefficients.len()).times(FRICTION_STEPS);
                has_friction = true;
            }
        }
        let mut recover = attempt;
        for newton in &iterated {
            attempt += of_newton(newton, pool, system);
            recover += of_newton_from_afar(newton, pool, system);
        }
        Self {
            attempt,
            recover,
            is_iterated: !iterated.is_empty(),
            has_friction,
            crossing: blocks.len().min(BLOCKS),
            window: path.map(|path| {
                let mut window = Looks::default();
                for function in [&path.function].into_iter().chain(&path.closed) {
                    window.add(function, pool, system);
                }
                window
            }),
        }
    }

    /// Returns the number of poses of a call with so many substeps that no single substep completes, including the first pose.
    pub fn poses(&self, substeps: usize) -> usize {
        match self.window {
            Some(_) => {
                let crossing = CROSSING_POSES + self.crossing * POSES_OF_BLOCK;
                let crossings = CROSSINGS + ENDS;
                // A path that breaks compares the distance of the modes once more.
                2 + substeps + crossings * 2 * substeps + (crossings + 1) * crossing
            }
            None => 1 + substeps,
        }
    }

    /// Returns the number of windows that the guard of such a call searches.
    pub fn windows(&self, substeps: usize) -> usize {
        1 + substeps + (CROSSINGS + ENDS) * 2 * substeps
    }

    /// Returns the operations of such a call: those independent of the number of substeps, and those per substep.
    pub fn whole(&self) -> [usize; 2] {
        let window = self.window.map_or(0, |it| it.total());
        let with = |substeps: usize| {
            self.poses(substeps) * self.attempt.total() + self.windows(substeps) * window
        };
        [with(0), with(1) - with(0)]
    }
}

/// Returns the operations of Newton-Raphson with its rates and its last verification.
fn of_newton(newton: &NewtonBlock, pool: &Pool, system: &System) -> Operations {
    let order = newton.unknowns.len();
    let [residuals, jacobians] = BEYOND_STEPS.map(|more| STEPS + more);
    let mut all = of_function(&newton.residual, pool, system).times(residuals);
    all += of_function(&newton.jacobian, pool, system).times(jacobians);
    all += of_function(&newton.time_derivative, pool, system);
    all += of_function(&newton.gamma, pool, system);
    all += elimination(order).times(jacobians);
    all += substitution(order).times(residuals + RATE_SOLVES + DOUBTFUL_SOLVES);
    if let Some(tearing) = &newton.tearing {
        // The first attempt may fail; one more evaluation serves the next frame.
        all += of_function(&tearing.evaluate, pool, system).times(EVALUATIONS + 1);
        all += of_function(&tearing.scales, pool, system).times(2);
        all += of_function(&tearing.complete, pool, system);
        all += of_function(&tearing.sign_values, pool, system);
        all.sines += order;
        all.arctangents += tearing.angles;
    }
    all
}

/// Returns the operations of Newton-Raphson from a rough estimate: least squares, then plain and damped Newton-Raphson, and
/// removal of whole turns.
fn of_newton_from_afar(newton: &NewtonBlock, pool: &Pool, system: &System) -> Operations {
    let order = newton.unknowns.len();
    let residuals = AFAR_RESIDUALS[0] * STEPS + AFAR_RESIDUALS[1] + 1 + order;
    let jacobians = AFAR_JACOBIANS[0] * STEPS + AFAR_JACOBIANS[1] + 1;
    let mut all = of_newton(newton, pool, system);
    all += of_function(&newton.residual, pool, system).times(residuals);
    all += of_function(&newton.jacobian, pool, system).times(jacobians);
    all += of_function(&newton.time_derivative, pool, system).times(AFAR_FINISHES);
    all += of_function(&newton.gamma, pool, system).times(AFAR_FINISHES);
    all += elimination(order).times(jacobians);
    all += substitution(order).times(residuals + AFAR_FINISHES * (RATE_SOLVES + DOUBTFUL_SOLVES));
    // Normal equations of each step: their matrix, the gradient, and the scales of both.
    let mut normal = products(order, order + 2);
    normal.divisions = order * order + 2 * order;
    all += normal.times(1 + LEAST_SQUARES);
    all
}

impl Looks {
    /// Returns the operations of all examinations.
    pub fn total(&self) -> usize {
        LOOKS * self.look.total() + self.last.total()
    }

    /// Adds the operations of a path verification, with the largest number of rounds.
    fn add(&mut self, function: &Function, pool: &Pool, system: &System) {
        self.look += of_function(function, pool, system);
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
                // An inverse takes three eliminations, and each round three products.
                let mut whole = elimination(order).times(3);
                whole += products(order, 4);
                whole += Operations {
                    additions: order * turning.len(),
                    multiplications: order * turning.len(),
                    ..Operations::default()
                };
                let mut round = of_function(variation, pool, system);
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

/// Returns the operations of one step that solves for the forces of friction in so many joints.
fn of_friction(joints: usize) -> Operations {
    // Two components and their derivatives for each pair of joints.
    let mut step = products(joints, 4);
    step += elimination(joints);
    step += substitution(joints);
    step.divisions += 2 * joints;
    step.square_roots += joints;
    step
}

/// Returns the operations of the path verification of a chain with so many unknowns.
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

/// Returns the operations of products of a square matrix with a vector.
fn products(order: usize, count: usize) -> Operations {
    Operations {
        additions: count * order * order,
        multiplications: count * order * order,
        ..Operations::default()
    }
}
