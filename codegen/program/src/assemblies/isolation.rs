//! Isolates all zeros of a function in a range, from bounds of the function and its derivative, and lists undecided cells.
//!
//! A cell has no zero if its bounds, or those of the mean-value form, exclude zero. If the derivative has no zero in a cell,
//! signs at the ends decide between one zero and none. Other cells are divided until they are smaller than [`MIN_WIDTH`] or their
//! number exceeds the limit. These cells stay undecided, and no zero lies outside of all cells (Moore, Kearfott and Cloud,
//! Introduction to Interval Analysis, 2009, chapter 8).

use std::collections::VecDeque;

use super::interval::Interval;

/// Width of a cell that is not divided any more.
const MIN_WIDTH: f64 = 1e-9;

/// Fraction at which a cell is divided. It differs from 1/2, so that zeros at simple values do not lie on a border.
const DIVISION: f64 = 127.0 / 256.0;

/// Number of bisections of a zero, enough for all digits.
const BISECTIONS: usize = 64;

/// Zeros of a function in a range.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Zeros {
    /// Zeros, one per entry.
    pub found: Vec<f64>,
    /// Cells that may have zeros.
    pub undecided: Vec<[f64; 2]>,
}

/// Isolates the zeros of a function by bounds of the function and its derivative. Decreases `cells` by the number of examined
/// cells, and stops at zero.
pub(super) fn isolate(
    range: [f64; 2],
    cells: &mut usize,
    mut bounds: impl FnMut(Interval) -> [Interval; 2],
) -> Zeros {
    let mut zeros = Zeros::default();
    // Large cells come first, so that cells left at the limit are small.
    let mut open = VecDeque::from([range]);
    while let Some([low, high]) = open.pop_front() {
        if *cells == 0 {
            zeros.undecided.push([low, high]);
            continue;
        }
        *cells -= 1;
        let cell = Interval::new(low, high);
        let [value, slope] = bounds(cell);
        if !value.holds(0.0) {
            continue;
        }
        if value.defined && slope.defined {
            let middle = cell.middle();
            let [at, _] = bounds(Interval::point(middle));
            let from = Interval::new((low - middle).next_down(), (high - middle).next_up());
            if !at.plus(slope.times(from)).holds(0.0) {
                continue;
            }
            if !slope.holds(0.0) {
                let mut sign = |place: f64| {
                    let [at, _] = bounds(Interval::point(place));
                    match (at.low > 0.0, at.high < 0.0) {
                        (true, _) => Some(true),
                        (_, true) => Some(false),
                        _ => None,
                    }
                };
                match [sign(low), sign(high)] {
                    [Some(first), Some(last)] if first == last => continue,
                    [Some(first), Some(_)] => {
                        zeros.found.push(bisected([low, high], first, &mut sign));
                        continue;
                    }
                    _ => {}
                }
            }
        }
        if high - low <= MIN_WIDTH {
            zeros.undecided.push([low, high]);
            continue;
        }
        let division = low + DIVISION * (high - low);
        open.extend([[low, division], [division, high]]);
    }
    zeros
}

/// Returns the zero between two points by bisection; `first` is the sign at the lower one.
fn bisected(
    [mut low, mut high]: [f64; 2],
    first: bool,
    sign: &mut impl FnMut(f64) -> Option<bool>,
) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = low + 0.5 * (high - low);
        match sign(middle) {
            Some(own) if own == first => low = middle,
            Some(_) => high = middle,
            // Rounding hides further digits.
            None => return middle,
        }
    }
    low + 0.5 * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Isolates the zeros of (x − 1)(x + 2) = x² + x − 2.
    #[test]
    fn all_zeros_are_found_and_no_other() {
        let square = |x: Interval| {
            let value = x.power(2).plus(x).plus(Interval::point(-2.0));
            let slope = x.times(Interval::point(2.0)).plus(Interval::point(1.0));
            [value, slope]
        };
        let zeros = isolate([-10.0, 10.0], &mut 1000, square);
        assert_eq!(zeros.undecided, Vec::<[f64; 2]>::new());
        let mut isolated = zeros.found;
        isolated.sort_by(f64::total_cmp);
        assert_eq!(isolated.len(), 2);
        assert!((isolated[0] + 2.0).abs() < 1e-14 && (isolated[1] - 1.0).abs() < 1e-14);
    }

    /// Bounds x², whose zero is a zero of the derivative too.
    #[test]
    fn a_double_zero_stays_undecided() {
        let zeros = isolate([-1.0, 2.0], &mut 1000, |x| {
            [x.power(2), x.times(Interval::point(2.0))]
        });
        assert!(zeros.found.is_empty() && !zeros.undecided.is_empty());
        let mut undecided = zeros.undecided.iter();
        assert!(undecided.any(|[low, high]| *low <= 0.0 && 0.0 <= *high));
        let mut undecided = zeros.undecided.iter();
        assert!(undecided.all(|[low, high]| low.abs().max(high.abs()) < 1e-6));
    }

    #[test]
    fn unexamined_cells_are_undecided() {
        let zeros = isolate([-10.0, 10.0], &mut 0, |x| [x, Interval::point(1.0)]);
        assert_eq!(zeros.undecided, [[-10.0, 10.0]]);
    }
}
