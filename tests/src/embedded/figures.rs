//! Measurements of firmware: its output, its contents, and its error beside the references.

use std::io;

use super::build::Built;
use super::calls::Calls;
use super::limits::Figures;
use super::printed::Printed;
use super::program::{Language, Program, Scalar};
use super::symbols::{self, PARTS, Part};
use super::work;
use crate::reference::{reference, yardsticks};

/// Functions that a loop calls, in Rust and in C.
const CALLED: [&str; 4] = [
    "motion::assemble",
    "motion::advance",
    "_assemble",
    "_advance",
];

/// Measurements of a program.
#[derive(Clone, Debug)]
pub struct Known {
    /// Program.
    pub program: Program,
    /// Output.
    pub printed: Printed,
    /// Bytes of flash of each part.
    pub parts: [u64; PARTS],
    /// Largest error beside the references, relative to the largest value of a column.
    pub error: f64,
    /// Names of forbidden symbols.
    pub forbidden: Vec<String>,
    /// Functions that may be on the stack twice.
    pub recursive: Vec<String>,
    /// Numbers of functions that `assemble` and `advance` reach, and of those that call through pointers.
    pub extent: [usize; 2],
}

impl Known {
    /// Measures a program that was built and has run.
    ///
    /// # Errors
    /// One of its files cannot be read, or its output is not as expected.
    pub fn of(program: Program, built: &Built, text: &str) -> io::Result<Self> {
        let named = |error: io::Error| io::Error::other(format!("{program}: {error}"));
        let printed = Printed::read(text).map_err(named)?;
        let calls = Calls::read(&built.elf)?;
        Ok(Known {
            error: error(program.mechanism(), &printed, program.scalar),
            parts: symbols::parts(&program, built)?,
            forbidden: symbols::forbidden(&program, &built.elf)?,
            recursive: calls.recursive(&CALLED),
            extent: calls.extent(&CALLED),
            program,
            printed,
        })
    }

    /// Bytes of flash without the program that moves the mechanism.
    pub fn flash(&self) -> u64 {
        self.parts[..Part::Harness as usize].iter().sum()
    }

    /// Faults of the program by itself.
    pub fn faults(&self) -> Vec<String> {
        let Known {
            program,
            error,
            forbidden,
            recursive,
            ..
        } = self;
        let mut faults = Vec::new();
        // The limits of the tests of references; in f32 the same number of roundings.
        let limit = match program.scalar {
            Scalar::F64 => 1e-13,
            Scalar::F32 => 1e-13 * (f64::from(f32::EPSILON) / f64::EPSILON),
        };
        let is_near = *error <= limit;
        if !is_near {
            faults.push(format!(
                "{program}: {error:.1e} from the references, more than {limit:.1e}"
            ));
        }
        if !forbidden.is_empty() {
            faults.push(format!("{program}: it holds {forbidden:?}"));
        }
        // In C the runtime holds the functions of every mechanism by pointers, so that the calls behind them are
        // unknown.
        if program.language == Language::Rust && !recursive.is_empty() {
            faults.push(format!(
                "{program}: these may call themselves: {recursive:?}"
            ));
        }
        faults.extend(work::outside(self));
        faults
    }

    /// Adds the values that are compared with the committed figures.
    pub fn add_to(&self, figures: &mut Figures) {
        let Printed {
            state,
            assemble,
            advance,
            long,
            ..
        } = &self.printed;
        let mut add = |figure, value| figures.insert((self.program.to_string(), figure), value);
        add("state", *state);
        add("flash", self.flash());
        add("assemble instructions", assemble.total);
        add("assemble stack", assemble.stack);
        add("advance mean instructions", advance.mean().round() as u64);
        add("advance worst instructions", advance.worst);
        add("advance stack", advance.stack);
        add("long step worst instructions", long.worst);
        add("long step stack", long.stack);
    }
}

/// Largest error of the frames, which are printed unrounded, beside the references.
///
/// # Panics
/// If the program has not printed the frames of the references.
fn error(mechanism: &str, printed: &Printed, scalar: Scalar) -> f64 {
    let table = reference(mechanism);
    let frames = printed.frames(scalar);
    assert_eq!(frames.len(), table.rows.len(), "{mechanism}");
    let yardsticks = yardsticks(&table);
    let mut largest = 0.0_f64;
    for (frame, row) in frames.iter().zip(&table.rows) {
        assert_eq!((frame.len(), frame[0]), (row.len(), row[0]), "{mechanism}");
        for ((value, wanted), yardstick) in frame.iter().zip(row).skip(1).zip(&yardsticks) {
            let relative = (value - wanted).abs() / yardstick;
            // NaN is the largest error.
            largest = if relative <= largest {
                largest
            } else {
                relative
            };
        }
    }
    largest
}
