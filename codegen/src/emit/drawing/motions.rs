//! Several motions of one mechanism → one picture, and the groups in which the other motions differ.
//!
//! Guides, bars and cylinders are as long as what moves needs, so that they are others in another assembly.

use std::collections::BTreeMap;

use super::draft::drafted;
use super::picture::{Composition, Options};
use super::pose::{Pose, Scene};
use super::svg::{Written, groups};
use crate::pool::Pool;
use crate::system::System;

/// A picture that is moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Moving {
    /// The SVG of the first motion.
    pub picture: String,
    /// For each of the others the elements that stand for those of the picture with the same ids.
    pub others: Vec<BTreeMap<String, String>>,
}

/// Draws a pose with room for those of its motion, and what is drawn otherwise for each of some other motions. A motion without a pose has
/// nothing of its own.
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
    let composition = Composition::new(system, &scene, &[], &options);
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
