//! Writes the verification that a frame lies on the path of the last frame.

use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::path_enclosures::iterated;
use crate::emit::module::scope::{Place, Scope};
use crate::program::Path;

/// Declares the functions of [`path`], which stand at the end.
pub(super) fn declarations(printer: &Printer<'_>, text: &mut Code) {
    let Some(path) = &printer.module.program.path else {
        return;
    };
    text.gap();
    text.comment(["Defined in the last section."]);
    text.line(format!("{};", head(printer, "verify_path", true)));
    if !iterated(printer.module.program, printer.module.system, path).is_empty() {
        text.line(format!("{};", within_head(printer)));
    }
    if path.closed.is_some() {
        text.line(format!("{};", head(printer, "verify_nonsingular", false)));
    }
}

/// Writes `verify_path`, `is_within` if blocks need Newton-Raphson, and `verify_nonsingular` if all blocks are closed forms.
pub(super) fn path(printer: &Printer<'_>, text: &mut Code) {
    let Some(path) = &printer.module.program.path else {
        return;
    };
    let scope = Scope::new(printer.module, &path.function, Place::Path);
    let mut body = Code::default();
    printer.plain_statements(&scope, &mut body);
    fill_enclosures(printer, path, &scope, &mut body);
    text.gap();
    text.comment([RULER]);
    text.comment(documentation::of_path(printer.module.program));
    text.comment([RULER]);
    text.gap();
    text.comment(documentation::VERIFY_PATH);
    shown(printer, "verify_path", true, body, text);
    within(printer, path, text);
    if let Some(function) = &path.closed {
        let scope = Scope::new(printer.module, function, Place::Path);
        let mut body = Code::default();
        printer.plain_statements(&scope, &mut body);
        text.gap();
        text.comment(documentation::VERIFY_NONSINGULAR);
        shown(printer, "verify_nonsingular", false, body, text);
    }
}

/// Line that sets a section apart.
const RULER: &str = "----------------------------------------------------------------------------------------------------";

/// Returns the head of a verification.
fn head(printer: &Printer<'_>, name: &str, has_enclosures: bool) -> String {
    let runtime = |name| printer.runtime(name);
    let enclosures = match has_enclosures {
        true => format!("{} *enclosures, ", runtime("enclosure")),
        false => String::new(),
    };
    format!(
        "LINKWRIGHT_FUNCTION static bool {}(const {} *pair, const {} *window, {enclosures}uint16_t *block)",
        printer.own(name),
        runtime("pair"),
        runtime("time_window"),
    )
}

fn within_head(printer: &Printer<'_>) -> String {
    format!(
        "LINKWRIGHT_FUNCTION static bool {}(const void *found, const {} *enclosures, {} steps)",
        printer.own("is_within"),
        printer.runtime("enclosure"),
        printer.real()
    )
}

/// Writes a verification, with or without enclosures.
fn shown(printer: &Printer<'_>, name: &str, has_enclosures: bool, body: Code, text: &mut Code) {
    text.line(head(printer, name, has_enclosures));
    text.open("{");
    let [frame, parameters, inputs] =
        ["Frame", "Parameters", "Inputs"].map(|it| printer.type_of(it));
    let real = printer.real();
    let taken = [
        (
            "at",
            format!("const {frame} *const at = (const {frame} *)pair->at;"),
        ),
        (
            "last",
            format!("const {frame} *const last = (const {frame} *)pair->last;"),
        ),
        (
            "before",
            format!("const {inputs} *const before = (const {inputs} *)pair->before;"),
        ),
        (
            "inputs",
            format!("const {inputs} *const inputs = (const {inputs} *)pair->conditions->inputs;"),
        ),
        (
            "parameters",
            format!(
                "const {parameters} *const parameters = (const {parameters} *)pair->conditions->parameters;"
            ),
        ),
        ("t", format!("const {real} t = pair->conditions->t;")),
    ];
    let mut reads_pair = false;
    for (name, line) in taken {
        if body.mentions(name) {
            text.line(line);
            reads_pair = true;
        }
    }
    let arguments = [
        ("pair", reads_pair),
        ("window", body.mentions("window")),
        ("enclosures", !has_enclosures || body.mentions("enclosures")),
        ("block", body.mentions("block")),
    ];
    for (name, _) in arguments.into_iter().filter(|(_, is_read)| !is_read) {
        text.line(format!("(void){name};"));
    }
    text.append(body);
    text.line("return true;");
    text.close("}");
}

/// Fills the enclosures of unknowns that Newton-Raphson finds.
fn fill_enclosures(printer: &Printer<'_>, path: &Path, scope: &Scope<'_>, text: &mut Code) {
    let module = printer.module;
    let iterated = iterated(module.program, module.system, path);
    for (place, (symbol, deviation)) in iterated.iter().enumerate() {
        let [now, before] = ["at", "last"].map(|frame| printer.field(*symbol, frame));
        let deviation = match deviation {
            Some(deviation) => printer.symbol(*deviation, scope),
            None => printer.number(0.0),
        };
        let enclosure = printer.runtime("enclosure_of");
        text.line(format!(
            "enclosures[{place}] = {enclosure}({now}, {before}, {deviation});"
        ));
    }
}

/// Writes the check of values that Newton-Raphson finds.
fn within(printer: &Printer<'_>, path: &Path, text: &mut Code) {
    let module = printer.module;
    let iterated = iterated(module.program, module.system, path);
    if iterated.is_empty() {
        return;
    }
    let (frame, holds) = (printer.type_of("Frame"), printer.runtime("enclosure_holds"));
    text.gap();
    text.comment([documentation::IS_WITHIN]);
    text.line(within_head(printer));
    text.open("{");
    text.line(format!("const {frame} *const at = (const {frame} *)found;"));
    text.line("bool is_within = true;");
    for (place, (symbol, _)) in iterated.iter().enumerate() {
        let value = printer.field(*symbol, "at");
        text.line(format!(
            "is_within = is_within && {holds}(&enclosures[{place}], {value}, steps);"
        ));
    }
    text.line("return is_within;");
    text.close("}");
}
