//! Follows an assembled motion over a schedule, and hands its instants on in the order of time.

use std::io;

use linkwright::PointMotion;
use linkwright_solver::approach::Watch;
use linkwright_solver::measure_watch::TimedValue;
use linkwright_solver::measures::Measures;
use linkwright_solver::not_finite::load;
use linkwright_solver::number::time;
use linkwright_solver::warnings::warnings;
use linkwright_solver::{Instant, Movable, Observable, Schedule, View, follow};

use crate::measured;

use super::{EarlyEnd, Followed, Row, Shown, Sink, of_coordinate};

/// Measure below which a warning is given: results there have three correct digits fewer than elsewhere.
const WARNING_LIMIT: f64 = 1e-3;

impl<V: View> Followed<V> {
    /// Follows the motion over the rest of the schedule, and hands requested instants on in the order of time.
    ///
    /// `reached` receives the number of visited times.
    ///
    /// # Errors
    /// Errors of the sinks, which end the motion.
    pub fn follow(
        &mut self,
        schedule: &Schedule,
        sinks: &mut [&mut dyn Sink],
        mut reached: impl FnMut(usize),
    ) -> io::Result<()> {
        let Some(mut moved) = self.moved.take() else {
            return Ok(());
        };
        let laws = self.view.input_laws();
        let mut watch = self.measures.clone().map(|it| Watch::new(it, laws.clone()));
        let mut ended = None;
        let mut approaches = Vec::new();
        let mut earlier: Vec<(Instant, Vec<f64>)> = Vec::new();
        let start = moved.instant().clone();
        if schedule.backward.length() > 0 {
            let (mut moved, mut watch) = (moved.clone(), watch.clone());
            if let Some(watch) = &mut watch {
                watch.see(moved.fuller());
            }
            let end = follow(&mut moved, &laws, &schedule.backward, |moved, wanted| {
                let instant = moved.instant();
                let sizes = watch
                    .as_mut()
                    .map_or(Vec::new(), |it| it.see(moved.fuller()));
                if wanted {
                    earlier.push((instant.clone(), sizes));
                }
                self.visits += 1;
                reached(self.visits);
                Ok::<(), io::Error>(())
            })?;
            approaches.extend(watch.map_or(Vec::new(), |it| it.finish(moved.fuller())));
            ended = end.map(|end| (EarlyEnd::from(&end.failure), moved.ended(&end)));
        }
        for (instant, sizes) in earlier.iter().rev() {
            self.show(instant, sizes, sinks)?;
        }
        let sizes = watch
            .as_mut()
            .map_or(Vec::new(), |it| it.see(moved.fuller()));
        if schedule.start.wanted {
            self.show(&start, &sizes, sinks)?;
        }
        if ended.is_none() {
            let end = follow(&mut moved, &laws, &schedule.forward, |moved, wanted| {
                let instant = moved.instant();
                let sizes = watch
                    .as_mut()
                    .map_or(Vec::new(), |it| it.see(moved.fuller()));
                self.visits += 1;
                reached(self.visits);
                match wanted {
                    true => self.show(instant, &sizes, sinks),
                    false => Ok(()),
                }
            })?;
            approaches.extend(watch.map_or(Vec::new(), |it| it.finish(moved.fuller())));
            ended = end.map(|end| (EarlyEnd::from(&end.failure), moved.ended(&end)));
        }
        self.warnings = warnings(&approaches, self.view.singular_poses(), WARNING_LIMIT);
        (self.failure, self.error) = ended.unzip();
        self.finish();
        self.view = moved.fuller().blocks().clone();
        Ok(())
    }

    /// Adds the warnings that need all instants.
    pub(super) fn finish(&mut self) {
        let pulls = self.reported_names.iter().zip(&self.pulls);
        let pulls = pulls.filter_map(|((name, _), t)| Some((name, (*t)?)));
        let parted = pulls.map(|(name, t)| {
            let t = time(t);
            format!(
                "{name} is negative at t = {t} s: the bodies would have to pull there, and part"
            )
        });
        self.warnings.extend(parted);
        let broken = self.broken_limits();
        self.warnings.extend(broken);
        if let (None, Some((reason, t))) = (&self.error, &self.no_forces) {
            let t = time(*t);
            self.error = Some(format!("has no forces at t = {t} s: {reason}"));
        }
        if let (Some(last), Some(number)) = (&self.last, self.count.checked_sub(1)) {
            let row = self.row(number, last, self.motions(last), self.reported(last));
            self.rows.end(row);
        }
    }

    /// Returns a sentence for each limit that a shown instant breaks.
    fn broken_limits(&self) -> Vec<String> {
        let mechanism = &self.system().mechanism;
        let units = mechanism.units.of_tables();
        let first = self.force_count();
        let broken = mechanism.limits.iter().filter_map(|limit| {
            let [low, high] = self.extremes[first + limit.measurement];
            let worst = match limit.margin(low.0) < limit.margin(high.0) {
                true => low,
                false => high,
            };
            // Without an instant, both are infinite.
            if worst.1.is_nan() || limit.margin(worst.0) >= 0.0 {
                return None;
            }
            let measurement = &mechanism.measurements[limit.measurement];
            let worst = TimedValue {
                t: worst.1,
                value: worst.0,
            };
            let worst = measured::text(worst, &units.of(&measurement.unit()));
            Some(format!(
                "{} is {worst}, beyond its limit: {}",
                measurement.name,
                limit.text(&units)
            ))
        });
        broken.collect()
    }

    pub(super) fn show(
        &mut self,
        instant: &Instant,
        sizes: &[f64],
        sinks: &mut [&mut dyn Sink],
    ) -> io::Result<()> {
        self.residuals.see(instant);
        self.pressure.see(instant);
        let is_row = self.rows.keeps(self.count);
        let measures: Vec<f64> = match self.wanted.monitor {
            true => sizes
                .iter()
                .zip(self.measures.iter().flat_map(Measures::parts))
                .map(|(size, part)| part.bounded(*size))
                .collect(),
            false => Vec::new(),
        };
        for (place, measure) in measures.iter().enumerate() {
            if self
                .smallest_measure
                .is_none_or(|(_, _, smallest)| *measure < smallest)
            {
                self.smallest_measure = Some((place, instant.t(), *measure));
            }
        }
        let reported = self.reported(instant);
        self.see_infinite(instant, reported.as_deref());
        for (largest, force) in self
            .largest_reported
            .iter_mut()
            .zip(reported.iter().flatten())
        {
            if force.abs() > largest.0.abs() {
                *largest = (*force, instant.t());
            }
        }
        let extremes = self.extremes.iter_mut().zip(reported.iter().flatten());
        for ([low, high], &value) in extremes {
            if value < low.0 {
                *low = (value, instant.t());
            }
            if value > high.0 {
                *high = (value, instant.t());
            }
        }
        let squares = self.squares.iter_mut().zip(reported.iter().flatten());
        squares.for_each(|(square, &value)| square.add(instant.t(), value));
        let first = self.force_count();
        let measured = reported.as_deref().and_then(|it| it.get(first..));
        let measured = measured.unwrap_or_default();
        self.motors
            .iter_mut()
            .for_each(|it| it.see(instant.t(), measured));
        if let Some(losses) = &mut self.losses {
            losses.see(instant.t(), reported.as_deref().unwrap_or_default());
        }
        let pressures = self.reported_names.iter().zip(reported.iter().flatten());
        for (pulls, ((name, _), force)) in self.pulls.iter_mut().zip(pressures) {
            if name.ends_with("_pressure") && *force < 0.0 {
                pulls.get_or_insert(instant.t());
            }
        }
        if is_row || self.course.is_some() || !sinks.is_empty() {
            let motions = self.motions(instant);
            if let Some(course) = &mut self.course {
                let reported = reported.as_deref().unwrap_or_default();
                course.push(instant, &motions, &self.wanted.coordinates, reported);
                for (path, pair) in course.pairs.iter_mut().zip(&self.wanted.pairs) {
                    let values = Observable::values(&self.view, pair, instant);
                    path.push([values[0], values[1]]);
                }
            }
            if !sinks.is_empty() {
                let is_requested = !self.derivative_names.is_empty();
                let derivatives = match is_requested {
                    false => Some(Vec::new()),
                    true => self.view.derivatives(instant),
                };
                let solved = Shown {
                    instant,
                    motions: &motions,
                    derivatives: derivatives.as_deref(),
                    reported: reported.as_deref(),
                    measures: &measures,
                };
                for sink in sinks.iter_mut() {
                    sink.take(&solved)?;
                }
            }
            if is_row {
                let row = self.row(self.count, instant, motions, reported);
                self.rows.push(row);
            }
        }
        self.last = Some(match self.last.take() {
            Some(mut last) => {
                last.clone_from(instant);
                last
            }
            None => instant.clone(),
        });
        self.count += 1;
        Ok(())
    }

    /// Records the reason of the first forces that are not finite.
    fn see_infinite(&mut self, instant: &Instant, forces: Option<&[f64]>) {
        let are_finite = forces.is_some_and(|forces| forces.iter().all(|it| it.is_finite()));
        if self.no_forces.is_some() || are_finite {
            return;
        }
        let load = load(
            self.view.pool(),
            self.view.system(),
            self.view.layout(),
            instant,
        );
        let reason = match (load, &self.losses) {
            (Some(load), _) => format!("`{load}` is not finite there"),
            (None, Some(_)) if forces.is_none() => {
                "the forces of friction do not settle there, or the pose is singular".to_string()
            }
            (None, _) => return,
        };
        self.no_forces = Some((reason, instant.t()));
    }

    fn motions(&self, instant: &Instant) -> Vec<PointMotion> {
        let all = self.view.points(instant);
        self.wanted.points.iter().map(|&point| all[point]).collect()
    }

    /// Returns the requested forces and the measures; `None` if they are undetermined.
    fn reported(&self, instant: &Instant) -> Option<Vec<f64>> {
        match self.reported_names.is_empty() {
            true => Some(Vec::new()),
            false => self.view.reported(instant),
        }
    }

    fn row(
        &self,
        number: usize,
        instant: &Instant,
        motions: Vec<PointMotion>,
        reported: Option<Vec<f64>>,
    ) -> Row {
        let coordinates = self.wanted.coordinates.iter();
        Row {
            number,
            t: instant.t(),
            motions,
            coordinates: coordinates.map(|it| of_coordinate(instant, *it)).collect(),
            reported: reported.unwrap_or_else(|| vec![f64::NAN; self.reported_names.len()]),
        }
    }
}
