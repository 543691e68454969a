//! Code that is longer than a line → lines that a person would break it into.

/// The longest line, as wide as the documentation.
pub(super) const WIDTH: usize = 120;

/// Whether a line is short enough.
pub(super) fn fits(line: &str) -> bool {
    line.chars().count() <= WIDTH
}

/// Pieces one after another in lines that are full.
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
