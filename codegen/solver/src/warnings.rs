//! *The closest approaches of a motion to singular poses* → *sentences*.

use linkwright_codegen::stages::emit::derivation::SingularPose;

use crate::approach::Approach;
use crate::number::{scientific, time};

/// One sentence for each part that passes through a singular pose, or comes closer to one than `limit`.
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

/// Where the part of an approach is singular.
pub fn pose_of<'a>(approach: &Approach, poses: &'a [SingularPose]) -> Option<&'a SingularPose> {
    let own = (approach.part.block, approach.part.part);
    poses.iter().find(|pose| (pose.block, pose.part) == own)
}

/// `, and 3 more times`; empty for once.
pub fn times(count: usize) -> String {
    match count {
        0 | 1 => String::new(),
        2 => ", and once more".to_string(),
        count => format!(", and {} more times", count - 1),
    }
}
