//! A description with what is asked of it: how it is driven, from when to when, and what takes how long.

use super::stepping::Given;
use crate::hunt::law::Law;

/// A mechanism of a family.
#[derive(Clone, Debug)]
pub struct Course {
    /// The family.
    pub family: &'static str,
    /// The description.
    pub text: String,
    /// The size (m).
    pub size: f64,
    /// The shortest time in which anything repeats itself, or would (s).
    pub period: f64,
    /// When it begins, and when it ends at the latest (s).
    pub span: [f64; 2],
    /// The pose at the beginning, or nothing for what the drawing leads to.
    pub start: Vec<f64>,
    /// What the inputs do, from their values at the beginning on; nothing where there are none.
    pub inputs: Vec<(f64, Law)>,
    /// Whether lengths differ by so little that their roundings decide how the path goes on.
    pub is_blurred: bool,
    /// Whether the drawing is the pose at the beginning.
    pub is_drawn: bool,
    /// Number of loops whose links come in line at once.
    pub loops: usize,
    /// True if inputs change while time stands still.
    pub is_standing: bool,
}

impl Course {
    /// One that begins in its drawing, and goes on for three periods.
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

    /// The inputs at a time.
    pub fn given(&self, t: f64) -> Vec<Given> {
        let since = t - self.span[0];
        let inputs = self.inputs.iter();
        let given = inputs.map(|(base, law)| {
            let [value, rate, acceleration] = law.motion(since);
            [base + value, rate, acceleration]
        });
        given.collect()
    }
}

/// Value, rate and acceleration at a part of the straight way between two of them.
pub fn straight(first: Given, last: Given, part: f64) -> Given {
    [0, 1, 2].map(|level| first[level] + part * (last[level] - first[level]))
}

/// The polynomial of the fifth degree with value, rate and acceleration of both ends, by Hermite's formula.
pub fn quintic(first: Given, last: Given, h: f64, s: f64) -> Given {
    // p(s) = Σ c_k s^k with s the part of the way.
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
