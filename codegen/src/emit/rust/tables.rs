//! Writes splines as constants of the runtime's type `Table`.

use std::collections::HashSet;

use super::lints;
use crate::emit::code::Code;
use crate::emit::module::Module;
use crate::emit::module::tables::{docs_of, spacing};
use crate::expr::Spline;

/// Constant that holds a table. No other constant has this prefix.
pub(super) fn table_name(table: &str) -> String {
    format!("TABLE_{}", table.to_uppercase())
}

/// Writes the tables that the code mentions.
pub(super) fn tables(module: &Module<'_>, mentioned: &HashSet<&str>, code: &mut Code) {
    for (id, spline) in module.pool.graph.splines() {
        let name = table_name(&spline.name);
        if mentioned.contains(name.as_str()) {
            constant(
                module,
                &name,
                spline,
                docs_of(id, module.pool, module.system),
                code,
            );
        }
    }
}

fn constant(module: &Module<'_>, name: &str, spline: &Spline, docs: Vec<String>, code: &mut Code) {
    let numbers = |values: &[f64]| {
        let values: Vec<String> = values.iter().map(|&it| module.number(it)).collect();
        values.join(", ")
    };
    let optional = |value: Option<f64>| match value {
        Some(value) => format!("Some({})", module.number(value)),
        None => "None".to_string(),
    };
    let (spacing, period) = (optional(spacing(&spline.starts)), optional(spline.period));
    let mut table = Code::default();
    table.open(format!(
        "const {name}: Table<{}> = ::linkwright::generated::Table {{",
        spline.starts.len()
    ));
    table.line(format!("starts: [{}],", numbers(&spline.starts)));
    table.open("pieces: [");
    for piece in &spline.pieces {
        table.line(format!("[{}],", numbers(piece)));
    }
    table.close("],");
    table.line(format!("spacing: {spacing},"));
    table.line(format!("period: {period},"));
    table.close("};");
    let allow = lints::of_code(&table);
    code.item(docs, allow, table);
}
