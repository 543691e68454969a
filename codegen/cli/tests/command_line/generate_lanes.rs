//! `linkwright generate --lanes` from the outside.

use crate::folder::{EXAM, Folder};

#[test]
fn a_module_solves_eight_mechanisms_as_well() {
    let folder = Folder::new("lanes", EXAM);
    let alone = folder.run("generate a.mech").exits_with(0).stdout;
    let both = folder.run("generate a.mech --lanes 8").exits_with(0).stdout;
    // The module of one mechanism stays as it is.
    let added = both.strip_prefix(alone.trim_end()).expect("it begins so");
    assert!(added.contains("pub mod lanes {"), "{added}");
    assert!(added.contains("failed |= "), "{added}");
    let single = "generate a.mech --lanes 16 --scalar f32";
    folder.run(single).exits_with(0);
    folder.run(&format!("{single} -o a.rs")).exits_with(0);
    folder
        .run(&format!("{single} -o a.rs --check"))
        .exits_with(0);
    let ran = folder.run("generate a.mech -o a.rs --lanes 8 --check");
    let ran = ran.exits_with(1);
    let help = "run `linkwright generate a.mech -o a.rs --lanes 8`";
    assert!(ran.stderr.contains(help), "{}", ran.stderr);
}

#[test]
fn lanes_of_c_leave_everything_else_as_it_is() {
    let folder = Folder::new("c_lanes", EXAM);
    let files = ["a.c", "a.h", "linkwright.c", "linkwright.h"];
    let written = |arguments: &str| {
        folder.run(arguments).exits_with(0);
        files.map(|name| std::fs::read_to_string(folder.file(name)).expect("written"))
    };
    let alone = written("generate --lang c a.mech -o a.c");
    let both = written("generate --lang c a.mech -o a.c --lanes 8");
    for (alone, both) in alone.iter().zip(&both) {
        // Lines are added in one order.
        let mut lines = both.lines();
        assert!(alone.lines().all(|line| lines.any(|it| it == line)));
    }
    assert_eq!(alone[2..], both[2..]);
    assert!(both[0].contains("    failed |= "), "{}", both[0]);
    assert!(both[1].contains("_LANES 8\n"), "{}", both[1]);
    let check = "generate --lang c a.mech -o a.c --lanes 8 --check";
    folder.run(check).exits_with(0);
    let ran = folder.run("generate --lang c a.mech -o a.c --check");
    ran.exits_with(1);
}

#[test]
fn lanes_that_do_not_exist_are_refused() {
    let folder = Folder::new("no_lanes", EXAM);
    for (arguments, expected) in [
        (
            "generate a.mech --lanes 4",
            "error: f64 has 8 lanes, found `--lanes 4`\n  = help: write `--lanes 8`",
        ),
        (
            "generate a.mech --lanes 8 --scalar f32",
            "error: f32 has 16 lanes, found `--lanes 8`\n  = help: write `--lanes 16`",
        ),
    ] {
        let ran = folder.run(arguments).exits_with(2);
        assert!(ran.stderr.contains(expected), "{arguments}: {}", ran.stderr);
        assert!(ran.stdout.is_empty());
    }
}

#[test]
fn a_block_without_a_closed_form_is_named() {
    let platform = include_str!("../../../../mechanisms/platform_3rpr.mech");
    let folder = Folder::new("iterated_lanes", platform);
    for (language, file) in [("rust", "a.rs"), ("c", "a.c")] {
        let arguments = format!("generate a.mech --lang {language} --lanes 8 -o {file}");
        let ran = folder.run(&arguments).exits_with(2);
        let expected = "has no lanes: Newton-Raphson solves it, one mechanism at a time";
        assert!(ran.stderr.contains("error[K40]: `loop_"), "{}", ran.stderr);
        assert!(ran.stderr.contains(expected), "{}", ran.stderr);
        assert!(!folder.file(file).exists());
    }
}
