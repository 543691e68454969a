//! How the motion depends on parameters, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::module::derives;
use super::names::identifier;
use crate::emit::module::{Module, documentation};
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
            /// Derivatives of all coordinates and of their rates with respect to a parameter, at the time of the frame.
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
            /// Derivatives of the position and velocity of a point with respect to a parameter, at the time of the frame.
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
        let quantities = sensitivity.quantities.iter();
        let quantities = quantities.map(|quantity| of_quantity(sensitivity, quantity, module));
        quote!(#whole #(#quantities)*)
    });
    quote!(#(#each)*)
}

/// Whether a quantity is a point with position and velocity.
fn returns_pair(quantity: &SensitiveQuantity) -> bool {
    quantity.components.len() == 2 && quantity.levels.len() == 2
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
    let function = identifier(&format!("sensitivity_{}", sensitivity.name));
    let text = docs(documentation::of_sensitivity(sensitivity, module));
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

fn of_quantity(
    sensitivity: &Sensitivity,
    quantity: &SensitiveQuantity,
    module: &Module<'_>,
) -> TokenStream {
    let values = |level: &Vec<Found>| {
        let values = level.iter().map(|found| value(found, module));
        quote!(#(#values),*)
    };
    let mut levels = quantity.levels.iter().map(values);
    let functions = documentation::of_quantity(sensitivity, quantity, module).into_iter();
    let functions = functions.map(|(name, text)| (identifier(&name), docs([text])));
    let is_point = quantity.components.len() == 2;
    let methods = functions.map(|(function, text)| {
        let found = levels.next().unwrap_or_default();
        match is_point {
            true if returns_pair(quantity) => {
                let velocity = levels.next().unwrap_or_default();
                quote! {
                    #text
                    pub fn #function(&self) -> PointSensitivity {
                        PointSensitivity { position: [#found], velocity: [#velocity] }
                    }
                }
            }
            true => quote!(#text pub fn #function(&self) -> [Scalar; 2] { [#found] }),
            false => quote!(#text pub fn #function(&self) -> Scalar { #found }),
        }
    });
    methods.collect()
}
