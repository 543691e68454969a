//! Computes the derivatives of the quantities of a motion by parameters.
//!
//! Coordinates, their rates, and measures of both have derived sensitivities. Those of a point follow by the chain rule from the
//! expressions of its position and velocity, which are differentiated, too.

use std::collections::HashMap;

use linkwright_codegen::stages::expr::{ExprId, SymbolId};
use linkwright_codegen::stages::system::Cause;
use linkwright_solver::derivatives::SensitivityPlaces;
use linkwright_solver::reader::Reader;
use linkwright_solver::{Instant, Interpreted, Observable, View};

/// Derivatives of all quantities by the parameters of the sensitivities of a system.
#[derive(Clone, Debug)]
pub(crate) struct Slopes {
    /// Index of each parameter among all of the mechanism.
    pub parameters: Vec<usize>,
    places: SensitivityPlaces,
    /// Index of each requested force or measure among the mechanism's measurements; `None` for forces.
    measurements: Vec<Option<usize>>,
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

impl Slopes {
    pub fn new(view: &Interpreted) -> Slopes {
        let system = view.system();
        let parameters = system.directions.iter().filter_map(|it| match it.cause {
            Cause::Parameter(place) => Some(place),
            Cause::Driver { .. } => None,
        });
        let parameters: Vec<usize> = parameters.collect();
        let symbols = parameters.iter();
        let symbols: Vec<SymbolId> = symbols
            .map(|it| system.mechanism.parameters[*it].symbol)
            .collect();
        let all = Observable::all(view.derived()).into_iter();
        let reported = all.filter(|(_, it)| matches!(it, Observable::Reported(_)));
        let measurements = reported.map(|(_, it)| it.measurement(view.derived()));
        Slopes {
            measurements: measurements.collect(),
            points: point_slopes(view, &symbols),
            places: SensitivityPlaces::of(system),
            parameters,
        }
    }

    /// Adds the derivatives of a quantity by every parameter; NaN if they are not derived. `derivatives` are those of the view at the instant.
    pub fn add(
        &self,
        observable: Observable,
        instant: &Instant,
        derivatives: &[f64],
        slopes: &mut Vec<f64>,
    ) {
        let count = self.parameters.len();
        let derivative = |place: usize| derivatives.get(place).copied().unwrap_or(f64::NAN);
        let coordinate = |parameter: usize, level: usize, place: usize| {
            derivative(self.places.coordinate(parameter, level, place))
        };
        match observable {
            Observable::Coordinate { place, level } if level <= 1 => {
                slopes.extend((0..count).map(|parameter| coordinate(parameter, level, place)));
            }
            Observable::Point { place, axis, level } if level <= 1 => {
                let Some(own) = self.points.get(&[place, axis, level]) else {
                    slopes.extend((0..count).map(|_| f64::NAN));
                    return;
                };
                let read = own.reader.values(instant);
                let (along, direct) = read.split_at(own.along.len());
                slopes.extend((0..count).map(|parameter| {
                    let moved = own.along.iter().zip(along);
                    let moved = moved.map(|((level, place), slope)| {
                        slope * coordinate(parameter, *level, *place)
                    });
                    moved.sum::<f64>() + direct[parameter]
                }));
            }
            Observable::Reported(place) => {
                let measurement = self.measurements.get(place).copied().flatten();
                slopes.extend((0..count).map(|parameter| {
                    let place = measurement.and_then(|it| self.places.measure(parameter, it));
                    place.map_or(f64::NAN, derivative)
                }));
            }
            _ => slopes.extend((0..count).map(|_| f64::NAN)),
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
