//! Parameters and inputs of generated mechanisms, against the same mechanism with everything written down.

use linkwright::{FailureKind, Signal};

mod four_bar_given {
    linkwright::include_mechanism!(four_bar_given);
}

mod four_bar_written {
    linkwright::include_mechanism!(four_bar_written);
}

use four_bar_given::{FourBarGiven, Inputs, Parameters};
use four_bar_written::FourBarWritten;

/// What `four_bar_written` says of its lengths.
const WRITTEN: Parameters = Parameters {
    g: 0.11,
    l1: 0.035,
    l2: 0.13,
    l3: 0.085,
    off: -0.02,
};

/// What `four_bar_written` says of its crank: f, f' and f''.
fn crank(t: f64) -> Inputs {
    let start = 40.0_f64.to_radians();
    Inputs {
        crank_angle: Signal {
            value: start + 3.0 * t + (2.0 * t).sin() / 5.0,
            rate: 3.0 + 2.0 * (2.0 * t).cos() / 5.0,
            acceleration: -4.0 * (2.0 * t).sin() / 5.0,
        },
    }
}

fn assert_near(one: [f64; 9], other: [f64; 9], scale: f64, t: f64) {
    for (one, other) in one.into_iter().zip(other) {
        assert!(
            (one - other).abs() <= 1e-13 * scale.max(other.abs()),
            "{one} is not {other} at {t}"
        );
    }
}

fn assert_same(given: &four_bar_given::Frame, written: &four_bar_written::Frame) {
    let t = written.t;
    assert_near(given.q.to_array(), written.q.to_array(), 1.0, t);
    assert_near(given.qd.to_array(), written.qd.to_array(), 3.0, t);
    assert_near(given.qdd.to_array(), written.qdd.to_array(), 10.0, t);
    let (one, other) = (given.point_p(), written.point_p());
    for axis in [0, 1] {
        assert!((one.position[axis] - other.position[axis]).abs() < 1e-14);
        assert!((one.velocity[axis] - other.velocity[axis]).abs() < 1e-13);
        assert!((one.acceleration[axis] - other.acceleration[axis]).abs() < 1e-12);
    }
}

#[test]
fn parameters_and_signals_give_what_is_written_down() {
    let mut written = FourBarWritten::assemble(0.0).expect("the drawing assembles");
    let mut given =
        FourBarGiven::assemble_for(&WRITTEN, 0.0, &crank(0.0)).expect("the drawing assembles");
    assert_same(given.frame(), written.frame());
    for step in 1..=300 {
        let t = f64::from(step) / 100.0;
        let written = written.advance(t).expect("the crank turns");
        let given = given.advance(t, &crank(t)).expect("the crank turns");
        assert_same(given, written);
    }
}

#[test]
fn parameters_set_on_the_way_count_from_the_next_instant() {
    let mut given = FourBarGiven::assemble(0.0, &crank(0.0)).expect("the drawing assembles");
    assert_eq!(*given.parameters(), Parameters::default());
    let before = *given.frame();
    given.set_parameters(&WRITTEN);
    assert_eq!(*given.parameters(), WRITTEN);
    assert_eq!(*given.frame(), before);
    let mut written = FourBarWritten::assemble(0.0).expect("the drawing assembles");
    let now = given.advance(0.25, &crank(0.25)).expect("the crank turns");
    let expected = written.advance(0.25).expect("the crank turns");
    assert_same(now, expected);
}

#[test]
fn the_nominal_values_are_those_of_the_description() {
    let nominal = Parameters::default();
    assert_eq!(
        [nominal.g, nominal.l1, nominal.l2, nominal.l3, nominal.off],
        [0.1, 0.04, 0.12, 0.08, 0.04]
    );
    let initial = Inputs::default().crank_angle;
    assert_eq!(initial, Signal::constant(40.0_f64.to_radians()));
}

#[test]
fn what_is_no_number_is_a_failure_and_keeps_the_last_frame() {
    let mut given = FourBarGiven::assemble(0.0, &crank(0.0)).expect("the drawing assembles");
    let before = *given.frame();
    for level in 0..3 {
        let mut wrong = crank(0.1);
        let signal = &mut wrong.crank_angle;
        *[
            &mut signal.value,
            &mut signal.rate,
            &mut signal.acceleration,
        ][level] = f64::NAN;
        let failure = given.advance(0.1, &wrong).expect_err("not a number");
        assert_eq!(failure.kind, FailureKind::NotFinite);
        assert!(FourBarGiven::assemble(0.1, &wrong).is_err());
    }
    let wrong = Parameters {
        off: f64::INFINITY,
        ..WRITTEN
    };
    given.set_parameters(&wrong);
    let failure = given.advance(0.1, &crank(0.1)).expect_err("not a number");
    assert_eq!(failure.kind, FailureKind::NotFinite);
    assert_eq!(*given.frame(), before);
    // Links that do not meet say so, and the mechanism can be repaired.
    given.set_parameters(&Parameters { g: 0.5, ..WRITTEN });
    let failure = given.advance(0.1, &crank(0.1)).expect_err("out of reach");
    assert!(matches!(failure.kind, FailureKind::OutOfReach { .. }));
    given.set_parameters(&WRITTEN);
    assert!(given.advance(0.1, &crank(0.1)).is_ok());
}
