//! `linkwright sweep --resume`: a table is the same after an interruption at any place.

use std::fs;
use std::process::Command;

use crate::folder::{Folder, Ran};
use crate::sweep::LIFT;

/// Runs a sweep until its file has as many bytes as a limit of the system allows.
fn interrupted(folder: &Folder, options: &str) {
    let program = env!("CARGO_BIN_EXE_linkwright");
    let line = format!("ulimit -f 2; exec {program} sweep a.mech {options}");
    let mut shell = Command::new("sh");
    let shell = shell.args(["-c", &line]).current_dir(folder.file("."));
    let ran = Ran::from(shell.output().expect("a shell"));
    assert_ne!(ran.code, Some(0), "{ran:?}");
}

#[test]
fn a_resumed_table_is_that_of_one_run() {
    for (mode, count) in [("", 12), (" --instants", 5)] {
        let folder = Folder::new("sweep_resumed", LIFT);
        let sets = format!(
            "--vary L3=50mm..150mm:{count} --vary L4=78mm..82mm:2 --to 1 --step 0.1 --show phi_rocker"
        );
        let options = |file: &str| format!("{sets}{mode} --csv {file} --plot {file}.pictures");
        folder
            .run(&format!("sweep a.mech {}", options("whole.csv")))
            .exits_with(0);
        let whole = folder.read("whole.csv");
        assert!(whole.len() > 1100 && whole.contains("out of reach"));
        let picture = folder.read("whole.csv.pictures/sweep_phi_rocker.svg");

        interrupted(&folder, &options("b.csv"));
        let part = folder.read("b.csv.part");
        assert!(!folder.file("b.csv").exists());
        assert!(!part.is_empty() && part.len() < whole.len() && whole.starts_with(&part));
        let definition = folder.read("b.csv.part.definition");
        // Nothing of it is lost by chance.
        let refused = folder
            .run(&format!("sweep a.mech {}", options("b.csv")))
            .exits_with(2);
        assert!(
            refused.stderr.contains("continue it with `--resume`"),
            "{}",
            refused.stderr
        );
        assert_eq!(folder.read("b.csv.part"), part);

        let lines: Vec<usize> = whole.match_indices('\n').map(|it| it.0 + 1).collect();
        let mut lengths = vec![0, 1, lines[0] / 2, part.len()];
        // Before, at and beyond the ends of lines, in turn.
        for (number, end) in lines.into_iter().enumerate() {
            lengths.push(match number % 4 {
                0 => end - 1,
                1 => end,
                2 => end + 2,
                _ => end + 20,
            });
        }
        lengths.retain(|it| *it <= whole.len());
        lengths.sort_unstable();
        lengths.dedup();
        for length in lengths {
            fs::write(folder.file("b.csv.part"), &whole[..length]).expect("written");
            fs::write(folder.file("b.csv.part.definition"), &definition).expect("written");
            folder
                .run(&format!("sweep a.mech {} --resume", options("b.csv")))
                .exits_with(0);
            assert!(folder.read("b.csv") == whole, "{length}");
            let resumed = folder.read("b.csv.pictures/sweep_phi_rocker.svg");
            assert!(resumed == picture, "{length}");
            assert!(!folder.file("b.csv.part").exists());
            assert!(!folder.file("b.csv.part.definition").exists());
        }
    }
}

#[test]
fn only_the_same_sweep_is_continued() {
    let folder = Folder::new("sweep_other", LIFT);
    let options = "--vary L3=50mm..150mm:23 --to 1 --step 0.1 --show phi_rocker --csv b.csv";
    interrupted(&folder, options);
    let part = folder.read("b.csv.part");
    for (other, said) in [
        (options.replace("--to 1", "--to 2"), "expected `frames: 21 "),
        (options.replace("150mm", "151mm"), "expected `ranges: "),
        (
            options.replace("phi_rocker", "phi_coupler"),
            "expected `columns: ",
        ),
        (
            format!("{options} --set L4=81mm"),
            "expected `set: L4=81mm`, found `set: `",
        ),
        (format!("{options} --instants"), "expected `columns: "),
        (
            format!("{options} --branch phi_coupler_phi_rocker=other"),
            "expected `branch: phi_coupler_phi_rocker=other`, found `branch: `",
        ),
    ] {
        let ran = folder
            .run(&format!("sweep a.mech {other} --resume"))
            .exits_with(2);
        assert!(
            ran.stderr.contains("belongs to another sweep"),
            "{}",
            ran.stderr
        );
        assert!(ran.stderr.contains(said), "{}", ran.stderr);
    }
    let text = folder.read("a.mech");
    fs::write(folder.file("a.mech"), text.replace("3*t", "2*t")).expect("written");
    let ran = folder
        .run(&format!("sweep a.mech {options} --resume"))
        .exits_with(2);
    assert!(
        ran.stderr.contains("expected `description: "),
        "{}",
        ran.stderr
    );
    fs::write(folder.file("a.mech"), text).expect("written");
    // A table does not begin with rows that this sweep does not write.
    let place = part.rfind("50.0").expect("the first set");
    let changed = format!("{}51.0{}", &part[..place], &part[place + 4..]);
    let first = changed.lines().take(2).map(|it| format!("{it}\n"));
    fs::write(folder.file("b.csv.part"), first.collect::<String>()).expect("written");
    let ran = folder
        .run(&format!("sweep a.mech {options} --resume"))
        .exits_with(2);
    assert!(
        ran.stderr.contains("rows that this command does not write"),
        "{}",
        ran.stderr
    );
    assert!(!folder.file("b.csv").exists());
    // It is replaced on request.
    folder
        .run(&format!("sweep a.mech {options} --force"))
        .exits_with(0);
    assert!(folder.read("b.csv").starts_with(&part));
}
