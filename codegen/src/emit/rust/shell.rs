//! The type that a user holds, and the function that calls all blocks.

use std::collections::HashSet;

use proc_macro2::TokenStream;
use quote::quote;

use super::block::call;
use super::docs::doc_lines;
use super::given;
use super::layout::Verbatim;
use super::literal::count;
use super::module::{Module, derives, only};
use super::path;
use super::scope::identifier;
use crate::expr::SymbolId;
use crate::model::type_name;
use crate::program::{Block, Function, Statement};

/// The function that solves one instant, and the mechanism's own type.
pub(super) fn mechanism(module: &Module<'_>) -> TokenStream {
    let (solve, declared) = (solve(module), module.declared());
    let name = type_name(&module.system.mechanism.name);
    let mut lines = module.system.mechanism.docs.clone();
    if lines.is_empty() {
        lines.push(format!("The mechanism `{}`.", module.system.mechanism.name));
    }
    let mut text = Verbatim::default();
    text.open("::linkwright::mechanism! {");
    text.docs(doc_lines(lines));
    text.tokens(derives(module.system.coordinates.len()));
    text.line(format!("{name}, {:?};", module.system.mechanism.name));
    let list = |what: &str, is_declared: bool| match is_declared {
        true => format!("{}: {what};", what.to_lowercase()),
        false => format!("{}:;", what.to_lowercase()),
    };
    text.line(list("Parameters", declared.parameters));
    text.line(list("Inputs", declared.inputs));
    let path = if module.program.path.is_some() {
        "guarded"
    } else {
        "unguarded"
    };
    text.line(match path::tube_count(module) {
        0 => format!("path: {path};"),
        count => format!("path: {path}, tubes: {count};"),
    });
    if module.program.requirements.is_some() {
        text.line("requirements: REQUIREMENTS;");
    }
    text.close("}");
    let (item, more) = (text.item(), more(module));
    let requirements = given::requirements(module);
    quote!(#solve #requirements #item #more)
}

/// Solves all blocks at one time.
fn solve(module: &Module<'_>) -> TokenStream {
    let calls: Vec<TokenStream> = module
        .program
        .blocks
        .iter()
        .map(|block| call(block, module))
        .collect();
    let called = calls.iter().map(ToString::to_string).collect::<String>();
    let argument = |name: &str| match called.contains(name) {
        true => identifier(name),
        false => identifier(&format!("_{name}")),
    };
    let (last, branches) = (argument("last"), argument("branches"));
    let parameters = only(
        module.is_whole() && module.frame_keeps_parameters(),
        quote!(at.parameters = *given.parameters;),
    );
    let checked = checked(module);
    let verdict = match module.is_large() || checked.is_empty() {
        true => quote!(Ok(())),
        false => quote! {
            if all_finite(&[#(#checked),*]) {
                Ok(())
            } else {
                Err(failed(FailureKind::NotFinite, given.t, 0))
            }
        },
    };
    quote! {
        /// Solves all blocks at one time, one after another.
        fn solve(
            at: &mut Frame,
            #last: &Frame,
            #branches: &mut Branches,
            given: &Given<'_>,
        ) -> Result<(), Failure> {
            at.t = given.t;
            #parameters
            #(#calls)*
            #verdict
        }
    }
}

/// The numbers of a frame that nothing else depends on. What is not finite before them would show in them: nothing that is
/// computed of it is finite.
fn checked(module: &Module<'_>) -> Vec<TokenStream> {
    let graph = &module.system.mechanism.graph;
    let (at, blocks) = (identifier("at"), &module.program.blocks);
    let values = blocks
        .iter()
        .flat_map(Block::functions)
        .flat_map(Function::values);
    let read: HashSet<SymbolId> = values
        .flat_map(|expr| graph.symbols(expr))
        .copied()
        .collect();
    let mut checked = Vec::new();
    for statement in blocks.iter().flat_map(|block| &block.function.statements) {
        let moves = match statement {
            Statement::Let { value, .. } => !graph.is_constant(*value),
            // The runtime has looked at what it found.
            Statement::Newton { .. } => false,
            _ => true,
        };
        let found = statement.targets().into_iter().filter(|_| moves);
        let leaves = found.filter(|&symbol| module.is_field(symbol) && !read.contains(&symbol));
        checked.extend(leaves.map(|symbol| module.field(symbol, &at)));
    }
    checked
}

/// The methods that only some mechanisms have.
fn more(module: &Module<'_>) -> TokenStream {
    let declared = module.declared();
    let name = identifier(&type_name(&module.system.mechanism.name));
    let inputs = only(declared.inputs, quote!(, inputs: &Inputs));
    let inputs_passed = match declared.inputs {
        true => quote!(inputs),
        false => quote!(&()),
    };
    let for_parameters = only(
        declared.parameters,
        quote! {
            /// Assembles the mechanism of these parameters at time `t` (s) as it is drawn.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_for(parameters: &Parameters, t: Scalar #inputs) -> Result<Self, Failure> {
                let (pose, settings) = (drawn_pose(parameters), Settings::default());
                Shell::assemble(Loops, parameters, &pose, Branches::DRAWN, t, #inputs_passed, settings).map(Self)
            }
        },
    );
    let newton_step = module.program.textbook.as_ref().map(|_| {
        let size = count(module.system.rows.len());
        let parameters = only(declared.parameters, quote!(parameters: &Parameters,));
        let own_parameters = only(declared.parameters, quote!(parameters: *parameters,));
        let own_inputs = only(declared.inputs, quote!(inputs: *inputs,));
        let textbook = match declared.parameters || declared.inputs {
            true => quote!(Textbook { #own_parameters #own_inputs }),
            false => quote!(Textbook),
        };
        quote! {
            /// One Newton-Raphson step of the textbook view from the pose `q` at time `t` (s), with its matrix and right-hand
            /// side.
            ///
            /// # Errors
            /// A [`Failure`] where the Jacobian is singular.
            pub fn newton_step(q: &Coordinates, #parameters t: Scalar #inputs) -> Result<Step<#size>, Failure> {
                newton::step(&#textbook, &Vector::from(q.to_array()), t, &Settings::default())
            }
        }
    });
    if for_parameters.is_empty() && newton_step.is_none() {
        return TokenStream::new();
    }
    quote! {
        #[allow(dead_code)]
        impl #name {
            #for_parameters
            #newton_step
        }
    }
}
