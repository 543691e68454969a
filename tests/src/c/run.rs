//! Builds and runs the programs of cases, and compares their answers.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_codegen::{Language, OutputFile, Scalar};

use super::case::{Case, SCALARS};
use super::{header, program_c, program_rust};
use crate::{description, files};

/// Warnings with which generated C compiles, all of them errors.
pub const FLAGS: [&str; 10] = [
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Wfloat-equal",
    "-Wdouble-promotion",
    "-Werror",
];

/// Runs a command; its output is the error if it fails.
///
/// # Errors
/// The command cannot be started, or fails.
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

/// C compilers of this machine.
pub fn compilers() -> &'static [&'static str] {
    static FOUND: OnceLock<Vec<&str>> = OnceLock::new();
    FOUND.get_or_init(found_compilers)
}

fn found_compilers() -> Vec<&'static str> {
    let is_there = |name: &&str| {
        Command::new(name)
            .arg("--version")
            .output()
            .is_ok_and(|it| it.status.success())
    };
    ["gcc", "clang"].into_iter().filter(is_there).collect()
}

/// Case in one scalar, with everything that is generated from it.
struct Prepared<'a> {
    case: &'a Case,
    /// Name of the Rust module.
    module: String,
    rust: String,
    c: Vec<OutputFile>,
    /// Motions as the header declares them.
    motions: Vec<program_rust::Motion>,
    /// Type of numbers in C.
    real: &'static str,
    /// Last optimization option of the C compiler, which counts. Bits must not depend on it.
    optimization: &'static str,
    compiler: &'static str,
    /// Folder of the C files.
    place: PathBuf,
}

impl Prepared<'_> {
    fn new<'a>(
        folder: &Path,
        case: &'a Case,
        scalar: (&'static str, Scalar),
        compiler: &'static str,
    ) -> Prepared<'a> {
        let module = format!("{}_{}", case.name, scalar.0);
        let c = case.files(Language::C, scalar.1);
        let rust = case.files(Language::Rust, scalar.1).swap_remove(0).text;
        Prepared {
            case,
            rust,
            motions: motions(case, &module, scalar.0, &c[1].text),
            c,
            real: if scalar.0 == "f64" { "double" } else { "float" },
            optimization: if scalar.0 == "f64" { "-O2" } else { "-O1" },
            compiler,
            place: folder.join("c").join(&module),
            module,
        }
    }
}

fn motions(
    case: &Case,
    module: &str,
    scalar: &'static str,
    header: &str,
) -> Vec<program_rust::Motion> {
    let read = linkwright_codegen::read(&case.source).expect("the description has been generated");
    let mechanism = read.motions[0].system.mechanism.name.clone();
    header::motions(&case.source, header)
        .into_iter()
        .map(|declared| program_rust::Motion {
            answers: match &declared.motion {
                None => module.to_string(),
                Some(motion) => format!("{module}_{motion}"),
            },
            module: module.to_string(),
            type_name: type_name(&mechanism),
            real: scalar,
            declared,
        })
        .collect()
}

/// Builds all programs in `folder`, those of cargo in `target`, runs them, and returns the differences, a line each.
///
/// # Errors
/// A file cannot be written, a program does not compile, or a program fails.
pub fn differences(
    folder: &Path,
    target: &Path,
    repository: &Path,
    cases: &[Case],
) -> io::Result<Vec<String>> {
    let answers = folder.join("answers");
    // Those of descriptions that are not selected any more are none of these answers.
    if answers.exists() {
        fs::remove_dir_all(&answers)?;
    }
    fs::create_dir_all(&answers)?;
    // Every case in f64 and every third one in f32, with each compiler in turn.
    let compilers = &compilers();
    let prepared: Vec<Prepared<'_>> = (0..)
        .zip(cases)
        .flat_map(|(number, case)| {
            let compiler = move |place: usize| compilers[(number / 2 + place) % compilers.len()];
            let scalars = if number % 3 == 0 { 2 } else { 1 };
            let scalars = SCALARS.into_iter().enumerate().take(scalars);
            scalars
                .map(|(place, scalar)| Prepared::new(folder, case, scalar, compiler(place)))
                .collect::<Vec<_>>()
        })
        .collect();
    let source = folder.join("package/src");
    for it in &prepared {
        files::write_if_changed(&source.join(format!("{}.rs", it.module)), &it.rust)?;
        for motion in &it.motions {
            let script = answers.join(format!("{}.script", motion.answers));
            files::write_if_changed(&script, &it.case.script)?;
        }
    }
    let motions: Vec<_> = prepared.iter().flat_map(|it| it.motions.clone()).collect();
    files::write_if_changed(&source.join("main.rs"), &program_rust::main(&motions))?;
    // One thread builds and runs Rust, the others compile C.
    let next = AtomicUsize::new(0);
    let compile_all = || -> io::Result<()> {
        while let Some(it) = prepared.get(next.fetch_add(1, Ordering::Relaxed)) {
            compile(it)?;
        }
        Ok(())
    };
    thread::scope(|scope| -> io::Result<()> {
        let compiling = [scope.spawn(compile_all), scope.spawn(compile_all)];
        build_package(folder, target, repository)?;
        run(Command::new(target.join("debug/called")).arg(&answers))?;
        for thread in compiling {
            let ended = thread.join();
            ended.map_err(|_| io::Error::other("a thread has panicked"))??;
        }
        Ok(())
    })?;
    let mut differing = Vec::new();
    for it in &prepared {
        differing.extend(in_c(&answers, it)?);
    }
    Ok(differing)
}

/// The package of the Rust modules.
fn build_package(folder: &Path, target: &Path, repository: &Path) -> io::Result<()> {
    let package = folder.join("package");
    let runtime = repository.join("runtime");
    let manifest = format!(
        "[package]\nname = \"called\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[profile.dev]\ndebug = false\n\n[dependencies]\nlinkwright = {{ path = {runtime:?}, features = [\"std\"] }}\n"
    );
    files::write_if_changed(&package.join("Cargo.toml"), &manifest)?;
    fs::copy(repository.join("Cargo.lock"), package.join("Cargo.lock"))?;
    run(Command::new("cargo")
        .args(["build", "--quiet", "--offline", "--target-dir"])
        .arg(target)
        .current_dir(&package))
}

/// Compiles the C files of a case and its programs, one for each motion.
fn compile(prepared: &Prepared<'_>) -> io::Result<()> {
    let (place, name, compiler) = (&prepared.place, &prepared.case.name, prepared.compiler);
    for file in &prepared.c {
        files::write_if_changed(&place.join(&file.name), &file.text)?;
    }
    let object = place.join(format!("{name}-{compiler}.o"));
    run(Command::new(compiler)
        .args(FLAGS)
        .args([prepared.optimization, "-c"])
        .arg(place.join(format!("{name}.c")))
        .arg("-o")
        .arg(&object))?;
    for motion in &prepared.motions {
        let program = format!("{}_main", motion.answers);
        let main = place.join(format!("{program}.c"));
        let header = format!("{name}.h");
        let text = program_c::main(&header, &motion.declared, prepared.real);
        files::write_if_changed(&main, &text)?;
        // Calls and prints only, as the module computes in an object of its own.
        run(Command::new(compiler)
            .args(["-std=c99", "-O0"])
            .arg(&main)
            .args([&object, &runtime_object(compiler)])
            .arg("-lm")
            .arg("-o")
            .arg(place.join(format!("{program}-{compiler}"))))?;
    }
    Ok(())
}

/// Differences between the answers of the C programs of a case and those of its Rust module.
fn in_c(answers: &Path, prepared: &Prepared<'_>) -> io::Result<Vec<String>> {
    let (mut differing, compiler) = (Vec::new(), prepared.compiler);
    for motion in &prepared.motions {
        let script = answers.join(format!("{}.script", motion.answers));
        let rust = fs::read_to_string(answers.join(format!("{}.rust", motion.answers)))?;
        let program = format!("{}_main-{compiler}", motion.answers);
        let output = Command::new(prepared.place.join(program))
            .arg(&script)
            .output()?;
        let c = String::from_utf8(output.stdout).map_err(io::Error::other)?;
        if !output.status.success() || c.is_empty() {
            differing.push(format!(
                "{} with {compiler}: {:?}",
                motion.answers, output.status
            ));
        }
        differing.extend(compared(&motion.answers, compiler, &rust, &c));
    }
    Ok(differing)
}

/// Object of the C runtime for a compiler, compiled once in a process: its text is equal for all mechanisms.
///
/// # Panics
/// If it does not compile.
pub fn runtime_object(compiler: &str) -> PathBuf {
    static PLACE: OnceLock<PathBuf> = OnceLock::new();
    let compiled = || compiled_runtime().unwrap_or_else(|error| panic!("{error}"));
    let place = PLACE.get_or_init(compiled);
    place.join(format!("linkwright-{compiler}.o"))
}

/// Folder of the C runtime and of its objects.
fn compiled_runtime() -> io::Result<PathBuf> {
    let place = folder("c_runtime")?;
    let case = Case::new("four_bar", description::source("four_bar"), 1.0);
    for file in case.files(Language::C, Scalar::F64) {
        files::write_if_changed(&place.join(&file.name), &file.text)?;
    }
    for compiler in compilers() {
        run(Command::new(compiler)
            .args(FLAGS)
            .args(["-c", "linkwright.c", "-o"])
            .arg(format!("linkwright-{compiler}.o"))
            .current_dir(&place))?;
    }
    Ok(place)
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

/// Folder for the builds of a test.
pub fn folder(name: &str) -> io::Result<PathBuf> {
    let program = std::env::current_exe()?;
    let target = program.parent().and_then(Path::parent);
    let target = target.ok_or_else(|| io::Error::other("no target folder"))?;
    Ok(target.join(name))
}
