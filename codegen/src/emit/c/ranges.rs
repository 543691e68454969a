//! Writes the ranges of parameters and inputs, and the functions that refuse values outside of them.

use super::comment::quoted;
use super::printer::Printer;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::model::{Dimension, field_name, si_unit};

/// Parameters, or else inputs.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Limited {
    Parameters,
    Inputs,
}

/// Parameter or input with its range.
struct Ranged<'a> {
    name: &'a str,
    dimension: Dimension,
    ends: Option<[f64; 2]>,
}

/// All that may have ranges.
const LIMITED: [Limited; 2] = [Limited::Parameters, Limited::Inputs];

impl Limited {
    fn noun(self) -> &'static str {
        match self {
            Limited::Parameters => "parameter",
            Limited::Inputs => "input",
        }
    }

    fn table(self) -> String {
        format!("{}_RANGES", self.noun().to_uppercase())
    }

    /// Returns all parameters or inputs; empty if none has a range.
    fn all<'a>(self, printer: &Printer<'a>) -> Vec<Ranged<'a>> {
        let mechanism = &printer.module.system.mechanism;
        let all: Vec<Ranged<'a>> = match self {
            Limited::Parameters => {
                let parameters = mechanism.parameters.iter();
                parameters
                    .map(|it| Ranged {
                        name: &it.name,
                        dimension: it.dimension,
                        ends: it.range,
                    })
                    .collect()
            }
            Limited::Inputs => {
                let inputs = mechanism.inputs.iter();
                inputs
                    .map(|it| Ranged {
                        name: &it.name,
                        dimension: it.dimension,
                        ends: it.range,
                    })
                    .collect()
            }
        };
        match all.iter().any(|it| it.ends.is_some()) {
            true => all,
            false => Vec::new(),
        }
    }

    fn function(self, printer: &Printer<'_>) -> String {
        printer.own(&format!("refuse_{}s", self.noun()))
    }
}

/// Declares the tables of ranges in the header.
pub(super) fn declarations(printer: &Printer<'_>, text: &mut Code) {
    for limited in LIMITED {
        let count = limited.all(printer).len();
        if count > 0 {
            text.comment([documentation::of_ranges(limited.noun())]);
            text.line(format!("extern {};", declared(limited, count, printer)));
        }
    }
}

/// Defines the tables of ranges.
pub(super) fn definitions(printer: &Printer<'_>, text: &mut Code) {
    for limited in LIMITED {
        let all = limited.all(printer);
        if all.is_empty() {
            continue;
        }
        text.gap();
        text.open(format!("{} = {{", declared(limited, all.len(), printer)));
        for it in all {
            let [low, high] = it.ends.unwrap_or([0.0; 2]).map(|end| printer.number(end));
            text.line(format!(
                "{{{}, {}, {}, {{{low}, {high}}}}},",
                quoted(it.name),
                quoted(&si_unit(it.dimension)),
                it.ends.is_some()
            ));
        }
        text.close("};");
    }
}

fn declared(limited: Limited, count: usize, printer: &Printer<'_>) -> String {
    format!(
        "const {} {}[{count}]",
        printer.runtime("value_range"),
        printer.constant(&limited.table())
    )
}

/// Writes the functions that refuse values outside of their ranges.
pub(super) fn functions(printer: &Printer<'_>, text: &mut Code) {
    for limited in LIMITED {
        let all = limited.all(printer);
        if !all.is_empty() {
            function(limited, &all, printer, text);
        }
    }
}

fn function(limited: Limited, all: &[Ranged<'_>], printer: &Printer<'_>, text: &mut Code) {
    let (real, note) = (printer.real(), printer.runtime("outside_range"));
    let (kind, values, member) = match limited {
        Limited::Parameters => ("Parameters", "parameters", ""),
        Limited::Inputs => ("Inputs", "inputs", ".value"),
    };
    text.gap();
    text.comment([format!(
        "Notes the first {} outside of its range; returns LINKWRIGHT_OK if there is none.",
        limited.noun()
    )]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static linkwright_status {}(const {} *{values}, {} *failure, {real} t)",
        limited.function(printer),
        printer.type_of(kind),
        printer.runtime("failure")
    ));
    text.open("{");
    for (index, it) in all.iter().enumerate() {
        let Some(ends) = it.ends else { continue };
        let [low, high] = ends.map(|end| printer.number(end));
        let value = format!("{values}->{}{member}", identifier(&field_name(it.name)));
        let (column, place) = match limited {
            Limited::Parameters => (0, index),
            Limited::Inputs => (index + 1, 0),
        };
        text.open(format!("if (({value} < {low}) || ({value} > {high})) {{"));
        text.line(format!(
            "return {note}(failure, {value}, {column}U, t, {place}U);"
        ));
        text.close("}");
    }
    text.line("return LINKWRIGHT_OK;");
    text.close("}");
}

/// Returns the statements that set `status` to the failure of a parameter and of an input; `None` without ranges.
pub(super) fn refusals(printer: &Printer<'_>, time: &str) -> [Option<String>; 2] {
    LIMITED.map(|limited| Some(format!("status = {};", call(limited, time, printer)?)))
}

/// Writes the statements of a function that return the failure of a parameter; nothing without ranges.
pub(super) fn refuse_parameters(printer: &Printer<'_>, time: &str, body: &mut Code) {
    refuse(Limited::Parameters, time, printer, body);
}

/// Writes the statements of a function that return the failure of an input; nothing without ranges.
pub(super) fn refuse_inputs(printer: &Printer<'_>, body: &mut Code) {
    refuse(Limited::Inputs, "t", printer, body);
}

fn refuse(limited: Limited, time: &str, printer: &Printer<'_>, body: &mut Code) {
    let Some(call) = call(limited, time, printer) else {
        return;
    };
    let noun = limited.noun();
    body.line(format!("const linkwright_status of_{noun} = {call};"));
    body.open(format!("if (of_{noun} != LINKWRIGHT_OK) {{"));
    body.line(format!("return of_{noun};"));
    body.close("}");
}

/// Returns the call that notes the first value outside of its range; `None` without ranges.
fn call(limited: Limited, time: &str, printer: &Printer<'_>) -> Option<String> {
    let (noun, function) = (limited.noun(), limited.function(printer));
    let is_limited = !limited.all(printer).is_empty();
    is_limited.then(|| format!("{function}({noun}s, &mechanism->failure, {time})"))
}

/// True if an input has a range.
pub(super) fn limit_inputs(printer: &Printer<'_>) -> bool {
    !Limited::Inputs.all(printer).is_empty()
}
