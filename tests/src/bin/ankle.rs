//! Writes `tests/reports/ankle.md`: the ankle of a humanoid beside the usual code of robots. Run it in release.

use std::error::Error;
use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use linkwright::Signal;
use linkwright_mechanisms::ankle::{to_joint, to_motors};
use linkwright_tests::ankle::{SIDES, foot_of};
use linkwright_tests::jet::Jet;
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::swing::swing;

/// Measures the time and the error of both maps of the ankle and writes a report
#[derive(Parser)]
struct Arguments {
    /// Number of timed sweeps of 1,000 frames; the median counts
    #[arg(long, default_value_t = 201)]
    sweeps: usize,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
The foot of `mechanisms/ankle.mech` swings by 30° and 20°, in 1,000 frames 1 ms apart. Generated code finds angles, rates, accelerations,
the matrix of the transmission, and from the motors to the joint the efforts too; it shows that every frame is on the path of the last
one. The closed form by hand finds the angles and rates of both motors and nothing else. The loop of Newton-Raphson makes 100
iterations with differences from the level foot, as programs of robots do, and finds two angles. Ways are timed in turn, sweep by sweep,
and the median of the sweeps is given. Errors are those of the angles in rad: of motors by the residual of their rods, of the foot
beside what the motors were computed from.
";

/// Number of frames of a sweep.
const FRAMES: u32 = 1000;

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

/// Requested motion of the foot in each frame.
fn wanted() -> Vec<to_motors::Inputs> {
    (0..=FRAMES)
        .map(|frame| {
            let t = 1e-3 * f64::from(frame);
            to_motors::Inputs {
                wanted_pitch: swing(0.0, 0.52, 5.0, t),
                wanted_roll: swing(0.0, 0.35, 7.3, t),
            }
        })
        .collect()
}

/// Frames of one method: its errors, and the duration of each sweep.
struct Way {
    name: &'static str,
    finds: &'static str,
    sweep: Box<dyn FnMut() -> Result<f64, Box<dyn Error>>>,
    nanoseconds: Vec<f64>,
    error: f64,
}

fn ways() -> Result<Vec<Way>, Box<dyn Error>> {
    let inputs = wanted();
    let way = |name, finds, sweep| Way {
        name,
        finds,
        sweep,
        nanoseconds: Vec::new(),
        error: 0.0,
    };
    let start = to_motors::Ankle::assemble(0.0, &inputs[0])?;
    let mut ankle = start;
    let mut motors = Vec::new();
    for (frame, given) in inputs.iter().enumerate() {
        let frame_angles = ankle.advance(1e-3 * frame as f64, given)?;
        let all = |value, rate, acceleration| Signal {
            value,
            rate,
            acceleration,
        };
        motors.push(to_joint::Inputs {
            left_motor: all(
                frame_angles.phi_left(),
                frame_angles.phi_left_rate(),
                frame_angles.phi_left_acceleration(),
            ),
            right_motor: all(
                frame_angles.phi_right(),
                frame_angles.phi_right_rate(),
                frame_angles.phi_right_acceleration(),
            ),
            ..to_joint::Inputs::default()
        });
    }
    let foot_inputs = inputs.clone();
    let generated = move || {
        let mut ankle = start;
        let mut worst = 0.0_f64;
        for (frame, inputs) in foot_inputs.iter().enumerate() {
            let solved = ankle.advance(1e-3 * frame as f64, black_box(inputs))?;
            black_box(solved);
            let angles = [solved.phi_left(), solved.phi_right()];
            if frame % 100 == 0 {
                worst = worst.max(of_motors(inputs, angles));
            }
        }
        Ok(worst)
    };
    let foot_inputs = inputs.clone();
    let by_hand = move || {
        let mut worst = 0.0_f64;
        for (frame, inputs) in foot_inputs.iter().enumerate() {
            let inputs = black_box(inputs);
            let foot = [inputs.wanted_pitch, inputs.wanted_roll].map(|it| [it.value, it.rate]);
            let motor_angles = black_box(SIDES.map(|side| side.motor(foot)));
            if frame % 100 == 0 {
                worst = worst.max(of_motors(inputs, motor_angles.map(|it| it[0])));
            }
        }
        Ok(worst)
    };
    let start = to_joint::Ankle::assemble(0.0, &motors[0])?;
    let (foot_inputs, known) = (motors.clone(), inputs.clone());
    let generated_back = move || {
        let mut ankle = start;
        let mut worst = 0.0_f64;
        for (frame, (inputs, known)) in foot_inputs.iter().zip(&known).enumerate() {
            let solved = ankle.advance(1e-3 * frame as f64, black_box(inputs))?;
            black_box(solved);
            worst = worst.max(of_foot(known, [solved.phi_pitch(), solved.phi_roll()]));
        }
        Ok(worst)
    };
    let newton = move || {
        let mut worst = 0.0_f64;
        for (inputs, known) in motors.iter().zip(&inputs) {
            let inputs = black_box(inputs);
            let angles = [inputs.left_motor.value, inputs.right_motor.value];
            worst = worst.max(of_foot(known, black_box(foot_of(angles, [0.0; 2]))));
        }
        Ok(worst)
    };
    Ok(vec![
        way(
            "joint to motors, generated",
            "angles, rates, accelerations, transmission",
            Box::new(generated),
        ),
        way(
            "joint to motors, by hand",
            "angles, rates",
            Box::new(by_hand),
        ),
        way(
            "motors to joint, generated",
            "angles, rates, accelerations, transmission, efforts",
            Box::new(generated_back),
        ),
        way(
            "motors to joint, 100 iterations",
            "angles",
            Box::new(newton),
        ),
    ])
}

/// Distance of the angles of the motors from those at which the rods have their length.
fn of_motors(inputs: &to_motors::Inputs, motors: [f64; 2]) -> f64 {
    let [pitch, roll] = [inputs.wanted_pitch, inputs.wanted_roll].map(|it| Jet::from(it.value));
    let errors = SIDES.into_iter().zip(motors).map(|(side, motor)| {
        // Newton's step: the gap over its slope in the angle.
        let [gap, slope, _] = side.gap(pitch, roll, Jet([motor, 1.0, 0.0])).0;
        (gap / slope).abs()
    });
    errors.fold(0.0, f64::max)
}

fn of_foot(known: &to_motors::Inputs, [pitch, roll]: [f64; 2]) -> f64 {
    let errors = [
        pitch - known.wanted_pitch.value,
        roll - known.wanted_roll.value,
    ];
    errors.into_iter().map(f64::abs).fold(0.0, f64::max)
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut ways = ways()?;
    for _ in 0..arguments.sweeps.max(1) {
        for way in &mut ways {
            let begun = Instant::now();
            let error = (way.sweep)()?;
            let taken = begun.elapsed().as_nanos() as f64 / f64::from(FRAMES + 1);
            way.nanoseconds.push(taken);
            way.error = way.error.max(error);
        }
    }
    let mut rows = Vec::new();
    for way in &mut ways {
        way.nanoseconds.sort_by(f64::total_cmp);
        let median = way.nanoseconds[way.nanoseconds.len() / 2];
        let row = format!(
            "| {} | {} | {median:.0} | {:.1e} |",
            way.name, way.finds, way.error
        );
        eprintln!("{row}");
        rows.push(row);
    }
    let environment = arguments.destination.environment();
    let report = format!(
        "# The ankle of a humanoid\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin ankle`.\n\n{}\n{EXPLANATION}\n| way | finds | ns a frame | error in rad |\n|---|---|--:|--:|\n{}\n",
        environment.lines(),
        rows.join("\n")
    );
    arguments.destination.write("ankle.md", &report)?;
    Ok(())
}
