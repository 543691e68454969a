//! *Bounds of two functions of two unknowns, and of their Jacobian* → *all of their common zeros in a range, one by one, and what stays
//! undecided*.
//!
//! A box in whose bounds one of the functions has no zero holds none; neither does one that the mean-value form excludes, nor one that
//! Krawczyk's operator leads out of. Where this operator leads a box into itself, it holds exactly one zero (Krawczyk, Newton-Algorithmen
//! zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4 (1969); Moore, Kearfott and Cloud, Introduction to Interval Analysis,
//! 2009, chapter 8). Around a zero that Newton-Raphson finds, the largest box is looked for that is known to hold no other: boxes within
//! it need not be looked at. Everything else is divided, until boxes are smaller than [`SMALLEST_BOX`] or there have been too many.

use std::collections::VecDeque;

use super::interval::Interval;

/// The width of a box that is not divided any more, in the scale of the range.
const SMALLEST_BOX: f64 = 1e-7;

/// Where a box is divided: not in the middle, so that zeros that a person would choose do not lie on a border.
const DIVISION: f64 = 127.0 / 256.0;

/// The widest box from which Newton-Raphson is tried.
const WIDEST_TRIED: f64 = 0.5;

/// Steps of Newton-Raphson from the middle of a box, and the length of the last one.
const STEPS: usize = 12;
const CONVERGED: f64 = 1e-13;

/// The half width of the largest box around a zero that is tried, and of the smallest one; each is half as wide as the one before.
const WIDEST: f64 = 0.5;
const NARROWEST: f64 = 1e-9;

/// How far outside of the range a zero may seem to be by rounding.
const BORDER: f64 = 1e-9;

/// A box without its middle that is left by less than this part is divided at once.
const SHRUNK: f64 = 0.7;

/// Two intervals.
pub(super) type Box2 = [Interval; 2];

/// Both functions, and their Jacobian row by row.
pub(super) type Bounds2 = ([Interval; 2], [[Interval; 2]; 2]);

/// The common zeros of two functions in a range.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct CommonZeros {
    /// One zero each.
    pub found: Vec<[f64; 2]>,
    /// Where it is not known whether there are zeros.
    pub undecided: Vec<[[f64; 2]; 2]>,
}

/// The zeros of two functions of which these are the bounds. So many boxes are looked at, and taken off.
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
    // The largest first, so that what is left when there have been too many is small.
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
    // A box around a zero may reach out of the range; a zero on its border counts.
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
    /// Zeros may be in this part.
    Open(Box2),
}

/// A box about its middle.
struct Center {
    middle: [f64; 2],
    /// The values in the middle.
    at: [Interval; 2],
    /// The box as seen from there.
    from: Box2,
}

struct Search<F> {
    bounds: F,
    /// Boxes that hold one zero each, and no other.
    alone: Vec<Box2>,
    zeros: CommonZeros,
}

impl<F: FnMut(Box2) -> Bounds2> Search<F> {
    fn look(&mut self, whole: Box2) -> Look {
        if self.alone.iter().any(|own| is_within(&whole, own)) {
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

    /// Notes the zero of a box that holds one alone, and which lies in a part of it.
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
        // The same zero, which has been found in another box that it shares with this one.
        if !self.alone.iter().any(|own| is_within(&part, own)) {
            self.alone.push(alone);
            self.zeros.found.push(part.map(|side| side.middle()));
        }
    }

    /// Looks for the largest box around a zero that holds no other.
    fn surround(&mut self, zero: [f64; 2]) {
        let holds = |own: &Box2| (0..2).all(|axis| own[axis].holds(zero[axis]));
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

    /// A zero near a place, where Newton-Raphson converges to one.
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

/// m − C F(m) + (1 − C J)(X − m), with the inverse C of the middle of J.
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

/// Two parts of a box, divided across its longer side.
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

    /// x² + y² = 4 and x y = 1: x² is 2 ± √3.
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
        let mut found = zeros.found;
        found.sort_by(|one, other| one[0].total_cmp(&other[0]));
        let (large, small) = ((2.0 + 3.0_f64.sqrt()).sqrt(), (2.0 - 3.0_f64.sqrt()).sqrt());
        let known = [
            [-large, -small],
            [-small, -large],
            [small, large],
            [large, small],
        ];
        assert_eq!(found.len(), known.len());
        for (found, known) in found.iter().flatten().zip(known.iter().flatten()) {
            assert!((found - known).abs() < 1e-14, "{found} {known}");
        }
    }

    /// x² + y² = 2 and x y = 1 touch at (1, 1) and (−1, −1).
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
    fn what_was_not_looked_at_is_undecided() {
        let zeros = isolate_common([[-3.0, 3.1], [-3.0, 3.1]], &mut 0, circle_and_hyperbola);
        assert_eq!(zeros.undecided, [[[-3.0, 3.1], [-3.0, 3.1]]]);
    }
}
