//! Directions in which a body slides, for the sheet of links.

use super::plane::{Point, RELATIVE_ROUNDING, difference, dot, left_of, scaled};
use super::pose::Scene;
use crate::joint::Feature;

/// Returns the points at which a body slides, with unit vectors along the slides. Lengths are pixels of its frame.
pub(super) fn slides(scene: &Scene, body: usize, scale: f64) -> Vec<(Point, Point)> {
    let place = scene.bodies[body].place;
    let mut slides: Vec<(Point, Point)> = Vec::new();
    let mut add = |at: Point, along: Point| {
        let at = scaled(at, scale);
        let is_known = |(it, other): &(Point, Point)| {
            let across = dot(left_of(*other), along).abs();
            across < RELATIVE_ROUNDING && dot(left_of(along), difference(at, *it)).abs() < 0.5
        };
        if !slides.iter().any(is_known) {
            slides.push((at, along));
        }
    };
    for sign in scene.signs.iter().filter(|it| !it.is_driver) {
        let is_slot = matches!(sign.feature, Feature::Slot(_));
        match (sign.feature, sign.line) {
            (Feature::Slide | Feature::Slot(_), Some(line)) => {
                let along = place.unrotate(scene.along(sign, line));
                for (mark, at) in sign.marks.iter().enumerate() {
                    // A pin in a slot turns, so that its own body has no direction.
                    if at.body == body && !(is_slot && mark == line.other) {
                        add(at.local, along);
                    }
                }
            }
            (Feature::Coordinate(axis), _) if sign.marks[0].body == body => {
                let signs = scene.signs.iter();
                let signs = signs.filter(|it| {
                    !it.is_driver && it.marks.first().is_some_and(|at| at.body == body)
                });
                let features: Vec<Feature> = signs.map(|it| it.feature).collect();
                let is_pinned = features.contains(&Feature::Coordinate(1 - axis));
                if features.contains(&Feature::Orientation) && !is_pinned {
                    let along = if axis == 0 { [0.0, 1.0] } else { [1.0, 0.0] };
                    add(sign.marks[0].local, place.unrotate(along));
                }
            }
            _ => {}
        }
    }
    slides
}
