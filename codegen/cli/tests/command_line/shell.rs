//! Version, help, completions and manual pages.

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

#[test]
fn every_command_has_a_manual_page() {
    let folder = Folder::new("man", EXAM);
    let help = folder.run("--help").exits_with(0).stdout;
    let listed = help.lines().skip_while(|it| *it != "Commands:").skip(1);
    let listed = listed.take_while(|it| !it.is_empty());
    let mut expected: Vec<String> = listed
        .filter_map(|line| line.split_whitespace().next())
        .filter(|it| *it != "help")
        .map(|name| format!("linkwright-{name}.1"))
        .collect();
    expected.push("linkwright.1".to_string());
    expected.sort();
    let ran = folder.run("man --out pages").exits_with(0);
    assert_eq!(
        ran.stdout,
        format!("wrote {} pages to pages\n", expected.len())
    );
    assert_eq!(folder.list("pages"), expected);
    let page = folder.read("pages/linkwright-generate.1");
    for part in [".TH linkwright-generate 1", "\\-\\-check", "two_body.rs"] {
        assert!(page.contains(part), "{part}");
    }
    // Its own pages are replaced, and no other file is.
    folder.run("man --out pages").exits_with(0);
    std::fs::write(folder.file("pages/linkwright.1"), "mine").expect("written");
    folder.run("man --out pages").exits_with(2);
    assert_eq!(folder.read("pages/linkwright.1"), "mine");
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
