//! Computes the cubic pieces of the C² spline through given points.
//!
//! The second derivatives at the points solve a tridiagonal system. For a periodic spline, two more entries close the system to
//! a ring, and are handled by the Sherman-Morrison formula. The rows are strictly diagonally dominant, so elimination without
//! pivoting is stable. Source: de Boor, *A Practical Guide to Splines*, 2001, chapter IV.

use crate::expr::Spline;

/// End conditions of a spline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) enum Ends {
    /// Zero curvature; continued by straight lines.
    Natural,
    /// Prescribed slopes; continued by straight lines, with a jump of the curvature.
    Clamped([f64; 2]),
    /// Periodic continuation.
    Periodic,
}

/// Returns the spline through the points (x, y), with increasing x; at least two points, or three if periodic. A coefficient is
/// not finite if points are too close together.
pub(in super::super) fn spline(name: &str, points: &[[f64; 2]], ends: Ends) -> Spline {
    let widths: Vec<f64> = points.windows(2).map(|two| two[1][0] - two[0][0]).collect();
    let chords: Vec<f64> = points
        .windows(2)
        .zip(&widths)
        .map(|(two, width)| (two[1][1] - two[0][1]) / width)
        .collect();
    let bends = match ends {
        Ends::Periodic => ring(&widths, &chords),
        Ends::Natural | Ends::Clamped(_) => open(&widths, &chords, ends),
    };
    let mut pieces: Vec<[f64; 4]> = (0..widths.len())
        .map(|place| {
            let (width, [from, to]) = (widths[place], [bends[place], bends[place + 1]]);
            let slope = chords[place] - width * (2.0 * from + to) / 6.0;
            let third = (to - from) / (6.0 * width);
            [points[place][1], slope, from / 2.0, third]
        })
        .collect();
    let last = widths.len() - 1;
    let end = match ends {
        Ends::Natural => {
            let slope = chords[last] + widths[last] * (bends[last] + 2.0 * bends[last + 1]) / 6.0;
            [points[last + 1][1], slope, 0.0, 0.0]
        }
        Ends::Clamped([first, slope]) => {
            // The prescribed slope itself, without rounding.
            pieces[0][1] = first;
            [points[last + 1][1], slope, 0.0, 0.0]
        }
        // Reached only by rounding.
        Ends::Periodic => pieces[0],
    };
    pieces.push(end);
    let starts: Vec<f64> = points.iter().map(|point| point[0]).collect();
    let period = starts[last + 1] - starts[0];
    Spline {
        name: name.to_string(),
        starts,
        pieces,
        period: (ends == Ends::Periodic).then_some(period),
    }
}

/// Returns the second derivatives at the points of a spline with two ends.
fn open(widths: &[f64], chords: &[f64], ends: Ends) -> Vec<f64> {
    let count = widths.len() + 1;
    let mut system = Tridiagonal::zero(count);
    for place in 1..count - 1 {
        system.row(place, widths, chords, [place - 1, place]);
    }
    let last = count - 1;
    if let Ends::Clamped([first, slope]) = ends {
        let (before, after) = (widths[0], widths[last - 1]);
        system.diagonal[0] = 2.0 * before;
        system.upper[0] = before;
        system.right[0] = 6.0 * (chords[0] - first);
        system.lower[last] = after;
        system.diagonal[last] = 2.0 * after;
        system.right[last] = 6.0 * (slope - chords[last - 1]);
    } else {
        system.diagonal[0] = 1.0;
        system.diagonal[last] = 1.0;
    }
    system.solve()
}

/// Returns the second derivatives at the points of a periodic spline; the first is repeated at the end.
fn ring(widths: &[f64], chords: &[f64]) -> Vec<f64> {
    let count = widths.len();
    let mut system = Tridiagonal::zero(count);
    system.row(0, widths, chords, [count - 1, 0]);
    for place in 1..count {
        system.row(place, widths, chords, [place - 1, place]);
    }
    // Both entries that close the ring are the width of the last piece. A = T + u vᵀ with u = (γ, 0, …, w), v = (1, 0, …, w/γ).
    let (closing, last) = (widths[count - 1], count - 1);
    let gamma = -system.diagonal[0];
    system.diagonal[0] -= gamma;
    system.diagonal[last] -= closing * closing / gamma;
    let mut correction = system.clone();
    correction.right = vec![0.0; count];
    correction.right[0] = gamma;
    correction.right[last] = closing;
    let (mut bends, correction) = (system.solve(), correction.solve());
    let along = |vector: &[f64]| vector[0] + closing / gamma * vector[last];
    let share = along(&bends) / (1.0 + along(&correction));
    for (bend, part) in bends.iter_mut().zip(correction) {
        *bend -= share * part;
    }
    bends.push(bends[0]);
    bends
}

/// A tridiagonal system of equations.
#[derive(Clone, Debug)]
struct Tridiagonal {
    /// Entries left of the diagonal; the first is unused.
    lower: Vec<f64>,
    diagonal: Vec<f64>,
    /// Entries right of the diagonal; the last is unused.
    upper: Vec<f64>,
    right: Vec<f64>,
}

impl Tridiagonal {
    fn zero(count: usize) -> Tridiagonal {
        let zeros = vec![0.0; count];
        Tridiagonal {
            lower: zeros.clone(),
            diagonal: zeros.clone(),
            upper: zeros.clone(),
            right: zeros,
        }
    }

    /// Sets the row of a point between two pieces, where the slope is continuous.
    fn row(&mut self, place: usize, widths: &[f64], chords: &[f64], [before, after]: [usize; 2]) {
        self.lower[place] = widths[before];
        self.diagonal[place] = 2.0 * (widths[before] + widths[after]);
        self.upper[place] = widths[after];
        self.right[place] = 6.0 * (chords[after] - chords[before]);
    }

    /// Solves the system by elimination and back substitution.
    fn solve(mut self) -> Vec<f64> {
        let count = self.diagonal.len();
        for place in 1..count {
            let factor = self.lower[place] / self.diagonal[place - 1];
            self.diagonal[place] -= factor * self.upper[place - 1];
            self.right[place] -= factor * self.right[place - 1];
        }
        let mut solution = self.right;
        for place in (0..count).rev() {
            let known = match solution.get(place + 1) {
                Some(next) => self.upper[place] * next,
                None => 0.0,
            };
            solution[place] = (solution[place] - known) / self.diagonal[place];
        }
        solution
    }
}
