//! Writes Φ, Φ_q, Φ_t and γ as functions.

use super::points::Offered;
use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::scope::{Place, Scope};
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::program::{Function, Lengths};
use crate::system::Row;

/// Functions of the textbook formulation, and of the residuals that are only monitored.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let Some(textbook) = &printer.module.program.textbook else {
        return Vec::new();
    };
    let system = printer.module.system;
    let mut about_phi = vec![documentation::PHI.to_string(), String::new()];
    about_phi.extend(documentation::of_rows(
        printer.module.pool,
        system,
        &system.rows,
    ));
    let line = |text: &str| vec![text.to_string()];
    let mut offered = vec![
        vector(printer, &textbook.residual, "phi", about_phi, |row| {
            row.residual
        }),
        matrix(printer, &textbook.jacobian),
        vector(
            printer,
            &textbook.time_derivative,
            "phi_t",
            line(documentation::PHI_T),
            |row| row.time_derivative,
        ),
        vector(
            printer,
            &textbook.gamma,
            "gamma",
            line(documentation::GAMMA),
            |row| row.gamma,
        ),
    ];
    if let Some(function) = &textbook.monitored {
        offered.push(monitored(printer, function));
    }
    offered
}

/// Returns a function with its arguments; those that the code does not read are cast to `void`.
fn function(
    printer: &Printer<'_>,
    name: &str,
    result: &str,
    scope: &Scope<'_>,
    lines: Vec<String>,
    code: Code,
) -> Offered {
    let (reads, declared) = (scope.reads(), printer.declared());
    let (real, coordinates) = (printer.real(), printer.type_of("Coordinates"));
    let with_rates = name == "gamma";
    let pointer = |kind: &str, name: &str| format!("const {} *{name}", printer.type_of(kind));
    let arguments = [
        (true, reads.position, format!("const {coordinates} *q"), "q"),
        (
            with_rates,
            reads.rate,
            format!("const {coordinates} *qd"),
            "qd",
        ),
        (
            declared.parameters,
            reads.parameters,
            pointer("Parameters", "parameters"),
            "parameters",
        ),
        (
            declared.inputs,
            reads.inputs,
            pointer("Inputs", "inputs"),
            "inputs",
        ),
        (true, reads.time, format!("{real} t"), "t"),
    ];
    let present = arguments.into_iter().filter(|(is_present, ..)| *is_present);
    let mut body = Code::default();
    let mut list = Vec::new();
    for (_, is_read, declared, name) in present {
        if !is_read {
            body.line(format!("(void){name};"));
        }
        list.push(declared);
    }
    list.push(format!("{real} {result}"));
    body.append(code);
    Offered {
        lines,
        declaration: format!("void {}({})", printer.function(name), list.join(", ")),
        body,
    }
}

fn vector(
    printer: &Printer<'_>,
    function_of: &Function,
    name: &str,
    lines: Vec<String>,
    of: fn(&Row) -> ExprId,
) -> Offered {
    let system = printer.module.system;
    let scope = Scope::new(printer.module, function_of, Place::Coordinates);
    let mut code = Code::default();
    printer.plain_statements(&scope, &mut code);
    let zero = printer.module.pool.graph.zero();
    let is_nonzero = |row: &Row| of(row) != zero;
    for (index, (row, value)) in system.rows.iter().zip(printer.results(&scope)).enumerate() {
        if let Some(label) = documentation::before_row(system, index, |_| true) {
            code.comment([label]);
        }
        let value = if is_nonzero(row) {
            value
        } else {
            printer.number(0.0)
        };
        code.line(format!("{name}[{index}] = {value};"));
    }
    let result = format!("{name}[{}]", system.rows.len());
    function(printer, name, &result, &scope, lines, code)
}

fn matrix(printer: &Printer<'_>, function_of: &Function) -> Offered {
    let system = printer.module.system;
    let scope = Scope::new(printer.module, function_of, Place::Coordinates);
    let size = system.rows.len();
    let mut code = Code::default();
    printer.plain_statements(&scope, &mut code);
    code.line(format!(
        "(void)memset(phi_q, 0, {size}U * {size}U * sizeof({}));",
        printer.real()
    ));
    let mut values = printer.results(&scope).into_iter();
    for (index, row) in system.rows.iter().enumerate() {
        if let Some(label) = documentation::before_row(system, index, |_| true) {
            code.comment([label]);
        }
        for (entry, value) in row.jacobian.iter().zip(values.by_ref()) {
            code.line(format!("phi_q[{index}][{}] = {value};", entry.coordinate));
        }
    }
    let result = format!("phi_q[{size}][{}]", system.coordinates.len());
    let lines = documentation::of_jacobian(system);
    function(printer, "phi_q", &result, &scope, lines, code)
}

/// Returns the function of the residuals of rows that are not solved.
fn monitored(printer: &Printer<'_>, function_of: &Function) -> Offered {
    let system = printer.module.system;
    let scope = Scope::new(printer.module, function_of, Place::Coordinates);
    let mut code = Code::default();
    printer.plain_statements(&scope, &mut code);
    for (index, value) in printer.results(&scope).iter().enumerate() {
        code.line(format!("monitored[{index}] = {value};"));
    }
    let mut lines = vec![documentation::MONITORED.to_string(), String::new()];
    lines.extend(documentation::of_rows(
        printer.module.pool,
        system,
        &system.monitored,
    ));
    let result = format!("monitored[{}]", system.monitored.len());
    function(printer, "monitored", &result, &scope, lines, code)
}

/// Writes the function that returns the scale of lengths, if parameters change it.
pub(super) fn length_function(
    name: &str,
    lengths: &Lengths,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    let Some(function) = &lengths.following else {
        return;
    };
    let (real, structure) = (printer.real(), printer.type_of("Parameters"));
    let scope = Scope::new(printer.module, function, Place::Coordinates);
    text.gap();
    text.comment(["Returns the scale of lengths."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static {real} {name}(const {structure} *parameters)"
    ));
    text.open("{");
    if !scope.reads().parameters {
        text.line("(void)parameters;");
    }
    printer.plain_statements(&scope, text);
    let results = printer.results(&scope);
    let number = results.len();
    text.line(format!(
        "const {real} lengths[{number}] = {{{}}};",
        results.join(", ")
    ));
    let (largest, otherwise) = (
        printer.runtime("largest_length"),
        printer.number(lengths.nominal),
    );
    text.line(format!(
        "return {largest}(lengths, {number}U, {otherwise});"
    ));
    text.close("}");
}

/// Returns the scale of a quantity.
pub(super) fn scale(quantity: Quantity, length: &str, printer: &Printer<'_>) -> String {
    let power = quantity.power_of_length();
    let one = printer.number(1.0);
    let factors = vec![length; power.unsigned_abs() as usize];
    match power {
        0 => one,
        1.. => factors.join(" * "),
        _ => format!("{one} / ({})", factors.join(" * ")),
    }
}
