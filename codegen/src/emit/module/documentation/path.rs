//! Explains the verification of the path in generated modules.

use crate::program::Program;

/// Head of the section that verifies the path.
pub(in crate::emit) const PATH: [&str; 17] = [
    "Verification that a frame lies on the path of the last frame. Only the runtime calls these functions; the motion is computed",
    "above. The derivation is in codegen/guide/theory.md of Linkwright, section \"The path guard\".",
    "",
    "Terms:",
    "",
    "- Window: the time from the last frame to this frame, or a longer time with both frames. `steps` is its length in steps,",
    "  `remainder` the remainder of linear interpolation, `rounding` the relative rounding error of values.",
    "- Chord: the straight line through a value in both frames.",
    "- Change (`_change`): bound on the change of a value along the chord over the window.",
    "- Deviation (`_deviation`): bound on the distance of a value from the chord.",
    "- Radius (`_radius`): bound on the distance of a value from its value in this frame.",
    "- Enclosure: radius and deviation of a value over the window.",
    "- Arm: local vector that rotates with a body.",
    "",
    "A function fails with the number of the block whose path is not verified. The runtime then takes shorter steps.",
    "",
    "Names:",
];

/// Terms of the verification of two links, which follow the others.
pub(in crate::emit) const DYADS: [&str; 8] = [
    "- `input_change`, `input_deviation`: bounds of the outer pins and lengths of two links, in m.",
    "- `cosine`, `sine_square`: bounds on the cosine and on the squared sine of the angle between two links. The product of this sine",
    "  and both lengths is the determinant; divided by the lengths it is the normalized determinant, which is zero if the links",
    "  are collinear.",
    "- `inverse`: bound on the inverse of the normalized determinant.",
    "- `slope`: largest derivative of the cosine, or of an angle, with respect to the pins, in 1/m.",
    "- `turned`: bound on the rotation of a link times its length, in m.",
    "- `bent`: bound on the deviation of a link times its length, in m.",
];

/// Documentation of the function that verifies all equations together.
pub(in crate::emit) const VERIFY_PATH: [&str; 2] = [
    "Verifies all equations together: in the window they have one solution near the chord (Krawczyk's test).",
    "Fails with the number of the block that is not verified.",
];

/// Documentation of the function that verifies dyads one after another.
pub(in crate::emit) const VERIFY_NONSINGULAR: [&str; 2] = [
    "Verifies for each dyad in turn that its two links do not become collinear in the window.",
    "Fails with the number of the block that is not verified.",
];

/// Documentation of the same verification in lanes.
pub(in crate::emit) const VERIFY_NONSINGULAR_LANES: [&str; 2] = [
    "Verifies for each dyad in turn that its two links do not become collinear in the window.",
    "Returns the lanes that are verified.",
];

/// Documentation of the check of values that Newton-Raphson finds.
pub(in crate::emit) const IS_WITHIN: &str =
    "True if the values found by Newton-Raphson lie in the enclosures of the path.";

/// Returns the head of the section.
pub(in crate::emit) fn of_path(program: &Program) -> Vec<String> {
    let names = program.closed_path().map(|_| DYADS);
    let last = if names.is_some() {
        PATH.len()
    } else {
        PATH.len() - 2
    };
    let lines = PATH[..last].iter();
    let names = names.iter().flatten();
    let gap = names.clone().next().map(|_| &"");
    lines
        .chain(gap)
        .chain(names)
        .map(|line| line.to_string())
        .collect()
}
