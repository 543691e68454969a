//! Writes the equations of blocks without a closed form as functions that the runtime calls.

use super::printer::Printer;
use super::textbook::length_function;
use super::torn;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::program::{Block, Function, NewtonBlock};
use crate::system::Unknown;

/// Returns the unknowns of a block.
pub(super) fn unknowns<'a>(newton: &NewtonBlock, printer: &Printer<'a>) -> Vec<&'a Unknown> {
    let unknowns = newton.unknowns.iter();
    unknowns
        .map(|&unknown| &printer.module.system.vector_form.unknowns[unknown])
        .collect()
}

/// True if one of the quantities is scaled by a length.
pub(super) fn has_length(quantities: &[Quantity]) -> bool {
    quantities.iter().any(|it| it.power_of_length() != 0)
}

/// Writes the structure that equations of blocks read; writes nothing if every block has a closed form.
pub(super) fn given(printer: &Printer<'_>, text: &mut Code) {
    let mut blocks = printer.module.program.blocks.iter();
    if !blocks.any(|block| block.newton.is_some()) {
        return;
    }
    let (name, frame) = (printer.type_of("Given"), printer.type_of("Frame"));
    let conditions = printer.runtime("conditions");
    text.gap();
    text.comment(["Inputs of the equations of a block."]);
    text.open(format!("typedef struct {name} {{"));
    text.line(format!("const {frame} *at;"));
    text.line(format!("const {conditions} *conditions;"));
    text.close(format!("}} {name};"));
}

/// Writes the equations of every block without a closed form.
pub(super) fn equations(printer: &Printer<'_>, text: &mut Code) {
    for block in &printer.module.program.blocks {
        if let Some(newton) = &block.newton {
            of_block(block, newton, printer, text);
            if let Some(tearing) = &newton.tearing {
                torn::functions(block, newton, tearing, printer, text);
            }
        }
    }
}

/// Function of vectors and time that the runtime calls.
pub(super) struct Equation<'a> {
    pub scope: &'a Scope<'a>,
    pub comment: String,
    pub name: String,
    /// Vector arguments with the symbols of their entries.
    pub vectors: Vec<(&'static str, Vec<SymbolId>)>,
    /// Return type, and the `return` statement; `None` if it is `void`.
    pub returns: (&'static str, Option<&'static str>),
}

impl Equation<'_> {
    /// Writes the function; `ends` writes the assignments of its results.
    pub(super) fn write(
        self,
        ends: impl Fn(&[String], &mut Code),
        printer: &Printer<'_>,
        text: &mut Code,
    ) {
        let Equation {
            scope,
            comment,
            name,
            vectors,
            returns: (returns, last),
        } = self;
        let real = printer.real();
        let mut code = Code::default();
        printer.plain_statements(scope, &mut code);
        ends(&printer.results(scope), &mut code);
        let arguments = vectors.iter();
        let arguments: String = arguments
            .map(|(vector, _)| format!("const {real} {vector}[], "))
            .collect();
        text.gap();
        text.comment([comment]);
        text.line(format!(
            "LINKWRIGHT_FUNCTION static {returns} {name}(const void *context, {arguments}{real} t, {real} found[])"
        ));
        text.open("{");
        let reads = scope.reads();
        let is_given = reads.frame || reads.parameters || reads.inputs;
        if is_given {
            let kind = printer.type_of("Given");
            text.line(format!(
                "const {kind} *const given = (const {kind} *)context;"
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
                    "const {kind} *const {lower} = (const {kind} *)given->conditions->{lower};"
                ));
            }
        }
        let mut unread = Vec::new();
        if !is_given {
            unread.push("context");
        }
        for (vector, symbols) in vectors {
            let named = symbols.iter().map(|&it| printer.symbol(it, scope));
            let read: Vec<(usize, String)> = named
                .enumerate()
                .filter(|(_, name)| code.mentions(name))
                .collect();
            if read.is_empty() {
                unread.push(vector);
            }
            for (place, name) in read {
                text.line(format!("const {real} {name} = {vector}[{place}];"));
            }
        }
        if !(reads.time || code.mentions("t")) {
            unread.push("t");
        }
        for name in unread {
            text.line(format!("(void){name};"));
        }
        text.gap();
        text.append(code);
        if let Some(last) = last {
            text.line(last);
        }
        text.close("}");
    }
}

/// Writes the results into `found`, in order.
pub(super) fn in_order(results: &[String], code: &mut Code) {
    for (place, result) in results.iter().enumerate() {
        code.line(format!("found[{place}] = {result};"));
    }
}

fn of_block(block: &Block, newton: &NewtonBlock, printer: &Printer<'_>, text: &mut Code) {
    let (name, order) = (printer.own(&block.name), newton.unknowns.len());
    let (names, real) = (
        documentation::found_by(newton, printer.module.system),
        printer.real(),
    );
    let unknowns = unknowns(newton, printer);
    let positions: Vec<SymbolId> = unknowns.iter().map(|it| it.position).collect();
    let rates: Vec<SymbolId> = unknowns.iter().map(|it| it.rate).collect();
    let in_rows = |results: &[String], code: &mut Code| {
        code.open(format!("const {real} rows[{order}][{order}] = {{"));
        for row in results.chunks(order) {
            code.line(format!("{{{}}},", row.join(", ")));
        }
        code.close("};");
        code.line("(void)memcpy(found, rows, sizeof(rows));");
    };
    let write = |part: &str, what: &str, function: &Function, text: &mut Code| {
        let mut vectors = vec![("q", positions.clone())];
        if part == "gamma" {
            vectors.push(("qd", rates.clone()));
        }
        let local = vectors.iter().flat_map(|(_, symbols)| symbols);
        let local = local.copied().collect();
        let scope = Scope::with_tears(printer.module, function, Place::Tears, local);
        let equation = Equation {
            scope: &scope,
            comment: format!("{what} of `{}`, which finds {names}.", block.name),
            name: format!("{name}_{part}"),
            vectors,
            returns: ("void", None),
        };
        match part {
            "jacobian" => equation.write(in_rows, printer, text),
            _ => equation.write(in_order, printer, text),
        }
    };
    write("residual", "Residuals", &newton.residual, text);
    write("jacobian", "Jacobian", &newton.jacobian, text);
    write(
        "time_derivative",
        "Rates of the residuals with constant unknowns",
        &newton.time_derivative,
        text,
    );
    write(
        "gamma",
        "Negative second rates of the residuals with zero accelerations of the unknowns",
        &newton.gamma,
        text,
    );
    let columns: Vec<Quantity> = unknowns.iter().map(|it| it.quantity).collect();
    let all = [("row", &newton.quantities), ("column", &columns)];
    for ((what, quantities), lengths) in all.into_iter().zip(&newton.scaled_by) {
        if has_length(quantities) {
            length_function(&format!("{name}_{what}_length"), lengths, printer, text);
        }
    }
}
