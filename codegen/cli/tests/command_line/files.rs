//! Input and output files: files of other programs are kept, and paths that cannot be written are reported first.

use std::fs;

use crate::folder::{EXAM, Folder};

/// File of another program.
pub const NOTES: &str = "# Notes\n\nDo not lose them.\n";

/// Runs a command that must be refused before it has any effect.
#[track_caller]
pub fn refused(folder: &Folder, arguments: &str, words: &str) -> String {
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
                    &format!("cannot write `{path}`: it is `a.mech`, which is an input"),
                );
            }
        }
    }
    assert_eq!(folder.read("a.mech"), EXAM);
    // Neither its tables, nor the file under another name.
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
    let words = "it is `./way.csv`, which is an input";
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
        let message = refused(&folder, command, &format!("and it is not {noun}"));
        assert!(
            message.contains(&format!("cannot write `{path}`")),
            "{message}"
        );
        assert!(message.contains("`--force`"), "{message}");
        assert!(folder.read(path) == NOTES, "{path}");
        // A file of the command is replaced without a message, also by a longer or shorter one.
        folder.run(&format!("{command} --force")).exits_with(0);
        assert!(folder.read(path) != NOTES, "{path}");
        folder.run(command).exits_with(0);
    }
    // Another mechanism with other columns still has frames.
    let table = folder.file("frames.csv");
    folder.run("solve a.mech --csv frames.csv").exits_with(0);
    let longer = EXAM.replace("Q:", "R: (1, 1), Q:");
    fs::write(folder.file("a.mech"), longer).expect("it can be written");
    let command = "solve a.mech --monitor --to 1 --csv frames.csv";
    folder.run(command).exits_with(0);
    // A module is not a table, nor is a table of another program; an empty file is replaced.
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
    // With the line ends of a version control system.
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
fn reports_unwritable_paths_before_the_work() {
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
        ("new/", "this is not the name of a file"),
        ("notes.md/x", "`notes.md` is not a folder"),
        ("notes.md/x/y", "`notes.md` is not a folder"),
        ("new/../x", "`new/..` does not exist"),
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
        "cannot write `out/P.svg`: another output is written",
    );
    refused(
        &folder,
        "solve a.mech --csv two_body",
        "cannot be both a file and the folder of this output",
    );
    refused(
        &folder,
        "solve a.mech --csv new --plot new/plots",
        "cannot be both a file",
    );
    assert_eq!(folder.read("notes.md"), NOTES);
    assert!(folder.list("out").is_empty());
    // Files written by default can be written elsewhere.
    fs::write(folder.file("two_body"), NOTES).expect("it can be written");
    let message = refused(&folder, "solve a.mech", "`two_body` is not a folder");
    assert!(message.contains("help: `--out DIR` writes"), "{message}");
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
fn a_file_is_named_as_what_it_is() {
    let folder = Folder::new("files_extensions", EXAM);
    for (command, words) in [
        (
            "draw a.mech --out a.dwg",
            "pictures cannot be written as `.dwg`",
        ),
        (
            "draw a.mech --out a.b.pdf",
            "pictures cannot be written as `.pdf`",
        ),
        (
            "draw a.mech --png --out a.jpg",
            "pictures cannot be written as `.jpg`",
        ),
        ("draw a.mech --png --out a.svg", "`--png` draws a PNG"),
        (
            "view a.mech --out a.pdf",
            "pages cannot be written as `.pdf`",
        ),
        (
            "generate a.mech -o a.c",
            "modules cannot be written as `.c`",
        ),
        (
            "generate a.mech -o a.py",
            "modules cannot be written as `.py`",
        ),
        (
            "generate a.mech -o a.c --check",
            "modules cannot be written as `.c`",
        ),
    ] {
        let message = refused(&folder, command, words);
        let known = match command.split(' ').next() {
            Some("draw") => ["svg", "png"],
            Some("view") => ["html", "htm"],
            _ => ["rs", "lang c"],
        };
        let (_, help) = message.split_once("help: ").expect("what can be written");
        let named = known.iter().filter(|it| help.contains(**it)).count();
        assert_eq!(
            named,
            if words.starts_with("`--png`") { 1 } else { 2 },
            "{message}"
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
