//! `linkwright equilibrium` from the outside: lists, paths, pictures, and refusals.

use serde_json::Value;

use crate::folder::{Folder, Ran};
use crate::printed::{json, number};

const SWITCH: &str = "mechanism switch {
    units mm, deg;
    param load = 0N;
    point A = (-40mm, 0), B = (40mm, 0);
    body hub at (0, 15mm) { H: (0, 0) }
    absolute_x(hub) = 0;
    absolute_angle(hub) = 0;
    spring left (ground.A, hub.H) = 1N/mm;
    spring right (ground.B, hub.H) = 1N/mm;
    free height: y(hub) = 15mm;
    mass hub = 20g;
    force on hub.H = (0, -load);
    measure pull = tension(left);
    measure rise = hub.H.y;
    limit rise >= 0mm;
}
";

const PENDULUM: &str = "mechanism pendulum {
    input load = 0N;
    point O = (0, 0);
    body bob at O { O, S: (0, -2) }
    revolute O(ground, bob);
    free swing: phi(bob) = 30deg;
    mass bob = 3kg at S;
    gravity = (0, -9.81);
    force on bob.S = (load, 0);
}
";

fn ran(name: &str, text: &str, arguments: &str) -> (Folder, Ran) {
    let folder = Folder::new(&format!("equilibrium_{name}"), text);
    let ran = folder.run(&format!("equilibrium a.mech {arguments}"));
    (folder, ran)
}

fn object(name: &str, text: &str, arguments: &str) -> Value {
    let (_, ran) = ran(name, text, &format!("--json {arguments}"));
    json(&ran.exits_with(0).stdout)
}

/// Load (N) and height (mm) at which the switch snaps.
fn limit() -> [f64; 2] {
    let (half, stiffness) = (40.0_f64, 1.0);
    let relaxed = half.hypot(15.0);
    let length = (relaxed * half * half).cbrt();
    let height = (length * length - half * half).sqrt();
    let load = 2.0 * stiffness * height * (relaxed / length - 1.0);
    [load, height]
}

#[test]
fn a_list_has_values_in_its_units() {
    let list = object("list", SWITCH, "");
    assert_eq!(list["free"][0]["name"], "height");
    assert_eq!(list["free"][0]["unit"], "mm");
    let all = list["equilibria"].as_array().expect("a list");
    let heights: Vec<f64> = all.iter().map(|it| number(&it["free"][0])).collect();
    for (height, expected) in heights.iter().zip([-15.0, 0.0, 15.0]) {
        assert!((height - expected).abs() < 1e-11, "{heights:?}");
    }
    let stability: Vec<&Value> = all.iter().map(|it| &it["stability"]).collect();
    assert_eq!(stability, ["stable", "unstable", "stable"]);
    assert_eq!(list["nearest"], 2);
    assert_eq!(all[0]["broken_limits"][0], "rise");
    assert!(
        all[2]["broken_limits"]
            .as_array()
            .expect("a list")
            .is_empty()
    );
    // The tension of the left spring in the middle: 1 N/mm over 42.72 mm - 40 mm.
    let pull = number(&all[1]["measures"][0]);
    assert!(
        (pull - (40.0 - 40.0_f64.hypot(15.0))).abs() < 1e-12,
        "{pull}"
    );
    assert_eq!(list["path"], Value::Null);
}

#[test]
fn a_path_passes_both_folds() {
    let list = object("folds", SWITCH, "--path load=-1N..2N");
    let path = &list["path"];
    assert_eq!(path["end"], "last");
    let events = path["events"].as_array().expect("a list");
    assert_eq!(events.len(), 2);
    let [load, height] = limit();
    for (event, sign) in events.iter().zip([1.0, -1.0]) {
        assert_eq!(event["kind"], "fold");
        let value = number(&event["value"]);
        assert!((value - sign * load).abs() < 1e-12, "{value} {load}");
        let free = number(&event["free"][0]);
        assert!((free - sign * height).abs() < 1e-5, "{free} {height}");
    }
    assert_eq!(events[0]["before"], "stable");
    assert_eq!(events[0]["behind"], "unstable");
    let rows = path["rows"].as_array().expect("rows");
    assert_eq!(number(&rows[0]["value"]), -1.0);
    assert_eq!(number(&rows[rows.len() - 1]["value"]), 2.0);
    // From the middle position, which the list has as its second one, the path leads to a fold first.
    let list = object("of", SWITCH, "--path load=0N..2N --of 2");
    assert_eq!(list["path"]["of"], 1);
    assert_eq!(list["path"]["events"][0]["before"], "unstable");
    let end = &list["path"]["end"];
    assert!(end == "first" || end == "last", "{end}");
}

#[test]
fn an_input_is_followed_too() {
    let list = object("input", PENDULUM, "--path load=0N..10N");
    let rows = list["path"]["rows"].as_array().expect("rows");
    for row in rows {
        let [load, swing] = [&row["value"], &row["free"][0]].map(number);
        let expected = (load / (3.0 * 9.81)).atan().to_degrees();
        assert!((swing - expected).abs() < 1e-10, "{row}");
    }
    let at_end = number(&rows[rows.len() - 1]["value"]);
    assert_eq!(at_end, 10.0);
}

#[test]
fn a_picture_is_written_and_kept() {
    let arguments = "--path load=-1N..2N --plot drawn";
    let (folder, first) = ran("picture", SWITCH, arguments);
    let first = first.exits_with(0);
    assert!(first.stdout.contains("wrote drawn/equilibrium.svg"));
    let picture = folder.read("drawn/equilibrium.svg");
    assert!(picture.contains("<svg") && picture.contains("load (N)"));
    std::fs::write(folder.file("drawn/equilibrium.svg"), "mine").expect("writable");
    let again = folder.run(&format!("equilibrium a.mech {arguments}"));
    assert!(again.exits_with(2).stderr.contains("--force"));
    assert_eq!(folder.read("drawn/equilibrium.svg"), "mine");
}

#[test]
fn a_mechanism_that_cannot_rest_is_reported() {
    let falling = SWITCH
        .replace("    spring left (ground.A, hub.H) = 1N/mm;\n", "")
        .replace("    spring right (ground.B, hub.H) = 1N/mm;\n", "")
        .replace("    measure pull = tension(left);\n", "");
    let (_, falling_ran) = ran("falling", &falling, "--set load=1N");
    let text = falling_ran.exits_with(1).stdout;
    assert!(text.contains("no equilibrium was found"), "{text}");
    let (_, free_ran) = ran("weightless", &falling, "");
    let text = free_ran.exits_with(0).stdout;
    assert!(text.contains("every pose is in equilibrium"), "{text}");
    let (_, path_ran) = ran("weightless_path", &falling, "--path load=0N..1N");
    let text = path_ran.exits_with(1).stderr;
    assert!(text.contains("nothing to follow over `load`"), "{text}");
    let list = object("weightless_json", &falling, "");
    assert_eq!(list["everywhere"], true);
    assert!(list["equilibria"].as_array().expect("a list").is_empty());
}

#[test]
fn bad_input_is_rejected() {
    let driven = PENDULUM.replace("free swing", "drive swing");
    let (_, refused) = ran("driven", &driven, "");
    let text = refused.exits_with(2).stderr;
    assert!(text.contains("no coordinate of `a.mech` is free"), "{text}");
    assert!(
        text.contains("write `free swing: phi(bob) = START;`"),
        "{text}"
    );
    let cases = [
        (
            "--path swing=0..1",
            "`swing` is free, so forces determine it",
        ),
        ("--path load=0N..1N:3", "without a number of values"),
        ("--path load", "`load` has no range"),
        ("--path load=1N..1N", "is empty"),
        ("--path load=0mm..1mm", "expected a force, found a length"),
        ("--path weight=0..1", "no parameter or input named `weight`"),
        (
            "--path load=0N..1N --of 3",
            "`--of 3` is not in the list of 2 equilibria",
        ),
        ("--of 1", "--path"),
        ("--plot drawn", "--path"),
        ("--starts few", "--starts"),
    ];
    for (place, (arguments, message)) in cases.iter().enumerate() {
        let (_, ran) = ran(&format!("bad_{place}"), PENDULUM, arguments);
        let text = ran.exits_with(2).stderr;
        assert!(text.contains(message), "{arguments}: {text}");
    }
}

#[test]
fn a_mechanism_that_cannot_be_assembled_is_reported() {
    let apart = "mechanism apart {
    point A = (0, 0), D = (5, 0);
    body crank at (0, 0, 40deg) { A: (0, 0), B: (1, 0) }
    body coupler at (1, 1)      { B: (0, 0), C: (1, 0) }
    body rocker at (5, 0)       { D: (0, 0), C: (1, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    free turn: phi(crank) = 40deg;
    mass crank = 1kg at B;
    gravity = (0, -9.81);
}
";
    let (_, ran) = ran("apart", apart, "");
    let text = ran.exits_with(1).stderr;
    assert!(text.contains("cannot be assembled"), "{text}");
}
