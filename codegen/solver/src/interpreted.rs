//! *A [`System`]* → *its blocks, solved without a compile step*.
//!
//! [`Interpreted`] runs the statements that generated code is made of, block by block, and is held by a [`Shell`](linkwright::Shell) as
//! generated code is: the same modes, the same path, the same failures in the same words. Nothing is left out: instants hold
//! every coordinate, and every other unknown of the vector form, with rates and accelerations.

use std::cell::{Cell, RefCell};
use std::collections::HashSet;
use std::sync::Arc;

use linkwright::blocks::first_not_positive;
use linkwright::closed_form::failed;
use linkwright::{
    BlockName, Blocks, Branch, Conditions, Failure, FailureKind, Frame, Measure, Pair, PointMotion,
    Span, Start, Tube, Values, block, kinematics,
};
use linkwright_codegen::diagnostic::Diagnostics;
use linkwright_codegen::findings;
use linkwright_codegen::stages::emit::Notation;
use linkwright_codegen::stages::emit::derivation::{
    BlockWords, Script, SingularPose, block_words, singular_poses,
};
use linkwright_codegen::stages::expr::{Code, ExprId, Recorder, Register, SymbolId, Tape};
use linkwright_codegen::stages::program::{Program, Statement, lower_with_unknowns};
use linkwright_codegen::stages::structure::{self, SolvedPlan};
use linkwright_codegen::stages::system::System;

use crate::assemblies::assemblies;
use crate::derivatives::{Derivative, of_program};
use crate::forces;
use crate::instant::{Instant, Layout};
use crate::measures::{MeasuredPart, Measures, measured};
use crate::newton::Newton;
use crate::number::time;
use crate::operation::{Operation, Writer, run};
use crate::path::InterpretedPath;
use crate::reader::Reader;
use crate::supplied::{InputSignals, ModeName, Modes, Numbers, ParameterValues, Pose};
use crate::view::View;

/// A mechanism that is solved block by block, in SI units: m, rad, s.
#[derive(Clone, Debug)]
pub struct Interpreted {
    compiled: Arc<Compiled>,
    registers: RefCell<Vec<f64>>,
    path_registers: RefCell<[Vec<f64>; 2]>,
    points: Reader,
    derivatives: Vec<Derivative>,
    /// Where instants keep the forces that are asked for.
    forces: Vec<Option<usize>>,
    residuals: Cell<u64>,
    solves: Cell<u64>,
}

/// What is the same for all instants.
#[derive(Debug)]
pub(crate) struct Compiled {
    pub system: System,
    pub plan: SolvedPlan,
    pub program: Program,
    pub poses: Vec<SingularPose>,
    /// What can be singular, and what its measures are made of.
    pub measured: (Vec<MeasuredPart>, Vec<ExprId>),
    pub layout: Layout,
    pub code: Code,
    pub blocks: Vec<InterpretedBlock>,
    words: Vec<BlockWords>,
    time: Register,
    given: Vec<Register>,
    /// The registers of all assembly modes of closed forms.
    signs: Vec<Register>,
    /// What is read of the last instant: the place there.
    last: Vec<(Register, usize)>,
    /// What instants keep, from the first place after what was given.
    kept: Vec<Register>,
    /// The estimates of all unknowns of the vector form, by symbol of parameters.
    drawn: Tape,
    /// What parameters must leave positive.
    required: Option<Tape>,
    /// What shows that blocks keep to their path, where somebody wants to know.
    path: Option<InterpretedPath>,
}

/// A block as operations.
#[derive(Debug)]
pub(crate) struct InterpretedBlock {
    pub operations: Vec<Operation>,
    pub newton: Option<Newton>,
    /// The places in [`Modes::closed`] of its signs.
    pub closed: Vec<usize>,
    /// Its place in [`Modes::iterated`], where it has a Newton-Raphson.
    pub iterated: usize,
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
        let mut system = everything(system);
        let plan = structure::plan(&mut system)?;
        let program = lower_with_unknowns(&mut system, &plan);
        Some(Interpreted::of(system, plan, program))
    }

    /// The same with warnings about what solves the system.
    ///
    /// # Errors
    /// Numbers in the blocks that become infinite or undefined, and work beyond its bounds.
    pub fn checked(system: &System) -> Result<(Option<Interpreted>, Diagnostics), Diagnostics> {
        let mut system = everything(system);
        let Some(plan) = structure::plan(&mut system) else {
            return Ok((None, findings(&system, None)?));
        };
        let program = lower_with_unknowns(&mut system, &plan);
        let warnings = findings(&system, Some(&program))?;
        Ok((Some(Interpreted::of(system, plan, program)), warnings))
    }

    fn of(mut system: System, plan: SolvedPlan, program: Program) -> Interpreted {
        let measured = measured(&mut system, &plan, &program);
        let compiled = Compiled::new(system, plan, program, measured);
        let points: Vec<ExprId> = compiled
            .system
            .outputs
            .iter()
            .flat_map(|it| [it.position, it.velocity, it.acceleration])
            .flatten()
            .collect();
        let graph = &compiled.system.mechanism.graph;
        let path = compiled.path.as_ref();
        Interpreted {
            points: Reader::new(graph, &compiled.layout, &points),
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

    #[inline]
    fn run_block(
        &self,
        index: usize,
        registers: &mut [f64],
        t: f64,
        start: Start,
        modes: &mut Modes,
        settings: &linkwright::Settings,
    ) -> Result<(), Failure> {
        let Compiled { code, blocks, .. } = &*self.compiled;
        let block = &blocks[index];
        let number = u16::try_from(index).unwrap_or(u16::MAX);
        let mut factorization = None;
        for operation in &block.operations {
            match (operation, &block.newton) {
                (Operation::Newton, Some(newton)) => {
                    let mode = &mut modes.iterated[block.iterated];
                    let measure = self
                        .iterate(newton, registers, t, start, mode, settings)
                        .map_err(|failure| failure.in_block(number))?;
                    if let Some(both) = newton.measure {
                        registers[both[0].index()] = measure.determinant;
                        registers[both[1].index()] = measure.reciprocal_condition;
                    }
                }
                (Operation::Factorize, Some(newton)) => {
                    let tears = newton.pose(registers);
                    let equations = newton.at(code, registers, &|| ());
                    let found = kinematics::factorize(&equations, &tears, t, settings);
                    factorization = Some(found.map_err(|failure| failure.in_block(number))?);
                }
                (
                    Operation::Solve {
                        targets,
                        right_hand_side,
                    },
                    _,
                ) => {
                    let rows = right_hand_side.iter().map(|it| registers[it.index()]);
                    let mut solution =
                        nalgebra::DVector::from_iterator(right_hand_side.len(), rows);
                    if let Some(factorization) = &factorization {
                        factorization.solve(&mut solution);
                    }
                    for (target, value) in targets.iter().zip(solution.iter()) {
                        if let Some(target) = target {
                            registers[target.index()] = *value;
                        }
                    }
                }
                _ => run(operation, code, registers, t, number)?,
            }
        }
        Ok(())
    }

    fn iterate(
        &self,
        newton: &Newton,
        registers: &mut [f64],
        t: f64,
        start: Start,
        mode: &mut Option<Branch>,
        settings: &linkwright::Settings,
    ) -> Result<Measure<f64>, Failure> {
        let last = newton.last_frame(registers, last_time(registers, &self.compiled));
        let count = || self.residuals.set(self.residuals.get() + 1);
        self.solves.set(self.solves.get() + 1);
        let equations = newton.at(&self.compiled.code, registers, &count);
        if let Some(tearing) = &newton.tearing {
            tearing.solve(&equations, &last, start, mode, t, settings)?;
            return Ok(Measure::sine(0.0));
        }
        let mut measure = Measure::sine(0.0);
        let found: Frame<f64, nalgebra::Dyn> = match newton.measure {
            None => block::solve(&equations, &last, start, mode, t, settings)?,
            Some(_) => {
                block::solve_measured(&equations, &last, start, mode, t, settings, &mut measure)?
            }
        };
        equations.set(&found);
        Ok(measure)
    }
}

/// A system of which nothing is left out.
fn everything(system: &System) -> System {
    let mut system = system.clone();
    // What is asked for would leave other things out.
    system.mechanism.requests.clear();
    system.mechanism.monitor = false;
    system
}

/// The time of the last instant, which Newton-Raphson goes on from.
fn last_time(registers: &[f64], compiled: &Compiled) -> f64 {
    // The first of what is read of the last instant.
    compiled
        .last
        .first()
        .map_or(0.0, |(register, _)| registers[register.index()])
}

impl Compiled {
    fn new(
        system: System,
        plan: SolvedPlan,
        program: Program,
        measured: (Vec<MeasuredPart>, Vec<ExprId>),
    ) -> Compiled {
        let poses =
            |notation| singular_poses(&system, &plan, &program.forms, Script::Text(notation));
        let words = block_words(&program.blocks, &system, &plan, &poses(Notation::Unicode));
        let poses = poses(Notation::Ascii);
        let layout = Layout::new(&system, &program.fields);
        let graph = &system.mechanism.graph;
        let mut recorder = Recorder::new(graph);
        let mut bound = |symbol| {
            let register = recorder.register();
            recorder.bind(symbol, register);
            register
        };
        let time = bound(system.mechanism.time);
        let given = layout.symbols()[layout.given()]
            .iter()
            .map(|&it| bound(it))
            .collect();
        let signs = program.branches.iter().map(|it| bound(it.symbol)).collect();
        let mut writer = Writer::new(recorder);
        writer.last(system.mechanism.time);
        let mut signs_left: Vec<usize> = (0..program.branches.len()).collect();
        let mut blocks: Vec<InterpretedBlock> = Vec::with_capacity(program.blocks.len());
        for block in &program.blocks {
            let read = block
                .function
                .values()
                .flat_map(|value| graph.symbols(value));
            let read: HashSet<SymbolId> = read.copied().collect();
            let is_own = |place: &usize| read.contains(&program.branches[*place].symbol);
            let (closed, others) = signs_left.into_iter().partition(is_own);
            signs_left = others;
            let mut newton = None;
            for statement in &block.function.statements {
                if let Statement::Newton { .. } = statement {
                    newton = Newton::new(block, &system, &mut writer);
                }
                writer.statement(statement);
            }
            blocks.push(InterpretedBlock {
                operations: writer.take(),
                iterated: blocks.iter().filter(|it| it.newton.is_some()).count(),
                newton,
                closed,
            });
        }
        let kept = layout.symbols()[layout.solved()].iter();
        let kept = kept.map(|&symbol| writer.recorder.symbol(symbol)).collect();
        let (code, last) = writer.finish();
        let last = last
            .into_iter()
            .filter_map(|(symbol, register)| Some((register, layout.slot(symbol)?)));
        let last = last.collect();
        let unknowns = system.vector_form.unknowns.iter();
        let drawn = Tape::new(graph, &unknowns.map(|it| it.estimate).collect::<Vec<_>>());
        let required = program.requirements.as_ref().map(|requirements| {
            let values = requirements.function.results.iter().map(|it| it.expr);
            Tape::new(graph, &values.collect::<Vec<_>>())
        });
        Compiled {
            required,
            path: InterpretedPath::new(&system, &program, &layout),
            last,
            drawn,
            measured,
            words,
            poses,
            layout,
            code,
            blocks,
            time,
            given,
            signs,
            kept,
            plan,
            program,
            system,
        }
    }

    fn fill(
        &self,
        registers: &mut [f64],
        last: &Instant,
        t: f64,
        parameters: &ParameterValues,
        inputs: &InputSignals,
    ) {
        for &(register, slot) in &self.last {
            registers[register.index()] = last.values()[slot];
        }
        registers[self.time.index()] = t;
        let signals = inputs
            .0
            .iter()
            .flat_map(|it| [it.value, it.rate, it.acceleration]);
        let given = parameters.0.iter().copied().chain(signals);
        for (register, value) in self.given.iter().zip(given) {
            registers[register.index()] = value;
        }
    }

    fn set_signs(&self, registers: &mut [f64], modes: &Modes) {
        for (register, branch) in self.signs.iter().zip(&modes.closed) {
            registers[register.index()] = branch.sign();
        }
    }

    fn keep(&self, registers: &[f64], t: f64, at: &mut Instant) {
        let values = at.values_mut();
        values[0] = t;
        for (value, register) in values[1..]
            .iter_mut()
            .zip(self.given.iter().chain(&self.kept))
        {
            *value = registers[register.index()];
        }
    }

    fn drawn(&self, parameters: &ParameterValues) -> Vec<f64> {
        self.of_parameters(&self.drawn, parameters)
    }

    /// The values of expressions of the parameters.
    fn of_parameters(&self, tape: &Tape, parameters: &ParameterValues) -> Vec<f64> {
        let mechanism = &self.system.mechanism;
        let mut symbols = vec![0.0; mechanism.graph.symbol_count()];
        for (own, value) in mechanism.parameters.iter().zip(&parameters.0) {
            symbols[own.symbol.index()] = *value;
        }
        let mut values = vec![0.0; tape.result_count()];
        tape.evaluate(&symbols, &mut Vec::new(), &mut values);
        values
    }
}

impl Blocks for Interpreted {
    type Scalar = f64;
    type Frame = Instant;
    type Coordinates = Pose;
    type Branches = Modes;
    type Parameters = ParameterValues;
    type Inputs = InputSignals;
    type Tubes = Vec<Tube>;

    fn is_guarded(&self) -> bool {
        self.compiled.path.is_some()
    }

    fn tubes(&self) -> Vec<Tube> {
        let count = self
            .compiled
            .path
            .as_ref()
            .map_or(0, InterpretedPath::tube_count);
        Vec::with_capacity(count)
    }

    fn keeps_to_path(
        &self,
        pair: &Pair<'_, Interpreted>,
        span: &Span,
        tubes: &mut Vec<Tube>,
    ) -> Result<(), u16> {
        let path = self.compiled.path.as_ref();
        let [registers, _] = &mut *self.path_registers.borrow_mut();
        path.map_or(Ok(()), |path| path.keep(pair, span, tubes, registers))
    }

    fn is_closed(&self) -> bool {
        let path = self.compiled.path.as_ref();
        path.is_some_and(InterpretedPath::is_closed)
    }

    fn stays_regular(&self, pair: &Pair<'_, Interpreted>, span: &Span) -> Result<(), u16> {
        let path = self.compiled.path.as_ref();
        let [_, registers] = &mut *self.path_registers.borrow_mut();
        path.map_or(Ok(()), |path| path.stay(pair, span, registers))
    }

    fn is_within(&self, at: &Instant, tubes: &Vec<Tube>, steps: f64) -> bool {
        let path = self.compiled.path.as_ref();
        path.is_none_or(|path| path.are_within(at, tubes, steps))
    }

    fn nominal_parameters(&self) -> ParameterValues {
        Numbers::nominal_parameters(self.system())
    }

    fn initial_inputs(&self) -> InputSignals {
        InputSignals::initial(self.system())
    }

    fn drawn_branches(&self) -> Modes {
        let drawn = |positive| {
            if positive {
                Branch::Positive
            } else {
                Branch::Negative
            }
        };
        let newtons = self.compiled.program.blocks.iter();
        let newtons = newtons.filter_map(|block| block.newton.as_ref());
        Modes {
            closed: self
                .compiled
                .program
                .branches
                .iter()
                .map(|it| drawn(it.is_positive()))
                .collect(),
            iterated: newtons
                .map(|newton| newton.drawn.sign().map(drawn))
                .collect(),
        }
    }

    fn exchanged(&self, modes: &Modes, block: u16) -> Option<Modes> {
        let block = self.compiled.blocks.get(usize::from(block))?;
        let mut modes = modes.clone();
        match (&block.newton, &block.closed[..]) {
            (Some(_), _) => {
                let mode = modes.iterated.get_mut(block.iterated)?;
                *mode = Some((*mode)?.opposite());
            }
            (None, &[place]) => modes.closed[place] = modes.closed[place].opposite(),
            _ => return None,
        }
        Some(modes)
    }

    fn drawn_pose(&self, parameters: &ParameterValues) -> Pose {
        let mut drawn = self.compiled.drawn(parameters);
        drawn.truncate(self.system().coordinates.len());
        Numbers(drawn)
    }

    fn estimate(&self, pose: &Pose, parameters: &ParameterValues, t: f64) -> Instant {
        let Compiled { system, layout, .. } = &*self.compiled;
        let mut instant = layout.empty();
        let drawn = self.compiled.drawn(parameters);
        let unknowns = system.vector_form.unknowns.iter().zip(drawn);
        let values = instant.values_mut();
        values[0] = t;
        values[1..=parameters.0.len()].copy_from_slice(&parameters.0);
        for (place, (unknown, drawn)) in unknowns.enumerate() {
            if let Some(slot) = layout.slot(unknown.position) {
                values[slot] = pose.value(place).unwrap_or(drawn);
            }
        }
        instant
    }

    fn time(frame: &Instant) -> f64 {
        frame.t()
    }

    fn solve(
        &self,
        at: &mut Instant,
        last: &Instant,
        modes: &mut Modes,
        conditions: &Conditions<'_, f64, ParameterValues, InputSignals>,
    ) -> Result<(), Failure> {
        let registers = &mut *self.registers.borrow_mut();
        let Conditions {
            t,
            start,
            parameters,
            inputs,
            settings,
        } = *conditions;
        self.compiled.fill(registers, last, t, parameters, inputs);
        self.compiled.set_signs(registers, modes);
        for index in 0..self.compiled.blocks.len() {
            self.run_block(index, registers, t, start, modes, settings)?;
        }
        self.compiled.keep(registers, t, at);
        if at.values().iter().all(|value| value.is_finite()) {
            Ok(())
        } else {
            Err(failed(FailureKind::NotFinite, t, 0))
        }
    }

    fn name(&self) -> &str {
        &self.system().mechanism.name
    }

    fn coordinate_name(&self, index: usize) -> Option<&str> {
        self.system()
            .coordinates
            .get(index)
            .map(|it| it.name.as_str())
    }

    fn parameter_name(&self, index: usize) -> Option<&str> {
        let parameters = &self.system().mechanism.parameters;
        parameters.get(index).map(|it| it.name.as_str())
    }

    fn input_name(&self, index: usize) -> Option<&str> {
        let inputs = &self.system().mechanism.inputs;
        inputs.get(index).map(|it| it.name.as_str())
    }

    fn coordinate(&self, frame: &Instant, index: usize) -> Option<[f64; 3]> {
        frame.coordinate(index)
    }

    fn point_name(&self, index: usize) -> Option<&str> {
        self.system().outputs.get(index).map(|it| it.name.as_str())
    }

    fn point(&self, frame: &Instant, index: usize) -> Option<PointMotion<f64>> {
        self.points(frame).get(index).copied()
    }

    fn not_positive(&self, parameters: &ParameterValues) -> Option<(u16, f64)> {
        let required = self.compiled.required.as_ref()?;
        first_not_positive(&self.compiled.of_parameters(required, parameters))
    }

    fn requirement_name(&self, index: usize) -> Option<BlockName<'_>> {
        let requirements = self.compiled.program.requirements.as_ref()?;
        let (name, singular) = requirements.names.get(index)?;
        Some(BlockName { name, singular })
    }

    fn block_name(&self, index: usize) -> Option<BlockName<'_>> {
        let BlockWords { name, singular } = self.compiled.words.get(index)?;
        Some(BlockName { name, singular })
    }
}

impl View for Interpreted {
    fn system(&self) -> &System {
        &self.compiled.system
    }

    fn layout(&self) -> &Layout {
        &self.compiled.layout
    }

    fn mode_names(&self) -> Vec<ModeName> {
        let program = &self.compiled.program;
        let closed = program
            .branches
            .iter()
            .enumerate()
            .map(|(place, branch)| ModeName {
                name: branch.name.clone(),
                place,
                is_closed: true,
            });
        let iterated = program.blocks.iter().filter(|block| block.newton.is_some());
        let iterated = iterated.enumerate().map(|(place, block)| ModeName {
            name: block.name.clone(),
            place,
            is_closed: false,
        });
        closed.chain(iterated).collect()
    }

    fn newton_steps(&self) -> [u64; 2] {
        let solves = self.solves.get();
        [self.residuals.get().saturating_sub(solves), solves]
    }

    fn points(&self, instant: &Instant) -> Vec<PointMotion> {
        let values = self.points.values(instant);
        let motion = |it: &[f64]| PointMotion {
            position: [it[0], it[1]],
            velocity: [it[2], it[3]],
            acceleration: [it[4], it[5]],
        };
        values.chunks_exact(6).map(motion).collect()
    }

    fn derivatives(&self, instant: &Instant) -> Option<Vec<f64>> {
        let found = self.derivatives.iter();
        let value = |it: &Derivative| match *it {
            Derivative::Kept(slot) => instant.values()[slot],
            Derivative::Constant(value) => value,
        };
        Some(found.map(value).collect())
    }

    fn forces(&self, instant: &Instant) -> Option<Vec<f64>> {
        let slots = self.forces.iter();
        slots.map(|slot| Some(instant.values()[(*slot)?])).collect()
    }

    fn measures(&self) -> Option<Measures> {
        Some(Measures::new(self))
    }

    fn singular_poses(&self) -> &[SingularPose] {
        &self.compiled.poses
    }

    fn not_assembled(&self, failure: &Failure) -> String {
        let others = match assemblies(self, failure.time).found.len() {
            0 => String::new(),
            1 => "; another assembly exists (`linkwright check` shows it)".to_string(),
            count => format!("; {count} other assemblies exist (`linkwright check` lists them)"),
        };
        let (t, explained) = (time(failure.time), self.explained(failure));
        format!(
            "cannot be assembled as drawn at t = {t} s: {}{others}",
            explained.cause()
        )
    }

    fn ended(&self, failure: &Failure, _last: &Instant) -> String {
        let (t, explained) = (time(failure.time), self.explained(failure));
        format!("cannot be solved beyond t = {t} s: {}", explained.cause())
    }
}
