//! Finds the set with which an interrupted table continues.
//!
//! The last set that a complete row names may lack rows, so it is solved again: the table is cut before its first row.

use std::io::{self, BufRead};

/// Place at which a table continues.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Continuation {
    /// First set that is solved.
    pub set: u64,
    /// Number of bytes that stay.
    pub length: u64,
    /// Complete rows of that set, which its new rows must repeat.
    pub rows: Vec<u8>,
}

/// Returns the place at which a table with this header continues; `None` if it is not the beginning of such a table.
///
/// # Errors
/// Errors of reading.
pub fn continuation(
    mut table: impl BufRead,
    header: &[u8],
    count: u64,
) -> io::Result<Option<Continuation>> {
    let mut line = Vec::new();
    table.read_until(b'\n', &mut line)?;
    if line != header {
        // A header that is cut leaves nothing.
        let is_cut = !line.ends_with(b"\n") && header.starts_with(&line);
        return Ok(is_cut.then(Continuation::default));
    }
    let mut place = Continuation {
        set: 0,
        length: header.len() as u64,
        rows: Vec::new(),
    };
    loop {
        line.clear();
        table.read_until(b'\n', &mut line)?;
        if !line.ends_with(b"\n") {
            return Ok(Some(place));
        }
        let number = line.split(|it| *it == b',').next().unwrap_or_default();
        let set = std::str::from_utf8(number)
            .ok()
            .and_then(|it| it.parse::<u64>().ok());
        match set {
            Some(set) if set == place.set => place.rows.extend_from_slice(&line),
            Some(set) if set == place.set + 1 && set < count && !place.rows.is_empty() => {
                place.length += place.rows.len() as u64;
                place.set = set;
                place.rows.clear();
                place.rows.extend_from_slice(&line);
            }
            _ => return Ok(None),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_set_is_solved_again() {
        let header = b"set,rod\n";
        let at = |text: &str| continuation(text.as_bytes(), header, 3).expect("no error");
        let expected = |set, length, rows: &str| {
            let rows = rows.as_bytes().to_vec();
            Some(Continuation { set, length, rows })
        };
        for (text, own) in [
            ("", expected(0, 0, "")),
            ("set,r", expected(0, 0, "")),
            ("set,rod", expected(0, 0, "")),
            ("set,rod\n", expected(0, 8, "")),
            ("set,rod\n0", expected(0, 8, "")),
            ("set,rod\n0,1.5", expected(0, 8, "")),
            ("set,rod\n0,1.5\n", expected(0, 8, "0,1.5\n")),
            ("set,rod\n0,1\n0,2\n1", expected(0, 8, "0,1\n0,2\n")),
            ("set,rod\n0,1\n0,2\n1,3\n1,", expected(1, 16, "1,3\n")),
            ("set,rad\n", None),
            ("set,rod\n1,2\n", None),
            ("set,rod\n0,2\n2,2\n", None),
            ("set,rod\n0,2\nword\n", None),
            ("set,rod\n0,1\n1,1\n2,1\n3,1\n", None),
        ] {
            assert_eq!(at(text), own, "{text:?}");
        }
    }
}
