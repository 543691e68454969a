//! The functions that a user calls.

use super::points::Offered;
use super::printer::Printer;
use super::text::Text;
use crate::emit::module::tubes::tube_count;

/// Where everything of a mechanism is, as the runtime sees it.
pub(super) fn parts(printer: &Printer<'_>, text: &mut Text) {
    let (mechanism, declared) = (printer.runtime("mechanism"), printer.declared());
    text.gap();
    text.comment(["Where everything of the mechanism is, as the runtime sees it."]);
    text.line(format!(
        "static {mechanism} {}({} *mechanism)",
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
        ("blocks", format!("&{}", printer.own_constant("BLOCKS"))),
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
            "tubes",
            null(tube_count(printer.module) > 0, "mechanism->tubes"),
        ),
    ];
    for (field, value) in fields {
        text.line(format!("parts.{field} = {value};"));
    }
    text.line("return parts;");
    text.close("}");
    in_steps(printer, text);
}

/// What needs the most room, apart from what is called often.
fn in_steps(printer: &Printer<'_>, text: &mut Text) {
    let (mechanism, room, real) = (
        printer.runtime("mechanism"),
        printer.runtime("room"),
        printer.real(),
    );
    let has_inputs = printer.declared().inputs;
    text.gap();
    text.comment(["Goes on in several steps where one has failed."]);
    text.line(format!(
        "static LINKWRIGHT_APART linkwright_status {}(const {mechanism} *parts, {real} t, const void *inputs)",
        printer.own("advance_in_steps")
    ));
    text.open("{");
    text.line(format!(
        "{} frames[LINKWRIGHT_WAY_FRAMES];",
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
        "const {room} room = {{frames, branches, {between}}};"
    ));
    text.line(format!(
        "return {}(parts, t, inputs, &room);",
        printer.runtime("advance_in_steps")
    ));
    text.close("}");
}

/// What is passed to a function of the interface beside what it is always given.
struct Given {
    parameters: String,
    inputs: String,
    passed_parameters: &'static str,
    passed_inputs: &'static str,
    any_inputs: &'static str,
}

impl Given {
    fn of(printer: &Printer<'_>) -> Given {
        let declared = printer.declared();
        let argument = |is_there: bool, kind: &str, name: &str| match is_there {
            true => format!("const {} *{name}", printer.type_of(kind)),
            false => String::new(),
        };
        Given {
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

/// Arguments without those that do not exist.
fn listed(arguments: &[&str]) -> String {
    let given = arguments.iter().filter(|it| !it.is_empty()).copied();
    given.collect::<Vec<_>>().join(", ")
}

/// The functions that assemble and move the mechanism.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let mut offered = assemblies(printer);
    offered.extend(motion(printer));
    if printer.declared().parameters {
        offered.push(set_parameters(printer));
    }
    offered
}

fn function(printer: &Printer<'_>, lines: &[&str], name: &str, arguments: &[&str]) -> Offered {
    let name = printer.function(name);
    Offered {
        lines: lines.iter().map(|line| line.to_string()).collect(),
        declaration: format!("linkwright_status {name}({})", listed(arguments)),
        body: Text::default(),
    }
}

fn assemblies(printer: &Printer<'_>) -> Vec<Offered> {
    let (given, real) = (Given::of(printer), printer.real());
    let mechanism = format!("{} *mechanism", printer.type_prefix);
    let coordinates = format!("const {} *estimate", printer.type_of("Coordinates"));
    let branches = format!("const {} *branches", printer.type_of("Branches"));
    let settings = format!("const {} *settings", printer.runtime("settings"));
    let time = format!("{real} t");
    let default = format!("&LINKWRIGHT{}_SETTINGS", printer.suffix().to_uppercase());
    let [drawn, drawn_branches] =
        ["DRAWN", "DRAWN_BRANCHES"].map(|it| format!("&{}", printer.constant(it)));
    let nominal = match given.parameters.is_empty() {
        true => String::new(),
        false => format!("&{}", printer.nominal_constant()),
    };
    let with = printer.function("assemble_with");
    let call = |arguments: &[&str]| format!("return {with}({});", listed(arguments));

    let mut assemble = function(
        printer,
        &["Assembles the mechanism at time t (s) as it is drawn."],
        "assemble",
        &[&mechanism, &time, &given.inputs],
    );
    assemble.body.line(call(&[
        "mechanism",
        &nominal,
        &drawn,
        &drawn_branches,
        "t",
        given.passed_inputs,
        &default,
    ]));
    let mut on = function(
        printer,
        &["The same in other modes than the drawing's."],
        "assemble_on",
        &[&mechanism, &branches, &time, &given.inputs],
    );
    on.body.line(call(&[
        "mechanism",
        &nominal,
        &drawn,
        "branches",
        "t",
        given.passed_inputs,
        &default,
    ]));
    let mut from = function(
        printer,
        &[
            "The same in the drawing's modes, with angles near those of an estimate, a measured pose for example.",
        ],
        "assemble_from",
        &[&mechanism, &coordinates, &time, &given.inputs, &settings],
    );
    from.body.line(call(&[
        "mechanism",
        &nominal,
        "estimate",
        &drawn_branches,
        "t",
        given.passed_inputs,
        "settings",
    ]));
    let mut all = vec![assemble, on, from];
    if !given.parameters.is_empty() {
        all.push(assemble_for(
            printer,
            &given,
            &mechanism,
            &time,
            &drawn_branches,
            &default,
        ));
    }
    all.push(assemble_with(
        printer,
        &given,
        [&mechanism, &coordinates, &branches, &time, &settings],
    ));
    all
}

/// Assembles the drawing of other parameters.
fn assemble_for(
    printer: &Printer<'_>,
    given: &Given,
    mechanism: &str,
    time: &str,
    branches: &str,
    settings: &str,
) -> Offered {
    let mut offered = function(
        printer,
        &["Assembles the mechanism of these parameters at time t (s) as it is drawn."],
        "assemble_for",
        &[mechanism, &given.parameters, time, &given.inputs],
    );
    let (with, coordinates) = (
        printer.function("assemble_with"),
        printer.type_of("Coordinates"),
    );
    let pose = match printer.module.program.drawn.is_some() {
        true => {
            let drawn = printer.function("drawn");
            offered
                .body
                .line(format!("const {coordinates} pose = {drawn}(parameters);"));
            "&pose".to_string()
        }
        false => format!("&{}", printer.constant("DRAWN")),
    };
    let arguments = listed(&[
        "mechanism",
        "parameters",
        &pose,
        branches,
        "t",
        given.passed_inputs,
        settings,
    ]);
    offered.body.line(format!("return {with}({arguments});"));
    offered
}

/// Assembles with everything given.
fn assemble_with(printer: &Printer<'_>, given: &Given, arguments: [&str; 5]) -> Offered {
    let [mechanism, coordinates, branches, time, settings] = arguments;
    let mut offered = function(
        printer,
        &[
            "Assembles the mechanism at time t (s) in these modes, with angles near those of an estimate. Where a block needs",
            "Newton-Raphson, it starts from there, and the estimate may be poor.",
        ],
        "assemble_with",
        &[
            mechanism,
            &given.parameters,
            coordinates,
            branches,
            time,
            &given.inputs,
            settings,
        ],
    );
    let (parts, own) = (printer.runtime("mechanism"), printer.own("parts_of"));
    let (allow, assemble) = (printer.runtime("allow"), printer.runtime("assemble"));
    let body = &mut offered.body;
    body.line(format!("const {parts} parts = {own}(mechanism);"));
    body.line("linkwright_status status;");
    body.gap();
    body.line("mechanism->state.settings = *settings;");
    body.line("mechanism->branches = *branches;");
    for name in [given.passed_parameters, given.passed_inputs] {
        if !name.is_empty() {
            body.line(format!("mechanism->{name} = *{name};"));
        }
    }
    body.line(format!("status = {allow}(&parts, parts.parameters, t);"));
    body.open("if (status == LINKWRIGHT_OK) {");
    let passed = listed(&[
        "&mechanism->frames[1]",
        "estimate",
        given.passed_parameters,
        "t",
    ]);
    body.line(format!("{}({passed});", printer.own("set_estimate")));
    body.line(format!("status = {assemble}(&parts, t);"));
    body.close("}");
    body.line("return status;");
    offered
}

fn motion(printer: &Printer<'_>) -> Vec<Offered> {
    let (given, real, frame) = (Given::of(printer), printer.real(), printer.type_of("Frame"));
    let mechanism = format!("{} *mechanism", printer.type_prefix);
    let time = format!("{real} t");
    let (parts, own) = (printer.runtime("mechanism"), printer.own("parts_of"));
    let inputs = given.any_inputs;
    let mut advance = function(
        printer,
        &[
            "Moves the mechanism to time t (s), starting from the last frame, which a failure leaves as it is. Where one step is not",
            "enough it goes in several; the time of a failure is where the motion ends, or how far it could be followed.",
        ],
        "advance",
        &[&mechanism, &time, &given.inputs],
    );
    let body = &mut advance.body;
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
            "Solves for the frame at time t (s) in the modes of now, whether or not a path leads there: an entry of a table, say. The",
            "mechanism stays where it is.",
        ],
        "frame_at",
        &[&mechanism, &time, &given.inputs, &format!("{frame} *found")],
    );
    at.body
        .line(format!("const {parts} parts = {own}(mechanism);"));
    at.body
        .line(format!("{} branches;", printer.type_of("Branches")));
    at.body.line(format!(
        "return {}(&parts, t, {inputs}, found, &branches);",
        printer.runtime("frame_at")
    ));
    let mut last = Offered {
        lines: vec!["The last solved instant.".to_string()],
        declaration: format!(
            "const {frame} *{}(const {} *mechanism)",
            printer.function("frame"),
            printer.type_prefix
        ),
        body: Text::default(),
    };
    last.body
        .line("return &mechanism->frames[mechanism->state.second_is_last ? 1 : 0];");
    vec![advance, last, at]
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
        &[&mechanism, &Given::of(printer).parameters],
    );
    let (parts, own) = (printer.runtime("mechanism"), printer.own("parts_of"));
    let body = &mut offered.body;
    body.line(format!("const {parts} parts = {own}(mechanism);"));
    body.line(format!(
        "const linkwright_status status = {}(&parts, parameters, {}(mechanism)->t);",
        printer.runtime("allow"),
        printer.function("frame")
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

/// The pose in the drawing of given parameters, where they change it.
pub(super) fn drawn_pose(printer: &Printer<'_>) -> Option<Offered> {
    let function = printer.module.program.drawn.as_ref()?;
    let coordinates = printer.type_of("Coordinates");
    let mut body = Text::default();
    body.line(format!(
        "{} found[{}];",
        printer.real(),
        function.results.len()
    ));
    body.line(format!("{coordinates} pose;"));
    body.line(format!("{}(parameters, found);", printer.own("drawn")));
    for (place, coordinate) in printer.module.system.coordinates.iter().enumerate() {
        let name = super::words::identifier(&coordinate.name);
        body.line(format!("pose.{name} = found[{place}];"));
    }
    body.line("return pose;");
    Some(Offered {
        lines: vec![
            "The pose in the drawing of these parameters, from which the mechanism is assembled."
                .to_string(),
        ],
        declaration: format!(
            "{coordinates} {}(const {} *parameters)",
            printer.function("drawn"),
            printer.type_of("Parameters")
        ),
        body,
    })
}

impl Printer<'_> {
    /// The constant with the values that parameters have in the description, one for all motions.
    pub(super) fn nominal_constant(&self) -> String {
        let name = &self.module.system.mechanism.name;
        format!("{}_NOMINAL", name.to_uppercase())
    }
}
