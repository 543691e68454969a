//! Tables as other programs write them: each of these files is read, or the error has line and column.

mod faults;
mod written;

use linkwright_codegen::stages::columns::{Columns, Decimal, Delimiter, Encoding, Header, Known};

use written::readable;

fn is_same(one: f64, other: f64) -> bool {
    one == other || (one.is_nan() && other.is_nan())
}

#[test]
fn tables_of_other_programs_are_read() {
    let files = readable();
    assert!(files.len() >= 30, "{}", files.len());
    for wanted in &files {
        let origin = wanted.origin;
        let table = Columns::read(&wanted.bytes, Known::default());
        let table = table.unwrap_or_else(|error| panic!("{origin}: {error:?}"));
        let names: Vec<&str> = table.columns.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, wanted.names, "{origin}");
        let units = table
            .columns
            .iter()
            .map(|it| it.unit.as_deref().unwrap_or(""));
        assert_eq!(units.collect::<Vec<_>>(), wanted.units, "{origin}");
        assert_eq!(table.rows, wanted.rows.len(), "{origin}");
        for (row, expected) in wanted.rows.iter().enumerate() {
            for (column, expected) in table.columns.iter().zip(*expected) {
                let value = column.values[row].unwrap_or(f64::NAN);
                assert!(
                    is_same(value, *expected),
                    "{origin}: {} in row {row} is {value}",
                    column.name
                );
            }
        }
        assert_eq!(table.reading(), wanted.reading, "{origin}");
    }
    println!("{} files are read", files.len());
}

/// A single column is a table only where the caller expects one, and several columns are then found as elsewhere.
#[test]
fn a_single_column_is_read_on_request() {
    let read = |text: &str, may_be_single| {
        let known = Known {
            may_be_single,
            ..Known::default()
        };
        Columns::read(text.as_bytes(), known)
    };
    let text = "rod (mm)\n100\n150.5\n";
    assert!(read(text, false).is_err());
    let table = read(text, true).expect("a table");
    assert_eq!(table.columns.len(), 1);
    assert_eq!(table.columns[0].unit.as_deref(), Some("mm"));
    assert_eq!(table.columns[0].values, [Some(100.0), Some(150.5)]);
    for text in ["a,b\n1,2\n", "a;b\n1,5;2\n2;3\n", "a b\n1 2\n"] {
        assert_eq!(read(text, true), read(text, false), "{text}");
    }
    let refused = read("rod\nlong\n", true).expect_err("no numbers");
    assert!(refused.faults[0].message.ends_with("is a row of numbers"));
}

/// Options decide between two possible readings.
#[test]
fn options_overrule_what_is_found_out() {
    let read = |text: &str, delimiter, decimal| {
        let known = Known {
            delimiter,
            decimal,
            ..Known::default()
        };
        Columns::read(text.as_bytes(), known).expect("a table")
    };
    let text = "t,x y\n0,1 2\n1,2 3\n";
    let spaces = read(text, Some(Delimiter::Spaces), Some(Decimal::Comma));
    assert_eq!(spaces.columns[0].values, [Some(0.1), Some(1.2)]);
    assert_eq!(spaces.columns[0].name, "t,x");
    // Three digits behind a comma are decimals if semicolons separate the cells, and the reading says so.
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

/// Random numbers are read equally in every dialect.
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
            let table = Columns::read(text.as_bytes(), Known::default()).expect("a table");
            assert_eq!(table.rows, 200);
            for (place, value) in values.iter().enumerate() {
                assert_eq!(
                    table.columns[place % 3].values[place / 3],
                    Some(*value),
                    "{delimiter:?} {decimal}"
                );
            }
        }
    }
}
