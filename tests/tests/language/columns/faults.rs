//! Faulty tables: every fault is reported with line and column.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::columns::{Columns, Decimal, Delimiter, Known};

use super::written::utf16;

/// Faults of a file: line, column and message.
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

/// Name of a file, its bytes, the line and column of its fault, and the message.
type Faulty<'a> = (&'a str, &'a [u8], (usize, usize), &'a str);

#[test]
fn faults_have_line_and_column() {
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
        (
            "a word",
            b"t,x\n0,1\n1,two\n",
            (3, 3),
            "`two` is not a number",
        ),
        (
            "a word far below",
            &[b"t,x\n".as_slice(), &b"0,1\n".repeat(500), b"1,two\n"].concat(),
            (502, 3),
            "`two` is not a number",
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
            "`Mean` is not a number",
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
            "`inf` is not a number",
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
            "the file is a workbook or an archive, not text",
        ),
        (
            "a MAT-file",
            b"MATLAB 5.0 MAT-file, Platform",
            (1, 1),
            "the file is a MAT-file, not text",
        ),
        (
            "zeros",
            b"t,x\n0,1\n1,\0\n",
            (3, 3),
            "a byte of zero, which is not text",
        ),
        (
            "no character",
            b"t,x\n0,1\n1,2 \x81\n",
            (3, 5),
            "the byte 0x81 is not a character of UTF-8 or of Windows-1252",
        ),
    ];
    for (name, bytes, place, message) in cases {
        let reported = faults(bytes, Known::default());
        let (line, column, text) = &reported[0];
        assert_eq!(
            ((*line, *column), text.as_str()),
            (place, message),
            "{name}: {reported:?}"
        );
    }
    let halves = utf16("t,x\n0,1\n", true, true);
    let reported = faults(&halves[..halves.len() - 1], Known::default());
    assert_eq!((reported[0].0, reported[0].1), (2, 4), "{reported:?}");
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
        ..Known::default()
    };
    assert_eq!(faults(text.as_bytes(), known).len(), 10);
    assert_eq!(faults(text.as_bytes(), Known::default()).len(), 10);
    let text = format!("t,x\n{}{}", "0,1\n".repeat(300), "1,two\n".repeat(500));
    let reported = faults(text.as_bytes(), known);
    assert_eq!(reported.len(), 10);
    assert_eq!((reported[0].0, reported[9].0), (302, 311));
}
