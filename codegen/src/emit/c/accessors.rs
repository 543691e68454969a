//! Writes functions that return stored fields of a frame.

use super::points::Offered;
use super::printer::Printer;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::accessors::{Accessor, Shape};
use crate::program::Found;

impl Printer<'_> {
    /// Returns the function of an accessor.
    pub(super) fn accessor(&self, accessor: Accessor) -> Offered {
        let shape = accessor.shape;
        let value = |found: &Found| match found {
            Found::Field(symbol) => self.field(*symbol, "frame"),
            Found::Constant(value) => self.number(*value),
        };
        let real = self.real().to_string();
        let (kind, found) = match shape {
            Shape::Number => (real, String::new()),
            Shape::Pair => ("void".to_string(), format!(", {real} found[2]")),
            Shape::PointMotion => (self.runtime("point_motion"), String::new()),
            Shape::PointSensitivity => (self.type_of("PointSensitivity"), String::new()),
            Shape::Sensitivity => (self.type_of("Sensitivity"), String::new()),
        };
        let is_record = !matches!(shape, Shape::Number | Shape::Pair);
        let mut body = Code::default();
        if is_record {
            body.line(format!("{kind} found;"));
        }
        let names = [".position", ".velocity", ".acceleration"].into_iter();
        for (level, values) in names.zip(&accessor.levels) {
            let level = if is_record { level } else { "" };
            for (place, found) in values.iter().enumerate() {
                let value = value(found);
                body.line(match shape {
                    Shape::Number => format!("return {value};"),
                    Shape::Sensitivity => {
                        let name = &self.module.system.coordinates[place].name;
                        format!("found{level}.{} = {value};", identifier(name))
                    }
                    _ => format!("found{level}[{place}] = {value};"),
                });
            }
        }
        if is_record {
            body.line("return found;");
        }
        if !body.mentions("frame") {
            let unread = std::mem::take(&mut body);
            body.line("(void)frame;");
            body.append(unread);
        }
        Offered {
            lines: accessor.docs,
            declaration: format!(
                "{kind} {}(const {} *frame{found})",
                self.function(&identifier(&accessor.name)),
                self.type_of("Frame")
            ),
            body,
        }
    }
}
