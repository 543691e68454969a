//! Finds the region of two drives that is connected with the design configuration, and its image under a point.
//!
//! Lines from the design configuration hit the borders, which are followed from there.

mod border;
mod fold;
mod plane;

use std::f64::consts::{PI, TAU};

use linkwright_codegen::stages::structure::driven;
use linkwright_codegen::stages::system::Derived;

use super::ending::EndKind;
use super::line::Place;
use super::{Drive, Immovable};
use crate::interpreted::Interpreted;
use crate::view::View;
use border::{BorderPoint, border, is_beside};
use plane::{Hit, Plane, PlanePose, direction, distance};

/// Number of lines from the design configuration that look for borders.
const RAYS: usize = 24;

/// Longest step along a border, as a part of the mean length of these lines.
const BORDER_STEP: f64 = 0.03;

/// Length of a step along a fold, as a part of that length.
const FOLD_STEP: f64 = 0.02;

/// Half the width of the window of a length, in characteristic lengths.
const WINDOW_LENGTH: f64 = 3.0;

/// Region of two drives.
#[derive(Clone, Debug)]
pub struct Region {
    /// Drives.
    pub drives: [Drive; 2],
    /// Values in the design configuration, in m or rad.
    pub start: [f64; 2],
    /// Position of the point in the design configuration, in m; `None` without one.
    pub start_tip: Option<[f64; 2]>,
    /// Borders, the outer one first, each closed unless it was lost.
    pub borders: Vec<Curve>,
    /// Curves inside on which the point's derivatives by both drives are parallel.
    pub folds: Vec<Curve>,
}

/// Curve in the plane of two drives.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    /// Sections of one kind each, in the order along the curve. The end of a section is the start of the next one.
    pub sections: Vec<Section>,
    /// True if the curve ends where it begins.
    pub is_closed: bool,
}

/// Section of a border.
#[derive(Clone, Debug)]
pub struct Section {
    /// Kind; `Unended` on the side of the window.
    pub kind: EndKind,
    /// Block with its state, or limit, in words; on the side of the window the name of the drive.
    pub words: String,
    /// Values of both drives, in m or rad.
    pub values: Vec<[f64; 2]>,
    /// Positions of the point, in m; empty without one.
    pub tips: Vec<[f64; 2]>,
}

impl Region {
    /// Follows the borders of the region about the assembly in the design modes at `t` (s). `point` is an index among the points of the
    /// description. `see` receives the number of border points so far.
    ///
    /// # Errors
    /// The reason that the drives cannot be followed.
    pub fn new(
        derived: &Derived,
        drives: &[Drive; 2],
        t: f64,
        point: Option<usize>,
        mut see: impl FnMut(usize),
    ) -> Result<Region, Immovable> {
        let joints = [drives[0].joint, drives[1].joint];
        let driven = driven(derived, &joints, t).ok_or(Immovable::Unsolvable)?;
        let interpreted = Interpreted::new(&driven).ok_or(Immovable::Unsolvable)?;
        let plane = plane_of(interpreted, drives, point)?;
        let start = PlanePose {
            spot: [0.0; 2],
            place: Place::of(&plane.shell),
        };
        let rays = (0..RAYS).map(|it| TAU * (it as f64 + 0.3) / RAYS as f64);
        let far = plane.window[0].hypot(plane.window[1]) * 2.0;
        let casts = rays.filter_map(|angle| plane.cast(&start, [angle.cos(), angle.sin()], far));
        let hits = casts.filter_map(|cast| Some((cast.last, cast.hit?)));
        let hits: Vec<(PlanePose, Hit)> = hits.collect();
        let lengths = hits.iter().map(|(_, hit)| distance([0.0; 2], hit.spot));
        let mean = lengths.sum::<f64>() / hits.len().max(1) as f64;
        let longest = BORDER_STEP * mean;
        let (mut followed, mut count) = (Vec::<Vec<BorderPoint>>::new(), 0);
        for (near, hit) in &hits {
            if followed.iter().any(|it| is_beside(it, hit.spot, longest)) {
                continue;
            }
            let points = border(&plane, &start, (near, hit), longest, |points| {
                see(count + points)
            });
            count += points.len();
            if points.len() > 1 {
                followed.push(points);
            }
        }
        let followed = without_fragments(followed, longest);
        let folds = fold::folds(&plane, &start, &followed, FOLD_STEP * mean);
        Ok(Region {
            drives: drives.clone(),
            start: plane.origin,
            start_tip: plane.tip(&start),
            borders: followed.iter().map(|it| curve(&plane, it)).collect(),
            folds: folds.iter().map(|it| curve(&plane, it)).collect(),
        })
    }
}

/// Returns closed borders first, and those that were lost only if no closed one covers them.
fn without_fragments(all: Vec<Vec<BorderPoint>>, within: f64) -> Vec<Vec<BorderPoint>> {
    let (mut closed, open): (Vec<_>, Vec<_>) = all.into_iter().partition(|it| is_closed(it));
    let is_covered = |point: &BorderPoint| {
        let mut borders = closed.iter();
        borders.any(|it| is_beside(it, point.spot, within))
    };
    let lost = open.into_iter().filter(|it| !it.iter().all(is_covered));
    let lost: Vec<_> = lost.collect();
    closed.extend(lost);
    closed
}

/// True if a border ends where it begins.
fn is_closed(points: &[BorderPoint]) -> bool {
    points.len() > 2 && points[0].spot == points[points.len() - 1].spot
}

/// Returns the plane of two drives about the design configuration.
fn plane_of(
    interpreted: Interpreted,
    drives: &[Drive; 2],
    point: Option<usize>,
) -> Result<Plane, Immovable> {
    let mechanism = &interpreted.system().mechanism;
    let count = mechanism.inputs.len();
    let inputs = [count - 2, count - 1];
    let length = mechanism.characteristic_length;
    let value = |input: usize| {
        let initial = mechanism.inputs[input].initial;
        let value = interpreted.pool().graph.constant_value(initial);
        value.ok_or(Immovable::Unsolvable)
    };
    let origin = [value(inputs[0])?, value(inputs[1])?];
    let laws = interpreted.input_laws();
    let shell = interpreted.assembled_as_drawn(0.0);
    let shell = shell.map_err(|failure| Immovable::NotAssembled(interpreted.reported(&failure)))?;
    Ok(Plane {
        measures: interpreted.measured(),
        laws,
        names: drives.each_ref().map(|it| it.name.clone()),
        inputs,
        origin,
        units: [0, 1].map(|it| if drives[it].is_angle { 1.0 } else { length }),
        window: [0, 1].map(|it| {
            if drives[it].is_angle {
                PI
            } else {
                WINDOW_LENGTH
            }
        }),
        point,
        shell,
    })
}

/// Parts of the way to the border at which a pose is tried.
const NEARLY: [f64; 3] = [1.0 - 1e-9, 1.0 - 1e-6, 1.0 - 1e-3];

/// Returns the pose of a border point as near to it as one exists.
fn at_border(plane: &Plane, point: &BorderPoint) -> PlanePose {
    let from = &point.pose;
    let Some(outward) = direction(from.spot, point.spot) else {
        return from.clone();
    };
    let length = distance(from.spot, point.spot);
    let mut poses = NEARLY.iter();
    let reached = poses.find_map(|part| plane.moved(from, outward, part * length));
    reached.unwrap_or_else(|| from.clone())
}

/// Returns the sections of a followed curve.
fn curve(plane: &Plane, points: &[BorderPoint]) -> Curve {
    let mut sections: Vec<Section> = Vec::new();
    for point in points {
        let values = [0, 1].map(|drive| plane.value(drive, point.spot[drive]));
        let tip = plane.tip(&at_border(plane, point));
        let is_same = sections
            .last()
            .is_some_and(|it| it.kind == point.kind && it.words == point.words);
        if let (Some(last), false) = (sections.last_mut(), is_same) {
            last.values.push(values);
            last.tips.extend(tip);
        }
        if !is_same {
            sections.push(Section {
                kind: point.kind,
                words: point.words.clone(),
                values: Vec::new(),
                tips: Vec::new(),
            });
        }
        if let Some(last) = sections.last_mut() {
            last.values.push(values);
            last.tips.extend(tip);
        }
    }
    Curve {
        sections,
        is_closed: is_closed(points),
    }
}
