//! How the motion depends on parameters, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::module::{Module, derives};
use super::names::identifier;
use crate::joint::Quantity;
use crate::program::{Found, SensitiveQuantity, Sensitivity};

/// `struct Sensitivity` and `struct PointSensitivity`, as far as something returns them.
pub(super) fn structures(module: &Module<'_>) -> TokenStream {
    let coordinates = module
        .program
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
    let mut quantities = module
        .program
        .sensitivities
        .iter()
        .flat_map(|it| &it.quantities);
    let point = quantities.any(returns_pair).then(|| {
        quote! {
            /// The derivatives of the position and the velocity of a point along a parameter, at the time of the frame.
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct PointSensitivity {
                /// Of x and y, in m per unit of the parameter.
                pub position: [Scalar; 2],
                /// Of their rates, in m/s per unit of the parameter.
                pub velocity: [Scalar; 2],
            }
        }
    });
    quote!(#whole #point)
}

/// The functions of all sensitivities; nothing where there are none.
pub(super) fn sensitivities(module: &Module<'_>) -> TokenStream {
    let each = module.program.sensitivities.iter().map(|sensitivity| {
        let whole = sensitivity
            .coordinates
            .as_ref()
            .map(|coordinates| of_coordinates(sensitivity, coordinates, module));
        let quantities =
            sensitivity
                .quantities
                .iter()
                .map(|quantity| match quantity.components.len() {
                    2 => of_point(sensitivity, quantity, module),
                    _ => of_coordinate(sensitivity, quantity, module),
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
fn parameter(sensitivity: &Sensitivity, module: &Module<'_>) -> (String, String) {
    let own = &module.system.mechanism.parameters[sensitivity.parameter];
    (own.name.clone(), own.dimension.unit())
}

fn value(found: &Found, module: &Module<'_>) -> TokenStream {
    match found {
        Found::Field(symbol) => {
            let name = module.field_name(*symbol);
            quote!(self.#name)
        }
        Found::Constant(value) => {
            let value = module.float(*value);
            quote!(#value)
        }
    }
}

fn of_coordinates(
    sensitivity: &Sensitivity,
    coordinates: &[[Found; 2]],
    module: &Module<'_>,
) -> TokenStream {
    let (parameter, unit) = parameter(sensitivity, module);
    let function = identifier(&format!("sensitivity_{}", sensitivity.name));
    let text = docs([
        format!("How all coordinates and their rates depend on the parameter {parameter}:"),
        format!("∂q/∂{parameter} and ∂q̇/∂{parameter}, where {parameter} is in {unit}."),
    ]);
    let level = |level: usize| {
        let fields = coordinates
            .iter()
            .zip(&module.system.coordinates)
            .map(|(found, own)| {
                let (name, value) = (identifier(&own.name), value(&found[level], module));
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
    module: &Module<'_>,
) -> TokenStream {
    let (parameter, unit) = parameter(sensitivity, module);
    let (point, own, what) = (&quantity.name, &sensitivity.name, &quantity.what);
    let levels: Vec<TokenStream> = quantity
        .levels
        .iter()
        .map(|level| {
            let values = level.iter().map(|found| value(found, module));
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
            quote!(#text pub fn #function(&self) -> [Scalar; 2] { #(#levels)* })
        }
    }
}

fn of_coordinate(
    sensitivity: &Sensitivity,
    quantity: &SensitiveQuantity,
    module: &Module<'_>,
) -> TokenStream {
    let (parameter, unit) = parameter(sensitivity, module);
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
            let value = value(found, module);
            quote!(#text pub fn #function(&self) -> Scalar { #value })
        },
    );
    quote!(#(#methods)*)
}
