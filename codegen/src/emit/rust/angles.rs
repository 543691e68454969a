//! Prints angles that do not depend on each other as arrays, which compilers compute by vectors.

use std::collections::HashMap;

use crate::emit::code::Code;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;
use crate::program::Statement;

/// Places of angles in the list of statements that are printed together, by the place of the last one.
pub(super) type JoinedAngles = HashMap<usize, Vec<usize>>;

impl Scope<'_> {
    /// Returns the angles that are printed together: those before the first statement that reads one of them.
    pub(super) fn joined_angles(&self) -> JoinedAngles {
        let mut joined = JoinedAngles::new();
        // In lanes, each angle is an array already.
        if self.is_in_lanes() {
            return joined;
        }
        let mut open: Vec<(usize, SymbolId)> = Vec::new();
        let mut close = |open: &mut Vec<(usize, SymbolId)>| {
            let places: Vec<usize> = open.drain(..).map(|(place, _)| place).collect();
            if let [_, .., last] = places[..] {
                joined.insert(last, places);
            }
        };
        for (place, statement) in self.function.statements.iter().enumerate() {
            let reads = |symbol: &SymbolId| {
                let graph = &self.module.pool.graph;
                let mut values = statement.values().into_iter();
                values.any(|value| graph.symbols(value).contains(symbol))
            };
            let is_end = match statement {
                Statement::Section(_) | Statement::Newton { .. } | Statement::Factorize => true,
                _ => open.iter().any(|(_, symbol)| reads(symbol)),
            };
            if is_end {
                close(&mut open);
            }
            if let Statement::Angle { target, .. } = statement {
                open.push((place, *target));
            }
        }
        close(&mut open);
        joined
    }

    /// Writes the angles of some statements as one array.
    pub(super) fn angles(&self, places: &[usize], code: &mut Code) {
        let mut columns: [Vec<String>; 4] = Default::default();
        for &place in places {
            let Statement::Angle {
                target,
                sine,
                cosine,
            } = &self.function.statements[place]
            else {
                continue;
            };
            let [at, near] = ["at", "last"].map(|frame| self.module.field(*target, frame));
            let row = [at, self.value(*sine), self.value(*cosine), near];
            for (column, entry) in columns.iter_mut().zip(row) {
                column.push(entry);
            }
        }
        let [at, sines, cosines, near] = columns.map(|column| column.join(", "));
        code.open(format!("[{at}] = angles_near("));
        for list in [sines, cosines, near] {
            code.line(format!("[{list}],"));
        }
        code.close(");");
    }
}
