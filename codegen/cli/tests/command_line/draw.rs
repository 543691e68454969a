//! `draw`: pictures, their files, and what cannot be drawn.

use std::fs;

use super::folder::{EXAM, Folder, driven_by};

#[test]
fn a_drawing_goes_where_it_is_asked_for() {
    let folder = Folder::new("draw_files", EXAM);
    let ran = folder.run("draw a.mech").exits_with(0);
    assert_eq!(
        (ran.stdout.as_str(), ran.stderr.as_str()),
        ("wrote two_body.svg\n", "")
    );
    let svg = folder.read("two_body.svg");
    for part in [
        "id=\"body-1\"",
        "id=\"body-2\"",
        "id=\"joint-p\"",
        "two_body, t = 0 s",
    ] {
        assert!(svg.contains(part), "{part} in {svg}");
    }
    folder.run("draw a.mech --out b/c.svg").exits_with(0);
    let drawn = |svg: &str| svg.split_once('\n').expect("two lines").1.to_string();
    assert_eq!(drawn(&folder.read("b/c.svg")), drawn(&svg));
    let printed = folder.run("draw a.mech --out -").exits_with(0).stdout;
    assert_eq!(drawn(&printed), drawn(&svg));
    // The same instant followed from elsewhere.
    folder.run("draw a.mech --at 0.5 --out d.svg").exits_with(0);
    assert_ne!(drawn(&folder.read("d.svg")), drawn(&svg));
    let other = folder
        .run("draw a.mech --branch phi2=other --out -")
        .exits_with(0);
    assert_ne!(drawn(&other.stdout), drawn(&svg));
}

/// A body without points has no shape; the message names the missing points as the description would.
#[test]
fn points_that_are_missing_are_said() {
    let text = "mechanism bare {
    body 1 at (0, 0);
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = t;
}
";
    let folder = Folder::new("draw_shapeless", text);
    let ran = folder.run("draw a.mech").exits_with(0);
    let help = "name points in the braces of a body: `body 1 at (0, 0) { A: (0, 0), B: (0.1, 0) }`";
    assert!(
        ran.stderr.contains("warning: body `1` has no points"),
        "{}",
        ran.stderr
    );
    assert!(ran.stderr.contains(help), "{}", ran.stderr);
    let ran = folder.run("solve a.mech --points K").exits_with(2);
    assert!(ran.stderr.contains(help), "{}", ran.stderr);
    let drawn = Folder::new("draw_shaped", EXAM);
    assert!(drawn.run("draw a.mech").exits_with(0).stderr.is_empty());
}

#[test]
fn only_pictures_of_ours_are_replaced() {
    let folder = Folder::new("draw_replaced", EXAM);
    replaces_its_own(&folder, "a.svg");
    folder.run("draw a.mech --out a.mech --force").exits_with(2);
}

/// Checks that `draw` replaces a picture `file` of its own, and another file only by force.
pub fn replaces_its_own(folder: &Folder, file: &str) {
    let draw = format!("draw a.mech --out {file}");
    fs::write(folder.file(file), "something else\n").expect("a file");
    let ran = folder.run(&draw).exits_with(2);
    assert!(ran.stderr.contains("it is not a picture"), "{}", ran.stderr);
    folder.run(&format!("{draw} --force")).exits_with(0);
    let drawn = fs::read(folder.file(file)).expect("a picture");
    folder.run(&draw).exits_with(0);
    assert_eq!(fs::read(folder.file(file)).expect("a picture"), drawn);
}

#[test]
fn paths_and_frames_are_drawn_on_request() {
    let folder = Folder::new("draw_paths", EXAM);
    let svg = folder
        .run("draw a.mech --paths Q --to 2 --frame 2,ground --out -")
        .exits_with(0)
        .stdout;
    for part in [
        "id=\"path-Q-below\"",
        "id=\"frame-2\"",
        "id=\"frame-ground\"",
        "t = 0 s, ticks every 0.1 s",
    ] {
        assert!(svg.contains(part), "{part} in {svg}");
    }
    // One tick at the start and one every tenth of a second.
    assert_eq!(svg.matches("class=\"tick\"").count(), 21);
    for (wrong, words) in [
        ("--paths Z", "no point `Z`"),
        ("--frame 3", "no body `3`"),
        ("--size 5", "write width and height"),
        ("--size 5x5", "between 100 and 10000"),
        ("--branch phi2=up", "no assembly mode"),
    ] {
        let ran = folder.run(&format!("draw a.mech {wrong}")).exits_with(2);
        assert!(ran.stderr.contains(words), "{wrong}: {}", ran.stderr);
    }
    assert_eq!(folder.list("."), ["a.mech"]);
}

#[test]
fn a_motion_that_ends_early_is_said_and_drawn_as_far_as_it_goes() {
    // The rod cannot follow beyond a quarter turn and more.
    let folder = Folder::new("draw_ends", driven_by("t"));
    let ran = folder.run("draw a.mech --at 4").exits_with(1);
    assert!(ran.stderr.contains("error: `two_body`"), "{}", ran.stderr);
    assert!(!folder.file("two_body.svg").exists());
    let ran = folder.run("draw a.mech --paths Q").exits_with(1);
    assert!(ran.stderr.contains("error: `two_body`"), "{}", ran.stderr);
    assert!(folder.read("two_body.svg").contains("path-Q"));
}

#[test]
fn a_mechanism_that_is_not_determined_is_drawn_as_written() {
    let folder = Folder::new(
        "draw_written",
        EXAM.replace("drive phi(1) = pi/6 + sin(2*t);", ""),
    );
    folder.run("draw a.mech").exits_with(2);
    let svg = folder
        .run("draw a.mech --initial-estimate --out -")
        .exits_with(0)
        .stdout;
    assert!(svg.contains("id=\"body-2\""), "{svg}");
}
