//! Rows of Φ, Φ_q, -Φ_t and γ of each kind of joint, written by hand.
//!
//! A body's coordinates are x, y, φ; a mark is at r + A s. With B = dA/dφ, the mark's velocity is ṙ + B s φ̇ and its
//! acceleration r̈ + B s φ̈ − A s φ̇². Its last term enters γ (Haug 1989, sections 3.2, 3.3 and 3.5).

use nalgebra::{DMatrix, DVector, Vector2};

use super::drive::Drive;

/// A joint or driver that fills its rows, the first of which is `row`.
pub trait Joint {
    /// Number of rows.
    fn rows(&self) -> usize;
    /// Writes its entries of Φ.
    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>, row: usize);
    /// Writes its entries of Φ_q into a matrix of zeros.
    fn jacobian(&self, q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize);
    /// Writes its entries of -Φ_t into a vector of zeros.
    fn velocity(&self, _t: f64, _right_hand_side: &mut DVector<f64>, _row: usize) {}
    /// Writes its entries of γ into a vector of zeros.
    fn acceleration(
        &self,
        _q: &DVector<f64>,
        _qd: &DVector<f64>,
        _t: f64,
        _gamma: &mut DVector<f64>,
        _row: usize,
    ) {
    }
}

/// A point of a moving body, counted from 0, or of the ground.
pub struct Mark {
    /// The body.
    pub body: Option<usize>,
    /// Position of the point in the body's frame.
    pub local: Vector2<f64>,
}

fn perpendicular(a: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-a.y, a.x)
}

fn rotated(body: Option<usize>, local: Vector2<f64>, q: &DVector<f64>) -> Vector2<f64> {
    match body {
        Some(body) => {
            let (sin, cos) = q[3 * body + 2].sin_cos();
            Vector2::new(cos * local.x - sin * local.y, sin * local.x + cos * local.y)
        }
        None => local,
    }
}

fn origin(body: Option<usize>, q: &DVector<f64>) -> Vector2<f64> {
    body.map_or_else(Vector2::zeros, |body| {
        Vector2::new(q[3 * body], q[3 * body + 1])
    })
}

fn rate(body: Option<usize>, qd: &DVector<f64>) -> f64 {
    body.map_or(0.0, |body| qd[3 * body + 2])
}

impl Mark {
    /// A s.
    fn arm(&self, q: &DVector<f64>) -> Vector2<f64> {
        rotated(self.body, self.local, q)
    }

    /// r + A s.
    fn position(&self, q: &DVector<f64>) -> Vector2<f64> {
        origin(self.body, q) + self.arm(q)
    }
}

/// r_i + A_i s_i − r_j − A_j s_j = 0.
pub struct Revolute {
    /// The point of body i.
    pub i: Mark,
    /// The point of body j.
    pub j: Mark,
}

impl Joint for Revolute {
    fn rows(&self) -> usize {
        2
    }

    fn residual(&self, q: &DVector<f64>, _t: f64, phi: &mut DVector<f64>, row: usize) {
        let gap = self.i.position(q) - self.j.position(q);
        phi[row] = gap.x;
        phi[row + 1] = gap.y;
    }

    fn jacobian(&self, q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize) {
        for (mark, sign) in [(&self.i, 1.0), (&self.j, -1.0)] {
            if let Some(body) = mark.body {
                let turn = perpendicular(mark.arm(q));
                phi_q[(row, 3 * body)] = sign;
                phi_q[(row + 1, 3 * body + 1)] = sign;
                phi_q[(row, 3 * body + 2)] = sign * turn.x;
                phi_q[(row + 1, 3 * body + 2)] = sign * turn.y;
            }
        }
    }

    fn acceleration(
        &self,
        q: &DVector<f64>,
        qd: &DVector<f64>,
        _t: f64,
        gamma: &mut DVector<f64>,
        row: usize,
    ) {
        let inward = |mark: &Mark| mark.arm(q) * rate(mark.body, qd).powi(2);
        let difference = inward(&self.i) - inward(&self.j);
        gamma[row] = difference.x;
        gamma[row + 1] = difference.y;
    }
}

/// a · (r_j + A_j s_j − r_i − A_i s_i), with a = A_i d: a component, in body i, of the vector between two marks.
pub struct Offset {
    /// The point of body i.
    pub i: Mark,
    /// The point of body j.
    pub j: Mark,
    /// The unit vector d in the frame of body i.
    pub direction: Vector2<f64>,
}

impl Offset {
    fn direction(&self, q: &DVector<f64>) -> Vector2<f64> {
        rotated(self.i.body, self.direction, q)
    }

    fn value(&self, q: &DVector<f64>) -> f64 {
        self.direction(q)
            .dot(&(self.j.position(q) - self.i.position(q)))
    }

    fn jacobian(&self, q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize) {
        let direction = self.direction(q);
        if let Some(i) = self.i.body {
            // d/dφ_i of a · (e − A_i s_i) with e = r_j + A_j s_j − r_i; a · A_i s_i is constant.
            let reach = self.j.position(q) - origin(self.i.body, q);
            phi_q[(row, 3 * i)] = -direction.x;
            phi_q[(row, 3 * i + 1)] = -direction.y;
            phi_q[(row, 3 * i + 2)] = perpendicular(direction).dot(&reach);
        }
        if let Some(j) = self.j.body {
            phi_q[(row, 3 * j)] = direction.x;
            phi_q[(row, 3 * j + 1)] = direction.y;
            phi_q[(row, 3 * j + 2)] = direction.dot(&perpendicular(self.j.arm(q)));
        }
    }

    /// Minus the second time derivative without the terms in q̈:
    /// φ̇_i² a · e − 2 φ̇_i (B_i d) · ė + φ̇_j² a · A_j s_j.
    fn acceleration(&self, q: &DVector<f64>, qd: &DVector<f64>) -> f64 {
        let direction = self.direction(q);
        let (rate_i, rate_j) = (rate(self.i.body, qd), rate(self.j.body, qd));
        let arm = self.j.arm(q);
        let reach = self.j.position(q) - origin(self.i.body, q);
        let drift = origin(self.j.body, qd) + perpendicular(arm) * rate_j - origin(self.i.body, qd);
        rate_i * rate_i * direction.dot(&reach)
            - 2.0 * rate_i * perpendicular(direction).dot(&drift)
            + rate_j * rate_j * direction.dot(&arm)
    }
}

/// φ_i − φ_j − φ⁰ = 0, and the offset across the line vanishes.
pub struct Translational {
    /// The offset across the line.
    pub across: Offset,
    /// φ⁰ (rad).
    pub relative_angle: f64,
}

impl Joint for Translational {
    fn rows(&self) -> usize {
        2
    }

    fn residual(&self, q: &DVector<f64>, _t: f64, phi: &mut DVector<f64>, row: usize) {
        let angle = |body: Option<usize>| body.map_or(0.0, |body| q[3 * body + 2]);
        phi[row] = angle(self.across.i.body) - angle(self.across.j.body) - self.relative_angle;
        phi[row + 1] = self.across.value(q);
    }

    fn jacobian(&self, q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize) {
        for (body, sign) in [(self.across.i.body, 1.0), (self.across.j.body, -1.0)] {
            if let Some(body) = body {
                phi_q[(row, 3 * body + 2)] = sign;
            }
        }
        self.across.jacobian(q, phi_q, row + 1);
    }

    fn acceleration(
        &self,
        q: &DVector<f64>,
        qd: &DVector<f64>,
        _t: f64,
        gamma: &mut DVector<f64>,
        row: usize,
    ) {
        gamma[row + 1] = self.across.acceleration(q, qd);
    }
}

/// The component `axis` of a mark has a constant value.
pub struct AbsoluteCoordinate {
    /// The point.
    pub mark: Mark,
    /// 0 for x, 1 for y.
    pub axis: usize,
    /// The value (m).
    pub value: f64,
}

impl Joint for AbsoluteCoordinate {
    fn rows(&self) -> usize {
        1
    }

    fn residual(&self, q: &DVector<f64>, _t: f64, phi: &mut DVector<f64>, row: usize) {
        phi[row] = self.mark.position(q)[self.axis] - self.value;
    }

    fn jacobian(&self, q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize) {
        if let Some(body) = self.mark.body {
            phi_q[(row, 3 * body + self.axis)] = 1.0;
            phi_q[(row, 3 * body + 2)] = perpendicular(self.mark.arm(q))[self.axis];
        }
    }

    fn acceleration(
        &self,
        q: &DVector<f64>,
        qd: &DVector<f64>,
        _t: f64,
        gamma: &mut DVector<f64>,
        row: usize,
    ) {
        gamma[row] = self.mark.arm(q)[self.axis] * rate(self.mark.body, qd).powi(2);
    }
}

/// A body's angle has a constant value.
pub struct Angle {
    /// The body.
    pub body: usize,
    /// The value (rad).
    pub value: f64,
}

impl Joint for Angle {
    fn rows(&self) -> usize {
        1
    }

    fn residual(&self, q: &DVector<f64>, _t: f64, phi: &mut DVector<f64>, row: usize) {
        phi[row] = q[3 * self.body + 2] - self.value;
    }

    fn jacobian(&self, _q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize) {
        phi_q[(row, 3 * self.body + 2)] = 1.0;
    }
}

/// A body's angle is a function of time.
pub struct AngleDriver {
    /// The body.
    pub body: usize,
    /// The function.
    pub drive: Drive,
}

impl Joint for AngleDriver {
    fn rows(&self) -> usize {
        1
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>, row: usize) {
        phi[row] = q[3 * self.body + 2] - (self.drive.value)(t);
    }

    fn jacobian(&self, _q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize) {
        phi_q[(row, 3 * self.body + 2)] = 1.0;
    }

    fn velocity(&self, t: f64, right_hand_side: &mut DVector<f64>, row: usize) {
        right_hand_side[row] = (self.drive.rate)(t);
    }

    fn acceleration(
        &self,
        _q: &DVector<f64>,
        _qd: &DVector<f64>,
        t: f64,
        gamma: &mut DVector<f64>,
        row: usize,
    ) {
        gamma[row] = (self.drive.acceleration)(t);
    }
}

/// The offset along a line is a function of time.
pub struct LengthDriver {
    /// The offset along the line.
    pub along: Offset,
    /// The function.
    pub drive: Drive,
}

impl Joint for LengthDriver {
    fn rows(&self) -> usize {
        1
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>, row: usize) {
        phi[row] = self.along.value(q) - (self.drive.value)(t);
    }

    fn jacobian(&self, q: &DVector<f64>, phi_q: &mut DMatrix<f64>, row: usize) {
        self.along.jacobian(q, phi_q, row);
    }

    fn velocity(&self, t: f64, right_hand_side: &mut DVector<f64>, row: usize) {
        right_hand_side[row] = (self.drive.rate)(t);
    }

    fn acceleration(
        &self,
        q: &DVector<f64>,
        qd: &DVector<f64>,
        t: f64,
        gamma: &mut DVector<f64>,
        row: usize,
    ) {
        gamma[row] = self.along.acceleration(q, qd) + (self.drive.acceleration)(t);
    }
}
