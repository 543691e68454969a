//! The named coordinates.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::doc_lines;
use super::layout::Verbatim;
use super::module::{Module, derives};
use super::names::identifier;
use crate::system::{Described, System, Unknown};

/// `struct Coordinates` with its names and the drawn pose.
pub(super) fn coordinates(module: &Module<'_>) -> TokenStream {
    let system = module.system;
    let mut text = Verbatim::default();
    text.open("::linkwright::coordinates! {");
    text.docs([
        "The coordinates of all bodies: position of the origin in m, angle in rad. Also their rates (m/s, rad/s) and",
        "accelerations (m/s², rad/s²).",
    ]);
    text.tokens(derives(system.coordinates.len()));
    text.open("Coordinates: Scalar {");
    for coordinate in &system.coordinates {
        text.docs(doc_lines(field_text(coordinate, system)));
        // The estimates were found to be finite constants when they were read.
        let drawn = system.mechanism.graph.constant_value(coordinate.estimate);
        let (name, value) = (
            identifier(&coordinate.name),
            module.number(drawn.unwrap_or(0.0)),
        );
        text.line(format!("{name} = {value},"));
    }
    text.close("}");
    text.close("}");
    let item = text.item();
    quote!(#item)
}

/// What a coordinate is; the first of a body also carries what the description says of the body.
fn field_text(coordinate: &Unknown, system: &System) -> Vec<String> {
    let (body, axis) = match coordinate.describes {
        Described::Pose { body, axis } => (&system.mechanism.bodies[body], axis),
        Described::Contact { joint } => {
            let label = &system.mechanism.joints[joint].label;
            return vec![format!("Where `{label}` touches its curve.")];
        }
        Described::Auxiliary => return Vec::new(),
    };
    let name = &body.name;
    match axis {
        0 if body.docs.is_empty() => vec![format!("x of body {name}.")],
        0 => [format!("x of body {name}."), String::new()]
            .into_iter()
            .chain(body.docs.iter().cloned())
            .collect(),
        1 => vec![format!("y of body {name}.")],
        _ => vec![format!("Angle of body {name}.")],
    }
}
