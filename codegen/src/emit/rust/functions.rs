//! The path of a module with elementary functions → the imports that put them in place of the runtime's.

use std::collections::HashSet;

use proc_macro2::TokenStream;
use quote::quote;
use syn::Path;
use syn::parse::Parser;

/// What a module may take from somewhere else.
pub(super) const FUNCTIONS: [&str; 2] = ["math", "angle_near"];

/// `use crate::plain::{self as math, angle_near};`, as far as the code mentions these names. An import by name goes before the one
/// of all names that every module begins with.
///
/// What is no path becomes an error where the code is compiled, as a path does that leads nowhere.
pub(super) fn functions(path: &str, mentioned: &HashSet<&str>) -> TokenStream {
    let Ok(module) = Path::parse_mod_style.parse_str(path) else {
        let problem = format!("the option `math` is `{path}`, which is not the path of a module");
        return quote!(compile_error!(#problem););
    };
    let imports = [quote!(self as math), quote!(angle_near)];
    let used = FUNCTIONS
        .into_iter()
        .zip(imports)
        .filter(|(name, _)| mentioned.contains(name));
    let used: Vec<TokenStream> = used.map(|(_, import)| import).collect();
    match used.as_slice() {
        [] => TokenStream::new(),
        used => quote!(use #module::{#(#used),*};),
    }
}
