//! Names the joints and bodies that take part in weak directions of Φ_q.
//!
//! In a singular pose a combination of equations restricts nothing new (left null vector), and some coordinates can move while every
//! driver stands still (right null vector). Components below [`SHARE`] of the largest are left out. Names are in written order, each
//! once.
use linkwright_codegen::stages::system::System;

use crate::condition::Weakness;

/// Smallest component of a participant, relative to the largest.
pub const SHARE: f64 = 0.1;

/// Largest number of names in a sentence, which counts the rest.
const MAX_LISTED: usize = 6;

/// Participants in a singularity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SingularParticipants {
    /// Labels of joints and drivers, as in the description.
    pub joints: Vec<String>,
    /// Names of bodies that can move.
    pub bodies: Vec<String>,
}

impl SingularParticipants {
    /// Returns the names of the directions of `weakness`.
    pub fn of(system: &System, weakness: &Weakness) -> SingularParticipants {
        let mechanism = &system.mechanism;
        let joints = taking_part(
            mechanism.joints.len(),
            system.rows.iter().map(|row| row.joint),
            weakness.equations.as_slice(),
        );
        let bodies = taking_part(
            mechanism.bodies.len(),
            system
                .coordinates
                .iter()
                .filter_map(|coordinate| coordinate.describes.body()),
            // The poses come first; contact points on curves follow from them.
            weakness.coordinates.as_slice(),
        );
        SingularParticipants {
            joints: joints
                .map(|joint| mechanism.joints[joint].label.clone())
                .collect(),
            bodies: bodies
                .map(|body| mechanism.bodies[body].name.clone())
                .collect(),
        }
    }
}

impl std::fmt::Display for SingularParticipants {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            formatter,
            "joints concerned: {}; bodies that can move: {}",
            listed(&self.joints),
            listed(&self.bodies)
        )
    }
}

/// Returns the groups whose largest component is at least [`SHARE`] of the largest of all.
fn taking_part(
    groups: usize,
    group_of: impl Iterator<Item = usize>,
    components: &[f64],
) -> impl Iterator<Item = usize> {
    let mut largest = vec![0.0_f64; groups];
    for (group, component) in group_of.zip(components) {
        largest[group] = largest[group].max(component.abs());
    }
    let limit = SHARE * largest.iter().copied().fold(0.0, f64::max);
    (0..groups).filter(move |group| largest[*group] >= limit && largest[*group] > 0.0)
}

/// Lists names: `a, b, c and 4 more`.
pub fn listed(names: &[String]) -> String {
    match names.len() {
        0 => "none".to_string(),
        count if count <= MAX_LISTED => names.join(", "),
        count => format!(
            "{} and {} more",
            names[..MAX_LISTED].join(", "),
            count - MAX_LISTED
        ),
    }
}
