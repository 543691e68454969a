//! Writes Φ, Φ_q, Φ_t and γ as functions, and all equations as one dense system.

use super::code::{argument, array};
use super::names::{identifier, type_name};
use crate::emit::code::Code;
use crate::emit::module::scope::{Place, Reads, Scope};
use crate::emit::module::{Module, documentation};
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::program::{Function, Lengths};
use crate::system::Row;

/// Writes the functions of the textbook formulation, and of the residuals that are only monitored.
pub(super) fn functions(module: &Module<'_>, code: &mut Code) {
    let Some(textbook) = &module.program.textbook else {
        return;
    };
    let (phi, phi_t, gamma) = (
        &textbook.residual,
        &textbook.time_derivative,
        &textbook.gamma,
    );
    let system = module.system;
    let mut about_phi = vec![documentation::PHI.to_string(), String::new()];
    about_phi.extend(documentation::of_rows(module.pool, system, &system.rows));
    vector(module, phi, "phi", about_phi, |row| row.residual, code);
    matrix(module, &textbook.jacobian, code);
    let about = vec![documentation::PHI_T.to_string()];
    vector(
        module,
        phi_t,
        "phi_t",
        about,
        |row| row.time_derivative,
        code,
    );
    let about = vec![documentation::GAMMA.to_string()];
    vector(module, gamma, "gamma", about, |row| row.gamma, code);
    if let Some(function) = &textbook.monitored {
        monitored(module, function, code);
    }
}

/// Returns the arguments of a function, with an underscore before those that are not read.
fn arguments(module: &Module<'_>, reads: Reads, with_rates: bool) -> String {
    let mut all = vec![format!("{}: &Coordinates", argument("q", reads.position))];
    if with_rates {
        all.push(format!("{}: &Coordinates", argument("qd", reads.rate)));
    }
    all.extend(module.declared().arguments(reads.parameters, reads.inputs));
    all.push(format!("{}: Scalar", argument("t", reads.time)));
    all.join(", ")
}

fn vector(
    module: &Module<'_>,
    function: &Function,
    name: &str,
    docs: Vec<String>,
    of: fn(&Row) -> ExprId,
    code: &mut Code,
) {
    let system = module.system;
    let scope = Scope::new(module, function, Place::Coordinates);
    let (mut statements, results) = (scope.plain_statements(), scope.results());
    let zero = module.pool.graph.zero();
    let is_shown = |row: &Row| of(row) != zero;
    let mut entries = Vec::with_capacity(results.len());
    for (index, (row, value)) in system.rows.iter().zip(&results).enumerate() {
        if !is_shown(row) {
            entries.push("0.0".to_string());
            continue;
        }
        if let Some(label) = documentation::before_row(system, index, is_shown) {
            statements.remark(label);
        }
        let name = identifier(&row.name);
        statements.line(format!("let {name} = {value};"));
        entries.push(name);
    }
    statements.line(format!("Vector::from([{}])", entries.join(", ")));
    let arguments = arguments(module, scope.reads(), name == "gamma");
    let head = format!("pub fn {name}({arguments}) -> Vector<{}>", entries.len());
    code.unused_function(docs, &head, statements);
}

/// Writes the residuals of the rows that are not solved.
fn monitored(module: &Module<'_>, function: &Function, code: &mut Code) {
    let system = module.system;
    let scope = Scope::new(module, function, Place::Coordinates);
    let (mut statements, results) = (scope.plain_statements(), scope.results());
    statements.line(format!("[{}]", results.join(", ")));
    let mut docs = vec![documentation::MONITORED.to_string(), String::new()];
    docs.extend(documentation::of_rows(
        module.pool,
        system,
        &system.monitored,
    ));
    let arguments = arguments(module, scope.reads(), false);
    let head = format!(
        "pub fn monitored({arguments}) -> [Scalar; {}]",
        system.monitored.len()
    );
    code.unused_function(docs, &head, statements);
}

fn matrix(module: &Module<'_>, function: &Function, code: &mut Code) {
    let system = module.system;
    let scope = Scope::new(module, function, Place::Coordinates);
    let (mut statements, results) = (scope.plain_statements(), scope.results());
    let mut values = results.iter();
    statements.line("let mut phi_q = Matrix::zeros();");
    for (index, row) in system.rows.iter().enumerate() {
        if let Some(label) = documentation::before_row(system, index, |_| true) {
            statements.remark(label);
        }
        for (entry, value) in row.jacobian.iter().zip(values.by_ref()) {
            statements.line(format!("phi_q[({index}, {})] = {value};", entry.coordinate));
        }
    }
    statements.line("phi_q");
    let (arguments, size) = (arguments(module, scope.reads(), false), system.rows.len());
    let head = format!("pub fn phi_q({arguments}) -> Matrix<{size}, {size}>");
    code.unused_function(documentation::of_jacobian(system), &head, statements);
}

/// Writes `struct Textbook`, the dense system for the runtime.
pub(super) fn dense(module: &Module<'_>, code: &mut Code) {
    let Some(textbook) = &module.program.textbook else {
        return;
    };
    let system = module.system;
    let rows: Vec<Quantity> = system.rows.iter().map(|row| row.quantity).collect();
    let columns: Vec<Quantity> = system.coordinates.iter().map(|it| it.quantity).collect();
    code.gap();
    code.open("::linkwright::generated::textbook! {");
    let mechanism = type_name(&system.mechanism.name);
    code.line(format!("{mechanism}, {};", rows.len()));
    for line in module.declared().lines() {
        code.line(line);
    }
    let length = length(module, &textbook.scaled_by);
    if !length.statements.is_empty() {
        code.line("lengths: length = characteristic_length(parameters);");
    }
    for (title, quantities) in [("rows", rows), ("columns", columns)] {
        let scales = array(&scales(&quantities, &length.name));
        code.line(format!("{title}: {scales};"));
    }
    code.close("}");
}

/// Writes `fn characteristic_length`, which returns the largest length, if parameters change lengths.
pub(super) fn characteristic_length(module: &Module<'_>, code: &mut Code) {
    let textbook = module.program.textbook.as_ref();
    let Some((lengths, function)) = textbook.and_then(|it| {
        let lengths = &it.scaled_by;
        Some((lengths, lengths.following.as_ref()?))
    }) else {
        return;
    };
    let (mut statements, largest) = largest(module, lengths, function);
    statements.line(largest);
    let head = "fn characteristic_length(parameters: &Parameters) -> Scalar";
    code.unused_function(["Returns the scale of lengths."], head, statements);
}

/// Returns the statements that compute lengths, and the expression of the largest.
fn largest(module: &Module<'_>, lengths: &Lengths, function: &Function) -> (Code, String) {
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    let otherwise = module.number(lengths.nominal);
    let largest = format!("largest_length(&[{}], {otherwise})", results.join(", "));
    (statements, largest)
}

/// Scale of lengths: statements that compute it, and its name.
pub(super) struct Length {
    pub statements: Code,
    pub name: String,
}

/// Returns the scale of lengths: a number if parameters do not change them.
pub(super) fn length(module: &Module<'_>, lengths: &Lengths) -> Length {
    let mut statements = Code::default();
    let mut name = module.number(lengths.nominal);
    if let Some(function) = &lengths.following {
        let (found, largest) = largest(module, lengths, function);
        statements.line("let parameters = &self.parameters;");
        statements.append(found);
        statements.line(format!("let length = {largest};"));
        name = "length".to_string();
    }
    Length { statements, name }
}

/// Returns the scales of rows or columns with these quantities.
pub(super) fn scales(quantities: &[Quantity], length: &str) -> Vec<String> {
    quantities.iter().map(|it| scale(*it, length)).collect()
}

/// Returns the scale of a quantity.
fn scale(quantity: Quantity, length: &str) -> String {
    let power = quantity.power_of_length();
    let product = vec![length; power.unsigned_abs() as usize].join(" * ");
    match power {
        0 => "1.0".to_string(),
        1.. => product,
        _ => format!("1.0 / ({product})"),
    }
}
