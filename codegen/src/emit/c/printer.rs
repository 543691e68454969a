//! Names everything of a mechanism in C, and prints its numbers and variables.

use super::comment::inert;
use super::words::identifier;
use crate::emit::module::Module;
use crate::emit::module::scope::{Location, Scope};
use crate::emit::rust::type_name;
use crate::emit::scalar::Scalar;
use crate::expr::SymbolId;

/// Module with its prefixes of names in C.
pub(super) struct Printer<'a> {
    pub module: &'a Module<'a>,
    /// Prefix of functions: `four_bar` or `excavator_motions_dig`.
    pub prefix: String,
    /// Prefix of types: `FourBar` or `ExcavatorMotionsDig`.
    pub type_prefix: String,
    /// Prefix of static functions: the motion with an underscore; empty for a mechanism without motions.
    pub own: String,
}

/// Returns the value of one lane.
pub(super) fn in_lane(values: &str) -> String {
    format!("{values}[lane]")
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

    /// Suffix of literals and function names: empty or `f`.
    pub(super) fn suffix(&self) -> &'static str {
        match self.module.scalar {
            Scalar::F64 => "",
            Scalar::F32 => "f",
        }
    }

    /// Name in the runtime: `linkwright_exceeds_rounding` or `linkwrightf_exceeds_rounding`.
    pub(super) fn runtime(&self, name: &str) -> String {
        format!("linkwright{}_{name}", self.suffix())
    }

    /// Type of the mechanism: `FourBarFrame`.
    pub(super) fn type_of(&self, name: &str) -> String {
        format!("{}{name}", self.type_prefix)
    }

    /// Public function of the mechanism: `four_bar_advance`.
    pub(super) fn function(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix)
    }

    /// Public constant: `FOUR_BAR_DESIGN`.
    pub(super) fn constant(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix.to_uppercase())
    }

    /// Static function: `solve_loop_c`.
    pub(super) fn own(&self, name: &str) -> String {
        identifier(&format!("{}{name}", self.own))
    }

    /// Static constant: `RATIO_25_OVER_3`.
    pub(super) fn own_constant(&self, name: &str) -> String {
        format!("{}{name}", self.own.to_uppercase())
    }

    /// Returns a number as a literal.
    pub(super) fn number(&self, value: f64) -> String {
        let digits = self.module.scalar.digits(value);
        let sign = if value < 0.0 { "-" } else { "" };
        format!("{sign}{digits}{}", self.suffix())
    }

    /// Declaration of a constant array with these values.
    pub(super) fn array(&self, name: &str, values: &[String]) -> String {
        let (real, count) = (self.real(), values.len());
        format!("const {real} {name}[{count}] = {{{}}};", values.join(", "))
    }

    /// Returns the access to a field of a frame.
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

    /// Name of a field that is not a coordinate.
    pub(super) fn field_name(&self, symbol: SymbolId) -> String {
        identifier(self.module.own_field(symbol))
    }

    /// Returns the access to a variable in a function; in lanes, to that of the lane.
    pub(super) fn symbol(&self, symbol: SymbolId, scope: &Scope<'_>) -> String {
        let location = scope.locate(symbol);
        let is_local = matches!(location, Location::Local(_));
        let named = self.located(location);
        match scope.is_in_lanes() && (!is_local || scope.is_shared(symbol)) {
            true => in_lane(&named),
            false => named,
        }
    }

    /// Returns the access to a location; in lanes, to the values of all lanes.
    fn located(&self, location: Location<'_>) -> String {
        match location {
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

    /// Returns a remark as a comment at the end of a line.
    pub(super) fn beside(&self, text: &str) -> String {
        format!("/* {} */", inert(text))
    }
}
