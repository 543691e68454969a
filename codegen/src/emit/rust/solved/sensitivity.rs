//! How the motion depends on parameters, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::names::plain_name;
use crate::emit::rust::coordinates::derives;
use crate::emit::rust::docs::docs;
use crate::emit::rust::expression::identifier;
use crate::emit::rust::literal::float;
use crate::joint::Quantity;
use crate::program::solved::{Found, SensitiveQuantity, Sensitivity, SolvedProgram};
use crate::system::System;

/// `struct Sensitivity` and `struct PointSensitivity`, as far as something returns them.
pub(in crate::emit::rust) fn structures(solved: &SolvedProgram) -> TokenStream {
    let coordinates = solved
        .sensitivities
        .iter()
        .find_map(|it| it.coordinates.as_ref());
    let whole = coordinates.map(|coordinates| {
        let derives = derives(coordinates.len());
        quote! {
            /// The derivatives of all coordinates and of their rates along a parameter, at the time of the frame.
            #derives
            pub struct Sensitivity {
                /// ∂q/∂p: of the coordinates, in m or rad per unit of the parameter.
                pub position: Coordinates,
                /// ∂q̇/∂p: of their rates, in m/s or rad/s per unit of the parameter.
                pub velocity: Coordinates,
            }
        }
    });
    let mut quantities = solved.sensitivities.iter().flat_map(|it| &it.quantities);
    let point = quantities.any(returns_pair).then(|| {
        quote! {
            /// The derivatives of the position and the velocity of a point along a parameter, at the time of the frame.
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct PointSensitivity {
                /// Of x and y, in m per unit of the parameter.
                pub position: [f64; 2],
                /// Of their rates, in m/s per unit of the parameter.
                pub velocity: [f64; 2],
            }
        }
    });
    quote!(#whole #point)
}

/// The functions of all sensitivities; nothing where there are none.
pub(in crate::emit::rust) fn sensitivities(system: &System, solved: &SolvedProgram) -> TokenStream {
    let each = solved.sensitivities.iter().map(|sensitivity| {
        let whole = sensitivity
            .coordinates
            .as_ref()
            .map(|coordinates| of_coordinates(sensitivity, coordinates, system));
        let quantities =
            sensitivity
                .quantities
                .iter()
                .map(|quantity| match quantity.components.len() {
                    2 => of_point(sensitivity, quantity, system),
                    _ => of_coordinate(sensitivity, quantity, system),
                });
        quote!(#whole #(#quantities)*)
    });
    quote!(#(#each)*)
}

/// Whether a quantity is a point with position and velocity.
fn returns_pair(quantity: &SensitiveQuantity) -> bool {
    quantity.components.len() == 2 && quantity.levels.len() == 2
}

/// `L2 (m)` as texts name it, and its unit.
fn parameter(sensitivity: &Sensitivity, system: &System) -> (String, String) {
    let own = &system.mechanism.parameters[sensitivity.parameter];
    (own.name.clone(), own.dimension.unit())
}

fn value(found: &Found, system: &System) -> TokenStream {
    match found {
        Found::Field(symbol) => {
            let name = plain_name(*symbol, system);
            quote!(self.#name)
        }
        Found::Constant(value) => {
            let value = float(*value);
            quote!(#value)
        }
    }
}

fn of_coordinates(
    sensitivity: &Sensitivity,
    coordinates: &[[Found; 2]],
    system: &System,
) -> TokenStream {
    let (parameter, unit) = parameter(sensitivity, system);
    let function = identifier(&format!("sensitivity_{}", sensitivity.name));
    let text = docs([
        format!("How all coordinates and their rates depend on the parameter {parameter}:"),
        format!("∂q/∂{parameter} and ∂q̇/∂{parameter}, where {parameter} is in {unit}."),
    ]);
    let level = |level: usize| {
        let fields = coordinates
            .iter()
            .zip(&system.coordinates)
            .map(|(found, own)| {
                let (name, value) = (identifier(&own.name), value(&found[level], system));
                quote!(#name: #value)
            });
        quote!(Coordinates { #(#fields),* })
    };
    let (position, velocity) = (level(0), level(1));
    quote! {
        #text
        pub fn #function(&self) -> Sensitivity {
            Sensitivity { position: #position, velocity: #velocity }
        }
    }
}

fn of_point(
    sensitivity: &Sensitivity,
    quantity: &SensitiveQuantity,
    system: &System,
) -> TokenStream {
    let (parameter, unit) = parameter(sensitivity, system);
    let (point, own, what) = (&quantity.name, &sensitivity.name, &quantity.what);
    let levels: Vec<TokenStream> = quantity
        .levels
        .iter()
        .map(|level| {
            let values = level.iter().map(|found| value(found, system));
            quote!([#(#values),*])
        })
        .collect();
    match levels.as_slice() {
        [position, velocity] => {
            let function = identifier(&format!("point_{point}_sensitivity_{own}"));
            let text = docs([format!(
                "How position and velocity of {what} depend on the parameter {parameter}, which is in {unit}."
            )]);
            quote! {
                #text
                pub fn #function(&self) -> PointSensitivity {
                    PointSensitivity { position: #position, velocity: #velocity }
                }
            }
        }
        levels => {
            let function = identifier(&format!("point_{point}_position_sensitivity_{own}"));
            let text = docs([format!(
                "How the position of {what} depends on the parameter {parameter}, which is in {unit}: in m per unit of it."
            )]);
            quote!(#text pub fn #function(&self) -> [f64; 2] { #(#levels)* })
        }
    }
}

fn of_coordinate(
    sensitivity: &Sensitivity,
    quantity: &SensitiveQuantity,
    system: &System,
) -> TokenStream {
    let (parameter, unit) = parameter(sensitivity, system);
    let measured = match quantity.components[0] {
        Quantity::Angle => "rad",
        _ => "m",
    };
    let (coordinate, own) = (&quantity.name, &sensitivity.name);
    let levels = [
        ("", "coordinate", ""),
        ("_rate", "rate of the coordinate", "/s"),
    ];
    let methods = quantity.levels.iter().flatten().zip(levels).map(
        |(found, (suffix, what, per_second))| {
            let function = identifier(&format!("{coordinate}{suffix}_sensitivity_{own}"));
            let text = docs([format!(
                "How the {what} {coordinate} depends on the parameter {parameter}, which is in {unit}: in {measured}{per_second} per unit of it."
            )]);
            let value = value(found, system);
            quote!(#text pub fn #function(&self) -> f64 { #value })
        },
    );
    quote!(#(#methods)*)
}
