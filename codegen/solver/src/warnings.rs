//! Warns of singular poses that a motion passes or comes close to.

use linkwright_codegen::stages::emit::derivation::SingularPose;

use crate::approach::Approach;
use crate::number::{scientific, time};

/// Returns one sentence for each subsystem that passes through a singular pose, or comes closer to one than `limit`.
pub fn warnings(approaches: &[Approach], poses: &[SingularPose], limit: f64) -> Vec<String> {
    let sentences = approaches.iter().filter_map(|approach| {
        let pose = pose_of(approach, poses)?;
        let how = match approach.crosses {
            true => "passes through a singular pose".to_string(),
            false if approach.measure < limit => {
                format!(
                    "only {} from a singular pose",
                    scientific(approach.measure, 2)
                )
            }
            false => return None,
        };
        Some(format!(
            "block {}, {}: {how} at t = {} s{}; {}",
            pose.block + 1,
            pose.unknowns,
            time(approach.instant.t()),
            times(approach.times),
            pose.sentence()
        ))
    });
    sentences.collect()
}

/// Returns the singular poses of the subsystem of an approach; `None` if there are none.
pub fn pose_of<'a>(approach: &Approach, poses: &'a [SingularPose]) -> Option<&'a SingularPose> {
    let subsystem = (approach.part.block, approach.part.part);
    poses
        .iter()
        .find(|pose| (pose.block, pose.part) == subsystem)
}

/// Returns `, and 3 more times`; empty for once.
pub fn times(count: usize) -> String {
    match count {
        0 | 1 => String::new(),
        2 => ", and once more".to_string(),
        count => format!(", and {} more times", count - 1),
    }
}
