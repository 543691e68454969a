//! Names what a caller gives beside a table, so that messages propose what the user can write.

/// Names of arguments in messages.
#[derive(Clone, Copy, Debug)]
pub struct ArgumentNames {
    /// Argument that gives the quantity of a column.
    pub column: &'static str,
    /// That argument with its value, for a column `COLUMN` that measures `QUANTITY`.
    pub quantity: &'static str,
    /// Argument that gives units.
    pub unit: &'static str,
    /// Argument that leaves columns out.
    pub skip: &'static str,
    /// Argument that names the column of times.
    pub time: &'static str,
}
