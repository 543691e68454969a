//! Evaluates a table of cubic pieces and its first three derivatives.
//!
//! The pieces are computed when code is generated. The author of the table guarantees that they join.

use crate::math::Real;

/// Cubic pieces side by side, `N` of them, each valid from its start to the next; the last one is unbounded. Before the
/// first start its tangent holds.
///
/// ```
/// use linkwright::generated::Table;
/// // x² from 0 to 1, then its tangent 1 + 2 (x − 1).
/// const SQUARE: Table<2> = Table {
///     starts: [0.0, 1.0],
///     pieces: [[0.0, 0.0, 1.0, 0.0], [1.0, 2.0, 0.0, 0.0]],
///     spacing: None,
///     period: None,
/// };
/// assert_eq!(SQUARE.at(0.5), [0.25, 1.0, 2.0, 0.0]);
/// assert_eq!(SQUARE.at(2.0), [3.0, 2.0, 0.0, 0.0]);
/// assert_eq!(SQUARE.at(-2.0), [0.0, 0.0, 0.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table<const N: usize, T = f64> {
    /// Start of each piece, ascending.
    pub starts: [T; N],
    /// Coefficients of the powers 0 to 3 of the distance from each start.
    pub pieces: [[T; 4]; N],
    /// Distance between starts that are equally spaced up to rounding: the piece is then found without a search. `None`
    /// otherwise.
    pub spacing: Option<T>,
    /// Period of the table, from the first start to the last, positive; `None` if the table does not repeat.
    pub period: Option<T>,
}

impl<const N: usize, T: Real> Table<N, T> {
    /// Returns the value and the first three derivatives. NaN if `x` is not finite and the table does not end in a
    /// constant; zeros for a table without pieces.
    #[inline]
    pub fn at(&self, x: T) -> [T; 4] {
        let (Some(&first), Some(&[height, slope, _, _])) =
            (self.starts.first(), self.pieces.first())
        else {
            return [T::ZERO; 4];
        };
        let x = match self.period {
            Some(period) => x - period * ((x - first) / period).floor(),
            None => x,
        };
        let begun = self.pieces_begun(first, x);
        let begun = match self.period {
            // Rounding may move an argument into the period just before its start, where the first piece continues.
            Some(_) => begun.max(1),
            None => begun,
        };
        let place = begun.checked_sub(1);
        let start_and_piece =
            place.and_then(|place| self.starts.get(place).zip(self.pieces.get(place)));
        let Some((&start, &[a, b, c, d])) = start_and_piece else {
            return [height + slope * (x - first), slope, T::ZERO, T::ZERO];
        };
        let along = x - start;
        let [two, three, six] = [2.0, 3.0, 6.0].map(T::from_f64);
        [
            a + along * (b + along * (c + along * d)),
            b + along * (two * c + along * (three * d)),
            two * c + along * (six * d),
            six * d,
        ]
    }

    /// Number of pieces that start at `x` or before.
    #[inline]
    fn pieces_begun(&self, first: T, x: T) -> usize {
        let Some(spacing) = self.spacing else {
            return self.starts.partition_point(|&start| start <= x);
        };
        // Negative quotients and NaN become 0, and large ones the last index: a conversion saturates.
        let guess = (((x - first) / spacing).to_f64() as usize).min(N.saturating_sub(1));
        // Rounding may move an argument beside a start into the neighbouring piece.
        let begun = |place: usize| self.starts.get(place).is_some_and(|&start| start <= x);
        if !begun(guess) {
            guess
        } else if begun(guess + 1) {
            guess + 2
        } else {
            guess + 1
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    /// Steps of height 0, 1, 2, 3 that start at `starts`.
    fn steps<T: crate::math::Real>(starts: [T; 4], spacing: Option<T>) -> Table<4, T> {
        let height = |step: f64| [T::from_f64(step), T::ZERO, T::ZERO, T::ZERO];
        Table {
            starts,
            pieces: [0.0, 1.0, 2.0, 3.0].map(height),
            spacing,
            period: None,
        }
    }

    #[test]
    fn equally_spaced_starts_are_found_as_by_search() {
        let starts: [f64; 4] = [0.1, 0.2, 0.1 + 0.2, 0.4];
        let (searched, counted) = (steps(starts, None), steps(starts, Some(0.1)));
        for start in starts {
            for x in [start.next_down(), start, start.next_up(), start + 0.05] {
                assert_eq!(searched.at(x), counted.at(x), "{x}");
            }
        }
        assert_eq!(counted.at(0.1 + 0.2)[0], 2.0);
        assert_eq!(counted.at((0.1_f64 + 0.2).next_down())[0], 1.0);
        assert_eq!(counted.at(1e300)[0], 3.0);
        assert_eq!(counted.at(-1e300)[0], 0.0);
        let single = steps([0.1_f32, 0.2, 0.3, 0.4], Some(0.1));
        assert_eq!(
            [0.1, 0.2, 0.3, 0.4].map(|x| single.at(x)[0]),
            [0.0, 1.0, 2.0, 3.0]
        );
    }

    /// The cubic 1 + x + 2 x² + 3 x³ of the first piece holds on both sides of each boundary between periods, up to
    /// rounding.
    #[test]
    fn a_period_goes_on_beside_its_start_wherever_it_starts() {
        const PERIOD: f64 = 1.0;
        for first in [0.2, -0.7, 0.1 + 0.2, 1e-3, 5.0 / 7.0, -123.4] {
            let starts = [first, first + 0.3, first + 0.7, first + PERIOD];
            let piece = [1.0, 1.0, 2.0, 3.0];
            let table = Table {
                pieces: [piece, [0.0; 4], piece.map(|_| f64::NAN), piece],
                period: Some(starts[3] - first),
                ..steps(starts, None)
            };
            for number in -40..40 {
                let boundary = first + f64::from(number) * PERIOD;
                for x in [boundary.next_down(), boundary, boundary.next_up()] {
                    let [value, slope, second, third] = table.at(x);
                    if value.is_nan() {
                        // The end of the period before.
                        continue;
                    }
                    assert!(
                        (value - 1.0).abs() < 1e-12 && (slope - 1.0).abs() < 1e-12,
                        "{first} {x}"
                    );
                    assert!(
                        (second - 4.0).abs() < 1e-11 && third == 18.0,
                        "{first} {x}: {second}"
                    );
                }
            }
        }
    }

    #[test]
    fn argument_that_is_not_finite_gives_no_finite_value() {
        let sloped = Table {
            pieces: [[0.0, 1.0, 0.0, 0.0]; 4],
            ..steps([0.0, 1.0, 2.0, 3.0], Some(1.0))
        };
        for spacing in [None, Some(1.0)] {
            let table = Table { spacing, ..sloped };
            assert!(table.at(f64::NAN)[0].is_nan());
            assert!(!table.at(f64::INFINITY)[0].is_finite());
            assert!(!table.at(f64::NEG_INFINITY)[0].is_finite());
            let repeated = Table {
                period: Some(3.0),
                ..table
            };
            assert!(repeated.at(f64::INFINITY)[0].is_nan());
        }
        let none: Table<0> = Table {
            starts: [],
            pieces: [],
            spacing: None,
            period: None,
        };
        assert_eq!(none.at(1.0), [0.0; 4]);
    }
}
