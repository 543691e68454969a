//! Names of rows and coordinates' derivatives in generated code and output.

use crate::joint::Row;
use crate::model::Joint;

/// `p_x` for the row x of joint P; the joint's own name where it has only one row.
pub(super) fn row_name(joint: &Joint, row: &Row) -> String {
    match row.component {
        "" => joint.slug.clone(),
        component => format!("{}_{component}", joint.slug),
    }
}
