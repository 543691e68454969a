//! Compares measured columns with a motion that is followed through their times.

use std::io;

use linkwright_solver::comparison::difference;
use linkwright_solver::data::Data;
use linkwright_solver::{Comparison, Observable, Schedule, View};

use super::{Followed, Shown, Sink};

/// Measured column beside the motion.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Solved values in SI units, row by row; `None` if there is none.
    pub solved: Vec<Option<f64>>,
    /// True if whole turns do not count as a difference.
    pub is_angle: bool,
    /// Differences in SI units; `None` if no row has both values.
    pub comparison: Option<Comparison>,
}

impl<V: View> Followed<V> {
    /// Follows the motion over a schedule that requests the times of the data, and compares each measured column with it.
    ///
    /// `others` receive the instants, too, and `reached` the number of visited times.
    ///
    /// # Errors
    /// Errors of `others`, which end the motion.
    pub fn compare(
        &mut self,
        data: &Data,
        schedule: &Schedule,
        others: &mut [&mut dyn Sink],
        reached: impl FnMut(usize),
    ) -> io::Result<Vec<Compared>> {
        let measured = data.measured.iter();
        let observables = measured.map(|it| it.quantity.observable).collect();
        let mut collected = Collected {
            view: self.view.clone(),
            observables,
            times: Vec::new(),
            values: Vec::new(),
        };
        let mut sinks: Vec<&mut dyn Sink> = vec![&mut collected];
        for other in others {
            sinks.push(*other);
        }
        self.follow(schedule, &mut sinks, reached)?;
        let compared = data.measured.iter().enumerate().map(|(place, measured)| {
            let observable = measured.quantity.observable;
            let is_angle = observable.is_angle(self.view.system());
            let solved: Vec<Option<f64>> = data
                .times
                .iter()
                .map(|t| Some(collected.at(*t)?[place]).filter(|it| it.is_finite()))
                .collect();
            let rows = data.times.iter().zip(measured.values.iter().zip(&solved));
            let differences = rows.filter_map(|(t, (measured, solved))| {
                Some((*t, difference((*measured)?, (*solved)?, is_angle)))
            });
            Compared {
                comparison: Comparison::of(differences),
                solved,
                is_angle,
            }
        });
        Ok(compared.collect())
    }
}

/// Measured quantities of the motion, instant by instant.
struct Collected<V> {
    view: V,
    observables: Vec<Observable>,
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
}

impl<V> Collected<V> {
    /// Returns the values at a visited time; `None` if the time was not visited.
    fn at(&self, t: f64) -> Option<&[f64]> {
        let place = self.times.binary_search_by(|it| it.total_cmp(&t)).ok()?;
        self.values.get(place).map(Vec::as_slice)
    }
}

impl<V: View> Sink for Collected<V> {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        self.times.push(shown.instant.t());
        let values = Observable::values(&self.view, &self.observables, shown.instant);
        self.values.push(values);
        Ok(())
    }
}
