//! Ankle of `ankle.mech` without the generator: positions by matrices, its motors by a closed form written by hand,
//! its foot by the hundred iterations of Newton-Raphson that are usual in robots.

use crate::jet::Jet;

/// Length of both cranks, in m.
const CRANK: f64 = 0.035;

/// Distance of the rods' ends on the foot behind the joint, in m.
const BEHIND: f64 = 0.045;

/// Number of iterations, without a test of convergence.
const ITERATIONS: usize = 100;

/// Step of the differences, in rad.
const STEP: f64 = 1e-6;

/// Motor with its rod.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Height of the crank's axis, in m.
    height: f64,
    /// Distance of the rod to the left, in m.
    aside: f64,
}

/// Left side with the upper motor, and right side.
pub const SIDES: [Side; 2] = [
    Side {
        height: 0.22,
        aside: 0.028,
    },
    Side {
        height: 0.13,
        aside: -0.028,
    },
];

impl Side {
    /// Length of the rod.
    pub fn rod(self) -> f64 {
        self.rod_square().sqrt()
    }

    /// Square of the rod's length.
    fn rod_square(self) -> f64 {
        self.height * self.height + (BEHIND - CRANK) * (BEHIND - CRANK)
    }

    /// End of the rod on the foot: R_y(pitch) R_x(roll) f.
    fn foot(self, pitch: Jet, roll: Jet) -> [Jet; 3] {
        let held = [-BEHIND, self.aside, 0.0].map(Jet::from);
        let [x, y, z] = turned(held, roll, [1, 2]);
        // About y the z axis turns to the x axis.
        turned([x, y, z], pitch, [2, 0])
    }

    /// |Q − P|² − ℓ² between the end of the crank and the foot.
    pub fn gap(self, pitch: Jet, roll: Jet, motor: Jet) -> Jet {
        let pivot = [0.0, self.aside, self.height].map(Jet::from);
        // The crank points backwards, and moves upwards as it turns forward: about −y.
        let crank = turned([-CRANK, 0.0, 0.0].map(Jet::from), motor, [2, 0]);
        let foot = self.foot(pitch, roll);
        let squares = [0, 1, 2].map(|axis| (foot[axis] - pivot[axis] - crank[axis]).square());
        squares[0] + squares[1] + squares[2] - self.rod_square()
    }

    /// Angle of the motor and its rate, from pitch and roll with theirs.
    pub fn motor(self, [pitch, roll]: [[f64; 2]; 2]) -> [f64; 2] {
        let Side { height, aside } = self;
        let (sp, cp) = pitch[0].sin_cos();
        let (sr, cr) = roll[0].sin_cos();
        let x = -BEHIND * cp + aside * sp * sr;
        let y = aside * cr - aside;
        let z = BEHIND * sp + aside * cp * sr - height;
        // (x + r cos θ)² + y² + (z − r sin θ)² = ℓ²
        let (a, b) = (x, -z);
        let c = (self.rod_square() - x * x - y * y - z * z - CRANK * CRANK) / (2.0 * CRANK);
        let motor = b.atan2(a) - (c / a.hypot(b)).acos();
        let (s, co) = motor.sin_cos();
        let xd = (BEHIND * sp + aside * cp * sr) * pitch[1] + aside * sp * cr * roll[1];
        let yd = -aside * sr * roll[1];
        let zd = (BEHIND * cp - aside * sp * sr) * pitch[1] + aside * cp * cr * roll[1];
        let (dx, dz) = (x + CRANK * co, z - CRANK * s);
        let slope = CRANK * (dx * s + dz * co);
        [motor, (dx * xd + y * yd + dz * zd) / slope]
    }
}

/// Vector turned in the plane of two axes, the first towards the second.
fn turned(mut v: [Jet; 3], angle: Jet, [first, second]: [usize; 2]) -> [Jet; 3] {
    let (sine, cosine) = (angle.sin(), angle.cos());
    let (a, b) = (v[first], v[second]);
    v[first] = cosine * a - sine * b;
    v[second] = sine * a + cosine * b;
    v
}

/// Pitch and roll of both motors by Newton-Raphson with differences, from an estimate.
pub fn foot_of(motors: [f64; 2], estimate: [f64; 2]) -> [f64; 2] {
    let residual = |[pitch, roll]: [f64; 2]| {
        let side = |at: usize| {
            let [pitch, roll, motor] = [pitch, roll, motors[at]].map(Jet::from);
            SIDES[at].gap(pitch, roll, motor).0[0]
        };
        [side(0), side(1)]
    };
    let mut at = estimate;
    for _ in 0..ITERATIONS {
        let here = residual(at);
        let columns = [0, 1].map(|unknown| {
            let mut beside = at;
            beside[unknown] += STEP;
            let there = residual(beside);
            [0, 1].map(|row| (there[row] - here[row]) / STEP)
        });
        let [[a, c], [b, d]] = columns;
        let determinant = a * d - b * c;
        at[0] -= (d * here[0] - b * here[1]) / determinant;
        at[1] -= (a * here[1] - c * here[0]) / determinant;
    }
    at
}
