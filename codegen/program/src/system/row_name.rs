//! Names of rows in generated code and output.

use std::collections::HashSet;

use crate::joint::Row;
use crate::model::Joint;

/// The names of the rows so far.
#[derive(Debug, Default)]
pub(super) struct RowNames {
    taken: HashSet<String>,
}

impl RowNames {
    /// `p_x` for the row x of joint P; the joint's own name where it has only one row. Where one of the names is taken already, by
    /// a joint `p_x` for example, all rows of the joint are numbered: `p_2_x`.
    pub(super) fn of(&mut self, joint: &Joint, rows: &[Row]) -> Vec<String> {
        let named = |base: &str| -> Vec<String> {
            let name = |row: &Row| match row.component {
                "" => base.to_string(),
                component => format!("{base}_{component}"),
            };
            rows.iter().map(name).collect()
        };
        let mut names = named(&joint.slug);
        let mut number = 2;
        while names.iter().any(|name| self.taken.contains(name)) {
            names = named(&format!("{}_{number}", joint.slug));
            number += 1;
        }
        self.taken.extend(names.iter().cloned());
        names
    }
}
