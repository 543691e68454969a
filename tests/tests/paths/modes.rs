//! Assembly modes of generated mechanisms: they are part of the state, long steps do not leave them, and poor estimates lead to
//! them. What ends a motion is named in the mechanism's own terms.

use linkwright::{Failure, FailureKind, Settings, Signal};
use linkwright_mechanisms::excavator_motions::reach;
use linkwright_mechanisms::{platform_3rpr, stephenson};
use linkwright_tests::random::Random;

mod folding {
    linkwright::include_mechanism!(folding);
}

mod platform_given {
    linkwright::include_mechanism!(platform_given);
}

/// One of a thousand.
fn place(random: &mut Random) -> usize {
    random.between(0.0, 1000.0) as usize
}

/// Takes random ways within ten seconds in one step each; returns how many were refused. The truth is a motion in steps of 10 ms.
macro_rules! refused {
    ($assembled:expr, |$mechanism:ident, $t:ident| $advance:expr) => {{
        let mut $mechanism = $assembled.expect("as drawn");
        let mut states = vec![$mechanism];
        for step in 1..1000_u16 {
            let $t = 0.01 * f64::from(step);
            $advance.expect("a short step");
            states.push($mechanism);
        }
        let mut random = Random::new(5);
        let mut refused = 0;
        for _ in 0..1000 {
            let (from, to) = (place(&mut random), place(&mut random));
            let mut $mechanism = states[from];
            let end = states[to].frame();
            let $t = end.t;
            match $advance.copied() {
                Ok(frame) => {
                    for (found, expected) in frame.q.to_array().iter().zip(end.q.to_array()) {
                        let difference = (found - expected).abs();
                        assert!(difference < 1e-9, "{difference:e} from {from} to {to}");
                    }
                }
                Err(failure) => {
                    assert_eq!(failure.kind, FailureKind::StepTooLarge, "{failure}");
                    assert_eq!(
                        $mechanism.frame(),
                        states[from].frame(),
                        "the last frame is intact"
                    );
                    refused += 1;
                }
            }
        }
        refused
    }};
}

fn swing(center: f64, amplitude: f64, frequency: f64, t: f64) -> Signal {
    let (sine, cosine) = (frequency * t).sin_cos();
    Signal::new(
        center + amplitude * sine,
        amplitude * frequency * cosine,
        -amplitude * frequency * frequency * sine,
    )
}

#[test]
fn a_long_step_leads_where_short_ones_do_or_is_refused() {
    let platform = refused!(platform_3rpr::Platform3rpr::assemble(0.0), |it, t| it
        .advance(t));
    let stephenson = refused!(stephenson::Stephenson::assemble(0.0), |it, t| it.advance(t));
    println!("refused of 1000: platform_3rpr {platform}, stephenson {stephenson}");
    assert!(platform < 500 && stephenson < 500);
}

#[test]
fn an_excavator_that_reaches_keeps_its_modes() {
    let first = reach::Inputs::default();
    let signals = |t: f64| reach::Inputs {
        tool_x: swing(first.tool_x.value, 0.03, 1.5, t),
        tool_y: swing(first.tool_y.value, 0.03, 1.1, t),
    };
    let refused = refused!(
        reach::ExcavatorMotions::assemble(0.0, &signals(0.0)),
        |it, t| it.advance(t, &signals(t))
    );
    println!("refused of 1000: excavator_motions {refused}");
    assert_eq!(refused, 0);
}

/// The mode of a Newton block is that of the drawing and kept; the other one is another pose.
macro_rules! keeps_mode {
    ($module:ident::$mechanism:ident, $block:ident) => {{
        use $module::{Branches, $mechanism};
        let drawn = $mechanism::assemble(0.0).expect("as drawn");
        let branch = drawn.branches().$block.expect("found at assembly");
        assert_eq!(Branches::DESIGN.$block, Some(branch));
        let other = Branches {
            $block: Some(branch.opposite()),
            ..Branches::DESIGN
        };
        match $mechanism::assemble_on(other, 0.0) {
            Ok(mirrored) => {
                assert_eq!(mirrored.branches(), other);
                let (one, two) = (drawn.frame().q.to_array(), mirrored.frame().q.to_array());
                assert!(
                    one.iter()
                        .zip(two)
                        .any(|(one, two)| (one - two).abs() > 1e-3)
                );
                true
            }
            Err(failure) => {
                assert_eq!(failure.kind, FailureKind::WrongBranch, "{failure}");
                false
            }
        }
    }};
}

#[test]
fn the_mode_of_a_loop_without_a_closed_form_is_part_of_the_state() {
    let platform = keeps_mode!(platform_3rpr::Platform3rpr, loop_p_row_q_r);
    let stephenson = keeps_mode!(stephenson::Stephenson, loop_b_c_e);
    // From the drawing the other mode is too far away, and that is said.
    assert!(!platform && !stephenson);
}

/// Assembles from 10,000 poses that are off by up to half a radian and half a link, in the drawing's mode; returns how many lead
/// to the drawing's pose, how many to another one of the mode, and how many are refused.
macro_rules! starts {
    ($module:ident::$mechanism:ident, link $link:literal) => {{
        use $module::{Coordinates, $mechanism};
        let drawn = $mechanism::assemble(0.0).expect("as drawn");
        let mut random = Random::new(99);
        let mut counts = [0; 3];
        for _ in 0..10_000 {
            let mut estimate = Coordinates::DESIGN.to_array();
            for (place, value) in estimate.iter_mut().enumerate() {
                let reach = if place % 3 == 2 { 0.5 } else { 0.5 * $link };
                *value += reach * random.between(-1.0, 1.0);
            }
            let estimate = Coordinates::from_array(estimate);
            let (modes, settings) = (drawn.branches(), Settings::default());
            match $mechanism::assemble_with(&estimate, modes, 0.0, settings) {
                Ok(found) => {
                    assert_eq!(found.branches(), modes);
                    let (found, drawn) = (found.frame().q.to_array(), drawn.frame().q.to_array());
                    let same = found.iter().zip(drawn).all(|(a, b)| (a - b).abs() < 1e-9);
                    counts[usize::from(!same)] += 1;
                }
                Err(_) => counts[2] += 1,
            }
        }
        println!("{}: {counts:?} of 10000", stringify!($module));
        counts
    }};
}

#[test]
fn poor_estimates_lead_to_the_drawing() {
    assert_eq!(
        starts!(platform_3rpr::Platform3rpr, link 0.5),
        [10_000, 0, 0]
    );
    assert_eq!(starts!(stephenson::Stephenson, link 1.0), [10_000, 0, 0]);
}

fn described(failure: &Failure) -> String {
    folding::describe(failure).to_string()
}

#[test]
fn the_exam_driven_too_far_names_crank_and_rod_and_the_time() {
    let end = std::f64::consts::FRAC_PI_2;
    let mut mechanism = folding::Folding::assemble(0.5).expect("the drawing assembles");
    for t in [1.6, 2.0, 3.0, 4.0] {
        let before = *mechanism.frame();
        let failure = mechanism.advance(t).expect_err("the rod is too short");
        assert!((failure.time - end).abs() < 1e-9, "{failure}");
        let text = described(&failure);
        assert!(
            text.starts_with("revolute P(1, 2): out of reach by "),
            "{text}"
        );
        assert!(
            text.contains("the line from P to the origin of body 2 is parallel to the x axis"),
            "{text}"
        );
        assert!(text.contains("at t = 1.57079632"), "{text}");
        assert_eq!(*mechanism.frame(), before, "the last frame is intact");
        mechanism.advance(1.4).expect("the way back is open");
        mechanism.advance(0.5).expect("the way back is open");
    }
}

fn platform_signals(lift: f64) -> platform_given::Inputs {
    platform_given::Inputs {
        lift: Signal::constant(lift),
        sway: Signal::constant(0.02),
    }
}

#[test]
fn a_jump_of_an_input_goes_the_smoothest_way() {
    let mut mechanism =
        platform_given::PlatformGiven::assemble(0.0, &platform_signals(0.8)).expect("as drawn");
    let modes = mechanism.branches();
    let mut small = mechanism;
    mechanism
        .advance(1.0, &platform_signals(0.95))
        .expect("in several steps");
    for step in 1..=100_u8 {
        let part = f64::from(step) / 100.0;
        small
            .advance(part, &platform_signals(0.8 + 0.15 * part))
            .expect("in short steps");
    }
    let (one, two) = (mechanism.frame().q.to_array(), small.frame().q.to_array());
    assert!(
        one.iter()
            .zip(two)
            .all(|(one, two)| (one - two).abs() < 1e-9)
    );
    assert_eq!(mechanism.branches(), modes);
}

#[test]
fn legs_that_cannot_be_followed_are_a_failure_of_their_loop() {
    let mut mechanism =
        platform_given::PlatformGiven::assemble(0.0, &platform_signals(0.8)).expect("as drawn");
    let before = *mechanism.frame();
    let failure = mechanism
        .advance(1.0, &platform_signals(9.0))
        .expect_err("no leg is so long");
    assert!(0.0 < failure.time && failure.time < 1.0, "{failure}");
    let text = platform_given::describe(&failure).to_string();
    println!("{text}");
    assert!(text.starts_with("loop P-Q-R: "), "{text}");
    assert_eq!(*mechanism.frame(), before);
    mechanism
        .advance(0.01, &platform_signals(0.801))
        .expect("the last frame is intact");
}

#[test]
fn other_parameters_make_the_last_frame_an_estimate() {
    let mut mechanism =
        platform_given::PlatformGiven::assemble(0.0, &platform_signals(0.8)).expect("as drawn");
    let parameters = platform_given::Parameters {
        reach: 0.7,
        p_x: -0.09,
    };
    mechanism
        .set_parameters(&parameters)
        .expect("positive lengths");
    let reconfigured = *mechanism
        .advance(0.0, &platform_signals(0.8))
        .expect("another platform");
    let expected =
        platform_given::PlatformGiven::assemble_for(&parameters, 0.0, &platform_signals(0.8))
            .expect("as drawn");
    let (one, two) = (reconfigured.q.to_array(), expected.frame().q.to_array());
    assert!(
        one.iter()
            .zip(two)
            .all(|(one, two)| (one - two).abs() < 1e-9)
    );
    assert_eq!(mechanism.branches(), expected.branches());
}
