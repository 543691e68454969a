//! Reads files back, and compares them with CSV.

use std::fs::{self, File};
use std::path::PathBuf;

use linkwright_codegen::Source;
use linkwright_solver::{Interpreted, Observable};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::*;
use crate::sweep::{CsvCells, Grid, Range, Sets, Sweep, Table, quantities};

/// A four-bar that some of its couplers do not close.
const LIFT: &str = "mechanism lift {
    param L3 = 120mm;
    param set = 0;
    point A = (0, 0), D = (100mm, 0);
    body crank   at (0, 0, 40deg)       { A: (0, 0), B: (40mm, 0) }
    body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (L3, 0) }
    body rocker  at D turned 57deg      { D, C: (80mm, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = 40deg + 0*set + 3*t;
}";

/// Number of rows of a row group.
const ROWS: usize = 7;

/// File in memory of which each end is overwritten, and the files that an interruption would leave.
#[derive(Default)]
struct Growing {
    bytes: Vec<u8>,
    left: Vec<Vec<u8>>,
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bytes.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Folder that is deleted at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let name = format!("linkwright-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("a folder");
        Folder(folder)
    }

    fn reader(&self, bytes: &[u8]) -> SerializedFileReader<File> {
        let path = self.0.join("table.parquet");
        fs::write(&path, bytes).expect("written");
        let file = File::open(path).expect("the file");
        SerializedFileReader::new(file).expect("a Parquet file")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn rows(reader: &SerializedFileReader<File>) -> Vec<Vec<(String, Field)>> {
    let rows = reader.get_row_iter(None).expect("rows");
    rows.map(|row| row.expect("a row").into_columns()).collect()
}

/// Cell of CSV as a field.
fn field_of(text: &str, kind: Kind) -> Field {
    let number = || text.parse().expect("a number");
    match (text, kind) {
        ("", Kind::NumberOrNone | Kind::Words) => Field::Null,
        (_, Kind::Whole) => Field::Long(text.parse().expect("a whole number")),
        (_, Kind::Number | Kind::NumberOrNone) => Field::Double(number()),
        (text, Kind::Words) => Field::Str(text.to_string()),
    }
}

/// Equality of bits.
fn same(one: &Field, other: &Field) -> bool {
    match (one, other) {
        (Field::Double(one), Field::Double(other)) => one.to_bits() == other.to_bits(),
        _ => one == other,
    }
}

#[test]
fn cells_are_those_of_csv_bit_by_bit() {
    let read = linkwright_codegen::read(&Source::new("lift.mech", LIFT)).expect("no errors");
    let derived = &read.motions[0];
    let blocks = Interpreted::new(derived).expect("the equations determine the motion");
    let ranges = ["L3=50mm..150mm:23", "set=-0.0..1:2"];
    let ranges = ranges.map(|it| Range::read(derived, "--vary", it).expect("a range"));
    let sets = Sets::Grid(Grid::new(ranges.into()).expect("few sets"));
    let quantities = quantities(derived, &["phi_rocker".to_string(), "C_vx".to_string()]);
    let quantities = quantities.expect("known names");
    let observables: Vec<Observable> = quantities.iter().map(|it| it.observable).collect();
    let times = [0.0, 0.2, 0.4, 0.6];
    let folder = Folder::new("parquet");
    for has_instants in [false, true] {
        let table = Table::new(sets.varied(), &quantities, &times, &blocks, has_instants);
        let columns = table.columns();
        let (mut text, mut growing) = (Vec::new(), Growing::default());
        let mut cells = CsvCells::new(&mut text);
        let end = |growing: &mut &mut Growing, end: &[u8]| {
            let file = [&growing.bytes, end].concat();
            growing.left.push(file);
            Ok(())
        };
        let mut written =
            ParquetRows::with_groups(&columns, &mut growing, end, ROWS).expect("begun");
        let sweep = Sweep::new(&blocks, &sets, &times, &observables, 1).expect("no laws");
        let solved = sweep.solve(0, |solved| {
            let extremes = table.extremes(&solved);
            table.write(&solved, &extremes, &mut cells)?;
            table.write(&solved, &extremes, &mut written)
        });
        solved.and_then(|()| cells.flush()).expect("written");
        written.finish().expect("an end");
        drop(cells);

        let reader = folder.reader(&growing.bytes);
        let read_back = rows(&reader);
        let mut csv = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(text.as_slice());
        let expected: Vec<csv::StringRecord> = csv.records().map(|it| it.expect("a row")).collect();
        assert_eq!(read_back.len(), expected.len());
        let (mut numbers, mut empty, mut words) = (0, 0, 0);
        for (found, expected) in read_back.iter().zip(&expected) {
            assert_eq!(found.len(), columns.len());
            for ((_, found), (column, text)) in found.iter().zip(columns.iter().zip(expected)) {
                let expected = field_of(text, column.kind);
                assert!(same(found, &expected), "{}: {found:?} {text}", column.name);
                match found {
                    Field::Double(_) => numbers += 1,
                    Field::Null => empty += 1,
                    Field::Str(_) => words += 1,
                    _ => {}
                }
            }
        }
        assert!(
            numbers > 150 && empty > 100 && words > 3,
            "{numbers} {empty} {words}"
        );
        // A parameter has the name of the first column.
        let names: Vec<&str> = read_back[0].iter().map(|it| it.0.as_str()).collect();
        assert_eq!(names[..3], ["set", "L3", "set_2"]);
        assert_eq!(names.last(), Some(&"failure_t"));
        let file = reader.metadata().file_metadata();
        let pairs = file.key_value_metadata().expect("units");
        let units = pairs[0].value.as_deref().unwrap_or_default();
        let units: serde_json::Value = serde_json::from_str(units).expect("JSON");
        let column = if has_instants { "C_vx" } else { "C_vx_max" };
        let found_units = ["L3", column, "failure_t"].map(|it| units[it].as_str());
        assert_eq!(found_units, [Some("mm"), Some("m/s"), Some("s")]);
        assert!(units["set"].is_null() && pairs[0].key == UNITS);

        // After each row group, an interruption leaves the rows of all groups so far.
        let groups = read_back.len().div_ceil(ROWS);
        assert_eq!(reader.metadata().num_row_groups(), groups);
        assert_eq!(growing.left.len(), groups + 1);
        for (group, left) in growing.left.iter().enumerate() {
            let count = read_back.len().min(group * ROWS);
            assert_eq!(rows(&folder.reader(left)), read_back[..count]);
            assert!(left[MAGIC.len()..].starts_with(MARK));
        }
    }
}

#[test]
fn cells_belong_to_their_columns() {
    let column = |kind| Column {
        name: "x".to_string(),
        unit: String::new(),
        kind,
    };
    let columns = [column(Kind::Whole), column(Kind::Number)];
    let begun = || ParquetRows::new(&columns, Vec::new(), |_, _| Ok(())).expect("begun");
    assert!(begun().number(Some(1.0)).is_err());
    assert!(begun().words("word").is_err());
    let mut rows = begun();
    rows.whole(1).expect("its column");
    assert!(rows.number(None).is_err());
    let mut rows = begun();
    rows.whole(1).expect("its column");
    assert!(rows.end().is_err(), "a cell is missing");
}
