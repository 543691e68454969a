//! Follows the border of a region by steps along its tangent, each corrected across the border.
//!
//! The region lies to the left. A pose moves beside the border, a small distance inside. A border ahead, or none beside, is a corner,
//! which shorter steps locate.

use super::super::ending::EndKind;
use super::plane::{Hit, Plane, PlanePose, Spot, along, direction, distance, right_of};

/// Largest turn of the tangent in one step (rad) that is not taken in shorter steps.
const LARGEST_TURN: f64 = 0.15;

/// Distance of the moving pose from the border, in steps.
const INSET: f64 = 0.3;

/// Length of the line across the border, in steps, behind the inset.
const ACROSS: f64 = 1.0;

/// Shortest step, as a part of the longest.
const SHORTEST_PART: f64 = 1.0 / 512.0;

/// Largest number of shortest steps in a row: more do not lead round a corner.
const MAX_SHORT_STEPS: usize = 40;

/// Largest number of points of a border.
pub(crate) const MAX_POINTS: usize = 6000;

/// Point of a border.
#[derive(Clone, Debug)]
pub(crate) struct BorderPoint {
    pub spot: Spot,
    pub kind: EndKind,
    pub words: String,
    /// Pose next to it.
    pub pose: PlanePose,
}

/// Progress along a border.
struct Follower<'a> {
    plane: &'a Plane,
    points: Vec<BorderPoint>,
    /// Pose beside the border.
    pose: PlanePose,
    /// Distance of the pose from the border.
    inset: f64,
    tangent: Spot,
    step: f64,
    longest: f64,
    /// Number of shortest steps in a row.
    short_steps: usize,
}

/// Follows the border from a point that a line from inside has hit, with the pose next to it. `longest` is the longest step. The last point closes the border, or is
/// where it was lost.
pub(crate) fn border(
    plane: &Plane,
    from: &PlanePose,
    (near, hit): (&PlanePose, &Hit),
    longest: f64,
    mut see: impl FnMut(usize),
) -> Vec<BorderPoint> {
    let Some(outward) = direction(from.spot, hit.spot) else {
        return Vec::new();
    };
    let reach = distance(from.spot, hit.spot);
    let inset = (INSET * longest).min(0.5 * reach);
    let Some(pose) = plane.moved(from, outward, reach - inset) else {
        return Vec::new();
    };
    let first = BorderPoint {
        spot: hit.spot,
        kind: hit.kind,
        words: hit.words.clone(),
        pose: near.clone(),
    };
    let [x, y] = outward;
    let mut follower = Follower {
        plane,
        points: vec![first],
        pose,
        inset,
        tangent: [-y, x],
        step: longest,
        longest,
        short_steps: 0,
    };
    while follower.points.len() < MAX_POINTS {
        let is_advanced = follower.advance();
        let is_short = follower.step <= 2.0 * follower.shortest();
        follower.short_steps = if is_short {
            follower.short_steps + 1
        } else {
            0
        };
        if !is_advanced || follower.short_steps > MAX_SHORT_STEPS {
            break;
        }
        see(follower.points.len());
        if follower.is_closed() {
            let first = follower.points[0].clone();
            follower.points.push(first);
            break;
        }
    }
    follower.points
}

impl Follower<'_> {
    fn shortest(&self) -> f64 {
        SHORTEST_PART * self.longest
    }

    /// True if the border is back at its first point.
    fn is_closed(&self) -> bool {
        let (first, last) = (&self.points[0], self.points.len() - 1);
        let near = distance(first.spot, self.points[last].spot);
        last > 8
            && near < 1.2 * self.step.max(8.0 * self.shortest())
            && self.traveled() > 4.0 * near
    }

    fn traveled(&self) -> f64 {
        let pairs = self.points.windows(2);
        pairs.map(|it| distance(it[0].spot, it[1].spot)).sum()
    }

    /// Takes a step; returns false if the border is lost.
    fn advance(&mut self) -> bool {
        loop {
            let is_shortest = self.step <= self.shortest();
            let Some(ahead) = self.plane.cast(&self.pose, self.tangent, self.step) else {
                return false;
            };
            if let Some(hit) = ahead.hit {
                if is_shortest {
                    return self.turn_left(hit, ahead.last);
                }
                self.step *= 0.5;
                continue;
            }
            let outward = right_of(self.tangent);
            let across = self.inset + ACROSS * self.step;
            let Some(beside) = self.plane.cast(&ahead.last, outward, across) else {
                return false;
            };
            let Some(hit) = beside.hit else {
                if is_shortest {
                    // The border turns away: the pose goes round its corner.
                    self.pose = beside.last;
                    self.tangent = outward;
                    self.step = self.shortest();
                    return self.around();
                }
                self.step *= 0.5;
                continue;
            };
            let last = &self.points[self.points.len() - 1];
            let turned = direction(last.spot, hit.spot);
            let tangent = turned.unwrap_or(self.tangent);
            let turn = angle(self.tangent, tangent);
            let changes = hit.kind != last.kind || hit.words != last.words;
            let is_first = self.points.len() == 1;
            if (changes || (turn.abs() > LARGEST_TURN && !is_first)) && !is_shortest {
                self.step *= 0.5;
                continue;
            }
            let depth = distance(ahead.last.spot, hit.spot);
            self.tangent = tangent;
            self.push(hit, beside.last.clone());
            let next = INSET * self.grown(turn);
            let placed = self.placed(&ahead.last, outward, depth - next);
            (self.pose, self.inset) = match placed {
                Some(pose) => (pose, next),
                None => (ahead.last, depth),
            };
            return true;
        }
    }

    /// Returns the pose at a signed distance along a direction.
    fn placed(&self, from: &PlanePose, towards: Spot, length: f64) -> Option<PlanePose> {
        match length < 0.0 {
            true => self.plane.moved(from, towards.map(|it| -it), -length),
            false => self.plane.moved(from, towards, length),
        }
    }

    /// Returns the next step, longer after a small turn.
    fn grown(&mut self, turn: f64) -> f64 {
        if turn.abs() < 0.4 * LARGEST_TURN {
            self.step = (1.5 * self.step).min(self.longest);
        }
        self.step
    }

    fn push(&mut self, hit: Hit, pose: PlanePose) {
        self.points.push(BorderPoint {
            spot: hit.spot,
            kind: hit.kind,
            words: hit.words,
            pose,
        });
    }

    /// Continues along a border that is ahead.
    fn turn_left(&mut self, hit: Hit, last: PlanePose) -> bool {
        let ahead = self.tangent;
        let inset = INSET * self.shortest();
        let depth = distance(last.spot, hit.spot);
        self.push(hit, last.clone());
        let back = ahead.map(|it| -it);
        let moved = self.plane.moved(&last, back, (inset - depth).max(0.0));
        self.pose = moved.unwrap_or(last);
        self.inset = inset.max(depth);
        // The new border goes to the left of the line that hits it.
        let [x, y] = ahead;
        self.tangent = [-y, x];
        self.step = 2.0 * self.shortest();
        true
    }

    /// Goes on to the border behind a corner; returns false if there is none within a few steps.
    fn around(&mut self) -> bool {
        for _ in 0..3 {
            let outward = right_of(self.tangent);
            let reach = 4.0 * self.step;
            let Some(beside) = self.plane.cast(&self.pose, outward, reach) else {
                return false;
            };
            match beside.hit {
                Some(hit) => {
                    self.inset = distance(self.pose.spot, hit.spot);
                    self.push(hit, beside.last);
                    return true;
                }
                None => {
                    self.pose = beside.last;
                    self.tangent = outward;
                }
            }
        }
        false
    }
}

/// Returns the angle from one direction to another, positive to the left.
pub(crate) fn angle(from: Spot, to: Spot) -> f64 {
    let cross = from[0] * to[1] - from[1] * to[0];
    let dot = from[0] * to[0] + from[1] * to[1];
    cross.atan2(dot)
}

/// Returns true if a point lies within a distance of a border.
pub(crate) fn is_beside(points: &[BorderPoint], spot: Spot, within: f64) -> bool {
    points.windows(2).any(|pair| {
        let [from, to] = [pair[0].spot, pair[1].spot];
        let Some(towards) = direction(from, to) else {
            return distance(from, spot) <= within;
        };
        let along_it = (spot[0] - from[0]) * towards[0] + (spot[1] - from[1]) * towards[1];
        let foot = along(from, towards, along_it.clamp(0.0, distance(from, to)));
        distance(foot, spot) <= within
    })
}
