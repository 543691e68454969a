//! Compilers and QEMU of the machine, as commands; missing ones are reported.

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::modules;
use crate::files;

/// Linker that the compiler of a target needs besides itself.
const LINKER: &str = "lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld";

/// Folder of all builds.
pub fn folder() -> PathBuf {
    let target = env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.filter(|it| !it.as_os_str().is_empty());
    let target = target.unwrap_or_else(|| files::repository().join("target"));
    target.join("embedded")
}

/// Output of a command.
///
/// # Errors
/// The command cannot be started, or fails; the error then has its output.
pub fn output(command: &mut Command) -> io::Result<String> {
    let output = command.output().map_err(|error| {
        let program = command.get_program().display().to_string();
        io::Error::new(error.kind(), format!("{program}: {error}"))
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    let end = text.char_indices().nth(6000).map_or(text.len(), |it| it.0);
    Err(io::Error::other(format!("{command:?}\n{}", &text[..end])))
}

/// Build in `tests/embedded` for the host.
pub fn cargo_for_host() -> Command {
    let mut command = Command::new(env!("CARGO"));
    set_up(&mut command);
    leave_unoptimized(&mut command);
    command
}

/// Lets a build do without optimization: bits must not depend on it, and firmware, whose size and speed count, has it.
pub fn leave_unoptimized(command: &mut Command) {
    for (setting, value) in [("OPT_LEVEL", "0"), ("LTO", "off"), ("CODEGEN_UNITS", "16")] {
        command.env(format!("CARGO_PROFILE_RELEASE_{setting}"), value);
    }
}

/// Sets the folders of a build in `tests/embedded`.
fn set_up(command: &mut Command) {
    command.current_dir(files::package("embedded"));
    command.env("CARGO_TARGET_DIR", folder().join("target"));
    command.env("CARGO_INCREMENTAL", "0");
    command.env("MODULES", modules::modules());
}

/// Build in `tests/embedded` for a target, by the compiler of rustup if that has its library, or else by Debian's
/// with the library's source.
///
/// # Errors
/// Neither is possible.
pub fn cargo_for(subcommand: &str, target: &str, flags: &str) -> io::Result<Command> {
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let sysroot = PathBuf::from(sysroot.trim());
    let has_library = |sysroot: &Path| {
        sysroot
            .join("lib/rustlib")
            .join(target)
            .join("lib")
            .is_dir()
    };
    let mut command = if has_library(&sysroot) {
        Command::new(env!("CARGO"))
    } else {
        let mut command = Command::new("/usr/bin/cargo");
        command.env("PATH", "/usr/bin:/bin");
        command.env("RUSTC_BOOTSTRAP", "1");
        for variable in ["LD_LIBRARY_PATH", "RUSTUP_TOOLCHAIN", "RUSTC", "CARGO"] {
            command.env_remove(variable);
        }
        command
    };
    let is_debian = command.get_program() == "/usr/bin/cargo";
    if is_debian && !Path::new("/usr/bin/cargo").exists() {
        return Err(io::Error::other(format!(
            "no compiler for {target}: `rustup target add {target}`, or install rustc-web, cargo-web and rust-web-src"
        )));
    }
    let linker = match target.starts_with("thumb") {
        true => "-C linker=arm-none-eabi-ld -C linker-flavor=ld".to_string(),
        false => format!("-C linker={}", sysroot.join(LINKER).display()),
    };
    command.arg(subcommand).args(["--target", target]);
    if is_debian {
        command.arg("-Zbuild-std=core,panic_abort");
    }
    command.env(
        "RUSTFLAGS",
        format!("-C symbol-mangling-version=v0 {linker} {flags}"),
    );
    set_up(&mut command);
    Ok(command)
}

/// Versions of the compilers and of QEMU.
///
/// # Errors
/// One is missing.
pub fn versions() -> io::Result<Vec<String>> {
    let first = |command: &mut Command| -> io::Result<String> {
        let text = output(command)?;
        Ok(text.lines().next().unwrap_or_default().to_string())
    };
    let mut rustc = cargo_for("rustc", "thumbv7em-none-eabihf", "")?;
    let program = match rustc.get_program() == "/usr/bin/cargo" {
        true => "/usr/bin/rustc",
        false => "rustc",
    };
    rustc = Command::new(program);
    Ok(vec![
        first(rustc.arg("--version").env_remove("LD_LIBRARY_PATH"))?,
        first(Command::new("arm-none-eabi-gcc").arg("--version"))?,
        first(Command::new("qemu-system-arm").arg("--version"))?,
    ])
}
