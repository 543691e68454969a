//! Tables as other programs write them: each of these files is read, or the error says line and column.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::columns::{Columns, Decimal, Delimiter, Encoding, Header, Known};

/// What is to be read of a file.
struct Wanted {
    /// Where it could be from.
    origin: &'static str,
    bytes: Vec<u8>,
    names: &'static [&'static str],
    units: &'static [&'static str],
    /// Row by row; NaN where a value is missing, or the column has words.
    rows: &'static [&'static [f64]],
    /// How the file is understood, in words.
    reading: &'static str,
}

/// Missing.
const NONE: f64 = f64::NAN;

fn utf16(text: &str, little: bool, marked: bool) -> Vec<u8> {
    let units = marked
        .then_some(0xfeff)
        .into_iter()
        .chain(text.encode_utf16());
    let bytes = |unit: u16| {
        if little {
            unit.to_le_bytes()
        } else {
            unit.to_be_bytes()
        }
    };
    units.flat_map(bytes).collect()
}

fn latin(text: &str) -> Vec<u8> {
    let byte = |it: char| u8::try_from(u32::from(it)).expect("it is in Latin-1");
    text.chars().map(byte).collect()
}

const TX: &[&str] = &["t", "x"];
const NO_UNITS: &[&str] = &["", ""];
const TWO: &[&[f64]] = &[&[0.0, 1.5], &[0.1, 2.5]];

/// Each with a text in UTF-8.
fn plain(
    origin: &'static str,
    text: &str,
    names: &'static [&'static str],
    units: &'static [&'static str],
    rows: &'static [&'static [f64]],
    reading: &'static str,
) -> Wanted {
    Wanted {
        origin,
        bytes: text.as_bytes().to_vec(),
        names,
        units,
        rows,
        reading,
    }
}

const POINTS: &str = "UTF-8, `,` between cells, decimal points, names in line 1";
const COMMAS: &str = "UTF-8, `;` between cells, decimal commas, names in line 1";
const TABS: &str = "UTF-8, tabs between cells, decimal points, names in line 1";

fn readable() -> Vec<Wanted> {
    let mut files = vec![
        plain(
            "pandas",
            "t,x\n0.0,1.5\n0.1,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "pandas with its index",
            ",t,x\n0,0.0,1.5\n1,0.1,2.5\n",
            &["1", "t", "x"],
            &["", "", ""],
            &[&[0.0, 0.0, 1.5], &[1.0, 0.1, 2.5]],
            POINTS,
        ),
        plain(
            "pandas with missing values",
            "t,x,y\n0.0,,1\n0.1,2.5,nan\n",
            &["t", "x", "y"],
            &["", "", ""],
            &[&[0.0, NONE, 1.0], &[0.1, 2.5, NONE]],
            POINTS,
        ),
        plain(
            "Windows line ends",
            "t,x\r\n0,1.5\r\n0.1,2.5\r\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "line ends of old Macs",
            "t,x\r0,1.5\r0.1,2.5\r",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "no line end at the end",
            "t,x\n0,1.5\n0.1,2.5",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "UTF-8 with a byte order mark",
            "\u{feff}t,x\n0,1.5\n0.1,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "a German spreadsheet",
            "t;x\r\n0;1,5\r\n0,1;2,5\r\n",
            TX,
            NO_UNITS,
            TWO,
            COMMAS,
        ),
        plain(
            "semicolons and points",
            "t;x\n0.0;1.5\n0.1;2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `;` between cells, decimal points, names in line 1",
        ),
        plain(
            "quoted decimal commas",
            "\"t\",\"x\"\n\"0\",\"1,5\"\n\"0,1\",\"2,5\"\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal commas, names in line 1",
        ),
        plain(
            "Excel, which announces its separator",
            "sep=;\r\nt;x\r\n0;1.5\r\n0.1;2.5\r\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `;` between cells, decimal points, names in line 2",
        ),
        plain("tabs", "t\tx\n0\t1.5\n0.1\t2.5\n", TX, NO_UNITS, TWO, TABS),
        plain(
            "tabs with decimal commas and an empty cell",
            "t\tx\n0\t1,5\n0,1\t\n",
            TX,
            NO_UNITS,
            &[&[0.0, 1.5], &[0.1, NONE]],
            "UTF-8, tabs between cells, decimal commas, names in line 1",
        ),
        plain(
            "MATLAB, writematrix",
            "t,x\n0,1.5000e+00\n1.0000e-01,2.5000e+00\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "MATLAB, NaN",
            "t,x\n0,NaN\n0.1,2.5\n",
            TX,
            NO_UNITS,
            &[&[0.0, NONE], &[0.1, 2.5]],
            POINTS,
        ),
        plain(
            "MATLAB, save -ascii with names in a comment",
            "% t x\n   0.0000000e+00   1.5000000e+00\n   1.0000000e-01   2.5000000e+00\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, spaces between cells, decimal points, names in the comment in line 1",
        ),
        plain(
            "numpy, savetxt",
            "# t,x\n0.000000000000000000e+00,1.500000000000000000e+00\n1.000000000000000056e-01,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, names in the comment in line 1",
        ),
        plain(
            "Fortran",
            "  t    x\n 0.0D+00 1.5D+00\n 1.0D-01 2.5D+00\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, spaces between cells, decimal points, names in line 1",
        ),
        plain(
            "ADAMS, tabular export",
            "\"Time (sec)\"\t\".arm.K_x (mm)\"\n0.0\t1.5\n0.1\t2.5\n",
            &["Time", ".arm.K_x"],
            &["sec", "mm"],
            TWO,
            TABS,
        ),
        plain(
            "a title above the names",
            "Plot of K\nModel: arm\n\nTime,X\n0,1.5\n0.1,2.5\n",
            &["Time", "X"],
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, names in line 4; 2 lines before them are no part of the table",
        ),
        plain(
            "a data logger with a preamble and units",
            "Device;Logger 7\nSerial;1234\nt;x;phi\ns;mm;deg\n0;1,5;0\n0,1;2,5;90\n",
            &["t", "x", "phi"],
            &["s", "mm", "deg"],
            &[&[0.0, 1.5, 0.0], &[0.1, 2.5, 90.0]],
            "UTF-8, `;` between cells, decimal commas, names in line 3, units in line 4; 2 lines before them are no part of the table",
        ),
        plain(
            "units in brackets",
            "t [s],x [mm]\n0,1.5\n0.1,2.5\n",
            TX,
            &["s", "mm"],
            TWO,
            POINTS,
        ),
        plain(
            "units as the standards want them",
            "t / s,x / mm\n0,1.5\n0.1,2.5\n",
            TX,
            &["s", "mm"],
            TWO,
            POINTS,
        ),
        plain(
            "a line of units in brackets",
            "t,x\n(s),(mm)\n0,1.5\n0.1,2.5\n",
            TX,
            &["s", "mm"],
            TWO,
            "UTF-8, `,` between cells, decimal points, names in line 1, units in line 2",
        ),
        plain(
            "comments between and behind rows",
            "# made by hand\nt,x\n0,1.5 # start\n\n# break\n0.1,2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, names in line 2",
        ),
        plain(
            "a separator at every end",
            "t;x;\n0;1,5;\n0,1;2,5;\n",
            TX,
            NO_UNITS,
            TWO,
            COMMAS,
        ),
        plain(
            "lines of nothing",
            "t,x\n0,1.5\n,\n0.1,2.5\n,,\n"
                .replace(",,\n", ",\n")
                .as_str(),
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "bars",
            "t|x\n0|1.5\n0.1|2.5\n",
            TX,
            NO_UNITS,
            TWO,
            "UTF-8, `|` between cells, decimal points, names in line 1",
        ),
        plain(
            "spaces after commas",
            "t, x\n0, 1.5\n0.1, 2.5\n",
            TX,
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "quotes and separators in names",
            "\"t\",\"x, \"\"left\"\" (mm)\"\n0,1.5\n0.1,2.5\n",
            &["t", "x, \"left\""],
            &["", "mm"],
            TWO,
            POINTS,
        ),
        plain(
            "a line break in a name",
            "t,\"x\nleft\"\n0,1.5\n0.1,2.5\n",
            &["t", "x left"],
            NO_UNITS,
            TWO,
            POINTS,
        ),
        plain(
            "a column of words",
            "t,state,x\n0,run,1.5\n0.1,run,2.5\n",
            &["t", "state", "x"],
            &["", "", ""],
            &[&[0.0, NONE, 1.5], &[0.1, NONE, 2.5]],
            POINTS,
        ),
        plain(
            "a spreadsheet with errors",
            "t,x\n0,1.5\n0.1,#N/A\n",
            TX,
            NO_UNITS,
            &[&[0.0, 1.5], &[0.1, NONE]],
            POINTS,
        ),
        plain(
            "no names at all",
            "0,1.5\n0.1,2.5\n",
            &["1", "2"],
            NO_UNITS,
            TWO,
            "UTF-8, `,` between cells, decimal points, no names, so that columns are called 1, 2, …",
        ),
        plain(
            "a typographic minus",
            "t,x\n0,−1.5\n0.1,2.5\n",
            TX,
            NO_UNITS,
            &[&[0.0, -1.5], &[0.1, 2.5]],
            POINTS,
        ),
    ];
    let german = "t;x [µm]\r\n0;1,5\r\n0,1;2,5\r\n";
    for (origin, bytes, reading) in [
        (
            "UTF-16, little-endian",
            utf16(german, true, true),
            "UTF-16 (little-endian), `;` between cells, decimal commas, names in line 1",
        ),
        (
            "UTF-16, big-endian",
            utf16(german, false, true),
            "UTF-16 (big-endian), `;` between cells, decimal commas, names in line 1",
        ),
        (
            "UTF-16 without a mark",
            utf16(german, true, false),
            "UTF-16 (little-endian), `;` between cells, decimal commas, names in line 1",
        ),
        (
            "Latin-1",
            latin(german),
            "Windows-1252, since it is not UTF-8, `;` between cells, decimal commas, names in line 1",
        ),
    ] {
        files.push(Wanted {
            origin,
            bytes,
            names: TX,
            units: &["", "µm"],
            rows: TWO,
            reading,
        });
    }
    files
}

fn is_same(one: f64, other: f64) -> bool {
    one == other || (one.is_nan() && other.is_nan())
}

#[test]
fn tables_of_other_programs_are_read() {
    let files = readable();
    assert!(files.len() >= 30, "{}", files.len());
    for wanted in &files {
        let origin = wanted.origin;
        let found = Columns::read(&wanted.bytes, Known::default());
        let found = found.unwrap_or_else(|error| panic!("{origin}: {error:?}"));
        let names: Vec<&str> = found.columns.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, wanted.names, "{origin}");
        let units = found
            .columns
            .iter()
            .map(|it| it.unit.as_deref().unwrap_or(""));
        assert_eq!(units.collect::<Vec<_>>(), wanted.units, "{origin}");
        assert_eq!(found.rows, wanted.rows.len(), "{origin}");
        for (row, expected) in wanted.rows.iter().enumerate() {
            for (column, expected) in found.columns.iter().zip(*expected) {
                let value = column.values[row].unwrap_or(f64::NAN);
                assert!(
                    is_same(value, *expected),
                    "{origin}: {} in row {row} is {value}",
                    column.name
                );
            }
        }
        assert_eq!(found.reading(), wanted.reading, "{origin}");
    }
    println!("{} files are read", files.len());
}

/// What stands at the place of each fault, the line and the column, and the message.
fn faults(bytes: &[u8], known: Known) -> Vec<(usize, usize, String)> {
    let refused = Columns::read(bytes, known).expect_err("a fault");
    let source = Source::new("data.csv", refused.text.clone());
    let each = refused.faults.iter().map(|fault| {
        assert!(
            !fault.help.is_empty() && !fault.message.ends_with('.'),
            "{fault:?}"
        );
        let place = source.position(fault.span.start);
        (place.line, place.column, fault.message.clone())
    });
    each.collect()
}

/// What a file is called, its bytes, the line and column of its fault, and what is said of it.
type Faulty<'a> = (&'a str, &'a [u8], (usize, usize), &'a str);

#[test]
fn what_is_wrong_is_said_with_line_and_column() {
    let cases: [Faulty<'_>; 22] = [
        ("empty", b"", (1, 1), "the file is empty"),
        ("blank", b"\n \n", (1, 1), "the file is empty"),
        (
            "prose",
            b"Dear all,\nhere is nothing.\n",
            (1, 1),
            "no line of this file is a row of at least two numbers",
        ),
        (
            "names alone",
            b"t,x\n",
            (1, 1),
            "no line of this file is a row of at least two numbers",
        ),
        (
            "one column",
            b"x\n1\n2\n",
            (1, 1),
            "no line of this file is a row of at least two numbers",
        ),
        ("a word", b"t,x\n0,1\n1,two\n", (3, 3), "`two` is no number"),
        (
            "a word far below",
            &[b"t,x\n".as_slice(), &b"0,1\n".repeat(500), b"1,two\n"].concat(),
            (502, 3),
            "`two` is no number",
        ),
        (
            "a cell too few",
            b"t,x\n0,1\n1\n2,3\n",
            (3, 1),
            "1 cell where the lines above have 2",
        ),
        (
            "a cell too many",
            b"t,x\n0,1\n1,2,3\n",
            (3, 1),
            "3 cells where the lines above have 2",
        ),
        (
            "a decimal comma between commas",
            b"t,x\n0,1\n0,1,5\n",
            (3, 1),
            "3 cells where the lines above have 2",
        ),
        (
            "names too few",
            b"t,x\n0,1,2\n1,2,3\n",
            (1, 1),
            "2 cells above rows of 3: the line before the first row names the columns",
        ),
        (
            "a summary",
            b"t;x\n0;1,5\n1;2,5\nMean;2,0\n",
            (4, 1),
            "`Mean` is no number",
        ),
        (
            "groups of thousands",
            b"t;x\n0;1.234,5\n1;2.345,5\n",
            (2, 3),
            "`1.234,5` has groups of digits, or the other decimal mark",
        ),
        (
            "a unit in a cell",
            b"t,x\n0,1.5\n1,2.5mm\n",
            (3, 3),
            "`2.5mm` has letters after its number",
        ),
        (
            "too large",
            b"t,x\n0,1.5\n1,1e999\n",
            (3, 3),
            "`1e999` is not a finite number",
        ),
        (
            "infinite",
            b"t,x\n0,1.5\n1,inf\n",
            (3, 3),
            "`inf` is no number",
        ),
        (
            "an open quote",
            b"t,x\n0,1.5\n1,\"2.5\n",
            (3, 3),
            "a quote that is never closed",
        ),
        (
            "text behind a quote",
            b"t,x\n0,1.5\n1,\"2\"5\n",
            (3, 6),
            "text after a closing quote",
        ),
        (
            "a workbook",
            b"PK\x03\x04rest",
            (1, 1),
            "the file is a workbook or an archive, no text",
        ),
        (
            "a MAT-file",
            b"MATLAB 5.0 MAT-file, Platform",
            (1, 1),
            "the file is a MAT-file, no text",
        ),
        (
            "zeros",
            b"t,x\n0,1\n1,\0\n",
            (3, 3),
            "a byte of zero, which is no text",
        ),
        (
            "no character",
            b"t,x\n0,1\n1,2 \x81\n",
            (3, 5),
            "the byte 0x81 is no character, neither of UTF-8 nor of Windows-1252",
        ),
    ];
    for (name, bytes, place, message) in cases {
        let found = faults(bytes, Known::default());
        let (line, column, text) = &found[0];
        assert_eq!(
            ((*line, *column), text.as_str()),
            (place, message),
            "{name}: {found:?}"
        );
    }
    let halves = utf16("t,x\n0,1\n", true, true);
    let found = faults(&halves[..halves.len() - 1], Known::default());
    assert_eq!((found[0].0, found[0].1), (2, 4), "{found:?}");
    let lone = [utf16("t,x\n0,", true, true), vec![0x00, 0xd8, 0x31, 0x00]].concat();
    assert_eq!(
        (
            faults(&lone, Known::default())[0].0,
            faults(&lone, Known::default())[0].1
        ),
        (2, 3)
    );
}

#[test]
fn ten_faults_are_listed_at_most() {
    let text = format!("t,x\n0,1\n{}", "1,two\n".repeat(500));
    let known = Known {
        delimiter: Some(Delimiter::Comma),
        decimal: Some(Decimal::Point),
    };
    assert_eq!(faults(text.as_bytes(), known).len(), 10);
    assert_eq!(faults(text.as_bytes(), Known::default()).len(), 10);
    let text = format!("t,x\n{}{}", "0,1\n".repeat(300), "1,two\n".repeat(500));
    let found = faults(text.as_bytes(), known);
    assert_eq!(found.len(), 10);
    assert_eq!((found[0].0, found[9].0), (302, 311));
}

/// What could be read in two ways is read as it is said.
#[test]
fn options_overrule_what_is_found_out() {
    let read = |text: &str, delimiter, decimal| {
        let known = Known { delimiter, decimal };
        Columns::read(text.as_bytes(), known).expect("a table")
    };
    let text = "t,x y\n0,1 2\n1,2 3\n";
    let spaces = read(text, Some(Delimiter::Spaces), Some(Decimal::Comma));
    assert_eq!(spaces.columns[0].values, [Some(0.1), Some(1.2)]);
    assert_eq!(spaces.columns[0].name, "t,x");
    // Three digits behind a comma are decimals where cells are separated by semicolons, and the reading says so.
    let thousands = read("t;x\n0;1,234\n1;2,345\n", None, None);
    assert_eq!(thousands.columns[1].values, [Some(1.234), Some(2.345)]);
    assert!(
        thousands.reading().contains("decimal commas"),
        "{}",
        thousands.reading()
    );
    assert_eq!(
        (thousands.encoding, thousands.header),
        (Encoding::Utf8, Header::Line(1))
    );
}

/// A table of any numbers is the same however it is written.
#[test]
fn numbers_are_the_same_in_every_dialect() {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        f64::from_bits(state)
    };
    let mut values = Vec::new();
    while values.len() < 600 {
        values.extend(Some(next()).filter(|it: &f64| it.is_finite()));
    }
    for (delimiter, decimal) in [
        (',', '.'),
        (';', ','),
        (';', '.'),
        ('\t', ','),
        ('\t', '.'),
        ('|', ','),
        (' ', '.'),
        (' ', ','),
    ] {
        for format in 0..2 {
            let written = |value: &f64| {
                let text = if format == 0 {
                    format!("{value:e}")
                } else {
                    format!("{value:.17e}")
                };
                text.replace('.', &decimal.to_string())
            };
            let mut text = format!("t{delimiter}a{delimiter}b\r\n");
            for row in values.chunks_exact(3) {
                let cells: Vec<String> = row.iter().map(written).collect();
                text += &(cells.join(&delimiter.to_string()) + "\r\n");
            }
            let found = Columns::read(text.as_bytes(), Known::default()).expect("a table");
            assert_eq!(found.rows, 200);
            for (place, value) in values.iter().enumerate() {
                assert_eq!(
                    found.columns[place % 3].values[place / 3],
                    Some(*value),
                    "{delimiter:?} {decimal}"
                );
            }
        }
    }
}
