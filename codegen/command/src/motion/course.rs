//! *Instants of a motion* → *what pictures of it are drawn from*: the course of each shown point and coordinate, and paths.

use linkwright::PointMotion;
use linkwright_solver::instant::Instant;

use super::{Curve, Path, Wanted, of_coordinate};

/// What pictures are drawn from.
#[derive(Clone, Debug)]
pub struct Course {
    /// Of each shown point x, y, their rates and their accelerations.
    pub points: Vec<Curve<6>>,
    /// The path of each shown point.
    pub paths: Vec<Path>,
    /// Each shown coordinate, its rate and its acceleration.
    pub coordinates: Vec<Curve<3>>,
    /// Each force that is asked for.
    pub forces: Vec<Curve<1>>,
}

impl Course {
    /// Nothing yet of what is wanted.
    pub fn of(wanted: &Wanted, forces: usize) -> Course {
        Course {
            points: vec![Curve::default(); wanted.points.len()],
            paths: vec![Path::default(); wanted.points.len()],
            coordinates: vec![Curve::default(); wanted.coordinates.len()],
            forces: vec![Curve::default(); forces],
        }
    }

    /// Takes the next instant.
    pub fn push(
        &mut self,
        instant: &Instant,
        motions: &[PointMotion],
        coordinates: &[usize],
        forces: &[f64],
    ) {
        let t = instant.t();
        for (curve, force) in self.forces.iter_mut().zip(forces) {
            curve.push(t, [*force]);
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
