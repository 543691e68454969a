//! Exports functions of the generated mechanisms: assemble, advance, one Newton-Raphson step, and every point.
//!
//! One exported function per mechanism does it all, so that nothing of a module can be dropped. The test writes the
//! list of them.

use linkwright::generated::newton;
use linkwright::nalgebra::{Const, SVector};
use linkwright::{Blocks, Equations, Mechanism, PointMotion, Settings, Shell, Values};

/// Requested solves of a mechanism, with memory for the results.
pub struct Call<'a> {
    /// Value for each coordinate.
    pub estimate: &'a [f64],
    /// Time of the assembly (s).
    pub start: f64,
    /// Time of the advance (s).
    pub end: f64,
    /// Motion of each point.
    pub points: &'a mut [PointMotion],
    /// Newton-Raphson step of the textbook formulation.
    pub update: &'a mut [f64],
}

/// Assembles at `start` from an estimate, advances to `end` and takes one Newton-Raphson step. If one of them fails,
/// returns false and leaves the points unchanged.
fn run<M, E, const N: usize>(call: &mut Call<'_>) -> bool
where
    M: Mechanism<Blocks: Blocks<Scalar = f64> + Default>,
    E: Equations<f64, Const<N>> + Default,
{
    let (blocks, settings) = (M::Blocks::default(), Settings::default());
    let (parameters, inputs) = (blocks.nominal_parameters(), blocks.initial_inputs());
    let mut estimate = blocks.drawn_pose(&parameters);
    for (index, value) in call.estimate.iter().enumerate() {
        estimate.set(index, *value);
    }
    let branches = blocks.drawn_branches();
    let assembled = Shell::assemble(
        blocks,
        &parameters,
        &estimate,
        branches,
        call.start,
        &inputs,
        settings,
    );
    let Ok(mut mechanism) = assembled else {
        return false;
    };
    let Ok(frame) = mechanism.advance(call.end, &inputs).cloned() else {
        return false;
    };
    let blocks = mechanism.blocks();
    for (index, place) in call.points.iter_mut().enumerate() {
        if let Some(motion) = blocks.point(&frame, index) {
            *place = motion;
        }
    }
    let mut pose = SVector::<f64, N>::zeros();
    for (index, value) in pose.iter_mut().enumerate() {
        if let Some([found, ..]) = blocks.coordinate(&frame, index) {
            *value = found;
        }
    }
    let Ok(step) = newton::step(&E::default(), &pose, call.end, &settings) else {
        return false;
    };
    for (place, value) in call.update.iter_mut().zip(step.update.iter()) {
        *place = *value;
    }
    true
}

/// Mechanisms of the gallery.
#[allow(missing_docs)]
mod gallery {
    include!(concat!(env!("MODULES"), "/gallery.rs"));
}

include!(concat!(env!("MODULES"), "/functions.rs"));

/// Assembles at `start`, advances to `end`, and writes the motion of the one output point; false if one of them
/// fails.
#[unsafe(no_mangle)]
pub extern "C" fn excavator_tool(start: f64, end: f64, point: &mut PointMotion) -> bool {
    use gallery::excavator_tool::ExcavatorTool;
    let Ok(mut mechanism) = ExcavatorTool::assemble(start) else {
        return false;
    };
    let Ok(frame) = mechanism.advance(end) else {
        return false;
    };
    *point = frame.point_k();
    true
}

/// Reaches for a position with the excavator's tool at `start`, drives the arm by the requested position at `end`,
/// and writes the motion of a pin of each actuator; then likewise from the lengths of the actuators. False if one of
/// them fails.
#[unsafe(no_mangle)]
pub extern "C" fn excavator_motions(
    start: f64,
    end: f64,
    wanted: &gallery::excavator_motions::reach::Inputs,
    lengths: &gallery::excavator_motions::forward::Inputs,
    points: &mut [PointMotion; 3],
) -> bool {
    use gallery::excavator_motions::{forward, reach};
    let Ok(mut arm) = reach::ExcavatorMotions::assemble(start, wanted) else {
        return false;
    };
    let Ok(frame) = arm.advance(end, wanted) else {
        return false;
    };
    [points[0], points[1]] = [frame.point_m(), frame.point_g()];
    let Ok(mut arm) = forward::ExcavatorMotions::assemble(start, lengths) else {
        return false;
    };
    let Ok(frame) = arm.advance(end, lengths) else {
        return false;
    };
    points[2] = frame.point_k();
    true
}

/// Computes the motors of an ankle from the requested foot, and the foot from the requested motors, at `end`: the
/// angles, and the torques of the motors. False if one of them fails.
#[unsafe(no_mangle)]
pub extern "C" fn ankle(
    end: f64,
    foot: &gallery::ankle::to_motors::Inputs,
    motors: &gallery::ankle::to_joint::Inputs,
    angles: &mut [f64; 6],
) -> bool {
    use gallery::ankle::{to_joint, to_motors};
    let Ok(mut ankle) = to_motors::Ankle::assemble(0.0, foot) else {
        return false;
    };
    let Ok(frame) = ankle.advance(end, foot) else {
        return false;
    };
    [angles[0], angles[1]] = [frame.phi_left(), frame.phi_right()];
    let Ok(mut ankle) = to_joint::Ankle::assemble(0.0, motors) else {
        return false;
    };
    let Ok(frame) = ankle.advance(end, motors) else {
        return false;
    };
    [angles[2], angles[3]] = [frame.phi_pitch(), frame.phi_roll()];
    [angles[4], angles[5]] = [
        frame.effort_drive_phi_left(),
        frame.effort_drive_phi_right(),
    ];
    true
}

/// Computes the joint of a differential wrist from its motors, and its motors from the joint; false if one fails.
#[unsafe(no_mangle)]
pub extern "C" fn differential_wrist(
    end: f64,
    motors: &gallery::differential_wrist::to_joint::Inputs,
    angles: &mut [f64; 2],
) -> bool {
    use gallery::differential_wrist::to_joint::DifferentialWrist;
    let Ok(mut wrist) = DifferentialWrist::assemble(0.0, motors) else {
        return false;
    };
    let Ok(frame) = wrist.advance(end, motors) else {
        return false;
    };
    *angles = [frame.phi_pitch(), frame.phi_roll()];
    true
}
