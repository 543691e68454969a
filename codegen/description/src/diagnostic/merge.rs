//! Merges the findings of all motions of a file.
//!
//! A finding common to all motions is reported once, without the name of a motion. Any other begins with the name of its
//! motion, unless its location lies in that motion.

use std::collections::BTreeMap;

use super::{Code, Diagnostic, Diagnostics, Span};

/// Merges findings of motions, given with their names and, for motions that contain their statements, their locations.
#[doc(hidden)]
pub fn merged(motions: Vec<(&str, Option<Span>, Diagnostics)>) -> Diagnostics {
    let count = motions.len();
    let motions: Vec<(&str, Option<Span>, Vec<Diagnostic>)> = motions
        .into_iter()
        .map(|(name, place, found)| (name, place, found.into_sorted()))
        .collect();
    // Number of motions with a finding.
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

/// Fields by which two findings are equal.
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
    fn reports_common_findings_once() {
        let finding = |message: &str, at: usize| {
            Diagnostic::error(Code::UnknownName, Span::new(at, at + 1), message)
        };
        let part = |findings: &[Diagnostic]| {
            let mut part = Diagnostics::new();
            part.extend(findings.iter().cloned());
            part
        };
        let (shared, inside, outside) = (finding("shared", 1), finding("in", 5), finding("out", 2));
        let findings = merged(vec![
            (
                "one",
                Some(Span::new(4, 8)),
                part(&[shared.clone(), inside, outside]),
            ),
            ("two", Some(Span::new(8, 9)), part(&[shared])),
        ]);
        let messages: Vec<String> = findings
            .into_iter()
            .map(|finding| finding.message)
            .collect();
        assert_eq!(messages, ["shared", "motion `one`: out", "in"]);
    }
}
