//! *The times of a motion → how close each block comes to a singular pose, and when.*
//!
//! The measure of a step is its determinant divided by the lengths of its Jacobian's columns (Hadamard's ratio): the sine of
//! the angle between two links, between a link and its slide, between two lines. It is dimensionless, at most 1 in size, and
//! zero exactly where the step is singular. One equation that is no closed form is measured by its slope beside the largest slope
//! on the way. Its rate is known from the velocities, so that a smallest value between two frames
//! is found where the rate changes its sign, by bisection to the last digit of t that the solver can tell apart, and not where
//! values happen to have been sampled. Poses are those of the solved view, whose closed forms stay in the assembly mode of the
//! drawing however close they come; where they do not reach there is no measure. The module does not know names.

use linkwright_codegen::expr::{ExprId, Tape};
use linkwright_codegen::structure::determinant;
use nalgebra::{DMatrix, DVector};

use crate::solved_interpreter::{SolvedInterpreter, Values};

/// How many brackets are refined for each step, the lowest first.
const REFINED: usize = 64;

/// Measures that differ by less are the same one, come back to.
pub const SAME: f64 = 1e-9;

/// The closest approach of one step to a singular pose.
#[derive(Clone, Debug)]
pub struct Approach {
    /// The block, from 0.
    pub block: usize,
    /// The step in its block, from 0.
    pub step: usize,
    /// The smallest size of the measure: 0 is singular, 1 is as far from it as can be.
    pub measure: f64,
    /// When it is first so small (s).
    pub t: f64,
    /// The pose q (n) then.
    pub q: DVector<f64>,
    /// How often it is, up to [`SAME`].
    pub times: usize,
    /// Whether it is an end of the range, where it might become smaller still beyond.
    pub at_end: bool,
}

/// The measures of all steps that can be measured.
#[derive(Clone, Debug)]
pub struct Closeness<'a> {
    solved: &'a SolvedInterpreter,
    steps: Vec<Measured>,
    signs: Vec<Vec<bool>>,
}

#[derive(Clone, Debug)]
struct Measured {
    block: usize,
    step: usize,
    tape: Tape,
    /// `None` for a closed form, whose measure and rate are the results; the size of the Jacobian that is the result with
    /// its rates otherwise.
    size: Option<usize>,
    /// Whether only its course says how large the measure can be.
    relative: bool,
}

/// A measure with its rate.
type Sample = [f64; 2];

/// A pose with the measures of all steps.
#[derive(Clone, Debug)]
struct Seen {
    values: Values,
    samples: Vec<Sample>,
}

impl<'a> Closeness<'a> {
    /// The measures of a mechanism in the assembly modes of its drawing.
    pub fn new(solved: &'a SolvedInterpreter) -> Closeness<'a> {
        let mut system = solved.system.clone();
        let form = &system.vector_form;
        let graph = &mut system.mechanism.graph;
        let mut steps = Vec::new();
        for (block, planned) in solved.plan.blocks.iter().enumerate() {
            for (step, planned) in planned.steps.iter().enumerate() {
                let found = determinant(planned, form, graph);
                // One equation for one unknown encloses no angle.
                let single = found.normalized.is_none() && found.jacobian.len() <= 1;
                let values: Vec<ExprId> = match found.normalized {
                    Some(value) => vec![value],
                    None if single => found.value.into_iter().collect(),
                    None => found.jacobian.concat(),
                };
                let constant = values.iter().all(|&value| graph.is_fixed(value));
                if values.is_empty() || constant {
                    continue;
                }
                let rates: Vec<ExprId> = values
                    .iter()
                    .map(|&value| form.rate(value, graph))
                    .collect();
                steps.push(Measured {
                    block,
                    step,
                    tape: Tape::new(graph, &[values, rates].concat()),
                    size: (found.normalized.is_none() && !single).then_some(found.jacobian.len()),
                    relative: single,
                });
            }
        }
        Closeness {
            solved,
            steps,
            signs: solved.drawn_signs(),
        }
    }

    /// The pose at `t`, reached from another; `None` where it is out of reach.
    fn see(&self, t: f64, from: &Values) -> Option<Seen> {
        let mut values = from.clone();
        self.solved.solve(t, &self.signs, &mut values).ok()?;
        let samples = self.steps.iter().map(|step| step.sample(&values));
        Some(Seen {
            samples: samples.collect(),
            values,
        })
    }

    /// The closest approach of every step over these times, ascending, refined between them.
    pub fn approaches(&self, times: &[f64]) -> Vec<Approach> {
        let seen = self.seen(times);
        let steps = (0..self.steps.len()).filter_map(|index| self.approach(index, &seen));
        steps.collect()
    }

    /// The size of the measure of each step at these times, ascending, in the order of [`Closeness::measured`]; `None` where
    /// the links do not reach in the assembly modes of the drawing.
    pub fn measures(&self, times: &[f64]) -> Vec<Option<Vec<f64>>> {
        let seen = self.seen(times);
        let units: Vec<f64> = (0..self.steps.len())
            .map(|index| self.unit(index, &seen))
            .collect();
        let sizes = |it: Seen| {
            let pairs = it.samples.iter().zip(&units);
            pairs.map(|(sample, unit)| sample[0].abs() / unit).collect()
        };
        seen.into_iter().map(|it| it.map(sizes)).collect()
    }

    /// Block and step of everything that is measured.
    pub fn measured(&self) -> impl Iterator<Item = (usize, usize)> {
        self.steps.iter().map(|it| (it.block, it.step))
    }

    /// The poses at these times, each from the one before.
    fn seen(&self, times: &[f64]) -> Vec<Option<Seen>> {
        let Some(&start) = times.first() else {
            return Vec::new();
        };
        let mut last = self.solved.begin(start);
        let mut seen = Vec::with_capacity(times.len());
        for &t in times {
            let reached = self.see(t, &last);
            if let Some(reached) = &reached {
                last.clone_from(&reached.values);
            }
            seen.push(reached);
        }
        seen
    }

    /// What the measure of a step is compared with.
    fn unit(&self, index: usize, seen: &[Option<Seen>]) -> f64 {
        if !self.steps[index].relative {
            return 1.0;
        }
        let sizes = seen.iter().flatten().map(|it| it.samples[index][0].abs());
        match sizes.fold(0.0, f64::max) {
            // Nothing but zeros are a block that is singular all the way.
            0.0 => 1.0,
            largest => largest,
        }
    }

    fn approach(&self, index: usize, seen: &[Option<Seen>]) -> Option<Approach> {
        let size = |it: &Seen| it.samples[index][0].abs();
        // The rate of the measure's size.
        let slope = |it: &Seen| {
            let [value, rate] = it.samples[index];
            rate * value.signum()
        };
        let unit = self.unit(index, seen);
        let mut lowest: Vec<(Seen, bool)> = Vec::new();
        let present = || seen.iter().flatten();
        for end in [present().next(), present().last()].into_iter().flatten() {
            lowest.push((end.clone(), true));
        }
        let mut brackets: Vec<(&Seen, &Seen)> = seen
            .windows(2)
            .filter_map(|pair| match pair {
                [Some(near), Some(far)] => Some((near, far)),
                _ => None,
            })
            .filter(|(near, far)| {
                let crosses = near.samples[index][0] * far.samples[index][0] < 0.0;
                crosses || (slope(near) < 0.0 && slope(far) >= 0.0)
            })
            .collect();
        brackets.sort_by(|a, b| {
            let low = |(near, far): &(&Seen, &Seen)| size(near).min(size(far));
            low(a).total_cmp(&low(b))
        });
        for (near, far) in brackets.into_iter().take(REFINED) {
            let crosses = near.samples[index][0] * far.samples[index][0] < 0.0;
            let sign = near.samples[index][0].signum();
            let before = |it: &Seen| match crosses {
                true => it.samples[index][0] * sign > 0.0,
                false => slope(it) < 0.0,
            };
            lowest.push((self.bisect(near, far, before), false));
        }
        let sizes = lowest.iter().map(|(it, _)| size(it));
        let smallest = sizes.min_by(f64::total_cmp)?;
        lowest.retain(|(it, _)| size(it) <= smallest + SAME * unit);
        lowest.sort_by(|a, b| a.0.values.t.total_cmp(&b.0.values.t));
        // An end that is a stationary value too counts once.
        lowest.dedup_by(|a, b| (a.0.values.t - b.0.values.t).abs() <= SAME);
        let (first, at_end) = lowest.first()?;
        Some(Approach {
            block: self.steps[index].block,
            step: self.steps[index].step,
            measure: smallest / unit,
            t: first.values.t,
            q: self.solved.pose(&first.values),
            times: lowest.len(),
            at_end: *at_end,
        })
    }

    /// The last time between two frames at which `before` still holds, as closely as times can be told apart.
    fn bisect(&self, near: &Seen, far: &Seen, before: impl Fn(&Seen) -> bool) -> Seen {
        let (mut near, mut end) = (near.clone(), far.values.t);
        loop {
            let t = near.values.t;
            let middle = t + 0.5 * (end - t);
            if middle == t || middle == end {
                return near;
            }
            match self.see(middle, &near.values) {
                Some(reached) if before(&reached) => near = reached,
                _ => end = middle,
            }
        }
    }
}

impl Measured {
    fn sample(&self, values: &Values) -> Sample {
        let mut workspace = Vec::new();
        let Some(size) = self.size else {
            let mut sample = [0.0; 2];
            self.tape
                .evaluate(&values.symbols, &mut workspace, &mut sample);
            return sample;
        };
        let mut entries = vec![0.0; 2 * size * size];
        self.tape
            .evaluate(&values.symbols, &mut workspace, &mut entries);
        let (values, rates) = entries.split_at(size * size);
        hadamard(
            &DMatrix::from_row_slice(size, size, values),
            &DMatrix::from_row_slice(size, size, rates),
        )
    }
}

/// det J over the product of the lengths of its columns, and its rate: with d(det J) = det J · tr(J⁻¹ dJ).
fn hadamard(jacobian: &DMatrix<f64>, rates: &DMatrix<f64>) -> Sample {
    let lengths: Vec<f64> = jacobian.column_iter().map(|it| it.norm()).collect();
    if lengths.contains(&0.0) {
        return [0.0; 2];
    }
    let mut unit = jacobian.clone();
    for (mut column, length) in unit.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let factors = unit.lu();
    let value = factors.determinant();
    let mut logarithmic = 0.0;
    for (place, length) in lengths.iter().enumerate() {
        let rate: DVector<f64> = rates.column(place) / *length;
        let along = rate.dot(&jacobian.column(place)) / *length;
        let Some(solved) = factors.solve(&rate) else {
            return [0.0; 2];
        };
        logarithmic += solved[place] - along;
    }
    [value, value * logarithmic]
}
