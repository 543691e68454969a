//! *A [`System`]* → *its blocks, solved without a compile step*.
//!
//! [`Interpreted`] runs the statements that generated code is made of, block by block, and is held by a [`Shell`] as
//! generated code is: the same modes, the same path, the same failures in the same words. Nothing is left out: instants hold
//! every coordinate, and every other unknown of the vector form, with rates and accelerations.

mod blocks;
mod compiled;
mod loads;
mod run;
mod view;

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use linkwright::{Blocks, Failure, FailureKind, Shell, Start};
use linkwright_codegen::diagnostic::internal::work_at;
use linkwright_codegen::diagnostic::{Code, Diagnostics};
use linkwright_codegen::findings;
use linkwright_codegen::stages::program::{Program, lower_with_unknowns};
use linkwright_codegen::stages::structure::{self, SolvedPlan};
use linkwright_codegen::stages::system::System;

use crate::derivatives::{Derivative, of_program};
use crate::forces;
use crate::instant::Instant;
use crate::measures::measured;
use crate::path::InterpretedPath;
use crate::reader::{Formulas, Reader};
use crate::supplied::{InputSignals, Modes, Pose};
use crate::view::View;
use compiled::Compiled;
use loads::LoadReader;

/// A mechanism that is solved block by block, in SI units: m, rad, s.
#[derive(Clone, Debug)]
pub struct Interpreted {
    compiled: Arc<Compiled>,
    registers: RefCell<Vec<f64>>,
    path_registers: RefCell<[Vec<f64>; 2]>,
    points: Reader,
    /// What a failure is ascribed to a load by; `None` if no load may become infinite.
    loads: Option<LoadReader>,
    derivatives: Vec<Derivative>,
    /// Where instants keep the forces that are asked for.
    forces: Vec<Option<usize>>,
    residuals: Cell<u64>,
    solves: Cell<u64>,
}

/// The values of all registers while blocks are solved one after another.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub t: f64,
    pub registers: Vec<f64>,
}

impl Interpreted {
    /// The blocks of a system; `None` where its equations do not determine the motion.
    pub fn new(system: &System) -> Option<Interpreted> {
        let mut system = system.in_full();
        let plan = structure::plan(&mut system)?;
        let program = lower_with_unknowns(&mut system, &plan);
        Some(Interpreted::of(system, plan, program))
    }

    /// The same with warnings about what solves the system.
    ///
    /// # Errors
    /// Numbers in the blocks that become infinite or undefined, and work beyond its bounds.
    pub fn checked(system: &System) -> Result<(Option<Interpreted>, Diagnostics), Diagnostics> {
        let _work = work_at(system.mechanism.place());
        let mut system = system.in_full();
        let Some(plan) = structure::plan(&mut system) else {
            return Ok((None, findings(&system, None)?));
        };
        let program = lower_with_unknowns(&mut system, &plan);
        match findings(&system, Some(&program)) {
            Ok(warnings) => Ok((Some(Interpreted::of(system, plan, program)), warnings)),
            Err(found) => {
                let is_of_values = found.iter().all(|it| it.code == Code::NotFinite)
                    && !system.mechanism.parameters.is_empty();
                let interpreted = is_of_values.then(|| Interpreted::of(system, plan, program));
                // Where a length is refused or out of reach, that says more than a number that follows from it.
                match interpreted.filter(Interpreted::is_refused_as_drawn) {
                    Some(interpreted) => Ok((Some(interpreted), Diagnostics::new())),
                    None => Err(found),
                }
            }
        }
    }

    /// True if the values of parameters and inputs at t = 0 are refused, or leave a loop open.
    fn is_refused_as_drawn(&self) -> bool {
        self.assembled_as_drawn(0.0).is_err_and(|failure| {
            matches!(
                failure.kind,
                FailureKind::NotPositive { .. } | FailureKind::OutOfReach { .. }
            )
        })
    }

    /// Assembles the mechanism at the time `t` (s) from the pose and in the modes of the drawing.
    ///
    /// # Errors
    /// It cannot be assembled there.
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

    fn of(mut system: System, plan: SolvedPlan, program: Program) -> Interpreted {
        let measured = measured(&mut system, &plan, &program);
        let compiled = Compiled::new(system, plan, program, measured);
        let Compiled {
            system,
            program,
            layout,
            ..
        } = &compiled;
        let points = Formulas::new(&program.points, system, program, layout);
        let path = compiled.path.as_ref();
        Interpreted {
            points: Reader::of(points),
            loads: LoadReader::new(&compiled),
            derivatives: of_program(&compiled.program, &compiled.layout),
            forces: forces::of_program(&compiled.program, &compiled.layout),
            registers: RefCell::new(compiled.code.registers().to_vec()),
            path_registers: RefCell::new(
                path.map_or_else(Default::default, InterpretedPath::registers),
            ),
            compiled: Arc::new(compiled),
            residuals: Cell::new(0),
            solves: Cell::new(0),
        }
    }

    /// The plan that is followed.
    pub fn plan(&self) -> &SolvedPlan {
        &self.compiled.plan
    }

    /// The functions that are run.
    pub fn program(&self) -> &Program {
        &self.compiled.program
    }

    pub(crate) fn compiled(&self) -> &Compiled {
        &self.compiled
    }

    /// Before the first block, with the drawing as the last instant, nominal parameters, and the inputs that their laws give.
    pub(crate) fn before_assembly(&self, t: f64) -> State {
        let parameters = self.nominal_parameters();
        let drawn = self.drawn_pose(&parameters);
        self.before(&drawn, t, &self.input_laws().at(t))
    }

    /// Before the first block, with a pose as the last instant, and nominal parameters.
    pub(crate) fn before(&self, pose: &Pose, t: f64, inputs: &InputSignals) -> State {
        let parameters = self.nominal_parameters();
        let last = self.estimate(pose, &parameters, t);
        let mut registers = self.compiled.code.registers().to_vec();
        let compiled = &self.compiled;
        compiled.fill(&mut registers, &last, t, &parameters, inputs);
        State { t, registers }
    }

    /// The instant that was found.
    pub(crate) fn instant(&self, state: &State) -> Instant {
        let mut instant = self.compiled.layout.empty();
        self.compiled.keep(&state.registers, state.t, &mut instant);
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
        self.compiled.set_signs(registers, modes);
        self.run_block(index, registers, *t, start, modes, &Default::default())
    }
}
