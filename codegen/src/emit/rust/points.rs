//! The motion of points, and pressure angles, as functions of a frame that holds all coordinates.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::code::{Code, taken_apart};
use super::literal::count;
use super::names::{identifier, identifier_text};
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::{Function, Output};
use crate::system::Pressure;

/// One function for each point and each contact.
pub(super) fn methods(module: &Module<'_>) -> TokenStream {
    let system = module.system;
    let mut code = Code::default();
    let points = system
        .outputs
        .iter()
        .zip(&module.program.points)
        .enumerate();
    for (index, (output, function)) in points {
        let name = identifier_text(&format!("point_{}", output.name.to_lowercase()));
        let (mut statements, results) = computed(module, function);
        let [x, y, vx, vy, ax, ay] = results.as_slice() else {
            unreachable!("a point has two components of position, velocity and acceleration each")
        };
        statements.push(&motion(
            &format!("[{x}, {y}]"),
            &format!("[{vx}, {vy}]"),
            &format!("[{ax}, {ay}]"),
        ));
        let head = format!("pub fn {name}(&self) -> PointMotion");
        let text = documentation::of_point(index, system);
        code.function(text, [], &head, statements);
    }
    let contacts = system.pressures.iter().zip(&module.program.pressures);
    for (pressure, function) in contacts {
        pressure_angle(module, pressure, function, &mut code);
    }
    code.to_token_stream()
}

/// The motion of a point of this position, velocity and acceleration, in lines.
pub(super) fn motion(position: &str, velocity: &str, acceleration: &str) -> String {
    format!(
        "PointMotion {{\n    position: {position},\n    velocity: {velocity},\n    acceleration: {acceleration},\n}}"
    )
}

/// The points by name, for code that is written for any mechanism.
pub(super) fn table(module: &Module<'_>) -> TokenStream {
    let entry = |name: &str| {
        let function = identifier(&format!("point_{}", name.to_lowercase()));
        quote!((#name, Frame::#function))
    };
    let entries: Vec<TokenStream> = match &module.program.outputs {
        None => module
            .system
            .outputs
            .iter()
            .map(|it| entry(&it.name))
            .collect(),
        Some(outputs) => outputs
            .iter()
            .filter_map(|output| match output {
                Output::Point { name, fields } if fields.len() == 3 => Some(entry(name)),
                _ => None,
            })
            .collect(),
    };
    let number = count(entries.len());
    quote! {
        /// The points whose motion frames offer, by name.
        const POINTS: [NamedPoint<Frame>; #number] = [#(#entries),*];
    }
}

/// `fn pressure_angle_NAME`.
fn pressure_angle(module: &Module<'_>, pressure: &Pressure, function: &Function, code: &mut Code) {
    let joint = &module.system.mechanism.joints[pressure.joint];
    let name = identifier_text(&format!("pressure_angle_{}", joint.slug));
    let mut lines = documentation::of_pressure(pressure, module.system);
    lines.push("contact; `None` while the follower rests.".to_string());
    let (mut statements, results) = computed(module, function);
    statements.push(&format!("pressure_angle({})", results.join(", ")));
    let head = format!("pub fn {name}(&self) -> Option<Scalar>");
    code.function(lines, [], &head, statements);
}

/// The statements of a method of the frame, and its results.
fn computed(module: &Module<'_>, function: &Function) -> (Code, Vec<String>) {
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results, reads) = (
        scope.plain_statements(),
        scope.written_results(),
        scope.reads(),
    );
    let read = [
        (reads.position, "q"),
        (reads.rate, "qd"),
        (reads.acceleration, "qdd"),
        (reads.parameters, "parameters"),
    ];
    let mut code = Code::default();
    if let Some(taken) = taken_apart("Self", "self", &read) {
        code.lines(&taken);
    }
    code.append(statements);
    (code, results)
}
