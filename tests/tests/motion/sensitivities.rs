//! Derivatives of the motion by parameters: against differences, closed forms and the textbook formulation, and at
//! singular poses.

use std::path::Path;

use linkwright::nalgebra::DVector;
use linkwright::{Blocks, FailureKind, Mechanism, Settings, Shell, Values};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_tests::values::{filled, levels, numbers};

/// Derivatives by one parameter: position and velocity of all coordinates, then of all points.
pub type Derivatives = [Vec<f64>; 2];

/// One frame of a mechanism.
pub struct Instant {
    t: f64,
    /// Position and velocity of all coordinates, then of all points.
    values: [Vec<f64>; 2],
    acceleration: Vec<f64>,
    /// By parameter.
    sensitivities: Vec<Derivatives>,
}

/// Mechanism with the sensitivity to each of its parameters.
pub struct Sensing {
    name: &'static str,
    parameters: &'static [&'static str],
    nominal: fn() -> Vec<f64>,
    /// Function for the frames at these times with these parameters.
    sample: fn(&[f64], &[f64]) -> Vec<Instant>,
}

type Frame<M> = <<M as Mechanism>::Blocks as Blocks>::Frame;

fn nominal<M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>>() -> Vec<f64> {
    numbers(&M::Blocks::default().nominal_parameters())
}

/// Derivatives of all coordinates with their rates, then of points with their velocities.
fn all<C: Values<f64>>(coordinates: [C; 2], points: &[[[f64; 2]; 2]]) -> Derivatives {
    let mut derivatives = coordinates.map(|it| numbers(&it));
    for point in points {
        for (level, values) in derivatives.iter_mut().zip(point) {
            level.extend(values);
        }
    }
    derivatives
}

/// Frames of a mechanism at these times, with the sensitivities of its frames to each parameter.
fn sample<M>(
    parameters: &[f64],
    times: &[f64],
    derivatives: &[fn(&Frame<M>) -> Derivatives],
) -> Vec<Instant>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let blocks = M::Blocks::default();
    let inputs = blocks.initial_inputs();
    let parameters = filled(blocks.nominal_parameters(), parameters);
    let assembled = Shell::assemble(
        M::Blocks::default(),
        &parameters,
        &blocks.drawn_pose(&parameters),
        blocks.drawn_branches(),
        times[0],
        &inputs,
        Settings::default(),
    );
    let mut shell = assembled.expect("the drawing assembles");
    let each = |&t: &f64| {
        let frame = shell
            .advance(t, &inputs)
            .expect("the motion can be followed");
        let [mut position, mut velocity, acceleration] = levels(&blocks, frame);
        for motion in (0..).map_while(|place| blocks.point(frame, place)) {
            position.extend(motion.position);
            velocity.extend(motion.velocity);
        }
        Instant {
            t,
            values: [position, velocity],
            acceleration,
            sensitivities: derivatives.iter().map(|of| of(frame)).collect(),
        }
    };
    times.iter().map(each).collect()
}

mod generated {
    use super::{Sensing, all, nominal, sample};
    include!(concat!(env!("OUT_DIR"), "/sensing.rs"));
}
use generated::ALL;

const TIMES: usize = 40;

fn times() -> Vec<f64> {
    (0..=TIMES).map(|step| step as f64 / 25.0).collect()
}

fn named(name: &str) -> &'static Sensing {
    ALL.iter().find(|it| it.name == name).expect("it is listed")
}

impl Sensing {
    fn derived(&self) -> Derived {
        let folder = Path::new(env!("OUT_DIR")).join("sensing");
        let path = folder.join(format!("{}.mech", self.name));
        let text = std::fs::read_to_string(&path).expect("a description");
        let read = linkwright_codegen::read(&Source::new(self.name, text)).expect("no errors");
        read.only().expect("one motion")
    }

    /// Central differences of all values along a parameter.
    fn differences(&self, parameter: usize, step: f64) -> Vec<Derivatives> {
        let sampled = |shift: f64| {
            let mut parameters = (self.nominal)();
            parameters[parameter] += shift;
            (self.sample)(&parameters, &times())
        };
        let (above, below) = (sampled(step), sampled(-step));
        let pairs = above.iter().zip(&below);
        pairs
            .map(|(above, below)| {
                [0, 1].map(|level| {
                    let pairs = above.values[level].iter().zip(&below.values[level]);
                    pairs.map(|(a, b)| (a - b) / (2.0 * step)).collect()
                })
            })
            .collect()
    }
}

/// Largest difference of two lists of derivatives, and the largest of the second.
fn apart(one: &Derivatives, other: &Derivatives, level: usize) -> (f64, f64) {
    assert_eq!(one[level].len(), other[level].len());
    let pairs = one[level].iter().zip(&other[level]);
    pairs.fold((0.0, 0.0), |(error, scale): (f64, f64), (one, other)| {
        (error.max((one - other).abs()), scale.max(other.abs()))
    })
}

/// Richardson's extrapolation of two central differences leaves an error of the fourth order in the step.
#[test]
fn sensitivities_are_the_limits_of_differences() {
    let mut compared = 0;
    for mechanism in ALL {
        let nominal = (mechanism.nominal)();
        let exact = (mechanism.sample)(&nominal, &times());
        for (parameter, name) in mechanism.parameters.iter().enumerate() {
            let step = 2e-3 * nominal[parameter].abs();
            let coarse = mechanism.differences(parameter, step);
            let fine = mechanism.differences(parameter, step / 2.0);
            let mut largest = [0.0_f64; 2];
            let mut scale = [0.0_f64; 2];
            for (place, instant) in exact.iter().enumerate() {
                let extrapolated = [0, 1].map(|level| {
                    let pairs = fine[place][level].iter().zip(&coarse[place][level]);
                    pairs
                        .map(|(fine, coarse)| (4.0 * fine - coarse) / 3.0)
                        .collect()
                });
                for level in 0..2 {
                    let generated = &instant.sensitivities[parameter];
                    let (error, size) = apart(&extrapolated, generated, level);
                    largest[level] = largest[level].max(error);
                    scale[level] = scale[level].max(size);
                }
                compared += 1;
            }
            // These mechanisms depend on each parameter.
            assert!(scale[0] > 0.0, "{name} of {}", mechanism.name);
            for level in 0..2 {
                let error = largest[level] / scale[level].max(scale[0]);
                println!("{} by {name}, level {level}: {error:.1e}", mechanism.name);
                assert!(
                    error < 1e-9,
                    "{name} of {}, {level}: {error:e}",
                    mechanism.name
                );
            }
        }
    }
    assert!(compared > 1000);
}

/// Halving the step of a central difference quarters the remainder, which is truncation and not an error of the
/// derivative.
#[test]
fn differences_leave_their_truncation() {
    let mechanism = named("sensed_four_bar");
    let nominal = (mechanism.nominal)();
    let exact = (mechanism.sample)(&nominal, &times());
    for (parameter, value) in nominal.iter().enumerate() {
        let errors = [0.04, 0.02, 0.01].map(|step| {
            let differences = mechanism.differences(parameter, step * value);
            let pairs = differences.iter().zip(&exact);
            let errors =
                pairs.map(|(found, instant)| apart(found, &instant.sensitivities[parameter], 1).0);
            errors.fold(0.0, f64::max)
        });
        // A value that is linear in a parameter has no truncation.
        if errors[0] < 1e-12 {
            continue;
        }
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!(
                (3.9..4.3).contains(&ratio),
                "{} {ratio}",
                mechanism.parameters[parameter]
            );
        }
    }
}

/// Φ_q ∂q/∂p = −Φ_p and its derivative for the rates, as dense systems at the frame of generated code.
#[test]
fn the_textbook_view_depends_on_parameters_alike() {
    for mechanism in ALL {
        let derived = mechanism.derived();
        let interpreter = TextbookEquations::new(&derived.pool, &derived.system);
        let count = derived.system.coordinates.len();
        let mut largest = 0.0_f64;
        for instant in (mechanism.sample)(&(mechanism.nominal)(), &times()) {
            let [q, qd] =
                [0, 1].map(|level| DVector::from_column_slice(&instant.values[level][..count]));
            let frame = linkwright::Frame {
                t: instant.t,
                q,
                qd,
                qdd: DVector::from_column_slice(&instant.acceleration),
            };
            let position = interpreter
                .responses(&frame.q, frame.t)
                .expect("a regular pose");
            let velocity = interpreter
                .sensitivity_rates(&frame, &position)
                .expect("a regular pose");
            for (parameter, own) in instant.sensitivities.iter().enumerate() {
                for (level, dense) in [&position, &velocity].into_iter().enumerate() {
                    let generated = DVector::from_column_slice(&own[level][..count]);
                    let dense = dense.column(parameter);
                    // Some parameters move only a point.
                    let scale = dense.amax().max(position.column(parameter).amax());
                    let error = (generated - dense).amax() / if scale > 0.0 { scale } else { 1.0 };
                    assert!(
                        error < 1e-11,
                        "{} of {}, {level}: {error:e}",
                        mechanism.parameters[parameter],
                        mechanism.name
                    );
                    largest = largest.max(error);
                }
            }
        }
        println!(
            "{}: the views differ by at most {largest:.1e}",
            mechanism.name
        );
    }
}

/// The closure of the four-bar, L2 e(φ2) + L3 e(φ3) − L4 e(φ4) = (G, 0), differentiated by hand. With e⊥ = Ω e, along a length
/// L3 (Norton 2012, *Design of Machinery*, sections 4.5 and 6.7, has the same loop with t in place of L3):
/// e3 + L3 φ3' e3⊥ = L4 φ4' e4⊥, whose products with e4 and e3 give
/// L3 φ3' sin(φ4 − φ3) = −cos(φ4 − φ3) and L4 φ4' sin(φ4 − φ3) = −1;
/// along L4 in the same way L3 φ3' sin(φ4 − φ3) = 1 and L4 φ4' sin(φ4 − φ3) = cos(φ4 − φ3); along L2
/// L3 φ3' sin(φ4 − φ3) = −cos(φ4 − φ2) and L4 φ4' sin(φ4 − φ3) = −cos(φ3 − φ2); along G, whose sign is the other one,
/// L3 φ3' sin(φ4 − φ3) = cos φ4 and L4 φ4' sin(φ4 − φ3) = cos φ3. Their rates follow by the quotient rule.
#[test]
fn a_four_bar_depends_on_its_lengths_as_its_closure_says() {
    let mechanism = named("sensed_four_bar");
    let nominal = (mechanism.nominal)();
    let &[ground, crank, coupler, rocker, ..] = nominal.as_slice() else {
        panic!("it has lengths");
    };
    assert_eq!([ground, crank, coupler, rocker], [0.1, 0.04, 0.12, 0.08]);
    for instant in (mechanism.sample)(&nominal, &times()) {
        let [q, qd] = &instant.values;
        let (two, three, four) = (q[2], q[5], q[8]);
        let (two_rate, three_rate, four_rate) = (qd[2], qd[5], qd[8]);
        let (sine, cosine) = (four - three).sin_cos();
        let turning = four_rate - three_rate;
        // Each quotient is −cos(angle)/(length sin(φ4 − φ3)) up to its sign; its rate follows.
        let quotient = |sign: f64, angle: f64, rate: f64, length: f64| {
            let value = sign * angle.cos() / (length * sine);
            let slope =
                -sign * angle.sin() * rate / (length * sine) - value * turning * cosine / sine;
            [value, slope]
        };
        let expected = [
            [
                quotient(1.0, four, four_rate, coupler),
                quotient(1.0, three, three_rate, rocker),
            ],
            [
                quotient(-1.0, four - two, four_rate - two_rate, coupler),
                quotient(-1.0, three - two, three_rate - two_rate, rocker),
            ],
            [
                quotient(-1.0, four - three, turning, coupler),
                quotient(-1.0, 0.0, 0.0, rocker),
            ],
            [
                quotient(1.0, 0.0, 0.0, coupler),
                quotient(1.0, four - three, turning, rocker),
            ],
        ];
        for (parameter, angles) in expected.iter().enumerate() {
            for (angle, place) in angles.iter().zip([5, 8]) {
                for (level, expected) in angle.iter().enumerate() {
                    let derivative = instant.sensitivities[parameter][level][place];
                    let error = (derivative - expected).abs() / expected.abs().max(10.0);
                    let name = mechanism.parameters[parameter];
                    assert!(
                        error < 1e-12,
                        "{name}, {place}, {level}: {derivative} {expected}"
                    );
                }
            }
        }
    }
}

mod sensed_outputs {
    linkwright::include_mechanism!(sensed_outputs);
}

/// Only the quantities of `output` are differentiated; they equal those of the mechanism with all outputs.
#[test]
fn only_outputs_are_differentiated() {
    let whole = named("sensed_four_bar");
    let mut mechanism = sensed_outputs::SensedOutputs::assemble(0.0).expect("as drawn");
    for (t, instant) in times()
        .into_iter()
        .zip((whole.sample)(&(whole.nominal)(), &times()))
    {
        let frame = mechanism.advance(t).expect("the crank swings");
        let length = &instant.sensitivities[1];
        let near = |found: f64, expected: f64| {
            assert!(
                (found - expected).abs() < 1e-12 * expected.abs().max(1.0),
                "{found} {expected}"
            );
        };
        near(frame.phi_rocker_sensitivity_l2(), length[0][8]);
        near(frame.phi_rocker_rate_sensitivity_l2(), length[1][8]);
        // Nine coordinates and the points A, D, B, C, P come before.
        let place = 9 + 2 * 4;
        let point = frame.point_p_position_sensitivity_l2();
        near(point[0], length[0][place]);
        near(point[1], length[0][place + 1]);
    }
}

mod sensed_folding {
    linkwright::include_mechanism!(sensed_folding);
}

/// If crank and rod become collinear the derivative grows without limit; the result is finite, or a failure.
#[test]
fn a_singular_pose_is_a_failure_and_never_infinite() {
    use sensed_folding::SensedFolding;
    let mut mechanism = SensedFolding::assemble(0.0).expect("as drawn");
    let fold = std::f64::consts::FRAC_PI_2;
    for exponent in 1..=6 {
        let t = fold - 10.0_f64.powi(-exponent);
        let frame = mechanism.advance(t).expect("not yet in line");
        let sensitivity = frame.sensitivity_l();
        assert!(
            sensitivity
                .position
                .to_array()
                .iter()
                .all(|it| it.is_finite())
        );
        assert!(
            sensitivity
                .velocity
                .to_array()
                .iter()
                .all(|it| it.is_finite())
        );
        assert!(sensitivity.position.phi2.abs() > 0.1 * 10.0_f64.powi(exponent).sqrt());
    }
    let before = mechanism.frame().sensitivity_l();
    let failure = mechanism.advance(fold).expect_err("in line");
    assert!(
        matches!(failure.kind, FailureKind::Singular { .. }),
        "{failure}"
    );
    assert_eq!(mechanism.frame().sensitivity_l(), before);
}
