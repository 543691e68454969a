//! The equations of blocks without a closed form, as the runtime sees them, and the calls that solve them.

use super::printer::Printer;
use super::text::Text;
use super::textbook::{length_function, scale};
use super::words::identifier;
use crate::emit::module::documentation;
use crate::emit::module::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::program::{Block, Function, NewtonBlock, Statement};
use crate::system::Unknown;

/// A level of the motion of an unknown, and the vector that it is handed over in.
type Level = (fn(&Unknown) -> SymbolId, &'static str);

/// The unknowns of a block.
fn tears<'a>(newton: &NewtonBlock, printer: &Printer<'a>) -> Vec<&'a Unknown> {
    let unknowns = newton.unknowns.iter();
    unknowns
        .map(|&unknown| &printer.module.system.vector_form.unknowns[unknown])
        .collect()
}

/// The names of one of the functions; `with_rates` where it is given the rates of the tears.
fn scope<'a>(
    newton: &NewtonBlock,
    function: &'a Function,
    with_rates: bool,
    printer: &Printer<'a>,
) -> Scope<'a> {
    let tears = tears(newton, printer);
    let positions = tears.iter().map(|it| it.position);
    let rates = tears.iter().map(|it| it.rate).filter(|_| with_rates);
    let tears = positions.chain(rates).collect();
    Scope::with_tears(printer.module, function, Place::Tears, tears)
}

/// What the equations of all blocks are evaluated with; nothing where every block has a closed form.
pub(super) fn given(printer: &Printer<'_>, text: &mut Text) {
    let mut blocks = printer.module.program.blocks.iter();
    if !blocks.any(|block| block.newton.is_some()) {
        return;
    }
    let (name, frame) = (printer.type_of("Given"), printer.type_of("Frame"));
    let conditions = printer.runtime("conditions");
    text.gap();
    text.comment(["What the equations of a block are evaluated with."]);
    text.open(format!("typedef struct {name} {{"));
    text.line(format!("const {frame} *at;"));
    text.line(format!("const {conditions} *conditions;"));
    text.close(format!("}} {name};"));
}

/// The equations of every block without a closed form.
pub(super) fn equations(printer: &Printer<'_>, text: &mut Text) {
    for block in &printer.module.program.blocks {
        if let Some(newton) = &block.newton {
            let found = documentation::found_by(newton, printer.module.system);
            functions(block, newton, &found, printer, text);
        }
    }
}

fn functions(
    block: &Block,
    newton: &NewtonBlock,
    found: &str,
    printer: &Printer<'_>,
    text: &mut Text,
) {
    let (name, order) = (printer.own(&block.name), newton.unknowns.len());
    let real = printer.real();
    let parts = [
        ("residual", "The residuals", &newton.residual, false),
        ("jacobian", "The Jacobian", &newton.jacobian, false),
        (
            "time_derivative",
            "The rates of the residuals with the unknowns held",
            &newton.time_derivative,
            false,
        ),
        (
            "gamma",
            "Minus the second rates of the residuals with the accelerations of the unknowns zero",
            &newton.gamma,
            true,
        ),
    ];
    for (part, what, function, with_rates) in parts {
        let scope = scope(newton, function, with_rates, printer);
        let mut code = Text::default();
        printer.plain_statements(&scope, &mut code);
        let results = printer.results(&scope);
        if part == "jacobian" {
            code.open(format!("const {real} rows[{order}][{order}] = {{"));
            for row in results.chunks(order) {
                code.line(format!("{{{}}},", row.join(", ")));
            }
            code.close("};");
            code.line("(void)memcpy(found, rows, sizeof(rows));");
        } else {
            for (row, result) in results.iter().enumerate() {
                code.line(format!("found[{row}] = {result};"));
            }
        }
        let reads = scope.reads();
        let rates = if with_rates {
            format!("const {real} qd[], ")
        } else {
            String::new()
        };
        text.gap();
        text.comment([format!("{what} of `{}`, which finds {found}.", block.name)]);
        text.line(format!(
            "static void {name}_{part}(const void *context, const {real} q[], {rates}{real} t, {real} found[])"
        ));
        text.open("{");
        let is_given = reads.frame || reads.parameters || reads.inputs;
        if is_given {
            text.line(format!(
                "const {} *const given = context;",
                printer.type_of("Given")
            ));
        }
        if reads.frame {
            let frame = printer.type_of("Frame");
            text.line(format!("const {frame} *const at = given->at;"));
        }
        for (is_read, kind, lower) in [
            (reads.parameters, "Parameters", "parameters"),
            (reads.inputs, "Inputs", "inputs"),
        ] {
            if is_read {
                let kind = printer.type_of(kind);
                text.line(format!(
                    "const {kind} *const {lower} = given->conditions->{lower};"
                ));
            }
        }
        let tears = tears(newton, printer);
        let mut taken = |of: fn(&Unknown) -> SymbolId, vector: &str| {
            let mut is_read = false;
            for (place, tear) in tears.iter().enumerate() {
                let name = identifier(&printer.module.system.symbol_name(of(tear)));
                if code.mentions(&name) {
                    text.line(format!("const {real} {name} = {vector}[{place}];"));
                    is_read = true;
                }
            }
            is_read
        };
        let reads_q = taken(|it| it.position, "q");
        let reads_qd = !with_rates || taken(|it| it.rate, "qd");
        let unread = [
            (is_given, "context"),
            (reads_q, "q"),
            (reads_qd, "qd"),
            (reads.time || code.mentions("t"), "t"),
        ];
        for (_, name) in unread.into_iter().filter(|(is_read, _)| !is_read) {
            text.line(format!("(void){name};"));
        }
        text.gap();
        text.append(code);
        text.close("}");
    }
    let columns: Vec<Quantity> = tears(newton, printer)
        .iter()
        .map(|it| it.quantity)
        .collect();
    let all = [("row", &newton.quantities), ("column", &columns)];
    for ((what, quantities), lengths) in all.into_iter().zip(&newton.scaled_by) {
        if has_length(quantities) {
            length_function(&format!("{name}_{what}_length"), lengths, printer, text);
        }
    }
}

/// Whether something is scaled by a length.
fn has_length(quantities: &[Quantity]) -> bool {
    quantities.iter().any(|it| it.power_of_length() != 0)
}

/// A statement of a block that concerns its Newton-Raphson.
pub(super) fn statement(
    statement: &Statement,
    index: usize,
    block: &Block,
    scope: &Scope<'_>,
    printer: &Printer<'_>,
    text: &mut Text,
) {
    let Some(newton) = &block.newton else {
        return;
    };
    match statement {
        Statement::Newton { measure, .. } => {
            solve(index, block, newton, *measure, scope, printer, text);
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

/// What fails where the runtime has.
fn pass_on(text: &mut Text) {
    text.open("if (status != LINKWRIGHT_OK) {");
    text.line("return status;");
    text.close("}");
}

/// The call of the runtime that finds the tears with their rates.
fn solve(
    index: usize,
    block: &Block,
    newton: &NewtonBlock,
    measure: Option<[SymbolId; 2]>,
    scope: &Scope<'_>,
    printer: &Printer<'_>,
    text: &mut Text,
) {
    let tears = tears(newton, printer);
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
                text.line(format!(
                    "const {real} {length} = {name}_{length}(conditions->parameters);"
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
    let measured = match measure {
        None => "NULL",
        Some(_) => {
            text.line(format!(
                "{} measure = {{{1}, {1}}};",
                printer.runtime("measure"),
                printer.number(0.0)
            ));
            "&measure"
        }
    };
    text.gap();
    text.line(format!(
        "status = {}(&equations, &last_tears, &branches->{}, &tears, {measured}, conditions);",
        printer.runtime("solve_block"),
        identifier(&block.name)
    ));
    pass_on(text);
    for (of, vector) in of {
        for (place, tear) in tears.iter().enumerate() {
            let field = printer.field(of(tear), "at");
            text.line(format!("{field} = {vector}[{place}];"));
        }
    }
    if let Some(both) = measure {
        for (symbol, what) in both.iter().zip(["determinant", "reciprocal_condition"]) {
            printer.assign(*symbol, &format!("measure.{what}"), scope, text);
        }
    }
}

/// The Jacobian at the tears that were found, factorized once more for what responds to drivers and parameters.
fn factorize(newton: &NewtonBlock, printer: &Printer<'_>, text: &mut Text) {
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
