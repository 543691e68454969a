//! Follows an equilibrium over a parameter or an input, through folds and changes of stability.

use super::events::Located;
pub use super::events::PathEventKind;
use super::follower::{Follower, PathPoint};
use super::search::Equilibria;
use super::verdict::{Stability, Verdict};
use super::{Equilibrium, Varied};

/// Longest step along a path, scaled.
const STEP: f64 = 0.01;

/// Shortest step, as a part of the longest.
const SHORTEST: f64 = 1e-6;

/// Smallest cosine of the turn of a path in a step.
const STRAIGHT: f64 = 0.98;

/// Largest distance from the last point after a step back, as a part of the step.
const RETURN: f64 = 0.1;

/// Largest number of steps.
const MAX_STEPS: usize = 20_000;

/// Point of a path.
#[derive(Clone, Debug)]
pub struct PathRow {
    /// Value of the parameter, in SI units.
    pub value: f64,
    /// Equilibrium.
    pub equilibrium: Equilibrium,
}

/// Event on a path.
#[derive(Clone, Debug)]
pub struct PathEvent {
    /// Kind.
    pub kind: PathEventKind,
    /// Point of the event.
    pub row: PathRow,
    /// Stability before and behind it.
    pub stability: [Stability; 2],
    /// Number of rows before it.
    pub place: usize,
}

/// End of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathEnd {
    /// The parameter reaches the last value.
    Last,
    /// The parameter returns to the first value.
    First,
    /// The path returns to its first point.
    Closed,
    /// No point continues: the mechanism becomes singular, or loads end.
    Lost,
    /// The number of steps is too large.
    Long,
    /// The caller ends the path.
    Interrupted,
}

/// Path of an equilibrium.
#[derive(Clone, Debug)]
pub struct EquilibriumPath {
    /// Points in the order along the path.
    pub rows: Vec<PathRow>,
    /// Events in the order along the path.
    pub events: Vec<PathEvent>,
    /// End.
    pub end: PathEnd,
}

/// Reason that an equilibrium cannot be followed: the parameter turns back, or paths cross, at its first value.
#[derive(Clone, Copy, Debug)]
pub struct Unfollowed;

impl EquilibriumPath {
    /// Follows an equilibrium from the first value of a parameter or an input, at which it was found, until the value leaves its range.
    /// `see` receives the number of points so far; it returns false to end the path.
    ///
    /// # Errors
    /// The path has no direction at its first point.
    pub fn new(
        equilibria: &Equilibria,
        of: usize,
        place: Varied,
        ends: [f64; 2],
        mut see: impl FnMut(usize) -> bool,
    ) -> Result<EquilibriumPath, Unfollowed> {
        let first = equilibria.all.get(of).ok_or(Unfollowed)?;
        if first.verdict.vanishing > 0 {
            return Err(Unfollowed);
        }
        let equations = equilibria.equations.clone();
        let mut follower = Follower::new(equations, place, ends, &first.pose);
        let start = follower.first(first.pose.clone()).ok_or(Unfollowed)?;
        let mut verdict = follower.verdict(&start);
        let mut path = EquilibriumPath {
            rows: Vec::new(),
            events: Vec::new(),
            end: PathEnd::Long,
        };
        path.rows
            .push(row(equilibria, &follower, &start, verdict.clone()));
        let (mut last, mut length) = (start.clone(), STEP);
        while path.rows.len() < MAX_STEPS {
            if !see(path.rows.len()) {
                path.end = PathEnd::Interrupted;
                break;
            }
            let next = follower.next(&last, length);
            let next = next.filter(|it| follower.cosine(&last, it) >= STRAIGHT);
            // A step that does not lead back has jumped to another path.
            let next = next.filter(|next| {
                let back = follower.next(next, -length);
                back.is_some_and(|it| follower.distance(&it, &last) <= RETURN * length)
            });
            let Some(mut next) = next else {
                if path.is_lost(&mut length) {
                    break;
                }
                continue;
            };
            let end = [(1.0, PathEnd::Last), (0.0, PathEnd::First)];
            let end = end.into_iter().find(|(share, _)| match *share {
                1.0 => next.share >= 1.0,
                _ => next.share <= 0.0,
            });
            if let Some((share, _)) = end {
                match follower.at_share(&last, share) {
                    Some(point) => next = point,
                    None if path.is_lost(&mut length) => break,
                    None => continue,
                }
            }
            let judged = follower.verdict(&next);
            let Some(events) = follower.events((&last, &verdict), (&next, &judged), length) else {
                if path.is_lost(&mut length) {
                    break;
                }
                continue;
            };
            for event in events {
                path.record(equilibria, &mut follower, event);
            }
            path.rows
                .push(row(equilibria, &follower, &next, judged.clone()));
            let is_closed = path.rows.len() > 8 && follower.distance(&start, &next) < 0.5 * length;
            (last, verdict) = (next, judged);
            if let Some((_, end)) = end {
                path.end = end;
                break;
            }
            if is_closed {
                path.end = PathEnd::Closed;
                break;
            }
            length = (1.5 * length).min(STEP);
        }
        Ok(path)
    }

    /// Halves the length of a step; returns true, and ends the path, if it becomes too short.
    fn is_lost(&mut self, length: &mut f64) -> bool {
        *length *= 0.5;
        let is_lost = *length < SHORTEST * STEP;
        if is_lost {
            self.end = PathEnd::Lost;
        }
        is_lost
    }

    fn record(&mut self, equilibria: &Equilibria, follower: &mut Follower, event: Located) {
        let verdict = follower.verdict(&event.at);
        let stability = event.verdicts.each_ref().map(|it| it.stability);
        self.events.push(PathEvent {
            kind: event.kind,
            row: row(equilibria, follower, &event.at, verdict),
            stability,
            place: self.rows.len(),
        });
    }
}

/// Returns the row of a point.
fn row(
    equilibria: &Equilibria,
    follower: &Follower,
    point: &PathPoint,
    verdict: Verdict,
) -> PathRow {
    let pose = point.pose.clone();
    PathRow {
        value: follower.value(point.share),
        equilibrium: follower
            .equations
            .equilibrium(&equilibria.view, pose, verdict),
    }
}
