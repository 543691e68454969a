//! Features that a build leaves out: each use is refused before anything is read or written.

use crate::folder::{EXAM, Folder};

/// Checks that each command is refused in the words of `error`, and that the help names the feature.
fn refuses(feature: &str, error: &str, commands: &[&str]) {
    let folder = Folder::new(&format!("left_out_{feature}"), EXAM);
    for command in commands {
        let ran = folder.run(command).exits_with(2);
        let (first, help) = ran.stderr.split_once('\n').expect("two lines");
        let expected = format!("error: this `linkwright` was built without `{feature}`, {error}");
        assert_eq!(first, expected, "{command}");
        let start = format!("  = help: install it with the feature `{feature}`: `cargo install ");
        assert!(help.starts_with(&start), "{command}: {help}");
        let listed = help.trim_end().trim_end_matches('`').rsplit(' ').next();
        let mut listed = listed.expect("a list of features").split(',');
        assert!(listed.any(|it| it == feature), "{command}: {help}");
        assert_eq!(ran.stdout, "", "{command}");
        assert_eq!(folder.list("."), ["a.mech"], "{command}");
    }
}

#[cfg(not(feature = "png"))]
#[test]
fn a_png_is_refused() {
    let commands = [
        "draw a.mech --png",
        "draw a.mech --out a.png",
        "draw a.mech --out A.PNG",
        "draw a.mech --png --out -",
        "draw a.mech --animate --out a.gif",
        "draw missing.mech --png",
    ];
    refuses("png", "which draws pictures in pixels", &commands);
}

#[cfg(not(feature = "png"))]
#[test]
fn an_svg_is_drawn_without_png() {
    let folder = Folder::new("left_out_svg", EXAM);
    folder.run("draw a.mech").exits_with(0);
    assert_eq!(folder.list("."), ["a.mech", "two_body.svg"]);
}

#[cfg(not(feature = "lsp"))]
#[test]
fn a_language_server_is_refused() {
    refuses("lsp", "which serves editors", &["lsp", "lsp --stdio"]);
}

#[cfg(not(feature = "calibrate"))]
#[test]
fn a_fit_is_refused() {
    let commands = [
        "calibrate a.mech missing.csv --param L",
        "calibrate missing.mech missing.csv --param L --out new.mech --json",
    ];
    refuses("calibrate", "which fits parameters", &commands);
}

#[cfg(not(feature = "parquet"))]
#[test]
fn a_parquet_file_is_refused() {
    let commands = [
        "sweep a.mech --vary L=1..2:3 -o a.parquet",
        "sweep missing.mech --vary L=1..2:3 --output A.PARQUET --resume",
    ];
    refuses("parquet", "which writes Parquet files", &commands);
}

#[cfg(not(feature = "man"))]
#[test]
fn manual_pages_are_refused() {
    refuses("man", "which writes manual pages", &["man --out pages"]);
}
