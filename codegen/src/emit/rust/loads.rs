//! The loads that a failure names: their labels, and the function that finds the first which is not finite.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::code::{Code, taken_apart};
use super::literal::count;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::Block;

/// Name of the function that ascribes a failure to a load.
const FUNCTION: &str = "blame_load";

/// Returns the labels; nothing if no load may become infinite.
pub(super) fn labels(module: &Module<'_>) -> TokenStream {
    let Some(loads) = &module.program.loads else {
        return TokenStream::new();
    };
    let (labels, length) = (&loads.labels, count(loads.labels.len()));
    let docs = format!(" {}", documentation::LOADS);
    quote! {
        #[doc = #docs]
        pub const LOADS: [&str; #length] = [#(#labels),*];
    }
}

/// Returns the function that ascribes a failure to the first load that is not finite.
pub(super) fn function(module: &Module<'_>) -> TokenStream {
    let Some(loads) = &module.program.loads else {
        return TokenStream::new();
    };
    let scope = Scope::new(module, &loads.function, Place::Frame);
    let (statements, results, reads) = (
        scope.plain_statements(),
        scope.written_results(),
        scope.reads(),
    );
    let read = [
        (reads.time, "t"),
        (reads.parameters, "parameters"),
        (reads.inputs, "inputs"),
    ];
    let mut code = Code::default();
    let taken = taken_apart("&Conditions", "conditions", &read);
    if let Some(taken) = &taken {
        code.lines(taken);
    }
    code.append(statements);
    let read = loads.read.iter().map(|&symbol| scope.read(symbol));
    let read: Vec<String> = read.collect();
    code.push(&format!(
        "load_not_finite(failure, &[{}], &[{}], {})",
        read.join(", "),
        results.join(", "),
        loads.block
    ));
    let argument = |name: &str, is_read: bool| match is_read {
        true => name.to_string(),
        false => format!("_{name}"),
    };
    let head = format!(
        "fn {FUNCTION}(failure: Failure, {}: &Frame, {}: &Conditions<'_>) -> Failure",
        argument("at", !loads.read.is_empty()),
        argument("conditions", taken.is_some())
    );
    let mut all = Code::default();
    all.function([documentation::BLAMED_LOAD], ["#[cold]"], &head, code);
    all.to_token_stream()
}

/// Returns a failure ascribed to the load that causes it, if loads may be its cause.
pub(super) fn blamed(failure: TokenStream, module: &Module<'_>) -> TokenStream {
    match module.program.loads {
        Some(_) => quote!(blame_load(#failure, at, conditions)),
        None => failure,
    }
}

/// Returns the end of the call of a block that fails: `?`, or what ascribes its failure to a load first.
pub(super) fn handed_on(block: &Block, module: &Module<'_>) -> String {
    let loads = module.program.loads.as_ref();
    let own = loads.and_then(|loads| module.program.blocks.get(usize::from(loads.block)));
    match own {
        Some(own) if std::ptr::eq(own, block) => {
            format!(".map_err(|failure| {FUNCTION}(failure, at, conditions))?")
        }
        _ => "?".to_string(),
    }
}
