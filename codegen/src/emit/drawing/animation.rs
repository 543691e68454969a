//! Draws a motion as an animated picture, or as one picture for each pose.

use super::extras::Traced;
use super::keyframes::Keyframes;
use super::picture::{Composition, Options};
use super::pose::{Pose, Scene};
use super::svg::Written;
use crate::pool::Pool;
use crate::system::System;

/// A motion that is drawn with one scale.
#[derive(Debug)]
pub struct Animation {
    scene: Scene,
    composition: Composition,
}

impl Animation {
    /// Composes the picture of these poses; `None` without a pose.
    pub fn new(
        pool: &Pool,
        system: &System,
        poses: &[Pose],
        paths: &[Traced],
        options: &Options,
    ) -> Option<Animation> {
        let (shown, others) = poses.split_first()?;
        let options = Options {
            is_moving: true,
            ..options.clone()
        };
        let scene = Scene::new(pool, system, shown, others);
        Some(Animation {
            composition: Composition::new(system, &scene, paths, &options, None),
            scene,
        })
    }

    /// Number of poses: one at least.
    pub fn count(&self) -> usize {
        self.scene.motion.len()
    }

    /// One of the poses as an SVG.
    pub fn frame(&self, pose: usize) -> String {
        let figure = &self.composition.figure;
        let figure = figure.moved(self.scene.stance(pose, figure.scale));
        self.composition.text_of(&figure, Written::Frame)
    }

    /// SVG that shows the poses at equal times in this many seconds, forever.
    pub fn smil(&self, duration: f64) -> String {
        let scale = self.composition.figure.scale;
        let stances = (0..self.count()).map(|pose| self.scene.stance(pose, scale));
        let keyframes = Keyframes {
            stances: stances.collect(),
            duration,
        };
        self.composition.text(Written::Animated(&keyframes))
    }
}
