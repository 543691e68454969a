//! Writes the module that solves several mechanisms at once.
//!
//! Its functions are those of one mechanism. Their values are numbers of all lanes, and their checks collect the lanes that fail.

use std::collections::HashSet;

use super::block::used_statements;
use super::code::{argument, taken_apart};
use super::lints;
use super::names::identifier;
use super::tables::table_name;
use crate::emit::code::Code;
use crate::emit::module::checks::final_check;
use crate::emit::module::drawing::frame_keeps_parameters;
use crate::emit::module::needs::Needs;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::model::field_name;
use crate::program::{Block, Function};

/// Number of blocks up to which all lanes are verified together. Beyond, compilers would take longer for the verification than for all the
/// rest: half a second for eight blocks, and 21 s for eighteen.
const MOST_VERIFIED: usize = 10;

/// Writes the module `lanes`.
pub(super) fn lanes(module: &Module<'_>, code: &mut Code) {
    let mut rest = Code::default();
    structures(module, &mut rest);
    for (index, block) in module.program.blocks.iter().enumerate() {
        function(index, block, module, &mut rest);
    }
    solve(module, &mut rest);
    if let Some(closed) = closed_path(module) {
        verify_nonsingular(module, closed, &mut rest);
    }
    let mentioned: HashSet<&str> = rest.names().collect();
    let constants = module.program.constants.list().iter();
    let constants = constants.map(|constant| identifier(&constant.name));
    let splines = module.pool.graph.splines();
    let tables = splines.map(|(_, spline)| table_name(&spline.name));
    let of_module = constants.chain(tables);
    let of_module = of_module.filter(|name| mentioned.contains(name.as_str()));
    let imported: Vec<String> = ["Loops".to_string()].into_iter().chain(of_module).collect();
    let mut inside = Code::default();
    inside.line(format!(
        "use ::linkwright::generated::lanes::{}::*;",
        module.precision()
    ));
    match &imported[..] {
        [only] => inside.line(format!("use super::{only};")),
        _ => {
            inside.open("use super::{");
            inside.list(&imported);
            inside.close("};");
        }
    }
    inside.gap();
    inside.append(rest);
    let mut item = Code::default();
    item.block("pub mod lanes", inside);
    let docs = [
        "Several mechanisms at once: each lane has the bits of a mechanism alone.",
        "",
        "A [`Group`](lanes::Group) moves them. Where a check fails, it solves the lane alone.",
    ];
    code.item(docs, ["#[allow(dead_code)]"], item);
}

/// Writes the structures of values of all lanes.
fn structures(module: &Module<'_>, code: &mut Code) {
    let mechanism = &module.system.mechanism;
    let held = match (module.holds_coordinates(), frame_keeps_parameters(module)) {
        (true, true) => "q, qd, qdd, parameters",
        (true, false) => "q, qd, qdd",
        (false, _) => "",
    };
    let fields = module.program.fields.iter();
    let coordinates = module.system.coordinates.iter();
    let branches = module.program.branches.iter();
    let parameters = mechanism.parameters.iter();
    let inputs = mechanism.inputs.iter();
    let lists: [(String, Vec<String>); 5] = [
        (
            "Coordinates".to_string(),
            coordinates.map(|it| identifier(&it.name)).collect(),
        ),
        (
            format!("Frame({held})"),
            fields.map(|&symbol| module.field_name(symbol)).collect(),
        ),
        (
            "Branches".to_string(),
            branches.map(|it| identifier(&it.name)).collect(),
        ),
        (
            "Parameters".to_string(),
            parameters
                .map(|it| identifier(&field_name(&it.name)))
                .collect(),
        ),
        (
            "Inputs".to_string(),
            inputs.map(|it| identifier(&field_name(&it.name))).collect(),
        ),
    ];
    code.open("::linkwright::generated::lanes::structures! {");
    code.line(format!("{} lanes;", module.scalar.lanes()));
    code.line(match closed_path(module) {
        Some(_) => "path: closed;",
        None => "path: alone;",
    });
    let without_coordinates = usize::from(!module.holds_coordinates());
    for (name, fields) in lists.into_iter().skip(without_coordinates) {
        match fields.is_empty() {
            true => code.line(format!("{name} {{}}")),
            false => {
                code.open(format!("{name} {{"));
                code.list(&fields);
                code.close("}");
            }
        }
    }
    code.close("}");
}

fn function(index: usize, block: &Block, module: &Module<'_>, code: &mut Code) {
    let needs = Needs::in_lanes(block, module);
    let scope = Scope::new(module, &block.function, Place::Lanes);
    let statements = used_statements(&scope, index, &|_, _| {});
    let reads = scope.reads();
    let read = [
        (needs.time, "t"),
        (reads.parameters, "parameters"),
        (reads.inputs, "inputs"),
    ];
    let mut inside = Code::default();
    if let Some(taken) = taken_apart("&Conditions", "conditions", &read) {
        inside.line(taken);
    }
    let [arguments, _] = needs.arguments();
    let mut head = format!("fn {}({arguments})", identifier(&block.name));
    if needs.fails {
        inside.line("let mut failed = Mask::NONE;");
    }
    inside.append(statements);
    if needs.fails {
        inside.line("failed");
        head += " -> Mask";
    }
    // Instruction sets are chosen for what is inlined.
    let allow: Vec<&str> = lints::of_code(&inside)
        .chain(["#[inline(always)]"])
        .collect();
    code.function(documentation::of_block(block, module), allow, &head, inside);
}

/// Writes the function that solves all blocks at one time.
fn solve(module: &Module<'_>, code: &mut Code) {
    let mut calls = Code::default();
    let mut can_fail = false;
    for block in &module.program.blocks {
        let needs = Needs::in_lanes(block, module);
        let (name, [_, arguments]) = (identifier(&block.name), needs.arguments());
        can_fail |= needs.fails;
        calls.line(match needs.fails {
            true => format!("failed |= {name}({arguments});"),
            false => format!("{name}({arguments});"),
        });
    }
    let called: HashSet<&str> = calls.names().collect();
    let [last, branches] = ["last", "branches"].map(|it| argument(it, called.contains(it)));
    let head = format!(
        "fn solve(at: &mut Frame, {last}: &Frame, {branches}: &Branches, conditions: &Conditions<'_>) -> Mask"
    );
    let mut inside = Code::default();
    if can_fail {
        inside.line("let mut failed = Mask::NONE;");
    }
    inside.line("at.t = conditions.t;");
    if module.holds_coordinates() && frame_keeps_parameters(module) {
        inside.line("at.parameters = *conditions.parameters;");
    }
    inside.append(calls);
    let access = |symbol| format!("&{}", module.field(symbol, "at"));
    let checked = final_check(module, false, access, "&at.t");
    inside.line(match (checked.is_empty(), can_fail) {
        (true, true) => "failed".to_string(),
        (true, false) => "Mask::NONE".to_string(),
        (false, true) => format!("failed | not_finite([{}])", checked.join(", ")),
        (false, false) => format!("not_finite([{}])", checked.join(", ")),
    });
    let docs = ["Solves all blocks, one after another; returns the lanes that fail."];
    code.function(docs, ["#[inline(always)]"], &head, inside);
}

/// Returns the function that verifies paths by closed forms in sequence, if all lanes are verified together. Inputs have signals of their
/// own in each lane.
fn closed_path<'a>(module: &Module<'a>) -> Option<&'a Function> {
    let closed = module.program.path.as_ref()?.closed.as_ref()?;
    let reads = Scope::new(module, closed, Place::PathLanes).reads();
    let has_inputs = !module.system.mechanism.inputs.is_empty();
    let is_small = module.program.blocks.len() <= MOST_VERIFIED;
    (is_small && !has_inputs && !reads.time).then_some(closed)
}

/// Writes the function that verifies paths by closed forms in sequence.
fn verify_nonsingular(module: &Module<'_>, function: &Function, code: &mut Code) {
    let scope = Scope::new(module, function, Place::PathLanes);
    let mut inside = Code::default();
    inside.line("let mut failed = Mask::NONE;");
    inside.append(scope.plain_statements());
    inside.line("!failed");
    let mentioned: HashSet<&str> = inside.names().collect();
    let arguments = [
        ("at", "Frame"),
        ("last", "Frame"),
        ("window", "TimeWindow"),
        ("parameters", "Parameters"),
    ];
    let arguments = arguments.map(|(name, kind)| {
        let name = argument(name, mentioned.contains(name));
        format!("{name}: &{kind}")
    });
    let head = format!("fn verify_nonsingular({}) -> Mask", arguments.join(", "));
    let allow: Vec<&str> = lints::of_code(&inside)
        .chain(["#[inline(always)]"])
        .collect();
    let docs = documentation::VERIFY_NONSINGULAR_LANES;
    code.function(docs, allow, &head, inside);
}
