//! *Cases* → *programs that are built and run, and what differs in their answers*.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_codegen::{Language, Scalar};

use super::case::{Case, SCALARS};
use super::header::{Declared, declared};
use super::{program_c, program_rust};

/// The warnings with which generated C compiles, all of them errors.
pub const FLAGS: [&str; 7] = [
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Werror",
];

/// Writes a file unless it holds this already.
fn write(path: &Path, text: &str) -> io::Result<()> {
    if fs::read_to_string(path).is_ok_and(|before| before == text) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, text)
}

/// Runs a command; its output is the error where it fails.
///
/// # Errors
/// It cannot be started, or ends as it should not.
pub fn run(command: &mut Command) -> io::Result<()> {
    let output = command.output()?;
    if output.status.success() {
        return Ok(());
    }
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text).into_owned();
    Err(io::Error::other(format!(
        "{command:?}\n{}",
        &text[..text.len().min(4000)]
    )))
}

/// The C compilers of this machine.
pub fn compilers() -> Vec<&'static str> {
    let is_there = |name: &&str| {
        Command::new(name)
            .arg("--version")
            .output()
            .is_ok_and(|it| it.status.success())
    };
    ["gcc", "clang"].into_iter().filter(is_there).collect()
}

/// The motions of a case as its header declares them.
fn motions(case: &Case, scalar: (&'static str, Scalar)) -> (String, Vec<program_rust::Motion>) {
    let files = case.files(Language::C, scalar.1);
    let header = files[1].text.clone();
    let read = linkwright_codegen::read(&case.source).expect("the description has been generated");
    let mechanism = read.motions[0].mechanism.name.clone();
    let module = format!("{}_{}", case.name, scalar.0);
    let of = |motion: Option<&str>| -> program_rust::Motion {
        let prefix = motion.map_or(mechanism.clone(), |it| format!("{mechanism}_{it}"));
        let declared: Declared = declared(
            &header,
            &prefix,
            &type_name(&prefix),
            &type_name(&mechanism),
            motion,
        );
        program_rust::Motion {
            answers: motion.map_or(module.clone(), |it| format!("{module}_{it}")),
            module: module.clone(),
            type_name: type_name(&mechanism),
            real: if scalar.0 == "f64" { "f64" } else { "f32" },
            declared,
        }
    };
    let names: Vec<Option<String>> = read
        .motions
        .iter()
        .map(|it| {
            it.mechanism
                .motion
                .as_ref()
                .map(|motion| motion.name.clone())
        })
        .collect();
    let all = names.iter().map(|it| of(it.as_deref())).collect();
    (header, all)
}

/// Builds all programs in `folder`, runs them, and gives what differs: a line each.
///
/// # Errors
/// A file cannot be written, something does not compile, or a program does not end as it should.
pub fn differences(folder: &Path, repository: &Path, cases: &[Case]) -> io::Result<Vec<String>> {
    let answers = folder.join("answers");
    fs::create_dir_all(&answers)?;
    let source = folder.join("package/src");
    let mut all = Vec::new();
    for case in cases {
        for scalar in SCALARS {
            let (_, motions) = motions(case, scalar);
            let module = format!("{}_{}", case.name, scalar.0);
            let rust = case.files(Language::Rust, scalar.1);
            write(&source.join(format!("{module}.rs")), &rust[0].text)?;
            for motion in &motions {
                write(
                    &answers.join(format!("{}.script", motion.answers)),
                    &case.script,
                )?;
            }
            all.extend(motions);
        }
    }
    write(&source.join("main.rs"), &program_rust::main(&all))?;
    build_package(folder, repository)?;
    let program = folder.join("target/debug/called");
    run(Command::new(program).arg(&answers))?;
    let mut found = Vec::new();
    for case in cases {
        for scalar in SCALARS {
            found.extend(in_c(folder, &answers, case, scalar)?);
        }
    }
    Ok(found)
}

/// The package of the Rust modules.
fn build_package(folder: &Path, repository: &Path) -> io::Result<()> {
    let package = folder.join("package");
    let runtime = repository.join("runtime");
    let manifest = format!(
        "[package]\nname = \"called\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[profile.dev]\ndebug = false\nopt-level = 1\n\n[dependencies]\nlinkwright = {{ path = {runtime:?}, features = [\"std\"] }}\n"
    );
    write(&package.join("Cargo.toml"), &manifest)?;
    fs::copy(repository.join("Cargo.lock"), package.join("Cargo.lock"))?;
    run(Command::new("cargo")
        .args(["build", "--quiet", "--offline", "--target-dir"])
        .arg(folder.join("target"))
        .current_dir(&package)
        .env("RUSTFLAGS", "-Awarnings"))
}

/// What the C files of a case answer otherwise than its Rust module, with every compiler.
fn in_c(
    folder: &Path,
    answers: &Path,
    case: &Case,
    scalar: (&'static str, Scalar),
) -> io::Result<Vec<String>> {
    let place = folder.join("c").join(format!("{}_{}", case.name, scalar.0));
    for file in case.files(Language::C, scalar.1) {
        write(&place.join(file.name), &file.text)?;
    }
    let real = if scalar.0 == "f64" { "double" } else { "float" };
    let header = format!("{}.h", case.name);
    let (_, motions) = motions(case, scalar);
    let mut found = Vec::new();
    for compiler in compilers() {
        let object = place.join(format!("{}-{compiler}.o", case.name));
        run(Command::new(compiler)
            .args(FLAGS)
            .arg("-c")
            .arg(place.join(format!("{}.c", case.name)))
            .arg("-o")
            .arg(&object))?;
        let runtime = runtime(folder, &place, compiler)?;
        for motion in &motions {
            let program = format!("{}_main", motion.answers);
            let main = place.join(format!("{program}.c"));
            write(&main, &program_c::main(&header, &motion.declared, real))?;
            let executable = place.join(format!("{program}-{compiler}"));
            run(Command::new(compiler)
                .args(["-std=c99", "-O1"])
                .arg(&main)
                .args([&object, &runtime])
                .arg("-lm")
                .arg("-o")
                .arg(&executable))?;
            let script = answers.join(format!("{}.script", motion.answers));
            let output = Command::new(&executable).arg(script).output()?;
            let rust = fs::read_to_string(answers.join(format!("{}.rust", motion.answers)))?;
            let c = String::from_utf8(output.stdout).map_err(io::Error::other)?;
            if !output.status.success() || c.is_empty() {
                found.push(format!(
                    "{} with {compiler}: {:?}",
                    motion.answers, output.status
                ));
            }
            found.extend(compared(&motion.answers, compiler, &rust, &c));
        }
    }
    Ok(found)
}

/// The object of the runtime, which is the same for all mechanisms: compiled from the files in `place` unless it was.
fn runtime(folder: &Path, place: &Path, compiler: &str) -> io::Result<PathBuf> {
    let shared = folder.join("c/runtime");
    let object = shared.join(format!("linkwright-{compiler}.o"));
    let is_new = |name: &str| -> io::Result<bool> {
        let text = fs::read_to_string(place.join(name))?;
        let before = fs::read_to_string(shared.join(name));
        write(&shared.join(name), &text)?;
        Ok(!before.is_ok_and(|it| it == text))
    };
    let is_changed = is_new("linkwright.h")? | is_new("linkwright.c")?;
    if is_changed {
        for compiler in compilers() {
            let _ = fs::remove_file(shared.join(format!("linkwright-{compiler}.o")));
        }
    }
    if !object.exists() {
        let source = shared.join("linkwright.c");
        run(Command::new(compiler)
            .args(FLAGS)
            .arg("-c")
            .arg(source)
            .arg("-o")
            .arg(&object))?;
    }
    Ok(object)
}

/// The first line that differs.
fn compared(name: &str, compiler: &str, rust: &str, c: &str) -> Option<String> {
    if rust == c {
        return None;
    }
    let lines = rust.lines().zip(c.lines()).enumerate();
    let mut different = lines.filter(|(_, (rust, c))| rust != c);
    let count = different.clone().count();
    let (place, (rust, c)) = different.next().unwrap_or((0, ("", "")));
    let words = rust
        .split(' ')
        .zip(c.split(' '))
        .position(|(one, other)| one != other);
    let short = |line: &str| line.chars().take(160).collect::<String>();
    Some(format!(
        "{name} with {compiler}: {count} lines differ, first {place}, word {words:?}\n  Rust: {}\n  C:    {}",
        short(rust),
        short(c)
    ))
}

/// Where a test keeps what it builds.
pub fn folder(name: &str) -> io::Result<PathBuf> {
    let program = std::env::current_exe()?;
    let target = program.parent().and_then(Path::parent);
    let target = target.ok_or_else(|| io::Error::other("no target folder"))?;
    Ok(target.join(name))
}
