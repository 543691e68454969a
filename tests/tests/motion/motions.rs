//! Mechanisms with several motions: each motion is a module of its own, and one inverts the other.

use linkwright::{Failure, FailureKind};
use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::check_all;
use linkwright_codegen::{Options, generate, read};

/// A slider-crank driven from either end.
mod both_ways {
    linkwright::include_mechanism!(both_ways);
}

/// An arm whose motions have parameters of their own.
mod motion_parameters {
    linkwright::include_mechanism!(motion_parameters);
}

#[test]
fn parameters_of_a_motion_are_its_own_behind_those_of_the_mechanism() {
    use motion_parameters::{home, out, still};
    let nominal = (out::Parameters::default(), home::Parameters::default());
    let out::Parameters { reach, pace, rise } = nominal.0;
    assert_eq!([reach, pace, rise], [0.4, 3.0, 0.25]);
    let home::Parameters { reach, fall, pace } = nominal.1;
    assert_eq!([reach, fall, pace], [0.4, 1.0, 0.7]);
    let still::Parameters { reach } = still::Parameters::default();
    assert_eq!(reach, 0.4);
    let mut driven_out = out::MotionParameters::assemble(0.0).expect("as drawn");
    let mut driven_home = home::MotionParameters::assemble(0.0).expect("as drawn");
    for step in 0..=200 {
        let t = 0.01 * f64::from(step);
        let frame = driven_out.advance(t).expect("it turns");
        assert!((frame.q.phi_arm - (0.25 + 3.0 * t)).abs() <= 1e-14, "{t}");
        assert!((frame.qd.phi_arm - 3.0).abs() <= 1e-14, "{t}");
        let frame = driven_home.advance(t).expect("it turns back");
        assert!((frame.q.phi_arm - (1.0 - 0.7 * t)).abs() <= 1e-14, "{t}");
        assert!((frame.point_p().position[0] - 0.4 * (1.0 - 0.7 * t).cos()).abs() <= 1e-14);
    }
    // Parameters of one motion do not affect the other.
    let changed = home::Parameters {
        pace: 0.2,
        ..nominal.1
    };
    driven_home.set_parameters(&changed).expect("it is finite");
    let frame = driven_home.advance(2.1).expect("it turns back");
    assert!((frame.q.phi_arm - (1.0 - 0.2 * 2.1)).abs() <= 1e-14);
    let frame = driven_out.advance(2.1).expect("it turns");
    assert!((frame.q.phi_arm - (0.25 + 3.0 * 2.1)).abs() <= 1e-14);
}

/// No equation of the motion `still` depends on time.
#[test]
fn a_motion_at_rest_refuses_times_that_are_not_finite() {
    use motion_parameters::still::MotionParameters;
    let kind = |result: Result<(), Failure>| result.expect_err("no such time").kind;
    let mut resting = MotionParameters::assemble(0.0).expect("as drawn");
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let assembled = MotionParameters::assemble(t).map(drop);
        assert_eq!(kind(assembled), FailureKind::NotFinite, "{t}");
        let moved = resting.advance(t).map(drop);
        assert_eq!(kind(moved), FailureKind::NotFinite, "{t}");
        assert_eq!(resting.frame().t, 0.0);
    }
    let frame = resting.advance(7.0).expect("at rest");
    assert_eq!((frame.t, frame.q.phi_arm), (7.0, 0.5));
}

#[test]
fn a_slider_crank_driven_from_either_end_moves_the_same_way() {
    let mut forward = both_ways::forward::BothWays::assemble(0.0).expect("as drawn");
    let mut backward = both_ways::backward::BothWays::assemble(0.0).expect("as drawn");
    for step in 0..=1000 {
        let t = 0.01 * f64::from(step);
        let slider = forward.advance(t).expect("the crank turns").point_c();
        let frame = backward.advance(t).expect("the slider moves");
        let angle = std::f64::consts::FRAC_PI_3 + t.sin();
        let (sine, cosine) = angle.sin_cos();
        let root = (4.0 - sine * sine).sqrt();
        let slope = -sine - sine * cosine / root;
        // Closed forms of the slider's position and rate.
        assert!((slider.position[0] - (cosine + root)).abs() <= 4e-15);
        assert!(slider.position[1].abs() <= 1e-15);
        assert!((slider.velocity[0] - slope * t.cos()).abs() <= 1e-14);
        // Backwards: the crank has the angle from which the slider's law was made, as well as its rate and
        // acceleration.
        assert!((frame.q.phi_crank - angle).abs() <= 1e-12, "{t}");
        assert!((frame.qd.phi_crank - t.cos()).abs() <= 1e-12, "{t}");
        assert!((frame.qdd.phi_crank + t.sin()).abs() <= 1e-11, "{t}");
        assert!(frame.point_c().position[1].abs() <= 1e-15);
    }
}

fn errors(text: &str) -> Diagnostics {
    generate(&Source::new("motions.mech", text), &Options::default()).expect_err("errors")
}

/// Mechanism around these motions: a crank without a driver.
fn crank(motions: &str) -> String {
    format!(
        "mechanism crank {{
            body 1 at (0, 0) {{ P: (1, 0) }}
            absolute_x(1) = 0;
            absolute_y(1) = 0;
            {motions}
        }}"
    )
}

#[test]
fn a_motion_is_a_complete_mechanism() {
    let source = Source::new(
        "crank.mech",
        crank("motion a { drive phi(1) = t; } motion b { absolute_x(1.P) = 0.5; output P; }"),
    );
    let read = read(&source).expect("a good description");
    check_all(&read.motions).expect("both are determined");
    let names: Vec<String> = read
        .motions
        .iter()
        .map(|derived| derived.system.mechanism.title())
        .collect();
    assert_eq!(names, ["crank, motion a", "crank, motion b"]);
    assert!(
        read.motion("a")
            .is_some_and(|derived| derived.system.rows.len() == 3)
    );
    assert!(read.motion("c").is_none());
    let requests: Vec<usize> = read
        .motions
        .iter()
        .map(|derived| derived.system.mechanism.requests.len())
        .collect();
    assert_eq!(requests, [0, 1]);
    assert!(read.only().is_none());
}

/// Rows of a motion are those of the mechanism with the motion's statements at its end.
#[test]
fn a_motion_alone_generates_what_its_statements_would() {
    let [inside, outside] =
        ["motion only { drive phi(1) = 2*t; }", "drive phi(1) = 2*t;"].map(|text| {
            generate(&Source::new("crank.mech", crank(text)), &Options::default()).expect("good")
        });
    // Comments and line breaks by indentation do not count.
    let tokens = |code: &str| -> String {
        let lines = code.lines().map(str::trim);
        let kept = lines.filter(|line| !line.starts_with("//"));
        let characters = kept.flat_map(str::chars);
        characters
            .filter(|it| !it.is_whitespace() && *it != ',')
            .collect()
    };
    let inside = tokens(inside.code());
    let module = inside
        .strip_prefix("#[allow(dead_code)]pubmodonly{")
        .and_then(|rest| rest.strip_suffix('}'));
    assert_eq!(module, Some(tokens(outside.code()).as_str()));
}

#[test]
fn faults_of_all_motions_are_reported_once() {
    let findings = errors(&crank(
        "motion a { output P; } motion b { output velocity P; }",
    ));
    let messages: Vec<&str> = findings.iter().map(|it| it.message.as_str()).collect();
    assert_eq!(messages.len(), 1, "{messages:?}");
    assert!(
        messages[0].starts_with("1 equation too few"),
        "{messages:?}"
    );
    let findings = errors(&crank(
        "motion a { output P; } motion b { drive phi(1) = t; }",
    ));
    let messages: Vec<&str> = findings.iter().map(|it| it.message.as_str()).collect();
    assert!(
        messages.len() == 1 && messages[0].starts_with("motion `a`: 1 equation too few"),
        "{messages:?}"
    );
}
