//! Writes what solves several mechanisms at once: structures of arrays with one element per lane, and loops over the lanes.
//!
//! Compilers vectorize the loops. A lane has the bits of a mechanism alone: a lane that fails a check is solved by the functions of one
//! mechanism. Device code has its own threads instead, and leaves the lanes out.

mod blocks;
mod elementary;
mod group;
mod loops;
mod structures;

use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::scalar::Scalar;

/// Line before everything that device code leaves out.
const BEGIN: &str = "#ifndef LINKWRIGHT_DEVICE";

impl Printer<'_> {
    /// Elementary function of one lane, which is inlined into loops.
    pub(super) fn lane(&self, name: &str) -> String {
        format!("lane_{name}")
    }

    /// Number of lanes, as a macro of the header.
    fn lanes(&self) -> String {
        self.constant("LANES")
    }

    /// Unsigned integer as wide as the numbers, so that loops with both are vectorized.
    fn word(&self) -> &'static str {
        match self.module.scalar {
            Scalar::F64 => "uint64_t",
            Scalar::F32 => "uint32_t",
        }
    }
}

/// Declares structures and functions of one motion.
pub(super) fn declarations(printer: &Printer<'_>, text: &mut Code) {
    text.gap();
    text.line(BEGIN);
    structures::structures(printer, text);
    group::declarations(printer, text);
    text.line("#endif");
}

/// Writes the functions that the loops of all motions call.
pub(super) fn functions(first: &Printer<'_>, printers: &[Printer<'_>], text: &mut Code) {
    let has_inputs = printers.iter().any(|it| it.declared().inputs);
    text.gap();
    text.line(BEGIN);
    elementary::functions(first, has_inputs, text);
    text.line("#endif");
}

/// Defines the functions of one motion.
pub(super) fn definitions(printer: &Printer<'_>, text: &mut Code) {
    text.gap();
    text.line(BEGIN);
    blocks::functions(printer, text);
    blocks::solve(printer, text);
    group::definitions(printer, text);
    text.line("#endif");
}
