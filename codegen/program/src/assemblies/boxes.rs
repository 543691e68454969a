//! Isolates all common zeros of two functions of two unknowns in a range, and lists undecided boxes.
//!
//! A box contains no zero if bounds of a function, or the mean-value form, exclude zero. The same holds if Krawczyk's operator
//! maps the box outside itself. If this operator maps a box into itself, the box has exactly one zero (Krawczyk,
//! Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4 (1969); Moore, Kearfott and Cloud,
//! Introduction to Interval Analysis, 2009, chapter 8). Around each zero of Newton-Raphson, the largest box without other zeros
//! is searched; boxes within it are skipped. Other boxes are divided until they are smaller than [`SMALLEST_BOX`] or their number
//! exceeds the limit.

use std::collections::VecDeque;

use super::interval::Interval;

/// Width of a box that is not divided any more, in the scale of the range.
const SMALLEST_BOX: f64 = 1e-7;

/// Fraction at which a box is divided. It differs from 1/2, so that zeros at simple values do not lie on a border.
const DIVISION: f64 = 127.0 / 256.0;

/// Widest box in which Newton-Raphson is tried.
const WIDEST_TRIED: f64 = 0.5;

/// Steps of Newton-Raphson from the center of a box, and the length of the last one.
const STEPS: usize = 12;
const CONVERGED: f64 = 1e-13;

/// Half widths of the largest and the smallest box that are tried around a zero; each box is half as wide as the one before.
const WIDEST: f64 = 0.5;
const NARROWEST: f64 = 1e-9;

/// Largest distance outside of the range at which a zero counts as on its border, for rounding.
const BORDER: f64 = 1e-9;

/// Ratio of areas above which a contracted box is divided at once.
const SHRUNK: f64 = 0.7;

/// Box: two intervals.
pub(super) type Box2 = [Interval; 2];

/// Bounds of both functions, and of their Jacobian row by row.
pub(super) type Bounds2 = ([Interval; 2], [[Interval; 2]; 2]);

/// Common zeros of two functions in a range.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct CommonZeros {
    /// Zeros, one per entry.
    pub found: Vec<[f64; 2]>,
    /// Boxes that may have zeros.
    pub undecided: Vec<[[f64; 2]; 2]>,
}

/// Isolates the zeros of two functions by their bounds. Decreases `boxes` by the number of examined boxes, and stops at zero.
pub(super) fn isolate_common(
    range: [[f64; 2]; 2],
    boxes: &mut usize,
    bounds: impl FnMut(Box2) -> Bounds2,
) -> CommonZeros {
    let mut search = Search {
        bounds,
        alone: Vec::new(),
        zeros: CommonZeros::default(),
    };
    // Large boxes come first, so that boxes left at the limit are small.
    let mut open = VecDeque::from([range.map(|[low, high]| Interval::new(low, high))]);
    while let Some(whole) = open.pop_front() {
        if *boxes == 0 {
            search.leave(whole);
            continue;
        }
        *boxes -= 1;
        match search.look(whole) {
            Look::Decided => {}
            Look::Open(rest) if width(rest[0]).max(width(rest[1])) <= SMALLEST_BOX => {
                search.leave(rest);
            }
            Look::Open(rest) => {
                let halved =
                    width(rest[0]) * width(rest[1]) < SHRUNK * width(whole[0]) * width(whole[1]);
                match halved {
                    true => open.push_back(rest),
                    false => open.extend(divided(rest)),
                }
            }
        }
    }
    // A box around a zero may reach out of the range; a zero on the border counts.
    let inside = |zero: &[f64; 2]| {
        let both = zero.iter().zip(&range);
        both.into_iter()
            .all(|(value, [low, high])| low - BORDER <= *value && *value <= high + BORDER)
    };
    search.zeros.found.retain(inside);
    search.zeros
}

enum Look {
    Decided,
    /// Part that may have zeros.
    Open(Box2),
}

/// Box about its center.
struct Center {
    middle: [f64; 2],
    /// Values at the center.
    at: [Interval; 2],
    /// Box relative to the center.
    from: Box2,
}

struct Search<F> {
    bounds: F,
    /// Boxes that have exactly one zero each.
    alone: Vec<Box2>,
    zeros: CommonZeros,
}

impl<F: FnMut(Box2) -> Bounds2> Search<F> {
    fn look(&mut self, whole: Box2) -> Look {
        if self
            .alone
            .iter()
            .any(|isolated| is_within(&whole, isolated))
        {
            return Look::Decided;
        }
        let (values, jacobian) = (self.bounds)(whole);
        if values.iter().any(|value| !value.holds(0.0)) {
            return Look::Decided;
        }
        let all = values.iter().chain(jacobian.iter().flatten());
        if !all.into_iter().all(|it| it.defined) {
            return Look::Open(whole);
        }
        let center = self.center(whole);
        let mean = |row: usize| {
            let [a, b] = [0, 1].map(|axis| jacobian[row][axis].times(center.from[axis]));
            center.at[row].plus(a).plus(b)
        };
        if [0, 1].iter().any(|&row| !mean(row).holds(0.0)) {
            return Look::Decided;
        }
        let Some(reached) = krawczyk(&center, jacobian) else {
            return Look::Open(whole);
        };
        let rest = [0, 1].map(|axis| whole[axis].intersection(reached[axis]));
        if rest.iter().any(Interval::is_empty) {
            return Look::Decided;
        }
        let is_alone = (0..2).all(|axis| reached[axis].is_inside(whole[axis]));
        if is_alone {
            self.found(whole, reached);
            return Look::Decided;
        }
        if width(whole[0]).max(width(whole[1])) <= WIDEST_TRIED
            && let Some(zero) = self.newton(rest.map(|side| side.middle()))
        {
            self.surround(zero);
        }
        Look::Open(rest)
    }

    fn center(&mut self, whole: Box2) -> Center {
        let middle = whole.map(|side| side.middle());
        let (at, _) = (self.bounds)(middle.map(Interval::point));
        let from = [0, 1].map(|axis| whole[axis].minus(Interval::point(middle[axis])));
        Center { middle, at, from }
    }

    /// Records the zero of a box that has exactly one, and the part of the box in which it lies.
    fn found(&mut self, alone: Box2, mut part: Box2) {
        for _ in 0..STEPS {
            let (_, jacobian) = (self.bounds)(part);
            let Some(reached) = krawczyk(&self.center(part), jacobian) else {
                break;
            };
            let next = [0, 1].map(|axis| part[axis].intersection(reached[axis]));
            if next.iter().any(Interval::is_empty) || next == part {
                break;
            }
            part = next;
        }
        // The zero may be known from another box that contains it.
        if !self.alone.iter().any(|isolated| is_within(&part, isolated)) {
            self.alone.push(alone);
            self.zeros.found.push(part.map(|side| side.middle()));
        }
    }

    /// Searches the largest box around a zero without other zeros.
    fn surround(&mut self, zero: [f64; 2]) {
        let holds = |candidate: &Box2| (0..2).all(|axis| candidate[axis].holds(zero[axis]));
        if self.alone.iter().any(holds) {
            return;
        }
        let mut half = WIDEST;
        while half > NARROWEST {
            let around = zero.map(|value| Interval::new(value - half, value + half));
            let (values, jacobian) = (self.bounds)(around);
            let all = values.iter().chain(jacobian.iter().flatten());
            if all.into_iter().all(|it| it.defined)
                && let Some(reached) = krawczyk(&self.center(around), jacobian)
                && (0..2).all(|axis| reached[axis].is_inside(around[axis]))
            {
                self.found(around, reached);
                return;
            }
            half *= 0.5;
        }
    }

    /// Returns the zero to which Newton-Raphson converges from a point; `None` if it does not converge.
    fn newton(&mut self, mut at: [f64; 2]) -> Option<[f64; 2]> {
        for _ in 0..STEPS {
            let (values, jacobian) = (self.bounds)(at.map(Interval::point));
            let inverse = inverse(jacobian.map(|row| row.map(|entry| entry.middle())))?;
            let values = values.map(|value| value.middle());
            let step = inverse.map(|[a, b]| -(a * values[0] + b * values[1]));
            if !step
                .iter()
                .all(|it| it.is_finite() && it.abs() < WIDEST_TRIED)
            {
                return None;
            }
            at = [at[0] + step[0], at[1] + step[1]];
            if step.iter().all(|it| it.abs() < CONVERGED) {
                return Some(at);
            }
        }
        None
    }

    fn leave(&mut self, rest: Box2) {
        let rest = rest.map(|side| [side.low, side.high]);
        self.zeros.undecided.push(rest);
    }
}

/// Returns m − C F(m) + (1 − C J)(X − m), with the inverse C of J's center.
fn krawczyk(center: &Center, jacobian: [[Interval; 2]; 2]) -> Option<Box2> {
    let Center { middle, at, from } = center;
    let inverse = inverse(jacobian.map(|row| row.map(|entry| entry.middle())))?;
    let inverse = inverse.map(|row| row.map(Interval::point));
    let reached = [0, 1].map(|row| {
        let [a, b] = inverse[row];
        let newton = Interval::point(middle[row]).minus(a.times(at[0]).plus(b.times(at[1])));
        (0..2).fold(newton, |sum, column| {
            let product = a
                .times(jacobian[0][column])
                .plus(b.times(jacobian[1][column]));
            let unit = Interval::point(if row == column { 1.0 } else { 0.0 });
            sum.plus(unit.minus(product).times(from[column]))
        })
    });
    let is_finite = |side: &Interval| side.defined && side.low.is_finite() && side.high.is_finite();
    reached.iter().all(is_finite).then_some(reached)
}

fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let ratio = 1.0 / (a * d - b * c);
    let inverse = [[d, -b], [-c, a]].map(|row| row.map(|entry| entry * ratio));
    inverse
        .iter()
        .flatten()
        .all(|it| it.is_finite())
        .then_some(inverse)
}

fn is_within(part: &Box2, whole: &Box2) -> bool {
    let mut both = part.iter().zip(whole);
    both.all(|(part, side)| side.low <= part.low && part.high <= side.high)
}

fn width(side: Interval) -> f64 {
    side.high - side.low
}

/// Divides a box across its longer side.
fn divided(whole: Box2) -> [Box2; 2] {
    let axis = usize::from(width(whole[1]) > width(whole[0]));
    let side = whole[axis];
    let division = side.low + DIVISION * width(side);
    [[division, side.high], [side.low, division]].map(|[low, high]| {
        let mut part = whole;
        part[axis] = Interval::new(low, high);
        part
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> Interval {
        Interval::point(value)
    }

    /// Bounds x² + y² = 4 and x y = 1: x² is 2 ± √3.
    fn circle_and_hyperbola([x, y]: Box2) -> Bounds2 {
        let twice = |side: Interval| side.times(number(2.0));
        let circle = x.power(2).plus(y.power(2)).minus(number(4.0));
        let hyperbola = x.times(y).minus(number(1.0));
        ([circle, hyperbola], [[twice(x), twice(y)], [y, x]])
    }

    #[test]
    fn all_common_zeros_are_found_and_no_other() {
        let range = [[-3.0, 3.1], [-3.0, 3.1]];
        let zeros = isolate_common(range, &mut 10_000, circle_and_hyperbola);
        assert_eq!(zeros.undecided, Vec::<[[f64; 2]; 2]>::new());
        let mut isolated = zeros.found;
        isolated.sort_by(|one, other| one[0].total_cmp(&other[0]));
        let (large, small) = ((2.0 + 3.0_f64.sqrt()).sqrt(), (2.0 - 3.0_f64.sqrt()).sqrt());
        let known = [
            [-large, -small],
            [-small, -large],
            [small, large],
            [large, small],
        ];
        assert_eq!(isolated.len(), known.len());
        for (isolated, known) in isolated.iter().flatten().zip(known.iter().flatten()) {
            assert!((isolated - known).abs() < 1e-14, "{isolated} {known}");
        }
    }

    /// Bounds x² + y² = 2 and x y = 1, which touch at (1, 1) and (−1, −1).
    #[test]
    fn where_both_touch_stays_undecided() {
        let touching = |sides: Box2| {
            let ([circle, hyperbola], jacobian) = circle_and_hyperbola(sides);
            ([circle.plus(number(2.0)), hyperbola], jacobian)
        };
        let zeros = isolate_common([[-3.0, 3.1], [-3.0, 3.1]], &mut 100_000, touching);
        assert!(zeros.found.is_empty() && !zeros.undecided.is_empty());
        for place in [1.0, -1.0] {
            let holds = |rest: &[[f64; 2]; 2]| {
                rest.iter()
                    .all(|[low, high]| *low <= place && place <= *high)
            };
            assert!(zeros.undecided.iter().any(holds));
        }
        let is_near = |rest: &[[f64; 2]; 2]| {
            let [x, y] = rest.map(|[low, _]| low.abs());
            (x - 1.0).abs() < 1e-3 && (y - 1.0).abs() < 1e-3
        };
        assert!(zeros.undecided.iter().all(is_near));
    }

    #[test]
    fn unexamined_boxes_are_undecided() {
        let zeros = isolate_common([[-3.0, 3.1], [-3.0, 3.1]], &mut 0, circle_and_hyperbola);
        assert_eq!(zeros.undecided, [[[-3.0, 3.1], [-3.0, 3.1]]]);
    }
}
