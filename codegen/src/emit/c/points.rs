//! Writes functions of a frame: motion of points, pressure angles and requested outputs.

use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{accessors, documentation};
use crate::program::{Function, Output};

/// Public function: documentation, declaration and body.
pub(super) struct Offered {
    pub lines: Vec<String>,
    pub declaration: String,
    pub body: Code,
}

/// Writes the declarations.
pub(super) fn declare(offered: &[Offered], text: &mut Code) {
    for function in offered {
        text.gap();
        text.comment(&function.lines);
        text.line(format!("LINKWRIGHT_FUNCTION {};", function.declaration));
    }
}

/// Writes the definitions.
pub(super) fn define(offered: Vec<Offered>, text: &mut Code) {
    for function in offered {
        text.gap();
        text.line(format!("LINKWRIGHT_FUNCTION {}", function.declaration));
        text.open("{");
        text.append(function.body);
        text.close("}");
    }
}

impl Printer<'_> {
    /// Returns the declaration of a function of a frame, such as `point_k`.
    pub(super) fn of_frame(&self, returned: &str, name: &str) -> String {
        let separator = if returned.ends_with('*') { "" } else { " " };
        format!(
            "{returned}{separator}{}(const {} *frame)",
            self.function(&name.to_lowercase()),
            self.type_of("Frame")
        )
    }
}

/// Functions of points and pressure angles; of the outputs if the description requests some.
pub(super) fn offered(printer: &Printer<'_>) -> Vec<Offered> {
    let module = printer.module;
    if let Some(outputs) = &module.program.outputs {
        return outputs
            .iter()
            .flat_map(|it| of_output(it, printer))
            .collect();
    }
    let motion = printer.runtime("point_motion");
    let points = module
        .system
        .outputs
        .iter()
        .zip(&module.program.points)
        .enumerate();
    let points = points.map(|(index, (output, function))| {
        let (mut body, results) = computed(printer, function);
        body.line(format!("{motion} found;"));
        let places = ["position", "velocity", "acceleration"].into_iter();
        let places = places.flat_map(|level| [format!("{level}[0]"), format!("{level}[1]")]);
        for (place, result) in places.zip(results) {
            body.line(format!("found.{place} = {result};"));
        }
        body.line("return found;");
        Offered {
            lines: documentation::of_point(index, module.system),
            declaration: printer.of_frame(&motion, &format!("point_{}", output.name)),
            body,
        }
    });
    let contacts = module
        .system
        .pressures
        .iter()
        .zip(&module.program.pressures);
    let contacts = contacts.map(|(pressure, function)| {
        let joint = &module.system.mechanism.joints[pressure.joint];
        let mut lines = documentation::of_pressure(pressure, module.system);
        lines.push("contact; false while the follower rests.".to_string());
        let (mut body, results) = computed(printer, function);
        let call = printer.runtime("pressure_angle");
        body.line(format!("return {call}({}, angle);", results.join(", ")));
        Offered {
            lines,
            declaration: format!(
                "bool {}(const {} *frame, {} *angle)",
                printer.function(&format!("pressure_angle_{}", joint.slug)),
                printer.type_of("Frame"),
                printer.real()
            ),
            body,
        }
    });
    points.chain(contacts).collect()
}

/// Names of the functions that return the motion of a point, in order.
pub(super) fn point_functions(printer: &Printer<'_>) -> Vec<String> {
    let name = |name: &str| printer.function(&format!("point_{}", name.to_lowercase()));
    match &printer.module.program.outputs {
        None => printer
            .module
            .system
            .outputs
            .iter()
            .map(|it| name(&it.name))
            .collect(),
        Some(outputs) => outputs
            .iter()
            .filter_map(|output| match output {
                Output::Point { name: own, fields } if fields.len() == 3 => Some(name(own)),
                _ => None,
            })
            .collect(),
    }
}

/// Functions of one output.
fn of_output(output: &Output, printer: &Printer<'_>) -> Vec<Offered> {
    let functions = accessors::of_output(output).into_iter().map(|mut it| {
        match output {
            Output::Point { .. } => it.name = it.name.to_lowercase(),
            // The functions of the textbook formulation have these names.
            Output::Coordinate { name, .. } if ["phi_q", "phi_t"].contains(&name.as_str()) => {
                it.name.insert(name.len(), '_');
            }
            Output::Coordinate { .. } => {}
        }
        printer.accessor(it)
    });
    functions.collect()
}

/// Returns the statements of a function of a frame, and its results.
fn computed(printer: &Printer<'_>, function: &Function) -> (Code, Vec<String>) {
    let scope = Scope::new(printer.module, function, Place::Coordinates);
    let (reads, mut body) = (scope.reads(), Code::default());
    let coordinates = printer.type_of("Coordinates");
    for (is_read, name) in [
        (reads.position, "q"),
        (reads.rate, "qd"),
        (reads.acceleration, "qdd"),
    ] {
        if is_read {
            body.line(format!(
                "const {coordinates} *const {name} = &frame->{name};"
            ));
        }
    }
    if reads.parameters {
        let parameters = printer.type_of("Parameters");
        body.line(format!(
            "const {parameters} *const parameters = &frame->parameters;"
        ));
    }
    if !(reads.position || reads.rate || reads.acceleration || reads.parameters) {
        body.line("(void)frame;");
    }
    printer.plain_statements(&scope, &mut body);
    let results = printer.results(&scope);
    (body, results)
}
