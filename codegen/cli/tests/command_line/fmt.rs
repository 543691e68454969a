//! Formatting in files, in folders and on stdout, and descriptions from stdin.

use std::io::Write as _;
use std::process::Stdio;

use crate::folder::{EXAM, Folder, Ran};

/// Description with another layout.
const LOOSE: &str = "// Kept.\nmechanism m {\nbody 1 at(0,0);   // kept\n\n\n  absolute_x (1)=0;absolute_y(1) = 0;\ndrive phi(1)=t;\n}\n";

/// That description, formatted.
const FORMATTED: &str = "// Kept.\nmechanism m {\n    body 1 at (0, 0); // kept\n\n    absolute_x(1) = 0;\n    absolute_y(1) = 0;\n    drive phi(1) = t;\n}\n";

/// Runs the command with a text on stdin.
fn fed(folder: &Folder, arguments: &str, text: &str) -> Ran {
    let mut child = folder
        .command()
        .args(arguments.split_whitespace())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    // The output shows a command that does not read.
    let _ = stdin.write_all(text.as_bytes());
    drop(stdin);
    Ran::from(child.wait_with_output().expect("the command ends"))
}

#[test]
fn a_file_is_formatted_once() {
    let folder = Folder::new("fmt_file", LOOSE);
    let ran = folder.run("fmt a.mech --check").exits_with(1);
    assert_eq!(
        ran.stderr,
        "error: `a.mech` is not formatted\n  = help: run `linkwright fmt a.mech`\n"
    );
    assert_eq!(folder.read("a.mech"), LOOSE);
    let ran = folder.run("fmt a.mech").exits_with(0);
    assert_eq!((ran.stdout, ran.stderr), (String::new(), String::new()));
    assert_eq!(folder.read("a.mech"), FORMATTED);
    let modified = || {
        let metadata = std::fs::metadata(folder.file("a.mech"));
        metadata.and_then(|it| it.modified()).expect("a file")
    };
    let before = modified();
    folder.run("fmt a.mech").exits_with(0);
    assert_eq!(modified(), before, "a formatted file is not touched");
    folder.run("fmt a.mech --check").exits_with(0);
}

#[test]
fn a_folder_is_formatted_and_what_is_wrong_is_left_alone() {
    let folder = Folder::new("fmt_folder", LOOSE);
    std::fs::write(folder.file("b.mech"), "mechanism m {\n body 1 at ;\n}\n").expect("written");
    std::fs::write(folder.file("c.mech"), LOOSE).expect("written");
    std::fs::write(folder.file("d.txt"), LOOSE).expect("written");
    let ran = folder.run("fmt .").exits_with(2);
    assert!(ran.stderr.contains("b.mech:2:12"), "{}", ran.stderr);
    assert_eq!(folder.read("a.mech"), FORMATTED);
    assert_eq!(folder.read("b.mech"), "mechanism m {\n body 1 at ;\n}\n");
    assert_eq!(folder.read("c.mech"), FORMATTED);
    assert_eq!(folder.read("d.txt"), LOOSE);
    std::fs::create_dir(folder.file("none")).expect("a folder");
    let ran = folder.run("fmt none").exits_with(2);
    assert_eq!(
        ran.stderr,
        "error: the folder `none` holds no `.mech` file\n"
    );
    folder.run("fmt").exits_with(2);
}

#[test]
fn stdin_is_formatted_to_stdout() {
    let folder = Folder::new("fmt_stdin", LOOSE);
    let ran = fed(&folder, "fmt -", LOOSE).exits_with(0);
    assert_eq!((ran.stdout.as_str(), ran.stderr.as_str()), (FORMATTED, ""));
    let ran = fed(&folder, "fmt - --check", LOOSE).exits_with(1);
    assert_eq!(ran.stdout, "");
    assert_eq!(ran.stderr, "error: `<stdin>` is not formatted\n");
    let ran = fed(&folder, "fmt -", "mechanism m {").exits_with(2);
    assert_eq!(ran.stdout, "");
    assert!(ran.stderr.contains("--> <stdin>:1:14"), "{}", ran.stderr);
}

/// Every command that reads a description prints equal output for a file and for stdin.
#[test]
fn every_command_reads_stdin() {
    let folder = Folder::new("stdin", EXAM);
    for command in [
        "solve FILE --no-files",
        "inspect FILE",
        "plan FILE",
        "check FILE",
        "generate FILE",
        "draw FILE --out -",
        "view FILE --out -",
        "fmt FILE --check",
    ] {
        let file = folder.run(&command.replace("FILE", "a.mech"));
        let stdin = fed(&folder, &command.replace("FILE", "-"), EXAM);
        assert_eq!(stdin.code, file.code, "{command}");
        assert_eq!(stdin.stdout, file.stdout, "{command}");
        let named = stdin.stderr.replace("<stdin>", "a.mech");
        assert_eq!(
            named.lines().next(),
            file.stderr.lines().next(),
            "{command}"
        );
    }
    let ran = fed(&folder, "view - --watch", EXAM).exits_with(2);
    assert_eq!(
        ran.stderr,
        "error: `--watch` follows a file, and `-` is stdin\n"
    );
}

#[test]
fn the_tables_of_stdin_lie_in_the_current_folder() {
    let folder = Folder::new("stdin_table", EXAM);
    let text = EXAM.replace("pi/6 + sin(2*t)", "law(t)").replace(
        "    body 1",
        "    table law = \"law.csv\" in (s, rad);\n    body 1",
    );
    std::fs::write(folder.file("law.csv"), "0,0.5\n1,0.6\n2,0.5\n").expect("written");
    fed(&folder, "inspect -", &text).exits_with(0);
    std::fs::remove_file(folder.file("law.csv")).expect("it was there");
    let ran = fed(&folder, "inspect -", &text).exits_with(2);
    assert!(ran.stderr.contains("law.csv"), "{}", ran.stderr);
}

#[test]
fn errors_have_no_colors_but_on_a_terminal() {
    let folder = Folder::new("colors", "mechanism m {");
    let mut command = folder.command();
    command.args(["inspect", "a.mech"]).env("TERM", "xterm");
    let ran = Ran::from(command.output().expect("the command starts")).exits_with(2);
    assert!(ran.stderr.starts_with("error[") && !ran.stderr.contains('\u{1b}'));
}

#[test]
fn a_file_that_is_write_protected_stays_as_it_is() {
    let loose = EXAM.replace("    body", "  body");
    let folder = Folder::new("fmt_protected", &loose);
    let path = folder.file("a.mech");
    let protect = |is_readonly| {
        let mut permissions = std::fs::metadata(&path).expect("it exists").permissions();
        permissions.set_readonly(is_readonly);
        std::fs::set_permissions(&path, permissions).expect("it is ours");
    };
    protect(true);
    let ran = folder.run("fmt a.mech").exits_with(2);
    let words = "error: cannot write `a.mech`: the file is write-protected";
    assert!(ran.stderr.contains(words), "{}", ran.stderr);
    assert_eq!(folder.read("a.mech"), loose);
    // A formatted file is not written.
    folder.run("fmt a.mech --check").exits_with(1);
    protect(false);
    folder.run("fmt a.mech").exits_with(0);
    protect(true);
    folder.run("fmt a.mech").exits_with(0);
    protect(false);
}
