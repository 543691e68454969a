//! New crates, built against the crates of this repository.

use std::path::Path;
use std::process::Command;

use crate::folder::{EXAM, Folder, Ran};

/// Root of the repository.
const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

#[test]
fn a_new_crate_runs_and_is_tested() {
    let folder = Folder::new("new", EXAM);
    let ran = folder
        .run(&format!("new my-walker --path {REPOSITORY}"))
        .exits_with(0);
    assert_eq!(
        ran.stdout,
        "wrote the crate `my-walker` to my-walker\nrun `cargo run` in it, and look at descriptions/four_bar.mech\n"
    );
    // Versions of the repository, so that the network is not needed.
    let lock = Path::new(REPOSITORY).join("Cargo.lock");
    std::fs::copy(lock, folder.file("my-walker/Cargo.lock")).expect("a copy");
    // Folder of all tests that build crates of users: the generator is compiled once.
    let built = Path::new(env!("CARGO_TARGET_TMPDIR")).join("built");
    let cargo = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO"));
        command.args(arguments).args(["--offline", "--quiet"]);
        command.current_dir(folder.file("my-walker"));
        command
            .env("CARGO_TARGET_DIR", &built)
            .env_remove("RUSTFLAGS");
        Ran::from(command.output().expect("cargo starts")).exits_with(0)
    };
    let printed = cargo(&["run"]).stdout;
    assert_eq!(printed.lines().count(), 9, "{printed}");
    assert!(
        printed.starts_with("t = 0.00 s  P = (0.073040, 0.084042) m"),
        "{printed}"
    );
    let tested = cargo(&["test"]).stdout;
    assert!(tested.contains("2 passed; 0 failed"), "{tested}");
    folder
        .run("fmt my-walker/descriptions --check")
        .exits_with(0);
    folder
        .run("check my-walker/descriptions/four_bar.mech")
        .exits_with(0);
}

#[test]
fn a_crate_of_published_packages_names_their_version() {
    let folder = Folder::new("new_published", EXAM);
    folder.run("new walker").exits_with(0);
    let manifest = folder.read("walker/Cargo.toml");
    let version = env!("CARGO_PKG_VERSION");
    assert!(
        manifest.contains(&format!("linkwright = \"{version}\"\n")),
        "{manifest}"
    );
    assert!(
        manifest.contains(&format!("linkwright-codegen = \"{version}\"\n")),
        "{manifest}"
    );
    assert!(!manifest.contains("{{"), "{manifest}");
}

#[test]
fn never_touches_what_exists_and_leaves_nothing_behind() {
    let folder = Folder::new("new_refused", EXAM);
    std::fs::create_dir(folder.file("here")).expect("a folder");
    for (arguments, expected) in [
        ("new here", "cannot write `here`: it exists already"),
        (
            "new a.mech",
            "`a.mech` is not the name of a crate: a name starts with a letter",
        ),
        ("new 7bar", "`7bar` is not the name of a crate"),
        (
            "new fn",
            "`fn` is not the name of a crate: this name has another meaning",
        ),
        ("new none/arm", "its parent folder does not exist"),
        ("new a.mech/arm", "cannot write `a.mech/arm`"),
        (
            "new arm --path here",
            "`here` is not a clone of the repository of Linkwright: it has no `runtime/Cargo.toml`",
        ),
        ("new arm --path none", "the file does not exist"),
    ] {
        let ran = folder.run(arguments).exits_with(2);
        assert!(ran.stderr.contains(expected), "{arguments}: {}", ran.stderr);
    }
    assert_eq!(folder.list("."), ["a.mech", "here"]);
    assert!(folder.list("here").is_empty());
    assert_eq!(folder.read("a.mech"), EXAM);
}
