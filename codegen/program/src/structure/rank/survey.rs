//! Surveys a system of any shape: equations that depend on one another, and free motions.

use super::functions::{Functions, Pose};
use super::independence::Basis;
use super::motion::{FreeMotion, free_motions};
use super::{LARGEST_SURVEY, balanced, pose};
use crate::model::Role;
use crate::pool::Pool;
use crate::system::System;

/// Equation that repeats others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dependence {
    /// Equation: an index into the rows and then the monitored rows of the system.
    pub row: usize,
    /// Equations that it repeats, ascending; without any one of them, it would be independent. Empty if it states nothing by
    /// itself.
    pub repeats: Vec<usize>,
}

/// Rank and free motions of a system near its design configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// KDOF: the number of coordinates less that of independent joint equations.
    pub kinematic: usize,
    /// NDOF: the number of coordinates less that of all independent equations.
    pub net: usize,
    /// Equations that repeat others: those of joints first, in written order, then those of drivers.
    pub dependences: Vec<Dependence>,
    /// Free motions, as many as NDOF.
    pub motions: Vec<FreeMotion>,
}

impl Survey {
    /// Surveys all rows of a system, including monitored ones. `None` if the system is too large, or if fewer than two consistent
    /// poses are found.
    pub fn of(pool: &Pool, system: &System) -> Option<Survey> {
        if system.coordinates.len() > LARGEST_SURVEY {
            return None;
        }
        let functions = whole(pool, system, all_rows(system));
        let poses = poses(pool, system, &functions);
        if poses.len() < 2 {
            return None;
        }
        Some(Survey::at(pool, system, &functions, &poses))
    }

    fn at(pool: &Pool, system: &System, functions: &Functions<'_>, poses: &[Pose]) -> Survey {
        let coordinates = system.coordinates.len();
        let is_joint = |at: usize| {
            let row = system.row(at);
            system.mechanism.joints[row.joint].role == Role::Constraint
        };
        let (mut kinematic, mut net) = (coordinates, coordinates);
        let mut dependences: Option<Vec<Dependence>> = None;
        for pose in poses {
            let (rows, _) = balanced(functions.jacobian(pose));
            let mut basis = Basis::default();
            let mut here = Vec::new();
            let mut of_joints = 0;
            for (&at, row) in functions.rows.iter().zip(&rows) {
                if let Err(parts) = basis.take(at, row) {
                    let mut repeats: Vec<usize> = parts.into_iter().map(|part| part.0).collect();
                    repeats.sort_unstable();
                    here.push(Dependence { row: at, repeats });
                } else if is_joint(at) {
                    of_joints += 1;
                }
            }
            // The rank of a mechanism is its largest rank in any pose; a smaller one occurs in dead centers.
            kinematic = kinematic.min(coordinates - of_joints);
            net = net.min(coordinates - basis.rank());
            let fewer = dependences
                .as_ref()
                .is_none_or(|found| here.len() < found.len());
            match &mut dependences {
                Some(found) if !fewer => join(found, &here),
                found => *found = Some(here),
            }
        }
        let regular: Vec<Pose> = poses
            .iter()
            .filter(|pose| {
                let (rows, _) = balanced(functions.jacobian(pose));
                let mut basis = Basis::default();
                let taken = rows.iter().enumerate();
                let rank = taken.filter(|(at, row)| basis.take(*at, row).is_ok());
                coordinates - rank.count() == net
            })
            .cloned()
            .collect();
        Survey {
            kinematic,
            net,
            dependences: dependences.unwrap_or_default(),
            motions: free_motions(pool, system, functions, &regular),
        }
    }
}

/// Merges the dependences of a second pose: a factor that vanishes by accident in one pose does not in the other.
fn join(found: &mut [Dependence], here: &[Dependence]) {
    for (found, here) in found.iter_mut().zip(here) {
        if found.row == here.row {
            found.repeats.extend(&here.repeats);
            found.repeats.sort_unstable();
            found.repeats.dedup();
        }
    }
}

/// Returns all rows: those of joints in written order, then those of joints marked `redundant`, then those of drivers. Later rows
/// repeat earlier ones.
pub(super) fn all_rows(system: &System) -> Vec<usize> {
    let mut rows: Vec<usize> = (0..system.rows.len() + system.monitored.len()).collect();
    rows.sort_by_key(|&at| {
        let joint = system.row(at).joint;
        let declared = &system.mechanism.joints[joint];
        (
            declared.role == Role::Driver,
            declared.redundant.is_some(),
            joint,
            at,
        )
    });
    rows
}

/// Selects rows with all coordinates.
pub(super) fn whole<'a>(pool: &'a Pool, system: &'a System, rows: Vec<usize>) -> Functions<'a> {
    Functions::new(pool, system, rows, (0..system.coordinates.len()).collect())
}

/// Returns the poses in which the rows hold.
pub(super) fn poses(pool: &Pool, system: &System, functions: &Functions<'_>) -> Vec<Pose> {
    (0..pose::COUNT)
        .filter_map(|number| {
            let mut pose = pose::start(pool, system, number);
            (pose::project(functions, &mut pose) <= pose::HOLDS).then_some(pose)
        })
        .collect()
}
