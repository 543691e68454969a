//! Parameters and inputs: their structures, and how they are passed on.
//!
//! A mechanism without them has neither structures nor arguments for them.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::docs::docs;
use super::expression::{identifier, written};
use super::lints;
use super::literal::{count, float};
use crate::expr::{ExprId, SymbolId};
use crate::model::{Dimension, field_name};
use crate::program::{Inputs, Program};
use crate::system::{SymbolRole, System};

/// What the functions of a mechanism are given beside pose and time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Given {
    pub parameters: bool,
    pub inputs: bool,
    /// Whether parameters change what lengths are judged against.
    pub lengths: bool,
}

impl Given {
    /// What a mechanism declares.
    pub(super) fn of(system: &System) -> Given {
        Given {
            parameters: !system.mechanism.parameters.is_empty(),
            inputs: !system.mechanism.inputs.is_empty(),
            lengths: !system.lengths.is_empty(),
        }
    }

    /// Whether there is anything.
    pub(super) fn any(self) -> bool {
        self.parameters || self.inputs
    }

    /// `parameters: &Parameters, inputs: &Inputs,` for a function that reads what `read` says; what it does not read begins
    /// with an underscore.
    pub(super) fn declared(self, read: Inputs) -> TokenStream {
        let name = |name: &str, is_read: bool| {
            if is_read {
                format_ident!("{name}")
            } else {
                format_ident!("_{name}")
            }
        };
        let parameters = name("parameters", read.parameters);
        let inputs = name("inputs", read.inputs);
        let parameters = only(self.parameters, quote!(#parameters: &Parameters,));
        let inputs = only(self.inputs, quote!(#inputs: &Inputs,));
        quote!(#parameters #inputs)
    }

    /// The parameters alone, as they are declared.
    pub(super) fn parameters_declared(self) -> TokenStream {
        only(self.parameters, quote!(parameters: &Parameters,))
    }

    /// What follows `t: f64` where inputs are declared.
    pub(super) fn inputs_declared(self) -> TokenStream {
        only(self.inputs, quote!(, inputs: &Inputs))
    }

    /// The parameters alone, passed on.
    pub(super) fn parameters_passed(self) -> TokenStream {
        only(self.parameters, quote!(parameters,))
    }

    /// What follows `t` where inputs are passed on.
    pub(super) fn inputs_passed(self) -> TokenStream {
        only(self.inputs, quote!(, inputs))
    }

    /// The fields of a structure that holds all of it.
    pub(super) fn fields(self) -> TokenStream {
        let parameters = only(
            self.parameters,
            quote! {
                /// The parameters.
                pub parameters: Parameters,
            },
        );
        let inputs = only(
            self.inputs,
            quote! {
                /// The signals at the time for which the equations are evaluated.
                pub inputs: Inputs,
            },
        );
        let length = only(
            self.lengths,
            quote! {
                /// What lengths are judged against (m), as it follows from the parameters.
                pub length: f64,
            },
        );
        quote!(#parameters #inputs #length)
    }

    /// What follows the name of such a structure in its literal, from references and the characteristic length.
    pub(super) fn copied(self, length: TokenStream) -> TokenStream {
        let parameters = only(self.parameters, quote!(parameters: *parameters,));
        let inputs = only(self.inputs, quote!(inputs: *inputs,));
        let length = only(self.lengths, quote!(length: #length,));
        if self.any() {
            quote!({ #parameters #inputs #length })
        } else {
            TokenStream::new()
        }
    }

    /// References to its fields, passed on.
    pub(super) fn of_self(self) -> TokenStream {
        let parameters = only(self.parameters, quote!(&self.parameters,));
        let inputs = only(self.inputs, quote!(&self.inputs,));
        quote!(#parameters #inputs)
    }
}

/// Fails where a parameter or a signal is no number.
pub(super) fn finite_check(system: &System) -> TokenStream {
    let given = Given::of(system);
    let condition = match (given.parameters, given.inputs) {
        (false, false) => return TokenStream::new(),
        (true, false) => quote!(!parameters.is_finite()),
        (false, true) => quote!(!inputs.is_finite()),
        (true, true) => quote!(!(parameters.is_finite() && inputs.is_finite())),
    };
    quote! {
        if #condition {
            return Err(failed(FailureKind::NotFinite, t, 0));
        }
    }
}

/// The drawn pose of the parameters in scope.
pub(super) fn drawn_pose(program: &Program) -> TokenStream {
    if program.drawn.is_some() {
        quote!(&Coordinates::drawn(parameters))
    } else {
        quote!(&Coordinates::DRAWN)
    }
}

/// Whether a frame keeps the parameters that its points are found with.
pub(super) fn kept_in_frame(program: &Program) -> bool {
    program
        .points
        .iter()
        .chain(&program.pressures)
        .any(|straight| straight.inputs.parameters)
}

/// `parameters` and `set_parameters` of the type that a user holds; `noted` is what else a change does.
pub(super) fn access(system: &System, noted: &TokenStream) -> TokenStream {
    only(
        Given::of(system).parameters,
        quote! {
            /// The parameters that the next instant is solved with.
            pub fn parameters(&self) -> &Parameters {
                &self.parameters
            }

            /// Changes the parameters. The last frame stays as it was solved; the next one is solved with these.
            pub fn set_parameters(&mut self, parameters: &Parameters) {
                self.parameters = *parameters;
                #noted
            }
        },
    )
}

/// The tokens where there is something to say.
pub(super) fn only(there: bool, tokens: TokenStream) -> TokenStream {
    if there { tokens } else { TokenStream::new() }
}

/// The function that gives what lengths are judged against, where it follows the parameters.
pub(super) fn length_of_parameters(system: &System, program: &Program) -> TokenStream {
    let Some(straight) = &program.lengths else {
        return TokenStream::new();
    };
    let (statements, results) = written(system, program, straight);
    let function = quote! {
        fn characteristic_length(parameters: &Parameters) -> f64 {
            #(#statements)*
            largest_length(&[#(#results),*], CHARACTERISTIC_LENGTH)
        }
    };
    let allow = lints::unused_item(&function);
    quote! {
        /// What lengths are judged against, in m: the largest of the mechanism with these parameters.
        #allow
        #function
    }
}

/// How a parameter or an input is read; nothing for other symbols.
pub(super) fn read(symbol: SymbolId, system: &System) -> Option<TokenStream> {
    match system.roles[symbol.index()] {
        SymbolRole::Parameter(parameter) => {
            let field = identifier(&field_name(&system.mechanism.parameters[parameter].name));
            Some(quote!(parameters.#field))
        }
        SymbolRole::Input { input, level } => {
            let field = identifier(&field_name(&system.mechanism.inputs[input].name));
            let level = format_ident!("{}", ["value", "rate", "acceleration"][level]);
            Some(quote!(inputs.#field.#level))
        }
        _ => None,
    }
}

/// `struct Parameters` and `struct Inputs` with their defaults.
pub(super) fn structures(system: &System, program: &Program) -> TokenStream {
    let given = Given::of(system);
    let parameters = only(given.parameters, parameters(system));
    let inputs = only(given.inputs, inputs(system, program.solved.is_some()));
    let drawn = drawn(system, program);
    quote!(#parameters #inputs #drawn)
}

fn parameters(system: &System) -> TokenStream {
    let own = &system.mechanism.parameters;
    let names: Vec<_> = own
        .iter()
        .map(|parameter| identifier(&field_name(&parameter.name)))
        .collect();
    let texts = own.iter().map(|parameter| {
        docs(described(
            &parameter.name,
            parameter.dimension,
            &parameter.docs,
            &format!("{:?} unless it is set", value_of(parameter.nominal, system)),
        ))
    });
    let values = own
        .iter()
        .map(|parameter| float(value_of(parameter.nominal, system)));
    let approximate = lints::approximate(&values.clone().collect());
    quote! {
        /// What can be changed at run time.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Parameters {
            #(#texts pub #names: f64,)*
        }

        #[allow(dead_code)]
        #approximate
        impl Parameters {
            /// The values of the description.
            pub const NOMINAL: Self = Self { #(#names: #values),* };

            /// Whether every parameter is a number.
            fn is_finite(&self) -> bool {
                all_finite(&[#(self.#names),*])
            }
        }

        impl Default for Parameters {
            fn default() -> Self {
                Self::NOMINAL
            }
        }
    }
}

fn inputs(system: &System, has_steps: bool) -> TokenStream {
    let own = &system.mechanism.inputs;
    let names: Vec<_> = own
        .iter()
        .map(|input| identifier(&field_name(&input.name)))
        .collect();
    let texts = own.iter().map(|input| {
        docs(described(
            &input.name,
            input.dimension,
            &input.docs,
            &format!(
                "{:?} and at rest unless it is supplied",
                value_of(input.initial, system)
            ),
        ))
    });
    let values = own
        .iter()
        .map(|input| float(value_of(input.initial, system)));
    let approximate = lints::approximate(&values.clone().collect());
    let towards = only(
        has_steps,
        quote! {
            /// The signals at a fraction of the time `h` (s) from these to `last`, on the smoothest way.
            fn towards(&self, last: &Self, h: f64, part: f64) -> Self {
                Self { #(#names: self.#names.towards(&last.#names, h, part)),* }
            }
        },
    );
    quote! {
        /// The signals that move the mechanism, each with its value, rate and acceleration at one time.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Inputs {
            #(#texts pub #names: Signal,)*
        }

        #[allow(dead_code)]
        #approximate
        impl Inputs {
            /// The values of the description, at rest.
            pub const INITIAL: Self = Self { #(#names: Signal { value: #values, rate: 0.0, acceleration: 0.0 }),* };

            /// Whether every signal is made of numbers.
            fn is_finite(&self) -> bool {
                [#(self.#names),*]
                    .iter()
                    .all(|signal| all_finite(&[signal.value, signal.rate, signal.acceleration]))
            }

            #towards
        }

        impl Default for Inputs {
            fn default() -> Self {
                Self::INITIAL
            }
        }
    }
}

/// `L2, in m: 0.35 unless it is set.` and what the description says.
fn described(name: &str, dimension: Dimension, own: &[String], default: &str) -> Vec<String> {
    let mut lines = vec![format!("`{name}`, in {}: {default}.", dimension.unit())];
    if !own.is_empty() {
        lines.push(String::new());
        lines.extend(own.iter().cloned());
    }
    lines
}

/// Defaults were found to be finite constants when they were read.
fn value_of(expr: ExprId, system: &System) -> f64 {
    system.mechanism.graph.constant_value(expr).unwrap_or(0.0)
}

/// The drawing of given parameters: a value per unknown, and the coordinates among them.
fn drawn(system: &System, program: &Program) -> TokenStream {
    let Some(straight) = &program.drawn else {
        return TokenStream::new();
    };
    let (statements, results) = written(system, program, straight);
    let (unknowns, coordinates) = (count(results.len()), count(system.coordinates.len()));
    let pose = if results.len() == system.coordinates.len() {
        quote!(Self::from_array(drawn(parameters)))
    } else {
        let taken: Vec<_> = (0..system.coordinates.len())
            .map(|place| {
                let place = count(place);
                quote!(drawn[#place])
            })
            .collect();
        quote! {
            let drawn = drawn(parameters);
            let pose: [f64; #coordinates] = [#(#taken),*];
            Self::from_array(pose)
        }
    };
    let function = quote! {
        fn drawn(parameters: &Parameters) -> [f64; #unknowns] {
            #(#statements)*
            [#(#results),*]
        }
    };
    let allow = lints::unused_item(&function);
    quote! {
        /// The drawing's value of every coordinate and displacement.
        #allow
        #function

        #[allow(dead_code)]
        impl Coordinates {
            /// The pose in the drawing of these parameters, from which the mechanism is assembled.
            pub fn drawn(parameters: &Parameters) -> Self {
                #pose
            }
        }
    }
}
