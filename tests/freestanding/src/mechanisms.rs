//! The generated mechanisms → functions of the library: assemble, advance, one Newton-Raphson step, and every point.
//!
//! One exported function per mechanism does it all, so that nothing of a module can be dropped. The build script writes the
//! list from the descriptions.

use linkwright::Motion;

macro_rules! registry {
    ($($module:ident: $mechanism:ident { $($point:literal => $motion:ident,)+ })+) => {
        $(
            /// Assembles at `start` from an estimate, advances to `end` and takes one Newton-Raphson step; false and
            /// untouched points where one of them fails.
            #[unsafe(no_mangle)]
            pub extern "C" fn $module(
                estimate: &linkwright_mechanisms::$module::Coordinates,
                start: f64,
                end: f64,
                points: &mut [Motion; [$($point),+].len()],
                update: &mut [f64; linkwright_mechanisms::$module::Coordinates::COUNT],
            ) -> bool {
                use linkwright_mechanisms::$module::$mechanism;
                let settings = linkwright::Settings::default();
                let Ok(mut mechanism) = $mechanism::assemble_from(estimate, start, settings) else { return false };
                let Ok(frame) = mechanism.advance(end) else { return false };
                *points = [$(frame.$motion()),+];
                let Ok(step) = $mechanism::newton_step(&frame.q, end) else { return false };
                *update = step.update.data.0[0];
                true
            }
        )+
    };
}

include!(concat!(env!("OUT_DIR"), "/registry.rs"));

/// Assembles at `start`, advances to `end`, and gives the motion of the one point that is asked for; false where one of them
/// fails.
#[unsafe(no_mangle)]
pub extern "C" fn excavator_tool(start: f64, end: f64, point: &mut Motion) -> bool {
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
    points: &mut [Motion; 3],
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
