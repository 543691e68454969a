//! Writes rows of cells as a table of text.

use std::io::{self, Write};

use linkwright_codegen::stages::emit::text::shown_width;

/// Writes rows of cells as a table; the first row holds the names of the columns.
pub fn aligned(rows: &[Vec<String>], output: &mut dyn Write) -> io::Result<()> {
    let count = rows.first().map_or(0, Vec::len);
    let width = |column: usize| {
        rows.iter()
            .map(|row| shown_width(&row[column]))
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            line += cell;
            line += &" ".repeat(width - shown_width(cell) + 2);
        }
        writeln!(output, "  {}", line.trim_end())?;
    }
    Ok(())
}
