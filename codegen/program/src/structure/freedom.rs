//! Counts degrees of freedom, and describes the motion that remains.

use super::rank::{FreeMotion, Moves, Survey, singular};
use super::{Incidence, coarse_decomposition, maximum_matching};
use crate::model::Role;
use crate::pool::Pool;
use crate::system::System;

/// Largest second component of a unit vector that is named as an axis.
const ON_AXIS: f64 = 1e-6;

/// Degrees of freedom of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// KDOF: the number of coordinates less that of independent joint equations.
    pub kinematic: usize,
    /// NDOF: KDOF less the number of independent driver equations.
    pub net: usize,
    /// Number of equations that repeat others.
    pub redundant: usize,
}

impl Freedom {
    /// Counts degrees of freedom at poses near the design configuration in which the equations hold. Counts equations only if
    /// such poses do not exist, or if there are too many coordinates for a numerical rank.
    pub fn of(pool: &Pool, system: &System) -> Freedom {
        let incidence = Incidence::of(system);
        let matching = maximum_matching(&incidence);
        let is_square = coarse_decomposition(&incidence, &matching).is_square();
        let independent = is_square && singular(pool, system, &incidence, &matching).is_none();
        let surveyed = if independent {
            None
        } else {
            Survey::of(pool, system)
        };
        if let Some(found) = surveyed {
            return Freedom {
                kinematic: found.kinematic,
                net: found.net,
                redundant: found.dependences.len(),
            };
        }
        let joints = &system.mechanism.joints;
        let is_joint = |row: &&crate::system::Row| joints[row.joint].role == Role::Constraint;
        let of_joints = system.rows.iter().filter(is_joint).count();
        let coordinates = system.coordinates.len();
        Freedom {
            kinematic: coordinates.saturating_sub(of_joints),
            net: coordinates.saturating_sub(system.rows.len()),
            redundant: system.monitored.len(),
        }
    }
}

impl FreeMotion {
    /// Describes the motion in a sentence without a full stop: "`c6` can still turn about `D`, and `c7` moves with it".
    pub fn sentence(&self, system: &System) -> String {
        let name = |body: usize| format!("`{}`", system.mechanism.bodies[body].name);
        let Some(leader) = self.leader else {
            return match self.moves {
                Moves::Contact(joint) => {
                    let label = &system.mechanism.joints[joint].label;
                    format!("`{label}` can still slide along its curve")
                }
                _ => "something can still move".to_string(),
            };
        };
        let leader = name(leader);
        let moves = match &self.moves {
            Moves::About(point) => format!("turn about `{point}`"),
            Moves::AboutOrigin => "turn about its origin".to_string(),
            Moves::Turning => "turn".to_string(),
            Moves::Along(line) => format!("slide along `{line}`"),
            Moves::Toward([x, y]) => {
                if y.abs() < ON_AXIS {
                    "move along x".to_string()
                } else if x.abs() < ON_AXIS {
                    "move along y".to_string()
                } else {
                    format!("move along ({x:.3}, {y:.3})")
                }
            }
            Moves::Contact(_) => "move along its curve".to_string(),
        };
        const MAX_LISTED: usize = 6;
        let more = self.others.len().saturating_sub(MAX_LISTED);
        let listed: Vec<String> = self
            .others
            .iter()
            .take(MAX_LISTED)
            .map(|&it| name(it))
            .collect();
        match (listed.as_slice(), more) {
            ([], _) => format!("{leader} can still {moves}"),
            ([only], _) => format!("{leader} can still {moves}, and {only} moves with it"),
            (several, 0) => {
                let several = several.join(", ");
                format!("{leader} can still {moves}, and {several} move with it")
            }
            (several, more) => {
                let several = several.join(", ");
                format!("{leader} can still {moves}, and {several} and {more} more move with it")
            }
        }
    }
}
