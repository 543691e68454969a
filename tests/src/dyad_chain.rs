//! Descriptions of chains of n dyads, to measure growth with the size of a mechanism.
//!
//! A driven crank moves a rocker through a coupler, the rocker moves the next one through another coupler, and so on.
//! Coupler and rocker k are two links on two known pins, the previous rocker's tip and a pin on the ground. The
//! ground pins alternate between two positions, so that the chain folds onto itself: its size does not grow with n,
//! and every second rocker repeats the crank's motion. No dyad comes nearer to its singular pose than the first, and
//! errors of the first are not amplified.

use std::fmt::Write as _;

/// Two positions: the ground pin and the tip of the link that turns about it, in the design configuration.
const PLACES: [[[f64; 2]; 2]; 2] = [[[0.0, 0.0], [0.0, 0.5]], [[1.0, 0.0], [1.1, 0.4]]];

/// Ground pin and tip of the rocker k, or of the crank for k = 0, in the design configuration (m).
pub fn places(k: usize) -> [[f64; 2]; 2] {
    PLACES[k % 2]
}

/// The description of a chain of n dyads: 1 + 2 n bodies, 3 + 6 n coordinates.
pub fn description(n: usize) -> String {
    with(n, "")
}

/// Chain without the path guard.
pub fn unguarded(n: usize) -> String {
    with(n, "    unguarded;\n")
}

fn with(n: usize, statement: &str) -> String {
    let mut text = format!("/// A chain of dyads.\nmechanism dyad_chain {{\n{statement}");
    let mut line = |line: String| {
        // Writing into a string cannot fail.
        let _ = writeln!(text, "    {line}");
    };
    for k in 0..=n {
        let [ground, tip] = places(k).map(|[x, y]| format!("({x}, {y})"));
        line(format!("point G{k} = {ground}, T{k} = {tip};"));
    }
    line("body crank at G0 { G0, T0 }".to_string());
    for k in 1..=n {
        line(format!(
            "body coupler{k} at T{} {{ T{}, T{k} }}",
            k - 1,
            k - 1
        ));
        line(format!("body rocker{k} at G{k} {{ G{k}, T{k} }}"));
    }
    line("revolute G0(ground, crank);".to_string());
    for k in 1..=n {
        let previous = if k == 1 {
            "crank".to_string()
        } else {
            format!("rocker{}", k - 1)
        };
        line(format!("revolute T{}({previous}, coupler{k});", k - 1));
        line(format!("revolute T{k}(coupler{k}, rocker{k});"));
        line(format!("revolute G{k}(ground, rocker{k});"));
    }
    line("drive phi(crank) = 0.3*sin(t);".to_string());
    text + "}\n"
}
