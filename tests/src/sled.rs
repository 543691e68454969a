//! A sled whose runner a strong drag keeps from sliding aside, with its motion in closed form.
//!
//! The drag is a force whose formula is in rates alone. Its direction turns with the sled, and no coordinate of the pose has that direction
//! (Chaplygin's sled). With the velocities u along and v across the runner and a constant rate ω, u̇ = ω v and v̇ = −ω u − D/m v.

use linkwright_solver::{SimulationOptions, Stop};

use crate::multipliers::larger;
use crate::simulated::{coordinate, simulation};
use crate::stiff::{Found, INSTANTS};

const MASS: f64 = 2.0;
const ALONG: f64 = 1.5;
const TURNING: f64 = 1.2;

/// A sled with a drag across its runner (N·s/m).
#[derive(Clone, Copy, Debug)]
pub struct Sled {
    /// More than 4.8 N·s/m, so that nothing oscillates.
    pub drag: f64,
}

impl Sled {
    /// The description.
    pub fn text(self) -> String {
        format!(
            "mechanism sled {{
                point O = (0, 0);
                body sled at O {{ O }}
                free ahead: x(sled) = 0 rate {ALONG};
                free aside: y(sled) = 0;
                free turn: phi(sled) = 0 rate {TURNING};
                mass sled = {MASS}kg inertia 0.1;
                force on sled.O = (0, -{}*(rate(y(sled))*cos(phi(sled)) - rate(x(sled))*sin(phi(sled)))) in sled;
                energy;
            }}",
            self.drag
        )
    }

    /// Its place and velocity at a time.
    fn at(self, t: f64) -> [[f64; 2]; 2] {
        let half = 0.5 * self.drag / MASS;
        let fast = -half - (half * half - TURNING * TURNING).sqrt();
        let slow = TURNING * TURNING / fast;
        // Each part decays: u along and v across, of which v = u̇/ω.
        let parts = [(slow, fast), (fast, slow)].map(|(own, other)| {
            let along = ALONG * other / (other - own);
            (own, along, along * own / TURNING)
        });
        let (mut place, mut velocity) = ([0.0; 2], [0.0; 2]);
        for (decay, along, across) in parts {
            let (sine, cosine) = (TURNING * t).sin_cos();
            let left = (decay * t).exp();
            let turned = [left * cosine, left * sine];
            // ∫ e^((decay + i ω) t) dt
            let square = decay * decay + TURNING * TURNING;
            let moved = [
                (decay * (turned[0] - 1.0) + TURNING * turned[1]) / square,
                (decay * turned[1] - TURNING * (turned[0] - 1.0)) / square,
            ];
            for (sum, [x, y]) in [(&mut velocity, turned), (&mut place, moved)] {
                sum[0] += along * x - across * y;
                sum[1] += along * y + across * x;
            }
        }
        [place, velocity]
    }

    /// The largest error of a simulation, and its effort.
    ///
    /// # Errors
    /// It ends early.
    pub fn compared(self, end: f64, options: SimulationOptions) -> Result<Found, Stop> {
        let mut simulation = simulation(&self.text(), end, options);
        let mut error = 0.0_f64;
        for step in 1..=INSTANTS {
            let t = end * f64::from(step) / f64::from(INSTANTS);
            simulation.advance(t)?;
            let expected = self.at(t);
            for (axis, name) in ["x_sled", "y_sled"].iter().enumerate() {
                let found = coordinate(&simulation, name);
                for level in [0, 1] {
                    error = larger(error, (found[level] - expected[level][axis]).abs());
                }
            }
        }
        Ok(Found {
            error,
            effort: simulation.effort(),
        })
    }
}
