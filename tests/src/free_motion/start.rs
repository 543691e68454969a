//! Random poses and rates of a mechanism, at determinants of the free coordinates over many powers of ten.
//!
//! From the design configuration the free coordinates are moved along a ray until the pose vanishes. Starts lie on
//! the ray before that end.

use linkwright::{Blocks, Shell, Signal};
use linkwright_solver::{InputSignals, Instant, Interpreted, View};
use nalgebra::DVector;

use super::gallery::Freed;
use super::weighed::Weighed;
use crate::multipliers::{Motion, Multipliers};
use crate::random::Random;
use crate::simulated::interpreted;
use crate::values::assembled_with;

/// Powers of ten of distances from the end of a ray: beside a dead center, determinants are proportional to their
/// roots.
const CLOSENESS: [f64; 2] = [-8.0, 0.0];

/// First step along a ray, growth of the next ones, and the distance at which the search ends.
const STEP: f64 = 0.02;
const GROWTH: f64 = 1.05;
const FARTHEST: f64 = 3.0;

/// Smallest and largest of the largest rate (m/s or rad/s).
const RATES: [f64; 2] = [2.0, 6.0];

/// Mechanism near its design configuration, in which starts are sought.
pub(super) struct Places {
    view: Interpreted,
    reference: Multipliers,
    freed: &'static Freed,
    drawn: DVector<f64>,
    /// Values of the free coordinates there.
    values: DVector<f64>,
}

/// Start: the pose, and values and rates of the free coordinates.
pub(super) struct Start {
    pub instant: Instant,
    pub values: Vec<[f64; 2]>,
}

impl Places {
    pub fn new(freed: &'static Freed, weighed: &Weighed) -> Places {
        let view = interpreted(&weighed.drawn());
        let reference = Multipliers::new(view.derived(), &[], [0.0; 2]);
        let drawn = DVector::from_vec(view.drawn_pose(&view.nominal_parameters()).0);
        let design_values = reference.free_values(&drawn);
        let signals = view.input_laws().at(0.0).0;
        let ranges = freed.free.iter().enumerate();
        let values = ranges.map(|(place, range)| match range.value {
            Some(_) => signals[place].value,
            None => design_values[place],
        });
        let values = DVector::from_iterator(freed.free.len(), values);
        Places {
            view,
            reference,
            freed,
            drawn,
            values,
        }
    }

    /// Pose of the blocks at values of the free coordinates, near another one.
    fn pose(&self, values: &[f64], near: &[f64]) -> Option<Instant> {
        let signals = values.iter().map(|value| Signal::new(*value, 0.0, 0.0));
        let inputs = InputSignals(signals.collect());
        let assembled: Result<Shell<Interpreted>, _> =
            assembled_with(self.view.clone(), near, 0.0, &inputs, Default::default());
        Some(assembled.ok()?.frame().clone())
    }

    /// Random start; `None` if the design configuration cannot be assembled.
    pub fn start(&self, random: &mut Random) -> Option<Start> {
        let ranges = self.freed.free;
        let direction: Vec<f64> = match ranges {
            [range] if random.bits().is_multiple_of(2) => vec![range.reach],
            [range] => vec![-range.reach],
            _ => {
                let parts = ranges.iter().map(|it| it.reach * random.between(-1.0, 1.0));
                parts.collect()
            }
        };
        let at = |part: f64| -> Vec<f64> {
            let moved = self.values.iter().zip(&direction);
            moved.map(|(value, along)| value + part * along).collect()
        };
        let (part, near) = self.end(&at)?;
        let close = 10.0_f64.powf(random.between(CLOSENESS[0], CLOSENESS[1]));
        let (part, near) = match part {
            Some(end) => (end - end * close * close, near),
            None => (random.between(0.0, FARTHEST), self.drawn.clone()),
        };
        let values = at(part);
        let instant = self.pose(&values, near.as_slice())?;
        let pose = DVector::from_column_slice(instant.q());
        let moved = DVector::from_fn(pose.len(), |_, _| random.between(-1.0, 1.0));
        let rates = self.reference.allowed(&pose, &moved);
        let rates = rates.scale(random.between(RATES[0], RATES[1]) / rates.amax());
        let rates = self.reference.free_rates(&Motion { pose, rates });
        let values = values.iter().zip(&rates);
        Some(Start {
            instant,
            values: values.map(|(value, rate)| [*value, *rate]).collect(),
        })
    }

    /// Last point on a ray that has a pose, with that pose; no point if all have poses.
    fn end(&self, at: &impl Fn(f64) -> Vec<f64>) -> Option<(Option<f64>, DVector<f64>)> {
        let pose = |part: f64, near: &DVector<f64>| {
            let pose = self.pose(&at(part), near.as_slice())?;
            Some(DVector::from_column_slice(pose.q()))
        };
        let mut last = pose(0.0, &self.drawn)?;
        let (mut inside, mut outside, mut step) = (0.0, 0.0, STEP);
        while outside < FARTHEST {
            outside += step;
            step *= GROWTH;
            match pose(outside, &last) {
                Some(found) => (inside, last) = (outside, found),
                None => break,
            }
        }
        if inside == outside {
            return Some((None, last));
        }
        loop {
            let middle = 0.5 * (inside + outside);
            if middle == inside || middle == outside {
                return Some((Some(inside), last));
            }
            match pose(middle, &last) {
                Some(found) => (inside, last) = (middle, found),
                None => outside = middle,
            }
        }
    }
}
