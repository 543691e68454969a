//! Signal of a sine of t, with its derivatives.

use linkwright::Signal;

/// c + a sin(ω t).
pub fn swing(center: f64, amplitude: f64, frequency: f64, t: f64) -> Signal {
    let (sine, cosine) = (frequency * t).sin_cos();
    Signal {
        value: center + amplitude * sine,
        rate: amplitude * frequency * cosine,
        acceleration: -amplitude * frequency * frequency * sine,
    }
}
