//! Runs tasks on compiled mechanisms, in f64 and in f32.
//!
//! The modules are generated as a build script would, and compiled in a package of their own under the target folder.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, Scalar, generate};

use super::mechanism::Mechanism;
use super::program;
use super::ways::{Answered, CALLS, Task};
use crate::files;

/// Answers of the compiled code, for one mechanism: in f64 and in f32.
pub type Answers = [Vec<Answered>; 2];

/// Folder of the package, beside the running program.
///
/// # Errors
/// If the path of the program is unknown.
pub fn folder() -> io::Result<PathBuf> {
    let program = std::env::current_exe()?;
    let target = program.parent().and_then(Path::parent);
    let target = target.ok_or_else(|| io::Error::other("no target folder"))?;
    Ok(target.join("hunt"))
}

/// Generates, compiles and runs all of them.
///
/// # Errors
/// If a file cannot be written, the code cannot be generated or compiled, or the program does not end as it should.
pub fn answers(
    folder: &Path,
    mechanisms: &[&Mechanism],
    tasks: &[&Task],
) -> io::Result<Vec<Answers>> {
    write_package(folder, mechanisms)?;
    let built = Command::new("cargo")
        .args(["build", "--release", "--quiet", "--offline", "--target-dir"])
        .arg(folder.join("target"))
        .current_dir(folder)
        .env("RUSTFLAGS", "-Awarnings")
        .status()?;
    if !built.success() {
        return Err(io::Error::other("the generated code does not compile"));
    }
    let file = folder.join("tasks");
    fs::write(
        &file,
        tasks.iter().copied().map(written).collect::<String>(),
    )?;
    let output = Command::new(folder.join("target/release/hunted"))
        .arg(&file)
        .output()?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(io::Error::other(message));
    }
    let printed = String::from_utf8(output.stdout).map_err(io::Error::other)?;
    read(&printed, tasks).ok_or_else(|| io::Error::other("unreadable answers"))
}

/// Writes changed files: Cargo does not compile an unchanged file again.
fn write_package(folder: &Path, mechanisms: &[&Mechanism]) -> io::Result<()> {
    let source = folder.join("src");
    fs::create_dir_all(&source)?;
    let write = |path: PathBuf, text: &str| {
        if fs::read_to_string(&path).is_ok_and(|before| before == text) {
            return Ok(());
        }
        fs::write(path, text)
    };
    let runtime = files::repository().join("runtime");
    let manifest = format!(
        "[package]\nname = \"hunted\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\nlinkwright = {{ path = {runtime:?}, features = [\"std\"] }}\n"
    );
    write(folder.join("Cargo.toml"), &manifest)?;
    fs::copy(
        files::repository().join("Cargo.lock"),
        folder.join("Cargo.lock"),
    )?;
    write(source.join("values.rs"), include_str!("../values.rs"))?;
    write(source.join("ways.rs"), include_str!("ways.rs"))?;
    let have_motions: Vec<bool> = mechanisms.iter().map(|it| it.motions.is_some()).collect();
    write(source.join("main.rs"), &program::main(&have_motions))?;
    for (index, mechanism) in mechanisms.iter().enumerate() {
        let text = mechanism.text();
        for (name, scalar) in [("f64", Scalar::F64), ("f32", Scalar::F32)] {
            let generated = generate(
                &Source::new("found.mech", text.as_str()),
                &Options {
                    scalar,
                    ..Options::default()
                },
            )
            .map_err(|errors| io::Error::other(format!("{errors:?}")))?;
            let file = format!("{}.rs", program::module(index, name));
            write(source.join(file), generated.code())?;
        }
    }
    Ok(())
}

fn written(task: &Task) -> String {
    let mut text = String::from(if task.is_negative {
        "negative\n"
    } else {
        "positive\n"
    });
    let estimates = task.near.iter().chain(&task.scattered);
    for numbers in [&task.times, &task.start].into_iter().chain(estimates) {
        for number in numbers {
            let _ = write!(text, "{:x} ", number.to_bits());
        }
        text.push('\n');
    }
    text
}

/// The answers, in the order of the tasks, each scalar's up to an empty line.
fn read(printed: &str, tasks: &[&Task]) -> Option<Vec<Answers>> {
    let mut lines = printed.lines();
    let mut one = |count: usize| {
        let mut answers = Vec::new();
        for line in lines.by_ref() {
            if line.is_empty() {
                return Some(answers);
            }
            answers.push(answered(line, count)?);
        }
        None
    };
    let all = tasks.iter().map(|task| {
        let count = task.start.len();
        Some([one(count)?, one(count)?])
    });
    all.collect()
}

fn answered(line: &str, count: usize) -> Option<Answered> {
    let mut words = line.split(' ');
    let call = *CALLS.get(words.next()?.parse::<usize>().ok()?)?;
    let instant = words.next()?.parse().ok()?;
    let rest: Vec<&str> = words.collect();
    let answer = match rest.as_slice() {
        [kind] => Err((*kind).to_string()),
        bits => {
            let values = bits
                .iter()
                .map(|bits| u64::from_str_radix(bits, 16).map(f64::from_bits));
            let values: Vec<f64> = values.collect::<Result<_, _>>().ok()?;
            let mut levels = values.chunks_exact(count).map(<[f64]>::to_vec);
            Ok([levels.next()?, levels.next()?, levels.next()?])
        }
    };
    Some(Answered {
        call,
        instant,
        answer,
    })
}
