//! `linkwright sweep -o FILE.parquet` from the outside. What the files hold is read back beside their writer.

use std::fs;

use crate::folder::Folder;
use crate::sweep::LIFT;

const SETS: &str = "sweep a.mech --vary L3=50mm..150mm:5 --to 1 --step 0.1 --show phi_rocker";

#[test]
fn the_ending_chooses_the_format() {
    let folder = Folder::new("sweep_parquet", LIFT);
    let csv = folder.run(&format!("{SETS} -o a.csv")).exits_with(0);
    let ran = folder.run(&format!("{SETS} -o a.Parquet")).exits_with(0);
    assert_eq!(ran.stdout, csv.stdout.replace("a.csv", "a.Parquet"));
    let text = folder.read("a.csv");
    assert!(text.starts_with("set,L3 (mm),") && text.lines().count() == 6);
    let bytes = fs::read(folder.file("a.Parquet")).expect("the table");
    assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
    let units = br#"{"L3":"mm","phi_rocker_min":"rad","phi_rocker_min_t":"s""#;
    assert!(bytes.windows(units.len()).any(|it| it == units));
    let names = [
        "a.Parquet",
        "a.Parquet.source",
        "a.csv",
        "a.csv.source",
        "a.mech",
    ];
    assert_eq!(folder.list("."), names);
    // A table of this command is replaced, and nothing else.
    folder.run(&format!("{SETS} -o a.Parquet")).exits_with(0);
    assert_eq!(
        fs::read(folder.file("a.Parquet")).expect("the table"),
        bytes
    );
    fs::write(folder.file("b.parquet"), b"PAR1 of another program").expect("written");
    let ran = folder.run(&format!("{SETS} -o b.parquet")).exits_with(2);
    let words =
        "a file exists already, and it is not a table of sets that this command has written";
    assert!(ran.stderr.contains(words), "{}", ran.stderr);
}

#[test]
fn a_file_that_cannot_be_continued_is_refused() {
    let folder = Folder::new("sweep_parquet_refused", LIFT);
    for (options, words) in [
        (
            "-o a.parquet --resume",
            "`--resume` cannot continue `a.parquet`, a Parquet file\n  = help: leave out `--resume`, or write a table that can be continued: `-o a.csv`",
        ),
        (
            "-o a.pq",
            "cannot write `a.pq`: expected the ending `.csv` or `.parquet`",
        ),
        ("-o -", "cannot write `-`: expected the ending"),
        ("-o a.parquet --csv a.csv", "cannot be used with"),
    ] {
        let ran = folder.run(&format!("{SETS} {options}")).exits_with(2);
        assert!(ran.stderr.contains(words), "{options}: {}", ran.stderr);
        assert_eq!(folder.list("."), ["a.mech"]);
    }
    // What an interrupted run has left is not lost by chance.
    fs::write(folder.file("a.parquet.part"), b"PAR1").expect("written");
    let ran = folder.run(&format!("{SETS} -o a.parquet")).exits_with(2);
    let words = "an interrupted run has left `a.parquet.part`\n  = help: it is a Parquet file of its first sets, which cannot be continued: rename it, or replace it with `--force`";
    assert!(ran.stderr.contains(words), "{}", ran.stderr);
    assert_eq!(folder.read("a.parquet.part"), "PAR1");
    folder
        .run(&format!("{SETS} -o a.parquet --force"))
        .exits_with(0);
    assert_eq!(
        folder.list("."),
        ["a.mech", "a.parquet", "a.parquet.source"]
    );
}
