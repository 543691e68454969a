//! Solves the blocks of a [`System`] without a compile step.
//!
//! [`Interpreted`] runs the statements of generated code, block by block, in the same [`Shell`]: modes, path, failures and their text are
//! equal. [`Interpreted::emitted`] runs the very program that is written out. [`Interpreted::new`] omits nothing: instants store every
//! coordinate and every other unknown of the vector form, with rates and accelerations.

mod beside;
mod blocks;
mod compiled;
mod lanes;
mod limited;
mod loads;
mod path;
mod points;
mod reduced;
mod run;
mod view;

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use linkwright::generated::Start;
use linkwright::{Blocks, Failure, FailureKind, Shell};
use linkwright_codegen::diagnostic::internal::work_at;
use linkwright_codegen::diagnostic::{Code, Diagnostics};
use linkwright_codegen::stages::expr::Register;
use linkwright_codegen::stages::findings_of;
use linkwright_codegen::stages::finiteness::of_unplanned;
use linkwright_codegen::stages::program::{Kept, Program};
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::{Shift, SolvedPlan};
use linkwright_codegen::stages::system::Derived;

use crate::derivatives::{Derivative, of_program};
use crate::emitted::Emitted;
use crate::instant::Instant;
use crate::measures::{Measures, measured};
use crate::reader::Reader;
use crate::reported;
use crate::supplied::{InputSignals, Modes, Pose};
use crate::view::View;
use compiled::Compiled;
use limited::Limited;
use loads::LoadReader;
use path::InterpretedPath;
use points::Points;

pub(crate) use lanes::{InstantLanes, point_result};

/// Mechanism that is solved block by block, in SI units: m, rad, s.
///
/// It implements [`Blocks`](linkwright::Blocks), so a [`Shell`](linkwright::Shell) moves it as a generated mechanism:
///
/// ```
/// use linkwright::{Blocks, Settings, Shell};
/// use linkwright_codegen::Source;
/// use linkwright_solver::{Interpreted, View};
///
/// let text = "
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (2, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///     }";
/// let read = linkwright_codegen::read(&Source::new("crank.mech", text)).expect("no errors");
/// let blocks = Interpreted::new(&read.motions[0]).expect("the equations determine the motion");
/// let (parameters, inputs) = (blocks.nominal_parameters(), blocks.initial_inputs());
/// let (pose, modes) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
/// let mut crank = Shell::assemble(blocks, &parameters, &pose, modes, 0.0, &inputs, Settings::default())?;
/// // Coordinates are x, y and φ of each body.
/// assert_eq!(crank.advance(0.5, &inputs)?.q()[2], 1.5);
/// # Ok::<(), linkwright::Failure>(())
/// ```
#[derive(Clone, Debug)]
pub struct Interpreted {
    compiled: Arc<Compiled>,
    /// Part of the operations that run; `None` for all.
    limited: Option<Arc<Limited>>,
    registers: RefCell<Vec<f64>>,
    path_registers: RefCell<[Vec<f64>; 2]>,
    points: Points,
    /// Evaluator of loads for failures; `None` if no load may become infinite.
    loads: Option<LoadReader>,
    derivatives: Vec<Derivative>,
    /// Indices in instants of the requested forces and measures.
    reported: Vec<Option<usize>>,
    /// Program that is written out; `None` if it omits nothing that this one computes for reports.
    emitted: Option<Box<Emitted<Interpreted>>>,
    residuals: Cell<u64>,
    solves: Cell<u64>,
}

/// Values of all registers while blocks are solved in order.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub t: f64,
    pub registers: Vec<f64>,
}

impl Interpreted {
    /// Returns the blocks of a system, of which none is omitted; `None` if its equations do not determine the motion.
    pub fn new(derived: &Derived) -> Option<Interpreted> {
        let solved = Solved::of(in_full(derived), Shift::Directions, Kept::Unknowns).ok()?;
        Some(Interpreted::of(solved).beside_emitted(derived))
    }

    /// Returns the blocks of the generated module, bit by bit; `None` if the equations do not determine the motion.
    ///
    /// Under `output`, instants hold what the module's frames hold: no [`q`](Instant::q), and no other point.
    pub fn emitted(derived: &Derived) -> Option<Interpreted> {
        let solved = Solved::of(derived.clone(), Shift::Directions, Kept::Requested).ok()?;
        Some(Interpreted::of(solved))
    }

    /// Returns the blocks with the emitted ones beside them if single outputs are requested.
    fn beside_emitted(mut self, derived: &Derived) -> Interpreted {
        if !derived.system.mechanism.requests.is_empty() {
            let emitted = Interpreted::emitted(derived);
            self.emitted = emitted.map(|it| Box::new(beside::beside(it, &self)));
        }
        self
    }

    /// Returns the blocks as [`Interpreted::new`] does, with warnings about their solution.
    ///
    /// # Errors
    /// Numbers in the blocks become infinite or undefined, or the work exceeds its bounds.
    pub fn checked(derived: &Derived) -> Result<(Option<Interpreted>, Diagnostics), Diagnostics> {
        let _work = work_at(derived.system.mechanism.place());
        let solved = match Solved::of(in_full(derived), Shift::Directions, Kept::Unknowns) {
            Ok(solved) => solved,
            Err(unplanned) => {
                let exceeded = of_unplanned(unplanned);
                return match exceeded.has_errors() {
                    true => Err(exceeded.respelled(&derived.system.mechanism.spellings)),
                    false => Ok((None, exceeded)),
                };
            }
        };
        match findings_of(&solved) {
            Ok(warnings) => {
                let fuller = Interpreted::of(solved);
                Ok((Some(fuller.beside_emitted(derived)), warnings))
            }
            Err(found) => {
                let is_of_values = found.iter().all(|it| it.code == Code::NotFinite)
                    && !derived.system.mechanism.parameters.is_empty();
                let interpreted = is_of_values.then(|| Interpreted::of(solved));
                // A length that is rejected or out of reach explains more than a number that follows from it.
                match interpreted.filter(Interpreted::is_refused_as_drawn) {
                    Some(interpreted) => Ok((Some(interpreted), Diagnostics::new())),
                    None => Err(found),
                }
            }
        }
    }

    /// Applies an assignment in the form of a description, `rod = 130mm`, to a parameter or an input, as generated code does at run time:
    /// the solution stays planned for the values of the description. `option` is the subject of errors.
    ///
    /// # Errors
    /// A rendered error with the part of the assignment that cannot be used. Nothing is changed then.
    pub fn set(&mut self, option: &str, assignment: &str) -> Result<(), String> {
        let compiled = Arc::make_mut(&mut self.compiled);
        compiled.solved.set(option, assignment)?;
        if let Some(emitted) = &mut self.emitted {
            emitted.blocks.set(option, assignment)?;
        }
        Ok(())
    }

    /// True if the values of parameters and inputs at t = 0 are rejected, or leave a loop open.
    fn is_refused_as_drawn(&self) -> bool {
        self.assembled_as_drawn(0.0).is_err_and(|failure| {
            let is_open = matches!(failure.kind, FailureKind::OutOfReach { .. });
            is_open || failure.kind.rejects_values()
        })
    }

    /// Assembles the mechanism at the time `t` (s) from the pose and in the modes of the design configuration.
    ///
    /// # Errors
    /// The mechanism cannot be assembled.
    pub(crate) fn assembled_as_drawn(&self, t: f64) -> Result<Shell<Interpreted>, Failure> {
        let parameters = self.nominal_parameters();
        Shell::assemble(
            self.clone(),
            &parameters,
            &self.drawn_pose(&parameters),
            self.drawn_branches(),
            t,
            &self.input_laws().at(t),
            Default::default(),
        )
    }

    fn of(solved: Solved) -> Interpreted {
        let compiled = Compiled::new(solved);
        let path = compiled.path.as_ref();
        Interpreted {
            points: Points::new(&compiled),
            loads: LoadReader::new(&compiled),
            derivatives: of_program(compiled.solved.program(), &compiled.layout),
            reported: reported::of_program(
                compiled.solved.program(),
                compiled.solved.system(),
                &compiled.layout,
            ),
            emitted: None,
            registers: RefCell::new(compiled.code.registers().to_vec()),
            path_registers: RefCell::new(
                path.map_or_else(Default::default, InterpretedPath::registers),
            ),
            compiled: Arc::new(compiled),
            limited: None,
            residuals: Cell::new(0),
            solves: Cell::new(0),
        }
    }

    /// Plan of the solution.
    #[doc(hidden)]
    pub fn plan(&self) -> &SolvedPlan {
        self.compiled.solved.plan()
    }

    /// Functions that are run.
    #[doc(hidden)]
    pub fn program(&self) -> &Program {
        self.compiled.solved.program()
    }

    /// Returns the measures of all subsystems that can be singular.
    pub(crate) fn measured(&self) -> Measures {
        let solved = &self.compiled.solved;
        let mut draft = solved.pool().draft();
        let (system, plan, program) = (solved.system(), solved.plan(), solved.program());
        let (parts, values) = measured(&mut draft, system, plan, program);
        let reader = Reader::new(&draft.graph, &self.compiled.layout, &values);
        Measures::new(parts, reader)
    }

    pub(crate) fn compiled(&self) -> &Compiled {
        &self.compiled
    }

    /// Returns the state before the first block, with the design configuration as the last instant, nominal parameters, and the inputs of
    /// their laws.
    pub(crate) fn before_assembly(&self, t: f64) -> State {
        let parameters = self.nominal_parameters();
        let drawn = self.drawn_pose(&parameters);
        self.before(&drawn, t, &self.input_laws().at(t))
    }

    /// Returns the state before the first block, with a pose as the last instant, and nominal parameters.
    pub(crate) fn before(&self, pose: &Pose, t: f64, inputs: &InputSignals) -> State {
        let parameters = self.nominal_parameters();
        let last = self.estimate(pose, &parameters, t);
        let mut registers = self.compiled.code.registers().to_vec();
        let compiled = &self.compiled;
        compiled.fill(&last, t, &parameters, inputs, |register, value| {
            registers[register.index()] = value;
        });
        State { t, registers }
    }

    /// Returns the solved instant.
    pub(crate) fn instant(&self, state: &State) -> Instant {
        let mut instant = self.compiled.layout.empty();
        let take = |it: Register| state.registers[it.index()];
        self.compiled.keep(state.t, &mut instant, take);
        instant
    }

    /// Solves a block in these modes from the last instant.
    pub(crate) fn solve_block(
        &self,
        index: usize,
        state: &mut State,
        start: Start,
        modes: &mut Modes,
    ) -> Result<(), Failure> {
        let State { t, registers } = state;
        self.compiled.set_signs(modes, |register, value| {
            registers[register.index()] = value;
        });
        self.run_block(index, registers, *t, start, modes, &Default::default())
    }
}

/// Returns the motion with everything that `output` would omit.
fn in_full(derived: &Derived) -> Derived {
    Derived {
        pool: derived.pool.clone(),
        system: derived.system.in_full(),
    }
}
