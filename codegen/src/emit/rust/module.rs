//! The parts of the module in their order, and what all of them are written with.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::functions::functions;
use super::layout::Verbatim;
use super::literal::Scalar;
use super::names::identifier;
use super::names::spelled;
use super::pieces::{Around, formatted};
use super::{
    block, coordinates, explained, frame, newton, parameters, path, shell, tables, textbook,
};
use crate::emit::derivation::{self, BlockWords, PlainWords, SingularPose};
use crate::emit::{Notation, report, text};
use crate::expr::SymbolId;
use crate::model::Role;
use crate::program::passes::names::LocalNames;
use crate::program::{LARGEST_TEXTBOOK, Program};
use crate::structure::SolvedPlan;
use crate::system::{SymbolRole, System};
use crate::words::Phrase;

/// The fields that every frame has.
const FRAME: &[&str] = &["t", "q", "qd", "qdd", "parameters"];

/// A mechanism or one of its motions, as it is written.
pub(super) struct Module<'a> {
    pub system: &'a System,
    pub program: &'a Program,
    pub scalar: Scalar,
    /// The path of the module whose elementary functions are taken instead of the runtime's.
    math: Option<&'a str>,
    /// Where each part of the plan is singular.
    pub poses: Vec<SingularPose>,
    /// What each block of the program is called.
    pub words: Vec<BlockWords>,
    /// What the frame calls what it keeps beside the coordinates.
    fields: LocalNames,
    comments: PlainWords,
    /// The sags that tubes are filled with.
    tubes: HashSet<SymbolId>,
}

impl<'a> Module<'a> {
    pub(super) fn new(
        system: &'a System,
        plan: &SolvedPlan,
        program: &'a Program,
        scalar: Scalar,
        math: Option<&'a str>,
    ) -> Module<'a> {
        let kept = program.fields.iter().copied();
        let poses = derivation::singular_poses(system, plan, &program.forms, Notation::Unicode);
        Module {
            fields: LocalNames::of_symbols(kept, system, FRAME, spelled),
            words: derivation::block_words(&program.blocks, system, plan, &poses),
            poses,
            comments: PlainWords::new(system, Notation::Unicode),
            tubes: path::sags_of_tubes(program, system),
            system,
            program,
            scalar,
            math,
        }
    }

    /// Whether frames hold all coordinates, and not only what is asked for.
    pub(super) fn holds_coordinates(&self) -> bool {
        self.program.outputs.is_none()
    }

    /// Whether the mechanism is too large for functions that go through all coordinates at once.
    pub(super) fn is_large(&self) -> bool {
        self.system.coordinates.len() > LARGEST_TEXTBOOK
    }

    /// A number.
    pub(super) fn float(&self, value: f64) -> TokenStream {
        self.scalar.literal(value)
    }

    /// A number as it is written.
    pub(super) fn number(&self, value: f64) -> String {
        self.float(value).to_string().replace("- ", "-")
    }

    /// `q`, `qd` or `qdd` and the coordinate's name.
    pub(super) fn coordinate(&self, symbol: SymbolId) -> Option<(Ident, Ident)> {
        let (vector, unknown) = match self.system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => ("q", unknown),
            SymbolRole::Rate(unknown) => ("qd", unknown),
            SymbolRole::Acceleration(unknown) => ("qdd", unknown),
            _ => return None,
        };
        let coordinate = self.system.coordinates.get(unknown)?;
        Some((format_ident!("{vector}"), identifier(&coordinate.name)))
    }

    /// Whether frames hold a value.
    pub(super) fn is_field(&self, symbol: SymbolId) -> bool {
        self.holds_coordinates() && self.system.is_coordinate(symbol)
            || self.program.is_field(symbol)
    }

    /// A field of a frame.
    pub(super) fn field(&self, symbol: SymbolId, frame: &Ident) -> TokenStream {
        match self.coordinate(symbol).filter(|_| self.holds_coordinates()) {
            Some((vector, name)) => quote!(#frame.#vector.#name),
            None => {
                let name = self.field_name(symbol);
                quote!(#frame.#name)
            }
        }
    }

    /// The name of a field that is none of the coordinates.
    pub(super) fn field_name(&self, symbol: SymbolId) -> Ident {
        identifier(self.fields.name_of(symbol).unwrap_or_default())
    }

    /// What a symbol is called that says what the span is like.
    pub(super) fn span_part(&self, symbol: SymbolId) -> Option<&'static str> {
        let span = &self.program.path.as_ref()?.span;
        let parts = [
            (span.time, "time"),
            (span.stretch, "stretch"),
            (span.bend, "bend"),
            (span.beyond, "beyond"),
        ];
        parts
            .into_iter()
            .find(|(own, _)| *own == symbol)
            .map(|(_, name)| name)
    }

    /// Whether a sag is that of a tube.
    pub(super) fn has_tube(&self, sag: SymbolId) -> bool {
        self.tubes.contains(&sag)
    }

    /// Words as a comment says them.
    pub(super) fn said(&self, words: &Phrase) -> String {
        self.comments.say(words)
    }

    /// The items of the module, which stands in `around`, as the formatter leaves them.
    pub(super) fn items(&self, owns_parameters: bool, around: &[Around]) -> String {
        let precision = self.scalar.precision();
        let structures = |module: &Self| parameters::structures(module, owns_parameters);
        // One at a time becomes text: as tokens all of them together would take far more room.
        let parts: [&dyn Fn(&Self) -> TokenStream; 12] = [
            &coordinates::coordinates,
            &structures,
            &textbook::functions,
            &frame::frame,
            &block::branches,
            &explained::block_names,
            &textbook::characteristic_length,
            &newton::equations,
            &block::functions,
            &path::path,
            &shell::mechanism,
            &textbook::dense,
        ];
        let rest = parts.iter().fold(String::new(), |text, part| {
            text + &formatted(part(self), around)
        });
        let mentioned = identifiers(&rest);
        let constants = self.constants(&mentioned);
        let tables = tables::tables(self, &mentioned);
        let functions = self.math.map(|path| functions(path, &mentioned));
        let first = quote!(use ::linkwright::#precision::*; #functions #constants #tables);
        formatted(first, around) + &rest
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
        text.open("::linkwright::constants! {");
        for constant in used {
            let exact = text::constant(self.system, &constant.part);
            let exact = exact.map_or(String::new(), |exact| format!(" // {exact}"));
            let (name, value) = (identifier(&constant.name), self.number(constant.value));
            text.line(format!("{name} = {value},{exact}"));
        }
        text.close("}");
        text.item()
    }

    /// Lines of text that say what the module computes and what it costs.
    pub(super) fn facts(&self) -> Vec<String> {
        let system = self.system;
        let mechanism = &system.mechanism;
        let is_driver = |joint: usize| mechanism.joints[joint].role == Role::Driver;
        let drivers = system
            .rows
            .iter()
            .filter(|row| is_driver(row.joint))
            .count();
        let mut lines = vec![format!(
            "{} bodies, {} coordinates, {} equations ({} of joints, {drivers} of drivers).",
            mechanism.moving_bodies().len(),
            system.coordinates.len(),
            system.rows.len(),
            system.rows.len() - drivers,
        )];
        if !system.monitored.is_empty() {
            let names = system.monitored.iter().map(|row| row.name.as_str());
            let names: Vec<&str> = names.collect();
            lines.push(format!(
                "Redundant equations, not solved: {}.",
                names.join(", ")
            ));
        }
        lines.extend(text::given(system).lines().map(capitalized));
        lines.extend(report::lines(&self.program.report));
        if self.program.textbook.is_none() {
            let why = "Left out: the textbook view, whose dense matrices would not fit a stack.";
            lines.push(why.to_string());
        }
        lines
    }
}

/// Every word of code, but for what stands in its documentation and in strings.
fn identifiers(code: &str) -> HashSet<&str> {
    let mut found = HashSet::new();
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("///"));
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
            found.insert(word);
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

/// `Parameter L = 0.05 m.` of `parameter L = 0.05 m`.
fn capitalized(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).chain(['.']).collect()
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
