//! Motions of the reference from a start, with the growth of a small change on the way.

use linkwright_solver::Simulation;
use nalgebra::DVector;

use crate::multipliers::{Motion, Multipliers, apart, larger};
use crate::random::Random;

/// Length of a motion (s), and number of times at which it is compared.
pub(super) const TIME: f64 = 0.6;
const FRAMES: usize = 12;

/// The relative error of a step of the reference.
const EXACT: f64 = 1e-13;

/// Change of the start whose growth is seen.
const CHANGE: f64 = 1e-6;

/// Change of the energy that a reference may show, in parts of what it has.
const ENERGY: f64 = 1e-10;

/// What a start may miss of the joints: beside a change point more, since there joints determine half of the digits.
const MISSED: f64 = 1e-9;

/// A motion of the reference at the times of frames, and the growth of small changes by then.
pub(super) struct Expected {
    frames: Vec<(Motion, f64)>,
    /// The largest coordinate or rate.
    size: f64,
}

/// The frame of a simulation.
pub(super) fn frame(simulation: &Simulation) -> Motion {
    Motion {
        pose: DVector::from_column_slice(simulation.frame().q()),
        rates: DVector::from_column_slice(simulation.frame().qd()),
    }
}

impl Expected {
    /// From a start.
    ///
    /// # Errors
    /// The reference comes too close to a singular pose of the joints, or does not keep its energy.
    pub fn of(
        reference: &Multipliers,
        start: &Motion,
        random: &mut Random,
    ) -> Result<Expected, &'static str> {
        if larger(0.0, reference.missed(start)) > MISSED {
            return Err("the start is too close to a change point");
        }
        let moved = [(); 2].map(|()| {
            let moved = DVector::from_fn(start.pose.len(), |_, _| random.between(-1.0, 1.0));
            let moved = reference.allowed(&start.pose, &moved);
            moved.scale(CHANGE / moved.amax())
        });
        // Changes of pose and rates may make up for each other; then their opposites do not.
        let mut changed = [1.0, -1.0].map(|sign| {
            let mut changed = start.clone();
            changed.pose += &moved[0];
            changed.rates += moved[1].scale(sign);
            reference.project(&mut changed);
            changed
        });
        // Steps add errors on the way: a change that shrinks first grows by more from there than from the start.
        let mut least = changed.each_ref().map(|it| apart(start, it));
        let mut own = start.clone();
        let (mut growth, mut size) = (1.0_f64, 1.0_f64);
        let mut lengths = [1e-3; 3];
        let mut frames = Vec::new();
        let short = "the reference needs too many steps";
        for _ in 0..FRAMES {
            let between = TIME / FRAMES as f64;
            let mut after = |motion: &Motion, place: usize| {
                let found = reference.after(motion, between, EXACT, &mut lengths[place]);
                found.ok_or(short)
            };
            own = after(&own, 0)?;
            for (place, (changed, least)) in changed.iter_mut().zip(&mut least).enumerate() {
                *changed = after(changed, place + 1)?;
                let change = apart(changed, &own);
                growth = larger(growth, change / *least);
                *least = least.min(change);
            }
            size = size.max(own.pose.amax()).max(own.rates.amax());
            frames.push((own.clone(), growth));
        }
        if !growth.is_finite() {
            return Err("the reference is not finite");
        }
        let [first, last] = [start, &own].map(|motion| reference.energy(motion));
        match (last - first).abs() <= ENERGY * (first.abs() + size) {
            true => Ok(Expected { frames, size }),
            false => Err("the reference does not keep its energy"),
        }
    }

    /// The largest error of a simulation, in tolerances × growth; NaN if a frame is.
    ///
    /// # Errors
    /// Its end before the time.
    pub fn missed(&self, simulation: &mut Simulation, relative: f64) -> Result<f64, String> {
        let mut largest = 0.0_f64;
        for (step, (expected, growth)) in self.frames.iter().enumerate() {
            let ended = simulation.advance(TIME * (step + 1) as f64 / FRAMES as f64);
            ended.map_err(|stop| format!("{stop:?}"))?;
            let missed = apart(&frame(simulation), expected);
            largest = larger(largest, missed / (relative * self.size * growth));
        }
        Ok(largest)
    }
}
