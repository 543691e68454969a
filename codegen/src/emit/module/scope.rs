//! Names the values of a function, and locates those that the function only reads.

use std::cell::OnceCell;
use std::rc::Rc;

use super::{Component, Module};
use crate::expr::{IdSet, SymbolId};
use crate::model::field_name;
use crate::pool::SymbolRole;
use crate::program::passes::names::LocalNames;
use crate::program::{Evaluation, Function, Statement};

/// Source of the values that a function does not compute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::emit) enum Place {
    /// Frame `at`, which the function fills.
    Frame,
    /// Frames `at` of several mechanisms, which the function fills.
    Lanes,
    /// Structures `q`, `qd` and `qdd`.
    Coordinates,
    /// Frame `at`, except for the tearing variables, which are local.
    Tears,
    /// Frames `at` and `last`.
    Path,
    /// Frames `at` and `last` of several mechanisms.
    PathLanes,
}

/// Location of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::emit) enum Location<'a> {
    /// Local value or argument of this name.
    Local(String),
    /// Sign of the assembly mode of this name.
    Sign(&'a str),
    /// Field of the time window.
    TimeWindow(&'static str),
    /// Field of the frame `at`.
    Field(SymbolId),
    /// Field of the frame `last`.
    Last(SymbolId),
    /// Time of the frame `last`.
    LastTime,
    /// Component of a structure of coordinates.
    Coordinate(Component<'a>),
    /// Parameter of this name.
    Parameter(String),
    /// `value`, `rate` or `acceleration` of the signal of this name.
    Input {
        name: String,
        level: &'static str,
        /// True if the signal is that of the frame `last`.
        before: bool,
    },
}

/// Names and locations of one function.
pub(in crate::emit) struct Scope<'a> {
    pub module: &'a Module<'a>,
    pub function: &'a Function,
    place: Place,
    /// Unknowns and rates that are local, although frames hold them.
    tears: Vec<SymbolId>,
    locals: Rc<LocalNames>,
    /// Symbols that statements and results read, collected on first use.
    read: OnceCell<IdSet<SymbolId>>,
    /// Sines and cosines that no statement reads, once known.
    unnamed: OnceCell<Vec<SymbolId>>,
    /// Local values that several loops over the lanes share, once known.
    shared: OnceCell<Vec<SymbolId>>,
}

/// Arguments that a function reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::emit) struct Reads {
    /// True if the function reads the last frame.
    pub last: bool,
    /// True if the function reads inputs of the last frame.
    pub before: bool,
    /// True if the function reads the time window.
    pub window: bool,
    pub position: bool,
    pub rate: bool,
    pub acceleration: bool,
    pub time: bool,
    pub parameters: bool,
    pub inputs: bool,
    pub branches: bool,
    /// True if the function reads fields of the frame `at`.
    pub frame: bool,
}

impl<'a> Scope<'a> {
    pub(in crate::emit) fn new(
        module: &'a Module<'a>,
        function: &'a Function,
        place: Place,
    ) -> Scope<'a> {
        Scope::with_tears(module, function, place, Vec::new())
    }

    pub(in crate::emit) fn with_tears(
        module: &'a Module<'a>,
        function: &'a Function,
        place: Place,
        tears: Vec<SymbolId>,
    ) -> Scope<'a> {
        let kept = |symbol: SymbolId| match place {
            Place::Frame | Place::Lanes => module.is_field(symbol),
            _ => tears.contains(&symbol),
        };
        let names = module.names;
        let locals = LocalNames::of(
            function,
            module.pool,
            module.system,
            kept,
            names.of_functions,
            names.spelled,
        );
        Scope {
            module,
            function,
            place,
            tears,
            locals: Rc::new(locals),
            read: OnceCell::new(),
            unnamed: OnceCell::new(),
            shared: OnceCell::new(),
        }
    }

    /// Returns the scope of a function inside this one.
    pub(in crate::emit) fn inner(&self, function: &'a Function) -> Scope<'a> {
        Scope {
            module: self.module,
            function,
            place: self.place,
            tears: Vec::new(),
            locals: Rc::clone(&self.locals),
            read: OnceCell::new(),
            unnamed: OnceCell::new(),
            shared: OnceCell::new(),
        }
    }

    /// Returns the scope of a part of this function, with its tearing variables.
    pub(in crate::emit) fn part(&self, function: &'a Function) -> Scope<'a> {
        Scope {
            tears: self.tears.clone(),
            ..self.inner(function)
        }
    }

    /// True inside a torn block, where a closed form out of reach is not yet a failure.
    pub(in crate::emit) fn is_inside(&self) -> bool {
        self.place == Place::Tears
    }

    /// True in a function that solves several mechanisms, whose checks return the lanes that fail.
    pub(in crate::emit) fn is_in_lanes(&self) -> bool {
        matches!(self.place, Place::Lanes | Place::PathLanes)
    }

    /// True if the symbol is a field of the frame in this function.
    pub(in crate::emit) fn is_field(&self, symbol: SymbolId) -> bool {
        self.place != Place::Coordinates
            && self.locals.name_of(symbol).is_none()
            && !self.tears.contains(&symbol)
            && self.module.is_field(symbol)
    }

    /// Returns the order of the function's arithmetic.
    pub(in crate::emit) fn evaluation(&self) -> Evaluation<'a> {
        let constants = &self.module.program.constants;
        Evaluation::new(
            self.function,
            self.module.pool,
            self.module.system,
            constants,
        )
    }

    /// Returns the location of a variable.
    pub(in crate::emit) fn locate(&self, symbol: SymbolId) -> Location<'a> {
        let system = self.module.system;
        if let Some(local) = self.locals.name_of(symbol) {
            return Location::Local(local.to_string());
        }
        if let Some(branch) = self.module.program.branch_of(symbol) {
            return Location::Sign(&branch.name);
        }
        if let Some(part) = self.module.window_part(symbol) {
            return Location::TimeWindow(part);
        }
        match self.module.pool.role(symbol) {
            SymbolRole::Last(symbol) => return self.locate_last(symbol),
            SymbolRole::Parameter(parameter) => {
                let name = &system.mechanism.parameters[parameter].name;
                return Location::Parameter(field_name(name));
            }
            SymbolRole::Input { input, level } => return self.locate_input(input, level, false),
            _ => {}
        }
        if self.is_field(symbol) {
            return Location::Field(symbol);
        }
        let component = self.module.component(symbol);
        match component.filter(|_| self.place == Place::Coordinates) {
            Some(component) => Location::Coordinate(component),
            None => Location::Local(system.symbol_name(symbol, self.module.pool)),
        }
    }

    /// Returns the location of a symbol's value in the last frame.
    fn locate_last(&self, symbol: SymbolId) -> Location<'a> {
        match self.module.pool.role(symbol) {
            SymbolRole::Time => Location::LastTime,
            SymbolRole::Input { input, level } => self.locate_input(input, level, true),
            _ => Location::Last(symbol),
        }
    }

    fn locate_input(&self, input: usize, level: usize, before: bool) -> Location<'a> {
        Location::Input {
            name: field_name(&self.module.system.mechanism.inputs[input].name),
            level: ["value", "rate", "acceleration"][level],
            before,
        }
    }

    /// True if a statement or a result of the function reads the symbol.
    pub(in crate::emit) fn is_read(&self, symbol: SymbolId) -> bool {
        let graph = &self.module.pool.graph;
        let read = || {
            let values = self.function.values();
            values
                .flat_map(|expr| graph.symbols(expr))
                .copied()
                .collect()
        };
        self.read.get_or_init(read).contains(&symbol)
    }

    /// Returns the sines and cosines that statements compute.
    pub(in crate::emit) fn sines_and_cosines(&self) -> impl Iterator<Item = SymbolId> {
        let statements = self.function.statements.iter();
        let pairs = statements.filter_map(|statement| match statement {
            Statement::SineCosine { sine, cosine, .. } => Some([*sine, *cosine]),
            _ => None,
        });
        pairs.flatten()
    }

    /// Records the sines and cosines that no statement reads.
    pub(in crate::emit) fn leave_unnamed(&self, symbols: Vec<SymbolId>) {
        self.unnamed.get_or_init(|| symbols);
    }

    /// True if the symbol is a sine or cosine that no statement reads.
    pub(in crate::emit) fn is_unnamed(&self, symbol: SymbolId) -> bool {
        self.unnamed.get().is_some_and(|it| it.contains(&symbol))
    }

    /// Records the local values that several loops over the lanes share.
    pub(in crate::emit) fn share(&self, symbols: Vec<SymbolId>) {
        self.shared.get_or_init(|| symbols);
    }

    /// True if several loops over the lanes share the local value.
    pub(in crate::emit) fn is_shared(&self, symbol: SymbolId) -> bool {
        self.shared.get().is_some_and(|it| it.contains(&symbol))
    }

    /// True if an enclosure or a later statement reads the bound of a path.
    pub(in crate::emit) fn is_wanted(&self, symbol: SymbolId) -> bool {
        self.module.has_enclosure(symbol) || self.is_read(symbol)
    }

    /// Returns the arguments that the function reads.
    pub(in crate::emit) fn reads(&self) -> Reads {
        let mut reads = Reads::default();
        let graph = &self.module.pool.graph;
        for &symbol in self
            .function
            .all_values()
            .flat_map(|expr| graph.symbols(expr))
        {
            if self.locals.name_of(symbol).is_some() {
                continue;
            }
            if self.module.window_part(symbol).is_some() {
                reads.window = true;
                continue;
            }
            if self.module.program.branch_of(symbol).is_some() {
                reads.branches = true;
                continue;
            }
            reads.frame |= self.is_field(symbol);
            match self.module.pool.role(symbol) {
                SymbolRole::Position(_) => reads.position = true,
                SymbolRole::Rate(_) => reads.rate = true,
                SymbolRole::Acceleration(_) => reads.acceleration = true,
                SymbolRole::Time => reads.time = true,
                SymbolRole::Parameter(_) => reads.parameters = true,
                SymbolRole::Input { .. } => reads.inputs = true,
                SymbolRole::Last(symbol) => match self.module.pool.role(symbol) {
                    SymbolRole::Input { .. } => reads.before = true,
                    _ => reads.last = true,
                },
                SymbolRole::Arm(_) | SymbolRole::Intermediate => {}
            }
        }
        reads
    }
}
