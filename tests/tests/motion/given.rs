//! Parameters and inputs of generated mechanisms, against the same mechanism with all numbers in its description.

use linkwright::nalgebra::SVector;
use linkwright::{FailureKind, Signal};

mod four_bar_given {
    linkwright::include_mechanism!(four_bar_given);
}

mod four_bar_written {
    linkwright::include_mechanism!(four_bar_written);
}

use four_bar_given::{FourBarGiven, Inputs, Parameters};
use four_bar_written::FourBarWritten;

/// Lengths in `four_bar_written`.
const WRITTEN: Parameters = Parameters {
    g: 0.11,
    l1: 0.035,
    l2: 0.13,
    l3: 0.085,
    off: -0.02,
};

/// Motion of the crank in `four_bar_written`: f, f' and f''.
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
    let mut driven =
        FourBarGiven::assemble_for(&WRITTEN, 0.0, &crank(0.0)).expect("the drawing assembles");
    assert_same(driven.frame(), written.frame());
    for step in 1..=300 {
        let t = f64::from(step) / 100.0;
        let written = written.advance(t).expect("the crank turns");
        let driven = driven.advance(t, &crank(t)).expect("the crank turns");
        assert_same(driven, written);
    }
}

#[test]
fn parameters_set_on_the_way_count_from_the_next_instant() {
    let mut driven = FourBarGiven::assemble(0.0, &crank(0.0)).expect("the drawing assembles");
    assert_eq!(*driven.parameters(), Parameters::default());
    let before = *driven.frame();
    driven.set_parameters(&WRITTEN).expect("positive lengths");
    assert_eq!(*driven.parameters(), WRITTEN);
    assert_eq!(*driven.frame(), before);
    let mut written = FourBarWritten::assemble(0.0).expect("the drawing assembles");
    let now = driven.advance(0.25, &crank(0.25)).expect("the crank turns");
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
fn nan_is_a_failure_and_keeps_the_last_frame() {
    let mut driven = FourBarGiven::assemble(0.0, &crank(0.0)).expect("the drawing assembles");
    let before = *driven.frame();
    for level in 0..3 {
        let mut wrong = crank(0.1);
        let signal = &mut wrong.crank_angle;
        *[
            &mut signal.value,
            &mut signal.rate,
            &mut signal.acceleration,
        ][level] = f64::NAN;
        let failure = driven.advance(0.1, &wrong).expect_err("not a number");
        assert_eq!(failure.kind, FailureKind::NotFinite);
        assert!(FourBarGiven::assemble(0.1, &wrong).is_err());
    }
    let wrong = Parameters {
        off: f64::INFINITY,
        ..WRITTEN
    };
    let failure = driven.set_parameters(&wrong).expect_err("infinite");
    assert_eq!(failure.kind, FailureKind::NotFinite);
    assert_eq!(*driven.parameters(), Parameters::default());
    assert_eq!(*driven.frame(), before);
    // Links that do not meet are a failure, and the mechanism can be repaired.
    let apart = Parameters { g: 0.5, ..WRITTEN };
    driven.set_parameters(&apart).expect("positive lengths");
    let failure = driven.advance(0.1, &crank(0.1)).expect_err("out of reach");
    assert!(matches!(failure.kind, FailureKind::OutOfReach { .. }));
    driven.set_parameters(&WRITTEN).expect("positive lengths");
    assert!(driven.advance(0.1, &crank(0.1)).is_ok());
}

mod sliders_given {
    linkwright::include_mechanism!(sliders_given);
}

#[test]
fn a_length_that_is_not_positive_is_refused_and_the_old_one_kept() {
    use sliders_given::{Parameters, SlidersGiven, describe};
    let mut sliders = SlidersGiven::assemble(0.0).expect("as drawn");
    for (rod, figure) in [
        (-1.4, "-1.40"),
        (0.0, "0"),
        (-0.0, "0"),
        (f64::MIN, "-1.8e308"),
    ] {
        let wrong = Parameters { rod };
        let failure = sliders.set_parameters(&wrong).expect_err("not positive");
        assert_eq!(failure.kind, FailureKind::NotPositive { value: rod });
        let words = format!(
            "relative_distance (1.P, 2.Q): the distance must be positive, and would be {figure}"
        );
        assert_eq!(describe(&failure).to_string(), words);
        assert_eq!(*sliders.parameters(), Parameters::default());
        assert!(SlidersGiven::assemble_for(&wrong, 0.0).is_err());
    }
    let frame = sliders.advance(0.5).expect("the rod reaches");
    let x = 0.6 + 0.5_f64.sin() / 5.0;
    assert!((frame.q.y2 - (1.0 - x * x).sqrt()).abs() < 1e-14);
}

mod platform_given {
    linkwright::include_mechanism!(platform_given);
}

mod slider_given {
    linkwright::include_mechanism!(slider_given);
}

mod sleeve_given {
    linkwright::include_mechanism!(sleeve_given);
}

/// Signal a + b sin(c t) with its derivatives.
fn harmonic(a: f64, b: f64, c: f64, t: f64) -> Signal {
    Signal::new(
        a + b * (c * t).sin(),
        b * c * (c * t).cos(),
        -b * c * c * (c * t).sin(),
    )
}

fn platform_signals(t: f64) -> platform_given::Inputs {
    platform_given::Inputs {
        lift: harmonic(0.8, 0.05, 1.3, t),
        sway: harmonic(0.02, 0.04, 0.9, t),
    }
}

fn slider_signals(t: f64) -> slider_given::Inputs {
    slider_given::Inputs {
        extension: harmonic(0.06, 0.02, 1.7, t),
    }
}

const PLATFORM: platform_given::Parameters = platform_given::Parameters {
    reach: 0.75,
    p_x: -0.08,
};

const SLIDER: slider_given::Parameters = slider_given::Parameters {
    r: 0.045,
    l: 0.13,
    offset: -0.015,
    tilt: 0.3,
    speed: 2.5,
};

/// First two derivatives at 0, from five times `h` apart: errors of the order h⁴.
fn derivatives<const N: usize>(of: impl Fn(f64) -> [f64; N], h: f64) -> [[f64; N]; 2] {
    let values = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|step: f64| of(step * h));
    let [a, b, c, d, e] = values;
    let first = std::array::from_fn(|at| (a[at] - 8.0 * b[at] + 8.0 * d[at] - e[at]) / (12.0 * h));
    let second = std::array::from_fn(|at| {
        (-a[at] + 16.0 * b[at] - 30.0 * c[at] + 16.0 * d[at] - e[at]) / (12.0 * h * h)
    });
    [first, second]
}

/// Compares the solved formulation with the textbook functions and its rates with differences of its positions.
/// Textbook derivatives are compared with differences of Φ along straight lines through poses off the constraints.
macro_rules! agrees {
    ($module:ident, $mechanism:ident, $parameters:expr, $signals:expr) => {{
        use $module::{Coordinates, gamma, phi, phi_q, phi_t, $mechanism};
        const N: usize = Coordinates::COUNT;
        let (parameters, signals) = (&$parameters, $signals);
        let vector = |values: &Coordinates| SVector::<f64, N>::from(values.to_array());
        let mut mechanism = $mechanism::assemble_for(parameters, 0.0, &signals(0.0))
            .expect("the drawing assembles");
        for step in 1..=60 {
            let t = f64::from(step) / 20.0;
            let frame = *mechanism
                .advance(t, &signals(t))
                .expect("the motion can be followed");
            let (q, qd, qdd) = (frame.q, frame.qd, frame.qdd);
            let inputs = signals(t);
            let jacobian = phi_q(&q, parameters, &inputs, t);
            let residual = phi(&q, parameters, &inputs, t);
            let rate = jacobian * vector(&qd) + phi_t(&q, parameters, &inputs, t);
            let drift = jacobian * vector(&qdd) - gamma(&q, &qd, parameters, &inputs, t);
            let [size, speed] = [qd, qdd].map(|values| 1.0 + vector(&values).amax());
            assert!(residual.amax() < 1e-13, "{residual}");
            assert!(rate.amax() < 1e-13 * size, "{rate}");
            assert!(drift.amax() < 1e-13 * (speed + size * size), "{drift}");

            let near = |after: f64, of: fn(&$module::Frame) -> Coordinates| {
                let mut near = mechanism;
                let frame = near.advance(t + after, &signals(t + after));
                of(frame.expect("the motion can be followed")).to_array()
            };
            let [first, second] = derivatives(|after| near(after, |frame| frame.q), 2e-3);
            assert!((SVector::from(first) - vector(&qd)).amax() < 1e-8 * size);
            assert!((SVector::from(second) - vector(&qdd)).amax() < 1e-6 * speed);

            // Off the constraints: q moves on a straight line, so its accelerations are zero.
            let mut off = q.to_array();
            let mut along = qd.to_array();
            for (place, (position, rate)) in off.iter_mut().zip(&mut along).enumerate() {
                let turn = f64::from(step) + f64::from(place as u32);
                *position += 0.3 * turn.sin();
                *rate = 0.7 * (1.7 * turn).cos();
            }
            let line = |after: f64| {
                let moved = std::array::from_fn(|at| off[at] + after * along[at]);
                phi(
                    &Coordinates::from_array(moved),
                    parameters,
                    &signals(t + after),
                    t + after,
                )
                .data
                .0[0]
            };
            let [first, second] = derivatives(line, 5e-3);
            let (off, along) = (Coordinates::from_array(off), Coordinates::from_array(along));
            let rate = phi_q(&off, parameters, &inputs, t) * vector(&along)
                + phi_t(&off, parameters, &inputs, t);
            assert!((SVector::from(first) - rate).amax() < 1e-9);
            let drift = gamma(&off, &along, parameters, &inputs, t);
            assert!((SVector::from(second) + drift).amax() < 1e-8);
        }
    }};
}

#[test]
fn rates_count_those_of_the_signals() {
    agrees!(platform_given, PlatformGiven, PLATFORM, platform_signals);
    agrees!(slider_given, SliderGiven, SLIDER, slider_signals);
    agrees!(four_bar_given, FourBarGiven, WRITTEN, crank);
}

/// The crank's pin, and the point through which the rod passes: the rod is designed from B to S, so it turns with
/// both.
#[test]
fn a_line_that_is_drawn_with_parameters_follows_them() {
    use sleeve_given::{Inputs, Parameters, SleeveGiven};
    let parameters = Parameters {
        crank_x: 0.035,
        h: 0.02,
        d: 0.14,
        slope: -0.004,
    };
    let signals = |t: f64| Inputs {
        angle: harmonic(0.1, 0.4, 2.0, t),
    };
    let mut mechanism =
        SleeveGiven::assemble_for(&parameters, 0.0, &signals(0.0)).expect("the drawing assembles");
    // The sleeve keeps the distance of D from the line B-S in the design configuration.
    let line = [parameters.d - parameters.crank_x, parameters.slope];
    let length = line[0].hypot(line[1]);
    let to_pivot = [parameters.d - parameters.crank_x, 0.03 - parameters.h];
    let offset = (line[0] * to_pivot[1] - line[1] * to_pivot[0]) / length;
    let near = |mut mechanism: SleeveGiven, t: f64| {
        let frame = mechanism.advance(t, &signals(t)).expect("it turns");
        [frame.phi_rod(), frame.phi_rod_rate()]
    };
    for step in 1..=40 {
        let t = f64::from(step) / 20.0;
        let frame = *mechanism.advance(t, &signals(t)).expect("it turns");
        let (sine, cosine) = signals(t).angle.value.sin_cos();
        let [x, y] = [parameters.crank_x, parameters.h];
        let pin = [cosine * x - sine * y, sine * x + cosine * y];
        let position = frame.point_b().position;
        assert!((position[0] - pin[0]).hypot(position[1] - pin[1]) < 1e-15);
        // The rod's x axis is its line, since its frame faces from B to S.
        let (sine, cosine) = frame.phi_rod().sin_cos();
        let to_pivot = [parameters.d - pin[0], 0.03 - pin[1]];
        let kept = cosine * to_pivot[1] - sine * to_pivot[0];
        assert!((kept - offset).abs() < 1e-15, "{kept} is not {offset}");
        let [first, _] = derivatives(|after| near(mechanism, t + after), 2e-3);
        assert!((first[0] - frame.phi_rod_rate()).abs() < 1e-9);
        assert!((first[1] - frame.phi_rod_acceleration()).abs() < 1e-8);
    }
}

mod crane {
    linkwright::include_mechanism!(crane);
}

/// Checks the example of README.md.
#[test]
fn a_crane_is_lengthened_and_lifted() -> Result<(), linkwright::Failure> {
    use crane::{Crane, Inputs, Parameters};
    let mut crane = Crane::assemble(0.0, &Inputs::default())?;
    crane.set_parameters(&Parameters { l2: 0.36 })?;
    let lift = Signal {
        value: 0.6,
        rate: 0.02,
        acceleration: 0.0,
    };
    let frame = crane.advance(0.01, &Inputs { lift })?;
    // In the triangle A-B-C the angle at A follows from the law of cosines: |AB| = 0.5 m and |AC|² = 0.0725 m².
    let side = 0.0725_f64.sqrt();
    let at_pivot = ((0.25 + 0.0725 - 0.36) / (2.0 * 0.5 * side)).acos();
    let phi = (-0.4_f64).atan2(0.3) + at_pivot - 0.1_f64.atan2(0.25);
    let tip = frame.point_k();
    assert!((tip.position[0] - 0.36 * phi.cos()).abs() < 1e-15);
    assert!((tip.position[1] - 0.36 * phi.sin()).abs() < 1e-15);
    // 2 c ċ = 2 |AB| |AC| sin α · α̇.
    let rate = 0.6 * 0.02 / (0.5 * side * at_pivot.sin());
    assert!((frame.qd.phi_jib - rate).abs() < 1e-15);
    Ok(())
}
