//! What the drivers transmit, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::literal::count;
use super::names::identifier;
use crate::emit::module::{Module, documentation};
use crate::program::Transmission;

/// The functions of all transmissions, and the list of the drivers; nothing where there are none.
pub(super) fn transmissions(module: &Module<'_>) -> TokenStream {
    let (system, program) = (module.system, module.program);
    if program.transmissions.is_empty() {
        return TokenStream::new();
    }
    let joints = &system.mechanism.joints;
    let labels = system
        .driven()
        .map(|(_, joint, _)| joints[joint].label.as_str());
    let number = count(system.driven().count());
    let functions = program
        .transmissions
        .iter()
        .map(|transmission| functions(transmission, module));
    quote! {
        /// Drivers in written order, one for each column of a transmission.
        pub const DRIVERS: [&'static str; #number] = [#(#labels),*];

        #(#functions)*
    }
}

fn functions(transmission: &Transmission, module: &Module<'_>) -> TokenStream {
    let system = module.system;
    let Transmission {
        name,
        rows,
        columns,
        ..
    } = transmission;
    let (rate, force) = (
        identifier(&format!("transmission_{name}")),
        identifier(&format!("forces_{name}")),
    );
    let (number, height) = (count(columns.len()), count(rows.len()));
    let fields: Vec<Vec<TokenStream>> = columns
        .iter()
        .map(|column| {
            let own = |&symbol| {
                let name = module.field_name(symbol);
                quote!(self.#name)
            };
            column.iter().map(own).collect()
        })
        .collect();
    let matrix = fields.iter().map(|column| quote!([#(#column),*]));
    let is_point = rows.len() == 2;
    let [about_rate, about_force] = documentation::of_transmission(transmission, system).map(docs);
    let given = match is_point {
        true => quote!([Scalar; 2]),
        false => quote!(Scalar),
    };
    let (parameter, pull) = if is_point {
        (quote!(force), vec![quote!(force[0]), quote!(force[1])])
    } else {
        (quote!(load), vec![quote!(load)])
    };
    let forces = fields.iter().map(|column| {
        let products = column
            .iter()
            .zip(&pull)
            .map(|(rate, pull)| quote!(#rate * #pull));
        quote!(#(#products)+*)
    });
    quote! {
        #about_rate
        pub fn #rate(&self) -> Matrix<#height, #number> {
            Matrix::from([#(#matrix),*])
        }

        #about_force
        pub fn #force(&self, #parameter: #given) -> Vector<#number> {
            Vector::from([#(#forces),*])
        }
    }
}
