//! A system of any shape → which equations depend on one another, and what can still move.

use super::functions::{Functions, Pose};
use super::independence::Basis;
use super::motion::{FreeMotion, free_motions};
use super::{LARGEST_SURVEY, balanced, pose};
use crate::model::Role;
use crate::system::System;

/// An equation that repeats others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dependence {
    /// The equation: an index into the rows and then the monitored rows of the system.
    pub row: usize,
    /// The equations that it repeats, ascending: without any of them it would say something. Empty where it says nothing by itself.
    pub repeats: Vec<usize>,
}

/// What the equations determine, near the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// KDOF: the coordinates less the independent equations of joints.
    pub kinematic: usize,
    /// NDOF: the coordinates less all independent equations.
    pub net: usize,
    /// The equations that repeat others: those of joints first, in written order, then those of drivers.
    pub dependences: Vec<Dependence>,
    /// What can still move, as many as NDOF.
    pub motions: Vec<FreeMotion>,
}

impl Survey {
    /// Looks at all rows of a system, the monitored ones included. `None` where the system is too large, or where no two poses
    /// are found in which the equations hold.
    pub fn of(system: &System) -> Option<Survey> {
        if system.coordinates.len() > LARGEST_SURVEY {
            return None;
        }
        let functions = whole(system, all_rows(system));
        let poses = poses(system, &functions);
        if poses.len() < 2 {
            return None;
        }
        Some(Survey::at(system, &functions, &poses))
    }

    fn at(system: &System, functions: &Functions<'_>, poses: &[Pose]) -> Survey {
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
            // The rank of a mechanism is the largest of any pose; elsewhere it is in a dead centre.
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
            motions: free_motions(system, functions, &regular),
        }
    }
}

/// Adds what a second pose shows: a part that vanishes by accident in one of them does not in the other.
fn join(found: &mut [Dependence], here: &[Dependence]) {
    for (found, here) in found.iter_mut().zip(here) {
        if found.row == here.row {
            found.repeats.extend(&here.repeats);
            found.repeats.sort_unstable();
            found.repeats.dedup();
        }
    }
}

/// All rows: those of joints in written order, then those of joints marked `redundant`, then those of drivers. What comes
/// later repeats what comes earlier.
pub(super) fn all_rows(system: &System) -> Vec<usize> {
    let mut rows: Vec<usize> = (0..system.rows.len() + system.monitored.len()).collect();
    rows.sort_by_key(|&at| {
        let joint = system.row(at).joint;
        let own = &system.mechanism.joints[joint];
        (own.role == Role::Driver, own.redundant.is_some(), joint, at)
    });
    rows
}

/// The functions of some rows by all coordinates.
pub(super) fn whole(system: &System, rows: Vec<usize>) -> Functions<'_> {
    Functions::new(system, rows, (0..system.coordinates.len()).collect())
}

/// The poses in which the rows hold.
pub(super) fn poses(system: &System, functions: &Functions<'_>) -> Vec<Pose> {
    (0..pose::COUNT)
        .filter_map(|number| {
            let mut pose = pose::start(system, number);
            (pose::project(functions, &mut pose) <= pose::HOLDS).then_some(pose)
        })
        .collect()
}
