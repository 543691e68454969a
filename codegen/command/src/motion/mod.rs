//! *A mechanism and a schedule* → *its motion, instant by instant, and what is to be said of it afterwards*.
//!
//! Instants are handed on as they are found and not kept, so that a motion of any length takes the same memory. The module does not
//! know how anything is printed.

mod course;
mod curve;
mod follow;
mod followed;
mod path;
mod rows;
mod selection;
mod simulated;

pub use course::Course;
pub use curve::{Curve, Extreme};
pub use followed::Followed;
pub use path::Path;
pub use rows::{Row, Rows};
pub use selection::{named_point, points, shown};
pub use simulated::{Listeners, Simulated, hint};

use std::io;

use linkwright::PointMotion;
use linkwright_solver::instant::Instant;

/// What is wanted of a motion.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Which points are shown: indices into the system's outputs.
    pub points: Vec<usize>,
    /// Which coordinates are shown: indices into the system's coordinates.
    pub coordinates: Vec<usize>,
    /// Whether to say how close each part is to a singular pose.
    pub monitor: bool,
    /// Whether to keep what pictures are drawn from.
    pub curves: bool,
}

/// One wanted instant of a motion.
pub struct Shown<'a> {
    /// The instant.
    pub instant: &'a Instant,
    /// The motion of each shown point.
    pub motions: &'a [PointMotion],
    /// What transmissions and sensitivities ask for, in the order of their names; `None` where the equations are singular.
    pub derivatives: Option<&'a [f64]>,
    /// What drivers exert, joints carry and bodies store, in the order of their names; `None` where the equations are singular.
    pub forces: Option<&'a [f64]>,
    /// How close each part is to a singular pose, where that is wanted.
    pub measures: &'a [f64],
}

/// Where wanted instants go.
pub trait Sink {
    /// Takes the next one.
    ///
    /// # Errors
    /// Those of what it is written to.
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()>;
}

/// A coordinate, its rate and its acceleration.
fn of_coordinate(instant: &Instant, coordinate: usize) -> [f64; 3] {
    [instant.q(), instant.qd(), instant.qdd()].map(|level| level[coordinate])
}
