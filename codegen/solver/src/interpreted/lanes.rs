//! Solves a frame of sixteen mechanisms of the same program at once.
//!
//! A lane has the bits of the scalar blocks, whatever the other lanes do. Programs with Newton-Raphson reject all lanes, which the scalar
//! blocks solve instead.

use linkwright::generated::TimeWindow;
use linkwright::lanes::{InLanes, LaneValues, Mask, ReadLanes};
use linkwright_codegen::stages::expr::{Code, LANES, Lanes, Register};

use super::Interpreted;
use super::path::InterpretedPath;
use crate::instant::Instant;
use crate::observable::Observable;
use crate::operation::{Operation, run_lanes};
use crate::reader::Formulas;
use crate::supplied::{InputSignals, Modes, ParameterValues};

/// Instants of sixteen mechanisms, with the registers that they are solved in.
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

/// Parameters of sixteen mechanisms.
#[derive(Clone, Debug)]
pub struct ParameterLanes(Vec<Lanes>);

/// Inputs of sixteen mechanisms: value, rate and acceleration of each.
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

/// Data with which sixteen instants are solved.
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
            registers: match &self.limited {
                Some(limited) => limited.reduced.code.lanes(),
                None => compiled.code.lanes(),
            },
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
        solve(self, at, last, signs, conditions)
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
    interpreted: &Interpreted,
    at: &mut InstantLanes,
    last: &InstantLanes,
    signs: &ModeLanes,
    conditions: &Conditions<'_>,
) -> Mask<LANES> {
    let compiled = &*interpreted.compiled;
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
    match &interpreted.limited {
        Some(limited) => {
            let blocks = limited.reduced.operations.iter().map(|it| &it[..]);
            let failed = run(&limited.reduced.code, blocks, registers);
            failed | store(limited.stored.iter().copied(), &mut at.values, registers)
        }
        None => {
            let blocks = compiled.blocks.iter().map(|it| &it.operations[..]);
            let failed = run(&compiled.code, blocks, registers);
            failed | store(compiled.stored(), &mut at.values, registers)
        }
    }
}

/// Runs the operations of all blocks; returns the lanes that fail.
#[inline(always)]
fn run<'a>(
    code: &Code,
    blocks: impl Iterator<Item = &'a [Operation]>,
    registers: &mut [Lanes],
) -> Mask<LANES> {
    let mut failed = Mask::NONE;
    for operation in blocks.flatten() {
        failed |= run_lanes(operation, code, registers);
    }
    failed
}

/// Writes registers into the slots of instants; returns the lanes that are not finite.
#[inline(always)]
fn store(
    stored: impl Iterator<Item = (usize, Register)>,
    values: &mut [Lanes],
    registers: &[Lanes],
) -> Mask<LANES> {
    // Sums of finite products with zero are zero; others are NaN. Sums that do not wait for one another take less time.
    let mut sums = [ZERO; 4];
    for (place, (slot, register)) in stored.enumerate() {
        let value = registers[register.index()];
        values[slot] = value;
        sums[place % 4] = sums[place % 4] + 0.0 * value;
    }
    let [a, b, c, d] = sums;
    let sum = (a + b) + (c + d);
    Mask::of(|lane| sum.0[lane].is_nan())
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

    /// Returns the index in instants of a requested force or measure; `None` if the program does not compute it.
    pub(crate) fn reported_slot(&self, index: usize) -> Option<usize> {
        *self.reported.get(index)?
    }

    /// Returns the code that computes the points among observables, by the index of [`point_result`]; `None` if instants keep points, or if
    /// there are none.
    pub(crate) fn points_of(&self, observables: &[Observable]) -> Option<Formulas> {
        let results = observables.iter().filter_map(|it| match *it {
            Observable::Point { place, axis, level } => Some(point_result(place, level, axis)),
            _ => None,
        });
        let results: Vec<usize> = results.collect();
        let formulas = self.points.computed().filter(|_| !results.is_empty());
        formulas.map(|it| it.limited_to(&results))
    }
}

/// Returns the index of a component of a point among the results of all points.
pub(crate) fn point_result(point: usize, level: usize, axis: usize) -> usize {
    6 * point + 2 * level + axis
}
