//! Locates the points of a path at which the parameter turns back, or at which stability changes.

use super::follower::{Follower, PathPoint};
use super::verdict::Verdict;

/// Largest number of halvings of a step.
const HALVINGS: usize = 60;

/// Part of a step to which an event is located at least.
const RESOLUTION: f64 = 1e-7;

/// Part of a step within which a fold and a change of stability are one event, and both sides of an event meet.
const JOINT_PART: f64 = 1e-4;

/// Kind of event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathEventKind {
    /// The parameter turns back: a limit point.
    Fold,
    /// Another path crosses, or an oscillation begins to grow.
    ChangeOfStability,
}

/// Event between two points, both of which are next to it.
pub(super) struct Located {
    pub kind: PathEventKind,
    pub at: PathPoint,
    pub verdicts: [Verdict; 2],
}

impl Follower {
    /// Returns the verdict on a point.
    pub fn verdict(&mut self, point: &PathPoint) -> Verdict {
        self.equations.set(self.place, self.value(point.share));
        let stiffness = point.pose.stiffness(&self.equations);
        Verdict::of(&self.equations, &point.pose, &stiffness)
    }

    /// Returns the events in a step from a point of a verdict to the next one, in their order; `None` if the step has left the path.
    pub fn events(
        &mut self,
        from: (&PathPoint, &Verdict),
        to: (&PathPoint, &Verdict),
        length: f64,
    ) -> Option<Vec<Located>> {
        let mut located: Vec<(f64, Located)> = Vec::new();
        if rate(from.0) * rate(to.0) < 0.0 {
            let before = rate(from.0);
            let fold = self.located(from.0, length, |_, point| rate(point) * before < 0.0);
            let (distance, at) = fold?;
            let verdicts = [from.1.clone(), to.1.clone()];
            let kind = PathEventKind::Fold;
            located.push((distance, Located { kind, at, verdicts }));
        }
        // A fold changes one sign of its own.
        let changed = from.1.growing.abs_diff(to.1.growing);
        if changed > located.len() {
            let before = from.1.growing;
            let change = self.located(from.0, length, |follower, point| {
                follower.verdict(point).growing != before
            });
            let is_fold = |distance: f64| {
                let mut folds = located.iter();
                folds.any(|(at, _)| (at - distance).abs() <= JOINT_PART * length)
            };
            if let Some((distance, at)) = Some(change?).filter(|(it, _)| !is_fold(*it)) {
                let verdicts = [from.1.clone(), to.1.clone()];
                let kind = PathEventKind::ChangeOfStability;
                located.push((distance, Located { kind, at, verdicts }));
            }
        }
        located.sort_by(|one, other| one.0.total_cmp(&other.0));
        Some(located.into_iter().map(|(_, it)| it).collect())
    }

    /// Halves a step in which a property changes; returns the distance of the change with the point before it. `None` if the points on
    /// both sides do not meet.
    fn located(
        &mut self,
        from: &PathPoint,
        length: f64,
        is_behind: impl Fn(&mut Follower, &PathPoint) -> bool,
    ) -> Option<(f64, PathPoint)> {
        let (mut low, mut high) = (0.0, length);
        let (mut before, mut behind) = (from.clone(), None);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            // Next to a crossing of paths, rounding may leave no point.
            let Some(point) = self.next(from, middle) else {
                break;
            };
            if is_behind(self, &point) {
                high = middle;
                behind = Some(point);
            } else {
                low = middle;
                before = point;
            }
        }
        let gap = behind.map_or(0.0, |it| self.distance(&before, &it));
        let is_located = high - low <= RESOLUTION * length;
        (is_located && gap <= JOINT_PART * length).then_some((high, before))
    }
}

/// Returns the rate of the parameter along the path.
pub(super) fn rate(point: &PathPoint) -> f64 {
    point.tangent[point.tangent.len() - 1]
}
