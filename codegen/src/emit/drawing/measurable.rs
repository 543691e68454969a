//! Chooses the lengths of each link that a drawing shows.
//!
//! They determine the points of a link: the longest distance, and the distances of every other point from both of its ends. Points
//! on one line have a chain from point to point, and the distance of each from the first.

use super::dimension::Measure;
use super::draft::{corners, distinct};
use super::figure::Figure;
use super::plane::{Point, RELATIVE_ROUNDING, difference, distance, dot, hull, scaled};
use super::pose::{Scene, Sign};
use crate::force::Shape;
use crate::joint::Feature;
use crate::units::OutputUnit;

/// Largest number of points whose distances are all shown on request.
const COMPLETE: usize = 5;

/// Smallest length that has a dimension, in pixels.
const SHORTEST: f64 = 2.0;

/// Link with the lengths that determine it.
#[derive(Clone, Debug, Default)]
pub(super) struct Measurable {
    /// Points in pixels of the figure.
    pub points: Vec<Point>,
    /// Pairs of points with their distances in m.
    pub distances: Vec<([usize; 2], f64)>,
    /// Circles with their diameters in m.
    pub diameters: Vec<(Point, f64)>,
}

/// Pair of points with the largest distance, the first of several; `None` for fewer than two points.
pub(super) fn longest(points: &[Point]) -> Option<[usize; 2]> {
    let long = |[a, b]: &[usize; 2]| distance(points[*a], points[*b]);
    all_pairs(points.len()).fold(None, |best: Option<[usize; 2]>, pair| match best {
        // Rounding does not decide between equal distances.
        Some(best) if long(&pair) <= long(&best) * (1.0 + RELATIVE_ROUNDING) => Some(best),
        _ => Some(pair),
    })
}

fn all_pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..count).flat_map(move |a| (a + 1..count).map(move |b| [a, b]))
}

/// Pairs of points whose distances determine all of them; all pairs of few points if `is_complete`.
pub(super) fn pairs(points: &[Point], is_complete: bool) -> Vec<[usize; 2]> {
    let count = points.len();
    let Some(base) = longest(points) else {
        return Vec::new();
    };
    if count > 2 && hull(points).len() == 2 {
        let along = difference(points[base[1]], points[base[0]]);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|a, b| dot(points[*a], along).total_cmp(&dot(points[*b], along)));
        let chain = order.windows(2).map(|it| [it[0], it[1]]);
        let from_first = order.iter().skip(2).map(|it| [order[0], *it]);
        return chain.chain(from_first).collect();
    }
    if is_complete && count <= COMPLETE {
        return all_pairs(count).collect();
    }
    let others = (0..count).filter(|it| !base.contains(it));
    let mut pairs = vec![base];
    pairs.extend(others.flat_map(|other| base.map(|end| [end.min(other), end.max(other)])));
    pairs
}

impl Measurable {
    /// Link with these points and these circles, given by center and radius, in pixels; a meter has `scale` of them.
    pub fn of(
        points: Vec<Point>,
        circles: impl Iterator<Item = (Point, f64)>,
        scale: f64,
        is_complete: bool,
    ) -> Measurable {
        let distances = pairs(&points, is_complete)
            .into_iter()
            .map(|[a, b]| ([a, b], distance(points[a], points[b]) / scale))
            .filter(|(_, length)| length * scale > SHORTEST);
        Measurable {
            distances: distances.collect(),
            diameters: circles
                .filter(|(_, radius)| 2.0 * radius > SHORTEST)
                .map(|(center, radius)| (center, 2.0 * radius / scale))
                .collect(),
            points,
        }
    }

    /// Link of this length (m) without a body.
    pub fn rod(ends: [Point; 2], length: f64) -> Measurable {
        Measurable {
            points: ends.to_vec(),
            distances: vec![([0, 1], length)],
            diameters: Vec::new(),
        }
    }
}

/// Links of a mechanism in the pose of a figure: its bodies, the ground, and links without a body.
pub(super) fn measurables(scene: &Scene, figure: &Figure) -> Vec<Measurable> {
    let scale = figure.scale;
    let mut corners = corners(scene, scale);
    // Points of the ground that only place bodies have nothing to be drilled for.
    corners[0] = fixed_points(scene, scale);
    let bodies = scene.bodies.iter().enumerate();
    let bodies = bodies.filter(|(_, it)| !it.is_dial).map(|(body, _)| {
        let place = figure.stance.places[body];
        let points = corners[body].iter().map(|it| place.globally(*it));
        let circles = figure.diameters.iter().filter(|it| it.at.body == body);
        let circles = circles.map(|it| (place.globally(it.at.local), it.radius));
        Measurable::of(points.collect(), circles, scale, false)
    });
    let links_alone = rods(scene).map(|(sign, length)| {
        let ends = [0, 1].map(|end| scaled(scene.global(sign.marks[end]), scale));
        Measurable::rod(ends, length)
    });
    bodies.chain(links_alone).collect()
}

/// Links of constant length without a body, with their lengths in m: those that are stated, or as they are drawn.
pub(super) fn rods(scene: &Scene) -> impl Iterator<Item = (&Sign, f64)> {
    let signs = scene.signs.iter();
    let rods = signs.filter(|it| it.feature == Feature::Link && !it.is_driver);
    let lengths = rods.map(|sign| {
        let [from, to] = [0, 1].map(|end| scene.global(sign.marks[end]));
        let is_stated = sign.number > 0.0;
        let length = if is_stated {
            sign.number
        } else {
            distance(from, to)
        };
        (sign, length)
    });
    lengths.filter(|(_, length)| *length > 0.0)
}

/// Points of the ground with a joint or a spring, in pixels.
pub(super) fn fixed_points(scene: &Scene, scale: f64) -> Vec<Point> {
    let mut points = Vec::new();
    let is_kept =
        |sign: &Sign, axis: usize| sign.feature == Feature::Coordinate(axis) && !sign.is_driver;
    for sign in &scene.signs {
        match sign.feature {
            Feature::Pin | Feature::Weld | Feature::Link | Feature::Slide | Feature::Slot(_) => {
                let on_ground = sign.marks.iter().filter(|it| it.body == 0);
                points.extend(on_ground.map(|it| it.local));
            }
            Feature::Coordinate(0) if is_kept(sign, 0) => {
                let mark = sign.marks[0];
                let mut others = scene.signs.iter();
                if others.any(|it| is_kept(it, 1) && it.marks[0] == mark) {
                    points.push(scene.global(mark));
                }
            }
            _ => {}
        }
    }
    for load in &scene.loads {
        if matches!(load.shape, Shape::Spring | Shape::Damper) {
            let on_ground = load.marks.iter().filter(|it| it.body == 0);
            points.extend(on_ground.map(|it| it.local));
        }
    }
    distinct(points.into_iter().map(|it| scaled(it, scale)))
}

/// Unit and decimals of the dimensions of links.
pub(super) fn measure(links: &[Measurable], unit: &OutputUnit) -> Measure {
    let distances = links.iter().flat_map(|link| &link.distances);
    let diameters = links.iter().flat_map(|link| &link.diameters);
    let lengths = distances.map(|it| it.1).chain(diameters.map(|it| it.1));
    Measure::of(unit, lengths)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_determine_all_points() {
        let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        assert_eq!(
            pairs(&square, false),
            [[0, 2], [0, 1], [1, 2], [0, 3], [2, 3]]
        );
        assert_eq!(pairs(&square, true).len(), 6);
        assert_eq!(pairs(&square[..1], true), Vec::<[usize; 2]>::new());
        assert_eq!(pairs(&square[..2], false), [[0, 1]]);
    }

    #[test]
    fn points_on_a_line_have_a_chain() {
        let line = [[5.0, 0.0], [0.0, 0.0], [9.0, 0.0], [7.0, 0.0]];
        assert_eq!(
            pairs(&line, false),
            [[1, 0], [0, 3], [3, 2], [1, 3], [1, 2]]
        );
    }
}
