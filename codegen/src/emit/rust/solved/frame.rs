//! The values that blocks share, and the assembly modes.

use proc_macro2::TokenStream;
use quote::quote;

use super::closeness::closeness;
use super::names::plain_name;
use super::newton::listed;
use super::sensitivity::{sensitivities, structures};
use super::transmission::{responded, transmissions};
use crate::emit::rust::coordinates::derives;
use crate::emit::rust::docs::docs;
use crate::emit::rust::expression::identifier;
use crate::emit::rust::lints;
use crate::emit::rust::literal::{count, float};
use crate::expr::SymbolId;
use crate::program::Program;
use crate::program::solved::{Output, SolvedProgram};
use crate::system::{SymbolRole, System};

/// The private fields of the frame, with a comma after each.
pub(in crate::emit::rust) fn frame_fields(system: &System, solved: &SolvedProgram) -> TokenStream {
    let fields = solved.fields.iter().map(|&symbol| {
        let name = plain_name(symbol, system);
        quote!(#name: f64,)
    });
    quote!(#(#fields)*)
}

/// The values of these fields in the drawing, where Newton-Raphson starts from them.
pub(in crate::emit::rust) fn frame_values(system: &System, solved: &SolvedProgram) -> TokenStream {
    let graph = &system.mechanism.graph;
    let values = solved.fields.iter().map(|&symbol| {
        let name = plain_name(symbol, system);
        let drawn = match system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => graph
                .constant_value(system.vector_form.unknowns[unknown].estimate)
                .unwrap_or(0.0),
            _ => 0.0,
        };
        let drawn = float(drawn);
        quote!(#name: #drawn,)
    });
    quote!(#(#values)*)
}

/// `struct Branches` with the drawing's choice.
pub(in crate::emit::rust) fn branches(system: &System, solved: &SolvedProgram) -> TokenStream {
    let closed = solved.branches.iter().map(|branch| {
        let drawn = if branch.positive {
            quote!(Branch::Positive)
        } else {
            quote!(Branch::Negative)
        };
        let text = docs([sentence(&branch.meaning)]);
        (text, identifier(&branch.name), quote!(Branch), drawn)
    });
    let iterated = solved.blocks.iter().filter_map(|block| {
        let newton = block.newton.as_ref()?;
        let text = docs([format!(
            "The sign of the determinant of `{}`, which finds {}. `None` lets the estimate decide.",
            block.name,
            listed(newton, system)
        )]);
        let name = identifier(&block.name);
        Some((text, name, quote!(Option<Branch>), quote!(None)))
    });
    let has_newton = solved.blocks.iter().any(|block| block.newton.is_some());
    let (mut fields, mut names, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for (text, name, kind, drawn) in closed.chain(iterated) {
        fields.push(quote!(#text pub #name: #kind,));
        names.push(name);
        values.push(drawn);
    }
    let structure = quote! {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct Branches {
            #(#fields)*
        }
    };
    let capitals = lints::capitals(&structure);
    let text = docs(if has_newton {
        ["The assembly mode of every loop."]
    } else {
        ["The assembly mode of every loop that is solved in closed form."]
    });
    quote! {
        #text
        #capitals
        #structure

        #[allow(dead_code)]
        impl Branches {
            /// The modes of the drawing.
            pub const DRAWN: Self = Self { #(#names: #values),* };
        }
    }
}

fn sentence(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters.next().map(char::to_uppercase);
    first.map_or(String::new(), |first| {
        first.chain(characters).chain(['.']).collect()
    })
}

/// `struct Frame` that holds what is asked for and what the solution carries along.
pub(in crate::emit::rust) fn output_frame(
    system: &System,
    solved: &SolvedProgram,
    outputs: &[Output],
) -> TokenStream {
    let methods = outputs.iter().map(|output| method(output, system));
    let (fields, drawn) = (frame_fields(system, solved), frame_values(system, solved));
    let checked = outputs.iter().flat_map(Output::fields).map(|symbol| {
        let name = plain_name(symbol, system);
        quote!(self.#name)
    });
    let checked = checked.chain(responded(system, solved));
    let transmissions = transmissions(system, solved);
    let closeness = closeness(system, solved);
    let (sensitivities, structures) = (sensitivities(system, solved), structures(solved));
    let implementation = quote! {
        impl Frame {
            #(#methods)*

            #transmissions
            #sensitivities
            #closeness

            /// The drawing at rest, which the solution starts from.
            const DRAWN: Self = Self { t: 0.0, #drawn };

            /// Whether everything that is asked for is a number.
            fn is_finite(&self) -> bool {
                all_finite(&[#(#checked),*])
            }
        }
    };
    let allow = lints::unused_item(&implementation);
    let derives = derives(solved.fields.len());
    let structure = quote! {
        #derives
        pub struct Frame {
            /// The time t, in s.
            pub t: f64,
            #fields
        }
    };
    let capitals = lints::capitals(&structure);
    quote! {
        /// One solved instant: what the description asks for.
        #capitals
        #structure

        #allow
        #implementation

        #structures
    }
}

fn method(output: &Output, system: &System) -> TokenStream {
    let own = |symbol: SymbolId| {
        let name = plain_name(symbol, system);
        quote!(self.#name)
    };
    let pair = |fields: &[SymbolId; 2]| {
        let [x, y] = fields.map(own);
        quote!([#x, #y])
    };
    match output {
        Output::Point { name, fields } => match fields.as_slice() {
            [position, velocity, acceleration] => {
                let (function, text) = (
                    identifier(&format!("point_{name}")),
                    docs([format!("Motion of the point {name}, in m, m/s and m/s².")]),
                );
                let [position, velocity, acceleration] =
                    [position, velocity, acceleration].map(pair);
                quote! {
                    #text
                    pub fn #function(&self) -> Motion {
                        Motion { position: #position, velocity: #velocity, acceleration: #acceleration }
                    }
                }
            }
            fields => {
                let methods = fields
                    .iter()
                    .zip([("position", "m"), ("velocity", "m/s")])
                    .map(|(field, (level, unit))| {
                        let function = identifier(&format!("point_{name}_{level}"));
                        let (text, value) = (
                            docs([format!("The {level} of the point {name}, in {unit}.")]),
                            pair(field),
                        );
                        quote!(#text pub fn #function(&self) -> [f64; 2] { #value })
                    });
                quote!(#(#methods)*)
            }
        },
        Output::Coordinate { name, fields } => {
            let levels = [
                ("", "coordinate"),
                ("_rate", "rate of the coordinate"),
                ("_acceleration", "acceleration of the coordinate"),
            ];
            let methods = fields.iter().zip(levels).map(|(&field, (suffix, what))| {
                let function = identifier(&format!("{name}{suffix}"));
                let (text, value) = (
                    docs([format!("The {what} {name}, in SI units.")]),
                    own(field),
                );
                quote!(#text pub fn #function(&self) -> f64 { #value })
            });
            quote!(#(#methods)*)
        }
    }
}

/// The frame before the first one: the drawing, with what `estimate` says of the coordinates.
pub(in crate::emit::rust) fn estimated_frame(
    system: &System,
    program: &Program,
    solved: &SolvedProgram,
) -> TokenStream {
    let given = given_estimates(system, program, solved);
    let rest = quote!(..Frame::DRAWN);
    if solved.outputs.is_none() {
        return quote!(Frame { t, q: *estimate, #given #rest });
    }
    let coordinates =
        solved
            .fields
            .iter()
            .filter_map(|symbol| match system.roles[symbol.index()] {
                SymbolRole::Position(unknown) if unknown < system.coordinates.len() => {
                    let name = plain_name(*symbol, system);
                    Some(quote!(#name: estimate.#name,))
                }
                _ => None,
            });
    quote!(Frame { t, #(#coordinates)* #given #rest })
}

/// The drawn displacements that the frame keeps, where parameters change them.
fn given_estimates(system: &System, program: &Program, solved: &SolvedProgram) -> TokenStream {
    let Some(drawn) = &program.drawn else {
        return TokenStream::new();
    };
    let graph = &system.mechanism.graph;
    let fields = solved.fields.iter().filter_map(|symbol| {
        let SymbolRole::Position(unknown) = system.roles[symbol.index()] else {
            return None;
        };
        let (estimate, _) = drawn.results.get(unknown)?;
        let is_given = unknown >= system.coordinates.len() && !graph.is_constant(*estimate);
        let (name, place) = (plain_name(*symbol, system), count(unknown));
        is_given.then(|| quote!(#name: drawn(parameters)[#place],))
    });
    quote!(#(#fields)*)
}
