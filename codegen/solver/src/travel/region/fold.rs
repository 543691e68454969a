//! Follows the curves on which the derivatives of a point by both drives are parallel: there the image of the plane folds.
//!
//! Changes of sign of the determinant along lines from the design configuration are the seeds.

use std::f64::consts::TAU;

use super::super::ending::EndKind;
use super::border::{BorderPoint, MAX_POINTS, is_beside};
use super::plane::{Plane, PlanePose, Spot, direction, distance, right_of};

/// Number of lines from the design configuration.
const SEED_RAYS: usize = 12;

/// Number of halvings that locate a zero.
const HALVINGS: usize = 30;

/// Zero of the determinant between two poses.
fn zero(plane: &Plane, from: &PlanePose, towards: Spot, length: f64) -> Option<PlanePose> {
    let sign = plane.tip_determinant(from)?;
    let (mut inside, mut near, mut far) = (from.clone(), 0.0, length);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (near + far);
        let pose = plane.moved(&inside, towards, middle - near)?;
        if plane.tip_determinant(&pose)? * sign > 0.0 {
            (inside, near) = (pose, middle);
        } else {
            far = middle;
        }
    }
    Some(inside)
}

/// Returns the curves inside the region; empty without a point.
pub(super) fn folds(
    plane: &Plane,
    start: &PlanePose,
    borders: &[Vec<BorderPoint>],
    step: f64,
) -> Vec<Vec<BorderPoint>> {
    let mut folds: Vec<Vec<BorderPoint>> = Vec::new();
    if plane.point.is_none() {
        return folds;
    }
    for ray in 0..SEED_RAYS {
        let angle = TAU * (ray as f64 + 0.17) / SEED_RAYS as f64;
        let towards = [angle.cos(), angle.sin()];
        let mut pose = start.clone();
        while let Some(next) = plane.moved(&pose, towards, step) {
            let signs = [&pose, &next].map(|it| plane.tip_determinant(it).unwrap_or(0.0));
            if signs[0] * signs[1] < 0.0
                && let Some(seed) = zero(plane, &pose, towards, step)
                && !folds.iter().any(|it| is_beside(it, seed.spot, step))
                && !borders
                    .iter()
                    .any(|it| is_beside(it, seed.spot, 0.05 * step))
            {
                folds.push(followed(plane, &seed, towards, step));
            }
            pose = next;
        }
    }
    folds
}

/// Follows a curve both ways from a pose on it.
fn followed(plane: &Plane, seed: &PlanePose, across: Spot, step: f64) -> Vec<BorderPoint> {
    let first = right_of(across);
    let forward = one_way(plane, seed, first, step);
    let is_closed = forward.len() > 4
        && forward
            .last()
            .is_some_and(|last| distance(last.spot, seed.spot) < 1.1 * step);
    let mut points = vec![point(seed.clone())];
    if is_closed {
        points.extend(forward);
        points.push(point(seed.clone()));
        return points;
    }
    let backward = one_way(plane, seed, first.map(|it| -it), step);
    let mut all: Vec<BorderPoint> = backward.into_iter().rev().collect();
    all.append(&mut points);
    all.extend(forward);
    all
}

fn one_way(plane: &Plane, seed: &PlanePose, first: Spot, step: f64) -> Vec<BorderPoint> {
    let mut points: Vec<BorderPoint> = Vec::new();
    let (mut pose, mut tangent) = (seed.clone(), first);
    while points.len() < MAX_POINTS {
        let Some(cast) = plane.cast(&pose, tangent, step) else {
            break;
        };
        let ahead = cast.last;
        let is_over = cast.hit.is_some();
        // At the border, the correction may lead out of the region.
        let next = corrected(plane, &ahead, tangent, step);
        let Some(next) = next.or_else(|| is_over.then_some(ahead)) else {
            break;
        };
        let Some(turned) = direction(pose.spot, next.spot) else {
            break;
        };
        (pose, tangent) = (next, turned);
        points.push(point(pose.clone()));
        let is_back = points.len() > 4 && distance(pose.spot, seed.spot) < step;
        if is_over || is_back {
            break;
        }
    }
    points
}

/// Returns the zero on the line across the curve through a pose.
fn corrected(plane: &Plane, pose: &PlanePose, tangent: Spot, step: f64) -> Option<PlanePose> {
    let here = plane.tip_determinant(pose)?;
    let across = right_of(tangent);
    let mut width = 0.02 * step;
    while width <= step {
        for towards in [across, across.map(|it| -it)] {
            let other = plane.moved(pose, towards, width);
            let there = other.and_then(|it| plane.tip_determinant(&it));
            if there.is_some_and(|there| there * here <= 0.0) {
                return zero(plane, pose, towards, width);
            }
        }
        width *= 3.0;
    }
    None
}

fn point(pose: PlanePose) -> BorderPoint {
    BorderPoint {
        spot: pose.spot,
        kind: EndKind::Unended,
        words: String::new(),
        pose,
    }
}
