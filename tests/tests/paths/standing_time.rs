//! Inputs and parameters that change at constant time: a step of its own, which succeeds or fails as any other.

use linkwright::{Failure, FailureKind, Signal};

mod winch {
    linkwright::include_mechanism!(winch);
}

use winch::{Inputs, Parameters, Winch, describe};

/// Winch at rest, at its nominal pose.
fn standing(t: f64) -> Winch {
    Winch::assemble(t, &rope(0.6)).expect("the drawing assembles")
}

fn rope(length: f64) -> Inputs {
    Inputs {
        rope: Signal::constant(length),
    }
}

/// Checks that the rope has this length, and that the boom is on its original side of the line from its pivot to the
/// winch.
///
/// The angle at the pivot follows from the three sides by the law of cosines.
fn assert_holds(winch: &Winch, head: [f64; 2], length: f64) {
    let anchor = [0.4, -0.45_f64];
    let [far, near] = [anchor, head].map(|it: [f64; 2]| it[0].hypot(it[1]));
    let cosine = (far * far + near * near - length * length) / (2.0 * far * near);
    let direction = anchor[1].atan2(anchor[0]) + cosine.acos();
    let expected = direction - head[1].atan2(head[0]);
    let boom_angle = winch.frame().q.phi_boom;
    assert!(
        (boom_angle - expected).abs() < 1e-9,
        "{length}: {boom_angle} {expected}"
    );
}

const HEAD: [f64; 2] = [0.3, 0.15];

/// The longest rope: pivot to winch, and pivot to head beyond it.
fn longest() -> f64 {
    0.4_f64.hypot(0.45) + 0.3_f64.hypot(0.15)
}

fn out_of_reach(failure: Failure) -> f64 {
    match failure.kind {
        FailureKind::OutOfReach { by } => by,
        _ => panic!("{failure}"),
    }
}

#[test]
fn a_rope_that_does_not_reach_is_refused_while_time_stands() {
    let mut winch = standing(2.0);
    for length in [4.0, 0.1, 0.95, 1e6] {
        let before = *winch.frame();
        let failure = winch.advance(2.0, &rope(length)).expect_err("no pose");
        let missing = out_of_reach(failure);
        if length > 0.5 {
            assert!(
                (missing - (length - longest())).abs() < 1e-9 * length,
                "{missing}"
            );
        }
        assert_eq!(failure.time, 2.0);
        assert_eq!(*winch.frame(), before);
    }
    winch.advance(2.001, &rope(0.61)).expect("within reach");
    assert_holds(&winch, HEAD, 0.61);
}

#[test]
fn a_jump_of_an_input_is_a_step_of_its_own() {
    for t in [0.0, 2.0, -3e5] {
        let mut winch = standing(t);
        for length in [0.9, 0.3, 0.93, 0.27, 0.6, 0.6, 0.9374, 0.267] {
            winch.advance(t, &rope(length)).expect("within reach");
            assert_holds(&winch, HEAD, length);
            assert_eq!(winch.frame().t, t);
        }
        // Rates alone change the rates of the frame: d² = c - 2ab cos θ, so that d d' = ab sin θ θ'.
        let moving = Inputs {
            rope: Signal::new(0.6, 0.05, 0.0),
        };
        winch.advance(t, &rope(0.6)).expect("within reach");
        let frame = winch.advance(t, &moving).expect("within reach");
        let [far, near] = [0.4_f64.hypot(0.45), 0.3_f64.hypot(0.15)];
        let cosine = (far * far + near * near - 0.36) / (2.0 * far * near);
        let rate = 0.6 * 0.05 / (far * near * (1.0 - cosine * cosine).sqrt());
        assert!(
            (frame.qd.phi_boom - rate).abs() < 1e-9,
            "{}",
            frame.qd.phi_boom
        );
    }
}

#[test]
fn nothing_that_has_changed_is_no_step() {
    let mut winch = standing(2.0);
    let before = *winch.frame();
    for _ in 0..3 {
        assert_eq!(*winch.advance(2.0, &rope(0.6)).expect("it stands"), before);
    }
}

#[test]
fn a_step_that_time_cannot_divide_is_one_of_the_inputs() {
    let (t, next) = (3e5_f64, 3e5_f64.next_up());
    let mut winch = standing(t);
    winch.advance(next, &rope(0.93)).expect("within reach");
    assert_holds(&winch, HEAD, 0.93);
    assert_eq!(winch.frame().t, next);
    let failure = winch.advance(t, &rope(0.95)).expect_err("no pose");
    assert!(out_of_reach(failure) > 0.0 && failure.time == t);
}

#[test]
fn parameters_that_do_not_reach_are_refused_while_time_stands() {
    let mut winch = standing(2.0);
    let before = *winch.frame();
    winch
        .set_parameters(&Parameters { head_x: 3.0 })
        .expect("a position");
    for _ in 0..2 {
        let failure = winch.advance(2.0, &rope(0.6)).expect_err("no pose");
        assert!(out_of_reach(failure) > 0.0);
        assert_eq!(*winch.frame(), before);
    }
    winch
        .set_parameters(&Parameters { head_x: 0.31 })
        .expect("a position");
    winch.advance(2.0, &rope(0.62)).expect("within reach");
    assert_holds(&winch, [0.31, 0.15], 0.62);
}

#[test]
fn an_input_that_is_not_finite_is_named_and_forgotten() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for level in 0..3 {
            for t in [2.0, 2.001, 5.0] {
                let mut winch = standing(2.0);
                let mut numbers = [0.6, 0.0, 0.0];
                numbers[level] = wrong;
                let [value, rate, acceleration] = numbers;
                let inputs = Inputs {
                    rope: Signal::new(value, rate, acceleration),
                };
                let failure = winch.advance(t, &inputs).expect_err("not finite");
                assert_eq!(
                    (failure.kind, failure.input),
                    (FailureKind::NotFinite, Some(0))
                );
                assert_eq!(failure.time, t);
                let message = describe(&failure).to_string();
                assert_eq!(message, format!("input rope is not finite, at t = {t} s"));
                assert_eq!(failure.to_string(), format!("not finite: input 0, t = {t}"));
                let failure = winch.frame_at(t, &inputs).expect_err("not finite");
                assert_eq!((failure.input, failure.time), (Some(0), t));
                assert!(Winch::assemble(t, &inputs).is_err_and(|it| it.input == Some(0)));
                winch
                    .advance(2.001, &rope(0.61))
                    .expect("the next call is good");
                assert_holds(&winch, HEAD, 0.61);
            }
        }
    }
}
