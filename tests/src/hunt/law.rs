//! Shapes of a driver's motion, as values at a time and as text. Every shape is zero at t = 0.

use super::periodic::Periodic;

/// Change of a driven quantity from its value at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// rate · t.
    Ramp {
        /// Per second.
        rate: f64,
    },
    /// amplitude · sin(frequency · t).
    Harmonic {
        /// Amplitude.
        amplitude: f64,
        /// In rad/s.
        frequency: f64,
    },
    /// The cubic rise from 0 at `from` to `height` at `to`.
    Step {
        /// Beginning (s).
        from: f64,
        /// End (s).
        to: f64,
        /// Rise.
        height: f64,
    },
    /// height · (1 - exp(-t)).
    Decay {
        /// Limit.
        height: f64,
    },
    /// The deviation of a periodic table of t from its value at t = 0.
    Repeated(Periodic),
    /// Change of an input, which is zero at t = 0 as well.
    Given {
        /// Index of the input.
        input: usize,
    },
}

impl Law {
    /// Value at `t`.
    pub fn at(self, t: f64) -> f64 {
        match self {
            Law::Ramp { rate } => rate * t,
            Law::Harmonic {
                amplitude,
                frequency,
            } => amplitude * (frequency * t).sin(),
            Law::Step { from, to, height } => {
                let s = ((t - from) / (to - from)).clamp(0.0, 1.0);
                height * s * s * (3.0 - 2.0 * s)
            }
            Law::Decay { height } => -height * (-t).exp_m1(),
            Law::Repeated(table) => table.at(t)[0] - table.at(0.0)[0],
            Law::Given { .. } => 0.0,
        }
    }

    /// Value, rate and acceleration at `t`.
    pub fn motion(self, t: f64) -> [f64; 3] {
        let [rate, acceleration] = match self {
            Law::Ramp { rate } => [rate, 0.0],
            Law::Harmonic {
                amplitude,
                frequency,
            } => {
                let (sine, cosine) = (frequency * t).sin_cos();
                [
                    amplitude * frequency * cosine,
                    -amplitude * frequency * frequency * sine,
                ]
            }
            Law::Step { from, to, height } => {
                let h = to - from;
                let s = (t - from) / h;
                match 0.0 < s && s < 1.0 {
                    true => [
                        height * 6.0 * s * (1.0 - s) / h,
                        height * (6.0 - 12.0 * s) / (h * h),
                    ],
                    false => [0.0; 2],
                }
            }
            Law::Decay { height } => [height * (-t).exp(), -height * (-t).exp()],
            Law::Repeated(table) => {
                let [_, rate, acceleration] = table.at(t);
                [rate, acceleration]
            }
            Law::Given { .. } => [0.0; 2],
        };
        [self.at(t), rate, acceleration]
    }

    /// Shortest period, or a comparable time (s), of a driver of a quantity of this size (m, or 1 for an angle).
    pub fn period(self, size: f64) -> f64 {
        match self {
            Law::Ramp { rate } => std::f64::consts::TAU * size / rate.abs(),
            Law::Harmonic { frequency, .. } => std::f64::consts::TAU / frequency,
            Law::Step { from, to, .. } => 2.0 * (to - from),
            Law::Decay { .. } => std::f64::consts::TAU,
            Law::Repeated(table) => table.period,
            Law::Given { .. } => f64::INFINITY,
        }
    }

    /// Text of `base` plus the law.
    pub fn text(self, base: f64) -> String {
        match self {
            Law::Ramp { rate } => format!("{base:?} + {rate:?}*t"),
            Law::Harmonic {
                amplitude,
                frequency,
            } => format!("{base:?} + {amplitude:?}*sin({frequency:?}*t)"),
            Law::Step { from, to, height } => {
                format!("step(t, {from:?}s, {base:?}, {to:?}s, {:?})", base + height)
            }
            Law::Decay { height } => format!("{:?} - {height:?}*exp(-t)", base + height),
            Law::Repeated(table) => {
                format!("{:?} + {}(t)", base - table.at(0.0)[0], table.name())
            }
            Law::Given { input } => format!("{base:?} + k{input}"),
        }
    }

    /// Law with heights and rates times a factor.
    pub fn scaled(self, factor: f64) -> Law {
        match self {
            Law::Ramp { rate } => Law::Ramp {
                rate: factor * rate,
            },
            Law::Harmonic {
                amplitude,
                frequency,
            } => Law::Harmonic {
                amplitude: factor * amplitude,
                frequency,
            },
            Law::Step { from, to, height } => Law::Step {
                from,
                to,
                height: factor * height,
            },
            Law::Decay { height } => Law::Decay {
                height: factor * height,
            },
            Law::Repeated(table) => Law::Repeated(table.scaled(factor)),
            given @ Law::Given { .. } => given,
        }
    }
}
