//! Bounds determinants, coordinates, points and measures of positions in each window of a motion, and limits the width of these bounds.

use linkwright_codegen::stages::assemblies::Interval;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::System;

use super::functions::{Functions, Writing, is_bounded};
use super::matrices::normalized_determinant;
use super::prover::{Node, Prover, Window};
use super::window::Verified;
use super::{Determinant, Enclosed, Proven};
use crate::checked_part::CheckedPart;
use crate::interpreted::Interpreted;
use crate::measures::MeasuredPart;
use crate::view::View;

/// Smallest bound of a determinant as a part of its smallest located value; one half is promised.
const LEAST: f64 = 0.625;

/// Overshoot of bounds at each end, as a part of the range that frames sweep; a tenth of the range is promised for both ends together.
const BEYOND: f64 = 0.04;

/// Overshoot that is always permitted, as a part of a radian or of the largest swept length: a quantity at rest sweeps no range.
const ALWAYS: f64 = 1e-6;

/// Distance from an end of a limit, relative to the value, that bounds resolve.
const RESOLUTION: f64 = 1e-8;

/// Lower and upper bound.
pub(super) type Bounds = [f64; 2];

/// Limit of bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit(Bounds);

impl Limit {
    pub fn holds(&self, [low, high]: Bounds) -> bool {
        self.0[0] <= low && high <= self.0[1]
    }
}

/// Quantities to be bounded.
#[derive(Clone, Debug)]
pub(super) struct Claims {
    measures: Vec<(MeasuredPart, Functions)>,
    /// Smallest normalized determinant of each block: located, and as a magnitude of its measure.
    located: Vec<[f64; 2]>,
    /// True for each coordinate that is an angle.
    are_angles: Vec<bool>,
    points: Vec<(usize, Functions)>,
    /// Quantities of `measure` statements: indices into the measurements of positions, with their functions.
    quantities: Vec<(usize, Functions)>,
    /// Ends of the `limit` statements of these quantities.
    ends: Vec<[Option<f64>; 2]>,
}

impl Claims {
    pub fn new(
        interpreted: &Interpreted,
        (measured, values): (Vec<MeasuredPart>, Vec<ExprId>),
        parts: &[CheckedPart],
        points: &[usize],
        writing: &mut Writing<'_>,
    ) -> Claims {
        let mut rest = values.as_slice();
        let (mut measures, mut located) = (Vec::new(), Vec::new());
        for part in measured {
            let count = part.order().map_or(1, |order| order * order);
            let (own, others) = rest.split_at(2 * count);
            rest = others;
            let approaches = parts.iter().filter_map(|it| it.approach.as_ref());
            let mut approaches = approaches.filter(|it| it.part == part);
            let Some(approach) = approaches.next() else {
                continue;
            };
            located.push([approach.measure, approach.size]);
            measures.push((part, writing.functions(&own[..count])));
        }
        let system = interpreted.system();
        let functions = |&point: &usize| {
            let position = system.outputs[point].position;
            (point, writing.functions(&position))
        };
        let points = points.iter().map(functions).collect();
        let measurements = system.mechanism.measurements.iter().enumerate();
        let positions = measurements.filter(|(_, measurement)| measurement.order == 0);
        let quantities = positions.map(|(place, _)| {
            let value = writing.without_definitions(system.measures.values[place]);
            (place, writing.functions(&[value]))
        });
        let quantities: Vec<(usize, Functions)> = quantities.collect();
        let ends = quantities.iter().map(|(place, _)| {
            let mut limits = system.mechanism.limits.iter();
            let limit = limits.find(|it| it.measurement == *place);
            limit.map_or([None; 2], |it| it.ends)
        });
        Claims {
            ends: ends.collect(),
            quantities,
            measures,
            located,
            are_angles: {
                let coordinates = system.coordinates.iter();
                coordinates
                    .map(|it| it.quantity == Quantity::Angle)
                    .collect()
            },
            points,
        }
    }

    /// Returns the bounds in a window: of determinants, of coordinates, of points, of quantities.
    pub fn bounds(&self, verified: &Verified) -> Vec<Bounds> {
        let measures = self.measures.iter().map(|(part, functions)| {
            let values = verified.values(functions);
            match part.order() {
                None => size(Interval::point(part.scale()).times(values[0])),
                Some(order) => {
                    let rows: Vec<Vec<Interval>> = values
                        .chunks_exact(order)
                        .map(<[Interval]>::to_vec)
                        .collect();
                    [normalized_determinant(&rows), 1.0]
                }
            }
        });
        let coordinates = (0..self.are_angles.len()).map(|it| bounds(verified.unknown(it)));
        let points = self.points.iter().flat_map(|(_, functions)| {
            let values = verified.values(functions);
            [bounds(values[0]), bounds(values[1])]
        });
        let quantities = self.quantities.iter();
        let quantities = quantities.map(|(_, functions)| bounds(verified.values(functions)[0]));
        let places = coordinates.chain(points);
        measures.chain(places).chain(quantities).collect()
    }

    /// Returns the ranges that frames sweep, without those of measures.
    fn swept(&self, nodes: &[Node], windows: &[Window]) -> Vec<Bounds> {
        let first = windows.first().map(|window| window.ends[0]);
        let used = windows.iter().map(|window| window.ends[1]);
        let mut swept: Vec<Bounds> = Vec::new();
        for node in first.into_iter().chain(used) {
            let bounds = self.bounds(&nodes[node].verified);
            let ranges = bounds[self.measures.len()..].iter();
            let middles = ranges.map(|[low, high]| low + 0.5 * (high - low));
            if swept.is_empty() {
                swept = middles.map(|it| [it; 2]).collect();
                continue;
            }
            for (both, value) in swept.iter_mut().zip(middles) {
                *both = [both[0].min(value), both[1].max(value)];
            }
        }
        swept
    }

    /// Returns the limits of the bounds in every window.
    pub fn limits(&self, nodes: &[Node], windows: &[Window]) -> Vec<Limit> {
        let swept = self.swept(nodes, windows);
        let is_angle = |place: usize| self.are_angles.get(place).copied().unwrap_or(false);
        let lengths = swept
            .iter()
            .enumerate()
            .filter(|(place, _)| !is_angle(*place));
        let lengths = lengths.flat_map(|(_, own)| own).map(|it| it.abs());
        let largest = lengths.fold(0.0, f64::max);
        let measures = self
            .located
            .iter()
            .map(|&[_, size]| [LEAST * size, f64::INFINITY]);
        let first = self.are_angles.len() + 2 * self.points.len();
        let others = swept.iter().enumerate().map(|(place, &[low, high])| {
            let always = ALWAYS * if is_angle(place) { 1.0 } else { largest };
            let beyond = BEYOND * (high - low) + always;
            let limited = place.checked_sub(first).map(|it| self.ends[it]);
            let [end_below, end_above] = limited.unwrap_or_default();
            [
                low - beyond.min(resolved(end_below.map(|end| low - end), low)),
                high + beyond.min(resolved(end_above.map(|end| end - high), high)),
            ]
        });
        measures.chain(others).map(Limit).collect()
    }

    /// Returns the bounds that hold in all windows.
    pub fn proven(&self, system: &System, prover: &Prover<'_>, windows: &[Window]) -> Proven {
        let swept = self.swept(&prover.nodes, windows);
        let mut all: Vec<Bounds> = match windows.first() {
            Some(window) => window.bounds.clone(),
            None => self.bounds(&prover.nodes[0].verified),
        };
        for window in windows {
            for (all, own) in all.iter_mut().zip(&window.bounds) {
                *all = [all[0].min(own[0]), all[1].max(own[1])];
            }
        }
        let (measures, others) = all.split_at(self.measures.len());
        let determinants = self.measures.iter().zip(&self.located).zip(measures);
        let determinants = determinants.map(|(((part, _), &[located, _]), &[low, high])| {
            let least = match part.is_relative {
                // The reference of a relative measure is at most `high`.
                true => (low / high).next_down().max(0.0),
                false => low,
            };
            Determinant {
                block: part.block,
                part: part.part,
                least,
                located,
            }
        });
        let enclosed = |name: String, is_angle: bool, place: usize| Enclosed {
            name,
            is_angle,
            bounds: others[place],
            swept: swept.get(place).copied().unwrap_or(others[place]),
        };
        let coordinates = system.coordinates.iter().enumerate();
        let coordinates = coordinates
            .map(|(place, own)| enclosed(own.name.clone(), self.are_angles[place], place));
        let points = self.points.iter().enumerate().map(|(place, (point, _))| {
            let name = &system.outputs[*point].name;
            let at = self.are_angles.len() + 2 * place;
            [
                enclosed(name.clone(), false, at),
                enclosed(name.clone(), false, at + 1),
            ]
        });
        let first = self.are_angles.len() + 2 * self.points.len();
        let quantities = self.quantities.iter().enumerate();
        let quantities = quantities.map(|(place, (measurement, _))| {
            let name = system.mechanism.measurements[*measurement].name.clone();
            (*measurement, enclosed(name, false, first + place))
        });
        Proven {
            measures: quantities.collect(),
            determinants: determinants.collect(),
            coordinates: coordinates.collect(),
            points: points.collect(),
        }
    }
}

/// Returns the distance from the end of a limit that bounds must keep; infinite if there is none, or if they cannot resolve it.
fn resolved(distance: Option<f64>, value: f64) -> f64 {
    let distance = distance.filter(|it| *it > RESOLUTION * value.abs());
    distance.unwrap_or(f64::INFINITY)
}

/// Returns the bounds of an interval; infinite if the interval is unbounded.
fn bounds(value: Interval) -> Bounds {
    match is_bounded(value) {
        true => [value.low, value.high],
        false => [f64::NEG_INFINITY, f64::INFINITY],
    }
}

/// Returns the bounds of a magnitude.
fn size(value: Interval) -> Bounds {
    let [low, high] = bounds(value);
    match low <= 0.0 && high >= 0.0 {
        true => [0.0, high.max(-low)],
        false => [low.abs().min(high.abs()), low.abs().max(high.abs())],
    }
}
