//! Files and tables that `linkwright solve` writes.

use crate::folder::{EXAM, Folder};
use crate::printed::{json, number};

#[test]
fn files_go_where_they_are_wanted_and_are_never_half_written() {
    let folder = Folder::new("files", EXAM);
    let ran = folder
        .run("solve a.mech --points Q --to 1 --csv new/folder/q.csv --plot plots")
        .exits_with(0);
    assert!(
        ran.stdout.contains("wrote new/folder/q.csv\n"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout.contains("wrote plots/*.svg (Q, paths)\n"),
        "{}",
        ran.stdout
    );
    assert!(!ran.stdout.contains("\nP:"), "{}", ran.stdout);
    assert_eq!(
        folder.list("new/folder"),
        ["q.csv", "q.csv.source"],
        "no partial file is left"
    );
    assert_eq!(folder.list("plots"), ["Q.svg", "paths.svg"]);
    assert!(!folder.file("two_body").exists());
    // Numbers in the file are exact.
    let table = folder.read("new/folder/q.csv");
    let ran = folder.run("solve a.mech --json --to 1").exits_with(0);
    let frame = &json(&ran.stdout)["frames"][73];
    let line = table.lines().nth(74).expect("a line per frame");
    let values: Vec<f64> = line
        .split(',')
        .map(|it| it.parse().expect("a number"))
        .collect();
    assert_eq!(values.len(), 1 + 18 + 6);
    assert_eq!(values[0], number(&frame["t"]));
    assert_eq!(values[6], number(&frame["q"][5]));
    assert_eq!(values[18], number(&frame["qdd"][5]));
    assert_eq!(values[24], number(&frame["points"]["Q"]["acceleration"][1]));
    // A folder stands where the file should go: the file is named, and nothing is lost.
    let ran = folder.run("solve a.mech --csv plots").exits_with(2);
    assert!(
        ran.stderr.contains("cannot write `plots`"),
        "{}",
        ran.stderr
    );
    assert_eq!(folder.list("plots"), ["Q.svg", "paths.svg"]);
    let ran = folder.run("solve a.mech --csv a.mech/x.csv").exits_with(2);
    assert!(
        ran.stderr.contains("cannot write `a.mech/x.csv`"),
        "{}",
        ran.stderr
    );
    assert_eq!(folder.read("a.mech"), EXAM);
}

#[test]
fn csv_on_stdout_stands_alone() {
    let folder = Folder::new("stdout", EXAM);
    let ran = folder
        .run("solve a.mech --csv - --to 1 --plot plots")
        .exits_with(0);
    assert_eq!(ran.stdout.lines().count(), 102);
    let width = ran
        .stdout
        .lines()
        .next()
        .map(|line| line.split(',').count());
    assert_eq!(width, Some(1 + 18 + 12));
    assert!(
        ran.stdout
            .lines()
            .all(|line| Some(line.split(',').count()) == width)
    );
    assert!(ran.stderr.starts_with("two_body\n"), "{}", ran.stderr);
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early_is_no_error() {
    use std::io::Read;
    use std::process::Stdio;
    let folder = Folder::new("pipe", EXAM);
    for format in ["--json", "--csv=-"] {
        let mut child = folder
            .command()
            .args([
                "solve", "a.mech", "--step", "0.001", format, "--plot", "plots",
            ])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let mut byte = [0];
        let mut output = child.stdout.take().expect("stdout is piped");
        output.read_exact(&mut byte).expect("there is output");
        drop(output);
        let ran =
            crate::folder::Ran::from(child.wait_with_output().expect("it ends")).exits_with(0);
        assert!(
            !ran.stderr.contains("error") && !ran.stderr.contains("panicked"),
            "{}",
            ran.stderr
        );
        assert_eq!(
            folder.list("plots"),
            ["P.svg", "Q.svg", "paths.svg"],
            "files are written all the same"
        );
    }
}

#[test]
fn the_same_twice() {
    let folder = Folder::new("twice", EXAM);
    let run = || {
        let ran = folder.run("solve a.mech").exits_with(0);
        let read = |name: &str| folder.read(&format!("two_body/{name}"));
        (ran.stdout, read("motion.csv"), read("P.svg"))
    };
    assert!(run() == run());
}

#[test]
fn tables_have_units_on_request_and_are_known_again() {
    let folder = Folder::new("units", EXAM);
    for _ in 0..2 {
        folder.run("solve a.mech --units --out o").exits_with(0);
    }
    let table = folder.read("o/motion.csv");
    assert!(
        table.starts_with("t (s),x1 (m),y1 (m),phi1 (rad),"),
        "{table:.80}"
    );
    assert!(table.contains("\n0.01,"), "numbers in their shortest form");
    let ran = folder.run("solve a.mech --json --at 0").exits_with(0);
    let units = &json(&ran.stdout)["units"];
    assert_eq!(units["qd"][2], "rad/s");
    assert_eq!(units["acceleration"], "m/s²");
}

#[test]
fn files_go_below_target_only_beside_a_manifest() {
    let folder = Folder::new("manifest", EXAM);
    std::fs::write(folder.file("Cargo.toml"), "").expect("it can be written");
    folder.run("solve a.mech --to 0.1").exits_with(0);
    assert!(
        folder
            .file("target/linkwright/two_body/motion.csv")
            .exists()
    );
    assert!(!folder.file("two_body").exists());
}

#[cfg(unix)]
#[test]
fn a_large_table_is_announced_before_the_work() {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;
    let folder = Folder::new("large", EXAM);
    let mut child = folder
        .command()
        .args(["solve", "a.mech", "--to", "5", "--step", "1e-6"])
        .args(["--points", "Q", "--csv", "/dev/null"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut lines = BufReader::new(child.stderr.take().expect("stderr is piped")).lines();
    let notice = lines.next().expect("a line").expect("a text");
    child.kill().expect("it is still at work");
    child.wait().expect("it ends");
    // Five million frames of 25 columns.
    assert_eq!(notice, "warning: `/dev/null` will take about 2.5 GB");
}
