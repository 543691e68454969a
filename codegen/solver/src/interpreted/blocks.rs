//! Implements the blocks of a [`Shell`](linkwright::Shell) as a generated module does: modes, estimates, the next frame from the last,
//! names for failures.

use linkwright::generated::{
    Conditions, Pair, PathEnclosure, TimeWindow, failed, first_not_positive,
};
use linkwright::{
    BlockName, Blocks, Branch, Failure, FailureKind, PointMotion, ValueRange, Values,
};
use linkwright_codegen::stages::emit::derivation::BlockWords;
use linkwright_codegen::stages::expr::Register;

use super::Interpreted;
use super::compiled::Compiled;
use super::path::InterpretedPath;
use crate::instant::Instant;
use crate::supplied::{InputSignals, Modes, Numbers, ParameterValues, Pose};
use crate::view::View;

impl Blocks for Interpreted {
    type Scalar = f64;
    type Frame = Instant;
    type Coordinates = Pose;
    type Branches = Modes;
    type Parameters = ParameterValues;
    type Inputs = InputSignals;
    type PathEnclosures = Vec<PathEnclosure>;

    fn is_guarded(&self) -> bool {
        self.compiled.path.is_some()
    }

    fn enclosures(&self) -> Vec<PathEnclosure> {
        let count = self
            .compiled
            .path
            .as_ref()
            .map_or(0, InterpretedPath::enclosure_count);
        Vec::with_capacity(count)
    }

    fn verify_path(
        &self,
        pair: &Pair<'_, Interpreted>,
        window: &TimeWindow,
        enclosures: &mut Vec<PathEnclosure>,
    ) -> Result<(), u16> {
        let path = self.compiled.path.as_ref();
        let [registers, _] = &mut *self.path_registers.borrow_mut();
        path.map_or(Ok(()), |path| {
            path.keep(pair, window, enclosures, registers)
        })
    }

    fn is_closed(&self) -> bool {
        let path = self.compiled.path.as_ref();
        path.is_some_and(InterpretedPath::is_closed)
    }

    fn verify_nonsingular(
        &self,
        pair: &Pair<'_, Interpreted>,
        window: &TimeWindow,
    ) -> Result<(), u16> {
        let path = self.compiled.path.as_ref();
        let [_, registers] = &mut *self.path_registers.borrow_mut();
        path.map_or(Err(0), |path| path.stay(pair, window, registers))
    }

    fn is_within(&self, at: &Instant, enclosures: &Vec<PathEnclosure>, steps: f64) -> bool {
        let path = self.compiled.path.as_ref();
        path.is_none_or(|path| path.are_within(at, enclosures, steps))
    }

    fn nominal_parameters(&self) -> ParameterValues {
        Numbers::nominal_parameters(self.pool(), self.system())
    }

    fn initial_inputs(&self) -> InputSignals {
        InputSignals::initial(self.pool(), self.system())
    }

    fn drawn_branches(&self) -> Modes {
        let drawn = |positive| {
            if positive {
                Branch::Positive
            } else {
                Branch::Negative
            }
        };
        let newtons = self.compiled.solved.program().blocks.iter();
        let newtons = newtons.filter_map(|block| block.newton.as_ref());
        Modes {
            closed: self
                .compiled
                .solved
                .program()
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
        match (&block.newton, block.exchanged) {
            (Some(_), _) => {
                let mode = modes.iterated.get_mut(block.iterated)?;
                *mode = Some((*mode)?.opposite());
            }
            (None, Some(place)) => modes.closed[place] = modes.closed[place].opposite(),
            _ => return None,
        }
        Some(modes)
    }

    fn may_cross(&self) -> bool {
        let mut blocks = self.compiled.blocks.iter();
        blocks.any(|block| block.newton.is_some() || block.exchanged.is_some())
    }

    fn drawn_pose(&self, parameters: &ParameterValues) -> Pose {
        let mut drawn = self.compiled.drawn(parameters);
        drawn.truncate(self.system().coordinates.len());
        Numbers(drawn)
    }

    fn estimate(&self, pose: &Pose, parameters: &ParameterValues, t: f64) -> Instant {
        let Compiled { solved, layout, .. } = &*self.compiled;
        let mut instant = layout.empty();
        let drawn = self.compiled.drawn(parameters);
        let unknowns = solved.system().vector_form.unknowns.iter().zip(drawn);
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

    fn set_time(frame: &mut Instant, t: f64) {
        frame.values_mut()[0] = t;
    }

    fn add(&self, sum: &mut Instant, multiple: f64, frame: &Instant, base: &Instant) {
        sum.add(multiple, frame, base);
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
        let mut put = |register: Register, value| registers[register.index()] = value;
        self.compiled.fill(last, t, parameters, inputs, &mut put);
        self.compiled.set_signs(modes, put);
        let mut blocks = 0..self.compiled.blocks.len();
        let solved =
            blocks.try_for_each(|it| self.run_block(it, registers, t, start, modes, settings));
        self.compiled.keep(t, at, |it| registers[it.index()]);
        let failure = match solved {
            Err(failure) => failure,
            Ok(()) if at.values().iter().all(|value| value.is_finite()) => return Ok(()),
            Ok(()) => failed(FailureKind::NotFinite, t, 0),
        };
        let loads = self
            .loads
            .as_ref()
            .filter(|_| failure.kind == FailureKind::NotFinite);
        Err(loads.map_or(failure, |loads| loads.blame(failure, at)))
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

    fn parameter_range(&self, index: usize) -> Option<ValueRange<'_>> {
        self.compiled.ranges.parameter(index)
    }

    fn input_range(&self, index: usize) -> Option<ValueRange<'_>> {
        self.compiled.ranges.input(index)
    }

    fn coordinate(&self, frame: &Instant, index: usize) -> Option<[f64; 3]> {
        frame.coordinate(index)
    }

    fn is_iterated(&self) -> bool {
        let mut blocks = self.compiled.solved.program().blocks.iter();
        blocks.any(|block| block.newton.is_some())
    }

    fn holds_coordinates(&self) -> bool {
        self.compiled.layout.holds_coordinates(self.system())
    }

    fn point_name(&self, index: usize) -> Option<&str> {
        self.points.names().get(index).map(String::as_str)
    }

    fn point(&self, frame: &Instant, index: usize) -> Option<PointMotion<f64>> {
        self.points.all(frame).get(index).copied()
    }

    fn not_positive(&self, parameters: &ParameterValues) -> Option<(u16, f64)> {
        let required = self.compiled.required.as_ref()?;
        first_not_positive(&self.compiled.of_parameters(required, parameters))
    }

    fn requirement_name(&self, index: usize) -> Option<BlockName<'_>> {
        let requirements = self.compiled.solved.program().requirements.as_ref()?;
        let (name, singular) = requirements.names.get(index)?;
        Some(BlockName { name, singular })
    }

    fn load_name(&self, index: usize) -> Option<&str> {
        let loads = self.compiled.solved.program().loads.as_ref()?;
        loads.labels.get(index).map(String::as_str)
    }

    fn block_name(&self, index: usize) -> Option<BlockName<'_>> {
        let BlockWords { name, singular } = self.compiled.words.get(index)?;
        Some(BlockName { name, singular })
    }
}
