//! Checks that counted instructions are within the operations that a header states for `advance`.

use linkwright_codegen::stages::program::{Operations, Work, work};

use super::figures::Known;
use super::program::{Language, Processor, Scalar};
use crate::description;

/// Work of a mechanism as its header states it.
///
/// # Panics
/// If its description has errors.
pub fn work_of(mechanism: &str) -> Work {
    crate::plan::report(&description::system(mechanism)).work
}

/// Largest number of instructions of a Cortex-M4F for these operations in f32, with the loads and stores of their
/// operands. The branches and copies of a frame are part of its operations' share.
fn instructions(operations: &Operations) -> usize {
    4 * (operations.additions + operations.multiplications + operations.divisions)
        + 50 * (operations.square_roots + operations.sines)
        + 70 * operations.arctangents
}

/// Contradictions to the header: fewer instructions than operations, or more than these can take.
pub fn outside(known: &Known) -> Vec<String> {
    let program = &known.program;
    let is_meant = (program.processor, program.scalar) == (Processor::CortexM4F, Scalar::F32)
        && program.language == Language::Rust
        && !program.is_small;
    if !is_meant {
        return Vec::new();
    }
    let work = work_of(program.mechanism());
    let guarded = work.window.filter(|_| program.is_guarded);
    let window = guarded.map_or(0, |it| {
        work::LOOKS * instructions(&it.look) + instructions(&it.last)
    });
    let attempt = instructions(&work.attempt);
    let (advance, long) = (known.printed.advance, known.printed.long);
    let mut contradictions = Vec::new();
    let mut ask = |what: &str, measured: u64, largest: usize| {
        if measured > largest as u64 {
            contradictions.push(format!(
                "{program}: {measured} instructions of {what}, and the header allows {largest}"
            ));
        }
    };
    ask("a frame", advance.worst, attempt + window);
    let unguarded = Work {
        window: None,
        ..work
    };
    let poses = if program.is_guarded {
        work.poses(work::SUBSTEPS)
    } else {
        unguarded.poses(work::SUBSTEPS)
    };
    ask(
        "a long step",
        long.worst,
        poses * attempt + work.windows(work::SUBSTEPS) * window,
    );
    if !work.is_iterated && (advance.mean() as usize) < work.attempt.total() {
        contradictions.push(format!("{program}: fewer instructions than operations"));
    }
    contradictions
}
