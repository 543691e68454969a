//! Whether a frame lies on the path of the last one.

use super::printer::Printer;
use super::text::Text;
use crate::emit::module::documentation;
use crate::emit::module::path_enclosures::iterated;
use crate::emit::module::scope::{Place, Scope};
use crate::program::Path;

/// `verify_path`, `is_within` where Newton-Raphson finds something, and `verify_nonsingular` where all is in closed form.
pub(super) fn path(printer: &Printer<'_>, text: &mut Text) {
    let Some(path) = &printer.module.program.path else {
        return;
    };
    let scope = Scope::new(printer.module, &path.function, Place::Path);
    let mut body = Text::default();
    printer.plain_statements(&scope, &mut body);
    fill_enclosures(printer, path, &scope, &mut body);
    text.gap();
    text.comment([documentation::KEEPS_TO_PATH.join(" ")]);
    shown(printer, "verify_path", true, body, text);
    within(printer, path, text);
    if let Some(function) = &path.closed {
        let scope = Scope::new(printer.module, function, Place::Path);
        let mut body = Text::default();
        printer.plain_statements(&scope, &mut body);
        text.gap();
        text.comment([documentation::STAYS_REGULAR.join(" ")]);
        shown(printer, "verify_nonsingular", false, body, text);
    }
}

/// A function that shows something of a window, and is given the enclosures or not.
fn shown(printer: &Printer<'_>, name: &str, has_enclosures: bool, body: Text, text: &mut Text) {
    let runtime = |name| printer.runtime(name);
    let enclosures = match has_enclosures {
        true => format!("{} *enclosures, ", runtime("enclosure")),
        false => String::new(),
    };
    text.line(format!(
        "static bool {}(const {} *pair, const {} *window, {enclosures}uint16_t *block)",
        printer.own(name),
        runtime("pair"),
        runtime("time_window"),
    ));
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
    let given = [
        ("pair", reads_pair),
        ("window", body.mentions("window")),
        ("enclosures", !has_enclosures || body.mentions("enclosures")),
        ("block", body.mentions("block")),
    ];
    for (name, _) in given.into_iter().filter(|(_, is_read)| !is_read) {
        text.line(format!("(void){name};"));
    }
    text.append(body);
    text.line("return true;");
    text.close("}");
}

/// What fills the enclosures of unknowns that Newton-Raphson finds.
fn fill_enclosures(printer: &Printer<'_>, path: &Path, scope: &Scope<'_>, text: &mut Text) {
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

/// Whether what Newton-Raphson has found is where the path is.
fn within(printer: &Printer<'_>, path: &Path, text: &mut Text) {
    let module = printer.module;
    let iterated = iterated(module.program, module.system, path);
    if iterated.is_empty() {
        return;
    }
    let (frame, holds) = (printer.type_of("Frame"), printer.runtime("enclosure_holds"));
    text.gap();
    text.comment(["Whether what Newton-Raphson has found is where the path is."]);
    text.line(format!(
        "static bool {}(const void *found, const {} *enclosures, {} steps)",
        printer.own("is_within"),
        printer.runtime("enclosure"),
        printer.real()
    ));
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
