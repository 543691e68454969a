//! Errors of the elementary functions in ulps: against 384 bits for f64, against the standard library's f64 for f32.
//!
//! One ulp is the distance of the two floats between which the exact result lies. The standard library's f64 is
//! within 2⁻²⁸ ulp of an f32, which is as good as exact. The references share no code with the functions under test.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwright_math::{double, single};

use crate::random::Random;
use crate::stability::precise::{self, Precise};

/// Largest error, and its arguments.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    /// Error in ulps; infinite for NaN.
    pub error: f64,
    /// Arguments of this error.
    pub arguments: [f64; 2],
    /// Number of compared values.
    pub count: u64,
}

impl Worst {
    /// Takes one error into account.
    pub fn take(&mut self, error: f64, arguments: [f64; 2]) {
        self.count += 1;
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > self.error {
            (self.error, self.arguments) = (error, arguments);
        }
    }

    /// Takes the errors of others into account.
    pub fn merge(&mut self, other: Worst) {
        let count = self.count + other.count;
        if other.error > self.error {
            *self = other;
        }
        self.count = count;
    }
}

/// Distance of neighboring floats with this number of bits near a value; `smallest` is the exponent of subnormal
/// ones.
fn ulp(value: f64, bits: i32, smallest: i32) -> f64 {
    // The exponent of a normal number; subnormal ones have the smallest ulp anyway.
    let exponent = ((value.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    power_of_two((exponent + 1 - bits).max(smallest))
}

fn power_of_two(exponent: i32) -> f64 {
    match exponent {
        -1022.. => f64::from_bits(((exponent + 1023) as u64) << 52),
        _ => f64::from_bits(1 << (exponent + 1074)),
    }
}

/// Error of an f64.
pub fn double_error(found: f64, exact: &Precise) -> f64 {
    let rounded = exact.to_f64();
    let ulp = Precise::from_f64(ulp(rounded, 53, -1074));
    let gap = Precise::from_f64(found).minus(exact);
    gap.over(&ulp).to_f64().abs()
}

/// Error of an f32 against an f64.
pub fn single_error(found: f32, exact: f64) -> f64 {
    (f64::from(found) - exact).abs() / ulp(exact, 24, -149)
}

/// Source of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angles {
    /// Below π/4.
    Small,
    /// Up to 8192 rad, evenly.
    Usual,
    /// Up to 200 000 rad, evenly in their logarithm.
    Wound,
    /// Beside a multiple of π/2 below 200 000 rad.
    Multiples,
    /// Any exponent.
    All,
}

impl Angles {
    /// All sources, with a description.
    pub const LIST: [(Angles, &'static str); 5] = [
        (Angles::Small, "up to π/4"),
        (Angles::Usual, "up to 8192"),
        (Angles::Wound, "1e-3 to 2e5, evenly in the logarithm"),
        (
            Angles::Multiples,
            "4 floats about multiples of π/2, up to 2e5",
        ),
        (Angles::All, "all exponents"),
    ];

    /// Next angle of the source.
    pub fn next(self, random: &mut Random) -> f64 {
        let sign = if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
        sign * match self {
            Angles::Small => random.between(0.0, PI / 4.0),
            Angles::Usual => random.between(0.0, 8192.0),
            Angles::Wound => random.between(1e-3_f64.ln(), 2e5_f64.ln()).exp(),
            Angles::Multiples => {
                let multiple = random.between(1.0, 127_000.0).floor() * FRAC_PI_2;
                let steps = random.bits() % 9;
                f64::from_bits(multiple.to_bits() + steps - 4)
            }
            Angles::All => loop {
                let angle = f64::from_bits(random.bits() & (u64::MAX >> 1));
                if angle.is_finite() {
                    break angle;
                }
            },
        }
    }
}

/// Adds the errors of sine and cosine at an f64.
pub fn sine_and_cosine(angle: f64, worst: &mut [Worst; 2]) {
    let (sine, cosine) = double::sin_cos(angle);
    let exact = Precise::from_f64(angle);
    worst[0].take(double_error(sine, &exact.sin()), [angle, 0.0]);
    worst[1].take(double_error(cosine, &exact.cos()), [angle, 0.0]);
}

/// Adds the errors of sine and cosine at an f32.
pub fn single_sine_and_cosine(angle: f32, worst: &mut [Worst; 2]) {
    let (sine, cosine) = single::sin_cos(angle);
    let exact = f64::from(angle);
    worst[0].take(single_error(sine, exact.sin()), [exact, 0.0]);
    worst[1].take(single_error(cosine, exact.cos()), [exact, 0.0]);
}

/// Vector: mostly of ordinary size, otherwise of any exponents, or with components of very different size.
pub fn vector(random: &mut Random) -> [f64; 2] {
    let any = |random: &mut Random| loop {
        let value = f64::from_bits(random.bits());
        if value.is_finite() && value != 0.0 {
            break value;
        }
    };
    match random.bits() % 4 {
        0 => [any(random), any(random)],
        1 => {
            let (y, size) = (any(random), random.between(-40.0, 40.0));
            [y, (y * size.exp()).clamp(-f64::MAX, f64::MAX)]
        }
        _ => {
            let (angle, size) = (random.between(-PI, PI), random.between(-3.0, 3.0).exp());
            [size * angle.sin(), size * angle.cos()]
        }
    }
}

/// Adds the error of the angle of a vector.
pub fn angle([y, x]: [f64; 2], worst: &mut Worst) {
    if x == 0.0 {
        return;
    }
    let (across, along) = (Precise::from_f64(y), Precise::from_f64(x));
    let mut exact = across.over(&along).atan();
    if x < 0.0 {
        let half = precise::pi();
        exact = if y < 0.0 {
            exact.minus(&half)
        } else {
            exact.plus(&half)
        };
    }
    worst.take(double_error(double::atan2(y, x), &exact), [y, x]);
}

/// Adds the error of the angle of a vector in f32.
pub fn single_angle([y, x]: [f32; 2], worst: &mut Worst) {
    let exact = f64::from(y).atan2(f64::from(x));
    let error = single_error(single::atan2(y, x), exact);
    worst.take(error, [y.into(), x.into()]);
}

/// Adds the errors of an angle that is followed, in ε of its magnitude or of π/4: in f64 and in f32.
pub fn followed(random: &mut Random, worst: &mut [Worst; 2]) {
    let angle = random.between(-1000.0, 1000.0);
    let (sine, cosine) = (angle.sin(), angle.cos());
    let near = angle + random.between(-3.1, 3.1);
    let wound = |sine: f64, cosine: f64, near: f64| {
        let angle = sine.atan2(cosine);
        let turns = ((near - angle) / (2.0 * PI)).round();
        let exact = Precise::from_f64(sine)
            .over(&Precise::from_f64(cosine))
            .atan();
        // The quotient has the right tangent; the float selects one of its angles.
        let half_turns = ((angle + turns * 2.0 * PI - exact.to_f64()) / PI).round();
        exact.plus(&precise::pi().times(&Precise::from_f64(half_turns)))
    };
    let in_epsilons = |found: f64, exact: &Precise, epsilon: f64| {
        let gap = Precise::from_f64(found).minus(exact).to_f64().abs();
        gap / (exact.to_f64().abs().max(PI / 4.0) * epsilon)
    };
    let exact = wound(sine, cosine, near);
    let followed_angle = double::angle_near(sine, cosine, near);
    worst[0].take(
        in_epsilons(followed_angle, &exact, f64::EPSILON),
        [angle, near],
    );
    let [s, c, n] = [sine, cosine, near].map(|value| value as f32);
    let exact = wound(s.into(), c.into(), n.into());
    let followed_angle = single::angle_near(s, c, n).into();
    worst[1].take(
        in_epsilons(followed_angle, &exact, f32::EPSILON.into()),
        [angle, near],
    );
}
