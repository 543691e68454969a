//! Exports a function of a mechanism with tables.

use linkwright::PointMotion;

mod generated {
    linkwright::include_mechanism!(tables);
}

/// Assembles at `start`, advances to `end` and takes one Newton-Raphson step; false and untouched results where one of them
/// fails. A slide, a shaft and a follower are where their tables say.
#[unsafe(no_mangle)]
extern "C" fn tables(
    start: f64,
    end: f64,
    follower: &mut PointMotion,
    update: &mut [f64; generated::Coordinates::COUNT],
) -> bool {
    use generated::Tables;
    let Ok(mut mechanism) = Tables::assemble(start) else {
        return false;
    };
    let Ok(frame) = mechanism.advance(end) else {
        return false;
    };
    *follower = frame.point_p();
    let Ok(step) = Tables::newton_step(&frame.q, end) else {
        return false;
    };
    *update = step.update.data.0[0];
    true
}
