//! What is read and what is written: nothing is lost that the command did not write, and what cannot be written is said first.

use std::fs;
use std::path::Path;

use crate::folder::{EXAM, Folder};

/// What somebody else has written.
const NOTES: &str = "# Notes\n\nDo not lose them.\n";

/// Runs a command that must be refused before it does anything.
#[track_caller]
fn refused(folder: &Folder, arguments: &str, words: &str) -> String {
    let before = folder.list("");
    let ran = folder.run(arguments).exits_with(2);
    assert!(ran.stderr.contains(words), "{arguments}: {}", ran.stderr);
    assert_eq!(ran.stdout, "", "{arguments}: it is noticed before the work");
    assert_eq!(folder.list(""), before, "{arguments}");
    ran.stderr
}

#[test]
fn a_description_is_never_replaced() {
    let folder = Folder::new("files_own", EXAM);
    fs::create_dir(folder.file("sub")).expect("a folder");
    for path in ["a.mech", "./a.mech", "sub/../a.mech", "sub/.././/a.mech"] {
        for force in ["", " --force"] {
            for command in ["generate a.mech -o", "solve a.mech --csv"] {
                refused(
                    &folder,
                    &format!("{command} {path}{force}"),
                    &format!("cannot write `{path}`: it is `a.mech`, which is read"),
                );
            }
        }
    }
    assert_eq!(folder.read("a.mech"), EXAM);
    // Nor under another name, nor are its tables.
    let tabled = EXAM
        .replace("pi/6 + sin(2*t)", "way(t)")
        .replace("body 1", "table way = \"way.csv\" in (s, rad);\n    body 1");
    let folder = Folder::new("files_tables", &tabled);
    let points = "0, 0\n1, 0.2\n9, 1\n";
    fs::write(folder.file("way.csv"), points).expect("a table");
    fs::hard_link(folder.file("a.mech"), folder.file("b.mech")).expect("another name");
    refused(
        &folder,
        "solve a.mech --force --csv b.mech",
        "it is `a.mech`",
    );
    let words = "it is `./way.csv`, which is read";
    refused(&folder, "solve a.mech --force --csv way.csv", words);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("a.mech", folder.file("link")).expect("a link");
        refused(&folder, "generate a.mech --force -o link", "it is `a.mech`");
        refused(&folder, "generate link --force -o a.mech", "it is `link`");
    }
    assert_eq!(folder.read("way.csv"), points);
    assert_eq!(folder.read("b.mech"), tabled);
}

#[test]
fn only_what_the_command_wrote_is_replaced_unless_forced() {
    let folder = Folder::new("files_foreign", EXAM);
    fs::create_dir(folder.file("plots")).expect("a folder");
    for (command, path, noun) in [
        (
            "generate a.mech -o notes.rs",
            "notes.rs",
            "a generated module",
        ),
        (
            "solve a.mech --csv notes.md",
            "notes.md",
            "a table of frames",
        ),
        ("solve a.mech --plot plots", "plots/P.svg", "a picture"),
        (
            "check a.mech --plot plots",
            "plots/assemblies.svg",
            "a picture",
        ),
    ] {
        fs::write(folder.file(path), NOTES).expect("it can be written");
        let said = refused(&folder, command, &format!("and it is not {noun}"));
        assert!(said.contains(&format!("cannot write `{path}`")), "{said}");
        assert!(said.contains("`--force`"), "{said}");
        assert!(folder.read(path) == NOTES, "{path}");
        // What was written once is replaced without a word, also by what is longer or shorter.
        folder.run(&format!("{command} --force")).exits_with(0);
        assert!(folder.read(path) != NOTES, "{path}");
        folder.run(command).exits_with(0);
    }
    // Another mechanism, other columns: frames all the same.
    let table = folder.file("frames.csv");
    folder.run("solve a.mech --csv frames.csv").exits_with(0);
    let longer = EXAM.replace("Q:", "R: (1, 1), Q:");
    fs::write(folder.file("a.mech"), longer).expect("it can be written");
    let command = "solve a.mech --monitor --to 1 --csv frames.csv";
    folder.run(command).exits_with(0);
    // A module is no table, a table of somebody else neither, and an empty file is nothing.
    folder.run("generate a.mech -o a.rs").exits_with(0);
    refused(&folder, "solve a.mech --csv a.rs", "not a table of frames");
    refused(
        &folder,
        "generate a.mech -o frames.csv",
        "not a generated module",
    );
    for (text, is_ours) in [("t,x1,y1\n0,0,0\n", false), ("", true)] {
        fs::write(&table, text).expect("it can be written");
        let ran = folder.run("solve a.mech --csv frames.csv");
        ran.exits_with(if is_ours { 0 } else { 2 });
    }
    // As it comes out of a version control system.
    let module = folder.read("a.rs").replace('\n', "\r\n");
    fs::write(folder.file("a.rs"), module).expect("it can be written");
    folder.run("generate a.mech -o a.rs").exits_with(0);
}

#[test]
fn solving_again_needs_nothing() {
    let folder = Folder::new("files_again", EXAM);
    for arguments in [
        "solve a.mech",
        "solve a.mech",
        "solve a.mech --points Q --monitor",
        "solve a.mech --set x=1",
        "check a.mech --plot two_body",
        "check a.mech --plot two_body",
    ] {
        let ran = folder.run(arguments);
        let code = if arguments.contains("--set") { 2 } else { 0 };
        ran.exits_with(code);
    }
    let names = folder.list("two_body");
    assert_eq!(
        names,
        [
            "P.svg",
            "Q.svg",
            "assemblies.svg",
            "motion.csv",
            "motion.csv.source",
            "paths.svg"
        ]
    );
}

#[test]
fn what_cannot_be_written_is_noticed_before_the_work() {
    let folder = Folder::new("files_first", EXAM);
    fs::create_dir(folder.file("out")).expect("a folder");
    fs::write(folder.file("notes.md"), NOTES).expect("it can be written");
    fs::write(folder.file("kept.rs"), "").expect("it can be written");
    let mut permissions = fs::metadata(folder.file("kept.rs"))
        .expect("it exists")
        .permissions();
    permissions.set_readonly(true);
    fs::set_permissions(folder.file("kept.rs"), permissions).expect("it is ours");
    let long = "x".repeat(300);
    for (path, reason) in [
        ("out", "it is a folder"),
        (".", "it is a folder"),
        ("new/", "this names no file"),
        ("notes.md/x", "`notes.md` is not a folder"),
        ("notes.md/x/y", "`notes.md` is not a folder"),
        ("new/../x", "there is no `new/..`"),
        ("kept.rs", "the file is write-protected"),
        (&long, "cannot write `xxx"),
    ] {
        refused(&folder, &format!("generate a.mech -o {path}"), reason);
        refused(&folder, &format!("solve a.mech --csv {path}"), reason);
        assert!(!folder.file("two_body").exists());
    }
    refused(
        &folder,
        "solve a.mech --plot notes.md",
        "`notes.md` is not a folder",
    );
    refused(
        &folder,
        "check a.mech --plot notes.md/x",
        "`notes.md` is not a folder",
    );
    refused(&folder, "solve a.mech --plot -", "`--plot` takes a folder");
    refused(&folder, "check a.mech --plot -", "`--plot` takes a folder");
    let both = "solve a.mech --csv out/P.svg --plot out";
    refused(
        &folder,
        both,
        "cannot write `out/P.svg`: something else is to be written",
    );
    refused(
        &folder,
        "solve a.mech --csv two_body",
        "is to be a file, and this to lie in it",
    );
    refused(
        &folder,
        "solve a.mech --csv new --plot new/plots",
        "is to be a file",
    );
    assert_eq!(folder.read("notes.md"), NOTES);
    assert!(folder.list("out").is_empty());
    // What is written unasked can be written elsewhere.
    fs::write(folder.file("two_body"), NOTES).expect("it can be written");
    let said = refused(&folder, "solve a.mech", "`two_body` is not a folder");
    assert!(said.contains("help: `--out DIR` writes"), "{said}");
    folder.run("solve a.mech --csv - --plot out").exits_with(0);
}

#[test]
fn a_module_goes_to_stdout_by_name_too() {
    let folder = Folder::new("files_dash", EXAM);
    let code = folder.run("generate a.mech").exits_with(0).stdout;
    assert_eq!(
        folder.run("generate a.mech -o -").exits_with(0).stdout,
        code
    );
    refused(&folder, "generate a.mech -o - --check", "`-` is stdout");
    refused(
        &folder,
        "generate a.mech -o x --check --force",
        "cannot be used with",
    );
    assert_eq!(folder.list(""), ["a.mech"]);
}

#[test]
fn a_description_is_a_regular_file() {
    let folder = Folder::new("files_read", EXAM);
    fs::create_dir_all(folder.file("empty/x.mech")).expect("a folder");
    for command in ["solve", "generate", "inspect", "plan", "check"] {
        let said = refused(
            &folder,
            &format!("{command} ."),
            "cannot read `.`: it is a folder",
        );
        assert!(
            said.contains("help: name a description in it, such as `./a.mech`"),
            "{said}"
        );
        refused(
            &folder,
            &format!("{command} empty/x.mech"),
            "help: name a description, a `.mech` file",
        );
        refused(
            &folder,
            &format!("{command} none.mech"),
            "error: cannot read `none.mech`: there is no such file\n",
        );
    }
    let large = format!("{EXAM}{}", " ".repeat(5 << 20));
    for (name, text, words) in [
        ("nothing.mech", b"".as_slice(), "error[K06]"),
        ("blank.mech", b" \n", "error[K06]"),
        ("mark.mech", b"\xef\xbb\xbf", "error[K06]"),
        (
            "large.mech",
            large.as_bytes(),
            "error[K00]: the file is larger than 4 MiB",
        ),
        (
            "latin.mech",
            b"// \xe9\n",
            "error[K00]: the file is not UTF-8 text",
        ),
        (
            "wide.mech",
            b"\xff\xfem\0e\0c\0h\0",
            "the file is not UTF-8 text",
        ),
        ("zero.mech", b"\0\0\0\0", "error[K01]"),
    ] {
        fs::write(folder.file(name), text).expect("it can be written");
        refused(&folder, &format!("inspect {name}"), words);
    }
    // A file may begin with a byte order mark and end its lines as Windows does.
    let plain = folder.run("inspect a.mech").exits_with(0).stdout;
    for text in [
        format!("\u{feff}{EXAM}"),
        EXAM.replace('\n', "\r\n"),
        format!("\u{feff}{}", EXAM.replace('\n', "\r\n")),
    ] {
        fs::write(folder.file("b.mech"), text).expect("it can be written");
        assert_eq!(folder.run("inspect b.mech").exits_with(0).stdout, plain);
    }
}

#[test]
fn outputs_of_another_description_are_not_replaced() {
    let folder = Folder::new("files_sources", EXAM);
    let other = EXAM.replace("2*t", "t");
    fs::create_dir(folder.file("sub")).expect("a folder");
    fs::write(folder.file("sub/b--c.mech"), &other).expect("it can be written");
    // By default both are called after the mechanism.
    for (command, path, record) in [
        (
            "solve",
            "two_body/motion.csv",
            "Generated by linkwright from ../a.mech.\n",
        ),
        (
            "draw",
            "two_body.svg",
            "<!-- Generated by linkwright from a.mech. -->\n",
        ),
        (
            "view",
            "two_body.html",
            "<meta name=\"linkwright-source\" content=\"a.mech\">",
        ),
    ] {
        folder.run(&format!("{command} a.mech")).exits_with(0);
        let file = match command {
            "solve" => format!("{path}.source"),
            _ => path.to_string(),
        };
        assert!(
            folder.read(&file).contains(record),
            "{}",
            folder.read(&file)
        );
        let made = folder.read(path);
        let ran = folder
            .run(&format!("{command} sub/b--c.mech"))
            .exits_with(2);
        let words = format!(
            "cannot write `{path}`: it was made from `a.mech`, not from `sub/b--c.mech`\n  = help: "
        );
        assert!(ran.stderr.contains(&words), "{}", ran.stderr);
        assert_eq!(folder.read(path), made, "{path}");
        assert_eq!(ran.stdout, "", "it is noticed before anything is written");
        // Again from the same one, also under another spelling, and the other one by force.
        folder
            .run(&format!("{command} ./sub/../a.mech"))
            .exits_with(0);
        assert_eq!(folder.read(path), made, "{path}");
        folder
            .run(&format!("{command} sub/b--c.mech --force"))
            .exits_with(0);
        assert_ne!(folder.read(path), made, "{path}");
        let said = refused(&folder, &format!("{command} a.mech"), "it was made from");
        assert!(
            said.contains("from `sub/b--c.mech`, not from `a.mech`"),
            "{said}"
        );
    }
    // The way from one to the other is what counts, not where both lie.
    let moved = Folder::new("files_sources_moved", &other);
    fs::create_dir(moved.file("two_body")).expect("a folder");
    for name in ["motion.csv", "motion.csv.source"] {
        let text = folder.read(&format!("two_body/{name}"));
        let text = text.replace("sub/b-%2Dc.mech", "a.mech");
        fs::write(moved.file(&format!("two_body/{name}")), text).expect("a copy");
    }
    moved.run("solve a.mech").exits_with(0);
    // A record without a table says nothing, and a table without a record is one of ours.
    folder
        .run("solve a.mech --no-files --csv one.csv")
        .exits_with(0);
    fs::remove_file(folder.file("one.csv")).expect("it is there");
    folder
        .run("solve sub/b--c.mech --no-files --csv one.csv")
        .exits_with(0);
    refused(
        &folder,
        "solve a.mech --no-files --csv one.csv",
        "it was made from",
    );
    fs::remove_file(folder.file("one.csv.source")).expect("it is there");
    folder
        .run("solve a.mech --no-files --csv one.csv")
        .exits_with(0);
    // What somebody else has written beside a table is theirs.
    fs::write(folder.file("two.csv.source"), NOTES).expect("it can be written");
    refused(
        &folder,
        "solve a.mech --no-files --csv two.csv",
        "cannot write `two.csv.source`: there is a file already",
    );
    // Pictures of checks and comparisons have sources, too.
    folder.run("check a.mech --plot plots").exits_with(0);
    refused(
        &folder,
        "check sub/b--c.mech --plot plots",
        "it was made from",
    );
}

#[test]
fn a_file_is_named_as_what_it_is() {
    let folder = Folder::new("files_extensions", EXAM);
    for (command, words) in [
        (
            "draw a.mech --out a.dxf",
            "no drawing can be written as `.dxf`",
        ),
        (
            "draw a.mech --out a.b.pdf",
            "no drawing can be written as `.pdf`",
        ),
        (
            "draw a.mech --png --out a.jpg",
            "no drawing can be written as `.jpg`",
        ),
        ("draw a.mech --png --out a.svg", "`--png` draws a PNG"),
        (
            "view a.mech --out a.pdf",
            "no page can be written as `.pdf`",
        ),
        ("generate a.mech -o a.c", "no module can be written as `.c`"),
        (
            "generate a.mech -o a.py",
            "no module can be written as `.py`",
        ),
        (
            "generate a.mech -o a.c --check",
            "no module can be written as `.c`",
        ),
    ] {
        let said = refused(&folder, command, words);
        let known = match command.split(' ').next() {
            Some("draw") => ["svg", "png"],
            Some("view") => ["html", "htm"],
            _ => ["rs", "lang c"],
        };
        let (_, help) = said.split_once("help: ").expect("what can be written");
        let named = known.iter().filter(|it| help.contains(**it)).count();
        assert_eq!(
            named,
            if words.starts_with("`--png`") { 1 } else { 2 },
            "{said}"
        );
    }
    for command in [
        "draw a.mech --out picture",
        "draw a.mech --out A.SVG",
        "view a.mech --out page",
        "view a.mech --out a.HTM",
        "generate a.mech -o module",
    ] {
        folder.run(command).exits_with(0);
    }
}

#[test]
fn the_next_run_removes_what_a_kill_has_left() {
    let folder = Folder::new("files_killed", EXAM);
    let left = || {
        let name = ".linkwright-4194999-0.partial";
        fs::create_dir_all(folder.file("two_body")).expect("a folder");
        for path in [name.to_string(), format!("two_body/{name}")] {
            fs::write(folder.file(&path), "half of it").expect("it can be written");
        }
        let inside = folder.file(&format!("{name}.folder/src"));
        fs::create_dir_all(inside).expect("a folder");
    };
    let loose = EXAM.replace("    body", "  body");
    for (number, command) in [
        "solve a.mech --csv a.csv",
        "draw a.mech",
        "view a.mech",
        "generate a.mech -o a.rs",
        "new walker",
        "fmt a.mech",
    ]
    .iter()
    .enumerate()
    {
        if command.starts_with("fmt") {
            fs::write(folder.file("a.mech"), &loose).expect("it can be written");
        }
        left();
        folder.run(command).exits_with(0);
        let names = folder.list(".");
        let is_left = names.iter().any(|it| it.contains("partial"));
        assert!(!is_left, "{command}: {names:?}");
        let names = folder.list("two_body");
        let is_left = names.iter().any(|it| it.contains("partial"));
        // The folder into which `solve` draws as well.
        assert_eq!(is_left, number > 0, "{command}: {names:?}");
    }
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    use std::process::{Command, Stdio};

    use super::*;
    use crate::folder::Ran;

    fn pipe(folder: &Folder, name: &str) {
        let made = Command::new("mkfifo").arg(folder.file(name)).status();
        assert!(made.is_ok_and(|it| it.success()));
    }

    /// The end of a command that must not wait for anybody.
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
        let words = "error[K29]: cannot read `pipe`: it is a pipe, no regular file";
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
        // What is redirected to a file is not to be replaced under way.
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
        refused(
            &folder,
            both,
            "something else is to be written to this file",
        );
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
        let mode =
            |path: &Path| fs::metadata(path).expect("it exists").permissions().mode() & 0o777;
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
            let words = "no file can be made in `closed`: there is no permission";
            refused(&folder, "generate a.mech -o closed/a.rs", words);
            refused(&folder, "solve a.mech --csv closed/new/a.csv", words);
        }
        fs::set_permissions(&closed, fs::Permissions::from_mode(0o700)).expect("it is ours");
    }
}
