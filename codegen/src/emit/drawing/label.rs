//! Places names among drawn outlines, and leaves out those without room.
//!
//! Every name has candidates around its anchors. Their cost grows with the lines that they cover and with the
//! distance from the anchor. Names are placed one after another, then each again while the others stay (Christensen,
//! Marks and Shieber 1995 compare such searches). Afterwards no two names overlap and all lie in the area. Equal
//! input gives equal positions.

use std::cell::OnceCell;

use super::obstacles::Obstacles;
use super::plane::{Bounds, Point, distance, onward};

/// Point from which candidates lie outwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Anchor {
    pub at: Point,
    /// Unit vector from the anchor to its names, or zero for a name upon it.
    pub out: Point,
    /// Distance of the name.
    pub gap: f64,
    /// Cost of the anchor.
    pub cost: f64,
}

/// Name to be placed.
#[derive(Clone, Debug)]
pub(super) struct Label {
    /// Half the width and half the height.
    pub half: Point,
    pub anchors: Vec<Anchor>,
    /// Index among the filled outlines of the one to which it belongs; `None` if there is none.
    pub owner: Option<usize>,
}

/// Distances from an anchor, in pixels.
const STEPS: [f64; 7] = [0.0, 5.0, 11.0, 19.0, 30.0, 44.0, 64.0];

/// Number of free positions that are compared for a name without room beside its anchor.
const NEAREST: usize = 100;

/// Cost below which a candidate is free.
const FREE_COST_LIMIT: f64 = 12.0;

/// Number of times that each name is placed again.
const ROUNDS: usize = 3;

/// Position of a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placed {
    pub area: Bounds,
    /// Anchor at the end of a leader line; `None` if the name is close to it.
    pub leader: Option<Point>,
}

/// Positions of the names; `None` for one without room.
pub(super) fn placed(
    labels: &[Label],
    obstacles: &Obstacles,
    area: &Bounds,
) -> Vec<Option<Placed>> {
    let candidates: Vec<Vec<Candidate>> = labels
        .iter()
        .map(|label| candidates(label, obstacles, area))
        .collect();
    let cost = |at: usize, candidate: &Candidate| candidate.cost(obstacles, labels[at].owner);
    let mut chosen: Vec<Option<Placed>> = vec![None; labels.len()];
    // Those with the fewest free candidates first.
    let mut order: Vec<usize> = (0..labels.len()).collect();
    let free = |at: usize| {
        let all = candidates[at].iter();
        all.filter(|it| it.least < FREE_COST_LIMIT && cost(at, it) < FREE_COST_LIMIT)
            .count()
    };
    order.sort_by_key(|&at| free(at));
    for round in 0..=ROUNDS {
        for &at in &order {
            let rest = |other: usize| (other != at).then_some(chosen[other]).flatten();
            let others: Vec<Bounds> = (0..labels.len())
                .filter_map(rest)
                .map(|it| it.area.widened(1.5))
                .collect();
            let mut best: Option<(f64, Placed)> = None;
            for candidate in &candidates[at] {
                let is_better = |cost: f64| best.is_none_or(|(least, _)| cost < least);
                let fits = |area: &Bounds| others.iter().all(|other| !other.meets(area));
                if is_better(candidate.least) && fits(&candidate.placed.area) {
                    let cost = cost(at, candidate);
                    if is_better(cost) {
                        best = Some((cost, candidate.placed));
                    }
                }
            }
            chosen[at] = match best {
                Some((_, placed)) => Some(placed),
                // In the end any free position is better than none.
                None if round == ROUNDS => anywhere(&labels[at], &others, obstacles, area),
                None => None,
            };
        }
    }
    chosen
}

/// Position of a name beside its first anchor, whatever it covers; `None` without an anchor.
pub(super) fn beside(label: &Label) -> Option<Placed> {
    let anchor = label.anchors.first()?;
    Some(Placed {
        area: Bounds::around(anchor.center(0.0, label.half), label.half),
        leader: None,
    })
}

impl Anchor {
    /// Center of a name that begins a distance away. A box beside the point touches the circle about it, rather than the line across.
    fn center(&self, step: f64, half: Point) -> Point {
        let reach = (self.out[0] * half[0]).abs() + (self.out[1] * half[1]).abs();
        onward(self.at, self.gap + step + reach, self.out)
    }
}

/// Possible position of a name.
struct Candidate {
    /// Cost if it covers nothing.
    least: f64,
    placed: Placed,
    /// Cost with everything it covers, computed on demand.
    whole: OnceCell<f64>,
}

impl Candidate {
    fn cost(&self, obstacles: &Obstacles, owner: Option<usize>) -> f64 {
        let whole = || self.least + obstacles.cost(&self.placed.area, owner);
        *self.whole.get_or_init(whole)
    }
}

fn candidates(label: &Label, obstacles: &Obstacles, area: &Bounds) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    for anchor in &label.anchors {
        let is_upon = anchor.out == [0.0; 2];
        let steps = if is_upon { &STEPS[..1] } else { &STEPS[..] };
        for step in steps {
            let area_here = Bounds::around(anchor.center(*step, label.half), label.half);
            let is_free = obstacles.taken.iter().all(|it| !it.meets(&area_here));
            if !area.holds(&area_here) || !is_free {
                continue;
            }
            let is_led = *step > 25.0;
            let far = if is_led { 8.0 } else { 0.0 };
            let leader = is_led.then_some(anchor.at);
            candidates.push(Candidate {
                least: anchor.cost + far + 0.42 * step,
                placed: Placed {
                    area: area_here,
                    leader,
                },
                whole: OnceCell::new(),
            });
        }
    }
    candidates
}

/// Free position nearest to the first anchor, with a leader line to it.
fn anywhere(
    label: &Label,
    others: &[Bounds],
    obstacles: &Obstacles,
    area: &Bounds,
) -> Option<Placed> {
    let from = label.anchors.first()?.at;
    let step = label.half[1];
    let size = area.size();
    let counts =
        [0, 1].map(|axis| ((size[axis] - 2.0 * label.half[axis]) / step).max(0.0) as usize);
    let [columns, rows] = counts;
    let cells = (0..=rows).flat_map(|row| (0..=columns).map(move |column| [column, row]));
    let free = cells.filter_map(|cell| {
        let at = [0, 1].map(|axis| area.low[axis] + label.half[axis] + step * cell[axis] as f64);
        let area_here = Bounds::around(at, label.half);
        let mut taken = others.iter().chain(&obstacles.taken);
        let is_free = area.holds(&area_here) && taken.all(|it| !it.meets(&area_here));
        is_free.then(|| (distance(at, from), area_here))
    });
    let mut free: Vec<(f64, Bounds)> = free.collect();
    free.sort_by(|a, b| a.0.total_cmp(&b.0));
    let costly = free.into_iter().take(NEAREST);
    let costly = costly.map(|(far, own)| (far + obstacles.cost(&own, None), own));
    let best = costly.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Placed {
        area: best.1,
        leader: Some(from),
    })
}

#[cfg(test)]
mod tests {
    use super::super::figure::{Look, Trace};
    use super::*;

    fn around(at: Point) -> Vec<Anchor> {
        [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]]
            .into_iter()
            .map(|out| Anchor {
                at,
                out,
                gap: 2.0,
                cost: 0.0,
            })
            .collect()
    }

    #[test]
    fn names_of_one_point_stand_apart_and_inside() {
        let area = Bounds {
            low: [0.0, 0.0],
            high: [60.0, 40.0],
        };
        let label = Label {
            half: [10.0, 6.0],
            anchors: around([5.0, 20.0]),
            owner: None,
        };
        let positions = placed(&vec![label; 4], &Obstacles::default(), &area);
        let boxes: Vec<Bounds> = positions.iter().flatten().map(|it| it.area).collect();
        assert_eq!(boxes.len(), 4);
        for (at, one) in boxes.iter().enumerate() {
            assert!(area.holds(one));
            assert!(boxes[at + 1..].iter().all(|other| !other.meets(one)));
        }
    }

    #[test]
    fn a_name_that_finds_no_room_is_left_out() {
        let area = Bounds {
            low: [0.0, 0.0],
            high: [30.0, 14.0],
        };
        let label = Label {
            half: [10.0, 6.0],
            anchors: around([5.0, 7.0]),
            owner: None,
        };
        let positions = placed(&vec![label; 3], &Obstacles::default(), &area);
        assert_eq!(positions.iter().flatten().count(), 1);
    }

    #[test]
    fn a_line_is_not_covered() {
        let area = Bounds {
            low: [-50.0, -50.0],
            high: [50.0, 50.0],
        };
        let mut obstacles = Obstacles::default();
        for y in [-8.0, 8.0] {
            obstacles.add(
                &Trace {
                    look: Look::Edge,
                    points: vec![[0.0, y], [40.0, y]],
                    is_closed: false,
                },
                None,
            );
        }
        let label = Label {
            half: [10.0, 9.0],
            anchors: around([0.0, 0.0]),
            owner: None,
        };
        let positions = placed(&[label], &obstacles, &area);
        assert_eq!(positions[0].map(|it| it.area.center()), Some([-12.0, 0.0]));
    }
}
