//! The parts of the module in their order, and what all of them are written with.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::code::tokens;
use super::functions::{FUNCTIONS, functions};
use super::layout::{Verbatim, laid_out};
use super::names::{identifier, identifier_text};
use super::pieces::{Around, formatted};
use super::{
    assemblies, block, coordinates, explained, frame, loads, newton, parameters, path, shell,
    tables, textbook,
};
use crate::emit::module::Module;
use crate::emit::text;
use crate::expr::SymbolId;
use crate::program::LARGEST_TEXTBOOK;

impl Module<'_> {
    /// A number.
    pub(super) fn float(&self, value: f64) -> TokenStream {
        self.scalar.literal(value)
    }

    /// A number as it is written.
    pub(super) fn number(&self, value: f64) -> String {
        self.float(value).to_string().replace("- ", "-")
    }

    /// A field of a frame.
    pub(super) fn field(&self, symbol: SymbolId, frame: &str) -> TokenStream {
        tokens(&self.field_text(symbol, frame))
    }

    /// The same as text.
    pub(super) fn field_text(&self, symbol: SymbolId, frame: &str) -> String {
        match self.component(symbol).filter(|_| self.holds_coordinates()) {
            Some(component) => {
                let name = identifier_text(component.name);
                format!("{frame}.{}.{name}", component.vector)
            }
            None => format!("{frame}.{}", identifier_text(self.own_field(symbol))),
        }
    }

    /// The name of a field that is none of the coordinates.
    pub(super) fn field_name(&self, symbol: SymbolId) -> Ident {
        identifier(self.own_field(symbol))
    }

    /// The items of the module, which stands in `around`. Its elementary functions are the runtime's,
    /// or those of the module at the path `math`.
    pub(super) fn items(&self, math: Option<&str>, around: &[Around]) -> String {
        let precision = self.scalar.precision();
        // One at a time becomes text: as tokens all of them together would take far more room.
        let parts: [&dyn Fn(&Self) -> TokenStream; 15] = [
            &coordinates::coordinates,
            &parameters::structures,
            &textbook::functions,
            &frame::frame,
            &block::branches,
            &assemblies::assemblies,
            &explained::block_names,
            &loads::labels,
            &textbook::characteristic_length,
            &newton::equations,
            &block::functions,
            &path::path,
            &loads::function,
            &shell::mechanism,
            &textbook::dense,
        ];
        let rest = parts.iter().fold(String::new(), |text, part| {
            text + &formatted(part(self), around)
        });
        let rest = laid_out(&rest);
        let mentioned = mentioned(&rest);
        let constants = self.constants(&mentioned);
        let tables = tables::tables(self, &mentioned);
        let functions = math.map(|path| functions(path, &mentioned));
        let first =
            quote!(use ::linkwright::generated::#precision::*; #functions #constants #tables);
        laid_out(&formatted(first, around)) + "\n" + &rest
    }

    /// The named constants that the code mentions; what of the solved view is left out may have been all that needed one.
    fn constants(&self, mentioned: &HashSet<&str>) -> TokenStream {
        let list = self.program.constants.list().iter();
        let mut used = list
            .filter(|constant| mentioned.contains(constant.name.as_str()))
            .peekable();
        if used.peek().is_none() {
            return TokenStream::new();
        }
        let mut text = Verbatim::default();
        text.open("::linkwright::generated::constants! {");
        for constant in used {
            let exact = text::constant(self.pool, self.system, &constant.part);
            let exact = exact.map_or(String::new(), |exact| format!(" // {exact}"));
            let (name, value) = (identifier(&constant.name), self.number(constant.value));
            text.line(format!("{name} = {value},{exact}"));
        }
        text.close("}");
        text.item()
    }
}

/// Every word of code that may be the name of a constant, a table or a function, but for what stands in documentation, comments and
/// strings.
fn mentioned(code: &str) -> HashSet<&str> {
    let mut found = HashSet::new();
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    for line in lines {
        let mut rest = line;
        while let Some(start) = rest.find(|it: char| it == '"' || is_of_word(it)) {
            rest = &rest[start..];
            if let Some(string) = rest.strip_prefix('"') {
                rest = after_string(string);
                continue;
            }
            let end = rest.find(|it: char| !is_of_word(it));
            let (word, others) = rest.split_at(end.unwrap_or(rest.len()));
            if word.starts_with(|it: char| it.is_ascii_uppercase()) || FUNCTIONS.contains(&word) {
                found.insert(word);
            }
            rest = others;
        }
    }
    found
}

fn is_of_word(letter: char) -> bool {
    letter == '_' || letter.is_alphanumeric()
}

/// What follows the quote that ends a string, of which this is what follows the quote that begins it.
fn after_string(text: &str) -> &str {
    let mut letters = text.char_indices();
    while let Some((place, letter)) = letters.next() {
        match letter {
            '\\' => {
                letters.next();
            }
            '"' => return &text[place + 1..],
            _ => {}
        }
    }
    ""
}

/// The tokens where there is something to say.
pub(super) fn only(there: bool, tokens: TokenStream) -> TokenStream {
    match there {
        true => tokens,
        false => TokenStream::new(),
    }
}

/// What a structure with this many numbers derives. Comparing and printing thousands of fields one by one is code that no compiler
/// digests.
pub(super) fn derives(fields: usize) -> TokenStream {
    match fields <= LARGEST_TEXTBOOK {
        true => quote!(#[derive(Clone, Copy, Debug, PartialEq)]),
        false => quote!(#[derive(Clone, Copy)]),
    }
}
