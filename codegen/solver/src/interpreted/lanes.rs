//! Solves a frame of eight mechanisms of the same program at once.
//!
//! A lane has the bits of the scalar blocks, whatever the other lanes do. Lanes that a check rejects are returned, and are solved by the
//! scalar blocks instead. Only programs without Newton-Raphson have lanes.

use fearless_simd::{Level, Simd, dispatch};
use linkwright_codegen::stages::expr::{Lanes, Register};

use super::Interpreted;
use super::compiled::Compiled;
use crate::instant::Instant;
use crate::operation::{LANES, failed, run_lanes};
use crate::reader::Formulas;
use crate::supplied::{InputSignals, Modes, ParameterValues};

/// Registers of eight mechanisms.
#[derive(Debug)]
pub(crate) struct InterpretedLanes {
    level: Level,
    registers: Vec<Lanes>,
    points: Vec<Lanes>,
}

impl InterpretedLanes {
    /// Returns the registers for a program.
    pub fn new(interpreted: &Interpreted) -> InterpretedLanes {
        InterpretedLanes {
            level: Level::new(),
            registers: interpreted.compiled.code.lanes(),
            points: interpreted
                .points
                .computed()
                .map_or(Vec::new(), Formulas::lanes),
        }
    }

    /// Puts in what the next instant of one lane starts from.
    pub fn fill(
        &mut self,
        interpreted: &Interpreted,
        lane: usize,
        last: &Instant,
        t: f64,
        modes: &Modes,
        given: (&ParameterValues, &InputSignals),
    ) {
        let compiled = &*interpreted.compiled;
        let registers = &mut self.registers;
        let mut put = |register: Register, value| registers[register.index()].0[lane] = value;
        compiled.fill(last, t, given.0, given.1, &mut put);
        compiled.set_signs(modes, put);
    }

    /// Solves all lanes; returns those without a solution as bits.
    pub fn solve(&mut self, interpreted: &Interpreted) -> u8 {
        let compiled = &*interpreted.compiled;
        let registers = &mut self.registers[..];
        dispatch!(self.level, simd => simd.vectorize(
            #[inline(always)]
            || solve(compiled, registers)
        ))
    }

    /// Takes out the instant of one lane.
    pub fn keep(&self, interpreted: &Interpreted, lane: usize, t: f64, at: &mut Instant) {
        let take = |it: Register| self.registers[it.index()].0[lane];
        interpreted.compiled.keep(t, at, take);
    }

    /// Puts in the instant of one lane, for points that are computed from coordinates.
    pub fn fill_points(&mut self, interpreted: &Interpreted, lane: usize, at: &Instant) {
        if let Some(points) = interpreted.points.computed() {
            points.fill_lane(lane, at, &mut self.points);
        }
    }

    /// Evaluates the points of all lanes.
    pub fn run_points(&mut self, interpreted: &Interpreted) {
        if let Some(points) = interpreted.points.computed() {
            let registers = &mut self.points[..];
            dispatch!(self.level, simd => simd.vectorize(
                #[inline(always)]
                || points.run_lanes(registers)
            ));
        }
    }

    /// Returns a component of a point in one lane, at its instant; `None` for an unknown point.
    pub fn point(
        &self,
        interpreted: &Interpreted,
        (lane, at): (usize, &Instant),
        point: usize,
        [level, axis]: [usize; 2],
    ) -> Option<f64> {
        match interpreted.points.computed() {
            Some(points) => points.lane_value(lane, 6 * point + 2 * level + axis, &self.points),
            None => interpreted.points.kept_value(at, point, level, axis),
        }
    }
}

impl Interpreted {
    /// True if all blocks are closed forms.
    pub(crate) fn has_lanes(&self) -> bool {
        self.compiled.blocks.iter().all(|it| it.newton.is_none())
    }

    /// Returns the requested force of this index at an instant; `None` if the program does not compute it.
    pub(crate) fn force(&self, at: &Instant, index: usize) -> Option<f64> {
        let slot = *self.forces.get(index)?;
        Some(at.values()[slot?])
    }
}

/// Solves all blocks; returns the lanes that fail or are not finite.
#[inline(always)]
fn solve(compiled: &Compiled, registers: &mut [Lanes]) -> u8 {
    let mut mask = 0;
    for block in &compiled.blocks {
        for operation in &block.operations {
            mask |= run_lanes(operation, &compiled.code, registers);
        }
    }
    // Sums of finite products with zero are zero; others are NaN. Sums that do not wait for one another take less time.
    let mut sums = [[0.0; LANES]; 4];
    let time = [compiled.time];
    for list in [&compiled.given[..], &compiled.kept, &time] {
        for chunk in list.chunks(sums.len()) {
            for (sum, register) in sums.iter_mut().zip(chunk) {
                let values = registers[register.index()].0;
                *sum = std::array::from_fn(|lane| sum[lane] + 0.0 * values[lane]);
            }
        }
    }
    let [a, b, c, d] = sums;
    mask | failed(|lane| ((a[lane] + b[lane]) + (c[lane] + d[lane])).is_nan())
}
