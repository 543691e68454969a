//! Mechanisms constructed from bodies in exact poses, points and joints, and their descriptions.
//!
//! Every length, offset and angle is measured in the poses, so that the poses satisfy the equations at t = 0, up to
//! rounding.

use std::fmt::Write as _;

use super::joint::{Joint, name};
use super::law::Law;
use super::motion::Motions;
use crate::stability::precise::Precise;
use crate::stability::truth::Levels;

/// Index of the fixed body.
pub const GROUND: usize = 0;

/// x, y (m) and angle (rad).
pub type Pose = [f64; 3];

/// Point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Body.
    pub body: usize,
    /// Position at t = 0, in global coordinates (m).
    pub place: [f64; 2],
}

/// Mechanism by construction.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Size (m).
    pub size: f64,
    /// Poses at t = 0; the first is that of the ground.
    pub bodies: Vec<Pose>,
    /// Offset of each body's estimate.
    pub drawn_off: Vec<Pose>,
    /// The points.
    pub points: Vec<Point>,
    /// The joints and drivers, and the group of each.
    pub joints: Vec<(Joint, usize)>,
    /// Name of each group.
    pub groups: Vec<&'static str>,
    /// The bodies in the order in which they are written.
    pub body_order: Vec<usize>,
    /// The joints in the order in which they are written.
    pub joint_order: Vec<usize>,
    /// Motions; `None` if drivers stand outside motions.
    pub motions: Option<Motions>,
}

impl Mechanism {
    /// Position of a point in these poses of all bodies.
    pub fn place(&self, point: usize, poses: &[Pose]) -> [f64; 2] {
        let body = self.points[point].body;
        let [x, y, angle] = poses[body];
        let carried = rotated(self.local(point), angle);
        [x + carried[0], y + carried[1]]
    }

    /// Position of a point in the frame of its body.
    pub fn local(&self, point: usize) -> [f64; 2] {
        let Point { body, place } = self.points[point];
        let [x, y, angle] = self.bodies[body];
        rotated(difference(place, [x, y]), -angle)
    }

    /// Poses of all bodies among coordinates in written order.
    pub fn poses(&self, q: &[f64]) -> Vec<Pose> {
        let mut poses = self.bodies.clone();
        for (values, body) in q.chunks_exact(3).zip(&self.body_order) {
            poses[*body] = [values[0], values[1], values[2]];
        }
        poses
    }

    /// Coordinates at t = 0, in written order.
    pub fn coordinates(&self) -> Vec<f64> {
        let bodies = self.body_order.iter();
        bodies.flat_map(|body| self.bodies[*body]).collect()
    }

    /// True if the design configuration is the pose at t = 0.
    pub fn is_drawn_exactly(&self) -> bool {
        self.drawn_off.iter().all(|it| *it == [0.0; 3])
    }

    /// Largest violation of any joint at time `t`, in sizes of the mechanism and rad.
    pub fn violation(&self, q: &[f64], t: f64) -> f64 {
        let poses = self.poses(q);
        let all = self.joint_order.iter().map(|joint| {
            let (joint, _) = self.joints[*joint];
            let (length, angle) = joint.violation(self, &poses, t);
            (length.abs() / self.size).max(angle.abs())
        });
        all.fold(
            0.0,
            |worst, it| if it > worst || it.is_nan() { it } else { worst },
        )
    }

    /// Largest relative difference of the rates and accelerations of driven angles from their laws at time `t`.
    pub fn rate_violation(&self, levels: &Levels<Precise>, t: f64) -> f64 {
        let angle = |level: usize, body: usize| {
            let place = self.body_order.iter().position(|it| *it == body);
            place.map_or(0.0, |place| levels[level][3 * place + 2].to_f64())
        };
        let mut worst = 0.0;
        for joint in &self.joint_order {
            let (first, last, law) = match self.joints[*joint].0 {
                Joint::DrivePhi(body, law) => (GROUND, body, law),
                Joint::DriveRelativeAngle(first, last, law) => (first, last, law),
                _ => continue,
            };
            let expected = law.motion(t);
            for level in [1, 2] {
                let driven = angle(level, last) - angle(level, first);
                let off = (driven - expected[level]).abs() / (1.0 + expected[level].abs());
                // NaN counts as worst.
                worst = if off <= worst { worst } else { off };
            }
        }
        worst
    }

    /// Description.
    pub fn text(&self) -> String {
        let mut text = String::from("mechanism found {\n");
        let written: Vec<Joint> = self
            .joint_order
            .iter()
            .map(|it| self.joints[*it].0)
            .collect();
        for mut joint in written.iter().copied() {
            if let Some(Law::Repeated(table)) = joint.law_mut() {
                let declared = match self.motions {
                    Some(motions) => motions.inside(table),
                    None => *table,
                };
                let _ = writeln!(text, "    {}", declared.declaration());
            }
        }
        let mut used = vec![false; self.points.len()];
        for joint in &self.joint_order {
            let (_, points) = self.joints[*joint].0.mentions();
            points.into_iter().for_each(|point| used[point] = true);
        }
        for (index, point) in self.points.iter().enumerate() {
            if point.body == GROUND && used[index] {
                let [x, y] = point.place;
                let _ = writeln!(text, "    point P{index} = ({x:?}, {y:?});");
            }
        }
        for &body in &self.body_order {
            let pose: Vec<String> = (0..3)
                .map(|axis| format!("{:?}", self.bodies[body][axis] + self.drawn_off[body][axis]))
                .collect();
            let mut members = Vec::new();
            for (index, point) in self.points.iter().enumerate() {
                if point.body == body && used[index] {
                    let [x, y] = self.local(index);
                    members.push(format!("P{index}: ({x:?}, {y:?})"));
                }
            }
            let pose = pose.join(", ");
            let _ = match members.as_slice() {
                [] => writeln!(text, "    body {} at ({pose});", name(body)),
                members => writeln!(
                    text,
                    "    body {} at ({pose}) {{ {} }}",
                    name(body),
                    members.join(", ")
                ),
            };
        }
        let is_driver = |joint: &Joint| joint.driver(self).is_some();
        let (inside, outside): (Vec<Joint>, Vec<Joint>) = written
            .into_iter()
            .partition(|joint| self.motions.is_some() && is_driver(joint));
        for joint in outside {
            let _ = writeln!(text, "    {};", joint.text(self));
        }
        if let Some(motions) = self.motions {
            text += &motions.text(self, &inside);
        }
        text + "}\n"
    }
}

/// A vector turned by an angle.
pub fn rotated([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [cosine * x - sine * y, sine * x + cosine * y]
}

/// a - b.
pub fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// The scalar product.
pub fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The length of a vector.
pub fn length(vector: [f64; 2]) -> f64 {
    vector[0].hypot(vector[1])
}
