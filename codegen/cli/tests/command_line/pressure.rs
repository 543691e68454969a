//! The pressure angle that `linkwright solve` reports.

use crate::folder::Folder;
use crate::printed::json;

/// A disc of radius 30 mm, 10 mm off its axle, under a roller of 8 mm: sin α is at most 10/38, when the disc has turned by a
/// quarter from its highest place.
const CAM: &str = "mechanism cam {
    point O = (0, 0), P = (0, 48mm);
    body disc at O turned 90deg { O }
    body follower at P { P }
    curve rim(s) on disc = (10mm + 30mm*cos(s), 30mm*sin(s));
    revolute O(ground, disc);
    translational (ground, follower) along O -> P;
    roller wheel(follower.P, rim) = 8mm;
    drive phi(disc) = pi/2 + pi/2*t;
}
";

#[test]
fn the_largest_pressure_angle_is_printed() {
    let folder = Folder::new("pressure", CAM);
    let printed = folder.run("solve a.mech --to 2").exits_with(0).stdout;
    let text = "\nlargest pressure angles\n  roller wheel(follower.P, rim)  15.26° at t = 1 s\n";
    assert!(printed.contains(text), "{printed}");
    let ran = folder.run("solve a.mech --to 2 --json").exits_with(0);
    let object = json(&ran.stdout);
    let pressure = &object["pressure_angles"][0];
    assert_eq!(pressure["joint"], "roller wheel(follower.P, rim)");
    assert_eq!(pressure["t"], 1.0);
    let angle = pressure["angle"].as_f64().expect("a number");
    assert!((angle.sin() - 10.0 / 38.0).abs() < 1e-14, "{angle}");
}

#[test]
fn a_follower_at_rest_has_no_pressure_angle() {
    let folder = Folder::new("pressure_at_rest", CAM.replace("pi/2*t", "0*t"));
    let printed = folder.run("solve a.mech --to 0.1").exits_with(0).stdout;
    assert!(
        printed.contains("rim)  none, the follower rests\n"),
        "{printed}"
    );
}
