//! Writes the equations of blocks without a closed form for the runtime, and the calls that solve them.

use super::code::array;
use super::equation::Equation;
use super::lints;
use super::names::identifier;
use super::textbook::{length, scales};
use super::torn;
use crate::emit::code::Code;
use crate::emit::module::scope::{Place, Reads, Scope};
use crate::emit::module::{Module, documentation};
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::program::{Block, Function, Lengths, NewtonBlock, Statement, TornFields};
use crate::system::Unknown;

/// Writes a type with the equations of every Newton block.
pub(super) fn equations(module: &Module<'_>, code: &mut Code) {
    for block in &module.program.blocks {
        if let Some(newton) = &block.newton {
            structure(block, newton, module, code);
        }
    }
}

/// Returns the unknowns of a block.
fn tears<'a>(newton: &NewtonBlock, module: &'a Module<'_>) -> Vec<&'a Unknown> {
    let unknowns = newton.unknowns.iter();
    unknowns
        .map(|&unknown| &module.system.vector_form.unknowns[unknown])
        .collect()
}

/// Returns the type of a block's equations: `LoopPQR` for `loop_p_q_r`.
fn type_name(block: &Block) -> String {
    super::names::type_name(&block.name)
}

/// Returns the arguments that any equation of a block reads.
fn reads(newton: &NewtonBlock, module: &Module<'_>) -> Reads {
    let mut all = Reads::default();
    let equations = newton.equations().into_iter();
    let equations = equations.map(|function| scope(newton, function, true, module).reads());
    let tearing = newton.tearing.iter();
    let torn = tearing.flat_map(|tearing| torn::reads(newton, tearing, module));
    for reads in equations.chain(torn) {
        all.frame |= reads.frame;
        all.parameters |= reads.parameters;
        all.inputs |= reads.inputs;
    }
    all
}

/// Returns the scope of one of the functions; `with_rates` if rates are an argument.
fn scope<'a>(
    newton: &NewtonBlock,
    function: &'a Function,
    with_rates: bool,
    module: &'a Module<'a>,
) -> Scope<'a> {
    let tears = tears(newton, module);
    let positions = tears.iter().map(|it| it.position);
    let rates = tears.iter().map(|it| it.rate).filter(|_| with_rates);
    Scope::with_tears(
        module,
        function,
        Place::Tears,
        positions.chain(rates).collect(),
    )
}

/// True if parameters change the scales of the residuals or of the tears of a block.
fn scales_follow(newton: &NewtonBlock, module: &Module<'_>) -> bool {
    let tears = tears(newton, module);
    let of_tears: Vec<Quantity> = tears.iter().map(|it| it.quantity).collect();
    let follow = |(lengths, quantities): (&Lengths, &Vec<Quantity>)| {
        lengths.following.is_some() && quantities.iter().any(|it| it.power_of_length() != 0)
    };
    newton
        .scaled_by
        .iter()
        .zip([&newton.quantities, &of_tears])
        .any(follow)
}

/// Returns the fields of a block's type: name, type and value.
fn fields(newton: &NewtonBlock, module: &Module<'_>) -> Vec<[&'static str; 3]> {
    let reads = reads(newton, module);
    let reads_parameters = reads.parameters || scales_follow(newton, module);
    let all = [
        (reads.frame, ["at", "Frame", "&*at"]),
        (
            reads_parameters,
            ["parameters", "Parameters", "conditions.parameters"],
        ),
        (reads.inputs, ["inputs", "Inputs", "conditions.inputs"]),
    ];
    let read = all.into_iter().filter(|(is_read, _)| *is_read);
    read.map(|(_, field)| field).collect()
}

fn structure(block: &Block, newton: &NewtonBlock, module: &Module<'_>, code: &mut Code) {
    let (name, size) = (type_name(block), newton.unknowns.len());
    let fields = fields(newton, module);
    let unknowns = documentation::found_by(newton, module.system);
    code.gap();
    code.docs([format!("Equations of `{}` for {unknowns}.", block.name)]);
    let (lifetime, borrowed) = match fields[..] {
        [] => ("", ""),
        _ => ("<'_>", "'_, "),
    };
    if fields.is_empty() {
        code.line(format!("struct {name};"));
    } else {
        code.open(format!("struct {name}<'a> {{"));
        for [field, kind, _] in fields {
            code.line(format!("{field}: &'a {kind},"));
        }
        code.close("}");
    }
    let mut functions = Code::default();
    let parts = [
        ("residual", &newton.residual),
        ("jacobian", &newton.jacobian),
        ("time_derivative", &newton.time_derivative),
        ("gamma", &newton.gamma),
    ];
    for part in parts {
        equation(part, newton, module, &mut functions);
    }
    let columns: Vec<Quantity> = tears(newton, module).iter().map(|it| it.quantity).collect();
    let scaled = [
        ("row_scales", &newton.quantities),
        ("column_scales", &columns),
    ];
    for ((title, quantities), lengths) in scaled.into_iter().zip(&newton.scaled_by) {
        let mut length = length(module, lengths);
        if quantities.iter().all(|it| it.power_of_length() == 0) {
            length.statements = Code::default();
        }
        let scales = array(&scales(quantities, &length.name));
        length.statements.line(scales);
        let head = format!("fn {title}(&self) -> [Scalar; {size}]");
        functions.function([""; 0], [], &head, length.statements);
    }
    angles(&columns, &mut functions);
    let head = format!("impl BlockEquations<Scalar, {size}> for {name}{lifetime}");
    let mut implementation = Code::default();
    implementation.block(&head, functions);
    let allow = lints::of_code(&implementation);
    code.item([""; 0], allow, implementation);
    code.line(format!(
        "::linkwright::generated::equations!({name}, {borrowed}{size});"
    ));
    torn::implementation(&format!("{name}{lifetime}"), newton, module, code);
}

/// Writes a function of the unknowns and the time; γ takes the rates as well.
fn equation(
    (name, function): (&str, &Function),
    newton: &NewtonBlock,
    module: &Module<'_>,
    code: &mut Code,
) {
    let (tears, size) = (tears(newton, module), newton.unknowns.len());
    let with_rates = name == "gamma";
    let scope = scope(newton, function, with_rates, module);
    let equation = Equation::new(&scope);
    let vector = format!("[Scalar; {size}]");
    let positions: Vec<SymbolId> = tears.iter().map(|it| it.position).collect();
    let q = equation.pattern(&positions, "q", &scope);
    let mut arguments = format!("&self, {q}: &{vector}");
    if with_rates {
        let rates: Vec<SymbolId> = tears.iter().map(|it| it.rate).collect();
        let qd = equation.pattern(&rates, "qd", &scope);
        arguments += &format!(", {qd}: &{vector}");
    }
    let (kind, call, end) = match name {
        "jacobian" => (
            format!("Matrix<{size}, {size}>"),
            "Matrix::from_row_slice(&",
            ")",
        ),
        _ => (vector, "", ""),
    };
    let head = format!(
        "fn {name}({arguments}, {}: Scalar) -> {kind}",
        equation.time()
    );
    let mut statements = equation.statements;
    statements.line(format!("{call}[{}]{end}", equation.results.join(", ")));
    code.function([""; 0], [], &head, statements);
}

/// Writes a statement of a block that concerns its Newton-Raphson.
pub(super) fn statement(
    statement: &Statement,
    index: usize,
    block: &Block,
    scope: &Scope<'_>,
    code: &mut Code,
) {
    let Some(newton) = &block.newton else {
        return;
    };
    match statement {
        Statement::Newton { measure, torn, .. } => {
            solve(index, block, newton, (*measure, torn.as_ref()), scope, code);
        }
        Statement::Factorize => factorize(index, block, newton, scope, code),
        _ => {}
    }
}

/// Returns the value of a block's type, with its fields.
pub(super) fn instance(block: &Block, newton: &NewtonBlock, module: &Module<'_>) -> String {
    let name = type_name(block);
    let fields = fields(newton, module).into_iter();
    let fields: Vec<String> = fields
        .map(|[field, _, value]| format!("{field}: {value}"))
        .collect();
    match fields[..] {
        [] => name,
        _ => format!("{name} {{ {} }}", fields.join(", ")),
    }
}

/// Writes the call of the runtime that finds the unknowns with their rates and accelerations.
fn solve(
    index: usize,
    block: &Block,
    newton: &NewtonBlock,
    (measure, torn): (Option<[SymbolId; 2]>, Option<&TornFields>),
    scope: &Scope<'_>,
    code: &mut Code,
) {
    let module = scope.module;
    let tears = tears(newton, module);
    let of: [fn(&Unknown) -> SymbolId; 3] = [|it| it.position, |it| it.rate, |it| it.acceleration];
    let levels = ["q", "qd", "qdd"].into_iter().zip(of);
    let fields = |of: fn(&Unknown) -> SymbolId, frame: &str| {
        let fields = tears.iter().map(|it| module.field(of(it), frame));
        fields.collect::<Vec<_>>().join(", ")
    };
    if measure.is_some() {
        code.line("let mut measure = Measure::sine(0.0);");
    }
    code.open("let tears = kinematics::Frame {");
    code.line("t: last.t,");
    for (level, of) in levels.clone() {
        code.line(format!("{level}: Vector::from([{}]),", fields(of, "last")));
    }
    code.close("};");
    code.line(format!(
        "let equations = {};",
        instance(block, newton, module)
    ));
    let mode = identifier(&block.name);
    match torn {
        Some(torn) => torn::solve(index, &mode, torn, scope, code),
        None => {
            let (call, passed) = match measure {
                None => ("solve", ""),
                Some(_) => ("solve_measured", ", &mut measure"),
            };
            let call = format!(
                "block::{call}(&equations, &tears, conditions.start, &mut branches.{mode}, conditions.t, conditions.settings{passed})"
            );
            fallible("tears", &call, index, code);
        }
    }
    for (level, of) in levels {
        code.line(format!("[{}] = tears.{level}.data.0[0];", fields(of, "at")));
    }
    if let Some(both) = measure {
        let [determinant, condition] = both.map(|symbol| scope.read(symbol));
        code.line(format!("{determinant} = measure.determinant;"));
        code.line(format!("{condition} = measure.reciprocal_condition;"));
    }
}

/// Writes a call of the runtime whose failure is that of a block.
pub(super) fn fallible(name: &str, call: &str, block: usize, code: &mut Code) {
    code.line(format!(
        "let {name} = {call}.map_err(|failure| failure.in_block({block}))?;"
    ));
}

/// Writes the factorization of the Jacobian at the solution, which transmissions and sensitivities need.
fn factorize(
    index: usize,
    block: &Block,
    newton: &NewtonBlock,
    scope: &Scope<'_>,
    code: &mut Code,
) {
    let module = scope.module;
    let tears = tears(newton, module);
    let q = tears.iter().map(|it| module.field(it.position, "at"));
    let q: Vec<String> = q.collect();
    code.line(format!("let tears = Vector::from([{}]);", q.join(", ")));
    let equations = instance(block, newton, module);
    let call =
        format!("kinematics::factorize(&{equations}, &tears, conditions.t, conditions.settings)");
    fallible("factorization", &call, index, code);
}

/// Writes `fn angles`, if there are any.
fn angles(columns: &[Quantity], code: &mut Code) {
    let is_angle = columns
        .iter()
        .map(|it| (*it == Quantity::Angle).to_string());
    let is_angle: Vec<String> = is_angle.collect();
    if columns.contains(&Quantity::Angle) {
        let mut statements = Code::default();
        statements.line(array(&is_angle));
        let head = format!("fn angles(&self) -> [bool; {}]", columns.len());
        code.function([""; 0], [], &head, statements);
    }
}
