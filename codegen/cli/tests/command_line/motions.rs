//! Commands on a mechanism with several motions.

use crate::folder::Folder;

const CRANK: &str = "mechanism crank {
    body 1 at (0, 0) { P: (1, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    motion turn { drive phi(1) = t; }
    motion swing { drive phi(1) = sin(t); }
}
";

#[test]
fn inspect_shows_every_motion_under_its_name_or_one() {
    let folder = Folder::new("motions_inspect", CRANK);
    let all = folder.run("inspect a.mech").exits_with(0).stdout;
    let [turn, swing] = ["turn", "swing"].map(|name| {
        let ran = folder.run(&format!("inspect a.mech --motion {name}"));
        ran.exits_with(0).stdout
    });
    assert_eq!(all, format!("{turn}\n{swing}"));
    assert!(
        swing.starts_with("mechanism crank, motion swing: 1 body,"),
        "{swing}"
    );
    assert!(
        swing.contains("phi1 - sin(t)") && !swing.contains("phi1 - t"),
        "{swing}"
    );
    let latex = folder
        .run("inspect a.mech --format latex")
        .exits_with(0)
        .stdout;
    let title = "\\section*{Mechanism crank, motion";
    assert_eq!(latex.matches(title).count(), 2);
    assert_eq!(latex.matches("\\documentclass").count(), 1);
    let rust = folder
        .run("inspect a.mech --format rust")
        .exits_with(0)
        .stdout;
    assert_eq!(rust, folder.run("generate a.mech").exits_with(0).stdout);
    let refused = folder.run("inspect a.mech --format rust --motion turn");
    assert!(
        refused
            .exits_with(2)
            .stderr
            .contains("leave out `--motion`")
    );
}

#[test]
fn solve_and_plan_want_the_name_of_one_motion() {
    let folder = Folder::new("motions_solve", CRANK);
    for command in ["solve", "plan"] {
        let ran = folder.run(&format!("{command} a.mech")).exits_with(2);
        assert_eq!(ran.stdout, "");
        assert_eq!(
            ran.stderr,
            "error: `a.mech` has 2 motions: `turn`, `swing`\n  = help: name one of them, for example `--motion turn`\n"
        );
        let ran = folder.run(&format!("{command} a.mech --motion swin"));
        assert!(ran.exits_with(2).stderr.contains("did you mean `swing`?"));
    }
    let ran = folder
        .run("solve a.mech --motion swing --to 0.1")
        .exits_with(0);
    assert!(
        ran.stdout.starts_with("crank, motion swing\n"),
        "{}",
        ran.stdout
    );
    assert!(folder.read("crank/swing/motion.csv").contains("phi1"));
    let ran = folder
        .run("solve a.mech --motion turn --at 1 --json")
        .exits_with(0);
    assert!(
        ran.stdout
            .starts_with("{\"mechanism\":\"crank\",\"motion\":\"turn\","),
        "{}",
        ran.stdout
    );
    let plan = folder.run("plan a.mech --motion turn").exits_with(0).stdout;
    assert!(plan.contains("crank, motion turn"), "{plan}");
}

#[test]
fn a_mechanism_without_motions_takes_no_name_of_one() {
    let text = CRANK.replace("motion turn {", "").replace("= t; }", "= t;");
    let text = text.replace("    motion swing { drive phi(1) = sin(t); }\n", "");
    let folder = Folder::new("motions_none", text);
    folder.run("solve a.mech --at 1").exits_with(0);
    let ran = folder
        .run("solve a.mech --at 1 --motion turn")
        .exits_with(2);
    assert!(ran.stderr.contains("has no motions"), "{}", ran.stderr);
}
