//! The functions that move a mechanism.

use super::assembly;
use super::points::Offered;
use super::printer::Printer;
use super::ranges;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::path_enclosures::enclosure_count;

/// Writes the function that gives the runtime pointers to the parts of a mechanism, and `advance_in_steps`.
pub(super) fn parts(printer: &Printer<'_>, text: &mut Code) {
    let (mechanism, declared) = (printer.runtime("mechanism"), printer.declared());
    text.gap();
    text.comment(["Returns pointers to the parts of the mechanism, for the runtime."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static {mechanism} {}({} *mechanism)",
        printer.own("parts_of"),
        printer.type_prefix
    ));
    text.open("{");
    text.line(format!("{mechanism} parts;"));
    let null = |is_there: bool, value: &str| match is_there {
        true => value.to_string(),
        false => "NULL".to_string(),
    };
    let fields = [
        ("blocks", format!("{}()", printer.own("descriptor"))),
        ("state", "&mechanism->state".to_string()),
        ("failure", "&mechanism->failure".to_string()),
        ("frames[0]", "&mechanism->frames[0]".to_string()),
        ("frames[1]", "&mechanism->frames[1]".to_string()),
        ("branches", "&mechanism->branches".to_string()),
        (
            "parameters",
            null(declared.parameters, "&mechanism->parameters"),
        ),
        ("inputs", null(declared.inputs, "&mechanism->inputs")),
        (
            "window_inputs[0]",
            null(declared.inputs, "&mechanism->window_inputs[0]"),
        ),
        (
            "window_inputs[1]",
            null(declared.inputs, "&mechanism->window_inputs[1]"),
        ),
        (
            "enclosures",
            null(enclosure_count(printer.module) > 0, "mechanism->enclosures"),
        ),
    ];
    for (field, value) in fields {
        text.line(format!("parts.{field} = {value};"));
    }
    text.line("return parts;");
    text.close("}");
    in_steps(printer, text);
}

/// Writes `advance_in_steps` as a function of its own, whose large workspace is then not on the stack of every step.
fn in_steps(printer: &Printer<'_>, text: &mut Code) {
    let (mechanism, workspace, real) = (
        printer.runtime("mechanism"),
        printer.runtime("workspace"),
        printer.real(),
    );
    let has_inputs = printer.declared().inputs;
    text.gap();
    text.comment(["Retries a failed step in substeps."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static LINKWRIGHT_APART linkwright_status {}(const {mechanism} *parts, {real} t, const void *inputs)",
        printer.own("advance_in_steps")
    ));
    text.open("{");
    text.line(format!(
        "{} frames[LINKWRIGHT_SUBSTEP_FRAMES];",
        printer.type_of("Frame")
    ));
    text.line(format!(
        "{} branches[LINKWRIGHT_WAY_BRANCHES];",
        printer.type_of("Branches")
    ));
    if has_inputs {
        text.line(format!(
            "{} between[LINKWRIGHT_WAY_INPUTS];",
            printer.type_of("Inputs")
        ));
    }
    let between = if has_inputs { "between" } else { "NULL" };
    text.line(format!(
        "const {workspace} workspace = {{frames, branches, {between}}};"
    ));
    text.line(format!(
        "return {}(parts, t, inputs, &workspace);",
        printer.runtime("advance_in_steps")
    ));
    text.close("}");
}

/// Optional arguments of an API function: empty or `NULL` if the mechanism has no parameters or inputs.
pub(super) struct OptionalArguments {
    pub parameters: String,
    pub inputs: String,
    pub passed_parameters: &'static str,
    pub passed_inputs: &'static str,
    any_inputs: &'static str,
}

impl OptionalArguments {
    pub(super) fn of(printer: &Printer<'_>) -> OptionalArguments {
        let declared = printer.declared();
        let argument = |is_there: bool, kind: &str, name: &str| match is_there {
            true => format!("const {} *{name}", printer.type_of(kind)),
            false => String::new(),
        };
        OptionalArguments {
            parameters: argument(declared.parameters, "Parameters", "parameters"),
            inputs: argument(declared.inputs, "Inputs", "inputs"),
            passed_parameters: if declared.parameters {
                "parameters"
            } else {
                ""
            },
            passed_inputs: if declared.inputs { "inputs" } else { "" },
            any_inputs: if declared.inputs { "inputs" } else { "NULL" },
        }
    }
}

/// Returns the arguments that are not empty, as a list.
pub(super) fn listed(arguments: &[&str]) -> String {
    let present = arguments.iter().filter(|it| !it.is_empty()).copied();
    present.collect::<Vec<_>>().join(", ")
}

/// Functions that assemble and move the mechanism.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let mut offered = assembly::offered(printer);
    offered.extend(motion(printer));
    if printer.declared().parameters {
        offered.push(set_parameters(printer));
    }
    offered
}

/// Returns a function that can fail, with an empty body.
pub(super) fn function(
    printer: &Printer<'_>,
    lines: &[&str],
    name: &str,
    arguments: &[&str],
) -> Offered {
    let name = printer.function(name);
    Offered {
        lines: lines.iter().map(|line| line.to_string()).collect(),
        declaration: format!("linkwright_status {name}({})", listed(arguments)),
        body: Code::default(),
    }
}

fn motion(printer: &Printer<'_>) -> Vec<Offered> {
    let (optional, real, frame) = (
        OptionalArguments::of(printer),
        printer.real(),
        printer.type_of("Frame"),
    );
    let mechanism = format!("{} *mechanism", printer.type_prefix);
    let time = format!("{real} t");
    let (parts, own) = (printer.runtime("mechanism"), printer.own("parts_of"));
    let inputs = optional.any_inputs;
    let mut advance = function(
        printer,
        &[
            "Moves the mechanism from the last frame to time t (s). A failure leaves the last frame unchanged. If one step fails,",
            "shorter steps follow; the time of a failure is the end of the motion, or of the path that was verified.",
        ],
        "advance",
        &[&mechanism, &time, &optional.inputs],
    );
    let body = &mut advance.body;
    ranges::refuse_inputs(printer, body);
    body.line(format!("const {parts} parts = {own}(mechanism);"));
    body.line(format!(
        "linkwright_status status = {}(&parts, t, {inputs});",
        printer.runtime("advance")
    ));
    body.open("if (status != LINKWRIGHT_OK) {");
    body.line(format!(
        "status = {}(&parts, t, {inputs});",
        printer.own("advance_in_steps")
    ));
    body.close("}");
    body.line("return status;");
    let mut at = function(
        printer,
        &[
            "Solves for the frame at time t (s) in the current modes, without verification of a path, as for a table entry. The",
            "mechanism does not move.",
        ],
        "frame_at",
        &[
            &mechanism,
            &time,
            &optional.inputs,
            &format!("{frame} *found"),
        ],
    );
    ranges::refuse_inputs(printer, &mut at.body);
    at.body
        .line(format!("const {parts} parts = {own}(mechanism);"));
    at.body
        .line(format!("{} branches;", printer.type_of("Branches")));
    at.body.line(format!(
        "return {}(&parts, t, {inputs}, found, &branches);",
        printer.runtime("frame_at")
    ));
    let mut last = Offered {
        lines: vec![
            "Returns the last frame; NULL after a failed assembly, until an assembly succeeds."
                .to_string(),
        ],
        declaration: format!(
            "const {frame} *{}(const {} *mechanism)",
            printer.function("frame"),
            printer.type_prefix
        ),
        body: Code::default(),
    };
    last.body.line(format!(
        "const {frame} *const last = &mechanism->frames[mechanism->state.second_is_last ? 1 : 0];"
    ));
    last.body
        .line("return mechanism->state.is_assembled ? last : NULL;");
    vec![advance, last, at, advance_by(printer), recover(printer)]
}

fn advance_by(printer: &Printer<'_>) -> Offered {
    let (optional, real) = (OptionalArguments::of(printer), printer.real());
    let mechanism = format!("{} *mechanism", printer.type_prefix);
    let mut offered = function(
        printer,
        &[
            "Advances the mechanism by a duration (s) from the last frame. The times of successive calls are a compensated",
            "sum; a failure does not advance the time.",
        ],
        "advance_by",
        &[&mechanism, &format!("{real} duration"), &optional.inputs],
    );
    let (parts, own) = (printer.runtime("mechanism"), printer.own("parts_of"));
    let arguments = listed(&["mechanism", "t", optional.passed_inputs]);
    let body = &mut offered.body;
    body.line(format!("const {parts} parts = {own}(mechanism);"));
    body.line(format!("{real} rest;"));
    body.line(format!(
        "const {real} t = {}(&parts, duration, &rest);",
        printer.runtime("time_after")
    ));
    body.line(format!(
        "const linkwright_status status = {}({arguments});",
        printer.function("advance")
    ));
    body.open("if (status == LINKWRIGHT_OK) {");
    body.line("mechanism->state.sum = t;");
    body.line("mechanism->state.rest = rest;");
    body.close("}");
    body.line("return status;");
    offered
}

fn recover(printer: &Printer<'_>) -> Offered {
    let optional = OptionalArguments::of(printer);
    let holds_coordinates = printer.module.holds_coordinates();
    let jump = match holds_coordinates {
        true => format!("{} *jump", printer.type_of("Coordinates")),
        false => String::new(),
    };
    let mut lines = vec![
        "Assembles the mechanism at time t (s) near the last frame in its modes, without verification of a path, after signals",
        "were missing, for example. A failure leaves the last frame unchanged.",
    ];
    if holds_coordinates {
        lines.push("The jump is the change of each coordinate, in m or rad.");
    }
    let mut offered = function(
        printer,
        &lines,
        "recover",
        &[
            &format!("{} *mechanism", printer.type_prefix),
            &format!("{} t", printer.real()),
            &optional.inputs,
            &jump,
        ],
    );
    let (parts, own) = (printer.runtime("mechanism"), printer.own("parts_of"));
    let body = &mut offered.body;
    ranges::refuse_inputs(printer, body);
    body.line(format!("const {parts} parts = {own}(mechanism);"));
    body.line(format!("{} branches;", printer.type_of("Branches")));
    let call = format!(
        "{}(&parts, t, {}, &branches)",
        printer.runtime("recover"),
        optional.any_inputs
    );
    if !holds_coordinates {
        body.line(format!("return {call};"));
        return offered;
    }
    let frame = printer.type_of("Frame");
    body.line(format!(
        "const {frame} *const last = (const {frame} *){}(&parts);",
        printer.runtime("last_frame")
    ));
    body.line(format!("const linkwright_status status = {call};"));
    body.open("if (status == LINKWRIGHT_OK) {");
    body.line(format!(
        "const {frame} *const found = (const {frame} *){}(&parts);",
        printer.runtime("last_frame")
    ));
    for coordinate in &printer.module.system.coordinates {
        let name = identifier(&coordinate.name);
        body.line(format!("jump->{name} = found->q.{name} - last->q.{name};"));
    }
    body.close("}");
    body.line("return status;");
    offered
}

fn set_parameters(printer: &Printer<'_>) -> Offered {
    let mechanism = format!("{} *mechanism", printer.type_prefix);
    let mut offered = function(
        printer,
        &[
            "Changes the parameters. The last frame stays as it was solved; the next one is solved with these, in the same modes, with",
            "angles near those of the last one. Values that the description may not have, such as a negative length, are refused, and the",
            "parameters then stay as they are.",
        ],
        "set_parameters",
        &[&mechanism, &OptionalArguments::of(printer).parameters],
    );
    let (parts, own) = (printer.runtime("mechanism"), printer.own("parts_of"));
    let body = &mut offered.body;
    body.line(format!("const {parts} parts = {own}(mechanism);"));
    body.line(format!(
        "const {} *const last = {}(mechanism);",
        printer.type_of("Frame"),
        printer.function("frame")
    ));
    let time = "(last != NULL) ? last->t : mechanism->failure.time";
    ranges::refuse_parameters(printer, time, body);
    body.line(format!(
        "const linkwright_status status = {}(&parts, parameters, {time});",
        printer.runtime("allow")
    ));
    body.open("if (status == LINKWRIGHT_OK) {");
    body.line("mechanism->parameters = *parameters;");
    body.line(format!(
        "{}(&parts);",
        printer.runtime("parameters_changed")
    ));
    body.close("}");
    body.line("return status;");
    offered
}
