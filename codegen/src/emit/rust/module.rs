//! The parts of the module in their order, and what all of them are written with.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::functions::functions;
use super::layout::Verbatim;
use super::literal::Scalar;
use super::names::identifier;
use super::names::spelled;
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

    /// The items of the module, in parts that belong together.
    pub(super) fn items(&self, owns_parameters: bool) -> Vec<TokenStream> {
        let precision = self.scalar.precision();
        let mut parts = vec![
            coordinates::coordinates(self),
            parameters::structures(self, owns_parameters),
            textbook::functions(self),
            frame::frame(self),
            block::branches(self),
            explained::block_names(self),
            textbook::characteristic_length(self),
            newton::equations(self),
            block::functions(self),
            path::path(self),
            shell::mechanism(self),
            textbook::dense(self),
        ];
        let mentioned = identifiers(&parts);
        let constants = self.constants(&mentioned);
        let tables = tables::tables(self, &mentioned);
        let functions = self.math.map(|path| functions(path, &mentioned));
        parts.insert(
            0,
            quote!(use ::linkwright::#precision::*; #functions #constants #tables),
        );
        parts
    }

    /// The named constants that the code mentions; what of the solved view is left out may have been all that needed one.
    fn constants(&self, mentioned: &HashSet<String>) -> TokenStream {
        let list = self.program.constants.list().iter();
        let mut used = list
            .filter(|constant| mentioned.contains(&constant.name))
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

/// Every identifier of pieces of code.
fn identifiers(code: &[TokenStream]) -> HashSet<String> {
    let mut found = HashSet::new();
    let mut open = code.to_vec();
    while let Some(tokens) = open.pop() {
        for token in tokens {
            match token {
                TokenTree::Group(group) => open.push(group.stream()),
                TokenTree::Ident(ident) => {
                    found.insert(ident.to_string());
                }
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    found
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
