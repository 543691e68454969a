//! Continues a motion smoothly over a pose in which the constraints lose rank.
//!
//! Near such a pose the null space has no digits. A collocation method with an even number of Gauss points evaluates the exact equations
//! on both sides and never close to the pose. The pose lies in the middle between its points. The continuation counts only if it is a
//! polynomial motion of that degree: all points lie on the constraints, its highest coefficients are within tolerances, and the
//! constraints have a singular pose in the middle. If branches only come close, none of the three holds.

use linkwright::math::Real;

use super::equations::MotionEquations;
use super::right_side::RightSide;
use super::solved::Solved;
use super::stop::Stop;
use crate::instant::Instant;
use crate::tolerances::Tolerances;

/// Number of Gauss points of a crossing: even, so that none lies in the middle.
const POINTS: usize = 10;

/// Number of sweeps in which all points are solved.
const SWEEPS: usize = 40;

/// Permitted error of the examined quantities, in tolerances.
const ALLOWED: f64 = 100.0;

/// Permitted residual of the constraints in the singular pose, in the directions that they lose: g² for a gap g between branches.
const GAP: f64 = 1e-13;

/// Largest singular value of a lost direction, relative to the largest of all.
const LOST: f64 = 1e-4;

/// Number of narrowings of the interval with the most singular pose, and the ratio of the golden section.
const SEARCHES: usize = 50;
const GOLDEN: f64 = 0.381_966_011_250_105;

/// Motion across a singular pose: accelerations of all coordinates, and the power, as Legendre series.
#[derive(Clone, Debug)]
pub(super) struct Crossing {
    /// Beginning and end (s).
    pub from: f64,
    pub to: f64,
    /// Unknowns at the start, and their rates.
    start: [Vec<f64>; 2],
    work: f64,
    /// Coefficients by degree, then by coordinate; the power comes last.
    series: Vec<Vec<f64>>,
}

/// Returns the Legendre polynomials at a part of an interval, up to a degree.
fn legendre(part: f64, degree: usize) -> Vec<f64> {
    let x = 2.0 * part - 1.0;
    let mut values = vec![1.0, x];
    for k in 1..degree {
        let k_real = k as f64;
        let next = ((2.0 * k_real + 1.0) * x * values[k] - k_real * values[k - 1]) / (k_real + 1.0);
        values.push(next);
    }
    values
}

/// Returns the integrals from 0 of polynomials with these values, for each degree but the last; `first` is that of degree 0.
fn integrated(values: &[f64], first: f64) -> Vec<f64> {
    let inner = (1..values.len() - 1)
        .map(|k| (values[k + 1] - values[k - 1]) / (2.0 * (2.0 * k as f64 + 1.0)));
    std::iter::once(first).chain(inner).collect()
}

/// Returns the positions of the Gauss points in an interval, and their weights.
fn points() -> Vec<(f64, f64)> {
    let count = POINTS as f64;
    let nodes = (0..POINTS).map(|place| {
        let mut x = -Real::cos(std::f64::consts::PI * (place as f64 + 0.75) / (count + 0.5));
        let mut slope = 1.0;
        for _ in 0..20 {
            let values = legendre(0.5 * (x + 1.0), POINTS);
            slope = count * (x * values[POINTS] - values[POINTS - 1]) / (x * x - 1.0);
            x -= values[POINTS] / slope;
        }
        (0.5 * (x + 1.0), 1.0 / ((1.0 - x * x) * slope * slope))
    });
    nodes.collect()
}

impl Crossing {
    /// Continues a motion smoothly from a frame over a singular pose in the middle of the interval; `None` if none is verified.
    pub fn attempt(
        right_side: &mut RightSide,
        start: &Instant,
        work: f64,
        power: f64,
        length: f64,
        tolerances: &Tolerances,
    ) -> Option<Crossing> {
        let levels = [0, 1, 2].map(|level| right_side.equations.level(start, level));
        let [pose, rates, bends] = levels;
        let count = pose.len();
        let points = points();
        let mut crossing = Crossing {
            from: start.t(),
            to: start.t() + length,
            start: [pose, rates.clone()],
            work,
            series: vec![vec![0.0; count + 1]; POINTS],
        };
        crossing.series[0][..count].copy_from_slice(&bends);
        crossing.series[0][count] = power;
        let scales = right_side.equations.coordinate_scales.clone();
        let largest = |values: &[f64]| {
            let scaled = values
                .iter()
                .zip(&scales)
                .map(|(it, scale)| (it / scale).abs());
            scaled.fold(0.0, f64::max)
        };
        let speed = largest(&rates).max(length * largest(&bends));
        let allowed =
            ALLOWED * (tolerances.relative * (speed * length).max(1.0) + tolerances.absolute);
        let mut before = f64::INFINITY;
        for _ in 0..SWEEPS {
            let mut series = vec![vec![0.0; count + 1]; POINTS];
            let mut missed = 0.0_f64;
            for &(part, weight) in &points {
                let (pose, _) = crossing.at(right_side, crossing.from + part * length);
                let solved = right_side.projected(&pose).ok()?;
                missed = missed.max(distance(
                    &right_side.equations,
                    [&pose, &solved.instant],
                    length,
                ));
                let values = legendre(part, POINTS);
                let bends = right_side.equations.level(&solved.instant, 2);
                let accelerations = bends.iter().chain(std::iter::once(&solved.power));
                for (place, acceleration) in accelerations.enumerate() {
                    for (degree, own) in series.iter_mut().enumerate() {
                        own[place] +=
                            (2.0 * degree as f64 + 1.0) * weight * values[degree] * acceleration;
                    }
                }
            }
            let change = series.iter().zip(&crossing.series).map(|(one, other)| {
                let differences: Vec<f64> = one
                    .iter()
                    .zip(other)
                    .map(|(one, other)| one - other)
                    .collect();
                largest(&differences) * length * length
            });
            let change = change.fold(0.0, f64::max);
            if !change.is_finite() {
                return None;
            }
            crossing.series = series;
            let is_settled =
                change <= 0.01 * allowed || change >= 0.5 * before && change <= allowed;
            before = change;
            if is_settled && missed <= allowed {
                return crossing
                    .is_one(right_side, allowed, &scales)
                    .then_some(crossing);
            }
        }
        None
    }

    /// True if the motion is smooth, ends on the constraints, and crosses a singular pose.
    fn is_one(&self, right_side: &mut RightSide, allowed: f64, scales: &[f64]) -> bool {
        let length = self.to - self.from;
        let tail = self
            .series
            .iter()
            .enumerate()
            .skip(POINTS - 2)
            .map(|(degree, own)| {
                let scaled = own.iter().zip(scales).map(|(it, scale)| (it / scale).abs());
                scaled.fold(0.0, f64::max) * length * length / (degree * degree) as f64
            });
        if !tail.fold(0.0, f64::max).le(&allowed) {
            return false;
        }
        let (end, _) = self.at(right_side, self.to);
        let Ok(solved) = right_side.projected(&end) else {
            return false;
        };
        if !distance(&right_side.equations, [&end, &solved.instant], length).le(&allowed) {
            return false;
        }
        self.is_singular(right_side)
    }

    /// True if constraints are singular near the middle, and hold there in the directions that they lose.
    fn is_singular(&self, right_side: &RightSide) -> bool {
        let equations = &right_side.equations;
        let parts = |t: f64| {
            let (pose, _) = self.at(right_side, t);
            let (residual, matrix) = equations.constraints(&pose);
            let limit = 100 * matrix.ncols();
            let decomposition = matrix
                .transpose()
                .try_svd(false, true, f64::EPSILON, limit)?;
            let left = decomposition.v_t? * residual;
            Some((decomposition.singular_values, left))
        };
        let smallest = |t: f64| parts(t).map_or(f64::INFINITY, |(values, _)| values.min());
        let length = self.to - self.from;
        let [mut low, mut high] = [0.25, 0.75].map(|part| self.from + part * length);
        for _ in 0..SEARCHES {
            let [one, other] = [GOLDEN, 1.0 - GOLDEN].map(|part| low + part * (high - low));
            match smallest(one) < smallest(other) {
                true => high = other,
                false => low = one,
            }
        }
        let Some((values, left)) = parts(0.5 * (low + high)) else {
            return false;
        };
        let limit = LOST * values.max();
        let mut lost = values.iter().zip(&left);
        values.min() <= limit && lost.all(|(value, missed)| *value > limit || missed.abs() <= GAP)
    }

    /// Returns the motion at a time (s), and the work (J).
    pub fn at(&self, right_side: &RightSide, t: f64) -> (Instant, f64) {
        let length = self.to - self.from;
        let part = (t - self.from) / length;
        let values = legendre(part, POINTS + 2);
        let once = integrated(&values, part);
        let twice = integrated(&once, 0.5 * part * part);
        let [pose, rates] = &self.start;
        let count = pose.len();
        let sum = |factors: &[f64], place: usize| {
            let terms = self.series.iter().zip(factors);
            terms.map(|(own, factor)| own[place] * factor).sum::<f64>()
        };
        let mut instant = right_side.equations.instant(t);
        let moved = |level: usize| -> Vec<f64> {
            let at = |place: usize| match level {
                0 => pose[place] + length * (part * rates[place] + length * sum(&twice, place)),
                1 => rates[place] + length * sum(&once, place),
                _ => sum(&values, place),
            };
            (0..count).map(at).collect()
        };
        for level in 0..3 {
            right_side
                .equations
                .set_level(&mut instant, level, &moved(level));
        }
        (instant, self.work + length * sum(&once, count))
    }

    /// Returns the solution at the end, with the work (J).
    ///
    /// # Errors
    /// The acceleration does not exist.
    pub fn end(&self, right_side: &mut RightSide) -> Result<(Solved, f64), Stop> {
        let (end, work) = self.at(right_side, self.to);
        Ok((right_side.projected(&end)?, work))
    }
}

/// Returns the distance of two poses, with rates over a time, in rad or characteristic lengths.
fn distance(equations: &MotionEquations, poses: [&Instant; 2], time: f64) -> f64 {
    let levels = [0, 1].map(|level| poses.map(|it| equations.level(it, level)));
    let [[pose, other_pose], [rates, other_rates]] = &levels;
    let each = equations
        .coordinate_scales
        .iter()
        .enumerate()
        .map(|(at, scale)| {
            let apart = (pose[at] - other_pose[at]).abs();
            let rate = time * (rates[at] - other_rates[at]).abs();
            apart.max(rate) / scale
        });
    each.fold(0.0, f64::max)
}
