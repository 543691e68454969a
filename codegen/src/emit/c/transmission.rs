//! Writes transmissions as functions of a frame.

use super::comment::quoted;
use super::points::Offered;
use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::program::Transmission;

/// Names of the drivers, one per column of a transmission; empty if none is requested.
pub(super) fn drivers(printer: &Printer<'_>) -> Vec<String> {
    let module = printer.module;
    if module.program.transmissions.is_empty() {
        return Vec::new();
    }
    let joints = &module.system.mechanism.joints;
    let driven = module.system.driven();
    driven
        .map(|(_, joint, _)| quoted(&joints[joint].label))
        .collect()
}

/// Functions of all transmissions.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let transmissions = printer.module.program.transmissions.iter();
    transmissions
        .flat_map(|it| functions(it, printer))
        .collect()
}

fn functions(transmission: &Transmission, printer: &Printer<'_>) -> [Offered; 2] {
    let Transmission {
        name,
        rows,
        columns,
        ..
    } = transmission;
    let (real, frame) = (printer.real(), printer.type_of("Frame"));
    let [about_rates, about_forces] =
        documentation::of_transmission(transmission, printer.module.system);
    let (height, number, is_point) = (rows.len(), columns.len(), rows.len() == 2);
    let field = |symbol| printer.field(symbol, "frame");
    let mut rates = Code::default();
    for row in 0..height {
        for (column, symbols) in columns.iter().enumerate() {
            rates.line(format!("found[{row}][{column}] = {};", field(symbols[row])));
        }
    }
    let mut forces = Code::default();
    for (column, symbols) in columns.iter().enumerate() {
        let products = symbols
            .iter()
            .enumerate()
            .map(|(row, &symbol)| match is_point {
                true => format!("{} * force[{row}]", field(symbol)),
                false => format!("{} * load", field(symbol)),
            });
        let products: Vec<String> = products.collect();
        forces.line(format!("found[{column}] = {};", products.join(" + ")));
    }
    let load = match is_point {
        true => format!("const {real} force[2]"),
        false => format!("{real} load"),
    };
    let rate = printer.function(&format!("transmission_{name}"));
    let force = printer.function(&format!("forces_{name}"));
    [
        Offered {
            lines: about_rates,
            declaration: format!(
                "void {rate}(const {frame} *frame, {real} found[{height}][{number}])"
            ),
            body: rates,
        },
        Offered {
            lines: about_forces,
            declaration: format!(
                "void {force}(const {frame} *frame, {load}, {real} found[{number}])"
            ),
            body: forces,
        },
    ]
}
