//! Evaluates the requests of `transmission` and `sensitivity` statements as named columns.
//!
//! A transmission is the derivative of a point or coordinate by the value of a driver. A sensitivity is that of a coordinate, its
//! rate or a measure by a parameter. Both hold at a fixed time, in SI units.

use linkwright_codegen::stages::model::Requested;
use linkwright_codegen::stages::program::{Found, Program};
use linkwright_codegen::stages::system::{Cause, System};

use crate::instant::Layout;

/// Highest order of differentiation of measures with sensitivities: that of rates.
pub(crate) const EXACT_ORDER: usize = 1;

/// Returns the names of derivatives, each with its SI unit: `K_x per length(N, M)`, `phi2 per L2`, `phi2_d per L2`.
///
/// Transmissions come first, quantity by quantity and driver by driver, then for each parameter all coordinates, all of their
/// rates, and the measures of positions and rates. Empty if nothing is requested.
pub fn names(system: &System) -> Vec<(String, String)> {
    let mechanism = &system.mechanism;
    let (drivers, parameters): (Vec<_>, Vec<_>) = system
        .directions
        .iter()
        .partition(|direction| !direction.is_parameter());
    let mut names = Vec::new();
    for requested in &mechanism.transmissions {
        for (row, unit) in components(system, *requested) {
            names.extend(drivers.iter().map(|it| {
                let (cause, of_cause) = cause(system, it.cause);
                (format!("{row} per {cause}"), quotient(&unit, &of_cause))
            }));
        }
    }
    for direction in parameters {
        let (by, of_cause) = cause(system, direction.cause);
        for (suffix, rate) in [("", ""), ("_d", "/s")] {
            let coordinates = system.coordinates.iter();
            names.extend(coordinates.map(|it| {
                let unit = format!("{}{rate}", it.quantity.unit());
                (
                    format!("{}{suffix} per {by}", it.name),
                    quotient(&unit, &of_cause),
                )
            }));
        }
        let measures = mechanism
            .measurements
            .iter()
            .filter(|it| it.order <= EXACT_ORDER);
        names.extend(measures.map(|it| {
            let unit = quotient(&it.unit(), &of_cause);
            (format!("{} per {by}", it.name), unit)
        }));
    }
    names
}

/// Returns name and unit of the denominator of a derivative.
fn cause(system: &System, cause: Cause) -> (&str, String) {
    let mechanism = &system.mechanism;
    match cause {
        Cause::Driver { joint, .. } => {
            let label = mechanism.joints[joint].label.as_str();
            let mut driven = system.driven();
            let quantity = driven.find(|it| it.1 == joint).map(|it| it.2);
            (
                label.strip_prefix("drive ").unwrap_or(label),
                quantity.map_or(String::new(), |it| it.unit()),
            )
        }
        Cause::Parameter(place) => {
            let parameter = &mechanism.parameters[place];
            (parameter.name.as_str(), parameter.dimension.unit_if_known())
        }
    }
}

/// Returns the unit of a quotient, `m/rad`; empty for a plain number.
fn quotient(over: &str, under: &str) -> String {
    if over == under {
        return String::new();
    }
    // The rate of a length per length is in 1/s.
    if let Some(rest) = over.strip_prefix(under).filter(|it| it.starts_with('/')) {
        return format!("1{rest}");
    }
    // Each factor of the divisor divides: m/(N*m) is m/N/m.
    let divisor: String = under
        .chars()
        .map(|it| match it {
            '*' => '/',
            '/' => '*',
            other => other,
        })
        .collect();
    match (over, under) {
        (over, "") => over.to_string(),
        ("", _) => format!("1/{divisor}"),
        _ => format!("{over}/{divisor}"),
    }
}

/// Returns the components of a requested transmission, each with its unit.
fn components(system: &System, requested: Requested) -> Vec<(String, String)> {
    match requested {
        Requested::Point(place) => {
            let name = &system.outputs[place].name;
            let axes = ["x", "y"].map(|axis| (format!("{name}_{axis}"), "m".to_string()));
            axes.to_vec()
        }
        Requested::Coordinate(place) => {
            let coordinate = &system.coordinates[place];
            vec![(coordinate.name.clone(), coordinate.quantity.unit())]
        }
        Requested::Measure(place) => {
            let measure = &system.mechanism.measurements[place];
            vec![(measure.name.clone(), measure.unit())]
        }
    }
}

/// Places of sensitivities among the derivatives of a system, in the order of [`names`].
#[derive(Clone, Debug)]
pub struct SensitivityPlaces {
    /// Place of the first sensitivity: transmissions precede it.
    first: usize,
    /// Number of coordinates.
    coordinates: usize,
    /// Index of each measure of positions and rates among the mechanism's measurements.
    measures: Vec<usize>,
}

impl SensitivityPlaces {
    /// Returns the places of the sensitivities of a system.
    pub fn of(system: &System) -> SensitivityPlaces {
        let measurements = system.mechanism.measurements.iter().enumerate();
        let exact = measurements.filter(|(_, it)| it.order <= EXACT_ORDER);
        let mut places = SensitivityPlaces {
            first: 0,
            coordinates: system.coordinates.len(),
            measures: exact.map(|it| it.0).collect(),
        };
        let parameters = system.directions.iter().filter(|it| it.is_parameter());
        let count = parameters.count() * places.of_parameter();
        places.first = names(system).len().saturating_sub(count);
        places
    }

    /// Number of sensitivities to one parameter.
    fn of_parameter(&self) -> usize {
        2 * self.coordinates + self.measures.len()
    }

    /// Returns the place of the sensitivity of a coordinate (level 0) or its rate (1) to a parameter, by its index among the parameters of
    /// sensitivities.
    pub fn coordinate(&self, parameter: usize, level: usize, coordinate: usize) -> usize {
        self.first + parameter * self.of_parameter() + level * self.coordinates + coordinate
    }

    /// Returns the place of the sensitivity of a measure, by its index among the mechanism's measurements; `None` for accelerations and
    /// forces.
    pub fn measure(&self, parameter: usize, measurement: usize) -> Option<usize> {
        let rank = self.measures.iter().position(|it| *it == measurement)?;
        Some(self.coordinate(parameter, 2, 0) + rank)
    }
}

/// Source of a derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Derivative {
    /// Index among the values of an instant.
    Kept(usize),
    /// Constant value.
    Constant(f64),
}

/// Returns the sources of derivatives in a program, in the order of [`names`].
pub(crate) fn of_program(program: &Program, layout: &Layout) -> Vec<Derivative> {
    let kept = |symbol| match layout.slot(symbol) {
        Some(slot) => Derivative::Kept(slot),
        None => Derivative::Constant(f64::NAN),
    };
    let derivative = |derivative: &Found| match *derivative {
        Found::Field(symbol) => kept(symbol),
        Found::Constant(value) => Derivative::Constant(value),
    };
    let mut all = Vec::new();
    for transmission in &program.transmissions {
        for row in 0..transmission.rows.len() {
            all.extend(transmission.columns.iter().map(|column| kept(column[row])));
        }
    }
    for sensitivity in &program.sensitivities {
        for level in 0..2 {
            let coordinates = sensitivity.coordinates.iter().flatten();
            all.extend(coordinates.map(|both| derivative(&both[level])));
        }
        let quantities = sensitivity.quantities.iter();
        let measures = quantities.filter(|it| it.is_measure);
        all.extend(measures.flat_map(|it| &it.levels).flatten().map(derivative));
    }
    all
}
