//! `linkwright sweep --branch`: sets in other assembly modes.

use crate::folder::Folder;
use crate::sweep::{LIFT, Table, table};

const PLATFORM: &str = include_str!("../../../../mechanisms/platform_3rpr.mech");

#[test]
fn closed_forms_have_the_signs_of_solve() {
    let folder = Folder::new("sweep_branch", LIFT);
    let motion = "--to 0.5 --step 0.1";
    let other = "--branch phi_coupler_phi_rocker=other";
    let sets = format!("--vary L3=110mm..130mm:3 --instants {motion} --show phi_rocker,C_vy");
    let (drawn, rows) = (
        table(&folder, &sets),
        table(&folder, &format!("{sets} {other}")),
    );
    for (place, length) in ["110mm", "120mm", "130mm"].into_iter().enumerate() {
        let solve = format!("solve a.mech --set L3={length} {motion} {other} --csv - --no-files");
        let solved = Table::of(&folder.run(&solve).exits_with(0).stdout);
        for (own, name) in [("phi_rocker (rad)", "phi_rocker"), ("C_vy (m/s)", "C_vy")] {
            let first = 6 * place;
            let cells = &rows.column(own)[first..first + 6];
            let expected = solved.column(name);
            // `solve` assembles again near the pose that it has found, which rounds the first angles otherwise.
            assert_eq!(cells[1..], expected[1..], "{own}, {length}");
            let [found, expected] =
                [cells, &expected].map(|it| it[0].parse::<f64>().expect("a number"));
            assert!(
                (found - expected).abs() < 1e-15,
                "{own}, {length}: {found} {expected}"
            );
            let others = &drawn.column(own)[first..first + 6];
            assert!(cells.iter().zip(others).all(|(cell, other)| cell != other));
        }
    }
    // The mirror image in the line from B to D has the rocker below.
    let below = rows.numbers("phi_rocker (rad)");
    assert!(below.iter().all(|it| it.sin() < 0.0), "{below:?}");
}

/// Signs of closed forms need no assembly of the description's own values.
#[test]
fn sets_are_assembled_although_the_description_is_not() {
    let folder = Folder::new(
        "sweep_branch_open",
        LIFT.replace("L3 = 120mm", "L3 = 130mm"),
    );
    let options = "--set L4=30mm --vary L3=50mm..130mm:3 --to 0 --show phi_rocker";
    let branch = "--branch phi_coupler_phi_rocker=negative";
    let solved = table(&folder, &format!("{options} {branch}"));
    assert_eq!(solved.column("failure"), ["", "", "out of reach"]);
}

/// At the start the parameter has no effect, so that the poses of all sets are those of the description.
#[test]
fn a_loop_without_a_closed_form_starts_from_a_pose() {
    let text = PLATFORM.replace("0.08*sin(t)", "reach*sin(t)");
    let text = text.replace("    point A =", "    param reach = 80mm;\n    point A =");
    let folder = Folder::new("sweep_branch_poses", text);
    let motion = "--to 0.2 --step 0.1";
    let sets = format!("--vary reach=70mm..90mm:3 --instants {motion} --show phi_platform");
    let mut angles = Vec::new();
    for letter in ["a", "b"] {
        let branch = format!("--branch loop_p_row_q_r={letter}");
        let rows = table(&folder, &format!("{sets} {branch}"));
        for (place, reach) in ["70mm", "80mm", "90mm"].into_iter().enumerate() {
            let set = format!("--set reach={reach} {branch}");
            let solve = format!("solve a.mech {set} {motion} --csv - --no-files");
            let solved = Table::of(&folder.run(&solve).exits_with(0).stdout);
            let cells = &rows.column("phi_platform (rad)")[3 * place..3 * (place + 1)];
            assert_eq!(cells, solved.column("phi_platform"), "{letter} {reach}");
        }
        angles.push(rows.numbers("phi_platform (rad)"));
    }
    let pairs = angles[0].iter().zip(&angles[1]);
    assert!(pairs.clone().count() == 9);
    assert!(
        pairs.into_iter().all(|(a, b)| (a - b).abs() > 0.1),
        "{angles:?}"
    );
}

#[test]
fn a_wrong_selection_has_a_reason() {
    let folder = Folder::new("sweep_branch_bad", LIFT);
    for (branch, said) in [
        ("phi_rocker=other", "no loop is named `phi_rocker`"),
        (
            "phi_coupler_phi_rocker=up",
            "no assembly mode is named `up`",
        ),
    ] {
        let line = format!("sweep a.mech --vary L3=110mm..130mm:3 --branch {branch}");
        let ran = folder.run(&line).exits_with(2);
        assert!(ran.stderr.contains(said), "{branch}: {}", ran.stderr);
        assert_eq!(folder.list("."), ["a.mech"]);
    }
}
