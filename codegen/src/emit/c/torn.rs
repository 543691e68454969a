//! Writes a torn block: the functions that the runtime calls, and the call that solves it.

use super::equations::{Equation, in_order};
use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::program::{Block, NewtonBlock, Tearing, TornFields};

/// Returns the positions of unknowns.
fn positions(unknowns: impl Iterator<Item = usize>, printer: &Printer<'_>) -> Vec<SymbolId> {
    let all = &printer.module.system.vector_form.unknowns;
    unknowns.map(|unknown| all[unknown].position).collect()
}

/// Writes the functions that evaluate and complete a block from its tearing variables, find its signs, and scale its residuals.
pub(super) fn functions(
    block: &Block,
    newton: &NewtonBlock,
    tearing: &Tearing,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    let (module, name) = (printer.module, printer.own(&block.name));
    let tears = tearing.tears.iter().map(|&place| newton.unknowns[place]);
    let tears = positions(tears, printer);
    let unknown_names = documentation::found_by(newton, module.system);
    let all = tearing.named();
    let whole = Scope::with_tears(module, &all, Place::Tears, tears.clone());
    let arguments = [("tears", tears), ("signs", tearing.signs.clone())];

    let scope = whole.part(&tearing.evaluate);
    let evaluate = Equation {
        scope: &scope,
        comment: format!(
            "Finds the tearing residuals of `{}` and the inverse of their Jacobian; returns false if a closed form is out of reach.",
            block.name
        ),
        name: format!("{name}_evaluate"),
        vectors: arguments.to_vec(),
        returns: ("bool", Some("return true;")),
    };
    let carried = tearing.carried.iter().map(|&it| printer.symbol(it, &scope));
    let carried: Vec<String> = carried.collect();
    let with_carried =
        |results: &[String], code: &mut Code| in_order(&[results, &carried].concat(), code);
    evaluate.write(with_carried, printer, text);

    let scope = whole.part(&tearing.complete);
    let mut vectors = arguments.to_vec();
    vectors.push(("carried", tearing.carried.clone()));
    let complete = Equation {
        scope: &scope,
        comment: format!(
            "Solves `{}` for given tearing variables: {unknown_names}.",
            block.name
        ),
        name: format!("{name}_complete"),
        vectors,
        returns: ("void", None),
    };
    complete.write(in_order, printer, text);

    let unknowns = positions(newton.unknowns.iter().copied(), printer);
    let scope = Scope::with_tears(module, &tearing.sign_values, Place::Tears, unknowns.clone());
    let signs = Equation {
        scope: &scope,
        comment: format!("Finds the signs of the closed forms in `{}`.", block.name),
        name: format!("{name}_signs"),
        vectors: vec![("q", unknowns)],
        returns: ("void", None),
    };
    let zero = printer.number(0.0);
    let [minus, plus] = [-1.0, 1.0].map(|sign| printer.number(sign));
    let as_signs = |results: &[String], code: &mut Code| {
        if results.is_empty() {
            code.line("(void)found;");
        }
        for (place, result) in results.iter().enumerate() {
            code.line(format!(
                "found[{place}] = (({result}) < {zero}) ? {minus} : {plus};"
            ));
        }
    };
    signs.write(as_signs, printer, text);

    let scope = Scope::with_tears(module, &tearing.scales, Place::Tears, Vec::new());
    let scales = Equation {
        scope: &scope,
        comment: format!("Finds the factors of the row scales of `{}`.", block.name),
        name: format!("{name}_factors"),
        vectors: Vec::new(),
        returns: ("void", None),
    };
    if has_factors(tearing, printer) {
        scales.write(in_order, printer, text);
    }
}

/// True if a residual is not scaled like its row of the block.
fn has_factors(tearing: &Tearing, printer: &Printer<'_>) -> bool {
    let one = printer.module.pool.graph.one();
    tearing.scales.results.iter().any(|it| it.expr != one)
}

/// Writes the call of the runtime that solves a torn block.
pub(super) fn solve(
    block: &Block,
    newton: &NewtonBlock,
    torn: &TornFields,
    mode: &str,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    let Some(tearing) = &newton.tearing else {
        return;
    };
    let (real, name) = (printer.real(), printer.own(&block.name));
    let (order, count) = (newton.unknowns.len(), tearing.tears.len());
    let places = tearing.tears.iter().map(|place| format!("{place}U"));
    let places: Vec<String> = places.collect();
    text.line(format!(
        "const uint16_t places[{count}] = {{{}}};",
        places.join(", ")
    ));
    let mut scales: Vec<String> = tearing
        .rows
        .iter()
        .map(|row| format!("row_scales[{row}]"))
        .collect();
    if has_factors(tearing, printer) {
        text.line(format!("{real} factors[{count}];"));
        text.line(format!("{name}_factors(&given, conditions->t, factors);"));
        let one = printer.module.pool.graph.one();
        for (place, factor) in tearing.scales.results.iter().enumerate() {
            if factor.expr != one {
                scales[place] = format!("{} * factors[{place}]", scales[place]);
            }
        }
    }
    text.line(format!(
        "const {real} scales[{count}] = {{{}}};",
        scales.join(", ")
    ));
    let terms = tearing.terms.iter().map(|&it| printer.number(it));
    let terms: Vec<String> = terms.collect();
    text.line(format!(
        "const {real} terms[{count}] = {{{}}};",
        terms.join(", ")
    ));
    let evaluated = (count + 1) * count + 1 + tearing.carried.len();
    let completed = tearing.complete.results.len();
    text.line(format!("{real} evaluated[{evaluated}];"));
    text.line(format!("{real} completed[{completed}];"));
    let responses = completed - 5 * order;
    text.line(format!(
        "const {} tearing = {{&equations, {count}U, places, scales, terms, {name}_evaluate, {name}_complete, {responses}U, {name}_signs, evaluated, completed}};",
        printer.runtime("tearing"),
    ));
    let memory = torn.memory.iter();
    let memory: Vec<String> = memory.map(|&it| printer.field(it, "last")).collect();
    text.line(format!(
        "{real} memory[{}] = {{{}}};",
        memory.len(),
        memory.join(", ")
    ));
    text.gap();
    text.line(format!(
        "status = {}(&tearing, &last_tears, memory, &branches->{mode}, &tears, conditions);",
        printer.runtime("solve_torn"),
    ));
}

/// Stores the memory that the next frame starts from, and reads the requested sines and cosines.
pub(super) fn found(
    newton: &NewtonBlock,
    torn: &TornFields,
    scope: &Scope<'_>,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    for (place, &symbol) in torn.memory.iter().enumerate() {
        text.line(format!(
            "{} = memory[{place}];",
            printer.field(symbol, "at")
        ));
    }
    let order = newton.unknowns.len();
    for (place, direction) in torn.directions.iter().enumerate() {
        let parts = direction
            .iter()
            .flat_map(|[sine, cosine]| [(*cosine, place), (*sine, order + place)]);
        for (symbol, part) in parts.filter(|(symbol, _)| scope.is_read(*symbol)) {
            printer.assign(symbol, &format!("completed[{part}]"), scope, text);
        }
    }
}
