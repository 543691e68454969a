//! Moves a mechanism in the plane of two drives, along straight lines between events.

use linkwright::Shell;

use super::super::ending::{EndKind, ending};
use super::super::line::{DriveLine, Place, TravelEvent};
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::measures::Measures;
use crate::supplied::InputLaws;
use crate::view::View;

/// Longest step of a line, in radians and characteristic lengths.
const LINE_STEP: f64 = 0.02;

/// Length to which events are enclosed, in radians and characteristic lengths.
const PRECISION: f64 = 1e-8;

/// Point of the plane: values of both drives minus those of the design configuration, in radians and characteristic lengths.
pub(crate) type Spot = [f64; 2];

/// Plane of two drives.
pub(crate) struct Plane {
    pub shell: Shell<Interpreted>,
    pub measures: Measures,
    /// Laws of all inputs; those of the drives are replaced.
    pub laws: InputLaws,
    /// Indices of the drives among the inputs.
    pub inputs: [usize; 2],
    /// Values of the drives in the design configuration (m or rad).
    pub origin: [f64; 2],
    /// Unit of each coordinate of the plane (m or rad).
    pub units: [f64; 2],
    /// Distance of each side of the window from the design configuration.
    pub window: [f64; 2],
    /// Names of the drives.
    pub names: [String; 2],
    /// Index of the observed point; `None` without one.
    pub point: Option<usize>,
}

/// Pose in the plane.
#[derive(Clone, Debug)]
pub(crate) struct PlanePose {
    pub spot: Spot,
    pub place: Place,
}

/// Result of a line.
#[derive(Clone, Debug)]
pub(crate) struct Cast {
    /// Last pose.
    pub last: PlanePose,
    /// Event at the end; `None` if the whole line lies in the region.
    pub hit: Option<Hit>,
}

/// Event at the end of a line.
#[derive(Clone, Debug)]
pub(crate) struct Hit {
    pub spot: Spot,
    pub kind: EndKind,
    pub words: String,
}

impl Plane {
    /// Returns the laws along a line: its length in place of time.
    fn laws(&self, from: Spot, direction: Spot) -> InputLaws {
        (0..2).fold(self.laws.clone(), |laws, drive| {
            let unit = self.units[drive];
            let line = [self.value(drive, from[drive]), direction[drive] * unit];
            laws.on_line(self.inputs[drive], line)
        })
    }

    /// Returns the value of a drive (m or rad).
    pub fn value(&self, drive: usize, coordinate: f64) -> f64 {
        self.origin[drive] + coordinate * self.units[drive]
    }

    /// Returns the frame of a pose with the rates along a direction; `None` if they are singular.
    pub fn frame(&self, pose: &PlanePose, direction: Spot) -> Option<Instant> {
        let laws = self.laws(pose.spot, direction);
        self.turned(pose, &laws).map(|shell| shell.frame().clone())
    }

    /// Returns the mechanism in a pose at the beginning of a line.
    fn turned(&self, pose: &PlanePose, laws: &InputLaws) -> Option<Shell<Interpreted>> {
        let mut shell = self.shell.clone();
        let inputs = laws.at(0.0);
        let mut instant = pose.place.instant.clone();
        instant.values_mut()[0] = 0.0;
        shell.resume(&instant, &pose.place.modes, &inputs);
        let frame = shell.frame_at(0.0, &inputs).ok()?;
        shell.resume(&frame, &pose.place.modes, &inputs);
        Some(shell)
    }

    /// Follows a line of this length to its first event, or to the window.
    pub fn cast(&self, from: &PlanePose, direction: Spot, length: f64) -> Option<Cast> {
        let laws = self.laws(from.spot, direction);
        let shell = self.turned(from, &laws)?;
        let (clipped, side) = self.clipped(from.spot, direction, length);
        let line = DriveLine {
            laws: &laws,
            measures: &self.measures,
            step: LINE_STEP,
            precision: PRECISION,
        };
        let at = |t: f64| along(from.spot, direction, t);
        let end = line.follow(shell.clone(), clipped, |_| ());
        let place = end.places.last()?.clone();
        let last = PlanePose {
            spot: at(place.instant.t()),
            place,
        };
        let hit = match end.event {
            TravelEvent::Complete if clipped < length => Some(Hit {
                spot: at(clipped),
                kind: EndKind::Unended,
                words: self.names[side].clone(),
            }),
            TravelEvent::Complete => None,
            _ => {
                let ending = ending(&line, &end, &shell);
                Some(Hit {
                    spot: at(end.outside),
                    kind: ending.kind,
                    words: ending.words,
                })
            }
        };
        Some(Cast { last, hit })
    }

    /// Returns the pose at a distance from a pose; `None` if an event comes first.
    pub fn moved(&self, from: &PlanePose, direction: Spot, length: f64) -> Option<PlanePose> {
        let cast = self.cast(from, direction, length)?;
        cast.hit.is_none().then_some(cast.last)
    }

    /// Returns the length of a line within the window, and the drive whose side it meets first.
    fn clipped(&self, from: Spot, direction: Spot, length: f64) -> (f64, usize) {
        let lengths = [0, 1].map(|axis| match direction[axis] {
            0.0 => length,
            rate => ((self.window[axis] * rate.signum() - from[axis]) / rate).max(0.0),
        });
        let side = usize::from(lengths[1] < lengths[0]);
        (length.min(lengths[side]), side)
    }

    /// Returns the position of the observed point; `None` without one.
    pub fn tip(&self, pose: &PlanePose) -> Option<[f64; 2]> {
        let points = self.shell.blocks().points(&pose.place.instant);
        Some(points.get(self.point?)?.position)
    }

    /// Returns the normalized determinant of the derivatives of the point by both drives; `None` without a point.
    pub fn tip_determinant(&self, pose: &PlanePose) -> Option<f64> {
        let [a, b] = [[1.0, 0.0], [0.0, 1.0]].map(|direction| {
            let frame = self.frame(pose, direction)?;
            let points = self.shell.blocks().points(&frame);
            Some(points.get(self.point?)?.velocity)
        });
        let ([ax, ay], [bx, by]) = (a?, b?);
        let size = ax.hypot(ay) * bx.hypot(by);
        match size > 0.0 {
            true => Some((ax * by - ay * bx) / size),
            false => Some(0.0),
        }
    }
}

/// Returns the point at a distance along a direction.
pub(crate) fn along(from: Spot, direction: Spot, length: f64) -> Spot {
    [0, 1].map(|axis| from[axis] + direction[axis] * length)
}

/// Returns the vector between two points.
pub(crate) fn between(from: Spot, to: Spot) -> Spot {
    [to[0] - from[0], to[1] - from[1]]
}

/// Returns the distance of two points.
pub(crate) fn distance(one: Spot, other: Spot) -> f64 {
    let [x, y] = between(one, other);
    x.hypot(y)
}

/// Returns the direction from one point to another; `None` if they coincide.
pub(crate) fn direction(from: Spot, to: Spot) -> Option<Spot> {
    let length = distance(from, to);
    let vector = between(from, to);
    (length > 0.0).then(|| vector.map(|it| it / length))
}

/// Returns a direction turned to the right.
pub(crate) fn right_of([x, y]: Spot) -> Spot {
    [y, -x]
}
