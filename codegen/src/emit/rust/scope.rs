//! Spells the places of values in Rust.

use super::names::identifier;
use crate::emit::module::scope::{Location, Scope};
use crate::expr::SymbolId;

impl Scope<'_> {
    /// Returns the code that reads a variable.
    pub(super) fn read(&self, symbol: SymbolId) -> String {
        match self.locate(symbol) {
            Location::Local(name) => identifier(&name),
            Location::Sign(branch) => {
                let sign = if self.is_in_lanes() {
                    ""
                } else {
                    ".sign::<Scalar>()"
                };
                format!("branches.{}{sign}", identifier(branch))
            }
            Location::TimeWindow(part) => format!("window.{}", identifier(part)),
            Location::Field(symbol) => self.module.field(symbol, "at"),
            Location::Last(symbol) => self.module.field(symbol, "last"),
            Location::LastTime => "last.t".to_string(),
            Location::Coordinate(component) => {
                format!("{}.{}", component.vector, identifier(component.name))
            }
            Location::Parameter(name) => format!("parameters.{}", identifier(&name)),
            Location::Input {
                name,
                level,
                before,
            } => {
                let inputs = if before { "before" } else { "inputs" };
                format!("{inputs}.{}.{level}", identifier(&name))
            }
        }
    }
}
