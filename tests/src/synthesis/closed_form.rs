//! Computes a four-bar by the intersection of two circles, and its error: the sum of squared distances from the points.

use super::Case;

/// Four-bar of the published cases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Design {
    /// Ground link, crank, coupler and rocker.
    pub links: [f64; 4],
    /// Coordinates of the coupler point in the frame of the coupler.
    pub point: [f64; 2],
    /// Position of the fixed pin of the crank, and the angle of the ground link (rad).
    pub ground: [f64; 3],
}

/// Angles of coupler and rocker against the ground link, and the position of the coupler point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Angle of the coupler (rad).
    pub coupler: f64,
    /// Angle of the rocker (rad).
    pub rocker: f64,
    /// Position of the coupler point.
    pub place: [f64; 2],
}

impl Design {
    /// Returns the pose at an angle of the crank against the ground link (rad), with the pin of the rocker on the left of the diagonal if
    /// `side` is 1, and on its right if it is −1. `None` if the loop cannot be closed.
    pub fn pose(&self, crank: f64, side: f64) -> Option<Pose> {
        let [ground, length, coupler, rocker] = self.links;
        let [x, y] = [length * crank.cos(), length * crank.sin()];
        let [across, up] = [ground - x, -y];
        let diagonal = across.hypot(up);
        let along = (coupler * coupler - rocker * rocker + diagonal * diagonal) / (2.0 * diagonal);
        let height = (coupler * coupler - along * along).sqrt();
        if height.is_nan() {
            return None;
        }
        let pin = [
            (along * across - side * height * up) / diagonal,
            (along * up + side * height * across) / diagonal,
        ];
        let angle = pin[1].atan2(pin[0]);
        let [cx, cy] = self.point;
        let (sin, cos) = angle.sin_cos();
        let local = [x + cx * cos - cy * sin, y + cx * sin + cy * cos];
        let [x0, y0, turned] = self.ground;
        let (sin, cos) = turned.sin_cos();
        Some(Pose {
            coupler: angle,
            rocker: (y + pin[1]).atan2(x + pin[0] - ground),
            place: [
                x0 + local[0] * cos - local[1] * sin,
                y0 + local[0] * sin + local[1] * cos,
            ],
        })
    }

    /// Returns the sum of squared distances at these angles of the crank, on the nearer side; infinite if the loop cannot be closed.
    pub fn error(&self, case: &Case, angles: &[f64]) -> f64 {
        let of_side = |side: f64| {
            let rows = angles.iter().zip(case.points);
            let squares = rows.map(|(crank, point)| match self.pose(*crank, side) {
                Some(pose) => {
                    (pose.place[0] - point[0]).powi(2) + (pose.place[1] - point[1]).powi(2)
                }
                None => f64::INFINITY,
            });
            squares.sum::<f64>()
        };
        of_side(1.0).min(of_side(-1.0))
    }

    /// True if the crank turns round: it is the shortest link or the ground link is, and with the longest one it is no longer than the others
    /// (Grashof).
    pub fn turns(&self) -> bool {
        let mut sorted = self.links;
        sorted.sort_by(f64::total_cmp);
        let is_grashof = sorted[0] + sorted[3] <= sorted[1] + sorted[2];
        is_grashof && (self.links[0] == sorted[0] || self.links[1] == sorted[0])
    }
}
