//! Computes the measured quantities of a system's motion, and their derivatives by its parameters.
//!
//! Coordinates and their rates have derived sensitivities. Those of a point follow by the chain rule from the
//! expressions of its position and velocity, which are differentiated, too.

use std::collections::HashMap;

use linkwright::{Blocks, Settings, Shell};
use linkwright_codegen::stages::expr::{ExprId, SymbolId};
use linkwright_codegen::stages::model::Dimension;
use linkwright_codegen::stages::system::{Cause, Derived};
use linkwright_solver::Observable;
use linkwright_solver::comparison::difference;
use linkwright_solver::reader::Reader;
use linkwright_solver::{Instant, Interpreted, Modes, Schedule, View, follow};

use crate::{Bounds, Measurements};

/// Error for a quantity whose dependence on parameters is not derived: an acceleration or a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotDerived;

/// Mechanism whose parameters can be fitted.
#[derive(Clone, Debug)]
pub struct Calibrator {
    view: Interpreted,
    modes: Modes,
    /// Index of each parameter among all of the mechanism.
    places: Vec<usize>,
    names: Vec<String>,
    nominal: Vec<f64>,
    bounds: Vec<Bounds>,
    /// Largest time between frames (s).
    step: f64,
    points: HashMap<[usize; 3], PointSlopes>,
}

/// Derivatives of a component of a point.
#[derive(Clone, Debug)]
struct PointSlopes {
    /// Coordinates (0) and rates (1) with their indices, in the order of the first values of the reader; the
    /// derivatives by parameter follow.
    along: Vec<(usize, usize)>,
    reader: Reader,
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
        let places: Vec<usize> = system
            .directions
            .iter()
            .filter_map(|it| match it.cause {
                Cause::Parameter(place) => Some(place),
                Cause::Driver { .. } => None,
            })
            .collect();
        let parameters = &system.mechanism.parameters;
        let names = places
            .iter()
            .map(|it| parameters[*it].name.clone())
            .collect();
        let all = view.nominal_parameters();
        let nominal: Vec<f64> = places.iter().map(|it| all.0[*it]).collect();
        let symbols: Vec<SymbolId> = places.iter().map(|it| parameters[*it].symbol).collect();
        let points = point_slopes(&view, &symbols);
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
            places,
            names,
            modes,
            step,
            points,
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
    pub fn can_fit(observable: Observable) -> Result<(), NotDerived> {
        match observable {
            Observable::Coordinate { level: 0 | 1, .. }
            | Observable::Point { level: 0 | 1, .. } => Ok(()),
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
        for (place, value) in self.places.iter().zip(parameters) {
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
                self.slopes(
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

    /// Adds the derivatives of a quantity by every parameter. `derivatives` ends with those of all coordinates, and of
    /// all their rates, parameter by parameter.
    fn slopes(
        &self,
        observable: Observable,
        instant: &Instant,
        derivatives: &[f64],
        slopes: &mut Vec<f64>,
    ) {
        let coordinates = instant.q().len();
        let count = self.names.len();
        let first = derivatives.len().saturating_sub(2 * coordinates * count);
        let of = |parameter: usize, level: usize, place: usize| {
            let at = first + (2 * parameter + level) * coordinates + place;
            derivatives.get(at).copied().unwrap_or(f64::NAN)
        };
        match observable {
            Observable::Coordinate { place, level } => {
                slopes.extend((0..count).map(|parameter| of(parameter, level, place)));
            }
            Observable::Point { place, axis, level } => {
                let Some(own) = self.points.get(&[place, axis, level]) else {
                    slopes.extend((0..count).map(|_| f64::NAN));
                    return;
                };
                let read = own.reader.values(instant);
                let (along, direct) = read.split_at(own.along.len());
                slopes.extend((0..count).map(|parameter| {
                    let moved = own.along.iter().zip(along);
                    let moved =
                        moved.map(|((level, place), slope)| slope * of(parameter, *level, *place));
                    moved.sum::<f64>() + direct[parameter]
                }));
            }
            Observable::Reported(_) => slopes.extend((0..count).map(|_| f64::NAN)),
        }
    }
}

/// Derivatives of every component of every point and of its velocity, by coordinates, rates and parameters.
fn point_slopes(view: &Interpreted, parameters: &[SymbolId]) -> HashMap<[usize; 3], PointSlopes> {
    let system = view.system();
    let mut graph = view.pool().graph.clone();
    let coordinates = system.coordinates.iter().enumerate();
    let known: HashMap<SymbolId, (usize, usize)> = coordinates
        .flat_map(|(place, it)| [(it.position, (0, place)), (it.rate, (1, place))])
        .collect();
    let mut slopes = HashMap::new();
    for (place, output) in system.outputs.iter().enumerate() {
        for (level, components) in [output.position, output.velocity].into_iter().enumerate() {
            for (axis, expr) in components.into_iter().enumerate() {
                let mut symbols: Vec<SymbolId> = graph.symbols(expr).to_vec();
                symbols.retain(|it| known.contains_key(it));
                let along = symbols.iter().map(|it| known[it]).collect();
                symbols.extend(parameters);
                let roots: Vec<ExprId> = symbols
                    .iter()
                    .map(|it| graph.derivative(expr, *it))
                    .collect();
                let reader = Reader::new(&graph, view.layout(), &roots);
                slopes.insert([place, axis, level], PointSlopes { along, reader });
            }
        }
    }
    slopes
}
