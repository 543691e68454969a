//! Writes the calls that solve blocks without a closed form.

use super::equations::{has_length, unknowns};
use super::printer::Printer;
use super::textbook::scale;
use super::torn;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::program::{Block, NewtonBlock, Statement, TornFields};
use crate::system::Unknown;

/// Position, rate or acceleration of an unknown, and the vector that passes it to the runtime.
type Level = (fn(&Unknown) -> SymbolId, &'static str);

/// Writes a statement of a block's Newton-Raphson.
pub(super) fn statement(
    statement: &Statement,
    index: usize,
    block: &Block,
    scope: &Scope<'_>,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    let Some(newton) = &block.newton else {
        return;
    };
    match statement {
        Statement::Newton { measure, torn, .. } => {
            let fields = (*measure, torn.as_ref());
            solve(index, block, newton, fields, scope, printer, text);
        }
        Statement::Factorize => factorize(newton, printer, text),
        Statement::Solve {
            targets,
            right_hand_side,
        } => {
            for (place, value) in right_hand_side.iter().enumerate() {
                let value = printer.expression(*value, scope);
                text.line(format!("response[{place}] = {value};"));
            }
            let solve = printer.runtime("solve_factorized");
            text.line(format!("{solve}(&factorization, response);"));
            for (place, target) in targets.iter().enumerate() {
                if let Some(target) = target {
                    printer.assign(*target, &format!("response[{place}]"), scope, text);
                }
            }
        }
        _ => {}
    }
}

/// Writes the return of a failure of the runtime.
fn pass_on(text: &mut Code) {
    text.open("if (status != LINKWRIGHT_OK) {");
    text.line("return status;");
    text.close("}");
}

/// Writes the call of the runtime that finds the unknowns with their rates and accelerations.
fn solve(
    index: usize,
    block: &Block,
    newton: &NewtonBlock,
    (measure, torn): (Option<[SymbolId; 2]>, Option<&TornFields>),
    scope: &Scope<'_>,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    let tears = unknowns(newton, printer);
    let (real, order, name) = (printer.real(), tears.len(), printer.own(&block.name));
    let of: [Level; 3] = [
        (|it| it.position, "q"),
        (|it| it.rate, "qd"),
        (|it| it.acceleration, "qdd"),
    ];
    for (of, vector) in of {
        let fields = tears.iter().map(|it| printer.field(of(it), "last"));
        let fields: Vec<String> = fields.collect();
        text.line(format!(
            "{real} last_{vector}[{order}] = {{{}}};",
            fields.join(", ")
        ));
        text.line(format!("{real} {vector}[{order}];"));
    }
    let columns: Vec<Quantity> = tears.iter().map(|it| it.quantity).collect();
    let scales = [("row", &newton.quantities), ("column", &columns)];
    for ((what, quantities), lengths) in scales.into_iter().zip(&newton.scaled_by) {
        let length = match &lengths.following {
            Some(_) if has_length(quantities) => {
                let length = format!("{what}_length");
                let parameters = printer.type_of("Parameters");
                text.line(format!(
                    "const {real} {length} = {name}_{length}((const {parameters} *)conditions->parameters);"
                ));
                length
            }
            _ => printer.number(lengths.nominal),
        };
        let all = quantities.iter().map(|it| scale(*it, &length, printer));
        let all: Vec<String> = all.collect();
        text.line(format!(
            "const {real} {what}_scales[{order}] = {{{}}};",
            all.join(", ")
        ));
    }
    let angles = columns
        .iter()
        .map(|it| (*it == Quantity::Angle).to_string());
    let angles: Vec<String> = angles.collect();
    text.line(format!(
        "const bool angles[{order}] = {{{}}};",
        angles.join(", ")
    ));
    text.line(format!("{real} reals[LINKWRIGHT_NEWTON_REALS({order})];"));
    text.line(format!("uint16_t exchanges[{order}];"));
    text.line(format!(
        "const {} given = {{at, conditions}};",
        printer.type_of("Given")
    ));
    let functions =
        ["residual", "jacobian", "time_derivative", "gamma"].map(|it| format!("{name}_{it}"));
    text.line(format!(
        "const {} equations = {{{order}U, {index}U, &given, {}, row_scales, column_scales, angles, reals, exchanges}};",
        printer.runtime("equations"),
        functions.join(", ")
    ));
    let tears_type = printer.runtime("tears");
    text.line(format!(
        "const {tears_type} last_tears = {{last->t, last_q, last_qd, last_qdd}};"
    ));
    text.line(format!(
        "{tears_type} tears = {{conditions->t, q, qd, qdd}};"
    ));
    let mode = identifier(&block.name);
    match torn {
        Some(torn) => torn::solve(block, newton, torn, &mode, printer, text),
        None => {
            let measured = measure.map_or("NULL", |_| "&measure");
            if measure.is_some() {
                let (kind, zero) = (printer.runtime("measure"), printer.number(0.0));
                text.line(format!("{kind} measure = {{{zero}, {zero}}};"));
            }
            text.gap();
            text.line(format!(
                "status = {}(&equations, &last_tears, &branches->{mode}, &tears, {measured}, conditions);",
                printer.runtime("solve_block"),
            ));
        }
    }
    pass_on(text);
    for (of, vector) in of {
        for (place, tear) in tears.iter().enumerate() {
            let field = printer.field(of(tear), "at");
            text.line(format!("{field} = {vector}[{place}];"));
        }
    }
    if let Some(torn) = torn {
        torn::found(newton, torn, scope, printer, text);
    }
    if let Some(both) = measure {
        for (symbol, what) in both.iter().zip(["determinant", "reciprocal_condition"]) {
            printer.assign(*symbol, &format!("measure.{what}"), scope, text);
        }
    }
}

/// Writes the factorization of the Jacobian at the solution, which transmissions and sensitivities need.
fn factorize(newton: &NewtonBlock, printer: &Printer<'_>, text: &mut Code) {
    let (real, order) = (printer.real(), newton.unknowns.len());
    text.line(format!(
        "{} factorization;",
        printer.runtime("factorization")
    ));
    text.line(format!("{real} response[{order}];"));
    let call = printer.runtime("factorize");
    text.line(format!(
        "status = {call}(&equations, q, &factorization, conditions);"
    ));
    pass_on(text);
}
