//! Writes the motion of points and pressure angles as methods of a frame with all coordinates.

use super::code::taken_apart;
use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::{Function, Output};
use crate::system::Pressure;

/// Writes one method for each point and each contact.
pub(super) fn methods(module: &Module<'_>, code: &mut Code) {
    let system = module.system;
    let points = system
        .outputs
        .iter()
        .zip(&module.program.points)
        .enumerate();
    for (index, (output, function)) in points {
        let name = identifier(&format!("point_{}", output.name.to_lowercase()));
        let (mut statements, results) = computed(module, function);
        let [x, y, vx, vy, ax, ay] = results.as_slice() else {
            unreachable!("a point has two components of position, velocity and acceleration each")
        };
        let levels = [[x, y], [vx, vy], [ax, ay]];
        statements.record("PointMotion", levels.map(|[x, y]| format!("[{x}, {y}]")));
        let head = format!("pub fn {name}(&self) -> PointMotion");
        let text = documentation::of_point(index, system);
        code.function(text, [], &head, statements);
    }
    let contacts = system.pressures.iter().zip(&module.program.pressures);
    for (pressure, function) in contacts {
        pressure_angle(module, pressure, function, code);
    }
}

/// Writes the list of points by name, for code that works with any mechanism.
pub(super) fn table(module: &Module<'_>, code: &mut Code) {
    let all = module.system.outputs.iter().map(|it| &it.name);
    let names: Vec<&String> = match &module.program.outputs {
        None => all.collect(),
        Some(outputs) => outputs
            .iter()
            .filter_map(|output| match output {
                Output::Point { name, fields } if fields.len() == 3 => Some(name),
                _ => None,
            })
            .collect(),
    };
    let entries = names.iter().map(|name| {
        let function = identifier(&format!("point_{}", name.to_lowercase()));
        format!("({name:?}, Frame::{function})")
    });
    let entries: Vec<String> = entries.collect();
    code.gap();
    code.docs(["Points of a frame, by name."]);
    code.line(format!(
        "const POINTS: [NamedPoint<Frame>; {}] = [{}];",
        entries.len(),
        entries.join(", ")
    ));
}

/// Writes `fn pressure_angle_NAME`.
fn pressure_angle(module: &Module<'_>, pressure: &Pressure, function: &Function, code: &mut Code) {
    let joint = &module.system.mechanism.joints[pressure.joint];
    let name = identifier(&format!("pressure_angle_{}", joint.slug));
    let mut lines = documentation::of_pressure(pressure, module.system);
    lines.push("contact; `None` while the follower rests.".to_string());
    let (mut statements, results) = computed(module, function);
    statements.line(format!("pressure_angle({})", results.join(", ")));
    let head = format!("pub fn {name}(&self) -> Option<Scalar>");
    code.function(lines, [], &head, statements);
}

/// Returns the statements of a method of the frame, and its results.
fn computed(module: &Module<'_>, function: &Function) -> (Code, Vec<String>) {
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results, reads) = (scope.plain_statements(), scope.results(), scope.reads());
    let read = [
        (reads.position, "q"),
        (reads.rate, "qd"),
        (reads.acceleration, "qdd"),
        (reads.parameters, "parameters"),
    ];
    let mut code = Code::default();
    if let Some(taken) = taken_apart("Self", "self", &read) {
        code.line(taken);
    }
    code.append(statements);
    (code, results)
}
