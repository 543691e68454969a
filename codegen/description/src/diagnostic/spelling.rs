//! Converts findings on expanded text into findings on the source: restores spellings, and merges findings that repetition
//! multiplied.

use std::collections::BTreeMap;

use super::{Diagnostic, Diagnostics};

impl Diagnostics {
    /// Returns the findings with the source spellings of names, by resolved name: `rod[3]` for `rod3`. Of findings with equal
    /// code and location, the one with the lowest index is kept and notes that there are more.
    #[doc(hidden)]
    pub fn respelled(self, spellings: &BTreeMap<String, String>) -> Diagnostics {
        if spellings.is_empty() {
            return self;
        }
        let mut kept: Vec<(Diagnostic, usize)> = Vec::new();
        for finding in self.iter() {
            let respelled_finding = respelled(finding.clone(), spellings);
            let same = kept.iter_mut().find(|(it, _)| {
                (it.code, it.primary.span)
                    == (respelled_finding.code, respelled_finding.primary.span)
                    && it.severity == respelled_finding.severity
            });
            match same {
                Some((first, others)) => {
                    *others += usize::from(*first != respelled_finding);
                    if (respelled_finding.message.len(), &respelled_finding.message)
                        < (first.message.len(), &first.message)
                    {
                        *first = respelled_finding;
                    }
                }
                None => kept.push((respelled_finding, 0)),
            }
        }
        let mut all = Diagnostics::new();
        all.extend(kept.into_iter().map(|(found, others)| match others {
            0 => found,
            1 => found.note("this holds for one more copy, too"),
            _ => found.note(format!("this holds for {others} more copies, too")),
        }));
        all
    }
}

fn respelled(mut found: Diagnostic, spellings: &BTreeMap<String, String>) -> Diagnostic {
    let labels = found
        .secondary
        .iter_mut()
        .chain(Some(&mut found.primary))
        .map(|it| &mut it.text);
    let texts = labels
        .chain(Some(&mut found.message))
        .chain(&mut found.help)
        .chain(&mut found.notes);
    for text in texts {
        *text = with_spellings(text, spellings);
    }
    found
}

/// Returns the text with source spellings of the names in backticks.
fn with_spellings(text: &str, spellings: &BTreeMap<String, String>) -> String {
    let mut written = String::with_capacity(text.len());
    for (number, piece) in text.split('`').enumerate() {
        if number > 0 {
            written.push('`');
        }
        let is_quoted = number % 2 == 1;
        if !is_quoted {
            written.push_str(piece);
            continue;
        }
        let mut rest = piece;
        let mut owner: Option<&str> = None;
        while !rest.is_empty() {
            let is_part = |it: char| it.is_ascii_alphanumeric() || it == '_';
            let end = rest.find(|it: char| !is_part(it)).unwrap_or(rest.len());
            if end == 0 {
                let other = rest.chars().next().map_or(1, char::len_utf8);
                owner = owner.filter(|_| &rest[..other] == ".");
                written.push_str(&rest[..other]);
                rest = &rest[other..];
                continue;
            }
            let name = &rest[..end];
            let spelled = spellings.get(name).map_or(name, String::as_str);
            // `stage[3].rod.stage[3].P` is written `stage[3].rod.P`.
            let part = |it: &str| it.rfind('.').map_or(0, |dot| dot + 1);
            let shared = owner.map_or(0, |owner| match part(owner) {
                0 => 0,
                length if spelled.starts_with(&owner[..length]) => length,
                _ => 0,
            });
            written.push_str(&spelled[shared..]);
            owner = Some(spelled);
            rest = &rest[end..];
        }
    }
    written
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::{Code, Span};
    use super::*;

    fn spellings() -> BTreeMap<String, String> {
        let names = [
            ("rod3", "rod[3]"),
            ("stage3_rod", "stage[3].rod"),
            ("stage3_P", "stage[3].P"),
        ];
        let names = names.map(|(called, written)| (called.to_string(), written.to_string()));
        names.into_iter().collect()
    }

    #[test]
    fn names_between_backticks_are_spelled_as_they_are_written() {
        let spelled = |text| with_spellings(text, &spellings());
        assert_eq!(
            spelled("no body is named `rod3`"),
            "no body is named `rod[3]`"
        );
        assert_eq!(spelled("rod3 and `rod31`"), "rod3 and `rod31`");
        assert_eq!(
            spelled("`revolute (stage3_rod.stage3_P, rod3.K)`"),
            "`revolute (stage[3].rod.P, rod[3].K)`"
        );
        assert_eq!(spelled("ä `ä.rod3"), "ä `ä.rod[3]");
    }

    #[test]
    fn reports_repeated_findings_once() {
        let mut findings = Diagnostics::new();
        for k in 1..=3 {
            let message = format!("no body is named `rod{k}`");
            findings.push(Diagnostic::error(
                Code::UnknownName,
                Span::new(4, 8),
                message,
            ));
        }
        findings.push(Diagnostic::error(Code::WrongForm, Span::new(4, 8), "other"));
        let sorted = findings.respelled(&spellings()).into_sorted();
        assert_eq!(sorted.len(), 2);
        assert_eq!(sorted[0].message, "no body is named `rod1`");
        assert_eq!(sorted[0].notes, ["this holds for 2 more copies, too"]);
        assert!(sorted[1].notes.is_empty());
    }
}
