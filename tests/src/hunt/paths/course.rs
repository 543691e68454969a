//! Courses: a description with its drivers, its range of time, and its periods.

use super::stepping::Given;
use crate::hunt::law::Law;

/// Mechanism of a family.
#[derive(Clone, Debug)]
pub struct Course {
    /// The family.
    pub family: &'static str,
    /// The description.
    pub text: String,
    /// The size (m).
    pub size: f64,
    /// Shortest period, or a comparable time (s).
    pub period: f64,
    /// Times of the beginning and of the latest end (s).
    pub span: [f64; 2],
    /// Pose at the beginning; empty for that of the design configuration.
    pub start: Vec<f64>,
    /// Base values and laws of the inputs from the beginning on; empty without inputs.
    pub inputs: Vec<(f64, Law)>,
    /// True if lengths differ by so little that their roundings decide the continuation of the path.
    pub is_blurred: bool,
    /// True if the design configuration is the pose at the beginning.
    pub is_drawn: bool,
    /// Number of loops whose links become collinear at once.
    pub loops: usize,
    /// True if inputs change at constant time.
    pub is_standing: bool,
}

impl Course {
    /// Course that begins in its design configuration and lasts three periods.
    pub fn drawn(text: String, size: f64, period: f64) -> Course {
        Course {
            family: "",
            text,
            size,
            period,
            span: [0.0, 3.0 * period],
            start: Vec::new(),
            inputs: Vec::new(),
            is_blurred: false,
            is_drawn: true,
            loops: 1,
            is_standing: false,
        }
    }

    /// Inputs at a time.
    pub fn given(&self, t: f64) -> Vec<Given> {
        let since = t - self.span[0];
        let inputs = self.inputs.iter();
        let inputs_now = inputs.map(|(base, law)| {
            let [value, rate, acceleration] = law.motion(since);
            [base + value, rate, acceleration]
        });
        inputs_now.collect()
    }
}

/// Value, rate and acceleration at a fraction of the chord between two inputs.
pub fn straight(first: Given, last: Given, part: f64) -> Given {
    [0, 1, 2].map(|level| first[level] + part * (last[level] - first[level]))
}

/// Polynomial of the fifth degree with value, rate and acceleration of both ends, by Hermite's formula.
pub fn quintic(first: Given, last: Given, h: f64, s: f64) -> Given {
    // p(s) = Σ c_k s^k with s the fraction of the interval.
    let [a, b, c] = [first[0], first[1] * h, 0.5 * first[2] * h * h];
    let [p, v, w] = [
        last[0] - a - b - c,
        last[1] * h - b - 2.0 * c,
        last[2] * h * h - 2.0 * c,
    ];
    let coefficients = [
        a,
        b,
        c,
        10.0 * p - 4.0 * v + 0.5 * w,
        -15.0 * p + 7.0 * v - w,
        6.0 * p - 3.0 * v + 0.5 * w,
    ];
    let derivative = |order: u32| {
        let terms = coefficients.iter().zip(0_u32..).skip(order as usize);
        let terms = terms.map(|(coefficient, power)| {
            let factor: u32 = (0..order).map(|it| power - it).product();
            coefficient * f64::from(factor) * s.powi((power - order) as i32)
        });
        terms.sum::<f64>()
    };
    [derivative(0), derivative(1) / h, derivative(2) / (h * h)]
}
