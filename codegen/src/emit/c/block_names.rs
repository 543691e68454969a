//! Writes tables of names for messages about failures: blocks with their singular poses, requirements, loads, ranges and drivers.

use super::comment::quoted;
use super::limits;
use super::loads;
use super::parameters::requirement_names;
use super::printer::Printer;
use super::ranges;
use super::transmission::drivers;
use crate::emit::code::Code;
use crate::emit::module::documentation;

/// Declares the tables in the header.
pub(super) fn declarations(printer: &Printer<'_>, text: &mut Code) {
    let count = printer.module.program.blocks.len();
    text.gap();
    text.comment([
        "Names of the blocks in solve order, with descriptions of their singular poses.",
    ]);
    text.line(format!(
        "extern const linkwright_block_name {}[{}];",
        printer.constant("BLOCKS"),
        count.max(1)
    ));
    if let (Some(names), Some(requirements)) = (
        requirement_names(printer),
        &printer.module.program.requirements,
    ) {
        text.comment([documentation::of_requirements(requirements)]);
        text.line(format!(
            "extern const linkwright_block_name {}[{}];",
            printer.constant("REQUIREMENTS"),
            names.len()
        ));
    }
    loads::declaration(printer, text);
    ranges::declarations(printer, text);
    let drivers = drivers(printer);
    if !drivers.is_empty() {
        text.comment(["Drivers in written order, one for each column of a transmission."]);
        text.line(format!(
            "extern const char *const {}[{}];",
            printer.constant("DRIVERS"),
            drivers.len()
        ));
    }
    let limits = limits::names(printer);
    if !limits.is_empty() {
        text.comment([crate::emit::module::limits::NAMES]);
        text.line(format!(
            "extern const char *const {}[{}];",
            printer.constant("LIMITS"),
            limits.len()
        ));
    }
}

/// Defines the tables.
pub(super) fn definitions(printer: &Printer<'_>, text: &mut Code) {
    let names = printer.module.words.iter();
    let names: Vec<[String; 2]> = names
        .map(|it| [quoted(&it.name), quoted(&it.singular)])
        .collect();
    table(printer, "BLOCKS", &names, text);
    if let Some(names) = requirement_names(printer) {
        table(printer, "REQUIREMENTS", &names, text);
    }
    loads::definition(printer, text);
    ranges::definitions(printer, text);
    let drivers = drivers(printer);
    if !drivers.is_empty() {
        text.gap();
        text.line(format!(
            "const char *const {}[{}] = {{{}}};",
            printer.constant("DRIVERS"),
            drivers.len(),
            drivers.join(", ")
        ));
    }
    let limits = limits::names(printer);
    if !limits.is_empty() {
        text.gap();
        text.line(format!(
            "const char *const {}[{}] = {{{}}};",
            printer.constant("LIMITS"),
            limits.len(),
            limits.join(", ")
        ));
    }
}

fn table(printer: &Printer<'_>, name: &str, names: &[[String; 2]], text: &mut Code) {
    let constant = printer.constant(name);
    text.gap();
    if names.is_empty() {
        text.line(format!(
            "const linkwright_block_name {constant}[1] = {{{{\"\", \"\"}}}};"
        ));
        return;
    }
    text.open(format!(
        "const linkwright_block_name {constant}[{}] = {{",
        names.len()
    ));
    for [name, singular] in names {
        text.line(format!("{{{name}, {singular}}},"));
    }
    text.close("};");
}
