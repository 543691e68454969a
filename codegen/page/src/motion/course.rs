//! Collects the data of plots and pictures of a motion: the course of each selected point and coordinate, and paths.

use linkwright::PointMotion;
use linkwright_solver::Instant;

use super::{Curve, Path, Wanted, of_coordinate};

/// Data of plots and pictures.
#[derive(Clone, Debug)]
pub struct Course {
    /// x, y, their rates and their accelerations, per selected point.
    pub points: Vec<Curve<6>>,
    /// Path of each selected point.
    pub paths: Vec<Path>,
    /// Value, rate and acceleration of each selected coordinate.
    pub coordinates: Vec<Curve<3>>,
    /// Requested forces and measures.
    pub reported: Vec<Curve<1>>,
    /// Path of each pair of quantities, in SI units.
    pub pairs: Vec<Path>,
}

impl Course {
    /// Creates an empty course of the selection `wanted` and of so many forces and measures.
    pub fn of(wanted: &Wanted, reported: usize) -> Course {
        Course {
            points: vec![Curve::default(); wanted.points.len()],
            paths: vec![Path::default(); wanted.points.len()],
            coordinates: vec![Curve::default(); wanted.coordinates.len()],
            reported: vec![Curve::default(); reported],
            pairs: vec![Path::default(); wanted.pairs.len()],
        }
    }

    /// Adds the next instant.
    pub fn push(
        &mut self,
        instant: &Instant,
        motions: &[PointMotion],
        coordinates: &[usize],
        reported: &[f64],
    ) {
        let t = instant.t();
        for (curve, value) in self.reported.iter_mut().zip(reported) {
            curve.push(t, [*value]);
        }
        for ((curve, path), motion) in self.points.iter_mut().zip(&mut self.paths).zip(motions) {
            let ([x, y], [vx, vy], [ax, ay]) =
                (motion.position, motion.velocity, motion.acceleration);
            curve.push(t, [x, y, vx, vy, ax, ay]);
            path.push(motion.position);
        }
        for (curve, coordinate) in self.coordinates.iter_mut().zip(coordinates) {
            curve.push(t, of_coordinate(instant, *coordinate));
        }
    }
}
