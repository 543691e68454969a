//! Writes splines as functions that return constant tables of the runtime.

use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::tables::{docs_of, spacing};
use crate::expr::SplineId;

/// Function that returns a table. Names of constants have another prefix, and those of values have small letters.
pub(super) fn table_name(printer: &Printer<'_>, spline: SplineId) -> String {
    let name = &printer.module.pool.graph.spline_of(spline).name;
    printer.own_constant(&format!("TABLE_{}", name.to_uppercase()))
}

/// Writes the tables that the code mentions.
pub(super) fn tables(printer: &Printer<'_>, code: &Code, text: &mut Code) {
    let system = printer.module.system;
    let (real, zero) = (printer.real(), printer.number(0.0));
    for (id, spline) in printer.module.pool.graph.splines() {
        let name = table_name(printer, id);
        if !code.mentions(&name) {
            continue;
        }
        let count = spline.starts.len();
        text.gap();
        text.comment(docs_of(id, printer.module.pool, system));
        let starts = spline.starts.iter().map(|&start| printer.number(start));
        let starts: Vec<String> = starts.collect();
        let table = printer.runtime("table");
        text.line(format!(
            "LINKWRIGHT_FUNCTION static const {table} *{name}(void)"
        ));
        text.open("{");
        text.line(format!(
            "static const {real} starts[{count}] = {{{}}};",
            starts.join(", ")
        ));
        text.open(format!("static const {real} pieces[{count}][4] = {{"));
        for piece in &spline.pieces {
            let piece = piece.iter().map(|&it| printer.number(it));
            let piece: Vec<String> = piece.collect();
            text.line(format!("{{{}}},", piece.join(", ")));
        }
        text.close("};");
        let optional = |value: Option<f64>| value.map_or(zero.clone(), |it| printer.number(it));
        let (spacing, period) = (optional(spacing(&spline.starts)), optional(spline.period));
        text.line(format!(
            "static const {table} table = {{starts, pieces, {count}U, {spacing}, {period}}};"
        ));
        text.line("return &table;");
        text.close("}");
    }
}
