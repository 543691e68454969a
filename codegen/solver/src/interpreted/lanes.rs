//! Solves a frame of eight mechanisms of the same program at once.
//!
//! A lane has the bits of the scalar blocks, whatever the other lanes do. Programs with Newton-Raphson reject all lanes, which the scalar
//! blocks solve instead.

use linkwright::generated::TimeWindow;
use linkwright::lanes::{InLanes, LaneValues, Mask, ReadLanes};
use linkwright_codegen::stages::expr::Lanes;

use super::Interpreted;
use super::compiled::Compiled;
use super::path::InterpretedPath;
use crate::instant::Instant;
use crate::operation::{LANES, run_lanes};
use crate::reader::Formulas;
use crate::supplied::{InputSignals, Modes, ParameterValues};

/// Instants of eight mechanisms, with the registers that they are solved in.
#[derive(Clone, Debug)]
pub struct InstantLanes {
    /// Values in the order of instants.
    values: Vec<Lanes>,
    registers: Vec<Lanes>,
    /// Registers of the verification of paths.
    path_registers: Vec<Lanes>,
}

/// Signs of the modes of closed forms.
#[derive(Clone, Debug)]
pub struct ModeLanes(Vec<Lanes>);

/// Parameters of eight mechanisms.
#[derive(Clone, Debug)]
pub struct ParameterLanes(Vec<Lanes>);

/// Inputs of eight mechanisms: value, rate and acceleration of each.
#[derive(Clone, Debug)]
pub struct InputLanes(Vec<[Lanes; 3]>);

/// Zero in all lanes.
const ZERO: Lanes = Lanes::splat(0.0);

impl InstantLanes {
    /// Values of all lanes, in the order of instants.
    pub(crate) fn values(&self) -> &[Lanes] {
        &self.values
    }
}

impl LaneValues<Instant> for InstantLanes {
    fn set_lane(&mut self, lane: usize, instant: &Instant) {
        for (lanes, value) in self.values.iter_mut().zip(instant.values()) {
            lanes.0[lane] = *value;
        }
    }
}

impl ReadLanes<Instant> for InstantLanes {
    fn get_lane(&self, lane: usize, instant: &mut Instant) {
        for (value, lanes) in instant.values_mut().iter_mut().zip(&self.values) {
            *value = lanes.0[lane];
        }
    }
}

impl LaneValues<Modes> for ModeLanes {
    fn set_lane(&mut self, lane: usize, modes: &Modes) {
        for (lanes, mode) in self.0.iter_mut().zip(&modes.closed) {
            lanes.0[lane] = mode.sign();
        }
    }
}

impl LaneValues<ParameterValues> for ParameterLanes {
    fn set_lane(&mut self, lane: usize, parameters: &ParameterValues) {
        for (lanes, value) in self.0.iter_mut().zip(&parameters.0) {
            lanes.0[lane] = *value;
        }
    }
}

impl LaneValues<InputSignals> for InputLanes {
    fn set_lane(&mut self, lane: usize, inputs: &InputSignals) {
        for (lanes, signal) in self.0.iter_mut().zip(&inputs.0) {
            let numbers = [signal.value, signal.rate, signal.acceleration];
            for (lanes, number) in lanes.iter_mut().zip(numbers) {
                lanes.0[lane] = number;
            }
        }
    }
}

/// Data with which eight instants are solved.
type Conditions<'a> = linkwright::lanes::Conditions<'a, Lanes, ParameterLanes, InputLanes>;

impl InLanes<LANES> for Interpreted {
    type Frames = InstantLanes;
    type Signs = ModeLanes;
    type ParameterLanes = ParameterLanes;
    type InputLanes = InputLanes;

    fn lanes(&self) -> (InstantLanes, ModeLanes, ParameterLanes, InputLanes) {
        let compiled = &*self.compiled;
        let mechanism = &compiled.solved.system().mechanism;
        let instants = InstantLanes {
            values: vec![ZERO; compiled.layout.symbols().len()],
            registers: compiled.code.lanes(),
            path_registers: compiled
                .path
                .as_ref()
                .map_or(Vec::new(), InterpretedPath::lanes),
        };
        (
            instants,
            ModeLanes(vec![ZERO; compiled.signs.len()]),
            ParameterLanes(vec![ZERO; mechanism.parameters.len()]),
            InputLanes(vec![[ZERO; 3]; mechanism.inputs.len()]),
        )
    }

    #[inline(always)]
    fn solve_lanes(
        &self,
        at: &mut InstantLanes,
        last: &InstantLanes,
        signs: &ModeLanes,
        conditions: &Conditions<'_>,
    ) -> Mask<LANES> {
        solve(&self.compiled, at, last, signs, conditions)
    }

    #[inline(always)]
    fn verify_lanes(
        &self,
        at: &mut InstantLanes,
        last: &InstantLanes,
        window: &TimeWindow<Lanes>,
        _parameters: &ParameterLanes,
    ) -> Mask<LANES> {
        let pair = [&at.values[..], &last.values[..]];
        let path = self.compiled.path.as_ref();
        path.map_or(Mask::NONE, |path| {
            path.stay_in_lanes(pair, window, &mut at.path_registers)
        })
    }
}

/// Solves all blocks; returns the lanes that fail or are not finite.
#[inline(always)]
fn solve(
    compiled: &Compiled,
    at: &mut InstantLanes,
    last: &InstantLanes,
    signs: &ModeLanes,
    conditions: &Conditions<'_>,
) -> Mask<LANES> {
    if compiled.blocks.iter().any(|it| it.newton.is_some()) {
        return Mask::ALL;
    }
    let registers = &mut at.registers[..];
    for &(register, slot) in &compiled.last {
        registers[register.index()] = last.values[slot];
    }
    registers[compiled.time.index()] = conditions.t;
    let signals = conditions.inputs.0.iter().flatten();
    let supplied = conditions.parameters.0.iter().chain(signals);
    for (register, lanes) in compiled.given.iter().zip(supplied) {
        registers[register.index()] = *lanes;
    }
    for (register, sign) in compiled.signs.iter().zip(&signs.0) {
        registers[register.index()] = *sign;
    }
    let mut failed = Mask::NONE;
    for block in &compiled.blocks {
        for operation in &block.operations {
            failed |= run_lanes(operation, &compiled.code, registers);
        }
    }
    // Sums of finite products with zero are zero; others are NaN. Sums that do not wait for one another take less time.
    let mut sums = [ZERO; 4];
    let kept = [&compiled.time]
        .into_iter()
        .chain(&compiled.given)
        .chain(&compiled.kept);
    for (place, (value, register)) in at.values.iter_mut().zip(kept).enumerate() {
        *value = registers[register.index()];
        sums[place % 4] = sums[place % 4] + 0.0 * *value;
    }
    let [a, b, c, d] = sums;
    let sum = (a + b) + (c + d);
    failed | Mask::of(|lane| sum.0[lane].is_nan())
}

impl Interpreted {
    /// Returns the index in instants of a coordinate, its rate or its acceleration; `None` if instants do not hold it.
    pub(crate) fn coordinate_slot(&self, place: usize, level: usize) -> Option<usize> {
        self.compiled.layout.coordinate_slot(place, level)
    }

    /// Returns the index in instants of a component of a point; `None` if it is computed from coordinates, or not at all.
    pub(crate) fn point_slot(&self, point: usize, level: usize, axis: usize) -> Option<usize> {
        self.points.slot(point, level, axis)
    }

    /// Returns the index in instants of a requested force; `None` if the program does not compute it.
    pub(crate) fn force_slot(&self, index: usize) -> Option<usize> {
        *self.forces.get(index)?
    }

    /// Returns the code that computes all points of eight instants; `None` if instants keep them.
    pub(crate) fn point_formulas(&self) -> Option<&Formulas> {
        self.points.computed()
    }
}
