//! Writes methods that return stored fields of a frame.

use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::Module;
use crate::emit::module::accessors::{Accessor, Shape};
use crate::program::Found;

impl Code {
    /// Adds a method for each accessor.
    pub(super) fn accessors(
        &mut self,
        all: impl IntoIterator<Item = Accessor>,
        module: &Module<'_>,
    ) {
        for accessor in all {
            self.accessor(accessor, module);
        }
    }

    fn accessor(&mut self, accessor: Accessor, module: &Module<'_>) {
        let shape = accessor.shape;
        let value = |found: &Found| match found {
            Found::Field(symbol) => module.field(*symbol, "self"),
            Found::Constant(value) => module.number(*value),
        };
        let levels = accessor.levels.iter().map(|level| {
            let values = level.iter().map(value);
            let names = module
                .system
                .coordinates
                .iter()
                .map(|it| identifier(&it.name));
            match shape {
                Shape::Number => values.collect(),
                Shape::Sensitivity => {
                    let fields = names
                        .zip(values)
                        .map(|(name, value)| format!("{name}: {value}"));
                    format!(
                        "Coordinates {{ {} }}",
                        fields.collect::<Vec<_>>().join(", ")
                    )
                }
                _ => format!("[{}]", values.collect::<Vec<_>>().join(", ")),
            }
        });
        let kind = match shape {
            Shape::Number => "Scalar",
            Shape::Pair => "[Scalar; 2]",
            Shape::PointMotion => "PointMotion",
            Shape::PointSensitivity => "PointSensitivity",
            Shape::Sensitivity => "Sensitivity",
        };
        let mut statements = Code::default();
        match shape {
            Shape::Number | Shape::Pair => levels.for_each(|it| statements.line(it)),
            _ => statements.record(kind, levels),
        }
        let head = format!("pub fn {}(&self) -> {kind}", identifier(&accessor.name));
        self.function(accessor.docs, [], &head, statements);
    }

    /// Adds a structure with the levels that exist of position, velocity and acceleration.
    pub(super) fn record(&mut self, kind: &str, levels: impl IntoIterator<Item = String>) {
        self.open(format!("{kind} {{"));
        for (name, value) in ["position", "velocity", "acceleration"].iter().zip(levels) {
            self.line(format!("{name}: {value},"));
        }
        self.close("}");
    }
}
