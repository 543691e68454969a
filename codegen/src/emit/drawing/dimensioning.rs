//! Places dimensions beside their links.
//!
//! Every dimension takes the cheapest of its candidates, the shortest ones of a link first. Equal input gives equal positions.

use super::dimension::{Dimension, DimensionLines, Measure, Measured};
use super::draft::LINK;
use super::figure::Figure;
use super::measurable::Measurable;
use super::naming::obstacles;
use super::obstacles::Obstacles;
use super::plane::{Bounds, Point, difference, distance, dot, left_of, onward, scaled};

/// Distance of the first dimension line from the shape of its link, and between successive ones, in pixels.
const RANKS: [f64; 2] = [15.0, 17.0];

/// Number of candidates on each side.
const CANDIDATES: usize = 6;

/// Costs of a candidate: of its rank, of crossing a dimension, of an overlap with it, and of a text on a text.
const RANK: f64 = 4.0;
const CROSSING: f64 = 18.0;
const OVERLAP: f64 = 60.0;
const COVERED: f64 = 200.0;

/// Cost of a pixel between a dimension line and its points.
const DISTANCE: f64 = 0.1;

/// Distance within which two lines lie beside one another, in pixels.
const BESIDE: f64 = 9.0;

/// Weight of the lines of the figure under a text and along a dimension line.
const INK: [f64; 2] = [1.2, 0.25];

/// Distance of samples along a dimension line, in pixels.
const SAMPLE: f64 = 12.0;

/// Places the dimensions of links on a figure.
pub(super) fn dimensions(
    figure: &Figure,
    links: &[Measurable],
    measure: &Measure,
) -> Vec<Dimension> {
    let mut placing = Placing {
        obstacles: obstacles(figure),
        placed: Vec::new(),
    };
    let mut dimensions = Vec::new();
    for link in links {
        let mut unplaced: Vec<Unplaced> = Vec::new();
        for ([a, b], length) in &link.distances {
            unplaced.push(Unplaced {
                ends: [link.points[*a], link.points[*b]],
                extent: extent(&link.points, [link.points[*a], link.points[*b]]),
                length: *length,
                measured: Measured::Distance,
            });
        }
        for (center, diameter) in &link.diameters {
            let radius = 0.5 * diameter * figure.scale;
            unplaced.push(Unplaced {
                ends: [-radius, radius].map(|it| onward(*center, it, [1.0, 0.0])),
                extent: [radius; 2],
                length: *diameter,
                measured: Measured::Diameter,
            });
        }
        unplaced.sort_by(|a, b| a.length.total_cmp(&b.length));
        dimensions.extend(unplaced.iter().map(|it| placing.place(it, measure)));
    }
    dimensions
}

/// Reach of the points of a link to the left and to the right of a line.
fn extent(points: &[Point], [a, b]: [Point; 2]) -> [f64; 2] {
    let along = scaled(difference(b, a), 1.0 / distance(a, b));
    points.iter().fold([0.0; 2], |[left, right], point| {
        let reach = dot(difference(*point, a), left_of(along));
        [left.max(reach), right.max(-reach)]
    })
}

/// Dimension without a position.
struct Unplaced {
    ends: [Point; 2],
    /// Reach of its link to the left and to the right.
    extent: [f64; 2],
    length: f64,
    measured: Measured,
}

/// Dimensions that have a position already, with what they avoid.
struct Placing {
    obstacles: Obstacles,
    /// Dimensions with boxes around all that they can touch.
    placed: Vec<(DimensionLines, Bounds)>,
}

impl Placing {
    fn place(&mut self, unplaced: &Unplaced, measure: &Measure) -> Dimension {
        let text = measure.text(unplaced.length);
        let text = match unplaced.measured {
            Measured::Distance => text,
            Measured::Diameter => format!("Ø{text}"),
        };
        let candidate = |aside: f64| Dimension {
            ends: unplaced.ends,
            aside,
            length: unplaced.length,
            measured: unplaced.measured,
            text: text.clone(),
            unit: 1.0,
        };
        let [first, step] = RANKS;
        let mut best: Option<(f64, Dimension, DimensionLines)> = None;
        for rank in 0..CANDIDATES {
            for (side, extent) in [(-1.0, unplaced.extent[1]), (1.0, unplaced.extent[0])] {
                // Beside the farthest point of the link, or as close as its own points allow.
                for extent in [extent, 0.0] {
                    let aside = side * (extent + LINK + first + step * rank as f64);
                    let dimension = candidate(aside);
                    let lines = dimension.lines();
                    let cost = RANK * rank as f64 + DISTANCE * aside.abs() + self.cost(&lines);
                    if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                        best = Some((cost, dimension, lines));
                    }
                }
            }
        }
        match best {
            Some((_, dimension, lines)) => {
                let near = lines.bounds().widened(BESIDE);
                self.placed.push((lines, near));
                dimension
            }
            // Costs that are not numbers leave the first candidate.
            None => candidate(first),
        }
    }

    fn cost(&self, lines: &DimensionLines) -> f64 {
        let corners = lines.text_corners();
        let [under_text, along_line] = INK;
        let mut cost = under_text * self.obstacles.cost(&Bounds::of(corners), None);
        let [from, to] = lines.feet;
        let samples = (distance(from, to) / SAMPLE).ceil().max(1.0) as usize;
        for sample in 0..=samples {
            let part = sample as f64 / samples as f64;
            let at = [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]));
            let near = Bounds::around(at, [1.0; 2]);
            cost += along_line * self.obstacles.cost(&near, None);
        }
        let bounds = lines.bounds();
        let near = self.placed.iter().filter(|(_, near)| near.meets(&bounds));
        for (other, _) in near {
            for line in &lines.lines {
                for it in &other.lines {
                    cost += meeting(*line, *it);
                }
                cost += crossed_text(*line, other);
            }
            for it in &other.lines {
                cost += crossed_text(*it, lines);
            }
            let is_near = |it: &Point| other.text_clearance(*it) < 2.0;
            let other_corners = other.text_corners();
            let is_covered = corners.iter().chain([&lines.text_at]).any(is_near)
                || other_corners
                    .iter()
                    .any(|it| lines.text_clearance(*it) < 2.0);
            cost += if is_covered { COVERED } else { 0.0 };
        }
        cost
    }
}

/// Cost of a line across a text.
fn crossed_text(line: [Point; 2], text: &DimensionLines) -> f64 {
    let [a, b, c, d] = text.text_corners();
    let sides = [[a, b], [b, c], [c, d], [d, a]];
    match sides.iter().any(|side| is_crossing(line, *side)) {
        true => OVERLAP,
        false => 0.0,
    }
}

/// Cost of two lines that cross, or lie beside one another.
fn meeting(one: [Point; 2], other: [Point; 2]) -> f64 {
    if is_crossing(one, other) {
        return CROSSING;
    }
    let length = distance(one[0], one[1]);
    let along = scaled(difference(one[1], one[0]), 1.0 / length);
    let [from, to] = other.map(|it| {
        let gap = difference(it, one[0]);
        [dot(gap, along), dot(gap, left_of(along))]
    });
    let is_beside = from[1].abs() < BESIDE && to[1].abs() < BESIDE;
    let common = from[0].max(to[0]).min(length) - from[0].min(to[0]).max(0.0);
    match is_beside && common > 4.0 {
        true => OVERLAP,
        false => 0.0,
    }
}

/// True if two segments cross inside both of them.
fn is_crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |from: Point, to: Point, at: Point| {
        dot(left_of(difference(to, from)), difference(at, from))
    };
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_cross_inside_only() {
        let across = [[0.0, -1.0], [0.0, 1.0]];
        assert!(is_crossing([[-1.0, 0.0], [1.0, 0.0]], across));
        assert!(!is_crossing([[0.0, 0.0], [1.0, 0.0]], across));
    }
}
