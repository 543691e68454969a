//! Writes the functions of a frame that return normalized determinants.

use super::points::Offered;
use super::printer::Printer;
use crate::emit::code::Code;
use crate::program::Measured;

/// Returns the number of measured loops; `None` if the description has no `monitor`.
pub(super) fn count(printer: &Printer<'_>) -> Option<usize> {
    let blocks = printer.module.program.blocks.iter();
    let monitors = printer.module.system.mechanism.monitor;
    monitors.then(|| blocks.map(|block| block.measured.len()).sum())
}

/// Functions for all loops and for the smallest value.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let Some(number) = count(printer) else {
        return Vec::new();
    };
    let (frame, found) = (
        printer.type_of("Frame"),
        printer.runtime("normalized_determinant"),
    );
    let field = |symbol| printer.field(symbol, "frame");
    let mut body = Code::default();
    let mut place = 0;
    for (index, block) in printer.module.program.blocks.iter().enumerate() {
        for measured in &block.measured {
            match measured {
                Measured::Sine(sine) => {
                    let call = printer.runtime("of_sine");
                    body.line(format!(
                        "found[{place}] = {call}({index}U, {});",
                        field(*sine)
                    ));
                }
                Measured::Slope(slope) => {
                    let call = printer.runtime("of_slope");
                    body.line(format!(
                        "found[{place}] = {call}({index}U, {});",
                        field(*slope)
                    ));
                }
                Measured::Block([determinant, condition]) => {
                    body.line(format!("found[{place}].block = {index}U;"));
                    let (determinant, condition) = (field(*determinant), field(*condition));
                    body.line(format!("found[{place}].determinant = {determinant};"));
                    body.line(format!(
                        "found[{place}].reciprocal_condition = {condition};"
                    ));
                }
            }
            place += 1;
        }
    }
    if number == 0 {
        body.line("(void)frame;");
        body.line("(void)found;");
    }
    let room = number.max(1);
    let all = printer.function("normalized_determinants");
    let mut closest = Code::default();
    closest.line(format!("{found} found[{room}];"));
    closest.line(format!("{all}(frame, found);"));
    closest.line(format!(
        "return {}(found, {number}U);",
        printer.runtime("closest")
    ));
    let nothing = if number == 0 { " There is none." } else { "" };
    vec![
        Offered {
            lines: vec![format!(
                "Finds the normalized determinant of each loop, in solve order; see the runtime's structure.{nothing}"
            )],
            declaration: format!("void {all}(const {frame} *frame, {found} found[{room}])"),
            body,
        },
        Offered {
            lines: vec![
                "Returns the smallest normalized determinant of all loops; its numbers are 1 if no block can be singular."
                    .to_string(),
            ],
            declaration: printer.of_frame(&found, "smallest_determinant"),
            body: closest,
        },
    ]
}
