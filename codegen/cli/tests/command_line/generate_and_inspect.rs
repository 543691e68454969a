//! `linkwright generate` and `linkwright inspect` from the outside.

use crate::folder::{EXAM, Folder};

#[test]
fn a_module_is_written_only_if_it_changes() {
    let folder = Folder::new("generate", EXAM);
    let code = folder.run("generate a.mech").exits_with(0).stdout;
    assert!(code.contains("pub fn phi"), "{code}");
    folder
        .run("generate a.mech -o out/two_body.rs --check")
        .exits_with(1);
    assert!(!folder.file("out").exists(), "a check writes nothing");
    folder
        .run("generate a.mech -o out/two_body.rs")
        .exits_with(0);
    assert_eq!(folder.read("out/two_body.rs"), code);
    assert_eq!(
        folder.list("out"),
        ["two_body.rs"],
        "no partial file is left"
    );
    let modified = || {
        std::fs::metadata(folder.file("out/two_body.rs"))
            .and_then(|it| it.modified())
            .expect("it exists")
    };
    let before = modified();
    folder
        .run("generate a.mech -o out/two_body.rs")
        .exits_with(0);
    assert_eq!(modified(), before, "an unchanged file is left alone");
    folder
        .run("generate a.mech -o out/two_body.rs --check")
        .exits_with(0);
    std::fs::write(folder.file("out/two_body.rs"), format!("{code}\n")).expect("it can be written");
    let ran = folder
        .run("generate a.mech -o out/two_body.rs --check")
        .exits_with(1);
    assert!(
        ran.stderr
            .contains("`out/two_body.rs` is not what `a.mech` generates"),
        "{}",
        ran.stderr
    );
    assert_eq!(
        folder.read("out/two_body.rs"),
        format!("{code}\n"),
        "a check writes nothing"
    );
    folder.run("generate a.mech --check").exits_with(2);
}

#[test]
fn nothing_is_generated_from_a_description_with_errors() {
    let folder = Folder::new(
        "errors",
        EXAM.replace("revolute P(1, 2);", "revolute R(1, 2)"),
    );
    let ran = folder.run("generate a.mech -o out.rs").exits_with(2);
    assert!(ran.stderr.contains("--> a.mech:7:"), "{}", ran.stderr);
    assert_eq!(folder.list(""), ["a.mech"]);
    for format in ["text", "unicode", "latex", "rust"] {
        let ran = folder
            .run(&format!("inspect a.mech --format {format}"))
            .exits_with(2);
        assert_eq!(ran.stdout, "");
    }
}

#[test]
fn every_format_shows_the_equations() {
    let folder = Folder::new("inspect", EXAM);
    for (format, texts) in [
        ("text", ["x1 + cos(phi1) - x2 + sqrt(3)*cos(phi2)", "Phi_q"]),
        ("unicode", ["cos", "Φ"]),
        ("latex", ["\\cos", "\\sqrt{3}"]),
        ("rust", ["pub fn phi_q", "pub fn gamma"]),
    ] {
        let ran = folder
            .run(&format!("inspect a.mech --format {format}"))
            .exits_with(0);
        for text in texts {
            assert!(ran.stdout.contains(text), "{text} in {}", ran.stdout);
        }
        assert!(ran.stdout.ends_with('\n'), "{format}");
        assert_eq!(ran.stderr, "");
    }
    let text = folder.run("inspect a.mech").exits_with(0).stdout;
    assert_eq!(
        text,
        folder
            .run("inspect a.mech --format text")
            .exits_with(0)
            .stdout
    );
}
