//! Driven angles and lengths of a mechanism as functions of time, in written order, with two derivatives.
//!
//! They are typed here as closures: the baseline must not be slower than a programmer's code.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_4, FRAC_PI_6, PI};

/// A function of time with its derivatives.
pub struct Drive {
    /// f(t).
    pub value: Box<dyn Fn(f64) -> f64>,
    /// ḟ(t).
    pub rate: Box<dyn Fn(f64) -> f64>,
    /// f̈(t).
    pub acceleration: Box<dyn Fn(f64) -> f64>,
}

/// offset + amplitude sin(frequency t + phase).
fn swing(offset: f64, amplitude: f64, frequency: f64, phase: f64) -> Drive {
    Drive {
        value: Box::new(move |t| offset + amplitude * (frequency * t + phase).sin()),
        rate: Box::new(move |t| amplitude * frequency * (frequency * t + phase).cos()),
        acceleration: Box::new(move |t| {
            -amplitude * frequency * frequency * (frequency * t + phase).sin()
        }),
    }
}

/// offset + speed t.
fn turn(offset: f64, speed: f64) -> Drive {
    Drive {
        value: Box::new(move |t| offset + speed * t),
        rate: Box::new(move |_| speed),
        acceleration: Box::new(|_| 0.0),
    }
}

/// The drives of a mechanism.
///
/// # Panics
/// If the mechanism is not in this table.
pub fn drives(mechanism: &str) -> Vec<Drive> {
    match mechanism {
        "two_body" => vec![swing(FRAC_PI_6, 1.0, 2.0, 0.0)],
        "four_bar" => vec![turn(40.0_f64.to_radians(), 3.0)],
        "slider_crank" => vec![turn(FRAC_PI_3, 3.0)],
        "inverted_slider_crank" => vec![turn(0.0, 3.0)],
        "stephenson" => vec![swing(0.0, 0.3, 2.0, 0.0)],
        "platform_3rpr" => vec![
            swing(0.75_f64.hypot(0.2), 0.08, 1.0, 0.0),
            swing(0.52_f64.hypot(0.6), 0.06, 1.5, 0.0),
            swing(0.23_f64.hypot(0.7), -0.07, 2.0, 0.0),
        ],
        "excavator" | "excavator_pins" => vec![
            swing(0.2_f64.hypot(0.8), 0.05, 1.5, 0.0),
            swing(0.4_f64.hypot(1.0), 0.05, 1.5, 0.0),
        ],
        "arm" => vec![
            swing(0.2_f64.hypot(0.6) - 0.05, 0.08, PI, FRAC_PI_4),
            swing(0.2_f64.hypot(0.8) - 0.04, 0.1, FRAC_PI_4, -FRAC_PI_3),
        ],
        "scissor" => vec![swing(0.8, 0.1, 2.0, 0.0)],
        other => panic!("the baseline has no drives of `{other}`"),
    }
}
