//! Compiles and links a program to its ELF file, and runs it under QEMU.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::program::{Processor, Program};
use super::tools::{cargo_for, cargo_for_host, folder, leave_unoptimized, output};
use crate::files;

/// Target of both processors.
const TARGET: &str = "thumbv7em-none-eabihf";

/// Time limit of QEMU, in s.
const PATIENCE: &str = "300";

/// Linked program.
pub struct Built {
    /// ELF file.
    pub elf: PathBuf,
    /// Map of the linker; `None` if it was not requested.
    pub map: Option<String>,
}

/// Output of every variant on the host, with the standard library or without.
///
/// # Errors
/// The program is not built, or does not run.
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

/// Output of every variant as a module of WebAssembly.
///
/// # Errors
/// The program is not built, or does not run.
pub fn wasm() -> io::Result<String> {
    let target = "wasm32-unknown-unknown";
    let mut command = cargo_for("rustc", target, "")?;
    leave_unoptimized(&mut command);
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

/// Firmware in Rust; a feature in `planted` adds a fault.
///
/// # Errors
/// The program is not compiled or not linked, for instance because of a panic path.
pub fn rust(program: &Program, planted: Option<&str>) -> io::Result<Built> {
    let processor = program.processor.name();
    let flags = format!("-C link-arg=-Tlink.x -C target-cpu={processor}");
    let mut command = cargo_for("build", TARGET, &flags)?;
    let mut features = "firmware".to_string();
    if program.is_small {
        // A profile of its own would rebuild everything that generates the modules.
        command.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "s");
        features += ",may_panic";
    }
    if let Some(feature) = planted {
        features += &format!(",{feature}");
    }
    command.env("VARIANT", program.variant());
    command.args([
        "--quiet",
        "--release",
        "--bin",
        "firmware",
        "--features",
        &features,
    ]);
    output(&mut command)?;
    let built = folder()
        .join("target")
        .join(TARGET)
        .join("release/firmware");
    let name = format!("{program} {}", planted.unwrap_or_default());
    let elf = folder()
        .join("programs")
        .join(name.trim().replace(' ', "-"));
    fs::create_dir_all(folder().join("programs"))?;
    fs::copy(built, &elf)?;
    Ok(Built { elf, map: None })
}

/// Output of firmware on a board.
///
/// # Errors
/// The program does not come to its end.
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
