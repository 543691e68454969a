//! *A pose of a mechanism with free coordinates* → *how far a free coordinate moves all else, and which coordinates of bodies would do so less*.
//!
//! With K = ∂q/∂s, lengths in characteristic lengths of the mechanism, the steadiness of free coordinates is 1/‖K‖: it vanishes where one
//! of them stands still while the mechanism moves. Where equations of joints lose rank on the way it does not: the way through has a K.

use linkwright::Blocks;
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::Described;
use nalgebra::{DMatrix, DVector};

use crate::condition::{dimensionless, jacobian};
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::textbook::TextbookEquations;
use crate::view::View;

/// Which part of the best steadiness a coordinate must have to be chosen for being an angle.
const NEARLY: f64 = 0.5;

/// How free coordinates move a mechanism.
#[derive(Clone, Debug)]
pub(super) struct Freedom {
    textbook: TextbookEquations,
    /// The rows of the drivers that hold what is free.
    rows: Vec<usize>,
    /// The coordinates of bodies, and whether each is an angle.
    offered: Vec<(usize, bool)>,
}

/// A coordinate of a body in place of one that is free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exchange {
    /// Which of the free coordinates.
    pub place: usize,
    /// An index into q.
    pub coordinate: usize,
    /// How steady all that are free are then.
    pub steadiness: f64,
}

impl Freedom {
    /// Of a mechanism in which some coordinates are free.
    pub fn new(view: &Interpreted) -> Freedom {
        let system = view.system();
        let free = system.mechanism.forces.free.iter();
        let row = |joint: usize| system.rows.iter().position(|row| row.joint == joint);
        let coordinates = system.coordinates.iter().enumerate();
        let of_bodies =
            coordinates.filter(|(_, it)| matches!(it.describes, Described::Pose { .. }));
        Freedom {
            textbook: TextbookEquations::new(system),
            rows: free.filter_map(|it| row(it.joint)).collect(),
            offered: of_bodies
                .map(|(at, it)| (at, it.quantity == Quantity::Angle))
                .collect(),
        }
    }

    /// K (n × f) without dimensions; `None` where it is not finite.
    pub fn moved(&self, view: &Interpreted, frame: &Instant) -> Option<DMatrix<f64>> {
        let inputs = view.layout().inputs(frame);
        self.textbook.supply(&view.nominal_parameters(), &inputs);
        let q = DVector::from_column_slice(frame.q());
        let matrix = jacobian(&self.textbook, &q, frame.t());
        let matrix = dimensionless(&self.textbook, matrix);
        let mut moved = DMatrix::zeros(q.len(), self.rows.len());
        for (column, &row) in self.rows.iter().enumerate() {
            moved[(row, column)] = 1.0;
        }
        let is_solved = matrix.lu().solve_mut(&mut moved);
        (is_solved && moved.iter().all(|it| it.is_finite())).then_some(moved)
    }

    /// The exchanges of one coordinate that make what is free steadier, the best one first: of those that are nearly as good as it, angles
    /// before lengths.
    pub fn exchanges(&self, moved: &DMatrix<f64>) -> Vec<Exchange> {
        let own = steadiness(moved);
        let places = 0..self.rows.len();
        let pairs = places.flat_map(|place| self.offered.iter().map(move |it| (place, *it)));
        let mut found: Vec<(Exchange, bool)> = pairs
            .filter_map(|(place, (coordinate, is_angle))| {
                let steadiness = steadiness(&exchanged(moved, place, coordinate)?);
                let exchange = Exchange {
                    place,
                    coordinate,
                    steadiness,
                };
                (steadiness > own).then_some((exchange, is_angle))
            })
            .collect();
        let steadiest = found.iter().map(|(it, _)| it.steadiness);
        let wanted = NEARLY * steadiest.fold(0.0, f64::max);
        found.sort_by(|(one, one_is_angle), (other, other_is_angle)| {
            let first = |it: &Exchange, is_angle: bool| is_angle && it.steadiness >= wanted;
            let [own, others] = [first(one, *one_is_angle), first(other, *other_is_angle)];
            let by_steadiness = other.steadiness.total_cmp(&one.steadiness);
            others.cmp(&own).then(by_steadiness)
        });
        found.into_iter().map(|(exchange, _)| exchange).collect()
    }
}

/// How steady free coordinates are that move a mechanism so.
pub(super) fn steadiness(moved: &DMatrix<f64>) -> f64 {
    let size = moved.norm();
    if size > 0.0 { 1.0 / size } else { 0.0 }
}

/// K where a coordinate is free in place of another one; `None` where that one alone moves it not.
fn exchanged(moved: &DMatrix<f64>, place: usize, coordinate: usize) -> Option<DMatrix<f64>> {
    let pivot = moved[(coordinate, place)];
    if pivot == 0.0 {
        return None;
    }
    let mut change = moved.row(coordinate).into_owned();
    change[place] -= 1.0;
    let along = moved.column(place) / pivot;
    Some(moved - along * change)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// After an exchange the coordinate moves as it is moved, and all else in proportion.
    #[test]
    fn what_is_exchanged_moves_by_itself() {
        let moved = DMatrix::from_row_slice(4, 2, &[1.0, 0.0, 0.0, 1.0, 4.0, -3.0, 0.5, 2.0]);
        let other = exchanged(&moved, 0, 2).expect("it moves");
        let close = |row: usize, expected: [f64; 2]| {
            (0..2).all(|at| (other[(row, at)] - expected[at]).abs() < 1e-15)
        };
        assert!(close(2, [1.0, 0.0]) && close(1, [0.0, 1.0]));
        // s₀ = (q₂ + 3 s₁)/4.
        assert!(close(0, [0.25, 0.75]) && close(3, [0.125, 2.375]));
        assert!(exchanged(&moved, 1, 0).is_none());
    }
}
