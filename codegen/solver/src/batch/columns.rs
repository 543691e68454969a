//! Reads observables from the instants of sixteen mechanisms.

use linkwright_codegen::stages::expr::Lanes;

use crate::interpreted::{InstantLanes, Interpreted, point_result};
use crate::observable::Observable;
use crate::reader::Formulas;

/// Observables with the places that they are read from.
pub(super) struct Columns {
    sources: Vec<Source>,
    /// Values of the observables at the instants that were read last.
    values: Vec<Lanes>,
    /// Code that computes points, with its registers; `None` if it is not needed.
    points: Option<(Formulas, Vec<Lanes>)>,
}

/// Place of an observable.
#[derive(Clone, Copy)]
enum Source {
    /// Index in instants.
    Slot(usize),
    /// Index among the results of the points.
    Point(usize),
    /// The program does not compute it.
    None,
}

impl Columns {
    pub fn new(blocks: &Interpreted, observables: &[Observable]) -> Columns {
        let slot = |slot: Option<usize>| slot.map_or(Source::None, Source::Slot);
        let formulas = blocks.points_of(observables);
        let source = |it: &Observable| match *it {
            Observable::Coordinate { place, level } => slot(blocks.coordinate_slot(place, level)),
            Observable::Point { place, axis, level } => match &formulas {
                Some(_) => Source::Point(point_result(place, level, axis)),
                None => slot(blocks.point_slot(place, level, axis)),
            },
            Observable::Reported(column) => slot(blocks.reported_slot(column)),
        };
        let sources: Vec<Source> = observables.iter().map(source).collect();
        Columns {
            values: vec![Lanes::splat(f64::NAN); sources.len()],
            points: formulas.map(|it| {
                let registers = it.lanes();
                (it, registers)
            }),
            sources,
        }
    }

    /// Number of observables.
    pub fn count(&self) -> usize {
        self.sources.len()
    }

    /// Reads all lanes.
    pub fn read(&mut self, instants: &InstantLanes) {
        if let Some((formulas, registers)) = &mut self.points {
            linkwright::lanes::vectorized(
                #[inline(always)]
                || formulas.evaluate_lanes(instants.values(), registers),
            );
        }
        for (value, source) in self.values.iter_mut().zip(&self.sources) {
            let lanes = match (*source, &self.points) {
                (Source::Slot(slot), _) => Some(instants.values()[slot]),
                (Source::Point(index), Some((formulas, registers))) => {
                    formulas.result_lanes(index, registers)
                }
                _ => None,
            };
            *value = lanes.unwrap_or(Lanes::splat(f64::NAN));
        }
    }

    /// Writes the observables of one lane.
    pub fn write(&self, lane: usize, row: &mut [f64]) {
        for (value, lanes) in row.iter_mut().zip(&self.values) {
            *value = lanes.0[lane];
        }
    }
}
