//! A block of the plan → what a person calls it, and what a person says where it is singular.

use crate::structure::{SolvedBlock, Step};
use crate::system::System;

/// How many joints a name lists.
const LISTED: usize = 6;

/// `loop F-N-M`: the pins that are closed, or else the statements of all joints.
pub(super) fn spoken(block: &SolvedBlock, system: &System) -> String {
    let joints = || {
        block
            .joints
            .iter()
            .map(|&joint| &system.mechanism.joints[joint])
    };
    let pins: Vec<&str> = joints()
        .filter(|joint| joint.kind.joins_points())
        .filter_map(|joint| {
            let (_, operands) = joint.label.split_once(' ')?;
            Some(operands.split_once('(').map_or(operands, |(pin, _)| pin))
        })
        .collect();
    if pins.len() > 1 && !block.steps.is_empty() {
        return format!("loop {}", pins[..pins.len().min(LISTED)].join("-"));
    }
    let labels: Vec<&str> = joints().map(|joint| joint.label.as_str()).collect();
    match labels.len().checked_sub(LISTED) {
        None | Some(0) => labels.join(", "),
        Some(more) => format!("{} and {more} more", labels[..LISTED].join(", ")),
    }
}

/// `c2 and c8 are in line`.
pub(super) fn singular(block: &SolvedBlock, system: &System) -> String {
    let who = |unknown: usize| {
        let coordinate = system.coordinates.get(unknown);
        let body = coordinate.and_then(|coordinate| coordinate.describes.body());
        match body {
            Some(body) => system.mechanism.bodies[body].name.clone(),
            None => system.unknown_name(unknown).to_string(),
        }
    };
    let name = |unknown: usize| system.unknown_name(unknown);
    let sentences = block.steps.iter().map(|step| match step {
        Step::Linear { unknown, .. } => format!("nothing determines {}", name(*unknown)),
        Step::OneAngle { unknown, .. } => {
            format!(
                "{} lies straight along what it has to bridge",
                who(*unknown)
            )
        }
        Step::TwoRotations { first, second, .. } => {
            format!("{} and {} are in line", who(*first), who(*second))
        }
        Step::RotationAndSlide { angle, slide, .. } => {
            format!(
                "{} is at right angles to the line of {}",
                who(*angle),
                name(*slide)
            )
        }
        Step::TurningSlide { angle, .. } => format!(
            "the line on {} touches the circle of its offset",
            who(*angle)
        ),
        Step::TwoSlides { first, second, .. } => {
            format!(
                "the lines of {} and {} are parallel",
                name(*first),
                name(*second)
            )
        }
        Step::Newton { unknowns, .. } => {
            let mut names: Vec<String> = unknowns.iter().map(|&unknown| who(unknown)).collect();
            names.dedup();
            format!("{} can move although the rest stands still", joined(&names))
        }
    });
    sentences.collect::<Vec<_>>().join(", or ")
}

/// `a, b and c`.
fn joined(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
