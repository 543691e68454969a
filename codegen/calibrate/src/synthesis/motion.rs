//! Moves a mechanism through rows and frames, and reads quantities with their derivatives.

use linkwright::{Blocks as _, Settings, Shell};
use linkwright_solver::measure_watch::MeasureWatch;
use linkwright_solver::{Instant, Interpreted, Modes, Numbers, Observable, View};

use crate::slopes::Slopes;

/// Mechanism with the derivatives of its quantities.
#[derive(Clone, Debug)]
pub(super) struct MovedQuantities {
    pub view: Interpreted,
    slopes: Slopes,
}

/// Quantities at an instant.
#[derive(Clone, Debug, Default)]
pub(super) struct Sample {
    pub values: Vec<f64>,
    /// Derivatives by parameter, quantity by quantity.
    pub slopes: Vec<f64>,
    /// Rates, quantity by quantity; empty if they are not requested.
    pub rates: Vec<f64>,
}

/// Quantities at some times.
#[derive(Clone, Debug)]
pub(super) struct Wanted<'a> {
    /// Times (s) in any order.
    pub times: &'a [f64],
    pub observables: &'a [Observable],
    /// Rates of the observables; `None` if they are not needed.
    pub rates: Option<&'a [Observable]>,
}

impl MovedQuantities {
    pub fn new(view: Interpreted, slopes: Slopes) -> MovedQuantities {
        MovedQuantities { view, slopes }
    }

    /// Number of chosen parameters.
    pub fn count(&self) -> usize {
        self.slopes.parameters.len()
    }

    /// Returns all parameters of the mechanism with the values of the chosen ones.
    pub fn parameters(&self, values: &[f64]) -> Numbers {
        let mut all = self.view.nominal_parameters();
        for (place, value) in self.slopes.parameters.iter().zip(values) {
            all.0[*place] = *value;
        }
        all
    }

    /// Assembles the mechanism at the time `t` (s).
    pub fn assembled(&self, values: &[f64], modes: &Modes, t: f64) -> Option<Shell<Interpreted>> {
        let all = self.parameters(values);
        let assembled = Shell::assemble(
            self.view.clone(),
            &all,
            &self.view.drawn_pose(&all),
            modes.clone(),
            t,
            &self.view.input_laws().at(t),
            Settings::default(),
        );
        assembled.ok()
    }

    /// Returns the samples of all requests, time by time in their order; `None` if the mechanism does not move through all times, or a
    /// quantity is not finite.
    pub fn samples(
        &self,
        values: &[f64],
        modes: &Modes,
        wanted: &[Wanted<'_>],
    ) -> Option<Vec<Vec<Sample>>> {
        let requests = wanted.iter().enumerate();
        let visits = requests.flat_map(|(request, it)| {
            let times = it.times.iter().enumerate();
            times.map(move |(place, t)| (*t, request, place))
        });
        let mut visits: Vec<(f64, usize, usize)> = visits.collect();
        visits.sort_by(|a, b| a.0.total_cmp(&b.0));
        let laws = self.view.input_laws();
        let mut shell = self.assembled(values, modes, visits.first()?.0)?;
        let samples = wanted.iter();
        let mut samples: Vec<Vec<Sample>> = samples
            .map(|it| vec![Sample::default(); it.times.len()])
            .collect();
        for (t, request, place) in visits {
            if t > shell.frame().t() {
                shell.advance(t, &laws.at(t)).ok()?;
            }
            samples[request][place] = self.sample(shell.frame(), &wanted[request])?;
        }
        Some(samples)
    }

    fn sample(&self, instant: &Instant, wanted: &Wanted<'_>) -> Option<Sample> {
        let mut sample = Sample {
            values: Observable::values(&self.view, wanted.observables, instant),
            slopes: Vec::with_capacity(wanted.observables.len() * self.count()),
            rates: wanted.rates.map_or(Vec::new(), |rates| {
                Observable::values(&self.view, rates, instant)
            }),
        };
        if !wanted.observables.is_empty() {
            let derivatives = self.view.derivatives(instant).unwrap_or_default();
            for observable in wanted.observables {
                let slopes = &mut sample.slopes;
                self.slopes.add(*observable, instant, &derivatives, slopes);
            }
        }
        let all = sample.values.iter().chain(&sample.slopes);
        let is_finite = all.chain(&sample.rates).all(|it| it.is_finite());
        is_finite.then_some(sample)
    }

    /// Returns the value of each limited measure that is farthest beyond its limit, also between these times (s); `None` for a limit that is
    /// kept. `None` if the mechanism does not move.
    pub fn broken(&self, values: &[f64], modes: &Modes, times: &[f64]) -> Option<Vec<Option<f64>>> {
        let count = self.view.system().mechanism.limits.len();
        let mut broken = vec![None; count];
        let (Some(mut watch), true) = (MeasureWatch::new(&self.view), count > 0) else {
            return Some(broken);
        };
        let laws = self.view.input_laws();
        let mut shell = self.assembled(values, modes, *times.first()?)?;
        watch.see(&shell);
        for &t in &times[1..] {
            shell.advance(t, &laws.at(t)).ok()?;
            watch.see(&shell);
        }
        for it in watch.finish().broken {
            broken[it.limit] = Some(it.worst.value);
        }
        Some(broken)
    }
}
