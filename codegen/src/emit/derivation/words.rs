//! Lists and numbers as words.

/// `a`, `a and b`, `a, b and c`.
pub(super) fn enumerated(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// `1 angle`, `2 angles`.
pub(super) fn counted(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

#[cfg(test)]
mod tests {
    use super::{counted, enumerated};

    #[test]
    fn lists_and_numbers_read_as_sentences() {
        let parts = ["x1", "y1", "phi1"].map(String::from);
        assert_eq!(enumerated(&parts[..1]), "x1");
        assert_eq!(enumerated(&parts[..2]), "x1 and y1");
        assert_eq!(enumerated(&parts), "x1, y1 and phi1");
        assert_eq!(counted(1, "angle", "angles"), "1 angle");
        assert_eq!(counted(3, "angle", "angles"), "3 angles");
    }
}
