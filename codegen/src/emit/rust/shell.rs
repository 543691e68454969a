//! Writes the type of the mechanism, and the function that solves all blocks.

use std::collections::HashSet;

use super::block::call;
use super::code::argument;
use super::loads;
use super::module::derives;
use super::names::type_name;
use super::parameters;
use super::ranges;
use crate::emit::code::Code;
use crate::emit::module::checks::final_check;
use crate::emit::module::drawing::frame_keeps_parameters;
use crate::emit::module::path_enclosures::enclosure_count;
use crate::emit::module::{Module, documentation};

/// Writes the function that solves one instant, and the type of the mechanism.
pub(super) fn mechanism(module: &Module<'_>, code: &mut Code) {
    solve(module, code);
    parameters::requirements(module, code);
    let name = type_name(&module.system.mechanism.name);
    code.gap();
    code.open("::linkwright::generated::mechanism! {");
    code.docs(documentation::of_mechanism(module.system));
    code.line(derives(module.system.coordinates.len()));
    code.line(format!("{name}, {:?};", module.system.mechanism.name));
    for line in module.declared().lines() {
        code.line(line);
    }
    let path = match &module.program.path {
        Some(path) if path.closed.is_some() => "closed",
        Some(_) => "guarded",
        None => "unguarded",
    };
    code.line(match enclosure_count(module) {
        0 => format!("path: {path};"),
        count => format!("path: {path}, enclosures: {count};"),
    });
    if module.program.drawn.is_some() {
        code.line("drawn: drawn;");
    }
    if let Some(requirements) = &module.program.requirements {
        code.line(match requirements.limit_parameters() {
            true => "requirements: REQUIREMENTS;",
            false => "driven: REQUIREMENTS;",
        });
    }
    if module.assemblies.is_some() {
        code.line("assemblies: Branches;");
    }
    if module.program.loads.is_some() {
        code.line("loads: LOADS;");
    }
    for line in ranges::lines(module) {
        code.line(line);
    }
    code.close("}");
}

/// Writes the function that solves all blocks at one time.
fn solve(module: &Module<'_>, code: &mut Code) {
    let mut calls = Code::default();
    for block in &module.program.blocks {
        calls.line(call(block, module));
    }
    let called: HashSet<&str> = calls.names().collect();
    let [last, branches] = ["last", "branches"].map(|it| argument(it, called.contains(it)));
    let head = format!(
        "fn solve(at: &mut Frame, {last}: &Frame, {branches}: &mut Branches, conditions: &Conditions<'_>) -> Result<(), Failure>"
    );
    let mut inside = Code::default();
    inside.line("at.t = conditions.t;");
    if module.holds_coordinates() && frame_keeps_parameters(module) {
        inside.line("at.parameters = *conditions.parameters;");
    }
    inside.append(calls);
    let access = |symbol| module.field(symbol, "at");
    let checked = final_check(module, module.is_large(), access, "at.t");
    if checked.is_empty() {
        inside.line("Ok(())");
    } else {
        let failure = loads::blamed("not_finite(conditions.t, 0)", module);
        inside.open(format!("if all_finite(&[{}]) {{", checked.join(", ")));
        inside.line("Ok(())");
        inside.turn("} else {");
        inside.line(format!("Err({failure})"));
        inside.close("}");
    }
    let docs = ["Solves all blocks at one time, one after another."];
    code.function(docs, [], &head, inside);
}
