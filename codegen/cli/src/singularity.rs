//! *Frames one after another → where Φ_q is singular or close to it, also between frames.*
//!
//! What is watched is the reciprocal condition r(t) of the dimensionless Φ_q and the sign of its determinant:
//! - a change of sign between two frames is located by bisection: there the motion passes straight through a singular pose;
//! - a local minimum of r over three frames is refined by golden-section search (Kiefer 1953) between the outer two. Minima
//!   that cannot matter are not refined: r falls to zero linearly at worst, so with a zero between the frames the middle one
//!   is at most a third of the larger neighbor;
//! - the first and the last frame, where r is smallest at an end of the motion.
//!
//! What is reported is judged when the whole motion is known: r below [`RELATIVE`] of its largest value on the way, so that a
//! mechanism is compared with itself and not with others of different size; or below [`ABSOLUTE`] at all. The module
//! does not know names.

use linkwright::{Equations, Frame, Settings, advance};
use nalgebra::{DVector, Dyn};

use crate::condition::{Condition, dimensionless, jacobian};

/// A pose counts as close to singular where its reciprocal condition is this fraction of the largest on the way: three
/// digits fewer can be trusted there than elsewhere.
pub const RELATIVE: f64 = 1e-3;

/// A pose counts as singular where its reciprocal condition is below this, about the square root of ε: half of the
/// digits of an acceleration may be lost.
pub const ABSOLUTE: f64 = 1e-8;

/// Minima above this fraction of the neighboring frames are not refined, unless they are small on the whole.
const DIP: f64 = 0.5;

/// How closely times are located (s), where `f64` can.
const LOCATED: f64 = 1e-9;

/// What happens at the time of a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The reciprocal condition is smallest here.
    Minimum,
    /// The determinant passes through zero.
    Crossing,
}

/// A pose that is possibly close to a singular one.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// What happens.
    pub event: Event,
    /// When (s).
    pub t: f64,
    /// The reciprocal condition of the dimensionless Φ_q.
    pub reciprocal: f64,
    /// The pose q (n).
    pub q: DVector<f64>,
}

impl Candidate {
    /// Whether it is to be reported, given the largest reciprocal condition of the whole motion.
    pub fn matters(&self, largest: f64) -> bool {
        self.event != Event::Minimum || self.is_weak(largest)
    }

    /// Whether the pose is close to singular, given the largest reciprocal condition of the whole motion.
    pub fn is_weak(&self, largest: f64) -> bool {
        self.reciprocal < (RELATIVE * largest).max(ABSOLUTE)
    }
}

/// Sees the frames of one leg in their order.
pub struct Watch<'a, E> {
    equations: &'a E,
    settings: Settings<f64>,
    /// The frame before the last one; `None` after a change of sign, across which there is no minimum.
    before: Option<Seen>,
    last: Seen,
    largest: f64,
    candidates: Vec<Candidate>,
    /// How many frames were seen.
    count: usize,
}

#[derive(Clone)]
struct Seen {
    frame: Frame<f64, Dyn>,
    condition: Condition,
}

impl<'a, E: Equations<f64, Dyn>> Watch<'a, E> {
    /// A watch that has seen the first frame.
    pub fn new(equations: &'a E, settings: &Settings<f64>, start: &Frame<f64, Dyn>) -> Self {
        let last = seen(equations, start.clone());
        Self {
            equations,
            settings: *settings,
            before: None,
            largest: last.condition.reciprocal,
            last,
            candidates: Vec::new(),
            count: 1,
        }
    }

    /// Sees the next frame.
    pub fn see(&mut self, frame: &Frame<f64, Dyn>) {
        let next = seen(self.equations, frame.clone());
        let r = |it: &Seen| it.condition.reciprocal;
        self.largest = self.largest.max(r(&next));
        let crossed = next.condition.sign != self.last.condition.sign;
        if crossed {
            let crossing = self.locate_crossing(&next);
            self.candidates.push(crossing);
        } else if let Some(before) = &self.before {
            let dips = r(&self.last) < r(before) && r(&self.last) <= r(&next);
            let deep =
                r(&self.last) < DIP * r(before).max(r(&next)) || r(&self.last) < 0.1 * self.largest;
            if dips && deep {
                let minimum = self.locate_minimum(before, &next);
                self.candidates.push(minimum);
            }
        } else if self.count == 1 && r(&self.last) <= r(&next) {
            self.candidates.push(minimum(&self.last));
        }
        self.count += 1;
        let last = std::mem::replace(&mut self.last, next);
        self.before = (!crossed).then_some(last);
    }

    /// What was found, and the largest reciprocal condition. The last frame counts as an end of the motion only if the
    /// motion was `completed`: otherwise it is the failure that has to be explained.
    pub fn finish(mut self, completed: bool) -> (Vec<Candidate>, f64) {
        let falling = self
            .before
            .as_ref()
            .is_some_and(|it| self.last.condition.reciprocal < it.condition.reciprocal);
        if completed && (falling || self.count == 1) {
            self.candidates.push(minimum(&self.last));
        }
        (self.candidates, self.largest)
    }

    /// The frame at `t`, reached from `from`; `None` where it cannot be solved.
    fn reach(&self, from: &Seen, t: f64) -> Option<Seen> {
        let frame = advance(self.equations, &from.frame, t, &self.settings).ok()?;
        Some(seen(self.equations, frame))
    }

    /// Where the determinant changes its sign between the last frame and `next`.
    fn locate_crossing(&self, next: &Seen) -> Candidate {
        let (mut near, mut far) = (self.last.clone(), next.clone());
        while let Some(middle) = between(near.frame.t, far.frame.t) {
            match self.reach(&near, middle) {
                // A pose that cannot be solved between two that can: the singular one itself.
                None => {
                    return Candidate {
                        event: Event::Crossing,
                        t: middle,
                        reciprocal: 0.0,
                        q: near.frame.q,
                    };
                }
                Some(reached) if reached.condition.sign == near.condition.sign => near = reached,
                Some(reached) => far = reached,
            }
        }
        let smaller = match near.condition.reciprocal <= far.condition.reciprocal {
            true => near,
            false => far,
        };
        Candidate {
            event: Event::Crossing,
            ..minimum(&smaller)
        }
    }

    /// The smallest reciprocal condition between `before` and `next`, around the last frame.
    fn locate_minimum(&self, before: &Seen, next: &Seen) -> Candidate {
        const GOLDEN: f64 = 0.618_033_988_749_894_8;
        let reach = |t: f64| {
            // From the nearest frame on the side of the start, so that the assembly mode is kept.
            let passed = (t - self.last.frame.t) * (next.frame.t - before.frame.t) >= 0.0;
            let from = if passed { &self.last } else { before };
            self.reach(from, t).ok_or_else(|| Candidate {
                t,
                reciprocal: 0.0,
                ..minimum(from)
            })
        };
        let search = || {
            let (mut low, mut high) = (before.frame.t, next.frame.t);
            let mut left = reach(high - GOLDEN * (high - low))?;
            let mut right = reach(low + GOLDEN * (high - low))?;
            while between(low, high).is_some() {
                if left.condition.reciprocal <= right.condition.reciprocal {
                    high = right.frame.t;
                    right = left;
                    left = reach(high - GOLDEN * (high - low))?;
                } else {
                    low = left.frame.t;
                    left = right;
                    right = reach(low + GOLDEN * (high - low))?;
                }
            }
            Ok(
                match left.condition.reciprocal <= right.condition.reciprocal {
                    true => left,
                    false => right,
                },
            )
        };
        match search() {
            // The search may end in another minimum of the interval; the frame itself is one that was seen.
            Ok(found) if found.condition.reciprocal <= self.last.condition.reciprocal => {
                minimum(&found)
            }
            Ok(_) => minimum(&self.last),
            Err(unsolvable) => unsolvable,
        }
    }
}

fn seen(equations: &impl Equations<f64, Dyn>, frame: Frame<f64, Dyn>) -> Seen {
    let matrix = dimensionless(equations, jacobian(equations, &frame.q, frame.t));
    Seen {
        condition: Condition::of(&matrix),
        frame,
    }
}

fn minimum(seen: &Seen) -> Candidate {
    Candidate {
        event: Event::Minimum,
        t: seen.frame.t,
        reciprocal: seen.condition.reciprocal,
        q: seen.frame.q.clone(),
    }
}

/// The middle of an interval that is still worth dividing.
fn between(one: f64, other: f64) -> Option<f64> {
    let middle = one + 0.5 * (other - one);
    let resolution = 4.0 * f64::EPSILON * one.abs().max(other.abs());
    ((other - one).abs() > LOCATED.max(resolution)).then_some(middle)
}
