//! Builds the firmware of `tests/embedded`, runs it under QEMU, and compares: bits with those of the host, frames with references,
//! figures with those that are committed; or writes `tests/reports/embedded.md`.
//!
//! Needs rust-lld of rustup's toolchain and a compiler with the library of `thumbv7em-none-eabihf`, rustup's or Debian's (rustc-web, cargo-web,
//! rust-web-src); qemu-system-arm, gcc-arm-none-eabi, libnewlib-arm-none-eabi and nodejs.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::io;
use std::process::ExitCode;
use std::sync::mpsc;
use std::thread;

use clap::Parser;
use linkwright_tests::embedded::c::Compiler;
use linkwright_tests::embedded::calls::Calls;
use linkwright_tests::embedded::figures::Known;
use linkwright_tests::embedded::limits::{self, Figures};
use linkwright_tests::embedded::printed::Printed;
use linkwright_tests::embedded::program::{Language, MECHANISMS, Processor, Program, Scalar};
use linkwright_tests::embedded::{build, modules, report, symbols, tools};
use linkwright_tests::files;

/// Runs mechanisms as firmware
#[derive(Parser)]
struct Arguments {
    /// Write the report and the figures to compare with
    #[arg(long)]
    write: bool,
    /// Take all programs, not only representatives
    #[arg(long)]
    all: bool,
    /// Only programs whose names contain this, such as "cortex-m4 f32 four_bar"; nothing is written
    #[arg(long)]
    only: Option<String>,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(faults) if faults.is_empty() => ExitCode::SUCCESS,
        Ok(faults) => {
            for fault in faults {
                eprintln!("error: {fault}");
            }
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Builds, runs and compares all programs; returns the faults.
fn run(arguments: &Arguments) -> Result<Vec<String>, Box<dyn Error>> {
    let versions = tools::versions()?;
    println!("{}", versions.join("\n"));
    let compiler = versions.first().and_then(|it| it.split(' ').nth(1));
    let compiler = compiler.ok_or("the compiler does not say its version")?;
    let are_all = arguments.all || arguments.write;
    let is_chosen = |program: &Program| match &arguments.only {
        Some(only) => program.to_string().contains(only),
        None => are_all || program.is_representative(),
    };
    let (programs, left_out): (Vec<Program>, Vec<Program>) =
        Program::all().into_iter().partition(is_chosen);
    modules::write()?;
    let mut faults = Vec::new();
    let host_outputs = Printed::read_all(&build::host("host,std")?)?;
    if arguments.only.is_none() {
        compare_hosts(&host_outputs, &mut faults)?;
        find_planted(&mut faults)?;
    }
    let mut known = measured(&programs, &mut faults)?;
    known.sort_by_key(|it| it.program);
    let mut figures = Figures::new();
    for known in &known {
        let printed = &known.printed;
        println!(
            "{}: {:.0} ({}) instructions a frame, {} bytes of flash, error {:.1e}, {} functions, {} with calls through pointers",
            known.program,
            printed.advance.mean(),
            printed.advance.worst,
            known.flash(),
            known.error,
            known.extent[0],
            known.extent[1]
        );
        known.add_to(&mut figures);
        faults.extend(known.faults());
        let host = &host_outputs[&known.program.variant()];
        if known.program.language != Language::ByHand {
            let difference = host.difference(printed);
            faults.extend(
                difference
                    .map(|it| format!("{}: other bits than on the host: {it}", known.program)),
            );
        }
    }
    if arguments.write && arguments.only.is_none() {
        fs::write(
            files::package("reports/embedded.md"),
            report::text(&versions, &known),
        )?;
        limits::write(compiler, &figures)?;
    } else if arguments.only.is_none() {
        let left_out = left_out.iter().map(ToString::to_string).collect();
        faults.extend(limits::exceeded(compiler, &figures, &left_out)?);
    }
    Ok(faults)
}

/// Builds and runs programs, the C ones beside those in Rust. While one runs, the next is built. A failed one is a
/// fault.
fn measured(programs: &[Program], faults: &mut Vec<String>) -> io::Result<Vec<Known>> {
    let (in_rust, in_c): (Vec<Program>, Vec<Program>) = programs
        .iter()
        .partition(|it| it.language == Language::Rust);
    let look = |program: Program, built: io::Result<build::Built>| {
        let known = built.and_then(|built| {
            let text = build::run(&built.elf, program.processor)?;
            Known::of(program, &built, &text)
        });
        known.map_err(|error| format!("{program}: {error}"))
    };
    let measurements: Vec<Result<Known, String>> = thread::scope(|scope| {
        let (send, receive) = mpsc::channel();
        let runner = scope.spawn(move || {
            let built = receive.into_iter();
            built
                .map(|(program, built)| look(program, built))
                .collect::<Vec<_>>()
        });
        let builder = scope.spawn(move || {
            let mut known = Vec::new();
            for processor in Processor::ALL {
                let mut compiler = Compiler::for_board(processor);
                let programs = in_c.iter().filter(|it| it.processor == processor);
                known.extend(programs.map(|it| look(*it, compiler.firmware(it))));
            }
            known
        });
        for program in in_rust {
            let built = build::rust(&program, None);
            if send.send((program, built)).is_err() {
                break;
            }
        }
        drop(send);
        let joined = [runner.join(), builder.join()].map(|it| it.ok());
        let [Some(rust), Some(c)] = joined else {
            return Err(io::Error::other("a thread panicked"));
        };
        Ok(rust.into_iter().chain(c).collect())
    })?;
    let mut known = Vec::new();
    for measurements in measurements {
        match measurements {
            Ok(measurements) => known.push(measurements),
            Err(fault) => faults.push(fault),
        }
    }
    Ok(known)
}

/// Compares programs of the host: without the standard library, as WebAssembly, in C.
fn compare_hosts(
    wanted: &BTreeMap<String, Printed>,
    faults: &mut Vec<String>,
) -> Result<(), Box<dyn Error>> {
    for (name, text) in [
        ("without std", build::host("host")?),
        ("WebAssembly", build::wasm()?),
    ] {
        let printed = Printed::read_all(&text)?;
        for (variant, wanted) in wanted {
            let difference = printed
                .get(variant)
                .map_or(Some("it is not there".to_string()), |it| {
                    wanted.difference(it)
                });
            faults.extend(difference.map(|it| format!("{variant}, {name}: {it}")));
        }
        println!("{name}: {} variants compared", printed.len());
    }
    let mut compiler = Compiler::for_host();
    for (mechanism, (name, _)) in MECHANISMS.iter().enumerate() {
        for scalar in [Scalar::F32, Scalar::F64] {
            let printed = Printed::read(&compiler.answers(mechanism, scalar)?)?;
            let variant = format!("{name}_{}", scalar.name());
            let difference = wanted[&variant].difference(&printed);
            faults.extend(difference.map(|it| format!("{variant}, C on the host: {it}")));
        }
    }
    println!("C on the host: compared");
    Ok(())
}

/// Checks that planted faults are detected.
fn find_planted(faults: &mut Vec<String>) -> io::Result<()> {
    let is_meant = |program: &Program| {
        let Program {
            processor,
            scalar,
            language,
            is_guarded,
            ..
        } = *program;
        (processor, scalar, language, is_guarded)
            == (Processor::CortexM4F, Scalar::F32, Language::Rust, false)
            && program.mechanism() == "four_bar"
    };
    let Some(program) = Program::all().into_iter().find(is_meant) else {
        return Err(io::Error::other("no program to plant in"));
    };
    match build::rust(&program, Some("planted_panic")) {
        Err(error) if error.to_string().contains("PANIC_PATH") => {
            println!("a planted panic does not link")
        }
        Err(error) => return Err(error),
        Ok(_) => faults.push("a planted panic links".to_string()),
    }
    for (feature, name) in [
        ("planted_formatting", "core::fmt"),
        ("planted_textbook", "::phi_q"),
    ] {
        let built = build::rust(&program, Some(feature))?;
        let names = symbols::forbidden(&program, &built.elf)?;
        match names.iter().any(|it| it.contains(name)) {
            true => println!("{feature}: {} names are names", names.len()),
            false => faults.push(format!("{feature} is not names")),
        }
    }
    let built = build::rust(&program, Some("planted_recursion"))?;
    let functions = Calls::read(&built.elf)?.recursive(&["main"]);
    match functions.iter().any(|it| it.contains("planted::recursion")) {
        true => println!("planted_recursion: {functions:?}"),
        false => faults.push("planted_recursion is not functions".to_string()),
    }
    Ok(())
}
