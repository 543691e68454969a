//! Writes the functions that assemble a mechanism.

use super::api::{OptionalArguments, function, listed};
use super::points::Offered;
use super::printer::Printer;
use super::ranges;
use super::words::identifier;
use crate::emit::code::Code;

/// Functions that assemble the mechanism; all call the most general one.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let (optional, real) = (OptionalArguments::of(printer), printer.real());
    let mechanism = format!("{} *mechanism", printer.type_prefix);
    let coordinates = format!("const {} *estimate", printer.type_of("Coordinates"));
    let branches = format!("const {} *branches", printer.type_of("Branches"));
    let settings = format!("const {} *settings", printer.runtime("settings"));
    let time = format!("{real} t");
    let default = format!("&LINKWRIGHT{}_SETTINGS", printer.suffix().to_uppercase());
    let drawn_branches = format!("&{}", printer.constant("DESIGN_BRANCHES"));
    let nominal = match optional.parameters.is_empty() {
        true => String::new(),
        false => format!("&{}", printer.constant("NOMINAL")),
    };
    let with = printer.function("assemble_with");
    let call = |arguments: &[&str]| format!("return {with}({});", listed(arguments));

    let mut assemble = function(
        printer,
        &["Assembles the mechanism at time t (s) in the design configuration."],
        "assemble",
        &[&mechanism, &time, &optional.inputs],
    );
    let pose = drawn(printer, &nominal, &mut assemble.body);
    assemble.body.line(call(&[
        "mechanism",
        &nominal,
        &pose,
        &drawn_branches,
        "t",
        optional.passed_inputs,
        &default,
    ]));
    let mut on = function(
        printer,
        &["Assembles the mechanism at time t (s) in these assembly modes."],
        "assemble_on",
        &[&mechanism, &branches, &time, &optional.inputs],
    );
    let pose = drawn(printer, &nominal, &mut on.body);
    on.body.line(call(&[
        "mechanism",
        &nominal,
        &pose,
        "branches",
        "t",
        optional.passed_inputs,
        &default,
    ]));
    let mut from = function(
        printer,
        &[
            "Assembles the mechanism in the design modes, with angles near those of an estimate, such as a measured pose.",
        ],
        "assemble_from",
        &[&mechanism, &coordinates, &time, &optional.inputs, &settings],
    );
    from.body.line(call(&[
        "mechanism",
        &nominal,
        "estimate",
        &drawn_branches,
        "t",
        optional.passed_inputs,
        "settings",
    ]));
    let mut all = vec![assemble, on, from];
    if !optional.parameters.is_empty() {
        all.push(assemble_for(
            printer,
            &optional,
            &mechanism,
            &time,
            &drawn_branches,
            &default,
        ));
    }
    all.push(assemble_with(
        printer,
        &optional,
        [&mechanism, &coordinates, &branches, &time, &settings],
    ));
    all
}

/// Returns the function that assembles the design configuration of other parameters.
fn assemble_for(
    printer: &Printer<'_>,
    optional: &OptionalArguments,
    mechanism: &str,
    time: &str,
    branches: &str,
    settings: &str,
) -> Offered {
    let mut offered = function(
        printer,
        &[
            "Assembles the mechanism with these parameters at time t (s) in the design configuration.",
        ],
        "assemble_for",
        &[mechanism, &optional.parameters, time, &optional.inputs],
    );
    let with = printer.function("assemble_with");
    let pose = drawn(printer, "parameters", &mut offered.body);
    let arguments = listed(&[
        "mechanism",
        "parameters",
        &pose,
        branches,
        "t",
        optional.passed_inputs,
        settings,
    ]);
    offered.body.line(format!("return {with}({arguments});"));
    offered
}

/// Returns the argument for the design pose, which `body` computes if parameters change it.
fn drawn(printer: &Printer<'_>, parameters: &str, body: &mut Code) -> String {
    match printer.module.program.drawn.is_some() {
        true => {
            let (coordinates, drawn) = (printer.type_of("Coordinates"), printer.function("drawn"));
            body.line(format!("const {coordinates} pose = {drawn}({parameters});"));
            "&pose".to_string()
        }
        false => format!("&{}", printer.constant("DESIGN")),
    }
}

/// Returns the most general function, with all arguments.
fn assemble_with(
    printer: &Printer<'_>,
    optional: &OptionalArguments,
    arguments: [&str; 5],
) -> Offered {
    let [mechanism, coordinates, branches, time, settings] = arguments;
    let mut offered = function(
        printer,
        &[
            "Assembles the mechanism at time t (s) in these modes, with angles near those of an estimate. Newton-Raphson",
            "starts from the estimate, which may be poor.",
        ],
        "assemble_with",
        &[
            mechanism,
            &optional.parameters,
            coordinates,
            branches,
            time,
            &optional.inputs,
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
    body.line("mechanism->state.is_assembled = false;");
    body.line("mechanism->branches = *branches;");
    for name in [optional.passed_parameters, optional.passed_inputs] {
        if !name.is_empty() {
            body.line(format!("mechanism->{name} = *{name};"));
        }
    }
    let allowed = format!("status = {allow}(&parts, parts.parameters, t);");
    let [of_parameters, of_inputs] = ranges::refusals(printer, "t");
    let checks = [of_parameters, Some(allowed), of_inputs]
        .into_iter()
        .flatten();
    for (place, check) in checks.enumerate() {
        if place == 0 {
            body.line(check);
        } else {
            body.open("if (status == LINKWRIGHT_OK) {");
            body.line(check);
            body.close("}");
        }
    }
    body.open("if (status == LINKWRIGHT_OK) {");
    let passed = listed(&[
        "&mechanism->frames[1]",
        "estimate",
        optional.passed_parameters,
        "t",
    ]);
    body.line(format!("{}({passed});", printer.own("set_estimate")));
    if printer.module.assemblies.is_some() {
        let begin = printer.own("begin");
        body.line(format!(
            "{begin}(&mechanism->branches, &mechanism->frames[1]);"
        ));
    }
    body.line(format!("status = {assemble}(&parts, t);"));
    body.close("}");
    body.line("return status;");
    offered
}

/// Returns the function of the design pose, if parameters change it.
pub(super) fn drawn_pose(printer: &Printer<'_>) -> Option<Offered> {
    let function = printer.module.program.drawn.as_ref()?;
    let coordinates = printer.type_of("Coordinates");
    let mut body = Code::default();
    body.line(format!(
        "{} found[{}];",
        printer.real(),
        function.results.len()
    ));
    body.line(format!("{coordinates} pose;"));
    body.line(format!("{}(parameters, found);", printer.own("drawn")));
    for (place, coordinate) in printer.module.system.coordinates.iter().enumerate() {
        let name = identifier(&coordinate.name);
        body.line(format!("pose.{name} = found[{place}];"));
    }
    body.line("return pose;");
    Some(Offered {
        lines: vec![
            "Returns the design pose for these parameters, from which the mechanism is assembled."
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
