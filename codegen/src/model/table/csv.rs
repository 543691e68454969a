//! The text of a file → the rows of a table: *each line's two cells*, or *what is wrong in which line*.
//!
//! Cells are separated with `,`; what follows a `#` is a comment; empty lines mean nothing; the first line may name the columns.
//! Deliberately unknown here: what the cells measure.

/// Two numbers of one line, as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Row<'a> {
    /// Counted from 1.
    pub line: usize,
    /// Each a sign, if there is one, and a decimal number.
    pub cells: [&'a str; 2],
}

/// A line that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// Counted from 1.
    pub line: usize,
    /// What it is.
    pub message: String,
    /// What to do about it.
    pub help: &'static str,
}

/// Nobody reads more faults of one file than these.
const MOST_FAULTS: usize = 10;

/// The rows of a file in written order.
///
/// # Errors
/// The first lines that are no rows.
pub(super) fn rows(text: &str) -> Result<Vec<Row<'_>>, Vec<Fault>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (mut rows, mut faults) = (Vec::new(), Vec::new());
    let mut is_first = true;
    for (index, line) in text.lines().enumerate() {
        let line_number = index + 1;
        let written = line.split('#').next().unwrap_or(line).trim();
        if written.is_empty() {
            continue;
        }
        let cells: Vec<&str> = written.split(',').map(str::trim).collect();
        let names_columns = is_first && !cells.iter().any(|cell| is_number(cell));
        is_first = false;
        if names_columns {
            continue;
        }
        match row(line_number, &cells) {
            Ok(row) => rows.push(row),
            Err(fault) => faults.push(fault),
        }
        if faults.len() == MOST_FAULTS {
            break;
        }
    }
    if faults.is_empty() {
        Ok(rows)
    } else {
        Err(faults)
    }
}

fn row<'a>(line: usize, cells: &[&'a str]) -> Result<Row<'a>, Fault> {
    let fault = |message: String, help| Fault {
        line,
        message,
        help,
    };
    let &[x, y] = cells else {
        let help = "each line is `X, Y`, with `.` before decimals and `#` before a comment";
        let noun = if cells.len() == 1 { "cell" } else { "cells" };
        let message = format!("{} {noun} where two are wanted", cells.len());
        return Err(fault(message, help));
    };
    for cell in [x, y] {
        if !is_number(cell) {
            let help = "write decimal numbers like `12`, `-0.05` or `1.5e-3`, and their units in the description";
            let message = if cell.is_empty() {
                "an empty cell".to_string()
            } else {
                // A line can be anything, also very long.
                let shown: String = cell.chars().take(40).collect();
                format!("`{}` is no number", shown.escape_debug())
            };
            return Err(fault(message, help));
        }
    }
    Ok(Row {
        line,
        cells: [x, y],
    })
}

/// Whether a cell is a sign, if any, digits with at most one point, and an exponent, if any.
fn is_number(cell: &str) -> bool {
    let unsigned = cell.strip_prefix(['-', '+']).unwrap_or(cell);
    let is_decimal = unsigned
        .chars()
        .all(|it| it.is_ascii_digit() || matches!(it, '.' | 'e' | 'E' | '+' | '-'));
    is_decimal
        && unsigned.starts_with(|it: char| it.is_ascii_digit() || it == '.')
        && unsigned.parse::<f64>().is_ok_and(f64::is_finite)
}

#[cfg(test)]
mod tests {
    use super::{Row, rows};

    #[test]
    fn rows_are_read_between_headers_comments_and_empty_lines() {
        let text = "\u{feff}angle, lift # of the rocker\r\n\n# measured\n0,0\r\n 90 , -1.5e-3 # peak\n+.5,1.\n";
        let expected = [(4, ["0", "0"]), (5, ["90", "-1.5e-3"]), (6, ["+.5", "1."])];
        let expected: Vec<Row<'_>> = expected
            .into_iter()
            .map(|(line, cells)| Row { line, cells })
            .collect();
        assert_eq!(rows(text), Ok(expected));
        assert_eq!(rows("# nothing\n\n"), Ok(Vec::new()));
    }

    #[test]
    fn faults_name_their_lines() {
        let found = |text: &str| -> Vec<(usize, String)> {
            let faults = rows(text).expect_err("a fault");
            let faults = faults.into_iter();
            faults.map(|fault| (fault.line, fault.message)).collect()
        };
        let cells = |count: &str| format!("{count} where two are wanted");
        assert_eq!(
            found("x,y\n0,0\n1;2\n1,2,3\n\n1,\nnan,1\n1,1e999\n0x1,1"),
            [
                (3, cells("1 cell")),
                (4, cells("3 cells")),
                (6, "an empty cell".to_string()),
                (7, "`nan` is no number".to_string()),
                (8, "`1e999` is no number".to_string()),
                (9, "`0x1` is no number".to_string()),
            ]
        );
        // Only the first line names columns, and not where one cell is a number.
        assert_eq!(found("a,b\na,b")[0].0, 2);
        assert_eq!(found("a,1")[0].0, 1);
        assert_eq!(found(&"a,1\n".repeat(50)).len(), 10);
    }
}
