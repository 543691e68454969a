//! Suggests the existing word nearest to a misspelt one.

use std::cell::Cell;

/// Maximum number of words compared over all suggestions of a text. In a long list of misspelt names, only the first get
/// suggestions.
const MAX_COMPARISONS: usize = 1_000_000;

/// Number of letters per permitted slip; one slip is always permitted.
const LETTERS_PER_SLIP: usize = 3;

/// Source of suggestions from long lists, within a bounded amount of work.
#[derive(Debug, Clone, Default)]
#[doc(hidden)]
pub struct Suggestions {
    compared: Cell<usize>,
}

impl Suggestions {
    /// Returns the [`nearest`] candidate; `None` as well if the limit of comparisons is reached.
    pub fn nearest<'a>(
        &self,
        word: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Option<&'a str> {
        if self.compared.get() >= MAX_COMPARISONS {
            return None;
        }
        let counted = candidates
            .into_iter()
            .inspect(|_| self.compared.set(self.compared.get() + 1));
        nearest(word, counted)
    }
}

/// Returns the candidate nearest to `word`, if at most a third of the letters differ.
///
/// The distance counts insertions, deletions, replacements and exchanges of neighbors (optimal string alignment), ignoring
/// case. Among equally near candidates, the first wins.
#[doc(hidden)]
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters_of_word: Vec<char> = word.chars().flat_map(char::to_lowercase).collect();
    let limit = (letters_of_word.len() / LETTERS_PER_SLIP).max(1);
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let letters: Vec<char> = candidate.chars().flat_map(char::to_lowercase).collect();
        // The difference in length bounds the distance from below, which avoids the table for most candidates.
        if letters.len().abs_diff(letters_of_word.len()) > limit {
            continue;
        }
        let distance = distance(&letters_of_word, &letters);
        let replaces_everything = distance >= letters_of_word.len().max(letters.len());
        if distance <= limit
            && !replaces_everything
            && best.is_none_or(|(least, _)| distance < least)
        {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

fn distance(one: &[char], other: &[char]) -> usize {
    let mut before_last: Vec<usize> = vec![0; other.len() + 1];
    let mut last: Vec<usize> = (0..=other.len()).collect();
    for i in 1..=one.len() {
        let mut current = vec![i; other.len() + 1];
        for j in 1..=other.len() {
            let replaced = last[j - 1] + usize::from(one[i - 1] != other[j - 1]);
            let mut least = replaced.min(last[j] + 1).min(current[j - 1] + 1);
            if i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1] {
                least = least.min(before_last[j - 2] + 1);
            }
            current[j] = least;
        }
        before_last = last;
        last = current;
    }
    last[other.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn slips_are_recognized_and_strangers_are_not() {
        let functions = ["sin", "cos", "tan", "sqrt", "distance"];
        assert_eq!(nearest("sine", functions), Some("sin"));
        assert_eq!(nearest("sqr", functions), Some("sqrt"));
        assert_eq!(nearest("dsitanse", functions), Some("distance"));
        assert_eq!(nearest("SIN", functions), Some("sin"));
        assert_eq!(nearest("x", functions), None);
        assert_eq!(nearest("tanh2", functions), None);
        assert_eq!(nearest("", functions), None);
        assert_eq!(nearest("q", ["A", "B"]), None);
        assert_eq!(nearest("c9", ["c8", "c10"]), Some("c8"));
    }
}
