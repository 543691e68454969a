//! Every diagnostic code as it is printed: one or more case files per code, each with its rendered text as a
//! snapshot.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use linkwright_codegen::diagnostic::{Code, Diagnostics, Source};
use linkwright_codegen::stages::files::attach_files;
use linkwright_codegen::{Options, generate};
use linkwright_tests::files;

/// The errors of a description, or its warnings where it has no error.
fn findings(source: &Source) -> Diagnostics {
    match generate(source, &Options::default()) {
        Ok(generated) => generated.warnings,
        Err(diagnostics) => diagnostics,
    }
}

fn source(path: &Path) -> Source {
    let text = fs::read_to_string(path).expect("a case file");
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .expect("a file name in UTF-8");
    let folder = path.parent().expect("a folder");
    attach_files(Source::new(name, text), folder)
}

fn snapshot(name: &str, rendered: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(files::package("snapshots/diagnostics"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, rendered));
}

/// Checks that a rendered finding has the code, the place, the line and carets under it.
fn assert_rendered(rendered: &str, code: Code, file: &str) {
    assert!(
        rendered.contains(&format!("[{}]: ", code.name())),
        "{rendered}"
    );
    assert!(rendered.contains(&format!("--> {file}:")), "{rendered}");
    assert!(rendered.contains('^'), "{rendered}");
}

/// Every finding says what to do about it.
fn assert_helpful(found: &Diagnostics, source: &Source) {
    for finding in found.iter() {
        assert!(!finding.help.is_empty(), "{}", finding.render(source));
    }
}

/// Code after which a case is named.
fn named_code(path: &Path) -> Code {
    let stem = files::stem(path);
    let code = Code::ALL
        .iter()
        .find(|code| stem.starts_with(&format!("{}_", code.name())));
    *code.unwrap_or_else(|| panic!("{stem} does not start with a code"))
}

#[test]
fn every_case_yields_its_code_and_reads_as_in_its_snapshot() {
    for path in files::with_extension(&files::package("cases/errors"), "mech") {
        let source = source(&path);
        let reported = findings(&source);
        let code = named_code(&path);
        assert_helpful(&reported, &source);
        let rendered = reported.render(&source);
        assert!(
            reported.iter().any(|it| it.code == code),
            "{} lacks {code}:\n{rendered}",
            source.name
        );
        assert_rendered(&rendered, code, &source.name);
        snapshot(files::stem(&path), &rendered);
    }
}

/// Codes without case files: bytes that no text file should hold, which the tests below build, and defects, which no
/// text should cause; and lanes, which an option requests.
const BUILT: [Code; 3] = [Code::UnreadableFile, Code::NoLanes, Code::InternalError];

#[test]
fn no_code_lacks_a_case() {
    let mut covered: BTreeSet<Code> = BUILT.into();
    for path in files::with_extension(&files::package("cases/errors"), "mech") {
        covered.insert(named_code(&path));
    }
    let lacking: Vec<&Code> = Code::ALL
        .iter()
        .filter(|code| !covered.contains(code))
        .collect();
    assert!(lacking.is_empty(), "no case for {lacking:?}");
}

/// A snapshot without a case would never be compared again.
#[test]
fn no_snapshot_lacks_a_case() {
    let built = ["K00_not_utf_8", "K00_too_large", "many_errors"];
    for path in files::with_extension(&files::package("snapshots/diagnostics"), "snap") {
        let stem = files::stem(&path);
        let case = files::package("cases/errors").join(format!("{stem}.mech"));
        assert!(
            built.contains(&stem) || case.is_file(),
            "{stem} has no case"
        );
    }
}

#[test]
fn bytes_that_are_not_utf_8_are_shown_with_their_place() {
    let mut bytes = b"mechanism case {\n    const a = \"".to_vec();
    bytes.extend([0xff, 0xfe]);
    bytes.extend(b"\";\n}\n");
    let (source, found) = *Source::from_bytes("K00_not_utf_8.mech", &bytes).expect_err("not UTF-8");
    assert!(found.iter().all(|it| it.code == Code::UnreadableFile));
    assert_helpful(&found, &source);
    let rendered = found.render(&source);
    assert_rendered(&rendered, Code::UnreadableFile, "K00_not_utf_8.mech");
    snapshot("K00_not_utf_8", &rendered);
}

#[test]
fn a_file_that_is_too_large_is_refused() {
    let text = "// more\n".repeat(Source::MAX_BYTES / 8 + 1);
    let source = Source::new("K00_too_large.mech", text.clone());
    let reported = findings(&source);
    assert!(reported.iter().all(|it| it.code == Code::UnreadableFile));
    assert_helpful(&reported, &source);
    snapshot("K00_too_large", &reported.render(&source));
    let from_bytes = Source::from_bytes("K00_too_large.mech", text.as_bytes());
    assert!(
        from_bytes.is_err()
            || from_bytes.is_ok_and(|source| generate(&source, &Options::default()).is_err())
    );
}

/// All errors of the text itself at once; then, after their correction, all those of names, values and forms.
#[test]
fn all_errors_of_a_file_are_reported_at_once() {
    let source = source(&files::package("cases/many_errors.mech"));
    let reported = findings(&source);
    let rendered = reported.render(&source);
    snapshot("many_errors", &rendered);
    let codes: BTreeSet<Code> = reported.iter().map(|it| it.code).collect();
    for code in [
        Code::MissingSemicolon,
        Code::UnknownStatement,
        Code::OutsideGrammar,
        Code::NameNotAllowed,
        Code::UnknownName,
        Code::DuplicateName,
        Code::UnknownFunction,
        Code::PointNotOnBody,
        Code::WrongArgumentCount,
        Code::JointOnOneBody,
        Code::UnknownUnit,
        Code::WrongDimension,
        Code::NotFinite,
        Code::NotConstant,
        Code::DegenerateGeometry,
        Code::WrongForm,
    ] {
        assert!(codes.contains(&code), "{code} is not reported:\n{rendered}");
    }
}
