//! Writes `tests/reports/embedded.md` from the measurements of all programs.

use std::fmt::Write as _;

use super::figures::Known;
use super::program::{Language, MECHANISMS, Processor, Scalar};
use super::symbols::TITLES;
use super::work::work_of;
use crate::study::table::aligned;

/// Targets for frames of f32 on the Cortex-M4F: instructions of `advance`, in the mean.
const FRAMES: [(&str, u64); 4] = [
    ("four_bar", 420),
    ("excavator", 2300),
    ("arm", 2450),
    ("platform_3rpr", 5000),
];

/// Targets for flash in bytes; true if compiled for size.
const FLASH: [(&str, bool, u64); 4] = [
    ("four_bar", false, 6_000),
    ("excavator", false, 14_000),
    ("platform_3rpr", false, 36_000),
    ("platform_3rpr", true, 24_000),
];

const BEGINNING: &str = "\
# Mechanisms as firmware

Written by `cargo run -p linkwright-tests --bin embedded -- --write`; without `--write` it compares with what is committed,
and fails where a figure has grown by more than 5 % with the same compiler. The programs are in `tests/embedded`: firmware of one mechanism each, for the boards
mps2-an386 (Cortex-M4F) and mps2-an500 (Cortex-M7) of QEMU, which counts instructions. It has no model of cycles.

A program assembles the mechanism, requests a frame every 1/1024 s for 5 s, then takes 24 steps of 0.195 s, forwards and back, three of them
to times that are NaN. A frame is position, velocity and acceleration of all bodies.
";

const GUARD: &str = "\
`advance` shows that each frame lies on the smooth path from the last one. It does so for a whole window of time at once: the worst frame
is one that opens a window. With `unguarded;` in the description it does not. Long steps do not succeed in one attempt and are taken in
several; the worst one is the worst that a loop meets which has missed its time by 0.2 s. C by hand is `tests/embedded/c/by_hand`, with the
functions of newlib and without any check. `assemble` runs once, before the loop.
Operations are those that the header of the module states for one attempt of `advance`.
";

/// The whole report.
pub fn text(versions: &[String], known: &[Known]) -> String {
    let mut text = format!(
        "{BEGINNING}\nCompilers:\n\n{}",
        versions
            .iter()
            .map(|it| format!("- {it}\n"))
            .collect::<String>()
    );
    text += "\n## The same bits everywhere\n\n";
    let frames = known.first().map_or(0, |it| it.printed.advance.calls);
    let _ = writeln!(
        text,
        "All numbers of all {frames} frames, of the long steps and of the failures are the same on x86-64 with the standard library, on x86-64 without it, on
WebAssembly under Node.js, in C on x86-64, and in Rust and C on both processors. Largest errors beside the committed references, relative to
the largest value of a column:\n"
    );
    text += &errors(known);
    text += &format!("\n## Instructions\n\n{GUARD}");
    for processor in Processor::ALL {
        for scalar in [Scalar::F32, Scalar::F64] {
            let _ = write!(text, "\n### {}, {}\n\n", processor.title(), scalar.name());
            text += &instructions(known, processor, scalar);
        }
    }
    text += "\n### Aims\n\nInstructions of `advance` in the mean, and bytes of flash, in f32 on the Cortex-M4F.\n\n";
    text += &aims(known);
    text += "\n## Memory\n\nBytes. The stack is how far below the call it was written to; that of long steps is the deepest there is. Flash is that of\nthe whole program by part, without what moves the mechanism and measures.\n";
    for processor in Processor::ALL {
        for scalar in [Scalar::F32, Scalar::F64] {
            let _ = write!(text, "\n### {}, {}\n\n", processor.title(), scalar.name());
            text += &memory(known, processor, scalar);
        }
    }
    text += GUARANTEES;
    text
}

const GUARANTEES: &str = "
## What is not in the programs

The panic handler of the firmware calls a symbol that is never defined, so that a program with a panic path does not link. It has
no allocator. Neither formatting nor a function of the textbook view is among the symbols. In Rust no function that `assemble` or `advance`
reaches can be on the stack twice: the calls are read from the instructions, and a call through a pointer may lead to every function
whose address is in the program. A program with each of these planted is found. At opt-level s alone, checks are left that cannot fail, and
with them a panic path; that is why speed is what the others are compiled for.
";

fn select(known: &[Known], processor: Processor, scalar: Scalar) -> impl Iterator<Item = &Known> {
    let is_wanted =
        move |it: &&Known| (it.program.processor, it.program.scalar) == (processor, scalar);
    known.iter().filter(is_wanted)
}

/// Label of a program in a table of one processor and scalar.
fn title(known: &Known) -> String {
    let program = &known.program;
    let language = match (program.language, program.is_guarded) {
        (Language::Rust, true) => "Rust",
        (Language::Rust, false) => "Rust, unguarded",
        (Language::C, _) => "C",
        (Language::ByHand, _) => "C by hand",
    };
    let size = if program.is_small {
        ", opt-level s"
    } else {
        ""
    };
    format!("{language}{size}")
}

fn errors(known: &[Known]) -> String {
    let mut rows = vec![["mechanism", "f32", "f64"].map(String::from)];
    for (name, _) in MECHANISMS {
        let of = |scalar| {
            let programs = known
                .iter()
                .filter(|it| it.program.mechanism() == name && it.program.scalar == scalar);
            let programs = programs
                .filter(|it| it.program.language != Language::ByHand)
                .map(|it| it.error);
            format!("{:.1e}", programs.fold(0.0, f64::max))
        };
        rows.push([name.to_string(), of(Scalar::F32), of(Scalar::F64)]);
    }
    aligned(&rows, 1)
}

fn instructions(known: &[Known], processor: Processor, scalar: Scalar) -> String {
    let heading = [
        "mechanism",
        "program",
        "advance, mean",
        "advance, worst",
        "long step, mean",
        "long step, worst",
        "assemble",
        "operations",
    ];
    let mut rows = vec![heading.map(String::from)];
    for known in select(known, processor, scalar).filter(|it| !it.program.is_small) {
        let name = known.program.mechanism();
        let printed = &known.printed;
        rows.push([
            name.to_string(),
            title(known),
            format!("{:.0}", printed.advance.mean()),
            printed.advance.worst.to_string(),
            format!("{:.0}", printed.long.mean()),
            printed.long.worst.to_string(),
            printed.assemble.total.to_string(),
            operations(name),
        ]);
    }
    aligned(&rows, 2)
}

/// Operations of a frame as the header of the module counts them: those of a Newton block for all its iterations.
fn operations(name: &str) -> String {
    let work = work_of(name);
    let bound = if work.is_iterated { "≤ " } else { "" };
    format!("{bound}{}", work.attempt.total())
}

/// Targets beside measurements with the guard and without.
fn aims(known: &[Known]) -> String {
    let find = |name: &str, is_guarded: bool, is_small: bool| {
        select(known, Processor::CortexM4F, Scalar::F32).find(|it| {
            let program = &it.program;
            (program.language, program.is_guarded, program.is_small)
                == (Language::Rust, is_guarded, is_small)
                && program.mechanism() == name
        })
    };
    let mut rows = vec![["mechanism", "what", "aim", "unguarded", "guarded"].map(String::from)];
    let mut row = |name: &str, what: &str, aim: u64, [unguarded, guarded]: [u64; 2]| {
        let numbers = [aim, unguarded, guarded].map(|it| it.to_string());
        let [aim, unguarded, guarded] = numbers;
        rows.push([name.to_string(), what.to_string(), aim, unguarded, guarded]);
    };
    for (name, aim) in FRAMES {
        let mean =
            |is_guarded| find(name, is_guarded, false).map_or(0.0, |it| it.printed.advance.mean());
        row(
            name,
            "instructions",
            aim,
            [false, true].map(|it| mean(it).round() as u64),
        );
    }
    for (name, is_small, aim) in FLASH {
        let flash = |is_guarded| find(name, is_guarded, is_small).map_or(0, Known::flash);
        let what = if is_small {
            "flash, opt-level s"
        } else {
            "flash"
        };
        row(name, what, aim, [false, true].map(flash));
    }
    aligned(&rows, 2)
}

fn memory(known: &[Known], processor: Processor, scalar: Scalar) -> String {
    let [mechanism, runtime, functions, constants, compiler, _] = TITLES;
    let heading = [
        "mechanism",
        "program",
        "state",
        "stack of assemble",
        "of advance",
        "of long steps",
        "flash",
        mechanism,
        runtime,
        functions,
        constants,
        compiler,
    ];
    let mut rows = vec![heading.map(String::from)];
    for known in select(known, processor, scalar) {
        let printed = &known.printed;
        let [mechanism, runtime, functions, constants, compiler, _] = known.parts;
        let numbers = [
            printed.state,
            printed.assemble.stack,
            printed.advance.stack,
            printed.long.stack,
            known.flash(),
            mechanism,
            runtime,
            functions,
            constants,
            compiler,
        ];
        let mut cells = [const { String::new() }; 12];
        cells[0] = known.program.mechanism().to_string();
        cells[1] = title(known);
        for (cell, number) in cells[2..].iter_mut().zip(numbers) {
            *cell = number.to_string();
        }
        rows.push(cells);
    }
    aligned(&rows, 2)
}
