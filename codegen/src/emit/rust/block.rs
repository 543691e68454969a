//! One function per block.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::{doc_lines, docs};
use super::layout::Verbatim;
use super::lints;
use super::literal::count;
use super::module::only;
use super::names::identifier;
use super::newton;
use crate::emit::module::needs::{Needs, checked_at_once, exchanged_by};
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::{Block, Statement};

/// Up to so many blocks become one function.
const MOST_INLINED: usize = 16;

impl Needs {
    /// The arguments as they are declared, and as they are passed.
    fn arguments(self) -> (TokenStream, TokenStream) {
        let exclusive = only(self.finds_branch, quote!(mut));
        let arguments = [
            (true, quote!(at: &mut Frame), quote!(at)),
            (self.last, quote!(last: &Frame), quote!(last)),
            (
                self.branches,
                quote!(branches: &#exclusive Branches),
                quote!(branches),
            ),
            (
                self.conditions,
                quote!(conditions: &Conditions<'_>),
                quote!(conditions),
            ),
        ];
        let needed = arguments.into_iter().filter(|(is_needed, ..)| *is_needed);
        let (declared, passed): (Vec<_>, Vec<_>) = needed
            .map(|(_, declared, passed)| (declared, passed))
            .unzip();
        (quote!(#(#declared),*), quote!(#(#passed),*))
    }
}

/// The call of a block's function.
pub(super) fn call(block: &Block, module: &Module<'_>) -> TokenStream {
    let needs = Needs::of(block, module);
    let (name, (_, arguments)) = (identifier(&block.name), needs.arguments());
    match needs.fails {
        true => quote!(#name(#arguments)?;),
        false => quote!(#name(#arguments);),
    }
}

/// The functions of all blocks.
pub(super) fn functions(module: &Module<'_>) -> TokenStream {
    // One function of thousands of blocks would take the compiler longer than all of them alone.
    let inline = match module.program.blocks.len() > MOST_INLINED {
        true => quote!(#[inline(never)]),
        false => quote!(#[inline]),
    };
    // Most mechanisms have no capital letter in any name, and then no token needs to be looked at.
    let mut bodies = module.system.mechanism.bodies.iter();
    let has_capitals = bodies.any(|body| body.name.contains(char::is_uppercase));
    let blocks = module.program.blocks.iter().enumerate();
    let functions = blocks.map(|(index, block)| {
        let needs = Needs::of(block, module);
        let scope = Scope::new(module, &block.function, Place::Frame);
        let iterated = |statement: &Statement| newton::statement(statement, index, block, &scope);
        let statements = scope.statements(index, &iterated);
        let (name, (arguments, _)) = (identifier(&block.name), needs.arguments());
        let title = docs(documentation::of_block(block, module));
        let check = match module.is_large() {
            true => own_check(index, block, &scope),
            false => TokenStream::new(),
        };
        let reads = scope.reads();
        let taken = [
            (needs.time, quote!(t)),
            (reads.parameters, quote!(parameters)),
            (reads.inputs, quote!(inputs)),
        ];
        let taken = taken.into_iter().filter(|(is_read, _)| *is_read);
        let taken: Vec<TokenStream> = taken.map(|(_, name)| name).collect();
        let take = only(
            !taken.is_empty(),
            quote!(let &Conditions { #(#taken,)* .. } = conditions;),
        );
        let body = match needs.fails {
            true => quote! {
                #inline
                fn #name(#arguments) -> Result<(), Failure> { #take #(#statements)* #check Ok(()) }
            },
            false => quote!(#inline fn #name(#arguments) { #take #(#statements)* }),
        };
        let (capitals, approximate) = match has_capitals {
            true => lints::both(&body),
            false => (TokenStream::new(), lints::approximate(&body)),
        };
        quote!(#title #capitals #approximate #body)
    });
    functions.collect()
}

/// Fails where a coordinate, a rate or an acceleration of the block is not finite. A frame of thousands of coordinates is not
/// looked through at once: the compiler would turn it into as many local values.
fn own_check(index: usize, block: &Block, scope: &Scope<'_>) -> TokenStream {
    let found = checked_at_once(block, scope);
    let fields = found.iter().map(|&symbol| scope.symbol(symbol));
    let number = count(index);
    quote! {
        if !all_finite(&[#(#fields),*]) {
            return Err(not_finite(t, #number));
        }
    }
}

/// `struct Branches` with the drawing's choice.
pub(super) fn branches(module: &Module<'_>) -> TokenStream {
    let drawn = |positive: bool| match positive {
        true => "Branch::Positive",
        false => "Branch::Negative",
    };
    let blocks = &module.program.blocks;
    let iterated = blocks
        .iter()
        .enumerate()
        .filter_map(|(number, block)| Some((number, block, block.newton.as_ref()?)));
    let mut text = Verbatim::default();
    text.open("::linkwright::branches! {");
    text.docs([documentation::of_branches(module)]);
    let names = module.program.branches.iter().map(|branch| &branch.name);
    if names
        .chain(iterated.clone().map(|(_, block, _)| &block.name))
        .any(|name| lints::has_capitals(name))
    {
        text.line("#[allow(non_snake_case)]");
    }
    text.open("Branches {");
    let exchanged_by = exchanged_by(module);
    for branch in &module.program.branches {
        let name = identifier(&branch.name);
        let of = exchanged_by.get(&branch.symbol);
        let of = of.map_or(String::new(), |number| format!(", block {number}"));
        text.docs(doc_lines([documentation::of_branch(&branch.meaning)]));
        text.line(format!(
            "{name}: Branch = {}{of};",
            drawn(branch.is_positive())
        ));
    }
    for (number, block, newton) in iterated {
        let name = identifier(&block.name);
        let drawn = newton.drawn.sign().map_or("None".to_string(), |positive| {
            format!("Some({})", drawn(positive))
        });
        text.docs(doc_lines([format!(
            "The sign of the determinant of `{}`, which finds {}. `None` lets the estimate decide.",
            block.name,
            documentation::found_by(newton, module.system)
        )]));
        text.line(format!("{name}: Option<Branch> = {drawn}, block {number};"));
    }
    text.close("}");
    text.close("}");
    text.item()
}
