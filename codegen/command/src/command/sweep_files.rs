//! Announces the files of `sweep` before its work, and chooses the format of its table.

use std::path::{Path, PathBuf};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;

use super::description::outputs_besides;
use super::solve_files::{distinct, folder};
use super::{Problem, in_folder};
use crate::arguments::Sweep;
use crate::output::{Output, Signature};
use crate::report::picture;
use crate::sweep::{Quantity, SIGNATURE, Sets};

/// Help for a part that an interrupted run has left.
pub const CSV_LEFT: &str = "continue it with `--resume`, or replace it with `--force`";
#[cfg(feature = "parquet")]
pub const PARQUET_LEFT: &str = "it is a Parquet file of its first sets, which cannot be continued: rename it, or replace it with `--force`";

/// File format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    Csv,
    #[cfg(feature = "parquet")]
    Parquet,
}

/// Function that returns a file format, or the reason that this build does not have it.
type Available = fn() -> Result<TableFormat, Problem>;

/// File formats by the extensions of their files.
const FORMATS: [(&str, Available); 2] = [("csv", || Ok(TableFormat::Csv)), ("parquet", parquet)];

impl TableFormat {
    /// Returns the format that the arguments request.
    ///
    /// # Errors
    /// The extension of the file is unknown, the format is left out, or its files cannot be continued.
    pub fn of(arguments: &Sweep) -> Result<TableFormat, Problem> {
        let Some(path) = &arguments.output else {
            return Ok(TableFormat::Csv);
        };
        let extension = path.extension().unwrap_or_default();
        let known = FORMATS.iter();
        let mut known = known.filter(|(name, _)| extension.eq_ignore_ascii_case(name));
        let Some((_, format)) = known.next() else {
            return Err(Problem(format!(
                "error: cannot write `{}`: expected the ending `.csv` or `.parquet`\n  = help: name a file that ends so, or pass `--csv` for a table with any name",
                path.display()
            )));
        };
        let format = format()?;
        match format != TableFormat::Csv && arguments.resume {
            true => Err(Problem(format!(
                "error: `--resume` cannot continue `{}`, a Parquet file\n  = help: leave out `--resume`, or write a table that can be continued: `-o {}`",
                path.display(),
                path.with_extension("csv").display()
            ))),
            false => Ok(format),
        }
    }

    fn signature(self) -> Signature {
        match self {
            TableFormat::Csv => SIGNATURE,
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => crate::sweep::PARQUET_SIGNATURE,
        }
    }
}

#[cfg(feature = "parquet")]
fn parquet() -> Result<TableFormat, Problem> {
    Ok(TableFormat::Parquet)
}

#[cfg(not(feature = "parquet"))]
fn parquet() -> Result<TableFormat, Problem> {
    Err(super::left_out::refusal("parquet", "writes Parquet files"))
}

/// True if the table goes to stdout.
pub fn is_stdout(arguments: &Sweep) -> bool {
    arguments.csv.as_deref() == Some(Path::new("-"))
}

/// Files of a sweep.
pub struct Files {
    /// Table; `None` if it goes to stdout.
    pub table: Option<Output>,
    /// Path of the table.
    pub path: Option<PathBuf>,
    /// Picture of each quantity; empty without pictures.
    pub pictures: Vec<Output>,
}

impl Files {
    /// Announces the files.
    ///
    /// # Errors
    /// A file cannot be written, or options contradict.
    pub fn new(
        arguments: &Sweep,
        format: TableFormat,
        source: &Source,
        derived: &Derived,
        sets: &Sets,
        quantities: &[Quantity],
    ) -> Result<Files, Problem> {
        let (file, rows) = (&arguments.described.file, arguments.rows.as_deref());
        let mut outputs = outputs_besides(file, source, rows, arguments.force);
        let is_stdout = is_stdout(arguments);
        if is_stdout && arguments.resume {
            return Err(Problem(
                "error: `--resume` continues a file, and `--csv -` is stdout\n  = help: name a file with `--csv`".to_string(),
            ));
        }
        let default = folder(&derived.system);
        let named = arguments.output.as_ref().or(arguments.csv.as_ref());
        let path = named.cloned().unwrap_or_else(|| default.join("sweep.csv"));
        let (table, path) = match is_stdout {
            true => (None, None),
            false => {
                let table = outputs.file(&path, format.signature())?;
                (Some(table), Some(path))
            }
        };
        let folder = arguments.plot.clone();
        let folder = folder.or(named.is_none().then_some(default));
        let mut pictures = Vec::new();
        if let (Some(folder), true) = (folder, sets.varied().len() <= 2) {
            for name in distinct(quantities.iter().map(|it| it.name.as_str())) {
                let path = in_folder(&folder, &format!("sweep_{name}.svg"))?;
                pictures.push(outputs.file(&path, picture::SIGNATURE)?);
            }
        }
        Ok(Files {
            table,
            path,
            pictures,
        })
    }
}
