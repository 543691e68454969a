//! Writes the labels of loads, and the function that finds the first load that is not finite.

use super::comment::quoted;
use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::scope::{Place, Scope};
use crate::program::{Block, Loads};

fn loads<'a>(printer: &'a Printer<'_>) -> Option<&'a Loads> {
    printer.module.program.loads.as_ref()
}

fn table(printer: &Printer<'_>, loads: &Loads) -> String {
    let (constant, count) = (printer.constant("LOADS"), loads.labels.len());
    format!("const char *const {constant}[{count}]")
}

/// Declares the labels in the header.
pub(super) fn declaration(printer: &Printer<'_>, text: &mut Code) {
    if let Some(loads) = loads(printer) {
        text.comment([documentation::LOADS]);
        text.line(format!("extern {};", table(printer, loads)));
    }
}

/// Writes the labels.
pub(super) fn definition(printer: &Printer<'_>, text: &mut Code) {
    if let Some(loads) = loads(printer) {
        let labels: Vec<String> = loads.labels.iter().map(|it| quoted(it)).collect();
        text.gap();
        text.line(format!(
            "{} = {{{}}};",
            table(printer, loads),
            labels.join(", ")
        ));
    }
}

/// Writes the function that ascribes a failure to the first load that is not finite.
pub(super) fn function(printer: &Printer<'_>, text: &mut Code) {
    let Some(loads) = loads(printer) else {
        return;
    };
    let scope = Scope::new(printer.module, &loads.function, Place::Frame);
    let reads = scope.reads();
    let (real, frame) = (printer.real(), printer.type_of("Frame"));
    text.gap();
    text.comment([documentation::BLAMED_LOAD]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static LINKWRIGHT_APART linkwright_status {}(const {frame} *at, const {} *conditions)",
        printer.own("blame_load"),
        printer.runtime("conditions")
    ));
    text.open("{");
    if reads.time {
        text.line(format!("const {real} t = conditions->t;"));
    }
    for (is_read, name, kind) in [
        (reads.parameters, "parameters", "Parameters"),
        (reads.inputs, "inputs", "Inputs"),
    ] {
        if is_read {
            let kind = printer.type_of(kind);
            text.line(format!(
                "const {kind} *const {name} = (const {kind} *)conditions->{name};"
            ));
        }
    }
    printer.plain_statements(&scope, text);
    let results = printer.results(&scope);
    text.line(printer.array("loads", &results));
    let read = loads.read.iter().map(|&it| printer.symbol(it, &scope));
    let read: Vec<String> = read.collect();
    let passed = match read.len() {
        0 => {
            text.line("(void)at;");
            "NULL".to_string()
        }
        _ => {
            text.line(printer.array("checked", &read));
            "checked".to_string()
        }
    };
    text.line(format!(
        "return {}({passed}, {}U, loads, {}U, conditions, {}U);",
        printer.runtime("load_not_finite"),
        read.len(),
        results.len(),
        loads.block
    ));
    text.close("}");
}

/// Writes the call that ascribes the failure of a block to a load, if loads may be its cause.
pub(super) fn blame(block: &Block, printer: &Printer<'_>, text: &mut Code) {
    let loaded =
        loads(printer).and_then(|it| printer.module.program.blocks.get(usize::from(it.block)));
    if loaded.is_some_and(|it| std::ptr::eq(it, block)) {
        text.open("if (status == LINKWRIGHT_NOT_FINITE) {");
        text.line(format!("status = {};", call(printer)));
        text.close("}");
    }
}

/// Returns the call that ascribes a failure to a load.
pub(super) fn call(printer: &Printer<'_>) -> String {
    format!("{}(at, conditions)", printer.own("blame_load"))
}
