//! Aligns cells in columns.

/// Number of spaces that a column may have for any contents.
const MAX_PADDING: usize = 16_384;

/// Lines of cells, each column as wide as its widest cell, two spaces between, no space at the end of a line. If that
/// would be mostly space, the widest cells exceed their column.
pub(crate) fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = lines.iter().filter_map(|line| line.get(column));
        let mut widths: Vec<usize> = cells.map(|cell| shown_width(cell)).collect();
        widths.sort_unstable_by(|one, other| other.cmp(one));
        let room = MAX_PADDING + 4 * widths.iter().sum::<usize>();
        let mut fitting = widths.iter().filter(|&&width| width * lines.len() <= room);
        fitting.next().copied().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for line in lines {
        let mut padded = String::new();
        for (cell, width) in line.iter().zip(&widths) {
            padded.push_str("  ");
            padded.push_str(cell);
            padded.push_str(&" ".repeat(width.saturating_sub(shown_width(cell))));
        }
        text.push_str(padded.trim_end());
        text.push('\n');
    }
    text
}

/// Widest choice on one line.
const WIDEST_CHOICE: usize = 90;

/// `left = right`; a wide choice with each of its arms on a line of its own.
pub(crate) fn in_lines(left: &str, right: &str) -> Vec<String> {
    let whole = format!("{left} = {right}");
    if !right.starts_with("if ") || shown_width(&whole) <= WIDEST_CHOICE {
        return vec![whole];
    }
    let indent = " ".repeat(shown_width(left) + 3);
    let mut lines = vec![format!("{left} = ")];
    let (mut depth, mut from) = (0_i32, 0);
    for (at, character) in right.char_indices() {
        depth += i32::from(character == '{') - i32::from(character == '}');
        if depth == 0 && right[at..].starts_with(" else ") {
            lines.push(indent.clone());
            let line = lines.len() - 2;
            lines[line].push_str(&right[from..at]);
            from = at + 1;
        }
    }
    if let Some(last) = lines.last_mut() {
        last.push_str(&right[from..]);
    }
    lines
}

/// Number of columns of a text in a terminal; combining dots take none.
pub fn shown_width(text: &str) -> usize {
    text.chars()
        .filter(|character| !matches!(character, '\u{300}'..='\u{36f}'))
        .count()
}

#[cfg(test)]
mod tests {
    use super::aligned;

    fn table(rows: usize, widest: usize) -> String {
        let row = |place: usize| {
            let cell = if place == 0 { widest } else { 3 };
            vec!["x".repeat(cell), "end".to_string()]
        };
        aligned(&(0..rows).map(row).collect::<Vec<_>>())
    }

    #[test]
    fn a_small_table_is_as_wide_as_its_widest_cell() {
        let lines = table(20, 200);
        assert!(
            lines.lines().all(|line| line.len() == 2 + 200 + 2 + 3),
            "{lines}"
        );
    }

    #[test]
    fn a_table_takes_room_in_proportion_to_its_cells() {
        // Rows as wide as the widest cell would take 16-fold room.
        let [short, long] = [1000, 4000].map(|n| table(n, n).len());
        assert!(long < 5 * short, "{short} and {long}");
    }
}
