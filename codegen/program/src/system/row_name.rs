//! Names of rows in generated code and output.

use std::collections::HashSet;

use crate::joint::Row;
use crate::model::Joint;

/// Names of the rows so far.
#[derive(Debug, Default)]
pub(super) struct RowNames {
    taken: HashSet<String>,
}

impl RowNames {
    /// Returns `p_x` for the row x of joint P, or the joint's name if it has only one row. If one of these names is taken, by a
    /// joint `p_x` for example, all rows of the joint are numbered: `p_2_x`.
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
