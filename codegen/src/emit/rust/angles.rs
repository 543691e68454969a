//! Prints two angles that do not depend on each other in one call, which computes them by vectors.

use std::collections::HashMap;

use crate::emit::code::Code;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;
use crate::program::Statement;

/// Places of two angles in the list of statements that are printed together, by the place of the first one.
pub(super) type JoinedAngles = HashMap<usize, [usize; 2]>;

impl Scope<'_> {
    /// Returns the angles that are printed together: two, if sine and cosine of the second are known before the first.
    pub(super) fn joined_angles(&self) -> JoinedAngles {
        let mut joined = JoinedAngles::new();
        // In lanes, each angle is an array already.
        if self.is_in_lanes() {
            return joined;
        }
        let graph = &self.module.pool.graph;
        let mut first = None;
        // What the statements from the first angle on compute.
        let mut later: Vec<SymbolId> = Vec::new();
        for (place, statement) in self.function.statements.iter().enumerate() {
            if matches!(statement, Statement::Angle { .. }) {
                let values = statement.values().into_iter();
                let mut read = values.flat_map(|value| graph.symbols(value));
                let earlier = first.take().filter(|_| !read.any(|it| later.contains(it)));
                match earlier {
                    Some(earlier) => {
                        joined.insert(earlier, [earlier, place]);
                    }
                    None => first = Some(place),
                }
                later.clear();
            }
            later.extend(statement.targets());
        }
        joined
    }

    /// Writes the angles of two statements.
    pub(super) fn two_angles(&self, places: &[usize; 2], code: &mut Code) {
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
        code.open(format!("[{at}] = two_angles_near("));
        for list in [sines, cosines, near] {
            code.line(format!("[{list}],"));
        }
        code.close(");");
    }
}
