//! Collects the sets that pictures show: all of a small sweep, evenly spread ones of a large sweep.

use std::collections::BTreeMap;

use linkwright_solver::sets::Extremes;

use super::run::Solved;
use super::sets::Sets;
use super::shown::Quantity;
use crate::report::sweep_plot::{Axis, Point, picture};

/// Largest number of sets along the axis of curves, along an axis of maps, and of scattered sets.
const CURVE_SETS: u64 = 1000;
const MAP_SETS: u64 = 80;
const SCATTERED_SETS: u64 = 4000;

/// Sets of the pictures of a sweep.
pub struct Pictured<'a> {
    sets: &'a Sets,
    quantities: &'a [Quantity],
    /// Distance of the shown indices along each axis of a grid, or among all sets.
    strides: Vec<u64>,
    /// Collected sets, each with a point for each quantity.
    taken: BTreeMap<u64, Vec<Point>>,
}

impl<'a> Pictured<'a> {
    /// Creates the empty pictures; `None` unless one or two values are varied.
    pub fn new(sets: &'a Sets, quantities: &'a [Quantity]) -> Option<Pictured<'a>> {
        let dimensions = sets.varied().len();
        let stride = |count: u64, most: u64| count.div_ceil(most).max(1);
        let strides = match sets {
            _ if dimensions > 2 => return None,
            Sets::Grid(grid) => {
                let most = if dimensions == 1 {
                    CURVE_SETS
                } else {
                    MAP_SETS
                };
                let axes = grid.axes.iter();
                axes.map(|it| stride(it.count, most)).collect()
            }
            Sets::Rows { .. } | Sets::Samples(_) => vec![stride(sets.count(), SCATTERED_SETS)],
        };
        Some(Pictured {
            sets,
            quantities,
            strides,
            taken: BTreeMap::new(),
        })
    }

    /// True if a set is shown.
    fn shows(&self, set: u64) -> bool {
        match self.sets {
            Sets::Grid(grid) => {
                let places = grid.places(set);
                let axes = places.iter().zip(&self.strides);
                axes.into_iter()
                    .all(|(place, stride)| place.is_multiple_of(*stride))
            }
            Sets::Rows { .. } | Sets::Samples(_) => set.is_multiple_of(self.strides[0]),
        }
    }

    /// Takes a set if it is shown.
    pub fn take(&mut self, solved: &Solved<'_>, extremes: &[Option<Extremes>]) {
        if !self.shows(solved.set) {
            return;
        }
        let varied = self.sets.varied().iter().zip(solved.given);
        let at = varied.map(|(varied, given)| varied.written(*given));
        let at: Vec<f64> = at.collect();
        let points = extremes.iter().map(|extremes| Point {
            at: at.clone(),
            extremes: extremes.map(|it| [it.minimum[0], it.maximum[0]]),
        });
        self.taken.insert(solved.set, points.collect());
    }

    /// Shown sets below `end` that are missing.
    pub fn missing(&self, end: u64) -> Vec<u64> {
        let missing = |set: &u64| self.shows(*set) && !self.taken.contains_key(set);
        (0..end).filter(missing).collect()
    }

    /// Draws each quantity; `None` for those of which no set is solved.
    ///
    /// # Errors
    /// Errors of the drawing library.
    pub fn draw(&self, title: &str) -> Result<Vec<Option<String>>, String> {
        let varied = self.sets.varied().iter().enumerate();
        let axes = varied.map(|(axis, varied)| Axis {
            label: varied.header(),
            values: self.values(axis),
        });
        let axes: Vec<Axis> = axes.collect();
        let drawn = self.quantities.iter().enumerate().map(|(place, quantity)| {
            // In the order of the sets, also if an interrupted run has solved some of them.
            let points = self.taken.values().map(|it| it[place].clone());
            let points: Vec<Point> = points.collect();
            let title = format!("{} of {title}", quantity.name);
            picture(&title, &quantity.header(), &axes, &points)
        });
        drawn.collect()
    }

    /// Returns the shown values of an axis of a grid, ascending; of other sets none.
    fn values(&self, axis: usize) -> Vec<f64> {
        let Sets::Grid(grid) = self.sets else {
            return Vec::new();
        };
        let (varied, own) = (&self.sets.varied()[axis], &grid.axes[axis]);
        let places =
            (0..own.count).step_by(usize::try_from(self.strides[axis]).unwrap_or(usize::MAX));
        let mut values: Vec<f64> = places.map(|it| varied.written(own.value(it))).collect();
        values.sort_by(f64::total_cmp);
        values
    }
}
