//! A function → what its values are called where they are written.

use std::cell::OnceCell;
use std::collections::HashSet;
use std::rc::Rc;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::module::Module;
use super::names::{LOCAL_VALUES, identifier, spelled};
use crate::expr::{ExprId, SymbolId};
use crate::model::field_name;
use crate::program::Function;
use crate::program::passes::names::LocalNames;
use crate::system::SymbolRole;

/// Where a function finds what it does not compute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// In the frame `at`, which it fills.
    Frame,
    /// In the structures `q`, `qd` and `qdd`.
    Coordinates,
    /// In the frame `at`, but for the tears, which are local.
    Tears,
    /// In the frames `at` and `last`.
    Path,
}

/// The names of one function.
pub(super) struct Scope<'a> {
    pub module: &'a Module<'a>,
    pub function: &'a Function,
    place: Place,
    /// Unknowns and rates that are local although frames hold them.
    tears: Vec<SymbolId>,
    locals: Rc<LocalNames>,
    /// The symbols in the values of its statements and results, once somebody asks for them.
    read: OnceCell<HashSet<SymbolId>>,
}

/// What a function reads of what it is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Reads {
    /// Anything of the last frame.
    pub last: bool,
    /// Anything of the inputs in the last frame.
    pub before: bool,
    /// Anything of the span.
    pub span: bool,
    pub position: bool,
    pub rate: bool,
    pub acceleration: bool,
    pub time: bool,
    pub parameters: bool,
    pub inputs: bool,
    pub branches: bool,
    /// Anything of the frame.
    pub frame: bool,
}

impl<'a> Scope<'a> {
    pub(super) fn new(module: &'a Module<'a>, function: &'a Function, place: Place) -> Scope<'a> {
        Scope::with_tears(module, function, place, Vec::new())
    }

    pub(super) fn with_tears(
        module: &'a Module<'a>,
        function: &'a Function,
        place: Place,
        tears: Vec<SymbolId>,
    ) -> Scope<'a> {
        let kept = |symbol: SymbolId| match place {
            Place::Frame => module.is_field(symbol),
            _ => tears.contains(&symbol),
        };
        let locals = LocalNames::of(function, module.system, kept, LOCAL_VALUES, spelled);
        Scope {
            module,
            function,
            place,
            tears,
            locals: Rc::new(locals),
            read: OnceCell::new(),
        }
    }

    /// The names of a function inside this one.
    pub(super) fn inner(&self, function: &'a Function) -> Scope<'a> {
        Scope {
            module: self.module,
            function,
            place: self.place,
            tears: Vec::new(),
            locals: Rc::clone(&self.locals),
            read: OnceCell::new(),
        }
    }

    /// The names of a function that is a part of this one.
    pub(super) fn part(&self, function: &'a Function) -> Scope<'a> {
        Scope {
            tears: self.tears.clone(),
            ..self.inner(function)
        }
    }

    /// Whether a closed form is one of those inside a torn block, which may be out of reach.
    pub(super) fn is_inside(&self) -> bool {
        self.place == Place::Tears
    }

    /// Whether a symbol is a field of the frame here.
    pub(super) fn is_field(&self, symbol: SymbolId) -> bool {
        self.place != Place::Coordinates
            && self.locals.name_of(symbol).is_none()
            && !self.tears.contains(&symbol)
            && self.module.is_field(symbol)
    }

    /// The name of an expression that was computed before.
    pub(super) fn value(&self, expr: ExprId) -> Option<TokenStream> {
        self.function
            .name_of(expr)
            .map(|symbol| self.symbol(symbol))
    }

    /// How a variable is read.
    pub(super) fn symbol(&self, symbol: SymbolId) -> TokenStream {
        let system = self.module.system;
        if let Some(local) = self.locals.name_of(symbol) {
            let name = identifier(local);
            return quote!(#name);
        }
        if let Some(branch) = self.module.program.branch_of(symbol) {
            let name = identifier(&branch.name);
            return quote!(branches.#name.sign::<Scalar>());
        }
        if let Some(part) = self.module.span_part(symbol) {
            let part = identifier(part);
            return quote!(span.#part);
        }
        match system.roles[symbol.index()] {
            SymbolRole::Last(symbol) => return self.last(symbol),
            SymbolRole::Parameter(parameter) => {
                let field = identifier(&field_name(&system.mechanism.parameters[parameter].name));
                return quote!(parameters.#field);
            }
            SymbolRole::Input { input, level } => {
                let field = identifier(&field_name(&system.mechanism.inputs[input].name));
                let level = format_ident!("{}", ["value", "rate", "acceleration"][level]);
                return quote!(inputs.#field.#level);
            }
            _ => {}
        }
        if self.is_field(symbol) {
            return self.module.field(symbol, &format_ident!("at"));
        }
        if self.place == Place::Coordinates
            && let Some((vector, name)) = self.module.coordinate(symbol)
        {
            return quote!(#vector.#name);
        }
        let name = identifier(&system.symbol_name(symbol));
        quote!(#name)
    }

    /// How the value of the last frame is read.
    fn last(&self, symbol: SymbolId) -> TokenStream {
        let system = self.module.system;
        match system.roles[symbol.index()] {
            SymbolRole::Time => quote!(last.t),
            SymbolRole::Input { input, level } => {
                let field = identifier(&field_name(&system.mechanism.inputs[input].name));
                let level = format_ident!("{}", ["value", "rate", "acceleration"][level]);
                quote!(before.#field.#level)
            }
            _ => self.module.field(symbol, &format_ident!("last")),
        }
    }

    /// Whether a statement or a result of the function reads a symbol.
    pub(super) fn is_read(&self, symbol: SymbolId) -> bool {
        let graph = &self.module.system.mechanism.graph;
        let read = || {
            let values = self.function.values();
            values
                .flat_map(|expr| graph.symbols(expr))
                .copied()
                .collect()
        };
        self.read.get_or_init(read).contains(&symbol)
    }

    /// What the function reads.
    pub(super) fn reads(&self) -> Reads {
        let mut reads = Reads::default();
        let system = self.module.system;
        let graph = &system.mechanism.graph;
        for &symbol in self
            .function
            .all_values()
            .flat_map(|expr| graph.symbols(expr))
        {
            if self.locals.name_of(symbol).is_some() {
                continue;
            }
            if self.module.span_part(symbol).is_some() {
                reads.span = true;
                continue;
            }
            if self.module.program.branch_of(symbol).is_some() {
                reads.branches = true;
                continue;
            }
            reads.frame |= self.is_field(symbol);
            match system.roles[symbol.index()] {
                SymbolRole::Position(_) => reads.position = true,
                SymbolRole::Rate(_) => reads.rate = true,
                SymbolRole::Acceleration(_) => reads.acceleration = true,
                SymbolRole::Time => reads.time = true,
                SymbolRole::Parameter(_) => reads.parameters = true,
                SymbolRole::Input { .. } => reads.inputs = true,
                SymbolRole::Last(symbol) => match system.roles[symbol.index()] {
                    SymbolRole::Input { .. } => reads.before = true,
                    _ => reads.last = true,
                },
                SymbolRole::Arm(_) | SymbolRole::Intermediate => {}
            }
        }
        reads
    }
}
