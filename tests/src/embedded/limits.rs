//! Committed figures of all programs, which a change may exceed by a twentieth.
//!
//! The figures depend on the compiler, and on whether its library was compiled beforehand: each compiler has figures
//! of its own.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::PathBuf;

use crate::files;

/// Largest allowed ratio to a committed figure.
const TOLERANCE: f64 = 1.05;

/// Largest allowed ratio to figures of the newest compiler, for a compiler without figures.
const OTHER_COMPILER: f64 = 1.2;

/// Folder of the figures, with a file for each compiler.
const FOLDER: &str = "embedded/limits";

/// Figures by program and by measured quantity.
pub type Figures = BTreeMap<(String, &'static str), u64>;

/// Writes the figures of a compiler, by its version.
///
/// # Errors
/// The file cannot be written.
pub fn write(compiler: &str, figures: &Figures) -> io::Result<()> {
    let mut text = "program,figure,value\n".to_string();
    for ((program, figure), value) in figures {
        text += &format!("{program},{figure},{value}\n");
    }
    fs::write(file_of(compiler), text)
}

/// Figures that exceed the committed ones, have no committed counterpart, or are missing, except for those of programs left out.
///
/// # Errors
/// The file cannot be read.
pub fn exceeded(
    compiler: &str,
    figures: &Figures,
    left_out: &BTreeSet<String>,
) -> io::Result<Vec<String>> {
    let compiler_file = file_of(compiler);
    let (file, tolerance) = match compiler_file.exists() {
        true => (compiler_file, TOLERANCE),
        false => {
            let newest = newest()?;
            println!(
                "no figures of rustc {compiler}: compared with {}",
                newest.display()
            );
            (newest, OTHER_COMPILER)
        }
    };
    let text = fs::read_to_string(&file)?;
    let unreadable = |line: &str| io::Error::other(format!("{}: `{line}`", file.display()));
    let mut committed: BTreeMap<(&str, &str), u64> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let mut words = line.split(',');
        let (Some(program), Some(figure), Some(value)) = (words.next(), words.next(), words.next())
        else {
            return Err(unreadable(line));
        };
        let value = value.parse().map_err(|_| unreadable(line))?;
        committed.insert((program, figure), value);
    }
    let mut excesses = Vec::new();
    for ((program, figure), value) in figures {
        match committed.remove(&(program.as_str(), *figure)) {
            None => excesses.push(format!(
                "{program}, {figure}: {value}, for which no limit is committed"
            )),
            Some(limit) if *value as f64 > limit as f64 * tolerance => {
                let percent = (tolerance - 1.0) * 100.0;
                excesses.push(format!(
                    "{program}, {figure}: {value}, more than {percent:.0} % above {limit}"
                ));
            }
            Some(_) => {}
        }
    }
    excesses.extend(
        committed
            .keys()
            .filter(|(program, _)| !left_out.contains(*program))
            .map(|(program, figure)| format!("{program}, {figure}: not measured any more")),
    );
    Ok(excesses)
}

fn file_of(compiler: &str) -> PathBuf {
    files::package(FOLDER).join(format!("rustc_{compiler}.csv"))
}

/// File of the newest compiler that has one.
fn newest() -> io::Result<PathBuf> {
    let mut paths = fs::read_dir(files::package(FOLDER))?
        .map(|entry| entry.map(|it| it.path()))
        .collect::<io::Result<Vec<PathBuf>>>()?;
    paths.sort();
    paths
        .pop()
        .ok_or_else(|| io::Error::other(format!("{FOLDER} is empty")))
}
