//! Puts the program that is written out beside a fuller one of the same mechanism.

use linkwright_codegen::stages::expr::SymbolId;
use linkwright_codegen::stages::program::Output;

use super::Interpreted;
use crate::emitted::{Emitted, OutputSlots};
use crate::view::View as _;

/// Returns the blocks of the emitted program with the values that it shares with a fuller one.
pub(super) fn beside(blocks: Interpreted, fuller: &Interpreted) -> Emitted<Interpreted> {
    let layouts = [fuller.layout(), blocks.layout()];
    let slots = |symbol: SymbolId| {
        let [of_fuller, of_emitted] = layouts.map(|it| it.slot(symbol));
        Some([of_fuller?, of_emitted?])
    };
    let coordinates = fuller.system().coordinates.iter();
    let coordinates = coordinates.flat_map(|it| [it.position, it.rate, it.acceleration]);
    let forces = fuller.reported.iter().zip(&blocks.reported);
    let forces = forces.filter_map(|(fuller, emitted)| Some([(*fuller)?, (*emitted)?]));
    let equal = coordinates.filter_map(slots).chain(forces).collect();
    let points = points(&blocks, fuller);
    Emitted {
        blocks,
        equal,
        points,
    }
}

/// Returns the points that the emitted program outputs.
fn points(blocks: &Interpreted, fuller: &Interpreted) -> Vec<OutputSlots> {
    let mut points = Vec::new();
    for output in blocks.program().outputs.iter().flatten() {
        let Output::Point { name, fields } = output else {
            continue;
        };
        // Outputs are named in lower case.
        let mut names = fuller.points.names().iter();
        let point = names.position(|it| it.to_lowercase() == *name);
        for (level, symbols) in fields.iter().enumerate() {
            let slots = symbols.map(|it| blocks.layout().slot(it));
            if let (Some(point), [Some(x), Some(y)]) = (point, slots) {
                points.push(OutputSlots {
                    point,
                    level,
                    slots: [x, y],
                });
            }
        }
    }
    points
}
