//! What the drivers transmit: T ṡ is the velocity, virtual work is conserved, closed forms, the textbook view, singular poses.

use linkwright::FailureKind;
use linkwright::nalgebra::{DMatrix, DVector};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::model::Role;
use linkwright_codegen::system::System;
use linkwright_tests::files;

/// One transmission of one frame.
pub struct Sample {
    name: &'static str,
    /// The velocity of the point, or the rate of the coordinate.
    velocity: Vec<f64>,
    /// T: a row for each component, a column for each driver.
    transmission: DMatrix<f64>,
    /// What the loads do to the drivers.
    forces: DVector<f64>,
}

/// One frame of a mechanism.
pub struct Instant {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    phi_t: Vec<f64>,
    samples: Vec<Sample>,
}

/// A mechanism of which every point and every angle is asked for.
pub struct Transmitting {
    name: &'static str,
    folder: &'static str,
    /// The frames at these times, with the samples under a load.
    sample: fn(&[f64], [f64; 2]) -> Vec<Instant>,
    /// q, q̇ and q̈ of the mechanism without transmissions.
    original: Option<fn(&[f64]) -> Vec<[Vec<f64>; 3]>>,
}

macro_rules! point_sample {
    ($frame:ident, $load:ident, $name:literal, $point:ident, $transmission:ident, $forces:ident) => {
        crate::Sample {
            name: $name,
            velocity: $frame.$point().velocity.to_vec(),
            transmission: crate::dynamic($frame.$transmission()),
            forces: crate::vector($frame.$forces($load)),
        }
    };
}

macro_rules! angle_sample {
    ($frame:ident, $load:ident, $name:literal, $angle:ident, $transmission:ident, $forces:ident) => {
        crate::Sample {
            name: $name,
            velocity: vec![$frame.qd.$angle],
            transmission: crate::dynamic($frame.$transmission()),
            forces: crate::vector($frame.$forces($load[0])),
        }
    };
}

macro_rules! sampled {
    ($mechanism:ident, $frame:ident, $load:ident, [$($sample:ident!($($argument:tt)+)),+]) => {
        pub fn sample(times: &[f64], $load: [f64; 2]) -> Vec<crate::Instant> {
            let mut mechanism = $mechanism::assemble(times[0]).expect("the drawing assembles");
            let mut instants = Vec::new();
            for &t in times {
                // One mechanism folds on the way; nothing is known of it afterwards.
                let Ok($frame) = mechanism.advance(t) else {
                    break;
                };
                instants.push(crate::Instant {
                    q: $frame.q.to_array().to_vec(),
                    qd: $frame.qd.to_array().to_vec(),
                    qdd: $frame.qdd.to_array().to_vec(),
                    phi_t: phi_t(&$frame.q, t).as_slice().to_vec(),
                    samples: sampled!(@each $frame, $load, [$($sample!($($argument)+)),+]),
                });
            }
            assert!(instants.len() > 40, "{} instants", instants.len());
            instants
        }
    };
    (@each $frame:ident, $load:ident, [$($sample:ident!($($argument:tt)+)),+]) => {
        vec![$($sample!($frame, $load, $($argument)+)),+]
    };
}

macro_rules! original {
    ($module:ident, $mechanism:ident) => {
        |times: &[f64]| {
            use linkwright_mechanisms::$module::$mechanism;
            let mut mechanism = $mechanism::assemble(times[0]).expect("the drawing assembles");
            let each = |&t: &f64| {
                let frame = mechanism.advance(t).expect("the motion can be followed");
                [frame.q, frame.qd, frame.qdd].map(|it| it.to_array().to_vec())
            };
            times.iter().map(each).collect()
        }
    };
}

mod generated {
    use super::Transmitting;
    include!(concat!(env!("OUT_DIR"), "/transmitting.rs"));
}
use generated::ALL;

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
    fn system(&self) -> System {
        let path = files::package(self.folder).join(format!("{}.mech", self.name));
        let text = std::fs::read_to_string(&path).expect("a description");
        let source = Source::new(self.name, text);
        linkwright_codegen::read(&source).expect("no errors").system
    }

    /// The rows of the drivers, in written order.
    fn drivers(&self) -> Vec<usize> {
        let system = self.system();
        let joints = &system.mechanism.joints;
        (0..system.rows.len())
            .filter(|&row| joints[system.rows[row].joint].role == Role::Driver)
            .collect()
    }
}

/// A driver row is quantity − f(t), so its partial derivative in time is minus the driver's rate.
fn driver_rates(instant: &Instant, drivers: &[usize]) -> DVector<f64> {
    DVector::from_iterator(
        drivers.len(),
        drivers.iter().map(|&row| -instant.phi_t[row]),
    )
}

/// The largest sum of the terms of T ṡ: what rounding is judged against, since points that rest do so as a difference.
fn fastest(instant: &Instant, rates: &DVector<f64>) -> f64 {
    let terms = |sample: &Sample| (sample.transmission.abs() * rates.abs()).max();
    let largest = instant.samples.iter().map(terms).fold(0.0, f64::max);
    // Where all drivers rest, everything does.
    if largest == 0.0 { 1.0 } else { largest }
}

#[test]
fn the_velocity_is_the_transmission_times_the_rates_of_the_drivers() {
    for mechanism in ALL {
        let drivers = mechanism.drivers();
        let mut largest = 0.0_f64;
        for instant in (mechanism.sample)(&times(), LOAD) {
            let rates = driver_rates(&instant, &drivers);
            let scale = fastest(&instant, &rates);
            for sample in &instant.samples {
                let product = &sample.transmission * &rates;
                for (product, velocity) in product.iter().zip(&sample.velocity) {
                    largest = largest.max((product - velocity).abs() / scale);
                }
            }
        }
        println!("{}: T ṡ − v at most {largest:.1e} of its terms", mechanism.name);
        assert!(largest < 1e-12, "{}: {largest:e}", mechanism.name);
    }
}

#[test]
fn virtual_work_is_conserved() {
    for mechanism in ALL {
        let drivers = mechanism.drivers();
        let mut largest = 0.0_f64;
        for instant in (mechanism.sample)(&times(), LOAD) {
            let rates = driver_rates(&instant, &drivers);
            for sample in &instant.samples {
                let load = DVector::from_column_slice(&LOAD[..sample.velocity.len()]);
                let velocity = DVector::from_column_slice(&sample.velocity);
                let (given, taken) = (load.dot(&velocity), sample.forces.dot(&rates));
                let scale = fastest(&instant, &rates) * load.norm();
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
        for (instant, [q, qd, qdd]) in (mechanism.sample)(&times(), LOAD).iter().zip(original(&times())) {
            assert_eq!(instant.q, q, "{}", mechanism.name);
            assert_eq!(instant.qd, qd, "{}", mechanism.name);
            assert_eq!(instant.qdd, qdd, "{}", mechanism.name);
            compared += 1;
        }
    }
    assert!(compared > 5 * TIMES);
}
