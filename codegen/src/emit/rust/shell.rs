//! The type that a user holds, and the function that calls all blocks.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::block::call;
use super::code::Code;
use super::docs::doc_lines;
use super::layout::Verbatim;
use super::loads;
use super::module::{derives, only};
use super::names::identifier;
use super::names::type_name;
use super::parameters;
use crate::emit::module::checks::checked;
use crate::emit::module::drawing::frame_keeps_parameters;
use crate::emit::module::path_enclosures::enclosure_count;
use crate::emit::module::{Module, documentation};

/// The function that solves one instant, and the mechanism's own type.
pub(super) fn mechanism(module: &Module<'_>) -> TokenStream {
    let (solve, declared) = (solve(module), module.declared());
    let name = type_name(&module.system.mechanism.name);
    let lines = documentation::of_mechanism(module.system);
    let mut text = Verbatim::default();
    text.open("::linkwright::generated::mechanism! {");
    text.docs(doc_lines(lines));
    text.tokens(derives(module.system.coordinates.len()));
    text.line(format!("{name}, {:?};", module.system.mechanism.name));
    for line in declared.lines() {
        text.line(line);
    }
    let path = match &module.program.path {
        Some(path) if path.closed.is_some() => "closed",
        Some(_) => "guarded",
        None => "unguarded",
    };
    text.line(match enclosure_count(module) {
        0 => format!("path: {path};"),
        count => format!("path: {path}, enclosures: {count};"),
    });
    if module.program.drawn.is_some() {
        text.line("drawn: drawn;");
    }
    if let Some(requirements) = &module.program.requirements {
        text.line(match requirements.limit_parameters() {
            true => "requirements: REQUIREMENTS;",
            false => "driven: REQUIREMENTS;",
        });
    }
    if module.assemblies.is_some() {
        text.line("assemblies: Branches;");
    }
    if module.program.loads.is_some() {
        text.line("loads: LOADS;");
    }
    text.close("}");
    let (item, requirements) = (text.item(), parameters::requirements(module));
    quote!(#solve #requirements #item)
}

/// Solves all blocks at one time.
fn solve(module: &Module<'_>) -> TokenStream {
    let mut calls = Code::default();
    for block in &module.program.blocks {
        calls.push(&call(block, module));
    }
    let called = calls.to_token_stream().to_string();
    let argument = |name: &str| match called.contains(name) {
        true => identifier(name),
        false => identifier(&format!("_{name}")),
    };
    let (last, branches) = (argument("last"), argument("branches"));
    let parameters = only(
        module.holds_coordinates() && frame_keeps_parameters(module),
        quote!(at.parameters = *conditions.parameters;),
    );
    let checked = checked(module).into_iter();
    let checked: Vec<TokenStream> = checked.map(|symbol| module.field(symbol, "at")).collect();
    let verdict = match module.is_large() || checked.is_empty() {
        true => quote!(Ok(())),
        false => {
            let failure = loads::blamed(quote!(not_finite(conditions.t, 0)), module);
            quote! {
                if all_finite(&[#(#checked),*]) {
                    Ok(())
                } else {
                    Err(#failure)
                }
            }
        }
    };
    quote! {
        /// Solves all blocks at one time, one after another.
        fn solve(
            at: &mut Frame,
            #last: &Frame,
            #branches: &mut Branches,
            conditions: &Conditions<'_>,
        ) -> Result<(), Failure> {
            at.t = conditions.t;
            #parameters
            #calls
            #verdict
        }
    }
}
