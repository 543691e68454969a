//! Computes the measured quantities of a system's motion, and their derivatives by its parameters.

use linkwright::{Blocks, Settings, Shell};
use linkwright_codegen::stages::model::Dimension;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::Observable;
use linkwright_solver::comparison::difference;
use linkwright_solver::{Instant, Interpreted, Modes, Schedule, View, follow};

use crate::slopes::Slopes;
use crate::{Bounds, Measurements};

/// Error for a quantity whose dependence on parameters is not derived: an acceleration, a force, or a measure of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotDerived;

/// Mechanism whose parameters can be fitted.
#[derive(Clone, Debug)]
pub struct Calibrator {
    view: Interpreted,
    modes: Modes,
    names: Vec<String>,
    nominal: Vec<f64>,
    bounds: Vec<Bounds>,
    /// Largest time between frames (s).
    step: f64,
    slopes: Slopes,
}

/// Residuals and derivatives at these parameters.
#[derive(Clone, Debug)]
pub(crate) struct Sampled {
    /// Measured minus solved values, column by column and time by time.
    pub residuals: Vec<Vec<Option<f64>>>,
    /// Derivatives of solved values, column by column: by parameter, time by time.
    pub slopes: Vec<Vec<f64>>,
}

impl Calibrator {
    /// Returns the calibrator of a system with the sensitivities to the parameters that are to be fitted, as
    /// [`linkwright_codegen::Read::along`] gives it. `step` is the largest time between frames (s). `None` if its blocks
    /// cannot be ordered.
    pub fn new(derived: &Derived, step: f64) -> Option<Calibrator> {
        Some(Calibrator::of(Interpreted::new(derived)?, step))
    }

    /// Returns the calibrator of an interpreted system; `step` is the largest time between frames (s).
    #[must_use]
    pub fn of(view: Interpreted, step: f64) -> Calibrator {
        let modes = view.drawn_branches();
        let system = view.system();
        let slopes = Slopes::new(&view);
        let places = &slopes.parameters;
        let parameters = &system.mechanism.parameters;
        let names = places
            .iter()
            .map(|it| parameters[*it].name.clone())
            .collect();
        let all = view.nominal_parameters();
        let nominal: Vec<f64> = places.iter().map(|it| all.0[*it]).collect();
        let bounds = places.iter().zip(&nominal).map(|(place, value)| {
            let parameter = &parameters[*place];
            match parameter.range {
                Some([low, high]) => Bounds { low, high },
                None if parameter.dimension == Dimension::LENGTH => Bounds::with_sign_of(*value),
                None => Bounds::NONE,
            }
        });
        Calibrator {
            bounds: bounds.collect(),
            nominal,
            names,
            modes,
            step,
            slopes,
            view,
        }
    }

    /// Selects assembly modes other than those of the design configuration.
    pub fn in_modes(mut self, modes: Modes) -> Calibrator {
        self.modes = modes;
        self
    }

    /// Sets the bounds of a parameter, by its index among [`Calibrator::names`].
    ///
    /// Without bounds, a parameter stays in its range; without a range, a length keeps the sign that it has in the
    /// description. A pose outside of a range is not solved.
    #[must_use]
    pub fn within(mut self, place: usize, bounds: Bounds) -> Calibrator {
        if let Some(own) = self.bounds.get_mut(place) {
            *own = bounds;
        }
        self
    }

    /// Bounds of the parameters.
    pub fn bounds(&self) -> &[Bounds] {
        &self.bounds
    }

    /// Interpreted mechanism.
    pub fn view(&self) -> &Interpreted {
        &self.view
    }

    /// Names of the parameters, in the order of the description.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Values of the parameters in the description, in SI units.
    pub fn nominal(&self) -> Vec<f64> {
        self.nominal.clone()
    }

    /// Checks that a quantity can be fitted.
    ///
    /// # Errors
    /// Returns [`NotDerived`] if its dependence on parameters is not derived.
    pub fn can_fit(derived: &Derived, observable: Observable) -> Result<(), NotDerived> {
        match observable.order(derived) {
            0 | 1 => Ok(()),
            _ => Err(NotDerived),
        }
    }

    /// Solves for quantities with these parameters, in SI units, column by column and time by time.
    ///
    /// # Errors
    /// Returns the reason, in words, if the mechanism cannot be assembled or its motion ends early.
    pub fn solved(
        &self,
        observables: &[Observable],
        times: &[f64],
        parameters: &[f64],
    ) -> Result<Vec<Vec<f64>>, String> {
        let mut solved = vec![Vec::with_capacity(times.len()); observables.len()];
        self.follow(times, parameters, |instant| {
            for (column, value) in
                solved
                    .iter_mut()
                    .zip(Observable::values(&self.view, observables, instant))
            {
                column.push(value);
            }
        })?;
        Ok(solved)
    }

    /// Moves the mechanism through the times, which may repeat.
    fn follow(
        &self,
        times: &[f64],
        parameters: &[f64],
        mut see: impl FnMut(&Instant),
    ) -> Result<(), String> {
        let Some(&start) = times.first() else {
            return Ok(());
        };
        let mut all = self.view.nominal_parameters();
        for (place, value) in self.slopes.parameters.iter().zip(parameters) {
            all.0[*place] = *value;
        }
        let laws = self.view.input_laws();
        let schedule = Schedule::instants(start, times, self.step)?;
        let shell = Shell::assemble(
            self.view.clone(),
            &all,
            &self.view.drawn_pose(&all),
            self.modes.clone(),
            start,
            &laws.at(start),
            Settings::default(),
        );
        let mut shell = shell.map_err(|failure| self.view.not_assembled(&failure))?;
        let mut next = 0;
        let mut show = |instant: &Instant| {
            while times.get(next) == Some(&instant.t()) {
                see(instant);
                next += 1;
            }
        };
        show(shell.frame());
        let end = follow(&mut shell, &laws, &schedule.forward, |shell, wanted| {
            if wanted {
                show(shell.frame());
            }
            Ok::<(), std::convert::Infallible>(())
        });
        match end {
            Ok(None) => Ok(()),
            Ok(Some(end)) => Err(self.view.ended(&end.failure, &end.last)),
            Err(never) => match never {},
        }
    }

    /// Computes the residuals of the measured values, and their derivatives by the parameters.
    pub(crate) fn sample(
        &self,
        measured: &Measurements,
        parameters: &[f64],
    ) -> Result<Sampled, String> {
        let columns = &measured.columns;
        let count = self.names.len();
        let rows = measured.times.len();
        let observables: Vec<Observable> = columns.iter().map(|it| it.observable).collect();
        let system = self.view.system();
        let is_angle: Vec<bool> = observables.iter().map(|it| it.is_angle(system)).collect();
        let mut sampled = Sampled {
            residuals: vec![Vec::with_capacity(rows); columns.len()],
            slopes: vec![Vec::with_capacity(rows * count); columns.len()],
        };
        self.follow(&measured.times, parameters, |instant| {
            let solved = Observable::values(&self.view, &observables, instant);
            let derivatives = self.view.derivatives(instant).unwrap_or_default();
            for (place, value) in solved.iter().enumerate() {
                let row = sampled.residuals[place].len();
                let measured = columns[place].values[row];
                let residual = measured.map(|it| difference(it, *value, is_angle[place]));
                sampled.residuals[place].push(residual);
                self.slopes.add(
                    observables[place],
                    instant,
                    &derivatives,
                    &mut sampled.slopes[place],
                );
            }
        })?;
        let all = sampled.slopes.iter().flatten();
        match all
            .chain(sampled.residuals.iter().flatten().flatten())
            .all(|it| it.is_finite())
        {
            true => Ok(sampled),
            false => Err("is singular at one of the measured times".to_string()),
        }
    }
}
