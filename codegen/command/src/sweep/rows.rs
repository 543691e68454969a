//! Reads the sets of a file: a column for each parameter or input, a row for each set.

use std::path::Path;

use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::columns::{Columns, Fault, Known};
use linkwright_codegen::stages::system::Derived;

use super::sets::Sets;
use super::varied::Varied;
use linkwright_solver::data::{bytes, rendered};

impl Sets {
    /// Reads the sets of the file at `path`.
    ///
    /// # Errors
    /// The printed message: the file cannot be read, a column is not that of a parameter or an input, or a value is missing.
    pub fn read(path: &Path, derived: &Derived) -> Result<Sets, String> {
        let name = path.display().to_string();
        let known_dialect = Known {
            may_be_single: true,
            ..Known::default()
        };
        let columns = Columns::read(&bytes(path)?, known_dialect)
            .map_err(|refused| rendered(&name, &refused.text, &refused.faults))?;
        let fault = |span, message: String, help: String| {
            let fault = Fault {
                span,
                message,
                help,
            };
            rendered(&name, &columns.text, &[fault])
        };
        let mut varied: Vec<Varied> = Vec::with_capacity(columns.columns.len());
        for column in &columns.columns {
            let read = Varied::of_column(derived, &column.name, column.unit.as_deref());
            let read = match read {
                None => {
                    let message = format!("no parameter or input is named `{}`", column.name);
                    return Err(fault(column.span, message, known(derived, &column.name)));
                }
                Some(read) => read.map_err(|message| {
                    let help = "write a unit of its quantity in the header, as in `rod (mm)`";
                    fault(column.span, message, help.to_string())
                })?,
            };
            if varied.iter().any(|it| it.name == read.name) {
                let message = format!("two columns are named `{}`", read.name);
                return Err(fault(column.span, message, "leave out one".to_string()));
            }
            varied.push(read);
        }
        if varied.is_empty() || columns.rows == 0 {
            return Err(format!(
                "error: `{name}` has no sets\n  = help: write a column for each varied parameter or input, and a row for each set"
            ));
        }
        let mut values = Vec::with_capacity(varied.len() * columns.rows);
        for row in 0..columns.rows {
            for column in &columns.columns {
                let value = column.values.get(row).copied().flatten();
                let value = value.filter(|it| it.is_finite());
                values.push(value.ok_or_else(|| {
                    let span = column.spans.get(row).copied().unwrap_or(column.span);
                    let message = format!("`{}` has no number here", column.name);
                    fault(
                        span,
                        message,
                        "write a value, or leave out the row".to_string(),
                    )
                })?);
            }
        }
        Ok(Sets::Rows { varied, values })
    }
}

/// Returns the help for an unknown name.
fn known(derived: &Derived, name: &str) -> String {
    let mechanism = &derived.system.mechanism;
    let parameters = mechanism.parameters.iter().map(|it| it.name.as_str());
    let inputs = mechanism.inputs.iter().map(|it| it.name.as_str());
    let names: Vec<&str> = parameters.chain(inputs).collect();
    match (nearest(name, names.iter().copied()), names.as_slice()) {
        (Some(meant), _) => format!("did you mean `{meant}`?"),
        (None, []) => "declare one in the description: `param rod = 350mm;`".to_string(),
        (None, names) => format!("name the columns after {}", names.join(", ")),
    }
}
