//! The generated mechanisms → functions of the library: assemble, advance, one Newton-Raphson step, and every point.
//!
//! One exported function per mechanism does it all, so that nothing of a module can be dropped. The build script writes the
//! list from the descriptions.

use linkwright::nalgebra::{Const, SVector};
use linkwright::{Blocks, Equations, Mechanism, PointMotion, Settings, Shell, Values, newton};

/// What is asked of a mechanism, and where its answers go.
pub struct Call<'a> {
    /// A value for each coordinate.
    pub estimate: &'a [f64],
    /// When it is assembled (s).
    pub start: f64,
    /// Where it is moved to (s).
    pub end: f64,
    /// The motion of each point.
    pub points: &'a mut [PointMotion],
    /// The Newton-Raphson step of the textbook view.
    pub update: &'a mut [f64],
}

/// Assembles at `start` from an estimate, advances to `end` and takes one Newton-Raphson step; false and untouched points where
/// one of them fails.
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

include!(concat!(env!("OUT_DIR"), "/mechanisms.rs"));

/// Assembles at `start`, advances to `end`, and gives the motion of the one point that is asked for; false where one of them
/// fails.
#[unsafe(no_mangle)]
pub extern "C" fn excavator_tool(start: f64, end: f64, point: &mut PointMotion) -> bool {
    use linkwright_mechanisms::excavator_tool::ExcavatorTool;
    let Ok(mut mechanism) = ExcavatorTool::assemble(start) else {
        return false;
    };
    let Ok(frame) = mechanism.advance(end) else {
        return false;
    };
    *point = frame.point_k();
    true
}

/// Reaches for a place with the excavator's tool at `start`, drives the arm by the wanted place at `end`, and gives the motion
/// of a pin of each actuator; then the same from the lengths of the actuators. False where one of them fails.
#[unsafe(no_mangle)]
pub extern "C" fn excavator_motions(
    start: f64,
    end: f64,
    wanted: &linkwright_mechanisms::excavator_motions::reach::Inputs,
    lengths: &linkwright_mechanisms::excavator_motions::forward::Inputs,
    points: &mut [PointMotion; 3],
) -> bool {
    use linkwright_mechanisms::excavator_motions::{forward, reach};
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
