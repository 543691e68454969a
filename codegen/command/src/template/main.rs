//! Moves the linkage through one turn of its crank.

use std::process::ExitCode;

use {{module}}::four_bar::{FourBar, describe};

/// The time between two frames, in s.
const STEP: f64 = 0.25;

fn main() -> ExitCode {
    match turn() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {}", describe(&failure));
            ExitCode::FAILURE
        }
    }
}

/// Prints where the tip is, from frame to frame.
fn turn() -> Result<(), linkwright::Failure> {
    // From the pose in the drawing; `assemble_from` starts from a measured one.
    let mut linkage = FourBar::assemble(0.0)?;
    for step in 0..=8 {
        // Starts from the last frame. On an error that frame stays what it was.
        let frame = linkage.advance(STEP * f64::from(step))?;
        let tip = frame.point_p();
        println!(
            "t = {:.2} s  P = ({:.6}, {:.6}) m  at {:.3} m/s",
            frame.t,
            tip.position[0],
            tip.position[1],
            tip.velocity[0].hypot(tip.velocity[1]),
        );
    }
    Ok(())
}
