//! Signals that were missing for a while, and time that is a sum of durations: a mechanism goes on in the cycle in which they are back.

use linkwright::{FailureKind, Settings, Signal};

mod crane {
    linkwright::include_mechanism!(crane);
}

mod platform_given {
    linkwright::include_mechanism!(platform_given);
}

mod single {
    linkwright::include_mechanism!(winch_single);
}

use crane::Crane;

/// The attempts that a controller allows a cycle.
fn two_attempts() -> Settings {
    Settings {
        substeps: 2,
        ..Settings::default()
    }
}

/// The length of the cylinder while the crane works, as it is measured a thousand times a second.
fn measured(t: f64) -> crane::Inputs {
    let (sine, cosine) = (4.0 * t).sin_cos();
    crane::Inputs {
        lift: Signal::new(0.5 + 0.2 * sine, 0.8 * cosine, -3.2 * sine),
    }
}

/// The angle of the jib by the law of cosines.
fn jib(t: f64) -> f64 {
    let lift = measured(t).lift.value;
    let [far, near] = [0.3_f64.hypot(0.4), 0.25_f64.hypot(0.1)];
    let apex = ((far * far + near * near - lift * lift) / (2.0 * far * near)).acos();
    (-0.4_f64).atan2(0.3) + apex - 0.1_f64.atan2(0.25)
}

fn at_work() -> Crane {
    let drawn = &crane::Coordinates::DESIGN;
    let mut crane = Crane::assemble_from(drawn, 0.0, &measured(0.0), two_attempts());
    for tick in 1..=300 {
        let t = 1e-3 * f64::from(tick);
        let crane = crane.as_mut().expect("the drawing assembles");
        crane.advance(t, &measured(t)).expect("a short step");
    }
    crane.expect("the drawing assembles")
}

#[test]
fn a_dropout_in_the_middle_of_a_motion_ends_with_the_first_sample() {
    // Without samples, with samples that are NaN, and with the last one repeated.
    for dropout in 0..3 {
        let mut crane = at_work();
        for tick in 301..1100 {
            let t = 1e-3 * f64::from(tick);
            match dropout {
                0 => {}
                1 => {
                    let inputs = crane::Inputs {
                        lift: Signal::constant(f64::NAN),
                    };
                    let failure = crane.advance(t, &inputs).expect_err("no number");
                    assert_eq!(failure.kind, FailureKind::NotFinite);
                }
                _ => {
                    crane.advance(0.3, &measured(0.3)).expect("it stands");
                }
            }
        }
        let last = crane.frame().q.phi_jib;
        assert!((last - jib(0.3)).abs() < 1e-9);
        let t = 1.1;
        let jump = crane.recover(t, &measured(t)).expect("one cycle");
        let jump = jump.expect("all coordinates");
        assert!((crane.frame().q.phi_jib - jib(t)).abs() < 1e-9);
        assert_eq!(crane.frame().t, t);
        assert!((jump.phi_jib - (jib(t) - jib(0.3))).abs() < 1e-9);
        assert!(jump.phi_jib.abs() > 0.5 && jump.x_jib == 0.0);
        for tick in 1101..1500 {
            let t = 1e-3 * f64::from(tick);
            let frame = crane.advance(t, &measured(t)).expect("a short step");
            assert!((frame.q.phi_jib - jib(t)).abs() < 1e-9);
        }
    }
}

#[test]
fn a_recovery_that_fails_leaves_the_last_frame() {
    let mut crane = at_work();
    let before = crane;
    for lift in [2.0, 0.01, f64::NAN] {
        let inputs = crane::Inputs {
            lift: Signal::constant(lift),
        };
        assert!(crane.recover(1.0, &inputs).is_err());
        assert_eq!(crane, before);
    }
    crane
        .advance(0.301, &measured(0.301))
        .expect("it goes on from there");
}

#[test]
fn a_platform_recovers_in_its_assembly() {
    use platform_given::{Inputs, PlatformGiven};
    let inputs = |t: f64| Inputs {
        lift: Signal::constant(0.8),
        sway: Signal::new(0.1 * t.sin(), 0.1 * t.cos(), -0.1 * t.sin()),
    };
    let mut followed = PlatformGiven::assemble(0.0, &inputs(0.0)).expect("the drawing assembles");
    let mut dropped = PlatformGiven::assemble(0.0, &inputs(0.0)).expect("the drawing assembles");
    for tick in 1..=800 {
        let t = 1e-3 * f64::from(tick);
        followed.advance(t, &inputs(t)).expect("a short step");
    }
    let before = dropped.frame().q.to_array();
    let jump = dropped.recover(0.8, &inputs(0.8)).expect("one cycle");
    let jump = jump.expect("all coordinates");
    assert_eq!(dropped.branches(), followed.branches());
    let [found, exact] = [&dropped, &followed].map(|it| it.frame().q.to_array());
    for (index, (found, exact)) in found.into_iter().zip(exact).enumerate() {
        assert!((found - exact).abs() < 1e-10, "{index}: {found} {exact}");
        assert_eq!(jump.to_array()[index], found - before[index]);
    }
    dropped
        .advance(0.801, &inputs(0.801))
        .expect("a short step");
}

#[test]
fn durations_pass_in_single_precision_after_hours() {
    use single::{Inputs, Winch};
    let rope = |t: f64| {
        let (sine, cosine) = t.sin_cos();
        let [value, rate, acceleration] = [0.6 + 0.1 * sine, 0.1 * cosine, -0.1 * sine];
        Inputs {
            rope: Signal::new(value as f32, rate as f32, acceleration as f32),
        }
    };
    // Where a millisecond is less than half a rounding of the time, so that t + dt = t.
    let (start, duration) = (40_000.0_f32, 1e-3_f32);
    assert_eq!(start + duration, start);
    let mut winch = Winch::assemble(start, &rope(40_000.0)).expect("the drawing assembles");
    for tick in 1..=20_000 {
        let exact = 40_000.0 + f64::from(tick) * f64::from(duration);
        let frame = winch.advance_by(duration, &rope(exact));
        let frame = frame.expect("a short step");
        assert!((f64::from(frame.t) - exact).abs() <= 0.5 * 2.0_f64.powi(-8) + 1e-6);
        let length = 0.6 + 0.1 * exact.sin();
        let [far, near] = [0.4_f64.hypot(0.45), 0.3_f64.hypot(0.15)];
        let apex = ((far * far + near * near - length * length) / (2.0 * far * near)).acos();
        let expected = (-0.45_f64).atan2(0.4) + apex - 0.15_f64.atan2(0.3);
        assert!((f64::from(frame.q.phi_boom) - expected).abs() < 2e-5);
    }
    // A failure lets no time pass, and a call of `advance` is where durations go on from.
    let before = winch.frame().t;
    assert!(
        winch
            .advance_by(
                0.01,
                &Inputs {
                    rope: Signal::constant(4.0)
                }
            )
            .is_err()
    );
    assert_eq!(winch.frame().t, before);
    // Over so long a time an input that moves would leave the reach in between.
    let rest = Inputs {
        rope: Signal::constant(0.6),
    };
    for t in [before, 0.0] {
        winch.advance(t, &rest).expect("within reach");
    }
    winch.advance_by(duration, &rest).expect("a short step");
    assert_eq!(winch.frame().t, duration);
}
