//! Parameters and inputs: their structures, and what follows from them.
//!
//! A mechanism without them has neither structures nor arguments for them.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::doc_lines;
use super::layout::Verbatim;
use super::lints;
use super::literal::count;
use super::module::only;
use super::names::identifier;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::expr::ExprId;
use crate::model::{Dimension, field_name};

/// What the functions of a mechanism are given beside pose and time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Declared {
    pub parameters: bool,
    pub inputs: bool,
}

impl Module<'_> {
    /// What the mechanism declares.
    pub(super) fn declared(&self) -> Declared {
        Declared {
            parameters: !self.system.mechanism.parameters.is_empty(),
            inputs: !self.system.mechanism.inputs.is_empty(),
        }
    }
}

impl Declared {
    /// What macros of the runtime are told of it.
    pub(super) fn lines(self) -> [String; 2] {
        let line = |what: &str, is_declared: bool| match is_declared {
            true => format!("{}: {what};", what.to_lowercase()),
            false => format!("{}:;", what.to_lowercase()),
        };
        [
            line("Parameters", self.parameters),
            line("Inputs", self.inputs),
        ]
    }

    /// `parameters: &Parameters, inputs: &Inputs,`; what is not read begins with an underscore.
    pub(super) fn arguments(self, reads_parameters: bool, reads_inputs: bool) -> TokenStream {
        let parameters = match reads_parameters {
            true => quote!(parameters),
            false => quote!(_parameters),
        };
        let inputs = match reads_inputs {
            true => quote!(inputs),
            false => quote!(_inputs),
        };
        let parameters = only(self.parameters, quote!(#parameters: &Parameters,));
        let inputs = only(self.inputs, quote!(#inputs: &Inputs,));
        quote!(#parameters #inputs)
    }
}

fn parameters(module: &Module<'_>) -> TokenStream {
    let own = module.system.mechanism.parameters.iter();
    let own = own.map(|it| (it.name.as_str(), it.dimension, &it.docs, it.nominal));
    structure(module, "parameters", "unless it is set", own)
}

/// `struct Parameters` and `struct Inputs` with their defaults, and the drawn pose.
pub(super) fn structures(module: &Module<'_>) -> TokenStream {
    let mechanism = &module.system.mechanism;
    let parameters = parameters(module);
    let own = mechanism.inputs.iter();
    let own = own.map(|it| (it.name.as_str(), it.dimension, &it.docs, it.initial));
    let inputs = structure(module, "inputs", "and at rest unless it is supplied", own);
    let drawn = drawn(module);
    quote! {
        #parameters
        #inputs
        #drawn
    }
}

/// A structure with a number for each declared name; nothing where there is none.
fn structure<'a>(
    module: &Module<'_>,
    kind: &str,
    default: &str,
    own: impl ExactSizeIterator<Item = (&'a str, Dimension, &'a Vec<String>, ExprId)>,
) -> TokenStream {
    if own.len() == 0 {
        return TokenStream::new();
    }
    let mut text = Verbatim::default();
    text.open(&format!("::linkwright::generated::{kind}! {{"));
    text.open("Scalar {");
    for (name, dimension, docs, value) in own {
        // Defaults were found to be finite constants when they were read.
        let value = module.pool.graph.constant_value(value).unwrap_or(0.0);
        let lines = documentation::of_number(name, dimension, value, default, docs);
        text.docs(doc_lines(lines));
        let (field, value) = (identifier(&field_name(name)), module.number(value));
        text.line(format!("{field} = {value},"));
    }
    text.close("}");
    text.close("}");
    text.item()
}

/// What parameters must leave positive, and what it is called.
pub(super) fn requirements(module: &Module<'_>) -> TokenStream {
    let Some(requirements) = &module.program.requirements else {
        return TokenStream::new();
    };
    let scope = Scope::new(module, &requirements.function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    let names = requirements.names.iter();
    let names = names.map(|(owner, what)| quote!(BlockName::new(#owner, #what)));
    let [all, length] = [requirements.names.len(), results.len()].map(count);
    let function = only(
        requirements.limit_parameters(),
        quote! {
            fn requirements(parameters: &Parameters) -> [Scalar; #length] {
                #statements
                [#(#results),*]
            }
        },
    );
    let docs = documentation::of_requirements(requirements);
    let docs = format!(" {docs}");
    quote! {
        #[doc = #docs]
        const REQUIREMENTS: [BlockName<'static>; #all] = [#(#names),*];

        #function
    }
}

/// The drawing of given parameters: a value per unknown, coordinates first.
fn drawn(module: &Module<'_>) -> TokenStream {
    let Some(function) = &module.program.drawn else {
        return TokenStream::new();
    };
    let scope = Scope::new(module, function, Place::Coordinates);
    let (statements, results) = (scope.plain_statements(), scope.results());
    let unknowns = count(results.len());
    let function = quote! {
        fn drawn(parameters: &Parameters) -> [Scalar; #unknowns] {
            #statements
            [#(#results),*]
        }
    };
    let allow = lints::unused_item(&function);
    quote! {
        /// The drawing's value of every coordinate and displacement.
        #allow
        #function
    }
}
