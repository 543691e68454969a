//! Reads or refuses any bytes as a description without a panic. All findings can be printed, and a readable text can
//! be formatted.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::{Options, generate};

use super::format;
use super::outcome::with_codes;

/// Largest number of coordinates for which the code is generated too: larger mechanisms only take longer.
const MAX_COORDINATES: usize = 12;

/// Formats, reads, checks and generates; returns the last stage, with codes.
///
/// # Panics
/// If the library does, or if a finding cannot be printed.
pub fn run(bytes: &[u8]) -> String {
    let source = match Source::from_bytes("fuzzed.mech", bytes) {
        Ok(source) => source,
        Err(unreadable) => {
            printed(&unreadable.1, &unreadable.0);
            return with_codes("unreadable", &unreadable.1);
        }
    };
    format::run(&source);
    let read = match linkwright_codegen::read(&source) {
        Ok(read) => read,
        Err(findings) => {
            assert!(findings.has_errors(), "refused without an error");
            printed(&findings, &source);
            return with_codes("refused", &findings);
        }
    };
    assert!(!read.motions.is_empty());
    printed(&read.warnings, &source);
    for motion in &read.motions {
        if let Err(findings) = linkwright_codegen::stages::check(motion) {
            assert!(findings.has_errors(), "refused without an error");
            printed(&findings, &source);
            return with_codes("not solvable", &findings);
        }
    }
    if read
        .motions
        .iter()
        .all(|it| it.system.coordinates.len() <= MAX_COORDINATES)
    {
        let generated = generate(&source, &Options::default());
        let generated = generated.expect("what is checked can be generated");
        assert!(
            !generated.code().contains("NAN"),
            "a value that is not a number"
        );
        if let Err(error) = syn::parse_file(generated.code()) {
            panic!("the module is not Rust: {error}");
        }
    }
    with_codes("generated", &read.warnings)
}

fn printed(findings: &Diagnostics, source: &Source) {
    let text = findings.render(source);
    assert_eq!(text.is_empty(), findings.is_empty(), "{text}");
    for finding in findings.iter() {
        let place = finding.primary.span.range();
        assert!(
            place.end <= source.text.len(),
            "a place outside of the text"
        );
        assert!(
            source.text.get(place).is_some(),
            "a place within a character"
        );
    }
}
