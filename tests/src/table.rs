//! Reads the columns of a CSV file of numbers by name.

use std::fs;

use crate::files;

/// Numbers in named columns.
#[derive(Clone, Debug)]
pub struct Table {
    /// The names of the columns.
    pub names: Vec<String>,
    /// The rows, each with one number per column.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// Table `tests/data/<file>`.
    ///
    /// # Panics
    /// If the file is missing, a cell is not a number or a row has another length than the header.
    pub fn read(file: &str) -> Table {
        let path = files::package("data").join(file);
        let text =
            fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut lines = text.lines();
        let header = lines.next().expect("a header");
        let names: Vec<String> = header.split(',').map(str::to_string).collect();
        let rows: Vec<Vec<f64>> = lines
            .map(|line| {
                line.split(',')
                    .map(|cell| cell.parse().expect("a number"))
                    .collect()
            })
            .collect();
        assert!(
            !rows.is_empty() && rows.iter().all(|row: &Vec<f64>| row.len() == names.len()),
            "{file} is ragged"
        );
        Table { names, rows }
    }

    /// The index of a column.
    ///
    /// # Panics
    /// If no column has this name.
    pub fn column(&self, name: &str) -> usize {
        self.names
            .iter()
            .position(|it| it == name)
            .unwrap_or_else(|| panic!("no column {name}"))
    }

    /// The largest absolute value in a column.
    pub fn magnitude(&self, column: usize) -> f64 {
        self.rows
            .iter()
            .map(|row| row[column].abs())
            .fold(0.0, f64::max)
    }
}
