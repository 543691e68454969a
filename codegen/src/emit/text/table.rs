//! Cells → aligned columns.

/// Lines of cells, each column as wide as its widest cell, two spaces between, no space at the end of a line.
pub(crate) fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        lines
            .iter()
            .filter_map(|line| line.get(column))
            .map(|cell| shown_width(cell))
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for line in lines {
        let mut shown = String::new();
        for (cell, width) in line.iter().zip(&widths) {
            shown.push_str("  ");
            shown.push_str(cell);
            shown.push_str(&" ".repeat(width - shown_width(cell)));
        }
        text.push_str(shown.trim_end());
        text.push('\n');
    }
    text
}

/// How many columns of a terminal a text takes; combining dots take none.
pub(crate) fn shown_width(text: &str) -> usize {
    text.chars()
        .filter(|character| !matches!(character, '\u{300}'..='\u{36f}'))
        .count()
}
