//! Writes a torn block for the runtime, and the call that solves it.

use super::code::argument;
use super::equation::Equation;
use super::lints;
use super::newton::fallible;
use crate::emit::code::Code;
use crate::emit::module::Module;
use crate::emit::module::scope::{Place, Reads, Scope};
use crate::expr::SymbolId;
use crate::program::{NewtonBlock, Tearing, TornFields};

/// Writes the tearing of a block for the type of its equations.
pub(super) fn implementation(
    name: &str,
    newton: &NewtonBlock,
    module: &Module<'_>,
    code: &mut Code,
) {
    let Some(tearing) = &newton.tearing else {
        return;
    };
    let (size, tears) = (newton.unknowns.len(), tearing.tears.len());
    let mut inside = Code::default();
    inside.line(format!("type Signs = [Scalar; {}];", tearing.signs.len()));
    inside.line(format!(
        "type Carried = [Scalar; {}];",
        tearing.carried.len()
    ));
    let places: Vec<String> = tearing.tears.iter().map(usize::to_string).collect();
    list("tears", &format!("[usize; {tears}]"), &places, &mut inside);
    scales(tearing, module, &mut inside);
    let terms: Vec<String> = tearing.terms.iter().map(|&it| module.number(it)).collect();
    list("terms", &format!("[Scalar; {tears}]"), &terms, &mut inside);
    evaluate(newton, tearing, module, &mut inside);
    complete(newton, tearing, module, &mut inside);
    signs(newton, tearing, module, &mut inside);
    let head = format!("impl Torn<Scalar, Const<{size}>, {tears}> for {name}");
    let mut item = Code::default();
    item.block(&head, inside);
    let allow = lints::of_code(&item);
    code.item([""; 0], allow, item);
}

/// Writes a function that returns these values.
fn list(name: &str, kind: &str, values: &[String], code: &mut Code) {
    let mut statements = Code::default();
    statements.line(format!("[{}]", values.join(", ")));
    code.function(
        [""; 0],
        [],
        &format!("fn {name}(&self) -> {kind}"),
        statements,
    );
}

/// Returns the arguments that each function reads. Values that one function passes to another are not among them.
pub(super) fn reads(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>) -> [Reads; 4] {
    let all = tearing.named();
    let whole = Scope::with_tears(module, &all, Place::Tears, tears(newton, tearing, module));
    let unknowns = positions(newton.unknowns.iter().copied(), module);
    [
        Scope::with_tears(module, &tearing.scales, Place::Tears, Vec::new()).reads(),
        whole.part(&tearing.evaluate).reads(),
        whole.part(&tearing.complete).reads(),
        Scope::with_tears(module, &tearing.sign_values, Place::Tears, unknowns).reads(),
    ]
}

/// Returns the positions of unknowns.
fn positions(unknowns: impl Iterator<Item = usize>, module: &Module<'_>) -> Vec<SymbolId> {
    let all = &module.system.vector_form.unknowns;
    unknowns.map(|unknown| all[unknown].position).collect()
}

fn tears(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>) -> Vec<SymbolId> {
    let tears = tearing.tears.iter().map(|&place| newton.unknowns[place]);
    positions(tears, module)
}

fn scales(tearing: &Tearing, module: &Module<'_>, code: &mut Code) {
    let scope = Scope::with_tears(module, &tearing.scales, Place::Tears, Vec::new());
    let equation = Equation::new(&scope);
    let one = module.pool.graph.one();
    let factors = tearing.scales.results.iter().zip(&equation.results);
    let rows = tearing.rows.iter().zip(factors);
    let rows = rows.map(|(row, (factor, written))| match factor.expr == one {
        true => format!("rows[{row}]"),
        false => format!("rows[{row}] * ({written})"),
    });
    let rows: Vec<String> = rows.collect();
    let head = format!(
        "fn scales(&self, {}: Scalar) -> [Scalar; {}]",
        equation.time(),
        rows.len()
    );
    let mut statements = equation.statements;
    statements.line("let rows = BlockEquations::row_scales(self);");
    statements.line(format!("[{}]", rows.join(", ")));
    code.function([""; 0], ["#[inline]"], &head, statements);
}

fn evaluate(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>, code: &mut Code) {
    let all = tearing.named();
    let whole = Scope::with_tears(module, &all, Place::Tears, tears(newton, tearing, module));
    let scope = whole.part(&tearing.evaluate);
    let equation = Equation::new(&scope);
    let count = tearing.tears.len();
    let tears = equation.pattern(&tears(newton, tearing, module), "tears", &scope);
    let signs = equation.pattern(&tearing.signs, "signs", &scope);
    let head = format!(
        "fn evaluate(&self, {tears}: &[Scalar; {count}], {signs}: &Self::Signs, {}: Scalar) -> Option<torn::Evaluation<Scalar, {count}, Self::Carried>>",
        equation.time()
    );
    let (residual, rest) = equation.results.split_at(count);
    let (inverse, determinant) = rest.split_at(count * count);
    let inverse = inverse
        .chunks(count)
        .map(|row| format!("[{}]", row.join(", ")));
    let inverse: Vec<String> = inverse.collect();
    let carried = tearing.carried.iter().map(|&symbol| scope.read(symbol));
    let carried: Vec<String> = carried.collect();
    let mut statements = equation.statements;
    statements.open("Some(torn::Evaluation {");
    statements.line(format!("residual: [{}],", residual.join(", ")));
    statements.line(format!("inverse: [{}],", inverse.join(", ")));
    // Rust's shorthand for a value with the name of its field.
    statements.line(match determinant.concat() {
        name if name == "determinant" => format!("{name},"),
        value => format!("determinant: {value},"),
    });
    statements.line(format!("carried: [{}],", carried.join(", ")));
    statements.close("})");
    code.function([""; 0], ["#[inline]"], &head, statements);
}

fn complete(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>, code: &mut Code) {
    let all = tearing.named();
    let whole = Scope::with_tears(module, &all, Place::Tears, tears(newton, tearing, module));
    let scope = whole.part(&tearing.complete);
    let equation = Equation::new(&scope);
    let (size, count) = (newton.unknowns.len(), tearing.tears.len());
    let tears = equation.pattern(&tears(newton, tearing, module), "tears", &scope);
    let signs = equation.pattern(&tearing.signs, "signs", &scope);
    let carried = equation.pattern(&tearing.carried, "carried", &scope);
    let head = format!(
        "fn complete(&self, {tears}: &[Scalar; {count}], {signs}: &Self::Signs, {carried}: &Self::Carried, {}: Scalar) -> torn::Completion<Scalar, Const<{size}>>",
        equation.time()
    );
    let mut statements = equation.statements;
    statements.open("torn::Completion {");
    let vectors = ["cosines", "sines", "rates", "accelerations", "residual"];
    let mut results = equation.results.as_slice();
    for vector in vectors {
        let part;
        (part, results) = results.split_at(size);
        statements.line(format!("{vector}: Vector::from([{}]),", part.join(", ")));
    }
    statements.line(format!(
        "response: torn::largest_of(&[{}]),",
        results.join(", ")
    ));
    statements.close("}");
    code.function([""; 0], ["#[inline]"], &head, statements);
}

fn signs(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>, code: &mut Code) {
    let all = positions(newton.unknowns.iter().copied(), module);
    let scope = Scope::with_tears(module, &tearing.sign_values, Place::Tears, all.clone());
    let equation = Equation::new(&scope);
    let q = equation.pattern(&all, "q", &scope);
    let is_read = !q.starts_with('_');
    let head = format!(
        "fn signs(&self, {}: &Vector<{}>, {}: Scalar) -> Self::Signs",
        argument("q", is_read),
        all.len(),
        equation.time()
    );
    let mut statements = Code::default();
    if is_read {
        statements.line(format!("let {q} = &q.data.0[0];"));
    }
    statements.append(equation.statements);
    let results = equation
        .results
        .iter()
        .map(|it| format!("torn::sign({it})"));
    let results: Vec<String> = results.collect();
    statements.line(format!("[{}]", results.join(", ")));
    code.function([""; 0], [], &head, statements);
}

/// Writes the call of the runtime that solves a torn block.
pub(super) fn solve(
    number: usize,
    mode: &str,
    torn: &TornFields,
    scope: &Scope<'_>,
    code: &mut Code,
) {
    let module = scope.module;
    let fields = |frame: &str| -> Vec<String> {
        let memory = torn.memory.iter();
        memory.map(|&symbol| module.field(symbol, frame)).collect()
    };
    let (last, at) = (fields("last"), fields("at"));
    let ([determinant, signs @ ..], [kept, kept_signs @ ..]) = (&last[..], &at[..]) else {
        return;
    };
    code.line(format!(
        "let memory = torn::Memory {{ determinant: {determinant}, signs: [{}] }};",
        signs.join(", ")
    ));
    let call = format!(
        "torn::solve(&equations, &tears, &memory, conditions.start, &mut branches.{mode}, conditions.t, conditions.settings)"
    );
    fallible("found", &call, number, code);
    code.line("let tears = found.frame;");
    code.line(format!("{kept} = found.memory.determinant;"));
    if !kept_signs.is_empty() {
        code.line(format!("[{}] = found.memory.signs;", kept_signs.join(", ")));
    }
    for (which, part) in [(1, "cosines"), (0, "sines")] {
        let names = torn.directions.iter().map(|pair| {
            let symbol = (*pair)?[which];
            scope.is_read(symbol).then(|| scope.read(symbol))
        });
        let names = names.map(|name| name.unwrap_or("_".to_string()));
        let names: Vec<String> = names.collect();
        if names.iter().any(|it| it != "_") {
            code.line(format!(
                "let [{}] = found.{part}.data.0[0];",
                names.join(", ")
            ));
        }
    }
}
