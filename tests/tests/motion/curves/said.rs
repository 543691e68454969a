//! Warnings about curves that cannot be followed, and printed contacts.

use linkwright_codegen::Options;
use linkwright_codegen::diagnostic::{Code, Source};
use linkwright_tests::files;

/// Warnings of a description of a cam and a follower.
fn warnings(curve: &str, follower: &str) -> Vec<(Code, String)> {
    let text = format!(
        "mechanism cam {{
            point O = (0, 0), P = (0, 58mm);
            body cam at O {{ O }}
            body follower at P {{ P, A: (-20mm, 0), B: (20mm, 0) }}
            {curve}
            revolute O(ground, cam);
            translational (ground, follower) along O -> P;
            {follower}
            drive phi(cam) = t;
        }}"
    );
    let source = Source::new("cam.mech", text);
    let read = linkwright_codegen::read(&source)
        .unwrap_or_else(|found| panic!("{}", found.render(&source)));
    let warnings = read.warnings.iter();
    warnings
        .map(|warning| (warning.code, warning.message.clone()))
        .collect()
}

#[test]
fn curves_that_nothing_can_follow_are_warned_of() {
    let kidney = "curve rim(a) on cam = polar 40mm + 10mm*cos(2*a + pi);";
    // r = 40 − 10 cos 2a is hollow at a = 0, where r = 30, r'' = 40 and κ = (r − r'')/r² = −1/90 per mm.
    let reported = warnings(kidney, "flat (follower, rim) along A -> B;");
    assert!(
        reported
            .iter()
            .any(|(code, message)| *code == Code::DegenerateGeometry
                && message
                    .starts_with("a flat face does not reach into a hollow of the curve at ")),
        "{reported:?}"
    );
    // A roller of 8 mm fits into the hollow, and one of 95 mm does not.
    assert_eq!(warnings(kidney, "roller (follower.P, rim) = 8mm;"), []);
    let reported = warnings(kidney, "roller (follower.P, rim) = 95mm;");
    assert!(
        reported
            .iter()
            .any(|(_, message)| message.starts_with("the roller does not fit into the curve at ")),
        "{reported:?}"
    );
    // A deltoid has three cusps.
    let reported = warnings(
        "curve rim(s) on cam = (40mm*cos(s) + 20mm*cos(2*s), 40mm*sin(s) - 20mm*sin(2*s));",
        "point_on_curve (follower.P, rim);",
    );
    assert!(
        reported
            .iter()
            .any(|(_, message)| message.starts_with("the curve `rim` stops at s = ")),
        "{reported:?}"
    );
    let reported = warnings(
        "curve rim(a) on cam = polar 20mm;",
        "point_on_curve (follower.P, rim);",
    );
    assert!(
        reported.iter().any(|(_, message)| message
            == "in the design configuration this is 38 mm away from its curve"),
        "{reported:?}"
    );
}

/// The contact parameter is a coordinate like the others in every print, and its sine and cosine are computed once.
#[test]
fn contacts_are_printed_and_written_as_a_person_would() {
    use linkwright_codegen::stages::emit::{Notation, latex, text};
    let path = files::package("descriptions/cam_polar.mech");
    let text = std::fs::read_to_string(path).expect("the description");
    let source = Source::new("cam_polar.mech", text);
    let derived = &linkwright_codegen::read(&source)
        .expect("no errors")
        .motions[0];
    let unicode = text::inspect(derived, Notation::Unicode);
    for line in [
        "q = (x_cam, y_cam, φ_cam, x_follower, y_follower, φ_follower, s_tip)",
        "7 coordinates, 6 equations of joints, 1 equation of drivers, 1 degree of freedom",
        "x_follower − x_cam − cos(φ_cam)·cos(s_tip)·(0.01·cos s_tip + 0.04) + sin(φ_cam)·sin(s_tip)·(0.01·cos s_tip + 0.04)",
    ] {
        assert!(unicode.contains(line), "{line} in {unicode}");
    }
    let typeset = latex::inspect(&[(derived, Vec::new())]);
    assert!(typeset.contains("\\cos s_{\\mathrm{tip}}"), "{typeset}");
    let code = linkwright_codegen::generate(&source, &Options::default())
        .expect("no errors")
        .code()
        .to_string();
    let solved = code
        .split("struct LoopTranslationalGroundFollowerTip")
        .nth(1);
    let solved = solved.and_then(|solved| solved.split("fn verify_path").next());
    let solved = solved.expect("the block of the contact");
    // Once in each of the four functions of Newton-Raphson, and once in the block itself.
    let pairs = solved.matches("let (sin_s_tip, cos_s_tip) = math::sin_cos(");
    assert_eq!(pairs.count(), 5, "{solved}");
    for function in ["math::sin(", "math::cos("] {
        assert!(!solved.contains(function), "{function} in {solved}");
    }
}
