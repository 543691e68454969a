//! Version, help and completions.

use crate::folder::{EXAM, Folder};

#[test]
fn the_version_names_the_commit_of_a_clone() {
    let folder = Folder::new("version", EXAM);
    let printed = folder.run("--version").exits_with(0).stdout;
    let version = concat!("linkwright ", env!("CARGO_PKG_VERSION"));
    let rest = printed
        .strip_prefix(version)
        .and_then(|it| it.strip_suffix('\n'));
    let rest = rest.unwrap_or_else(|| panic!("{printed}"));
    let commit = rest.strip_prefix(" (").and_then(|it| it.strip_suffix(')'));
    let is_commit = |it: &str| it.len() >= 12 && it.bytes().all(|it| it.is_ascii_hexdigit());
    assert!(
        rest.is_empty() || commit.is_some_and(is_commit),
        "{printed}"
    );
    let is_clone = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../.git")
        .exists();
    assert_eq!(commit.is_some(), is_clone, "{printed}");
}

#[test]
fn every_shell_completes_every_command() {
    let folder = Folder::new("completions", EXAM);
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = folder
            .run(&format!("completions {shell}"))
            .exits_with(0)
            .stdout;
        for command in ["solve", "generate", "fmt", "new", "deny-warnings"] {
            assert!(
                script.contains(command),
                "{shell} does not complete {command}"
            );
        }
    }
    folder.run("completions tcl").exits_with(2);
}

/// Lines of help that are not examples fit in a terminal of the usual width.
#[test]
fn help_is_wrapped() {
    let folder = Folder::new("help", EXAM);
    for command in ["solve", "draw", "check", "fmt"] {
        let help = folder
            .run(&format!("{command} --help"))
            .exits_with(0)
            .stdout;
        let (options, _) = help.split_once("\nExamples:").expect("examples");
        let widest = options.lines().map(|it| it.chars().count()).max();
        assert!(widest <= Some(100), "{command}: {widest:?}");
    }
}
