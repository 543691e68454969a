//! *Bounds of a function and of its derivative* → *all of its zeros in a range, one by one, and what stays undecided*.
//!
//! A cell in whose bounds zero is not holds none. Neither does one in which the mean-value form excludes it. Where the derivative is
//! not zero anywhere, there is at most one zero, and the signs at the ends say whether there is. Everything else is divided, until cells
//! are smaller than [`SMALLEST`] or there have been too many: these ranges stay undecided, and no zero is anywhere else (Moore, Kearfott and
//! Cloud, Introduction to Interval Analysis, 2009, chapter 8).

use std::collections::VecDeque;

use super::interval::Interval;

/// The width of a cell that is not divided any more.
const SMALLEST: f64 = 1e-9;

/// Where a cell is divided: not in the middle, so that zeros that a person would choose do not lie on a border.
const DIVISION: f64 = 127.0 / 256.0;

/// How often a zero is bisected: all digits.
const BISECTIONS: usize = 64;

/// The zeros of a function in a range.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Zeros {
    /// One zero each.
    pub found: Vec<f64>,
    /// Where it is not known whether there are zeros.
    pub undecided: Vec<[f64; 2]>,
}

/// The zeros of a function of which these are the bounds, with those of its derivative. So many cells are looked at, and taken off.
pub(super) fn isolate(
    range: [f64; 2],
    cells: &mut usize,
    mut bounds: impl FnMut(Interval) -> [Interval; 2],
) -> Zeros {
    let mut zeros = Zeros::default();
    // The largest first, so that what is left when there have been too many is small.
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
        if high - low <= SMALLEST {
            zeros.undecided.push([low, high]);
            continue;
        }
        let division = low + DIVISION * (high - low);
        open.extend([[low, division], [division, high]]);
    }
    zeros
}

/// The zero between two places, at the first of which the function has this sign.
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
            // Rounding decides no more.
            None => return middle,
        }
    }
    low + 0.5 * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (x − 1)(x + 2) = x² + x − 2.
    #[test]
    fn all_zeros_are_found_and_no_other() {
        let square = |x: Interval| {
            let value = x.power(2).plus(x).plus(Interval::point(-2.0));
            let slope = x.times(Interval::point(2.0)).plus(Interval::point(1.0));
            [value, slope]
        };
        let zeros = isolate([-10.0, 10.0], &mut 1000, square);
        assert_eq!(zeros.undecided, Vec::<[f64; 2]>::new());
        let mut found = zeros.found;
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), 2);
        assert!((found[0] + 2.0).abs() < 1e-14 && (found[1] - 1.0).abs() < 1e-14);
    }

    /// x² has its zero where its derivative has one.
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
    fn what_was_not_looked_at_is_undecided() {
        let zeros = isolate([-10.0, 10.0], &mut 0, |x| [x, Interval::point(1.0)]);
        assert_eq!(zeros.undecided, [[-10.0, 10.0]]);
    }
}
