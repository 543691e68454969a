//! Whether a frame lies on the path of the last one.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::code::{Code, taken_apart};
use super::lints;
use super::literal::count;
use crate::emit::module::path_enclosures::iterated;
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::{Function, Path, Statement};

/// `verify_path`, `is_within` where Newton-Raphson finds something, and `verify_nonsingular` where all is in closed form.
pub(super) fn path(module: &Module<'_>) -> TokenStream {
    let Some(path) = &module.program.path else {
        return TokenStream::new();
    };
    let (within, filled) = enclosures(module, path);
    let mut code = Code::default();
    let keeps = Shown {
        name: "verify_path",
        docs: &documentation::VERIFY_PATH,
        enclosures: Some(filled),
    };
    shown(module, &path.function, keeps, &mut code);
    code.syntax(within);
    if let Some(function) = &path.closed {
        let stays = Shown {
            name: "verify_nonsingular",
            docs: &documentation::VERIFY_NONSINGULAR,
            enclosures: None,
        };
        shown(module, function, stays, &mut code);
    }
    code.to_token_stream()
}

/// A function that shows something of a window.
struct Shown<'a> {
    name: &'a str,
    docs: &'a [&'a str],
    /// What fills the enclosures, where it is given them.
    enclosures: Option<Code>,
}

fn shown(module: &Module<'_>, function: &Function, shown: Shown<'_>, code: &mut Code) {
    let scope = Scope::new(module, function, Place::Path);
    let found = scope.plain_statements();
    let reads = scope.reads();
    let mut own = function.statements.iter();
    let signals = own.any(|it| matches!(it, Statement::Signal { .. }));
    let mut own = function.statements.iter();
    let isolates = own.any(|it| matches!(it, Statement::Isolate { .. }));
    let (inputs, before) = (reads.inputs || signals, reads.before || signals);
    let fills = shown.enclosures.as_ref().is_some_and(|it| !it.is_empty());
    let conditions = [
        (reads.time, "t"),
        (reads.parameters, "parameters"),
        (inputs, "inputs"),
    ];
    let conditions = taken_apart("&Conditions", "conditions", &conditions);
    let both = [
        (reads.frame || fills, "at"),
        (reads.last || fills, "last"),
        (before, "before"),
        (conditions.is_some(), "conditions"),
    ];
    let both = taken_apart("&Pair", "pair", &both);
    let has_pair = both.is_some();
    let has_enclosures = shown.enclosures.is_some();
    let mut statements = Code::default();
    both.iter()
        .chain(&conditions)
        .for_each(|taken| statements.lines(taken));
    statements.append(found);
    statements.append(shown.enclosures.unwrap_or_default());
    statements.lines("Ok(())");
    let argument = |name: &str, is_read: bool| match is_read {
        true => name.to_string(),
        false => format!("_{name}"),
    };
    let (pair, window) = (
        argument("pair", has_pair),
        argument("window", reads.window || signals || isolates),
    );
    let enclosures = match has_enclosures {
        true => format!(", {}: &mut PathEnclosures", argument("enclosures", fills)),
        false => String::new(),
    };
    let head = format!(
        "fn {}({pair}: &Pair<'_>, {window}: &TimeWindow{enclosures}) -> Result<(), u16>",
        shown.name
    );
    let allow = lints::of_code(&statements);
    code.function(shown.docs, allow, &head, statements);
}

/// Whether what Newton-Raphson finds is in its enclosures, and what fills them.
fn enclosures(module: &Module<'_>, path: &Path) -> (TokenStream, Code) {
    let iterated = iterated(module.program, module.system, path);
    let mut filled = Code::default();
    if iterated.is_empty() {
        return (TokenStream::new(), filled);
    }
    let scope = Scope::new(module, &path.function, Place::Path);
    let mut found = Vec::with_capacity(iterated.len());
    for (place, (symbol, deviation)) in iterated.iter().enumerate() {
        let [now, before] = ["at", "last"].map(|frame| module.field_text(*symbol, frame));
        let deviation = deviation.map_or("0.0".to_string(), |deviation| scope.read(deviation));
        filled.push(&format!(
            "enclosures[{place}] = PathEnclosure::new({now}, {before}, {deviation});"
        ));
        found.push(module.field(*symbol, "at"));
    }
    let count = count(iterated.len());
    let within = quote! {
        /// Whether what Newton-Raphson has found is where the path is.
        fn is_within(at: &Frame, enclosures: &PathEnclosures, steps: Scalar) -> bool {
            let found: [Scalar; #count] = [#(#found),*];
            enclosures.iter().zip(found).all(|(enclosure, value)| enclosure.holds(value, steps))
        }
    };
    (within, filled)
}
