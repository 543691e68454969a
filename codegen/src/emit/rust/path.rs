//! Whether a frame lies on the path of the last one.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::docs::docs;
use super::lints;
use super::literal::count;
use super::module::only;
use super::names::identifier;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::tubes::iterated;
use crate::emit::module::{Module, documentation};
use crate::program::{Function, Path, Statement};

/// `keeps_to_path`, `is_within` where Newton-Raphson finds something, and `stays_regular` where all is in closed form.
pub(super) fn path(module: &Module<'_>) -> TokenStream {
    let Some(path) = &module.program.path else {
        return TokenStream::new();
    };
    let (within, filled) = tubes(module, path);
    let keeps = shown(
        module,
        &path.function,
        Shown {
            name: "keeps_to_path",
            docs: &documentation::KEEPS_TO_PATH,
            tubes: Some(filled),
        },
    );
    let stays = path.closed.as_ref().map(|function| {
        let shown = Shown {
            name: "stays_regular",
            docs: &documentation::STAYS_REGULAR,
            tubes: None,
        };
        self::shown(module, function, shown)
    });
    quote! {
        #keeps

        #within

        #stays
    }
}

/// A function that shows something of a span.
struct Shown<'a> {
    name: &'a str,
    docs: &'a [&'a str],
    /// What fills the tubes, where it is given them.
    tubes: Option<TokenStream>,
}

fn shown(module: &Module<'_>, function: &Function, shown: Shown<'_>) -> TokenStream {
    let filled = shown.tubes.clone().unwrap_or_default();
    let scope = Scope::new(module, function, Place::Path);
    let statements = scope.plain_statements();
    let reads = scope.reads();
    let mut own = function.statements.iter();
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
    let tubes = only(shown.tubes.is_some(), quote!(, #tubes: &mut Tubes));
    let pair = argument("pair", !both.is_empty());
    let both = only(
        !both.is_empty(),
        quote!(let &Pair { #(#both,)* .. } = pair;),
    );
    let (capitals, approximate) = lints::both(&body);
    let (name, text) = (identifier(shown.name), docs(shown.docs.iter().copied()));
    quote! {
        #text
        #capitals
        #approximate
        fn #name(#pair: &Pair<'_>, #span: &Span #tubes) -> Result<(), u16> {
            #both
            #conditions
            #body
            Ok(())
        }
    }
}

/// Whether what Newton-Raphson finds is in its tubes, and what fills them.
fn tubes(module: &Module<'_>, path: &Path) -> (TokenStream, TokenStream) {
    let iterated = iterated(module.program, module.system, path);
    if iterated.is_empty() {
        return (TokenStream::new(), TokenStream::new());
    }
    let scope = Scope::new(module, &path.function, Place::Path);
    let fields = |frame: &str| -> Vec<TokenStream> {
        iterated
            .iter()
            .map(|&(symbol, _)| module.field(symbol, frame))
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
