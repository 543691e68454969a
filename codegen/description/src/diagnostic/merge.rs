//! *The findings of each motion → those of the file.* What all motions have is said once, without a motion's name.
//!
//! A finding of some motions alone begins with the name of the motion, unless its place lies in the motion already.

use std::collections::BTreeMap;

use super::{Code, Diagnostic, Diagnostics, Span};

/// The findings of motions that are given with their names and, where a place in them says enough, their places.
pub fn merged(motions: Vec<(&str, Option<Span>, Diagnostics)>) -> Diagnostics {
    let count = motions.len();
    let motions: Vec<(&str, Option<Span>, Vec<Diagnostic>)> = motions
        .into_iter()
        .map(|(name, place, found)| (name, place, found.into_sorted()))
        .collect();
    // How many motions have a finding.
    let mut having: BTreeMap<Key<'_>, usize> = BTreeMap::new();
    for finding in motions.iter().flat_map(|(_, _, found)| found) {
        *having.entry(key(finding)).or_default() += 1;
    }
    let mut all = Diagnostics::new();
    for (index, (name, place, found)) in motions.iter().enumerate() {
        for finding in found {
            let at = finding.primary.span;
            let lies_in = place.is_some_and(|it| it.start <= at.start && at.end <= it.end);
            if having.get(&key(finding)) == Some(&count) {
                if index == 0 {
                    all.push(finding.clone());
                }
            } else if lies_in {
                all.push(finding.clone());
            } else {
                let mut finding = finding.clone();
                finding.message = format!("motion `{name}`: {}", finding.message);
                all.push(finding);
            }
        }
    }
    all
}

/// What makes two findings the same.
type Key<'a> = (u32, u32, Code, &'a str, &'a str);

fn key(finding: &Diagnostic) -> Key<'_> {
    let span = finding.primary.span;
    let label = finding.primary.text.as_str();
    (span.start, span.end, finding.code, &finding.message, label)
}

#[cfg(test)]
mod tests {
    use super::merged;
    use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};

    #[test]
    fn what_all_motions_have_is_said_once() {
        let finding = |message: &str, at: usize| {
            Diagnostic::error(Code::UnknownName, Span::new(at, at + 1), message)
        };
        let part = |findings: &[Diagnostic]| {
            let mut part = Diagnostics::new();
            part.extend(findings.iter().cloned());
            part
        };
        let (shared, inside, outside) = (finding("shared", 1), finding("in", 5), finding("out", 2));
        let found = merged(vec![
            (
                "one",
                Some(Span::new(4, 8)),
                part(&[shared.clone(), inside, outside]),
            ),
            ("two", Some(Span::new(8, 9)), part(&[shared])),
        ]);
        let messages: Vec<String> = found.into_iter().map(|finding| finding.message).collect();
        assert_eq!(messages, ["shared", "motion `one`: out", "in"]);
    }
}
