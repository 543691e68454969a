//! Contents of the flash of firmware by part, and forbidden names in it.

use std::io;
use std::path::Path;
use std::process::Command;

use super::build::Built;
use super::program::{Language, Program};
use super::tools::output;

/// Owner of code and constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Generated code of the mechanism.
    Mechanism,
    /// Runtime, specialized for the mechanism in Rust.
    Runtime,
    /// Sines, angles and roots.
    Functions,
    /// Constants and tables of all of these.
    Constants,
    /// Calls of the compiler: memory, and arithmetic that the processor does not have.
    Compiler,
    /// Program that moves the mechanism, measures and prints.
    Harness,
}

/// Number of parts.
pub const PARTS: usize = 6;

/// Labels of the parts.
pub const TITLES: [&str; PARTS] = [
    "mechanism",
    "runtime",
    "elementary functions",
    "constants",
    "compiler's library",
    "harness",
];

/// Names that no firmware has: panics, formatting, allocation, in Rust and in C.
const FORBIDDEN: [&str; 12] = [
    "core::panicking",
    "core::fmt",
    "core::num::flt2dec",
    "core::num::imp::flt2dec",
    "PANIC_PATH",
    "__rust_alloc",
    "__rust_realloc",
    "malloc",
    "_sbrk",
    "printf",
    "_dtoa_r",
    "abort",
];

/// Name in the table of symbols, and its bytes of flash.
struct Symbol {
    name: String,
    size: u64,
}

fn symbols(elf: &Path) -> io::Result<Vec<Symbol>> {
    let text = output(Command::new("arm-none-eabi-nm").args(["-C", "-S"]).arg(elf))?;
    let symbol = |line: &str| {
        let mut words = line.splitn(4, ' ');
        let (_, size, kind, name) = (words.next()?, words.next()?, words.next()?, words.next()?);
        let size = u64::from_str_radix(size, 16).ok()?;
        let is_flash = matches!(kind, "t" | "T" | "r" | "R" | "d" | "D" | "W" | "w");
        is_flash.then(|| Symbol {
            name: name.to_string(),
            size,
        })
    };
    Ok(text.lines().filter_map(symbol).collect())
}

/// Bytes of flash: code, constants, and the first values of variables.
///
/// # Errors
/// The file cannot be read.
pub fn flash(elf: &Path) -> io::Result<u64> {
    let text = output(Command::new("arm-none-eabi-size").arg(elf))?;
    let last = text.lines().last().unwrap_or_default();
    let mut words = last
        .split_whitespace()
        .map(|word| word.parse::<u64>().unwrap_or(0));
    Ok(words.next().unwrap_or(0) + words.next().unwrap_or(0))
}

/// Bytes of each part. Unnamed bytes, such as those between functions, are the harness's.
///
/// # Errors
/// The file cannot be read.
pub fn parts(program: &Program, built: &Built) -> io::Result<[u64; PARTS]> {
    let mut parts = [0; PARTS];
    match &built.map {
        None => {
            for Symbol { name, size } in symbols(&built.elf)? {
                parts[of_rust(&name) as usize] += size;
            }
        }
        Some(map) => {
            for (section, file, size) in linked(map) {
                parts[of_c(program, section, file) as usize] += size;
            }
        }
    }
    let all = flash(&built.elf)?;
    let named: u64 = parts[..Part::Harness as usize].iter().sum();
    parts[Part::Harness as usize] = all.saturating_sub(named);
    Ok(parts)
}

fn of_rust(name: &str) -> Part {
    let is_called = [
        "linkwright_embedded::motion::advance",
        "linkwright_embedded::motion::assemble",
    ];
    let starts = |prefixes: &[&str]| {
        prefixes
            .iter()
            .any(|it| name.trim_start_matches('<').starts_with(it))
    };
    if is_called.iter().any(|it| name.starts_with(it)) || starts(&["linkwright::"]) {
        return Part::Runtime;
    }
    // Loop over frames of the mechanism that the compiler has not unrolled.
    if starts(&[
        "linkwright_embedded::variants",
        "[&linkwright_embedded::variants",
    ]) {
        return Part::Mechanism;
    }
    if starts(&["linkwright_math", "libm"]) {
        return Part::Functions;
    }
    if starts(&[".L"]) {
        return Part::Constants;
    }
    let is_compilers = starts(&[
        "compiler_builtins",
        "__aeabi",
        "mem",
        "__mul",
        "__add",
        "__sub",
        "__div",
    ]);
    if is_compilers {
        Part::Compiler
    } else {
        Part::Harness
    }
}

fn of_c(program: &Program, section: &str, file: &str) -> Part {
    let object = file.rsplit('/').next().unwrap_or(file);
    let name = program.mechanism();
    if object == format!("{name}.o") {
        return match section.starts_with(".text") {
            true => Part::Mechanism,
            false => Part::Constants,
        };
    }
    let is_function = |words: &[&str]| words.iter().any(|word| section.contains(word));
    match object {
        "linkwright.o" if !section.starts_with(".text") => Part::Constants,
        "linkwright.o" if is_function(&["sin", "cos", "angle", "atan", "turn"]) => Part::Functions,
        "linkwright.o" => Part::Runtime,
        "motion.o" | "board.o" => Part::Harness,
        _ if file.contains("libm.a") => Part::Functions,
        // The hand-written frame calls them as well.
        _ if program.language == Language::ByHand && file.contains("libc.a") => Part::Functions,
        _ => Part::Compiler,
    }
}

/// Sections in flash: their names, files and sizes, from a map of GNU's linker.
fn linked(map: &str) -> Vec<(&str, &str, u64)> {
    let (_, map) = map
        .split_once("Linker script and memory map")
        .unwrap_or(("", map));
    let mut sections = Vec::new();
    let mut name = None;
    for line in map.lines() {
        let mut words = line.split_whitespace().peekable();
        if line.starts_with(" .") {
            name = words.next();
        } else if !line.starts_with("     ") {
            name = None;
        }
        let (Some(section), Some(address), Some(size), Some(file)) =
            (name, words.next(), words.next(), words.next())
        else {
            continue;
        };
        let kept = [".text", ".rodata", ".data", ".vectors", ".ARM.exidx"];
        let hex = |word: &str| u64::from_str_radix(word.strip_prefix("0x")?, 16).ok();
        if let (true, Some(_), Some(size)) = (
            kept.iter().any(|it| section.starts_with(it)),
            hex(address),
            hex(size),
        ) {
            sections.push((section, file, size));
        }
        name = None;
    }
    sections
}

/// Forbidden names in firmware: of panics, allocators and formatting, and of the textbook formulation, which no loop
/// calls.
///
/// # Errors
/// The file cannot be read.
pub fn forbidden(program: &Program, elf: &Path) -> io::Result<Vec<String>> {
    let variant = program.variant();
    let textbook: Vec<String> = ["phi", "phi_q", "phi_t", "gamma"]
        .iter()
        .flat_map(|name| {
            let mechanism = program.mechanism();
            [
                format!("linkwright_embedded::variants::{variant}::{name}"),
                format!("{mechanism}_{name}"),
            ]
        })
        .collect();
    // Code for size keeps checks that cannot fail.
    let is_let_pass = |name: &str| program.is_small && name.contains("core::panicking");
    let is_forbidden = |name: &str| {
        if is_let_pass(name) {
            return false;
        }
        FORBIDDEN.iter().any(|it| name.contains(it))
            || textbook.iter().any(|it| it == name)
            || name.contains("::Textbook")
            || name.contains("newton_step")
    };
    let names = symbols(elf)?.into_iter().map(|symbol| symbol.name);
    Ok(names.filter(|name| is_forbidden(name)).collect())
}
