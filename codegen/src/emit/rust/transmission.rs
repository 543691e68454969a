//! What the drivers transmit, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::literal::count;
use super::module::Module;
use super::names::identifier;
use crate::joint::Quantity;
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
        /// The drivers in written order, one for each column of a transmission.
        pub const DRIVERS: [&'static str; #number] = [#(#labels),*];

        #(#functions)*
    }
}

fn functions(transmission: &Transmission, module: &Module<'_>) -> TokenStream {
    let system = module.system;
    let Transmission {
        name,
        what,
        rows,
        columns,
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
    let unit = |quantity: Quantity| match quantity {
        Quantity::Length => "m".to_string(),
        Quantity::Angle => "rad".to_string(),
        Quantity::Power(0) => "1".to_string(),
        Quantity::Power(exponent) => format!("m^{exponent}"),
    };
    let drivers = system.driven().map(|(_, joint, quantity)| {
        let unit = format!("{}/{}", unit(rows[0]), unit(quantity));
        format!("`{}` ({unit})", system.mechanism.joints[joint].label)
    });
    let listed: Vec<String> = drivers
        .enumerate()
        .map(|(column, driver)| format!("{column} {driver}"))
        .collect();
    let shape = if is_point { "Rows: x, y. " } else { "" };
    let about_rate = docs([
        format!(
            "The rate of {what} per unit rate of each driver, so that the rate is this matrix times the rates of the drivers."
        ),
        String::new(),
        format!("{shape}Columns: {}.", listed.join(", ")),
    ]);
    let (load, given) = match (is_point, rows[0]) {
        (true, _) => (format!("a force (N) at {what}"), quote!([Scalar; 2])),
        (false, Quantity::Angle) => (format!("a torque (N·m) on {what}"), quote!(Scalar)),
        (false, _) => (format!("a force (N) along {what}"), quote!(Scalar)),
    };
    let about_force = docs([format!(
        "What {load} does to each driver: the forces (N; for angles torques, N·m) along the drivers with the same power, which is the transposed transmission times the load. A driver that holds the load pushes back with as much."
    )]);
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
