//! Exports a function of a mechanism whose forces take a linear solve.

mod forced_platform {
    linkwright::include_mechanism!(forced_platform);
}

/// Assembles at `start`, advances to `end` and gives an effort, a reaction and an energy; false and untouched numbers where it cannot.
#[unsafe(no_mangle)]
pub fn forced_platform(start: f64, end: f64, found: &mut [f64; 4]) -> bool {
    let Ok(mut mechanism) = forced_platform::ForcedPlatform::assemble(start) else {
        return false;
    };
    let Ok(frame) = mechanism.advance(end) else {
        return false;
    };
    let [x, y] = frame.reaction_p();
    *found = [
        frame.effort_drive_length_a_p(),
        x,
        y,
        frame.potential_energy(),
    ];
    true
}
