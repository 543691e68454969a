//! *A program* → *its ELF file*, compiled and linked, and what it prints under QEMU.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language as Output, Options, Scalar as Precision, generate_files};

use super::program::{Language, MECHANISMS, Processor, Program, Scalar};
use super::tools::{cargo_for, cargo_for_host, folder, output};
use crate::files;

/// The target of both processors.
const TARGET: &str = "thumbv7em-none-eabihf";

/// What QEMU runs, in s, before it is ended.
const PATIENCE: &str = "300";

/// A program that was linked.
pub struct Built {
    /// Its file.
    pub elf: PathBuf,
    /// What the linker says of its parts, where that is asked.
    pub map: Option<String>,
}

/// What every variant prints on the host, with the standard library or without.
///
/// # Errors
/// It is not built, or does not run.
pub fn host(features: &str) -> io::Result<String> {
    output(cargo_for_host().args([
        "run",
        "--release",
        "--quiet",
        "--bin",
        "host",
        "--features",
        features,
    ]))
}

/// What every variant prints as a module of WebAssembly.
///
/// # Errors
/// It is not built, or does not run.
pub fn wasm() -> io::Result<String> {
    let target = "wasm32-unknown-unknown";
    let mut command = cargo_for("rustc", target, "")?;
    output(command.args(["--release", "--quiet", "--lib", "--crate-type", "cdylib"]))?;
    let module = folder()
        .join("target")
        .join(target)
        .join("release/linkwright_embedded.wasm");
    output(
        Command::new("node")
            .arg(files::package("embedded/src/wasm.mjs"))
            .arg(module),
    )
}

/// Firmware in Rust, of which features plant something.
///
/// # Errors
/// It is not compiled or not linked, as where a panic path is left.
pub fn rust(program: &Program, planted: Option<&str>) -> io::Result<Built> {
    let processor = program.processor.name();
    let flags = format!("-C link-arg=-Tlink.x -C target-cpu={processor}");
    let mut command = cargo_for("build", TARGET, &flags)?;
    let profile = if program.is_small { "small" } else { "release" };
    let features = planted.map_or("firmware".to_string(), |it| format!("firmware,{it}"));
    command.env("VARIANT", program.variant());
    command.args([
        "--quiet",
        "--bin",
        "firmware",
        "--profile",
        profile,
        "--features",
        &features,
    ]);
    output(&mut command)?;
    let built = folder()
        .join("target")
        .join(TARGET)
        .join(profile)
        .join("firmware");
    let name = format!("{program} {}", planted.unwrap_or_default());
    let elf = folder()
        .join("programs")
        .join(name.trim().replace(' ', "-"));
    fs::create_dir_all(folder().join("programs"))?;
    fs::copy(built, &elf)?;
    Ok(Built { elf, map: None })
}

/// Writes the generated C of a mechanism and names its sources.
fn generate(mechanism: &str, scalar: Scalar) -> io::Result<PathBuf> {
    let place = folder()
        .join("c")
        .join(format!("{mechanism}_{}", scalar.name()));
    fs::create_dir_all(&place)?;
    let description = files::repository()
        .join("mechanisms")
        .join(mechanism)
        .with_extension("mech");
    let source = Source::new(
        format!("{mechanism}.mech"),
        fs::read_to_string(description)?,
    );
    let scalar = match scalar {
        Scalar::F32 => Precision::F32,
        Scalar::F64 => Precision::F64,
    };
    let options = Options {
        scalar,
        ..Options::default()
    };
    let generated = generate_files(&source, Output::C, mechanism, &options);
    let generated = generated.map_err(|found| io::Error::other(found.render(&source)))?;
    for file in generated.files {
        fs::write(place.join(file.name), file.text)?;
    }
    Ok(place)
}

/// The sources of a mechanism in C, and what the compiler is told to compile it and the program that moves it.
fn sources(
    mechanism: usize,
    language: Language,
    scalar: Scalar,
) -> io::Result<(Vec<PathBuf>, Vec<String>)> {
    let (name, type_name) = MECHANISMS[mechanism];
    let harness = files::package("embedded/c");
    let place = match language {
        Language::ByHand => harness.join("by_hand"),
        _ => generate(name, scalar)?,
    };
    let mut sources = vec![place.join(format!("{name}.c"))];
    if language != Language::ByHand {
        sources.push(place.join("linkwright.c"));
    }
    let (real, word, suffix) = match scalar {
        Scalar::F32 => ("float", "uint32_t", "f"),
        Scalar::F64 => ("double", "uint64_t", ""),
    };
    let failure = match language {
        Language::ByHand => format!("{type_name}Failure"),
        _ => format!("linkwright{suffix}_failure"),
    };
    let include = |folder: &Path| format!("-I{}", folder.display());
    let flags = vec![
        "-std=c99".to_string(),
        "-O2".to_string(),
        "-fno-math-errno".to_string(),
        "-Wall".to_string(),
        "-Wextra".to_string(),
        "-Wpedantic".to_string(),
        "-Werror".to_string(),
        "-ffunction-sections".to_string(),
        "-fdata-sections".to_string(),
        include(&harness),
        include(&place),
        format!("-DHEADER=\"{name}.h\""),
        format!("-DMECHANISM={type_name}"),
        format!("-DPREFIX={name}"),
        format!("-DREAL={real}"),
        format!("-DWORD={word}"),
        format!("-DFAILURE={failure}"),
    ];
    Ok((sources, flags))
}

/// What the generated C of a mechanism prints on the host.
///
/// # Errors
/// It is not compiled, or does not run.
pub fn c_on_host(mechanism: usize, scalar: Scalar) -> io::Result<String> {
    let (sources, flags) = sources(mechanism, Language::C, scalar)?;
    let harness = files::package("embedded/c");
    let (name, _) = MECHANISMS[mechanism];
    let program = folder()
        .join("c")
        .join(format!("{name}_{}_host", scalar.name()));
    let mut command = Command::new("cc");
    command
        .args(flags)
        .arg(harness.join("motion.c"))
        .arg(harness.join("host.c"));
    output(command.args(sources).args(["-lm", "-o"]).arg(&program))?;
    output(&mut Command::new(program))
}

/// Firmware in C.
///
/// # Errors
/// It is not compiled or not linked.
pub fn c(program: &Program) -> io::Result<Built> {
    let (mut sources, flags) = sources(program.mechanism, program.language, program.scalar)?;
    let harness = files::package("embedded/c");
    sources.extend(["motion.c", "board.c"].map(|name| harness.join(name)));
    let place = folder()
        .join("c")
        .join(program.to_string().replace(' ', "-"));
    fs::create_dir_all(&place)?;
    let processor = [
        format!("-mcpu={}", program.processor.name()),
        "-mthumb".to_string(),
        format!("-mfpu={}", program.processor.unit()),
        "-mfloat-abi=hard".to_string(),
    ];
    let mut objects = Vec::new();
    for source in &sources {
        let object = place.join(files::stem(source)).with_extension("o");
        let mut command = Command::new("arm-none-eabi-gcc");
        command
            .args(&processor)
            .args(&flags)
            .arg("-c")
            .arg(source)
            .arg("-o")
            .arg(&object);
        output(&mut command)?;
        objects.push(object);
    }
    let (elf, map) = (place.join("firmware"), place.join("map"));
    let mut command = Command::new("arm-none-eabi-gcc");
    command
        .args(&processor)
        .args(objects)
        .arg("-nostartfiles")
        .arg("-T")
        .arg(harness.join("board.ld"));
    command
        .arg("-Wl,--gc-sections")
        .arg(format!("-Wl,-Map={}", map.display()));
    output(command.args(["--specs=nosys.specs", "-lm", "-o"]).arg(&elf))?;
    let map = Some(fs::read_to_string(map)?);
    Ok(Built { elf, map })
}

/// What firmware prints on a board.
///
/// # Errors
/// It does not come to its end.
pub fn run(elf: &Path, processor: Processor) -> io::Result<String> {
    let mut command = Command::new("timeout");
    command.args([
        PATIENCE,
        "qemu-system-arm",
        "-machine",
        processor.board(),
        "-icount",
        "shift=8",
    ]);
    command.args(["-display", "none", "-monitor", "none", "-serial", "none"]);
    command
        .args(["-semihosting-config", "enable=on,target=native", "-kernel"])
        .arg(elf);
    output(&mut command)
}
