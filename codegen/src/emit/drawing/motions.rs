//! Draws several motions of one mechanism: one picture, and the groups in which the other motions differ.
//!
//! The lengths of guides, bars and cylinders depend on the motion, so that they differ in another assembly.

use std::collections::BTreeMap;

use super::draft::drafted;
use super::picture::{Composition, Options};
use super::pose::{Pose, Scene};
use super::svg::{Written, groups};
use crate::pool::Pool;
use crate::system::System;

/// Picture for several motions.
#[derive(Clone, Debug, PartialEq)]
pub struct Moving {
    /// The SVG of the first motion.
    pub picture: String,
    /// For each other motion, the elements that replace those of the picture with equal ids.
    pub others: Vec<BTreeMap<String, String>>,
}

/// Draws a pose with room for those of its motion, and the differing elements of other motions. A motion without a
/// pose has none.
pub fn moving(
    pool: &Pool,
    system: &System,
    shown: &Pose,
    others: &[Pose],
    motions: &[Vec<Pose>],
    options: &Options,
) -> Moving {
    let options = Options {
        is_moving: true,
        ..options.clone()
    };
    let scene = Scene::new(pool, system, shown, others);
    let composition = Composition::new(system, &scene, &[], &options, None);
    let figure = &composition.figure;
    let base: BTreeMap<String, String> = groups(figure, "", Written::Motion).into_iter().collect();
    let differing = |poses: &Vec<Pose>| {
        let [shown, others @ ..] = &poses[..] else {
            return BTreeMap::new();
        };
        let scene = Scene::new(pool, system, shown, others);
        let (other, _) = drafted(&scene, figure.scale);
        let groups = groups(&other, "", Written::Motion).into_iter();
        groups
            .filter(|(id, text)| base.get(id) != Some(text))
            .collect()
    };
    Moving {
        picture: composition.text(Written::Moving),
        others: motions.iter().map(differing).collect(),
    }
}
