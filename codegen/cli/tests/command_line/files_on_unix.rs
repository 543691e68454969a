//! Files on Unix: pipes, links, permissions and signals.

use std::fs;
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::files::refused;
use crate::folder::{EXAM, Folder, Ran};

fn pipe(folder: &Folder, name: &str) {
    let made = Command::new("mkfifo").arg(folder.file(name)).status();
    assert!(made.is_ok_and(|it| it.success()));
}

/// End of a command that must not wait.
fn ends(folder: &Folder, arguments: &str) -> Ran {
    let mut limited = Command::new("timeout");
    limited.arg("20").arg(env!("CARGO_BIN_EXE_linkwright"));
    limited.args(arguments.split_whitespace());
    limited.current_dir(folder.file("."));
    Ran::from(limited.stdin(Stdio::null()).output().expect("it starts"))
}

#[test]
fn a_pipe_is_never_read() {
    let tabled = EXAM
        .replace("pi/6 + sin(2*t)", "way(t)")
        .replace("body 1", "table way = \"pipe\" in (s, rad);\n    body 1");
    let folder = Folder::new("files_pipe", tabled);
    pipe(&folder, "pipe");
    let ran = ends(&folder, "inspect a.mech").exits_with(2);
    let words = "error[K29]: cannot read `pipe`: it is a pipe, not a regular file";
    assert!(ran.stderr.contains(words), "{}", ran.stderr);
    assert!(ran.stderr.contains("a.mech:3:17"), "{}", ran.stderr);
    for path in ["pipe", "/dev/stdin", "/dev/null"] {
        let ran = ends(&folder, &format!("inspect {path}")).exits_with(2);
        let words = format!("cannot read `{path}`: it is a ");
        assert!(ran.stderr.contains(&words), "{}", ran.stderr);
        assert!(ran.stderr.contains("regular file"), "{}", ran.stderr);
    }
    fs::write(folder.file("b.mech"), EXAM).expect("it can be written");
    ends(&folder, "generate b.mech -o pipe --check").exits_with(1);
}

#[test]
fn pipes_and_devices_are_written_to() {
    let folder = Folder::new("files_devices", EXAM);
    folder
        .run("solve a.mech --csv /dev/null --at 1")
        .exits_with(0);
    folder.run("generate a.mech -o /dev/null").exits_with(0);
    let code = folder.run("generate a.mech").exits_with(0).stdout;
    // A pipe under a name of the shell's.
    let ran = folder.run("generate a.mech -o /dev/stdout").exits_with(0);
    assert_eq!(ran.stdout, code);
    pipe(&folder, "pipe");
    let mut reader = Command::new("cat");
    let reader = reader
        .arg(folder.file("pipe"))
        .stdout(Stdio::piped())
        .spawn();
    let reader = reader.expect("it starts");
    folder.run("generate a.mech -o pipe").exits_with(0);
    let read = reader.wait_with_output().expect("it ends");
    assert_eq!(String::from_utf8(read.stdout).expect("UTF-8"), code);
    // A file to which output is redirected must not be replaced during the run.
    let file = fs::File::create(folder.file("out.csv")).expect("it can be made");
    let ran = folder
        .command()
        .args(["solve", "a.mech", "--csv", "out.csv"])
        .stdout(file)
        .output();
    let ran = Ran::from(ran.expect("it starts")).exits_with(2);
    assert!(
        ran.stderr.contains("stdout goes to this file"),
        "{}",
        ran.stderr
    );
}

#[test]
fn links_are_followed_and_stay() {
    let folder = Folder::new("files_links", EXAM);
    fs::create_dir(folder.file("out")).expect("a folder");
    symlink("out/a.rs", folder.file("link.rs")).expect("a link");
    let words = "`link.rs` is a link to `out/a.rs`, which does not exist";
    refused(&folder, "generate a.mech -o link.rs", words);
    folder.run("generate a.mech -o out/a.rs").exits_with(0);
    let code = folder.read("out/a.rs");
    folder
        .run("generate a.mech -o link.rs --scalar f32")
        .exits_with(0);
    assert!(
        fs::symlink_metadata(folder.file("link.rs"))
            .expect("it exists")
            .is_symlink()
    );
    assert_ne!(folder.read("out/a.rs"), code);
    // Two names of one file, and links that go round.
    symlink("out", folder.file("other")).expect("a link");
    let both = "solve a.mech --csv other/P.svg --plot out";
    refused(&folder, both, "another output is written to this file");
    symlink("circle", folder.file("circle")).expect("a link");
    refused(
        &folder,
        "generate a.mech -o circle",
        "cannot write `circle`",
    );
    symlink("nowhere", folder.file("lost")).expect("a link");
    refused(
        &folder,
        "generate a.mech -o lost/x.rs",
        "`lost` is a link to `nowhere`",
    );
    symlink(folder.file("a.mech"), folder.file("out/b.mech")).expect("a link");
    folder
        .run("solve out/b.mech --csv out/b.csv --to 1")
        .exits_with(0);
}

#[test]
fn permissions_are_kept() {
    let folder = Folder::new("files_permissions", EXAM);
    folder.run("generate a.mech -o a.rs").exits_with(0);
    let mode = |path: &Path| fs::metadata(path).expect("it exists").permissions().mode() & 0o777;
    let path = folder.file("a.rs");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o604)).expect("it is ours");
    folder
        .run("generate a.mech -o a.rs --scalar f32")
        .exits_with(0);
    assert_eq!(mode(&path), 0o604);
    // A new file has the permissions that any other has.
    fs::write(folder.file("other"), "").expect("it can be written");
    folder.run("generate a.mech -o b.rs").exits_with(0);
    assert_eq!(mode(&folder.file("b.rs")), mode(&folder.file("other")));
    // The superuser may write anywhere.
    let closed = folder.file("closed");
    fs::create_dir(&closed).expect("a folder");
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o500)).expect("it is ours");
    if fs::write(closed.join("probe"), "").is_err() {
        let words = "cannot create a file in `closed`: permission denied";
        refused(&folder, "generate a.mech -o closed/a.rs", words);
        refused(&folder, "solve a.mech --csv closed/new/a.csv", words);
    }
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o700)).expect("it is ours");
}
