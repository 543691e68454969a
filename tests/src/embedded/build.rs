//! *A program* → *its ELF file*, compiled and linked, and what it prints under QEMU.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::program::{Processor, Program};
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
    let mut features = "firmware".to_string();
    if program.is_small {
        // Not by a profile of its own, for which everything that generates the modules would be built again.
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

/// What firmware prints on a board.
///
/// # Errors
/// It does not come to its end.
pub fn run(elf: &Path, processor: Processor) -> io::Result<String> {
    let mut command = Command::new("timeout");
    command.args([
        PATIENCE,
        "qemu-derived-arm",
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
