//! No text panics, overflows the stack, or goes without a finding and a document.

use super::super::{MAX_DEPTH, parse};
use super::{EXCAVATOR, TWO_BODY, codes, good};
use crate::diagnostic::{Code, Diagnostics, Source};

/// Parses and renders; a text without a document has an error.
fn survives(text: &str) {
    let source = Source::new("any.mech", text);
    let mut findings = Diagnostics::new();
    let document = parse(&source, &mut findings);
    assert!(
        document.is_some() || findings.has_errors(),
        "silence about {text:?}"
    );
    for finding in findings.iter() {
        assert!(
            finding.code < Code::UnknownName || finding.code == Code::WrongForm,
            "{finding:?}"
        );
        // The scan leaves only text that `syn` can tokenize.
        assert_ne!(finding.message, "unreadable text", "{text:?}");
        for label in finding.secondary.iter().chain([&finding.primary]) {
            let (start, end) = (label.span.start as usize, label.span.end as usize);
            assert!(
                start <= end && text.is_char_boundary(start) && text.is_char_boundary(end),
                "{finding:?}"
            );
        }
    }
    let rendered = findings.render(&source);
    assert_eq!(
        findings.has_errors(),
        rendered.ends_with("in any.mech\n"),
        "{rendered}"
    );
}

#[test]
fn nasty_texts() {
    let many = 10_000;
    let inside = |text: &str| format!("mechanism m {{ const a = {text}; }}");
    for text in [
        String::new(),
        "\u{feff}".to_string(),
        "\0".to_string(),
        "\r".to_string(),
        "/*".to_string(),
        "/**/".to_string(),
        "(/*ERROR*/)".to_string(),
        "r#\"\"#".to_string(),
        "'a b' 'c".to_string(),
        "\"\\\"".to_string(),
        "0b2 0xg 0o9 1e+ 1._ 1.. 1.e 0b".to_string(),
        "(".repeat(many),
        ")".repeat(many),
        "{".repeat(many),
        "}".repeat(many),
        "([{".repeat(many),
        "mechanism m {".repeat(many),
        inside(&"(".repeat(many)),
        inside(&format!("{}1{}", "(".repeat(many), ")".repeat(many))),
        inside(&format!("{}1{}", "f(".repeat(many), ")".repeat(many))),
        inside(&"-".repeat(many)),
        inside(&format!("{}1", "-".repeat(many))),
        inside(&format!("{}1", "+".repeat(many))),
        inside(&format!("1{}", "^1".repeat(many))),
        inside(&format!("1{}", "^-1".repeat(many))),
        inside(&"9".repeat(many)),
        inside(&"a.".repeat(many)),
        inside(&"²".repeat(many)),
        inside(&"é".repeat(many)),
        inside(&"° ".repeat(many)),
        format!("mechanism m {{ {} }}", ";".repeat(many)),
        format!("mechanism m {{ {} }}", "a\n".repeat(many)),
        format!(
            "mechanism m {{ body b at (0, 0) {{ {} }} }}",
            "A;".repeat(many)
        ),
        "///".repeat(many),
        "///\n".repeat(many),
        "/*".repeat(many),
    ] {
        survives(&text);
    }
}

#[test]
fn long_chains_are_flat_and_deep_nesting_is_an_error() {
    let inside = |text: String| format!("mechanism m {{ const a = {text}; }}");
    good(&inside(vec!["a"; 20_000].join("+")));
    good(&inside(vec!["a"; 20_000].join("/")));
    let nested = |depth: usize| inside(format!("{}1{}", "(".repeat(depth), ")".repeat(depth)));
    good(&nested(MAX_DEPTH - 2));
    assert_eq!(codes(&nested(MAX_DEPTH + 1)), vec!["K09 1:152"]);
    assert_eq!(
        codes(&inside(format!("{}1", "-".repeat(MAX_DEPTH + 1)))),
        vec!["K09 1:153"]
    );
    assert_eq!(
        codes(&inside(format!("1{}", "^1".repeat(MAX_DEPTH + 1)))).len(),
        1
    );
}

/// Checks that the time is linear in the length; these texts would take minutes otherwise.
#[test]
fn large_texts() {
    for piece in [
        "\"",
        "a.",
        "²x",
        "((",
        "}",
        "body a at (0, 0) {}\n",
        "///\n",
        "\r",
    ] {
        survives(&format!(
            "mechanism m {{{}",
            piece.repeat(100_000 / piece.len())
        ));
        survives(&piece.repeat(100_000 / piece.len()));
    }
}

#[test]
fn the_seeds_with_other_line_breaks() {
    for seed in [TWO_BODY, EXCAVATOR] {
        good(&seed.replace('\n', "\r\n"));
        good(&format!("\u{feff}{seed}"));
        good(seed.trim_end());
        let plain = |text: &str| good(text).mechanism.statements.len();
        assert_eq!(plain(seed), plain(&seed.replace('\n', "\r\n")));
    }
}

/// Checks mutations of the seeds: every part deleted, doubled or replaced, in a fixed pseudo-random order.
#[test]
fn mutated_seeds() {
    let mut state: u64 = 0x2545_f491_4f6c_dd1d;
    let mut next = |below: usize| {
        // Knuth's multiplier (MMIX); the high bits are the random ones.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as usize) % below.max(1)
    };
    let pieces = [
        "(",
        ")",
        "{",
        "}",
        "[",
        "]",
        ";",
        ",",
        ".",
        ":",
        "=",
        "->",
        "^",
        "-",
        "*",
        "/",
        "//",
        "/*",
        "*/",
        "\n",
        "\"",
        "'",
        "°",
        "²",
        "π",
        "0x1",
        "1e",
        "1.",
        "///",
        "//!",
        "#",
        "body ",
        "const ",
        "drive ",
        "point ",
        "mechanism ",
        "\0",
        "\u{202e}",
        "r#\"",
        "b'",
        "e",
        "_",
        "𝛑",
        "\r",
        "\t",
        "½",
        "1.P",
    ];
    for case in 0..6_000 {
        let seed = if case % 2 == 0 { TWO_BODY } else { EXCAVATOR };
        let mut letters: Vec<char> = seed.chars().collect();
        for _ in 0..=next(4) {
            let at = next(letters.len());
            match next(4) {
                0 => {
                    let end = (at + 1 + next(12)).min(letters.len());
                    letters.drain(at..end);
                }
                1 => {
                    let end = (at + 1 + next(12)).min(letters.len());
                    let copy: Vec<char> = letters[at..end].to_vec();
                    let to = next(letters.len());
                    letters.splice(to..to, copy);
                }
                2 => {
                    let piece = pieces[next(pieces.len())];
                    letters.splice(at..at, piece.chars());
                }
                _ => letters.truncate(at.max(letters.len() / 2)),
            }
            if letters.is_empty() {
                letters.push(' ');
            }
        }
        survives(&letters.iter().collect::<String>());
    }
}
