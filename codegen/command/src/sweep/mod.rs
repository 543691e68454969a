//! Solves many sets of parameters and inputs, and tabulates their motions.
//!
//! Sets are made by their index when they are needed, solved in chunks, written and dropped: a sweep of any length takes the same memory. A
//! set has the same row in any chunk, on any number of threads, and after an interruption.

mod cells;
mod comma_separated;
mod continued;
mod definition;
#[cfg(feature = "parquet")]
mod parquet_rows;
mod pictured;
mod rows;
mod run;
mod sets;
mod shown;
mod summary;
mod table;
mod varied;

pub use comma_separated::CsvCells;
pub use continued::{Continuation, continuation};
pub use definition::definition;
#[cfg(feature = "parquet")]
pub use parquet_rows::{PARQUET_SIGNATURE, ParquetRows};
pub use pictured::Pictured;
pub use run::{Solved, Start, Sweep};
pub use sets::{Grid, Samples, Sets};
pub use shown::{Quantity, quantities};
pub use summary::Summary;
pub use table::{SIGNATURE, Table};
pub use varied::{Place, Range};
