//! Writes the group that moves mechanisms in lanes.
//!
//! All lanes are solved together. A lane that fails a check, or whose path is not verified yet, is advanced by the functions of one
//! mechanism. The other lanes keep their results.

use super::super::printer::{Printer, in_lane};
use super::super::ranges;
use super::super::runtime::in_scalar;
use super::super::words::identifier;
use super::blocks;
use crate::emit::code::Code;

/// Declarations and definitions, with marks as in the runtime. `?` and a condition begin lines for some mechanisms only.
const DECLARATIONS: &str = include_str!("group.h");
const DEFINITIONS: &str = include_str!("group.c");

/// Declares the structure of a group and its functions.
pub(super) fn declarations(printer: &Printer<'_>, text: &mut Code) {
    write(DECLARATIONS, printer, text);
}

/// Defines the functions of a group.
pub(super) fn definitions(printer: &Printer<'_>, text: &mut Code) {
    write(DEFINITIONS, printer, text);
}

fn write(template: &str, printer: &Printer<'_>, text: &mut Code) {
    let kept = template.lines().filter_map(|line| kept(line, printer));
    let kept: Vec<&str> = kept.collect();
    let has_inputs = printer.declared().inputs;
    let inputs = |declared: &str| match has_inputs {
        true => declared.to_string(),
        false => String::new(),
    };
    let any_input = if has_inputs { "given" } else { "NULL" };
    let structure = printer.type_of("Inputs");
    let lanes = printer.lanes();
    let [_, passed] = blocks::of_all(printer);
    let passed = passed.split(", ").map(|argument| match argument {
        "at" => "&group->frames[1U - last]".to_string(),
        "last" => "&group->frames[last]".to_string(),
        "branches" | "parameters" | "inputs" => format!("&group->{argument}"),
        _ => argument.to_string(),
    });
    let passed = passed.collect::<Vec<_>>().join(", ");
    let marks = [
        ("$signs", signs(printer)),
        (
            "$signals",
            format!("{}U", printer.module.system.mechanism.inputs.len()),
        ),
        ("$with_inputs", inputs(" with its own inputs")),
        (
            "$declared_inputs",
            inputs(&format!(", const {structure} given[{lanes}]")),
        ),
        (
            "$declared_input",
            inputs(&format!(", const {structure} *given")),
        ),
        ("$passed_input", inputs(", given")),
        ("$any_input", any_input.to_string()),
        ("$passed", passed),
        ("$given", inputs(", &given[lane]")),
        ("$Mechanism", printer.type_prefix.clone()),
        ("$mechanism", printer.prefix.clone()),
        ("$own_", printer.own.clone()),
        ("$LANES", lanes),
        ("$word", printer.word().to_string()),
    ];
    let marked = kept.join("\n");
    let written = marks
        .iter()
        .fold(marked, |text, (mark, value)| text.replace(mark, value));
    for line in in_scalar(&written, printer.module.scalar).lines() {
        add(line.trim_start(), text);
    }
}

/// Adds a line at the depth that the lines before it open.
fn add(line: &str, text: &mut Code) {
    let comment = line.strip_prefix("/* ");
    match (line.starts_with('}'), line.ends_with('{'), comment) {
        (true, true, _) => text.turn(line),
        (true, false, _) => text.close(line),
        (false, true, _) => text.open(line),
        (false, false, Some(comment)) => text.comment([comment.trim_end_matches(" */")]),
        (false, false, None) => text.line(line),
    }
}

/// Returns a line without its condition; `None` if the condition is false for the mechanism.
fn kept<'a>(line: &'a str, printer: &Printer<'_>) -> Option<&'a str> {
    let Some(conditional) = line.strip_prefix('?') else {
        return Some(line);
    };
    let (condition, line) = conditional.split_once(' ').unwrap_or((conditional, ""));
    let (module, declared) = (printer.module, printer.declared());
    let is_guarded = module.program.path.is_some();
    let holds = match condition {
        "signs" => !module.program.branches.is_empty(),
        "parameters" => declared.parameters,
        "inputs" => declared.inputs,
        "ranges" => ranges::limit_inputs(printer),
        "guarded" => is_guarded,
        "guarded_inputs" => is_guarded && declared.inputs,
        "unguarded_inputs" => !is_guarded && declared.inputs,
        _ => !is_guarded,
    };
    holds.then_some(line)
}

/// Returns the assignments of the signs of a lane's modes.
fn signs(printer: &Printer<'_>) -> String {
    let branches = printer.module.program.branches.iter();
    let signs = branches.map(|branch| {
        let name = identifier(&branch.name);
        let sign = in_lane(&format!("group->branches.{name}"));
        format!(
            "    {sign} = ({})mechanism->branches.{name};",
            printer.real()
        )
    });
    signs.collect::<Vec<_>>().join("\n")
}
