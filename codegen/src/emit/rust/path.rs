//! Whether a frame lies on the path of the last one.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::lints;
use super::literal::count;
use super::module::{Module, only};
use super::names::identifier;
use super::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::program::{Path, Program, Statement};
use crate::system::System;

/// `keeps_to_path`, and `is_within` where Newton-Raphson finds something.
pub(super) fn path(module: &Module<'_>) -> TokenStream {
    let Some(path) = &module.program.path else {
        return TokenStream::new();
    };
    let (within, filled) = tubes(module, path);
    let scope = Scope::new(module, &path.function, Place::Path);
    let statements = scope.plain_statements();
    let reads = scope.reads();
    let mut own = path.function.statements.iter();
    let signals = own.any(|it| matches!(it, Statement::Signal { .. }));
    let (inputs, before) = (reads.inputs || signals, reads.before || signals);
    let named = |names: &[(bool, &str)]| -> Vec<Ident> {
        let read = names.iter().filter(|(is_read, _)| *is_read);
        read.map(|(_, name)| identifier(name)).collect()
    };
    let conditions = named(&[
        (reads.time, "t"),
        (reads.parameters, "parameters"),
        (inputs, "inputs"),
    ]);
    let has_tubes = !filled.is_empty();
    let both = named(&[
        (reads.frame || has_tubes, "at"),
        (reads.last || has_tubes, "last"),
        (before, "before"),
        (!conditions.is_empty(), "conditions"),
    ]);
    let conditions = only(
        !conditions.is_empty(),
        quote!(let &Conditions { #(#conditions,)* .. } = conditions;),
    );
    let body = quote! {
        #(#statements)*
        #filled
    };
    let argument = |name: &str, is_read: bool| match is_read {
        true => identifier(name),
        false => format_ident!("_{name}"),
    };
    let (span, tubes) = (
        argument("span", reads.span || signals),
        argument("tubes", has_tubes),
    );
    let pair = argument("pair", !both.is_empty());
    let both = only(
        !both.is_empty(),
        quote!(let &Pair { #(#both,)* .. } = pair;),
    );
    let (capitals, approximate) = (lints::capitals(&body), lints::approximate(&body));
    quote! {
        /// Whether a frame lies on the path of the last one: how far values are from where they are now (`radius`), and from a
        /// straight line (`sag`), while the mechanism moves; or else the block of which that cannot be shown.
        #capitals
        #approximate
        fn keeps_to_path(#pair: &Pair<'_>, #span: &Span, #tubes: &mut Tubes) -> Result<(), u16> {
            #both
            #conditions
            #body
            Ok(())
        }

        #within
    }
}

/// The unknowns that Newton-Raphson finds, with their sags; what does not move has none.
fn iterated(program: &Program, system: &System, path: &Path) -> Vec<(SymbolId, Option<SymbolId>)> {
    let blocks = program.blocks.iter();
    let unknowns = blocks.flat_map(|block| block.newton.iter().flat_map(|newton| &newton.unknowns));
    let unknowns = unknowns.map(|unknown| {
        let position = system.vector_form.unknowns[*unknown].position;
        (position, path.sags.get(unknown).copied())
    });
    unknowns.collect()
}

/// How many tubes there are.
pub(super) fn tube_count(module: &Module<'_>) -> usize {
    let path = module.program.path.iter();
    path.map(|path| iterated(module.program, module.system, path).len())
        .sum()
}

/// The sags of tubes.
pub(super) fn sags_of_tubes(program: &Program, system: &System) -> HashSet<SymbolId> {
    let path = program.path.iter();
    path.flat_map(|path| iterated(program, system, path))
        .filter_map(|(_, sag)| sag)
        .collect()
}

/// Whether what Newton-Raphson finds is in its tubes, and what fills them.
fn tubes(module: &Module<'_>, path: &Path) -> (TokenStream, TokenStream) {
    let iterated = iterated(module.program, module.system, path);
    if iterated.is_empty() {
        return (TokenStream::new(), TokenStream::new());
    }
    let scope = Scope::new(module, &path.function, Place::Path);
    let fields = |frame: &str| -> Vec<TokenStream> {
        let frame = format_ident!("{frame}");
        iterated
            .iter()
            .map(|&(symbol, _)| module.field(symbol, &frame))
            .collect()
    };
    let (now, before) = (fields("at"), fields("last"));
    let sags = iterated.iter().map(|(_, sag)| match sag {
        Some(sag) => scope.symbol(*sag),
        None => quote!(0.0),
    });
    let (places, count) = ((0..iterated.len()).map(count), count(iterated.len()));
    let within = quote! {
        /// Whether what Newton-Raphson has found is where the path is.
        fn is_within(at: &Frame, tubes: &Tubes, steps: Scalar) -> bool {
            let found: [Scalar; #count] = [#(#now),*];
            tubes.iter().zip(found).all(|(tube, value)| tube.holds(value, steps))
        }
    };
    let filled = quote!(#(tubes[#places] = Tube::new(#now, #before, #sags);)*);
    (within, filled)
}
