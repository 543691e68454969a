//! Widths of lines.

/// Width of the longest line, which is that of the documentation.
pub(super) const WIDTH: usize = 120;

/// True if a line is short enough.
pub(super) fn fits(line: &str) -> bool {
    line.chars().count() <= WIDTH
}

/// Joins pieces in full lines.
pub(super) fn filled<'a>(pieces: impl IntoIterator<Item = &'a str>, depth: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for piece in pieces {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + piece.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(piece);
            }
            _ => lines.push(format!("{:depth$}{piece}", "")),
        }
    }
    lines
}
