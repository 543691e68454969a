//! What everything of a mechanism is called in C, and how its numbers and values are written.

use super::comment::inert;
use super::words::identifier;
use crate::emit::module::Module;
use crate::emit::module::scope::{Location, Scope};
use crate::emit::rust::type_name;
use crate::emit::scalar::Scalar;
use crate::expr::SymbolId;

/// A module that is written in C.
pub(super) struct Printer<'a> {
    pub module: &'a Module<'a>,
    /// What functions begin with: `four_bar`, or `excavator_motions_dig`.
    pub prefix: String,
    /// What types begin with: `FourBar`, or `ExcavatorMotionsDig`.
    pub type_prefix: String,
    /// What functions of this file alone begin with: nothing, or the motion and an underscore.
    pub own: String,
}

impl<'a> Printer<'a> {
    pub(super) fn new(module: &'a Module<'a>) -> Printer<'a> {
        let mechanism = &module.system.mechanism;
        let name = &mechanism.name;
        let (prefix, own) = match &mechanism.motion {
            None => (name.clone(), String::new()),
            Some(motion) => (
                format!("{name}_{}", motion.name),
                format!("{}_", motion.name),
            ),
        };
        Printer {
            module,
            type_prefix: type_name(&prefix),
            prefix,
            own,
        }
    }

    /// `double` or `float`.
    pub(super) fn real(&self) -> &'static str {
        match self.module.scalar {
            Scalar::F64 => "double",
            Scalar::F32 => "float",
        }
    }

    /// What names of functions and literals end in: nothing, or `f`.
    pub(super) fn suffix(&self) -> &'static str {
        match self.module.scalar {
            Scalar::F64 => "",
            Scalar::F32 => "f",
        }
    }

    /// Something of the runtime: `linkwright_exceeds_rounding`, or `linkwrightf_exceeds_rounding`.
    pub(super) fn runtime(&self, name: &str) -> String {
        format!("linkwright{}_{name}", self.suffix())
    }

    /// A type of the mechanism: `FourBarFrame`.
    pub(super) fn type_of(&self, name: &str) -> String {
        format!("{}{name}", self.type_prefix)
    }

    /// A function or a constant of the mechanism: `four_bar_advance`.
    pub(super) fn function(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix)
    }

    /// A constant that other files see: `FOUR_BAR_DESIGN`.
    pub(super) fn constant(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix.to_uppercase())
    }

    /// A function of this file alone: `solve_loop_c`.
    pub(super) fn own(&self, name: &str) -> String {
        identifier(&format!("{}{name}", self.own))
    }

    /// A constant of this file alone: `RATIO_25_OVER_3`.
    pub(super) fn own_constant(&self, name: &str) -> String {
        format!("{}{name}", self.own.to_uppercase())
    }

    /// A number as a literal.
    pub(super) fn number(&self, value: f64) -> String {
        let digits = self.module.scalar.digits(value);
        let sign = if value < 0.0 { "-" } else { "" };
        format!("{sign}{digits}{}", self.suffix())
    }

    /// Declaration of a constant array of these numbers.
    pub(super) fn array(&self, name: &str, values: &[String]) -> String {
        let (real, count) = (self.real(), values.len());
        format!("const {real} {name}[{count}] = {{{}}};", values.join(", "))
    }

    /// A field of a frame.
    pub(super) fn field(&self, symbol: SymbolId, frame: &str) -> String {
        let component = self.module.component(symbol);
        match component.filter(|_| self.module.holds_coordinates()) {
            Some(component) => {
                let name = identifier(component.name);
                format!("{frame}->{}.{name}", component.vector)
            }
            None => format!("{frame}->{}", self.field_name(symbol)),
        }
    }

    /// The name of a field that is none of the coordinates.
    pub(super) fn field_name(&self, symbol: SymbolId) -> String {
        identifier(self.module.own_field(symbol))
    }

    /// How a variable is read.
    pub(super) fn symbol(&self, symbol: SymbolId, scope: &Scope<'_>) -> String {
        match scope.locate(symbol) {
            Location::Local(name) => identifier(&name),
            Location::Sign(branch) => {
                format!("({})branches->{}", self.real(), identifier(branch))
            }
            Location::TimeWindow(part) => format!("window->{part}"),
            Location::Field(symbol) => self.field(symbol, "at"),
            Location::Last(symbol) => self.field(symbol, "last"),
            Location::LastTime => "last->t".to_string(),
            Location::Coordinate(component) => {
                format!("{}->{}", component.vector, identifier(component.name))
            }
            Location::Parameter(name) => format!("parameters->{}", identifier(&name)),
            Location::Input {
                name,
                level,
                before,
            } => {
                let inputs = if before { "before" } else { "inputs" };
                format!("{inputs}->{}.{level}", identifier(&name))
            }
        }
    }

    /// A label in a comment beside code.
    pub(super) fn beside(&self, text: &str) -> String {
        format!("/* {} */", inert(text))
    }
}
