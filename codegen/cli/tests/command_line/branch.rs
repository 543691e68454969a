//! `linkwright solve --branch` from the outside.

use crate::folder::Folder;
use crate::printed::{json, number};

/// The exam's mechanism: a rod of length √3 from the crank's pin to a line.
const EXAM: &str = "mechanism exam {
    body 1 at (0, 0, 30deg) { P: (1, 0) }
    body 2 at (1.7, 2, 1) { P: (-sqrt(3), 0), Q: (-sqrt(3)/2, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    revolute P(1, 2);
    absolute_x(2) = sqrt(3);
    drive phi(1) = pi/6;
}
";

const PLATFORM: &str = include_str!("../../../../mechanisms/platform_3rpr.mech");

/// Numbers of the only row in the output.
fn row(folder: &Folder, options: &str) -> Vec<f64> {
    let ran = folder.run(&format!("solve a.mech --at 0 --csv - {options}"));
    let printed = ran.exits_with(0).stdout;
    let row = printed.lines().last().expect("a row");
    let numbers = row.split(',').map(|value| value.parse().expect("a number"));
    numbers.collect()
}

fn coincide(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|(one, other)| (one - other).abs() < 1e-9)
}

#[test]
fn the_rod_hangs_below_on_the_other_branch() {
    let folder = Folder::new("branch", EXAM);
    let above = row(&folder, "--points Q");
    let below = row(&folder, "--points Q --branch phi2=other");
    // φ2 = ±π/3, and the middle of the rod is half of its sine from the pin, which is at the height 1/2.
    let root = 3.0_f64.sqrt();
    assert!((above[19] - 0.75 * root).abs() < 1e-14 && (above[20] - 1.25).abs() < 1e-14);
    assert!((below[19] - 0.75 * root).abs() < 1e-14 && (below[20] + 0.25).abs() < 1e-14);
    let signs = ["positive", "negative"]
        .map(|sign| row(&folder, &format!("--points Q --branch phi2={sign}")));
    assert!(signs.iter().any(|row| coincide(row, &above)));
    assert!(signs.iter().any(|row| coincide(row, &below)));
}

#[test]
fn a_loop_without_a_closed_form_has_branches_too() {
    let folder = Folder::new("branch_newton", PLATFORM);
    let drawn = row(&folder, "");
    let mut count = 0;
    for sign in ["positive", "negative"] {
        count += i32::from(coincide(
            &row(&folder, &format!("--branch loop_p_row_q_r={sign}")),
            &drawn,
        ));
    }
    assert_eq!(count, 1, "one of the signs is that of the drawing");
    let other = row(&folder, "--branch loop_p_row_q_r=other");
    assert!(!coincide(&other, &drawn));
}

#[test]
fn every_pose_of_a_loop_without_a_closed_form_has_a_letter() {
    let folder = Folder::new("branch_letters", PLATFORM);
    let ran = folder.run("check a.mech --json").exits_with(0);
    let checked = json(&ran.stdout);
    let assemblies = checked["assemblies"].as_array().expect("a list");
    assert!(assemblies.len() > 1);
    for (letter, place) in ('a'..='z').zip(0..assemblies.len()) {
        let mut listed = assemblies.iter();
        let assembly = listed.find(|it| it["poses"] == serde_json::json!([place]));
        let q = assembly.expect("one of this letter")["q"].as_array();
        let q: Vec<f64> = q.expect("a list").iter().map(number).collect();
        let solved_row = row(&folder, &format!("--branch loop_p_row_q_r={letter}"));
        assert!(
            coincide(&solved_row[1..=q.len()], &q),
            "{letter}: {solved_row:?}"
        );
    }
    let ran = folder.run("solve a.mech --at 0 --branch loop_p_row_q_r=z");
    let expected = format!(
        "`loop_p_row_q_r` has {} poses at t = 0 s, none of them `z`; a check lists them",
        assemblies.len()
    );
    let error = ran.exits_with(2).stderr;
    assert!(error.contains(&expected), "{error}");
}

/// A bar that is drawn with its end far from the circle on which a distance holds it.
const HELD: &str = "mechanism held {
    point D = (1.2, 0.4);
    body 5 at (0.5, 0.3, 0.3) { U: (0.6, 0) }
    absolute_x(5) = 0.5;
    absolute_y(5) = 0.3;
    absolute_distance (5.U, D) = 0.7;
}
";

#[test]
fn a_poor_drawing_is_assembled_in_its_own_mode() {
    let folder = Folder::new("branch_poor", HELD);
    let pose = row(&folder, "");
    // U lies on the circle about D, at 0.6 from (0.5, 0.3), on the side of the line to D where it is drawn: below it.
    let (sine, cosine) = pose[3].sin_cos();
    let [x, y] = [0.5 + 0.6 * cosine, 0.3 + 0.6 * sine];
    assert!(((x - 1.2).hypot(y - 0.4) - 0.7).abs() < 1e-14);
    let side = |x: f64, y: f64| (0.7 * (y - 0.3) - 0.1 * (x - 0.5)).signum();
    let drawn = [0.5 + 0.6 * 0.3_f64.cos(), 0.3 + 0.6 * 0.3_f64.sin()];
    assert_eq!(side(x, y), side(drawn[0], drawn[1]));
    assert!((pose[3] - 0.3).abs() < std::f64::consts::PI, "{}", pose[3]);
}

#[test]
fn wrong_names_of_loops_and_modes_are_corrected() {
    let folder = Folder::new("branch_names", EXAM);
    for (wish, said) in [
        ("phi_2=other", "did you mean `phi2`?"),
        ("z=other", "the loops with several modes are: phi2"),
        ("phi2=postive", "did you mean `positive`?"),
        ("phi2=up", "the modes are: positive, negative, other"),
        ("phi2=a", "`phi2` has a closed form, whose modes are"),
        ("phi2", "is not of the form LOOP=positive"),
    ] {
        let ran = folder.run(&format!("solve a.mech --at 0 --branch {wish}"));
        let error = ran.exits_with(2).stderr;
        assert!(error.contains(said), "{wish}: {error}");
    }
    let ran = folder.run("solve a.mech --at 0 --branch phi2=other --branch phi2=positive");
    assert!(ran.exits_with(2).stderr.contains("is chosen twice"));
}

#[test]
fn a_rod_that_no_longer_reaches_ends_the_motion_at_its_time() {
    let folder = Folder::new("branch_end", EXAM.replace("= pi/6;", "= pi/6 + t;"));
    let ran = folder.run("solve a.mech --to 3 --csv -");
    let error = ran.exits_with(1).stderr;
    // φ1 = π/2 at t = π/3 = 1.0471975511966.
    let end = error.split("beyond t = ").nth(1).expect("a time");
    let end: f64 = end
        .split(' ')
        .next()
        .expect("a number")
        .parse()
        .expect("a number");
    assert!(
        (end - std::f64::consts::FRAC_PI_3).abs() <= 1.5e-9,
        "{error}"
    );
    assert!(
        error.contains("revolute P(1, 2): out of reach by ")
            && error.contains("the line from P to the origin of body 2 is parallel to the x axis"),
        "{error}"
    );
}
