//! Transmissions of the drivers: T ṡ is the velocity, virtual work is conserved, closed forms, the textbook
//! formulation, singular poses.

use std::path::Path;

use linkwright::nalgebra::{DMatrix, DVector};
use linkwright::{Blocks, FailureKind, Mechanism};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::expr::{ExprId, Tape};
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_tests::values::{Levels, assembled, levels, point_names};

/// Transmission of one frame.
pub struct Sample {
    name: &'static str,
    /// Velocity of the point, or rate of the coordinate.
    velocity: Vec<f64>,
    /// Matrix T: a row for each component, a column for each driver.
    transmission: DMatrix<f64>,
    /// Forces of the loads on the drivers.
    forces: DVector<f64>,
}

/// Frame of a mechanism.
pub struct Instant {
    t: f64,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    samples: Vec<Sample>,
}

/// Frames at these times.
type Follow = fn(&[f64]) -> Vec<Levels>;

/// Mechanism with the transmissions of every point and every angle.
pub struct Transmitting {
    name: &'static str,
    /// Frames at these times, with the samples under a load.
    sample: fn(&[f64], [f64; 2]) -> Vec<Instant>,
    /// q, q̇ and q̈ of the mechanism without transmissions.
    original: Option<Follow>,
}

type Frame<M> = <<M as Mechanism>::Blocks as Blocks>::Frame;

/// Functions of a point or of a coordinate.
pub struct Quantity<F> {
    name: &'static str,
    transmission: fn(&F) -> DMatrix<f64>,
    forces: fn(&F, [f64; 2]) -> DVector<f64>,
}

/// The frames of a mechanism at these times.
fn sample<M>(times: &[f64], load: [f64; 2], quantities: &[Quantity<Frame<M>>]) -> Vec<Instant>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let mut mechanism: M = assembled(times[0]).expect("the drawing assembles");
    let shell = mechanism.shell_mut();
    let inputs = shell.blocks().initial_inputs();
    let blocks = M::Blocks::default();
    let points = point_names(&blocks);
    let mut instants = Vec::new();
    for &t in times {
        // One mechanism folds; nothing is known of its later motion.
        let Ok(frame) = shell.advance(t, &inputs) else {
            break;
        };
        let velocity = |name: &str| match points.iter().position(|it| *it == name) {
            Some(place) => blocks
                .point(frame, place)
                .expect("a point")
                .velocity
                .to_vec(),
            None => {
                let mut places = 0..;
                let named = places.find(|&place| blocks.coordinate_name(place) == Some(name));
                let coordinate = named.and_then(|place| blocks.coordinate(frame, place));
                vec![coordinate.expect("a coordinate")[1]]
            }
        };
        let samples = quantities.iter().map(|it| Sample {
            name: it.name,
            velocity: velocity(it.name),
            transmission: (it.transmission)(frame),
            forces: (it.forces)(frame, load),
        });
        let samples = samples.collect();
        let [q, qd, qdd] = levels(&blocks, frame);
        instants.push(Instant {
            t,
            q,
            qd,
            qdd,
            samples,
        });
    }
    assert!(instants.len() > 40, "{} instants", instants.len());
    instants
}

/// The frames of a mechanism without transmissions at these times.
fn follow<M>(times: &[f64]) -> Vec<Levels>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
{
    let mut mechanism: M = assembled(times[0]).expect("the drawing assembles");
    let shell = mechanism.shell_mut();
    let (blocks, inputs) = (M::Blocks::default(), shell.blocks().initial_inputs());
    let each = |&t: &f64| {
        let frame = shell.advance(t, &inputs);
        levels(&blocks, frame.expect("the motion can be followed"))
    };
    times.iter().map(each).collect()
}

mod transmitted {
    linkwright::include_mechanism!(transmitted);
}

mod generated {
    use super::{Quantity, Transmitting, dynamic, follow, sample, vector};
    include!(concat!(env!("OUT_DIR"), "/transmitting.rs"));
}
use generated::{ALL, folding, platform_3rpr};

fn dynamic<const R: usize, const C: usize>(
    matrix: linkwright::nalgebra::SMatrix<f64, R, C>,
) -> DMatrix<f64> {
    DMatrix::from_column_slice(R, C, matrix.as_slice())
}

fn vector<const N: usize>(vector: linkwright::nalgebra::SVector<f64, N>) -> DVector<f64> {
    DVector::from_column_slice(vector.as_slice())
}

const TIMES: usize = 200;

fn times() -> Vec<f64> {
    (0..=TIMES).map(|step| step as f64 / 80.0).collect()
}

/// A load without symmetry, in N and N·m.
const LOAD: [f64; 2] = [0.7, -1.3];

impl Transmitting {
    /// Equations with the transmission of every point and angle.
    fn derived(&self) -> Derived {
        let folder = Path::new(env!("OUT_DIR")).join("transmitting");
        let path = folder.join(format!("{}.mech", self.name));
        let text = std::fs::read_to_string(&path).expect("a description");
        let source = Source::new(self.name, text);
        linkwright_codegen::read(&source)
            .expect("no errors")
            .only()
            .expect("one motion")
            .clone()
    }

    /// Rates ṡ at these times: the derivatives of the drivers' laws, in written order.
    fn driver_rates(&self) -> Vec<DVector<f64>> {
        let Derived { pool, system } = &mut self.derived();
        let mechanism = &system.mechanism;
        let drivers = mechanism.joints.iter().filter(|it| it.role == Role::Driver);
        let values: Vec<ExprId> = drivers.filter_map(|it| it.operands.value).collect();
        let (graph, time) = (&mut pool.graph, mechanism.time);
        let rates: Vec<ExprId> = values
            .iter()
            .map(|&value| graph.derivative(value, time))
            .collect();
        let tape = Tape::new(graph, &rates);
        let at = |&t: &f64| {
            let mut symbols = vec![0.0; graph.symbol_count()];
            graph.fill_nominal(&mut symbols);
            symbols[time.index()] = t;
            let mut results = vec![0.0; rates.len()];
            tape.evaluate(&symbols, &mut Vec::new(), &mut results);
            DVector::from_vec(results)
        };
        times().iter().map(at).collect()
    }
}

/// Largest sum of the terms of T ṡ: scale for rounding, since points at rest are a difference of these terms.
fn fastest(instant: &Instant, rates: &DVector<f64>) -> f64 {
    let terms = |sample: &Sample| (sample.transmission.abs() * rates.abs()).max();
    let largest = instant.samples.iter().map(terms).fold(0.0, f64::max);
    // If all drivers rest, everything does.
    if largest == 0.0 { 1.0 } else { largest }
}

#[test]
fn the_velocity_is_the_transmission_times_the_rates_of_the_drivers() {
    for mechanism in ALL {
        let all_rates = mechanism.driver_rates();
        let mut largest = 0.0_f64;
        for (instant, rates) in (mechanism.sample)(&times(), LOAD).iter().zip(&all_rates) {
            let scale = fastest(instant, rates);
            for sample in &instant.samples {
                let product = &sample.transmission * rates;
                for (product, velocity) in product.iter().zip(&sample.velocity) {
                    let error = (product - velocity).abs() / scale;
                    assert!(
                        error < 1e-12,
                        "{} of {}: {error:e}",
                        sample.name,
                        mechanism.name
                    );
                    largest = largest.max(error);
                }
            }
        }
        println!(
            "{}: T ṡ − v at most {largest:.1e} of its terms",
            mechanism.name
        );
    }
}

#[test]
fn virtual_work_is_conserved() {
    for mechanism in ALL {
        let all_rates = mechanism.driver_rates();
        let mut largest = 0.0_f64;
        for (instant, rates) in (mechanism.sample)(&times(), LOAD).iter().zip(&all_rates) {
            for sample in &instant.samples {
                let load = DVector::from_column_slice(&LOAD[..sample.velocity.len()]);
                let velocity = DVector::from_column_slice(&sample.velocity);
                let (given, taken) = (load.dot(&velocity), sample.forces.dot(rates));
                let scale = fastest(instant, rates) * load.norm();
                largest = largest.max((given - taken).abs() / scale);
            }
        }
        println!("{}: powers differ by at most {largest:.1e}", mechanism.name);
        assert!(largest < 1e-12, "{}: {largest:e}", mechanism.name);
    }
}

#[test]
fn a_transmission_does_not_change_the_motion() {
    let mut compared = 0;
    for mechanism in ALL {
        let Some(original) = mechanism.original else {
            continue;
        };
        for (instant, [q, qd, qdd]) in (mechanism.sample)(&times(), LOAD)
            .iter()
            .zip(original(&times()))
        {
            assert_eq!(instant.q, q, "{}", mechanism.name);
            assert_eq!(instant.qd, qd, "{}", mechanism.name);
            assert_eq!(instant.qdd, qdd, "{}", mechanism.name);
            compared += 1;
        }
    }
    assert!(compared > 5 * TIMES);
}

/// Φ_q X = −Φ_δ of the textbook formulation as one dense system, at the pose of generated code.
#[test]
fn the_textbook_view_transmits_the_same() {
    for mechanism in ALL {
        let derived = mechanism.derived();
        let interpreter = TextbookEquations::new(&derived.pool, &derived.system);
        let mut largest = 0.0_f64;
        for instant in (mechanism.sample)(&times(), LOAD).iter().step_by(7) {
            let q = DVector::from_column_slice(&instant.q);
            let responses = interpreter
                .responses(&q, instant.t)
                .expect("a regular pose");
            let points = interpreter.transmissions(&q, instant.t, &responses);
            let scale = points.iter().map(|it| it.amax()).fold(0.0, f64::max);
            assert_eq!(points.len(), instant.samples.len());
            for (point, sample) in points.iter().zip(&instant.samples) {
                let error = (point - &sample.transmission).amax() / scale;
                assert!(
                    error < 1e-11,
                    "{} of {}: {error:e}",
                    sample.name,
                    mechanism.name
                );
                largest = largest.max(error);
            }
        }
        println!(
            "{}: the views differ by at most {largest:.1e}",
            mechanism.name
        );
    }
}

/// The coupler of a slider-crank with offset e: x = r cos φ + √(l² − (r sin φ − e)²), so that
/// x' = −r sin φ − (r sin φ − e) r cos φ / √(l² − (r sin φ − e)²) per radian.
#[test]
fn a_slider_crank_transmits_as_its_closed_form_says() {
    let (r, l, e) = (0.04, 0.12, -0.02_f64);
    let mechanism = ALL
        .iter()
        .find(|it| it.name == "slider_crank")
        .expect("it is listed");
    for instant in (mechanism.sample)(&times(), LOAD) {
        let point = |name: &str| {
            instant
                .samples
                .iter()
                .find(|it| it.name == name)
                .expect("a point")
        };
        let phi = instant.q[2];
        let height = r * phi.sin() - e;
        let slope = -r * phi.sin() - height * r * phi.cos() / (l * l - height * height).sqrt();
        let slider = &point("C").transmission;
        assert!(
            (slider[(0, 0)] - slope).abs() < 1e-15,
            "{} {slope}",
            slider[(0, 0)]
        );
        assert!(slider[(1, 0)].abs() < 1e-16);
        let crank = &point("B").transmission;
        assert!((crank[(0, 0)] + r * phi.sin()).abs() < 1e-16);
        assert!((crank[(1, 0)] - r * phi.cos()).abs() < 1e-16);
    }
}

/// A leg of length s with direction u from its ground pin to its pin on the platform has ṡ = u · v of that pin (Tsai 1999,
/// *Robot Analysis*, section 5.4): the transmissions of the three pins, each projected on its leg, are the unit matrix.
#[test]
fn the_legs_of_a_platform_move_as_they_are_driven() {
    let legs = [("A", "P"), ("B", "Q"), ("C", "R")];
    for t in times() {
        let mut platform =
            platform_3rpr::TransmittingPlatform3rpr::assemble(0.0).expect("as drawn");
        let frame = platform.advance(t).expect("the motion can be followed");
        let pins = [
            (frame.point_a(), frame.point_p(), frame.transmission_p()),
            (frame.point_b(), frame.point_q(), frame.transmission_q()),
            (frame.point_c(), frame.point_r(), frame.transmission_r()),
        ];
        for (leg, (ground, pin, transmission)) in pins.iter().enumerate() {
            let along = [0, 1].map(|axis| pin.position[axis] - ground.position[axis]);
            let length = along[0].hypot(along[1]);
            for driver in 0..3 {
                let rate = (along[0] * transmission[(0, driver)]
                    + along[1] * transmission[(1, driver)])
                    / length;
                let expected = if driver == leg { 1.0 } else { 0.0 };
                assert!(
                    (rate - expected).abs() < 1e-13,
                    "{:?} by {driver}: {rate}",
                    legs[leg]
                );
            }
        }
    }
}

/// If crank and rod become collinear the transmission grows without limit; the result is finite, or a failure.
#[test]
fn a_singular_pose_is_a_failure_and_never_infinite() {
    let mut mechanism = folding::TransmittingFolding::assemble(0.0).expect("as drawn");
    let fold = std::f64::consts::FRAC_PI_2;
    for exponent in 1..=6 {
        let t = fold - 10.0_f64.powi(-exponent);
        let frame = mechanism.advance(t).expect("not yet in line");
        let transmission = frame.transmission_phi2();
        assert!(transmission[(0, 0)].is_finite());
        assert!(transmission[(0, 0)].abs() > 0.1 * 10.0_f64.powi(exponent).sqrt());
    }
    let before = mechanism.frame().transmission_phi2();
    let failure = mechanism.advance(fold).expect_err("in line");
    assert!(
        matches!(failure.kind, FailureKind::Singular { .. }),
        "{failure}"
    );
    let failure = mechanism.advance(fold + 0.1).expect_err("out of reach");
    assert!(
        matches!(failure.kind, FailureKind::OutOfReach { .. }),
        "{failure}"
    );
    assert_eq!(mechanism.frame().transmission_phi2(), before);
}

/// Only the pose and the transmissions are computed, and they equal those of the mechanism with all requests.
#[test]
fn a_transmission_needs_no_velocities() {
    let whole = ALL
        .iter()
        .find(|it| it.name == "four_bar")
        .expect("it is listed");
    let mut mechanism = transmitted::Transmitted::assemble(0.0).expect("as drawn");
    for (t, instant) in times().into_iter().zip((whole.sample)(&times(), LOAD)) {
        let frame = mechanism.advance(t).expect("the crank turns");
        let named = |name: &str| {
            instant
                .samples
                .iter()
                .find(|it| it.name == name)
                .expect("a sample")
        };
        assert_eq!(dynamic(frame.transmission_p()), named("P").transmission);
        assert_eq!(
            dynamic(frame.transmission_phi_rocker()),
            named("phi_rocker").transmission
        );
        assert_eq!(vector(frame.forces_p(LOAD)), named("P").forces);
    }
    let path = linkwright_tests::files::package("descriptions/transmitted.mech");
    let source = Source::new(
        "transmitted",
        std::fs::read_to_string(path).expect("a description"),
    );
    let read = linkwright_codegen::read(&source).expect("no errors");
    let report = linkwright_tests::plan::report(&read.only().expect("one motion"));
    // Velocities would share only the reciprocal of the determinant with the transmission.
    assert_eq!(report.operations[1].total(), 1);
    assert_eq!(report.operations[2].total(), 0);
    assert!(report.transmission.expect("it is asked for").total() < 20);
    assert_eq!(transmitted::Frame::DRIVERS, ["drive phi(crank)"]);
}
