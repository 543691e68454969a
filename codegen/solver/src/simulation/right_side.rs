//! Evaluates the accelerations of a chart's coordinates, and the power of what adds work.
//!
//! Every evaluation solves the constraints to rounding and the exact equations of motion. At the end of a step, a chart around the
//! reached pose replaces the chart; the coordinates of that pose and their rates are converted.

use super::chart::Chart;
use super::equations::MotionEquations;
use super::solved::Solved;
use super::stop::Stop;
use crate::instant::Instant;
use crate::rates::Rates;

/// Largest stretch of a coordinate in a chart: the tangent has turned by at most 60 degrees.
const STRETCH: f64 = 2.0;

/// Rates of the coordinates of a chart, of these rates and of the work.
#[derive(Clone, Debug)]
pub(super) struct RightSide {
    pub equations: MotionEquations,
    pub chart: Chart,
    /// Origin of lengths, so that the position of a mechanism does not matter; angles begin at 0.
    reference: Vec<f64>,
    pub evaluations: u64,
}

impl RightSide {
    /// Creates the right side around the pose in which a motion starts; `None` if its constraints have lost rank.
    pub fn new(equations: MotionEquations, start: &Instant) -> Option<RightSide> {
        let chart = Chart::around(&equations, start, false)?;
        let pose = equations.level(start, 0);
        let lengths = pose.iter().zip(&equations.is_length);
        let reference = lengths.map(|(q, is_length)| if *is_length { *q } else { 0.0 });
        Some(RightSide {
            reference: reference.collect(),
            equations,
            chart,
            evaluations: 0,
        })
    }

    /// Changes to the chart around a pose, straight along strongly damped directions if requested; `None` if its constraints have lost rank.
    pub fn enter(&mut self, pose: &Instant, is_straight: bool) -> Option<()> {
        self.chart = Chart::around(&self.equations, pose, is_straight)?;
        Some(())
    }

    /// Returns the coordinates of the chart and their rates in a pose.
    pub fn state(&self, pose: &Instant) -> Vec<f64> {
        let mut state = self
            .chart
            .coordinates(&self.equations, pose, &self.reference);
        state.extend(self.level(pose, 1));
        state
    }

    /// Returns rates or accelerations of the chart's coordinates at an instant.
    pub fn level(&self, pose: &Instant, level: usize) -> Vec<f64> {
        self.chart.level(&self.equations, pose, level)
    }

    /// Solves a state.
    ///
    /// # Errors
    /// The pose or its acceleration does not exist.
    pub fn solve(&mut self, t: f64, state: &[f64]) -> Result<Solved, Stop> {
        self.evaluations += 1;
        let count = self.chart.dimension();
        let levels = [&state[..count], &state[count..2 * count]];
        self.chart
            .solve(&self.equations, t, levels, &self.reference)
    }

    /// Solves the pose on the constraints that is nearest to a pose, with the nearest rates.
    ///
    /// # Errors
    /// The pose or its acceleration does not exist.
    pub fn projected(&mut self, pose: &Instant) -> Result<Solved, Stop> {
        let t = pose.t();
        self.evaluations += 1;
        let chart = Chart::around(&self.equations, pose, false).ok_or(Stop::LosesRank { t })?;
        let around_pose = RightSide {
            equations: self.equations.clone(),
            chart,
            reference: self.reference.clone(),
            evaluations: 0,
        };
        let state = around_pose.state(pose);
        let count = around_pose.chart.dimension();
        let levels = [&state[..count], &state[count..]];
        around_pose.chart.settle(
            &around_pose.equations,
            t,
            around_pose.equations.level(pose, 0),
            levels,
            &around_pose.reference,
        )
    }
}

impl Rates for RightSide {
    type Failure = Stop;

    fn rates(&mut self, t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), Stop> {
        let solved = self.solve(t, state)?;
        if solved.stretch > STRETCH {
            return Err(Stop::Unsettled { t });
        }
        let count = self.chart.dimension();
        rates[..count].copy_from_slice(&state[count..2 * count]);
        rates[count..2 * count].copy_from_slice(&solved.acceleration);
        rates[2 * count] = solved.power;
        Ok(())
    }

    fn judged(&self) -> usize {
        2 * self.chart.dimension()
    }

    fn largest(&self, component: usize) -> f64 {
        match component < self.chart.dimension() {
            true => 1.0,
            false => f64::INFINITY,
        }
    }

    fn scales(&self, state: &[f64], slope: &[f64], length: f64) -> Vec<f64> {
        let count = self.chart.dimension();
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
        let [rate, bend] = [state, slope].map(|it| largest(&it[count..2 * count]));
        let mut scales = vec![1.0; count];
        scales.resize(2 * count, rate.max(length * bend).max(1.0));
        scales
    }
}
