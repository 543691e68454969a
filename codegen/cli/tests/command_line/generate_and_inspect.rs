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

#[test]
fn latex_lists_redundant_equations() {
    // The angle of body 4 is stated twice; the residual of the repetition is the angle itself.
    let text = "mechanism m {
    body 4 at (0, 0) {}
    absolute_x(4) = 0;
    absolute_y(4) = 0;
    absolute_angle(4) = 0;
    redundant absolute_angle(4) = 0;
}
";
    let folder = Folder::new("redundant_latex", text);
    let ran = folder.run("inspect a.mech --format latex").exits_with(0);
    let listed = "\\subsection*{Redundant equations, monitored but not solved}
\\begin{align*}
  \\varphi_{4} &= 0 && \\text{\\small absolute\\_angle(4)}
\\end{align*}
";
    assert!(ran.stdout.contains(listed), "{}", ran.stdout);
}

#[test]
fn single_precision_is_generated_on_request() {
    let folder = Folder::new("scalar", EXAM);
    let double = folder.run("generate a.mech").exits_with(0).stdout;
    let same = folder.run("generate a.mech --scalar f64").exits_with(0);
    assert_eq!(same.stdout, double);
    assert!(
        double.contains("use ::linkwright::generated::double::*;"),
        "{double}"
    );
    assert!(
        !double.contains("f32") && !double.contains("single"),
        "{double}"
    );
    let single = folder.run("generate a.mech --scalar f32").exits_with(0);
    let code = &single.stdout;
    assert!(
        code.contains("use ::linkwright::generated::single::*;"),
        "{code}"
    );
    assert!(!code.contains("f64") && !code.contains("double"), "{code}");
    // Constants have the digits that this scalar holds.
    assert!(code.contains("    BODY_2_LENGTH = 1.7320508, "), "{code}");
    folder.run("generate a.mech --scalar f16").exits_with(2);
    // A check compares with the module of the same scalar, and says how to write it.
    folder
        .run("generate a.mech --scalar f32 -o a.rs")
        .exits_with(0);
    folder
        .run("generate a.mech --scalar f32 -o a.rs --check")
        .exits_with(0);
    folder.run("generate a.mech -o a.rs --check").exits_with(1);
    folder.run("generate a.mech -o a.rs").exits_with(0);
    let ran = folder
        .run("generate a.mech --scalar f32 -o a.rs --check")
        .exits_with(1);
    assert!(
        ran.stderr
            .contains("run `linkwright generate a.mech -o a.rs --scalar f32`"),
        "{}",
        ran.stderr
    );
}

#[test]
fn inspect_ends_with_what_the_generated_code_solves() {
    const HEADING: &str = "\nwhat the generated code solves\n";
    let folder = Folder::new("solved", EXAM.replace("drive", "output Q;\n    drive"));
    for format in ["text", "unicode"] {
        let ran = folder
            .run(&format!("inspect a.mech --format {format}"))
            .exits_with(0);
        let (equations, solved) = ran.stdout.split_once(HEADING).expect("the heading");
        assert!(!equations.contains("Blocks in solve order"), "{equations}");
        for text in ["  Blocks in solve order: ", "  Position: ", "  In total "] {
            assert!(solved.contains(text), "{text} in {solved}");
        }
    }
    let ran = folder.run("inspect a.mech --format latex").exits_with(0);
    assert!(!ran.stdout.contains("Blocks in solve order"));
    // Without the driver nothing is solved, and the equations are shown all the same.
    let driver = "drive phi(1) = pi/6 + sin(2*t);";
    let folder = Folder::new("undriven", EXAM.replace(driver, ""));
    let ran = folder.run("inspect a.mech").exits_with(0);
    assert!(ran.stdout.contains("revolute P(1, 2)"), "{}", ran.stdout);
    assert!(!ran.stdout.contains(HEADING), "{}", ran.stdout);
}
