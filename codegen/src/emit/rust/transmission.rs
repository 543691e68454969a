//! Writes transmissions as methods of a frame.

use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::{Module, documentation};
use crate::expr::SymbolId;
use crate::program::Transmission;

/// Writes the methods of all transmissions, and the list of drivers; nothing if none is requested.
pub(super) fn transmissions(module: &Module<'_>, code: &mut Code) {
    let (system, program) = (module.system, module.program);
    if program.transmissions.is_empty() {
        return;
    }
    let joints = &system.mechanism.joints;
    let labels = system
        .driven()
        .map(|(_, joint, _)| format!("{:?}", joints[joint].label));
    let labels: Vec<String> = labels.collect();
    code.gap();
    code.docs(["Drivers in written order, one for each column of a transmission."]);
    code.line(format!(
        "pub const DRIVERS: [&'static str; {}] = [{}];",
        labels.len(),
        labels.join(", ")
    ));
    for transmission in &program.transmissions {
        functions(transmission, module, code);
    }
}

fn functions(transmission: &Transmission, module: &Module<'_>, code: &mut Code) {
    let Transmission {
        name,
        rows,
        columns,
        ..
    } = transmission;
    let (height, number) = (rows.len(), columns.len());
    let [about_rates, about_forces] = documentation::of_transmission(transmission, module.system);
    let fields_of =
        |column: &Vec<SymbolId>| column.iter().map(|&it| module.field(it, "self")).collect();
    let fields: Vec<Vec<String>> = columns.iter().map(fields_of).collect();
    let matrix = fields
        .iter()
        .map(|column| format!("[{}]", column.join(", ")));
    let matrix: Vec<String> = matrix.collect();
    code.getter(
        about_rates,
        &identifier(&format!("transmission_{name}")),
        &format!("Matrix<{height}, {number}>"),
        format!("Matrix::from([{}])", matrix.join(", ")),
    );
    let (argument, load): (_, &[&str]) = match height {
        2 => ("force: [Scalar; 2]", &["force[0]", "force[1]"]),
        _ => ("load: Scalar", &["load"]),
    };
    let forces = fields.iter().map(|column| {
        let products = column
            .iter()
            .zip(load)
            .map(|(rate, load)| format!("{rate} * {load}"));
        products.collect::<Vec<_>>().join(" + ")
    });
    let forces: Vec<String> = forces.collect();
    let mut statements = Code::default();
    statements.line(format!("Vector::from([{}])", forces.join(", ")));
    let name = identifier(&format!("forces_{name}"));
    let head = format!("pub fn {name}(&self, {argument}) -> Vector<{number}>");
    code.function(about_forces, [], &head, statements);
}
