//! Writes lists and numbers as words.

use super::phrase::Phrase;

/// Joins phrases to a list: `a`, `a and b`, `a, b and c`.
pub fn enumerated(parts: &[Phrase]) -> Phrase {
    let mut whole = Phrase::default();
    for (place, part) in parts.iter().enumerate() {
        whole.push(match place {
            0 => "",
            _ if place + 1 == parts.len() => " and ",
            _ => ", ",
        });
        whole.push(part.clone());
    }
    whole
}

/// Writes a number with its noun: `1 angle`, `2 angles`.
pub fn counted(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_numbers_read_as_sentences() {
        let parts = ["x1", "y1", "phi1"].map(Phrase::from);
        let text = |parts: &[Phrase]| enumerated(parts).text(|_| String::new());
        assert_eq!(text(&parts[..1]), "x1");
        assert_eq!(text(&parts[..2]), "x1 and y1");
        assert_eq!(text(&parts), "x1, y1 and phi1");
        assert_eq!(counted(1, "angle", "angles"), "1 angle");
        assert_eq!(counted(3, "angle", "angles"), "3 angles");
    }
}
