//! A function → what its values are called, and where it finds what it does not compute.

use std::cell::OnceCell;
use std::rc::Rc;

use super::{Component, Module};
use crate::expr::{IdSet, SymbolId};
use crate::model::field_name;
use crate::pool::SymbolRole;
use crate::program::passes::names::LocalNames;
use crate::program::{Evaluation, Function, Statement};

/// Where a function finds what it does not compute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::emit) enum Place {
    /// In the frame `at`, which it fills.
    Frame,
    /// In the structures `q`, `qd` and `qdd`.
    Coordinates,
    /// In the frame `at`, but for the tears, which are local.
    Tears,
    /// In the frames `at` and `last`.
    Path,
}

/// Where a value stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::emit) enum Location<'a> {
    /// In a local value or an argument of this name.
    Local(String),
    /// Where the assembly mode of this name is, whose sign it is.
    Sign(&'a str),
    /// In a part of the window.
    TimeWindow(&'static str),
    /// In a field of the frame `at`.
    Field(SymbolId),
    /// In a field of the frame `last`.
    Last(SymbolId),
    /// In the time of the frame `last`.
    LastTime,
    /// In a structure of coordinates.
    Coordinate(Component<'a>),
    /// In the parameter of this name.
    Parameter(String),
    /// In the signal of this name: `value`, `rate` or `acceleration`.
    Input {
        name: String,
        level: &'static str,
        /// Whether it is that of the frame `last`.
        before: bool,
    },
}

/// The names of one function.
pub(in crate::emit) struct Scope<'a> {
    pub module: &'a Module<'a>,
    pub function: &'a Function,
    place: Place,
    /// Unknowns and rates that are local although frames hold them.
    tears: Vec<SymbolId>,
    locals: Rc<LocalNames>,
    /// The symbols in the values of its statements and results, once somebody asks for them.
    read: OnceCell<IdSet<SymbolId>>,
    /// The sines and cosines that nobody reads, once that is known.
    unnamed: OnceCell<Vec<SymbolId>>,
}

/// What a function reads of what it is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::emit) struct Reads {
    /// Anything of the last frame.
    pub last: bool,
    /// Anything of the inputs in the last frame.
    pub before: bool,
    /// Anything of the window.
    pub window: bool,
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
            Place::Frame => module.is_field(symbol),
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
        }
    }

    /// The names of a function inside this one.
    pub(in crate::emit) fn inner(&self, function: &'a Function) -> Scope<'a> {
        Scope {
            module: self.module,
            function,
            place: self.place,
            tears: Vec::new(),
            locals: Rc::clone(&self.locals),
            read: OnceCell::new(),
            unnamed: OnceCell::new(),
        }
    }

    /// The names of a function that is a part of this one.
    pub(in crate::emit) fn part(&self, function: &'a Function) -> Scope<'a> {
        Scope {
            tears: self.tears.clone(),
            ..self.inner(function)
        }
    }

    /// Whether a closed form is one of those inside a torn block, which may be out of reach.
    pub(in crate::emit) fn is_inside(&self) -> bool {
        self.place == Place::Tears
    }

    /// Whether a symbol is a field of the frame here.
    pub(in crate::emit) fn is_field(&self, symbol: SymbolId) -> bool {
        self.place != Place::Coordinates
            && self.locals.name_of(symbol).is_none()
            && !self.tears.contains(&symbol)
            && self.module.is_field(symbol)
    }

    /// The order of the function's arithmetic.
    pub(in crate::emit) fn evaluation(&self) -> Evaluation<'a> {
        Evaluation {
            pool: self.module.pool,
            function: self.function,
            system: self.module.system,
            constants: &self.module.program.constants,
        }
    }

    /// Where a variable stands.
    pub(in crate::emit) fn locate(&self, symbol: SymbolId) -> Location<'a> {
        let system = self.module.system;
        if let Some(local) = self.locals.name_of(symbol) {
            return Location::Local(local.to_string());
        }
        if let Some(branch) = self.module.program.branch_of(symbol) {
            return Location::Sign(&branch.name);
        }
        if let Some(part) = self.module.span_part(symbol) {
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

    /// Where the value of the last frame stands.
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

    /// Whether a statement or a result of the function reads a symbol.
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

    /// The sines and cosines that its statements find.
    pub(in crate::emit) fn sines_and_cosines(&self) -> impl Iterator<Item = SymbolId> {
        let statements = self.function.statements.iter();
        let pairs = statements.filter_map(|statement| match statement {
            Statement::SineCosine { sine, cosine, .. } => Some([*sine, *cosine]),
            _ => None,
        });
        pairs.flatten()
    }

    /// Says which of them nobody reads.
    pub(in crate::emit) fn leave_unnamed(&self, symbols: Vec<SymbolId>) {
        self.unnamed.get_or_init(|| symbols);
    }

    /// Whether nobody reads a sine or a cosine.
    pub(in crate::emit) fn is_unnamed(&self, symbol: SymbolId) -> bool {
        self.unnamed.get().is_some_and(|it| it.contains(&symbol))
    }

    /// Whether somebody reads what a statement of a path finds.
    pub(in crate::emit) fn is_wanted(&self, symbol: SymbolId) -> bool {
        self.module.has_enclosure(symbol) || self.is_read(symbol)
    }

    /// What the function reads.
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
            if self.module.span_part(symbol).is_some() {
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
