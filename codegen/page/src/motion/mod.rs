//! Follows a mechanism over a schedule, instant by instant, and collects findings.
//!
//! Instants are handed on when they are solved, and are not kept: a motion of any length takes the same memory.

mod columns;
mod compared;
mod course;
mod curve;
mod follow;
mod followed;
mod mean_square;
mod path;
mod rows;
mod selection;
mod simulated;
mod stopped;

pub use columns::{Column, Columns, OF_POINT, RATES};
pub use compared::Compared;
pub use course::Course;
pub use curve::{Curve, Extreme};
pub use followed::{EarlyEnd, Followed};
pub use mean_square::MeanSquare;
pub use path::Path;
pub use rows::{Row, Rows};
pub use selection::{named_point, points, shown};
pub(crate) use simulated::advance;
pub use simulated::{Listeners, Simulated};

use std::io;

use linkwright::PointMotion;
use linkwright_solver::{Instant, Observable};

/// Selection of quantities of a motion; nothing by default.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Selected points: indices into the system's outputs.
    pub points: Vec<usize>,
    /// Selected coordinates: indices into the system's coordinates.
    pub coordinates: Vec<usize>,
    /// True if the distance of each block from a singular pose is measured.
    pub monitor: bool,
    /// True if the data of pictures are kept.
    pub curves: bool,
    /// Pairs of quantities, of which pictures show the second against the first.
    pub pairs: Vec<[Observable; 2]>,
}

/// One requested instant of a motion.
pub struct Shown<'a> {
    /// Pose, rates and accelerations.
    pub instant: &'a Instant,
    /// Motion of each selected point.
    pub motions: &'a [PointMotion],
    /// Requested transmissions and sensitivities in the order of their names; `None` if the equations are singular.
    pub derivatives: Option<&'a [f64]>,
    /// Driving forces, reactions, energies and measures in the order of their names; `None` if the equations are singular.
    pub reported: Option<&'a [f64]>,
    /// Distance of each block from a singular pose; empty unless it is requested.
    pub measures: &'a [f64],
}

/// Receiver of requested instants.
pub trait Sink {
    /// Receives the next instant.
    ///
    /// # Errors
    /// Errors of the output that the sink writes.
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()>;
}

/// Returns a coordinate, its rate and its acceleration.
fn of_coordinate(instant: &Instant, coordinate: usize) -> [f64; 3] {
    [instant.q(), instant.qd(), instant.qdd()].map(|level| level[coordinate])
}
