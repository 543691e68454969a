//! Writes the items of the module in their order, with its numbers and fields.

use std::collections::HashSet;

use super::functions::functions;
use super::names::identifier;
use super::{
    assemblies, block, coordinates, explained, frame, lanes, loads, newton, parameters, path,
    shell, tables, textbook,
};
use crate::emit::code::Code;
use crate::emit::language::Form;
use crate::emit::lines::WIDTH;
use crate::emit::module::Module;
use crate::emit::scalar::Scalar;
use crate::emit::text;
use crate::expr::SymbolId;
use crate::program::LARGEST_TEXTBOOK;

impl Module<'_> {
    /// Returns a finite number in the fewest digits that round-trip, without a type suffix.
    pub(super) fn number(&self, value: f64) -> String {
        let sign = if value < 0.0 { "-" } else { "" };
        format!("{sign}{}", self.scalar.digits(value))
    }

    /// Returns the access to a field of a frame.
    pub(super) fn field(&self, symbol: SymbolId, frame: &str) -> String {
        match self.component(symbol).filter(|_| self.holds_coordinates()) {
            Some(component) => {
                let name = identifier(component.name);
                format!("{frame}.{}.{name}", component.vector)
            }
            None => format!("{frame}.{}", self.field_name(symbol)),
        }
    }

    /// Returns the name of a field that is not a coordinate.
    pub(super) fn field_name(&self, symbol: SymbolId) -> String {
        identifier(self.own_field(symbol))
    }

    /// Writes the items of the module.
    pub(super) fn items(&self, form: Form<'_>, code: &mut Code) {
        let parts: [fn(&Module<'_>, &mut Code); 15] = [
            coordinates::coordinates,
            parameters::structures,
            textbook::functions,
            frame::frame,
            block::branches,
            assemblies::assemblies,
            explained::block_names,
            loads::labels,
            textbook::characteristic_length,
            newton::equations,
            block::functions,
            loads::function,
            shell::mechanism,
            textbook::dense,
            path::path,
        ];
        let mut rest = Code::default();
        parts.iter().for_each(|part| part(self, &mut rest));
        if form.has_lanes {
            lanes::lanes(self, &mut rest);
        }
        // What of the solved view is left out may have been all that needed a constant or a table.
        let mentioned: HashSet<&str> = rest.names().collect();
        let precision = self.precision();
        code.line(format!("use ::linkwright::generated::{precision}::*;"));
        let functions = form.math.map(|path| functions(path, &mentioned));
        functions.into_iter().flatten().for_each(|it| code.line(it));
        self.constants(&mentioned, code);
        tables::tables(self, &mentioned, code);
        code.gap();
        code.append(rest);
    }

    /// Returns the name of the runtime's modules for the scalar.
    pub(super) fn precision(&self) -> &'static str {
        match self.scalar {
            Scalar::F64 => "double",
            Scalar::F32 => "single",
        }
    }

    /// Writes the named constants that the code mentions.
    fn constants(&self, mentioned: &HashSet<&str>, code: &mut Code) {
        let list = self.program.constants.list().iter();
        let mut used = list
            .filter(|constant| mentioned.contains(constant.name.as_str()))
            .peekable();
        if used.peek().is_none() {
            return;
        }
        code.gap();
        code.open("::linkwright::generated::constants! {");
        for constant in used {
            let (name, value) = (identifier(&constant.name), self.number(constant.value));
            let line = format!("{name} = {value},");
            let room = WIDTH.saturating_sub(line.len() + "     // ".len());
            let remark = text::constant(self.pool, self.system, constant, room);
            let remark = remark.map_or(String::new(), |remark| format!(" // {remark}"));
            code.whole(format!("{line}{remark}"));
        }
        code.close("}");
    }
}

/// Attribute with the traits that a structure of so many numbers derives. Derived comparison and printing of thousands of fields would
/// overload the compiler.
pub(super) fn derives(fields: usize) -> &'static str {
    match fields <= LARGEST_TEXTBOOK {
        true => "#[derive(Clone, Copy, Debug, PartialEq)]",
        false => "#[derive(Clone, Copy)]",
    }
}
