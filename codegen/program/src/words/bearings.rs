//! Names the forces of wheels that the reactions exclude.

use super::lists::enumerated;
use super::phrase::{Phrase, Piece, phrase};
use crate::expr::Graph;
use crate::joint::{Feature, Mesh};
use crate::model::Mechanism;

/// Returns a sentence for each gear or belt whose forces are not carried by a bearing.
pub fn not_carried(mechanism: &Mechanism, graph: &mut Graph) -> Vec<Phrase> {
    let (mut gears, mut belts) = (Vec::new(), Vec::new());
    for joint in &mechanism.joints {
        let label = || Piece::Name(joint.label.clone()).into();
        match joint.kind.feature(&joint.operands, graph) {
            Some(Feature::Wheels(Mesh::External | Mesh::Internal, _)) => {
                gears.extend(joint.pressure_angle.is_none().then(label));
            }
            Some(Feature::Wheels(Mesh::Belt | Mesh::CrossedBelt, _)) => belts.push(label()),
            _ => {}
        }
    }
    let mut sentences = Vec::new();
    if !gears.is_empty() {
        let has = if gears.len() == 1 { "has" } else { "have" };
        sentences.push(phrase![
            "Gears couple angles only: bearings do not carry the tooth force of ",
            enumerated(&gears),
            ", which ",
            has,
            " no ",
            Piece::Name("pressure_angle".to_string()),
            "."
        ]);
    }
    if !belts.is_empty() {
        sentences.push(phrase![
            "Belts couple angles only: bearings do not carry the pull of ",
            enumerated(&belts),
            "."
        ]);
    }
    sentences
}
